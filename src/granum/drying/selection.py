"""Which dryer for a product, and whether to dry by heat at all: ranked, with reasons."""

from __future__ import annotations

from math import exp, log, sqrt
from typing import Annotated, Any, Literal, NamedTuple

import numpy as np

from granum.core import procedure
from granum.core.constants import ZERO_CELSIUS
from granum.core.datasets import dataset
from granum.core.errors import InputError
from granum.core.i18n import _
from granum.core.kinds import (
    Fraction,
    Mass,
    MassFlow,
    MoistureDryBasis,
    Series,
    SpecificEnergy,
    Temperature,
    Time,
)
from granum.core.units import format_number

DECADE = log(10.0)
# Flash and spray dryers keep the product hot for seconds only: it may see some 20 K more than in a dryer of
# minutes or hours.
BRIEF, ALLOWANCE = 60.0, 20.0
TOLERANT = ZERO_CELSIUS + 50.0  # from which on a product can be dried in warm air


class Dryers(NamedTuple):
    """Dryers, best first."""

    dryer: Annotated[str, Series("dryers")]
    suitability: Annotated[Fraction, Series("dryers")]
    dryer_size: Annotated[str, Series("dryers")]
    energy_per_water: Annotated[SpecificEnergy, Series("dryers")]
    speaks_for: Annotated[str, Series("dryers")]
    speaks_against: Annotated[str, Series("dryers")]


def _beyond(value: float, low: float, high: float) -> float:
    """By how much a value lies outside a range, as a natural logarithm."""
    if value < low:
        return log(low / max(value, 1e-12))
    return log(value / high) if value > high else 0.0


