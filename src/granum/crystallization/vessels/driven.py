"""Batches whose temperature follows from a heat balance: cooled through a jacket, or boiling under vacuum."""

from __future__ import annotations

from typing import Annotated, Any, NamedTuple

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np

from granum.core import procedure
from granum.core.kinds import (
    Area,
    Density,
    Distance,
    Fraction,
    HeatCapacity,
    HeatTransferCoefficient,
    Length,
    Mass,
    MassRatio,
    Number,
    PositiveNumber,
    Power,
    Ratio,
    Series,
    SpecificEnergy,
    Temperature,
    TemperatureDifference,
    Time,
)
from granum.crystallization.formulas.encrustation import wall_temperature_jacket
from granum.crystallization.formulas.nucleation import NoNucleation
from granum.crystallization.kinds import Growth, Nucleation, Program, Solubility, Steps
from granum.crystallization.population.lagrangian import Model, SuspensionVolume
from granum.crystallization.population.operations import Flashing, HeatData, Jacketed
from granum.crystallization.vessels.batch import (
    along,
    check_charge,
    mass_mean,
    narrow_seeds,
    nuclei_share,
    simulated,
    yield_of,
)
from granum.crystallization.vessels.crystals import Crystal, saturation


class Constant(eqx.Module):
    """A property that does not depend on temperature."""

    value: Any

    def __call__(self, temperature: Any) -> Any:
        return self.value + 0.0 * temperature


class JacketedCourse(NamedTuple):
    """A batch cooled through its jacket over time, with its product and how near the wall came to
    encrustation.
    """

    time: Annotated[Time, Series("points")]
    temperature: Annotated[Temperature, Series("points")]
    jacket_temperature: Annotated[Temperature, Series("points")]
    wall_temperature: Annotated[Temperature, Series("points")]
    solute_per_solvent: Annotated[MassRatio, Series("points")]
    solubility_per_solvent: Annotated[MassRatio, Series("points")]
    relative_supersaturation: Annotated[Number, Series("points")]
    crystals_per_solvent: Annotated[MassRatio, Series("points")]
    heat_duty: Annotated[Power, Series("points")]
    temperature_difference_maximum: TemperatureDifference
    undercooling_wall_maximum: TemperatureDifference
    mean_diameter: Length
    nuclei_mass_fraction: Ratio
    yield_fraction: Ratio
    step_error: Ratio


def wall_undercooling(solubility: Any, ratio: Any, wall: Any, solvent: Any) -> Any:
    """How far the wall is below the temperature at which the liquor is saturated, by the slope of the
    solubility at the wall.
    """

    def at(T: Any, free: Any) -> Any:
        return jnp.asarray(saturation(solubility, T, free), dtype=float)

    saturated, slope = jax.vmap(jax.value_and_grad(at))(wall, solvent + jnp.zeros_like(wall))
    return (ratio - saturated) / slope


@procedure(
    source="mullin2001, ch. 9; kern1950, ch. 20",
    title="Batch cooled through a jacket",
    typical={"duration": (3600.0, 7200.0)},
)
def jacketed_batch(
    solute_per_solvent: MassRatio,
    solubility: Solubility,
    growth: Growth,
    jacket_program: Program,
    temperature_start: Temperature,
    duration: Time,
    crystal_density: Density,
    solvent_mass: Mass,
    area: Area,
    heat_transfer_coefficient: HeatTransferCoefficient,
    heat_transfer_coefficient_inside: HeatTransferCoefficient = 1000.0,
    specific_heat_capacity: HeatCapacity = 3500.0,
    specific_heat_capacity_crystal: HeatCapacity = 1000.0,
    heat_released_per_crystal: SpecificEnergy = 0.0,
    nucleation: Nucleation = NoNucleation(),
    seed_mass_per_solvent: MassRatio = 0.0,
    seed_size: Length = 100e-6,
    seed_width: Distance = 0.0,
    volume_shape_factor: PositiveNumber = 1.0,
    solute_fraction_of_crystal: Fraction = 1.0,
    liquid_density: Density = 1000.0,
    steps: Steps = 400,
) -> JacketedCourse:
    """Temperature, concentration and crystals of a batch cooled through its jacket, from the heat balance
    with the heat of crystallization.

    The overall coefficient is between suspension and coolant; with the coefficient on the side of the
    suspension it gives the temperature of the wall, and the undercooling there: crystals grow on the wall
    where it exceeds the metastable zone width.

    >>> out = jacketed_batch(
    ...     solute_per_solvent=0.492990,
    ...     solubility={"law": "polynomial_solubility", "coefficients": [0.1286, 5.88e-3, 1.721e-4]},
    ...     growth={"law": "power_law_growth", "growth_coefficient": 1.161167e-4, "growth_order": 1.32},
    ...     duration="80 min",
    ...     jacket_program={
    ...         "law": "natural_cooling",
    ...         "temperature_start": 305.15,
    ...         "jacket_temperature": 300.15,
    ...         "cooling_time": "30 min",
    ...     },
    ...     temperature_start=305.15,
    ...     crystal_density=2110,
    ...     solvent_mass=18.0,
    ...     area=0.25,
    ...     heat_transfer_coefficient=500,
    ...     specific_heat_capacity=3800,
    ...     heat_released_per_crystal=44.5e3,
    ...     seed_mass_per_solvent=0.0005,
    ...     steps=100,
    ... )
    >>> bool(300.15 < out.temperature[-1] < 301.0)
    True
    """
    check_charge(seed_size, seed_width, steps, solute_per_solvent, solubility, temperature_start)
    crystal = Crystal(crystal_density, volume_shape_factor, solute_fraction_of_crystal)
    model = Model(solubility, growth, nucleation, crystal, SuspensionVolume(liquid_density))
    seeds = narrow_seeds(seed_size, seed_width, seed_mass_per_solvent, crystal.mass_per_cube)
    heat = HeatData(specific_heat_capacity, specific_heat_capacity_crystal, heat_released_per_crystal)
    exchange = heat_transfer_coefficient * area
    operation = Jacketed(temperature_start, jacket_program, exchange / solvent_mass, heat)
    course, error = simulated(model, operation, seeds, solute_per_solvent, duration, steps)
    T, T_j = course.temperature, jax.vmap(jacket_program)(course.time) + jnp.zeros_like(course.time)
    wall = wall_temperature_jacket.function(
        T, T_j, heat_transfer_coefficient, heat_transfer_coefficient_inside
    )
    return JacketedCourse(
        course.time,
        T,
        T_j,
        wall,
        course.solute_per_solvent,
        course.solubility_per_solvent,
        course.solute_per_solvent / course.solubility_per_solvent - 1.0,
        course.crystals,
        exchange * (T_j - T),
        float(jnp.max(T - T_j)),
        float(jnp.max(wall_undercooling(solubility, course.solute_per_solvent, wall, course.solvent))),
        mass_mean(course),
        nuclei_share(course, seeds),
        yield_of(course, solute_per_solvent, solute_fraction_of_crystal),
        error,
    )


