"""What equipment costs to buy and to install, from its size."""

from __future__ import annotations

from typing import Any, Literal, NamedTuple

import jax.numpy as jnp

from granum.core import flags, formula
from granum.core.kinds import Area, Cost, Length, PositiveNumber, Power, Ratio, Volume, VolumeFlow
from granum.costs.tables import correlations

BASE_INDEX = 397.0
"""Plant cost index of the correlations: mid 2001."""
KILOWATT = 1e3
FALLING = "The printed curve falls here as the size grows, which no price does: compare, but do not optimize."


class EquipmentCost(NamedTuple):
    """Cost to buy and cost installed."""

    purchased_cost: Cost
    bare_module_cost: Cost


def _cost(
    equipment: str, value: Any, name: str, card: str, cost_index: Any, unit: float = 1.0
) -> EquipmentCost:
    """``unit``: SI units in the unit of the table. Without a card the range is the same for all choices, and
    the formula declares it.
    """
    row = correlations()[equipment]
    low, high = row.smallest * unit, row.largest * unit
    flags.impossible(~(value > 0), value, name, 0.0, jnp.inf)
    if card:
        flags.record(
            flags.EXTRAPOLATED,
            (value < low) | (value > high),
            value,
            name,
            card,
            low,
            high,
            "turton2018, table A.1",
        )
    decades = jnp.log10(value / unit)
    flags.limit_active(row.k2 + 2.0 * row.k3 * decades < 0.0, value, name, FALLING)
    bought = 10.0 ** (row.k1 + row.k2 * decades + row.k3 * decades**2) * cost_index / BASE_INDEX
    return EquipmentCost(bought, bought * row.bare_module_factor)


_EQUATION = (
    r"\log_{10} C_p^0 = K_1 + K_2 \log_{10} A + K_3 (\log_{10} A)^2,\quad C_{BM} = C_p^0 "
    r"F_{BM}\,\frac{I}{397}"
)


@formula(
    source="turton2018, eq. A.1, tables A.1 and A.7",
    equation=_EQUATION,
    title="Cost of equipment sized by area",
    typical={"area": (3.0, 6.0)},
)
def equipment_cost_by_area(
    area: Area,
    equipment_by_area: Literal[
        "plate_and_frame_filter",
        "tube_or_table_filter",
        "cartridge_filter",
        "disc_or_drum_filter",
        "gravity_filter",
        "leaf_filter",
        "drum_dryer",
        "rotary_dryer",
        "tray_dryer",
        "sieve_bend",
        "rotary_screen",
        "stationary_screen",
        "vibrating_screen",
        "apron_conveyor",
        "belt_conveyor",
        "pneumatic_conveyor",
        "screw_conveyor",
    ] = "plate_and_frame_filter",
    cost_index: PositiveNumber = BASE_INDEX,
) -> EquipmentCost:
    """Purchased and installed cost of filters, dryers, screens and conveyors from their area.

    Carbon steel, ambient pressure, US dollars of the year of the plant cost index given (397: mid 2001).
    Study estimate: ±30 %. Outside the sizes of the table the value is flagged as extrapolated. The printed
    curve of stationary screens falls beyond 7.2 m², that of rotary and vibrating screens below 0.7 m²: this
    is flagged too.

    >>> cost = equipment_cost_by_area(equipment_by_area="plate_and_frame_filter", area=10.0, cost_index=397.0)
    >>> f"{cost.purchased_cost:.4g} {cost.bare_module_cost:.4g}"
    '5e+04 9.001e+04'
    """
    return _cost(equipment_by_area, area, "area", "costs.equipment_cost_by_area", cost_index)


