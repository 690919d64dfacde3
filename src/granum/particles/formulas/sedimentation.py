"""Size analysis by settling: pipette and balance, read by Stokes' law."""

from __future__ import annotations

from typing import Annotated, Any, NamedTuple

import jax.numpy as jnp

from granum.core import formula, impossible
from granum.core.constants import STANDARD_GRAVITY
from granum.core.kinds import (
    Acceleration,
    Concentration,
    Density,
    DynamicViscosity,
    Fraction,
    Length,
    Series,
    Time,
)
from granum.particles.formulas.sizes import equivalent_diameter_stokes

_CLAY = {
    "depth": (0.1, 0.3),
    "time": (60.0, 6000.0),
    "particle_density": (2000.0, 4000.0),
    "fluid_density": (900.0, 1100.0),
}


class SedimentationSizes(NamedTuple):
    """Points of the cumulative curve by mass."""

    particle_diameter: Annotated[Length, Series("readings")]
    cumulative_fraction: Annotated[Fraction, Series("readings")]


LATER = "The times do not rise from reading to reading."
LESS = "What has settled cannot become less."


def _falling(particle_density: Any, fluid_density: Any) -> Any:
    """Whether the particles fall at all."""
    falling = jnp.asarray(particle_density) > fluid_density
    impossible(~falling, particle_density, "particle_density", fluid_density, jnp.inf)
    return falling


def _slopes(x: Any, y: Any) -> Any:
    """Derivative at each point but the first: of the parabola through it and its neighbors, at the end
    through the last three.
    """
    steps, rises = jnp.diff(x), jnp.diff(y) / jnp.diff(x)
    if len(steps) == 1:
        return rises
    before, after = steps[:-1], steps[1:]
    inner = (after * rises[:-1] + before * rises[1:]) / (before + after)
    return jnp.append(inner, 2.0 * rises[-1] - inner[-1])


@formula(
    source="allen1997; iso13317-2",
    title="Size distribution by pipette",
    fitted={"particle_diameter": (1e-6, 1e-4)},
    typical=_CLAY,
    equation=r"d = \sqrt{\frac{18\eta\,h}{(\rho_p-\rho_f)g\,t}},\quad Q(d) = \frac{C(t)}{C_0}",
    symbols={"depth": "h", "particle_diameter": "d"},
)
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
    """Cumulative curve by mass from samples drawn at one depth of a settling suspension (Andreasen): what is
    finer still hangs there.

    Used for sizes from 1 to 100 µm (ISO 13317-2).

    >>> sizes = size_distribution_pipette(
    ...     time="10 40 min",
    ...     solids_concentration="6 2 g/L",
    ...     initial_concentration="10 g/L",
    ...     depth="20 cm",
    ...     particle_density=2700,
    ...     fluid_density=1000,
    ...     dynamic_viscosity="1 cP",
    ... )
    >>> (
    ...     [round(1e6 * float(d), 2) for d in sizes.particle_diameter],
    ...     [round(float(q), 3) for q in sizes.cumulative_fraction],
    ... )
    ([18.97, 9.49], [0.6, 0.2])
    """
    falling, concentration = _falling(particle_density, fluid_density), jnp.asarray(solids_concentration)
    there = concentration <= initial_concentration
    impossible(~there, concentration, "solids_concentration", 0.0, initial_concentration)
    diameter = equivalent_diameter_stokes(
        depth / jnp.asarray(time), particle_density, fluid_density, dynamic_viscosity, gravity
    )
    return SedimentationSizes(
        jnp.where(falling, diameter, jnp.nan),
        jnp.where(falling & there, concentration / initial_concentration, jnp.nan),
    )


@formula(
    source="allen1997; iso13317-4",
    title="Size distribution by sedimentation balance",
    fitted={"particle_diameter": (1e-6, 1e-4)},
    typical=_CLAY,
    equation=(
        r"d = \sqrt{\frac{18\eta\,h}{(\rho_p-\rho_f)g\,t}},\quad 1 - Q(d) = m - t\frac{\mathrm "
        r"dm}{\mathrm dt}"
    ),
    symbols={"depth": "h", "particle_diameter": "d"},
)
def size_distribution_balance(
    time: Annotated[Time, Series("readings")],
    deposited_fraction: Annotated[Fraction, Series("readings")],
    depth: Length,
    particle_density: Density,
    fluid_density: Density,
    dynamic_viscosity: DynamicViscosity,
    gravity: Acceleration = STANDARD_GRAVITY,
) -> SedimentationSizes:
    """Cumulative curve by mass from the share of a homogeneous suspension that lies on the pan at each time,
    by Odén's tangents.

    The tangent at a reading is that of the parabola through it and its neighbors, the start at zero counting
    as one. Used for sizes from 1 to 100 µm (ISO 13317-4).

    >>> sizes = size_distribution_balance(
    ...     time="1 2 4 min",
    ...     deposited_fraction="20 40 70 %",
    ...     depth="20 cm",
    ...     particle_density=2700,
    ...     fluid_density=1000,
    ...     dynamic_viscosity="1 cP",
    ... )
    >>> (
    ...     [round(1e6 * float(d), 1) for d in sizes.particle_diameter],
    ...     [round(float(q), 3) for q in sizes.cumulative_fraction],
    ... )
    ([60.0, 42.4, 30.0], [1.0, 0.967, 0.767])
    """
    t, m = jnp.insert(jnp.asarray(time), 0, 0.0), jnp.insert(jnp.asarray(deposited_fraction), 0, 0.0)
    later, more = jnp.all(jnp.diff(t) > 0), jnp.all(jnp.diff(m) >= 0)
    impossible(~later, jnp.nan, "time", reason=LATER)
    impossible(~more, jnp.nan, "deposited_fraction", reason=LESS)
    possible = _falling(particle_density, fluid_density) & later & more
    slopes = _slopes(t, m)
    diameter = equivalent_diameter_stokes(
        depth / t[1:], particle_density, fluid_density, dynamic_viscosity, gravity
    )
    return SedimentationSizes(
        jnp.where(possible, diameter, jnp.nan), jnp.where(possible, 1.0 - (m[1:] - t[1:] * slopes), jnp.nan)
    )
