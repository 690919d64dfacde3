"""Two crystal forms in one vessel: the less stable one dissolves while the stable one grows from the same
solution.
"""

from __future__ import annotations

from typing import Annotated, NamedTuple

import jax.numpy as jnp
import numpy as np

from granum.core import procedure
from granum.core.errors import InputError
from granum.core.i18n import _
from granum.core.kinds import (
    Density,
    Distance,
    Fraction,
    Length,
    MassRatio,
    PositiveNumber,
    Ratio,
    Series,
    Temperature,
    Time,
)
from granum.crystallization.formulas.nucleation import NoNucleation
from granum.crystallization.kinds import Dissolution, Growth, Nucleation, Program, Solubility, Steps
from granum.crystallization.population.rivals import Form, Rivals, compete, halved
from granum.crystallization.vessels.batch import along, check_charge, narrow_seeds
from granum.crystallization.vessels.crystals import Crystal


class PolymorphCourse(NamedTuple):
    """A batch with two crystal forms over time, per kg of solvent, and its product."""

    time: Annotated[Time, Series("points")]
    temperature: Annotated[Temperature, Series("points")]
    solute_per_solvent: Annotated[MassRatio, Series("points")]
    solubility_per_solvent: Annotated[MassRatio, Series("points")]
    solubility_stable: Annotated[MassRatio, Series("points")]
    crystals_metastable: Annotated[MassRatio, Series("points")]
    crystals_stable: Annotated[MassRatio, Series("points")]
    stable_fraction: Annotated[Fraction, Series("points")]
    stable_fraction_end: Fraction
    mean_diameter_metastable: Distance
    mean_diameter_stable: Distance
    step_error: Ratio


@procedure(
    source="cardew1985; ono2004; schoell2006",
    title="Batch with two polymorphs (solvent-mediated transformation)",
    typical={"duration": (3600.0, 36000.0)},
)
def polymorph_batch(
    solute_per_solvent: MassRatio,
    solubility: Solubility,
    solubility_law_stable: Solubility,
    growth: Growth,
    growth_stable: Growth,
    dissolution: Dissolution,
    temperature_program: Program,
    duration: Time,
    crystal_density: Density,
    nucleation: Nucleation = NoNucleation(),
    nucleation_stable: Nucleation = NoNucleation(),
    cross_nucleation: Ratio = 0.0,
    seed_mass_per_solvent: MassRatio = 0.0,
    seed_size: Length = 100e-6,
    seed_width: Distance = 0.0,
    seed_mass_stable: MassRatio = 0.0,
    seed_size_stable: Length = 50e-6,
    volume_shape_factor: PositiveNumber = 1.0,
    volume_shape_factor_stable: PositiveNumber = 1.0,
    liquid_density: Density = 1000.0,
    steps: Steps = 400,
) -> PolymorphCourse:
    """Concentration and both crystal forms of one substance over time: the metastable form dissolves while
    the stable one is born and grows.

    Where dissolving is the faster, the concentration stays at the solubility of the metastable form until
    that has gone; where growing is, it falls to that of the stable form at once (Cardew and Davey). Births of
    the stable form count its own magma and, with ``cross_nucleation``, a share of the other's. Both forms
    have one density and hold no solvent; they dissolve by one law.

    >>> out = polymorph_batch(
    ...     solute_per_solvent=0.02,
    ...     solubility={"law": "polynomial_solubility", "coefficients": [0.02]},
    ...     solubility_law_stable={"law": "polynomial_solubility", "coefficients": [0.015]},
    ...     growth={"law": "power_law_growth", "growth_coefficient": 1e-7, "growth_order": 1.0},
    ...     growth_stable={"law": "power_law_growth", "growth_coefficient": 1e-7, "growth_order": 1.0},
    ...     dissolution={"law": "power_law_dissolution", "dissolution_coefficient": 1e-5},
    ...     temperature_program={
    ...         "law": "power_cooling",
    ...         "temperature_start": 298.15,
    ...         "temperature_end": 298.15,
    ...         "duration": 3600,
    ...     },
    ...     duration="8 hour",
    ...     crystal_density=1540,
    ...     seed_mass_per_solvent=0.01,
    ...     seed_mass_stable=0.001,
    ...     steps=100,
    ... )
    >>> bool(out.stable_fraction_end > 0.9)
    True
    """
    temperatures = along(temperature_program, duration)
    for law in (solubility, solubility_law_stable):
        check_charge(seed_size, seed_width, steps, solute_per_solvent, law, temperatures)
    gaps = np.array([float(solubility(T)) - float(solubility_law_stable(T)) for T in temperatures])
    if (gaps < 0.0).all():
        raise InputError(
            _(
                "The stable form dissolves more than the other at every temperature of the batch: change "
                "the two solubilities round."
            ),
            name="solubility_law_stable",
        )
    shapes = (volume_shape_factor, volume_shape_factor_stable)
    one, other = (Crystal(crystal_density, shape) for shape in shapes)
    forms = (
        Form(solubility, growth, nucleation, dissolution, one),
        Form(solubility_law_stable, growth_stable, nucleation_stable, dissolution, other),
    )
    seeds = (
        narrow_seeds(seed_size, seed_width, seed_mass_per_solvent, one.mass_per_cube),
        narrow_seeds(seed_size_stable, 0.0, seed_mass_stable, other.mass_per_cube),
    )
    steps += steps % 2
    times = jnp.linspace(0.0, duration, steps + 1)
    rivals = Rivals(forms, liquid_density, (0.0, cross_nucleation))
    fine, coarse = (
        compete(rivals, seeds, temperature_program, [solute_per_solvent], t)[1]
        for t in (times, halved(times))
    )
    crystals = np.asarray(fine.masses)
    every = np.maximum(crystals.sum(axis=1), 1e-300)
    share = crystals[:, 1] / every
    apart = np.abs(np.asarray(fine.masses)[-1] - np.asarray(coarse.masses)[-1]).max() / every[-1]
    return PolymorphCourse(
        times,
        fine.temperature,
        fine.ratios[:, 0],
        fine.saturated[:, 0],
        fine.saturated[:, 1],
        crystals[:, 0],
        crystals[:, 1],
        share,
        float(share[-1]),
        float(fine.sizes[-1, 0]),
        float(fine.sizes[-1, 1]),
        float(apart) / 3.0,
    )
