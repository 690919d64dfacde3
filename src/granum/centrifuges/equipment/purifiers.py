"""The purifier: a disc bowl in which the light liquid is the continuous one."""

from __future__ import annotations

from dataclasses import KW_ONLY
from typing import Annotated, Any, ClassVar, NamedTuple

import jax.numpy as jnp
import numpy as np

from granum.centrifuges.equipment.bowls import held_liquid
from granum.centrifuges.equipment.liquids import (
    NARROWEST,
    Parted,
    interface,
    light_density,
    parted_figures,
    refuse_weir,
)
from granum.centrifuges.equipment.settling import DISC_LIMITS, EJECTED, Discs
from granum.centrifuges.formulas.clarifying import cut_size_centrifuge, grade_efficiency_thin_layer
from granum.centrifuges.formulas.field import centrifugal_effect
from granum.centrifuges.formulas.mechanics import discharge_interval
from granum.core import equipment
from granum.core.constants import STANDARD_GRAVITY
from granum.core.kinds import (
    Area,
    Distance,
    DynamicViscosity,
    Fraction,
    Length,
    MassFlow,
    MoistureDryBasis,
    OpenFraction,
    Power,
    Ratio,
    Stress,
    Time,
    Volume,
    Within,
)
from granum.core.limits import Limit
from granum.particles.formulas.hindered import hindrance_richardson_zaki
from granum.particles.formulas.numbers import reynolds_number
from granum.particles.formulas.terminal import terminal_velocity
from granum.settling.equipment.gravity import floats, over_axes
from granum.streams.stream import Stream
from granum.streams.units import Limits

NODES = np.polynomial.hermite_e.hermegauss(21)
Spread = Annotated[Ratio, Within(1.01, 5.0)]


class PurifierFigures(NamedTuple):
    """Figures of a purifier."""

    solids_recovery: Fraction
    heavy_recovery: Fraction
    cut_size_centrifuge: Distance
    radius_interface: Distance
    sigma_factor: Area
    centrifugal_effect: Ratio
    shaft_power: Power
    power_acceleration: Power
    power_windage: Power
    hoop_stress_bowl: Stress
    moisture_dry_basis: MoistureDryBasis
    mass_flow_sediment: MassFlow
    discharge_interval: Time


