"""Every comparison in one go, each script in a process of its own, one after the other."""

from __future__ import annotations

import datetime
import json
import os
import platform
import subprocess
import sys
import tempfile
from dataclasses import asdict, replace
from importlib.metadata import version
from pathlib import Path
from typing import Annotated, Any

import typer

import granum
from benchmarks.rows import COLLECTOR, Row
from benchmarks.tables import rewritten, table

HERE = Path(__file__).parent
PAGE = HERE.parent / "docs" / "benchmarks.md"
HELPERS = {"__init__", "__main__", "commands", "rows", "tables"}
SCRIPTS = sorted({path.stem for path in HERE.glob("*.py")} - HELPERS)


def machine() -> dict[str, Any]:
    """What the figures depend on besides the program."""
    told = Path("/proc/cpuinfo")
    names = [line for line in told.read_text().splitlines() if "model name" in line] if told.exists() else []
    allowed = getattr(os, "sched_getaffinity", None)
    return {
        "date": datetime.date.today().isoformat(),
        "processor": names[0].partition(":")[2].strip() if names else platform.processor(),
        "cores": f"{len(allowed(0))} of {os.cpu_count()}" if allowed else str(os.cpu_count()),
        "python": platform.python_version(),
        "jax": version("jax"),
        "granum": granum.__version__,
    }


def command(script: str) -> list[str]:
    """How a script is run."""
    return [sys.executable, "-m", f"benchmarks.{script}"]


def collected(script: str) -> tuple[list[Row], str]:
    """The rows that a script hands over, and its last words if it fails."""
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "rows"
        file.touch()
        done = subprocess.run(
            command(script),
            cwd=HERE.parent,
            env=os.environ | {COLLECTOR: str(file)},
            stderr=subprocess.PIPE,
            text=True,
            check=False,
        )
        lines = file.read_text(encoding="utf-8").splitlines()
    said = [line.strip() for line in done.stderr.splitlines() if line.strip()] or [""]
    failure = f"exit status {done.returncode}: {said[-1]}" if done.returncode else ""
    return [replace(Row(**json.loads(line)), script=script) for line in lines], failure


def pages(runs: dict[str, Any]) -> dict[str, str]:
    """The tables of all kinds by kind, each with where and when it was measured."""
    found: dict[str, list[Row]] = {}
    places: dict[str, dict[str, None]] = {}
    for run in runs.values():
        where = "{date}: {cores} cores ({processor}), Python {python}, JAX {jax}".format(**run["machine"])
        for row in (Row(**row) for row in run["rows"]):
            found.setdefault(row.kind, []).append(row)
            places.setdefault(row.kind, {})[where] = None
    return {kind: f"{table(rows)}\n\nMeasured on {'; '.join(places[kind])}." for kind, rows in found.items()}


def main(
    names: Annotated[
        list[str] | None,
        typer.Argument(help=f"Scripts to run, all when none is named: {', '.join(SCRIPTS)}."),
    ] = None,
    results: Annotated[
        Path,
        typer.Option(
            "--json",
            help="Where the rows go; those of scripts that do not run are kept.",
            show_default="benchmarks/results.json",
        ),
    ] = HERE / "results.json",
    write: Annotated[bool, typer.Option("--write", help="Rewrite the tables of docs/benchmarks.md.")] = False,
) -> None:
    """Measure Granum beside its peers: every script of benchmarks/, or the named ones."""
    chosen = names or SCRIPTS
    if unknown := set(chosen) - set(SCRIPTS):
        raise typer.BadParameter(f"No script is named {', '.join(sorted(unknown))}.")
    runs = json.loads(results.read_text(encoding="utf-8")) if results.exists() else {}
    failures = {}
    for turn, script in enumerate(chosen, 1):
        print(f"[{turn}/{len(chosen)}] {script}", flush=True)
        rows, failure = collected(script)
        if rows:
            runs[script] = {"machine": machine(), "rows": [asdict(row) for row in rows]}
            text = json.dumps(dict(sorted(runs.items())), ensure_ascii=False, indent=1)
            results.write_text(text + "\n", encoding="utf-8")
        if failure:
            failures[script] = failure
            print(f"  failed, {failure}", file=sys.stderr, flush=True)
    if write:
        PAGE.write_text(rewritten(PAGE.read_text(encoding="utf-8"), pages(runs)), encoding="utf-8")
    for script, failure in failures.items():
        print(f"{script} failed, {failure}", file=sys.stderr)
    raise typer.Exit(1 if failures else 0)


if __name__ == "__main__":
    typer.run(main)
