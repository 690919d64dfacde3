"""Cartridges: what they hold by Hermia's laws, their life by hand and by the makers' rule of areas."""

from __future__ import annotations

import jax
import numpy as np
import pytest
from scipy.integrate import quad

import granum as gr
from granum.core.errors import ConvergenceError, GranumError
from granum.filtration.formulas.blocking import EXPONENTS, LAWS, BlockingLaw, filtrate_volume_blocking

KEY = "filtration.cartridge_filter"


def life(**inputs: object) -> float:
    return float(gr.alone(KEY, **inputs).solve().figure("cartridge_filter.run_time"))


@pytest.mark.parametrize("law", LAWS)
def test_dirt_held_follows_hermia(law: BlockingLaw) -> None:
    """Against dR/dm = Rⁿ by quadrature, and against the fall of the flow at constant pressure."""
    held = gr.filtration.dirt_held_blocking("8 kPa", "1.5 bar", 0.1, "10 kPa", "2 bar", blocking_law=law)
    by_hand, whole = (quad(lambda r: r ** -EXPONENTS[law], 1.0, end)[0] for end in (150 / 8, 20.0))
    assert held == pytest.approx(0.1 * by_hand / whole, rel=1e-9)

    def volume(t: float) -> float:
        return filtrate_volume_blocking.function(t, 1.0, 100.0, law)

    times = (30.0, 80.0)
    ratios = [float(1.0 / jax.grad(volume)(t)) for t in times]  # of the resistance
    # a filter of clean pressure drop 1 that is changed at these ratios
    first, second = (
        gr.filtration.dirt_held_blocking(1.0, r, 1.0, 1.0, ratios[1], blocking_law=law) for r in ratios
    )
    assert first / second == pytest.approx(float(volume(times[0]) / volume(times[1])), rel=1e-9)


def test_a_capacity_needs_a_rise() -> None:
    with pytest.raises(GranumError, match="capacity"):
        gr.filtration.dirt_held_blocking("8 kPa", "1.5 bar", 0.1, "10 kPa", "10 kPa")
    assert gr.filtration.dirt_held_blocking("2 bar", "1.5 bar", 0.1, "10 kPa", "2 bar") == 0.0


def test_life_and_removal_by_hand() -> None:
    run = gr.alone(KEY).solve()
    assert run.audit["mass_closure"] < 1e-9
    assert run.audit["energy_closure"] < 1e-9
    feed, filtrate = run.streams["feed"], run.streams["cartridge_filter.filtrate"]
    sizes = np.asarray(feed.mixture.sizes)
    passes = 0.001 ** ((sizes / 5e-6) ** 2)
    np.testing.assert_allclose(
        np.asarray(filtrate.solid)[0], np.asarray(feed.solid)[0] * passes, rtol=1e-9, atol=1e-20
    )
    flow = float(feed.slurry_volume_flow) / 30.0
    clean = 1e4 * flow * 3600.0 * float(feed.liquid_viscosity) / 1e-3
    held = 0.06 * np.log(2e5 / clean) / np.log(20.0)
    caught = float(feed.solid_flow - filtrate.solid_flow)
    assert run.figure("cartridge_filter.run_time") == pytest.approx(30.0 * held / caught, rel=1e-9)
    uses = run.solution.sheets["cartridge_filter"].uses
    assert uses["consumption_cartridges"] == pytest.approx(30.0 * 0.2 * caught / (30.0 * held), rel=1e-9)
    spent = float(run.streams["cartridge_filter.dirt"].liquid_volume_flow)
    assert spent * 30.0 * held / caught == pytest.approx(30.0 * 3e-4, rel=1e-9)  # 0.3 L stay in each
    # between the pressure drops of both ends, at a pump of 0.7 and a motor of 0.9
    ends = [float(feed.slurry_volume_flow) * p / 0.63 for p in (clean, 2e5)]
    assert ends[0] < uses["electric_power_pump"] < ends[1]


def test_twice_the_area_lasts_twice_to_four_times_as_long() -> None:
    """Makers reckon with the area to a power of 1 to 2 (from memory): sealed pores 1, cake 2."""
    gains = {law: life(blocking_law=law, cartridge_lengths=60) / life(blocking_law=law) for law in LAWS}
    assert gains["complete"] == pytest.approx(2.0, rel=0.03)
    assert gains["cake"] == pytest.approx(4.0, rel=0.03)
    assert gains["complete"] < gains["standard"] < gains["intermediate"] < gains["cake"]


def test_too_few_cartridges_and_clear_liquid() -> None:
    with pytest.raises(ConvergenceError, match="clean cartridges"):
        gr.alone(KEY, cartridge_lengths=0.5).solve()
    clear = gr.alone(KEY, feed={"solid_flow": "0 kg/h"}).solve()
    assert clear.figure("cartridge_filter.run_time") == 1e10
