"""Drying times, diffusion, heat transfer and the lab tests against closed forms and printed numbers."""

from __future__ import annotations

import numpy as np
import pytest

from granum.core.errors import ApplicabilityError, InputError
from granum.drying.formulas import atomizers, diffusion, heat, times
from granum.drying.formulas.characteristic import HyperbolicCurve, PowerCurve
from granum.drying.lab_tests.curve import DryingCurve
from granum.drying.lab_tests.isotherm import IsothermTest
from granum.drying.lab_tests.ranking import residual_runs
from granum.drying.lab_tests.thin_layer import ThinLayerTest


def test_times_of_both_periods() -> None:
    # Geankoplis example 9.7 type with the notes' formula and the area put back: 1 h of constant rate, then a
    # straight line
    whole = times.drying_time(10.0, 2.0, 1e-3, 1.0, 0.1, 0.4, 0.05)
    assert whole.drying_time_constant_rate == pytest.approx(10 / (2 * 1e-3) * 0.6)
    assert whole.drying_time_falling_rate == pytest.approx(10 / (2 * 1e-3) * 0.35 * np.log(0.35 / 0.05))
    # either period may be absent
    assert times.drying_time(10.0, 2.0, 1e-3, 1.0, 0.5, 0.4, 0.05).drying_time_falling_rate == 0.0
    short = times.drying_time(10.0, 2.0, 1e-3, 0.3, 0.1, 0.4, 0.05)
    assert short.drying_time == pytest.approx(
        times.drying_time_falling_rate(10.0, 2.0, 1e-3, 0.3, 0.1, 0.4, 0.05)
    )
    # Geankoplis 9.7: falling-rate part 4.39 h from 0.195; a start of 0.38, above the critical moisture, adds
    # nothing to it
    for start in (0.195, 0.38):
        falling = times.drying_time_falling_rate(
            "399 kg", "18.58 m2", "1.51 kg/(m2 hour)", start, 0.04, 0.195
        )
        assert falling / 3600 == pytest.approx(4.39, abs=0.005)
    with pytest.raises(ApplicabilityError, match="without end"):  # equilibrium is never reached
        times.drying_time(10.0, 2.0, 1e-3, 1.0, 0.05, 0.4, 0.05)
    # a solid that would end wetter than it starts is told, not dried in a negative time; an end above the
    # critical moisture has no falling rate
    for wetter in (
        times.drying_time_constant_rate,
        times.drying_time_falling_rate,
        times.drying_time_characteristic,
    ):
        with pytest.raises(ApplicabilityError, match="wetter"):
            wetter(
                10.0, 2.0, 1e-3, 0.3, 25.0, *((0.4,) if wetter is not times.drying_time_constant_rate else ())
            )
    assert times.drying_time_falling_rate(10.0, 2.0, 1e-3, 1.0, 0.5, 0.4) == 0.0


def test_characteristic_curves() -> None:
    args = (10.0, 2.0, 1e-3, 1.0, 0.1, 0.4, 0.05)
    assert times.drying_time_characteristic(*args) == pytest.approx(
        times.drying_time(*args).drying_time, rel=1e-12
    )
    assert times.drying_time_characteristic(*args, HyperbolicCurve(1.0)) == pytest.approx(
        times.drying_time(*args).drying_time, rel=1e-12
    )
    phi = 0.05 / 0.35
    square = 10 / (2 * 1e-3) * (0.6 + 0.35 * (1 / phi - 1))  # ∫dΦ/Φ²
    assert times.drying_time_characteristic(*args, PowerCurve(2.0)) == pytest.approx(square, rel=1e-10)
    k = 3.5
    hyperbola = 10 / (2 * 1e-3) * (0.6 + 0.35 * (-np.log(phi) / k + (k - 1) / k * (1 - phi)))
    assert times.drying_time_characteristic(*args, HyperbolicCurve(k)) == pytest.approx(hyperbola, rel=1e-10)


