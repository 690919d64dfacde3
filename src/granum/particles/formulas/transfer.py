"""Heat and mass transfer between a single particle and the fluid around it."""

from __future__ import annotations

import jax.numpy as jnp

from granum.core import formula
from granum.core.kinds import PositiveNumber, Ratio


@formula(
    source="ranz1952",
    equation=r"\mathrm{Nu} = 2 + 0.6\,\mathrm{Re}^{1/2}\,\mathrm{Pr}^{1/3}",
    fitted={"reynolds": (0.0, 200.0)},
)
def nusselt_number_ranz_marshall(reynolds: Ratio, prandtl_number: PositiveNumber) -> PositiveNumber:
    """Nusselt number of a sphere in a stream, from evaporating drops; with Schmidt for Prandtl it is the
    Sherwood number.

    Still fluid gives the exact limit of conduction into an infinite medium:

    >>> nusselt_number_ranz_marshall(reynolds=0.0, prandtl_number=0.7)
    2.0
    """
    Re, Pr = reynolds, prandtl_number
    return 2.0 + 0.6 * jnp.sqrt(jnp.maximum(Re, 1e-300)) * Pr ** (1.0 / 3.0) * (Re > 0)
