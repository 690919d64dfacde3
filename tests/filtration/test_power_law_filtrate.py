"""Cake filtration with a filtrate that is a power-law liquid."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.integrate import quad

import granum as gr
from granum.core.errors import CaseError, InputError

time = gr.filtration.filtration_time_power_law
CAKE = {
    "area": 0.5,
    "pressure_drop": 2e5,
    "cake_resistance": 3e10,
    "dry_cake_per_filtrate": 60.0,
    "void_fraction": 0.45,
    "solid_density": 2500.0,
}


@pytest.mark.parametrize("medium", [0.0, 4e10])
@pytest.mark.parametrize("n", [0.4, 0.8, 1.3])
def test_sum_of_darcys_law_over_the_volume(n: float, medium: float) -> None:
    """dt = dv/u, u from the stress in the capillaries whose viscosity stands in another card."""
    permeability = 1.0 / (3e10 * 0.55 * 2500.0)

    def slow(v: float) -> float:
        through = 3e10 * 60.0 * v + medium
        unit = gr.porous.dynamic_viscosity_permeable_christopher_middleman.function(
            1.0, permeability, 0.45, 0.2, n
        )
        return float((unit * through / 2e5) ** (1.0 / n))

    by_hand, _error = quad(slow, 0.0, 0.03 / 0.5)
    found = time(0.03, consistency=0.2, flow_index=n, medium_resistance=medium, **CAKE)
    assert found == pytest.approx(by_hand, rel=1e-8)


def test_newtons_filtrate_is_ruths() -> None:
    newton = {name: value for name, value in CAKE.items() if name not in ("void_fraction", "solid_density")}
    V = np.array([0.0, 1e-9, 1e-3, 0.05])
    found = time.function(V, consistency=2e-3, flow_index=1.0, medium_resistance=5e10, **CAKE)
    ruth = gr.filtration.filtration_time_constant_pressure.function(
        V, dynamic_viscosity=2e-3, medium_resistance=5e10, **newton
    )
    np.testing.assert_allclose(found, ruth, rtol=1e-9)


def test_time_grows_with_the_volume_to_one_plus_one_over_n() -> None:
    """Shirato and others: a straight line of that slope on paper with two logarithmic scales."""
    for n in (0.5, 0.75):
        once, twice = (time(V, consistency=0.1, flow_index=n, **CAKE) for V in (0.01, 0.02))
        assert np.log2(twice / once) == pytest.approx(1.0 + 1.0 / n, rel=1e-9)


def test_a_press_fills_by_the_power_law_and_by_ruth_for_an_index_of_one() -> None:
    key, water = "filtration.chamber_press", {"consistency": "1.2 cP", "flow_index": 1.0}
    newton = gr.alone(key, **water).solve()
    figures = newton.solution.sheets["chamber_press"].figures
    plain = gr.alone(key).solve()
    given, viscosity = plain.solution.sheets["chamber_press"].figures, plain.streams["feed"].liquid_viscosity
    # time in proportion to the viscosity, all else the same
    assert figures.formation_time / given.formation_time == pytest.approx(1.2e-3 / float(viscosity), rel=1e-9)
    # twice the cake takes 2^(1 + 1/n) of the time without a medium
    thin = {"consistency": "0.02 Pa s", "flow_index": 0.5, "medium_resistance": "1e3 1/m"}
    once, twice = (
        gr.alone(key, chamber_depth=depth, **thin).solve().figure("chamber_press.formation_time")
        for depth in ("15 mm", "30 mm")
    )
    assert np.log2(twice / once) == pytest.approx(3.0, abs=1e-4)


def test_washing_and_draining_are_told_and_curved_cakes_refuse() -> None:
    thin = {"consistency": "0.02 Pa s", "flow_index": 0.5}
    told = "flow index of a liquid that is washed or drained as one of Newton"

    def checked(key: str, **more: object):
        run = gr.alone(f"filtration.{key}", **thin, **more).solve()
        assert run.audit["mass_closure"] < 1e-9
        return run, {c.name: c for c in run.solution.sheets[key].checks}

    _run, plain = checked("chamber_press")
    assert plain[told].ok
    _run, drained = checked("chamber_press", deliquoring_time="5 min")
    assert not drained[told].ok
    # thicker than water where it flows, it drains less than water does
    water = gr.alone("filtration.chamber_press", deliquoring_time="5 min").solve()
    thick = gr.alone(
        "filtration.chamber_press", deliquoring_time="5 min", consistency="2 Pa s", flow_index=0.8
    ).solve()
    saturation = "chamber_press.cake_saturation"
    assert thick.figure(saturation) > water.figure(saturation)
    with pytest.raises(CaseError, match="both 'consistency' and 'flow_index'"):
        gr.alone("filtration.nutsche", flow_index=0.5).solve()
    for key in ("candle_filter", "tube_press"):
        with pytest.raises(InputError, match="consistency"):
            gr.alone(f"filtration.{key}", **thin)
