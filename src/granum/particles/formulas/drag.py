"""Drag of a sphere, classical laws: Stokes, Oseen, Allen, Newton and the sums and tables that join them."""

from __future__ import annotations

import jax.numpy as jnp

from granum.core import formula
from granum.core.kinds import PositiveNumber


@formula(
    source="stokes1851; clift1978, eq. 3-15",
    equation=r"C_D = \frac{24}{\mathrm{Re}}",
    fitted={"reynolds": (0.0, 0.2)},
)
def drag_coefficient_stokes(reynolds: PositiveNumber) -> PositiveNumber:
    """Drag coefficient of a sphere in creeping flow.

    Exact as Re → 0; 4 % below the measured drag at Re = 0.2 and 12 % at Re = 1, the two ends in use.

    >>> drag_coefficient_stokes(reynolds=0.2)
    120.0
    """
    return 24.0 / reynolds


@formula(
    source="oseen1927; clift1978, eq. 3-40",
    equation=r"C_D = \frac{24}{\mathrm{Re}}\left(1 + \frac{3}{16}\mathrm{Re}\right)",
    fitted={"reynolds": (0.0, 1.0)},
)
def drag_coefficient_oseen(reynolds: PositiveNumber) -> PositiveNumber:
    """Drag coefficient of a sphere in creeping flow with Oseen's first correction for inertia.

    Above the measured drag by 1 % at Re = 0.1 and 5 % at Re = 1.

    >>> drag_coefficient_oseen(reynolds=1.0)
    28.5
    """
    Re = reynolds
    return 24.0 / Re * (1.0 + 3.0 / 16.0 * Re)


@formula(
    source="proudman1957, eq. 3.39",
    equation=(
        r"C_D = \frac{24}{\mathrm{Re}}\left(1 + \frac{3}{16}\mathrm{Re} + \frac{9}{160}\mathrm{Re}^2 "
        r"\ln\frac{\mathrm{Re}}{2}\right)"
    ),
    fitted={"reynolds": (0.0, 1.0)},
    typical={"reynolds": (1e-3, 1.0)},
)
def drag_coefficient_proudman_pearson(reynolds: PositiveNumber) -> PositiveNumber:
    """Drag coefficient of a sphere from matched expansions in a small Reynolds number.

    The next term after Oseen's. The series is asymptotic: it serves below Re = 1 only and turns negative
    above about 10.

    >>> round(drag_coefficient_proudman_pearson(reynolds=1.0), 2)
    27.56
    """
    Re = reynolds
    return 24.0 / Re * (1.0 + 3.0 / 16.0 * Re + 9.0 / 160.0 * Re**2 * jnp.log(Re / 2.0))


@formula(
    source="allen1900; perry2008, section 6",
    equation=r"C_D = 18.5\,\mathrm{Re}^{-0.6}",
    fitted={"reynolds": (0.2, 1000.0)},
)
def drag_coefficient_allen(reynolds: PositiveNumber) -> PositiveNumber:
    """Drag coefficient of a sphere in the intermediate regime, a single power.

    The range in use is 0.2 to 500 for the criteria X and Y and 1 to 1000 in most tables. Against measured
    drag it is low by 60 % at Re = 0.2, 32 % at Re = 1 and 38 % at Re = 1000, within 15 % only from Re =
    2.5 to 400.

    >>> drag_coefficient_allen(reynolds=1.0)
    18.5
    """
    return 18.5 * reynolds**-0.6


@formula(
    source="newton1687; perry2008, section 6",
    equation=r"C_D(\mathrm{Re}) = 0.44",
    fitted={"reynolds": (500.0, 2e5)},
)
def drag_coefficient_newton(reynolds: PositiveNumber) -> PositiveNumber:
    """Drag coefficient of a sphere in the turbulent regime, a constant.

    Measured drag lies between 0.39 and 0.50 from Re = 1000 to 200 000.

    >>> drag_coefficient_newton(reynolds=1e4)
    0.44
    """
    return jnp.full_like(jnp.asarray(reynolds, dtype=float), 0.44)


