"""Minimum fluidization velocity: the family ``minimum_fluidization_velocity``.

Every law is called with diameter of the sphere of equal volume, density of the particle, density and viscosity of the fluid. Particles not
denser than the fluid cannot be fluidized upwards: no value.
"""

from __future__ import annotations

from typing import Any

import jax.numpy as jnp

from granum.core import formula, limit_active, watch
from granum.core.constants import STANDARD_GRAVITY
from granum.core.kinds import Acceleration, Density, DynamicViscosity, Fraction, Length, Speed, Sphericity, VoidFraction

TYPICAL = {"particle_diameter": (5e-5, 1e-3), "fluid_density": (0.4, 5.0), "dynamic_viscosity": (1.5e-5, 4e-5)}
FINE = {**TYPICAL, "particle_diameter": (4e-5, 2e-4)}
USUAL_VOID_FRACTION = 0.4


def excess(rho_p: Any, rho: Any) -> Any:
    """Density above that of the fluid; NaN with a flag where there is none."""
    difference = jnp.asarray(rho_p - rho, dtype=float)
    limit_active(difference <= 0.0, rho_p, "particle_density")
    return jnp.where(difference > 0.0, difference, jnp.nan)


def archimedes(d: Any, rho_p: Any, rho: Any, eta: Any, g: Any) -> Any:
    """Archimedes number of particles denser than the fluid."""
    return rho * excess(rho_p, rho) * g * d**3 / eta**2


def larger_root(half: Any, product: Any) -> Any:
    """Positive root of x² + 2 half x = product, without cancellation."""
    return product / (jnp.sqrt(half**2 + product) + half)


@formula(source="wen1966", equation=r"\mathrm{Re}_{mf} = \sqrt{33.7^2 + 0.0408\,\mathrm{Ar}} - 33.7",
         fitted={"reynolds": (0.001, 4000.0)}, typical=TYPICAL)  # fmt: skip
def minimum_fluidization_velocity_wen_yu(
    particle_diameter: Length,
    particle_density: Density,
    fluid_density: Density,
    dynamic_viscosity: DynamicViscosity,
    gravity: Acceleration = STANDARD_GRAVITY,
) -> Speed:
    """Minimum fluidization velocity by Wen and Yu, for gases and liquids.

    284 points, standard deviation 34 %. Their constants stand for 1/(ψ ε³) = 14 and (1 - ε)/(ψ² ε³) = 11 in Ergun's equation.

    >>> u = minimum_fluidization_velocity_wen_yu(particle_diameter="500 um", particle_density=2500, fluid_density=1.2,
    ...                                    dynamic_viscosity=1.8e-5)
    >>> 0.1 < u < 0.4
    True
    """
    d, rho, eta = particle_diameter, fluid_density, dynamic_viscosity
    Re = larger_root(33.7, 0.0408 * archimedes(d, particle_density, rho, eta, gravity))
    watch(reynolds=Re)
    return Re * eta / (rho * d)


@formula(source="grace1982", equation=r"\mathrm{Re}_{mf} = \sqrt{27.2^2 + 0.0408\,\mathrm{Ar}} - 27.2",
         fitted={"reynolds": (0.001, 1000.0)}, typical=TYPICAL)  # fmt: skip
def minimum_fluidization_velocity_grace(
    particle_diameter: Length,
    particle_density: Density,
    fluid_density: Density,
    dynamic_viscosity: DynamicViscosity,
    gravity: Acceleration = STANDARD_GRAVITY,
) -> Speed:
    """Minimum fluidization velocity by Grace, for gases.

    Wen and Yu's form with the first constant moved for fine particles.

    >>> u = minimum_fluidization_velocity_grace(particle_diameter="500 um", particle_density=2500, fluid_density=1.2,
    ...                                    dynamic_viscosity=1.8e-5)
    >>> 0.1 < u < 0.4
    True
    """
    d, rho, eta = particle_diameter, fluid_density, dynamic_viscosity
    Re = larger_root(27.2, 0.0408 * archimedes(d, particle_density, rho, eta, gravity))
    watch(reynolds=Re)
    return Re * eta / (rho * d)


@formula(source="chitester1984", equation=r"\mathrm{Re}_{mf} = \sqrt{28.7^2 + 0.0494\,\mathrm{Ar}} - 28.7",
         fitted={"reynolds": (0.001, 1000.0)}, typical=TYPICAL)  # fmt: skip
