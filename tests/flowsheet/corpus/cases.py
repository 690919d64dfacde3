"""Hard recycles: units made for the purpose, flowsheets, and what is known about their solutions."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

import jax.numpy as jnp
import numpy as np
from tests.sharing.places import EXAMPLES

import granum as gr
from granum.comminution.breakage import AustinBreakage, AustinSelection
from granum.comminution.equipment.mills import BallMill
from granum.comminution.equipment.screens import DoubleDeckScreen, Screen
from granum.flowsheet import Flowsheet
from granum.numerics import find_root
from granum.particles.partition import RosinRammlerPartition
from granum.streams.equipment.basics import Heater, Mixer, Single, Splitter, TwoWays
from granum.streams.mixture import Mixture, Species
from granum.streams.stream import Stream, empty
from granum.streams.units import Unit


class _Nothing(NamedTuple):
    """No figures."""


class _Made(Unit):
    """A unit of the corpus: no figures."""

    def figures(self, inside: None, outlets: Any, **inlets: Stream) -> _Nothing:
        return _Nothing()


class Separator(_Made):
    """Sends a share of each liquid component to the side."""

    shares: Any

    def outlets(self, inside: None, feed: Stream) -> TwoWays:
        side = feed.replace(liquid=feed.liquid * jnp.asarray(self.shares))
        return TwoWays(feed.replace(liquid=feed.liquid - side.liquid), side)


class Reactor(_Made):
    """Turns components into one another by a matrix whose columns add up to 1."""

    matrix: Any

    def outlets(self, inside: None, feed: Stream) -> Single:
        return Single(feed.replace(liquid=jnp.asarray(self.matrix) @ feed.liquid))


class Limited(_Made):
    """Passes at most a capacity; the rest goes to the side."""

    capacity: Any

    def outlets(self, inside: None, feed: Stream) -> TwoWays:
        share = jnp.minimum(self.capacity / jnp.maximum(feed.mass_flow, 1e-300), 1.0)
        return TwoWays(feed.part(share, share, share), feed.part(1 - share, 1 - share, 1 - share))


class Weir(_Made):
    """The side flow answers its feed steeply: share = 1/(1 + (flow/scale)^power)."""

    scale: Any
    power: Any

    def outlets(self, inside: None, feed: Stream) -> TwoWays:
        share = 1.0 / (1.0 + (feed.mass_flow / self.scale) ** self.power)
        return TwoWays(feed.part(1 - share, 1 - share, 1 - share), feed.part(share, share, share))


class Exchanger(_Made):
    """Feed–effluent exchanger: takes both streams a share of the way to each other's temperature."""

    effectiveness: Any

    def outlets(self, inside: None, cold: Stream, hot: Stream) -> TwoWays:
        duty = self.effectiveness * (hot.enthalpy_flow - hot.enthalpy_at(cold.temperature))
        return TwoWays(cold.heated(duty), hot.heated(-duty))


class Flash(_Made):
    """Isothermal flash of molar flows with K-values by Wilson; "liquid" flows stand for moles."""

    ratios: Any

    def outlets(self, inside: None, feed: Stream) -> TwoWays:
        moles, k = feed.liquid, jnp.asarray(self.ratios)
        z = moles / jnp.maximum(jnp.sum(moles), 1e-300)

        def balance(v: Any) -> Any:
            return jnp.sum(z * (k - 1.0) / (1.0 + v[..., None] * (k - 1.0)), axis=-1)

        inside = (jnp.sum(z * k) > 1.0) & (jnp.sum(z / k) > 1.0)
        root = find_root(balance, 0.0, 1.0).value
        v = jnp.where(
            inside, jnp.where(jnp.isfinite(root), root, 0.5), jnp.where(jnp.sum(z * k) > 1.0, 1.0, 0.0)
        )
        vapor = feed.replace(liquid=moles * v * k / (1.0 + v * (k - 1.0)))
        return TwoWays(feed.replace(liquid=moles - vapor.liquid), vapor)


class Case(NamedTuple):
    """A flowsheet and, where it is known, the flow of a stream by hand or by another way of solving."""

    line: Flowsheet
    stream: str = ""
    expected: Any = None


