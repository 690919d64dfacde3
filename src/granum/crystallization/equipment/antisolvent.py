"""Crystallizers in a line into which a second solvent runs that takes the solute from the first (drowning
out).
"""

from __future__ import annotations

from typing import Any, ClassVar, NamedTuple

import equinox as eqx
import jax.numpy as jnp

from granum.core import equipment
from granum.core.errors import CaseError
from granum.core.flags import unsolved
from granum.core.i18n import _
from granum.core.kinds import (
    Concentration,
    Distance,
    GrowthRate,
    MassFlow,
    MassFraction,
    MassRatio,
    NucleationRate,
    Number,
    PositiveNumber,
    Power,
    Temperature,
    Time,
)
from granum.crystallization.equipment.batch import BatchOutlets
from granum.crystallization.equipment.msmpr import STEADY
from granum.crystallization.equipment.roles import (
    Roles,
    crystal_of,
    feed_of,
    roles,
    with_crystals,
)
from granum.crystallization.kinds import Growth, Nucleation, Solubility, VesselVolume
from granum.crystallization.vessels.msmpr import AdditiveVolumes, Feed, SteadyState, steady_msmpr
from granum.numerics.smooth import safe_divide
from granum.streams.mixture import Mixture
from granum.streams.stream import Stream, median_of
from granum.streams.units import Limits, Unit, Utilities
from granum.streams.utilities import COOLED, HEATED, STIRRED, cooled, heated, suspended

UNSOLVED = (
    "No supersaturation was found at which the crystals made are those that the solute balance leaves: check "
    "feed, antisolvent and kinetics."
)


class AntisolventFigures(NamedTuple):
    """Figures of an antisolvent crystallizer."""

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


class Drowned(NamedTuple):
    """The steady suspension, the streams that meet in it, who plays which part, and the second solvent."""

    state: SteadyState
    met: Stream
    found: Roles
    second: int


class AtShare(eqx.Module):
    """The solubility at one composition of the solvent."""

    law: Any
    share: Any

    def __call__(self, temperature: Any) -> Any:
        return self.law(temperature, self.share)


def second_solvent_of(mixture: Mixture, found: Roles, name: str) -> int:
    """Position of the antisolvent: by name, or the one liquid that is neither solute nor solvent."""
    if name:
        second = mixture.index("liquids", name)
        if second in (found.solute, found.solvent):
            raise CaseError(
                _("'{name}' cannot be the antisolvent: it is the solute or the solvent.").format(name=name)
            )
        return second
    rest = [i for i in range(len(mixture.liquids)) if i not in (found.solute, found.solvent)]
    if len(rest) != 1:
        raise CaseError(
            _(
                "Which liquid is the antisolvent? Beside solute and solvent the mixture has {liquids}: name "
                "one as 'second_solvent'."
            ).format(liquids=", ".join(mixture.liquids[i].name for i in rest) or "—")
        )
    return rest[0]


