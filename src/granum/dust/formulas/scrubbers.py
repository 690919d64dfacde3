"""Venturi scrubbers: drops, impaction, collection, pressure drop."""

from __future__ import annotations

from typing import Annotated

import jax.numpy as jnp

from granum.core import formula
from granum.core.kinds import (
    Density,
    DynamicViscosity,
    Fraction,
    Length,
    PositiveNumber,
    PressureDrop,
    Ratio,
    Speed,
    Within,
)

FOOT, GALLON = 0.3048, 3.785411784e-3  # m, m³
PER_THOUSAND = GALLON / (1e3 * FOOT**3)  # of 1 gal per 1000 ft³, as a ratio of volumes
LiquidToGas = Annotated[Ratio, Within(0.0, 0.1)]
_TYPICAL = {"throat_velocity": (40.0, 120.0), "liquid_to_gas": (5e-4, 2e-3)}


@formula(
    source="nukiyama1939; theodore2012, p. 15.7",
    equation=r"d = \frac{16\,400}{v} + 1.45\left(\frac{Q_l}{Q_g}\right)^{1.5}",
    fitted={"throat_velocity": (30.0, 150.0), "liquid_to_gas": (2e-4, 3e-3)},
    typical=_TYPICAL,
    output="droplet_diameter",
    title="Drops of water in the throat of a venturi",
)
def droplet_diameter_venturi(throat_velocity: Speed, liquid_to_gas: LiquidToGas) -> Length:
    """Sauter diameter of drops of water torn off by air, in the print's µm, ft/s and gal per 1000 ft³.

    The handbook's example: 272 ft/s and 8.5 gal per 1000 ft³ give 96.23 µm.

    >>> round(droplet_diameter_venturi("272 ft/s", 8.5 * 1.336806e-4) * 1e6, 1)
    96.2
    """
    v, q = throat_velocity / FOOT, liquid_to_gas / PER_THOUSAND
    return 1e-6 * (16400.0 / v + 1.45 * q**1.5)


@formula(
    source="johnstone1954; theodore2012, p. 15.7",
    equation=r"\psi = \frac{C_c\,\rho_p\,d_p^2\,v}{9\,\eta\,d}",
    typical=_TYPICAL | {"droplet_diameter": (3e-5, 2e-4), "slip_factor": (1.0, 3.0)},
    title="Inertial impaction number",
)
def impaction_number(
    particle_diameter: Length,
    particle_density: Density,
    throat_velocity: Speed,
    dynamic_viscosity: DynamicViscosity,
    droplet_diameter: Length,
    slip_factor: Annotated[PositiveNumber, Within(1.0, 1e4)] = 1.0,
) -> Ratio:
    """Stopping distance of a particle over the radius of a drop; the viscosity is that of the gas.

    The handbook's example: 3.002 at 1 µm, with 43.7 lb/ft³, 272 ft/s, 1.5e-5 lb/(ft s) and 96.23 µm.

    >>> round(impaction_number("1 um", 43.7 * 16.01846, "272 ft/s", 1.5e-5 * 1.488164, "96.3168 um"), 2)
    3.0
    """
    return (
        slip_factor
        * particle_density
        * particle_diameter**2
        * throat_velocity
        / (9.0 * dynamic_viscosity * droplet_diameter)
    )


@formula(
    source="johnstone1954; theodore2012, p. 15.7",
    equation=r"E = 1 - \exp\left(-k\,\frac{Q_l}{Q_g}\,\sqrt\psi\right)",
    fitted={"johnstone_constant": (740.0, 1500.0)},
    typical=_TYPICAL | {"impaction_number": (0.5, 100.0), "johnstone_constant": (800.0, 1450.0)},
    output="grade_efficiency",
    title="Grade efficiency of a venturi scrubber (Johnstone)",
)
def grade_efficiency_johnstone(
    impaction_number: Ratio, liquid_to_gas: LiquidToGas, johnstone_constant: PositiveNumber = 1500.0
) -> Fraction:
    """Share of a particle size caught by the drops.

    The constant is 0.1 to 0.2 (1000 ft³/gal) for a throat, half as much to as much as the default by volume.

    The handbook's example: 8.5 gal per 1000 ft³ with 0.2 at an impaction number of 3.002 leave exp(−2.94).

    >>> round(grade_efficiency_johnstone(3.002, 8.5 * 1.336806e-4, 0.2 / 1.336806e-4), 3)
    0.947
    """
    return -jnp.expm1(-johnstone_constant * liquid_to_gas * jnp.sqrt(jnp.maximum(impaction_number, 1e-300)))


@formula(
    source="calvert1970",
    equation=r"\Delta p = \beta\,\rho_l\,v^2\,\frac{Q_l}{Q_g}",
    typical=_TYPICAL | {"momentum_share": (0.8, 1.0)},
    output="pressure_drop",
    title="Pressure drop of a venturi scrubber (Calvert)",
)
def pressure_drop_venturi(
    throat_velocity: Speed,
    liquid_to_gas: LiquidToGas,
    liquid_density: Density,
    momentum_share: Annotated[PositiveNumber, Within(0.01, 2.0)] = 1.0,
) -> PressureDrop:
    """Pressure that the gas spends on bringing the drops to its own speed; the share is of that speed reached
    in the throat.

    Calvert's simplified form, 1e-6 v² L in cm of water with cm/s and L/m³, prints 187.2 for 120 m/s and 1.3
    L/m³; all of the momentum is 190.9.

    >>> round(pressure_drop_venturi("120 m/s", 1.3e-3, 1000.0) / 98.0665, 1)
    190.9
    """
    return momentum_share * liquid_density * throat_velocity**2 * liquid_to_gas
