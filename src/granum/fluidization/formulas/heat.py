"""Heat transfer in fluidized beds: bed to surface, gas to particle. Distributor design."""

from __future__ import annotations

from typing import NamedTuple

import jax.numpy as jnp

from granum.core import formula, watch
from granum.core.constants import STANDARD_GRAVITY
from granum.core.kinds import (
    Acceleration,
    Density,
    DynamicViscosity,
    HeatCapacity,
    HeatTransferCoefficient,
    Length,
    NumberPerArea,
    PositiveNumber,
    PressureDrop,
    Ratio,
    Speed,
    ThermalConductivity,
    Time,
    VoidFraction,
)
from granum.fluidization.formulas.buoyancy import TYPICAL, archimedes
from granum.particles.definitions import ARCHIMEDES, velocity_of

GAS = {**TYPICAL, "thermal_conductivity": (0.02, 0.06), "specific_heat_capacity": (700.0, 1200.0)}


@formula(
    source="zabrodsky1966; kunii1991, ch. 3",
    equation=r"h_{\max} = 35.8\,\rho_p^{0.2}\lambda_g^{0.6} d_p^{-0.36}",
    output="heat_transfer_coefficient",
    fitted={"particle_diameter": (4e-5, 5e-4), "particle_density": (1400.0, 4000.0)},
    typical={**GAS, "particle_diameter": (1e-4, 5e-4), "particle_density": (1500.0, 4000.0)},
    symbols={"thermal_conductivity": r"\lambda_g", "heat_transfer_coefficient": r"h_{\max}"},
)
def heat_transfer_coefficient_zabrodsky(
    particle_diameter: Length, particle_density: Density, thermal_conductivity: ThermalConductivity
) -> HeatTransferCoefficient:
    """Greatest heat transfer coefficient between a bubbling bed and an immersed surface by Zabrodsky, for
    group B.

    Group B: sandlike powders of 40 to 500 µm and 1400 to 4000 kg/m³ (Kunii and Levenspiel).

    >>> 250 < heat_transfer_coefficient_zabrodsky(
    ...     particle_diameter="300 um", particle_density=2500, thermal_conductivity=0.026
    ... ) < 450
    True
    """
    return 35.8 * particle_density**0.2 * thermal_conductivity**0.6 * particle_diameter**-0.36


@formula(
    source="todes1965",
    title="Superficial velocity of best heat transfer",
    equation=r"\mathrm{Re}_{opt} = \frac{\mathrm{Ar}}{18 + 5.22\sqrt{\mathrm{Ar}}}"
    + velocity_of("U_{opt}", "opt")
    + ARCHIMEDES,
    output="superficial_velocity",
    typical=GAS,
    symbols={"superficial_velocity": "U_{opt}"},
)
def superficial_velocity_best_heat_transfer(
    particle_diameter: Length,
    particle_density: Density,
    fluid_density: Density,
    dynamic_viscosity: DynamicViscosity,
    gravity: Acceleration = STANDARD_GRAVITY,
) -> Speed:
    """Gas velocity of the greatest heat transfer to a surface by Todes.

    >>> u = superficial_velocity_best_heat_transfer(
    ...     particle_diameter="300 um", particle_density=2500, fluid_density=1.2, dynamic_viscosity=1.8e-5
    ... )
    >>> 0.3 < u < 0.7
    True
    """
    Ar = archimedes(particle_diameter, particle_density, fluid_density, dynamic_viscosity, gravity)
    return Ar / (18.0 + 5.22 * jnp.sqrt(Ar)) * dynamic_viscosity / (fluid_density * particle_diameter)


@formula(
    source="mickley1955",
    title="Heat transfer coefficient by packets",
    equation=r"\bar h = 2\sqrt{\frac{\lambda_e \rho_p (1-\varepsilon) c_p}{\pi\,t_R}}",
    output="heat_transfer_coefficient",
    typical={
        "thermal_conductivity": (0.1, 0.5),
        "specific_heat_capacity": (700.0, 1200.0),
        "contact_time": (0.1, 2.0),
    },
    symbols={"thermal_conductivity": r"\lambda_e", "heat_transfer_coefficient": r"\bar h"},
)
def heat_transfer_coefficient_packet(
    thermal_conductivity: ThermalConductivity,
    particle_density: Density,
    specific_heat_capacity: HeatCapacity,
    void_fraction: VoidFraction,
    contact_time: Time,
) -> HeatTransferCoefficient:
    """Mean heat transfer coefficient to packets of emulsion that stay a time at a surface, by Mickley and
    Fairbanks.

    The conductivity is that of the emulsion; the heat capacity that of the solid.

    >>> round(
    ...     heat_transfer_coefficient_packet(
    ...         thermal_conductivity=0.2,
    ...         particle_density=2500,
    ...         specific_heat_capacity=800,
    ...         void_fraction=0.5,
    ...         contact_time=1.0,
    ...     )
    ... )
    505
    """
    bulk = particle_density * (1.0 - void_fraction)
    return 2.0 * jnp.sqrt(thermal_conductivity * bulk * specific_heat_capacity / (jnp.pi * contact_time))


