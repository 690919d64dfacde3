"""Filtration under the weight of the slurry alone, its level falling: gravity filters and the first zone of a
belt press.
"""

from __future__ import annotations

from typing import Annotated, Any

import jax.numpy as jnp

from granum.core import formula, impossible, unconverged
from granum.core.constants import STANDARD_GRAVITY
from granum.core.kinds import (
    CakeResistance,
    Concentration,
    Density,
    Distance,
    DynamicViscosity,
    Fraction,
    Length,
    MediumResistance,
    Speed,
    Time,
    VoidFraction,
    Within,
)
from granum.numerics import find_root
from granum.numerics.smooth import exprel

DRY = 1.0 - 1e-9
TOO_MUCH = "The level cannot fall by more than the slurry is deep."
PACKED = "The slurry holds as much solid as its cake: there is nothing to filter."
STEEPEST = 500.0  # exponent beyond which all has settled long since
_SLURRY = {
    "filtrate_depth": (0.01, 0.05),
    "slurry_depth": (0.06, 0.2),
    "medium_resistance": (1e8, 1e10),
    "cake_resistance": (1e8, 1e10),
    "dry_cake_per_filtrate": (10.0, 50.0),
}


def _time(V: Any, h: Any, resistance: Any, medium: Any, load: Any, viscosity: Any, density: Any) -> Any:
    fallen = -jnp.log1p(-V / h)
    grown = resistance * load
    return viscosity / (density * STANDARD_GRAVITY) * ((grown * h + medium) * fallen - grown * V)


@formula(
    source="darcy1856; ruth1935",
    equation=(
        r"t = \frac{\eta}{\rho_l\,g}\left[\left(\alpha\,W\,h_0 + R_s\right)\ln\frac{h_0}{h_0 - h}"
        r" - \alpha\,W\,h\right]"
    ),
    output="filtration_time",
    title="Time of filtration under a falling head",
    typical=_SLURRY,
)
def filtration_time_falling_head(
    filtrate_depth: Distance,
    slurry_depth: Length,
    cake_resistance: CakeResistance,
    medium_resistance: MediumResistance,
    dry_cake_per_filtrate: Concentration,
    dynamic_viscosity: DynamicViscosity = 1e-3,
    liquid_density: Density = 998.0,
) -> Time:
    """Time in which the level of a slurry on a filter falls by a depth, driven by its own weight.

    What integrating Darcy's law over cake and medium gives, the head being what is left above the medium. By
    hand, without cake: half of 10 cm through 10⁹ 1/m of water takes 70.8 s.

    >>> round(filtration_time_falling_head("5 cm", "10 cm", 1e6, "1e9 1/m", 0.0), 1)
    70.8
    """
    impossible(
        ~(filtrate_depth < slurry_depth),
        filtrate_depth,
        "filtrate_depth",
        0.0,
        slurry_depth,
        TOO_MUCH,
    )
    V = jnp.minimum(filtrate_depth, DRY * slurry_depth)
    return _time(
        V,
        slurry_depth,
        cake_resistance,
        medium_resistance,
        dry_cake_per_filtrate,
        dynamic_viscosity,
        liquid_density,
    )


@formula(
    source="darcy1856; ruth1935",
    equation=(
        r"\left(\alpha\,W\,h_0 + R_s\right)\ln\frac{h_0}{h_0 - h} - \alpha\,W\,h = \frac{\rho_l\,g\,t}{\eta}"
    ),
    output="filtrate_depth",
    title="Filtrate under a falling head",
    typical=_SLURRY | {"time": (10.0, 200.0)},
)
def filtrate_depth_falling_head(
    time: Time,
    slurry_depth: Length,
    cake_resistance: CakeResistance,
    medium_resistance: Annotated[MediumResistance, Within(1e3)],
    dry_cake_per_filtrate: Concentration,
    dynamic_viscosity: DynamicViscosity = 1e-3,
    liquid_density: Density = 998.0,
) -> Distance:
    """Depth by which the level of a slurry on a filter has fallen after a time, driven by its own weight.

    >>> round(filtrate_depth_falling_head(70.83, "10 cm", 1e6, "1e9 1/m", 0.0), 3)
    0.05
    """
    root = find_root(
        lambda V: (
            _time(
                V,
                slurry_depth,
                cake_resistance,
                medium_resistance,
                dry_cake_per_filtrate,
                dynamic_viscosity,
                liquid_density,
            )
            - time
        ),
        0.0,
        DRY * slurry_depth,
        tolerance=1e-14,
    )
    all_of_it = _time(
        DRY * slurry_depth,
        slurry_depth,
        cake_resistance,
        medium_resistance,
        dry_cake_per_filtrate,
        dynamic_viscosity,
        liquid_density,
    )
    unconverged(root.converged | (time >= all_of_it))
    return jnp.where(time >= all_of_it, DRY * slurry_depth, root.value)


