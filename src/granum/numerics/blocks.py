"""Large arrays in blocks that stay in cache: an elementwise iteration then costs arithmetic instead of memory
traffic (four times less).
"""

from __future__ import annotations

from collections.abc import Callable
from math import prod
from typing import Any

import jax
import jax.numpy as jnp

BLOCK = 8192


def blockwise(function: Callable[..., Any], *arrays: Any) -> Any:
    """``function(*arrays)`` of an elementwise function, over blocks when the arrays are long."""
    arrays = tuple(jnp.asarray(a, dtype=float) for a in arrays)
    shape = jnp.broadcast_shapes(*(a.shape for a in arrays))
    size = prod(shape)
    if size <= 2 * BLOCK:
        return function(*arrays)
    count = -(-size // BLOCK)

    def cut(a: Any) -> Any:
        flat = jnp.broadcast_to(a, shape).reshape(-1)
        return jnp.pad(flat, (0, count * BLOCK - size), mode="edge").reshape(count, BLOCK)

    whole = tuple(a for a in arrays if a.ndim == 0)
    blocks = tuple(cut(a) for a in arrays if a.ndim > 0)

    def one(parts: tuple[Any, ...]) -> Any:
        scalars, pieces = iter(whole), iter(parts)
        return function(*(next(scalars) if a.ndim == 0 else next(pieces) for a in arrays))

    out = jax.lax.map(one, blocks)
    return jax.tree.map(lambda x: x.reshape(-1)[:size].reshape(shape), out)
