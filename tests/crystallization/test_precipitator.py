"""Continuous precipitator: against the same balance solved by SciPy, printed heats, and its limits."""

from __future__ import annotations

import jax.numpy as jnp
import numpy as np
import pytest
from scipy.optimize import brentq
from tests.sharing.places import EXAMPLES

import granum as gr
from granum.core import registry
from granum.core.errors import ApplicabilityError, CaseError
from granum.crystallization.formulas.growth import PowerLawGrowth
from granum.crystallization.formulas.mixing_times import (
    induction_time_volume,
    mixing_time_engulfment,
    mixing_time_nienow,
)
from granum.materials import names, solute
from granum.materials.ions import ions_of
from granum.streams.from_materials import mixture_of
from granum.streams.stream import empty

UNIT = "crystallization.precipitator"
EDGES = np.geomspace(1e-7, 4e-4, 41)
KG, KN = 4e-14, 1e7
KINETICS = {
    "growth": {"law": "power_law_growth", "growth_coefficient": KG, "growth_order": 2},
    "nucleation": {
        "law": "secondary_nucleation",
        "nucleation_coefficient": KN,
        "nucleation_order": 1.8,
        "magma_order": 0,
    },
}


def mixture(*liquids, solid="barium sulfate"):
    return mixture_of(["water", *liquids], [solid], [], EDGES)


BARIUM = mixture("barium chloride", "sodium sulfate", "sodium chloride")


def flow(made, *liquid, temperature=298.15):
    return empty(made, temperature).replace(liquid=jnp.array(liquid))


def operated(barium=0.01, sulfate=0.01, *, made=BARIUM, temperature=298.15, **settings):
    unit = registry.find(UNIT)(
        **{"temperature": temperature, "volume": 1.0, "rotation_speed": 20.0, **KINETICS, **settings}
    )
    feeds = (flow(made, 1.0, barium, 0.0, 0.0), flow(made, 1.0, 0.0, sulfate, 0.0))
    return unit.operate(feed=feeds[0], reagent=feeds[1]), feeds


def davies(z, strength):
    root = np.sqrt(strength)
    return 10 ** (-0.509 * z**2 * (root / (1 + root) - 0.3 * strength))


def test_the_same_balance_solved_apart():
    """Crystals of 6 k ρ B G³ τ⁴ (Randolph and Larson) against what the ions leave; Davies with 0.509."""
    made, _feeds = operated(0.02, 0.012)
    M, masses = 0.23339, (0.20823, 0.14204, 0.05844)
    n = 0.02 / masses[0], 0.012 / masses[1]
    densities = BARIUM.densities("liquids", 298.15)
    rho = float(BARIUM.densities("solids", 298.15)[0])

    def state(left):
        """Of moles of sulfate that stay dissolved per second."""
        reacted = n[1] - left
        ions = (n[0] - reacted) / 2.0, left / 2.0
        strength = 0.5 * (4 * sum(ions) + (2 * n[0] + 2 * n[1]) / 2.0)
        S = davies(2, strength) * np.sqrt(ions[0] * ions[1] / 1.08e-10)
        liquid = np.array([2.0, (n[0] - reacted) * masses[0], left * masses[1], 2 * reacted * masses[2]])
        volume = float(np.sum(liquid / densities)) + reacted * M / rho
        over = max(S - 1.0, 0.0)
        G, B, tau = KG * over**2, KN * over**1.8, 1.0 / volume
        return 6 * rho * B * G**3 * tau**4 * volume - reacted * M, S

    left = brentq(lambda x: state(x)[0], 1e-7, n[1])
    assert float(made.figures.supersaturation_ratio) == pytest.approx(state(left)[1], rel=0.01)
    assert float(made.figures.crystal_flow) == pytest.approx((n[1] - left) * M, rel=2e-3)
    # all crystals of a mixed vessel: median size by mass 3.67 G τ
    assert float(made.figures.mass_median_size) == pytest.approx(
        3.672 * float(made.figures.growth_rate * made.figures.residence_time), rel=0.05
    )


def test_ions_charge_and_heat():
    """Every ion leaves as it came; 26.57 kJ/mol (WATEQ4F, 6.35 kcal) are given off at 25 °C."""
    made, feeds = operated()
    came, went = sum(np.asarray(f.components) for f in feeds), np.asarray(made.outlets.product.components)
    np.testing.assert_allclose(went, came, rtol=1e-12)
    moles = float(made.figures.crystal_flow) / 0.2333896
    assert float(made.outlets.heat_duty) == pytest.approx(-moles * 26568.0, rel=1e-3)


