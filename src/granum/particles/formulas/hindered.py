"""Hindered settling: velocity of a crowd of equal particles over the terminal velocity of one alone.

Every law of the family ``hindrance`` is called with the volume fraction of solids and the Reynolds number of
one particle at its terminal velocity, and gives the velocity relative to the vessel when no net volume flows:
the return flow is in it.
"""

from __future__ import annotations

from typing import Annotated, Any

import equinox as eqx
import jax.numpy as jnp

from granum.core import formula, law
from granum.core.kinds import Law, OpenFraction, PositiveNumber, Ratio, Velocity, Within
from granum.particles.formulas.drag_modern import drag_coefficient_brown_lawler

Solids = Annotated[OpenFraction, Within(0.0, 1.0)]
WallRatio = Annotated[Ratio, Within(0.0, 1.0)]
Exponent = Annotated[Any, Law("settling_exponent")]


@formula(
    source="richardson1954",
    equation=r"n = 4.65 + 19.5\lambda\ (\mathrm{Re}<0.2),\ (4.35 + 17.5\lambda)\mathrm{Re}^{-0.03}\ (<1),\ (4.45 + 18\lambda)\mathrm{Re}^{-0.1}\ (<200),"  # noqa: E501
    r"\ 4.45\,\mathrm{Re}^{-0.1}\ (<500),\ 2.39,\quad \lambda = d_p/D",
    fitted={"reynolds": (0.0, 7000.0), "wall_ratio": (0.0, 0.1)},
    typical={"wall_ratio": (0.0, 0.05)},
)
def settling_exponent_richardson_zaki(
    reynolds: PositiveNumber, wall_ratio: WallRatio = 0.0
) -> PositiveNumber:
    """Exponent n of the settling velocity (1 − φ)ⁿ by Richardson and Zaki, with the effect of the vessel
    wall.

    It jumps by 2 % at Re = 0.2 and at Re = 1.

    >>> settling_exponent_richardson_zaki(reynolds=0.1)
    4.65
    """
    Re, x = reynolds, wall_ratio
    safe = jnp.clip(Re, 0.2, 500.0)
    pieces = [
        4.65 + 19.5 * x,
        (4.35 + 17.5 * x) * safe**-0.03,
        (4.45 + 18.0 * x) * safe**-0.1,
        4.45 * safe**-0.1,
    ]
    return jnp.select([Re < 0.2, Re < 1.0, Re < 200.0, Re < 500.0], pieces, 2.39)


@formula(
    source="garside1977",
    equation=r"\frac{5.1 - n}{n - 2.7} = 0.1\,\mathrm{Re}^{0.9}",
    fitted={"reynolds": (1e-3, 3e4)},
)
def settling_exponent_garside_al_dibouni(reynolds: PositiveNumber) -> PositiveNumber:
    """Exponent n of the settling velocity (1 − φ)ⁿ by Garside and Al-Dibouni, smooth in the Reynolds number.

    >>> round(settling_exponent_garside_al_dibouni(reynolds=10.0), 3)
    4.038
    """
    w = 0.1 * reynolds**0.9
    return (5.1 + 2.7 * w) / (1.0 + w)


@formula(
    source="rowe1987",
    equation=r"n = 2.35\,\frac{2 + 0.175\,\mathrm{Re}^{3/4}}{1 + 0.175\,\mathrm{Re}^{3/4}}",
    fitted={"reynolds": (0.2, 1e4)},
)
def settling_exponent_rowe(reynolds: PositiveNumber) -> PositiveNumber:
    """Exponent n of the settling velocity (1 − φ)ⁿ by Rowe, one curve through Richardson and Zaki's pieces.

    >>> round(settling_exponent_rowe(reynolds=1.0), 2)
    4.35
    >>> settling_exponent_rowe(reynolds=1e-12)
    4.69...
    """
    w = 0.175 * reynolds**0.75
    return 2.35 * (2.0 + w) / (1.0 + w)


