"""Heat to a drying product: convection, conduction, radiation, microwaves, vacuum."""

from __future__ import annotations

import jax.numpy as jnp

from granum.core import formula, watch
from granum.core.constants import HOUR, STEFAN_BOLTZMANN, VACUUM_PERMITTIVITY
from granum.core.kinds import (
    Area,
    Fraction,
    Frequency,
    HeatTransferCoefficient,
    Length,
    MassFlux,
    PositiveNumber,
    Power,
    Ratio,
    SignedMassFlux,
    SpecificEnergy,
    Temperature,
    ThermalConductivity,
    Time,
    VoidFraction,
)
from granum.drying.kinds import ElectricField, PowerDensity, ThermalEffusivity

VISCOSITY = 2.1e-5  # Pa s, of air


@formula(
    source="treybal1980, ch. 12; geankoplis2003, ch. 9",
    equation=r"h = 0.0204\,G^{0.8},\quad G\text{ in }\mathrm{kg/(m^2 h)}",
    fitted={"gas_mass_flux": (2450.0 / HOUR, 29300.0 / HOUR)},
    typical={"gas_mass_flux": (1.0, 8.0)},
    output="heat_transfer_coefficient",
    title="Convection to a tray, gas parallel to it",
)
def heat_transfer_coefficient_parallel(gas_mass_flux: MassFlux) -> HeatTransferCoefficient:
    """Air between 45 and 150 °C along a drying surface, 0.6 to 8 m/s.

    Geankoplis, example 9.6-2 type: G = 22 770 kg/(m² h) gives 62.45 W/(m² K).

    >>> round(heat_transfer_coefficient_parallel(gas_mass_flux="22770 kg/(m^2*hour)"), 1)
    62.4
    """
    return 0.0204 * (gas_mass_flux * HOUR) ** 0.8


@formula(
    source="treybal1980, ch. 12; geankoplis2003, ch. 9",
    equation=r"h = 1.17\,G^{0.37},\quad G\text{ in }\mathrm{kg/(m^2 h)}",
    fitted={"gas_mass_flux": (3900.0 / HOUR, 19500.0 / HOUR)},
    typical={"gas_mass_flux": (1.2, 5.0)},
    output="heat_transfer_coefficient",
    title="Convection to a surface, gas perpendicular to it",
)
def heat_transfer_coefficient_perpendicular(gas_mass_flux: MassFlux) -> HeatTransferCoefficient:
    """Air blown at right angles on a drying surface, 0.9 to 4.6 m/s.

    By hand: 10 000^0.37 = 30.2, times 1.17 is 35.3.

    >>> round(heat_transfer_coefficient_perpendicular(gas_mass_flux="10000 kg/(m^2*hour)"), 1)
    35.3
    """
    return 1.17 * (gas_mass_flux * HOUR) ** 0.37


@formula(
    source="treybal1980, ch. 12",
    fitted={"reynolds": (2600.0, 22000.0)},
    equation=r"h = 5.90\,\frac{G^{0.71}}{d_e^{0.29}},\quad \mathrm{SI}",
    typical={"gas_mass_flux": (1.0, 8.0), "equivalent_diameter": (0.02, 0.2)},
    output="heat_transfer_coefficient",
    title="Convection to a tray in a channel",
)
def heat_transfer_coefficient_channel(
    gas_mass_flux: MassFlux, equivalent_diameter: Length
) -> HeatTransferCoefficient:
    """Air along the surface between two trays, on the equivalent diameter of the channel; Reynolds number
    2600 to 22 000.

    By hand: 5.90 · 2^0.71/0.1^0.29 = 5.90 · 1.636 · 1.950 = 18.8.

    The Reynolds number is taken with the viscosity of air at about 90 °C.

    >>> round(heat_transfer_coefficient_channel(gas_mass_flux=2.0, equivalent_diameter=0.1), 1)
    18.8
    """
    watch(reynolds=gas_mass_flux * equivalent_diameter / VISCOSITY)
    return 5.90 * gas_mass_flux**0.71 / equivalent_diameter**0.29


