"""An equation with the numbers of a calculation in the place of its symbols.

It is shown only where reading it gives the result: an equation whose symbols are other ones, that stands for
other units or that is one of several has none.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Iterator, Mapping
from functools import cache

import numpy as np

from granum.core.parameters import Parameter
from granum.core.results import Result
from granum.core.units import format_number, pretty_unit
from granum.reports.quantities import beside_rows, value_text

LONG = 220  # characters of an equation that is still read better with its numbers
AGREES = 1e-6
_FUNCTIONS: dict[str, Callable[[float], float]] = {
    "ln": math.log,
    "log": math.log10,
    "exp": math.exp,
    "sin": math.sin,
    "cos": math.cos,
    "tan": math.tan,
    "tanh": math.tanh,
    "arctan": math.atan,
    "arcsin": math.asin,
    "arccos": math.acos,
}
_SPACES = (r"\,", r"\ ", r"\!", r"\;", r"\left", r"\right", " ")
_TOKEN = re.compile(r"\\[A-Za-z]+|\\.|\d+(?:\.\d+)?|.", re.DOTALL)
_CLOSES = {"(": ")", "[": "]", "{": "}", "|": "|"}
Symbols = Mapping[str, tuple[float, str]]


def numbered(result: Result) -> str:
    """LaTeX of a card's equation with its numbers in SI units and its result; empty where that is not what
    the equation gives.
    """
    left, equals, right = result.card.equation.partition("=")
    output = result.card.outputs[0]
    value = result.outputs[output.name]
    if not equals or len(right) > LONG or output.kind is None or np.ndim(value) or value is None:
        return ""
    symbols = dict(_known(result))
    parts = _parts(right, symbols)
    try:
        found = _Reader(parts, symbols).whole()
    except (ValueError, ArithmeticError, IndexError):
        return ""
    named = any(part in symbols for part in parts)
    if not named or not math.isclose(found, float(value), rel_tol=AGREES):
        return ""
    return rf"{left}={_written(parts, symbols)} = \text{{{value_text(value, output)}}}"


def _known(result: Result) -> Iterator[tuple[str, tuple[float, str]]]:
    """Symbols with their values and what is written for them."""
    for found, row in zip(result.beside, beside_rows(result), strict=True):
        if row.symbol:
            yield row.symbol, (found["value"], row.text)
    for p in result.card.parameters:
        value = result.inputs[p.name]
        if (
            p.kind is not None
            and p.term is not None
            and p.term.symbol
            and value is not None
            and not np.ndim(value)
        ):
            yield p.term.symbol, (float(value), _text(float(value), p))


def _text(value: float, p: Parameter) -> str:
    assert p.kind is not None
    unit = "K" if p.kind.unit == "delta_degC" else p.kind.unit
    return f"{format_number(value)} {pretty_unit(unit)}".strip()


@cache
def _pattern(symbol: str) -> re.Pattern[str]:
    """A symbol where it is not the beginning of another one."""
    letters = "(?![A-Za-z])" if re.search(r"\\[A-Za-z]+$", symbol) else ""
    return re.compile(re.escape(symbol).replace(r"\ ", r"\s*") + letters + r"(?!\s*[_'])")


def _parts(equation: str, symbols: Symbols) -> list[str]:
    """An equation cut into symbols, commands, numbers and signs."""
    longest = sorted(symbols, key=len, reverse=True)
    found, at = [], 0
    while at < len(equation):
        symbol = next((s for s in longest if _pattern(s).match(equation, at)), None)
        part = _pattern(symbol).match(equation, at) if symbol else _TOKEN.match(equation, at)
        assert part is not None  # a token is at least one character
        found.append(symbol or part[0])
        at = part.end()
    return found


class _Reader:
    """Reads an equation as a sum of products; ``ValueError`` where it holds what is not known here."""

    def __init__(self, parts: list[str], symbols: Symbols):
        self._parts = [part for part in parts if part not in _SPACES]
        self._symbols = symbols
        self._at = 0

    def whole(self) -> float:
        """The value of all of it."""
        value = self._sum("")
        if self._at < len(self._parts):
            raise ValueError
        return value

    def _next(self) -> str:
        return self._parts[self._at] if self._at < len(self._parts) else ""

    def _take(self, wanted: str = "") -> str:
        part = self._next()
        if not part or (wanted and part != wanted):
            raise ValueError
        self._at += 1
        return part

    def _sum(self, end: str) -> float:
        total, sign = 0.0, 1.0
        while True:
            if self._next() in ("+", "-"):
                sign = -sign if self._take() == "-" else sign
            total += sign * self._product(end)
            if self._next() not in ("+", "-"):
                return total
            sign = 1.0

    def _product(self, end: str) -> float:
        value = self._power(end)
        while self._next() not in ("", "+", "-", ")", "]", "}", end):
            if self._next() == "/":
                self._take()
                value /= self._power(end)
            else:
                if self._next() in (r"\cdot", r"\times"):
                    self._take()
                value *= self._power(end)
        return value

    def _power(self, end: str) -> float:
        value = self._factor(end)
        if self._next() == "^":
            self._take()
            value = value ** self._group()
        return value

    def _group(self) -> float:
        """What a command or a power takes: braces, or the next digit or symbol."""
        if self._next() == "{":
            return self._bracket()
        part = self._take()
        if part in self._symbols:
            return self._symbols[part][0]
        if len(part) > 1 and part.isdigit():  # \frac12
            self._at -= 1
            self._parts[self._at : self._at + 1] = list(part)
            part = self._take()
        return float(part)

    def _bracket(self) -> float:
        close = _CLOSES[self._take()]
        value = self._sum(close)
        self._take(close)
        return abs(value) if close == "|" else value

    def _factor(self, end: str) -> float:
        part = self._next()
        if part in self._symbols:
            return self._symbols[self._take()][0]
        if part in _CLOSES and part != end:
            return self._bracket()
        self._take()
        if part in (r"\frac", r"\tfrac", r"\dfrac"):
            return self._group() / self._group()
        if part == r"\sqrt":
            order = self._bracket() if self._next() == "[" else 2.0
            return self._group() ** (1.0 / order)
        if part[:1] == "\\" and part[1:] in _FUNCTIONS:
            return self._function(part[1:], end)
        if part in (r"\pi", "e"):
            return math.pi if part == r"\pi" else math.e
        return float(part)

    def _function(self, name: str, end: str) -> float:
        if self._next() == "_":  # \log_{10}
            self._take()
            if self._group() != 10.0:
                raise ValueError
        power = 1.0
        if self._next() == "^":
            self._take()
            power = self._group()
        return _FUNCTIONS[name](self._power(end)) ** power


def _written(parts: list[str], symbols: Symbols) -> str:
    """The equation with words for its symbols: signs of multiplication between factors, brackets under a
    power.
    """
    shown: list[str] = []
    for i, part in enumerate(parts):
        before = next((p for p in reversed(parts[:i]) if p not in _SPACES), "")
        if _multiplied(parts, i, before, symbols):
            shown.append(r"\cdot ")
        if part in symbols:
            word = _word(symbols[part][1], parts[i + 1 :])
            shown.append(f"{{{word}}}" if before in _TAKES else word)
        else:
            shown.append(f"{part} " if re.fullmatch(r"\\[A-Za-z]+", part) else part)
    return "".join(shown)


_TAKES = (r"\sqrt", r"\frac", r"\tfrac", r"\dfrac", "^", "_")  # what follows is theirs


def _multiplied(parts: list[str], i: int, before: str, symbols: Symbols) -> bool:
    """Whether a factor begins here after another one, of which at least one is a word."""
    part = parts[i]
    begins = (
        part in ("(", "[", r"\left", r"\pi")
        or part[1:] in _FUNCTIONS
        or part in _TAKES[:4]
        or part[0].isdigit()
    )
    if part in ("(", "[") and i > 0 and parts[i - 1] == r"\left":
        return False
    ends = before in (")", "]", "}", r"\pi") or before[-1:].isdigit()
    if part in symbols:
        return (ends or before in symbols) and not _denominator(parts[:i])
    return begins and before in symbols


def _denominator(before: list[str]) -> bool:
    """Whether what follows stands under a fraction whose numerator has been one digit or symbol."""
    return "".join(before[-2:-1]) in _TAKES[1:4]


def _word(word: str, after: list[str]) -> str:
    following = next((p for p in after if p not in _SPACES), "")
    text = rf"\text{{{word}}}"
    return rf"\left({text}\right)" if following == "^" or word[0] == "\u2212" else text
