"""Antisolvent crystallizer: against measured solubilities, the vessel of one solvent and mass balances."""

from __future__ import annotations

import jax.numpy as jnp
import numpy as np
import pytest
from scipy.optimize import minimize_scalar
from tests.sharing.places import EXAMPLES

import granum as gr
from granum.cases.alone import alone
from granum.core.errors import CaseError
from granum.crystallization.equipment.antisolvent import AntisolventCrystallizer
from granum.crystallization.equipment.msmpr import Msmpr
from granum.crystallization.formulas.drowning_out import antisolvent_fraction_best, yield_fraction_antisolvent
from granum.crystallization.formulas.growth import PowerLawGrowth
from granum.crystallization.formulas.nucleation import PowerLawNucleation
from granum.crystallization.formulas.solubility_laws import AntisolventSolubility, PolynomialSolubility
from granum.crystallization.lab_tests.solubility import SolubilityAntisolvent
from granum.streams.from_materials import mixture_of
from granum.streams.stream import Stream, empty

UNIT = "crystallization.antisolvent_crystallizer"
SALT = mixture_of(
    ["water", "sodium chloride", "ethanol"], ["sodium chloride"], ["water"], np.geomspace(5e-6, 4e-3, 41)
)
NUCLEATION = PowerLawNucleation(1e8, 1.5)


def flow(water: float = 0.0, salt: float = 0.0, ethanol: float = 0.0) -> Stream:
    return empty(SALT, 298.15).replace(liquid=jnp.array([water, salt, ethanol]))


@pytest.mark.parametrize(("power", "curvature"), [(4.0, 0.0), (2.0, 1.6), (0.8, 5.0), (6.0, 2.0), (1.2, 0.1)])
def test_the_best_share_is_where_least_stays_dissolved(power, curvature):
    def dissolved(w):
        return np.exp(-w * (power + curvature * w)) / (1.0 - w)

    found = minimize_scalar(dissolved, bounds=(0.0, 0.999), method="bounded", options={"xatol": 1e-10})
    assert antisolvent_fraction_best(power, curvature) == pytest.approx(found.x, abs=1e-5)


@pytest.mark.parametrize(("power", "curvature"), [(0.5, 0.0), (1.0, 0.0), (0.2, 0.5)])
def test_a_weak_antisolvent_only_dilutes(power, curvature):
    assert antisolvent_fraction_best(power, curvature) == 0.0
    w = np.linspace(0.01, 0.95, 50)
    left = np.exp(-w * (power + curvature * w))
    assert (np.asarray(yield_fraction_antisolvent(1.0, left, w)) <= 1e-12).all()


def test_fast_kinetics_leave_what_heubel_and_vandorpe_measured():
    """Sodium formate at 288.2 K: 0.7271 kg/kg in water, 0.3569 in 35.55 % of ethanol (system 73_214 of the
    IUPAC–NIST database), so that 1 − 0.3569/(0.7271 · 0.6445) = 23.84 % crystallize; the law fitted to all
    the points misses this one by two percent.
    """
    test = SolubilityAntisolvent.read(EXAMPLES / "antisolvent" / "sodium_formate_heubel1962.csv")
    law = test.law()
    feed, spirit = flow(water=1.0, salt=0.7271), flow(ethanol=0.55159)
    unit = AntisolventCrystallizer(298.15, 3.0, law, PowerLawGrowth(1e-3, 1.0), NUCLEATION)
    made = unit.operate(feed=feed, antisolvent=spirit)
    assert made.figures.antisolvent_fraction == pytest.approx(0.3555, rel=1e-4)
    assert made.figures.yield_fraction == pytest.approx(0.2384, abs=0.016)
    left = made.outlets.product.liquid
    assert float(left[1] / (left[0] + left[2])) == pytest.approx(0.3569, rel=0.021)


