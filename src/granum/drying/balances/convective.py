"""Balance of a convective dryer with heater, recirculation, fan, leak and losses, from any consistent set of
knowns.
"""

from __future__ import annotations

from functools import cache
from typing import Any, Literal, NamedTuple

import jax.numpy as jnp
import numpy as np

import granum.humid_gas.relations as rel
from granum.core import flags, formula
from granum.core.constants import STANDARD_ATMOSPHERE, ZERO_CELSIUS
from granum.core.errors import InputError
from granum.core.i18n import _
from granum.core.kinds import (
    Fraction,
    HeatCapacity,
    HumidityRatio,
    MassFlow,
    MoistureDryBasis,
    Number,
    Power,
    Pressure,
    Ratio,
    RelativeHumidity,
    SpecificEnergy,
    SpecificMoistureExtraction,
    Temperature,
    VolumeFlow,
    WaterActivity,
)
from granum.drying.balances.indices import latent_heat
from granum.drying.balances.system import Relation, System, Values, linear
from granum.humid_gas.pairs import AirWater
from granum.numerics import find_root, safe_divide

PAIR = AirWater()
COLDEST, WARMEST, HOTTEST = 223.15, 673.15, 1400.0
HIGHEST_PRESSURE = 2e7  # Pa, below the critical point of water
WETTEST = 50.0  # kg/kg, nearly pure steam
POINTS = ("fresh", "inlet", "outlet")


def enthalpy(T: Any, w: Any, P: Any) -> Any:
    """Enthalpy of unsaturated air, J per kg of dry air; continued smoothly beyond saturation, which the
    results report.
    """
    y = PAIR.fraction(w)
    return PAIR.molar_enthalpy(T, P, y) / ((1.0 - y) * PAIR.gas_molar_mass)


def humidity_at(T: Any, phi: Any, P: Any) -> Any:
    """Humidity ratio from temperature and relative humidity."""
    return PAIR.humidity_ratio(jnp.minimum(phi * rel.saturated_fraction(PAIR, T, P), 1.0 - 1e-9))


def _relative(T: Any, w: Any, P: Any) -> Any:
    return PAIR.fraction(w) / rel.saturated_fraction(PAIR, T, P)


def temperature_of(P: Any, w: Any = None, phi: Any = None, h: Any = None, start: Any = None) -> Any:
    """Temperature from two of humidity ratio, relative humidity and enthalpy, sought from a start."""
    if w is not None and h is not None:
        return find_root(lambda T: enthalpy(T, w, P) - h, COLDEST, HOTTEST, tolerance=1e-12).value
    if h is None:
        return find_root(
            lambda T: jnp.log(phi * rel.saturated_fraction(PAIR, T, P) / PAIR.fraction(w)),
            COLDEST,
            HOTTEST,
            tolerance=1e-12,
        ).value
    # unsaturated air may be hotter than boiling water: up to where its vapor alone would have the whole
    # pressure
    top = PAIR.boiling_temperature(jnp.minimum(P / jnp.maximum(phi, 1e-6), HIGHEST_PRESSURE)) * (1.0 - 1e-9)
    return find_root(
        lambda T: enthalpy(T, humidity_at(T, phi, P), P) - h, COLDEST, top, start=start, tolerance=1e-12
    ).value


def _point(name: str) -> Relation:
    """State of the air at one place: any two of temperature, humidity ratio, relative humidity and enthalpy
    give the others.
    """
    T, w, phi, h = (
        f"{word}_{name}" for word in ("temperature", "humidity_ratio", "relative_humidity", "enthalpy")
    )

    def solve(v: Values, unknown: tuple[str, ...]) -> Values:
        P = v["pressure"]
        known = {n: v[n] for n in (T, w, phi, h) if n not in unknown}
        at = known.get(T)
        if at is None:
            at = temperature_of(P, known.get(w), known.get(phi), known.get(h))
        if w in known:
            humid = known[w]
        elif phi in known:
            humid = humidity_at(at, known[phi], P)
        else:  # enthalpy per dry air is linear in the humidity ratio of an ideal mixture
            dry = enthalpy(at, 0.0, P)
            humid = (known[h] - dry) / (enthalpy(at, 1.0, P) - dry)
        whole = {T: at, w: humid, phi: _relative(at, humid, P), h: enthalpy(at, humid, P)}
        return {n: whole[n] for n in unknown}

    return Relation((T, w, phi, h), 2, solve)


