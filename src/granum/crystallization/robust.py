"""What a recipe keeps to where its kinetics are known only so far: bounds from both ends of a range."""

from __future__ import annotations

from math import log1p, sqrt
from typing import Any, Literal

import equinox as eqx
import jax
import jax.numpy as jnp
import scipy

Robustness = Literal["chance", "worst case"]


class Scaled(eqx.Module):
    """A law of kinetics whose rate is multiplied."""

    law: Any
    factor: Any

    def __call__(self, *state: Any) -> Any:
        return self.factor * self.law(*state)


def reach(probability: float, robustness: Robustness) -> float:
    """Standard deviations that are guarded against: of one figure with a probability, or anywhere in the
    region of that probability of both rates together.
    """
    if robustness == "chance":
        return float(scipy.stats.norm.ppf(probability))
    return sqrt(float(scipy.stats.chi2.ppf(probability, 2)))


def guarded(figures: Any, deviations: tuple[float, float], times: float) -> Any:
    """Figures (of two logarithms of factors) with what uncertain factors add, so many deviations away: half
    the difference between both ends of each, together as the root of their squares.
    """
    widths = jnp.asarray([times * sqrt(log1p(d**2)) for d in deviations])
    ends = jnp.concatenate([jnp.zeros((1, 2)), jnp.diag(widths), -jnp.diag(widths)])
    found = jax.vmap(figures)(ends)
    spread = 0.5 * (found[1:3] - found[3:5])
    return found[0] + jnp.sign(times) * jnp.sqrt(jnp.sum(spread**2, axis=0) + 1e-24)
