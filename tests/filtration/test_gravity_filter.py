"""Gravity filter: the falling head integrated, cakes that drain and cakes that do not."""

from __future__ import annotations

import math
from typing import Any

import jax
import numpy as np
import pytest
from scipy.integrate import solve_ivp

import granum as gr

GRAVITY = 9.80665


def filtered(**inputs: object):
    run = gr.alone("filtration.gravity_filter", **inputs).solve()
    assert run.audit["mass_closure"] < 1e-9
    assert run.audit["energy_closure"] < 1e-9
    return run, lambda name: float(run.figure(f"gravity_filter.{name}"))


@pytest.mark.parametrize("settles", [0.0, 1e-5, 1e-4, 5e-3])
def test_level_sinks_to_the_cake_as_darcy_says(settles: float) -> None:
    """Darcy's law in time, head minus resistance of a cake that grows by filtration and settling, until all
    of it lies; then clear liquid through the whole cake.
    """
    run, of = filtered(settling_velocity=f"{settles} m/s")
    feed = run.streams["feed"]
    depth, alpha, medium, packed = 0.5, 1e9, 1e9, 1.0 - 0.42
    share, density = float(feed.solids_volume_fraction), float(feed.solid_density)
    end, cake = share * depth / packed, share * depth * density
    assert of("cake_thickness") == pytest.approx(end, rel=1e-9)
    weight = float(feed.liquid_density) * GRAVITY / float(feed.liquid_viscosity)

    def moves(_t: float, now: list[float]) -> list[float]:
        level, mass = now
        sinks = weight * level / (alpha * min(mass, cake) + medium)
        rises = packed * share * density / (packed - share) * (sinks + settles)
        return [-sinks, rises]

    def all_lies(_t: float, now: list[float]) -> float:
        return now[1] - cake

    all_lies.terminal = True  # type: ignore[attr-defined]
    found = solve_ivp(moves, (0.0, 1e6), [depth, 0.0], events=all_lies, rtol=1e-10, atol=1e-12)
    level = found.y_events[0][0][0]
    rest = (alpha * cake + medium) / weight * math.log(level / end)
    assert of("formation_time") == pytest.approx(found.t_events[0][0] + rest, rel=1e-7)
    assert of("cycle_time") == pytest.approx(of("formation_time") + 1200.0)
    flow = float(feed.slurry_volume_flow)
    assert of("area_required") == pytest.approx(flow * of("cycle_time") / depth)


def test_what_settles_ahead_stands_in_the_way() -> None:
    """Without settling the published integral; settled at once, the whole cake from the beginning."""
    grains = {"solids_volume_fraction": 0.02, "void_fraction": 0.42, "cake_resistance": 1e9}
    speeds = np.array([0.0, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 1e2])
    times = np.asarray(gr.filtration.filtration_time_settling(0.5, speeds, medium_resistance=1e9, **grains))
    end, load = 0.02 / 0.58 * 0.5, 0.58 * 0.02 * 2650.0 / 0.56
    slow = gr.filtration.filtration_time_falling_head(0.5 - end, 0.5, 1e9, 1e9, load)
    at_once = 1e-3 / (998.0 * GRAVITY) * (1e9 * 0.02 * 0.5 * 2650.0 + 1e9) * math.log(0.58 / 0.02)
    assert times[0] == pytest.approx(slow, rel=1e-9)
    assert times[-1] == pytest.approx(at_once, rel=1e-4)
    assert np.all(np.diff(times) > 0.0)

    def lasts(speed: Any) -> Any:
        return gr.filtration.filtration_time_settling(0.5, speed, medium_resistance=1e9, **grains)

    slope = float(jax.grad(lasts)(0.0))
    assert slope == pytest.approx((float(lasts(1e-10)) - float(lasts(0.0))) / 1e-10, rel=1e-4)


def test_grains_settle_by_their_size() -> None:
    """Stokes: quartz of 20 µm in water of 20 °C, hindered by 2 % of solid, (1 - φ)^4.65."""
    run, of = filtered(particle_diameter="20 um")
    feed = run.streams["feed"]
    alone = (float(feed.solid_density) - float(feed.liquid_density)) * GRAVITY * 4e-10
    alone /= 18.0 * float(feed.liquid_viscosity)
    crowd = (1.0 - float(feed.solids_volume_fraction)) ** 4.65
    assert of("settling_velocity") == pytest.approx(alone * crowd, rel=0.02)


def test_clear_liquid_falls_as_in_a_permeameter() -> None:
    """Almost no cake: the logarithm of the head falls with ρ g t/(η R)."""
    run, of = filtered(cake_resistance="1 m/kg", medium_resistance="1e9 1/m")
    feed = run.streams["feed"]
    rate = float(feed.liquid_density) * GRAVITY / (float(feed.liquid_viscosity) * 1e9)
    share = float(feed.solids_volume_fraction) / (1.0 - 0.42)
    assert of("formation_time") == pytest.approx(-math.log(share) / rate, rel=1e-6)


def test_only_a_cake_higher_than_capillarity_drains() -> None:
    """Grains of 88 µm hold water half a meter high; those of 2 mm drain in a cake of 20 cm."""
    _run, fine = filtered(deliquoring_time="30 min")
    assert fine("cake_saturation") == 1.0
    thick = {"slurry_depth": "2 m", "feed.solid_flow": "160 kg/h", "deliquoring_time": "30 min"}
    _run, coarse = filtered(particle_diameter="2 mm", cake_resistance="1e6 m/kg", **thick)
    _run, short = filtered(
        particle_diameter="2 mm", cake_resistance="1e6 m/kg", **thick | {"deliquoring_time": "1 s"}
    )
    held = 4.6 * 0.072 * 0.58 / (0.42 * 2e-3) / (998.0 * GRAVITY * coarse("cake_thickness"))
    assert held < coarse("cake_saturation") < short("cake_saturation") < 1.0


def test_sized_for_a_duty_is_just_in_use() -> None:
    run, of = filtered()
    made = gr.filtration.GravityFilter.size(
        run.streams["feed"],
        capacity_use=0.8,
        slurry_depth=0.5,
        cake_resistance=1e9,
        void_fraction=0.42,
        medium_resistance=1e9,
    )
    assert float(made.area) == pytest.approx(of("area_required") / 0.8)


def test_a_feed_thicker_than_its_cake_is_told() -> None:
    run, _of = filtered(**{"feed.solid_flow": "2 t/h"})
    checks = {c.name: c.ok for c in run.units["gravity_filter"].checks}
    assert not checks["solids in the feed over those of a packed cake"]


@pytest.mark.parametrize(
    ("depth", "thick", "deep"), [("2 m", True, True), ("10 m", True, False), ("50 m", False, False)]
)
def test_a_charge_too_deep_is_told(depth: str, thick: bool, deep: bool) -> None:
    """Ten meters of water weigh 0.98 bar, more than a vacuum gives; 2.1 % of 50 m is a cake of a meter."""
    run, _of = filtered(slurry_depth=depth)
    checks = {c.name: c.ok for c in run.units["gravity_filter"].checks}
    assert checks["cake thickness in a gravity filter"] is thick
    assert checks["head over the medium"] is deep
