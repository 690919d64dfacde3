"""Tray, drum and paddle dryers: textbook examples, the course notes' tables, closed forms and independent
integrations.
"""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest
from scipy.optimize import brentq
from scipy.special import erf
from tests.sharing.places import EXAMPLES

import granum as gr
from granum.core.errors import ApplicabilityError, ConvergenceError, InputError
from granum.drying.formulas import assisted
from granum.drying.formulas import contact_drying as c
from granum.drying.gas_solid.matter import Matter
from granum.humid_gas import state
from granum.streams.audit import closure

FOLDER = EXAMPLES / "dryers"


def inlets_of(line):
    return {k.target.partition(".")[2]: line.sheet.feeds[k.name] for k in line.sheet.links if not k.origin}


def test_tray_of_the_textbook():
    """Dutta's example: 43.3 W/(m² K), 41.5 °C, 1.412 g/(m² s); 1.10 h and 2.63 h to 0.005 from 0.28 with
    35 kg/m².
    """
    run = gr.read(FOLDER / "tray.toml").solve()
    assert run.figure("oven.heat_transfer_coefficient") == pytest.approx(43.3, rel=0.005)
    assert run.figure("oven.surface_temperature") - 273.15 == pytest.approx(41.5, abs=0.4)
    assert run.figure("oven.drying_rate_constant") == pytest.approx(1.412e-3, rel=0.02)
    hours = 35 / 1.412e-3 * (0.16 + 0.12 * np.log(0.12 / 0.005)) / 3600
    assert run.figure("oven.drying_time") / 3600 == pytest.approx(hours, rel=0.02)
    assert run.audit["mass_closure"] < 1e-12
    assert run.audit["energy_closure"] < 1e-9
    # 2750 kg/h of air with 0.01 kg/kg from 25 to 120 °C for 27.5 kg/h of water, and its latent heat
    by_hand = 2750 / 1.01 * (1.006e3 + 0.01 * 1.87e3) * 95.0 / 27.5 + 2.6e6
    assert run.figure("oven.energy_per_water") == pytest.approx(by_hand, rel=0.03)
    assert [c.name for c in run.units["oven"].checks if not c.ok] == ["energy per water evaporated"]


def test_tray_reports_what_cannot_be():
    line = gr.read(FOLDER / "tray.toml")
    with pytest.raises(ConvergenceError, match=r"'oven' has no solution.*without end"):
        line.with_values(**{"oven.equilibrium_moisture": 0.01, "oven.temperature_limit": 350.0}).solve()
    damp, inlets = line.with_values(**{"oven.radiated_heat": 2000.0}).sheet.units["oven"], inlets_of(line)
    assert float(damp.operate(**inlets).figures.drying_time) < 3.3 * 3600


def test_a_load_on_trays_over_time():
    """The textbook's load under a low ceiling: water and heat of trays and air close; while all is wet the
    air cools as the closed form says; the edge that meets the air first leads; the whole takes as long as
    mean fluxes say.
    """
    line = gr.read(FOLDER / "tray.toml")
    unit, inlets = dataclasses.replace(line.sheet.units["oven"], tray_gap=0.04), inlets_of(line)
    feed, gas = inlets["feed"], inlets["gas"]
    figures = unit.operate(**inlets).figures
    Tw = float(figures.surface_temperature)
    feed = feed.replace(temperature=Tw)  # nothing is left to warm
    load = unit.batch(feed, gas, cells=6, steps=150)
    assert bool(load.converged)
    matter, w = Matter.of(feed, gas), float(figures.humidity_ratio)
    through = float(load.dry_gas)
    X, T = np.asarray(load.moisture), np.asarray(load.temperature)
    assert float(load.vapor) - through * w == pytest.approx(0.28 - X[-1].mean(), rel=1e-9)
    held = float(np.mean(matter.moist_solid(T[-1][:, None], X[-1][:, None]))) - float(
        matter.moist_solid(np.array([[Tw]]), 0.28)[0, 0]
    )
    brought = through * float(matter.moist_gas(unit.temperature_inlet, w)) - float(load.gas_enthalpy)
    assert brought == pytest.approx(held, rel=1e-9)
    wet = int(np.argmin(abs(np.asarray(load.moisture_mean) - 0.18)))
    cooled = float(unit.temperature_inlet) - float(figures.temperature_outlet)
    # which knows neither the cold vapor that joins the air nor, half as strong, the heat that it keeps from
    # the surface (Ackermann), nor six mixed cells
    above = float(unit.temperature_inlet) - Tw
    more = 0.5 * 1890.0 * (above - 0.5 * cooled) / 2.4e6 - cooled / above / 12.0
    assert float(unit.temperature_inlet) - float(load.gas_temperature[wet, -1]) == pytest.approx(
        cooled * (1.0 + more), rel=0.005
    )
    # the logarithm of Stefan flow against a difference of humidities
    assert T[wet] == pytest.approx(Tw, abs=0.2)
    assert np.all(np.diff(X, axis=1) >= -1e-9)
    assert float(load.drying_time) == pytest.approx(float(figures.drying_time), rel=0.01)
    with pytest.raises(ApplicabilityError, match="radiated"):
        dataclasses.replace(unit, radiated_heat=100.0).batch(feed, gas)


