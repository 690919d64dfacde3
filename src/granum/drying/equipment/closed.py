"""A dryer in a closed circuit, by balance: gas dried on a cold coil, with a heat pump or without, or
superheated vapor whose excess may be compressed.
"""

from __future__ import annotations

import math
from abc import abstractmethod
from typing import Annotated, Any, ClassVar, NamedTuple

import equinox as eqx
import jax.numpy as jnp

from granum.core import equipment, law
from granum.core.errors import ApplicabilityError
from granum.core.flags import unsolved
from granum.core.i18n import _
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
)
from granum.core.limits import Limit
from granum.core.utilities import Utility
from granum.drying.balances.savings import vapor_recompression
from granum.drying.kinds import LostHeat
from granum.drying.wet_surface import AS_SPECIFIED, boiled, dried_share, evaporated, leaving
from granum.humid_gas.relations import saturated_fraction
from granum.materials.formulas.steam import steam_enthalpy
from granum.numerics import find_root, safe_divide
from granum.streams.equilibrium import COLDEST, HumidMixture
from granum.streams.stream import Stream
from granum.streams.units import Limits, Unit, Utilities
from granum.streams.utilities import COOLED, FANNED, HEATED, cooled, driven, heated

_UNSOLVED = (
    "No temperature of the outlet air was found between coil and hot air at which heat and evaporation "
    "agree: take hotter air, a colder coil, a wetter feed or a smaller heat loss."
)


class Duty(NamedTuple):
    """What the circuit has to do: water to remove, streams and heat that the gas must pay for,
    temperatures.
    """

    water: Any
    feed: Stream
    temperature_inlet: Any
    moisture: Any
    temperature_product: Any
    heat_loss: Any
    fan_power: Any

    def parted(self, T: Any, product: Any) -> tuple[Stream, Stream, Any]:
        """Product, what evaporates (with gas that came in the feed) at the gas temperature T, and the heat
        the gas gives for both.
        """
        own = product if self.temperature_product is None else self.temperature_product
        left, vapor = boiled(self.feed, self.moisture, own, T, self.feed.pressure)
        return (
            left,
            vapor,
            left.enthalpy_flow + vapor.enthalpy_flow - self.feed.enthalpy_flow + self.heat_loss,
        )


class Circuit(NamedTuple):
    """What a circuit comes to: streams out, heat bought, power of the compressor, circulating gas (dry air or
    steam).
    """

    product: Stream
    vapor: Stream
    condensate: Stream
    heater: Any
    power: Any
    circulating: Any
    temperature_outlet: Any
    margins: tuple[tuple[str, Any], ...]  # what must not be negative, K or kg/kg
    converged: Any = True
    cooling: Any = 0.0  # that somebody else takes from the coil


class AbstractCircuit(eqx.Module):
    """How the gas of a closed dryer is dried and heated again."""

    @abstractmethod
    def run(self, duty: Duty) -> Circuit:
        """The circuit for a duty."""


class Coiled(NamedTuple):
    """Gas around a dryer and over a cold coil: its streams, heat taken by the coil and given to heat the gas
    again, flow of dry gas.
    """

    product: Stream
    stray: Stream
    condensate: Stream
    taken: Any
    given: Any
    dry_gas: Any
    temperature_outlet: Any
    margin: Any
    converged: Any


