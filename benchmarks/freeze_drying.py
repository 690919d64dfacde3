"""Primary drying of vials: a batch at once against a vial at a time with SciPy.

    python -m benchmarks.freeze_drying [--vials 10000]

The peer solves the same quasi-steady equations in the way of LyoPRONTO (Shivkumar et al. 2019):
`scipy.integrate.solve_ivp` over time with the balance of heat at the ice front solved by
`scipy.optimize.fsolve` at each call, at SciPy's default tolerances. LyoPRONTO itself is not on the package
index; its authors' program takes 0.02 to 0.03 s per vial on a common processor.
"""

from __future__ import annotations

import argparse
import time

import jax
import numpy as np
from scipy.integrate import solve_ivp
from scipy.optimize import fsolve

from benchmarks.rows import Row, tell
from granum.drying.formulas.freeze_drying import primary_drying

TORR = 133.322368
RESISTANCE = 3600 * TORR * 0.1  # one cm² h Torr/g in m/s
AV, AP, FILL, KC, KP, KD, P = (
    3.8e-4,
    3.14e-4,
    2e-6,
    2.75e-4 * 41840,
    8.93e-4 * 41840 / TORR,
    0.46 / TORR,
    0.15 * TORR,
)
R0, A1 = 1.4 * RESISTANCE, 16 * RESISTANCE * 100
HEAT, ICE, DENSITY = 678.0 * 4184.0, 0.0059 * 418.4, 918.0


def one_vial(heat: float, resistance: float) -> float:
    """Drying time of one vial, s."""
    K = heat * (KC + KP * P / (1 + KD * P))
    L0 = FILL / (AP * DENSITY) * (1000.0 - 50.0 * 82.0 / 1500.0)
    ice = FILL * 1000.0 * (1 - 50 / 1500)
    last = [235.0]

    def speed(t: float, y: np.ndarray) -> list[float]:
        shelf = min(238.15 + t / 60.0, 293.15)
        L = min(y[0], L0)
        R = resistance * (R0 + A1 * L)
        Z = AP / (K * AV) + (L0 - L) / ICE
        last[0] = float(
            fsolve(
                lambda T: 2.698e10 * TORR * np.exp(-6144.96 / T) - P - R * (shelf - T) / (HEAT * Z), last[0]
            )[0]
        )
        return [max(2.698e10 * TORR * np.exp(-6144.96 / last[0]) - P, 0.0) / R * L0 * AP / ice]

    def done(t: float, y: np.ndarray) -> float:
        return y[0] - L0

    done.terminal = True  # type: ignore[attr-defined]
    return float(solve_ivp(speed, (0.0, 3e5), [0.0], method="BDF", events=done).t_events[0][0])


def main() -> None:
    """Both in one run, medians of three."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--vials", type=int, default=10_000)
    count = parser.parse_args().vials
    draw = np.random.default_rng(0)
    heat, resistance = np.exp(0.1 * draw.standard_normal(count)), np.exp(0.1 * draw.standard_normal(count))

    @jax.jit
    def batch(heat: jax.Array, resistance: jax.Array) -> jax.Array:
        return primary_drying(
            P,
            293.15,
            AV,
            AP,
            FILL,
            50.0,
            KC * heat,
            KP * heat,
            R0 * resistance,
            A1 * resistance,
            0.0,
            KD,
            238.15,
            1 / 60,
        ).drying_time

    start = time.perf_counter()
    ours = np.asarray(batch(heat, resistance))
    first = time.perf_counter() - start
    spans = []
    for _run in range(3):
        start = time.perf_counter()
        batch(heat, resistance).block_until_ready()
        spans.append((time.perf_counter() - start) / count)
    sample, peers, theirs = min(count, 5), [], []
    for _run in range(3):
        start = time.perf_counter()
        theirs = [
            one_vial(float(h), float(r)) for h, r in zip(heat[:sample], resistance[:sample], strict=True)
        ]
        peers.append((time.perf_counter() - start) / sample)
    tell(
        Row(
            f"primary drying of a vial, in a batch of {count}",
            float(np.median(spans)),
            "SciPy BDF and fsolve",
            float(np.median(peers)),
            f"{np.max(np.abs(ours[:sample] / np.array(theirs) - 1)):.0e} of the time",
            figures={"first call, s": first},
        )
    )


if __name__ == "__main__":
    main()
