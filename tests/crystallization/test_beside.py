"""A salt beside others in vessels with kinetics: its solubility, and what is told of the others."""

from __future__ import annotations

import jax
import jax.numpy as jnp
import numpy as np
import pytest

from granum.core.errors import ApplicabilityError, CaseError, InputError
from granum.core.notices import describe
from granum.crystallization.equipment.batch import BatchCrystallizer
from granum.crystallization.equipment.beside import Thinned, solubility_beside
from granum.crystallization.equipment.msmpr import Msmpr
from granum.crystallization.equipment.roles import roles
from granum.crystallization.formulas.growth import PowerLawGrowth
from granum.crystallization.formulas.nucleation import PowerLawNucleation
from granum.crystallization.formulas.programs import PowerCooling
from granum.crystallization.formulas.solubility_laws import LibrarySolubility, PolynomialSolubility
from granum.crystallization.vessels.common_ion import pair_of, parted, solubility_beside_salt
from granum.materials.brines import brine
from granum.streams.from_materials import mixture_of
from granum.streams.stream import empty

KCL, NACL = "potassium chloride", "sodium chloride"
LAWS = (PowerLawGrowth(1e-4, 1.3), PowerLawNucleation(2e8, 1.7))
EDGES = np.geomspace(1e-5, 4e-3, 21)
PAIR = brine((KCL, NACL))
SOLUBILITIES = jax.jit(jax.vmap(lambda T, m: PAIR.solubility(T, m * jnp.asarray(PAIR.ions_per_salt[1]), 0)))


def feed_of(crystal, liquids, masses, temperature):
    mixture = mixture_of(["water", *liquids], [crystal], ["water"], EDGES)
    return empty(mixture, temperature).replace(liquid=jnp.array([1.0, *masses]))


def told(unit, feed):
    made = unit.operate(feed=feed)
    return made, " ".join(row["message"] for row in describe(made.records))


def cooled(solute, temperature=298.15, **more):
    return Msmpr(temperature, 5.0, LibrarySolubility(solute), *LAWS, **more)


def test_potash_beside_salt_ends_at_the_tables_corners():
    """Beside so much NaCl as at the invariant points of Linke and Seidell (recalled) dissolves the KCl of
    these points: 11.1 % at 25 °C, 14.8 at 50, 21.8 at 100.
    """
    celsius = np.array([25.0, 50.0, 100.0])
    sodium, potassium = np.array([[20.4, 18.8, 16.8], [11.1, 14.8, 21.8]])
    water = 100.0 - sodium - potassium
    found = SOLUBILITIES(jnp.asarray(273.15 + celsius), jnp.asarray(sodium / water / 0.05844277))
    np.testing.assert_allclose(0.0745513 * found * water, potassium, atol=0.7)


def test_a_hundred_liquors():
    """Less dissolves the more of a common ion there is, none of it more than alone, and what is dissolved is
    saturated.
    """
    rng = np.random.default_rng(3)
    T, m = jnp.asarray(rng.uniform(275.0, 372.0, 100)), jnp.asarray(rng.uniform(0.0, 6.0, 100))
    found, more, alone = SOLUBILITIES(T, m), SOLUBILITIES(T, m + 0.1), SOLUBILITIES(T, 0.0 * m)
    np.testing.assert_allclose(alone, jax.jit(jax.vmap(PAIR.alone))(T)[:, 0], rtol=1e-9)
    assert bool(jnp.all((more < found) & (found <= alone * (1.0 + 1e-12))))
    table = jnp.asarray(PAIR.ions_per_salt)
    logs = jax.jit(jax.vmap(PAIR.saturation))(T, found[:, None] * table[0] + m[:, None] * table[1])
    np.testing.assert_allclose(logs[:, 0], 0.0, atol=1e-9)


def test_a_vessel_ends_near_the_equilibrium_of_both_salts():
    feed = feed_of(KCL, [KCL, NACL], [0.40, 0.20], 353.15)
    made, words = told(cooled(KCL), feed)
    pair = pair_of(KCL, NACL)
    ions = jnp.array([0.40, 0.20]) / pair.molar_masses @ jnp.asarray(pair.ions_per_salt)
    still = parted(pair, 298.15, ions).crystals * pair.molar_masses
    crystals = float(made.figures.crystal_flow)
    assert float(still[1]) == pytest.approx(0.0, abs=1e-9)
    assert crystals < float(still[0])
    assert crystals == pytest.approx(float(still[0]), rel=0.005)
    assert float(made.outlets.product.mass_flow / feed.mass_flow) == pytest.approx(1.0, abs=1e-12)
    assert "solubility" not in words
    alone = feed_of(KCL, [KCL], [0.40], 353.15)
    assert crystals > 2.0 * float(cooled(KCL).operate(feed=alone).figures.crystal_flow)


def test_the_other_salt_beyond_its_solubility_is_told():
    _made, words = told(cooled(KCL, 303.15, evaporation=0.2), feed_of(KCL, [KCL, NACL], [0.3, 0.3], 353.15))
    assert "sodium chloride: solubility" in words
    assert "two_salt_crystallizer" in words


