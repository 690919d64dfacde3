"""Grade efficiency of gas cyclones: the family ``cyclone_efficiency``. All laws take the same lengths (see
``Dimensions``).
"""

from __future__ import annotations

import math
from typing import Any

import jax.numpy as jnp

from granum.core import formula, impossible
from granum.core.constants import STANDARD_GRAVITY
from granum.core.kinds import (
    Density,
    DynamicViscosity,
    Fraction,
    Length,
    MassRatio,
    PositiveNumber,
    Ratio,
    Speed,
    Temperature,
    VolumeFlow,
)
from granum.cyclones.geometry import Dimensions, takes_lengths

TYPICAL = {
    "particle_diameter": (1e-6, 2e-5), "volume_flow": (1.0, 2.0), "fluid_density": (0.6, 1.3), "dynamic_viscosity": (1.7e-5, 3e-5),  # noqa: E501
    "diameter": (0.9, 1.1), "inlet_height": (0.45, 0.55), "inlet_width": (0.18, 0.22), "outlet_diameter": (0.45, 0.55),  # noqa: E501
    "finder_length": (0.5, 0.6), "cylinder_height": (1.3, 1.6), "height": (3.5, 4.2), "dust_outlet_diameter": (0.35, 0.42),  # noqa: E501
}  # fmt: skip
ORDER = 5.0  # usual steepness of a well-designed cyclone, Hoffmann and Stein: 2 to 6


def smooth_grade(d: Any, cut: Any, m: Any) -> Any:
    """S-curve over the size relative to the cut."""
    return 1.0 / (1.0 + (cut / d) ** m)


def heavier(rho_p: Any, rho: Any) -> Any:
    """Density above that of the gas; NaN with a flag where there is none."""
    difference = jnp.asarray(rho_p - rho, dtype=float)
    impossible(difference <= 0.0, rho_p, "particle_density", rho, jnp.inf)
    return jnp.where(difference > 0.0, difference, jnp.nan)


@formula(
    source="lapple1951",
    equation=r"d_{50} = \sqrt{\frac{9\eta b}{2\pi N v(\rho_p - \rho_f)}}",
    output="cut_size",
    typical={**TYPICAL, "velocity": (12.0, 25.0)},
)
def cut_size_lapple(
    velocity: Speed,
    inlet_width: Length,
    particle_density: Density,
    fluid_density: Density,
    dynamic_viscosity: DynamicViscosity,
    turn_number: PositiveNumber = 5.0,
) -> Length:
    """Cut size of a cyclone by Lapple, from inlet velocity, inlet width and number of turns.

    Known as cut diameter or d50 too: the size collected by half.

    >>> round(
    ...     1e6
    ...     * cut_size_lapple(
    ...         velocity=20.0,
    ...         inlet_width=0.15,
    ...         particle_density=1001.0,
    ...         fluid_density=1.0,
    ...         dynamic_viscosity=2.08e-5,
    ...         turn_number=8.0,
    ...     ),
    ...     2,
    ... )
    5.29
    """
    return jnp.sqrt(
        9.0
        * dynamic_viscosity
        * inlet_width
        / (2.0 * jnp.pi * turn_number * velocity * heavier(particle_density, fluid_density))
    )


@formula(
    source="lapple1951; cooper2011",
    equation=r"N = \frac{1}{a}\left(h + \frac{H-h}{2}\right)",
    typical=TYPICAL,
)
def turn_number_lapple(inlet_height: Length, cylinder_height: Length, height: Length) -> PositiveNumber:
    """Number of turns of the gas in a cyclone by Lapple, from its heights.

    >>> turn_number_lapple(inlet_height=0.5, cylinder_height=2.0, height=4.0)
    6.0
    """
    return (cylinder_height + (height - cylinder_height) / 2.0) / inlet_height


