"""Processes: the notes' mixing exercise, closure of mass and energy, combustion by hand, charts drawn."""

from __future__ import annotations

import numpy as np
import pytest

from granum.core.errors import InputError
from granum.humid_gas.charts import mollier_chart, psychrometric_chart
from granum.humid_gas.formulas import processes as p
from granum.humid_gas.formulas.properties import (
    enthalpy_linear,
    humidity_ratio_saturated,
    wet_bulb_temperature,
)
from granum.humid_gas.formulas.state import state
from granum.humid_gas.solvents import AirToluene, GasAndVapor, NitrogenEthanol
from granum.materials import gas_vapor

C = 273.15


def test_mixing_of_the_notes() -> None:
    mixed = p.mixing(1.5, 0.027, 100e3, 2.5, 0.04, 160e3)
    assert mixed.enthalpy == pytest.approx(137.5e3)
    assert mixed.humidity_ratio == pytest.approx(0.035, rel=0.005)
    assert mixed.temperature == pytest.approx(46.5 + C, abs=0.5)
    # cold and warm saturated air make fog
    one, two = (state(temperature=t + C, relative_humidity=1.0) for t in (0.0, 30.0))
    fog = p.mixing(1.0, one.humidity_ratio, one.enthalpy, 1.0, two.humidity_ratio, two.enthalpy)
    assert fog.condensate_ratio > 0
    assert fog.relative_humidity == pytest.approx(1.0)


def test_closure() -> None:
    cold = p.cooling(30 + C, 0.02, 10 + C, 2.0)
    assert cold.condensate_flow == pytest.approx(2.0 * (0.02 - cold.humidity_ratio))
    warm = state(temperature=30 + C, humidity_ratio=0.02)
    drained = cold.condensate_flow * 42.0e3  # water at 10 °C, steam tables
    assert 2.0 * (warm.enthalpy - cold.enthalpy) + cold.heat_duty == pytest.approx(drained, rel=2e-3)
    assert cold.humidity_ratio == pytest.approx(humidity_ratio_saturated(10 + C), rel=1e-9)
    # adiabatic drying follows a line of constant wet bulb; isenthalpic drying is the slope zero
    out = p.adiabatic_drying(80 + C, 0.01, 0.02)
    assert wet_bulb_temperature(out.temperature, 0.02) == pytest.approx(
        wet_bulb_temperature(80 + C, 0.01), rel=1e-9
    )
    assert p.real_drying(80 + C, 0.01, 0.02).enthalpy == pytest.approx(
        state(temperature=80 + C, humidity_ratio=0.01).enthalpy
    )
    loop = p.recirculation(0.01, 0.01, 0.8, 5.0)
    assert loop.dry_gas_flow_fresh * (loop.humidity_ratio_outlet - 0.01) == pytest.approx(5.0 * 0.01)


def test_combustion_of_methane() -> None:
    # adiabatic flame of methane with 3 times the air: 3·17.2 = 51.6 kg air, 2.25 kg water; (50 MJ +
    # sensible)/mean heat capacity by hand ≈ 860 °C
    gas = p.combustion_gas(0.7487, 0.2513, 50.0e6, 3.0, 25 + C, 0.0)
    assert gas.air_per_fuel == pytest.approx(51.7, rel=0.01)
    assert gas.humidity_ratio == pytest.approx(2.246 / (51.7 + 1 - 2.246), rel=0.01)
    assert 830 < gas.temperature - C < 900


def test_hand_form_of_the_notes() -> None:
    # D I.2.6: h = 1.01 θ + w (2494 + 1.92 θ)
    assert enthalpy_linear(56.5 + C, 0.04, 1010.0, 1920.0, 2494e3) == pytest.approx(
        1e3 * (1.01 * 56.5 + 0.04 * (2494 + 1.92 * 56.5))
    )


def test_solvents_have_two_wet_temperatures() -> None:
    for pair in (NitrogenEthanol(), AirToluene()):
        gas = state(temperature=60 + C, relative_humidity=0.02, pair=pair)
        assert gas.adiabatic_saturation_temperature + 1.0 < gas.wet_bulb_temperature < 60 + C
        y = gas.vapor_mole_fraction
        # psychrometric balance by hand with constant capacities
        assert gas.dew_point_temperature < gas.adiabatic_saturation_temperature
        assert 0 < y < 1
    # ethanol boils at 78.3 °C: its saturated gas is nearly pure vapor just below
    assert (
        state(temperature=78.2 + C, relative_humidity=1.0, pair=NitrogenEthanol()).vapor_mole_fraction > 0.98
    )
    water = state(temperature=60 + C, relative_humidity=0.1, pair=GasAndVapor(gas="dry air", vapor="water"))
    assert water.adiabatic_saturation_temperature == pytest.approx(
        state(temperature=60 + C, relative_humidity=0.1).adiabatic_saturation_temperature, abs=0.05
    )


def test_charts() -> None:
    path = {"temperature": [293.15, 333.15, 308.15], "humidity_ratio": [0.008, 0.008, 0.018]}
    for chart in (psychrometric_chart, mollier_chart):
        drawing = chart(**path)
        saturation = next(t for t in drawing.data if t.name == "saturation")
        assert len(saturation.x) > 50
        assert any(t.type == "table" for t in drawing.data)
        hover = next(t for t in drawing.data if t.customdata is not None)
        assert np.isfinite(np.asarray(hover.customdata)).all()
        # every state lies inside the window
        marks = next(t for t in drawing.data if t.mode == "markers+text")
        for values, axis in ((marks.x, drawing.layout.xaxis), (marks.y, drawing.layout.yaxis)):
            assert axis.range[0] < min(values)
            assert max(values) < axis.range[1]
    with pytest.raises(InputError):
        psychrometric_chart(temperature=[300.0], humidity_ratio=[0.01, 0.02])


def test_lewis_factors_rest_on_diffusivities_and_psychrometers() -> None:
    # measured in air, m² Pa/s (Welty, Wicks and Wilson, in Benitez, table A.1); Fuller's estimate is good for
    # 5 to 10 %
    measured = {
        "toluene": (298, 0.855),
        "ethanol": (298, 1.337),
        "methanol": (298, 1.641),
        "benzene": (298, 0.974),
        "ethyl acetate": (273, 0.718),
        "water": (298, 2.634),
    }
    for vapor, (T, product) in measured.items():
        assert float(gas_vapor(vapor, "dry air").diffusivity(T, 1e5)) * 1e5 == pytest.approx(
            product, rel=0.08
        ), vapor
    # ratio of the coefficients over the heat capacity of the gas: toluene in air 1223 Sc^0.567 J/(kg K) with
    # Sc 2.0 (Treybal, illustration
    # 7.10), 1.73 (Benitez, 8.6); water in air 0.95 kJ/(kg K) (Treybal, 7.9)
    assert AirToluene().lewis_factor() == pytest.approx(1223 * 2.0**0.567 / 1005, rel=0.03)
    assert AirToluene().lewis_factor() == pytest.approx(1.73, rel=0.03)
    assert GasAndVapor(gas="dry air", vapor="water").lewis_factor() == pytest.approx(0.95 / 1.005, rel=0.05)
