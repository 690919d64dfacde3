"""A kiln in which a batch of boards dries by a schedule of dry bulb and wet bulb over its moisture."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any, ClassVar, NamedTuple

import equinox as eqx
import jax.numpy as jnp
import numpy as np

from granum.core import equipment
from granum.core.flags import unsolved
from granum.core.i18n import _
from granum.core.kinds import (
    Density,
    Diffusivity,
    Fraction,
    HeatTransferCoefficient,
    HumidityRatio,
    Length,
    Mass,
    MassFlow,
    MoistureDryBasis,
    MolarEnergy,
    PositiveNumber,
    Power,
    PressureDrop,
    SpecificEnergy,
    Speed,
    Temperature,
    Time,
    Volume,
)
from granum.core.limits import Limit
from granum.drying.boards import Board, BoardDrying, followed, most_in_a_day, reached
from granum.drying.formulas.heat import heat_transfer_coefficient_parallel
from granum.drying.formulas.wood import (
    RED_OAK,
    RED_OAK_ENERGY,
    RED_OAK_SLOPE,
    DepressionSchedule,
    MoistureClass,
    TemperatureSchedule,
    schedule_of,
)
from granum.drying.gas_solid.dryer import ready
from granum.drying.wet_surface import AS_SPECIFIED, as_specified, boiled, evaporated
from granum.humid_gas.pairs import AIR_WATER
from granum.humid_gas.relations import saturated_fraction
from granum.numerics import safe_divide
from granum.streams.equilibrium import HumidMixture
from granum.streams.inside_charts import Axis, Curve, drawn_along
from granum.streams.stream import Stream
from granum.streams.units import Limits, Operated, Unit, Utilities
from granum.streams.utilities import FANNED, HEATED, HOT_GAS, fanned, heated, warmth

GAS_DENSITY = 1.1  # kg/m³, of the air in the kiln
LITTLE = 1e-4  # kg/kg, of humidity between the kiln and the air outside
NOT_REACHED = (
    "The boards do not reach that moisture by the schedule: its last step is in equilibrium with more, or "
    "dries too slowly. Take a hotter or drier schedule, or a higher final moisture."
)


class KilnDried(NamedTuple):
    """Dry boards, what leaves by the vents, and heat of the coils net of losses."""

    product: Stream
    exhaust: Stream
    heat_duty: Any


class KilnFigures(NamedTuple):
    """Figures of a wood kiln; flows and duties are means over the cycle."""

    drying_time: Time
    cycle_time: Time
    volume: Volume
    dry_solid_mass: Mass
    evaporation_rate: MassFlow
    evaporation_rate_highest: MassFlow
    daily_loss: MoistureDryBasis
    moisture_dry_basis: MoistureDryBasis
    moisture_dry_basis_center: MoistureDryBasis
    moisture_dry_basis_surface: MoistureDryBasis
    heat_transfer_coefficient: HeatTransferCoefficient
    humidity_ratio: HumidityRatio
    temperature_product: Temperature
    gas_flow_vented: MassFlow
    heat_duty: Power
    energy_per_water: SpecificEnergy


class Run(NamedTuple):
    """A charge: in time, the time until it is dry, and the heat transfer coefficient."""

    found: BoardDrying
    time: Any
    heat_transfer: Any
    first: Any


@equipment(
    "wood_kiln", source="simpson1991; simpson1993; siau1984; wengert2012", title="Wood kiln with schedule"
)
class WoodKiln(Unit):
    """A charge of boards on stickers dries by a schedule for hardwood of the Forest Products Laboratory: as
    they dry, the air gets hotter and drier.

    Water diffuses across the board where the wood is below fiber saturation, behind a front within which it
    is green, and leaves through a film of air; the boards have the temperature of the air. Diffusivity is by
    default that of northern red oak, for which times and losses a day come out as a specialist states them
    (five to six weeks for 28.6 mm, green at 80 %); boards that were air-dried come out faster than in
    practice. The feed's flow is the mean over the cycle. ``gas`` is the fresh air of the vents, of which the
    schedule asks for ``gas_flow_vented``. Shrinkage, heat of sorption, warming up before the schedule and
    equalizing after it are left out; ``dead_time`` has room for them.
    """

    thickness: Length
    moisture_outlet: MoistureDryBasis
    basic_density: Density = 560.0
    temperature_schedule: TemperatureSchedule = eqx.field(static=True, default="T4")
    moisture_class: MoistureClass = eqx.field(static=True, default="D")
    depression_schedule: DepressionSchedule = eqx.field(static=True, default="2")
    gas_velocity: Speed = 2.0
    pressure_drop: PressureDrop = 120.0
    sticker_thickness: Length = 0.019
    stack_width: Length = 2.4
    diffusivity_preexponential: Diffusivity = RED_OAK
    diffusion_activation_energy: MolarEnergy = RED_OAK_ENERGY
    diffusivity_moisture_exponent: PositiveNumber = RED_OAK_SLOPE
    dead_time: Time = 172800.0
    heat_loss_share: Fraction = 0.2
    daily_loss_limit: MoistureDryBasis = 0.038

    limits: ClassVar[Limits] = {
        "checks": Limit(
            "moisture that wet boards lose in a day",
            0.0,
            "daily_loss_limit",
            "kg/kg",
            "wengert2012",
        ),
        "gradient": Limit(
            "moisture of the core above the mean at the end", -math.inf, 0.03, "kg/kg", "wengert2012"
        ),
        "time": Limit(
            "drying time of a charge", 3.5 * 86400.0, 90 * 86400.0, "s", "houdon2017, notes D table IV.18"
        ),
        "speed": Limit("air speed through the stack", 1.0, 8.0, "m/s", "simpson1991, ch. 7"),
        "vented": Limit(
            "fresh air over what the schedule asks for", 0.95, 2.0, "dimensionless", "simpson1991, ch. 7"
        ),
    } | AS_SPECIFIED

    utilities: ClassVar[Utilities] = HEATED | HOT_GAS | FANNED

    def inside(self, feed: Stream, gas: Stream) -> Run:
        feed.mixture.require("liquids")
        first = safe_divide(feed.liquid[0], feed.solid_flow)
        h = heat_transfer_coefficient_parallel.function(self.gas_velocity * GAS_DENSITY)
        found = _run(self, first, h, jnp.asarray(gas.pressure, dtype=float))
        time, known = reached(found, first, jnp.minimum(self.moisture_outlet, first))
        unsolved(known, type(self).card, reason=NOT_REACHED)
        return Run(found, time, h, first)

    def charts(self, made: Operated, inlets: Mapping[str, Stream]) -> dict[str, Any]:
        run: Run = made.inside
        ends = float(run.time)
        if not 0.0 < ends < math.inf:
            return {}
        dries = np.asarray(run.found.time) <= ends
        found = [np.asarray(x)[dries] for x in run.found]
        time, mean, core, surface, dry_bulb, wet_bulb, _humidity = found
        moist = drawn_along(
            Axis("time", "Time"),
            time,
            (
                Axis("moisture_dry_basis", "MoistureDryBasis"),
                [
                    Curve(_("core"), core, "SOLID", "dash"),
                    Curve(_("mean of the board"), mean, "SOLID"),
                    Curve(_("surface"), surface, "SOLID", "dot"),
                ],
            ),
            (
                Axis("temperature", "Temperature", "degC", zero=False),
                [
                    Curve(_("air, dry bulb"), dry_bulb, "ACCENT"),
                    Curve(_("air, wet bulb"), wet_bulb, "GAS", "dashdot"),
                ],
            ),
        )
        return {_("A charge of the kiln over time"): moist}

    def lost(self, inside: Run) -> Any:
        """Moisture that each step takes away, kg/kg."""
        X = jnp.maximum(
            jnp.append(inside.first, inside.found.moisture), jnp.minimum(self.moisture_outlet, inside.first)
        )
        return -jnp.diff(X)

    def mean(self, inside: Run, values: Any) -> Any:
        """Of what the steps have, by the water that they take away."""
        lost = self.lost(inside)
        return safe_divide(jnp.sum(lost * values), jnp.sum(lost), values[0])

    def humidity(self, inside: Run, pressure: Any) -> Any:
        """Of the air in each step, kg/kg."""
        found = inside.found
        return AIR_WATER.humidity_ratio(
            found.relative_humidity * saturated_fraction(AIR_WATER, found.temperature, pressure)
        )

    def outlets(self, inside: Run, feed: Stream, gas: Stream) -> KilnDried:
        product, vapor = boiled(
            feed,
            self.moisture_outlet,
            self.ended(inside),
            self.mean(inside, inside.found.temperature),
            gas.pressure,
        )
        exhaust = vapor.replace(gas=vapor.gas + gas.gas)
        duty = product.enthalpy_flow + exhaust.enthalpy_flow - feed.enthalpy_flow - gas.enthalpy_flow
        return KilnDried(product, exhaust, duty)

    def ended(self, inside: Run) -> Any:
        """Temperature of the last step that dries."""
        return inside.found.temperature[jnp.argmax(inside.found.moisture <= self.moisture_outlet)]

    def figures(self, inside: Run, outlets: KilnDried, feed: Stream, gas: Stream) -> KilnFigures:
        found, lost = inside.found, self.lost(inside)
        water = evaporated(feed, outlets.product)
        cycle = inside.time + self.dead_time
        dry = feed.solid_flow * cycle
        fresh = HumidMixture(gas.mixture).humidity_ratio(gas)
        humidity = self.humidity(inside, gas.pressure)
        per_dry = jnp.sum(lost / jnp.maximum(humidity - fresh, LITTLE))
        step = jnp.diff(found.time, prepend=0.0)
        at = jnp.argmax(found.moisture <= self.moisture_outlet)
        duty = outlets.heat_duty / (1.0 - self.heat_loss_share)
        return KilnFigures(
            drying_time=inside.time,
            cycle_time=cycle,
            volume=dry / self.basic_density,
            dry_solid_mass=dry,
            evaporation_rate=water,
            evaporation_rate_highest=dry * jnp.max(jnp.where(step > 0.0, safe_divide(lost, step), 0.0)),
            daily_loss=most_in_a_day(found, inside.first, self.moisture_outlet),
            moisture_dry_basis=safe_divide(outlets.product.liquid[0], outlets.product.solid_flow),
            moisture_dry_basis_center=found.core[at],
            moisture_dry_basis_surface=found.surface[at],
            heat_transfer_coefficient=inside.heat_transfer,
            humidity_ratio=self.mean(inside, humidity),
            temperature_product=outlets.product.temperature,
            # of what lost less than rounding nothing has to be carried away
            gas_flow_vented=jnp.where(inside.time > 0.0, feed.solid_flow * per_dry * (1.0 + fresh), 0.0),
            heat_duty=duty,
            energy_per_water=safe_divide(duty, water),
        )

    def measured(
        self, inside: Run, outlets: KilnDried, figures: KilnFigures, feed: Stream, gas: Stream
    ) -> dict[str, Any]:
        return {
            "checks": figures.daily_loss,
            "gradient": figures.moisture_dry_basis_center - figures.moisture_dry_basis,
            "time": figures.drying_time,
            "speed": self.gas_velocity,
            "vented": safe_divide(gas.gas_flow, figures.gas_flow_vented, 1.0),
        } | as_specified(feed, self.moisture_outlet)

    def drawn(
        self, inside: Run, outlets: KilnDried, figures: KilnFigures, feed: Stream, gas: Stream
    ) -> dict[str, Any]:
        share = safe_divide(figures.drying_time, figures.cycle_time)
        section = figures.volume / (self.thickness * self.stack_width) * self.sticker_thickness
        hottest = jnp.max(inside.found.temperature)
        blown = fanned(self.gas_velocity * section * share, self.pressure_drop)
        return heated(figures.heat_duty, hottest) | warmth(gas) | {"electric_power_fan": blown}


@ready
def _run(kiln: WoodKiln, first: Any, heat_transfer: Any, pressure: Any) -> BoardDrying:
    board = Board(
        0.5 * kiln.thickness,
        kiln.basic_density,
        heat_transfer,
        (
            kiln.diffusivity_preexponential,
            kiln.diffusion_activation_energy,
            kiln.diffusivity_moisture_exponent,
        ),
    )
    schedule = schedule_of(kiln.temperature_schedule, kiln.moisture_class, kiln.depression_schedule)
    return followed(board, schedule, first, jnp.minimum(kiln.moisture_outlet, first), pressure)
