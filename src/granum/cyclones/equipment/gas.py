"""Gas cyclones in streams: dust and gas parted by a grade efficiency, class by class, with pressure drop and
checks.
"""

from __future__ import annotations

import math
from typing import Annotated, Any, ClassVar, NamedTuple

import jax.numpy as jnp

from granum.core import equipment
from granum.core.kinds import (
    Fraction,
    Law,
    Length,
    MassRatio,
    PositiveNumber,
    Pressure,
    PressureDrop,
    Speed,
    Within,
)
from granum.core.limits import Limit
from granum.cyclones.formulas.efficiency import (
    cut_size_muschelknautz,
    cyclone_efficiency_muschelknautz,
    limit_loading_muschelknautz,
)
from granum.cyclones.formulas.erosion import indentation_hardness_mohs, wear_velocity_cyclone_inlet
from granum.cyclones.formulas.pressure import inlet_heads_stairmand, saltation_velocity_kalen_zenz
from granum.cyclones.geometry import Dimensions, StandardCyclone
from granum.materials.library import Library
from granum.numerics.smooth import safe_divide
from granum.streams.atmosphere import EXPLOSIBLE, VENTED, explosible, vented
from granum.streams.pressures import pressure_left
from granum.streams.stream import Stream, median_of
from granum.streams.units import Limits, Unit, Utilities
from granum.streams.utilities import FANNED, fanned

LEAST = 1e-9
SIZES = (1e-8, 1e-3)  # m, between which half of a size is collected
MILD_STEEL = 1.2e9  # Pa, flow stress near the Vickers hardness
YEAR, ALLOWANCE = 8000.0 * 3600.0, 3.0  # s of operation, and mm of steel worn off in them
HARDER = 1.2  # times as hard as the wall is a grain that wears it
OWN_LIMIT = "finnie1960, the wear only: the limit of 3 mm a year is our own choice"


class CycloneOutlets(NamedTuple):
    """Gas with what escapes, and the dust collected."""

    gas: Stream
    dust: Stream


class CycloneFigures(NamedTuple):
    """Figures of a gas cyclone."""

    inlet_velocity: Speed
    removal_efficiency: Fraction
    cut_size: Length
    pressure_drop: PressureDrop
    saltation_velocity: Speed
    dust_loading: MassRatio
    limit_loading: MassRatio
    wear_velocity: Speed | None  # of dust whose hardness is known


class Swirl(NamedTuple):
    """What is known of the flow in each cyclone: inlet velocity, cut size of the law, dust per gas fed and
    carried by the swirl, saltation velocity, wear, m/s.

    ``grade``: share of each species and size class collected by the inner vortex.
    """

    velocity: Any
    cut: Any
    loading: Any
    carried: Any
    pressure_drop: Any
    saltation: Any
    wear: Any
    grade: Any


def _mohs_hardness(materials: Library, solid: str) -> float:
    return materials.solid(solid).mohs_hardness if solid in materials.names("solid") else math.nan


