"""Formulas made for a test."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from granum.core.formulas import Formula
from granum.core.registry import _declared, _families


def own_formula(function: Callable[..., Any]) -> Formula:
    """A formula for one test only, out of the registry again."""
    made = Formula(
        function,
        source="",
        equation="",
        fitted={},
        typical={},
        title=function.__name__,
        output="ratio",
        family="",
        symbols={},
    )
    _declared.pop(made.key)
    _families.pop("ratio", None)
    return made
