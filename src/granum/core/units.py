"""Units at the edge: text and Pint quantities become SI floats on entry, SI floats become text on display.
Uses Pint.
"""

from __future__ import annotations

import math
import os
import re
from collections.abc import Iterable
from contextvars import ContextVar
from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np

from granum.core.errors import InputError, UnitError
from granum.core.given import shown
from granum.core.i18n import _, current_language
from granum.core.kinds import Kind
from granum.core.unit_names import (
    DEGREES,
    ELSE,
    LONGEST_UNIT,
    fits,
    parse_unit,
    registry,
    same_dimension,
    without_substances,
)
from granum.core.unit_table import counts_angles, rows
from granum.core.written import apart, duration, interval, mixed, read_number, thousands_or_decimals, tidy


def _affine(unit: str, kind_unit: str) -> tuple[float, float]:
    """(factor, offset) such that SI = factor·value + offset."""
    row = rows().get((unit.strip(), kind_unit))
    return (row.factor, row.offset) if row is not None else affine_by_pint(unit, kind_unit)


@cache
def affine_by_pint(unit: str, kind_unit: str) -> tuple[float, float]:
    """The same, whatever the unit."""
    ureg = registry()
    if not fits(unit, kind_unit):
        above, _over, below = unit.partition("/")
        # as older books write them: in kg/m s all behind the stroke is below it, F and C there are degrees;
        # lb/ft2 and kg/cm2 of a pressure are forces
        factors = re.split(r"[\s*.·/()-]+", re.sub("°|deg(?=[CF])", " ", below))
        readings = (
            f"{above}/({'*'.join(DEGREES.get(f, f) for f in factors if f)})",
            re.sub(r"\b(lb|kg)\b", r"\1f", unit, count=1),
        )
        product = below or re.search(
            r"[A-Za-z]\s*[-*·. ]\s*[A-Za-z]", unit
        )  # ft-lb, kg m: a force over a length
        meant = [text for text in readings if product and text != unit and fits(text, kind_unit)]
        other = re.sub(r"[A-Za-zµμ]+", lambda word: ELSE.get(word[0], word[0]), unit)
        meant += [other] if other != unit and fits(other, kind_unit) else []
        if not meant:
            parse_unit(unit)  # says so where the unit itself is not known
            raise UnitError("dimension")
        unit = meant[0]
    source, target = parse_unit(unit), ureg.Unit(kind_unit)
    zero = ureg.Quantity(0.0, source).to(target).magnitude
    one = ureg.Quantity(1.0, source).to(target).magnitude
    return one - zero, zero


@cache
def _angles(unit: str) -> bool:
    """Whether a unit counts angles or turns by name."""
    known = counts_angles(unit.strip())
    return angles_by_pint(unit) if known is None else known


def angles_by_pint(unit: str) -> bool:
    """The same, whatever the unit."""
    return bool(re.search("radian|degree|rev|turn|cycle|\\btr\\b", str(parse_unit(unit))))


def _conversion(unit: str, kind: Kind) -> tuple[float, float]:
    """(factor, offset) for a kind: differences of temperature and of pressure drop the zero of the scale (°F,
    barg).

    A frequency given for a rotation counts turns (65 Hz, 1000 1/min), and so does a rotation given for a
    frequency (300 rpm).
    """
    if kind.unit in ("K", "delta_degC"):
        unit = DEGREES.get(unit.strip(), unit)
    own = rows().get((unit.strip(), kind.unit))
    if kind.unit == "delta_degC":
        return (own.factor if own else _affine(unit, "K")[0]), 0.0
    if kind.name == "relative amount" and not own and fits(unit, "kg"):
        return _affine(unit, "kg")
    factor, offset = _affine(unit, kind.unit)
    above, _over, below = kind.unit.partition("/")
    number = kind.unit == "dimensionless" or above == below
    if (number and _angles(unit)) or (kind.unit == "radian" and unit.strip() in ("%", "percent")):
        raise UnitError("dimension")  # Pint's angles are numbers: 40° would be a void fraction of 0.7
    if kind.unit == "radian/s" and not _angles(unit):
        factor *= math.tau
    elif kind.unit == "1/s" and _angles(unit):
        factor /= math.tau
    return factor, 0.0 if kind.unit == "Pa" and kind.name != "absolute pressure" else offset


