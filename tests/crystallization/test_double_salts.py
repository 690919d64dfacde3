"""Double salts and salts of magnesium and calcium: against tables of invariant points, and balances."""

from __future__ import annotations

import jax
import jax.numpy as jnp
import numpy as np
import pytest

import granum as gr
from granum.core.errors import InputError
from granum.core.notices import describe
from granum.crystallization.equipment.two_salts import TwoSaltCrystallizer
from granum.crystallization.vessels.common_ion import (
    borders,
    brine_saturation,
    crystallization_path,
    diagram,
    four_of,
    fractions,
    invariant_point,
    isotherm,
    pair_of,
    parted,
)
from granum.materials.brines import brine
from granum.materials.double_salts import DOUBLE_SALTS
from granum.materials.ions import ANIONS, CATIONS, WATER
from granum.streams.from_materials import mixture_of
from granum.streams.stream import empty

EDGES = np.geomspace(1e-5, 4e-3, 7)
SULFATES = pair_of("sodium sulfate", "potassium sulfate")
POTASH = pair_of("potassium chloride", "magnesium chloride")


@pytest.mark.parametrize("name", DOUBLE_SALTS)
def test_they_are_neutral_and_weigh_what_their_ions_do(name):
    double = DOUBLE_SALTS[name]
    charge = sum(n * (CATIONS | ANIONS)[ion][0] for ion, n in double.ions.items())
    mass = sum(n * (CATIONS | ANIONS)[ion][1] for ion, n in double.ions.items()) + double.water * WATER
    assert charge == 0
    assert gr.materials.solid(name).molar_mass == pytest.approx(1e-3 * mass, rel=1e-5)


def of(pair, T):
    found = borders(pair, T)
    names = [tuple(pair.crystals[k].name for k in b.crystals) for b in found]
    return names, [100.0 * np.array(fractions(pair, *b.molalities)) for b in found]


@pytest.mark.parametrize(
    ("celsius", "place", "sodium", "potassium", "within"),
    [(20, 1, 5.41, 10.20, 0.4), (40, 1, 6.03, 12.82, 0.4), (40, 0, 30.65, 5.98, 0.7)],
)
def test_glaserite_between_the_sulfates(celsius, place, sodium, potassium, within):
    """Mass percents of Attia-Essaies and others (abstract opened), behind the product of glaserite at 40 °C.
    Their other point at 20 °C, 22.4 % of Na2SO4, has more than dissolves alone (16 %) and is not taken.
    """
    names, found = of(SULFATES, 273.15 + celsius)
    wet = "decahydrate" if celsius < 30 else "anhydrous"
    assert names == [(f"sodium sulfate {wet}", "glaserite"), ("glaserite", "potassium sulfate")]
    np.testing.assert_allclose(found[place], (sodium, potassium), atol=within)


@pytest.mark.parametrize(
    ("second", "crystals", "sodium", "third", "chloride", "sulfate"),
    [
        ("potassium sulfate", ("sodium chloride", "potassium chloride", "glaserite"), 97, 40, 128, 4.5),
        (
            "potassium sulfate",
            ("sodium chloride", "sodium sulfate anhydrous", "glaserite"),
            118,
            21,
            110,
            14.5,
        ),
        (
            "magnesium sulfate",
            ("sodium chloride", "sodium sulfate anhydrous", "bloedite"),
            98,
            16.5,
            92,
            19.5,
        ),
    ],
)
def test_points_of_the_salts_of_the_sea(second, crystals, sodium, third, chloride, sulfate):
    """Points F, G and H of van 't Hoff's table for 25 °C, mol of ions in 1000 mol of water, as printed in a
    book on chemical cosmography of which the page was opened (goobi.tib.eu 832292737, p. 119): the model
    meets sodium and chloride within 5 %, the lesser ions within 1.5 to 4 mol.
    """
    salts = four_of("sodium chloride", second)
    there = dict(zip(salts.ions, (sodium, third, chloride, sulfate), strict=True))
    ions = 0.05551 * np.array([there[i] for i in salts.ions])
    made = [c for c in salts.crystals if c.name in crystals]
    ions = ions + sum(0.3 * np.array(c.ions) for c in made)
    left = parted(salts, 298.15, jnp.asarray(ions))
    assert bool(left.found)
    formed = {c.name for c, n in zip(salts.crystals, left.crystals, strict=True) if n > 1e-9}
    assert formed == set(crystals)
    got = np.asarray(left.molalities) / 0.05551
    np.testing.assert_allclose(got[[0, 2]], [sodium, chloride], rtol=0.05)
    np.testing.assert_allclose(got[[1, 3]], [third, sulfate], atol=4.0)


