"""Webs that dry on the fly: stenter and air-borne web under jets of hot air, and webs under infrared or in a
high-frequency field.
"""

from __future__ import annotations

import math
from abc import abstractmethod
from typing import TYPE_CHECKING, Annotated, Any, ClassVar, Literal, NamedTuple

import equinox as eqx
import jax
import jax.numpy as jnp

from granum.core import equipment
from granum.core.cards import Card
from granum.core.errors import InputError
from granum.core.flags import unsolved
from granum.core.i18n import _
from granum.core.kinds import (
    Fraction,
    HeatTransferCoefficient,
    HumidityRatio,
    Law,
    Length,
    MassFlow,
    MassFlux,
    MassPerArea,
    MoistureDryBasis,
    PositiveNumber,
    Power,
    Ratio,
    SpecificEnergy,
    Speed,
    Temperature,
    Time,
)
from granum.core.limits import Limit
from granum.core.units import format_number
from granum.core.utilities import Utility
from granum.drying.formulas.heat import nusselt_number_impinging
from granum.drying.formulas.impingement import nusselt_number_impinging_slots
from granum.drying.gas_solid.dryer import ready
from granum.drying.gas_solid.steam import is_steam
from granum.drying.isotherms.paper import Heikkila
from granum.drying.web_path import Air, Phase, in_its_own_vapor, no_contact, web_of
from granum.drying.wet_surface import boiled, evaporated
from granum.numerics import find_root, safe_divide
from granum.streams.atmosphere import FLAMMABLE, flammable
from granum.streams.equilibrium import COLDEST, HOTTEST, HumidMixture
from granum.streams.stream import Stream
from granum.streams.units import Limits, Unit, Utilities
from granum.streams.utilities import AREA, FANNED, HEATED, ducted, fanned, heated

STEPS = 100
SHORTEST, LONGEST = 0.05, 2000.0  # m, between which a length is sought
NOZZLE_HEADS = 2.0
HEADS = "martin1977, the speed only: two velocity heads of the jets are our own estimate"
_TOO_FAST = "The web heats up too fast to be followed: give weaker radiation, a heavier web or a shorter way."
_BURNT = (
    "The web is dry and heats on beyond the critical temperature of its liquid, where none of this holds: "
    "give weaker radiation, a shorter way or a higher speed."
)
_UNSOLVED = "No humidity of the oven was found at which web and air agree: give more air, or drier."


class WebDried(NamedTuple):
    """Dried web, exhaust, and the heat of heater and radiation, net of losses."""

    product: Stream
    exhaust: Stream
    heat_duty: Any


class WebFigures(NamedTuple):
    """Figures of a dryer for webs."""

    moisture_dry_basis: MoistureDryBasis
    temperature_product: Temperature
    temperature_highest: Temperature
    web_speed: Speed
    residence_time: Time
    evaporation_rate: MassFlow
    evaporation_per_area: MassFlux
    heat_transfer_coefficient: HeatTransferCoefficient
    humidity_ratio: HumidityRatio
    relative_humidity: Ratio
    heat_duty_heater: Power
    heat_duty_radiant: Power
    energy_per_water: SpecificEnergy


