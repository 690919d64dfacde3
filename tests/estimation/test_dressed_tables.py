"""Known numbers in any dress of a data file: read as they are, or refused in one sentence; never another
number.

``GRANUM_RANDOM_SAMPLES=10000 pytest -n 0 tests/estimation/test_dressed_tables.py`` is the long search.
"""

from __future__ import annotations

import io

import numpy as np
import pytest
from tests.sharing.samples import SAMPLES

from granum.core.errors import GranumError, InputError
from granum.drying.lab_tests.isotherm import IsothermTest
from granum.estimation import read_table
from granum.estimation.tables import as_csv
from granum.filtration.lab_tests.leaf_test import LeafTest
from granum.particles.lab_tests.sieve_analysis import SieveAnalysis
from granum.settling.lab_tests.coe_clevenger_series import CoeClevengerSeries

FILES = max(300, SAMPLES)
COLUMNS = [p for p in LeafTest.card.parameters if p.series]
SPOILED = [
    "",
    "NaN",
    "inf",
    "-",
    "n/a",
    "#N/A",
    "#DIV/0!",
    "1.2.3",
    "12 min",
    "-5",
    "1e999",
    "<3",
    "True",
    "12%",
    "0x10",
    "12:30",
    "?",
]
"""Cells that hold no number that a time or a volume may be."""


def dressed(rng: np.random.Generator) -> tuple[bytes, np.ndarray, np.ndarray, bool]:
    """A file, its times in seconds and volumes in cubic meters, and whether one of its cells is spoiled."""
    count = int(rng.integers(1, 9))
    digits = int(rng.integers(0, 5))
    written = [np.round(10.0 ** rng.uniform(-1, 4, count), digits) for _column in range(2)]
    separator = str(rng.choice([",", ";", "\t"]))
    mark = str(rng.choice([".", ","]))
    thousands = str(rng.choice(["", "", ".", ",", "\u202f", " "]))
    if thousands == mark:
        thousands = ""
    # a column of which every number looks like 1,200 says nothing about its marks
    if thousands in (".", ","):
        for column in written:
            column[0] = 7.0

    def number(value: float) -> str:
        text = (
            f"{value:,.{digits}f}"
            if rng.random() < 0.5 or digits == 0
            else f"{value:,.{digits}f}".rstrip("0").rstrip(".")
        )
        text = text.translate(str.maketrans({",": thousands, ".": mark}))
        return f'"{text}"' if separator in text and rng.random() < 0.7 else text

    unit, scale = [("min", 60.0), ("s", 1.0), ("hour", 3600.0)][int(rng.integers(3))]
    style = ["{} [{}]", "{} ({})", "{} / {}"][int(rng.integers(3))]
    heads = [style.format("time", unit), style.format("filtrate_volume", "L")]
    rows = [[number(a), number(b)] for a, b in zip(*written, strict=True)]
    spoiled = rng.random() < 0.3
    if spoiled:
        rows[int(rng.integers(count))][int(rng.integers(2))] = str(rng.choice(SPOILED))
    if rng.random() < 0.5:
        heads, rows = heads[::-1], [row[::-1] for row in rows]
    if rng.random() < 0.3:
        heads, rows = [*heads, "note"], [[*row, "x"] for row in rows]
    if rng.random() < 0.2:
        heads, rows = [*heads, "", ""], [[*row, "", ""] for row in rows]
    lines = [separator.join(cells) for cells in (heads, *rows)]
    for _line in range(int(rng.integers(3))):
        lines.insert(int(rng.integers(len(lines) + 1)), str(rng.choice(["", "# said by hand", "  "])))
    text = str(rng.choice(["\n", "\r\n"])).join(lines)
    encoding = str(rng.choice(["utf-8", "utf-8-sig", "utf-16"]))
    return text.encode(encoding), scale * written[0], 1e-3 * written[1], spoiled


