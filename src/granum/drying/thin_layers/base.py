"""``AbstractThinLayer``: moisture ratio of a thin layer over time."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Mapping
from typing import Any, ClassVar

import equinox as eqx
import jax.numpy as jnp


class AbstractThinLayer(eqx.Module):
    """Moisture ratio (X − X_e)/(X_0 − X_e) of a thin layer in constant air. Times in seconds, so rate
    constants are per second.

    ``curve`` names the family of curves: models of one name draw the same curves. ``bounds`` keep a fit where
    the model means something.
    """

    curve: eqx.AbstractClassVar[str]
    bounds: ClassVar[Mapping[str, tuple[float, float]]] = {}

    @abstractmethod
    def ratio(self, t: Any) -> Any:
        """Moisture ratio after a time."""

    @classmethod
    @abstractmethod
    def first(cls, k: float) -> dict[str, float]:
        """Start values of a fit, from the inverse of the time to a ratio of 1/e."""


def power(t: Any, n: Any) -> Any:
    """t to the n with a finite slope at t = 0."""
    return jnp.where(t > 0, jnp.where(t > 0, t, 1.0) ** n, 0.0)