class AbstractCoilCircuit(AbstractCircuit):
    """Gas that leaves the dryer with a relative humidity and sheds its vapor on a cold coil, which part of it
    passes by.
    """

    relative_humidity_outlet: eqx.AbstractVar[Any]
    coil_temperature: eqx.AbstractVar[Any]
    coil_bypass_fraction: eqx.AbstractVar[Any]

    def around(self, duty: Duty) -> Coiled:
        """Once through dryer, coil and heater."""
        P, m, bypass = duty.feed.pressure, duty.feed.mixture, self.coil_bypass_fraction
        humid = HumidMixture(m)
        carrier = m.index("gases", str(humid.carrier))

        def h(T: Any, w: Any) -> Any:
            each = m.enthalpies("gases", T)
            return each[carrier] + w * each[humid.vapor]

        def saturated(T: Any, relative: Any = 1.0) -> Any:
            return humid.pair.humidity_ratio(relative * saturated_fraction(humid.pair, T, P))

        coil = saturated(self.coil_temperature)

        def humidities(T: Any) -> tuple[Any, Any]:
            w2 = saturated(T, self.relative_humidity_outlet)
            return bypass * w2 + (1.0 - bypass) * coil, w2

        def surplus(T: Any) -> Any:
            """Heat of the gas less what vapor, product and losses take, for each kilogram of dry gas and of
            liquid.
            """
            w1, w2 = humidities(T)
            _product, _vapor, need = duty.parted(T, T)
            # the vapor is in the gas here, and in ``need`` too
            carried = duty.water * m.enthalpies("gases", T)[humid.vapor]
            return (
                h(duty.temperature_inlet, w1)
                - h(T, w2)
                - (w2 - w1) * (need - carried) / jnp.maximum(duty.water, 1e-300)
            )

        top = jnp.minimum(duty.temperature_inlet, humid.boiling_temperature(P) * (1.0 - 1e-9))
        outlet = find_root(surplus, jnp.maximum(self.coil_temperature, COLDEST), top, tolerance=1e-14)
        T2 = outlet.value
        w1, w2 = humidities(T2)
        product, vapor, _need = duty.parted(T2, T2)
        flow = duty.water / (w2 - w1)
        liquid = jnp.zeros_like(duty.feed.liquid).at[0].set(duty.water)
        condensate = duty.feed.part().replace(
            liquid=liquid, temperature=jnp.asarray(self.coil_temperature, dtype=float)
        )
        cold = bypass * h(T2, w2) + (1.0 - bypass) * h(self.coil_temperature, coil)
        taken = flow * (h(T2, w2) - cold) - condensate.enthalpy_flow
        given = flow * (h(duty.temperature_inlet, w1) - cold) - duty.fan_power
        stray = vapor.replace(gas=duty.feed.gas)
        return Coiled(product, stray, condensate, taken, given, flow, T2, w2 - coil, outlet.converged)


