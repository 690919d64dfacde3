"""Figures with sliders: one declaration, drawn beforehand and live."""

from __future__ import annotations

import json
import re
from math import log
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest

from granum.core.errors import InputError
from granum.core.i18n import language
from granum.reports.moving_figures import FIGURES, moving_figure

DOCS = Path(__file__).parents[2] / "docs"
ASKED = re.compile(r"^\[\[moving (\w+)\]\]$", re.MULTILINE)
LARGEST = 150_000  # bytes of the moving figures of a page


@pytest.fixture(scope="module")
def weights() -> dict[str, int]:
    """Bytes of each figure in English; a number that JSON lacks ends it."""
    return {
        name: len(json.dumps(moving.frames(), separators=(",", ":"), allow_nan=False))
        for name, moving in FIGURES.items()
    }


def test_pages_stay_light_and_show_the_same_in_both_languages(weights: dict[str, int]) -> None:
    shown = set()
    for page in sorted((DOCS / "handbook").glob("*.md")):
        names = ASKED.findall(page.read_text(encoding="utf-8"))
        assert names == ASKED.findall((DOCS / "fr" / "manuel" / page.name).read_text(encoding="utf-8"))
        assert sum(weights[name] for name in names) < LARGEST, page.name
        shown |= set(names)
    assert shown == set(FIGURES)


@pytest.mark.parametrize("name", FIGURES)
def test_every_slider_moves_its_figure(name: str) -> None:
    moving = FIGURES[name]
    start = moving.at()
    assert all("range" in start["layout"][axis] for axis in ("xaxis", "yaxis"))  # axes stand still
    for slider in moving.sliders:
        assert slider.start in slider.positions()
        assert slider.positions() == sorted(set(slider.positions()))
        assert moving.at({slider.name: slider.high})["data"] != start["data"]


@pytest.mark.parametrize("name", FIGURES)
def test_words_of_a_figure_are_in_french(name: str) -> None:
    def words() -> set[str]:
        drawn, told = FIGURES[name].at(), FIGURES[name].told()
        axes = {drawn["layout"][axis]["title"]["text"] for axis in ("xaxis", "yaxis")}
        return axes | {slider["label"] for slider in told}

    english = words()
    with language("fr"):
        french = words()
    assert not english & french


def test_frames_are_in_the_order_that_a_page_counts_them() -> None:
    moving = moving_figure("leaf")
    drawn = moving.frames()
    first, last = moving.sliders
    at = [3, 5]
    frame = drawn["frames"][at[0] * last.steps + at[1]]
    asked = moving.at({first.name: first.positions()[at[0]], last.name: last.positions()[at[1]]})
    assert frame["data"][0]["y"] == asked["data"][0]["y"]


def test_the_leaf_meets_its_intercept() -> None:
    """By hand, t/V at V = 0 is η R / (A Δp) = 8.937e-4 × 1.06e11 / (0.0439 × 338e3) = 6384 s/m³."""
    line = moving_figure("leaf").at()["data"][1]
    assert np.allclose(line["y"], 6.384, rtol=1e-3)


def test_half_of_the_mass_lies_below_the_marked_median() -> None:
    """The third moment of exp(−x) up to a: 1 − e^(−a)(1 + a + a²/2 + a³/6), which is one half."""
    point = moving_figure("population").at()["data"][1]
    a = -log(point["y"][0])
    assert 1 - np.exp(-a) * (1 + a + a**2 / 2 + a**3 / 6) == pytest.approx(0.5, abs=1e-3)


@pytest.mark.parametrize("value", [0, 1e9, "wide", None, float("nan")])
def test_what_lies_outside_the_slider_is_refused(value: object) -> None:
    with pytest.raises(InputError, match="drawn for numbers from 5 to 2000"):
        moving_figure("drag").at({"particle_diameter": value})
    with pytest.raises(InputError, match="does not slide"):
        moving_figure("drag").at({"width": 1.0})


@pytest.mark.parametrize("name", FIGURES)
def test_a_picture_needs_no_script(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.syspath_prepend(str(DOCS))
    from stills import picture

    drawn = FIGURES[name].at()
    root = ElementTree.fromstring(picture(drawn))
    lines = [part.get("points", "") for part in root.iter("polyline")]
    assert len(lines) == sum("lines" in trace["mode"] for trace in drawn["data"])
    assert len(list(root.iter("text"))) > 6
    assert all("nan" not in line for line in lines)
