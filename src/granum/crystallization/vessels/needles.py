"""Crystals of two sizes in a batch and in a mixed vessel: length and width grow at rates of their own.

A crystal is a prism of volume ``k_v L W²``. The composition is the one unknown of each time step and of the
steady state: both growth paths and the births follow from it.
"""

from __future__ import annotations

from typing import Annotated, Any, NamedTuple

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
from jax import lax

from granum.core import procedure
from granum.core.kinds import (
    Density,
    Distance,
    Fraction,
    GrowthRate,
    Length,
    MassRatio,
    Number,
    NumberPerMass,
    PositiveNumber,
    Ratio,
    Series,
    Temperature,
    Time,
)
from granum.crystallization.formulas.nucleation import NoNucleation
from granum.crystallization.kinds import Growth, Nucleation, Program, Solubility, Steps
from granum.crystallization.population.compiled import compiled
from granum.crystallization.population.composition import Trial, settled
from granum.crystallization.population.lagrangian import Model, SuspensionVolume
from granum.crystallization.population.needles import Aged, Lines, Segments, prisms, shifted, volume_after
from granum.crystallization.population.operations import Contents
from granum.crystallization.vessels.batch import along, check_charge, narrow_seeds
from granum.crystallization.vessels.crystals import Crystal, born_share, crystals_at, ratio_left
from granum.crystallization.vessels.msmpr import Feed, saturated_liquor, steady_composition
from granum.numerics.smooth import safe_divide


class Habit(NamedTuple):
    """What crystals of two sizes look like: lengths and widths by mass, their ratio and its spread."""

    mean_length: Any
    mean_width: Any
    aspect_ratio: Any
    aspect_ratio_deviation: Any


def habit(moments: Any) -> Habit:
    """Means by mass from bivariate moments (length first), zero without crystals: ``μ₂₂/μ₁₂``, ``μ₁₃/μ₁₂``
    and ``μ₂₁/μ₁₂``; the mean square of the aspect ratio is ``μ₃₀/μ₁₂``.
    """
    m = jnp.moveaxis(moments, (-2, -1), (0, 1))
    mean, square = (safe_divide(a, m[1, 2], 0.0) for a in (m[2, 1], m[3, 0]))
    # the difference of two nearly equal numbers, of which a part in 1e12 is rounding
    spread = jnp.where(square - mean**2 > 1e-12 * square, square - mean**2, 0.0)
    return Habit(
        safe_divide(m[2, 2], m[1, 2], 0.0),
        safe_divide(m[1, 3], m[1, 2], 0.0),
        mean,
        jnp.sqrt(jnp.where(spread > 0.0, spread, 1.0)) * (spread > 0.0),
    )


class Needles(eqx.Module):
    """What happens to crystals of two sizes: ``model.growth`` is that of the length."""

    model: Model
    growth_width: Any

    def rates(self, ratio: Any, saturated: Any, temperature: Any) -> list[Any]:
        """Growth rates of length and width."""
        laws = (self.model.growth, self.growth_width)
        return [law(ratio, saturated, temperature) + jnp.zeros(()) for law in laws]

    def mass(self, moments: Any) -> Any:
        """Crystals, kg."""
        return self.model.crystal.mass_per_cube * moments[1, 2]


class _Step(Trial):
    needles: Needles
    moments: Any
    there: Contents
    before: list[Any]
    births: Any
    span: Any

    def rates_before(self) -> list[Any]:
        return self.before

    def _crystals(self, ratio: Any) -> Any:
        """Crystals where the liquor is left with a composition, kg."""
        there, x = self.there, self.needles.model.crystal.solute_fraction
        return jnp.maximum(crystals_at(there.solute, there.solvent, ratio, x), 0.0)

    def _saturated(self, ratio: Any) -> Any:
        return self.needles.model.saturated(self.there, self._crystals(ratio))

    def rates(self, ratio: Any) -> list[Any]:
        return self.needles.rates(ratio, self._saturated(ratio), self.there.temperature)

    def paths(self, ratio: Any, weights: list[Any]) -> list[Any]:
        return [
            self.span * ((1.0 - w) * a + w * b)
            for w, a, b in zip(weights, self.before, self.rates(ratio), strict=True)
        ]

    def born(self, ratio: Any) -> Any:
        """Crystals born: the mean of the births at both ends over the step."""
        model, there = self.needles.model, self.there
        later = model.births(ratio, self._saturated(ratio), there, self._crystals(ratio))
        return jnp.maximum(0.5 * self.span * (self.births + later), 0.0)

    def _fresh(self, ratio: Any, longer: Any, wider: Any) -> Segments:
        nucleus = self.needles.model.nucleus_size + jnp.zeros(1)
        return Segments(nucleus, nucleus, longer[None], wider[None], self.born(ratio)[None])

    def grown(self, ratio: Any, weights: list[Any]) -> Any:
        """Bivariate moments at the end."""
        paths = self.paths(ratio, weights)
        return shifted(self.moments, *paths) + self._fresh(ratio, *paths).moments()

    def left(self, ratio: Any, weights: list[Any]) -> Any:
        paths = self.paths(ratio, weights)
        fresh = self._fresh(ratio, *paths)
        volume = volume_after(self.moments, *paths) + fresh.number[0] * fresh.beyond(jnp.zeros(1))[0]
        return self.needles.model.ratio(self.there, self.needles.model.crystal.mass_per_cube * volume)


