"""Shape: sphericity, circularity and the factors between a size and the volume or surface that goes with
it.
"""

from __future__ import annotations

from math import pi, sqrt
from typing import Literal

import jax.numpy as jnp

from granum.core import formula, impossible, procedure
from granum.core.kinds import Area, Length, PositiveNumber, Ratio, Sphericity, Volume
from granum.numerics.smooth import safe_power

ROUNDEST = "Of all bodies of one volume the sphere has the smallest surface."
LONGEST = "Length, width and thickness are given in falling order."
ROUNDING = 1e-12


@formula(
    source="wadell1933",
    equation=r"\psi = \left(\frac{d_v}{d_s}\right)^2",
    title="Sphericity from two diameters",
    typical={"diameter_volume": (1e-4, 2e-4), "diameter_surface": (2.1e-4, 2.5e-4)},
)
def sphericity_diameters(diameter_volume: Length, diameter_surface: Length) -> Sphericity:
    """Surface of the sphere of the same volume over the surface of the particle.

    Known as Wadell's sphericity.

    >>> round(sphericity_diameters(diameter_volume=1.2407, diameter_surface=1.3820), 3)
    0.806
    """
    impossible(
        diameter_volume > diameter_surface,
        diameter_volume,
        "diameter_volume",
        0.0,
        diameter_surface,
        ROUNDEST,
    )
    return (diameter_volume / diameter_surface) ** 2


@formula(
    source="wadell1933",
    equation=r"\psi = \frac{\pi^{1/3} (6V)^{2/3}}{S}",
    title="Sphericity from volume and surface",
    typical={"particle_volume": (1e-13, 2e-13), "particle_surface": (2e-8, 1e-7)},
)
def sphericity_volume_surface(particle_volume: Volume, particle_surface: Area) -> Sphericity:
    """Surface of the sphere of the same volume over the surface of the particle.

    >>> round(sphericity_volume_surface(particle_volume=1.0, particle_surface=6.0), 3)
    0.806
    """
    least = pi ** (1 / 3) * safe_power(6.0 * particle_volume, 2 / 3)
    impossible(
        particle_surface < least * (1.0 - ROUNDING),
        particle_surface,
        "particle_surface",
        least,
        jnp.inf,
        ROUNDEST,
    )
    return least / particle_surface


@formula(
    source="wadell1933",
    equation=r"\psi = \frac{\pi^{1/3} (6 L I E)^{2/3}}{2 (LI + IE + EL)}",
    title="Sphericity of a box",
)
def sphericity_box(particle_length: Length, particle_width: Length, particle_thickness: Length) -> Sphericity:
    """Sphericity of a rectangular box; 0.806 for the cube.

    >>> round(sphericity_box(particle_length=1.0, particle_width=1.0, particle_thickness=1.0), 4)
    0.806
    """
    a, b, c = particle_length, particle_width, particle_thickness
    return pi ** (1 / 3) * (6.0 * a * b * c) ** (2 / 3) / (2.0 * (a * b + b * c + c * a))


@formula(
    source="krumbein1941",
    equation=r"\psi = \left(\frac{I E}{L^2}\right)^{1/3}",
    title="Intercept sphericity (Krumbein)",
)
def sphericity_krumbein(
    particle_length: Length, particle_width: Length, particle_thickness: Length
) -> Sphericity:
    """Intercept sphericity of pebbles and grains: geometric mean of the three axes over the longest.

    It is the sphericity of geology and of agricultural products; drag and packed-bed laws ask for Wadell's,
    by surface.

    >>> round(
    ...     sphericity_krumbein(particle_length="6 mm", particle_width="4 mm", particle_thickness="3 mm"), 3
    ... )
    0.693
    """
    impossible(
        particle_width > particle_length, particle_width, "particle_width", 0.0, particle_length, LONGEST
    )
    impossible(
        particle_thickness > particle_width,
        particle_thickness,
        "particle_thickness",
        0.0,
        particle_width,
        LONGEST,
    )
    return (particle_width * particle_thickness / particle_length**2) ** (1 / 3)


@formula(
    source="wadell1933",
    equation=r"\psi = \frac{(3a/2)^{2/3}}{1/2 + a},\ a = L/D",
    title="Sphericity of a cylinder",
)
def sphericity_cylinder(aspect_ratio: PositiveNumber) -> Sphericity:
    """Sphericity of a cylinder by its length over its diameter; a disk below 1, a needle above; at most
    0.874 at 1.

    >>> round(sphericity_cylinder(aspect_ratio=1.0), 4)
    0.8736
    """
    return (1.5 * aspect_ratio) ** (2 / 3) / (0.5 + aspect_ratio)


