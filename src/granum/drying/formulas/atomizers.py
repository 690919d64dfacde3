"""Drop sizes of atomizers: pressure nozzles, rotating wheels and two-fluid nozzles."""

from __future__ import annotations

from math import pi
from typing import Annotated

import jax.numpy as jnp

from granum.core import formula, impossible
from granum.core.constants import HOUR, RPM
from granum.core.kinds import (
    Density,
    DynamicViscosity,
    Length,
    MassFlow,
    MassRatio,
    PositiveNumber,
    PressureDifference,
    RotationSpeed,
    SpecificEnergy,
    Speed,
    SurfaceTension,
    TemperatureDifference,
    ThermalConductivity,
    Time,
    Within,
)

MICRON = 1e-6
FEED = {"density": (1000.0, 1300.0), "surface_tension": (0.04, 0.073), "dynamic_viscosity": (1e-3, 0.05)}


@formula(
    source="elkotb1982",
    equation=(
        r"d_{32} = 3.08\,\nu^{0.385}(\sigma\rho)^{0.737}\rho_g^{0.06}\,\Delta p^{-0.54},\quad \nu = "
        r"\eta/\rho"
    ),
    typical=FEED | {"pressure_difference": (2e6, 3e7), "gas_density": (0.7, 1.2)},
    output="droplet_diameter",
    title="Drops of a pressure nozzle (Elkotb)",
    symbols={"droplet_diameter": "d_{32}", "pressure_difference": r"\Delta p"},
)
def droplet_diameter_elkotb(
    pressure_difference: PressureDifference,
    density: Density,
    dynamic_viscosity: DynamicViscosity,
    surface_tension: SurfaceTension,
    gas_density: Density = 1.2,
) -> Length:
    """Sauter mean diameter of drops from a plain pressure nozzle, all in SI units.

    By hand, water at 5 MPa: 3.08 · (1e-6)^0.385 · 72^0.737 · 1.011 · (5e6)^−0.54 = 86 µm.

    >>> round(droplet_diameter_elkotb("5 MPa", 1000.0, 1e-3, 0.072) * 1e6)
    86
    """
    nu = dynamic_viscosity / density
    return (
        3.08
        * nu**0.385
        * (surface_tension * density) ** 0.737
        * gas_density**0.06
        * jnp.maximum(pressure_difference, 1.0) ** -0.54
    )


@formula(
    source="lefebvre1989, ch. 6",
    equation=r"d_{32} = 2.25\,\sigma^{0.25}\eta^{0.25}\dot m^{0.25}\Delta p^{-0.5}\rho_g^{-0.25}",
    typical=FEED | {"pressure_difference": (2e6, 3e7), "gas_density": (0.7, 1.2), "mass_flow": (0.01, 1.0)},
    output="droplet_diameter",
    title="Drops of a pressure-swirl nozzle (Lefebvre)",
    symbols={"droplet_diameter": "d_{32}", "pressure_difference": r"\Delta p"},
)
def droplet_diameter_lefebvre(
    pressure_difference: PressureDifference,
    mass_flow: MassFlow,
    dynamic_viscosity: DynamicViscosity,
    surface_tension: SurfaceTension,
    gas_density: Density = 1.2,
) -> Length:
    """Sauter mean diameter of drops from a pressure-swirl nozzle, all in SI units.

    By hand, water at 5 MPa and 0.1 kg/s: 2.25 · 0.518 · 0.1778 · 0.5623 · 4.47e-4 · 0.955 = 49.8 µm.

    >>> round(droplet_diameter_lefebvre("5 MPa", 0.1, 1e-3, 0.072) * 1e6, 1)
    49.8
    """
    drive = jnp.maximum(pressure_difference, 1.0) ** -0.5 * gas_density**-0.25
    return 2.25 * (surface_tension * dynamic_viscosity * mass_flow) ** 0.25 * drive


