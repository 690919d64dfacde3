"""Studies of formulas against closed forms: moments, Sobol indices, failures kept, cancelling, restart."""

from __future__ import annotations

import json

import jax.numpy as jnp
import numpy as np
import pytest
from tests.sharing.falling import SLURRY, SPREAD, STOKES
from tests.sharing.formulas import own_formula

from granum import studies
from granum.core.errors import GranumError
from granum.core.kinds import Fraction, Number
from granum.studies import chunks
from granum.studies.engine import Progress


def ishigami(x1: Number, x2: Number, x3: Number) -> Number:
    """Ishigami's function."""
    return jnp.sin(x1) + 7.0 * jnp.sin(x2) ** 2 + 0.1 * x3**4 * jnp.sin(x1)


def root(x1: Number, x2: Number) -> Number:
    """NaN below zero."""
    return jnp.sqrt(x1) + x2


def doubled(x1: Number) -> Fraction:
    """A share that may come out above one."""
    return 2.0 * x1


ISHIGAMI, ROOT, DOUBLED = own_formula(ishigami), own_formula(root), own_formula(doubled)
CIRCLE = {name: {"distribution": "uniform", "lower": -np.pi, "upper": np.pi} for name in ("x1", "x2", "x3")}


def test_sobol_indices_of_ishigami() -> None:
    """Closed form (Saltelli et al. 2008, ex. 2.6.6): S1 = 0.314, 0.442, 0; ST = 0.558, 0.442, 0.244."""
    found = studies.sobol(ISHIGAMI, CIRCLE, samples=4096, seed=1)
    rows = found.indices()["ratio"]
    assert [rows[n]["first"] for n in CIRCLE] == pytest.approx([0.3139, 0.4424, 0.0], abs=0.02)
    assert [rows[n]["total"] for n in CIRCLE] == pytest.approx([0.5576, 0.4424, 0.2437], abs=0.02)
    assert found.counts() == {
        "cases": 4096 * 5,
        "run": 4096 * 5,
        "failed": 0,
        "extrapolated": 0,
        "patient": 0,
        "reasons": {},
    }


def test_sobol_intervals_are_the_same_each_time() -> None:
    """The intervals are resampled: also of the first seed, 0, they repeat."""
    found = studies.sobol(ISHIGAMI, CIRCLE, samples=64)
    assert found.indices() == found.indices()


def test_monte_carlo_against_closed_forms() -> None:
    """Stokes velocity goes with the square of a lognormal size: lognormal again, with twice the log
    deviation.
    """
    median = 1650.0 * 9.80665 * (20e-6) ** 2 / (18 * 1e-3)
    limit = median * 1.3 ** (2 * 1.2815515655446004)  # its 90 % quantile
    found = studies.monte_carlo(
        STOKES, SPREAD, fixed=SLURRY, samples=20000, limits={"terminal_velocity": {"upper": limit}}
    )
    row = found.findings()["statistics"]["terminal_velocity"]
    assert (row["p50"], row["p90"]) == pytest.approx((median, limit), rel=5e-3)
    chance = found.findings()["limits"]["terminal_velocity"]
    assert chance["probability"] == pytest.approx(0.9, abs=3e-3)
    assert chance["interval_95"][0] < 0.9 < chance["interval_95"][1]
    assert found.rank_correlations()["terminal_velocity"]["particle_diameter"] == pytest.approx(1.0)


def test_failures_are_counted_and_kept() -> None:
    uncertain = {
        "x1": {"distribution": "uniform", "lower": -1.0, "upper": 3.0},
        "x2": {"distribution": "uniform", "lower": 0.0, "upper": 1.0},
    }
    found = studies.monte_carlo(ROOT, uncertain, samples=4000)
    counts = found.counts()
    assert counts["failed"] == pytest.approx(1000, abs=5)  # a quarter of a Latin hypercube lies below zero
    assert list(counts["reasons"]) == ["result 'ratio' is not a finite number"]
    data = found.dataset
    assert data.sizes["case"] == 4000
    assert np.array_equal(np.isnan(data["ratio"]), data["x1"] < 0)
    assert set(np.unique(data["reason"][data["x1"] < 0])) == set(counts["reasons"])
    assert found.findings()["statistics"]["ratio"]["least"] >= 0.0
    outside = studies.monte_carlo(
        STOKES,
        {"particle_diameter": {"distribution": "normal", "mean": 1e-5, "standard_deviation": 1e-5}},
        fixed=SLURRY,
    )
    # one standard deviation below the mean: 15.9 %
    assert outside.counts()["failed"] == pytest.approx(159, abs=2)
    assert list(outside.counts()["reasons"]) == ["input 'particle_diameter' outside what is possible"]


