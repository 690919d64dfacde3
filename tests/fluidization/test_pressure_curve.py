"""The pressure-drop curve: the lab test finds what the data were made from; hysteresis; charts."""

from __future__ import annotations

import numpy as np
import pytest

from granum.core.errors import ApplicabilityError, InputError
from granum.fluidization import curve
from granum.fluidization.lab_tests.pressure_curve import PressureCurve

BED = {"height": 0.3, "particle_density": 2500.0, "fluid_density": 1.2}
WEIGHT = 0.3 * 0.57 * 2498.8 * 9.80665  # ε_mf = 0.43


def made(noise=0.0, up=False):
    U = np.concatenate([np.linspace(0.004, 0.04, 12), np.linspace(0.046, 0.1, 8)])
    dp = WEIGHT * np.minimum(U / 0.04, 1.0) + noise * np.random.default_rng(4).normal(size=U.size)
    if not up:
        return U, dp
    rising = np.where(U < 0.04, 1.15 * U / 0.04, 1.0) * WEIGHT
    return np.concatenate([U, U[::-1]]), np.concatenate([rising, dp[::-1]])


def test_recovers_velocity_and_void_fraction() -> None:
    U, dp = made(noise=25.0)
    found = PressureCurve(U, dp, **BED, mass=0.3 * 0.57 * 2500 * 0.01, area=0.01).fit()
    velocity, void = (
        found["minimum_fluidization_velocity"].interval_95,
        found["bed_void_fraction"].interval_95,
    )
    assert velocity[0] < 0.04 < velocity[1]
    assert velocity[1] - velocity[0] < 0.004
    assert void[0] < 0.43 < void[1]
    assert found["carried_share"].value == pytest.approx(1.0, abs=0.01)


def test_falling_branch_is_used_and_weight_is_compared() -> None:
    U, dp = made(noise=1.0, up=True)
    found = PressureCurve(U, dp, **BED, mass=8.0, area=0.01).fit()
    assert found["minimum_fluidization_velocity"].value == pytest.approx(0.04, rel=2e-3)
    assert {f["flag"] for f in found.flags} >= {"falling branch", "plateau"}


def test_bad_data_are_refused() -> None:
    U, dp = made()
    with pytest.raises(InputError, match="fixed bed"):
        PressureCurve(U[14:], dp[14:], **BED).fit()
    with pytest.raises(ApplicabilityError, match="denser"):
        PressureCurve(U, dp, **{**BED, "particle_density": "1 kg/m3"}).fit()
    with pytest.raises(InputError, match="void_fraction"):
        curve.pressure_velocity(0.5, 2e-4, 2600.0, 1.2, 1.8e-5, 0.38, 0.40)


def test_hysteresis_and_charts() -> None:
    found = curve.pressure_velocity(0.5, 2e-4, 2600.0, 1.2, 1.8e-5)
    assert np.all(found.pressure_drop_rising >= found.pressure_drop_falling - 1e-9)
    assert found.pressure_drop_rising.max() > 1.05 * found.plateau_pressure_drop
    assert found.pressure_drop_falling[-1] == pytest.approx(found.plateau_pressure_drop)
    at = np.interp(
        found.minimum_fluidization_velocity, found.superficial_velocity, found.pressure_drop_falling
    )
    assert at == pytest.approx(found.plateau_pressure_drop, rel=1e-2)
    assert len(curve.pressure_velocity_chart(0.5, 2e-4, 2600.0, 1.2, 1.8e-5).data) == 4
    assert len(curve.geldart_chart(2e-4, 2600.0).data) == 4
    drawing = curve.grace_chart(0.3, 2e-4, 2600.0, 1.2, 1.8e-5)
    fall = next(t for t in drawing.data if t.name == "terminal velocity")
    # Stokes' limit of the map: u* = d*²/18
    assert fall.y[0] == pytest.approx(fall.x[0] ** 2 / 18.0, rel=0.05)
