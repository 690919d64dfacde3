"""From the full state back through every pair of inputs to 1e-9: ideal and real air, nitrogen with ethanol,
air with toluene.
"""

from __future__ import annotations

import itertools
from functools import cache, partial
from typing import Any

import jax
import numpy as np
import pytest

import granum.humid_gas.relations as rel
from granum.core import flags
from granum.humid_gas.formulas.state import describe, state
from granum.humid_gas.given import MOISTURE, NAMES, WET
from granum.humid_gas.inputs import Solver
from granum.humid_gas.pairs import AIR_WATER, AbstractPair
from granum.humid_gas.real_air import AIR_WATER_REAL
from granum.humid_gas.solvents import AirToluene, NitrogenEthanol

PAIRS: dict[str, AbstractPair] = {
    "ideal": AIR_WATER,
    "real": AIR_WATER_REAL,
    "ethanol": NitrogenEthanol(),
    "toluene": AirToluene(),
}
EVERY = [
    (a, b)
    for a, b in itertools.combinations(NAMES, 2)
    if not ((a in MOISTURE and b in MOISTURE) or (a in WET and b in WET))
]
AIR = [names for names in EVERY if "adiabatic_saturation_temperature" not in names]
HARD = [
    ("relative_humidity", "wet_bulb_temperature"),
    ("wet_bulb_temperature", "enthalpy"),
    ("enthalpy", "specific_volume"),
]
CASES = (
    [("ideal", *names) for names in AIR]
    + [
        ("real", *names)
        for names in [("temperature", "wet_bulb_temperature"), ("humidity_ratio", "enthalpy"), *HARD]
    ]
    + [
        ("ethanol", *names)
        for names in [("dew_point_temperature", "adiabatic_saturation_temperature"), *HARD]
    ]
)


# most of the time is compilation: what runs once on a few states need not be optimized
quickly_compiled = partial(jax.jit, compiler_options={"xla_backend_optimization_level": 0})


@cache
def full_states(which: str) -> tuple[dict[str, np.ndarray], np.ndarray]:
    """States from −60 (or the coldest of the pair) to 350 °C, 0.01 to 100 bar, of dry to nearly pure
    vapor.
    """
    pair = PAIRS[which]
    rng = np.random.default_rng(1)
    count = 150
    T = rng.uniform(max(213.5, 1.002 * pair.lowest_temperature), 623.0, count)
    # a virial series of three terms ends where hot steam grows dense, and the dew point where the law of
    # vapor pressure begins
    P = 10 ** rng.uniform(3.0, 6.3 if which == "real" else 7.0, count)
    ys, lowest = (
        np.asarray(rel.saturated_fraction(pair, t, P))
        for t in (T, np.asarray(1.001 * pair.lowest_temperature))
    )
    y = np.maximum(np.minimum(ys, 0.97) * rng.uniform(0.001, 0.999, count), np.minimum(lowest, 0.5 * ys))
    found = quickly_compiled(
        lambda T, y, P: describe(pair, rel.Gas(T, y, 0.0 * T), P, pair.lewis_factor(), T > 0.0, {})
    )(T, y, P)
    return {name: np.asarray(value) for name, value in found._asdict().items()}, P


@pytest.mark.parametrize(("which", "first", "second"), CASES)
def test_back_through_every_pair(which: str, first: str, second: str) -> None:
    pair, (full, P) = PAIRS[which], full_states(which)
    lewis = pair.lewis_factor()
    gas, possible = quickly_compiled(lambda given, P: Solver(pair, P, lewis, given).solve())(
        {n: full[n] for n in (first, second)}, P
    )
    assert np.all(possible)
    np.testing.assert_allclose(gas.T, full["temperature"], rtol=1e-9)
    # dry states leave little trace in enthalpy, volume and wet bulb: there the fraction is fixed on an
    # absolute scale
    np.testing.assert_allclose(gas.y, full["vapor_mole_fraction"], rtol=1e-9, atol=1e-10)


def test_two_states_of_one_wet_bulb_and_volume() -> None:
    """Vapor of toluene is heavy: along a wet bulb its volume falls and rises. The state found has the values
    given, or is flagged.
    """
    pair, (full, P) = PAIRS["toluene"], full_states("toluene")
    given = {name: full[name] for name in ("wet_bulb_temperature", "specific_volume")}

    @quickly_compiled
    def back(given: dict[str, Any], P: Any) -> Any:
        with flags.collect() as records, flags.inside(state):
            gas, possible = Solver(pair, P, pair.lewis_factor(), given).solve()
        wet = rel.polished_wet_bulb(pair, gas.T, P, gas.y, pair.lewis_factor())
        return (
            gas.T,
            possible,
            wet,
            rel.volume_of(pair, gas, P),
            next(r.mask for r in records if r.bit == flags.LIMIT_ACTIVE),
        )

    T, possible, wet, volume, two = map(np.asarray, back(given, P))
    assert np.all(possible)  # also where both states lie between two samples of the search
    np.testing.assert_allclose(wet[possible], given["wet_bulb_temperature"][possible], rtol=1e-9)
    np.testing.assert_allclose(volume[possible], given["specific_volume"][possible], rtol=1e-9)
    same = np.isclose(T, full["temperature"], rtol=1e-9, atol=0.0)
    assert np.all(same | two | ~possible)
    assert np.all(T[two] <= full["temperature"][two] * (1 + 1e-9))
    assert two.any()