@equipment("gas_cyclone", source="hoffmann2008; muschelknautz1972; stairmand1949", title="Gas cyclone")
class GasCyclone(Unit):
    """One or several equal cyclones in parallel: a grade efficiency for every size class, and the overload
    that falls out at the inlet.

    What the swirl cannot carry (Muschelknautz' limit loading) is collected whatever its size; the rest by
    the grade efficiency. Liquid travels with the dust. The pressure drop is taken from the gas. In
    series: connect the gas of one to the feed of the next. The wear is that of a ductile wall of the
    given hardness by solids that are harder, in its order of magnitude, and not told where no solid has a
    ``mohs_hardness`` in its material; grains less than 1.2 times as hard as the wall (Hutchings) do not
    count. An ``explosion_vent`` is that of one cyclone.
    """

    diameter: Length
    cyclone_geometry: Annotated[Any, Law("cyclone_geometry")] = StandardCyclone()
    parallel_number: Annotated[PositiveNumber, Within(1.0, 1000.0)] = 1.0
    cyclone_efficiency: Annotated[Any, Law("cyclone_efficiency")] = cyclone_efficiency_muschelknautz
    inlet_heads: Annotated[Any, Law("inlet_heads")] = inlet_heads_stairmand
    wall_hardness: Pressure = MILD_STEEL
    explosion_vent: Annotated[Any, Law("explosion_vent")] = None

    takes_dust: ClassVar[bool] = True
    limits: ClassVar[Limits] = {
        "velocity": Limit("inlet velocity", 10.0, 27.0, "m/s", "hoffmann2008"),
        "saltation": Limit("inlet velocity over saltation velocity", 0.8, 1.36, "dimensionless", "kalen1974"),
        "wear": Limit("wear of the wall in a year of operation", 0.0, ALLOWANCE, "mm", OWN_LIMIT, quiet=True),
    } | (EXPLOSIBLE | VENTED)

    utilities: ClassVar[Utilities] = FANNED

    @property
    def dimensions(self) -> Dimensions:
        """Lengths of each cyclone."""
        return self.cyclone_geometry(self.diameter)

    def _half_collected(self, flow: Any, dust: Any, density: Any, viscosity: Any, shape: Dimensions) -> Any:
        """Size of which the chosen law collects one half, between two of a fine series of sizes."""
        sizes = jnp.geomspace(*SIZES, 501)
        grade = self.cyclone_efficiency(sizes, flow, dust, density, viscosity, *shape)
        return jnp.exp(jnp.interp(0.5, grade, jnp.log(sizes)))

    def inside(self, feed: Stream) -> Swirl:
        m, shape, viscosity, dust = feed.mixture, self.dimensions, feed.gas_viscosity, feed.solid_density
        volume = feed.gas_volume_flow
        flow = jnp.maximum(volume, LEAST) / self.parallel_number
        # without gas nothing is carried
        density = jnp.where(volume > 0.0, safe_divide(feed.gas_flow, volume), LEAST)
        velocity = flow / (shape.inlet_height * shape.inlet_width)
        loading = safe_divide(feed.solid_flow, feed.gas_flow)
        each = m.densities("solids", feed.temperature)[:, None] + 0.0 * jnp.asarray(m.sizes)
        size = jnp.asarray(m.sizes) + 0.0 * each
        cut = cut_size_muschelknautz(flow, dust, density, viscosity, *shape, loading)
        median = jnp.maximum(median_of(feed.size_fractions, m.edges), LEAST)
        saltation = saltation_velocity_kalen_zenz(
            velocity, self.diameter, shape.inlet_width, dust, density, viscosity
        )
        flux = jnp.sum(feed.solid, axis=tuple(range(2, feed.solid.ndim))) / (
            self.parallel_number * shape.inlet_height * shape.inlet_width
        )
        mohs = [_mohs_hardness(m.materials, s.name) for s in m.solids]
        worn = wear_velocity_cyclone_inlet(
            velocity, flux, self.diameter, shape.inlet_width, size, each, viscosity, self.wall_hardness
        )
        known = ~jnp.isnan(jnp.asarray(mohs))
        hardness = indentation_hardness_mohs(jnp.clip(jnp.where(known, jnp.asarray(mohs), 1.0), 1.0, 9.0))
        wears = known & (hardness >= HARDER * self.wall_hardness)
        wear = jnp.sum(jnp.where(wears[:, None], worn, 0.0)) if not all(map(math.isnan, mohs)) else None
        return Swirl(
            velocity,
            cut
            if self.cyclone_efficiency is cyclone_efficiency_muschelknautz
            else self._half_collected(flow, dust, density, viscosity, shape),
            loading,
            limit_loading_muschelknautz(jnp.maximum(loading, LEAST), cut, median),
            self.inlet_heads(*shape) * 0.5 * density * velocity**2,
            saltation,
            wear,
            self.cyclone_efficiency(size, flow, each, density, viscosity, *shape),
        )

    def outlets(self, inside: Swirl, feed: Stream) -> CycloneOutlets:
        # of the dust that stays with the gas past the inlet
        passes = jnp.clip(safe_divide(inside.carried, inside.loading, otherwise=1.0), 0.0, 1.0)
        share = 1.0 - passes * (1.0 - inside.grade)
        share = share.reshape(share.shape + (1,) * len(feed.mixture.axes))
        total = safe_divide(jnp.sum(feed.solid * share), feed.solid_flow)
        dust = feed.part(solid=share, liquid=total)
        gas = feed.replace(solid=feed.solid - dust.solid, liquid=feed.liquid - dust.liquid)
        return CycloneOutlets(
            gas.replace(pressure=pressure_left(feed, inside.pressure_drop, type(self).card)), dust
        )

    def figures(self, inside: Swirl, outlets: CycloneOutlets, feed: Stream) -> CycloneFigures:
        return CycloneFigures(
            inside.velocity,
            safe_divide(outlets.dust.solid_flow, feed.solid_flow),
            inside.cut,
            inside.pressure_drop,
            inside.saltation,
            inside.loading,
            inside.carried,
            inside.wear,
        )

    def measured(
        self, inside: Swirl, outlets: CycloneOutlets, figures: CycloneFigures, feed: Stream
    ) -> dict[str, Any]:
        return (
            explosible(feed)
            | vented(feed, self.explosion_vent)
            | {
                "velocity": inside.velocity,
                "saltation": inside.velocity / inside.saltation,
                "wear": 0.0 if inside.wear is None else 1e3 * YEAR * inside.wear,
            }
        )

    def drawn(
        self, inside: Swirl, outlets: CycloneOutlets, figures: CycloneFigures, feed: Stream
    ) -> dict[str, Any]:
        return {"electric_power_fan": fanned(feed.gas_volume_flow, inside.pressure_drop)}
