"""A gas-fluidized bed in streams: entrainment by size class, bubbles, pressure drop, distributor, checks."""

from __future__ import annotations

from typing import Annotated, Any, ClassVar, NamedTuple

import jax.numpy as jnp

from granum.core import equipment
from granum.core.constants import STANDARD_GRAVITY
from granum.core.flags import unsolved
from granum.core.kinds import (
    Area,
    Distance,
    Fraction,
    Law,
    Mass,
    PositiveNumber,
    PressureDrop,
    Speed,
    VoidFraction,
)
from granum.core.limits import Limit
from granum.fluidization.formulas.freeboard import disengaging_height_smolders, elutriation_flux_geldart
from granum.fluidization.formulas.minimum import minimum_fluidization_velocity_wen_yu
from granum.fluidization.formulas.two_phase import two_phase_bed
from granum.numerics import find_root
from granum.numerics.smooth import safe_divide
from granum.particles.formulas.terminal import terminal_velocity
from granum.streams.pressures import pressure_left
from granum.streams.stream import Stream
from granum.streams.units import Limits, Unit, Utilities
from granum.streams.utilities import AREA, FANNED, fanned

_UNSOLVED = (
    "The overflow that leaves the bed with its mass was not found: check the solid, the gas and the area."
)
LEAST, THIN = 1e-12, 1e-3  # of a stream without gas, so that the sheet says what fails
GAS_DIFFUSIVITY = 2.5e-5  # m²/s, of water vapor in air near 20 °C: the bypass is that of a dryer


class BedOutlets(NamedTuple):
    """Gas with the entrained fines, and the solid that overflows the bed."""

    gas: Stream
    product: Stream


class BedFigures(NamedTuple):
    """Figures of a fluidized bed."""

    superficial_velocity: Speed
    minimum_fluidization_velocity: Speed
    pressure_drop: PressureDrop
    bubble_diameter: Distance
    bubble_fraction: Fraction
    height_expanded: Distance
    bypass_fraction: Fraction
    disengaging_height: Distance
    entrained_share: Fraction


class Blown(NamedTuple):
    """The gas, m/s, kg/m³ and Pa s, on a solid of that density and mean size, and the share of each species
    and size class that it takes along.
    """

    velocity: Any
    density: Any
    viscosity: Any
    solid_density: Any
    mean_size: Any
    carried: Any = None


