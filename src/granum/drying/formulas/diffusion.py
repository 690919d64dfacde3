"""Diffusion of moisture in plate, cylinder and sphere: mean moisture ratio over time, and diffusivities."""

from __future__ import annotations

from typing import Any

import jax.numpy as jnp
import numpy as np
from scipy.special import jn_zeros

from granum.core import formula
from granum.core.constants import GAS_CONSTANT
from granum.core.kinds import (
    Diffusivity,
    Length,
    MoistureDryBasis,
    MolarEnergy,
    PositiveNumber,
    Ratio,
    Temperature,
    Time,
)

TERMS = 40
SHORT = 0.05  # Fourier number below which the short-time form is used: both agree there to 1e-7 and better
_BESSEL = jn_zeros(0, TERMS)


def _series(fourier: Any, roots: Any, weights: Any) -> Any:
    fo = jnp.asarray(fourier, dtype=float)
    return jnp.sum(weights * jnp.exp(-roots * fo[..., None]), axis=-1)


def plate(fourier: Any) -> Any:
    """Mean moisture ratio of a plate drying from both sides; Fourier number D t/L² on the half thickness."""
    n = np.arange(TERMS) + 0.5
    fo = jnp.asarray(fourier, dtype=float)
    late = _series(jnp.maximum(fo, SHORT), (n * np.pi) ** 2, 2.0 / (n * np.pi) ** 2)
    root = jnp.sqrt(jnp.where(fo > 0, fo, 1.0)) * (fo > 0)
    return jnp.where(fo < SHORT, 1.0 - 2.0 / np.sqrt(np.pi) * root, late)


def sphere(fourier: Any) -> Any:
    """Mean moisture ratio of a sphere; Fourier number D t/R²."""
    n = np.arange(1, TERMS + 1)
    fo = jnp.asarray(fourier, dtype=float)
    late = _series(jnp.maximum(fo, SHORT), (n * np.pi) ** 2, 6.0 / (n * np.pi) ** 2)
    root = jnp.sqrt(jnp.where(fo > 0, fo, 1.0)) * (fo > 0)
    return jnp.where(fo < SHORT, 1.0 - 6.0 / np.sqrt(np.pi) * root + 3.0 * fo, late)


def cylinder(fourier: Any) -> Any:
    """Mean moisture ratio of a long cylinder; Fourier number D t/R²."""
    fo = jnp.asarray(fourier, dtype=float)
    late = _series(jnp.maximum(fo, 0.01), _BESSEL**2, 4.0 / _BESSEL**2)
    root = jnp.sqrt(jnp.where(fo > 0, fo, 1.0)) * (fo > 0)
    short = 1.0 - 4.0 / np.sqrt(np.pi) * root + fo + fo * root / (3.0 * np.sqrt(np.pi)) + fo**2 / 8.0
    return jnp.where(fo < 0.01, short, late)


@formula(
    source="crank1975, eq. 4.18 and 4.20",
    equation=r"MR = \frac{8}{\pi^2}\sum_{n\ge0}\frac{e^{-(2n+1)^2\pi^2 D t/4L^2}}{(2n+1)^2}",
    typical={"time": (1e3, 2e4), "half_thickness": (2e-3, 5e-3), "diffusivity": (1e-10, 1e-9)},
    title="Diffusion in a plate",
)
def moisture_ratio_plate(time: Time, half_thickness: Length, diffusivity: Diffusivity) -> Ratio:
    """Mean moisture ratio of a plate that dries from both sides with its surface at equilibrium; series, or
    short-time form below Fo 0.05.

    A plate that dries from one side has its thickness for the half thickness. Crank: half dried at D t/(2L)²
    = 0.04919.

    >>> round(moisture_ratio_plate(time=0.1967, half_thickness=1.0, diffusivity=1.0), 3)
    0.5
    """
    return plate(diffusivity * time / half_thickness**2)


