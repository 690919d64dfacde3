"""Size analysis by settling: pipette and balance, read by Stokes' law."""

from __future__ import annotations

from typing import Annotated, Any, NamedTuple

import jax.numpy as jnp

from granum.core import formula
from granum.core.constants import STANDARD_GRAVITY
from granum.core.kinds import Acceleration, Concentration, Density, DynamicViscosity, Fraction, Length, Series, Time
from granum.particles.formulas.sizes import equivalent_diameter_stokes

_CLAY = {"depth": (0.1, 0.3), "time": (60.0, 6000.0), "particle_density": (2000.0, 4000.0), "fluid_density": (900.0, 1100.0)}


class SedimentationSizes(NamedTuple):
    """Points of the cumulative curve by mass."""

    particle_diameter: Annotated[Length, Series("readings")]
    cumulative_fraction: Annotated[Fraction, Series("readings")]


def _slopes(x: Any, y: Any) -> Any:
    """Derivative at each point but the first: of the parabola through it and its neighbors, at the end through the last three."""
    steps, rises = jnp.diff(x), jnp.diff(y) / jnp.diff(x)
    if len(steps) == 1:
        return rises
    before, after = steps[:-1], steps[1:]
    inner = (after * rises[:-1] + before * rises[1:]) / (before + after)
    return jnp.append(inner, 2.0 * rises[-1] - inner[-1])


@formula(source="allen1997", title="Size distribution by pipette", typical=_CLAY,
         equation=r"d = \sqrt{\frac{18\eta\,h}{(\rho_p-\rho_f)g\,t}},\quad Q(d) = \frac{C(t)}{C_0}")  # fmt: skip
def size_distribution_pipette(
    time: Annotated[Time, Series("readings")],
    solids_concentration: Annotated[Concentration, Series("readings")],
    initial_concentration: Concentration,
    depth: Length,
    particle_density: Density,
    fluid_density: Density,
    dynamic_viscosity: DynamicViscosity,
    gravity: Acceleration = STANDARD_GRAVITY,
) -> SedimentationSizes:
    """Cumulative curve by mass from samples drawn at one depth of a settling suspension (Andreasen): what is finer still hangs there.

    >>> sizes = size_distribution_pipette(time="10 40 min", solids_concentration="6 2 g/L", initial_concentration="10 g/L", depth="20 cm",
    ...                                   particle_density=2700, fluid_density=1000, dynamic_viscosity="1 cP")
    >>> [round(1e6 * float(d), 2) for d in sizes.particle_diameter], [round(float(q), 3) for q in sizes.cumulative_fraction]
    ([18.97, 9.49], [0.6, 0.2])
    """
    velocity = depth / jnp.asarray(time)
    diameter = equivalent_diameter_stokes(velocity, particle_density, fluid_density, dynamic_viscosity, gravity)
    return SedimentationSizes(diameter, jnp.asarray(solids_concentration) / initial_concentration)


@formula(source="allen1997", title="Size distribution by sedimentation balance", typical=_CLAY,
         equation=r"d = \sqrt{\frac{18\eta\,h}{(\rho_p-\rho_f)g\,t}},\quad 1 - Q(d) = m - t\frac{\mathrm dm}{\mathrm dt}")  # fmt: skip
def size_distribution_balance(
    time: Annotated[Time, Series("readings")],
    deposited_fraction: Annotated[Fraction, Series("readings")],
    depth: Length,
    particle_density: Density,
    fluid_density: Density,
    dynamic_viscosity: DynamicViscosity,
    gravity: Acceleration = STANDARD_GRAVITY,
) -> SedimentationSizes:
    """Cumulative curve by mass from the share of a homogeneous suspension that lies on the pan at each time, by Odén's tangents.

    The tangent at a reading is that of the parabola through it and its neighbors, the start at zero counting as one.

    >>> sizes = size_distribution_balance(time="1 2 4 min", deposited_fraction="20 40 70 %", depth="20 cm", particle_density=2700,
    ...                                   fluid_density=1000, dynamic_viscosity="1 cP")
    >>> [round(1e6 * float(d), 1) for d in sizes.particle_diameter], [round(float(q), 3) for q in sizes.cumulative_fraction]
    ([60.0, 42.4, 30.0], [1.0, 0.967, 0.767])
    """
    t, m = jnp.asarray(time), jnp.asarray(deposited_fraction)
    slopes = _slopes(jnp.insert(t, 0, 0.0), jnp.insert(m, 0, 0.0))
    diameter = equivalent_diameter_stokes(depth / t, particle_density, fluid_density, dynamic_viscosity, gravity)
    return SedimentationSizes(diameter, 1.0 - (m - t * slopes))
