"""A unit that cannot do what it is asked says so in its own words: no stream of it carries a number that is none."""

from __future__ import annotations

from pathlib import Path

import jax.numpy as jnp
import pytest

import granum as gr
from granum.core import registry
from granum.core.errors import ConvergenceError
from granum.flowsheet import Flowsheet
from granum.flowsheet.run import Line
from granum.streams.equipment import agglomerator
from granum.streams.equipment.agglomerator import settle
from granum.streams.equipment.basics import Heater, Mixer, Single
from granum.streams.mixture import Mixture, Species
from granum.streams.stream import Stream, empty

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
LOST = 'heat_loss = "1 GW"\n'
CONVECTIVE = 'model = "drying.convective_dryer"\ntemperature_inlet = "120 degC"\n' + LOST
CASES = {
    "convective": (WET + CONVECTIVE + 'moisture_outlet = "1 %"' + AIR.format(temperature="20 degC"), "No temperature of the exhaust"),
    "convective, humid": (
        WET + CONVECTIVE + 'relative_humidity_outlet = "60 %"' + AIR.format(temperature="20 degC"), "No temperature of the exhaust"
    ),
    "well mixed": (
        WET + 'model = "drying.well_mixed_dryer"\nresidence_time = "10 min"\ngas_velocity = "1 m/s"\n' + LOST + AIR.format(temperature="120 degC"),
        "No temperature of the bed",
    ),
    "closed": (
        WET + 'model = "drying.closed_dryer"\ntemperature_inlet = "60 degC"\nmoisture_outlet = "1 %"\n'
        'drying_circuit = { law = "circuit_heat_pump", relative_humidity_outlet = "5 %", coil_temperature = "50 degC" }\n',  # a coil too warm
        "No temperature of the outlet air",
    ),
    "humid mixer": (MIXER, "No temperature was found at which gas and liquid"),
}  # fmt: skip


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

    def __call__(self, **inlets: Stream) -> Single:
        return Single(inlets["feed"].heated(-1e9))


def test_a_stream_whose_heat_no_temperature_carries() -> None:
    water = Species("water", (("water", 1.0),), (1000.0,), (4000.0,), 0.0, 0.018)
    feed = empty(Mixture((), (water,), (), (1e-6, 1e-3)), 330.0).replace(liquid=jnp.array([1.0]))
    told = refused({"first": Cooler(), "then": Heater(temperature=300.0)}, feed, {"feed": ("", "first.feed"), "cold": ("first", "then")})
    assert "Stream 'cold' from unit 'first' has no temperature at which it carries the heat" in told


def test_an_agglomerator_whose_sizes_do_not_settle(monkeypatch: pytest.MonkeyPatch) -> None:
    """Stopped after two of the passes that a strong kernel needs."""
    monkeypatch.setattr(
        agglomerator, "settle", lambda step, start, tolerance, max_steps: settle(step, start, tolerance=tolerance, max_steps=2)
    )
    sand = Species("sand", (("sand", 1.0),), (2000.0,), (800.0,), 0.0, 0.06)
    feed = empty(Mixture((sand,), (), (), (1e-4, 2e-4, 4e-4, 8e-4)), 300.0).replace(solid=jnp.array([[0.01, 0.0, 0.0]]))
    kernel = {"law": "constant_kernel", "agglomeration_coefficient": 2e-13}
    bed = registry.find("streams.agglomerator")(agglomeration_kernel=kernel, holdup_mass=20.0, volume=0.5)
    assert "The steady sizes in the agglomerator were not found" in refused({"bed": bed}, feed, {"feed": ("", "bed")})
