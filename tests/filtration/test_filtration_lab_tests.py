"""The other lab tests: printed compressibility, exact recovery, intervals and messages."""

from __future__ import annotations

import io

import numpy as np
import pytest
from tests.sharing.places import EXAMPLES

from granum.core.errors import InputError
from granum.filtration.formulas import constant_rate as cr
from granum.filtration.formulas.deliquoring import saturation_after_deliquoring
from granum.filtration.formulas.washing import wash_effluent_concentration
from granum.filtration.lab_tests.cake_tests import CompressionCell, DeliquoringCurve, WashingCurve
from granum.filtration.lab_tests.compressibility import Compressibility
from granum.filtration.lab_tests.rate_tests import ConstantRateTest, VariablePressureTest
from granum.filtration.lab_tests.slurry import PumpCurve, SlurryJar
from granum.filtration.lab_tests.stepped import SteppedPressureTest

FOLDER = EXAMPLES / "leaf-filter"
FOOT_PER_POUND = 0.3048 / 0.45359237


def test_mccabe_example_29_1():
    test = Compressibility.read(
        FOLDER / "pressures_mccabe.csv",
        area="440 cm2",
        dynamic_viscosity=8.937e-4,
        dry_cake_per_filtrate="23.5 g/L",
        reference_pressure=47.880259,
    )
    found = test.fit()
    # printed: exponent 0.26; α = 2.90e10 Δp^0.26 ft/lb with Δp in lbf/ft2; medium resistances 1.98 to 3.26
    # e10 1/ft
    assert found["compressibility"].value == pytest.approx(0.26, abs=0.01)
    assert found["cake_resistance_reference"].value / FOOT_PER_POUND == pytest.approx(2.90e10, rel=0.08)
    at_drum = (
        found["cake_resistance_reference"].value * 1414 ** found["compressibility"].value / FOOT_PER_POUND
    )
    assert at_drum == pytest.approx(1.91e11, rel=0.03)
    printed = np.array([1.98, 2.05, 2.78, 2.84, 3.26])
    media = [found[f"medium_resistance_{i}"].value * 0.3048 / 1e10 for i in range(1, 6)]
    np.testing.assert_allclose(media, printed, rtol=0.06)
    # printed resistances, 1e11 ft/lb, one test at a time
    _edge, _band, _law, points = test.chart().data
    pressures, cakes = 1e5 * np.asarray(points.x), np.asarray(points.y)
    np.testing.assert_allclose(cakes / FOOT_PER_POUND / 1e11, [1.66, 2.23, 2.43, 2.64, 2.80], rtol=0.01)
    alone = Compressibility(pressure_drop=pressures, cake_resistance=cakes).fit()
    low, high = alone["compressibility"].interval_95
    assert low < 0.26 < high


def test_compressibility_recovers_power_threshold_and_packing():
    p = np.geomspace(2e4, 1e6, 8)
    found = Compressibility(
        pressure_drop=p, cake_resistance=3e10 * (p / 1e5) ** 0.45, void_fraction=1 - 0.4 * (p / 1e5) ** 0.06
    ).fit()
    expected = {
        "cake_resistance_reference": 3e10,
        "compressibility": 0.45,
        "void_fraction_reference": 0.6,
        "compaction_exponent": 0.06,
    }
    assert found.values == pytest.approx(expected, rel=1e-6)
    assert found["cake_resistance_unit_pressure"].value == pytest.approx(3e10 * 1e5**-0.45, rel=1e-6)
    kinked = Compressibility(
        pressure_drop=p, cake_resistance=3e10 * np.maximum(p / 7e4, 1) ** 0.5, with_threshold="yes"
    ).fit()
    assert kinked.values == pytest.approx(
        {"cake_resistance_reference": 3e10, "compressibility": 0.5, "threshold_pressure": 7e4}, rel=1e-5
    )
    steep = Compressibility(pressure_drop=p, cake_resistance=3e10 * (p / 1e5) ** 1.2).fit()
    assert "unusual value" in [f["flag"] for f in steep.flags]
    x, y = found.ellipse("compressibility", "cake_resistance_reference")
    assert np.ptp(x) >= 0
    assert y.shape == (100,)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("pressure_drop [bar],time [s]\n1,2\n1,3\n2,3\n", "column 'cake_resistance', or"),
        ("pressure_drop [bar],cake_resistance [m/kg]\n1,2e10\n1,3e10\n1,3e10\n", "different pressures"),
        ("pressure_drop [bar],time [s],filtrate_volume [L]\n1,2,1\n1,3,2\n2,3,1\n", "also need 'area'"),
    ],
)
def test_compressibility_messages(text, words):
    with pytest.raises(InputError, match=words):
        Compressibility.read(io.StringIO(text)).fit()


CAKE = {"area": 0.2, "dynamic_viscosity": 1.1e-3, "dry_cake_per_filtrate": 40.0}


