"""Plate-type electrostatic precipitator."""

from __future__ import annotations

from typing import Annotated, Any, ClassVar, NamedTuple

import jax.numpy as jnp

from granum.core import equipment
from granum.core.kinds import (
    Area,
    Concentration,
    Fraction,
    Law,
    Length,
    MoleFraction,
    PositiveNumber,
    PressureDrop,
    Speed,
    Temperature,
)
from granum.core.limits import Limit
from granum.core.utilities import Utility
from granum.drying.kinds import ElectricField
from granum.dust.equipment.collector import EMISSION, IGNITION, Cleaned, Collector, seen, slip
from granum.dust.formulas.precipitation import (
    elementary_charges_diffusion,
    elementary_charges_field,
    grade_efficiency_deutsch,
    migration_velocity,
)
from granum.dust.kinds import CurrentDensity, IonDose, Voltage
from granum.numerics.smooth import safe_divide
from granum.streams.stream import Stream
from granum.streams.units import Limits, Utilities
from granum.streams.utilities import AREA, FANNED, driven, fanned

PLANTS = "turner1999"
SLOWEST = 1e-9  # m³/s


class PrecipitatorFigures(NamedTuple):
    """Figures of a precipitator; the slowest size is the one that is collected worst, None where all have
    one velocity.
    """

    migration_velocity: Speed
    size_slowest: Length | None
    gas_velocity: Speed
    pressure_drop: PressureDrop
    removal_efficiency: Fraction
    emission_concentration: Concentration


class Charged(NamedTuple):
    """Gas in the ducts, m/s and m³/s, migration velocity and share collected of each species and class."""

    velocity: Any
    flow: Any
    migration: Any
    share: Any


@equipment(
    "electrostatic_precipitator",
    source="deutsch1922; white1951; pauthenier1932",
    title="Electrostatic precipitator",
    equation=r"E = 1 - e^{-wA/Q},\quad w = \frac{(n_f + n_d)\,e E\,C_c}{3\pi\eta d}",
)
class ElectrostaticPrecipitator(Collector):
    """Dust is charged by ions in the field and by their thermal motion, drifts to plates and is rapped off;
    each size by its own migration velocity.

    Field and diffusion charges are added. Nothing is re-entrained and no gas sneaks past: real plants keep
    some tenths to a half of the migration velocity, which ``migration_share`` says. Resistivity beyond
    1e11 Ω m (back corona) is outside the model. With ``migration_velocity_effective``, that of plants on the
    same dust, all sizes drift so fast and the fields do not count (Deutsch and Anderson).
    """

    area: Area
    section: Area
    collecting_field: ElectricField = 3e5
    charging_field: ElectricField = 4e5
    relative_permittivity: PositiveNumber = 5.0
    ion_dose: IonDose = 1e13
    migration_share: PositiveNumber = 0.5
    voltage: Voltage = 5e4
    current_density: CurrentDensity = 2e-4
    pressure_drop: PressureDrop = 125.0
    emission_limit: Concentration = EMISSION
    oxygen_fraction: MoleFraction | None = None
    oxygen_reference: MoleFraction | None = None
    explosible_concentration: Concentration | None = None
    layer_ignition_temperature: Temperature | None = None
    explosion_vent: Annotated[Any, Law("explosion_vent")] = None
    migration_velocity_effective: Speed | None = None

    takes_dust: ClassVar[bool] = True
    limits: ClassVar[Limits] = (
        Collector.limits
        | IGNITION
        | {
            "velocity": Limit("gas velocity between the plates", 0.6, 2.4, "m/s", PLANTS),
            "plates": Limit("plates per gas", 20.0, 200.0, "m^2*s/m^3", PLANTS),
            "migration": Limit("mean migration velocity", 0.02, 0.2, "m/s", PLANTS),
        }
    )

    utilities: ClassVar[Utilities] = FANNED | AREA | {"electric_power_corona": Utility(PLANTS)}

    def inside(self, feed: Stream) -> Charged:
        gas = seen(feed)
        flow = jnp.maximum(gas.volume_flow, SLOWEST)
        if self.migration_velocity_effective is not None:
            speed = jnp.full_like(slip(gas, feed), self.migration_velocity_effective)
            return Charged(flow / self.section, flow, speed, grade_efficiency_deutsch(speed, self.area, flow))
        charge = elementary_charges_field(
            gas.size, self.charging_field, self.relative_permittivity, self.ion_dose
        ) + elementary_charges_diffusion(gas.size, feed.temperature, self.ion_dose)
        speed = self.migration_share * migration_velocity(
            charge, self.collecting_field, gas.size, gas.viscosity, slip(gas, feed)
        )
        return Charged(flow / self.section, flow, speed, grade_efficiency_deutsch(speed, self.area, flow))

    def outlets(self, inside: Charged, feed: Stream) -> Cleaned:
        return self.parted(feed, inside.share, self.pressure_drop)

    def figures(self, inside: Charged, outlets: Cleaned, feed: Stream) -> PrecipitatorFigures:
        removed = safe_divide(outlets.dust.solid_flow, feed.solid_flow)
        mean = -jnp.log1p(-jnp.minimum(removed, 1.0 - 1e-15)) * inside.flow / self.area
        slowest = jnp.argmin(jnp.min(inside.migration, axis=0))
        return PrecipitatorFigures(
            mean,
            None
            if self.migration_velocity_effective is not None
            else jnp.asarray(feed.mixture.sizes)[slowest],
            inside.velocity,
            jnp.asarray(self.pressure_drop, dtype=float),
            removed,
            self.emission(outlets.gas),
        )

    def measured(
        self, inside: Charged, outlets: Cleaned, figures: PrecipitatorFigures, feed: Stream
    ) -> dict[str, Any]:
        burns = self.ignition(
            feed,
            self.explosible_concentration,
            self.layer_ignition_temperature,
            self.explosion_vent,
        )
        return burns | {
            "emission": self.over_limit(figures.emission_concentration),
            "velocity": inside.velocity,
            "plates": self.area / inside.flow,
            "migration": figures.migration_velocity,
        }

    def drawn(
        self, inside: Charged, outlets: Cleaned, figures: PrecipitatorFigures, feed: Stream
    ) -> dict[str, Any]:
        return {
            "electric_power_fan": fanned(feed.gas_volume_flow, self.pressure_drop),
            "electric_power_corona": driven(self.voltage * self.current_density * self.area),
            "area_installed": self.area,
        }

    @classmethod
    def size(
        cls,
        gas_volume_flow: Any,
        removal_efficiency: Any,
        migration_velocity: Any,
        gas_velocity: Any = 1.2,
        **more: Any,
    ) -> ElectrostaticPrecipitator:
        """The plates that Deutsch's law asks for at a mean migration velocity."""
        area = -gas_volume_flow / migration_velocity * jnp.log1p(-removal_efficiency)
        return cls(area, gas_volume_flow / gas_velocity, **more)