@equipment(
    "antisolvent_crystallizer",
    source="mullin2001, ch. 8; randolph1988, ch. 4; yalkowsky1981",
    title="Continuous crystallizer with antisolvent (drowning out)",
    equation=r"M_T = k_v \rho_c \left(6 B_0 G^3\tau^4 + \dots\right),\quad C^* = C^*(T, w)",
)
class AntisolventCrystallizer(Unit):
    """Continuous crystallizer with mixed suspension and mixed product removal, into which an antisolvent
    runs that lowers the solubility.

    Feed and antisolvent are mixed at once and wholly; the share of antisolvent in the solvent follows from
    both, so that recycled liquor may hold some and the antisolvent may hold water. The supersaturation is the
    one at which nucleation and growth make exactly the crystals that the solute balance leaves. The crystal
    must be free of solvent. Heat of mixing and excess volume of the two solvents are left out.
    """

    temperature: Temperature
    volume: VesselVolume
    solubility: Solubility
    growth: Growth
    nucleation: Nucleation
    volume_shape_factor: PositiveNumber = eqx.field(kw_only=True, default=1.0)
    nucleus_size: Distance = eqx.field(kw_only=True, default=0.0)
    solid: str = eqx.field(kw_only=True, static=True, default="")
    solvent: str = eqx.field(kw_only=True, static=True, default="")
    second_solvent: str = eqx.field(kw_only=True, static=True, default="")

    limits: ClassVar[Limits] = STEADY

    utilities: ClassVar[Utilities] = STIRRED | HEATED | COOLED

    def inside(self, feed: Stream, antisolvent: Stream) -> Drowned:
        mixture = feed.mixture
        found = roles(mixture, self.solid, self.solvent)
        second = second_solvent_of(mixture, found, self.second_solvent)
        if not getattr(self.solubility, "takes_antisolvent", False):
            raise CaseError(
                _(
                    "The solubility does not depend on an antisolvent: give a law that does, such as "
                    "'antisolvent_solubility'."
                )
            )
        if found.solute_fraction < 1.0 - 1e-9:
            raise CaseError(
                _(
                    "The crystal '{crystal}' holds solvent, which would change the mixture of solvents as it "
                    "forms: this vessel takes crystals that are free of it."
                ).format(crystal=mixture.solids[found.solid].name)
            )
        met = feed + antisolvent
        densities, T = mixture.densities("liquids", self.temperature), self.temperature
        first, other = met.liquid[found.solvent], met.liquid[second]
        solvents = first + other
        share = safe_divide(other, solvents, 0.0)
        volumes = met.liquid / densities
        mixed = safe_divide(solvents, volumes[found.solvent] + volumes[second], densities[found.solvent])
        apart = jnp.sum(volumes) - volumes[found.solute] - volumes[found.solvent] - volumes[second]
        entering = feed_of(met, found)
        law = AtShare(self.solubility, share)
        law(T)  # once more where its flags are heard: inside what is compiled they are lost
        state = steady_msmpr(
            Feed(entering.solute, solvents, entering.crystals),
            T,
            self.volume,
            law,
            self.growth,
            self.nucleation,
            crystal_of(mixture, found, T, self.volume_shape_factor),
            AdditiveVolumes(densities[found.solute], mixed, apart),
            mixture.edges,
            nucleus_size=self.nucleus_size,
        )
        unsolved(state.converged, type(self).card, reason=UNSOLVED)
        return Drowned(state, met, found, second)

    def outlets(self, inside: Drowned, feed: Stream, antisolvent: Stream) -> BatchOutlets:
        state, met, found, _second = inside
        product = met.replace(
            solid=with_crystals(met, found, state.crystals),
            liquid=met.liquid.at[found.solute].set(state.solute),
            temperature=jnp.asarray(self.temperature, dtype=float),
        )
        return BatchOutlets(product, product.enthalpy_flow - feed.enthalpy_flow - antisolvent.enthalpy_flow)

    def figures(
        self, inside: Drowned, outlets: BatchOutlets, feed: Stream, antisolvent: Stream
    ) -> AntisolventFigures:
        state, met, found, second = inside
        entering = feed_of(met, found)
        fed = entering.solute + found.solute_fraction * jnp.sum(entering.crystals)
        crystals = jnp.sum(state.crystals)
        solvents = met.liquid[found.solvent] + met.liquid[second]
        return AntisolventFigures(
            crystals,
            safe_divide(found.solute_fraction * crystals, fed),
            safe_divide(met.liquid[second], solvents, 0.0),
            state.solubility_per_solvent,
            state.magma_density,
            state.relative_supersaturation,
            state.growth_rate,
            state.nucleation_rate,
            state.residence_time,
            median_of(state.crystals, met.mixture.edges),
            outlets.heat_duty,
        )

    def measured(
        self,
        inside: Drowned,
        outlets: BatchOutlets,
        figures: AntisolventFigures,
        feed: Stream,
        antisolvent: Stream,
    ) -> dict[str, Any]:
        return {
            "crowded": outlets.product.solids_volume_fraction,
            "time": figures.residence_time,
            "present": jnp.where(inside.state.washed_out, 0.0, 1.0),
            "largest": outlets.product.size_fractions[-1],
        }

    def drawn(
        self,
        inside: Drowned,
        outlets: BatchOutlets,
        figures: AntisolventFigures,
        feed: Stream,
        antisolvent: Stream,
    ) -> dict[str, Any]:
        duty, T = outlets.heat_duty, self.temperature
        agitator = {"electric_power_agitator": suspended(outlets.product, self.volume)}
        return heated(duty, T) | cooled(duty, T) | agitator
