"""Settling slurries: laws against each other and the print's second form, the pipeline in a line."""

from __future__ import annotations

from typing import Any

import jax.numpy as jnp
import numpy as np
import pytest

import granum as gr
from granum.conveying.equipment.slurry import SlurryPipeline
from granum.core.errors import ApplicabilityError
from granum.flowsheet import Flowsheet
from granum.flowsheet.findings import CLOSURE
from granum.streams.from_materials import mixture_of
from granum.streams.stream import empty

EDGES = list(np.geomspace(1e-5, 5e-3, 13))
WATER = mixture_of(["water"], ["quartz", "starch"], ["dry air"], EDGES)
OTHER = mixture_of(["water"], ["starch", "quartz"], ["dry air"], EDGES)
PIPE = np.pi / 4.0
LAWS: tuple[Any, ...] = ("wasp", "durand", "wilson")


def alone(unit, feed):
    return Flowsheet({"u": unit}, {"feed": feed}, {"feed": ("", "u.feed")}).solve()


def sand(mixture=WATER, velocity=3.0, pipe=0.2, share=0.1, middle=6, spread=1.0):
    """Quartz around a class in water at a velocity."""
    part = np.exp(-0.5 * ((np.arange(12) - middle) / spread) ** 2)
    flow = velocity * PIPE * pipe**2
    solid = [2650.0 * share * flow * part / part.sum() * (s.name == "quartz") for s in mixture.solids]
    return empty(mixture, 293.15).replace(
        solid=jnp.asarray(np.stack(solid)), liquid=jnp.asarray([998.0 * (1.0 - share) * flow])
    )


# -- laws
# ------------------------------------------------------------------------------------------------------------
def test_durand_has_two_prints() -> None:
    """For sand in water: 180 (√C_D v²/(g D))^-1.5, and 81 with the excess density inside; 5 % apart."""
    drag, v, d, c = 1.5, 3.0, 0.15, 0.12
    alone_ = gr.conveying.pressure_gradient_pipe(v, d, 1000.0, 1e-3)
    found = gr.conveying.pressure_gradient_slurry_durand(v, d, c, 2650.0, 1000.0, 1e-3, drag)
    print_ = 180.0 * (np.sqrt(drag) * v**2 / (9.80665 * d)) ** -1.5
    assert (found / alone_ - 1.0) / c == pytest.approx(print_, rel=0.06)


def test_wilson_and_durand_meet_at_the_size_that_settles_first() -> None:
    """Durand's chart has 1.3 to 1.5 near 0.6 mm; Wilson's fit is largest between 0.4 and 1 mm."""
    sizes = np.geomspace(1e-4, 1e-2, 200)
    for pipe in (0.15, 0.3, 0.5):
        slow = np.asarray(gr.conveying.deposition_velocity_wilson(pipe, sizes, 2650.0, 1000.0))
        worst = sizes[np.argmax(slow)]
        assert 4e-4 < worst < 1.2e-3
        durand = gr.conveying.deposition_velocity_durand(pipe, 2650.0, 1000.0, 1.0)
        assert 1.1 < slow.max() / durand < 1.55


def test_no_more_than_all_of_the_solid_leans_on_the_wall() -> None:
    """Wilson's friction coefficient of 0.44 on the submerged weight is the most."""
    slow = gr.conveying.pressure_gradient_slurry_wilson(0.01, 0.2, 5e-4, 0.1, 2650.0, 1000.0, 1e-3)
    alone_ = gr.conveying.pressure_gradient_pipe(0.01, 0.2, 1000.0, 1e-3)
    assert slow - alone_ == pytest.approx(0.44 * 0.1 * 1650.0 * 9.80665, rel=1e-9)


def test_floating_solids_have_no_deposition() -> None:
    for law in ("durand", "wilson"):
        call = getattr(gr.conveying, f"deposition_velocity_{law}")
        with pytest.raises(ApplicabilityError, match="heavier"):
            call(0.2, 900.0, 1000.0) if law == "durand" else call(0.2, 1e-3, 900.0, 1000.0)


