"""Void fraction and height of a fluidized bed: liquids by three authors; void fraction from mass, height and
pressure drop.
"""

from __future__ import annotations

from math import inf
from typing import Annotated, Any, NamedTuple

import jax.numpy as jnp

from granum.core import formula, impossible, limit_active, watch
from granum.core.constants import STANDARD_GRAVITY
from granum.core.kinds import (
    Acceleration,
    Amount,
    Area,
    Density,
    DynamicViscosity,
    Fraction,
    Length,
    Mass,
    PositiveNumber,
    PressureDrop,
    Ratio,
    Series,
    Speed,
    Sphericity,
    VoidFraction,
    Within,
)
from granum.fluidization.formulas.buoyancy import archimedes, excess
from granum.fluidization.formulas.minimum_beds import minimum_fluidization_velocity_ergun
from granum.particles.definitions import ARCHIMEDES, GALILEO, reynolds_of
from granum.particles.formulas.terminal import terminal_velocity

MORE_THAN_SOLID = "The layer would weigh more than one without voids."
LIQUID = {"particle_diameter": (1e-3, 3e-3), "superficial_velocity": (0.03, 0.08)}
DILUTE = 0.95  # void fraction above which grains no longer lie in a layer with a surface
CARRIED = (
    "The velocity is above the terminal velocity: the grains are carried away and no bed remains; its void "
    "fraction is given as 1."
)
CLASS_CARRIED = (
    "These sizes are carried off: their layer would have a void fraction above 0.95. They are left out of "
    "the height of the bed."
)
ALL_CARRIED = "The liquid carries every class off: no bed remains. Lower the velocity."
BED = {"mass": (40.0, 60.0), "area": (0.05, 0.1), "length": (0.8, 1.2), "height": (0.8, 1.2)}


def _carried(e: Any) -> Any:
    """A void fraction that reaches 1 means transport: cut there, with a flag."""
    limit_active(e >= 1.0, e, "void_fraction", CARRIED)
    return jnp.minimum(e, 1.0)


@formula(
    source="richardson1954",
    equation=r"\varepsilon = (U/v_t)^{1/n}",
    output="bed_void_fraction",
    fitted={"bed_void_fraction": (0.4, 1.0)},
    typical={
        "superficial_velocity": (0.03, 0.05),
        "terminal_velocity": (0.1, 0.3),
        "settling_exponent": (2.4, 4.7),
    },
)
def bed_void_fraction_richardson_zaki(
    superficial_velocity: Speed,
    terminal_velocity: Speed,
    settling_exponent: Annotated[PositiveNumber, Within(1.0, 10.0)],
) -> Fraction:
    """Void fraction of a bed fluidized by a liquid, by Richardson and Zaki; 1 and a flag above the terminal
    velocity.

    The exponent comes from ``settling_exponent_richardson_zaki`` or another of its family. Like their law of
    settling it holds up to a solids fraction of 0.6.

    >>> round(
    ...     bed_void_fraction_richardson_zaki(
    ...         superficial_velocity=0.05, terminal_velocity=0.1, settling_exponent=2.4
    ...     ),
    ...     4,
    ... )
    0.7492
    """
    return _carried((superficial_velocity / terminal_velocity) ** (1.0 / settling_exponent))


@formula(
    source="riba1977",
    equation=(
        r"\varepsilon = "
        r"1.58\,\mathrm{Re}^{0.33}\,\mathrm{Ga}^{-0.21}\left(\frac{\rho_p-\rho_f}{\rho_f}\right)^{-0.22}"
    )
    + reynolds_of("U")
    + GALILEO,
    output="bed_void_fraction",
    fitted={"bed_void_fraction": (-inf, 0.85)},
    typical=LIQUID,
)
def bed_void_fraction_riba(
    superficial_velocity: Speed,
    particle_diameter: Length,
    particle_density: Density,
    fluid_density: Density,
    dynamic_viscosity: DynamicViscosity,
    gravity: Acceleration = STANDARD_GRAVITY,
) -> Fraction:
    """Void fraction of a bed fluidized by a liquid, by Riba and Couderc, for void fractions below 0.85.

    >>> e = bed_void_fraction_riba(
    ...     superficial_velocity=0.05,
    ...     particle_diameter="2 mm",
    ...     particle_density=2500,
    ...     fluid_density=1000,
    ...     dynamic_viscosity="1 cP",
    ... )
    >>> 0.4 < e < 0.7
    True
    """
    d, rho, eta = particle_diameter, fluid_density, dynamic_viscosity
    Re, Ga = rho * superficial_velocity * d / eta, gravity * d**3 * rho**2 / eta**2
    return _carried(1.58 * Re**0.33 * Ga**-0.21 * (excess(particle_density, rho) / rho) ** -0.22)


