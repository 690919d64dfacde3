"""How what a unit takes is judged: a possible number, no less than its balance takes up, and for twice the
flow no less where a stream is moved.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from granum.core.utilities import COOLING, ELECTRICITY, HEAT, SORTS, purpose, sort_of

MOVING = ("pump", "fan", "drive", "atomizer")
ROUNDING = 1e-6


def judge(uses: dict[str, Any], powers: dict[str, Any]) -> None:
    values = np.concatenate([np.ravel(x) for x in uses.values()] or [np.zeros(1)])
    assert np.isfinite(values).all()
    assert values.min() >= 0.0
    total = {sort: sum(x for n, x in uses.items() if sort_of(n) == sort) for sort in SORTS}
    shaft = powers.get("shaft_power", 0.0)
    assert total[ELECTRICITY] >= shaft * (1.0 - ROUNDING)
    bought = total[HEAT] - total[COOLING]
    if "heat_duty" in powers and total[HEAT] + total[COOLING] > 0.0:
        assert bought >= powers["heat_duty"] - ROUNDING * (total[HEAT] + total[COOLING])


def judge_twice(uses: dict[str, Any], twice: dict[str, Any]) -> None:
    """What is taken of everything that moves a stream, and of twice that stream."""
    for name, value in uses.items():
        if purpose(name) in MOVING:
            assert twice[name] >= value * (1.0 - ROUNDING), name
