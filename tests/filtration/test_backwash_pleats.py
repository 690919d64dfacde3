"""Backwash against the expansion it inverts, pleats against quadrature of the channels, a deep bed in a
line.
"""

from __future__ import annotations

import equinox as eqx
import jax.numpy as jnp
import numpy as np
import pytest
from scipy.optimize import minimize_scalar

from granum.core.errors import ApplicabilityError
from granum.filtration.equipment.deep_bed import DeepBedFilter
from granum.filtration.formulas import backwash, pleats
from granum.fluidization.formulas.expansion import graded_bed_expansion
from granum.streams.audit import closure
from granum.streams.mixture import Mixture, Species
from granum.streams.stream import empty

SIZES, PARTS = np.array([5e-4, 7e-4, 1e-3]), np.array([0.3, 0.4, 0.3])
WATER = (2650.0, 999.1, 1.14e-3)


def test_backwash_inverts_the_expansion() -> None:
    U = backwash.backwash_velocity(0.2, SIZES, PARTS, *WATER, 0.42, 0.8)
    assert graded_bed_expansion(SIZES, PARTS, 0.7, U, *WATER, 0.42, 0.8).bed_expansion == pytest.approx(
        0.2, rel=1e-8
    )
    # colder, more viscous water needs less; heavier grains more
    assert backwash.backwash_velocity(0.2, SIZES, PARTS, 2650.0, 1000.0, 1.6e-3, 0.42, 0.8) < U
    assert backwash.backwash_velocity(0.2, SIZES, PARTS, 4000.0, 999.1, 1.14e-3, 0.42, 0.8) > U
    # spheres of 0.7 mm against another law, Wen and Yu's ε^4.7 Ar = 18 Re + 2.7 Re^1.687 at ε = 1 - 0.58/1.2,
    # by hand:
    # Ar = 4268, ε^4.7 Ar = 191: Re = 6.8, 39.9 m/h
    one = backwash.backwash_velocity(0.2, SIZES[1:2], np.ones(1), *WATER, 0.42)
    assert 3600 * one == pytest.approx(39.9, rel=0.03)
    # 0.7 m of sand of 42 % voids weighs 0.7·0.58·1.65 m of water
    assert backwash.head_loss_backwash(0.7, 2650.0, 1000.0, 0.42) == pytest.approx(0.7 * 0.58 * 1.65)


def test_backwash_of_sand_whose_fines_go_first() -> None:
    sizes, parts = np.array([1e-4, 1e-3, 2e-3]), np.array([0.01, 0.39, 0.6])
    with pytest.raises(ApplicabilityError, match="carries the finest class off"):
        backwash.backwash_velocity(0.5, sizes, parts, *WATER, 0.42)


def test_pleats_by_quadrature_of_the_channels() -> None:
    v, h, p, t, eta, k = 1.5, 0.05, 5e-3, 5e-4, 1.8e-5, 2000.0
    gap, u0 = p / 2 - t, 1.5 * p / (p / 2 - t)
    # along the way of each share of the air: in to x, through, out from x, between plates 12 η u/w², averaged
    # over the shares
    x = np.linspace(0.0, h, 2001)
    fall = 12 * eta * u0 / gap**2 * (1 - x / h)
    into = np.concatenate([[0.0], np.cumsum(0.5 * (fall[1:] + fall[:-1]) * np.diff(x))])
    rise = 12 * eta * u0 / gap**2 * (x / h)
    out = np.concatenate([np.cumsum((0.5 * (rise[1:] + rise[:-1]) * np.diff(x))[::-1])[::-1], [0.0]])
    found = pleats.pressure_drop_pleated(v, h, p, t, eta, k)
    assert found == pytest.approx(k * v * p / (2 * h) + np.trapezoid(into + out, x) / h, rel=1e-6)
    # the best pitch is the least of the curve
    least = minimize_scalar(
        lambda q: float(pleats.pressure_drop_pleated(v, h, q, t, eta, k)),
        bounds=(1.2e-3, 2e-2),
        method="bounded",
        options={"xatol": 1e-10},
    )
    assert pleats.pleat_pitch_best(h, t, eta, k) == pytest.approx(least.x, rel=1e-5)
    with pytest.raises(ApplicabilityError, match="pitch of the pleats"):
        pleats.pressure_drop_pleated(v, h, 0.9e-3, t, eta, k)


CLAY = Mixture(
    solids=(Species("clay", (("clay", 1.0),), (2600.0,), (900.0,)),),
    liquids=(Species("water", (("water", 1.0),), (999.1,), (4190.0,)),),
    gases=(),
    size_edges=tuple(np.geomspace(5e-7, 5e-5, 9)),
    liquid_viscosity=lambda w, T: 1.14e-3,
)


def test_deep_bed_in_a_line() -> None:
    # 10 m/h of water with 10 mg/L over 20 m²
    feed = empty(CLAY).replace(
        solid=jnp.full((1, 8), 10e-3 / 8 * 200 / 3600), liquid=jnp.array([999.1 * 200 / 3600])
    )
    bed = DeepBedFilter(20.0, 1.0, 8e-4)
    out = eqx.filter_jit(bed)(feed)
    assert float(closure([feed], list(out)).mass) < 1e-12
    figures = bed.operate(feed=feed).figures
    assert 3600 * float(figures.superficial_velocity) == pytest.approx(10.0, rel=1e-4)
    # Kozeny by hand: 180 η U (1-ε)²/(ρ g d² ε³)
    clean = 180 * 1.14e-3 * (10 / 3600) * 0.58**2 / (999.1 * 9.80665 * (0.8 * 8e-4) ** 2 * 0.42**3)
    assert float(figures.head_loss_clean) == pytest.approx(clean, rel=1e-3)
    # what the head allows over what each hour adds: 1 m per kg/m² caught
    kept = float(figures.removal_efficiency) * 10e-3 * 10 / 3600
    assert float(figures.run_time) == pytest.approx((2.0 - clean) / kept, rel=1e-3)
    share = float(figures.backwash_velocity) * 600 / (10 / 3600 * (float(figures.run_time) + 600))
    assert float(figures.wash_water_share) == pytest.approx(share, rel=1e-4)
    assert float(out.washings.liquid[0] / feed.liquid[0]) == pytest.approx(share, rel=1e-4)
    # a given coefficient is Iwasaki's law for every class
    plain = DeepBedFilter(20.0, 1.0, 8e-4, filter_coefficient=2.0)
    assert np.asarray(plain(feed).filtrate.solid / feed.solid) == pytest.approx(np.full((1, 8), np.exp(-2.0)))
    assert [c.ok for c in plain.operate(feed=feed).checks] == [True] * 4
