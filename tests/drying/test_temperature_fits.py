"""Isotherms at several temperatures with the isosteric heat, and diffusivity with its activation energy."""

from __future__ import annotations

import io

import numpy as np
import pytest

from granum.core.errors import InputError
from granum.drying.bodies import body_drying
from granum.drying.formulas.diffusion import (
    diffusivity_arrhenius,
    moisture_ratio_plate,
    moisture_ratio_sphere,
)
from granum.drying.gas_solid.kinetics import DiffusionKinetics
from granum.drying.isotherms import grains
from granum.drying.lab_tests.diffusivity import EffectiveDiffusivity
from granum.drying.lab_tests.isotherm_temperatures import MODELS, IsothermTemperatures

T = np.repeat([283.15, 298.15, 313.15, 328.15], 8)
AW = np.tile(np.linspace(0.15, 0.9, 8), 4)
CORN = grains.ChungPfost(312.30, 16.958, 30.205)  # ASAE D245, shelled corn
R, MW = 8.314462618, 0.018015268


def measured(noise: float) -> np.ndarray:
    return np.asarray(CORN.moisture(AW, T)) * (1.0 + noise * np.random.default_rng(1).normal(size=T.size))


def test_best_law_and_isosteric_heat_of_the_grain_standard() -> None:
    test = IsothermTemperatures(T, AW, measured(0.01), moisture_reference=0.15)
    fit = test.fit()
    assert fit.flags[-1]["name"] == "chung_pfost"
    for name, truth in (
        ("isotherm_coefficient", 312.30),
        ("isotherm_exponent", 16.958),
        ("isotherm_temperature_offset", 30.205),
    ):
        assert abs(fit[name].value - truth) < 3.0 * fit[name].standard_error
    # by hand: q = R T²/M_w · A/(t + C)² · exp(−B X) at X = 0.15 and the mean temperature
    mean = float(np.mean(T))
    heat = R / MW * mean**2 * 312.30 / (mean - 273.15 + 30.205) ** 2 * np.exp(-16.958 * 0.15)
    assert abs(fit["isosteric_heat_net"].value - heat) < 3.0 * fit["isosteric_heat_net"].standard_error
    assert fit["isosteric_heat_net"].value == pytest.approx(heat, rel=0.1)
    chosen = IsothermTemperatures(T, AW, measured(0.01), model="chung_pfost")
    # the standard's own value at 25 °C, 70 %
    assert float(chosen.law().moisture(0.7, 298.15)) == pytest.approx(0.163, rel=0.01)
    assert len(chosen.chart().data) == 8


def test_clausius_clapeyron_needs_no_law() -> None:
    moisture, heat = IsothermTemperatures(T, AW, measured(0.0)).clausius_clapeyron(5)
    # by hand: ln a = −A/(t + C) exp(−B X), whose straight line over 1/T has the slope −q M_w/R
    levels = np.unique(T)
    logs = -312.30 / (levels[:, None] - 273.15 + 30.205) * np.exp(-16.958 * moisture)
    np.testing.assert_allclose(heat, -R / MW * np.polyfit(1.0 / levels, logs, 1)[0], rtol=1e-6)
    assert np.all(np.diff(heat) < 0)


def test_every_law_gives_back_its_own_constants() -> None:
    laws = {
        "henderson_modified": grains.HendersonModified(8.6541e-5, 1.8634, 49.810),
        "halsey_modified": grains.HalseyModified(2.87, -0.0054, 1.38),
        "oswin_modified": grains.OswinModified(15.303, -0.10164, 3.0358),
        "gab": MODELS["gab"](0.06, 0.5, 0.85, 0.0, 8e3, -200.0),
    }
    for name, law in laws.items():
        X = np.asarray(law.moisture(AW, T))
        test = IsothermTemperatures(T, AW, X, model=name, moisture_reference=0.1)  # type: ignore[arg-type]
        found = test.fit()
        heat = float(law.net_isosteric_heat(0.1, float(np.mean(T))))
        assert found["isosteric_heat_net"].value == pytest.approx(heat, rel=1e-3, abs=50.0)
        np.testing.assert_allclose(
            np.asarray(test.law_of(MODELS[name], found.values).moisture(AW, T)), X, rtol=1e-5
        )


def test_isotherm_errors() -> None:
    with pytest.raises(InputError, match="at least two"):
        IsothermTemperatures(np.full(8, 298.15), AW[:8], measured(0.0)[:8]).fit()
    with pytest.raises(InputError, match="strictly between"):
        IsothermTemperatures(T, np.where(AW > 0.85, 1.0, AW), measured(0.0)).fit()


