"""Aerated grain: what extension services state, a column of cells in equilibrium, monotone in what one would
expect.
"""

from __future__ import annotations

import jax
import jax.numpy as jnp
import numpy as np
import pytest

import granum as gr
from granum.drying.isotherms.products import PRODUCTS

CFM_PER_BUSHEL = 4.719e-4  # m³/s
MAIZE, WHEAT = 25.4, 27.2  # kg a bushel
LAW = PRODUCTS["maize"]()


def bin_of(**more: object):
    given: dict[str, object] = {
        "mass": 1e5,
        "area": 30.0,
        "volume_flow": 0.5,
        "temperature": "27 degC",
        "moisture_dry_basis": 0.15,
        "temperature_air": "10 degC",
        "relative_humidity": 0.65,
    }
    return gr.drying.bin_aeration(**(given | more))  # pyright: ignore[reportArgumentType]


def test_cooling_takes_somewhat_less_than_farms_count() -> None:
    """100 to 200 h, or 15 h over the flow, at 0.1 cfm per bushel (extension services, read): fronts without
    width are through first.
    """
    flow = 0.1 * CFM_PER_BUSHEL * 1e5 / WHEAT
    hours = bin_of(volume_flow=flow, grain="wheat").time_cooling / 3600.0
    assert 0.55 * 150.0 < hours < 150.0


def test_drying_with_ambient_air_takes_somewhat_less_than_farms_count() -> None:
    """Maize from 20 % with air of 45 °F and 60 % behind the fan, 1 cfm per bushel: 45 to 50 days, to 14 to
    14.5 % (Hellevang, read).
    """
    flow = CFM_PER_BUSHEL * 1e5 / MAIZE
    made = bin_of(
        volume_flow=flow,
        temperature="45 degF",
        moisture_dry_basis=0.25,
        temperature_air="45 degF",
        relative_humidity=0.6,
    )
    days = made.time_drying / 86400.0
    assert 0.65 * 45.0 < days < 45.0
    wet = made.moisture_dry_basis_equilibrium / (1.0 + made.moisture_dry_basis_equilibrium)
    assert wet == pytest.approx(0.1425, abs=0.0025)


def saturation(T):
    """Magnus, Pa."""
    return 611.2 * jnp.exp(17.62 * (T - 273.15) / (T - 30.03))


def column(start, air, length: float, steps: int, cells: int = 40):
    """Cells of grain that air leaves in equilibrium with them, in small steps of air per dry grain: moisture
    and temperature at the end. Ideal gases, constants of their own.
    """

    def held(X, T):
        Y = 0.622 / (101325.0 / (LAW.activity(X, T) * saturation(T)) - 1.0)
        t = T - 273.15
        return Y, 1006.0 * t + Y * (2.501e6 + 1860.0 * t)

    Ta, phi = air
    vapor = phi * saturation(Ta)
    Ya = 0.622 * vapor / (101325.0 - vapor)
    ha = 1006.0 * (Ta - 273.15) + Ya * (2.501e6 + 1860.0 * (Ta - 273.15))
    step = length / steps * cells

    def on(state, _none):
        X, H = state
        T = H / (1500.0 + 4187.0 * X) + 273.15
        Y, h = held(X, T)
        before = jnp.append(Ya, Y[:-1]), jnp.append(ha, h[:-1])
        return (X + step * (before[0] - Y), H + step * (before[1] - h)), None

    X = jnp.full(cells, start[1])
    H = (1500.0 + 4187.0 * X) * (start[0] - 273.15)
    (X, H), _none = jax.jit(lambda s: jax.lax.scan(on, s, None, length=steps))((X, H))
    return np.asarray(X), np.asarray(H / (1500.0 + 4187.0 * X) + 273.15)


def test_fronts_are_those_of_a_column_of_cells() -> None:
    """Half of the air of a front, and it stands in the middle; the plateau lies between the two fronts."""
    start, air = (303.15, 0.2), (288.15, 0.5)
    fronts = gr.drying.aeration_fronts(start[0], start[1], *air)
    _wet, cooling = column(start, air, 0.5 * float(fronts.air_per_grain_cooling), 400)
    span = start[0] - float(fronts.temperature_cooled)
    assert (start[0] - cooling.mean()) / span == pytest.approx(0.5, abs=0.02)
    moist, warm = column(start, air, 3.0 * float(fronts.air_per_grain_cooling), 800)
    assert warm[-5] == pytest.approx(float(fronts.temperature_cooled), abs=0.1)
    assert moist[-5] == pytest.approx(float(fronts.moisture_dry_basis_cooled), abs=3e-4)
    half, _warm = column(start, air, 0.5 * float(fronts.air_per_grain_drying), 20000)
    dried = float(fronts.moisture_dry_basis_cooled) - float(fronts.moisture_dry_basis_equilibrium)
    assert (float(fronts.moisture_dry_basis_cooled) - half.mean()) / dried == pytest.approx(0.5, abs=0.03)


def test_more_air_is_quicker_and_dearer() -> None:
    one, two = bin_of(), bin_of(volume_flow=1.0)
    assert two.time_cooling == pytest.approx(0.5 * one.time_cooling, rel=1e-9)
    assert two.specific_energy_cooling > one.specific_energy_cooling
    assert bin_of(packing_resistance=1.0).pressure_drop == pytest.approx(one.pressure_drop / 1.5, rel=1e-9)
    assert one.time_drying > 20.0 * one.time_cooling


def test_resistance_is_that_of_kernels_in_a_bed() -> None:
    """Kernels are no spheres: more than Ergun's equation for spheres of 3.6 mm with 0.41 of voids, at
    0.1 m/s, and not four times that; grains in the order of their size.
    """
    lost = {
        grain: float(bin_of(grain=grain, volume_flow=3.0, packing_resistance=1.0).pressure_drop)
        * 720
        * 30
        / 1e5
        for grain in ("maize", "wheat", "sorghum", "flaxseed")
    }
    voids, size, speed = 0.41, 3.6e-3, 0.1
    ergun = 150.0 * 1.8e-5 * (1 - voids) ** 2 * speed / (voids**3 * size**2) + 1.75 * 1.2 * (
        1 - voids
    ) * speed**2 / (voids**3 * size)
    assert ergun < lost["wheat"] < 4.0 * ergun
    assert lost["maize"] < lost["wheat"] < lost["flaxseed"]


def test_grain_as_cool_as_the_front_makes_it_is_smooth_and_moist_air_wets() -> None:
    cold = gr.drying.aeration_fronts(288.15, 0.15, 288.15, 0.9)
    assert cold.moisture_dry_basis_equilibrium > 0.15
    assert cold.air_per_grain_drying > 0.0
    at = float(gr.drying.aeration_fronts(295.0, 0.15, 285.0, 0.65).temperature_cooled)
    near = [
        float(gr.drying.aeration_fronts(at + d, 0.15, 285.0, 0.65).air_per_grain_cooling)
        for d in (-0.01, 0.0, 0.01)
    ]
    assert near == pytest.approx([near[1]] * 3, rel=1e-3)
