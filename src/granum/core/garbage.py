"""How often a process looks for garbage that refers to itself."""

from __future__ import annotations

import gc


def collect_seldom() -> None:
    """Tracing makes hundreds of thousands of small objects that stay, and Python's own thresholds look
    through all of them again and again: a fifth of the time of a first run. For whole programs, not for a
    package in somebody else's process.

    >>> collect_seldom()
    >>> gc.get_threshold()[0]
    20000
    """
    gc.set_threshold(20_000, 20, 100)
