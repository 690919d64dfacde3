"""Filter of fibers for air and mist: what it lets through of each size, its class and its life."""

from __future__ import annotations

from typing import Annotated, Any, ClassVar, NamedTuple

import jax.numpy as jnp

from granum.core import equipment
from granum.core.kinds import (
    Area,
    Concentration,
    Fraction,
    Length,
    MassPerAreaOrZero,
    MoleFraction,
    OpenFraction,
    Pressure,
    PressureDrop,
    Speed,
    Time,
    Within,
)
from granum.core.limits import Limit
from granum.dust.equipment.collector import EMISSION, Cleaned, Collector, over_axes, seen
from granum.filtration.formulas.fibers import RURAL, URBAN, fiber_efficiency_lee_liu, particulate_efficiency
from granum.filtration.formulas.gas_filters import penetration_fibers, pressure_drop_fibers
from granum.filtration.kinds import DustResistance
from granum.numerics.smooth import safe_divide
from granum.particles.formulas.slip import knudsen_number, mean_free_path, slip_factor_allen_raabe
from granum.streams.pressures import pressure_left
from granum.streams.stream import Stream
from granum.streams.units import Limits, Utilities
from granum.streams.utilities import AREA, FANNED, fanned

SOURCE = "brown1993"
AEROSOL, WATER = 1000.0, 1000.0  # kg/m³: what classes are told for, and mist where the mixture has no liquid
SLOWEST = 1e-6  # m/s
ENDLESS = 1e10  # s
LEAST = 1e-30


class AirFilterFigures(NamedTuple):
    """Figures of an air filter."""

    superficial_velocity: Speed
    pressure_drop_clean: Pressure
    removal_efficiency: Fraction
    penetration_highest: Fraction
    particle_diameter_penetrating: Length
    efficiency_pm1: Fraction
    efficiency_pm25: Fraction
    efficiency_pm10: Fraction
    run_time: Time
    dry_mass_per_area: MassPerAreaOrZero
    emission_concentration: Concentration


class Fibered(NamedTuple):
    """Velocity, clean drop, share caught of the mist and of each species and class, the worst penetration and
    its size, shares of particulate matter, run, dust per area at its end, dust in the gas.
    """

    velocity: Any
    clean: Any
    mist: Any
    share: Any
    worst: Any
    size: Any
    matter: Any
    run: Any
    held: Any
    concentration: Any


