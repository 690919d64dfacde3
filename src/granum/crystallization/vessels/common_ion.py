"""Two salts with a common ion, or the four of a reciprocal pair: where they are saturated, which crystal
forms first, and the isotherms.
"""

from __future__ import annotations

from typing import Annotated, Any, NamedTuple

import jax
import jax.numpy as jnp
import numpy as np

from granum.core import procedure
from granum.core.compiling import begun
from granum.core.errors import ApplicabilityError, ConvergenceError, InputError
from granum.core.i18n import _
from granum.core.kinds import (
    KINDS,
    Fraction,
    MassFraction,
    MassRatio,
    Molality,
    PositiveNumber,
    Pressure,
    Ratio,
    Series,
    Temperature,
    WaterActivity,
)
from granum.core.units import show
from granum.materials.brines import SOLVENT, Brine, Equilibrium, brine
from granum.materials.library import session
from granum.numerics import find_root

POINTS = 41
STAGES = 60  # points of a path at one temperature, or between two
SURPLUS = 3.0  # times the solubility of each salt alone, so that all are there as crystals
SATURATED = 1e-6  # logarithm of a saturation ratio that counts as none
# saturation is sought from so much, in mol of charge per kg of water, to so many times the solubility of the
# salt alone that comes to its own first; far beyond, the equations turn back
THINNEST, THICKER = 1e-3, 1.6


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


class SolubilityBeside(NamedTuple):
    """A solution saturated with one salt beside another."""

    crystal: str
    solubility_per_solvent: MassRatio
    solubility_per_solvent_alone: MassRatio
    saturation_second: PositiveNumber
    water_activity: WaterActivity


class ReciprocalSaturation(NamedTuple):
    """A solution of two cations and two anions where its first crystal forms."""

    crystal: str
    crystal_next: str
    water_per_salt: Ratio
    water_activity: WaterActivity
    saturation_next: Ratio


class Isotherm(NamedTuple):
    """Saturated solutions from one salt alone over the invariant point to the other, as mass fractions, the
    place of that point, and of each the crystal by its place in the brine.
    """

    first: Annotated[MassFraction, Series("points")]
    second: Annotated[MassFraction, Series("points")]
    corner: int
    crystals: np.ndarray


class Path(NamedTuple):
    """What a liquor goes through: boiled at one temperature until it is saturated with both salts (or with
    the only one), then cooled; mass fractions, and where cooling begins.
    """

    first: np.ndarray
    second: np.ndarray
    boiled: int


class Diagram(NamedTuple):
    """An isotherm of a reciprocal pair over the share of the second cation (columns) and of the second anion
    (rows) by charge: the first crystal by its place in the brine, water per kg of salts, and the solutions
    saturated with three.
    """

    shares: np.ndarray
    crystal: np.ndarray
    water: np.ndarray
    invariant: np.ndarray


def pair_of(first: str, second: str, materials: Any = None) -> Brine:
    """The brine of two salts that share an ion."""
    found = brine((first, second), materials)
    if len(found.ions) != 3:
        raise InputError(
            _("{first} and {second} share no ion: their diagram is that of a reciprocal pair.").format(
                first=first, second=second
            )
        )
    return found


def four_of(first: str, second: str, materials: Any = None) -> Brine:
    """The brine of two salts without a common ion."""
    found = brine((first, second), materials)
    if len(found.ions) != 4:
        raise InputError(
            _("{first} and {second} share an ion: their diagram is the triangle of two salts.").format(
                first=first, second=second
            )
        )
    return found


