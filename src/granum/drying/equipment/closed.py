"""A dryer in a closed circuit, by balance: air dried by a heat pump, or superheated steam whose excess may be compressed to heat it."""

from __future__ import annotations

import math
from abc import abstractmethod
from typing import Annotated, Any, ClassVar, NamedTuple

import equinox as eqx
import jax.numpy as jnp

from granum.core import equipment, law
from granum.core.flags import unsolved
from granum.core.kinds import (
    Fraction,
    Law,
    MassFlow,
    MoistureDryBasis,
    Number,
    OpenFraction,
    Power,
    Pressure,
    RelativeHumidity,
    SpecificEnergy,
    SpecificMoistureExtraction,
    Temperature,
    TemperatureDifference,
)  # fmt: skip
from granum.core.limits import Limit
from granum.drying.balances.convective import COLDEST, PAIR
from granum.drying.balances.savings import vapor_recompression
from granum.drying.wet_surface import boiled, require_water
from granum.humid_gas.relations import saturated_fraction
from granum.materials.formulas.steam import steam_enthalpy
from granum.materials.formulas.water import water_boiling_temperature
from granum.numerics import find_root, safe_divide
from granum.streams.stream import Stream
from granum.streams.units import Limits, Unit

_UNSOLVED = "No temperature of the outlet air was found between coil and hot air at which heat and evaporation agree: take hotter air, a colder coil, a wetter feed or a smaller heat loss."


class Duty(NamedTuple):
    """What the circuit has to do: water to remove, streams and heat that the gas must pay for, temperatures."""

    water: Any
    feed: Stream
    temperature_inlet: Any
    moisture: Any
    temperature_product: Any
    heat_loss: Any
    fan_power: Any

    def parted(self, T: Any, product: Any) -> tuple[Stream, Stream, Any]:
        """Product, what evaporates (with gas that came in the feed) at the gas temperature T, and the heat the gas gives for both."""
        own = product if self.temperature_product is None else self.temperature_product
        left, vapor = boiled(self.feed, self.moisture, own, T, self.feed.pressure)
        return left, vapor, left.enthalpy_flow + vapor.enthalpy_flow - self.feed.enthalpy_flow + self.heat_loss


class Circuit(NamedTuple):
    """What a circuit comes to: streams out, heat bought, power of the compressor, circulating gas (dry air or steam)."""

    product: Stream
    vapor: Stream
    condensate: Stream
    heater: Any
    power: Any
    circulating: Any
    temperature_outlet: Any
    margins: tuple[tuple[str, Any], ...]  # what must not be negative, K or kg/kg
    converged: Any = True


class AbstractCircuit(eqx.Module):
    """How the gas of a closed dryer is dried and heated again."""

    @abstractmethod
    def run(self, duty: Duty) -> Circuit:
        """The circuit for a duty."""


@law("drying_circuit", name="circuit_heat_pump", source="mujumdar2014; keey1978", title="Closed circuit of air with a heat pump",
     equation=r"\mathrm{COP} = \eta_C\frac{T_c}{T_c - T_e},\quad P = \frac{\dot Q_e}{\mathrm{COP} - 1}")  # fmt: skip