def test_gas_along_a_tray():
    """A tutorial of the University of Glasgow: 90 °C and 10 %, 0.3 kg/s on 0.5 m, 200 W/(m² K), 60 °C at the
    end: 3.59 m.
    """
    air = state(temperature=363.15, relative_humidity=0.1)
    heat = 1005 + 1884 * air.humidity_ratio
    length = brentq(
        lambda L: (
            c.temperature_outlet_tray(363.15, air.wet_bulb_temperature, 200.0, 6.0, L, 0.1, heat) - 333.15
        ),
        0.1,
        20.0,
    )
    assert length == pytest.approx(3.59, rel=0.025)


def test_infrared_warms_the_surface():
    plain, help_ = (assisted.drying_rate_assisted(353.15, 0.01, 30.0, q) for q in (0.0, 3000.0))
    wet = state(temperature=353.15, humidity_ratio=0.01).wet_bulb_temperature
    assert plain.surface_temperature == pytest.approx(wet, abs=0.5)
    assert help_.surface_temperature > plain.surface_temperature + 5
    # the heat taken up is the heat of vaporization
    latent = (30.0 * (353.15 - help_.surface_temperature) + 3000.0) / help_.drying_rate_constant
    assert latent == pytest.approx(2501e3 - 2361 * (help_.surface_temperature - 273.15), rel=5e-3)
    radiator = assisted.drying_rate_assisted(353.15, 0.01, 30.0, 0.0, 600.0, 0.8)
    assert radiator.drying_rate_constant > plain.drying_rate_constant
    assert assisted.radiated_heat_microwave(1000.0, 0.5, 1.0, 0.01, 0.6) == pytest.approx(1200.0)


def test_penetration_is_stefans_problem_without_wall_resistance():
    """Neumann's solution of freezing, one phase: √π ζ e^{ζ²} erf ζ = c ΔT/(X L)."""
    for X in (0.02, 0.1, 0.5):
        stefan = 1000 * 60.0 / (X * 2.4e6)
        z = brentq(lambda z, s=stefan: np.sqrt(np.pi) * z * np.exp(z * z) * erf(z) - s, 1e-6, 5.0)
        found = c.penetration_drying(X, 390.0, 330.0, 1e9, 100.0)
        assert found.front_position == pytest.approx(z, rel=1e-5)
        assert found.heat_transfer_coefficient == pytest.approx(100.0 / erf(z), rel=1e-5)
        assert found.latent_share == pytest.approx(np.exp(-z * z), rel=1e-5)


def test_penetration_between_its_limits():
    wet, dry = (
        c.penetration_drying(1e4, 390.0, 330.0, 400.0, 80.0),
        c.penetration_drying(1e-6, 390.0, 330.0, 400.0, 80.0),
    )
    assert wet.heat_transfer_coefficient == pytest.approx(400.0, rel=1e-3)
    assert dry.heat_transfer_coefficient == pytest.approx(1 / (1 / 400 + 1 / 80), rel=1e-3)
    flux = [
        float(c.penetration_drying(X, 390.0, 330.0, 400.0, 80.0).drying_flux)
        for X in (0.02, 0.05, 0.1, 0.2, 0.4)
    ]
    assert np.all(np.diff(flux) > 0)
    assert c.penetration_drying(0.2, 330.0, 330.0, 400.0, 80.0).drying_flux == pytest.approx(0.0, abs=1e-12)


def test_wall_coefficient_falls_with_vacuum_and_size():
    at = [c.heat_transfer_coefficient_wall_particles(1e-3, 350.0, P) for P in (1e5, 1e4, 1e3)]
    assert at[0] > at[1] > at[2] > 100
    assert c.heat_transfer_coefficient_wall_particles(2e-4, 350.0, 1e5) > at[0]


