"""Crystallizers in a line into which a second solvent runs that takes the solute from the first (drowning
out): continuous, and in batches.
"""

from __future__ import annotations

import math
from typing import Annotated, Any, ClassVar, NamedTuple

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
    Mass,
    MassFlow,
    MassFraction,
    MassRatio,
    NucleationRate,
    Number,
    PositiveNumber,
    Power,
    Ratio,
    RotationSpeed,
    SpecificPower,
    Temperature,
    Time,
    Velocity,
    Volume,
    Within,
)
from granum.core.limits import Limit
from granum.crystallization.equipment.batch import (
    BatchOutlets,
    CycledVessel,
    Grown,
    thermal,
)
from granum.crystallization.equipment.beside import refuse_other_system
from granum.crystallization.equipment.colliding import UNSOLVED_CROWD, Colliding
from granum.crystallization.equipment.msmpr import STEADY
from granum.crystallization.equipment.roles import (
    Roles,
    crystal_of,
    feed_of,
    roles,
    with_crystals,
)
from granum.crystallization.kinds import Growth, Nucleation, Solubility, VesselVolume
from granum.crystallization.population.operations import Contents, Operation
from granum.crystallization.vessels.msmpr import AdditiveVolumes, Feed, SteadyState, steady_msmpr
from granum.numerics.smooth import safe_divide, safe_power
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


def drowning_roles(vessel: Any, mixture: Mixture) -> tuple[Roles, int]:
    """Who plays which part in a vessel with an antisolvent, which solubility and crystal must suit."""
    found = roles(mixture, vessel.solid, vessel.solvent)
    second = second_solvent_of(mixture, found, vessel.second_solvent)
    if not getattr(vessel.solubility, "takes_antisolvent", False):
        raise CaseError(
            _(
                "The solubility does not depend on an antisolvent: give a law that does, such as "
                "'antisolvent_solubility'."
            )
        )
    refuse_other_system(vessel.solubility, mixture, found)
    if found.solute_fraction < 1.0 - 1e-9:
        raise CaseError(
            _(
                "The crystal '{crystal}' holds solvent, which would change the mixture of solvents as it "
                "forms: this vessel takes crystals that are free of it."
            ).format(crystal=mixture.solids[found.solid].name)
        )
    return found, second


def antisolvent_share(met: Stream, found: Roles, second: int) -> Any:
    """Of antisolvent in the solvent."""
    first, other = met.liquid[found.solvent], met.liquid[second]
    return safe_divide(other, first + other, 0.0)


