"""Drag of particles that are not spheres; the Reynolds number and the drag area are those of the sphere of
equal volume.
"""

from __future__ import annotations

from typing import Annotated

import equinox as eqx
import jax.numpy as jnp

from granum.core import formula, law
from granum.core.kinds import PositiveNumber, Ratio, Sphericity, Within
from granum.particles.falling import drag_of_any_shape, shape_factors


@formula(
    source="haider1989",
    equation=r"C_D = \frac{24}{\mathrm{Re}}\left(1 + A\,\mathrm{Re}^{B}\right) + \frac{C}{1 + D/\mathrm{Re}},\quad "  # noqa: E501
    r"A = e^{2.3288-6.4581\psi+2.4486\psi^2},\ B = 0.0964+0.5565\psi,\quad "
    r"C = e^{4.905-13.8944\psi+18.4222\psi^2-10.2599\psi^3},\ D = e^{1.4681+12.2584\psi-20.7322\psi^2+15.8855\psi^3}",  # noqa: E501
    fitted={"reynolds": (0.0, 2.6e5)},
    typical={"sphericity": (0.6, 1.0)},
)
def drag_coefficient_haider_levenspiel(
    reynolds: PositiveNumber, sphericity: Sphericity = 1.0
) -> PositiveNumber:
    """Drag coefficient of a particle of any sphericity; of a sphere when the sphericity is one.

    Root-mean-square error 3 % for spheres (with the coefficients fitted to spheres alone) and 5 to 17 % for
    isometric shapes; disks with a sphericity below 0.67 are the worst. Data on shapes end at Re = 25 000.

    >>> round(drag_coefficient_haider_levenspiel(reynolds=200.0), 4)
    0.796
    """
    # The source gives spheres their own rounding of the four numbers.
    ball = 24.0 / reynolds * (1.0 + 0.1806 * reynolds**0.6459) + 0.4251 / (1.0 + 6880.95 / reynolds)
    return jnp.where(sphericity == 1.0, ball, drag_of_any_shape(reynolds, sphericity))


@formula(
    source="ganser1993",
    equation=r"\frac{C_D}{K_2} = \frac{24}{\mathrm{Re}K_1K_2}\left[1 + 0.1118(\mathrm{Re}K_1K_2)^{0.6567}\right]"  # noqa: E501
    r" + \frac{0.4305}{1 + 3305/(\mathrm{Re}K_1K_2)},\quad "
    r"K_1 = \left(\tfrac13 + \tfrac23\psi^{-1/2}\right)^{-1},\ K_2 = 10^{1.8148(-\log_{10}\psi)^{0.5743}}",
    fitted={"reynolds": (0.0, 1e5)},
)
def drag_coefficient_ganser(reynolds: PositiveNumber, sphericity: Sphericity = 1.0) -> PositiveNumber:
    """Drag coefficient of an isometric particle of any sphericity by Ganser's similarity of Stokes and Newton
    regimes.

    The range holds for Re·K₁·K₂. Fitted to all shapes at once it is up to 26 % below the measured drag of a
    sphere near Re = 100; a sphere law carried over to the shape (sphericity in ``terminal_velocity``) does
    better close to a sphere.

    >>> round(drag_coefficient_ganser(reynolds=200.0), 4)
    0.5798
    """
    K1, K2 = shape_factors(sphericity)
    Re = reynolds * K1 * K2
    return K2 * (24.0 / Re * (1.0 + 0.1118 * Re**0.6567) + 0.4305 / (1.0 + 3305.0 / Re))


@formula(
    source="chien1994",
    equation=r"C_D = \frac{30}{\mathrm{Re}} + 67.289\,e^{-5.03\psi}",
    fitted={"reynolds": (0.001, 5000.0), "sphericity": (0.2, 1.0)},
)
def drag_coefficient_chien(reynolds: PositiveNumber, sphericity: Sphericity = 1.0) -> PositiveNumber:
    """Drag coefficient of irregular particles such as drill cuttings.

    >>> round(drag_coefficient_chien(reynolds=100.0, sphericity=0.8), 3)
    1.503
    """
    return 30.0 / reynolds + 67.289 * jnp.exp(-5.03 * sphericity)


