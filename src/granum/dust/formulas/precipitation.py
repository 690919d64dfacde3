"""Electrostatic precipitation: charge of particles, migration velocity, collection."""

from __future__ import annotations

from math import pi
from typing import Annotated

import jax.numpy as jnp

from granum.core import formula
from granum.core.constants import BOLTZMANN, ELEMENTARY_CHARGE, VACUUM_PERMITTIVITY
from granum.core.kinds import (
    Area,
    DynamicViscosity,
    Fraction,
    Length,
    PositiveNumber,
    Speed,
    Temperature,
    VolumeFlow,
    Within,
)
from granum.drying.kinds import ElectricField
from granum.dust.kinds import ElementaryCharges, IonDose, IonMobility

_TYPICAL = {
    "particle_diameter": (2e-7, 2e-5),
    "charging_field": (1e5, 6e5),
    "collecting_field": (1e5, 5e5),
    "relative_permittivity": (2.0, 10.0),
    "ion_dose": (1e12, 1e14),
}
Permittivity = Annotated[PositiveNumber, Within(1.0, 1e6)]


@formula(
    source="pauthenier1932; hinds1999, eq. 15.25",
    equation=(
        r"n = \frac{3\varepsilon_r}{\varepsilon_r + 2}\,\frac{\pi\varepsilon_0 E_c d_p^2}{e}\,\frac{b\,N t}"
        r"{1 + b\,N t},\quad b = \frac{e Z}{4\varepsilon_0}"
    ),
    typical=_TYPICAL,
    output="elementary_charges",
    title="Charge of a particle by field charging",
)
def elementary_charges_field(
    particle_diameter: Length,
    charging_field: ElectricField,
    relative_permittivity: Permittivity = 5.0,
    ion_dose: IonDose = 1e13,
    ion_mobility: IonMobility = 1.5e-4,
) -> ElementaryCharges:
    """Elementary charges that ions driven along the field give a particle; the ion dose is concentration
    times time.

    The mobility is that of air ions. Pauthenier's limit for a conductor is 12 π ε0 R² E/e: by hand 260
    for 1 µm at 5 kV/cm.

    >>> round(elementary_charges_field("1 um", "5 kV/cm", 1e6, 1e18))
    260
    """
    dose = ELEMENTARY_CHARGE * ion_mobility * ion_dose / (4.0 * VACUUM_PERMITTIVITY)
    shape = 3.0 * relative_permittivity / (relative_permittivity + 2.0)
    most = shape * pi * VACUUM_PERMITTIVITY * charging_field * particle_diameter**2 / ELEMENTARY_CHARGE
    return most * dose / (1.0 + dose)


@formula(
    source="white1951; hinds1999, eq. 15.24",
    equation=(
        r"n = \frac{2\pi\varepsilon_0 d_p k T}{e^2}\,"
        r"\ln\left(1 + \frac{e^2 d_p\,\bar c\,N t}{8\varepsilon_0 k T}"
        r"\right)"
    ),
    typical=_TYPICAL | {"temperature": (290.0, 450.0)},
    output="elementary_charges",
    title="Charge of a particle by diffusion charging",
)
def elementary_charges_diffusion(
    particle_diameter: Length,
    temperature: Temperature = 293.15,
    ion_dose: IonDose = 1e13,
    ion_speed: Speed = 240.0,
) -> ElementaryCharges:
    """Elementary charges that the thermal motion of ions gives a particle, without any field.

    The speed is the mean thermal one of air ions. By hand for 0.1 µm, 20 °C, ions of 240 m/s and a dose of
    1e13 s/m³: 0.877 · ln(1 + 21.5).

    >>> round(elementary_charges_diffusion("0.1 um"), 1)
    2.7
    """
    kT = BOLTZMANN * temperature
    scale = 2.0 * pi * VACUUM_PERMITTIVITY * particle_diameter * kT / ELEMENTARY_CHARGE**2
    return scale * jnp.log1p(
        ELEMENTARY_CHARGE**2 * particle_diameter * ion_speed * ion_dose / (8.0 * VACUUM_PERMITTIVITY * kT)
    )


