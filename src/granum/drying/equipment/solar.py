"""A solar dryer: a collector warms the air that passes trays of product, day after day."""

from __future__ import annotations

from typing import Annotated, Any, ClassVar, NamedTuple

import equinox as eqx
import jax.numpy as jnp
import numpy as np

from granum.core import equipment
from granum.core.flags import unsolved
from granum.core.kinds import (
    Area,
    Density,
    Fraction,
    HeatFlux,
    HeatTransferCoefficient,
    Law,
    Length,
    Mass,
    MoistureDryBasis,
    Power,
    PressureDrop,
    Ratio,
    SignedMassFlow,
    SpecificEnergy,
    Speed,
    Temperature,
    Time,
    Within,
)
from granum.core.limits import Limit
from granum.drying.formulas.beds import heat_transfer_coefficient_through_bed
from granum.drying.formulas.solar import chimney_draft, solar_collector
from granum.drying.gas_solid.column import Zone
from granum.drying.gas_solid.dryer import Dried, Dryer, Through, dried
from granum.drying.gas_solid.layer import LayerDryer
from granum.drying.gas_solid.steam import is_steam
from granum.numerics import safe_divide
from granum.streams.atmosphere import FLAMMABLE, flammable
from granum.streams.cakes import solid_diameter
from granum.streams.equilibrium import HumidMixture
from granum.streams.stream import Stream
from granum.streams.units import Limits, Utilities
from granum.streams.utilities import AREA, FANNED, fanned

DAY = 86400.0
NO_STEAM = "A solar dryer is not blown with steam: give ambient air at the port 'gas'."


class SolarFigures(NamedTuple):
    """Figures of a solar dryer; duties and flows are means over day and night."""

    drying_time: Time
    area_tray: Area
    dry_solid_mass: Mass
    superficial_velocity: Speed
    temperature_air_highest: Temperature
    solar_efficiency: Ratio
    drying_efficiency: Ratio
    evaporation_rate: SignedMassFlow
    moisture_dry_basis: MoistureDryBasis
    moisture_dry_basis_highest: MoistureDryBasis
    temperature_product_highest: Temperature
    temperature_exhaust: Temperature
    relative_humidity: Ratio
    height_chimney: Length
    heat_duty: Power
    energy_per_water_solar: SpecificEnergy