class NeedleMarch(NamedTuple):
    """A batch of crystals of two sizes at the times of its steps, the start included.

    rates: growth of length and width, m/s. moments: bivariate, length first. final: the crystals at the end,
    seeds first. crystals: kg.
    """

    time: Any
    temperature: Any
    solute_per_solvent: Any
    solubility_per_solvent: Any
    crystals: Any
    rates: Any
    moments: Any
    final: Segments


class _State(NamedTuple):
    moments: Any
    ratio: Any
    rates: list[Any]
    births: Any


@compiled
def march_needles(
    needles: Needles, seeds: Segments, program: Any, solute: Any, solvent: Any, times: Any
) -> NeedleMarch:
    """Follow a batch at programmed temperature through given times; ``solute`` and ``solvent`` are those of
    the liquor at the start, kg.
    """
    times = jnp.asarray(times, dtype=float)
    model, x = needles.model, needles.model.crystal.solute_fraction
    moments = seeds.moments()
    mass = needles.mass(moments)

    def contents(t: Any) -> Contents:
        T = program(t) + jnp.zeros(())
        return Contents(T, solute + x * mass, solvent + (1.0 - x) * mass, jnp.zeros(()))

    def state(moments: Any, there: Contents) -> _State:
        crystals = needles.mass(moments)
        ratio, saturated = model.ratio(there, crystals), model.saturated(there, crystals) + jnp.zeros(())
        return _State(
            moments,
            ratio,
            needles.rates(ratio, saturated, there.temperature),
            model.births(ratio, saturated, there, crystals) + jnp.zeros(()),
        )

    def told(state: _State, there: Contents) -> tuple[Any, ...]:
        saturated = model.saturated(there, needles.mass(state.moments)) + jnp.zeros(())
        return there.temperature, state.ratio, saturated, jnp.stack(state.rates), state.moments

    def advance(old: _State, given: tuple[Any, Any]) -> tuple[_State, tuple[Any, ...]]:
        start, end = given
        there = contents(end)
        step = _Step(needles, old.moments, there, old.rates, old.births, end - start)
        ratio, weights = settled(step, old.ratio, jnp.maximum(old.ratio, solute / solvent), rounds=3)
        new = state(step.grown(ratio, weights), there)
        return new, (told(new, there), jnp.stack(step.paths(ratio, weights)), step.born(ratio))

    first = state(moments, contents(times[0]))
    _last, (rows, paths, born) = lax.scan(advance, first, (times[:-1], times[1:]))
    begin = told(first, contents(times[0]))
    joined = [jnp.concatenate([jnp.asarray(a)[None], b]) for a, b in zip(begin, rows, strict=True)]
    temperature, ratios, saturated, rates, all_moments = joined
    whole = jnp.sum(paths, axis=0)
    since = whole - jnp.cumsum(paths, axis=0)  # growth since the end of the step of birth
    nucleus = model.nucleus_size
    final = Segments(
        jnp.concatenate([seeds.length + whole[0], nucleus + since[:, 0]]),
        jnp.concatenate([seeds.width + whole[1], nucleus + since[:, 1]]),
        jnp.concatenate([seeds.longer, paths[:, 0]]),
        jnp.concatenate([seeds.wider, paths[:, 1]]),
        jnp.concatenate([seeds.number, born]),
    )
    crystals = jax.vmap(needles.mass)(all_moments)
    return NeedleMarch(times, temperature, ratios, saturated, crystals, rates, all_moments, final)


def nuclei_share(final: Segments, seeds: int) -> Any:
    """Mass share of the crystals that were born in the batch."""
    masses = final.number * final.beyond(jnp.zeros_like(final.number))
    return born_share(jnp.sum(masses[:seeds]), jnp.sum(masses))


