"""Both languages of the program and its documentation are spelled well: words that Debian's dictionaries of
American English and of French lack stand in ``spelling``, names of people and things in ``names.txt``, and
English has no common misspelling in comments either.
"""

from __future__ import annotations

import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from babel.messages.pofile import read_po

from granum.streams.names import french

ROOT = Path(__file__).parents[2]
READ = ("src/granum/**/*.py", "docs/*.md", "docs/guides/*.md", "docs/handbook/*", "docs/theory/*.md", "*.md")
LISTS = Path(__file__).with_name("spelling")
DICTIONARIES = {"english": "en_US", "french": "fr"}
NEEDS = "this test needs Debian's packages hunspell, hunspell-en-us and hunspell-fr"
CODE = (
    r"^```.*?^```",
    r"`[^`\n]*`",
    r"\$\$.*?\$\$",
    r"\$[^$\n]*\$",
    r"\{\{.*?\}\}",
    r"\[\[.*?\]\]",
    r"\]\([^)]*\)",  # where a link leads
    r"https?://\S+",
    r"<[^>]+>",
    r"\{[^}\n]*\}",
    r"\[[a-z_.]+\]",  # a table of a case file
    r"--[\w-]+",
    r"(?<!\w)'[a-z_]+'",
    r"«\s[a-z_]+\s»",
    r"\w+_\w+",
    r"\w+(?:\.\w+)+",
    r"\w+=\S+",
    r"pip install \w+",
)
NO_PROSE = re.compile("|".join(CODE), re.MULTILINE | re.DOTALL)
QUOTED = re.compile(r"(?<!\*)\*([^*\n]+)\*(?!\*)|«([^»]+)»")  # titles and names may be of the other language
WORD = re.compile(r"[^\W\d_]+(?:['-][^\W\d_]+)*")
GREEK = re.compile("[α-ω]")
IN_DATA = {
    name: re.compile(rf'^(?:\w+\.)?{code} = "((?:[^"\\]|\\.)*)"|\b{code} = "((?:[^"\\]|\\.)*)"', re.MULTILINE)
    for name, code in (("english", "en"), ("french", "fr"))
}

IN_PAGE = re.compile(r"""^ *(['"`])(.*?)\1:\s*(?:\n\s*)?(['"`])(.*?)\3,?$""", re.MULTILINE)


def misspelled(places: list[Path]) -> str:
    """What codespell finds, a line each."""
    asked = [sys.executable, "-m", "codespell_lib", "-q", "2", "-I", LISTS / "looks_wrong.txt", *places]
    return subprocess.run(asked, capture_output=True, text=True, check=False).stdout


def not_in_dictionary(words: set[str], tongue: str) -> set[str]:
    """Those of the words that Hunspell does not know."""
    if not shutil.which("hunspell"):
        pytest.fail(NEEDS)
    asked = ["hunspell", "-d", DICTIONARIES[tongue], "-i", "UTF-8", "-l"]
    given = "\n".join(sorted(words))
    found = subprocess.run(asked, input=given, capture_output=True, text=True, check=True).stdout
    return set(found.splitlines())


def listed(tongue: str) -> set[str]:
    """Words of the field and names."""
    places = (LISTS / f"{tongue}.txt", LISTS / "names.txt")
    return {line.casefold() for place in places for line in place.read_text(encoding="utf-8").split()}


def words_of(text: str) -> set[str]:
    """Words of a text that are neither a symbol nor an abbreviation."""
    return {
        word for word in WORD.findall(text) if len(word) > 2 and word[1:].islower() and not GREEK.search(word)
    }


def unknown(text: str, tongue: str) -> list[str]:
    """Words of a text that no dictionary and no list has."""
    text = NO_PROSE.sub(" ", text).replace("’", "'")
    other = "english" if tongue == "french" else "french"
    quoted = words_of(" ".join("".join(groups) for groups in QUOTED.findall(text)))
    doubted = not_in_dictionary(words_of(QUOTED.sub(" ", text)), tongue)
    doubted |= not_in_dictionary(not_in_dictionary(quoted, tongue), other)
    known = listed(tongue)
    ending = (
        (lambda w: re.sub(r"^\w{1,2}'", "", w)) if tongue == "french" else (lambda w: w.removesuffix("'s"))
    )
    bare = {ending(word) for word in doubted}
    parts = {part for word in bare for part in (word.split("-") if word.casefold() not in known else [])}
    return sorted(w for w in not_in_dictionary(parts, tongue) if len(w) > 2 and w.casefold() not in known)


def texts(tongue: str) -> str:
    """The documentation, the messages and the words of data in a language."""
    if tongue == "french":
        pages = [*ROOT.glob("docs/fr/**/*.md"), *ROOT.glob("*.fr.md")]
    else:
        pages = [
            p for pattern in READ for p in ROOT.glob(pattern) if p.suffix == ".md" and ".fr." not in p.name
        ]
    parts = [page.read_text(encoding="utf-8") for page in pages]
    for place in ROOT.glob("src/granum/locale/fr/*.po"):
        with place.open("rb") as file:
            messages = [m for m in read_po(file, locale="fr") if m.id]
        for m in messages:
            said = m.string if tongue == "french" else m.id
            parts += [said] if isinstance(said, str) else said
    pairs = IN_PAGE.findall((ROOT / "src/granum/app/static/strings.fr.js").read_text(encoding="utf-8"))
    assert len(pairs) > 400
    parts += [pair[3 if tongue == "french" else 1].replace("\\'", "'") for pair in pairs]
    for place in ROOT.glob("src/granum/**/*.toml"):
        found = IN_DATA[tongue].findall(place.read_text(encoding="utf-8"))
        parts += ["".join(groups).replace('\\"', '"') for groups in found]
    if tongue == "french":
        parts += french().values()
    return "\n\n".join(parts)


@pytest.mark.parametrize("tongue", DICTIONARIES)
def test_every_word_is_in_a_dictionary(tongue: str) -> None:
    text = texts(tongue)
    assert len(words_of(text)) > 5000
    assert unknown(text, tongue) == []


@pytest.mark.parametrize("tongue", DICTIONARIES)
def test_the_lists_hold_what_dictionaries_lack(tongue: str) -> None:
    """A word that a dictionary has, or that is nowhere used, would hide a slip one day."""
    words = (LISTS / f"{tongue}.txt").read_text(encoding="utf-8").split()
    assert words == sorted(set(words))
    assert not_in_dictionary(set(words), tongue) == set(words)


@pytest.mark.parametrize(
    ("tongue", "slip", "named"),
    [
        ("english", "The colour of the seperation", ["colour", "seperation"]),
        ("french", "Le débit d'une séparration n'est pas $xq$ `xq`", ["séparration"]),
        ("french", "Perry, *Handbook of Engineering*, et le filter", ["filter"]),
        ("english", "Geldart's powder at 3 kPa, well-fluidisd", ["fluidisd"]),
    ],
)
def test_a_slip_is_named(tongue: str, slip: str, named: list[str]) -> None:
    assert unknown(slip, tongue) == named


def test_comments_have_no_common_misspelling() -> None:
    places = sorted(
        {p for pattern in READ for p in ROOT.glob(pattern) if ".fr." not in p.name and p.is_file()}
    )
    assert len(places) > 100
    assert misspelled(places) == ""


def test_a_common_misspelling_is_found(tmp_path: Path) -> None:
    slip = tmp_path / "slip.md"
    slip.write_text("The seperation of particles", encoding="utf-8")
    assert "separation" in misspelled([slip])
