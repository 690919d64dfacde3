"""Flocculation by stirring: velocity gradient, growth and breakage of flocs in mixed tanks, and how fast a
fractal floc settles.
"""

from __future__ import annotations

import jax.numpy as jnp

from granum.core import formula
from granum.core.flags import impossible
from granum.core.kinds import (
    DynamicViscosity,
    Fraction,
    Frequency,
    PositiveNumber,
    Power,
    Ratio,
    Time,
    Volume,
)
from granum.numerics import safe_power

EMPTY = "A tank has a volume."
_TANK = {"velocity_gradient": (10.0, 100.0), "residence_time": (300.0, 3600.0)}


@formula(
    source="camp1943",
    equation=r"G = \sqrt{\frac{P}{\eta V}}",
    typical={"power": (1.0, 1000.0), "volume": (1.0, 1000.0)},
    title="Velocity gradient of a stirred tank",
    output="velocity_gradient",
)
def velocity_gradient_stirred(power: Power, volume: Volume, dynamic_viscosity: DynamicViscosity) -> Frequency:
    """Mean velocity gradient of a stirred tank from the power that the stirrer puts into the water.

    >>> round(velocity_gradient_stirred("90 W", "100 m^3", "1 mPa s"), 1)
    30.0
    """
    impossible(~(volume > 0), volume, "volume", 0.0, jnp.inf, EMPTY)
    return jnp.sqrt(jnp.maximum(power, 0.0) / (dynamic_viscosity * jnp.where(volume > 0, volume, 1.0)))


@formula(
    source="camp1943",
    equation=r"P = G^2\,\eta\,V",
    typical={"velocity_gradient": (10.0, 100.0), "volume": (1.0, 1000.0)},
    title="Power of stirring for a velocity gradient",
    output="power",
)
def power_stirring(
    velocity_gradient: Frequency, volume: Volume, dynamic_viscosity: DynamicViscosity
) -> Power:
    """Power that a stirrer must put into the water for a mean velocity gradient.

    >>> round(power_stirring(30.0, "100 m^3", "1 mPa s"))
    90
    """
    return velocity_gradient**2 * dynamic_viscosity * volume


@formula(
    source="smoluchowski1917; argaman1970",
    equation=r"K_A = \frac{4\,\psi\,\varphi}{\pi}",
    typical={"solids_volume_fraction": (1e-6, 1e-2)},
    output="aggregation_constant",
    title="Aggregation constant by collisions in shear",
)
def aggregation_constant_shear(solids_volume_fraction: Fraction, capture_efficiency: Fraction = 1.0) -> Ratio:
    """Rate of collisions that last, per velocity gradient, of equal grains in shear: what Smoluchowski's law
    makes of their volume fraction.

    Flocs hold water and fill more volume than their grains: what this tells is the least.

    >>> round(aggregation_constant_shear(1e-4, 0.5) * 1e5, 3)
    6.366
    """
    return 4.0 * capture_efficiency * solids_volume_fraction / jnp.pi


@formula(
    source="argaman1970",
    equation=(
        r"\frac{N_0}{N} = \frac{(1 + K_A G T/m)^m}{1 + K_B G^2\,\frac{T}{m}"
        r"\sum_{i=0}^{m-1}(1 + K_A G T/m)^i}"
    ),
    typical=_TANK
    | {"aggregation_constant": (1e-5, 1e-3), "breakage_constant": (1e-8, 1e-6), "tank_number": (1, 6)},
    output="flocculation_ratio",
    symbols={"residence_time": "T"},
    title="Growth of flocs in mixed tanks",
)
def flocculation_ratio_tanks(
    velocity_gradient: Frequency,
    residence_time: Time,
    aggregation_constant: Ratio,
    breakage_constant: Time,
    tank_number: PositiveNumber = 1.0,
) -> PositiveNumber:
    """Number of grains per floc after equal mixed tanks in series that share a stay: growth by collisions in
    shear, breakage by the square of the gradient.

    Both constants are found in jar tests. Without breakage and with many tanks it becomes exp(K_A G T).

    >>> round(flocculation_ratio_tanks(40.0, "30 min", 1e-4, 1e-7, 3), 3)
    15.522
    """
    m, share = tank_number, residence_time / tank_number
    step = 1.0 + aggregation_constant * velocity_gradient * share
    grown = safe_power(step, m)
    rate = aggregation_constant * velocity_gradient * share
    some = rate > 1e-9
    tanks = jnp.where(some, (grown - 1.0) / jnp.where(some, rate, 1.0), m)
    return grown / (1.0 + breakage_constant * velocity_gradient**2 * share * tanks)


@formula(
    source="jiang1991",
    equation=r"f = k^{(D_f - 1)/(2 D_f)}",
    typical={"grain_number": (1.0, 1e6), "fractal_dimension": (1.8, 2.6)},
    output="equivalent_growth",
    title="Settling size of a fractal floc",
)
def settling_growth_fractal(grain_number: PositiveNumber, fractal_dimension: Ratio = 2.2) -> PositiveNumber:
    """How many times larger the compact grain is that settles as fast as a fractal floc of so many grains,
    by Stokes' law.

    The floc is k^(1/D) times as large as its grain and its excess of density falls as size to the power
    D − 3. With D = 3 flocs are compact and the factor is the cube root of their number.

    >>> round(settling_growth_fractal(1000.0, 3.0), 6)
    10.0
    """
    D = jnp.maximum(fractal_dimension, 1.0)
    return safe_power(grain_number, (D - 1.0) / (2.0 * D))
