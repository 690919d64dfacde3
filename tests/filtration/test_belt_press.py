"""Belt press: draining under a falling head, squeezing around rollers, loads of plants."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.integrate import quad

import granum as gr

CAKE = {"cake_resistance": 1e10, "medium_resistance": 1e9, "dry_cake_per_filtrate": 30.0}


def test_falling_head_is_darcy_integrated() -> None:
    h, V = 0.15, 0.06
    expected, _error = quad(
        lambda v: 1e-3 * (1e10 * 30.0 * v + 1e9) / (998.0 * 9.80665 * (h - v)), 0.0, V, epsrel=1e-10
    )
    t = gr.filtration.filtration_time_falling_head(V, h, **CAKE)
    assert t == pytest.approx(expected, rel=1e-9)
    assert gr.filtration.filtrate_depth_falling_head(t, h, **CAKE) == pytest.approx(V, rel=1e-8)
    # Darcy's falling-head permeameter: h = h₀ exp(−ρ g t/(η R))
    fallen = gr.filtration.filtrate_depth_falling_head(100.0, 0.1, 1e6, 1e9, 0.0)
    assert 0.1 - fallen == pytest.approx(0.1 * np.exp(-998.0 * 9.80665 * 100.0 / 1e6), rel=1e-6)


def press(**inputs: object):
    run = gr.alone("filtration.belt_press", **inputs).solve()
    assert run.audit["mass_closure"] < 1e-9
    assert run.audit["energy_closure"] < 1e-9
    return run


def test_load_of_a_digested_sludge() -> None:
    """Hammer's problem on belt presses: 45 gal/min per meter of belt of 5.0 % sludge, 511 kg/(m h)."""
    flow = 45.0 * 3.785411784e-3 / 60.0 * 1000.0
    feed = {"feed.solid_flow": f"{0.05 * flow} kg/s", "feed.liquid_flow": f"{0.95 * flow} kg/s"}
    run = press(belt_width="1 m", **feed)
    assert run.figure("belt_press.solids_loading_width") * 3600.0 == pytest.approx(511.0, rel=1e-3)
    checks = {c.name: c.ok for c in run.units["belt_press"].checks}
    assert checks["dry solids per width of belt"]
    assert checks["sludge per width of belt"]


def test_cake_of_a_usual_sludge() -> None:
    """Metcalf and Eddy 2003, ch. 14 (from memory): 16 to 25 % of solids for mixed sludge with polymer."""
    run = press()
    assert 0.16 < run.figure("belt_press.solids_mass_fraction") < 0.25
    assert all(check.ok for check in run.units["belt_press"].checks)


def test_less_sludge_and_tighter_belts_dry_more() -> None:
    half = {"feed.solid_flow": "300 kg/h", "feed.liquid_flow": "7.2 t/h"}
    cases: tuple[dict[str, str], ...] = ({}, half, {"belt_tension": "10 kN/m"})
    usual, less, tighter = (press(**c).figure("belt_press.solids_mass_fraction") for c in cases)
    assert less > usual
    assert tighter > usual


def test_a_long_press_reaches_the_equilibrium_of_its_last_roller() -> None:
    run = press(consolidation_coefficient="1e-5 m2/s")
    last = run.figure("belt_press.pressure_last")
    assert last == pytest.approx(2.0 * 6e3 / 0.2)
    cake = run.streams["belt_press.cake"]
    assert float(cake.solids_volume_fraction) == pytest.approx(0.2 * (last / 1e5) ** 0.15, rel=1e-6)


def test_a_feed_thicker_than_drained_sludge_is_pressed_all_the_same() -> None:
    run = press(**{"feed.liquid_flow": "3 t/h"})
    assert run.figure("belt_press.gravity_share") == pytest.approx(0.0, abs=1e-9)
    assert not all(check.ok for check in run.units["belt_press"].checks)
