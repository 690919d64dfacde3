"""Drying rates and times: constant-rate and falling-rate periods, characteristic curve, reaction engineering
approach, receding front.
"""

from __future__ import annotations

from typing import Annotated, Any, NamedTuple

import jax.numpy as jnp

from granum.core import flags, formula
from granum.core.constants import GAS_CONSTANT
from granum.core.kinds import (
    Area,
    Concentration,
    Density,
    Diffusivity,
    Fraction,
    HeatFlux,
    HeatTransferCoefficient,
    HumidityRatio,
    Law,
    Length,
    Mass,
    MassFlux,
    MassTransferCoefficient,
    MoistureDryBasis,
    MolarEnergy,
    PositiveNumber,
    SignedMassFlux,
    SpecificEnergy,
    Temperature,
    TemperatureDifference,
    ThermalConductivity,
    Time,
    VoidFraction,
    Within,
)
from granum.drying.formulas.characteristic import CHARACTERISTIC_LINEAR
from granum.drying.kinds import AddedHeatTransferCoefficient
from granum.numerics import gauss_legendre

Curve = Annotated[Any, Law("characteristic_rate")]
NEVER = "Equilibrium is approached without end: dry to a moisture above it."
WETTER = (
    "The solid would end wetter than it starts. Moistures are per dry solid; percent wants its sign (25 %)."
)


def _dries(start: Any, end: Any) -> Any:
    """Whether moisture falls; says so where it does not."""
    flags.impossible(end > start, end, "moisture_dry_basis_end", 0.0, start, WETTER)
    return end <= start


@formula(
    source="treybal1980, ch. 12",
    equation=r"N_c = \frac{h\,(T_g - T_s)}{L_v}",
    typical={
        "temperature": (330.0, 400.0),
        "surface_temperature": (295.0, 320.0),
        "heat_transfer_coefficient": (20.0, 100.0),
    },
    title="Constant drying rate from heat transfer",
    symbols={"temperature": "T_g"},
)
def drying_rate_constant(
    heat_transfer_coefficient: HeatTransferCoefficient,
    temperature: Temperature,
    surface_temperature: Temperature,
    heat_of_vaporization: SpecificEnergy = 2.4e6,
) -> SignedMassFlux:
    """Evaporation flux of a wet surface that takes its heat from the gas alone; the surface is then at the
    wet bulb.

    By hand: 60 W/(m² K) · 40 K / 2.4 MJ/kg = 1.0 g/(m² s).

    >>> drying_rate_constant(
    ...     heat_transfer_coefficient=60.0, temperature="80 degC", surface_temperature="40 degC"
    ... )
    0.001
    """
    return heat_transfer_coefficient * (temperature - surface_temperature) / heat_of_vaporization


@formula(
    source="treybal1980, ch. 12",
    equation=r"N_c = k_Y\,(w_s - w)",
    title="Constant drying rate from mass transfer",
    output="drying_rate_constant",
    typical={
        "humidity_ratio_surface": (0.03, 0.05),
        "humidity_ratio": (0.005, 0.02),
        "mass_flux_coefficient": (0.01, 0.1),
    },
    symbols={"humidity_ratio_surface": "w_s"},
)
def drying_rate_constant_mass(
    mass_flux_coefficient: MassFlux, humidity_ratio_surface: HumidityRatio, humidity_ratio: HumidityRatio
) -> SignedMassFlux:
    """Evaporation flux of a wet surface from the humidities at the surface and in the gas.

    >>> round(drying_rate_constant_mass(0.05, 0.04, 0.02), 9)
    0.001
    """
    return mass_flux_coefficient * (humidity_ratio_surface - humidity_ratio)


