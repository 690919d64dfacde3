"""Two dynamic flowsheets of the simulator Dyssol 1.1.1 (TUHH, BSD-3), solved here and, where the program is installed, there.

    python benchmarks/dyssol.py FOLDER_WITH_THE_TWO_SCRIPTS [--program PATH/DyssolC --models FOLDER/ --materials FILE] [--span 60]

The scripts ``sieve-mill-process.txt`` and ``agglomeration-process.txt`` come with Dyssol. The sieve–mill process (two screens and two
population-balance mills in nested recycles, 200 size × 50 attribute classes, 6 h) is solved as a flowsheet in time and checked against SciPy
on the same equations. The agglomeration process is not solved yet.
"""

from __future__ import annotations

import argparse
import itertools
import re
import subprocess
import tempfile
import time
from pathlib import Path

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
from scipy.integrate import solve_ivp

from granum.comminution.breakage import AustinBreakage, AustinSelection
from granum.comminution.equipment.mills import BallMill
from granum.comminution.equipment.screens import Screen
from granum.comminution.population import rate_matrix
from granum.flowsheet import Flowsheet
from granum.flowsheet.dynamics import Profile, march
from granum.particles.partition import MolerusHoffmannPartition
from granum.streams.equipment.basics import Mixer
from granum.streams.mixture import Mixture, Species
from granum.streams.stream import empty


def script(path: Path) -> dict[tuple[str, ...], list[float]]:
    """Numbers of a Dyssol script by the words before them."""
    found: dict[tuple[str, ...], list[float]] = {}
    for line in path.read_text().splitlines():
        words = [w.strip('"') for w in re.findall(r'"[^"]*"|\S+', line)]
        cut = len(words)
        while cut and re.fullmatch(r"[-+0-9.eE]+", words[cut - 1]):
            cut -= 1
        found[tuple(words[:cut])] = [float(w) for w in words[cut:]]
    return found


def sieve_mill(data: dict[tuple[str, ...], list[float]]) -> tuple[Flowsheet, tuple[Profile, ...], dict[str, jax.Array]]:
    """The flowsheet, the feeds and screen settings that change, and what the mills hold at the start."""
    edges = np.array(data["DISTRIBUTION_GRID", "GLOBAL", "SIZE", "NUMERIC", "MANUAL", "DIAMETER"][1:])
    attribute = np.array(data["DISTRIBUTION_GRID", "GLOBAL", "USER_DEFINED_01", "NUMERIC", "MANUAL"][1:])
    sand = Species("sand", (("sand", 1.0),), (2650.0,), (800.0,), 0.0, 0.06)
    mixture = Mixture((sand,), (), (), tuple(edges), (("attribute", tuple(attribute)),))

    def joint(unit: str, holdup: str) -> np.ndarray:
        size = np.array(data["HOLDUP_DISTRIBUTION", unit, holdup, "SIZE", "Sand", "MASS_FRACTION", "DIAMETER", "MANUAL"][1 : len(edges)])
        other = np.array(data["HOLDUP_DISTRIBUTION", unit, holdup, "USER_DEFINED_01", "Sand", "MANUAL"][1 : len(attribute)])
        return np.outer(size / size.sum(), other / other.sum())[None]

    def mill(unit: str) -> BallMill:
        number = {k: data["UNIT_PARAMETER", unit, k][0] for k in ("S1", "S2", "B1", "B2", "B3")}
        # The script's laws are powers of volume: a third of the exponents of size.
        selection = AustinSelection(1.0, 3 * number["S2"], reference_size=(6 * number["S1"] / np.pi) ** (1 / 3))
        return BallMill(selection, AustinBreakage(number["B1"], 3 * number["B3"], 3 * number["B2"]) if number["B2"] > number["B3"] else
                        AustinBreakage(1 - number["B1"], 3 * number["B2"], 3 * number["B3"]), data["HOLDUP_OVERALL", unit, "Holdup"][1])  # fmt: skip

    def screen(unit: str) -> Screen:
        return Screen(MolerusHoffmannPartition(data["UNIT_PARAMETER", unit, "Xcut"][1], data["UNIT_PARAMETER", unit, "Alpha"][1]))

    units = {"mixer_in": Mixer(), "screen1": screen("Screen1"), "screen2": screen("Screen2"), "mill1": mill("Mill1"),
             "mixer_coarse": Mixer(), "mill2": mill("Mill2")}  # fmt: skip
    feeds, profiles = {}, []
    for name in ("Inlet1", "Inlet2"):
        points = np.array(data["HOLDUP_OVERALL", name, "InputMaterial"]).reshape(-1, 4)
        feeds[name] = empty(mixture, 300.0, 1e5).replace(solid=jnp.asarray(joint(name, "InputMaterial")) * 1.0)
        profiles.append(Profile(f"{name}.mass_flow", np.append(points[:, 0], 1e9), np.append(points[:, 1], points[-1, 1])))
    for unit in ("Screen1", "Screen2"):
        alpha = np.array(data["UNIT_PARAMETER", unit, "Alpha"]).reshape(-1, 2)
        profiles.append(Profile(f"{unit.lower()}.separation.sharpness", alpha[:, 0], alpha[:, 1]))
    links = {"Inlet1": ("", "mixer_in.one"), "Inlet2": ("", "mixer_in.two"), "milled2": ("mill2", "mixer_in.back"), "mixed": ("mixer_in", "screen1"),
             "coarse1": ("screen1.oversize", "mill1"), "fine1": ("screen1.undersize", "screen2"), "coarse2": ("screen2.oversize", "mixer_coarse.two"),
             "milled1": ("mill1", "mixer_coarse.one"), "to_mill2": ("mixer_coarse", "mill2"), "product": ("screen2.undersize", "")}  # fmt: skip
    held = {unit.lower(): jnp.asarray(joint(unit, "Holdup")) * data["HOLDUP_OVERALL", unit, "Holdup"][1] for unit in ("Mill1", "Mill2")}
    return Flowsheet(units, feeds, links), tuple(profiles), held


