"""Two solutes that would crystallize together: a liquid that keeps one of them dissolved (extractive), or an
agent that takes one of them into crystals of its own (adductive).
"""

from __future__ import annotations

from typing import Annotated, NamedTuple

import jax.numpy as jnp

from granum.core import formula
from granum.core.constants import GAS_CONSTANT
from granum.core.kinds import (
    MassFraction,
    MassRatio,
    MoleFraction,
    Number,
    PositiveNumber,
    Ratio,
    Temperature,
    Within,
)
from granum.crystallization.kinds import OpenShare, PositiveMolarEnergy
from granum.numerics import find_root
from granum.numerics.smooth import safe_divide

Dissolved = Annotated[MassRatio, Within(1e-9, 20.0)]
NEAR_ALL = 1.0 - 1e-12
Substance = Annotated[MoleFraction, Within(1e-9, 1.0)]


class Extracted(NamedTuple):
    """Share of the wanted solute that crystallizes, its share of the crystals, the other solute among them
    per mass of original solvent, and the least share of added liquid that keeps the other dissolved.
    """

    yield_fraction: Number
    purity: MassFraction
    other_crystals_per_solvent: MassRatio
    added_fraction_least: MassFraction


@formula(
    source="yalkowsky1981; mullin2001, ch. 8",
    title="Extractive crystallization",
    equation=r"R = \frac{m_B}{C_B},\quad m_B = C_B - \frac{s_B^{1-w}\,S_B^{w}}{1-w},\quad "
    r"m_A = C_A - \frac{s_A^{1-w}\,S_A^{w}}{1-w},\quad w_P = \frac{m_B}{m_A+m_B}",
    typical={
        "solute_per_solvent": (0.2, 0.6),
        "other_per_solvent": (0.05, 0.4),
        "added_fraction": (0.1, 0.7),
        "solubility_per_solvent": (0.1, 0.5),
        "solubility_added": (0.005, 0.05),
        "other_solubility": (0.05, 0.4),
        "other_solubility_added": (0.3, 2.0),
    },
    symbols={"solute_per_solvent": "C_B", "solubility_per_solvent": "s_B"},
)
def extractive_crystallization(
    solute_per_solvent: Dissolved,
    other_per_solvent: Dissolved,
    added_fraction: OpenShare,
    solubility_per_solvent: Dissolved,
    solubility_added: Dissolved,
    other_solubility: Dissolved,
    other_solubility_added: Dissolved,
) -> Extracted:
    """What crystallizes of two solutes when a liquid is added that dissolves the other one well and the
    wanted one badly.

    Each solubility follows the log-linear law between the solvent and the added liquid, as if the other
    solute were not there: a simplification that holds for dilute solutions. Amounts count per mass of the
    original solvent. Nothing of the other solute crystallizes from ``added_fraction_least`` on.

    A balance by hand: half of the solvent is added liquid, so 2 kg of mixture hold 2·√(0.4·0.01) = 0.1265 kg
    of the wanted solute, of which there were 0.5 kg, and 2·√(0.2·1.0) = 0.894 kg of the other.

    >>> found = extractive_crystallization(0.5, 0.3, 0.5, 0.4, 0.01, 0.2, 1.0)
    >>> round(float(found.yield_fraction), 3), float(found.purity)
    (0.747, 1.0)
    """
    w = added_fraction

    def held(solvent: MassRatio, added: MassRatio, share: MassFraction) -> MassRatio:
        return jnp.exp((1.0 - share) * jnp.log(solvent) + share * jnp.log(added)) / (1.0 - share)

    wanted = jnp.maximum(solute_per_solvent - held(solubility_per_solvent, solubility_added, w), 0.0)
    other = jnp.maximum(other_per_solvent - held(other_solubility, other_solubility_added, w), 0.0)
    # diluting helps in any case; a liquid that dissolves the other solute badly hurts at first
    falls = jnp.log(other_solubility) - jnp.log(other_solubility_added)
    worst = jnp.where(falls > 1.0, 1.0 - 1.0 / jnp.maximum(falls, 1.0), 0.0)

    def over(share: MassFraction, given: MassRatio, solvent: MassRatio, added: MassRatio) -> Number:
        return jnp.log(given) - jnp.log(held(solvent, added, share))

    given = other_per_solvent, other_solubility, other_solubility_added
    crowded = over(worst, *given) > 0.0
    start = jnp.where(crowded, worst, 0.0)
    asked = (jnp.where(crowded, given[0], given[1]), given[1], jnp.where(crowded, given[2], given[1]))
    least = jnp.where(crowded, find_root(over, start, NEAR_ALL, *asked).value, 0.0)
    return Extracted(
        wanted / solute_per_solvent, safe_divide(wanted, wanted + other, otherwise=1.0), other, least
    )


