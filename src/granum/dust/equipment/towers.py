"""Scrubbing towers: dust caught by falling drops, or by a wet packing."""

from __future__ import annotations

from math import pi
from typing import Any, ClassVar, NamedTuple

import jax.numpy as jnp

from granum.core import equipment
from granum.core.kinds import (
    Concentration,
    Fraction,
    Length,
    MassFlow,
    MoleFraction,
    PressureDrop,
    PressureGradient,
    Ratio,
    Speed,
    Temperature,
    VoidFraction,
)
from granum.core.limits import Limit
from granum.dust.equipment.collector import EMISSION, Collector, seen, slip
from granum.dust.equipment.washer import SLOWEST, Scrubbed, Washed, Washer
from granum.dust.formulas.scrubbers import (
    grade_efficiency_packed_scrubber,
    grade_efficiency_spray_tower,
    impaction_number,
    target_efficiency_drop,
)
from granum.numerics.smooth import safe_divide
from granum.particles.formulas.terminal import terminal_velocity
from granum.streams.stream import Stream
from granum.streams.units import Limits

FASTEST_RISE = 0.99  # of the fall of the drops, beyond which the check says that the gas takes them along
HEADS = 3.0  # velocity heads that the gas loses at the ends of an empty tower


class TowerFigures(NamedTuple):
    """Figures of a scrubbing tower."""

    superficial_velocity: Speed
    liquid_to_gas: Ratio
    pressure_drop: PressureDrop
    temperature: Temperature
    evaporation: MassFlow
    removal_efficiency: Fraction
    emission_concentration: Concentration


class ScrubbingTower(Washer):
    """Abstract upright tower in which gas rises against water."""

    diameter: Length
    height: Length

    def rise(self, feed: Stream) -> Any:
        """Velocity of the gas in the empty tower."""
        return jnp.maximum(feed.gas_volume_flow / (0.25 * pi * self.diameter**2), SLOWEST)

    def figures(self, inside: Washed, outlets: Scrubbed, feed: Stream, water: Stream) -> TowerFigures:
        return TowerFigures(
            inside.velocity, inside.ratio, inside.lost, *self.cleaned(inside, outlets, feed, water)
        )


@equipment(
    "spray_tower",
    source="calvert1972; theodore2012",
    title="Spray tower (scrubber)",
    equation=(
        r"E = 1 - \exp\left(-\frac{3}{2}\,\frac{Q_l}{Q_g}\,"
        r"\frac{H}{d}\,\frac{v_s}{v_s - U}\,\eta_d\right)"
    ),
)
class SprayTower(ScrubbingTower):
    """Drops of one size fall against the gas and sweep dust out of it by inertia; the gas leaves in
    equilibrium with the water.

    Drops fall at their terminal velocity from top to bottom, none along the walls. Where the gas rises as
    fast as they fall, it would take them along: the check fails, and what is caught is that of gas a little
    slower. The ends of the tower cost three velocity heads, our own estimate. Limits recalled, not opened.
    """

    droplet_diameter: Length = 1e-3
    emission_limit: Concentration = EMISSION
    oxygen_fraction: MoleFraction | None = None
    oxygen_reference: MoleFraction | None = None

    limits: ClassVar[Limits] = Collector.limits | {
        "rise": Limit("gas velocity in a spray tower", 0.3, 1.5, "m/s", "theodore2012"),
        "liquid": Limit("water per gas by volume", 5e-4, 3e-3, "dimensionless", "theodore2012"),
        "rain": Limit("gas velocity over the fall of the drops", 0.0, 0.5, "dimensionless", "calvert1972"),
    }

    def rain(self, feed: Stream, water: Stream) -> Any:
        """Fall of the drops in still gas."""
        gas = seen(feed)
        return terminal_velocity(self.droplet_diameter, water.liquid_density, gas.density, gas.viscosity)

    def inside(self, feed: Stream, water: Stream) -> Washed:
        gas, drop, ratio = seen(feed), self.droplet_diameter, self.ratio(feed, water)
        rise, fall = self.rise(feed), self.rain(feed, water)
        impaction = impaction_number(
            gas.size, gas.particle_density, fall, gas.viscosity, drop, slip(gas, feed)
        )
        share = grade_efficiency_spray_tower(
            target_efficiency_drop(impaction),
            ratio,
            self.height,
            drop,
            fall,
            jnp.minimum(rise, FASTEST_RISE * fall),
        )
        lost = HEADS * 0.5 * gas.density * rise**2
        return Washed(rise, ratio, drop, lost, self.mixed(feed, water, lost), share)

    def measured(
        self, inside: Washed, outlets: Scrubbed, figures: TowerFigures, feed: Stream, water: Stream
    ) -> dict[str, Any]:
        return {
            "emission": self.over_limit(figures.emission_concentration),
            "rise": inside.velocity,
            "liquid": inside.ratio,
            "rain": inside.velocity / self.rain(feed, water),
        }


@equipment(
    "packed_scrubber",
    source="calvert1972; perry2008, ch. 17",
    title="Packed scrubber",
    equation=r"E = 1 - \exp\left(-\frac{\pi}{2\,(j + j^2)\,(\varepsilon - h)}\,\frac{H}{d_c}\,\psi\right)",
)
class PackedScrubber(ScrubbingTower):
    """Dust is thrown on a wet packing by the bends of its channels; the gas leaves in equilibrium with the
    water that trickles down.

    Good for dust of some micrometers that does not cake: more of it plugs a packing. The pressure gradient is
    that of the wet packing, 200 to 400 Pa/m as usually run. Limits recalled, not opened.
    """

    packing_diameter: Length = 0.025
    void_fraction: VoidFraction = 0.75
    liquid_holdup: Fraction = 0.05
    pressure_gradient: PressureGradient = 300.0
    emission_limit: Concentration = EMISSION
    oxygen_fraction: MoleFraction | None = None
    oxygen_reference: MoleFraction | None = None

    limits: ClassVar[Limits] = Collector.limits | {
        "rise": Limit("gas velocity in a packed scrubber", 0.5, 3.0, "m/s", "perry2008, ch. 17"),
        "liquid": Limit("water per gas by volume", 5e-4, 1e-2, "dimensionless", "perry2008, ch. 17"),
        "gradient": Limit("pressure gradient of a wet packing", 50.0, 800.0, "Pa/m", "perry2008, ch. 17"),
        "dusty": Limit("dust in the gas to a packing", 0.0, 10.0, "g/m^3", "perry2008, ch. 17"),
    }

    def inside(self, feed: Stream, water: Stream) -> Washed:
        gas, rise, ratio = seen(feed), self.rise(feed), self.ratio(feed, water)
        impaction = impaction_number(
            gas.size, gas.particle_density, rise, gas.viscosity, self.packing_diameter, slip(gas, feed)
        )
        share = grade_efficiency_packed_scrubber(
            impaction, self.height, self.packing_diameter, self.void_fraction, self.liquid_holdup
        )
        lost = self.pressure_gradient * self.height + 0.0 * rise
        return Washed(rise, ratio, self.packing_diameter, lost, self.mixed(feed, water, lost), share)

    def measured(
        self, inside: Washed, outlets: Scrubbed, figures: TowerFigures, feed: Stream, water: Stream
    ) -> dict[str, Any]:
        return {
            "emission": self.over_limit(figures.emission_concentration),
            "rise": inside.velocity,
            "liquid": inside.ratio,
            "gradient": jnp.asarray(self.pressure_gradient),
            "dusty": 1e3 * safe_divide(feed.solid_flow, feed.gas_volume_flow),
        }