@formula(
    source="rosin1932; lapple1951",
    title="Cut size from the number of turns",
    equation=r"d_{50} = \sqrt{\frac{9\,\eta\,(R_2 - R_1)}{\pi N v\,(\rho_p - \rho_f)}},\quad R_2 = \frac D2",
    output="cut_size",
    typical={**TYPICAL, "velocity": (1.0, 20.0)},
)
def cut_size_turns(
    velocity: Speed,
    diameter: Length,
    particle_density: Density,
    fluid_density: Density,
    dynamic_viscosity: DynamicViscosity,
    turn_number: PositiveNumber = 4.0,
    radius_ratio: Fraction = 0.5,
) -> Length:
    """Smallest particle wholly separated by a cyclone in which the gas makes a given number of turns at
    constant velocity.

    The particle crosses from the inner to the outer radius while the gas runs its spiral; four turns and an
    inner radius of half the outer give the short form. Differs from the print: the notes' time in the spiral
    has twice the path π(R1 + R2)N; their result does not.

    The notes' exercise, 28.6 µm:

    >>> round(
    ...     1e6
    ...     * cut_size_turns(
    ...         velocity="14.5 cm/s",
    ...         diameter=0.7,
    ...         particle_density=19000,
    ...         fluid_density=1e-9,
    ...         dynamic_viscosity="0.018 mPa*s",
    ...     ),
    ...     1,
    ... )
    28.6
    """
    gap = diameter / 2.0 * (1.0 - radius_ratio)
    return jnp.sqrt(
        9.0
        * dynamic_viscosity
        * gap
        / (jnp.pi * turn_number * velocity * heavier(particle_density, fluid_density))
    )


@formula(
    source="lapple1951",
    family="cyclone_efficiency",
    equation=(
        r"\eta = \frac{1}{1 + (d_{50}/d_p)^2},\quad d_{50} = d_{50}(Q, \rho_p, \rho_f, \eta; D, a, b, "
        r"D_e, S, h, H, B)"
    ),
    typical=TYPICAL,
)
@takes_lengths
def cyclone_efficiency_lapple(
    particle_diameter: Length,
    volume_flow: VolumeFlow,
    particle_density: Density,
    fluid_density: Density,
    dynamic_viscosity: DynamicViscosity,
    cyclone: Dimensions,
    turn_number: PositiveNumber | None = None,
) -> Fraction:
    """Grade efficiency of a gas cyclone by Lapple.

    Known as fractional collection efficiency too. The turns are those of the heights of the cyclone unless
    they are given, as exercises do.

    >>> d = dict(
    ...     diameter=1.0,
    ...     inlet_height=0.5,
    ...     inlet_width=0.25,
    ...     outlet_diameter=0.5,
    ...     finder_length=0.625,
    ...     cylinder_height=2.0,
    ...     height=4.0,
    ...     dust_outlet_diameter=0.25,
    ... )
    >>> 0.5 < cyclone_efficiency_lapple(
    ...     particle_diameter="10 um",
    ...     volume_flow=2.0,
    ...     particle_density=2000,
    ...     fluid_density=1.2,
    ...     dynamic_viscosity=1.8e-5,
    ...     **d,
    ... ) < 0.9
    True
    """
    v = volume_flow / (cyclone.inlet_height * cyclone.inlet_width)
    turns = (
        turn_number_lapple(cyclone.inlet_height, cyclone.cylinder_height, cyclone.height)
        if turn_number is None
        else turn_number
    )
    cut = cut_size_lapple(v, cyclone.inlet_width, particle_density, fluid_density, dynamic_viscosity, turns)
    return smooth_grade(particle_diameter, cut, 2.0)


