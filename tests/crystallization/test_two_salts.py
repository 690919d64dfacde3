"""Salts beside each other: against tables of ternary systems, Pitzer's equation of one salt, and balances."""

from __future__ import annotations

import jax
import jax.numpy as jnp
import numpy as np
import pytest
from tests.sharing.places import EXAMPLES

import granum as gr
from granum.core.errors import InputError
from granum.crystallization.equipment.two_salts import TwoSaltCrystallizer
from granum.crystallization.vessels.common_ion import (
    crystallization_path,
    four_of,
    invariant_point,
    pair_of,
    parted,
    reciprocal_saturation,
)
from granum.materials.brines import brine
from granum.streams.from_materials import mixture_of
from granum.streams.stream import empty

PAIR = pair_of("sodium chloride", "potassium chloride")
NAMES = ["sodium chloride", "potassium chloride"]
CHLORIDES = mixture_of(["water", *NAMES], NAMES, ["water"], np.geomspace(1e-5, 4e-3, 21))


def with_all(salts, temperature, which):
    """The solution beside a surplus of some salts."""
    amounts = np.zeros(len(salts.salts))
    amounts[list(which)] = 3.0 * np.asarray(salts.alone(jnp.asarray(temperature)))[list(which)]
    return parted(salts, temperature, jnp.asarray(amounts @ salts.ions_per_salt))


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


@pytest.mark.parametrize(
    ("first", "second", "humidity", "within"),
    [
        ("sodium chloride", "potassium chloride", 0.727, 0.006),
        ("sodium chloride", "sodium sulfate", 0.742, 0.005),
        ("sodium chloride", "sodium nitrate", 0.676, 0.008),
    ],
)
def test_humidity_over_both_salts(first, second, humidity, within):
    """Above which mixed crystals draw water at 25 °C (Tang and Munkelwitz, 1993 and 1994; recalled)."""
    found = invariant_point(temperature=298.15, first_salt=first, second_salt=second)
    assert found.water_activity == pytest.approx(humidity, abs=within)


def test_sulfate_beside_salt_at_90_degrees():
    """25.75 % NaCl and 5.71 % Na2SO4 at 90 °C (point 15 of table 9 of doi 10.1021/acsomega.9b03703, opened;
    its own NaCl alone is 27.80 %, its uncertainty 5 %); 26 and 4.4 in Linke and Seidell at 100 °C, recalled.
    """
    found = invariant_point(temperature=363.15, first_salt="sodium chloride", second_salt="sodium sulfate")
    assert 100 * found.solute_mass_fraction_first == pytest.approx(25.75, abs=0.5)
    assert 3.5 < 100 * found.solute_mass_fraction_second < 5.8


def test_salt_drives_glaubers_salt_out_of_its_water():
    """In salt water the decahydrate loses its water at 17.9 °C in place of 32.4 (recalled)."""
    pair = pair_of("sodium chloride", "sodium sulfate")
    names = [c.name for c in pair.crystals]
    wet, dry = names.index("sodium sulfate decahydrate"), names.index("sodium sulfate anhydrous")
    cold, warm = (with_all(pair, 273.15 + t, (0, 1)).crystals for t in (15.5, 20.5))
    assert cold[wet] > 0.0 == cold[dry]
    assert warm[dry] > 0.0 == warm[wet]


def test_one_salt_alone_is_pitzers_equation_of_one_salt():
    law = gr.materials.solute("sodium chloride").activity_law
    for m in (0.1, 1.0, 5.0):
        mixed = PAIR.water_activity(jnp.asarray(323.15), m * jnp.asarray(PAIR.ions_per_salt[0]))
        assert float(mixed) == pytest.approx(float(law(323.15, m * 0.05844277)), rel=1e-8)


@pytest.mark.parametrize(
    ("x", "expected"),
    [(0.5, 0.043508), (5.0, 0.920354), (20.0, 4.454533)],
)
def test_unsymmetrical_mixing_is_pitzers_integral(x, expected):
    """Harvie's series for the same integral, evaluated with the open-source package pytzer 0.6."""
    found = gr.materials.electrostatic_mixing_function(electrostatic_mixing_argument=x)
    assert found == pytest.approx(expected, rel=0.015)


