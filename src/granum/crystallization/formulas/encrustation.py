"""The cooled wall: its temperature, and how large the temperature difference to the jacket may be before it
grows crystals.
"""

from __future__ import annotations

from granum.core import formula, impossible
from granum.core.kinds import HeatTransferCoefficient, Temperature, TemperatureDifference

OVERALL = "All resistances together pass less heat than the film on one side alone."


@formula(
    source="kern1950, ch. 20",
    title="Wall temperature in a jacket",
    equation=r"T_w = T - \frac{U}{h_i}(T - T_j)",
    output="wall_temperature",
    typical={
        "temperature": (300.0, 330.0),
        "jacket_temperature": (280.0, 300.0),
        "heat_transfer_coefficient": (200.0, 600.0),
        "heat_transfer_coefficient_inside": (800.0, 2000.0),
    },
    symbols={"heat_transfer_coefficient": "U", "heat_transfer_coefficient_inside": "h_i"},
)
def wall_temperature_jacket(
    temperature: Temperature,
    jacket_temperature: Temperature,
    heat_transfer_coefficient: HeatTransferCoefficient,
    heat_transfer_coefficient_inside: HeatTransferCoefficient,
) -> Temperature:
    """Temperature of the wall on the side of the suspension, from the overall coefficient and the one on that
    side.

    The heat that passes the film on the inside is the heat that goes to the jacket.

    >>> wall_temperature_jacket(
    ...     temperature=320.0,
    ...     jacket_temperature=300.0,
    ...     heat_transfer_coefficient=500,
    ...     heat_transfer_coefficient_inside=1000,
    ... )
    310.0
    """
    overall, inside = heat_transfer_coefficient, heat_transfer_coefficient_inside
    impossible(overall > inside, overall, "heat_transfer_coefficient", 0.0, inside, OVERALL)
    return temperature - heat_transfer_coefficient / heat_transfer_coefficient_inside * (
        temperature - jacket_temperature
    )


@formula(
    source="mullin2001, ch. 9; kern1950, ch. 20",
    title="Temperature difference without encrustation",
    equation=r"(T - T_j)_{max} = \frac{h_i}{U}(\Delta T_{max} - \Delta T)",
    output="temperature_difference",
    typical={
        "metastable_width": (4.0, 10.0),
        "undercooling": (0.5, 3.0),
        "heat_transfer_coefficient": (200.0, 600.0),
        "heat_transfer_coefficient_inside": (800.0, 2000.0),
    },
    symbols={
        "heat_transfer_coefficient": "U",
        "heat_transfer_coefficient_inside": "h_i",
        "temperature_difference": "(T - T_j)_{max}",
    },
)
def temperature_difference_encrustation(
    metastable_width: TemperatureDifference,
    heat_transfer_coefficient: HeatTransferCoefficient,
    heat_transfer_coefficient_inside: HeatTransferCoefficient,
    undercooling: TemperatureDifference = 0.0,
) -> TemperatureDifference:
    """Largest temperature difference between suspension and jacket that keeps the liquor at the wall
    metastable.

    The liquor is undercooled in the bulk already; the film takes the rest. A cooled wall that is undercooled
    by more than the metastable zone width nucleates and grows a crust.

    >>> temperature_difference_encrustation(
    ...     metastable_width=6.0,
    ...     heat_transfer_coefficient=500,
    ...     heat_transfer_coefficient_inside=1000,
    ...     undercooling=1.0,
    ... )
    10.0
    """
    return (metastable_width - undercooling) * heat_transfer_coefficient_inside / heat_transfer_coefficient
