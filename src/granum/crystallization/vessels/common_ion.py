"""Two salts with a common ion, or the four of a reciprocal pair: where they are saturated, which crystal
forms first, and the isotherms.
"""

from __future__ import annotations

from itertools import combinations
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
from granum.materials.formulas.activity import WATER
from granum.materials.library import session
from granum.numerics import find_root

POINTS = 41
STAGES = 60  # points of a path at one temperature, or between two
CLOSER = 4  # times that a border between two fields is looked at closer, by so many points each
NEWTON, STRIDE = 60, 0.3  # steps to a solution saturated with three crystals, and the longest of a logarithm
FOUND = 1e-8  # how near to saturation such a solution is
SATURATED = 1e-6  # logarithm of a saturation ratio that counts as none
# saturation is sought from so much, in mol of charge per kg of water, to so many times the solubility of the
# salt alone that comes to its own first, or more where that is not yet saturated; far beyond, the equations
# turn back
THINNEST, THICKER, THICKEST = 1e-3, 1.6, 2.6


class InvariantPoint(NamedTuple):
    """A solution saturated with two crystals, by name."""

    crystal: str
    crystal_next: str
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


class BrineSaturation(NamedTuple):
    """How near a brine is to saturation: the two crystals that are nearest, and the double salt that is."""

    crystal: str
    saturation_ratio: PositiveNumber
    crystal_next: str
    saturation_next: Ratio
    crystal_double: str
    saturation_double: Ratio
    water_activity: WaterActivity


class ReciprocalSaturation(NamedTuple):
    """A solution of two cations and two anions where its first crystal forms."""

    crystal: str
    crystal_next: str
    water_per_salt: Ratio
    water_activity: WaterActivity
    saturation_next: Ratio


class Isotherm(NamedTuple):
    """Saturated solutions from one salt alone over the invariant points to the other, as mass fractions, the
    places of these points, and of each the crystal by its place in the brine.
    """

    first: Annotated[MassFraction, Series("points")]
    second: Annotated[MassFraction, Series("points")]
    corners: tuple[int, ...]
    crystals: np.ndarray


class Border(NamedTuple):
    """Where the fields of two crystals of two salts meet: their places in the brine, molalities of the salts,
    and the share of the second.
    """

    crystals: tuple[int, int]
    molalities: np.ndarray
    share: float


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
        most = jnp.min(jnp.where(there > 0.0, alone / jnp.where(there > 0.0, there, 1.0), jnp.inf))
        thick = jnp.max(of(ions, THICKER * most)) >= 0.0
        most = jnp.log(jnp.where(thick, THICKER, THICKEST) * most)
        root = find_root(lambda t: jnp.max(of(ions, jnp.exp(t))), jnp.log(THINNEST), most)
        return jnp.exp(root.value), of(ions, jnp.exp(root.value))

    return jax.vmap(one)(directions)


def _along(pair: Brine, temperature: float, low: float, high: float) -> tuple[Any, Any, Any]:
    """Shares of the second salt, molalities of both where the first crystal forms, and the saturations."""
    shares = np.linspace(low, high, POINTS)
    parts = np.stack([1.0 - shares, shares], axis=-1)
    scale, ratios = _saturated(pair, temperature, jnp.asarray(parts @ pair.ions_per_salt[:2]))
    return shares, parts * np.asarray(scale)[:, None], np.asarray(ratios)


def _met(pair: Brine, temperature: float, found: tuple[Any, Any, Any], deep: int) -> list[Border]:
    """Borders of fields between neighbours of a row of saturated solutions, of those that were found."""
    shares, molalities, ratios = found
    known = np.isfinite(ratios).all(axis=1)
    first, borders = np.argmax(ratios, axis=1), []
    for i in np.flatnonzero(np.diff(first) * known[:-1] * known[1:]):
        if deep:
            inside = _along(pair, temperature, shares[i], shares[i + 1])
            borders += _met(pair, temperature, inside, deep - 1)
            continue
        one, other = int(first[i]), int(first[i + 1])
        ahead = ratios[i : i + 2, one] - ratios[i : i + 2, other]
        t = ahead[0] / (ahead[0] - ahead[1])
        there = (1.0 - t) * molalities[i] + t * molalities[i + 1]
        borders.append(Border((one, other), there, float((1.0 - t) * shares[i] + t * shares[i + 1])))
    return borders


