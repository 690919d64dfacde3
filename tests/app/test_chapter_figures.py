"""Chapters of the handbook in the app have the figures and the code of the documentation."""

from __future__ import annotations

import re
from pathlib import Path

import httpx
import pytest
from tests.app.browsing import Page

from granum.app import chapters
from granum.app.chapters import chapter_figure
from granum.app.reading import as_html
from granum.app.shipped import chapter_calculations, chapter_code, pages
from granum.core.errors import InputError

CHAPTERS = [name for name in pages() if name.startswith(("handbook/", "fr/manuel/"))]
ASKED = re.compile(r"^\[\[(figure|code) (\w+)\]\]$", re.MULTILINE)


@pytest.mark.parametrize("name", CHAPTERS)
def test_each_figure_has_its_place_and_its_caption(name: str) -> None:
    shown, domain = as_html(name)["html"], name.rpartition("/")[2]
    asked = ASKED.findall(pages()[name].read_text(encoding="utf-8"))
    code = "fr" if name.startswith("fr/") else "en"
    places = re.findall(r'<div data-drawn="([^"]+)"></div>\s*<p><em>', shown)
    assert places == [f"{code}/{domain}/{figure}" for sort, figure in asked if sort == "figure"]
    assert shown.count('class="language-python"') >= sum(sort == "code" for sort, _name in asked)
    assert not re.search("[\ue000-\uf8ff]", shown)


def test_what_is_shown_as_code_stands_in_the_calculations() -> None:
    shown = chapter_code("filtration", "leaf")
    assert shown in chapter_calculations()["filtration"].read_text(encoding="utf-8")
    assert "# ---- " not in shown


def test_a_figure_speaks_the_language_of_its_chapter() -> None:
    english, french = (chapter_figure("porous", "voids", code) for code in ("en", "fr"))
    assert english.layout.xaxis.title.text != french.layout.xaxis.title.text
    assert french.layout.separators == ",\u202f"
    assert len(english.data) == len(french.data) > 0


@pytest.mark.parametrize(("domain", "name"), [("porus", "voids"), ("porous", "void"), ("../x", "voids")])
def test_an_unknown_figure_is_told_by_those_there_are(domain: str, name: str) -> None:
    with pytest.raises(InputError, match=r"Did you mean|Known names"):
        chapter_figure(domain, name, "en")


def test_the_server_draws_it_or_says_what_there_is(address: str) -> None:
    with httpx.Client(base_url=address, timeout=300.0) as client:
        drawn = client.get("/api/chapters/fr/porous/voids")
        assert drawn.json()["layout"]["separators"] == ",\u202f"
        for place, meant in (("fr/porous/void", "voids"), ("fr/porus/voids", "porous")):
            refused = client.get(f"/api/chapters/{place}")
            assert 400 <= refused.status_code < 500
            assert f"'{meant}'" in refused.json()["error"]["message"]
        assert client.get("/api/chapters/de/porous/voids").status_code == 422


def test_what_the_package_ships_is_enough_to_draw() -> None:
    """The folders that the calculations of chapters read are named where the wheel is declared."""
    declared = (Path(__file__).parents[2] / "pyproject.toml").read_text(encoding="utf-8")
    for place in ("docs/handbook", "docs/data", "docs/validation.py", "examples"):
        assert f'"{place}" = "granum/{place}"' in declared


def test_figures_are_drawn_as_they_come_into_sight(page: Page) -> None:
    page.open("read/handbook%2Fporous")
    first = page.one('[data-drawn="en/porous/regimes"]')
    last = page.all("[data-drawn]")[-1]
    assert not page.all(f'[data-drawn="{last.get_attribute("data-drawn")}"] .js-plotly-plot')
    page.browser.execute_script("arguments[0].scrollIntoView()", first)
    page.until(lambda: page.all('[data-drawn="en/porous/regimes"] .js-plotly-plot .main-svg'))
    page.check()


def test_the_calculations_of_a_chapter_say_how_far_they_are() -> None:
    told: list[float] = []
    chapters._known.pop("porous", None)
    chapter_figure("porous", "regimes", "en", told.append)
    assert len(told) > 10
    assert told == sorted(told)
    assert 0.0 <= told[0] < told[-1] < 1.0
    again = len(told)
    chapter_figure("porous", "regimes", "fr", told.append)
    assert len(told) == again  # they are kept


def test_a_figure_waits_for_what_it_needs_alone_and_is_the_same_after_the_whole_chapter() -> None:
    told: list[float] = []
    chapters._known.pop("porous", None)
    first = chapter_figure("porous", "voids", "en", told.append)
    assert len(told) < 10
    everything = chapters.calculated("porous")
    assert len([name for name in everything if name.startswith("figure_")]) > 3
    assert chapter_figure("porous", "voids", "en") == first


def test_what_is_changed_in_place_is_changed_before_it_is_drawn(tmp_path: Path) -> None:
    place = tmp_path / "docs" / "handbook" / "small.py"
    place.parent.mkdir(parents=True)
    place.write_text(
        "import json\nrows = []\nfor n in (1, 2):\n    rows.append(n)\nrows[0] = 5\nslow = 1 / 0\n"
        "def twice(x):\n    return 2 * x\nlast, other = rows[-1], 3\n"
        "def figure_it():\n    return twice(last), rows\n"
    )
    small = chapters.Calculations(place)
    assert small.figures == ["it"]
    assert small.run("figure_it")["figure_it"]() == (4, [5, 2])
    with pytest.raises(ZeroDivisionError):
        small.run()
