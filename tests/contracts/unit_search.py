"""What random searches ask of every unit: the questions that a solved line is asked, of hundreds of settings
at once.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any, NamedTuple, get_args, get_type_hints

import jax
import jax.numpy as jnp
import numpy as np

from granum.core.kinds import kind_of
from granum.flowsheet import Flowsheet, solve
from granum.flowsheet.findings import CLOSURE, LEAST, findings
from granum.streams.mixture import Mixture
from granum.streams.stream import Stream
from granum.streams.units import Unit

FEED, THERE, OWN = 8, 3, 6
EMPTY = 8  # rows that leave something out, at the beginning
"""A row of numbers from 0 to 1: eight for the feeds, three that say what is there at all, six for the
unit.
"""
QUICK = {"xla_cpu_use_fusion_emitters": False, "xla_backend_optimization_level": 0}


class Case(NamedTuple):
    """A unit to be tried.

    Parameters
    ----------
    mixture: what its streams are made of.
    feeds: its inlets by name, from a mixture and eight numbers.
    unit: the unit, from the inlets it is meant for and six numbers.
    """

    mixture: Mixture
    feeds: Callable[[Mixture, Any], dict[str, Stream]]
    unit: Callable[[dict[str, Stream], Any], Unit]


class Tried(NamedTuple):
    """What came of each row.

    Parameters
    ----------
    feeds, products: the streams by name. figures: those of the data sheet, kept: whether each is finite and
        within the bounds of its kind.
    refused: whether the unit itself says that it has no solution. finite, lowest, mass, energy: as of
        ``Findings``.
    """

    feeds: dict[str, Stream]
    products: dict[str, Stream]
    figures: dict[str, Any]
    kept: dict[str, Any]
    refused: Any
    finite: Any
    lowest: Any
    mass: Any
    energy: Any


def rows(count: int, seed: int = 5) -> np.ndarray:
    """Random rows; the first eight leave out solid, liquid or gas and the second feed in every combination,
    the next two are of one size and of all.
    """
    x = np.random.default_rng(seed).random((count, FEED + THERE + OWN))
    x[:, FEED : FEED + THERE] = 1.0
    x[:EMPTY, FEED : FEED + THERE] = np.indices((2, 2, 2)).reshape(3, 8).T
    x[8:10, 5] = 0.0, 1.0
    return x


def shares(mean: Any, spread: Any, classes: int) -> Any:
    """Fractions of size classes: in one class or two for a spread of 0, nearly even for one of 1."""
    bell = jnp.exp(-0.5 * ((jnp.linspace(0.0, 1.0, classes) - mean) / (0.3 / classes + spread)) ** 2) + 1e-12
    return bell / jnp.sum(bell)


def opposite_of(m: Mixture) -> Mixture:
    """The same mixture, its species named in the opposite order."""
    law = m.liquid_viscosity
    viscosity = None if law is None else lambda w, T: law(w[::-1], T)
    return Mixture(
        m.solids[::-1],
        m.liquids[::-1],
        m.gases[::-1],
        m.size_edges,
        m.axes,
        viscosity,
        m.gas_viscosity,
        m.gas_conductivity,
    )


def turned(stream: Stream, mixture: Mixture) -> Stream:
    """The same matter in the mixture of opposite order."""
    return Stream(
        stream.solid[::-1],
        stream.liquid[::-1],
        stream.gas[::-1],
        stream.temperature,
        stream.pressure,
        mixture,
    )


def within(figures: Mapping[str, Any], made: type) -> dict[str, Any]:
    """Which figures are finite and lie in the bounds of their kind."""
    hints = get_type_hints(made, include_extras=True)
    kept = {}
    for name, value in figures.items():
        slack = 1e-12 * jnp.maximum(jnp.abs(jnp.asarray(value)), 1.0)
        kind = next(k for k in map(kind_of, (hints[name], *get_args(hints[name]))) if k is not None)
        kept[name] = (kind.contains(value + slack) | kind.contains(value - slack)) & jnp.isfinite(value)
    return kept


def present(feeds: Mapping[str, Stream], there: Any) -> dict[str, Stream]:
    first, *others = feeds
    s = feeds[first]
    found = {first: s.part(solid=there[0], liquid=there[1], gas=there[2])}
    return found | {n: feeds[n].part(there[2], there[2], there[2]) for n in others}


def tried(case: Case, x: np.ndarray, reverse: bool = False) -> Tried:
    """Solve the unit of every row, ``reverse`` with the species in the opposite order."""
    opposite = opposite_of(case.mixture)

    def one(row: Any) -> Tried:
        feeds = case.feeds(case.mixture, row[:FEED])
        unit = case.unit(feeds, row[FEED + THERE :])  # made for what is meant to come
        feeds = present(feeds, row[FEED : FEED + THERE])
        if reverse:
            feeds = {n: turned(s, opposite) for n, s in feeds.items()}
        line = Flowsheet({"unit": unit}, feeds, {n: ("", f"unit.{n}") for n in feeds})
        solution = solve(line, sheets=True)
        found = findings(line, solution)
        products = {n.removeprefix("unit."): solution.streams[n] for n in line.products}
        if reverse:
            products = {n: turned(s, case.mixture) for n, s in products.items()}
        sheet = solution.sheets["unit"][0]
        figures = {name: value for name, value in sheet._asdict().items() if value is not None}
        return Tried(
            feeds,
            products,
            figures,
            within(figures, type(sheet)),
            found.lost[0],
            jnp.all(found.finite),
            jnp.min(found.lowest),
            found.mass[0],
            found.energy[0],
        )

    options = {"compiler_options": QUICK} if jax.default_backend() == "cpu" else {}
    return jax.tree.map(np.asarray, jax.jit(jax.vmap(one), **options)(x))


def wrong(found: Tried) -> dict[str, list[int]]:
    """Rows that are neither a solution nor refused by the unit, by what is wrong with them."""
    bad = {
        "not finite": ~found.finite,
        "negative": ~(found.lowest >= LEAST),
        "mass": ~(found.mass <= CLOSURE),
        "energy": ~(found.energy <= CLOSURE),
        **{name: ~kept.reshape(len(kept), -1).all(axis=1) for name, kept in found.kept.items()},
    }
    rows = {name: np.flatnonzero(mask & ~found.refused).tolist() for name, mask in bad.items()}
    return {name: found for name, found in rows.items() if found}


def apart(a: Any, b: Any) -> np.ndarray:
    """Largest relative difference of two arrays of flows or figures in each row."""
    a, b = (np.reshape(x, (len(x), -1)) for x in (a, b))
    size = np.maximum(np.abs(a).max(axis=1), np.abs(b).max(axis=1))
    return np.where(np.abs(a - b) > 1e-15, np.abs(a - b), 0.0).max(axis=1) / np.where(size > 0, size, 1.0)


def disordered(found: Tried, other: Tried, used: Any) -> dict[str, float]:
    """Largest differences, beyond rounding, between what came of the same rows with species named in another
    order.
    """
    pairs = {name: (value, other.figures[name]) for name, value in found.figures.items()}
    for port, s in found.products.items():
        pairs |= {
            f"{port}.{part}": (getattr(s, part), getattr(other.products[port], part))
            for part in ("solid", "liquid", "gas", "temperature")
        }
    differences = {
        name: float(apart(a, b)[used].max(initial=0.0)) for name, (a, b) in pairs.items() if np.size(a)
    }
    return {name: value for name, value in differences.items() if not value <= 1e-9}
