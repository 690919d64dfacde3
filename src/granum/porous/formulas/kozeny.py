"""Permeability from structure: Kozeny's bundle of pores, the obstacle model, and the way back to surface,
size and porosity.
"""

from __future__ import annotations

from typing import Annotated, NamedTuple

import jax.numpy as jnp

from granum.core import formula, unconverged
from granum.core.kinds import (
    Length,
    Permeability,
    PositiveNumber,
    Series,
    SpecificSurface,
    Sphericity,
    Velocity,
    VoidFraction,
    Within,
)
from granum.numerics import find_root
from granum.particles.formulas.means import Shares, shares

Tortuosity = Annotated[PositiveNumber, Within(1.0, 10.0)]


class KozenyBundle(NamedTuple):
    """The bundle of equal pores that stands for a porous medium."""

    pore_diameter: Length
    pore_number: PositiveNumber
    pore_velocity: Velocity
    kozeny_coefficient: PositiveNumber


@formula(
    source="kozeny1927; carman1937",
    equation=r"d_p = \frac{4\varepsilon}{a_g(1-\varepsilon)},\ N_p = \frac{a_g^2(1-\varepsilon)^2D^2}{16\,\varepsilon T},\ U_p = \frac{T U}{\varepsilon},"  # noqa: E501
    r"\ h_K = 2\gamma T^2",
    fitted={"kozeny_coefficient": (3.0, 6.0)},
    typical={"noncircularity": (0.83, 1.5), "tortuosity": (1.2, 2.0)},
)
def kozeny_bundle(
    void_fraction: VoidFraction,
    specific_surface: SpecificSurface,
    diameter: Length,
    superficial_velocity: Velocity,
    tortuosity: Tortuosity = 1.5,
    noncircularity: PositiveNumber = 1.0,
) -> KozenyBundle:
    """Kozeny's bundle in a round column: pore diameter, number of pores, velocity in them, and the
    coefficient h_K.

    The specific surface is that of the grains, per volume of solid; the pores are inclined, their length T
    times that of the column. Measured coefficients are 4.5 ± 1.5.

    >>> found = kozeny_bundle(
    ...     void_fraction=0.4, specific_surface=6e4, diameter=0.05, superficial_velocity=1e-3
    ... )
    >>> round(1e6 * found.pore_diameter, 2), round(1000 * found.pore_velocity, 2), found.kozeny_coefficient
    (44.44, 3.75, 4.5)
    """
    e, a, T = void_fraction, specific_surface, tortuosity
    pore = 4.0 * e / (a * (1.0 - e))
    number = a**2 * (1.0 - e) ** 2 * diameter**2 / (16.0 * e * T)
    return KozenyBundle(pore, number, T * superficial_velocity / e, 2.0 * noncircularity * T**2)


@formula(
    source="kozeny1927; carman1937",
    equation=r"B = \frac{\varepsilon^3}{h_K a_g^2(1-\varepsilon)^2}",
    fitted={"void_fraction": (0.3, 0.6), "kozeny_coefficient": (3.0, 6.0)},
    typical={"void_fraction": (0.3, 0.6)},
)
def permeability_kozeny_carman(
    void_fraction: VoidFraction, specific_surface: SpecificSurface, kozeny_coefficient: PositiveNumber = 5.0
) -> Permeability:
    """Permeability from porosity and the specific surface of the grains by Kozeny and Carman.

    The coefficient is 4.5 ± 1.5; 5 for equal isometric grains with a porosity from 0.3 to 0.6; fibers have
    more.

    >>> permeability_kozeny_carman(void_fraction=0.4, specific_surface=6e4)
    9.876...e-12
    """
    return void_fraction**3 / (kozeny_coefficient * specific_surface**2 * (1.0 - void_fraction) ** 2)


@formula(
    source="carman1937; kozeny1927",
    equation=r"B = \frac{(\psi d_p)^2\varepsilon^3}{36\,h_K(1-\varepsilon)^2}",
    fitted={"void_fraction": (0.3, 0.6), "kozeny_coefficient": (3.0, 6.0)},
    typical={"void_fraction": (0.3, 0.6)},
)
def permeability_carman(
    particle_diameter: Length,
    void_fraction: VoidFraction,
    sphericity: Sphericity = 1.0,
    kozeny_coefficient: PositiveNumber = 5.0,
) -> Permeability:
    """Permeability of a bed of grains from their diameter: 36 h_K is 180 with the usual coefficient.

    The diameter is that of the sphere of equal volume; sphericity times it is the surface–volume diameter
    6/a_g. For equal isometric grains with a porosity from 0.3 to 0.6.

    >>> permeability_carman(particle_diameter="100 um", void_fraction=0.4)
    9.876...e-12
    """
    d = sphericity * particle_diameter
    return d**2 * void_fraction**3 / (36.0 * kozeny_coefficient * (1.0 - void_fraction) ** 2)