def test_without_antisolvent_it_is_the_crystallizer_of_one_solvent():
    pure = PolynomialSolubility([0.2])
    vessel = 298.15, 3.0
    laws = {"growth": PowerLawGrowth(2e-6, 1.0), "nucleation": NUCLEATION}
    feed = flow(water=0.5, salt=0.17)
    drowned = AntisolventCrystallizer(*vessel, solubility=AntisolventSolubility(pure, 3.0), **laws)
    plain = Msmpr(*vessel, solubility=pure, **laws)
    one, other = drowned.operate(feed=feed, antisolvent=flow()), plain.operate(feed=feed)
    for name in (
        "crystal_flow",
        "relative_supersaturation",
        "residence_time",
        "nucleation_rate",
        "heat_duty",
    ):
        assert getattr(one.figures, name) == pytest.approx(float(getattr(other.figures, name)), rel=1e-9)
    np.testing.assert_allclose(one.outlets.product.solid, other.outlets.product.solid, rtol=1e-9)


def test_antisolvent_may_come_from_either_side():
    """What counts is the mixture: recycled spirit in the feed, water in the antisolvent."""
    law = AntisolventSolubility(PolynomialSolubility([0.36]), 2.0, 1.6)
    unit = AntisolventCrystallizer(298.15, 3.0, law, PowerLawGrowth(2e-6, 1.0), NUCLEATION)
    one = unit(flow(0.5, 0.17, 0.1), flow(0.1, 0.0, 0.2)).product
    other = unit(flow(0.6, 0.17, 0.0), flow(0.0, 0.0, 0.3)).product
    np.testing.assert_allclose(one.solid, other.solid, rtol=1e-9)


def test_more_antisolvent_gives_more_until_it_dilutes():
    law = AntisolventSolubility(PolynomialSolubility([0.36]), 2.0, 1.6)
    unit = AntisolventCrystallizer(298.15, 3.0, law, PowerLawGrowth(2e-5, 1.0), NUCLEATION)
    made = [
        float(unit(flow(0.5, 0.17), flow(ethanol=x)).product.solid_flow / 0.17) for x in (0.1, 0.4, 1.6, 12.0)
    ]
    assert made[0] < made[1] < made[2] > made[3] >= 0.0


def test_what_cannot_be_is_said():
    with pytest.raises(CaseError, match="second_solvent"):
        alone(UNIT, mixture={"liquids": ["water", "sodium chloride", "ethanol", "acetone"]}).solve()
    with pytest.raises(CaseError, match="solute or the solvent"):
        alone(UNIT, second_solvent="water").solve()
    law = PolynomialSolubility([0.3])
    unit = AntisolventCrystallizer(298.15, 3.0, law, PowerLawGrowth(2e-6, 1.0), NUCLEATION)
    with pytest.raises(CaseError, match="antisolvent_solubility"):
        unit(flow(0.5, 0.17), flow(ethanol=0.2))


def test_the_line_recovers_ethanol_from_nitrogen():
    """At −15 °C ethanol has 0.42 kPa (Antoine's constants of the NIST WebBook, 8.20417, 1642.89, 230.3 in
    mmHg and °C): 0.42/101.3 · 46.07/28.01 · 250 kg/h = 1.7 kg/h stay in the nitrogen.
    """
    run = gr.read(EXAMPLES / "drowning-out" / "line.toml").solve()
    assert max(run.audit["mass_closure"], run.audit["energy_closure"]) < 1e-9
    assert all(check.ok for unit in run.units.values() for check in unit.checks)
    salt = {n: float(s.liquid[2] + s.solid_flow) for n, s in run.streams.items()}
    assert salt["brine"] == pytest.approx(salt["salt"] + salt["mother_liquor"] + salt["washings"], rel=1e-9)
    pressure = 10 ** (8.20417 - 1642.89 / (230.3 - 15.0)) * 133.322
    lost = pressure / (101325.0 - pressure) * 46.07 / 28.014 * 250.0
    back = float(run.streams["condenser.condensate"].liquid[0]) * 3600.0
    dried = run.units["dryer"].values.evaporation_rate * 3600.0
    assert dried - back == pytest.approx(lost, rel=0.25)