class SteadyNeedles(NamedTuple):
    """A steady mixed vessel of crystals of two sizes.

    crystals: what leaves, by number per second and L, W, before it is scaled to ``product`` (kg/s).
    rates: growth of length and width, m/s. solute, solvent, evaporation: kg/s. Others: see ``SteadyState``.
    """

    temperature: Any
    solute_per_solvent: Any
    solubility_per_solvent: Any
    crystals: Lines
    product: Any
    solute: Any
    solvent: Any
    evaporation: Any
    rates: Any
    nucleation_rate: Any
    residence_time: Any
    magma_density: Any
    washed_out: Any
    converged: Any


@compiled
def steady_needles(
    needles: Needles,
    feed: Feed,
    entering: Segments,
    temperature: Any,
    volume: Any,
    liquor_volume: Any,
    evaporation: Any = 0.0,
) -> SteadyNeedles:
    """Steady state of one vessel with mixed suspension and mixed product removal.

    ``entering`` are the crystals of the feed by number per second; each class counts as crystals of its mean
    volume. In an undersaturated liquor they dissolve, all shapes alike, until it is saturated or they are
    gone.
    """
    model = needles.model
    crystal, x = model.crystal, model.crystal.solute_fraction
    total = jnp.sum(feed.crystals)
    liquid = feed.solvent - evaporation
    all_solute, all_solvent = feed.solute + x * total, liquid + (1.0 - x) * total
    saturated, at = saturated_liquor(model.solubility, temperature, all_solute, all_solvent, x)
    highest = safe_divide(feed.solute, jnp.maximum(liquid, 0.0))
    slender = (entering.length + entering.longer) / (entering.width + entering.wider)
    width = (entering.beyond(jnp.zeros_like(slender)) / slender) ** (1.0 / 3.0)
    nucleus = model.nucleus_size + jnp.zeros(1)

    def state(c: Any) -> tuple[Any, Any, Any]:
        product = crystals_at(all_solute, all_solvent, c, x)
        left = all_solvent - (1.0 - x) * product
        flow = liquor_volume(left * c, left) + product / crystal.density
        return product, jnp.where(flow > 0, flow, 1.0), at(left)  # an empty stream

    def there(c: Any) -> tuple[Aged, Any, Any]:
        product, flow, soluble = state(c)
        born = model.nucleation(c, soluble, temperature, product / flow) + jnp.zeros(())
        longer, wider = (rate * volume / flow for rate in needles.rates(c, soluble, temperature))
        grow = jnp.zeros(width.shape[0] + 1)
        lines = Aged(
            jnp.concatenate([slender * width, nucleus]),
            jnp.concatenate([width, nucleus]),
            grow + longer,
            grow + wider,
            jnp.append(entering.number, born * volume),
        )
        return lines, born, flow

    def grown(c: Any) -> Any:
        lines = there(c)[0]
        return crystal.mass_per_cube * jnp.sum(lines.number * lines.beyond(jnp.zeros_like(lines.number)))

    found = steady_composition(grown, lambda c: state(c)[0], saturated, highest)
    some = found.crystallizes
    dissolved_down = jnp.clip(crystals_at(all_solute, all_solvent, saturated, x), 0.0, total)
    rest = jnp.where(highest > saturated, total, dissolved_down)
    c = jnp.where(some, found.ratio, ratio_left(all_solute, all_solvent, rest, x))
    lines, born, flow = there(c)
    still = jnp.where(some, 1.0, 0.0)
    lines = Aged(
        lines.length,
        lines.width,
        still * lines.longer,
        still * lines.wider,
        lines.number.at[-1].multiply(still),
    )
    product = jnp.where(some, state(c)[0], rest)
    left = all_solvent - (1.0 - x) * product
    soluble = at(left)
    return SteadyNeedles(
        temperature,
        c,
        soluble,
        lines,
        product,
        left * c,
        left,
        evaporation + 0.0,
        jnp.stack(needles.rates(c, soluble, temperature)),
        born,
        volume / flow,
        product / flow,
        ~some & (highest > saturated) & (total == 0),
        found.converged,
    )


class NeedleCourse(NamedTuple):
    """A cooling batch of crystals of two sizes over time, per kg of solvent charged, with its product."""

    time: Annotated[Time, Series("points")]
    temperature: Annotated[Temperature, Series("points")]
    solute_per_solvent: Annotated[MassRatio, Series("points")]
    solubility_per_solvent: Annotated[MassRatio, Series("points")]
    relative_supersaturation: Annotated[Number, Series("points")]
    crystals_per_solvent: Annotated[MassRatio, Series("points")]
    crystals_number: Annotated[NumberPerMass, Series("points")]
    growth_rate: Annotated[GrowthRate, Series("points")]
    growth_rate_width: Annotated[GrowthRate, Series("points")]
    mean_length: Annotated[Distance, Series("points")]
    mean_width: Annotated[Distance, Series("points")]
    aspect_ratio: Annotated[Ratio, Series("points")]
    aspect_ratio_deviation: Annotated[Ratio, Series("points")]
    nuclei_mass_fraction: Ratio
    yield_fraction: Ratio
    step_error: Ratio