@formula(
    source="blake1922; ergun1952; bird2002, section 6.4",
    equation=r"B = \frac{(\psi d_p)^2\varepsilon^3}{150(1-\varepsilon)^2}",
    fitted={"void_fraction": (0.0, 0.5)},
    typical={"void_fraction": (0.3, 0.5)},
)
def permeability_blake_kozeny(
    particle_diameter: Length, void_fraction: VoidFraction, sphericity: Sphericity = 1.0
) -> Permeability:
    """Permeability of a bed of grains by Blake and Kozeny, the creeping part of Ergun's equation.

    Good for void fractions below 0.5 (Bird, Stewart and Lightfoot).

    >>> permeability_blake_kozeny(particle_diameter="100 um", void_fraction=0.4)
    1.185...e-11
    """
    return (sphericity * particle_diameter) ** 2 * void_fraction**3 / (150.0 * (1.0 - void_fraction) ** 2)


@formula(
    source="rumpf1971",
    equation=r"B = \frac{d_p^2\varepsilon^{5.5}}{5.6}",
    fitted={"void_fraction": (0.35, 0.7)},
)
def permeability_rumpf_gupte(particle_diameter: Length, void_fraction: VoidFraction) -> Permeability:
    """Permeability of random beds of spheres of narrow to moderate spread by Rumpf and Gupte.

    >>> permeability_rumpf_gupte(particle_diameter="100 um", void_fraction=0.4)
    1.156...e-11
    """
    return particle_diameter**2 * void_fraction**5.5 / 5.6


@formula(
    source="stokes1851; happel1958",
    title="Permeability of sparse obstacles",
    equation=r"B = \frac{d_p^2}{18(1-\varepsilon)}",
    typical={"void_fraction": (0.9, 0.999)},
    fitted={"void_fraction": (0.99, 1.0)},
)
def permeability_obstacles(particle_diameter: Length, void_fraction: VoidFraction) -> Permeability:
    """Permeability of spheres far from one another, each with Stokes' drag: the upper limit of any bed.

    Low drag by 20 % already at a solids fraction of 1e-3, where Happel's cell takes over.

    >>> permeability_obstacles(particle_diameter="100 um", void_fraction=0.999)
    5.555...e-07
    """
    return particle_diameter**2 / (18.0 * (1.0 - void_fraction))


@formula(
    source="happel1958",
    equation=r"B = \frac{d_p^2}{18\gamma^3}\,\frac{3-\frac92\gamma+\frac92\gamma^5-3\gamma^6}{3+2\gamma^5},\quad \gamma = (1-\varepsilon)^{1/3}",  # noqa: E501
)
def permeability_happel(particle_diameter: Length, void_fraction: VoidFraction) -> Permeability:
    """Permeability of a bed of spheres of any porosity by Happel's cell with a free surface.

    Its Kozeny coefficient is 4.5 to 5.1 from porosity 0.4 to 0.6, and it tends to the obstacle model for a
    lonely sphere.

    >>> permeability_happel(particle_diameter="100 um", void_fraction=0.5)
    2.931...e-11
    """
    c = jnp.cbrt(1.0 - void_fraction)
    return (
        particle_diameter**2 / (18.0 * c**3) * (3.0 - 4.5 * c + 4.5 * c**5 - 3.0 * c**6) / (3.0 + 2.0 * c**5)
    )


@formula(
    source="davies1952",
    equation=r"B = \frac{d_f^2}{64(1-\varepsilon)^{1.5}\left[1+56(1-\varepsilon)^3\right]}",
    fitted={"void_fraction": (0.7, 0.994)},
)
def permeability_davies(fiber_diameter: Length, void_fraction: VoidFraction) -> Permeability:
    """Permeability of a mat of fibers across the flow by Davies.

    >>> permeability_davies(fiber_diameter="10 um", void_fraction=0.9)
    4.679...e-11
    """
    solid = 1.0 - void_fraction
    return fiber_diameter**2 / (64.0 * solid**1.5 * (1.0 + 56.0 * solid**3))