def test_diffusivity_and_activation_energy() -> None:
    time, temperature = np.tile(np.linspace(600.0, 12000.0, 10), 3), np.repeat([313.15, 333.15, 353.15], 10)
    true = 2e-10 * np.exp(-28e3 / R * (1.0 / temperature - 1.0 / 333.15))
    ratio = np.asarray(moisture_ratio_plate(time, 3e-3, true)) + 0.004 * np.random.default_rng(2).normal(
        size=30
    )
    test = EffectiveDiffusivity(time, np.clip(ratio, 0.0, 1.0), 3e-3, temperature)
    fit = test.fit()
    at = 2e-10 * np.exp(-28e3 / R * (1.0 / test.reference_temperature - 1.0 / 333.15))  # type: ignore[operator]
    assert abs(fit["diffusivity"].value - at) < 3.0 * fit["diffusivity"].standard_error
    assert (
        abs(fit["diffusion_activation_energy"].value - 28e3)
        < 3.0 * fit["diffusion_activation_energy"].standard_error
    )
    # the line of Arrhenius through the three temperatures meets 1/T = 0 at 2e-10 exp(28000 / (8.314463 ·
    # 333.15)) = 4.910e-6 m²/s
    factor = fit["diffusivity_preexponential"]
    assert abs(np.log(factor.value / 4.910e-6)) < 3.0 * factor.standard_error / factor.value
    again = diffusivity_arrhenius(
        test.reference_temperature, factor.value, fit["diffusion_activation_energy"].value
    )
    assert float(again) == pytest.approx(fit["diffusivity"].value, rel=1e-9)
    assert len(test.chart().data) == 6


def test_the_factor_of_arrhenius_is_not_a_diffusivity_at_some_temperature() -> None:
    """By hand: E/RT = 30000 / (8.314463 · 333.15) = 10.8305, e^-10.8305 = 1.9787e-5. The name that could be
    taken for either is gone.
    """
    found = diffusivity_arrhenius(
        temperature="60 degC",
        diffusivity_preexponential="1e-4 m^2/s",
        diffusion_activation_energy="30 kJ/mol",
    )
    assert float(found) == pytest.approx(1.9787e-9, rel=1e-4)
    told = r"diffusivity_reference.*Did you mean 'diffusivity_preexponential'"
    with pytest.raises(InputError, match=told):
        diffusivity_arrhenius.evaluate(
            temperature="60 degC", diffusivity_reference="1e-9 m^2/s", diffusion_activation_energy="30 kJ/mol"
        )
    with pytest.raises(InputError, match=told):
        body_drying(
            time=[0.0, 3600.0],
            half_thickness="5 mm",
            initial_moisture=4.0,
            temperature="60 degC",
            humidity_ratio=0.01,
            heat_transfer_coefficient=30.0,
            diffusivity_reference=5e-10,
        )
    with pytest.raises(InputError, match=told):
        DiffusionKinetics(diffusivity_reference=1e-9, radius=1e-3)  # type: ignore[call-arg]


def test_half_times_of_crank() -> None:
    # Crank: half dried at D t/(2L)² = 0.04919 in a plate; the series of a sphere gives D t/R² = 0.0305
    for body, length, time, ratio in (("plate", 2e-3, 1000.0, 0.04919 * 4), ("sphere", 2e-3, 1000.0, 0.0305)):
        scale = ratio * length**2 / time
        times = time * np.array([0.25, 0.5, 1.0, 2.0, 3.0])
        law = moisture_ratio_plate if body == "plate" else moisture_ratio_sphere
        values = np.asarray(law(times, length, scale))
        assert values[2] == pytest.approx(0.5, abs=2e-3)
        fit = EffectiveDiffusivity(times, values, length, body=body).fit()  # type: ignore[arg-type]
        assert fit["diffusivity"].value == pytest.approx(scale, rel=1e-6)
        assert "diffusion_activation_energy" not in fit.parameters
    with pytest.raises(InputError, match="diffusion"):
        EffectiveDiffusivity([1.0, 2.0, 3.0, 4.0], [1.0, 1.0, 1.0, 0.99], 1e-3).fit()


def test_read_from_a_file_with_units() -> None:
    file = io.StringIO(
        "temperature [degC],water_activity [percent],moisture_dry_basis [percent]\n"
        + "\n".join(
            f"{t - 273.15:.2f},{100 * a:.3f},{100 * x:.5f}"
            for t, a, x in zip(T, AW, measured(0.0), strict=True)
        )
    )
    fit = IsothermTemperatures.read(file, model="chung_pfost").fit()
    assert fit["isotherm_exponent"].value == pytest.approx(16.958, rel=1e-3)