def borders(pair: Brine, temperature: float) -> list[Border]:
    """Solutions saturated with two crystals, from the first salt to the second."""
    return _met(pair, temperature, _along(pair, temperature, 0.0, 1.0), CLOSER)


def driest(pair: Brine, temperature: float) -> Border:
    """That of these over which there is least water vapor: boiling ends here."""
    found = borders(pair, temperature)
    if not found:
        raise ConvergenceError(_("No solution was found that is saturated with two crystals."))
    ions = jnp.asarray(np.array([b.molalities for b in found]) @ pair.ions_per_salt)
    activities = [float(pair.water_activity(jnp.asarray(temperature), m)) for m in ions]
    return found[int(np.argmin(activities))]


def isotherm(pair: Brine, temperature: float) -> Isotherm:
    """The saturation lines at a temperature."""
    line = _along(pair, temperature, 0.0, 1.0)
    met = _met(pair, temperature, line, CLOSER)
    shares = np.append(line[0], [b.share for b in met])
    order = np.argsort(shares, kind="stable")
    molalities = np.append(line[1], np.array([b.molalities for b in met]).reshape(-1, 2), axis=0)[order]
    crystals = np.append(np.argmax(line[2], axis=1), [b.crystals[0] for b in met])[order]
    corners = np.flatnonzero(order >= POINTS)
    x, y = fractions(pair, *molalities.T)
    return Isotherm(x, y, tuple(int(i) for i in corners), crystals)


def _boiled_to(pair: Brine, fed: np.ndarray, end: Border) -> float:
    """How many times less water there is once a liquor, all of one crystal that it has formed still there, is
    saturated with two.
    """
    ways = [1.0]
    for form in (pair.crystals[k] for k in end.crystals):
        taken = np.array(form.salts) - WATER * form.water * end.molalities
        table = np.stack([fed, -taken], axis=-1)
        if abs(np.linalg.det(table)) > 1e-12:
            thicker, formed = np.linalg.solve(table, end.molalities)
            ways += [float(thicker)] if formed >= 0.0 else []
    return max(ways)


def crystallization_path(pair: Brine, first: float, second: float, hot: float, cold: float) -> Path:
    """The way of a liquor from its mass fractions on; the crystals are taken off before it is cooled."""
    water = 1.0 - first - second
    fed = np.array([first, second]) / pair.molar_masses / water
    if fed.min() > 0.0:
        thicker = _boiled_to(pair, fed, driest(pair, hot))
    else:
        alone = np.asarray(pair.alone(jnp.asarray(hot)))
        thicker = max(float(end / m) for end, m in zip(alone, fed, strict=True) if m > 0.0)
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
    logs = np.asarray(ratios)
    threes = np.array(list(combinations(range(len(salts.crystals)), 3)))
    # each from the solution that is nearest to saturation with all three
    nearest = np.argmax(np.min(np.nan_to_num(logs, nan=-np.inf)[:, threes], axis=2), axis=0)
    begun = jnp.log(jnp.asarray(directions * np.asarray(scale)[:, None])[nearest] + SATURATED)
    corners, off = (np.asarray(x) for x in _three(salts, temperature, jnp.asarray(threes), begun))
    first = np.argmax(logs, axis=1)
    square = (points, points)
    unique = np.unique(np.round(ion_shares(salts, corners[off < FOUND]), 6), axis=0)
    return Diagram(shares, first.reshape(square), water.reshape(square), unique)


