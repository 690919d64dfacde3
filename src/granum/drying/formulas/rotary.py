"""Rotary drums: time of passage and volumetric heat transfer."""

from __future__ import annotations

from math import pi

import jax.numpy as jnp

from granum.core import formula
from granum.core.constants import RPM
from granum.core.kinds import (
    Fraction,
    Length,
    Mass,
    MassFlux,
    Number,
    PositiveNumber,
    Power,
    RotationSpeed,
    Speed,
    Time,
)
from granum.drying.kinds import GasDrift, VolumetricHeatTransfer

MINUTE, MICRON = 60.0, 1e-6
FOOT, POUND, HORSEPOWER = 0.3048, 0.45359237, 745.7  # m, kg, W
SHORTEST = 0.1  # of the time without gas, where the gas would sweep the solid out in no time


@formula(
    source="friedman1949; perry2008, ch. 12",
    fitted={"drum_slope": (0.0, 0.08)},
    equation=(
        r"\tau = \frac{0.23\,L}{S\,N^{0.9}D} \pm \frac{1.97\,B\,L\,G}{F},\quad B = 5\,d_p^{-1/2},\ N = "
        r"\frac{\omega}{2\pi}"
    ),
    typical={
        "length": (3.0, 30.0),
        "diameter": (0.5, 3.0),
        "drum_slope": (0.01, 0.08),
        "rotation_speed": (0.1, 0.6),
        "particle_diameter": (3e-4, 5e-3),
        "gas_mass_flux": (0.0, 1.0),
        "solid_mass_flux": (0.5, 5.0),
        "against_gas": (0.1, 1.0),
    },
    output="residence_time",
    title="Time of passage in a rotary drum (Friedman–Marshall)",
)
def residence_time_friedman_marshall(
    length: Length,
    diameter: Length,
    drum_slope: Fraction,
    rotation_speed: RotationSpeed,
    particle_diameter: Length = 1e-3,
    gas_mass_flux: MassFlux = 0.0,
    solid_mass_flux: MassFlux = 1.0,
    against_gas: Number = 1.0,
) -> Time:
    """Mean time of passage of solids through a flighted drum; gas against the solid (``against_gas`` = 1)
    holds it back, with it (−1) sweeps it on.

    Printed in minutes, meters, revolutions per minute, micrometers and kg/(h m²); slope in meters a meter.

    By hand: L/D 6, slope 0.05, 4 rpm: 0.23 · 6/(0.05 · 4^0.9) = 7.93 min.

    Drums slope by up to 8 cm a meter (Perry).

    >>> round(residence_time_friedman_marshall("12 m", "2 m", 0.05, "4 rpm") / 60, 2)
    7.93
    """
    N = rotation_speed / RPM
    still = 0.23 * length / (drum_slope * N**0.9 * diameter)
    drift = 1.97 * 5.0 / jnp.sqrt(particle_diameter / MICRON) * length * gas_mass_flux / solid_mass_flux
    return MINUTE * jnp.maximum(still + against_gas * drift, SHORTEST * still)


@formula(
    source="saeman1954; perry2008, ch. 12",
    fitted={"drum_slope": (0.0, 0.08), "cascade_factor": (2.0, pi)},
    equation=r"\tau = \frac{L}{f\,N\,D\,(S \mp m\,u)},\quad N = \frac{\omega}{2\pi}",
    typical={
        "length": (3.0, 30.0),
        "diameter": (0.5, 3.0),
        "drum_slope": (0.02, 0.08),
        "rotation_speed": (0.1, 0.6),
        "gas_velocity": (0.0, 2.0),
    },
    output="residence_time",
    title="Time of passage in a rotary drum (Saeman–Mitchell)",
)
def residence_time_saeman_mitchell(
    length: Length,
    diameter: Length,
    drum_slope: Fraction,
    rotation_speed: RotationSpeed,
    gas_velocity: Speed = 0.0,
    against_gas: Number = 1.0,
    cascade_factor: PositiveNumber = 2.0,
    gas_drift: GasDrift = 0.0,
) -> Time:
    """Time of passage from the advance of each cascade; the cascade factor grows from 2 for a lightly loaded
    drum to π for a full one.

    ``gas_drift`` (s/m) is the apparent slope per gas velocity of the material, measured.

    By hand: 12 m, 2 m, slope 0.05, 4 rpm = 0.0667 per second, f = 2: 12/(2 · 0.0667 · 2 · 0.05) = 900 s.

    Drums slope by up to 8 cm a meter (Perry).

    >>> round(residence_time_saeman_mitchell("12 m", "2 m", 0.05, "4 rpm"), 6)
    900.0
    """
    slope = jnp.maximum(drum_slope - against_gas * gas_drift * gas_velocity, SHORTEST * drum_slope)
    return length / (cascade_factor * rotation_speed / (2.0 * pi) * diameter * slope)


@formula(
    source="friedman1949part2; treybal1980, ch. 12",
    equation=r"U a = K\,\frac{G^{n}}{D}",
    fitted={"gas_mass_flux": (0.3, 7.0), "transfer_exponent": (0.46, 0.67)},
    typical={
        "gas_mass_flux": (0.5, 5.0),
        "diameter": (0.5, 3.0),
        "transfer_constant": (150.0, 350.0),
        "transfer_exponent": (0.46, 0.67),
    },
    title="Volumetric heat transfer in a rotary drum",
)
def volumetric_heat_transfer_rotary(
    gas_mass_flux: MassFlux,
    diameter: Length,
    transfer_constant: PositiveNumber = 237.0,
    transfer_exponent: PositiveNumber = 0.67,
) -> VolumetricHeatTransfer:
    """Heat from gas to cascading solid per volume of drum and kelvin, W/(m³ K); the constant is that of
    Treybal, Coulson and Richardson print 250.

    McCormick found exponents between 0.46 and 0.67 and constants that grow with the number of flights.

    By hand: 237 · 2^0.67/1.5 = 251.

    >>> round(volumetric_heat_transfer_rotary(2.0, 1.5))
    251
    """
    return transfer_constant * gas_mass_flux**transfer_exponent / diameter


@formula(
    source="perry2008, ch. 12",
    equation=(
        r"P = 10^{-5}\,\frac{\omega}{2\pi}\,"
        r"(4.75\,D\,m_h + 0.1925\,D_r\,W + 0.33\,W)\ \mathrm{hp},\ D_r = D + 2\ \mathrm{ft}"
    ),
    typical={"diameter": (0.5, 3.0), "solid_holdup": (50.0, 2e4), "mass_rotating": (1e3, 1e5)},
    title="Shaft power that turns a rotary drum",
)
def shaft_power_rotary_drum(
    rotation_speed: RotationSpeed, diameter: Length, solid_holdup: Mass, mass_rotating: Mass
) -> Power:
    """Power to turn a drum with lifting flights: the load it lifts, and the friction of its rings and
    rollers.

    The empirical relation has feet, pounds and revolutions per minute; the riding rings are taken two feet
    wider than the shell. Quoted from memory of the print, which was not opened.

    By hand: 5 ft, 4 rev/min, 2 000 lb of solid, 20 000 lb in all: 4·(47 500 + 26 950 + 6 600)/10⁵ hp.

    >>> round(shaft_power_rotary_drum("4 rpm", "5 ft", "2000 lb", "20000 lb") / 745.7, 2)
    3.24
    """
    d, w, W = diameter / FOOT, solid_holdup / POUND, mass_rotating / POUND
    turns = rotation_speed * 30.0 / jnp.pi
    return HORSEPOWER * turns * (4.75 * d * w + 0.1925 * (d + 2.0) * W + 0.33 * W) / 1e5