def _sensible(v: Values, end: str) -> Any:
    """Enthalpy of the product, J per kg of dry solid, above the liquid and the solid at 0 °C."""
    theta = v[f"temperature_product_{end}"]
    water = PAIR.condensate_molar_enthalpy(theta, v["pressure"], False) / PAIR.vapor_molar_mass
    return v["specific_heat_capacity_solid"] * (theta - ZERO_CELSIUS) + v[f"moisture_dry_basis_{end}"] * water


def _relations(real: bool) -> tuple[Relation, ...]:
    S, X1, X2, W = (
        "dry_solid_flow",
        "moisture_dry_basis_inlet",
        "moisture_dry_basis_outlet",
        "evaporation_rate",
    )
    G, r, leak = "dry_gas_flow", "recirculated_fraction", "leak_fraction"
    w0, w1, w2 = (f"humidity_ratio_{p}" for p in POINTS)
    h0, h1, h2 = (f"enthalpy_{p}" for p in POINTS)
    Q, inside, loss, fan = "heat_duty", "heat_duty_inside", "heat_loss", "shaft_power"

    def heat(v: Values) -> Any:
        total = v[G] * (v[h1] + v[leak] * v[h0] - (1.0 + v[leak]) * v[h2]) + v[inside] - v[loss]
        return total + v[S] * (_sensible(v, "inlet") - _sensible(v, "outlet")) if real else total

    solids = (S, X1, X2) if real else ()
    return (
        linear((W, S, X1, X2), lambda v: v[S] * (v[X1] - v[X2]) - v[W]),
        linear(("mass_flow_inlet", S, X1), lambda v: v[S] * (1.0 + v[X1]) - v["mass_flow_inlet"]),
        linear(("mass_flow_outlet", S, X2), lambda v: v[S] * (1.0 + v[X2]) - v["mass_flow_outlet"]),
        linear(
            ("mass_flow_inlet", "mass_flow_outlet", W),
            lambda v: v["mass_flow_inlet"] - v["mass_flow_outlet"] - v[W],
            extra=True,
        ),
        _point("fresh"),
        linear((w0, w1, w2, r), lambda v: (1.0 - v[r]) * v[w0] + v[r] * v[w2] - v[w1]),
        _point("inlet"),
        linear((W, G, r, leak, w0, w2), lambda v: v[G] * (1.0 - v[r] + v[leak]) * (v[w2] - v[w0]) - v[W]),
        _point("outlet"),
        linear(
            (Q, fan, G, r, h0, h1, h2),
            lambda v: v[G] * (v[h1] - (1.0 - v[r]) * v[h0] - v[r] * v[h2]) - v[Q] - v[fan],
        ),
        linear((G, leak, h0, h1, h2, inside, loss, *solids), heat),
        linear(
            ("dry_gas_flow_fresh", G, r, leak),
            lambda v: v[G] * (1.0 - v[r] + v[leak]) - v["dry_gas_flow_fresh"],
        ),
    )


def _bracket(name: str, v: Values) -> tuple[Any, Any, bool]:
    """Ends between which a guessed quantity lies, and whether the balance of heat is monotone in it."""
    P = v["pressure"]
    hot = "temperature_inlet" in v and "heat_duty" not in v
    if name == "temperature_outlet" and "relative_humidity_outlet" in v:
        return COLDEST, PAIR.boiling_temperature(P) * (1.0 - 1e-9), hot
    # from below zero, so that the end never falls on perfectly dry fresh air
    if name == "humidity_ratio_outlet":
        return (-1e-4, WETTEST, True) if hot and "temperature_outlet" in v else (-1e-4, 1.0, False)
    if name.startswith("temperature"):
        return COLDEST, WARMEST, False
    if name.startswith("humidity_ratio"):
        return 1e-6, 0.1 if name.endswith("fresh") else 1.0, False
    ends = {
        "recirculated_fraction": (0.0, 1.0 - 1e-9),
        "moisture_dry_basis_outlet": (0.0, 20.0),
        "leak_fraction": (0.0, 1.0),
    }
    return *ends.get(name, (1e-6, 1e3)), False


def _weight(v: Values) -> Any:
    """The gas flow that carries a given water off grows without limit as the outlet approaches the fresh
    air.
    """
    return v["humidity_ratio_outlet"] - v["humidity_ratio_fresh"]


