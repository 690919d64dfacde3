"""Continuous precipitator in a line: two solutions exchange ions, and a sparingly soluble salt falls out."""

from __future__ import annotations

import math
from abc import abstractmethod
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
    Molality,
    NucleationRate,
    Number,
    PositiveNumber,
    Power,
    RotationSpeed,
    SpecificPower,
    Temperature,
    Time,
    Velocity,
)
from granum.core.limits import Limit
from granum.crystallization.equipment.batch import BatchOutlets
from granum.crystallization.equipment.colliding import UNSOLVED_CROWD, Colliding
from granum.crystallization.equipment.msmpr import STEADY
from granum.crystallization.equipment.roles import SMALLEST, Roles, with_crystals
from granum.crystallization.equipment.stirring import SUSPENDED, Stirred
from granum.crystallization.formulas.mixing_times import (
    induction_time_volume,
    mixing_time_engulfment,
    mixing_time_nienow,
)
from granum.crystallization.kinds import Growth, Nucleation, VesselVolume
from granum.crystallization.vessels.crystals import Crystal
from granum.crystallization.vessels.msmpr import Feed, SteadyState, steady_msmpr
from granum.crystallization.vessels.precipitation import LARGEST_STRENGTH, SaltEquilibrium
from granum.crystallization.vessels.reacting import (
    ByActivity,
    Held,
    ReactedVolume,
    Reacting,
    fed_ratio,
    scarcer,
)
from granum.materials.ions import ions_of
from granum.numerics.smooth import safe_divide
from granum.streams.exchange import Exchange, exchanges
from granum.streams.from_materials import solute_system
from granum.streams.mixture import Mixture
from granum.streams.stirrers import WATER
from granum.streams.stream import Stream, median_of
from granum.streams.units import Limits, Unit, Utilities
from granum.streams.utilities import COOLED, HEATED, STIRRED, cooled, heated

BEGUN = 0.01  # of the precipitate: crystals that end the induction time
STILLEST = 1e-9  # W/kg, of a vessel whose stirrer stands
LONGEST = 1e12  # s, where nothing is ever born
HYDROXIDE = "OH-"

UNSOLVED = (
    "No supersaturation was found at which the crystals made are those that the reaction leaves: check "
    "feeds, volume and kinetics."
)


class PrecipitatorFigures(NamedTuple):
    """Figures of a continuous precipitator."""

    crystal_flow: MassFlow
    yield_fraction: Number
    magma_density: Concentration
    supersaturation_ratio: PositiveNumber
    supersaturation_ratio_mixed: PositiveNumber
    ionic_strength: Molality
    growth_rate: GrowthRate
    nucleation_rate: NucleationRate
    residence_time: Time
    mass_median_size: Distance
    mixing_time: Time
    induction_time: Time
    heat_duty: Power
    rotation_speed_suspension: RotationSpeed
    tip_speed: Velocity
    specific_power_input: SpecificPower


class Reacted(NamedTuple):
    """The steady suspension, the streams that meet in it, how they react, and the ratio of precipitable salt
    to solvent before anything has precipitated.
    """

    state: SteadyState
    met: Stream
    way: Exchange
    solid: int
    reacting: Reacting
    mixed: Any
    crystal: Crystal


def exchange_of(mixture: Mixture, solid: int) -> tuple[Exchange, dict[int, Any]]:
    """How a solid comes from the liquids of a mixture, and the ions of each that has some."""
    names = [s.name for s in mixture.liquids]
    systems = {name: solute_system(mixture.materials, name, names[:1]) for name in names[1:]}
    formulas = {name: system.formula for name, system in systems.items() if system is not None}
    name = mixture.solids[solid].name
    ways = exchanges(mixture.materials, name, names, formulas)
    if len(ways) != 1:
        raise CaseError(
            _(
                "'{solid}' must come from one salt with its cation and one with its anion, whose other ions "
                "make a third: the liquids have {count} such ways. Name water first, then the three salts, "
                "as barium chloride, sodium sulfate and sodium chloride for barium sulfate."
            ).format(solid=name, count=len(ways))
        )
    ions = {names.index(n): found for n, formula in formulas.items() if (found := ions_of(formula))}
    return ways[0], ions