@procedure(source="houdon2017; mujumdar2014, ch. 1; perry2008, § 12", title="Choice of a dryer")
def choose(
    product_form: Literal["liquid", "paste", "powder", "fibrous", "sheet", "web", "pieces"],
    mass_flow: MassFlow,
    moisture_dry_basis_inlet: MoistureDryBasis,
    moisture_dry_basis_outlet: MoistureDryBasis,
    temperature_limit: Temperature | None = None,
    residence_time: Time | None = None,
    hazard: Literal["none", "dust", "solvent", "toxic"] = "none",
    fragile: bool = False,
) -> Dryers:
    """Dryers ranked for a product by its form, moisture, heat sensitivity, feed, hazard and drying time, with
    what speaks for and against each.

    The suitability is 1 where every figure lies in the range in which a dryer is commonly used; it falls by a
    factor e for each decade outside, and is zero for a form of product that the dryer cannot take. Forms it
    takes only after preparation, and costs out of proportion, count against it too. ``temperature_limit`` is
    the highest temperature the product bears, ``residence_time`` the time it needs (known from a drying
    curve). The sizes come from common capacities (the course notes' tables IV.1 to IV.22): use the list to
    decide what to test.

    >>> choose("liquid", "5 t/h", 1.0, 0.03, temperature_limit="80 degC").dryer[0]
    'spray dryer'
    >>> choose("powder", "20 t/h", 0.54, 0.18, temperature_limit="60 degC", residence_time="8 hour").dryer[0]
    'silo dryer'
    """
    X1, X2 = moisture_dry_basis_inlet, moisture_dry_basis_outlet
    if X2 >= X1:
        raise InputError(
            _("The product is to leave at {outlet} kg/kg, not drier than it comes ({inlet} kg/kg).").format(
                outlet=format_number(X2, 4), inlet=format_number(X1, 4)
            ),
            name="moisture_dry_basis_outlet",
        )
    water = mass_flow * (X1 - X2) / (1.0 + X1)
    limit = temperature_limit
    rows = []
    for d in dataset("drying", "dryers_houdon2017"):
        missing, good, why = 0.0, [], []
        if not d[product_form]:
            rows.append((0.0, d, good, [_("does not take this form of product")]))
            continue
        if d[product_form] < 1.0:
            missing += DECADE / 4.0
            why.append(_("needs it preformed, granulated or mixed with dry product first"))
        off = _beyond(mass_flow, d["flow_low"], d["flow_high"])
        if off > 0:
            # several machines side by side are possible
            missing += off / (3.0 if mass_flow > d["flow_high"] else 1.0)
            why.append(_("feed outside {low} to {high} t/h").format(**_span(d, "flow", 3.6)))
        else:
            good.append(_("made for {low} to {high} t/h").format(**_span(d, "flow", 3.6)))
        if limit is not None:
            seen = d["product_low"] - (ALLOWANCE if d["residence_high"] <= BRIEF else 0.0)
            if seen > limit:
                missing += DECADE * (seen - limit) / 10.0
                why.append(
                    _("heats the product to {value} °C at least").format(
                        value=format_number(d["product_low"] - ZERO_CELSIUS, 3)
                    )
                )
            else:
                good.append(_("cool enough for the product"))
        if d["gas_low"] < ZERO_CELSIUS and (limit is None or limit > TOLERANT):
            missing += DECADE / 2.0
            why.append(_("several times as dear as drying in air: for what bears no heat"))
        if residence_time is not None:
            off = _beyond(residence_time, d["residence_low"], d["residence_high"])
            if off > 0:
                # too long a stay is merely wasteful
                missing += off * (1.5 if residence_time > d["residence_high"] else 0.3)
                why.append(
                    _("keeps the product {low} to {high} min").format(**_span(d, "residence", 1.0 / 60.0))
                )
            else:
                good.append(_("time enough to dry"))
        worry = _hazard(hazard, d)
        if worry:
            missing += DECADE
            why.append(worry)
        elif hazard != "none" and d["closed"]:
            good.append(_("closed, with little gas"))
        if d["batch"]:
            why.append(_("works in batches"))
        if fragile and not d["gentle"]:
            missing += DECADE / 2.0
            why.append(_("rough on fragile product"))
        elif fragile:
            good.append(_("gentle on the product"))
        missing += log(sqrt(d["energy_low"] * d["energy_high"]) / 3e6) / 2.0  # cheap heat wins between equals
        rows.append((exp(-missing / DECADE), d, good, why))
    rows.sort(key=lambda row: -row[0])
    best = max(rows[0][0], 1.0)
    scores, dryers, good, bad = zip(*rows, strict=True)
    words: Any = (
        tuple(map(_, (d["name"] for d in dryers))),
        tuple(_size(water, d) for d in dryers),
        *(tuple(map("; ".join, w)) for w in (good, bad)),
    )
    energies = np.array([sqrt(d["energy_low"] * d["energy_high"]) for d in dryers])
    return Dryers(words[0], np.array(scores) / best, words[1], energies, *words[2:])


def _span(d: dict[str, Any], name: str, factor: float) -> dict[str, str]:
    return {end: format_number(d[f"{name}_{end}"] * factor, 3) for end in ("low", "high")}


def _hazard(hazard: str, d: dict[str, Any]) -> str:
    """What speaks against a dryer when the product is dangerous; empty when nothing does."""
    if hazard == "dust" and d["dusty"]:
        return _("suspends dust that may explode: inert gas or venting needed")
    if hazard == "solvent" and not d["closed"]:
        return _("much gas through it: closed loop of inert gas needed for solvent")
    if hazard == "toxic" and not d["closed"]:
        return _("much exhaust to clean of a toxic product")
    return ""


def _size(water: float, d: dict[str, Any]) -> str:
    """Volume or heated area from the common capacity, or the number of machines."""
    low, high = water / d["capacity_high"], water / d["capacity_low"]
    if d["capacity_per"] == "whole":
        return _("machines: {count}").format(count=format_number(max(1.0, np.ceil(low)), 3))
    unit = {"m3": "m³", "m2": "m²"}[d["capacity_per"]]
    return _("{low} to {high} {unit}").format(
        low=format_number(low, 2), high=format_number(high, 2), unit=unit
    )


