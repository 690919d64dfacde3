"""An equation with the numbers of a calculation in the place of its symbols.

It is shown only where reading it gives the result: an equation whose symbols are other ones, that stands for
other units or that is one of several has none. What is defined after an equation follows with its own
numbers.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass

import numpy as np

from granum.core import constants
from granum.core.parameters import Parameter
from granum.core.results import Result
from granum.core.units import format_number, pretty_unit
from granum.reports.equations import (
    FRACTIONS,
    SPACES,
    Reader,
    UnreadError,
    cut,
    function_name,
    is_symbol,
    statements,
)
from granum.reports.quantities import beside_rows, value_text

LONG = 220  # characters of a side that is still read better with its numbers
AGREES = 1e-6
_UNREAD = (ValueError, ArithmeticError, IndexError, TypeError, KeyError)  # TypeError: a complex number
_CONSTANTS = {
    "g": (constants.STANDARD_GRAVITY, "m/s^2"),
    "R": (constants.GAS_CONSTANT, "J/(mol*K)"),
    "k": (constants.BOLTZMANN, "J/K"),
    "N_A": (constants.AVOGADRO, "1/mol"),
    r"\sigma": (constants.STEFAN_BOLTZMANN, "W/(m^2*K^4)"),
    r"\varepsilon_0": (constants.VACUUM_PERMITTIVITY, "A*s/(V*m)"),
}
_CHARGE = {"e": (constants.ELEMENTARY_CHARGE, "A*s")}  # where e is not the number


@dataclass(frozen=True)
class _Meaning:
    """A number with its unit in SI, and what is written for it."""

    value: float
    unit: str
    text: str


class _Meanings(Mapping[str, _Meaning]):
    """What the symbols of an equation stand for; one that the equation defines is worked out when it is asked
    for, and ``used`` then tells how, in the order of use.
    """

    def __init__(self, given: Mapping[str, _Meaning], definitions: Mapping[str, list[str]]):
        self._given = dict(given)
        self._definitions = definitions
        self._open: set[str] = set()
        self.used: dict[str, str] = {}

    def __iter__(self) -> Iterator[str]:
        return iter(dict.fromkeys((*self._given, *self._definitions)))

    def __len__(self) -> int:
        return len(set(self._given) | set(self._definitions))

    def __contains__(self, symbol: object) -> bool:
        return symbol in self._given or symbol in self._definitions

    def __getitem__(self, symbol: str) -> _Meaning:
        if symbol not in self._given:
            self._given[symbol] = self._defined(symbol)
        return self._given[symbol]

    def _defined(self, symbol: str) -> _Meaning:
        if symbol in self._open:
            raise UnreadError
        self._open.add(symbol)
        self.used[symbol] = ""  # in its place before those it needs
        value, parts = _worked_out(self._definitions[symbol][0], self)
        unit = _unit_of(parts, self)
        text = f"{format_number(value)} {pretty_unit(unit)}".strip()
        self.used[symbol] = rf"{symbol} = {_written(parts, self)} = \text{{{text}}}"
        return _Meaning(value, unit, text)


class _Values(Mapping[str, float]):
    """The numbers of meanings."""

    def __init__(self, meanings: Mapping[str, _Meaning]):
        self._meanings = meanings

    def __iter__(self) -> Iterator[str]:
        return iter(self._meanings)

    def __len__(self) -> int:
        return len(self._meanings)

    def __contains__(self, symbol: object) -> bool:
        return symbol in self._meanings

    def __getitem__(self, symbol: str) -> float:
        return self._meanings[symbol].value


def _worked_out(side: str, meanings: Mapping[str, _Meaning]) -> tuple[float, list[str]]:
    """The value of a side, and the side cut."""
    if len(side) > LONG:
        raise UnreadError
    parts = cut(side, meanings)
    return float(Reader(parts, _Values(meanings)).whole()), parts


def _unit_of(parts: list[str], meanings: Mapping[str, _Meaning]) -> str:
    """The unit in SI of what a side gives."""
    there = [part for part in dict.fromkeys(parts) if part in meanings]
    if not any(meanings[part].unit for part in there):
        return ""
    from granum.core.unit_names import registry  # Pint takes a third of a second to load

    ureg = registry()
    quantities = {part: ureg.Quantity(meanings[part].value, meanings[part].unit) for part in there}
    found = ureg.Quantity(Reader(parts, quantities).whole()).to_base_units()
    powers = {f"{ureg.Unit(name):~}": n for name, n in found.unit_items() if name != "radian"}
    return _unit_text({name: round(n, 9) for name, n in powers.items() if abs(n) > 1e-9})


def _unit_text(powers: Mapping[str, float]) -> str:
    def product(sign: int) -> list[str]:
        return [
            name if n * sign == 1 else f"{name}^{n * sign:g}" for name, n in powers.items() if n * sign > 0
        ]

    above, below = product(1), product(-1)
    if not below:
        return "*".join(above)
    under = "*".join(below)
    return f"{'*'.join(above) or '1'}/{f'({under})' if len(below) > 1 else under}"


def numbered(result: Result) -> str:
    """LaTeX of a card's equation with its numbers in SI units and its result; empty where that is not what
    the equation gives.
    """
    said = statements(result.card.equation)
    output = result.card.outputs[0]
    value = result.outputs[output.name]
    if output.kind is None or value is None or np.ndim(value):
        return ""
    ways = ((i, extra) for i in range(len(said)) for extra in ({}, _CHARGE))
    return next(filter(None, (_shown(result, output, said, i, extra) for i, extra in ways)), "")


def _shown(
    result: Result,
    output: Parameter,
    said: list[list[str]],
    which: int,
    extra: Mapping[str, tuple[float, str]],
) -> str:
    """A statement with numbers, if it is about an output and gives it, and the definitions it needs."""
    sides = said[which]
    names = _spellings(output.symbol)
    value = float(result.outputs[output.name])
    others = [row for i, row in enumerate(said) if i != which and is_symbol(row[0])]
    definitions = {row[0]: row[1:] for row in reversed(others) if row[0] not in names}
    given = _given(result, definitions, extra)
    for name in names:
        given.pop(name, None)
    for left in sides:
        asked = any(_stands(name, left) for name in names)
        if not asked and not (which == 0 and left is sides[0]):
            continue
        for right in (side for side in sides if side is not left):
            meanings = _Meanings(given, definitions)
            try:
                found, parts = _worked_out(right, meanings)
                alone = not asked or re.sub(r"\(.*\)$", "", left) in names
                fits = (
                    math.isclose(found, value, rel_tol=AGREES)
                    if alone
                    else _solved(left, found, value, output.symbol, given, definitions)
                )
                if not fits or not any(part in meanings for part in parts):
                    continue
            except _UNREAD:
                continue
            reached = rf"\text{{{value_text(value, output)}}}"
            end = f"= {reached}" if alone else rf"\;\Rightarrow\; {output.symbol} = {reached}"
            return ",\\quad ".join((f"{left} = {_written(parts, meanings)} {end}", *meanings.used.values()))
    return ""


def _stands(symbol: str, side: str) -> bool:
    """Whether a symbol stands in a side."""
    return bool(symbol) and symbol in cut(side, {symbol: 0.0})


def _solved(
    left: str,
    found: float,
    value: float,
    symbol: str,
    given: Mapping[str, _Meaning],
    definitions: Mapping[str, list[str]],
) -> bool:
    """Whether what was found for the right side lies between those left sides that values on both sides of
    the result give, within the tolerance.
    """
    ends = [
        _worked_out(left, _Meanings({**given, symbol: _Meaning(value * f, "", "")}, definitions))[0]
        for f in (1.0 - AGREES, 1.0 + AGREES)
    ]
    return min(ends) < max(ends) and min(ends) <= found <= max(ends)


def _given(
    result: Result, defined: Mapping[str, list[str]], extra: Mapping[str, tuple[float, str]]
) -> dict[str, _Meaning]:
    """What symbols stand for before anything is worked out: constants where no definition says otherwise,
    numbers beside the result, inputs.
    """
    found = {
        symbol: _Meaning(value, unit, f"{format_number(value)} {pretty_unit(unit)}")
        for symbol, (value, unit) in {**_CONSTANTS, **extra}.items()
        if symbol not in defined
    }
    for there, row in zip(result.beside, beside_rows(result), strict=True):
        if row.symbol:
            found[row.symbol] = _Meaning(there["value"], "", row.text)
    for p in result.card.parameters:
        value = result.inputs[p.name]
        if p.kind is None or not p.symbol or value is None:
            continue
        unit = "K" if p.kind.unit == "delta_degC" else p.kind.unit
        numbers = np.asarray(value, dtype=float)
        series = {p.symbol.removesuffix("_i") + f"_{i}": x for i, x in enumerate(numbers.flat, 1)}
        rows = {p.symbol: numbers.item()} if numbers.ndim == 0 else series if p.symbol.endswith("_i") else {}
        for symbol, x in rows.items():
            found |= dict.fromkeys(
                _spellings(symbol),
                _Meaning(float(x), unit, f"{format_number(float(x))} {pretty_unit(unit)}".strip()),
            )
    return found


def _spellings(symbol: str) -> tuple[str, ...]:
    """A symbol as it may stand in an equation: a ratio also as a fraction."""
    above, stroke, below = symbol.partition("/")
    return (symbol, rf"\frac{{{above}}}{{{below}}}") if stroke and "(" not in symbol else (symbol,)


def _written(parts: list[str], symbols: Mapping[str, _Meaning]) -> str:
    """The equation with words for its symbols: signs of multiplication between factors, brackets under a
    power.
    """
    shown: list[str] = []
    for i, part in enumerate(parts):
        before = next((p for p in reversed(parts[:i]) if p not in SPACES), "")
        if _multiplied(parts, i, before, symbols):
            shown.append(r"\cdot ")
        if part in symbols:
            word = _word(symbols[part].text, parts[i + 1 :])
            shown.append(f"{{{word}}}" if before in _TAKES else word)
        else:
            shown.append(f"{part} " if re.fullmatch(r"\\[A-Za-z]+", part) else part)
    return "".join(shown)


_TAKES = (r"\sqrt", *FRACTIONS, "^", "_")  # what follows is theirs


def _multiplied(parts: list[str], i: int, before: str, symbols: Mapping[str, _Meaning]) -> bool:
    """Whether a factor begins here after another one, of which at least one is a word."""
    part = parts[i]
    begins = (
        part in ("(", "[", r"\left", r"\pi", "e", r"\sqrt", *FRACTIONS)
        or function_name(part) != ""
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
    return "".join(before[-2:-1]) in FRACTIONS


def _word(word: str, after: list[str]) -> str:
    following = next((p for p in after if p not in SPACES), "")
    text = rf"\text{{{word}}}"
    return rf"\left({text}\right)" if following == "^" or word[0] == "\u2212" else text
