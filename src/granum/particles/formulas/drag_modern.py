"""Drag of a sphere, laws that cover creeping to turbulent flow in one expression, most accurate first in the
docs' ranking.
"""

from __future__ import annotations

from typing import Any

import jax.numpy as jnp

from granum.core import formula
from granum.core.kinds import PositiveNumber


@formula(
    source="brown2003, eq. 19",
    equation=r"C_D = \frac{24}{\mathrm{Re}}\left(1 + 0.150\,\mathrm{Re}^{0.681}\right) + \frac{0.407}{1 + 8710/\mathrm{Re}}",  # noqa: E501
    fitted={"reynolds": (0.0, 2e5)},
)
def drag_coefficient_brown_lawler(reynolds: PositiveNumber) -> PositiveNumber:
    """Drag coefficient of a sphere, fitted to 480 measurements freed of the wall effect.

    Stated accuracy about 4 %. The default law of this package.

    >>> round(drag_coefficient_brown_lawler(reynolds=1.0), 2)
    27.6
    """
    Re = reynolds
    return 24.0 / Re * (1.0 + 0.150 * Re**0.681) + 0.407 / (1.0 + 8710.0 / Re)


@formula(
    source="schiller1933, p. 320",
    equation=r"C_D = \frac{24}{\mathrm{Re}}\left(1 + 0.15\,\mathrm{Re}^{0.687}\right)",
    fitted={"reynolds": (0.0, 800.0)},
)
def drag_coefficient_schiller_naumann(reynolds: PositiveNumber) -> PositiveNumber:
    """Drag coefficient of a sphere, Stokes law with Schiller and Naumann's inertial correction.

    Within 5 % of the standard drag curve over the fitted range.

    >>> round(drag_coefficient_schiller_naumann(reynolds=1.0), 2)
    27.6
    """
    Re = reynolds
    return 24.0 / Re * (1.0 + 0.15 * Re**0.687)


@formula(
    source="clift1971",
    equation=r"C_D = \frac{24}{\mathrm{Re}}\left(1 + 0.15\,\mathrm{Re}^{0.687}\right) + \frac{0.42}{1 + 42500\,\mathrm{Re}^{-1.16}}",  # noqa: E501
    fitted={"reynolds": (0.0, 3e5)},
)
def drag_coefficient_clift_gauvin(reynolds: PositiveNumber) -> PositiveNumber:
    """Drag coefficient of a sphere, Schiller and Naumann's law continued to the drag crisis.

    Stated accuracy 6 %.

    >>> round(drag_coefficient_clift_gauvin(reynolds=1000.0), 4)
    0.4662
    """
    Re = reynolds
    return 24.0 / Re * (1.0 + 0.15 * Re**0.687) + 0.42 / (1.0 + 42500.0 * Re**-1.16)


@formula(
    source="turton1986",
    equation=r"C_D = \frac{24}{\mathrm{Re}}\left(1 + 0.173\,\mathrm{Re}^{0.657}\right) + \frac{0.413}{1 + 16300\,\mathrm{Re}^{-1.09}}",  # noqa: E501
    fitted={"reynolds": (0.0, 2e5)},
)
def drag_coefficient_turton_levenspiel(reynolds: PositiveNumber) -> PositiveNumber:
    """Drag coefficient of a sphere, fitted to 408 measurements in the form of Clift and Gauvin.

    >>> round(drag_coefficient_turton_levenspiel(reynolds=1000.0), 4)
    0.4547
    """
    Re = reynolds
    return 24.0 / Re * (1.0 + 0.173 * Re**0.657) + 0.413 / (1.0 + 16300.0 * Re**-1.09)


@formula(
    source="cheng2009, eq. 2",
    equation=r"C_D = \frac{24}{\mathrm{Re}}(1 + 0.27\,\mathrm{Re})^{0.43} + 0.47\left[1 - \exp(-0.04\,\mathrm{Re}^{0.38})\right]",  # noqa: E501
    fitted={"reynolds": (0.0, 2e5)},
)
def drag_coefficient_cheng(reynolds: PositiveNumber) -> PositiveNumber:
    """Drag coefficient of a sphere, fitted to the data that Brown and Lawler freed of the wall effect.

    Stated mean error 2.5 %.

    >>> round(drag_coefficient_cheng(reynolds=200.0), 4)
    0.7939
    """
    Re = reynolds
    return 24.0 / Re * (1.0 + 0.27 * Re) ** 0.43 + 0.47 * (1.0 - jnp.exp(-0.04 * Re**0.38))


