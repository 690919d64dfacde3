"""A million wet-bulb temperatures: ideal air, real air and a solvent, beside psychrolib (plain and compiled)
and CoolProp in the same run.

    python -m benchmarks.wet_bulb

Budgets, warm: 0.10 s ideal, 0.25 s real gas; 40 times psychrolib, 5 times its compiled mode, 500 times
CoolProp. The peers are timed on fewer states and scaled. Needs ``pip install granum[bench]``.
"""

from __future__ import annotations

import time
from dataclasses import replace

import jax
import numpy as np

import granum  # noqa: F401  (double precision)
from benchmarks.rows import Row, installed, tell
from granum.humid_gas import relations as rel
from granum.humid_gas.formulas.properties import wet_bulb_temperature
from granum.humid_gas.formulas.state import state
from granum.humid_gas.pairs import AIR_WATER
from granum.humid_gas.real_air import AIR_WATER_REAL
from granum.humid_gas.solvents import NitrogenEthanol

COUNT, SAMPLE, SLOW = 1_000_000, 20_000, 300
P = 101325.0


def best_of(job, repeats: int = 7) -> tuple[float, float]:
    """Best and median seconds of several runs."""
    taken = []
    for _ in range(repeats):
        start = time.perf_counter()
        jax.block_until_ready(job())
        taken.append(time.perf_counter() - start)
    return min(taken), float(np.median(taken))


def states(pair, count: int) -> tuple[np.ndarray, np.ndarray]:
    rng = np.random.default_rng(0)
    T = rng.uniform(283.15, 363.15, count)
    y = np.minimum(np.asarray(rel.saturated_fraction(pair, T, P)), 0.9) * rng.uniform(0.05, 0.95, count)
    return T, np.asarray(pair.humidity_ratio(y))


def psychrolib(compiled: bool):
    """The peer with or without the compiler that it uses when one is installed; None where that mode cannot
    be had.
    """
    import importlib.util
    import sys

    spec = importlib.util.find_spec("psychrolib")
    if spec is None or spec.loader is None or (compiled and importlib.util.find_spec("numba") is None):
        return None
    module = importlib.util.module_from_spec(spec)
    hidden = {} if compiled else {"numba": sys.modules.get("numba")}
    if not compiled:
        sys.modules["numba"] = None  # type: ignore[assignment]
    try:
        spec.loader.exec_module(module)
    finally:
        for name, was in hidden.items():
            sys.modules.pop(name)
            if was is not None:
                sys.modules[name] = was
    module.SetUnitSystem(module.SI)
    return module


def main() -> None:
    ours, first = {}, {}
    for name, pair in (
        ("ideal air", AIR_WATER),
        ("real air", AIR_WATER_REAL),
        ("nitrogen and ethanol", NitrogenEthanol()),
    ):
        T, w = (jax.numpy.asarray(a) for a in states(pair, COUNT))
        start = time.perf_counter()
        jax.block_until_ready(wet_bulb_temperature(temperature=T, humidity_ratio=w, pair=pair))
        first[name] = {"first call, s": time.perf_counter() - start}
        ours[name] = best_of(
            lambda T=T, w=w, pair=pair: wet_bulb_temperature(temperature=T, humidity_ratio=w, pair=pair)
        )[1]
    solvent = "nitrogen and ethanol"
    tell(Row(f"a million wet bulbs, {solvent}", ours[solvent], kind="alone", figures=first[solvent]))
    T, w = states(AIR_WATER, COUNT)
    found = np.asarray(wet_bulb_temperature(temperature=T, humidity_ratio=w))
    for mode in ("plain", "compiled"):
        peer = psychrolib(mode == "compiled")
        asked = Row(
            "a million wet bulbs, ideal air",
            ours["ideal air"],
            "psychrolib" + (" compiled by numba" if mode == "compiled" else ""),
            figures=first["ideal air"],
        )
        if peer is None:
            tell(asked)
            continue
        many = COUNT if mode == "compiled" else SAMPLE
        if mode == "compiled":
            peer.GetTWetBulbFromHumRatio(T[:10] - 273.15, w[:10], P)  # compilation does not count
            start = time.perf_counter()
            values = peer.GetTWetBulbFromHumRatio(T - 273.15, w, P)
        else:
            start = time.perf_counter()
            values = np.array([peer.GetTWetBulbFromHumRatio(T[i] - 273.15, w[i], P) for i in range(many)])
        taken = (time.perf_counter() - start) * COUNT / many
        apart = np.abs(values + 273.15 - found[:many]).max()
        tell(replace(asked, peer_seconds=taken, agreement=f"{apart:.2g} K"))
    some = np.random.default_rng(1).uniform(0.1, 0.9, COUNT)
    for second, given in (
        ("relative_humidity", {"relative_humidity": some}),
        ("humidity_ratio", {"humidity_ratio": w}),
    ):
        job = jax.jit(lambda T, x, second=second: state(temperature=T, pressure=P, **{second: x}))
        x = next(iter(given.values()))
        jax.block_until_ready(job(T, x))
        taken = best_of(lambda job=job, x=x: job(T, x), 5)
        words = second.replace("_", " ")
        tell(Row(f"a million humid gases from temperature and {words}", taken[1], kind="alone"))
    asked = Row(
        "a million wet bulbs, real air", ours["real air"], "CoolProp HAPropsSI", figures=first["real air"]
    )
    if coolprop := installed("CoolProp.CoolProp"):
        real = np.asarray(
            wet_bulb_temperature(temperature=T[:SLOW], humidity_ratio=w[:SLOW], pair=AIR_WATER_REAL)
        )
        start = time.perf_counter()
        peer = np.array([coolprop.HAPropsSI("B", "T", T[i], "P", P, "W", w[i]) for i in range(SLOW)])
        taken = (time.perf_counter() - start) * COUNT / SLOW
        asked = replace(asked, peer_seconds=taken, agreement=f"{np.nanmax(np.abs(peer - real)):.2g} K")
    tell(asked)


if __name__ == "__main__":
    main()
