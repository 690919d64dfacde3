"""Grade efficiency of gas cyclones by Mothes and Löffler: dust in a downward and an upward vortex that
exchange by drift and turbulence.
"""

from __future__ import annotations

from typing import Any

import jax.numpy as jnp

from granum.core import formula, watch
from granum.core.kinds import Density, Diffusivity, DynamicViscosity, Fraction, Length, Ratio, VolumeFlow
from granum.cyclones.formulas.efficiency import TYPICAL, heavier
from granum.cyclones.geometry import Dimensions, takes_lengths

LEAST = 1e-12


def swirl(Q: Any, cyclone: Dimensions, friction: Any) -> Any:
    """Meissner and Löffler's tangential velocity as a function of the radius; friction on cylinder, roof and
    cone.
    """
    D, a, b, _De, _S, h, H, B = cyclone
    R = D / 2.0
    v_z = Q / (jnp.pi * R**2)
    entry = Q / (a * b * (0.889 - 0.204 * b / R))  # of the contracted jet
    angle = jnp.arccos(jnp.clip(1.0 - b / R, -1.0, 1.0))
    # wall of the cylinder less the inlet
    depth = friction / v_z * jnp.maximum(h / R - a / R * angle / (2.0 * jnp.pi), LEAST)
    wall = 2.0 * entry / (1.0 + jnp.sqrt(1.0 + 4.0 * depth * entry))
    # sine of half the angle of the cone
    slope = jnp.maximum((R - B / 2.0) / jnp.hypot(H - h, R - B / 2.0), LEAST)
    damping = wall / v_z * (friction + friction / slope)

    def at(r: Any) -> Any:
        return wall / (r / R * (1.0 + damping * (1.0 - r / R)))

    return at


@formula(
    source="mothes1988; meissner1978",
    family="cyclone_efficiency",
    equation=(
        r"\eta = 1 - \frac{m - a}{b}\,e^{-A(S - a_e/2)},\quad m = \frac{a+d}{2} + "
        r"\sqrt{\left(\frac{a-d}{2}\right)^2 + bc},\quad (A, a, b, c, d) = F(d_p, Q, \rho_p, \rho_f, "
        r"\eta; D, a_e, b_e, D_e, S, h, H, B)"
    ),
    fitted={"velocity": (5.0, 20.0)},
    typical={**TYPICAL, "diffusivity": (0.01, 0.015), "wall_friction": (0.006, 0.009)},
    symbols={"inlet_height": "a_e", "inlet_width": "b_e"},
)
@takes_lengths
def cyclone_efficiency_mothes_loffler(
    particle_diameter: Length,
    volume_flow: VolumeFlow,
    particle_density: Density,
    fluid_density: Density,
    dynamic_viscosity: DynamicViscosity,
    cyclone: Dimensions,
    diffusivity: Diffusivity = 0.0125,
    wall_friction: Ratio = 0.0075,
) -> Fraction:
    """Grade efficiency of a gas cyclone by Mothes and Löffler, with turbulent exchange between outer and
    inner vortex.

    Dust settles to the wall of a cylinder of equal volume, in the entrance and along the outer vortex; gas
    and fine dust drift through the core surface, coarse dust drifts back, turbulence mixes (0.0125 m²/s,
    measured at 5 to 20 m/s). With A, B, C for settling, exchange and drift per height l = H - S: a = -1 + l(A
    + B), b = -l(B + C), c = lB, d = b - 1 where dust drifts outwards, and a = -1 + l(A + B - C), b = -lB, c =
    l(B - C), d = b - 1 where it drifts inwards. Dust picked up again at the bottom is left out.

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
    >>> 0.9 < cyclone_efficiency_mothes_loffler(
    ...     particle_diameter="10 um",
    ...     volume_flow=1.5,
    ...     particle_density=2000,
    ...     fluid_density=1.2,
    ...     dynamic_viscosity=1.8e-5,
    ...     **d,
    ... ) < 1.0
    True
    """
    D, inlet_height, _width, De, S, h, H, B = cyclone
    Q, R, r_i, length = volume_flow, D / 2.0, De / 2.0, H - S
    velocity = swirl(Q, cyclone, wall_friction)
    volume = jnp.pi * (R**2 * h + (H - h) / 3.0 * (R**2 + (B / 2.0) ** 2 + R * B / 2.0))
    r_a = jnp.sqrt(volume / (jnp.pi * H))
    fall = heavier(particle_density, fluid_density) * particle_diameter**2 / (18.0 * dynamic_viscosity)
    w_a, w_i = fall * velocity(r_a) ** 2 / r_a, fall * velocity(r_i) ** 2 / r_i
    inward = Q / (2.0 * jnp.pi * r_i * length)
    settling = 2.0 * jnp.pi * r_a * w_a / Q
    exchange = 2.0 * jnp.pi * r_i * diffusivity / (Q * jnp.maximum(r_a - r_i, LEAST))
    drift = 2.0 * jnp.pi * r_i * (w_i - inward) / Q
    out, back = jnp.maximum(drift, 0.0), jnp.minimum(drift, 0.0)  # one of them is nothing
    a = -1.0 + length * (settling + exchange - back)
    b = -length * (exchange + out)
    c = length * (exchange - back)
    d = b - 1.0
    half = jnp.sqrt(((a - d) / 2.0) ** 2 + b * c)
    # m - a, written so that nothing cancels for coarse dust: (m - a)(m - d) = bc
    core = c / (half + (a - d) / 2.0)  # concentration of the core over that of the outer vortex at its top
    watch(velocity=Q / (inlet_height * _width))
    return 1.0 - core * jnp.exp(-settling * jnp.maximum(S - inlet_height / 2.0, 0.0))
