"""Pressure drop of gas cyclones: the family ``inlet_heads``, in inlet velocity heads; loading; saltation."""

from __future__ import annotations

from typing import Any

import jax.numpy as jnp

from granum.core import formula, impossible
from granum.core.constants import STANDARD_GRAVITY
from granum.core.kinds import (
    Concentration,
    Density,
    DynamicViscosity,
    Length,
    MassRatio,
    PositiveNumber,
    PressureDrop,
    Ratio,
    Speed,
    VolumeFlow,
)
from granum.cyclones.formulas.efficiency import TYPICAL, core_flow, heavier, muschelknautz_flow, wall_area
from granum.cyclones.geometry import WIDE_INLET, Dimensions, takes_lengths


def inlet_over_outlet(cyclone: Dimensions) -> Any:
    """Area of the inlet over the square of the outlet's diameter."""
    return cyclone.inlet_height * cyclone.inlet_width / cyclone.outlet_diameter**2


@formula(
    source="shepherd1939; cooper2011",
    equation=r"N_H(D, a, b, D_e, S, h, H, B) = 16\,\frac{ab}{D_e^2}",
    family="inlet_heads",
    typical=TYPICAL,
)
@takes_lengths
def inlet_heads_shepherd_lapple(cyclone: Dimensions) -> PositiveNumber:
    """Pressure drop of a cyclone in inlet velocity heads by Shepherd and Lapple.

    Lapple's own design has 8:

    >>> inlet_heads_shepherd_lapple(1.0, 0.5, 0.25, 0.5, 0.625, 2.0, 4.0, 0.25)
    8.0
    """
    return 16.0 * inlet_over_outlet(cyclone)


@formula(
    source="casal1983",
    equation=r"N_H(D, a, b, D_e, S, h, H, B) = 11.3\left(\frac{ab}{D_e^2}\right)^2 + 3.33",
    family="inlet_heads",
    typical=TYPICAL,
)
@takes_lengths
def inlet_heads_casal_martinez(cyclone: Dimensions) -> PositiveNumber:
    """Pressure drop of a cyclone in inlet velocity heads by Casal and Martínez-Benet.

    >>> round(inlet_heads_casal_martinez(1.0, 0.5, 0.2, 0.5, 0.5, 1.5, 4.0, 0.375), 3)
    5.138
    """
    return 11.3 * inlet_over_outlet(cyclone) ** 2 + 3.33


@formula(
    source="ramachandran1991",
    equation=r"N_H = 20\,\frac{ab}{D_e^2}\left[\frac{S/D}{(H/D)(h/D)(B/D)}\right]^{1/3}",
    family="inlet_heads",
    typical=TYPICAL,
)
@takes_lengths
def inlet_heads_ramachandran(cyclone: Dimensions) -> PositiveNumber:
    """Pressure drop of a cyclone in inlet velocity heads by Ramachandran and others, from 98 designs.

    >>> round(inlet_heads_ramachandran(1.0, 0.5, 0.2, 0.5, 0.5, 1.5, 4.0, 0.375), 3)
    4.846
    """
    D, *_inlet, S, h, H, B = cyclone
    return 20.0 * inlet_over_outlet(cyclone) * (S * D**2 / (H * h * B)) ** (1.0 / 3.0)


@formula(
    source="stairmand1949; hoffmann2008",
    equation=(
        r"N_H(D, a, b, D_e, S, h, H, B) = 1 + 2q^2\left[\frac{2(D-b)}{D_e} - 1\right] + "
        r"2\left(\frac{4ab}{\pi D_e^2}\right)^2"
    ),
    family="inlet_heads",
    typical=TYPICAL,
)
@takes_lengths
def inlet_heads_stairmand(
    cyclone: Dimensions,
    wall_friction: PositiveNumber = 0.005,
) -> PositiveNumber:
    """Pressure drop of a cyclone in inlet velocity heads by Stairmand, from wall friction and the losses at
    both ends.

    Stairmand's high-efficiency design loses between 5 and 6:

    >>> 5.0 < inlet_heads_stairmand(1.0, 0.5, 0.2, 0.5, 0.5, 1.5, 4.0, 0.375) < 6.0
    True
    """
    D, a, b, De = cyclone[:4]
    drag, ratio = wall_friction * wall_area(cyclone) / (a * b), De / (2.0 * (D - b))
    q = (jnp.sqrt(ratio + 4.0 * drag) - jnp.sqrt(ratio)) / (2.0 * drag)
    return 1.0 + 2.0 * q**2 * (1.0 / ratio - 1.0) + 2.0 * (4.0 * a * b / (jnp.pi * De**2)) ** 2