def test_products_and_humidity_obey_gibbs_and_duhem():
    """n_w d ln a_w + Σ m d ln(product) = 0 along any change of composition, also of unlike charges."""
    pair, T, m = pair_of("sodium chloride", "sodium sulfate"), jnp.asarray(313.15), jnp.array([3.0, 1.5])
    table = jnp.asarray(pair.ions_per_salt)
    given = pair.coefficients(T)
    d = jnp.array([1.0, -0.7])
    places = jnp.array([0, [c.name for c in pair.crystals].index("sodium sulfate anhydrous")])

    def logs(x):
        products, water = pair._products(given, x @ table)
        return products[places], water

    (_products, _water), (change, water) = jax.jvp(jax.jit(logs), (m,), (d,))
    assert float(water) / 0.01801528 == pytest.approx(-float(jnp.sum(m * change)), rel=1e-6)


@pytest.mark.parametrize(
    ("first", "second", "which"),
    [(2.0, 1.0, "none"), (8.0, 1.0, "first"), (2.0, 8.0, "second"), (8.0, 8.0, "both"), (0.0, 8.0, "second")],
)
def test_what_crystallizes(first, second, which):
    T, table = 298.15, jnp.asarray(PAIR.ions_per_salt)
    left = parted(PAIR, T, jnp.array([first, second]) @ table)
    assert bool(left.found)
    assert (float(left.crystals[0]) > 1e-9) == (which in ("first", "both"))
    assert (float(left.crystals[1]) > 1e-9) == (which in ("second", "both"))
    ratios = PAIR.saturation(T, left.molalities)
    for made, ratio in zip(left.crystals, ratios, strict=True):
        assert float(ratio) == pytest.approx(0.0, abs=1e-9) if made > 1e-9 else ratio < 1e-9


def test_cooling_gives_potassium_and_boiling_sodium_chloride():
    """The two steps by which potash works part the salts: saturated with both at 95 °C."""
    hot = np.asarray(with_all(PAIR, 368.15, (0, 1)).molalities)
    feed = solution(1.0, hot[0] * 0.05844277, hot[1] * 0.0745513)
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
    np.testing.assert_allclose((path.first / water)[cooling], (path.first / water)[path.boiled], rtol=1e-7)
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


RECIPROCAL = mixture_of(
    ["water", "sodium nitrate", "potassium chloride", "sodium chloride", "potassium nitrate"],
    ["potassium nitrate", "sodium chloride", "sodium nitrate"],
    ["water"],
    np.geomspace(1e-5, 4e-3, 7),
)
SULFATES = mixture_of(
    ["water", "sodium chloride", "sodium sulfate"],
    ["sodium chloride", "sodium sulfate decahydrate", "sodium sulfate anhydrous"],
    ["water"],
    np.geomspace(1e-5, 4e-3, 7),
)


@pytest.mark.parametrize(("mixture", "low", "wide"), [(SULFATES, 278.0, 90.0), (RECIPROCAL, 286.0, 22.0)])
def test_it_closes_at_random_settings(mixture, low, wide):
    """Mass of each component, energy, and nothing above saturation, wherever the feed comes from."""
    rng, salts = np.random.default_rng(5), len(mixture.liquids) - 1
    found = brine([s.name for s in mixture.liquids[1:]])
    solids = jnp.zeros((len(mixture.solids), 6))

    @jax.jit
    def made_of(T, liquid, crystals, given):
        feed = empty(mixture, given).replace(liquid=liquid, solid=solids.at[0, 3].set(crystals))
        operated = TwoSaltCrystallizer(T, 5.0, evaporation=0.1).operate(feed=feed)
        made = operated.outlets
        mass = made.product.components + made.vapor.components - feed.components
        energy = made.product.enthalpy_flow + made.vapor.enthalpy_flow - feed.enthalpy_flow - made.heat_duty
        ions = sum(
            made.product.liquid[i + 1] / M * jnp.asarray(row)
            for i, (M, row) in enumerate(zip(found.molar_masses, found.ions_per_salt, strict=True))
        )
        over = jnp.max(found.saturation(T, ions / made.product.liquid[0]))
        return mass, energy, over, made.product.liquid, made.product.solid_by_species

    for _try in range(60):
        x = rng.random(salts + 3)
        liquid = jnp.append(jnp.ones(1), 0.4 * jnp.asarray(x[:salts]) ** 2)
        mass, energy, over, left, solid = made_of(
            low + wide * x[-1], liquid, 0.2 * x[-2], 280.0 + 80.0 * x[-3]
        )
        assert np.max(np.abs(mass)) < 1e-12
        assert abs(float(energy)) < 1e-4
        assert np.min(left) > -1e-12
        assert np.min(solid) >= 0.0
        crystals = {c.name for c in found.crystals} == {s.name for s in mixture.solids}
        assert not crystals or float(over) < 1e-6


