"""Dryers in a closed circuit: heat pump, superheated steam, recompression; staged heating as dryers in a row;
direct firing.
"""

from __future__ import annotations

import jax.numpy as jnp
import pytest
from tests.sharing.streams import wet

import granum as gr
from granum.core.errors import InputError
from granum.drying.equipment.burner import Burner
from granum.drying.equipment.closed import ClosedDryer, HeatPumpCircuit, SteamCircuit
from granum.drying.gas_solid.dryer import ready
from granum.streams.audit import closure
from granum.streams.from_materials import mixture_of
from granum.streams.stream import Stream, empty

MIXTURE = mixture_of(["water"], ["starch"], ["dry air", "water"], [1e-3, 1e-2])


@ready
def whole(dryer: ClosedDryer, feed: Stream):
    out = dryer(feed)
    closed = closure([feed], [out.product, out.vapor, out.condensate], out.heat_duty + out.shaft_power)
    made = dryer.operate(feed=feed)
    return closed, made.figures, made.checks


def checked(dryer: ClosedDryer, feed: Stream):
    """Figures and checks of a dryer whose balances close."""
    closed, figures, checks = whole(dryer, feed)
    assert float(closed.mass) < 1e-12
    assert float(closed.energy) < 1e-11
    return figures, {c.name: c.ok for c in checks}


def test_heat_pump_dryer_beside_coolprop() -> None:
    """The same circuit reckoned with CoolProp's humid air: a trace of solid, water that enters at the wet
    bulb, so that the dryer is isenthalpic.
    """
    coolprop = pytest.importorskip("CoolProp.CoolProp")
    P, T1, coil, bypass, phi = 101325.0, 323.15, 285.15, 0.1, 0.8

    def air(name: str, **given: float) -> float:
        ((a, x), (b, y)) = given.items()
        return coolprop.HAPropsSI(name, "P", P, a, x, b, y)

    cold = air("W", T=coil, R=1.0)

    def mismatch(T: float) -> float:
        w2 = air("W", T=T, R=phi)
        w1 = bypass * w2 + (1.0 - bypass) * cold
        water = coolprop.PropsSI("H", "T", 303.15, "P", P, "Water")
        return air("H", T=T1, W=w1) + (w2 - w1) * water - air("H", T=T, W=w2)

    from scipy.optimize import brentq

    T2 = brentq(mismatch, 295.0, 320.0)
    w2 = air("W", T=T2, R=phi)
    w1 = bypass * w2 + (1.0 - bypass) * cold
    condensate = coolprop.PropsSI("H", "T", coil, "P", P, "Water")
    taken = (1.0 - bypass) * (air("H", T=T2, W=w2) - air("H", T=coil, R=1.0)) - (w2 - w1) * condensate
    work = taken / (0.5 * 328.15 / (328.15 - 280.15) - 1.0)
    dryer = ClosedDryer(HeatPumpCircuit(phi, coil, bypass, 0.5, 5.0), T1, 0.0)
    figures, checks = checked(dryer, wet(MIXTURE, 1e-6, 1e6, 303.15))
    assert float(figures.temperature_outlet) == pytest.approx(T2, abs=0.1)
    assert float(figures.mass_flow_circulating) == pytest.approx(1.0 / (w2 - w1), rel=0.01)
    assert float(figures.shaft_power) == pytest.approx(work / (w2 - w1), rel=0.01)
    # kg/kWh, the usual range (Mujumdar 2014)
    assert 1.0 < float(figures.moisture_extraction_rate) * 3.6e6 < 4.0
    assert all(checks.values())


def test_superheated_steam_and_its_recompression() -> None:
    """Steam tables at 1 atm, 200 to 120 °C, water at 20 °C: (2716.5 − 84)/(2875.4 − 2716.5) = 16.57. With
    compression of steam from a feed at boiling heat the notes' table III.2 has 160 to 200 kJ/kg.
    """
    dryer = ClosedDryer(SteamCircuit(393.15), 473.15, 0.0)
    figures, checks = checked(dryer, wet(MIXTURE, 1e-6, 1e6, 293.15))
    assert float(figures.mass_flow_circulating) == pytest.approx(16.57, rel=0.01)
    assert all(checks.values())
    run = gr.read("examples/dryers/steam.toml").solve()
    assert run.audit["energy_closure"] < 1e-12
    assert 160e3 < run.figure("dryer.energy_per_water") < 200e3
    assert run.figure("dryer.heat_duty_heater") < 0.0  # more than the circuit needs
    assert all(c.ok for c in run.units["dryer"].checks)
    _figures, checks = checked(
        ClosedDryer(SteamCircuit("95 degC", "2 bar"), "150 degC", 0.05), wet(MIXTURE, 1.0, 2.0, 373.0)
    )
    # outlet below boiling, heat given off below the hot gas
    assert sorted(checks.values()) == [False, False, True]


