"""Spread of a batch of vials in freeze drying: edge vials, and differences of heat transfer, resistance and
fill.
"""

from __future__ import annotations

from typing import Annotated, Any, NamedTuple

import numpy as np

from granum.core import procedure
from granum.core.errors import ApplicabilityError
from granum.core.i18n import _
from granum.core.kinds import (
    Area,
    Concentration,
    Fraction,
    HeatTransferCoefficient,
    PositiveNumber,
    Pressure,
    Temperature,
    TemperatureRate,
    Time,
    Volume,
    Within,
)
from granum.drying.formulas.freeze_drying import primary_drying
from granum.drying.kinds import (
    HeatTransferPerPressure,
    PerLength,
    PerPressure,
    VaporResistance,
    VaporResistanceGradient,
)


class VialSpread(NamedTuple):
    """Drying times and highest product temperatures of a batch."""

    drying_time_median: Time
    drying_time_early: Time
    drying_time_late: Time
    drying_time_last: Time
    temperature_product_median: Temperature
    temperature_product_hottest: Temperature
    share_too_warm: Fraction


@procedure(source="rambhatla2003; pikal1985; shivkumar2019", title="Spread of a batch of vials")
def vial_spread(
    pressure_chamber: Pressure,
    temperature_shelf: Temperature,
    area_vial: Area,
    area_product: Area,
    volume_fill: Volume,
    concentration: Concentration,
    vial_coefficient_contact: HeatTransferCoefficient,
    vial_coefficient_gas: HeatTransferPerPressure,
    vapor_resistance: VaporResistance,
    vapor_resistance_slope: VaporResistanceGradient = 0.0,
    vapor_resistance_saturation: PerLength = 0.0,
    vial_coefficient_saturation: PerPressure = 0.0,
    temperature_shelf_start: Temperature = 238.15,
    ramp_rate: TemperatureRate = 1.0 / 60.0,
    temperature_limit: Temperature = 240.0,
    vial_count: Annotated[int, Within(10, 1_000_000)] = 10_000,
    edge_share: Fraction = 0.2,
    edge_heat_ratio: PositiveNumber = 1.35,
    spread_heat_transfer: Fraction = 0.08,
    spread_resistance: Fraction = 0.1,
    spread_fill: Fraction = 0.01,
    seed: Annotated[int, Within(0, 1_000_000)] = 0,
) -> VialSpread:
    """Times at which a batch of vials is dry and how warm they get: edge vials see warm walls, the others
    differ at random.

    Edge vials get ``edge_heat_ratio`` times the heat; heat transfer, resistance and fill of all scatter by
    relative standard deviations (lognormal). Early and late are the 5th and 95th percentile; a batch is dry
    when its last vial is.

    >>> batch = vial_spread(
    ...     "100 mtorr",
    ...     "-10 degC",
    ...     "3.8 cm^2",
    ...     "3.14 cm^2",
    ...     "2 mL",
    ...     "0.05 g/mL",
    ...     11.5,
    ...     0.28,
    ...     6.7e4,
    ...     7.7e7,
    ...     vial_count=200,
    ... )
    >>> bool(
    ...     batch.drying_time_early
    ...     < batch.drying_time_median
    ...     < batch.drying_time_late
    ...     <= batch.drying_time_last
    ... )
    True
    """
    draw = np.random.default_rng(seed)
    count = int(vial_count)

    def scatter(spread: Any) -> np.ndarray:
        """Factors of mean one."""
        return np.exp(spread * draw.standard_normal(count) - 0.5 * spread**2)

    heat = scatter(spread_heat_transfer) * np.where(
        np.arange(count) < round(edge_share * count), edge_heat_ratio, 1.0
    )
    thick = scatter(spread_resistance)
    found = primary_drying(
        pressure_chamber,
        temperature_shelf,
        area_vial,
        area_product,
        volume_fill * scatter(spread_fill),
        concentration,
        vial_coefficient_contact * heat,
        vial_coefficient_gas * heat,
        vapor_resistance * thick,
        vapor_resistance_slope * thick,
        vapor_resistance_saturation,
        vial_coefficient_saturation,
        temperature_shelf_start,
        ramp_rate,
    )
    times, warmest = np.asarray(found.drying_time), np.asarray(found.temperature_product)
    if not np.isfinite(times).all():
        raise ApplicabilityError(
            _(
                "Some vials never dry: at a shelf of {temperature} K ice has less vapor pressure than "
                "the chamber."
            ).format(temperature=f"{temperature_shelf:.1f}")
        )
    early, median, late = np.percentile(times, (5, 50, 95))
    return VialSpread(
        *map(
            float,
            (
                median,
                early,
                late,
                times.max(),
                np.median(warmest),
                warmest.max(),
                np.mean(warmest > temperature_limit),
            ),
        )
    )
