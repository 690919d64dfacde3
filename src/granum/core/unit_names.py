"""Units by name: the Pint registry with the units of the field added, and the ways people write a unit."""

from __future__ import annotations

import re
import threading
from functools import cache
from typing import Any

from granum.core.errors import UnitError
from granum.core.i18n import _
from granum.core.unit_table import rows

LONGEST_UNIT = 40


_building = threading.Lock()


def registry() -> Any:
    """The one Pint registry, with the customary units of the field added."""
    with _building:  # two threads must not each build one: their units would not mix
        return _registry()


@cache
def _registry() -> Any:
    import pint

    ureg = pint.UnitRegistry(cache_folder=None)
    for line in (
        "barg = 1e5 * pascal; offset: 101325 = bar_gauge",
        "svedberg = 1e-13 * second",
        "mmH2O = 9.80665 * pascal",
        "inwg = inH2O = inWC",
        "psia = psi",
        "psig = 6894.757293168361 * pascal; offset: 101325 = psi_gauge",
        "bara = bar",
        "@alias torr = Torr",
        "lbm = pound",
        "lbmol = 453.59237 * mole",
        "btu = Btu",
        "rev = revolution",
        "tr = revolution",
        "@alias day = j",
        "@alias year = an",
        "gpm = gallon / minute",
        "gpd = gallon / day",
        "mgd = 1e6 * gallon / day = MGD",
        "cfs = foot ** 3 / second",
        "cfm = foot ** 3 / minute = CFM",
        "acfm = cfm = ACFM",  # named, or else Pint reads it as a prefix: atto-cfm
        "cfh = foot ** 3 / hour",
        "gph = gallon / hour",
        "gfd = gallon / foot ** 2 / day",
        "fpm = foot / minute",
        "lpm = liter / minute = LPM",
        "@alias gpm = GPM",
        "igpm = imperial_gallon / minute",
        "kcf = 1000 * foot ** 3",
        "pcf = pound / foot ** 3",
        "ppg = pound / gallon",
        "psf = pound_force / foot ** 2",
        "MMBtu = 1e6 * Btu = MMBTU",
        "MMlb = 1e6 * pound",
        "mCE = meter_H2O",
        "HP = horsepower = bhp",
        "tph = tonne / hour",
        "tpd = tonne / day",
        "mtpd = tonne / day = MTPD",
        "mtph = tonne / hour = MTPH",
        "stpd = short_ton / day = STPD",
        "stph = short_ton / hour = STPH",
        "@alias rpm = RPM",
        "USD = [currency] = dollar = $",
    ):
        ureg.define(line)
    return ureg


_SPELLINGS = {
    "°C": "degC",
    "℃": "degC",
    "°F": "degF",
    "°": "degree",
    "wt%": "%",
    "wt %": "%",
    "vol%": "%",
    "vol %": "%",
    "mol%": "%",
    "mol %": "%",
    "%": "percent",
    "µ": "u",
    "μ": "u",
    "#": "1",
    "Ω": "ohm",
    "·": "*",
    "²": "^2",
    "³": "^3",
    "⁻¹": "^-1",
    "in. H2O": "inH2O",
    "in H2O": "inH2O",
    "in WC": "inH2O",
    "mm H2O": "mmH2O",
    "mm WC": "mmH2O",
    "mm water": "mmH2O",
    "cm H2O": "cmH2O",
    "m H2O": "meter_H2O",
    "cm Hg": "cmHg",
    "cu. m": "m^3",
    "cu m": "m^3",
    "r.p.m.": "rpm",
    "MLD": "megaliter/day",
    "gpl": "g/L",
    "W/mK": "W/(m*K)",
    "W/(mK)": "W/(m*K)",
    "in. w.g.": "inH2O",
    "in. W.C.": "inH2O",
    "in. w.c.": "inH2O",
    "in water": "inH2O",
    "ft water": "ftH2O",
    "mmCE": "mmH2O",
    "in. Hg": "inHg",
    "in Hg": "inHg",
    "mm Hg": "mmHg",
    "US gal": "gallon",
    "US gpm": "gpm",
    "short ton": "short_ton",
    "long ton": "long_ton",
    "metric ton": "tonne",
    "cu. ft": "ft^3",
    "cu ft": "ft^3",
    "cuft": "ft^3",
    "sq. ft": "ft^2",
    "sq ft": "ft^2",
    "sqft": "ft^2",
    "kft3": "kcf",
    "barm/s": "bar*m/s",
    "ksc": "kgf/cm^2",
    "m2K": "m2*K",
    "m²K": "m2*K",
    "kgK": "kg*K",
}
# what Pint takes for something else (cp for a cup, mD for a millidebye), read so where that does not fit
ELSE = {
    "cp": "cP",
    "cps": "cP",
    "cst": "cSt",
    "MT": "tonne",
    "D": "darcy",
    "mD": "millidarcy",
    "md": "millidarcy",
    "mil": "thou",
    "mils": "thou",
    "A": "angstrom",
    "mb": "mbar",
    "ata": "at",
    "CV": "metric_horsepower",
    "ch": "metric_horsepower",
    "PS": "metric_horsepower",
    "µ": "um",
    "μ": "um",
}
# volumes of gas as if it were at some standard state
_STANDARD_GAS = re.compile(
    r"\bN\s?m\s?\^?3|\bSm\^?3|\b[NS][lL](?:pm)?\b|\bs(?:lp|cc)m\b|\b(?i:MM?)?(?i:scf[mhd]?)\b"
)
# read so only where a temperature is due
DEGREES = {"C": "degC", "F": "degF", "R": "degR", "deg C": "degC", "deg F": "degF"}


