"""Filtering centrifuges: flow through a cylindrical cake, critical rate, loading, spinning off, drainage,
washing.
"""

from __future__ import annotations

import jax.numpy as jnp

from granum.core import formula, watch
from granum.core.flags import impossible
from granum.core.kinds import (
    Density,
    DynamicViscosity,
    Fraction,
    Length,
    MediumResistance,
    Permeability,
    PositiveNumber,
    RotationSpeed,
    SurfaceTension,
    Time,
    VoidFraction,
    VolumeFlow,
)

_BASKET = {
    "basket_height": (0.2, 0.8),
    "radius_outer": (0.4, 0.6),
    "cake_radius": (0.3, 0.38),
    "radius_inner": (0.2, 0.29),
    "rotation_speed": (50.0, 150.0),
    "cake_permeability": (1e-13, 1e-11),
    "medium_resistance": (1e8, 1e10),
}


CAKE_OUTSIDE = "The cake lies inside the basket."
SURFACE_IN_CAKE = "The free surface of the liquid lies inside the ring of cake, not in the cake."


def _check_rings(radius_outer, cake_radius, radius_inner):
    """Basket, cake and free surface follow one another inward."""
    impossible(cake_radius > radius_outer, cake_radius, "cake_radius", 0.0, radius_outer, CAKE_OUTSIDE)
    impossible(radius_inner > cake_radius, radius_inner, "radius_inner", 0.0, cake_radius, SURFACE_IN_CAKE)


def _conductance(
    basket_height, radius_outer, cake_radius, dynamic_viscosity, cake_permeability, medium_resistance
):
    """Flow per pressure difference through cake and medium."""
    through = jnp.log(radius_outer / cake_radius) / cake_permeability + medium_resistance / radius_outer
    return 2.0 * jnp.pi * basket_height / (dynamic_viscosity * through)


@formula(
    source="grace1953; mccabe2005, ch. 29",
    title="Filtrate flow of a basket",
    equation=r"q = \frac{\pi h\,\rho_l\,\omega^2\,(r_o^2 - r_i^2)}{\eta\,[\ln(r_o/r_c)/B + R_s/r_o]}",
    typical=_BASKET,
)
def filtrate_flow_basket(
    basket_height: Length,
    radius_outer: Length,
    cake_radius: Length,
    radius_inner: Length,
    rotation_speed: RotationSpeed,
    liquid_density: Density,
    dynamic_viscosity: DynamicViscosity,
    cake_permeability: Permeability,
    medium_resistance: MediumResistance = 0.0,
) -> VolumeFlow:
    """Filtrate flow of a basket with its cake under a ring of liquid: basket radius r_o, cake r_c, free
    surface r_i.

    >>> round(filtrate_flow_basket(0.4, 0.5, 0.4, 0.35, 100, 1000, 1e-3, 1e-12) * 1e3, 3)
    7.18
    """
    _check_rings(radius_outer, cake_radius, radius_inner)
    drive = 0.5 * liquid_density * rotation_speed**2 * (radius_outer**2 - radius_inner**2)
    return drive * _conductance(
        basket_height, radius_outer, cake_radius, dynamic_viscosity, cake_permeability, medium_resistance
    )


@formula(
    source="storrow1957",
    equation=r"q = \frac{\pi h\,\rho_l\,\omega^2\,(r_o^2 - r_c^2)}{\eta\,[\ln(r_o/r_c)/B + R_s/r_o]}",
    typical=_BASKET,
    output="filtrate_flow",
    title="Critical filtrate flow of a basket",
)
def filtrate_flow_critical(
    basket_height: Length,
    radius_outer: Length,
    cake_radius: Length,
    rotation_speed: RotationSpeed,
    liquid_density: Density,
    dynamic_viscosity: DynamicViscosity,
    cake_permeability: Permeability,
    medium_resistance: MediumResistance = 0.0,
) -> VolumeFlow:
    """Critical flow of a basket: what passes when the free surface has just reached the cake; a larger feed
    floods it.

    >>> round(filtrate_flow_critical(0.4, 0.5, 0.4, 100, 1000, 1e-3, 1e-12) * 1e3, 3)
    5.068
    """
    return filtrate_flow_basket(
        basket_height,
        radius_outer,
        cake_radius,
        cake_radius,
        rotation_speed,
        liquid_density,
        dynamic_viscosity,
        cake_permeability,
        medium_resistance,
    )


