"""Dissolved-air flotation: a recycle saturated under pressure lets bubbles carry flocs to the top."""

from __future__ import annotations

from dataclasses import KW_ONLY
from typing import Annotated, Any, ClassVar, NamedTuple

import jax.numpy as jnp

from granum.core import equipment
from granum.core.constants import STANDARD_ATMOSPHERE
from granum.core.kinds import (
    Area,
    Concentration,
    Fraction,
    Length,
    MassFlow,
    Power,
    Pressure,
    Ratio,
    Speed,
    Time,
    VolumeFlow,
    VolumeFraction,
    Within,
)
from granum.core.limits import Limit
from granum.core.utilities import Utility
from granum.numerics.smooth import safe_divide
from granum.particles.formulas.terminal import terminal_velocity
from granum.settling.equipment.gravity import DRAG, Drag, Thickness, concentration, over_axes, skim
from granum.settling.formulas.flotation import (
    air_released,
    air_to_solids_ratio,
    collector_efficiency_bubble,
    removal_efficiency_contact,
)
from granum.streams.formulas.drives import shaft_power_incompressible
from granum.streams.stream import Stream
from granum.streams.units import Limits, Unit, Utilities
from granum.streams.utilities import AREA, PUMP, PUMPED, compressed, driven

SOURCE = "edzwald2010"
AIR = 287.055  # J/(kg K)
COVERED = 0.5  # of the cross-sections around a floc that bubbles can cover


class Floated(NamedTuple):
    """Clear water, what is skimmed off, and the shaft power of the recycle pump, which warms both."""

    overflow: Stream
    skimmings: Stream
    shaft_power: Any


class FlotationFigures(NamedTuple):
    """Figures of a flotation tank."""

    overflow_rate: Speed
    removal_efficiency: Fraction
    recycle_flow: VolumeFlow
    air_released: Concentration
    bubble_volume_fraction: VolumeFraction
    air_to_solids_ratio: Ratio
    air_flow: MassFlow
    overflow_concentration: Concentration
    skimmings_concentration: Concentration
    shaft_power: Power


class Whitened(NamedTuple):
    """Flow through the tank, its air and bubbles, and the share of each species and size that floats out."""

    flow: Any
    recycle: Any
    air: Any
    bubbles: Any
    rate: Any
    floated: Any


