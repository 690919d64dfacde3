"""A batch whose temperature follows its concentration, so that the supersaturation is kept."""

from __future__ import annotations

from typing import Annotated

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
from granum.crystallization.kinds import Growth, Nucleation, ReadingDeviation, Solubility, Steps
from granum.crystallization.population.lagrangian import Model, SuspensionVolume
from granum.crystallization.population.operations import Held, Sensor
from granum.crystallization.vessels.batch import (
    BatchCourse,
    along,
    check_charge,
    course_of,
    narrow_seeds,
    simulated,
)
from granum.crystallization.vessels.crystals import Crystal


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
    if temperature_end >= temperature_start:
        raise InputError(
            _("Cooling ends at {end} K, above its start at {start} K.").format(
                end=temperature_end, start=temperature_start
            ),
            name="temperature_end",
        )

    def straight(time: float) -> float:
        return temperature_start + (temperature_end - temperature_start) * time / duration

    ends = along(straight, duration)
    check_charge(seed_size, seed_width, steps, solute_per_solvent, solubility, ends)
    hot, cold = (float(solubility(T)) for T in (temperature_start, temperature_end))
    if cold >= hot:
        raise InputError(
            _(
                "The solubility does not fall on cooling: {hot} kg/kg at the start, {cold} at the end. "
                "Cooling cannot keep this solution supersaturated; take evaporation or an antisolvent."
            ).format(hot=format_number(hot, 3), cold=format_number(cold, 3)),
            name="solubility",
        )
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
