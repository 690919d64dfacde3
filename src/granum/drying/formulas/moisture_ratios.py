"""Times to a moisture ratio by diffusion, diffusivities from the slope of a drying curve, and thin-layer
models evaluated.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Annotated, Any, Literal

import jax.numpy as jnp
import numpy as np
import scipy

from granum.core import formula, procedure
from granum.core.errors import ApplicabilityError
from granum.core.i18n import _
from granum.core.kinds import Diffusivity, Fraction, Frequency, Law, Length, Ratio, Time
from granum.core.units import format_number
from granum.drying.formulas.diffusion import cylinder, plate, sphere

Model = Annotated[Any, Law("thin_layer")]
# logarithm of the Fourier number, from a moisture ratio of one to 1e-30 and less
FOURIER = (np.log(1e-20), np.log(30.0))
GRID = np.linspace(np.log(1e-6), np.log(1e7), 400)  # logarithm of the time in units of the model


@procedure(
    source="crank1975, ch. 4 to 6; mccabe2005, ch. 24",
    title="Drying time by diffusion",
    typical={"moisture_ratio": (0.05, 0.5), "half_thickness": (2e-3, 5e-3), "diffusivity": (1e-10, 1e-9)},
)
def drying_time_diffusion(
    moisture_ratio: Fraction,
    half_thickness: Length,
    diffusivity: Diffusivity,
    shape: Literal["plate", "cylinder", "sphere"] = "plate",
) -> Time:
    """Time for a body with its surface at equilibrium to come down to a mean moisture ratio by diffusion; the
    whole series, not its first term.

    ``half_thickness`` is the radius of a cylinder or sphere, and the thickness of a plate that dries from one
    side only. McCabe, example 24.2: planks of 1 inch from 25 to 5 % over equilibrium, 8.3e-6 cm²/s: 30.6 h,
    which is 4 L²/(π² D) ln(8/(π² MR)).

    >>> round(
    ...     drying_time_diffusion(moisture_ratio=0.2, half_thickness="1.27 cm", diffusivity="8.3e-6 cm^2/s")
    ...     / 3600,
    ...     1,
    ... )
    30.6
    """
    series = {"plate": plate, "cylinder": cylinder, "sphere": sphere}[shape]
    found = [
        _fourier(series, float(level)) * half_thickness**2 / diffusivity for level in np.ravel(moisture_ratio)
    ]
    return np.reshape(found, np.shape(moisture_ratio)) if np.ndim(moisture_ratio) else found[0]


def _fourier(series: Callable[[Any], Any], level: float) -> float:
    if level >= 1.0:
        return 0.0
    if level <= 0.0:
        raise ApplicabilityError(
            _("Diffusion comes to equilibrium without end: ask for a moisture ratio above zero."),
            name="moisture_ratio",
        )
    root: Any = scipy.optimize.brentq(
        lambda s: np.log(float(series(np.exp(s)))) - np.log(level), *FOURIER, xtol=1e-13
    )
    return float(np.exp(root))


@formula(
    source="crank1975, eq. 4.18",
    equation=r"D = \frac{4 k L^2}{\pi^2},\quad k = -\frac{d\ln MR}{dt}",
    typical={"rate_constant": (1e-5, 1e-3), "half_thickness": (2e-3, 5e-3)},
    title="Diffusivity from the slope for a plate",
    output="diffusivity",
)
def diffusivity_from_slope_plate(rate_constant: Frequency, half_thickness: Length) -> Diffusivity:
    """Effective diffusivity of a plate that dries from both sides, from the slope of the logarithm of its
    moisture ratio at long times.

    By hand: 0.01/min and 2.5 mm: 4 · 1.667e-4 · 6.25e-6/9.870 = 4.22e-10 m²/s.

    >>> round(diffusivity_from_slope_plate("0.01 1/min", "2.5 mm") * 1e10, 2)
    4.22
    """
    return 4.0 * rate_constant * half_thickness**2 / jnp.pi**2


@formula(
    source="crank1975, eq. 6.20",
    equation=r"D = \frac{k R^2}{\pi^2},\quad k = -\frac{d\ln MR}{dt}",
    typical={"rate_constant": (1e-5, 1e-3), "radius": (2e-3, 5e-3)},
    title="Diffusivity from the slope for a sphere",
    output="diffusivity",
    symbols={"radius": "R"},
)
def diffusivity_from_slope_sphere(rate_constant: Frequency, radius: Length) -> Diffusivity:
    """Effective diffusivity of a sphere from the slope of the logarithm of its moisture ratio at long times.

    By hand: 0.01/min and 5 mm: 1.667e-4 · 2.5e-5/9.870 = 4.22e-10 m²/s.

    >>> round(diffusivity_from_slope_sphere("0.01 1/min", "5 mm") * 1e10, 2)
    4.22
    """
    return rate_constant * radius**2 / jnp.pi**2


@procedure(
    source="page1949; henderson1961",
    typical={"time": (600.0, 3e4), "time_unit": (1.0, 3600.0)},
    title="Moisture ratio of a thin layer",
)
def moisture_ratio_thin_layer(time: Time, thin_layer: Model, time_unit: Time = 1.0) -> Ratio:
    """Moisture ratio that a thin-layer model gives after a time; ``time_unit`` is the one its constants were
    fitted in (1 min, 1 hour).

    By hand: Page with k = 0.0123 and n = 1.1 in minutes, after 60 min: exp(−0.0123 · 60^1.1) = 0.329.

    >>> round(
    ...     moisture_ratio_thin_layer(
    ...         "60 min", {"law": "thin_layer_page", "rate_constant": 0.0123, "time_exponent": 1.1}, "1 min"
    ...     ),
    ...     3,
    ... )
    0.329
    """
    ratio = np.asarray(thin_layer.ratio(jnp.asarray(time, dtype=float) / time_unit))
    return ratio if ratio.ndim else float(ratio)


@procedure(
    source="page1949; henderson1961",
    typical={"moisture_ratio": (0.05, 0.5), "time_unit": (1.0, 3600.0)},
    title="Drying time of a thin layer",
)
def drying_time_thin_layer(moisture_ratio: Fraction, thin_layer: Model, time_unit: Time = 1.0) -> Time:
    """Time at which a thin-layer model first comes down to a moisture ratio; ``time_unit`` is the one its
    constants were fitted in.

    By hand: Page with k = 0.0123 and n = 1.1 in minutes: (ln 10/0.0123)^(1/1.1) = 116.3 min to a tenth.

    >>> round(
    ...     drying_time_thin_layer(
    ...         0.1, {"law": "thin_layer_page", "rate_constant": 0.0123, "time_exponent": 1.1}, "1 min"
    ...     )
    ...     / 60,
    ...     1,
    ... )
    116.3
    """
    course = np.asarray(thin_layer.ratio(jnp.exp(GRID)))
    times = [_first(thin_layer, course, float(level)) * time_unit for level in np.ravel(moisture_ratio)]
    return np.reshape(times, np.shape(moisture_ratio)) if np.ndim(moisture_ratio) else times[0]


def _first(model: Any, course: Any, level: float) -> float:
    below = np.flatnonzero(course <= level)
    if not below.size:
        raise ApplicabilityError(
            _("The model does not come down to a moisture ratio of {level}: {lowest} is its lowest.").format(
                level=format_number(level), lowest=format_number(float(np.nanmin(course)))
            ),
            name="moisture_ratio",
        )
    at = int(below[0])
    if at == 0:
        return 0.0
    root: Any = scipy.optimize.brentq(
        lambda s: float(model.ratio(np.exp(s))) - level, GRID[at - 1], GRID[at], xtol=1e-12
    )
    return float(np.exp(root))
