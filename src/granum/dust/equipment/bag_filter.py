"""Bag filter cleaned by pulses of compressed air."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Annotated, Any, ClassVar, NamedTuple

import jax.numpy as jnp
import numpy as np

from granum.core import equipment
from granum.core.constants import STANDARD_ATMOSPHERE
from granum.core.i18n import _
from granum.core.kinds import (
    Area,
    Concentration,
    Fraction,
    Law,
    Length,
    MassPerAreaOrZero,
    MoleFraction,
    PositiveNumber,
    Pressure,
    PressureDrop,
    Speed,
    Temperature,
    Time,
)
from granum.core.limits import Limit
from granum.core.utilities import Utility
from granum.dust.equipment.collector import EMISSION, IGNITION, Cleaned, Collector, seen
from granum.dust.formulas.bags import residual_drag_pulse_jet
from granum.filtration.formulas.gas_filters import pressure_drop_dust_cake
from granum.filtration.kinds import DustResistance, ResidualDrag
from granum.numerics.smooth import safe_divide
from granum.streams.inside_charts import Axis, Curve, drawn_along
from granum.streams.stream import Stream
from granum.streams.units import Limits, Operated, Utilities
from granum.streams.utilities import AREA, FANNED, compressed, fanned

MANUAL = "turner1998"
PULSES = 0.002  # of the gas by volume, as free air
SLOWEST = 1e-9  # m/s
ROUNDING = 1e-9  # of a bag


class BagFigures(NamedTuple):
    """Figures of a bag filter."""

    superficial_velocity: Speed
    bag_number: PositiveNumber
    pressure_drop: PressureDrop
    pressure_drop_highest: PressureDrop
    dry_mass_per_area: MassPerAreaOrZero
    dust_concentration_inlet: Concentration
    removal_efficiency: Fraction
    emission_concentration: Concentration


class Bagged(NamedTuple):
    """Velocity, dust in the gas, mean and highest pressure drop, share collected by species and class."""

    velocity: Any
    concentration: Any
    drop: Any
    highest: Any
    share: Any


@equipment(
    "bag_filter",
    source="turner1998; leith1980; kurtz2017",
    title="Bag filter (pulse-jet)",
    equation=r"\Delta p = S_e v + K_2\,c\,v^2\,\frac{t}{2}",
)
class BagFilter(Collector):
    """Felt bags that rows of pulses clean one after the other: on average a bag carries half the dust that it
    has when its turn comes.

    The residual drag follows from the pressure of the pulse unless it is given. What passes seeps through
    cloth and pinholes, about the same from thin and from dusty gas and of every size:
    ``concentration_leakage`` per gas as it is. Needle felt without a leak lets less than 1 mg/m³ through in
    trials, filters in plants mostly some times to ten times that: one hole of 1 mm does as much as nine bags.
    The bags are counted by their side alone, of the manual's cage of 10 ft unless their size is given.
    The gas must stay warmer than its dew point, and colder than the cloth bears.
    """

    area: Area
    cleaning_interval: Time = 600.0
    dust_resistance: DustResistance = 6e4
    residual_drag: ResidualDrag | None = None
    pressure_pulse: Pressure = 6e5
    concentration_leakage: Concentration = 5e-6
    temperature_cloth: Temperature = 408.15
    emission_limit: Concentration = EMISSION
    oxygen_fraction: MoleFraction | None = None
    oxygen_reference: MoleFraction | None = None
    explosible_concentration: Concentration | None = None
    layer_ignition_temperature: Temperature | None = None
    explosion_vent: Annotated[Any, Law("explosion_vent")] = None
    bag_diameter: Length = 0.13
    bag_length: Length = 3.05

    takes_dust: ClassVar[bool] = True
    limits: ClassVar[Limits] = (
        Collector.limits
        | IGNITION
        | {
            "cloth": Limit("gas per cloth of pulse-jet bags", 0.5, 4.6, "m/min", MANUAL),
            "drop": Limit("highest pressure drop of the bags", 250.0, 2500.0, "Pa", MANUAL),
            "warm": Limit(
                "temperature of the gas below that of the cloth", 0.0, math.inf, "delta_degC", MANUAL
            ),
        }
    )

    utilities: ClassVar[Utilities] = (
        FANNED | AREA | {"electric_power_compressor": Utility("turner1998; turton2018, ch. 11")}
    )

    @property
    def drag(self) -> Any:
        """Of the cleaned cloth, Pa s/m."""
        return (
            residual_drag_pulse_jet(self.pressure_pulse) if self.residual_drag is None else self.residual_drag
        )

    def inside(self, feed: Stream) -> Bagged:
        gas = seen(feed)
        velocity = jnp.maximum(gas.volume_flow / self.area, SLOWEST)
        dust = safe_divide(feed.solid_flow, gas.volume_flow)
        drag, cake, t = self.drag, self.dust_resistance, self.cleaning_interval
        mean = pressure_drop_dust_cake(velocity, dust, 0.5 * t, drag, cake)
        highest = pressure_drop_dust_cake(velocity, dust, t, drag, cake)
        passes = jnp.where(
            dust > 0.0, jnp.minimum(safe_divide(self.concentration_leakage, dust, otherwise=1.0), 1.0), 1.0
        )
        return Bagged(velocity, dust, mean, highest, 1.0 - passes + 0.0 * gas.size)

    def charts(self, made: Operated, inlets: Mapping[str, Stream]) -> dict[str, Any]:
        bags: Bagged = made.inside
        if not float(inlets["feed"].gas_flow) > 0.0:
            return {}
        time = np.linspace(0.0, float(self.cleaning_interval), 41)
        load = float(bags.concentration) * float(bags.velocity) * time
        drop = np.asarray(
            pressure_drop_dust_cake(
                bags.velocity, bags.concentration, jnp.asarray(time), self.drag, self.dust_resistance
            )
        )
        drawn = drawn_along(
            Axis("time", "Time", label=_("time since the last pulse")),
            time,
            (
                Axis("pressure_drop", "PressureDrop"),
                [
                    Curve(_("one bag as it loads"), drop, "ACCENT"),
                    Curve(_("all bags, mean"), np.full(time.shape, float(bags.drop)), "GAS", "dash"),
                    Curve(
                        _("clean cloth"),
                        np.full(time.shape, float(self.drag * bags.velocity)),
                        "GAS",
                        "dot",
                    ),
                ],
            ),
            (
                Axis("dry_mass_per_area", "MassPerArea", label=_("dust on the cloth")),
                [Curve(_("dust on the cloth"), load, "SOLID", "dashdot")],
            ),
        )
        return {_("A bag from pulse to pulse"): drawn}

    def outlets(self, inside: Bagged, feed: Stream) -> Cleaned:
        return self.parted(feed, inside.share, inside.drop)

    def figures(self, inside: Bagged, outlets: Cleaned, feed: Stream) -> BagFigures:
        return BagFigures(
            inside.velocity,
            jnp.ceil(self.area / (jnp.pi * self.bag_diameter * self.bag_length) - ROUNDING),
            inside.drop,
            inside.highest,
            inside.concentration * inside.velocity * self.cleaning_interval,
            inside.concentration,
            safe_divide(outlets.dust.solid_flow, feed.solid_flow),
            self.emission(outlets.gas),
        )

    def measured(self, inside: Bagged, outlets: Cleaned, figures: BagFigures, feed: Stream) -> dict[str, Any]:
        burns = self.ignition(
            feed,
            self.explosible_concentration,
            self.layer_ignition_temperature,
            self.explosion_vent,
        )
        return burns | {
            "emission": self.over_limit(figures.emission_concentration),
            "cloth": 60.0 * inside.velocity,
            "drop": inside.highest,
            "warm": self.temperature_cloth - feed.temperature,
        }

    def drawn(self, inside: Bagged, outlets: Cleaned, figures: BagFigures, feed: Stream) -> dict[str, Any]:
        flow = feed.gas_volume_flow
        return {
            "electric_power_fan": fanned(flow, inside.drop),
            "electric_power_compressor": compressed(PULSES * flow, STANDARD_ATMOSPHERE + self.pressure_pulse),
            "area_installed": self.area,
        }

    @classmethod
    def size(cls, gas_volume_flow: Any, superficial_velocity: Any, **more: Any) -> BagFilter:
        """The filter with the cloth that gives a gas-to-cloth ratio."""
        return cls(gas_volume_flow / superficial_velocity, **more)
