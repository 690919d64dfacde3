"""The list of cards on the terminal; loads nothing that calculates."""

from __future__ import annotations

from collections.abc import Sequence

from rich.console import Console
from rich.text import Text

from granum.core.i18n import _
from granum.core.index import Entry


def print_list(cards: Sequence[Entry]) -> None:
    """The outcome of ``granum list``: one line a card, whole where the output goes to a file or another
    program.
    """
    console = Console(highlight=False)
    width = max((len(card.key) for card in cards), default=0)
    lines = Text("\n").join(
        Text.assemble(
            (card.key.ljust(width), "bold"),
            "  ",
            card.title,
            ("" if card.sort == "formula" else f" ({_(card.sort)})", "dim"),
        )
        for card in cards
    )
    if cards:
        console.print(
            lines,
            no_wrap=True,
            overflow="ellipsis" if console.is_terminal else "ignore",
            crop=console.is_terminal,
        )
    console.print(_("{count} cards").format(count=len(cards)))
