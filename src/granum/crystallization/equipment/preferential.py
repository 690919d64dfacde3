"""A batch crystallizer that parts two enantiomers: seeded with one, it gives that one until the other is
born.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, ClassVar, NamedTuple

import equinox as eqx
import jax.numpy as jnp

from granum.core import equipment
from granum.core.errors import CaseError
from granum.core.i18n import _
from granum.core.kinds import (
    Concentration,
    Distance,
    Fraction,
    Length,
    Mass,
    MassFlow,
    MassRatio,
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
from granum.core.limits import Limit
from granum.crystallization.equipment.batch import STEPS, TRICKLE, BatchOutlets, BatchVessel, thermal
from granum.crystallization.equipment.roles import Roles, crystal_of, feed_of, roles, with_crystals
from granum.crystallization.equipment.stirring import SUSPENDED, Stirred
from granum.crystallization.inside_charts import drawn_resolution
from granum.crystallization.kinds import (
    Dissolution,
    Growth,
    Nucleation,
    Program,
    RacemateSolubilityRatio,
    Solubility,
)
from granum.crystallization.population.packets import Seeds
from granum.crystallization.population.rivals import Row, State
from granum.crystallization.vessels.batch import narrow_seeds
from granum.crystallization.vessels.enantiomers import Purity, Resolution, excess, pure_share, pure_until
from granum.numerics.smooth import safe_divide
from granum.streams.mixture import Mixture
from granum.streams.stream import Stream
from granum.streams.units import Limits, Operated, Unit, Utilities
from granum.streams.utilities import COOLED, HEATED, STIRRED


class ResolutionFigures(NamedTuple):
    """Figures of a crystallizer that parts two enantiomers."""

    crystal_flow: MassFlow
    crystal_flow_other: MassFlow
    enantiomer_fraction_end: Fraction
    yield_fraction: Number
    enantiomeric_excess: Number
    time_pure: Time
    crop_time_pure: Number
    relative_supersaturation_end: Number
    relative_supersaturation_other: Number
    magma_density: Concentration
    mean_diameter: Distance
    mean_diameter_other: Distance
    seed_mass: Mass
    volume: Volume
    heat_duty: Power
    rotation_speed_suspension: RotationSpeed
    tip_speed: Velocity
    specific_power_input: SpecificPower


class Resolved(NamedTuple):
    """The batch of one kg of solvent at its end and over time, the solvent (kg/s), which species play which
    part, and the seed held back per kg of solvent.
    """

    end: State
    course: Row
    times: Any
    solvent: Any
    found: tuple[Roles, Roles]
    held: Any

    @property
    def leaving(self) -> Any:
        """Crystals of both enantiomers beside those held back, kg per kg of solvent, over time."""
        return jnp.maximum(self.course.masses - jnp.stack([self.held, 0.0 * self.held]), 0.0)


@equipment(
    "preferential_crystallizer",
    source="elsner2005; angelov2008; jacques1981, ch. 4",
    title="Batch crystallizer that parts two enantiomers (preferential crystallization)",
    equation=(
        r"\frac{\partial n_i}{\partial t} + G(C_i, C^*_i)\,\frac{\partial n_i}{\partial L} = 0,\quad "
        r"C^*_1 = C^*\,e^{K C_2/C^*}"
    ),
)
class PreferentialCrystallizer(Stirred, Unit):
    """Cooling batch, in cycles of batch and dead time, of a liquor supersaturated in both enantiomers of a
    conglomerate and seeded with one; outlets are means over the cycle.

    Both have one solubility and one kinetics. The wanted crystals are ``solid``, or the first ones; a share
    of them, pure, is held back as their seed, as in ``batch_crystallizer``, and crystals of the feed are
    seeds of what they are. Without a law of dissolution crystals keep. Purity is that of what leaves, without
    the seed; the crop while pure is what has grown beside it, per kg of solvent, when the purity falls below
    the least one: end the batch then. Two such vessels, seeded with one and the other, take each other's
    mother liquor.
    """

    temperature_program: Program
    solubility: Solubility = eqx.field(kw_only=True)
    growth: Growth = eqx.field(kw_only=True)
    nucleation: Nucleation = eqx.field(kw_only=True)
    duration: Time = eqx.field(kw_only=True)
    dead_time: Time = eqx.field(kw_only=True, default=3600.0)
    counter_nucleation: Ratio = eqx.field(kw_only=True, default=0.0)
    racemate_solubility_ratio: RacemateSolubilityRatio = eqx.field(kw_only=True, default=2.0)
    seed_mass_per_solvent: MassRatio = eqx.field(kw_only=True, default=0.0)
    seed_size: Length = eqx.field(kw_only=True, default=100e-6)
    seed_width: Distance = eqx.field(kw_only=True, default=0.0)
    enantiomer_fraction_least: Purity = eqx.field(kw_only=True, default=0.99)
    volume_shape_factor: PositiveNumber = eqx.field(kw_only=True, default=1.0)
    dissolution: Dissolution | None = eqx.field(kw_only=True, default=None)
    solid: str = eqx.field(kw_only=True, static=True, default="")
    other_solid: str = eqx.field(kw_only=True, static=True, default="")
    solvent: str = eqx.field(kw_only=True, static=True, default="")

    limits: ClassVar[Limits] = {
        "crowded": BatchVessel.limits["crowded"],
        "largest": BatchVessel.limits["largest"],
        "present": BatchVessel.limits["present"],
        "pure": Limit(
            "wanted enantiomer in the crystals",
            "enantiomer_fraction_least",
            1.0,
            "dimensionless",
            "jacques1981, ch. 4",
        ),
    } | SUSPENDED
    utilities: ClassVar[Utilities] = STIRRED | HEATED | COOLED

    @property
    def cycle(self) -> Any:
        """Time from charge to charge, s."""
        return self.duration + self.dead_time

    def _roles(self, mixture: Mixture) -> tuple[Roles, Roles]:
        """Species of the wanted and of the other enantiomer."""
        names = [s.name for s in mixture.solids]
        if len(names) < 2:
            raise CaseError(_("The crystals of both enantiomers are needed among the solids."))
        wanted = self.solid or names[0]
        other = self.other_solid or next(name for name in names if name != wanted)
        if other == wanted:
            raise CaseError(_("Both enantiomers are '{name}': name two crystals.").format(name=wanted))
        found = (roles(mixture, wanted, self.solvent), roles(mixture, other, self.solvent))
        for name, role in zip((wanted, other), found, strict=True):
            if role.solute_fraction < 1.0:
                raise CaseError(
                    _("'{name}' binds solvent, which this crystallizer does not follow.").format(name=name)
                )
        return found

    def inside(self, feed: Stream) -> Resolved:
        found = self._roles(feed.mixture)
        crystal = crystal_of(feed.mixture, found[0], feed.temperature, self.volume_shape_factor)
        given = feed.liquid[found[0].solvent]
        W = jnp.where(given > 0.0, given, TRICKLE)
        held = jnp.asarray(self.seed_mass_per_solvent, dtype=float)
        edges = jnp.asarray(feed.mixture.edges)
        low, high = edges[:-1], edges[1:]
        cubes = crystal.mass_per_cube * 0.25 * (low + high) * (low**2 + high**2)

        def seeding(role: Roles, added: Any) -> Seeds:
            cut = narrow_seeds(self.seed_size, self.seed_width, added, crystal.mass_per_cube)
            # without a liquor they stay what they are
            fed = jnp.where(given > 0.0, feed_of(feed, role).crystals / (W * cubes), 0.0)
            return Seeds(jnp.append(cut.low, low), jnp.append(cut.high, high), jnp.append(cut.number, fed))

        vessel = Resolution(
            self.solubility,
            self.growth,
            self.nucleation,
            self.dissolution,
            crystal,
            feed.liquid_density,
            self.racemate_solubility_ratio,
            self.counter_nucleation,
        )
        times = jnp.linspace(0.0, self.duration, STEPS + 1)
        end, course = vessel.run(
            (seeding(found[0], held), seeding(found[1], 0.0 * held)),
            self.temperature_program,
            jnp.stack([jnp.where(given > 0.0, feed.liquid[role.solute] / W, 0.0) for role in found]),
            times,
        )
        self.solubility(course.temperature)  # once more where its flags are heard
        return Resolved(end, course, times, W, found, held)

    def charts(self, made: Operated, inlets: Mapping[str, Stream]) -> dict[str, Any]:
        resolved: Resolved = made.inside
        if not float(inlets["feed"].liquid_flow) > 0.0:
            return {}
        return drawn_resolution(resolved.times, resolved.course, resolved.leaving)

    def outlets(self, inside: Resolved, feed: Stream) -> BatchOutlets:
        solid, liquid = feed.solid, feed.liquid
        for role, packets, left in zip(inside.found, inside.end.crystals, inside.leaving[-1], strict=True):
            classes = packets.in_classes(feed.mixture.edges)
            classes = classes * safe_divide(left * inside.solvent, jnp.sum(classes), 0.0)
            classes = jnp.where(inside.solvent > TRICKLE, classes, feed_of(feed, role).crystals)
            solid = with_crystals(feed.replace(solid=solid), role, classes)
            gained = jnp.sum(feed.solid[role.solid]) - jnp.sum(solid[role.solid])
            liquid = liquid.at[role.solute].add(gained)
        T = jnp.asarray(inside.course.temperature[-1], dtype=float)
        product = feed.replace(solid=solid, liquid=liquid, temperature=T)
        return BatchOutlets(product, product.enthalpy_flow - feed.enthalpy_flow)

    def figures(self, inside: Resolved, outlets: BatchOutlets, feed: Stream) -> ResolutionFigures:
        course, product = inside.course, outlets.product
        made = [product.solid_by_species[role.solid] for role in inside.found]
        wanted = feed_of(feed, inside.found[0])
        share = pure_share(inside.leaving)
        until = pure_until(inside.times, share, self.enantiomer_fraction_least)
        sigma = course.ratios / course.saturated - 1.0
        volume = product.slurry_volume_flow * self.cycle
        return ResolutionFigures(
            made[0],
            made[1],
            share[-1],
            safe_divide(made[0], wanted.solute + jnp.sum(wanted.crystals)),
            excess(course.ratios[-1]),
            until,
            jnp.interp(until, inside.times, course.masses[:, 0]) - course.masses[0, 0],
            sigma[-1, 0],
            jnp.max(sigma[:, 1]),
            safe_divide(made[0] + made[1], product.slurry_volume_flow),
            course.sizes[-1, 0],
            course.sizes[-1, 1],
            inside.held * inside.solvent * self.cycle,
            volume,
            outlets.heat_duty,
            *self.stirrer_figures(product, volume),
        )

    def measured(
        self, inside: Resolved, outlets: BatchOutlets, figures: ResolutionFigures, feed: Stream
    ) -> dict[str, Any]:
        product, course = outlets.product, inside.course
        idle = (course.masses[-1, 0] <= 0.0) & (course.ratios[-1, 0] > (1.0 + 1e-6) * course.saturated[-1, 0])
        return {
            "crowded": product.solids_volume_fraction,
            "largest": product.size_fractions[-1],
            "present": jnp.where(idle, 0.0, 1.0),
            "pure": figures.enantiomer_fraction_end,
        } | self.stirrer_measured(product, figures.volume)

    def drawn(
        self, inside: Resolved, outlets: BatchOutlets, figures: ResolutionFigures, feed: Stream
    ) -> dict[str, Any]:
        stirrer = self.stirrer_power(outlets.product, figures.volume)
        return thermal(outlets.heat_duty, feed, outlets.product) | stirrer
