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


def equation_wrapped(latex: str) -> str:
    """The same with places where a line may end: before a relation, a sum or a product that stands in no
    bracket. Browsers end no lines within mathematics by themselves.

    >>> equation_wrapped(r"a = b + \\frac{c + d}{e}").count("<math")
    3
    """
    return "".join(
        f'<div class="wrapped">{"".join(_piece(p) for p in _pieces(line))}</div>' for line in _lines(latex)
    )


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


def _piece(latex: str) -> str:
    shown = mathml(latex).replace('display="inline"', 'display="inline" displaystyle="true"', 1)
    # an empty row is space, after which an operator would count as one in front
    return shown.replace("<mrow><mrow />", "<mrow><mi></mi>", 1)


_BREAKS = r"=|\\approx|\\Rightarrow|\\(?:cdot|times)(?![a-z])|(?<=[^\s=+\-(])\s*[+\-]"
_NESTED = r"\\left\W|\\right\W|[{}()]|\\begin|\\end"


def _pieces(latex: str) -> list[str]:
    """What may not be torn apart; an operator in front keeps the room of one between two numbers."""
    pieces, depth, start = [], 0, 0
    for found in re.finditer(f"{_NESTED}|{_BREAKS}", latex):
        word = found[0].strip()
        if word.startswith((r"\left", "{", "(", r"\begin")):
            depth += 1
        elif word.startswith((r"\right", "}", ")", r"\end")):
            depth -= 1
        elif depth == 0 and latex[start : found.start()].strip():
            pieces.append(latex[start : found.start()])
            start = found.start()
    whole = [*pieces, latex[start:]]
    return [whole[0], *("{}" + piece for piece in whole[1:])]


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
