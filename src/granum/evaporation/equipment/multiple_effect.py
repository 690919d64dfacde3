"""Evaporators in series, each heated by the vapor of the one before."""

from __future__ import annotations

import abc
from collections.abc import Mapping
from typing import Annotated, Any, ClassVar, Literal, NamedTuple

import equinox as eqx
import jax
import jax.numpy as jnp
from jax import lax

from granum.core import equipment
from granum.core.errors import InputError
from granum.core.flags import unsolved
from granum.core.i18n import _
from granum.core.kinds import (
    HeatTransferCoefficient,
    MassFlow,
    MassFraction,
    Power,
    Pressure,
    Ratio,
    Series,
    Temperature,
)
from granum.core.limits import Limit
from granum.evaporation.boiling import Effect, Liquor, boil, condensed, entrained
from granum.evaporation.equipment.evaporator import Heating
from granum.evaporation.formulas.steam_jet import WEAK, motive_steam_ratio_el_dessouky
from granum.evaporation.inside_charts import drawn_effects
from granum.evaporation.kinds import EVAPORATION_SOURCE
from granum.numerics import fixed_point
from granum.numerics.smooth import safe_divide
from granum.streams.stream import Stream, empty
from granum.streams.units import Limits, Operated
from granum.streams.utilities import HEAT_APPROACH, heated

TOO_MUCH = (
    "The steam jet would suck more vapor than its effect makes: give motive steam of a lower pressure, or "
    "let it suck from an effect with a lower pressure."
)
UNSOLVED = (
    "The pressures between the effects were not found: give steam of a higher pressure, a lower pressure in "
    "the last effect, fewer effects, a smaller area or a warmer feed."
)


class TrainFigures(NamedTuple):
    """Figures of a multiple-effect evaporator."""

    evaporation_rate: MassFlow
    steam_flow: MassFlow
    steam_economy: Ratio
    solute_mass_fraction: MassFraction
    crystal_flow: MassFlow
    heat_duty: Power
    temperature_steam: Temperature
    temperature_first: Temperature
    temperature_last: Temperature
    pressure_first: Pressure
    temperature_difference_lost: Ratio


class JetFigures(NamedTuple):
    """Figures of a multiple-effect evaporator with a steam jet."""

    evaporation_rate: MassFlow
    steam_flow: MassFlow
    steam_economy: Ratio
    solute_mass_fraction: MassFraction
    crystal_flow: MassFlow
    heat_duty: Power
    temperature_steam: Temperature
    temperature_first: Temperature
    temperature_last: Temperature
    pressure_first: Pressure
    temperature_difference_lost: Ratio
    motive_steam_ratio: Ratio
    pressure_suction: Pressure


class FromTrain(NamedTuple):
    """Concentrated solution, vapor of the last effect, condensate of the vapors of the others, heat of the
    steam.
    """

    product: Stream
    vapor: Stream
    condensate: Stream
    heat_duty: Any


class Suction(NamedTuple):
    """What a steam jet takes: the place of its effect, the share of the vapor there, its condensate in the
    first chest, the motive steam per vapor, and the heat of motive steam by mass.
    """

    place: int
    share: Any
    condensate: Stream
    ratio: Any
    heat: Any


class Train(NamedTuple):
    """The effects by falling pressure, products and vapors with drops, condensates, temperature of the
    steam.
    """

    liquor: Liquor
    effects: list[Effect]
    products: list[Stream]
    vapors: list[Stream]
    condensates: list[Stream]
    chest: Any
    suction: Suction | None = None


