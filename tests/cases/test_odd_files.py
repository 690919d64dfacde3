"""Files no one writes by hand: one message, quickly. The costs are bounded by refusing before parsing, so no
time is asserted.
"""

from __future__ import annotations

import io
import zipfile

import numpy as np
import openpyxl
import pytest

from granum.cases.reading import parsed, read_text
from granum.core.errors import CaseError, InputError
from granum.core.i18n import language
from granum.core.kinds import KINDS
from granum.core.parameters import Parameter
from granum.estimation import tables

COLUMNS = [
    Parameter("time", KINDS["Time"], series="points"),
    Parameter("volume", KINDS["Volume"], series="points"),
]


@pytest.mark.parametrize(
    "text",
    [
        "a = " + "[" * 20_000 + "]" * 20_000,
        "a = " + "{a=" * 20_000 + "1" + "}" * 20_000,
        ".".join("a" * 500_000) + " = 1",
        "[" + ".".join(["'a'"] * 400_000) + "]",
        "a = " + "9" * 5000,
    ],
)
def test_a_case_beyond_reason_is_one_message(text: str) -> None:
    with pytest.raises(CaseError, match="not valid TOML") as found:
        parsed(text, "case.toml")
    assert len(found.value.message) < 200


def test_sentences_and_numbers_with_dots_are_no_deep_keys() -> None:
    text = "a = [" + ", ".join(["1.5"] * 200) + "]\nb = '" + "Stop. Go on. " * 100 + "'"
    assert len(parsed(text, "case.toml")["a"]) == 200


def workbook(rows: list[list[object]]) -> io.BytesIO:
    book = openpyxl.Workbook(write_only=True)
    sheet = book.create_sheet()
    for row in rows:
        sheet.append(row)
    file = io.BytesIO()
    book.save(file)
    file.seek(0)
    return file


def test_a_workbook_of_too_many_rows_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(tables, "MOST_ROWS", 50)
    rows = [["time [s]", "volume [L]"], *([float(i), 1.0] for i in range(49))]
    assert len(tables.read_table(workbook(rows), COLUMNS)["time"]) == 49
    with pytest.raises(InputError, match="more than 50 rows"):
        tables.read_table(workbook([*rows, [1.0, 1.0]]), COLUMNS)


def test_a_workbook_that_unpacks_to_very_much_is_refused() -> None:
    file = io.BytesIO()
    with zipfile.ZipFile(file, "w", zipfile.ZIP_DEFLATED) as packed:
        packed.writestr("xl/worksheets/sheet1.xml", b" " * (tables.LARGEST_UNPACKED + 1))
    file.seek(0)
    with pytest.raises(InputError, match="when unpacked"):
        tables.read_table(file, COLUMNS)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("time [s],volume [L]\n", "no row of values"),
        ("time [s],volume [L]\n1,\n2,\n", "Column 'volume' is empty"),
        ("time [s],volume [L]\n1,two\n", "'two' is not a number"),
        ("time [s],volume [L]\n1,true\n", "'true' is not a number"),
        ("time [s],volume [L]\n1,5 L\n", "'5 L' is not a number"),
    ],
)
def test_odd_tables_are_one_message(text: str, message: str) -> None:
    with pytest.raises(InputError, match=message):
        tables.read_table(io.StringIO(text), COLUMNS)
    with pytest.raises(InputError, match="not a number"):
        tables.read_table(workbook([["time [s]", "volume [L]"], [1.0, True]]), COLUMNS)


def test_cells_are_read_as_people_write_numbers() -> None:
    found = tables.read_table(io.StringIO("time [s];volume [L]\n1\u202f200,5;\u22120\n2e3;1,5\n"), COLUMNS)
    np.testing.assert_allclose(found["time"], [1200.5, 2000.0])
    np.testing.assert_allclose(found["volume"], [0.0, 1.5e-3])


@pytest.mark.parametrize(
    ("mixture", "english", "french"),
    [
        ('sizes = "zz"', "'mixture.sizes' = zz is not possible: it must be a table", "doit être une table"),
        ("sizes = { classes = 0 }", "it must be at least 1", "au moins égal à 1"),
        ("sizes = { classes = 2.5 }", "it must be a whole number", "un nombre entier"),
        ("sizes = { smallest = [1] }", "'mixture.sizes.smallest' = [1]", "un nombre avec son unité"),
        ('gases = "air"', "it must be a list", "une liste"),
        ("gases = [1]", "it must be a text", "un texte"),
        ("axes = { a = { boundaries = ['x'] } }", "it must be a number", "un nombre"),
    ],
)
def test_a_value_of_the_wrong_sort_is_told_in_words(mixture: str, english: str, french: str) -> None:
    case = f'title = "A"\n[mixture]\nliquids = ["water"]\n{mixture}\n'
    for code, words in (("en", english), ("fr", french)):
        with language(code), pytest.raises(CaseError) as refused:
            read_text(case)
        assert words in refused.value.message
        assert "Input should" not in refused.value.message


def test_so_is_that_of_a_substance_of_the_case() -> None:
    with pytest.raises(InputError, match="it must be a table"):
        read_text('title = "A"\n[mixture]\nliquids = ["water"]\nsolids = ["mud"]\n[solid]\nmud = 3\n')
