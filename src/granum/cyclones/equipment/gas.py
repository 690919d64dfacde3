"""Gas cyclones in streams: dust and gas parted by a grade efficiency, class by class, with pressure drop and checks."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Annotated, Any, NamedTuple

import jax.numpy as jnp

from granum.core import equipment
from granum.core.kinds import Fraction, Law, Length, MassRatio, PositiveNumber, Pressure, PressureDrop, Speed, Within
from granum.cyclones.formulas.efficiency import (
    cut_size_muschelknautz,
    cyclone_efficiency_muschelknautz,
    limit_loading_muschelknautz,
)
from granum.cyclones.formulas.erosion import wear_velocity_cyclone_inlet
from granum.cyclones.formulas.pressure import inlet_heads_stairmand, saltation_velocity_kalen_zenz
from granum.cyclones.geometry import Dimensions, StandardCyclone
from granum.numerics.smooth import safe_divide
from granum.streams.stream import Stream
from granum.streams.units import Check, Unit

LEAST = 1e-9
MILD_STEEL = 1.2e9  # Pa, flow stress near the Vickers hardness
YEAR, ALLOWANCE = 8000.0 * 3600.0, 3.0  # s of operation, and mm of steel worn off in them
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
    wear_velocity: Speed


@equipment("gas_cyclone", source="hoffmann2008; muschelknautz1972; stairmand1949", title="Gas cyclone")
class GasCyclone(Unit):
    """One or several equal cyclones in parallel: a grade efficiency for every size class, and the overload that falls out at the inlet.

    What the swirl cannot carry (Muschelknautz' limit loading) is collected whatever its size; the rest by the grade efficiency. Liquid
    travels with the dust. The pressure drop is taken from the gas. In series: connect the gas of one to the feed of the next. The wear is
    that of a ductile wall of the given hardness, in its order of magnitude.
    """

    diameter: Length
    cyclone_geometry: Annotated[Any, Law("cyclone_geometry")] = StandardCyclone()
    parallel_number: Annotated[PositiveNumber, Within(1.0, 1000.0)] = 1.0
    cyclone_efficiency: Annotated[Any, Law("cyclone_efficiency")] = cyclone_efficiency_muschelknautz
    inlet_heads: Annotated[Any, Law("inlet_heads")] = inlet_heads_stairmand
    wall_hardness: Pressure = MILD_STEEL

    @property
    def dimensions(self) -> Dimensions:
        """Lengths of each cyclone."""
        return self.cyclone_geometry(self.diameter)

    def _flow(self, feed: Stream) -> Any:
        return jnp.maximum(feed.gas_volume_flow, LEAST) / self.parallel_number

    def _density(self, feed: Stream) -> Any:
        rho = feed.gas_density
        return jnp.where(rho > 0.0, rho, LEAST)  # without gas nothing is carried

    def _loading(self, feed: Stream) -> Any:
        return safe_divide(feed.solid_flow, feed.gas_flow)

    def _velocity(self, feed: Stream) -> Any:
        return self._flow(feed) / (self.dimensions.inlet_height * self.dimensions.inlet_width)

    def grade(self, feed: Stream) -> Any:
        """Share of each species and size class collected by the inner vortex."""
        m = feed.mixture
        density = m.densities("solids", feed.temperature)[:, None] + 0.0 * jnp.asarray(m.sizes)
        size = jnp.asarray(m.sizes) + 0.0 * density
        return self.cyclone_efficiency(size, self._flow(feed), density, self._density(feed), feed.gas_viscosity, *self.dimensions)

    def limit(self, feed: Stream) -> tuple[Any, Any]:
        """Cut size of the swirl with this dust, and the dust per gas that the swirl carries."""
        loading = self._loading(feed)
        cut = cut_size_muschelknautz(
            self._flow(feed), feed.solid_density, self._density(feed), feed.gas_viscosity, *self.dimensions, loading
        )
        below = jnp.cumsum(feed.size_fractions)
        edges = jnp.asarray(feed.mixture.edges)
        median = jnp.exp(jnp.interp(0.5, below, jnp.log(jnp.maximum(edges[1:], LEAST))))
        return cut, limit_loading_muschelknautz(jnp.maximum(loading, LEAST), cut, median)

    def collected(self, feed: Stream) -> Any:
        """Share of each species and size class collected, the overload included."""
        _cut, carried = self.limit(feed)
        loading = self._loading(feed)
        share = jnp.clip(safe_divide(carried, loading, otherwise=1.0), 0.0, 1.0)  # of the dust that stays with the gas past the inlet
        return 1.0 - share * (1.0 - self.grade(feed))

    def _pressure_drop(self, feed: Stream) -> Any:
        return self.inlet_heads(*self.dimensions) * 0.5 * self._density(feed) * self._velocity(feed) ** 2

    def __call__(self, feed: Stream) -> CycloneOutlets:
        share = self.collected(feed)
        share = share.reshape(share.shape + (1,) * len(feed.mixture.axes))
        total = safe_divide(jnp.sum(feed.solid * share), feed.solid_flow)
        dust = feed.part(solid=share, liquid=total)
        gas = feed.replace(solid=feed.solid - dust.solid, liquid=feed.liquid - dust.liquid)
        return CycloneOutlets(gas.replace(pressure=jnp.maximum(feed.pressure - self._pressure_drop(feed), 1.0)), dust)

    def results(self, inlets: Mapping[str, Stream], outlets: CycloneOutlets) -> CycloneFigures:
        feed = inlets["feed"]
        cut, carried = self.limit(feed)
        return CycloneFigures(
            self._velocity(feed), safe_divide(outlets.dust.solid_flow, feed.solid_flow), cut, self._pressure_drop(feed),
            self._saltation(feed), self._loading(feed), carried, self._wear(feed),
        )  # fmt: skip

    def _saltation(self, feed: Stream) -> Any:
        return saltation_velocity_kalen_zenz(
            self._velocity(feed), self.diameter, self.dimensions.inlet_width, feed.solid_density, self._density(feed), feed.gas_viscosity
        )

    def _wear(self, feed: Stream) -> Any:
        shape, m = self.dimensions, feed.mixture
        dust = jnp.sum(feed.solid, axis=tuple(range(2, feed.solid.ndim)))
        flux = dust / (self.parallel_number * shape.inlet_height * shape.inlet_width)
        density = m.densities("solids", feed.temperature)[:, None] + 0.0 * dust
        size = jnp.asarray(m.sizes) + 0.0 * dust
        return jnp.sum(wear_velocity_cyclone_inlet(self._velocity(feed), flux, self.diameter, shape.inlet_width, size, density,
                                                   feed.gas_viscosity, self.wall_hardness))  # fmt: skip

    def checks(self, inlets: Mapping[str, Stream], outlets: CycloneOutlets) -> tuple[Check, ...]:
        feed = inlets["feed"]
        v = self._velocity(feed)
        return (
            Check("inlet velocity", v, 10.0, 27.0, "m/s", "hoffmann2008"),
            Check("inlet velocity over saltation velocity", v / self._saltation(feed), 0.8, 1.36, "dimensionless", "kalen1974"),
            Check("wear of the wall in a year of operation", 1e3 * YEAR * self._wear(feed), 0.0, ALLOWANCE, "mm", OWN_LIMIT),
        )
