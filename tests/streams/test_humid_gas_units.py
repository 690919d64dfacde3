"""Humid gas in a line against the course notes, steam tables and the psychrometric formulas, which share no
enthalpy polynomial with streams.
"""

from __future__ import annotations

import jax
import jax.numpy as jnp
import numpy as np
import pytest
from tests.sharing.places import EXAMPLES
from tests.sharing.streams import air

from granum.cases.reading import read
from granum.core.errors import ApplicabilityError
from granum.humid_gas.formulas import processes
from granum.humid_gas.formulas.state import state
from granum.streams.audit import closure
from granum.streams.equipment.humid_gas import (
    AdiabaticHumidifier,
    CondenserCooler,
    DehumidifyingCoil,
    HumidMixer,
)
from granum.streams.from_materials import mixture_of
from granum.streams.stream import Stream, empty

C = 273.15
MIXTURE = mixture_of(["water"], ["calcite"], ["dry air", "water"], [1e-6, 1e-3])


def water(T: float, flow: float) -> Stream:
    return empty(MIXTURE, T).replace(liquid=jnp.array([flow]))


def closes(inlets: list[Stream], outlets: list[Stream], duty: float = 0.0) -> None:
    found = closure(inlets, outlets, duty)
    assert float(found.mass) < 1e-12
    assert float(found.energy) < 1e-12


def test_mixing_of_the_course_notes() -> None:
    # D I.3.2: 1.5 kg at 100 kJ/kg, w 0.027 with 2.5 kg at 160 kJ/kg, w 0.04 give 137.5 kJ/kg and 0.035; the
    # notes read 46.5 °C
    first, second = (
        float(state(enthalpy=h, humidity_ratio=w).temperature) for h, w in ((100e3, 0.027), (160e3, 0.04))
    )
    inlets = {"first": air(MIXTURE, 1.5, 0.027, first), "second": air(MIXTURE, 2.5, 0.04, second)}
    out = HumidMixer()(**inlets)
    figures = HumidMixer().operate(**inlets).figures
    assert float(figures.humidity_ratio) == pytest.approx(0.035, rel=5e-3)
    assert float(figures.temperature) == pytest.approx(46.5 + C, abs=0.6)
    assert float(
        state(temperature=figures.temperature, humidity_ratio=figures.humidity_ratio).enthalpy
    ) == pytest.approx(137.5e3, rel=2e-3)
    closes(list(inlets.values()), [out.product])


def test_fog_and_injected_steam() -> None:
    inlets = {"warm": air(MIXTURE, 1.0, 0.03, 35 + C), "cold": air(MIXTURE, 1.0, 0.001, -10 + C)}
    fog = HumidMixer()(**inlets)
    figures = HumidMixer().operate(**inlets).figures
    assert float(figures.relative_humidity) == pytest.approx(1.0)
    assert float(figures.condensate_flow) > 0.003
    closes(list(inlets.values()), [fog.product])
    steam = empty(MIXTURE, 100 + C).replace(gas=jnp.array([0.0, 0.005]))
    gas = air(MIXTURE, 1.0, 0.005, 25 + C)
    out = HumidMixer()(gas=gas, steam=steam)
    expected = processes.injection(25 + C, 0.005, 0.005, 2675.6e3)  # saturated steam at 100 °C, steam tables
    assert float(out.product.temperature) == pytest.approx(expected.temperature, abs=0.1)
    # a spray that the gas cannot take up leaves with it, at the adiabatic saturation temperature
    wet_bulb = float(state(temperature=60 + C, humidity_ratio=0.01).wet_bulb_temperature)
    spray = HumidMixer()(gas=air(MIXTURE, 1.0, 0.01, 60 + C), spray=water(wet_bulb, 0.1))
    assert float(spray.product.temperature) == pytest.approx(wet_bulb, abs=0.05)


