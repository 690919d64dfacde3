"""Ripening: small crystals are more soluble, and large ones grow at their expense."""

from __future__ import annotations

import jax.numpy as jnp

from granum.core import formula
from granum.core.constants import GAS_CONSTANT
from granum.core.kinds import (
    Concentration,
    Density,
    Diffusivity,
    Length,
    MolarMass,
    PositiveNumber,
    SurfaceTension,
    Temperature,
    Time,
)

_TYPICAL = {"crystal_size": (1e-8, 1e-5)}


@formula(
    source="mullin2001, ch. 3",
    equation=r"\beta = \frac{C^*(L)}{C^*_\infty} = \exp\left(\frac{4\gamma M}{\nu R T \rho_c L}\right)",
    output="supersaturation_ratio",
    typical=_TYPICAL,
)
def supersaturation_ratio_gibbs_thomson(
    crystal_size: Length,
    interfacial_energy: SurfaceTension,
    crystal_density: Density,
    molar_mass: MolarMass,
    temperature: Temperature = 298.15,
    ions_per_formula: PositiveNumber = 1.0,
) -> PositiveNumber:
    """Solubility of a small crystal over that of a large one, after Gibbs, Thomson, Ostwald and Freundlich;
    the size is a diameter.

    Barium sulfate of Mullin, 130 mN/m: crystals of 1, 0.1 and 0.01 µm are 0.5, 6 and 72 % more soluble than
    large ones.

    >>> round(
    ...     supersaturation_ratio_gibbs_thomson(
    ...         crystal_size=0.1e-6,
    ...         interfacial_energy="130 mN/m",
    ...         crystal_density=4500,
    ...         molar_mass=0.233,
    ...         temperature=298.15,
    ...         ions_per_formula=2.0,
    ...     ),
    ...     3,
    ... )
    1.056
    """
    exponent = (
        4.0
        * interfacial_energy
        * molar_mass
        / (ions_per_formula * GAS_CONSTANT * temperature * crystal_density * crystal_size)
    )
    return jnp.exp(exponent)


@formula(
    source="lifshitz1961",
    title="Crystal size after ripening",
    equation=(
        r"\left(\frac{L}{2}\right)^3 - \left(\frac{L_0}{2}\right)^3 = \frac{8\,\gamma D\,C^* M}{9\,R T "
        r"\rho_c^2}\,t"
    ),
    output="crystal_size",
    typical={"crystal_size": (1e-7, 1e-6), "solubility_concentration": (0.1, 10.0), "time": (1e3, 1e6)},
    symbols={"crystal_size": "L_0", "=crystal_size": "L"},
)
def crystal_size_ripened(
    crystal_size: Length,
    time: Time,
    interfacial_energy: SurfaceTension,
    diffusivity: Diffusivity,
    solubility_concentration: Concentration,
    crystal_density: Density,
    molar_mass: MolarMass,
    temperature: Temperature = 298.15,
) -> Length:
    """Mean diameter after ripening limited by diffusion, after Lifshitz, Slyozov and Wagner.

    >>> size = crystal_size_ripened(
    ...     crystal_size=1e-7,
    ...     time=1e5,
    ...     interfacial_energy=0.02,
    ...     diffusivity=1e-9,
    ...     solubility_concentration=1.0,
    ...     crystal_density=1500,
    ...     molar_mass=0.2,
    ... )
    >>> round(size * 1e6, 3)
    7.989
    """
    rate = 8.0 * interfacial_energy * diffusivity * solubility_concentration * molar_mass
    rate = rate / (9.0 * GAS_CONSTANT * temperature * crystal_density**2)
    return 2.0 * ((0.5 * crystal_size) ** 3 + rate * time) ** (1.0 / 3.0)