@law(
    "drying_circuit",
    name="circuit_heat_pump",
    source="mujumdar2014; keey1978",
    title="Closed circuit of gas with a heat pump",
    equation=(
        r"\mathrm{COP} = \eta_C\frac{T + \Delta T}{T - T_b + 2\,\Delta T},\quad "
        r"P = \frac{\dot Q_e}{\mathrm{COP} - 1},\quad "
        r"\dot Q_e = \dot m_g\,(h(T_2, \varphi_2) - h_e) - \dot m_c h_c"
    ),
)
class HeatPumpCircuit(AbstractCoilCircuit):
    """Gas leaves the dryer with a relative humidity, sheds its vapor on the evaporator (part of it passes by)
    and is heated on the condenser.

    Evaporation and condensation lie a temperature approach beyond coil and hot gas. Surplus heat of the
    condenser is rejected: a negative heat duty.

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
        hot, cold = (
            temperature_inlet + self.temperature_approach,
            self.coil_temperature - self.temperature_approach,
        )
        return self.carnot_efficiency * hot / (hot - cold)

    def run(self, duty: Duty) -> Circuit:
        c = self.around(duty)
        power = c.taken / (self(duty.temperature_inlet) - 1.0)
        heater = c.given - c.taken - power
        margins = (("coil", c.margin),)
        return Circuit(
            c.product,
            c.stray,
            c.condensate,
            heater,
            power,
            c.dry_gas,
            c.temperature_outlet,
            margins,
            c.converged,
        )


@law(
    "drying_circuit",
    name="circuit_condenser",
    source="mujumdar2014; keey1978",
    title="Closed circuit of gas with a condenser",
    equation=(
        r"\dot Q_e = \dot m_g\,(h_2 - h_e) - \dot m_c h_c,\quad h_2 = h(T_2, \varphi_2),\ "
        r"h_e = b\,h_2 + (1 - b)\,h(T_b, 1)"
    ),
    symbols={"coil_bypass_fraction": "b"},
)
class CondenserCircuit(AbstractCoilCircuit):
    """Gas leaves the dryer with a relative humidity, sheds its vapor on a coil cooled from outside (part of
    it passes by) and is heated from outside.

    The usual circuit of nitrogen that dries a product wet with solvent. Called, it gives the least work to
    cool the coil, per heat taken from it: a Carnot machine that rejects the heat at a temperature.

    By hand: 40 K between a coil at 263.15 K and 303.15 K outside.

    >>> round(float(CondenserCircuit("80 %", "-10 degC")(303.15)), 3)
    0.152
    """

    relative_humidity_outlet: RelativeHumidity
    coil_temperature: Temperature
    coil_bypass_fraction: Fraction = 0.1

    def __call__(self, temperature: Temperature) -> Number:
        """Work over heat."""
        return jnp.maximum(temperature / self.coil_temperature - 1.0, 0.0)

    def run(self, duty: Duty) -> Circuit:
        c = self.around(duty)
        margins = (("coil", c.margin),)
        return Circuit(
            c.product,
            c.stray,
            c.condensate,
            c.given,
            jnp.zeros(()),
            c.dry_gas,
            c.temperature_outlet,
            margins,
            c.converged,
            c.taken,
        )


@law(
    "drying_circuit",
    name="circuit_steam",
    source="mujumdar2014; iapwsif97",
    fitted={"pressure_condensing": (611.213, 16.529e6)},
    title="Closed circuit of superheated vapor",
    equation=r"M = \frac{\dot Q}{h_v(T_1) - h_v(T_2)},\quad P = \dot m_e\,w(p, p_c)\,\frac{T_2}{T_b}",
    symbols={"temperature_outlet": "T_2"},
)
class SteamCircuit(AbstractCircuit):
    """Superheated steam (or vapor of another solvent) at the pressure of the feed; what evaporates leaves as
    steam, or is compressed and condenses to heat the circuit.

    With ``pressure_condensing`` the excess steam is compressed to it (work of saturated steam times the ratio
    of temperatures) and gives its heat to the circulating steam; its condensate leaves boiling. The product
    leaves at the boiling temperature unless its temperature is given.

    Compression from 1 atm to 2 bar with 75 %: 167 kJ/kg, the order of the course notes (160 to 200).

    Pressures as in ``vapor_recompression``.

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
        return vapor_recompression.function(
            pressure, self.pressure_condensing, self.compressor_efficiency
        ).energy_per_water

    def run(self, duty: Duty) -> Circuit:
        humid = HumidMixture(duty.feed.mixture, alone=True)
        boiling, T2 = (
            humid.boiling_temperature(duty.feed.pressure),
            jnp.asarray(self.temperature_outlet, dtype=float),
        )
        product, vapor, need = duty.parted(T2, boiling)
        P, T1 = duty.feed.pressure, jnp.asarray(duty.temperature_inlet, dtype=float)
        # real steam, whose heat capacity near boiling is above that of the streams' ideal gas
        if humid.solvent == "water":
            given = steam_enthalpy.function(T1, P) - steam_enthalpy.function(T2, P)
        else:
            vapor_of = duty.feed.mixture.gases[humid.vapor]
            given = vapor_of.enthalpy(T1) - vapor_of.enthalpy(T2)
        steam = need / given
        heater, nothing = need - duty.fan_power, duty.feed.part()
        margins: tuple[tuple[str, Any], ...] = (("dry", T2 - boiling),)
        if self.pressure_condensing is None:
            return Circuit(product, vapor, nothing, heater, 0.0 * need, steam, T2, margins)
        if humid.solvent != "water":
            raise ApplicabilityError(
                _(
                    "Compressed vapor is known for water only, not for {liquid}: leave "
                    "'pressure_condensing' out."
                ).format(liquid=humid.solvent),
                name="pressure_condensing",
            )
        power = duty.water * self(duty.feed.pressure) * T2 / boiling
        condensing = humid.boiling_temperature(self.pressure_condensing)
        liquid = jnp.zeros_like(duty.feed.liquid).at[0].set(duty.water)
        condensate = nothing.replace(
            liquid=liquid, temperature=condensing, pressure=jnp.asarray(self.pressure_condensing, dtype=float)
        )
        stray = vapor.replace(gas=duty.feed.gas)
        given = vapor.enthalpy_flow - stray.enthalpy_flow + power - condensate.enthalpy_flow
        margins = (*margins, ("warm", condensing - duty.temperature_inlet))
        return Circuit(product, stray, condensate, heater - given, power, steam, T2, margins)


class ClosedOutlets(NamedTuple):
    """Dried product, vapor that leaves the circuit, condensate; heat of the heater net of losses (negative:
    rejected), compressor and fan.
    """

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
    heat_duty_condenser: Power
    shaft_power: Power
    energy_per_water: SpecificEnergy
    moisture_extraction_rate: SpecificMoistureExtraction


