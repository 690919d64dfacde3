"""Values for the inputs of any formula, ordinary or random, and what its answer to them must hold."""

from __future__ import annotations

import os
from collections.abc import Iterable, Mapping
from typing import Any

import jax
import jax.numpy as jnp
import numpy as np
from tests.sharing.samples import EVERYTHING

from granum.core.bounds import figures, limits
from granum.core.cards import Card
from granum.core.formulas import Formula
from granum.core.parameters import Parameter
from granum.core.results import Result

FORMULAS = {key: thing for key, thing in EVERYTHING.items() if isinstance(thing, Formula)}
NAMES = {"salt": "barium sulfate"}
"""Of what a card asks by name; any other is a solute in water."""


class Named:
    """A formula whose required names are given, so that numbers alone are left to be drawn."""

    def __init__(self, formula: Formula) -> None:
        self.formula = formula
        self.names = {
            p.name: NAMES.get(p.name, "potassium nitrate")
            for p in formula.card.parameters
            if p.sort is str and p.required
        }

    def __getattr__(self, name: str) -> Any:
        return getattr(self.formula, name)

    def __call__(self, **inputs: Any) -> Any:
        return self.formula(**self.names, **inputs)

    def evaluate(self, **inputs: Any) -> Result:
        return self.formula.evaluate(**self.names, **inputs)


ELEMENTWISE: dict[str, Any] = {
    k: Named(f) if any(p.sort is str and p.required for p in f.card.parameters) else f
    for k, f in FORMULAS.items()
    if not any(p.series for p in (*f.card.parameters, *f.card.outputs))
}
SETS = int(os.environ.get("GRANUM_RANDOM_SETS", "1000"))
"""Sets of random inputs a card; the long run gives 1000000."""
BLOCK = 10_000  # of them in one array
DECADES = 8.0  # on either side of an ordinary value


def drawn(parameters: Iterable[Parameter]) -> list[Parameter]:
    """The numeric inputs: required ones, and those whose default is a number."""
    numeric = [p for p in parameters if p.kind is not None and p.sort is not int and not p.series]
    return [p for p in numeric if p.required or p.typical is not None or isinstance(p.default, float)]


def ordinary(p: Parameter, rng: np.random.Generator, count: int) -> np.ndarray:
    """Values from the ordinary range: log-uniform where it is positive and spans more than a factor of
    three.
    """
    low, high = p.ordinary()
    u = rng.uniform(0.02, 0.98, count)
    return (
        np.exp(np.log(low) + u * np.log(high / low)) if low > 0 and high / low > 3 else low + u * (high - low)
    )


def draw(f: Formula, count: int, seed: int = 0) -> dict[str, np.ndarray]:
    """Ordinary values for each numeric input, inside the hard bounds."""
    rng = np.random.default_rng(seed)
    return {p.name: ordinary(p, rng, count) for p in drawn(f.card.parameters)}


def loops(f: Formula, inputs: Mapping[str, np.ndarray]) -> bool:
    """Whether a formula repeats anything until it is found."""
    program = str(jax.make_jaxpr(lambda kw: f(**kw))({n: jnp.asarray(v[0]) for n, v in inputs.items()}))
    return "while[" in program or "scan[" in program


def wide(p: Parameter, rng: np.random.Generator, count: int) -> np.ndarray:
    """Values over many decades inside the hard bounds, crowding towards finite ones."""
    kind = p.kind
    assert kind is not None
    low, high = kind.lower, kind.upper
    scale = max(map(abs, p.ordinary())) * 10.0 ** rng.uniform(-DECADES, DECADES, count)
    if np.isfinite(low) and np.isfinite(high):
        near = (high - low) * 10.0 ** rng.uniform(-DECADES, 0.0, count)
        return np.where(rng.random(count) < 0.5, low + near, high - near).clip(
            np.nextafter(low, high), np.nextafter(high, low)
        )
    if np.isfinite(low):
        return low + np.maximum(scale, abs(low) * 1e-15)
    if np.isfinite(high):
        return high - np.maximum(scale, abs(high) * 1e-15)
    return np.where(rng.random(count) < 0.5, scale, -scale)


def random_inputs(parameters: Iterable[Parameter], count: int, seed: int) -> dict[str, np.ndarray]:
    """Half the sets ordinary throughout; in the others each input is as likely to be wide."""
    rng = np.random.default_rng(seed)
    far = rng.random(count) < 0.5
    values = {}
    for p in drawn(parameters):
        chosen = far & (rng.random(count) < 0.5)
        values[p.name] = np.where(chosen, wide(p, rng, count), ordinary(p, rng, count))
    return values


def rows(parameters: Iterable[Parameter], count: int, seed: int) -> dict[str, np.ndarray]:
    """A row of values for each series: shares that add up to one; all rising, all falling or as they come;
    edges one more than classes.
    """
    rng = np.random.default_rng(seed)
    order, shared, far = rng.integers(3), rng.random() < 0.8, rng.random() < 0.3
    found = {}
    for p in parameters:
        if not (p.series and p.kind and p.required):
            continue
        values = (wide if far else ordinary)(p, rng, count + (p.series == "edges"))
        if p.kind.upper == 1.0 and shared:
            found[p.name] = values / values.sum()
        else:
            found[p.name] = (np.sort(values), np.sort(values)[::-1], values)[order]
    return found


def wrong(result: Result, inputs: Mapping[str, Any]) -> list[str]:
    """What is wrong in an answer: a number outside its own bounds, an infinite one, or none without a
    flag.
    """
    return amiss(result.card, result.value, result.flags, inputs)


def amiss(card: Card, answer: Any, bits: np.ndarray, inputs: Mapping[str, Any]) -> list[str]:
    """What is wrong in the values of a card's outputs, with the flags that go with them."""
    found = []
    for p, value in figures(card.outputs, answer):
        array = np.asarray(value, dtype=float)
        low, high = limits(p)
        flags = (
            np.broadcast_to(bits, array.shape) if bits.shape in ((), array.shape) else np.asarray(bits.any())
        )
        for word, bad in (
            ("outside its bounds", (array < low) | (array > high)),
            ("infinite", np.isinf(array)),
            ("no number and no flag", np.isnan(array) & (flags == 0)),
        ):
            if bad.any():
                at = int(np.argmax(bad.ravel()))
                given = {n: float(np.ravel(v)[at]) for n, v in inputs.items() if np.size(v) == array.size}
                found.append(
                    f"{card.key}: {p.name} {word} {int(bad.sum())} times, first {array.ravel()[at]} "
                    f"at {given}"
                )
    return found
