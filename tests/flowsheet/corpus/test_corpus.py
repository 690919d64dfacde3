"""Every hard recycle of the corpus converges, closes and agrees with what is known of it. ``pytest -s``
prints the pass rate.
"""

from __future__ import annotations

from typing import Any

import jax
import jax.numpy as jnp
import numpy as np
import pytest
from tests.flowsheet.corpus import cases as corpus

from granum.core.errors import ConvergenceError
from granum.core.packing import compiled
from granum.flowsheet import Flowsheet, closures, solve
from granum.flowsheet.run import Line
from granum.flowsheet.solving import QUICK_METHOD
from granum.flowsheet.specifications import Target
from granum.numerics import Continuation
from granum.streams.equipment.basics import Mixer, Splitter

_solve = compiled(lambda line: solve(line))
passed: list[str] = []


@pytest.mark.parametrize("name", corpus.CASES)
def test_case(name: str) -> None:
    case = corpus.CASES[name]()
    line = jax.tree.map(lambda x: np.asarray(x) if isinstance(x, float) else x, case.line)
    solution = _solve(line)
    assert bool(solution.converged), [float(r) for r in solution.residual]
    units, whole = closures(line, solution)
    # the corpus has reactors, which keep the mass but not the components
    assert max(abs(float(np.sum(c.by_component))) for c in (whole, *units.values())) < 1e-9
    assert max(float(whole.energy), *(float(c.energy) for c in units.values())) < 1e-9
    if case.stream:
        stream = solution.streams[case.stream]
        found = stream.liquid if np.ndim(case.expected) else stream.mass_flow
        assert np.allclose(found, case.expected, rtol=1e-6, atol=1e-9)
    passed.append(name)


@pytest.mark.parametrize("name", corpus.REFUSED)
def test_what_has_no_steady_state_is_refused(name: str) -> None:
    line = jax.tree.map(lambda x: np.asarray(x) if isinstance(x, float) else x, corpus.REFUSED[name]().line)
    assert not bool(_solve(line).converged)


@pytest.mark.parametrize("name", ["eight components, gains 1e-4 to 0.9999", "swinging, slope -5"])
def test_continuation_finds_the_same(name: str) -> None:
    """Continuation, with which a line is tried last, and its derivative; all of the corpus:
    ``benchmarks/recycles.py``.
    """
    line = corpus.CASES[name]().line
    feed = next(iter(line.feeds))
    liquid = line.feeds[feed].liquid

    def product(share: Any, method: Any) -> Any:
        solution = solve(line.with_values({f"{feed}.liquid": liquid * share}), method=method)
        return jnp.stack([solution.streams[n].mass_flow for n in line.products] + [1.0 * solution.converged])

    one, other = (
        jax.jit(lambda x, m=m: jax.jvp(lambda y: product(y, m), (x,), (1.0,)))(1.0)
        for m in (QUICK_METHOD, Continuation())
    )
    assert one[0][-1] == other[0][-1] == 1.0
    assert np.allclose(one[0], other[0], rtol=1e-9)
    assert np.allclose(one[1], other[1], rtol=1e-7, atol=1e-9)


def test_specification_on_a_loop_that_only_newton_solves() -> None:
    """Twelve components that turn into one another, 999 of 1000 going round: by hand the flow is 1/(1 -
    share).
    """
    fresh, units, links = (
        np.eye(12)[0],
        {"mix": Mixer(), "reactor": corpus.Reactor(np.roll(np.eye(12), 1, axis=0)), "split": Splitter(0.999)},
        {
            "f": ("", "mix.f"),
            "m": ("mix", "reactor"),
            "r": ("reactor", "split"),
            "back": ("split.side", "mix.back"),
        },
    )
    line = Flowsheet(units, {"f": corpus.feed(*fresh)}, links)
    assert not bool(_solve(jax.tree.map(np.asarray, line)).converged)
    with pytest.raises(
        ConvergenceError, match="'reactor' does not conserve c0"
    ) as caught:  # by design; the loop itself is solved
        Line("Loop", line, (Target("split.side_fraction", "mix.mass_flow", 2000.0, 0.999, 0.9998),)).solve()
    run = caught.value.last
    assert run.found["split.side_fraction"] == pytest.approx(0.9995, rel=1e-9)
    assert run.figure("mix.mass_flow") == pytest.approx(2000.0, rel=1e-7)


def test_pass_rate() -> None:
    assert len(corpus.CASES) >= 20
    print(f"\n{len(passed)} of {len(corpus.CASES)} hard recycles solved")


def test_heat_loop_by_hand() -> None:
    """Equal heat capacities: the warm stream reaches 300 + 0.97·100 K, and the product leaves at 303 K."""
    case = corpus.heat_loop(0.97)
    solution = _solve(case.line)
    assert float(solution.streams["warm"].temperature) == pytest.approx(397.0, abs=1e-6)
    assert float(solution.streams["exchanger.side"].temperature) == pytest.approx(303.0, abs=1e-6)


def test_cavett_against_plain_substitution() -> None:
    """The same flashes in NumPy, repeated thousands of times."""
    from scipy.optimize import brentq

    def flash(moles: np.ndarray, k: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        z = moles / moles.sum()
        v = brentq(lambda v: np.sum(z * (k - 1) / (1 + v * (k - 1))), 0.0, 1.0, xtol=1e-15)
        gas = moles * v * k / (1 + v * (k - 1))
        return moles - gas, gas

    k1, k2, k3, k4 = (corpus.wilson(*at) for at in ((311.0, 56.3), (322.0, 19.6), (309.0, 4.4), (303.0, 1.9)))
    fresh = corpus.CAVETT[:, 3] / 27340.6
    liquid1, gas3, gas4 = np.zeros(16), np.zeros(16), np.zeros(16)
    for _ in range(600):
        liquid2, gas2 = flash(fresh + liquid1 + gas3, k2)
        liquid1, _gas1 = flash(gas2, k1)
        liquid3, gas3 = flash(liquid2 + gas4, k3)
        _liquid4, gas4 = flash(liquid3, k4)
    solution = _solve(corpus.cavett().line)
    assert np.allclose(solution.streams["gas3"].liquid, gas3, rtol=1e-7, atol=1e-10)
    assert np.allclose(solution.streams["liquid1"].liquid, liquid1, rtol=1e-7, atol=1e-10)
