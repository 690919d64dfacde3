"""Pressure and temperature at which the mother liquor of a crystallizer boils."""

from __future__ import annotations

from typing import Any

import equinox as eqx
import jax
import jax.numpy as jnp

from granum.core.errors import CaseError
from granum.core.flags import unsolved
from granum.core.i18n import _
from granum.crystallization.equipment.beside import solubility_beside, water_activity_beside
from granum.crystallization.equipment.roles import Roles, feed_of
from granum.crystallization.vessels.crystals import crystals_at
from granum.crystallization.vessels.msmpr import saturated_liquor
from granum.materials.brines import DRIEST
from granum.materials.fluids import Fluid
from granum.numerics import find_root
from granum.numerics.smooth import safe_divide
from granum.streams.from_materials import activity_laws
from granum.streams.mixture import Mixture
from granum.streams.stream import Stream

ROUNDS = 5  # of what a liquor holds as it thickens
SPAN = 80.0  # K above the boiling point of the solvent within which a solution is sought that boils
NOT_FOUND = "No temperature was found at which the saturated solution boils: check pressure and solubility."


class Boiling(eqx.Module):
    """Of the solution saturated with the crystal's solute. The elevation follows from the water activity of
    the library, from two coefficients over the mass fraction of solute, or is none (``law`` and
    ``coefficients`` both None).
    """

    solvent: Fluid
    solubility: Any
    law: Any
    coefficients: tuple[Any, Any] | None

    @property
    def elevated(self) -> bool:
        """Whether anything is known of the elevation."""
        return self.law is not None or self.coefficients is not None

    def pressure(self, temperature: Any) -> Any:
        """Over the solution, Pa."""
        psat, T = self.solvent.vapor_pressure.value, jnp.asarray(temperature, dtype=float)
        ratio = self.solubility(T)
        if self.coefficients is not None:
            w = safe_divide(ratio, 1.0 + ratio, 0.0)
            return psat(T - self.coefficients[0] * w - self.coefficients[1] * w**2)
        return psat(T) if self.law is None else psat(T) * self.law(T, ratio)

    def pure(self, pressure: Any) -> Any:
        """Temperature at which the solvent alone boils, K."""
        return self.solvent.boiling_temperature(pressure)

    def temperature(self, pressure: Any, card: Any) -> Any:
        """At which the solution boils, K."""
        low = self.pure(pressure)
        goal = jnp.log(jnp.asarray(pressure, dtype=float))
        root = find_root(
            lambda T, y: jnp.log(self.pressure(T)) - y, low - 1.0, low + SPAN, goal, start=low + 2.0
        )
        unsolved(root.converged, card, reason=NOT_FOUND)
        return root.value


def boiling_of(
    mixture: Mixture, found: Roles, solubility: Any, given: tuple[Any, Any], needed: bool
) -> Boiling | None:
    """How the mother liquor of a mixture boils; None where its solvent is not in the library. What is
    ``needed`` and cannot be known is refused.
    """
    name = mixture.liquids[found.solvent].name
    same = found.vapor is not None and mixture.gases[found.vapor].name == name
    if not same or name not in mixture.materials.names("fluid"):
        if needed:
            raise CaseError(
                _(
                    "The boiling temperature at a pressure needs a solvent of the library, as liquid and as "
                    "gas, not '{solvent}': give the temperature."
                ).format(solvent=name)
            )
        return None
    law, coefficients = None, None
    if any(part is not None for part in given):
        linear, quadratic = (0.0 if part is None else part for part in given)
        coefficients = (linear, quadratic)
    elif found.solvent == 0:
        law = activity_laws(mixture)[found.solute - 1]
    if needed and law is None and coefficients is None:
        raise CaseError(
            _(
                "The library has no water activity of {solutes}: give 'elevation_linear' and "
                "'elevation_quadratic', the boiling-point elevation over the mass fraction of what is "
                "dissolved."
            ).format(solutes=mixture.liquids[found.solute].name)
        )
    return Boiling(mixture.materials.fluid(name), solubility, law, coefficients)


def flashed(feed: Stream, found: Roles, heat: Any, temperature: Any, left: Any = None) -> tuple[Any, Any]:
    """Solvent that feed and heat (W) evaporate at a temperature, kg/s, and what is added to it per kg of
    crystals formed. Where mixing has a heat, that of the liquor which stays is taken from one of the same
    composition, ``left``.
    """
    mixture, T = feed.mixture, temperature
    liquid, solid, gas = (mixture.enthalpies(phase, T) for phase in ("liquids", "solids", "gases"))
    latent = gas[found.vapor] - liquid[found.solvent]
    x = found.solute_fraction
    released = x * liquid[found.solute] + (1.0 - x) * liquid[found.solvent] - solid[found.solid]
    given = feed.enthalpy_flow - feed.enthalpy_at(T) + heat
    if mixture.mixing is None:
        return given / latent, released / latent
    places = jnp.array([found.solute, found.solvent])

    def mixed(pair: Any) -> Any:
        return mixture.heat_of_mixing(left.at[places].set(pair), T)

    held, (by_solute, by_solvent) = jax.value_and_grad(mixed)(left[places])
    missing = (feed.liquid - left)[places]
    given += mixture.heat_of_mixing(feed.liquid, T) - held - missing[0] * by_solute - missing[1] * by_solvent
    latent -= by_solvent
    return given / latent, (released + x * by_solute + (1.0 - x) * by_solvent) / latent


def settled_liquor(feed: Stream, found: Roles, soluble: Any, heat: Any, temperature: Any) -> Any:
    """Liquids left of a feed that has flashed at a temperature until its liquor is saturated, kg/s."""
    entering, x, left = feed_of(feed, found), found.solute_fraction, feed.liquid
    total = jnp.sum(entering.crystals)
    solute = entering.solute + x * total
    for _round in range(ROUNDS if feed.mixture.mixing is not None else 1):
        first, per_crystal = flashed(feed, found, heat, temperature, left)
        bound = 1.0 - x + per_crystal
        solvent = entering.solvent - jnp.clip(first, 0.0, DRIEST * entering.solvent) + bound * total
        saturated, _at = saturated_liquor(soluble, temperature, solute, solvent, x, bound)
        crystals = jnp.maximum(crystals_at(solute, solvent, saturated, x, bound), 0.0)
        staying = jnp.maximum(solvent - bound * crystals, 1e-3 * entering.solvent)
        left = feed.liquid.at[found.solute].set(solute - x * crystals).at[found.solvent].set(staying)
    return left


def temperature_beside(
    law: Boiling, feed: Stream, found: Roles, pressure: Any, heat: Any, card: Any
) -> Any | None:
    """Temperature (K) at which the liquor boils that a flash leaves of a feed, with the other salts as
    concentrated as they are then; None where there are none, or what they do is not known.
    """
    mixture = feed.mixture
    if water_activity_beside(mixture, found, feed.liquid, feed.temperature) is None:
        return None
    goal = jnp.log(jnp.asarray(pressure, dtype=float))

    def excess(T: Any, goal: Any) -> Any:
        soluble = solubility_beside(law.solubility, mixture, found, feed.liquid, T)
        liquid = settled_liquor(feed, found, soluble, heat, T)
        activity = water_activity_beside(mixture, found, liquid, T)
        return jnp.log(law.solvent.vapor_pressure.value(T)) + jnp.log(activity) - goal

    low = law.pure(pressure)
    root = find_root(excess, low - 1.0, low + SPAN, goal, start=low + 2.0)
    unsolved(root.converged, card, reason=NOT_FOUND)
    return root.value
