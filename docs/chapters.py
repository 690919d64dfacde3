"""The calculations of the handbook: ``docs/handbook/DOMAIN.py`` calculates what the chapter of that domain
states in each language, and draws its figures (``figure_NAME``). Results are kept in ``.cache`` by the
content of everything they come from, so that only what changed is calculated again.
"""

from __future__ import annotations

import hashlib
import json
from functools import cache
from pathlib import Path
from typing import Any

from granum.app.chapters import calculated, chapter_figure
from granum.app.shipped import chapter_calculations
from granum.core.i18n import language
from granum.core.unit_names import parse_unit, registry
from granum.reports.moving_figures import moving_figure
from granum.reports.stated import STATED, Number, stated_number

DOCS = Path(__file__).parent
ROOT = DOCS.parent
KEPT = ROOT / ".cache" / "handbook"
PLACES = {"en": "handbook/{}.md", "fr": "fr/manuel/{}.md"}
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


def _kept(domain: str, what: str, make: Any) -> Any:
    """What was made before from the same content, or what is made now."""
    return _kept_as(domain, (DOCS / "handbook" / f"{domain}.py").read_bytes(), what, make)


def _kept_as(domain: str, own: bytes, what: str, make: Any) -> Any:
    name = hashlib.sha256(b"\0".join((_program(), own, what.encode()))).hexdigest()[:24]
    place = KEPT / f"{domain}-{name}.json"
    if place.is_file():
        return json.loads(place.read_text(encoding="utf-8"))
    made = make()
    KEPT.mkdir(parents=True, exist_ok=True)
    place.write_text(json.dumps(made), encoding="utf-8")
    return made


def values(domain: str) -> dict[str, float]:
    """Every expression stated in the chapter of a domain, in SI units."""
    asked = sorted({m[1] for code in PLACES for m in STATED.finditer(chapter_text(domain, code))})
    return _kept(
        domain, "\n".join(asked), lambda: {e: float(eval(e, dict(calculated(domain)))) for e in asked}
    )


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

    return _kept_as("moving", b"", f"{name} {code}", drawn)


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
