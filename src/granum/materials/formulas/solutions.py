"""Density, viscosity and heat capacity of aqueous solutions: the models of Laliberté."""

from __future__ import annotations

from typing import Annotated, Any

import jax.numpy as jnp

from granum.core import formula
from granum.core.constants import ZERO_CELSIUS
from granum.core.kinds import (
    Density,
    DynamicViscosity,
    HeatCapacity,
    Kind,
    MassFraction,
    MolarConcentration,
    Number,
    Series,
    Temperature,
)
from granum.materials.formulas.water import water_density, water_heat_capacity
from granum.materials.formulas.water_transport import water_viscosity

Coefficients = Annotated[Number, Series("coefficients")]
ViscosityCoefficient = Annotated[
    Any, Kind("viscosity coefficient of a solute", "m^3/mol", display=("L/mol", "m^3/mol"))
]
DILUTE = 1000.0  # mol/m³


def _solute(mass_fraction: Any) -> Any:
    """The mass fraction, kept off zero where its powers would have an infinite slope."""
    return jnp.maximum(mass_fraction, 1e-9)


@formula(
    source="laliberte2004, eq. 5 and 9; laliberte2009, table 2",
    equation=(
        r"\rho_l = \left[\frac{1-x}{\rho_w} + x\,\frac{x + c_3 + c_4 t}{(c_1 x + c_2)\,e^{10^{-6}(t + "
        r"c_5)^2}}\right]^{-1},\quad t = T - 273.15\,\mathrm K"
    ),
    output="liquid_density",
    title="Density of an aqueous solution (Laliberté–Cooper)",
    fitted={"temperature": (273.15, 413.15), "solute_mass_fraction": (0.0, 0.79)},
)
def liquid_density_laliberte(
    temperature: Temperature, solute_mass_fraction: MassFraction, coefficients: Coefficients
) -> Density:
    """Density of an aqueous solution from the apparent density of the solute; t is in degrees Celsius.

    Within about 0.1 % of the data it was fitted to. Differs from the print: water's own density is that of
    IAPWS-IF97. The data of the solutes kept here end at 140 °C and at a mass fraction of 0.79; those of one
    solute may end before.

    >>> potassium_chloride = [
    ...     -0.855928945959145,
    ...     6.04073571306402,
    ...     2.81787416217166,
    ...     0.0253924645877338,
    ...     2681.61723465886,
    ... ]
    >>> round(liquid_density_laliberte("20 degC", 0.10, potassium_chloride), 0)
    1063.0
    """
    c, w, t = jnp.asarray(coefficients), _solute(solute_mass_fraction), temperature - ZERO_CELSIUS
    apparent_volume = (w + c[2] + c[3] * t) / ((c[0] * w + c[1]) * jnp.exp(1e-6 * (t + c[4]) ** 2))
    return 1.0 / ((1.0 - w) / water_density(temperature) + w * apparent_volume)


@formula(
    source="laliberte2007, eq. 8 and 12; laliberte2009, table 3",
    equation=(
        r"\eta = \eta_w^{1-x}\,\eta_s^{x},\quad \eta_s = \frac{\exp\left(\frac{c_1 x^{c_2} + c_3}{c_4 t "
        r"+ 1}\right)}{c_5 x^{c_6} + 1}\ \mathrm{mPa\,s},\quad t = T - 273.15\,\mathrm K"
    ),
    output="dynamic_viscosity",
    title="Viscosity of an aqueous solution (Laliberté)",
    fitted={"temperature": (273.15, 427.15), "solute_mass_fraction": (0.0, 0.79)},
)
def dynamic_viscosity_laliberte(
    temperature: Temperature, solute_mass_fraction: MassFraction, coefficients: Coefficients
) -> DynamicViscosity:
    """Viscosity of an aqueous solution by geometric mixing of water and solute; t is in degrees Celsius.

    Within about 3 % of the data it was fitted to. Differs from the print: water's own viscosity is that of
    IAPWS 2008. The data of the solutes kept here end at 154 °C and at a mass fraction of 0.79; those of one
    solute may end before.

    >>> sodium_chloride = [
    ...     16.221788633396,
    ...     1.32293086770011,
    ...     1.48485985010431,
    ...     0.00746912559657377,
    ...     30.7802007540575,
    ...     2.05826852322558,
    ... ]
    >>> round(dynamic_viscosity_laliberte("20 degC", 0.10, sodium_chloride) * 1e3, 2)
    1.19
    """
    v, w, t = jnp.asarray(coefficients), _solute(solute_mass_fraction), temperature - ZERO_CELSIUS
    log_solute = (
        (v[0] * w ** v[1] + v[2]) / (v[3] * t + 1.0) - jnp.log(v[4] * w ** v[5] + 1.0) + jnp.log(1e-3)
    )
    return jnp.exp((1.0 - w) * jnp.log(water_viscosity(temperature)) + w * log_solute)


