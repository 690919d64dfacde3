"""What a membrane holds back and what gathers before it: sizes of molecules and pores, steric rejection,
polarization by film theory, osmotic pressure from the activity of the solvent, transfer in a channel.
"""

from __future__ import annotations

from typing import Annotated, Any

import jax.numpy as jnp

from granum.core import formula
from granum.core.constants import AVOGADRO, GAS_CONSTANT
from granum.core.kinds import (
    Density,
    Diffusivity,
    DynamicViscosity,
    Fraction,
    Length,
    MassTransferCoefficient,
    MolarMass,
    OpenFraction,
    PositiveNumber,
    Pressure,
    Speed,
    Temperature,
    VolumePerMass,
    WaterActivity,
    Within,
)

STEEPEST = 200.0  # exponent beyond which a wall concentration has no meaning
TURBULENT = 4000.0
_FILM = {"filtrate_flux": (2e-6, 3e-5), "mass_transfer_coefficient": (2e-6, 5e-5)}
_FILM_SYMBOLS = {"filtrate_flux": "J", "mass_transfer_coefficient": "k"}


def _polarized(flux: Any, coefficient: Any) -> Any:
    return jnp.exp(jnp.minimum(flux / coefficient, STEEPEST))


@formula(
    source="robinson2002, ch. 2",
    equation=r"\Delta\pi = -\frac{R\,T\,\rho_l}{M}\,\ln a_w",
    title="Osmotic pressure from the water activity",
    output="osmotic_pressure",
    typical={"water_activity": (0.9, 1.0), "molar_mass": (0.018, 0.0181), "liquid_density": (950.0, 1000.0)},
)
def osmotic_pressure_activity(
    water_activity: Annotated[WaterActivity, Within(1e-6)],
    temperature: Temperature = 298.15,
    liquid_density: Density = 997.0,
    molar_mass: MolarMass = 0.018015,
) -> Pressure:
    """Osmotic pressure of a solution of any strength from the activity of its solvent; density and molar mass
    are those of the pure solvent, taken as incompressible.

    1 mol of NaCl per kg of water at 25 °C has an osmotic coefficient of 0.9355 (Hamer and Wu): an activity of
    exp(−2 · 0.018015 · 0.9355), so 2 · 0.9355 · 997 · R T, 46.2 bar.

    >>> round(osmotic_pressure_activity(water_activity=0.966856) / 1e5, 1)
    46.2
    """
    return -GAS_CONSTANT * temperature * liquid_density / molar_mass * jnp.log(water_activity)


@formula(
    source="ferry1936; zeman1996",
    equation=r"R = \left[\lambda\,(2 - \lambda)\right]^2,\qquad \lambda = \frac{d}{d_p}",
    title="Rejection of a sphere by pores",
    output="rejection",
    typical={"particle_diameter": (1e-9, 1e-7), "pore_diameter": (3e-9, 2e-7)},
    symbols={"particle_diameter": "d"},
)
def rejection_ferry(particle_diameter: Length, pore_diameter: Length) -> Fraction:
    """Share of spheres held back at the mouth of round pores, by their size alone; whole from the size of the
    pore on.

    Charge, adsorption and the drag in the pore are left out. By hand: half as wide as the pore,
    (0.5 · 1.5)² = 0.5625.

    >>> rejection_ferry(particle_diameter="5 nm", pore_diameter="10 nm")
    0.5625
    """
    ratio = jnp.minimum(particle_diameter / pore_diameter, 1.0)
    return (ratio * (2.0 - ratio)) ** 2


def _sphere(molar_mass: Any, partial_specific_volume: Any) -> Any:
    return jnp.cbrt(6.0 * molar_mass * partial_specific_volume / (jnp.pi * AVOGADRO))