def to_si(value: Any, unit: str, kind: Kind, name: str = "") -> Any:
    """A number or array in ``unit`` as SI floats of the given kind.

    >>> from granum.core.kinds import KINDS
    >>> round(to_si(20.0, "degC", KINDS["Temperature"]), 2)
    293.15
    """
    label = name or kind.name
    if name.endswith("_normal") or name.startswith("emission_"):  # of gas at 0 °C and 1 atm: Nm3/h, mg/Nm3
        unit = of_normal_gas(unit) or unit
    if kind.unit == "delta_degC" and unit.strip() in ("degC", "°C", "K"):
        return value
    unit = without_substances(unit, kind.name)
    if kind.per_volume is not None and same_dimension(unit, "m^3/s"):
        return to_si(value, unit, replace(kind, unit="m^3/s", per_volume=None), name) * kind.per_volume
    try:
        factor, offset = _conversion(unit, kind)
    except UnitError as problem:
        if problem.message != "dimension":
            raise UnitError(
                problem.message
                + " "
                + _("'{name}' takes {units}.").format(name=label, units=", ".join(kind.units)),
                name=label,
                allowed=list(kind.units),
            ) from None
        given = "1" if unit.strip() in ("", "dimensionless") else unit.strip()
        units = ", ".join(kind.units)
        if set(kind.units) == {"dimensionless"}:
            message = _("'{name}': unit '{unit}' does not fit. Give a number without a unit.")
        elif {"dimensionless", "percent"}.issuperset(kind.units):
            message = _("'{name}': unit '{unit}' does not fit. Give a number without a unit, or in %.")
        else:
            message = _("'{name}': unit '{unit}' does not fit. Use one of {units}.")
        raise UnitError(
            message.format(name=label, unit=given, units=units),
            name=label,
            unit=given,
            allowed=list(kind.units),
        ) from None
    return value * factor + offset


def from_si(value: Any, unit: str, kind: Kind) -> Any:
    """SI floats of a kind expressed in another unit of the same dimension."""
    if not same_dimension(unit, kind.unit):
        to_si(1.0, unit, kind)
    factor, offset = _conversion(unit, kind)
    return (value - offset) / factor


def read_quantity(text: str, kind: Kind, name: str = "") -> float:
    """The SI value of text such as ``"85 um"``, ``"0,8 bar"`` or ``"12 %"``; a bare number is SI already.

    >>> from granum.core.kinds import KINDS
    >>> read_quantity("1.2 cP", KINDS["DynamicViscosity"])
    0.0012
    """
    found = read_number(text)
    readings = thousands_or_decimals(text)
    if readings and (current_language() == "en" or kind.unit.startswith("USD")):
        message = _("'{name}' = '{text}' may be {whole} or {decimal}: write it without the comma.")
        raise InputError(
            message.format(name=name or kind.name, text=shown(text), whole=readings[0], decimal=readings[1]),
            name=name or kind.name,
            value=shown(text),
        )
    parts = duration(text) if kind.unit == "s" else None
    if parts is not None:
        return parts
    try:
        if found is not None:
            number, unit = found
            return float(to_si(number, unit, kind, name)) if unit else number
    except UnitError:
        if interval(text) is None:
            raise
    if interval(text) is not None:
        message = _("'{name}' = '{text}' is a range; here one number is asked for.")
    elif kind.units[0] == "dimensionless":
        message = _("'{name}' = '{text}' is not a number. Write it as '{example}'.")
    else:
        message = _("'{name}' = '{text}' is not a number with a unit. Write it as '{example}'.")
    example = "1.5" if kind.units[0] == "dimensionless" else f"1.5 {kind.units[0]}"
    raise InputError(
        message.format(name=name or kind.name, text=shown(text), example=example),
        name=name or kind.name,
        value=shown(text),
    )


def read_values(text: str, kind: Kind, name: str = "") -> float | np.ndarray:
    """The SI value of a text, or the values of one that holds several: ``"60 85 um"``, ``"0,10,20degC"``,
    ``"[1; 2] bar"``.
    """
    digits = apart(text)
    if digits:
        raise _one_or_several(
            text, re.sub("[ ,]", "", digits), re.sub("[ ,]", "; ", digits), name or kind.name
        )
    try:
        return read_quantity(text, kind, name)
    except InputError:
        try:
            values = read_series(text, kind, name)
        except InputError:
            values = np.empty(0)
        if values.size < 2:
            raise
        return values


def _one_or_several(text: str, one: str, more: str, name: str) -> InputError:
    """The error for a text that may be read in two ways."""
    message = _(
        "'{name}' = '{text}' may be one number or several: write '{one}' for one, '{more}' for several."
    )
    return InputError(message.format(name=name, text=shown(text), one=one, more=more), name=name)