@formula(
    source="wenyu1966",
    equation=r"\varepsilon^{4.7}\,\mathrm{Ar} = 18\,\mathrm{Re} + 2.7\,\mathrm{Re}^{1.687}"
    + reynolds_of("U")
    + ARCHIMEDES,
    fitted={"reynolds": (0.0, 1000.0)},
    output="bed_void_fraction",
    typical=LIQUID,
)
def bed_void_fraction_wen_yu(
    superficial_velocity: Speed,
    particle_diameter: Length,
    particle_density: Density,
    fluid_density: Density,
    dynamic_viscosity: DynamicViscosity,
    gravity: Acceleration = STANDARD_GRAVITY,
) -> Fraction:
    """Void fraction of a bed fluidized by a liquid, by Wen and Yu, from the drag of one sphere.

    >>> e = bed_void_fraction_wen_yu(
    ...     superficial_velocity=0.05,
    ...     particle_diameter="2 mm",
    ...     particle_density=2500,
    ...     fluid_density=1000,
    ...     dynamic_viscosity="1 cP",
    ... )
    >>> 0.4 < e < 0.7
    True
    """
    d, rho, eta = particle_diameter, fluid_density, dynamic_viscosity
    Re = rho * superficial_velocity * d / eta
    watch(reynolds=Re)
    return _carried(
        ((18.0 * Re + 2.7 * Re**1.687) / archimedes(d, particle_density, rho, eta, gravity)) ** (1.0 / 4.7)
    )


@formula(
    source="kunii1991, ch. 3",
    title="Height of an expanded bed",
    equation=r"H = H_0\,\frac{1-\varepsilon_0}{1-\varepsilon}",
    output="height",
    typical={"void_fraction": (0.5, 0.8), "void_fraction_settled": (0.38, 0.45)},
    symbols={"height": "H_0", "=height": "H", "void_fraction_settled": r"\varepsilon_0"},
)
def height_expanded(
    height: Length, void_fraction_settled: VoidFraction, void_fraction: VoidFraction
) -> Length:
    """Height of an expanded bed from that of the settled bed: the solid stays.

    >>> round(height_expanded(height=1.0, void_fraction_settled=0.4, void_fraction=0.7), 6)
    2.0
    """
    return height * (1.0 - void_fraction_settled) / (1.0 - void_fraction)


@formula(
    source="kunii1991, ch. 3, eq. 17",
    title="Pressure drop of a fluidized bed",
    equation=r"\Delta p = \frac{m\,g}{A}\left(1 - \frac{\rho_f}{\rho_p}\right)",
    output="pressure_drop",
    typical=BED,
)
def pressure_drop_fluidized_bed(
    mass: Mass,
    area: Area,
    particle_density: Density,
    fluid_density: Density,
    gravity: Acceleration = STANDARD_GRAVITY,
) -> PressureDrop:
    """Pressure drop of a fluidized bed: its weight less buoyancy over the cross-section.

    >>> round(
    ...     pressure_drop_fluidized_bed(mass=100.0, area=1.0, particle_density=2000.0, fluid_density=1000.0),
    ...     2,
    ... )
    490.33
    """
    return mass * gravity / area * excess(particle_density, fluid_density) / particle_density


@formula(
    source="kunii1991, ch. 3, eq. 17",
    title="Void fraction of the bed from the pressure drop",
    equation=r"\varepsilon = 1 - \frac{\Delta p}{H g (\rho_p - \rho_f)}",
    output="bed_void_fraction",
    typical={"pressure_drop": (5e3, 8e3), "height": (0.8, 1.2), "fluid_density": (0.5, 5.0)},
)
def bed_void_fraction_from_pressure_drop(
    pressure_drop: PressureDrop,
    height: Length,
    particle_density: Density,
    fluid_density: Density,
    gravity: Acceleration = STANDARD_GRAVITY,
) -> Fraction:
    """Void fraction of a fluidized layer from the pressure drop between two levels.

    From mass and height use ``void_fraction_from_mass`` of the packed bed: 1 - m/(H A ρ).

    >>> round(
    ...     bed_void_fraction_from_pressure_drop(
    ...         pressure_drop=5883.99, height=1.0, particle_density=2000, fluid_density=1000
    ...     ),
    ...     4,
    ... )
    0.4
    """
    weight = height * gravity * excess(particle_density, fluid_density)
    impossible(pressure_drop > weight, pressure_drop, "pressure_drop", 0.0, weight, MORE_THAN_SOLID)
    return 1.0 - pressure_drop / weight


