"""Watching a line being solved: how far each loop is, a limit of time, and a way to stop that keeps the last
iterate.
"""

from __future__ import annotations

import contextvars
import threading
import time
from collections.abc import Callable
from typing import Any, TypeVar

_T = TypeVar("_T")


class Watch:
    """Told of every pass through a loop while a line is being solved; asks the solver to stop when told to,
    or when time is up.

    Parameters
    ----------
    tell: called with (loop, pass, residual) at most every quarter of a second.
    seconds: the most time to spend, none by default.
    """

    def __init__(self, tell: Callable[[str, int, float], None] | None = None, seconds: float | None = None):
        self._tell, self.seconds = tell, seconds
        self._until = time.monotonic() + seconds if seconds else float("inf")
        self._told = 0.0
        self.stopped = False
        self.passes = 0
        self.residual = float("nan")

    @property
    def late(self) -> bool:
        """Whether the time was up."""
        return time.monotonic() > self._until

    def stop(self) -> None:
        """Ask for the last iterate after the pass that is under way."""
        self.stopped = True

    def seen(self, loop: str, number: int, residual: float) -> bool:
        """Take note of so many passes; whether to stop here."""
        self.passes, self.residual = number, residual
        now = time.monotonic()
        if self._tell is not None and now - self._told > 0.25:
            self._told = now
            self._tell(loop, number, residual)
        return self.stopped or now > self._until

    def run(self, work: Callable[[], _T]) -> _T:
        """Run ``work`` in a thread of its own, so that Ctrl-C reaches it between two passes.

        The first Ctrl-C stops at the last iterate; a second one gives up at once.
        """
        outcome: list[Any] = []

        def inside() -> None:
            try:
                outcome.append((work(), None))
            except BaseException as problem:  # handed on to the caller's thread below
                outcome.append((None, problem))

        thread = threading.Thread(target=contextvars.copy_context().run, args=(inside,), daemon=True)
        thread.start()
        while thread.is_alive():
            try:
                thread.join(0.2)
            except KeyboardInterrupt:
                if self.stopped:
                    raise
                self.stop()
        found, problem = outcome[0]
        if problem is not None:
            raise problem
        return found
