"""Every example of a line with other numbers: it is solved and conserves, or it is refused in words. Nothing
else may happen.
"""

from __future__ import annotations

import numpy as np
import pytest
from tests.sharing.places import EXAMPLES
from tests.sharing.samples import SAMPLES

import granum as gr
from granum.core.errors import GranumError
from granum.core.kinds import Kind

QUICK = (
    "humid-air/line",
    "filters/drum",
    "dryers/paddle",
    "grinding-circuit/circuit",
    "potassium-nitrate/line",
)
LINES = (
    sorted(str(p.relative_to(EXAMPLES))[:-5] for p in EXAMPLES.glob("*/*.toml") if "[units." in p.read_text())
    if SAMPLES
    else QUICK
)


def changed(line, rng: np.random.Generator):
    """One to three parameters of units or flows and temperatures of feeds, half to twice as large, within
    their bounds.
    """
    paths: list[tuple[str, float, Kind | None]] = []
    for unit, thing in line.sheet.units.items():
        for p in type(thing).card.parameters:
            value = getattr(thing, p.name)
            if (
                p.kind is not None
                and not p.series
                and isinstance(value, (float, np.floating))
                and value not in (0.0, np.inf)
            ):
                paths.append((f"{unit}.{p.name}", float(value), p.kind))
    values = {}
    for i in rng.choice(len(paths), size=min(rng.integers(1, 4), len(paths)), replace=False):
        path, value, kind = paths[i]
        new = (
            value + rng.normal(0.0, 15.0)
            if kind.name == "temperature"
            else value * float(np.exp(rng.uniform(-0.7, 0.7)))
        )
        values[path] = (
            float(np.clip(new, kind.lower, kind.upper))
            if kind.contains(np.clip(new, kind.lower, kind.upper))
            else value
        )
    for name, feed in line.sheet.feeds.items():
        share = float(np.exp(rng.uniform(-0.5, 0.5)))
        values |= {
            f"{name}.{phase}": np.asarray(getattr(feed, phase)) * share
            for phase in ("solid", "liquid", "gas")
        }
        values[f"{name}.temperature"] = np.asarray(feed.temperature + rng.normal(0.0, 5.0))
    targets = {t.vary for t in line.targets}
    return line.with_values(**{path: value for path, value in values.items() if path not in targets})


@pytest.mark.parametrize("name", LINES)
def test_a_changed_example_is_solved_or_refused(name: str) -> None:
    line, rng = gr.read(EXAMPLES / f"{name}.toml"), np.random.default_rng(len(name))
    solved, refused = 0, []
    for _ in range(SAMPLES or 12):
        try:
            run = changed(line, rng).solve()
        except GranumError as problem:
            refused.append(problem.message)
            continue
        solved += 1
        feeds, products = (
            [run.streams[n] for n in names] for names in (line.sheet.feeds, line.sheet.products)
        )
        entering, leaving = (sum(np.asarray(s.components) for s in side) for side in (feeds, products))
        assert np.abs(leaving - entering).max() <= 1e-9 * entering.sum()
        assert all(
            np.min(x, initial=0.0) >= -1e-9 * entering.sum()
            for s in products
            for x in map(np.asarray, (s.solid, s.liquid, s.gas))
        )
    print(f"{name}: {solved} solved, {len(refused)} refused", *sorted(set(refused)), sep="\n  ")
    assert solved