@formula(
    source="turton2018, eq. A.1, table A.1",
    fitted={"area": (10.0, 1000.0)},
    title="Cost of a shell-and-tube exchanger",
    typical={"area": (25.0, 500.0)},
    equation=r"\log_{10} C_p^0 = K_1 + K_2 \log_{10} A + K_3 (\log_{10} A)^2",
)
def purchased_cost_exchanger(
    area: Area,
    exchanger: Literal["floating_head_exchanger", "fixed_tube_exchanger"] = "floating_head_exchanger",
    cost_index: PositiveNumber = BASE_INDEX,
) -> Cost:
    """Purchased cost of a shell-and-tube heat exchanger from its area.

    Carbon steel, ambient pressure, US dollars of the year of the plant cost index given (397: mid 2001).

    >>> round(purchased_cost_exchanger(exchanger="floating_head_exchanger", area=100.0), -3)
    25000.0
    """
    return _cost(exchanger, area, "area", "", cost_index).purchased_cost


@formula(
    source="turton2018, eq. A.1, tables A.1 and A.7",
    equation=_EQUATION,
    title="Cost of equipment sized by volume",
    typical={"volume": (2.0, 20.0)},
    symbols={"volume": "A"},
)
def equipment_cost_by_volume(
    volume: Volume,
    equipment_by_volume: Literal[
        "batch_crystallizer", "baghouse", "cyclone_scrubber", "electrostatic_precipitator", "venturi_scrubber"
    ] = "batch_crystallizer",
    cost_index: PositiveNumber = BASE_INDEX,
) -> EquipmentCost:
    """Purchased and installed cost of batch crystallizers and dust collectors from their volume.

    Carbon steel, ambient pressure, US dollars of the year of the plant cost index given (397: mid 2001).

    >>> round(
    ...     equipment_cost_by_volume(equipment_by_volume="batch_crystallizer", volume=10.0).purchased_cost, -2
    ... )
    65600.0
    """
    return _cost(equipment_by_volume, volume, "volume", "costs.equipment_cost_by_volume", cost_index)


@formula(
    source="turton2018, eq. A.1, tables A.1 and A.7",
    equation=_EQUATION,
    title="Cost of a centrifuge",
    typical={"diameter": (0.5, 1.0)},
    symbols={"diameter": "A"},
)
def equipment_cost_by_diameter(
    diameter: Length,
    centrifuge: Literal[
        "solid_bowl_centrifuge",
        "batch_basket_centrifuge",
        "separator_centrifuge",
        "oscillating_screen_centrifuge",
    ] = "solid_bowl_centrifuge",
    cost_index: PositiveNumber = BASE_INDEX,
) -> EquipmentCost:
    """Purchased and installed cost of a centrifuge from its diameter.

    Carbon steel, US dollars of the year of the plant cost index given (397: mid 2001).

    >>> round(equipment_cost_by_diameter(centrifuge="solid_bowl_centrifuge", diameter=1.0).purchased_cost, -2)
    93300.0
    """
    return _cost(centrifuge, diameter, "diameter", "costs.equipment_cost_by_diameter", cost_index)


@formula(
    source="turton2018, eq. A.1, table A.1",
    title="Cost of an evaporator",
    typical={"area": (110.0, 450.0)},
    equation=r"\log_{10} C_p^0 = K_1 + K_2 \log_{10} A + K_3 (\log_{10} A)^2",
)
def purchased_cost_evaporator(
    area: Area,
    evaporator: Literal[
        "forced_circulation_evaporator",
        "falling_film_evaporator",
        "agitated_film_evaporator",
        "long_tube_evaporator",
    ] = "forced_circulation_evaporator",
    cost_index: PositiveNumber = BASE_INDEX,
) -> Cost:
    """Purchased cost of an evaporator from its heating area.

    Carbon steel, ambient pressure, US dollars of the year of the plant cost index given (397: mid 2001).

    >>> round(purchased_cost_evaporator(area=10.0, evaporator="forced_circulation_evaporator"), -3)
    276000.0
    """
    return _cost(evaporator, area, "area", "costs.purchased_cost_evaporator", cost_index).purchased_cost


