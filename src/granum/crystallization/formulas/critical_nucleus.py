"""The critical nucleus of classical theory, in a solution or in an undercooled melt: its size, energy and
number of formula units.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import jax.numpy as jnp

from granum.core import formula, impossible
from granum.core.constants import BOLTZMANN
from granum.core.kinds import (
    Density,
    Energy,
    Length,
    MolarMass,
    PositiveNumber,
    SurfaceTension,
    Temperature,
    TemperatureDifference,
)
from granum.crystallization.formulas.nucleation import molecular_volume
from granum.crystallization.kinds import PositiveMolarEnergy
from granum.numerics.smooth import safe_log


class CriticalNucleus(NamedTuple):
    """A sphere that neither grows nor dissolves."""

    critical_radius: Length
    nucleation_energy: Energy
    molecules_in_nucleus: PositiveNumber


def _nucleus(gamma: Any, energy_per_volume: Any, molecule: Any) -> CriticalNucleus:
    """From the interfacial energy and what the phase change gives back per volume; nothing where it gives
    nothing.
    """
    some = energy_per_volume > 0
    r = jnp.where(some, 2.0 * gamma / jnp.where(some, energy_per_volume, 1.0), jnp.nan)
    return CriticalNucleus(r, 4.0 * jnp.pi / 3.0 * gamma * r**2, 4.0 * jnp.pi / 3.0 * r**3 / molecule)


@formula(
    source="mullin2001, ch. 5",
    equation=(
        r"r_c = \frac{2\gamma v_m}{\nu k T\ln\beta},\quad \Delta G^* = \tfrac{4\pi}{3}\gamma "
        r"r_c^2,\quad N = \frac{4\pi r_c^3}{3 v_m},\quad v_m = \frac{M}{\rho_c N_A}"
    ),
    title="Critical nucleus in a solution",
    typical={"supersaturation_ratio": (1.5, 10.0)},
)
def critical_nucleus(
    supersaturation_ratio: PositiveNumber,
    interfacial_energy: SurfaceTension,
    crystal_density: Density,
    molar_mass: MolarMass,
    temperature: Temperature = 298.15,
    ions_per_formula: PositiveNumber = 1.0,
) -> CriticalNucleus:
    """Radius, energy of formation and number of formula units of the critical nucleus in a supersaturated
    solution or vapor.

    A drop in a vapor is the same problem with one ion per formula.

    >>> out = critical_nucleus(
    ...     supersaturation_ratio=4.0,
    ...     interfacial_energy="75.6 mN/m",
    ...     crystal_density=1000,
    ...     molar_mass="18.02 g/mol",
    ...     temperature="0 degC",
    ... )
    >>> round(out.critical_radius * 1e9, 2), round(out.molecules_in_nucleus)
    (0.87, 91)
    """
    impossible(
        ~(jnp.asarray(supersaturation_ratio) > 1.0),
        supersaturation_ratio,
        "supersaturation_ratio",
        1.0,
        jnp.inf,
    )
    v = molecular_volume(crystal_density, molar_mass)
    work = ions_per_formula * BOLTZMANN * temperature * safe_log(supersaturation_ratio, otherwise=0.0)
    return _nucleus(interfacial_energy, work / v, v)


@formula(
    source="mullin2001, ch. 5",
    equation=r"r_c = \frac{2\gamma v_m}{\nu k T \ln\beta},\quad v_m = \frac{M}{\rho_c N_A}",
    typical={"supersaturation_ratio": (1.5, 10.0)},
)
def critical_radius(
    supersaturation_ratio: PositiveNumber,
    interfacial_energy: SurfaceTension,
    crystal_density: Density,
    molar_mass: MolarMass,
    temperature: Temperature = 298.15,
    ions_per_formula: PositiveNumber = 1.0,
) -> Length:
    """Radius of the critical nucleus of classical nucleation theory.

    Smaller clusters dissolve, larger ones grow. There is none in a solution that is not supersaturated.

    >>> round(
    ...     critical_radius(
    ...         supersaturation_ratio=4.0,
    ...         interfacial_energy="100 mN/m",
    ...         crystal_density=2000,
    ...         molar_mass=0.0361328,
    ...     )
    ...     * 1e9,
    ...     3,
    ... )
    1.051
    """
    given = (
        supersaturation_ratio,
        interfacial_energy,
        crystal_density,
        molar_mass,
        temperature,
        ions_per_formula,
    )
    return critical_nucleus.function(*given).critical_radius


@formula(
    source="mullin2001, ch. 5",
    equation=(
        r"r_c = \frac{2\gamma T_m M}{\rho_c \Delta H_f\,\Delta T},\quad \Delta G^* = "
        r"\tfrac{4\pi}{3}\gamma r_c^2"
    ),
    title="Critical nucleus in an undercooled melt",
    typical={
        "undercooling": (5.0, 60.0),
        "melting_temperature": (270.0, 1300.0),
        "enthalpy_of_fusion": (5e3, 2e4),
    },
)
def critical_nucleus_melt(
    undercooling: TemperatureDifference,
    interfacial_energy: SurfaceTension,
    enthalpy_of_fusion: PositiveMolarEnergy,
    melting_temperature: Temperature,
    crystal_density: Density,
    molar_mass: MolarMass,
) -> CriticalNucleus:
    """Radius, energy of formation and number of formula units of the critical nucleus in an undercooled melt,
    such as ice in water.

    Gold of 0.132 J/m², 1.16 GJ/m³ and 1064 °C, 230 K undercooled: 1.32 nm and 0.96 aJ (Callister).

    >>> gold = critical_nucleus_melt(
    ...     undercooling=230,
    ...     interfacial_energy=0.132,
    ...     enthalpy_of_fusion="11.84 kJ/mol",
    ...     melting_temperature="1064 degC",
    ...     crystal_density=19300,
    ...     molar_mass="196.97 g/mol",
    ... )
    >>> round(gold.critical_radius * 1e9, 2)
    1.32
    """
    impossible(~(jnp.asarray(undercooling) > 0.0), undercooling, "undercooling", 0.0, jnp.inf)
    per_volume = enthalpy_of_fusion * crystal_density / molar_mass * undercooling / melting_temperature
    return _nucleus(interfacial_energy, per_volume, molecular_volume(crystal_density, molar_mass))