GUESSES = (
    "temperature_outlet",
    "humidity_ratio_outlet",
    "temperature_inlet",
    "humidity_ratio_fresh",
    "temperature_fresh",
    "dry_gas_flow",
    "recirculated_fraction",
    "moisture_dry_basis_outlet",
    "dry_solid_flow",
    "leak_fraction",
)
FREE = ("heat_loss", "recirculated_fraction", "heat_duty_inside", "leak_fraction", "shaft_power")


@cache
def system(real: bool) -> System:
    """The equations of a dryer; ``real`` counts the enthalpy of the product, the other is the isenthalpic
    dryer of the course notes.
    """

    return System(_relations(real), GUESSES, _bracket, ("dry_gas_flow", _weight), FREE)


def _finished(v: Values, activity: Any) -> DryerBalance:
    """Indices, and what makes a solution impossible."""
    P, h1 = v["pressure"], v["enthalpy_inlet"]
    y1 = PAIR.fraction(v["humidity_ratio_inlet"])
    molar = PAIR.molar_enthalpy(v["temperature_inlet"], P, y1)
    top = jnp.minimum(v["temperature_inlet"], PAIR.boiling_temperature(P)) * (1.0 + 1e-9)
    wet = find_root(
        lambda T: rel.wet_bulb_balance(PAIR, T, molar, P, y1, False, None), COLDEST, top, start=top - 20.0
    ).value
    equilibrium = humidity_at(temperature_of(P, phi=activity, h=h1, start=wet), activity, P)
    W, w0 = v["evaporation_rate"], v["humidity_ratio_fresh"]
    bought = v["heat_duty"] + v["heat_duty_inside"] + v["shaft_power"]
    energy = bought / W
    volume = PAIR.molar_volume(v["temperature_inlet"], P, y1) / ((1.0 - y1) * PAIR.gas_molar_mass)
    values = {
        **v,
        "volume_flow": v["dry_gas_flow"] * volume,
        "wet_bulb_temperature": wet,
        "heat_duty_minimum": W * latent_heat(wet),
        "humidity_ratio_equilibrium": equilibrium,
        "mass_efficiency": (v["humidity_ratio_outlet"] - w0) / (equilibrium - w0),
        "evaporative_capacity": v["dry_gas_flow"] * (equilibrium - w0),
        "energy_per_water": energy,
        "energy_consumption_ratio": energy / latent_heat(wet),
        "drying_efficiency": safe_divide(latent_heat(wet), energy),
        "moisture_extraction_rate": safe_divide(1.0, energy),
    }
    possible = jnp.asarray(True)
    for name, low, high in _LIMITS:
        x = values[name]
        inside = (x >= low - 1e-9) & (x <= high + 1e-9)
        flags.impossible(~inside, x, name, low, high)
        possible = possible & inside
    return DryerBalance(*(jnp.where(possible, values[name], jnp.nan) for name in DryerBalance._fields))


def _without_heater(found: DryerBalance) -> DryerBalance:
    """The balance of the dryer alone: where its air comes from, and what it costs to heat it, was not
    said.
    """
    none = jnp.full_like(found.evaporation_rate, jnp.nan)
    flags.limit_active(jnp.isfinite(found.evaporation_rate), none, "heat_duty", NO_FRESH, without=_HEATER)
    return found._replace(**dict.fromkeys(_HEATER, none))


NO_FRESH = (
    "The state of the fresh air is missing: heat duty, energy per water and thermal efficiency have no value. Give its temperature and humidity, "  # noqa: E501
    "or 'heat_duty' as zero when the air comes hot."
)
_HEATER = (
    "temperature_fresh",
    "relative_humidity_fresh",
    "enthalpy_fresh",
    "heat_duty",
    "energy_per_water",
    "energy_consumption_ratio",
    "drying_efficiency",
    "moisture_extraction_rate",
)
# kg/s: without evaporation there is no dryer, and knowns that say the same thing twice end there
LEAST_WATER = 1e-8
# The first that fails tells why: a dryer that wets, air that must leave beyond saturation, air too cold to
# carry the water, and so on.
_LIMITS = (
    ("evaporation_rate", LEAST_WATER, np.inf),
    ("relative_humidity_outlet", 0.0, 1.0),
    ("relative_humidity_inlet", 0.0, 1.0),
    ("relative_humidity_fresh", 0.0, 1.0),
    ("dry_gas_flow", 0.0, np.inf),
    ("moisture_dry_basis_outlet", 0.0, np.inf),
    ("recirculated_fraction", 0.0, 1.0),
    ("leak_fraction", 0.0, np.inf),
    ("heat_duty", 0.0, np.inf),
)


