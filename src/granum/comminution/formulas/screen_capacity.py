"""Karra's vibrating screen: what a deck can pass, the size at which it cuts, and the area it needs."""

from __future__ import annotations

from typing import Annotated, Any, Literal

import jax.numpy as jnp

from granum.core import formula, impossible
from granum.core.kinds import (
    Angle,
    Area,
    Density,
    Distance,
    Fraction,
    Length,
    MassFlow,
    MassFlux,
    OpenFraction,
    PositiveNumber,
    Within,
)

TONNE_PER_HOUR = 1000.0 / 3600.0  # kg/s; the source counts t/(h m²), openings in mm
STANDARD_BULK_DENSITY = 1602.0  # 100 lb/ft³
LOAD_EXPONENT = 0.148
Wetting = Literal["dry", "wet"]
Deck = Literal[1, 2, 3]


@formula(
    source="karra1979",
    equation=r"h_T = (h + d_w)\cos\theta - d_w",
    typical={"aperture": (5e-3, 5e-2), "wire_diameter": (5e-4, 5e-3), "deck_inclination": (0.0, 0.4)},
    symbols={"aperture": "h"},
)
def throughfall_aperture(
    aperture: Length, wire_diameter: Distance = 0.0, deck_inclination: Angle = 0.0
) -> Length:
    """Opening that a falling particle meets on an inclined woven-wire deck. No value where the wires close
    it.

    >>> round(throughfall_aperture("25 mm", "5 mm", "20 degree") * 1e3, 2)
    23.19
    """
    h = (aperture + wire_diameter) * jnp.cos(deck_inclination) - wire_diameter
    impossible(
        h <= 0.0,
        deck_inclination,
        "deck_inclination",
        0.0,
        jnp.arccos(wire_diameter / (aperture + wire_diameter)),
    )
    return jnp.where(h > 0.0, h, jnp.nan)


def _basic(h: Any) -> Any:
    return jnp.where(h < 50.8, 12.1286 * jnp.maximum(h, 1e-9) ** 0.3162 - 10.2991, 0.3388 * h + 14.4122)


_FINEST = 1e-3 * (10.2991 / 12.1286) ** (1.0 / 0.3162)  # m, where the basic capacity is nil
NO_CAPACITY = (
    "Karra's capacity falls to zero there: give a finer screen its partition curve (comminution.screen)."
)


def _oversize(Q: Any) -> Any:
    return jnp.where(Q <= 0.87, 1.6 - 1.2 * Q, 4.275 - 4.25 * Q)


def _half_size(R: Any) -> Any:
    R = 100.0 * R
    some = jnp.maximum(R, 1.0)
    middle = jnp.where(R < 55.0, 0.1528 * some**0.564, 0.0061 * some**1.37)
    return jnp.where(R <= 30.0, 0.012 * R + 0.7, jnp.where(R < 80.0, middle, 0.05 * R - 1.5))


_WET = (
    (0.0, 1.0),
    (1.0, 1.0),
    (2.0, 2.0),
    (4.0, 2.5),
    (6.0, 2.5),
    (10.0, 2.0),
    (12.0, 1.5),
    (16.0, 1.3),
    (24.0, 1.2),
    (32.0, 1.15),
)


