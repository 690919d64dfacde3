"""Baffled tubes: groups by hand, losses by SciPy and by the closed forms of their limits."""

from __future__ import annotations

from math import comb

import numpy as np
import pytest
from scipy.integrate import quad

import granum as gr
from granum.crystallization.equipment.tubes import stays

LOSS = {"fluid_density": 1200.0, "length": 10.0, "baffle_spacing": 0.03, "baffle_open_area": 0.25}
FACTOR = (1 / 0.25**2 - 1) / (2 * 0.6**2)


def loss(frequency, amplitude, velocity):
    return gr.crystallization.oscillatory_loss(frequency, amplitude, velocity, **LOSS)


def test_oscillation_alone_gives_the_power_of_jealous_and_johnson():
    """2 (1/S² - 1) (2 pi f x0)³ / (3 pi C² l), from the mean of |sin|³, 4/(3 pi); no drop on the whole."""
    found = loss(1.5, 0.01, 0.0)
    peak = 2 * np.pi * 1.5 * 0.01
    assert found.specific_power_input == pytest.approx(2 * 15 * peak**3 / (3 * np.pi * 0.36 * 0.03), rel=1e-7)
    assert found.pressure_drop == pytest.approx(0.0, abs=1e-9 * found.pressure_amplitude_friction)
    # a column of liquid at its turn: density, length, and an acceleration of x0 (2 pi f)²
    assert found.pressure_amplitude_inertia == pytest.approx(1200 * 10 * 0.01 * (3 * np.pi) ** 2, rel=1e-12)


def test_a_steady_flow_loses_what_its_orifices_take():
    found = loss(1.0, 1e-9, 0.05)
    assert found.pressure_drop == pytest.approx(1200 * FACTOR * 0.05**2 * 10 / 0.03, rel=1e-6)
    # the power per mass is the drop times the flow over the mass held
    assert found.specific_power_input == pytest.approx(found.pressure_drop * 0.05 / (1200 * 10), rel=1e-6)


@pytest.mark.parametrize("velocity", [0.005, 0.03, 0.2])
def test_both_together_as_integrated_by_scipy(velocity):
    found = loss(1.0, 0.012, velocity)

    def u(angle):
        return velocity + 2 * np.pi * 0.012 * np.sin(angle)

    cube, square = (
        quad(f, 0, 2 * np.pi, limit=400)[0] / (2 * np.pi)
        for f in (lambda a: abs(u(a)) ** 3, lambda a: u(a) * abs(u(a)))
    )
    assert found.specific_power_input == pytest.approx(FACTOR / 0.03 * cube, rel=1e-5)
    assert found.pressure_drop == pytest.approx(1200 * 10 / 0.03 * FACTOR * square, rel=1e-4)


def test_a_tube_in_a_line_crystallizes_as_plug_flow_and_tells_its_mixing():
    run = gr.alone("crystallization.baffled_tube_crystallizer").solve()
    unit = run.units["baffled_tube_crystallizer"]
    plain = gr.alone(
        "crystallization.plug_flow_crystallizer",
        volume=0.25 * np.pi * 0.015**2 * 45,
        **{
            "feed.mass_flow": "14 kg/h",
            "temperature_program": "{law='power_cooling', temperature_start='32 degC', "
            "temperature_end='26 degC', duration='40 min', cooling_exponent=1.5}",
        },
    ).solve()
    tube = plain.units["plug_flow_crystallizer"].values
    for name in ("crystal_flow", "mean_diameter_mass", "residence_time"):
        assert getattr(unit.values, name) == pytest.approx(getattr(tube, name), rel=1e-6)
    velocity = 45.0 / float(unit.values.residence_time)
    assert unit.values.velocity_ratio_oscillatory == pytest.approx(2 * np.pi * 0.01 / velocity, rel=1e-9)
    assert all(check.low <= check.value <= check.high for check in unit.checks)
    assert run.audit["energy_closure"] < 1e-9


@pytest.mark.parametrize("tanks", [3.0, 12.0, 400.0])
def test_stays_are_those_of_tanks_in_series(tanks):
    """Gamma distribution: mean 1, variance 1/N, third central moment 2/N²."""
    times, shares = (np.asarray(v) for v in stays(tanks))
    assert shares.sum() == pytest.approx(1.0, rel=1e-12)
    assert shares @ times == pytest.approx(1.0, rel=1e-12)
    assert shares @ (times - 1.0) ** 2 == pytest.approx(1.0 / tanks, rel=1e-3)
    assert shares @ (times - 1.0) ** 3 == pytest.approx(2.0 / tanks**2, rel=0.02)


def test_spread_stays_spread_the_sizes_and_keep_the_matter():
    """A few seeds in a liquor that they hardly change grow as they stay: G tau / sqrt(N) is their scatter."""

    def grown(**more):
        few = {"seed_mass_per_solvent": 1e-12, "seed_width": "0 um", "nucleation": {"law": "no_nucleation"}}
        held = "{law='power_cooling', temperature_start='31 degC', temperature_end='31 degC', duration='1 h'}"
        return gr.alone(
            "crystallization.plug_flow_crystallizer", temperature_program=held, **few, **more
        ).solve()

    plain, wide = grown(), grown(tank_number_tube=16.0)
    assert max(wide.audit["energy_closure"], wide.audit["mass_closure"]) < 1e-9
    one, many = (run.units["plug_flow_crystallizer"] for run in (plain, wide))
    path = float(one.values.mean_diameter_mass) - 1e-4
    # D[4,3] of sizes 0.1 mm + path t, t as of 16 tanks, by the moments of the gamma distribution
    mean = [1.0, 1.0]
    for k in range(1, 4):
        mean.append(mean[-1] * (16.0 + k) / 16.0)
    moment = [sum(comb(n, k) * 1e-4 ** (n - k) * path**k * mean[k] for k in range(n + 1)) for n in (3, 4)]
    assert float(many.values.mean_diameter_mass) == pytest.approx(moment[1] / moment[0], rel=1e-3)
    assert float(many.values.nuclei_mass_fraction) == pytest.approx(0.0, abs=1e-12)
