"""Gas through a bed, isothermal and ideal: density falls along the bed, the mass flux does not."""

from __future__ import annotations

from typing import Any

import jax.numpy as jnp

from granum.core import formula, impossible, unconverged
from granum.core.constants import GAS_CONSTANT
from granum.core.kinds import (
    DynamicViscosity,
    Length,
    MassFlux,
    MolarMass,
    Permeability,
    PressureDrop,
    Speed,
    Sphericity,
    Temperature,
    VoidFraction,
)
from granum.numerics import find_root
from granum.porous.formulas.inverse import BedLaw
from granum.porous.formulas.packed_beds import pressure_gradient_ergun

CHOKED = "The gas chokes: its pressure falls to zero before the end of the bed."


@formula(
    source="darcy1856; muskat1937",
    title="Permeability measured with a gas",
    equation=r"B = \frac{2\eta L U_2 p_2}{p_1^2 - p_2^2}",
    typical={
        "pressure_inlet": (1.2e5, 5e5),
        "pressure_outlet": (9e4, 1.1e5),
        "dynamic_viscosity": (1e-5, 3e-5),
    },
    symbols={"superficial_velocity": "U_2"},
)
def permeability_gas(
    superficial_velocity: Speed,
    pressure_inlet: PressureDrop,
    pressure_outlet: PressureDrop,
    dynamic_viscosity: DynamicViscosity,
    length: Length,
) -> Permeability:
    """Permeability of a layer from a gas flow in creeping motion; the velocity is that at the outlet
    pressure.

    No value when the inlet pressure is not the higher one.

    >>> permeability_gas(
    ...     superficial_velocity=0.01,
    ...     pressure_inlet=2e5,
    ...     pressure_outlet=1e5,
    ...     dynamic_viscosity=1.8e-5,
    ...     length=0.05,
    ... )
    6.0...e-14
    """
    difference = pressure_inlet**2 - pressure_outlet**2
    driven = difference > 0.0
    impossible(~driven, pressure_outlet, "pressure_outlet", 0.0, pressure_inlet)
    B = (
        2.0
        * dynamic_viscosity
        * length
        * superficial_velocity
        * pressure_outlet
        / jnp.where(driven, difference, 1.0)
    )
    return jnp.where(driven, B, jnp.nan)


def _resistance(G: Any, d: Any, e: Any, eta: Any, psi: Any, law: Any) -> Any:
    """ρ·dp/dz at a mass flux: the same all along the bed, because the Reynolds number is."""
    return law(G, d, e, 1.0, eta, psi)


@formula(
    source="ergun1952; bird2002, section 6.4",
    title="Outlet pressure of gas through a bed",
    equation=r"p_2^2 = p_1^2 - \frac{2RTL}{M}\,\rho\frac{\mathrm dp}{\mathrm dz}(G, d_p, \varepsilon, \eta)",
    typical={
        "mass_flux": (0.01, 0.5),
        "pressure_inlet": (2e5, 5e5),
        "length": (0.1, 1.0),
        "particle_diameter": (1e-3, 5e-3),
        "dynamic_viscosity": (1e-5, 3e-5),
    },
)
def pressure_outlet_gas_bed(
    mass_flux: MassFlux,
    pressure_inlet: PressureDrop,
    temperature: Temperature,
    molar_mass: MolarMass,
    dynamic_viscosity: DynamicViscosity,
    length: Length,
    particle_diameter: Length,
    void_fraction: VoidFraction,
    sphericity: Sphericity = 1.0,
    pressure_gradient: BedLaw = pressure_gradient_ergun,
) -> PressureDrop:
    """Outlet pressure of an ideal gas through a packed bed at constant temperature, under any law.

    Acceleration of the gas is left out: good while the outlet speed in the pores is well below that of sound.
    When the bed needs more than the inlet pressure there is no value.

    >>> round(
    ...     pressure_outlet_gas_bed(
    ...         mass_flux=0.5,
    ...         pressure_inlet="2 bar",
    ...         temperature="20 degC",
    ...         molar_mass="29 g/mol",
    ...         dynamic_viscosity=1.8e-5,
    ...         length=1.0,
    ...         particle_diameter="2 mm",
    ...         void_fraction=0.4,
    ...     )
    ... )
    198333
    """
    drop = _resistance(
        mass_flux, particle_diameter, void_fraction, dynamic_viscosity, sphericity, pressure_gradient
    )
    square = pressure_inlet**2 - 2.0 * GAS_CONSTANT * temperature / molar_mass * length * drop
    possible = square > 0.0
    impossible(~possible, mass_flux, "mass_flux", reason=CHOKED)
    return jnp.where(possible, jnp.sqrt(jnp.where(possible, square, 1.0)), jnp.nan)


@formula(
    source="ergun1952; bird2002, section 6.4",
    title="Mass flux of gas through a bed",
    equation=r"\rho\frac{\mathrm dp}{\mathrm dz}(G, d_p, \varepsilon, \eta) = \frac{(p_1^2 - p_2^2)M}{2RTL}",
    typical={
        "pressure_inlet": (1.5e5, 5e5),
        "pressure_outlet": (9e4, 1.4e5),
        "length": (0.1, 1.0),
        "dynamic_viscosity": (1e-5, 3e-5),
    },
)
def mass_flux_gas_bed(
    pressure_inlet: PressureDrop,
    pressure_outlet: PressureDrop,
    temperature: Temperature,
    molar_mass: MolarMass,
    dynamic_viscosity: DynamicViscosity,
    length: Length,
    particle_diameter: Length,
    void_fraction: VoidFraction,
    sphericity: Sphericity = 1.0,
    pressure_gradient: BedLaw = pressure_gradient_ergun,
) -> MassFlux:
    """Mass flux of an ideal gas through a packed bed between two pressures at constant temperature, under any
    law.

    >>> round(
    ...     mass_flux_gas_bed(
    ...         pressure_inlet="2 bar",
    ...         pressure_outlet=198333.0,
    ...         temperature="20 degC",
    ...         molar_mass="29 g/mol",
    ...         dynamic_viscosity=1.8e-5,
    ...         length=1.0,
    ...         particle_diameter="2 mm",
    ...         void_fraction=0.4,
    ...     ),
    ...     3,
    ... )
    0.5
    """
    d, e, eta = sphericity * particle_diameter, void_fraction, dynamic_viscosity
    difference = pressure_inlet**2 - pressure_outlet**2
    driven = difference > 0.0
    impossible(~driven, pressure_outlet, "pressure_outlet", 0.0, pressure_inlet)
    wanted = jnp.where(driven, difference, 1.0) * molar_mass / (2.0 * GAS_CONSTANT * temperature * length)
    creeping = wanted * e**3 * d**2 / (150.0 * eta * (1.0 - e) ** 2)
    turbulent = jnp.sqrt(wanted * e**3 * d / (1.75 * (1.0 - e)))
    start = jnp.log(1.0 / (1.0 / creeping + 1.0 / turbulent))

    def balance(y: Any) -> Any:
        return jnp.log(
            _resistance(jnp.exp(y), particle_diameter, e, eta, sphericity, pressure_gradient)
        ) - jnp.log(wanted)

    root = find_root(balance, start - 12.0, start + 12.0, start=start)
    unconverged(root.converged | ~driven)
    G = jnp.exp(root.value)
    _resistance(G, particle_diameter, e, eta, sphericity, pressure_gradient)
    return jnp.where(driven, G, jnp.nan)
