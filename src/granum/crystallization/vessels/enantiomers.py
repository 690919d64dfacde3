"""Resolution of a conglomerate: seeded with one enantiomer, a liquor supersaturated in both gives that one,
until the other is born.
"""

from __future__ import annotations

from typing import Annotated, Any, NamedTuple

import jax.numpy as jnp
import numpy as np

from granum.core import procedure
from granum.core.kinds import (
    Density,
    Distance,
    Fraction,
    Length,
    MassRatio,
    Number,
    PositiveNumber,
    Ratio,
    Series,
    Temperature,
    Time,
    Within,
)
from granum.crystallization.formulas.enantiomers import salting
from granum.crystallization.formulas.nucleation import NoNucleation
from granum.crystallization.kinds import (
    Dissolution,
    Growth,
    Nucleation,
    Program,
    RacemateSolubilityRatio,
    Solubility,
    Steps,
)
from granum.crystallization.population.packets import Seeds
from granum.crystallization.population.rivals import Form, Rivals, Row, State, compete, halved
from granum.crystallization.vessels.batch import along, check_charge, narrow_seeds
from granum.crystallization.vessels.crystals import Crystal

Purity = Annotated[Fraction, Within(0.5, 1.0)]
SCANTY = 1e-12  # kg of crystals per kg of solvent, which are none


class ResolutionCourse(NamedTuple):
    """A batch seeded with one enantiomer over time, per kg of solvent, and how long its crystals are pure."""

    time: Annotated[Time, Series("points")]
    temperature: Annotated[Temperature, Series("points")]
    solute_per_solvent: Annotated[MassRatio, Series("points")]
    solute_per_solvent_other: Annotated[MassRatio, Series("points")]
    solubility_per_solvent: Annotated[MassRatio, Series("points")]
    solubility_per_solvent_other: Annotated[MassRatio, Series("points")]
    crystals_per_solvent: Annotated[MassRatio, Series("points")]
    crystals_other: Annotated[MassRatio, Series("points")]
    enantiomer_fraction: Annotated[Fraction, Series("points")]
    enantiomeric_excess: Annotated[Number, Series("points")]
    time_pure: Time
    crop_time_pure: Number
    enantiomer_fraction_end: Fraction
    mean_diameter: Distance
    mean_diameter_other: Distance
    step_error: Ratio


class Resolution(NamedTuple):
    """What two enantiomers do in one vessel, both by one law."""

    solubility: Any
    growth: Any
    nucleation: Any
    dissolution: Any
    crystal: Crystal
    liquid_density: Any
    racemate_solubility_ratio: Any
    counter_nucleation: Any

    def rivals(self) -> Rivals:
        """Both populations, each with a solute of its own."""
        form = Form(
            self.solubility,
            self.growth,
            self.nucleation,
            self.dissolution,
            self.crystal,
            salting(self.racemate_solubility_ratio),
        )
        share = self.counter_nucleation
        return Rivals((form, form), self.liquid_density, (share, share), (0, 1))

    def run(self, seeds: tuple[Seeds, Seeds], program: Any, ratios: Any, times: Any) -> tuple[State, Row]:
        """The batch of one kg of solvent."""
        return compete(self.rivals(), seeds, program, ratios, times)


def pure_share(masses: Any) -> Any:
    """Share of the wanted enantiomer in the crystals; 1 where there are none."""
    every = jnp.sum(masses, axis=-1)
    some = every > SCANTY
    return jnp.where(some, masses[..., 0] / jnp.where(some, every, 1.0), 1.0)


def excess(ratios: Any) -> Any:
    """Enantiomeric excess of a liquor; none where nothing is dissolved."""
    both = jnp.sum(ratios, axis=-1)
    some = both > 0.0
    return jnp.where(some, (ratios[..., 0] - ratios[..., 1]) / jnp.where(some, both, 1.0), 0.0)


def pure_until(times: Any, share: Any, least: Any) -> Any:
    """Time at which the purity of the crystals first falls below the least one, between the steps."""
    below = share < least
    first = jnp.argmax(below)
    before = jnp.maximum(first - 1, 0)
    fall = share[before] - share[first]
    part = jnp.where(fall > 0.0, (share[before] - least) / jnp.where(fall > 0.0, fall, 1.0), 0.0)
    crossing = times[before] + jnp.clip(part, 0.0, 1.0) * (times[first] - times[before])
    return jnp.where(jnp.any(below), crossing, times[-1])


