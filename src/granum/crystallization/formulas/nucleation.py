"""Nucleation: classical theory, empirical primary and secondary rates; laws that a population balance
takes.
"""

from __future__ import annotations

import math
from abc import abstractmethod
from typing import Annotated, Any

import equinox as eqx
import jax.numpy as jnp

from granum.core import formula, impossible, law
from granum.core.constants import AVOGADRO, BOLTZMANN
from granum.core.kinds import (
    Angle,
    Concentration,
    Density,
    Fraction,
    Law,
    MassRatio,
    MolarConcentration,
    MolarEnergy,
    MolarMass,
    NucleationRate,
    Number,
    PositiveNumber,
    Ratio,
    SurfaceTension,
    Temperature,
    Within,
)
from granum.crystallization.formulas.driving_forces import RelativeSupersaturation
from granum.crystallization.formulas.growth import arrhenius
from granum.crystallization.kinds import Nucleation
from granum.numerics.smooth import safe_log, safe_power

LARGEST_EXPONENT = 700.0  # beyond it exp() underflows to zero


def molecular_volume(crystal_density: Any, molar_mass: Any) -> Any:
    """Volume of one formula unit in the crystal, m³."""
    return molar_mass / (crystal_density * AVOGADRO)


class NucleationLaw(eqx.Module):
    """Nuclei per volume of suspension and time."""

    @abstractmethod
    def __call__(
        self,
        solute_per_solvent: MassRatio,
        solubility_per_solvent: PositiveNumber,
        temperature: Temperature,
        magma_density: Concentration,
    ) -> NucleationRate:
        """Nucleation rate; zero where the solution is not supersaturated."""


@formula(source="volmer1939; mullin2001, ch. 5", equation=r"\phi = \tfrac14 (2+\cos\theta)(1-\cos\theta)^2")
def heterogeneous_factor(contact_angle: Annotated[Angle, Within(0.0, math.pi)]) -> Fraction:
    """Share of the homogeneous nucleation barrier that is left on a foreign surface, for a spherical cap.

    >>> round(heterogeneous_factor(contact_angle="90 degree"), 3)
    0.5
    """
    c = jnp.cos(contact_angle)
    return 0.25 * (2.0 + c) * (1.0 - c) ** 2


def _barrier(log_ratio: Any, gamma: Any, v: Any, T: Any, nu: Any, phi: Any) -> Any:
    positive = log_ratio > 1e-8
    square = (nu * jnp.where(positive, log_ratio, 1.0)) ** 2
    value = 16.0 * jnp.pi / 3.0 * gamma**3 * v**2 / ((BOLTZMANN * T) ** 3 * square) * phi
    return jnp.where(positive, value, jnp.inf)


@formula(
    source="mullin2001, ch. 5; volmer1939",
    fitted={"heterogeneous_factor": (0.0, 1.0)},
    equation=(
        r"\frac{\Delta G^*}{kT} = \frac{16\pi\gamma^3 v_m^2 \phi}{3 (kT)^3 (\nu\ln\beta)^2},\quad v_m = "
        r"\frac{M}{\rho_c N_A}"
    ),
    typical={"supersaturation_ratio": (1.5, 10.0)},
)
def nucleation_barrier(
    supersaturation_ratio: PositiveNumber,
    interfacial_energy: SurfaceTension,
    crystal_density: Density,
    molar_mass: MolarMass,
    temperature: Temperature = 298.15,
    ions_per_formula: PositiveNumber = 1.0,
    heterogeneous_factor: PositiveNumber = 1.0,
) -> PositiveNumber:
    """Nucleation barrier of classical theory over kT.

    The factor is a share of the homogeneous barrier: 1 without foreign surfaces, 0 for one that the crystal
    wets wholly (Volmer).

    >>> round(
    ...     nucleation_barrier(
    ...         supersaturation_ratio=4.0,
    ...         interfacial_energy="10 mN/m",
    ...         crystal_density=2000,
    ...         molar_mass=0.120443,
    ...     ),
    ...     3,
    ... )
    1.25
    """
    impossible(
        ~(jnp.asarray(supersaturation_ratio) > 1.0),
        supersaturation_ratio,
        "supersaturation_ratio",
        1.0,
        jnp.inf,
    )
    log_ratio = safe_log(supersaturation_ratio, otherwise=0.0)
    return _barrier(
        log_ratio,
        interfacial_energy,
        molecular_volume(crystal_density, molar_mass),
        temperature,
        ions_per_formula,
        heterogeneous_factor,
    )


