"""Each card leads to the chapter that teaches its domain, and each chapter to the cards of its own."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from granum.app.shipped import pages
from granum.core.index import entries

DOCS = Path(__file__).parents[2] / "docs"
FOLDERS = {"handbook": "../cards/{}.md", "fr/manuel": "../../cards-fr/{}.md"}
DOMAINS = sorted({key.partition(".")[0] for key in entries()})
CARD = re.compile(r"\]\(card:([\w.]+)\)")
LEAST = 1500


@pytest.mark.parametrize("folder", FOLDERS)
@pytest.mark.parametrize("domain", DOMAINS)
def test_a_domain_has_a_chapter_that_leads_to_its_cards(domain: str, folder: str) -> None:
    name = f"{folder}/{domain}"
    assert name in pages()
    text = pages()[name].read_text(encoding="utf-8")
    assert FOLDERS[folder].format(domain) in text
    named = CARD.findall(text)
    assert set(named) <= set(entries())
    assert [key for key in named if key.startswith(f"{domain}.")]


@pytest.mark.parametrize("name", [n for n in pages() if n.startswith(tuple(FOLDERS))])
def test_a_chapter_is_long_enough_to_teach(name: str) -> None:
    """The handbook's own measure: fifteen hundred words at least."""
    assert len(pages()[name].read_text(encoding="utf-8").split()) >= LEAST


def test_both_languages_have_the_same_chapters() -> None:
    english, french = (
        {name.rpartition("/")[2] for name in pages() if name.startswith(folder)} for folder in FOLDERS
    )
    assert english == french


def test_chapters_stand_in_the_navigation() -> None:
    listed = (DOCS.parent / "mkdocs.yml").read_text(encoding="utf-8")
    assert [name for name in pages() if name.startswith(tuple(FOLDERS)) and f" {name}.md" not in listed] == []


MADE = re.compile(r"^\[\[(?:printed|figure|moving|code) .+\]\]$", re.MULTILINE)


@pytest.mark.parametrize("domain", DOMAINS)
def test_both_languages_show_the_same_that_is_made(domain: str) -> None:
    shown = [sorted(MADE.findall(pages()[f"{f}/{domain}"].read_text(encoding="utf-8"))) for f in FOLDERS]
    assert shown[0] == shown[1]
