"""Tubes with orifice baffles in which the suspension oscillates: dimensionless groups, power and pressure."""

from __future__ import annotations

from typing import Annotated, NamedTuple

import jax.numpy as jnp
import numpy as np

from granum.core import formula
from granum.core.kinds import (
    Density,
    DynamicViscosity,
    Fraction,
    Frequency,
    Length,
    PositiveNumber,
    PressureDrop,
    Ratio,
    SpecificPower,
    Velocity,
    Within,
)
from granum.numerics.smooth import safe_divide

NODES = 256  # of the mean over a period
ForwardVelocity = Annotated[Velocity, Within(0.0)]
OrificeArea = Annotated[Fraction, Within(0.01, 1.0)]
OrificeCoefficient = Annotated[PositiveNumber, Within(0.3, 1.0)]


class OscillatoryFlow(NamedTuple):
    """Dimensionless groups of a tube with oscillation."""

    reynolds_oscillatory: Ratio
    reynolds: Ratio
    velocity_ratio_oscillatory: Ratio
    strouhal: Ratio


@formula(
    source="ni1997; stonestreet1999",
    title="Groups of oscillatory flow in a baffled tube",
    equation=r"\mathrm{Re}_o = \frac{2\pi f x_0 D\rho_f}{\eta},\quad "
    r"\mathrm{Re} = \frac{U D \rho_f}{\eta},\quad "
    r"\psi = \frac{\mathrm{Re}_o}{\mathrm{Re}},\quad \mathrm{St} = \frac{D}{4\pi x_0}",
    typical={"superficial_velocity": (1e-3, 1e-2), "diameter": (0.01, 0.05)},
)
def oscillatory_flow(
    oscillation_frequency: Frequency,
    oscillation_amplitude: Length,
    diameter: Length,
    superficial_velocity: ForwardVelocity,
    fluid_density: Density,
    dynamic_viscosity: DynamicViscosity,
) -> OscillatoryFlow:
    """Reynolds numbers of oscillation and of the net flow, their ratio and the Strouhal number.

    The amplitude counts from the center to the end of the stroke. Vortices fill the cells between baffles
    from an oscillatory Reynolds number of about 100; the residence times are narrowest where the oscillation
    is two to four times as fast as the net flow. Without net flow the ratio is told as zero.

    >>> found = oscillatory_flow("1 1/s", "30 mm", "15 mm", "0.05 m/s", 1000, "1 mPa s")
    >>> [round(float(x), 3) for x in found]
    [2827.433, 750.0, 3.77, 0.04]
    """
    peak = 2.0 * jnp.pi * oscillation_frequency * oscillation_amplitude
    per_velocity = diameter * fluid_density / dynamic_viscosity
    return OscillatoryFlow(
        peak * per_velocity,
        superficial_velocity * per_velocity,
        safe_divide(peak, superficial_velocity),
        diameter / (4.0 * jnp.pi * oscillation_amplitude),
    )


class OscillatoryLoss(NamedTuple):
    """What the baffles of a tube with oscillation take."""

    specific_power_input: SpecificPower
    pressure_drop: PressureDrop
    pressure_amplitude_friction: PressureDrop
    pressure_amplitude_inertia: PressureDrop


@formula(
    source="jealous1955; baird1995",
    title="Power and pressure of oscillatory flow in a baffled tube",
    equation=r"\varepsilon = \frac{1/S^2 - 1}{2 C_d^2\,l}\,\overline{|u|^3},\quad "
    r"\Delta p = \rho_f\,\frac{L}{l}\,\frac{1/S^2 - 1}{2 C_d^2}\,\overline{u|u|},\quad "
    r"u = U + 2\pi f x_0 \sin 2\pi f t",
    typical={
        "superficial_velocity": (1e-3, 1e-2),
        "length": (5.0, 50.0),
        "discharge_coefficient": (0.6, 0.7),
        "baffle_open_area": (0.2, 0.4),
    },
)
def oscillatory_loss(
    oscillation_frequency: Frequency,
    oscillation_amplitude: Length,
    superficial_velocity: ForwardVelocity,
    fluid_density: Density,
    length: Length,
    baffle_spacing: Length,
    baffle_open_area: OrificeArea = 0.25,
    discharge_coefficient: OrificeCoefficient = 0.6,
) -> OscillatoryLoss:
    """Power per mass and pressures of a tube whose baffles are orifices, passed at every moment as by a
    steady flow.

    The net flow counts as well as the oscillation. The drop is the mean over a period; the amplitudes are
    what the piston has to overcome at its fastest (friction) and at its turn (inertia), a quarter of a
    period apart. Meant for strokes of more than about 5 mm, fewer than two in a second; short quick ones
    take more, as eddies then mix over lengths of their own.

    >>> found = oscillatory_loss("1 1/s", "20 mm", 0.0, 1000, "10 m", "50 mm", 0.25, 0.6)
    >>> round(float(found.specific_power_input), 3)
    0.351
    """
    peak = 2.0 * jnp.pi * oscillation_frequency * oscillation_amplitude
    phase = 2.0 * np.pi * (np.arange(NODES) + 0.5) / NODES
    u = jnp.asarray(superficial_velocity)[..., None] + jnp.asarray(peak)[..., None] * np.sin(phase)
    loss = (1.0 / baffle_open_area**2 - 1.0) / (2.0 * discharge_coefficient**2)
    baffles = length / baffle_spacing
    return OscillatoryLoss(
        loss / baffle_spacing * jnp.mean(jnp.abs(u) ** 3, axis=-1),
        fluid_density * baffles * loss * jnp.mean(u * jnp.abs(u), axis=-1),
        fluid_density * baffles * loss * (superficial_velocity + peak) ** 2,
        fluid_density * length * peak * 2.0 * jnp.pi * oscillation_frequency,
    )
