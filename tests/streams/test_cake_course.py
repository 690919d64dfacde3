"""A cake from its first layer to its discharge, as the charts of filters and filtering centrifuges have it:
times and ends are those of the machine, the growth is Ruth's parabola.
"""

from __future__ import annotations

import random
from typing import Any

import jax
import jax.numpy as jnp
import numpy as np
import pytest

import granum
from granum.cases.alone import case_text
from granum.cases.reading import read_text
from granum.core.errors import GranumError
from granum.core.index import entries
from granum.core.registry import find
from granum.flowsheet.run import Run
from granum.streams.cake_course import Stage
from granum.streams.cake_maker import CakeMaker

MACHINES = [
    key
    for key, card in entries().items()
    if card.sort == "equipment"
    and key.startswith(("filtration.", "centrifuges."))
    and issubclass(find(key), CakeMaker)
]


def course(key: str, **words: str) -> tuple[Run, list[Stage], Any]:
    """The run of a machine alone, its stages, and its unit."""
    line = read_text(case_text(key, words), name=key)
    run = line.solve()
    name = key.partition(".")[2]
    unit: Any = line.sheet.units[name]
    inlets = jax.tree.map(jnp.asarray, line.sheet.inlets_of(name, run.streams))
    return run, unit.stages(unit.inside(**inlets), **inlets), unit


@pytest.mark.parametrize("key", MACHINES)
def test_the_course_of_a_cake_ends_as_the_machine_says(key: str) -> None:
    run, stages, unit = course(key)
    figures = run.units[key.partition(".")[2]].values
    assert sum(float(s.time[-1]) for s in stages) == pytest.approx(figures.cycle_time, rel=1e-9)
    for stage in stages:
        assert np.all(np.diff(stage.time) >= 0.0)
        assert len(stage.time) == len(stage.thickness) == len(stage.saturation)
    thick = np.concatenate([s.thickness for s in stages])
    wet = np.concatenate([s.saturation for s in stages])
    squeezed = getattr(unit, "squeezed", lambda: 1.0)()
    solid = 1.0 - unit.void_fraction
    end = figures.cake_thickness * (solid + unit.void_fraction * squeezed)
    assert thick[np.isfinite(thick)][-1] == pytest.approx(float(end), rel=1e-6)
    held = wet[np.isfinite(wet)]
    assert np.all(np.diff(held) <= 1e-12), "a cake only loses liquid"
    assert held[-1] == pytest.approx(figures.cake_saturation, rel=1e-6)


def test_half_a_cake_forms_in_a_quarter_of_the_time_and_on_a_candle_in_less() -> None:
    # Ruth without a medium: the time is that of the filtrate squared
    _run, (forming, *_rest), unit = course("filtration.nutsche", medium_resistance="0 1/m")
    half = np.interp(0.5 * unit.full_thickness, forming.thickness, forming.time)
    assert half == pytest.approx(0.25 * forming.time[-1], rel=2e-3)
    # on a cylinder the outer half is the larger part of the filtrate, so that less than a quarter passes
    _run, (forming, *_rest), unit = course(
        "filtration.candle_filter",
        medium_resistance="0 1/m",
        candle_radius="20 mm",
        full_cake_thickness="20 mm",
    )
    middle = np.interp(0.010, forming.thickness, forming.time) / forming.time[-1]
    # by hand, r0 = 1, r = 2 and 1.5: r²/2 ln r − (r² − 1)/4
    whole, part = 2.0 * np.log(2.0) - 0.75, 1.125 * np.log(1.5) - 0.3125
    assert middle == pytest.approx(part / whole, rel=5e-3)


@pytest.mark.parametrize("key", ["centrifuges.pusher", "filtration.precoat_drum", "filtration.tower_press"])
def test_a_machine_draws_whatever_its_feed(key: str) -> None:
    line, rng = granum.alone(key), random.Random(key)
    drawn = 0
    for _trial in range(3):
        flow = float(line.sheet.feeds["feed"].solid_flow) * 10.0 ** rng.uniform(-1.0, 0.7)
        try:
            run = line.with_values(**{"feed.solid_flow": flow}).solve()
        except GranumError:
            continue
        (figure,) = (f for h, f in run.charts().items() if h.endswith("A cake through its cycle"))
        for trace in figure.data:
            assert np.nanmin(np.asarray(trace.y, dtype=float)) >= 0.0
        drawn += 1
    assert drawn
