"""Breakthrough of beds of activated carbon: a front of constant shape that wanders with the loading."""

from __future__ import annotations

from typing import Annotated

import jax
import jax.numpy as jnp

from granum.core import formula
from granum.core.kinds import Density, Fraction, Length, MolarMass, OpenFraction, Ratio, Speed, Time, Within
from granum.filtration.kinds import AdsorptionRate, LoadingScale, ReferenceConcentration

_BED = {
    "contact_time_bed": (0.1, 1800.0),
    "concentration_inlet": (1e-4, 1e-2),
    "adsorbate_loading": (0.02, 0.4),
    "bed_density": (400.0, 550.0),
    "adsorption_rate": (0.05, 100.0),
    "superficial_velocity": (0.1, 0.5),
    "particle_diameter": (1e-3, 4e-3),
    "molar_mass": (0.03, 0.2),
    "time": (3600.0, 1e7),
}


@formula(
    source="wheeler1969; jonas1974; lodewyckx2004",
    equation=(r"t = \frac{q\,\rho_b}{c}\left[\tau - \frac{1}{k_v}\ln\frac{1 - x_b}{x_b}\right]"),
    output="run_time",
    title="Time until a carbon bed breaks through",
    typical=_BED,
)
def breakthrough_time_wheeler_jonas(
    contact_time_bed: Time,
    concentration_inlet: ReferenceConcentration,
    adsorbate_loading: LoadingScale,
    bed_density: Density,
    adsorption_rate: AdsorptionRate,
    breakthrough_fraction: OpenFraction = 0.05,
) -> Time:
    """Time until the concentration behind a bed of activated carbon reaches a share of that before it, by
    Wheeler and Jonas.

    The contact time is that of the empty bed. Zero where the bed is shallower than the front: it breaks
    through at once. Solid and gas are taken as in equilibrium with the feed behind the front, at one
    temperature. Sources not opened beyond the abstract of the last; the equation is that of Bohart and Adams
    for all but the shallowest beds, which the tests integrate.

    By hand, 50 %: only the capacity counts, 0.2·450·1/0.001.

    >>> round(breakthrough_time_wheeler_jonas(1.0, 1e-3, 0.2, 450.0, 50.0, 0.5))
    90000
    """
    x = breakthrough_fraction
    span = contact_time_bed - (jnp.log1p(-x) - jnp.log(x)) / adsorption_rate
    return adsorbate_loading * bed_density / concentration_inlet * jnp.maximum(span, 0.0)


@formula(
    source="bohart1920; lodewyckx2004",
    equation=(r"x_b = \frac{1}{1 + \exp\left[k_v\left(\tau - \frac{c\,t}{q\,\rho_b}\right)\right]}"),
    output="breakthrough_fraction",
    title="Breakthrough curve of a carbon bed",
    typical=_BED,
)
def breakthrough_fraction_bohart_adams(
    time: Time,
    contact_time_bed: Time,
    concentration_inlet: ReferenceConcentration,
    adsorbate_loading: LoadingScale,
    bed_density: Density,
    adsorption_rate: AdsorptionRate,
) -> Fraction:
    """Concentration behind a bed of activated carbon over that before it, after a time, by Bohart and Adams.

    The curve of Thomas for an isotherm that lies flat; the same as that of Wheeler and Jonas. The first
    source was not opened; the tests integrate its two equations along the bed.

    >>> round(breakthrough_fraction_bohart_adams(9e4, 1.0, 1e-3, 0.2, 450.0, 50.0), 3)
    0.5
    """
    passed = concentration_inlet * time / (adsorbate_loading * bed_density)
    return jax.nn.sigmoid(-adsorption_rate * (contact_time_bed - passed))


@formula(
    source="wood1993; lodewyckx2004",
    equation=(
        r"k_v = 800\,\beta^{0.33}\,U^{0.75}\,d_p^{-1.5}\sqrt{q/M}\quad"
        r"[\mathrm{min^{-1},\ cm/s,\ cm,\ g/mol}]"
    ),
    output="adsorption_rate",
    title="Rate of adsorption of a vapor on carbon",
    typical=_BED | {"affinity_coefficient": (0.4, 1.5)},
)
def adsorption_rate_lodewyckx(
    superficial_velocity: Annotated[Speed, Within(1e-4, 1e2)],
    particle_diameter: Annotated[Length, Within(1e-5, 0.1)],
    adsorbate_loading: LoadingScale,
    molar_mass: MolarMass,
    affinity_coefficient: Annotated[Ratio, Within(0.1, 5.0)] = 1.0,
) -> AdsorptionRate:
    """Rate coefficient of Wheeler and Jonas for organic vapors on granular carbon, by Lodewyckx and others.

    The affinity coefficient is that of Dubinin against benzene. Recalled, the body of the sources was not
    opened; the unit of the constant goes with those under the equation.

    By hand, 800·√(0.3/78) at 1 cm/s on grains of 1 cm: 49.6 a minute.

    >>> round(60 * adsorption_rate_lodewyckx("1 cm/s", "1 cm", 0.3, "78 g/mol"), 1)
    49.6
    """
    v, d, M = 100.0 * superficial_velocity, 100.0 * particle_diameter, 1e3 * molar_mass
    per_minute = 800.0 * affinity_coefficient**0.33 * v**0.75 * d**-1.5 * jnp.sqrt(adsorbate_loading / M)
    return per_minute / 60.0
