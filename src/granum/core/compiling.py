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

from granum.core import kept
from granum.core.conversion import is_tracer
from granum.core.traces import Reader
from granum.core.uncompiled import RENT, Outgrown, Program

HASTY = {"xla_cpu_use_fusion_emitters": False, "xla_backend_optimization_level": 1}
LARGE = 1000
"""Operations from which on what was traced is compiled; below, it is traced again, to be called faster."""


def begun(
    function: Callable[..., Any], kept_as: Any = None, aside: list[Any] | None = None, **options: Any
) -> Callable[..., Any]:
    """``jax.jit`` for functions that are often called a few times only.

    Programs are traced as ever and run by NumPy while that is cheap, so that the first answer needs no
    compiler; then they are compiled, with ``options`` of ``jax.jit``. Single numbers come back as NumPy
    scalars from uncompiled code.

    ``kept_as``: what the program is traced from besides the arguments, when it may be kept for the next
    process; ``aside``: what tracing leaves there is kept with it.

    >>> twice = begun(lambda x: {"twice": 2.0 * x})
    >>> twice(3.0)
    {'twice': np.float64(6.0)}
    """
    return _Begun(function, kept_as, [] if aside is None else aside, options)


class _Begun:
    all: ClassVar[weakref.WeakSet[_Begun]] = weakref.WeakSet()

    def __init__(self, function: Callable[..., Any], kept_as: Any, aside: list[Any], options: dict[str, Any]):
        _Begun.all.add(self)
        self._function, self._options = function, options
        self._kept_as, self._aside = kept_as, aside
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
            trial = self._trials[key] = self._first(given)
        if trial is None:
            return self._jitted(*given)
        if trial.left > 0:
            try:
                return trial.run(leaves)
            except Outgrown:
                self._trials[key] = self._anew(given, trial.name)
                return self(*given)
        if trial.compiled is None:
            self._hot = self._jitted
            return self._jitted(*given)
        return jax.tree.unflatten(trial.tree, trial.compiled(*leaves))

    def _first(self, given: tuple[Any, ...]) -> _Trial | None:
        """As an earlier process kept it, else traced and kept for the next one."""
        if self._kept_as is None or not kept.is_on():
            return self._traced(given)
        name = kept.Named((self._kept_as, *_without_numbers(given)))
        found = name.found()
        if found is not None:
            trace, loops, out, self._aside[:] = found
            tree = jax.tree.structure(out, is_leaf=kept.is_slot)
            return _Trial(Program(trace, loops, kept=True, **self._options), tree, name)
        return self._anew(given, name)

    def _anew(self, given: tuple[Any, ...], name: kept.Named | None) -> _Trial | None:
        trial = self._traced(given)
        if trial is not None and name is not None:
            name.put(lambda: self._content(trial))
        return trial

    def _content(self, trial: _Trial) -> Any:
        """What is kept of a program; nothing of one that takes JAX to run, or is compiled from the beginning:
        the compiler's own cache is for that.
        """
        if not trial.program.lasts or trial.program.work > trial.allowed:
            return None
        out = jax.tree.unflatten(trial.tree, [kept.Slot()] * trial.tree.num_leaves)
        return trial.program.trace, trial.program.loops, out, self._aside

    def _traced(self, given: tuple[Any, ...]) -> _Trial | None:
        closed, shape = jax.make_jaxpr(self._function, return_shape=True)(*given)
        if any(map(is_tracer, closed.consts)):
            return None
        trial = _Trial(Program(closed, kept=kept.is_on(), **self._options), jax.tree.structure(shape))
        if trial.program.size >= LARGE:
            trial.compiled = jax.jit(jaxpr_as_fun(closed), **self._options)
        return trial


def forget() -> None:
    """Drop all that was traced and compiled, written first where programs are kept; what is called again is
    traced again.
    """
    kept.store()
    for one in list(_Begun.all):
        one.forget()
    jax.clear_caches()


class _Trial:
    """A program made ready for one sort of arguments, and the steps that it may still take uncompiled."""

    def __init__(self, program: Program, tree: Any, name: kept.Named | None = None):
        self.allowed = RENT * program.size
        self.program, self.tree, self.name = program, tree, name
        self.left = self.allowed if program.work <= self.allowed else 0.0
        self.compiled: Callable[..., Any] | None = None

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

    A function that another process can name, such as a method of a material, is traced for it as well where
    programs are kept.

    >>> once(lambda x: jnp.exp(x), 0.0)
    np.float64(1.0)
    """
    name = kept.Named((function, *_without_numbers(given))) if kept.is_on() else None
    found = name.found() if name is not None else None
    if found is not None:
        trace, out = found
        program, tree = Program(trace), jax.tree.structure(out, is_leaf=kept.is_slot)
    else:
        closed, shape = jax.make_jaxpr(function, return_shape=True)(*given)
        trace, tree = Reader().read(closed), jax.tree.structure(shape)
        program = Program(trace)
        if name is not None:
            content = trace, jax.tree.unflatten(tree, [kept.Slot()] * tree.num_leaves)
            name.put(lambda: content if program.lasts else None)
    values, _steps = program.run(jax.tree.leaves(given))
    return jax.tree.unflatten(tree, values)


def _without_numbers(given: Any) -> tuple[Any, list[Any]]:
    """Arguments with slots in place of their numbers, and what tracing sees of these."""
    leaves, tree = jax.tree.flatten(given)
    sorts = [(np.shape(x), str(jnp.result_type(x)), type(x) in (bool, int, float, complex)) for x in leaves]
    return jax.tree.unflatten(tree, [kept.Slot()] * len(leaves)), sorts