@formula(
    source="mullin2001, ch. 5; volmer1939",
    title="Nucleation rate by the classical theory",
    fitted={"heterogeneous_factor": (0.0, 1.0)},
    equation=(
        r"B_0 = A \exp\left(-\frac{16\pi\gamma^3 v_m^2 \phi}{3 (kT)^3 (\nu\ln\beta)^2}\right),\quad v_m "
        r"= \frac{M}{\rho_c N_A}"
    ),
    family="nucleation_formula",
    typical={
        "supersaturation_ratio": (2.0, 10.0),
        "interfacial_energy": (2e-3, 1e-2),
        "molar_mass": (0.05, 0.15),
    },
)
def nucleation_rate_classical(
    supersaturation_ratio: PositiveNumber,
    interfacial_energy: SurfaceTension,
    crystal_density: Density,
    molar_mass: MolarMass,
    nucleation_preexponential: NucleationRate,
    temperature: Temperature = 298.15,
    ions_per_formula: PositiveNumber = 1.0,
    heterogeneous_factor: PositiveNumber = 1.0,
) -> NucleationRate:
    """Primary nucleation rate of classical theory, homogeneous or (with its factor) on foreign surfaces.

    The pre-exponential factor is in 1/(m³ s). Zero at and below saturation.

    The factor is a share of the homogeneous barrier: 1 without foreign surfaces, 0 for one that the crystal
    wets wholly (Volmer).

    >>> rate = nucleation_rate_classical(
    ...     supersaturation_ratio=4.0,
    ...     interfacial_energy="10 mN/m",
    ...     crystal_density=2000,
    ...     molar_mass=0.120443,
    ...     nucleation_preexponential=1e30,
    ... )
    >>> round(rate / 1e29, 3)
    2.865
    """
    log_ratio = safe_log(supersaturation_ratio, otherwise=0.0)
    barrier = _barrier(
        log_ratio,
        interfacial_energy,
        molecular_volume(crystal_density, molar_mass),
        temperature,
        ions_per_formula,
        heterogeneous_factor,
    )
    some = barrier < LARGEST_EXPONENT
    return jnp.where(some, nucleation_preexponential * jnp.exp(-jnp.where(some, barrier, 0.0)), 0.0)


@formula(
    source="mullin2001, ch. 5; mccabe2005, ch. 27; volmer1939",
    fitted={"heterogeneous_factor": (0.0, 1.0)},
    equation=(
        r"\beta = \exp\sqrt{\frac{16\pi\gamma^3 v_m^2 \phi}{3 (kT)^3 \nu^2 \ln(A/B_0)}},\quad v_m = "
        r"\frac{M}{\rho_c N_A}"
    ),
    output="supersaturation_ratio",
    title="Supersaturation ratio for a nucleation rate",
    typical={"nucleation_rate": (1e6, 1e10), "interfacial_energy": (2e-3, 1e-2), "molar_mass": (0.05, 0.15)},
)
def supersaturation_ratio_nucleation(
    nucleation_rate: NucleationRate,
    interfacial_energy: SurfaceTension,
    crystal_density: Density,
    molar_mass: MolarMass,
    nucleation_preexponential: NucleationRate,
    temperature: Temperature = 298.15,
    ions_per_formula: PositiveNumber = 1.0,
    heterogeneous_factor: PositiveNumber = 1.0,
) -> PositiveNumber:
    """Supersaturation ratio at which the classical theory gives a nucleation rate, such as the 1/(cm³ s) that
    counts as critical.

    No value where the rate is zero or not below the pre-exponential factor. Potassium chloride of McCabe,
    example 27.3 (2.5 erg/cm², 300 K): the exponent is 0.00357/ln²β, so that one nucleus per cm³ and second
    wants ln β = 0.00788.

    The factor is a share of the homogeneous barrier: 1 without foreign surfaces, 0 for one that the crystal
    wets wholly (Volmer).

    >>> ratio = supersaturation_ratio_nucleation(
    ...     nucleation_rate="1 1/(cm^3*s)",
    ...     interfacial_energy="2.5 erg/cm^2",
    ...     crystal_density="1.988 g/cm^3",
    ...     molar_mass="74.56 g/mol",
    ...     nucleation_preexponential="1e25 1/(cm^3*s)",
    ...     temperature=300,
    ...     ions_per_formula=2,
    ... )
    >>> round(ratio, 5)
    1.00791
    """
    below = (nucleation_rate > 0) & (nucleation_rate < nucleation_preexponential)
    impossible(~below, nucleation_rate, "nucleation_rate", 0.0, nucleation_preexponential)
    exponent = safe_log(
        nucleation_preexponential / jnp.where(below, nucleation_rate, 0.5 * nucleation_preexponential)
    )
    v = molecular_volume(crystal_density, molar_mass)
    at_one = _barrier(1.0, interfacial_energy, v, temperature, ions_per_formula, heterogeneous_factor)
    return jnp.where(below, jnp.exp(jnp.sqrt(at_one / exponent)), jnp.nan)


