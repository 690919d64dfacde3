"""Two salts with a common ion: where both are saturated, and the isotherm between the salts alone."""

from __future__ import annotations

from typing import Annotated, Any, NamedTuple

import jax
import jax.numpy as jnp
import numpy as np

from granum.core import procedure
from granum.core.kinds import MassFraction, Molality, Pressure, Series, Temperature, WaterActivity
from granum.materials.common_ion import CommonIon, common_ion
from granum.materials.library import session

POINTS = 25
STAGES = 60  # points of a path at one temperature, or between two


class InvariantPoint(NamedTuple):
    """A solution saturated with both salts."""

    molality_first: Molality
    molality_second: Molality
    solute_mass_fraction_first: MassFraction
    solute_mass_fraction_second: MassFraction
    molality_first_alone: Molality
    molality_second_alone: Molality
    water_activity: WaterActivity
    pressure: Pressure


class Isotherm(NamedTuple):
    """Saturated solutions from one salt alone over the invariant point to the other, as mass fractions."""

    first: Annotated[MassFraction, Series("points")]
    second: Annotated[MassFraction, Series("points")]
    corner: int


class Path(NamedTuple):
    """What a liquor goes through: boiled at one temperature until it is saturated with both salts (or with
    the only one), then cooled; mass fractions, and where cooling begins.
    """

    first: np.ndarray
    second: np.ndarray
    boiled: int


def fractions(pair: CommonIon, first: np.ndarray, second: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Mass fractions of both salts from their molalities."""
    a, b = (np.asarray(m) * M for m, M in zip((first, second), pair.molar_masses, strict=True))
    return a / (1.0 + a + b), b / (1.0 + a + b)


def parted(pair: CommonIon, temperature: Any, first: Any, second: Any) -> tuple[Any, Any]:
    """Molalities left in solution at equilibrium of what there is per kilogram of water, in solution and
    crystals: both at the invariant point, one saturated beside the other, or all dissolved.
    """
    both = pair.invariant(temperature)
    left_first = pair.room(temperature, 0, jnp.minimum(second, both[1]))
    left_second = pair.room(temperature, 1, jnp.minimum(first, both[0]))
    full = (first >= both[0]) & (second >= both[1])
    one = jnp.where(full, both[0], jnp.minimum(first, left_first))
    other = jnp.where(full, both[1], jnp.minimum(second, left_second))
    return one, other


def isotherm(pair: CommonIon, temperature: float) -> Isotherm:
    """The two saturation lines at a temperature."""
    one, other = (float(m) for m in pair.invariant(temperature))
    beside_second = np.linspace(0.0, other, POINTS)
    beside_first = np.linspace(one, 0.0, POINTS)
    first = np.asarray(jax.vmap(lambda m: pair.room(temperature, 0, m))(jnp.asarray(beside_second)))
    second = np.asarray(jax.vmap(lambda m: pair.room(temperature, 1, m))(jnp.asarray(beside_first)))
    x, y = fractions(pair, np.append(first, beside_first), np.append(beside_second, second))
    return Isotherm(x, y, POINTS - 1)


def crystallization_path(pair: CommonIon, first: float, second: float, hot: float, cold: float) -> Path:
    """The way of a liquor from its mass fractions on; the crystals are taken off before it is cooled."""
    water = 1.0 - first - second
    fed = np.array([first, second]) / np.asarray(pair.molar_masses) / water
    ends = np.asarray(pair.invariant(hot)) if fed.min() > 0.0 else np.asarray(pair.alone(hot))
    thicker = max(float(end / m) for end, m in zip(ends, fed, strict=True) if m > 0.0)
    left = jax.vmap(lambda temperature, m: jnp.stack(parted(pair, temperature, m[0], m[1])))
    scales = np.geomspace(1.0, max(thicker, 1.0), STAGES)
    boiled = np.asarray(left(jnp.full(STAGES, hot), jnp.asarray(scales[:, None] * fed)))
    cooled = np.asarray(left(jnp.linspace(hot, cold, STAGES), jnp.tile(boiled[-1], (STAGES, 1))))
    x, y = fractions(pair, *np.append(boiled, cooled, axis=0).T)
    return Path(np.append(first, x), np.append(second, y), STAGES)


@procedure(
    source="greenberg1989; mullin2001, ch. 4",
    title="Invariant point of two salts with a common ion",
    typical={"temperature": (273.15, 373.15)},
)
def invariant_point(
    temperature: Temperature, first_salt: str = "sodium chloride", second_salt: str = "potassium chloride"
) -> InvariantPoint:
    """Solution that is saturated with two salts at once: molalities, mass fractions, water activity and the
    pressure of water over it.

    Each salt alone dissolves as in the library; what they do to each other follows from Pitzer's equations.
    On evaporation every solution of the two ends here. Sodium and potassium chloride.

    >>> out = invariant_point(temperature="25 degC")
    >>> round(100 * out.solute_mass_fraction_first, 1)
    20.8
    """
    pair = common_ion(first_salt, second_salt)
    one, other = (float(m) for m in pair.invariant(temperature))
    x, y = fractions(pair, np.asarray(one), np.asarray(other))
    alone = pair.alone(temperature)
    activity = float(pair.water_activity(temperature, one, other))
    water = session().fluid("water").vapor_pressure.value(jnp.asarray(temperature, dtype=float))
    return InvariantPoint(
        one, other, float(x), float(y), float(alone[0]), float(alone[1]), activity, activity * float(water)
    )
