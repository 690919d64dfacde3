"""Flocculation: tanks balanced one by one, limits of the law, flocs that settle as their fractal says."""

from __future__ import annotations

import jax.numpy as jnp
import numpy as np
import pytest
from scipy.integrate import solve_ivp

from granum.settling.equipment.clarifiers import Clarifier
from granum.settling.equipment.flocculator import Flocculator, coarsen
from granum.settling.formulas.flocculation import (
    aggregation_constant_shear,
    flocculation_ratio_tanks,
    power_stirring,
    settling_growth_fractal,
    velocity_gradient_stirred,
)
from granum.streams.audit import closure
from granum.streams.mixture import Mixture, Species
from granum.streams.stream import empty

EDGES = tuple(np.geomspace(1e-6, 1e-3, 31))
MIXTURE = Mixture(
    solids=(
        Species("clay", (("clay", 1.0),), (2600.0,), (800.0,)),
        Species("oil", (("oil", 1.0),), (880.0,), (2000.0,)),
    ),
    liquids=(Species("water", (("water", 1.0),), (1000.0,), (4180.0,)),),
    gases=(),
    size_edges=EDGES,
    liquid_viscosity=lambda w, T: 1e-3,
)


def turbid(clay=5e-3, oil=1e-3, median=4e-6):
    shares = np.exp(-0.5 * (np.log(np.asarray(MIXTURE.sizes) / median) / 0.5) ** 2)
    shares = jnp.asarray(shares / shares.sum())
    return empty(MIXTURE, 293.15).replace(
        solid=jnp.stack([clay * shares, oil * shares]), liquid=jnp.array([50.0])
    )


def test_tanks_balanced_one_by_one():
    """In each tank: what comes in, less collisions K_A G N, plus breakage K_B G² N₀, is what leaves."""
    G, T, A, B, m = 40.0, 1800.0, 1e-4, 1e-7, 4
    number = 1.0
    for _tank in range(m):
        number = (number + B * G**2 * T / m) / (1.0 + A * G * T / m)
    assert flocculation_ratio_tanks(G, T, A, B, m) == pytest.approx(1.0 / number, rel=1e-12)
    # many tanks without breakage: Smoluchowski's law of plug flow, by integration
    plug = solve_ivp(lambda _t, N: -A * G * N, (0.0, T), [1.0], rtol=1e-10, atol=1e-14)
    many = flocculation_ratio_tanks(G, T, A, 0.0, 1e5)
    assert many == pytest.approx(1.0 / plug.y[0, -1], rel=1e-3)
    # faster stirring first helps, then breaks: there is a best gradient
    ratios = [flocculation_ratio_tanks(g, T, A, B, m) for g in (5.0, 30.0, 60.0, 300.0, 1000.0)]
    best = int(np.argmax(ratios))
    assert 0 < best < 4
    # no stirring, no flocs
    assert flocculation_ratio_tanks(0.0, T, A, B, m) == 1.0


def test_gradient_and_power_are_one_statement():
    power = power_stirring(50.0, 200.0, 1.2e-3)
    assert velocity_gradient_stirred(power, 200.0, 1.2e-3) == pytest.approx(50.0)
    # half a kilowatt, as 2.5 W/m³ of warm water
    assert power == pytest.approx(600.0)
    assert aggregation_constant_shear(1e-3) == pytest.approx(4e-3 / np.pi)


def test_a_fractal_floc_settles_as_its_equivalent_grain():
    k, D, d, apart = 500.0, 2.1, 5e-6, 1600.0
    size = d * k ** (1 / D)
    floc = 9.81 * apart * (size / d) ** (D - 3) * size**2 / 18e-3
    grain = 9.81 * apart * (d * settling_growth_fractal(k, D)) ** 2 / 18e-3
    assert grain == pytest.approx(floc, rel=1e-12)
    assert settling_growth_fractal(k, 1.9) < settling_growth_fractal(k, 2.5)


def test_classes_move_by_one_factor_and_keep_their_mass():
    operator = np.asarray(coarsen(EDGES, 3.7))
    np.testing.assert_allclose(operator.sum(axis=0), 1.0, rtol=1e-14)
    assert operator.min() >= 0.0
    np.testing.assert_allclose(np.asarray(coarsen(EDGES, 1.0)), np.eye(30), atol=1e-12)
    # a class of one decade's tenth moved by that tenth is the next one
    step = EDGES[1] / EDGES[0]
    np.testing.assert_allclose(np.asarray(coarsen(EDGES, step))[1:, :-1], np.eye(29), atol=1e-9)


def test_flocculation_before_a_clarifier_pays():
    feed = turbid()
    unit = Flocculator(volume=90.0, velocity_gradient=40.0, aggregation_constant=3e-4)
    made = unit.operate(feed=feed)
    found = closure([feed], [made.outlets.product])
    assert float(found.mass) < 1e-14
    assert float(found.energy) < 1e-12
    assert float(made.figures.residence_time) == pytest.approx(90.0 / float(feed.slurry_volume_flow))
    assert float(made.figures.shaft_power) == pytest.approx(40.0**2 * 1e-3 * 90.0)
    assert all(check.ok for check in made.checks)
    basin = Clarifier(120.0, 50.0)
    raw, flocs = (basin.operate(feed=x).figures for x in (feed, made.outlets.product))
    assert flocs.removal_efficiency > 2.0 * raw.removal_efficiency
    # drops that join rise faster too
    skimmed = [float(basin(x).skimmings.solid[1].sum()) for x in (feed, made.outlets.product)]
    assert skimmed[1] > skimmed[0]
    # left to the volume of the grains, a thin clay hardly joins: it needs sweep floc
    thin = Flocculator(volume=90.0, velocity_gradient=40.0).operate(feed=feed)
    assert 1.0 <= thin.figures.flocculation_ratio < made.figures.flocculation_ratio
