"""Greenhouse gas of the energy that a plant takes."""

from __future__ import annotations

from typing import Literal, get_args

from granum.core import formula
from granum.core.kinds import MassFlow, Power
from granum.costs.kinds import EmissionFactor
from granum.costs.tables import emissions

Electricity = Literal[
    "electricity_world", "electricity_european_union", "electricity_france", "electricity_germany"
]
Carrier = Literal[
    "electricity",
    "fuel_gas",
    "low_pressure_steam",
    "medium_pressure_steam",
    "high_pressure_steam",
    "hot_gas",
    "cooling_water",
    "chilled_water",
    "brine",
    "deep_cold",
]
CARRIERS: tuple[str, ...] = get_args(Carrier)


@formula(
    source="ember2024; epa2022; ipcc2006; sdes2022",
    equation=r"f = f_0 + e\,f_{el}",
    title="Greenhouse gas of a carrier of energy",
)
def emission_factor(carrier: Carrier, electricity: Electricity = "electricity_world") -> EmissionFactor:
    """Carbon dioxide equivalent per energy of a carrier, that of the electricity it needs included.

    Electricity of 2023 (European Union: 2020); steam and hot gas from natural gas at 80 %. Cold counts the
    electricity of a machine with half of Carnot's coefficient, cooling water that of its pump.

    481 g/kWh in the world:

    >>> round(emission_factor("electricity") * 3.6e6, 3)
    0.481
    """
    own = emissions()[carrier]
    return own.factor + own.electricity * emissions()[electricity].factor


@formula(
    source="ipcc2006",
    equation=r"\dot m_{GHG} = P\,f",
    typical={"emission_factor": (1e-8, 1.5e-7)},
    title="Greenhouse gas of a power",
)
def greenhouse_gas_rate(power: Power, emission_factor: EmissionFactor) -> MassFlow:
    """Carbon dioxide equivalent per time that a power, heat or cold causes.

    By hand: 1 MW of electricity at 481 g/kWh.

    >>> round(greenhouse_gas_rate("1 MW", "0.481 kg/kWh") * 3600, 6)
    481.0
    """
    return power * emission_factor
