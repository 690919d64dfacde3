"""A day of a continuous clarifier-thickener with compression: our scan against a plain SciPy method of lines
of the same fluxes.

Both solve 100 cells over 24 h from an empty tank (BSM1 settling function, logarithmic effective stress, 4 m
deep). The peer is written in NumPy with the same Godunov, upwind and compression fluxes and handed to SciPy's
LSODA and BDF. Then 1 000 parameter sets batched, and the exact derivative of the underflow. Run: python -m
benchmarks.settling
"""

from __future__ import annotations

import time
from typing import Any

import jax
import jax.numpy as jnp
import numpy as np
from scipy.integrate import solve_ivp

import granum  # noqa: F401  (double precision)
from benchmarks.rows import Row, tell
from granum.settling.column import Operation, Suspension, simulate, steps_needed
from granum.settling.compression import LogarithmicStress
from granum.settling.velocities import Takacs, Vesilind

CELLS, DEPTH, HOURS = 100, 4.0, 24
Q, QU, FEED = 7.8e-4, 3.0e-4, 3.5
STRESS = LogarithmicStress(6.0, 4.0, 4.0)
STILL = jnp.ones(HOURS)
OPERATION = Operation(jnp.linspace(0.0, HOURS * 3600.0, HOURS + 1), Q * STILL, QU * STILL, FEED * STILL)


def ours(suspension, steps=None):
    return simulate(suspension, DEPTH, jnp.zeros(CELLS), OPERATION, steps=steps)


def peer(method):
    dz, mid = DEPTH / CELLS, CELLS // 2
    v0, cap, rh, rp = 474 / 86400, 250 / 86400, 0.576, 2.86
    factor = 1050.0 / (9.80665 * (1050.0 - 998.0))

    def velocity(C):
        return np.clip(v0 * (np.exp(-rh * C) - np.exp(-rp * C)), 0.0, cap) * np.clip(
            (1050.0 - C) / (0.05 * 1050.0), 0, 1
        )

    fine = np.linspace(0.0, 20.0, 200001)
    flux = fine * velocity(fine)
    peak, top = fine[flux.argmax()], flux.max()

    def rate(_t, C):
        v = velocity(C)
        f = C * v
        through = np.minimum(np.where(peak > C, f, top)[:-1], np.where(peak < C, f, top)[1:])
        b = np.maximum(C, 6.0)
        slow, stiff = np.where(C > 6.0, v, velocity(6.0)), factor * 4.0 / (4.0 + b - 6.0)
        through = through - 0.5 / dz * np.minimum(slow[1:], slow[:-1]) * (stiff[1:] + stiff[:-1]) * (
            b[1:] - b[:-1]
        )
        inner = through + np.where(np.arange(1, CELLS) > mid, QU * C[:-1], -(Q - QU) * C[1:])
        faces = np.concatenate([[-(Q - QU) * C[0]], inner, [QU * C[-1]]])
        change = -np.diff(faces) / dz
        change[mid] += Q * FEED / dz
        return change

    options: dict[str, Any] = {"lband": 1, "uband": 1} if method == "LSODA" else {}
    return solve_ivp(
        rate, (0, HOURS * 3600.0), np.zeros(CELLS), method=method, rtol=1e-6, atol=1e-8, **options
    )


def clock(run, repeat=5):
    times = []
    for _i in range(repeat):
        start = time.perf_counter()
        out = run()
        times.append(time.perf_counter() - start)
    return out, min(times)


def main() -> None:
    suspension = Suspension(Takacs(), STRESS)
    jax.block_until_ready(ours(suspension))
    course, seconds = clock(lambda: jax.block_until_ready(ours(suspension)))
    need = steps_needed(suspension, DEPTH, CELLS, OPERATION)
    underflow = float(course.concentration[-1, -1])
    print(
        f"underflow {underflow:.4f} kg/m³, balance {float(course.mass_error):.0e}, "
        f"{HOURS * int(need.steps)} steps × {int(need.compression)}"
    )
    for method in ("LSODA", "BDF"):
        found, theirs = clock(lambda method=method: peer(method), 1)
        tell(
            Row(
                "a day of a clarifier with compression, 100 cells",
                seconds,
                f"SciPy {method}",
                theirs,
                f"{abs(found.y[-1, -1] / underflow - 1.0):.0e} of the underflow",
            )
        )

    slope = jax.jit(
        lambda v: jax.jvp(
            lambda u: ours(Suspension(Takacs(takacs_velocity=u), STRESS)).underflow_concentration[-1],
            (v,),
            (1.0,),
        )
    )
    jax.block_until_ready(slope(5e-3))
    _out, seconds = clock(lambda: jax.block_until_ready(slope(5e-3)))
    tell(Row("a day of the clarifier with its derivative to the settling velocity", seconds, kind="alone"))

    velocities = jnp.linspace(1.0e-3, 1.6e-3, 1000)
    for name, stress in (("without compression", None), ("with compression", STRESS)):
        steps = steps_needed(Suspension(Vesilind(velocities[-1], 0.4), stress), DEPTH, CELLS, OPERATION)
        steps = type(steps)(*map(int, steps))

        def one(v, stress=stress, steps=steps):
            return ours(Suspension(Vesilind(v, 0.4), stress), steps).underflow_concentration[-1]

        many = jax.jit(lambda v, one=one: jax.lax.map(one, v, batch_size=25))
        jax.block_until_ready(many(velocities))
        _out, seconds = clock(lambda many=many: jax.block_until_ready(many(velocities)), 2)
        tell(Row(f"1 000 parameter sets of the clarifier, {name}", seconds, kind="alone"))


if __name__ == "__main__":
    main()