@equipment(
    "disc_purifier",
    source="ambler1959; svarovsky2001; mccabe2005, ch. 29",
    title="Disc purifier",
    equation=r"E = \min\left(1,\; \frac{v_g\,\Sigma(r_1, r_i)}{Q}\right)",
)
class DiscPurifier(Discs):
    """Disc bowl that clears a light liquid of water and solids: olive oil, fuel, lubricant.

    Here the light species of the stream are the continuous liquid, whatever their size classes, and the
    liquid of the stream is dispersed in it, as drops of a log-normal distribution by volume around
    ``droplet_diameter``. Drops and solids settle by the Σ of the discs inside the interface, which should lie
    beyond their rim. Water that does not settle stays in the oil.
    """

    _: KW_ONLY
    radius_heavy: Length
    radius_light: Length
    light_viscosity: DynamicViscosity
    droplet_diameter: Length
    droplet_spread: Spread = 1.8
    light_solids_fraction: OpenFraction = 0.99
    sludge_volume: Volume = 0.005

    limits: ClassVar[Limits] = (
        DISC_LIMITS
        | EJECTED
        | {
            "light": Limit("light liquid in the feed by volume", 0.5, 1.0, "dimensionless", "leung1998"),
            "interface": Limit(
                "radius of the interface over that of the discs",
                1.0,
                1.3,
                "dimensionless",
                "mccabe2005, ch. 29",
            ),
        }
    )

    def __check_init__(self) -> None:
        refuse_weir(self.radius_heavy, self.wall, "radius_heavy")
        refuse_weir(self.radius_light, self.radius_outer, "radius_light")

    def clearing(self, feed: Stream) -> Any:
        """Equivalent settling area inside the interface, m²."""
        reach = self.radius_outer - self.radius_inner
        edge = jnp.clip(
            interface(self, feed, self.radius_light),
            self.radius_inner + NARROWEST * reach,
            self.radius_outer,
        )
        return self.sigma_between(self.radius_inner, edge)

    def inside(self, feed: Stream) -> tuple[Any, Any]:
        """Shares caught: of each species and class of the solids, and of the liquid."""
        light = floats(feed)
        density = jnp.minimum(light_density(feed, 1.0), feed.liquid_density - 1e-3)
        effect = centrifugal_effect(0.5 * (self.radius_inner + self.radius_outer), self.rotation_speed)
        flow, area = jnp.maximum(feed.slurry_volume_flow, 1e-300), self.clearing(feed)
        oil = feed.solid_by_species @ (light / feed.mixture.densities("solids", feed.temperature))
        crowd = jnp.clip(1.0 - oil / flow, 1e-12, 0.9)

        def caught(size: Any, heavy: Any) -> Any:
            alone = terminal_velocity(size, heavy, density, self.light_viscosity, effect * STANDARD_GRAVITY)
            reynolds = reynolds_number(size, jnp.abs(alone), density, self.light_viscosity)
            speed = jnp.maximum(alone, 0.0) / effect * hindrance_richardson_zaki(crowd, reynolds)
            return grade_efficiency_thin_layer(self.sigma_efficiency * speed, flow, area)

        nodes, weights = NODES
        drops = self.droplet_diameter * jnp.exp(jnp.log(self.droplet_spread) * nodes)
        water = jnp.sum(weights * caught(drops, feed.liquid_density + 0.0 * drops)) / np.sum(weights)
        heavy = feed.mixture.densities("solids", feed.temperature)[:, None]
        sizes = jnp.asarray(feed.mixture.sizes) + 0.0 * heavy
        sunk = caught(sizes, jnp.maximum(heavy, density + 1e-6) + 0.0 * sizes)
        return jnp.where(light[:, None] > 0, 0.0, sunk), jnp.clip(water, 0.0, 1.0)

    def outlets(self, inside: tuple[Any, Any], feed: Stream) -> Parted:
        sunk, water = inside
        bottom = feed.part(solid=over_axes(sunk, feed))
        held = held_liquid(bottom, water * feed.liquid_volume_flow, self.sediment_solids_fraction) * water
        none = 0.0 * feed.gas
        return Parted(
            feed.replace(solid=feed.solid - bottom.solid, liquid=(1.0 - water) * feed.liquid),
            feed.replace(solid=0.0 * feed.solid, liquid=(water - held) * feed.liquid, gas=none),
            bottom.replace(liquid=held * feed.liquid, gas=none),
        )

    def figures(self, inside: tuple[Any, Any], outlets: Parted, feed: Stream) -> PurifierFigures:
        shared = parted_figures(self, feed, outlets)
        density = jnp.minimum(light_density(feed, 1.0), feed.liquid_density - 1e-3)
        shared["cut_size_centrifuge"] = cut_size_centrifuge(
            feed.slurry_volume_flow,
            self.clearing(feed),
            feed.liquid_density,
            density,
            self.light_viscosity,
            self.flow_multiple,
            self.sigma_efficiency,
        )
        del shared["light_recovery"]
        return PurifierFigures(
            **shared,
            heavy_recovery=inside[1],
            radius_interface=interface(self, feed, self.radius_light),
            discharge_interval=discharge_interval(self.sludge_volume, outlets.sediment.slurry_volume_flow),
        )

    def measured(
        self, inside: tuple[Any, Any], outlets: Parted, figures: PurifierFigures, feed: Stream
    ) -> dict[str, Any]:
        densities, flow = (
            feed.mixture.densities("solids", feed.temperature),
            jnp.maximum(feed.slurry_volume_flow, 1e-300),
        )
        light = floats(feed)
        return self.measured_bowl(feed, figures) | {
            "solids": feed.solid_by_species @ ((1.0 - light) / densities) / flow,
            "light": feed.solid_by_species @ (light / densities) / flow,
            "interface": figures.radius_interface / self.radius_outer,
            "emptied": figures.discharge_interval / 60.0,
        }