def test_saltpetre_by_conversion():
    """Sodium nitrate and potassium chloride give potassium nitrate on cooling: the pair that is stable
    together is that with salt, by which the conversion saltpetre of the trade was made.
    """
    liquid = jnp.array([0.45, 0.30, 0.25, 0.0, 0.0])
    feed = empty(RECIPROCAL, 363.15).replace(liquid=liquid)
    made = TwoSaltCrystallizer(293.15, 10.0).operate(feed=feed)
    nitrate, salt, other = (float(x) for x in made.outlets.product.solid_by_species)
    assert nitrate > 0.12
    assert salt < 0.4 * nitrate
    assert other == 0.0
    assert reciprocal_saturation("25 degC", 0.7, 0.1).crystal == "potassium nitrate"
    assert reciprocal_saturation("25 degC", 0.1, 0.9).crystal == "sodium chloride"


def test_potassium_nitrate_beside_salt_at_25_degrees():
    """41.1 g of KNO3 and 38.3 g of NaCl in 100 g of water at 25 °C, both saturated (Soch, 1898; recalled);
    the model gives a fifth more nitrate: its coefficients end at 3.8 mol/kg of it.
    """
    four = four_of("sodium nitrate", "potassium chloride")
    names = [s.name for s in four.salts]
    left = with_all(four, 298.15, (names.index("sodium chloride"), names.index("potassium nitrate")))
    ions = dict(zip(four.ions, np.asarray(left.molalities), strict=True))
    assert ions["Cl"] * 58.44 / 10.0 == pytest.approx(38.3, rel=0.05)
    assert ions["NO3"] * 101.10 / 10.0 == pytest.approx(41.1, rel=0.25)
    told = reciprocal_saturation.evaluate("25 degC", 0.5, 0.5).notices
    assert [row["worst"] > row["high"] for row in told] == [True]  # nor is that kept quiet


def test_other_pairs_are_refused():
    with pytest.raises(InputError, match="known are ions"):
        invariant_point(temperature=298.15, first_salt="sodium chloride", second_salt="copper sulfate")
    with pytest.raises(InputError, match="known are ions"):
        gr.crystallization.reciprocal_chart(298.15, "sodium sulfate", "calcium chloride")  # gypsum
    with pytest.raises(InputError, match="share no ion"):
        invariant_point(298.15, "sodium nitrate", "potassium chloride")
    with pytest.raises(InputError, match="share an ion"):
        reciprocal_saturation(298.15, 0.5, 0.5, "sodium chloride", "potassium chloride")


def test_the_line_parts_both_salts():
    run = gr.read(EXAMPLES / "two-salts" / "line.toml").solve()
    assert max(run.audit["mass_closure"], run.audit["energy_closure"]) < 1e-9
    assert all(check.ok for unit in run.units.values() for check in unit.checks)
    for name, i in (("salt_cake", 0), ("potash_cake", 1)):
        cake = run.streams[name]
        assert float(cake.solid_by_species[i] / cake.solid_flow) > 0.999
