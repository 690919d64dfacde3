"""Substances that a case describes itself: what a form asks of one, and the tables of a case that hold it.

text = describe_substance(text, "solid", "PVC", {"density": "1.4 g/cm3", "heat_capacity": "0.9 kJ/(kg K)"})
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from granum.cases.building import choose_substances
from granum.cases.outline import table_of
from granum.cases.reading import own_materials, parsed
from granum.cases.schema import OWN
from granum.cases.sections import checked, with_table, with_value, without_table, without_value
from granum.cases.starting import listed
from granum.core.constants import ZERO_CELSIUS
from granum.core.conversion import convert
from granum.core.errors import InputError, unknown_name
from granum.core.i18n import _
from granum.core.kinds import KINDS
from granum.core.parameters import REQUIRED, Parameter
from granum.core.units import from_si
from granum.core.written import read_number
from granum.materials.library import session

WATER = "water"
# key of a materials file: the word it is called by, its kind
PROPERTIES: dict[str, dict[str, tuple[str, str]]] = {
    "solid": {
        "density": ("density", "Density"),
        "heat_capacity": ("specific_heat_capacity", "HeatCapacity"),
        "conductivity": ("thermal_conductivity", "ThermalConductivity"),
        "molar_mass": ("molar_mass", "MolarMass"),
        "sphericity": ("sphericity", "Sphericity"),
    },
    "fluid": {
        "molar_mass": ("molar_mass", "MolarMass"),
        "liquid_density": ("density_liquid", "Density"),
        "liquid_heat_capacity": ("specific_heat_capacity_liquid", "HeatCapacity"),
        "liquid_viscosity": ("dynamic_viscosity_liquid", "DynamicViscosity"),
        "liquid_conductivity": ("thermal_conductivity_liquid", "ThermalConductivity"),
        "surface_tension": ("surface_tension", "SurfaceTension"),
        "vapor_heat_capacity": ("specific_heat_capacity_gas", "HeatCapacity"),
        "vapor_viscosity": ("dynamic_viscosity_gas", "DynamicViscosity"),
        "vapor_conductivity": ("thermal_conductivity_gas", "ThermalConductivity"),
    },
    "solute": {
        "molar_mass": ("molar_mass", "MolarMass"),
        "temperature": ("temperature", "Temperature"),
        "solubility": ("solute_mass_fraction", "MassFraction"),
        "heat_of_solution": ("heat_of_solution", "MolarEnergy"),
        "crystal_density": ("density_crystal", "Density"),
        "crystal_heat_capacity": ("specific_heat_capacity_crystal", "HeatCapacity"),
    },
}
NEEDED = {
    "solids": ("density", "heat_capacity"),
    "liquids": ("molar_mass", "liquid_density", "liquid_heat_capacity", "liquid_viscosity"),
    "gases": ("molar_mass", "vapor_heat_capacity", "vapor_viscosity", "vapor_conductivity"),
    "solutes": tuple(PROPERTIES["solute"]),
}
"""What a substance must have for the part it plays."""
SORTS = {"solids": "solid", "liquids": "fluid", "gases": "fluid", "solutes": "solute"}
SERIES = ("temperature", "solubility")
NUMBERS = ("molar_mass", "sphericity")
LIKE = "like"  # the solute of the library whose solutions have the density and viscosity of this one's
_SOLUTIONS = (
    "density",
    "density_limits",
    "viscosity",
    "viscosity_limits",
    "heat_capacity",
    "heat_capacity_limits",
)


def parameters_of_substance(part: str) -> list[Parameter]:
    """What a form asks of a substance that is one of ``solids``, ``liquids``, ``gases`` or ``solutes``."""
    sort = SORTS[part]
    return [
        Parameter(
            word,
            KINDS[kind],
            default=REQUIRED if key in NEEDED[part] else None,
            series="points" if key in SERIES else None,
        )
        for key, (word, kind) in PROPERTIES[sort].items()
    ]


def likenesses(solvent: str) -> list[str]:
    """The solutes of the library whose solutions in a solvent are known."""
    return sorted(
        name
        for name, entry in session().entries("solute").items()
        if entry.solvent == solvent and entry.viscosity is not None
    )


def described(raw: Mapping[str, Any]) -> list[dict[str, Any]]:
    """The substances that a case describes, with the constants that a form can change; what depends on
    temperature by a formula is only named.
    """
    found = []
    for sort in OWN:
        for name, table in table_of(raw, sort).items():
            if not isinstance(table, dict):
                continue
            values = {key: text for key in PROPERTIES[sort] if (text := _text(sort, key, table))}
            if sort == "solute":
                values |= _curve(table)
            rest = [key for key in table if key in PROPERTIES[sort] and key not in values]
            found.append({"sort": sort, "name": name, "values": values, "formulas": rest})
    return found


def _text(sort: str, key: str, table: Mapping[str, Any]) -> str:
    value = table.get(key)
    if isinstance(value, Mapping):
        value = f"{value['value']} {value.get('unit', '')}".strip() if "value" in value else None
    if key == "molar_mass" and isinstance(value, (int, float)):
        return f"{1000.0 * value:.10g} g/mol"
    known = isinstance(value, (str, int, float)) and not isinstance(value, bool)
    return str(value) if known and key in PROPERTIES[sort] else ""


def _curve(table: Mapping[str, Any]) -> dict[str, str]:
    """Points and heat of the one crystal of a solute that is described by a table."""
    branches = table.get("branches")
    if not (isinstance(branches, list) and len(branches) == 1 and isinstance(branches[0], Mapping)):
        return {}
    branch = branches[0]
    points = branch.get("table") if branch.get("form") == "table" else None
    if not isinstance(points, list) or not points:
        return {}
    heat = branch.get("heat_of_solution")
    return {
        "temperature": "; ".join(f"{T:.10g}" for T, _w in points) + " degC",
        "solubility": "; ".join(f"{w:.10g}" for _T, w in points) + " percent",
        "crystal": str(branch.get("crystal", "")),
    } | ({"heat_of_solution": f"{heat / 1000.0:.10g} kJ/mol"} if isinstance(heat, (int, float)) else {})


def describe_substance(
    case: str, sort: str, name: str, values: Mapping[str, str], part: str = "", solvent: str = WATER
) -> str:
    """A substance described by its constants, or one that the case describes already under other constants.

    Parameters
    ----------
    sort: ``solid``, ``fluid`` or ``solute``. values: constants by their key of a materials file, as text with
        units; of a solute its solubility at three temperatures or more, percent of the saturated solution,
        the crystal, and ``like``, a solute of the library whose solutions are taken as those of this one.
    part: phase of the mixture that takes it up. solvent: of a solute.
    """
    if sort not in PROPERTIES:
        raise unknown_name(_("Sort of material"), sort, PROPERTIES)
    name = name.strip()
    if not name:
        raise InputError(_("The substance needs a name."), name="name")
    asked = part if sort != "solute" else "solutes"
    before = table_of(table_of(parsed(case, "case"), sort), name)
    given = {key: text.strip() for key, text in values.items() if text.strip()}
    _require(sort, asked, given, before, name)
    if sort == "solute":
        case = _with_solute(case, name, given, solvent, before)
    else:
        case = _with_constants(case, (sort, name), sort, given)
    raw = parsed(checked(case), "case")
    session().with_own([own_materials(raw)])  # refuses what cannot be
    mixture = table_of(raw, "mixture")
    if not part or not mixture:
        return case
    chosen = {phase: listed(mixture, phase) for phase in ("liquids", "solids", "gases")}
    added = {part: name} | ({"solids": given.get("crystal") or name} if sort == "solute" else {})
    for phase, one in added.items():
        if one not in chosen[phase]:
            chosen[phase] = [*chosen[phase], one]
    return choose_substances(case, **chosen)


def _require(sort: str, part: str, given: Mapping[str, str], before: Mapping[str, Any], name: str) -> None:
    """Refuses constants that are no quantities of their kind, and what is missing."""
    known = {*PROPERTIES[sort], *(("crystal", LIKE) if sort == "solute" else ())}
    for key, text in given.items():
        if key not in known:
            raise unknown_name(_("Property"), key, known)
        if key in PROPERTIES[sort]:
            _value(sort, key, text)
    needed = NEEDED.get(part, ("molar_mass",) if sort != "solid" else ())
    if sort == "solute" and (before or given.get("crystal") in session().names("solid")):
        needed = tuple(key for key in needed if not key.startswith("crystal_"))
    missing = next((key for key in needed if key not in given and key not in before), None)
    if missing is not None and not (sort == "solute" and before):
        raise InputError(
            _("{unit}: {label} is missing.").format(unit=name, label=_parameter(sort, missing).label),
            name=missing,
        )


def _parameter(sort: str, key: str) -> Parameter:
    word, kind = PROPERTIES[sort][key]
    return Parameter(word, KINDS[kind], series="points" if key in SERIES else None)


def _value(sort: str, key: str, text: str) -> Any:
    """A constant in SI; a refusal speaks of it by its label."""
    p = _parameter(sort, key)
    try:
        return convert(text, p)
    except InputError as problem:
        raise InputError(problem.message, **{**problem.details, "name": key}) from None


def _with_constants(case: str, path: tuple[str, ...], sort: str, given: Mapping[str, str]) -> str:
    table = table_of(table_of(parsed(case, "case"), path[0]), path[1])
    if not table:
        return with_table(case, path, {key: _written(sort, key, text) for key, text in given.items()})
    shown = {key for key in PROPERTIES[sort] if _text(sort, key, table)}
    for key, text in given.items():
        if text == _text(sort, key, table):
            continue
        now = table.get(key)
        read = read_number(text)
        if isinstance(now, Mapping) and read:  # the source beside a value stays
            for word, value in (("value", read[0]), ("unit", read[1])):
                if value or word in now:
                    case = with_value(case, (*path, key), word, value)
        else:
            case = with_value(case, path, key, _written(sort, key, text))
    for key in shown - set(given):
        case = without_value(case, path, key)
    return case


def _written(sort: str, key: str, text: str) -> Any:
    """A constant as it stands in the file: numbers without a unit in SI, quantities as they were typed."""
    if key == "sphericity":
        return float(_value(sort, key, text))
    number = read_number(text)
    return text if number is None else f"{number[0]:.12g} {number[1]}".strip()


def _with_solute(
    case: str, name: str, given: Mapping[str, str], solvent: str, before: Mapping[str, Any]
) -> str:
    """The case with a solute, its crystal and its solubility."""
    if before and not _curve(before):  # several crystals or a formula: only what is constant changes
        return _with_constants(case, ("solute", name), "solute", given)
    crystal = given.get("crystal") or name
    raw = parsed(case, "case")
    if crystal not in table_of(raw, "solid") and crystal not in session().names("solid"):
        solid = {
            "density": given["crystal_density"],
            "heat_capacity": given["crystal_heat_capacity"],
            "molar_mass": given["molar_mass"],
        }
        case = _with_constants(case, ("solid", crystal), "solid", solid)
    branch = _branch(crystal, given)
    if before:
        case = with_value(case, ("solute", name), "molar_mass", given["molar_mass"])
        return with_value(case, ("solute", name), "branches", [branch])
    table: dict[str, Any] = {"molar_mass": given["molar_mass"]}
    table |= {"solvent": solvent} if solvent != WATER else {}
    like = given.get(LIKE)
    if like:
        if like not in likenesses(solvent):
            raise unknown_name(_("Solute"), like, likenesses(solvent))
        entry = session().entries("solute")[like]
        table |= {key: list(x) for key in _SOLUTIONS if (x := getattr(entry, key)) is not None}
    key = name if solvent == WATER else f"{name} in {solvent}"
    return with_table(case, ("solute", key), table | {"branches": [branch]})


def _branch(crystal: str, given: Mapping[str, str]) -> dict[str, Any]:
    T, w = (_value("solute", key, given[key]) for key in SERIES)
    if len(T) != len(w) or len(T) < 3:
        raise InputError(
            _(
                "A solubility needs three temperatures or more and as many values: there are {temperatures} "
                "and {values}."
            ).format(temperatures=len(T), values=len(w)),
            name="solubility",
        )
    points = sorted(zip((float(x) for x in T), (float(x) for x in w), strict=True))
    heat = float(_value("solute", "heat_of_solution", given["heat_of_solution"]))
    ends = [points[0][0], points[-1][0]]
    return {
        "crystal": crystal,
        "stable": ends,
        "range": ends,
        "basis": "kg anhydrous per kg solvent",
        "form": "table",
        "table": [
            [round(x - ZERO_CELSIUS, 6), round(float(from_si(y, "percent", KINDS["MassFraction"])), 6)]
            for x, y in points
        ],
        "heat_of_solution": heat,
        "source": "stated",
    }


def forget_substance(case: str, sort: str, name: str) -> str:
    """The case without the description of a substance that it no longer uses."""
    raw = parsed(case, "case")
    if name not in table_of(raw, sort):
        raise unknown_name(_("Substance"), name, table_of(raw, sort))
    mixture = table_of(raw, "mixture")
    if any(name.partition(" in ")[0] in listed(mixture, phase) for phase in ("liquids", "solids", "gases")):
        raise InputError(
            _("'{name}' is in the line: take it out of the liquids, solids and gases first.").format(
                name=name
            )
        )
    return checked(without_table(case, (sort, name)))