def has_unit(text: str) -> bool:
    """Whether text says a unit beside its number or numbers.

    >>> has_unit("25 degC"), has_unit("0,10,20degC"), has_unit("2.5e1")
    (True, True, False)
    """
    return re.search(r"[^\W\d_]|[°%]", re.sub(r"(?<=\d)[eE](?=[+-]?\d)", "", text)) is not None


_NORMAL = re.compile(r"\bN\s?(?=m\s?(\^?3|³))")


def of_normal_gas(text: str) -> str | None:
    """A volume of gas at 0 °C and 1 atm without the mark of that; None of other text.

    >>> of_normal_gas("1000 Nm3/h"), of_normal_gas("1000 m3/h")
    ('1000 m3/h', None)
    """
    plain = _NORMAL.sub("", text)
    return None if plain == text else plain


def in_unit_of(text: str, unit: str) -> bool:
    """Whether text is a number in a unit that measures the same sort of quantity.

    >>> in_unit_of("500 cSt", "m^2/s"), in_unit_of("500 cP", "m^2/s")
    (True, False)
    """
    number = read_number(text)
    return number is not None and bool(number[1].strip()) and fits(number[1], unit)


def read_series(text: str, kind: Kind, name: str = "") -> np.ndarray:
    """SI values of a list in one string: ``"2 4 8 um"``, ``"[1.5; 2.5] bar"`` or ``"2 mm, 850 um"``; a value
    without a unit takes the next one's.
    """
    if both := mixed(text):
        raise _one_or_several(text, *both, name or kind.name)
    cleaned = re.sub(r"[\[\];]", " ", tidy(text))
    # before a blank or after a unit the comma separates
    cleaned = re.sub(r",(?=\s)|(?<=[^\d\s.,]),|(?<=[A-Za-z^]\d),", " ", cleaned)
    numbers = re.findall(r"[0-9.,eE+-]*[0-9][0-9.,eE+-]*", cleaned)
    if len(numbers) == 1 and re.fullmatch(r"[^,]*,\d[^,]*", numbers[0]):  # "0,5 mm"
        raise _one_or_several(
            text, numbers[0].replace(",", "."), numbers[0].replace(",", "; "), name or kind.name
        )
    if numbers and "," in numbers[0] and len(numbers) <= 2 and numbers[0].count(",") >= len(numbers):
        # "2,4,8 um": the comma separates; beside blanks it is a decimal comma
        cleaned = cleaned.replace(",", " ")
    values: list[float] = []
    units: list[str] = []
    for word in cleaned.split():
        found = read_number(word)
        if values and (found is None or re.match(r"1/[A-Za-z(]", word)):
            units[-1] = f"{units[-1]} {word}".strip()
            if len(units[-1]) > LONGEST_UNIT:
                parse_unit(units[-1])
            continue
        values.append(found[0] if found else read_quantity(word, kind, name))
        units.append(found[1] if found else "")
    if any(units) and not units[-1]:
        raise InputError(
            _(
                "'{name}' = '{text}': some values have a unit and the last one has none. Write the unit "
                "once at the end, or after each value."
            ).format(name=name or kind.name, text=text),
            name=name or kind.name,
        )
    for i in range(len(units) - 2, -1, -1):
        units[i] = units[i] or units[i + 1]
    array = np.asarray(values, dtype=float)
    if len(set(units)) <= 1:
        return array if not any(units) else np.asarray(to_si(array, units[0], kind, name))
    return np.asarray([to_si(value, unit, kind, name) for value, unit in zip(values, units, strict=True)])


def quantity_to_si(value: Any, kind: Kind, name: str = "") -> Any:
    """The SI magnitude of a Pint quantity from any registry."""
    return to_si(value.magnitude, format(value.units, "~"), kind, name)


_PRETTY = {
    "um": "µm",
    "us": "µs",
    "ug": "µg",
    "uN": "µN",
    "uPa": "µPa",
    "umol": "µmol",
    "degC": "°C",
    "degF": "°F",
    "percent": "%",
    "dimensionless": "",
    "delta_degC": "K",
    "kelvin": "K",
    "radian": "rad",
    "degree": "°",
    "hour": "h",
    "tonne": "t",
    "delta_degF": "°F",
    "inch": "in",
    "gallon": "gal",
    "short_ton": "short ton",
    "darcy": "D",
    "millidarcy": "mD",
}
_FRENCH = {"day": "j", "year": "an", "rpm": "tr/min", "revolution": "tr"}
_SUPERSCRIPT = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


