"""Dust explosions: vents that hold the pressure down, and nitrogen that keeps them from happening."""

from __future__ import annotations

from typing import Annotated

import jax.numpy as jnp

from granum.core import formula, impossible
from granum.core.kinds import (
    AreaOrZero,
    MoleFraction,
    PositiveNumber,
    PressureDrop,
    Volume,
    VolumeFlow,
    Within,
)
from granum.dust.formulas.emission import AIR_OXYGEN
from granum.dust.kinds import DeflagrationIndex

BAR = 1e5
LITTLE_OXYGEN = 0.05  # of dusts, mostly of metals, that burn with very little
CONTAINED = "The vessel bears the whole explosion: it needs no vent."
OPENS_LATE = "The vent must open before the pressure that the vessel may reach."
NOT_INERT = "The oxygen allowed must lie between that of the inert gas and that of air."
_VESSEL = {
    "volume": (1.0, 100.0),
    "deflagration_index": (50.0 * BAR, 200.0 * BAR),
    "explosion_pressure": (7.0 * BAR, 10.0 * BAR),
    "reduced_pressure": (0.2 * BAR, 1.0 * BAR),
    "activation_pressure": (0.1 * BAR, 0.2 * BAR),
}


@formula(
    source="en14491_2012",
    equation=(
        r"A = \left[3.264\cdot10^{-5}\,p_{max}\,K_{St}\,p_{red}^{-0.569} + 0.27\,(p_{stat} - 0.1)\,"
        r"p_{red}^{-0.5}\right]V^{0.753}\left(1 + C\,\log_{10}(L/D)\right),\quad "
        r"C = \max(0.758 - 4.305\,\log_{10}p_{red},\ 0)"
    ),
    fitted={
        "volume": (0.1, 1e4),
        "explosion_pressure": (5.0 * BAR, 10.0 * BAR),
        "deflagration_index": (10.0 * BAR, 300.0 * BAR),
        "reduced_pressure": (0.1 * BAR, 2.0 * BAR),
        "activation_pressure": (0.1 * BAR, 1.0 * BAR),
        "length_to_diameter": (1.0, 20.0),
    },
    typical=_VESSEL,
    output="vent_area",
    title="Area of an explosion vent (EN 14491)",
)
def vent_area_en14491(
    volume: Volume,
    deflagration_index: DeflagrationIndex,
    explosion_pressure: PressureDrop,
    reduced_pressure: PressureDrop,
    activation_pressure: PressureDrop,
    length_to_diameter: Annotated[PositiveNumber, Within(1.0, 100.0)] = 1.0,
) -> AreaOrZero:
    """Area of vents without ducts that keeps a dust explosion in a vessel below a gauge pressure.

    Pressures are gauge and count in bar. Constants recalled, not opened; the correction for slender vessels
    ends at 1.5 bar, as the standard says, and a compact vessel agrees with NFPA 68. A design needs the
    standard itself.

    By hand: 10 m³, 100 bar m/s, 9 bar, 0.5 bar, 0.1 bar: 3.264e-5·900·0.5^−0.569·10^0.753.

    >>> round(
    ...     vent_area_en14491(10.0, "100 bar*m/s", "9 bar", reduced_pressure=5e4, activation_pressure=1e4), 3
    ... )
    0.247
    """
    late = activation_pressure > reduced_pressure
    impossible(late, activation_pressure, "activation_pressure", 0.0, reduced_pressure, OPENS_LATE)
    red = reduced_pressure / BAR
    first = 3.264e-5 * explosion_pressure / BAR * deflagration_index / BAR * red**-0.569
    second = 0.27 * (activation_pressure / BAR - 0.1) * red**-0.5
    slender = jnp.maximum(0.758 - 4.305 * jnp.log10(red), 0.0)
    found = (first + second) * volume**0.753 * (1.0 + slender * jnp.log10(length_to_diameter))
    return jnp.where(late, jnp.nan, jnp.maximum(found, 0.0))


