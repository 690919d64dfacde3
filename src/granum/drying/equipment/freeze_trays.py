"""A freeze dryer for food on trays: freezer, cabinet with heated shelves, ice condenser and vacuum pump."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any, ClassVar, NamedTuple

import jax.numpy as jnp
import numpy as np

from granum.core import equipment
from granum.core.constants import STEFAN_BOLTZMANN
from granum.core.errors import InputError
from granum.core.i18n import _
from granum.core.kinds import (
    Area,
    Fraction,
    Frequency,
    HeatTransferCoefficient,
    Length,
    Mass,
    MassFlow,
    MassFlux,
    MassPerArea,
    MoistureDryBasis,
    MolarEnergy,
    Power,
    Pressure,
    SpecificEnergy,
    Temperature,
    ThermalConductivity,
    Time,
    Volume,
)
from granum.core.limits import Limit
from granum.core.units import format_number
from granum.drying.equipment.freeze import PUMPED, FreezeDried, pump_power, sublimed
from granum.drying.formulas.freeze_drying import secondary_drying_time
from granum.drying.formulas.freeze_trays import Layer, freeze_drying_tray
from granum.drying.formulas.freezing import freezing_temperature_mean, freezing_time_pham
from granum.drying.formulas.vials import COLDEST, SUBLIMATION_HEAT
from granum.drying.kinds import AddedHeatTransferCoefficient, EnergyPerVolume, VaporPermeability
from granum.drying.wet_surface import AS_SPECIFIED, as_specified
from granum.humid_gas.pairs import ice_vapor_pressure
from granum.numerics import find_root, safe_divide
from granum.streams.inside_charts import Axis, Curve, drawn_along
from granum.streams.stream import Stream
from granum.streams.units import Limits, Operated, Unit, Utilities
from granum.streams.utilities import AREA, COOLED, HEATED, cooled, heated

FUSION_HEAT = 333.55e3  # J/kg, of ice at 0 °C
ICE_HEAT_CAPACITY, WATER_HEAT_CAPACITY = 2050.0, 4186.0  # J/(kg K), of ice at about −10 °C


class TrayFreezeFigures(NamedTuple):
    """Figures of a tray freeze dryer; duties are means over the cycle."""

    freezing_time: Time
    drying_time_primary: Time
    drying_time_secondary: Time
    cycle_time: Time
    temperature_front: Temperature
    temperature_bottom: Temperature
    surface_temperature: Temperature
    sublimation_flux: MassFlux
    sublimation_rate_highest: MassFlow
    evaporation_rate: MassFlow
    area: Area
    volume: Volume
    mass_batch: Mass
    heat_duty_freezing: Power
    heat_duty_shelf: Power
    heat_duty_condenser: Power
    heat_duty_defrost: Power
    energy_per_water: SpecificEnergy


@equipment(
    "tray_freeze_dryer",
    source="king1971; pham1986; houdon2017",
    title="Freeze dryer for food on trays",
)
class TrayFreezeDryer(Unit):
    """Layers of food are frozen on trays by cold air from both sides, sublime between heated shelves, and
    desorb; batches follow one another without a break.

    The feed's flow is the mean over the cycle and fixes the tray area. The shelves keep one temperature while
    ice sublimes and another one afterwards. What does not freeze, ``unfrozen_moisture`` per dry solid, stays
    for secondary drying, which ends at ``moisture_outlet``. The ice of the condenser is melted, and leaves at
    the feed's temperature. Duties: freezing and condenser are cold, shelf and defrosting are heat; together
    they are what feed and outlets differ by. The layer keeps its thickness and the vapor leaves as cold as
    the ice. The vacuum pump has the displacement that evacuates the cabinet in time, and takes 50 kJ per
    cubic meter of it (14 W per m³/h, as dry screw pumps do at their end pressure: our own estimate) as long
    as the product dries.
    """

    temperature_shelf: Temperature
    pressure_chamber: Pressure
    load_per_area: MassPerArea
    thickness: Length
    moisture_outlet: MoistureDryBasis
    thermal_conductivity_dry: ThermalConductivity
    vapor_permeability: VaporPermeability
    thermal_conductivity_frozen: ThermalConductivity = 1.5
    emissivity: Fraction = 0.9
    conduction_coefficient: AddedHeatTransferCoefficient = 5.0
    temperature_freezer: Temperature = 233.15
    temperature_frozen: Temperature = 248.15
    heat_transfer_coefficient_freezer: HeatTransferCoefficient = 25.0
    unfrozen_moisture: MoistureDryBasis = 0.2
    temperature_shelf_secondary: Temperature = 313.15
    desorption_rate: Frequency = 1e-4
    activation_energy: MolarEnergy = 4e4
    temperature_condenser: Temperature = 228.15
    shelf_pitch: Length = 0.08
    pump_down_time: Time = 600.0
    pump_energy_per_volume: EnergyPerVolume = 5e4
    temperature_limit_frozen: Temperature = 253.15
    temperature_limit: Temperature = 333.15

    limits: ClassVar[Limits] = {
        "melts": Limit(
            "temperature of the frozen product over its limit", -math.inf, 0.0, "delta_degC", "king1971"
        ),
        "hot": Limit("product temperature over its limit", -math.inf, 0.0, "delta_degC", "houdon2017"),
        "ice": Limit(
            "vapor pressure over the condenser’s ice per chamber pressure",
            0.0,
            0.8,
            "dimensionless",
            "king1971",
        ),
        "load": Limit("wet product per tray area", 5.0, 18.0, "kg/m^2", "houdon2017"),
        "layer": Limit("thickness of the layer", 1.0, 30.0, "mm", "houdon2017"),
        "time": Limit("drying time of a batch", 36000.0, 259200.0, "s", "houdon2017"),
    } | AS_SPECIFIED

    utilities: ClassVar[Utilities] = HEATED | COOLED | AREA | PUMPED

    @classmethod
    def size(cls, temperature_limit: Any, **more: Any) -> TrayFreezeDryer:
        """The dryer whose shelves are as hot as the dry surface allows, hottest as the last ice sublimes."""
        first = cls(temperature_shelf=temperature_limit, temperature_limit=temperature_limit, **more)
        T, L = jnp.asarray(temperature_limit, dtype=float), first.thickness
        k, b, U, P = (
            first.thermal_conductivity_dry,
            first.vapor_permeability,
            first.conduction_coefficient,
            first.pressure_chamber,
        )

        def balance(shelf: Any) -> Any:
            above = first.emissivity * STEFAN_BOLTZMANN * (shelf**4 - T**4)
            front = T - above * L / k
            vapor = SUBLIMATION_HEAT * b * (ice_vapor_pressure(jnp.maximum(front, 0.5 * COLDEST)) - P)
            return L * (above + U * (shelf - front)) - vapor

        found = find_root(balance, T, T + 1000.0, start=T + 20.0, tolerance=1e-12)
        if not (bool(found.converged) and float(balance(T)) < 0.0):
            raise InputError(
                _("Ice does not sublime below a surface of {value} °C at this chamber pressure.").format(
                    value=format_number(float(T) - 273.15, 3)
                ),
                name="temperature_limit",
            )
        return cls(temperature_shelf=float(found.value), temperature_limit=temperature_limit, **more)

    def outlets(self, inside: None, feed: Stream) -> FreezeDried:
        return sublimed(feed, self.moisture_outlet, self.temperature_shelf_secondary)

    def charts(self, made: Operated, inlets: Mapping[str, Stream]) -> dict[str, Any]:
        time_primary = float(made.figures.drying_time_primary)
        if not (float(inlets["feed"].solid_flow) > 0.0 and 0.0 < time_primary < math.inf):
            return {}
        layer = Layer(
            jnp.asarray(self.temperature_shelf, dtype=float),
            self.pressure_chamber,
            self.thickness,
            self.thermal_conductivity_dry,
            self.thermal_conductivity_frozen,
            self.vapor_permeability,
            self.emissivity,
            self.conduction_coefficient,
        )
        depth = jnp.linspace(0.0, float(self.thickness), 61)
        surface, front, bottom, flux = (np.asarray(x) for x in layer.at(depth))
        slowness = 1.0 / flux
        passed = np.append(0.0, np.cumsum(0.5 * (slowness[1:] + slowness[:-1])))
        time = time_primary * passed / passed[-1]
        drawn = drawn_along(
            Axis("time", "Time", label=_("time since the ice began to sublime")),
            time,
            (
                Axis("temperature", "Temperature", "degC", zero=False),
                [
                    Curve(_("shelf"), np.full(time.shape, float(self.temperature_shelf)), "HEAT", "dash"),
                    Curve(_("dry surface"), surface, "SOLID"),
                    Curve(_("bottom of the ice"), bottom, "LIQUID", "dot"),
                    Curve(_("ice front"), front, "LIQUID"),
                ],
            ),
            (Axis("sublimation_flux", "MassFlux"), [Curve(_("sublimation"), flux, "ACCENT", "dash")]),
        )
        return {_("Sublimation of a tray"): drawn}

    def figures(self, inside: None, outlets: FreezeDried, feed: Stream) -> TrayFreezeFigures:
        wet = feed.solid_flow + feed.liquid_flow
        density = self.load_per_area / self.thickness
        water, X = feed.liquid[0] - outlets.product.liquid[0], safe_divide(feed.liquid[0], feed.solid_flow)
        frozen = jnp.maximum(feed.liquid[0] - self.unfrozen_moisture * feed.solid_flow, 0.0)
        # what did not freeze but is dried too is taken from the ice where the product is dried no further
        ice = jnp.minimum(frozen, water)
        fusion = FUSION_HEAT * safe_divide(frozen, wet)
        capacity = safe_divide(
            feed.enthalpy_at(feed.temperature + 0.5) - feed.enthalpy_at(feed.temperature - 0.5), wet
        )
        cold = capacity - (WATER_HEAT_CAPACITY - ICE_HEAT_CAPACITY) * safe_divide(frozen, wet)
        mean = freezing_temperature_mean(self.temperature_frozen, self.temperature_freezer)
        freezing = freezing_time_pham(
            0.5 * self.thickness,
            density,
            fusion,
            feed.temperature,
            self.temperature_freezer,
            self.temperature_frozen,
            self.heat_transfer_coefficient_freezer,
            self.thermal_conductivity_frozen,
            capacity,
            cold,
        )
        primary = freeze_drying_tray(
            self.temperature_shelf,
            self.pressure_chamber,
            self.thickness,
            density * safe_divide(ice, wet),
            self.thermal_conductivity_dry,
            self.vapor_permeability,
            self.thermal_conductivity_frozen,
            self.emissivity,
            self.conduction_coefficient,
        )
        secondary = secondary_drying_time(
            jnp.maximum(jnp.minimum(X, self.unfrozen_moisture), self.moisture_outlet * (1.0 + 1e-9)),
            self.moisture_outlet,
            self.temperature_shelf_secondary,
            self.desorption_rate,
            self.activation_energy,
            0.0,
            self.temperature_shelf_secondary,
        )
        cycle = freezing + primary.drying_time + secondary
        area = wet * cycle / self.load_per_area
        freezes = -wet * (
            capacity * jnp.maximum(feed.temperature - mean, 0.0)
            + fusion
            + cold * (mean - self.temperature_frozen)
        )
        condenses = -SUBLIMATION_HEAT * water
        melts = water * (
            ICE_HEAT_CAPACITY * (273.15 - self.temperature_condenser)
            + FUSION_HEAT
            + WATER_HEAT_CAPACITY * (feed.temperature - 273.15)
        )
        shelf = outlets.heat_duty - freezes - condenses - melts
        return TrayFreezeFigures(
            freezing_time=freezing,
            drying_time_primary=primary.drying_time,
            drying_time_secondary=secondary,
            cycle_time=cycle,
            temperature_front=primary.temperature_front,
            temperature_bottom=primary.temperature_bottom,
            surface_temperature=primary.surface_temperature,
            sublimation_flux=primary.sublimation_flux,
            sublimation_rate_highest=primary.sublimation_flux_highest * area,
            evaporation_rate=water,
            area=area,
            volume=area * self.shelf_pitch,
            mass_batch=wet * cycle,
            heat_duty_freezing=freezes,
            heat_duty_shelf=shelf,
            heat_duty_condenser=condenses,
            heat_duty_defrost=melts,
            energy_per_water=safe_divide(shelf + melts, water),
        )

    def measured(
        self, inside: None, outlets: FreezeDried, figures: TrayFreezeFigures, feed: Stream
    ) -> dict[str, Any]:
        warmest = jnp.maximum(figures.surface_temperature, self.temperature_shelf_secondary)
        return {
            "melts": jnp.maximum(figures.temperature_front, figures.temperature_bottom)
            - self.temperature_limit_frozen,
            "hot": warmest - self.temperature_limit,
            "ice": ice_vapor_pressure(self.temperature_condenser) / self.pressure_chamber,
            "load": self.load_per_area,
            "layer": self.thickness * 1e3,
            "time": figures.drying_time_primary + figures.drying_time_secondary,
        } | as_specified(feed, self.moisture_outlet)

    def drawn(
        self, inside: None, outlets: FreezeDried, figures: TrayFreezeFigures, feed: Stream
    ) -> dict[str, Any]:
        freezer = cooled(figures.heat_duty_freezing, self.temperature_freezer)
        condenser = cooled(figures.heat_duty_condenser, self.temperature_condenser)
        hottest = jnp.maximum(self.temperature_shelf, self.temperature_shelf_secondary)
        return (
            heated(figures.heat_duty_shelf + figures.heat_duty_defrost, hottest)
            | {name: freezer[name] + condenser[name] for name in freezer}
            | {
                "electric_power_vacuum": pump_power(self, figures.area, figures),
                "area_installed": figures.area,
            }
        )