@formula(
    source="richardson2002, ch. 9",
    title="Loading time of a basket",
    equation=(
        r"t_1 = \frac{\eta}{2\,v\,B\,\rho_l\,\omega^2\,(r_o^2 - r_i^2)}\left[(r_o^2 - r_c^2)\left(1 + "
        r"\frac{2 R_s B}{r_o}\right) + 2 r_c^2\ln\frac{r_c}{r_o}\right]"
    ),
    typical={**_BASKET, "cake_volume_per_filtrate": (0.02, 0.3)},
)
def loading_time_basket(
    radius_outer: Length,
    cake_radius: Length,
    radius_inner: Length,
    rotation_speed: RotationSpeed,
    liquid_density: Density,
    dynamic_viscosity: DynamicViscosity,
    cake_permeability: Permeability,
    cake_volume_per_filtrate: PositiveNumber,
    medium_resistance: MediumResistance = 0.0,
) -> Time:
    """Time to build up a cake in a basket that is kept full to a free surface.

    >>> round(loading_time_basket(0.5, 0.4, 0.35, 100, 1000, 1e-3, 1e-12, cake_volume_per_filtrate=0.1), 1)
    72.9
    """
    ro, rc = radius_outer, cake_radius
    _check_rings(ro, rc, radius_inner)
    built = (ro**2 - rc**2) * (
        1.0 + 2.0 * medium_resistance * cake_permeability / ro
    ) + 2.0 * rc**2 * jnp.log(rc / ro)
    drive = liquid_density * rotation_speed**2 * (ro**2 - radius_inner**2)
    return built * dynamic_viscosity / (2.0 * cake_volume_per_filtrate * cake_permeability * drive)


@formula(
    source="storrow1957",
    equation=(
        r"t_2 = \frac{\eta\,[\ln(r_o/r_c)/B + R_s/r_o]}{\rho_l\,\omega^2}\,\ln\frac{r_o^2 - "
        r"r_i^2}{r_o^2 - r_c^2}"
    ),
    typical=_BASKET,
)
def spin_off_time(
    radius_outer: Length,
    cake_radius: Length,
    radius_inner: Length,
    rotation_speed: RotationSpeed,
    liquid_density: Density,
    dynamic_viscosity: DynamicViscosity,
    cake_permeability: Permeability,
    medium_resistance: MediumResistance = 0.0,
) -> Time:
    """Time for the liquid above the cake to pass through it: the free surface falls from r_i to the cake at
    r_c.

    >>> round(spin_off_time(0.5, 0.4, 0.35, 100, 1000, 1e-3, 1e-12), 2)
    7.77
    """
    _check_rings(radius_outer, cake_radius, radius_inner)
    through = jnp.log(radius_outer / cake_radius) / cake_permeability + medium_resistance / radius_outer
    head = (radius_outer**2 - radius_inner**2) / (radius_outer**2 - cake_radius**2)
    return dynamic_viscosity * through / (liquid_density * rotation_speed**2) * jnp.log(head)


@formula(
    source="wakeman2005",
    title="Irreducible saturation of a spun cake",
    equation=r"N_{cap} = \frac{\varepsilon^3 d_p^2\,\rho_l\,\omega^2 r}{(1-\varepsilon)^2\sigma},\quad"
    r" S_\infty = 0.0524\,N_{cap}^{-0.19}\;(N_{cap} \le 0.14),\; 0.0139\,N_{cap}^{-0.86}\;(N_{cap} > 0.14)",
    fitted={"capillary_number": (1e-5, 10.0)},
    output="irreducible_saturation",
    typical={
        "particle_diameter": (2e-5, 3e-4),
        "rotation_speed": (50.0, 150.0),
        "radius": (0.2, 0.6),
        "void_fraction": (0.35, 0.5),
    },
)
def irreducible_saturation_spinning(
    particle_diameter: Length,
    void_fraction: VoidFraction,
    radius: Length,
    rotation_speed: RotationSpeed,
    liquid_density: Density,
    surface_tension: SurfaceTension,
) -> Fraction:
    """Irreducible saturation of a cake that drains in a centrifugal field.

    >>> round(irreducible_saturation_spinning("200 um", 0.4, 0.4, 130, 1100, 0.072), 3)
    0.018
    """
    e = void_fraction
    N = (
        e**3
        * particle_diameter**2
        * liquid_density
        * rotation_speed**2
        * radius
        / ((1.0 - e) ** 2 * surface_tension)
    )
    watch(capillary_number=N)
    return jnp.clip(jnp.where(N <= 0.14, 0.0524 * N**-0.19, 0.0139 * N**-0.86), 0.0, 1.0)