def mixture(count: int) -> Mixture:
    species = tuple(
        Species(f"c{i}", ((f"c{i}", 1.0),), (1000.0,), (4000.0,), 0.0, 0.02) for i in range(count)
    )
    return Mixture((), species, (), (1e-6, 1e-3))


def feed(*flows: float, temperature: float = 300.0) -> Stream:
    return empty(mixture(len(flows)), temperature).replace(liquid=jnp.asarray(flows))


def simple(fraction: float) -> Case:
    units = {"mix": Mixer(), "split": Splitter(fraction)}
    links = {"f": ("", "mix.f"), "m": ("mix", "split"), "back": ("split.side", "mix.back")}
    return Case(Flowsheet(units, {"f": feed(1.0)}, links), "m", 1.0 / max(1.0 - fraction, 1e-300))


def nested(*fractions: float) -> Case:
    """A chain of mixers, each fed back from a splitter behind all inner ones: flow multiplied at each
    level.
    """
    n = len(fractions)
    units = {f"mix{i}": Mixer() for i in range(n)} | {f"split{i}": Splitter(fractions[i]) for i in range(n)}
    links = {"f": ("", "mix0.f")}
    for i in range(n - 1):
        links[f"in{i}"] = (f"mix{i}", f"mix{i + 1}.f")
        links[f"out{i}"] = (f"split{i + 1}.product", f"split{i}")
    links["core"] = (f"mix{n - 1}", f"split{n - 1}")
    links |= {f"back{i}": (f"split{i}.side", f"mix{i}.back") for i in range(n)}
    return Case(
        Flowsheet(units, {"f": feed(1.0)}, links),
        "core",
        float(np.prod([1.0 / (1.0 - x) for x in fractions])),
    )


def crossed() -> Case:
    """Two loops that overlap without one lying in the other: a -> b -> c -> d with c -> a and d -> b."""
    units = {"a": Mixer(), "b": Mixer(), "c": Splitter(0.6), "d": Splitter(0.7)}
    links = {
        "f": ("", "a.f"),
        "ab": ("a", "b.f"),
        "bc": ("b", "c"),
        "cd": ("c.product", "d"),
        "ca": ("c.side", "a.back"),
        "db": ("d.side", "b.back"),
    }
    # x = flow b -> c: x = (1 + 0.6 x) + 0.7·0.4 x
    return Case(Flowsheet(units, {"f": feed(1.0)}, links), "bc", 1.0 / (1.0 - 0.6 - 0.28))


def figure_eight() -> Case:
    """Two loops that share one splitter."""
    units = {"m1": Mixer(), "s": Splitter(0.5), "m2": Mixer(), "s2": Splitter(0.8), "s1": Splitter(0.9)}
    links = {
        "f": ("", "m1.f"),
        "x": ("m1", "s"),
        "up": ("s.side", "s1"),
        "back1": ("s1.side", "m1.back"),
        "down": ("s.product", "m2.f"),
        "y": ("m2", "s2"),
        "back2": ("s2.side", "m2.back"),
    }
    return Case(Flowsheet(units, {"f": feed(1.0)}, links), "y", 0.5 / (1.0 - 0.45) / (1.0 - 0.8))


def purge(fraction: float) -> Case:
    """Reaction with an inert that only the purge lets out (ammonia synthesis in small): conversion 25 % a
    pass, product taken off.
    """
    units = {
        "mix": Mixer(),
        "reactor": Reactor(np.array([[0.75, 0.0, 0.0], [0.25, 1.0, 0.0], [0.0, 0.0, 1.0]])),
        "separator": Separator(np.array([0.0, 1.0, 0.0])),
        "purge": Splitter(fraction),
    }
    links = {
        "f": ("", "mix.f"),
        "in": ("mix", "reactor"),
        "out": ("reactor", "separator"),
        "gas": ("separator.product", "purge"),
        "back": ("purge.product", "mix.back"),
    }
    left = 1.0 - fraction
    return Case(
        Flowsheet(units, {"f": feed(0.99, 0.0, 0.01)}, links),
        "in",
        [0.99 / (1.0 - 0.75 * left), 0.0, 0.01 / max(fraction, 1e-300)],
    )


