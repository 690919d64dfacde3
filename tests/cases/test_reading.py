"""Case files: what is wrong is said with table, key and remedy; a right one solves."""

from __future__ import annotations

from pathlib import Path

import pytest

from granum.cases import read_text
from granum.core.errors import CaseError, ConvergenceError, GranumError

GOOD = """
title = "Heater loop"
[mixture]
liquids = ["water"]
[feeds.cold]
to = "mix.cold"
temperature = "20 degC"
liquid_flow = "3600 kg/h"
[units.mix]
model = "streams.mixer"
[units.heat]
model = "streams.heater"
temperature = "60 degC"
[units.split]
model = "streams.splitter"
side_fraction = "50 %"
[streams]
mixed = ["mix", "heat"]
hot = ["heat", "split"]
back = ["split.side", "mix.back"]
"""


def test_a_right_case_solves_and_closes() -> None:
    run = read_text(GOOD).solve()
    assert run.figure("mix.mass_flow") == pytest.approx(2.0, rel=1e-10)
    assert run.audit["mass_closure"] < 1e-12
    assert run.audit["energy_closure"] < 1e-12
    data = run.as_json()
    assert data["units"]["heat"]["results"]["temperature"] == {"value": pytest.approx(333.15), "unit": "K"}
    assert set(data["streams"]) == {"cold", "mixed", "hot", "back", "split.product"}


def test_specification_in_a_case() -> None:
    text = GOOD + (
        '[specifications.flow]\nvary = "split.side_fraction"\nso_that = "mix.mass_flow"\nequals = '
        '"14400 kg/h"\nlower = 0\nupper = "95 %"\n'
    )
    run = read_text(text).solve()
    assert run.found["split.side_fraction"] == pytest.approx(0.75, abs=1e-9)


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("liquid_flow", "liquid_flwo", "liquid_flwo.*Did you mean 'liquid_flow'"),
        ('"60 degC"', '"60 m"', r"\[units.heat\].*temperature.*unit 'm' does not fit"),
        ('"60 degC"', '"-300 degC"', r"\[units.heat\].*must be greater than"),
        ("streams.heater", "streams.heatr", "Did you mean 'streams.heater'"),
        ('side_fraction = "50 %"', 'side_fraction = "50"', "Did you mean 50 %"),
        ('["water"]', '["watr"]', "watr.*Did you mean 'water'"),
        ('model = "streams.mixer"', "", "needs 'model'"),
        ('["heat", "split"]', '["heat", "split", "x"]', "write it as"),
        ('"mix.cold"', '"nix.cold"', "nix"),
        ('title = "Heater loop"', "", "'title' is missing"),
        ('"20 degC"', "true", "'feeds.cold.temperature' = true .*a number with its unit"),
        ('"3600 kg/h"', "false", "'feeds.cold.liquid_flow' = false .*a number with its unit"),
        ("[mixture]", "[mixture", "not valid TOML"),
        (
            "[feeds.cold]",
            "[streams.cold]",
            r"no .*'liquid_flow'.*: what enters .* \[feeds\.cold\], with 'to'",
        ),
        ('["heat", "split"]', "{ from = 3 }", r"'streams\.\w+\.from'"),
    ],
)
def test_wrong_cases_say_what_to_do(old: str, new: str, message: str) -> None:
    assert old in GOOD
    with pytest.raises(CaseError, match=message):
        read_text(GOOD.replace(old, new))


def test_keys_that_are_missing_or_unknown_are_told_at_once() -> None:
    text = GOOD.replace('title = "Heater loop"', "").replace("liquid_flow", "liquid_flwo")
    with pytest.raises(CaseError, match=r"'title' is missing\. .*liquid_flwo.*'liquid_flow'\?$"):
        read_text(text)


def test_unconverged_names_stream_and_unit_and_keeps_the_last_iterate() -> None:
    with pytest.raises(ConvergenceError, match=r"back.*split.*purge") as caught:
        read_text(GOOD.replace('"50 %"', "1.0")).solve()
    assert caught.value.last is not None
    assert caught.value.exit_code == 3


