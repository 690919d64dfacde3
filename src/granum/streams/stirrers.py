"""What a stirrer does in a vessel through which a slurry goes: the speed that just suspends its solid, power
and tip speed.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import jax.numpy as jnp

from granum.core.errors import ApplicabilityError, InputError
from granum.numerics.smooth import safe_divide
from granum.streams.formulas.drives import rotation_speed_zwietering, shaft_power_agitator
from granum.streams.formulas.stirring import IMPELLERS, Impeller
from granum.streams.stream import Stream

WATER = 1e-3  # Pa s
SHARE = 1.0 / 3.0  # of the diameter of the vessel, where none is given


class Agitation(NamedTuple):
    """Speed at which the solid is just suspended (rad/s; zero without solid), speed, shaft power (W), power
    per mass (W/kg) and tip speed (m/s); diameters of stirrer and vessel (m); whether the viscosity of the
    liquid is known.
    """

    suspension: Any
    speed: Any
    power: Any
    specific: Any
    tip: Any
    diameter: Any
    vessel: Any
    known: bool


def slurry_density(slurry: Stream) -> Any:
    """Of solid and liquid, kg/m³."""
    return safe_divide(slurry.solid_flow + slurry.liquid_flow, slurry.slurry_volume_flow, 1000.0)


def agitation(
    slurry: Stream,
    volume: Any,
    impeller: Impeller = "pitched_blades",
    diameter: Any = None,
    speed: Any = None,
) -> Agitation:
    """A stirrer in an upright vessel as high as wide, at a speed or else at the one that just suspends the
    solid. A viscosity that is not known counts as that of water at 20 °C: it enters with the power 0.1.
    """
    viscosity, known = WATER, True
    try:
        viscosity = slurry.liquid_viscosity
    except (ApplicabilityError, InputError):
        known = False
    blades = IMPELLERS[impeller]
    some = (slurry.solid_flow > 0.0) & (slurry.liquid_flow > 0.0) & (volume > 0.0)
    room = jnp.where(volume > 0.0, volume, 1.0)
    width = (4.0 * room / jnp.pi) ** (1.0 / 3.0)
    across = SHARE * width if diameter is None else jnp.asarray(diameter, dtype=float)
    mean = jnp.sum(slurry.size_fractions * slurry.mixture.sizes)
    just = rotation_speed_zwietering(
        across,
        jnp.where(some, mean, 1e-4),
        slurry.solid_density,
        slurry.liquid_density,
        viscosity,
        jnp.where(some, safe_divide(slurry.liquid_flow, slurry.solid_flow), 1.0),
        blades.suspension_constant,
    )
    just = jnp.where(some, just, 0.0)
    turning = just if speed is None else jnp.asarray(speed, dtype=float)
    density = jnp.where(slurry.liquid_flow > 0.0, slurry_density(slurry), 1000.0)
    power = shaft_power_agitator(turning, across, density, blades.power_number)
    return Agitation(
        just, turning, power, power / (density * room), 0.5 * turning * across, across, width, known
    )
