"""Particles of two densities that fall together: what a classifier or a dense liquid can separate by
settling.
"""

from __future__ import annotations

from typing import Annotated

import jax.numpy as jnp

from granum.core import formula, impossible
from granum.core.kinds import Density, PositiveNumber, Within

BETWEEN = "The density of the fluid lies between those of the particles: they move in opposite directions."

Regime = Annotated[PositiveNumber, Within(0.5, 1.0)]
TYPICAL = {
    "particle_density_heavy": (4000.0, 7500.0),
    "particle_density_light": (2500.0, 3500.0),
    "fluid_density": (1000.0, 1500.0),
}


@formula(
    source="wills2016, ch. 9",
    equation=r"\frac{d_l}{d_h} = \left(\frac{\rho_h - \rho_f}{\rho_l - \rho_f}\right)^{n}",
    typical=TYPICAL,
    symbols={"particle_density_heavy": r"\rho_h", "particle_density_light": r"\rho_l"},
)
def settling_ratio(
    particle_density_heavy: Density,
    particle_density_light: Density,
    fluid_density: Density,
    settling_ratio_exponent: Regime = 0.5,
) -> PositiveNumber:
    """Diameter of a light particle over that of the heavy one that falls with it; the fluid is lighter than
    both, or heavier than both.

    The exponent is 1/2 in creeping flow and 1 in turbulent flow. In a crowd the density is that of the pulp
    (hindered settling ratio).

    Galena and quartz in water, 1.99 and 3.94 in print:

    >>> [
    ...     round(
    ...         settling_ratio(
    ...             particle_density_heavy=7500,
    ...             particle_density_light=2650,
    ...             fluid_density=1000,
    ...             settling_ratio_exponent=n,
    ...         ),
    ...         2,
    ...     )
    ...     for n in (0.5, 1.0)
    ... ]
    [1.98, 3.94]
    """
    light = jnp.asarray(particle_density_light - fluid_density, dtype=float)
    ratio = (particle_density_heavy - fluid_density) / jnp.where(light == 0.0, jnp.nan, light)
    possible = ratio > 0.0
    impossible(~possible, fluid_density, "fluid_density", reason=BETWEEN)
    return jnp.where(possible, jnp.where(possible, ratio, 1.0) ** settling_ratio_exponent, jnp.nan)


@formula(
    source="richardson2002, ch. 1",
    title="Fluid density for equal settling",
    equation=r"\rho_f = \frac{r\rho_l - \rho_h}{r - 1},\quad r = (d_l/d_h)^{1/n}",
    typical=TYPICAL | {"settling_ratio": (3.0, 6.0)},
    symbols={"particle_density_heavy": r"\rho_h", "particle_density_light": r"\rho_l"},
)
def fluid_density_equal_settling(
    settling_ratio: Annotated[PositiveNumber, Within(1.0)],
    particle_density_heavy: Density,
    particle_density_light: Density,
    settling_ratio_exponent: Regime = 0.5,
) -> Density:
    """Density of a liquid in which a light particle falls with a heavy one that is smaller by a ratio: denser
    ones separate the two.

    Quartz up to 65 µm from galena above 15 µm, 2377 and 1196 kg/m³ in print:

    >>> [
    ...     round(
    ...         fluid_density_equal_settling(
    ...             settling_ratio=65 / 15,
    ...             particle_density_heavy=7500,
    ...             particle_density_light=2650,
    ...             settling_ratio_exponent=n,
    ...         )
    ...     )
    ...     for n in (0.5, 1.0)
    ... ]
    [2377, 1195]
    """
    r = settling_ratio ** (1.0 / settling_ratio_exponent)
    density = (r * particle_density_light - particle_density_heavy) / jnp.where(r > 1.0, r - 1.0, jnp.nan)
    possible = density > 0.0
    impossible(
        ~possible,
        settling_ratio,
        "settling_ratio",
        (particle_density_heavy / particle_density_light) ** settling_ratio_exponent,
        jnp.inf,
    )
    return jnp.where(possible, density, jnp.nan)
