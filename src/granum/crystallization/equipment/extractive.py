"""A crystallizer into which a liquid runs that takes the wanted solute out of solution and keeps the other
one in it (extractive).
"""

from __future__ import annotations

from typing import Annotated, Any, ClassVar, NamedTuple

import equinox as eqx
import jax.numpy as jnp

from granum.core import equipment
from granum.core.errors import CaseError
from granum.core.i18n import _
from granum.core.kinds import (
    Concentration,
    Distance,
    GrowthRate,
    Length,
    MassFlow,
    MassFraction,
    MassRatio,
    NucleationRate,
    Number,
    PositiveNumber,
    Power,
    Ratio,
    Time,
    Within,
)
from granum.core.limits import Limit
from granum.crystallization.equipment.antisolvent import (
    AntisolventCrystallizer,
    AntisolventFigures,
    Drowned,
    antisolvent_share,
)
from granum.crystallization.equipment.batch import BatchOutlets
from granum.crystallization.equipment.beside import refuse_other_system
from granum.crystallization.equipment.msmpr import STEADY
from granum.crystallization.equipment.roles import Roles, roles, with_crystals
from granum.crystallization.kinds import Solubility
from granum.numerics.smooth import safe_divide
from granum.particles.size_laws import LogNormal
from granum.streams.mixture import Mixture
from granum.streams.stream import Stream
from granum.streams.units import Limits


class ExtractiveFigures(NamedTuple):
    """Figures of an extractive crystallizer."""

    crystal_flow: MassFlow
    yield_fraction: Number
    antisolvent_fraction: MassFraction
    solubility_per_solvent: MassRatio
    magma_density: Concentration
    relative_supersaturation: Number
    growth_rate: GrowthRate
    nucleation_rate: NucleationRate
    residence_time: Time
    mass_median_size: Distance
    heat_duty: Power
    crystal_flow_solute_other: MassFlow
    purity: MassFraction
    saturation_other: Ratio


@equipment(
    "extractive_crystallizer",
    source="mullin2001, ch. 8; randolph1988, ch. 4; yalkowsky1981",
    title="Continuous extractive crystallizer of two solutes",
    equation=r"\dot m_A = \max\left(0,\ \dot m_{A,0} - C_A^*(T, w)\,\dot m_s\right),\quad "
    r"w_P = \frac{\dot m_B}{\dot m_A + \dot m_B}",
)
class ExtractiveCrystallizer(AntisolventCrystallizer):
    """Continuous crystallizer into which a liquid runs in which the wanted solute dissolves badly and another
    one well, so that the other stays dissolved.

    The wanted solute crystallizes by its kinetics, as in ``antisolvent_crystallizer``; of the other one
    forms what is beyond its solubility in the mixture of solvents, at equilibrium, in crystals of the given
    sizes, and crystals of it that come with the feed dissolve where there is room. Both solubilities depend
    on the share of added liquid, per kilogram of the mixture, as if the other solute were not there. Both
    crystals must be free of solvent. Heat of mixing and excess volume of the solvents are left out.
    """

    other_solubility: Solubility = eqx.field(kw_only=True)
    solid_solute_other: str = eqx.field(kw_only=True, static=True, default="")
    crystal_size: Length = eqx.field(kw_only=True, default=200e-6)
    geometric_standard_deviation: Annotated[PositiveNumber, Within(1.01, 10.0)] = eqx.field(
        kw_only=True, default=1.5
    )

    limits: ClassVar[Limits] = STEADY | {
        "pure": Limit("other solute over what is soluble", 0.0, 1.0, "dimensionless", "mullin2001, ch. 8")
    }

    def _other(self, mixture: Mixture, wanted: Roles, second: int) -> Roles:
        """Who plays which part for the other solute."""
        name = self.solid_solute_other
        if not name:
            dissolved = {s.name for i, s in enumerate(mixture.liquids) if i not in (*wanted[1:3], second)}
            rest = [
                s.name
                for i, s in enumerate(mixture.solids)
                if i != wanted.solid and dissolved & {part for part, _share in s.composition}
            ]
            if len(rest) != 1:
                raise CaseError(
                    _(
                        "Which crystal is the other solute's? Beside the wanted one the mixture has "
                        "{solids}: name one as 'solid_solute_other'."
                    ).format(solids=", ".join(rest) or "—")
                )
            name = rest[0]
        found = roles(mixture, name, self.solvent)
        if found.solute in (wanted.solute, second):
            raise CaseError(
                _("'{name}' cannot be the other solute: it is the wanted one or the added liquid.").format(
                    name=name
                )
            )
        if found.solute_fraction < 1.0 - 1e-9:
            raise CaseError(
                _(
                    "The crystal '{crystal}' holds solvent, which would change the mixture of solvents as it "
                    "forms: this vessel takes crystals that are free of it."
                ).format(crystal=name)
            )
        if not getattr(self.other_solubility, "takes_antisolvent", False):
            raise CaseError(
                _(
                    "The other solubility does not depend on the added liquid: give a law that does, such as "
                    "'antisolvent_solubility', with a negative power where the liquid dissolves more."
                )
            )
        refuse_other_system(self.other_solubility, mixture, found)
        return found

    def _balance(self, inside: Drowned) -> tuple[Roles, Any, Any]:
        """The other solute's parts, all there is of it, and what the solvents hold of it at most, kg/s."""
        _state, met, found, second = inside
        other = self._other(met.mixture, found, second)
        solvents = met.liquid[found.solvent] + met.liquid[second]
        soluble = self.other_solubility(self.temperature, antisolvent_share(met, found, second))
        return other, met.liquid[other.solute] + jnp.sum(met.solid[other.solid]), soluble * solvents

    def outlets(self, inside: Drowned, feed: Stream, antisolvent: Stream) -> BatchOutlets:
        product = super().outlets(inside, feed, antisolvent).product
        other, there, held = self._balance(inside)
        made = jnp.maximum(there - held, 0.0)
        solid = product.solid[other.solid]
        fed = jnp.sum(solid, axis=tuple(range(1, solid.ndim)))
        before = jnp.sum(fed)
        sizes = LogNormal(self.crystal_size, self.geometric_standard_deviation)
        passing = sizes(jnp.asarray(feed.mixture.edges)).at[0].set(0.0).at[-1].set(1.0)
        classes = fed * jnp.minimum(safe_divide(made, before, 0.0), 1.0)
        classes = classes + jnp.diff(passing) * jnp.maximum(made - before, 0.0)
        product = product.replace(
            solid=with_crystals(product, other, classes),
            liquid=product.liquid.at[other.solute].set(there - made),
        )
        return BatchOutlets(product, product.enthalpy_flow - feed.enthalpy_flow - antisolvent.enthalpy_flow)

    def figures(
        self, inside: Drowned, outlets: BatchOutlets, feed: Stream, antisolvent: Stream
    ) -> ExtractiveFigures:
        plain: AntisolventFigures = super().figures(inside, outlets, feed, antisolvent)
        _other, there, held = self._balance(inside)
        made = jnp.maximum(there - held, 0.0)
        purity = safe_divide(plain.crystal_flow, plain.crystal_flow + made, 1.0)
        return ExtractiveFigures(*plain, made, purity, safe_divide(there, held, 0.0))

    def measured(
        self,
        inside: Drowned,
        outlets: BatchOutlets,
        figures: Any,
        feed: Stream,
        antisolvent: Stream,
    ) -> dict[str, Any]:
        measured = super().measured(inside, outlets, figures, feed, antisolvent)
        return measured | {"pure": figures.saturation_other}
