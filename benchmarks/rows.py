"""What a benchmark measured, and how it is handed over.

Standard library alone: the peak memory that Linux states for a child is at least that of its parent, so the
scripts that measure commands must stay small.
"""

from __future__ import annotations

import importlib
import json
import os
from collections.abc import Mapping
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Any, Literal

COLLECTOR = "GRANUM_BENCHMARK_ROWS"
"""Environment variable that names the file in which rows are collected."""

Kind = Literal["peer", "alone", "start", "line", "recycle", "server", "dyssol"]


@dataclass(frozen=True)
class Row:
    """One question and what it cost; a peer without seconds is not installed."""

    question: str
    seconds: float | None = None
    peer: str | None = None
    peer_seconds: float | None = None
    agreement: str = ""
    kind: Kind = "peer"
    figures: Mapping[str, float | str] = field(default_factory=dict)
    script: str = ""  # filled in by the command that collects

    @property
    def ratio(self) -> float | None:
        """How many times longer the peer takes; of a start, how many times longer Granum takes."""
        if self.seconds is None or self.peer_seconds is None:
            return None
        return self.seconds / self.peer_seconds if self.kind == "start" else self.peer_seconds / self.seconds

    def __str__(self) -> str:
        words = [] if self.seconds is None else [spelled(self.seconds)]
        if self.peer:
            words.append(against(self))
        if self.ratio is not None:
            words.append(f"ratio {number(self.ratio)}")
        words += [f"{name} {cell(value)}" for name, value in self.figures.items()]
        return f"{self.question}: " + ", ".join([*words, *filter(None, [self.agreement])])


def number(x: float) -> str:
    """Two digits, or as many as stand before the point."""
    return f"{x:.0f}" if abs(x) >= 9.95 else f"{x:.2g}"


def spelled(seconds: float) -> str:
    """A time in the unit that suits it."""
    unit, size = next(
        ((unit, size) for unit, size in (("s", 1.0), ("ms", 1e-3)) if seconds >= 0.995 * size), ("µs", 1e-6)
    )
    return f"{number(seconds / size)} {unit}"


def cell(value: float | str) -> str:
    """A figure as text."""
    return value if isinstance(value, str) else number(value)


def against(row: Row) -> str:
    """The peer and its time."""
    return f"{row.peer}: " + ("not installed" if row.peer_seconds is None else spelled(row.peer_seconds))


def tell(row: Row) -> None:
    """Print a row, and hand it to the command that collects if there is one."""
    print(row, flush=True)
    if path := os.environ.get(COLLECTOR):
        with Path(path).open("a", encoding="utf-8") as file:
            file.write(json.dumps(asdict(row), ensure_ascii=False) + "\n")


def installed(name: str) -> Any:
    """The module of a peer; None where it is not installed."""
    try:
        return importlib.import_module(name)
    except ImportError:
        return None