class _Effects(Heating):
    """What trains of effects share."""

    feeding: Literal["forward", "backward", "parallel"] = eqx.field(
        kw_only=True, static=True, default="forward"
    )
    effect_count: Literal["2", "3", "4", "5", "6", "7"] = eqx.field(kw_only=True, static=True, default="3")
    heat_transfer_coefficient_first: HeatTransferCoefficient = eqx.field(kw_only=True, default=2500.0)
    heat_transfer_coefficient_last: HeatTransferCoefficient = eqx.field(kw_only=True, default=1200.0)
    heat_transfer_coefficient_effects: Annotated[HeatTransferCoefficient, Series("effects")] | None = (
        eqx.field(kw_only=True, default=None)
    )

    limits: ClassVar[Limits] = Heating.limits | {
        "lost": Limit(
            "share of the temperature difference lost to boiling-point elevation",
            0.0,
            0.6,
            "dimensionless",
            EVAPORATION_SOURCE,
        )
    }

    def __check_init__(self) -> None:
        each = self.heat_transfer_coefficient_effects
        if each is not None and len(each) != int(self.effect_count):
            raise InputError(
                _(
                    "'heat_transfer_coefficient_effects' has {given} values for {count} effects: give one "
                    "for each."
                ).format(given=len(each), count=self.effect_count),
                name="heat_transfer_coefficient_effects",
            )

    def _coefficients(self) -> list[Any]:
        """Of each effect as given, or in equal steps of their logarithm from the first to the last."""
        n = int(self.effect_count)
        if self.heat_transfer_coefficient_effects is not None:
            return [self.heat_transfer_coefficient_effects[i] for i in range(n)]
        first, last = self.heat_transfer_coefficient_first, self.heat_transfer_coefficient_last
        return [first * (last / first) ** (i / (n - 1)) for i in range(n)]

    def _conductances(self) -> Any:
        return jnp.stack([jnp.asarray(self.conductance(c), dtype=float) for c in self._coefficients()])

    def _pass(self, liquor: Liquor, feed: Stream, chest: Any, pure: list[Any]) -> Train:
        """All effects at given boiling points of the solvent."""
        walls = self._conductances()
        temperatures = jnp.stack([jnp.asarray(T, dtype=float) for T in (chest, *pure)])
        parallel = self.feeding == "parallel"
        part = 1.0 / len(pure) if parallel else 1.0
        whole = feed.part(solid=part, liquid=part, gas=part)
        start = jax.tree.map(lambda x: jnp.asarray(x, dtype=float), whole)

        def one(entering: Stream, of: tuple[Any, Any, Any]) -> tuple[Stream, tuple[Effect, Stream, Stream]]:
            behind, boiling, wall = of
            made = boil(liquor, entering, behind, boiling, wall, self.sizes)
            product, vapor = entrained(made, self.drop_entrainment)
            return (entering if parallel else product), (made, product, vapor)

        _last, made = lax.scan(
            one, start, (temperatures[:-1], temperatures[1:], walls), reverse=self.feeding == "backward"
        )
        effects, products, vapors = (
            [jax.tree.map(lambda x, i=i: x[i], stacked) for i in range(len(pure))] for stacked in made
        )
        suction = self.suction(liquor, effects, vapors, chest)
        if suction is not None:
            left = 1.0 - suction.share
            vapors[suction.place] = vapors[suction.place].part(liquid=left, gas=left)
        condensates = [condensed(liquor, vapor, T) for vapor, T in zip(vapors[:-1], pure, strict=False)]
        return Train(liquor, effects, products, vapors, condensates, chest, suction)

    @abc.abstractmethod
    def suction(self, liquor: Liquor, effects: list[Effect], vapors: list[Stream], chest: Any) -> Any:
        """What a steam jet takes of the vapors, if there is one."""

    def inside(self, feed: Stream) -> Train:
        liquor = self.liquor(feed)
        chest = liquor.pure_boiling(self.pressure_steam)
        coldest = liquor.pure_boiling(self.pressure)
        walls = jnp.stack([1.0 / jnp.asarray(c, dtype=float) for c in self._coefficients()])
        shares = jnp.cumsum(walls)[:-1] / jnp.sum(walls)
        through = self._conductances()
        # of what is missing, if each vapor held just the heat that made it; the method learns the rest
        between = jnp.diag(through[1:-1], 1)
        slopes = jnp.diag(through[:-1] + through[1:]) - between - between.T

        def given(state: Any) -> list[Any]:
            return [*(state[i] for i in range(len(shares))), coldest]

        def nearer(state: Any, _args: Any) -> Any:
            train = self._pass(liquor, feed, chest, given(state))
            missing = [
                train.effects[i + 1].duty - vapor.enthalpy_flow + train.condensates[i].enthalpy_flow
                for i, vapor in enumerate(train.vapors[:-1])
            ]
            return state - jnp.linalg.solve(slopes, jnp.stack(missing))

        found = fixed_point(
            nearer,
            chest - (chest - coldest) * shares,
            tolerance=1e-12,
            scale=jnp.full(len(shares), 10.0),
        )
        unsolved(found.residual < 1e-10, type(self).card, reason=UNSOLVED)
        train = self._pass(liquor, feed, chest, given(found.state))
        if train.suction is not None:
            unsolved(train.suction.share < 1.0, type(self).card, reason=TOO_MUCH)
        for made in train.effects:
            self.settled(liquor, made)
            liquor.excess(made.temperature, made.pure, made.product.liquid)  # where its flags are heard
        return train

    def charts(self, made: Operated, inlets: Mapping[str, Stream]) -> dict[str, Any]:
        train: Train = made.inside
        if not float(inlets["feed"].liquid_flow) > 0.0:
            return {}
        return {_("From effect to effect"): drawn_effects(train.effects, train.chest)}

    def outlets(self, inside: Train, feed: Stream) -> FromTrain:
        product = {
            "forward": inside.products[-1],
            "backward": inside.products[0],
            "parallel": _together(inside.products),
        }[self.feeding]
        jet = [] if inside.suction is None else [inside.suction.condensate]
        condensate = _together([*inside.condensates, *jet])
        # from the streams, so that the inner iteration leaves no trace in the balance
        duty = (
            product.enthalpy_flow
            + inside.vapors[-1].enthalpy_flow
            + condensate.enthalpy_flow
            - feed.enthalpy_flow
        )
        return FromTrain(product, inside.vapors[-1], condensate, duty)

    def told(self, inside: Train, outlets: FromTrain, feed: Stream, heat: Any) -> TrainFigures:
        """Figures, where steam gives a heat by mass."""
        gone = jnp.sum(jnp.stack([made.evaporation for made in inside.effects]))
        steam = outlets.heat_duty / heat
        first, last = inside.effects[0], inside.effects[-1]
        lost = jnp.sum(jnp.stack([made.temperature - made.pure for made in inside.effects]))
        return TrainFigures(
            gone,
            steam,
            safe_divide(gone, steam, 0.0),
            1.0 - safe_divide(outlets.product.liquid[0], outlets.product.liquid_flow, 1.0),
            jnp.maximum(jnp.sum(outlets.product.solid) - jnp.sum(feed.solid), 0.0),
            outlets.heat_duty,
            inside.chest,
            first.temperature,
            last.temperature,
            first.pressure,
            safe_divide(lost, inside.chest - last.pure, 1.0),
        )

    def measured(self, inside: Train, outlets: FromTrain, figures: Any, feed: Stream) -> dict[str, Any]:
        behind = [inside.chest, *(made.pure for made in inside.effects[:-1])]
        differences = [hot - made.temperature for hot, made in zip(behind, inside.effects, strict=True)]
        return {
            "difference": jnp.min(jnp.stack(differences)),
            "crowded": outlets.product.solids_volume_fraction,
            "saturated": jnp.max(jnp.stack([inside.liquor.saturation(p) for p in inside.products])),
            "lost": figures.temperature_difference_lost,
        }

    def drawn(self, inside: Train, outlets: FromTrain, figures: Any, feed: Stream) -> dict[str, Any]:
        area = {"area_installed": int(self.effect_count) * self.area}
        return heated(outlets.heat_duty, self.supplied(inside) - HEAT_APPROACH) | area

    @abc.abstractmethod
    def supplied(self, inside: Train) -> Any:
        """Temperature at which the steam that is bought condenses, K."""


