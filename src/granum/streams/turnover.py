"""A mixed vessel of fixed holdup over a step of time in which its inlet changes linearly."""

from __future__ import annotations

from typing import Any, NamedTuple

import jax.numpy as jnp


class Turnover(NamedTuple):
    """Exact weights of what was held and of the inlets at both ends of a step (the latter per second).

    >>> weights = Turnover.of(rate=0.01, step=100.0)
    >>> round(float(weights.through(1.0, 0.01, 0.01)), 12)  # the inlet is what is held
    1.0
    """

    kept: Any
    early: Any
    late: Any
    step: Any

    @classmethod
    def of(cls, rate: Any, step: Any) -> Turnover:
        """Weights for a rate of turnover (1/s)."""
        turns = jnp.asarray(rate * step)
        small = turns < 1e-4
        r = jnp.where(small, 1.0, turns)
        kept = jnp.exp(-turns)
        early = jnp.where(small, 0.5 - turns / 3.0, (1.0 - kept * (1.0 + turns)) / r**2)
        late = jnp.where(small, 0.5 - turns / 6.0, (turns - 1.0 + kept) / r**2)
        return cls(kept, early, late, step)

    def through(self, held: Any, then: Any, now: Any) -> Any:
        """What is held at the end of the step."""
        return self.kept * held + self.step * (self.early * then + self.late * now)
