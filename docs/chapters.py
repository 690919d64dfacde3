"""The calculations of the handbook: ``docs/handbook/DOMAIN.py`` calculates what the chapter of that domain
states in each language, and draws its figures (``figure_NAME``). Results are kept in ``.cache`` by the
content of everything they come from, so that only what changed is calculated again.
"""

from __future__ import annotations

import hashlib
import json
import multiprocessing
import re
import sys
from concurrent.futures import ProcessPoolExecutor
from functools import cache
from pathlib import Path
from typing import Any

from granum.app.chapters import calculated, chapter_figure
from granum.app.shipped import chapter_calculations
from granum.core.files import write_atomic
from granum.core.i18n import language
from granum.core.unit_names import parse_unit, registry
from granum.reports.moving_figures import moving_figure
from granum.reports.stated import STATED, Number, stated_number

DOCS = Path(__file__).parent
ROOT = DOCS.parent
KEPT = ROOT / ".cache" / "handbook"
PLACES = {"en": "handbook/{}.md", "fr": "fr/manuel/{}.md"}
MOVING = re.compile(r"^\[\[moving (\w+)\]\]$", re.MULTILINE)
FIGURE = re.compile(r"^\[\[figure (\w+)\]\]\n\n\*(.+)\*$", re.MULTILINE)
LOOKED_AT = ("src/granum/**/*.py", "src/granum/**/*.toml", "src/granum/**/*.csv", "src/granum/**/*.po")


def domains() -> list[str]:
    """Domains that have a chapter."""
    return sorted(chapter_calculations())


def chapter_text(domain: str, code: str) -> str:
    """The chapter of a domain in a language, as it is written."""
    return (DOCS / PLACES[code].format(domain)).read_text(encoding="utf-8")


@cache
def _program() -> bytes:
    told = hashlib.sha256()
    for pattern in (*LOOKED_AT, "examples/**/*.csv", "docs/chapters.py", "docs/validation.py"):
        for place in sorted(ROOT.glob(pattern)):
            told.update(place.read_bytes())
    return told.digest()


def _place(domain: str, what: str) -> Path:
    """Where something of a chapter is kept, by all it is made from."""
    calculation = DOCS / "handbook" / f"{domain}.py"
    own = calculation.read_bytes() if calculation.is_file() else b""
    name = hashlib.sha256(b"\0".join((_program(), own, what.encode()))).hexdigest()[:24]
    return KEPT / f"{domain}-{name}.json"


def _kept(domain: str, what: str, make: Any) -> Any:
    """What was made before from the same content, or what is made now."""
    place = _place(domain, what)
    if place.is_file():
        return json.loads(place.read_text(encoding="utf-8"))
    made = make()
    KEPT.mkdir(parents=True, exist_ok=True)
    write_atomic(place, json.dumps(made))
    return made


def prepare() -> None:
    """Make what chapters need on every core, each chapter in a process of its own that gives its memory back,
    and the figures that move. What is kept already is not made again.
    """
    left = [domain for domain in domains() if not _place(domain, _stated(domain)).is_file()]
    left.sort(key=lambda domain: -len(chapter_text(domain, "en")))  # the longest first
    if str(DOCS) not in sys.path:
        sys.path.append(str(DOCS))  # where the other processes find this module
    fresh = multiprocessing.get_context("spawn")
    with ProcessPoolExecutor(mp_context=fresh, max_tasks_per_child=1) as pool:
        for one in [
            *(pool.submit(make, domain) for domain in left),
            *(pool.submit(move, code) for code in PLACES),
        ]:
            one.result()


def move(code: str) -> None:
    """The figures that move, in a language."""
    pages = "\n".join(page.read_text(encoding="utf-8") for page in sorted(DOCS.rglob("*.md")))
    for name in sorted(set(MOVING.findall(pages))):
        frames(name, code)


def make(domain: str) -> None:
    """Values and figures of a chapter in every language."""
    values(domain)
    for code in PLACES:
        for found in FIGURE.finditer(chapter_text(domain, code)):
            figure(domain, found[1], code)


def values(domain: str) -> dict[str, float]:
    """Every expression stated in the chapter of a domain, in SI units."""
    asked = _stated(domain)
    return _kept(
        domain, asked, lambda: {e: float(eval(e, dict(calculated(domain)))) for e in asked.splitlines()}
    )


def _stated(domain: str) -> str:
    """The expressions that a chapter states, a line each."""
    found = (STATED.finditer(chapter_text(domain, code)) for code in PLACES)
    return "\n".join(sorted({match[1] for matches in found for match in matches}))


def figure(domain: str, name: str, code: str) -> str:
    """A figure of a chapter in a language, as JSON for Plotly."""

    def drawn() -> str:
        return str(chapter_figure(domain, name, code).to_json())

    return _kept(domain, f"{name} {code}", drawn)


def frames(name: str, code: str) -> str:
    """A figure that moves in a language, at all positions of its sliders, as JSON."""

    def drawn() -> str:
        with language(code):
            return json.dumps(moving_figure(name).frames(), separators=(",", ":"), allow_nan=False)

    return _kept("moving", f"{name} {code}", drawn)


def in_si(number: Number) -> tuple[float, float]:
    """The least and the greatest value in SI units that rounds to a stated number."""
    unit = parse_unit(number.unit or "dimensionless")
    ends = (number.value - 0.5 * number.step, number.value + 0.5 * number.step)
    low, high = (registry().Quantity(end, unit).to_base_units().magnitude for end in ends)
    return low, high


def moved(domain: str, code: str) -> list[str]:
    """Statements of a chapter that the calculation no longer gives, in words."""
    found = []
    known = values(domain)
    for match in STATED.finditer(chapter_text(domain, code)):
        low, high = in_si(stated_number(match[2]))
        slack = 1e-9 * max(abs(low), abs(high))
        if not low - slack <= known[match[1]] <= high + slack:
            found.append(
                f"{PLACES[code].format(domain)} states {match[1]} = {match[2]}, "
                f"calculated {known[match[1]]:.6g} SI (stated {low:.6g} to {high:.6g})"
            )
    return found