def test_paddle_dryer_has_the_capacity_of_the_notes():
    """Tables IV.21 and IV.22: sludge from 70 to 3.2 % with steam at 120 to 130 °C, 10 to 15 kg/(m² h), 10 min
    to 10 h.
    """
    line = gr.read(FOLDER / "paddle.toml")
    run = line.solve()
    assert 10.0 <= run.figure("dryer.evaporation_per_area") * 3600 <= 15.0
    assert 600 <= run.figure("dryer.residence_time") <= 36000
    assert run.figure("dryer.temperature_product") < 403.15
    # boiling dryers 2400 to 3300 kJ/kg (table III.2)
    assert run.figure("dryer.energy_per_water") == pytest.approx(2.65e6, rel=0.02)
    assert run.audit["mass_closure"] < 1e-12
    assert run.audit["energy_closure"] < 1e-9
    assert all(check.ok for check in run.units["dryer"].checks)
    vacuum = line.with_values(**{"dryer.pressure": 1e4, "dryer.wall_temperature": 373.15}).solve()
    assert vacuum.figure("dryer.temperature_product") < 350.0
    # steam tables at 0.1 bar
    assert vacuum.figure("dryer.boiling_temperature") - 273.15 == pytest.approx(45.8, abs=0.1)


def test_paddle_curve_conserves_heat():
    """Heat through the wall, integrated over the way, is what vapor and bed took up."""
    line = gr.read(FOLDER / "paddle.toml")
    unit, feed = (
        dataclasses.replace(line.sheet.units["dryer"], pasty_moisture=None),
        line.sheet.feeds["sludge"],
    )
    bed = unit.curve(feed)
    X, T = np.asarray(bed.moisture), np.asarray(bed.temperature)
    boiling, wall, coefficient, capacity, _liquid = (float(x) for x in unit.inside(feed).heat)
    heat = []
    for x, t in zip(X, T, strict=True):
        p = c.penetration_drying(float(x), 403.15, float(t), wall, coefficient, capacity, 2256.5e3)
        heat.append(float(p.heat_transfer_coefficient) * (403.15 - t))
    through = np.trapezoid(heat, np.asarray(bed.time)) / 40.0
    water = X[0] - X[-1]
    sensible = capacity * (T[-1] - T[0]) + 4187.0 * np.trapezoid(X, T)
    assert through == pytest.approx(2256.5e3 * water + sensible, rel=5e-3)
    assert T[0] == pytest.approx(boiling)


def test_paste_boils_at_a_constant_rate_and_an_area_dries_so_far():
    """By hand: a mixture of 3.33 kg of solid and water at rest for the contact time takes 2√(ρcλ/(πt)); its
    water leaves at h ΔT/L until 1 kg/kg.
    """
    line = gr.read(FOLDER / "paddle.toml")
    unit, feed = line.sheet.units["dryer"], line.sheet.feeds["sludge"]
    inlets = {"feed": feed}
    figures = unit.operate(**inlets).figures
    X, capacity = 7 / 3, float(unit.inside(feed).heat.capacity)
    # water of 100 °C, steam tables
    held = (capacity + X * 4216.0) / (1.0 / float(feed.solid_density) + X / 958.4)
    h = 2.0 * np.sqrt(held * 0.6 / (np.pi * float(figures.contact_time)))
    assert float(figures.heat_transfer_coefficient_paste) == pytest.approx(h, rel=1e-3)
    flux = h * (403.15 - 373.124) / 2256.5e3
    bed = unit.curve(feed)
    pasty = np.asarray(bed.moisture) > 1.0 + 1e-9
    np.testing.assert_allclose(np.asarray(bed.flux)[pasty], flux, rtol=1e-3)
    assert np.interp(-1.0, -np.asarray(bed.moisture), np.asarray(bed.time)) == pytest.approx(
        unit.dry_mass_per_area * (X - 1.0) / flux, rel=1e-3
    )
    parameters = {p.name: getattr(unit, p.name) for p in unit.card.parameters if p.name != "moisture_outlet"}
    back = type(unit).rate(float(figures.area), feed, **parameters)
    assert float(back.moisture_outlet) == pytest.approx(float(unit.moisture_outlet), rel=1e-9)
    with pytest.raises(ApplicabilityError, match=r"does not fit|outside what is possible"):
        type(unit).rate(0.01, feed, **parameters)


def test_drum_dryer_of_the_notes():
    """Tables IV.3 and IV.4: potato flakes from 80 to about 5 %, 100 to 180 °C, 3 to 30 s, 15 to 40 kg/(m² h);
    1.1 to 1.6 kg of steam.
    """
    line = gr.read(FOLDER / "drum.toml")
    run = line.solve()
    moisture = run.figure("drum.moisture_dry_basis")
    assert moisture / (1 + moisture) == pytest.approx(0.05, abs=0.015)
    assert 15 <= run.figure("drum.evaporation_per_area") * 3600 <= 40
    assert 3 <= run.figure("drum.contact_time") <= 30
    # steam tables at 5 bar
    assert run.figure("drum.wall_temperature") - 273.15 == pytest.approx(151.8, abs=0.1)
    assert 1.1 <= run.figure("drum.steam_per_water") <= 1.6
    assert run.figure("drum.drying_flux") == pytest.approx(780 * (151.84 - 99.97) / 2256.5e3, rel=2e-3)
    assert run.audit["mass_closure"] < 1e-12
    assert run.audit["energy_closure"] < 1e-9
    colder = line.with_values(**{"drum.pressure_steam": 4e5}).solve()
    assert colder.figure("drum.moisture_dry_basis") > moisture
    unit, feed = line.sheet.units["drum"], line.sheet.feeds["mash"]
    out = unit(feed)
    assert float(closure((feed,), (out.product, out.vapor), out.heat_duty).energy) < 1e-12


