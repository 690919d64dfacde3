"""A batch crystallizer with two crystal forms of one substance, of which the stable one grows as the other
dissolves.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, ClassVar, Literal, NamedTuple

import equinox as eqx
import jax.numpy as jnp

from granum.core import equipment
from granum.core.errors import CaseError
from granum.core.flags import unsolved
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
from granum.crystallization.equipment.batch import BatchOutlets
from granum.crystallization.equipment.beside import heard_beside, is_other_form, refuse_other_system
from granum.crystallization.equipment.rival_batch import Contested, Cut, RivalBatch
from granum.crystallization.equipment.roles import Roles, feed_of
from granum.crystallization.formulas.nucleation import NoNucleation
from granum.crystallization.inside_charts import drawn_forms
from granum.crystallization.kinds import Dissolution, Growth, Nucleation, Solubility
from granum.crystallization.population.rivals import Form, Rivals, Row
from granum.crystallization.vessels.crystals import Crystal
from granum.crystallization.vessels.enantiomers import Purity, pure_share, pure_until
from granum.numerics.smooth import safe_divide
from granum.streams.mixture import Mixture
from granum.streams.stream import Stream
from granum.streams.units import Limits, Operated

ROUND = (
    "The stable form dissolves more than the other at every temperature of the batch: change the two "
    "solubilities and their crystals round."
)


class PolymorphFigures(NamedTuple):
    """Figures of a crystallizer with two crystal forms of one substance."""

    crystal_flow_metastable: MassFlow
    crystal_flow_stable: MassFlow
    form_fraction_end: Fraction
    yield_fraction: Ratio
    time_transformation_start: Time
    time_transformation_half: Time
    time_transformation_end: Time
    plateau_position: Number
    relative_supersaturation_stable: Number
    magma_density: Concentration
    mean_diameter_metastable: Distance
    mean_diameter_stable: Distance
    seed_mass: Mass
    volume: Volume
    heat_duty: Power
    rotation_speed_suspension: RotationSpeed
    tip_speed: Velocity
    specific_power_input: SpecificPower


@equipment(
    "polymorph_crystallizer",
    source="cardew1985; ono2004; schoell2006",
    title="Batch crystallizer with two polymorphs (solvent-mediated transformation)",
    equation=(
        r"\frac{\partial n_i}{\partial t} + G_i(C, C^*_i)\,\frac{\partial n_i}{\partial L} = 0,\quad "
        r"\frac{dC}{dt} = -\sum_i \frac{dM_i}{dt}"
    ),
)
class PolymorphCrystallizer(RivalBatch):
    """Batch, in cycles of batch and dead time, in which one crystal form of a substance dissolves while the
    stable one is born and grows from the same liquor; outlets are means over the cycle.

    ``solid`` is the metastable form and ``solid_stable`` the other; without names they are the two crystals
    of the mixture that dissolve to one substance, the metastable one being that which the library has as
    another form (``form_of``), else the first. Crystals of the feed are seeds of what they are; seeds of
    either form may be held back for the next batch, pure, as in ``batch_crystallizer``. Births of the stable
    form count its own magma and a share of the other's. Times that are not reached are those of the whole
    batch. Where the liquor stays at the solubility of the metastable form until half has changed, growth of
    the stable one rules, and where it lies at that of the stable form, dissolution does (Cardew and Davey).
    Left out: solubility beside other solutes, crystals of one form that grow on the other, collisions, and
    what still changes in a wet cake.
    """

    solubility: Solubility = eqx.field(kw_only=True)
    solubility_law_stable: Solubility = eqx.field(kw_only=True)
    growth: Growth = eqx.field(kw_only=True)
    growth_stable: Growth = eqx.field(kw_only=True)
    dissolution: Dissolution = eqx.field(kw_only=True)
    nucleation: Nucleation = eqx.field(kw_only=True, default=NoNucleation())
    nucleation_stable: Nucleation = eqx.field(kw_only=True, default=NoNucleation())
    cross_nucleation: Ratio = eqx.field(kw_only=True, default=0.0)
    seed_mass_stable: MassRatio = eqx.field(kw_only=True, default=0.0)
    seed_size_stable: Length = eqx.field(kw_only=True, default=50e-6)
    volume_shape_factor_stable: PositiveNumber = eqx.field(kw_only=True, default=1.0)
    wanted_form: Literal["stable", "metastable"] = eqx.field(kw_only=True, static=True, default="stable")
    form_fraction_least: Purity = eqx.field(kw_only=True, default=0.99)
    solid_stable: str = eqx.field(kw_only=True, static=True, default="")

    limits: ClassVar[Limits] = RivalBatch.limits | {
        "pure": Limit(
            "wanted form in the crystals", "form_fraction_least", 1.0, "dimensionless", "cardew1985"
        ),
    }

    def _names(self, mixture: Mixture) -> tuple[str, str]:
        names = [s.name for s in mixture.solids]
        given = [names[mixture.index("solids", n)] if n else "" for n in (self.solid, self.solid_stable)]
        made_of = {s.name: s.composition for s in mixture.solids}
        twins = [n for n in names if list(made_of.values()).count(made_of[n]) > 1]
        other = [n for n in twins if n not in given and is_other_form(mixture.materials, n)]
        one = given[0] or next((n for n in (*other, *twins) if n != given[1]), "")
        two = given[1] or next((n for n in twins if n != one and made_of[n] == made_of.get(one)), "")
        if not one or not two:
            raise CaseError(
                _(
                    "Two crystals of one substance are needed among the solids, such as 'L-glutamic acid "
                    "alpha' and 'L-glutamic acid'; the mixture has {solids}. A form of one's own is a "
                    "solute with 'form_of'."
                ).format(solids=", ".join(names) or "—")
            )
        if one == two:
            raise CaseError(_("Both forms are '{name}': name two crystals.").format(name=one))
        if made_of[one] != made_of[two]:
            raise CaseError(
                _("'{one}' and '{other}' are not two forms of one substance.").format(one=one, other=two)
            )
        return one, two

    def _cuts(self) -> tuple[Cut, Cut]:
        return (
            Cut(self.seed_size, self.seed_width, self.seed_mass_per_solvent),
            Cut(self.seed_size_stable, 0.0, self.seed_mass_stable),
        )

    def _shapes(self) -> tuple[Any, Any]:
        return self.volume_shape_factor, self.volume_shape_factor_stable

    def _rivals(self, feed: Stream, crystals: tuple[Crystal, Crystal]) -> Rivals:
        forms = (
            Form(self.solubility, self.growth, self.nucleation, self.dissolution, crystals[0]),
            Form(
                self.solubility_law_stable,
                self.growth_stable,
                self.nucleation_stable,
                self.dissolution,
                crystals[1],
            ),
        )
        return Rivals(forms, feed.liquid_density, (0.0, self.cross_nucleation))

    def _roles(self, mixture: Mixture) -> tuple[Roles, Roles]:
        found = super()._roles(mixture)
        for law, role in zip((self.solubility, self.solubility_law_stable), found, strict=True):
            refuse_other_system(law, mixture, role)
        return found

    def _heard(self, course: Row, feed: Stream, found: tuple[Roles, Roles]) -> None:
        card = type(self).card
        unsolved(jnp.any(course.saturated[:, 0] >= course.saturated[:, 1]), card, reason=ROUND)
        states = course.temperature, course.ratios[:, 0], jnp.ones_like(course.temperature)
        for law, role in zip((self.solubility, self.solubility_law_stable), found, strict=True):
            heard_beside(law, feed.mixture, role, feed.liquid, states, card)

    def charts(self, made: Operated, inlets: Mapping[str, Stream]) -> dict[str, Any]:
        if not float(inlets["feed"].liquid_flow) > 0.0:
            return {}
        return drawn_forms(made.inside.times, made.inside.course)

    def _wanted(self, metastable: Any) -> Any:
        return metastable if self.wanted_form == "metastable" else 1.0 - metastable

    def figures(self, inside: Contested, outlets: BatchOutlets, feed: Stream) -> PolymorphFigures:
        course, product, found = inside.course, outlets.product, inside.found
        made = [product.solid_by_species[role.solid] for role in found]
        share = pure_share(inside.leaving)  # of the metastable form
        start, half, end = (pure_until(inside.times, share, least) for least in (0.99, 0.5, 0.01))
        ratio = course.ratios[:, 0]
        between = safe_divide(ratio - course.saturated[:, 1], course.saturated[:, 0] - course.saturated[:, 1])
        volume = product.slurry_volume_flow * self.cycle
        return PolymorphFigures(
            made[0],
            made[1],
            self._wanted(share[-1]),
            safe_divide(made[0] + made[1], _fed(feed, found)),
            start,
            half,
            end,
            jnp.interp(half, inside.times, between),
            ratio[-1] / course.saturated[-1, 1] - 1.0,
            safe_divide(made[0] + made[1], product.slurry_volume_flow),
            course.sizes[-1, 0],
            course.sizes[-1, 1],
            self._seed(inside),
            volume,
            outlets.heat_duty,
            *self.stirrer_figures(product, volume),
        )

    def measured(
        self, inside: Contested, outlets: BatchOutlets, figures: PolymorphFigures, feed: Stream
    ) -> dict[str, Any]:
        course = inside.course
        over = course.ratios[-1, 0] > (1.0 + 1e-6) * jnp.min(course.saturated[-1])
        idle = over & (jnp.sum(course.masses[-1]) <= 0.0)
        return self._common(inside, outlets, figures.volume) | {
            "present": jnp.where(idle, 0.0, 1.0),
            "pure": figures.form_fraction_end,
        }


def _fed(feed: Stream, found: tuple[Roles, Roles]) -> Any:
    """All there is of the substance, kg/s."""
    return feed.liquid[found[0].solute] + sum(jnp.sum(feed_of(feed, role).crystals) for role in found)