def test_a_figure_outside_its_own_bounds_is_no_value() -> None:
    """Above 1/2 the declared share 2·x is more than all: those cases fail with the reason, and no percentile
    holds them.
    """
    spread = {"x1": {"distribution": "uniform", "lower": 0.0, "upper": 1.0}}
    found = studies.monte_carlo(DOUBLED, spread, samples=400)
    assert found.counts()["reasons"] == {"result 'ratio' outside what is possible": 200}
    assert found.findings()["statistics"]["ratio"]["most"] <= 1.0


def test_cases_outside_a_range_are_counted() -> None:
    """Stokes' law is given for Re ≤ 0.5 or less: sand of 20 µm lies inside, of 200 µm (Re ≈ 7) outside; both
    have a value.
    """
    for size, share in (("20 um", 0.0), ("200 um", 1.0)):
        spread = {
            "particle_diameter": {
                "distribution": "lognormal",
                "median": size,
                "geometric_standard_deviation": 1.05,
            }
        }
        found = studies.monte_carlo(STOKES, spread, fixed=SLURRY, samples=50)
        assert found.counts()["extrapolated"] == 50 * share
        assert found.counts()["failed"] == 0
        assert np.all(found.dataset["code"] == -share)


def test_one_failed_case_discards_its_sobol_block_only() -> None:
    uncertain = {
        "x1": {"distribution": "uniform", "lower": -0.02, "upper": 3.0},
        "x2": {"distribution": "uniform", "lower": 0.0, "upper": 1.0},
    }
    found = studies.sobol(ROOT, uncertain, samples=512)
    assert 0 < found.findings()["blocks"] - found.findings()["blocks_used"] < 20
    # Var √x on 0-3 is 3/2 − (2√3/3)² = 1/6, Var x2 = 1/12
    assert found.indices()["ratio"]["x1"]["first"] == pytest.approx(2 / 3, abs=0.05)


def test_sweep_map_scenarios() -> None:
    line = studies.sweep(
        STOKES,
        {"particle_diameter": {"from": "1 um", "to": "100 um", "steps": 3, "spacing": "log"}},
        fixed=SLURRY,
    )
    table = line.findings()["table"]
    assert table["particle_diameter"] == pytest.approx([1e-6, 1e-5, 1e-4])
    assert table["terminal_velocity"][2] / table["terminal_velocity"][0] == pytest.approx(1e4)
    plane = studies.parameter_map(
        ROOT,
        {"x1": [1.0, 4.0, -1.0], "x2": {"from": 0.0, "to": 1.0, "steps": 2}},
        limits={"ratio": {"upper": 2.5}},
    )
    assert plane.grid("ratio")[:2] == pytest.approx(np.array([[1.0, 2.0], [2.0, 3.0]]))
    assert plane.allowed().tolist() == [[True, True], [True, False], [False, False]]
    sides = studies.scenarios(
        STOKES,
        {"cold": {}, "warm": {"dynamic_viscosity": "0.5 mPa*s"}},
        fixed={**SLURRY, "particle_diameter": 1e-5},
    )
    rows = sides.findings()["scenarios"]
    assert rows["warm"]["outputs"]["terminal_velocity"] == pytest.approx(
        2 * rows["cold"]["outputs"]["terminal_velocity"]
    )


