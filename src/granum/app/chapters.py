"""The figures of the handbook, drawn by the calculations that stand beside its text: a chapter ``DOMAIN.md``
has ``DOMAIN.py`` beside it, which draws the figure NAME in ``figure_NAME``.
"""

from __future__ import annotations
import __future__

import ast
import sys
from collections.abc import Callable, Sequence
from pathlib import Path
from types import ModuleType
from typing import Any

import plotly.graph_objects as go

from granum.app.shipped import chapter_calculations
from granum.core.errors import unknown_name
from granum.core.i18n import _, current_language, language

FIGURE = "figure_"
_FLAGS = __future__.annotations.compiler_flag


def said(english: str, french: str) -> str:
    """Words of a figure in the language it is drawn in."""
    return french if current_language() == "fr" else english


class Calculations:
    """What stands beside a chapter, run as far as somebody asks and each statement once."""

    def __init__(self, place: Path):
        shared = str(place.parent.parent)  # what chapters and the validation have in common
        if shared not in sys.path:
            sys.path.append(shared)
        self._module = ModuleType(f"handbook.{place.stem}")
        self._module.__file__ = str(place)
        sys.modules[self._module.__name__] = self._module  # where classes that it defines look for themselves
        self._statements = ast.parse(place.read_text(encoding="utf-8"), str(place)).body
        self._about = _about(self._statements)
        self._done: set[int] = set()

    @property
    def figures(self) -> list[str]:
        """The names of its figures."""
        given = (name for names, _taken in self._about for name in names)
        return [name.removeprefix(FIGURE) for name in given if name.startswith(FIGURE)]

    def run(self, wanted: str = "", tell: Callable[[float], None] = lambda _share: None) -> dict[str, Any]:
        """What is defined, by name, once all has run that ``wanted`` needs, else everything."""
        left = sorted((self._needed(wanted) if wanted else set(range(len(self._statements)))) - self._done)
        for count, number in enumerate(left):
            tell(count / len(left))
            part = ast.Module([self._statements[number]], [])
            exec(compile(part, str(self._module.__file__), "exec", _FLAGS, True), vars(self._module))
            self._done.add(number)
        return vars(self._module)

    def _needed(self, wanted: str) -> set[int]:
        names, found = {wanted}, set[int]()
        while more := {
            i for i, (given, _taken) in enumerate(self._about) if i not in found and given & names
        }:
            found |= more
            names = names.union(*(self._about[i][1] for i in more))
        return found


def _about(statements: Sequence[ast.stmt]) -> list[tuple[set[str], set[str]]]:
    """Of each statement the names that have their value by it, and those that it takes; what may change a
    thing in place gives that too.
    """
    told, declared = [], set[str]()
    for one in statements:
        nodes = [node for node in ast.walk(one) if isinstance(node, ast.Name)]
        taken = {node.id for node in nodes}
        if isinstance(one, (ast.FunctionDef, ast.ClassDef)):
            given = {one.name}
        elif isinstance(one, (ast.Import, ast.ImportFrom)):
            given = {alias.asname or alias.name.partition(".")[0] for alias in one.names}
        elif isinstance(one, (ast.Assign, ast.AnnAssign)):
            given = {node.id for node in nodes if isinstance(node.ctx, ast.Store)} or taken
        else:
            given = taken - declared
        if isinstance(one, (ast.FunctionDef, ast.ClassDef, ast.Import, ast.ImportFrom)):
            declared |= given
        told.append((given, taken))
    return told


_known: dict[str, Calculations] = {}


def _calculations(domain: str) -> Calculations:
    known = chapter_calculations()
    if domain not in known:
        raise unknown_name(_("Chapter"), domain, known, quantities=False)
    if domain not in _known:
        _known[domain] = Calculations(known[domain])
    return _known[domain]


def calculated(domain: str) -> dict[str, Any]:
    """What the calculations of a chapter define, by name; they run once."""
    return _calculations(domain).run()


def chapter_figure(
    domain: str, name: str, code: str, tell: Callable[[float], None] = lambda _share: None
) -> go.Figure:
    """A figure of a chapter in a language; ``tell`` hears which share of what it needs is calculated."""
    chapter = _calculations(domain)
    if name not in chapter.figures:
        raise unknown_name(_("Figure of the chapter"), name, chapter.figures, quantities=False)
    parts = chapter.run(FIGURE + name, tell)
    with language(code):
        chart = parts[FIGURE + name]()
    chart.update_layout(title=None)  # the caption says it
    if code == "fr":
        chart.update_layout(separators=",\u202f")
    return chart
