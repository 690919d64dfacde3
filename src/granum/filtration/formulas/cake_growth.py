"""Growth of a cake at constant pressure, told as the time that its first centimeter takes."""

from __future__ import annotations

import jax.numpy as jnp

from granum.core import formula, impossible
from granum.core.kinds import (
    CakeResistance,
    Concentration,
    Density,
    DynamicViscosity,
    Length,
    MediumResistance,
    PressureDrop,
    Time,
    VoidFraction,
)
from granum.filtration.formulas.constant_pressure import filtration_time_constant_pressure

CENTIMETER, BAR = 0.01, 1e5
NO_CAKE = "A filtrate without solid leaves no cake."


@formula(
    source="purchas1981; ruth1935; anlauf2019, § 6.3",
    title="Standard cake formation time",
    equation=(
        r"t_{SC} = \frac{\eta}{\Delta p\,W}\left[\frac{\alpha\,M^2}{2} + R_s M\right],\qquad "
        r"M = (1-\varepsilon)\,\rho_s\,Z_0"
    ),
    typical={
        "cake_resistance": (1e9, 1e11),
        "medium_resistance": (1e9, 1e11),
        "dry_cake_per_filtrate": (20.0, 400.0),
    },
)
def standard_cake_formation_time(
    cake_resistance: CakeResistance,
    dry_cake_per_filtrate: Concentration,
    void_fraction: VoidFraction,
    solid_density: Density,
    dynamic_viscosity: DynamicViscosity,
    medium_resistance: MediumResistance = 0.0,
    pressure_drop: PressureDrop = BAR,
    cake_thickness: Length = CENTIMETER,
) -> Time:
    """Time in which a slurry forms a cake of one centimeter at a standard pressure, from what a leaf test has
    told.

    The name and the centimeter are Purchas's, recalled and not opened; the pressure is not agreed among
    authors and stands at 1 bar here. A thicker slurry forms the same cake in less time, so that the figure
    belongs to the slurry and not to its solid. By hand: half of 10⁻³ · 10¹⁰ · 15² / (10⁵ · 100) s, with a
    solid of 3000 kg/m³ and half voids, and 15 kg/m² in the cake.

    >>> round(standard_cake_formation_time(1e10, 100.0, 0.5, 3000.0, "1 mPa*s"), 6)
    112.5
    """
    none = dry_cake_per_filtrate <= 0.0
    impossible(none, dry_cake_per_filtrate, "dry_cake_per_filtrate", 0.0, jnp.inf, NO_CAKE)
    mass = (1.0 - void_fraction) * solid_density * cake_thickness
    return filtration_time_constant_pressure(
        mass / jnp.where(none, 1.0, dry_cake_per_filtrate),
        1.0,
        pressure_drop,
        dynamic_viscosity,
        cake_resistance,
        dry_cake_per_filtrate,
        medium_resistance,
    )
