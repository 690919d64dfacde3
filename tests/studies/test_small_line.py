"""Studies of a small line with a recycle whose balance is known: fresh feed F, share s leaves, so F/s goes
round.
"""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path
from typing import Any

import jax
import numpy as np
import pytest

import granum as gr
from granum import studies
from granum.cases import read_studies, studies_of_line
from granum.core.errors import GranumError
from granum.flowsheet.ladder import at_rung, beginning
from granum.flowsheet.specifications import design
from granum.flowsheet.stream_figures import changed
from granum.studies import chunks
from granum.studies.lines import LineSubject, verdict
from granum.studies.subjects import FINE, NEGATIVE, NOT_CLOSED, UNMET

CASE = Path(__file__).with_name("small.toml")


@pytest.fixture(scope="module")
def line():
    return gr.read(CASE)


def test_recycle_by_hand_and_a_case_without_solution(line) -> None:
    """With s = 0 nothing leaves: that case fails, says why and is kept."""
    found = studies.sweep(
        line,
        {"divide.side_fraction": [0.2, 0.5, 1.0, 0.0]},
        outputs=["hot.mass_flow", "warm.heat_duty", "out.liquid.water"],
    )
    assert found.column("hot.mass_flow")[:3] == pytest.approx([5.0, 2.0, 1.0], rel=1e-9)
    # the loop keeps its heat
    assert found.column("warm.heat_duty")[:3] == pytest.approx(
        [found.column("warm.heat_duty")[0]] * 3, rel=1e-9
    )
    assert found.column("out.liquid.water")[:3] == pytest.approx([0.9] * 3)
    assert found.counts()["reasons"] == {"a loop did not converge": 1}
    assert np.isnan(found.column("hot.mass_flow")[3])


def test_slow_lines_are_looked_after_often(line, monkeypatch) -> None:
    """When one case takes longer than a slice, progress is told case by case; the figures are those of large
    chunks.
    """
    shares = np.linspace(0.2, 1.0, 9)
    seen: list[int] = []
    monkeypatch.setattr(chunks, "SLICE", 0.0)
    how = {"outputs": ["hot.mass_flow", "warm.heat_duty", "out.liquid.water"]}
    found = studies.sweep(
        line, {"divide.side_fraction": list(shares)}, **how, progress=lambda p: seen.append(p.done)
    )
    assert seen == list(range(10))
    assert found.column("hot.mass_flow") == pytest.approx(1 / shares, rel=1e-9)
    monkeypatch.setattr(chunks, "SLICE", 1e9)
    at_once = studies.sweep(
        line, {"divide.side_fraction": list(shares)}, **how, progress=lambda p: seen.append(p.done)
    )
    assert seen[10:] == [0, 9]
    assert np.array_equal(at_once.cases.y, found.cases.y)


def test_only_a_solution_counts(line) -> None:
    """A line that lost mass, has a negative flow or did not come to rest is none, whatever its figures
    say.
    """
    found = jax.jit(lambda sheet: design(sheet, line.targets))(line.sheet)
    judge = jax.jit(verdict)
    streams = found.solution.streams

    def with_out(**changed: Any) -> Any:
        solution = found.solution._replace(streams=streams | {"out": streams["out"].replace(**changed)})
        return int(judge(found._replace(solution=solution)))

    out = streams["out"]
    assert with_out() == FINE
    assert with_out(liquid=out.liquid * (1 + 1e-8)) == NOT_CLOSED
    assert with_out(temperature=out.temperature + 1e-3) == NOT_CLOSED
    assert with_out(temperature=np.nan * out.temperature) == NOT_CLOSED
    assert with_out(liquid=out.liquid - np.array([0.0, 1.0])) == NEGATIVE
    assert int(judge(found._replace(converged=np.array(False)))) == UNMET


