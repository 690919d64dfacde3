"""Agglomeration and breakage against their closed solutions; the grid engine against the packets."""

from __future__ import annotations

import jax
import jax.numpy as jnp
import numpy as np
import pytest
from jax import lax
from tests.sharing.crystallization import DURATION, START, linear_cooling, model, seeds

from granum.core.errors import ApplicabilityError, InputError
from granum.crystallization.formulas.agglomeration import (
    Attrition,
    ConstantKernel,
    PowerBreakage,
    ProductKernel,
    SumKernel,
    TurbulentKernel,
)
from granum.crystallization.formulas.growth import PowerLawDissolution
from granum.crystallization.population.grid import Classes, Collisions, check_classes, classes_of, fragments
from granum.crystallization.population.lagrangian import march
from granum.crystallization.population.moment_equations import march_moments
from granum.crystallization.population.operations import Programmed
from granum.crystallization.population.packets import Seeds, mean_power


def exponential(cells, low, high):
    """Volume classes, and the numbers of exp(-v) in them: those below the grid join its first class."""
    v = np.concatenate([[0.0], np.geomspace(low, high, cells)])
    edges = jnp.asarray(v ** (1 / 3))
    number = jnp.asarray(np.exp(-v[:-1]) - np.exp(-v[1:]))
    # Every class with its exact volume as well: the mean cube of exp(-v) inside it.
    volume = (1 + v[:-1]) * np.exp(-v[:-1]) - (1 + v[1:]) * np.exp(-v[1:])
    values = (
        jnp.stack([number * mean_power(edges[:-1], edges[1:], k) for k in range(5)], axis=1)
        .at[:, 3]
        .set(volume)
    )
    return Classes(edges[:-1], edges[1:], values, 0, 1)


def collide(classes, collisions, end, steps):
    step = lambda c, _: (collisions.act(c, 1.0, end / steps)[0], None)  # noqa: E731
    return jax.jit(lambda c: lax.scan(step, c, None, length=steps)[0])(classes)


def second_volume_moment(classes):
    return float(jnp.sum(classes.values[:, 0] * classes.cubes**2))


CASES = [
    (ConstantKernel(1.0), 100.0, 2000, (1e-3, 3e3), 2 / (2 + 100.0), 102.0, 0.02),
    (SumKernel(1.0), 1.0, 400, (1e-3, 1e3), np.exp(-1.0), 2 * np.exp(2.0), 0.05),
    (ProductKernel(1.0), 0.3, 400, (1e-3, 1e3), 1 - 0.15, 2 / (1 - 2 * 0.3), 0.05),
]


@pytest.mark.parametrize(
    ("kernel", "end", "steps", "span", "count", "second", "error"), CASES, ids=["constant", "sum", "product"]
)
def test_agglomeration_of_an_exponential_distribution(kernel, end, steps, span, count, second, error):
    """Smoluchowski's moments in closed form: N(t) and the second moment of volume; volume itself is kept."""
    start = exponential(80, *span)
    out = collide(start, Collisions(agglomeration=kernel), end, steps)
    assert float(out.moments()[3]) == pytest.approx(float(start.moments()[3]), rel=1e-10)
    assert float(out.moments()[0]) == pytest.approx(count, rel=error)
    assert second_volume_moment(out) == pytest.approx(second, rel=2 * error)
    assert bool(jnp.all(out.values >= 0))


def test_breakage_of_ziff_and_mcgrady():
    """S = v and uniform binary fragments: n = (1 + t)^2 exp(-v (1 + t)), so 1 + t particles."""
    start = exponential(80, 1e-4, 30.0)
    law, t = PowerBreakage(1.0, 1.0, 3.0), 10.0
    kept = start.cubes @ fragments(law, start.cubes, start.low, start.high)
    np.testing.assert_allclose(kept, start.cubes, rtol=1e-12)
    out = collide(start, Collisions(breakage=law), t, 2000)
    assert float(out.moments()[3]) == pytest.approx(float(start.moments()[3]), rel=1e-9)
    assert float(out.moments()[0]) == pytest.approx(1 + t, rel=0.03)
    v = np.append(np.asarray(start.low), float(start.high[-1])) ** 3
    exact = (1 + t) * (np.exp(-v[:-1] * (1 + t)) - np.exp(-v[1:] * (1 + t)))
    assert float(np.sum(np.abs(np.asarray(out.values[:, 0]) - exact))) < 0.04 * (1 + t)


