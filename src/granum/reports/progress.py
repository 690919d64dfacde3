"""A spinner or a bar on the terminal for work that takes longer than a moment."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any


@contextmanager
def working(what: str, quiet: bool = False) -> Iterator[None]:
    """Shows what is being done while the block runs; nothing when quiet or when the output is not a
    terminal.
    """
    from rich.console import Console

    console = Console(stderr=True)
    if quiet or not console.is_terminal:
        yield
        return
    with console.status(what + " …"):
        yield


@contextmanager
def watching(what: str, quiet: bool = False) -> Iterator[Callable[[str, int, float], None] | None]:
    """Shows how far each loop of a line is while the block solves it: gives the function to tell; None as for
    ``advancing``.
    """
    from rich.console import Console

    from granum.core.i18n import _
    from granum.core.units import format_number

    console = Console(stderr=True)
    if quiet or not console.is_terminal:
        yield None
        return
    with console.status(what + " …") as status:

        def tell(loop: str, number: int, residual: float) -> None:
            told = _("loop through '{stream}': pass {number}, residual {residual}")
            status.update(
                f"{what} · {told.format(stream=loop, number=number, residual=format_number(residual, 2))}"
            )

        yield tell


@contextmanager
def advancing(what: str, quiet: bool = False) -> Iterator[Callable[[Any], None] | None]:
    """A bar for a study: gives the function to call with its progress; None when quiet or when the output is
    not a terminal.
    """
    from rich.console import Console
    from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeRemainingColumn

    from granum.core.i18n import _

    console = Console(stderr=True)
    if quiet or not console.is_terminal:
        yield None
        return
    columns = (
        TextColumn("{task.description}"),
        BarColumn(),
        MofNCompleteColumn(),
        TimeRemainingColumn(),
        TextColumn("{task.fields[note]}"),
    )
    with Progress(*columns, console=console, transient=True) as bar:
        task = bar.add_task(what, total=None, note="")

        def show(found: Any) -> None:
            note = _("{count} failed").format(count=found.failed) if found.failed else found.note
            bar.update(task, completed=found.done, total=found.total, note=note)

        yield show