class AbstractWebOven(Unit):
    """A thin web on its way through gas of one temperature, which is as humid as the exhaust."""

    if TYPE_CHECKING:  # parameters of every such oven, in an order of its own
        width: Any
        length: Any
        dry_mass_per_area: Any
        temperature_air: Any
        sides: Any
        radiant_heat: Any
        isotherm: Any
        heat_loss_share: Any
        temperature_limit: Any

    @abstractmethod
    def coefficient(self, gas: Stream) -> Any:
        """Heat transfer from the gas to each side of the web, W/(m² K)."""

    @abstractmethod
    def circulated(self, gas: Stream) -> Any:
        """Electric power that moves gas about in the oven, W."""

    @classmethod
    def size(cls, moisture_outlet: Any, feed: Stream, gas: Stream, **more: Any) -> Any:
        """The length in which a web reaches a moisture."""
        oven = cls(length=jnp.asarray(1.0), **more)
        wanted = jnp.asarray(moisture_outlet, dtype=float)
        driest, wettest, length = (float(x) for x in _length(oven, feed, gas, wanted))
        if not driest < float(wanted) < wettest:
            raise InputError(
                _(
                    "This oven dries to a moisture between {low} and {high} kg/kg over lengths from {short} "
                    "to {long} m, not to {value}."
                ).format(
                    low=format_number(driest, 3),
                    high=format_number(wettest, 3),
                    short=format_number(SHORTEST, 3),
                    long=format_number(LONGEST, 3),
                    value=format_number(float(wanted), 3),
                ),
                name="moisture_outlet",
            )
        return cls(length=length, **more)

    def inside(self, feed: Stream, gas: Stream) -> dict[str, Any]:
        """The way of the web in the air that it makes itself."""
        found = _solved(self, feed, gas)
        followed = jnp.isfinite(found["highest"]) & (found["T2"] > COLDEST) & (found["highest"] < HOTTEST)
        # past it there is no heat of vaporization, and the steps run away
        critical = HumidMixture(gas.mixture).fluid.critical_temperature
        burnt = found["highest"] > (critical if math.isfinite(critical) else HOTTEST)
        card: Card = type(self).card  # pyright: ignore[reportAttributeAccessIssue]
        unsolved(~burnt, card, reason=_BURNT)
        unsolved(followed | burnt, card, reason=_TOO_FAST)
        unsolved(found["converged"] | ~followed | burnt, card, reason=_UNSOLVED)
        return found

    def outlets(self, inside: dict[str, Any], feed: Stream, gas: Stream) -> WebDried:
        product, vapor = boiled(feed, inside["X2"], inside["T2"], self.temperature_air, gas.pressure)
        exhaust = vapor.replace(gas=vapor.gas + gas.gas)
        duty = product.enthalpy_flow + exhaust.enthalpy_flow - feed.enthalpy_flow - gas.enthalpy_flow
        return WebDried(product, exhaust, duty)

    def figures(self, inside: dict[str, Any], outlets: WebDried, feed: Stream, gas: Stream) -> WebFigures:
        s, humid = inside, HumidMixture(gas.mixture)
        water = evaporated(feed, outlets.product)
        heater = (outlets.heat_duty - s["radiant"]) / (1.0 - self.heat_loss_share)
        electric = s["radiant"] / self._efficiency
        return WebFigures(
            moisture_dry_basis=s["X2"],
            temperature_product=s["T2"],
            temperature_highest=s["highest"],
            web_speed=s["speed"],
            residence_time=s["time"],
            evaporation_rate=water,
            evaporation_per_area=water / (self.width * self.length),
            heat_transfer_coefficient=s["h"],
            humidity_ratio=humid.humidity_ratio(outlets.exhaust),
            relative_humidity=humid.relative_humidity(outlets.exhaust),
            heat_duty_heater=outlets.heat_duty - s["radiant"],
            heat_duty_radiant=s["radiant"],
            energy_per_water=safe_divide(jnp.maximum(heater, 0.0) + electric, water),
        )

    @property
    def _efficiency(self) -> Any:
        return 1.0 if self.radiant_heat is None else self.radiant_heat.electric_efficiency

    def measured(
        self, inside: dict[str, Any], outlets: WebDried, figures: WebFigures, feed: Stream, gas: Stream
    ) -> dict[str, Any]:
        found = {
            "capacity": figures.evaporation_per_area * 3600.0,
            "time": figures.residence_time,
            "air": self.temperature_air - 273.15,
            "humid": figures.relative_humidity,
            "given": figures.heat_duty_heater,
        } | flammable(outlets.exhaust)
        if self.temperature_limit is None:
            return found | {"scorched": figures.temperature_highest - 273.15}
        return found | {"hot": figures.temperature_highest - self.temperature_limit}

    def drawn(
        self, inside: dict[str, Any], outlets: WebDried, figures: WebFigures, feed: Stream, gas: Stream
    ) -> dict[str, Any]:
        heater = figures.heat_duty_heater / (1.0 - self.heat_loss_share)
        return heated(heater, self.temperature_air) | {
            "heat_input_electricity": jnp.maximum(figures.heat_duty_radiant, 0.0) / self._efficiency,
            "electric_power_fan": ducted(outlets.exhaust) + self.circulated(outlets.exhaust),
            "area_installed": self.width * self.length + 0.0 * heater,
        }


