"""What a request may cost: size, time and how many at once."""

from __future__ import annotations

import asyncio
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from typing import Any

from granum.core.errors import GranumError
from granum.core.i18n import _

LARGEST_BODY = 5_000_000  # bytes
LONGEST = 60.0  # seconds for one request
WAITING = 400  # requests that may wait for a worker before newcomers are told to come back


class Busy(GranumError):
    """More requests than can be served."""


class Workers:
    """A small pool for the computing part of requests, with a bounded queue."""

    def __init__(self, count: int = 4):
        self._pool = ThreadPoolExecutor(count, thread_name_prefix="granum")
        self._waiting = 0

    async def run(self, work: Callable[[], Any]) -> Any:
        """Run work in the pool; raises ``Busy`` when the queue is full or the work takes too long."""
        import contextvars

        if self._waiting >= WAITING:
            raise Busy(_("The server is busy. Try again in a moment."))
        self._waiting += 1
        context = contextvars.copy_context()
        try:
            task = asyncio.get_running_loop().run_in_executor(self._pool, context.run, work)
            return await asyncio.wait_for(task, LONGEST)
        except TimeoutError:
            raise Busy(_("The calculation took longer than {seconds} s and was given up.").format(seconds=int(LONGEST))) from None
        finally:
            self._waiting -= 1
