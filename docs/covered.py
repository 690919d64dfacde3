"""How often the 95 % intervals of every lab test contain the truth: ``python docs/covered.py`` draws 400
sheets of each, or of those named, writes ``docs/data/coverage_lab_tests.csv`` and from it the tables of the
chapter on estimation; ``--table`` only the latter.
"""

from __future__ import annotations

import csv
import datetime
import subprocess
import sys
import warnings
from collections.abc import Callable
from pathlib import Path
from typing import Any, NamedTuple

import equinox as eqx
import numpy as np

ROOT = Path(__file__).parent.parent
sys.path.append(str(ROOT))

from tests.sharing.lab_data import data, keys  # noqa: E402

from granum.core import registry  # noqa: E402
from granum.core.i18n import language  # noqa: E402
from granum.core.units import decimal  # noqa: E402
from granum.estimation.least_squares import solved  # noqa: E402

KEPT = ROOT / "docs" / "data" / "coverage_lab_tests.csv"
SHEETS, SEED = 400, 2026
COLUMNS = ["lab_test", "estimate", "points", "sheets", "covered"]
APART = {"filtration.compression_cell": (0.05, 0.01)}  # scatter of each column where it is found with the fit
WHOLE = {  # fitted from the start: what more than one fit says, and the scatters of its columns
    "filtration.deliquoring_curve": {"cake_saturation": 0.01},
    "filtration.slurry_jar": {"dry_cake_mass": 0.01, "wet_cake_mass": 0.01, "cake_volume": 0.01},
}
CONSTANT = ("cake_saturation",)
PAGES = {"en": ROOT / "docs/handbook/estimation.md", "fr": ROOT / "docs/fr/manuel/estimation.md"}
OPENING, CLOSING = "<!-- covered: python docs/covered.py -->\n", "<!-- end of covered -->\n"
HEADS = {
    "en": ("lab test", "points", "estimates", "covered"),
    "fr": ("essai", "points", "estimations", "couvert"),
}


class Derived(eqx.Module):
    """What follows from the parameters, compiled once for all sheets."""

    function: Callable[[Any], Any] = eqx.field(static=True)

    def __call__(self, parameters: Any) -> Any:
        return self.function(parameters)


class Covered(NamedTuple):
    """One estimate of a lab test, and in how many of the sheets that gave an interval this held the truth."""

    lab_test: str
    estimate: str
    points: int
    sheets: int
    covered: int


def tried(key: str, sheets: int = SHEETS) -> list[Covered]:
    """A lab test on sheets drawn from its own model with the scatter that its fit supposes."""
    if key in WHOLE:
        return _whole(key, sheets)
    good = data(key)
    plain = registry.find(key)(**good.columns, **good.conditions).fit()
    problem = plain.problem
    if problem.derived is not None:
        problem = problem.variant(derived=Derived(problem.derived))
    first = np.array([plain[name].value for name in problem.names]) / problem.scale
    exact = problem.prediction(first)
    truth = {name: e.value for name, e in {**plain.parameters, **solved(problem, first).derived}.items()}
    if key in APART:
        sigma = np.array(APART[key])[problem.group]
    else:
        read = np.sort(np.log(np.maximum(good.columns[good.measured], 1e-300)))
        logs = read.shape == exact.shape and np.allclose(np.sort(exact), read, rtol=1e-3, atol=1e-3)
        size = good.scatter * (1.0 if logs else np.median(np.abs(exact[problem.keep])))
        sigma = size * problem.sigma / np.median(problem.sigma[problem.keep])
    rng = np.random.default_rng(SEED)
    given, held = dict.fromkeys(truth, 0), dict.fromkeys(truth, 0)
    for _sheet in range(sheets):
        found = solved(problem.variant(y=exact + sigma * rng.standard_normal(exact.shape)), first)
        for name, value in truth.items():
            low, high = found[name].interval_95
            given[name] += bool(high > low)
            held[name] += bool(low <= value <= high and high > low)
    return [Covered(key, name, int(problem.keep.sum()), given[name], held[name]) for name in truth]


