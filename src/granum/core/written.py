"""Numbers as people write them, read in one place: decimal comma, thousands apart, ``1/8``, the printed
minus, ``1.07 × 10⁸``.
"""

from __future__ import annotations

import re

LONGEST = 200  # characters of one number with its unit
_APART = "\u00a0\u202f\u2009"  # no-break, narrow no-break and thin space
_THOUSANDS = re.compile(rf"(?<![\d.,])([1-9]\d{{0,2}})((?:[{_APART}]\d{{3}})+)(?!\d)")
_POWER = re.compile(r"(?<=\d)\s*[×x·*]\s*10(?:\^?([+-]?\d+)|([⁺⁻]?[⁰¹²³⁴⁵⁶⁷⁸⁹]+))")
_RAISED = str.maketrans("⁺⁻⁰¹²³⁴⁵⁶⁷⁸⁹", "+-0123456789")
_GROUPED = r"[1-9]\d{0,2}(?: \d{3})+(?![\d/])"
_BOTH = r"[1-9]\d{0,2}(?:(?:,\d{3})+\.\d+|(?:\.\d{3})+,\d+)(?![\d.,])"  # 1,200.5 and 1.200,5
_DIVIDED = r"\d+(?:\.\d+)?/[1-9]\d*\.\d+(?![\d.,])|\d+\.\d+/[1-9]\d*(?![\d.,])"  # 106/286.2
_APART_IN_THREES = re.compile(rf"\s*([+-]?(?:{_GROUPED}|[1-9]\d{{0,2}}(?:,\d{{3}}){{2,}}(?![\d.,])))")
_NUMBER = re.compile(
    (
        rf"\s*([+-]?(?:(?:\d+ "
        rf")?\d+/[1-9]\d*(?![\d.,])|{_DIVIDED}|(?:{_BOTH}|{_GROUPED}(?:[.,]\d+)?|\d+(?:[.,]\d*)?|[.,]\d+)(?:[eE][+-]?\d+)?))\s*(.*?)\s*"
    ),
    re.DOTALL | re.ASCII,
)


def tidy(text: str) -> str:
    """Text with plain signs and spaces: thousands that a no-break or thin space sets apart are joined, powers
    of ten become ``e``.

    >>> tidy("−1\u202f200,5 kg"), tidy("1.07 × 10⁸ Pa")
    ('-1200,5 kg', '1.07e8 Pa')
    """
    joined = _THOUSANDS.sub(lambda m: m[1] + re.sub(rf"[{_APART}]", "", m[2]), text.replace("\u2212", "-"))
    powers = _POWER.sub(lambda m: "e" + (m[1] or m[2].translate(_RAISED)), joined)
    return re.sub(rf"[{_APART}]", " ", powers)


def read_number(text: str) -> tuple[float, str] | None:
    """The number a text starts with and what follows it; None where it starts with none.

    >>> read_number("0,8 bar"), read_number("1 200,5 kg/h"), read_number("1,200.5"), read_number("1 1/8 in")
    ((0.8, 'bar'), (1200.5, 'kg/h'), (1200.5, ''), (1.125, 'in'))
    """
    if text.lstrip().startswith("$"):  # $10,000: its writer sets thousands apart by commas
        text = re.sub(r"(?<=\d),(?=\d{3})", "", text.lstrip()[1:]) + " USD"
    found = _NUMBER.fullmatch(tidy(text)) if len(text) <= LONGEST else None
    if found is None or re.match(r"(?!1\s*/)[±\d;,]", found[2]):  # "5 1 um", "5±1 um", "5; 1"
        return None
    if "/" in found[1]:
        return _fraction(found[1]), found[2]
    return float(_plain(found[1])), found[2]


_INTERVAL = re.compile(r"(.*?\d.*?)\s*(±|\+/?-|\.\.+|…|–|(?<=\s)(?:à|to)(?=\s))\s*(.*\d.*)", re.DOTALL)


def interval(text: str) -> tuple[str, str, str] | None:
    """Both numbers of ``85 ± 5 um``, ``80..90 um``, ``80–90 um`` or ``80 to 90 um``, each with its
    unit where the other has it, and the mark ``±`` or ``..``; None where a text is no
    interval. A spread in percent says nothing about the unit.

    >>> interval("80 à 90 um"), interval("0.8 bar ± 5 %"), interval("1e-3 m")
    (('80 um', '90 um', '..'), ('0.8 bar', '5 %', '±'), None)
    """
    found = _INTERVAL.fullmatch(text.strip()) if len(text) <= LONGEST else None
    low, high = (read_number(found[1]), read_number(found[3])) if found else (None, None)
    if found is None or low is None or high is None:
        return None
    mark = "±" if found[2][0] in "±+" else ".."
    share = mark == "±" and high[1] == "%"
    first = found[1].strip() if low[1] or share else f"{found[1].strip()} {high[1]}".strip()
    second = found[3].strip() if high[1] else f"{found[3].strip()} {low[1]}".strip()
    return first, second, mark


