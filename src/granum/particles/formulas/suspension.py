"""A suspension seen as one fluid: its apparent density and viscosity, and the fall of its particles through
it.
"""

from __future__ import annotations

from typing import Annotated, Any, NamedTuple

import jax.numpy as jnp

from granum.core import formula, impossible, watch
from granum.core.constants import STANDARD_GRAVITY
from granum.core.kinds import (
    Acceleration,
    Density,
    DynamicViscosity,
    KinematicViscosity,
    Law,
    Length,
    OpenFraction,
    PositiveNumber,
    Ratio,
    SpecificVolume,
    Velocity,
    VolumeFraction,
    VolumePerMass,
    Within,
)
from granum.particles.formulas.drag_modern import drag_coefficient_brown_lawler
from granum.particles.formulas.terminal import Drag, terminal_velocity

PACKED = "The particles touch: the suspension no longer flows."
Packed = Annotated[OpenFraction, Within(0.5, 1.0)]


@formula(source="einstein1906", equation=r"\rho_a = \varphi\rho_p + (1-\varphi)\rho_f")
def suspension_density(
    particle_density: Density, fluid_density: Density, solids_volume_fraction: VolumeFraction
) -> Density:
    """Apparent density of a suspension: the volume-weighted mean of particle and fluid.

    >>> round(suspension_density(particle_density=2650, fluid_density=1000, solids_volume_fraction=0.1), 6)
    1165.0
    """
    return solids_volume_fraction * particle_density + (1.0 - solids_volume_fraction) * fluid_density


@formula(
    source="einstein1906; einstein1911",
    equation=r"\frac{\eta_a}{\eta} = 1 + 2.5\varphi",
    fitted={"solids_volume_fraction": (0.0, 0.02)},
    typical={"solids_volume_fraction": (1e-3, 0.02)},
)
def relative_viscosity_einstein(solids_volume_fraction: VolumeFraction) -> PositiveNumber:
    """Viscosity of a very dilute suspension of rigid spheres over that of its fluid, by Einstein.

    >>> relative_viscosity_einstein(solids_volume_fraction=0.02)
    1.05
    """
    return 1.0 + 2.5 * solids_volume_fraction


@formula(
    source="batchelor1977",
    equation=r"\frac{\eta_a}{\eta} = 1 + 2.5\varphi + 6.2\varphi^2",
    fitted={"solids_volume_fraction": (0.0, 0.1)},
    typical={"solids_volume_fraction": (1e-3, 0.1)},
)
def relative_viscosity_batchelor(solids_volume_fraction: VolumeFraction) -> PositiveNumber:
    """Viscosity of a dilute suspension of Brownian spheres over that of its fluid, to the second order, by
    Batchelor.

    >>> round(relative_viscosity_batchelor(solids_volume_fraction=0.1), 3)
    1.312
    """
    return 1.0 + 2.5 * solids_volume_fraction + 6.2 * solids_volume_fraction**2


@formula(
    source="vand1948",
    equation=r"\frac{\eta_a}{\eta} = e^{k\varphi}",
    fitted={"solids_volume_fraction": (0.0, 0.3)},
    typical={"viscosity_coefficient": (2.0, 6.0)},
)
def relative_viscosity_vand(
    solids_volume_fraction: VolumeFraction, viscosity_coefficient: PositiveNumber = 2.5
) -> PositiveNumber:
    """Viscosity of a suspension over that of its fluid, an exponential of the volume fraction.

    The coefficient is found by experiment: 2 to 2.5 for dilute and up to 6 for concentrated suspensions.

    >>> round(relative_viscosity_vand(solids_volume_fraction=0.1), 4)
    1.284
    """
    return jnp.exp(viscosity_coefficient * solids_volume_fraction)


@formula(
    source="mooney1951; vand1948",
    equation=r"\frac{\eta_a}{\eta} = \exp\frac{k\varphi}{1 - \varphi/\varphi_m}",
    fitted={"solids_volume_fraction": (0.0, 0.6)},
    typical={"viscosity_coefficient": (2.0, 5.0)},
)
def relative_viscosity_mooney(
    solids_volume_fraction: VolumeFraction,
    viscosity_coefficient: PositiveNumber = 2.5,
    solids_fraction_maximum: Packed = 0.74,
) -> PositiveNumber:
    """Viscosity of a suspension over that of its fluid, with crowding towards the packed volume fraction, by
    Mooney.

    The packed fraction is 0.74 in a hexagonal arrangement and 0.64 in a random one. Above it there is no
    flow: infinite, flagged. Differs from the print: the course sets q = 1/0.74 = 1.35 and then writes
    exp(4.2φ/(1 − φ)), which is k = 4.2 with q = 1.

    >>> round(relative_viscosity_mooney(solids_volume_fraction=0.2), 4)
    1.9841
    """
    free = 1.0 - solids_volume_fraction / solids_fraction_maximum
    flows = free > 0.0
    impossible(~flows, solids_volume_fraction, "solids_volume_fraction", 0.0, solids_fraction_maximum, PACKED)
    return jnp.where(
        flows, jnp.exp(viscosity_coefficient * solids_volume_fraction / jnp.where(flows, free, 1.0)), jnp.inf
    )


