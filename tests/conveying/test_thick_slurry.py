"""The pipeline of a thick slurry: by hand, conserved, refused where it contradicts itself."""

from __future__ import annotations

from typing import Any

import jax
import jax.numpy as jnp
import numpy as np
import pytest

import granum as gr
from granum.cases.alone import alone
from granum.conveying.equipment.thick_slurry import ThickSlurryPipeline
from granum.core.errors import InputError
from granum.streams.audit import closure
from granum.streams.from_materials import mixture_of
from granum.streams.stream import empty

CLAY = mixture_of(["water"], ["kaolinite"], [], list(np.geomspace(1e-7, 1e-4, 7)))
WEIGHT = 9.80665


def slurry(flow=0.02, share=0.2):
    """Clay in water, m³/s, solids by volume."""
    grain, water = CLAY.densities("solids", 293.15)[0], CLAY.densities("liquids", 293.15)[0]
    return empty(CLAY, 293.15).replace(
        solid=jnp.full((1, 6), grain * share * flow / 6.0), liquid=jnp.array([water * (1.0 - share) * flow])
    )


def test_by_hand_at_rest_nearly_and_uphill():
    # a plug creeps: 4 τ_y/D along the whole pipe, and the weight of the slurry where it rises
    feed = slurry(1e-9)
    made = ThickSlurryPipeline(0.2, 100.0, 0.02, yield_stress=25.0, length_vertical=15.0).operate(feed=feed)
    density = float(feed.mass_flow / feed.slurry_volume_flow)
    by_hand = 4.0 * 25.0 / 0.2 * 115.0 + density * WEIGHT * 15.0
    assert float(made.figures.pressure_drop) == pytest.approx(by_hand, rel=1e-2)
    assert float(made.figures.wall_stress) == pytest.approx(25.0, rel=2e-2)


def test_without_yield_stress_and_with_one_exponent_the_three_curves_are_newtons():
    feed = slurry(2e-4)
    drops = [
        float(ThickSlurryPipeline(0.1, 50.0, 0.05, curve).operate(feed=feed).figures.pressure_drop)
        for curve in ("bingham", "power_law", "herschel_bulkley")
    ]
    density = float(feed.mass_flow / feed.slurry_volume_flow)
    speed = 2e-4 / (0.25 * np.pi * 0.01)
    newton = 50.0 * float(gr.conveying.pressure_gradient_pipe(speed, 0.1, density, 0.05, 1e-9))
    assert drops == pytest.approx([newton] * 3, rel=1e-6)


def test_laminar_friction_is_64_over_the_reynolds_number_told():
    made = ThickSlurryPipeline(0.1, 50.0, 1.5, "power_law", flow_index=0.6).operate(feed=slurry(0.005))
    f, feed = made.figures, slurry(0.005)
    density = float(feed.mass_flow / feed.slurry_volume_flow)
    told = float(gr.conveying.reynolds_metzner_reed(float(f.velocity), 0.1, density, 1.5, 0.6))
    assert float(f.reynolds) == pytest.approx(told, rel=1e-9)
    assert float(f.pressure_gradient) == pytest.approx(64 / told * density * float(f.velocity) ** 2 / 0.2)


def test_a_hundred_ordinary_lines_conserve_and_wider_pipes_take_less():
    rng = np.random.default_rng(3)
    for _case in range(100):
        curve = rng.choice(["bingham", "power_law", "herschel_bulkley"])
        feed = slurry(10.0 ** rng.uniform(-3.5, -1.5), rng.uniform(0.0, 0.4))
        own = {
            "flow_index": 1.0 if curve == "bingham" else rng.uniform(0.2, 1.2),
            "yield_stress": 0.0 if curve == "power_law" else rng.uniform(0.0, 80.0),
        }
        given: Any = (rng.uniform(0.0, 900.0), 10.0 ** rng.uniform(-2, 0.5), str(curve))
        narrow = ThickSlurryPipeline(0.12, *given, **own).operate(feed=feed)
        wide = ThickSlurryPipeline(0.15, *given, **own).operate(feed=feed)
        found = closure([feed], list(narrow.outlets))
        assert float(found.mass) < 1e-12
        assert float(found.energy) < 1e-12
        assert 0.0 <= float(wide.figures.pressure_drop) <= float(narrow.figures.pressure_drop)
        assert all(np.isfinite(float(x)) for x in narrow.figures)
        assert float(narrow.uses["electric_power_pump"]) >= 0.0


def test_slope_is_that_of_differences():
    def drop(diameter):
        unit = ThickSlurryPipeline(diameter, 80.0, 0.02, yield_stress=8.0)
        return unit.operate(feed=slurry()).figures.pressure_drop

    slope = float(jax.grad(drop)(0.14))
    assert slope < 0.0
    assert slope == pytest.approx(float(drop(0.1401) - drop(0.1399)) / 2e-4, rel=1e-4)


def test_turbulent_herschel_bulkley_is_told():
    made = ThickSlurryPipeline(0.1, 50.0, 0.01, "herschel_bulkley", 0.5, 0.9).operate(feed=slurry(0.03))
    told = {check.name: check for check in made.checks}[
        "Reynolds number over that at which laminar flow ends"
    ]
    assert not told.ok


def test_a_curve_that_contradicts_its_numbers_is_refused():
    with pytest.raises(InputError, match="herschel_bulkley"):
        ThickSlurryPipeline(0.1, 50.0, 0.01, "power_law", 5.0, 0.7)
    with pytest.raises(InputError, match="flow_index"):
        alone("conveying.thick_slurry_pipeline", flow_index=0.5)
