"""Wood in a kiln: diffusion of its water, fiber saturation, and the schedules of the Dry Kiln Operator's
Manual.
"""

from __future__ import annotations

from typing import Any, Literal, NamedTuple

import jax.numpy as jnp
import numpy as np

import granum.humid_gas.relations as rel
from granum.core import formula
from granum.core.constants import GAS_CONSTANT, STANDARD_ATMOSPHERE
from granum.core.datasets import dataset
from granum.core.kinds import (
    Diffusivity,
    MoistureDryBasis,
    MolarEnergy,
    PositiveNumber,
    Pressure,
    RelativeHumidity,
    Temperature,
)
from granum.drying.isotherms.adsorption import HailwoodHorrobin
from granum.humid_gas.pairs import AIR_WATER

WOOD = HailwoodHorrobin()
RED_OAK, RED_OAK_ENERGY, RED_OAK_SLOPE = 19.2e-4, 5280.0 * GAS_CONSTANT, 1.15  # m²/s, J/mol
SATURATED, SATURATED_SLOPE, SATURATED_AT = 0.30, 1e-3, 293.15
TemperatureSchedule = Literal["T3", "T4", "T5", "T6", "T8", "T10"]
MoistureClass = Literal["C", "D", "E", "F"]
DepressionSchedule = Literal["1", "2", "3", "4", "5", "6"]
_STEPS = ("first", "second", "third", "fourth", "fifth", "sixth")


@formula(
    source="siau1984",
    equation=r"X_f = 0.30 - 0.001\,(T - 293.15)",
    output="moisture_dry_basis",
    fitted={"temperature": (273.15, 373.15)},
    title="Fiber saturation of wood",
    symbols={"moisture_dry_basis": "X_f"},
)
def fiber_saturation(temperature: Temperature) -> MoistureDryBasis:
    """Moisture at which the walls of the cells are full and their hollows empty: wood shrinks below it alone,
    and only there does its water move by diffusion.

    Source not opened: 30 % at room temperature, a tenth of a percent less per kelvin.

    >>> round(fiber_saturation(temperature="60 degC"), 3)
    0.26
    """
    return SATURATED - SATURATED_SLOPE * (temperature - SATURATED_AT)


@formula(
    source="simpson1993",
    equation=r"D = D_0\,e^{-E_d/RT}\,e^{b X}",
    output="diffusivity",
    fitted={"temperature": (310.0, 345.0), "moisture_dry_basis": (0.0, 0.3)},
    typical={"temperature": (310.0, 345.0)},
    title="Diffusivity of water in wood",
    symbols={"diffusivity_moisture_exponent": "b"},
)
def wood_diffusivity(
    temperature: Temperature,
    moisture_dry_basis: MoistureDryBasis,
    diffusivity_preexponential: Diffusivity = RED_OAK,
    diffusion_activation_energy: MolarEnergy = RED_OAK_ENERGY,
    diffusivity_moisture_exponent: PositiveNumber = RED_OAK_SLOPE,
) -> Diffusivity:
    """Diffusivity across the grain, by default of northern red oak, one of the slowest woods: light softwoods
    have several times as much.

    Source not opened: the numbers stand in a program for oak (read) that cites none other, with T in kelvin:
    19.2 exp(−5280/T) exp(1.15 M/100) in cm²/s.

    >>> float(f"{wood_diffusivity(temperature='60 degC', moisture_dry_basis=0.2):.3g}")
    3.16e-10
    """
    slower = jnp.exp(-diffusion_activation_energy / (GAS_CONSTANT * temperature))
    return diffusivity_preexponential * slower * jnp.exp(diffusivity_moisture_exponent * moisture_dry_basis)


class Schedule(NamedTuple):
    """Steps of a schedule: moistures below which the next one begins, dry bulbs, wet-bulb depressions, K."""

    temperature_bounds: Any
    temperatures: Any
    depression_bounds: Any
    depressions: Any


