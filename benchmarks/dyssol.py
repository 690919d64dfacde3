"""Two dynamic flowsheets of the simulator Dyssol 1.1.1 (TUHH, BSD-3), solved here and, where the program is
installed, there.

    python -m benchmarks.dyssol FOLDER_WITH_THE_TWO_SCRIPTS [--program PATH/DyssolC --models FOLDER/
    --materials FILE] [--limit 900] [--plant-time 1200]

The scripts ``sieve-mill-process.txt`` and ``agglomeration-process.txt`` come with Dyssol; Debian ships the
program as ``dyssol``. Without a folder the environment variable DYSSOL_SCRIPTS names it; without either
there is nothing to solve. The first is two screens and two population-balance mills in nested recycles, 200
size × 50 attribute classes, 6 h. The second is an agglomerator, two screens, a mill and a recycle, 320 size
classes, 10 h. Both are solved as flowsheets in time, checked against SciPy on the same equations, and set
against what the program itself makes of them. Times are processor time, since the machine may be shared, and
wall time.
"""

from __future__ import annotations

import argparse
import itertools
import os
import re
import resource
import shutil
import subprocess
import tempfile
import time
from dataclasses import replace
from pathlib import Path
from typing import Any

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
from scipy.integrate import solve_ivp

from benchmarks.rows import Row, tell
from granum.comminution.breakage import AustinBreakage, AustinSelection
from granum.comminution.equipment.mills import BallMill
from granum.comminution.equipment.screens import Screen
from granum.comminution.population import rate_matrix
from granum.flowsheet import Flowsheet
from granum.flowsheet.axes import gather_axes
from granum.flowsheet.dynamics import Profile, march
from granum.particles.partition import MolerusHoffmannPartition, RosinRammlerPartition
from granum.streams.equipment.agglomerator import Agglomerator
from granum.streams.equipment.basics import Mixer, Single
from granum.streams.mixture import Mixture, Species
from granum.streams.stream import Stream, empty
from granum.streams.units import Unit

UREA_DENSITY = 1320.0  # kg/m³, of the data base that comes with the program


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


def sieve_mill(
    data: dict[tuple[str, ...], list[float]],
) -> tuple[Flowsheet, tuple[Profile, ...], dict[str, jax.Array]]:
    """The flowsheet, the feeds and screen settings that change, and what the mills hold at the start."""
    edges = np.array(data["DISTRIBUTION_GRID", "GLOBAL", "SIZE", "NUMERIC", "MANUAL", "DIAMETER"][1:])
    attribute = np.array(data["DISTRIBUTION_GRID", "GLOBAL", "USER_DEFINED_01", "NUMERIC", "MANUAL"][1:])
    sand = Species("sand", (("sand", 1.0),), (2650.0,), (800.0,), 0.0, 0.06)
    mixture = Mixture((sand,), (), (), tuple(edges), (("attribute", tuple(attribute)),))

    def joint(unit: str, holdup: str) -> np.ndarray:
        size = np.array(
            data["HOLDUP_DISTRIBUTION", unit, holdup, "SIZE", "Sand", "MASS_FRACTION", "DIAMETER", "MANUAL"][
                1 : len(edges)
            ]
        )
        other = np.array(
            data["HOLDUP_DISTRIBUTION", unit, holdup, "USER_DEFINED_01", "Sand", "MANUAL"][1 : len(attribute)]
        )
        return np.outer(size / size.sum(), other / other.sum())[None]

    def mill(unit: str) -> BallMill:
        number = {k: data["UNIT_PARAMETER", unit, k][0] for k in ("S1", "S2", "B1", "B2", "B3")}
        # The program reads its laws at class means and counts fragments down from there: laws of single
        # sizes, the default here.
        # The script's laws are powers of volume: a third of the exponents of size.
        selection = AustinSelection(
            1.0, 3 * number["S2"], reference_size=(6 * number["S1"] / np.pi) ** (1 / 3)
        )
        return BallMill(
            selection,
            AustinBreakage(number["B1"], 3 * number["B3"], 3 * number["B2"])
            if number["B2"] > number["B3"]
            else AustinBreakage(1 - number["B1"], 3 * number["B2"], 3 * number["B3"]),
            data["HOLDUP_OVERALL", unit, "Holdup"][1],
        )

    def screen(unit: str) -> Screen:
        return Screen(
            MolerusHoffmannPartition(
                data["UNIT_PARAMETER", unit, "Xcut"][1], data["UNIT_PARAMETER", unit, "Alpha"][1]
            )
        )

    units = {
        "mixer_in": Mixer(),
        "screen1": screen("Screen1"),
        "screen2": screen("Screen2"),
        "mill1": mill("Mill1"),
        "mixer_coarse": Mixer(),
        "mill2": mill("Mill2"),
    }
    feeds, profiles = {}, []
    for name in ("Inlet1", "Inlet2"):
        points = np.array(data["HOLDUP_OVERALL", name, "InputMaterial"]).reshape(-1, 4)
        feeds[name] = empty(mixture, 300.0, 1e5).replace(
            solid=jnp.asarray(joint(name, "InputMaterial")) * 1.0
        )
        profiles.append(
            Profile(f"{name}.mass_flow", np.append(points[:, 0], 1e9), np.append(points[:, 1], points[-1, 1]))
        )
    for unit in ("Screen1", "Screen2"):
        alpha = np.array(data["UNIT_PARAMETER", unit, "Alpha"]).reshape(-1, 2)
        profiles.append(Profile(f"{unit.lower()}.separation.sharpness", alpha[:, 0], alpha[:, 1]))
    links = {
        "Inlet1": ("", "mixer_in.one"),
        "Inlet2": ("", "mixer_in.two"),
        "milled2": ("mill2", "mixer_in.back"),
        "mixed": ("mixer_in", "screen1"),
        "coarse1": ("screen1.oversize", "mill1"),
        "fine1": ("screen1.undersize", "screen2"),
        "coarse2": ("screen2.oversize", "mixer_coarse.two"),
        "milled1": ("mill1", "mixer_coarse.one"),
        "to_mill2": ("mixer_coarse", "mill2"),
        "product": ("screen2.undersize", ""),
    }
    held = {
        unit.lower(): jnp.asarray(joint(unit, "Holdup")) * data["HOLDUP_OVERALL", unit, "Holdup"][1]
        for unit in ("Mill1", "Mill2")
    }
    return Flowsheet(units, feeds, links), tuple(profiles), held


