"""A stirred vessel in which crystals dissolve, as far as the liquor has room for them."""

from __future__ import annotations

from typing import Any, ClassVar, NamedTuple

import equinox as eqx
import jax.numpy as jnp

from granum.core import equipment
from granum.core.errors import CaseError
from granum.core.i18n import _
from granum.core.kinds import MassFlow, Number, Power, Temperature, Time
from granum.core.limits import Limit
from granum.crystallization.equipment.batch import BatchOutlets
from granum.crystallization.equipment.roles import Roles, roles, suspension_left
from granum.crystallization.kinds import Solubility, VesselVolume
from granum.crystallization.vessels.crystals import crystals_at
from granum.numerics.smooth import safe_divide
from granum.streams.mixture import Mixture
from granum.streams.stream import Stream
from granum.streams.units import Limits, Unit, Utilities
from granum.streams.utilities import COOLED, HEATED, STIRRED, cooled, heated, suspended


class DissolverFigures(NamedTuple):
    """Figures of a dissolver."""

    dissolved_flow: MassFlow
    undissolved_flow: MassFlow
    relative_saturation: Number
    residence_time: Time
    heat_duty: Power


@equipment(
    "dissolver",
    source="mullin2001, ch. 3 and 6",
    title="Dissolver of crystals",
    equation=r"\dot m_{c} = \max\left(\dot m_{c,0} - \dot m_{d},\,0\right)",
)
class Dissolver(Unit):
    """Dissolves the crystals of a suspension at a temperature, as many as the liquor has room for; none
    crystallize.

    The law holds for each solute whose crystals come in, beside the others: that of one enantiomer for both.
    With ``solid`` only these crystals dissolve. What is left is at equilibrium; the time that dissolving
    takes is not followed, nor does the size of what is left change. The heat of dissolution is part of the
    duty.
    """

    temperature: Temperature
    volume: VesselVolume
    solubility: Solubility = eqx.field(kw_only=True)
    solid: str = eqx.field(kw_only=True, static=True, default="")
    solvent: str = eqx.field(kw_only=True, static=True, default="")

    limits: ClassVar[Limits] = {
        "room": Limit(
            "dissolved over solubility at the outlet", 0.0, 0.98, "dimensionless", "mullin2001, ch. 3"
        ),
        "time": Limit("residence time", 300.0, 36000.0, "s", "mullin2001, ch. 6"),
    }
    utilities: ClassVar[Utilities] = STIRRED | HEATED | COOLED

    def _dissolving(self, mixture: Mixture) -> list[Roles]:
        """Which crystals dissolve: those named, or all that have a dissolved form."""
        if self.solid:
            return [roles(mixture, self.solid, self.solvent)]
        found = []
        for species in mixture.solids:
            try:
                found.append(roles(mixture, species.name, self.solvent))
            except CaseError:
                continue
        if not found:
            raise CaseError(_("No crystals of the mixture have a dissolved form among its liquids."))
        return found

    def inside(self, feed: Stream) -> list[Roles]:
        return self._dissolving(feed.mixture)

    def outlets(self, inside: list[Roles], feed: Stream) -> BatchOutlets:
        product, C = feed, self.solubility(self.temperature)
        for role in inside:
            crystals, x = jnp.sum(product.solid[role.solid]), role.solute_fraction
            solute = product.liquid[role.solute] + x * crystals
            solvent = product.liquid[role.solvent] + (1.0 - x) * crystals
            melts = x <= (1.0 - x) * C
            left = jnp.where(melts, 0.0, crystals_at(solute, solvent, C, jnp.where(melts, 1.0, x)))
            kept = safe_divide(jnp.clip(left, 0.0, crystals), crystals, 0.0)
            solid = product.solid.at[role.solid].multiply(kept)
            product = suspension_left(product, role, solid, 0.0, self.temperature)
        return BatchOutlets(product, product.enthalpy_flow - feed.enthalpy_flow)

    def figures(self, inside: list[Roles], outlets: BatchOutlets, feed: Stream) -> DissolverFigures:
        product, C = outlets.product, self.solubility(self.temperature)
        left = sum(jnp.sum(product.solid[role.solid]) for role in inside)
        ratios = [safe_divide(product.liquid[r.solute], product.liquid[r.solvent], 0.0) for r in inside]
        return DissolverFigures(
            sum(jnp.sum(feed.solid[role.solid]) for role in inside) - left,
            left,
            jnp.max(jnp.stack(ratios)) / C,
            safe_divide(self.volume, product.slurry_volume_flow),
            outlets.heat_duty,
        )

    def measured(
        self, inside: list[Roles], outlets: BatchOutlets, figures: DissolverFigures, feed: Stream
    ) -> dict[str, Any]:
        return {"room": figures.relative_saturation, "time": figures.residence_time}

    def drawn(
        self, inside: list[Roles], outlets: BatchOutlets, figures: DissolverFigures, feed: Stream
    ) -> dict[str, Any]:
        duty, T = outlets.heat_duty, self.temperature
        agitator = {"electric_power_agitator": suspended(outlets.product, self.volume)}
        return heated(duty, T) | cooled(duty, T) | agitator