def pretty_unit(unit: str) -> str:
    """A unit as people print it: ``um`` → ``µm``, ``kg/m^3`` → ``kg/m³``; in French ``tonne/day`` →
    ``t/j``.
    """
    printed = _PRETTY | _FRENCH if current_language() == "fr" else _PRETTY
    text = re.sub(r"[A-Za-z_]+", lambda m: printed.get(m.group(), m.group()), unit)
    # m2 is typed for m^2; in mmH2O the number is no power
    text = re.sub(r"(?:\^|(?<=[^\W\d_]))(-?\d+)(?![\w.])", lambda m: m[1].translate(_SUPERSCRIPT), text)
    return text.replace("*", "·")


CUSTOMARY = frozenset(
    (
        "inch",
        "ft",
        "ft^2",
        "ft^3",
        "lb",
        "lb/hour",
        "gallon/min",
        "ft/s",
        "lb/ft^3",
        "psi",
        "mmHg",
        "degF",
        "kcal",
        "kcal/hour",
        "kcal/kg",
    )
)
"""Units that people type and that are never chosen to print a value."""


FIELD: dict[str, tuple[str, ...]] = {
    "m": ("inch", "ft", "um"),
    "m^2": ("ft^2", "inch^2"),
    "m^3": ("gallon", "ft^3", "inch^3"),
    "kg": ("lb", "oz"),
    "kg/s": ("lb/hour", "short_ton/hour"),
    "m^3/s": ("gallon/min", "ft^3/s"),
    "m/s": ("ft/s", "ft/min", "inch/s"),
    "kg/m^3": ("lb/ft^3",),
    "Pa": ("psi", "inH2O"),
    "K": ("degF",),
    "J": ("Btu",),
    "W": ("hp", "Btu/hour"),
    "J/kg": ("Btu/lb",),
    "J/(kg*K)": ("Btu/(lb*delta_degF)",),
    "kg/(m^2*s)": ("lb/(ft^2*hour)",),
    "W/(m^2*K)": ("Btu/(hour*ft^2*delta_degF)",),
    "W/(m*K)": ("Btu/(hour*ft*delta_degF)",),
    "N": ("lbf",),
    "Pa*s": ("cP",),
    "W/kg": ("hp/lb",),
}
"""Customary units of the United States by SI unit; particle sizes stay in micrometers, viscosities in
centipoise.
"""
SYSTEMS = ("si", "field")
_system: ContextVar[str | None] = ContextVar("granum_units", default=None)


def set_unit_system(code: str) -> None:
    """Choose the units of displayed values for this context: ``si`` (with the usual multiples) or ``field``
    (United States customary).
    """
    if code not in SYSTEMS:
        raise ValueError(f"units '{code}' are not available; choose one of {', '.join(SYSTEMS)}")
    _system.set(code)


def unit_system() -> str:
    """The units of displayed values: ``si`` or ``field`` (from ``set_unit_system``, else GRANUM_UNITS)."""
    return _system.get() or ("field" if os.environ.get("GRANUM_UNITS") == "field" else "si")


def field_units(kind: Kind) -> tuple[str, ...]:
    """Customary units of a kind when they are wanted, the usual one first; empty otherwise.

    >>> from granum.core.kinds import KINDS
    >>> field_units(KINDS["Pressure"])
    ()
    """
    return FIELD.get(kind.unit, ()) if unit_system() == "field" else ()


def best_unit(value: float, kind: Kind) -> str:
    """The display unit in which a value lies between 0.1 (of a time 1) and 9999, the usual unit being
    preferred, then one below 1000.

    Customary units are offered for typing, and chosen for printing only when they are wanted
    (``set_unit_system``).
    """
    units = list(field_units(kind)) or [u for u in kind.units if u not in CUSTOMARY] or list(kind.units)
    if not np.isfinite(value) or value == 0.0 or kind.name == "temperature":
        return units[0]
    sizes = {unit: abs(from_si(value, unit, kind)) for unit in units}
    # parts of a minute are seconds, parts of a millimeter need not be micrometers
    least = 1.0 if kind.unit == "s" else 0.1
    if least <= sizes[units[0]] < most_of(units[0], units):
        return units[0]
    for low, high in ((1.0, 1_000), (0.1, 10_000)):
        for unit in units:
            if low <= sizes[unit] < min(high, most_of(unit, units)):
                return unit
    # far from any of them, nobody counts in percent
    far = [u for u in units if u != "percent"] or units
    return min(far, key=lambda u: abs(np.log10(max(abs(from_si(value, u, kind)), 1e-300)) - 1.5))


