"""Clarifying centrifuges: Sigma of each machine, cut sizes, scale-up, grade efficiency, liquid–liquid
interface.
"""

from __future__ import annotations

from typing import Any

import jax.numpy as jnp

from granum.core import formula, watch
from granum.core.constants import STANDARD_GRAVITY
from granum.core.flags import impossible
from granum.core.kinds import (
    Angle,
    Area,
    Density,
    Distance,
    DynamicViscosity,
    Fraction,
    Length,
    PositiveNumber,
    RotationSpeed,
    Speed,
    Volume,
    VolumeFlow,
)

INSIDE_OUT = "The inner radius, that of the free surface, must be smaller than the outer one."
STEEP = "A disc stands between 0 and 90° to the axis."
NO_INTERFACE = "No interface lies between these overflows: the heavy liquid must leave farther out."

_BOWL = {
    "bowl_length": (0.3, 1.5),
    "radius_inner": (0.02, 0.1),
    "radius_outer": (0.12, 0.4),
    "rotation_speed": (100.0, 1500.0),
}
_MUD = {
    "particle_density": (1500.0, 4000.0),
    "fluid_density": (900.0, 1200.0),
    "sigma_factor": (500.0, 50000.0),
    "volume_flow": (1e-4, 1e-2),
}


def stokes_velocity(diameter: Any, excess: Any, viscosity: Any) -> Any:
    """Settling velocity under gravity by Stokes' law, from the excess of density."""
    return diameter**2 * excess * STANDARD_GRAVITY / (18.0 * viscosity)


@formula(
    source="ambler1959; geankoplis2003, § 14.4",
    equation=r"\Sigma = \frac{\pi L\,\omega^2\,(r_o^2 - r_i^2)}{g\,\ln(r_o/r_i)}",
    typical=_BOWL,
    title="Sigma of a tubular bowl, full capture",
)
def sigma_factor_tubular(
    bowl_length: Length, radius_inner: Length, radius_outer: Length, rotation_speed: RotationSpeed
) -> Area:
    """Area of the settling basin that would do the same as a tubular bowl, for the smallest particle caught
    completely.

    With this convention Q = v_g Σ.

    >>> round(sigma_factor_tubular(0.1970, 0.00716, 0.02225, 2408.6), 1)
    143.3
    """
    r1, r2 = radius_inner, radius_outer
    impossible(~(r1 < r2), r1, "radius_inner", 0.0, r2, INSIDE_OUT)
    return jnp.pi * bowl_length * rotation_speed**2 * (r2**2 - r1**2) / (STANDARD_GRAVITY * jnp.log(r2 / r1))


@formula(
    source="mccabe2005, ch. 29; geankoplis2003, § 14.4",
    equation=r"\Sigma = \frac{\pi L\,\omega^2\,(r_o^2 - r_i^2)}{2 g\,\ln[2 r_o/(r_i + r_o)]}",
    typical=_BOWL,
    title="Sigma of a tubular bowl, cut at half the layer thickness",
)
def sigma_factor_tubular_half_thickness(
    bowl_length: Length, radius_inner: Length, radius_outer: Length, rotation_speed: RotationSpeed
) -> Area:
    """Sigma of a tubular bowl for the particle that crosses half the thickness of the liquid layer.

    With this convention Q = 2 v_g Σ, and the particle is the cut size of half the feed by thickness.

    >>> round(sigma_factor_tubular_half_thickness(0.1970, 0.00716, 0.02225, 2408.6), 1)
    196.2
    """
    r1, r2 = radius_inner, radius_outer
    impossible(~(r1 < r2), r1, "radius_inner", 0.0, r2, INSIDE_OUT)
    return (
        jnp.pi
        * bowl_length
        * rotation_speed**2
        * (r2**2 - r1**2)
        / (2.0 * STANDARD_GRAVITY * jnp.log(2.0 * r2 / (r1 + r2)))
    )


@formula(
    source="ambler1959",
    equation=r"\Sigma = \frac{\pi L\,\omega^2\,(r_o^2 - r_i^2)}{g\,\ln[2 r_o^2/(r_i^2 + r_o^2)]}",
    typical=_BOWL,
    title="Sigma of a tubular bowl, cut at half the flow area",
)
def sigma_factor_tubular_half_area(
    bowl_length: Length, radius_inner: Length, radius_outer: Length, rotation_speed: RotationSpeed
) -> Area:
    """Sigma of a tubular bowl for the particle of which half is caught when it enters evenly over the flow
    area.

    With this convention Q = 2 v_g Σ.

    >>> round(sigma_factor_tubular_half_area(1.0, 0.1, 0.2, 100.0), 1)
    204.5
    """
    r1, r2 = radius_inner, radius_outer
    impossible(~(r1 < r2), r1, "radius_inner", 0.0, r2, INSIDE_OUT)
    return (
        jnp.pi
        * bowl_length
        * rotation_speed**2
        * (r2**2 - r1**2)
        / (STANDARD_GRAVITY * jnp.log(2.0 * r2**2 / (r1**2 + r2**2)))
    )