class WaterRemoval(NamedTuple):
    """Ways to take the water, with what each takes and spends, per hour of production or per batch."""

    way: Annotated[str, Series("ways")]
    mass_water: Annotated[Mass, Series("ways")]
    energy_per_water: Annotated[SpecificEnergy, Series("ways")]
    speaks_for: Annotated[str, Series("ways")]
    speaks_against: Annotated[str, Series("ways")]


@procedure(source="houdon2017; mujumdar2014, ch. 1; perry2008, § 12", title="Press, absorb or evaporate")
def water_removal_choice(
    dry_solid_mass: Mass,
    moisture_dry_basis_inlet: MoistureDryBasis,
    moisture_dry_basis_outlet: MoistureDryBasis,
    moisture_dry_basis_pressed: MoistureDryBasis = 1.5,
    energy_per_water: SpecificEnergy = 4.5e6,
    desiccant: Literal[
        "calcium chloride",
        "magnesium sulfate",
        "sodium sulfate",
        "calcium sulfate",
        "silica gel",
        "molecular sieve",
    ] = "calcium chloride",
) -> WaterRemoval:
    """Mechanical dewatering first, then heat, weighed against heat alone and against a desiccant that has to
    be regenerated.

    Pressing, spinning and draining take free water only, at 2 to 35 kWh per tonne (the course notes, U
    V.8.5), down to ``moisture_dry_basis_pressed``: 1.5 kg/kg (60 % of the wet mass) unless a test says
    better. ``energy_per_water`` is that of the heat dryer. A desiccant takes its load of water and must be
    regenerated: that costs the water's evaporation again, its binding and the losses of its own dryer, here
    the heat dryer's.

    >>> ways = water_removal_choice(1000.0, 4.0, 0.1)
    >>> [round(float(x), 1) for x in ways.mass_water]
    [2500.0, 1400.0, 3900.0, 3900.0]
    """
    X1, X2 = moisture_dry_basis_inlet, moisture_dry_basis_outlet
    if X2 >= X1:
        raise InputError(
            _("The product is to leave at {outlet} kg/kg, not drier than it comes ({inlet} kg/kg).").format(
                outlet=format_number(X2, 4), inlet=format_number(X1, 4)
            ),
            name="moisture_dry_basis_outlet",
        )
    squeezed = min(max(moisture_dry_basis_pressed, X2), X1)
    pressed, heated = dry_solid_mass * (X1 - squeezed), dry_solid_mass * (squeezed - X2)
    whole = pressed + heated
    mechanical = 3.6e6 * sqrt(2.0 * 35.0) / 1000.0  # J/kg, geometric mean of 2 and 35 kWh/t
    agent = next(d for d in dataset("drying", "desiccants") if d["name"] == desiccant)
    mass = whole / agent["water_per_desiccant"]
    together = (pressed * mechanical + heated * energy_per_water) / whole
    names: Any = (
        _("pressing or spinning"),
        _("heat after pressing"),
        _("heat alone"),
        _("desiccant: {name}").format(name=_(desiccant)),
    )
    good: Any = (
        _("2 to 35 kWh per tonne of water"),
        _("both together {value} kJ per kg of water").format(value=format_number(together / 1e3, 3)),
        _("one machine for all of the water"),
        _("no heat at the product"),
    )
    bad: Any = (
        _("free water only: {share} % of the water").format(share=format_number(100 * pressed / whole, 3)),
        _("two machines"),
        _("all water evaporated"),
        _(
            "needs {mass} kg, regenerated at {temperature} °C; only down to a water activity of {activity}"
        ).format(
            mass=format_number(mass, 3),
            temperature=format_number(agent["regeneration"] - ZERO_CELSIUS, 3),
            activity=format_number(agent["least_activity"], 2),
        ),
    )
    energies = np.array([mechanical, energy_per_water, energy_per_water, energy_per_water])
    return WaterRemoval(names, np.array([pressed, heated, whole, whole]), energies, good, bad)