@formula(
    source="richardson1954; couderc1985",
    equation=r"n = \frac{\ln(v_t/U_{mf})}{\ln(1/\varepsilon_{mf})}",
    typical={
        "terminal_velocity": (0.1, 0.2),
        "minimum_fluidization_velocity": (0.005, 0.01),
        "void_fraction": (0.4, 0.45),
    },
    symbols={"void_fraction": r"\varepsilon_{mf}"},
)
def expansion_exponent(
    terminal_velocity: Speed, minimum_fluidization_velocity: Speed, void_fraction: VoidFraction
) -> PositiveNumber:
    """Exponent of Richardson and Zaki's law that passes through minimum fluidization and through the terminal
    velocity.

    For grains that are not spheres the exponent of spheres misses the point at which the bed first moves, and
    with it the small expansions of a backwash. The void fraction is that at minimum fluidization.

    >>> round(
    ...     expansion_exponent(terminal_velocity=0.1, minimum_fluidization_velocity=0.01, void_fraction=0.4),
    ...     3,
    ... )
    2.513
    """
    impossible(
        ~(terminal_velocity > minimum_fluidization_velocity),
        terminal_velocity,
        "terminal_velocity",
        minimum_fluidization_velocity,
        jnp.inf,
    )
    return jnp.log(terminal_velocity / minimum_fluidization_velocity) / jnp.log(1.0 / void_fraction)


class GradedBed(NamedTuple):
    """Expansion of a bed of graded grains, layer by layer."""

    bed_void_fraction: Annotated[Fraction, Series("classes")]
    height_expanded: Length
    bed_expansion: Ratio


@formula(
    source="richardson1954; fair1933",
    equation=(
        r"\varepsilon_i = (U/v_{t,i})^{1/n_i},\ n_i = "
        r"\frac{\ln(v_{t,i}/U_{mf,i})}{\ln(1/\varepsilon_0)},\quad H = "
        r"H_0(1-\varepsilon_0)\sum_i\frac{x_i}{1-\varepsilon_i},\quad (v_{t,i}, U_{mf,i}) = F(d_i, "
        r"\rho_p, \rho_f, \eta)"
    ),
    typical={
        "superficial_velocity": (0.005, 0.012),
        "particle_density": (2500.0, 2700.0),
        "fluid_density": (990.0, 1000.0),
        "dynamic_viscosity": (8e-4, 1.5e-3),
        "void_fraction_settled": (0.38, 0.45),
        "class_sizes": (5e-4, 1.5e-3),
    },
    symbols={"class_sizes": "d_i", "class_fractions": "x_i"},
)
def graded_bed_expansion(
    class_sizes: Annotated[Length, Series("classes")],
    class_fractions: Annotated[Amount, Series("classes")],
    height: Length,
    superficial_velocity: Speed,
    particle_density: Density,
    fluid_density: Density,
    dynamic_viscosity: DynamicViscosity,
    void_fraction_settled: VoidFraction = 0.42,
    sphericity: Sphericity = 1.0,
    gravity: Acceleration = STANDARD_GRAVITY,
) -> GradedBed:
    """Expansion of a liquid-fluidized bed of graded grains that lie in layers, as a sand filter under
    backwash.

    Each class expands by Richardson and Zaki's law through its minimum fluidization (Ergun) and its terminal
    velocity; a class not yet fluidized keeps the settled void fraction, one diluted beyond 0.95 is carried
    off: it is named and leaves the sum. Fractions are relative masses. Height is that of the settled bed with
    all classes.

    >>> x = graded_bed_expansion(
    ...     class_sizes=[0.5e-3, 1e-3],
    ...     class_fractions=[0.5, 0.5],
    ...     height=0.7,
    ...     superficial_velocity="36 m/hour",
    ...     particle_density=2650,
    ...     fluid_density=1000,
    ...     dynamic_viscosity="1 cP",
    ... )
    >>> bool(x.bed_void_fraction[0] > x.bed_void_fraction[1]), 0.0 < x.bed_expansion < 1.0
    (True, True)
    """
    d, share = jnp.asarray(class_sizes), jnp.asarray(class_fractions)
    fluid = (fluid_density + excess(particle_density, fluid_density), fluid_density, dynamic_viscosity)
    fall = terminal_velocity(d, *fluid, gravity=gravity, sphericity=sphericity)
    first = minimum_fluidization_velocity_ergun(d, *fluid, void_fraction_settled, sphericity, gravity)
    n = expansion_exponent(fall, first, void_fraction_settled)
    e = jnp.clip((superficial_velocity / fall) ** (1.0 / n), void_fraction_settled, 1.0)
    stays = e <= jnp.maximum(DILUTE, void_fraction_settled)
    limit_active(~stays & (share > 0), d, "class_sizes", CLASS_CARRIED)
    remains = jnp.any(stays & (share > 0))
    impossible(~remains, superficial_velocity, "superficial_velocity", reason=ALL_CARRIED)
    layers = jnp.sum(jnp.where(stays, share / jnp.where(stays, 1.0 - e, 1.0), 0.0))
    expanded = jnp.where(remains, height * (1.0 - void_fraction_settled) * layers / jnp.sum(share), jnp.nan)
    return GradedBed(e, expanded, expanded / height - 1.0)
