"""Populations that grow and dissolve side by side in one liquor: forms that draw on one solute, or
enantiomers that each have their own and change each other's solubility.

Each step solves for the composition at its end: growth paths of all forms follow from it, and the balance of
each solute must give it back. A richer solution grows more crystals, so that the root is bracketed; solutes
and crystals are conserved to rounding.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
from jax import lax

from granum.crystallization.population.compiled import compiled
from granum.crystallization.population.composition import Trial, settled
from granum.crystallization.population.packets import Packets, Seeds, mean_power
from granum.crystallization.vessels.crystals import Crystal
from granum.numerics.smooth import safe_divide

SWEEPS = 2  # over the solutes of a step, each with the other as last found


class Form(eqx.Module):
    """One crystal form: its solubility, what its crystals do, and what each is.

    ``salting`` is what the other solute over this one's own solubility adds to the logarithm of it
    (Setschenow).
    """

    solubility: Any
    growth: Any
    nucleation: Any
    dissolution: Any
    crystal: Crystal
    salting: Any = 0.0

    def saturated(self, temperature: Any, other: Any) -> Any:
        """Solubility beside so much of the other solute, per kg of solvent."""
        alone = self.solubility(temperature)
        return alone * jnp.exp(self.salting * other / alone)

    def rate(self, ratio: Any, saturated: Any, temperature: Any) -> Any:
        """Growth rate, negative for dissolution."""
        grows = self.growth(ratio, saturated, temperature)
        return grows if self.dissolution is None else grows - self.dissolution(ratio, saturated, temperature)


class Rivals(eqx.Module):
    """Two forms, the solute of each by its place, and the share of the other's magma that counts in the
    births of each.
    """

    forms: tuple[Form, Form]
    liquid_density: Any
    cross_nucleation: tuple[Any, Any]
    solutes: tuple[int, int] = eqx.field(static=True, default=(0, 0))

    def saturated(self, ratios: Any, temperature: Any) -> list[Any]:
        """Solubility of each form in this liquor."""
        whole = jnp.sum(ratios)
        return [
            form.saturated(temperature, whole - ratios[i])
            for form, i in zip(self.forms, self.solutes, strict=True)
        ]

    def kinetics(self, ratios: Any, T: Any, mass: list[Any]) -> tuple[list[Any], list[Any]]:
        """Growth rates and births of both forms."""
        forms, a = self.forms, self.cross_nucleation
        volume = (1.0 + jnp.sum(ratios)) / self.liquid_density + sum(
            m / f.crystal.density for m, f in zip(mass, forms, strict=True)
        )
        magma = [(mass[0] + a[0] * mass[1]) / volume, (mass[1] + a[1] * mass[0]) / volume]
        saturated = self.saturated(ratios, T)
        given = [ratios[i] for i in self.solutes]
        rates = [f.rate(c, s, T) for f, c, s in zip(forms, given, saturated, strict=True)]
        born = [
            volume * f.nucleation(c, s, T, m)
            for f, c, s, m in zip(forms, given, saturated, magma, strict=True)
        ]
        return rates, born


class _Step(Trial):
    """One time step of the forms that draw on one solute, the composition in all else being given."""

    rivals: Rivals
    crystals: tuple[Packets, Packets]
    mass: list[Any]
    before: list[Any]
    births: list[Any]
    temperature: Any
    span: Any
    ratios: Any
    total: Any
    solute: int = eqx.field(static=True)

    @property
    def mine(self) -> list[int]:
        return [form for form, i in enumerate(self.rivals.solutes) if i == self.solute]

    def _later(self, ratio: Any) -> tuple[list[Any], list[Any]]:
        ratios = self.ratios.at[self.solute].set(ratio)
        rates, born = self.rivals.kinetics(ratios, self.temperature, self.mass)
        return [rates[i] for i in self.mine], [born[i] for i in self.mine]

    def rates_before(self) -> list[Any]:
        return [self.before[i] for i in self.mine]

    def rates(self, ratio: Any) -> list[Any]:
        return self._later(ratio)[0]

    def after(self, ratio: Any, weights: list[Any]) -> tuple[list[Any], list[Any]]:
        """Growth paths and births of these forms."""
        later, more = self._later(ratio)
        paths = [
            self.span * ((1.0 - w) * a + w * b)
            for w, a, b in zip(weights, self.rates_before(), later, strict=True)
        ]
        born = [0.5 * self.span * (self.births[i] + b) for i, b in zip(self.mine, more, strict=True)]
        return paths, born

    def left(self, ratio: Any, weights: list[Any]) -> Any:
        held = 0.0
        for i, path, number in zip(self.mine, *self.after(ratio, weights), strict=True):
            grown = self.crystals[i].cubes_after(path)
            newborn = number * mean_power(0.0, jnp.maximum(path, 0.0), 3)
            held = held + self.rivals.forms[i].crystal.mass_per_cube * (grown + newborn)
        return self.total - held


class State(NamedTuple):
    """Crystals of both forms and solutes per kg of solvent."""

    crystals: tuple[Packets, Packets]
    ratios: Any


class Row(NamedTuple):
    """What is kept of each time: temperature, solutes, solubilities, masses and mean sizes of both forms."""

    temperature: Any
    ratios: Any
    saturated: Any
    masses: Any
    sizes: Any


@compiled
def compete(
    rivals: Rivals, seeds: tuple[Seeds, Seeds], program: Any, ratios: Any, times: Any
) -> tuple[State, Row]:
    """Follow both forms through given times, one kg of solvent: the end, and rows over time."""
    times = jnp.asarray(times, dtype=float)
    ratios = jnp.asarray(ratios, dtype=float)
    steps, solutes = times.shape[0] - 1, ratios.shape[0]
    cubes = [form.crystal.mass_per_cube for form in rivals.forms]
    kept = [seed.low.shape[0] for seed in seeds]

    def room(seed: Seeds) -> Packets:
        low, high, number = (jnp.append(x, jnp.zeros(steps)) for x in (seed.low, seed.high, seed.number))
        return Packets(low, high, number)

    def masses(crystals: tuple[Packets, Packets]) -> list[Any]:
        return [c * p.moments()[3] for c, p in zip(cubes, crystals, strict=True)]

    def drawn(mass: list[Any]) -> Any:
        """Crystals by the solute that they are of."""
        return jnp.zeros(solutes).at[np.array(rivals.solutes)].add(jnp.stack(mass))

    total = ratios + drawn([c * s.moments()[3] for c, s in zip(cubes, seeds, strict=True)])

    def row(state: State, T: Any) -> Row:
        moments = [p.moments() for p in state.crystals]
        return Row(
            T + jnp.zeros(()),
            state.ratios,
            jnp.stack([s + jnp.zeros(()) for s in rivals.saturated(state.ratios, T)]),
            jnp.stack(masses(state.crystals)),
            jnp.stack([safe_divide(m[4], m[3]) for m in moments]),
        )

    def advance(state: State, given: tuple[Any, Any, Any]) -> tuple[State, Row]:
        start, end, index = given
        T, mass = program(end), masses(state.crystals)
        rates, births = rivals.kinetics(state.ratios, program(start), mass)

        def sweep(_number: Any, carry: tuple[Any, Any]) -> tuple[Any, Any]:
            """Composition, and the growth path and births of each form, one solute after the other."""
            found, moved = carry
            for j in range(solutes):
                step = _Step(rivals, state.crystals, mass, rates, births, T, end - start, found, total[j], j)
                c, weights = settled(step, state.ratios[j], total[j])
                found = found.at[j].set(c)
                moved = moved.at[np.array(step.mine)].set(jnp.asarray(step.after(c, weights)).T)
            return found, moved

        begun = (state.ratios, jnp.zeros((2, 2)))
        moved = lax.fori_loop(0, SWEEPS if solutes > 1 else 1, sweep, begun)[1]
        grown = tuple(
            p.grown(moved[i, 0], moved[i, 1], 0.0, kept[i] + index) for i, p in enumerate(state.crystals)
        )
        new = State((grown[0], grown[1]), total - drawn(masses((grown[0], grown[1]))))
        return new, row(new, T)

    first = State((room(seeds[0]), room(seeds[1])), ratios)
    last, rows = lax.scan(advance, first, (times[:-1], times[1:], jnp.arange(steps)))
    begin = row(first, program(times[0]))
    return last, jax.tree.map(lambda a, b: jnp.concatenate([jnp.asarray(a)[None], b]), begin, rows)


def halved(times: Any) -> Any:
    """The same times with every second step of zero length, so that both are one compiled program."""
    index = np.arange(times.shape[0])
    return times[index + index % 2]
