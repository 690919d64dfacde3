"""Programs over time: temperature of a batch, evaporation, addition of antisolvent."""

from __future__ import annotations

from abc import abstractmethod
from typing import Annotated

import equinox as eqx
import jax.numpy as jnp

from granum.core import formula, impossible, law, points
from granum.core.kinds import (
    Fraction,
    MassFlow,
    Number,
    PositiveNumber,
    Ratio,
    Series,
    Temperature,
    Time,
    Within,
)
from granum.crystallization.kinds import PositiveTemperatureDifference
from granum.numerics.smooth import safe_power

OVER = "The program is over by this time."


class Program(eqx.Module):
    """A quantity as a function of time."""

    @abstractmethod
    def __call__(self, time: Time) -> Number:
        """Value at a time."""


@formula(
    source="mullin1971; jones1974",
    title="Temperature of a cooling program",
    equation=r"T = T_0 - (T_0 - T_f)\left(\frac{t}{t_f}\right)^p",
    output="temperature",
    typical={
        "time": (600.0, 3000.0),
        "duration": (3600.0, 7200.0),
        "temperature_start": (320.0, 340.0),
        "temperature_end": (280.0, 300.0),
    },
)
def temperature_cooling_power(
    time: Time,
    duration: Time,
    temperature_start: Temperature,
    temperature_end: Temperature,
    cooling_exponent: PositiveNumber = 3.0,
) -> Temperature:
    """Temperature of a programmed cooling batch, a power of time: 1 is linear, 3 the seeded optimum without
    nucleation.

    For growth at constant rate on a given number of seeds, supersaturation stays constant when the crystal
    mass, and with it the temperature fall, rises with the cube of time; natural cooling does the opposite.

    >>> round(
    ...     temperature_cooling_power(
    ...         time="40 min", duration="80 min", temperature_start="32 degC", temperature_end="28 degC"
    ...     )
    ...     - 273.15,
    ...     2,
    ... )
    31.5
    """
    impossible(time > duration, time, "time", 0.0, duration, OVER)
    return temperature_start - (temperature_start - temperature_end) * safe_power(
        time / duration, cooling_exponent
    )


@law(
    "program",
    name="power_cooling",
    source="mullin1971; jones1974",
    title="Cooling by a power of time",
    equation=r"T = T_0 - (T_0 - T_f)(t/t_f)^p",
)
class PowerCooling(Program):
    """Cooling from one temperature to another by a power of time: 1 linear, 3 cubic."""

    temperature_start: Temperature
    temperature_end: Temperature
    duration: Time
    cooling_exponent: PositiveNumber = 1.0

    def __call__(self, time: Time) -> Temperature:
        share = safe_power(jnp.clip(time / self.duration, 0.0, 1.0), self.cooling_exponent)
        return self.temperature_start - (self.temperature_start - self.temperature_end) * share


@law(
    "program",
    name="natural_cooling",
    source="mullin1971",
    title="Natural cooling",
    equation=r"T = T_j + (T_0 - T_j)\,e^{-t/\tau}",
    symbols={"cooling_time": r"\tau"},
)
class NaturalCooling(Program):
    """Cooling towards a constant jacket temperature, fast at first: the exponential of an uncontrolled
    batch.
    """

    temperature_start: Temperature
    jacket_temperature: Temperature
    cooling_time: Time

    def __call__(self, time: Time) -> Temperature:
        return self.jacket_temperature + (self.temperature_start - self.jacket_temperature) * jnp.exp(
            -time / self.cooling_time
        )


@law(
    "program",
    name="temperature_points",
    source="mullin1971",
    title="Temperature by points",
    equation=r"T(t) \text{ linear between points}\ (t_i,\ T_i)",
    symbols={"time_points": "t_i", "temperature": "T_i"},
)
class TemperaturePoints(Program):
    """Temperature by points in time, straight in between, constant outside: a recipe, or a logged batch.

    >>> float(TemperaturePoints([0.0, 3600.0, 7200.0], [325.15, 315.15, 295.15])(1800.0))
    320.15
    """

    time_points: Annotated[Time, Series("points")]
    temperature: Annotated[Temperature, Series("points")]

    def __check_init__(self) -> None:
        points.follow("time_points", self.time_points)

    def __call__(self, time: Time) -> Temperature:
        return jnp.interp(
            jnp.asarray(time, dtype=float), jnp.asarray(self.time_points), jnp.asarray(self.temperature)
        )


