"""What the parser of TOML says has its French."""

from __future__ import annotations

import re
from importlib.resources import files
from pathlib import Path

import pytest

from granum.core.documents import read_toml
from granum.core.errors import InputError, reason_of
from granum.core.i18n import catalog, language

SAID = {
    text.encode().decode("unicode_escape")
    for text in re.findall(
        r'TOMLDecodeError\(\s*"([^"{}]+)"', (files("tomli") / "_parser.py").read_text(encoding="utf-8")
    )
}


def test_every_fixed_sentence_of_the_parser_has_french() -> None:
    plain = {text for text in SAID if not text.startswith(("Expected '=", "Expected ']"))}
    assert len(plain) > 8
    assert plain - set(catalog("fr")) == set()


@pytest.mark.parametrize(
    ("text", "french"),
    [
        ("[a]\n[a]", "a est déclaré deux fois (ligne 2, colonne 3)"),
        ("[x", "']' est attendu ici (fin du texte)"),
        ("a = ", "Valeur illisible (fin du texte)"),
        ("a = 1 2", "Une fin de ligne est attendue après une déclaration (ligne 1, colonne 7)"),
    ],
)
def test_a_misspelt_file_is_told_in_french(text: str, french: str) -> None:
    with language("fr"), pytest.raises(InputError) as told:
        read_toml(text)
    assert told.value.message == french


def test_the_system_speaks_french_too() -> None:
    with pytest.raises(FileNotFoundError) as told:
        Path("/nowhere/at/all").read_text()
    with language("fr"):
        assert reason_of(told.value) == "il n’existe pas"