def test_a_law_is_a_model_too() -> None:
    """Richardson and Zaki with a fixed exponent: (1 − c)^4.65."""
    found = studies.sweep(
        "particles.richardson_zaki",
        {"solids_volume_fraction": [0.1, 0.3]},
        fixed={"exponent": 4.65, "reynolds": 0.01},
    )
    assert found.cases.y[:, 0] == pytest.approx([0.9**4.65, 0.7**4.65])
    slope = studies.optimize(
        "particles.richardson_zaki",
        {"solids_volume_fraction": (0.01, 0.5)},
        fixed={"exponent": 4.65, "reynolds": 0.01},
        maximize="solids_volume_fraction * hindrance",
        starts=1,
    )
    # the flux peaks at 1/(n + 1)
    assert slope.values["solids_volume_fraction"] == pytest.approx(1 / 5.65, rel=1e-4)


def test_expressions_among_the_figures() -> None:
    found = studies.sweep(
        STOKES,
        {"particle_diameter": [1e-5, 2e-5]},
        fixed=SLURRY,
        outputs=["'1 m' / terminal_velocity", "terminal_velocity"],
    )
    assert found.column("'1 m' / terminal_velocity") * found.column("terminal_velocity") == pytest.approx(1.0)


def test_cancel_keeps_what_is_done(monkeypatch) -> None:
    monkeypatch.setitem(chunks.CHUNKS, "batched", 64)
    seen: list[Progress] = []
    found = studies.monte_carlo(
        STOKES, SPREAD, fixed=SLURRY, samples=640, progress=seen.append, cancel=lambda: len(seen) > 3
    )
    assert not found.complete
    assert found.counts()["run"] == seen[-1].done == 192
    assert found.counts()["reasons"] == {"not run: the study was stopped": 448}
    assert json.dumps(found.as_json(), allow_nan=False)


