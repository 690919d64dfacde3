"""Squeezing against Terzaghi's table and the diffusion equation; crystals lost to the wash by hand; membrane
press.
"""

from __future__ import annotations

import jax.numpy as jnp
import numpy as np
import pytest

from granum.core.errors import InputError
from granum.filtration.equipment.batch import MembranePress
from granum.filtration.equipment.continuous import HorizontalBeltFilter
from granum.filtration.formulas.expression import consolidation_ratio_shirato, consolidation_ratio_terzaghi
from granum.filtration.lab_tests.expression import ExpressionTest
from granum.streams.audit import closure
from granum.streams.dissolution import SaturatingWash
from granum.streams.mixture import Mixture, Species
from granum.streams.stream import empty


def test_terzaghi_table_and_series() -> None:
    # the table of every textbook of soil mechanics: U = 10, 20 … 90 % at T = 0.008, 0.031, 0.071, 0.126,
    # 0.197, 0.287, 0.403, 0.567, 0.848
    T = np.array([0.00785, 0.0314, 0.0707, 0.126, 0.197, 0.287, 0.403, 0.567, 0.848])
    np.testing.assert_allclose(consolidation_ratio_terzaghi(T), np.arange(0.1, 0.95, 0.1), atol=1e-3)
    # two thousand terms of the series, both sides of the change
    k = 2 * np.arange(2000) + 1.0
    for t in (1e-4, 0.05, 0.2999, 0.3001, 1.0):
        exact = 1 - np.sum(8 / (k * np.pi) ** 2 * np.exp(-((k * np.pi / 2) ** 2) * t))
        assert consolidation_ratio_terzaghi(t) == pytest.approx(exact, abs=1e-7)
    assert consolidation_ratio_terzaghi(0.0) == 0.0
    # without creep Shirato's short form is Terzaghi's but for the first term's 8/π²
    late = 1 - consolidation_ratio_terzaghi(1.2)
    assert 1 - consolidation_ratio_shirato(1.2, 900.0, 0.0, 1e-3) == pytest.approx(
        late * np.pi**2 / 8, rel=1e-4
    )


def test_squeezing_test_recovers() -> None:
    t = np.linspace(0.0, 2400.0, 40)
    solid, Ce = 5e-3, 2e-8
    L = 0.014 - 0.004 * np.asarray(consolidation_ratio_terzaghi(Ce * t / solid**2))
    noisy = L + 1e-5 * np.random.default_rng(2).normal(size=t.size)
    found = ExpressionTest(t, noisy, solid).fit()
    for name, true in (
        ("consolidation_coefficient", Ce),
        ("cake_thickness_initial", 0.014),
        ("cake_thickness_final", 0.010),
    ):
        low, high = found[name].interval_95
        assert low - 0.3 * (high - low) < true < high + 0.3 * (high - low), name
        assert (high - low) < 0.25 * true
    # drained on both faces the same data mean a quarter of the coefficient
    both = ExpressionTest(t, noisy, solid, drainage_faces=2.0).fit()
    assert both["consolidation_coefficient"].value == pytest.approx(
        found["consolidation_coefficient"].value / 4, rel=1e-3
    )
    with pytest.raises(InputError, match="thinner"):
        ExpressionTest(t, L[::-1], solid).fit()


SALT = Mixture(
    solids=(Species("salt", (("salt", 1.0),), (2000.0,), (900.0,), -4e5),),
    liquids=(
        Species("water", (("water", 1.0),), (1000.0,), (4180.0,)),
        Species("salt", (("salt", 1.0),), (2000.0,), (1500.0,)),
    ),
    gases=(),
    size_edges=tuple(np.geomspace(5e-5, 1e-3, 6)),
    liquid_viscosity=lambda w, T: 1e-3,
)


def feed_and_wash(clean=1.0):
    feed = empty(SALT).replace(solid=jnp.full((1, 5), 0.1), liquid=jnp.array([1.0, 0.3]))
    return feed, empty(SALT).replace(liquid=jnp.array([0.2, 0.2 * (1 - clean) * 0.3]))


def belt(**more):
    return HorizontalBeltFilter(5.0, 3e4, 1e9, 0.45, belt_length=6.0, belt_speed=0.05, **more)


