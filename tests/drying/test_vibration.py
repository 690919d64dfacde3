"""Throw on a vibrating floor against a grain followed in small steps, and what conveyors are known for."""

from __future__ import annotations

import numpy as np
import pytest

from granum import drying

G = 9.80665


def followed(amplitude: float, frequency: float, angle: float) -> tuple[float, float, float]:
    """Share in the air, mean velocity and power of one grain: it sticks to the floor until that falls faster
    than gravity, flies its parabola and lands without a bounce.
    """
    omega, steps = 2.0 * np.pi * frequency, 40000
    up, along = amplitude * np.sin(angle), amplitude * np.cos(angle)
    step = 1.0 / frequency / steps
    t = begin = np.arcsin(G / (up * omega**2)) / omega + step
    z0 = up * np.sin(omega * t)
    u, w = along * omega * np.cos(omega * t), up * omega * np.cos(omega * t)
    later = t + step * np.arange(10, 2 * steps)
    above = z0 + w * (later - t) - 0.5 * G * (later - t) ** 2 - up * np.sin(omega * later)
    land = later[np.argmax(above < 0.0)]
    flown = land - begin
    way = u * flown + along * (np.sin(omega * (begin + 1.0 / frequency)) - np.sin(omega * land))
    hit = w - G * flown - up * omega * np.cos(omega * land), u - along * omega * np.cos(omega * land)
    lost = 0.5 * (hit[0] ** 2 + hit[1] ** 2)
    return flown * frequency, way * frequency, lost * frequency


@pytest.mark.parametrize(
    "setting", [(5e-3, 10.0, 0.785), (3e-3, 16.0, 1.4), (2e-3, 20.0, 0.6), (4e-3, 11.0, 0.7)]
)
def test_a_grain_followed_in_small_steps(setting: tuple[float, float, float]) -> None:
    found = drying.vibration_throw(*setting)
    by_steps = followed(*setting)
    told = (found.flight_share, found.throw_velocity, found.vibration_power)
    np.testing.assert_allclose([float(v) for v in told], by_steps, rtol=2e-3)


def test_a_throw_number_of_three_point_three_flies_a_whole_period() -> None:
    """As handbooks of conveying have it; each landing then hits at gravity times the period."""
    angle, frequency = 0.6, 12.0
    amplitude = 3.297 * G / ((2.0 * np.pi * frequency) ** 2 * np.sin(angle))
    found = drying.vibration_throw(amplitude, frequency, angle)
    assert float(found.throw_number) == pytest.approx(3.297)
    assert float(found.flight_share) == pytest.approx(1.0, abs=1e-3)
    assert float(found.vibration_power) == pytest.approx(0.5 * G**2 / frequency, rel=5e-3)


def test_a_maker_of_conveyors_has_the_same_speed() -> None:
    """600 strokes a minute of 10 mm: 22.86 m/min in theory, and 70 to 80 % of it in practice, on his page,
    which does not tell the angle; a stroke is taken as the amplitude, at 45°.
    """
    found = drying.vibration_throw("10 mm", 10.0, "45 degree")
    assert float(found.throw_velocity) == pytest.approx(22.86 / 60.0, rel=0.15)


def test_what_is_not_thrown_stays_and_more_throw_is_faster() -> None:
    rest = drying.vibration_throw("1 mm", 10.0, "45 degree")
    assert float(rest.flight_share) == float(rest.throw_velocity) == float(rest.vibration_power) == 0.0
    found = drying.vibration_throw(np.linspace(3.6e-3, 11e-3, 30), 10.0, 0.785)
    assert (np.diff(found.throw_velocity) > 0.0).all()
    assert (np.diff(found.flight_share) > 0.0).all()


def test_vibration_spares_gas() -> None:
    found = drying.minimum_mixing_velocity_gupta_mujumdar(0.4, np.linspace(0.0, 1.4, 15))
    assert (np.diff(found) < 0.0).all()
    assert found[0] == pytest.approx(0.4 * 1.952)
    assert float(drying.minimum_mixing_velocity_gupta_mujumdar(0.4, 3.0)) == 0.0