@equipment("fluidized_bed", source="kunii1991; geldart1979", title="Fluidized bed")
class FluidizedBed(Unit):
    """Well-mixed gas-fluidized bed of fixed solid mass: every size class leaves with the gas by its
    elutriation constant, the rest overflows.

    In steady state the class of mass fraction x in the bed loses K* A x to the gas and P x with the product,
    P being whatever closes the balance. A bed that cannot keep its solid against the gas empties upwards: the
    product is then nothing. Holds above the disengaging height.
    """

    area: Area
    mass: Mass
    void_fraction: VoidFraction = 0.45
    minimum_fluidization: Annotated[Any, Law("minimum_fluidization_velocity")] = (
        minimum_fluidization_velocity_wen_yu
    )
    distributor_ratio: PositiveNumber = 0.3

    limits: ClassVar[Limits] = {
        "fluidized": Limit(
            "gas velocity over minimum fluidization velocity", 1.5, 100.0, "dimensionless", "kunii1991"
        ),
        "carried": Limit(
            "gas velocity over terminal velocity of the mean size", 0.0, 1.0, "dimensionless", "kunii1991"
        ),
        "distributor": Limit("distributor to bed pressure drop", 0.2, 0.4, "dimensionless", "kunii1991"),
    }

    utilities: ClassVar[Utilities] = FANNED | AREA

    @classmethod
    def size(
        cls,
        gas_volume_flow: Any,
        superficial_velocity: Any,
        residence_time: Any,
        solid_mass_flow: Any,
        **more: Any,
    ) -> FluidizedBed:
        """The bed that gives a gas velocity and a residence time of the solid."""
        return cls(gas_volume_flow / superficial_velocity, solid_mass_flow * residence_time, **more)

    def _blown(self, feed: Stream) -> Blown:
        volume = feed.gas_volume_flow
        density = jnp.where(volume > 0.0, safe_divide(feed.gas_flow, volume), THIN)
        mean = 1.0 / jnp.maximum(jnp.sum(feed.size_fractions / jnp.asarray(feed.mixture.sizes)), 1e-9)
        return Blown(
            jnp.maximum(volume / self.area, LEAST), density, feed.gas_viscosity, feed.solid_density, mean
        )

    def rates(self, feed: Stream, gas: Blown) -> Any:
        """Elutriation of each species and size class per mass fraction in the bed, kg/s."""
        m = feed.mixture
        density = m.densities("solids", feed.temperature)[:, None] + 0.0 * jnp.asarray(m.sizes)
        size = jnp.asarray(m.sizes) + 0.0 * density
        fall, U = terminal_velocity(size, density, gas.density, gas.viscosity), gas.velocity
        return (
            jnp.where(fall < U, elutriation_flux_geldart(U, jnp.minimum(fall, 100.0 * U), gas.density), 0.0)
            * self.area
        )

    def inside(self, feed: Stream) -> Blown:
        gas = self._blown(feed)
        rates, flows = self.rates(feed, gas), jnp.sum(feed.solid, axis=tuple(range(2, feed.solid.ndim)))
        total = jnp.maximum(jnp.sum(flows), LEAST)

        # x_i = F_i/(P + K_i); the mass fractions sum to one. With P = total the sum is at most one; with P =
        # 0 at least one, or none stays
        def surplus(P: Any) -> Any:
            return jnp.sum(flows / (P + rates + LEAST * total)) - 1.0

        emptied = surplus(0.0) <= 0.0
        root = find_root(surplus, 0.0, total, start=0.5 * total)
        overflow = jnp.where(emptied, 0.0, root.value)
        unsolved(root.converged | emptied, type(self).card, reason=_UNSOLVED)
        return gas._replace(carried=rates / (overflow + rates + LEAST * total))

    def _drop(self, gas: Blown) -> Any:
        weight = self.mass * STANDARD_GRAVITY / self.area * (1.0 - gas.density / gas.solid_density)
        return weight * (1.0 + self.distributor_ratio)

    def outlets(self, inside: Blown, feed: Stream) -> BedOutlets:
        share = inside.carried.reshape(inside.carried.shape + (1,) * len(feed.mixture.axes))
        carried = feed.solid * share
        moist = safe_divide(jnp.sum(carried), feed.solid_flow)
        gas = feed.part(solid=share, liquid=moist, gas=1.0)
        lower = pressure_left(feed, self._drop(inside), type(self).card)
        product = feed.replace(
            solid=feed.solid - carried, liquid=feed.liquid - gas.liquid, gas=0.0 * feed.gas
        )
        return BedOutlets(gas.replace(pressure=lower), product.replace(pressure=lower))

    def figures(self, inside: Blown, outlets: BedOutlets, feed: Stream) -> BedFigures:
        U, first = (
            inside.velocity,
            self.minimum_fluidization(
                inside.mean_size, inside.solid_density, inside.density, inside.viscosity
            ),
        )
        settled = self.mass / (self.area * inside.solid_density * (1.0 - self.void_fraction))
        bed = two_phase_bed(
            U,
            first,
            settled,
            GAS_DIFFUSIVITY,
            self.void_fraction,
            diameter=jnp.sqrt(4.0 * self.area / jnp.pi),
        )
        return BedFigures(
            U,
            first,
            self._drop(inside),
            bed.bubble_diameter,
            bed.bubble_fraction,
            bed.height_expanded,
            bed.bypass_fraction,
            disengaging_height_smolders(U, first, bed.bubble_diameter),
            safe_divide(outlets.gas.solid_flow, feed.solid_flow),
        )

    def measured(
        self, inside: Blown, outlets: BedOutlets, figures: BedFigures, feed: Stream
    ) -> dict[str, Any]:
        U = figures.superficial_velocity
        fall = terminal_velocity(inside.mean_size, inside.solid_density, inside.density, inside.viscosity)
        return {
            "fluidized": U / figures.minimum_fluidization_velocity,
            "carried": U / fall,
            "distributor": jnp.asarray(self.distributor_ratio),
        }

    def drawn(self, inside: Blown, outlets: BedOutlets, figures: BedFigures, feed: Stream) -> dict[str, Any]:
        return {
            "electric_power_fan": fanned(feed.gas_volume_flow, figures.pressure_drop),
            "area_installed": self.area,
        }