def by_scipy(line: Flowsheet, profiles: tuple[Profile, ...], held: dict[str, jax.Array], times: np.ndarray) -> np.ndarray:
    """Product by size from SciPy's BDF: the attribute rides along, so that the sums over it follow the same equations."""
    edges = np.asarray(next(iter(line.feeds.values())).mixture.edges)
    mills = [line.units["mill1"], line.units["mill2"]]
    a = [np.asarray(rate_matrix(edges, m.selection, m.breakage)) for m in mills]
    feeds = [np.asarray(f.solid_by_size) for f in line.feeds.values()]
    n = len(edges) - 1

    def partition(unit: str, t: float) -> np.ndarray:
        sharp = float(np.interp(t, *next((p.times, p.values) for p in profiles if p.path.startswith(unit))))
        return np.asarray(MolerusHoffmannPartition(line.units[unit].separation.cut_size, sharp).over(edges[:-1], edges[1:]))

    grades = {u: (partition(u, 0.0), partition(u, 1e6)) for u in ("screen1", "screen2")}

    def grade(unit: str, t: float) -> np.ndarray:
        ends = grades[unit]
        return ends[0] if t <= 7200 else ends[1] if t >= 7210 else partition(unit, t)

    def flows(t: float, w1: np.ndarray, w2: np.ndarray) -> tuple[np.ndarray, ...]:
        fresh = sum(np.interp(t, p.times, p.values) * f for p, f in zip(profiles[:2], feeds, strict=True))
        c1, c2 = grade("screen1", t), grade("screen2", t)
        both = c1 + (1 - c1) * c2
        f2 = (both @ fresh) / (1 - both @ w2)  # what mill 2 gives is what it gets: coarse of both screens
        mixed = fresh + f2 * w2
        coarse1 = c1 * mixed
        fine1 = mixed - coarse1
        coarse2 = c2 * fine1
        return coarse1, coarse1.sum() * w1 + coarse2, fine1 - coarse2

    def slope(t: float, y: np.ndarray) -> np.ndarray:
        w = y.reshape(2, n)
        into = flows(t, *w)
        return np.concatenate([(f - f.sum() * x) / m.holdup_mass + k @ x for f, x, m, k in zip(into[:2], w, mills, a, strict=True)])

    start = np.concatenate([np.asarray(x).sum(axis=(0, 2)) / x.sum() for x in held.values()])
    states = []
    spans = [0.0, 7200.0, 7210.0, 14400.0, 14410.0, times[-1]]
    for lo, hi in itertools.pairwise(spans):
        if lo >= times[-1]:
            break
        inside = times[(times >= lo) & ((times < hi) | ((times == times[-1]) & (hi >= times[-1])))]
        path = solve_ivp(
            slope, (lo, min(hi, times[-1])), start, "BDF", np.append(inside[inside < hi], min(hi, times[-1])), rtol=1e-8, atol=1e-12
        )
        states.append(path.y.T[: len(inside)])
        start = path.y[:, -1]
    return np.stack([flows(t, *y.reshape(2, n))[2] for t, y in zip(times, np.concatenate(states), strict=True)])


