"""What the chapters of the handbook state is what the program calculates."""

from __future__ import annotations

import ast
import re
import sys
from collections import Counter
from pathlib import Path
from typing import Any

import pytest

from granum.app.reading import as_html
from granum.core.i18n import language
from granum.reports.stated import STATED, in_french_print, printed_number, stated_number

FIGURE = re.compile(r"^\[\[figure (\w+)\]\]$", re.MULTILINE)
DOCS = Path(__file__).parents[2] / "docs"


DOMAINS = sorted(place.stem for place in (DOCS / "handbook").glob("*.py"))


@pytest.fixture
def chapters(monkeypatch: pytest.MonkeyPatch) -> Any:
    """The calculations, which take what the documentation built from the same content has kept."""
    monkeypatch.syspath_prepend(str(DOCS))
    import chapters

    yield chapters
    sys.modules.pop("chapters")


@pytest.mark.parametrize("domain", DOMAINS)
def test_both_languages_state_the_same(domain: str, chapters: Any) -> None:
    said = [sorted(m[1] for m in STATED.finditer(chapters.chapter_text(domain, c))) for c in ("en", "fr")]
    assert said[0] == said[1]


@pytest.mark.parametrize("domain", DOMAINS)
def test_what_is_stated_is_calculated_in_one_place(domain: str, chapters: Any) -> None:
    """A name given twice would state what was meant for another section."""
    given = Counter(
        name.id
        for statement in ast.parse((DOCS / "handbook" / f"{domain}.py").read_text(encoding="utf-8")).body
        if isinstance(statement, ast.Assign | ast.AnnAssign)
        for target in (statement.targets if isinstance(statement, ast.Assign) else [statement.target])
        for name in ast.walk(target)
        if isinstance(name, ast.Name)
    )
    stated = {m[1] for m in STATED.finditer(chapters.chapter_text(domain, "en"))}
    asked = {name.id for text in stated for name in ast.walk(ast.parse(text)) if isinstance(name, ast.Name)}
    assert not [name for name in asked if given[name] > 1]


@pytest.mark.long  # the strict build of the documentation asks the same of every chapter
@pytest.mark.parametrize("domain", DOMAINS)
def test_chapters_state_what_is_calculated(domain: str, chapters: Any) -> None:
    for code in ("en", "fr"):
        assert chapters.moved(domain, code) == []


def test_a_result_that_moved_is_told(chapters: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(chapters, "chapter_text", lambda *_: "about {{voids = 0.39}} of it")
    assert "voids = 0.39" in chapters.moved("filtration", "en")[0]


def test_figures_are_drawn_and_kept(chapters: Any, monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setattr(chapters, "KEPT", tmp_path)
    for code in ("en", "fr"):
        for name in FIGURE.findall(chapters.chapter_text("settling", code)):
            first = chapters.figure("settling", name, code)
            assert '"data"' in first
            assert first == chapters.figure("settling", name, code)


@pytest.mark.parametrize("domain", DOMAINS)
def test_both_languages_show_the_same_figures(domain: str, chapters: Any) -> None:
    shown = [FIGURE.findall(chapters.chapter_text(domain, code)) for code in ("en", "fr")]
    assert shown[0] == shown[1]
    assert all(f"def figure_{name}(" in (DOCS / "handbook" / f"{domain}.py").read_text() for name in shown[0])


def test_a_number_is_printed_as_its_language_does() -> None:
    assert printed_number("12345.6 kg/m^3") == "12\u202f345.6\u00a0kg/m³"
    with language("fr"):
        assert printed_number("0,5 %") == "0,5\u00a0%"
    assert stated_number("1,86e11 m/kg").step == 1e9


@pytest.mark.parametrize("name", ["handbook/filtration", "fr/manuel/filtration"])
def test_a_chapter_is_read_in_the_app(name: str) -> None:
    shown = as_html(name)["html"]
    assert "{{" not in shown
    assert "<math" in shown
    assert "#/find/filtration.leaf_test" in shown


def test_french_print_leaves_code_equations_and_links_alone() -> None:
    written = (
        "Qu'est-ce : « oui » ? `f'x : 1`\n\n| a | b |\n| :-- | --: |\n\n$x : y$ [l'eau](card:l'x : y) "
        "{{d['a'] = 1 m}} !"
    )
    shown = in_french_print(written).replace("\u00a0", "~")
    assert shown == (
        "Qu’est-ce~: «~oui~»~? `f'x : 1`\n\n| a | b |\n| :-- | --: |\n\n$x : y$ [l’eau](card:l'x : y) "
        "{{d['a'] = 1 m}}~!"
    )
