"""Continuous crystallizers over time: start-up, upsets and cycles of one vessel or of a cascade, mixed
suspension and product removal.
"""

from __future__ import annotations

from typing import Annotated, Any, NamedTuple

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
from jax import lax

from granum.core import procedure
from granum.core.errors import InputError
from granum.core.i18n import _
from granum.core.kinds import (
    Concentration,
    Density,
    Distance,
    Fraction,
    Length,
    MassFlow,
    MassRatio,
    NucleationRate,
    Number,
    PositiveNumber,
    Ratio,
    Series,
    Temperature,
    Time,
    Volume,
)
from granum.crystallization.formulas.nucleation import NucleationLaw
from granum.crystallization.kinds import Growth, Nucleation, Program, Solubility, Steps
from granum.crystallization.population.compiled import compiled
from granum.crystallization.population.lagrangian import Model, SuspensionVolume, react
from granum.crystallization.population.operations import Contents, Operation
from granum.crystallization.population.packets import (
    DispersedMoments,
    GrowthDispersion,
    Population,
    ShiftedMoments,
)
from granum.crystallization.vessels.batch import check_charge, narrow_seeds
from granum.crystallization.vessels.crystals import Crystal
from granum.numerics.smooth import safe_divide


class Inflow(NamedTuple):
    """What enters in one second: dissolved solute and solvent (kg/s), moments 0 to 4 of the crystals (1/s and
    up).
    """

    solute: Any
    solvent: Any
    moments: Any


class StageCourse(NamedTuple):
    """One vessel over time, shape (steps + 1,); moments (steps + 1, 5) and masses are of the whole vessel.

    outflow: solute and solvent, those in crystals included, that left in each step, kg, (steps, 2).
    """

    solute_per_solvent: Any
    solubility_per_solvent: Any
    moments: Any
    crystals: Any
    solute: Any
    solvent: Any
    growth_rate: Any
    births: Any
    volume: Any
    outflow: Any


class Exchanged(Operation):
    """A vessel whose temperature is given and whose totals at the end of the step are known, whatever
    crystallizes.
    """

    temperature: Any
    solute: Any
    solvent: Any

    def start(self, solute: Any, solvent: Any) -> Contents:
        return Contents(self.temperature(0.0), solute, solvent, jnp.zeros(()))

    def step(self, old: Contents, start: Any, end: Any, crystals_before: Any, crystals: Any) -> Contents:
        return Contents(self.temperature(end), self.solute, self.solvent, old.antisolvent)


class Surviving(NucleationLaw):
    """Nuclei that are still in the vessel at the end of the step."""

    law: Any
    share: Any

    def __call__(
        self, solute_per_solvent: Any, solubility_per_solvent: Any, temperature: Any, magma_density: Any
    ) -> Any:
        return self.share * self.law(solute_per_solvent, solubility_per_solvent, temperature, magma_density)


class ConstantProgram(eqx.Module):
    """One temperature at all times."""

    value: Any

    def __call__(self, time: Any) -> Any:
        return self.value + 0.0 * time


class SteadyFeed(eqx.Module):
    """The same inflow at all times."""

    value: Inflow

    def __call__(self, time: Any) -> Inflow:
        return self.value


class _Stage(NamedTuple):
    population: Any
    solute: Any
    solvent: Any


