"""Loops whose steps are told: what formulas flag within them is heard outside."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from jax import lax

from granum.core import flags


def told_scan(function: Callable[[Any, Any], Any], first: Any, rows: Any = None, *, length: int) -> Any:
    """``jax.lax.scan``, whose steps hand on what they flag, each record with a leading axis of steps.

    A step is traced once, however many there are; a loop written out in Python costs its length.
    """
    if not flags.listening():
        return lax.scan(function, first, rows, length=length)

    def step(carry: Any, row: Any) -> Any:
        with flags.collect() as records:
            carry, found = function(carry, row)
        return carry, (found, records)

    last, (found, records) = lax.scan(step, first, rows, length=length)
    flags.hand_on(records)
    return last, found
