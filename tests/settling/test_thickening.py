"""Thickener areas, solids flux and state point: textbook examples and closed forms."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.special import lambertw

from granum.settling import flux
from granum.settling.formulas import sludge_index, thickening
from granum.settling.velocities import (
    Cole,
    HinderedParticles,
    MeasuredSettling,
    RichardsonZakiConcentration,
    Takacs,
    Vesilind,
)

SLUDGE = Vesilind(5 / 3600, 0.5)


def test_coulson_richardson_problem_5_1():
    # 1.33 kg/s of solids, 5 kg water/kg to 1.5; the smooth curve through the five tests peaks at 23 450 s/m:
    # 31.2 m².
    area = thickening.thickener_area_liquid_ratio(
        1.33, [5, 4.2, 3.7, 3.1, 2.5], [2e-4, 1.2e-4, 9.4e-5, 7e-5, 5e-5], 1.5, 1000
    )
    assert area == pytest.approx(31.2, rel=3e-3)


def test_interfaces_of_rhodes_exercise_3_1():
    # Rhodes, exercise 3.1: suspension of 0.2 over sediment of 0.5: clear interface falls at 0.39, sediment
    # rises at 0.26 mm/s.
    v = float(HinderedParticles(1.1e-3, 1200.0, reynolds=0.11)(0.2 * 1200.0))
    assert v * 1e3 == pytest.approx(0.39, abs=2e-3)
    assert thickening.shock_velocity_kynch(240.0, v, 600.0, 0.0) * 1e3 == pytest.approx(-0.26, abs=1e-3)
    assert thickening.shock_velocity_kynch(0.0, 0.0, 240.0, v) == pytest.approx(v)


def test_two_forms_of_coe_clevenger_agree():
    C = np.array([60.0, 120.0, 250.0])
    v = np.array([5e-4, 2e-4, 5e-5])
    rho_s, rho_l = 2600.0, 1000.0
    U = rho_l * (1 / C - 1 / rho_s)  # liquid per solid, by volumes
    by_concentration = thickening.thickener_area_coe_clevenger(3.0, C, v, 450.0)
    by_ratio = thickening.thickener_area_liquid_ratio(3.0, U, v, rho_l * (1 / 450.0 - 1 / rho_s), rho_l)
    assert by_concentration == pytest.approx(by_ratio, rel=1e-12)


@pytest.mark.parametrize(("k", "Cu"), [(0.5, 10.0), (0.4, 15.0), (0.8, 8.0)])
def test_yoshioka_tangent_of_vesilind_has_a_closed_form(k, Cu):
    # Tangent from (Cu, 0) to C v: C² k − C k Cu + Cu = 0 and G = v0 k C² e^(−kC), worked by hand.
    CL = 0.5 * Cu * (1 + np.sqrt(1 - 4 / (k * Cu)))
    limit = flux.limiting_flux_underflow(Cu, 1.2 / k, Vesilind(1e-3, k))
    assert limit.limiting_concentration == pytest.approx(CL, rel=1e-9)
    assert limit.limiting_flux == pytest.approx(1e-3 * k * CL**2 * np.exp(-k * CL), rel=1e-12)


def test_state_point_against_lambert_w():
    # Minimum of C v + q C: (1 − kC) v0 e^(−kC) = −q, so that kC = 1 − W₋₁(−e q / v0).
    q, k, v0 = 0.3 / 3600, 0.5, 5 / 3600
    C = (1 - lambertw(-np.e * q / v0, -1).real) / k
    limit = flux.limiting_flux_withdrawal(q, 2.5, 60.0, SLUDGE)
    assert limit.limiting_concentration == pytest.approx(C, rel=1e-9)
    assert limit.limiting_flux == pytest.approx(v0 * C * np.exp(-k * C) + q * C, rel=1e-12)


def test_state_point_balances_and_switches_at_the_limit():
    area, Qu = 1000.0, 300 / 3600
    for flow in (800 / 3600, 1600 / 3600):
        s = flux.state_point_clarifier(flow, 2.5, Qu, area, settling=SLUDGE)
        solids = Qu * s.underflow_concentration + (flow - Qu) * s.overflow_concentration
        assert solids == pytest.approx(flow * 2.5, rel=1e-12)
        assert (s.overflow_concentration > 0) == (s.loading_ratio > 1)
    # Too fast an overflow for feed-strength sludge overloads the unit through the feed layer itself.
    s = flux.state_point_clarifier(3.0, 2.5, 1.5, area, settling=SLUDGE)
    assert s.clarification_ratio > 1
    assert s.loading_ratio > 1
    assert s.limiting_concentration == pytest.approx(2.5)


def test_area_by_flux_is_the_greatest_coe_clevenger_area():
    C = np.linspace(2.5, 9.99, 4000)
    areas = 0.7 * np.asarray(thickening.unit_area_coe_clevenger(C, SLUDGE(C), 10.0))
    assert flux.thickener_area_flux(0.7, 2.5, 10.0, SLUDGE) == pytest.approx(areas.max(), rel=1e-6)


def test_takacs_of_the_benchmark_and_its_shape():
    # BSM1: 474 and 250 m/d, 0.576 and 2.86 m³/kg; at 3 kg/m³ 474 (e^−1.728 − e^−8.58) = 84.11 m/d.
    law = Takacs()
    assert float(law(3.0)) * 86400 == pytest.approx(84.11, abs=5e-3)
    assert float(law(0.0)) == 0.0
    assert float(np.max(np.asarray(law(np.linspace(0, 5, 500))))) <= 250 / 86400 * (1 + 1e-12)


def test_laws_fall_with_concentration_and_stay_positive():
    C = np.linspace(1.5, 60.0, 200)
    for law in (
        SLUDGE,
        Cole(2e-3, 1.8),
        RichardsonZakiConcentration(1e-3, 4.65, 80.0),
        HinderedParticles(1e-3, 80.0),
    ):
        v = np.asarray(law(C))
        assert np.all(np.diff(v) < 0), type(law).__name__
        assert np.all(v > 0), type(law).__name__


def test_sludge_indices():
    # 250 mL settled from a litre at 2.5 g/L: 100 mL/g (definition). Diluted by half, 200 mL at 4 g/L before
    # dilution: 100 mL/g.
    assert sludge_index.sludge_volume_index("250 mL", "1 L", "2500 mg/L") == pytest.approx(0.1)
    assert sludge_index.sludge_volume_index_diluted("200 mL", "1 L", "4 g/L", 0.5) == pytest.approx(0.1)
    poor, good = (sludge_index.vesilind_velocity_hartel_popel(x) for x in (0.25, 0.08))
    assert poor.vesilind_velocity < good.vesilind_velocity
    assert poor.vesilind_coefficient > good.vesilind_coefficient


def test_measured_velocities_keep_to_their_points_and_fall_beyond() -> None:
    """Points of a power law give it back between and beyond, in any order; thinner it stays."""
    law = MeasuredSettling([400.0, 100.0, 200.0], [1e-3 / 16, 1e-3, 1e-3 / 4])
    found = [float(law(c)) for c in (50.0, 100.0, 141.4213562, 200.0, 800.0)]
    assert found == pytest.approx([1e-3, 1e-3, 5e-4, 2.5e-4, 1e-3 / 64], rel=1e-6)
