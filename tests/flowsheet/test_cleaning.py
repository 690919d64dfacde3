"""A train of collectors: what it catches of each size, and where each size goes in a line."""

from __future__ import annotations

import numpy as np
import pytest

from granum.cases.reading import read_text

TRAIN = """
title = "Two cyclones, a fan and bags"
[mixture]
liquids = ["water"]
solids = ["starch"]
gases = ["dry air", "water"]
sizes = { smallest = "0.5 um", largest = "200 um", classes = 16 }
[feeds.dusty]
to = "first.feed"
temperature = "60 degC"
gas_flow = "10000 kg/h"
gas = { "dry air" = 0.98, water = 0.02 }
solid_flow = "200 kg/h"
sizes = { law = "rosin_rammler", size_modulus = "30 um", distribution_exponent = 1.2 }
[units.first]
model = "cyclones.gas_cyclone"
diameter = "0.9 m"
[units.fan]
model = "streams.fan"
pressure_rise = "2 kPa"
[units.second]
model = "cyclones.gas_cyclone"
diameter = "0.8 m"
[streams]
dust = ["first.dust"]
a = ["first.gas", "fan.feed"]
b = ["fan.product", "second.feed"]
"""


def test_two_cyclones_catch_what_both_leave_of_each_other() -> None:
    """By hand from the streams: 1 - (1 - E1)(1 - E2), never less than the first alone."""
    run = read_text(TRAIN).solve()
    drawn = run.charts()
    (heading,) = [h for h in drawn if "catch together" in h]
    assert heading.startswith("first, second · ")
    first, both = drawn[heading].data
    into, between, out = (np.asarray(run.streams[n].solid_by_size) for n in ("dusty", "a", "second.gas"))
    some = into > 1e-9 * into.sum()
    alone = 1 - between[some] / into[some]
    second = 1 - out[some] / np.asarray(run.streams["b"].solid_by_size)[some]
    np.testing.assert_allclose(np.asarray(first.y), 100 * alone, rtol=1e-9)
    np.testing.assert_allclose(np.asarray(both.y), 100 * (1 - (1 - alone) * (1 - second)), rtol=1e-9)
    assert (np.asarray(both.y) >= np.asarray(first.y) - 1e-9).all()


def test_where_each_size_goes_is_drawn_in_a_line_too() -> None:
    """It had been left out wherever an outlet led to another unit."""
    drawn = read_text(TRAIN).solve().charts()
    assert {"first · Where each size goes", "second · Where each size goes"} <= set(drawn)


def test_one_collector_is_no_train() -> None:
    text = TRAIN[: TRAIN.index("[units.second]")] + '[streams]\na = ["first.gas", "fan.feed"]\n'
    drawn = read_text(text).solve().charts()
    assert not [h for h in drawn if "together" in h]
    assert [h for h in drawn if h.startswith("first")]


@pytest.mark.parametrize("language", ["en", "fr"])
def test_the_report_has_it(language: str) -> None:
    from granum.core.i18n import language as speaking
    from granum.reports.html import line_report

    run = read_text(TRAIN).solve()
    with speaking(language):
        page = line_report(run)
    assert {"en": "What the collectors catch together", "fr": "Ce que retiennent"}[language] in page