def test_feeds_as_inputs(line) -> None:
    """Flows and shares of feeds: salt at 20 % and 3 kg/s, twice as hot a product needs twice the heat."""
    cases = {
        "base": {},
        "salty": {"fresh.liquid.sodium chloride": "20 %", "fresh.mass_flow": "3 kg/s"},
        "cool": {"warm.temperature": "40 degC"},
    }
    rows = studies.scenarios(
        line, cases, outputs=["out.liquid.water", "out.mass_flow", "warm.heat_duty"]
    ).findings()["scenarios"]
    assert rows["salty"]["outputs"]["out.liquid.water"] == pytest.approx(0.8)
    assert rows["salty"]["outputs"]["out.mass_flow"] == pytest.approx(3.0)
    assert rows["cool"]["outputs"]["warm.heat_duty"] == pytest.approx(
        rows["base"]["outputs"]["warm.heat_duty"] / 2, rel=0.01
    )


def test_optimum_through_the_recycle(line) -> None:
    """The smallest share that keeps the loop below 8 kg/s is 1/8; its price is d(s)/d(limit) = −1/64."""
    found = studies.optimize(
        line,
        {"divide.side_fraction": (0.05, 0.9)},
        minimize="divide.side_fraction",
        limits={"hot.mass_flow": {"upper": 8.0}},
        starts=1,
    )
    assert found.values["divide.side_fraction"] == pytest.approx(0.125, rel=1e-6)
    assert found.prices["hot.mass_flow upper"] == pytest.approx(-1 / 64, rel=1e-3)


def test_studies_declared_for_a_line(line) -> None:
    table = {"spread": {"kind": "monte_carlo", "samples": 50, "outputs": ["hot.mass_flow"]}}
    doubt = {"divide.side_fraction": {"distribution": "uniform", "lower": 0.2, "upper": 0.3}}
    found = studies_of_line(line, table, doubt)["spread"].run()
    # mean of 1/s
    assert found.findings()["statistics"]["hot.mass_flow"]["mean"] == pytest.approx(
        np.log(1.5) / 0.1, rel=1e-3
    )
    assert found.counts()["failed"] == 0


def test_fingerprint_is_the_same_in_another_process_and_tells_models_apart(line) -> None:
    """A stored study continues in another process, but never with another model."""
    own = LineSubject.of(line).fingerprint()
    text = (
        f"import granum as gr; from granum.studies import LineSubject; "
        f"print(LineSubject.of(gr.read({str(CASE)!r})).fingerprint())"
    )
    other = subprocess.run(
        [sys.executable, "-c", text], capture_output=True, text=True, check=True
    ).stdout.strip()
    assert other == own
    assert LineSubject.of(line.with_values(**{"warm.temperature": 320.0})).fingerprint() != own
    assert LineSubject.of(line).with_quantities({"q": "warm.heat_duty"}).fingerprint() != own
    stokes, newton = (
        studies.subject_of("particles.terminal_velocity", {"drag": law}).fingerprint()
        for law in ("stokes", "haider_levenspiel")
    )
    assert stokes != newton


@pytest.mark.parametrize(
    ("path", "message"),
    [
        ("wram.temperature", "Did you mean 'warm'?"),
        ("warm.temprature", "Did you mean 'temperature'?"),
        ("fresh.solid_flow", "carries no solid"),
        ("fresh.liquid.watter", "Did you mean 'liquid.water'?"),
        ("warm.temperature[1]", "leave out the index"),
    ],
)
def test_unknown_inputs_suggest(line, path: str, message: str) -> None:
    with pytest.raises(GranumError) as caught:
        LineSubject.of(line).input(path)
    assert message in caught.value.message


@pytest.mark.parametrize(
    ("path", "message"),
    [
        ("warm.heat_dty", "Did you mean 'heat_duty'?"),
        ("out.mass_flw", "Did you mean 'mass_flow'?"),
        ("nothing", "is not known"),
    ],
)
def test_unknown_figures_suggest(line, path: str, message: str) -> None:
    with pytest.raises(GranumError) as caught:
        LineSubject.of(line).output(path)
    assert message in caught.value.message