@formula(
    source="gunn1978",
    equation=(
        r"\mathrm{Nu} = (7 - 10\varepsilon + 5\varepsilon^2)(1 + 0.7\,\mathrm{Re}^{0.2}\mathrm{Pr}^{1/3}) + "
        r"(1.33 - 2.4\varepsilon + 1.2\varepsilon^2)\mathrm{Re}^{0.7}\mathrm{Pr}^{1/3}"
    ),
    fitted={"reynolds": (0.0, 1e5), "void_fraction": (0.35, 1.0)},
)
def nusselt_number_gunn(
    reynolds: Ratio, prandtl_number: PositiveNumber, void_fraction: VoidFraction
) -> PositiveNumber:
    """Nusselt number of particles in a fixed or fluidized bed by Gunn; with Schmidt for Prandtl the Sherwood
    number.

    In still fluid and an almost empty bed it tends to the 2 of a single sphere.

    >>> round(nusselt_number_gunn(reynolds=10.0, prandtl_number=0.7, void_fraction=0.4), 2)
    10.04
    >>> round(nusselt_number_gunn(reynolds=1e-30, prandtl_number=0.7, void_fraction=0.999999), 3)
    2.0
    """
    Re, third, e = jnp.maximum(reynolds, 1e-300), prandtl_number ** (1.0 / 3.0), void_fraction
    watch(reynolds=reynolds)
    still = (7.0 - 10.0 * e + 5.0 * e**2) * (1.0 + 0.7 * Re**0.2 * third)
    return still + (1.33 - 2.4 * e + 1.2 * e**2) * Re**0.7 * third


@formula(
    source="kothari1967; kunii1991, ch. 11",
    equation=r"\mathrm{Nu}_{bed} = 0.03\,\mathrm{Re}^{1.3}",
    fitted={"reynolds": (0.1, 50.0)},
    symbols={"nusselt_number": r"\mathrm{Nu}_{bed}"},
)
def nusselt_number_kothari(reynolds: PositiveNumber) -> PositiveNumber:
    """Nusselt number between gas and particles of a whole bubbling bed in plug flow, by Kothari, far below
    that of one sphere.

    Low because the gas of the bubbles bypasses, not because the film is thick.

    >>> nusselt_number_kothari(reynolds=1.0)
    0.03
    """
    return 0.03 * reynolds**1.3


class Distributor(NamedTuple):
    """A perforated plate."""

    distributor_pressure_drop: PressureDrop
    orifice_velocity: Speed
    open_area_fraction: Ratio
    orifices_per_area: NumberPerArea


@formula(
    source="kunii1991, ch. 4",
    equation=(
        r"\Delta p_d = r\,\Delta p_b,\ u_{or} = C_d\sqrt{2\Delta p_d/\rho_f},\ N_{or} = \frac{4U}{\pi "
        r"d_{or}^2 u_{or}}"
    ),
    fitted={"distributor_ratio": (0.2, 0.4), "open_area_fraction": (0.0, 0.1)},
    typical={
        "pressure_drop": (2e3, 2e4),
        "orifice_diameter": (1e-3, 5e-3),
        "superficial_velocity": (0.2, 1.0),
        "distributor_ratio": (0.2, 0.4),
        "fluid_density": (0.4, 5.0),
    },
    symbols={"pressure_drop": r"\Delta p_b"},
)
def distributor_design(
    pressure_drop: PressureDrop,
    superficial_velocity: Speed,
    fluid_density: Density,
    orifice_diameter: Length,
    distributor_ratio: PositiveNumber = 0.3,
    discharge_coefficient: PositiveNumber = 0.6,
) -> Distributor:
    """Perforated plate whose pressure drop is a given share of that of the bed: orifice velocity, open area,
    orifices per area.

    A share of 0.2 to 0.4 keeps the gas even; an open area above 10 % is no longer a distributor.

    >>> plate = distributor_design(
    ...     pressure_drop=10000, superficial_velocity=0.4, fluid_density=1.2, orifice_diameter="2 mm"
    ... )
    >>> round(plate.orifice_velocity, 2)
    42.43
    """
    dp = distributor_ratio * pressure_drop
    u = discharge_coefficient * jnp.sqrt(2.0 * dp / fluid_density)
    share = superficial_velocity / u
    return Distributor(dp, u, share, share / (jnp.pi / 4.0 * orifice_diameter**2))