@equipment("solar_dryer", source="duffie2013, ch. 6; keey1978", title="Solar dryer with collector")
class SolarDryer(LayerDryer):
    """Ambient air is warmed in a flat collector and passes up through trays of product while the sun shines;
    the next load follows after some days.

    Every day is clear, with an irradiance that rises and falls as half a sine over ``day_length``; the air
    outside keeps one state. At night, and in what warms up and cools down with the sun, nothing happens. The
    flows of feed and air are means over day and night: the air passes in sunshine alone, so that it is then
    the more. It comes to the trays at the temperature that the collector gives it, by Hottel and Whillier.
    ``height_chimney`` is that which would draw the air without a fan, through ``pressure_drop``, with the
    exhaust at its mean temperature; zero where that is colder than the air outside, and none would draw.
    """

    area_collector: Area
    layer_depth: Length
    bulk_density_dry: Density
    kinetics: Annotated[Any, Law("drying_kinetics")]
    days: Annotated[int, Within(1, 30)] = eqx.field(static=True, default=2)
    irradiance: HeatFlux = 900.0
    day_length: Time = 43200.0
    transmittance_absorptance: Fraction = 0.8
    heat_loss_coefficient: HeatTransferCoefficient = 6.0
    collector_efficiency_factor: Fraction = 0.75
    pressure_drop: PressureDrop = 5.0
    temperature_limit: Temperature | None = None
    layers: Annotated[int, Within(1, 1000)] = 8
    steps: Annotated[int, Within(1, 100_000)] = 8
    intervals: Annotated[int, Within(1, 100)] = eqx.field(static=True, default=8)

    limits: ClassVar[Limits] = {
        "inlet": Limit("hottest air to the trays", 303.15, 358.15, "K", "duffie2013"),
        "hot": Dryer.limits["hot"],
        "flow": Limit("air per area of collector in sunshine", 0.005, 0.1, "kg/(m^2*s)", "duffie2013"),
    } | FLAMMABLE

    utilities: ClassVar[Utilities] = FANNED | AREA

    def extent(self) -> Any:
        return self.area_collector

    def resolution(self) -> tuple[int, int]:
        return self.layers, self.steps

    def holdup(self, feed: Stream) -> Any:
        return feed.solid_flow * self.days * DAY

    def area_tray(self, feed: Stream) -> Any:
        """Of the trays that hold the load of some days."""
        return self.holdup(feed) / (self.layer_depth * self.bulk_density_dry)

    def in_sunshine(self, gas: Stream) -> Stream:
        """The air as it blows while the sun shines."""
        return gas.part(solid=1.0, liquid=1.0, gas=DAY / self.day_length)

    def exchange(self, feed: Stream, gas: Stream) -> Any:
        d = solid_diameter(feed)
        flux = self.in_sunshine(gas).gas_flow / self.area_tray(feed)
        surface = 6.0 / d * self.bulk_density_dry / feed.solid_density
        return heat_transfer_coefficient_through_bed.function(flux, d) * surface / self.bulk_density_dry

    def sun(self) -> Any:
        """Mean irradiance in each interval of a day."""
        edges = np.linspace(0.0, np.pi, self.intervals + 1)
        return self.irradiance * -np.diff(np.cos(edges)) / np.diff(edges)

    def warmed_air(self, gas: Stream) -> Any:
        """Temperature of the air to the trays in each interval."""
        blown = self.in_sunshine(gas)
        return solar_collector.function(
            self.sun(),
            self.area_collector,
            blown.gas_flow,
            gas.temperature,
            gas.temperature,
            self.transmittance_absorptance,
            self.heat_loss_coefficient,
            self.collector_efficiency_factor,
            gas.gas_heat_capacity,
        ).temperature_outlet

    def zones(self, feed: Stream, *gases: Stream) -> list[Zone]:
        (gas,) = gases
        humid = HumidMixture(feed.mixture)
        blown = humid.carrier_flow(self.in_sunshine(gas)) / self.holdup(feed)
        humidity, part = humid.vapor_per_carrier(gas), self.day_length / self.intervals
        temperatures = self.warmed_air(gas)
        day = [Zone(part, blown, False, humidity, temperatures[i]) for i in range(self.intervals)]
        return day * self.days

    def through(self, feed: Stream, gas: Stream) -> Through:
        unsolved(~is_steam(gas), type(self).card, reason=NO_STEAM)
        return super().through(feed, gas)

    def outlets(self, inside: Through, feed: Stream, gas: Stream) -> Dried:
        product, exhaust, _none = dried(feed, gas, inside.profile)
        air = gas.part(gas=1.0)
        given = jnp.mean(jnp.stack([air.enthalpy_at(T) for T in self.warmed_air(gas)])) - air.enthalpy_flow
        return Dried(product, exhaust, given)

    def figures(
        self, inside: Through, outlets: Dried, feed: Stream, gas: Stream, **_others: Any
    ) -> SolarFigures:
        whole = super().figures(inside, outlets, feed, gas)
        area, hottest = self.area_tray(feed), jnp.max(self.warmed_air(gas))
        blown = self.in_sunshine(gas)
        sunshine = self.area_collector * self.irradiance * 2.0 / np.pi * self.day_length / DAY
        latent = HumidMixture(gas.mixture).heat_of_vaporization(gas.temperature)
        # the exhaust is what the chimney holds; where that is colder than the air outside, none draws
        per_height = chimney_draft.function(
            1.0, outlets.exhaust.temperature, gas.temperature, pressure=gas.pressure
        ).pressure_drop
        return SolarFigures(
            drying_time=self.days * self.day_length + 0.0 * area,
            area_tray=area,
            dry_solid_mass=whole.solid_holdup,
            superficial_velocity=blown.gas_volume_flow / area,
            temperature_air_highest=hottest,
            solar_efficiency=safe_divide(outlets.heat_duty, sunshine),
            drying_efficiency=safe_divide(jnp.maximum(whole.evaporation_rate, 0.0) * latent, sunshine),
            evaporation_rate=whole.evaporation_rate,
            moisture_dry_basis=whole.moisture_dry_basis,
            moisture_dry_basis_highest=jnp.max(inside.profile.moisture[-1]),
            temperature_product_highest=whole.temperature_product_highest,
            temperature_exhaust=whole.temperature_exhaust,
            relative_humidity=whole.relative_humidity,
            height_chimney=safe_divide(self.pressure_drop, jnp.maximum(per_height, 0.0)),
            heat_duty=outlets.heat_duty,
            energy_per_water_solar=safe_divide(outlets.heat_duty, jnp.maximum(whole.evaporation_rate, 0.0)),
        )

    def measured(
        self,
        inside: Through,
        outlets: Dried,
        figures: SolarFigures,
        feed: Stream,
        gas: Stream,
        **_others: Any,
    ) -> dict[str, Any]:
        whole = super().figures(inside, outlets, feed, gas)
        found = super().measured(inside, outlets, whole, feed, gas)
        kept = {name: found[name] for name in ("hot", *flammable(outlets.exhaust)) if name in found}
        return kept | {
            "inlet": figures.temperature_air_highest,
            "flow": self.in_sunshine(gas).gas_flow / self.area_collector,
        }

    def drawn(
        self,
        inside: Through,
        outlets: Dried,
        figures: SolarFigures,
        feed: Stream,
        gas: Stream,
        **_others: Any,
    ) -> dict[str, Any]:
        blown = self.in_sunshine(gas).gas_volume_flow
        power = fanned(blown, self.pressure_drop) * self.day_length / DAY
        return {"electric_power_fan": power, "area_installed": self.area_collector}
