"""Equations as MathML, so that reports and pages need no script to show them. A contract test converts every
card's equation.
"""

from __future__ import annotations

import re
from functools import lru_cache

from granum.core.i18n import _, current_language
from granum.core.units import pretty_unit


def mathml(latex: str, display: bool = False) -> str:
    """MathML of a LaTeX formula, with words and decimal sign of the current language."""
    return _converted(latex, display, current_language()) if latex else ""


def equation_lines(latex: str) -> str:
    """MathML of an equation, what is defined after it each on a line of its own."""
    return "".join(mathml(line, display=True) for line in _lines(latex))


def words_of(latex: str) -> list[str]:
    """The words that stand in an equation.

    >>> words_of(r"x\\text{ in }\\mathrm{mm}")
    ['in']
    """
    return [word.strip() for word in re.findall(r"\\text\{([^{}]*)\}", latex)]


@lru_cache(maxsize=4096)
def _converted(latex: str, display: bool, language: str) -> str:
    from latex2mathml.converter import convert

    if language != "en":
        latex = re.sub(r"\\text\{(\s*)([^{}]*?)(\s*)\}", lambda m: rf"\text{{{m[1]}{_(m[2])}{m[3]}}}", latex)
        latex = re.sub(r"\\mathrm\{(rpm)\}", lambda m: rf"\mathrm{{{pretty_unit(m[1])}}}", latex)
    shown = convert(latex, display="block" if display else "inline")
    return shown if language == "en" else re.sub(r"(?<=\d)\.(?=\d+</mn>)", ",", shown)


def _lines(latex: str) -> list[str]:
    """An equation broken where a wide space follows a comma that stands in no bracket."""
    lines, depth, start = [], 0, 0
    for found in re.finditer(
        r"\\left|\\right|[{}]|\\begin|\\end|[,;](?:\s|\\[;, ])*\\q?quad(?![A-Za-z])", latex
    ):
        word = found[0]
        depth += (word in ("{", r"\left", r"\begin")) - (word in ("}", r"\right", r"\end"))
        if word[0] in ",;" and depth == 0:
            lines.append(latex[start : found.start()])
            start = found.end()
    return [*lines, latex[start:]]