def test_four_shelves_with_reheated_air() -> None:
    """Anantharaman and Begum, example 6.1, read from a chart: air leaves the shelves at 27, 34, 39 and 42 °C
    with 0.016, 0.023, 0.028 and 0.032; 515.6 kg of water an hour. The card gives the same without streams.
    """
    run = gr.read("examples/dryers/staged.toml").solve()
    assert run.audit["energy_closure"] < 1e-12
    names = ("first", "second", "third", "fourth")
    for name, celsius, humidity in zip(
        names, (27.0, 34.0, 39.0, 42.0), (0.016, 0.023, 0.028, 0.032), strict=True
    ):
        assert run.figure(f"{name}.temperature_outlet") - 273.15 == pytest.approx(celsius, abs=1.6)
        assert run.figure(f"{name}.humidity_ratio_outlet") == pytest.approx(humidity, abs=0.0014)
    assert 60.0 * float(run.streams["exhaust"].gas_volume_flow) == pytest.approx(300.0, rel=1e-3)
    water = 3600.0 * sum(run.figure(f"{name}.evaporation_rate") for name in names)
    assert water == pytest.approx(515.6, rel=0.01)
    card = gr.drying.staged_heating("25 degC", 0.005, "52 degC", "60 %", stage_count=4)
    assert run.figure("fourth.humidity_ratio_outlet") == pytest.approx(
        float(card.humidity_ratio_outlet), rel=0.03
    )


FIRED = mixture_of(["water"], ["starch"], ["dry air", "water", "methane", "propane"], [1e-3, 1e-2])


def test_burner_beside_the_real_flue_gas() -> None:
    """Methane in five times its air: the temperature of carbon dioxide, vapor, nitrogen and oxygen, with
    CoolProp's enthalpies of dilute gases.
    """
    coolprop = pytest.importorskip("CoolProp.CoolProp")
    from scipy.optimize import brentq

    air, n = 1.0, 5.0
    molar = {"Nitrogen": 0.7809, "Oxygen": 0.2095, "Argon": 0.0096}
    moles = {k: x * air / 0.028965 for k, x in molar.items()}
    fuel = moles["Oxygen"] / (2.0 * n)  # mol/s
    out = {**moles, "Oxygen": moles["Oxygen"] - 2.0 * fuel, "CarbonDioxide": fuel, "Water": 2.0 * fuel}

    def warmed(T: float) -> float:
        return sum(
            k
            * (
                coolprop.PropsSI("Hmolar", "T", T, "P", 1.0, s)
                - coolprop.PropsSI("Hmolar", "T", 298.15, "P", 1.0, s)
            )
            for s, k in out.items()
        )

    T = brentq(lambda T: warmed(T) - fuel * 802.3e3, 400.0, 1500.0)
    gas = empty(FIRED, 298.15).replace(gas=jnp.array([air, 0.0, 0.0, 0.0]))
    methane = empty(FIRED, 298.15).replace(gas=jnp.array([0.0, 0.0, fuel * 0.0160425, 0.0]))
    burner = Burner()
    fired = burner(gas, methane)
    closed = closure([gas, methane], [fired.product], fired.heat_duty)
    assert float(closed.mass) < 1e-12
    assert float(closed.energy) < 1e-12
    assert float(fired.product.temperature) == pytest.approx(T, rel=0.012)
    assert float(fired.product.gas[1]) == pytest.approx(2.0 * fuel * 0.018015, rel=1e-3)
    figures = burner.operate(gas=gas, fuel=methane).figures
    assert float(figures.excess_air_ratio) == pytest.approx(n, rel=2e-3)
    assert float(figures.heat_duty_heater) == pytest.approx(fuel * 802.3e3, rel=1e-3)
    card = gr.humid_gas.combustion_gas(0.7487, 0.2513, 50.02e6, n, humidity_ratio=0.0)
    assert float(fired.product.temperature) == pytest.approx(float(card.temperature), rel=2e-3)
    # without its heating value the gas stays as it came; propane burns too
    propane = empty(FIRED, 298.15).replace(gas=jnp.array([0.0, 0.0, 0.0, 0.01]))
    assert float(Burner(heat_loss_share=1.0)(gas, propane).product.temperature) == pytest.approx(
        298.15, abs=1e-3
    )
    assert [c.ok for c in burner.operate(gas=gas, fuel=propane.part(gas=8.0)).checks] == [False, False]
    with pytest.raises(InputError, match="fuel"):
        burner(empty(MIXTURE), empty(MIXTURE))


def test_a_burner_without_fuel_passes_the_gas():
    gas = empty(FIRED, 298.15).replace(gas=jnp.array([1.0, 0.01, 0.0, 0.0]))
    made = Burner(0.05).operate(gas=gas, fuel=empty(FIRED, 288.15))
    assert made.outlets.product.gas.tolist() == gas.gas.tolist()
    assert float(made.outlets.product.temperature) == pytest.approx(298.15, abs=1e-9)
    assert float(made.outlets.heat_duty) == 0.0
    assert float(made.figures.excess_air_ratio) == 0.0
    assert all(check.ok for check in made.checks)