def minimum_fluidization_velocity_chitester(
    particle_diameter: Length,
    particle_density: Density,
    fluid_density: Density,
    dynamic_viscosity: DynamicViscosity,
    gravity: Acceleration = STANDARD_GRAVITY,
) -> Speed:
    """Minimum fluidization velocity by Chitester and others, for coarse particles and gases up to 64 bar.


    >>> u = minimum_fluidization_velocity_chitester(particle_diameter="500 um", particle_density=2500, fluid_density=1.2,
    ...                                    dynamic_viscosity=1.8e-5)
    >>> 0.1 < u < 0.4
    True
    """
    d, rho, eta = particle_diameter, fluid_density, dynamic_viscosity
    Re = larger_root(28.7, 0.0494 * archimedes(d, particle_density, rho, eta, gravity))
    watch(reynolds=Re)
    return Re * eta / (rho * d)


@formula(source="thonglimp1984; couderc1985", equation=r"\mathrm{Re}_{mf} = \sqrt{31.6^2 + 0.0425\,\mathrm{Ar}} - 31.6",
         fitted={"reynolds": (0.05, 1000.0)}, typical=TYPICAL)  # fmt: skip
def minimum_fluidization_velocity_thonglimp(
    particle_diameter: Length,
    particle_density: Density,
    fluid_density: Density,
    dynamic_viscosity: DynamicViscosity,
    gravity: Acceleration = STANDARD_GRAVITY,
) -> Speed:
    """Minimum fluidization velocity by Thonglimp and others, for gases.

    The constants commonly printed for the second correlation of the same laboratory are 19.9 and 0.03196.

    >>> u = minimum_fluidization_velocity_thonglimp(particle_diameter="500 um", particle_density=2500, fluid_density=1.2,
    ...                                    dynamic_viscosity=1.8e-5)
    >>> 0.1 < u < 0.4
    True
    """
    d, rho, eta = particle_diameter, fluid_density, dynamic_viscosity
    Re = larger_root(31.6, 0.0425 * archimedes(d, particle_density, rho, eta, gravity))
    watch(reynolds=Re)
    return Re * eta / (rho * d)


@formula(source="thonglimp1984", equation=r"\mathrm{Re}_{mf} = \sqrt{19.9^2 + 0.03196\,\mathrm{Ar}} - 19.9",
         fitted={"reynolds": (0.05, 1000.0)}, typical=TYPICAL)  # fmt: skip
def minimum_fluidization_velocity_thonglimp_fine(
    particle_diameter: Length,
    particle_density: Density,
    fluid_density: Density,
    dynamic_viscosity: DynamicViscosity,
    gravity: Acceleration = STANDARD_GRAVITY,
) -> Speed:
    """Minimum fluidization velocity by Thonglimp, Hiquily and Laguerie with the constants 19.9 and 0.03196.

    The same laboratory also printed 31.6 and 0.0425.

    >>> u = minimum_fluidization_velocity_thonglimp_fine(particle_diameter="500 um", particle_density=2500, fluid_density=1.2,
    ...                                    dynamic_viscosity=1.8e-5)
    >>> 0.1 < u < 0.4
    True
    """
    d, rho, eta = particle_diameter, fluid_density, dynamic_viscosity
    Re = larger_root(19.9, 0.03196 * archimedes(d, particle_density, rho, eta, gravity))
    watch(reynolds=Re)
    return Re * eta / (rho * d)


@formula(source="richardson1971", equation=r"\mathrm{Re}_{mf} = \sqrt{25.7^2 + 0.0365\,\mathrm{Ar}} - 25.7",
         fitted={"reynolds": (0.001, 1000.0)}, typical=TYPICAL)  # fmt: skip
def minimum_fluidization_velocity_richardson(
    particle_diameter: Length,
    particle_density: Density,
    fluid_density: Density,
    dynamic_viscosity: DynamicViscosity,
    gravity: Acceleration = STANDARD_GRAVITY,
) -> Speed:
    """Minimum fluidization velocity by Richardson, for gases and liquids.


    >>> u = minimum_fluidization_velocity_richardson(particle_diameter="500 um", particle_density=2500, fluid_density=1.2,
    ...                                    dynamic_viscosity=1.8e-5)
    >>> 0.1 < u < 0.4
    True
    """
    d, rho, eta = particle_diameter, fluid_density, dynamic_viscosity
    Re = larger_root(25.7, 0.0365 * archimedes(d, particle_density, rho, eta, gravity))
    watch(reynolds=Re)
    return Re * eta / (rho * d)