def most_of(unit: str, offered: Iterable[str]) -> float:
    """The number from which a unit gives way to a larger one: from 1 m/s on nobody writes mm/s, from five
    hours on nobody minutes, and turns per minute have none above them.

    >>> most_of("mm/s", ("mm/s", "m/s")), most_of("kJ/kg", ("kJ/kg", "kcal/kg")), most_of("rpm", ())
    (1000.0, 10000.0, 1000000.0)
    """
    if unit in ("min", "rpm"):
        return 1e6 if unit == "rpm" else 300.0 if "hour" in offered else 1e4
    small = re.match(r"[umn](?=(m|s|g|L|N|Pa)\b)", unit)
    larger = {unit[1:], "m" + unit[1:], "k" + unit[1:]} if small else set()
    return 1e3 if larger & set(offered) - {unit} else 1e4


def display_unit(values: Any, kind: Kind, usual: str | None = None) -> str:
    """The one unit in which a value, or a column of values, is shown everywhere: terminal, page, report,
    chart, study.

    The unit people usually write (a glossary entry names it) while the middle of the values suits it, else
    the best one.

    >>> from granum.core.kinds import KINDS
    >>> display_unit([2e-6, 85e-6, 0.0], KINDS["Length"]), display_unit(0.4, KINDS["Length"], usual="cm")
    ('um', 'cm')
    """
    array = np.abs(np.atleast_1d(np.asarray(values, dtype=float)))
    good = array[np.isfinite(array) & (array > 0.0)]
    middle = float(np.median(good)) if good.size else 0.0
    if not usual or field_units(kind) or not same_dimension(usual, kind.unit):
        return best_unit(middle, kind)
    # what is usual per cubic meter stays so: a gas has µg/m³ where a liquid has µg/L
    _top, slash, below = usual.partition("/")
    alike = [u for u in kind.units if slash and u.partition("/")[2] == below and u not in CUSTOMARY]
    # 0.08 m/h, not 22 µm/s; 12 s, not 0.2 min
    least = 1.0 if usual == "min" else 0.01 if slash and not set(alike) - {usual} else 0.1
    for unit in (usual, *alike):
        if not middle or least <= abs(from_si(middle, unit, kind)) < most_of(unit, kind.units):
            return unit
    return best_unit(middle, kind)


def format_number(value: float, digits: int = 4) -> str:
    """A number with a few significant figures: ``1.07 × 10⁸`` beyond five digits, ten thousands and more set
    apart by a thin space, the minus sign of print, decimal comma in French.

    >>> format_number(-0.5), format_number(40533.0).replace("\u202f", " ")
    ('−0.5', '40 533')
    """
    if not np.isfinite(value):
        return "—"
    if value == 0.0:
        return "0"
    exponent = int(np.floor(np.log10(abs(value))))
    if -4 <= exponent < 5:
        decimals = max(digits - 1 - exponent, 0)
        text = f"{value:.{decimals}f}"
        whole, point, rest = text.partition(".")
        if exponent == 4:
            whole = f"{whole[:-3]}\u202f{whole[-3:]}"
        text = f"{whole}{point}{rest}".rstrip("0").rstrip(".") if point else whole
    else:
        mantissa, _e, power = f"{value:.{digits - 1}e}".partition("e")
        mantissa, exponent = mantissa.rstrip("0").rstrip("."), int(power)
        text = f"{mantissa} {ten_to(exponent)}"
    return decimal(text)


def figures_of(number: float, unit: str, kind: Kind) -> int:
    """How many significant figures a number is printed with: four, but so many of a percentage just below
    the hundred that it cannot exceed that two are left of what is missing.

    >>> from granum.core.kinds import KINDS
    >>> format_number(99.99943, figures_of(99.99943, "percent", KINDS["Fraction"]))
    '99.99943'
    >>> figures_of(99.99943, "percent", KINDS["MoistureDryBasis"])
    4
    """
    missing = 100.0 - number
    if unit != "percent" or kind.upper != 1.0 or not 1e-7 <= missing < 0.1:
        return 4
    return 3 - int(np.floor(np.log10(missing)))


def ten_to(power: int) -> str:
    """``× 10⁸``."""
    return f"× 10{str(power).translate(_SUPERSCRIPT)}"


def decimal(text: str) -> str:
    """The text of a number with the decimal mark of the current language."""
    text = text.replace("-", "\u2212")
    return text.replace(".", ",") if current_language() == "fr" else text


def show(value: float, kind: Kind, unit: str | None = None) -> str:
    """A value with its unit, ready to print.

    >>> from granum.core.kinds import KINDS
    >>> show(85e-6, KINDS["Length"])
    '85 µm'
    """
    chosen = unit or best_unit(value, kind)
    number = float(from_si(value, chosen, kind))
    return f"{format_number(number, figures_of(number, chosen, kind))} {pretty_unit(chosen)}".strip()