@formula(
    source="masters1991",
    equation=(
        r"d_{32} = 1.4\times 10^{4}\,\frac{\dot m^{0.24}}{(N D)^{0.83}(n b)^{0.12}}\ \mathrm{\mu "
        r"m},\quad \dot m\text{ in }\mathrm{kg/h},\ N = \frac{\omega}{2\pi}\text{ in }\mathrm{rpm}"
    ),
    typical={
        "mass_flow": (0.05, 3.0),
        "rotation_speed": (800.0, 2000.0),
        "diameter": (0.1, 0.3),
        "vane_height": (5e-3, 4e-2),
    },
    output="droplet_diameter",
    title="Drops of an atomizer wheel (Masters)",
    symbols={"droplet_diameter": "d_{32}"},
)
def droplet_diameter_masters(
    mass_flow: MassFlow,
    rotation_speed: RotationSpeed,
    diameter: Length,
    vane_height: Length,
    vane_count: PositiveNumber = 24.0,
) -> Length:
    """Sauter mean diameter of drops from a vaned wheel; mass flow of feed in kg/h and meters in the print.

    By hand, 1000 kg/h, 15 000 rpm, 0.2 m, 24 vanes of 20 mm: 14 000 · 5.248/(3000^0.83 · 0.48^0.12) = 104 µm.

    >>> round(droplet_diameter_masters("1000 kg/hour", "15000 rpm", 0.2, 0.02) * 1e6)
    104
    """
    load = (mass_flow * HOUR) ** 0.24
    return (
        MICRON
        * 1.4e4
        * load
        / ((rotation_speed / RPM * diameter) ** 0.83 * (vane_count * vane_height) ** 0.12)
    )


@formula(
    source="friedman1952",
    equation=(
        r"\frac{d_{32}}{r} = 0.4\left(\frac{\Gamma}{\rho N "
        r"r^2}\right)^{0.6}\left(\frac{\eta}{\Gamma}\right)^{0.2}\left(\frac{\sigma\rho\,n "
        r"b}{\Gamma^2}\right)^{0.1},\quad \Gamma = \frac{\dot m}{n b},\ N = \frac{\omega}{2\pi},\ r = "
        r"\frac D2"
    ),
    typical=FEED
    | {
        "mass_flow": (0.05, 3.0),
        "rotation_speed": (800.0, 2000.0),
        "diameter": (0.1, 0.3),
        "vane_height": (5e-3, 4e-2),
    },
    output="droplet_diameter",
    title="Drops of an atomizer wheel (Friedman, Gluckert and Marshall)",
    symbols={"droplet_diameter": "d_{32}"},
)
def droplet_diameter_friedman(
    mass_flow: MassFlow,
    rotation_speed: RotationSpeed,
    diameter: Length,
    vane_height: Length,
    density: Density,
    dynamic_viscosity: DynamicViscosity,
    surface_tension: SurfaceTension,
    vane_count: PositiveNumber = 24.0,
) -> Length:
    """Sauter mean diameter of drops from a vaned wheel with the liquid's properties; Γ is mass flow over
    wetted vane periphery, N in 1/s.

    By hand, 1000 kg/h of water, 15 000 rpm, 0.2 m, 24 vanes of 20 mm: 0.04 m · 0.00659 · 0.2803 · 1.590 =
    117 µm.

    >>> round(droplet_diameter_friedman("1000 kg/hour", "15000 rpm", 0.2, 0.02, 1000.0, 1e-3, 0.072) * 1e6)
    117
    """
    r, wetted = 0.5 * diameter, vane_count * vane_height
    N, load = rotation_speed / (2.0 * pi), mass_flow / wetted
    inertia = (load / (density * N * r**2)) ** 0.6
    return (
        0.4
        * r
        * inertia
        * (dynamic_viscosity / load) ** 0.2
        * (surface_tension * density * wetted / load**2) ** 0.1
    )