@formula(
    source="ambler1959; perry2008, § 18",
    equation=r"\Sigma = \frac{2\pi\,n\,\omega^2\,(r_o^3 - r_i^3)}{3 g\,\tan\theta}",
    typical={
        "disc_number": (20, 150),
        "radius_inner": (0.03, 0.08),
        "radius_outer": (0.1, 0.3),
        "rotation_speed": (400.0, 1000.0),
        "disc_angle": (0.6, 0.8),
    },
    title="Sigma of a disc stack",
)
def sigma_factor_disc(
    disc_number: PositiveNumber,
    radius_inner: Length,
    radius_outer: Length,
    rotation_speed: RotationSpeed,
    disc_angle: Angle,
) -> Area:
    """Area of the settling basin that would do the same as a stack of conical discs; the angle is that
    between disc and axis.

    The number counts the gaps between discs.

    >>> round(sigma_factor_disc(100, 0.05, 0.15, 700, "40 degree"))
    40533
    """
    r1, r2 = radius_inner, radius_outer
    impossible(~(r1 < r2), r1, "radius_inner", 0.0, r2, INSIDE_OUT)
    impossible(
        (disc_angle <= 0.0) | (disc_angle >= jnp.pi / 2.0), disc_angle, "disc_angle", 0.0, jnp.pi / 2.0, STEEP
    )
    return (
        2.0
        * jnp.pi
        * disc_number
        * rotation_speed**2
        * (r2**3 - r1**3)
        / (3.0 * STANDARD_GRAVITY * jnp.tan(disc_angle))
    )


@formula(
    source="ambler1959; records2001",
    equation=(
        r"\Sigma = \frac{2\pi\omega^2}{g}\left[L_1\left(\tfrac34 r_o^2 + \tfrac14 r_i^2\right) + "
        r"L_2\,\frac{r_o^2 + 3 r_i r_o + 4 r_i^2}{8}\right]"
    ),
    typical={**_BOWL, "beach_length": (0.1, 0.5)},
    title="Sigma of a scroll decanter",
    symbols={"bowl_length": "L_1"},
)
def sigma_factor_scroll(
    bowl_length: Length,
    radius_inner: Length,
    radius_outer: Length,
    rotation_speed: RotationSpeed,
    beach_length: Distance = 0.0,
) -> Area:
    """Area of the settling basin that would do the same as a scroll decanter: cylinder and flooded part of
    the beach.

    >>> round(sigma_factor_scroll(1.0, 0.15, 0.2, 300))
    2054
    """
    r1, r2 = radius_inner, radius_outer
    impossible(~(r1 < r2), r1, "radius_inner", 0.0, r2, INSIDE_OUT)
    cylinder = bowl_length * (0.75 * r2**2 + 0.25 * r1**2)
    beach = beach_length * (r2**2 + 3.0 * r1 * r2 + 4.0 * r1**2) / 8.0
    return 2.0 * jnp.pi * rotation_speed**2 / STANDARD_GRAVITY * (cylinder + beach)


@formula(
    source="ambler1959",
    equation=r"\Sigma = \frac{V\,\omega^2}{2 g\,\ln[2 r_o/(r_i + r_o)]}",
    typical={**_BOWL, "volume": (1e-5, 1e-3)},
    title="Sigma of a bottle centrifuge",
)
def sigma_factor_bottle(
    volume: Volume, radius_inner: Length, radius_outer: Length, rotation_speed: RotationSpeed
) -> Area:
    """Sigma of a laboratory bottle centrifuge, to scale up from a spin test: Q/Σ is volume per time over
    this.

    >>> round(sigma_factor_bottle("50 mL", 0.08, 0.12, 300), 2)
    1.26
    """
    impossible(~(radius_inner < radius_outer), radius_inner, "radius_inner", 0.0, radius_outer, INSIDE_OUT)
    return (
        volume
        * rotation_speed**2
        / (2.0 * STANDARD_GRAVITY * jnp.log(2.0 * radius_outer / (radius_inner + radius_outer)))
    )


