"""Heat of crystallization from the saturated solution, by the slope of the solubility curve.

Tables give the heat of solution in much water. The last gram of potassium nitrate that dissolves takes up
three fifths of that, and magnesium chloride hexahydrate, which heats much water, cools its own saturated
brine. Where the activity of water was measured, the curve tells which heat crystals give off in the liquor
that they grow in.
"""

from __future__ import annotations

from typing import Any

import jax
import jax.numpy as jnp

from granum.materials.activities import ElectrolyteActivity, SucroseActivity
from granum.materials.formulas.activity import WATER, enthalpy_of_dissolution_williamson
from granum.materials.solutes import REFERENCE, Branch, SoluteSystem

FROM_END = 5.0  # K: the end of a curve through points has no slope to trust
STRONG = 1.0  # mol/kg, below which heats of dilution are smaller than what a slope is uncertain by


def place(branch: Branch) -> float:
    """The temperature nearest to 25 °C at which a curve has a slope, K."""
    low, high = branch.law.low, branch.law.high
    if high - low <= 2.0 * FROM_END:
        return 0.5 * (low + high)
    return min(max(REFERENCE, low + FROM_END), high - FROM_END)


def is_measured(system: SoluteSystem) -> bool:
    """Whether the activity of water over the solutions was measured, so that the slope can be trusted."""
    return isinstance(system.activity_law, (ElectrolyteActivity, SucroseActivity))


def enthalpy_of_dissolution(system: SoluteSystem, branch: Branch, T: Any) -> tuple[Any, Any]:
    """Of a mole in its saturated solution, J/mol, and the molality of that."""

    def molality(t: Any) -> Any:
        return branch.inside(t) / system.molar_mass

    def activity(m: Any) -> Any:
        return jnp.log(system.activity_law(T, m * system.molar_mass))

    m, rise = jax.value_and_grad(molality)(T)
    osmotic_slope = -jax.grad(activity)(m) / WATER
    bound = branch.solvent_ratio * system.molar_mass / system.solvent.molar_mass
    return enthalpy_of_dissolution_williamson.function(T, m, rise / m, osmotic_slope, bound), m
