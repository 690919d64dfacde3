"""Continuous precipitator of a hydroxide in a line: a metal falls as alkali runs in, and the pH with it."""

from __future__ import annotations

from typing import NamedTuple

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
    Time,
    Velocity,
)
from granum.crystallization.equipment.batch import BatchOutlets
from granum.crystallization.equipment.precipitator import HYDROXIDE, Precipitating, Reacted
from granum.crystallization.vessels.precipitation import HydroxideEquilibrium
from granum.streams.exchange import Exchange
from granum.streams.stream import Stream

ACID = (
    "Without any alkali left the metal still falls, by water alone, and leaves an acid, for which the "
    "liquids have no place: feed more of the alkali or less of the metal."
)


class HydroxideFigures(NamedTuple):
    """Figures of a continuous precipitator of a hydroxide."""

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
    ph_value: Number
    cation_molality: Molality


@equipment(
    "hydroxide_precipitator",
    source="stumm1996, ch. 7; mullin2001, ch. 8; davies1962, ch. 3; randolph1988, ch. 4",
    title="Continuous precipitator of a hydroxide, with its pH",
    equation=(
        r"S = \left(\frac{\gamma_c m_c\,(\gamma_1 m_{OH})^q}{K_{sp}}\right)^{1/(1+q)},\quad "
        r"m_{OH} - m_H = q\,m_c^{fed} - \dots,\quad \mathrm{pH} = \mathrm{p}K_w + \log_{10}\gamma_1 m_{OH}"
    ),
    typical={"volume": (0.1, 10.0)},
)
class HydroxidePrecipitator(Precipitating):
    """Mixed vessel into which a solution of a metal and one of an alkali run, whose hydroxide crystallizes by
    nucleation and growth, at the pH that the balance of charges leaves.

    As ``precipitator``, with water's own ions: hydroxide less hydrogen is what all other ions leave to be
    balanced. Complexes with hydroxide are not counted, so that amphoteric metals (zinc, aluminum, chromium,
    lead) fall more completely here than they do beyond their best pH; nor is carbonate from the air. A metal
    that falls from a neutral solution is refused where it is in excess of the alkali: it would leave an acid.

    What stays in solution is what growth leaves, not the solubility alone: magnesium with just its equivalent
    of lye keeps some 8 % after 20 min, under 2 % after ten times as long or with a fifth more lye.
    """

    def _equilibrium(self, way: Exchange) -> HydroxideEquilibrium:
        if way.salt.anion != HYDROXIDE:
            raise CaseError(
                _("'{solid}' is no hydroxide: '{unit}' precipitates salts.").format(
                    solid=way.salt.label, unit="crystallization.precipitator"
                )
            )
        return HydroxideEquilibrium(way.salt, way.anhydrous_mass)

    def inside(self, feed: Stream, reagent: Stream) -> Reacted:
        made = super().inside(feed, reagent)
        spent, saturated = made.reacting.measures(jnp.zeros_like(made.mixed))
        unsolved(spent <= saturated, type(self).card, "acid", ACID)
        return made

    def figures(
        self, inside: Reacted, outlets: BatchOutlets, feed: Stream, reagent: Stream
    ) -> HydroxideFigures:
        there = inside.reacting.contents(inside.state.solute_per_solvent)
        equilibrium = inside.reacting.equilibrium
        assert isinstance(equilibrium, HydroxideEquilibrium)
        wet = outlets.product.liquid_flow > 0.0
        cation, _anion = equilibrium.molalities(there, 0.0)
        return HydroxideFigures(
            *self._common(inside, outlets, feed, reagent),
            jnp.where(wet, equilibrium.ph_value(there), 7.0),
            jnp.where(wet, cation, 0.0),
        )
