"""Batches whose temperature follows what probes read: the concentration, or the number of crystals."""

from __future__ import annotations

from typing import Annotated, Any

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
    Temperature,
    TemperatureRate,
    Time,
    Within,
)
from granum.core.units import format_number
from granum.crystallization.formulas.nucleation import NoNucleation
from granum.crystallization.kinds import (
    CountBound,
    Dissolution,
    Growth,
    Nucleation,
    ReadingDeviation,
    Solubility,
    Steps,
)
from granum.crystallization.population.lagrangian import Model, SuspensionVolume
from granum.crystallization.population.operations import Counted, Held, Sensor
from granum.crystallization.vessels.batch import (
    BatchCourse,
    check_charge,
    course_of,
    narrow_seeds,
    simulated,
)
from granum.crystallization.vessels.crystals import Crystal


def cooled_between(solubility: Any, temperature_start: float, temperature_end: float) -> np.ndarray:
    """Temperatures from start to end, refused where cooling would not supersaturate."""
    if temperature_end >= temperature_start:
        raise InputError(
            _("Cooling ends at {end} K, above its start at {start} K.").format(
                end=temperature_end, start=temperature_start
            ),
            name="temperature_end",
        )
    hot, cold = (float(solubility(T)) for T in (temperature_start, temperature_end))
    if cold >= hot:
        raise InputError(
            _(
                "The solubility does not fall on cooling: {hot} kg/kg at the start, {cold} at the end. "
                "Cooling cannot keep this solution supersaturated; take evaporation or an antisolvent."
            ).format(hot=format_number(hot, 3), cold=format_number(cold, 3)),
            name="solubility",
        )
    return np.linspace(temperature_start, temperature_end, 5)


@procedure(
    source="braatz2002; fujiwara2005",
    title="Seeded batch at constant supersaturation",
    typical={"duration": (3600.0, 7200.0)},
)
def controlled_batch(
    solute_per_solvent: MassRatio,
    solubility: Solubility,
    growth: Growth,
    supersaturation_kept: PositiveNumber,
    temperature_start: Temperature,
    temperature_end: Temperature,
    duration: Time,
    crystal_density: Density,
    cooling_rate_maximum: TemperatureRate = 30.0 / 3600.0,
    concentration_deviation: ReadingDeviation = 0.0,
    reading_interval: Annotated[Time, Within(1.0)] = 60.0,
    nucleation: Nucleation = NoNucleation(),
    seed_mass_per_solvent: MassRatio = 0.0,
    seed_size: Length = 100e-6,
    seed_width: Distance = 0.0,
    volume_shape_factor: PositiveNumber = 1.0,
    solute_fraction_of_crystal: Fraction = 1.0,
    liquid_density: Density = 1000.0,
    steps: Steps = 400,
) -> BatchCourse:
    """Course of a batch whose temperature is set from the concentration read, so that the liquor holds a
    given relative supersaturation until the final temperature is reached.

    The temperature sought is that at which the solubility is the concentration over one plus the
    supersaturation; the vessel follows within its fastest cooling and heating, between the temperatures of
    start and end. No kinetics enter the control. Readings err by a relative standard deviation, the same
    draws in every run, each kept until the next one.

    >>> out = controlled_batch(
    ...     solute_per_solvent=0.492990,
    ...     solubility={"law": "polynomial_solubility", "coefficients": [0.1286, 5.88e-3, 1.721e-4]},
    ...     growth={"law": "power_law_growth", "growth_coefficient": 1.161167e-4, "growth_order": 1.32},
    ...     supersaturation_kept=0.004,
    ...     temperature_start=305.15,
    ...     temperature_end=301.15,
    ...     duration="80 min",
    ...     crystal_density=2110,
    ...     seed_mass_per_solvent=0.002,
    ...     steps=100,
    ... )
    >>> round(float(out.relative_supersaturation[50]), 5)
    0.004
    """
    temperatures = cooled_between(solubility, temperature_start, temperature_end)
    check_charge(seed_size, seed_width, steps, solute_per_solvent, solubility, temperatures)
    crystal = Crystal(crystal_density, volume_shape_factor, solute_fraction_of_crystal)
    model = Model(solubility, growth, nucleation, crystal, SuspensionVolume(liquid_density))
    seeds = narrow_seeds(seed_size, seed_width, seed_mass_per_solvent, crystal.mass_per_cube)
    operation = Held(
        model,
        supersaturation_kept,
        temperature_start,
        temperature_end,
        cooling_rate_maximum,
        Sensor(concentration_deviation, reading_interval) if concentration_deviation > 0 else None,
    )
    course, error = simulated(model, operation, seeds, solute_per_solvent, duration, steps)
    return course_of(course, seeds, solute_per_solvent, solute_fraction_of_crystal, error)