@formula(
    source="leith1972; leith1973",
    equation=(
        r"G = \frac{8 K_c}{K_a^2 K_b^2},\quad K_a = \frac aD,\ K_b = \frac bD,\ K_c = K_c(D, D_e, S, h, "
        r"H, B)"
    ),
    output="configuration_number",
    typical=TYPICAL,
)
@takes_lengths
def configuration_number_leith_licht(
    cyclone: Dimensions,
) -> PositiveNumber:
    """Configuration number of a cyclone for Leith and Licht's efficiency, from its lengths.

    Stairmand's high-efficiency design, 551.3 in print:

    >>> round(
    ...     configuration_number_leith_licht(
    ...         diameter=1.0,
    ...         inlet_height=0.5,
    ...         inlet_width=0.2,
    ...         outlet_diameter=0.5,
    ...         finder_length=0.5,
    ...         cylinder_height=1.5,
    ...         height=4.0,
    ...         dust_outlet_diameter=0.375,
    ...     )
    ... )
    551
    """
    D, a, b, De, S, h, H, B = cyclone
    # length of the vortex below the finder
    natural = jnp.minimum(2.3 * De * (D**2 / (a * b)) ** (1.0 / 3.0), H - S)
    above = jnp.pi * (S - a / 2.0) * (D**2 - De**2) / 4.0
    end = D - (D - B) * (S + natural - h) / (H - h)
    core = jnp.pi * De**2 * natural / 4.0
    cone = jnp.pi * D**2 / 12.0 * (natural + S - h) * (1.0 + end / D + (end / D) ** 2)
    below = jnp.pi * D**2 / 4.0 * (h - S) + cone - core
    return 8.0 * (above + below / 2.0) * D / (a * b) ** 2


@formula(
    source="leith1972",
    equation=r"n = 1 - (1 - 0.67 D^{0.14})(T/283)^{0.3}",
    output="vortex_exponent",
    typical=TYPICAL,
)
def vortex_exponent_alexander(diameter: Length, temperature: Temperature = 293.15) -> Fraction:
    """Exponent of the vortex in a cyclone by Alexander.

    >>> round(vortex_exponent_alexander(diameter=1.0, temperature=283.0), 6)
    0.67
    """
    return 1.0 - (1.0 - 0.67 * diameter**0.14) * (temperature / 283.0) ** 0.3


@formula(
    source="leith1972",
    family="cyclone_efficiency",
    equation=(
        r"\eta = 1 - \exp\left\{-2\left[\frac{G\tau Q(n+1)}{D^3}\right]^{1/(2n+2)}\right\},\ \tau = "
        r"\frac{(\rho_p - \rho_f) d_p^2}{18\eta},\quad G = G(D, a, b, D_e, S, h, H, B)"
    ),
    typical=TYPICAL,
)
@takes_lengths
def cyclone_efficiency_leith_licht(
    particle_diameter: Length,
    volume_flow: VolumeFlow,
    particle_density: Density,
    fluid_density: Density,
    dynamic_viscosity: DynamicViscosity,
    cyclone: Dimensions,
    temperature: Temperature = 293.15,
) -> Fraction:
    """Grade efficiency of a gas cyclone by Leith and Licht, with the dust mixed over the radius.

    >>> d = dict(
    ...     diameter=1.0,
    ...     inlet_height=0.5,
    ...     inlet_width=0.2,
    ...     outlet_diameter=0.5,
    ...     finder_length=0.5,
    ...     cylinder_height=1.5,
    ...     height=4.0,
    ...     dust_outlet_diameter=0.375,
    ... )
    >>> 0.7 < cyclone_efficiency_leith_licht(
    ...     particle_diameter="10 um",
    ...     volume_flow=1.5,
    ...     particle_density=2000,
    ...     fluid_density=1.2,
    ...     dynamic_viscosity=1.8e-5,
    ...     **d,
    ... ) < 0.95
    True
    """
    G = configuration_number_leith_licht(*cyclone)
    n = vortex_exponent_alexander(cyclone.diameter, temperature)
    relaxation = heavier(particle_density, fluid_density) * particle_diameter**2 / (18.0 * dynamic_viscosity)
    return -jnp.expm1(
        -2.0 * (G * relaxation * volume_flow * (n + 1.0) / cyclone.diameter**3) ** (0.5 / (n + 1.0))
    )


def core_height(cyclone: Dimensions) -> Any:
    """Height of the cylinder that continues the vortex finder down to the bottom or to the wall of the
    cone.
    """
    D, _a, _b, De, S, h, H, B = cyclone
    narrow = (D - De) / jnp.where(D > B, D - B, 1.0) * (H - h) + h - S
    return jnp.where(De > B, narrow, H - S)


