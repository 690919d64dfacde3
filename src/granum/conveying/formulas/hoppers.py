"""Hoppers and silos: discharge through an orifice, walls steep enough to slide, outlets too wide to arch,
stresses on the walls.
"""

from __future__ import annotations

from typing import Annotated, Any, Literal, NamedTuple

import jax.numpy as jnp

from granum.core import formula, impossible
from granum.core.constants import STANDARD_GRAVITY
from granum.core.kinds import (
    Angle,
    Density,
    Distance,
    Length,
    MassFlow,
    PositiveNumber,
    Ratio,
    Stress,
    Within,
)
from granum.numerics.roots import find_root

DEGREE = jnp.pi / 180.0
Friction = Annotated[Angle, Within(1.0 * DEGREE, 75.0 * DEGREE)]
Wall = Annotated[Angle, Within(1.0 * DEGREE, 70.0 * DEGREE)]
HalfAngle = Annotated[Angle, Within(1.0 * DEGREE, 80.0 * DEGREE)]
Shape = Literal["cone", "wedge"]
Strength = Annotated[Stress, Within(0.0, 1e9)]
Power = Annotated[PositiveNumber, Within(0.05, 1.0)]
KILOPASCAL = 1000.0  # in which powers of a stress are printed
TINY, MOST = 1e-12, 1e5  # kPa
ROUGH = "A wall cannot rub more than the solid itself: its friction angle must stay below the effective one."
NO_FLOW = (
    "The strength grows faster with consolidation than the stress in an arch: no outlet is wide enough; take "
    "a steeper or smoother hopper."
)
JAMMED = (
    "The orifice is too narrow for the grains: it must be wider than k times their diameter, the empty ring "
    "of Beverloo's law."
)
_POWDER = {
    "effective_friction_angle": (35.0 * DEGREE, 55.0 * DEGREE),
    "wall_friction_angle": (10.0 * DEGREE, 30.0 * DEGREE),
    "hopper_half_angle": (10.0 * DEGREE, 35.0 * DEGREE),
}


@formula(
    source="beverloo1961",
    equation=r"\dot m = C_d\,\rho_b\,\sqrt g\,(D - k\,d_p)^{2.5}",
    typical={
        "bulk_density": (500.0, 1600.0),
        "diameter": (0.02, 0.3),
        "particle_diameter": (5e-4, 5e-3),
        "discharge_coefficient": (0.55, 0.65),
        "empty_annulus": (1.0, 2.0),
    },
    output="mass_flow",
    title="Discharge of a hopper (Beverloo)",
)
def mass_flow_beverloo(
    bulk_density: Density,
    diameter: Length,
    particle_diameter: Length,
    discharge_coefficient: PositiveNumber = 0.583,
    empty_annulus: PositiveNumber = 1.4,
) -> MassFlow:
    """Rate at which free-flowing grains leave a bin with a flat floor through a round orifice.

    The bulk density is that of the flowing solid. Powders below half a millimeter flow more slowly, as air
    must enter them.

    The print counts in g/min and cm with a factor of 35: 100 mm and 2 mm at 1000 kg/m³.

    >>> round(mass_flow_beverloo(1000.0, "100 mm", "2 mm") * 60e3 / (980.665**0.5 * (10 - 0.28) ** 2.5), 1)
    35.0
    """
    free = diameter - empty_annulus * particle_diameter
    least = empty_annulus * particle_diameter
    impossible(free <= 0.0, diameter, "diameter", least, jnp.inf, JAMMED)
    opened = jnp.maximum(free, 0.0) ** 2.5
    return discharge_coefficient * bulk_density * jnp.sqrt(STANDARD_GRAVITY) * opened


class WallStresses(NamedTuple):
    """Stresses at a depth of a silo: vertical, on the wall, and by friction along it."""

    stress_vertical: Stress
    stress_horizontal: Stress
    stress_wall_shear: Stress


