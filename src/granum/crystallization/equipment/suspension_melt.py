"""Crystallization of a melt as a suspension whose crystals a wash column parts from their mother liquor."""

from __future__ import annotations

import math
from typing import Annotated, Any, ClassVar, NamedTuple

import equinox as eqx
import jax.numpy as jnp

from granum.core import equipment
from granum.core.errors import CaseError
from granum.core.flags import collect, unsolved
from granum.core.i18n import _, quoted
from granum.core.kinds import (
    Area,
    Density,
    DynamicViscosity,
    Fraction,
    HeatCapacity,
    Length,
    MassFlow,
    MassFraction,
    Power,
    PressureDifference,
    Ratio,
    SpecificEnergy,
    Temperature,
    Time,
    Velocity,
    VoidFraction,
    Volume,
    Within,
)
from granum.core.limits import Limit
from granum.crystallization.equipment.layer_melt import TOO_IMPURE, impurity_in
from granum.crystallization.formulas.melt import freezing_temperature_ideal
from granum.crystallization.formulas.wash_columns import impurity_ratio_wash_column, wash_front
from granum.crystallization.kinds import InclusionShare, OpenShare
from granum.numerics import find_root
from granum.numerics.smooth import safe_divide
from granum.porous.displacement import axial_dispersion
from granum.porous.formulas.darcy import pressure_drop_darcy
from granum.porous.formulas.kozeny import permeability_carman
from granum.streams.stream import Stream
from granum.streams.units import Limits, Unit, Utilities
from granum.streams.utilities import COOLED, HEATED, cooled, heated

DIFFUSIVITY = 1e-9  # m²/s of an impurity in the melt, next to nothing beside the dispersion between grains
LEAST_PURE = 1e-6  # mole fraction, with which a melt that cannot freeze so far is refused elsewhere
TOO_WARM = "The crystallizer is not colder than the melting point of the pure substance: cool it further."
SHUT = "The melt that freezes at the wash front shuts the bed: give a warmer crystallizer or a looser bed."
UNWASHED = "More wash returns than the column melts: give a smaller wash ratio."


class SuspensionMeltFigures(NamedTuple):
    """Figures of a suspension crystallizer with its wash column."""

    product_mass_flow: MassFlow
    product_recovery: Ratio
    impurity_fraction_product: MassFraction
    impurity_fraction_residue: MassFraction
    impurity_ratio_washed: Ratio
    crystal_flow: MassFlow
    wash_flow: MassFlow
    recrystallized_share: Ratio
    void_fraction_washed: VoidFraction
    area: Area
    pressure_drop: PressureDifference
    volume: Volume
    heat_duty: Power


class SuspensionMeltOutlets(NamedTuple):
    """Molten product, mother liquor, and the heat taken up on the whole."""

    product: Stream
    residue: Stream
    heat_duty: Any


class Washed(NamedTuple):
    """What the column does: impurity of the product over that of the mother liquor, share of the impurity fed
    that ends in the product, crystals per product, wash per crystal, melt frozen at the front per crystal,
    voids above it, the product's place, impurity fed, temperature of the crystallizer, whether the bed is
    open above the front.
    """

    ratio: Any
    impurity_share: Any
    crystals: Any
    wash: Any
    frozen: Any
    voids: Any
    pure: int
    others: Any
    temperature: Any
    is_open: Any


