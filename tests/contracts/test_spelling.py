"""English of the program and its documentation has no common misspelling; words of the field that look
like one stand in ``words_of_the_field.txt``.
"""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).parents[2]
READ = ("src/granum/**/*.py", "docs/*.md", "docs/guides/*.md", "docs/handbook/*", "docs/theory/*.md", "*.md")
WORDS = Path(__file__).with_name("words_of_the_field.txt")


def misspelled(places: list[Path]) -> str:
    """What codespell finds, a line each."""
    asked = [sys.executable, "-m", "codespell_lib", "-q", "2", "-I", WORDS, *places]
    return subprocess.run(asked, capture_output=True, text=True, check=False).stdout


def test_english_is_spelled_well() -> None:
    places = sorted(
        {p for pattern in READ for p in ROOT.glob(pattern) if ".fr." not in p.name and p.is_file()}
    )
    assert len(places) > 100
    assert misspelled(places) == ""


def test_a_slip_is_found(tmp_path: Path) -> None:
    slip = tmp_path / "slip.md"
    slip.write_text("The seperation of particles", encoding="utf-8")
    assert "separation" in misspelled([slip])
