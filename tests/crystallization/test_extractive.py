"""The extractive crystallizer: balances by hand, the vessel with one solute, what it refuses."""

from __future__ import annotations

from math import log

import jax.numpy as jnp
import numpy as np
import pytest

import granum as gr
from granum.core.errors import CaseError, GranumError
from granum.core.packing import as_arrays
from granum.crystallization.equipment.antisolvent import AntisolventCrystallizer
from granum.crystallization.equipment.extractive import ExtractiveCrystallizer
from granum.crystallization.formulas.growth import PowerLawGrowth
from granum.crystallization.formulas.nucleation import PowerLawNucleation
from granum.crystallization.formulas.solubility_laws import AntisolventSolubility, PolynomialSolubility
from granum.streams.from_materials import mixture_of
from granum.streams.stream import Stream, empty

UNIT = "crystallization.extractive_crystallizer"
NAMES = ["water", "sodium chloride", "ethanol", "adipic acid"]
SOLUTES = mixture_of(NAMES, ["sodium chloride", "adipic acid"], [], np.geomspace(5e-6, 4e-3, 41))
FAST = PowerLawGrowth(2e-3, 1.0), PowerLawNucleation(1e10, 1.5)


def between(solvent: float, added: float) -> AntisolventSolubility:
    """The log-linear law between two solubilities."""
    return AntisolventSolubility(PolynomialSolubility([solvent]), log(solvent / added))


def fed(*liquid: float) -> Stream:
    return empty(SOLUTES, 298.15).replace(liquid=jnp.array(liquid))


def vessel(cls=ExtractiveCrystallizer, **more):
    laws = {"other_solubility": between(0.2, 1.0)} if cls is ExtractiveCrystallizer else {}
    return cls(298.15, 40.0, between(0.4, 0.01), *FAST, second_solvent="ethanol", **laws | more)


def operated(unit, feed, added):
    made = unit.operate(feed=feed, antisolvent=added)
    return made.outlets.product, as_arrays(made.figures)


@pytest.mark.parametrize(("other", "left"), [(0.3, 0.0), (1.2, 1.2 - 2.0 * (0.2 * 1.0) ** 0.5)])
def test_balances_by_hand(other: float, left: float) -> None:
    """A kilogram of water and one of added liquid hold 2·√(0.4·0.01) = 0.1265 kg of the wanted solute and
    2·√(0.2·1.0) = 0.894 kg of the other.
    """
    product, found = operated(vessel(), fed(1.0, 0.5, 0.0, other), fed(0.0, 0.0, 1.0, 0.0))
    crystals = np.asarray(product.solid_by_species)
    assert crystals[0] == pytest.approx(0.5 - 2.0 * (0.4 * 0.01) ** 0.5, rel=2e-3)
    assert crystals[1] == pytest.approx(left, abs=1e-12)
    assert float(found.purity) == pytest.approx(crystals[0] / crystals.sum())
    assert float(found.saturation_other) == pytest.approx(other / (2.0 * (0.2 * 1.0) ** 0.5))
    dissolved = np.asarray(product.liquid)
    np.testing.assert_allclose(dissolved[[1, 3]] + crystals, [0.5, other], rtol=1e-12)


def test_without_the_other_solute_it_is_the_plain_vessel() -> None:
    feed, added = fed(1.0, 0.5, 0.0, 0.0), fed(0.1, 0.0, 0.9, 0.0)
    product, found = operated(vessel(), feed, added)
    same, plain = operated(vessel(AntisolventCrystallizer, solid="sodium chloride"), feed, added)
    np.testing.assert_allclose(product.solid, same.solid, rtol=1e-12)
    for name in plain._fields:
        assert float(getattr(found, name)) == pytest.approx(float(getattr(plain, name)), rel=1e-9)
    assert float(found.purity) == 1.0


def test_more_added_liquid_makes_purer_crystals() -> None:
    """From a point on, where the other solute dissolves better in it; its crystals in the feed dissolve."""
    shares = []
    for added in (0.3, 0.6, 1.2, 2.4):
        _product, found = operated(vessel(), fed(1.0, 0.5, 0.0, 0.6), fed(0.0, 0.0, added, 0.0))
        shares.append(float(found.purity))
    assert shares == sorted(shares)
    assert shares[-1] == 1.0 > shares[0]
    feed = fed(1.0, 0.5, 0.0, 0.0)
    feed = feed.replace(solid=feed.solid.at[1, 20].set(0.3))
    product, found = operated(vessel(), feed, fed(0.0, 0.0, 1.0, 0.0))
    assert float(product.solid_by_species[1]) == 0.0
    assert float(product.liquid[3]) == pytest.approx(0.3)
    assert float(found.purity) == 1.0


def test_what_it_refuses() -> None:
    feed, added = fed(1.0, 0.5, 0.0, 0.3), fed(0.0, 0.0, 1.0, 0.0)
    with pytest.raises(CaseError, match="does not depend on the added liquid"):
        operated(vessel(other_solubility=PolynomialSolubility([0.2])), feed, added)
    with pytest.raises(CaseError, match="cannot be the other solute"):
        operated(vessel(solid_solute_other="sodium chloride"), feed, added)
    law = {"law": "library_solubility", "solute": "sucrose"}
    other = {"law": "antisolvent_solubility", "pure_solubility": law, "antisolvent_power": -1.0}
    with pytest.raises(GranumError, match="sucrose"):
        gr.alone(UNIT, other_solubility=other).solve()


def test_random_settings_close() -> None:
    rng = np.random.default_rng(3)
    for _number in range(40):
        a, b = 10 ** rng.uniform(-3, 0, 2)
        unit = vessel(other_solubility=between(float(a), float(b)))
        feed = fed(1.0, rng.uniform(0.0, 0.6), rng.uniform(0.0, 0.2), rng.uniform(0.0, 0.5))
        added = fed(rng.uniform(0.0, 0.3), 0.0, rng.uniform(0.0, 3.0), rng.uniform(0.0, 0.05))
        product, found = operated(unit, feed, added)
        met, out = feed + added, np.asarray(product.liquid)
        out = out + np.array([0.0, product.solid_by_species[0], 0.0, product.solid_by_species[1]])
        np.testing.assert_allclose(out, met.liquid, rtol=1e-12, atol=1e-14)
        assert float(np.min(product.liquid)) >= 0.0
        assert 0.0 <= float(found.purity) <= 1.0
