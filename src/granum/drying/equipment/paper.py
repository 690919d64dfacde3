"""Paper machine: a web over many steam-heated cylinders, with fabrics on them and free draws between."""

from __future__ import annotations

from typing import Annotated, Any, ClassVar, NamedTuple

import equinox as eqx
import jax
import jax.numpy as jnp

from granum.core import equipment
from granum.core.errors import InputError
from granum.core.flags import unsolved
from granum.core.i18n import _
from granum.core.kinds import (
    Area,
    Fraction,
    HeatTransferCoefficient,
    HumidityRatio,
    Law,
    Length,
    MassFlow,
    MassFlux,
    MassPerArea,
    MoistureDryBasis,
    Power,
    Pressure,
    Ratio,
    SpecificEnergy,
    Speed,
    Temperature,
    ThermalConductivity,
    Time,
    Within,
)
from granum.core.limits import Limit
from granum.core.units import format_number
from granum.core.utilities import Utility
from granum.drying.formulas.heat import heat_transfer_coefficient_series
from granum.drying.formulas.paper import (
    evaporation_per_area_tappi,
    heat_transfer_coefficient_paper,
    shaft_power_cylinders,
)
from granum.drying.gas_solid.dryer import ready
from granum.drying.isotherms.paper import Heikkila
from granum.drying.web_path import Air, Phase, in_its_own_vapor, no_contact, web_of
from granum.drying.wet_surface import boiled, evaporated
from granum.materials.formulas.steam import water_heat_of_vaporization
from granum.materials.formulas.water import water_boiling_temperature
from granum.numerics import find_root, safe_divide
from granum.settling.kinds import LineLoad
from granum.streams.atmosphere import FLAMMABLE, flammable
from granum.streams.equilibrium import HumidMixture
from granum.streams.stream import Stream
from granum.streams.units import Limits, Unit, Utilities
from granum.streams.utilities import AREA, FANNED, HEAT_APPROACH, HEATED, driven, ducted, heated

ON_CYLINDER, IN_DRAW = 6, 4  # steps of the march
SLOWEST, FASTEST = 0.05, 60.0  # m/s, between which a width is sought
_UNSOLVED = "No humidity of the hood was found at which web and air agree: give more air, or drier."


class PaperDried(NamedTuple):
    """Dried paper, exhaust of the hood, and the heat of cylinders and hood air, net of losses."""

    product: Stream
    exhaust: Stream
    heat_duty: Any


class PaperFigures(NamedTuple):
    """Figures of a paper machine's dryer section."""

    moisture_dry_basis: MoistureDryBasis
    temperature_product: Temperature
    temperature_highest: Temperature
    web_speed: Speed
    residence_time: Time
    evaporation_rate: MassFlow
    evaporation_per_area: MassFlux
    draw_share: Fraction
    area: Area
    humidity_ratio: HumidityRatio
    relative_humidity: Ratio
    heat_duty_cylinders: Power
    heat_duty_heater: Power
    mass_flow_steam: MassFlow
    steam_use: Ratio
    energy_per_water: SpecificEnergy
    shaft_power: Power


class CylinderPassage(NamedTuple):
    """The web at the end of each cylinder with its draw, and what it gave and took on the way."""

    moisture: Any
    temperature: Any
    heat: Any  # from the cylinders, J per m² of web, in all
    highest: Any
    drawn: Any  # water evaporated in the free draws, kg per kg of dry web


