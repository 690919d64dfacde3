"""Batch crystallizers in a line whose temperature follows what probes read."""

from __future__ import annotations

import math
from typing import Annotated, Any, ClassVar, NamedTuple

import equinox as eqx
import jax
import jax.numpy as jnp

from granum.core import equipment
from granum.core.flags import unsolved
from granum.core.kinds import (
    Concentration,
    Distance,
    Mass,
    MassFlow,
    Number,
    NumberDensity,
    PositiveNumber,
    Power,
    Ratio,
    RotationSpeed,
    SpecificPower,
    Temperature,
    TemperatureRate,
    Time,
    Velocity,
    Volume,
    Within,
)
from granum.core.limits import Limit
from granum.crystallization.equipment.batch import (
    BatchOutlets,
    ChargedVessel,
    CycledVessel,
    Grown,
    thermal,
)
from granum.crystallization.equipment.colliding import Colliding
from granum.crystallization.equipment.heat import StreamHeat
from granum.crystallization.equipment.roles import Roles
from granum.crystallization.kinds import CountBound, Dissolution, ReadingDeviation
from granum.crystallization.population.operations import Contents, Counted, Held, Operation, Sensor
from granum.numerics.smooth import safe_divide
from granum.streams.stream import Stream
from granum.streams.units import Limits, Utilities
from granum.streams.utilities import COOLED, HEATED, STIRRED

LEFT = 0.01  # of the temperature fall, with which a batch counts as cooled
TOO_COLD = "The feed is colder than the final temperature: give a warmer feed or a lower final temperature."
CROSSED = "The lower bound of the number of crystals is not below the upper one."
NOT_FALLING = "The solubility does not fall on cooling: take evaporation or an antisolvent."


class ControlledBatchFigures(NamedTuple):
    """Figures of a batch crystallizer at constant supersaturation."""

    crystal_flow: MassFlow
    yield_fraction: Ratio
    magma_density: Concentration
    relative_supersaturation_maximum: Number
    mean_diameter_mass: Distance
    nuclei_mass_fraction: Ratio | None
    seed_mass: Mass
    volume: Volume
    time_cooled: Time
    heat_duty: Power
    heat_duty_maximum: Power
    rotation_speed_suspension: RotationSpeed
    tip_speed: Velocity
    specific_power_input: SpecificPower


class NucleationControlledFigures(NamedTuple):
    """Figures of a batch crystallizer at a controlled number of crystals."""

    crystal_flow: MassFlow
    yield_fraction: Ratio
    magma_density: Concentration
    relative_supersaturation_maximum: Number
    mean_diameter_mass: Distance
    nuclei_mass_fraction: Ratio
    seed_mass: Mass
    volume: Volume
    time_cooled: Time
    heat_duty: Power
    heat_duty_maximum: Power
    crystal_number_end: NumberDensity
    heating_number: Ratio
    rotation_speed_suspension: RotationSpeed
    tip_speed: Velocity
    specific_power_input: SpecificPower


def time_above(times: Any, values: Any, level: Any) -> Any:
    """Time that a quantity, straight between its points, spends above a level."""
    high, low = jnp.maximum(values[1:], values[:-1]), jnp.minimum(values[1:], values[:-1])
    flat = jnp.where(high > level, 1.0, 0.0)
    share = jnp.clip(safe_divide(high - level, high - low, flat), 0.0, 1.0)
    return jnp.sum(share * jnp.diff(times))