@formula(
    source="ambler1959; richardson2002, ch. 9",
    fitted={"reynolds": (0.0, 2.0)},
    equation=r"d = \sqrt{\frac{18\,\eta\,Q}{j\,E\,\Sigma\,g\,(\rho_p - \rho_f)}}",
    typical=_MUD,
)
def cut_size_centrifuge(
    volume_flow: VolumeFlow,
    sigma_factor: Area,
    particle_density: Density,
    fluid_density: Density,
    dynamic_viscosity: DynamicViscosity,
    flow_multiple: PositiveNumber = 1.0,
    sigma_efficiency: PositiveNumber = 1.0,
) -> Length:
    """Cut size of a centrifuge from its flow and Sigma by Stokes' law.

    The flow multiple goes with the convention of Sigma: 1 where Q = v_g Σ (the size caught completely),
    2 where Q = 2 v_g Σ (half caught). Real machines reach 0.9 to 1 (tubular), 0.45 to 0.6 (disc) or 0.5 to
    0.7 (scroll) of their Sigma.

    The particle must settle by Stokes' law, under gravity at the least, where its Reynolds number is checked.

    >>> round(cut_size_centrifuge(0.002832 / 3600, 196.3, 1461, 801, 0.1, flow_multiple=2.0) * 1e6, 3)
    0.746
    """
    excess = particle_density - fluid_density
    some = excess > 0
    impossible(~some, particle_density, "particle_density", fluid_density, jnp.inf)
    settled = (
        flow_multiple * sigma_efficiency * sigma_factor * STANDARD_GRAVITY * jnp.where(some, excess, 1.0)
    )
    d = jnp.sqrt(18.0 * dynamic_viscosity * volume_flow / settled)
    watch(
        reynolds=fluid_density
        * stokes_velocity(d, jnp.where(some, excess, 1.0), dynamic_viscosity)
        * d
        / dynamic_viscosity
    )
    return jnp.where(some, d, jnp.inf)


@formula(
    source="ambler1959; richardson2002, ch. 9",
    title="Volume flow that a centrifuge clarifies",
    fitted={"reynolds": (0.0, 2.0)},
    equation=r"Q = j\,E\,\Sigma\,\frac{d_p^2 (\rho_p - \rho_f)\,g}{18\,\eta}",
    typical={**_MUD, "particle_diameter": (1e-6, 1e-5)},
)
def volume_flow_centrifuge(
    particle_diameter: Length,
    sigma_factor: Area,
    particle_density: Density,
    fluid_density: Density,
    dynamic_viscosity: DynamicViscosity,
    flow_multiple: PositiveNumber = 1.0,
    sigma_efficiency: PositiveNumber = 1.0,
) -> VolumeFlow:
    """Flow at which a centrifuge catches a size; the way back from the cut size, with the same conventions.

    The particle must settle by Stokes' law, under gravity at the least, where its Reynolds number is checked.

    >>> round(volume_flow_centrifuge("0.746 um", 196.3, 1461, 801, 0.1, flow_multiple=2.0) * 3600, 6)
    0.002828
    """
    excess = jnp.maximum(jnp.asarray(particle_density) - fluid_density, 0.0)
    velocity = stokes_velocity(particle_diameter, excess, dynamic_viscosity)
    watch(reynolds=fluid_density * velocity * particle_diameter / dynamic_viscosity)
    return flow_multiple * sigma_efficiency * sigma_factor * velocity


@formula(
    source="ambler1959",
    equation=r"Q_2 = Q_1\,\frac{E_2\,\Sigma_2}{E_1\,\Sigma_1}",
    typical={
        "sigma_factor": (1.0, 500.0),
        "sigma_factor_other": (500.0, 50000.0),
        "volume_flow": (1e-6, 1e-3),
    },
    title="Flow of another centrifuge at equal separation (Sigma scale-up)",
    symbols={
        "volume_flow": "Q_1",
        "sigma_factor": r"\Sigma_1",
        "sigma_factor_other": r"\Sigma_2",
        "=volume_flow": "Q_2",
    },
)
def volume_flow_other_centrifuge(
    volume_flow: VolumeFlow,
    sigma_factor: Area,
    sigma_factor_other: Area,
    sigma_efficiency: PositiveNumber = 1.0,
    sigma_efficiency_other: PositiveNumber = 1.0,
) -> VolumeFlow:
    """Flow at which another machine separates the same suspension equally well: flow over Sigma is kept.

    Between machines of different kinds each Sigma counts by the share of it that the machine reaches.

    >>> round(
    ...     volume_flow_other_centrifuge(
    ...         "1 L/min", 50.0, 5000.0, sigma_efficiency=0.9, sigma_efficiency_other=0.45
    ...     )
    ...     * 60000,
    ...     1,
    ... )
    50.0
    """
    return volume_flow * (sigma_efficiency_other * sigma_factor_other) / (sigma_efficiency * sigma_factor)


