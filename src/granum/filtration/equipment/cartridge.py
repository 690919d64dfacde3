"""Cartridges that clarify a liquid and are thrown away when they are full."""

from __future__ import annotations

import math
from dataclasses import KW_ONLY
from typing import Annotated, Any, ClassVar, NamedTuple

import equinox as eqx
import jax.numpy as jnp

from granum.core import equipment
from granum.core.constants import HOUR
from granum.core.flags import unsolved
from granum.core.kinds import (
    Fraction,
    Length,
    Mass,
    OpenFraction,
    PositiveNumber,
    Pressure,
    PressureDrop,
    Time,
    Volume,
    VolumeFlow,
    Within,
)
from granum.core.limits import Limit
from granum.core.utilities import Utility
from granum.filtration.formulas.blocking import (
    EXPONENTS,
    BlockingLaw,
    blocked,
    dirt_held_blocking,
)
from granum.numerics.smooth import safe_divide
from granum.streams.stream import Stream
from granum.streams.units import Limits, Unit, Utilities
from granum.streams.utilities import PUMPED, pumped

SOURCE = "hlavacek1993; perry2008, § 18"
WATER = 1e-3  # Pa s, of the water with which makers rate cartridges
ENDLESS, LEAST = 1e10, 1e-30  # s; kg/s
FULL = (
    "The clean cartridges take the pressure drop at which they are to be changed: give more of them, less "
    "flow or a higher pressure drop."
)


class CartridgeOutlets(NamedTuple):
    """Filtrate, and what the cartridges hold when they are changed, averaged over a life."""

    filtrate: Stream
    dirt: Stream


class CartridgeFigures(NamedTuple):
    """Figures of a cartridge filter."""

    flow_per_length: VolumeFlow
    pressure_drop_clean: Pressure
    removal_efficiency: Fraction
    dirt_held: Mass
    run_time: Time
    filtrate_volume: Volume


class Held(NamedTuple):
    """Flow and dirt of a length, its clean pressure drop and the mean of its life, share caught of each size
    class, life.
    """

    flow: Any
    clean: Any
    mean: Any
    share: Any
    dirt: Any
    life: Any


