"""Thickener area from settling data: Kynch, Coe and Clevenger, Talmage and Fitch."""

from __future__ import annotations

from typing import Annotated

import jax.numpy as jnp

from granum.core import formula, impossible
from granum.core.kinds import (
    Area,
    Concentration,
    Density,
    Distance,
    Length,
    MassFlow,
    MassFlux,
    MassRatio,
    Series,
    Speed,
    Time,
    Velocity,
    VolumeFlow,
)
from granum.settling.kinds import UnitArea

DENSER = "A layer denser than the underflow limits nothing: any flux passes it."
SAME = "Both layers have one concentration: there is no boundary between them."

_TANGENT = {"intercept_height": (0.2, 0.35), "interface_height": (0.05, 0.15)}
_BETWEEN = {"underflow_concentration": (300.0, 600.0)}


@formula(
    source="kynch1952",
    equation=r"C_i = C_0\,\frac{h_0}{h_i}",
    symbols={"solids_concentration": "C_i"},
)
def solids_concentration_kynch(
    initial_concentration: Concentration, initial_height: Length, intercept_height: Length
) -> Concentration:
    """Concentration just under the interface, from the height where the tangent to the settling curve cuts
    the axis of heights.

    >>> round(
    ...     solids_concentration_kynch(
    ...         initial_concentration=236, initial_height="36 cm", intercept_height="18 cm"
    ...     ),
    ...     6,
    ... )
    472.0
    """
    return initial_concentration * initial_height / intercept_height


@formula(
    source="kynch1952",
    equation=r"v_i = \frac{h_i - h}{t}",
    typical={"intercept_height": (0.2, 0.35), "interface_height": (0.05, 0.15)},
    symbols={"settling_velocity": "v_i"},
)
def settling_velocity_kynch(intercept_height: Length, interface_height: Distance, time: Time) -> Velocity:
    """Settling velocity of the layer just under the interface: the slope of the tangent to the settling
    curve.

    >>> round(settling_velocity_kynch("18 cm", "8 cm", time="2 hour") * 3.6e5, 6)
    5.0
    """
    return (intercept_height - interface_height) / jnp.where(time > 0, time, jnp.inf)


@formula(
    source="kynch1952",
    equation=r"U = \frac{C_2 v_2 - C_1 v_1}{C_2 - C_1}",
    typical={"solids_concentration_above": (1.0, 5.0), "solids_concentration_below": (10.0, 50.0)},
    symbols={
        "solids_concentration_above": "C_1",
        "settling_velocity_above": "v_1",
        "solids_concentration_below": "C_2",
        "settling_velocity_below": "v_2",
    },
)
def shock_velocity_kynch(
    solids_concentration_above: Concentration,
    settling_velocity_above: Speed,
    solids_concentration_below: Concentration,
    settling_velocity_below: Speed,
) -> Velocity:
    """Velocity of the boundary between two layers, downwards: a sediment surface that rises is negative.

    >>> round(shock_velocity_kynch(0.2, 0.3897e-3, 0.5, 0.0) * 1e3, 4)
    -0.2598
    """
    fall = (
        solids_concentration_below * settling_velocity_below
        - solids_concentration_above * settling_velocity_above
    )
    gap = solids_concentration_below - solids_concentration_above
    impossible(gap == 0.0, solids_concentration_below, "solids_concentration_below", reason=SAME)
    return fall / jnp.where(gap == 0, jnp.nan, gap)


@formula(source="coe1916", equation=r"\frac{A}{\dot m_s} = \frac{1/C - 1/C_u}{v_s}", typical=_BETWEEN)
def unit_area_coe_clevenger(
    solids_concentration: Concentration, settling_velocity: Speed, underflow_concentration: Concentration
) -> UnitArea:
    """Area per solids flow that a layer of one concentration needs in a thickener; the greatest over all
    layers decides.

    Zero for layers denser than the underflow.

    >>> round(unit_area_coe_clevenger(200, "0.2 mm/s", 500), 6)
    15.0
    """
    return jnp.maximum(1.0 / solids_concentration - 1.0 / underflow_concentration, 0.0) / settling_velocity


