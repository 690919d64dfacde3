"""Spray dryer: a feed broken into drops that dry while they fall with hot gas through a chamber."""

from __future__ import annotations

from dataclasses import replace
from math import pi
from typing import Annotated, Any, ClassVar, Literal

import jax.numpy as jnp
from jax.scipy.special import gammaln

from granum.core import equipment
from granum.core.constants import STANDARD_GRAVITY
from granum.core.kinds import (
    Density,
    DynamicViscosity,
    Law,
    Length,
    PositiveNumber,
    Ratio,
    SurfaceTension,
    Temperature,
    TemperatureDifference,
    Within,
)
from granum.core.limits import Limit
from granum.core.utilities import Utility
from granum.drying.equipment.atomizers import Liquor
from granum.drying.formulas.moisture import glass_transition_temperature, sticking_share_particle_gun
from granum.drying.gas_solid.airborne import dried_on
from granum.drying.gas_solid.cells import Inlet, Network
from granum.drying.gas_solid.conveyed import Path, convey, drop_ratio, liquid_density
from granum.drying.gas_solid.dryer import NOTES, Dried, Dryer, DryerFigures, Through, parted, ready, sized
from granum.drying.gas_solid.kinetics import AbstractKinetics
from granum.drying.gas_solid.liquor import composition, counted, moistened
from granum.drying.gas_solid.matter import Matter
from granum.drying.kinds import LostHeat, PerTemperature
from granum.numerics import safe_divide
from granum.streams.atmosphere import VENTED
from granum.streams.equilibrium import HumidMixture
from granum.streams.fines import fall, held, lifted
from granum.streams.fines import parted as parted_fines
from granum.streams.stream import Stream
from granum.streams.units import Limits, Utilities
from granum.streams.utilities import driven

TABLE = NOTES.format(table="IV.2")
GROWTH = 1.08  # of the cells from the atomizer on
LEAST = 1e-9  # kg/s of feed, of an atomizer that runs dry