@equipment("closed_dryer", source="mujumdar2014; bonazzi2003", title="Dryer in a closed circuit (balance)")
class ClosedDryer(Unit):
    """Dries a feed to a moisture in a gas that circulates: say what becomes of the gas (``drying_circuit``)
    and how hot it enters.

    Energy counts heater, compressor and fan; heat given back by a surplus of the condenser is not credited,
    and the machine that cools the coil of a circuit with a condenser is not counted.
    """

    drying_circuit: Annotated[Any, Law("drying_circuit")]
    temperature_inlet: Temperature
    moisture_outlet: MoistureDryBasis
    temperature_product: Temperature | None = None
    heat_loss: LostHeat = 0.0
    fan_power: Power = 0.0
    temperature_limit: Temperature | None = None

    limits: ClassVar[Limits] = {
        "coil": Limit(
            "humidity of the outlet air above saturation at the coil",
            0.0,
            1e9,
            "dimensionless",
            "mujumdar2014",
        ),
        "dry": Limit(
            "outlet temperature of the steam above boiling", 0.0, 1e9, "dimensionless", "mujumdar2014"
        ),
        "warm": Limit(
            "temperature at which heat is given off above that of the heated gas",
            0.0,
            1e9,
            "dimensionless",
            "mujumdar2014",
        ),
        "moisture": AS_SPECIFIED["moisture"],
        "hot": Limit("product temperature over its limit", -math.inf, 0.0, "delta_degC", "bonazzi2003"),
    }

    utilities: ClassVar[Utilities] = (
        HEATED | COOLED | FANNED | {"electric_power_compressor": Utility("mujumdar2014")}
    )

    def inside(self, feed: Stream) -> Circuit:
        water = leaving(feed, dried_share(feed, self.moisture_outlet))
        found = self.drying_circuit.run(
            Duty(
                water,
                feed,
                self.temperature_inlet,
                self.moisture_outlet,
                self.temperature_product,
                self.heat_loss,
                self.fan_power,
            )
        )
        unsolved(found.converged, type(self).card, reason=_UNSOLVED)
        return found

    def outlets(self, inside: Circuit, feed: Stream) -> ClosedOutlets:
        c = inside
        return ClosedOutlets(
            c.product, c.vapor, c.condensate, c.heater - c.cooling - self.heat_loss, c.power + self.fan_power
        )

    def figures(self, inside: Circuit, outlets: ClosedOutlets, feed: Stream) -> ClosedFigures:
        c = inside
        water = evaporated(feed, c.product)
        bought = jnp.maximum(c.heater, 0.0) + outlets.shaft_power
        return ClosedFigures(
            evaporation_rate=water,
            moisture_dry_basis=c.product.moisture_dry_basis,
            temperature_outlet=c.temperature_outlet,
            temperature_product=c.product.temperature,
            mass_flow_circulating=c.circulating,
            heat_duty_heater=c.heater,
            heat_duty_condenser=jnp.asarray(-c.cooling),
            shaft_power=outlets.shaft_power,
            energy_per_water=safe_divide(bought, water),
            moisture_extraction_rate=safe_divide(water, bought),
        )

    def measured(
        self, inside: Circuit, outlets: ClosedOutlets, figures: ClosedFigures, feed: Stream
    ) -> dict[str, Any]:
        found = dict(inside.margins) | {"moisture": figures.moisture_dry_basis - self.moisture_outlet}
        if self.temperature_limit is not None:
            found["hot"] = figures.temperature_product - self.temperature_limit
        return found

    def drawn(
        self, inside: Circuit, outlets: ClosedOutlets, figures: ClosedFigures, feed: Stream
    ) -> dict[str, Any]:
        spare = jnp.minimum(inside.heater, 0.0)
        cold = getattr(self.drying_circuit, "coil_temperature", self.temperature_inlet)
        taken = cooled(-jnp.asarray(inside.cooling), cold)
        rejected = cooled(spare, self.temperature_inlet)
        return (
            heated(inside.heater, self.temperature_inlet)
            | {name: taken[name] + rejected[name] for name in taken}
            | {
                "electric_power_fan": driven(self.fan_power),
                "electric_power_compressor": driven(inside.power),
            }
        )
