"""Contact drying on heated walls: heat from wall to particles, penetration with an evaporation front, mixing,
trays and films.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import jax
import jax.numpy as jnp

from granum.core import formula, impossible
from granum.core.constants import GAS_CONSTANT, STANDARD_GRAVITY
from granum.core.kinds import (
    Distance,
    Fraction,
    HeatCapacity,
    HeatTransferCoefficient,
    Length,
    MassFlux,
    MassPerArea,
    MoistureDryBasis,
    MolarMass,
    PositiveNumber,
    Pressure,
    Ratio,
    RotationSpeed,
    SpecificEnergy,
    Temperature,
    ThermalConductivity,
    Time,
)
from granum.numerics import find_root

_PENETRATION = "mollekopf1984; vdi2010, ch. Mc"
COVERED = 0.8  # share of the wall covered by particles


@formula(
    source=_PENETRATION,
    equation=(
        r"h_{ws} = \varphi h_{wp} + (1-\varphi)\frac{2\lambda_g/d}{\sqrt2 + 2(l+\delta)/d} + "
        r"4\varepsilon\sigma T^3,\quad h_{wp} = "
        r"\frac{4\lambda_g}{d}\left[\left(1+\frac{2(l+\delta)}{d}\right)"
        r"\ln\left(1+\frac{d}{2(l+\delta)}\right) "
        r"- 1\right],\quad l = \frac{2\,(2-\gamma)}{\gamma}\,\frac{\sqrt{2\pi R T/M}\,\lambda_g}{p\,(2 "
        r"c_p - R/M)}"
    ),
    typical={
        "particle_diameter": (2e-4, 3e-3),
        "pressure": (1e3, 1e5),
        "temperature": (320.0, 400.0),
        "roughness": (0.0, 5e-6),
        "thermal_conductivity": (0.018, 0.026),
    },
    output="heat_transfer_coefficient",
    title="Heat transfer from a wall to a bed of particles",
    symbols={"particle_diameter": "d", "heat_transfer_coefficient": "h_{ws}"},
)
def heat_transfer_coefficient_wall_particles(
    particle_diameter: Length,
    temperature: Temperature,
    pressure: Pressure,
    thermal_conductivity: ThermalConductivity = 0.024,
    roughness: Distance = 0.0,
    emissivity: Fraction = 0.8,
    accommodation: Fraction = 0.9,
    molar_mass: MolarMass = 0.018015268,
    specific_heat_capacity: HeatCapacity = 1890.0,
) -> HeatTransferCoefficient:
    """Coefficient between a heated wall and the first layer of particles, through the gas in the gap; it
    falls when the mean free path grows.

    The gas in the gap is water vapor unless its conductivity, molar mass and heat capacity are given; four
    fifths of the wall are covered. Under vacuum the wall, at atmospheric pressure the bed resists more.

    By hand for 1 mm, no roughness, 1e5 Pa and 373 K: l = 0.184 µm, h_wp = 96·(1.00037·ln 2720 − 1) = 663,
    whole 547 W/(m² K).

    >>> round(heat_transfer_coefficient_wall_particles("1 mm", 373.15, 1e5))
    547
    """
    d, T = particle_diameter, temperature
    R = GAS_CONSTANT / molar_mass
    free = (
        2.0
        * (2.0 - accommodation)
        / accommodation
        * jnp.sqrt(2.0 * jnp.pi * R * T)
        * thermal_conductivity
        / (pressure * (2.0 * specific_heat_capacity - R))
    )
    gap = 2.0 * (free + roughness) / d
    touching = 4.0 * thermal_conductivity / d * ((1.0 + gap) * jnp.log1p(1.0 / gap) - 1.0)
    between = 2.0 * thermal_conductivity / d / (jnp.sqrt(2.0) + gap)
    radiation = 4.0 * emissivity * 5.670374419e-8 * T**3
    return COVERED * touching + (1.0 - COVERED) * between + radiation


@formula(
    source=_PENETRATION,
    equation=r"t_R = \frac{2\pi\,C\,\mathrm{Fr}^x}{\omega},\quad \mathrm{Fr} = \frac{\omega^2 D}{2 g}",
    typical={"rotation_speed": (0.5, 6.0), "diameter": (0.3, 2.0)},
    title="Contact time between mixings",
)
def contact_time_mixing(
    rotation_speed: RotationSpeed,
    diameter: Length,
    mixing_factor: PositiveNumber = 9.0,
    mixing_exponent: Ratio = 0.05,
) -> Time:
    """Time for which an agitated bed may be thought to rest on the wall before it is wholly mixed.

    Factor and exponent are 9 and 0.05 for paddles, 16 and 0.2 for a drum, 25 and 0.2 for discs.

    By hand, 10 rpm and 1 m: Fr 0.0559, 9·0.866 = 7.79 turns, that is 46.8 s.

    >>> round(contact_time_mixing("10 rpm", 1.0), 1)
    46.7
    """
    froude = rotation_speed**2 * diameter / (2.0 * STANDARD_GRAVITY)
    return mixing_factor * froude**mixing_exponent * 2.0 * jnp.pi / rotation_speed


class Penetration(NamedTuple):
    """Heat and vapor of a wet bed on a hot wall."""

    front_position: Ratio
    heat_transfer_coefficient: HeatTransferCoefficient
    latent_share: Fraction
    drying_flux: MassFlux


@formula(
    source=_PENETRATION,
    equation=r"\sqrt\pi\,\zeta e^{\zeta^2}\left(\frac{h_{b}}{h_{ws}} + \mathrm{erf}\,\zeta\right) = \frac{c\,(T_w-T_b)}{X L_v},\quad "  # noqa: E501
    r"h = \frac{h_{ws}}{1 + \frac{h_{ws}}{h_b}\mathrm{erf}\,\zeta},\quad N = \frac{h\,(T_w - T_b)\,e^{-\zeta^2}}{L_v}",  # noqa: E501
    typical={
        "moisture_dry_basis": (0.05, 0.4),
        "wall_temperature": (370.0, 410.0),
        "temperature_bed": (310.0, 350.0),
        "heat_transfer_coefficient_wall": (200.0, 800.0),
        "heat_transfer_coefficient_bed": (40.0, 200.0),
    },
    title="Contact drying of an agitated bed (penetration model)",
    output="drying_flux",
    symbols={"heat_transfer_coefficient_wall": "h_{ws}", "heat_transfer_coefficient_bed": "h_b"},
)
def penetration_drying(
    moisture_dry_basis: MoistureDryBasis,
    wall_temperature: Temperature,
    temperature_bed: Temperature,
    heat_transfer_coefficient_wall: HeatTransferCoefficient,
    heat_transfer_coefficient_bed: HeatTransferCoefficient,
    specific_heat_capacity: HeatCapacity = 1000.0,
    heat_of_vaporization: SpecificEnergy = 2.4e6,
) -> Penetration:
    """Mean heat and vapor flux of one contact period: a drying front runs from the wall into the bed, dry
    behind it.

    ``heat_transfer_coefficient_bed`` is that of the dry bed penetrated for the contact time
    (``heat_transfer_coefficient_penetration``). Without wall resistance it is the one-phase Stefan problem; a
    very wet bed takes what the wall gives; a dry one has both in series.

    >>> wet = penetration_drying(1e4, 380.0, 330.0, 500.0, 100.0)
    >>> round(wet.heat_transfer_coefficient, 1), round(wet.latent_share, 3)
    (500.0, 1.0)
    """
    impossible(
        wall_temperature < temperature_bed, wall_temperature, "wall_temperature", temperature_bed, jnp.inf
    )
    impossible(~(heat_of_vaporization > 0.0), heat_of_vaporization, "heat_of_vaporization", 0.0, jnp.inf)
    stefan = (
        specific_heat_capacity
        * (wall_temperature - temperature_bed)
        / (jnp.maximum(moisture_dry_basis, 1e-9) * heat_of_vaporization)
    )
    ratio = heat_transfer_coefficient_bed / heat_transfer_coefficient_wall

    def balance(z: Any) -> Any:
        return (
            jnp.log(jnp.sqrt(jnp.pi) * z)
            + z * z
            + jnp.log(ratio + jax.lax.erf(z))
            - jnp.log(jnp.maximum(stefan, 1e-30))
        )

    z = find_root(balance, 1e-16, 8.0, start=jnp.minimum(stefan / (ratio * 1.78), 1.0), tolerance=1e-12).value
    z = jnp.where(stefan > 0, z, 0.0)
    h = heat_transfer_coefficient_wall / (1.0 + jax.lax.erf(z) / ratio)
    share = jnp.exp(-z * z)
    return Penetration(z, h, share, h * (wall_temperature - temperature_bed) * share / heat_of_vaporization)


@formula(
    source="treybal1980, ch. 12",
    equation=r"T_2 = T_s + (T_1 - T_s)\,e^{-\frac{h\,L}{G\,c\,s}}",
    typical={
        "temperature": (340.0, 390.0),
        "surface_temperature": (305.0, 315.0),
        "heat_transfer_coefficient": (20.0, 60.0),
        "gas_mass_flux": (1.0, 5.0),
        "tray_length": (0.3, 1.5),
        "tray_gap": (0.03, 0.1),
    },
    title="Gas along a wet tray",
    output="temperature_outlet",
    symbols={"temperature": "T_1", "temperature_outlet": "T_2"},
)
def temperature_outlet_tray(
    temperature: Temperature,
    surface_temperature: Temperature,
    heat_transfer_coefficient: HeatTransferCoefficient,
    gas_mass_flux: MassFlux,
    tray_length: Length,
    tray_gap: Length,
    specific_heat_capacity: HeatCapacity = 1050.0,
) -> Temperature:
    """Temperature of the gas at the end of a wet tray whose surface stays at the wet bulb; the mean flux
    follows from the difference.

    A tutorial of the University of Glasgow (ENG2109): 0.3 kg/s at 90 °C and 10 %, 0.5 m wide, 200 W/(m² K),
    leaves at 60 °C after 3.59 m.

    >>> round(temperature_outlet_tray("90 degC", "45 degC", 200.0, 6.0, 3.59, 0.1, 1092.0) - 273.15)
    60
    """
    units = heat_transfer_coefficient * tray_length / (gas_mass_flux * tray_gap * specific_heat_capacity)
    return surface_temperature + (temperature - surface_temperature) * jnp.exp(-units)


@formula(
    source="treybal1980, ch. 12",
    equation=(
        r"X = X_0 - \frac{N_c\,t_R}{m/A}\ (X \ge X_c),\qquad X = X_e + (X_c - "
        r"X_e)\,e^{-\frac{N_c\,(t_R-t_c)}{(m/A)\,(X_c - X_e)}}"
    ),
    typical={
        "moisture_dry_basis_inlet": (1.0, 4.0),
        "contact_time": (2.0, 20.0),
        "drying_rate_constant": (5e-3, 2e-2),
        "dry_mass_per_area": (0.01, 0.05),
        "critical_moisture": (0.2, 0.5),
    },
    title="Moisture after a time at a constant and a falling rate",
    output="moisture_dry_basis",
    symbols={"moisture_dry_basis_inlet": "X_0"},
)
def moisture_dry_basis_after(
    moisture_dry_basis_inlet: MoistureDryBasis,
    contact_time: Time,
    drying_rate_constant: MassFlux,
    dry_mass_per_area: MassPerArea,
    critical_moisture: MoistureDryBasis,
    equilibrium_moisture: MoistureDryBasis = 0.0,
) -> MoistureDryBasis:
    """Moisture of a film, tray or sheet of known dry mass per area: straight down to the critical moisture,
    then exponential.

    By hand: 0.02 kg/m², 0.01 kg/(m² s), from 2: critical 0.4 after 3.2 s; 0.8 s later 0.4·e⁻¹ = 0.1472.

    >>> round(moisture_dry_basis_after(2.0, 4.0, 0.01, 0.02, 0.4), 4)
    0.1472
    """
    rate = drying_rate_constant / dry_mass_per_area
    Xc = jnp.minimum(critical_moisture, moisture_dry_basis_inlet)
    until = (moisture_dry_basis_inlet - Xc) / rate
    span = Xc - equilibrium_moisture
    fallen = jnp.maximum(contact_time - until, 0.0) * rate / jnp.where(span > 0, span, 1.0)
    falling = equilibrium_moisture + span * jnp.exp(-fallen)
    return jnp.where(contact_time < until, moisture_dry_basis_inlet - rate * contact_time, falling)