@equipment(
    "cartridge_filter",
    source=SOURCE,
    title="Cartridge filter",
    equation=(
        r"t = \frac{N_{10}\,m}{\dot m_{caught}},\quad "
        r"\Delta p_0 = \Delta p_r\,\frac{q_{10}\,\eta}{q_r\,\eta_w},\quad 1 - E = (1 - E_r)^{(d/d_r)^2}"
    ),
)
class CartridgeFilter(Unit):
    """Pleated or wound cartridges in a housing, counted in lengths of ten inches, that polish a liquid at
    constant flow until the dirt that they hold has raised its pressure drop to that of a change.

    Makers rate a length by its clean pressure drop with water at a flow, its dirt-holding capacity up to a
    stated pressure drop, and the removal at a size; another flow or viscosity changes the clean pressure drop
    in proportion and, with it, what is held. Removal grows with size as interception in depth has it.
    Spent cartridges leave full of ``liquid_per_length`` (voids and core of a common length, our own
    estimate), which the dirt takes along. Limits recalled, not opened.
    """

    cartridge_lengths: PositiveNumber
    particle_diameter_rated: Length
    dirt_capacity: Annotated[Mass, Within(1e-6, 1e3)]
    _: KW_ONLY
    removal_rated: Annotated[OpenFraction, Within(0.01, 0.999999)] = 0.999
    flow_rated: Annotated[VolumeFlow, Within(1e-9)] = 1.0 / HOUR
    pressure_drop_rated: PressureDrop = 1e4
    pressure_drop_capacity: PressureDrop = 2e5
    pressure_drop_change: PressureDrop = 2e5
    mass_per_length: Mass = 0.2
    liquid_per_length: Volume = 3e-4
    blocking_law: BlockingLaw = eqx.field(static=True, default="intermediate")

    limits: ClassVar[Limits] = {
        "flow": Limit("flow per 10-inch length of cartridge", 0.05, 1.2, "m^3/hour", "perry2008, § 18"),
        "clean": Limit(
            "clean pressure drop over that of a change", 0.0, 0.25, "dimensionless", "perry2008, § 18"
        ),
        "change": Limit("pressure drop at which cartridges are changed", 5e4, 3.5e5, "Pa", "perry2008, § 18"),
        "thin": Limit("solids by mass in the feed of cartridges", 0.0, 1e-4, "kg/kg", "perry2008, § 18"),
        "life": Limit("life of cartridges", 8.0, math.inf, "hour", "perry2008, § 18"),
    }

    utilities: ClassVar[Utilities] = PUMPED | {"consumption_cartridges": Utility("perry2008, § 18")}

    def inside(self, feed: Stream) -> Held:
        flow = feed.slurry_volume_flow / self.cartridge_lengths
        clean = self.pressure_drop_rated * flow / self.flow_rated * feed.liquid_viscosity / WATER
        card = type(self).card
        unsolved(clean < self.pressure_drop_change, card, reason=FULL)
        size = jnp.asarray(feed.mixture.sizes) / self.particle_diameter_rated
        share = feed.by_size(-jnp.expm1(size**2 * jnp.log1p(-self.removal_rated)))
        caught = jnp.sum(feed.solid * share) / self.cartridge_lengths
        dirt = dirt_held_blocking(
            clean,
            self.pressure_drop_change,
            self.dirt_capacity,
            self.pressure_drop_rated,
            self.pressure_drop_capacity,
            self.blocking_law,
        )
        life = jnp.where(caught > LEAST, jnp.minimum(dirt / jnp.maximum(caught, LEAST), ENDLESS), ENDLESS)
        n = EXPONENTS[self.blocking_law]
        ratio = jnp.maximum(
            self.pressure_drop_change / jnp.maximum(clean, 1e-9 * self.pressure_drop_change), 1.0
        )
        grown = safe_divide(blocked(ratio, n - 1.0), blocked(ratio, n), 1.0)
        return Held(flow, clean, clean * grown, share, dirt, life)

    def outlets(self, inside: Held, feed: Stream) -> CartridgeOutlets:
        held = self.cartridge_lengths * self.liquid_per_length / jnp.maximum(inside.life, LEAST)
        liquid = jnp.minimum(safe_divide(held, feed.liquid_volume_flow, 0.0), 1.0)
        dirt = feed.part(solid=inside.share, liquid=liquid)
        return CartridgeOutlets(
            feed.replace(solid=feed.solid - dirt.solid, liquid=feed.liquid - dirt.liquid), dirt
        )

    def figures(self, inside: Held, outlets: CartridgeOutlets, feed: Stream) -> CartridgeFigures:
        return CartridgeFigures(
            inside.flow,
            inside.clean,
            jnp.clip(safe_divide(outlets.dirt.solid_flow, feed.solid_flow, 0.0), 0.0, 1.0),
            inside.dirt,
            inside.life,
            feed.slurry_volume_flow * inside.life,
        )

    def measured(
        self, inside: Held, outlets: CartridgeOutlets, figures: CartridgeFigures, feed: Stream
    ) -> dict[str, Any]:
        return {
            "flow": HOUR * inside.flow,
            "clean": inside.clean / self.pressure_drop_change,
            "change": jnp.asarray(self.pressure_drop_change),
            "thin": safe_divide(feed.solid_flow, feed.solid_flow + feed.liquid_flow, 0.0),
            "life": inside.life / HOUR,
        }

    def drawn(
        self, inside: Held, outlets: CartridgeOutlets, figures: CartridgeFigures, feed: Stream
    ) -> dict[str, Any]:
        spent = self.cartridge_lengths * self.mass_per_length
        return {
            "electric_power_pump": pumped(feed.slurry_volume_flow, inside.mean),
            "consumption_cartridges": safe_divide(spent, inside.life, 0.0),
        }