@formula(
    source="khan1989; richardson2002, section 5.2.2",
    equation=r"\frac{4.8 - n}{n - 2.4} = 0.043\,\mathrm{Ar}^{0.57}\left[1 - 1.24\left(\frac{d_p}{D}\right)^{0.27}\right],"  # noqa: E501
    r"\quad \mathrm{Ar} = \tfrac34 C_D\mathrm{Re}^2",
    fitted={"wall_ratio": (0.0, 0.2)},
    typical={"wall_ratio": (1e-4, 0.1)},
)
def settling_exponent_khan_richardson(
    reynolds: PositiveNumber, wall_ratio: WallRatio = 0.0
) -> PositiveNumber:
    """Exponent n of the settling velocity (1 − φ)ⁿ by Khan and Richardson, from the Archimedes number and the
    wall.

    The Archimedes number follows from the Reynolds number by Brown and Lawler's drag. Above a particle over
    vessel diameter of 0.45 the bracket turns negative; it is held at zero there. Textbooks that print 2.4 for
    the 1.24 of the wall term find larger exponents.

    >>> round(settling_exponent_khan_richardson(reynolds=0.5), 2)
    4.47
    >>> round(settling_exponent_khan_richardson(reynolds=1e-9), 2)
    4.8
    """
    Ar = 0.75 * drag_coefficient_brown_lawler(reynolds) * reynolds**2
    near = wall_ratio > 0.0
    wall = jnp.where(near, 1.0 - 1.24 * jnp.where(near, wall_ratio, 1.0) ** 0.27, 1.0)
    w = 0.043 * Ar**0.57 * jnp.maximum(wall, 0.0)
    return (4.8 + 2.4 * w) / (1.0 + w)


@formula(
    source="maude1958; perry2008, section 6",
    equation=r"n = 4.65\ (\mathrm{Re}<0.3),\ 4.375\,\mathrm{Re}^{-0.0875}\ (<1000),\ 2.33",
)
def settling_exponent_maude_whitmore(reynolds: PositiveNumber) -> PositiveNumber:
    """Exponent n of the settling velocity (1 − φ)ⁿ by Maude and Whitmore.

    The three pieces, as handbooks print them, do not meet: n jumps up by 4 % at Re = 0.3.

    >>> settling_exponent_maude_whitmore(reynolds=1.0)
    4.375
    """
    Re = reynolds
    return jnp.select([Re < 0.3, Re < 1000.0], [jnp.full_like(Re * 1.0, 4.65), 4.375 * Re**-0.0875], 2.33)


@formula(
    source="richardson1954",
    equation=r"\frac{v}{v_t} = (1 - \varphi)^{n(\mathrm{Re})}",
    fitted={"solids_volume_fraction": (0.0, 0.6)},
)
def hindrance_richardson_zaki(
    solids_volume_fraction: Solids,
    reynolds: PositiveNumber,
    settling_exponent: Exponent = settling_exponent_richardson_zaki,
) -> Ratio:
    """Hindered over terminal velocity by Richardson and Zaki's power of the void fraction, with a choice of
    exponent laws.

    >>> round(hindrance_richardson_zaki(solids_volume_fraction=0.1, reynolds=0.01), 4)
    0.6127
    """
    return (1.0 - solids_volume_fraction) ** settling_exponent(reynolds)


@formula(
    source="garside1977",
    equation=r"\frac{v}{v_t} = (1 - \varphi)^{n},\quad \frac{5.1 - n}{n - 2.7} = 0.1\,\mathrm{Re}^{0.9}",
    fitted={"solids_volume_fraction": (0.0, 0.6)},
)
def hindrance_garside_al_dibouni(solids_volume_fraction: Solids, reynolds: PositiveNumber) -> Ratio:
    """Hindered over terminal velocity by a power of the void fraction with Garside and Al-Dibouni's exponent.

    >>> round(hindrance_garside_al_dibouni(solids_volume_fraction=0.1, reynolds=10.0), 4)
    0.6535
    """
    return (1.0 - solids_volume_fraction) ** settling_exponent_garside_al_dibouni(reynolds)