@formula(
    source="barth1956; hoffmann2008",
    equation=(
        r"\frac{v_\theta}{v_x} = \left(\frac{\alpha a b}{\pi R_x R_i} + \frac{\lambda "
        r"H_c}{R_x}\right)^{-1},\ d_{50} = \sqrt{\frac{9\eta Q}{\pi H_c (\rho_p - \rho_f) "
        r"v_\theta^2}},\quad R_x = \frac{D_e}{2},\ R_i = \frac{D - b}{2},\ v_x = \frac{Q}{\pi R_x^2},\ "
        r"H_c = H_c(D, D_e, S, h, H, B)"
    ),
    output="cut_size",
    typical=TYPICAL,
)
@takes_lengths
def cut_size_barth(
    volume_flow: VolumeFlow,
    particle_density: Density,
    fluid_density: Density,
    dynamic_viscosity: DynamicViscosity,
    cyclone: Dimensions,
    wall_friction: Ratio = 0.005,
) -> Length:
    """Cut size of a gas cyclone by Barth: the particle that circles under the edge of the vortex finder.

    >>> d = dict(
    ...     diameter=1.0,
    ...     inlet_height=0.5,
    ...     inlet_width=0.2,
    ...     outlet_diameter=0.5,
    ...     finder_length=0.5,
    ...     cylinder_height=1.5,
    ...     height=4.0,
    ...     dust_outlet_diameter=0.375,
    ... )
    >>> 1e-6 < cut_size_barth(
    ...     volume_flow=1.5, particle_density=2000, fluid_density=1.2, dynamic_viscosity=1.8e-5, **d
    ... ) < 5e-6
    True
    """
    v, H_c, _v_x = core_flow(volume_flow, cyclone, wall_friction)
    return jnp.sqrt(
        9.0
        * dynamic_viscosity
        * volume_flow
        / (jnp.pi * H_c * heavier(particle_density, fluid_density) * v**2)
    )


def core_flow(Q: Any, cyclone: Dimensions, friction: Any) -> tuple[Any, Any, Any]:
    """Barth's swirl velocity at the core, height of the core, velocity in the vortex finder."""
    D, a, b, De = cyclone[:4]
    constriction = 1.0 - 0.4 * jnp.sqrt(2.0 * b / D)
    H_c, R_x, R_in = core_height(cyclone), De / 2.0, (D - b) / 2.0
    v_x = Q / (jnp.pi * R_x**2)
    return v_x / (constriction * a * b / (jnp.pi * R_x * R_in) + friction * H_c / R_x), H_c, v_x


@formula(
    source="barth1956; hoffmann2008",
    family="cyclone_efficiency",
    equation=(
        r"\eta = \frac{1}{1 + (d_{50}/d_p)^m},\quad d_{50} = d_{50}(Q, \rho_p, \rho_f, \eta; D, a, b, "
        r"D_e, S, h, H, B)"
    ),
    fitted={"grade_exponent": (2.0, 6.0)},
    typical=TYPICAL,
)
@takes_lengths
def cyclone_efficiency_barth(
    particle_diameter: Length,
    volume_flow: VolumeFlow,
    particle_density: Density,
    fluid_density: Density,
    dynamic_viscosity: DynamicViscosity,
    cyclone: Dimensions,
    wall_friction: Ratio = 0.005,
    grade_exponent: PositiveNumber = ORDER,
) -> Fraction:
    """Grade efficiency of a gas cyclone by Barth's cut size and an S-curve.

    Well-designed cyclones have exponents of 2 to 6 (Hoffmann and Stein).

    >>> d = dict(
    ...     diameter=1.0,
    ...     inlet_height=0.5,
    ...     inlet_width=0.2,
    ...     outlet_diameter=0.5,
    ...     finder_length=0.5,
    ...     cylinder_height=1.5,
    ...     height=4.0,
    ...     dust_outlet_diameter=0.375,
    ... )
    >>> cyclone_efficiency_barth(
    ...     particle_diameter="20 um",
    ...     volume_flow=1.5,
    ...     particle_density=2000,
    ...     fluid_density=1.2,
    ...     dynamic_viscosity=1.8e-5,
    ...     **d,
    ... ) > 0.99
    True
    """
    cut = cut_size_barth(
        volume_flow, particle_density, fluid_density, dynamic_viscosity, *cyclone, wall_friction
    )
    return smooth_grade(particle_diameter, cut, grade_exponent)