def apart(text: str) -> str:
    """The number of a text whose digits stand in threes apart, such as ``60 300`` or ``1,200,300``; empty
    where they do not.

    It may be thousands or two values: where several values may stand only its writer knows. But no value
    begins with a zero before other digits: ``10 000`` is ten thousand.

    >>> apart("60 300 um"), apart("60 85 um"), apart("10 000 um")
    ('60 300', '', '')
    """
    found = _APART_IN_THREES.match(tidy(text))
    return found[1] if found and not re.search(r"[ ,]0", found[1]) else ""


_DURATION = re.compile(
    r"(?:(?P<days>\d+)\s*(?:days?|d|jours?|j)\s*)?(?:(?P<hours>\d+)\s*(?:hours?|hr?|heures?)\s*)?"
    r"(?:(?P<minutes>\d+)\s*(?:min(?:utes?)?)?\s*)?(?:(?P<seconds>\d+(?:[.,]\d+)?)\s*(?:s|sec)\s*)?"
)
_EACH = {"days": 86400.0, "hours": 3600.0, "minutes": 60.0, "seconds": 1.0}


def duration(text: str) -> float | None:
    """Seconds of a time said in several units, such as ``2 h 30 min`` or ``2h30``; None of any other text.

    >>> (
    ...     duration("2 h 30 min"),
    ...     duration("2h30"),
    ...     duration("1 day 4 h"),
    ...     duration("30 min"),
    ...     duration("30 5 s"),
    ... )
    (9000.0, 9000.0, 100800.0, None, None)
    """
    found = _DURATION.fullmatch(tidy(text).strip()) if len(text) <= LONGEST else None
    parts = {name: value for name, value in found.groupdict().items() if value} if found else {}
    if len(parts) < 2 or ("minutes" in parts and "hours" not in parts and "min" not in text):
        return None  # "30 5 s" are two values
    seconds = sum(float(value.replace(",", ".")) * _EACH[name] for name, value in parts.items())
    # the minutes of two and a half hours are no more than an hour holds
    within = all(float(parts.get(name, "0").replace(",", ".")) < 60.0 for name in ("minutes", "seconds"))
    return seconds if within else None


_THREE_BEHIND = re.compile(r"\s*\$?([+-]?[1-9]\d{0,2}),(\d{3})(?![\d.,eE])")


def thousands_or_decimals(text: str) -> tuple[str, str] | None:
    """Both readings of a number with three digits behind its only comma; None of every other text.

    >>> (
    ...     thousands_or_decimals("2,500 kg/m3"),
    ...     thousands_or_decimals("0,125 m"),
    ...     thousands_or_decimals("2,50 m"),
    ... )
    (('2500', '2.500'), None, None)
    """
    found = _THREE_BEHIND.match(tidy(text))
    return (found[1] + found[2], f"{found[1]}.{found[2]}") if found and "$" not in found[0] else None


def mixed(text: str) -> tuple[str, str] | None:
    """A whole number that a fraction follows, read as one number and as two; None where a text has none.

    >>> mixed("1 1/2 in"), mixed("1; 1/2 in"), mixed("25 1/h")
    (('1.5', '1; 1/2'), None, None)
    """
    found = re.search(r"(?<![\d.,/])(\d+) (\d+/[1-9]\d*)", tidy(text))
    return (f"{_fraction(found[0]):.12g}", f"{found[1]}; {found[2]}") if found else None


def _fraction(text: str) -> float:
    """``1 1/8`` or ``-1/8``."""
    whole, _blank, part = text.lstrip("+-").rpartition(" ")
    above, _over, below = part.partition("/")
    size = float(whole or 0.0) + float(above) / float(below)
    return -size if text.startswith("-") else size


def _plain(number: str) -> str:
    number = number.replace(" ", "")
    if "," in number and "." in number:  # the mark in front sets thousands apart
        number = number.replace("," if number.index(",") < number.index(".") else ".", "")
    return number.replace(",", ".")
