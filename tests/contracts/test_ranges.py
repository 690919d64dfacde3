"""Ranges are data: what a docstring says of a range is declared, and what is declared is told where it is
left.
"""

from __future__ import annotations

import re
import tomllib
from pathlib import Path

import numpy as np
import pytest
from tests.contracts.drawing import ordinary
from tests.sharing.samples import EVERYTHING

from granum.core.parameters import Parameter

RANGED = {k: t for k, t in EVERYTHING.items() if t.card.fitted}
LAWS = {k: t for k, t in RANGED.items() if t.card.sort == "law" and hasattr(t, "evaluate")}
NUMBER = r"[−-]?\d[\d.,]*(?:e[−-]?\d+| 000)?(?: ?[%°µ][a-zA-Z]*)?"
SAID = re.compile(
    rf"(?:(?:below|above|up to|down to|at least|at most|less than|more "
    rf"than|from|between|under|over|within|beyond) {NUMBER})|(?:{NUMBER} (?:to|and|–|…) {NUMBER})"
    rf"|[<>≤≥] ?{NUMBER}"
)
# Numbers that are no range of the relation: what is usual for an input, an example, a property of the result.
OTHER = tomllib.loads((Path(__file__).parent / "ranges_said.toml").read_text(encoding="utf-8"))


def prose(key: str) -> str:
    """The docstring without its executed examples."""
    return " ".join(
        line for line in EVERYTHING[key].card.doc.splitlines() if not line.lstrip().startswith((">>>", "..."))
    )


SPEAKING = [k for k, t in EVERYTHING.items() if t.card.sort in ("formula", "law") and SAID.search(prose(k))]


def test_a_range_in_words_is_declared() -> None:
    silent = {k: SAID.findall(prose(k)) for k in SPEAKING if k not in RANGED and k not in OTHER}
    assert not silent, (
        f"Declare the range (fitted=…), or say in ranges_said.toml what the numbers are: {silent}"
    )


def test_no_excuse_without_need() -> None:
    assert set(OTHER) & set(EVERYTHING) <= set(SPEAKING) - set(RANGED)


@pytest.mark.parametrize("key", [k for k, t in RANGED.items() if t.card.sort == "law"])
def test_a_law_declares_ranges_of_what_it_knows(key: str) -> None:
    card = RANGED[key].card
    known = {*card.inputs, *(p.name for p in card.outputs)}
    assert set(card.fitted) <= known
    assert all(low < high for low, high in card.fitted.values())


@pytest.mark.parametrize("key", LAWS)
def test_a_law_tells_where_an_input_leaves_its_range(key: str) -> None:
    law, rng = LAWS[key], np.random.default_rng(0)
    numbers = [p for p in law.card.inputs.values() if p.kind is not None and not p.series and p.required]
    if len(numbers) < sum(p.required for p in law.card.inputs.values()):
        pytest.skip("needs more than numbers")
    inside = {p.name: float(ordinary(p, rng, 1)[0]) for p in numbers}
    for name, (low, high) in law.card.fitted.items():
        p: Parameter = law.card.parameter(name)
        if name not in law.card.inputs or p.kind is None:
            continue
        for beyond in (low - 0.01 * max(abs(low), 1e-9), high * 1.01 if high > 0 else high * 0.99):
            if np.isfinite(beyond) and p.kind.contains(beyond):
                told = law.evaluate(
                    **{
                        **inside,
                        name: np.array([beyond]) if name in {a.name for a in law.card.arguments} else beyond,
                    }
                )
                assert any(
                    n["name"] == name and n["card"] == key and n["flag"] == "extrapolated"
                    for n in told.notices
                )
