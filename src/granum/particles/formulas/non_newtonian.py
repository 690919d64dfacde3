"""Spheres in liquids that do not follow Newton: drag, the yield stress that holds them, terminal velocity.

The consistency is given as the viscosity of the power law at a reference shear rate, as in pipes and beds.
"""

from __future__ import annotations

from math import log, pi, sqrt
from typing import Annotated, Any

import jax.numpy as jnp

from granum.core import formula, limit_active, unconverged
from granum.core.constants import STANDARD_GRAVITY
from granum.core.kinds import (
    Acceleration,
    Density,
    DynamicViscosity,
    FlowIndex,
    Law,
    Length,
    PositiveNumber,
    Ratio,
    ShearRate,
    Speed,
    Velocity,
    YieldStress,
)
from granum.numerics import safe_power
from granum.numerics.quick_roots import likely_root
from granum.particles.falling import EQUAL_DENSITIES
from granum.particles.formulas.drag_modern import drag_coefficient_brown_lawler

Drag = Annotated[Any, Law("drag_coefficient")]

NEWTON_DRAG = 0.44
SURFACE = 4.0  # of a sphere over its shadow
AROUND = 7.0 * pi / 24.0  # share of the yield stress in the dynamic parameter
HELD = "The yield stress holds the particle: it neither falls nor rises."
_THICK = {
    "particle_diameter": (1e-3, 1e-2),
    "consistency": (0.05, 5.0),
    "flow_index": (0.4, 1.0),
    "yield_stress": (0.1, 5.0),
}


@formula(
    source="chhabra2008, ch. 5",
    equation=(r"\mathrm{Re} = \frac{\rho_f v^{2-n} d_p^n}{K},\quad K = \eta_1\,\dot\gamma_1^{1-n}"),
    title="Reynolds number of a particle in a power-law liquid",
    typical=_THICK,
)
def reynolds_number_power_law(
    particle_diameter: Length,
    velocity: Speed,
    fluid_density: Density,
    consistency: DynamicViscosity,
    flow_index: FlowIndex,
    reference_shear_rate: ShearRate = 1.0,
) -> Ratio:
    """Reynolds number of a particle with the viscosity that a power-law liquid has at the shear rate v/d.

    Source not opened.

    >>> round(reynolds_number_power_law("1 mm", "0.1 m/s", 1000.0, 0.1, 0.5), 9)
    10.0
    """
    d, v, rho, n = particle_diameter, velocity, fluid_density, flow_index
    thick = consistency * safe_power(v / (d * reference_shear_rate), n - 1.0)
    return jnp.where(v > 0.0, rho * v * d / thick, 0.0)


def _creeping(n: Any) -> Any:
    """Drag of a sphere in creeping flow of a power-law liquid over Stokes' at the shear rate v/d."""
    return 6.0 ** ((n - 1.0) / 2.0) * (3.0 / (n**2 + n + 1.0)) ** (n + 1.0)


