"""Precipitation by reaction: one reagent is run into the other, and a sparingly soluble salt falls out."""

from __future__ import annotations

from typing import Annotated, Any, NamedTuple

import jax.numpy as jnp
import numpy as np

from granum.core import procedure
from granum.core.kinds import (
    Density,
    Length,
    MassRatio,
    Molality,
    MolarMass,
    NumberPerMass,
    PositiveNumber,
    Ratio,
    Series,
    Temperature,
    Time,
)
from granum.crystallization.kinds import Growth, Nucleation, Program, Steps
from granum.crystallization.population.lagrangian import Equilibrium, Model, SuspensionVolume
from granum.crystallization.population.operations import Operation
from granum.crystallization.population.packets import Seeds
from granum.crystallization.vessels.batch import mass_mean, narrow_seeds, simulated
from granum.crystallization.vessels.crystals import Crystal
from granum.materials.formulas.precipitation import (
    activity_coefficient_davies,
    hydroxide_molality,
    ionization_exponent_water,
)
from granum.materials.library import salt as material_salt
from granum.materials.salts import Salt
from granum.numerics.smooth import safe_power

LARGEST_STRENGTH = 0.5  # mol/kg, up to which Davies' equation holds; beyond it the coefficients are kept
TRACE = 1e-30  # mol/kg, of an ion that is not there


class Ions(NamedTuple):
    """Contents of a precipitator; both ions as the salt that they could form (kg), those in crystals
    included.

    spectators: sum of amount times charge squared of the ions that do not precipitate, mol.
    """

    temperature: Any
    solute: Any
    solvent: Any
    antisolvent: Any
    partner: Any
    spectators: Any


class SaltEquilibrium(Equilibrium):
    """Supersaturation of a salt on ion activities (Davies): ``(IAP/Ksp)^(1/ν)`` is the ratio of the two
    measures.
    """

    salt: Salt
    molar_mass: Any

    def molalities(self, contents: Ions, crystals: Any) -> tuple[Any, Any]:
        """Free cation and anion, mol per kg of water."""
        amounts = ((contents.solute, self.salt.cation_count), (contents.partner, self.salt.anion_count))
        cation, anion = (
            count * jnp.maximum(mass - crystals, 0.0) / self.molar_mass / contents.solvent
            for mass, count in amounts
        )
        return cation, anion

    def free_anion(self, anion: Any, coefficient: Any, temperature: Any) -> Any:
        """What of the anion is free, mol/kg, where its activity coefficient is this."""
        return anion

    def activities(self, contents: Ions, crystals: Any) -> tuple[Any, Any]:
        """Of cation and anion, mol/kg."""
        s, T = self.salt, contents.temperature
        cation, anion = self.molalities(contents, crystals)
        charges = (
            cation * s.cation_charge**2 + anion * s.anion_charge**2 + contents.spectators / contents.solvent
        )
        strength = jnp.minimum(0.5 * charges, LARGEST_STRENGTH)
        one, other = (
            activity_coefficient_davies.function(z, strength, T) for z in (s.cation_charge, s.anion_charge)
        )
        free = self.free_anion(anion, other, T)
        return one * jnp.maximum(cation, TRACE), other * jnp.maximum(free, TRACE)

    def ratio(self, contents: Ions, crystals: Any) -> Any:
        s = self.salt
        cation, anion = (jnp.log(a) for a in self.activities(contents, crystals))
        return self.molar_mass * jnp.exp((s.cation_count * cation + s.anion_count * anion) / s.ion_count)

    def saturated(self, contents: Ions) -> Any:
        return (
            self.molar_mass
            * safe_power(self.salt.product_at(contents.temperature), 1.0 / self.salt.ion_count)
            + 0.0 * contents.solvent
        )


class HydroxideEquilibrium(SaltEquilibrium):
    """The same of a hydroxide, with the ions of water itself: what the other ions leave to be balanced is
    hydroxide less hydrogen.
    """

    def free_anion(self, anion: Any, coefficient: Any, temperature: Any) -> Any:
        return hydroxide_molality(anion, coefficient, temperature)

    def ph_value(self, contents: Ions) -> Any:
        _cation, hydroxide = self.activities(contents, 0.0)
        return ionization_exponent_water.function(contents.temperature) + jnp.log10(hydroxide)