def test_a_dressed_table_is_read_as_it_is_or_refused() -> None:
    rng = np.random.default_rng(16)
    read = 0
    for _file in range(FILES):
        content, time, volume, spoiled = dressed(rng)
        for source in (content, None):
            try:
                found = read_table(
                    io.BytesIO(content) if source else io.StringIO(as_csv(io.BytesIO(content))), COLUMNS
                )
            except GranumError:
                continue
            assert not spoiled, content
            np.testing.assert_allclose(found["time"], time, rtol=1e-9, err_msg=repr(content))
            np.testing.assert_allclose(found["filtrate_volume"], volume, rtol=1e-9, err_msg=repr(content))
            read += 1
    assert read > FILES // 2


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("time [min],filtrate_volume [L]\n1,5,2,5\n2,5,3,5\n", "Line 2 has 4 cells, the header 2"),
        (
            'time [s],filtrate_volume [L]\n900,1.5\n"1,200",1.8\n',
            "Line 3, column 'time': '1,200' may be thousands or decimals",
        ),
        (
            "time [s];filtrate_volume [L]\n900;1,5\n1.200;1,8\n",
            "Line 3, column 'time': '1.200' may be thousands or decimals",
        ),
        (
            "time [s],filtrate_volume [L]\n900,1.5\n#N/A,1.8\n",
            "Line 3, column 'time': '#N/A' is not a number",
        ),
        ("time [],filtrate_volume [L]\n900,1.5\n", "'time' has no unit"),
    ],
)
def test_what_was_read_as_another_number_is_refused(text: str, words: str) -> None:
    with pytest.raises(InputError) as caught:
        read_table(io.StringIO(text), COLUMNS)
    assert words in caught.value.message


def test_decimal_commas_with_three_digits_are_decimals_where_the_column_shows_it() -> None:
    found = read_table(io.StringIO("time [s];filtrate_volume [L]\n1,125;2\n2,25;3\n"), COLUMNS)
    np.testing.assert_allclose(found["time"], [1.125, 2.25])


@pytest.mark.parametrize("separator", [";", "\t", ","])
@pytest.mark.parametrize(
    "titles", [["Leaf test"], ['"Leaf test, lot 12"', "Tuesday"], ["Leaf test{}{}", "", "Lot 7{}{}"]]
)
def test_titles_above_the_header_are_no_header(titles: list[str], separator: str) -> None:
    lines = [
        *(title.replace("{}", separator) for title in titles),
        "time [s];filtrate_volume [L]",
        "4;0.5",
        "9;1",
    ]
    text = "\n".join(
        [*lines[: len(titles)], *(line.replace(";", separator) for line in lines[len(titles) :])]
    )
    found = read_table(io.StringIO(text), COLUMNS)
    assert found["time"].tolist() == [4.0, 9.0]
    assert found["filtrate_volume"] == pytest.approx([5e-4, 1e-3])


def test_one_column_without_a_unit_keeps_its_name() -> None:
    (column,) = (p for p in IsothermTest.card.parameters if p.name == "water_activity")
    assert read_table(io.StringIO("water_activity\n0.1\n0.3\n"), [column])["water_activity"].tolist() == [
        0.1,
        0.3,
    ]


def test_a_laboratory_sheet_names_its_columns_by_symbols_or_parts(tmp_path):
    # Geankoplis (2003), example 14.2-1: 1.863e11 m/kg
    sheet = tmp_path / "leaf.csv"
    times = ["4.4", "9.5", "16.3", "24.6", "34.7", "46.1", "59", "73.6", "89.4", "107.3"]
    volumes = [".498", "1.0", "1.501", "2.0", "2.498", "3.002", "3.506", "4.004", "4.502", "5.009"]
    body = "\n".join(f"{t},{v}" for t, v in zip(times, volumes, strict=True))
    leaf = {
        "area": "439 cm2",
        "pressure_drop": "338 kPa",
        "dynamic_viscosity": "0.8937 cP",
        "dry_cake_per_filtrate": 23.47,
    }
    for header in ("t,V\ns,L", "Time (s),Volume (L)", "t / s,V / L", "time s,filtrate volume L"):
        sheet.write_text(f"{header}\n{body}\n")
        found = LeafTest.read(sheet, **leaf).fit()
        assert float(found.values["cake_resistance"]) == pytest.approx(1.863e11, rel=0.005)


@pytest.mark.parametrize("pan", ["0", "pan", "fond"])
def test_what_a_sieve_sheet_says_of_the_pan_is_no_sieve(tmp_path, pan):
    sheet = tmp_path / "sieves.csv"
    sheet.write_text(f"aperture (mm),mass retained (%)\n0.5,0\n0.25,60\n0.125,30\n{pan},10\n")
    found = SieveAnalysis.read(sheet).distribution().fractions
    assert [round(float(share), 9) for share in found] == [0.1, 0.3, 0.6]


def test_a_column_of_another_sort_is_not_taken_for_the_one_asked_for(tmp_path):
    """Liquid per solid, as Coulson and Richardson's example 5.1 has it, is no concentration."""
    sheet = tmp_path / "series.csv"
    sheet.write_text("liquid_ratio [kg/kg],settling_velocity [mm/s]\n5,0.2\n4.2,0.12\n3.7,0.094\n")
    with pytest.raises(InputError) as problem:
        CoeClevengerSeries.read(sheet)
    assert "rename it" not in problem.value.message
    assert "Columns found: liquid_ratio, settling_velocity" in problem.value.message
