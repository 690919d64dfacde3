"""A freeze dryer for vials, in batches that follow one another: primary drying by the vial model, secondary
drying by desorption.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any, ClassVar, NamedTuple

import equinox as eqx
import jax.numpy as jnp
import numpy as np

from granum.core import equipment
from granum.core.constants import STANDARD_ATMOSPHERE
from granum.core.errors import ApplicabilityError
from granum.core.i18n import _
from granum.core.kinds import (
    Area,
    Frequency,
    HeatTransferCoefficient,
    Length,
    Mass,
    MassFlow,
    MassFlux,
    MoistureDryBasis,
    MolarEnergy,
    PositiveNumber,
    Power,
    Pressure,
    SpecificEnergy,
    Temperature,
    TemperatureRate,
    Time,
    Volume,
)
from granum.core.limits import Limit
from granum.core.utilities import Utility
from granum.drying.formulas.freeze_drying import choked_flow_rate, primary_drying, secondary_drying_time
from granum.drying.formulas.vials import SUBLIMATION_HEAT, dry, vial_of
from granum.drying.kinds import (
    EnergyPerVolume,
    HeatTransferPerPressure,
    PerLength,
    PerPressure,
    VaporResistance,
    VaporResistanceGradient,
)
from granum.numerics import safe_divide
from granum.streams.inside_charts import Axis, Curve, drawn_along
from granum.streams.stream import Stream
from granum.streams.units import Limits, Operated, Unit, Utilities
from granum.streams.utilities import AREA, COLD_APPROACH, COOLED, HEATED, cooled, heated

PUMPED = {
    "electric_power_vacuum": Utility(
        "king1971, the pressure only: the energy of the pump is our own estimate"
    )
}


_dried = eqx.filter_jit(dry)


class FreezeDried(NamedTuple):
    """Freeze-dried product, melted condenser ice, and the heat taken up in all, shelves less condenser."""

    product: Stream
    condensate: Stream
    heat_duty: Any


class FreezeFigures(NamedTuple):
    """Figures of a freeze dryer."""

    drying_time_primary: Time
    drying_time_secondary: Time
    cycle_time: Time
    temperature_product: Temperature
    sublimation_flux_highest: MassFlux
    evaporation_rate: MassFlow
    vial_count: PositiveNumber
    mass_batch: Mass
    heat_duty_shelf: Power
    heat_duty_condenser: Power
    energy_per_water: SpecificEnergy
    sublimation_rate_highest: MassFlow
    choked_flow_rate: MassFlow | None  # of a machine whose duct is not given


def sublimed(feed: Stream, moisture_outlet: Any, temperature: Any) -> FreezeDried:
    """A feed parted into dry product of a temperature and the condenser's ice, melted at the feed's."""
    first = next((liquid.name for liquid in feed.mixture.liquids), "–")
    if first != "water":
        raise ApplicabilityError(
            _(
                "A freeze dryer sublimes ice only: the first liquid of the mixture must be water "
                "(it is {liquid})."
            ).format(liquid=first)
        )
    kept = feed.liquid.at[0].set(jnp.minimum(moisture_outlet * feed.solid_flow, feed.liquid[0]))
    product = feed.replace(
        liquid=kept, gas=jnp.zeros_like(feed.gas), temperature=jnp.asarray(temperature, dtype=float)
    )
    melted = feed.replace(solid=jnp.zeros_like(feed.solid), liquid=feed.liquid - kept, gas=feed.gas)
    duty = product.enthalpy_flow + melted.enthalpy_flow - feed.enthalpy_flow
    return FreezeDried(product, melted, duty)


def pump_power(dryer: Any, shelves: Any, figures: Any) -> Any:
    """Of the vacuum pump that evacuates the cabinet around the shelves in time and runs on as long as
    the product dries; mean over the cycle.
    """
    displaced = (
        shelves
        * dryer.shelf_pitch
        / dryer.pump_down_time
        * jnp.log(jnp.maximum(STANDARD_ATMOSPHERE / dryer.pressure_chamber, 1.0))
    )
    drying = figures.drying_time_primary + figures.drying_time_secondary
    return dryer.pump_energy_per_volume * displaced * safe_divide(drying, figures.cycle_time)


@equipment("freeze_dryer", source="pikal1985; pikal1990; shivkumar2019", title="Freeze dryer for vials")
class FreezeDryer(Unit):
    """Vials freeze, sublime on shelves that warm to a temperature, and desorb at a second one; batches follow
    one another without a break.

    The feed's flow is the mean over the cycle and fixes how many vials are in a batch. Its dry solid per
    volume is the concentration. What does not freeze, ``unfrozen_moisture`` per dry solid, stays for
    secondary drying, which ends at ``moisture_outlet``. ``heat_duty_shelf`` and ``heat_duty_condenser`` are
    means over the cycle of the heats of sublimation and desorption, and ``energy_per_water`` is the heat
    alone: that of the whole line adds the electricity which makes the cold. Melted condenser ice
    leaves at the feed's temperature. The vacuum pump is that of ``drying.tray_freeze_dryer``.
    """

    pressure_chamber: Pressure
    temperature_shelf: Temperature
    area_vial: Area
    area_product: Area
    volume_fill: Volume
    vial_coefficient_contact: HeatTransferCoefficient
    vial_coefficient_gas: HeatTransferPerPressure
    vapor_resistance: VaporResistance
    vapor_resistance_slope: VaporResistanceGradient = 0.0
    vapor_resistance_saturation: PerLength = 0.0
    vial_coefficient_saturation: PerPressure = 0.0
    temperature_shelf_start: Temperature = 238.15
    ramp_rate: TemperatureRate = 1.0 / 60.0
    temperature_shelf_secondary: Temperature = 298.15
    ramp_rate_secondary: TemperatureRate = 0.2 / 60.0
    unfrozen_moisture: MoistureDryBasis = 0.2
    moisture_outlet: MoistureDryBasis = 0.02
    desorption_rate: Frequency = 1e-4
    activation_energy: MolarEnergy = 4e4
    freezing_time: Time = 10800.0
    temperature_limit: Temperature = 241.15
    duct_diameter: Length | None = None
    sublimation_capacity: MassFlow | None = None
    shelf_pitch: Length = 0.1
    pump_down_time: Time = 1800.0
    pump_energy_per_volume: EnergyPerVolume = 5e4

    limits: ClassVar[Limits] = {
        "hot": Limit("product temperature over its limit", -math.inf, 0.0, "delta_degC", "pikal1985"),
        "time": Limit("drying time of a batch", 36000.0, 259200.0, "s", "houdon2017"),
        "choked": Limit(
            "sublimation over the choked flow of the duct", 0.0, 1.0, "dimensionless", "patel2010"
        ),
        "capacity": Limit(
            "sublimation over the capacity of the machine", 0.0, 1.0, "dimensionless", "shivkumar2019"
        ),
    }

    utilities: ClassVar[Utilities] = HEATED | COOLED | AREA | PUMPED

    def outlets(self, inside: None, feed: Stream) -> FreezeDried:
        return sublimed(feed, self.moisture_outlet, self.temperature_shelf_secondary)

    def charts(self, made: Operated, inlets: Mapping[str, Stream]) -> dict[str, Any]:
        feed = inlets["feed"]
        if not float(feed.solid_flow) > 0.0:
            return {}
        vial = vial_of(
            self.area_vial,
            self.area_product,
            self.volume_fill,
            feed.solid_flow / feed.slurry_volume_flow,
            feed.solid_density,
            self.vial_coefficient_contact,
            self.vial_coefficient_gas,
            self.vial_coefficient_saturation,
            self.vapor_resistance,
            self.vapor_resistance_slope,
            self.vapor_resistance_saturation,
            self.pressure_chamber,
        )
        _total, path = _dried(vial, self.temperature_shelf_start, self.temperature_shelf, self.ramp_rate)
        order = np.argsort(np.asarray(path.time), kind="stable")
        time, shelf, front, bottom, flux = (
            np.asarray(x)[order] for x in (path.time, path.shelf, path.front, path.bottom, path.flux)
        )
        hot = np.full(time.shape, float(self.temperature_limit))
        drawn = drawn_along(
            Axis("time", "Time"),
            time,
            (
                Axis("temperature", "Temperature", "degC", zero=False),
                [
                    Curve(_("shelf"), shelf, "HEAT", "dash"),
                    Curve(_("bottom of the product"), bottom, "SOLID"),
                    Curve(_("ice front"), front, "LIQUID"),
                    Curve(_("limit of the product"), hot, "GAS", "dot"),
                ],
            ),
            (Axis("sublimation_flux", "MassFlux"), [Curve(_("sublimation"), flux, "ACCENT", "dash")]),
        )
        return {_("Primary drying of a vial"): drawn}

    def figures(self, inside: None, outlets: FreezeDried, feed: Stream) -> FreezeFigures:
        concentration = safe_divide(feed.solid_flow, feed.slurry_volume_flow)
        primary = primary_drying(
            self.pressure_chamber,
            self.temperature_shelf,
            self.area_vial,
            self.area_product,
            self.volume_fill,
            concentration,
            self.vial_coefficient_contact,
            self.vial_coefficient_gas,
            self.vapor_resistance,
            self.vapor_resistance_slope,
            self.vapor_resistance_saturation,
            self.vial_coefficient_saturation,
            self.temperature_shelf_start,
            self.ramp_rate,
            feed.solid_density,
        )
        secondary = secondary_drying_time(
            self.unfrozen_moisture,
            self.moisture_outlet,
            self.temperature_shelf_secondary,
            self.desorption_rate,
            self.activation_energy,
            0.0,
            self.temperature_shelf,
            self.ramp_rate_secondary,
        )
        cycle = self.freezing_time + primary.drying_time + secondary
        vials = feed.slurry_volume_flow * cycle / self.volume_fill
        water = feed.liquid[0] - outlets.product.liquid[0]
        heat = SUBLIMATION_HEAT * water
        highest = primary.sublimation_flux_highest * self.area_product * vials
        choked = (
            None
            if self.duct_diameter is None
            else choked_flow_rate(self.pressure_chamber, self.duct_diameter) + 0.0 * highest
        )
        return FreezeFigures(
            drying_time_primary=primary.drying_time,
            drying_time_secondary=secondary,
            cycle_time=cycle,
            temperature_product=primary.temperature_product,
            sublimation_flux_highest=primary.sublimation_flux_highest,
            evaporation_rate=water,
            vial_count=vials,
            mass_batch=(feed.solid_flow + feed.liquid_flow) * cycle,
            heat_duty_shelf=heat,
            heat_duty_condenser=-heat,
            energy_per_water=safe_divide(heat, water),
            sublimation_rate_highest=highest,
            choked_flow_rate=choked,
        )

    def measured(
        self, inside: None, outlets: FreezeDried, figures: FreezeFigures, feed: Stream
    ) -> dict[str, Any]:
        found = {
            "hot": figures.temperature_product - self.temperature_limit,
            "time": figures.drying_time_primary + figures.drying_time_secondary,
        }
        if figures.choked_flow_rate is not None:
            found["choked"] = figures.sublimation_rate_highest / figures.choked_flow_rate
        if self.sublimation_capacity is not None:
            found["capacity"] = figures.sublimation_rate_highest / self.sublimation_capacity
        return found

    def drawn(
        self, inside: None, outlets: FreezeDried, figures: FreezeFigures, feed: Stream
    ) -> dict[str, Any]:
        frozen = self.temperature_shelf_start - COLD_APPROACH
        shelves = figures.vial_count * self.area_vial
        rest = jnp.maximum(outlets.heat_duty, 0.0)  # that leaves with the product
        return (
            heated(figures.heat_duty_shelf + rest, self.temperature_shelf_secondary)
            | cooled(figures.heat_duty_condenser + jnp.minimum(outlets.heat_duty, 0.0), frozen)
            | {
                "electric_power_vacuum": pump_power(self, shelves, figures),
                "area_installed": shelves,
            }
        )