class OnePassCrusher(Unit):
    """The program's cone crusher: King's selection, Vogel's fragments, each particle broken once; the mass it
    loses is made up in proportion.
    """

    smallest: float = eqx.field(static=True)
    largest: float = eqx.field(static=True)
    power: float = eqx.field(static=True)
    fragment_size: float = eqx.field(static=True)
    exponent: float = eqx.field(static=True)

    def matrix(self, edges: np.ndarray) -> np.ndarray:
        """Product by class of each class of the feed, before the loss is made up."""
        d = 0.5 * (edges[1:] + edges[:-1])
        chance = 1.0 - np.clip((self.largest - d) / (self.largest - self.smallest), 0.0, 1.0) ** self.power
        finer = np.tril(
            (d[:, None] / d) ** self.exponent
            * 0.5
            * (1.0 + np.tanh((d - self.fragment_size) / self.fragment_size))
        )
        finer = finer / finer.sum(axis=1, keepdims=True)
        return ((finer - np.diag(np.diag(finer))) * chance[:, None] + np.diag(1.0 - chance)).T

    def outlets(self, inside: None, feed: Stream) -> Single:
        out = feed.regraded(jnp.asarray(self.matrix(feed.mixture.edges)))
        return Single(out.replace(solid=out.solid * (feed.solid_flow / jnp.maximum(out.solid_flow, 1e-300))))

    def figures(self, inside: None, outlets: Single, feed: Stream) -> tuple[()]:
        return ()


class PairKernel(eqx.Module):
    """Brownian kernel with a coefficient of one's own."""

    coefficient: float

    def __call__(self, size: Any, other: Any) -> Any:
        return self.coefficient * (size + other) ** 2 / (size * other)