@equipment(
    "air_filter",
    source="lee1982; brown1993; davies1953; iso16890; en1822",
    title="Air and mist filter of fibers",
    equation=(
        r"P(d) = \exp\left(-\frac{4\,\beta\,E(d)\,L}{\pi\,(1-\beta)\,d_f}\right),\quad "
        r"t = \frac{\Delta p_{end} - \Delta p_0}{K_2\,U^2\,c\,(1 - P)}"
    ),
)
class AirFilter(Collector):
    """Mat of fibers of one size that catches dust and mist by diffusion, interception and inertia until the
    dust that it holds has raised its pressure drop to the final one.

    The area is that of the medium, folded or not. Efficiency is that of the clean mat without charge, which
    dust improves and discharging of electret media comes down to. Classes are told for particles of 1000
    kg/m³: the worst size for EN 1822, the shares of particulate matter for ISO 16890. Mist is of one drop
    size; it drains, and what stays in the mat is not counted. What is caught leaves as the average of a life.
    Limits recalled, not opened.
    """

    area: Area
    fiber_diameter: Annotated[Length, Within(1e-8, 1e-3)]
    fiber_fraction: Annotated[OpenFraction, Within(1e-3, 0.4)]
    mat_thickness: Annotated[Length, Within(1e-5, 1.0)]
    pressure_drop_final: PressureDrop = 450.0
    dust_resistance: DustResistance = 2e4
    droplet_diameter: Annotated[Length, Within(1e-8, 1e-3)] = 1e-6
    emission_limit: Concentration = EMISSION
    oxygen_fraction: MoleFraction | None = None
    oxygen_reference: MoleFraction | None = None

    takes_dust: ClassVar[bool] = True
    limits: ClassVar[Limits] = Collector.limits | {
        "velocity": Limit("gas velocity through the medium of an air filter", 0.005, 0.5, "m/s", SOURCE),
        "clean": Limit("clean pressure drop over the final one", 0.0, 0.6, "dimensionless", SOURCE),
        "dust": Limit("dust before an air filter", 0.0, 5e-6, "kg/m^3", SOURCE, quiet=True),
    }

    utilities: ClassVar[Utilities] = FANNED | AREA

    def inside(self, feed: Stream) -> Fibered:
        gas = seen(feed)
        U = jnp.maximum(gas.volume_flow / self.area, SLOWEST)
        moles = sum((feed.gas[i] / s.molar_mass for i, s in enumerate(feed.mixture.gases)), jnp.zeros(()))
        molar_mass = safe_divide(feed.gas_flow, moles, otherwise=feed.mixture.gases[0].molar_mass)
        path = mean_free_path.function(feed.temperature, feed.pressure, gas.viscosity, molar_mass)

        def passes(size: Any, density: Any) -> Any:
            slipping = slip_factor_allen_raabe.function(knudsen_number.function(size, path))
            one = fiber_efficiency_lee_liu.function(
                size,
                self.fiber_diameter,
                self.fiber_fraction,
                U,
                gas.viscosity,
                feed.temperature,
                density,
                slipping,
            )
            return penetration_fibers.function(
                self.mat_thickness, self.fiber_diameter, self.fiber_fraction, one
            )

        def caught(size: Any) -> Any:
            return 1.0 - passes(size, AEROSOL)

        sizes = jnp.geomspace(1e-8, 3e-6, 200)
        through = passes(sizes, AEROSOL)
        liquid = feed.liquid_density if feed.mixture.liquids else WATER
        share = 1.0 - passes(gas.size, gas.particle_density)
        clean = pressure_drop_fibers.function(
            self.mat_thickness, self.fiber_diameter, self.fiber_fraction, U, gas.viscosity
        )
        kept = safe_divide(jnp.sum(feed.solid * over_axes(share, feed)), gas.volume_flow)
        rise = jnp.maximum(self.pressure_drop_final - clean, 0.0)
        rate = self.dust_resistance * U**2 * kept
        run = jnp.where(rate > LEAST, jnp.minimum(rise / jnp.maximum(rate, LEAST), ENDLESS), ENDLESS)
        return Fibered(
            jnp.where(gas.volume_flow > 0.0, U, 0.0),
            jnp.where(gas.volume_flow > 0.0, clean, 0.0),
            1.0 - passes(jnp.asarray(self.droplet_diameter, dtype=float), liquid),
            share,
            jnp.max(through),
            sizes[jnp.argmax(through)],
            (
                particulate_efficiency(caught, 1e-6, URBAN),
                particulate_efficiency(caught, 2.5e-6, URBAN),
                particulate_efficiency(caught, 1e-5, RURAL),
            ),
            run,
            kept * U * run,
            safe_divide(feed.solid_flow, gas.volume_flow),
        )

    def outlets(self, inside: Fibered, feed: Stream) -> Cleaned:
        dust = feed.part(solid=over_axes(inside.share, feed), liquid=inside.mist)
        gas = feed.replace(solid=feed.solid - dust.solid, liquid=feed.liquid - dust.liquid)
        left = pressure_left(feed, self.mean_drop(inside), type(self).card)
        return Cleaned(gas.replace(pressure=left), dust)

    def mean_drop(self, inside: Fibered) -> Any:
        """Between clean and final."""
        mean = 0.5 * (inside.clean + jnp.maximum(inside.clean, self.pressure_drop_final))
        return jnp.where(inside.velocity > 0.0, mean, 0.0)

    def figures(self, inside: Fibered, outlets: Cleaned, feed: Stream) -> AirFilterFigures:
        carried = feed.solid_flow + feed.liquid_flow
        finest, fine, coarse = inside.matter
        return AirFilterFigures(
            inside.velocity,
            inside.clean,
            jnp.clip(safe_divide(outlets.dust.mass_flow, carried), 0.0, 1.0),
            inside.worst,
            inside.size,
            finest,
            fine,
            coarse,
            inside.run,
            inside.held,
            self.emission(outlets.gas),
        )

    def measured(
        self, inside: Fibered, outlets: Cleaned, figures: AirFilterFigures, feed: Stream
    ) -> dict[str, Any]:
        return {
            "emission": self.over_limit(figures.emission_concentration),
            "velocity": inside.velocity,
            "clean": inside.clean / self.pressure_drop_final,
            "dust": inside.concentration,
        }

    def drawn(
        self, inside: Fibered, outlets: Cleaned, figures: AirFilterFigures, feed: Stream
    ) -> dict[str, Any]:
        return {
            "electric_power_fan": fanned(feed.gas_volume_flow, self.mean_drop(inside)),
            "area_installed": self.area,
        }
