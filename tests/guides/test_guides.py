"""Who follows a guide from an empty folder sees what the guide shows, in both languages."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from pathlib import Path

import nbformat
import pytest
from tests.sharing.places import EXAMPLES, ROOT
from tests.sharing.transcripts import Reader, blocks, commands, told_but_not_shown

from granum.app.reading import as_html
from granum.core import registry

GUIDES = {
    "guides/line-with-recycle": "fr/ligne-a-recyclage",
    "guides/reading-the-audit": "fr/lire-l-audit",
    "guides/lab-to-plant": "fr/du-laboratoire-a-l-usine",
    "guides/fitting-honestly": "fr/ajuster-honnetement",
    "guides/uncertainty-to-decision": "fr/de-l-incertitude-a-la-decision",
    "guides/in-the-notebook": "fr/dans-un-carnet",
    "guides/in-a-spreadsheet": "fr/dans-un-tableur",
    "guides/in-a-plant": "fr/dans-une-usine",
    "guides/in-a-class": "fr/en-classe",
    "guides/laws-of-your-own": "fr/lois-personnelles",
}
# long ones whose English twins show the same
TWINS = (
    "fr/du-laboratoire-a-l-usine",
    "fr/dans-une-usine",
    "fr/lire-l-audit",
    "fr/de-l-incertitude-a-la-decision",
    "fr/ligne-a-recyclage",
)
PAGES = [(code, name) for pair in GUIDES.items() for code, name in zip(("en", "fr"), pair, strict=True)]


def text_of(name: str) -> str:
    return (ROOT / "docs" / f"{name}.md").read_text(encoding="utf-8")


@pytest.fixture(autouse=True)
def own_declarations_go() -> Iterator[None]:
    """What a guide declares is not there for whatever is tested after it."""
    yield
    sys.modules.pop("ours", None)
    registry._keys.clear()
    for known in (registry._declared, *registry._families.values()):
        for key in [key for key in known if key.startswith("user.")]:
            del known[key]


def followed(page: str, language: str, folder: Path, patch: pytest.MonkeyPatch) -> list[str]:
    patch.chdir(folder)
    patch.syspath_prepend(folder)  # as where Python is called from
    (folder / "examples").symlink_to(EXAMPLES)
    return Reader(folder, language).follow(page)


@pytest.mark.parametrize(
    ("language", "name"),
    [pytest.param(*page, marks=pytest.mark.long if page[1] in TWINS else (), id=page[1]) for page in PAGES],
)
def test_a_reader_sees_what_the_guide_shows(
    language: str, name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    wrong = followed(text_of(name), language, tmp_path, monkeypatch)
    assert not wrong, "\n\n".join(wrong)


@pytest.mark.parametrize("name", [name for _code, name in PAGES])
def test_numbers_of_the_prose_stand_in_what_is_shown(name: str) -> None:
    assert told_but_not_shown(text_of(name)) == []


@pytest.mark.parametrize("pair", GUIDES.items(), ids=GUIDES)
def test_both_languages_do_the_same(pair: tuple[str, str]) -> None:
    done = [
        [
            command
            for block in blocks(text_of(name))
            if block.form == "console"
            for command, _told in commands(block.text)
        ]
        for name in pair
    ]
    assert done[0] == done[1]
    counts = [sum(block.form == "python" for block in blocks(text_of(name))) for name in pair]
    assert counts[0] == counts[1]
    assert len(done[0]) + counts[0] > 2


@pytest.mark.parametrize("name", ["guides/in-the-notebook", "fr/dans-un-carnet"])
def test_a_guide_is_a_notebook_too(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.syspath_prepend(str(ROOT / "docs"))
    import notebooks

    assert name in notebooks.PAGES
    page = text_of(name)
    found = nbformat.from_dict(notebooks.notebook(page))
    nbformat.validate(found)
    code = ["".join(cell.source) for cell in found.cells if cell.cell_type == "code"]
    assert code == [block.text.strip() for block in blocks(page) if block.form == "python"]
    prose = "".join("".join(cell.source) for cell in found.cells if cell.cell_type == "markdown")
    assert "```" not in prose
    assert prose.startswith("# ")
    sys.modules.pop("notebooks")


@pytest.mark.parametrize("name", [name for _code, name in PAGES])
def test_a_guide_read_in_the_app_names_its_files(name: str) -> None:
    html = as_html(name)["html"]
    files = [block.title for block in blocks(text_of(name)) if block.title]
    assert [html.count(f"<strong><code>{file}</code></strong>") for file in set(files)] == [
        files.count(file) for file in set(files)
    ]


def test_a_guide_that_tells_wrongly_is_told(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    page = (
        "About 12.5 of it.\n```console\n$ granum list nothing_of_the_kind\nall is well\n$ echo $?\n0\n```\n"
    )
    assert "all is well" in followed(page, "en", tmp_path, monkeypatch)[0]
    assert told_but_not_shown(page) == ["12.5"]
