"""Numbers and equations that stand in the chapters of the handbook.

A chapter states a number as ``{{expression = 12.5 kg/m^3}}``: what is calculated, and what the prose says.
The documentation compares the two while it is built; a reader sees the number as his language prints it.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from typing import NamedTuple

from granum.core.i18n import current_language, typographic
from granum.core.units import decimal, pretty_unit, ten_to
from granum.reports.mathml import mathml

STATED = re.compile(r"\{\{(.+?) = ([^{}]+?)\}\}")
_NUMBER = re.compile(r"([-−]?\d+(?:[.,](\d+))?)(?:e(-?\d+))?\s*(.*)")
_DISPLAYED = re.compile(r"^\$\$(.+?)\$\$$", re.MULTILINE)
_WITHIN = re.compile(r"\$([^$\n]+?)\$")


class Number(NamedTuple):
    """A number as it was stated: its value, the worth of one in its last digit, its unit."""

    value: float
    step: float
    unit: str


def stated_number(text: str) -> Number:
    """What a text states.

    >>> stated_number("1,86e11 m/kg")
    Number(value=186000000000.0, step=1000000000.0, unit='m/kg')
    """
    digits, decimals, power, unit = _parts(text)
    ten = 10.0 ** int(power or 0)
    return Number(
        float(digits.replace(",", ".").replace("−", "-")) * ten, ten * 10.0 ** -len(decimals or ""), unit
    )


def _parts(text: str) -> tuple[str, str, str, str]:
    if not (found := _NUMBER.fullmatch(text.strip())):
        raise ValueError(f"no number: {text}")
    return found[1], found[2], found[3], found[4]


def printed_number(text: str) -> str:
    """A stated number as it is printed in the current language.

    >>> printed_number("1.86e11 m/kg").replace("\u00a0", " ")
    '1.86 × 10¹¹ m/kg'
    """
    digits, _decimals, power, unit = _parts(text)
    whole, point, rest = digits.replace(",", ".").partition(".")
    if len(whole.lstrip("-−")) > 4:
        whole = f"{whole[:-3]}\u202f{whole[-3:]}"
    number = decimal(whole + point + rest)
    if power:
        number = f"{number}\u00a0{ten_to(int(power))}"
    if not unit or unit == "1":
        return number
    if unit == "%" and current_language() != "fr":
        return number + unit
    return f"{number}\u00a0{typographic(pretty_unit(unit))}"


_KEPT = re.compile(  # code, equations, statements, targets of links, what the site makes
    r"^```.*?^```|`[^`\n]*`|\$\$.+?\$\$|\$[^$\n]+\$|\{\{.+?\}\}|\]\([^)\n]*\)|\[\[.*?\]\]|https?://\S+",
    re.MULTILINE | re.DOTALL,
)


def in_french_print(text: str) -> str:
    """Markdown with the apostrophes and the no-break spaces of French print; code, equations and links stay.

    >>> in_french_print("l'eau : `l'x : 1`").replace("\u00a0", "~")
    "l’eau~: `l'x : 1`"
    """
    found, at = [], 0
    for kept in _KEPT.finditer(text):
        found += [_printed(text[at : kept.start()]), kept[0]]
        at = kept.end()
    return "".join([*found, _printed(text[at:])])


_UNIT = r"(?:°C|%|[µcmk]?m[²³]?/?|[mkµ]?g|t/h|kPa|MPa|bar|kWh?|MJ|kJ|mL|L|tr/min|s|min|h)(?![\w²³])"
_SPACES = re.compile(rf"(?<!\s) (?=[:;!?»](?:\s|$))|(?<=«) |(?<=\d) (?={_UNIT})")


def _printed(text: str) -> str:
    return _SPACES.sub("\u00a0", typographic(text))


def with_numbers(text: str) -> str:
    """A text with the numbers that it states, printed."""
    return STATED.sub(lambda found: printed_number(found[2]), text)


def with_equations(text: str, put: Callable[[str], str] = str) -> str:
    """A text with ``$$…$$`` on a line of its own and ``$…$`` within one as MathML, each handed to ``put``."""
    text = _DISPLAYED.sub(
        lambda m: put(f'<div class="equation">{mathml(m[1].strip(), display=True)}</div>'), text
    )
    return _WITHIN.sub(lambda m: put(mathml(m[1])), text)