def schedule_of(temperatures: str, moisture_class: str, depressions: str) -> Schedule:
    """A schedule by its code, in SI."""
    rows = {(str(r["part"]), str(r["name"])): r for r in dataset("drying", "kiln_schedules_ah188")}

    def steps(part: str, name: str, count: int) -> Any:
        return np.array([float(rows[part, name][step]) for step in _STEPS[:count]])

    return Schedule(
        0.01 * steps("moisture", "temperature", 4),
        (steps("temperature", temperatures, 5) + 459.67) / 1.8,
        0.01 * steps("moisture", moisture_class, 5),
        steps("depression", depressions, 6) / 1.8,
    )


class KilnAir(NamedTuple):
    """Air of a kiln and the moisture of wood in equilibrium with it."""

    temperature: Temperature
    wet_bulb_temperature: Temperature
    relative_humidity: RelativeHumidity
    moisture_dry_basis_equilibrium: MoistureDryBasis


def airs_of(schedule: Schedule, P: Any) -> KilnAir:
    """Of every dry bulb (rows) with every depression (columns)."""
    P = jnp.asarray(P)
    dry = jnp.asarray(schedule.temperatures)[:, None] + 0.0 * jnp.asarray(schedule.depressions)
    dry = jnp.reshape(dry, (*dry.shape, *(1,) * P.ndim)) + 0.0 * P
    wet = dry - jnp.reshape(jnp.asarray(schedule.depressions), (-1, *(1,) * P.ndim))
    y = rel.fraction_at_wet_bulb(AIR_WATER, dry, P, wet, None)
    phi = jnp.clip(y / rel.saturated_fraction(AIR_WATER, dry, P), 0.01, 0.99)
    return KilnAir(dry, wet, phi, WOOD.moisture(phi, dry))


def air_at(schedule: Schedule, airs: KilnAir, X: Any) -> KilnAir:
    """Of these, that of a moisture of the load."""

    def step(bounds: Any) -> Any:
        return sum(
            (jnp.asarray(bound > X, dtype=int) for bound in bounds), jnp.zeros(jnp.shape(X), dtype=int)
        )

    row, column = step(schedule.temperature_bounds), step(schedule.depression_bounds)
    if airs.temperature.ndim == 2:
        return KilnAir(*(values[row, column] for values in airs))
    # one pressure for each moisture
    at = jnp.indices(row.shape)
    return KilnAir(*(values[row, column, *at] for values in airs))


@formula(
    source="simpson1991, ch. 7; glass2010",
    equation=r"T = T_i(X),\quad T_h = T - \Delta_i(X),\quad \varphi = \varphi(T, T_h),\quad X_a = X_a(\varphi, T)",  # noqa: E501
    typical={"moisture_dry_basis": (0.08, 0.8)},
    title="Air of a kiln by schedule",
)
def kiln_air(
    moisture_dry_basis: MoistureDryBasis,
    temperature_schedule: TemperatureSchedule = "T4",
    moisture_class: MoistureClass = "D",
    depression_schedule: DepressionSchedule = "2",
    pressure: Pressure = STANDARD_ATMOSPHERE,
) -> KilnAir:
    """Dry bulb, wet bulb and equilibrium of the wood at a moisture of the load, by the schedules for hardwood
    of the Forest Products Laboratory.

    T4-D2 is that of northern red oak of 1 inch. The first steps are humid, because the surface would check;
    later ones, when the core is below fiber saturation, hot and dry. Typed from memory, see the table.

    >>> air = kiln_air(moisture_dry_basis=0.6)
    >>> round(float(air.temperature) - 273.15, 1), round(float(air.moisture_dry_basis_equilibrium), 3)
    (43.3, 0.177)
    """
    schedule = schedule_of(temperature_schedule, moisture_class, depression_schedule)
    X, P = jnp.broadcast_arrays(
        jnp.asarray(moisture_dry_basis, dtype=float), jnp.asarray(pressure, dtype=float)
    )
    return air_at(schedule, airs_of(schedule, P), X)
