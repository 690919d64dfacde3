"""Grains on a vibrating floor: how far they fly, how fast they advance, what that costs."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import jax.numpy as jnp

from granum.core import formula, watch
from granum.core.constants import STANDARD_GRAVITY
from granum.core.kinds import Acceleration, Angle, Fraction, Frequency, Length, Number, SpecificPower, Speed
from granum.numerics import find_root

WHOLE = 2.0 * math.pi  # a flight of one period
HIGHEST = math.sqrt(1.0 + math.pi**2)  # throw number at which a flight lasts one period
SHORT = 0.05  # rad, of flights whose cosine is written out


class Throw(NamedTuple):
    """Flight of grains on a vibrating floor, and the power that their landings take."""

    throw_number: Number
    flight_share: Fraction
    throw_velocity: Speed
    vibration_power: SpecificPower


@formula(
    source="coppers2003, sec. 3.1.2, second-hand",
    equation=(
        r"\Gamma = \frac{4\pi^2 f^2 a\sin\beta}{g},\quad v = \frac{g\,n^2}{2 f}\cot\beta,\quad "
        r"\sqrt{\Gamma^2 - 1} = \frac{\cos 2\pi n + 2\pi^2 n^2 - 1}{2\pi n - \sin 2\pi n}"
    ),
    fitted={"throw_number": (0.0, 3.3)},
    typical={
        "amplitude": (1e-3, 6e-3),
        "vibration_frequency": (8.0, 25.0),
        "throw_angle": (0.5, 1.4),
    },
    title="Throw of grains on a vibrating floor",
)
def vibration_throw(
    amplitude: Length,
    vibration_frequency: Frequency,
    throw_angle: Angle,
    gravity: Acceleration = STANDARD_GRAVITY,
) -> Throw:
    """Share of its period that a grain flies, its mean velocity along the floor, and the power that its
    landings take per mass: it leaves the floor where that falls away faster than gravity, and lands without
    a bounce.

    The amplitude is half the stroke, the angle that of the stroke above the floor. Up to a throw number of 1
    nothing flies; from 3.3 on a flight would last longer than a period, and is taken for one. Derived
    here but for the throw number. Still air; beds of powder that hold their air advance more slowly.

    >>> found = vibration_throw("5 mm", 10.0, "45 degree")
    >>> round(float(found.throw_number), 2), round(float(found.throw_velocity), 3)
    (1.42, 0.138)
    """
    omega = WHOLE * vibration_frequency
    fast = amplitude * omega
    throw = fast * omega * jnp.sin(throw_angle) / gravity
    watch(throw_number=throw)
    flies = throw > 1.0
    over = jnp.where(flies, jnp.minimum(throw, HIGHEST), 1.5)
    steep = jnp.sqrt(over**2 - 1.0)

    def lands(flight: Any, steep: Any) -> Any:
        short = jnp.abs(flight) < SHORT
        safe = jnp.where(short, 1.0, flight)
        wide = (jnp.cos(safe) + 0.5 * safe**2 - 1.0) / (safe - jnp.sin(safe))
        return jnp.where(short, 0.25 * flight * (1.0 + flight**2 / 60.0), wide) - steep

    flight = find_root(lands, 0.0, WHOLE * (1.0 + 1e-9), steep).value
    share = jnp.minimum(flight / WHOLE, 1.0)
    first = jnp.arcsin(1.0 / over)
    slower = jnp.cos(first) - jnp.cos(first + flight)
    down = fast * jnp.sin(throw_angle) * slower - gravity * flight / omega
    along = fast * jnp.cos(throw_angle) * slower
    return Throw(
        throw,
        jnp.where(flies, share, 0.0),
        jnp.where(flies, 0.5 * gravity * share**2 / vibration_frequency / jnp.tan(throw_angle), 0.0),
        jnp.where(flies, 0.5 * vibration_frequency * (down**2 + along**2), 0.0),
    )


@formula(
    source="gupta1980, recalled",
    equation=r"\frac{U_{mm}}{U_{mf}} = 1.952 - 0.275\,\Gamma - 0.686\,\Gamma^2",
    fitted={"throw_number": (0.0, 1.5)},
    typical={"minimum_fluidization_velocity": (0.05, 1.0), "throw_number": (0.0, 1.4)},
)
def minimum_mixing_velocity_gupta_mujumdar(
    minimum_fluidization_velocity: Speed, throw_number: Number
) -> Speed:
    """Least gas velocity at which a vibrated bed mixes, by Gupta and Mujumdar: less than the still bed needs
    to fluidize from about the acceleration of gravity on, and none from one and a half of it.

    >>> round(minimum_mixing_velocity_gupta_mujumdar(0.4, 1.0), 3)
    0.396
    """
    share = 1.952 - 0.275 * throw_number - 0.686 * throw_number**2
    return minimum_fluidization_velocity * jnp.maximum(share, 0.0)