def test_memory_bounds_the_chunk(monkeypatch) -> None:
    """With little memory the chunks shrink; the figures stay."""
    usual = studies.monte_carlo(STOKES, SPREAD, fixed=SLURRY, samples=4096)
    subject = studies.subject_of("particles.terminal_velocity", SLURRY)
    wide = chunks.Evaluator.of(subject, ("particle_diameter",), ("terminal_velocity",), 4096)
    monkeypatch.setattr(chunks, "MEMORY", max(wide.compiled.memory_analysis().temp_size_in_bytes // 8, 1))
    narrow = chunks.Evaluator.of(subject, ("particle_diameter",), ("terminal_velocity",), 4096)
    assert narrow.size <= wide.size // 4
    assert narrow.compiled.memory_analysis().temp_size_in_bytes <= chunks.MEMORY
    x = usual.cases.x[: narrow.size]
    assert narrow(x)[0] == pytest.approx(wide(x)[0], rel=1e-12)


def test_restart_from_disk(tmp_path, monkeypatch) -> None:
    monkeypatch.setitem(chunks.CHUNKS, "batched", 32)
    folder, seen = tmp_path / "parts", []
    how = {"fixed": SLURRY, "samples": 320, "folder": folder}
    first = studies.monte_carlo(STOKES, SPREAD, **how, progress=seen.append, cancel=lambda: len(seen) > 4)
    assert 0 < first.counts()["run"] < 320
    again: list[Progress] = []
    second = studies.monte_carlo(STOKES, SPREAD, **how, progress=again.append)
    assert again[0].done == first.counts()["run"]  # nothing is computed twice
    assert second.complete
    assert np.array_equal(
        second.cases.y, studies.monte_carlo(STOKES, SPREAD, fixed=SLURRY, samples=320).cases.y
    )
    with pytest.raises(GranumError, match="another study"):
        studies.monte_carlo(STOKES, SPREAD, **{**how, "samples": 400})
    (tmp_path / "mine").mkdir()
    (tmp_path / "mine" / "letter.txt").write_text("dear")
    with pytest.raises(GranumError, match="holds no study"):
        studies.monte_carlo(STOKES, SPREAD, **{**how, "folder": tmp_path / "mine"})


def test_files(tmp_path) -> None:
    import pandas as pd
    import xarray as xr

    found = studies.monte_carlo(STOKES, SPREAD, fixed=SLURRY, samples=50, title="Spread")
    found.to_netcdf(tmp_path / "a.nc")
    with xr.open_dataset(tmp_path / "a.nc", engine="h5netcdf") as data:
        assert data["terminal_velocity"].attrs["units"] == "m/s"
        assert data.attrs["title"] == "Spread"
        assert np.array_equal(data["terminal_velocity"], found.column("terminal_velocity"))
    found.save(tmp_path / "a.csv")
    assert list(pd.read_csv(tmp_path / "a.csv"))[1:3] == ["particle_diameter [m]", "terminal_velocity [m/s]"]
    with pytest.raises(GranumError, match=r"\.nc, \.parquet, \.csv or \.xlsx"):
        found.save(tmp_path / "a.dat")
    with pytest.raises(GranumError, match="no folder"):
        found.save(tmp_path / "none" / "a.nc")
    assert sorted(p.name for p in tmp_path.iterdir()) == ["a.csv", "a.nc"]


@pytest.mark.parametrize("kind", ["charts", "json"])
def test_every_outcome_draws_and_serializes(kind: str) -> None:
    fixed = {**SLURRY, "particle_diameter": 1e-5}
    two = {"particle_diameter": ("1 um", "50 um"), "dynamic_viscosity": (5e-4, 2e-3)}
    made = [
        studies.monte_carlo(
            STOKES, SPREAD, fixed=SLURRY, samples=64, limits={"terminal_velocity": {"lower": 0.0}}
        ),
        studies.sobol(ISHIGAMI, CIRCLE, samples=16),
        studies.sweep(STOKES, {"particle_diameter": [1e-5, 2e-5]}, fixed=SLURRY),
        studies.parameter_map(
            STOKES, {k: {"from": a, "to": b, "steps": 4} for k, (a, b) in two.items()}, fixed=fixed
        ),
        studies.scenarios(STOKES, {"one": {}, "two": {"particle_diameter": 2e-5}}, fixed=fixed),
        studies.optimize(STOKES, two, maximize="terminal_velocity", fixed=fixed, starts=1),
    ]
    for outcome in made:
        if kind == "json":
            assert json.dumps(outcome.as_json(cases=5), allow_nan=False)
        else:
            for drawn in outcome.charts().values():
                assert len(drawn.data)
                assert drawn.layout.yaxis.type == "category" or not any(
                    isinstance(y, str) for t in drawn.data for y in (t.y if t.y is not None else ())
                )


@pytest.mark.parametrize(
    ("run", "message"),
    [
        (lambda: studies.monte_carlo("particles.terminal_velocity_stoks", {}), "Did you mean"),
        (lambda: studies.monte_carlo(STOKES, {}, fixed=SLURRY), "No input is uncertain"),
        (
            lambda: studies.monte_carlo(STOKES, {"particle_diametre": {}}, fixed=SLURRY),
            "Did you mean 'particle_diameter'",
        ),
        (lambda: studies.monte_carlo(STOKES, SPREAD), "needs"),
        (lambda: studies.monte_carlo(STOKES, SPREAD, fixed=SLURRY, samples=0), "whole number from 1"),
        (lambda: studies.monte_carlo(STOKES, SPREAD, fixed=SLURRY, method="lhs"), "Sampling method"),
        (
            lambda: studies.monte_carlo(STOKES, SPREAD, fixed=SLURRY, outputs=["terminal_velocty"]),
            "Did you mean 'terminal_velocity'",
        ),
        (
            lambda: studies.monte_carlo(
                STOKES, SPREAD, fixed=SLURRY, limits={"terminal_velocity": {"upper": "3 kg"}}
            ),
            "unit 'kg' does not fit",
        ),
        (
            lambda: studies.sweep(
                STOKES, {"particle_diameter": {"from": 0.0, "to": 1e-5, "spacing": "log"}}, fixed=SLURRY
            ),
            "greater than 0",
        ),
        (
            lambda: studies.sweep(STOKES, {"particle_diameter": {"from": 1e-6}}, fixed=SLURRY),
            "'to' is missing",
        ),
        (lambda: studies.parameter_map(STOKES, {"particle_diameter": [1e-6]}, fixed=SLURRY), "two inputs"),
        (lambda: studies.scenarios(STOKES, {"a": {}}, fixed=SLURRY), "change nothing"),
        (lambda: studies.sobol("filtration.leaf_test", {}), "a study takes a formula"),
    ],
)
def test_bad_input_gets_one_clear_message(run, message: str) -> None:
    with pytest.raises(GranumError) as caught:
        run()
    assert message in caught.value.message
    assert caught.value.exit_code == 2
