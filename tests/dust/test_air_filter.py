"""Fibers: Kuwabara's own interception, the size that passes most, classes, life and mist of an air filter."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import granum as gr
from granum.core.errors import GranumError
from granum.filtration.formulas.fibers import RURAL, URBAN, particulate_efficiency

ga = gr.filtration


def test_a_small_particle_touches_as_in_the_flow_of_kuwabara() -> None:
    """Stream function of the cell at one particle radius from the fiber, 0.6 of it as measured."""
    a, R = 0.05, 0.02
    Ku = -0.5 * math.log(a) - 0.75 + a - 0.25 * a**2
    exact = (
        (1 + R)
        / (2 * Ku)
        * (2 * math.log(1 + R) - 1 + a + (1 + R) ** -2 * (1 - a / 2) - a / 2 * (1 + R) ** 2)
    )
    ours = ga.fiber_efficiency_lee_liu(R * 1e-3, 1e-3, a, 1.0, 1.8e-5, 293.0, 1e-3)
    assert ours == pytest.approx(0.6 * exact, rel=0.03)


def caught_on_paths(a: float, R: float, stokes: float) -> float:
    """Share of the particles in the way of a fiber that hit it, from their paths in Kuwabara's cell; lengths
    in radii of the fiber.
    """
    Ku, outside = -0.5 * math.log(a) - 0.75 + a - 0.25 * a**2, 1.0 / math.sqrt(a)

    def stream(r: float) -> float:
        return r / (2 * Ku) * (2 * math.log(r) - 1 + a + (1 - a / 2) / r**2 - a * r**2 / 2)

    def flow(x: float, y: float) -> tuple[float, float]:
        r = math.hypot(x, y)
        c, s = x / r, y / r
        slope = (2 * math.log(r) + 1 + a - (1 - a / 2) / r**2 - 1.5 * a * r**2) / (2 * Ku)
        out, around = stream(r) / r * c, -slope * s
        return out * c - around * s, out * s + around * c

    def path(_t: float, z: np.ndarray) -> list[float]:
        u, v = flow(z[0], z[1])
        return [z[2], z[3], (u - z[2]) / (2 * stokes), (v - z[3]) / (2 * stokes)]

    def touches(_t: float, z: np.ndarray) -> float:
        return math.hypot(z[0], z[1]) - 1.0 - R

    def past(_t: float, z: np.ndarray) -> float:
        return z[0] - 2.0

    touches.terminal = past.terminal = True  # type: ignore[attr-defined]
    low, high = 0.0, 0.9 * outside
    for _halving in range(16):
        y = 0.5 * (low + high)
        start = (-math.sqrt(outside**2 - y**2), y)
        run = solve_ivp(path, (0, 200), [*start, *flow(*start)], "LSODA", events=(touches, past), rtol=1e-8)
        low, high = (y, high) if len(run.t_events[0]) else (low, y)
    return stream(outside) * low / outside


@pytest.mark.parametrize("stokes", [0.05, 0.2])
def test_with_inertia_a_fiber_catches_what_paths_say_within_a_half(stokes: float) -> None:
    """No book: the equations of motion of a heavy particle in the flow of the cell."""
    fiber, R, viscosity = 20e-6, 0.2, 1.8e-5
    speed = stokes * 18 * viscosity * fiber / (1000.0 * (R * fiber) ** 2)
    ours = ga.fiber_efficiency_lee_liu(R * fiber, fiber, 0.05, speed, viscosity, 293.0, 1000.0)
    assert ours == pytest.approx(caught_on_paths(0.05, R, stokes), rel=0.5)


def test_diffusion_falls_with_two_thirds_of_the_size_and_speed() -> None:
    one, fast = (ga.fiber_efficiency_lee_liu(2e-9, 1e-5, 0.05, U, 1.8e-5, 293.0, 0.001) for U in (0.1, 0.8))
    assert one / fast == pytest.approx(4.0, rel=0.02)


def test_the_worst_size_of_a_fine_filter_is_that_of_the_standards() -> None:
    """Glass paper passes most between 0.1 and 0.3 µm, and a finer one less of a smaller size."""
    names = ("particle_diameter_penetrating", "penetration_highest", "pressure_drop_clean")
    mat = {"fiber_fraction": 0.05, "mat_thickness": "0.4 mm", "area": "30 m2"}
    found = []
    for fiber in ("1 um", "0.5 um"):
        run = gr.alone("dust.air_filter", fiber_diameter=fiber, **mat).solve()
        found.append([float(run.figure(f"air_filter.{name}")) for name in names])
    (size, most, drop), (smaller, less, more) = found
    assert 1e-7 < smaller < size < 3e-7
    assert less < most < 0.2
    assert more > drop


def test_a_filter_that_takes_a_share_of_every_size_takes_it_of_all() -> None:
    for size, modes in ((1e-6, URBAN), (1e-5, RURAL)):
        assert particulate_efficiency(lambda d: 0.4 + 0.0 * d, size, modes) == pytest.approx(0.4)
        step = float(particulate_efficiency(lambda d: 1.0 * (d > 0.5e-6), size, modes))
        d = np.geomspace(0.3e-6, size, 4001)
        q = sum(y / math.log(s) * np.exp(-0.5 * (np.log(d / m) / math.log(s)) ** 2) for m, s, y in modes)
        assert step == pytest.approx(q[d > 0.5e-6].sum() / q.sum(), abs=0.02)


def test_classes() -> None:
    assert ga.air_filter_class_particulate(0.3, 0.64, 0.9) == "ISO ePM2.5 60 %"
    assert ga.air_filter_class_particulate(0.97, 0.98, 0.99) == "ISO ePM1 >95 %"
    assert "coarse" in ga.air_filter_class_particulate(0.05, 0.1, 0.4)
    assert ga.air_filter_class_particulate(0.5, 0.6, 0.7) == "ISO ePM1 50 %"


def filtered(**inputs: object):
    run = gr.alone("dust.air_filter", **inputs).solve()
    assert run.audit["mass_closure"] < 1e-9
    assert run.audit["energy_closure"] < 1e-9
    return run, lambda name: float(run.figure(f"air_filter.{name}"))


def test_life_by_hand() -> None:
    run, of = filtered()
    flow, caught = (
        float(v) for v in (run.streams["feed"].gas_volume_flow, run.streams["air_filter.dust"].solid_flow)
    )
    U = flow / 10.0
    assert of("superficial_velocity") == pytest.approx(U)
    assert of("run_time") == pytest.approx((450.0 - of("pressure_drop_clean")) / (2e4 * U * caught / 10.0))
    assert of("dry_mass_per_area") == pytest.approx(caught / 10.0 * of("run_time"))
    _run, dusty = filtered(**{"feed.solid_flow": "2 g/h"})
    assert dusty("run_time") == pytest.approx(0.1 * of("run_time"), rel=1e-3)


def test_mist_drains_and_impossible_mats_are_refused() -> None:
    run, _of = filtered(**{"feed.liquid_flow": "1 kg/h"}, droplet_diameter="3 um")
    caught, fed = (float(run.streams[s].liquid_flow) for s in ("air_filter.dust", "feed"))
    assert 0.5 * fed < caught < fed
    with pytest.raises(GranumError, match="fiber"):
        filtered(fiber_fraction=0.9)
    run, of = filtered(fiber_diameter="0.5 um", area="1 m2")
    assert of("run_time") == 0.0
    assert not {c.name: c.ok for c in run.units["air_filter"].checks}[
        "clean pressure drop over the final one"
    ]