class FollowedBatch(CycledVessel, ChargedVessel):
    """What cooling batches share whose temperature follows a probe; each says how, and how fast it heats and
    cools.
    """

    temperature_end: Temperature = eqx.field(kw_only=True)
    duration: Annotated[Time, Within(1.0, math.inf)] = eqx.field(kw_only=True)
    reading_interval: Annotated[Time, Within(1.0)] = eqx.field(kw_only=True, default=60.0)

    limits: ClassVar[Limits] = CycledVessel.limits | {
        "unfinished": Limit(
            "temperature above the final one when the batch ends",
            -math.inf,
            0.5,
            "delta_degC",
            "braatz2002",
        )
    }

    utilities: ClassVar[Utilities] = STIRRED | HEATED | COOLED

    def inside(self, feed: Stream) -> Grown:
        grown = super().inside(feed)
        entering = feed.liquid[grown.found.solute] > 0.0
        unsolved((feed.temperature >= self.temperature_end) | ~entering, type(self).card, reason=TOO_COLD)
        hot, cold = (jnp.asarray(self.solubility(T)) for T in (feed.temperature, self.temperature_end))
        falling = (cold < hot) | (feed.temperature <= self.temperature_end) | ~entering
        unsolved(falling, type(self).card, reason=NOT_FALLING)
        return grown

    def outlets(self, inside: Grown, feed: Stream) -> BatchOutlets:
        return self._cooled(inside, feed)

    def _freed(self, inside: Grown, feed: Stream) -> Any:
        """Heat taken off one vessel in each time step, W."""
        course, heat = inside.course, StreamHeat.of(feed, inside.found)

        def over(T: Any, solute: Any, solvent: Any, before: Any, later: Any, crystals: Any) -> Any:
            return heat.freed(Contents(T, solute, solvent, 0.0), before, later, crystals)

        rows = (course.temperature, course.solute, course.solvent, course.crystals)
        T, solute, solvent, crystals = (row[:-1] for row in rows)
        freed = jax.vmap(over)(T, solute, solvent, crystals, course.temperature[1:], course.crystals[1:])
        return freed * self.cycle / jnp.diff(course.time)

    def _followed(self, inside: Grown, outlets: BatchOutlets, feed: Stream) -> tuple[Any, ...]:
        """Volume of one vessel, time until it has cooled, mean duty and the largest heat taken off."""
        course = inside.course
        level = self.temperature_end + LEFT * jnp.maximum(feed.temperature - self.temperature_end, 0.0)
        return (
            outlets.product.slurry_volume_flow * self.cycle,
            time_above(course.time, course.temperature, level),
            outlets.heat_duty,
            jnp.max(self._freed(inside, feed)),
        )

    def measured(self, inside: Grown, outlets: BatchOutlets, figures: Any, feed: Stream) -> dict[str, Any]:
        left = outlets.product.temperature - self.temperature_end
        return super().measured(inside, outlets, figures, feed) | {"unfinished": left}

    def drawn(self, inside: Grown, outlets: BatchOutlets, figures: Any, feed: Stream) -> dict[str, Any]:
        stirrer = self.stirrer_power(outlets.product, figures.volume)
        return thermal(outlets.heat_duty, feed, outlets.product) | stirrer


@equipment(
    "controlled_batch_crystallizer",
    source="braatz2002; fujiwara2005",
    title="Batch crystallizer at constant supersaturation",
    equation=r"C^*(T) = \frac{C}{1 + \sigma_c},\quad |\dot T| \le R_{\max},\quad T_f \le T \le T_0",
)
class ControlledBatchCrystallizer(Colliding, FollowedBatch):
    """Cooling batch whose temperature is set from the concentration read, so that the liquor keeps a relative
    supersaturation; outlets are means over the cycle.

    The charge starts at the temperature of the feed. A feed that is less supersaturated than wanted is cooled
    as fast as the vessel can; one that is more so waits. Readings err by a relative standard deviation, with
    the same draws in every run, each kept until the next one. The control knows no kinetics: a batch too
    short for its seeds ends warm, which a check tells. The largest heat taken off is that of one vessel and
    sizes its jacket. Seeds are those of ``batch_crystallizer``.
    """

    supersaturation_kept: PositiveNumber
    cooling_rate_maximum: TemperatureRate = eqx.field(kw_only=True, default=30.0 / 3600.0)
    concentration_deviation: ReadingDeviation = eqx.field(kw_only=True, default=0.0)

    def _operation(self, feed: Stream, found: Roles, duration: Any) -> Operation:
        return Held(
            self._model(feed, found),
            self.supersaturation_kept,
            feed.temperature,
            self.temperature_end,
            self.cooling_rate_maximum,
            Sensor(self.concentration_deviation, self.reading_interval),
        )

    def figures(self, inside: Grown, outlets: BatchOutlets, feed: Stream) -> ControlledBatchFigures:
        made = self._followed(inside, outlets, feed)
        return ControlledBatchFigures._make(
            (
                *self._figures(inside, outlets.product, feed),
                self._seed(feed, inside.found),
                *made,
                *self.stirrer_figures(outlets.product, made[0]),
            )
        )


