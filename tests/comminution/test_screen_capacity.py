"""Karra's screen, and the mill over time."""

from __future__ import annotations

import jax.numpy as jnp
import numpy as np
import pytest
from scipy.integrate import solve_ivp
from tests.sharing.places import EXAMPLES

from granum.cases.reading import read
from granum.comminution.breakage import AustinBreakage, AustinSelection
from granum.comminution.equipment.vibrating_screen import VibratingScreen
from granum.comminution.formulas import screen_capacity as karra
from granum.comminution.population import rate_matrix
from granum.comminution.transients import mill_response
from granum.core.errors import ApplicabilityError, InputError
from granum.particles.partition import LogisticPartition
from granum.streams.audit import closure

CIRCUIT = EXAMPLES / "grinding-circuit" / "circuit.toml"


def capacity(h=20e-3, Q=0.25, R=0.40, X=0.15, **more):
    return float(karra.screening_capacity_karra(h, Q, R, X, **more)) * 3.6  # t/(h m2)


def test_factors_by_hand_from_karras_equations() -> None:
    basic = 12.1286 * 20**0.3162 - 10.2991  # 20.98 t/(h m2)
    near = 0.844 * 0.85**3.453
    assert capacity() == pytest.approx(basic * 1.3 * 0.1528 * 40**0.564 * near, rel=1e-12)
    assert capacity(h=60e-3) / near == pytest.approx(
        (0.3388 * 60 + 14.4122) * 1.3 * 0.1528 * 40**0.564, rel=1e-12
    )
    for R, factor in ((0.2, 0.94), (0.7, 0.0061 * 70**1.37), (0.9, 3.0)):
        assert capacity(R=R) / (basic * 1.3 * near) == pytest.approx(factor, rel=1e-12)
    assert capacity(Q=0.95) / capacity(Q=0.25) == pytest.approx((4.275 - 4.0375) / 1.3, rel=1e-12)
    assert capacity(deck=3) / capacity() == pytest.approx(0.8, rel=1e-12)
    assert capacity(bulk_density=801.0) / capacity() == pytest.approx(0.5, rel=1e-12)
    # wet screening helps most between 3.2 and 4.8 mm (1.26 h = 4 to 6), and not at all for large openings
    assert capacity(h=4e-3, wetting="wet") / capacity(h=4e-3) == pytest.approx(2.5, rel=1e-12)
    assert capacity(h=2.4e-3, wetting="wet") / capacity(h=2.4e-3) == pytest.approx(
        1.5 + 0.25 * 1.26 * 2.4, rel=1e-12
    )
    assert capacity(h=15e-3, wetting="wet") / capacity(h=15e-3) == pytest.approx(
        1.5 - 0.0125 * 18.9, rel=1e-12
    )
    # woven wire of 10 mm is 58.5 % open by the source's line
    assert capacity(h=10e-3, open_area_fraction=0.585) == pytest.approx(capacity(h=10e-3), rel=1e-12)


def test_the_printed_pieces_meet_within_their_rounding() -> None:
    for pair, key in (
        ((0.2999999, 0.3000001), "R"),
        ((0.5499999, 0.5500001), "R"),
        ((0.7999999, 0.8000001), "R"),
        ((0.8699, 0.8701), "Q"),
    ):
        low, high = (capacity(**{key: value}) for value in pair)
        assert low == pytest.approx(high, rel=0.04)
    assert capacity(h=50.79e-3) == pytest.approx(capacity(h=50.81e-3), rel=0.01)


def test_the_two_printed_forms_of_the_near_size_effect_are_one() -> None:
    # the source gives 0.844 (1 - X)^3.453 for the capacity, reprints 0.975 (1 - X)^0.511 for d50/h_T;
    # 0.148 joins them
    for X in (0.05, 0.2, 0.4):
        loaded = karra.cut_size_karra(1.0, 3.0, 3.0 * 0.844 * (1 - X) ** 3.453)
        assert loaded == pytest.approx(0.975 * (1 - X) ** 0.511, rel=1e-3)
    area = karra.screen_area_karra(30.0, 4.0, 0.9)
    assert karra.cut_size_karra(1.0, 30.0 / area, 4.0) == pytest.approx(0.9, rel=1e-12)