@equipment(
    "antisolvent_crystallizer",
    source="mullin2001, ch. 8; randolph1988, ch. 4; yalkowsky1981",
    title="Continuous crystallizer with antisolvent (drowning out)",
    equation=r"M_T = k_v \rho_c \left(6 B_0 G^3\tau^4 + \dots\right),\quad C^* = C^*(T, w)",
)
class AntisolventCrystallizer(Colliding, Unit):
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
        found, second = drowning_roles(self, mixture)
        met = feed + antisolvent
        densities, T = mixture.densities("liquids", self.temperature), self.temperature
        solvents = met.liquid[found.solvent] + met.liquid[second]
        volumes = met.liquid / densities
        mixed = safe_divide(solvents, volumes[found.solvent] + volumes[second], densities[found.solvent])
        apart = jnp.sum(volumes) - volumes[found.solute] - volumes[found.solvent] - volumes[second]
        entering = feed_of(met, found)
        law = AtShare(self.solubility, antisolvent_share(met, found, second))
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
            collisions=self.collisions,
        )
        reason = UNSOLVED if self.collisions is None else UNSOLVED_CROWD
        unsolved(state.converged, type(self).card, reason=reason)
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
        return AntisolventFigures(
            crystals,
            safe_divide(found.solute_fraction * crystals, fed),
            antisolvent_share(met, found, second),
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


class DrownedBatchFigures(NamedTuple):
    """Figures of a batch crystallizer with antisolvent."""

    crystal_flow: MassFlow
    yield_fraction: Number
    antisolvent_fraction: MassFraction
    magma_density: Concentration
    relative_supersaturation_maximum: Number
    mean_diameter_mass: Distance
    nuclei_mass_fraction: Ratio | None
    seed_mass: Mass
    volume: Volume
    heat_duty: Power
    rotation_speed_suspension: RotationSpeed
    tip_speed: Velocity
    specific_power_input: SpecificPower


class Dosed(Operation):
    """A charge at one temperature into which a stream runs, its share by a power of time.

    Parameters
    ----------
    charged: antisolvent that the charge holds. solute, solvent, antisolvent: what runs in, all in all; the
        solvent counts both.
    """

    temperature: Any
    duration: Any
    power: Any
    charged: Any
    solute: Any
    solvent: Any
    antisolvent: Any

    def start(self, solute: Any, solvent: Any) -> Contents:
        return Contents(jnp.asarray(self.temperature, dtype=float), solute, solvent, self.charged)

    def step(self, old: Contents, start: Any, end: Any, crystals_before: Any, crystals: Any) -> Contents:
        before, after = (safe_power(jnp.clip(t / self.duration, 0.0, 1.0), self.power) for t in (start, end))
        share = after - before
        return Contents(
            old.temperature,
            old.solute + share * self.solute,
            old.solvent + share * self.solvent,
            old.antisolvent + share * self.antisolvent,
        )


@equipment(
    "antisolvent_batch_crystallizer",
    source="mullin2001, ch. 8 and 9; yalkowsky1981; jones1974",
    title="Batch crystallizer with antisolvent (drowning out)",
    equation=r"m_a(t) = m_a\left(\frac{t}{t_f}\right)^p,\quad C^* = C^*(T, w)",
)
class AntisolventBatchCrystallizer(Colliding, CycledVessel):
    """Batches of a continuous feed into which an antisolvent runs that lowers the solubility; outlets are
    means over the cycle.

    The antisolvent comes by a power of time: 1 is a constant stream; with more it begins slowly, while
    there is little surface for the solute to grow on. It is mixed in at once, at the temperature of the
    vessel, and may hold water as the feed may hold some of it. Crystals that come with either are seeds
    from the start, together with ``seed_mass_per_solvent`` of the solvent charged, which is held back
    from the product. The crystal must be free of solvent. Without a law of dissolution, seeds wait until
    the solution is saturated, and what has grown stays where too much antisolvent dilutes, which a check
    tells. Births are counted on a liquor of the density that it has at the end; heat of mixing and excess
    volume of the two solvents are left out.
    """

    temperature: Temperature
    duration: Annotated[Time, Within(1.0, math.inf)] = eqx.field(kw_only=True)
    addition_exponent: PositiveNumber = eqx.field(kw_only=True, default=1.0)
    second_solvent: str = eqx.field(kw_only=True, static=True, default="")

    limits: ClassVar[Limits] = CycledVessel.limits | {
        "diluted": Limit(
            "solute at the end over what is soluble", 1.0, math.inf, "dimensionless", "mullin2001, ch. 8"
        )
    }

    utilities: ClassVar[Utilities] = STIRRED | HEATED | COOLED

    def inside(self, feed: Stream, antisolvent: Stream) -> Grown:
        found, second = drowning_roles(self, feed.mixture)
        met = feed + antisolvent
        first, added = (s.liquid[found.solvent] + s.liquid[second] for s in (feed, antisolvent))
        operation = Dosed(
            self.temperature,
            self.duration,
            self.addition_exponent,
            feed.liquid[second],
            antisolvent.liquid[found.solute],
            added,
            antisolvent.liquid[second],
        )
        model = self._model(met.replace(temperature=self.temperature), found)
        grown = self._grown(model, operation, feed.replace(solid=met.solid), found, first)
        self.calm(grown.course)
        # once more where its flags are heard: inside what is compiled they are lost
        self.solubility(self.temperature, antisolvent_share(met, found, second))
        return grown

    def outlets(self, inside: Grown, feed: Stream, antisolvent: Stream) -> BatchOutlets:
        met, found, classes = feed + antisolvent, inside.found, inside.kept(feed.mixture.edges)
        dissolved = jnp.sum(feed_of(met, found).crystals) - jnp.sum(classes)
        product = met.replace(
            solid=with_crystals(met, found, classes),
            liquid=met.liquid.at[found.solute].add(dissolved),
            temperature=jnp.asarray(self.temperature, dtype=float),
        )
        return BatchOutlets(product, product.enthalpy_flow - feed.enthalpy_flow - antisolvent.enthalpy_flow)

    def figures(
        self, inside: Grown, outlets: BatchOutlets, feed: Stream, antisolvent: Stream
    ) -> DrownedBatchFigures:
        met, found = feed + antisolvent, inside.found
        second = second_solvent_of(met.mixture, found, self.second_solvent)
        made, part, *rest = self._figures(inside, outlets.product, met)
        volume = outlets.product.slurry_volume_flow * self.cycle
        seed, share = self._seed(feed, found), antisolvent_share(met, found, second)
        stirrer = self.stirrer_figures(outlets.product, volume)
        return DrownedBatchFigures._make(
            (made, part, share, *rest, seed, volume, outlets.heat_duty, *stirrer)
        )

    def measured(
        self,
        inside: Grown,
        outlets: BatchOutlets,
        figures: DrownedBatchFigures,
        feed: Stream,
        antisolvent: Stream,
    ) -> dict[str, Any]:
        course = inside.course
        end = course.solute_per_solvent[-1] / course.solubility_per_solvent[-1]
        there = figures.crystal_flow > 0.0
        return super().measured(inside, outlets, figures, feed) | {"diluted": jnp.where(there, end, 1.0)}

    def drawn(
        self,
        inside: Grown,
        outlets: BatchOutlets,
        figures: DrownedBatchFigures,
        feed: Stream,
        antisolvent: Stream,
    ) -> dict[str, Any]:
        stirrer = self.stirrer_power(outlets.product, figures.volume)
        return thermal(outlets.heat_duty, feed, outlets.product) | stirrer