@equipment(
    "paper_machine",
    source="karlsson2000; wilhelmsson1995; tappi0404",
    title="Paper machine (many cylinders)",
)
class PaperMachine(Unit):
    """A web runs over many steam-heated cylinders, pressed on by fabrics, and through free draws; a hood
    takes its vapor away with air.

    The web is thin: it has one moisture and one temperature through its thickness. On a cylinder it takes
    heat through condensate, shell and contact, and gives vapor through the fabric on its other side; in a
    free draw both sides meet the air. The pockets are as humid as the hood's exhaust and have its
    temperature, ``temperature_air``, to which the fresh air (``gas``) is heated. Vapor is not taken back. The
    speed follows from the flow of dry fibers, grammage and width. Steam gets evenly hotter from
    ``pressure_steam_first`` (where it is not given, the same as the last) to ``pressure_steam``.
    ``heat_loss_share`` is of the heat of steam. ``running_load`` is the pull per width that turns one
    cylinder and its felt rolls; the default is worked back from one section of six cylinders of 1.83 m, much
    condensate or high tension takes more. Limits recalled, not opened.
    """

    width: Length
    dry_mass_per_area: MassPerArea
    pressure_steam: Pressure
    cylinder_count: Annotated[int, Within(1, 200)] = 40
    diameter: Length = 1.5
    pressure_steam_first: Pressure | None = None
    temperature_air: Temperature = 358.15
    wrapped_fraction: Fraction = 0.62
    draw_length: Length = 1.0
    felt_factor: Fraction = 0.5
    heat_transfer_coefficient_condensate: HeatTransferCoefficient = 1500.0
    wall_thickness: Length = 0.025
    thermal_conductivity: ThermalConductivity = 45.0
    heat_transfer_coefficient_dry: HeatTransferCoefficient = 350.0
    heat_transfer_coefficient_air: HeatTransferCoefficient = 30.0
    isotherm: Annotated[Any, Law("isotherm")] = Heikkila()
    heat_loss_share: Fraction = 0.05
    running_load: LineLoad = 270.0

    limits: ClassVar[Limits] = {
        "capacity": Limit("water evaporated per area", 10.0, 35.0, "kg/(m^2*hour)", "tappi0404"),
        "ratio": Limit("steam per water evaporated", 1.1, 1.7, "dimensionless", "karlsson2000"),
        "speed": Limit("speed of the web", 0.5, 33.0, "m/s", "karlsson2000"),
        "humid": Limit("relative humidity of the exhaust", 0.0, 0.9, "dimensionless", "karlsson2000"),
    } | FLAMMABLE

    utilities: ClassVar[Utilities] = HEATED | AREA | FANNED | {"electric_power_drive": Utility("eaton1997")}

    @classmethod
    def size(
        cls, moisture_outlet: Any, feed: Stream, gas: Stream, dry_mass_per_area: Any, **more: Any
    ) -> PaperMachine:
        """The width at which a number of cylinders reaches a moisture: a wider machine runs slower."""

        machine = cls(width=jnp.asarray(1.0), dry_mass_per_area=dry_mass_per_area, **more)
        wanted = jnp.asarray(moisture_outlet, dtype=float)
        driest, wettest, width = (float(x) for x in _width(machine, feed, gas, wanted))
        if not driest < float(wanted) < wettest:
            raise InputError(
                _(
                    "These cylinders dry to a moisture between {low} and {high} kg/kg at speeds from {slow} "
                    "to {fast} m/s, not to {value}."
                ).format(
                    low=format_number(driest, 3),
                    high=format_number(wettest, 3),
                    slow=format_number(SLOWEST, 3),
                    fast=format_number(FASTEST, 3),
                    value=format_number(float(wanted), 3),
                ),
                name="moisture_outlet",
            )
        return cls(width=width, dry_mass_per_area=dry_mass_per_area, **more)

    def inside(self, feed: Stream, gas: Stream) -> dict[str, Any]:
        """The passage of the web in the air that it makes itself."""
        found = _solved(self, feed, gas)
        unsolved(found["converged"], type(self).card, reason=_UNSOLVED)
        return found

    def outlets(self, inside: dict[str, Any], feed: Stream, gas: Stream) -> PaperDried:
        product, vapor = boiled(feed, inside["X2"], inside["T2"], self.temperature_air, gas.pressure)
        exhaust = vapor.replace(gas=vapor.gas + gas.gas)
        duty = product.enthalpy_flow + exhaust.enthalpy_flow - feed.enthalpy_flow - gas.enthalpy_flow
        return PaperDried(product, exhaust, duty)

    def figures(self, inside: dict[str, Any], outlets: PaperDried, feed: Stream, gas: Stream) -> PaperFigures:
        s, humid = inside, HumidMixture(gas.mixture)
        water = evaporated(feed, outlets.product)
        cylinders = s["passage"].heat * s["area_rate"]
        kept = 1.0 - self.heat_loss_share
        steam = outlets.heat_duty / kept / water_heat_of_vaporization(s["steam"])
        return PaperFigures(
            moisture_dry_basis=s["X2"],
            temperature_product=s["T2"],
            temperature_highest=s["passage"].highest,
            web_speed=s["speed"],
            residence_time=s["time"],
            evaporation_rate=water,
            evaporation_per_area=evaporation_per_area_tappi(
                water, self.diameter, float(self.cylinder_count), self.width
            ),
            draw_share=jnp.clip(safe_divide(s["passage"].drawn * feed.solid_flow, water), 0.0, 1.0),
            area=jnp.pi * self.diameter * self.cylinder_count * self.width + 0.0 * water,
            humidity_ratio=humid.humidity_ratio(outlets.exhaust),
            relative_humidity=humid.relative_humidity(outlets.exhaust),
            heat_duty_cylinders=cylinders,
            heat_duty_heater=outlets.heat_duty - cylinders,
            mass_flow_steam=jnp.maximum(steam, 0.0),
            steam_use=jnp.maximum(safe_divide(steam, water), 0.0),
            energy_per_water=safe_divide(outlets.heat_duty / kept, water),
            shaft_power=shaft_power_cylinders(
                float(self.cylinder_count), self.running_load, self.width, s["speed"]
            ),
        )

    def measured(
        self, inside: dict[str, Any], outlets: PaperDried, figures: PaperFigures, feed: Stream, gas: Stream
    ) -> dict[str, Any]:
        return {
            "capacity": figures.evaporation_per_area * 3600.0,
            "ratio": figures.steam_use,
            "speed": figures.web_speed,
            "humid": figures.relative_humidity,
        } | flammable(outlets.exhaust)

    def drawn(
        self, inside: dict[str, Any], outlets: PaperDried, figures: PaperFigures, feed: Stream, gas: Stream
    ) -> dict[str, Any]:
        duty = outlets.heat_duty / (1.0 - self.heat_loss_share)
        return heated(duty, inside["steam"] - HEAT_APPROACH) | {
            "electric_power_fan": ducted(outlets.exhaust),
            "electric_power_drive": driven(figures.shaft_power),
            "area_installed": figures.area,
        }


