"""Dryers of cells and layers in superheated steam: what is published of it, and what must hold whatever the
settings.
"""

from __future__ import annotations

from typing import Any

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
import pytest
from tests.sharing.streams import air, wet

import granum as gr
from granum.core.errors import ConvergenceError
from granum.drying.equipment.belt import BeltDryer
from granum.drying.equipment.flash import FlashDryer
from granum.drying.equipment.fluid_bed import FluidBedDryer
from granum.drying.equipment.rotary import RotaryDryer
from granum.drying.equipment.tunnel import TunnelDryer
from granum.drying.gas_solid.cells import NO_WATER
from granum.drying.gas_solid.kinetics import DiffusionKinetics, Meeting, SurfaceKinetics, VanMeelKinetics
from granum.drying.gas_solid.matter import Matter
from granum.drying.gas_solid.steam import in_steam
from granum.streams.audit import closure
from granum.streams.from_materials import mixture_of
from granum.streams.stream import Stream, empty

COARSE = mixture_of(["water"], ["starch"], ["dry air", "water"], [1e-3, 2e-3])
PIECES = mixture_of(["water"], ["starch"], ["dry air", "water"], [5e-3, 14e-3])
FINE = mixture_of(["water"], ["starch"], ["dry air", "water"], [4e-5, 8e-5, 1.6e-4])
ATMOSPHERE = 101325.0
PURE = {"gas.water": 1.0, "gas.dry air": 0.0}


def steam(mixture: Any, flow: Any, temperature: Any, pressure: Any = ATMOSPHERE, air: Any = 0.0) -> Stream:
    """Steam with a mass share of air."""
    return empty(mixture, temperature, pressure).replace(gas=jnp.stack([flow * air, flow * (1.0 - air)]))


def test_gas_is_the_same_whatever_is_counted_as_its_carrier() -> None:
    """Half steam, half air, counted per dry gas and per gas as it entered: the state after some more vapor
    has been taken up.
    """
    gas = air(COARSE, 1.0, 1.0, 420.0)
    dry = Matter.of(wet(COARSE, 1.0, 1.0), gas)
    whole = eqx.tree_at(lambda m: m.gas_shares, dry, jnp.array([0.5, 0.5]))
    more = 0.3  # kg of vapor for each kg of dry gas
    Y, other = 1.0 + more, more / 2.0
    np.testing.assert_allclose(dry.fraction(Y), whole.fraction(other), rtol=1e-12)
    np.testing.assert_allclose(dry.molar_mass_ratio, whole.molar_mass_ratio, rtol=1e-12)
    np.testing.assert_allclose(
        dry.relative_humidity(420.0, Y), whole.relative_humidity(420.0, other), rtol=1e-12
    )
    np.testing.assert_allclose(
        dry.gas_heat_capacity(420.0, Y), whole.gas_heat_capacity(420.0, other), rtol=1e-12
    )
    density = dry.gas_density(420.0, Y) * (1.0 + Y), whole.gas_density(420.0, other) * (1.0 + other)
    np.testing.assert_allclose(*density, rtol=1e-12)
    rates = [
        SurfaceKinetics(0.1).rate(Meeting(0.5, 330.0, 420.0, y, 2.0, m))
        for m, y in ((dry, Y), (whole, other))
    ]
    np.testing.assert_allclose(*rates, rtol=1e-12)


@pytest.mark.parametrize(("bar", "boiling"), [(1.0, 99.61), (3.0, 133.52), (0.2, 60.06)])
def test_a_wet_surface_in_steam_boils(bar: float, boiling: float) -> None:
    """Boiling temperatures of printed steam tables, °C; the surface is as much above it as drives the vapor
    off.
    """
    gas = steam(COARSE, 1.0, boiling + 100.0 + 273.15, bar * 1e5)
    matter = Matter.of(wet(COARSE, 1.0, 1.0), gas)
    surface = Meeting(0.5, 300.0, gas.temperature, 0.0, 1.0, matter).wet_bulb - 273.15
    assert boiling - 0.01 < float(surface) < boiling + 0.15