@formula(
    source="clift1978",
    equation=r"\psi = \frac{2\,a^{2/3}}{1 + a\,\arcsin(e)/e},\ e^2 = 1 - a^{-2}\ (a > 1);\quad "
    r"\frac{2\,a^{2/3}}{1 + a^2\,\mathrm{artanh}(e)/e},\ e^2 = 1 - a^2\ (a < 1)",
    title="Sphericity of a spheroid",
)
def sphericity_spheroid(aspect_ratio: PositiveNumber) -> Sphericity:
    """Sphericity of an ellipsoid of revolution by its axis over its equator; lens below 1, egg above.

    >>> round(sphericity_spheroid(aspect_ratio=2.0), 3)
    0.929
    """
    a = aspect_ratio
    long, flat = a > 1.0 + 1e-4, a < 1.0 - 1e-4
    at, af = jnp.where(long, a, 2.0), jnp.where(flat, a, 0.5)
    et, ef = jnp.sqrt(1.0 - at**-2.0), jnp.sqrt(1.0 - af**2)
    side = jnp.where(
        long,
        at * jnp.arcsin(et) / et,
        jnp.where(flat, af**2 * jnp.arctanh(ef) / ef, 1.0 + 4.0 / 3.0 * (a - 1.0)),
    )
    return 2.0 * a ** (2 / 3) / (1.0 + side)


@formula(
    source="iso9276-6",
    equation=r"C = \sqrt{\frac{4\pi A_p}{P^2}}",
    typical={"projected_area": (1e-7, 2e-7), "projected_perimeter": (2e-3, 6e-3)},
)
def circularity(projected_area: Area, projected_perimeter: Length) -> Ratio:
    """Perimeter of the circle of the same area over the perimeter of the particle's projection; 1 for a
    circle.

    This is the definition of ISO 9276-6; some instruments print its square and call it circularity too.

    >>> round(circularity(projected_area=1.0, projected_perimeter=4.0), 4)
    0.8862
    """
    return jnp.sqrt(4.0 * pi * projected_area) / projected_perimeter


@formula(source="corey1949", equation=r"k = \frac{E}{\sqrt{L\,I}}", title="Corey shape factor")
def shape_factor_corey(
    particle_length: Length, particle_width: Length, particle_thickness: Length
) -> PositiveNumber:
    """Thickness over the geometric mean of length and width; 1 for a sphere or a cube, near 0 for a flake.

    >>> shape_factor_corey(particle_length=4.0, particle_width=1.0, particle_thickness=0.5)
    0.25
    """
    return particle_thickness / jnp.sqrt(particle_length * particle_width)


@formula(
    source="allen1997",
    equation=r"k_v = \frac{V}{d^3}",
    title="Volume shape factor",
    symbols={"particle_diameter": "d", "shape_factor": "k_v"},
)
def shape_factor_volume(particle_volume: Volume, particle_diameter: Length) -> Ratio:
    """Volume over the cube of the chosen diameter; pi/6 for a sphere.

    >>> round(shape_factor_volume(particle_volume=3.14159265 / 6, particle_diameter=1.0), 4)
    0.5236
    """
    return particle_volume / particle_diameter**3


@formula(
    source="allen1997",
    equation=r"k_s = \frac{S}{d^2}",
    title="Surface shape factor",
    symbols={"particle_diameter": "d", "shape_factor": "k_s"},
)
def shape_factor_surface(particle_surface: Area, particle_diameter: Length) -> PositiveNumber:
    """Surface over the square of the chosen diameter; pi for a sphere.

    >>> round(shape_factor_surface(particle_surface=6.0, particle_diameter=1.0), 4)
    6.0
    """
    return particle_surface / particle_diameter**2


# volume and surface of solids of edge (or radius) 1
_SOLIDS = {
    "sphere": (4 * pi / 3, 4 * pi),
    "hemisphere": (2 * pi / 3, 3 * pi),
    "tetrahedron": (sqrt(2) / 12, sqrt(3)),
    "cube": (1.0, 6.0),
    "octahedron": (sqrt(2) / 3, 2 * sqrt(3)),
    "dodecahedron": ((15 + 7 * sqrt(5)) / 4, 3 * sqrt(25 + 10 * sqrt(5))),
    "icosahedron": (5 * (3 + sqrt(5)) / 12, 5 * sqrt(3)),
}


@procedure(source="wadell1933", title="Sphericity of a regular solid")
def sphericity_regular(
    shape: Literal[
        "sphere", "hemisphere", "tetrahedron", "cube", "octahedron", "dodecahedron", "icosahedron"
    ],
) -> Sphericity:
    """Sphericity of a sphere, a half sphere or one of the five regular solids.

    >>> round(sphericity_regular("cube"), 3)
    0.806
    """
    volume, surface = _SOLIDS[shape]
    return pi ** (1 / 3) * (6.0 * volume) ** (2 / 3) / surface