def test_masses_of_ions_are_those_of_the_salts():
    """Sums over ions against the molar masses printed for 36 salts."""
    known = [(s, ions) for name in names("solute") if (ions := ions_of((s := solute(name)).formula))]
    assert len(known) > 30
    for s, ions in known:
        assert ions.anhydrous_mass == pytest.approx(float(s.molar_mass), rel=1e-5), s.name


def test_yield_and_supersaturation_follow_the_feeds_and_the_volume():
    small, large = (operated(volume=v)[0].figures for v in (0.3, 5.0))
    assert small.supersaturation_ratio > large.supersaturation_ratio > 1.0
    assert small.yield_fraction < large.yield_fraction <= 1.0
    assert small.supersaturation_ratio < small.supersaturation_ratio_mixed
    warm = operated(temperature=333.15)[0].figures
    assert warm.supersaturation_ratio_mixed < small.supersaturation_ratio_mixed


@pytest.mark.parametrize(("barium", "sulfate"), [(0.0, 0.01), (0.01, 0.0), (0.0, 0.0), (1e-7, 1e-7)])
def test_nothing_precipitates_where_nothing_can(barium, sulfate):
    made, feeds = operated(barium, sulfate)
    assert float(made.figures.crystal_flow) == pytest.approx(0.0, abs=1e-15)
    np.testing.assert_allclose(
        np.asarray(made.outlets.product.liquid), np.asarray(feeds[0].liquid + feeds[1].liquid), atol=1e-15
    )


def test_other_salts():
    """Solids of a case, of ions of one charge and of two."""
    for liquids, solid in (
        (("silver nitrate", "sodium chloride", "sodium nitrate"), "silver chloride"),
        (("strontium nitrate", "sodium sulfate", "sodium nitrate"), "celestine"),
    ):
        own = [
            {
                "solid": {
                    solid: {
                        "formula": {"silver chloride": "AgCl", "celestine": "SrSO4"}[solid],
                        "molar_mass": 0.14332,
                        "density": {"value": 5560.0, "source": "haynes2014"},
                        "heat_capacity": {"value": 350.0, "source": "haynes2014"},
                    }
                }
            }
        ]
        made = mixture_of(["water", *liquids], [solid], [], EDGES, own=own)
        out, feeds = operated(made=made, growth=PowerLawGrowth(1e-9, 1.0))
        came = sum(np.asarray(f.components) for f in feeds)
        np.testing.assert_allclose(np.asarray(out.outlets.product.components), came, rtol=1e-12)
        assert out.figures.crystal_flow > 0.0


def test_slow_stirring_is_told():
    slow, quick = (
        next(c for c in operated(rotation_speed=speed)[0].checks if "mixing" in c.name)
        for speed in (0.5, 30.0)
    )
    assert quick.ok
    assert not slow.ok


def test_liquids_that_make_no_such_solid_are_refused():
    with pytest.raises(CaseError, match="three salts"):
        operated(made=mixture("barium chloride", "potassium sulfate", "sodium chloride"))


def test_times_of_mixing_and_of_the_first_crystals():
    """Twice the vessel of one power per mass takes 2^(2/3) as long; the volume of crystals as the integral of
    births.
    """
    assert mixing_time_nienow(2.0, 1.0, 1.0) / mixing_time_nienow(1.0, 0.5, 1.0) == pytest.approx(
        2 ** (2 / 3)
    )
    assert mixing_time_engulfment(1e-3, 1000.0, 4.0) == pytest.approx(
        0.5 * mixing_time_engulfment(1e-3, 1000.0, 1.0)
    )
    t = float(induction_time_volume(1e-4, 1e9, 2e-8, 0.5))
    births = np.linspace(0.0, t, 20001)
    assert np.trapezoid(0.5 * 1e9 * (2e-8 * (t - births)) ** 3, births) == pytest.approx(1e-4, rel=1e-4)
    with pytest.raises(ApplicabilityError, match="born"):
        induction_time_volume(1e-4, 0.0, 2e-8)


def test_the_example_closes_and_is_mixed_in_time():
    """40 kg/h of barium chloride give 44.8 kg/h of barium sulfate at most, 28 kg/h of sodium sulfate 46.0."""
    run = gr.read(EXAMPLES / "barium-sulfate" / "line.toml").solve()
    assert run.audit["mass_closure"] < 1e-12
    made = run.figure("precipitator.crystal_flow") * 3600
    assert 0.9 * 44.8 < made < 44.8
    assert all(check.ok for unit in run.units.values() for check in unit.checks)