@formula(
    source="treybal1980, ch. 12; geankoplis2003, ch. 9",
    equation=r"t_1 = \frac{m_s}{A\,N_c}(X_1 - X_2)",
    typical={
        "moisture_dry_basis_start": (0.4, 1.0),
        "moisture_dry_basis_end": (0.1, 0.3),
        "drying_rate_constant": (2e-4, 2e-3),
    },
    title="Time of the constant-rate period",
    symbols={"moisture_dry_basis_start": "X_1", "moisture_dry_basis_end": "X_2", "drying_time": "t_1"},
)
def drying_time_constant_rate(
    dry_solid_mass: Mass,
    area: Area,
    drying_rate_constant: MassFlux,
    moisture_dry_basis_start: MoistureDryBasis,
    moisture_dry_basis_end: MoistureDryBasis,
) -> Time:
    """Time to dry from one moisture to another at a constant flux, as long as both are above the critical
    moisture.

    Differs from the print: the notes (U V.8.8) leave out the area; their k is the flux times the area.

    Geankoplis, example 9.6-1 type: 21.5 kg/m² of dry solid, 1.51 kg/(m² h), from 0.38 to 0.25 takes 1.85 h.

    >>> round(drying_time_constant_rate(21.5, 1.0, "1.51 kg/(m^2*hour)", 0.38, 0.25) / 3600, 2)
    1.85
    """
    dries = _dries(moisture_dry_basis_start, moisture_dry_basis_end)
    t = dry_solid_mass / (area * drying_rate_constant) * (moisture_dry_basis_start - moisture_dry_basis_end)
    return jnp.where(dries, t, jnp.nan)


@formula(
    source="treybal1980, ch. 12; geankoplis2003, ch. 9",
    equation=r"t_2 = \frac{m_s}{A\,N_c}(X_c - X_e)\,\ln\frac{X_1 - X_e}{X_2 - X_e}",
    typical={
        "moisture_dry_basis_start": (0.2, 0.25),
        "moisture_dry_basis_end": (0.08, 0.12),
        "critical_moisture": (0.26, 0.3),
        "equilibrium_moisture": (0.01, 0.05),
        "drying_rate_constant": (2e-4, 2e-3),
    },
    title="Time of a falling-rate period along a straight line",
    symbols={"moisture_dry_basis_start": "X_1", "moisture_dry_basis_end": "X_2", "drying_time": "t_2"},
)
def drying_time_falling_rate(
    dry_solid_mass: Mass,
    area: Area,
    drying_rate_constant: MassFlux,
    moisture_dry_basis_start: MoistureDryBasis,
    moisture_dry_basis_end: MoistureDryBasis,
    critical_moisture: MoistureDryBasis,
    equilibrium_moisture: MoistureDryBasis = 0.0,
) -> Time:
    """Time below the critical moisture when the rate falls on a straight line to zero at equilibrium.

    Water above the critical moisture leaves at the constant rate and takes no part: a start or an end above
    it counts as the critical moisture.

    >>> round(drying_time_falling_rate(1.0, 1.0, 0.001, 0.2, 0.1, 0.2, 0.0), 2)
    138.63
    """
    Xe = equilibrium_moisture
    X1, X2 = (jnp.minimum(X, critical_moisture) for X in (moisture_dry_basis_start, moisture_dry_basis_end))
    possible = (Xe < X2) & (Xe < X1) & _dries(moisture_dry_basis_start, moisture_dry_basis_end)
    ratio = jnp.where(possible, X1 - Xe, 1.0) / jnp.where(possible, X2 - Xe, 1.0)
    t = dry_solid_mass / (area * drying_rate_constant) * (critical_moisture - Xe) * jnp.log(ratio)
    flags.impossible(~possible, X2, "moisture_dry_basis_end", Xe, jnp.inf, NEVER)
    return jnp.where(possible, t, jnp.nan)


class DryingTime(NamedTuple):
    """Times of both periods and their sum."""

    drying_time: Time
    drying_time_constant_rate: Time
    drying_time_falling_rate: Time


