"""A unit that cannot do what it is asked says so in its own words: no stream of it carries a number that is
none.
"""

from __future__ import annotations

from pathlib import Path

import jax.numpy as jnp
import pytest

import granum as gr
from granum.cases.reading import read_text
from granum.core import registry
from granum.core.errors import ApplicabilityError, ConvergenceError
from granum.crystallization.equipment import msmpr
from granum.flowsheet import Flowsheet, ladder
from granum.flowsheet.run import Line
from granum.materials.solutes import SoluteSystem
from granum.streams.equipment import agglomerator
from granum.streams.equipment.agglomerator import settle
from granum.streams.equipment.basics import Heater, Mixer, Single
from granum.streams.mixture import Mixture, Species
from granum.streams.stream import Stream, empty
from granum.studies.lines import LineSubject

WET = """
[mixture]
solids = ["quartz"]
liquids = ["water"]
gases = ["dry air", "water"]
sizes = { smallest = "100 um", largest = "1 mm", classes = 4 }
[feeds.wet]
to = "dryer.feed"
solid_flow = "100 kg/h"
liquid_flow = "10 kg/h"
sizes = { fractions = [0.25, 0.25, 0.25, 0.25] }
[units.dryer]
"""
AIR = """
[feeds.air]
to = "dryer.gas"
gas_flow = "1000 kg/h"
relative_humidity = "50 %"
temperature = "{temperature}"
"""
MIXER = """
[mixture]
liquids = ["water"]
gases = ["dry air", "water"]
[feeds.hot]
to = "mixer.hot"
temperature = "1400 degC"
gas_flow = "1 kg/s"
gas = { "dry air" = 1.0 }
[units.mixer]
model = "streams.humid_mixer"
"""
GAS = """
[mixture]
liquids = ["water"]
gases = ["dry air", "water"]
[feeds.air]
to = "unit.gas"
temperature = "{temperature}"
gas_flow = "1 kg/s"
gas = {{ "dry air" = 1.0 }}
"""
SPRAY = """
[feeds.spray]
to = "unit.water"
liquid_flow = "1 g/s"
"""
LOST = 'heat_loss = "1 GW"\n'
CONVECTIVE = 'model = "drying.convective_dryer"\ntemperature_inlet = "120 degC"\n' + LOST
CASES = {
    "convective": (
        WET + CONVECTIVE + 'moisture_outlet = "1 %"' + AIR.format(temperature="20 degC"),
        "No temperature of the exhaust",
    ),
    "convective, humid": (
        WET + CONVECTIVE + 'relative_humidity_outlet = "60 %"' + AIR.format(temperature="20 degC"),
        "No temperature of the exhaust",
    ),
    "well mixed": (
        WET
        + 'model = "drying.well_mixed_dryer"\nresidence_time = "10 min"\ngas_velocity = "1 m/s"\n'
        + LOST
        + AIR.format(temperature="120 degC"),
        "No temperature of the bed",
    ),
    "closed": (
        WET + 'model = "drying.closed_dryer"\ntemperature_inlet = "60 degC"\nmoisture_outlet = "1 %"\n'
        # a coil too warm
        'drying_circuit = { law = "circuit_heat_pump", relative_humidity_outlet = "5 %", coil_temperature = "50 degC" }\n',  # noqa: E501
        "No temperature of the outlet air",
    ),
    "tray": (
        WET
        + 'model = "drying.tray_dryer"\ntemperature_inlet = "-100 degC"\ngas_velocity = "2 m/s"\ndry_mass_per_area = "20 kg/m^2"\n'  # noqa: E501
        'moisture_outlet = "1 %"\ncritical_moisture = "5 %"\n' + AIR.format(temperature="-10 degC"),
        "No temperature of the wet surface",
    ),
    "coil": (
        GAS.format(temperature="20 degC")
        + '[units.unit]\nmodel = "streams.dehumidifying_coil"\ncoil_temperature = "-100 degC"\n'
        "coil_bypass_fraction = 0.0\n",
        "No temperature was found at which gas and liquid",
    ),
    "humidifier": (
        GAS.format(temperature="-80 degC") + SPRAY + '[units.unit]\nmodel = "streams.adiabatic_humidifier"\n',
        "No temperature was found at which gas and liquid",
    ),
    "humid mixer": (MIXER, "No temperature was found at which gas and liquid"),
}


@pytest.mark.parametrize("name", CASES)
def test_an_impossible_duty_is_refused_in_the_units_own_words(tmp_path: Path, name: str) -> None:
    text, words = CASES[name]
    path = tmp_path / "line.toml"
    path.write_text('title = "impossible"\n' + text)
    with pytest.raises(ConvergenceError) as caught:
        gr.read(path).solve()
    assert words in caught.value.message
    assert caught.value.exit_code == 3


def refused(units: dict, feed: Stream, links: dict) -> str:
    with pytest.raises(ConvergenceError) as caught:
        Line("impossible", Flowsheet(units, {"feed": feed}, links)).solve()
    return caught.value.message