@formula(
    source="holzer2008, eq. 10",
    equation=r"C_D = \frac{8}{\mathrm{Re}}\frac{1}{\sqrt{\psi_\perp}} + \frac{16}{\mathrm{Re}}\frac{1}{\sqrt{\psi}}"  # noqa: E501
    r" + \frac{3}{\sqrt{\mathrm{Re}}}\frac{1}{\psi^{3/4}} + 0.42\cdot10^{0.4(-\log_{10}\psi)^{0.2}}\frac{1}{\psi_\perp}",  # noqa: E501
    fitted={"reynolds": (0.0, 1e5)},
    typical={"crosswise_sphericity": (0.5, 1.2)},
)
def drag_coefficient_holzer_sommerfeld(
    reynolds: PositiveNumber, sphericity: Sphericity = 1.0, crosswise_sphericity: PositiveNumber = 1.0
) -> PositiveNumber:
    """Drag coefficient of a particle of any shape and orientation.

    The crosswise sphericity is the cross-section of the sphere of equal volume over the projected area of the
    particle in the direction of motion; it carries the orientation and may exceed one. Mean error 14 % over
    spheres, cuboids, cylinders and disks.

    >>> round(drag_coefficient_holzer_sommerfeld(reynolds=100.0), 2)
    0.96
    """
    Re, psi, across = reynolds, sphericity, crosswise_sphericity
    lack = -jnp.log10(psi)
    angular = lack > 0.0
    newton = jnp.where(angular, 10.0 ** (0.4 * jnp.where(angular, lack, 1.0) ** 0.2), 1.0)
    return (
        8.0 / (Re * jnp.sqrt(across))
        + 16.0 / (Re * jnp.sqrt(psi))
        + 3.0 / (jnp.sqrt(Re) * psi**0.75)
        + 0.42 * newton / across
    )


@law(
    "drag_coefficient",
    name="ganser_shape",
    source="ganser1993",
    title="Ganser, shape and wall known",
    equation=r"K_1 = \left(\frac13\frac{d_n}{d_v} + \frac23\psi^{-1/2}\right)^{-1} - 2.25\frac{d_v}{D}",
    fitted={"wall_ratio": (0.0, 0.1)},
)
class GanserShape(eqx.Module):
    """Drag law of a particle of known orientation near a wall, with Ganser's full Stokes shape factor.

        ``projected_ratio`` is the diameter of the circle of equal projected area over the diameter of the
        sphere of equal volume (one for isometric shapes), ``wall_ratio`` particle diameter over vessel
        diameter.

    >>> round(float(GanserShape(sphericity=1.0)(200.0)), 4)
    0.5798
    """

    sphericity: Sphericity = 1.0
    projected_ratio: PositiveNumber = 1.0
    wall_ratio: Annotated[Ratio, Within(0.0, 0.44)] = 0.0

    def __call__(self, reynolds: PositiveNumber) -> PositiveNumber:
        """Drag coefficient at a Reynolds number."""
        K1 = 3.0 / (self.projected_ratio + 2.0 / jnp.sqrt(self.sphericity)) - 2.25 * self.wall_ratio
        K2 = shape_factors(self.sphericity)[1]
        Re = reynolds * K1 * K2
        return K2 * (24.0 / Re * (1.0 + 0.1118 * Re**0.6567) + 0.4305 / (1.0 + 3305.0 / Re))


@law(
    "drag_coefficient",
    name="bagheri_bonadonna",
    source="bagheri2016",
    fitted={"reynolds": (0.0, 3e5)},
    equation=r"C_D = \frac{24 k_S}{\mathrm{Re}}\left[1 + 0.125\left(\mathrm{Re}\frac{k_N}{k_S}\right)^{2/3}\right]"  # noqa: E501
    r" + \frac{0.46\,k_N}{1 + 5330/(\mathrm{Re}\,k_N/k_S)}",
)
class BagheriBonadonna(eqx.Module):
    """Drag law of irregular particles from the three axes, averaged over orientations.

        ``elongation`` is intermediate over longest axis, ``flatness`` shortest over intermediate; particle
        over fluid density decides how a particle tumbles at high Reynolds numbers.

    >>> round(float(BagheriBonadonna()(200.0)), 3)
    0.65
    """

    elongation: Annotated[PositiveNumber, Within(0.0, 1.0)] = 1.0
    flatness: Annotated[PositiveNumber, Within(0.0, 1.0)] = 1.0
    density_ratio: PositiveNumber = 2.65

    def __call__(self, reynolds: PositiveNumber) -> PositiveNumber:
        """Drag coefficient at a Reynolds number."""
        stokes_form = self.flatness * self.elongation**1.3
        newton_form = self.flatness**2 * self.elongation
        k_S = 0.5 * (jnp.cbrt(stokes_form) + 1.0 / jnp.cbrt(stokes_form))
        log_density = jnp.log10(self.density_ratio)
        alpha = 0.45 + 10.0 / jnp.exp(2.5 * log_density + 30.0)
        beta = 1.0 - 37.0 / jnp.exp(3.0 * log_density + 100.0)
        lack = -jnp.log10(newton_form)
        angular = lack > 0.0
        k_N = jnp.where(angular, 10.0 ** (alpha * jnp.where(angular, lack, 1.0) ** beta), 1.0)
        Re = reynolds * k_N / k_S
        return 24.0 * k_S / reynolds * (1.0 + 0.125 * Re ** (2.0 / 3.0)) + 0.46 * k_N / (1.0 + 5330.0 / Re)
