"""The dimensionless numbers of a particle in a fluid, spelled out for the equations of cards."""

from __future__ import annotations

ARCHIMEDES = r",\quad \mathrm{Ar} = \frac{g\,d_p^3\,\rho_f\,(\rho_p - \rho_f)}{\eta^2}"
GALILEO = r",\quad \mathrm{Ga} = \frac{g\,d_p^3\,\rho_f^2}{\eta^2}"
SIZE_AND_VELOCITY = r",\quad d_* = \mathrm{Ar}^{1/3},\ u_* = \mathrm{Re}\,\mathrm{Ar}^{-1/3}"


def reynolds_of(velocity: str, index: str = "") -> str:
    r"""The Reynolds number of a particle at a velocity.

    >>> reynolds_of("U_{mf}", "mf")
    ',\\quad \\mathrm{Re}_{mf} = \\frac{\\rho_f\\,U_{mf}\\,d_p}{\\eta}'
    """
    number = r"\mathrm{Re}" + (f"_{{{index}}}" if index else "")
    return rf",\quad {number} = \frac{{\rho_f\,{velocity}\,d_p}}{{\eta}}"


def velocity_of(velocity: str, index: str = "") -> str:
    r"""A velocity that comes out as a Reynolds number of the particle.

    >>> velocity_of("v_t")
    ',\\quad v_t = \\frac{\\mathrm{Re}\\,\\eta}{\\rho_f\\,d_p}'
    """
    number = r"\mathrm{Re}" + (f"_{{{index}}}" if index else "")
    return rf",\quad {velocity} = \frac{{{number}\,\eta}}{{\rho_f\,d_p}}"