@equipment(
    "multiple_effect_evaporator",
    source="mccabe2005, ch. 16; geankoplis2003, § 8.5",
    title="Multiple-effect evaporator",
    equation=r"UA\,(T_{b,i-1} - \Delta T_{b,i-1} - T_{b,i}) = \dot H_{vapor,i-1} - \dot H_{condensate,i-1}",
)
class MultipleEffectEvaporator(_Effects):
    """Effects of equal area, as many as two to seven; steam heats the first, the vapor of each the next.

    ``pressure`` is that of the last effect; those between follow from areas and coefficients. The feed enters
    the first effect (forward), the last (backward) or all in equal parts (parallel). Boiling-point elevation,
    crystals and simplifications as in ``evaporation.evaporator``; condensates leave together, not flashed.
    """

    def suction(self, liquor: Liquor, effects: list[Effect], vapors: list[Stream], chest: Any) -> Any:
        return None

    def supplied(self, inside: Train) -> Any:
        return inside.chest

    def figures(self, inside: Train, outlets: FromTrain, feed: Stream) -> TrainFigures:
        return self.told(inside, outlets, feed, inside.liquor.latent(inside.chest))


@equipment(
    "steam_jet_evaporator",
    source="mccabe2005, ch. 16; eldessouky1997",
    title="Multiple-effect evaporator with a steam jet",
    equation=r"\dot m_m\,(h_m - h_c) + \frac{\dot m_m}{\mathrm{Ra}}\,(h_v - h_c) = \dot Q_1",
)
class SteamJetEvaporator(_Effects):
    """Thermal vapor recompression: effects as in ``multiple_effect_evaporator``, of one of which
    a jet of motive steam sucks a part of the vapor and presses it into the first chest.

    It sucks from the first effect unless ``suction_effect`` names another, as much as El-Dessouky's fit to
    Power's chart lets it. Motive steam is dry and saturated, and the jet loses no heat. Of water vapor only.
    """

    pressure_motive: Pressure = eqx.field(kw_only=True)
    suction_effect: Literal["1", "2", "3", "4", "5", "6", "7"] = eqx.field(
        kw_only=True, static=True, default="1"
    )

    limits: ClassVar[Limits] = _Effects.limits | {
        "jet": Limit("pressure ratio of the steam jet", 1.0, 6.0, "dimensionless", "eldessouky1997"),
        "motive": Limit("pressure of the motive steam", 1e5, 3.5e6, "Pa", "eldessouky1997"),
    }

    def __check_init__(self) -> None:
        if int(self.suction_effect) > int(self.effect_count):
            raise InputError(
                _("There are {count} effects: the jet cannot suck from number {effect}.").format(
                    count=self.effect_count, effect=self.suction_effect
                ),
                name="suction_effect",
            )

    def inside(self, feed: Stream) -> Train:
        unsolved(jnp.asarray(self.pressure_motive) > self.pressure_steam, type(self).card, reason=WEAK)
        return super().inside(feed)

    def suction(self, liquor: Liquor, effects: list[Effect], vapors: list[Stream], chest: Any) -> Any:
        place = int(self.suction_effect) - 1
        vapor, effect = vapors[place], effects[place]
        ratio = motive_steam_ratio_el_dessouky.function(
            self.pressure_motive, effect.pressure, self.pressure_steam, effect.temperature
        )
        whole = condensed(liquor, vapor, chest)
        behind = self.supplied_to(liquor)
        liquids = [liquor.mixture.enthalpies("liquids", T)[0] for T in (behind, chest)]
        heat = liquids[0] + liquor.latent(behind) - liquids[1]
        flow = jnp.maximum(vapor.gas[liquor.vapor], 1e-12)
        given = (vapor.enthalpy_flow - whole.enthalpy_flow) / flow
        share = effects[0].duty / (ratio * heat + given) / flow
        return Suction(place, share, whole.part(liquid=share, gas=share), ratio, heat)

    def supplied_to(self, liquor: Liquor) -> Any:
        """Temperature of the motive steam, K."""
        return liquor.pure_boiling(self.pressure_motive)

    def supplied(self, inside: Train) -> Any:
        return self.supplied_to(inside.liquor)

    def figures(self, inside: Train, outlets: FromTrain, feed: Stream) -> JetFigures:
        assert inside.suction is not None
        told = self.told(inside, outlets, feed, inside.suction.heat)
        return JetFigures(*told, inside.suction.ratio, inside.effects[inside.suction.place].pressure)

    def measured(self, inside: Train, outlets: FromTrain, figures: Any, feed: Stream) -> dict[str, Any]:
        return super().measured(inside, outlets, figures, feed) | {
            "jet": jnp.asarray(self.pressure_steam) / figures.pressure_suction,
            "motive": jnp.asarray(self.pressure_motive, dtype=float),
        }


def _together(streams: list[Stream]) -> Stream:
    total = empty(streams[0].mixture, streams[0].temperature, streams[0].pressure)
    for stream in streams:
        total = total + stream
    return total