@formula(
    source="crank1975, eq. 5.23 and 5.25",
    equation=r"MR = 4\sum_{n\ge1}\frac{e^{-\alpha_n^2 D t/R^2}}{\alpha_n^2},\quad J_0(\alpha_n)=0",
    typical={"time": (1e3, 2e4), "radius": (2e-3, 5e-3), "diffusivity": (1e-10, 1e-9)},
    title="Diffusion in a cylinder",
    symbols={"radius": "R"},
)
def moisture_ratio_cylinder(time: Time, radius: Length, diffusivity: Diffusivity) -> Ratio:
    """Mean moisture ratio of a long cylinder with its surface at equilibrium.

    Half dried at D t/R² = 0.0631.

    >>> round(moisture_ratio_cylinder(time=0.0631, radius=1.0, diffusivity=1.0), 3)
    0.5
    """
    return cylinder(diffusivity * time / radius**2)


@formula(
    source="crank1975, eq. 6.20 and 6.22",
    equation=r"MR = \frac{6}{\pi^2}\sum_{n\ge1}\frac{e^{-n^2\pi^2 D t/R^2}}{n^2}",
    typical={"time": (1e3, 2e4), "radius": (2e-3, 5e-3), "diffusivity": (1e-10, 1e-9)},
    title="Diffusion in a sphere",
    symbols={"radius": "R"},
)
def moisture_ratio_sphere(time: Time, radius: Length, diffusivity: Diffusivity) -> Ratio:
    """Mean moisture ratio of a sphere with its surface at equilibrium.

    Half dried at D t/R² = 0.0305.

    >>> round(moisture_ratio_sphere(time=0.0305, radius=1.0, diffusivity=1.0), 3)
    0.5
    """
    return sphere(diffusivity * time / radius**2)


@formula(
    source="crank1975, ch. 2",
    equation=r"MR = MR_1\,MR_2\,MR_3",
    typical={"moisture_ratio_first": (0.2, 0.9), "moisture_ratio_second": (0.2, 0.9)},
    title="Diffusion in a finite body",
    output="moisture_ratio",
    symbols={"moisture_ratio_first": "MR_1", "moisture_ratio_second": "MR_2"},
)
def moisture_ratio_product(
    moisture_ratio_first: Ratio, moisture_ratio_second: Ratio, moisture_ratio_third: Ratio = 1.0
) -> Ratio:
    """Mean moisture ratio of a brick or a short cylinder: the product of those of the plates and cylinder
    that cut it out.

    >>> moisture_ratio_product(0.5, 0.5)
    0.25
    """
    return moisture_ratio_first * moisture_ratio_second * moisture_ratio_third


@formula(
    source="crank1975",
    equation=r"D = D_0\,e^{-E_a/RT}",
    typical={
        "diffusivity_preexponential": (1e-6, 1e-3),
        "diffusion_activation_energy": (2e4, 4e4),
        "temperature": (310.0, 360.0),
    },
    title="Moisture diffusivity over temperature (Arrhenius)",
    output="diffusivity",
    symbols={"diffusion_activation_energy": "E_a"},
)
def diffusivity_arrhenius(
    temperature: Temperature,
    diffusivity_preexponential: Diffusivity,
    diffusion_activation_energy: MolarEnergy,
) -> Diffusivity:
    """Effective diffusivity of moisture in a solid; activation energies of foods lie between 12 and
    50 kJ/mol.

    The pre-exponential factor is the limit of infinite temperature, not the diffusivity at a reference
    temperature.

    >>> round(diffusivity_arrhenius(350.0, 1e-4, "30 kJ/mol") * 1e9, 2)
    3.33
    """
    return diffusivity_preexponential * jnp.exp(-diffusion_activation_energy / (GAS_CONSTANT * temperature))


@formula(
    source="mayor2004",
    equation=r"\frac{V}{V_0} = \frac{1+\beta X}{1+\beta X_0}",
    typical={
        "moisture_dry_basis": (0.1, 1.0),
        "initial_moisture": (2.0, 5.0),
        "shrinkage_coefficient": (0.5, 1.5),
    },
    title="Shrinkage on drying",
)
def volume_ratio(
    moisture_dry_basis: MoistureDryBasis, initial_moisture: MoistureDryBasis, shrinkage_coefficient: Ratio
) -> PositiveNumber:
    """Volume of a drying product over its first volume; the coefficient is the density of the dry solid over
    water's when no pores form.

    >>> round(volume_ratio(0.0, 4.0, 1.5), 4)
    0.1429
    """
    return (1.0 + shrinkage_coefficient * moisture_dry_basis) / (
        1.0 + shrinkage_coefficient * initial_moisture
    )