def test_wash_takes_up_crystals_until_saturated() -> None:
    feed, wash = feed_and_wash()
    law = SaturatingWash("salt", "water", 0.3)
    plain, lossy = belt()(feed, wash), belt(wash_dissolution=law)(feed, wash)
    # by hand: mother liquor is saturated, so the wash of 0.2 kg/s of water takes up 0.06 kg/s of salt,
    # wherever it goes
    lost = float(plain.cake.solid_flow - lossy.cake.solid_flow)
    assert lost == pytest.approx(0.06, rel=1e-9)
    for stream in (lossy.cake, lossy.washings):
        assert float(stream.liquid[1] / stream.liquid[0]) == pytest.approx(0.3, rel=1e-9)
    assert float(closure([feed, wash], list(lossy)).mass) < 1e-12
    assert float(closure([feed, wash], list(lossy)).energy) < 1e-9
    assert float(lossy.cake.temperature) < float(plain.cake.temperature)  # it takes heat to dissolve
    figures = belt(wash_dissolution=law).operate(feed=feed, wash=wash).figures
    assert float(figures.dissolved_share) == pytest.approx(0.06 / 0.5, rel=1e-9)
    # half the approach loses half; a saturated wash nothing; no wash nothing
    half = belt(wash_dissolution=SaturatingWash("salt", "water", 0.3, approach=0.5))(feed, wash)
    assert float(plain.cake.solid_flow - half.cake.solid_flow) == pytest.approx(0.03, rel=1e-9)
    sated = feed_and_wash(clean=0.0)[1]
    assert float(belt(wash_dissolution=law)(feed, sated).cake.solid_flow) == pytest.approx(0.5, rel=1e-12)
    assert float(belt(wash_dissolution=law)(feed).cake.solid_flow) == pytest.approx(0.5)
    # a flood of wash cannot dissolve more than there is
    flood = empty(SALT).replace(liquid=jnp.array([50.0, 0.0]))
    drowned = belt(wash_dissolution=law)(feed, flood)
    assert 0.0 < float(drowned.cake.solid_flow) < 1e-3
    with pytest.raises(InputError, match="must be made of"):
        SaturatingWash("salt", "salt", 0.3).out_of(plain)


def test_hydrate_gives_its_water_back() -> None:
    m = Mixture(
        solids=(Species("decahydrate", (("salt", 0.44), ("water", 0.56)), (1460.0,), (1900.0,), 0.0),),
        liquids=SALT.liquids,
        gases=(),
        size_edges=SALT.size_edges,
        liquid_viscosity=lambda w, T: 1e-3,
    )
    feed = empty(m).replace(solid=jnp.full((1, 5), 0.1), liquid=jnp.array([1.0, 0.2]))
    wash = empty(m).replace(liquid=jnp.array([0.2, 0.0]))
    out = belt(wash_dissolution=SaturatingWash("decahydrate", "water", 0.2))(feed, wash)
    # by hand: 0.44 m = 0.2 (0.2 + 0.56 m): m = 0.04/0.328
    assert 0.5 - float(out.cake.solid_flow) == pytest.approx(0.04 / 0.328, rel=1e-9)
    assert float(closure([feed, wash], list(out)).mass) < 1e-12


def test_membrane_press_squeezes_towards_its_end() -> None:
    feed, _wash = feed_and_wash()
    fields = {
        "area": 50.0,
        "pressure_drop": 6e5,
        "cake_resistance": 1e11,
        "void_fraction": 0.6,
        "chamber_depth": 0.03,
        "void_fraction_squeezed": 0.45,
    }
    wet = [
        float(
            MembranePress(**fields, squeezing_time=t, consolidation_coefficient=5e-8)(
                feed
            ).cake.moisture_dry_basis
        )
        for t in (0.0, 197 / 5e-2 * 0.036, 1e6)
    ]
    # ω = 15 mm · 0.4 = 6 mm: half way at T = 0.197, that is after 0.197·36e-6/5e-8 = 141.8 s
    assert wet[1] == pytest.approx(0.5 * (wet[0] + wet[2]), rel=2e-3)
    assert wet[2] == pytest.approx(float(MembranePress(**fields)(feed).cake.moisture_dry_basis), rel=1e-6)
    short = MembranePress(**fields, squeezing_time=60.0, consolidation_coefficient=5e-8)
    assert not next(c for c in short.operate(feed=feed).checks if "reached" in c.name).ok


@pytest.mark.parametrize(("solid", "water"), [(0.0, 1.0), (0.1, 0.0), (0.0, 0.0)])
def test_empty_feeds_give_numbers(solid: float, water: float) -> None:
    feed, wash = (
        empty(SALT).replace(solid=jnp.full((1, 5), solid), liquid=jnp.array([water, 0.3 * water])),
        feed_and_wash()[1],
    )
    unit = belt(wash_dissolution=SaturatingWash("salt", "water", 0.3))
    out = unit(feed, wash)
    figures = unit.operate(feed=feed, wash=wash).figures
    assert all(np.isfinite(float(x)) for x in figures if x is not None)
    assert float(closure([feed, wash], list(out)).mass) < 1e-12
    assert all(float(s.liquid.min()) >= 0.0 for s in out)
