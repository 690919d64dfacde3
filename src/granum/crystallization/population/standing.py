"""The steady population of a mixed vessel in which crystals grow, agglomerate and break.

Newborn come in at the ends of the classes, shared between the two around them so that their number and
volume are kept (fixed pivots). From there on the population falls exponentially in size, exactly, so that
growth adds no numerical diffusion and nuclei without collisions are those of the ideal vessel whatever the
classes.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import equinox as eqx
import jax.numpy as jnp
import numpy as np

from granum.crystallization.population.grid import Collisions, events, sorted_into
from granum.numerics.smooth import safe_divide

CLASSES = 64
FINEST, COARSEST = 0.1, 40.0  # of the growth in one residence time
WIDEST = 1e3  # m, end of the last class, which is open
STILL = 1e-15  # m, for a growth length of nothing
SLOPES = 0.5, 0.9, 1.0  # of what meets, the last one that leads to no fewer crystals than none
LESS = 1e-9  # of the most in a class, below nothing
SPENT = 600.0  # exponent beyond which nothing survives
NODES, WEIGHTS = (0.5 * v for v in np.polynomial.legendre.leggauss(8))
NODES = NODES + 0.5


class Outflow(eqx.Module):
    """How fast each size leaves, over the mother liquor, and how much of that as product; cuts are sharp.

    Parameters
    ----------
    cuts: the two sizes, rising. rates, shares: below, between and above them.
    """

    cuts: tuple[Any, Any]
    rates: tuple[Any, Any, Any]
    shares: tuple[Any, Any, Any]

    def at(self, low: Any, values: tuple[Any, Any, Any]) -> Any:
        """A value for each class, by its lower end."""
        beyond = jnp.where(low >= self.cuts[1], values[2], values[1])
        return jnp.where(low >= self.cuts[0], beyond, values[0])


class Classes(NamedTuple):
    """Ends of the classes of a standing population, how fast each is emptied by what leaves (1/s), and the
    share of that which is product over the turnover of the liquor.
    """

    low: Any
    high: Any
    rates: Any
    shares: Any


def classes_for(length: Any, turnover: Any, largest: Any, outflow: Outflow | None) -> Classes:
    """Classes for a growth in one residence time (m) that reach a size at least (m)."""
    length = jnp.maximum(length, STILL)
    low = jnp.geomspace(FINEST * length, jnp.maximum(largest, COARSEST * length), CLASSES)
    low = jnp.append(jnp.zeros(1), low)
    if outflow is None:
        return Classes(low, jnp.append(low[1:], WIDEST), turnover * jnp.ones_like(low), jnp.ones_like(low))
    low = jnp.sort(jnp.append(low, jnp.stack([jnp.asarray(cut, dtype=float) for cut in outflow.cuts])))
    shares = outflow.at(low, outflow.shares)
    return Classes(low, jnp.append(low[1:], WIDEST), turnover * outflow.at(low, outflow.rates), shares)


def count_of(outflow: Outflow | None) -> int:
    """Number of classes."""
    return CLASSES + (1 if outflow is None else 3)


class Standing(NamedTuple):
    """A population in its classes: crystals that grow past a lower end per second with the newborn that come
    in there, those that come in from outside and where, how fast a class is emptied (1/s), growth rate (m/s),
    numbers and cubes in the vessel (m³).
    """

    classes: Classes
    entry: Any
    entering: Any
    passing: Any
    emptied: Any
    growth: Any
    numbers: Any
    cubes: Any

    def beyond(self, level: Any) -> Any:
        """Cubes above a size that leave as product, over the turnover of the liquor, m³."""
        low, high, _rates, shares = self.classes
        place = jnp.clip(jnp.searchsorted(low, level, side="right") - 1, 0, low.shape[0] - 1)
        entry, emptied = self.entry[place], self.emptied[place]
        first, second = _held(low[place], high[place], entry, emptied, self.growth, level)
        part = first[1] * self.passing[place] + second[1] * self.entering[place]
        above = jnp.append(jnp.cumsum((shares * self.cubes)[::-1])[::-1], 0.0)[place + 1]
        return shares[place] * part + above


def round_of(
    collisions: Collisions,
    classes: Classes,
    before: tuple[Any, Any],
    numbers: Any,
    sizes: Any,
    growth: Any,
    volume: Any,
    cautious: Any = False,
) -> Standing:
    """The population that the collisions with another one (numbers and cubes by class) leave; the steady one
    reproduces itself.

    Breakage is of this population, which leaves a linear balance. What meets is a square of the population:
    it is that of the one before and its slope there (Newton's method), its losses those of the one before,
    and what they would be more or less counts as born or unborn.

    Parameters
    ----------
    numbers, sizes: nuclei and seeds, 1/s and m. growth: m/s. volume: m³. cautious: whether less of the slope
    is taken where it leads to fewer crystals than none, as it may far from the steady population.
    """
    low, high, rates, _shares = classes
    met = events(collisions, *before, low, high, volume)
    emptied = rates + met.lost
    speed = jnp.maximum(growth, STILL * jnp.min(rates))
    entering, came = sorted_into(numbers, sizes**3, low)
    came = jnp.clip(safe_divide(came, entering, low**3), low**3, high**3)
    entry = jnp.maximum(came, STILL**3) ** (1.0 / 3.0)
    first, second = _held(low, high, entry, emptied, speed, low)
    ages = jnp.append(jnp.zeros(1), jnp.cumsum(emptied * (high - low) / speed)[:-1])
    place = jnp.arange(low.shape[0])
    grown = _surviving(place[:, None] >= place, ages[:, None] - ages[None, :])
    since = ages + emptied * (entry - low) / speed
    passing = _surviving(place[:, None] > place, ages[:, None] - since[None, :]) @ entering
    alone = [a * passing + b * entering for a, b in zip(first, second, strict=True)]

    def held(newborn: Any) -> tuple[Any, Any, Any]:
        through = passing + grown @ newborn
        numbers, cubes = (a * through + b * entering for a, b in zip(first, second, strict=True))
        return through, numbers, cubes

    def made(joined: Any, slopes: tuple[Any, Any]) -> tuple[Any, Any, Any]:
        onward = sum(part @ (share[:, None] * grown) for part, share in zip(slopes, first, strict=True))
        newborn = joined + sum(part @ there for part, there in zip(slopes, alone, strict=True))
        return held(jnp.linalg.solve(jnp.eye(low.shape[0]) - onward, newborn))

    already = sum(part @ there for part, there in zip(met.slopes, before, strict=True))
    cautious = jnp.asarray(cautious)
    found = made(met.joined, met.broken)
    for share in SLOPES:
        slopes = tuple(share * a + b for a, b in zip(met.slopes, met.broken, strict=True))
        steeper = made(met.joined - share * already, slopes)
        least = [jnp.min(part) + LESS * jnp.max(jnp.abs(part)) for part in steeper[1:]]
        there = ~cautious | ((least[0] >= 0.0) & (least[1] >= 0.0))
        found = tuple(jnp.where(there, a, b) for a, b in zip(steeper, found, strict=True))
    passing, numbers, cubes = found
    return Standing(classes, entry, entering, passing, emptied, speed, numbers, cubes)


def _surviving(there: Any, age: Any) -> Any:
    """What is left of one crystal from class to class; nothing where it does not come to be ``there``."""
    return jnp.where(there, jnp.exp(-jnp.clip(jnp.where(there, age, 0.0), 0.0, SPENT)), 0.0)


def _held(low: Any, high: Any, entry: Any, emptied: Any, growth: Any, level: Any) -> tuple[Any, Any]:
    """Numbers and cubes above a level within each class: for one crystal a second that grows past its lower
    end, and for one that comes in at its entry.
    """
    length = growth / emptied
    turn = jnp.maximum(level, entry)
    after = _piece(turn, high, length)
    early, late, come = (
        jnp.exp(-jnp.clip(way / length, 0.0, SPENT)) for way in (level - low, turn - low, turn - entry)
    )
    passed = [
        (early * a + late * b) / emptied for a, b in zip(_piece(level, turn, length), after, strict=True)
    ]
    return tuple(passed), tuple(come * part / emptied for part in after)


def _piece(start: Any, end: Any, length: Any) -> tuple[Any, Any]:
    """Integrals of ``e^-w`` and ``(start + length w)³ e^-w`` from start to end."""
    z = jnp.clip((end - start) / length, 0.0, SPENT)
    few = z < 1.0
    little = jnp.where(few, z, 0.5)
    w = little[..., None] * NODES
    short = little * jnp.sum(WEIGHTS * (start[..., None] + length[..., None] * w) ** 3 * jnp.exp(-w), axis=-1)
    long = jnp.where(few, 2.0, z)
    left = jnp.exp(-long)
    whole = (
        start**3 * (1.0 - left)
        + 3.0 * start**2 * length * (1.0 - left * (1.0 + long))
        + 3.0 * start * length**2 * (2.0 - left * (2.0 + long * (2.0 + long)))
        + length**3 * (6.0 - left * (6.0 + long * (6.0 + long * (3.0 + long))))
    )
    return -jnp.expm1(-z), jnp.where(few, short, whole)