@formula(source="bourgeois1968", equation=r"\mathrm{Re}_{mf} = \sqrt{25.46^2 + 0.0382\,\mathrm{Ar}} - 25.46",
         fitted={"reynolds": (0.001, 1000.0)}, typical=TYPICAL)  # fmt: skip
def minimum_fluidization_velocity_bourgeois_grenier(
    particle_diameter: Length,
    particle_density: Density,
    fluid_density: Density,
    dynamic_viscosity: DynamicViscosity,
    gravity: Acceleration = STANDARD_GRAVITY,
) -> Speed:
    """Minimum fluidization velocity by Bourgeois and Grenier, for spheres in gases and liquids.


    >>> u = minimum_fluidization_velocity_bourgeois_grenier(particle_diameter="500 um", particle_density=2500, fluid_density=1.2,
    ...                                    dynamic_viscosity=1.8e-5)
    >>> 0.1 < u < 0.4
    True
    """
    d, rho, eta = particle_diameter, fluid_density, dynamic_viscosity
    Re = larger_root(25.46, 0.0382 * archimedes(d, particle_density, rho, eta, gravity))
    watch(reynolds=Re)
    return Re * eta / (rho * d)


@formula(source="saxena1977; kunii1991, ch. 3, table 4", equation=r"\mathrm{Re}_{mf} = \sqrt{25.28^2 + 0.0571\,\mathrm{Ar}} - 25.28",
         fitted={"reynolds": (6.0, 102.0)}, typical=TYPICAL)  # fmt: skip
def minimum_fluidization_velocity_saxena_vogel(
    particle_diameter: Length,
    particle_density: Density,
    fluid_density: Density,
    dynamic_viscosity: DynamicViscosity,
    gravity: Acceleration = STANDARD_GRAVITY,
) -> Speed:
    """Minimum fluidization velocity by Saxena and Vogel, from dolomite at high temperature and pressure.

    Runs higher than the others for coarse particles.

    >>> u = minimum_fluidization_velocity_saxena_vogel(particle_diameter="500 um", particle_density=2500, fluid_density=1.2,
    ...                                    dynamic_viscosity=1.8e-5)
    >>> 0.1 < u < 0.4
    True
    """
    d, rho, eta = particle_diameter, fluid_density, dynamic_viscosity
    Re = larger_root(25.28, 0.0571 * archimedes(d, particle_density, rho, eta, gravity))
    watch(reynolds=Re)
    return Re * eta / (rho * d)


@formula(source="babu1978; kunii1991, ch. 3, table 4", equation=r"\mathrm{Re}_{mf} = \sqrt{25.25^2 + 0.0651\,\mathrm{Ar}} - 25.25",
         fitted={"reynolds": (0.05, 400.0)}, typical=TYPICAL)  # fmt: skip
def minimum_fluidization_velocity_babu(
    particle_diameter: Length,
    particle_density: Density,
    fluid_density: Density,
    dynamic_viscosity: DynamicViscosity,
    gravity: Acceleration = STANDARD_GRAVITY,
) -> Speed:
    """Minimum fluidization velocity by Babu, Shah and Talwalkar, from all data known in 1978 on coal and its kin.

    Runs higher than the others for coarse particles.

    >>> u = minimum_fluidization_velocity_babu(particle_diameter="500 um", particle_density=2500, fluid_density=1.2,
    ...                                    dynamic_viscosity=1.8e-5)
    >>> 0.1 < u < 0.4
    True
    """
    d, rho, eta = particle_diameter, fluid_density, dynamic_viscosity
    Re = larger_root(25.25, 0.0651 * archimedes(d, particle_density, rho, eta, gravity))
    watch(reynolds=Re)
    return Re * eta / (rho * d)


@formula(source="ergun1952; kunii1991, ch. 3, eq. 18",
         equation=r"\frac{1.75}{\varepsilon^3\psi}\mathrm{Re}^2 + \frac{150(1-\varepsilon)}{\varepsilon^3\psi^2}\mathrm{Re} = \mathrm{Ar}",
         typical=TYPICAL)  # fmt: skip
