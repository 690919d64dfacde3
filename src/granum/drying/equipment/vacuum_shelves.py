"""A vacuum shelf dryer: layers on trays that boil on heated shelves, condenser and vacuum pump."""

from __future__ import annotations

import math
from typing import Any, ClassVar, NamedTuple

import jax.numpy as jnp

from granum.core import equipment
from granum.core.constants import STANDARD_ATMOSPHERE
from granum.core.flags import unsolved
from granum.core.kinds import (
    Area,
    Density,
    HeatTransferCoefficient,
    Length,
    Mass,
    MassFlow,
    MassFlux,
    MoistureDryBasis,
    Power,
    Pressure,
    SpecificEnergy,
    Temperature,
    ThermalConductivity,
    Time,
    Volume,
)
from granum.core.limits import Limit
from granum.core.utilities import Utility
from granum.drying.formulas.contact_layers import ContactLayer, contact_layer_drying
from granum.drying.wet_surface import AS_SPECIFIED, as_specified, boiled, evaporated
from granum.numerics import safe_divide
from granum.streams.equilibrium import HumidMixture
from granum.streams.stream import Stream
from granum.streams.units import Limits, Unit, Utilities
from granum.streams.utilities import AREA, COOLED, HEATED, cooled, evacuated, heated

SHOWN = "walas1990, table 9.6"
WARMER = 1e-3  # K
COLD_SHELF = (
    "The shelves are no hotter than the moisture boils at this pressure, so that nothing dries: take hotter "
    "shelves ('temperature_shelf') or a better vacuum ('pressure_chamber')."
)


class ShelfDried(NamedTuple):
    """Dry product, what the condenser gives, and heat of shelves less that of the condenser."""

    product: Stream
    condensate: Stream
    heat_duty: Any


class ShelfFigures(NamedTuple):
    """Figures of a vacuum shelf dryer; duties are means over the cycle."""

    boiling_temperature: Temperature
    warming_time: Time
    drying_time: Time
    cycle_time: Time
    area: Area
    volume: Volume
    mass_batch: Mass
    moisture_dry_basis: MoistureDryBasis
    evaporation_rate: MassFlow
    evaporation_per_area: MassFlux
    evaporation_rate_highest: MassFlow
    temperature_product: Temperature
    temperature_bottom: Temperature
    heat_duty_shelf: Power
    heat_duty_condenser: Power
    energy_per_water: SpecificEnergy


class Boiling(NamedTuple):
    """Boiling temperature, the layer, the time to warm it, and the dry solid of a batch per area, kg/m²."""

    temperature: Any
    layer: ContactLayer
    warming: Any
    load: Any