@formula(
    source="barati2014, eq. 22",
    equation=r"C_D = 5.4856\cdot10^9\tanh\frac{4.3774\cdot10^{-9}}{\mathrm{Re}} + 0.0709\tanh\frac{700.6574}{\mathrm{Re}}"  # noqa: E501
    r" + 0.3894\tanh\frac{74.1539}{\mathrm{Re}} - 0.1198\tanh\frac{7429.0843}{\mathrm{Re}}"
    r" + 1.7174\tanh\frac{9.9851}{\mathrm{Re}+2.3384} + 0.4744",
    fitted={"reynolds": (0.002, 2e5)},
)
def drag_coefficient_barati(reynolds: PositiveNumber) -> PositiveNumber:
    """Drag coefficient of a sphere, found by genetic programming on the corrected measurements.

    Stated sum of squared errors smaller than that of 20 other laws.

    >>> round(drag_coefficient_barati(reynolds=200.0), 4)
    0.7682
    """
    q = 1.0 / reynolds
    return (
        5.4856e9 * jnp.tanh(4.3774e-9 * q)
        + 0.0709 * jnp.tanh(700.6574 * q)
        + 0.3894 * jnp.tanh(74.1539 * q)
        - 0.1198 * jnp.tanh(7429.0843 * q)
        + 1.7174 * jnp.tanh(9.9851 / (reynolds + 2.3384))
        + 0.4744
    )


@formula(
    source="mikhailov2013",
    equation=r"C_D = \frac{3808\left[\frac{1617933}{2030} + \frac{178861}{1063}\mathrm{Re} + \frac{1219}{1084}\mathrm{Re}^2\right]}"  # noqa: E501
    r"{681\,\mathrm{Re}\left[\frac{77531}{422} + \frac{13529}{976}\mathrm{Re} - \frac{1}{71154}\mathrm{Re}^2\right]}",  # noqa: E501
    fitted={"reynolds": (0.1, 118300.0)},
)
def drag_coefficient_mikhailov_freire(reynolds: PositiveNumber) -> PositiveNumber:
    """Drag coefficient of a sphere, a rational function from Goldstein's series by a Shanks transform.

    Beyond its range it has a pole, near Re = 990 000; there it is held at its last fitted slope.

    >>> round(drag_coefficient_mikhailov_freire(reynolds=200.0), 4)
    0.7514
    """
    Re = jnp.minimum(reynolds, 5e5)
    above = 3808.0 * (1617933.0 / 2030.0 + 178861.0 / 1063.0 * Re + 1219.0 / 1084.0 * Re**2)
    below = 681.0 * Re * (77531.0 / 422.0 + 13529.0 / 976.0 * Re - Re**2 / 71154.0)
    return above / below


@formula(
    source="khan1987",
    equation=r"C_D = \left(2.49\,\mathrm{Re}^{-0.328} + 0.34\,\mathrm{Re}^{0.067}\right)^{3.18}",
    fitted={"reynolds": (0.01, 3e5)},
)
def drag_coefficient_khan_richardson(reynolds: PositiveNumber) -> PositiveNumber:
    """Drag coefficient of a sphere by two added powers of the Reynolds number.

    The form C_D = 2 R'/(ρu²) of the original's R'/(ρu²) = (1.84 Re^-0.31 + 0.293 Re^0.06)^3.45 as later
    refitted. It does not tend to Stokes' law: 10 % off at Re = 1e-3 and more below.

    >>> round(drag_coefficient_khan_richardson(reynolds=200.0), 4)
    0.7748
    """
    Re = reynolds
    return (2.49 * Re**-0.328 + 0.34 * Re**0.067) ** 3.18


@formula(
    source="swamee1991",
    equation=r"C_D = 0.5\left\{16\left[\left(\frac{24}{\mathrm{Re}}\right)^{1.6} + \left(\frac{130}{\mathrm{Re}}\right)^{0.72}\right]^{2.5}"  # noqa: E501
    r" + \left[\left(\frac{40000}{\mathrm{Re}}\right)^2 + 1\right]^{-0.25}\right\}^{0.25}",
    fitted={"reynolds": (0.0, 1.5e5)},
)
def drag_coefficient_swamee_ojha(reynolds: PositiveNumber) -> PositiveNumber:
    """Drag coefficient of a sphere by matched powers.

    >>> round(drag_coefficient_swamee_ojha(reynolds=200.0), 4)
    0.849
    """
    Re = reynolds
    slow = 16.0 * ((24.0 / Re) ** 1.6 + (130.0 / Re) ** 0.72) ** 2.5
    return 0.5 * (slow + ((40000.0 / Re) ** 2 + 1.0) ** -0.25) ** 0.25


