"""Crystallizer, clarifier and thickener in time: against SciPy and closed forms, conservative in every
component and in heat, ending in the steady solve.
"""

from __future__ import annotations

from typing import Any

import jax
import jax.numpy as jnp
import numpy as np
import pytest
from scipy.integrate import solve_ivp

from granum.core.packing import compiled
from granum.crystallization.equipment.msmpr import Msmpr
from granum.crystallization.formulas.growth import PowerLawGrowth
from granum.crystallization.formulas.nucleation import PowerLawNucleation
from granum.crystallization.formulas.solubility_laws import PolynomialSolubility
from granum.flowsheet import Flowsheet, Profile, march, solve
from granum.settling.equipment.clarifier_thickener import ClarifierThickener
from granum.settling.equipment.clarifiers import CircularClarifier
from granum.settling.velocities import Vesilind
from granum.streams.mixture import Mixture, Species
from granum.streams.stream import Stream, empty

WATER = Species("water", (("water", 1.0),), (1000.0,), (4180.0,), 0.0, 0.018)


@compiled
def _run(line: Flowsheet, times: Any, values: Any, start: dict[str, str]) -> Any:
    profiles = (Profile("f.temperature", times[:2], values),)
    return march(line, times, profiles, start=start), solve(line.with_values({"f.temperature": values[1]}))


def flows(stream: Stream, what: str) -> np.ndarray:
    return np.asarray(jax.vmap(lambda s: getattr(s, what))(stream))


def gained(course: Any, what: str) -> np.ndarray:
    """What the feed brings and the products take over the run, by the trapezoidal rule."""
    net = flows(course.streams["f"], what) - sum(
        flows(s, what) for n, s in course.streams.items() if n != "f"
    )
    return np.trapezoid(net, course.times, axis=0)


def test_start_up_of_a_crystallizer() -> None:
    """Moments 0 to 3 and the solute by SciPy, all densities being alike so that the vessel keeps its volume
    by itself.
    """
    salt = Species("salt", (("salt", 1.0),), (1000.0,), (3000.0,), 0.0, 0.1)
    grains = Species("salt", (("salt", 1.0),), (1000.0,), (1000.0,), 0.0, 0.1)
    mixture = Mixture((grains,), (WATER, salt), (), tuple(np.geomspace(5e-6, 3e-3, 25)))
    fine = np.zeros((1, 24))
    fine[0, 10] = 2e-3
    feed = empty(mixture, 350.0).replace(solid=jnp.asarray(fine), liquid=jnp.array([0.7, 0.45]))
    unit = Msmpr(
        300.0,
        2.0,
        PolynomialSolubility([0.35]),
        PowerLawGrowth(1.161e-4, 1.32),
        PowerLawNucleation(2.196e8, 1.78),
    )
    line = Flowsheet({"u": unit}, {"f": feed}, {"f": ("", "u"), "p": ("u.product", ""), "v": ("u.vapor", "")})
    times = np.linspace(0.0, 54000.0, 451)
    course, steady = _run(line, times, np.array([350.0, 350.0]), {"u": "empty"})
    held = unit.initial_holdup(mixture)
    missing = gained(course, "components") - np.asarray(course.holdups["u"].liquid - held.liquid)
    assert np.abs(missing).max() < 1e-12 * 54000.0
    product, at_rest = np.asarray(course.streams["p"].solid[:, 0]), np.asarray(steady.streams["p"].solid[0])
    assert product[-1].sum() == pytest.approx(at_rest.sum(), rel=1e-6)
    assert np.abs(product[-1] - at_rest).max() < 2e-3 * at_rest.sum()

    q, cube = 1.152 / 2000.0, 1000.0
    low, high = mixture.edges[10:12]
    size = (0.25 * (low + high) * (low**2 + high**2)) ** (1 / 3)
    entering = 2e-3 / (cube * size**3) * size ** np.arange(4)
    totals = np.array([0.452, 0.7])

    def slope(_t: float, y: np.ndarray) -> np.ndarray:
        m, (solute, solvent) = y[:4], y[4:]
        S = max((solute - cube * m[3]) / solvent / 0.35 - 1.0, 0.0)
        G, B = 1.161e-4 * S**1.32, 2.196e8 * S**1.78 * cube * m[3] / 2.0
        growth = G * np.array([0.0, m[0], 2 * m[1], 3 * m[2]])
        return np.concatenate([growth + entering - q * m + np.array([2.0 * B, 0, 0, 0]), totals - q * y[4:]])

    seeds = 2.0 / (cube * 1e-12) * 1e-4 ** np.arange(4)
    solvent = 1998.0 / 1.35
    path = solve_ivp(
        slope,
        (0.0, times[-1]),
        np.append(seeds, [0.35 * solvent + 2.0, solvent]),
        "LSODA",
        times[::30],
        rtol=1e-9,
        atol=1e-9,
    )
    expected = q * cube * path.y[3]
    assert np.abs(product[::30].sum(axis=1) - expected).max() < 3e-3 * expected[-1]