@equipment(
    "dissolved_air_flotation",
    source="edzwald2010; metcalf2003, § 5-8",
    title="Dissolved-air flotation",
    equation=(
        r"\frac{A}{S} = \frac{r\,\left[f\,C(p_s) - C(p_0)\right]}{C_0},\qquad "
        r"X = \left(1 - e^{-3\,\alpha\,\eta\,\varphi_b\,u_b\,t_R/2d_b}\right)"
        r"\min\left(1, \frac{v}{v_0}\right)"
    ),
)
class DissolvedAirFlotation(Unit):
    """Flotation tank with a recycle of clear water that is saturated with air under pressure: bubbles stick
    to flocs in a contact zone, and what then rises faster than the water sinks is skimmed.

    Flocs are the spheres that settle as fast as the grains of the stream when each volume of solid holds
    ``floc_water_ratio`` volumes of water. All bubbles are of one size, and the air is spread over what they
    caught in proportion to its volume, at most half of its surface covered; the tank is an ideal basin.
    What does not float leaves with the clear water: a bottom scraper is left out. The air itself leaves to
    the surroundings.
    """

    area: Area
    contact_time: Annotated[Time, Within(1.0)] = 120.0
    _: KW_ONLY
    recycle_ratio: Annotated[Ratio, Within(1e-3, 10.0)] = 0.1
    pressure_saturator: Annotated[Pressure, Within(STANDARD_ATMOSPHERE)] = 5.5e5
    saturator_efficiency: Fraction = 0.8
    attachment_efficiency: Fraction = 0.5
    bubble_diameter: Annotated[Length, Within(1e-5, 5e-4)] = 60e-6
    floc_water_ratio: Ratio = 20.0
    skimmings_concentration: Thickness = 30.0
    scraper_power: Power = 0.0
    drag: Drag = DRAG

    limits: ClassVar[Limits] = {
        "rate": Limit("overflow rate with the recycle", 0.0, 15.0 / 3600.0, "m/s", SOURCE),
        "air": Limit("air to solids ratio", 0.005, 1.0, "dimensionless", "metcalf2003, § 5-8"),
        "pressure": Limit("pressure of the saturator", 3.0e5, 7.5e5, "Pa", SOURCE),
        "solids": Limit("solids on the surface", 0.0, 20.1 / 3600.0, "kg/(m^2*s)", "ufc4832"),
        "thicker": Limit("feed thinner than the skimmings", 0.0, 1.0, "dimensionless", "metcalf2003, § 5-8"),
    }
    utilities: ClassVar[Utilities] = (
        PUMPED | AREA | {"electric_power_compressor": Utility(SOURCE), "electric_power_rake": Utility(SOURCE)}
    )

    def inside(self, feed: Stream) -> Whitened:
        T, m = feed.temperature, feed.mixture
        volume = feed.slurry_volume_flow
        recycle = self.recycle_ratio * volume
        flow = volume + recycle
        air = air_released(self.pressure_saturator, self.recycle_ratio, self.saturator_efficiency, T)
        air_density = STANDARD_ATMOSPHERE / (AIR * T)
        bubbles = air / air_density
        liquid_density, viscosity = feed.liquid_density, feed.liquid_viscosity
        rise = jnp.abs(
            terminal_velocity(self.bubble_diameter, air_density, liquid_density, viscosity, drag=self.drag)
        )
        density = m.densities("solids", T)[:, None] + 0.0 * jnp.asarray(m.sizes)
        water = self.floc_water_ratio
        size = jnp.asarray(m.sizes) * jnp.sqrt(1.0 + water) + 0.0 * density
        floc_density = (density + water * liquid_density) / (1.0 + water)
        meets = collector_efficiency_bubble(size, self.bubble_diameter, floc_density, liquid_density, T)
        caught = removal_efficiency_contact(
            jnp.minimum(meets, 1.0),
            self.attachment_efficiency,
            jnp.minimum(bubbles, 1.0),
            rise,
            self.contact_time,
            self.bubble_diameter,
        )
        solid = jnp.sum(feed.solid, axis=tuple(range(2, feed.solid.ndim)))
        flocs = jnp.sum(caught * solid / density) * (1.0 + water)
        ratio = self.bubble_diameter / size
        most = jnp.maximum(4.0 * COVERED * ratio, ratio**3)
        spread = safe_divide(air * flow / air_density, flocs, 0.0)
        gas = jnp.minimum(jnp.where(flocs > 0.0, spread, jnp.inf), most)
        aggregate = size * jnp.cbrt(1.0 + gas)
        lighter = (floc_density + gas * air_density) / (1.0 + gas)
        speed = terminal_velocity(aggregate, lighter, liquid_density, viscosity, drag=self.drag)
        rate = flow / self.area
        rises = jnp.clip(safe_divide(jnp.maximum(-speed, 0.0), rate, 0.0), 0.0, 1.0)
        once = caught * rises
        # what the recycle brings back has another chance
        share = once * (1.0 + self.recycle_ratio) / (1.0 + once * self.recycle_ratio)
        return Whitened(flow, recycle, air, bubbles, rate, share)

    def outlets(self, inside: Whitened, feed: Stream) -> Floated:
        power = shaft_power_incompressible(
            inside.recycle, self.pressure_saturator - STANDARD_ATMOSPHERE, PUMP
        )
        warm = feed.heated(power)
        share = over_axes(inside.floated, feed)
        parted = skim(warm, 0.0 * share, share, 1.0, self.skimmings_concentration)
        return Floated(parted.overflow, parted.skimmings, power)

    def figures(self, inside: Whitened, outlets: Floated, feed: Stream) -> FlotationFigures:
        given = concentration(feed)
        return FlotationFigures(
            inside.rate,
            jnp.clip(safe_divide(outlets.skimmings.solid_flow, feed.solid_flow, 0.0), 0.0, 1.0),
            inside.recycle,
            inside.air,
            inside.bubbles,
            jnp.where(
                given > 0.0,
                air_to_solids_ratio(inside.air, self.recycle_ratio, jnp.where(given > 0.0, given, 1.0)),
                0.0,
            ),
            inside.air * inside.flow,
            concentration(outlets.overflow),
            concentration(outlets.skimmings),
            outlets.shaft_power,
        )

    def measured(
        self, inside: Whitened, outlets: Floated, figures: FlotationFigures, feed: Stream
    ) -> dict[str, Any]:
        return {
            "rate": inside.rate,
            "air": figures.air_to_solids_ratio,
            "pressure": jnp.asarray(self.pressure_saturator),
            "solids": feed.solid_flow / self.area,
            "thicker": concentration(feed) / self.skimmings_concentration,
        }

    def drawn(
        self, inside: Whitened, outlets: Floated, figures: FlotationFigures, feed: Stream
    ) -> dict[str, Any]:
        ambient = figures.air_flow * AIR * feed.temperature / STANDARD_ATMOSPHERE
        lost = safe_divide(ambient, jnp.asarray(self.saturator_efficiency), 0.0)
        return {
            "electric_power_pump": driven(outlets.shaft_power),
            "electric_power_compressor": compressed(lost, self.pressure_saturator),
            "electric_power_rake": driven(jnp.asarray(self.scraper_power)),
            "area_installed": self.area,
        }