def test_carnallite_between_potash_and_bischofite():
    """3.3 % KCl and 26.9 % MgCl2 beside sylvite, 35.6 % MgCl2 beside bischofite at 25 °C (D'Ans, 1933;
    recalled); boiling ends at the second.
    """
    names, found = of(POTASH, 298.15)
    assert names == [
        ("potassium chloride", "carnallite"),
        ("carnallite", "magnesium chloride hexahydrate"),
    ]
    np.testing.assert_allclose(found[0], (3.3, 26.9), atol=0.8)
    np.testing.assert_allclose(found[1], (0.1, 35.6), atol=0.4)
    end = invariant_point(298.15, "potassium chloride", "magnesium chloride")
    assert (end.crystal, end.crystal_next) == names[1]
    # 33 % relative humidity over bischofite (Greenspan, 1977; recalled), less beside another salt
    assert 0.29 < end.water_activity < 0.33


def test_salt_is_driven_out_by_magnesium_and_calcium():
    """0.3 % NaCl beside 35.6 % MgCl2 at 25 °C (point A of van 't Hoff's table: 2.5 Na2Cl2 and 103 MgCl2 in
    1000 mol of water, opened: 0.4 %), 0.3 % and less beside saturated CaCl2.
    """
    _names, found = of(pair_of("sodium chloride", "magnesium chloride"), 298.15)
    np.testing.assert_allclose(found[0], (0.4, 35.5), atol=0.5)
    _names, found = of(pair_of("sodium chloride", "calcium chloride"), 298.15)
    assert found[0][0] < 1.0


def test_lines_and_ties_of_a_double_salt():
    """Of fields along the side the lines run through, each solution saturated with its own crystal, none
    beyond another, without a jump at the borders.
    """
    line = isotherm(POTASH, 298.15)
    water = 1.0 - line.first - line.second
    masses = POTASH.molar_masses
    m = np.stack([line.first, line.second], axis=-1) / water[:, None] / masses
    ratios = np.asarray(jax.vmap(lambda x: POTASH.saturation(298.15, x))(m @ POTASH.ions_per_salt))
    assert np.max(ratios) < 1e-5
    own = np.take_along_axis(ratios, line.crystals[:, None], axis=1)
    assert np.max(np.abs(own)) < 1e-5
    assert len(line.corners) == 2
    drawn = gr.crystallization.two_salts_chart(
        [298.15], "potassium chloride", "magnesium chloride", 0.05, 0.2
    )
    assert drawn.data


def test_a_path_through_the_field_of_carnallite():
    path = crystallization_path(POTASH, 0.03, 0.20, 298.15, 298.15)
    water = 1.0 - path.first - path.second
    assert np.all(np.diff(water[: path.boiled + 1]) < 1e-9)
    assert 100 * path.second[path.boiled] == pytest.approx(35.9, abs=0.5)


def test_fields_of_the_square():
    """In Jänecke's square of 25 °C glaserite parts the sulfates, and four solutions hold three crystals."""
    salts = four_of("sodium chloride", "potassium sulfate")
    found = diagram(salts, 298.15, 21)
    there = {salts.crystals[k].name for k in np.unique(found.crystal)}
    assert {"glaserite", "potassium chloride", "sodium chloride", "potassium sulfate"} <= there
    assert len(found.invariant) == 4
    assert np.all(np.isfinite(found.water))