def stiff_components() -> Case:
    shares = np.array([1e-4, 0.01, 0.2, 0.5, 0.8, 0.99, 0.999, 0.9999])
    units = {"mix": Mixer(), "separator": Separator(shares)}
    links = {"f": ("", "mix.f"), "m": ("mix", "separator"), "back": ("separator.side", "mix.back")}
    return Case(Flowsheet(units, {"f": feed(*np.full(8, 0.125))}, links), "m", 0.125 / (1.0 - shares))


def kinked(capacity: float) -> Case:
    """What a limited unit does not take goes round; the product leaves by another share. At 2 the limit is
    just met.
    """
    units = {"mix": Mixer(), "limited": Limited(capacity), "split": Splitter(0.5)}
    links = {
        "f": ("", "mix.f"),
        "m": ("mix", "limited"),
        "passed": ("limited.product", "split"),
        "back": ("split.side", "mix.back"),
    }
    x = 2.0 if capacity >= 2.0 else 1.0 + 0.5 * capacity  # m = 1 + half of what passes
    return Case(Flowsheet(units, {"f": feed(1.0)}, links), "m", x)


def weir(power: float, fraction: float = 1.0) -> Case:
    """The recycle falls steeply where its feed grows: repeated substitution swings and runs away."""
    units = {"mix": Mixer(), "weir": Weir(2.0, power)}
    links = {"f": ("", "mix.f"), "m": ("mix", "weir"), "back": ("weir.side", "mix.back")}
    from scipy.optimize import brentq

    x = brentq(lambda m: m - 1.0 - m / (1.0 + (m / 2.0) ** power), 1.0, 1e3, xtol=1e-14)
    return Case(Flowsheet(units, {"f": feed(1.0)}, links), "m", x)


def spiral() -> Case:
    """Components that turn into one another in a circle while they go round: complex eigenvalues of modulus
    0.97.
    """
    turn = np.roll(np.eye(5), 1, axis=0)
    units = {"mix": Mixer(), "reactor": Reactor(turn), "split": Splitter(0.97)}
    links = {
        "f": ("", "mix.f"),
        "m": ("mix", "reactor"),
        "r": ("reactor", "split"),
        "back": ("split.side", "mix.back"),
    }
    flows = np.array([1.0, 0.0, 0.0, 0.0, 0.0])
    return Case(
        Flowsheet(units, {"f": feed(*flows)}, links), "m", np.linalg.solve(np.eye(5) - 0.97 * turn, flows)
    )


def heat_loop(effectiveness: float) -> Case:
    """Cold feed warmed by the hot product it becomes: a loop in temperature alone."""
    units = {"exchanger": Exchanger(effectiveness), "heater": Heater(temperature=400.0)}
    links = {
        "f": ("", "exchanger.cold"),
        "warm": ("exchanger.product", "heater"),
        "hot": ("heater", "exchanger.hot"),
    }
    return Case(Flowsheet(units, {"f": feed(1.0)}, links), "hot", 1.0)


def washing(stages: int) -> Case:
    """Counter-current washing: each stage mixes, and the thick stream keeps a fifth of the liquid."""
    units: dict[str, Unit] = {}
    links: dict[str, tuple[str, str]] = {"f": ("", "mix0.f"), "w": ("", f"mix{stages - 1}.wash")}
    for i in range(stages):
        units |= {f"mix{i}": Mixer(), f"settle{i}": Splitter(0.2)}
        links[f"m{i}"] = (f"mix{i}", f"settle{i}")
        if i + 1 < stages:
            links[f"thick{i}"] = (f"settle{i}.side", f"mix{i + 1}.f")
            links[f"clear{i + 1}"] = (f"settle{i + 1}.product", f"mix{i}.back")
    a = np.eye(stages)
    for i in range(stages - 1):
        a[i + 1, i] -= 0.2
        a[i, i + 1] -= 0.8
    right = np.zeros((stages, 2))
    right[0, 0], right[-1, 1] = 1.0, 4.0
    flows = np.linalg.solve(a, right)
    return Case(Flowsheet(units, {"f": feed(1.0, 0.0), "w": feed(0.0, 4.0)}, links), "m0", flows[0])