@formula(
    source="nukiyama1939; perry2008, ch. 14",
    equation=(
        r"d_{32} = \frac{585}{v}\sqrt{\frac{\sigma}{\rho}} + "
        r"597\left(\frac{\eta}{\sqrt{\sigma\rho}}\right)^{0.45}\left(\frac{1000\,Q_l}{Q_g}\right)^{1.5}\ \mathrm{\mu m\ (cgs)}"  # noqa: E501
    ),
    fitted={"density": (700.0, 1200.0), "surface_tension": (0.019, 0.073), "dynamic_viscosity": (3e-4, 0.05)},
    typical=FEED
    | {
        "density": (1000.0, 1180.0),
        "relative_velocity": (80.0, 300.0),
        "liquid_gas_volume_ratio": (1e-4, 1e-3),
    },
    output="droplet_diameter",
    title="Drops of a two-fluid nozzle (Nukiyama–Tanasawa)",
    symbols={"droplet_diameter": "d_{32}"},
)
def droplet_diameter_nukiyama_tanasawa(
    relative_velocity: Speed,
    liquid_gas_volume_ratio: MassRatio,
    density: Density,
    dynamic_viscosity: DynamicViscosity,
    surface_tension: SurfaceTension,
) -> Length:
    """Sauter mean diameter of drops torn off by fast gas; velocity in m/s, the liquid in cgs units (dyn/cm,
    g/cm³, poise) in the print.

    By hand, water, 100 m/s, gas over liquid 5000 by volume: 585/100 · √72 + 597 · (0.01/√72)^0.45 · 0.2^1.5 =
    49.6 + 2.6 = 52.2 µm.

    >>> round(droplet_diameter_nukiyama_tanasawa(100.0, 2e-4, 1000.0, 1e-3, 0.072) * 1e6, 1)
    52.2
    """
    sigma, rho, eta = surface_tension * 1e3, density * 1e-3, dynamic_viscosity * 10.0
    first = 585.0 / relative_velocity * jnp.sqrt(sigma / rho)
    return MICRON * (
        first + 597.0 * (eta / jnp.sqrt(sigma * rho)) ** 0.45 * (1000.0 * liquid_gas_volume_ratio) ** 1.5
    )


@formula(
    source="godsave1953; masters1991",
    equation=r"t = \frac{\rho\,L_v\,(d_0^2 - d_1^2)}{8\,\lambda\,\Delta T}",
    typical={
        "droplet_diameter": (3e-5, 3e-4),
        "droplet_diameter_end": (1e-6, 2e-5),
        "temperature_difference": (20.0, 150.0),
        "density": (1000.0, 1200.0),
        "thermal_conductivity": (0.024, 0.04),
    },
    title="Evaporation time of a drop, d² law",
    output="drying_time",
    symbols={"droplet_diameter": "d_0", "droplet_diameter_end": "d_1"},
)
def drying_time_droplet(
    droplet_diameter: Length,
    temperature_difference: Annotated[TemperatureDifference, Within(0.0)],
    droplet_diameter_end: Length = 1e-9,
    density: Density = 1000.0,
    thermal_conductivity: ThermalConductivity = 0.026,
    heat_of_vaporization: SpecificEnergy = 2.4e6,
) -> Time:
    """Time to evaporate a still drop of solvent from one diameter to another, heat conducted through the gas
    (Nusselt number 2).

    By hand: 100 µm, 60 K: 1000 · 2.4e6 · 1e-8/(8 · 0.026 · 60) = 1.92 s.

    >>> round(drying_time_droplet("100 um", 60.0), 2)
    1.92
    """
    d0, d1 = droplet_diameter, droplet_diameter_end
    impossible(d1 > d0, d1, "droplet_diameter_end", 0.0, d0)
    return (
        density
        * heat_of_vaporization
        * (d0**2 - d1**2)
        / (8.0 * thermal_conductivity * temperature_difference)
    )
