"""One effect, heated by steam from outside or by its own vapor, compressed."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Annotated, Any, ClassVar, NamedTuple

import equinox as eqx
import jax.numpy as jnp

from granum.core import equipment
from granum.core.flags import beyond, unsolved
from granum.core.i18n import _
from granum.core.kinds import (
    Area,
    HeatTransferCoefficient,
    Length,
    MassFlow,
    MassFraction,
    PositiveNumber,
    Power,
    Pressure,
    Ratio,
    Temperature,
    TemperatureDifference,
    Within,
)
from granum.core.limits import Limit
from granum.evaporation.boiling import Effect, Liquor, boil, condensed, entrained
from granum.evaporation.inside_charts import drawn_boiling
from granum.evaporation.kinds import EVAPORATION_SOURCE, ThermalResistance
from granum.materials.brines import DRIEST
from granum.numerics.smooth import safe_divide
from granum.particles.size_laws import LogNormal
from granum.streams.formulas.drives import shaft_power_adiabatic
from granum.streams.stream import Stream
from granum.streams.units import Limits, Operated, Unit, Utilities, Utility
from granum.streams.utilities import AREA, HEAT_APPROACH, HEATED, driven, heated

STEAM_RATIO = 1.3  # of the heat capacities of low-pressure steam
COLD_CHEST = (
    "Nothing boils: the heating steam is not hotter than the boiling solution, or the feed takes up all its "
    "heat. Give steam of a higher pressure, a lower pressure over the solution or a warmer feed."
)
DRY = "The solvent boils off wholly: give more feed, a smaller area or steam of a lower pressure."
NOT_FOUND = (
    "No temperature was found at which the solution boils: give a smaller area, more feed or another "
    "pressure."
)
COLD_STEAM = (
    "The heating steam is not hotter than the boiling solution: give steam of a higher pressure or a lower "
    "pressure over the solution."
)
COLD_FEED = (
    "Nothing boils: the feed takes up all the heat. Give a warmer feed, a larger area or steam of a higher "
    "pressure."
)
OTHER_CRYSTAL = (
    "Another crystal of the solute forms there than the one in the mixture, such as one with less water "
    "where it is hot: add it to the solids, or give another pressure."
)
DRY_OUT = 1.001 * (1.0 - DRIEST)  # of the solvent: hardly more than what never boils off
Efficiency = Annotated[PositiveNumber, Within(0.01, 1.0)]
DropShare = Annotated[Ratio, Within(0.0, 0.1)]


class EvaporatorFigures(NamedTuple):
    """Figures of an evaporator of one effect."""

    evaporation_rate: MassFlow
    boiling_temperature: Temperature
    boiling_point_elevation: TemperatureDifference
    solute_mass_fraction: MassFraction
    crystal_flow: MassFlow
    heat_duty: Power
    temperature_steam: Temperature
    steam_flow: MassFlow
    steam_economy: Ratio


class Evaporated(NamedTuple):
    """Concentrated solution with its crystals, vapor with its drops, and the heat of the steam."""

    product: Stream
    vapor: Stream
    heat_duty: Any


class Recompressed(NamedTuple):
    """Concentrated solution, vapor that is not compressed, condensate of the rest; heat of the steam that is
    added, work of the compressor.
    """

    product: Stream
    vapor: Stream
    condensate: Stream
    heat_duty: Any
    shaft_power: Any


class Heating(Unit):
    """What evaporators share: the wall, the boiling-point elevation, the size of crystals that form."""

    area: Area
    pressure: Pressure
    pressure_steam: Pressure
    fouling_thermal_resistance: ThermalResistance = eqx.field(kw_only=True, default=0.0)
    drop_entrainment: DropShare = eqx.field(kw_only=True, default=0.0)
    elevation_linear: TemperatureDifference | None = eqx.field(kw_only=True, default=None)
    elevation_quadratic: TemperatureDifference | None = eqx.field(kw_only=True, default=None)
    crystal_size: Length = eqx.field(kw_only=True, default=400e-6)
    geometric_standard_deviation: Annotated[PositiveNumber, Within(1.01, 10.0)] = eqx.field(
        kw_only=True, default=1.5
    )

    limits: ClassVar[Limits] = {
        "difference": Limit(
            "temperature difference of an effect", 3.0, 50.0, "delta_degC", EVAPORATION_SOURCE
        ),
        "crowded": Limit(
            "solids in the suspension by volume", 0.0, 0.35, "dimensionless", "mullin2001, ch. 9"
        ),
        "saturated": Limit(
            "dissolved over solubility at the outlet", 0.0, 1.0001, "dimensionless", "mullin2001, ch. 3"
        ),
    }
    utilities: ClassVar[Utilities] = HEATED | AREA

    def liquor(self, feed: Stream) -> Liquor:
        """The solution, with the elevation that is given or that of the library."""
        given = (self.elevation_linear, self.elevation_quadratic)
        if all(part is None for part in given):
            return Liquor(feed.mixture, None)
        linear, quadratic = (0.0 if part is None else part for part in given)
        return Liquor(feed.mixture, (linear, quadratic))

    @property
    def sizes(self) -> LogNormal:
        """Of crystals that form."""
        return LogNormal(self.crystal_size, self.geometric_standard_deviation)

    def conductance(self, coefficient: Any) -> Any:
        """Of a wall, W/K."""
        return self.area / (1.0 / coefficient + self.fouling_thermal_resistance)

    def right_crystal(self, liquor: Liquor, made: Effect) -> None:
        """Say where another crystal of the solute forms than those of the mixture: not in a solution that is
        only thickened.
        """
        T, (low, high) = made.temperature, liquor.among(made.temperature)
        over = liquor.saturation(made.product, [f.roles.solute for f in liquor.crystals]) > 1.0
        wrong = over & ((low > T) | (high < T))
        beyond(wrong, T, "boiling_temperature", type(self).card, low, high, OTHER_CRYSTAL)

    def settled(self, liquor: Liquor, made: Effect) -> None:
        """Say where an effect has no solution."""
        card = type(self).card
        self.right_crystal(liquor, made)
        unsolved(made.found, card, reason=NOT_FOUND)
        unsolved(~made.found | (made.evaporation > 0.0), card, reason=COLD_CHEST)
        unsolved(made.left > DRY_OUT, card, reason=DRY)


class _Single(Heating):
    """One effect."""

    heat_transfer_coefficient: HeatTransferCoefficient = eqx.field(kw_only=True, default=2000.0)

    def effect(self, feed: Stream) -> tuple[Liquor, Effect, Any]:
        """The solution, the effect, and the temperature in the chest."""
        liquor = self.liquor(feed)
        chest = liquor.pure_boiling(self.pressure_steam)
        pure = liquor.pure_boiling(self.pressure)
        made = boil(liquor, feed, chest, pure, self.conductance(self.heat_transfer_coefficient), self.sizes)
        card, steam = type(self).card, jnp.asarray(self.pressure_steam, dtype=float)
        boils, cold = made.evaporation > 0.0, made.duty <= 0.0
        unsolved(made.found, card, reason=NOT_FOUND)
        self.right_crystal(liquor, made)
        least = liquor.vapor_pressure(made.temperature)
        beyond(made.found & cold, steam, "pressure_steam", card, low=least, reason=COLD_STEAM)
        needed = self.area * safe_divide(made.taken, made.duty, 0.0)
        beyond(made.found & ~cold & ~boils, self.area, "area", card, low=needed, reason=COLD_FEED)
        beyond(made.left <= DRY_OUT, self.area, "area", card, 0.0, needed, reason=DRY)
        return liquor, made, chest

    def charts(self, made: Operated, inlets: Mapping[str, Stream]) -> dict[str, Any]:
        feed = inlets["feed"]
        liquor, effect, chest = made.inside[:3]
        if not (len(feed.mixture.liquids) > 1 and float(jnp.sum(feed.liquid[1:])) > 0.0):
            return {}
        return {_("How the solution boils as it thickens"): drawn_boiling(liquor, effect, chest, feed)}

    def told(self, liquor: Liquor, made: Effect, chest: Any, bought: Any) -> EvaporatorFigures:
        """Figures, where some heat is bought as steam."""
        steam = bought / liquor.latent(chest)
        return EvaporatorFigures(
            made.evaporation,
            made.temperature,
            made.temperature - made.pure,
            1.0 - safe_divide(made.product.liquid[0], made.product.liquid_flow, 1.0),
            made.crystals,
            made.duty,
            chest,
            steam,
            safe_divide(made.evaporation, steam, 0.0),
        )

    def measured(self, inside: Any, outlets: Any, figures: EvaporatorFigures, feed: Stream) -> dict[str, Any]:
        return {
            "difference": figures.temperature_steam - figures.boiling_temperature,
            "crowded": outlets.product.solids_volume_fraction,
            "saturated": inside[0].saturation(outlets.product),
        }


@equipment(
    "evaporator",
    source=EVAPORATION_SOURCE,
    title="Evaporator of one effect",
    equation=r"\dot H_{feed} + UA\,(T_s - T_b) = \dot H_{product} + \dot H_{vapor}",
)
class Evaporator(_Single):
    """Boils a solution at a pressure with steam behind a wall; the vapor leaves at the boiling temperature of
    the solution.

    The boiling-point elevation follows from the water activity of the library's solutes, each as in its own
    solution with all the water, or from two given coefficients. Where the mixture has a crystal of a solute,
    the product is just saturated and fresh crystals have the given sizes: kinetics are those of the
    crystallizers; of several crystals of that solute the one forms that is stable at the boiling temperature.
    The pressure of the liquid column is left out. Heats of dilution count for the solutes that have a heat of
    mixing in the library, salts also together; where others' are more than 2 % of the duty it is told.
    """

    def inside(self, feed: Stream) -> tuple[Liquor, Effect, Any]:
        return self.effect(feed)

    def outlets(self, inside: tuple[Liquor, Effect, Any], feed: Stream) -> Evaporated:
        product, vapor = entrained(inside[1], self.drop_entrainment)
        return Evaporated(product, vapor, inside[1].duty)

    def figures(
        self, inside: tuple[Liquor, Effect, Any], outlets: Evaporated, feed: Stream
    ) -> EvaporatorFigures:
        return self.told(*inside, outlets.heat_duty)

    def drawn(
        self,
        inside: tuple[Liquor, Effect, Any],
        outlets: Evaporated,
        figures: EvaporatorFigures,
        feed: Stream,
    ) -> dict[str, Any]:
        return heated(outlets.heat_duty, inside[2] - HEAT_APPROACH) | {"area_installed": self.area}


@equipment(
    "recompression_evaporator",
    source=EVAPORATION_SOURCE,
    title="Evaporator with mechanical vapor recompression",
    equation=r"\dot Q = \sigma\left(\dot H_{vapor} + P - \dot H_{condensate}\right) + \dot Q_{steam}",
)
class RecompressionEvaporator(_Single):
    """Heats itself with its own vapor, compressed to the pressure of the chest; steam is added where the
    vapor is not enough, and vapor that is too much leaves.

    The compressor is adiabatic, in one stage, with steam as an ideal gas.
    """

    machine_efficiency: Efficiency = eqx.field(kw_only=True, default=0.75)

    limits: ClassVar[Limits] = Heating.limits | {
        "compression": Limit("pressure ratio of one stage", 1.0, 2.0, "dimensionless", "perry2008, § 11")
    }
    utilities: ClassVar[Utilities] = Heating.utilities | {
        "electric_power_compressor": Utility("mujumdar2014")
    }

    def inside(self, feed: Stream) -> tuple[Liquor, Effect, Any, Recompressed]:
        liquor, made, chest = self.effect(feed)
        product, vapor = entrained(made, self.drop_entrainment)
        whole = shaft_power_adiabatic(
            vapor.gas_volume_flow,
            self.pressure,
            self.pressure_steam,
            self.machine_efficiency,
            STEAM_RATIO,
        )
        condensate = condensed(liquor, vapor, chest).replace(
            pressure=jnp.asarray(self.pressure_steam, dtype=float)
        )
        there = vapor.enthalpy_flow + whole - condensate.enthalpy_flow
        share = jnp.clip(safe_divide(made.duty, there, 0.0), 0.0, 1.0)
        rest = 1.0 - share
        bought = jnp.where(there > 0.0, jnp.maximum(made.duty - there, 0.0), made.duty)
        return (
            liquor,
            made,
            chest,
            Recompressed(
                product,
                vapor.part(liquid=rest, gas=rest),
                condensate.part(liquid=share),
                bought,
                share * whole,
            ),
        )

    def outlets(self, inside: tuple[Liquor, Effect, Any, Recompressed], feed: Stream) -> Recompressed:
        return inside[3]

    def figures(
        self, inside: tuple[Liquor, Effect, Any, Recompressed], outlets: Recompressed, feed: Stream
    ) -> EvaporatorFigures:
        return self.told(*inside[:3], outlets.heat_duty)

    def measured(
        self,
        inside: tuple[Liquor, Effect, Any, Recompressed],
        outlets: Recompressed,
        figures: EvaporatorFigures,
        feed: Stream,
    ) -> dict[str, Any]:
        ratio = jnp.asarray(self.pressure_steam) / self.pressure
        return super().measured(inside, outlets, figures, feed) | {"compression": ratio}

    def drawn(
        self,
        inside: tuple[Liquor, Effect, Any, Recompressed],
        outlets: Recompressed,
        figures: EvaporatorFigures,
        feed: Stream,
    ) -> dict[str, Any]:
        machine = {"electric_power_compressor": driven(outlets.shaft_power), "area_installed": self.area}
        return heated(outlets.heat_duty, inside[2] - HEAT_APPROACH) | machine
