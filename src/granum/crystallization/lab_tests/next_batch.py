"""Which seeded batch to run next so that the kinetics become most certain."""

from __future__ import annotations

from typing import Annotated, Any, NamedTuple

import jax
import jax.numpy as jnp
import numpy as np

from granum.core import procedure
from granum.core.errors import ApplicabilityError, InputError
from granum.core.i18n import _
from granum.core.kinds import (
    Density,
    Distance,
    Length,
    MassRatio,
    NucleationRate,
    PositiveNumber,
    Ratio,
    Series,
    Temperature,
    Time,
    Within,
)
from granum.crystallization.formulas.growth import PowerLawGrowth
from granum.crystallization.formulas.nucleation import PowerLawNucleation
from granum.crystallization.formulas.programs import PowerCooling
from granum.crystallization.kinds import RateCoefficient, Solubility
from granum.crystallization.population.compiled import compiled
from granum.crystallization.population.lagrangian import Model, SuspensionVolume, march
from granum.crystallization.population.operations import Programmed
from granum.crystallization.vessels.batch import narrow_seeds
from granum.crystallization.vessels.crystals import Crystal
from granum.numerics.smooth import safe_divide

STEPS_PER_SAMPLE = 10


class NextBatches(NamedTuple):
    """Candidates, the most informative first, with the standard errors that the kinetics would have after
    each.

    The errors are of the logarithms of the coefficients (relative errors) and of the orders. ``joint_error``
    is the geometric mean of the axes of the confidence ellipsoid: the smaller, the better (D-optimal design).
    """

    seed_mass_per_solvent: Annotated[MassRatio, Series("candidates")]
    duration: Annotated[Time, Series("candidates")]
    joint_error: Annotated[PositiveNumber, Series("candidates")]
    growth_coefficient_error: Annotated[PositiveNumber, Series("candidates")]
    growth_order_error: Annotated[PositiveNumber, Series("candidates")]
    nucleation_coefficient_error: Annotated[PositiveNumber, Series("candidates")]
    nucleation_order_error: Annotated[PositiveNumber, Series("candidates")]


@compiled
def _information(kinetics: Any, setting: tuple[Any, ...], seed: Any, duration: Any, samples: int) -> Any:
    """Fisher information of one batch on the logarithms of the coefficients and the orders."""
    solubility, crystal, density, hot, cold, size, width, errors, measured_size = setting
    start = solubility(hot)

    def measured(p: Any) -> Any:
        laws = PowerLawGrowth(jnp.exp(p[0]), p[1]), PowerLawNucleation(jnp.exp(p[2]), p[3])
        model = Model(solubility, *laws, crystal, SuspensionVolume(density))
        seeds = narrow_seeds(size, width, seed, crystal.mass_per_cube)
        times = jnp.linspace(0.0, duration, samples * STEPS_PER_SAMPLE + 1)
        course = march(model, Programmed(PowerCooling(hot, cold, duration, 1.0)), seeds, start, 1.0, times)
        at = slice(STEPS_PER_SAMPLE, None, STEPS_PER_SAMPLE)
        ratio = course.solute_per_solvent[at] / errors[0]
        mean = safe_divide(course.moments[at, 4], course.moments[at, 3])
        return jnp.concatenate([ratio, measured_size * jnp.log(mean) / errors[1]])

    slopes = jax.jacfwd(measured)(kinetics)
    return slopes.T @ slopes


@procedure(source="atkinson2007, ch. 11 and 17; miller1994", title="Next seeded batch for the kinetics")
def next_batch(
    growth_coefficient: RateCoefficient,
    growth_order: PositiveNumber,
    nucleation_coefficient: Annotated[NucleationRate, Within(1e-300)],
    nucleation_order: PositiveNumber,
    solubility: Solubility,
    temperature_start: Temperature,
    temperature_end: Temperature,
    crystal_density: Density,
    candidate_seed_masses: Annotated[MassRatio, Series("candidates")],
    candidate_durations: Annotated[Time, Series("candidates")],
    done_seed_masses: Annotated[MassRatio, Series("done")] | None = None,
    done_durations: Annotated[Time, Series("done")] | None = None,
    seed_size: Length = 100e-6,
    seed_width: Distance = 20e-6,
    volume_shape_factor: PositiveNumber = 1.0,
    liquid_density: Density = 1000.0,
    concentration_error: MassRatio = 1e-4,
    size_error: Ratio = 0.02,
    size_is_measured: bool = True,
    samples: Annotated[int, Within(2, 10_000)] = 20,
) -> NextBatches:
    """Candidate batches ranked by what they would teach about growth and secondary nucleation, given what was
    run already.

    Linear cooling between two temperatures, sampled at even times; the information of each batch comes from
    exact sensitivities at the present estimates of the kinetics, with the given errors of concentration
    (kg/kg) and of the mean size (relative), and adds to that of the batches done.

    >>> out = next_batch(
    ...     growth_coefficient=1.16e-4,
    ...     growth_order=1.32,
    ...     nucleation_coefficient=2.2e8,
    ...     nucleation_order=1.78,
    ...     solubility={"law": "polynomial_solubility", "coefficients": [0.1286, 5.88e-3, 1.721e-4]},
    ...     temperature_start=305.15,
    ...     temperature_end=301.15,
    ...     crystal_density=2110,
    ...     candidate_seed_masses=[0.0005, 0.01],
    ...     candidate_durations=["40 min", "80 min"],
    ... )
    >>> bool(out.joint_error[0] < out.joint_error[1])
    True
    """
    masses, durations = np.atleast_1d(candidate_seed_masses), np.atleast_1d(candidate_durations)
    done = [np.atleast_1d(v) if v is not None else np.zeros(0) for v in (done_seed_masses, done_durations)]
    if len(masses) != len(durations) or len(done[0]) != len(done[1]):
        raise InputError(
            _("Give each batch a seed mass and a duration: {masses} and {durations} were given.").format(
                masses=len(masses) + len(done[0]), durations=len(durations) + len(done[1])
            ),
            name="candidate_durations",
        )
    kinetics = jnp.array(
        [np.log(growth_coefficient), growth_order, np.log(nucleation_coefficient), nucleation_order],
        dtype=float,
    )
    crystal = Crystal(crystal_density, volume_shape_factor)
    setting = (
        solubility,
        crystal,
        liquid_density,
        temperature_start,
        temperature_end,
        seed_size,
        seed_width,
        (concentration_error, size_error),
        1.0 if size_is_measured else 0.0,
    )

    def information(mass: Any, duration: Any) -> np.ndarray:
        return np.asarray(_information(kinetics, setting, float(mass), float(duration), samples))

    known = sum((information(m, t) for m, t in zip(*done, strict=True)), np.zeros((4, 4)))
    rows = []
    for mass, duration in zip(masses, durations, strict=True):
        total = known + information(mass, duration)
        scale = 1.0 / np.sqrt(np.maximum(np.diag(total), 1e-300))
        values, vectors = np.linalg.eigh(total * np.outer(scale, scale))
        if values[0] <= 1e-12:
            continue
        covariance = (vectors / values) @ vectors.T * np.outer(scale, scale)
        joint = float(np.exp(np.linalg.slogdet(covariance)[1] / 8.0))
        rows.append((float(mass), float(duration), joint, *np.sqrt(np.diag(covariance))))
    if not rows:
        raise ApplicabilityError(
            _(
                "None of these batches tells all four parameters apart: measure the size as well, or "
                "use less seed so that nuclei matter."
            )
        )
    rows.sort(key=lambda row: row[2])
    return NextBatches(*(np.array(column) for column in zip(*rows, strict=True)))