def wall_area(cyclone: Dimensions) -> Any:
    """Inner surface that the gas rubs: roof, cylinder, cone and outside of the vortex finder."""
    D, _a, _b, De, S, h, H, B = cyclone
    slant = jnp.sqrt((H - h) ** 2 + ((D - B) / 2.0) ** 2)
    return jnp.pi * ((D**2 - De**2) / 4.0 + D * h + (D + B) / 2.0 * slant + De * S)


def muschelknautz_flow(
    Q: Any, rho: Any, rho_p: Any, loading: Any, cyclone: Dimensions, friction: Any
) -> tuple[Any, Any, Any, Any, Any]:
    """Velocity at the wall and at the core, in the vortex finder, total friction factor, wall area."""
    D, a, b, De = cyclone[:4]
    R, R_x = D / 2.0, De / 2.0
    x = b / R
    inner = jnp.sqrt(jnp.maximum(1.0 - (1.0 - x**2) * (2.0 * x - x**2) / (1.0 + loading), 1e-12))
    constriction = (1.0 - jnp.sqrt(jnp.maximum(1.0 + 4.0 * ((x / 2.0) ** 2 - x / 2.0) * inner, 1e-12))) / x
    v_in, v_x = Q / (a * b), Q / (jnp.pi * R_x**2)
    wall = v_in * (R - b / 2.0) / (constriction * R)
    area = wall_area(cyclone)
    froude = v_x / jnp.sqrt(2.0 * STANDARD_GRAVITY * R_x)
    strand = 0.4 * rho_p  # density of the dust layer that slides along the wall
    total = friction + 0.25 * (R / R_x) ** -0.625 * jnp.sqrt(
        jnp.maximum(0.9 * loading * froude * rho / strand, 1e-30)
    )
    core = wall * (R / R_x) / (1.0 + total * area * wall * jnp.sqrt(R / R_x) / (2.0 * Q))
    return wall, core, v_x, total, area


@formula(
    source="muschelknautz1972; hoffmann2008, ch. 6",
    equation=(
        r"v_{\theta} = \frac{v_w R/R_x}{1 + f A_R v_w\sqrt{R/R_x}/(2Q)},\ d_{50} = "
        r"\sqrt{\frac{18\eta\,0.9 Q}{2\pi(\rho_p-\rho_f)v_\theta^2(H-S)}},\quad R = \frac D2,\ R_x = "
        r"\frac{D_e}{2},\ v_w = v_w(Q, a, b, D),\ A_R = A_R(D, D_e, S, h, H, B)"
    ),
    output="cut_size",
    typical=TYPICAL,
)
@takes_lengths
def cut_size_muschelknautz(
    volume_flow: VolumeFlow,
    particle_density: Density,
    fluid_density: Density,
    dynamic_viscosity: DynamicViscosity,
    cyclone: Dimensions,
    dust_loading: MassRatio = 0.0,
    gas_friction: Ratio = 0.005,
) -> Length:
    """Cut size of the inner vortex of a gas cyclone by Muschelknautz; dust on the wall brakes the swirl and
    coarsens it.

    The friction factor is that of clean gas; the dust adds its own.

    >>> d = dict(
    ...     diameter=1.0,
    ...     inlet_height=0.5,
    ...     inlet_width=0.2,
    ...     outlet_diameter=0.5,
    ...     finder_length=0.5,
    ...     cylinder_height=1.5,
    ...     height=4.0,
    ...     dust_outlet_diameter=0.375,
    ... )
    >>> 1e-6 < cut_size_muschelknautz(
    ...     volume_flow=1.5, particle_density=2000, fluid_density=1.2, dynamic_viscosity=1.8e-5, **d
    ... ) < 5e-6
    True
    """
    _w, core, *_rest = muschelknautz_flow(
        volume_flow, fluid_density, particle_density, dust_loading, cyclone, gas_friction
    )
    inward = 0.9 * volume_flow / (jnp.pi * cyclone.outlet_diameter * (cyclone.height - cyclone.finder_length))
    return jnp.sqrt(
        9.0
        * dynamic_viscosity
        * cyclone.outlet_diameter
        * inward
        / (heavier(particle_density, fluid_density) * core**2)
    )