def test_constant_rate_rigid_and_compressible():
    t = np.linspace(30, 600, 12)
    case = {**CAKE, "filtrate_flow": 2e-5}
    dp = np.asarray(cr.pressure_drop_constant_rate(t, cake_resistance=4e11, medium_resistance=3e11, **case))
    rigid = ConstantRateTest(time=t, pressure_drop=dp, **case).fit()
    assert rigid.values == pytest.approx({"cake_resistance": 4e11, "medium_resistance": 3e11}, rel=1e-8)
    soft = cr.pressure_drop_constant_rate_compressible(
        t,
        cake_resistance_reference=6e11,
        compressibility=0.5,
        medium_resistance=3e11,
        reference_pressure=1e5,
        **case,
    )
    bent = ConstantRateTest(time=t, pressure_drop=np.asarray(soft), **case)
    assert "bent line" in [f["flag"] for f in bent.fit().flags]
    found = ConstantRateTest(time=t, pressure_drop=np.asarray(soft), compressible=True, **case).fit()
    assert found.values == pytest.approx(
        {"cake_resistance_reference": 6e11, "compressibility": 0.5, "medium_resistance": 3e11}, rel=1e-5
    )


def test_changing_pressure_by_its_exact_integral():
    # pressure p0 + s t: impulse p0 t + s t²/2 = η/A (α W V²/2A + R V), solved for V; trapezoids are exact on
    # a ramp
    p0, s, alpha, R = 2e4, 150.0, 3e10, 5e10
    t = np.linspace(20, 900, 25)
    impulse, A, eta, W = (
        p0 * t + s * t**2 / 2,
        CAKE["area"],
        CAKE["dynamic_viscosity"],
        CAKE["dry_cake_per_filtrate"],
    )
    q, b = eta * alpha * W / (2 * A**2), eta * R / A
    V = (-b + np.sqrt(b**2 + 4 * q * impulse)) / (2 * q)
    start = np.concatenate([[0.0], t])  # with the reading at zero the first trapezoid is exact too
    test = VariablePressureTest(
        time=start, filtrate_volume=np.concatenate([[0.0], V]), pressure_drop=p0 + s * start, **CAKE
    )
    found = test.fit()
    assert found.values == pytest.approx({"cake_resistance": alpha, "medium_resistance": R}, rel=1e-8)


def test_each_column_of_a_compression_cell_has_its_own_scatter():
    """With void fractions that are nearly exact the characteristic pressure is known, and the rest is a
    straight line through the logarithms of the resistances: the slope's standard error by hand.
    """
    p = np.geomspace(1e3, 1e6, 12)
    load, noise = np.log1p(p / 1e4), np.random.default_rng(3).normal(size=12)
    solid = 0.2 * np.exp(0.1 * load + 2e-4 * np.random.default_rng(4).normal(size=12))
    alpha = 1e11 * np.exp(0.4 * load + 0.05 * noise)
    found = CompressionCell(p, alpha, 1.0 - solid).fit()
    line = np.polynomial.Polynomial.fit(load, np.log(alpha), 1).convert()
    rest = np.log(alpha) - line(load)
    error = np.sqrt(rest @ rest / 10.0 / np.sum((load - load.mean()) ** 2))
    assert found["compressibility"].standard_error == pytest.approx(error, rel=0.1)
    assert found["compaction_exponent"].standard_error < 0.05 * error


def test_compression_cell_washing_and_deliquoring():
    p = np.geomspace(2e3, 8e5, 12)
    cell = CompressionCell(
        solids_pressure=p,
        cake_resistance=1e10 * (1 + p / 1.5e4) ** 0.6,
        void_fraction=1 - 0.3 * (1 + p / 1.5e4) ** 0.09,
    )
    expected = {
        "cake_resistance_unloaded": 1e10,
        "compressibility": 0.6,
        "void_fraction_unloaded": 0.7,
        "compaction_exponent": 0.09,
        "characteristic_pressure": 1.5e4,
    }
    assert cell.fit().values == pytest.approx(expected, rel=1e-5)
    assert cell.chart().data
    w = np.linspace(0.1, 3, 15)
    rng = np.random.default_rng(1)
    phi = np.clip(np.asarray(wash_effluent_concentration(w, 12.0)) + 0.005 * rng.standard_normal(15), 0, 1)
    low, high = (
        WashingCurve(wash_ratio=w, wash_effluent_concentration=phi).fit()["dispersion_number"].interval_95
    )
    assert low < 12 < high
    t = np.geomspace(5, 900, 14)
    case = {"pressure_drop": 6e4, "dynamic_viscosity": 1e-3, "void_fraction": 0.42, "cake_thickness": 0.015}
    S = np.asarray(
        saturation_after_deliquoring(t, cake_permeability=3e-13, irreducible_saturation=0.18, **case)
    )
    found = DeliquoringCurve(time=t, cake_saturation=S, **case).fit()
    assert found.values == pytest.approx(
        {"cake_permeability": 3e-13, "irreducible_saturation": 0.18}, rel=1e-3
    )


