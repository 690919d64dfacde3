"""What a line takes from outside: the utilities of its units, added up.

A unit says what it takes by itself. A line counts it unless somebody else in the line pays for it: gas that
another unit has heated, the pressure that a fan or a pump drawn into the line gives.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any, NamedTuple

import jax.numpy as jnp
import numpy as np

from granum.core.constants import ZERO_CELSIUS
from granum.core.conversion import convert
from granum.core.errors import InputError, unknown_name
from granum.core.i18n import _
from granum.core.kinds import KINDS, MassFlow, MassRatio, Power, Ratio, SpecificEnergy
from granum.core.parameters import Parameter, outputs_of
from granum.core.utilities import COOLING, ELECTRICITY, HEAT, carrier, purpose, sort_of
from granum.costs.formulas.economics import energy_cost_rate, material_cost_rate
from granum.costs.formulas.emissions import CARRIERS, emission_factor, greenhouse_gas_rate
from granum.costs.tables import emissions
from granum.drying.balances.indices import energy_consumption_ratio
from granum.flowsheet.sheet import Flowsheet
from granum.numerics.smooth import safe_divide
from granum.streams.equipment.movers import Fan, Pump
from granum.streams.stream import Stream
from granum.streams.utilities import COLD

GAS_OUTLETS = ("exhaust", "vapor", "gas", "warmed_air")
HOTTEST_DRYING = 453.15  # K, up to which the notes give a heat of vaporization
UTILITIES = "utilities"  # before the name of a total, in the place of that of a unit
DUSTY = 1e-4  # kg of solid per kg of gas, a tenth of a gram per cubic meter: below it one cleans a gas
REMOVED = ("evaporation_rate", "evaporation")
"""Figures by which a dryer or an evaporator, or a crystallizer, says how much water it removes."""


class Totals(NamedTuple):
    """What a line takes in all; energy is electricity, heat, and the electricity that makes the cold. Not a
    number without water removed.
    """

    electric_power: Power
    heat_input: Power
    cooling_input: Power
    refrigeration_power: Power
    energy_per_product: SpecificEnergy
    evaporation_rate: MassFlow
    energy_per_water: SpecificEnergy
    energy_consumption_ratio: Ratio
    greenhouse_gas_rate: MassFlow
    greenhouse_gas_per_product: MassRatio


FIGURES: dict[str, Parameter] = {p.name: p for p in outputs_of(Totals, "", {})}
WATER = ("evaporation_rate", "energy_per_water", "energy_consumption_ratio")


def counted(line: Flowsheet) -> dict[str, tuple[str, ...]]:
    """Of each unit the utilities that the line counts."""
    blown, pumped = _blown(line), _fed_by(line, Pump)
    found = {}
    for unit in line.order:
        uses = type(line.units[unit]).utilities
        found[unit] = tuple(
            name
            for name, use in uses.items()
            if not (use.inlet and not _from_outside(line, unit, use.inlet))
            and not (purpose(name) == "fan" and unit in blown)
            and not (purpose(name) == "pump" and unit in pumped)
        )
    return found


def _from_outside(line: Flowsheet, unit: str, port: str) -> bool:
    return any(not k.origin and k.target == f"{unit}.{port}" for k in line.links)


def _fed_by(line: Flowsheet, kind: type) -> set[str]:
    return {k.target_unit for k in line.links if k.origin and isinstance(line.units[k.source_unit], kind)}


def _blown(line: Flowsheet) -> set[str]:
    """Units through which a fan of the line drives the gas, before it and behind it."""
    found: set[str] = set()
    todo = [name for name in line.order if isinstance(line.units[name], Fan)]
    while todo:
        unit = todo.pop()
        if unit in found:
            continue
        found.add(unit)
        for k in line.links:
            if k.source_unit == unit and k.target and _carries_gas(line, k.origin):
                todo.append(k.target_unit)
            if (
                k.target_unit == unit
                and k.origin
                and _carries_gas(line, k.origin)
                and _takes_gas(line, k.target)
            ):
                todo.append(k.source_unit)
    return found


def _carries_gas(line: Flowsheet, end: str) -> bool:
    unit, _dot, port = end.partition(".")
    thing = line.units[unit]
    return port in GAS_OUTLETS or (len(thing.outlet_names()) == 1 and not isinstance(thing, Pump))


def _takes_gas(line: Flowsheet, end: str) -> bool:
    unit, _dot, port = end.partition(".")
    names = line.units[unit].inlet_names()
    return port == "gas" or names is None or len(names) == 1


def by_carrier(line: Flowsheet, uses: Mapping[str, Mapping[str, Any]]) -> dict[str, Any]:
    """What the line takes of every carrier and material, SI; areas are nothing that is taken."""
    found: dict[str, Any] = {}
    for unit, names in counted(line).items():
        for name in names:
            if (what := carrier(name)) != "area" and name in uses[unit]:
                found[what] = found.get(what, 0.0) + uses[unit][name]
    return found


def totals(
    line: Flowsheet,
    uses: Mapping[str, Mapping[str, Any]],
    figures: Mapping[str, Any],
    streams: Mapping[str, Stream],
) -> Totals:
    """The line's totals from what its units take; may be traced."""
    names = counted(line)

    def total(sort: str) -> Any:
        rows = [
            uses[unit][n]
            for unit, own in names.items()
            for n in own
            if sort_of(n) == sort and n in uses[unit]
        ]
        return sum(rows, jnp.zeros(()))

    electricity, heat, cold = (total(sort) for sort in (ELECTRICITY, HEAT, COOLING))
    taken = by_carrier(line, uses)
    freezing = sum(
        (x * emissions()[what].electricity for what, x in taken.items() if what in COLD), jnp.zeros(())
    )
    energy = electricity + heat + freezing
    gas = sum(
        (
            greenhouse_gas_rate.function(x, emission_factor.function(what))
            for what, x in taken.items()
            if what in CARRIERS
        ),
        jnp.zeros(()),
    )
    made = streams_by_product(line, streams, lambda s: s.mass_flow)
    water, latent = _water(line, figures, streams)
    per_water = jnp.where(water > 0.0, safe_divide(energy, water), jnp.nan)
    return Totals(
        electricity,
        heat,
        cold,
        freezing,
        safe_divide(energy, made),
        water,
        per_water,
        energy_consumption_ratio.function(per_water, latent),
        gas,
        safe_divide(gas, made),
    )