def test_an_empty_thickener_fills_in_optimized_code_too() -> None:
    """In cells that are empty yet all flows are rounding, which the compiler does otherwise."""
    sludge = Species("sludge", (("sludge", 1.0),), (1400.0,), (1900.0,), 0.0, 0.1)
    mixture = Mixture(
        (sludge,), (WATER,), (), tuple(np.geomspace(1e-6, 1e-3, 7)), liquid_viscosity=lambda _w, _T: 1e-3
    )
    solid = jnp.asarray(0.6 * np.arange(1.0, 7.0) / 21.0)[None]
    feed = empty(mixture, 290.0).replace(solid=solid, liquid=jnp.array([200.0]))
    thickener = ClarifierThickener(500.0, 4.0, 0.08, Vesilind("7 m/hour", 0.4), cells=12)
    links = {
        "f": ("", "b"),
        "raw": ("b.underflow", "t"),
        "clear": ("b.overflow", ""),
        "over": ("t.overflow", ""),
        "thick": ("t.underflow", ""),
    }
    line = Flowsheet({"b": CircularClarifier(25.0, 3.0, 4.0), "t": thickener}, {"f": feed}, links)
    times = np.linspace(0.0, 1200.0, 5)
    course = jax.jit(lambda times: march(line, times, start={"b": "empty"}))(times)
    for stream in course.streams.values():
        assert np.all(np.isfinite(stream.solid))
    thick, over = (flows(course.streams[name], "solid_flow") for name in ("thick", "over"))
    assert np.all(thick >= 0.0)
    assert thick[-1] > 0.0
    assert np.all(over >= -1e-12)


def test_clarifier_and_thickener() -> None:
    """Salt and heat of the mixed basin by hand; a sludge whose sizes travel with it; every component and the
    heat close.
    """
    salt = Species("salt", (("salt", 1.0),), (1000.0,), (4180.0,), 0.0, 0.058)
    sludge = Species("sludge", (("sludge", 1.0),), (1400.0,), (1900.0,), 0.0, 0.1)
    mixture = Mixture(
        (sludge,), (WATER, salt), (), tuple(np.geomspace(1e-6, 1e-3, 7)), liquid_viscosity=lambda _w, _T: 1e-3
    )
    shares = np.arange(1.0, 7.0) / 21.0
    feed = empty(mixture, 290.0).replace(
        solid=jnp.asarray(0.6 * shares)[None], liquid=jnp.array([198.0, 2.0])
    )
    thickener = ClarifierThickener(500.0, 4.0, 0.08, Vesilind("7 m/hour", 0.4), cells=12)
    links = {
        "f": ("", "b"),
        "raw": ("b.underflow", "t"),
        "clear": ("b.overflow", ""),
        "over": ("t.overflow", ""),
        "thick": ("t.underflow", ""),
    }
    basin = CircularClarifier(25.0, 3.0, 4.0)
    line = Flowsheet({"b": basin, "t": thickener}, {"f": feed}, links)
    times = np.linspace(0.0, 5 * 86400.0, 1441)
    course, steady = _run(line, times, np.array([290.0, 295.0]), {"b": "empty"})
    outside = course._replace(streams={n: s for n, s in course.streams.items() if n != "raw"})
    last, first = course.holdups, {"b": basin.initial_holdup(mixture), "t": thickener.initial_holdup(mixture)}

    def holding(held: dict[str, Any], what: str) -> Any:
        inside = [
            feed.replace(solid=held["b"].solid, liquid=held["b"].liquid, temperature=held["b"].temperature),
            feed.replace(
                solid=jnp.sum(held["t"].solid, axis=0),
                liquid=held["t"].liquid,
                temperature=held["t"].temperature,
            ),
        ]
        return sum(np.asarray(getattr(s, what)) for s in inside)

    for what in ("components", "enthalpy_flow"):
        passed = np.trapezoid(flows(course.streams["f"], what), times, axis=0)
        missing = gained(outside, what) - (holding(last, what) - holding(first, what))
        assert np.abs(missing).max() < 1e-11 * np.abs(passed).max(), what
    for name in ("clear", "over", "thick"):
        end, at_rest = course.streams[name], steady.streams[name]
        assert np.allclose(end.liquid[-1], at_rest.liquid, rtol=1e-8)
        assert np.allclose(end.solid[-1], at_rest.solid, rtol=1e-8, atol=1e-9)
        assert float(end.temperature[-1]) == pytest.approx(295.0, abs=1e-6)
    flow, volume = 0.2 + 0.6 / 1400.0, np.pi / 4 * 25.0**2 * 3.0
    # of the water at the start: salt is 2 (1 - left), liquid 200 (1 - left) and what is left of the water
    left = np.exp(-flow / volume * times)
    clear = np.asarray(course.streams["clear"].liquid)
    assert (
        np.abs(
            clear[:, 1] / clear.sum(axis=1) - 2.0 * (1.0 - left) / (200.0 + (1000.0 * flow - 200.0) * left)
        ).max()
        < 1e-4 * 0.01
    )
