"""A crystallizer for salts beside each other, cooled or evaporative, at equilibrium."""

from __future__ import annotations

from typing import Any, ClassVar, NamedTuple

import equinox as eqx
import jax.numpy as jnp

from granum.core import equipment
from granum.core.errors import CaseError, unknown_name
from granum.core.flags import unsolved
from granum.core.i18n import _
from granum.core.kinds import (
    Fraction,
    Length,
    MassFlow,
    MassFraction,
    PositiveNumber,
    Power,
    Pressure,
    Temperature,
    Time,
    WaterActivity,
)
from granum.core.limits import Limit
from granum.crystallization.equipment.brines import Salts, salts_of
from granum.crystallization.equipment.in_time import Crystallized
from granum.crystallization.equipment.roles import Roles, given_off, refuse_boiling, vapor_of
from granum.crystallization.kinds import VesselVolume
from granum.materials.brines import SOLVENT, Equilibrium, brine
from granum.numerics.smooth import safe_divide
from granum.particles.size_laws import LogNormal
from granum.streams.stream import Stream
from granum.streams.units import Limits, Unit, Utilities
from granum.streams.utilities import COOLED, HEATED, STIRRED, cooled, heated, suspended

_NOT_FOUND = (
    "What crystallizes beside what was not found: give more water, less evaporation or another temperature."
)
SOURCE = "greenberg1989; mullin2001, ch. 4"


class TwoSaltFigures(NamedTuple):
    """Figures of a crystallizer of two salts."""

    crystal_flow_first: MassFlow
    crystal_flow_second: MassFlow
    crystal_flow_double: MassFlow
    crystal_purity: Fraction
    solute_mass_fraction_first: MassFraction
    solute_mass_fraction_second: MassFraction
    saturation_first: PositiveNumber
    saturation_second: PositiveNumber
    water_activity: WaterActivity
    pressure: Pressure
    residence_time: Time
    evaporation: MassFlow
    heat_duty: Power


class Parted(NamedTuple):
    """Salts of the mixture, which of the brine's the two are, what is left in solution, and the stream that
    is.
    """

    salts: Salts
    chosen: tuple[int, int]
    left: Equilibrium
    product: Stream