@procedure(
    source="abubakar2009; saleemi2012",
    title="Batch at a controlled number of crystals",
    typical={"duration": (3600.0, 7200.0)},
)
def nucleation_controlled_batch(
    solute_per_solvent: MassRatio,
    solubility: Solubility,
    growth: Growth,
    dissolution: Dissolution,
    crystal_number_lower: CountBound,
    crystal_number_upper: CountBound,
    temperature_start: Temperature,
    temperature_end: Temperature,
    duration: Time,
    crystal_density: Density,
    cooling_rate: TemperatureRate = 6.0 / 3600.0,
    cooling_rate_between: TemperatureRate = 1.5 / 3600.0,
    heating_rate: TemperatureRate = 12.0 / 3600.0,
    count_deviation: ReadingDeviation = 0.0,
    reading_interval: Annotated[Time, Within(1.0)] = 60.0,
    nucleation: Nucleation = NoNucleation(),
    seed_mass_per_solvent: MassRatio = 0.0,
    seed_size: Length = 100e-6,
    seed_width: Distance = 0.0,
    volume_shape_factor: PositiveNumber = 1.0,
    solute_fraction_of_crystal: Fraction = 1.0,
    liquid_density: Density = 1000.0,
    steps: Steps = 400,
) -> BatchCourse:
    """Course of a batch that is heated while a probe counts too many crystals in a volume of suspension and
    cooled while it counts too few (direct nucleation control).

    Between the bounds it cools slowly, so that what is there grows and the batch ends. The temperature stays
    between those of start and end, where it waits. The probe counts all crystals, the smallest included,
    which a real one misses for a while. No kinetics enter the control. Readings err as in
    ``controlled_batch``. The error of the time steps also holds that of the moments at which the vessel turns
    from cooling to heating.

    >>> out = nucleation_controlled_batch(
    ...     solute_per_solvent=0.492990,
    ...     solubility={"law": "polynomial_solubility", "coefficients": [0.1286, 5.88e-3, 1.721e-4]},
    ...     growth={"law": "power_law_growth", "growth_coefficient": 1.161167e-4, "growth_order": 1.32},
    ...     dissolution={"law": "power_law_dissolution", "dissolution_coefficient": "1 mm/s"},
    ...     nucleation={
    ...         "law": "secondary_nucleation",
    ...         "nucleation_coefficient": 1e15,
    ...         "nucleation_order": 6,
    ...         "magma_order": 0,
    ...     },
    ...     crystal_number_lower="50 1/cm^3",
    ...     crystal_number_upper="100 1/cm^3",
    ...     temperature_start=305.15,
    ...     temperature_end=301.15,
    ...     duration="80 min",
    ...     crystal_density=2110,
    ...     steps=100,
    ... )
    >>> bool(out.temperature[50] > 301.15)
    True
    """
    if crystal_number_lower >= crystal_number_upper:
        raise InputError(
            _(
                "The lower bound, {lower} crystals per m³, is not below the upper one, {upper}: "
                "give the counts below which to cool and above which to heat."
            ).format(
                lower=format_number(crystal_number_lower, 3), upper=format_number(crystal_number_upper, 3)
            ),
            name="crystal_number_lower",
        )
    temperatures = cooled_between(solubility, temperature_start, temperature_end)
    check_charge(seed_size, seed_width, steps, solute_per_solvent, solubility, temperatures)
    crystal = Crystal(crystal_density, volume_shape_factor, solute_fraction_of_crystal)
    volume = SuspensionVolume(liquid_density)
    model = Model(solubility, growth, nucleation, crystal, volume, dissolution)
    seeds = narrow_seeds(seed_size, seed_width, seed_mass_per_solvent, crystal.mass_per_cube)
    liquor = 1.0 + solute_per_solvent
    seeded = float(seeds.moments()[0] / volume(liquor, 1.0, seed_mass_per_solvent, crystal))
    if seeded > crystal_number_upper and solute_per_solvent >= float(solubility(temperature_start)):
        raise InputError(
            _(
                "The seeds are {seeds} crystals per m³, more than the upper bound of {upper}, and do not "
                "dissolve at the start: the batch would stay warm. Give fewer or larger seeds or a higher "
                "bound."
            ).format(seeds=format_number(seeded, 3), upper=format_number(crystal_number_upper, 3)),
            name="crystal_number_upper",
        )
    operation = Counted(
        model,
        crystal_number_lower,
        crystal_number_upper,
        temperature_start,
        temperature_end,
        cooling_rate,
        cooling_rate_between,
        heating_rate,
        Sensor(count_deviation, reading_interval) if count_deviation > 0 else None,
    )
    course, error = simulated(model, operation, seeds, solute_per_solvent, duration, steps)
    made = course_of(course, seeds, solute_per_solvent, solute_fraction_of_crystal, error)
    if made.relative_supersaturation[-1] > 1e-6 and made.crystals_per_solvent[-1] == 0.0:
        raise InputError(
            _(
                "There are no seeds, and the law of nucleation bears no crystals where none are (relative "
                "supersaturation {supersaturation} at the end): the batch would wait for ever. Give seeds or "
                "a primary nucleation, such as 'secondary_nucleation' with a magma order of 0."
            ).format(supersaturation=format_number(made.relative_supersaturation[-1], 3)),
            name="seed_mass_per_solvent",
        )
    return made
