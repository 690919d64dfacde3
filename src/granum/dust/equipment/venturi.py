"""Venturi scrubber: dust caught by drops that the gas tears from water."""

from __future__ import annotations

from typing import Any, ClassVar, NamedTuple

import jax.numpy as jnp

from granum.core import equipment
from granum.core.flags import unsolved
from granum.core.kinds import (
    Area,
    Concentration,
    Fraction,
    Length,
    MassFlow,
    MoleFraction,
    PositiveNumber,
    PressureDrop,
    Ratio,
    Speed,
    Temperature,
)
from granum.core.limits import Limit
from granum.dust.equipment.collector import EMISSION, Collector, over_axes, seen, slip
from granum.dust.formulas.scrubbers import (
    droplet_diameter_venturi,
    grade_efficiency_johnstone,
    impaction_number,
    pressure_drop_venturi,
)
from granum.numerics.smooth import safe_divide
from granum.streams.equilibrium import HumidMixture
from granum.streams.equipment.humid_gas import UNSOLVED
from granum.streams.stream import Stream
from granum.streams.units import Limits, Utilities
from granum.streams.utilities import FANNED, fanned

SLOWEST, MOST_LIQUID = 1e-3, 0.1  # m/s, and volume of liquid per gas


class Scrubbed(NamedTuple):
    """Moist gas with what escapes, and the water with the dust."""

    gas: Stream
    slurry: Stream


class VenturiFigures(NamedTuple):
    """Figures of a venturi scrubber."""

    throat_velocity: Speed
    liquid_to_gas: Ratio
    droplet_diameter: Length
    pressure_drop: PressureDrop
    temperature: Temperature
    evaporation: MassFlow
    removal_efficiency: Fraction
    emission_concentration: Concentration


class Throat(NamedTuple):
    """What happens in the throat, the mixture in equilibrium, and the share caught of each species and
    class.
    """

    velocity: Any
    ratio: Any
    drop_size: Any
    lost: Any
    mixed: Stream
    share: Any


@equipment(
    "venturi_scrubber",
    source="johnstone1954; calvert1970; theodore2012, p. 15.7",
    title="Venturi scrubber",
    equation=r"E = 1 - \exp\left(-k\,\frac{Q_l}{Q_g}\sqrt\psi\right),\ \Delta p = \rho_l v^2 \frac{Q_l}{Q_g}",
)
class VenturiScrubber(Collector):
    """Dust is caught by drops of water in a throat, which a separator takes out of the gas; the gas leaves in
    equilibrium with the water.

    Gas velocity and water are those at the throat's inlet. All drops are separated. ``johnstone_constant``
    is by volume: 750 to 1500.
    """

    throat_area: Area
    johnstone_constant: PositiveNumber = 1500.0
    emission_limit: Concentration = EMISSION
    oxygen_fraction: MoleFraction | None = None
    oxygen_reference: MoleFraction | None = None

    limits: ClassVar[Limits] = Collector.limits | {
        "throat": Limit("gas velocity in the throat", 40.0, 150.0, "m/s", "theodore2012"),
        "liquid": Limit("water per gas by volume", 4e-4, 2.7e-3, "dimensionless", "theodore2012"),
        "drop": Limit("pressure drop of a venturi", 1e3, 2.5e4, "Pa", "theodore2012"),
    }

    utilities: ClassVar[Utilities] = FANNED

    def inside(self, feed: Stream, water: Stream) -> Throat:
        gas = seen(feed)
        velocity = jnp.maximum(gas.volume_flow / self.throat_area, SLOWEST)
        some = gas.volume_flow > 0.0
        ratio = jnp.where(
            some, jnp.minimum(safe_divide(water.liquid_volume_flow, gas.volume_flow), MOST_LIQUID), 0.0
        )
        drops = droplet_diameter_venturi(velocity, ratio)
        impaction = impaction_number(
            gas.size, gas.particle_density, velocity, gas.viscosity, drops, slip(gas, feed)
        )
        share = grade_efficiency_johnstone(impaction, ratio, self.johnstone_constant)
        lost = pressure_drop_venturi(velocity, ratio, water.liquid_density)
        both = feed + water
        both = both.replace(pressure=jnp.maximum(feed.pressure - lost, 1e3))
        mixed = HumidMixture(feed.mixture).at_own_enthalpy(both)
        unsolved(jnp.isfinite(mixed.temperature), type(self).card, reason=UNSOLVED)
        return Throat(velocity, ratio, drops, lost, mixed, share)

    def outlets(self, inside: Throat, feed: Stream, water: Stream) -> Scrubbed:
        mixed = inside.mixed
        kept = water.solid + feed.solid * over_axes(inside.share, feed)
        return Scrubbed(
            mixed.replace(solid=mixed.solid - kept, liquid=jnp.zeros_like(mixed.liquid)),
            mixed.replace(solid=kept, gas=jnp.zeros_like(mixed.gas)),
        )

    def figures(self, inside: Throat, outlets: Scrubbed, feed: Stream, water: Stream) -> VenturiFigures:
        gone = feed.liquid_flow + water.liquid_flow - outlets.slurry.liquid_flow
        caught = jnp.sum(feed.solid * over_axes(inside.share, feed))
        return VenturiFigures(
            inside.velocity,
            inside.ratio,
            inside.drop_size,
            inside.lost,
            outlets.gas.temperature,
            jnp.maximum(gone, 0.0),
            safe_divide(caught, feed.solid_flow),
            self.emission(outlets.gas),
        )

    def measured(
        self, inside: Throat, outlets: Scrubbed, figures: VenturiFigures, feed: Stream, water: Stream
    ) -> dict[str, Any]:
        return {
            "emission": self.over_limit(figures.emission_concentration),
            "throat": inside.velocity,
            "liquid": inside.ratio,
            "drop": inside.lost,
        }

    def drawn(
        self, inside: Throat, outlets: Scrubbed, figures: VenturiFigures, feed: Stream, water: Stream
    ) -> dict[str, Any]:
        return {"electric_power_fan": fanned(feed.gas_volume_flow, inside.lost)}