@formula(
    source="records2001",
    equation=r"Q_2 = Q_1\,\frac{K_2 V_2}{K_1 V_1}",
    output="volume_flow",
    typical={
        "volume_flow": (1e-5, 1e-3),
        "centrifugal_effect": (500.0, 3000.0),
        "pool_volume": (1e-3, 0.1),
        "centrifugal_effect_other": (500.0, 3000.0),
        "pool_volume_other": (0.1, 1.0),
    },
    title="Flow of another centrifuge at equal g-volume",
    symbols={
        "volume_flow": r"Q_1",
        "=volume_flow": r"Q_2",
        "centrifugal_effect": r"K_1",
        "pool_volume": r"V_1",
        "centrifugal_effect_other": r"K_2",
        "pool_volume_other": r"V_2",
    },
)
def volume_flow_g_volume(
    volume_flow: VolumeFlow,
    centrifugal_effect: PositiveNumber,
    pool_volume: Volume,
    centrifugal_effect_other: PositiveNumber,
    pool_volume_other: Volume,
) -> VolumeFlow:
    """Flow at which another decanter keeps the product of centrifugal effect and stay in the pool: the rule
    of practice for sludge that is compacted rather than settled.

    >>> round(volume_flow_g_volume("1 m^3/hour", 2000.0, "20 L", 3000.0, "200 L") * 3600, 6)
    15.0
    """
    impossible(~(pool_volume > 0), pool_volume, "pool_volume", 0.0, jnp.inf)
    grown = centrifugal_effect_other * pool_volume_other / centrifugal_effect
    return volume_flow * grown / jnp.where(pool_volume > 0, pool_volume, 1.0)


@formula(
    source="svarovsky2001",
    title="Grade efficiency of a tubular bowl",
    equation=(
        r"E = \min\left(1,\;\frac{1 - \exp(-2 v_t\omega^2\tau/g)}{1 - (r_i/r_o)^2}\right),\quad \tau = "
        r"\frac{\pi L (r_o^2 - r_i^2)}{Q}"
    ),
    typical={**_BOWL, "terminal_velocity": (1e-9, 1e-7), "volume_flow": (1e-4, 1e-2)},
    output="grade_efficiency",
)
def grade_efficiency_tubular(
    terminal_velocity: Speed,
    volume_flow: VolumeFlow,
    bowl_length: Length,
    radius_inner: Length,
    radius_outer: Length,
    rotation_speed: RotationSpeed,
) -> Fraction:
    """Share of a size caught in a tubular bowl with plug flow, from its settling velocity under gravity.

    >>> round(grade_efficiency_tubular(1e-8, 1e-3, 1.0, 0.1, 0.2, 1000.0), 4)
    0.2332
    """
    r1, r2 = radius_inner, radius_outer
    impossible(~(r1 < r2), r1, "radius_inner", 0.0, r2, INSIDE_OUT)
    hold_up = jnp.pi * bowl_length * (r2**2 - r1**2) / volume_flow
    swept = -jnp.expm1(-2.0 * terminal_velocity * rotation_speed**2 * hold_up / STANDARD_GRAVITY)
    return jnp.minimum(swept / (1.0 - (r1 / r2) ** 2), 1.0)