@formula(
    source="krieger1959",
    equation=r"\frac{\eta_a}{\eta} = \left(1 - \frac{\varphi}{\varphi_m}\right)^{-[\eta]\varphi_m}",
    fitted={"solids_volume_fraction": (0.0, 0.6)},
    typical={"viscosity_coefficient": (2.0, 5.0)},
)
def relative_viscosity_krieger_dougherty(
    solids_volume_fraction: VolumeFraction,
    viscosity_coefficient: PositiveNumber = 2.5,
    solids_fraction_maximum: Packed = 0.64,
) -> PositiveNumber:
    """Viscosity of a suspension over that of its fluid, with crowding towards the packed volume fraction, by
    Krieger and Dougherty.

    >>> round(relative_viscosity_krieger_dougherty(solids_volume_fraction=0.2), 4)
    1.8212
    """
    free = 1.0 - solids_volume_fraction / solids_fraction_maximum
    flows = free > 0.0
    impossible(~flows, solids_volume_fraction, "solids_volume_fraction", 0.0, solids_fraction_maximum, PACKED)
    return jnp.where(
        flows, jnp.where(flows, free, 1.0) ** (-viscosity_coefficient * solids_fraction_maximum), jnp.inf
    )


@formula(
    source="thomas1965",
    equation=r"\frac{\eta_a}{\eta} = 1 + 2.5\varphi + 10.05\varphi^2 + 0.00273\,e^{16.6\varphi}",
    fitted={"solids_volume_fraction": (0.0, 0.6)},
)
def relative_viscosity_thomas(solids_volume_fraction: VolumeFraction) -> PositiveNumber:
    """Viscosity of a suspension of spheres over that of its fluid, a fit to critically reviewed measurements,
    by Thomas.

    >>> round(relative_viscosity_thomas(solids_volume_fraction=0.2), 4)
    1.9775
    """
    phi = solids_volume_fraction
    return 1.0 + 2.5 * phi + 10.05 * phi**2 + 0.00273 * jnp.exp(16.6 * phi)


Viscosity = Annotated[Any, Law("relative_viscosity")]


@formula(source="mooney1951; einstein1906", equation=r"\eta_a = \eta\,f(\varphi)")
def suspension_viscosity(
    dynamic_viscosity: DynamicViscosity,
    solids_volume_fraction: VolumeFraction,
    relative_viscosity: Viscosity = relative_viscosity_mooney,
) -> DynamicViscosity:
    """Apparent viscosity of a suspension by any law of relative viscosity.

    >>> round(suspension_viscosity(dynamic_viscosity="1 cP", solids_volume_fraction=0.2), 6)
    0.001984
    """
    return dynamic_viscosity * relative_viscosity(solids_volume_fraction)


@formula(
    source="mooney1951; wallis1969",
    title="Hindrance by the apparent medium",
    equation=(
        r"\frac{v}{v_t} = "
        r"\left[\frac{1-\varphi}{(\rho_a/\rho_f)^{1-n}\,(\eta_a/\eta)^{n}}\right]^{1/(2-n)},\quad C_D = "
        r"a\,\mathrm{Re}^{-n}"
    ),
    family="hindrance",
    typical={"drag_exponent": (0.0, 1.0), "density_ratio": (1.2, 4.0)},
)
def hindrance_apparent_medium(
    solids_volume_fraction: OpenFraction,
    reynolds: PositiveNumber,
    drag_exponent: Annotated[Ratio, Within(0.0, 1.0)] = 1.0,
    density_ratio: PositiveNumber = 2.65,
    relative_viscosity: Viscosity = relative_viscosity_mooney,
) -> Ratio:
    """Velocity of a crowd in its own apparent density and viscosity over the terminal velocity, for a drag
    law a Re⁻ⁿ.

    With n = 1 (creeping flow) it is (1 − φ)η/η_a. It is the velocity relative to the liquid; multiply by 1 −
    φ for a vessel without net flow. Differs from the print: the course's ratio has exp(+4.2nφ/(1 − φ)), which
    would speed the crowd up, and applies the exponent 2 − n to one side only.

    >>> round(hindrance_apparent_medium(solids_volume_fraction=0.1, reynolds=0.01), 4)
    0.6741
    """
    phi, n = solids_volume_fraction, drag_exponent
    heavier = 1.0 - phi + phi * density_ratio
    thicker = relative_viscosity(phi)
    ratio = ((1.0 - phi) / (heavier ** (1.0 - n) * thicker**n)) ** (1.0 / (2.0 - n))
    return jnp.broadcast_arrays(ratio, reynolds)[0]