# of wool, the first of the webs to ignite: 205 °C, newsprint 230, cotton 230 to 266 (recalled)
SCORCHED, FIRES = 200.0, "cote2008"
_LIMITS: Limits = {
    "humid": Limit("relative humidity of the exhaust", 0.0, 0.9, "dimensionless", "mujumdar2014, ch. 1"),
    "given": Limit("heat that the heater of the air has to give", 0.0, math.inf, "W", "keey1978"),
    "hot": Limit("product temperature over its limit", -math.inf, 0.0, "delta_degC", "bonazzi2003"),
    "scorched": Limit(
        "highest temperature of a web without its own limit", -math.inf, SCORCHED, "degC", FIRES
    ),
} | FLAMMABLE
_UTILITIES: Utilities = HEATED | AREA | FANNED | {"heat_input_electricity": Utility("metaxas1983; keey1978")}


@equipment(
    "impingement_dryer",
    source="martin1977; houdon2017",
    title="Stenter or air-borne web dryer (impinging jets)",
)
class ImpingementDryer(AbstractWebOven):
    """A thin web (textile, paper, film) runs through jets of hot air that blow on it from both sides.

    The web has one moisture and one temperature through its thickness. The jets come from an array of slots,
    or of round nozzles, of ``diameter`` (slot width or bore) at ``nozzle_distance`` from the web; they are as
    humid as the exhaust, and the exhaust leaves as hot as they are. ``radiant_heat`` adds infrared or a
    high-frequency field. Vapor is not taken back. The speed follows from the flow of dry solid, grammage and
    width. A web without a ``temperature_limit`` is held to 200 °C, below where wool and paper catch fire.
    width. ``heat_loss_share`` is of the heat of the air's heater; the fan drives fresh air and jets. Whether
    fresh air is wasted shows in the vapor per dry air, best between 0.1 and 0.15: of air of 150 °C that is 3
    to 4 % of relative humidity.
    """

    width: Length
    length: Length
    dry_mass_per_area: MassPerArea
    temperature_air: Temperature
    gas_velocity: Speed
    diameter: Length = 0.005
    nozzle_distance: Length = 0.05
    nozzle_area_fraction: Fraction = 0.05
    nozzle_shape: Literal["slots", "round"] = "slots"
    sides: PositiveNumber = 2.0
    radiant_heat: Annotated[Any, Law("radiant_heat")] = None
    isotherm: Annotated[Any, Law("isotherm")] = Heikkila()
    heat_loss_share: Fraction = 0.1
    temperature_limit: Temperature | None = None

    limits: ClassVar[Limits] = {
        "capacity": Limit("water evaporated per area", 6.0, 120.0, "kg/(m^2*hour)", "houdon2017; martin1977"),
        "time": Limit("residence time", 0.1, 120.0, "s", "houdon2017"),
        "air": Limit("temperature of the air", 50.0, 350.0, "degC", "houdon2017"),
        "jets": Limit("velocity of the jets", 5.0, 80.0, "m/s", "martin1977"),
        "vapor": Limit(
            "water vapor per dry air in the exhaust", 0.05, 0.15, "kg/kg", "bref2003, § 4.8.1", quiet=True
        ),
    } | _LIMITS

    utilities: ClassVar[Utilities] = _UTILITIES | {"electric_power_fan": Utility(HEADS)}

    def coefficient(self, gas: Stream) -> Any:
        slots = self.nozzle_shape == "slots"
        D = 2.0 * self.diameter if slots else self.diameter
        viscosity, conductivity = gas.gas_viscosity, gas.gas_conductivity
        reynolds = self.gas_velocity * D * gas.gas_density / viscosity
        prandtl = viscosity * gas.gas_heat_capacity / conductivity
        law = nusselt_number_impinging_slots if slots else nusselt_number_impinging
        return law(reynolds, prandtl, self.nozzle_area_fraction, self.nozzle_distance / D) * conductivity / D

    def circulated(self, gas: Stream) -> Any:
        flow = self.gas_velocity * self.nozzle_area_fraction * self.sides * self.width * self.length
        return fanned(flow, NOZZLE_HEADS * 0.5 * gas.gas_density * self.gas_velocity**2)

    def measured(
        self, inside: dict[str, Any], outlets: WebDried, figures: WebFigures, feed: Stream, gas: Stream
    ) -> dict[str, Any]:
        found = AbstractWebOven.measured(self, inside, outlets, figures, feed, gas)
        if feed.mixture.liquids[0].name == "water":
            found["vapor"] = jnp.where(is_steam(gas), 0.0, figures.humidity_ratio)
        return found | {"jets": self.gas_velocity}


