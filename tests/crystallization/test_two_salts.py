"""Sodium and potassium chloride: against tables of the ternary system, Pitzer's equation of one salt, and
balances.
"""

from __future__ import annotations

import jax
import jax.numpy as jnp
import numpy as np
import pytest
from tests.sharing.places import EXAMPLES

import granum as gr
from granum.core.errors import InputError
from granum.crystallization.equipment.two_salts import TwoSaltCrystallizer
from granum.crystallization.vessels.common_ion import crystallization_path, invariant_point, parted
from granum.materials.common_ion import common_ion
from granum.streams.from_materials import mixture_of
from granum.streams.stream import empty

PAIR = common_ion("sodium chloride", "potassium chloride")
NAMES = ["sodium chloride", "potassium chloride"]
CHLORIDES = mixture_of(["water", *NAMES], NAMES, ["water"], np.geomspace(1e-5, 4e-3, 21))


def solution(water, first, second, temperature=368.15):
    return empty(CHLORIDES, temperature).replace(liquid=jnp.array([water, first, second]))


@pytest.mark.parametrize(
    ("celsius", "sodium", "potassium"),
    [(0, 22.4, 7.0), (25, 20.4, 11.1), (50, 18.8, 14.8), (100, 16.8, 21.8)],
)
def test_invariant_points_of_the_tables(celsius, sodium, potassium):
    """Mass percent at the invariant point as tabulated by Linke and Seidell (1965): recalled, not opened."""
    found = invariant_point(temperature=273.15 + celsius)
    assert 100 * found.solute_mass_fraction_first == pytest.approx(sodium, abs=0.6)
    assert 100 * found.solute_mass_fraction_second == pytest.approx(potassium, abs=0.7)


def test_humidity_over_both_salts():
    """Mixed crystals of both draw water above 72.7 % at 25 °C (Tang and Munkelwitz, 1993; recalled)."""
    assert invariant_point(temperature=298.15).water_activity == pytest.approx(0.727, abs=0.006)


def test_one_salt_alone_is_pitzers_equation_of_one_salt():
    law = gr.materials.solute("sodium chloride").activity_law
    for m in (0.1, 1.0, 5.0):
        mixed = PAIR.water_activity(323.15, m, 0.0)
        assert float(mixed) == pytest.approx(float(law(323.15, m * 0.05844277)), rel=1e-9)


def test_products_and_humidity_obey_gibbs_and_duhem():
    """n_w d ln a_w + Σ m d ln(product) = 0 along any change of composition."""
    T, m = 313.15, jnp.array([3.0, 1.5])
    for direction in ([1.0, 0.0], [0.0, 1.0], [1.0, -0.7]):
        d = jnp.asarray(direction)
        products, change = jax.jvp(lambda x: jnp.stack(PAIR.products(T, x[0], x[1])), (m,), (d,))
        _a, water = jax.jvp(lambda x: jnp.log(PAIR.water_activity(T, x[0], x[1])), (m,), (d,))
        assert products.shape == (2,)
        assert float(water) / 0.01801528 == pytest.approx(-float(jnp.sum(m * change)), rel=1e-6)


@pytest.mark.parametrize(
    ("first", "second", "which"),
    [(2.0, 1.0, "none"), (8.0, 1.0, "first"), (2.0, 8.0, "second"), (8.0, 8.0, "both")],
)
def test_what_crystallizes(first, second, which):
    T = 298.15
    one, other = (float(m) for m in parted(PAIR, T, jnp.asarray(first), jnp.asarray(second)))
    full = [float(r) for r in PAIR.saturation(T, one, other)]
    assert (one < first - 1e-9) == (which in ("first", "both"))
    assert (other < second - 1e-9) == (which in ("second", "both"))
    for left, fed, ratio in ((one, first, full[0]), (other, second, full[1])):
        assert ratio == pytest.approx(0.0, abs=1e-9) if left < fed - 1e-9 else ratio < 1e-9