class VacuumCourse(NamedTuple):
    """A batch that boils under falling pressure, per kg of solvent charged, with its product."""

    time: Annotated[Time, Series("points")]
    temperature: Annotated[Temperature, Series("points")]
    solute_per_solvent: Annotated[MassRatio, Series("points")]
    solubility_per_solvent: Annotated[MassRatio, Series("points")]
    relative_supersaturation: Annotated[Number, Series("points")]
    crystals_per_solvent: Annotated[MassRatio, Series("points")]
    evaporated_fraction: Annotated[Fraction, Series("points")]
    mean_diameter: Length
    nuclei_mass_fraction: Ratio
    yield_fraction: Ratio
    step_error: Ratio


@procedure(
    source="mullin2001, ch. 8 and 9",
    title="Batch cooled by boiling under vacuum",
    typical={"duration": (3600.0, 7200.0)},
)
def vacuum_batch(
    solute_per_solvent: MassRatio,
    solubility: Solubility,
    growth: Growth,
    temperature_program: Program,
    duration: Time,
    crystal_density: Density,
    specific_heat_capacity: HeatCapacity = 3500.0,
    specific_heat_capacity_crystal: HeatCapacity = 1000.0,
    heat_released_per_crystal: SpecificEnergy = 0.0,
    heat_of_vaporization: SpecificEnergy = 2.4e6,
    nucleation: Nucleation = NoNucleation(),
    seed_mass_per_solvent: MassRatio = 0.0,
    seed_size: Length = 100e-6,
    seed_width: Distance = 0.0,
    volume_shape_factor: PositiveNumber = 1.0,
    solute_fraction_of_crystal: Fraction = 1.0,
    liquid_density: Density = 1000.0,
    steps: Steps = 400,
) -> VacuumCourse:
    """Temperature, concentration, crystals and evaporation of a batch cooled by boiling: the pressure sets
    the temperature, the heat balance the vapor.

    Sensible heat and heat of crystallization evaporate solvent; no wall is colder than the suspension.

    >>> out = vacuum_batch(
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
    ...     steps=100,
    ... )
    >>> round(float(out.evaporated_fraction[-1]), 3)
    0.009
    """
    check_charge(
        seed_size, seed_width, steps, solute_per_solvent, solubility, along(temperature_program, duration)
    )
    crystal = Crystal(crystal_density, volume_shape_factor, solute_fraction_of_crystal)
    model = Model(solubility, growth, nucleation, crystal, SuspensionVolume(liquid_density))
    seeds = narrow_seeds(seed_size, seed_width, seed_mass_per_solvent, crystal.mass_per_cube)
    heat = HeatData(specific_heat_capacity, specific_heat_capacity_crystal, heat_released_per_crystal)
    operation = Flashing(temperature_program, Constant(heat_of_vaporization), heat)
    course, error = simulated(model, operation, seeds, solute_per_solvent, duration, steps)
    gone = np.asarray(course.solvent[0] - course.solvent)
    return VacuumCourse(
        course.time,
        course.temperature,
        course.solute_per_solvent,
        course.solubility_per_solvent,
        course.solute_per_solvent / course.solubility_per_solvent - 1.0,
        course.crystals,
        np.maximum(gone, 0.0),
        mass_mean(course),
        nuclei_share(course, seeds),
        yield_of(course, solute_per_solvent, solute_fraction_of_crystal),
        error,
    )