class Cooler(Mixer):
    """Takes far more heat than there is."""

    def outlets(self, inside: None, **inlets: Stream) -> Single:
        return Single(inlets["feed"].heated(-1e9))


def test_a_stream_whose_heat_no_temperature_carries() -> None:
    water = Species("water", (("water", 1.0),), (1000.0,), (4000.0,), 0.0, 0.018)
    feed = empty(Mixture((), (water,), (), (1e-6, 1e-3)), 330.0).replace(liquid=jnp.array([1.0]))
    told = refused(
        {"first": Cooler(), "then": Heater(temperature=300.0)},
        feed,
        {"feed": ("", "first.feed"), "cold": ("first", "then")},
    )
    assert "Stream 'cold' from unit 'first' has no temperature at which it carries the heat" in told


def test_an_agglomerator_whose_sizes_do_not_settle(monkeypatch: pytest.MonkeyPatch) -> None:
    """Stopped after two of the passes that a strong kernel needs."""
    monkeypatch.setattr(
        agglomerator,
        "settle",
        lambda step, start, tolerance, max_steps: settle(step, start, tolerance=tolerance, max_steps=2),
    )
    sand = Species("sand", (("sand", 1.0),), (2000.0,), (800.0,), 0.0, 0.06)
    feed = empty(Mixture((sand,), (), (), (1e-4, 2e-4, 4e-4, 8e-4)), 300.0).replace(
        solid=jnp.array([[0.01, 0.0, 0.0]])
    )
    kernel = {"law": "constant_kernel", "agglomeration_coefficient": 2e-13}
    bed = registry.find("streams.agglomerator")(agglomeration_kernel=kernel, holdup_mass=20.0, volume=0.5)
    assert "The steady sizes in the agglomerator were not found" in refused(
        {"bed": bed}, feed, {"feed": ("", "bed")}
    )


SALINE = """
[mixture]
liquids = ["water", "paracetamol"]
solids = ["paracetamol"]
gases = ["dry air", "water"]
sizes = { smallest = "2 um", largest = "3 mm", classes = 13 }
[feeds.feed]
to = "vessel.feed"
temperature = "70 degC"
liquid_flow = "1 kg/s"
liquid = { water = 0.8, paracetamol = 0.2 }
[units.vessel]
solubility = { law = "library_solubility", solute = "paracetamol" }
growth = { law = "power_law_growth", growth_coefficient = "1e-6 m/s", growth_order = 1.0 }
nucleation = { law = "secondary_nucleation", nucleation_coefficient = "1e7 1/(m^3*s)", nucleation_order = 1.5 }
"""  # noqa: E501
VESSELS = {
    "continuous": 'model = "crystallization.msmpr"\ntemperature = "{temperature}"\nvolume = "2 m^3"\n',
    "batch": 'model = "crystallization.batch_crystallizer"\nduration = "1 hour"\nseed_mass_per_solvent = 0.01\n'  # noqa: E501
    'temperature_program = {{ law = "power_cooling", temperature_start = "{temperature}", temperature_end = "15 degC", duration = "1 hour" }}\n',  # noqa: E501
    "vacuum": 'model = "crystallization.vacuum_crystallizer"\ntemperature = "{temperature}"\nvolume = "2 m^3"\n',  # noqa: E501
}


def vessel(path: Path, kind: str, temperature: str, classes: int = 13) -> Line:
    path.write_text(
        'title = "crystals"\n'
        + SALINE.replace("13", str(classes))
        + VESSELS[kind].format(temperature=temperature)
    )
    return gr.read(path)


