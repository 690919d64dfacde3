"""Studies on disk: damaged, foreign and unwritable files are told and never become results; what was computed
is kept.
"""

from __future__ import annotations

import errno
import json
import shutil
from pathlib import Path
from statistics import NormalDist
from typing import Any

import numpy as np
import pytest
from tests.sharing.commands import granum
from tests.sharing.falling import SETTLING, SLURRY, SPREAD, STOKES

from granum import studies
from granum.cases import read_studies
from granum.core.errors import ConvergenceError, InputError
from granum.studies import chunks, engine, store
from granum.studies.study import Study


def spread(folder: Path, **how: Any) -> Any:
    return studies.monte_carlo(STOKES, SPREAD, **{"fixed": SLURRY, "samples": 160, "folder": folder} | how)


@pytest.fixture(autouse=True)
def _small_chunks(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(chunks.CHUNKS, "batched", 32)


@pytest.fixture
def kept(tmp_path: Path) -> Path:
    """A finished study in five chunks."""
    assert spread(tmp_path / "kept").complete
    return tmp_path / "kept"


def by_hand(found: Any) -> np.ndarray:
    """Stokes' law, written again."""
    return (2650.0 - 1000.0) * 9.80665 * found.column("particle_diameter") ** 2 / (18 * 1e-3)


def flip(path: Path, place: int) -> None:
    content = bytearray(path.read_bytes())
    content[place] ^= 0xFF
    path.write_bytes(bytes(content))


def truncated(chunk: Path, _tmp: Path) -> None:
    chunk.write_bytes(chunk.read_bytes()[:200])


def emptied(chunk: Path, _tmp: Path) -> None:
    chunk.write_bytes(b"")


def one_byte_of_a_number(chunk: Path, _tmp: Path) -> None:
    flip(chunk, 150)  # inside the figures, behind the headers of the archive and of the array


def its_last_byte(chunk: Path, _tmp: Path) -> None:
    flip(chunk, -1)


def of_another_study(chunk: Path, tmp: Path) -> None:
    spread(tmp / "other", fixed={**SLURRY, "dynamic_viscosity": 2e-3})
    shutil.copy(tmp / "other" / chunk.name, chunk)


def another_chunk_of_this_study(chunk: Path, _tmp: Path) -> None:
    shutil.copy(chunk.with_name("cases-000000064.npz"), chunk)


def of_another_shape(chunk: Path, _tmp: Path) -> None:
    with chunk.open("wb") as file:
        np.savez(file, y=np.ones((7, 3)), codes=np.zeros(7, np.int32), texts="{}")


@pytest.mark.parametrize(
    "harm",
    [
        truncated,
        emptied,
        one_byte_of_a_number,
        its_last_byte,
        of_another_study,
        another_chunk_of_this_study,
        of_another_shape,
    ],
)
def test_a_chunk_that_is_not_what_it_should_be_is_named_and_computed_again(
    kept: Path, tmp_path: Path, harm: Any
) -> None:
    chunk = kept / "cases-000000032.npz"
    harm(chunk, tmp_path)
    computed: list[int] = []
    found = spread(kept, progress=lambda p: computed.append(p.done))
    assert computed == [128, 160]  # four chunks were taken as they are, one computed
    assert found.cases.notes == [
        "'cases-000000032.npz' was damaged or belongs to another study: its cases were computed again."
    ]
    assert found.as_json()["notes"] == found.cases.notes
    assert found.column("terminal_velocity") == pytest.approx(by_hand(found), rel=1e-12)
    assert spread(kept).cases.notes == []  # whole again


@pytest.mark.parametrize(
    "content",
    ["", "{", '{"study": "x"}', "[]", "3", '{"study": 1, "chunk": 0, "check": ""}', "[" * 100_000, "é"],
)
def test_a_broken_manifest_is_one_message(kept: Path, content: str) -> None:
    (kept / "study.json").write_text(content, encoding="latin-1")
    with pytest.raises(InputError, match=r"study\.json' is damaged .* delete the folder"):
        spread(kept)
    assert len(list(kept.glob("cases-*.npz"))) == 5  # nothing is thrown away


def test_a_manifest_whose_chunk_size_was_changed_is_broken(kept: Path) -> None:
    found = json.loads((kept / "study.json").read_text())
    (kept / "study.json").write_text(json.dumps(found | {"chunk": 64}))
    with pytest.raises(InputError, match="is damaged"):
        spread(kept)


def test_a_folder_that_cannot_be_written_is_refused_before_anything_is_computed(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(engine, "evaluator", lambda *_: pytest.fail("computed"))
    (tmp_path / "file").write_text("")
    for folder in (tmp_path / "file", tmp_path / "file" / "below"):
        with pytest.raises(InputError, match="cannot be written"):
            spread(folder)

    def read_only(**_: Any) -> Any:
        raise OSError(errno.EROFS, "Read-only file system")

    monkeypatch.setattr("granum.core.files.tempfile.mkstemp", read_only)
    with pytest.raises(InputError, match="cannot be written: Read-only file system"):
        spread(tmp_path / "new")


def test_a_disk_that_fills_up_keeps_what_was_computed(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    written = store.write_atomic

    def full(path: Path, content: Any) -> None:
        if len(list(tmp_path.glob("kept/cases-*"))) == 2:
            raise InputError(f"'{path}' cannot be written: No space left on device.")
        written(path, content)

    with monkeypatch.context() as patched:
        patched.setattr(store, "write_atomic", full)
        with pytest.raises(InputError, match=r"No space left on device\. 64 of 160 cases are kept"):
            spread(tmp_path / "kept")
    seen: list[int] = []
    assert spread(tmp_path / "kept", progress=lambda p: seen.append(p.done)).complete
    assert seen[0] == 64


def test_a_finished_study_is_read_without_compiling(kept: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(engine, "evaluator", lambda *_: pytest.fail("computed"))
    found = spread(kept)
    assert found.complete
    assert found.column("terminal_velocity") == pytest.approx(by_hand(found), rel=1e-12)


def test_a_study_goes_on_in_chunks_of_another_size(kept: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Less memory, or workers instead of threads, make other chunks: those on disk keep theirs."""
    (kept / "cases-000000064.npz").unlink()
    monkeypatch.setitem(chunks.CHUNKS, "batched", 8)
    found = spread(kept)
    assert found.column("terminal_velocity") == pytest.approx(by_hand(found), rel=1e-12)


def test_a_study_without_any_result_is_an_error_with_the_reason() -> None:
    endless = {"outputs": ["terminal_velocity / (terminal_velocity - terminal_velocity)"], "fixed": SLURRY}
    with pytest.raises(
        ConvergenceError, match=r"None of the 50 cases has a result: 50 × result '.*' is not a finite number"
    ) as caught:
        studies.monte_carlo(STOKES, SPREAD, samples=50, **endless)
    assert caught.value.exit_code == 3
    assert not caught.value.last.fine.any()


def test_failed_cases_stand_beside_each_statistic() -> None:
    """Of a normal size whose mean is one standard deviation, 15.9 % lie below zero; the median of the others
    is that of the rest.
    """
    wide = {"particle_diameter": {"distribution": "normal", "mean": "10 um", "standard_deviation": "10 um"}}
    row = studies.monte_carlo(STOKES, wide, fixed=SLURRY, samples=1000).findings()["statistics"][
        "terminal_velocity"
    ]
    assert (row["cases"], row["failed"]) == (1000, pytest.approx(159, abs=2))
    left = NormalDist(10e-6, 10e-6)
    middle = left.inv_cdf(0.5 + 0.5 * left.cdf(0.0))
    assert row["p50"] == pytest.approx((2650.0 - 1000.0) * 9.80665 * middle**2 / (18 * 1e-3), rel=0.02)


@pytest.mark.parametrize(
    "count", [0, -1, 10**12, 1.5, float("inf"), float("nan"), "1e3", "many", 10**5000], ids=range(9)
)
def test_counts_are_bounded(count: Any) -> None:
    over = {"particle_diameter": {"from": "1 um", "to": "9 um", "steps": count}}
    tables: list[tuple[str, dict[str, Any]]] = [
        ("monte_carlo", {"samples": count}),
        ("sobol", {"samples": count}),
        ("sweep", {"over": over}),
        ("map", {"over": over | {"dynamic_viscosity": {"from": "1 cP", "to": "2 cP", "steps": count}}}),
        (
            "optimize",
            {
                "over": {"particle_diameter": ["1 um", "9 um"]},
                "maximize": "terminal_velocity",
                "starts": count,
            },
        ),
    ]
    for kind, table in tables:
        with pytest.raises(InputError, match="must be a whole number from") as caught:
            Study.of(
                kind, table, studies.subject_of(STOKES, SLURRY | {"particle_diameter": 5e-6}), SPREAD
            ).run()
        assert len(caught.value.message) < 200


def test_the_command_names_a_bad_chunk_and_refuses_what_it_cannot_write(tmp_path: Path) -> None:
    out, parts = tmp_path / "x.csv", tmp_path / "x.csv.parts"
    read_studies(SETTLING)["spread"].with_options(samples=64).run(folder=parts)
    emptied(parts / "cases-000000000.npz", tmp_path)
    words = (str(SETTLING), "spread", "--samples", "64", "--out")
    code, told, _err = granum("study", *words, str(out))
    assert code == 0
    assert "'cases-000000000.npz' was damaged" in told
    assert not parts.exists()
    (tmp_path / "file").write_text("")
    (tmp_path / "folder.csv").mkdir()
    for place, says in (
        (tmp_path / "file" / "x.csv", "there is no folder"),
        (tmp_path / "folder.csv", "cannot be written: Is a directory"),
    ):
        code, told, err = granum("study", *words, str(place))
        assert (code, told) == (2, "")
        assert says in err
    code, told, err = granum("study", *words, str(out), "--report", str(tmp_path / "none" / "r.html"))
    assert (code, told) == (2, "")
    assert "cannot be written" in err
    parts.mkdir()
    (parts / "study.json").write_text("{")
    code, told, err = granum("study", *words, str(out))
    assert (code, len(err.strip().splitlines())) == (2, 1)
    assert "delete the folder" in err


def test_a_file_that_cannot_be_finished_is_one_message(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def full(*_: Any) -> None:
        raise OSError(errno.ENOSPC, "No space left on device")

    found = spread(tmp_path / "kept", samples=32)
    monkeypatch.setattr("granum.studies.outcome._write", full)
    with pytest.raises(InputError, match="No space left on device"):
        found.save(tmp_path / "x.nc")
    assert [p.name for p in tmp_path.iterdir()] == ["kept"]


def test_ctrl_c_says_how_to_go_on(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    kept = engine.Store.save

    def interrupted(self: Any, start: int, part: Any) -> None:
        kept(self, start, part)
        raise KeyboardInterrupt

    monkeypatch.setattr(engine.Store, "save", interrupted)
    code, _told, err = granum(
        "study", SETTLING, "spread", "--samples", "64", "--out", str(tmp_path / "x.csv")
    )
    assert code == 130
    assert "the same command continues there" in err
    assert list((tmp_path / "x.csv.parts").glob("cases-*.npz"))
