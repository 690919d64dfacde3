"""Composition of the liquor at the end of a time step in which several growth rates follow from it.

Where one path does not tell the others (two forms, two faces), the composition is the unknown: paths and
births follow from it, and the solute balance must give it back. A richer solution grows more crystals, so
that the root is bracketed.
"""

from __future__ import annotations

from abc import abstractmethod
from typing import Any

import equinox as eqx
import jax
import jax.numpy as jnp
from jax import lax

from granum.crystallization.population.lagrangian import fitted_weight
from granum.numerics.quick_roots import nearly_falling_root


class Trial(eqx.Module):
    """One time step for a trial composition at its end."""

    @abstractmethod
    def rates_before(self) -> list[Any]:
        """Growth rates at the start."""

    @abstractmethod
    def rates(self, ratio: Any) -> list[Any]:
        """Growth rates at the end."""

    @abstractmethod
    def left(self, ratio: Any, weights: list[Any]) -> Any:
        """Composition that the balance leaves, with weights of the end for each growth rate."""


def settled(trial: Trial, ratio: Any, highest: Any, rounds: int = 2) -> tuple[Any, list[Any]]:
    """Composition at the end of a step and the weights of the end with which it was found.

    The first round takes the end alone, which never crosses saturation; each further one fits the weights to
    how stiff the step was, and takes the end alone for a rate that has turned. Where the last round has
    turned one, there is one more. A last Newton step makes the balance exact.
    """
    before = trial.rates_before()
    implicit = [jnp.ones(()) for _rate in before]

    def solved(weights: list[Any]) -> Any:
        return nearly_falling_root(
            lambda c: trial.left(c, weights) - c, 0.0 * highest, highest + 0.0, ratio, 1e-12 * highest
        )

    def stiffness(c: Any) -> Any:
        return -jax.jvp(lambda c: trial.left(c, implicit), (c,), (jnp.ones(()),))[1]

    first = stiffness(ratio)

    def tried(weights: list[Any]) -> tuple[list[Any], list[Any], Any, Any]:
        c = solved(weights)
        usual = fitted_weight(jnp.maximum(first, stiffness(c)))
        rates = trial.rates(c)
        better = [jnp.where(a * b > 0.0, usual, 1.0) for a, b in zip(before, rates, strict=True)]
        turned = jnp.any(jnp.stack([a * b < 0.0 for a, b in zip(before, rates, strict=True)]))
        return better, weights, c, turned

    def attempt(number: Any, found: tuple[Any, Any, Any, Any]) -> tuple[Any, Any, Any, Any]:
        needed = (number < rounds) | found[3]
        return lax.cond(needed, lambda: tried(found[0]), lambda: found)

    begun = (implicit, implicit, ratio + 0.0 * highest, jnp.zeros((), dtype=bool))
    _next, weights, c, _turned = lax.fori_loop(0, rounds + 1, attempt, begun)
    value, slope = jax.jvp(lambda c: trial.left(c, weights) - c, (c,), (jnp.ones(()),))
    return c - value / slope, weights
