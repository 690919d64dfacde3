"""Random valid inputs into every formula: a value within the bounds of its own kind, or none and a flag; the
bounds of inputs flagged.

A run takes 1000 sets a card, of those with series fewer; ``GRANUM_RANDOM_SETS=1000000 pytest -n
0 tests/contracts/test_random_inputs.py`` is the long search.
"""

from __future__ import annotations

from typing import Any

import jax
import numpy as np
import pytest
from tests.contracts.drawing import (
    BLOCK,
    ELEMENTWISE,
    FORMULAS,
    SETS,
    draw,
    random_inputs,
    rows,
    wrong,
)

from granum.core import flags
from granum.core.errors import GranumError
from granum.core.formulas import Formula

WITH_SERIES = {k: f for k, f in FORMULAS.items() if any(p.series and p.kind for p in f.card.parameters)}
ROWS = max(SETS // 100, 1)  # one call each, as a card with series takes one value of the others
POINTS = 6


def beyond(f: Formula, inputs: dict[str, np.ndarray]) -> str | None:
    """Put an ordinary set first and one outside the bounds of an input second; the name of that input, if any
    has a lower bound.
    """
    for name, values in draw(f, 1).items():
        inputs[name][:2] = values[0]
    for p in f.card.parameters:
        if p.name in inputs and p.kind is not None and p.kind.lower > -np.inf:
            inputs[p.name][1] = p.kind.lower - 1.0
            return p.name
    return None


@pytest.mark.parametrize("key", ELEMENTWISE)
def test_any_input_gives_a_value_within_its_bounds_or_none_and_a_flag(key: str) -> None:
    f = ELEMENTWISE[key]
    for seed in range(-(-SETS // BLOCK)):
        inputs = random_inputs(f.card.parameters, min(SETS, BLOCK), seed)
        if not inputs:
            return
        name = beyond(f, inputs)
        result = f.evaluate(**inputs)
        assert not wrong(result, inputs)
        if name is not None:
            for out in jax.tree.leaves(result.value):
                assert np.isnan(np.broadcast_to(out, (len(inputs[name]),))[1]), name
            assert result.flags[1] & flags.OUTSIDE_DOMAIN
            assert not result.flags[0] & flags.OUTSIDE_DOMAIN


@pytest.mark.parametrize("key", WITH_SERIES)
def test_a_row_of_values_gives_figures_within_their_bounds_or_one_message(key: str) -> None:
    f = WITH_SERIES[key]

    def drawn(seed: int) -> dict[str, Any]:
        single = random_inputs(f.card.parameters, 1, seed)
        return {n: float(v[0]) for n, v in single.items()} | rows(f.card.parameters, POINTS, seed)

    # NumPy rows, whose powers may overflow
    with np.errstate(all="ignore"):
        for seed in range(ROWS):
            inputs = drawn(seed)
            try:
                result = f.evaluate(**inputs)
            except GranumError:
                continue
            assert not wrong(result, inputs), inputs