@equipment("vacuum_shelf_dryer", source="mollekopf1984; walas1990, ch. 9", title="Vacuum shelf dryer")
class VacuumShelfDryer(Unit):
    """Trays with a resting layer stand on heated shelves under vacuum: the layer warms up, then boils behind
    a front that runs up from the tray; batches follow one another.

    The feed's flow is the mean over the cycle and fixes the shelf area. ``heat_transfer_coefficient`` is that
    from the shelf into the layer, through the tray, ``thermal_conductivity_dry`` that of the dried part: both
    are for a test to find; a paint pigment and aspirin in Walas's table of machines ask for 0.43 and
    0.80 W/(m K) where the temperature printed is that of the shelves. The vapor is condensed; the condensate
    leaves at ``temperature_condenser`` and at the pressure of the chamber. Radiation from the shelf above,
    sorption and shrinkage are left out. The vacuum pump has the displacement that evacuates the chamber in
    time, and runs as a liquid ring at the pressure of the chamber as long as the product warms and dries.
    """

    temperature_shelf: Temperature
    pressure_chamber: Pressure
    thickness: Length
    bulk_density_dry: Density
    moisture_outlet: MoistureDryBasis
    thermal_conductivity_dry: ThermalConductivity = 0.2
    heat_transfer_coefficient: HeatTransferCoefficient = 80.0
    temperature_condenser: Temperature = 283.15
    loading_time: Time = 3600.0
    shelf_pitch: Length = 0.12
    pump_down_time: Time = 900.0
    temperature_limit: Temperature | None = None

    limits: ClassVar[Limits] = {
        "capacity": Limit("water evaporated per area", 0.025, 1.5, "kg/(m^2*hour)", SHOWN),
        "layer": Limit("thickness of the layer", 10.0, 60.0, "mm", SHOWN),
        "time": Limit("drying time of a batch", 10800.0, 259200.0, "s", SHOWN),
        "condenses": Limit(
            "vapor pressure at the condenser per chamber pressure",
            0.0,
            0.9,
            "dimensionless",
            "perry2008, ch. 12",
        ),
        "hot": Limit("product temperature over its limit", -math.inf, 0.0, "delta_degC", "keey1978"),
    } | AS_SPECIFIED

    utilities: ClassVar[Utilities] = (
        HEATED
        | COOLED
        | AREA
        | {
            "electric_power_vacuum": Utility(
                "perry2008, ch. 10: that the chamber is evacuated is all it does"
            )
        }
    )

    def inside(self, feed: Stream) -> Boiling:
        humid = HumidMixture(feed.mixture, alone=True)
        boiling = humid.boiling_temperature(jnp.asarray(self.pressure_chamber))
        hot = self.temperature_shelf > boiling + WARMER
        unsolved(hot, type(self).card, reason=COLD_SHELF)
        shelf = jnp.where(hot, self.temperature_shelf, boiling + 1.0)
        X1 = safe_divide(feed.liquid[0], feed.solid_flow)
        dry = feed.replace(liquid=jnp.zeros_like(feed.liquid), gas=jnp.zeros_like(feed.gas))
        capacity = safe_divide(
            dry.enthalpy_at(boiling + 5.0) - dry.enthalpy_at(boiling - 5.0), 10.0 * feed.solid_flow
        )
        layer = contact_layer_drying.function(
            self.thickness,
            self.bulk_density_dry,
            X1,
            jnp.minimum(self.moisture_outlet, X1),
            shelf,
            boiling,
            self.heat_transfer_coefficient,
            self.thermal_conductivity_dry,
            humid.heat_of_vaporization(boiling),
            capacity,
        )
        load = self.thickness * self.bulk_density_dry
        start = jnp.minimum(feed.temperature, boiling - WARMER)
        mean = (boiling - start) / jnp.log((shelf - start) / (shelf - boiling))
        warmed = safe_divide(feed.enthalpy_at(boiling) - feed.enthalpy_at(start), feed.solid_flow) * load
        return Boiling(boiling, layer, warmed / (self.heat_transfer_coefficient * mean), load)

    def outlets(self, inside: Boiling, feed: Stream) -> ShelfDried:
        product, vapor = self.parted(inside, feed)
        gone = evaporated(feed, product)
        condensate = vapor.replace(
            liquid=jnp.zeros_like(feed.liquid).at[0].set(gone),
            gas=feed.gas,
            temperature=jnp.asarray(self.temperature_condenser, dtype=float),
        )
        return ShelfDried(
            product, condensate, product.enthalpy_flow + condensate.enthalpy_flow - feed.enthalpy_flow
        )

    def parted(self, inside: Boiling, feed: Stream) -> tuple[Stream, Stream]:
        """Product, its dry part warm from the tray up, and vapor."""
        boiling, layer = inside.temperature, inside.layer
        X1 = safe_divide(feed.liquid[0], feed.solid_flow)
        dried = jnp.clip(1.0 - safe_divide(self.moisture_outlet, X1, 1.0), 0.0, 1.0)
        return boiled(
            feed,
            self.moisture_outlet,
            boiling + 0.5 * dried * (layer.temperature_bottom - boiling),
            boiling,
            self.pressure_chamber,
        )

    def figures(self, inside: Boiling, outlets: ShelfDried, feed: Stream) -> ShelfFigures:
        product, vapor = self.parted(inside, feed)
        water = evaporated(feed, product)
        cycle = self.loading_time + inside.warming + inside.layer.drying_time
        batch = feed.solid_flow * cycle
        area = batch / inside.load
        shelf = product.enthalpy_flow + vapor.enthalpy_flow - feed.enthalpy_flow
        return ShelfFigures(
            boiling_temperature=inside.temperature,
            warming_time=inside.warming,
            drying_time=inside.layer.drying_time,
            cycle_time=cycle,
            area=area,
            volume=area * self.shelf_pitch,
            mass_batch=(feed.solid_flow + feed.liquid_flow) * cycle,
            moisture_dry_basis=safe_divide(product.liquid[0], product.solid_flow),
            evaporation_rate=water,
            evaporation_per_area=safe_divide(water * cycle, area * inside.layer.drying_time),
            evaporation_rate_highest=inside.layer.drying_flux_inlet * area,
            temperature_product=product.temperature,
            temperature_bottom=inside.layer.temperature_bottom,
            heat_duty_shelf=shelf,
            heat_duty_condenser=outlets.heat_duty - shelf,
            energy_per_water=safe_divide(shelf, water),
        )

    def measured(
        self, inside: Boiling, outlets: ShelfDried, figures: ShelfFigures, feed: Stream
    ) -> dict[str, Any]:
        vapor = HumidMixture(feed.mixture, alone=True).fluid.vapor_pressure.value(self.temperature_condenser)
        found = {
            "capacity": figures.evaporation_per_area * 3600.0,
            "layer": self.thickness * 1e3,
            "time": figures.drying_time,
            "condenses": vapor / self.pressure_chamber,
        } | as_specified(feed, self.moisture_outlet)
        if self.temperature_limit is not None:
            found["hot"] = figures.temperature_bottom - self.temperature_limit
        return found

    def drawn(
        self, inside: Boiling, outlets: ShelfDried, figures: ShelfFigures, feed: Stream
    ) -> dict[str, Any]:
        fall = jnp.log(jnp.maximum(STANDARD_ATMOSPHERE / self.pressure_chamber, 1.0))
        displaced = figures.volume / self.pump_down_time * fall
        running = safe_divide(figures.warming_time + figures.drying_time, figures.cycle_time)
        return (
            heated(figures.heat_duty_shelf, self.temperature_shelf)
            | cooled(figures.heat_duty_condenser, self.temperature_condenser)
            | {
                "electric_power_vacuum": evacuated(displaced, self.pressure_chamber) * running,
                "area_installed": figures.area,
            }
        )