@procedure(
    source="ma2002; puel2003; gunawan2004",
    title="Batch of needles (length and width)",
    typical={"duration": (3600.0, 7200.0)},
)
def needle_batch(
    solute_per_solvent: MassRatio,
    solubility: Solubility,
    growth: Growth,
    growth_width: Growth,
    temperature_program: Program,
    duration: Time,
    crystal_density: Density,
    nucleation: Nucleation = NoNucleation(),
    seed_mass_per_solvent: MassRatio = 0.0,
    seed_size: Length = 100e-6,
    seed_width: Distance = 0.0,
    seed_aspect_ratio: PositiveNumber = 3.0,
    volume_shape_factor: PositiveNumber = 1.0,
    solute_fraction_of_crystal: Fraction = 1.0,
    liquid_density: Density = 1000.0,
    steps: Steps = 400,
) -> NeedleCourse:
    """Concentration and crystals over time in a cooling batch, length and width growing at rates of their
    own.

    ``growth`` is that of the length, ``growth_width`` that of the width.
    Crystals are prisms of volume k_v L W² (k_v = 1 for a square section). Seeds are a sieve cut by the
    diameter of the sphere of equal volume, all of one aspect ratio. Means and the standard deviation of the
    aspect ratio are by mass. Both rates must not depend on size, and crystals keep in an undersaturated
    solution.

    >>> out = needle_batch(
    ...     solute_per_solvent=0.308,
    ...     solubility={"law": "polynomial_solubility", "coefficients": [0.2087, -9.7629e-5, 9.3027e-5]},
    ...     growth={"law": "power_law_growth", "growth_coefficient": "100.75 um/s", "growth_order": 1.74},
    ...     growth_width={
    ...         "law": "power_law_growth",
    ...         "growth_coefficient": "12.21 um/s",
    ...         "growth_order": 1.48,
    ...     },
    ...     temperature_program={
    ...         "law": "power_cooling",
    ...         "temperature_start": 305.15,
    ...         "temperature_end": 301.15,
    ...         "duration": 7200,
    ...     },
    ...     duration="2 hour",
    ...     crystal_density=2338,
    ...     seed_mass_per_solvent=0.001,
    ...     steps=50,
    ... )
    >>> round(float(out.solute_per_solvent[-1] + out.crystals_per_solvent[-1]), 9)
    0.309
    """
    check_charge(
        seed_size, seed_width, steps, solute_per_solvent, solubility, along(temperature_program, duration)
    )
    crystal = Crystal(crystal_density, volume_shape_factor, solute_fraction_of_crystal)
    needles = Needles(
        Model(solubility, growth, nucleation, crystal, SuspensionVolume(liquid_density)), growth_width
    )
    sphere = crystal_density * np.pi / 6.0
    seeds = prisms(
        narrow_seeds(seed_size, seed_width, seed_mass_per_solvent, sphere),
        seed_aspect_ratio,
        volume_shape_factor,
    )
    steps += steps % 2
    times, index = jnp.linspace(0.0, duration, steps + 1), np.arange(steps + 1)
    # the coarse run takes every second step with zero length, so that both are one compiled program
    course, coarse = (
        march_needles(needles, seeds, temperature_program, solute_per_solvent, 1.0, t)
        for t in (times, times[index + index % 2])
    )
    looks = habit(course.moments)
    ends = [jnp.stack([run.crystals[-1], run.moments[-1, 0, 0]]) for run in (course, coarse)]
    apart = jnp.max(jnp.abs(ends[0] - ends[1]) / jnp.maximum(ends[0], 1e-300))
    return NeedleCourse(
        course.time,
        course.temperature,
        course.solute_per_solvent,
        course.solubility_per_solvent,
        course.solute_per_solvent / course.solubility_per_solvent - 1.0,
        course.crystals,
        course.moments[:, 0, 0],
        course.rates[:, 0],
        course.rates[:, 1],
        *looks,
        float(nuclei_share(course.final, seeds.number.shape[0])),
        float(solute_fraction_of_crystal * (course.crystals[-1] - course.crystals[0]) / solute_per_solvent),
        float(apart) / 3.0,
    )