@formula(
    source="hinds1999, eq. 15.16; white1951",
    equation=r"w = \frac{n e E\,C_c}{3\pi\eta d_p}",
    typical=_TYPICAL | {"elementary_charges": (1.0, 1e4), "slip_factor": (1.0, 2.0)},
    title="Migration velocity of a charged particle",
)
def migration_velocity(
    elementary_charges: ElementaryCharges,
    collecting_field: ElectricField,
    particle_diameter: Length,
    dynamic_viscosity: DynamicViscosity,
    slip_factor: Annotated[PositiveNumber, Within(1.0, 1e4)] = 1.0,
) -> Speed:
    """Speed at which the field pulls a particle against Stokes' drag; the viscosity is that of the gas.

    By hand: 300 charges at 3 kV/cm and 1 µm in air: 300 · 1.602e-19 · 3e5/(3 π 1.81e-5 · 1e-6).

    >>> round(migration_velocity(300.0, "3 kV/cm", "1 um", 1.81e-5), 4)
    0.0845
    """
    drag = 3.0 * pi * dynamic_viscosity * particle_diameter
    return elementary_charges * ELEMENTARY_CHARGE * collecting_field * slip_factor / drag


@formula(
    source="deutsch1922",
    equation=r"E = 1 - \exp\left(-\frac{w A}{Q}\right)",
    typical={"migration_velocity": (0.02, 0.2), "area": (10.0, 5000.0), "volume_flow": (0.5, 50.0)},
    output="grade_efficiency",
    title="Grade efficiency of a precipitator (Deutsch–Anderson)",
)
def grade_efficiency_deutsch(migration_velocity: Speed, area: Area, volume_flow: VolumeFlow) -> Fraction:
    """Share of a particle size that reaches the plates from gas that turbulence keeps evenly mixed across.

    A textbook calculator's example: 5 000 m², 50 m³/s and 0.05 m/s collect 99.33 %.

    >>> round(grade_efficiency_deutsch(0.05, 5000.0, 50.0), 4)
    0.9933
    """
    return -jnp.expm1(-migration_velocity * area / jnp.maximum(volume_flow, 1e-300))


@formula(
    source="matts1964",
    equation=r"E = 1 - \exp\left[-\left(\frac{w A}{Q}\right)^k\right]",
    fitted={"migration_exponent": (0.4, 1.0)},
    typical={
        "migration_velocity": (0.1, 0.6),
        "area": (10.0, 50000.0),
        "volume_flow": (0.5, 1000.0),
        "migration_exponent": (0.4, 0.6),
    },
    output="removal_efficiency",
    title="Removal efficiency of a precipitator (Matts–Öhnfeldt)",
)
def removal_efficiency_matts_ohnfeldt(
    migration_velocity: Speed,
    area: Area,
    volume_flow: VolumeFlow,
    migration_exponent: Annotated[PositiveNumber, Within(0.05, 2.0)] = 0.5,
) -> Fraction:
    """Share of a whole dust that is collected, where what is left gets finer and slower along the plates.

    The exponent tells how wide the sizes are: 1 is Deutsch's law of one size, 0.5 usual for fly ash. The
    velocity that goes with it stays the same along the plates, and is higher than Deutsch's from the same
    trial. Recalled, not opened.

    By hand: 100 m² s/m³ and 0.2 m/s give exp(−√20), that is 1.14 % left; to halve that takes 1.33 times the
    plates.

    >>> round(removal_efficiency_matts_ohnfeldt(0.2, 100.0, 1.0), 4)
    0.9886
    """
    plates = migration_velocity * area / jnp.maximum(volume_flow, 1e-300)
    return -jnp.expm1(-(jnp.maximum(plates, 1e-300) ** migration_exponent))
