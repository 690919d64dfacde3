"""``granum study`` as a user types it: tables, JSON, report, restart after a kill, workers, messages."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import time

import numpy as np
import pytest
import xarray as xr
from tests.sharing.commands import granum
from tests.sharing.falling import SETTLING
from tests.sharing.places import EXAMPLES, ROOT

from granum.cases import read_studies
from granum.core.errors import GranumError
from granum.studies import chunks


def test_settling_example() -> None:
    """The spread of a lognormal diameter in Stokes' range: P90/P10 of the speed is close to 1.2**(2·2·1.2816)
    = 2.55, less inertia.
    """
    code, out, _err = granum("study", SETTLING, "--json", "--samples", "1000")
    data = json.loads(out)["studies"]
    assert code == 0
    assert set(data) == {"spread", "influence", "map"}
    speed = data["spread"]["findings"]["statistics"]["terminal_velocity"]
    assert 2.3 < speed["p90"] / speed["p10"] < 2.55
    assert data["influence"]["findings"]["indices"]["terminal_velocity"]["particle_diameter"]["total"] > 0.9
    assert data["spread"]["counts"] == {
        "cases": 1000,
        "run": 1000,
        "failed": 0,
        "extrapolated": 0,
        "patient": 0,
        "reasons": {},
    }


def test_tables_and_report(tmp_path) -> None:
    report = tmp_path / "r.html"
    code, out, _err = granum(
        "study",
        SETTLING,
        "spread",
        "--samples",
        "200",
        "--report",
        str(report),
        "--out",
        str(tmp_path / "cases.csv"),
    )
    assert code == 0
    for words in ("P10", "P90", "settling time ≤ 10 min", "saved to"):
        assert words in out
    html = report.read_text()
    assert "plotly" in html
    assert "<h2>Settling time over 1.5 m" in html
    assert sorted(p.name for p in tmp_path.iterdir()) == ["cases.csv", "r.html"]  # the parts are gone


FALL = ["particles.terminal_velocity", "particle_density=2630", "fluid_density=1020"]
BELT = [
    "filtration.horizontal_belt_filter",
    "cake_resistance=1e10",
    "void_fraction=0.45",
    "medium_resistance=1e9",
    "belt_length=3m",
    "belt_speed=4m/min",
    "mixture.solids=quartz",
    "wash=no",
    "mixture.liquids=water",
    "feed.solid_flow=800kg/h",
    "feed.liquid_flow=1000kg/h",
    "mixture.sizes.classes=8",
    "mixture.sizes.smallest=1um",
    "mixture.sizes.largest=1mm",
    "feed.sizes.law=rosin_rammler",
    "feed.sizes.size_modulus=100um",
    "feed.sizes.distribution_exponent=1.5",
]


def test_a_card_without_a_file() -> None:
    """Stokes' speed goes with the square of the size; a belt needs the less area the more suction it has,
    which is the bound of the optimum.
    """
    code, out, _err = granum(
        "study", *FALL, "particle_diameter=2..4um", "dynamic_viscosity=1cP", "--steps", "2", "--json"
    )
    speed = json.loads(out)["studies"]["sweep"]["findings"]["table"]["terminal_velocity"]
    assert code == 0
    assert speed[1] / speed[0] == pytest.approx(4.0, rel=1e-3)
    code, out, _err = granum(
        "study",
        *FALL,
        "particle_diameter=85um+-10%",
        "dynamic_viscosity=1.2..1.4cP",
        "--sobol",
        "--samples",
        "32",
        "--json",
    )
    assert (
        json.loads(out)["studies"]["sobol"]["findings"]["indices"]["terminal_velocity"]["particle_diameter"][
            "total"
        ]
        > 0.7
    )
    wanted = [
        "area=0.5..3m2",
        "pressure_drop=0.3..0.7bar",
        "--minimize",
        "area",
        "--limit",
        "capacity_use<=0.9",
        "--json",
    ]
    code, out, err = granum("study", *BELT, *wanted)
    assert code == 0, err
    best = json.loads(out)["studies"]["optimize"]["findings"]["inputs"]
    assert best["horizontal_belt_filter.pressure_drop"]["value"] == pytest.approx(0.7e5, rel=1e-6)


def test_equipment_opens_with_its_ordinary_feed_and_says_what_was_assumed() -> None:
    """As ``granum calc`` does; the table is in words, with the unit of each column."""
    words = ["filtration.rotary_vacuum_drum", "rotation_speed=0.2..1rpm", "--steps", "2"]
    code, out, err = granum("study", *words)
    assert code == 0, err
    assert "Not said, hence as in the example: area=9 m2" in out
    assert "rotation_speed" not in out
    flat = " ".join(out.split())
    assert "rpm" in flat
    assert "kg/m²" in flat
    code, out, _err = granum("study", *words, "mixture.solids=quartz", "--json")
    told = json.loads(out)
    assert code == 0
    assert "rotation_speed" not in told["assumed"]
    assert "mixture.solids" not in told["assumed"]
    assert told["assumed"]["area"] == "9 m2"


def test_tables_are_headed_with_units_that_look_like_marks_of_style() -> None:
    code, out, _err = granum("study", *FALL, "particle_diameter=2..4um", "dynamic_viscosity=1cP")
    assert code == 0
    assert "terminal velocity / µm/s" in " ".join(out.split())
    code, out, _err = granum("study", *FALL, "particle_diameter=50..90um", "dynamic_viscosity=1cP")
    assert "terminal velocity / mm/s" in " ".join(out.split())


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (FALL, "Nothing varies"),
        ([*FALL, "particle_diametr=20..85um", "dynamic_viscosity=1cP"], "Did you mean 'particle_diameter'"),
        ([*FALL, "particle_diameter=20..85um"], "needs 'dynamic_viscosity'"),
        ([*FALL, "particle_diameter=85.. um"], "write a range as 0.3..0.8bar"),
        ([*FALL, "particle_diameter=20..85um", "--limit", "speed"], "is not a limit"),
        (
            [*FALL[:1], "particle_density=2..3", "fluid_density=1..2", "particle_diameter=1..2um"],
            "More than two ranges",
        ),
        (
            [*FALL, "dynamic_viscosity=1cP+-5%", "particle_diameter=1um", "--minimize", "terminal_velocity"],
            "nothing to vary",
        ),
        ([*BELT, "aera=1..2m2"], "Did you mean 'area'"),
        ([*BELT, "area=1..2m2", "pressure_drop="], "needs 'pressure_drop'"),
        ([*BELT, "solid.PVC.density=1..2g/cm3"], "belongs to a material"),
        (["filtration.leaf_test", "area=1..2m2"], "(lab test)"),
        ([str(SETTLING), "--sobol"], "--sobol is of a card"),
        (["none.toml"], "cannot be read"),
        ([str(SETTLING), "spred"], "Did you mean 'spread'?"),
        ([str(SETTLING), "map", "--samples", "5"], "has no 'samples'"),
        ([str(SETTLING), "spread", "--out", "x.dat"], ".nc, .parquet, .csv or .xlsx"),
        ([str(SETTLING), "spread", "--workers", "0"], "at least 1"),
        ([str(EXAMPLES / "potassium-nitrate" / "line.toml")], "declares no study"),
    ],
)
def test_bad_input_gets_one_message_and_status_two(words: list[str], message: str) -> None:
    code, _out, err = granum("study", *words)
    assert code == 2
    assert message in err
    assert len(err.strip().splitlines()) == 1


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (('kind = "monte_carlo"', 'kind = "monte_carl"'), "Did you mean 'monte_carlo'?"),
        (("samples = 4000", "sample = 4000"), "Did you mean 'samples'?"),
        (("samples = 4000", 'samples = "many"'), "must be a whole number"),
        (('limits = { settling_time = { upper = "10 min" } }', "limits = 3"), "must be a table"),
        (('upper = "10 min"', 'uper = "10 min"'), "Did you mean 'upper'?"),
        (('card = "particles.terminal_velocity"', ""), "name the model as case"),
        (('card = "particles.terminal_velocity"', 'case = "nothing.toml"'), "belong to a card"),
        (('terminal_velocity", kind', 'terminal_velocitty", kind'), "Did you mean 'terminal_velocity'?"),
        (("[uncertain]", "[uncertan]"), "Did you mean 'uncertain'?"),
        (
            ('distribution = "lognormal", median', 'distribution = "lognormal", meidan'),
            "Did you mean 'median'?",
        ),
        (("title =", "title = ="), "not valid TOML"),
    ],
)
def test_faults_in_the_file_are_named(tmp_path, change: tuple[str, str], message: str) -> None:
    text = SETTLING.read_text()
    assert change[0] in text
    (tmp_path / "s.toml").write_text(text.replace(*change))
    with pytest.raises(GranumError) as caught:
        read_studies(tmp_path / "s.toml")["spread"].run()
    assert message in caught.value.message
    assert caught.value.exit_code == 2


def test_continues_after_a_kill(tmp_path) -> None:
    out, parts = tmp_path / "x.nc", tmp_path / "x.nc.parts"
    words = [
        sys.executable,
        "-m",
        "granum.cli",
        "study",
        SETTLING,
        "spread",
        "--samples",
        "1000000",
        "--out",
        str(out),
        "--json",
    ]
    running = subprocess.Popen(words, stdout=subprocess.DEVNULL, cwd=ROOT)
    deadline = time.monotonic() + 120
    while len(list(parts.glob("cases-*.npz"))) < 2 and running.poll() is None and time.monotonic() < deadline:
        time.sleep(0.01)
    running.send_signal(signal.SIGKILL)
    running.wait()
    kept = {p.name: p.stat().st_mtime_ns for p in parts.glob("cases-*.npz")}
    assert 0 < len(kept) < 62
    assert not out.exists()
    seen = []
    study = read_studies(SETTLING)["spread"].with_options(samples=1000000)
    found = study.run(folder=parts, progress=seen.append)
    assert seen[0].done == len(kept) * 16384
    assert found.complete
    assert {n: (parts / n).stat().st_mtime_ns for n in kept} == kept  # nothing was computed again
    assert np.isfinite(found.column("terminal_velocity")).all()


@pytest.mark.long
def test_two_workers_one_killed_nothing_lost(monkeypatch) -> None:
    """The same cases on two local Dask workers, one of them killed while it works, equal those computed
    here.
    """
    distributed = pytest.importorskip("distributed")
    monkeypatch.setitem(chunks.CHUNKS, "batched", 256)
    study = read_studies(SETTLING)["spread"].with_options(samples=6400)
    here = study.run()
    killed: list[int] = []
    local = distributed.LocalCluster(
        n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None, silence_logs=50
    )
    with local as cluster, distributed.Client(cluster) as client:
        pids = client.run(os.getpid)

        def progress(found) -> None:
            if found.done and not killed:
                killed.append(next(iter(pids.values())))
                os.kill(killed[0], signal.SIGKILL)

        there = study.run(workers=client, progress=progress)
    assert killed
    assert there.complete
    assert there.counts()["failed"] == 0
    assert np.array_equal(here.cases.x, there.cases.x)
    assert there.cases.y == pytest.approx(here.cases.y, rel=1e-12)


def test_netcdf_of_the_command(tmp_path) -> None:
    code, _out, _err = granum(
        "study", SETTLING, "spread", "--samples", "100", "--out", str(tmp_path / "x.nc"), "--seed", "3"
    )
    assert code == 0
    with xr.open_dataset(tmp_path / "x.nc", engine="h5netcdf") as data:
        assert data.sizes["case"] == 100
        assert data["settling_time"].attrs["units"] == "s"