@formula(
    source="carman1937; kozeny1927",
    equation=r"a_g = \sqrt{\frac{\varepsilon^3}{h_K B(1-\varepsilon)^2}}",
    fitted={"void_fraction": (0.3, 0.6), "kozeny_coefficient": (3.0, 6.0)},
)
def specific_surface_kozeny_carman(
    permeability: Permeability, void_fraction: VoidFraction, kozeny_coefficient: PositiveNumber = 5.0
) -> SpecificSurface:
    """Specific surface of the grains, per volume of solid, from a measured permeability.

    For equal isometric grains with a porosity from 0.3 to 0.6.

    >>> round(specific_surface_kozeny_carman(permeability=9.876543209876543e-12, void_fraction=0.4))
    60000
    """
    return jnp.sqrt(void_fraction**3 / (kozeny_coefficient * permeability)) / (1.0 - void_fraction)


@formula(
    source="carman1937; kozeny1927",
    equation=r"d_p = \frac{6}{\psi}\sqrt{\frac{h_K B(1-\varepsilon)^2}{\varepsilon^3}}",
    fitted={"void_fraction": (0.3, 0.6), "kozeny_coefficient": (3.0, 6.0)},
)
def particle_diameter_kozeny_carman(
    permeability: Permeability,
    void_fraction: VoidFraction,
    sphericity: Sphericity = 1.0,
    kozeny_coefficient: PositiveNumber = 5.0,
) -> Length:
    """Volume-equivalent diameter of the grains from a measured permeability.

    For equal isometric grains with a porosity from 0.3 to 0.6.

    >>> round(1e6 * particle_diameter_kozeny_carman(permeability=9.876543209876543e-12, void_fraction=0.4), 6)
    100.0
    """
    return (
        6.0
        * jnp.sqrt(kozeny_coefficient * permeability / void_fraction**3)
        * (1.0 - void_fraction)
        / sphericity
    )


@formula(
    source="carman1937; kozeny1927",
    equation=r"\frac{\varepsilon^3}{(1-\varepsilon)^2} = h_K a_g^2 B",
    fitted={"void_fraction": (0.3, 0.6), "kozeny_coefficient": (3.0, 6.0)},
)
def void_fraction_kozeny_carman(
    permeability: Permeability, specific_surface: SpecificSurface, kozeny_coefficient: PositiveNumber = 5.0
) -> VoidFraction:
    """Porosity of a bed from its permeability and the specific surface of its grains.

    For equal isometric grains with a porosity from 0.3 to 0.6.

    >>> round(void_fraction_kozeny_carman(permeability=9.876543209876543e-12, specific_surface=6e4), 6)
    0.4
    """
    group = kozeny_coefficient * specific_surface**2 * permeability
    # ε³ = K(1−ε)², in ln so that loose and tight beds are alike; x is the logit of ε
    third = jnp.log(group) / 3.0
    root = find_root(
        lambda x: 3.0 * jnp.log1p(jnp.exp(-x)) - 2.0 * jnp.log1p(jnp.exp(x)) + jnp.log(group),
        jnp.minimum(third, 0.0) - 5.0,
        jnp.maximum(jnp.log(group) / 2.0, 0.0) + 5.0,
        tolerance=1e-13,
    )
    unconverged(root.converged)
    return 1.0 / (1.0 + jnp.exp(-root.value))


@formula(
    source="carman1937; ergun1952",
    title="Specific surface of a mixture of grains",
    equation=r"a_g = \sum_i\frac{6 x_i}{\psi d_i},\quad \bar d = \frac{1}{\sum_i x_i/d_i}",
    symbols={"class_sizes": "d_i", "class_fractions": "x_i"},
)
def specific_surface_mixture(
    class_sizes: Annotated[Length, Series("classes")],
    class_fractions: Shares,
    sphericity: Sphericity = 1.0,
) -> SpecificSurface:
    """Specific surface of a mixture of sizes from its mass fractions: that of its harmonic mean diameter.

    A bed of mixed sizes has the permeability of this surface at its own, lower porosity.

    >>> round(specific_surface_mixture(class_sizes=[100e-6, 200e-6], class_fractions=[0.5, 0.5]))
    45000
    """
    return jnp.sum(6.0 * shares(class_fractions) / (sphericity * class_sizes))


@formula(source="richardson2002, ch. 4", equation=r"f_w = \left(1 + \frac{2}{a_g\,D}\right)^2")
def wall_correction_coulson(
    specific_surface: SpecificSurface, diameter: Length
) -> Annotated[PositiveNumber, Within(1.0)]:
    """Velocity in a bed without walls over the velocity in a column at the same pressure gradient (Coulson).

    The wall of the column, 4/D per volume, counts half beside the surface of the grains.

    >>> round(wall_correction_coulson(specific_surface=6 / 1.8e-3, diameter="12.7 mm"), 4)
    1.0967
    """
    return (1.0 + 2.0 / (specific_surface * diameter)) ** 2