class Precipitating(Colliding, Stirred, Unit):
    """What the precipitators share; each says by which equilibrium its solid is dissolved."""

    temperature: Temperature
    volume: VesselVolume
    growth: Growth
    nucleation: Nucleation
    volume_shape_factor: PositiveNumber = eqx.field(kw_only=True, default=1.0)
    nucleus_size: Distance = eqx.field(kw_only=True, default=0.0)
    solid: str = eqx.field(kw_only=True, static=True, default="")

    limits: ClassVar[Limits] = (
        {name: limit for name, limit in STEADY.items() if name != "time"}
        | SUSPENDED
        | {
            "smallest": Limit(SMALLEST, 0.0, 0.05, "dimensionless", "randolph1988, ch. 4"),
            "mixed": Limit(
                "time of mixing over time of the first crystals", 0.0, 1.0, "dimensionless", "baldyga1999"
            ),
            "strength": Limit("ionic strength", 0.0, LARGEST_STRENGTH, "mol/kg", "davies1962, ch. 3"),
        }
    )

    utilities: ClassVar[Utilities] = STIRRED | HEATED | COOLED

    def inside(self, feed: Stream, reagent: Stream) -> Reacted:
        mixture = feed.mixture
        if not mixture.solids:
            raise CaseError(_("The mixture has no solid that could crystallize."))
        solid = mixture.index("solids", self.solid) if self.solid else 0
        way, ions = exchange_of(mixture, solid)
        equilibrium = self._equilibrium(way)
        met, T = feed + reagent, jnp.asarray(self.temperature, dtype=float)
        M, whole = way.anhydrous_mass, way.anhydrous_mass + way.water_mass
        x = M / whole
        amounts = (
            met.liquid[way.cation_source] / way.cation_mass,
            met.liquid[way.anion_source] / way.anion_mass,
        )
        dissolved, excess = scarcer(*(M * n for n in amounts))
        grown = met.solid[solid]
        crystals = jnp.sum(grown, axis=tuple(range(1, grown.ndim)))
        own = (ions[way.cation_source].cation, ions[way.anion_source].anion)
        spectators = sum(
            met.liquid[place]
            / found.anhydrous_mass
            * (
                found.cation_count * found.cation_charge**2 * (found.cation != own[0])
                + found.anion_count * found.anion_charge**2 * (found.anion != own[1])
            )
            for place, found in ions.items()
        )
        held = jnp.sum(crystals)
        reacting = Reacting(
            equilibrium,
            T,
            dissolved + x * held,
            met.liquid[0] + (1.0 - x) * held,
            excess,
            spectators,
            x,
        )
        mixed = fed_ratio(reacting, held)
        volumes = met.liquid / mixture.densities("liquids", T)
        per_mole = (
            way.cation_mass / mixture.densities("liquids", T)[way.cation_source]
            + way.anion_mass / mixture.densities("liquids", T)[way.anion_source]
            - way.byproduct_mass / mixture.densities("liquids", T)[way.byproduct]
        )
        others = jnp.sum(volumes) - volumes[0] - dissolved * per_mole / M
        crystal = Crystal(mixture.densities("solids", T)[solid], self.volume_shape_factor, x)
        state = steady_msmpr(
            Feed(dissolved, met.liquid[0], crystals),
            T,
            self.volume,
            Held(reacting.saturation(mixed)),
            ByActivity(self.growth, reacting),
            ByActivity(self.nucleation, reacting),
            crystal,
            ReactedVolume(per_mole / M, mixture.densities("liquids", T)[0], others),
            mixture.edges,
            nucleus_size=self.nucleus_size,
            collisions=self.collisions,
        )
        reason = UNSOLVED if self.collisions is None else UNSOLVED_CROWD
        unsolved(state.converged, type(self).card, reason=reason)
        return Reacted(state, met, way, solid, reacting, mixed, crystal)

    def outlets(self, inside: Reacted, feed: Stream, reagent: Stream) -> BatchOutlets:
        state, met, way = inside.state, inside.met, inside.way
        M = way.anhydrous_mass
        left = [(state.solute + more) / M for more in inside.reacting.excess]
        made = met.liquid[way.cation_source] / way.cation_mass - left[0]  # mol/s
        liquid = (
            met.liquid.at[0]
            .set(state.solvent)
            .at[way.cation_source]
            .set(left[0] * way.cation_mass)
            .at[way.anion_source]
            .set(left[1] * way.anion_mass)
            .at[way.byproduct]
            .add(made * way.byproduct_mass)
        )
        here = Roles(inside.solid, way.cation_source, 0, None, inside.crystal.solute_fraction)
        product = met.replace(
            solid=with_crystals(met, here, state.crystals),
            liquid=liquid,
            temperature=jnp.asarray(self.temperature, dtype=float),
        )
        return BatchOutlets(product, product.enthalpy_flow - feed.enthalpy_flow - reagent.enthalpy_flow)

    @abstractmethod
    def _equilibrium(self, way: Exchange) -> SaltEquilibrium:
        """Of the solid that falls; refuses one that is not of this kind."""

    def _common(
        self, inside: Reacted, outlets: BatchOutlets, feed: Stream, reagent: Stream
    ) -> PrecipitatorFigures:
        state, reacting = inside.state, inside.reacting
        M = inside.way.anhydrous_mass
        crystals, fed = jnp.sum(state.crystals), reacting.solute
        ratios = [
            safe_divide(*reacting.measures(ratio), 0.0) for ratio in (state.solute_per_solvent, inside.mixed)
        ]
        there = reacting.contents(state.solute_per_solvent)
        salt = reacting.equilibrium.salt
        charges = (
            there.solute * salt.cation_count * salt.cation_charge**2
            + there.partner * salt.anion_count * salt.anion_charge**2
        ) / M + there.spectators
        product = outlets.product
        made = self.stirred(product, self.volume)
        power = jnp.maximum(made.specific, STILLEST)
        viscosity = product.liquid_viscosity if made.known else WATER
        density = jnp.where(product.liquid_flow > 0.0, product.liquid_density, 1000.0)
        mixing = mixing_time_nienow.function(made.vessel, made.diameter, power)
        mixing = mixing + mixing_time_engulfment.function(
            jnp.where(product.liquid_flow > 0.0, viscosity, WATER), density, power
        )
        T = reacting.temperature
        measures = reacting.measures(inside.mixed)
        begins = induction_time_volume.function(
            BEGUN
            * safe_divide(fed / inside.crystal.solute_fraction, state.suspension_flow, 0.0)
            / inside.crystal.density,
            self.nucleation(*measures, T, state.magma_density),
            self.growth(*measures, T),
            self.volume_shape_factor,
        )
        return PrecipitatorFigures(
            crystals,
            safe_divide(inside.crystal.solute_fraction * crystals, fed),
            state.magma_density,
            ratios[0],
            ratios[1],
            jnp.where(product.liquid_flow > 0.0, 0.5 * charges / there.solvent, 0.0),
            state.growth_rate,
            state.nucleation_rate,
            state.residence_time,
            median_of(state.crystals, inside.met.mixture.edges),
            mixing,
            jnp.minimum(begins, LONGEST),
            outlets.heat_duty,
            *self.stirrer_figures(product, self.volume),
        )

    def measured(
        self,
        inside: Reacted,
        outlets: BatchOutlets,
        figures: Any,
        feed: Stream,
        reagent: Stream,
    ) -> dict[str, Any]:
        return {
            "crowded": outlets.product.solids_volume_fraction,
            "present": jnp.where(inside.state.washed_out, 0.0, 1.0),
            "largest": outlets.product.size_fractions[-1],
            "smallest": outlets.product.size_fractions[0],
            "mixed": safe_divide(figures.mixing_time, figures.induction_time, math.inf),
            "strength": figures.ionic_strength,
        } | self.stirrer_measured(outlets.product, self.volume)

    def drawn(
        self,
        inside: Reacted,
        outlets: BatchOutlets,
        figures: Any,
        feed: Stream,
        reagent: Stream,
    ) -> dict[str, Any]:
        duty, T = outlets.heat_duty, self.temperature
        return heated(duty, T) | cooled(duty, T) | self.stirrer_power(outlets.product, self.volume)