@formula(
    source="genotelle1978; mathlouthi1995, ch. 6",
    equation=(
        r"\log_{10}\frac{\eta}{\mathrm{mPa\,s}} = 22.46\,N - 0.114 + \frac{30 - t}{91 + t}\left(1.1 + "
        r"43.1\,N^{1.25}\right),\quad N = \frac{x}{19 - 18\,x},\quad t = T - 273.15\,\mathrm K"
    ),
    output="dynamic_viscosity",
    title="Viscosity of a sucrose solution (Génotelle)",
    fitted={"temperature": (273.15, 363.15), "solute_mass_fraction": (0.0, 0.86)},
    typical={"temperature": (293.15, 353.15), "solute_mass_fraction": (0.3, 0.8)},
)
def dynamic_viscosity_genotelle(
    temperature: Temperature, solute_mass_fraction: MassFraction
) -> DynamicViscosity:
    """Viscosity of a sucrose solution from its mole fraction, also of thick syrups.

    N is the mole fraction of sucrose, of 19 times the molar mass of water; meant for syrups, as water alone
    comes out a few percent off. Recalled as Mathlouthi and Reiser quote it, the print was not opened; the
    ranges are those of the tables of the sugar industry, recalled too.

    Syrup with 65 % of sucrose at 40 °C: 44.4 mPa s in the tables.

    >>> round(1e3 * dynamic_viscosity_genotelle("40 degC", 0.65), 1)
    43.8
    """
    w, t = _solute(solute_mass_fraction), temperature - ZERO_CELSIUS
    N = w / (19.0 - 18.0 * w)
    decades = 22.46 * N - 0.114 + (30.0 - t) / (91.0 + t) * (1.1 + 43.1 * N**1.25)
    return 1e-3 * 10.0**decades


@formula(
    source="jones1929; einstein1906",
    equation=r"\eta = \eta_0\,e^{B c}",
    output="dynamic_viscosity",
    title="Viscosity of a dilute solution (Jones–Dole)",
    fitted={"solute_molar_concentration": (0.0, DILUTE)},
)
def dynamic_viscosity_jones_dole(
    solvent_viscosity: DynamicViscosity,
    solute_molar_concentration: MolarConcentration,
    jones_dole_coefficient: ViscosityCoefficient,
) -> DynamicViscosity:
    """Viscosity of a solution from Jones and Dole's coefficient, the sum of those of its ions.

    The exponential begins as the law 1 + Bc and never turns negative. Ions that order water thicken it
    (sodium, sulfate), large ones of one charge thin it (potassium, iodide). A solute of which no B is known
    is taken for spheres in Einstein's sense, B = 2.5 V with its molar volume: an estimate, half of what
    sugars and organic acids do. Beyond 1 mol/L solutions thicken faster than this. The term in √c, below 2
    % there, is left out.

    Sodium chloride of 1 mol/L at 25 °C, 0.0793 L/mol: 0.97 mPa s is measured.

    >>> round(1e3 * dynamic_viscosity_jones_dole("0.890 mPa s", "1 mol/L", "0.0793 L/mol"), 2)
    0.96
    """
    return solvent_viscosity * jnp.exp(jones_dole_coefficient * solute_molar_concentration)


@formula(
    source="laliberte2009, eq. 8–10, table 4",
    equation=(
        r"c_p = (1-x)\,c_{p,w} + x\left[c_1 e^{\alpha} + c_5 x^{c_6}\right],\quad \alpha = c_2 t + c_3 "
        r"e^{0.01 t} + c_4 x,\quad t = T - 273.15\,\mathrm K"
    ),
    output="specific_heat_capacity",
    title="Heat capacity of an aqueous solution (Laliberté)",
    fitted={"temperature": (273.15, 414.0), "solute_mass_fraction": (0.0, 0.65)},
)
def specific_heat_capacity_laliberte(
    temperature: Temperature, solute_mass_fraction: MassFraction, coefficients: Coefficients
) -> HeatCapacity:
    """Heat capacity of an aqueous solution from the apparent heat capacity of the solute; t is in degrees
    Celsius.

    Within about 1 % of the data it was fitted to. Differs from the print: water's own heat capacity is that
    of IAPWS-IF97. The data of the solutes kept here end at 140 °C and at a mass fraction of 0.64; those of
    one solute may end before.

    >>> sodium_chloride = [
    ...     -0.0693559668993322,
    ...     -0.0782134167486952,
    ...     3.84798479408635,
    ...     -11.2762109247072,
    ...     8.73187698542672,
    ...     1.81245930472755,
    ... ]
    >>> round(specific_heat_capacity_laliberte("25 degC", 0.10, sodium_chloride) / 1e3, 1)
    3.7
    """
    a, w, t = jnp.asarray(coefficients), _solute(solute_mass_fraction), temperature - ZERO_CELSIUS
    alpha = a[1] * t + a[2] * jnp.exp(0.01 * t) + a[3] * w
    return (1.0 - w) * water_heat_capacity(temperature) + w * 1e3 * (a[0] * jnp.exp(alpha) + a[4] * w ** a[5])