@formula(
    source="martin1977",
    equation=(
        r"\mathrm{Nu} = \left[1+\left(\tfrac{H/D}{0.6/\sqrt f}\right)^6\right]^{-0.05}\frac{\sqrt "
        r"f\,(1-2.2\sqrt f)}{1+0.2(H/D-6)\sqrt f}\,\mathrm{Re}^{2/3}\mathrm{Pr}^{0.42}"
    ),
    fitted={
        "reynolds": (2000.0, 100000.0),
        "nozzle_area_fraction": (0.004, 0.04),
        "nozzle_distance_ratio": (2.0, 12.0),
    },
    typical={"reynolds": (3000.0, 50000.0)},
    output="nusselt_number",
    title="Impinging jets, array of round nozzles (Martin)",
)
def nusselt_number_impinging(
    reynolds: PositiveNumber,
    prandtl_number: PositiveNumber,
    nozzle_area_fraction: Fraction,
    nozzle_distance_ratio: PositiveNumber,
) -> PositiveNumber:
    """Mean Nusselt number under an array of round nozzles, on the nozzle's diameter, Reynolds number on its
    outlet velocity.

    ``nozzle_area_fraction`` is open area over heated area, ``nozzle_distance_ratio`` distance over diameter.

    Textbooks split it as K · G · F with G = 2√f … and F = Re^⅔/2. By hand at Re 10⁴, Pr 0.7, f 0.02, H/D 6: K
    = 9^−0.05 = 0.896, √f (1 − 2.2√f) = 0.0974, product with 464.2 and 0.861 is 34.9.

    >>> round(nusselt_number_impinging(1e4, 0.7, 0.02, 6.0), 1)
    34.9
    """
    f, H = nozzle_area_fraction, nozzle_distance_ratio
    root = jnp.sqrt(f)
    K = (1.0 + (H * root / 0.6) ** 6) ** -0.05
    G = root * (1.0 - 2.2 * root) / (1.0 + 0.2 * (H - 6.0) * root)
    return K * G * reynolds ** (2.0 / 3.0) * prandtl_number**0.42


@formula(
    source="treybal1980, ch. 12",
    equation=r"j_D = \frac{2.06}{\varepsilon}\,\mathrm{Re}^{-0.575}",
    fitted={"reynolds": (90.0, 4000.0)},
    typical={"reynolds": (100.0, 3000.0)},
    title="Through-circulation of a bed of particles",
    symbols={"colburn_factor": "j_D"},
)
def colburn_factor_through_circulation(
    reynolds: PositiveNumber, void_fraction: VoidFraction
) -> PositiveNumber:
    """Colburn factor of heat or mass transfer for gas through a bed of spheres, Reynolds number on diameter
    and empty section.

    By hand: 2.06/0.4 · 1000^−0.575 = 0.0970.

    >>> round(colburn_factor_through_circulation(reynolds=1000.0, void_fraction=0.4), 4)
    0.097
    """
    return 2.06 / void_fraction * reynolds**-0.575


@formula(
    source="treybal1980, ch. 12",
    equation=r"\frac{N}{N_{max}} = 1 - e^{-N_{tG}}",
    typical={"transfer_units": (0.2, 4.0)},
    title="Through-circulation, share of saturation",
)
def saturation_share(transfer_units: Ratio) -> Fraction:
    """Share of the way to saturation that gas makes on its path through a wet bed, from the number of
    transfer units h a z/(G c).

    >>> round(saturation_share(transfer_units=1.0), 4)
    0.6321
    """
    return 1.0 - jnp.exp(-transfer_units)


