"""Stirred vessels: power, shear, heat at the wall and scale-up, against printed examples."""

from __future__ import annotations

import numpy as np
import pytest

import granum as gr

TURN = 2.0 * np.pi


def test_kern_jacketed_vessel():
    """Kern, Process Heat Transfer, example 20.1 (opened): 588 Btu/(h ft² °F) from a chart read to 1100, which
    its own equation puts at 1061.
    """
    foot, pound, hour = 0.3048, 0.45359237, 3600.0
    conductance = 5.678263  # W/(m² K) per Btu/(h ft² °F)
    h = gr.streams.heat_transfer_coefficient_stirred(
        rotation_speed="125 rpm",
        impeller_diameter=0.6 * foot,
        vessel_diameter=1.01 * foot,
        density=62.5 * pound / foot**3,
        dynamic_viscosity=1.06 * pound / foot / hour,
        specific_heat_capacity=4186.8,
        thermal_conductivity=0.38 * 1.730735,
        impeller="paddle",
    )
    assert float(h) / conductance == pytest.approx(588.0, rel=0.05)
    by_equation = 1061.0 * 0.38 / 1.01 * 1.41  # with Kern's own numbers
    assert float(h) / conductance == pytest.approx(by_equation, rel=0.005)


def test_power_of_the_handbook():
    """Dickey, example 12.1 (opened): 58 in pitched blades at 84 rev/min, 1150 kg/m³, with the power number
    1.37 of turbulent flow.
    """
    made = gr.streams.stirring("84 rpm", "58 in", 10.0, 1150.0, 1e-3)
    assert float(made.shaft_power) == pytest.approx(1.37 * 1150.0 * 1.4**3 * 1.4732**5, rel=1e-6)
    assert float(made.tip_speed) == pytest.approx(np.pi * 1.4 * 1.4732, rel=1e-6)
    assert float(made.reynolds) == pytest.approx(1150.0 * 1.4 * 1.4732**2 / 1e-3, rel=1e-6)
    told = gr.streams.stirring.evaluate("84 rpm", "58 in", 10.0, 1150.0, 12.0)
    assert [n["flag"] for n in told.notices] == ["extrapolated"]  # the example's own 12 Pa s is not turbulent


def test_scale_up_of_a_turbine():
    """A pilot vessel of 0.3 m takes 0.4 kW/m³ and mixes in 15 s (McCabe, ch. 9; lecture notes of S. Ahmed,
    opened). In 1.8 m the same time costs 36 times the power per volume; the same power 3.3 times the time.
    Dickey (opened): speeds fall with the diameter for the same tip speed, with its power 2/3 for the same
    power per volume.
    """
    rules = gr.streams.scale_up_stirrer("300 rpm", 0.1, 0.6)
    power, tip, just, film, speed, reynolds = range(6)
    assert 0.4 * rules.specific_power_ratio[speed] == pytest.approx(14.4)
    slower = np.asarray(rules.rotation_speed_large) / (300.0 / 60.0 * TURN)
    assert 15.0 / slower[power] == pytest.approx(49.5, rel=2e-3)
    assert slower[tip] == pytest.approx(1 / 6)
    assert rules.specific_power_ratio[power] == pytest.approx(1.0)
    assert rules.tip_speed_ratio[tip] == pytest.approx(1.0)
    assert rules.suspension_ratio[just] == pytest.approx(1.0)
    assert rules.heat_transfer_ratio[film] == pytest.approx(1.0)
    assert slower[reynolds] * 6.0**2 == pytest.approx(1.0)


def test_scale_up_agrees_with_the_formulas():
    """Each ratio is that of two calls of the cards themselves."""
    rules = gr.streams.scale_up_stirrer("240 rpm", 0.12, 0.9)
    small, large = (0.12, 240 / 60 * TURN), [(0.9, float(w)) for w in rules.rotation_speed_large]

    def film(D, w):
        return float(gr.streams.heat_transfer_coefficient_stirred(w, D, 3.0 * D, 1000.0, 1e-3, 4180.0, 0.6))

    def just(D, w):
        return w / float(gr.streams.rotation_speed_zwietering(D, 2e-4, 2100.0, 1000.0, 1e-3, 5.0))

    def mean(D, w):
        return float(gr.streams.stirring(w, D, 27 * np.pi / 4 * D**3, 1000.0, 1e-3).specific_power_input)

    for ratios, law in (
        (rules.heat_transfer_ratio, film),
        (rules.suspension_ratio, just),
        (rules.specific_power_ratio, mean),
    ):
        expected = [law(*there) / law(*small) for there in large]
        np.testing.assert_allclose(np.asarray(ratios), expected, rtol=1e-9)