@formula(
    source="darcy1856; ruth1935; kynch1952, the speed of the cake's surface: joining them is our own",
    equation=(
        r"\frac{dt}{ds} = A\,h_0\left(1 - e^{-s}\right) + B + A\,v_s\,t,\quad s = \ln\frac{h_0}{h},\quad "
        r"A = \frac{\eta\,\alpha}{\rho_l\,g}\,\frac{(1-\varepsilon)\,\varphi\,\rho_s}{1-\varepsilon-\varphi},"
        r"\quad B = \frac{\eta\,R_s}{\rho_l\,g}"
    ),
    output="filtration_time",
    title="Time of filtration under a falling head, of a slurry that settles",
    typical={
        "slurry_depth": (0.06, 2.0),
        "settling_velocity": (1e-6, 1e-2),
        "solids_volume_fraction": (0.01, 0.2),
        "void_fraction": (0.4, 0.7),
        "cake_resistance": (1e8, 1e11),
        "medium_resistance": (1e8, 1e10),
    },
)
def filtration_time_settling(
    slurry_depth: Length,
    settling_velocity: Speed,
    solids_volume_fraction: Annotated[Fraction, Within(0.0, 1.0)],
    void_fraction: VoidFraction,
    cake_resistance: CakeResistance,
    medium_resistance: MediumResistance,
    solid_density: Density = 2650.0,
    dynamic_viscosity: DynamicViscosity = 1e-3,
    liquid_density: Density = 998.0,
) -> Time:
    """Time until the level of a slurry on a filter meets its cake, the solid settling on it meanwhile.

    The cake takes what filtration and settling bring, as its surface rises towards both; once all of it
    lies, clear liquid sinks through the whole cake. With no settling this is
    ``filtration_time_falling_head``; where all settles at once the whole cake stands in the way from the
    beginning. The settling velocity is that of the slurry as it is poured, hindrance included; the weight of
    the solid that hangs in the liquid is left out.

    By hand, all settled at once: 50 cm of water over 20 mm of cake, η(αM + R)/(ρg)·ln 25 with 30.74 kg/m² at
    10⁹ m/kg and 10⁹ 1/m of medium, 10 439 s.

    >>> grains = {"solids_volume_fraction": 0.0232, "void_fraction": 0.42, "cake_resistance": 1e9}
    >>> round(filtration_time_settling("50 cm", "1 m/s", medium_resistance=1e9, **grains))
    10438
    """
    share, packed = solids_volume_fraction, 1.0 - void_fraction
    impossible(~(share < packed), share, "solids_volume_fraction", 0.0, packed, PACKED)
    time, _level, _cake = sinking_slurry(
        1.0,
        slurry_depth,
        settling_velocity,
        share,
        packed,
        cake_resistance,
        medium_resistance,
        solid_density,
        dynamic_viscosity,
        liquid_density,
    )
    return time


def sinking_slurry(
    part: Any,
    deep: Any,
    velocity: Any,
    share: Any,
    packed: Any,
    resistance: Any,
    medium: Any,
    solid_density: Any,
    viscosity: Any,
    liquid_density: Any,
) -> tuple[Any, Any, Any]:
    """Times at which the logarithm of the level has come a part of its way down to the cake, the levels then
    and the cake below them.
    """
    share, weight = jnp.clip(share, 1e-12, (1.0 - 1e-6) * packed), liquid_density * STANDARD_GRAVITY
    end = share * deep / packed
    whole = viscosity / weight * (resistance * share * deep * solid_density + medium)
    growth = packed * share * solid_density / (packed - share)
    A = viscosity * resistance * growth / weight
    B = viscosity * medium / weight
    c = A * velocity

    def lasts(s: Any) -> Any:
        steep = jnp.minimum(c * s, STEEPEST)
        mounted = exprel(steep)
        return s * (B * mounted + A * deep * (mounted - jnp.exp(-s) * exprel(steep + s)))

    fallen = jnp.log(deep / end)
    # what is left above the cake, end (e^(fallen - s) - 1): the difference of depths would lose its digits
    root = find_root(
        lambda s: velocity * lasts(s) - end * jnp.expm1(fallen - s),
        0.0,
        fallen * (1.0 + 1e-9),  # where nothing settles the root is the end itself
        tolerance=1e-13,
    )
    unconverged(root.converged)
    lain = jnp.minimum(root.value, fallen)
    s = part * fallen
    times = lasts(jnp.minimum(s, lain)) + whole * jnp.maximum(s - lain, 0.0)
    level = deep * jnp.exp(-s)
    cake = share / (packed - share) * (velocity * times + deep - level)
    return times, level, jnp.where(s < lain, jnp.minimum(cake, end), end)
