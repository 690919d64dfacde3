"""The default engine: packets along the growth path, the solute by algebra, one bracketed scalar equation a step.

Each step solves ``d = dt [(1 − θ) G_n + θ G(c(d))]`` for the growth path ``d``, where the composition ``c(d)`` follows exactly from
the solute balance. θ is fitted so that exponential relaxation is met: 1/2 for slow steps (second order), 1 for stiff ones,
which never undershoots saturation. Mass is conserved to rounding whatever the step.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import equinox as eqx
import jax
import jax.numpy as jnp
from jax import lax

from granum.crystallization.population.compiled import compiled
from granum.crystallization.population.operations import Contents, Operation
from granum.crystallization.population.packets import Packets, Population, Seeds, ShiftedMoments, SizeMap
from granum.crystallization.vessels.crystals import Crystal, ratio_left

NEWTON_STEPS = 7  # of the scalar closure; its slope is monotone, so that Newton from the explicit end does not overshoot


class SuspensionVolume(eqx.Module):
    """Volume on which nucleation is counted: liquor of constant density plus crystals."""

    liquid_density: Any

    def __call__(self, liquor: Any, solvent: Any, crystals: Any, crystal: Crystal) -> Any:
        return liquor / self.liquid_density + crystals / crystal.density


class SolventVolume(eqx.Module):
    """Volume on which nucleation is counted: the pure solvent, as in kinetics given per mass or volume of solvent."""

    solvent_density: Any

    def __call__(self, liquor: Any, solvent: Any, crystals: Any, crystal: Crystal) -> Any:
        return solvent / self.solvent_density


class Model(eqx.Module):
    """What happens inside the vessel.

    Parameters
    ----------
    solubility: kg of anhydrous solute per kg of solvent from temperature (and antisolvent fraction, where the law takes it).
    growth: rate of size from (solute per solvent, solubility, temperature). nucleation: the same with the magma density.
    crystal: the crystal. volume: what nucleation rates and magma densities are counted on.
    dissolution: positive rate of shrinking below saturation; None where the solution stays supersaturated.
    size_map: size dependence of growth, or None. nucleus_size: m.
    """

    solubility: Any
    growth: Any
    nucleation: Any
    crystal: Crystal
    volume: Any
    dissolution: Any = None
    size_map: SizeMap | None = None
    nucleus_size: Any = 0.0

    def saturated(self, contents: Contents) -> Any:
        """Solubility at the temperature (and antisolvent fraction) of the contents."""
        if getattr(self.solubility, "takes_antisolvent", False):
            return self.solubility(contents.temperature, contents.antisolvent / contents.solvent)
        return self.solubility(contents.temperature)

    def ratio(self, contents: Contents, crystals: Any) -> Any:
        """Solute per solvent left in solution."""
        return ratio_left(contents.solute, contents.solvent, crystals, self.crystal.solute_fraction)

    def rate(self, ratio: Any, saturated: Any, temperature: Any) -> Any:
        """Growth rate, negative for dissolution."""
        rate = self.growth(ratio, saturated, temperature)
        return rate if self.dissolution is None else rate - self.dissolution(ratio, saturated, temperature)

    def births(self, ratio: Any, saturated: Any, contents: Contents, crystals: Any) -> Any:
        """Nuclei born in the whole vessel per second, 1/s."""
        x = self.crystal.solute_fraction
        solvent = contents.solvent - (1.0 - x) * crystals
        liquor = contents.solute + contents.solvent - crystals
        volume = self.volume(liquor, solvent, crystals, self.crystal)
        return volume * self.nucleation(ratio, saturated, contents.temperature, crystals / volume)


class Course(NamedTuple):
    """What a batch went through, at the times of its steps (the start included), shape (steps + 1,).

    time: s. temperature: K. solute_per_solvent, solubility_per_solvent: kg/kg. crystals: kg in the vessel.
    moments: 0 to 4 of all crystals in the vessel, (steps + 1, 5). growth_rate: m/s. births: 1/s.
    solvent: total, kg. path: growth path since the start, m. born: crystals born in each step, (steps,).
    residual: of the closure of each step, relative.
    """

    time: Any
    temperature: Any
    solute_per_solvent: Any
    solubility_per_solvent: Any
    crystals: Any
    moments: Any
    growth_rate: Any
    births: Any
    solute: Any
    solvent: Any
    path: Any
    born: Any
    residual: Any
    final: Packets


class _State(NamedTuple):
    population: Population
    contents: Contents
    crystals: Any
    ratio: Any
    saturated: Any
    rate: Any
    births: Any
    path: Any


@compiled
def march(model: Model, operation: Operation, seeds: Seeds, solute: Any, solvent: Any, times: Any) -> Course:
    """Follow a batch through given times (the first is the start).

    Parameters
    ----------
    solute: dissolved anhydrous solute at the start, kg. solvent: kg at the start.
    """
    times = jnp.asarray(times, dtype=float)
    steps = times.shape[0] - 1
    kept = seeds.low.shape[0]
    tracked = model.dissolution is not None or model.size_map is not None
    crystal = model.crystal
    moments = seeds.moments()
    population: Population = _packets(seeds, steps, model.size_map) if tracked else ShiftedMoments(moments)
    mass = crystal.mass_per_cube * moments[3]
    contents = operation.start(solute + crystal.solute_fraction * mass, solvent + (1.0 - crystal.solute_fraction) * mass)
    contents = jax.tree.map(lambda v: jnp.asarray(v, dtype=float), contents)

    def conditions(contents: Contents, crystals: Any) -> tuple[Any, Any, Any, Any]:
        ratio, saturated = model.ratio(contents, crystals), model.saturated(contents)
        return ratio, saturated, model.rate(ratio, saturated, contents.temperature), model.births(ratio, saturated, contents, crystals)

    def advance(state: _State, given: tuple[Any, Any, Any]) -> tuple[_State, tuple[Any, ...]]:
        start, end, index = given
        span = end - start
        scale = crystal.mass_per_cube
        step = _Step(model, operation, state.population, state.contents, state.crystals, start, end)
        path, residual = _closure(step, state.rate, span)
        after = step.after
        there, crystals = after(path)
        ratio, saturated = model.ratio(there, crystals), model.saturated(there)
        births = model.births(ratio, saturated, there, crystals)
        born = jnp.maximum(0.5 * span * (state.births + births), 0.0)
        population = state.population.grown(path, born, model.nucleus_size, kept + index)
        crystals = scale * population.moments()[3]
        contents = operation.step(state.contents, start, end, state.crystals, crystals)
        ratio, saturated, rate, births = conditions(contents, crystals)
        new = _State(population, contents, crystals, ratio, saturated, rate, births, state.path + path)
        out = (contents, crystals, ratio, saturated, rate, births, population.moments(), new.path, born, residual)
        return new, out

    first = _State(population, contents, mass, *conditions(contents, mass), jnp.zeros(()))
    first = jax.tree.map(lambda v: jnp.asarray(v, dtype=float), first)
    last, rows = lax.scan(advance, first, (times[:-1], times[1:], jnp.arange(steps)))
    at_start = (contents, mass, first.ratio, first.saturated, first.rate, first.births, moments, jnp.zeros(()))
    joined = [jax.tree.map(lambda a, b: jnp.concatenate([jnp.asarray(a)[None], b]), a, b) for a, b in zip(at_start, rows, strict=False)]
    course, crystals, ratio, saturated, rate, births, all_moments, path = joined
    born, residual = rows[-2:]
    final = last.population if isinstance(last.population, Packets) else _rebuilt(seeds, path, born, model.nucleus_size)
    return Course(times, course.temperature, ratio, saturated, crystals, all_moments, rate, births, course.solute, course.solvent, path, born,
                  residual, final)  # fmt: skip


class _Step(eqx.Module):
    """What the end of a step is like for a trial growth path."""

    model: Model
    operation: Operation
    population: Population
    contents: Contents
    crystals: Any
    start: Any
    end: Any

    def after(self, path: Any) -> tuple[Contents, Any]:
        """Contents and crystal mass at the end."""
        crystals = self.model.crystal.mass_per_cube * self.population.cubes_after(path)
        return self.operation.step(self.contents, self.start, self.end, self.crystals, crystals), crystals

    def state(self, path: Any) -> tuple[Any, Any, Any]:
        """Composition, solubility and growth rate at the end."""
        there, crystals = self.after(path)
        ratio, saturated = self.model.ratio(there, crystals), self.model.saturated(there)
        return ratio, saturated, self.model.rate(ratio, saturated, there.temperature)

    def rate(self, path: Any) -> Any:
        """Growth rate at the end."""
        return self.state(path)[2]


def _closure(step: _Step, rate: Any, span: Any) -> tuple[Any, Any]:
    """Growth path of one step, and the relative residual of its equation."""
    there, slope = jax.jvp(step.rate, (jnp.zeros(()),), (jnp.ones(()),))
    weight = _fitted_weight(-slope * span)
    ratio, saturated, _rate = step.state((1.0 - weight) * span * rate)
    # An explicit part that would cross saturation (or leave it on the wrong side) gives way to the implicit step.
    crosses = (ratio - saturated) * jnp.where(rate == 0, there, rate) <= 0
    weight = jnp.where(crosses, 1.0, weight)
    explicit, implicit = (1.0 - weight) * span * rate, weight * span

    # Newton's steps carry no derivatives; the last one, on the live step, gives the exact derivative of the root.
    frozen = jax.tree.map(lambda v: lax.stop_gradient(v) if eqx.is_array(v) else v, step)
    begin, factor = lax.stop_gradient((explicit, implicit))
    far = begin + factor * frozen.rate(begin)

    def improve(_round: Any, carry: tuple[Any, Any, Any]) -> tuple[Any, Any, Any]:
        path, low, high = carry
        found, slope = jax.jvp(frozen.rate, (path,), (jnp.ones(()),))
        value = path - begin - factor * found
        low, high = jnp.where(value < 0, path, low), jnp.where(value > 0, path, high)
        ahead = path - value / (1.0 - factor * slope)
        return jnp.where((ahead >= low) & (ahead <= high), ahead, 0.5 * (low + high)), low, high

    path, _low, _high = lax.fori_loop(0, NEWTON_STEPS, improve, (begin, jnp.minimum(begin, far), jnp.maximum(begin, far)))
    path = lax.stop_gradient(path)
    found, slope = jax.jvp(step.rate, (path,), (jnp.ones(()),))
    value = path - explicit - implicit * found
    residual = jnp.abs(lax.stop_gradient(value)) / jnp.maximum(jnp.abs(path), 1e-300)
    return path - value / lax.stop_gradient(1.0 - implicit * slope), residual


def _fitted_weight(z: Any) -> Any:
    """Weight of the end of the step that makes ``y' = −λ y`` exact: ``1/(1 − e^(−z)) − 1/z``, from 1/2 to 1."""
    z = jnp.maximum(z, 0.0)
    small = z < 1e-2
    safe = jnp.where(small, 1.0, z)
    return jnp.where(small, 0.5 + z / 12.0, 1.0 / -jnp.expm1(-safe) - 1.0 / safe)


def _packets(seeds: Seeds, steps: int, size_map: SizeMap | None) -> Packets:
    """Seeds and room for the nuclei of every step."""

    def whole(values: Any) -> Any:
        return jnp.concatenate([values, jnp.zeros(steps)])

    low, high = seeds.low, seeds.high
    if size_map is not None:
        low, high = size_map.path_of(low), size_map.path_of(high)
    return Packets(whole(low), whole(high), whole(seeds.number), size_map)


def _rebuilt(seeds: Seeds, path: Any, born: Any, nucleus_size: Any) -> Packets:
    """Packets at the end of a run in which only the moments were carried."""
    end = path[-1]
    low = jnp.concatenate([seeds.low + end, nucleus_size + end - path[1:]])
    high = jnp.concatenate([seeds.high + end, nucleus_size + end - path[:-1]])
    return Packets(low, high, jnp.concatenate([seeds.number, born]))