@formula(
    source="fair1954",
    equation=r"C_D = \frac{24}{\mathrm{Re}} + \frac{3}{\sqrt{\mathrm{Re}}} + 0.34",
    fitted={"reynolds": (0.5, 1e4)},
)
def drag_coefficient_fair_geyer(reynolds: PositiveNumber) -> PositiveNumber:
    """Drag coefficient of a sphere by the three-term sum used in water treatment.

    >>> round(drag_coefficient_fair_geyer(reynolds=100.0), 4)
    0.88
    """
    Re = reynolds
    return 24.0 / Re + 3.0 / jnp.sqrt(Re) + 0.34


@formula(
    source="dallavalle1948",
    equation=r"C_D = \left(0.6324 + \frac{4.8}{\sqrt{\mathrm{Re}}}\right)^2",
    fitted={"reynolds": (0.0, 2e5)},
)
def drag_coefficient_dalla_valle(reynolds: PositiveNumber) -> PositiveNumber:
    """Drag coefficient of a sphere by Dalla Valle's square, the form behind many explicit settling formulas.

    >>> round(drag_coefficient_dalla_valle(reynolds=100.0), 4)
    1.2374
    """
    return (0.6324 + 4.8 / jnp.sqrt(reynolds)) ** 2


@formula(
    source="abraham1970, eq. 6",
    equation=r"C_D = \frac{24}{9.06^2}\left(1 + \frac{9.06}{\sqrt{\mathrm{Re}}}\right)^2",
    fitted={"reynolds": (0.0, 6000.0)},
)
def drag_coefficient_abraham(reynolds: PositiveNumber) -> PositiveNumber:
    """Drag coefficient of a sphere from boundary-layer reasoning.

    >>> round(drag_coefficient_abraham(reynolds=100.0), 4)
    1.0622
    """
    return 24.0 / 9.06**2 * (1.0 + 9.06 / jnp.sqrt(reynolds)) ** 2


@formula(
    source="kaskas1964; brauer1971",
    equation=r"C_D = \frac{24}{\mathrm{Re}} + \frac{4}{\sqrt{\mathrm{Re}}} + 0.4",
    fitted={"reynolds": (0.0, 2e5)},
)
def drag_coefficient_kaskas(reynolds: PositiveNumber) -> PositiveNumber:
    """Drag coefficient of a sphere by the three-term sum used in mechanical process engineering.

    >>> drag_coefficient_kaskas(reynolds=100.0)
    1.04
    """
    Re = reynolds
    return 24.0 / Re + 4.0 / jnp.sqrt(Re) + 0.4


FIVE_RANGES = (
    (1.0, 24.0, 1.0),
    (10.0, 26.0, 0.77),
    (100.0, 20.0, 0.65),
    (1000.0, 4.92, 0.346),
    (jnp.inf, 0.44, 0.0),
)
"""Upper Reynolds number, factor a and exponent n of C_D = a Re^-n, range by range."""


@formula(
    source="degremont2007, sedimentation of discrete particles",
    title="Drag coefficient in five ranges",
    equation=(
        r"C_D = a\,\mathrm{Re}^{-n},\ (a,n) = "
        r"(24,1)_{<1},\ (26,0.77)_{<10},\ (20,0.65)_{<100},\ (4.92,0.346)_{<1000},\ (0.44,0)"
    ),
    fitted={"reynolds": (1e-4, 2e5)},
)
def drag_coefficient_five_ranges(reynolds: PositiveNumber) -> PositiveNumber:
    """Drag coefficient of a sphere by a table of five powers of the Reynolds number.

    It jumps by 8 % at Re = 1, 1.4 % at Re = 10 and less at the other joints. Below Re = 1e-4 Brownian motion
    overrides the fall. Differs from the print: the course table writes the upper limits 10⁻³ for 10³.

    >>> round(drag_coefficient_five_ranges(reynolds=50.0), 3)
    1.573
    """
    Re = reynolds
    bounds = jnp.asarray([upper for upper, _, _ in FIVE_RANGES[:-1]])
    index = jnp.searchsorted(bounds, Re, side="right")
    a = jnp.asarray([a for _, a, _ in FIVE_RANGES])[index]
    n = jnp.asarray([n for _, _, n in FIVE_RANGES])[index]
    return a * Re**-n