def stepped(noise=0.0, late=0.0):
    """Readings every 2 cm of filtrate depth at 0.5, 1, 2 and 4 bar: t from the closed form within each
    step.
    """
    A, eta, W, a0, n, R = (
        CAKE["area"],
        CAKE["dynamic_viscosity"],
        CAKE["dry_cake_per_filtrate"],
        4e10,
        0.45,
        6e10,
    )
    V, p, t = [0.0], [5e4], [0.0]
    for dp in (5e4, 1e5, 2e5, 4e5):
        if len(V) > 1:
            V, p, t = [*V, V[-1]], [*p, dp], [*t, t[-1]]
        for _i in range(8):
            v0, v1 = V[-1], V[-1] + 0.02 * A
            cake = a0 * (dp / 1e5) ** n * W / (2 * A**2) * (v1**2 - v0**2)
            V, p, t = [*V, v1], [*p, dp], [*t, t[-1] + eta / dp * (cake + R * (v1 - v0) / A)]
    # the two readings at a step are one reading of the clock
    clock, place = np.unique(t, return_inverse=True)
    clock = clock * (1.0 + noise * np.random.default_rng(1).normal(size=len(clock))) + late * (clock > 0)
    t = clock[place]
    return {"time": t, "filtrate_volume": np.array(V), "pressure_drop": np.array(p), **CAKE}


def test_stepped_pressure_tells_compressibility():
    exact = SteppedPressureTest(**stepped()).fit()
    assert exact.values == pytest.approx(
        {"cake_resistance_reference": 4e10, "compressibility": 0.45, "medium_resistance": 6e10}, rel=1e-7
    )
    late = SteppedPressureTest(**stepped(late=40.0)).fit()  # the clock started before the valve opened
    assert [f["flag"] for f in late.flags] == ["points excluded"]
    assert late.values == pytest.approx(exact.values, rel=1e-6)
    found = SteppedPressureTest(**stepped(noise=2e-4)).fit()
    for name, true in exact.values.items():
        low, high = found[name].interval_95
        assert low - 0.5 * (high - low) < true < high + 0.5 * (high - low), name
    flat = stepped()
    with pytest.raises(InputError, match="hardly changes"):
        SteppedPressureTest(**flat | {"pressure_drop": np.full(len(flat["time"]), 1e5)}).fit()


def test_constant_rate_leaves_out_a_bad_start():
    t = np.linspace(30, 600, 15)
    case = {**CAKE, "filtrate_flow": 2e-5}
    dp = np.array(cr.pressure_drop_constant_rate(t, cake_resistance=4e11, medium_resistance=3e11, **case))
    dp[:2] *= (0.4, 0.7)  # the pump was still filling the vessel
    found = ConstantRateTest(time=t, pressure_drop=dp, **case).fit()
    assert found.values == pytest.approx({"cake_resistance": 4e11, "medium_resistance": 3e11}, rel=1e-8)
    assert found.flags[0]["flag"] == "points excluded"


def test_jars_and_pump():
    # the notes' slurry: 15 g/kg, ε = 0.38, ρ_l = 1020, ρ_s = 2630: m = 1 + ε ρ_l/((1-ε) ρ_s) = 1.2377, W =
    # 15.59 kg/m³
    slurry = np.array([1.0, 2.0, 3.0, 5.0])
    dry = 0.015 * slurry * (1 + np.array([1, -1, 1, -1]) * 2e-3)
    volume = dry / 2630 / 0.62
    jar = SlurryJar(slurry, dry + 0.38 * volume * 1020, dry, volume, liquid_density=1020.0)
    found = jar.fit()
    low, high = found["solids_mass_fraction"].interval_95
    assert low < 0.015 < high
    assert found["void_fraction"].value == pytest.approx(0.38, rel=1e-9)
    m = 1 + 0.38 * 1020 / (0.62 * 2630)
    assert found["wet_to_dry_mass_ratio"].value == pytest.approx(m, rel=1e-9)
    assert found["dry_cake_per_filtrate"].value == pytest.approx(1020 * 0.015 / (1 - m * 0.015), rel=3e-3)
    assert not found.flags
    drained = SlurryJar(slurry, dry + 0.5 * 0.38 * volume * 1020, dry, volume, liquid_density=1020.0).fit()
    assert [f["flag"] for f in drained.flags] == ["saturation"]
    q = np.linspace(0, 8e-3, 9)
    pump = PumpCurve(q, 4e5 * (1 - (q / 1e-2) ** 2) + 200.0 * np.cos(np.arange(9.0))).fit()
    for name, true in (("pressure_shutoff", 4e5), ("volume_flow_largest", 1e-2)):
        low, high = pump[name].interval_95
        assert low < true < high
        assert high - low < 0.01 * true
    with pytest.raises(InputError, match="does not fall"):
        PumpCurve(q, 1e5 + 1e7 * q).fit()
