"""A batch from charge to product at a programmed temperature, with the error of the time steps estimated by
halving them.
"""

from __future__ import annotations

from typing import Annotated, Any, NamedTuple

import jax.numpy as jnp
import numpy as np

from granum.core import flags, procedure
from granum.core.constants import ZERO_CELSIUS
from granum.core.errors import ApplicabilityError, InputError
from granum.core.i18n import _
from granum.core.kinds import (
    Density,
    Distance,
    Fraction,
    GrowthRate,
    Law,
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
from granum.core.notices import describe
from granum.crystallization.formulas.nucleation import NoNucleation
from granum.crystallization.kinds import Dissolution, Growth, Nucleation, Program, Solubility, Steps
from granum.crystallization.population.compiled import compiled
from granum.crystallization.population.grid import Collisions, check_classes
from granum.crystallization.population.lagrangian import Course, Model, SuspensionVolume, march
from granum.crystallization.population.operations import Addition, Operation, Programmed
from granum.crystallization.population.packets import GrowthDispersion, Seeds
from granum.crystallization.vessels.crystals import Crystal, born_share
from granum.numerics.smooth import safe_divide

SEED_PACKETS = 16
LARGEST, EMPTY_CLASSES = 15.0, 40  # agglomerates up to so many times the largest seed, in so many classes
LARGEST_SEED, LARGEST_SOLUBILITY = 0.02, 50.0  # m, kg/kg
BUSIEST = 0.5  # share of the crystals that may meet another in half a step


class BatchCourse(NamedTuple):
    """A cooling batch over time, per kg of solvent charged, with its product and the estimated error of the
    time steps.
    """

    time: Annotated[Time, Series("points")]
    temperature: Annotated[Temperature, Series("points")]
    solute_per_solvent: Annotated[MassRatio, Series("points")]
    solubility_per_solvent: Annotated[MassRatio, Series("points")]
    relative_supersaturation: Annotated[Number, Series("points")]
    crystals_per_solvent: Annotated[MassRatio, Series("points")]
    crystals_number: Annotated[NumberPerMass, Series("points")]
    growth_rate: Annotated[GrowthRate, Series("points")]
    mean_diameter: Length
    mass_median_size: Length
    nuclei_mass_fraction: Ratio
    yield_fraction: Number
    step_error: Ratio


def narrow_seeds(size: Any, width: Any, mass: Any, mass_per_cube: Any) -> Seeds:
    """Seeds of a sieve cut: a parabola of number over ``size ± width/2`` (all at one size when the width is
    zero).
    """
    edges = size + width * jnp.linspace(-0.5, 0.5, SEED_PACKETS + 1)
    shape = jnp.diff(_parabola(jnp.linspace(-1.0, 1.0, SEED_PACKETS + 1)))
    low, high = edges[:-1], edges[1:]
    cubes = shape * 0.25 * (low + high) * (low**2 + high**2)
    return Seeds(low, high, shape * mass / (mass_per_cube * jnp.sum(cubes)))


def _parabola(x: Any) -> Any:
    """Integral of ``1 − x²``."""
    return x - x**3 / 3.0


def with_room(seeds: Seeds) -> Seeds:
    """Seeds with empty classes above them for agglomerates."""
    above = seeds.high[-1] * jnp.geomspace(1.0, LARGEST, EMPTY_CLASSES + 1)
    return Seeds(
        jnp.append(seeds.low, above[:-1]),
        jnp.append(seeds.high, above[1:]),
        jnp.append(seeds.number, jnp.zeros(EMPTY_CLASSES)),
    )


def simulated(
    model: Model,
    operation: Operation,
    seeds: Seeds,
    ratio: Any,
    duration: Any,
    steps: int,
    collisions: Collisions | None = None,
) -> tuple[Course, float]:
    """A batch of one kg of solvent, and the relative error of its crystal mass, number and size by comparison
    with half the steps.

    The coarse run takes every second step with zero length, so that both are one compiled program (second
    order).
    """
    steps += steps % 2
    times = jnp.linspace(0.0, duration, steps + 1)
    index = np.arange(steps + 1)
    fine, coarse = (
        march(model, operation, seeds, ratio, 1.0, t, collisions) for t in (times, times[index + index % 2])
    )

    def figures(course: Course) -> Any:
        m = course.moments[-1]
        return jnp.stack([m[3], m[0], safe_divide(m[3], m[2])])

    a, b = figures(fine), figures(coarse)
    return fine, float(jnp.max(jnp.abs(a - b) / jnp.maximum(jnp.abs(a), 1e-300)) / 3.0)


def nuclei_share(course: Course, seeds: Seeds) -> float:
    """Mass share of the crystals that were born in the batch."""
    cubes = course.final.number * _cubes(course.final)
    # one row of packets for each growth rate
    per_rate = cubes.reshape((-1, seeds.low.shape[0] + course.born.shape[0]))
    return float(born_share(jnp.sum(per_rate[:, : seeds.low.shape[0]]), jnp.sum(cubes)))


def mass_mean(course: Course) -> float:
    """D[4,3] at the end; zero without crystals."""
    m = course.moments[-1]
    return float(safe_divide(m[4], m[3]))


@procedure(
    source="miller1994; chung1999; mullin2001, ch. 9",
    title="Seeded or unseeded batch",
    typical={"duration": (3600.0, 7200.0)},
)
def batch(
    solute_per_solvent: MassRatio,
    solubility: Solubility,
    growth: Growth,
    temperature_program: Program,
    duration: Time,
    crystal_density: Density,
    nucleation: Nucleation = NoNucleation(),
    seed_mass_per_solvent: MassRatio = 0.0,
    seed_size: Length = 100e-6,
    seed_width: Distance = 0.0,
    volume_shape_factor: PositiveNumber = 1.0,
    solute_fraction_of_crystal: Fraction = 1.0,
    liquid_density: Density = 1000.0,
    dissolution: Dissolution | None = None,
    evaporation_program: Program | None = None,
    antisolvent_program: Program | None = None,
    growth_dispersion: Ratio = 0.0,
    steps: Steps = 400,
) -> BatchCourse:
    """Concentration, temperature and crystals of a cooling batch over time, with its product and the error of
    the time steps.

    Seeds are a sieve cut of given mean size and width. Solute and crystals are conserved to rounding whatever
    the number of steps; the error of the rest is estimated by halving them. Without a dissolution law,
    crystals keep in an undersaturated solution. Programs of the mass evaporated and of the antisolvent added,
    per kg of solvent charged, make it an evaporative or antisolvent batch. ``growth_dispersion`` is the
    coefficient of variation of the growth rate between crystals.

    >>> out = batch(
    ...     solute_per_solvent=0.492990,
    ...     solubility={"law": "polynomial_solubility", "coefficients": [0.1286, 5.88e-3, 1.721e-4]},
    ...     growth={"law": "power_law_growth", "growth_coefficient": 1.161167e-4, "growth_order": 1.32},
    ...     duration="80 min",
    ...     temperature_program={
    ...         "law": "power_cooling",
    ...         "temperature_start": 305.15,
    ...         "temperature_end": 301.15,
    ...         "duration": "80 min",
    ...     },
    ...     crystal_density=2110,
    ...     seed_mass_per_solvent=0.0005,
    ...     seed_size="100 um",
    ...     seed_width="20 um",
    ...     steps=100,
    ... )
    >>> round(float(out.solute_per_solvent[-1] + out.crystals_per_solvent[-1]), 6)
    0.49349
    """
    check_charge(
        seed_size, seed_width, steps, solute_per_solvent, solubility, along(temperature_program, duration)
    )
    if growth_dispersion > 0 and dissolution is not None:
        raise ApplicabilityError(
            _(
                "Crystals that grow at rates of their own are followed only while they grow: leave out "
                "the dissolution or the dispersion."
            )
        )
    crystal = Crystal(crystal_density, volume_shape_factor, solute_fraction_of_crystal)
    model = Model(
        solubility,
        growth,
        nucleation,
        crystal,
        SuspensionVolume(liquid_density),
        dissolution,
        dispersion=GrowthDispersion(growth_dispersion) if growth_dispersion > 0 else None,
    )
    seeds = narrow_seeds(seed_size, seed_width, seed_mass_per_solvent, crystal.mass_per_cube)
    addition = Addition(evaporated=evaporation_program, antisolvent=antisolvent_program)
    course, error = simulated(
        model, Programmed(temperature_program, addition), seeds, solute_per_solvent, duration, steps
    )
    return course_of(course, seeds, solute_per_solvent, solute_fraction_of_crystal, error)


def course_of(course: Course, seeds: Seeds, ratio: Any, solute_fraction: Any, error: float) -> BatchCourse:
    """What is told of a batch of one kg of solvent."""
    return BatchCourse(
        course.time,
        course.temperature,
        course.solute_per_solvent,
        course.solubility_per_solvent,
        course.solute_per_solvent / course.solubility_per_solvent - 1.0,
        course.crystals,
        course.moments[:, 0],
        course.growth_rate,
        mass_mean(course),
        float(median_size(course.final)),
        nuclei_share(course, seeds),
        yield_of(course, ratio, solute_fraction),
        error,
    )


def yield_of(course: Course, ratio: Any, solute_fraction: Any) -> float:
    """Solute crystallized over solute charged; below zero where seeds dissolved."""
    return float(solute_fraction * (course.crystals[-1] - course.crystals[0]) / ratio)


class AgglomeratingCourse(NamedTuple):
    """A batch in which crystals agglomerate or break, per kg of solvent charged, with its product."""

    time: Annotated[Time, Series("points")]
    temperature: Annotated[Temperature, Series("points")]
    solute_per_solvent: Annotated[MassRatio, Series("points")]
    relative_supersaturation: Annotated[Number, Series("points")]
    crystals_per_solvent: Annotated[MassRatio, Series("points")]
    crystals_number: Annotated[NumberPerMass, Series("points")]
    class_edges: Annotated[Distance, Series("edges")]
    class_fractions: Annotated[Fraction, Series("classes")]
    mean_diameter: Length
    mass_median_size: Length
    yield_fraction: Ratio
    step_error: Ratio


@procedure(
    source="kumar2006; mullin2001, ch. 7",
    title="Batch with agglomeration and breakage",
    typical={"duration": (3600.0, 7200.0)},
)
def agglomerating_batch(
    solute_per_solvent: MassRatio,
    solubility: Solubility,
    growth: Growth,
    temperature_program: Program,
    duration: Time,
    crystal_density: Density,
    agglomeration_kernel: Annotated[Any, Law("agglomeration_kernel")] | None = None,
    breakage_law: Annotated[Any, Law("breakage_law")] | None = None,
    nucleation: Nucleation = NoNucleation(),
    seed_mass_per_solvent: MassRatio = 0.0,
    seed_size: Length = 100e-6,
    seed_width: Distance = 10e-6,
    volume_shape_factor: PositiveNumber = 1.0,
    solute_fraction_of_crystal: Fraction = 1.0,
    liquid_density: Density = 1000.0,
    steps: Steps = 400,
) -> AgglomeratingCourse:
    """A cooling batch whose crystals grow, are born, agglomerate and break, followed in size classes that
    move with the growth.

    Agglomerates count as crystals of their volume. Growth is exact, so that the number of steps must only
    resolve the collisions; the error is estimated by halving them.

    >>> out = agglomerating_batch(
    ...     solute_per_solvent=0.492990,
    ...     solubility={"law": "polynomial_solubility", "coefficients": [0.1286, 5.88e-3, 1.721e-4]},
    ...     growth={"law": "power_law_growth", "growth_coefficient": 1.161167e-4, "growth_order": 1.32},
    ...     duration="80 min",
    ...     temperature_program={
    ...         "law": "power_cooling",
    ...         "temperature_start": 305.15,
    ...         "temperature_end": 301.15,
    ...         "duration": "80 min",
    ...     },
    ...     agglomeration_kernel={"law": "constant_kernel", "agglomeration_coefficient": 1e-12},
    ...     crystal_density=2110,
    ...     seed_mass_per_solvent=0.0005,
    ...     seed_width="20 um",
    ...     steps=50,
    ... )
    >>> bool(out.crystals_number[-1] < out.crystals_number[0])
    True
    """
    check_charge(
        seed_size, seed_width, steps, solute_per_solvent, solubility, along(temperature_program, duration)
    )
    crystal = Crystal(crystal_density, volume_shape_factor, solute_fraction_of_crystal)
    model = Model(solubility, growth, nucleation, crystal, SuspensionVolume(liquid_density))
    seeds = narrow_seeds(
        seed_size, jnp.maximum(seed_width, 1e-3 * seed_size), seed_mass_per_solvent, crystal.mass_per_cube
    )
    room = with_room(seeds)
    check_classes(model, room)
    course, error = simulated(
        model,
        Programmed(temperature_program),
        room,
        solute_per_solvent,
        duration,
        steps,
        Collisions(agglomeration_kernel, breakage_law),
    )
    busiest = float(jnp.max(course.collided))
    if busiest > BUSIEST:
        raise InputError(
            _(
                "{share} % of the crystals collide within one time step: give at least {steps} steps, "
                "or check the unit of the kernel."
            ).format(share=round(200 * busiest), steps=int(np.ceil(steps * busiest / BUSIEST / 100) * 100)),
            name="steps",
        )
    edges = np.geomspace(1e-6, float(course.final.high[-1]), 61)
    cubes = np.asarray(classes_of(course.final, edges))
    return AgglomeratingCourse(
        course.time,
        course.temperature,
        course.solute_per_solvent,
        course.solute_per_solvent / course.solubility_per_solvent - 1.0,
        course.crystals,
        course.moments[:, 0],
        edges,
        cubes / max(cubes.sum(), 1e-300),
        mass_mean(course),
        float(median_size(course.final)),
        yield_of(course, solute_per_solvent, solute_fraction_of_crystal),
        error,
    )


def _cubes(packets: Any) -> Any:
    low, high = packets.sizes()
    return 0.25 * (low + high) * (low**2 + high**2)


@compiled
def classes_of(packets: Any, edges: Any) -> Any:
    """Third moment in each size class."""
    return packets.in_classes(edges)


@compiled
def median_size(packets: Any) -> Any:
    """Size that halves the crystal mass; zero without crystals."""
    low, high = packets.sizes()
    trial = jnp.sort(jnp.concatenate([low, high]))
    below = packets.below(trial)
    return jnp.interp(0.5 * below[-1], below, trial)


def along(program: Any, duration: Any) -> np.ndarray:
    """Values of a program at a few times of the batch, the start first."""
    return np.array([float(program(t)) for t in np.linspace(0.0, float(duration), 5)])


def check_charge(size: Any, width: Any, steps: int, ratio: Any, solubility: Any, temperatures: Any) -> None:
    """What would give a result without meaning: seeds, charge and the temperatures met, the first one being
    that of the start.
    """
    if size > LARGEST_SEED:
        raise InputError(
            _("Seeds of {size} mm are no crystals: check the unit.").format(size=round(size * 1e3, 1)),
            name="seed_size",
        )
    if width >= 2.0 * size:
        raise InputError(
            _("Seeds of {size} µm cannot be {width} µm wide: the width must be below twice the size.").format(
                size=round(size * 1e6, 3), width=round(width * 1e6, 3)
            ),
            name="seed_width",
        )
    if steps < 2:
        raise InputError(
            _("'steps' = {value} is too few; give at least 2.").format(value=steps), name="steps"
        )
    with flags.collect() as records:
        course = np.atleast_1d(np.asarray(solubility(jnp.asarray(temperatures, dtype=float))))
    beyond = [row for row in describe(records) if row["low"] and row["high"]]
    if beyond:
        met, low, high = (round(beyond[0][key] - ZERO_CELSIUS, 1) for key in ("worst", "low", "high"))
        raise ApplicabilityError(
            _("The batch meets {met} °C, but the solubility is known from {low} to {high} °C.").format(
                met=met, low=low, high=high
            )
        )
    saturated = float(course[0])
    if not np.isfinite(saturated) or saturated <= 0:
        raise InputError(
            _(
                "The solubility at the start, {value}, is not a positive number: is the temperature "
                "within its data?"
            ).format(value=saturated),
            name="solubility",
        )
    if np.max(course) > LARGEST_SOLUBILITY:
        raise InputError(
            _(
                "A solubility of {value} kg per kg of solvent is beyond any solute: are its "
                "coefficients for g per kg?"
            ).format(value=round(float(np.max(course)), 1)),
            name="solubility",
        )
    if ratio > 3.0 * saturated:
        raise InputError(
            _(
                "The solution holds {ratio} kg/kg against a solubility of {saturated}: check that both "
                "are per kg of solvent."
            ).format(ratio=round(float(ratio), 4), saturated=round(saturated, 4)),
            name="solute_per_solvent",
        )
