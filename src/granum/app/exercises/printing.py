"""Exercises on the terminal: the list, one of them with its numbers, the sheet of a class."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

from rich.console import Console
from rich.text import Text

from granum.app import exercises
from granum.app.exercises.answers import answers, sheet
from granum.core.errors import InputError
from granum.core.files import write_atomic
from granum.core.i18n import _

SPAN = re.compile(r"(\d{1,9})(?:\s*[-–…]\s*(\d{1,9}))?")


def print_listing() -> None:
    """All exercises by domain, in the order of the course."""
    console = Console(highlight=False)
    told = exercises.listing()["domains"]
    width = max(len(e["id"]) for domain in told for e in domain["exercises"])
    for domain in told:
        console.print(Text(domain["label"], style="bold"))
        for one in domain["exercises"]:
            steps = _("{count} steps").format(count=one["steps"])
            console.print(
                Text.assemble(f"  {one['id'].ljust(width)}  {one['title']}", (f" · {steps}", "dim"))
            )
    console.print(_("{count} exercises").format(count=sum(len(d["exercises"]) for d in told)))


def told(name: str, seed: int | None, solved: bool) -> dict[str, Any]:
    """An exercise as plain data, with its answers where they are wanted."""
    found = exercises.worked(name, seed)
    return found | ({"answers": answers(name, seed)} if solved else {})


def print_exercise(name: str, seed: int | None, solved: bool) -> None:
    """Statement and questions; the answers and errata where they are wanted."""
    console = Console(highlight=False)
    found = told(name, seed, solved)
    console.print(Text(found["title"], style="bold"), Text(found["source"], style="dim"))
    console.print(found["statement"], markup=False)
    for place, step in enumerate(found["steps"]):
        console.print(f"{place + 1}. {step['ask']}", markup=False)
        for choice in step["choices"]:
            console.print(f"   – {choice['says']}", markup=False)
        if solved:
            right = found["answers"][place]
            console.print(f"   = {right['text']}", style="bold", markup=False)
            for more in filter(None, (right["why"], step["erratum"])):
                console.print(f"     {more}", markup=False)


def give_sheet(name: str, seeds: str, out: Path | None) -> None:
    """The teacher's sheet of the seeds ``1-30``, printed or written."""
    span = SPAN.fullmatch(seeds.strip())
    if span is None:
        raise InputError(
            _("'{text}' is no span of seeds such as 1-30.").format(text=seeds), name="seeds", value=seeds
        )
    first = int(span[1])
    text = sheet(name, first, int(span[2] or first))
    if out is None:
        print(text, end="")
    else:
        write_atomic(out, text)
        print(_("saved to {path}").format(path=out))