def agglomeration(
    data: dict[tuple[str, ...], list[float]],
) -> tuple[Flowsheet, tuple[Profile, ...], dict[str, jax.Array]]:
    """The flowsheet and what the agglomerator holds at the start."""
    edges = np.array(data["DISTRIBUTION_GRID", "GLOBAL", "SIZE", "NUMERIC", "MANUAL", "DIAMETER"][1:])
    urea = Species("urea", (("urea", 1.0),), (UREA_DENSITY,), (1500.0,), 0.0, 0.06)
    mixture = Mixture((urea,), (), (), tuple(edges))

    def by_size(unit: str, holdup: str) -> np.ndarray:
        size = np.array(
            data["HOLDUP_DISTRIBUTION", unit, holdup, "SIZE", "Urea", "MASS_FRACTION", "DIAMETER", "MANUAL"][
                1 : len(edges)
            ]
        )
        return (size / size.sum())[None]

    def screen(unit: str) -> Screen:
        cut, sharpness = (data["UNIT_PARAMETER", unit, k][1] for k in ("Xcut", "Alpha"))
        return Screen(RosinRammlerPartition(cut, sharpness))

    king = {k: data["UNIT_PARAMETER", "Mill", k][0] for k in ("CSS", "alpha1", "alpha2", "n", "d'", "q")}
    mass = data["HOLDUP_OVERALL", "Agglomerator", "Holdup"][1]
    units = {
        "mixer_feed": Mixer(),
        "agglomerator": Agglomerator(
            PairKernel(data["UNIT_PARAMETER", "Agglomerator", "Beta0"][0]), mass, 1.0
        ),
        "screen1": screen("Screen1"),
        "screen2": screen("Screen2"),
        "mill": OnePassCrusher(
            king["CSS"] * king["alpha1"], king["CSS"] * king["alpha2"], king["n"], king["d'"], king["q"]
        ),
        "mixer_back": Mixer(),
    }
    feed = empty(mixture, 300.0, 1e5).replace(
        solid=jnp.asarray(by_size("Feed", "InputMaterial"))
        * data["HOLDUP_OVERALL", "Feed", "InputMaterial"][1]
    )
    links = {
        "Feed": ("", "mixer_feed.fresh"),
        "back": ("mixer_back", "mixer_feed.back"),
        "mixed": ("mixer_feed", "agglomerator"),
        "grown": ("agglomerator", "screen1"),
        "coarse1": ("screen1.oversize", "mill"),
        "fine1": ("screen1.undersize", "screen2"),
        "product": ("screen2.oversize", ""),
        "fine2": ("screen2.undersize", "mixer_back.fine"),
        "milled": ("mill", "mixer_back.milled"),
    }
    return (
        Flowsheet(units, {"Feed": feed}, links),
        (),
        {"agglomerator": jnp.asarray(by_size("Agglomerator", "Holdup")) * mass},
    )


def by_scipy(
    line: Flowsheet, profiles: tuple[Profile, ...], held: dict[str, jax.Array], times: np.ndarray
) -> np.ndarray:
    """Product by size from SciPy's BDF: the attribute rides along, so that the sums over it follow the same
    equations.
    """
    edges = np.asarray(next(iter(line.feeds.values())).mixture.edges)
    mills = [line.units["mill1"], line.units["mill2"]]
    a = [np.asarray(rate_matrix(edges, m.selection, m.breakage)) for m in mills]
    feeds = [np.asarray(f.solid_by_size) for f in line.feeds.values()]
    n = len(edges) - 1

    def partition(unit: str, t: float) -> np.ndarray:
        sharp = float(np.interp(t, *next((p.times, p.values) for p in profiles if p.path.startswith(unit))))
        return np.asarray(
            MolerusHoffmannPartition(line.units[unit].separation.cut_size, sharp).over(edges[:-1], edges[1:])
        )

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
        return np.concatenate(
            [
                (f - f.sum() * x) / m.holdup_mass + k @ x
                for f, x, m, k in zip(into[:2], w, mills, a, strict=True)
            ]
        )

    start = np.concatenate([np.asarray(x).sum(axis=(0, 2)) / x.sum() for x in held.values()])
    states = []
    spans = [0.0, 7200.0, 7210.0, 14400.0, 14410.0, times[-1]]
    for lo, hi in itertools.pairwise(spans):
        if lo >= times[-1]:
            break
        hi = min(hi, times[-1])
        inside = times[(times >= lo) & ((times < hi) | (times == times[-1]) & (hi == times[-1]))]
        path = solve_ivp(
            slope, (lo, hi), start, "BDF", np.append(inside[inside < hi], hi), rtol=1e-8, atol=1e-12
        )
        states.append(path.y.T[: len(inside)])
        start = path.y[:, -1]
    return np.stack(
        [flows(t, *y.reshape(2, n))[2] for t, y in zip(times, np.concatenate(states), strict=True)]
    )


