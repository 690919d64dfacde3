"""Functions compiled for few calls: made ready fast rather than fast to run.

Results come back as one vector (an output array each costs a kernel each), and the compiler is asked for
plain code: a process line of ten units is ready in a third of the time and runs as fast, its arrays being
small. For ensembles jit ``solve`` itself.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import lru_cache
from itertools import accumulate
from typing import Any

import jax
import jax.numpy as jnp
import numpy as np

from granum.core.compiling import begun
from granum.core.kept import Slot, is_slot

_PLAIN = {"xla_cpu_use_fusion_emitters": False, "xla_backend_optimization_level": 0}


def compiled(function: Callable[..., Any]) -> Callable[..., Any]:
    """``function`` compiled once per structure of its arguments: arrays may change, floats are part of it;
    results have NumPy arrays as leaves.
    """

    def call(*arguments: Any) -> Any:
        leaves, tree = jax.tree.flatten(arguments)
        numbers = [leaf for leaf in leaves if isinstance(leaf, np.ndarray | jax.Array)]
        others = tuple(None if isinstance(leaf, np.ndarray | jax.Array) else leaf for leaf in leaves)
        shapes = tuple(number.shape for number in numbers)
        return _built(function, tree, others, shapes)(numbers)

    return call


def as_arrays(tree: Any) -> Any:
    """Numbers as arrays, so that what is compiled is reused when only values change."""
    return jax.tree.map(lambda x: np.asarray(x) if isinstance(x, float) else x, tree)


def of_jax(tree: Any) -> Any:
    """What ``compiled`` gave, as code expects it that was written for JAX."""
    return jax.tree.map(lambda x: jnp.asarray(x) if isinstance(x, np.ndarray) else x, tree)


@lru_cache(maxsize=64)
def _built(
    function: Callable[..., Any], tree: Any, others: tuple[Any, ...], _shapes: tuple[tuple[int, ...], ...]
) -> Callable[[list[Any]], Any]:
    shape: list[Any] = []

    def flat(numbers: list[Any]) -> Any:
        given = iter(numbers)
        arguments = jax.tree.unflatten(tree, [next(given) if other is None else other for other in others])
        leaves, out = jax.tree.flatten(function(*arguments))
        arrays = [jnp.asarray(leaf) for leaf in leaves if isinstance(leaf, jax.Array | np.ndarray)]
        slots = [Slot() if isinstance(leaf, jax.Array | np.ndarray) else leaf for leaf in leaves]
        shape[:] = [jax.tree.unflatten(out, slots), [(a.shape, a.dtype) for a in arrays]]
        return jnp.concatenate([jnp.ravel(a).astype(float) for a in arrays])

    fixed = jax.tree.unflatten(tree, [Slot() if other is None else other for other in others])
    quick = begun(
        flat,
        (function.__module__, function.__qualname__, fixed),
        shape,
        compiler_options=_PLAIN if jax.default_backend() == "cpu" else None,
    )

    def call(numbers: list[Any]) -> Any:
        nonlocal quick
        try:
            packed = np.asarray(quick(numbers))
        except jax.errors.JaxRuntimeError as problem:
            if "option" not in str(problem).lower():
                raise
            quick = jax.jit(flat)  # a compiler that does not know these options
            packed = np.asarray(quick(numbers))
        made, kinds = shape
        leaves, out = jax.tree.flatten(made, is_leaf=is_slot)
        parts = iter(np.split(packed, list(accumulate(math.prod(size) for size, _ in kinds))[:-1]))
        arrays = iter(
            [part.reshape(size).astype(kind)[()] for part, (size, kind) in zip(parts, kinds, strict=True)]
        )
        return jax.tree.unflatten(out, [next(arrays) if is_slot(x) else x for x in leaves])

    return call