@procedure(
    source="elsner2005; angelov2008; jacques1981, ch. 4",
    title="Preferential crystallization of an enantiomer",
    typical={"duration": (3600.0, 36000.0)},
)
def preferential_crystallization(
    solute_per_solvent: MassRatio,
    solute_per_solvent_other: MassRatio,
    solubility: Solubility,
    growth: Growth,
    temperature_program: Program,
    duration: Time,
    crystal_density: Density,
    nucleation: Nucleation = NoNucleation(),
    counter_nucleation: Ratio = 0.0,
    dissolution: Dissolution | None = None,
    racemate_solubility_ratio: RacemateSolubilityRatio = 2.0,
    seed_mass_per_solvent: MassRatio = 0.0,
    seed_size: Length = 100e-6,
    seed_width: Distance = 0.0,
    enantiomer_fraction_least: Purity = 0.99,
    volume_shape_factor: PositiveNumber = 1.0,
    liquid_density: Density = 1000.0,
    steps: Steps = 400,
) -> ResolutionCourse:
    """Both enantiomers of a conglomerate over time, in a liquor that is seeded with one: how pure its
    crystals are, and until when.

    Mirror images have one solubility, one law of growth and one of nucleation. The other enantiomer has no
    seeds; it is born where its nucleation law says so: as a primary nucleation, or on the crystals of the
    first, of which a share counts as its own magma. Without a law of dissolution crystals keep. The crop is
    what has grown beside the seeds when purity falls below the least one.

    >>> out = preferential_crystallization(
    ...     solute_per_solvent=0.125,
    ...     solute_per_solvent_other=0.125,
    ...     solubility={"law": "polynomial_solubility", "coefficients": [0.11]},
    ...     growth={"law": "power_law_growth", "growth_coefficient": 3e-7, "growth_order": 1.0},
    ...     nucleation={
    ...         "law": "secondary_nucleation",
    ...         "nucleation_coefficient": 1e8,
    ...         "nucleation_order": 2.0,
    ...         "magma_order": 0.0,
    ...     },
    ...     temperature_program={
    ...         "law": "power_cooling",
    ...         "temperature_start": 306.15,
    ...         "temperature_end": 306.15,
    ...         "duration": 3600,
    ...     },
    ...     duration="4 hour",
    ...     crystal_density=1461,
    ...     seed_mass_per_solvent="3 g/kg",
    ...     seed_size="250 um",
    ...     steps=100,
    ... )
    >>> bool(out.enantiomer_fraction[20] > out.enantiomer_fraction_end)
    True
    """
    temperatures = along(temperature_program, duration)
    for ratio in (solute_per_solvent, solute_per_solvent_other):
        check_charge(seed_size, seed_width, steps, ratio, solubility, temperatures)
    crystal = Crystal(crystal_density, volume_shape_factor)
    vessel = Resolution(
        solubility,
        growth,
        nucleation,
        dissolution,
        crystal,
        liquid_density,
        racemate_solubility_ratio,
        counter_nucleation,
    )
    seeds = (
        narrow_seeds(seed_size, seed_width, seed_mass_per_solvent, crystal.mass_per_cube),
        narrow_seeds(seed_size, 0.0, 0.0, crystal.mass_per_cube),
    )
    steps += steps % 2
    times = jnp.linspace(0.0, duration, steps + 1)
    ratios = [solute_per_solvent, solute_per_solvent_other]
    fine, coarse = (vessel.run(seeds, temperature_program, ratios, t)[1] for t in (times, halved(times)))
    share = pure_share(fine.masses)
    until = pure_until(times, share, enantiomer_fraction_least)
    grown = jnp.interp(until, times, fine.masses[:, 0]) - seed_mass_per_solvent
    every = max(float(jnp.sum(fine.masses[-1])), 1e-300)
    apart = np.abs(np.asarray(fine.masses[-1] - coarse.masses[-1])).max() / every
    return ResolutionCourse(
        times,
        fine.temperature,
        fine.ratios[:, 0],
        fine.ratios[:, 1],
        fine.saturated[:, 0],
        fine.saturated[:, 1],
        fine.masses[:, 0],
        fine.masses[:, 1],
        share,
        excess(fine.ratios),
        float(until),
        float(grown),
        float(share[-1]),
        float(fine.sizes[-1, 0]),
        float(fine.sizes[-1, 1]),
        float(apart) / 3.0,
    )