def minimum_fluidization_velocity_ergun(
    particle_diameter: Length,
    particle_density: Density,
    fluid_density: Density,
    dynamic_viscosity: DynamicViscosity,
    void_fraction: VoidFraction,
    sphericity: Sphericity = 1.0,
    gravity: Acceleration = STANDARD_GRAVITY,
) -> Speed:
    """Minimum fluidization velocity at which Ergun's pressure drop carries the bed, from void fraction and sphericity.

    The void fraction is that at minimum fluidization, to whose cube the velocity of fine particles goes. Differs from the print: one set of
    notes squares the density, and in its pressure drop swaps ε and 1 - ε.

    Kunii and Levenspiel's sharp sand, 4.0 cm/s:

    >>> round(100 * minimum_fluidization_velocity_ergun(particle_diameter="160 um", particle_density=2600, fluid_density=1.2,
    ...                                                 dynamic_viscosity=1.8e-5, void_fraction=0.55, sphericity=0.67), 1)
    4.0
    """
    d, rho, eta, e, psi = particle_diameter, fluid_density, dynamic_viscosity, void_fraction, sphericity
    square, line = 1.75 / (e**3 * psi), 150.0 * (1.0 - e) / (e**3 * psi**2)
    Re = larger_root(line / (2.0 * square), archimedes(d, particle_density, rho, eta, gravity) / square)
    return Re * eta / (rho * d)


@formula(source="carman1937; coulson2002, ch. 6",
         equation=r"U_{mf} = \frac{(\psi d_p)^2 g (\rho_p - \rho_f)}{180\,\eta}\,\frac{\varepsilon^3}{1 - \varepsilon}",
         fitted={"reynolds": (0.0, 10.0)}, typical=FINE)  # fmt: skip
def minimum_fluidization_velocity_kozeny_carman(
    particle_diameter: Length,
    particle_density: Density,
    fluid_density: Density,
    dynamic_viscosity: DynamicViscosity,
    void_fraction: VoidFraction,
    sphericity: Sphericity = 1.0,
    gravity: Acceleration = STANDARD_GRAVITY,
) -> Speed:
    """Minimum fluidization velocity of fine particles, at which the pressure drop of Kozeny and Carman carries the bed.

    >>> round(1e5 * minimum_fluidization_velocity_kozeny_carman(particle_diameter="100 um", particle_density=2600, fluid_density=900,
    ...                                                         dynamic_viscosity="3 cP", void_fraction=0.48), 1)
    6.6
    """
    d, rho, eta, e = sphericity * particle_diameter, fluid_density, dynamic_viscosity, void_fraction
    U = d**2 * excess(particle_density, rho) * gravity / (180.0 * eta) * e**3 / (1.0 - e)
    watch(reynolds=rho * U * particle_diameter / eta)
    return U