@compiled
def march_cascade(
    model: Model, temperatures: Any, volumes: Any, feed: Any, start: tuple[Any, Any, Any], times: Any
) -> tuple[StageCourse, ...]:
    """Follow a cascade of mixed vessels of constant volume through given times.

    The share of the contents that stays for a step is exact, and commutes with growth; solute and solvent
    follow from it, so that the growth path stays the one unknown of a step, and saturation is never overshot
    however fast crystals grow. What leaves a vessel is what it did not keep: matter is conserved to rounding.

    Parameters
    ----------
    model: whose volume is that of the suspension. temperatures: one function of time for each vessel, K.
        volumes: of suspension, m³. feed: ``Inflow`` as a function of time.
    start: solute and solvent per m³ of the liquor that fills every vessel, kg/m³, and the moments of the
        crystals in it, per m³.
    """
    times = jnp.asarray(times, dtype=float)
    cube, x = model.crystal.mass_per_cube, model.crystal.solute_fraction

    def population(moments: Any) -> Population:
        return (
            ShiftedMoments(moments)
            if model.dispersion is None
            else DispersedMoments.of(moments, model.dispersion)
        )

    def total(values: Any) -> Any:
        return jnp.sum(jnp.atleast_2d(values), axis=0)

    def volume_of(solute: Any, solvent: Any, values: Any) -> Any:
        return model.suspension(Contents(0.0, solute, solvent, 0.0), cube * total(values)[3])

    def row(stage: _Stage, temperature: Any, time: Any) -> tuple[Any, ...]:
        T = jnp.asarray(temperature(time), dtype=float)
        moments = stage.population.moments()
        crystals = cube * moments[3]
        ratio, saturated, rate, births = model.conditions(
            Contents(T, stage.solute, stage.solvent, jnp.zeros(())), crystals
        )
        volume = volume_of(stage.solute, stage.solvent, moments)
        return ratio, saturated, moments, crystals, stage.solute, stage.solvent, rate, births, volume

    def passed(
        stage: _Stage, temperature: Any, V: Any, arriving: Any, begin: Any, end: Any
    ) -> tuple[_Stage, Any]:
        """One vessel after a step in which a mass (solute, solvent, moments) arrives, and what it gives
        on.
        """
        solute, solvent, values = arriving
        before = stage.population.values
        turnover = volume_of(solute, solvent, values) / V
        share, gained = jnp.exp(-turnover), safe_divide(-jnp.expm1(-turnover), turnover, 1.0)
        there = (stage.solute * share + solute * gained, stage.solvent * share + solvent * gained)
        # Arrivals grow for half the step on the mean: half of them join before it, half after.
        joined = _with_values(stage.population, before * share + 0.5 * gained * values)
        T = jnp.asarray(temperature(begin), dtype=float)
        here = Contents(T, stage.solute, stage.solvent, jnp.zeros(()))
        surviving = eqx.tree_at(lambda m: m.nucleation, model, Surviving(model.nucleation, gained))
        crystals = cube * stage.population.moments()[3]
        _ratio, _saturated, rate, births = surviving.conditions(here, crystals)
        late = 0.5 * gained * cube * total(values)[3]
        closed = Exchanged(temperature, there[0] - x * late, there[1] - (1.0 - x) * late)
        made, *_rest = react(surviving, closed, joined, here, crystals, (rate, births), (begin, end), 0)
        after = made.values + 0.5 * gained * values
        level = V / volume_of(*there, after)  # crystals are denser than what they came from
        kept = jax.tree.map(lambda a: a * level, (*there, after))
        left = (
            stage.solute + solute - kept[0],
            stage.solvent + solvent - kept[1],
            0.5 * (before + kept[2]) * (turnover - jnp.log(level)),
        )
        return _Stage(_with_values(stage.population, kept[2]), kept[0], kept[1]), left

    def advance(stages: list[_Stage], given: tuple[Any, Any]) -> tuple[list[_Stage], Any]:
        begin, end = given
        span, inflow = end - begin, feed(0.5 * (begin + end))
        crystals = cube * inflow.moments[3]
        arriving = (
            inflow.solute + x * crystals,
            inflow.solvent + (1.0 - x) * crystals,
            population(inflow.moments).values,
        )
        arriving = jax.tree.map(lambda a: span * a, arriving)
        new, outflows = [], []
        for stage, temperature, V in zip(stages, temperatures, volumes, strict=True):
            after, arriving = passed(stage, temperature, V, arriving, begin, end)
            new.append(after)
            outflows.append(jnp.stack(arriving[:2]))
        return new, ([row(stage, T, end) for stage, T in zip(new, temperatures, strict=True)], outflows)

    solute, solvent, moments = (jnp.asarray(part, dtype=float) for part in start)
    seed = cube * moments[3]
    first = [
        _Stage(population(moments * V), (solute + x * seed) * V, (solvent + (1.0 - x) * seed) * V)
        for V in volumes
    ]
    begin = [row(stage, T, times[0]) for stage, T in zip(first, temperatures, strict=True)]
    _last, (later, outflows) = lax.scan(advance, first, (times[:-1], times[1:]))
    joined = [
        jax.tree.map(lambda a, b: jnp.concatenate([jnp.asarray(a)[None], b]), a, b)
        for a, b in zip(begin, later, strict=True)
    ]
    return tuple(StageCourse._make((*rows, out)) for rows, out in zip(joined, outflows, strict=True))


def _with_values(population: Population, values: Any) -> Population:
    if isinstance(population, DispersedMoments):
        return DispersedMoments(values, population.factors, population.shares)
    return ShiftedMoments(values)


class ContinuousCourse(NamedTuple):
    """The last vessel of a cascade over time, and the mean residence time in all vessels together."""

    time: Annotated[Time, Series("points")]
    temperature: Annotated[Temperature, Series("points")]
    solute_per_solvent: Annotated[MassRatio, Series("points")]
    solubility_per_solvent: Annotated[MassRatio, Series("points")]
    relative_supersaturation: Annotated[Number, Series("points")]
    magma_density: Annotated[Concentration, Series("points")]
    mean_diameter: Annotated[Distance, Series("points")]
    nucleation_rate: Annotated[NucleationRate, Series("points")]
    residence_time: Time
    step_error: Ratio


