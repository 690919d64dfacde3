"""The film model: diffusion to the crystal and integration into it, in series, with Sherwood correlations."""

from __future__ import annotations

from typing import NamedTuple

import jax.numpy as jnp

from granum.core import formula, impossible, law, unconverged
from granum.core.kinds import (
    Concentration,
    Density,
    Diffusivity,
    GrowthRate,
    KinematicViscosity,
    Length,
    MassFlux,
    MassRatio,
    MassTransferCoefficient,
    MolarEnergy,
    PositiveNumber,
    Ratio,
    SpecificPower,
    Temperature,
)
from granum.crystallization.formulas.growth import GrowthLaw, arrhenius
from granum.crystallization.kinds import IntegrationCoefficient
from granum.numerics.roots import find_root
from granum.numerics.smooth import safe_divide, safe_power
from granum.particles.formulas.transfer import nusselt_number_ranz_marshall


@formula(
    source="mullin2001, ch. 6",
    title="Growth rate from the mass flux",
    equation=r"G = \frac{k_a \Phi}{3 k_v \rho_c}",
    family="growth_formula",
)
def growth_rate_from_flux(
    growth_flux: MassFlux,
    crystal_density: Density,
    volume_shape_factor: PositiveNumber,
    surface_shape_factor: PositiveNumber,
) -> GrowthRate:
    """Growth rate of size that belongs to a mass flux to the crystal surface.

    >>> round(
    ...     growth_rate_from_flux(
    ...         growth_flux=1e-4, crystal_density=2000, volume_shape_factor=1.0, surface_shape_factor=6.0
    ...     ),
    ...     12,
    ... )
    1e-07
    """
    return surface_shape_factor * growth_flux / (3.0 * volume_shape_factor * crystal_density)


class FilmGrowth(NamedTuple):
    """Flux and concentration at the surface."""

    growth_flux: MassFlux
    interface_concentration: Concentration
    effectiveness_factor: Ratio


def _interface(C, C_star, kd, kr, r):
    """Concentration at the crystal surface where both fluxes are equal; C* where there is no
    supersaturation.
    """
    driving = jnp.maximum(C - C_star, 0.0)
    some = driving > 0
    full = jnp.where(some, driving, 1.0)
    # Unknown: share of the driving force spent on integration, between 0 and 1.
    root = find_root(lambda y: kd * full * (1.0 - y) - kr * safe_power(full * y, r), 0.0, 1.0)
    share = jnp.where(some, root.value, 0.0)
    return C_star + driving * share, root.converged | ~some


@formula(
    source="mullin2001, ch. 6; garside1985",
    equation=r"\Phi = k_d (C - C_i) = k_r \left(\frac{C_i - C^*}{1\ \mathrm{kg/m^3}}\right)^r",
    title="Crystal growth by diffusion and integration in series",
)
def film_growth(
    solute_concentration: Concentration,
    solubility_concentration: Concentration,
    diffusion_coefficient: MassTransferCoefficient,
    integration_coefficient: IntegrationCoefficient,
    integration_order: PositiveNumber,
) -> FilmGrowth:
    """Mass flux to a crystal by diffusion through the film and integration at the surface in series.

    The integration coefficient is the flux at a driving force of 1 kg/m³: Φ = k_r (Δc / 1 kg/m³)^r, so that
    its unit is the same at every order. Printed coefficients in m/s (order 1) or m⁴/(kg s) (order 2) have the
    same number in SI.

    The effectiveness factor is the flux over the one that integration alone would allow: 1 means integration
    controls, 0 diffusion. For order 1 the resistances add.

    >>> flux, surface, factor = film_growth(
    ...     solute_concentration=110,
    ...     solubility_concentration=100,
    ...     diffusion_coefficient=1e-5,
    ...     integration_coefficient=1e-5,
    ...     integration_order=1.0,
    ... )
    >>> round(flux * 1e5, 6), round(surface, 6), round(factor, 6)
    (5.0, 105.0, 0.5)
    """
    C, C_star, kd, kr, r = (
        solute_concentration,
        solubility_concentration,
        diffusion_coefficient,
        integration_coefficient,
        integration_order,
    )
    C_i, found = _interface(C, C_star, kd, kr, r)
    unconverged(found)
    flux = kd * (jnp.maximum(C, C_star) - C_i)
    return FilmGrowth(flux, C_i, safe_divide(flux, kr * safe_power(C - C_star, r), 1.0))


@formula(
    source="ranz1952",
    equation=r"\mathrm{Sh} = 2 + 0.6\,\mathrm{Re}^{1/2}\,\mathrm{Sc}^{1/3}",
    fitted={"reynolds_number": (0.0, 200.0)},
)
def sherwood_number_ranz_marshall(reynolds_number: Ratio, schmidt_number: PositiveNumber) -> PositiveNumber:
    """Sherwood number of a sphere in a stream after Ranz and Marshall.

    >>> sherwood_number_ranz_marshall(reynolds_number=0.0, schmidt_number=1000.0)
    2.0
    """
    return nusselt_number_ranz_marshall(reynolds_number, schmidt_number)


