"""The potassium nitrate line: derivatives of every result with respect to inputs of every unit and feed equal
differences, through the recycle.
"""

from __future__ import annotations

import jax
import jax.numpy as jnp
import numpy as np
import pytest
from tests.sharing.places import EXAMPLES

import granum as gr
from granum.cases import read_studies
from granum.core.packing import compiled
from granum.studies.lines import LineSubject

FOLDER = EXAMPLES / "potassium-nitrate"
INPUTS = (
    "crystallizer.temperature",
    "crystallizer.volume",
    "crystallizer.growth.growth_coefficient",
    "crystallizer.nucleation.nucleation_order",
    "thickener.area",
    "thickener.underflow_concentration",
    "filter.area",
    "filter.cake_resistance",
    "filter.void_fraction",
    "filter.belt_speed",
    "air_heater.temperature",
    "dryer.residence_time",
    "dryer.gas_velocity",
    "screen.separation.cut_size",
    "purge.side_fraction",
    "hot_liquor.temperature",
    "hot_liquor.liquid_flow",
    "hot_liquor.liquid.water",
    "ambient_air.gas_flow",
    "ambient_air.temperature",
)
STREAMS = (
    "crystals.solid_flow",
    "crystals.median_size",
    "recycle.mass_flow",
    "recycle.temperature",
    "exhaust_air.gas.water",
)


@pytest.fixture(scope="module")
def line():
    # away from the class boundary at 200 µm, where shares read from a size distribution have a corner
    return gr.read(FOLDER / "line.toml").with_values(**{"screen.separation.cut_size": 212e-6})


@pytest.fixture(scope="module")
def subject(line):
    return LineSubject.of(line)


@pytest.fixture(scope="module")
def outputs(subject):
    return (*subject.outputs(), *STREAMS)


@pytest.fixture(scope="module")
def along(subject, outputs):
    """Figures, and their derivative along a direction, for inputs relative to those of the case; compiled
    once.
    """
    run, numbers = subject.traced(INPUTS, outputs), subject.numbers()
    start = jnp.array([subject.nominal(p) for p in INPUTS])
    return compiled(lambda z, d: jax.jvp(lambda z: run(numbers, start * z)[0], (z,), (d,)))


@pytest.fixture(scope="module")
def value(along):
    return lambda z: along(jnp.asarray(z), jnp.zeros(len(INPUTS)))[0]


@pytest.mark.long
def test_every_derivative_equals_differences(outputs, along, value) -> None:
    def slope(direction: np.ndarray) -> np.ndarray:
        return along(jnp.ones(len(INPUTS)), jnp.asarray(direction))[1]

    figures = value(jnp.ones(len(INPUTS)))
    nothing = np.abs(figures) < 1e-9
    far = []
    for i, direction in enumerate(np.eye(len(INPUTS))):
        exact = slope(direction)
        miss = np.full(len(outputs), np.inf)
        # fourth order: the best step for each figure, some being curved and some all but flat
        for h in (1e-3, 3e-4, 1e-4):
            two, one, fore, aft = (value(1.0 + k * h * direction) for k in (-2, -1, 1, 2))
            difference = (two - 8.0 * one + 8.0 * fore - aft) / (12.0 * h)
            # an elasticity below 0.01 is compared to 1e-8 of the figure: the rounding of the differences is
            # not smaller
            miss = np.minimum(
                miss,
                np.abs(exact - difference) / np.maximum(np.abs(difference), 1e-2 * np.abs(figures) + 1e-30),
            )
            if np.all((miss < 1e-6) | nothing):
                break
        far += [(INPUTS[i], outputs[j], miss[j]) for j in np.flatnonzero(~(miss < 1e-6) & ~nothing)]
    assert not far
    assert nothing.sum() <= 2
    # warmer mother liquor keeps more salt
    assert slope(np.eye(len(INPUTS))[0])[outputs.index("crystals.solid_flow")] < 0.0


def test_figures_of_the_subject_are_those_of_the_run(line, outputs, value) -> None:
    """A study sees the same line as ``granum run``."""
    run, figures = line.solve(), dict(zip(outputs, value(jnp.ones(len(INPUTS))), strict=True))
    for path in ("crystallizer.mass_median_size", "filter.moisture_dry_basis", "dryer.evaporation_rate"):
        assert figures[path] == pytest.approx(run.figure(path), rel=1e-9)
    assert figures["crystals.solid_flow"] == pytest.approx(
        float(run.streams["crystals"].solid_flow), rel=1e-9
    )


@pytest.mark.long
def test_spread_of_the_example() -> None:
    """A cake resistance that spreads by 1.6 moves the moisture; the product is fixed by the balance to within
    a few per cent.
    """
    found = read_studies(FOLDER / "studies.toml")["spread"].with_options(samples=128).run()
    rows = found.findings()["statistics"]
    assert found.counts()["failed"] == 0
    assert rows["product"]["p90"] / rows["product"]["p10"] < 1.05
    ranks = found.rank_correlations()
    assert ranks["product"]["hot_liquor.temperature"] is not None
    assert (
        max(ranks["crystals.median_size"], key=lambda n: abs(ranks["crystals.median_size"][n]))
        == "crystallizer.growth.growth_coefficient"
    )