def test_rea_vanishes_at_equilibrium() -> None:
    # with ΔE = −R T ln φ the surface is in equilibrium with the gas it dries in
    E = times.evaporation_activation_energy(0.05, 0.05, 350.0, 0.2, rea_factor=1.0)
    assert times.drying_flux_rea(0.02, 0.25, 0.2 * 0.25, 350.0, E) == pytest.approx(0.0, abs=1e-9)


def test_master_curve_of_skim_milk() -> None:
    # Chew et al. (Dairy Science & Technology 93, 2013), 30 % of solids, X − X_b below 1.362, as an open
    # program quotes table 2: another fit of
    # other droplets of the same milk; the defaults are those of 20 % of solids
    excess = np.linspace(0.0, 1.36, 18)
    chew = 1.0 - 1.305 * excess + 0.7097 * excess**2 - 0.1721 * excess**3 + 0.0151 * excess**4
    whole = times.evaporation_activation_energy(0.0, 0.0, 350.0, 0.2, rea_factor=1.0)
    ours = np.asarray(times.evaporation_activation_energy(excess, 0.0, 350.0, 0.2)) / whole
    np.testing.assert_allclose(ours, chew, atol=0.05)
    np.testing.assert_allclose(ours[excess > 0.9], chew[excess > 0.9], atol=0.005)


def test_diffusion_against_direct_sums() -> None:
    from scipy.special import jn_zeros

    n, roots = np.arange(1, 20001), jn_zeros(0, 500)
    for fo in (0.001, 0.02, 0.049, 0.051, 0.2, 1.0):
        odd = (2 * n - 1) * np.pi
        plate = np.sum(8 / odd**2 * np.exp(-(odd**2) * fo / 4))
        sphere = np.sum(6 / (np.pi * n) ** 2 * np.exp(-((np.pi * n) ** 2) * fo))
        cylinder = np.sum(4 / roots**2 * np.exp(-(roots**2) * fo))
        assert float(diffusion.plate(fo)) == pytest.approx(float(plate), rel=2e-7)
        assert float(diffusion.sphere(fo)) == pytest.approx(float(sphere), rel=2e-6)
        assert float(diffusion.cylinder(fo)) == pytest.approx(
            float(cylinder), rel=2e-4 if fo < 0.002 else 2e-6
        )
    assert diffusion.moisture_ratio_plate(0.0, 1e-3, 1e-10) == 1.0


def test_heat_transfer_numbers() -> None:
    # Geankoplis ex. 9.6-3: air at 65.6 °C and 6.1 m/s, G = 22 770 kg/(m² h): h = 62.45 W/(m² K); T_w =
    # 28.9 °C, λ = 2433 kJ/kg
    h = heat.heat_transfer_coefficient_parallel(22770 / 3600)
    assert h == pytest.approx(62.45, rel=1e-3)
    rate = times.drying_rate_constant(h, 65.6 + 273.15, 28.9 + 273.15, 2433e3)
    assert rate * 3600 == pytest.approx(3.39, rel=2e-3)  # printed kg/(m² h)
    # depth of microwaves from the plane wave exp(−i k x), k = (2 π f/c) √(ε' − i ε''), whose power falls with
    # 2 Im k; power with the
    # constant of Komarov, Wang and Tang: 5.563e-11 f E² ε''
    for real, loss in ((78.0, 10.0), (4.0, 0.05), (30.0, 60.0)):
        k = 2 * np.pi * 2.45e9 / 299792458.0 * np.sqrt(real - 1j * loss)
        assert heat.penetration_depth(2.45e9, real, loss) == pytest.approx(-0.5 / k.imag, rel=1e-9)
        assert heat.dielectric_power_density(2.45e9, loss, 2e4) == pytest.approx(
            5.563e-11 * 2.45e9 * 4e8 * loss, rel=2e-4
        )
    # D II.5 with the misprint put right, and its limit of a small body in a large enclosure
    small = heat.heat_duty_radiation(900.0, 300.0, 1.0, 1e9, 0.8, 0.3)
    assert small == pytest.approx(0.8 * 5.670374419e-8 * (900.0**4 - 300.0**4), rel=1e-6)