def other(program: Path, models: str, materials: str, path: Path, span: float, limit: float) -> tuple[float, float]:
    """Plant time that Dyssol got through, and the time it took."""
    text = path.read_text().replace('"Inlet flow"', '"InletFlow"').replace('"Outlet flow"', '"OutletFlow"')
    text = re.sub(r"MODELS_PATH .*\n(?=MODELS_PATH)", "", text)
    with tempfile.TemporaryDirectory() as folder:
        for key, value in {
            "RESULT_FILE": f'"{folder}/r.dflw"',
            "MATERIALS_DATABASE": f'"{materials}"',
            "MODELS_PATH": f'"{models}"',
            "SIMULATION_TIME": f"{span:g}",
        }.items():
            text = re.sub(rf"{key} .*", lambda _m, key=key, value=value: f"{key} {value}", text)
        (Path(folder) / "case.txt").write_text(text)
        begun = time.perf_counter()
        try:
            said = subprocess.run([program, f"-s={folder}/case.txt"], capture_output=True, text=True, timeout=limit, check=False).stdout
        except subprocess.TimeoutExpired as late:
            said = (late.stdout or b"").decode()
        took = time.perf_counter() - begun
    reached = [float(x) for x in re.findall(r"\[[\d.e+-]+, ([\d.e+-]+)\]", said)]
    return (reached[-1] if reached else 0.0), took


def main() -> None:
    options = argparse.ArgumentParser(description=__doc__)
    options.add_argument("folder", type=Path)
    options.add_argument("--program", type=Path)
    options.add_argument("--models", default="/usr/lib/x86_64-linux-gnu/Dyssol/Units/")
    options.add_argument("--materials", default="/usr/share/Dyssol/MaterialsDB/Materials.dmdb")
    options.add_argument("--span", type=float, default=60.0, help="plant time asked of Dyssol, s")
    options.add_argument("--limit", type=float, default=300.0, help="seconds given to Dyssol")
    options.add_argument("--step", type=float, default=20.0, help="time step here, s")
    given = options.parse_args()
    line, profiles, held = sieve_mill(script(given.folder / "sieve-mill-process.txt"))
    arrays = jax.tree.map(lambda x: jnp.asarray(x) if isinstance(x, float) else x, line)
    end = 21600.0
    run = eqx.filter_jit(lambda sheet, times: march(sheet, times, profiles, start=held))

    def solved(step: float) -> tuple[np.ndarray, np.ndarray, float, float]:
        times = jnp.arange(0.0, end + 0.5 * step, step)
        begun = time.perf_counter()
        jax.block_until_ready(run(arrays, times).balance)
        first = time.perf_counter() - begun
        begun = time.perf_counter()
        course = jax.block_until_ready(run(arrays, times))
        assert bool(course.converged.all()), "a loop did not converge"
        solid = np.asarray(course.streams["product"].solid)
        print(f"  step {step:g} s: balance {float(course.balance):.1e}")
        return np.asarray(times), solid.sum(axis=(1, 3)), first, time.perf_counter() - begun

    print("sieve–mill process, 200 × 50 classes, 6 h of plant time")
    times, product, first, warm = solved(given.step)
    print(f"  here: {warm:.2f} s (first call {first:.1f} s), {end / warm:.0f} s of plant time a second")
    begun = time.perf_counter()
    reference = by_scipy(line, profiles, held, times)
    print(f"  SciPy BDF on the 200 sums over the attribute only: {time.perf_counter() - begun:.1f} s")
    miss = np.abs(product - reference).max(axis=1) / reference.sum(axis=1).max()
    print(
        f"  largest difference of a size class to SciPy, over the largest product flow: {miss.max():.1e} (median over time {np.median(miss):.1e})"
    )
    if given.program:
        reached, took = other(
            given.program, given.models, given.materials, given.folder / "sieve-mill-process.txt", given.span, given.limit
        )
        print(
            f"  Dyssol: {reached:.0f} s of plant time in {took:.0f} s; at that rate here {end / warm * took / max(reached, 1e-9):.0f} times faster"
        )


if __name__ == "__main__":
    main()