@formula(
    source="mersmann1990",
    equation=r"\gamma = 0.414\,k T\,(\rho_{c,m} N_A)^{2/3} \ln\frac{\rho_{c,m}}{C^*_m}",
    output="interfacial_energy",
    typical={"crystal_molar_density": (5000.0, 40000.0), "solubility_molar": (1.0, 1000.0)},
)
def interfacial_energy_mersmann(
    crystal_molar_density: MolarConcentration,
    solubility_molar: MolarConcentration,
    temperature: Temperature = 298.15,
) -> SurfaceTension:
    """Crystal–solution interfacial energy from the solubility, after Mersmann.

    >>> round(interfacial_energy_mersmann(crystal_molar_density=19000.0, solubility_molar=0.01) * 1e3, 1)
    125.1
    """
    impossible(
        solubility_molar >= crystal_molar_density,
        solubility_molar,
        "solubility_molar",
        0.0,
        crystal_molar_density,
    )
    ratio = crystal_molar_density / solubility_molar
    return (
        0.414 * BOLTZMANN * temperature * (crystal_molar_density * AVOGADRO) ** (2.0 / 3.0) * safe_log(ratio)
    )


@formula(
    source="garside1985; mullin2001, ch. 5",
    title="Secondary nucleation rate",
    equation=r"B_0 = k_b\,e^{-E_b/RT}\,\sigma^b\,M_T^j\,(N/N_0)^p",
    family="nucleation_formula",
)
def nucleation_rate_secondary(
    relative_supersaturation: Number,
    nucleation_coefficient: NucleationRate,
    nucleation_order: PositiveNumber,
    magma_density: Concentration,
    magma_order: Ratio = 1.0,
    agitation_ratio: PositiveNumber = 1.0,
    agitation_order: Ratio = 0.0,
    temperature: Temperature = 298.15,
    nucleation_activation_energy: MolarEnergy = 0.0,
) -> NucleationRate:
    """Secondary nucleation rate per volume of suspension, a power law in supersaturation, magma density and
    agitation.

    The coefficient is in 1/(m³ s) per (kg/m³)^j. Zero at and below saturation. Potassium nitrate of Miller
    and Rawlings, whose 4.63e11 per third moment is 2.20e8 per kg/m³ for crystals of 2110 kg/m³.

    >>> rate = nucleation_rate_secondary(
    ...     relative_supersaturation=0.01,
    ...     nucleation_coefficient=2.196e8,
    ...     nucleation_order=1.78,
    ...     magma_density=50,
    ... )
    >>> round(rate / 1e6, 2)
    3.02
    """
    k = nucleation_coefficient * arrhenius(nucleation_activation_energy, temperature)
    return (
        k
        * safe_power(relative_supersaturation, nucleation_order)
        * safe_power(magma_density, magma_order)
        * agitation_ratio**agitation_order
    )