@procedure(
    source="randolph1988, ch. 4 and 9",
    title="Continuous crystallizers over time (MSMPR)",
    typical={"duration": (7200.0, 14400.0)},
)
def msmpr_over_time(
    solute_per_solvent: MassRatio,
    solvent_flow: MassFlow,
    volumes: Annotated[Volume, Series("stages")],
    temperatures: Annotated[Temperature, Series("stages")],
    solubility: Solubility,
    growth: Growth,
    nucleation: Nucleation,
    duration: Time,
    crystal_density: Density,
    temperature_program: Program | None = None,
    seed_mass_per_solvent: MassRatio = 0.0,
    seed_size: Length = 100e-6,
    seed_width: Distance = 0.0,
    seed_mass_per_solvent_start: MassRatio = 0.0,
    solute_per_solvent_start: PositiveNumber | None = None,
    volume_shape_factor: PositiveNumber = 1.0,
    solute_fraction_of_crystal: Fraction = 1.0,
    liquid_density: Density = 1000.0,
    growth_dispersion: Ratio = 0.0,
    steps: Steps = 1000,
) -> ContinuousCourse:
    """Start-up of a continuous crystallizer or of a cascade: composition, magma density and size of the last
    vessel over time.

    The vessels start full of liquor, saturated at their temperature or of a given composition, and keep their
    volume. A temperature program replaces the temperature of the last vessel. The error of magma density and
    size, over their largest values, is estimated by doubling the steps. Seeds may come with the feed, or be
    in the vessels at the start: with secondary nucleation alone nothing would ever begin without them. Some
    kinetics never settle: the crystallizer cycles.

    >>> out = msmpr_over_time(
    ...     solute_per_solvent=0.5,
    ...     solvent_flow=1.0,
    ...     volumes=[5.0],
    ...     temperatures=[293.15],
    ...     duration="8 hour",
    ...     crystal_density=2110,
    ...     solubility={"law": "polynomial_solubility", "coefficients": [0.1286, 5.88e-3, 1.721e-4]},
    ...     growth={"law": "power_law_growth", "growth_coefficient": 1.161167e-4, "growth_order": 1.32},
    ...     nucleation={
    ...         "law": "secondary_nucleation",
    ...         "nucleation_coefficient": 2.1959e8,
    ...         "nucleation_order": 1.78,
    ...     },
    ...     seed_mass_per_solvent_start=1e-3,
    ...     steps=200,
    ... )
    >>> bool(out.magma_density[-1] > out.magma_density[20])
    True
    """
    V, T = (
        np.atleast_1d(np.asarray(volumes, dtype=float)),
        np.atleast_1d(np.asarray(temperatures, dtype=float)),
    )
    if len(V) != len(T):
        raise InputError(
            _("{volumes} vessels need as many temperatures; {temperatures} were given.").format(
                volumes=len(V), temperatures=len(T)
            ),
            name="temperatures",
        )
    check_charge(seed_size, seed_width, steps, solute_per_solvent, solubility, T)
    crystal = Crystal(crystal_density, volume_shape_factor, solute_fraction_of_crystal)
    model = Model(
        solubility,
        growth,
        nucleation,
        crystal,
        SuspensionVolume(liquid_density),
        dispersion=GrowthDispersion(growth_dispersion) if growth_dispersion > 0 else None,
    )
    seeds = narrow_seeds(
        seed_size, seed_width, seed_mass_per_solvent * solvent_flow, crystal.mass_per_cube
    ).moments()
    first = (
        float(np.asarray(solubility(T[0]))) if solute_per_solvent_start is None else solute_per_solvent_start
    )
    sown = narrow_seeds(seed_size, seed_width, seed_mass_per_solvent_start, crystal.mass_per_cube).moments()
    volume = (1.0 + first) / liquid_density + seed_mass_per_solvent_start / crystal_density
    filling = (first / volume, 1.0 / volume, sown / volume)
    programs = [ConstantProgram(t) for t in T]
    if temperature_program is not None:
        programs[-1] = temperature_program
    inflow = SteadyFeed(Inflow(solute_per_solvent * solvent_flow, solvent_flow, seeds))
    steps += steps % 2
    times = np.linspace(0.0, duration, steps + 1)
    last, coarse = (
        march_cascade(model, programs, tuple(V), inflow, filling, t)[-1] for t in (times, times[::2])
    )
    size, coarse_size = (safe_divide(found.moments[:, 4], found.moments[:, 3]) for found in (last, coarse))
    error = max(_difference(size[::2], coarse_size), _difference(last.crystals[::2], coarse.crystals))
    flow = (
        solvent_flow * (1.0 + solute_per_solvent) / liquid_density
        + seed_mass_per_solvent * solvent_flow / crystal_density
    )
    return ContinuousCourse(
        times,
        np.asarray(jax.vmap(programs[-1])(times)),
        last.solute_per_solvent,
        last.solubility_per_solvent,
        last.solute_per_solvent / last.solubility_per_solvent - 1.0,
        last.crystals / last.volume,
        size,
        last.births / last.volume,
        float(V.sum() / flow),
        error,
    )


def _difference(fine: Any, coarse: Any) -> float:
    """Largest difference over the largest value."""
    return float(jnp.max(jnp.abs(fine - coarse)) / jnp.maximum(jnp.max(jnp.abs(fine)), 1e-300))
