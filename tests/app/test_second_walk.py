"""What a second walk through the page found."""

from __future__ import annotations

import re
from typing import Any

import httpx

from granum.app.exercises import listing
from granum.app.reading import as_html
from granum.app.server import create_app
from granum.core.i18n import language
from granum.core.registry import DOMAINS


def test_each_example_stands_in_one_domain_or_among_the_lines_of_several(serve: Any) -> None:
    with serve(create_app()) as address:
        shipped = httpx.get(f"{address}/api/examples").json()
    assert set(shipped["domains"]) == set(shipped["files"])
    assert set(shipped["domains"].values()) <= {"", *DOMAINS}
    assert shipped["domains"]["potassium-nitrate/line.toml"] == ""
    assert shipped["domains"]["dryers/drum.toml"] == "drying"


def test_a_chapter_keeps_each_caption_below_its_figure() -> None:
    for name in ("handbook/porous", "fr/manuel/porous"):
        shown = as_html(name)["html"]
        assert "[[" not in shown
        captions = shown.count("<p><em>")
        assert captions > 1
        assert len(re.findall(r'data-(?:drawn|moving)="[^"]+"></div>\s*<p><em>', shown)) == captions


def test_exercises_in_french_have_the_apostrophe_of_print() -> None:
    with language("fr"):
        told: Any = listing()
    titles = [e["title"] for domain in told["domains"] for e in domain["exercises"]]
    assert "Longueur d’un bassin" in titles
    assert not [title for title in titles if "'" in title]