@formula(
    source="karra1979; king2012",
    equation=(
        r"\dot m''_U = A\,B\,C\,D\,E\,F\,G\ \mathrm{t\,h^{-1}\,m^{-2}},\quad A = 12.1286\,h_T^{0.3162} "
        r"- 10.2991\ (h_T < 50.8),\ 0.3388\,h_T + 14.4122,"
        r"\quad h_T\text{ in }\mathrm{mm},\quad B = B(Q),\ C = "
        r"C(R),\quad G = 0.844\,(1 - X_n)^{3.453}"
    ),
    fitted={"throughfall_aperture": (1e-3, 0.1)},
    typical={"throughfall_aperture": (3e-3, 5e-2), "open_area_fraction": (0.5, 0.7)},
)
def screening_capacity_karra(
    throughfall_aperture: Length,
    oversize_fraction: Fraction,
    half_size_fraction: Fraction,
    near_size_fraction: OpenFraction,
    deck: Deck = 1,
    wetting: Wetting = "dry",
    bulk_density: Density = STANDARD_BULK_DENSITY,
    open_area_fraction: OpenFraction | None = None,
) -> MassFlux:
    """Undersize in the feed per area that a vibrating screen takes while it still cuts at the throughfall
    aperture, by Karra.

    The product of basic capacity, oversize (B), half-size (C), deck (D), wet screening (E), bulk density (F)
    and near-size (G) factors: a closed form of the makers' charts. Fractions are those of the feed to the
    deck above the throughfall aperture, below half of it, and between three and five quarters of it. With an
    open area, the basic capacity of woven wire is scaled by it. Differs from the print: some reprints give
    the oversize factor above 87 % a plus sign and so a jump.

    >>> round(screening_capacity_karra("20 mm", "25 %", "40 %", "15 %") * 3.6, 2)
    16.07
    """
    h, X = throughfall_aperture * 1e3, near_size_fraction
    A = _basic(h)
    impossible(A <= 0.0, throughfall_aperture, "throughfall_aperture", _FINEST, jnp.inf, NO_CAPACITY)
    if open_area_fraction is not None:
        A = A * open_area_fraction / (0.215 * jnp.log10(h) + 0.37)
    points = jnp.array(_WET)
    E = jnp.interp(1.26 * h, points[:, 0], points[:, 1]) if wetting == "wet" else 1.0
    factors = (
        _oversize(oversize_fraction)
        * _half_size(half_size_fraction)
        * (1.1 - 0.1 * deck)
        * E
        * bulk_density
        / STANDARD_BULK_DENSITY
    )
    return jnp.where(A > 0.0, A, jnp.nan) * factors * 0.844 * (1.0 - X) ** 3.453 * TONNE_PER_HOUR


@formula(
    source="karra1979; king2012",
    fitted={"throughfall_aperture": (0.001, 0.1)},
    equation=r"\frac{d_{50}}{h_T} = \left(\frac{\dot m''}{\dot m''_U}\right)^{-0.148}",
    typical={
        "mass_flux_undersize": (1.0, 8.0),
        "screening_capacity": (1.0, 8.0),
        "throughfall_aperture": (3e-3, 5e-2),
    },
)
def cut_size_karra(
    throughfall_aperture: Length, mass_flux_undersize: MassFlux, screening_capacity: MassFlux
) -> Length:
    """Size that half passes a loaded vibrating screen: the more undersize per area, the finer the cut.

    The partition curve is that of Rosin and Rammler's form with the exponent 5.846. The law knows no upper
    limit for an idle screen.

    The apertures are those of ``screening_capacity_karra``.

    >>> round(cut_size_karra("20 mm", mass_flux_undersize=6.0, screening_capacity=3.0) * 1e3, 2)
    18.05
    """
    some = mass_flux_undersize > 0.0
    load = jnp.where(some, mass_flux_undersize, 1.0) / screening_capacity
    return throughfall_aperture * jnp.where(some, jnp.maximum(load, 1e-12) ** -LOAD_EXPONENT, jnp.inf)


@formula(
    source="karra1979",
    equation=r"A = \frac{\dot m_U}{\dot m''_U}\left(\frac{d_{50}}{h_T}\right)^{1/0.148}",
    typical={
        "mass_flow_undersize": (10.0, 60.0),
        "screening_capacity": (1.0, 8.0),
        "relative_cut_size": (0.8, 1.0),
    },
)
def screen_area_karra(
    mass_flow_undersize: MassFlow,
    screening_capacity: MassFlux,
    relative_cut_size: Annotated[PositiveNumber, Within(0.5, 1.5)] = 1.0,
) -> Area:
    """Area of a vibrating screen from the undersize in its feed, its capacity, and the cut size wanted over
    the throughfall aperture.

    >>> round(screen_area_karra("100 tonne/hour", screening_capacity=4.0), 2)
    6.94
    """
    return mass_flow_undersize / screening_capacity * relative_cut_size ** (1.0 / LOAD_EXPONENT)