SPECIFIED = (
    CASE.read_text()
    + """
[specifications.loop]
vary = "divide.side_fraction"
so_that = "blend.mass_flow"
equals = "4 kg/s"
lower = 0.05
upper = 0.95

[uncertain]
"fresh.mass_flow" = { distribution = "uniform", lower = "1 kg/s", upper = "3 kg/s" }

[quantities]
heat_per_product = { expression = "warm.heat_duty / out.mass_flow", kind = "SpecificEnergy" }

[study.sizes]
kind = "monte_carlo"
samples = 40
outputs = ["divide.side_fraction", "heat_per_product"]
"""
)


def test_sizes_found_by_a_specification_under_uncertainty(tmp_path) -> None:
    """A loop of 4 kg/s needs a share of F/4; the heat per product does not depend on the flow."""
    (tmp_path / "case.toml").write_text(SPECIFIED)
    found = read_studies(tmp_path / "case.toml")["sizes"].run()
    assert found.counts()["failed"] == 0
    assert found.column("divide.side_fraction") == pytest.approx(
        found.column("fresh.mass_flow") / 4.0, rel=1e-6
    )
    assert np.ptp(found.column("heat_per_product")) < 1e-6 * found.column("heat_per_product")[0]
    # above 3.8 kg/s: no share can do it
    (tmp_path / "case.toml").write_text(SPECIFIED.replace('upper = "3 kg/s"', 'upper = "7 kg/s"'))
    found = read_studies(tmp_path / "case.toml")["sizes"].run()
    assert found.counts()["reasons"] == {
        "the design specifications cannot be met": int((found.column("fresh.mass_flow") > 3.8).sum())
    }
    (tmp_path / "case.toml").write_text(
        SPECIFIED.replace('"fresh.mass_flow" =', '"divide.side_fraction" =').replace(
            'kg/s", upper', '", upper'
        )
    )
    with pytest.raises(GranumError):
        read_studies(tmp_path / "case.toml")["sizes"].run()


def test_neighbor_of_a_solved_line_takes_few_passes(tmp_path) -> None:
    """The share of F/4 that makes a loop of 4 kg/s, for another F along slopes that were learned for the
    first.
    """
    (tmp_path / "case.toml").write_text(SPECIFIED)
    line = gr.read(tmp_path / "case.toml")

    def solved(feed: float, begin):
        return at_rung(changed(line.sheet, {"fresh.mass_flow": feed}), line.targets, 0, begin)

    first = solved(1.0, beginning(line.sheet, line.targets, among_many=True))
    near = beginning(line.sheet, line.targets, first, among_many=True)
    for feed in (0.5, 1.1, 2.0):
        found = solved(feed, near)
        assert bool(found.converged)
        assert float(found.values["divide.side_fraction"]) == pytest.approx(feed / 4.0, rel=1e-9)
        assert max(map(int, found.solution.steps)) <= 12


def test_a_figure_is_a_path_an_expression_or_a_quantity(line) -> None:
    """A name is given under ``[quantities]`` alone. Of 1 kg/s fed with s = 1/4, 4 kg/s are heated."""
    again = studies.subject_of(line, quantities={"passes": "hot.mass_flow / out.mass_flow"})
    table = {
        "over": {"divide.side_fraction": [0.25]},
        "outputs": ["out.mass_flow", "passes", "recycle.mass_flow / out.mass_flow"],
    }
    found = studies.Study.of("sweep", table, again).run()
    assert found.cases.y[0] == pytest.approx([1.0, 4.0, 3.0], rel=1e-9)
    with pytest.raises(GranumError, match=r"declare 'passes' under \[quantities\]"):
        studies.Study.of("sweep", {**table, "outputs": ["passes = hot.mass_flow"]}, again).run()
