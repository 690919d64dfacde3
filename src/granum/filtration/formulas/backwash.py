"""Backwash of deep beds: the velocity that expands them, and the head it takes to lift them."""

from __future__ import annotations

from typing import Annotated

import jax.numpy as jnp

from granum.core import formula, impossible
from granum.core.kinds import (
    Amount,
    Density,
    Distance,
    DynamicViscosity,
    Length,
    OpenFraction,
    Series,
    Speed,
    Sphericity,
    VoidFraction,
)
from granum.fluidization.formulas.expansion import DILUTE, expansion_exponent, graded_bed_expansion
from granum.fluidization.formulas.minimum_beds import minimum_fluidization_velocity_ergun
from granum.numerics import find_root
from granum.particles.formulas.terminal import terminal_velocity

_SAND = {
    "particle_density": (2500.0, 2700.0),
    "fluid_density": (990.0, 1000.0),
    "dynamic_viscosity": (8e-4, 1.5e-3),
    "void_fraction_settled": (0.38, 0.45),
    "class_sizes": (5e-4, 1.5e-3),
    "bed_depth": (0.5, 1.2),
}

FINES_CARRIED = "The wash water carries the finest class off before: leave it out if it may go."


@formula(
    source="richardson1954; fair1933",
    equation=(
        r"(1-\varepsilon_0)\sum_i\frac{x_i}{1-\varepsilon_i(U_w)} = \frac{H}{H_0},\quad \varepsilon_i = "
        r"\varepsilon(U_w; d_i, \rho_p, \rho_f, \eta)"
    ),
    typical={**_SAND, "bed_expansion": (0.15, 0.3)},
    symbols={"class_sizes": "d_i", "class_fractions": "x_i", "void_fraction_settled": r"\varepsilon_0"},
)
def backwash_velocity(
    bed_expansion: OpenFraction,
    class_sizes: Annotated[Length, Series("classes")],
    class_fractions: Annotated[Amount, Series("classes")],
    particle_density: Density,
    fluid_density: Density,
    dynamic_viscosity: DynamicViscosity,
    void_fraction_settled: VoidFraction = 0.42,
    sphericity: Sphericity = 1.0,
) -> Speed:
    """Velocity of the wash water that expands a deep bed of graded grains by a share of its depth, layer by
    layer.

    Some 30 to 60 m/h for filter sand, less in cold water. The sphericity that fits the head loss of the
    settled bed is commonly left out here, which gives the higher rate. No value where the finest class would
    be carried off before the bed expands so far.

    >>> U = backwash_velocity("20 %", [0.5e-3, 0.7e-3, 1e-3], [0.3, 0.4, 0.3], 2650, 999, "1.1 cP", 0.42)
    >>> 30 < 3600 * U < 60
    True
    """

    def off(U):
        found = graded_bed_expansion(
            class_sizes,
            class_fractions,
            1.0,
            U,
            particle_density,
            fluid_density,
            dynamic_viscosity,
            void_fraction_settled,
            sphericity,
        )
        return found.bed_expansion - bed_expansion

    finest = jnp.min(jnp.where(jnp.asarray(class_fractions) > 0, jnp.asarray(class_sizes), jnp.inf))
    fall = terminal_velocity(
        finest, particle_density, fluid_density, dynamic_viscosity, sphericity=sphericity
    )
    first = minimum_fluidization_velocity_ergun(
        finest, particle_density, fluid_density, dynamic_viscosity, void_fraction_settled, sphericity
    )
    most = fall * (DILUTE * (1.0 - 1e-9)) ** expansion_exponent(fall, first, void_fraction_settled)
    impossible(off(most) < 0.0, bed_expansion, "bed_expansion", 0.0, bed_expansion + off(most), FINES_CARRIED)
    return find_root(off, 1e-6 * most, most).value


@formula(
    source="fair1933",
    title="Head loss in backwash",
    equation=r"H = L\,(1-\varepsilon_0)\frac{\rho_p - \rho_f}{\rho_f}",
    output="head_loss",
    typical=_SAND,
)
def head_loss_backwash(
    bed_depth: Distance,
    particle_density: Density,
    fluid_density: Density,
    void_fraction_settled: VoidFraction = 0.42,
) -> Distance:
    """Head of water that lifts a bed in backwash: its buoyant weight per area, whatever the expansion.

    >>> round(
    ...     head_loss_backwash(
    ...         bed_depth=1.0, particle_density=2650, fluid_density=1000, void_fraction_settled=0.4
    ...     ),
    ...     6,
    ... )
    0.99
    """
    impossible(
        ~(particle_density > fluid_density), particle_density, "particle_density", fluid_density, jnp.inf
    )
    return bed_depth * (1.0 - void_fraction_settled) * (particle_density / fluid_density - 1.0)
