"""Working something out once: outlets, figures and checks of a unit ask for the same intermediate results."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from functools import wraps
from typing import Any, ParamSpec, TypeVar

import jax.extend

_P = ParamSpec("_P")
_R = TypeVar("_R")
_memory: ContextVar[dict[Any, Any] | None] = ContextVar("granum_shared", default=None)


@contextmanager
def sharing() -> Iterator[None]:
    """While open, what is marked ``@shared`` is worked out once for the same objects."""
    token = _memory.set({})
    try:
        yield
    finally:
        _memory.reset(token)


def shared(method: Callable[_P, _R]) -> Callable[_P, _R]:
    """Marks a method of a unit or a stream: inside ``sharing`` it runs, and is compiled, once for the same arguments."""

    @wraps(method)
    def once(*args: _P.args, **options: _P.kwargs) -> _R:
        memory = _memory.get()
        if memory is None or options:
            return method(*args, **options)
        state = jax.extend.core.get_opaque_trace_state()
        found = memory.setdefault((method, *map(id, args)), [])
        for known, result, _args in found:
            if known == state:
                return result
        result = method(*args, **options)
        found.append((state, result, args))  # the arguments stay alive, so that their ids stay theirs
        return result

    return once
