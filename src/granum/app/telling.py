"""How a task in a worker process says how far it is, and hears that nobody wants it any more."""

from __future__ import annotations

from collections.abc import Callable

from granum.core.i18n import _


class Cancelled(Exception):
    """The task is no longer wanted."""


class Tell:
    """Told by a task: ``tell(0.3, "solving")``. Raises ``Cancelled`` when the task is no longer wanted.

    Parameters
    ----------
    send: takes the share done (0 to 1) and what is being done, in words.
    stopped: whether the task is no longer wanted; asked by tasks that can stop with a part of their result.
    """

    def __init__(
        self, send: Callable[[float, str], None] | None = None, stopped: Callable[[], bool] = lambda: False
    ):
        self._send, self.stopped = send, stopped

    def __call__(self, share: float, note: str = "") -> None:
        if self.stopped():
            raise Cancelled
        self.say(share, note)

    def say(self, share: float, note: str = "") -> None:
        """Tell without stopping."""
        if self._send is not None:
            self._send(share, note)


def count_text(count: int) -> str:
    """A whole number with thin spaces between its thousands.

    >>> count_text(3000) == "3\u202f000"
    True
    """
    return f"{count:,}".replace(",", "\u202f")


def progress_text(done: int, total: int, failed: int, left: float | None) -> str:
    """``412 of 3 000, 2 failed, about 40 s left``; ``left`` are seconds, None when nobody can know yet."""
    parts = [_("{done} of {total}").format(done=count_text(done), total=count_text(total))]
    if failed:
        parts.append(_("{count} failed").format(count=count_text(failed)))
    if left is not None:
        seconds = max(round(left, -1 if left > 20 else 0), 1)
        time = f"{seconds:.0f} s" if seconds < 120 else f"{left / 60:.0f} min"
        parts.append(_("about {time} left").format(time=time))
    return ", ".join(parts)