class DryerBalance(NamedTuple):
    """Every flow, state and duty of a dryer, and its energy indices."""

    evaporation_rate: MassFlow
    dry_solid_flow: MassFlow
    mass_flow_inlet: MassFlow
    mass_flow_outlet: MassFlow
    moisture_dry_basis_inlet: MoistureDryBasis
    moisture_dry_basis_outlet: MoistureDryBasis
    dry_gas_flow: MassFlow
    dry_gas_flow_fresh: MassFlow
    volume_flow: VolumeFlow
    temperature_fresh: Temperature
    relative_humidity_fresh: Number
    humidity_ratio_fresh: HumidityRatio
    enthalpy_fresh: SpecificEnergy
    temperature_inlet: Temperature
    relative_humidity_inlet: Number
    humidity_ratio_inlet: HumidityRatio
    enthalpy_inlet: SpecificEnergy
    temperature_outlet: Temperature
    relative_humidity_outlet: Number
    humidity_ratio_outlet: HumidityRatio
    enthalpy_outlet: SpecificEnergy
    recirculated_fraction: Number
    leak_fraction: Number
    heat_duty: Power
    heat_duty_inside: Power
    heat_loss: Power
    shaft_power: Power
    wet_bulb_temperature: Temperature
    heat_duty_minimum: Power
    humidity_ratio_equilibrium: HumidityRatio
    mass_efficiency: Ratio
    evaporative_capacity: MassFlow
    energy_per_water: SpecificEnergy
    energy_consumption_ratio: Ratio
    drying_efficiency: Ratio
    moisture_extraction_rate: SpecificMoistureExtraction


_TYPICAL = {
    "mass_flow_inlet": (0.02, 0.05), "moisture_dry_basis_inlet": (0.4, 0.6), "moisture_dry_basis_outlet": (0.1, 0.2),  # noqa: E501
    "temperature_fresh": (285.0, 300.0), "relative_humidity_fresh": (0.4, 0.6), "temperature_inlet": (330.0, 380.0),  # noqa: E501
    "relative_humidity_outlet": (0.6, 0.95), "pressure": (9e4, 1.1e5), "specific_heat_capacity_solid": (1200.0, 1600.0),  # noqa: E501
    "water_activity": (0.95, 1.0),
}  # fmt: skip


