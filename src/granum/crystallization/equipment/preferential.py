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
    Mass,
    MassFlow,
    Number,
    Power,
    Ratio,
    RotationSpeed,
    SpecificPower,
    Time,
    Velocity,
    Volume,
)
from granum.core.limits import Limit
from granum.crystallization.equipment.batch import BatchOutlets
from granum.crystallization.equipment.rival_batch import Contested, RivalBatch
from granum.crystallization.equipment.roles import feed_of
from granum.crystallization.inside_charts import drawn_resolution
from granum.crystallization.kinds import Dissolution, Growth, Nucleation, RacemateSolubilityRatio, Solubility
from granum.crystallization.population.rivals import Rivals
from granum.crystallization.vessels.crystals import Crystal
from granum.crystallization.vessels.enantiomers import Purity, Resolution, excess, pure_share, pure_until
from granum.numerics.smooth import safe_divide
from granum.streams.mixture import Mixture
from granum.streams.stream import Stream
from granum.streams.units import Limits, Operated


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


@equipment(
    "preferential_crystallizer",
    source="elsner2005; angelov2008; jacques1981, ch. 4",
    title="Batch crystallizer that parts two enantiomers (preferential crystallization)",
    equation=(
        r"\frac{\partial n_i}{\partial t} + G(C_i, C^*_i)\,\frac{\partial n_i}{\partial L} = 0,\quad "
        r"C^*_1 = C^*\,e^{K C_2/C^*}"
    ),
)
class PreferentialCrystallizer(RivalBatch):
    """Cooling batch, in cycles of batch and dead time, of a liquor supersaturated in both enantiomers of a
    conglomerate and seeded with one; outlets are means over the cycle.

    Both have one solubility and one kinetics. The wanted crystals are ``solid``, or the first ones; a share
    of them, pure, is held back as their seed, as in ``batch_crystallizer``, and crystals of the feed are
    seeds of what they are. Without a law of dissolution crystals keep. Purity is that of what leaves, without
    the seed; the crop while pure is what has grown beside it, per kg of solvent, when the purity falls below
    the least one: end the batch then. Two such vessels, seeded with one and the other, take each other's
    mother liquor.
    """

    solubility: Solubility = eqx.field(kw_only=True)
    growth: Growth = eqx.field(kw_only=True)
    nucleation: Nucleation = eqx.field(kw_only=True)
    counter_nucleation: Ratio = eqx.field(kw_only=True, default=0.0)
    racemate_solubility_ratio: RacemateSolubilityRatio = eqx.field(kw_only=True, default=2.0)
    enantiomer_fraction_least: Purity = eqx.field(kw_only=True, default=0.99)
    dissolution: Dissolution | None = eqx.field(kw_only=True, default=None)
    other_solid: str = eqx.field(kw_only=True, static=True, default="")

    limits: ClassVar[Limits] = RivalBatch.limits | {
        "pure": Limit(
            "wanted enantiomer in the crystals",
            "enantiomer_fraction_least",
            1.0,
            "dimensionless",
            "jacques1981, ch. 4",
        ),
    }

    def _names(self, mixture: Mixture) -> tuple[str, str]:
        names = [s.name for s in mixture.solids]
        if len(names) < 2:
            raise CaseError(_("The crystals of both enantiomers are needed among the solids."))
        wanted = self.solid or names[0]
        other = self.other_solid or next(name for name in names if name != wanted)
        if other == wanted:
            raise CaseError(_("Both enantiomers are '{name}': name two crystals.").format(name=wanted))
        return wanted, other

    def _rivals(self, feed: Stream, crystals: tuple[Crystal, Crystal]) -> Rivals:
        return Resolution(
            self.solubility,
            self.growth,
            self.nucleation,
            self.dissolution,
            crystals[0],
            feed.liquid_density,
            self.racemate_solubility_ratio,
            self.counter_nucleation,
        ).rivals()

    def charts(self, made: Operated, inlets: Mapping[str, Stream]) -> dict[str, Any]:
        resolved: Contested = made.inside
        if not float(inlets["feed"].liquid_flow) > 0.0:
            return {}
        return drawn_resolution(resolved.times, resolved.course, resolved.leaving)

    def figures(self, inside: Contested, outlets: BatchOutlets, feed: Stream) -> ResolutionFigures:
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
            self._seed(inside),
            volume,
            outlets.heat_duty,
            *self.stirrer_figures(product, volume),
        )

    def measured(
        self, inside: Contested, outlets: BatchOutlets, figures: ResolutionFigures, feed: Stream
    ) -> dict[str, Any]:
        course = inside.course
        idle = (course.masses[-1, 0] <= 0.0) & (course.ratios[-1, 0] > (1.0 + 1e-6) * course.saturated[-1, 0])
        return self._common(inside, outlets, figures.volume) | {
            "present": jnp.where(idle, 0.0, 1.0),
            "pure": figures.enantiomer_fraction_end,
        }