@equipment(
    "suspension_melt_crystallizer",
    source="arkenbout1995; player1969; schroder1893; jansens2000",
    title="Melt crystallizer with a suspension and a wash column",
    equation=r"\dot m_P = \dot m_c\,[1 + b\,(1 - w)],\quad "
    r"b = (1+r)\,\frac{\varepsilon'\rho_l}{(1-\varepsilon')\rho_c}",
)
class SuspensionMeltCrystallizer(Unit):
    """Freezes a share of a melt as a suspension; a wash column packs the crystals, washes the bed with molten
    product that flows against it, and melts them.

    All mother liquor leaves as the residue, at the temperature of the crystallizer, which is its freezing
    point: that of an ideal melt, unless it is given. The wash ratio counts what passes the front unfrozen, in
    voids of the washed bed: 1 just fills them. The bed disperses the front as grains do; of the voids a share
    stays unwashed, and crystals hold inclusions; what is melted returns in part with the wash. Solids and gas
    that come in leave with the residue. The pressure drop is that of the washed height, by Darcy and Carman;
    what pushes the bed must overcome it.
    """

    melting_temperature: Temperature
    heat_of_fusion: SpecificEnergy
    frozen_fraction: OpenShare
    dynamic_viscosity: DynamicViscosity
    temperature_crystallizer: Temperature | None = eqx.field(kw_only=True, default=None)
    crystal_size: Length = eqx.field(kw_only=True, default=300e-6)
    wash_ratio: Annotated[Ratio, Within(0.0, 3.0)] = eqx.field(kw_only=True, default=1.05)
    wash_efficiency: Fraction = eqx.field(kw_only=True, default=0.999)
    inclusion_fraction: InclusionShare = eqx.field(kw_only=True, default=0.0)
    bed_velocity: Annotated[Velocity, Within(1e-7, 1.0)] = eqx.field(kw_only=True, default=1e-3)
    washed_height: Annotated[Length, Within(1e-3, 20.0)] = eqx.field(kw_only=True, default=0.2)
    void_fraction: VoidFraction = eqx.field(kw_only=True, default=0.4)
    crystal_density: Density = eqx.field(kw_only=True, default=1200.0)
    specific_heat_capacity: HeatCapacity = eqx.field(kw_only=True, default=1500.0)
    solids_mass_fraction: Annotated[MassFraction, Within(0.01, 0.6)] = eqx.field(kw_only=True, default=0.3)
    residence_time: Time = eqx.field(kw_only=True, default=7200.0)
    impurity_fraction_eutectic: Fraction = eqx.field(kw_only=True, default=1.0)
    pure_liquid: str = eqx.field(kw_only=True, static=True, default="")

    limits: ClassVar[Limits] = {
        "eutectic": Limit(
            "impurity in the residue", 0.0, "impurity_fraction_eutectic", "dimensionless", "jansens2000"
        ),
        "displaced": Limit("wash over the voids", 1.0, 1.5, "dimensionless", "arkenbout1995"),
        "open": Limit("voids of the washed bed", 0.2, 0.7, "dimensionless", "arkenbout1995"),
        "pressed": Limit("pressure drop over the washed bed", -math.inf, 1e6, "Pa", "arkenbout1995"),
    }

    utilities: ClassVar[Utilities] = HEATED | COOLED

    def inside(self, feed: Stream) -> Washed:
        names = [s.name for s in feed.mixture.liquids]
        if not names:
            raise CaseError(_("The mixture has no liquid that could freeze."))
        pure = feed.mixture.index("liquids", self.pure_liquid) if self.pure_liquid else 0
        given, card = self.temperature_crystallizer, type(self).card
        T = self._freezing(feed, pure) if given is None else jnp.asarray(given, dtype=float)
        there = jnp.asarray(True) if given is not None else feed.liquid_flow > feed.liquid[pure]
        unsolved((self.melting_temperature > T) | ~there, card, reason=TOO_WARM)
        washed, made = self._washed(feed, pure, T)
        unsolved(washed.is_open, card, reason=SHUT)
        unsolved(made > 0.0, card, reason=UNWASHED)
        left = (1.0 - self.frozen_fraction) * feed.liquid_flow - (1.0 - washed.impurity_share) * washed.others
        unsolved(left >= -1e-12 * feed.liquid_flow, card, reason=TOO_IMPURE)
        return washed

    def _washed(self, feed: Stream, pure: int, temperature: Any) -> tuple[Washed, Any]:
        """The column under crystals as cold as this, and the product per crystal."""
        colder = jnp.maximum(self.melting_temperature - temperature, 1e-6)
        front = wash_front(colder, self.specific_heat_capacity, self.heat_of_fusion, self.void_fraction)
        frozen = front.recrystallized_share
        is_open = front.void_fraction_washed > 0.0
        voids = jnp.where(is_open, front.void_fraction_washed, self.void_fraction)
        liquor = feed.liquid_density / self.crystal_density
        held = (1.0 + frozen) * voids / (1.0 - voids) * liquor
        wash = frozen + held * self.wash_ratio
        product = 1.0 + held * (1.0 - self.wash_ratio)
        made = jnp.where(product > 0.0, product, 1.0)
        unreached = (1.0 - self.wash_efficiency) * self.void_fraction / (1.0 - self.void_fraction)
        carried = (unreached + self.inclusion_fraction) * liquor / made
        ratio = jnp.minimum(self._left(made, wash, frozen, held, carried), 1.0)
        g = self.frozen_fraction
        share = g * ratio / (g * ratio + 1.0 - g)
        others = feed.liquid_flow - feed.liquid[pure]
        return Washed(
            ratio, share, 1.0 / made, wash, frozen, voids, pure, others, temperature, is_open
        ), product

    def _freezing(self, feed: Stream, pure: int) -> Any:
        """Freezing point of the mother liquor that is left, K: an ideal melt.

        What the column lets through and the freezing point tell each other; the root lies between a column
        that holds back nothing and one that holds back all.
        """
        masses = [s.molar_mass for s in feed.mixture.liquids]
        unknown = [s.name for s in feed.mixture.liquids if not s.molar_mass > 0.0]
        if unknown:
            raise CaseError(
                _(
                    "The freezing point of the mother liquor needs the molar mass of {names}: give it in the "
                    "materials, or give 'temperature_crystallizer'."
                ).format(names=", ".join(quoted(name) for name in unknown))
            )
        flowing = feed.liquid_flow > 0.0
        liquid = jnp.where(flowing, feed.liquid, 1.0)
        whole = feed.replace(liquid=liquid)

        def beginning(share: Any) -> Any:
            up = self._product(whole, pure, share, whole.liquid_flow - whole.liquid[pure])
            moles = (whole.liquid - up) / jnp.asarray(masses)
            x = jnp.maximum(safe_divide(moles[pure], jnp.sum(moles), 1.0), LEAST_PURE)
            with collect():
                return freezing_temperature_ideal(
                    x, self.melting_temperature, self.heat_of_fusion, masses[pure]
                )

        def misses(T: Any) -> Any:
            with collect():
                return T - beginning(self._washed(whole, pure, T)[0].impurity_share)

        found = find_root(misses, beginning(0.0) - 1e-6, beginning(self.frozen_fraction) + 1e-6)
        return found.value

    def _product(self, feed: Stream, pure: int, share: Any, others: Any) -> Any:
        """Liquids that go up, kg/s, with this share of the impurity."""
        up = self.frozen_fraction * feed.liquid_flow - share * others
        return (feed.liquid * share).at[pure].set(jnp.clip(up, 0.0, feed.liquid[pure]))

    def _left(self, made: Any, wash: Any, frozen: Any, held: Any, carried: Any) -> Any:
        """Impurity that rises through the washed bed, over that of the mother liquor."""
        pore = self.bed_velocity / held  # of a flow equal to that of the crystals, m/s
        dispersion = axial_dispersion(wash * pore, self.crystal_size, DIFFUSIVITY)
        reflux = (1.0 + frozen - made) / made
        number = made * pore * self.washed_height / dispersion
        return impurity_ratio_wash_column(reflux, number, carried)

    def outlets(self, inside: Washed, feed: Stream) -> SuspensionMeltOutlets:
        up = self._product(feed, inside.pure, inside.impurity_share, inside.others)
        product = feed.replace(
            solid=0.0 * feed.solid,
            gas=0.0 * feed.gas,
            liquid=up,
            temperature=jnp.asarray(self.melting_temperature, dtype=float),
        )
        residue = feed.replace(liquid=feed.liquid - up, temperature=inside.temperature)
        return SuspensionMeltOutlets(
            product, residue, product.enthalpy_flow + residue.enthalpy_flow - feed.enthalpy_flow
        )

    def figures(self, inside: Washed, outlets: SuspensionMeltOutlets, feed: Stream) -> SuspensionMeltFigures:
        pure, made = inside.pure, outlets.product.liquid_flow
        crystals = inside.crystals * made
        area = crystals / (self.crystal_density * (1.0 - self.void_fraction) * self.bed_velocity)
        wash = inside.wash * crystals
        superficial = safe_divide(wash, area * feed.liquid_density, 0.0)
        permeability = permeability_carman(self.crystal_size, inside.voids)
        share = self.solids_mass_fraction
        slurry = crystals * (1.0 / self.crystal_density + (1.0 / share - 1.0) / feed.liquid_density)
        return SuspensionMeltFigures(
            made,
            safe_divide(outlets.product.liquid[pure], feed.liquid[pure], 0.0),
            impurity_in(outlets.product, pure),
            impurity_in(outlets.residue, pure),
            inside.ratio,
            crystals,
            wash,
            inside.frozen,
            inside.voids,
            area,
            pressure_drop_darcy(superficial, permeability, self.dynamic_viscosity, self.washed_height),
            slurry * self.residence_time,
            outlets.heat_duty,
        )

    def measured(
        self, inside: Washed, outlets: SuspensionMeltOutlets, figures: SuspensionMeltFigures, feed: Stream
    ) -> dict[str, Any]:
        return {
            "eutectic": figures.impurity_fraction_residue,
            "displaced": self.wash_ratio,
            "open": figures.void_fraction_washed,
            "pressed": figures.pressure_drop,
        }

    def drawn(
        self, inside: Washed, outlets: SuspensionMeltOutlets, figures: SuspensionMeltFigures, feed: Stream
    ) -> dict[str, Any]:
        melted = figures.crystal_flow * (1.0 + inside.frozen) * self.heat_of_fusion
        rest = outlets.heat_duty - melted
        hot = heated(melted + jnp.maximum(rest, 0.0), self.melting_temperature)
        return hot | cooled(jnp.minimum(rest, 0.0), inside.temperature)
