"""Porosity of packed beds: from weighing, and from the size of the column."""

from __future__ import annotations

from typing import Annotated

import jax.numpy as jnp

from granum.core import formula, impossible
from granum.core.kinds import Area, Density, Length, Mass, Ratio, VoidFraction, Within

WallRatio = Annotated[Ratio, Within(0.0, 1.0)]


@formula(
    source="carman1937",
    title="Void fraction from the mass of a bed",
    equation=r"\varepsilon = 1 - \frac{m}{\rho_s A L}",
    typical={"mass": (10.0, 100.0), "area": (0.05, 0.1), "length": (0.5, 1.0)},
)
def void_fraction_from_mass(mass: Mass, solid_density: Density, area: Area, length: Length) -> VoidFraction:
    """Porosity of a bed from its mass, section and length; no value when the solid alone would not fit.

    >>> round(void_fraction_from_mass(mass=1.59, solid_density=2650, area=0.01, length=0.1), 6)
    0.4
    """
    e = 1.0 - mass / (solid_density * area * length)
    possible = (e > 0.0) & (e < 1.0)
    impossible(~possible, mass, "mass", 0.0, solid_density * area * length)
    return jnp.where(possible, e, jnp.nan)


@formula(
    source="dixon1988",
    equation=r"\varepsilon = 0.4 + 0.05\lambda + 0.412\lambda^2\ (\lambda\le0.5),\quad 0.528 + 2.464(\lambda - 0.5)\ (\lambda\le0.536),\quad "  # noqa: E501
    r"1 - 0.667\lambda^3(2\lambda-1)^{-1/2}",
    typical={"wall_ratio": (0.0, 0.5)},
)
def void_fraction_dixon(wall_ratio: WallRatio) -> VoidFraction:
    """Porosity of a bed of equal spheres in a round column by Dixon, from particle over column diameter.

    >>> round(void_fraction_dixon(wall_ratio=0.1), 5)
    0.40912
    """
    x = wall_ratio
    narrow = 1.0 - 0.667 * x**3 / jnp.sqrt(jnp.maximum(2.0 * x - 1.0, 0.07))
    return jnp.select(
        [x <= 0.5, x <= 0.536], [0.4 + 0.05 * x + 0.412 * x**2, 0.528 + 2.464 * (x - 0.5)], narrow
    )


@formula(
    source="benyahia2005",
    equation=r"\varepsilon = 0.390 + \frac{1.740}{(1/\lambda + 1.140)^2}",
    fitted={"wall_ratio": (0.02, 0.67)},
    typical={"wall_ratio": (0.02, 0.6)},
)
def void_fraction_benyahia_oneill(wall_ratio: WallRatio) -> VoidFraction:
    """Porosity of a bed of equal spheres in a round column by Benyahia and O'Neill, from particle over column
    diameter.

    >>> round(void_fraction_benyahia_oneill(wall_ratio=0.1), 5)
    0.40402
    """
    x = wall_ratio
    return 0.390 + 1.740 * x**2 / (1.0 + 1.140 * x) ** 2
