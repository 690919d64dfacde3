"""The symbols that stand in an equation: letters with their marks above and what is written below them."""

from __future__ import annotations

import re

_ROMAN = re.compile(r"\\(?:mathrm|text|mathit|mathbf|operatorname)\s*\{([^{}]*)\}")
_SPACE = re.compile(
    r"\\(?:left|right|bigl|bigr|Big|big|quad|qquad|displaystyle|limits)(?![A-Za-z])|\\[,;:! ]|~"
)
_TOKEN = re.compile(r"«[^»]*»|\\[A-Za-z]+|[A-Za-z]|[0-9.]+|\S")
_MARKS = (r"\dot", r"\bar", r"\overline", r"\hat", r"\tilde")
_STRUCTURE = (
    r"\frac",
    r"\dfrac",
    r"\tfrac",
    r"\sqrt",
    r"\ln",
    r"\exp",
    r"\int",
    r"\sum",
    r"\prod",
    r"\min",
    r"\max",
)


def _tokens(latex: str) -> list[str]:
    spelled = _ROMAN.sub(lambda found: f" «{found[1].replace(' ', '')}» ", latex)
    return _TOKEN.findall(_SPACE.sub(" ", spelled))


def _group(tokens: list[str], at: int) -> tuple[list[str], int]:
    """The braced or single argument that begins here, and where it ends."""
    if at >= len(tokens):
        return [], at
    if tokens[at] in _MARKS:
        inner, end = _group(tokens, at + 1)
        return [tokens[at], *inner], end
    if tokens[at] != "{":
        return [tokens[at]], at + 1
    depth, end = 0, at
    while end < len(tokens):
        depth += (tokens[end] == "{") - (tokens[end] == "}")
        end += 1
        if depth == 0:
            break
    return tokens[at + 1 : end - 1], end


def _plain(tokens: list[str]) -> str:
    return "".join(t.strip("«»") for t in tokens if t not in "{}")


def _walk(tokens: list[str], found: set[str]) -> None:
    at = 0
    while at < len(tokens):
        word = tokens[at]
        if word in _STRUCTURE or not re.fullmatch(r"«[^»]*»|\\?[A-Za-z]+", word):
            at += 1
            continue
        if word in _MARKS:
            inner, at = _group(tokens, at + 1)
            forms = {word + _plain(inner)}
        else:
            forms, at = {word.strip("«»")}, at + 1
        while at < len(tokens) and tokens[at] in ("_", "^", "'"):
            mark = tokens[at]
            inner, at = ([], at + 1) if mark == "'" else _group(tokens, at + 1)
            if mark == "^":
                _walk(inner, found)
            marked = {form + mark + _plain(inner) for form in forms}
            forms = marked if mark == "_" else forms | marked
        found |= forms


def atoms(latex: str) -> set[str]:
    """The symbols of an equation, each with and without its primes and powers, but not without its index.

    >>> sorted(atoms(r"v_t = \\frac{g\\,d_p^2}{18\\,\\eta}"))
    ['\\\\eta', 'd_p', 'd_p^2', 'g', 'v_t']
    """
    found: set[str] = set()
    _walk(_tokens(latex), found)
    return found


def atom(symbol: str) -> set[str]:
    """What of a symbol must stand in an equation: the fullest form of each letter in it."""
    every = atoms(symbol)
    return {a for a in every if not any(b != a and re.match(re.escape(a) + r"[\^']", b) for b in every)}


def left_sides(latex: str) -> set[str]:
    """The symbols that stand to the left of an equals sign, however the equation is broken up."""
    parts = re.split(
        r",\s*\\q?quad|;\s*\\q?quad|,\s*\\ |,\s*\\;|;\s*\\ |;\s*\\;|\\Rightarrow|\\rightarrow", latex
    )
    sides = [side for part in parts for side in re.split(r"=|\\approx|\\propto|\\le(?![a-z])", part)[:-1]]
    return set().union(*(atoms(side) for side in sides))
