"""Minimum fluidization velocity from the packed bed whose pressure drop carries it: Ergun, Kozeny and Carman,
Leva.
"""

from __future__ import annotations

from granum.core import formula, watch
from granum.core.constants import STANDARD_GRAVITY
from granum.core.kinds import Acceleration, Density, DynamicViscosity, Length, Speed, Sphericity, VoidFraction
from granum.fluidization.formulas.buoyancy import FINE, TYPICAL, archimedes, excess, larger_root
from granum.particles.definitions import ARCHIMEDES, velocity_of

USUAL_VOID_FRACTION = 0.4


@formula(
    source="ergun1952; kunii1991, ch. 3, eq. 18; bird2002, section 6.4",
    equation=(
        r"\frac{1.75}{\varepsilon^3\psi}\mathrm{Re}_{mf}^2 + "
        r"\frac{150(1-\varepsilon)}{\varepsilon^3\psi^2}\mathrm{Re}_{mf} = \mathrm{Ar}"
    )
    + velocity_of("U_{mf}", "mf")
    + ARCHIMEDES,
    fitted={"reynolds_bed": (0.0, 2300.0)},
    typical=TYPICAL,
)
def minimum_fluidization_velocity_ergun(
    particle_diameter: Length,
    particle_density: Density,
    fluid_density: Density,
    dynamic_viscosity: DynamicViscosity,
    void_fraction: VoidFraction,
    sphericity: Sphericity = 1.0,
    gravity: Acceleration = STANDARD_GRAVITY,
) -> Speed:
    """Minimum fluidization velocity at which Ergun's pressure drop carries the bed, from void fraction and
    sphericity.

    The void fraction is that at minimum fluidization, to whose cube the velocity of fine particles goes.
    Differs from the print: one set of notes squares the density, and in its pressure drop swaps ε and 1 - ε.
    Ergun's data end at ρUψd/η/(1 - ε) = 2300; towards creeping flow his equation becomes that of Blake and
    Kozeny.

    Kunii and Levenspiel's sharp sand, 4.0 cm/s:

    >>> round(
    ...     100
    ...     * minimum_fluidization_velocity_ergun(
    ...         particle_diameter="160 um",
    ...         particle_density=2600,
    ...         fluid_density=1.2,
    ...         dynamic_viscosity=1.8e-5,
    ...         void_fraction=0.55,
    ...         sphericity=0.67,
    ...     ),
    ...     1,
    ... )
    4.0
    """
    d, rho, eta, e, psi = particle_diameter, fluid_density, dynamic_viscosity, void_fraction, sphericity
    square, line = 1.75 / (e**3 * psi), 150.0 * (1.0 - e) / (e**3 * psi**2)
    Re = larger_root(line / (2.0 * square), archimedes(d, particle_density, rho, eta, gravity) / square)
    watch(reynolds_bed=Re * psi / (1.0 - e))
    return Re * eta / (rho * d)


@formula(
    source="carman1937; richardson2002, ch. 6",
    equation=(
        r"U_{mf} = \frac{(\psi d_p)^2 g (\rho_p - \rho_f)}{180\,\eta}\,\frac{\varepsilon^3}{1 - "
        r"\varepsilon}"
    ),
    fitted={"reynolds": (0.0, 10.0)},
    typical=FINE,
)
def minimum_fluidization_velocity_kozeny_carman(
    particle_diameter: Length,
    particle_density: Density,
    fluid_density: Density,
    dynamic_viscosity: DynamicViscosity,
    void_fraction: VoidFraction,
    sphericity: Sphericity = 1.0,
    gravity: Acceleration = STANDARD_GRAVITY,
) -> Speed:
    """Minimum fluidization velocity of fine particles, at which the pressure drop of Kozeny and Carman
    carries the bed.

    >>> round(
    ...     1e5
    ...     * minimum_fluidization_velocity_kozeny_carman(
    ...         particle_diameter="100 um",
    ...         particle_density=2600,
    ...         fluid_density=900,
    ...         dynamic_viscosity="3 cP",
    ...         void_fraction=0.48,
    ...     ),
    ...     1,
    ... )
    6.6
    """
    d, rho, eta, e = sphericity * particle_diameter, fluid_density, dynamic_viscosity, void_fraction
    U = d**2 * excess(particle_density, rho) * gravity / (180.0 * eta) * e**3 / (1.0 - e)
    watch(reynolds=rho * U * particle_diameter / eta)
    return U


@formula(
    source="leva1959",
    equation=(
        r"U_{mf} = 0.005\,\frac{(\psi d_p)^2 g (\rho_p - \rho_f)}{\eta}\,\frac{\varepsilon^3}{1 - "
        r"\varepsilon}"
    ),
    fitted={"reynolds": (0.0, 10.0)},
    typical=FINE,
)
def minimum_fluidization_velocity_leva(
    particle_diameter: Length,
    particle_density: Density,
    fluid_density: Density,
    dynamic_viscosity: DynamicViscosity,
    void_fraction: VoidFraction = USUAL_VOID_FRACTION,
    sphericity: Sphericity = 1.0,
    gravity: Acceleration = STANDARD_GRAVITY,
) -> Speed:
    """Minimum fluidization velocity of fine particles by Leva, from void fraction and sphericity.

    Differs from the print: the course notes write the sphericity as a density squared, and print 0.006 for
    the whole factor at a void fraction of 0.4, which is 0.005 · 0.4³/0.6 = 0.00053 (the void fraction left at
    its default).

    >>> round(
    ...     minimum_fluidization_velocity_leva(
    ...         particle_diameter=1.0,
    ...         particle_density=2.0,
    ...         fluid_density=1.0,
    ...         dynamic_viscosity=1.0,
    ...         gravity=1.0,
    ...     ),
    ...     6,
    ... )
    0.000533
    """
    d, rho, eta, e = sphericity * particle_diameter, fluid_density, dynamic_viscosity, void_fraction
    U = 0.005 * d**2 * excess(particle_density, rho) * gravity / eta * e**3 / (1.0 - e)
    watch(reynolds=rho * U * particle_diameter / eta)
    return U