@equipment(
    "two_salt_crystallizer",
    source=SOURCE,
    title="Crystallizer of salts beside each other, at equilibrium",
    equation=r"\prod_i \left(m_i\,\gamma_i\right)^{\nu_i} a_w^{h} \le K(T)\ \text{for each crystal}",
)
class TwoSaltCrystallizer(Unit):
    """Cools or evaporates a solution of two salts and leaves it at equilibrium: what is saturated beside the
    others crystallizes, one salt, or more where the solution has reached an invariant point.

    Each salt alone has the solubility of the library, what they do to each other follows from Pitzer's
    equations; known for sodium and potassium with chloride or nitrate, for chlorides of sodium, potassium,
    magnesium and calcium beside each other, and for chlorides and sulfates of sodium, potassium and
    magnesium. Double salts of these (glaserite, carnallite, kainite, schoenite, leonite, bloedite)
    crystallize where they are among the solids of the mixture, and are told of where they are not. Two salts
    without a common ion make a reciprocal pair: give all four among the liquids, their
    ions are exchanged, and what is dissolved of each says no more than how many ions there are. Crystals
    that form are those of the mixture, of the given sizes: there are no kinetics here. The pressure is that
    at which the solution boils at its temperature. Crystals that come with the feed dissolve where the
    solution has room.
    """

    temperature: Temperature
    volume: VesselVolume
    evaporation: MassFlow = eqx.field(kw_only=True, default=0.0)
    crystal_size: Length = eqx.field(kw_only=True, default=400e-6)
    geometric_standard_deviation: PositiveNumber = eqx.field(kw_only=True, default=1.6)
    first_salt: str = eqx.field(kw_only=True, static=True, default="")
    second_salt: str = eqx.field(kw_only=True, static=True, default="")

    limits: ClassVar[Limits] = {
        "crowded": Limit(
            "solids in the suspension by volume", 0.0, 0.35, "dimensionless", "mullin2001, ch. 9"
        ),
        "saturated": Limit(
            "dissolved over solubility at the outlet", 0.0, 1.0001, "dimensionless", "mullin2001, ch. 3"
        ),
        "time": Limit("residence time", 600.0, 36000.0, "s", "mullin2001, ch. 9"),
    }

    utilities: ClassVar[Utilities] = STIRRED | HEATED | COOLED

    def _chosen(self, salts: Salts) -> tuple[int, int]:
        """Places among the brine's salts of the two that figures are given of: those named, or the first two
        that crystallize.
        """
        names = [s.name for s in salts.brine.salts]
        for name in (self.first_salt, self.second_salt):
            if name and name not in names:
                raise unknown_name(_("Salt"), name, names)
        forms = [salts.brine.crystals[k] for k in salts.which]
        crystallizing = list(dict.fromkeys(f.salt for f in forms if f.salt is not None))
        others = [
            k
            for k in dict.fromkeys((*crystallizing, *range(len(names))))
            if names[k] not in (self.first_salt, self.second_salt)
        ]
        first = names.index(self.first_salt) if self.first_salt else others.pop(0)
        return first, names.index(self.second_salt) if self.second_salt else others.pop(0)

    def inside(self, feed: Stream) -> Parted:
        salts = salts_of(feed.mixture)
        if salts is None or not salts.forming:
            names = [s.name for s in feed.mixture.liquids]
            if len(names) < 3 or names[0] != SOLVENT:
                raise CaseError(_("Two salts in water are needed among the liquids, water first."))
            brine(names[1:], feed.mixture.materials)
            raise CaseError(_("The mixture has no solid that could crystallize."))
        T = jnp.asarray(self.temperature, dtype=float)
        dissolved = salts.all_dissolved(feed).at[0].add(-self.evaporation)
        made = salts.brine.equilibrium(T, dissolved[0], salts.ions(dissolved), salts.which)
        liquid = salts.left(dissolved, made.crystals)
        sizes = LogNormal(self.crystal_size, self.geometric_standard_deviation)
        solid = salts.crystallized(feed, made.crystals, sizes)
        salts.heard(T, made.molalities)
        unsolved(made.found, type(self).card, reason=_NOT_FOUND)
        product = feed.replace(solid=solid, liquid=liquid, gas=0.0 * feed.gas, temperature=T)
        return Parted(salts, self._chosen(salts), made, product)

    def outlets(self, inside: Parted, feed: Stream) -> Crystallized:
        T, product = jnp.asarray(self.temperature, dtype=float), inside.product
        place = Roles(inside.salts.forming[0].solid, 0, 0, vapor_of(feed.mixture, 0), 1.0)
        vapor = given_off(feed, place, self.evaporation, T)
        if place.vapor is not None:
            refuse_boiling(self.evaporation, product, feed, place, type(self).card)
        return Crystallized(product, vapor, product.enthalpy_flow + vapor.enthalpy_flow - feed.enthalpy_flow)

    def figures(self, inside: Parted, outlets: Crystallized, feed: Stream) -> TwoSaltFigures:
        T, (salts, chosen, left, product) = self.temperature, inside
        kinds = [salts.brine.crystals[k].salt for k in salts.which]
        flows = list(left.crystals * jnp.asarray(salts.crystal_masses))
        made = [
            sum((f for f, k in zip(flows, kinds, strict=True) if k == salt), jnp.zeros(()))
            for salt in (*chosen, None)
        ]
        every = jnp.sum(jnp.stack(flows))
        ratios = salts.brine.saturation(T, left.molalities)
        full = [
            jnp.max(jnp.stack([ratios[i] for i, c in enumerate(salts.brine.crystals) if c.salt == salt]))
            for salt in chosen
        ]
        fractions = [product.liquid_fractions[salts.liquids[salt]] for salt in chosen]
        activity = salts.brine.water_activity(T, left.molalities)
        water = feed.mixture.materials.fluid(SOLVENT)
        return TwoSaltFigures(
            made[0],
            made[1],
            made[2],
            jnp.where(every > 0.0, safe_divide(jnp.max(jnp.stack(flows)), every, 1.0), 1.0),
            fractions[0],
            fractions[1],
            jnp.exp(full[0]),
            jnp.exp(full[1]),
            activity,
            activity * water.vapor_pressure.value(jnp.asarray(T, dtype=float)),
            safe_divide(self.volume, product.slurry_volume_flow),
            jnp.asarray(self.evaporation, dtype=float),
            outlets.heat_duty,
        )

    def measured(
        self, inside: Parted, outlets: Crystallized, figures: TwoSaltFigures, feed: Stream
    ) -> dict[str, Any]:
        ratios = inside.salts.brine.saturation(self.temperature, inside.left.molalities)
        return {
            "crowded": outlets.product.solids_volume_fraction,
            "saturated": jnp.exp(jnp.max(ratios)),
            "time": figures.residence_time,
        }

    def drawn(
        self, inside: Parted, outlets: Crystallized, figures: TwoSaltFigures, feed: Stream
    ) -> dict[str, Any]:
        duty, T = outlets.heat_duty, self.temperature
        agitator = {"electric_power_agitator": suspended(outlets.product, self.volume)}
        return heated(duty, T) | cooled(duty, T) | agitator