def test_cooling_gives_potassium_and_boiling_sodium_chloride():
    """The two steps by which potash works part the salts: saturated with both at 95 °C."""
    hot = PAIR.invariant(368.15)
    feed = solution(1.0, float(hot[0]) * 0.05844277, float(hot[1]) * 0.0745513)
    cold = TwoSaltCrystallizer(303.15, 10.0).operate(feed=feed).figures
    assert cold.crystal_purity == 1.0
    assert cold.crystal_flow_second > 0.1
    assert cold.crystal_flow_first == pytest.approx(0.0, abs=1e-12)
    lean = solution(1.0, 0.30, 0.15)
    boiled = TwoSaltCrystallizer(368.15, 10.0, evaporation=0.4).operate(feed=lean).figures
    assert boiled.crystal_flow_first > 0.05
    assert boiled.crystal_purity == 1.0
    # 0.70 of the pressure of water, which is 84.5 kPa at 95 °C (steam tables)
    assert boiled.pressure == pytest.approx(float(boiled.water_activity) * 84.5e3, rel=0.005)


def test_a_path_boils_from_the_water_and_cools_from_the_corner_of_the_potash():
    """Straight lines of the triangle (lever rule), ends on the tables' invariant points of above."""
    path = crystallization_path(PAIR, 0.20, 0.14, 373.15, 298.15)
    water = 1.0 - path.first - path.second
    clear = slice(0, 5)
    np.testing.assert_allclose(path.first[clear] / path.second[clear], 0.20 / 0.14, rtol=1e-9)
    boiling, cooling = slice(0, path.boiled + 1), slice(path.boiled, None)
    assert np.all(np.diff(water[boiling]) < 1e-12)
    np.testing.assert_allclose((path.first / water)[cooling], (path.first / water)[path.boiled], rtol=1e-9)
    assert 100 * path.first[path.boiled] == pytest.approx(16.8, abs=0.6)
    assert 100 * path.second[path.boiled] == pytest.approx(21.8, abs=0.7)
    # potash works: of 21.8 g in 61.4 g of water some 11 g come out (the table's solubilities at 25 °C)
    ends = path.second / water
    assert ends[path.boiled] - ends[-1] == pytest.approx((21.8 / 61.4) - (11.1 / 68.5), abs=0.02)


def test_a_path_of_one_salt_ends_at_its_solubility():
    path = crystallization_path(PAIR, 0.0, 0.1, 373.15, 293.15)
    assert np.all(path.first == 0.0)
    # 56.2 and 34.2 g per 100 g of water at 100 and 20 °C (CRC Handbook; recalled)
    got = path.second / (1.0 - path.second)
    assert got[path.boiled] == pytest.approx(0.562, abs=0.006)
    assert got[-1] == pytest.approx(0.342, abs=0.005)


@pytest.mark.parametrize(
    ("said", "words"),
    [
        ({"solute_mass_fraction_first": 0.6, "solute_mass_fraction_second": 0.4}, "leave water"),
        ({"isotherm_temperatures": [298.15, 500.0]}, "from 0 °C to 100 °C, not at 227 °C"),
    ],
)
def test_what_no_triangle_shows_is_refused(said, words):
    with pytest.raises(InputError, match=words):
        gr.crystallization.two_salts_chart(**({"isotherm_temperatures": [298.15, 373.15]} | said))


@pytest.mark.long
def test_it_closes_at_random_settings():
    rng = np.random.default_rng(5)
    made_of = jax.jit(lambda T, share, feed: TwoSaltCrystallizer(T, 5.0, evaporation=share)(feed=feed))
    for _try in range(60):
        a, b, c, d = rng.random(4)
        feed = solution(1.0, 0.45 * a, 0.5 * b, 290.0 + 80.0 * c)
        made = made_of(280.0 + 90.0 * d, 0.5 * c, feed)
        out = made.product.components + made.vapor.components
        np.testing.assert_allclose(out, feed.components, rtol=1e-12)
        ratios = PAIR.saturation(made.product.temperature, *_molalities(made.product))
        assert max(float(r) for r in ratios) < 1e-6


def _molalities(stream):
    return tuple(stream.liquid[i + 1] / stream.liquid[0] / M for i, M in enumerate(PAIR.molar_masses))


def test_other_pairs_are_refused():
    with pytest.raises(InputError, match="known pairs"):
        invariant_point(temperature=298.15, first_salt="sodium chloride", second_salt="sodium sulfate")


def test_the_line_parts_both_salts():
    run = gr.read(EXAMPLES / "two-salts" / "line.toml").solve()
    assert max(run.audit["mass_closure"], run.audit["energy_closure"]) < 1e-9
    assert all(check.ok for unit in run.units.values() for check in unit.checks)
    for name, i in (("salt_cake", 0), ("potash_cake", 1)):
        cake = run.streams[name]
        assert float(cake.solid_by_species[i] / cake.solid_flow) > 0.999