def _truth(t: np.ndarray) -> np.ndarray:
    Xc, Xe, k, X0 = 0.35, 0.05, 2e-4, 1.0
    tc = (X0 - Xc) / k
    return np.where(t < tc, X0 - k * t, Xe + (Xc - Xe) * np.exp(-k * np.maximum(t - tc, 0) / (Xc - Xe)))


def test_drying_curve_recovers_its_periods() -> None:
    rng = np.random.default_rng(7)
    t = np.sort(np.append(rng.uniform(0, 9000, 79), 0.0))
    X = _truth(t) + rng.normal(0, 0.005, 80)
    found = DryingCurve(time=t, mass=0.5 * (1 + X), dry_solid_mass=0.5, area=0.1).fit()
    for name, true in (
        ("critical_moisture", 0.35),
        ("rate_per_dry_mass", 2e-4),
        ("initial_moisture", 1.0),
        ("equilibrium_moisture", 0.05),
    ):
        low, high = found[name].interval_95
        assert low <= true <= high
        assert high - low < 0.2 * true + 0.02
    assert found["drying_rate_constant"].value == pytest.approx(2e-4 * 0.5 / 0.1, rel=0.03)
    rates = DryingCurve(time=t, moisture_dry_basis=X).rate_curve()
    middle = (t > 600) & (t < 2400)
    assert np.abs(rates.rate[middle] / 2e-4 - 1).mean() < 0.05


def test_drying_curve_without_one_period() -> None:
    t = np.linspace(0, 9000, 30)
    falling = 0.05 + 0.5 * np.exp(-t / 3000)
    found = DryingCurve(time=t, moisture_dry_basis=falling + 0.001 * np.sin(37 * t)).fit()
    assert any(f["flag"] == "no constant-rate period" for f in found.flags)
    constant = DryingCurve(
        time=t, moisture_dry_basis=1.0 - 1e-4 * t + 0.001 * np.sin(37 * t), equilibrium_moisture=0.0
    ).fit()
    assert constant["rate_per_dry_mass"].value == pytest.approx(1e-4, rel=0.01)
    assert any(f["flag"] == "no falling-rate period" for f in constant.flags)
    with pytest.raises(InputError):
        DryingCurve(time=t, mass=falling).fit()
    with pytest.raises(InputError):
        DryingCurve(time=t[::-1].copy(), moisture_dry_basis=falling).fit()


@pytest.mark.long
def test_thin_layer_ranking_knows_equal_curves() -> None:
    # Page's constants of the survey's apple slices at 50 °C: k = 9.46e-4 min⁻ⁿ, n = 1.328
    t = np.linspace(0, 300, 25) * 60
    rng = np.random.default_rng(3)
    MR = np.clip(np.exp(-9.46e-4 * (t / 60) ** 1.328) + rng.normal(0, 0.003, t.size), 0, None)
    ranked, _failed = ThinLayerTest(time=t, moisture_ratio=MR).ranking()
    fits = {r.name: r.fit for r in ranked}
    for name in ("page", "page_modified", "weibull"):
        assert fits[name]["time_exponent"].value == pytest.approx(1.328, rel=0.02)
    page = ThinLayerTest(time=t, moisture_ratio=MR, model="page").fit()
    assert page.values == fits["page"].values
    assert page["rate_constant"].value == pytest.approx(9.46e-4 / 60**1.328, rel=0.15)
    assert ranked[0].name in ("page", "page_modified", "weibull")
    same = {r.name: r.same_curve_as for r in ranked}
    family = {"page", "page_modified", "weibull"}
    assert sum(same[n] is None for n in family) == 1
    assert {same[n] for n in family if same[n]} <= family
    assert sum(r.weight for r in ranked) == pytest.approx(1.0)


