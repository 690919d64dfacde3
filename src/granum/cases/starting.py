"""What a new feed or piece of equipment starts from: ordinary values that fit the substances of the line."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from granum.cases.alone import ordinary, tables
from granum.core import registry
from granum.core.errors import InputError
from granum.core.i18n import _
from granum.materials.library import session

LIQUID, SOLID, GAS = "1000 kg/h", "200 kg/h", "1000 kg/h"
WARM, SATURATED_AT = "80 degC", 348.15  # a solution to be crystallized, saturated a little below
HOT_GAS = "120 degC"
GAS_PER_FEED = 2.0  # kg of drying gas per kg of everything else that enters
GAS_PER_MOISTURE = 30.0  # and per kg of what a feed that is dried as it is holds of liquid
SIZES = {"law": "rosin_rammler", "size_modulus": "150 um", "distribution_exponent": 1.5}
PAIR = ("dry air", "water")


def starting_values(model: str, mixture: Mapping[str, Any]) -> dict[str, Any]:
    """The parameters a piece of equipment starts from: those it opens with alone, with the substances of the
    line in place of its own. An option that is about its own substances is left out.

    Parameters
    ----------
    model: key of the card. mixture: the table ``[mixture]`` of the case.
    """
    own = crystallizing(tables(model)["mixture"])
    here = dict(zip(own, crystallizing(mixture), strict=True))
    needed = {p.name for p in registry.find(model).card.parameters if p.required}

    def filled(value: Any) -> Any:
        if isinstance(value, dict):
            return {k: filled(v) for k, v in value.items()}
        if isinstance(value, str) and value and here.get(value) == "":
            raise InputError(
                _(
                    "Nothing crystallizes here: choose a solute among the liquids and its crystal among the "
                    "solids first."
                )
            )
        return here.get(value, value) if isinstance(value, str) else value

    return {
        name: filled(value)
        for name, value in ordinary(model).items()
        if name in needed or not _speaks_of(value, own)
    }


def _speaks_of(value: Any, substances: tuple[str, ...]) -> bool:
    """Whether a value names one of some substances."""
    inside = value.values() if isinstance(value, dict) else (value,)
    return any(
        _speaks_of(v, substances) if isinstance(v, dict) else bool(v) and v in substances for v in inside
    )


def listed(mixture: Mapping[str, Any], phase: str) -> list[str]:
    """The species of a phase."""
    found = mixture.get(phase)
    return [str(name) for name in found] if isinstance(found, list) else []


def crystallizing(mixture: Mapping[str, Any]) -> tuple[str, str, str]:
    """Solvent, solute and crystal, the first of the line that belong together; empty where there are none."""
    liquids, solids = listed(mixture, "liquids"), listed(mixture, "solids")
    for name in liquids[1:]:
        crystals = crystals_of(name, liquids[0])
        for crystal in crystals:
            if crystal in solids:
                return liquids[0], name, crystal
    return (liquids[0] if liquids else "", "", "")


def crystals_of(solute: str, solvent: str) -> list[str]:
    """The crystals that a dissolved substance can form from a solvent, by name; none where it is no solute in
    it.
    """
    known = session().entries("solute")
    found = next(
        (
            entry
            for name in (solute, f"{solute} in {solvent}")
            if (entry := known.get(name)) is not None and entry.solvent == solvent
        ),
        None,
    )
    return [] if found is None else [branch.crystal for branch in found.branches]


def starting_feed(mixture: Mapping[str, Any]) -> dict[str, Any]:
    """A feed with each condensed phase of the line, or with its gas where there is nothing else."""
    liquids, solids, gases = (listed(mixture, phase) for phase in ("liquids", "solids", "gases"))
    _solvent, solute, crystal = crystallizing(mixture)
    made: dict[str, Any] = {"temperature": WARM if solute else "25 degC"}
    inert = [name for name in solids if name != crystal or not solute]
    if liquids:
        made |= {"liquid_flow": LIQUID, "liquid": _dissolved(liquids)}
    if inert:
        made |= {"solid_flow": SOLID, "solid": _shares(solids, inert[0]), "sizes": dict(SIZES)}
    if not liquids and (gases or not inert):
        made |= {"gas_flow": GAS, "gas": _shares(gases, gases[0] if gases else "")}
    return made


def first_feed(mixture: Mapping[str, Any], enters: str) -> dict[str, Any]:
    """The first feed of a line: what it is made of in proportions ordinary for a solution, a suspension, a
    moist solid, a broken solid or a dusty gas.
    """
    made = starting_feed(mixture)
    if enters == "moist_solid":
        made |= {"solid_flow": "1000 kg/h", "liquid_flow": "200 kg/h"}
    if enters == "broken_solid":
        made |= {"solid_flow": "100 t/h", "sizes": BROKEN}
    if enters == "dusty_gas":
        gases = listed(mixture, "gases")
        made |= {
            "solid_flow": "20 kg/h",
            "sizes": DUST,
            "gas_flow": "2000 kg/h",
            "gas": _shares(gases, gases[0]),
        }
    return made


BROKEN = {"law": "rosin_rammler", "size_modulus": "60 mm", "distribution_exponent": 1.6}
DUST = {"law": "rosin_rammler", "size_modulus": "20 um", "distribution_exponent": 1.2}


def _dissolved(liquids: list[str]) -> dict[str, str]:
    """Shares of the liquid: each solute nearly saturated a little below the temperature of the feed, each
    other liquid a tenth.
    """
    ratios = {name: _ratio(name, liquids[0]) for name in liquids[1:]}
    whole = 1.0 + sum(ratios.values())
    shares = {name: round(100.0 * ratio / whole, 1) for name, ratio in ratios.items()}
    return {liquids[0]: f"{100.0 - sum(shares.values()):.10g} %"} | {
        name: f"{x:.10g} %" for name, x in shares.items()
    }


def _ratio(name: str, solvent: str) -> float:
    if not crystals_of(name, solvent):
        return 0.1
    known = session()
    system = known.solute(name if name in known.names("solute") else f"{name} in {solvent}")
    return 0.95 * float(system.solubility(SATURATED_AT))


def _shares(names: list[str], one: str) -> dict[str, str]:
    return {name: "100 %" if name == one else "0 %" for name in names}


def hourly(flow: float) -> str:
    """A flow in kg/s as somebody would round it.

    >>> hourly(0.6667), hourly(2.0)
    ('2400 kg/h', '7200 kg/h')
    """
    return f"{float(f'{3600.0 * flow:.2g}'):.10g} kg/h"


def drying_gas(mixture: Mapping[str, Any], flow: float, ambient: bool = False) -> dict[str, Any]:
    """Hot or ambient gas for a dryer: of the carrier, with a little of its vapor."""
    gases = listed(mixture, "gases")
    liquids = listed(mixture, "liquids")
    vapor = next((name for name in gases if name in liquids[:1]), "")
    carrier = next((name for name in gases if name != vapor), "")
    shares = {name: "99 %" if name == carrier else "1 %" if name == vapor else "0 %" for name in gases}
    if not vapor:
        shares[carrier] = "100 %"
    return {
        "temperature": "20 degC" if ambient else HOT_GAS,
        "gas_flow": hourly(flow),
        "gas": shares,
    }


def wash_liquor(mixture: Mapping[str, Any], flow: float) -> dict[str, Any]:
    """Pure solvent."""
    liquids = listed(mixture, "liquids")
    return {
        "temperature": "20 degC",
        "liquid_flow": hourly(flow),
        "liquid": _shares(liquids, liquids[0]),
    }
