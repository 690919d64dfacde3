"""Equipment of a solved line sized for what enters it there."""

from __future__ import annotations

import json

import numpy as np
import pytest

from granum.app.tasks import TASKS
from granum.app.telling import Tell
from granum.cases.reading import read_text
from granum.cases.resizing import resized
from granum.cases.sizing import _reached
from granum.core.errors import InputError
from granum.core.i18n import language

DUST = """
title = "Dust"
[mixture]
solids = ["quartz"]
gases = ["nitrogen"]
[mixture.sizes]
smallest = "0.1 um"
largest = "1 mm"
classes = 12
[feeds.smoke]
to = "heater"
gas_flow = "FLOW"
solid_flow = "20 kg/h"
temperature = "20 degC"
sizes = { law = "rosin_rammler", size_modulus = "20 um", distribution_exponent = 1.2 }
[streams.hot]
from = "heater"
to = "filter"
[units.heater]
model = "streams.heater"
temperature = "100 degC"
[units.filter]
model = "dust.bag_filter"
area = "100 m2"
"""
# of nitrogen as an ideal gas: 28.013 g/mol at 373.15 K and 101 325 Pa
VOLUME = 1.0 / 0.028013 * 8.31446 * 373.15 / 101325.0  # m³/kg


def test_a_filter_gets_the_area_of_the_gas_that_reaches_it() -> None:
    run = read_text(DUST.replace("FLOW", "2 kg/s"), name="dust").solve()
    found = resized(run, "filter", "1 m/min")
    assert found.value == pytest.approx(2.0 * VOLUME * 60.0, rel=1e-4)
    assert found.text("m2") == f"{float(f'{found.value:.4g}'):g} m2"
    assert found.before == 100.0
    with language("fr"):
        assert "100 m² → " in found.told()


def test_the_page_is_told_the_setting_in_the_unit_of_the_case_and_in_words() -> None:
    payload = {"case": DUST.replace("FLOW", "1 kg/s"), "unit": "filter", "wanted": ""}
    found = json.loads(TASKS["resize"](payload, Tell()))
    area, unit = found["text"].split()
    # as in the example alone: 20 t/h of moist air at 60 °C through 330 m², 1 m/min within some percent
    assert found["key"] == "area"
    assert unit == "m2"
    assert float(area) == pytest.approx(VOLUME * 60.0, rel=0.05)
    assert "m² → " in found["told"]


def test_nothing_is_sized_for_nothing() -> None:
    text = DUST.replace("FLOW", "1 kg/s").replace('to = "filter"', 'to = "split"') + (
        '[units.split]\nmodel = "streams.splitter"\nside_fraction = 0.0\n'
        '[streams.rest]\nfrom = "split.side"\nto = "filter"\n'
    )
    run = read_text(text, name="dust").solve()
    with pytest.raises(InputError, match="Nothing enters"):
        resized(run, "filter", "1 m/min")


def test_what_lies_just_before_a_machine_has_no_answer_is_reached() -> None:
    asked: list[int] = []

    def look(x: np.ndarray) -> np.ndarray:
        asked.append(x.size)
        return np.where(x < 5.3, 2.0 * x, np.nan)

    x = np.geomspace(0.1, 100.0, 31)  # 5.01 is the last of these with an answer, the next is 6.31
    for wanted, count in ((3.0, 1), (10.4, 2), (11.0, 2)):
        asked.clear()
        settings, found = _reached(look, x, wanted)
        assert len(asked) == count
        assert set(asked) == {x.size}
        assert np.all(np.diff(settings) > 0.0)
        assert found == pytest.approx(2.0 * settings)
        assert (found.max() >= wanted) == (wanted < 10.6)