@formula(
    source="treybal1980, ch. 12; keey1978",
    equation=r"t = \frac{m_s}{A\,N_c}\left[(X_1-X_c) + (X_c-X_e)\ln\frac{X_c-X_e}{X_2-X_e}\right]",
    typical={
        "moisture_dry_basis_start": (0.4, 1.0),
        "moisture_dry_basis_end": (0.08, 0.12),
        "critical_moisture": (0.2, 0.3),
        "equilibrium_moisture": (0.01, 0.05),
        "drying_rate_constant": (2e-4, 2e-3),
    },
    title="Drying time over both periods",
    symbols={"moisture_dry_basis_start": "X_1", "moisture_dry_basis_end": "X_2"},
)
def drying_time(
    dry_solid_mass: Mass,
    area: Area,
    drying_rate_constant: MassFlux,
    moisture_dry_basis_start: MoistureDryBasis,
    moisture_dry_basis_end: MoistureDryBasis,
    critical_moisture: MoistureDryBasis,
    equilibrium_moisture: MoistureDryBasis = 0.0,
) -> DryingTime:
    """Time at constant rate down to the critical moisture, then along a straight line towards equilibrium.
    Either period may be absent.

    By hand: 21.5 kg/m² at 0.3 g/(m² s) from 0.3333 to 0.0638, critical 0.2, no equilibrium water: 71 667
    (0.1333 + 0.2 ln 3.135) s = 25 930 s.

    >>> round(drying_time(21.5, 1.0, 3e-4, 0.3333, 0.0638, 0.2).drying_time, -1)
    25930.0
    """
    X1, X2, Xc, Xe = moisture_dry_basis_start, moisture_dry_basis_end, critical_moisture, equilibrium_moisture
    scale = dry_solid_mass / (area * drying_rate_constant)
    t1 = scale * jnp.maximum(X1 - jnp.maximum(Xc, X2), 0.0)
    upper = jnp.minimum(X1, Xc)
    falling = upper > X2
    possible = (~falling) | (Xe < X2)
    ratio = jnp.where(falling & possible, upper - Xe, 1.0) / jnp.where(falling & possible, X2 - Xe, 1.0)
    flags.impossible(~possible, X2, "moisture_dry_basis_end", Xe, jnp.inf, NEVER)
    # no time: what is dry enough passes a dryer as it is
    flags.limit_active(X2 > X1, X2, "moisture_dry_basis_end", WETTER)
    t2 = jnp.where(possible, scale * (Xc - Xe) * jnp.log(ratio), jnp.nan)
    return DryingTime(t1 + t2, t1 + 0.0 * t2, t2 + 0.0 * t1)


@formula(
    source="vanmeel1958; keey1978",
    equation=(
        r"t = \frac{m_s}{A\,N_c}\left[(X_1-X_c)^+ + "
        r"(X_c-X_e)\int_{\Phi_2}^{\Phi_1}\frac{d\Phi}{f(\Phi)}\right],\quad "
        r"\Phi_1 = \frac{X_1 - X_e}{X_c - X_e},\ \Phi_2 = \frac{X_2 - X_e}{X_c - X_e}"
    ),
    typical={
        "moisture_dry_basis_start": (0.4, 1.0),
        "moisture_dry_basis_end": (0.08, 0.12),
        "critical_moisture": (0.2, 0.3),
        "equilibrium_moisture": (0.01, 0.05),
        "drying_rate_constant": (2e-4, 2e-3),
    },
    title="Drying time with a characteristic curve",
    output="drying_time",
    symbols={"moisture_dry_basis_start": "X_1", "moisture_dry_basis_end": "X_2"},
)
def drying_time_characteristic(
    dry_solid_mass: Mass,
    area: Area,
    drying_rate_constant: MassFlux,
    moisture_dry_basis_start: MoistureDryBasis,
    moisture_dry_basis_end: MoistureDryBasis,
    critical_moisture: MoistureDryBasis,
    equilibrium_moisture: MoistureDryBasis = 0.0,
    characteristic_rate: Curve = CHARACTERISTIC_LINEAR,
) -> Time:
    """Drying time for any characteristic drying curve f(Φ), integrated over the logarithm of the
    characteristic moisture.

    With f = Φ it is the closed form of ``drying_time``.

    >>> round(drying_time_characteristic(21.5, 1.0, 3e-4, 0.3333, 0.0638, 0.2), -1)
    25930.0
    """
    X1, X2, Xc, Xe = moisture_dry_basis_start, moisture_dry_basis_end, critical_moisture, equilibrium_moisture
    span = Xc - Xe
    possible = (Xe < X2) & (span > 0) & _dries(X1, X2)
    low = jnp.where(
        possible, jnp.clip((jnp.minimum(X2, Xc) - Xe) / jnp.where(span > 0, span, 1.0), 1e-9, 1.0), 1.0
    )
    high = jnp.clip((jnp.minimum(X1, Xc) - Xe) / jnp.where(span > 0, span, 1.0), 1e-9, 1.0)
    above = jnp.maximum(X1 - jnp.maximum(Xc, X2), 0.0)
    integral = gauss_legendre(
        lambda s: jnp.exp(s) / characteristic_rate.rate(jnp.exp(s)), jnp.log(low), jnp.log(high), order=32
    )
    flags.impossible(~possible, X2, "moisture_dry_basis_end", Xe, jnp.inf, NEVER)
    return jnp.where(
        possible, dry_solid_mass / (area * drying_rate_constant) * (above + span * integral), jnp.nan
    )


