"""Other values of a line: text with units, figures of feeds, refusals."""

from __future__ import annotations

import numpy as np
import pytest
from tests.sharing.places import EXAMPLES

import granum as gr
from granum.core.errors import InputError


@pytest.fixture(scope="module")
def line():
    return gr.read(EXAMPLES / "filters" / "drum.toml")


def test_text_with_a_unit_is_the_number_in_si(line) -> None:
    told = line.with_values(**{"drum.rotation_speed": "0.4 rpm", "drum.area": "95000 cm2"}).sheet.units[
        "drum"
    ]
    assert told.rotation_speed == pytest.approx(0.4 * 2.0 * np.pi / 60.0)
    assert told.area == pytest.approx(9.5)
    assert line.sheet.units["drum"].area == 9.0  # as it was


def test_a_figure_of_a_feed_changes_what_it_amounts_to(line) -> None:
    more = {
        "slurry.solid_flow": "450 kg/h",
        "slurry.liquid.sodium chloride": 0.05,
        "slurry.temperature": "30 degC",
    }
    slurry, before = line.with_values(**more).sheet.feeds["slurry"], line.sheet.feeds["slurry"]
    assert float(slurry.solid_flow) == pytest.approx(0.125)
    np.testing.assert_allclose(slurry.size_fractions, before.size_fractions)
    assert float(slurry.liquid[1] / slurry.liquid_flow) == pytest.approx(0.05)
    assert float(slurry.liquid_flow) == pytest.approx(float(before.liquid_flow))
    assert float(slurry.temperature) == pytest.approx(303.15)
    twice = line.with_values(**{"slurry.solid": 2.0 * np.asarray(before.solid)}).sheet.feeds["slurry"]
    assert float(twice.solid_flow) == pytest.approx(2.0 * float(before.solid_flow))


@pytest.mark.parametrize(
    ("path", "value", "told"),
    [
        ("slurry.sold_flow", 1.0, "solid_flow"),
        ("drum.rotation_speed", "3 kg", "rotation_speed"),
        ("drum.rotation_speed", "0 rpm", "greater than 0"),
        ("wash_water.solid_flow", "1 kg/h", "carries no solid"),
        ("drums.area", 1.0, "drum"),
    ],
)
def test_what_does_not_exist_is_refused(line, path: str, value, told: str) -> None:
    with pytest.raises(InputError, match=told):
        line.with_values(**{path: value})