@equipment(
    "precipitator",
    source="mullin2001, ch. 8; davies1962, ch. 3; randolph1988, ch. 4",
    title="Continuous precipitator (reactive crystallization)",
    equation=(
        r"S = \left(\frac{(\gamma_c m_c)^p(\gamma_a m_a)^q}{K_{sp}}\right)^{1/(p+q)},\quad "
        r"M_T = 6\,k_v \rho_c B_0 G^3\tau^4"
    ),
    typical={"volume": (0.1, 10.0)},
)
class Precipitator(Precipitating):
    """Mixed vessel into which two solutions run, each with one ion of a sparingly soluble salt, which
    crystallizes by nucleation and growth.

    The driving force is that of ion activities (Davies) against the solubility product at the temperature:
    growth and nucleation laws take the ratio of the supersaturation S to 1. The supersaturation of the vessel
    is the one at which the crystals made are those that the ions leave; crystals that come with a feed grow
    on, and do not dissolve. All ions are free: complexes, hydrolysis and weak acids are not counted. The
    check of mixing compares the time to mix to 95 % and on the smallest scale with that in which 1 % of the
    crystals would form in both feeds, mixed: where mixing takes longer, the crystals depend on where the
    feeds run in, and are more and smaller. A precipitator wants a ``rotation_speed``: the least that keeps
    fine crystals off the bottom mixes slowly.
    """

    def _equilibrium(self, way: Exchange) -> SaltEquilibrium:
        if way.salt.anion == HYDROXIDE:
            raise CaseError(
                _(
                    "'{solid}' is a hydroxide, which dissolves by the pH: '{unit}' counts "
                    "the ions of water too."
                ).format(solid=way.salt.label, unit="crystallization.hydroxide_precipitator")
            )
        return SaltEquilibrium(way.salt, way.anhydrous_mass)

    def figures(
        self, inside: Reacted, outlets: BatchOutlets, feed: Stream, reagent: Stream
    ) -> PrecipitatorFigures:
        return self._common(inside, outlets, feed, reagent)