def _whole(key: str, sheets: int) -> list[Covered]:
    """A lab test on sheets whose columns scatter, fitted from the start."""
    good, test = data(key), registry.find(key)
    plain = test(**good.columns, **good.conditions).fit()
    truth = {name: e.value for name, e in {**plain.parameters, **plain.derived}.items()}
    rng = np.random.default_rng(SEED)
    held = dict.fromkeys(truth, 0)
    for _sheet in range(sheets):
        scattered = {
            name: values
            + WHOLE[key].get(name, 0.0)
            * (np.median(values) if name in CONSTANT else values)
            * rng.standard_normal(values.shape)
            for name, values in good.columns.items()
        }
        found = test(**scattered, **good.conditions).fit()
        for name, value in truth.items():
            low, high = found[name].interval_95
            held[name] += bool(low <= value <= high and high > low)
    points = len(next(iter(good.columns.values())))
    return [Covered(key, name, points, sheets, held[name]) for name in truth]


def written(rows: list[Covered]) -> None:
    """The rows as a file, with what is to be known of it beside it."""
    with KEPT.open("w", encoding="utf-8", newline="") as file:
        table = csv.writer(file, lineterminator="\n")
        table.writerow(COLUMNS)
        table.writerows(rows)
    commit = subprocess.run(
        ["git", "rev-parse", "HEAD"], cwd=ROOT, capture_output=True, text=True, check=True
    ).stdout.strip()
    KEPT.with_suffix(".toml").write_text(
        'source = "this project"\n'
        'obtained = "calculated by docs/covered.py: sheets drawn from the model of each lab test, on the '
        'ordinary data of tests/sharing/lab_data.py, with the scatter that its fit supposes"\n'
        f'commit = "{commit}"\ndate = {datetime.date.today()}\nseed = {SEED}\n'
        'columns = "lab_test, estimate: names in the program; points: used by the fit; sheets: those '
        'that gave an interval; covered: those whose 95 % interval held the truth"\n'
        'licence = "own work"\n',
        encoding="utf-8",
    )


def read() -> list[Covered]:
    """The rows of the file."""
    with KEPT.open(encoding="utf-8", newline="") as file:
        return [
            Covered(r["lab_test"], r["estimate"], int(r["points"]), int(r["sheets"]), int(r["covered"]))
            for r in csv.DictReader(file)
        ]


def table(rows: list[Covered], code: str) -> str:
    """The rows as a table of the chapter: one line for each test, from its least to its best covered
    estimate.
    """
    lines = [f"| {' | '.join(HEADS[code])} |", "|---|--:|--:|--:|"]
    with language(code):
        for key in dict.fromkeys(row.lab_test for row in rows):
            own = [row for row in rows if row.lab_test == key and row.sheets]
            shares = sorted({f"{100 * row.covered / row.sheets:.1f}" for row in own}, key=float)
            ends = [decimal(share) for share in dict.fromkeys((shares[0], shares[-1]))]
            join, percent = (" to ", "%") if code == "en" else (" à ", " %")
            title = registry.find(key).card.title
            lines.append(
                f"| [{title}](card:{key}) | {own[0].points} | {len(own)} | {join.join(ends)}{percent} |"
            )
    return "\n".join(lines) + "\n"


def main() -> None:
    """Draw, write, and show."""
    warnings.simplefilter("ignore")
    asked = [a for a in sys.argv[1:] if a != "--table"]
    if "--table" not in sys.argv:
        made = [row for row in read() if row.lab_test not in asked] if asked else []
        for key in asked or keys():
            rows = tried(key)
            print(*rows, sep="\n", flush=True)
            made += rows
        written(sorted(made, key=lambda row: row.lab_test))
    for code, place in PAGES.items():
        page = place.read_text(encoding="utf-8")
        head, rest = page.split(OPENING)
        place.write_text(head + OPENING + table(read(), code) + CLOSING + rest.split(CLOSING)[1], "utf-8")


if __name__ == "__main__":
    main()
