"""The figures of the handbook, drawn by the calculations that stand beside its text: a chapter ``DOMAIN.md``
has ``DOMAIN.py`` beside it, which draws the figure NAME in ``figure_NAME``.
"""

from __future__ import annotations
import __future__

import ast
import sys
from collections.abc import Callable
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


_known: dict[str, dict[str, Any]] = {}


def calculated(domain: str, tell: Callable[[float], None] = lambda _share: None) -> dict[str, Any]:
    """What the calculations of a chapter define, by name; they run once, and ``tell`` hears which share of
    them is done.
    """
    if domain not in _known:
        _known[domain] = _run(domain, tell)
    return _known[domain]


def _run(domain: str, tell: Callable[[float], None]) -> dict[str, Any]:
    known = chapter_calculations()
    if domain not in known:
        raise unknown_name(_("Chapter"), domain, known, quantities=False)
    shared = str(known[domain].parent.parent)  # what chapters and the validation have in common
    if shared not in sys.path:
        sys.path.append(shared)
    module = ModuleType(f"handbook.{domain}")
    module.__file__ = str(known[domain])
    sys.modules[module.__name__] = module  # where classes that it defines look for themselves
    statements = ast.parse(known[domain].read_text(encoding="utf-8"), module.__file__).body
    for done, statement in enumerate(statements):
        tell(done / len(statements))
        part = ast.Module([statement], [])
        exec(compile(part, module.__file__, "exec", _FLAGS, True), vars(module))
    return vars(module)


def chapter_figure(
    domain: str, name: str, code: str, tell: Callable[[float], None] = lambda _share: None
) -> go.Figure:
    """A figure of a chapter in a language."""
    parts = calculated(domain, tell)
    figures = [part.removeprefix(FIGURE) for part in parts if part.startswith(FIGURE)]
    if name not in figures:
        raise unknown_name(_("Figure of the chapter"), name, figures, quantities=False)
    with language(code):
        chart = parts[FIGURE + name]()
    chart.update_layout(title=None)  # the caption says it
    if code == "fr":
        chart.update_layout(separators=",\u202f")
    return chart
