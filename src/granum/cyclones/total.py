"""Cyclones sized for a total efficiency on the size distribution of a dust, in parallel and in series."""

from __future__ import annotations

from math import ceil
from typing import Annotated, Any, NamedTuple

import jax.numpy as jnp
import numpy as np

from granum.core import procedure
from granum.core.errors import ApplicabilityError, InputError
from granum.core.i18n import _
from granum.core.kinds import (
    Density,
    DynamicViscosity,
    Fraction,
    Law,
    Length,
    OpenFraction,
    PositiveNumber,
    PressureDrop,
    Series,
    Speed,
    VolumeFlow,
    Within,
)
from granum.core.units import format_number
from granum.cyclones.formulas.efficiency import cyclone_efficiency_muschelknautz
from granum.cyclones.formulas.pressure import inlet_heads_stairmand, saltation_velocity_kalen_zenz
from granum.cyclones.geometry import StandardCyclone
from granum.cyclones.sizing import LARGEST, SMALLEST
from granum.numerics import find_root
from granum.particles.size_laws import RosinRammler

PARTS = 200  # equal parts of the dust, each at its middle size
USUAL_DUST = RosinRammler(size_modulus=2e-5, distribution_exponent=1.0)
MOST = 10_000


class CyclonePlant(NamedTuple):
    """Equal cyclones in parallel and in series that collect a wanted share of a dust."""

    diameter: Length
    parallel_number: PositiveNumber
    inlet_velocity: Speed
    pressure_drop: PressureDrop
    removal_efficiency: Fraction
    stage_efficiency: Annotated[Fraction, Series("stages")]
    saltation_velocity: Speed


@procedure(
    source="hoffmann2008; muschelknautz1972; stairmand1949",
    title="Cyclones for a total efficiency",
    typical={
        "volume_flow": (2.0, 4.0),
        "pressure_drop": (1000.0, 1500.0),
        "removal_efficiency": (0.85, 0.9),
        "particle_density": (2000.0, 3000.0),
    },
)
def cyclone_for_efficiency(
    volume_flow: VolumeFlow,
    removal_efficiency: OpenFraction,
    particle_density: Density,
    size_distribution: Annotated[Any, Law("size_distribution")] = USUAL_DUST,
    pressure_drop: PressureDrop | None = None,
    parallel_number: PositiveNumber | None = None,
    series_number: Annotated[int, Within(1, 20)] = 1,
    fluid_density: Density = 1.2,
    dynamic_viscosity: DynamicViscosity = 1.8e-5,
    cyclone_geometry: Annotated[Any, Law("cyclone_geometry")] = StandardCyclone(),
    cyclone_efficiency: Annotated[Any, Law("cyclone_efficiency")] = cyclone_efficiency_muschelknautz,
    inlet_heads: Annotated[Any, Law("inlet_heads")] = inlet_heads_stairmand,
) -> CyclonePlant:
    """Diameter, number and pressure drop of equal cyclones that collect a wanted share of a dust, stage after
    stage.

    Give either the pressure drop of the whole series, and the number in parallel is found (a whole one, which
    costs the given pressure drop and collects at least the wanted share), or the number in parallel, and the
    pressure drop is found that just collects it. Every stage has the same cyclones; the dust that leaves one
    is the feed of the next. The dust is taken as thin, so that no overload helps. The gas density is that at
    the inlet throughout.

    >>> from granum.particles.size_laws import RosinRammler
    >>> dust = RosinRammler(size_modulus="20 um", distribution_exponent=1.0)
    >>> one = cyclone_for_efficiency("2 m^3/s", 0.9, 2000.0, dust, parallel_number=4.0)
    >>> two = cyclone_for_efficiency("2 m^3/s", 0.9, 2000.0, dust, parallel_number=4.0, series_number=2)
    >>> round(one.removal_efficiency, 6), two.diameter > one.diameter
    (0.9, True)
    """
    if (pressure_drop is None) == (parallel_number is None):
        raise InputError(
            _("Give either 'pressure_drop' or 'parallel_number': the other one is found."),
            name="pressure_drop",
        )
    if series_number < 1:
        raise InputError(
            _("'series_number' must be at least 1; it is {value}.").format(value=series_number),
            name="series_number",
        )
    middle = (np.arange(PARTS) + 0.5) / PARTS
    size = size_distribution.percentile(jnp.asarray(middle))
    area = cyclone_geometry(1.0).inlet_height * cyclone_geometry(1.0).inlet_width
    heads = float(inlet_heads(*cyclone_geometry(1.0)))

    def stages(D: Any, flow: Any) -> Any:
        """Share of the dust left after each stage, the first entry before any."""
        grade = cyclone_efficiency(
            size, flow, particle_density, fluid_density, dynamic_viscosity, *cyclone_geometry(D)
        )
        return jnp.stack([jnp.mean((1.0 - grade) ** k) for k in range(series_number + 1)])

    def diameter_at(flow_of: Any) -> float:
        def off(u: Any) -> Any:
            return stages(jnp.exp(u), flow_of(jnp.exp(u)))[-1] - (1.0 - removal_efficiency)

        return float(jnp.exp(find_root(off, jnp.log(SMALLEST), jnp.log(LARGEST)).value))

    number = 1.0 if parallel_number is None else float(parallel_number)
    if pressure_drop is not None:
        v = float((2.0 * pressure_drop / series_number / (heads * fluid_density)) ** 0.5)
        D = diameter_at(lambda D: v * area * D**2)
        if D > 0.0 and volume_flow / (v * area * D**2) < MOST:
            number = float(ceil(volume_flow / (v * area * D**2) - 1e-9))
            D = float((volume_flow / (number * v * area)) ** 0.5)
    else:
        D = diameter_at(lambda D: volume_flow / number)
        v = float(volume_flow / (number * area * D**2)) if D > 0.0 else float("nan")
    if not (D > 0.0 and volume_flow / (v * area * D**2) < MOST):
        raise ApplicabilityError(
            _(
                "No such cyclone of {low} to {high} m collects {share} % of this dust: allow more "
                "pressure drop, stages or other proportions."
            ).format(low=SMALLEST, high=LARGEST, share=format_number(100.0 * removal_efficiency))
        )
    left = np.asarray(stages(D, volume_flow / number))
    salt = saltation_velocity_kalen_zenz(
        v, D, cyclone_geometry(D).inlet_width, particle_density, fluid_density, dynamic_viscosity
    )
    drop = series_number * heads * 0.5 * fluid_density * v**2
    return CyclonePlant(D, number, v, drop, float(1.0 - left[-1]), 1.0 - left[1:] / left[:-1], float(salt))