class HeatPumpCircuit(AbstractCircuit):
    """Air leaves the dryer with a relative humidity, sheds its water on the evaporator (part of it passes by) and is heated on the condenser.

    Evaporation and condensation lie a temperature approach beyond coil and hot air. Surplus heat of the condenser is rejected: a negative heat duty.

    By hand: evaporation at 280.15 K, condensation at 328.15 K, half of Carnot's 6.836.

    >>> round(float(HeatPumpCircuit("80 %", "12 degC")(323.15)), 2)
    3.42
    """

    relative_humidity_outlet: RelativeHumidity
    coil_temperature: Temperature
    coil_bypass_fraction: Fraction = 0.1
    carnot_efficiency: OpenFraction = 0.5
    temperature_approach: TemperatureDifference = 5.0

    def __call__(self, temperature_inlet: Temperature) -> Number:
        """Coefficient of performance of heating."""
        hot, cold = temperature_inlet + self.temperature_approach, self.coil_temperature - self.temperature_approach
        return self.carnot_efficiency * hot / (hot - cold)

    def run(self, duty: Duty) -> Circuit:
        P, gases, bypass = duty.feed.pressure, duty.feed.mixture, self.coil_bypass_fraction

        def h(T: Any, w: Any) -> Any:
            each = gases.enthalpies("gases", T)
            return each[0] + w * each[1]

        coil = PAIR.humidity_ratio(saturated_fraction(PAIR, self.coil_temperature, P))

        def humidities(T: Any) -> tuple[Any, Any]:
            w2 = PAIR.humidity_ratio(self.relative_humidity_outlet * saturated_fraction(PAIR, T, P))
            return bypass * w2 + (1.0 - bypass) * coil, w2

        def surplus(T: Any) -> Any:
            """Heat of the air less what vapor, product and losses take, for each kilogram of dry air and of water."""
            w1, w2 = humidities(T)
            _product, _vapor, need = duty.parted(T, T)
            carried = duty.water * gases.enthalpies("gases", T)[1]  # the vapor is in the air here, and in ``need`` too
            return h(duty.temperature_inlet, w1) - h(T, w2) - (w2 - w1) * (need - carried) / jnp.maximum(duty.water, 1e-300)

        top = jnp.minimum(duty.temperature_inlet, PAIR.boiling_temperature(P) * (1.0 - 1e-9))
        outlet = find_root(surplus, jnp.maximum(self.coil_temperature, COLDEST), top, tolerance=1e-14)
        T2 = outlet.value
        w1, w2 = humidities(T2)
        product, vapor, _need = duty.parted(T2, T2)
        air = duty.water / (w2 - w1)
        liquid = jnp.zeros_like(duty.feed.liquid).at[0].set(duty.water)
        condensate = duty.feed.part().replace(liquid=liquid, temperature=jnp.asarray(self.coil_temperature, dtype=float))
        cold = bypass * h(T2, w2) + (1.0 - bypass) * h(self.coil_temperature, coil)
        taken = air * (h(T2, w2) - cold) - condensate.enthalpy_flow
        power = taken / (self(duty.temperature_inlet) - 1.0)
        heater = air * (h(duty.temperature_inlet, w1) - cold) - duty.fan_power - taken - power
        stray = vapor.replace(gas=duty.feed.gas)
        return Circuit(product, stray, condensate, heater, power, air, T2, (("coil", w2 - coil),), outlet.converged)


@law("drying_circuit", name="circuit_steam", source="mujumdar2014", title="Closed circuit of superheated steam",
     equation=r"M = \frac{\dot Q}{h_v(T_1) - h_v(T_2)},\quad P = \dot m_e\,w(p, p_c)\,\frac{T_2}{T_b}")  # fmt: skip
class SteamCircuit(AbstractCircuit):
    """Superheated steam at the pressure of the feed; what evaporates leaves as steam, or is compressed and condenses to heat the circuit.

    With ``pressure_condensing`` the excess steam is compressed to it (work of saturated steam times the ratio of temperatures) and gives its heat
    to the circulating steam; its condensate leaves boiling. The product leaves at the boiling temperature unless its temperature is given.

    Compression from 1 atm to 2 bar with 75 %: 167 kJ/kg, the order of the course notes (160 to 200).

    >>> round(float(SteamCircuit("110 degC", "2 bar")(101325.0)) / 1e3)
    167
    """

    temperature_outlet: Temperature
    pressure_condensing: Pressure | None = None
    compressor_efficiency: OpenFraction = 0.75

    def __call__(self, pressure: Pressure) -> SpecificEnergy:
        """Work to compress a kilogram of saturated steam; zero without compression."""
        if self.pressure_condensing is None:
            return 0.0 * pressure
        return vapor_recompression.function(pressure, self.pressure_condensing, self.compressor_efficiency).energy_per_water

    def run(self, duty: Duty) -> Circuit:
        boiling, T2 = water_boiling_temperature.function(duty.feed.pressure), jnp.asarray(self.temperature_outlet, dtype=float)
        product, vapor, need = duty.parted(T2, boiling)
        # how much circulates follows from real steam, whose heat capacity near boiling is above that of the streams' ideal gas
        P = duty.feed.pressure
        steam = need / (steam_enthalpy.function(jnp.asarray(duty.temperature_inlet, dtype=float), P) - steam_enthalpy.function(T2, P))
        heater, nothing = need - duty.fan_power, duty.feed.part()
        margins: tuple[tuple[str, Any], ...] = (("dry", T2 - boiling),)
        if self.pressure_condensing is None:
            return Circuit(product, vapor, nothing, heater, 0.0 * need, steam, T2, margins)
        power = duty.water * self(duty.feed.pressure) * T2 / boiling
        condensing = water_boiling_temperature.function(self.pressure_condensing)
        liquid = jnp.zeros_like(duty.feed.liquid).at[0].set(duty.water)
        condensate = nothing.replace(liquid=liquid, temperature=condensing, pressure=jnp.asarray(self.pressure_condensing, dtype=float))
        stray = vapor.replace(gas=duty.feed.gas)
        given = vapor.enthalpy_flow - stray.enthalpy_flow + power - condensate.enthalpy_flow
        margins = (*margins, ("warm", condensing - duty.temperature_inlet))
        return Circuit(product, stray, condensate, heater - given, power, steam, T2, margins)