@formula(
    source="maude1958; perry2008, section 6",
    equation=r"\frac{v}{v_t} = (1 - \varphi)^{n(\mathrm{Re})}",
)
def hindrance_maude_whitmore(solids_volume_fraction: Solids, reynolds: PositiveNumber) -> Ratio:
    """Hindered over terminal velocity by a power of the void fraction with Maude and Whitmore's exponent.

    >>> round(hindrance_maude_whitmore(solids_volume_fraction=0.1, reynolds=0.01), 4)
    0.6127
    """
    return (1.0 - solids_volume_fraction) ** settling_exponent_maude_whitmore(reynolds)


@formula(
    source="khan1989",
    equation=r"\frac{v}{v_t} = (1 - \varphi)^{n(\mathrm{Re})}",
    fitted={"solids_volume_fraction": (0.0, 0.6)},
)
def hindrance_khan_richardson(solids_volume_fraction: Solids, reynolds: PositiveNumber) -> Ratio:
    """Hindered over terminal velocity by a power of the void fraction with Khan and Richardson's exponent,
    far from walls.

    >>> round(hindrance_khan_richardson(solids_volume_fraction=0.1, reynolds=0.5), 4)
    0.6243
    >>> round(hindrance_khan_richardson(solids_volume_fraction=0.1, reynolds=1e-9), 4)
    0.6031
    """
    return (1.0 - solids_volume_fraction) ** settling_exponent_khan_richardson(reynolds)


@formula(
    source="barnea1973",
    equation=(
        r"\frac{v}{v_t} = \sqrt{\frac{C_D}{C_{D,\varphi}}\,\frac{1-\varphi}{1+\varphi^{1/3}}},\quad "
        r"C_{D,\varphi} = \left(0.63 + \frac{4.8}{\sqrt{\mathrm{Re}_\varphi}}\right)^2,\quad "
        r"\mathrm{Re}_\varphi = \frac{v}{v_t}\,\mathrm{Re}\,e^{-5\varphi/3(1-\varphi)}"
    ),
    fitted={"solids_volume_fraction": (0.0, 0.6)},
)
def hindrance_barnea_mizrahi(solids_volume_fraction: Solids, reynolds: PositiveNumber) -> Ratio:
    """Hindered over terminal velocity by Barnea and Mizrahi, from creeping to turbulent flow.

    Solved in closed form. Creeping limit (1 − φ)/[(1 + φ^⅓) exp(5φ/3(1 − φ))].

    >>> round(hindrance_barnea_mizrahi(solids_volume_fraction=0.1, reynolds=0.5), 4)
    0.5406
    >>> round(hindrance_barnea_mizrahi(solids_volume_fraction=0.1, reynolds=1e-9), 4)
    0.5108
    """
    phi, Re = solids_volume_fraction, reynolds
    alone = 0.63 + 4.8 / jnp.sqrt(Re)
    a = alone * jnp.sqrt((1.0 - phi) / (1.0 + jnp.cbrt(phi)))
    b = 4.8 * jnp.exp(5.0 * phi / (6.0 * (1.0 - phi))) / jnp.sqrt(Re)
    return (2.0 * a / (b + jnp.sqrt(b**2 + 4.0 * 0.63 * a))) ** 2


@formula(
    source="steinour1944",
    equation=r"\frac{v}{v_t} = (1-\varphi)^2\,10^{-1.82\varphi},\quad \mathrm{Re} \to 0",
    fitted={"reynolds": (0.0, 0.2), "solids_volume_fraction": (0.0, 0.5)},
)
def hindrance_steinour(solids_volume_fraction: Solids, reynolds: PositiveNumber) -> Ratio:
    """Hindered over terminal velocity of spheres in creeping flow by Steinour.

    >>> round(hindrance_steinour(solids_volume_fraction=0.1, reynolds=0.01), 4)
    0.5327
    """
    phi = solids_volume_fraction
    return jnp.broadcast_arrays((1.0 - phi) ** 2 * 10.0 ** (-1.82 * phi), reynolds)[0]