@formula(
    source="keey1978",
    equation=r"\frac1U = \frac{1}{h_i} + \frac{s}{\lambda} + \frac{1}{h_s}",
    typical={
        "heat_transfer_coefficient_inside": (2000.0, 10000.0),
        "heat_transfer_coefficient_product": (100.0, 1000.0),
        "wall_thickness": (2e-3, 1e-2),
        "thermal_conductivity": (15.0, 50.0),
    },
    title="Conduction in series through a heated wall",
    output="heat_transfer_coefficient",
    symbols={
        "heat_transfer_coefficient_inside": "h_i",
        "heat_transfer_coefficient_product": "h_s",
        "heat_transfer_coefficient": "U",
    },
)
def heat_transfer_coefficient_series(
    heat_transfer_coefficient_inside: HeatTransferCoefficient,
    wall_thickness: Length,
    thermal_conductivity: ThermalConductivity,
    heat_transfer_coefficient_product: HeatTransferCoefficient,
) -> HeatTransferCoefficient:
    """Overall coefficient from heating steam through the wall to the product: resistances add.

    The notes (U V.8.4.2) write the wall as one coefficient h_p: it is λ/s.

    >>> round(heat_transfer_coefficient_series(1000.0, "10 mm", 10.0, 1000.0), 3)
    333.333
    """
    return 1.0 / (
        1.0 / heat_transfer_coefficient_inside
        + wall_thickness / thermal_conductivity
        + 1.0 / heat_transfer_coefficient_product
    )


@formula(
    source="mollekopf1984",
    equation=r"h_{bed} = \frac{2\,e}{\sqrt{\pi\,t_R}},\quad e = \sqrt{\rho\,c\,\lambda}",
    typical={"thermal_effusivity": (200.0, 600.0), "contact_time": (1.0, 60.0)},
    title="Contact drying, penetration of heat into a bed",
    output="heat_transfer_coefficient",
    symbols={"heat_transfer_coefficient": "h_{bed}"},
)
def heat_transfer_coefficient_penetration(
    thermal_effusivity: ThermalEffusivity, contact_time: Time
) -> HeatTransferCoefficient:
    """Mean coefficient of a bed that rests for a time on a hot wall before it is mixed; effusivity √(ρ c λ)
    in J/(m² K s^½).

    >>> round(heat_transfer_coefficient_penetration(400.0, 16.0), 2)
    112.84
    """
    return 2.0 / jnp.sqrt(jnp.pi) * thermal_effusivity / jnp.sqrt(contact_time)


@formula(
    source="keey1978; incropera2007",
    equation=(
        r"\dot Q = \frac{A_1\,F\,\sigma\,(T_2^4 - T_1^4)}{\frac{1}{\varepsilon_1} + "
        r"\frac{A_1}{A_2}\left(\frac{1}{\varepsilon_2}-1\right)}"
    ),
    typical={
        "temperature_radiator": (500.0, 1100.0),
        "temperature_product": (300.0, 380.0),
        "area_product": (0.5, 1.0),
        "area_radiator": (1.0, 2.0),
        "emissivity_product": (0.6, 0.95),
        "emissivity_radiator": (0.6, 0.95),
    },
    title="Radiation between product and heater",
    output="heat_duty",
    symbols={
        "temperature_radiator": "T_2",
        "temperature_product": "T_1",
        "area_product": "A_1",
        "area_radiator": "A_2",
        "emissivity_product": r"\varepsilon_1",
        "emissivity_radiator": r"\varepsilon_2",
    },
)
def heat_duty_radiation(
    temperature_radiator: Temperature,
    temperature_product: Temperature,
    area_product: Area,
    area_radiator: Area,
    emissivity_product: Fraction = 0.9,
    emissivity_radiator: Fraction = 0.9,
    view_factor: Fraction = 1.0,
) -> Power:
    """Gray exchange between a product and the heater that surrounds it, as in the notes D II.5 and II.6.

    Differs from the print: with (T/100)⁴ the constant is 5.67 W/(m² K⁴), not 5.67e-8; both temperatures are
    absolute.

    Two large black plates at 1000 and 300 K exchange σ (10¹² − 0.0081·10¹²) = 56.24 kW/m².

    >>> round(heat_duty_radiation(1000.0, 300.0, 1.0, 1.0, 1.0, 1.0) / 1e3, 2)
    56.24
    """
    resistance = 1.0 / emissivity_product + area_product / area_radiator * (1.0 / emissivity_radiator - 1.0)
    return (
        area_product
        * view_factor
        * STEFAN_BOLTZMANN
        * (temperature_radiator**4 - temperature_product**4)
        / resistance
    )


