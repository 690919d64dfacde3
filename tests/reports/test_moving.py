"""Figures with sliders: one declaration, drawn beforehand and live."""

from __future__ import annotations

import json
import re
from math import log
from pathlib import Path
from statistics import NormalDist
from typing import Any
from xml.etree import ElementTree

import numpy as np
import pytest

import granum as gr
from granum.app.wording import told
from granum.core.charts import add_line, figure
from granum.core.errors import InputError
from granum.core.i18n import language
from granum.reports.moving import thin
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


@pytest.mark.long
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


def test_the_plateau_of_a_floating_bed_is_its_weight() -> None:
    """By hand, a meter at a void fraction of 0.5: 0.5 × (2600 − 1.2) × 9.80665 = 12 743 Pa."""
    rising, falling, first, _transport = moving_figure("fluidization").at()["data"]
    assert first["y"][0] == pytest.approx(12.743, rel=1e-3)
    assert rising["y"][-1] == falling["y"][-1] == first["y"][0]
    assert 1.05 * first["y"][0] < max(rising["y"]) <= 1.1 * first["y"][0]  # it sticks before it lets go


def test_seeds_without_births_end_where_the_cube_root_rule_says() -> None:
    """Solubility 0.1286 + 5.88e-3 t + 1.721e-4 t² leaves 64.8 g/kg between 32 and 28 °C by hand; on 8 g/kg of
    100 µm that makes 100 (1 + 64.8/8)^(1/3) = 209 µm.
    """
    drawn = moving_figure("batch").at({"seed_mass_per_solvent": 8.0})["data"]
    (start, _a, _b, _c, end) = (
        {x: y for x, y in zip(trace["x"], trace["y"], strict=True) if x is not None} for trace in drawn
    )
    assert 88 < min(start) < max(start) < 112  # 100 ± 10 µm, in classes of some 1.5 µm
    assert max(end, key=lambda x: end[x]) == pytest.approx(209, rel=0.02)


@pytest.mark.parametrize("returned", [0.5, 0.76])
def test_a_recycle_forgets_by_the_share_that_returns(returned: float) -> None:
    plain, learning = moving_figure("recycle").at({"returned_fraction": returned})["data"]
    assert np.allclose(plain["y"][:10], returned ** np.array(plain["x"][:10]), rtol=1e-3)
    assert sum(y is not None and y > 1e-10 for y in learning["y"]) < sum(y > 1e-10 for y in plain["y"] if y)


def test_spreading_is_that_of_draws_and_of_the_slope() -> None:
    """A fifth of 85 µm: draws of another generator, and a difference quotient in place of the derivative."""

    def fall(size: Any) -> Any:
        return np.asarray(gr.particles.terminal_velocity(size, 2630.0, 1020.0, 1.2e-3))

    *_lines, points = moving_figure("spreading").at({"standard_deviation": 17.0, "time": 10.0})["data"]
    spread = np.sqrt(np.log(1 + 0.2**2))
    draws = np.random.default_rng(1).lognormal(np.log(85e-6) - spread**2 / 2, spread, 200_000)
    assert points["y"][0] == pytest.approx(100 * np.mean(fall(draws) < 1.5 / 600), abs=0.15)
    slope = (fall(86e-6) - fall(84e-6)) / 2e-6
    below = NormalDist(float(fall(85e-6)), float(slope) * 17e-6).cdf(1.5 / 600)
    assert points["y"][1] == pytest.approx(100 * below, rel=2e-3)


@pytest.mark.parametrize("inlet", [50.0, 120.0])
def test_air_keeps_its_enthalpy_in_the_dryer(inlet: float) -> None:
    """With the usual constants, h = 1.006 t + w (2501 + 1.86 t) kJ/kg; the heater keeps the humidity."""
    *_lines, points = moving_figure("dryer_air").at({"temperature_inlet": inlet})["data"]
    fresh, hot, out = zip(points["x"], points["y"], strict=True)
    assert (hot[0], hot[1]) == (inlet, fresh[1])
    enthalpy = [1.006 * t + 1e-3 * w * (2501 + 1.86 * t) for t, w in (hot, out)]
    assert enthalpy[1] == pytest.approx(enthalpy[0], rel=5e-3)


def test_the_rate_of_a_tray_falls_from_the_critical_moisture_on() -> None:
    """Beyond it the distance from equilibrium, 0.05, shrinks by the same share each hour."""
    _straight, curve, point = moving_figure("drying_curve").at()["data"]
    hours, moisture = np.array(curve["x"]), np.array(curve["y"])
    before, after = hours < point["x"][0], hours > point["x"][0] + 0.4
    assert np.ptp(np.diff(moisture[before])) < 1e-3
    shares = (moisture[after][1:10] - 0.05) / (moisture[after][:9] - 0.05)
    assert np.allclose(shares, shares[0], rtol=0.02)
    assert point["y"][0] == 0.157


def test_the_vial_of_the_literature_dries_in_its_time() -> None:
    """Shivkumar and others (2019): at 20 °C and 150 mTorr, a fill of 6.919 mm ends between 6.65 and 6.66 h
    with the product at −14.77 °C.
    """
    asked = {"temperature_shelf": 20.0, "pressure_chamber": 19.998, "frozen_height": 6.919}
    _shelf, below, front, quarters = moving_figure("freeze_drying").at(asked)["data"]
    assert front["x"][-1] == quarters["x"][-1] == pytest.approx(6.655, abs=0.01)
    assert max(below["y"]) == pytest.approx(-14.77, abs=0.05)


def test_thinning_keeps_ends_and_jumps() -> None:
    x = np.linspace(0.0, 1.0, 200)
    drawn = figure("x", "y")
    add_line(drawn, x, x + np.where(x > 0.503, 5.0, 0.0), "")
    thin(drawn, 10)
    kept = drawn.data[0]
    assert len(kept.x) <= 12
    assert (kept.x[0], kept.x[-1]) == (0.0, 1.0)
    assert np.max(np.diff(kept.x)[np.diff(kept.y) > 4]) == pytest.approx(1 / 199)


def test_an_unknown_figure_is_told_by_the_names_of_figures() -> None:
    """The glossary says drag law and Area; a figure has neither name."""
    with pytest.raises(InputError) as refused:
        moving_figure("dragg")
    assert told(refused.value.as_json())["message"].endswith("Did you mean 'drag'?")
    with pytest.raises(InputError) as refused:
        moving_figure("area")
    assert "'area'" in told(refused.value.as_json())["message"]


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
