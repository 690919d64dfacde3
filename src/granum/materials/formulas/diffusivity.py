"""Diffusivity of a vapor in a gas, and the Lewis number that goes with it."""

from __future__ import annotations

from granum.core import formula
from granum.core.constants import STANDARD_ATMOSPHERE
from granum.core.kinds import (
    Density,
    Diffusivity,
    HeatCapacity,
    MolarMass,
    PositiveNumber,
    Pressure,
    Temperature,
    ThermalConductivity,
)

_GAS = {
    "diffusivity": (5e-6, 3e-5),
    "gas_density": (0.8, 1.5),
    "thermal_conductivity": (0.02, 0.04),
    "specific_heat_capacity": (900.0, 1100.0),
}


@formula(
    source="poling2001, eq. 11-4.4; fuller1969",
    equation=(
        r"D = \frac{0.00143\,T^{1.75}}{p\,M_{12}^{1/2}\left(v_1^{1/3} + "
        r"v_2^{1/3}\right)^2}\ \mathrm{cm^2/s},\quad M_{12} = \frac{2}{1/M_1 + 1/M_2}"
    ),
    typical={
        "molar_mass_vapor": (0.018, 0.1),
        "molar_mass_gas": (0.028, 0.044),
        "temperature": (280.0, 500.0),
    },
    symbols={
        "molar_mass_vapor": "M_1",
        "diffusion_volume_vapor": "v_1",
        "molar_mass_gas": "M_2",
        "diffusion_volume_gas": "v_2",
    },
)
def diffusivity_fuller(
    temperature: Temperature,
    molar_mass_vapor: MolarMass,
    diffusion_volume_vapor: PositiveNumber,
    molar_mass_gas: MolarMass = 0.0289586,
    diffusion_volume_gas: PositiveNumber = 19.7,
    pressure: Pressure = STANDARD_ATMOSPHERE,
) -> Diffusivity:
    """Diffusivity of one gas in another at low pressure, from molar masses and diffusion volumes (sums of
    atomic ones, cm³/mol).

    The gas is dry air unless told otherwise. Mean error about 4 % for non-polar pairs, up to 15 % for
    strongly polar ones.

    >>> round(diffusivity_fuller("25 degC", "18.015 g/mol", 13.1, pressure="1 atm") * 1e4, 2)
    0.25
    """
    T, p = temperature, pressure / 1e5
    mean = 2.0 / (1.0 / (1e3 * molar_mass_vapor) + 1.0 / (1e3 * molar_mass_gas))
    size = diffusion_volume_vapor ** (1 / 3) + diffusion_volume_gas ** (1 / 3)
    return 1e-4 * 0.00143 * T**1.75 / (p * mean**0.5 * size**2)


@formula(
    source="marrero1972, table 13",
    equation=r"D = 1.87\times10^{-10}\,\frac{T^{2.072}}{p}\ (\mathrm{m^2/s},\ p\text{ in }\mathrm{atm})",
    fitted={"temperature": (282.0, 450.0)},
)
def diffusivity_marrero_mason(
    temperature: Temperature, pressure: Pressure = STANDARD_ATMOSPHERE
) -> Diffusivity:
    """Diffusivity of water vapor in air, correlation of the measurements, within about 5 %.

    >>> round(diffusivity_marrero_mason("25 degC") * 1e4, 2)
    0.25
    """
    return 1.87e-10 * temperature**2.072 / (pressure / STANDARD_ATMOSPHERE)


@formula(source="poling2001, ch. 11", equation=r"\mathrm{Le} = \frac{\lambda}{\rho_g c_p D}", typical=_GAS)
def lewis_number(
    thermal_conductivity: ThermalConductivity,
    gas_density: Density,
    specific_heat_capacity: HeatCapacity,
    diffusivity: Diffusivity,
) -> PositiveNumber:
    """Lewis number: thermal diffusivity of a gas over the diffusivity of a vapor in it.

    About 0.85 for water in air, 1.5 to 2.7 for organic vapors in air: there the wet-bulb and adiabatic
    saturation temperatures differ.

    >>> round(lewis_number(0.0262, 1.18, 1006.0, 2.5e-5), 2)
    0.88
    """
    return thermal_conductivity / (gas_density * specific_heat_capacity * diffusivity)
