"""The site as a book: numbers of chapters, figures, equations and pages are those that stand there."""

from __future__ import annotations

import io
import sys
from pathlib import Path
from typing import Any
from unicodedata import normalize

import pytest
from pypdf import PdfReader

DOCS = Path(__file__).parents[2] / "docs"
FILLING = "<p>Much is said of other things before the next matter comes up in its turn.</p>" * 60

CYCLONES = f"""<html><body><nav>left out</nav><article>
<h1 id="cyclones">Cyclones<a class="headerlink" href="#cyclones">¶</a></h1>
<p>See <a href="settling.html#flux">there</a>, <a href="cards/cyclones.html">a card</a>.</p>{FILLING}
<h2 id="cut">1. The cut</h2><p>What a vortex finder does.</p>
<div class="equation"><math><mi>d</mi></math></div>
<div class="plot"></div><p><em>Grades of a cyclone.</em></p></article></body></html>"""
SETTLING = f"""<html><body><article>
<h1 id="settling">Settling</h1><p>Of hindered settling and a vortex finder.</p>{FILLING}
<h2 id="flux">The flux</h2><p>More.</p><div class="equation"><math><mi>J</mi></math></div>
<div class="equation"><math><mi>v</mi></math></div></article></body></html>"""
DRAWS = """document.querySelectorAll('.plot').forEach((place) => {
  place.innerHTML = '<svg class="main-svg"></svg>';
});"""


@pytest.fixture
def book(monkeypatch: pytest.MonkeyPatch) -> Any:
    monkeypatch.syspath_prepend(str(DOCS))
    import book

    yield book
    sys.modules.pop("book")


@pytest.fixture
def site(tmp_path: Path) -> Path:
    (tmp_path / "assets").mkdir()
    (tmp_path / "assets" / "plots.js").write_text(DRAWS)
    (tmp_path / "cyclones.html").write_text(CYCLONES)
    (tmp_path / "settling.html").write_text(SETTLING)
    return tmp_path


def test_numbers_in_the_book_are_those_of_its_pages(book: Any, site: Path) -> None:
    words = ["vortex finder", "hindered settling", "never used"]
    reader = PdfReader(io.BytesIO(book.book(site, ["cyclones.html", "settling.html"], words, "en")))
    # a font joins letters that a reader takes apart
    texts = [normalize("NFKC", page.extract_text()) for page in reader.pages]
    pages = [" ".join(text.split()) for text in texts]
    whole = " ".join(pages)
    assert "left out" not in whole
    assert "¶" not in whole

    def first(text: str) -> int:
        return next(i for i, page in enumerate(pages, 1) if i > 2 and text in page)

    contents = pages[1]
    for title in ("1 Cyclones", "1.1 The cut", "2 Settling", "2.1 The flux"):
        assert f"{title} {first(title)}" in contents
    assert first("1.1 The cut") > first("1 Cyclones")
    assert "Figure 1.1. Grades of a cyclone." in pages[first("1.1 The cut") - 1]
    assert all(number in whole for number in ("(1.1)", "(2.1)", "(2.2)"))
    index = pages[-1]
    assert f"vortex finder, {first('1.1 The cut')}, {first('2 Settling')}" in index
    assert f"hindered settling, {first('2 Settling')}" in index
    assert "never used" not in index
    outline = [entry.title for entry in reader.outline if not isinstance(entry, list)]
    assert any("Settling" in (title or "") for title in outline)


def test_both_books_hold_their_chapters_in_the_order_of_the_site(book: Any) -> None:
    english, french = book.chapters("en"), book.chapters("fr")
    assert english.index("handbook/particles.html") < english.index("handbook/drying.html")
    assert {page.rpartition("/")[2] for page in english if page.startswith("handbook/")} == {
        page.rpartition("/")[2] for page in french if page.startswith("fr/manuel/")
    }
    assert not any("index" in page and "theory" not in page for page in (*english, *french))
    assert "vitesse terminale" in " ".join(book.terms("fr"))


def test_without_a_browser_it_says_what_is_missing(book: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("shutil.which", lambda _name: None)
    with pytest.raises(SystemExit, match="chromium-driver"), book.chromium(book.PATIENCE):
        raise AssertionError