@ready
def _solved(machine: PaperMachine, feed: Stream, gas: Stream) -> dict[str, Any]:
    """The humidity of the hood that the web itself makes, and the passage of the web in it."""
    humid = HumidMixture(gas.mixture)
    web = web_of(feed, machine.dry_mass_per_area, machine.isotherm, humid)
    area_rate = feed.solid_flow / web.dry_mass  # m² of web per second
    speed = area_rate / machine.width
    still = jnp.where(speed > 0, speed, 1.0)
    around = jnp.pi * machine.diameter * machine.wrapped_fraction
    X1 = safe_divide(feed.liquid[0], feed.solid_flow)
    last = water_boiling_temperature(machine.pressure_steam)
    first = (
        last
        if machine.pressure_steam_first is None
        else water_boiling_temperature(machine.pressure_steam_first)
    )
    steam = first + (last - first) * jnp.linspace(0.0, 1.0, machine.cylinder_count)
    h = jnp.asarray(machine.heat_transfer_coefficient_air, dtype=float)

    def contact(X: Any) -> Any:
        paper = heat_transfer_coefficient_paper.function(X, machine.heat_transfer_coefficient_dry)
        return heat_transfer_coefficient_series.function(
            machine.heat_transfer_coefficient_condensate,
            machine.wall_thickness,
            machine.thermal_conductivity,
            paper,
        )

    felt = machine.felt_factor * h

    def passage(share: Any) -> tuple[Any, CylinderPassage]:
        """The web when this share of its water has gone to the hood."""
        vapor = gas.gas.at[humid.vapor].add(share * feed.liquid[0])
        hood = gas.replace(gas=vapor, temperature=machine.temperature_air)
        air = Air.of(hood, humid)

        def cylinder(carry: tuple[Any, ...], hot: Any) -> tuple[tuple[Any, ...], tuple[Any, Any]]:
            X, T, q, top, drawn = carry
            on = Phase(hot, contact, felt, felt)
            X, T, heat, most = web.along((X, T), around / still, on, air, ON_CYLINDER)
            free = Phase(hot, no_contact, 2.0 * h, 2.0 * h)
            X2, T, _none, more = web.along((X, T), machine.draw_length / still, free, air, IN_DRAW)
            top = jnp.maximum(top, jnp.maximum(most, more))
            return (X2, T, q + heat, top, drawn + X - X2), (X2, T)

        start = (
            X1,
            jnp.asarray(feed.temperature, dtype=float),
            jnp.zeros(()),
            feed.temperature,
            jnp.zeros(()),
        )
        start = tuple(jnp.asarray(v, dtype=float) for v in start)
        (_X, _T, q, top, drawn), (X, T) = jax.lax.scan(cylinder, start, steam)
        return X[-1], CylinderPassage(X, T, q, top, drawn)

    X2, made, converged = in_its_own_vapor(X1, passage)
    return {
        "passage": made,
        "X2": X2,
        "T2": made.temperature[-1],
        "speed": speed,
        "time": machine.cylinder_count * (around + machine.draw_length) / still,
        "area_rate": area_rate,
        "steam": last,
        "converged": converged,
    }


@ready
def _width(machine: PaperMachine, feed: Stream, gas: Stream, wanted: Any) -> tuple[Any, Any, Any]:
    """Moistures at the slowest and the fastest speed, and the width that brings the one wanted."""

    def reached(width: Any) -> Any:
        return _solved(eqx.tree_at(lambda m: m.width, machine, width), feed, gas)["X2"]

    flow = feed.solid_flow / machine.dry_mass_per_area
    widest, narrowest = flow / SLOWEST, flow / FASTEST
    driest, wettest = jax.lax.map(reached, jnp.stack([widest, narrowest]))
    root = find_root(lambda b: jnp.log(reached(jnp.exp(b)) / wanted), jnp.log(narrowest), jnp.log(widest))
    return driest, wettest, jnp.exp(root.value)