@law(
    "program",
    name="cycled_cooling",
    source="braatz2002",
    title="Cooling with cycles of heating",
    equation=r"\dot T_{cool} = -\frac{(T_0 - T_f) + n\,\Delta T_h}{(1 - f)\,t_f},"
    r"\quad \dot T_{heat} = \frac{n\,\Delta T_h}{f\,t_f}",
)
class CycledCooling(Program):
    """Cooling in straight lines that heating interrupts to dissolve fines: cool, heat, …, cool.

    Each heating, ``cycle_number`` in all, raises the temperature by the same step; all coolings are equally
    steep and equally long, and the last one ends at the final temperature. It takes a law of dissolution to
    act.
    """

    temperature_start: Temperature
    temperature_end: Temperature
    duration: Time
    cycle_number: Annotated[int, Within(1, 100)] = 3
    temperature_rise_cycle: PositiveTemperatureDifference = 2.0
    heating_share: Annotated[Fraction, Within(0.01, 0.9)] = 0.25

    def __call__(self, time: Time) -> Temperature:
        n, rise = self.cycle_number, self.temperature_rise_cycle
        fall = (self.temperature_start - self.temperature_end + n * rise) / (n + 1.0)
        cooling = (1.0 - self.heating_share) * self.duration / (n + 1.0)
        heating = self.heating_share * self.duration / n
        t = jnp.clip(time, 0.0, self.duration)
        past = jnp.clip(jnp.floor(t / (cooling + heating)), 0.0, n)
        since = t - past * (cooling + heating)
        cooled = jnp.clip(since / cooling, 0.0, 1.0)
        heated = jnp.clip((since - cooling) / heating, 0.0, 1.0)
        return self.temperature_start - past * (fall - rise) - cooled * fall + heated * rise


@law(
    "program",
    name="cooling_shares",
    source="jones1974",
    title="Cooling by shares of the temperature fall",
    equation=r"T(t_k) = T_0 - (T_0 - T_f)\frac{\sum_{i \le k} s_i}{\sum_i s_i},\quad t_k = \frac{k}{n}\,t_f",
)
class CoolingShares(Program):
    """Cooling that never heats: the shares of the temperature fall in equal intervals of time, straight
    inside each.

    The shares count relative to their sum, so that each may be varied on its own between zero and one, for
    instance by an optimization.

    >>> float(CoolingShares(325.15, 295.15, 7200.0, [0.2, 0.3, 0.5])(4800.0))
    310.15
    """

    temperature_start: Temperature
    temperature_end: Temperature
    duration: Time
    cooling_shares: Annotated[Fraction, Series("intervals")]

    def __call__(self, time: Time) -> Temperature:
        shares = jnp.asarray(self.cooling_shares)
        fallen = jnp.concatenate([jnp.zeros(1), jnp.cumsum(shares)]) / jnp.sum(shares)
        knots = jnp.linspace(0.0, 1.0, shares.shape[0] + 1)
        share = jnp.interp(jnp.asarray(time, dtype=float) / self.duration, knots, fallen)
        return self.temperature_start - (self.temperature_start - self.temperature_end) * share


@law(
    "program",
    name="constant_flow",
    source="mullin2001, ch. 8",
    title="Constant flow",
    equation=r"m(t) = \dot m\, t",
)
class ConstantFlow(Program):
    """Mass added (or evaporated) so far at a constant flow, from a start to an end."""

    mass_flow: MassFlow
    time_start: Time = 0.0
    time_end: Time = 1e12

    def __call__(self, time: Time) -> Ratio:
        return self.mass_flow * jnp.clip(time - self.time_start, 0.0, self.time_end - self.time_start)
