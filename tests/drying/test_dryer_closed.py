"""Dryers in a closed circuit: heat pump, superheated steam, recompression; staged heating as dryers in a row."""

from __future__ import annotations

import jax.numpy as jnp
import pytest

import granum as gr
from granum.drying.contact.dryer import ready
from granum.drying.equipment.closed import ClosedDryer, HeatPumpCircuit, SteamCircuit
from granum.drying.equipment.convective import ConvectiveDryer
from granum.streams.audit import closure
from granum.streams.from_materials import mixture_of
from granum.streams.stream import Stream, empty

MIXTURE = mixture_of(["water"], ["starch"], ["dry air", "water"], [1e-3, 1e-2])


def slurry(solid: float, water: float, T: float) -> Stream:
    return empty(MIXTURE, T).replace(solid=jnp.array([[solid]]), liquid=jnp.array([water]))


@ready
def whole(dryer: ClosedDryer, feed: Stream):
    out = dryer(feed)
    closed = closure([feed], [out.product, out.vapor, out.condensate], out.heat_duty + out.shaft_power)
    return closed, dryer.results({"feed": feed}, out), dryer.checks({"feed": feed}, out)


def checked(dryer: ClosedDryer, feed: Stream):
    """Figures and checks of a dryer whose balances close."""
    closed, figures, checks = whole(dryer, feed)
    assert float(closed.mass) < 1e-12
    assert float(closed.energy) < 1e-12
    return figures, {c.name: c.ok for c in checks}


def test_heat_pump_dryer_beside_coolprop() -> None:
    """The same circuit reckoned with CoolProp's humid air: a trace of solid, water that enters at the wet bulb, so that the dryer is isenthalpic."""
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
    figures, checks = checked(dryer, slurry(1e-6, 1.0, 303.15))
    assert float(figures.temperature_outlet) == pytest.approx(T2, abs=0.1)
    assert float(figures.mass_flow_circulating) == pytest.approx(1.0 / (w2 - w1), rel=0.01)
    assert float(figures.shaft_power) == pytest.approx(work / (w2 - w1), rel=0.01)
    assert 1.0 < float(figures.moisture_extraction_rate) * 3.6e6 < 4.0  # kg/kWh, the usual range (Mujumdar 2014)
    assert all(checks.values())


def test_superheated_steam_and_its_recompression() -> None:
    """Steam tables at 1 atm, 200 to 120 °C, water at 20 °C: (2716.5 − 84)/(2875.4 − 2716.5) = 16.57. With compression of steam from a feed
    at boiling heat the notes' table III.2 has 160 to 200 kJ/kg."""
    dryer = ClosedDryer(SteamCircuit(393.15), 473.15, 0.0)
    figures, checks = checked(dryer, slurry(1e-6, 1.0, 293.15))
    assert float(figures.mass_flow_circulating) == pytest.approx(16.57, rel=0.01)
    assert all(checks.values())
    run = gr.read("examples/dryers/steam.toml").solve()
    assert run.audit["energy_closure"] < 1e-12
    assert 160e3 < run.figure("dryer.energy_per_water") < 200e3
    assert run.figure("dryer.heat_duty_heater") < 0.0  # more than the circuit needs
    assert all(c.ok for c in run.units["dryer"].checks)
    _figures, checks = checked(ClosedDryer(SteamCircuit("95 degC", "2 bar"), "150 degC", 0.05), slurry(1.0, 2.0, 373.0))
    assert sorted(checks.values()) == [False, False, True]  # outlet below boiling, heat given off below the hot gas


def test_staged_heating_is_dryers_in_a_row() -> None:
    """Two dryers, the second fed by the exhaust and the product of the first: the notes' air of 25 °C, 9.9 g/kg heated to 50 °C twice. The
    card reckons the same without streams, the product's heat left out: there is little of it here."""
    feed, gas = slurry(1e-4, 0.02, 303.15), empty(MIXTURE, 298.15).replace(gas=jnp.array([1.0, 0.0099]))
    stage = ConvectiveDryer(temperature_inlet=323.15, relative_humidity_outlet=0.9)
    run = ready(lambda feed, gas: stage(feed, gas))
    first = run(feed, gas)
    second = run(first.product, first.exhaust)
    card = gr.drying.staged_heating("25 degC", "9.9 g/kg", "50 degC", "90 %", stage_count=2)
    evaporated = float(second.exhaust.gas[1]) - 0.0099
    spent = float(first.heat_duty + second.heat_duty)
    assert evaporated == pytest.approx(1.0 / float(card.dry_gas_per_water), rel=0.05)
    assert spent / evaporated == pytest.approx(float(card.energy_per_water), rel=0.05)
    streams = [second.product, second.exhaust, first.condensate, second.condensate]
    assert float(closure([feed, gas], streams, spent).energy) < 1e-9
