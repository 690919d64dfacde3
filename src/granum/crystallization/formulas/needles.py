"""Crystals whose length and width grow at rates of their own, in closed form."""

from __future__ import annotations

from granum.core import formula
from granum.core.kinds import Concentration, Density, NucleationRate, PositiveNumber, Time
from granum.crystallization.kinds import ForwardGrowthRate


@formula(
    source="puel2003; randolph1988, ch. 4",
    title="Magma density of needles",
    symbols={"growth_rate": "G_L"},
    equation=r"M_T = 6 k_v \rho_c B_0\,G_L G_W^2\,\tau^4",
    typical={
        "nucleation_rate": (1e5, 1e7),
        "growth_rate": (2e-8, 1e-7),
        "growth_rate_width": (5e-9, 3e-8),
        "residence_time": (1800.0, 7200.0),
        "volume_shape_factor": (0.7, 1.0),
    },
)
def magma_density_needles(
    nucleation_rate: NucleationRate,
    growth_rate: ForwardGrowthRate,
    growth_rate_width: ForwardGrowthRate,
    residence_time: Time,
    crystal_density: Density,
    volume_shape_factor: PositiveNumber = 1.0,
) -> Concentration:
    """Magma density of an ideal continuous crystallizer of prisms of volume k_v L W², born at size zero.

    Their mean length and width by mass are four times the growth in a residence time, and all have the aspect
    ratio of the two growth rates.

    >>> round(
    ...     magma_density_needles(
    ...         nucleation_rate=1e6,
    ...         growth_rate=4e-8,
    ...         growth_rate_width=1e-8,
    ...         residence_time=10000,
    ...         crystal_density=2000,
    ...     ),
    ...     3,
    ... )
    480.0
    """
    grown = growth_rate * growth_rate_width**2 * residence_time**3
    return 6.0 * volume_shape_factor * crystal_density * nucleation_rate * residence_time * grown
