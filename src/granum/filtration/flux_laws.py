"""Flux of a membrane against what it holds back, as measured: the laws of the family ``membrane_flux``."""

from __future__ import annotations

from typing import Annotated

import equinox as eqx
import jax.numpy as jnp

from granum.core import law, points
from granum.core.kinds import Concentration, Series, Speed, Within
from granum.numerics import falling


@law(
    "membrane_flux",
    name="measured_flux",
    source="cheryan1998",
    equation=r"u(\ln c) \text{ linear between points}\ (c_i,\ u_i)",
    symbols={"concentration_retentate": "c", "membrane_flux": "u", "concentration_points": "c_i"},
    title="Membrane flux by points",
)
class MeasuredFlux(eqx.Module):
    """Flux as measured over the concentration of what is held back, straight over its logarithm from one to
    the next.

    Two points are the straight line of the gel theory, whose slope is the transfer coefficient and whose
    zero the concentration of the gel. The order of the points does not matter. Thinner than the first it is
    that of the first; thicker than the last it goes on falling as between the last two, to nothing.

    >>> round(float(MeasuredFlux([10.0, 100.0], [2e-5, 1e-5])(50.0)) * 1e6, 3)
    13.01
    """

    concentration_points: Annotated[Annotated[Concentration, Within(1e-3)], Series("points")]
    flux_points: Annotated[Speed, Series("points")]

    def __check_init__(self) -> None:
        points.fall("flux_points", self.flux_points, "concentration_points", self.concentration_points)

    def __call__(self, concentration_retentate: Concentration) -> Speed:
        """Flux at a concentration."""
        known = jnp.log(jnp.asarray(self.concentration_points, dtype=float))
        at = jnp.log(jnp.maximum(jnp.asarray(concentration_retentate, dtype=float), 1e-12))
        return jnp.maximum(falling(at, known, self.flux_points), 0.0)