_WATER = ("h2o", "water", "moisture", "vapor", "vapour", "water vapor", "steam", "eau", "vapeur", "humidité")
_DISSOLVED = ("solute", "salt", "solid", "solids", "soluté", "sel", "solide", "anhydrous")
_DRY = (
    "dry air",
    "dry gas",
    "d.a.",
    "dry solid",
    "dry solids",
    "dry matter",
    "dry basis",
    "bone dry solid",
    "ds",
    "dm",
)
_SEC = ("air sec", "gaz sec", "solide sec", "matière sèche", "produit sec", "ms", "base sèche", "dry product")
_WHOLE = (
    "wet solid",
    "wet solids",
    "wet material",
    "wet basis",
    "solution",
    "slurry",
    "total",
    "suspension",
    "mixture",
)
_HUMIDE = ("solide humide", "produit humide", "base humide", "mélange", "wet product")
_OF_WHAT = re.compile(
    r"(?<![A-Za-z])(kg|mg|g|t|lbm?|kmol|mol)\s+(?:of\s+|de\s+|d['’])?"
    r"((?!per\b)[^\W\d_][\w.]*(?:\s(?!per\b)[^\W\d_][\w.]*)*)(?=\s*(?:[/*·)(]|$|\bper\b))"
)
# what the ratio of each kind may be told per
_PER = {
    "humidity ratio": (*_DRY, *_SEC),
    "moisture, dry basis": (*_DRY, *_SEC),
    "mass ratio": (*_DRY, *_SEC, *_WATER, "solvent", "solvant"),
    "mass fraction": (*_WHOLE, *_HUMIDE),
    "moisture, wet basis": (*_WHOLE, *_HUMIDE),
}


def without_substances(unit: str, kind: str) -> str:
    """A unit without the substances that books set behind its masses, where they say what the kind says too;
    else as it is.

    >>> (
    ...     without_substances("kg H2O/kg dry air", "humidity ratio"),
    ...     without_substances("lb water/h", "mass flow"),
    ... )
    ('kg/kg', 'lb/h')
    >>> without_substances("kg water/kg wet solid", "moisture, dry basis")
    'kg water/kg wet solid'
    """
    if len(unit) > LONGEST_UNIT or not _OF_WHAT.search(unit):
        return unit
    told = [(m.start(), m[2].lower()) for m in _OF_WHAT.finditer(unit)]
    below = unit.find("/") if "/" in unit else len(unit)
    allowed = all(
        word in _WATER + _DISSOLVED if at < below else word in _PER.get(kind, ()) for at, word in told
    )
    return _OF_WHAT.sub(r"\1", unit) if allowed else unit