@formula(
    source="renaud2004; chhabra2008, ch. 5",
    equation=(
        r"C_D = C_0 + 4\cdot 0.44\,k\,C_0^{2\beta}\left(\frac{6Xb}{6Xb + C_0}\right)^\beta + "
        r"0.44\left(\frac{6Xb}{6Xb + 128\,C_0}\right)^{11/12},\quad C_0 = \frac{24 X}{\mathrm{Re}},\quad "
        r"X = 6^{(n-1)/2}\left(\frac{3}{n^2+n+1}\right)^{n+1},\quad \alpha = \frac{3}{n^2+n+1},\quad "
        r"b = e^{3(\alpha - \ln 6)},\quad k = \frac{3-\alpha}{6X}3^{(3-\alpha)/(2\alpha)},\quad "
        r"\beta = \frac{11\sqrt 6}{48}\left\{1 - \exp\left[\left(\frac{3-\alpha}{2\alpha}\right)^2 "
        r"\ln\frac{\sqrt 6 - 1}{\sqrt 6}\right]\right\}"
    ),
    fitted={"reynolds": (0.0, 1000.0), "flow_index": (0.3, 1.0)},
    typical={"reynolds": (1e-2, 1e2), "flow_index": (0.4, 1.0)},
)
def drag_coefficient_renaud(reynolds: PositiveNumber, flow_index: FlowIndex = 1.0) -> PositiveNumber:
    """Drag coefficient of a sphere in a power-law liquid, from creeping to fast flow, by Renaud, Mauret and
    Chhabra.

    In creeping flow 24 X/Re: a liquid that thins resists more than Stokes' law says at the shear rate v/d, by
    46 % at most. With n = 1 it is Newton's liquid, within 10 % of the standard curve. Equation and ranges
    recalled, sources not opened.

    >>> round(drag_coefficient_renaud(1.0, 0.5), 2)
    34.91
    """
    n = flow_index
    alpha = 3.0 / (n**2 + n + 1.0)
    X = _creeping(n)
    b6 = 6.0 * X * jnp.exp(3.0 * (alpha - log(6.0)))
    share = (3.0 - alpha) / (2.0 * alpha)
    k = (3.0 - alpha) / (6.0 * X) * 3.0**share
    beta = 11.0 * sqrt(6.0) / 48.0 * (1.0 - jnp.exp(share**2 * log(1.0 - 1.0 / sqrt(6.0))))
    slow = 24.0 * X / reynolds
    between = SURFACE * NEWTON_DRAG * k * slow ** (2.0 * beta) * (b6 / (b6 + slow)) ** beta
    return slow + between + NEWTON_DRAG * (b6 / (b6 + 128.0 * slow)) ** (11.0 / 12.0)


@formula(
    source="renaud2004; chhabra2008, ch. 5",
    equation=(
        r"v_t = \mathrm{sgn}(\rho_p - \rho_f)\sqrt{\frac{4 g d_p |\rho_p - \rho_f|}{3\,C_D(\mathrm{Re}, n)\,"
        r"\rho_f}},\quad \mathrm{Re} = \frac{\rho_f |v_t|^{2-n} d_p^n}{\eta_1\,\dot\gamma_1^{1-n}}"
    ),
    typical=_THICK,
)
def terminal_velocity_renaud(
    particle_diameter: Length,
    particle_density: Density,
    fluid_density: Density,
    consistency: DynamicViscosity,
    flow_index: FlowIndex,
    reference_shear_rate: ShearRate = 1.0,
    gravity: Acceleration = STANDARD_GRAVITY,
) -> Velocity:
    """Terminal velocity of a sphere in a power-law liquid at rest, by the drag of Renaud, Mauret and Chhabra:
    positive downwards, negative for a sphere that rises.

    The range is that of the drag at the Reynolds number found. A polymer solution that is a power law at the
    shear rates of pipes has a highest viscosity at rest: slow small grains fall in that. Source not opened.

    >>> round(1000 * terminal_velocity_renaud("3 mm", 2650.0, 1000.0, 1.0, 0.6), 2)
    9.14
    """
    d, rho, n = particle_diameter, fluid_density, flow_index
    excess = jnp.asarray(particle_density - rho, dtype=float)
    limit_active(excess == 0.0, particle_density, "particle_density", EQUAL_DENSITIES)
    moves = excess != 0.0
    weight = 4.0 / 3.0 * gravity * d * jnp.where(moves, abs(excess), 1.0)
    # Re for a velocity of one reference shear rate times the diameter, and X = C_D Re^(2/(2-n))
    unit = rho * d**2 * reference_shear_rate / consistency
    power = 2.0 / (2.0 - n)
    wanted = jnp.log(weight / (rho * (reference_shear_rate * d) ** 2)) + power * jnp.log(unit)
    slow = (wanted - jnp.log(24.0 * _creeping(n))) / (power - 1.0)
    start = jnp.minimum(slow, (wanted - log(NEWTON_DRAG)) / power)

    def balance(y: Any) -> Any:
        return power * y + jnp.log(drag_coefficient_renaud.function(jnp.exp(y), n)) - wanted

    y, found = likely_root(balance, start, near=3.0, far=60.0)
    unconverged(found | ~moves)
    drag_coefficient_renaud(jnp.where(moves, jnp.exp(y), 1.0), n)  # for its flags at the number found
    speed = reference_shear_rate * d * jnp.exp((y - jnp.log(unit)) / (2.0 - n))
    return jnp.where(moves, jnp.sign(excess) * speed, 0.0)


