"""Traced programs as plain data: what JAX traced, without what only its compiler needs, so that it can be run
by NumPy and kept for another process.
"""

from __future__ import annotations

import math
from enum import Enum
from typing import Any, NamedTuple

import numpy as np
from jax.extend.core import ClosedJaxpr, Literal


class Shaped(NamedTuple):
    """Shape and type of a value."""

    shape: tuple[int, ...]
    dtype: np.dtype

    @property
    def size(self) -> int:
        """How many numbers it has."""
        return math.prod(self.shape)

    @property
    def ndim(self) -> int:
        """How many axes it has."""
        return len(self.shape)


class Operation(NamedTuple):
    """One operation of a program: name and parameters, places of what it takes and makes, their shapes, and
    JAX's own form of it where it was traced in this process.
    """

    name: str
    params: dict[str, Any]
    ins: tuple[int, ...]
    outs: tuple[int, ...]
    given: tuple[Shaped, ...]
    made: tuple[Shaped, ...]
    whole: Any = None

    def __reduce__(self) -> Any:
        return Operation, self[:-1]  # JAX's own form does not leave the process


class Trace(NamedTuple):
    """A program: constants, one a place, None where something is still to come; places and shapes of what it
    takes; its operations; places and shapes of what it gives.
    """

    known: list[Any]
    takes: tuple[int, ...]
    given: tuple[Shaped, ...]
    operations: list[Operation]
    gives: tuple[int, ...]
    made: tuple[Shaped, ...]


INNER: dict[str, tuple[str, ...]] = {
    "jit": ("jaxpr",),
    "pjit": ("jaxpr",),
    "closed_call": ("call_jaxpr",),
    "custom_jvp_call": ("call_jaxpr",),
    "custom_vjp_call": ("call_jaxpr",),
    "while": ("cond_jaxpr", "body_jaxpr"),
    "cond": ("branches",),
    "scan": ("jaxpr",),
}
"""The programs within an operation, by the names that JAX gives them."""


class Reader:
    """Reads programs that JAX traced, each inner one once however often it is called.

    >>> import jax
    >>> trace = Reader().read(jax.make_jaxpr(lambda x: 3.0 * x + 1.0)(2.0))
    >>> [operation.name for operation in trace.operations]
    ['mul', 'add']
    """

    def __init__(self) -> None:
        self._read: dict[int, Trace] = {}
        self._shapes: dict[tuple[Any, Any], Shaped] = {}

    def read(self, closed: ClosedJaxpr) -> Trace:
        """The same program as plain data."""
        found = self._read.get(id(closed.jaxpr)) if not closed.consts else None
        if found is not None:
            return found
        found = self._one(closed)
        if not closed.consts:
            self._read[id(closed.jaxpr)] = found
        return found

    def _one(self, closed: ClosedJaxpr) -> Trace:
        jaxpr, places, known = closed.jaxpr, {}, []

        def place(atom: Any) -> int:
            if isinstance(atom, Literal):
                known.append(np.asarray(atom.val, atom.aval.dtype)[()])
                return len(known) - 1
            if atom not in places:
                places[atom] = len(known)
                known.append(None)
            return places[atom]

        def all_of(atoms: Any) -> tuple[tuple[int, ...], tuple[Shaped, ...]]:
            return tuple(map(place, atoms)), tuple(map(self._shaped, atoms))

        for variable, constant in zip(jaxpr.constvars, closed.consts, strict=True):
            known[place(variable)] = np.asarray(constant)[()]
        takes, given = all_of(jaxpr.invars)
        operations = []
        for eqn in jaxpr.eqns:
            (ins, taken), (outs, made) = all_of(eqn.invars), all_of(eqn.outvars)
            operations.append(Operation(eqn.primitive.name, self._params(eqn), ins, outs, taken, made, eqn))
        gives, made = all_of(jaxpr.outvars)
        return Trace(known, takes, given, operations, gives, made)

    def _shaped(self, atom: Any) -> Shaped:
        key = atom.aval.shape, atom.aval.dtype
        found = self._shapes.get(key)
        if found is None:
            found = self._shapes[key] = Shaped(*key)
        return found

    def _params(self, eqn: Any) -> dict[str, Any]:
        if eqn.primitive.name == "custom_linear_solve":
            counts = eqn.params["const_lengths"]
            before = counts.matvec + counts.vecmat
            after = before + counts.solve + counts.transpose_solve
            solve = self.read(eqn.params["jaxprs"].solve)
            return {"solve": solve, "before": before, "constants": counts.solve, "after": after}
        inner = INNER.get(eqn.primitive.name, ())
        plain = {name: value for name, value in eqn.params.items() if name not in inner and is_plain(value)}
        return plain | {name: self._inner(eqn.params[name]) for name in inner}

    def _inner(self, program: Any) -> Any:
        if isinstance(program, tuple):
            return tuple(map(self.read, program))
        return self.read(program if isinstance(program, ClosedJaxpr) else ClosedJaxpr(program, ()))


def is_plain(value: Any) -> bool:
    """Whether a parameter of an operation is numbers, words and nothing else.

    >>> is_plain((1, None, np.dtype(float))), is_plain(print)
    (True, False)
    """
    if isinstance(value, tuple | list):
        return all(map(is_plain, value))
    if isinstance(value, type):
        return value.__module__ in ("builtins", "numpy")
    return value is None or isinstance(value, bool | int | float | str | np.dtype | np.generic | Enum)