@formula(
    source="flemmer1986",
    equation=r"C_D = \frac{24}{\mathrm{Re}}10^{E},\quad E = 0.261\,\mathrm{Re}^{0.369} - 0.105\,\mathrm{Re}^{0.431}"  # noqa: E501
    r" - \frac{0.124}{1 + (\log_{10}\mathrm{Re})^2}",
    fitted={"reynolds": (0.0, 8.6e4)},
    typical={"reynolds": (1e-2, 8e4)},
)
def drag_coefficient_flemmer_banks(reynolds: PositiveNumber) -> PositiveNumber:
    """Drag coefficient of a sphere by Flemmer and Banks.

    It falls far below the measured drag beyond its range (45 % at Re = 200 000).

    >>> round(drag_coefficient_flemmer_banks(reynolds=200.0), 3)
    0.747
    """
    Re = reynolds
    E = 0.261 * Re**0.369 - 0.105 * Re**0.431 - 0.124 / (1.0 + jnp.log10(Re) ** 2)
    return 24.0 / Re * 10.0**E


@formula(
    source="concha1979",
    equation=r"C_D = 0.284153\left(1 + \frac{9.04}{\sqrt{\mathrm{Re}}}\right)^2",
    fitted={"reynolds": (0.0, 1e4)},
)
def drag_coefficient_concha_almendra(reynolds: PositiveNumber) -> PositiveNumber:
    """Drag coefficient of a sphere by Concha and Almendra, which makes terminal velocity and diameter
    explicit.

    >>> round(drag_coefficient_concha_almendra(reynolds=100.0), 4)
    1.0301
    """
    return 0.284153 * (1.0 + 9.04 / jnp.sqrt(reynolds)) ** 2


@formula(
    source="morrison2013, eq. 8.83",
    equation=r"C_D = \frac{24}{\mathrm{Re}} + \frac{2.6\,(\mathrm{Re}/5)}{1 + (\mathrm{Re}/5)^{1.52}}"
    r" + \frac{0.411\,(\mathrm{Re}/263000)^{-7.94}}{1 + (\mathrm{Re}/263000)^{-8}} + \frac{\mathrm{Re}^{0.80}}{461000}",  # noqa: E501
    fitted={"reynolds": (0.0, 1e6)},
)
def drag_coefficient_morrison(reynolds: PositiveNumber) -> PositiveNumber:
    """Drag coefficient of a smooth sphere through the drag crisis, where the boundary layer turns turbulent.

    >>> round(drag_coefficient_morrison(reynolds=200.0), 3)
    0.768
    """
    Re = reynolds
    r = Re / 263000.0
    # r^-7.94 / (1 + r^-8) without overflow at small r
    return (
        24.0 / Re
        + 0.52 * Re / (1.0 + (Re / 5.0) ** 1.52)
        + 0.411 * r**0.06 / (r**8 + 1.0)
        + Re**0.80 / 461000.0
    )


@formula(
    source="almedeij2008",
    equation=r"C_D = \left[\frac{1}{(\varphi_1+\varphi_2)^{-1} + \varphi_3^{-1}} + \varphi_4\right]^{1/10},\quad"  # noqa: E501
    r"\varphi_1 = \left(\tfrac{24}{\mathrm{Re}}\right)^{10} + \left(21\mathrm{Re}^{-0.67}\right)^{10}"
    r" + \left(4\mathrm{Re}^{-0.33}\right)^{10} + 0.4^{10},\quad"
    r"\varphi_2 = \left[(0.148\mathrm{Re}^{0.11})^{-10} + 0.5^{-10}\right]^{-1},\quad"
    r"\varphi_3 = \left(1.57\cdot10^8\mathrm{Re}^{-1.625}\right)^{10},\quad"
    r"\varphi_4 = \left[(6\cdot10^{-17}\mathrm{Re}^{2.63})^{-10} + 0.2^{-10}\right]^{-1}",
    fitted={"reynolds": (0.0, 1e6)},
)
def drag_coefficient_almedeij(reynolds: PositiveNumber) -> PositiveNumber:
    """Drag coefficient of a smooth sphere through the drag crisis by matching of asymptotes.

    >>> round(drag_coefficient_almedeij(reynolds=200.0), 4)
    0.7115
    """
    Re = reynolds
    # Every asymptote relative to Stokes' law, so that nothing overflows as Re → 0.
    phi_1 = 1.0 + (21.0 / 24.0 * Re**0.33) ** 10 + (4.0 / 24.0 * Re**0.67) ** 10 + (0.4 / 24.0 * Re) ** 10
    phi_2 = (0.148 / 24.0 * Re**1.11) ** 10 / (1.0 + (0.148 / 0.5 * Re**0.11) ** 10)
    crisis = (24.0 / 1.57e8 * Re**0.625) ** 10
    late = jnp.minimum(6e-17 * Re**2.63, 1e3)
    phi_4 = (late * Re / 24.0) ** 10 / (1.0 + (late / 0.2) ** 10)
    return 24.0 / Re * (1.0 / (1.0 / (phi_1 + phi_2) + crisis) + phi_4) ** 0.1