@equipment("spray_dryer", source="masters1991; chen2008rea; langrish2009", title="Spray dryer")
class SprayDryer(Dryer):
    """Drops of a Rosin–Rammler spread around the atomizer's Sauter mean fall with the gas, shrink while they
    are full drops, and dry.

    The size classes of the mixture are those of the dry particles; the solid of the feed, dissolved or
    suspended, is shared out over them. ``gas_dispersion`` mixes the gas along the chamber: exchange flow
    between cells over through-flow, up to some tens; plug flow without it. With ``entrainment`` the exhaust
    takes fines along, by their terminal velocity against the gas in the section; else all powder falls out.
    Where the gas rises against the spray (``gas_direction``, as for detergents) it always takes along what
    falls, dry, slower than it enters; that dries in the exhaust, down to equilibrium with it, and the rest
    falls through ever hotter gas.
    Fines that come back at the port ``fines`` all stick to drops at the atomizer, in proportion to these: the
    agglomerates are larger and start less wet. An ``explosion_vent`` is that of the chamber. With the glass
    transition of the dry solid a check tells how much of the powder would stay where it meets a wall; how
    much of it meets one is left out, and so is what it leaves there. A bed that dries on, inside the chamber
    or behind it, is a unit of its own: the product goes to it, its exhaust joins that of the tower.
    """

    length: Length
    diameter: Length
    atomizer: Annotated[Any, Law("atomizer")]
    kinetics: Annotated[Any, Law("drying_kinetics")]
    dry_density: Density = 1000.0
    drop_exponent: PositiveNumber = 2.5
    gas_dispersion: Ratio | None = None
    dynamic_viscosity: DynamicViscosity = 0.01
    surface_tension: SurfaceTension = 0.06
    heat_loss: LostHeat = 0.0
    temperature_limit: Temperature | None = None
    cells: Annotated[int, Within(1, 2000)] = 50
    entrainment: bool = False
    gas_direction: Literal["co-current", "counter-current"] = "co-current"
    explosion_vent: Annotated[Any, Law("explosion_vent")] = None
    glass_transition_temperature_dry: Temperature | None = None
    gordon_taylor_constant: PositiveNumber = 6.7
    sticking_margin: TemperatureDifference = 33.6
    sticking_slope: PerTemperature = 0.031

    dust_dries_on = False  # it has flown with the gas all along

    limits: ClassVar[Limits] = (
        Dryer.limits
        | {
            "inlet": Limit("gas temperature at the inlet", 373.15, 873.15, "K", TABLE),
            "outlet": Limit("gas temperature at the outlet", 333.15, 473.15, "K", TABLE),
            "time": Limit("residence time of the gas", 10.0, 30.0, "s", TABLE),
            "capacity": Limit(
                "water evaporated per volume and hour", 1.0, 30.0, "kg/(hour*m^3)", TABLE, quiet=True
            ),
            "flown": Limit(
                "share of the solid that the rising gas takes along",
                0.0,
                0.1,
                "dimensionless",
                "our own estimate, twice the 45 kg a tonne of ap42_1995, ch. 6.8 (recalled)",
            ),
            "sticks": Limit(
                "share of what meets a wall that stays on it",
                0.0,
                0.1,
                "dimensionless",
                "murti2009, that some is swept off is our own estimate",
            ),
            "slender": Limit("height over diameter of the chamber", 0.6, 5.0, "dimensionless", "masters1991"),
        }
        | VENTED
    )

    utilities: ClassVar[Utilities] = Dryer.utilities | {"electric_power_atomizer": Utility("masters1991")}

    def extent(self) -> Any:
        return self.section * self.length

    @property
    def section(self) -> Any:
        """Of the chamber."""
        return 0.25 * pi * self.diameter**2

    def liquor(self, feed: Stream, gas: Stream) -> Liquor:
        """The feed as the atomizer meets it."""
        flow = feed.solid_flow + feed.liquid_flow
        return Liquor(
            jnp.maximum(flow, LEAST),
            safe_divide(flow, feed.slurry_volume_flow, otherwise=self.dry_density),
            self.dynamic_viscosity,
            self.surface_tension,
            gas.gas_density,
        )

    def shares(self, feed: Stream, gas: Stream, growth: Any = 1.0) -> Any:
        """Solid in each class of dry particles, from the volume distribution of the drops, each particle
        larger by a ratio than its drop makes it.
        """
        mean = self.atomizer.sauter(self.liquor(feed, gas))
        modulus = mean * jnp.exp(gammaln(1.0 - 1.0 / self.drop_exponent))
        wet = drop_ratio(self.dry_density, feed.solid_density, liquid_density(feed), feed.moisture_dry_basis)
        edges = jnp.asarray(feed.mixture.size_edges) * wet / growth
        below = -jnp.expm1(-((edges / modulus) ** self.drop_exponent))
        return jnp.diff(below.at[0].set(0.0).at[-1].set(1.0))

    def atomized(self, feed: Stream, gas: Stream, fines: Stream | None) -> Stream:
        """Feed and fines as dry matter and water, the solid in the classes of the dry particles."""
        dry, whole = counted(feed), counted(charge(feed, fines))
        growth = jnp.cbrt(safe_divide(whole.solid_flow, dry.solid_flow, 1.0))
        shares = self.shares(dry, gas, growth)
        return whole.regraded(jnp.broadcast_to(shares[:, None], (shares.shape[0], shares.shape[0])))

    @property
    def against(self) -> bool:
        """Whether the gas rises."""
        return self.gas_direction == "counter-current"

    def flying(self, solid: Stream, gas: Stream) -> Any:
        """Share of each species and size class that a rising gas takes along: what falls, dry, slower than it
        enters. Higher up it is cooler and slower.
        """
        return 1.0 * lifted(fall(solid, gas, self.dry_density), gas, self.section)

    def charged(self, feed: Stream, gas: Stream, fines: Stream | None = None) -> Stream:
        drops = self.atomized(feed, gas, fines)
        return parted_fines(drops, self.flying(drops, gas))[0] if self.against else drops

    def path(self, feed: Stream, gas: Stream) -> Path:
        """The chamber, with short cells where the drops are fast. Classes that fly take no part."""
        growth = GROWTH ** jnp.arange(self.cells)
        sizes = jnp.asarray(feed.mixture.sizes)
        if self.against:
            sizes = jnp.where(self.flying(feed, gas)[0] > 0.0, sizes[-1], sizes)
        return Path(
            self.length * growth / jnp.sum(growth),
            self.section,
            STANDARD_GRAVITY,
            self.atomizer.launch(self.liquor(feed, gas)),
            sizes,
            self.dry_density,
            feed.solid_density,
            liquid_density(feed),
            True,
            -1.0 if self.against else 1.0,
        )

    def through(self, feed: Stream, gas: Stream, fines: Stream | None = None) -> Through:
        return _sprayed(self, feed, gas, fines)

    def outlets(self, inside: Through, feed: Stream, gas: Stream, fines: Stream | None = None) -> Dried:
        drops, dissolved = self.atomized(feed, gas, fines), composition(charge(feed, fines))
        if not self.against:
            return self.dusted(parted(drops, dissolved, gas, inside.profile), inside.profile)
        falling, dust = parted_fines(drops, self.flying(drops, gas))
        made = parted(falling, dissolved, gas, inside.profile)
        flown, exhaust = dried_on(moistened(dust, dust.liquid[0], dissolved), made.exhaust, self.kinetics)
        return made._replace(exhaust=exhaust + flown)

    def entrained(self, product: Stream, exhaust: Stream) -> Any:
        """What the gas in the section of the chamber holds against its fall, kept evenly mixed by
        turbulence.
        """
        if not self.entrainment:
            return None
        return held(fall(product, exhaust, self.dry_density), exhaust, self.section)

    @classmethod
    def size(
        cls,
        moisture_outlet: Any,
        feed: Stream,
        gas: Stream,
        diameter: Any,
        atomizer: Any,
        kinetics: AbstractKinetics,
        **more: Any,
    ) -> SprayDryer:
        """The chamber as high as a product moisture needs."""
        return sized(
            cls(5.0, diameter, atomizer, kinetics, **more), "length", moisture_outlet, 0.05, 200.0, feed, gas
        )

    def figures(
        self, inside: Through, outlets: Dried, feed: Stream, gas: Stream, fines: Stream | None = None
    ) -> DryerFigures:
        found = super().figures(inside, outlets, charge(feed, fines), gas)
        if not self.against:
            return found
        fallen = outlets.product.solid_flow
        return found._replace(residence_time=safe_divide(inside.holdup, fallen))

    def measured(
        self,
        inside: Through,
        outlets: Dried,
        figures: DryerFigures,
        feed: Stream,
        gas: Stream,
        fines: Stream | None = None,
    ) -> dict[str, Any]:
        whole = charge(feed, fines)
        blown = outlets.exhaust.solid_flow - gas.solid_flow
        flown = {"flown": safe_divide(blown, blown + outlets.product.solid_flow)} if self.against else {}
        return (
            super().measured(inside, outlets, figures, whole, gas)
            | flown
            | self._sticking(inside)
            | {
                "inlet": gas.temperature,
                "outlet": outlets.exhaust.temperature,
                "time": self.extent() / outlets.exhaust.gas_volume_flow,
                "capacity": self.hourly(figures),
                "slender": jnp.asarray(self.length / self.diameter),
            }
        )

    def _sticking(self, inside: Through) -> dict[str, Any]:
        """How much of the classes, as they end their fall, stays on a wall that they meet."""
        dry = self.glass_transition_temperature_dry
        if dry is None:
            return {}
        end = inside.profile
        there = jnp.where(end.leaves[:, None], end.shares, 0.0)
        glass = glass_transition_temperature.function(end.moisture, dry, self.gordon_taylor_constant)
        stays = sticking_share_particle_gun.function(
            end.temperature, glass, self.sticking_margin, self.sticking_slope
        )
        return {"sticks": safe_divide(jnp.sum(there * stays), jnp.sum(there))}

    def drawn(
        self,
        inside: Through,
        outlets: Dried,
        figures: DryerFigures,
        feed: Stream,
        gas: Stream,
        fines: Stream | None = None,
    ) -> dict[str, Any]:
        return super().drawn(inside, outlets, figures, feed, gas) | {
            "electric_power_atomizer": driven(self.atomizer.shaft_power(self.liquor(feed, gas)))
        }


def charge(feed: Stream, fines: Stream | None) -> Stream:
    """What is dried: the feed with the fines that stick to its drops."""
    return feed if fines is None else feed + fines


@ready
def _sprayed(dryer: SprayDryer, feed: Stream, gas: Stream, fines: Stream | None) -> Through:
    whole = charge(feed, fines)
    dry, drops = counted(whole), dryer.atomized(feed, gas, fines)
    X = jnp.full(len(feed.mixture.sizes), 1.0) * dry.moisture_dry_basis
    matter = replace(Matter.of(drops, gas), dissolved=composition(whole))
    inlet = Inlet(
        X,
        jnp.full_like(X, 1.0) * whole.temperature,
        HumidMixture(gas.mixture).vapor_per_carrier(gas),
        gas.temperature,
    )
    network = (Network.counter_current if dryer.against else Network.co_current)(dryer.cells)
    if dryer.gas_dispersion is not None:
        network = network.dispersed(dryer.gas_dispersion)
    return Through(
        *convey(
            dryer.path(counted(feed), gas),
            matter,
            dryer.kinetics,
            gas,
            inlet,
            dryer.charged(feed, gas, fines).solid_by_size,
            network,
            dryer.heat_loss,
        )
    )