@equipment(
    "nucleation_controlled_crystallizer",
    source="abubakar2009; saleemi2012",
    title="Batch crystallizer at a controlled number of crystals",
    equation=r"n > n_+:\ \dot T = R_h,\quad n < n_-:\ \dot T = -R,\quad n_- \le n \le n_+:\ \dot T = -R_b",
)
class NucleationControlledCrystallizer(FollowedBatch):
    """Cooling batch that is heated while more crystals are counted in a volume of suspension than an upper
    bound, cooled while they are fewer than a lower one and more slowly in between (direct nucleation
    control); outlets are means over the cycle.

    The charge starts at the temperature of the feed, above which it is not heated; a feed somewhat warmer
    than saturation gives the heating room. The probe counts all crystals, the smallest included, and errs by
    a relative standard deviation, with the same draws in every run. Seeds, where there are any, must be fewer
    than the upper bound. The control knows no kinetics: each turn costs time, and a batch too short for them
    ends warm, which a check tells.
    """

    crystal_number_lower: CountBound
    crystal_number_upper: CountBound
    dissolution: Dissolution = eqx.field(kw_only=True)
    cooling_rate: TemperatureRate = eqx.field(kw_only=True, default=6.0 / 3600.0)
    cooling_rate_between: TemperatureRate = eqx.field(kw_only=True, default=1.5 / 3600.0)
    heating_rate: TemperatureRate = eqx.field(kw_only=True, default=12.0 / 3600.0)
    count_deviation: ReadingDeviation = eqx.field(kw_only=True, default=0.0)

    limits: ClassVar[Limits] = FollowedBatch.limits | {
        "counted": Limit(
            "crystals per volume when the batch ends",
            0.0,
            "crystal_number_upper",
            "1/m^3",
            "abubakar2009",
        )
    }

    def _operation(self, feed: Stream, found: Roles, duration: Any) -> Operation:
        return Counted(
            self._model(feed, found),
            self.crystal_number_lower,
            self.crystal_number_upper,
            feed.temperature,
            self.temperature_end,
            self.cooling_rate,
            self.cooling_rate_between,
            self.heating_rate,
            Sensor(self.count_deviation, self.reading_interval),
        )

    def inside(self, feed: Stream) -> Grown:
        apart = jnp.asarray(self.crystal_number_lower) < self.crystal_number_upper
        unsolved(apart, type(self).card, reason=CROSSED)
        return super().inside(feed)

    def figures(self, inside: Grown, outlets: BatchOutlets, feed: Stream) -> NucleationControlledFigures:
        made, course = self._followed(inside, outlets, feed), inside.course
        rising = jnp.diff(course.temperature) > 0.0
        begun = rising & ~jnp.append(False, rising[:-1])
        there = Contents(course.temperature[-1], course.solute[-1], course.solvent[-1], 0.0)
        volume = self._model(feed, inside.found).suspension(there, course.crystals[-1])
        return NucleationControlledFigures._make(
            (
                *self._figures(inside, outlets.product, feed),
                self._seed(feed, inside.found),
                *made,
                safe_divide(course.moments[-1, 0], volume, 0.0),
                jnp.sum(begun, dtype=float),
                *self.stirrer_figures(outlets.product, made[0]),
            )
        )

    def measured(
        self, inside: Grown, outlets: BatchOutlets, figures: NucleationControlledFigures, feed: Stream
    ) -> dict[str, Any]:
        return super().measured(inside, outlets, figures, feed) | {"counted": figures.crystal_number_end}