def streams_by_product(
    line: Flowsheet, streams: Mapping[str, Stream], figure: Callable[[Stream], Any]
) -> Any:
    """A figure of the main product: the stream leaving the line with most solid times its share of solid;
    where none has any, with most of what is dissolved, else with most liquid, else with most mass.
    """
    return jnp.stack([figure(streams[name]) for name in line.products])[main_product(line, streams)]


def main_product(line: Flowsheet, streams: Mapping[str, Stream]) -> Any:
    """Which of the line's products is the main one, by its place among them; may be traced.

    The one with most solid times its share of solid, so that a cake comes before the water that has more
    solid in it; without solids that with most beside the solvent, of those that a unit calls its product if
    there are any: a melt is purified by leaving what is beside it. The dust of a gas is no product.
    """
    leaving = [streams[name] for name in line.products]
    solid, mass = (jnp.stack([getattr(s, n) for s in leaving]) for n in ("solid_flow", "mass_flow"))
    liquid = jnp.stack([s.liquid for s in leaving])
    gas = jnp.stack([s.gas_flow for s in leaving])
    whole, trace = jnp.sum(liquid, axis=1), 1e-9 * jnp.sum(mass) + DUSTY * jnp.sum(gas)
    # of a mixture without liquids nothing is the solvent
    solvent = jnp.argmax(jnp.sum(liquid, axis=0)) if liquid.shape[1] else 0
    dissolved = whole - liquid @ (jnp.arange(liquid.shape[1]) == solvent)
    called = np.array([line.link(name).origin.endswith(".product") for name in line.products])
    dissolved = jnp.where(called, dissolved, 0.0) if called.any() else dissolved
    worth = mass
    for matter, share in ((whole, 1.0), (dissolved, 1.0), (solid, safe_divide(solid, mass))):
        worth = jnp.where(jnp.sum(matter) > trace, matter * share, worth)
    return jnp.argmax(worth)


def price_parameter(name: str) -> Parameter:
    """What a price of a carrier or a material is."""
    word = "energy_price" if name in CARRIERS else "mass_price"
    return Parameter(word, KINDS["EnergyPrice" if name in CARRIERS else "MassPrice"])


def priced(line: Flowsheet, prices: Mapping[str, Any], where: str = "") -> dict[str, float]:
    """Prices of what the units of a line may take, SI, or a refusal that names what they take."""
    known = {carrier(n) for unit in line.order for n in type(line.units[unit]).utilities} - {"area"}
    for name in prices:
        if name not in known:
            raise unknown_name(_("Utility"), name, sorted(known))
    return {n: float(convert(v, price_parameter(n), " " + where)) for n, v in prices.items()}


def cost_rate(taken: Mapping[str, float], prices: Mapping[str, Any]) -> float:
    """Cost per time of what is taken of every carrier (W) and material (kg/s), USD/s."""
    for name in prices:
        if name not in taken:
            raise unknown_name(_("Utility"), name, taken)
    missing = [name for name, value in taken.items() if value > 0.0 and name not in prices]
    if missing:
        raise InputError(
            _("This line also takes {names}: give a price for it, per energy or per mass.").format(
                names=", ".join(missing)
            ),
            name=missing[0],
        )
    costs = [
        energy_cost_rate(taken[name], price) if name in CARRIERS else material_cost_rate(taken[name], price)
        for name, price in prices.items()
    ]
    return float(sum(costs))


def _water(line: Flowsheet, figures: Mapping[str, Any], streams: Mapping[str, Stream]) -> tuple[Any, Any]:
    """Water that leaves units of the line as vapor, and the temperature at which it leaves, on average."""
    rows = []
    for unit, found in figures.items():
        said = next((name for name in REMOVED if hasattr(found, name)), None)
        if said is None:
            continue
        leaves = [
            streams[k.name].temperature
            for k in line.links
            if k.source_unit == unit and k.origin.partition(".")[2] in GAS_OUTLETS
        ]
        rows.append((getattr(found, said), leaves[0] if leaves else ZERO_CELSIUS))
    if not rows:
        return jnp.zeros(()), jnp.asarray(ZERO_CELSIUS)
    water = jnp.stack([jnp.maximum(jnp.asarray(x), 0.0) for x, _T in rows])
    at = jnp.clip(jnp.stack([jnp.asarray(T) for _x, T in rows]), ZERO_CELSIUS, HOTTEST_DRYING)
    return jnp.sum(water), safe_divide(jnp.sum(water * at), jnp.sum(water), ZERO_CELSIUS)