@formula(
    source="janssen1895",
    equation=(
        r"\sigma_v = \frac{\rho_b\,g\,D}{4\,K\tan\varphi_w}\left(1 - e^{-4 K y\tan\varphi_w/D}\right),\quad "
        r"\sigma_h = K\,\sigma_v,\quad \tau_w = \sigma_h\tan\varphi_w"
    ),
    typical={
        "depth": (1.0, 30.0),
        "diameter": (1.0, 10.0),
        "bulk_density": (400.0, 1600.0),
        "wall_friction_angle": (15.0 * DEGREE, 35.0 * DEGREE),
        "stress_ratio": (0.35, 0.6),
    },
    title="Stresses in a silo (Janssen)",
)
def silo_stresses_janssen(
    depth: Distance,
    diameter: Length,
    bulk_density: Density,
    wall_friction_angle: Wall,
    stress_ratio: Annotated[PositiveNumber, Within(0.01, 5.0)] = 0.4,
) -> WallStresses:
    """Stresses in a solid at rest in a cylinder: friction at the wall carries what is deeper than a few
    diameters.

    Stresses of filling. Discharge and eccentric outlets load walls more: use a silo code for them.

    By hand: far down ρ g D/(4 K tan φ), here 1000·9.80665·2/(4·0.4·tan 20°).

    >>> round(silo_stresses_janssen(1000.0, 2.0, 1000.0, "20 degree").stress_vertical)
    33679
    """
    friction = jnp.tan(wall_friction_angle)
    rise = 4.0 * stress_ratio * friction / diameter
    vertical = bulk_density * STANDARD_GRAVITY * -jnp.expm1(-rise * depth) / rise
    horizontal = stress_ratio * vertical
    return WallStresses(vertical, horizontal, friction * horizontal)


def _wall_direction(effective_friction_angle: Any, wall_friction_angle: Any) -> Any:
    """Angle β between the major stress and the normal of a wall on which the solid slides."""
    effective, wall = effective_friction_angle, wall_friction_angle
    impossible(wall > effective, wall, "wall_friction_angle", 0.0, effective, ROUGH)
    share = jnp.sin(wall) / jnp.sin(effective)
    inside = share < 1.0
    slid = jnp.where(inside, jnp.arcsin(jnp.where(inside, share, 0.0)), 0.5 * jnp.pi)
    return 0.5 * (wall + slid)


@formula(
    source="jenike1964; arnold1976",
    equation=(
        r"\theta_m = \frac\pi2 - \frac12\arccos\frac{1 - \sin\varphi_e}{2\sin\varphi_e} - "
        r"\frac12\left(\varphi_w + \arcsin\frac{\sin\varphi_w}{\sin\varphi_e}\right)"
    ),
    typical={n: _POWDER[n] for n in ("effective_friction_angle", "wall_friction_angle")},
    title="Widest cone with mass flow (Jenike)",
)
def half_angle_mass_flow_cone(effective_friction_angle: Friction, wall_friction_angle: Wall) -> Angle:
    """Half the angle of a conical hopper up to which all of the solid moves; three degrees less are usual.

    Below an effective friction angle of 19.5° there is no bound of this form. No value where the wall is so
    rough that no cone moves as a whole.

    Rhodes's example, which was read: 30° and 19° give 30.5° from the chart.

    >>> round(half_angle_mass_flow_cone("30 degree", "19 degree") * 180 / 3.14159265, 1)
    30.2
    """
    sine = jnp.sin(effective_friction_angle)
    bound = jnp.clip((1.0 - sine) / (2.0 * sine), -1.0, 1.0 - 1e-12)
    direction = _wall_direction(effective_friction_angle, wall_friction_angle)
    angle = 0.5 * jnp.pi - 0.5 * jnp.arccos(bound) - direction
    return jnp.where(angle > 0.0, angle, jnp.nan)


