"""Venturi scrubber: dust caught by drops that the gas tears from water."""

from __future__ import annotations

from typing import Any, ClassVar, NamedTuple

import jax.numpy as jnp

from granum.core import equipment
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
from granum.dust.equipment.collector import EMISSION, Collector, seen, slip
from granum.dust.equipment.washer import SLOWEST, Scrubbed, Washed, Washer
from granum.dust.formulas.scrubbers import (
    droplet_diameter_venturi,
    grade_efficiency_johnstone,
    impaction_number,
    pressure_drop_venturi,
)
from granum.streams.stream import Stream
from granum.streams.units import Limits


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


@equipment(
    "venturi_scrubber",
    source="johnstone1954; calvert1970; theodore2012, p. 15.7",
    title="Venturi scrubber",
    equation=r"E = 1 - \exp\left(-k\,\frac{Q_l}{Q_g}\sqrt\psi\right),\ \Delta p = \rho_l v^2 \frac{Q_l}{Q_g}",
)
class VenturiScrubber(Washer):
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

    def inside(self, feed: Stream, water: Stream) -> Washed:
        gas = seen(feed)
        velocity = jnp.maximum(gas.volume_flow / self.throat_area, SLOWEST)
        ratio = self.ratio(feed, water)
        drops = droplet_diameter_venturi(velocity, ratio)
        impaction = impaction_number(
            gas.size, gas.particle_density, velocity, gas.viscosity, drops, slip(gas, feed)
        )
        share = grade_efficiency_johnstone(impaction, ratio, self.johnstone_constant)
        lost = pressure_drop_venturi(velocity, ratio, water.liquid_density)
        return Washed(velocity, ratio, drops, lost, self.mixed(feed, water, lost), share)

    def figures(self, inside: Washed, outlets: Scrubbed, feed: Stream, water: Stream) -> VenturiFigures:
        return VenturiFigures(
            inside.velocity,
            inside.ratio,
            inside.body,
            inside.lost,
            *self.cleaned(inside, outlets, feed, water),
        )

    def measured(
        self, inside: Washed, outlets: Scrubbed, figures: VenturiFigures, feed: Stream, water: Stream
    ) -> dict[str, Any]:
        return {
            "emission": self.over_limit(figures.emission_concentration),
            "throat": inside.velocity,
            "liquid": inside.ratio,
            "drop": inside.lost,
        }