@begun
def _three(salts: Brine, temperature: Any, threes: Any, start: Any) -> tuple[Any, Any]:
    """Molalities saturated with three crystals, and by how much they are not, or are beyond another."""
    positive, negative = (jnp.asarray(z, dtype=float) for z in salts.charges)
    charges = jnp.append(positive, -negative)

    def one(three: Any, x: Any) -> tuple[Any, Any]:
        def off(x: Any) -> Any:
            m = jnp.exp(x)
            return jnp.append(salts.saturation(temperature, m)[three], charges @ m)

        def step(_pass: Any, x: Any) -> Any:
            return x - jnp.clip(jnp.linalg.solve(jax.jacfwd(off)(x), off(x)), -STRIDE, STRIDE)

        x = jax.lax.fori_loop(0, NEWTON, step, x)
        over = jnp.max(salts.saturation(temperature, jnp.exp(x)))
        worst = jnp.maximum(jnp.max(jnp.abs(off(x))), over)
        return jnp.exp(x), jnp.where(jnp.isfinite(worst), worst, jnp.inf)

    return jax.vmap(one)(threes, start)


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
    """Solution that is saturated with two crystals at once: which, molalities, mass fractions, water activity
    and the pressure of water over it.

    Each salt alone dissolves as in the library; what they do to each other follows from Pitzer's equations.
    Where a double salt has a field of its own there are two such solutions, and this is that with less water
    over it, where boiling ends. Sodium, potassium, magnesium and calcium chloride; chloride and sulfate of
    one of the first three; two sulfates of these; at room temperature nitrate and chloride of sodium or
    potassium, sodium and potassium nitrate.

    >>> out = invariant_point(temperature="25 degC")
    >>> round(100 * out.solute_mass_fraction_first, 1)
    20.8
    """
    pair = pair_of(first_salt, second_salt)
    T = jnp.asarray(temperature, dtype=float)
    found = driest(pair, float(temperature))
    ions = jnp.asarray(found.molalities @ pair.ions_per_salt)
    pair.heard(T, ions)
    one, other = (float(m) for m in found.molalities)
    x, y = fractions(pair, np.asarray(one), np.asarray(other))
    alone = pair.alone(T)
    activity = float(pair.water_activity(T, ions))
    water = session().fluid(SOLVENT).vapor_pressure.value(T)
    first, following = (pair.crystals[k] for k in found.crystals)
    return InvariantPoint(
        first.name,
        following.name,
        one,
        other,
        float(x),
        float(y),
        float(alone[0]),
        float(alone[1]),
        activity,
        activity * float(water),
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


@procedure(
    source="harvie1984; greenberg1989; pabalan1987",
    title="Saturation of a brine with its salts and double salts",
    typical={
        "temperature": (288.15, 308.15),
        "solute_per_solvent_first": (0.0, 0.3),
        "solute_per_solvent_second": (0.0, 0.3),
        "solute_per_solvent_third": (0.0, 0.3),
    },
)
def brine_saturation(
    temperature: Temperature,
    solute_per_solvent_first: MassRatio,
    solute_per_solvent_second: MassRatio = 0.0,
    solute_per_solvent_third: MassRatio = 0.0,
    first_salt: str = "potassium chloride",
    second_salt: str = "magnesium chloride",
    third_salt: str = "",
) -> BrineSaturation:
    """Saturation ratio of the crystals that come nearest to it in a brine of up to three salts, and of the
    double salt that does: glaserite, carnallite, kainite, schoenite, leonite or bloedite.

    The ratio is per ion: its power by how many ions are in a mole of the crystal is the activity product over
    the solubility product. Beyond one the crystal forms. Two cations and two anions at most of sodium,
    potassium, magnesium and calcium, chloride, sulfate (not of calcium) and, with sodium and potassium at
    room temperature, nitrate. No double salt: its ratio is zero.

    >>> out = brine_saturation("25 degC", 0.02, 0.47)
    >>> out.crystal, bool(out.saturation_ratio > 1.0)
    ('carnallite', True)
    """
    given = {first_salt: solute_per_solvent_first, second_salt: solute_per_solvent_second}
    given |= {third_salt: solute_per_solvent_third} if third_salt else {}
    names = list(given)
    salts, T = brine(names), jnp.asarray(temperature, dtype=float)
    ratios = np.array([float(x) for x in given.values()])
    ions = jnp.asarray(ratios / salts.molar_masses[: len(names)] @ salts.ions_per_salt[: len(names)])
    salts.heard(T, ions)
    found = np.exp(np.asarray(salts.saturation(T, ions)))
    first, following = np.argsort(-found)[:2]
    doubles = [k for k, c in enumerate(salts.crystals) if c.double is not None]
    double = max(doubles, key=lambda k: found[k], default=None)
    return BrineSaturation(
        salts.crystals[first].name,
        float(found[first]),
        salts.crystals[following].name,
        float(found[following]),
        "" if double is None else salts.crystals[double].name,
        0.0 if double is None else float(found[double]),
        float(salts.water_activity(T, ions)),
    )
