"""A crystallizer for two salts with a common ion, cooled or evaporative, at equilibrium."""

from __future__ import annotations

from typing import Any, ClassVar, NamedTuple

import equinox as eqx
import jax.numpy as jnp

from granum.core import equipment
from granum.core.errors import CaseError
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
from granum.crystallization.equipment.in_time import Crystallized
from granum.crystallization.equipment.roles import given_off, refuse_boiling, roles, with_crystals
from granum.crystallization.kinds import VesselVolume
from granum.crystallization.vessels.common_ion import parted
from granum.materials.common_ion import CommonIon, common_ion
from granum.numerics.smooth import safe_divide
from granum.particles.size_laws import LogNormal
from granum.streams.stream import Stream
from granum.streams.units import Limits, Unit, Utilities
from granum.streams.utilities import COOLED, HEATED, STIRRED, cooled, heated, suspended

WATER = "water"
SOURCE = "greenberg1989; mullin2001, ch. 4"


class TwoSaltFigures(NamedTuple):
    """Figures of a crystallizer of two salts."""

    crystal_flow_first: MassFlow
    crystal_flow_second: MassFlow
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
    """Water left and molality of both salts in it, crystals of both (kg/s), the pair and its places in the
    mixture.
    """

    water: Any
    molalities: tuple[Any, Any]
    crystals: tuple[Any, Any]
    pair: CommonIon
    places: tuple[Any, Any]


@equipment(
    "two_salt_crystallizer",
    source=SOURCE,
    title="Crystallizer of two salts with a common ion, at equilibrium",
    equation=(
        r"m_{M}\,m_{X}\,\gamma_{\pm,MX}^2 \le K_{MX}(T),\quad "
        r"m_{N}\,m_{X}\,\gamma_{\pm,NX}^2 \le K_{NX}(T)"
    ),
)
class TwoSaltCrystallizer(Unit):
    """Cools or evaporates a solution of two salts that share an ion, and leaves it at equilibrium: one salt
    crystallizes while the other stays below saturation, both where the solution has reached the invariant
    point.

    Each salt alone has the solubility of the library, what they do to each other follows from Pitzer's
    equations; known for sodium and potassium chloride. Fresh crystals have the given sizes: there are no
    kinetics here. The pressure is that at which the solution boils at its temperature. Crystals that come
    with the feed dissolve where the solution has room.
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
        "time": Limit("residence time", 600.0, 36000.0, "s", "mullin2001, ch. 9"),
    }

    utilities: ClassVar[Utilities] = STIRRED | HEATED | COOLED

    def inside(self, feed: Stream) -> Parted:
        m = feed.mixture
        names = [s.name for s in m.liquids]
        if len(names) < 3:
            raise CaseError(_("Two salts in water are needed among the liquids."))
        salts = [name for name in names if name != WATER]
        chosen = (self.first_salt or salts[0], self.second_salt or salts[1])
        places = tuple(roles(m, name, WATER) for name in chosen)
        pair = common_ion(*chosen, m.materials)
        water = feed.liquid[places[0].solvent] - self.evaporation
        masses, T = pair.molar_masses, self.temperature
        crystals = [jnp.sum(feed.solid[p.solid]) for p in places]
        amounts = [(feed.liquid[p.solute] + c) / M for p, c, M in zip(places, crystals, masses, strict=True)]
        some = water > 0.0
        given = [jnp.where(some, n / jnp.where(some, water, 1.0), 0.0) for n in amounts]
        left = parted(pair, T, *given)
        # by difference, so that what stays dissolved to the last gram makes no crystals by rounding
        made = [
            jnp.where(some, jnp.maximum(g - kept, 0.0) * water * M, n * M)
            for g, kept, n, M in zip(given, left, amounts, masses, strict=True)
        ]
        pair.saturation(T, *left)  # once more where its flags are heard
        return Parted(water, left, (made[0], made[1]), pair, (places[0], places[1]))

    def outlets(self, inside: Parted, feed: Stream) -> Crystallized:
        liquid = feed.liquid.at[inside.places[0].solvent].set(inside.water)
        solid = feed.solid
        passing = LogNormal(self.crystal_size, self.geometric_standard_deviation)(
            jnp.asarray(feed.mixture.edges)
        )
        shares = jnp.diff(passing.at[0].set(0.0).at[-1].set(1.0))
        for place, made in zip(inside.places, inside.crystals, strict=True):
            grown = feed.solid[place.solid]
            fed = jnp.sum(grown, axis=tuple(range(1, grown.ndim)))
            before = jnp.sum(fed)
            kept = fed * jnp.minimum(safe_divide(made, before, 0.0), 1.0)
            classes = kept + shares * jnp.maximum(made - before, 0.0)
            solid = with_crystals(feed.replace(solid=solid), place, classes)
            liquid = liquid.at[place.solute].add(before - made)
        T = jnp.asarray(self.temperature, dtype=float)
        product = feed.replace(solid=solid, liquid=liquid, gas=0.0 * feed.gas, temperature=T)
        vapor = given_off(feed, inside.places[0], self.evaporation, T)
        if inside.places[0].vapor is not None:
            refuse_boiling(self.evaporation, product, feed, inside.places[0], type(self).card)
        return Crystallized(product, vapor, product.enthalpy_flow + vapor.enthalpy_flow - feed.enthalpy_flow)

    def figures(self, inside: Parted, outlets: Crystallized, feed: Stream) -> TwoSaltFigures:
        T, made = self.temperature, inside.crystals
        product = outlets.product
        fractions = [product.liquid_fractions[p.solute] for p in inside.places]
        ratios = inside.pair.saturation(T, *(jnp.maximum(m, 1e-12) for m in inside.molalities))
        activity = inside.pair.water_activity(T, *inside.molalities)
        water = feed.mixture.materials.fluid(WATER)
        every = made[0] + made[1]
        return TwoSaltFigures(
            made[0],
            made[1],
            jnp.where(every > 0.0, safe_divide(jnp.maximum(*made), every, 1.0), 1.0),
            fractions[0],
            fractions[1],
            jnp.exp(ratios[0]),
            jnp.exp(ratios[1]),
            activity,
            activity * water.vapor_pressure.value(jnp.asarray(T, dtype=float)),
            safe_divide(self.volume, product.slurry_volume_flow),
            jnp.asarray(self.evaporation, dtype=float),
            outlets.heat_duty,
        )

    def measured(
        self, inside: Parted, outlets: Crystallized, figures: TwoSaltFigures, feed: Stream
    ) -> dict[str, Any]:
        return {"crowded": outlets.product.solids_volume_fraction, "time": figures.residence_time}

    def drawn(
        self, inside: Parted, outlets: Crystallized, figures: TwoSaltFigures, feed: Stream
    ) -> dict[str, Any]:
        duty, T = outlets.heat_duty, self.temperature
        agitator = {"electric_power_agitator": suspended(outlets.product, self.volume)}
        return heated(duty, T) | cooled(duty, T) | agitator