def test_attrition_keeps_volume():
    start = exponential(60, 1e-4, 30.0)
    kept = start.cubes @ fragments(Attrition(1.0, 1.0, 3.0, 0.02), start.cubes, start.low, start.high)
    np.testing.assert_allclose(kept, start.cubes, rtol=1e-12)


def classed_seeds():
    """The published seeds, with empty classes above them for what agglomerates."""
    found = seeds()
    above = jnp.geomspace(110e-6, 1500e-6, 31)
    return Seeds(
        jnp.append(found.low, above[:-1]),
        jnp.append(found.high, above[1:]),
        jnp.append(found.number, jnp.zeros(30)),
    )


TIMES = jnp.linspace(0.0, DURATION, 401)


def test_classes_agree_with_packets_and_moments_on_the_published_batch():
    none = Collisions(agglomeration=ConstantKernel(0.0), nuclei_classes=40)
    found = march(model(), Programmed(linear_cooling), classed_seeds(), START, 1.0, TIMES, none)
    packets = march(model(), Programmed(linear_cooling), seeds(), START, 1.0, TIMES)
    moments = march_moments(model(), Programmed(linear_cooling), seeds(), START, 1.0, TIMES[::100])
    total = found.solute_per_solvent + found.crystals
    assert float(jnp.max(jnp.abs(total - total[0]))) < 1e-13
    np.testing.assert_allclose(found.moments, packets.moments, rtol=1e-9)
    np.testing.assert_allclose(found.moments[::100], moments, rtol=1e-4)
    np.testing.assert_allclose(found.solute_per_solvent, packets.solute_per_solvent, rtol=1e-12)


@pytest.mark.long
def test_constant_kernel_in_a_growing_batch():
    """With a constant kernel dN/dt = B V - beta N^2 / (2 V), whatever grows: here seeds alone, N = N0 / (1 +
    beta N0 t / (2 V)).
    """
    V, beta = 1.0e-3, 1e-11
    few = model(kb=0.0)
    found = march(
        few, Programmed(linear_cooling), classed_seeds(), START, 1.0, TIMES, Collisions(ConstantKernel(beta))
    )
    start = float(found.moments[0, 0])
    exact = start / (1 + beta * start * np.asarray(TIMES) / (2 * V))
    assert exact[-1] < 0.2 * start
    assert bool(jnp.all(found.final.number >= 0))
    assert float(jnp.max(found.collided)) < 0.05
    np.testing.assert_allclose(found.moments[:, 0], exact, rtol=2e-4)
    total = found.solute_per_solvent + found.crystals
    assert float(jnp.max(jnp.abs(total - total[0]))) < 1e-13


@pytest.mark.long
def test_agglomeration_in_a_batch_lowers_the_number_and_keeps_the_mass():
    def run(collisions):
        return march(model(), Programmed(linear_cooling), classed_seeds(), START, 1.0, TIMES, collisions)

    plain = run(Collisions(ConstantKernel(0.0), nuclei_classes=40))
    found = run(Collisions(TurbulentKernel(50.0, 0.05), nuclei_classes=40))
    assert float(found.moments[-1, 0]) < 0.9 * float(plain.moments[-1, 0])
    assert float(found.moments[-1, 4] / found.moments[-1, 3]) > float(
        plain.moments[-1, 4] / plain.moments[-1, 3]
    )
    broken = run(Collisions(breakage=Attrition(1e-4, 3e-4, 3.0, 0.01), nuclei_classes=40))
    assert float(broken.moments[-1, 0]) > float(plain.moments[-1, 0])
    for course in (found, broken):
        total = course.solute_per_solvent + course.crystals
        assert float(jnp.max(jnp.abs(total - total[0]))) < 1e-13


def test_what_classes_cannot_follow_is_refused():
    with pytest.raises(ApplicabilityError, match="only while they grow"):
        check_classes(model(dissolution=PowerLawDissolution(1e-5)), seeds())
    with pytest.raises(InputError, match="side by side"):
        check_classes(model(), Seeds.of_one_size(jnp.array([1e-4, 2e-4]), 1e-3, 1000.0))
    assert classes_of(seeds(), 100, 40).low.shape == (72,)