def test_infeasible_specification_says_which() -> None:
    text = GOOD + (
        '[specifications.flow]\nvary = "split.side_fraction"\nso_that = "mix.mass_flow"\nequals = "0.1 '
        'kg/h"\nlower = 0\nupper = 0.9\n'
    )
    with pytest.raises(ConvergenceError, match=r"mix\.mass_flow"):
        read_text(text).solve()


def test_report_and_tables(tmp_path: Path) -> None:
    run = read_text(GOOD).solve()
    run.report(tmp_path / "out.html")
    run.tables(tmp_path / "out.csv")
    run.tables(tmp_path / "out.xlsx")
    page = (tmp_path / "out.html").read_text(encoding="utf-8")
    for word in ("Heater loop", "<svg", "60 °C", "Calculation note", "sha256"):
        assert word in page
    assert "mass_flow [kg/s]" in (tmp_path / "out.csv").read_text(encoding="utf-8")
    with pytest.raises(GranumError, match=r"\.csv or \.xlsx"):
        run.tables(tmp_path / "out.doc")


TWO = """
title = "Loop"
[mixture]
liquids = ["water"]
[feeds.fresh]
to = "mix.fresh"
mass_flow = "1 kg/s"
[units.mix]
model = "streams.mixer"
[units.heat]
model = "streams.heater"
temperature = "50 degC"
[units.split]
model = "streams.splitter"
side_fraction = 0.5
[streams]
mixed = ["mix", "heat"]
hot = ["heat", "split"]
back = ["split.side", "mix.back"]
[specifications.circulation]
vary = "split.side_fraction"
so_that = "mix.mass_flow"
equals = "4 kg/s"
lower = 0.0
upper = 0.9
"""
SECOND = """
[specifications.second]
vary = "{vary}"
so_that = "{so_that}"
equals = "{equals}"
lower = {lower}
upper = {upper}
"""


def test_two_specifications_on_one_parameter_or_one_result_are_refused() -> None:
    again = SECOND.format(
        vary="split.side_fraction", so_that="heat.temperature", equals="60 degC", lower=0.1, upper=0.9
    )
    with pytest.raises(CaseError, match=r"'circulation' and 'second' both vary 'split\.side_fraction'"):
        read_text(TWO + again)
    twice = SECOND.format(
        vary="heat.temperature",
        so_that="mix.mass_flow",
        equals="3 kg/s",
        lower='"20 degC"',
        upper='"90 degC"',
    )
    with pytest.raises(CaseError, match="over-specified"):
        read_text(TWO + twice)
    with pytest.raises(CaseError, match="'lower' must be below 'upper'"):
        read_text(TWO.replace("upper = 0.9", "upper = 0.0"))


def test_two_independent_specifications_are_met() -> None:
    more = SECOND.format(
        vary="heat.temperature",
        so_that="heat.heat_duty",
        equals="200 kW",
        lower='"26 degC"',
        upper='"95 degC"',
    )
    run = read_text(TWO + more).solve()
    assert run.figure("mix.mass_flow") == pytest.approx(4.0, rel=1e-8)
    assert run.figure("heat.heat_duty") == pytest.approx(2e5, rel=1e-8)


def test_specification_out_of_reach_says_what_can_be_reached() -> None:
    with pytest.raises(
        ConvergenceError,
        match=r"out of reach: it is 3600 kg/h at split.side_fraction = 0 % and 36 t/h at 90 %",
    ):
        read_text(TWO.replace('"4 kg/s"', '"40 kg/s"')).solve()


def test_missing_parameter_leaves_the_line_under_specified() -> None:
    with pytest.raises(CaseError, match="side_fraction"):
        read_text(TWO.replace("side_fraction = 0.5\n", ""))


def test_loop_without_a_way_out_names_the_stream() -> None:
    text = TWO[: TWO.index("[specifications")].replace("side_fraction = 0.5", "side_fraction = 1.0")
    with pytest.raises(ConvergenceError, match=r"loop through stream 'back'.*purge"):
        read_text(text).solve()