@formula(
    source="metaxas1983",
    equation=r"P''' = 2\pi f\,\varepsilon_0\,\varepsilon''\,E^2",
    typical={"frequency": (1e7, 3e9), "loss_factor": (0.1, 15.0), "electric_field": (1e3, 1e5)},
    title="Dielectric heating, power per volume",
)
def dielectric_power_density(
    frequency: Frequency, loss_factor: PositiveNumber, electric_field: ElectricField
) -> PowerDensity:
    """Heat set free per volume (W/m³) by an alternating field (rms, V/m) in a product of given loss factor:
    radio waves and microwaves.

    Metaxas and Meredith: 0.556e-10 f ε'' E².

    >>> round(dielectric_power_density(1e9, 1.0, 1e4) / (0.556e-10 * 1e9 * 1e8), 2)
    1.0
    """
    return 2.0 * jnp.pi * frequency * VACUUM_PERMITTIVITY * loss_factor * electric_field**2


@formula(
    source="metaxas1983",
    equation=(
        r"D_p = \frac{c}{2\pi "
        r"f\sqrt{2\varepsilon'}}\left[\sqrt{1+(\varepsilon''/\varepsilon')^2}-1\right]^{-1/2}"
    ),
    typical={"frequency": (1e7, 3e9), "loss_factor": (0.5, 10.0), "dielectric_constant": (2.0, 70.0)},
    title="Penetration depth of microwaves",
)
def penetration_depth(
    frequency: Frequency, dielectric_constant: PositiveNumber, loss_factor: PositiveNumber
) -> Length:
    """Depth at which the power has fallen to 1/e; with little loss λ₀ √ε'/(2π ε'').

    Water at 25 °C and 2.45 GHz, ε' 78 and ε'' 10: by the small-loss form 17.2 mm.

    >>> round(penetration_depth("2.45 GHz", 78.0, 10.0) * 1e3, 1)
    17.2
    """
    ratio = loss_factor / dielectric_constant
    inner = ratio**2 / (jnp.sqrt(1.0 + ratio**2) + 1.0)  # √(1+r²) − 1 without cancellation
    return 299792458.0 / (2.0 * jnp.pi * frequency * jnp.sqrt(2.0 * dielectric_constant)) / jnp.sqrt(inner)


@formula(
    source="treybal1980, ch. 12",
    equation=r"N = \frac{h\,(T_w - T_b)}{L_v}",
    typical={
        "wall_temperature": (340.0, 390.0),
        "boiling_temperature": (300.0, 330.0),
        "heat_transfer_coefficient": (20.0, 300.0),
    },
    title="Vacuum contact drying, boiling product",
    output="drying_flux",
)
def drying_flux_boiling(
    heat_transfer_coefficient: HeatTransferCoefficient,
    wall_temperature: Temperature,
    boiling_temperature: Temperature,
    heat_of_vaporization: SpecificEnergy = 2.4e6,
) -> SignedMassFlux:
    """Evaporation flux of a product that boils on a heated wall, as under vacuum or in superheated steam.

    >>> drying_flux_boiling(60.0, 340.0, 300.0)
    0.001
    """
    return heat_transfer_coefficient * (wall_temperature - boiling_temperature) / heat_of_vaporization