@formula(
    source="barth1956; hoffmann2008",
    equation=(
        r"\Delta p = \frac{\rho_f v_x^2}{2}\left\{\frac{D_e}{D}\left[\frac{1}{(v_x/v_\theta - "
        r"2\lambda(H-S)/D_e)^2} - \frac{v_\theta^2}{v_x^2}\right] + "
        r"K\left(\frac{v_\theta}{v_x}\right)^{4/3} + \left(\frac{v_\theta}{v_x}\right)^2\right\},\quad "
        r"v_x = \frac{4Q}{\pi D_e^2},\ v_\theta = v_\theta(v_x, a, b, h, B)"
    ),
    output="pressure_drop",
    typical=TYPICAL,
)
@takes_lengths
def pressure_drop_barth(
    volume_flow: VolumeFlow,
    fluid_density: Density,
    cyclone: Dimensions,
    wall_friction: Ratio = 0.005,
    finder_loss: PositiveNumber = 4.4,
) -> PressureDrop:
    """Pressure drop of a gas cyclone by Barth: body and vortex finder.

    The loss factor of the finder is 4.4 for a sharp edge and 3.41 for a rounded one.

    >>> 300 < pressure_drop_barth(1.5, 1.2, 1.0, 0.5, 0.2, 0.5, 0.5, 1.5, 4.0, 0.375) < 2000
    True
    """
    swirl, H_c, v_x = core_flow(volume_flow, cyclone, wall_friction)
    u = swirl / v_x
    De = cyclone.outlet_diameter
    free = 1.0 / u - wall_friction * H_c / (De / 2.0)
    body = De / cyclone.diameter * (1.0 / free**2 - u**2)
    return 0.5 * fluid_density * v_x**2 * (body + finder_loss * u ** (4.0 / 3.0) + u**2)


@formula(
    source="muschelknautz1972; hoffmann2008, ch. 6",
    equation=(
        r"\Delta p = \frac{f A_R\rho_f(v_w v_\theta)^{1.5}}{2\cdot 0.9 Q} + \frac{\rho_f "
        r"v_x^2}{2}\left[2 + \left(\frac{v_\theta}{v_x}\right)^2 + "
        r"3\left(\frac{v_\theta}{v_x}\right)^{4/3}\right],\quad v_x = \frac{4Q}{\pi D_e^2},\ (v_w, "
        r"v_\theta, f, A_R) = F(Q, \rho_p, \rho_f; D, a, b, D_e, S, h, H, B)"
    ),
    output="pressure_drop",
    typical=TYPICAL,
)
@takes_lengths
def pressure_drop_muschelknautz(
    volume_flow: VolumeFlow,
    particle_density: Density,
    fluid_density: Density,
    cyclone: Dimensions,
    dust_loading: MassRatio = 0.0,
    gas_friction: Ratio = 0.005,
) -> PressureDrop:
    """Pressure drop of a gas cyclone by Muschelknautz: wall friction and core; little dust lowers it, for it
    brakes the swirl.

    >>> 300 < pressure_drop_muschelknautz(1.5, 2000.0, 1.2, 1.0, 0.5, 0.2, 0.5, 0.5, 1.5, 4.0, 0.375) < 2000
    True
    """
    wall, core, v_x, friction, area = muschelknautz_flow(
        volume_flow, fluid_density, particle_density, dust_loading, cyclone, gas_friction
    )
    u = core / v_x
    body = friction * area * fluid_density * (wall * core) ** 1.5 / (2.0 * 0.9 * volume_flow)
    return body + 0.5 * fluid_density * v_x**2 * (2.0 + u**2 + 3.0 * u ** (4.0 / 3.0))


@formula(
    source="briggs1946",
    equation=r"\frac{\Delta p}{\Delta p_0} = \frac{1}{1 + 0.0086\sqrt{c}},\ c\text{ in }\mathrm{g/m^3}",
    typical={"concentration": (0.001, 1.0)},
)
def loading_factor_briggs(concentration: Concentration) -> PositiveNumber:
    """Ratio of the pressure drop of a cyclone with dust to that with clean gas by Briggs.

    >>> round(loading_factor_briggs(concentration="100 g/m^3"), 4)
    0.9208
    """
    return 1.0 / (1.0 + 0.0086 * jnp.sqrt(1e3 * concentration + 1e-300))


@formula(
    source="kalen1974; cooper2011",
    equation=(
        r"v_s = 4.913\,W\,\frac{(b/D)^{0.4} D^{0.067} v^{2/3}}{(1 - b/D)^{1/3}},\ W = \left[\frac{4 "
        r"g\eta(\rho_p-\rho_f)}{3\rho_f^2}\right]^{1/3}"
    ),
    typical={**TYPICAL, "velocity": (12.0, 25.0)},
)
def saltation_velocity_kalen_zenz(
    velocity: Speed,
    diameter: Length,
    inlet_width: Length,
    particle_density: Density,
    fluid_density: Density,
    dynamic_viscosity: DynamicViscosity,
) -> Speed:
    """Inlet velocity at which a cyclone begins to pick its dust up again by Kalen and Zenz.

    Collection is best near 1.25 times this velocity; above 1.36 times dust is lost again.

    >>> 8 < saltation_velocity_kalen_zenz(15.0, 1.0, 0.2, 2000.0, 1.2, 1.8e-5) < 20
    True
    """
    W = (
        4.0
        * STANDARD_GRAVITY
        * dynamic_viscosity
        * heavier(particle_density, fluid_density)
        / (3.0 * fluid_density**2)
    ) ** (1.0 / 3.0)
    impossible(inlet_width >= diameter, inlet_width, "inlet_width", 0.0, diameter, WIDE_INLET)
    K = inlet_width / diameter
    return 4.913 * W * K**0.4 * diameter**0.067 * velocity ** (2.0 / 3.0) / (1.0 - K) ** (1.0 / 3.0)
