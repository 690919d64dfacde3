"""Reading data files and the base class of lab tests."""

from __future__ import annotations

import io
from typing import Annotated, ClassVar

import numpy as np
import openpyxl
import pytest

from granum.core import lab_test
from granum.core.errors import InputError, UnitError
from granum.core.kinds import Area, Series, Time, Velocity, Volume
from granum.estimation import Fit, LabTest
from granum.estimation.tables import as_csv, sheets_of


@lab_test("emptying", source="none", title="Emptying")
class Emptying(LabTest):
    """A flow from volumes."""

    time: Annotated[Time, Series("points")]
    filtrate_volume: Annotated[Volume, Series("points")]
    area: Area
    height: Annotated[Volume, Series("points")] | None = None
    estimates: ClassVar = {"velocity": Velocity}
    axes: ClassVar = {"time": Time, "volume": Volume}

    def fit(self) -> Fit:
        self.increasing("time")
        return self.fitted(
            lambda p, t: p["velocity"] * self.area * t, {"velocity": 1e-3}, self.time, self.filtrate_volume
        )


CSV = "filtrate_volume [L],note,time [min]\n# a comment\n1.2,first,1\n2.4,,2\n\n3.6,x,3\n"
TEXTS = {
    "comma": CSV,
    "tabs": CSV.replace(",", "\t"),
    "semicolons with decimal commas": CSV.replace(",", ";").replace(".", ","),
    "parentheses": CSV.replace("[", "(").replace("]", ")"),
    "slash": CSV.replace("[L]", "/ L").replace("[min]", "/ min"),
    "byte order mark": "\ufeff" + CSV,
}


@pytest.mark.parametrize("text", TEXTS.values(), ids=TEXTS)
def test_same_data_in_any_dress(text, tmp_path):
    path = tmp_path / "run.csv"
    path.write_text(text, encoding="utf-8")
    test = Emptying.read(path, area="200 cm2")
    np.testing.assert_allclose(test.time, [60.0, 120.0, 180.0])
    np.testing.assert_allclose(test.filtrate_volume, [1.2e-3, 2.4e-3, 3.6e-3])
    found = test.fit().as_json()
    assert found["card"] == "user.emptying"
    assert found["parameters"]["velocity"]["unit"] == "m/s"
    assert found["parameters"]["velocity"]["value"] == pytest.approx(1e-3, rel=1e-12)
    assert set(found) == {
        "card",
        "parameters",
        "derived",
        "statistics",
        "flags",
        "diagnostics",
        "defaults",
        "ranges",
        "from",
    }
    drawn = test.chart().data  # band, model, data, and the residuals under them
    assert len(drawn) == 5
    assert drawn[-1].yaxis == "y2"
    np.testing.assert_allclose(drawn[-1].y, 0.0, atol=1e-9)  # the points lie on the line


def test_spreadsheet_and_file_objects():
    book = openpyxl.Workbook()
    for row in (["time [s]", "filtrate_volume [m3]"], [60, 0.0012], [120, 0.0024], [180, 0.0036]):
        book.active.append(row)
    raw = io.BytesIO()
    book.save(raw)
    raw.seek(0)
    assert Emptying.read(raw, area=0.02).fit()["velocity"].value == pytest.approx(1e-3)
    assert Emptying.read(io.StringIO(CSV), area=0.02).time[0] == 60.0


@pytest.mark.parametrize(
    ("text", "error", "words"),
    [
        ("", InputError, "no header"),
        (CSV.replace("time", "tme"), InputError, "Column 'tme' looks like it: rename it to 'time'"),
        (CSV.replace(" [min]", ""), InputError, "has no unit"),
        (CSV.replace("[min]", "[L]"), UnitError, "does not fit"),
        (CSV.replace("[min]", "[minits]"), UnitError, "not known"),
        (CSV.replace("2.4", "2.4a"), InputError, "Line 4, column 'filtrate_volume': '2.4a' is not a number"),
        (CSV.replace("2.4", "-2.4"), InputError, "Line 4, column 'filtrate_volume': -2.4 L is not possible"),
        (CSV.replace(",note,", ",time [s],"), InputError, "stands twice"),
        (CSV.split("2.4")[0], InputError, "at least 3 points; 1 were given"),
    ],
)
def test_clear_messages(text, error, words):
    with pytest.raises(error) as caught:
        Emptying.read(io.StringIO(text), area=0.02)
    assert words in caught.value.message


def test_messages_on_files_and_columns(tmp_path):
    (tmp_path / "leaf.csv").write_text(CSV)
    with pytest.raises(InputError, match=r"Did you mean '.*leaf.csv'"):
        Emptying.read(tmp_path / "leef.csv", area=1)
    with pytest.raises(InputError, match="needs 'area'"):
        Emptying.read(tmp_path / "leaf.csv")
    with pytest.raises(InputError, match="Unequal numbers"):
        Emptying(time=[1, 2, 3], filtrate_volume=[1, 2, 3, 4], area=1)
    with pytest.raises(InputError, match="must increase"):
        Emptying(time=[1, 3, 2], filtrate_volume=[1, 2, 3], area=1).fit()


def test_a_sheet_of_a_workbook_is_read_by_its_name():
    book = openpyxl.Workbook()
    book.active.title = "Notes"
    book.active.append(["measured on Monday"])
    data = book.create_sheet("Test 1")
    data.append(["time [s]", "filtrate volume [L]"])
    data.append([10, 0.5])
    held = io.BytesIO()
    book.save(held)
    assert sheets_of(held.getvalue()) == ["Notes", "Test 1"]
    assert as_csv(io.BytesIO(held.getvalue()), "Test 1") == "time [s],filtrate volume [L]\n10,0.5\n"
    assert as_csv(io.BytesIO(held.getvalue())) == "measured on Monday\n"
    assert sheets_of(b"time,volume\n1,2\n") == []
