"""Layers and zones from a melt: against the diffusion equation, mass balances and each other."""

from __future__ import annotations

from typing import Any

import jax.numpy as jnp
import numpy as np
import pytest
from scipy.integrate import quad, solve_ivp
from tests.sharing.places import EXAMPLES

import granum as gr
from granum.core.errors import InputError
from granum.core.flags import collect
from granum.crystallization.equipment.layer_melt import LayerMeltCrystallizer, through
from granum.crystallization.formulas.melt import (
    distribution_coefficient_effective,
    impurity_ratio_sweating,
    impurity_ratio_zone,
    impurity_ratio_zone_ultimate,
    segregation_freezing,
)
from granum.crystallization.vessels.zone_melting import CELLS, passed, zone_refining
from granum.streams.from_materials import mixture_of
from granum.streams.stream import empty

ACID = mixture_of(["acetic acid", "water"], [], [], [1e-5, 1e-4, 1e-3])


def acid(water: float, flow: float = 1.0):
    return empty(ACID, 298.15).replace(liquid=flow * jnp.array([1.0 - water, water]))


def crystallizer(**changes: Any) -> LayerMeltCrystallizer:
    fields: dict[str, Any] = {
        "melting_temperature": 289.75,
        "heat_of_fusion": 195e3,
        "distribution_coefficient": 0.05,
    }
    fields |= {"layer_growth_rate": 1e-6, "diffusion_coefficient": 4e-6, "frozen_fraction": 0.65}
    return LayerMeltCrystallizer(**(fields | changes))


@pytest.mark.parametrize(("k", "v"), [(0.1, 1e-6), (0.5, 3e-6), (0.01, 5e-6)])
def test_the_boundary_layer_is_that_of_the_diffusion_equation(k, v):
    """D C'' + v C' = 0 across a layer δ; at the front D C' + v (1 − k) C = 0; C = 1 in the melt."""
    D, delta = 1e-9, 5e-4
    front = solve_ivp(
        lambda x, y: [y[1], -v / D * y[1]], (0.0, delta), [1.0, -v / D * (1.0 - k)], rtol=1e-11, atol=1e-13
    )
    assert distribution_coefficient_effective(k, v, D / delta) == pytest.approx(k / front.y[0, -1], rel=1e-8)


def test_limits_of_the_front():
    assert distribution_coefficient_effective(0.07, 1e-15, 1e-6) == pytest.approx(0.07, rel=1e-6)
    assert distribution_coefficient_effective(0.07, 9e-4, 1e-6) == pytest.approx(1.0)


@pytest.mark.parametrize(("k", "g"), [(0.1, 0.5), (0.3, 0.9), (1.0, 0.4), (0.02, 1e-12)])
def test_a_layer_and_its_melt_hold_what_there_was(k, g):
    front, layer, melt = segregation_freezing(k, g)
    assert g * layer + (1 - g) * melt == pytest.approx(1.0, rel=1e-12)
    assert front == pytest.approx(k * melt)
    assert layer == pytest.approx(quad(lambda x: k * (1 - x) ** (k - 1), 0, g)[0] / g, rel=1e-6)


def test_sweating_is_what_a_small_step_at_a_time_gives():
    mass, impurity = 1.0, 1.0
    for _step in range(20000):
        drained = 0.2 / 20000
        impurity -= drained * impurity / mass / 0.3
        mass -= drained
    assert impurity_ratio_sweating(0.3, 0.2) == pytest.approx(impurity / mass, rel=1e-3)
    assert impurity_ratio_sweating(1.0, 0.2) == 1.0


def test_one_pass_is_pfanns_and_two_are_integrated():
    """The second pass begins with the mean of the first over one zone: k [1 − (1−k)(1−e^−k)/k]."""
    k = 0.1
    one, two = (zone_refining(k, passes=n) for n in (1, 2))
    z = np.asarray(one.bar_position) * 10.0
    before = z < 8.9
    pfann = impurity_ratio_zone(k, z[before])
    np.testing.assert_allclose(np.asarray(one.impurity_ratio)[before], pfann, rtol=1e-4)
    first = k * (1.0 - (1.0 - k) * -np.expm1(-k) / k)
    assert two.impurity_ratio_begin == pytest.approx(first, rel=0.01)


@pytest.mark.parametrize("passes", [1, 7, 40])
def test_passes_keep_the_impurity(passes):
    out = zone_refining(0.3, bar_length_in_zones=6.0, passes=passes, cut_fraction=0.0)
    assert out.impurity_ratio_kept == pytest.approx(1.0, rel=1e-10)


def test_the_ultimate_distribution_is_not_changed_by_a_pass():
    k, zones = 0.5, 8.0
    z = (np.arange(8 * CELLS) + 0.5) / CELLS
    bar = np.asarray(impurity_ratio_zone_ultimate(k, z, zones))
    again = passed(bar, k, CELLS)
    np.testing.assert_allclose(again[: 6 * CELLS], bar[: 6 * CELLS], rtol=0.02)
    many = zone_refining(k, bar_length_in_zones=zones, passes=300)
    slope = np.log(many.impurity_ratio[3 * CELLS] / many.impurity_ratio[CELLS]) / 2.0
    assert slope / np.expm1(slope) == pytest.approx(k, rel=0.01)
    assert np.mean(bar) == pytest.approx(1.0, rel=1e-3)


def test_a_row_of_stages_is_the_sum_over_its_balances():
    """Three stages, feed into the middle: hand elimination."""
    a = 0.6
    top, entering = through(a, 2, 1)
    middle = 1.0 / (1.0 - 2.0 * a * (1.0 - a))
    assert float(top) == pytest.approx(a * a * middle, rel=1e-12)
    assert float(entering) == pytest.approx(middle * (1.0 + a + (1.0 - a)), rel=1e-12)


def test_one_stage_is_the_layer_itself():
    made = crystallizer(stages_above="1", stages_below="0", sweated_fraction=0.0).operate(feed=acid(0.03))
    k = distribution_coefficient_effective(0.05, 1e-6, 4e-6)
    layer = segregation_freezing(k, 0.65).impurity_ratio_layer
    assert float(made.figures.impurity_fraction_product) == pytest.approx(0.03 * layer, rel=1e-12)
    assert float(made.figures.product_mass_flow) == pytest.approx(0.65, rel=1e-12)


def test_more_stages_purify_and_recover_more():
    def figures(above, below):
        return crystallizer(stages_above=above, stages_below=below).operate(feed=acid(0.03)).figures

    pure = [float(figures(n, "1").impurity_fraction_product) for n in "123"]
    assert pure[0] > 5.0 * pure[1] > 25.0 * pure[2]
    assert figures("2", "2").product_recovery > figures("2", "0").product_recovery


def test_what_cannot_be_is_said():
    with collect() as records:
        crystallizer(stages_below="4", frozen_fraction=0.9, sweated_fraction=0.0)(acid(0.4))
    assert any(record.reason and "purer feed" in record.reason for record in records)
    with pytest.raises(InputError, match="fewer passes"):
        zone_refining(0.1, bar_length_in_zones=100.0, passes=900)


def test_the_line_makes_glacial_acid():
    """Food-grade glacial acetic acid holds 99.8 % at least (FCC; recalled)."""
    run = gr.read(EXAMPLES / "melt-crystallization" / "line.toml").solve()
    assert run.product == "product"
    assert max(run.audit["mass_closure"], run.audit["energy_closure"]) < 1e-9
    assert all(check.ok for unit in run.units.values() for check in unit.checks)
    assert run.units["layers"].values.impurity_fraction_product < 0.002
