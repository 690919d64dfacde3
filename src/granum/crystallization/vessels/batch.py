"""A cooling batch from charge to product, with the error of the time steps estimated by halving them."""

from __future__ import annotations

from typing import Annotated, Any, NamedTuple

import jax.numpy as jnp
import numpy as np

from granum.core import procedure
from granum.core.errors import InputError
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
    PositiveNumber,
    Ratio,
    Series,
    Temperature,
    Time,
)
from granum.crystallization.formulas.nucleation import NoNucleation
from granum.crystallization.population.lagrangian import Course, Model, SuspensionVolume, march
from granum.crystallization.population.operations import Addition, Programmed
from granum.crystallization.population.packets import Seeds
from granum.crystallization.vessels.crystals import Crystal

SEED_PACKETS = 16


class BatchCourse(NamedTuple):
    """A cooling batch over time, per kg of solvent charged, with its product and the estimated error of the time steps."""

    time: Annotated[Time, Series("points")]
    temperature: Annotated[Temperature, Series("points")]
    solute_per_solvent: Annotated[MassRatio, Series("points")]
    solubility_per_solvent: Annotated[MassRatio, Series("points")]
    relative_supersaturation: Annotated[Number, Series("points")]
    crystals_per_solvent: Annotated[MassRatio, Series("points")]
    crystals_number: Annotated[Ratio, Series("points")]
    growth_rate: Annotated[GrowthRate, Series("points")]
    mean_diameter: Length
    mass_median_size: Length
    nuclei_mass_fraction: Ratio
    yield_fraction: Ratio
    step_error: Ratio


def narrow_seeds(size: Any, width: Any, mass: Any, mass_per_cube: Any) -> Seeds:
    """Seeds of a sieve cut: a parabola of number over ``size ± width/2`` (all at one size when the width is zero)."""
    edges = size + width * jnp.linspace(-0.5, 0.5, SEED_PACKETS + 1)
    shape = jnp.diff(_parabola(jnp.linspace(-1.0, 1.0, SEED_PACKETS + 1)))
    low, high = edges[:-1], edges[1:]
    cubes = shape * 0.25 * (low + high) * (low**2 + high**2)
    return Seeds(low, high, shape * mass / (mass_per_cube * jnp.sum(cubes)))


def _parabola(x: Any) -> Any:
    """Integral of ``1 − x²``."""
    return x - x**3 / 3.0


def halved(run: Any, duration: Any, steps: int) -> tuple[Course, Any]:
    """A run and the relative error of its crystal mass, number and size, by comparison with half the steps (second order).

    The coarse run takes every second step with zero length, so that both are one compiled program.
    """
    steps += steps % 2
    times = jnp.linspace(0.0, duration, steps + 1)
    index = np.arange(steps + 1)
    fine, coarse = run(times), run(times[index + index % 2])

    def figures(course: Course) -> Any:
        m = course.moments[-1]
        return jnp.stack([m[3], m[0], jnp.where(m[2] > 0, m[3] / jnp.where(m[2] > 0, m[2], 1.0), 0.0)])

    a, b = figures(fine), figures(coarse)
    return fine, jnp.max(jnp.abs(a - b) / jnp.maximum(jnp.abs(a), 1e-300)) / 3.0


