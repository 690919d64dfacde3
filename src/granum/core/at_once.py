"""Methods that calculate with numbers, as one program where Python calls them: operation by operation each
would be compiled by itself, a hundredth of a second for every one.
"""

from __future__ import annotations

import functools
import inspect
from collections.abc import Callable
from typing import Any

import jax
import jax.numpy as jnp
import numpy as np

from granum.core import flags
from granum.core.packing import as_arrays, compiled, of_jax
from granum.core.steps import recorded

NUMBERS = (float, int, np.ndarray, np.generic, jax.Array)


def at_once(*fixed: str, **read: Callable[[Any], Any]) -> Callable[[Callable[..., Any]], Callable[..., Any]]:
    """Declare a function or method to be traced as a whole for numbers and run by NumPy, or compiled when it
    is called often (``granum.core.compiling``); what it flags is told as ever. Inside a trace, and where its
    steps are written down, it is the function itself; and so where a result is not finite or lies outside its
    domain, since single values are then refused in words.

    Parameters
    ----------
    fixed: arguments that are part of the program: words, or numbers on which Python decides.
    read: how an argument becomes a number in SI units, where it may be text with a unit.

    >>> @at_once("power")
    ... def of_power(x, power=1):
    ...     return x**power if power else 1.0
    >>> of_power(3.0, 2)
    np.float64(9.0)
    """

    def declare(function: Callable[..., Any]) -> Callable[..., Any]:
        signature = inspect.signature(function)

        @functools.wraps(function)
        def program(names: tuple[str, ...], heard: bool, *values: Any) -> Any:
            with flags.collect(0 if heard else flags.OUTSIDE_DOMAIN) as records:
                out = function(**dict(zip(names, values, strict=True)))
            leaves = [jnp.asarray(x) for x in jax.tree.leaves(out)]
            lost = [jnp.any(~jnp.isfinite(x)) for x in leaves if jnp.issubdtype(x.dtype, jnp.inexact)]
            lost += [jnp.any(r.mask) for r in records if r.bit == flags.OUTSIDE_DOMAIN]
            doubtful = functools.reduce(jnp.logical_or, lost, jnp.zeros((), bool))
            return jax.tree.map(jnp.asarray, out), doubtful, records if heard else []

        quick = compiled(program)

        @functools.wraps(function)
        def call(*args: Any, **kwargs: Any) -> Any:
            if flags.is_inner() or flags.nested() or recorded() is not None:
                return function(*args, **kwargs)
            given = signature.bind(*args, **kwargs).arguments
            for name, reader in read.items():
                if name in given:
                    given[name] = reader(given[name])
            values = {name: x if name in fixed else _as_numbers(x) for name, x in given.items()}
            heard = flags.listening()
            try:
                out, doubtful, records = quick(tuple(values), heard, *values.values())
            except TypeError:  # something that is no number, or cannot stand in the name of a program
                return function(**given)
            if doubtful:
                return function(**given)
            flags.hand_on(records)
            return of_jax(out)

        return call

    return declare


def _as_numbers(value: Any) -> Any:
    """Numbers of any sort as arrays, those within a module too."""
    if isinstance(value, list | tuple):
        alike = all(isinstance(x, NUMBERS) for x in value)
        return np.asarray(value, dtype=float) if value and alike else as_arrays(value)
    if isinstance(value, NUMBERS) and not isinstance(value, bool):
        return np.asarray(value, dtype=float)
    return as_arrays(value)