def fractions(pair: Brine, first: np.ndarray, second: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Mass fractions of both salts from their molalities."""
    a, b = (np.asarray(m) * M for m, M in zip((first, second), pair.molar_masses, strict=True))
    return a / (1.0 + a + b), b / (1.0 + a + b)


def molalities(pair: Brine, ions: Any) -> tuple[Any, Any]:
    """Of both salts from those of their ions: each has one of its own."""
    table, m = pair.ions_per_salt, np.asarray(ions)
    own = [int(np.argmax((table[k] > 0.0) & (table[1 - k] == 0.0))) for k in (0, 1)]
    return m[..., own[0]] / table[0, own[0]], m[..., own[1]] / table[1, own[1]]


@begun
def parted(salts: Brine, temperature: Any, ions: Any) -> Equilibrium:
    """Equilibrium of ions (mol) and a kilogram of water with all crystals of the brine."""
    return salts.equilibrium(temperature, jnp.ones(()), ions, tuple(range(len(salts.crystals))))


@begun
def liquors(salts: Brine, temperature: Any, ions: Any) -> Any:
    """What stays dissolved of several liquors."""
    return jax.vmap(lambda T, m: parted(salts, T, m).molalities)(temperature, ions)


@begun
def _saturated(salts: Brine, temperature: Any, directions: Any) -> tuple[Any, Any]:
    """How many times ions there must be in a kilogram of water for the first crystal to form, and the
    saturation of each then.
    """

    def of(ions: Any, scale: Any) -> Any:
        return salts.saturation(temperature, ions * scale)

    counts, alone = jnp.asarray(salts.ions_per_salt), salts.alone(temperature)

    def one(ions: Any) -> tuple[Any, Any]:
        there = jnp.min(jnp.where(counts > 0.0, ions / jnp.where(counts > 0.0, counts, 1.0), jnp.inf), axis=1)
        most = jnp.min(jnp.where(there > 0.0, THICKER * alone / jnp.where(there > 0.0, there, 1.0), jnp.inf))
        root = find_root(lambda t: jnp.max(of(ions, jnp.exp(t))), jnp.log(THINNEST), jnp.log(most))
        return jnp.exp(root.value), of(ions, jnp.exp(root.value))

    return jax.vmap(one)(directions)


def with_all(salts: Brine, temperature: float, which: tuple[int, ...]) -> Equilibrium:
    """The solution beside a surplus of some of the salts."""
    amounts = np.zeros(len(salts.salts))
    amounts[list(which)] = SURPLUS * np.asarray(salts.alone(jnp.asarray(temperature)))[list(which)]
    found = parted(salts, temperature, jnp.asarray(amounts @ salts.ions_per_salt))
    if not bool(found.found):
        raise ConvergenceError(_("No solution was found that is saturated with all salts."))
    return found


def isotherm(pair: Brine, temperature: float) -> Isotherm:
    """The saturation lines at a temperature."""
    both = np.asarray(with_all(pair, temperature, (0, 1)).molalities)
    one, other = molalities(pair, both)
    between = other / (one + other)
    shares = np.sort(np.append(np.linspace(0.0, 1.0, POINTS), between))
    table = pair.ions_per_salt
    directions = np.outer(1.0 - shares, table[0]) + np.outer(shares, table[1])
    scale, ratios = _saturated(pair, temperature, jnp.asarray(directions))
    t = np.asarray(scale)
    x, y = fractions(pair, (1.0 - shares) * t, shares * t)
    corner = int(np.searchsorted(shares, between))
    return Isotherm(x, y, corner, np.argmax(np.asarray(ratios), axis=1))


def crystallization_path(pair: Brine, first: float, second: float, hot: float, cold: float) -> Path:
    """The way of a liquor from its mass fractions on; the crystals are taken off before it is cooled."""
    water = 1.0 - first - second
    fed = np.array([first, second]) / pair.molar_masses / water
    if fed.min() > 0.0:
        ends = np.array(molalities(pair, with_all(pair, hot, (0, 1)).molalities))
    else:
        ends = np.asarray(pair.alone(jnp.asarray(hot)))
    thicker = max(float(end / m) for end, m in zip(ends, fed, strict=True) if m > 0.0)
    scales = np.geomspace(1.0, max(thicker, 1.0), STAGES)
    boiled = liquors(pair, jnp.full(STAGES, hot), jnp.asarray(scales[:, None] * (fed @ pair.ions_per_salt)))
    cooled = liquors(pair, jnp.linspace(hot, cold, STAGES), jnp.tile(boiled[-1], (STAGES, 1)))
    x, y = fractions(pair, *molalities(pair, np.append(boiled, cooled, axis=0)))
    return Path(np.append(first, x), np.append(second, y), STAGES)


def _directions(salts: Brine, cation: np.ndarray, anion: np.ndarray) -> np.ndarray:
    """Ions of one mole of charge of each sign, from the shares of the second of each."""
    (a, b), (c, d) = salts.charges
    return np.stack([(1.0 - cation) / a, cation / b, (1.0 - anion) / c, anion / d], axis=-1)


def ion_shares(salts: Brine, ions: Any) -> np.ndarray:
    """Shares of the second cation and of the second anion by charge."""
    charge = np.asarray(ions) * np.concatenate(salts.charges)
    return np.stack([charge[..., 1] / charge[..., :2].sum(-1), charge[..., 3] / charge[..., 2:].sum(-1)], -1)


def diagram(salts: Brine, temperature: float, points: int = POINTS) -> Diagram:
    """The isotherm of a reciprocal pair."""
    shares = np.linspace(0.0, 1.0, points)
    directions = _directions(salts, *np.meshgrid(shares, shares)).reshape(-1, 4)
    scale, ratios = _saturated(salts, temperature, jnp.asarray(directions))
    masses = _ion_masses(salts)
    water = 1.0 / (np.asarray(scale) * (directions @ masses))
    corners = []
    for absent in range(4):
        three = tuple(k for k in range(4) if k != absent)
        found = with_all(salts, temperature, three)
        there = {salts.crystals[i].salt for i, n in enumerate(np.asarray(found.crystals)) if n > 0.0}
        if len(there) == 3:
            corners.append(ion_shares(salts, found.molalities))
    first = np.argmax(np.asarray(ratios), axis=1)
    square = (points, points)
    unique = np.unique(np.round(np.array(corners).reshape(-1, 2), 6), axis=0)
    return Diagram(shares, first.reshape(square), water.reshape(square), unique)


def _ion_masses(salts: Brine) -> np.ndarray:
    """kg/mol of each ion."""
    masses = {p.cation: p.cation_mass for p in salts.parts} | {p.anion: p.anion_mass for p in salts.parts}
    return np.array([1e-3 * masses[i] for i in salts.ions])


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
    On evaporation every solution of the two ends here. Sodium and potassium chloride; chloride and sulfate of
    either; at room temperature nitrate and chloride of either, sodium and potassium nitrate.

    >>> out = invariant_point(temperature="25 degC")
    >>> round(100 * out.solute_mass_fraction_first, 1)
    20.8
    """
    pair = pair_of(first_salt, second_salt)
    T = jnp.asarray(temperature, dtype=float)
    found = with_all(pair, float(temperature), (0, 1))
    pair.heard(T, found.molalities)
    one, other = (float(m) for m in molalities(pair, found.molalities))
    x, y = fractions(pair, np.asarray(one), np.asarray(other))
    alone = pair.alone(T)
    activity = float(pair.water_activity(T, found.molalities))
    water = session().fluid(SOLVENT).vapor_pressure.value(T)
    return InvariantPoint(
        one, other, float(x), float(y), float(alone[0]), float(alone[1]), activity, activity * float(water)
    )


@procedure(
    source="greenberg1989; mullin2001, ch. 3",
    title="Solubility of a salt beside another",
    typical={"temperature": (273.15, 373.15), "solute_per_solvent_second": (0.0, 0.35)},
)
def solubility_beside_salt(
    temperature: Temperature,
    solute_per_solvent_second: MassRatio,
    first_salt: str = "potassium chloride",
    second_salt: str = "sodium chloride",
) -> SolubilityBeside:
    """How much of one salt dissolves beside another: its crystal, kilograms per kilogram of water beside so
    much of the other and alone, and how near the other is to its own solubility.

    The activities of its ions are those of the solution saturated with it alone, by Pitzer's equations; a
    common ion lowers a solubility, other ions raise it a little. All crystallizers with the solubility of the
    library take it beside the other salts of their liquor from here. A saturation ratio of the second salt
    beyond one says that it would crystallize too.

    >>> out = solubility_beside_salt(temperature="25 degC", solute_per_solvent_second=0.2)
    >>> bool(out.solubility_per_solvent < 0.7 * out.solubility_per_solvent_alone)
    True
    """
    pair, T = brine((first_salt, second_salt)), jnp.asarray(temperature, dtype=float)
    if pair.salts[0].name == pair.salts[1].name:
        raise InputError(_("'first_salt' and 'second_salt' are the same salt: name two."), name="second_salt")
    first, second = jnp.asarray(pair.ions_per_salt[:2])
    masses = pair.molar_masses
    others = float(solute_per_solvent_second) / masses[1] * second
    forms = [k for k, c in enumerate(pair.crystals) if c.salt == 0]
    found = [float(pair.solubility(T, others, k)) for k in forms]
    stable = int(np.argmin(found))
    there = others + found[stable] * first
    pair.heard(T, there)
    ratios = np.asarray(pair.saturation(T, there))
    if abs(ratios[forms[stable]]) > SATURATED:
        first_label, second_label = (session().label(system.name) for system in pair.salts[:2])
        raise ApplicabilityError(
            _(
                "Beside so much of {second} no solution is saturated with {first}: of {second} alone {most} "
                "dissolve here."
            ).format(
                first=first_label,
                second=second_label,
                most=show(float(pair.alone(T)[1] * masses[1]), KINDS["MassRatio"]),
            )
        )
    of_second = [r for r, c in zip(ratios, pair.crystals, strict=True) if c.salt == 1]
    return SolubilityBeside(
        pair.crystals[forms[stable]].name,
        found[stable] * masses[0],
        float(pair.alone(T)[0]) * masses[0],
        float(np.exp(max(of_second))),
        float(pair.water_activity(T, there)),
    )


@procedure(
    source="pitzer1974mixed; greenberg1989; mullin2001, ch. 4",
    title="First crystal of a reciprocal pair of salts",
    typical={"temperature": (288.15, 308.15), "cation_share": (0.0, 1.0), "anion_share": (0.0, 1.0)},
)
def reciprocal_saturation(
    temperature: Temperature,
    cation_share: Fraction,
    anion_share: Fraction,
    first_salt: str = "sodium nitrate",
    second_salt: str = "potassium chloride",
) -> ReciprocalSaturation:
    """Which crystal forms first when a solution of two cations and two anions loses water, how much water is
    left then per kilogram of salts, and which crystal is next.

    The shares are by charge: of the cation of the second salt among the cations, of its anion among the
    anions (Jänecke's coordinates). Sodium and potassium with nitrate and chloride, at room temperature.

    >>> reciprocal_saturation(temperature="25 degC", cation_share=0.5, anion_share=0.6).crystal
    'potassium nitrate'
    """
    salts = four_of(first_salt, second_salt)
    T = jnp.asarray(temperature, dtype=float)
    ions = _directions(salts, np.asarray(float(cation_share)), np.asarray(float(anion_share)))
    scale, ratios = _saturated(salts, float(temperature), jnp.asarray(ions)[None])
    order = np.argsort(-np.asarray(ratios[0]))
    first, following = (salts.crystals[k] for k in order[:2])
    salts.heard(T, scale[0] * jnp.asarray(ions))
    activity = salts.water_activity(T, scale[0] * jnp.asarray(ions))
    return ReciprocalSaturation(
        first.name,
        following.name,
        float(1.0 / (scale[0] * (ions @ _ion_masses(salts)))),
        float(activity),
        float(np.exp(ratios[0][order[1]])),
    )