def test_throughfall_aperture() -> None:
    assert karra.throughfall_aperture(10e-3, 2e-3, 0.0) == pytest.approx(10e-3)
    assert karra.throughfall_aperture(10e-3, 2e-3, np.radians(20)) == pytest.approx(
        12e-3 * np.cos(np.radians(20)) - 2e-3
    )
    with pytest.raises(ApplicabilityError, match="inclination of the deck"):
        karra.throughfall_aperture(1e-3, 5e-3, 1.2)


def test_a_larger_screen_passes_more_and_loses_nothing() -> None:
    feed = read(CIRCUIT).solve().streams["ground"]
    seen = []
    for area in (2.0, 5.0, 20.0, 1e4):
        unit = VibratingScreen(
            aperture=1e-3, screen_area=area, wetting="wet", deck_inclination=0.3, wire_diameter=0.3e-3
        )
        outlets = unit(feed)
        figures = unit.operate(feed=feed).figures
        assert float(closure([feed], list(outlets), 0.0).mass) < 1e-12
        seen.append(
            (float(figures.screening_recovery), float(figures.cut_size), float(figures.screen_loading))
        )
        assert unit.operate(feed=feed).checks[0].ok == (seen[-1][2] <= 1.0)
    recovery, cut, load = map(np.array, zip(*seen, strict=True))
    assert np.all(np.diff(recovery) > 0)
    assert np.all(np.diff(cut) > 0)
    assert cut[-1] == pytest.approx(1e-3)  # idle: the aperture itself
    np.testing.assert_allclose(load[:2] * [2.0, 5.0], load[1] * 5.0, rtol=1e-9)
    np.testing.assert_allclose(cut[0] / cut[1], (5.0 / 2.0) ** -0.148, rtol=1e-9)
    empty = feed.replace(solid=jnp.zeros_like(feed.solid))
    assert np.all(np.isfinite(np.asarray(unit(empty).undersize.solid)))


EDGES = np.array([0.0, 0.25, 0.5, 1.0, 2.0, 4.0]) * 1e-3
FEED = np.array([0.0, 0.0, 0.1, 0.3, 0.6])
LAWS = (AustinSelection(0.004, 1.0), AustinBreakage(0.5, 0.8, 4.0))


def test_mill_over_time_equals_a_numerical_integration() -> None:
    deck = LogisticPartition(8e-4, 4.0)
    times = np.array([0.0, 60.0, 300.0, 1200.0])
    found = mill_response(EDGES, FEED, 2.0, 0.01, *LAWS, times, holdup_mass=50.0, separation=deck)
    a, back = np.asarray(rate_matrix(EDGES, *LAWS)), np.asarray(deck.over(EDGES[:-1], EDGES[1:]))
    path = solve_ivp(
        lambda t, m: 2.0 * FEED + a @ m - 0.01 * (1 - back) * m,
        (0, 1200),
        50.0 * FEED,
        t_eval=times,
        rtol=1e-10,
        atol=1e-12,
    )
    np.testing.assert_allclose(found.holdup_mass, path.y.sum(axis=0), rtol=1e-8)
    np.testing.assert_allclose(found.mass_flow, 0.01 * ((1 - back)[:, None] * path.y).sum(axis=0), rtol=1e-8)
    np.testing.assert_allclose(
        found.circulating_load, 0.01 * (back[:, None] * path.y).sum(axis=0) / 2.0, rtol=1e-8
    )


def test_open_mill_fills_like_a_stirred_tank_and_ends_in_the_steady_mill() -> None:
    found = mill_response(EDGES, FEED, 2.0, 0.01, *LAWS, [0.0, 100.0, 1e4])
    np.testing.assert_allclose(found.holdup_mass, [0.0, 200 * (1 - np.exp(-1)), 200.0], rtol=1e-9, atol=1e-12)
    assert float(found.mass_flow[-1]) == pytest.approx(2.0, rel=1e-9)
    steady = np.linalg.solve(np.eye(5) - 100.0 * np.asarray(rate_matrix(EDGES, *LAWS)), FEED)
    below = np.concatenate([[0.0], np.cumsum(steady)])
    assert float(found.product_size[-1]) == pytest.approx(float(np.interp(0.8, below, EDGES)), rel=1e-6)
    assert float(found.product_size[0]) > float(found.product_size[1])
    with pytest.raises(InputError, match="increase"):
        mill_response(EDGES, FEED, 2.0, 0.01, *LAWS, [10.0, 0.0])
