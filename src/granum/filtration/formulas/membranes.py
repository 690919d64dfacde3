"""Membrane filtration: flux by resistances or permeance, osmotic pressure, rejection, concentration
polarization, a batch.
"""

from __future__ import annotations

from typing import Any

import jax.numpy as jnp

from granum.core import formula, impossible, limit_active
from granum.core.constants import GAS_CONSTANT
from granum.core.kinds import (
    Area,
    Concentration,
    DynamicViscosity,
    Fraction,
    MassTransferCoefficient,
    MediumResistance,
    MolarConcentration,
    Permeance,
    PositiveNumber,
    Pressure,
    PressureDrop,
    Speed,
    Temperature,
    VolumeFlow,
)

_MEMBRANE = {"medium_resistance": (1e11, 1e13), "pressure_drop": (5e4, 1e6), "osmotic_pressure": (0.0, 4e4)}
BELOW_OSMOTIC = "The pressure does not exceed the osmotic pressure: no permeate flows."


def _driving(pressure_drop: Any, osmotic_pressure: Any) -> Any:
    driving = jnp.asarray(pressure_drop) - osmotic_pressure
    limit_active(driving <= 0.0, pressure_drop, "pressure_drop", BELOW_OSMOTIC)
    return jnp.maximum(driving, 0.0)


@formula(
    source="cheryan1998",
    title="Flux of a membrane, resistances in series",
    equation=r"J = \frac{\Delta p - \Delta\pi}{\eta\,(R_m + R_c + R_f)}",
    typical=_MEMBRANE,
    output="filtrate_flux",
    symbols={"medium_resistance": "R_m", "filtrate_flux": "J"},
)
def filtrate_flux_membrane(
    pressure_drop: PressureDrop,
    dynamic_viscosity: DynamicViscosity,
    medium_resistance: MediumResistance,
    cake_layer_resistance: MediumResistance = 0.0,
    fouling_resistance: MediumResistance = 0.0,
    osmotic_pressure: Pressure = 0.0,
) -> Speed:
    """Permeate flux of a membrane: transmembrane pressure less osmotic pressure over resistances in series.

    >>> round(
    ...     filtrate_flux_membrane("1 bar", "1 cP", medium_resistance=1e12, fouling_resistance=1e12) * 3.6e6,
    ...     6,
    ... )
    180.0
    """
    total = medium_resistance + cake_layer_resistance + fouling_resistance
    return _driving(pressure_drop, osmotic_pressure) / (dynamic_viscosity * total)


@formula(
    source="wijmans1995",
    title="Flux of a membrane from its permeance",
    equation=r"J = A_w\,(\Delta p - \Delta\pi)",
    output="filtrate_flux",
    typical={"pressure_drop": (1e6, 6e6)},
    symbols={"filtrate_flux": "J"},
)
def filtrate_flux_permeance(
    pressure_drop: PressureDrop, membrane_permeance: Permeance, osmotic_pressure: Pressure = 0.0
) -> Speed:
    """Permeate flux of a reverse osmosis or nanofiltration membrane of known permeance.

    A permeance by mass of water is divided by the density of water.

    >>> round(filtrate_flux_permeance("30 bar", "2 L/(m^2 hour bar)", osmotic_pressure="5 bar") * 3.6e6, 6)
    50.0
    """
    return membrane_permeance * _driving(pressure_drop, osmotic_pressure)


@formula(
    source="vanthoff1887",
    equation=r"\pi = i\,c\,R\,T",
    output="osmotic_pressure",
    symbols={"osmotic_pressure": r"\pi"},
)
def osmotic_pressure(
    solute_molar_concentration: MolarConcentration,
    dissociation_number: PositiveNumber = 1.0,
    temperature: Temperature = 298.15,
) -> Pressure:
    """Osmotic pressure of a dilute solution against its solvent (van 't Hoff).

    The dissociation number counts the ions or molecules that a dissolved formula gives: 1 for sugar, 2 for
    NaCl.

    >>> round(osmotic_pressure("0.1 mol/L", dissociation_number=2.0) / 1e5, 3)
    4.958
    """
    return dissociation_number * solute_molar_concentration * GAS_CONSTANT * temperature