@formula(
    source="erickson2009, eq. 2.1",
    equation=r"d = \left(\frac{6\,M\,\bar v}{\pi\,N_A}\right)^{1/3}",
    title="Diameter of a compact molecule",
    typical={"molar_mass": (5.0, 200.0)},
    fitted={"molar_mass": (5.0, 500.0)},
)
def molecule_diameter(molar_mass: MolarMass, partial_specific_volume: VolumePerMass = 0.73e-3) -> Length:
    """Diameter of the smallest sphere that holds a molecule of a molar mass, its volume that of a protein.

    Stretched and swollen molecules are larger. Lighter molecules are no proteins, though the size of sugars
    comes out near that by diffusion (sucrose 0.92 nm). Erickson's table 1 (recalled, not opened) has a radius
    of 2.4 nm for 50 kg/mol.

    >>> round(molecule_diameter(molar_mass=50.0) * 1e9 / 2, 1)
    2.4
    """
    return _sphere(molar_mass, partial_specific_volume)


@formula(
    source="ferry1936; erickson2009, eq. 2.1",
    equation=(
        r"d_p = \frac{d}{1 - \sqrt{1 - \sqrt{R}}},\qquad "
        r"d = \left(\frac{6\,M\,\bar v}{\pi\,N_A}\right)^{1/3}"
    ),
    title="Pore diameter from the nominal cut-off",
    output="pore_diameter",
    typical={"molar_mass_cut_off": (1.0, 500.0), "rejection": (0.85, 0.95)},
    symbols={"molar_mass_cut_off": "M"},
)
def pore_diameter_cut_off(
    molar_mass_cut_off: MolarMass,
    rejection: OpenFraction = 0.9,
    partial_specific_volume: VolumePerMass = 0.73e-3,
) -> Length:
    """Pore diameter at which a compact molecule of the nominal cut-off is held back by the given share, nine
    tenths as makers state it.

    By hand: 10 kg/mol is a sphere of 2.85 nm, held back by 0.9 at a ratio of 0.773.

    >>> round(pore_diameter_cut_off(molar_mass_cut_off=10.0) * 1e9, 2)
    3.68
    """
    ratio = 1.0 - jnp.sqrt(1.0 - jnp.sqrt(rejection))
    return _sphere(molar_mass_cut_off, partial_specific_volume) / ratio


@formula(
    source="zeman1996, ch. 7",
    equation=r"\frac{c_m}{c_b} = e^{J/k}",
    typical=_FILM,
    symbols=_FILM_SYMBOLS,
)
def polarization_modulus(
    filtrate_flux: Speed, mass_transfer_coefficient: MassTransferCoefficient
) -> PositiveNumber:
    """Concentration at the membrane over that of the bulk of something wholly held back, by the film model.

    By hand: a flux equal to the coefficient makes e.

    >>> round(polarization_modulus(1e-5, 1e-5), 4)
    2.7183
    """
    return _polarized(filtrate_flux, mass_transfer_coefficient)


@formula(
    source="zeman1996, ch. 7",
    equation=r"R_o = \frac{R}{R + (1 - R)\,e^{J/k}}",
    title="Observed rejection under polarization",
    output="rejection",
    typical=_FILM | {"rejection": (0.5, 1.0)},
    symbols=_FILM_SYMBOLS | {"=rejection": "R_o"},
)
def rejection_observed(
    rejection: Fraction, filtrate_flux: Speed, mass_transfer_coefficient: MassTransferCoefficient
) -> Fraction:
    """Rejection against the bulk, of a solute that the membrane holds back by a share of what stands before
    it: what gathers at the wall passes more.

    By hand: 0.9 with a wall e times as concentrated, 0.9/(0.9 + 0.1 e).

    >>> round(rejection_observed(0.9, 1e-5, 1e-5), 4)
    0.768
    """
    held, gathered = rejection, _polarized(filtrate_flux, mass_transfer_coefficient)
    return held / (held + (1.0 - held) * gathered)


