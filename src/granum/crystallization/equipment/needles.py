"""Crystallizers in a line whose crystals have two sizes, length and width.

The size axis of a stream holds the diameter of the sphere of equal volume. A further axis ``aspect_ratio``,
where the mixture has one, holds length over width; crystals then keep their shape from vessel to vessel.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, ClassVar, NamedTuple

import equinox as eqx
import jax.numpy as jnp
import numpy as np

from granum.core import equipment
from granum.core.flags import unsolved
from granum.core.i18n import _
from granum.core.kinds import (
    Concentration,
    Distance,
    GrowthRate,
    Length,
    Mass,
    MassFlow,
    MassRatio,
    NucleationRate,
    Number,
    PositiveNumber,
    Power,
    Ratio,
    RotationSpeed,
    SpecificPower,
    Time,
    Velocity,
    Volume,
)
from granum.crystallization.equipment.batch import (
    STEPS,
    TRICKLE,
    BatchOutlets,
    BatchVessel,
    present,
    thermal,
)
from granum.crystallization.equipment.beside import heard_beside, keeps_solvent, solubility_beside
from granum.crystallization.equipment.in_time import Crystallized
from granum.crystallization.equipment.msmpr import Evaporative
from granum.crystallization.equipment.roles import (
    Roles,
    crystal_of,
    feed_of,
    roles,
    suspension_left,
    with_crystals,
)
from granum.crystallization.equipment.stirring import SUSPENDED, Stirred
from granum.crystallization.inside_charts import drawn_course
from granum.crystallization.kinds import Growth, Nucleation, Program, Solubility
from granum.crystallization.population.lagrangian import Model, SuspensionVolume
from granum.crystallization.population.needles import Lines, Segments, prisms
from granum.crystallization.population.packets import Seeds, mean_power
from granum.crystallization.vessels.batch import narrow_seeds
from granum.crystallization.vessels.needles import (
    NeedleMarch,
    Needles,
    SteadyNeedles,
    habit,
    march_needles,
    nuclei_share,
    steady_needles,
)
from granum.numerics.smooth import safe_divide
from granum.streams.mixture import Mixture
from granum.streams.stream import Stream, median_of
from granum.streams.units import Limits, Operated, Unit, Utilities
from granum.streams.utilities import COOLED, HEATED, STIRRED

AXIS = "aspect_ratio"
UNDERSATURATED = 0.99  # of the solubility, below which needles dissolve beyond what a curve is known to
DISSOLVES = (
    "The needles would dissolve: during the batch the liquor holds less than 99 % of what saturates it. Give "
    "a feed with more dissolved, or a program that starts and stays colder."
)


def _axis(mixture: Mixture) -> tuple[int, np.ndarray]:
    """Position of the aspect ratio among the axes of a solid without its species, and its boundaries; 0 where
    there is none.
    """
    for position, (name, edges) in enumerate(mixture.axes):
        if name == AXIS:
            return position + 1, np.asarray(edges)
    return 0, np.array([0.0, np.inf])


def _entering(feed: Stream, found: Roles, aspect_ratio: Any, volume_shape_factor: Any) -> Segments:
    """Crystals of the feed by number per second: of the aspect ratios of its axis, or of one."""
    mixture = feed.mixture
    low, high = jnp.asarray(mixture.edges[:-1]), jnp.asarray(mixture.edges[1:])
    density = mixture.densities("solids", feed.temperature)[found.solid]
    solid, ratios = feed.solid[found.solid], jnp.asarray(aspect_ratio, dtype=float)[None]
    position, edges = _axis(mixture)
    others = tuple(i for i in range(1, solid.ndim) if i != position)
    by_class = jnp.sum(solid, axis=others)
    if position:
        ratios = jnp.asarray(np.where(edges[:-1] > 0, np.sqrt(edges[:-1] * edges[1:]), 0.5 * edges[1:]))
    number = by_class.reshape(low.shape[0], -1) / (density * np.pi / 6.0 * mean_power(low, high, 3))[:, None]
    low, high = (jnp.repeat(ends, ratios.shape[0]) for ends in (low, high))
    seeds = Seeds(low, high, number.reshape(-1))
    return prisms(seeds, jnp.tile(ratios, by_class.shape[0]), volume_shape_factor)


def _leaving(feed: Stream, found: Roles, lines: Lines, volume_shape_factor: Any, mass: Any) -> Any:
    """Solid array of the feed with so much mass of these crystals."""
    position, edges = _axis(feed.mixture)
    joint = lines.in_classes(feed.mixture.edges, edges, volume_shape_factor)
    joint = joint * safe_divide(mass, jnp.sum(joint), 0.0)
    by_size = jnp.sum(joint, axis=1)
    solid = with_crystals(feed, found, by_size)
    if not position:
        return solid
    own = solid[found.solid]
    shape = [1] * own.ndim
    shape[0], shape[position] = joint.shape
    share = safe_divide(joint, by_size[:, None], 0.0).reshape(shape)
    return solid.at[found.solid].set(jnp.sum(own, axis=position, keepdims=True) * share)


class NeedleBatchFigures(NamedTuple):
    """Figures of a batch crystallizer of needles."""

    crystal_flow: MassFlow
    yield_fraction: Ratio
    magma_density: Concentration
    relative_supersaturation_maximum: Number
    mean_length: Distance
    mean_width: Distance
    aspect_ratio: Ratio
    aspect_ratio_deviation: Ratio
    mass_median_size: Distance
    nuclei_mass_fraction: Ratio
    seed_mass: Mass
    volume: Volume
    heat_duty: Power
    rotation_speed_suspension: RotationSpeed
    tip_speed: Velocity
    specific_power_input: SpecificPower


class GrownNeedles(NamedTuple):
    """The batch of one second of feed, which species plays which part, the seed held back and the number of
    classes of seeds.
    """

    course: NeedleMarch
    found: Roles
    held: Any
    seeds: int


@equipment(
    "needle_batch_crystallizer",
    source="ma2002; puel2003; gunawan2004",
    title="Seeded batch crystallizer of needles (length and width)",
    equation=r"\frac{\partial n}{\partial t} + G_L\,\frac{\partial n}{\partial L} + "
    r"G_W\,\frac{\partial n}{\partial W} = B\,\delta(L)\,\delta(W)",
)
class NeedleBatchCrystallizer(Stirred, Unit):
    """Cooling batch, in cycles of batch and dead time, of crystals whose length and width grow at rates of
    their own; outlets are means over the cycle.

    Crystals are prisms of volume k_v L W². Sizes, those of the seeds included, are diameters of the sphere of
    equal volume. Where the mixture has an axis ``aspect_ratio``, crystals of the feed have the ratios it says
    and the product is spread over it; otherwise seeds and crystals of the feed have one ratio. Means and the
    standard deviation of the ratio are by mass. A share of the product is held back as seed, as in
    ``batch_crystallizer``. How needles shrink is not known: seeds that would dissolve are refused.
    """

    temperature_program: Program
    solubility: Solubility = eqx.field(kw_only=True)
    growth: Growth = eqx.field(kw_only=True)
    growth_width: Growth = eqx.field(kw_only=True)
    nucleation: Nucleation = eqx.field(kw_only=True)
    duration: Time = eqx.field(kw_only=True)
    dead_time: Time = eqx.field(kw_only=True, default=3600.0)
    seed_mass_per_solvent: MassRatio = eqx.field(kw_only=True, default=0.0)
    seed_size: Length = eqx.field(kw_only=True, default=100e-6)
    seed_width: Distance = eqx.field(kw_only=True, default=0.0)
    seed_aspect_ratio: PositiveNumber = eqx.field(kw_only=True, default=3.0)
    volume_shape_factor: PositiveNumber = eqx.field(kw_only=True, default=1.0)
    solid: str = eqx.field(kw_only=True, static=True, default="")
    solvent: str = eqx.field(kw_only=True, static=True, default="")

    limits: ClassVar[Limits] = BatchVessel.limits | SUSPENDED
    utilities: ClassVar[Utilities] = STIRRED | HEATED | COOLED
    known_axes: ClassVar[tuple[str, ...]] = (AXIS,)

    @property
    def cycle(self) -> Any:
        """Time from charge to charge, s."""
        return self.duration + self.dead_time

    def inside(self, feed: Stream) -> GrownNeedles:
        found = roles(feed.mixture, self.solid, self.solvent)
        crystal = crystal_of(feed.mixture, found, feed.temperature, self.volume_shape_factor)
        volume = SuspensionVolume(feed.liquid_density)
        same = feed.liquid[found.solvent] if keeps_solvent(found) else None
        soluble = solubility_beside(self.solubility, feed.mixture, found, feed.liquid, solvent=same)
        needles = Needles(
            Model(
                soluble,
                self.growth,
                self.nucleation,
                crystal,
                volume,
            ),
            self.growth_width,
        )
        solvent = feed.liquid[found.solvent]
        held = self.seed_mass_per_solvent * solvent
        sphere = crystal.density * np.pi / 6.0
        given = (self.seed_aspect_ratio, self.volume_shape_factor)
        added = prisms(narrow_seeds(self.seed_size, self.seed_width, held, sphere), *given)
        fed = _entering(feed, found, *given)
        names = ("length", "width", "longer", "wider", "number")
        seeds = Segments(*(jnp.concatenate([getattr(s, n) for s in (added, fed)]) for n in names))
        course = march_needles(
            needles,
            seeds,
            self.temperature_program,
            feed.liquid[found.solute],
            jnp.where(solvent > 0, solvent, TRICKLE),
            jnp.linspace(0.0, self.duration, STEPS + 1),
        )
        # once more where its flags are heard: inside what is compiled they are lost
        self.solubility(course.temperature)
        free = feed.liquid[found.solvent] - (1.0 - found.solute_fraction) * course.crystals
        there = course.temperature, course.solute_per_solvent, free
        heard_beside(self.solubility, feed.mixture, found, feed.liquid, there, type(self).card)
        here = course.solute_per_solvent > UNDERSATURATED * course.solubility_per_solvent
        unsolved(jnp.all(here | (course.crystals <= 0.0)), type(self).card, reason=DISSOLVES)
        return GrownNeedles(course, found, held, seeds.number.shape[0])

    def charts(self, made: Operated, inlets: Mapping[str, Stream]) -> dict[str, Any]:
        if not float(inlets["feed"].liquid_flow) > 0.0:
            return {}
        return drawn_course(made.inside.course, _("The batch over time"))

    def outlets(self, inside: GrownNeedles, feed: Stream) -> BatchOutlets:
        course, found = inside.course, inside.found
        left = jnp.maximum(course.crystals[-1] - inside.held, 0.0)
        solid = _leaving(feed, found, course.final, self.volume_shape_factor, left)
        product = suspension_left(feed, found, solid, 0.0, course.temperature[-1])
        return BatchOutlets(product, product.enthalpy_flow - feed.enthalpy_flow)

    def figures(self, inside: GrownNeedles, outlets: BatchOutlets, feed: Stream) -> NeedleBatchFigures:
        course, found, product = inside.course, inside.found, outlets.product
        entering = feed_of(feed, found)
        made, x = product.solid_by_species[found.solid], found.solute_fraction
        volume = product.slurry_volume_flow * self.cycle
        return NeedleBatchFigures(
            made,
            safe_divide(x * made, entering.solute + x * jnp.sum(entering.crystals)),
            safe_divide(made, product.slurry_volume_flow),
            jnp.max(course.solute_per_solvent / course.solubility_per_solvent) - 1.0,
            *habit(course.moments[-1]),
            median_of(feed_of(product, found).crystals, feed.mixture.edges),
            nuclei_share(course.final, inside.seeds),
            inside.held * self.cycle,
            volume,
            outlets.heat_duty,
            *self.stirrer_figures(product, volume),
        )

    def measured(
        self, inside: GrownNeedles, outlets: BatchOutlets, figures: NeedleBatchFigures, feed: Stream
    ) -> dict[str, Any]:
        product = outlets.product
        return {
            "crowded": product.solids_volume_fraction,
            "highest": figures.relative_supersaturation_maximum,
            "largest": product.size_fractions[-1],
            "present": present(inside.course),
        } | self.stirrer_measured(product, figures.volume)

    def drawn(
        self, inside: GrownNeedles, outlets: BatchOutlets, figures: NeedleBatchFigures, feed: Stream
    ) -> dict[str, Any]:
        stirrer = self.stirrer_power(outlets.product, figures.volume)
        return thermal(outlets.heat_duty, feed, outlets.product) | stirrer


class NeedleFigures(NamedTuple):
    """Figures of a continuous crystallizer of needles."""

    crystal_flow: MassFlow
    yield_fraction: Number
    magma_density: Concentration
    relative_supersaturation: Number
    growth_rate: GrowthRate
    growth_rate_width: GrowthRate
    nucleation_rate: NucleationRate
    residence_time: Time
    mean_length: Distance
    mean_width: Distance
    aspect_ratio: Ratio
    aspect_ratio_deviation: Ratio
    mass_median_size: Distance
    evaporation: MassFlow
    heat_duty: Power
    rotation_speed_suspension: RotationSpeed
    tip_speed: Velocity
    specific_power_input: SpecificPower


@equipment(
    "needle_crystallizer",
    source="puel2003; randolph1988, ch. 4",
    title="Continuous crystallizer of needles (length and width)",
    equation=r"G_L\,\frac{\partial n}{\partial L} + G_W\,\frac{\partial n}{\partial W} = -\frac{n}{\tau},"
    r"\quad M_T = 6 k_v \rho_c B_0\,G_L G_W^2\,\tau^4",
)
class NeedleCrystallizer(Evaporative):
    """Continuous crystallizer with mixed suspension and mixed product removal of crystals whose length and
    width grow at rates of their own.

    Crystals are prisms of volume k_v L W²; sizes are diameters of the sphere of equal volume. All crystals
    born in the vessel have one aspect ratio, that of the two growth rates: the spread is that of crystals
    which come with the feed, whose ratios an axis ``aspect_ratio`` of the mixture says, or
    ``seed_aspect_ratio``. Means and the standard deviation of the ratio are by mass. Crystals that enter with
    an undersaturated liquor dissolve, all shapes alike, until it is saturated or they are gone.
    """

    growth_width: Growth = eqx.field(kw_only=True)
    seed_aspect_ratio: PositiveNumber = eqx.field(kw_only=True, default=3.0)

    known_axes: ClassVar[tuple[str, ...]] = (AXIS,)

    def _steady(
        self, feed: Stream, found: Roles, temperature: Any, given_off: tuple[Any, Any]
    ) -> SteadyNeedles:
        T, (evaporation, _per_crystal) = temperature, given_off
        crystal = crystal_of(feed.mixture, found, T, self.volume_shape_factor)
        left = feed.liquid[found.solvent] - evaporation if keeps_solvent(found) else None
        soluble = solubility_beside(self.solubility, feed.mixture, found, feed.liquid, T, left)
        needles = Needles(
            Model(
                soluble,
                self.growth,
                self.nucleation,
                crystal,
                None,
                nucleus_size=self.nucleus_size,
            ),
            self.growth_width,
        )
        entering = _entering(feed, found, self.seed_aspect_ratio, self.volume_shape_factor)
        liquor = self._liquor(feed, found, T)
        return steady_needles(needles, feed_of(feed, found), entering, T, self.volume, liquor, evaporation)

    def _solid(self, feed: Stream, found: Roles, state: SteadyNeedles) -> Any:
        return _leaving(feed, found, state.crystals, self.volume_shape_factor, state.product)

    def figures(
        self, inside: tuple[SteadyNeedles, Roles], outlets: Crystallized, feed: Stream
    ) -> NeedleFigures:
        state, found = inside
        entering, x = feed_of(feed, found), found.solute_fraction
        product = outlets.product
        return NeedleFigures(
            state.product,
            safe_divide(x * state.product, entering.solute + x * jnp.sum(entering.crystals)),
            state.magma_density,
            state.solute_per_solvent / state.solubility_per_solvent - 1.0,
            state.rates[0],
            state.rates[1],
            state.nucleation_rate,
            state.residence_time,
            *habit(state.crystals.moments()),
            median_of(feed_of(product, found).crystals, feed.mixture.edges),
            state.evaporation,
            outlets.heat_duty,
            *self.stirrer_figures(product, self.volume),
        )
