"""Crystallization of a melt as layers on cooled walls, in stages against each other."""

from __future__ import annotations

from typing import Any, ClassVar, Literal, NamedTuple

import equinox as eqx
import jax.numpy as jnp

from granum.core import equipment
from granum.core.errors import CaseError
from granum.core.flags import unsolved
from granum.core.i18n import _
from granum.core.kinds import (
    Area,
    Density,
    Distance,
    Fraction,
    GrowthRate,
    MassFlow,
    MassFraction,
    MassTransferCoefficient,
    Power,
    Ratio,
    SpecificEnergy,
    Temperature,
    Time,
)
from granum.core.limits import Limit
from granum.crystallization.formulas.melt import (
    distribution_coefficient_effective,
    impurity_ratio_sweating,
    segregation_freezing,
)
from granum.crystallization.kinds import DistributionCoefficient, OpenShare
from granum.numerics.smooth import safe_divide
from granum.streams.stream import Stream
from granum.streams.units import Limits, Unit, Utilities
from granum.streams.utilities import AREA, COOLED, HEATED, cooled, heated

JANSENS = "jansens2000"
TOO_IMPURE = (
    "The residue would hold more impurity than there is room for: freeze a smaller share, use fewer stages "
    "below the feed, or give a purer feed."
)


class LayerFigures(NamedTuple):
    """Figures of a layer crystallizer."""

    product_mass_flow: MassFlow
    product_recovery: Ratio
    impurity_fraction_product: MassFraction
    impurity_fraction_residue: MassFraction
    distribution_coefficient_effective: Ratio
    impurity_ratio_stage: Ratio
    layer_flow: MassFlow
    freezing_time: Time
    cycle_time: Time
    area: Area
    heat_duty: Power


class LayerOutlets(NamedTuple):
    """Molten product, the melt that is left, and the heat taken up on the whole."""

    product: Stream
    residue: Stream
    heat_duty: Any


class Staged(NamedTuple):
    """What the stages do: shares of melt and of impurity that end in the product, melt that enters all stages
    over the feed, ratio of one stage, its effective coefficient, the product's place, impurity fed.
    """

    product_share: Any
    impurity_share: Any
    treated: Any
    stage_ratio: Any
    effective: Any
    pure: int
    others: Any


def through(keeps: Any, above: int, below: int) -> tuple[Any, Any]:
    """Share of the feed that leaves at the top of a row of stages, each handing ``keeps`` of what enters it
    upwards and the rest downwards, and what enters all stages over the feed.
    """
    n = above + below
    ahead = jnp.eye(n, k=-1) * keeps + jnp.eye(n, k=1) * (1.0 - keeps)
    entering = jnp.linalg.solve(jnp.eye(n) - ahead, jnp.zeros(n).at[below].set(1.0))
    return keeps * entering[-1], jnp.sum(entering)