@formula(
    source="chen2008rea",
    equation=r"N = h_m\left[e^{-\Delta E_v/RT_s}\,\rho_{v,s} - \rho_{v,g}\right]",
    typical={
        "vapor_density_surface": (0.05, 0.1),
        "vapor_density": (0.005, 0.02),
        "temperature": (310.0, 350.0),
        "evaporation_activation_energy": (0.0, 3e3),
        "mass_transfer_coefficient": (0.01, 0.1),
    },
    title="Drying flux, reaction engineering approach",
    output="drying_rate_constant",
    symbols={
        "drying_rate_constant": "N",
        "vapor_density_surface": r"\rho_{v,s}",
        "vapor_density": r"\rho_{v,g}",
        "temperature": "T_s",
    },
)
def drying_flux_rea(
    mass_transfer_coefficient: MassTransferCoefficient,
    vapor_density_surface: Concentration,
    vapor_density: Concentration,
    temperature: Temperature,
    evaporation_activation_energy: MolarEnergy = 0.0,
) -> SignedMassFlux:
    """Chen's approach: evaporation needs an activation energy that grows from zero, for a wet surface, as the
    product dries.

    >>> drying_flux_rea(0.02, 0.06, 0.01, "320 K")
    0.001
    """
    psi = jnp.exp(-evaporation_activation_energy / (GAS_CONSTANT * temperature))
    return mass_transfer_coefficient * (psi * vapor_density_surface - vapor_density)


@formula(
    source="chen2008rea",
    equation=r"\Delta E_v = \Delta E_{v,b}\;a\,e^{-b\,(X-X_e)^c},\quad \Delta E_{v,b} = -R\,T\,\ln\varphi",
    typical={
        "moisture_dry_basis": (0.3, 1.0),
        "equilibrium_moisture": (0.02, 0.05),
        "relative_humidity": (0.05, 0.3),
    },
    title="Activation energy of drying, reaction engineering approach",
)
def evaporation_activation_energy(
    moisture_dry_basis: MoistureDryBasis,
    equilibrium_moisture: MoistureDryBasis,
    temperature: Temperature,
    relative_humidity: Fraction,
    rea_factor: PositiveNumber = 0.998,
    rea_coefficient: PositiveNumber = 1.405,
    rea_exponent: PositiveNumber = 0.930,
) -> MolarEnergy:
    """Activation energy of evaporation along the master curve of a product; the defaults are those of
    skim-milk droplets.

    At equilibrium it reaches −R T ln φ of the gas, so that the flux vanishes. The defaults are Chen and Lin's
    (AIChE Journal 51, 2005) for 20 % of solids at first; they lie within 0.04 of the polynomial of Chew et
    al. (2013) for 30 %.

    >>> round(
    ...     evaporation_activation_energy(0.05, 0.05, 350.0, 0.1, rea_factor=1.0)
    ...     / (8.314462618 * 350 * 2.302585),
    ...     6,
    ... )
    1.0
    """
    excess = jnp.maximum(moisture_dry_basis - equilibrium_moisture, 1e-12)
    relative = rea_factor * jnp.exp(-rea_coefficient * excess**rea_exponent)
    return relative * -GAS_CONSTANT * temperature * jnp.log(relative_humidity)


