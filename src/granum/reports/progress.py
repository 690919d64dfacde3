"""A spinner on the terminal for work that takes longer than a moment."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager


@contextmanager
def working(what: str, quiet: bool = False) -> Iterator[None]:
    """Shows what is being done while the block runs; nothing when quiet or when the output is not a terminal."""
    from rich.console import Console

    console = Console(stderr=True)
    if quiet or not console.is_terminal:
        yield
        return
    with console.status(what + " …"):
        yield
