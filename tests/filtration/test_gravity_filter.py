"""Gravity filter: the falling head integrated, cakes that drain and cakes that do not."""

from __future__ import annotations

import math

import pytest
from scipy.integrate import solve_ivp

import granum as gr

GRAVITY = 9.80665


def filtered(**inputs: object):
    run = gr.alone("filtration.gravity_filter", **inputs).solve()
    assert run.audit["mass_closure"] < 1e-9
    assert run.audit["energy_closure"] < 1e-9
    return run, lambda name: float(run.figure(f"gravity_filter.{name}"))


def test_level_sinks_to_the_cake_as_darcy_says() -> None:
    """Darcy's law in time, head minus resistance of the growing cake, until the level meets it."""
    run, of = filtered()
    feed = run.streams["feed"]
    depth, alpha, medium = 0.5, 1e9, 1e9
    share = float(feed.solids_volume_fraction)
    end = share * depth / (1.0 - 0.42)
    assert of("cake_thickness") == pytest.approx(end, rel=1e-9)
    cake = share * depth * float(feed.solid_density)

    def sinks(_t: float, filtrate: list[float]) -> list[float]:
        mass = cake * filtrate[0] / (depth - end)
        head = float(feed.liquid_density) * GRAVITY * (depth - filtrate[0])
        return [head / (float(feed.liquid_viscosity) * (alpha * mass + medium))]

    def meets(_t: float, filtrate: list[float]) -> float:
        return filtrate[0] - (depth - end)

    meets.terminal = True  # type: ignore[attr-defined]
    found = solve_ivp(sinks, (0.0, 1e6), [0.0], events=meets, rtol=1e-9, atol=1e-12)
    assert of("formation_time") == pytest.approx(found.t_events[0][0], rel=1e-6)
    assert of("cycle_time") == pytest.approx(of("formation_time") + 1200.0)
    flow = float(feed.slurry_volume_flow)
    assert of("area_required") == pytest.approx(flow * of("cycle_time") / depth)


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