@formula(
    source="keey1978; mujumdar2014; bonazzi2003; wagner2002; iapws2011melting",
    fitted={"temperature_fresh": (213.0, 623.2), "temperature_outlet": (213.0, 623.2)},
    equation=r"\dot m_e = \dot m_s(X_1 - X_2) = G(1 - r + \lambda)(w_2 - w_0),\quad \dot Q + P = G\,[h_1 - (1-r)h_0 - r h_2],\quad "  # noqa: E501
    r"G\,[h_1 + \lambda h_0 - (1+\lambda) h_2] + \dot m_s(h_{s1} - h_{s2}) + \dot Q_i - \dot Q_l = 0",
    typical=_TYPICAL,
    title="Balance of a dryer",
)
def dryer_balance(
    dry_solid_flow: MassFlow | None = None,
    mass_flow_inlet: MassFlow | None = None,
    mass_flow_outlet: MassFlow | None = None,
    moisture_dry_basis_inlet: MoistureDryBasis | None = None,
    moisture_dry_basis_outlet: MoistureDryBasis | None = None,
    evaporation_rate: MassFlow | None = None,
    dry_gas_flow: MassFlow | None = None,
    dry_gas_flow_fresh: MassFlow | None = None,
    temperature_fresh: Temperature | None = None,
    relative_humidity_fresh: RelativeHumidity | None = None,
    humidity_ratio_fresh: HumidityRatio | None = None,
    enthalpy_fresh: SpecificEnergy | None = None,
    temperature_inlet: Temperature | None = None,
    relative_humidity_inlet: RelativeHumidity | None = None,
    humidity_ratio_inlet: HumidityRatio | None = None,
    enthalpy_inlet: SpecificEnergy | None = None,
    temperature_outlet: Temperature | None = None,
    relative_humidity_outlet: RelativeHumidity | None = None,
    humidity_ratio_outlet: HumidityRatio | None = None,
    enthalpy_outlet: SpecificEnergy | None = None,
    recirculated_fraction: Fraction | None = None,
    leak_fraction: Fraction | None = None,
    heat_duty: Power | None = None,
    heat_duty_inside: Power | None = None,
    heat_loss: Power | None = None,
    shaft_power: Power | None = None,
    temperature_product_inlet: Temperature | None = None,
    temperature_product_outlet: Temperature | None = None,
    specific_heat_capacity_solid: HeatCapacity = 1400.0,
    water_activity: WaterActivity = 1.0,
    pressure: Pressure = STANDARD_ATMOSPHERE,
    quantity_sought: Literal[
        "none", "heat_loss", "recirculated_fraction", "leak_fraction", "heat_duty_inside", "shaft_power"
    ] = "none",
) -> DryerBalance:
    """Solids, moisture, air and heat of a dryer with its heater, from any consistent set of knowns; a wrong
    set is named.

    Fresh air (``fresh``), mixed with the recirculated share of the outlet air, passes fan and heater and
    enters the dryer (``inlet``); it leaves at ``outlet``. Ambient air that leaks into the dryer is
    ``leak_fraction`` of the dry air through the heater; both count in ``dry_gas_flow_fresh``. Recirculation,
    leak, fan power, heat given inside the dryer and heat loss are zero unless given or named in
    ``quantity_sought``. Without temperatures of the product the dryer is isenthalpic as in the course notes:
    the product's enthalpy is left out. With both of them it is a real dryer.

    When nothing is said of fresh air and heater, the air is followed from where it enters the dryer; what the
    heater takes, and the indices of energy that count it, then have no value. Give ``heat_duty`` as zero when
    the air does come hot.

    ``water_activity`` is that of the leaving product, with which the air could at best be in equilibrium; it
    only serves the mass efficiency. The energy indices count heater, fan and heat given inside. Saturated
    outlet air, air too cold for the water, or a negative flow: flagged.

    Fresh and outlet air lie within the temperatures of the air–water properties behind it, 213 to 623.2 K.

    The notes' maize (D III.4): 100 kg from 0.54 to 0.18 kg/kg with air at 25 °C and 50 % heated to 50 °C.
    They print 23.3 kg of water, 56.7 MJ, 20.1 g/kg and 2 284 kg of dry air, read from a chart.

    >>> maize = dryer_balance(
    ...     mass_flow_inlet="100 kg/hour",
    ...     moisture_dry_basis_inlet=0.54,
    ...     moisture_dry_basis_outlet=0.18,
    ...     temperature_fresh="25 degC",
    ...     relative_humidity_fresh="50 %",
    ...     temperature_inlet="50 degC",
    ...     relative_humidity_outlet="100 %",
    ... )
    >>> (
    ...     round(maize.evaporation_rate * 3600, 1),
    ...     round(maize.heat_duty_minimum * 3.6e-3, 1),
    ...     round(maize.humidity_ratio_outlet * 1e3, 1),
    ... )
    (23.4, 56.9, 20.0)
    """
    given = {
        name: jnp.asarray(value, dtype=float)
        for name, value in locals().items()
        if value is not None and name != "quantity_sought"
    }
    activity = given.pop("water_activity")
    constants = {name: given.pop(name) for name in ("pressure", "specific_heat_capacity_solid")}
    temperatures = [
        name for name in ("temperature_product_inlet", "temperature_product_outlet") if name in given
    ]
    constants |= {name: given.pop(name) for name in temperatures}
    if len(temperatures) == 1:
        raise InputError(
            _("Give the product's temperature at both ends, or at neither for an isenthalpic dryer."),
            given=temperatures,
        )
    bought = any(name.endswith("_fresh") for name in given) or "heat_duty" in given
    if not bought:
        given["heat_duty"] = jnp.zeros(())  # the air comes hot
    equations = system(bool(temperatures))
    if quantity_sought in given:
        raise InputError(
            _("'{name}' is given; it cannot be sought.").format(name=quantity_sought), name=quantity_sought
        )
    whole = equations.completed(frozenset(given), quantity_sought)
    values = {name: given.get(name, jnp.zeros(())) for name in whole}
    found = _finished(equations.solve(values, constants), activity)
    return found if bought else _without_heater(found)
