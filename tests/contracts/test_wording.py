"""What the program tells speaks the words of people: no Python, no sentence twice, French apostrophes."""

from __future__ import annotations

import re
from collections.abc import Iterator
from functools import cache
from pathlib import Path

import pytest
from tests.contracts.test_french import said

import granum
from granum.app.wording import page_words
from granum.core.i18n import catalog, language

STATIC = Path(granum.__file__).parent / "app" / "static"
CALLED = re.compile(r"""\bt\(\s*('(?:[^'\\]|\\.)*'|"(?:[^"\\]|\\.)*")""")
PAIR = re.compile(
    r"""^\s*('(?:[^'\\]|\\.)*'|"(?:[^"\\]|\\.)*"|\w+):\s*('(?:[^'\\]|\\.)*'|"(?:[^"\\]|\\.)*"),?$""",
    re.MULTILINE,
)
_ERRORS = "Errors: InputError for a value outside of its bounds."  # of ``help()``
IN_PYTHON = {_ERRORS, catalog("fr")[_ERRORS]}
PYTHON = re.compile(
    r"\b(?:None(?! of)|True|False|NaN|nan|dict|tuple|kwargs|ndarray|str|float)\b|\b[A-Z][a-z]+[A-Z]\w*"
)
SNAKE = re.compile(r"(?<![\w./\[`'\"{<=])[a-z][a-z0-9]*(?:_[a-z0-9]+)+(?![\w./\]`'\"}>=(])")


def bare(text: str) -> str:
    return text.strip("'\"").replace(r"\'", "'").replace(r"\"", '"').replace(r"\n", "\n")


def of_the_page() -> dict[str, str]:
    """Texts of the page with their French."""
    table = (STATIC / "strings.fr.js").read_text(encoding="utf-8")
    return {bare(en): bare(fr) for en, fr in PAIR.findall(table)}


def told() -> Iterator[str]:
    """Every message in both languages."""
    french = catalog("fr")
    for message in said():
        yield message
        yield french.get(message, "")
    yield from (text for pair in of_the_page().items() for text in pair)
    for place in STATIC.glob("*.js"):
        yield from map(bare, CALLED.findall(place.read_text(encoding="utf-8")))


@cache
def texts() -> list[str]:
    """Each of them once; looked for when a test asks, not whenever tests are collected."""
    return sorted({text for text in told() if text})


def without_code(text: str) -> str:
    """A message without its placeholders and what it says to type."""
    return re.sub(r"\{[^{}]*\}|`[^`]*`|'[^']*'|\"[^\"]*\"|«[^«»]*»|\[[^\[\]]*\]", "·", text)


def test_all_are_walked() -> None:
    assert len(of_the_page()) > 300
    assert len(texts()) > 2000


def test_no_message_names_what_only_python_knows() -> None:
    found = {
        text: m[0] for text in texts() if text not in IN_PYTHON and (m := PYTHON.search(without_code(text)))
    }
    assert not found


def test_no_message_holds_an_identifier() -> None:
    found = {text: m[0] for text in texts() if " " in text and (m := SNAKE.search(without_code(text)))}
    assert not found


@pytest.mark.parametrize(
    "text", ["The value is None.", "terminal_velocity is negative", "A LeafTest is needed"]
)
def test_a_name_of_python_would_be_seen(text: str) -> None:
    assert PYTHON.search(without_code(text)) or SNAKE.search(without_code(text))


def test_no_message_says_a_sentence_or_a_word_twice() -> None:
    twice = []
    for text in texts():
        sentences = [s.strip().lower() for s in re.split(r"(?<=[.!?:;])\s+", text) if len(s.split()) > 2]
        words = re.search(r"\b([^\W\d_]{2,})\s+\1\b", text, re.IGNORECASE)
        if len(set(sentences)) < len(sentences) or (words and words[1].lower() not in ("nous", "vous")):
            twice.append(text)
    assert not twice


def test_french_of_the_page_and_of_the_program_has_its_apostrophe() -> None:
    french = {**{m: catalog("fr").get(m, "") for m in said()}, **of_the_page()}
    wrong = [text for text in french.values() if re.search(r"[^\W\d_]'[^\W\d_]", text)]
    assert not wrong


def test_a_page_names_the_unit_of_a_message_once_and_in_words() -> None:
    """A machine alone bears the name of its model, which stands in the message anyway."""
    said = "thickness ('thickness') = −3 mm is not possible for drying.{key}: it must be above 0 mm."
    alone = page_words("[units.vacuum_shelf_dryer] " + said.format(key="vacuum_shelf_dryer"))
    assert alone.startswith("Thickness = −3 mm is not possible for Vacuum shelf dryer")
    with language("fr"):
        assert page_words("[units.dryer_2] " + said.format(key="tray_dryer")).startswith("Séchoir 2 : ")