def test_cooler_and_coil_against_the_psychrometric_formulas() -> None:
    gas = air(MIXTURE, 2.0, 0.02, 30 + C)
    out = CondenserCooler(10 + C)(gas)
    expected = processes.cooling(30 + C, 0.02, 10 + C, 2.0)
    figures = CondenserCooler(10 + C).operate(gas=gas).figures
    # ASHRAE table, saturated at 10 °C
    assert float(figures.humidity_ratio) == pytest.approx(0.00766, rel=5e-3)
    assert float(out.heat_duty) == pytest.approx(expected.heat_duty, rel=1e-3)
    assert float(figures.condensate_flow) == pytest.approx(expected.condensate_flow, rel=1e-3)
    closes([gas], [out.product, out.condensate], float(out.heat_duty))
    dry = CondenserCooler(50 + C)(gas)  # above the dew point nothing condenses
    assert float(dry.condensate.mass_flow) == 0.0
    # by hand: 2 (1.006 + 0.02 · 1.86) 20 = 41.7 kW
    assert float(dry.heat_duty) == pytest.approx(41.7e3, rel=5e-3)
    gas = air(MIXTURE, 1.0, 0.016, 30 + C)
    coil = DehumidifyingCoil(8 + C, 0.1)
    out = coil(gas)
    expected = processes.dehumidifying(30 + C, 0.016, 8 + C, 0.1)
    assert float(out.product.temperature) == pytest.approx(expected.temperature, abs=0.02)
    assert float(coil.operate(gas=gas).figures.humidity_ratio) == pytest.approx(
        expected.humidity_ratio, rel=1e-3
    )
    closes([gas], [out.product, out.condensate], float(out.heat_duty))
    assert not CondenserCooler(-5 + C).operate(gas=gas).checks[0].ok


def test_humidifier_follows_the_wet_bulb_line() -> None:
    hot = air(MIXTURE, 1.0, 0.01, 80 + C)
    wet_bulb = float(state(temperature=80 + C, humidity_ratio=0.01).wet_bulb_temperature)
    inlets = {"gas": hot, "water": water(wet_bulb, 0.05)}
    full = AdiabaticHumidifier(1.0)(**inlets)
    assert float(full.product.temperature) == pytest.approx(wet_bulb, abs=0.05)
    closes([hot, inlets["water"]], list(full))
    part = AdiabaticHumidifier(0.6)(**inlets)
    rise = [float(u.product.gas[1] - hot.gas[1]) for u in (part, full)]
    assert rise[0] / rise[1] == pytest.approx(0.6, rel=1e-9)
    assert float(part.product.temperature) == pytest.approx(80 + C + 0.6 * (wet_bulb - 80 - C), abs=0.6)
    thirsty = AdiabaticHumidifier(1.0)(gas=hot, water=water(wet_bulb, 0.004))
    assert float(thirsty.drain.liquid_flow) == pytest.approx(0.0, abs=1e-15)
    assert not AdiabaticHumidifier(1.0).operate(gas=hot, water=water(wet_bulb, 0.004)).checks[0].ok
    foggy = AdiabaticHumidifier(1.0)(gas=air(MIXTURE, 1.0, 0.02, 20 + C), water=water(20 + C, 0.01))
    assert float(foggy.drain.liquid_flow) == pytest.approx(0.01)


def test_gradients_are_finite_and_the_mixture_is_checked() -> None:
    def outlet(T: float) -> jax.Array:
        return DehumidifyingCoil(T, 0.1)(air(MIXTURE, 1.0, 0.016, 30 + C)).product.temperature

    slope, h = jax.grad(outlet)(8 + C), 1e-3
    assert float(slope) == pytest.approx(float(outlet(8 + C + h) - outlet(8 + C - h)) / (2 * h), rel=1e-5)
    nothing = CondenserCooler(10 + C)(empty(MIXTURE, 300.0))
    assert np.isfinite(float(nothing.heat_duty))
    with pytest.raises(ApplicabilityError, match="first liquid among the gases"):
        CondenserCooler(10 + C)(empty(mixture_of(["water"], ["calcite"], [], [1e-6, 1e-3]), 300.0))


def test_solvent_in_nitrogen_condenses() -> None:
    mixture = mixture_of(["ethanol"], ["calcite"], ["nitrogen", "ethanol"], [1e-6, 1e-3])
    gas = empty(mixture, 50 + C).replace(gas=jnp.array([1.0, 0.3]))
    out = CondenserCooler(0 + C)(gas)
    # vapor pressure of ethanol at 0 °C: 1.59 kPa (handbooks), so w = 46.07/28.01 · 1.59/(101.3 − 1.59)
    assert float(out.product.gas[1]) == pytest.approx(46.07 / 28.01 * 1.59 / 99.7, rel=0.03)
    closes([gas], [out.product, out.condensate], float(out.heat_duty))


def test_the_example_line() -> None:
    run = read(EXAMPLES / "humid-air" / "line.toml").solve()
    assert run.audit["mass_closure"] < 1e-9
    # ASHRAE table, saturated at 8 °C: 6.68 g/kg; a tenth of the mixed 27.2 g/kg passes the coil
    assert float(run.figure("heater.humidity_ratio")) == pytest.approx(
        0.9 * 6.68e-3 + 0.1 * 27.2e-3, rel=0.01
    )
