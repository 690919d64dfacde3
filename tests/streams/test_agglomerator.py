"""The agglomerator against closed forms for the number of particles; axes gathered into parts give the same
answer.
"""

from __future__ import annotations

import jax.numpy as jnp
import numpy as np
import pytest

import granum as gr
from granum.core import registry
from granum.core.packing import compiled
from granum.flowsheet import Flowsheet, gather_axes
from granum.streams.mixture import Mixture, Species
from granum.streams.stream import Stream, empty

SAND = Species("sand", (("sand", 1.0),), (2000.0,), (800.0,), 0.0, 0.06)
FLOW, HELD, VOLUME, COEFFICIENT = 0.01, 20.0, 0.5, 2e-13  # kg/s, kg, m³, m³/s
GRIDS = {"even in volume": np.cbrt(np.linspace(0.0, 1e-9, 151)), "geometric": np.geomspace(2e-5, 2e-3, 101)}


def bed():
    kernel = {"law": "constant_kernel", "agglomeration_coefficient": COEFFICIENT}
    return registry.find("streams.agglomerator")(agglomeration_kernel=kernel, holdup_mass=HELD, volume=VOLUME)


def feed_on(edges: np.ndarray) -> tuple[Stream, np.ndarray]:
    """Particles of about 200 µm, and the volume of one of each class."""
    volumes = np.pi / 6.0 * edges**3
    middle = 0.5 * (volumes[1:] + volumes[:-1])
    size = np.cbrt(6.0 / np.pi * middle)
    share = np.exp(-(((size - 2e-4) / 4e-5) ** 2)) * np.diff(edges)
    mixture = Mixture((SAND,), (), (), tuple(edges))
    return empty(mixture, 300.0).replace(solid=jnp.asarray(FLOW * share / share.sum())[None]), middle


@pytest.mark.parametrize("grid", GRIDS)
def test_number_of_a_constant_kernel(grid: str) -> None:
    """dN/dt = N_in - N/τ - β N²/(2V), whatever the sizes (Smoluchowski 1917): its steady state, and its start
    from the feed.
    """
    feed, middle = feed_on(GRIDS[grid])
    unit, time = bed(), HELD / FLOW
    entering = float(jnp.sum(feed.solid[0] / middle)) / 2000.0
    pairs = 0.5 * COEFFICIENT / VOLUME
    root = np.sqrt(1.0 / time**2 + 4.0 * pairs * entering)
    steady = (root - 1.0 / time) / (2.0 * pairs)
    out = compiled(lambda u, f: u(f).product)(unit, feed)
    assert float(jnp.sum(out.solid[0] / middle)) / 2000.0 * time == pytest.approx(steady, rel=1e-9)
    assert float(out.solid_flow) == pytest.approx(FLOW, rel=1e-12)
    assert steady < 0.7 * entering * time  # enough of them meet

    inlet, state = {"feed": feed}, feed.solid * time
    step = 20.0
    advance = compiled(lambda u, held, prepared: u.advance(held, inlet, inlet, step, prepared)[0])
    prepared = unit.prepare(feed.mixture, step)
    for _ in range(50):
        state = advance(unit, state, prepared)
    other = (1.0 / time + root) / (2.0 * pairs)  # minus the second root of the right-hand side
    ratio = (entering * time - steady) / (entering * time + other) * np.exp(-root * 1000.0)
    expected = (steady + other * ratio) / (1.0 - ratio)
    assert float(jnp.sum(state[0] / middle)) / 2000.0 == pytest.approx(expected, rel=2e-5)


def test_a_kernel_that_is_no_sum_of_products() -> None:
    """Pairs one by one and by Fourier transform give the same: a kernel with a corner against one close to
    constant.
    """
    from granum.streams.equipment.agglomerator import _joined_evenly, meetings_of

    n = 40
    i = jnp.arange(n) + 0.5
    smooth, corner = (
        (i[:, None] + i[None, :]) ** 2 / (i[:, None] * i[None, :]),
        jnp.abs(i[:, None] - i[None, :]) ** 0.5,
    )
    numbers, solid = jnp.exp(-i / 5.0), jnp.stack([i * jnp.exp(-i / 6.0), i], axis=1)
    for kernel, exact in ((smooth, True), (corner, False)):
        meetings = meetings_of(kernel)
        assert bool(meetings.exact) is exact
        found = np.asarray(_joined_evenly(meetings, numbers, solid))
        expected = np.zeros_like(found)
        for j in range(n):
            expected[j : j + n] += np.asarray(kernel[j] * numbers[j])[:, None] * np.asarray(solid)
        assert np.allclose(found, expected, rtol=1e-10, atol=1e-12 * expected.max())


def test_axes_gathered() -> None:
    """Three distributions over ten classes, two of them fed, one at the start-up: the same streams come
    back.
    """
    axis = tuple(np.linspace(0.0, 1.0, 11))
    mixture = Mixture((SAND,), (), (), (1e-5, 1e-4, 1e-3), (("porosity", axis),))
    narrow, wide = np.exp(-((np.arange(10) - 4.0) ** 2)), np.ones(10)
    solid = jnp.asarray(np.stack([narrow / narrow.sum(), 2.0 * wide / 10.0])[None])
    feed = empty(mixture, 300.0).replace(solid=solid)
    tank = gr.streams.StirredTank(mass=100.0)
    few = gather_axes(Flowsheet({"tank": tank}, {"f": feed}, {"f": ("", "tank"), "p": ("tank", "")}))
    assert few.parts.shape == (3, 10)
    assert np.allclose(few.spread(few.line.feeds["f"]).solid, solid, atol=1e-15)
    assert few.line.feeds["f"].solid_flow == pytest.approx(3.0)