@formula(
    source="beris1985",
    equation=r"\tau_y = \frac{0.143}{3}\,g\,d_p\,|\rho_p - \rho_f|",
    title="Yield stress that holds a sphere",
    typical=_THICK,
)
def yield_stress_beris(
    particle_diameter: Length,
    particle_density: Density,
    fluid_density: Density,
    gravity: Acceleration = STANDARD_GRAVITY,
) -> YieldStress:
    """Least yield stress of a Bingham liquid in which a single sphere neither falls nor rises, computed by
    Beris and others.

    What is measured lies on both sides, up to twice as high. The summary of the source, which has the number,
    was opened.

    >>> round(yield_stress_beris("5 mm", 2650.0, 1000.0), 2)
    3.86
    """
    return 0.143 / 3.0 * gravity * particle_diameter * abs(particle_density - fluid_density)


@formula(
    source="ansley1967; hanks2001, eq. 165; atapattu1995",
    equation=(
        r"v_t = \mathrm{sgn}(\rho_p - \rho_f)\sqrt{\frac{4 g d_p |\rho_p - \rho_f|}{3\,C_D(Q)\,\rho_f}},"
        r"\quad Q = \frac{\rho_f v_t^2}{\eta_1\dot\gamma_1\left(\frac{|v_t|}{d_p\dot\gamma_1}\right)^n + "
        r"\frac{7\pi}{24}\tau_y}"
    ),
    fitted={"flow_index": (0.43, 1.0)},
    typical=_THICK,
)
def terminal_velocity_ansley_smith(
    particle_diameter: Length,
    particle_density: Density,
    fluid_density: Density,
    consistency: DynamicViscosity,
    yield_stress: YieldStress,
    flow_index: FlowIndex = 1.0,
    reference_shear_rate: ShearRate = 1.0,
    gravity: Acceleration = STANDARD_GRAVITY,
    drag: Drag = drag_coefficient_brown_lawler,
) -> Velocity:
    """Terminal velocity of a sphere in a Bingham or Herschel–Bulkley liquid at rest, by the dynamic parameter
    of Ansley and Smith: positive downwards, negative for a sphere that rises, zero where it is held.

    The dynamic parameter takes the place of the Reynolds number in Newton's drag. With a flow index of one
    the consistency is the plastic viscosity. A sphere is held, and flagged, from a yield stress of 4/(21π) =
    0.061 g·d·Δρ on; computation has it at 0.048 already (``yield_stress_beris``). The dynamic parameter of a
    Bingham liquid and a drag curve of it were opened in Hanks; how the flow index enters is recalled, as is
    its range.

    >>> round(1000 * terminal_velocity_ansley_smith("5 mm", 7850.0, 1200.0, "50 cP", 5.0), 1)
    376.7
    """
    d, rho, n = particle_diameter, fluid_density, flow_index
    excess = jnp.asarray(particle_density - rho, dtype=float)
    limit_active(excess == 0.0, particle_density, "particle_density", EQUAL_DENSITIES)
    weight = 4.0 / 3.0 * gravity * d * abs(excess)
    held = (weight <= 24.0 * AROUND * yield_stress) & (excess != 0.0)
    limit_active(held, yield_stress, "yield_stress", HELD)
    moves = ~held & (excess != 0.0)
    load = jnp.where(moves, weight, 1.0)
    resisting = jnp.where(moves, AROUND * yield_stress, 0.0)
    thick = consistency * reference_shear_rate
    unit = jnp.log(d * reference_shear_rate)
    slow = unit + jnp.log((load / 24.0 - resisting) / thick) / n
    start = jnp.minimum(slow, 0.5 * jnp.log(load / (NEWTON_DRAG * rho)))

    def parameter(y: Any) -> Any:
        return rho * jnp.exp(2.0 * y) / (thick * jnp.exp(n * (y - unit)) + resisting)

    def balance(y: Any) -> Any:
        return jnp.log(drag(parameter(y))) + jnp.log(rho) + 2.0 * y - jnp.log(load)

    y, found = likely_root(balance, start, near=3.0, far=60.0)
    unconverged(found | ~moves)
    drag(jnp.where(moves, parameter(y), 1.0))  # for its flags at the parameter found
    return jnp.where(moves, jnp.sign(excess) * jnp.exp(y), 0.0)