@equipment(
    "layer_melt_crystallizer",
    source="jansens2000; gilbert1991; burton1953; pfann1952",
    title="Melt crystallizer with layers on cooled walls, in stages",
    equation=r"\frac{\bar C_s}{C_0} = \frac{1-(1-g)^{k_{eff}}}{g}\,(1-s)^{1/k_s - 1}",
)
class LayerMeltCrystallizer(Unit):
    """Freezes a share of a melt as a layer on cooled walls, lets the layer sweat, melts it, and does so again
    in further stages: the product of a stage feeds the next, its residue and what sweats off the one before.

    The feed enters above the stages that recover product from the residue. Impurity enters the layer as the
    growth rate and the mass transfer in the melt let it (Burton, Prim and Slichter) and collects in the melt
    (Pfann); what sweats off is described by a measured coefficient. Coefficients are taken as the same in all
    stages and for all impurities. The melt is supposed to be mixed, as in a falling film; solids that come in
    leave with the residue. Purging before and melting after each layer is in the time without growth.
    """

    melting_temperature: Temperature
    heat_of_fusion: SpecificEnergy
    distribution_coefficient: DistributionCoefficient
    layer_growth_rate: GrowthRate
    diffusion_coefficient: MassTransferCoefficient
    frozen_fraction: OpenShare = 0.6
    sweated_fraction: OpenShare = eqx.field(kw_only=True, default=0.1)
    sweating_coefficient: DistributionCoefficient = eqx.field(kw_only=True, default=0.3)
    layer_thickness: Distance = eqx.field(kw_only=True, default=8e-3)
    crystal_density: Density = eqx.field(kw_only=True, default=1200.0)
    dead_time: Time = eqx.field(kw_only=True, default=3600.0)
    impurity_fraction_eutectic: Fraction = eqx.field(kw_only=True, default=1.0)
    stages_above: Literal["1", "2", "3", "4", "5", "6"] = eqx.field(kw_only=True, static=True, default="2")
    stages_below: Literal["0", "1", "2", "3", "4"] = eqx.field(kw_only=True, static=True, default="1")
    pure_liquid: str = eqx.field(kw_only=True, static=True, default="")

    limits: ClassVar[Limits] = {
        "grown": Limit("growth of the layer", 1e-8, 1e-5, "m/s", JANSENS),
        "frozen": Limit("melt frozen in a stage", 0.0, 0.9, "dimensionless", JANSENS),
        "eutectic": Limit(
            "impurity in the residue", 0.0, "impurity_fraction_eutectic", "dimensionless", JANSENS
        ),
        "thick": Limit("thickness of the layer", 1e-3, 0.05, "m", JANSENS),
    }

    utilities: ClassVar[Utilities] = HEATED | COOLED | AREA

    def inside(self, feed: Stream) -> Staged:
        names = [s.name for s in feed.mixture.liquids]
        if not names:
            raise CaseError(_("The mixture has no liquid that could freeze."))
        pure = feed.mixture.index("liquids", self.pure_liquid) if self.pure_liquid else 0
        k = distribution_coefficient_effective(
            self.distribution_coefficient, self.layer_growth_rate, self.diffusion_coefficient
        )
        layer = segregation_freezing(k, self.frozen_fraction).impurity_ratio_layer
        ratio = layer * impurity_ratio_sweating(self.sweating_coefficient, self.sweated_fraction)
        keeps = self.frozen_fraction * (1.0 - self.sweated_fraction)
        above, below = int(self.stages_above), int(self.stages_below)
        product, treated = through(keeps, above, below)
        impurity, _treated = through(keeps * ratio, above, below)
        others = feed.liquid_flow - feed.liquid[pure]
        left = (1.0 - product) * feed.liquid_flow - (1.0 - impurity) * others
        unsolved(left >= -1e-12 * feed.liquid_flow, type(self).card, reason=TOO_IMPURE)
        return Staged(product, impurity, treated, ratio, k, pure, others)

    def outlets(self, inside: Staged, feed: Stream) -> LayerOutlets:
        impure = feed.liquid * inside.impurity_share
        pure = inside.product_share * feed.liquid_flow - inside.impurity_share * inside.others
        up = impure.at[inside.pure].set(jnp.clip(pure, 0.0, feed.liquid[inside.pure]))
        T = jnp.asarray(self.melting_temperature, dtype=float)
        product = feed.replace(solid=0.0 * feed.solid, gas=0.0 * feed.gas, liquid=up, temperature=T)
        residue = feed.replace(liquid=feed.liquid - up, temperature=T)
        return LayerOutlets(
            product, residue, product.enthalpy_flow + residue.enthalpy_flow - feed.enthalpy_flow
        )

    def figures(self, inside: Staged, outlets: LayerOutlets, feed: Stream) -> LayerFigures:
        pure = inside.pure
        grown = self.frozen_fraction * inside.treated * feed.liquid_flow
        freezing = self.layer_thickness / self.layer_growth_rate
        cycle = freezing + self.dead_time
        return LayerFigures(
            outlets.product.liquid_flow,
            safe_divide(outlets.product.liquid[pure], feed.liquid[pure], 0.0),
            impurity_in(outlets.product, pure),
            impurity_in(outlets.residue, pure),
            inside.effective,
            inside.stage_ratio,
            grown,
            freezing,
            cycle,
            grown * cycle / (self.layer_thickness * self.crystal_density),
            outlets.heat_duty,
        )

    def measured(
        self, inside: Staged, outlets: LayerOutlets, figures: LayerFigures, feed: Stream
    ) -> dict[str, Any]:
        return {
            "grown": self.layer_growth_rate,
            "frozen": self.frozen_fraction,
            "eutectic": figures.impurity_fraction_residue,
            "thick": self.layer_thickness,
        }

    def drawn(
        self, inside: Staged, outlets: LayerOutlets, figures: LayerFigures, feed: Stream
    ) -> dict[str, Any]:
        latent, duty = figures.layer_flow * self.heat_of_fusion, outlets.heat_duty
        T = self.melting_temperature
        return (
            heated(latent + jnp.maximum(duty, 0.0), T)
            | cooled(-latent + jnp.minimum(duty, 0.0), T)
            | {"area_installed": figures.area}
        )


def impurity_in(stream: Stream, pure: int) -> Any:
    """Mass fraction of all liquids but one."""
    return safe_divide(stream.liquid_flow - stream.liquid[pure], stream.liquid_flow, 0.0)