@formula(
    source="nfpa68_2013",
    equation=(
        r"A = 10^{-4}\left(1 + 1.54\,p_{stat}^{4/3}\right)K_{St}\,V^{3/4}\sqrt{\frac{p_{max}}{p_{red}} - 1}"
    ),
    fitted={
        "volume": (0.1, 1e4),
        "explosion_pressure": (5.0 * BAR, 12.0 * BAR),
        "deflagration_index": (10.0 * BAR, 800.0 * BAR),
        "activation_pressure": (0.0, 0.75 * BAR),
    },
    typical=_VESSEL,
    output="vent_area",
    title="Area of an explosion vent (NFPA 68)",
)
def vent_area_nfpa68(
    volume: Volume,
    deflagration_index: DeflagrationIndex,
    explosion_pressure: PressureDrop,
    reduced_pressure: PressureDrop,
    activation_pressure: PressureDrop,
) -> AreaOrZero:
    """Area of vents without ducts that keeps a dust explosion in a compact vessel, at most twice as long as
    wide, below a gauge pressure.

    Pressures are gauge and count in bar. Constants recalled, not opened; turbulence, partial volumes and
    heavy panels add to it. A design needs the standard itself.

    By hand: 10 m³, 100 bar m/s, 9 bar, 0.5 bar, 0.1 bar: 1e-4·1.0715·100·5.623·√17.

    >>> round(
    ...     vent_area_nfpa68(10.0, "100 bar*m/s", "9 bar", reduced_pressure=5e4, activation_pressure=1e4), 3
    ... )
    0.248
    """
    late = activation_pressure > reduced_pressure
    impossible(late, activation_pressure, "activation_pressure", 0.0, reduced_pressure, OPENS_LATE)
    held = reduced_pressure >= explosion_pressure
    impossible(held, reduced_pressure, "reduced_pressure", 0.0, explosion_pressure, CONTAINED)
    left = jnp.where(held, 1.0, explosion_pressure / reduced_pressure - 1.0)
    early = 1.0 + 1.54 * (activation_pressure / BAR) ** (4.0 / 3.0)
    found = 1e-4 * early * deflagration_index / BAR * volume**0.75 * jnp.sqrt(left)
    return jnp.where(late | held, jnp.nan, found)


@formula(
    source="nfpa69_2019, § 7.7; eckhoff2003, p. 69",
    equation=(
        r"x_{max} = x_{LOC} - 0.02\ (x_{LOC}\ge 0.05),\quad 0.6\,x_{LOC}\ (x_{LOC}<0.05);\qquad "
        r"x_{max}' = 0.6\,x_{LOC}\ (x_{LOC}\ge 0.05),\quad 0.4\,x_{LOC}\ (x_{LOC}<0.05)"
    ),
    typical={"limiting_oxygen": (0.06, 0.15)},
    output="oxygen_permitted",
    title="Oxygen permitted in a plant under nitrogen (NFPA 69)",
)
def oxygen_permitted_nfpa69(
    limiting_oxygen: Annotated[MoleFraction, Within(0.0, AIR_OXYGEN)], oxygen_watched: bool = False
) -> MoleFraction:
    """Oxygen that a plant in nitrogen may hold: two volume percent below the limiting oxygen where it is
    measured all the time, else six tenths of it; smaller shares for dusts that burn with very little.

    Recalled, not opened; Eckhoff (read) has 2 to 3 % below the tested limit recommended. The primed form is
    that of oxygen not watched. By hand, starch with a limit of 9 %, watched and not:

    >>> round(oxygen_permitted_nfpa69(0.09, True), 3), round(oxygen_permitted_nfpa69(0.09), 3)
    (0.07, 0.054)
    """
    x, little = limiting_oxygen, limiting_oxygen < LITTLE_OXYGEN
    watched = jnp.where(little, 0.6 * x, x - 0.02)
    return watched if oxygen_watched else jnp.where(little, 0.4 * x, 0.6 * x)


@formula(
    source="en15281_2022",
    equation=r"Q_n = Q\,\frac{0.2095 - x}{x - x_i}",
    typical={"volume_flow": (1e-4, 0.1), "oxygen_fraction": (0.04, 0.12), "oxygen_inert": (0.0, 0.02)},
    output="inert_gas_flow",
    title="Inert gas that holds the oxygen down",
    symbols={"volume_flow": "Q"},
)
def inert_gas_flow_steady(
    volume_flow: VolumeFlow,
    oxygen_fraction: Annotated[MoleFraction, Within(0.0, AIR_OXYGEN)],
    oxygen_inert: Annotated[MoleFraction, Within(0.0, AIR_OXYGEN)] = 0.0,
) -> VolumeFlow:
    """Flow of nitrogen that keeps the oxygen of a plant at a share while air leaks in at a flow.

    The share to hold is that of ``oxygen_permitted_nfpa69`` at most. The balance is that of a mixed volume.

    By hand: 10 m³/h of air held at 8 %, 10·12.95/8 m³/h.

    >>> round(inert_gas_flow_steady("10 m^3/hour", 0.08) * 3600, 2)
    16.19
    """
    between = (oxygen_fraction > oxygen_inert) & (oxygen_fraction <= AIR_OXYGEN)
    impossible(~between, oxygen_fraction, "oxygen_fraction", oxygen_inert, AIR_OXYGEN, NOT_INERT)
    apart = jnp.where(between, oxygen_fraction - oxygen_inert, 1.0)
    return jnp.where(between, volume_flow * (AIR_OXYGEN - oxygen_fraction) / apart, jnp.nan)
