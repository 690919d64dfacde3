"""Cake filtration with a filtrate that is a power-law liquid."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.integrate import quad

import granum as gr

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