@law(
    "nucleation_rate",
    name="secondary_nucleation",
    source="garside1985; mullin2001, ch. 5",
    title="Nucleation by a power law",
    equation=r"B_0 = k_b\,e^{-E_b/RT}\,S^b\,M_T^j\,(N/N_0)^p",
)
class PowerLawNucleation(NucleationLaw):
    """Nucleation rate by a power law in driving force, magma density and agitation; primary with magma order
    0.

    ``nucleation_coefficient`` is in 1/(m³ s) per (unit of the driving force)^b and (kg/m³)^j.
    """

    nucleation_coefficient: NucleationRate
    nucleation_order: PositiveNumber
    magma_order: Ratio = 1.0
    agitation_ratio: PositiveNumber = 1.0
    agitation_order: Ratio = 0.0
    nucleation_activation_energy: MolarEnergy = 0.0
    driving_force: Annotated[Any, Law("driving_force")] = RelativeSupersaturation()

    def __call__(
        self,
        solute_per_solvent: MassRatio,
        solubility_per_solvent: PositiveNumber,
        temperature: Temperature,
        magma_density: Concentration,
    ) -> NucleationRate:
        S = self.driving_force(solute_per_solvent, solubility_per_solvent)
        k = self.nucleation_coefficient * arrhenius(self.nucleation_activation_energy, temperature)
        rate = k * safe_power(S, self.nucleation_order) * self.agitation_ratio**self.agitation_order
        return rate * safe_power(magma_density, self.magma_order)


@law(
    "nucleation_rate",
    name="classical_nucleation",
    source="mullin2001, ch. 5; volmer1939",
    fitted={"heterogeneous_factor": (0.0, 1.0)},
    title="Classical primary nucleation",
    equation=(
        r"J = A \exp\left(-\frac{16\pi\gamma^3 v_m^2 \phi}{3 (kT)^3 (\nu\ln\beta)^2}\right),\quad "
        r"v_m = \frac{M}{\rho_c N_A}"
    ),
    symbols={"nucleation_rate": "J"},
)
class ClassicalNucleation(NucleationLaw):
    """Primary nucleation of classical theory, homogeneous or heterogeneous.

    The factor is a share of the homogeneous barrier: 1 without foreign surfaces, 0 for one that the crystal
    wets wholly (Volmer).
    """

    interfacial_energy: SurfaceTension
    crystal_density: Density
    molar_mass: MolarMass
    nucleation_preexponential: NucleationRate
    ions_per_formula: PositiveNumber = 1.0
    heterogeneous_factor: PositiveNumber = 1.0

    def __call__(
        self,
        solute_per_solvent: MassRatio,
        solubility_per_solvent: PositiveNumber,
        temperature: Temperature,
        magma_density: Concentration,
    ) -> NucleationRate:
        log_ratio = safe_log(solute_per_solvent / solubility_per_solvent, otherwise=0.0)
        v = molecular_volume(self.crystal_density, self.molar_mass)
        barrier = _barrier(
            log_ratio,
            self.interfacial_energy,
            v,
            temperature,
            self.ions_per_formula,
            self.heterogeneous_factor,
        )
        some = barrier < LARGEST_EXPONENT
        return jnp.where(some, self.nucleation_preexponential * jnp.exp(-jnp.where(some, barrier, 0.0)), 0.0)


@law(
    "nucleation_rate",
    name="primary_and_secondary_nucleation",
    source="mullin2001, ch. 5",
    title="Sum of two nucleation laws",
    equation=r"B_0 = B_1 + B_2",
)
class SummedNucleation(NucleationLaw):
    """Two nucleation mechanisms at work together, such as primary and secondary."""

    first_nucleation: Nucleation
    second_nucleation: Nucleation

    def __call__(
        self,
        solute_per_solvent: MassRatio,
        solubility_per_solvent: PositiveNumber,
        temperature: Temperature,
        magma_density: Concentration,
    ) -> NucleationRate:
        given = (solute_per_solvent, solubility_per_solvent, temperature, magma_density)
        return self.first_nucleation(*given) + self.second_nucleation(*given)


@law(
    "nucleation_rate",
    name="no_nucleation",
    source="mullin2001, ch. 5",
    title="No nucleation",
    equation="B_0 = 0",
)
class NoNucleation(NucleationLaw):
    """Seeds grow and nothing is born: the ideal of a seeded batch."""

    def __call__(
        self,
        solute_per_solvent: MassRatio,
        solubility_per_solvent: PositiveNumber,
        temperature: Temperature,
        magma_density: Concentration,
    ) -> NucleationRate:
        return 0.0 * (solute_per_solvent + magma_density)