@formula(
    source="wijmans1995",
    title="Rejection by solution and diffusion",
    equation=r"R = \frac{J}{J + B}",
    output="rejection",
    typical={"filtrate_flux": (2e-6, 3e-5)},
    symbols={"filtrate_flux": "J"},
)
def rejection_solution_diffusion(filtrate_flux: Speed, solute_permeability: Speed) -> Fraction:
    """Rejection of a dense membrane: solute passes at its own rate whatever the pressure, so that more flux
    dilutes it.

    >>> round(rejection_solution_diffusion(filtrate_flux=1.9e-5, solute_permeability=1e-6), 6)
    0.95
    """
    total = filtrate_flux + solute_permeability
    return jnp.where(total > 0, filtrate_flux / jnp.where(total > 0, total, 1.0), 0.0)


@formula(
    source="cheryan1998",
    title="Limiting flux of a membrane",
    equation=r"J = k\,\ln\frac{c_g - c_p}{c_b - c_p}",
    output="filtrate_flux",
    typical={
        "concentration_gel": (200.0, 400.0),
        "concentration_bulk": (5.0, 100.0),
        "concentration_permeate": (0.0, 1.0),
        "mass_transfer_coefficient": (1e-6, 1e-5),
    },
    symbols={
        "mass_transfer_coefficient": "k",
        "concentration_gel": "c_g",
        "concentration_bulk": "c_b",
        "filtrate_flux": "J",
        "concentration_permeate": "c_p",
    },
)
def filtrate_flux_limiting(
    mass_transfer_coefficient: MassTransferCoefficient,
    concentration_gel: Concentration,
    concentration_bulk: Concentration,
    concentration_permeate: Concentration = 0.0,
) -> Speed:
    """Limiting flux under concentration polarization, by the film model: no pressure gives more.

    >>> round(filtrate_flux_limiting(1e-5, concentration_gel=300, concentration_bulk=30) * 1e5, 4)
    2.3026
    """
    impossible(
        ~(concentration_permeate < concentration_bulk),
        concentration_permeate,
        "concentration_permeate",
        0.0,
        concentration_bulk,
    )
    ratio = (concentration_gel - concentration_permeate) / jnp.maximum(
        concentration_bulk - concentration_permeate, 1e-300
    )
    return mass_transfer_coefficient * jnp.log(jnp.maximum(ratio, 1.0))


@formula(
    source="cheryan1998",
    title="Concentration of a retentate, batch",
    equation=r"c = c_0\,\mathrm{VCF}^{R}",
    output="concentration",
    typical={
        "concentration_inlet": (1.0, 50.0),
        "rejection": (0.5, 1.0),
        "volume_concentration_factor": (1.5, 20.0),
    },
    symbols={"concentration_inlet": "c_0"},
)
def concentration_retentate_batch(
    concentration_inlet: Concentration, volume_concentration_factor: PositiveNumber, rejection: Fraction
) -> Concentration:
    """Retentate concentration of a batch reduced in volume by a factor, at constant rejection.

    >>> round(
    ...     concentration_retentate_batch(
    ...         concentration_inlet=10, volume_concentration_factor=10, rejection=1.0
    ...     ),
    ...     6,
    ... )
    100.0
    """
    return concentration_inlet * volume_concentration_factor**rejection


@formula(
    source="cheryan1998",
    title="Membrane area",
    equation=r"A = \frac{q}{J}",
    typical={"filtrate_flux": (5e-6, 5e-5)},
    output="filtration_area",
    symbols={"filtration_area": "A", "filtrate_flux": "J"},
)
def filtration_area_membrane(filtrate_flow: VolumeFlow, filtrate_flux: Speed) -> Area:
    """Membrane area for a permeate flow at a mean flux.

    >>> round(filtration_area_membrane(filtrate_flow="1 m^3/hour", filtrate_flux=1e-5), 3)
    27.778
    """
    return filtrate_flow / filtrate_flux