@procedure(
    source="miller1994; chung1999; mullin2001, ch. 9",
    title="Seeded or unseeded batch",
    typical={"duration": (3600.0, 7200.0)},
)
def batch(
    solute_per_solvent: MassRatio,
    solubility: Annotated[Any, Law("solubility_law")],
    growth: Annotated[Any, Law("growth_rate")],
    temperature_program: Annotated[Any, Law("program")],
    duration: Time,
    crystal_density: Density,
    nucleation: Annotated[Any, Law("nucleation_rate")] = NoNucleation(),
    seed_mass_per_solvent: MassRatio = 0.0,
    seed_size: Length = 100e-6,
    seed_width: Distance = 0.0,
    volume_shape_factor: PositiveNumber = 1.0,
    solute_fraction_of_crystal: Fraction = 1.0,
    liquid_density: Density = 1000.0,
    dissolution: Annotated[Any, Law("dissolution_rate")] | None = None,
    evaporation_program: Annotated[Any, Law("program")] | None = None,
    antisolvent_program: Annotated[Any, Law("program")] | None = None,
    steps: int = 400,
) -> BatchCourse:
    """Concentration, temperature and crystals of a cooling batch over time, with its product and the error of the time steps.

    Seeds are a sieve cut of given mean size and width. Solute and crystals are conserved to rounding whatever the number of steps; the
    error of the rest is estimated by halving them. Without a dissolution law, crystals keep in an undersaturated solution. Programs of the mass
    evaporated and of the antisolvent added, per kg of solvent charged, make it an evaporative or antisolvent batch.

    >>> out = batch(solute_per_solvent=0.492990, solubility={"law": "polynomial_solubility", "coefficients": [0.1286, 5.88e-3, 1.721e-4]},
    ...     growth={"law": "power_law_growth", "growth_coefficient": 1.161167e-4, "growth_order": 1.32}, duration="80 min",
    ...     temperature_program={"law": "power_cooling", "temperature_start": 305.15, "temperature_end": 301.15, "duration": "80 min"},
    ...     crystal_density=2110, seed_mass_per_solvent=0.0005, seed_size="100 um", seed_width="20 um", steps=100)
    >>> round(float(out.solute_per_solvent[-1] + out.crystals_per_solvent[-1]), 6)
    0.49349
    """
    _check(seed_size, seed_width, steps, solute_per_solvent, solubility, temperature_program)
    crystal = Crystal(crystal_density, volume_shape_factor, solute_fraction_of_crystal)
    model = Model(solubility, growth, nucleation, crystal, SuspensionVolume(liquid_density), dissolution)
    seeds = narrow_seeds(seed_size, seed_width, seed_mass_per_solvent, crystal.mass_per_cube)
    addition = Addition(evaporated=evaporation_program, antisolvent=antisolvent_program)

    def run(times: Any) -> Course:
        return march(model, Programmed(temperature_program, addition), seeds, solute_per_solvent, 1.0, times)

    course, error = halved(run, duration, steps)
    final = course.final
    grown_seed = jnp.sum(final.number[:SEED_PACKETS] * _cubes(final)[:SEED_PACKETS]) * crystal.mass_per_cube
    all_crystals = course.crystals[-1]
    fed = solute_per_solvent
    return BatchCourse(
        course.time, course.temperature, course.solute_per_solvent, course.solubility_per_solvent,
        course.solute_per_solvent / course.solubility_per_solvent - 1.0, course.crystals, course.moments[:, 0], course.growth_rate,
        float(final.mean_size(4, 3)), float(median_size(final)), float(1.0 - grown_seed / jnp.maximum(all_crystals, 1e-300)),
        float(solute_fraction_of_crystal * (all_crystals - course.crystals[0]) / fed), float(error),
    )  # fmt: skip


def _cubes(packets: Any) -> Any:
    low, high = packets.sizes()
    return 0.25 * (low + high) * (low**2 + high**2)


def median_size(packets: Any) -> Any:
    """Size that halves the crystal mass; zero without crystals."""
    low, high = packets.sizes()
    trial = jnp.unique(jnp.concatenate([low, high]), size=low.shape[0] * 2, fill_value=jnp.max(high))
    below = packets.below(trial)
    return jnp.interp(0.5 * below[-1], below, trial)


def _check(size: Any, width: Any, steps: int, ratio: Any, solubility: Any, program: Any) -> None:
    """What would give a result without meaning."""
    if width >= 2.0 * size:
        raise InputError(_("Seeds of {size} µm cannot be {width} µm wide: the width must be below twice the size.").format(
            size=round(size * 1e6, 3), width=round(width * 1e6, 3)), name="seed_width")  # fmt: skip
    if steps < 2:
        raise InputError(_("'steps' = {value} is too few; give at least 2.").format(value=steps), name="steps")
    saturated = float(np.asarray(solubility(program(0.0))))
    if not np.isfinite(saturated) or saturated <= 0:
        raise InputError(_("The solubility at the start, {value}, is not a positive number: is the temperature within its data?").format(
            value=saturated), name="solubility")  # fmt: skip
    if ratio > 3.0 * saturated:
        raise InputError(
            _("The solution holds {ratio} kg/kg against a solubility of {saturated}: check that both are per kg of solvent.").format(
                ratio=round(float(ratio), 4), saturated=round(saturated, 4)),
            name="solute_per_solvent",
        )  # fmt: skip