@formula(
    source="coe1916",
    equation=r"A = \dot m_s \max_i \frac{1/C_i - 1/C_u}{v_i}",
    symbols={"mass_flow": r"\dot m_s"},
)
def thickener_area_coe_clevenger(
    mass_flow: MassFlow,
    series_concentrations: Annotated[Concentration, Series("tests")],
    series_velocities: Annotated[Speed, Series("tests")],
    underflow_concentration: Concentration,
) -> Area:
    """Thickener area from the settling velocities of a series of batch tests between feed and underflow
    concentration.

    The greatest of the areas of the tests: test closely enough around it. ``mass_flow`` is that of the
    solids.

    >>> round(
    ...     thickener_area_coe_clevenger(
    ...         2.0, [100, 200, 300], [4e-4, 2e-4, 1e-4], underflow_concentration=500
    ...     ),
    ...     6,
    ... )
    40.0
    """
    C, v = jnp.asarray(series_concentrations), jnp.asarray(series_velocities)
    return mass_flow * jnp.max(jnp.maximum(1.0 / C - 1.0 / underflow_concentration, 0.0) / v)


@formula(
    source="coe1916; richardson2002, eq. 5.36",
    title="Thickener area from liquid ratios",
    equation=r"A = \dot m_s \max_i \frac{U_i - W}{v_i\,\rho_l}",
    symbols={"mass_flow": r"\dot m_s"},
)
def thickener_area_liquid_ratio(
    mass_flow: MassFlow,
    series_liquid_ratios: Annotated[MassRatio, Series("tests")],
    series_velocities: Annotated[Speed, Series("tests")],
    underflow_liquid_ratio: MassRatio,
    liquid_density: Density,
) -> Area:
    """Thickener area after Coe and Clevenger from liquid-to-solid mass ratios, as mineral engineers measure
    dilution.

    >>> round(
    ...     thickener_area_liquid_ratio(
    ...         1.33, [5, 4.2, 3.7, 3.1, 2.5], [2e-4, 1.2e-4, 9.4e-5, 7e-5, 5e-5], 1.5, 1000
    ...     ),
    ...     1,
    ... )
    31.1
    """
    U, v = jnp.asarray(series_liquid_ratios), jnp.asarray(series_velocities)
    return mass_flow * jnp.max(jnp.maximum(U - underflow_liquid_ratio, 0.0) / v) / liquid_density


@formula(
    source="talmage1955",
    title="Interface height at the underflow concentration",
    equation=r"h_u = \frac{C_0 h_0}{C_u}",
    symbols={"interface_height": "h_u"},
)
def interface_height_underflow(
    initial_concentration: Concentration, initial_height: Length, underflow_concentration: Concentration
) -> Length:
    """Height at which all solids of a batch test would stand at the underflow concentration.

    >>> round(interface_height_underflow(236, "36 cm", 550) * 100, 2)
    15.45
    """
    return initial_concentration * initial_height / underflow_concentration


@formula(source="talmage1955", equation=r"A = \frac{Q\,t_u}{h_0}")
def thickener_area_talmage_fitch(
    volume_flow: VolumeFlow, underflow_time: Time, initial_height: Length
) -> Area:
    """Thickener area from one batch test: the time at which the tangent at the compression point reaches the
    underflow height.

    >>> round(thickener_area_talmage_fitch("100 m^3/hour", "45 min", "0.5 m"), 6)
    150.0
    """
    return volume_flow * underflow_time / initial_height


@formula(source="talmage1955", equation=r"\frac{A}{\dot m_s} = \frac{t_u}{C_0 h_0}")
def unit_area_talmage_fitch(
    underflow_time: Time, initial_concentration: Concentration, initial_height: Length
) -> UnitArea:
    """Area per solids flow from one batch test.

    >>> round(unit_area_talmage_fitch("45 min", 50.0, "0.5 m"), 6)
    108.0
    """
    return underflow_time / (initial_concentration * initial_height)


@formula(
    source="yoshioka1957",
    title="Solids flux that a layer lets pass",
    equation=r"G = \frac{v_s}{1/C - 1/C_u}",
    typical=_BETWEEN,
)
def solids_flux_layer(
    solids_concentration: Concentration, settling_velocity: Speed, underflow_concentration: Concentration
) -> MassFlux:
    """Solids flux that a layer of one concentration passes on to an underflow of another; unlimited when it
    is the denser.

    >>> round(solids_flux_layer(200, "0.2 mm/s", 500), 6)
    0.066667
    """
    gap = 1.0 / solids_concentration - 1.0 / underflow_concentration
    impossible(~(gap > 0), solids_concentration, "solids_concentration", 0.0, underflow_concentration, DENSER)
    return jnp.where(gap > 0, settling_velocity / jnp.where(gap > 0, gap, 1.0), jnp.inf)