@formula(
    source="porter1972; zeman1996, ch. 7",
    equation=(
        r"k = 1.62\,\frac{D}{d_h}\left(\mathrm{Re}\,\mathrm{Sc}\,\frac{d_h}{L}\right)^{1/3}\ "
        r"(\mathrm{Re} < 4000),\qquad k = 0.023\,\frac{D}{d_h}\,\mathrm{Re}^{0.8}\,\mathrm{Sc}^{0.33},\qquad "
        r"\mathrm{Re} = \frac{\rho\,v\,d_h}{\eta},\ \mathrm{Sc} = \frac{\eta}{\rho\,D}"
    ),
    title="Mass transfer coefficient in a membrane channel",
    output="mass_transfer_coefficient",
    typical={
        "diffusivity": (3e-11, 2e-9),
        "hydraulic_diameter": (5e-4, 1.2e-2),
        "channel_length": (0.3, 3.0),
        "velocity": (0.1, 4.0),
        "density": (990.0, 1050.0),
    },
    symbols={"mass_transfer_coefficient": "k"},
)
def mass_transfer_coefficient_channel(
    velocity: Speed,
    hydraulic_diameter: Length,
    channel_length: Length,
    diffusivity: Diffusivity,
    density: Density,
    dynamic_viscosity: DynamicViscosity,
) -> MassTransferCoefficient:
    """Mass transfer coefficient along a membrane: Lévêque's law while the flow is laminar, Dittus and
    Boelter's analogy beyond.

    Spacers of spiral elements raise it. By hand, laminar: Re 100 and Sc 10⁴ in a channel of 1 mm and 1 m:
    1.62 · 10⁻⁷ · 1000^(1/3).

    >>> round(mass_transfer_coefficient_channel(0.1, "1 mm", 1.0, 1e-10, 1000.0, 1e-3) * 1e6, 2)
    1.62
    """
    Re = density * velocity * hydraulic_diameter / dynamic_viscosity
    Sc = dynamic_viscosity / (density * diffusivity)
    some = jnp.maximum(Re, 1e-30)
    laminar = 1.62 * jnp.cbrt(some * Sc * hydraulic_diameter / channel_length)
    turbulent = 0.023 * some**0.8 * Sc**0.33
    return diffusivity / hydraulic_diameter * jnp.where(Re < TURBULENT, laminar, turbulent)


@formula(
    source="cheryan1998",
    equation=r"F = e^{-(1 - R)\,N_D}",
    title="Solute left after batch diafiltration",
    output="solute_remaining",
    typical={"diavolumes": (1.0, 6.0), "rejection": (0.0, 0.5)},
)
def solute_remaining_diafiltration(diavolumes: PositiveNumber, rejection: Fraction = 0.0) -> Fraction:
    """Share of a solute left in a batch of constant volume while as much fresh solvent enters as permeate
    leaves.

    By hand: three volumes take out 95 % of what passes freely.

    >>> round(1.0 - solute_remaining_diafiltration(diavolumes=3.0), 2)
    0.95
    """
    return jnp.exp(-(1.0 - rejection) * diavolumes)


@formula(
    source="cheryan1998",
    equation=r"F = \left[1 + (1 - R)\,\frac{N_D}{n}\right]^{-n}",
    title="Solute left after diafiltration in stages",
    output="solute_remaining",
    typical={"diavolumes": (1.0, 6.0), "stage_count": (1.0, 5.0), "rejection": (0.0, 0.5)},
)
def solute_remaining_diafiltration_stages(
    diavolumes: PositiveNumber, stage_count: PositiveNumber = 1.0, rejection: Fraction = 0.0
) -> Fraction:
    """Share of a solute left after equal mixed stages that share the fresh solvent and each let pass as much
    as they are given.

    Diavolumes are the whole of the solvent per volume of retentate. By hand: one stage and one volume leave a
    half.

    >>> solute_remaining_diafiltration_stages(diavolumes=1.0)
    0.5
    """
    return (1.0 + (1.0 - rejection) * diavolumes / stage_count) ** -stage_count
