"""A line that one app has solved begins faster in the next: its workers keep the programs they traced."""

from __future__ import annotations

import os
import time
from pathlib import Path
from typing import Any

import httpx
import pytest

from granum.app.jobs import Crew
from granum.app.server import create_app
from granum.core import kept

CASE = (Path(__file__).parents[2] / "examples" / "cyclone" / "pair.toml").read_text(encoding="utf-8")
LONG_AGO = 1e9


def answered(serve: Any, monkeypatch: pytest.MonkeyPatch, folder: Path) -> dict[str, Any]:
    """What a fresh app says of the line; its worker has rested when this returns."""
    crew = Crew(count=1)
    monkeypatch.setattr("granum.app.server.crew", lambda: crew)
    try:
        with serve(create_app()) as address:
            answer = httpx.post(f"{address}/api/run", json={"case": CASE}, timeout=300.0)
        until, written = time.monotonic() + 120.0, 0
        while time.monotonic() < until:  # what it warmed up with is written first, then what it was asked
            time.sleep(1.0)
            before, written = written, len(list(folder.glob(f"*{kept.ENDING}")))
            if written and written == before:
                break
    finally:
        crew.close()
    assert answer.status_code == 200, answer.text
    return answer.json()


def test_the_next_app_finds_what_the_workers_of_this_one_traced(
    serve: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    folder = tmp_path / "traced"
    kept.keep_in(folder)
    try:
        first = answered(serve, monkeypatch, folder)
        files = list(folder.glob(f"*{kept.ENDING}"))
        assert files, "a worker at rest writes what it traced"
        for path in files:
            os.utime(path, (LONG_AGO, LONG_AGO))
        second = answered(serve, monkeypatch, folder)
    finally:
        kept.keep_in(None)
    assert any(path.stat().st_mtime > LONG_AGO for path in files), "what is kept is read"
    assert first["units"] == second["units"]


def test_what_is_written_is_let_go(tmp_path: Path) -> None:
    kept.keep_in(tmp_path / "traced")
    try:
        kept.Named(("some", "thing")).put(lambda: 5)
        kept.store()
        assert not kept._pending
        assert kept.Named(("some", "thing")).found() == 5
    finally:
        kept.keep_in(None)