def agglomeration_by_scipy(
    line: Flowsheet, held: dict[str, jax.Array], times: np.ndarray, theirs: bool = False
) -> np.ndarray:
    """Product by size from SciPy's LSODA, births by NumPy's convolution.

    ``theirs``: numbers from the volume at the mean diameter of a class, newborn shared out and screens read
    as in the program.
    """
    bed, feed = line.units["agglomerator"], next(iter(line.feeds.values()))
    edges = feed.mixture.edges
    n, middle = len(edges) - 1, 0.5 * (edges[1:] + edges[:-1])
    even = (np.arange(n) + 0.5) * np.pi / 6.0 * edges[-1] ** 3 / n
    size, fresh, mass = np.cbrt(even), np.asarray(feed.solid_by_size), bed.holdup_mass
    volume = np.pi / 6.0 * middle**3 if theirs else even
    part = (1.0 / 6.0 if theirs else 0.0) / (2.0 * np.arange(n + 1) + 1.0)
    stays, moves = 0.5 + part[:n], 0.5 - part[1:]
    curves = [line.units[u].separation for u in ("screen1", "screen2")]
    screens = [np.asarray(c(middle) if theirs else c.over(edges[:-1], edges[1:])) for c in curves]
    crusher = line.units["mill"].matrix(edges)

    def back(out: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        coarse = screens[0] * out
        milled = crusher @ coarse
        product = screens[1] * (out - coarse)
        return milled * coarse.sum() / milled.sum() + out - coarse - product, product

    def slope(_t: float, number: np.ndarray) -> np.ndarray:
        pairs = (np.convolve(number, number) + np.convolve(number * size, number / size))[:n]
        born = stays * pairs
        born[1:] += (moves * pairs)[:-1]
        lost = number * (2.0 * number.sum() + size * (number / size).sum() + (number * size).sum() / size)
        share = number * volume / (number @ volume)
        again, _product = back(share)
        flow = fresh.sum() / (1.0 - again.sum())
        return (
            bed.agglomeration_kernel.coefficient * (born - lost)
            + (fresh + flow * again) / volume / UREA_DENSITY
            - flow * number / mass
        )

    start = np.asarray(held["agglomerator"])[0] / volume / UREA_DENSITY
    found = []
    for number in solve_ivp(slope, (0.0, times[-1]), start, "LSODA", times, rtol=1e-8, atol=1e-6).y.T:
        again, product = back(number * volume / (number @ volume))
        found.append(product * fresh.sum() / (1.0 - again.sum()))
    return np.stack(found)


def other(given: argparse.Namespace, path: Path, end: float) -> tuple[float, float, float, np.ndarray | None]:
    """Plant time that Dyssol got through, its processor and wall time, and the product by time and size class
    if it came to the end.
    """
    text = path.read_text().replace('"Inlet flow"', '"InletFlow"').replace('"Outlet flow"', '"OutletFlow"')
    text = re.sub(r"MODELS_PATH .*\n(?=MODELS_PATH)", "", text)
    with tempfile.TemporaryDirectory() as folder:
        for key, value in {
            "SIMULATION_TIME": f"{end:g}",
            "RESULT_FILE": f'"{folder}/r.dflw"',
            "MATERIALS_DATABASE": f'"{given.materials}"',
            "MODELS_PATH": f'"{given.models}"',
        }.items():
            text = re.sub(rf"{key} .*", lambda _m, key=key, value=value: f"{key} {value}", text)
        (Path(folder) / "case.txt").write_text(text)
        before, begun = _children(), time.perf_counter()
        try:
            said = subprocess.run(
                [given.program, f"-s={folder}/case.txt"],
                capture_output=True,
                text=True,
                timeout=given.limit,
                check=False,
            ).stdout
        except subprocess.TimeoutExpired as late:
            said = (late.stdout or b"").decode()
        took = time.perf_counter() - begun
        reached = [float(x) for x in re.findall(r"\[[\d.e+-]+, ([\d.e+-]+)\]", said)]
        result = Path(folder) / "r.dflw"
        return (
            (reached[-1] if reached else 0.0),
            _children() - before,
            took,
            product_of(result) if result.exists() else None,
        )


def _children() -> float:
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def product_of(path: Path) -> np.ndarray | None:
    """Times (first column) and size classes of the stream that leaves, kg/s, from the program's own file."""
    import h5py

    with h5py.File(path) as file:
        for stream in file["Streams"].values():
            if stream["StreamName"][0] not in (b"Coarse2", b"Fine2") or not len(stream["TimePoints"]):
                continue
            share = stream["Phases/Phase0/Distribution"]
            classes = int(share["Classes"][1]) if len(share["Classes"]) == 2 else 0
            if not classes:
                return None
            blocks = [share[f"Data{i}"][:] for i in range(sum(name.startswith("Data") for name in share))]
            parts = [
                np.concatenate([np.broadcast_to(b[i + 1], (max(map(len, b)),)) for b in blocks])
                for i in range(classes)
            ]
            flow = next(
                o["Data"][:][1]
                for o in stream["Overalls"].values()
                if o["Name"][0].lower().startswith(b"mass")
            )
            return np.column_stack([stream["TimePoints"][:], flow[:, None] * np.stack(parts, 1)])
    return None


def solved(
    line: Flowsheet, profiles: tuple[Profile, ...], held: dict[str, jax.Array], spans: list[tuple[float, int]]
) -> tuple[np.ndarray, np.ndarray, float, float]:
    """Times, product by size class, processor and wall time of a run of several equal numbers of steps, the
    second time it is made.
    """
    run = eqx.filter_jit(lambda held, times: march(line, times, profiles, start=held))
    for _again in range(2):
        processor, begun, state, t0, times, product = (
            time.process_time(),
            time.perf_counter(),
            held,
            0.0,
            [],
            [],
        )
        for end, steps in spans:
            course = run(state, jnp.linspace(t0, end, steps + 1))
            assert bool(course.converged.all()), "a loop did not converge"
            state, t0 = course.holdups, end
            solid = np.asarray(course.streams["product"].solid)
            times.append(np.asarray(course.times)[int(bool(times)) :])
            product.append(solid.sum(axis=(1, *range(3, solid.ndim)))[int(bool(product)) :])
    return (
        np.concatenate(times),
        np.concatenate(product),
        time.process_time() - processor,
        time.perf_counter() - begun,
    )


def compare(name: str, given: argparse.Namespace, spans: list[tuple[float, int]]) -> None:
    """One problem, here, by SciPy and by the program."""
    path = given.folder / f"{name}-process.txt"
    spans = [
        (min(end, given.plant_time), steps)
        for start, (end, steps) in zip([0.0, *(s[0] for s in spans)], spans, strict=False)
        if start < given.plant_time
    ]
    line, profiles, held = (sieve_mill if name == "sieve-mill" else agglomeration)(script(path))
    few = gather_axes(line, held)
    end = spans[-1][0]
    times, product, processor, wall = solved(few.line, profiles, few.holdups, spans)
    reference = (
        by_scipy(line, profiles, held, times)
        if name == "sieve-mill"
        else agglomeration_by_scipy(line, held, times)
    )
    miss = np.abs(product - reference).sum(axis=1) / reference.sum(axis=1)
    here = Row(
        f"{name}, {end:g} s of plant time in {len(times) - 1} steps",
        processor,
        "Dyssol",
        kind="dyssol",
        agreement=f"{0.5 * miss.max():.1e} of the product in another class than SciPy has it",
        figures={"wall, s": wall},
    )
    if not given.program:
        tell(here)
        return
    reached, theirs, took, found = other(given, path, end)
    if reached >= end:
        tell(replace(here, peer_seconds=theirs, figures={**here.figures, "Dyssol, wall, s": took}))
    else:
        late = f"{reached:.0f} s of plant time in {theirs:.0f} s"
        tell(replace(here, peer=None, figures={**here.figures, "Dyssol, not to the end": late}))
    if found is not None:
        there = np.stack([np.interp(times, found[:, 0], column) for column in found[:, 1:].T], 1)

        def off(product: np.ndarray) -> str:
            miss = 0.5 * np.abs(product - there).sum(axis=1) / there.sum(axis=1)
            return f"at most {miss.max():.1e}, at the end {miss[-1]:.1e}"

        print(f"  share of the product in another class than Dyssol has it: {off(product)}")
        if name == "agglomeration":
            print(
                f"  the same for SciPy with the class numbers that Dyssol works with: "
                f"{off(agglomeration_by_scipy(line, held, times, True))}"
            )


def main() -> None:
    options = argparse.ArgumentParser(description=__doc__)
    options.add_argument("folder", type=Path, nargs="?", default=os.environ.get("DYSSOL_SCRIPTS"))
    options.add_argument("--program", type=Path, default=shutil.which("DyssolC"))
    options.add_argument("--models", default="/usr/lib/x86_64-linux-gnu/Dyssol/Units/")
    options.add_argument("--materials", default="/usr/share/Dyssol/MaterialsDB/Materials.dmdb")
    options.add_argument(
        "--limit", type=float, default=900.0, help="seconds given to Dyssol for each problem"
    )
    options.add_argument(
        "--plant-time", type=float, default=np.inf, help="seconds of plant time after which both stop"
    )
    given = options.parse_args()
    if given.folder is None:
        tell(Row("the two flowsheets of Dyssol", peer="Dyssol", kind="dyssol"))
        return
    compare("agglomeration", given, [(1500.0, 300), (9000.0, 300), (36000.0, 300)])
    compare("sieve-mill", given, [(end, 300) for end in (300.0, 7200.0, 7500.0, 14400.0, 14700.0, 21600.0)])


if __name__ == "__main__":
    main()
