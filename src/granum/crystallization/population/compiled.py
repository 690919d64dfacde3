"""Compilation once for all values: numbers in laws, vessels and charges become traced arrays, so that only
structure recompiles.
"""

from __future__ import annotations

import functools
from collections.abc import Callable
from typing import Any

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np


def compiled(function: Callable[..., Any]) -> Callable[..., Any]:
    """``equinox.filter_jit`` that also traces Python floats (which it would take for constants)."""
    jitted = eqx.filter_jit(function)

    @functools.wraps(function)
    def call(*args: Any, **kwargs: Any) -> Any:
        given, named = jax.tree.map(
            lambda v: jnp.asarray(v) if isinstance(v, (float, np.ndarray)) else v, (args, kwargs)
        )
        return jitted(*given, **named)

    return call