@formula(source="leva1959",
         equation=r"U_{mf} = 0.005\,\frac{(\psi d_p)^2 g (\rho_p - \rho_f)}{\eta}\,\frac{\varepsilon^3}{1 - \varepsilon}",
         fitted={"reynolds": (0.0, 10.0)}, typical=FINE)  # fmt: skip
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

    Differs from the print: the course notes write the sphericity as a density squared, and print 0.006 for the whole factor at a void
    fraction of 0.4, which is 0.005 · 0.4³/0.6 = 0.00053 (the void fraction left at its default).

    >>> round(minimum_fluidization_velocity_leva(particle_diameter=1.0, particle_density=2.0, fluid_density=1.0, dynamic_viscosity=1.0,
    ...                                          gravity=1.0), 6)
    0.000533
    """
    d, rho, eta, e = sphericity * particle_diameter, fluid_density, dynamic_viscosity, void_fraction
    U = 0.005 * d**2 * excess(particle_density, rho) * gravity / eta * e**3 / (1.0 - e)
    watch(reynolds=rho * U * particle_diameter / eta)
    return U


@formula(source="leva1959",
         equation=r"G_{mf} = 688\,d_p^{1.82}\,\frac{[\rho_f(\rho_p - \rho_f)]^{0.94}}{\eta^{0.88}}",
         fitted={"reynolds": (0.0, 10.0)}, typical=FINE)  # fmt: skip
def minimum_fluidization_velocity_leva_power(
    particle_diameter: Length,
    particle_density: Density,
    fluid_density: Density,
    dynamic_viscosity: DynamicViscosity,
) -> Speed:
    """Minimum fluidization velocity of fine particles by Leva's power law, which needs neither void fraction nor sphericity.

    The print is in lb/(h ft²), inches, lb/ft³ and centipoise, and holds on Earth.

    >>> u = minimum_fluidization_velocity_leva_power(particle_diameter="100 um", particle_density=2500, fluid_density=1.2,
    ...                                              dynamic_viscosity=1.8e-5)
    >>> 0.005 < u < 0.015
    True
    """
    d, rho, eta = particle_diameter, fluid_density, dynamic_viscosity
    pound_per_cubic_foot, pound_flux = 16.018463, 1.3562299e-3
    inches, product = d / 0.0254, rho * excess(particle_density, rho) / pound_per_cubic_foot**2
    U = 688.0 * inches**1.82 * product**0.94 / (1e3 * eta) ** 0.88 * pound_flux / rho
    watch(reynolds=rho * U * d / eta)
    return U


@formula(source="baeyens1974; geldart1986",
         equation=r"U_{mf} = \frac{[g(\rho_p - \rho_f)]^{0.934}\,d_p^{1.8}}{1111\,\eta^{0.87}\,\rho_f^{0.066}}",
         fitted={"particle_diameter": (0.0, 1e-4)}, typical=FINE)  # fmt: skip
def minimum_fluidization_velocity_baeyens_geldart(
    particle_diameter: Length,
    particle_density: Density,
    fluid_density: Density,
    dynamic_viscosity: DynamicViscosity,
    gravity: Acceleration = STANDARD_GRAVITY,
) -> Speed:
    """Minimum fluidization velocity of powders finer than 100 µm in gases by Baeyens and Geldart.

    >>> u = minimum_fluidization_velocity_baeyens_geldart(particle_diameter="60 um", particle_density=1500, fluid_density=1.2,
    ...                                                   dynamic_viscosity=1.8e-5)
    >>> 0.001 < u < 0.004
    True
    """
    d, rho, eta = particle_diameter, fluid_density, dynamic_viscosity
    return (excess(particle_density, rho) * gravity) ** 0.934 * d**1.8 / (1111.0 * eta**0.87 * rho**0.066)


@formula(source="riba1978",
         equation=r"\mathrm{Re}_{mf} = 0.0154\,\mathrm{Ga}^{0.66} M_v^{0.70},\ M_v = (\rho_p - \rho_f)/\rho_f",
         fitted={"reynolds": (10.0, 1000.0)},
         typical={"particle_diameter": (1e-3, 5e-3)})  # fmt: skip
def minimum_fluidization_velocity_riba(
    particle_diameter: Length,
    particle_density: Density,
    fluid_density: Density,
    dynamic_viscosity: DynamicViscosity,
    gravity: Acceleration = STANDARD_GRAVITY,
) -> Speed:
    """Minimum fluidization velocity in liquids by Riba, Routie and Couderc.

    >>> u = minimum_fluidization_velocity_riba(particle_diameter="2 mm", particle_density=2500, fluid_density=1000,
    ...                                        dynamic_viscosity="1 cP")
    >>> 0.01 < u < 0.04
    True
    """
    d, rho, eta = particle_diameter, fluid_density, dynamic_viscosity
    Re = 0.0154 * (gravity * d**3 * rho**2 / eta**2) ** 0.66 * (excess(particle_density, rho) / rho) ** 0.70
    watch(reynolds=Re)
    return Re * eta / (rho * d)


@formula(source="abrahamsen1980",
         equation=r"U_{mb} = 2.07\,e^{0.716 F_{45}}\,\frac{d_p\,\rho_f^{0.06}}{\eta^{0.347}}",
         fitted={"particle_diameter": (2e-5, 7.2e-5)},
         typical={**TYPICAL, "particle_diameter": (2e-5, 7e-5)})  # fmt: skip
def minimum_bubbling_velocity_abrahamsen_geldart(
    particle_diameter: Length,
    fluid_density: Density,
    dynamic_viscosity: DynamicViscosity,
    fines_fraction: Fraction = 0.1,
) -> Speed:
    """Velocity at which bubbles appear in a bed of fine powder by Abrahamsen and Geldart.

    The fines fraction is the part of the mass below 45 µm. Where it comes out below the minimum fluidization velocity the powder is
    not of group A and bubbles from the start.

    >>> u = minimum_bubbling_velocity_abrahamsen_geldart(particle_diameter="60 um", fluid_density=1.2, dynamic_viscosity=1.8e-5)
    >>> 0.005 < u < 0.01
    True
    """
    return 2.07 * jnp.exp(0.716 * fines_fraction) * particle_diameter * fluid_density**0.06 / dynamic_viscosity**0.347