# Cavett's sixteen components: N2, CO2, H2S, C1 … C11 (Rosen and Pauls 1977, table 1): critical temperature K,
# pressure bar, acentric factor, feed lbmol/h
CAVETT = np.array([
    (126.2, 33.9, 0.040, 358.2), (304.2, 73.8, 0.225, 4965.6), (373.2, 89.4, 0.100, 339.4), (190.6, 46.0, 0.008, 2995.5), (305.4, 48.8, 0.098, 2395.5),  # noqa: E501
    (369.8, 42.5, 0.152, 2291.0), (408.1, 36.5, 0.176, 604.1), (425.2, 38.0, 0.193, 1539.9), (460.4, 33.8, 0.227, 790.4), (469.6, 33.7, 0.251, 1129.9),  # noqa: E501
    (507.4, 29.7, 0.296, 1764.7), (540.2, 27.4, 0.351, 2606.7), (568.8, 24.8, 0.394, 1844.5), (594.6, 22.9, 0.444, 1669.0), (617.6, 21.1, 0.490, 831.7),  # noqa: E501
    (638.8, 19.7, 0.535, 1214.5),
])  # fmt: skip


def wilson(temperature: float, pressure: float) -> np.ndarray:
    """K-values by Wilson's equation; pressure in bar."""
    tc, pc, w = CAVETT[:, :3].T
    return pc / pressure * np.exp(5.373 * (1.0 + w) * (1.0 - tc / temperature))


def cavett() -> Case:
    """Cavett's (1963) four flashes, with Wilson's K-values: three loops in one another."""
    drums = {"drum1": (311.0, 56.3), "drum2": (322.0, 19.6), "drum3": (309.0, 4.4), "drum4": (303.0, 1.9)}
    units: dict[str, Unit] = {name: Flash(wilson(*at)) for name, at in drums.items()}
    units |= {"mix1": Mixer(), "mix2": Mixer(), "mix3": Mixer()}
    links = {
        "f": ("", "mix2.f"),
        "to1": ("mix1", "drum1"),
        "to2": ("mix2", "drum2"),
        "to3": ("mix3", "drum3"),
        "gas2": ("drum2.side", "mix1.gas"),
        "liquid1": ("drum1.product", "mix2.liquid"),
        "liquid2": ("drum2.product", "mix3.liquid"),
        "gas3": ("drum3.side", "mix2.gas"),
        "liquid3": ("drum3.product", "drum4"),
        "gas4": ("drum4.side", "mix3.gas"),
    }
    line = Flowsheet(units, {"f": feed(*(CAVETT[:, 3] / 27340.6))}, links)
    return Case(line)


def solids(classes: int) -> tuple[Mixture, Stream]:
    rock = Species("rock", (("rock", 1.0),), (2650.0,), (800.0,), 0.0, 0.06)
    m = Mixture((rock,), (), (), tuple(np.geomspace(1e-5, 1e-2, classes + 1)))
    middle = np.log(m.sizes / 3e-3)
    shares = np.exp(-(middle**2))
    return m, empty(m, 300.0).replace(solid=jnp.asarray(shares / shares.sum())[None, :] * 10.0)


def mill(holdup: float = 2000.0) -> BallMill:
    return BallMill(AustinSelection(0.01, 0.9), AustinBreakage(0.5, 0.8, 4.0), holdup)


def deck(cut: float, sharpness: float = 4.0) -> RosinRammlerPartition:
    return RosinRammlerPartition(cut, sharpness)


def grinding(cut: float, sharpness: float, holdup: float = 2000.0) -> Case:
    _m, rock = solids(40)
    units = {"mix": Mixer(), "mill": mill(holdup), "screen": Screen(deck(cut, sharpness))}
    links = {
        "f": ("", "mix.f"),
        "m": ("mix", "mill"),
        "g": ("mill", "screen"),
        "back": ("screen.oversize", "mix.back"),
        "p": ("screen.undersize", ""),
    }
    return Case(Flowsheet(units, {"f": rock}, links), "p", 10.0)