@equipment(
    "radiant_dryer",
    source="keey1978; metaxas1983; houdon2017",
    title="Infrared or high-frequency dryer",
)
class RadiantDryer(AbstractWebOven):
    """A web or thin layer on a conveyor takes infrared, radio waves or microwaves; air carries its vapor
    away.

    It has one moisture and one temperature through its thickness. ``radiant_heat`` is what gives the heat,
    with what it takes from the mains. The air along the layer has one temperature, ``temperature_air``, to
    which fresh air (``gas``) is heated, and the humidity of the exhaust; it cools the layer or heats it by
    the heat transfer coefficient on ``sides``. Vapor is not taken back. The speed follows from the flow of
    dry solid, its mass per area and the width. ``heat_loss_share`` is of the heat of the air's heater. A web
    without a ``temperature_limit`` is held to 200 °C, below where wool and paper catch fire.
    """

    width: Length
    length: Length
    dry_mass_per_area: MassPerArea
    radiant_heat: Annotated[Any, Law("radiant_heat")]
    temperature_air: Temperature = 333.15
    heat_transfer_coefficient: HeatTransferCoefficient = 25.0
    sides: PositiveNumber = 1.0
    isotherm: Annotated[Any, Law("isotherm")] = Heikkila()
    heat_loss_share: Fraction = 0.1
    temperature_limit: Temperature | None = None

    limits: ClassVar[Limits] = {
        "capacity": Limit("water evaporated per area", 1.0, 150.0, "kg/(m^2*hour)", "mujumdar2014, ch. 1"),
        "time": Limit("residence time", 0.1, 3600.0, "s", "mujumdar2014, ch. 1"),
        "air": Limit("temperature of the air", 10.0, 350.0, "degC", "houdon2017"),
    } | _LIMITS

    utilities: ClassVar[Utilities] = _UTILITIES

    def coefficient(self, gas: Stream) -> Any:
        return jnp.asarray(self.heat_transfer_coefficient, dtype=float)

    def circulated(self, gas: Stream) -> Any:
        return jnp.zeros(())


@ready
def _solved(oven: AbstractWebOven, feed: Stream, gas: Stream) -> dict[str, Any]:
    """The humidity that the web itself makes, and its way in it."""
    humid = HumidMixture(gas.mixture)
    web = web_of(feed, oven.dry_mass_per_area, oven.isotherm, humid)
    speed = feed.solid_flow / web.dry_mass / oven.width
    time = oven.length / jnp.where(speed > 0, speed, 1.0)
    X1 = safe_divide(feed.liquid[0], feed.solid_flow)
    start = (X1, jnp.asarray(feed.temperature, dtype=float))
    absorbed = None if oven.radiant_heat is None else oven.radiant_heat.absorbed

    def way(share: Any) -> tuple[Any, Any]:
        vapor = gas.gas.at[humid.vapor].add(share * feed.liquid[0])
        around = gas.replace(gas=vapor, temperature=oven.temperature_air)
        h = oven.coefficient(around)
        phase = Phase(oven.temperature_air, no_contact, oven.sides * h, oven.sides * h, absorbed)
        X, T, heat, highest = web.along(start, time, phase, Air.of(around, humid), STEPS)
        return X, (T, heat, highest, h)

    X2, (T2, heat, highest, h), converged = in_its_own_vapor(X1, way)
    return {
        "X2": X2,
        "T2": T2,
        "highest": highest,
        "h": h,
        "speed": speed,
        "time": time,
        "radiant": heat * feed.solid_flow / web.dry_mass,
        "converged": converged,
    }


@ready
def _length(oven: AbstractWebOven, feed: Stream, gas: Stream, wanted: Any) -> tuple[Any, Any, Any]:
    """Moistures after the longest and the shortest way, and the length that brings the one wanted."""

    def reached(length: Any) -> Any:
        return _solved(eqx.tree_at(lambda o: o.length, oven, length), feed, gas)["X2"]

    driest, wettest = jax.lax.map(reached, jnp.stack([LONGEST, SHORTEST]))
    root = find_root(
        lambda b: jnp.log(reached(jnp.exp(b)) / wanted), math.log(SHORTEST), math.log(LONGEST), start=2.0
    )
    return driest, wettest, jnp.exp(root.value)
