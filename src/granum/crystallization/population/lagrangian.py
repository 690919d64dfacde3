"""The default engine: packets along the growth path, the solute by algebra, one bracketed scalar equation a
step.

Each step solves ``d = dt [(1 − θ) G_n + θ G(c(d))]`` for the growth path ``d``, where the composition
``c(d)`` follows exactly from the solute balance. θ is fitted so that exponential relaxation is met: 1/2 for
slow steps (second order), 1 for stiff ones, which never undershoots saturation. Mass is conserved to rounding
whatever the step.
"""

from __future__ import annotations

from abc import abstractmethod
from typing import Any, NamedTuple

import equinox as eqx
import jax
import jax.numpy as jnp
from jax import lax

from granum.crystallization.population.compiled import compiled
from granum.crystallization.population.grid import Classes, Collisions, classes_of
from granum.crystallization.population.operations import Contents, Operation
from granum.crystallization.population.packets import (
    DispersedMoments,
    GrowthDispersion,
    Packets,
    Population,
    Seeds,
    ShiftedMoments,
    SizeMap,
    mean_power,
)
from granum.crystallization.vessels.crystals import Crystal, ratio_left
from granum.numerics.quick_roots import TOLERANCE, nearly_falling_root


class SuspensionVolume(eqx.Module):
    """Volume on which nucleation is counted: liquor of constant density plus crystals."""

    liquid_density: Any

    def __call__(self, liquor: Any, solvent: Any, crystals: Any, crystal: Crystal) -> Any:
        return liquor / self.liquid_density + crystals / crystal.density


class SolventVolume(eqx.Module):
    """Volume on which nucleation is counted: the pure solvent, as in kinetics given per mass or volume of
    solvent.
    """

    solvent_density: Any

    def __call__(self, liquor: Any, solvent: Any, crystals: Any, crystal: Crystal) -> Any:
        return solvent / self.solvent_density


class Equilibrium(eqx.Module):
    """Saturation that depends on more of the contents than temperature, such as the ions of a precipitating
    salt.
    """

    @abstractmethod
    def ratio(self, contents: Any, crystals: Any) -> Any:
        """Measure of the solute left in solution, on the scale of ``saturated``."""

    @abstractmethod
    def saturated(self, contents: Any) -> Any:
        """The same at saturation."""


class Model(eqx.Module):
    """What happens inside the vessel.

    Parameters
    ----------
    solubility: kg of anhydrous solute per kg of solvent from temperature (and antisolvent fraction, or the
        free solvent that holds other solutes, where the law takes it), or an ``Equilibrium``.
    growth: rate of size from (solute per solvent, solubility, temperature). nucleation: the same with the
        magma density.
    crystal: the crystal. volume: what nucleation rates and magma densities are counted on.
    dissolution: positive rate of shrinking below saturation; None where the solution stays supersaturated.
    size_map: size dependence of growth, or None. nucleus_size: m.
    dispersion: growth rates that differ between crystals, or None; not together with dissolution or size
        dependence.
    """

    solubility: Any
    growth: Any
    nucleation: Any
    crystal: Crystal
    volume: Any
    dissolution: Any = None
    size_map: SizeMap | None = None
    nucleus_size: Any = 0.0
    dispersion: GrowthDispersion | None = None

    def saturated(self, contents: Contents, crystals: Any) -> Any:
        """Solubility at the temperature (and antisolvent fraction) of the contents."""
        if isinstance(self.solubility, Equilibrium):
            return self.solubility.saturated(contents)
        if getattr(self.solubility, "takes_antisolvent", False):
            return self.solubility(contents.temperature, contents.antisolvent / contents.solvent)
        if not getattr(self.solubility, "takes_solvent", False):
            return self.solubility(contents.temperature)
        free = contents.solvent - (1.0 - self.crystal.solute_fraction) * crystals
        return self.solubility(contents.temperature, free)

    def ratio(self, contents: Contents, crystals: Any) -> Any:
        """Solute per solvent left in solution."""
        if isinstance(self.solubility, Equilibrium):
            return self.solubility.ratio(contents, crystals)
        return ratio_left(contents.solute, contents.solvent, crystals, self.crystal.solute_fraction)

    def rate(self, ratio: Any, saturated: Any, temperature: Any) -> Any:
        """Growth rate, negative for dissolution."""
        rate = self.growth(ratio, saturated, temperature)
        return rate if self.dissolution is None else rate - self.dissolution(ratio, saturated, temperature)

    def suspension(self, contents: Contents, crystals: Any) -> Any:
        """Volume that rates are counted on, m³."""
        x = self.crystal.solute_fraction
        solvent = contents.solvent - (1.0 - x) * crystals
        return self.volume(contents.solute + contents.solvent - crystals, solvent, crystals, self.crystal)

    def births(self, ratio: Any, saturated: Any, contents: Contents, crystals: Any) -> Any:
        """Nuclei born in the whole vessel per second, 1/s."""
        volume = self.suspension(contents, crystals)
        return volume * self.nucleation(ratio, saturated, contents.temperature, crystals / volume)

    def conditions(self, contents: Contents, crystals: Any) -> tuple[Any, Any, Any, Any]:
        """Composition, solubility, growth rate and births of the vessel as it is."""
        ratio, saturated = self.ratio(contents, crystals), self.saturated(contents, crystals)
        return (
            ratio,
            saturated,
            self.rate(ratio, saturated, contents.temperature),
            self.births(ratio, saturated, contents, crystals),
        )