def test_what_is_not_known_beside_is_told_and_a_law_of_ones_own_is_taken():
    feed = feed_of("potassium nitrate", ["potassium nitrate", "sucrose"], [0.6, 0.1], 333.15)
    _made, words = told(cooled("potassium nitrate"), feed)
    assert "left out of the solubility" in words
    own = PolynomialSolubility([0.1286, 5.88e-3, 1.721e-4])
    found = roles(feed.mixture, "", "")
    assert solubility_beside(own, feed.mixture, found, feed.liquid) is own


def test_a_batch_ends_with_the_solubility_beside_the_other_salt():
    feed = feed_of(KCL, [KCL, NACL], [0.40, 0.20], 353.15)
    batch = BatchCrystallizer(
        solubility=LibrarySolubility(KCL),
        growth=LAWS[0],
        nucleation=LAWS[1],
        duration=7200.0,
        temperature_program=PowerCooling(353.15, 298.15, 7200.0),
        seed_mass_per_solvent=0.01,
    )
    made = batch.operate(feed=feed)
    course = made.inside.course
    masses = PAIR.molar_masses
    still = float(SOLUBILITIES(jnp.asarray([298.15]), jnp.asarray([0.20 / masses[1]]))[0]) * masses[0]
    assert float(course.solubility_per_solvent[-1]) == pytest.approx(still, rel=1e-6)


@pytest.mark.long
def test_glaubers_salt_takes_the_water_of_the_brine():
    """The table over the free solvent is that of the brine itself, and the vessel's end is the brine's."""
    liquids = ["sodium sulfate", NACL]
    feed = feed_of("sodium sulfate decahydrate", liquids, [0.30, 0.10], 308.15)
    law, found = LibrarySolubility("sodium sulfate"), roles(feed.mixture, "", "")
    table = solubility_beside(law, feed.mixture, found, feed.liquid, 288.15)
    assert isinstance(table, Thinned)
    known = brine(tuple(liquids))
    wet = [c.name for c in known.crystals].index("sodium sulfate decahydrate")
    for solvent in (1.1, 0.8, 0.55):
        others = 0.10 / known.molar_masses[1] / solvent * jnp.asarray(known.ions_per_salt[1])
        exact = known.molar_masses[0] * known.solubility(288.15, others, wet)
        assert float(table(288.15, solvent)) == pytest.approx(float(exact), rel=2e-6)
    ions = jnp.array([0.30, 0.10]) / known.molar_masses @ jnp.asarray(known.ions_per_salt)
    still = known.equilibrium(288.15, 1.0, ions, [wet]).crystals[0] * 0.3221956
    made = cooled("sodium sulfate", 288.15).operate(feed=feed).figures
    assert float(made.crystal_flow) == pytest.approx(float(still), rel=0.002)


@pytest.mark.parametrize("liquids", [["acetone", "paracetamol", "water"], ["water", KCL, "sucrose"]])
def test_a_solubility_of_another_system_is_refused(liquids):
    mixture = mixture_of(liquids, [liquids[1]], [], EDGES)
    feed = empty(mixture, 298.15).replace(liquid=jnp.array([1.0, 0.1, 0.1]))
    with pytest.raises(CaseError, match="paracetamol in water, not of"):
        cooled("paracetamol").operate(feed=feed)


def test_a_hydrate_has_a_solubility_or_none_beside_much_salt():
    """Glauber's salt beside nearly saturated brine: at 5 °C Pitzer's product is met; at 30 °C the brine takes
    its water (it melts at 18 °C there: Linke and Seidell, recalled), and it dissolves in any liquor.
    """
    pair = brine(("sodium sulfate", "sodium chloride"))
    hydrate = next(k for k, c in enumerate(pair.crystals) if c.water)
    brines = jnp.linspace(0.0, 6.0, 25)[:, None] * pair.ions_per_salt[1]

    @jax.jit
    @jax.vmap
    def at(T, others):
        found = pair.solubility(T, others, hydrate)
        there = others + found * jnp.asarray(pair.crystals[hydrate].ions, dtype=float)
        return found, pair.saturation(T, there)[hydrate]

    for kelvin, met in ((278.15, True), (303.15, False)):
        T = jnp.asarray(kelvin)
        found, ratios = at(jnp.full(len(brines), kelvin), brines)
        if met:
            np.testing.assert_allclose(ratios, 0.0, atol=1e-9)
        else:
            assert float(found[-1]) > 2.0 * float(pair.alone(T)[0])
            assert float(ratios[0]) == pytest.approx(0.0, abs=1e-9)


def test_what_is_no_pair_or_no_solution_is_refused():
    with pytest.raises(InputError, match="are the same salt"):
        solubility_beside_salt("25 degC", 0.2, "NaCl", "sodium chloride")
    with pytest.raises(ApplicabilityError, match="sodium chloride alone 359"):
        solubility_beside_salt("25 degC", 5.0)