def test_a_coefficient_for_air_is_larger_in_steam() -> None:
    """Along a plate, h by the power 0.8 of the flux, from tables of steam at 150 °C and of air at 90 °C: heat
    capacities 1.98 and 1.011 kJ/(kg K), conductivities 0.0288 and 0.0307 W/(m K), viscosities 1.42e-5 and
    2.14e-5 Pa s. The steam of streams is an ideal gas, whose heat capacity is 4 % smaller there.
    """
    gas = steam(COARSE, 1.0, 473.15)
    prandtl = (1.98e3 * 1.42e-5 / 0.0288) / (1.011e3 * 2.14e-5 / 0.0307)
    expected = 1.98 / 1.011 * prandtl ** (-2.0 / 3.0) * (1.42 / 2.14) ** 0.2
    found = in_steam(lambda G: 10.0 * G**0.8, jnp.asarray(3.0), gas) / (10.0 * 3.0**0.8)
    assert float(found) == pytest.approx(expected, rel=0.03)
    for other in (air(COARSE, 1.0, 0.5, 423.15), air(COARSE, 1.0, 0.0, 423.15)):
        assert float(in_steam(lambda G: 10.0 * G**0.8, 3.0, other)) == 10.0 * 3.0**0.8


def evaporated(gas: Stream) -> float:
    """From a tunnel that hardly cools a gas along its trays, fed at the temperature of its wet surface, kg of
    water a second and kg of solid.
    """
    feed = wet(COARSE, 1e-4, 2.0)
    at = Meeting(
        2.0,
        300.0,
        gas.temperature,
        gas.gas[1] / gas.gas[0] if gas.gas[0] > 0 else 0.0,
        1.0,
        Matter.of(feed, gas),
    )
    tunnel = TunnelDryer(900.0, 0.05, 1.0, 1.0, SurfaceKinetics(0.01), cells=5)
    out = tunnel(feed.replace(temperature=jnp.minimum(at.wet_bulb, 373.12)), gas)
    return float(2.0 - out.product.moisture_dry_basis)


def test_steam_dries_faster_than_dry_air_above_the_inversion_temperature() -> None:
    """At one mass velocity and 1 atm. Published values lie between 160 and 200 °C, by the flow and by how the
    temperature is defined (about 175 °C in Can. J. Chem. Eng. 72, 452, 1994; quoted, not opened).
    """

    def gain(celsius: float) -> float:
        T = celsius + 273.15
        return np.log(evaporated(steam(COARSE, 3.0, T)) / evaporated(air(COARSE, 3.0, 1e-6, T)))

    assert gain(150.0) < 0.0 < gain(210.0)
    assert gain(180.0) == pytest.approx(0.0, abs=0.15)


def test_steam_first_wets_a_cold_feed() -> None:
    """Starch (1.55 kJ/(kg K), library) with 0.3 kg/kg of water is brought from 27 to 100 °C by steam that
    condenses and cools from 200 °C: some 0.075 kg/kg of water, of which the gas brings a part as sensible
    heat of what stays steam.
    """
    dryer = RotaryDryer(10.0, 1.7, SurfaceKinetics(0.2), 0.01, 0.2, gas_direction="co-current")
    feed = wet(COARSE, 0.35, 0.3)
    gas = steam(COARSE, 4.0, 473.15)
    found = dryer.profile(feed, gas)
    dry = feed.replace(liquid=0.0 * feed.liquid)
    warm = dry.enthalpy_at(373.124) - dry.enthalpy_flow + 0.3 * 0.35 * 4190.0 * 73.1
    all_by_condensing = warm / 0.35 / (2257e3 + 1.95e3 * 100.0)
    most = float(jnp.max(found.moisture)) - 0.3
    assert 0.7 * all_by_condensing < most < all_by_condensing
    assert float(found.moisture[-1, 0]) < 0.01


def test_steam_that_a_cold_feed_uses_up_is_no_gas_that_dries() -> None:
    """A twentieth of what warms the feed: all but nothing of it leaves, and the balance still closes."""
    dryer = RotaryDryer(10.0, 1.7, SurfaceKinetics(0.2), gas_direction="co-current")
    feed, gas = wet(COARSE, 1.0, 1.0, 290.0), steam(COARSE, 0.01, 400.0)
    out = dryer(feed, gas)
    found = closure((feed, gas), [out.product, out.exhaust], out.heat_duty)
    assert max(float(found.mass), float(found.energy)) < 1e-9
    assert 0.0 <= float(out.exhaust.gas_flow) < 1e-3
    assert float(out.product.temperature) < 373.0