class ReagentAddition(Operation):
    """Semibatch at one temperature: a solution of the anion runs into a solution of the cation.

    Parameters
    ----------
    dissolved: cation at the start, as kg of salt. added: kg of water that the reagent has brought, of time.
    per_water: anion brought per kg of that water, as kg of salt. spectators: of the vessel at the start
        (mol), and per kg of water added.
    """

    temperature: Any
    dissolved: Any
    added: Any
    per_water: Any
    spectators: Any
    spectators_per_water: Any

    def start(self, solute: Any, solvent: Any) -> Any:
        seed = solute - self.dissolved
        return Ions(
            jnp.asarray(self.temperature, dtype=float), solute, solvent, jnp.zeros(()), seed, self.spectators
        )

    def step(self, old: Any, start: Any, end: Any, crystals_before: Any, crystals: Any) -> Any:
        water = self.added(end) - self.added(start)
        return Ions(
            old.temperature,
            old.solute,
            old.solvent + water,
            old.antisolvent,
            old.partner + self.per_water * water,
            old.spectators + self.spectators_per_water * water,
        )


class PrecipitationCourse(NamedTuple):
    """A precipitation over time, per kg of water at the start, with its product."""

    time: Annotated[Time, Series("points")]
    supersaturation_ratio: Annotated[Ratio, Series("points")]
    cation_molality: Annotated[Molality, Series("points")]
    anion_molality: Annotated[Molality, Series("points")]
    crystals_per_solvent: Annotated[MassRatio, Series("points")]
    crystals_number: Annotated[NumberPerMass, Series("points")]
    mean_diameter: Length
    yield_fraction: Ratio
    step_error: Ratio


@procedure(
    source="mullin2001, ch. 8; davies1962, ch. 3",
    title="Precipitation by adding a reagent",
    typical={"duration": (600.0, 3600.0)},
)
def precipitation_batch(
    cation_molality: Molality,
    anion_molality: Molality,
    reagent_program: Program,
    growth: Growth,
    nucleation: Nucleation,
    duration: Time,
    crystal_density: Density,
    molar_mass: MolarMass,
    salt: str,
    spectator_charge: PositiveNumber = 1.0,
    seed_mass_per_solvent: MassRatio = 0.0,
    seed_size: Length = 10e-6,
    volume_shape_factor: PositiveNumber = 1.0,
    temperature: Temperature = 298.15,
    steps: Steps = 400,
) -> PrecipitationCourse:
    """Supersaturation, ions and crystals of a stirred vessel into which the reagent with the anion is run,
    mixing being perfect.

    Supersaturation is on ion activities against the solubility product at the temperature; the growth and
    nucleation laws take its ratio. The program gives the water brought with the reagent per kg of water in
    the vessel; the counter-ions stay dissolved and count in the ionic strength. Molalities are in mol per kg
    of water.
    Where mixing is slower than nucleation the crystals become more and smaller than this.

    >>> out = precipitation_batch(
    ...     cation_molality=0.01,
    ...     anion_molality=0.1,
    ...     duration="20 min",
    ...     crystal_density=4500,
    ...     molar_mass=0.2334,
    ...     salt="barium sulfate",
    ...     reagent_program={"law": "constant_flow", "mass_flow": 0.1 / 1200},
    ...     growth={"law": "power_law_growth", "growth_coefficient": 4e-11, "growth_order": 2},
    ...     nucleation={
    ...         "law": "secondary_nucleation",
    ...         "nucleation_coefficient": 1e7,
    ...         "nucleation_order": 2,
    ...         "magma_order": 0,
    ...     },
    ...     steps=100,
    ... )
    >>> 0.95 < out.yield_fraction <= 1.0
    True
    """
    found = material_salt(salt)
    M = molar_mass
    dissolved, per_water = cation_molality * M / found.cation_count, anion_molality * M / found.anion_count
    # Electroneutrality: the counter-ions carry the charge of the ions they came with.
    extra = (
        cation_molality * abs(found.cation_charge) * spectator_charge,
        anion_molality * abs(found.anion_charge) * spectator_charge,
    )
    operation = ReagentAddition(temperature, dissolved, reagent_program, per_water, *extra)
    crystal = Crystal(crystal_density, volume_shape_factor)
    equilibrium = SaltEquilibrium(found, M)
    model = Model(equilibrium, growth, nucleation, crystal, SuspensionVolume(1000.0))
    seeds: Seeds = narrow_seeds(seed_size, 0.2 * seed_size, seed_mass_per_solvent, crystal.mass_per_cube)
    course, error = simulated(model, operation, seeds, dissolved, duration, steps)
    water = np.asarray([float(reagent_program(t)) for t in np.asarray(course.time)])
    ions = Ions(temperature, course.solute, 1.0 + water, 0.0, seed_mass_per_solvent + per_water * water, 0.0)
    cation, anion = equilibrium.molalities(ions, course.crystals)
    limiting = np.minimum(dissolved, per_water * water[-1])
    return PrecipitationCourse(
        course.time,
        course.solute_per_solvent / course.solubility_per_solvent,
        cation,
        anion,
        course.crystals,
        course.moments[:, 0],
        mass_mean(course),
        float((course.crystals[-1] - course.crystals[0]) / limiting),
        error,
    )