def test_fine_solid_is_a_heavier_liquid_and_coarse_solid_a_bed() -> None:
    """The two ends of Wasp's parting: the gradient of a liquid of the slurry's density and viscosity, and
    Durand's of all the solid.
    """
    unit = SlurryPipeline(0.2, 100.0)
    fine = unit.operate(feed=sand(middle=0, spread=0.05)).inside
    assert fine.suspended > 0.98
    mean = 998.0 + 0.1 * (2650.0 - 998.0)
    thick = 1.002e-3 * gr.particles.relative_viscosity_thomas(0.1)
    heavy = gr.conveying.pressure_gradient_pipe(3.0, 0.2, mean, thick)
    assert float(fine.pressure_gradient) == pytest.approx(heavy, rel=0.05)
    coarse_feed = sand(middle=11, spread=0.05)
    coarse = unit.operate(feed=coarse_feed).inside
    assert coarse.suspended < 1e-3
    durand = SlurryPipeline(0.2, 100.0, head_loss_law="durand").operate(feed=coarse_feed).inside
    assert float(coarse.pressure_gradient) == pytest.approx(float(durand.pressure_gradient), rel=0.05)


def test_coarser_grains_deposit_less_evenly_and_cost_more() -> None:
    found = [SlurryPipeline(0.2, 100.0).operate(feed=sand(middle=m)).inside for m in (2, 5, 8)]
    assert found[0].suspended > found[1].suspended > found[2].suspended
    assert found[0].pressure_gradient < found[1].pressure_gradient < found[2].pressure_gradient


# -- the unit
# ------------------------------------------------------------------------------------------------------------
def test_without_solid_it_is_a_pipe_and_its_rise_a_column() -> None:
    feed = sand(share=0.0)
    for law in LAWS:
        run = alone(SlurryPipeline(0.2, 100.0, 10.0, head_loss_law=law), feed)
        friction = gr.conveying.pressure_gradient_pipe(
            run.figure("u.velocity"), 0.2, float(feed.liquid_density), float(feed.liquid_viscosity)
        )
        column = float(feed.liquid_density) * 9.80665 * 10.0
        # the fit of Thomas leaves a thousandth of viscosity at no solid
        assert run.figure("u.pressure_drop") == pytest.approx(110.0 * friction + column, rel=1e-3)
        assert run.figure("u.deposition_velocity") == 0.0


def test_the_line_conserves_orders_agree_and_a_pump_spares_its_own() -> None:
    from granum.streams.equipment.movers import Pump

    first, other = (alone(SlurryPipeline(0.2, 300.0, 5.0), sand(m)) for m in (WATER, OTHER))
    assert first.audit["mass_closure"] < CLOSURE
    assert first.audit["energy_closure"] < CLOSURE
    drop = first.figure("u.pressure_drop")
    assert other.figure("u.pressure_drop") == pytest.approx(drop, rel=1e-9)
    units = {"pump": Pump(drop), "u": SlurryPipeline(0.2, 300.0, 5.0)}
    ways = {"feed": ("", "pump.feed"), "slurry": ("pump.product", "u.feed"), "end": ("u.product", "")}
    pumped = Flowsheet(units, {"feed": sand()}, ways).solve()
    assert float(pumped.utilities.electric_power) == pytest.approx(
        float(first.utilities.electric_power), rel=1e-6
    )
    assert float(pumped.streams["end"].pressure) == pytest.approx(101325.0, rel=1e-3)


def test_slow_slurries_fail_their_check() -> None:
    run = alone(SlurryPipeline(0.4, 300.0), sand())
    assert [c.name for c in run.units["u"].checks if not c.ok] == ["velocity over that of deposition"]


def test_random_ordinary_slurries_close() -> None:
    seeds = np.random.default_rng(5)
    for _ in range(30):
        pipe = 10 ** seeds.uniform(-1.2, -0.1)
        feed = sand(
            WATER,
            seeds.uniform(0.5, 7.0),
            pipe,
            seeds.uniform(0.0, 0.4),
            int(seeds.integers(0, 12)),
            seeds.uniform(0.2, 5.0),
        )
        unit = SlurryPipeline(
            pipe,
            seeds.uniform(0, 3000),
            seeds.uniform(0, 60),
            head_loss_law=LAWS[seeds.integers(0, 3)],
            deposition_law=LAWS[seeds.integers(0, 3)],
        )
        run = alone(unit, feed)
        assert run.audit["mass_closure"] < CLOSURE
        assert run.audit["energy_closure"] < CLOSURE
        level = gr.conveying.pressure_gradient_pipe(
            run.figure("u.velocity"), pipe, float(feed.liquid_density), float(feed.liquid_viscosity)
        )
        assert run.figure("u.pressure_gradient") > 0.99 * level