@formula(
    source="arnold1976",
    equation=(
        r"\mathrm{ff} = \frac{Y(1 + \sin\varphi_e)\,H}{2(X - 1)\sin\theta},\quad "
        r"X = \frac{2^i\sin\varphi_e}{1 - \sin\varphi_e}\left(\frac{\sin(2\beta + \theta)}{\sin\theta} + 1"
        r"\right),\quad Y = \frac{[2(1 - \cos(\beta + \theta))]^i(\beta + \theta)^{1-i}\sin\theta + "
        r"\sin\beta\,\sin^{1+i}(\beta + \theta)}{(1 - \sin\varphi_e)\sin^{2+i}(\beta + \theta)},\quad "
        r"2\beta = \varphi_w + \arcsin\frac{\sin\varphi_w}{\sin\varphi_e}"
    ),
    typical=_POWDER,
    title="Flow factor of a hopper (Arnold and McLean)",
)
def flow_factor_hopper(
    effective_friction_angle: Friction,
    wall_friction_angle: Wall,
    hopper_half_angle: HalfAngle,
    hopper_shape: Shape = "cone",
) -> PositiveNumber:
    """Consolidating stress in a hopper with mass flow over the stress in an arch across it, in closed form
    after Jenike's radial stress field.

    i is 1 in a cone and 0 in a wedge, H that of ``outlet_width_jenike``. Constants recalled; the charts in
    two worked examples, which were read, say 1.8 for 30°, 19° and 27.5°, and 1.5 for 40°, 16° and 29.5°.

    >>> round(flow_factor_hopper("40 degree", "16 degree", "29.5 degree"), 2)
    1.5
    """
    cone = hopper_shape == "cone"
    i, theta, sine = float(cone), hopper_half_angle, jnp.sin(effective_friction_angle)
    beta = _wall_direction(effective_friction_angle, wall_friction_angle)
    both = beta + theta
    x = 2.0**i * sine / (1.0 - sine) * (jnp.sin(2.0 * beta + theta) / jnp.sin(theta) + 1.0)
    first = 2.0 * (1.0 - jnp.cos(both)) if cone else both
    above = first * jnp.sin(theta) + jnp.sin(beta) * jnp.sin(both) ** (1.0 + i)
    y = above / ((1.0 - sine) * jnp.sin(both) ** (2.0 + i))
    moves = x > 1.0
    factor = y * (1.0 + sine) / (2.0 * jnp.where(moves, x - 1.0, 1.0) * jnp.sin(theta))
    return jnp.where(moves, factor * _arch(theta, cone), jnp.nan)


def _arch(theta: Any, cone: bool) -> Any:
    return (130.0 + theta / DEGREE) / 65.0 if cone else (200.0 + theta / DEGREE) / 200.0


@formula(
    source="jenike1964; rhodes2008, ch. 10",
    equation=(
        r"\sigma_c = a + b\,\sigma_0\left(\frac{\sigma_1}{\sigma_0}\right)^n,\quad "
        r"\sigma_0 = 1\,\mathrm{kPa}"
    ),
    typical={
        "consolidation_stress": (1e3, 3e4),
        "strength_intercept": (0.0, 2000.0),
        "strength_slope": (0.05, 1.0),
        "strength_exponent": (0.4, 1.0),
    },
    title="Flow function of a powder",
)
def unconfined_strength(
    consolidation_stress: Stress,
    strength_intercept: Strength,
    strength_slope: Ratio,
    strength_exponent: Power = 1.0,
) -> Strength:
    """Strength of a consolidated powder: a straight line, or a power of the consolidating stress.

    Books print powers of stresses in kPa; with the exponent 1 the unit does not matter.

    A tutorial that was read: the power 0.68 of 1.4 times 2.043 kPa is 2.043 kPa.

    >>> round(unconfined_strength(1.4 * 2043.0, 0.0, 1.0, 0.68) / 1000, 2)
    2.04
    """
    stressed = jnp.maximum(consolidation_stress / KILOPASCAL, TINY)
    return strength_intercept + strength_slope * KILOPASCAL * stressed**strength_exponent


