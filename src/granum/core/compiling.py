"""When to compile: a program runs uncompiled at first, and is compiled once that has cost about as much as
compiling it costs.
"""

from __future__ import annotations

import functools
import weakref
from collections.abc import Callable
from typing import Any, ClassVar

import jax
import jax.numpy as jnp
import numpy as np
from jax.extend.core import jaxpr_as_fun

from granum.core.conversion import is_tracer
from granum.core.uncompiled import RENT, Program

HASTY = {"xla_cpu_use_fusion_emitters": False, "xla_backend_optimization_level": 1}
LARGE = 1000
"""Operations from which on what was traced is compiled; below, it is traced again, to be called faster."""


def begun(function: Callable[..., Any], **options: Any) -> Callable[..., Any]:
    """``jax.jit`` for functions that are often called a few times only.

    Programs are traced as ever and run by NumPy while that is cheap, so that the first answer needs no
    compiler; then they are compiled, with ``options`` of ``jax.jit``. Single numbers come back as NumPy
    scalars from uncompiled code.

    >>> twice = begun(lambda x: {"twice": 2.0 * x})
    >>> twice(3.0)
    {'twice': np.float64(6.0)}
    """
    return _Begun(function, options)


class _Begun:
    all: ClassVar[weakref.WeakSet[_Begun]] = weakref.WeakSet()

    def __init__(self, function: Callable[..., Any], options: dict[str, Any]):
        _Begun.all.add(self)
        self._function, self._options = function, options
        self._jitted = jax.jit(function, **options)
        self._trials: dict[Any, _Trial | None] = {}
        self._hot: Callable[..., Any] | None = None
        functools.update_wrapper(self, function)

    def forget(self) -> None:
        """Begin anew."""
        self._trials, self._hot = {}, None

    def __call__(self, *given: Any) -> Any:
        if self._hot is not None:
            return self._hot(*given)
        leaves, tree = jax.tree.flatten(given)
        if any(map(is_tracer, leaves)):
            return self._jitted(*given)
        key = (tree, *((np.shape(leaf), getattr(leaf, "dtype", type(leaf))) for leaf in leaves))
        trial = self._trials.get(key)
        if trial is None:
            trial = self._trials[key] = self._traced(given)
        if trial is None:
            return self._jitted(*given)
        if trial.left > 0:
            return trial.run(leaves)
        if trial.compiled is None:
            self._hot = self._jitted
            return self._jitted(*given)
        return jax.tree.unflatten(trial.tree, trial.compiled(*leaves))

    def _traced(self, given: tuple[Any, ...]) -> _Trial | None:
        closed, shape = jax.make_jaxpr(self._function, return_shape=True)(*given)
        if any(map(is_tracer, closed.consts)):
            return None
        return _Trial(closed, jax.tree.structure(shape), self._options)


def forget() -> None:
    """Drop all that was traced and compiled; what is called again is traced again."""
    for one in list(_Begun.all):
        one.forget()
    jax.clear_caches()


class _Trial:
    """A program traced for one sort of arguments, and the steps that it may still take uncompiled."""

    def __init__(self, closed: Any, tree: Any, options: dict[str, Any]):
        program = Program(closed, **options)
        allowed = RENT * program.size
        self.program, self.tree = program, tree
        self.left = allowed if program.work <= allowed else 0.0
        self.compiled = jax.jit(jaxpr_as_fun(closed), **options) if program.size >= LARGE else None

    def run(self, leaves: list[Any]) -> Any:
        found, spent = self.program.run(leaves)
        self.left -= spent
        return jax.tree.unflatten(self.tree, [jnp.asarray(x) if x.ndim else x for x in found])


def ahead(function: Callable[..., Any], *like: Any) -> Any:
    """Compiled for arguments like these; on a processor in half the time, for code that runs a fifth longer.

    >>> float(ahead(lambda x: 2.0 * x, 1.0)(3.0))
    6.0
    """
    try:
        options = HASTY if jax.default_backend() == "cpu" else None
        return jax.jit(function, compiler_options=options).lower(*like).compile()
    except jax.errors.JaxRuntimeError as problem:
        if "option" not in str(problem).lower():
            raise
        return jax.jit(function).lower(*like).compile()  # a compiler that does not know these options


def once(function: Callable[..., Any], *given: Any) -> Any:
    """What a function gives, for one call: traced, and run by NumPy. Leaves are NumPy arrays and scalars.

    >>> once(lambda x: jnp.exp(x), 0.0)
    np.float64(1.0)
    """
    closed, shape = jax.make_jaxpr(function, return_shape=True)(*given)
    found, _steps = Program(closed).run(jax.tree.leaves(given))
    return jax.tree.unflatten(jax.tree.structure(shape), found)
