r"""Equations read back: cut into statements, symbols and signs, and worked out with numbers.

What is not known here (sums over a series, integrals, cases, words such as "in mm") is not guessed:
``UnreadError``.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Iterator, Mapping
from functools import cache
from typing import Any

FUNCTIONS: Mapping[str, Callable[[float], float]] = {
    "ln": math.log,
    "log": math.log10,
    "lg": math.log10,
    "exp": math.exp,
    "sin": math.sin,
    "cos": math.cos,
    "tan": math.tan,
    "cot": lambda angle: 1.0 / math.tan(angle),
    "sinh": math.sinh,
    "cosh": math.cosh,
    "tanh": math.tanh,
    "arctan": math.atan,
    "arcsin": math.asin,
    "arccos": math.acos,
    "arcosh": math.acosh,
    "arsinh": math.asinh,
    "artanh": math.atanh,
    "erf": math.erf,
    "erfc": math.erfc,
}
_SEVERAL: Mapping[str, Callable[..., Any]] = {"min": min, "max": max}
FRACTIONS = (r"\frac", r"\tfrac", r"\dfrac")
_SIZES = tuple(rf"\{size}{side}" for size in ("big", "Big", "bigg", "Bigg") for side in ("", "l", "r"))
SPACES = frozenset((r"\,", r"\ ", r"\!", r"\;", r"\:", r"\left", r"\right", " ", *_SIZES))
_ROMAN = r"\\(?:mathrm|operatorname|text)\s*(?:\{[^{}]*(?:\{[^{}]*\}[^{}]*)*\}|[A-Za-z])"
_TOKEN = re.compile(rf"{_ROMAN}|\\[A-Za-z]+|\\.|\d{{1,3}}(?:\\,\d{{3}})+(?!\d)|\d+(?:\.\d+)?|.", re.DOTALL)
_CLOSES = {"(": ")", "[": "]", "{": "}", r"\{": r"\}", "|": "|"}
_ENDS = frozenset(("", "+", "-", ",", *_CLOSES.values())) - {"|"}
_SEPARATOR = re.compile(r"[,;](?=\s*(?:\\[ ,;:]|\\q?quad(?![A-Za-z])))|\\(?:R|r)ightarrow(?![A-Za-z])")
_LIMIT = re.compile(r"\\[lg]eq?(?![A-Za-z])|[<>]")
_SYMBOL = re.compile(
    r"(?:\\mathrm\{\w+\}|(?:\\(?:dot|bar|hat|tilde|Delta)\s*)?(?:\{\\?[A-Za-z]+\}|\\?[A-Za-z]+))"
    r"(?:_(?:\{[^{}]*\}|\\?\w))?'*(?:\^\*)?"
)


def statements(equation: str) -> list[list[str]]:
    r"""What an equation says, each statement as what stands on the sides of its equals signs; a limit of
    validity behind one is left out.

    >>> statements(r"p = \min(1,\, q),\quad q = \frac{v}{u} \le 2")
    [['p', '\\min(1,\\, q)'], ['q', '\\frac{v}{u}']]
    """
    found = []
    for said in _outside(equation, _SEPARATOR):
        spaces = r"(?:\s|\\[ ,;:]|\\q?quad(?![A-Za-z]))*"
        holds = _outside(said, _LIMIT)[0]
        sides = [re.sub(rf"^{spaces}|{spaces}$", "", side) for side in _outside(holds, re.compile("="))]
        if len(sides) > 1:
            found.append(sides)
    return found


def _outside(text: str, mark: re.Pattern[str]) -> list[str]:
    """A text broken at a mark where it stands in no bracket."""
    pieces, depth, start, at = [], 0, 0, 0
    while at < len(text):
        found = mark.match(text, at) if depth == 0 else None
        if found:
            pieces.append(text[start : found.start()])
            start = at = found.end()
            continue
        if text[at] == "\\" and text[at + 1 : at + 2] not in ("{", "}"):
            command = re.compile(r"\\(?:[A-Za-z]+|.)", re.DOTALL).match(text, at)
            at = command.end() if command else at + 1
            continue
        depth += (text[at] in "([{") - (text[at] in ")]}")
        at += 1
    return [*pieces, text[start:]]


def is_symbol(text: str) -> bool:
    r"""Whether a text is one symbol and no more.

    >>> is_symbol(r"\Delta T_{lm}"), is_symbol(r"\mathrm{Re}_1"), is_symbol("k_d c")
    (True, True, False)
    """
    return bool(_SYMBOL.fullmatch(text)) and text not in ("e", r"\pi")


@cache
def _pattern(symbol: str) -> re.Pattern[str]:
    """A symbol where it is not the beginning of another one."""
    letters = "(?![A-Za-z])" if re.search(r"\\[A-Za-z]+$", symbol) else ""
    return re.compile(re.escape(symbol).replace(r"\ ", r"\s*") + letters + r"(?!\s*[_'])")


def cut(equation: str, symbols: Mapping[str, Any]) -> list[str]:
    """An equation cut into symbols, commands, numbers and signs."""
    longest = sorted(symbols, key=len, reverse=True)
    found: list[str] = []
    at = 0
    while at < len(equation):
        symbol = next((s for s in longest if _pattern(s).match(equation, at)), None)
        part = _pattern(symbol).match(equation, at) if symbol else _TOKEN.match(equation, at)
        assert part is not None  # a token is at least one character
        found.append(symbol or part[0])
        at = part.end()
    return _bracketed(found, symbols)


def _bracketed(parts: list[str], symbols: Mapping[str, Any]) -> list[str]:
    """Brackets around symbols that stand together under one stroke: ``E/RT`` is ``E/(RT)``."""
    found: list[str] = []
    at = 0
    while at < len(parts):
        found.append(parts[at])
        at += 1
        end = at
        while parts[at - 1] == "/" and end < len(parts) and parts[end] in symbols:
            end += 1
        if end > at + 1:
            found += ["(", *parts[at:end], ")"]
            at = end
    return found


def function_name(part: str) -> str:
    """The name of a function such as ``\\ln`` or ``\\operatorname{erfc}``; empty for what is none."""
    name = re.sub(r"^\\(?:operatorname|mathrm)\s*\{(\w+)\}$", r"\\\1", part)[1:]
    return name if part[:1] == "\\" and (name in FUNCTIONS or name in _SEVERAL) else ""


class UnreadError(ValueError):
    """An equation holds what is not known here."""


def _number(part: str) -> float:
    digits = part.replace(r"\,", "")
    if not re.fullmatch(r"\d+(?:\.\d+)?", digits):
        raise UnreadError(part)
    return float(digits)


class Reader:
    """Reads a side of an equation as a sum of products; ``UnreadError`` where it holds what is not known
    here.

    Parameters
    ----------
    parts: the side, cut.
    values: what its symbols stand for: numbers, or quantities of Pint to find its unit.
    """

    def __init__(self, parts: list[str], values: Mapping[str, Any]):
        self._parts = [part for part in parts if part not in SPACES]
        self._values = values
        self._at = 0

    def whole(self) -> Any:
        """The value of all of it."""
        value = self._sum("")
        if self._at < len(self._parts):
            raise UnreadError
        return value

    def _next(self) -> str:
        return self._parts[self._at] if self._at < len(self._parts) else ""

    def _take(self, wanted: str = "") -> str:
        part = self._next()
        if not part or (wanted and part != wanted):
            raise UnreadError
        self._at += 1
        return part

    def _sum(self, end: str) -> Any:
        total, sign = 0.0, 1.0
        while True:
            if self._next() in ("+", "-"):
                sign = -sign if self._take() == "-" else sign
            total = total + sign * self._product(end)
            if self._next() not in ("+", "-"):
                return total
            sign = 1.0

    def _product(self, end: str) -> Any:
        value = self._power(end)
        while self._next() not in _ENDS and self._next() != end:
            if self._next() == "/":
                self._take()
                value = value / self._power(end)
            else:
                if self._next() in (r"\cdot", r"\times"):
                    self._take()
                value = value * self._power(end)
        return value

    def _power(self, end: str) -> Any:
        value = self._factor(end)
        if self._next() == "^":
            self._take()
            value = value ** self._group()
        return value

    def _group(self) -> Any:
        """What a command or a power takes: braces, or the next digit or symbol."""
        if self._next() == "{":
            return self._bracket()
        part = self._take()
        if part in self._values:
            return self._values[part]
        if len(part) > 1 and part.isdigit():  # \frac12
            self._at -= 1
            self._parts[self._at : self._at + 1] = list(part)
            part = self._take()
        return math.pi if part == r"\pi" else _number(part)

    def _bracket(self) -> Any:
        close = _CLOSES[self._take()]
        value = self._sum(close)
        self._take(close)
        return abs(value) if close == "|" else value

    def _factor(self, end: str) -> Any:
        part = self._next()
        if part in self._values:
            return self._values[self._take()]
        if part in _CLOSES and part != end:
            return self._bracket()
        self._take()
        if part in FRACTIONS:
            return self._group() / self._group()
        if part == r"\sqrt":
            order = self._bracket() if self._next() == "[" else 2.0
            return self._group() ** (1.0 / order)
        name = function_name(part)
        if name in _SEVERAL:
            return _SEVERAL[name](*self._listed())
        if name:
            return self._function(name, end)
        if part in (r"\pi", "e"):
            return math.pi if part == r"\pi" else math.e
        return _number(part)

    def _listed(self) -> Iterator[Any]:
        """What stands in a bracket, between commas."""
        close = _CLOSES[self._take()]
        yield self._sum(close)
        while self._next() == ",":
            self._take()
            yield self._sum(close)
        self._take(close)

    def _function(self, name: str, end: str) -> Any:
        if self._next() == "_":  # \log_{10}
            self._take()
            if self._group() != 10.0:
                raise UnreadError
        power = 1.0
        if self._next() == "^":
            self._take()
            power = self._group()
        number = re.fullmatch(r"[\d.]+", self._next())
        argument = self._power(end)
        if number and self._next() in self._values:  # \sin 2\alpha
            argument = argument * self._power(end)
        return FUNCTIONS[name](argument) ** power