def test_drum_is_turned_under_its_knife():
    """By hand 0.2 · 2 kN/m · 1.93 m at 0.178 m/s; the whole well below the motor of 5.5 to 7.5 kW that makers
    put on a drum of this size (from memory), and a hundredth or two of the heat; a web that leaves by itself
    drags nothing.
    """
    line = gr.read(FOLDER / "drum.toml")
    run = line.solve()
    assert run.figure("drum.shaft_power") == pytest.approx(0.2 * 2e3 * 1.93 * 0.178, rel=1e-3)
    drive = float(run.units["drum"].uses["electric_power_drive"])
    assert 500.0 * run.figure("drum.area") < drive < 5.5e3
    assert 0.01 < drive / run.utilities.heat_input < 0.03
    slower = line.with_values(**{"drum.rotation_speed": "1.7 rpm"}).solve()
    assert slower.figure("drum.shaft_power") == pytest.approx(0.5 * run.figure("drum.shaft_power"))
    web = line.with_values(**{"drum.friction_coefficient": 0.0, "drum.drive_power_per_area": 0.0}).solve()
    assert web.utilities.electric_power == 0.0
    assert web.figure("drum.moisture_dry_basis") == run.figure("drum.moisture_dry_basis")


def test_drums_under_vacuum_boil_at_its_pressure():
    """By hand from steam tables: 10 kPa boil at 45.81 °C with 2392.1 kJ/kg, steam of 5 bar is at 151.84 °C.
    The air that leaks in is that of the chart of the Heat Exchange Institute, 0.713 kg/h times the volume in
    m³ to the power of two thirds at 10 kPa, drawn off at 25 °C by a pump of half the isothermal work.
    """
    line = gr.read(FOLDER / "drum.toml")
    plain, housed = line.solve(), line.with_values(**{"drum.pressure": 1e4}).solve()
    assert housed.figure("drum.boiling_temperature") - 273.15 == pytest.approx(45.81, abs=0.02)
    assert housed.figure("drum.drying_flux") == pytest.approx(780 * (151.84 - 45.81) / 2392.1e3, rel=2e-3)
    assert float(housed.streams["vapor"].pressure) == 1e4
    assert housed.audit["energy_closure"] < 1e-9
    volume = 3.0 * np.pi / 4.0 * 1.93
    drawn = 0.713 / 3600.0 * volume ** (2 / 3) / 0.02896 * 8.314 * 298.15 / 1e4
    taken = drawn * 1e4 * np.log(10.1325) / 0.5 / 0.9
    assert float(housed.units["drum"].uses["electric_power_vacuum"]) == pytest.approx(taken, rel=2e-3)
    assert float(plain.units["drum"].uses["electric_power_vacuum"]) == 0.0


def test_two_drums_are_one_twice_as_wide():
    line = gr.read(FOLDER / "drum.toml")
    wide = line.with_values(**{"drum.width": 2.0}).solve()
    text = (FOLDER / "drum.toml").read_text(encoding="utf-8")
    text = text.replace('width = "1.93 m"', 'width = "1 m"\ncylinder_count = 2')
    twin = gr.cases.read_text(text).solve()
    for name in ("moisture_dry_basis", "evaporation_rate", "area", "dry_mass_per_area", "shaft_power"):
        assert twin.figure(f"drum.{name}") == pytest.approx(wide.figure(f"drum.{name}"), rel=1e-12)
    unit = line.sheet.units["drum"]
    sized = type(unit).size(0.06, line.sheet.feeds["mash"], 1.0, 0.356, 5e5, cylinder_count=2)
    one = type(unit).size(0.06, line.sheet.feeds["mash"], 1.0, 0.356, 5e5)
    assert float(one.width) == pytest.approx(2.0 * float(sized.width))


def test_drum_sized_and_run_meet():
    line = gr.read(FOLDER / "drum.toml")
    unit, feed = line.sheet.units["drum"], line.sheet.feeds["mash"]
    more = {"heat_transfer_coefficient": 780.0, "critical_moisture": 0.5}
    for moisture in (0.05, 0.2, 0.5, 1.5):
        sized = type(unit).size(moisture, feed, 1.0, 0.35, 5e5, **more)
        assert float(sized.operate(feed=feed).figures.moisture_dry_basis) == pytest.approx(moisture, rel=1e-9)
    with pytest.raises(InputError, match="not to 5"):
        type(unit).size(5.0, feed, 1.0, 0.35, 5e5, **more)