@formula(
    source="perry2008, § 18",
    title="Saturation of a spun cake",
    equation=r"S = S_\infty + (1 - S_\infty)\min\left(1, \frac{4}{3\sqrt{t_d}}\right),\quad t_d = \frac{\rho_l\,\omega^2 r\,d_h^2\,t}{\eta\,Z},\; d_h = \frac{2\,\varepsilon\,d_p}{3\,(1-\varepsilon)}",  # noqa: E501
    output="cake_saturation",
    typical={
        "particle_diameter": (5e-5, 3e-4),
        "rotation_speed": (50.0, 150.0),
        "radius": (0.2, 0.6),
        "void_fraction": (0.35, 0.5),
        "cake_thickness": (0.01, 0.08),
        "time": (20.0, 200.0),
        "irreducible_saturation": (0.05, 0.3),
    },
)
def cake_saturation_spinning(
    time: Time,
    particle_diameter: Length,
    void_fraction: VoidFraction,
    cake_thickness: Length,
    radius: Length,
    rotation_speed: RotationSpeed,
    liquid_density: Density,
    dynamic_viscosity: DynamicViscosity,
    irreducible_saturation: Fraction,
) -> Fraction:
    """Saturation of a cake after a time of spinning: film drainage down to the irreducible saturation.

    >>> round(cake_saturation_spinning(60, "200 um", 0.4, 0.05, 0.4, 130, 1100, 1e-3, 0.067), 3)
    0.072
    """
    e = void_fraction
    hydraulic = 2.0 / 3.0 * e * particle_diameter / (1.0 - e)
    t_d = (
        liquid_density
        * rotation_speed**2
        * radius
        * hydraulic**2
        * time
        / (dynamic_viscosity * cake_thickness)
    )
    film = jnp.where(t_d > 16.0 / 9.0, 4.0 / (3.0 * jnp.sqrt(jnp.where(t_d > 16.0 / 9.0, t_d, 1.0))), 1.0)
    return irreducible_saturation + (1.0 - irreducible_saturation) * film


@formula(
    source="perry2008, § 18",
    equation=(
        r"S_\infty = S_c + S_p(1 - S_c),\quad S_c = \frac{4\sigma}{\rho_l\omega^2 r\,d_h Z},\quad S_p = "
        r"0.075\;(N_c \le 5),\; \frac{5}{40 + 6N_c}\;(N_c \le 10),\; \frac{0.5}{N_c},\quad N_c = "
        r"\frac{\rho_l\omega^2 r\,d_h^2}{\sigma},\quad d_h = \frac{2\,\varepsilon\,d_p}{3\,(1 - "
        r"\varepsilon)}"
    ),
    output="irreducible_saturation",
    typical={
        "particle_diameter": (2e-5, 3e-4),
        "rotation_speed": (80.0, 150.0),
        "radius": (0.2, 0.6),
        "void_fraction": (0.35, 0.5),
        "cake_thickness": (0.01, 0.08),
    },
)
def irreducible_saturation_leung(
    particle_diameter: Length,
    void_fraction: VoidFraction,
    cake_thickness: Length,
    radius: Length,
    rotation_speed: RotationSpeed,
    liquid_density: Density,
    surface_tension: SurfaceTension,
) -> Fraction:
    """Irreducible saturation of a spun cake: the capillary rise at the basket and the liquid held at the
    contacts of grains.

    Liquid inside the grains comes on top. The hydraulic diameter is d_h = 2 ε d_p / 3 (1 − ε).

    >>> round(irreducible_saturation_leung("200 um", 0.42, 0.04, 0.23, 167.5, 1050, 0.072), 3)
    0.085
    """
    e = void_fraction
    hydraulic = 2.0 / 3.0 * e * particle_diameter / (1.0 - e)
    field = liquid_density * rotation_speed**2 * radius
    rise = jnp.minimum(4.0 * surface_tension / (field * hydraulic * cake_thickness), 1.0)
    N = field * hydraulic**2 / surface_tension
    contacts = jnp.where(N <= 5.0, 0.075, jnp.where(N <= 10.0, 5.0 / (40.0 + 6.0 * N), 0.5 / N))
    return rise + contacts * (1.0 - rise)