class Course(NamedTuple):
    """What a batch went through, at the times of its steps (the start included), shape (steps + 1,).

    time: s. temperature: K. solute_per_solvent, solubility_per_solvent: kg/kg. crystals: kg in the vessel.
    moments: 0 to 4 of all crystals in the vessel, (steps + 1, 5). growth_rate: m/s. births: 1/s.
    solvent: total, kg. path: growth path since the start, m. born: crystals born in each step, (steps,).
    residual: of the closure of each step, relative. collided: share of the crystals that met another or broke
        in each half step (0 without collisions); well below 1 where the steps are short enough.
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
    collided: Any
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
def march(
    model: Model,
    operation: Operation,
    seeds: Seeds,
    solute: Any,
    solvent: Any,
    times: Any,
    collisions: Collisions | None = None,
) -> Course:
    """Follow a batch through given times (the first is the start).

    Parameters
    ----------
    solute: dissolved anhydrous solute at the start, kg. solvent: kg at the start.
    collisions: agglomeration and breakage, in halves before and after the growth of each step; the seeds must
        then be classes side by side that reach up to the largest agglomerate.
    """
    times = jnp.asarray(times, dtype=float)
    steps = times.shape[0] - 1
    kept = seeds.low.shape[0]
    tracked = model.dissolution is not None or model.size_map is not None
    crystal = model.crystal
    moments = seeds.moments()
    population: Population = ShiftedMoments(moments)
    if collisions is not None:
        population = classes_of(seeds, steps, collisions.nuclei_classes)
    elif model.dispersion is not None:
        population = DispersedMoments.of(moments, model.dispersion)
    elif tracked:
        population = _packets(seeds, steps, model.size_map)
    mass = crystal.mass_per_cube * moments[3]
    contents = operation.start(
        solute + crystal.solute_fraction * mass, solvent + (1.0 - crystal.solute_fraction) * mass
    )
    contents = jax.tree.map(lambda v: jnp.asarray(v, dtype=float), contents)

    def collided(
        population: Population, contents: Contents, crystals: Any, span: Any
    ) -> tuple[Population, Any]:
        if collisions is None or not isinstance(population, Classes):
            return population, jnp.zeros(())
        return collisions.act(population, model.suspension(contents, crystals), 0.5 * span)

    def advance(state: _State, given: tuple[Any, Any, Any]) -> tuple[_State, tuple[Any, ...]]:
        start, end, index = given
        span = end - start
        driven = operation.seeing(state.population.moments())
        before, busy = collided(state.population, state.contents, state.crystals, span)
        population, path, born, residual, there, crystals = react(
            model,
            driven,
            before,
            state.contents,
            state.crystals,
            (state.rate, state.births),
            (start, end),
            kept + index,
        )
        population, busier = collided(population, there, crystals, span)
        crystals = crystal.mass_per_cube * population.moments()[3]
        contents = driven.step(state.contents, start, end, state.crystals, crystals)
        ratio, saturated, rate, births = model.conditions(contents, crystals)
        new = _State(population, contents, crystals, ratio, saturated, rate, births, state.path + path)
        out = (
            contents,
            crystals,
            ratio,
            saturated,
            rate,
            births,
            population.moments(),
            new.path,
            born,
            residual,
            jnp.maximum(busy, busier),
        )
        return new, out

    first = _State(population, contents, mass, *model.conditions(contents, mass), jnp.zeros(()))
    first = jax.tree.map(lambda v: jnp.asarray(v, dtype=float), first)
    last, rows = lax.scan(advance, first, (times[:-1], times[1:], jnp.arange(steps)))
    at_start = (
        contents,
        mass,
        first.ratio,
        first.saturated,
        first.rate,
        first.births,
        moments,
        jnp.zeros(()),
    )
    joined = [
        jax.tree.map(lambda a, b: jnp.concatenate([jnp.asarray(a)[None], b]), a, b)
        for a, b in zip(at_start, rows, strict=False)
    ]
    course, crystals, ratio, saturated, rate, births, all_moments, path = joined
    born, residual, busy = rows[-3:]
    if isinstance(last.population, Classes):
        final = last.population.packets()
    else:
        final = (
            last.population if isinstance(last.population, Packets) else _rebuilt(seeds, path, born, model)
        )
    return Course(
        times,
        course.temperature,
        ratio,
        saturated,
        crystals,
        all_moments,
        rate,
        births,
        course.solute,
        course.solvent,
        path,
        born,
        residual,
        busy,
        final,
    )


def react(
    model: Model,
    operation: Operation,
    population: Population,
    contents: Contents,
    crystals: Any,
    rates: tuple[Any, Any],
    span: tuple[Any, Any],
    slot: Any,
) -> tuple[Population, Any, Any, Any, Contents, Any]:
    """Growth and nucleation over one step, from the growth rate and births at its start.

    Returns the population, the growth path, the number born, the residual of the closure, and contents and
    crystals.
    """
    start, end = span
    rate, births = rates
    step = _Step(model, operation, population, contents, crystals, births, start, end)
    path, residual = _closure(step, rate, end - start)
    there, mass = step.after(path)
    born = step.born(path)
    return population.grown(path, born, model.nucleus_size, slot), path, born, residual, there, mass


class _Step(eqx.Module):
    """What the end of a step is like for a trial growth path.

    The newborn count as they will be added, so that even a burst of nuclei cannot take more solute than there
    is.
    """

    model: Model
    operation: Operation
    population: Population
    contents: Contents
    crystals: Any
    births: Any
    start: Any
    end: Any

    def after(self, path: Any) -> tuple[Contents, Any]:
        """Contents and crystal mass at the end."""
        nucleus = self.model.nucleus_size
        fresh = self.born(path) * mean_power(nucleus, nucleus + jnp.maximum(path, 0.0), 3)
        crystals = self.model.crystal.mass_per_cube * (self.population.cubes_after(path) + fresh)
        return self.operation.step(self.contents, self.start, self.end, self.crystals, crystals), crystals

    def born(self, path: Any) -> Any:
        """Crystals born: the mean of the births at both ends (at the later one beside the older crystals)
        over the step.
        """
        model, crystals = self.model, self.model.crystal.mass_per_cube * self.population.cubes_after(path)
        there = self.operation.step(self.contents, self.start, self.end, self.crystals, crystals)
        later = model.births(model.ratio(there, crystals), model.saturated(there, crystals), there, crystals)
        return jnp.maximum(0.5 * (self.end - self.start) * (self.births + later), 0.0)

    def state(self, path: Any) -> tuple[Any, Any, Any]:
        """Composition, solubility and growth rate at the end."""
        there, crystals = self.after(path)
        ratio, saturated = self.model.ratio(there, crystals), self.model.saturated(there, crystals)
        return ratio, saturated, self.model.rate(ratio, saturated, there.temperature)

    def rate(self, path: Any) -> Any:
        """Growth rate at the end."""
        return self.state(path)[2]


def _closure(step: _Step, rate: Any, span: Any) -> tuple[Any, Any]:
    """Growth path of one step, and the relative residual of its equation."""
    there, slope = jax.jvp(step.rate, (jnp.zeros(()),), (jnp.ones(()),))
    weight = fitted_weight(-slope * span)
    ratio, saturated, _rate = step.state((1.0 - weight) * span * rate)
    # An explicit part that would cross saturation (or leave it on the wrong side) gives way to the implicit
    # step.
    crosses = (ratio - saturated) * jnp.where(rate == 0, there, rate) <= 0
    weight = jnp.where(crosses, 1.0, weight)
    explicit, implicit = (1.0 - weight) * span * rate, weight * span

    # Newton's steps carry no derivatives; the last one, on the live step, gives the exact derivative of the
    # root.
    frozen = jax.tree.map(lambda v: lax.stop_gradient(v) if eqx.is_array(v) else v, step)
    begin, factor = lax.stop_gradient((explicit, implicit))
    far = begin + factor * frozen.rate(begin)
    path = nearly_falling_root(
        lambda path: begin + factor * frozen.rate(path) - path,
        jnp.minimum(begin, far),
        jnp.maximum(begin, far),
        begin,
        TOLERANCE * (jnp.abs(far - begin) + jnp.abs(begin)),
    )
    path = lax.stop_gradient(path)
    found, slope = jax.jvp(step.rate, (path,), (jnp.ones(()),))
    value = path - explicit - implicit * found
    residual = jnp.abs(lax.stop_gradient(value)) / jnp.maximum(jnp.abs(path), 1e-300)
    return path - value / lax.stop_gradient(1.0 - implicit * slope), residual


def fitted_weight(z: Any) -> Any:
    """Weight of the end of the step that makes ``y' = −λ y`` exact: ``1/(1 − e^(−z)) − 1/z``, from 1/2 to
    1.
    """
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


def _rebuilt(seeds: Seeds, path: Any, born: Any, model: Model) -> Packets:
    """Packets at the end of a run in which only the moments were carried."""
    end, nucleus = path[-1], model.nucleus_size
    low, high = (
        jnp.append(seeds.low, nucleus + jnp.zeros_like(born)),
        jnp.append(seeds.high, nucleus + jnp.zeros_like(born)),
    )
    since, until = (
        jnp.append(end + jnp.zeros_like(seeds.low), end - path[1:]),
        jnp.append(end + jnp.zeros_like(seeds.low), end - path[:-1]),
    )
    number = jnp.append(seeds.number, born)
    if model.dispersion is None:
        return Packets(low + since, high + until, number)
    shares, factors = model.dispersion.factors()
    rows = [
        (low + f * since, high + f * until, share * number) for share, f in zip(shares, factors, strict=True)
    ]
    lows, highs, numbers = (jnp.concatenate(parts) for parts in zip(*rows, strict=True))
    return Packets(lows, highs, numbers)
