"""Every equation keeps its dimensions: in other base units its result is the same quantity.

Metre, kilogram, second, kelvin, mole and dollar are each replaced by a unit of another size. Inputs and
physical constants are converted by the dimensions of their kinds; the result must then convert by those of
its own. What does not is a wrong kind, or an equation whose numbers belong to fixed units:
``fixed_units.toml`` lists these with the reason. Cards that take laws, series or an inner iteration are left
out.
"""

from __future__ import annotations

import sys
import tomllib
from functools import cache
from pathlib import Path
from typing import Any

import jax
import jax.numpy as jnp
import numpy as np
import pytest

from granum.core import constants, flags, registry, units
from granum.core.formulas import Formula

BASE = {
    "[length]": 1.37,
    "[mass]": 0.71,
    "[time]": 1.93,
    "[temperature]": 1.21,
    "[substance]": 0.83,
    "[currency]": 1.11,
    "[current]": 0.59,
}
CONSTANTS = {
    "STANDARD_GRAVITY": "m/s^2",
    "GAS_CONSTANT": "J/(mol*K)",
    "BOLTZMANN": "J/K",
    "AVOGADRO": "1/mol",
    "ELEMENTARY_CHARGE": "A*s",
    "VACUUM_PERMITTIVITY": "A*s/(V*m)",
    "STEFAN_BOLTZMANN": "W/(m^2*K^4)",
    "STANDARD_ATMOSPHERE": "Pa",
    "ZERO_CELSIUS": "K",
    "DARCY": "m^2",
}
VALUES = {name: getattr(constants, name) for name in CONSTANTS}
REASONS = tomllib.loads((Path(__file__).parent / "fixed_units.toml").read_text(encoding="utf-8"))
FIXED = {card for cards in REASONS.values() for card in cards}


@cache
def factor(unit: str) -> float:
    """By how much a number in a unit grows with the change of the base units."""
    powers = units.registry().Unit(unit).dimensionality
    return float(np.prod([BASE[base] ** float(power) for base, power in powers.items()]))


def numbers(f: Formula) -> dict[str, Any]:
    """Two ordinary values of each numeric input, defaults included."""
    found = {}
    for p in f.card.parameters:
        given = isinstance(p.default, int | float) and not isinstance(p.default, bool)
        if p.kind is None or p.sort is int or (not p.required and p.typical is None and not given):
            continue
        low, high = p.ordinary()
        found[p.name] = (
            np.array([low + share * (high - low) for share in (0.37, 0.71)])
            if p.required or not given
            else np.full(2, float(p.default))
        )
    return found


def called(f: Formula, inputs: dict[str, Any]) -> Any:
    with flags.inside(f):
        return f.function(
            *(jnp.asarray(inputs[p.name]) if p.name in inputs else p.default for p in f.card.parameters)
        )


def evaluated(f: Formula, inputs: dict[str, Any]) -> list[np.ndarray]:
    with jax.disable_jit():
        return [np.asarray(x, dtype=float) for x in jax.tree.leaves(called(f, inputs))]


def suitable(f: Formula) -> bool:
    if any(p.required and p.kind is None for p in f.card.parameters):
        return False  # a substance that is named brings numbers of its own, in their units
    if any(p.law or p.series for p in (*f.card.parameters, *f.card.outputs)) or not numbers(f):
        return False
    program = str(jax.make_jaxpr(lambda inputs: called(f, inputs))(numbers(f)))
    return "while[" not in program and "scan[" not in program


def departure(f: Formula, patch: pytest.MonkeyPatch) -> float:
    """Largest relative difference between the converted result and the result of converted inputs."""
    inputs = numbers(f)
    kinds = {p.name: p.kind for p in f.card.parameters if p.kind is not None}
    before = evaluated(f, inputs)
    with patch.context() as here:
        for name, module in [(n, m) for n, m in sys.modules.items() if n.startswith("granum.")]:
            for constant, unit in CONSTANTS.items():
                if isinstance(vars(module).get(constant), float):
                    here.setattr(f"{name}.{constant}", VALUES[constant] * factor(unit))
        after = evaluated(f, {name: x * factor(kinds[name].unit) for name, x in inputs.items()})
    worst = 0.0
    for p, old, new in zip(f.card.outputs, before, after, strict=True):
        old = old * (factor(p.kind.unit) if p.kind else 1.0)
        both = np.isnan(old) & np.isnan(new)
        off = np.where((old == new) | both, 0.0, np.abs(new - old) / np.maximum(np.abs(old), 1e-300))
        worst = max(worst, float(np.max(np.nan_to_num(off, nan=np.inf))))
    return worst


@pytest.mark.parametrize("domain", registry.DOMAINS)
def test_every_equation_keeps_its_dimensions(domain: str, monkeypatch: pytest.MonkeyPatch) -> None:
    cards = {
        key: f
        for key, f in registry.everything((domain,)).items()
        if isinstance(f, Formula) and key.startswith(f"{domain}.")
    }
    wrong = {key: departure(f, monkeypatch) for key, f in cards.items() if key not in FIXED and suitable(f)}
    assert not {key: off for key, off in wrong.items() if off > 1e-6}


def test_fixed_units_are_of_cards_that_exist() -> None:
    assert set(registry.everything()) >= FIXED
    assert sum(map(len, REASONS.values())) == len(FIXED)