@formula(
    source="turton2018, eq. A.1, table A.1",
    fitted={"volume_flow": (1.0, 100.0)},
    title="Cost of a fan",
    typical={"volume_flow": (5.0, 80.0)},
    equation=r"\log_{10} C_p^0 = K_1 + K_2 \log_{10} Q + K_3 (\log_{10} Q)^2",
)
def purchased_cost_fan(
    volume_flow: VolumeFlow,
    fan: Literal["radial_fan", "backward_curved_fan", "axial_vane_fan"] = "radial_fan",
    cost_index: PositiveNumber = BASE_INDEX,
) -> Cost:
    """Purchased cost of a fan from the volume flow of gas.

    Carbon steel, ambient pressure, US dollars of the year of the plant cost index given (397: mid 2001).

    >>> round(purchased_cost_fan(volume_flow=10.0, fan="radial_fan"), -2)
    4300.0
    """
    return _cost(fan, volume_flow, "volume_flow", "", cost_index).purchased_cost


@formula(
    source="turton2018, eq. A.1, table A.1",
    title="Cost of a pump",
    typical={"power": (2e3, 9e4)},
    equation=r"\log_{10} C_p^0 = K_1 + K_2 \log_{10} P + K_3 (\log_{10} P)^2",
)
def purchased_cost_pump(
    power: Power,
    pump: Literal["centrifugal_pump", "positive_displacement_pump"] = "centrifugal_pump",
    cost_index: PositiveNumber = BASE_INDEX,
) -> Cost:
    """Purchased cost of a pump with drive from its shaft power.

    Cast iron, ambient pressure, US dollars of the year of the plant cost index given (397: mid 2001).

    >>> round(purchased_cost_pump(power="10 kW", pump="centrifugal_pump"), -1)
    3950.0
    """
    return _cost(pump, power, "power", "costs.purchased_cost_pump", cost_index, KILOWATT).purchased_cost


@formula(
    source="turton2018, eq. A.1, tables A.1 and A.7",
    fitted={"power": (5e3, 1.5e5)},
    title="Cost of a mixer",
    typical={"power": (6e3, 1.4e5)},
    equation=_EQUATION,
    symbols={"power": "A"},
)
def equipment_cost_mixer(
    power: Power,
    mixer: Literal["impeller_mixer", "turbine_mixer"] = "impeller_mixer",
    cost_index: PositiveNumber = BASE_INDEX,
) -> EquipmentCost:
    """Purchased and installed cost of a stirrer with drive from its power.

    Carbon steel, US dollars of the year of the plant cost index given (397: mid 2001).

    >>> round(equipment_cost_mixer(power="10 kW", mixer="impeller_mixer").purchased_cost, -2)
    35600.0
    """
    return _cost(mixer, power, "power", "", cost_index, KILOWATT)


@formula(
    source="williams1947; peters2003, ch. 6",
    fitted={"capacity_ratio": (0.1, 10.0)},
    equation=r"C_p = C_{p,0}\left(\frac{S}{S_0}\right)^{n}",
    title="Cost of a larger or smaller piece of the same kind",
    typical={"scaling_exponent": (0.4, 0.9)},
    symbols={"purchased_cost_known": "C_{p,0}"},
)
def purchased_cost_scaled(
    purchased_cost_known: Cost, capacity_ratio: PositiveNumber, scaling_exponent: Ratio = 0.6
) -> Cost:
    """Cost of equipment of another capacity from a known price, by the six-tenths rule.

    Twice the capacity costs half as much again: 2**0.6 = 1.52. Exponents of single kinds of equipment go from
    less than 0.2 to more than 1 (Peters and others).

    They advise against it beyond ten times the capacity.

    >>> round(purchased_cost_scaled(purchased_cost_known=100.0, capacity_ratio=2.0), 1)
    151.6
    """
    return purchased_cost_known * capacity_ratio**scaling_exponent