@cache
def parse_unit(text: str) -> Any:
    """A Pint unit from text such as ``kg/m3``, ``µm``, ``%`` or ``°C``."""
    spelled = text.strip()
    if len(spelled) > LONGEST_UNIT:
        raise UnitError(_("Unit '{unit}…' is too long to be a unit.").format(unit=spelled[:LONGEST_UNIT]))
    for written, meant in _SPELLINGS.items():
        spelled = spelled.replace(written, meant)
    if re.search(r"\bM(Btu|BTU|lbm?|ft3|ft\^3|cf)\b", spelled):
        raise UnitError(
            _(
                "In unit '{unit}' M means a thousand to some and a million to others: write k for a "
                "thousand, a power of ten before the unit for a million."
            ).format(unit=text),
            unit=text,
        )
    if re.search(r"\btons?\b", spelled):
        raise UnitError(
            _(
                "In unit '{unit}' a ton may be 1000 kg or 2000 lb: write t for the one, short ton for the "
                "other, long ton for 2240 lb."
            ).format(unit=text),
            unit=text,
        )
    if _STANDARD_GAS.search(spelled):
        raise UnitError(
            _(
                "Unit '{unit}' is a volume of gas as it would be in a standard state, which says its amount: "
                "give the volume at the temperature and pressure that the gas has (0 °C and 1 atm for Nm3, "
                "60 °F and 14.7 psi for most scf), or its mass."
            ).format(unit=text),
            unit=text,
        )
    spelled = re.sub(r"\b(m?)(Pa|N)s\b", r"\1\2*s", spelled)  # mPas, Ns/m2
    spelled = re.sub(r"\b(N|Pa)-s\b", r"\1*s", spelled)
    spelled = re.sub(r"\bm(\^?2)h\b", r"m\1*h", spelled)  # L/m2h
    spelled = re.sub(r"\b([kM]?N)m\b", r"\1*m", spelled)  # or else a nautical mile
    spelled = re.sub(r"\b(ft|in|lbf?)-(ft|in|lbf?)\b", r"\1*\2", spelled)
    # gal/1000 ft3, lb per 1000 gal
    spelled = re.sub(
        r"\s*(?:/|\bper\b)\s*\(?\s*1000\s*([A-Za-z]+[23]?(?:\^[23])?)\s*\)?$", r"/\1*permille", spelled
    )
    spelled = re.sub(r"^/(?=\s*[^\W\d])", "1/", spelled)  # /m, /min
    # g/100 g of water, g per 100 g, g/(100 g)
    spelled = re.sub(
        r"\s*(?:/|\bper\b)\s*\(?\s*100\s*([A-Za-z]+)(?:\s+(?:of\s+)?(?:water|H2O|solvent|solution))?\s*\)?$",
        r"/\1*percent",
        spelled,
    )
    # kg/m3, cm2, m-1: a power written without its sign, after a letter and at the end of a unit name
    spelled = re.sub(r"(?<![\w])([A-Za-z]+)(-?[1-4])(?![\w])", r"\1^\2", spelled)
    try:
        return registry().Unit(spelled) if spelled else registry().Unit("dimensionless")
    except Exception as problem:  # Pint raises many kinds: tokenizer, undefined, assertion, attribute
        if spelled in ("mesh", "mesh Tyler", "Tyler mesh", "mesh US"):
            raise UnitError(
                _("A mesh number belongs to a sieve series; 'particles.aperture' turns it into an opening."),
                unit=text,
            ) from problem
        raise UnitError(_("Unit '{unit}' is not known.").format(unit=text), unit=text) from problem


@cache
def same_dimension(unit: str, kind_unit: str) -> bool:
    """Whether two units measure the same sort of quantity."""
    return (unit, kind_unit) in rows() or same_by_pint(unit, kind_unit)


def same_by_pint(unit: str, kind_unit: str) -> bool:
    """The same, whatever the units."""
    return parse_unit(unit).dimensionality == registry().Unit(kind_unit).dimensionality


def is_unit(text: str) -> bool:
    """Whether text is a unit that is known."""
    try:
        parse_unit(text)
    except UnitError:
        return False
    return True


def fits(unit: str, kind_unit: str) -> bool:
    """Whether a unit is known and measures the same sort of quantity."""
    try:
        return same_dimension(unit, kind_unit)
    except UnitError:
        return False


@cache
def in_base_units(unit: str) -> tuple[float, float]:
    """(factor, offset) such that ``SI = factor·value + offset``, in the SI unit of its own quantity, by Pint.

    >>> in_base_units("kg/GJ")
    (1e-09, 0.0)
    """
    zero, one = (
        registry().Quantity(value, parse_unit(unit)).to_base_units().magnitude for value in (0.0, 1.0)
    )
    return float(one - zero), float(zero)