def test_a_crystallizer_whose_supersaturation_is_not_found(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    found = msmpr.steady_msmpr
    monkeypatch.setattr(
        msmpr, "steady_msmpr", lambda *given: found(*given)._replace(converged=jnp.asarray(False))
    )
    with pytest.raises(ConvergenceError) as caught:
        vessel(
            tmp_path / "line.toml", "continuous", "20 degC", 11
        ).solve()  # compiled for itself, being patched
    assert "Unit 'vessel' has no solution: No supersaturation was found" in caught.value.message
    assert caught.value.exit_code == 3


def test_a_crystallizer_that_would_have_to_take_vapor_in(tmp_path: Path) -> None:
    with pytest.raises(ConvergenceError, match="The feed is too cold to boil"):
        vessel(tmp_path / "line.toml", "vacuum", "95 degC").solve()


@pytest.mark.parametrize("kind", ["continuous", "batch"])
def test_a_crystallizer_beyond_the_data_of_its_solubility_says_so(tmp_path: Path, kind: str) -> None:
    """The data of paracetamol in water end at 30 °C."""
    line = vessel(tmp_path / "line.toml", kind, "60 degC")
    told = [
        row for row in line.solve().flags if row["flag"] == "extrapolated" and "paracetamol" in row["card"]
    ]
    assert [row["worst"] for row in told] == [pytest.approx(333.15)]
    inside = {
        "continuous": {"vessel.temperature": 293.15},
        "batch": {"vessel.temperature_program.temperature_start": 303.15},
    }[kind]
    assert not [row for row in line.with_values(**inside).solve().flags if "paracetamol" in row["card"]]


def test_a_stirrer_in_a_solution_of_unknown_viscosity_is_not_told(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """What only a utility asks for makes no line fail: the stirrer is left out, the cold is told."""

    def unknown(*_given: object) -> object:
        raise ApplicabilityError("The solvent has no viscosity.")  # all of the library have one

    monkeypatch.setattr(SoluteSystem, "solution_viscosity", unknown)
    line = vessel(tmp_path / "line.toml", "continuous", "20 degC", 10)  # compiled for itself, being patched
    run = line.solve()
    assert "electric_power_agitator" not in run.units["vessel"].uses
    assert "electric_power_agitator" not in run.as_json()["units"]["vessel"]["utilities"]
    assert run.utilities.cooling_input == pytest.approx(-float(run.units["vessel"].values.heat_duty))
    assert run.utilities.electric_power == 0.0
    subject, watched = LineSubject.of(line), "vessel.electric_power_agitator"
    computed = subject.compute(subject.arrays(), {}, (watched,), subject.begin())
    with pytest.raises(ApplicabilityError, match="is not known of this line"):
        computed.lookup(watched)


def test_a_mill_with_nothing_to_take_its_power() -> None:
    sand = Species("sand", (("sand", 1.0),), (2000.0,), (800.0,), 0.0, 0.06)
    feed = empty(Mixture((sand,), (), (), (1e-4, 2e-4, 4e-4, 8e-4)), 300.0)
    mill = registry.find("comminution.bond_mill")(shaft_power=1e4, work_index=5e4)
    assert "cannot take up the shaft power" in refused({"mill": mill}, feed, {"feed": ("", "mill")})


def test_a_screen_finer_than_its_capacity_law() -> None:
    sand = Species("sand", (("sand", 1.0),), (2000.0,), (800.0,), 0.0, 0.06)
    feed = empty(Mixture((sand,), (), (), (1e-4, 2e-4, 4e-4, 8e-4)), 300.0).replace(solid=jnp.ones((1, 3)))
    screen = registry.find("comminution.vibrating_screen")(aperture=3e-4, screen_area=2.0)
    assert "Karra's capacity falls to zero there" in refused(
        {"screen": screen}, feed, {"feed": ("", "screen")}
    )


BEFORE = """title = "An evaporator before a loop"
[mixture]
liquids = ["water", "sodium chloride"]
solids = ["sodium chloride"]
gases = ["water"]
sizes = { smallest = "100 um", largest = "1 mm", classes = 4 }
[feeds.brine]
to = "evaporator.feed"
liquid_flow = "10 t/h"
temperature = "60 degC"
liquid = { water = "90 %", "sodium chloride" = "10 %" }
[units.evaporator]
model = "evaporation.evaporator"
area = "500 m2"
pressure = "0.3 bar"
pressure_steam = "3 bar"
heat_transfer_coefficient = "2000 W/(m2*K)"
[units.mix]
model = "streams.mixer"
[units.crystallizer]
model = "crystallization.msmpr"
temperature = "75 degC"
volume = "10 m3"
evaporation = "500 kg/h"
solubility = { law = "library_solubility", solute = "sodium chloride" }
growth = { law = "power_law_growth", growth_coefficient = 1e-6, growth_order = 1.0 }
nucleation = { law = "secondary_nucleation", nucleation_coefficient = 1e6, nucleation_order = 1.4 }
[units.purge]
model = "streams.splitter"
side_fraction = "20 %"
[streams]
strong = ["evaporator.product", "mix.strong"]
mixed = ["mix.product", "crystallizer.feed"]
magma = ["crystallizer.product", "purge.feed"]
back = ["purge.product", "mix.back"]
"""


def test_what_stands_before_a_loop_needs_no_other_solver(monkeypatch: pytest.MonkeyPatch) -> None:
    """No loop brings the evaporator into reach: it is told without exact derivatives, which take minutes."""

    def exactly(*_given: object) -> None:
        raise AssertionError("the exact solver was called")

    line = read_text(BEFORE)
    assert ladder.before_loops(line.sheet) == {"evaporator"}
    monkeypatch.setattr(ladder, "_exactly", exactly)
    with pytest.raises(ConvergenceError, match=r"evaporator.*boils off wholly"):
        line.solve()


def test_what_boils_off_in_a_crystallizer_is_water_removed() -> None:
    line = read_text(BEFORE.replace("500 m2", "25 m2")).solve()
    boiled, made = (line.sheets[name].figures for name in ("evaporator", "crystallizer"))
    assert float(made.evaporation) == pytest.approx(500.0 / 3600.0)
    assert line.utilities.evaporation_rate == pytest.approx(
        float(boiled.evaporation_rate + made.evaporation), rel=1e-12
    )