@formula(
    source="svarovsky2001",
    equation=(
        r"E = \min\left(1,\;\frac{\exp(2 v_t\omega^2\tau/g) - 1}{(r_o/r_i)^2 - 1}\right),\quad \tau = "
        r"\frac{\pi L (r_o^2 - r_i^2)}{Q}"
    ),
    typical={**_BOWL, "terminal_velocity": (1e-9, 1e-8), "volume_flow": (1e-4, 1e-2)},
    output="grade_efficiency",
    title="Share of a size that rises out in a tubular bowl",
)
def grade_efficiency_tubular_rising(
    terminal_velocity: Speed,
    volume_flow: VolumeFlow,
    bowl_length: Length,
    radius_inner: Length,
    radius_outer: Length,
    rotation_speed: RotationSpeed,
) -> Fraction:
    """Share of a size of drops or light particles that reaches the inner radius of a tubular bowl with plug
    flow, from its rising speed under gravity.

    The way back of the sinking particle: it starts fast, at the wall, and slows down as the field weakens.
    Derived as the law of the sinking one is.

    >>> round(grade_efficiency_tubular_rising(1e-8, 1e-3, 1.0, 0.1, 0.2, 1000.0), 4)
    0.0706
    """
    r1, r2 = radius_inner, radius_outer
    impossible(~(r1 < r2), r1, "radius_inner", 0.0, r2, INSIDE_OUT)
    hold_up = jnp.pi * bowl_length * (r2**2 - r1**2) / volume_flow
    path = 2.0 * terminal_velocity * rotation_speed**2 * hold_up / STANDARD_GRAVITY
    whole = jnp.log(r2 / r1) * 2.0
    return jnp.minimum(jnp.expm1(jnp.minimum(path, whole)) / ((r2 / r1) ** 2 - 1.0), 1.0)


@formula(
    source="svarovsky2001",
    title="Grade efficiency of a thin layer",
    equation=r"E = \min(1,\; v_t\,\Sigma/Q)",
    typical={"terminal_velocity": (1e-9, 1e-8), "volume_flow": (1e-4, 1e-2), "sigma_factor": (500.0, 5000.0)},
    output="grade_efficiency",
)
def grade_efficiency_thin_layer(
    terminal_velocity: Speed, volume_flow: VolumeFlow, sigma_factor: Area
) -> Fraction:
    """Share of a size caught where the liquid layer is thin against its radius: between discs, in shallow
    pools.

    >>> round(grade_efficiency_thin_layer(1e-8, 1e-3, 20000), 6)
    0.2
    """
    return jnp.minimum(terminal_velocity * sigma_factor / volume_flow, 1.0)


_LIQUIDS = {
    "density_heavy": (1000.0, 1300.0),
    "density_light": (750.0, 950.0),
    "radius_heavy": (0.05, 0.06),
    "radius_light": (0.045, 0.0475),
    "radius_interface": (0.055, 0.08),
}


@formula(
    source="mccabe2005, ch. 29",
    equation=r"r_i^2 = \frac{\rho_H r_H^2 - \rho_L r_L^2}{\rho_H - \rho_L}",
    typical=_LIQUIDS,
    title="Interface of two liquids in a bowl",
)
def radius_interface(
    radius_heavy: Length, radius_light: Length, density_heavy: Density, density_light: Density
) -> Length:
    """Radius of the neutral zone between two liquids, from the radii over which each leaves.

    >>> round(
    ...     radius_interface(
    ...         radius_heavy=0.010414, radius_light=0.010160, density_heavy=919.5, density_light=865
    ...     )
    ...     * 1e3,
    ...     2,
    ... )
    13.83
    """
    impossible(density_heavy <= density_light, density_heavy, "density_heavy", density_light, jnp.inf)
    square = (density_heavy * radius_heavy**2 - density_light * radius_light**2) / (
        density_heavy - density_light
    )
    impossible(
        ~(square > 0),
        radius_heavy,
        "radius_heavy",
        radius_light * jnp.sqrt(density_light / density_heavy),
        jnp.inf,
        NO_INTERFACE,
    )
    return jnp.sqrt(jnp.where(square > 0, square, jnp.nan))


@formula(
    source="mccabe2005, ch. 29",
    equation=r"r_H^2 = r_i^2 - \frac{\rho_L}{\rho_H}\,(r_i^2 - r_L^2)",
    typical=_LIQUIDS,
    title="Radius of the ring dam for the heavy liquid",
)
def radius_heavy_dam(
    radius_interface: Length, radius_light: Length, density_heavy: Density, density_light: Density
) -> Length:
    """Radius of the overflow of the heavy liquid (ring dam, gravity disc) that puts the interface where it is
    wanted.

    >>> round(
    ...     radius_heavy_dam(radius_interface=0.08, radius_light=0.05, density_heavy=1000, density_light=900),
    ...     5,
    ... )
    0.05376
    """
    impossible(density_heavy <= density_light, density_heavy, "density_heavy", density_light, jnp.inf)
    impossible(
        ~(radius_interface > radius_light), radius_interface, "radius_interface", radius_light, jnp.inf
    )
    i2, l2 = radius_interface**2, radius_light**2
    return jnp.sqrt(i2 - density_light / density_heavy * (i2 - l2))