class Adducted(NamedTuple):
    """Share of the substance that ends in its adduct, its mole fraction left in the liquid, and the agent
    bound per mole of the substance fed.
    """

    yield_fraction: Number
    mole_fraction_left: MoleFraction
    agent_per_substance: Ratio


@formula(
    source="redlich1950; mullin2001, ch. 8",
    title="Adductive crystallization",
    equation=r"R = \frac{x - x_r}{x\,(1-x_r)},\quad x_r = a_X^{-n}\exp\left[-\frac{\Delta H}{R_g}"
    r"\left(\frac{1}{T}-\frac{1}{T_d}\right)\right],\quad r_X = n\,R",
    typical={
        "mole_fraction": (0.05, 0.5),
        "temperature": (273.15, 320.0),
        "decomposition_temperature": (340.0, 400.0),
        "heat_of_adduct": (2e4, 1e5),
        "agent_ratio": (1.0, 15.0),
        "agent_activity": (0.7, 1.0),
    },
)
def adductive_crystallization(
    mole_fraction: Substance,
    temperature: Temperature,
    decomposition_temperature: Temperature,
    heat_of_adduct: PositiveMolarEnergy,
    agent_ratio: Annotated[PositiveNumber, Within(0.1, 100.0)],
    agent_activity: Annotated[PositiveNumber, Within(1e-6, 1.0)] = 1.0,
) -> Adducted:
    """How much of one substance of a liquid an agent takes into crystals of their compound, as urea takes
    straight paraffins and hydroquinone takes methanol, while the other substances stay.

    The liquid mixes ideally and dissolves no agent, whose activity is one while crystals of it remain. The
    heat, per mole of the pure liquid substance, is constant; ``decomposition_temperature`` is where the
    adduct falls apart into that liquid and solid agent. Heating the crystals above it gives both back. The
    papers named were not opened; the law is derived as Schröder and van Laar's is for a melt.

    By hand: ten degrees below 373.15 K with 60 kJ/mol, x_r = exp(−7216.6·(1/363.15 − 1/373.15)) = 0.587.

    >>> found = adductive_crystallization(0.8, 363.15, 373.15, 6e4, 12.5)
    >>> round(float(found.mole_fraction_left), 3), round(float(found.yield_fraction), 3)
    (0.587, 0.645)
    """
    inverse = 1.0 / temperature - 1.0 / decomposition_temperature
    exponent = -heat_of_adduct / GAS_CONSTANT * inverse - agent_ratio * jnp.log(agent_activity)
    left = jnp.minimum(jnp.exp(jnp.minimum(exponent, 0.0)), mole_fraction)
    forms = left < mole_fraction
    part = jnp.where(
        forms, (mole_fraction - left) / (mole_fraction * (1.0 - jnp.where(forms, left, 0.0))), 0.0
    )
    return Adducted(part, left, agent_ratio * part)


@formula(
    source="smith1952",
    title="Urea in the adduct of a straight paraffin",
    equation=r"n = 0.6848\,(N-1) + 2.181",
    output="agent_ratio",
    typical={"carbon_atoms": (7.0, 32.0)},
)
def agent_ratio_urea(carbon_atoms: Annotated[PositiveNumber, Within(6.0, 60.0)]) -> PositiveNumber:
    """Molecules of urea around each molecule of a straight paraffin in their adduct.

    Six molecules of urea line 11.01 Å of a channel in which chains of 1.256 Å per bond lie end to end, 4.0 Å
    apart. Chains below six carbon atoms form none at room temperature. The coefficients are recalled; the
    channel gives them again within 0.2 %, and urea weighed per carbon atom lies around them.

    >>> round(agent_ratio_urea(16), 2)
    12.45
    """
    return 0.6848 * (carbon_atoms - 1.0) + 2.181
