"""A batch crystallizer in a line: its mean flows over the cycle."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Annotated, Any, NamedTuple

import equinox as eqx
import jax.numpy as jnp

from granum.core import equipment
from granum.core.kinds import (
    Concentration,
    Distance,
    Law,
    Length,
    Mass,
    MassFlow,
    MassRatio,
    Number,
    PositiveNumber,
    Power,
    Ratio,
    Time,
    Volume,
)
from granum.crystallization.equipment.roles import Roles, crystal_of, feed_of, roles, with_crystals
from granum.crystallization.population.lagrangian import Course, Model, SuspensionVolume, march
from granum.crystallization.population.operations import Programmed
from granum.crystallization.population.packets import Seeds
from granum.crystallization.vessels.batch import narrow_seeds
from granum.streams.stream import Stream
from granum.streams.units import Check, Unit

STEPS = 300


class BatchOutlets(NamedTuple):
    """Suspension and heat taken up, as means over the cycle."""

    product: Stream
    heat_duty: Any


class BatchFigures(NamedTuple):
    """Figures of a batch crystallizer."""

    crystal_flow: MassFlow
    yield_fraction: Ratio
    magma_density: Concentration
    relative_supersaturation_maximum: Number
    mean_diameter: Distance
    seed_mass: Mass
    volume: Volume
    heat_duty: Power


@equipment("batch_crystallizer", source="mullin2001, ch. 9; miller1994", title="Seeded batch crystallizer",
           equation=r"\dot m = m_{batch} / (t_f + t_{dead})")  # fmt: skip
class BatchCrystallizer(Unit):
    """Cooling batch that treats a continuous feed in cycles of batch and dead time; outlets are means over the cycle.

    Crystals that come with the feed are the seeds, together with ``seed_mass_per_solvent`` of a sieve cut, which is taken from the product
    (a share of the crystals is held back for the next batch, so that the line balances). The duty is the mean one; its peak is larger.
    """

    temperature_program: Annotated[Any, Law("program")]
    duration: Time
    solubility: Annotated[Any, Law("solubility_law")]
    growth: Annotated[Any, Law("growth_rate")]
    nucleation: Annotated[Any, Law("nucleation_rate")]
    dead_time: Time = 3600.0
    seed_mass_per_solvent: MassRatio = 0.0
    seed_size: Length = 100e-6
    seed_width: Distance = 0.0
    volume_shape_factor: PositiveNumber = 1.0
    solid: str = eqx.field(static=True, default="")
    solvent: str = eqx.field(static=True, default="")

    def _course(self, feed: Stream) -> tuple[Course, Roles]:
        found = roles(feed.mixture, self.solid, self.solvent)
        entering = feed_of(feed, found)
        T = self.temperature_program(self.duration)
        crystal = crystal_of(feed.mixture, found, T, self.volume_shape_factor)
        model = Model(self.solubility, self.growth, self.nucleation, crystal, SuspensionVolume(feed.replace(temperature=T).liquid_density))
        added = narrow_seeds(self.seed_size, self.seed_width, self.seed_mass_per_solvent * entering.solvent, crystal.mass_per_cube)
        own = Seeds.of_mass(1.0, feed.mixture.edges, jnp.ones(len(feed.mixture.edges) - 1), crystal.mass_per_cube)
        low, high = own.low, own.high
        number = entering.crystals / (crystal.mass_per_cube * 0.25 * (low + high) * (low**2 + high**2))
        seeds = Seeds(jnp.concatenate([added.low, low]), jnp.concatenate([added.high, high]), jnp.concatenate([added.number, number]))
        times = jnp.linspace(0.0, self.duration, STEPS + 1)
        # One second of feed stands for the batch: everything is proportional to it.
        return march(model, Programmed(self.temperature_program), seeds, entering.solute, entering.solvent, times), found

    def __call__(self, feed: Stream) -> BatchOutlets:
        course, found = self._course(feed)
        T = course.temperature[-1]
        crystal = crystal_of(feed.mixture, found, T, self.volume_shape_factor)
        x = found.solute_fraction
        seeded = self.seed_mass_per_solvent * feed.liquid[found.solvent]
        grown = course.crystals[-1]
        kept = jnp.maximum(grown - seeded, 0.0)
        classes = course.final.in_classes(feed.mixture.edges) * crystal.mass_per_cube
        classes = classes * jnp.where(grown > 0, kept / jnp.where(grown > 0, grown, 1.0), 0.0)
        solute = feed.liquid[found.solute] + x * (jnp.sum(feed_of(feed, found).crystals) - kept)
        solvent = feed.liquid[found.solvent] + (1.0 - x) * (jnp.sum(feed_of(feed, found).crystals) - kept)
        liquid = feed.liquid.at[found.solute].set(solute).at[found.solvent].set(solvent)
        product = feed.replace(solid=with_crystals(feed, found, classes), liquid=liquid, temperature=T)
        return BatchOutlets(product, product.enthalpy_flow - feed.enthalpy_flow)

    def results(self, inlets: Mapping[str, Stream], outlets: BatchOutlets) -> BatchFigures:
        feed = inlets["feed"]
        course, found = self._course(feed)
        entering = feed_of(feed, found)
        cycle = self.duration + self.dead_time
        made = outlets.product.solid_by_species[found.solid]
        fed = entering.solute + found.solute_fraction * jnp.sum(entering.crystals)
        flow = outlets.product.slurry_volume_flow
        return BatchFigures(
            made, found.solute_fraction * made / fed, made / flow, jnp.max(course.solute_per_solvent / course.solubility_per_solvent) - 1.0,
            course.final.mean_size(4, 3), self.seed_mass_per_solvent * entering.solvent * cycle, flow * cycle, outlets.heat_duty,
        )  # fmt: skip

    def checks(self, inlets: Mapping[str, Stream], outlets: BatchOutlets) -> tuple[Check, ...]:
        figures = self.results(inlets, outlets)
        return (
            Check(
                "solids in the suspension by volume",
                outlets.product.solids_volume_fraction,
                0.0,
                0.35,
                "dimensionless",
                "mullin2001, ch. 9",
            ),
            Check(
                "highest relative supersaturation",
                figures.relative_supersaturation_maximum,
                0.0,
                0.5,
                "dimensionless",
                "mullin2001, ch. 5",
            ),
        )