LIQUIDS = ["sodium chloride", "potassium sulfate", "potassium chloride", "sodium sulfate"]
SOLIDS = [
    "sodium chloride",
    "potassium sulfate",
    "potassium chloride",
    "sodium sulfate decahydrate",
    "sodium sulfate anhydrous",
]
MIXTURES = {
    "glaserite": mixture_of(["water", *LIQUIDS], [*SOLIDS, "glaserite"], ["water"], EDGES),
    "carnallite": mixture_of(
        ["water", "potassium chloride", "magnesium chloride"],
        ["potassium chloride", "magnesium chloride hexahydrate", "carnallite"],
        ["water"],
        EDGES,
    ),
}


@pytest.mark.parametrize(("double", "cold", "most"), [("glaserite", 276.0, 0.35), ("carnallite", 278.0, 0.6)])
def test_a_hundred_settings_close(double, cold, most):
    """Mass of each component, energy, nothing above saturation, whatever is fed, double salt too."""
    mixture, rng = MIXTURES[double], np.random.default_rng(11)
    count = len(mixture.liquids) - 1
    found = brine([s.name for s in mixture.liquids[1:]])
    solids = jnp.zeros((len(mixture.solids), 6))

    @jax.jit
    def made_of(T, liquid, crystals, given):
        feed = empty(mixture, given).replace(liquid=liquid, solid=solids.at[-1, 3].set(crystals))
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

    formed = 0
    for _try in range(100):
        x = rng.random(count + 3)
        liquid = jnp.append(jnp.ones(1), most * jnp.asarray(x[:count]) ** 2)
        T = cold + 60.0 * x[-1]
        mass, energy, over, left, solid = made_of(T, liquid, 0.1 * x[-2], 285.0 + 60.0 * x[-3])
        assert np.max(np.abs(mass)) < 1e-12
        assert abs(float(energy)) < 1e-4
        assert np.min(left) > -1e-12
        assert np.min(solid) >= 0.0
        assert float(over) < 1e-6
        formed += float(solid[-1]) > 0.0
    assert formed > 10


def test_what_would_crystallize_too_is_told():
    """A mixture without the double salt keeps it dissolved, and says so; with it, it crystallizes."""
    without = mixture_of(["water", *LIQUIDS], SOLIDS, ["water"], EDGES)
    for mixture, told in ((without, True), (MIXTURES["glaserite"], False)):
        feed = empty(mixture, 330.0).replace(liquid=jnp.array([1.0, 0.1, 0.2, 0.0, 0.2]))
        made = TwoSaltCrystallizer(313.15, 5.0).operate(feed=feed)
        words = " ".join(row["message"] for row in describe(made.records))
        assert ("double salt" in words) is told
        assert (float(made.figures.crystal_flow_double) > 0.1) is not told
    # of a mixture with one crystal the second salt is the other one
    one = mixture_of(["water", *LIQUIDS[:1], LIQUIDS[2]], ["potassium chloride"], ["water"], EDGES)
    made = TwoSaltCrystallizer(293.15, 5.0).operate(
        feed=empty(one, 330.0).replace(liquid=jnp.array([1.0, 0.1, 0.4]))
    )
    assert float(made.figures.crystal_flow_first) > 0.0 == float(made.figures.crystal_flow_second)
    with pytest.raises(InputError, match="double salt"):
        mixture_of(["water", "potassium chloride"], ["carnallite"], ["water"], EDGES)


def test_saturation_of_a_brine():
    """At its solubility a salt alone is saturated, and a double salt in its own field alone."""
    found = brine_saturation(298.15, 0.359, 0.0, 0.0, "sodium chloride", "potassium sulfate")
    assert found.crystal == "sodium chloride"
    assert found.saturation_ratio == pytest.approx(1.0, abs=0.005)
    found = brine_saturation(298.15, 0.1, 0.12, 0.0, "sodium sulfate", "potassium sulfate")
    assert found.crystal == found.crystal_double == "glaserite"
    assert (
        brine_saturation(298.15, 0.1, 0.1, 0.0, "sodium chloride", "potassium chloride").crystal_double == ""
    )