def two_mills() -> Case:
    """Two screens and two mills in loops within one another, as in Dyssol's sieve–mill process."""
    _m, rock = solids(60)
    units = {
        "mix": Mixer(),
        "screen1": Screen(deck(2e-3)),
        "screen2": Screen(deck(5e-4)),
        "mill1": mill(3000.0),
        "mix2": Mixer(),
        "mill2": mill(5000.0),
    }
    links = {
        "f": ("", "mix.f"),
        "m": ("mix", "screen1"),
        "c1": ("screen1.oversize", "mill1"),
        "u1": ("screen1.undersize", "screen2"),
        "c2": ("screen2.oversize", "mix2.c"),
        "g1": ("mill1", "mix2.g"),
        "to2": ("mix2", "mill2"),
        "back": ("mill2", "mix.back"),
        "p": ("screen2.undersize", ""),
    }
    return Case(Flowsheet(units, {"f": rock}, links), "p", 10.0)


def three_decks() -> Case:
    """Oversize to one mill, middlings half to another and half out."""
    _m, rock = solids(50)
    units = {
        "mix": Mixer(),
        "screen": DoubleDeckScreen(deck(3e-3), deck(3e-4)),
        "coarse": mill(4000.0),
        "half": Splitter(0.9),
        "fine": mill(8000.0),
    }
    links = {
        "f": ("", "mix.f"),
        "m": ("mix", "screen"),
        "o": ("screen.oversize", "coarse"),
        "i": ("screen.middlings", "half"),
        "h": ("half.side", "fine"),
        "back1": ("coarse", "mix.b1"),
        "back2": ("fine", "mix.b2"),
    }
    return Case(Flowsheet(units, {"f": rock}, links))


def example(name: str) -> Case:
    return Case(gr.read(EXAMPLES / name).sheet)


CASES: dict[str, Callable[[], Case]] = {
    "half goes round": lambda: simple(0.5),
    "99 % goes round": lambda: simple(0.99),
    "99.99 % goes round": lambda: simple(0.9999),
    "two nested": lambda: nested(0.5, 0.8),
    "four nested": lambda: nested(0.5, 0.7, 0.6, 0.8),
    "crossed loops": crossed,
    "two loops at one splitter": figure_eight,
    "inert, purge of 2 %": lambda: purge(0.02),
    "inert, purge of 0.1 %": lambda: purge(1e-3),
    "inert, purge of 0.001 %": lambda: purge(1e-5),
    "eight components, gains 1e-4 to 0.9999": stiff_components,
    "limit not reached": lambda: kinked(5.0),
    "limit just met": lambda: kinked(2.0),
    "limit active": lambda: kinked(1.2),
    "swinging, slope -1": lambda: weir(4.0),
    "swinging, slope -5": lambda: weir(12.0),
    "swinging, slope -20": lambda: weir(40.0),
    "five components in a circle": spiral,
    "heat recovered, 60 %": lambda: heat_loop(0.6),
    "heat recovered, 97 %": lambda: heat_loop(0.97),
    "heat recovered, 99.9 %": lambda: heat_loop(0.999),
    "washing in 5 stages": lambda: washing(5),
    "washing in 12 stages": lambda: washing(12),
    "Cavett's four flashes": cavett,
    "grinding, blunt screen": lambda: grinding(3e-4, 1.5),
    "grinding, sharp screen, fine cut": lambda: grinding(6e-5, 8.0, 3e4),
    "two mills, two screens": two_mills,
    "double deck, two mills": three_decks,
    "grinding circuit of the examples": lambda: example("grinding-circuit/circuit.toml"),
    "ore line of the examples": lambda: example("ore-grinding/line.toml"),
}

REFUSED: dict[str, Callable[[], Case]] = {
    "no way out": lambda: simple(1.0),
    "mill too small for its circuit": lambda: grinding(6e-5, 8.0, 2000.0),
    "inert without a purge": lambda: purge(0.0),
}
