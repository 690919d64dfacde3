"""Squeezing a cake with membranes or a piston: consolidation towards an equilibrium, by Terzaghi and with
creep by Shirato.
"""

from __future__ import annotations

from typing import Any

import jax.numpy as jnp
from jax.scipy.special import erfc

from granum.core import formula
from granum.core.kinds import Diffusivity, Fraction, Frequency, Length, PositiveNumber, Ratio, Time

EARLY = 0.3
_PRESS = {
    "time": (60.0, 1800.0),
    "consolidation_coefficient": (1e-8, 1e-7),
    "solid_volume_per_area": (2e-3, 8e-3),
    "creep_rate": (1e-4, 1e-3),
}


def _terzaghi(T: Any) -> Any:
    """Share of the whole consolidation of a layer drained on one face: early by complementary errors, late by
    the Fourier series.
    """
    early = jnp.sqrt(jnp.clip(T, 1e-30, EARLY))
    back = jnp.exp(-1.0 / early**2) / jnp.sqrt(jnp.pi) - erfc(1.0 / early) / early  # integral of erfc at 1/√T
    late = jnp.maximum(T, EARLY)
    series = sum(
        8.0 / (k * jnp.pi) ** 2 * jnp.exp(-((k * jnp.pi / 2.0) ** 2) * late) for k in (1.0, 3.0, 5.0)
    )
    return jnp.where(
        T <= EARLY, jnp.where(T > 0, 2.0 * early / jnp.sqrt(jnp.pi) - 4.0 * early * back, 0.0), 1.0 - series
    )


@formula(source="shirato1974", equation=r"T_c = \frac{i^2 C_e t}{\omega_0^2}", typical=_PRESS)
def consolidation_time(
    time: Time,
    consolidation_coefficient: Diffusivity,
    solid_volume_per_area: Length,
    drainage_faces: PositiveNumber = 1.0,
) -> Ratio:
    """Dimensionless time of consolidation of a layer with a volume of solid per area and one or two draining
    faces.

    >>> round(consolidation_time(time=600.0, consolidation_coefficient=2e-8, solid_volume_per_area="6 mm"), 4)
    0.3333
    """
    return drainage_faces**2 * consolidation_coefficient * time / solid_volume_per_area**2


@formula(
    source="shirato1974; terzaghi1943",
    equation=r"U = 1 - \sum_{N=1}^{\infty}\frac{8}{(2N-1)^2\pi^2}\exp\left[-\frac{(2N-1)^2\pi^2}{4}T_c\right]",  # noqa: E501
    typical={"consolidation_time": (0.01, 2.0)},
)
def consolidation_ratio_terzaghi(consolidation_time: Ratio) -> Fraction:
    """Share of the possible consolidation reached by squeezing, by Terzaghi: a uniform cake, drained, without
    creep.

    Terzaghi's tabulated 50 % at 0.197 and 90 % at 0.848:

    >>> [round(consolidation_ratio_terzaghi(consolidation_time=t), 3) for t in (0.197, 0.848)]
    [0.5, 0.9]
    """
    return _terzaghi(consolidation_time)


@formula(
    source="shirato1974",
    fitted={"consolidation_time": (0.1, jnp.inf)},
    equation=r"U = (1-B)\left[1 - e^{-\pi^2 T_c/4}\right] + B\left[1 - e^{-\eta t}\right]",
    typical={**_PRESS, "consolidation_time": (0.2, 2.0), "creep_share": (0.0, 0.3)},
)
def consolidation_ratio_shirato(
    consolidation_time: Ratio, time: Time, creep_share: Fraction, creep_rate: Frequency
) -> Fraction:
    """Share of the possible consolidation reached by squeezing, by Shirato: Terzaghi and Voigt, the flow-off
    and the creep of the solid.

    Late in the squeezing the first term of the series is enough; before a tenth of the time use
    ``consolidation_ratio_terzaghi``.

    >>> round(
    ...     consolidation_ratio_shirato(consolidation_time=0.8, time=900.0, creep_share=0.1, creep_rate=1e-3),
    ...     4,
    ... )
    0.8343
    """
    flowing = -jnp.expm1(-(jnp.pi**2) / 4.0 * consolidation_time)
    return (1.0 - creep_share) * flowing + creep_share * -jnp.expm1(-creep_rate * time)