class ClosedOutlets(NamedTuple):
    """Dried product, vapor that leaves the circuit, condensate; heat of the heater net of losses (negative: rejected), compressor and fan."""

    product: Stream
    vapor: Stream
    condensate: Stream
    heat_duty: Any
    shaft_power: Any


class ClosedFigures(NamedTuple):
    """Figures of a closed dryer."""

    evaporation_rate: MassFlow
    moisture_dry_basis: MoistureDryBasis
    temperature_outlet: Temperature
    temperature_product: Temperature
    mass_flow_circulating: MassFlow
    heat_duty_heater: Power
    shaft_power: Power
    energy_per_water: SpecificEnergy
    moisture_extraction_rate: SpecificMoistureExtraction


@equipment("closed_dryer", source="mujumdar2014; bonazzi2003", title="Dryer in a closed circuit (balance)")
class ClosedDryer(Unit):
    """Dries a feed to a moisture in a gas that circulates: say what becomes of the gas (``drying_circuit``) and how hot it enters.

    Energy counts heater, compressor and fan; heat given back by a surplus of the condenser is not credited.
    """

    drying_circuit: Annotated[Any, Law("drying_circuit")]
    temperature_inlet: Temperature
    moisture_outlet: MoistureDryBasis
    temperature_product: Temperature | None = None
    heat_loss: Power = 0.0
    fan_power: Power = 0.0
    temperature_limit: Temperature | None = None

    limits: ClassVar[Limits] = {
        "coil": Limit("humidity of the outlet air above saturation at the coil", 0.0, 1e9, "dimensionless", "mujumdar2014"),
        "dry": Limit("outlet temperature of the steam above boiling", 0.0, 1e9, "dimensionless", "mujumdar2014"),
        "warm": Limit("temperature at which heat is given off above that of the heated gas", 0.0, 1e9, "dimensionless", "mujumdar2014"),
        "moisture": Limit("moisture of the product against the specification", -1e-9, 1e-9, "kg/kg", "keey1978"),
        "hot": Limit("product temperature over its limit", -math.inf, 0.0, "delta_degC", "bonazzi2003"),
    }

    def inside(self, feed: Stream) -> Circuit:
        require_water(feed.mixture)
        water = jnp.maximum(feed.liquid[0] - self.moisture_outlet * feed.solid_flow, 0.0)
        found = self.drying_circuit.run(
            Duty(water, feed, self.temperature_inlet, self.moisture_outlet, self.temperature_product, self.heat_loss, self.fan_power)
        )
        unsolved(found.converged, type(self).card, reason=_UNSOLVED)
        return found

    def outlets(self, inside: Circuit, feed: Stream) -> ClosedOutlets:
        c = inside
        return ClosedOutlets(c.product, c.vapor, c.condensate, c.heater - self.heat_loss, c.power + self.fan_power)

    def figures(self, inside: Circuit, outlets: ClosedOutlets, feed: Stream) -> ClosedFigures:
        c = inside
        water = feed.liquid[0] - c.product.liquid[0]
        bought = jnp.maximum(c.heater, 0.0) + outlets.shaft_power
        return ClosedFigures(
            evaporation_rate=water,
            moisture_dry_basis=c.product.moisture_dry_basis,
            temperature_outlet=c.temperature_outlet,
            temperature_product=c.product.temperature,
            mass_flow_circulating=c.circulating,
            heat_duty_heater=c.heater,
            shaft_power=outlets.shaft_power,
            energy_per_water=safe_divide(bought, water),
            moisture_extraction_rate=safe_divide(water, bought),
        )

    def measured(self, inside: Circuit, outlets: ClosedOutlets, figures: ClosedFigures, feed: Stream) -> dict[str, Any]:
        found = dict(inside.margins) | {"moisture": figures.moisture_dry_basis - self.moisture_outlet}
        if self.temperature_limit is not None:
            found["hot"] = figures.temperature_product - self.temperature_limit
        return found
