"""Outlets of hoppers: how fast a cohesive or a fine solid leaves, and ratholes where it does not."""

from __future__ import annotations

from typing import Any

import jax.numpy as jnp

from granum.conveying.formulas.hoppers import DEGREE, Friction, HalfAngle, Strength
from granum.core import formula, unconverged
from granum.core.constants import STANDARD_GRAVITY
from granum.core.kinds import (
    Density,
    Distance,
    DynamicViscosity,
    Length,
    MassFlow,
    PositiveNumber,
    Ratio,
    Speed,
)
from granum.numerics import find_root

DRAG = 15.0  # of the air that is drawn into a solid as it opens


@formula(
    source="johanson1965",
    equation=(
        r"\dot m = \rho_b\,\frac{\pi D^2}{4}\,\sqrt{\frac{g D}{4\tan\theta}\left(1 - "
        r"\frac{\mathrm{ff}}{f\!f_c}\right)}"
    ),
    typical={
        "bulk_density": (400.0, 1600.0),
        "diameter": (0.05, 0.6),
        "hopper_half_angle": (10.0 * DEGREE, 35.0 * DEGREE),
        "flow_factor": (1.1, 2.0),
        "flowability": (2.0, 20.0),
    },
    title="Discharge of a cone with mass flow (Johanson)",
)
def mass_flow_johanson(
    bulk_density: Density,
    diameter: Length,
    hopper_half_angle: HalfAngle,
    flow_factor: Ratio,
    flowability: PositiveNumber,
) -> MassFlow:
    """Rate at which a coarse solid, cohesive or not, leaves a conical hopper with mass flow.

    An arch at the outlet falls with what weight has over its strength, and as the channel narrows the solid
    must quicken: by 4 v² tan θ/D. None where the flowability at the outlet is below the flow factor: the arch
    stands. Recalled, and derived again so.

    By hand without strength: v² = 9.80665·0.2/(4·tan 20°), v = 1.161 m/s, times 0.03142 m² and 1000 kg/m³.

    >>> round(mass_flow_johanson(1000.0, "20 cm", "20 degree", 0.0, 10.0), 1)
    36.5
    """
    falls = jnp.maximum(1.0 - flow_factor / flowability, 0.0)
    squared = STANDARD_GRAVITY * diameter / (4.0 * jnp.tan(hopper_half_angle)) * falls
    moving = squared > 0.0
    speed = jnp.where(moving, jnp.sqrt(jnp.where(moving, squared, 1.0)), 0.0)
    return bulk_density * 0.25 * jnp.pi * diameter**2 * speed


@formula(
    source="carleton1972",
    equation=(
        r"\frac{4 v^2\sin\theta}{D} + \frac{15\,\rho_g^{1/3}\,\eta^{2/3}\,v^{4/3}}{\rho_p\,d_p^{5/3}} = g"
    ),
    typical={
        "diameter": (0.05, 0.6),
        "hopper_half_angle": (10.0 * DEGREE, 35.0 * DEGREE),
        "particle_diameter": (3e-5, 5e-4),
        "particle_density": (1000.0, 3000.0),
        "gas_density": (0.8, 1.5),
        "dynamic_viscosity": (1.6e-5, 2.3e-5),
    },
    title="Speed in the outlet of a cone (Carleton)",
)
def outlet_velocity_carleton(
    diameter: Length,
    hopper_half_angle: HalfAngle,
    particle_diameter: Length,
    particle_density: Density,
    gas_density: Density,
    dynamic_viscosity: DynamicViscosity,
) -> Speed:
    """Speed at which a fine solid without cohesion leaves a conical hopper, held back by the air that it must
    draw in as it opens.

    For grains below half a millimeter; coarse ones leave at Johanson's speed, here with a sine. Recalled.

    By hand: grains of 0.1 mm that air alone holds back, v = (9.80665·2500·(1e-4)^(5/3)/(15·1.2^(1/3)·
    (1.8e-5)^(2/3)))^(3/4) = 0.579 m/s, the narrowing of a wide outlet a little less.

    >>> round(outlet_velocity_carleton("10 m", "20 degree", "0.1 mm", 2500.0, 1.2, 1.8e-5), 3)
    0.577
    """
    inertia = 4.0 * jnp.sin(hopper_half_angle) / diameter
    drag = (
        DRAG
        * gas_density ** (1.0 / 3.0)
        * dynamic_viscosity ** (2.0 / 3.0)
        / (particle_density * particle_diameter ** (5.0 / 3.0))
    )

    def over(logarithm: Any, inertia: Any, drag: Any) -> Any:
        return jnp.log(
            (inertia * jnp.exp(2.0 * logarithm) + drag * jnp.exp(4.0 / 3.0 * logarithm)) / STANDARD_GRAVITY
        )

    # either term alone bounds the speed above; at half of the bound neither takes more than half of g
    most = jnp.minimum(0.5 * jnp.log(STANDARD_GRAVITY / inertia), 0.75 * jnp.log(STANDARD_GRAVITY / drag))
    root = find_root(over, most - 1.0, most + 1e-6, inertia, drag)
    unconverged(root.converged)
    return jnp.exp(root.value)


@formula(
    source="jenike1964",
    equation=r"D_f = \frac{4.3\tan\varphi\;\sigma_c}{\rho_b\,g}",
    typical={
        "unconfined_strength": (200.0, 5000.0),
        "bulk_density": (400.0, 1600.0),
        "internal_friction_angle": (30.0 * DEGREE, 60.0 * DEGREE),
    },
    fitted={"internal_friction_angle": (30.0 * DEGREE, 60.0 * DEGREE)},
    title="Rathole of a hopper with funnel flow (Jenike)",
)
def rathole_diameter_jenike(
    unconfined_strength: Strength, bulk_density: Density, internal_friction_angle: Friction
) -> Distance:
    """Width up to which a pipe through a solid that stands at the walls stays open, and empties no further.

    The strength is that under the stress of filling (``silo_stresses_janssen``). The line 4.3 tan φ through
    Jenike's chart is recalled, as is the polynomial of other handbooks, −5.066 + 0.490 φ − 0.0112 φ² +
    0.000108 φ³ in degrees, from which it is at most 5 % off between 30° and 60°.

    By hand: 4.3·tan 40°·2000/(1000·9.80665).

    >>> round(rathole_diameter_jenike(2000.0, 1000.0, "40 degree"), 3)
    0.736
    """
    hoop = 4.3 * jnp.tan(internal_friction_angle)
    return hoop * unconfined_strength / (bulk_density * STANDARD_GRAVITY)