@formula(
    source="muschelknautz1972; hoffmann2008, ch. 6",
    family="cyclone_efficiency",
    equation=(
        r"\eta = \frac{1}{1 + (d_{50}/d_p)^m},\quad d_{50} = d_{50}(Q, \rho_p, \rho_f, \eta; D, a, b, "
        r"D_e, S, h, H, B)"
    ),
    fitted={"grade_exponent": (2.0, 6.0)},
    typical=TYPICAL,
)
@takes_lengths
def cyclone_efficiency_muschelknautz(
    particle_diameter: Length,
    volume_flow: VolumeFlow,
    particle_density: Density,
    fluid_density: Density,
    dynamic_viscosity: DynamicViscosity,
    cyclone: Dimensions,
    dust_loading: MassRatio = 0.0,
    gas_friction: Ratio = 0.005,
    grade_exponent: PositiveNumber = ORDER,
) -> Fraction:
    """Grade efficiency of the inner vortex of a gas cyclone by Muschelknautz.

    Well-designed cyclones have exponents of 2 to 6 (Hoffmann and Stein).

    >>> d = dict(
    ...     diameter=1.0,
    ...     inlet_height=0.5,
    ...     inlet_width=0.2,
    ...     outlet_diameter=0.5,
    ...     finder_length=0.5,
    ...     cylinder_height=1.5,
    ...     height=4.0,
    ...     dust_outlet_diameter=0.375,
    ... )
    >>> cyclone_efficiency_muschelknautz(
    ...     particle_diameter="20 um",
    ...     volume_flow=1.5,
    ...     particle_density=2000,
    ...     fluid_density=1.2,
    ...     dynamic_viscosity=1.8e-5,
    ...     **d,
    ... ) > 0.99
    True
    """
    cut = cut_size_muschelknautz(
        volume_flow, particle_density, fluid_density, dynamic_viscosity, *cyclone, dust_loading, gas_friction
    )
    return smooth_grade(particle_diameter, cut, grade_exponent)


THINNEST = math.exp(-0.879741 / 0.2) / 10.0  # dust per gas at which the share that is carried is largest


@formula(
    source="muschelknautz1972; hoffmann2008, ch. 6; dyssol2022",
    equation=(
        r"c_{oL} = 0.025\,\frac{d_{50}}{d_{med}}(10 c_0)^k,\quad k = 0.15\ (c_0 \ge 0.1),\ -0.11 - 0.10 \ln "
        r"c_0\ (c_0 < 0.1);\qquad c_{oL} \propto c_0^{0.81}\ (c_0 < 0.00123)"
    ),
    typical={"dust_loading": (0.01, 2.0), "cut_size": (1e-6, 4e-6), "median_diameter": (1e-5, 3e-5)},
    symbols={"median_diameter": "d_{med}"},
)
def limit_loading_muschelknautz(
    dust_loading: PositiveNumber, cut_size: Length, median_diameter: Length
) -> MassRatio:
    """Dust per gas that the swirl can carry by Muschelknautz; what exceeds it falls out at the inlet whatever
    its size.

    Differs from the print: below 1.2 g/kg its exponent would have the swirl carry an ever smaller share, at
    10 mg/kg a tenth, and thin dust fall out nearly whole. There the limit falls with the power 0.81 of the
    loading, in which the later form of the method ends, so that the thinner dust is, the more of it is left
    to the swirl.

    >>> round(limit_loading_muschelknautz(dust_loading=0.1, cut_size=2e-6, median_diameter=2e-5), 6)
    0.0025
    """
    c = jnp.maximum(dust_loading, THINNEST)
    k = jnp.where(c >= 0.1, 0.15, -0.11 - 0.10 * jnp.log(c))
    thinner = (dust_loading / c) ** 0.81
    return 0.025 * cut_size / median_diameter * (10.0 * c) ** k * thinner
