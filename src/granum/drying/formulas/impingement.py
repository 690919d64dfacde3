"""Heat transfer under arrays of slot nozzles."""

from __future__ import annotations

import jax.numpy as jnp

from granum.core import formula, watch
from granum.core.kinds import Fraction, PositiveNumber


@formula(
    source="martin1977",
    equation=(
        r"\mathrm{Nu} = \tfrac23 f_0^{3/4}\left(\frac{2\,\mathrm{Re}}{f/f_0 + f_0/f}\right)^{2/3}"
        r"\mathrm{Pr}^{0.42},\qquad f_0 = \left[60 + 4\left(\frac{H}{D} - 2\right)^2\right]^{-1/2},"
        r"\quad D = 2B"
    ),
    fitted={
        "reynolds": (1500.0, 40000.0),
        "nozzle_area_fraction": (0.008, 0.33),
        "nozzle_area_ratio": (0.0, 2.5),
        "nozzle_distance_ratio": (1.0, 40.0),
    },
    typical={
        "reynolds": (3000.0, 30000.0),
        "nozzle_area_fraction": (0.01, 0.1),
        "nozzle_distance_ratio": (2.0, 20.0),
    },
    output="nusselt_number",
    title="Impinging jets, array of slot nozzles (Martin)",
)
def nusselt_number_impinging_slots(
    reynolds: PositiveNumber,
    prandtl_number: PositiveNumber,
    nozzle_area_fraction: Fraction,
    nozzle_distance_ratio: PositiveNumber,
) -> PositiveNumber:
    """Mean Nusselt number under an array of slot nozzles of width B, on twice their width, Reynolds number on
    their outlet velocity.

    ``nozzle_area_fraction`` is slot width over pitch, ``nozzle_distance_ratio`` distance over twice the slot
    width. For a given fan power the best array of a distance H has slots of 0.1 H at a pitch of 1.4 H
    (f = 0.072).

    By hand at Re 10⁴, Pr 0.7, H/D 2 and f = f₀ = 60^−½ = 0.1291: ⅔ · 0.2154 · 464.2 · 0.861 = 57.4.

    >>> round(nusselt_number_impinging_slots(1e4, 0.7, 60**-0.5, 2.0), 1)
    57.4
    """
    f, best = nozzle_area_fraction, 1.0 / jnp.sqrt(60.0 + 4.0 * (nozzle_distance_ratio - 2.0) ** 2)
    watch(nozzle_area_ratio=f / best)
    # (f/f₀ + f₀/f)⁻¹ without a division by f
    spread = 2.0 * reynolds * f * best / (f**2 + best**2)
    return 2.0 / 3.0 * best**0.75 * spread ** (2.0 / 3.0) * prandtl_number**0.42