@formula(
    source="happel1958",
    equation=(
        r"\frac{v}{v_t} = \frac{3 - \frac92\gamma + \frac92\gamma^5 - 3\gamma^6}{3 + 2\gamma^5},\quad "
        r"\gamma = \varphi^{1/3},\quad \mathrm{Re} \to 0"
    ),
    fitted={"reynolds": (0.0, 0.2)},
)
def hindrance_happel(solids_volume_fraction: Solids, reynolds: PositiveNumber) -> Ratio:
    """Hindered over terminal velocity of spheres in creeping flow by Happel's cell with a free surface.

    >>> round(hindrance_happel(solids_volume_fraction=0.1, reynolds=0.01), 4)
    0.3215
    """
    c = jnp.cbrt(solids_volume_fraction)
    return jnp.broadcast_arrays((3.0 - 4.5 * c + 4.5 * c**5 - 3.0 * c**6) / (3.0 + 2.0 * c**5), reynolds)[0]


@formula(
    source="batchelor1972",
    equation=r"\frac{v}{v_t} = 1 - 6.55\,\varphi,\quad \mathrm{Re} \to 0",
    fitted={"reynolds": (0.0, 0.1), "solids_volume_fraction": (0.0, 0.03)},
    typical={"solids_volume_fraction": (1e-3, 0.03)},
)
def hindrance_batchelor(solids_volume_fraction: Solids, reynolds: PositiveNumber) -> Ratio:
    """Hindered over terminal velocity of a dilute random suspension of spheres in creeping flow by Batchelor.

    >>> round(hindrance_batchelor(solids_volume_fraction=0.01, reynolds=0.01), 4)
    0.9345
    """
    return jnp.broadcast_arrays(jnp.maximum(1.0 - 6.55 * solids_volume_fraction, 0.0), reynolds)[0]


@law(
    "hindrance",
    name="richardson_zaki",
    source="richardson1954",
    equation=r"\frac{v}{v_t} = k\,(1 - \varphi)^{n}",
    fitted={"solids_volume_fraction": (0.0, 0.6)},
)
class RichardsonZaki(eqx.Module):
    """Hindrance law k(1 − φ)ⁿ with a fixed exponent, or with Richardson and Zaki's exponent when none is
    given.

        A prefactor of 0.8 to 0.9 is often measured in fluidized beds.

    >>> round(float(RichardsonZaki(exponent=4.65)(0.1, 0.01)), 4)
    0.6127
    """

    exponent: PositiveNumber | None = None
    wall_ratio: WallRatio = 0.0
    prefactor: PositiveNumber = 1.0

    def __call__(self, solids_volume_fraction: Solids, reynolds: PositiveNumber) -> Ratio:
        """Hindered over terminal velocity."""
        n = (
            settling_exponent_richardson_zaki(reynolds, self.wall_ratio)
            if self.exponent is None
            else self.exponent
        )
        return self.prefactor * (1.0 - solids_volume_fraction) ** n


@formula(
    source="richardson1954; masliyah1979",
    equation=r"v = v_t\,f(\varphi, \mathrm{Re})",
)
def hindered_velocity(
    terminal_velocity: Velocity,
    solids_volume_fraction: Solids,
    reynolds: PositiveNumber,
    hindrance: Annotated[Any, Law("hindrance")] = hindrance_richardson_zaki,
) -> Velocity:
    """Velocity of a crowd of equal particles relative to the vessel, by any hindrance law.

    >>> round(hindered_velocity(terminal_velocity=1e-3, solids_volume_fraction=0.1, reynolds=0.01), 7)
    0.0006127
    """
    return terminal_velocity * hindrance(solids_volume_fraction, reynolds)
