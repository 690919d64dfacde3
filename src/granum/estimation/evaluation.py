"""The model of a fit with its slopes, compiled once: a search asks for both, one after the other, at the same
point.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import Any

import equinox as eqx
import jax
import numpy as np
from jax.flatten_util import ravel_pytree

Model = Callable[[dict[str, Any], Any], Any]


class Evaluated:
    """Values of a model at all points, and their slopes, at scaled parameters; those of the last place are
    kept.

    A model that is a module, with its numbers as arrays, is compiled once for all data of one length; any
    other function for each fit.
    """

    def __init__(self, model: Model, names: tuple[str, ...], scale: np.ndarray, x: Any):
        x = jax.tree.map(jax.numpy.asarray, x)
        self._function = (
            _shared(model, names, scale, x)
            if isinstance(model, eqx.Module)
            else jax.jit(partial(_both, model, names, scale, x))
        )
        self._place: bytes | None = None
        self._found: tuple[np.ndarray, np.ndarray] = (np.empty(0), np.empty((0, 0)))

    def __call__(self, q: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Values and slopes."""
        q = np.asarray(q, dtype=float)
        if self._place != q.tobytes():
            values, slopes = self._function(q)
            self._place, self._found = q.tobytes(), (np.asarray(values), np.asarray(slopes))
        return self._found


def _both(model: Model, names: tuple[str, ...], scale: Any, x: Any, q: Any) -> tuple[Any, Any]:
    def whole(q: Any) -> tuple[Any, Any]:
        values = ravel_pytree(model(dict(zip(names, q * scale, strict=True)), x))[0]
        return values, values

    slopes, values = jax.jacfwd(whole, has_aux=True)(q)
    return values, slopes


_both_for_all = eqx.filter_jit(_both)


def _shared(
    model: Any, names: tuple[str, ...], scale: np.ndarray, x: Any
) -> Callable[[Any], tuple[Any, Any]]:
    return lambda q: _both_for_all(model, names, jax.numpy.asarray(scale), x, jax.numpy.asarray(q))