@formula(
    source="clift1978, table 5.2",
    equation=r"\log_{10} C_D = f_i(\log_{10}\mathrm{Re})\ \text{over ten ranges}",
    fitted={"reynolds": (0.0, 1e6)},
    typical={"reynolds": (1e-2, 1e5)},
)
def drag_coefficient_clift_grace_weber(reynolds: PositiveNumber) -> PositiveNumber:
    """Standard drag curve of a smooth sphere, ten expressions over the whole range with the drag crisis.

    The usual reference for rigid spheres; the pieces meet within 1 %.

    >>> round(drag_coefficient_clift_grace_weber(reynolds=200.0), 4)
    0.7756
    """
    Re = reynolds
    w = jnp.log10(Re)

    def within(low: float, high: float) -> Any:
        return jnp.clip(w, low, high)  # keeps the unused pieces finite

    a, b, c, d = within(-2.0, 1.4), within(2.3, 3.3), within(3.0, 4.2), within(4.0, 6.1)
    pieces = (
        (0.01, 24.0 / Re + 3.0 / 16.0),
        (20.0, 24.0 / Re * (1.0 + 0.1315 * 10.0 ** (a * (0.82 - 0.05 * a)))),
        (260.0, 24.0 / Re * (1.0 + 0.1935 * Re**0.6305)),
        (1500.0, 10.0 ** (1.6435 - 1.1242 * b + 0.1558 * b**2)),
        (1.2e4, 10.0 ** (-2.4571 + 2.5558 * c - 0.9295 * c**2 + 0.1049 * c**3)),
        (4.4e4, 10.0 ** (-1.9181 + 0.6370 * d - 0.0636 * d**2)),
        (3.38e5, 10.0 ** (-4.3390 + 1.5809 * d - 0.1546 * d**2)),
        (4e5, 29.78 - 5.3 * d),
        (1e6, 0.1 * w - 0.49),
    )
    return jnp.select(
        [Re < upper for upper, _ in pieces], [value for _, value in pieces], 0.19 - 8e4 / jnp.maximum(Re, 1e6)
    )


MORSI = (
    (0.1, 0.0, 24.0, 0.0),
    (1.0, 3.690, 22.73, 0.0903),
    (10.0, 1.222, 29.1667, -3.8889),
    (100.0, 0.6167, 46.50, -116.67),
    (1000.0, 0.3644, 98.33, -2778.0),
    (5000.0, 0.357, 148.62, -4.75e4),
    (10000.0, 0.46, -490.546, 57.87e4),
    (jnp.inf, 0.5191, -1662.5, 5.4167e6),
)
"""Upper Reynolds number and the coefficients of C_D = k1 + k2/Re + k3/Re²."""


@formula(
    source="morsi1972, p. 207",
    equation=r"C_D = k_1 + \frac{k_2}{\mathrm{Re}} + \frac{k_3}{\mathrm{Re}^2}\ \text{over eight ranges}",
    fitted={"reynolds": (0.0, 5e4)},
)
def drag_coefficient_morsi_alexander(reynolds: PositiveNumber) -> PositiveNumber:
    """Drag coefficient of a sphere by eight quadratics in 1/Re, common in programs that track particles.

    Jumps of up to 2 % where the ranges meet.

    >>> round(drag_coefficient_morsi_alexander(reynolds=200.0), 4)
    0.7866
    """
    Re = reynolds
    index = jnp.searchsorted(jnp.asarray([row[0] for row in MORSI[:-1]]), Re, side="right")
    k1, k2, k3 = (jnp.asarray([row[i] for row in MORSI])[index] for i in (1, 2, 3))
    return k1 + k2 / Re + k3 / Re**2