@formula(
    source="mooney1951; wallis1969",
    title="Terminal velocity of a grain in a suspension",
    equation=(
        r"v_t = v_t(d_p, \rho_p, \rho_a, \eta_a),\quad \rho_a = (1 - \varphi)\,\rho_f + "
        r"\varphi\,\rho_p,\quad \eta_a = \eta\,\eta_r(\varphi)"
    ),
)
def terminal_velocity_collective(
    particle_diameter: Length,
    particle_density: Density,
    fluid_density: Density,
    dynamic_viscosity: DynamicViscosity,
    solids_volume_fraction: OpenFraction,
    gravity: Acceleration = STANDARD_GRAVITY,
    drag: Drag = drag_coefficient_brown_lawler,
    relative_viscosity: Viscosity = relative_viscosity_mooney,
) -> Velocity:
    """Velocity of a crowd of particles relative to the liquid: terminal velocity in the apparent density and
    viscosity.

    Any regime and any drag law. Multiply by 1 − φ for the velocity relative to a vessel without net flow.

    >>> round(
    ...     1e3
    ...     * terminal_velocity_collective(
    ...         particle_diameter="10 um",
    ...         particle_density=2650,
    ...         fluid_density=1000,
    ...         dynamic_viscosity="1 cP",
    ...         solids_volume_fraction=0.1,
    ...     ),
    ...     4,
    ... )
    0.0605
    """
    phi = solids_volume_fraction
    density = suspension_density(particle_density, fluid_density, phi)
    viscosity = dynamic_viscosity * relative_viscosity(phi)
    return terminal_velocity(particle_diameter, particle_density, density, viscosity, gravity, drag)


class DilutedSuspension(NamedTuple):
    """Apparent properties of a suspension from its dilution."""

    density: Density
    kinematic_viscosity: KinematicViscosity
    terminal_velocity: Velocity


@formula(
    source="degremont2007, sedimentation; stokes1851",
    equation=(
        r"\nu_a = \nu\frac{D + 1/\rho_p}{D - D_{lim}},\ \rho_a = \frac{D\rho_f + 1}{D + 1/\rho_p},\quad "
        r"v_t = \frac{g d_p^2 (\rho_p - \rho_f)(D - D_{lim})}{18\,\nu\,(\rho_f + 1/D)(D + 1/\rho_p)}"
    ),
    fitted={"reynolds": (0.0, 1.0)},
    typical={"dilution_limit": (1e-4, 4e-4), "liquid_volume_per_solid_mass": (1e-3, 1e-2)},
    symbols={"density": r"\rho_a", "=kinematic_viscosity": r"\nu_a"},
)
def diluted_suspension(
    particle_diameter: Length,
    particle_density: Density,
    fluid_density: Density,
    kinematic_viscosity: KinematicViscosity,
    liquid_volume_per_solid_mass: SpecificVolume,
    dilution_limit: VolumePerMass,
    gravity: Acceleration = STANDARD_GRAVITY,
) -> DilutedSuspension:
    """Apparent density and kinematic viscosity of a suspension from its dilution, and the creeping velocity
    in them.

    Dilution is liquid volume per mass of solid; its limit is that of the settled sludge (or, for flocs, where
    compression starts). At the limit the viscosity is infinite and the velocity zero; below it there is no
    value. Differs from the print: the course writes the last bracket as D + (1 + ρ_p) where D + 1/ρ_p follows
    from its own ν_a and ρ_a. For creeping flow, in the course Reynolds numbers below 1.

    >>> found = diluted_suspension(
    ...     particle_diameter="20 um",
    ...     particle_density=2650,
    ...     fluid_density=1000,
    ...     kinematic_viscosity=1e-6,
    ...     liquid_volume_per_solid_mass=2e-3,
    ...     dilution_limit=2e-4,
    ... )
    >>> round(found.density, 1), round(1e6 * found.kinematic_viscosity, 4)
    (1261.9, 1.3208)
    """
    D, rho_p, rho_f = liquid_volume_per_solid_mass, particle_density, fluid_density
    density = (D * rho_f + 1.0) / (D + 1.0 / rho_p)
    room = D - dilution_limit
    open_ = room > 0.0
    impossible(~open_, D, "liquid_volume_per_solid_mass", dilution_limit, jnp.inf, PACKED)
    viscosity = jnp.where(
        open_, kinematic_viscosity * (D + 1.0 / rho_p) / jnp.where(open_, room, 1.0), jnp.nan
    )
    velocity = gravity * particle_diameter**2 * (rho_p - density) / (18.0 * viscosity * density)
    watch(reynolds=abs(velocity) * particle_diameter / viscosity)
    return DilutedSuspension(density, viscosity, velocity)