def test_isotherm_test_recovers_gab() -> None:
    from granum.drying.isotherms.adsorption import Gab

    a = np.array([0.11, 0.22, 0.33, 0.43, 0.53, 0.65, 0.75, 0.84, 0.93])
    rng = np.random.default_rng(2)
    X = np.asarray(Gab(0.07, 12.0, 0.85).moisture(a, 298.15)) * (1 + rng.normal(0, 0.01, a.size))
    test = IsothermTest(water_activity=a, moisture_dry_basis=X)
    found = test.fit()
    assert found.flags[-1]["name"] == "gab"
    for name, true in (("monolayer_moisture", 0.07), ("multilayer_constant", 0.85)):
        low, high = found[name].interval_95
        assert low <= true <= high
    assert float(test.law("gab")(0.5)) == pytest.approx(float(Gab(0.07, 12.0, 0.85)(0.5)), rel=0.02)


def test_residual_runs() -> None:
    assert residual_runs(np.array([1.0, 1, 1, 1, 1, -1, -1, -1, -1, -1])) < 0.01
    assert residual_runs(np.array([1.0, -1, 1, -1, 1, -1, 1, -1])) > 0.9


def test_foodstuff_of_geankoplis() -> None:
    # problem 9.7-2: printed answers R_c = 0.996 kg/(m² h), free critical moisture 0.12
    t = np.array([0, 0.4, 0.8, 1.4, 2.2, 3.0, 4.2, 5.0, 7.0, 9.0, 12.0]) * 3600
    mass = np.array([4.944, 4.885, 4.808, 4.699, 4.554, 4.404, 4.241, 4.150, 4.019, 3.978, 3.955])
    found = DryingCurve(
        time=t,
        mass=mass,
        dry_solid_mass=3.765,
        area=0.186,
        equilibrium_moisture=0.190 / 3.765,
        warm_up_time=0.4 * 3600,
    ).fit()
    assert 3600 * found["drying_rate_constant"].value == pytest.approx(0.996, rel=0.03)
    assert found["critical_moisture"].value - 0.190 / 3.765 == pytest.approx(0.12, abs=0.02)


def test_impinging_jets_of_an_array_lie_near_those_of_a_single_nozzle() -> None:
    # Martin 1977, single round nozzle: D/r (1 − 1.1 D/r)/(1 + 0.1 (H/D − 6) D/r) · 2 Re^½ (1 +
    # 0.005 Re^0.55)^½, with D/r = 2 √f
    for Re, f, H in ((1e4, 0.02, 6.0), (5e4, 0.01, 4.0), (2e4, 0.03, 2.0)):
        d = 2.0 * f**0.5
        single = (
            d
            * (1 - 1.1 * d)
            / (1 + 0.1 * (H - 6) * d)
            * 2
            * Re**0.5
            * (1 + 0.005 * Re**0.55) ** 0.5
            * 0.7**0.42
        )
        assert heat.nusselt_number_impinging(Re, 0.7, f, H) == pytest.approx(single, rel=0.3)
    # by hand, textbook form: G = 2 √f (1 − 2.2 √f)/(…), F = 0.5 Re^⅔
    assert heat.nusselt_number_impinging(1e4, 0.7, 0.02, 6.0) == pytest.approx(
        0.896 * 0.1948 * 0.5 * 464.2 * 0.861, rel=2e-3
    )


def test_quantities_that_have_units_take_them() -> None:
    # d² law by hand: 1000·2.4e6·1e-8/(8·0.026·60); the film of a Treybal tray; 0.556e-10 f ε'' E² of Metaxas
    # and Meredith
    drop = atomizers.drying_time_droplet(
        "100 um", "60 kelvin", thermal_conductivity="0.026 W/(m*K)", heat_of_vaporization="2400 kJ/kg"
    )
    assert drop == pytest.approx(1.923, rel=1e-3)
    film = times.heat_flux_combined(
        30.0, "65 degC", "39 degC", "39 degC", conduction_coefficient="14.5 W/(m^2*K)"
    )
    assert film == pytest.approx(44.5 * 26)
    assert heat.dielectric_power_density("2.45 GHz", 1.0, "1 kV/cm") == pytest.approx(
        0.556e-10 * 2.45e9 * 1e10, rel=1e-3
    )