@formula(
    source="levins1972; garside1985",
    equation=(
        r"\mathrm{Sh} = 2 + 0.47\left(\frac{\varepsilon^{1/3} "
        r"L^{4/3}}{\nu}\right)^{0.62}\left(\frac{D_a}{D_t}\right)^{0.17}\mathrm{Sc}^{0.36}"
    ),
    typical={"agitator_to_tank": (0.2, 0.6)},
)
def sherwood_number_levins_glastonbury(
    crystal_size: Length,
    specific_power_input: SpecificPower,
    kinematic_viscosity: KinematicViscosity,
    schmidt_number: PositiveNumber,
    agitator_to_tank: PositiveNumber = 0.5,
) -> PositiveNumber:
    """Sherwood number of crystals suspended in a stirred tank, after Levins and Glastonbury.

    For particles of nearly the density of the liquid; the specific power is in W/kg of suspension.

    >>> round(
    ...     sherwood_number_levins_glastonbury(
    ...         crystal_size="1 mm",
    ...         specific_power_input=0.125,
    ...         kinematic_viscosity="1 mm^2/s",
    ...         schmidt_number=1000.0,
    ...     ),
    ...     2,
    ... )
    58.79
    """
    eddy = specific_power_input ** (1.0 / 3.0) * crystal_size ** (4.0 / 3.0) / kinematic_viscosity
    return 2.0 + 0.47 * eddy**0.62 * agitator_to_tank**0.17 * schmidt_number**0.36


@formula(
    source="mullin2001, ch. 6",
    title="Mass transfer coefficient from the Sherwood number",
    equation=r"k_d = \mathrm{Sh}\,D/L",
    output="diffusion_coefficient",
)
def diffusion_coefficient_sherwood(
    sherwood_number: PositiveNumber, diffusivity: Diffusivity, crystal_size: Length
) -> MassTransferCoefficient:
    """Mass transfer coefficient of the film around a crystal from its Sherwood number.

    >>> diffusion_coefficient_sherwood(sherwood_number=20.0, diffusivity=1e-9, crystal_size=5e-4)
    4e-05
    """
    return sherwood_number * diffusivity / crystal_size


@law(
    "growth_rate",
    name="film_growth_law",
    source="mullin2001, ch. 6",
    title="Growth by diffusion and integration in series",
    equation=(
        r"\Phi = k_d (C - C_i) = k_r \left(\frac{C_i - C^*}{1\ \mathrm{kg/m^3}}\right)^r,\quad G = "
        r"\frac{k_a \Phi}{3 k_v \rho_c}"
    ),
)
class FilmGrowthLaw(GrowthLaw):
    """Growth by diffusion through the film and integration at the surface in series, both with activation
    energies.

    Concentrations are taken per volume of solution with a constant density of the solution.
    ``diffusion_coefficient`` and ``integration_coefficient`` multiply ``exp(-E/RT)``; the latter is the flux
    at a driving force of 1 kg/m³, in kg/(m² s) at every order.
    """

    diffusion_coefficient: MassTransferCoefficient
    integration_coefficient: IntegrationCoefficient
    integration_order: PositiveNumber
    crystal_density: Density
    liquid_density: Density = 1000.0
    volume_shape_factor: PositiveNumber = 0.5236
    surface_shape_factor: PositiveNumber = 3.1416
    diffusion_activation_energy: MolarEnergy = 0.0
    integration_activation_energy: MolarEnergy = 0.0

    def __call__(
        self, solute_per_solvent: MassRatio, solubility_per_solvent: PositiveNumber, temperature: Temperature
    ) -> GrowthRate:
        C = self.liquid_density * solute_per_solvent / (1.0 + solute_per_solvent)
        C_star = self.liquid_density * solubility_per_solvent / (1.0 + solubility_per_solvent)
        kd = self.diffusion_coefficient * arrhenius(self.diffusion_activation_energy, temperature)
        kr = self.integration_coefficient * arrhenius(self.integration_activation_energy, temperature)
        surface, _found = _interface(C, C_star, kd, kr, self.integration_order)
        flux = kd * (jnp.maximum(C, C_star) - surface)
        return self.surface_shape_factor * flux / (3.0 * self.volume_shape_factor * self.crystal_density)


@formula(
    source="mullin2001, ch. 6",
    equation=(
        r"\mathrm{Da} = \frac{k_r}{k_d\,c_0}\left(\frac{C-C^*}{c_0}\right)^{r-1},\ c_0 = "
        r"1\ \mathrm{kg/m^3}"
    ),
    output="damkohler_growth",
)
def damkohler_growth(
    solute_concentration: Concentration,
    solubility_concentration: Concentration,
    diffusion_coefficient: MassTransferCoefficient,
    integration_coefficient: IntegrationCoefficient,
    integration_order: PositiveNumber,
) -> Ratio:
    """Damköhler number of crystal growth: integration rate over mass transfer rate at the full driving force.

    Well above 1 diffusion controls the growth, well below 1 the integration does.

    >>> damkohler_growth(
    ...     solute_concentration=110,
    ...     solubility_concentration=100,
    ...     diffusion_coefficient=1e-5,
    ...     integration_coefficient=1e-5,
    ...     integration_order=1.0,
    ... )
    1.0
    """
    driving = solute_concentration - solubility_concentration
    impossible(driving < 0.0, solute_concentration, "solute_concentration", solubility_concentration, jnp.inf)
    return integration_coefficient * safe_power(driving, integration_order - 1.0) / diffusion_coefficient
