"""Water activity of the solutions of a solute system, so that they boil where they do.

Beyond the most concentrated solution that a source speaks of, the osmotic coefficient (or the activity
coefficient) keeps its last value: water activity then still falls with every gram of solute. It keeps its
value, too, beyond the temperatures of the source, so that boiling points follow Dühring's rule there.
"""

from __future__ import annotations

from typing import Any

import equinox as eqx
import jax.numpy as jnp
import numpy as np

from granum.core import flags
from granum.core.constants import GAS_CONSTANT
from granum.materials.correlation import Missing
from granum.materials.formulas.activity import (
    DISTANCE,
    SLOPE,
    TERMS,
    WATER,
    fading,
    osmotic_coefficient,
    osmotic_coefficient_pitzer,
    over_temperature,
    slope_over_temperature,
    solvent_activity_raoult,
    water_activity_osmotic,
    water_activity_starzak_peacock,
)
from granum.materials.formulas.caustic import STRONGEST, caustic_vapor_pressure_olsson, vapor_pressure

LEAST = 1e-12  # ionic strength below which a solution is much water
SLACK = 0.51  # K: the limits of the source are rounded


class ElectrolyteActivity(eqx.Module):
    """Pitzer's equation for one salt in water, with its parameters over temperature.

    ``most`` is the most concentrated solution behind them, mol per kg of water; ``exponents`` are those with
    which beta one and two fade; ``beside`` the same from another source, where the coefficients of ions upon
    each other go with that one.
    """

    molar_mass: float
    counts: tuple[float, float] = eqx.field(static=True)
    charges: tuple[float, float] = eqx.field(static=True)
    beta_zero: tuple[float, ...] = eqx.field(static=True)
    beta_one: tuple[float, ...] = eqx.field(static=True)
    c_phi: tuple[float, ...] = eqx.field(static=True)
    coldest: float = eqx.field(static=True)
    hottest: float = eqx.field(static=True)
    most: float = eqx.field(static=True)
    source: str = eqx.field(static=True)
    beta_two: tuple[float, ...] = eqx.field(static=True, default=(0.0,) * TERMS)
    exponents: tuple[float, float] = eqx.field(static=True, default=(2.0, 12.0))
    beside: ElectrolyteActivity | None = None
    is_missing = False

    def __call__(self, temperature: Any, solute_per_solvent: Any) -> Any:
        T, m = jnp.asarray(temperature), solute_per_solvent / self.molar_mass
        self.heard(T, m)
        t = jnp.clip(T, self.coldest, self.hottest)
        at = tuple(over_temperature(t, self._table(t)))[1:]
        within = jnp.clip(m, 0.0, self.most)
        phi = osmotic_coefficient(within, t, at, self.counts, self.charges, self.exponents)
        return water_activity_osmotic(m, phi, sum(self.counts))

    def heard(self, temperature: Any, molality: Any) -> None:
        """Flag a solution outside the temperatures or beyond the molality of the source."""
        T, m, key = jnp.asarray(temperature), molality, osmotic_coefficient_pitzer.card.key
        cold, hot = self.coldest, self.hottest
        outside = (m > 0.0) & ((cold - SLACK > T) | (hot + SLACK < T))
        flags.record(flags.EXTRAPOLATED, outside, T, "temperature", key, cold, hot, self.source)
        flags.record(flags.EXTRAPOLATED, m > self.most, m, "salt_molality", key, 0.0, self.most, self.source)

    def slopes(self, temperature: Any) -> Any:
        """With temperature, of the Debye–Hückel slope, beta zero, one, two and C: one row each."""
        return slope_over_temperature(temperature, self._table(temperature))

    def apparent_enthalpy(self, temperature: Any, molality: Any, slopes: Any = None) -> Any:
        """Of a mole of salt over that in much water, J/mol: by the slope of the excess Gibbs energy with
        temperature.
        """
        (p, q), (zc, za) = self.counts, self.charges
        T, m = jnp.asarray(temperature, dtype=float), molality
        slope, zero, one, two, c = self.slopes(T) if slopes is None else slopes
        strength = 0.5 * (p * zc**2 + q * za**2)
        root = jnp.sqrt(jnp.maximum(strength * m, LEAST))
        pairs = zero + sum(b * fading(a * root) for a, b in zip(self.exponents, (one, two), strict=True))
        triples = m * p * zc * c / (2.0 * (zc * za) ** 0.5)
        alone = -4.0 * slope * strength / DISTANCE * jnp.log1p(DISTANCE * root)
        return -GAS_CONSTANT * T**2 * (alone + 2.0 * m * p * q * (pairs + triples))

    def _table(self, temperature: Any) -> Any:
        """Terms × coefficients, to be multiplied with terms like the temperature."""
        sets = (SLOPE, self.beta_zero, self.beta_one, self.beta_two, self.c_phi)
        table = np.array([(*a, *[0.0] * TERMS)[:TERMS] for a in sets]).T
        return table.reshape(table.shape + (1,) * jnp.ndim(temperature))


class SucroseActivity(eqx.Module):
    """Starzak and Peacock's equation for sucrose in water."""

    molar_mass: float
    most = 0.4  # mole fraction: 93 % of sucrose by mass
    is_missing = False

    def __call__(self, temperature: Any, solute_per_solvent: Any) -> Any:
        moles = solute_per_solvent / self.molar_mass
        x = moles / (moles + 1.0 / WATER)
        inside = jnp.minimum(x, self.most)
        return water_activity_starzak_peacock(inside, temperature) * (1.0 - x) / (1.0 - inside)


class CausticActivity(eqx.Module):
    """Olsson's equation for sodium hydroxide in water."""

    coldest, hottest = 273.15, 473.15
    is_missing = False

    def __call__(self, temperature: Any, solute_per_solvent: Any) -> Any:
        T = jnp.asarray(temperature)
        key, source = caustic_vapor_pressure_olsson.card.key, caustic_vapor_pressure_olsson.source
        outside = (solute_per_solvent > 0.0) & ((self.coldest - SLACK > T) | (self.hottest + SLACK < T))
        flags.record(flags.EXTRAPOLATED, outside, T, "temperature", key, self.coldest, self.hottest, source)
        w = solute_per_solvent / (1.0 + solute_per_solvent)
        beyond = w > STRONGEST
        flags.record(flags.EXTRAPOLATED, beyond, w, "solute_mass_fraction", key, 0.0, STRONGEST, source)
        t, inside = jnp.clip(T, self.coldest, self.hottest), jnp.minimum(w, STRONGEST)
        over = [vapor_pressure(t, x) for x in (inside, 0.0 * inside)]
        further = jnp.maximum(solute_per_solvent * (1.0 - STRONGEST) / STRONGEST, 1.0)
        return jnp.exp(jnp.log(over[0] / over[1]) * further)


class IdealActivity(eqx.Module):
    """Raoult's law, for a solute that no better source was found for."""

    molar_mass: float
    molar_mass_solvent: float
    ions: float = eqx.field(static=True)
    is_missing = False

    def __call__(self, temperature: Any, solute_per_solvent: Any) -> Any:
        moles = solute_per_solvent / self.molar_mass
        return solvent_activity_raoult(moles / (moles + 1.0 / self.molar_mass_solvent), self.ions)


class NoActivity(eqx.Module):
    """Stands where a solute has no published water activity in the library."""

    missing: Missing
    is_missing = True

    def __call__(self, temperature: Any, solute_per_solvent: Any) -> Any:
        return self.missing(temperature)