@formula(
    source="jenike1964; rhodes2008, ch. 10",
    equation=(
        r"\sigma_{crit} = a + b\,\sigma_0\left(\frac{\mathrm{ff}\,\sigma_{crit}}{\sigma_0}\right)^n,\quad "
        r"\sigma_0 = 1\,\mathrm{kPa}"
    ),
    typical={
        "strength_intercept": (100.0, 2000.0),
        "strength_slope": (0.05, 0.4),
        "flow_factor": (1.1, 2.0),
        "strength_exponent": (0.4, 1.0),
    },
    title="Strength that an arch must not reach",
)
def critical_strength(
    strength_intercept: Strength,
    strength_slope: Ratio,
    flow_factor: PositiveNumber,
    strength_exponent: Power = 1.0,
) -> Stress:
    """Where the flow function, strength against consolidating stress, meets the line of the flow factor.

    With the exponent 1 a straight line, which meets that line only if it rises more slowly; a power always
    does.

    By hand: 560 + 0.17·1.8·σ = σ.

    >>> round(critical_strength(560.0, 0.17, 1.8), 1)
    806.9
    """
    grows = strength_slope * flow_factor
    exists = arch_exists(strength_slope, flow_factor, strength_exponent)
    straight = jnp.asarray(strength_exponent) == 1.0
    steepest = jnp.where(straight, 1.0, MOST ** (1.0 - strength_exponent)) / flow_factor**strength_exponent
    impossible(~exists, strength_slope, "strength_slope", 0.0, steepest, NO_FLOW)
    line = strength_intercept / jnp.where(straight & exists, 1.0 - grows, 1.0)
    a, n = strength_intercept / KILOPASCAL, jnp.where(straight, 0.5, strength_exponent)
    factor = jnp.where(exists, jnp.maximum(strength_slope, TINY) * flow_factor**n, TINY)
    alone = factor ** (1.0 / (1.0 - n))  # without intercept; with it one of the two is half of the whole
    most = 2.0 * a + (2.0 * factor) ** (1.0 / (1.0 - n))
    met = find_root(lambda s: s - a - factor * s**n, jnp.maximum(0.5 * alone, TINY), most).value
    return jnp.where(exists, jnp.where(straight, line, KILOPASCAL * met), jnp.nan)


def arch_exists(slope: Any, factor: Any, exponent: Any) -> Any:
    """Whether there is a stress from which on an arch breaks: of a line, if it is flat enough; of a power,
    unless that stress is beyond all hoppers.
    """
    straight = jnp.asarray(exponent) == 1.0
    n = jnp.where(straight, 0.5, exponent)
    least = jnp.log(jnp.maximum(slope, TINY) * factor**n) / (1.0 - n)
    return jnp.where(straight, slope * factor < 1.0, least < jnp.log(MOST))


@formula(
    source="jenike1964; arnold1976",
    equation=(
        r"B = \frac{H(\theta)\,\sigma_{crit}}{\rho_b\,g},\quad H = \begin{cases}2 + \theta/65^\circ & "
        r"\mathrm{cone} \\ 1 + \theta/200^\circ & \mathrm{wedge}\end{cases}"
    ),
    typical={
        "critical_strength": (200.0, 3000.0),
        "bulk_density": (400.0, 1600.0),
        "hopper_half_angle": _POWDER["hopper_half_angle"],
    },
)
def outlet_width_jenike(
    critical_strength: Strength,
    bulk_density: Density,
    hopper_half_angle: HalfAngle,
    hopper_shape: Shape = "cone",
) -> Distance:
    """Least outlet of a hopper with mass flow: the diameter of a cone, the width of a slot three times as
    long.

    Rhodes's example, which was read: 830 Pa, 1300 kg/m³ and 27.5° give 0.16 m; H there is 2 + θ/60°.

    >>> round(outlet_width_jenike(830.0, 1300.0, "27.5 degree"), 2)
    0.16
    """
    height = _arch(hopper_half_angle, hopper_shape == "cone")
    return height * critical_strength / (bulk_density * STANDARD_GRAVITY)