@formula(
    source="keey1978",
    equation=r"N = \frac{\rho_{v,s}-\rho_{v,g}}{1/h_m + \delta/D_e}",
    typical={
        "vapor_density_surface": (0.05, 0.1),
        "vapor_density": (0.005, 0.02),
        "shell_thickness": (1e-4, 5e-3),
        "diffusivity": (1e-6, 1e-5),
        "mass_transfer_coefficient": (0.01, 0.1),
    },
    title="Drying flux from a receding front",
    output="drying_rate_constant",
    symbols={
        "drying_rate_constant": "N",
        "vapor_density_surface": r"\rho_{v,s}",
        "vapor_density": r"\rho_{v,g}",
        "diffusivity": "D_e",
    },
)
def drying_flux_receding_front(
    mass_transfer_coefficient: MassTransferCoefficient,
    vapor_density_surface: Concentration,
    vapor_density: Concentration,
    shell_thickness: Length,
    diffusivity: Diffusivity,
) -> SignedMassFlux:
    """Vapor that diffuses from an evaporation front through a dry shell and then through the gas film.

    >>> drying_flux_receding_front(0.02, 0.06, 0.01, "1 mm", 2e-5)
    0.0005
    """
    return (vapor_density_surface - vapor_density) / (
        1.0 / mass_transfer_coefficient + shell_thickness / diffusivity
    )


@formula(
    source="keey1978",
    equation=r"t = \frac{L_v\,\rho_w\,\varepsilon}{\Delta T}\left(\frac{L}{h} + \frac{L^2}{2\lambda}\right)",
    typical={
        "thickness": (1e-3, 2e-2),
        "temperature_difference": (10.0, 60.0),
        "thermal_conductivity": (0.05, 0.3),
        "heat_transfer_coefficient": (20.0, 100.0),
    },
    title="Drying time of a slab with a receding front",
)
def drying_time_receding_front(
    thickness: Length,
    void_fraction: VoidFraction,
    temperature_difference: Annotated[TemperatureDifference, Within(0.0)],
    heat_transfer_coefficient: HeatTransferCoefficient,
    thermal_conductivity: ThermalConductivity,
    liquid_density: Density = 998.0,
    heat_of_vaporization: SpecificEnergy = 2.4e6,
) -> Time:
    """Time for the front to cross a slab of full pores heated from one side, limited by heat through film and
    dry layer (quasi-steady).

    With a well-conducting shell it is λ ρ ε L/(h ΔT).

    >>> round(
    ...     drying_time_receding_front("10 mm", 0.4, 50.0, 20.0, 1e9)
    ...     / (2.4e6 * 998 * 0.4 * 0.01 / (20 * 50)),
    ...     6,
    ... )
    1.0
    """
    L = thickness
    flags.impossible(
        ~(temperature_difference > 0.0), temperature_difference, "temperature_difference", 0.0, jnp.inf
    )
    load = heat_of_vaporization * liquid_density * void_fraction / temperature_difference
    return load * (L / heat_transfer_coefficient + L**2 / (2.0 * thermal_conductivity))


@formula(
    source="treybal1980, ch. 12",
    equation=r"q = (h + U_k)(T_g - T_s) + h_r(T_r - T_s),\quad q = k_Y L_v (w_s - w)",
    typical={
        "temperature": (330.0, 400.0),
        "surface_temperature": (295.0, 320.0),
        "radiator_temperature": (330.0, 400.0),
        "heat_transfer_coefficient": (20.0, 100.0),
    },
    title="Heat flux to a wet surface by all ways",
    output="heat_flux",
    symbols={"temperature": "T_g"},
)
def heat_flux_combined(
    heat_transfer_coefficient: HeatTransferCoefficient,
    temperature: Temperature,
    surface_temperature: Temperature,
    radiator_temperature: Temperature,
    emissivity: Fraction = 0.94,
    conduction_coefficient: AddedHeatTransferCoefficient = 0.0,
) -> HeatFlux:
    """Convection, conduction through the tray and radiation from a hot surface that the solid sees, referred
    to the drying surface.

    >>> round(heat_flux_combined(50.0, 350.0, 310.0, 310.0), 6)
    2000.0
    """
    Ts, Tr = surface_temperature, radiator_temperature
    radiation = emissivity * 5.670374419e-8 * (Tr**4 - Ts**4)
    return (heat_transfer_coefficient + conduction_coefficient) * (temperature - Ts) + radiation