def units(name: str, x: Any) -> tuple[Any, Any]:
    """A dryer from four numbers between 0 and 1, and what its particles are made of."""
    kinetics = SurfaceKinetics(0.05 + 0.4 * x[0])
    return {
        "rotary": lambda: (RotaryDryer(4.0 + 16.0 * x[1], 1.0 + x[2], kinetics, cells=20), COARSE),
        "rotary with it": lambda: (
            RotaryDryer(
                4.0 + 16.0 * x[1], 1.0 + x[2], VanMeelKinetics(0.3), gas_direction="co-current", cells=20
            ),
            COARSE,
        ),
        "tunnel": lambda: (
            TunnelDryer(600.0 + 2e4 * x[1], 0.05, 1.0 + x[2], 10.0, DiffusionKinetics(1e-10, 1e-3), cells=20),
            COARSE,
        ),
        "flash": lambda: (FlashDryer(5.0 + 20.0 * x[1], 0.8 + 0.5 * x[2], kinetics, cells=20), FINE),
        "bed": lambda: (
            FluidBedDryer(4.0 + 4.0 * x[1], 3e3 * x[2] + 50.0, kinetics, bypass_fraction=0.2),
            COARSE,
        ),
        "tanks": lambda: (
            FluidBedDryer(4.0 + 4.0 * x[1], 3e3 * x[2] + 50.0, kinetics, cells=3, bypass_fraction=0.2),
            COARSE,
        ),
        "belt": lambda: (
            BeltDryer(5.0 + 10.0 * x[1], 0.03 + 0.1 * x[2], 300.0, kinetics, alternating=True, zone_count=2),
            PIECES,
        ),
    }[name]()


@pytest.mark.parametrize(
    "name",
    [
        "rotary",
        *(
            pytest.param(n, marks=pytest.mark.long)
            for n in ("bed", "rotary with it", "tunnel", "flash", "tanks", "belt")
        ),
    ],
)
def test_balances_close_in_steam_of_any_pressure(name: str) -> None:
    """From 0.2 to 4 bar, with up to 1.5 % of air; no gas hotter than it came, no water that is not there."""
    drawn = np.random.default_rng(7).uniform(size=(20, 10))

    def one(x: Any) -> tuple[Any, ...]:
        unit, mixture = units(name, x)
        pressure = 2e4 * 20.0 ** x[3]
        boiling = mixture.materials.fluid("water").boiling_temperature(pressure)
        n, moisture = len(mixture.sizes), 0.2 + 1.5 * x[4]
        cold = jnp.minimum(285.0 + 75.0 * x[5], boiling - 5.0)
        feed = empty(mixture, cold, pressure).replace(
            solid=jnp.full((1, n), 1.0 / n) * (0.1 + x[6]), liquid=jnp.stack([moisture * (0.1 + x[6])])
        )
        flow = (0.1 + x[6]) * moisture * (5.0 + 20.0 * x[7])
        gas = steam(mixture, flow, boiling + 20.0 + 150.0 * x[8], pressure, 0.015 * jnp.round(x[9]))
        out = unit(feed, gas)
        found = closure((feed, gas), [out.product, out.exhaust], out.heat_duty)
        over = jnp.maximum(out.product.temperature, out.exhaust.temperature) - gas.temperature
        least = jnp.minimum(jnp.min(out.exhaust.gas), out.product.liquid[0]) / feed.liquid[0]
        return found.mass, found.energy, over, least

    mass, energy, over, least = jax.jit(jax.vmap(one))(jnp.asarray(drawn))
    assert np.all(np.asarray(mass) < 1e-9)
    assert np.all(np.asarray(energy) < 1e-9)
    assert np.all(np.asarray(over) < 1e-6)
    assert np.all(np.asarray(least) > -NO_WATER)


def test_a_silo_refuses_steam_in_words() -> None:
    line = gr.alone("drying.silo_dryer", gas=PURE | {"temperature": "110 degC"}, cooling="no")
    with pytest.raises(ConvergenceError, match="not dried in steam"):
        line.solve()


def test_a_tray_oven_names_the_dryers_that_take_steam() -> None:
    """It had spoken of hotter air, and those that it names do dry in it."""
    with pytest.raises(ConvergenceError, match="take a tunnel dryer"):
        gr.alone("drying.tray_dryer", gas=PURE | {"temperature": "180 degC"}).solve()
    for dryer in ("tunnel_dryer", "belt_dryer"):
        run = gr.alone(f"drying.{dryer}", gas=PURE | {"temperature": "180 degC"}).solve()
        assert run.figure(f"{dryer}.evaporation_rate") > 0.0
        assert run.figure(f"{dryer}.superheat") > 5.0


def test_figures_of_a_dryer_in_steam() -> None:
    """All of them numbers: the superheat is what the exhaust has above boiling."""
    gas = PURE | {"temperature": "200 degC", "gas_flow": "14 t/h"}
    run = gr.alone("drying.rotary_dryer", gas=gas).solve()
    values = next(iter(run.units.values())).values
    assert all(np.isfinite(float(v)) for v in values)
    assert float(values.superheat) == pytest.approx(float(values.temperature_exhaust) - 373.12, abs=0.02)
