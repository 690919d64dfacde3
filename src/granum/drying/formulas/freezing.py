"""Freezing times of food: Plank's front and Pham's two straight lines."""

from __future__ import annotations

from typing import Any, Literal

import jax.numpy as jnp

from granum.core import formula, impossible
from granum.core.constants import ZERO_CELSIUS
from granum.core.kinds import (
    Density,
    HeatCapacity,
    HeatTransferCoefficient,
    Length,
    SpecificEnergy,
    Temperature,
    ThermalConductivity,
    Time,
)

DIRECTIONS = {"plate": 1.0, "cylinder": 2.0, "sphere": 3.0}
WARM = "Nothing freezes: the freezer must be colder than the temperature at which the product freezes."
_TYPICAL = {
    "half_thickness": (0.01, 0.05),
    "density": (800.0, 1100.0),
    "heat_of_fusion": (1.5e5, 3e5),
    "temperature_freezer": (228.0, 248.0),
    "temperature_freezing": (270.5, 272.5),
    "heat_transfer_coefficient": (10.0, 60.0),
    "thermal_conductivity": (1.0, 2.0),
}
_SYMBOLS = {
    "half_thickness": "a",
    "heat_of_fusion": "L_f",
    "temperature_freezer": "T_a",
    "temperature_freezing": "T_f",
    "thermal_conductivity": r"\lambda_f",
}


@formula(
    source="plank1941; singh2014, eq. 7.1 and ex. 7.1",
    equation=r"t_0 = \frac{\rho\,L_f}{T_f - T_a}\,\frac{a}{E}\left(\frac1h + \frac{a}{2\lambda_f}\right)",
    typical=_TYPICAL,
    symbols=_SYMBOLS,
    title="Freezing time (Plank)",
)
def freezing_time_plank(
    half_thickness: Length,
    density: Density,
    heat_of_fusion: SpecificEnergy,
    temperature_freezer: Temperature,
    temperature_freezing: Temperature,
    heat_transfer_coefficient: HeatTransferCoefficient,
    thermal_conductivity: ThermalConductivity,
    shape: Literal["plate", "cylinder", "sphere"] = "plate",
) -> Time:
    """Time for a front of ice to run from the surface to the middle of a body that is all at its freezing
    temperature at first.

    Cooling before and after are not in it (Pham's formula has them). The half thickness is the radius of a
    cylinder or sphere; a layer frozen from one side has its thickness for it. E is 1, 2 or 3. The heat of
    fusion is per kilogram of product.

    Singh and Heldman (example recalled, not opened): a ball of 7 cm, −1.25 °C in air at −40 °C, 50 W/(m² K):
    0.72 h.

    >>> t = freezing_time_plank("3.5 cm", 1000.0, 250e3, "-40 degC", "-1.25 degC", 50.0, 1.2, "sphere")
    >>> round(t / 3600, 2)
    0.72
    """
    E = DIRECTIONS[shape]
    impossible(
        ~(temperature_freezer < temperature_freezing),
        temperature_freezer,
        "temperature_freezer",
        0.0,
        temperature_freezing,
        WARM,
    )
    drive = temperature_freezing - temperature_freezer
    through = 1.0 / heat_transfer_coefficient + half_thickness / (2.0 * thermal_conductivity)
    return density * heat_of_fusion / jnp.where(drive > 0.0, drive, jnp.nan) * half_thickness / E * through


def freezing_temperature_mean(temperature_frozen: Any, temperature_freezer: Any) -> Any:
    """Pham's mean temperature of freezing, K, of foods that are mostly water."""
    Tc, Ta = temperature_frozen - ZERO_CELSIUS, temperature_freezer - ZERO_CELSIUS
    return ZERO_CELSIUS + 1.8 + 0.263 * Tc + 0.105 * Ta


@formula(
    source="pham1986; singh2014, ex. 7.2",
    equation=(
        r"t_0 = \frac{a}{E h}\left(\frac{\Delta H_1}{\Delta T_1} + \frac{\Delta H_2}{\Delta T_2}\right)"
        r"\left(1 + \frac{h a}{2\lambda_f}\right),\quad "
        r"\Delta H_1 = \rho\,c_p\,(T_1 - T_m),\ \Delta T_1 = \tfrac12(T_1 + T_m) - T_a,\ "
        r"\Delta H_2 = \rho_f\,[L_f + c_f\,(T_m - T_c)],\ \Delta T_2 = T_m - T_a,\quad "
        r"T_m = 1.8 + 0.263\,T_c + 0.105\,T_a\ (°C)"
    ),
    typical=_TYPICAL
    | {
        "density_frozen": (800.0, 1050.0),
        "specific_heat_capacity": (3200.0, 3900.0),
        "specific_heat_capacity_frozen": (1700.0, 2100.0),
        "temperature_inlet": (278.0, 298.0),
        "temperature_frozen": (250.0, 260.0),
    },
    symbols=_SYMBOLS
    | {
        "density_frozen": r"\rho_f",
        "specific_heat_capacity_frozen": "c_f",
        "temperature_inlet": "T_1",
        "temperature_frozen": "T_c",
    },
    title="Freezing time (Pham)",
)
def freezing_time_pham(
    half_thickness: Length,
    density: Density,
    heat_of_fusion: SpecificEnergy,
    temperature_inlet: Temperature,
    temperature_freezer: Temperature,
    temperature_frozen: Temperature,
    heat_transfer_coefficient: HeatTransferCoefficient,
    thermal_conductivity: ThermalConductivity,
    specific_heat_capacity: HeatCapacity = 3600.0,
    specific_heat_capacity_frozen: HeatCapacity = 1800.0,
    density_frozen: Density | None = None,
    shape: Literal["plate", "cylinder", "sphere"] = "plate",
) -> Time:
    """Time from the first temperature to that of the frozen middle: cooling and freezing as two steps, each
    with its heat and its mean driving force.

    For foods that are mostly water. The half thickness is the radius of a cylinder or sphere; a layer frozen
    from one side has its thickness for it. The heat of fusion is per kilogram of product. Without a frozen
    density it is the same as before.

    Singh and Heldman (example recalled, not opened): a ball of 7 cm from 10 to −18 °C, 75 % water: 3745 s.

    >>> t = freezing_time_pham(
    ...     "3.5 cm",
    ...     1000.0,
    ...     249900.0,
    ...     "10 degC",
    ...     "-40 degC",
    ...     "-18 degC",
    ...     50.0,
    ...     1.2,
    ...     3600.0,
    ...     1800.0,
    ...     950.0,
    ...     "sphere",
    ... )
    >>> round(t / 3600, 2)
    1.04
    """
    E, Ta, Tc, T1 = DIRECTIONS[shape], temperature_freezer, temperature_frozen, temperature_inlet
    Tm = freezing_temperature_mean(Tc, Ta)
    possible = (Ta < Tc) & (Ta < Tm) & (Tc < Tm)
    impossible(~(Ta < Tm), Ta, "temperature_freezer", 0.0, Tm, WARM)
    impossible((Ta < Tm) & ~possible, Tc, "temperature_frozen", Ta, Tm)
    frozen = density if density_frozen is None else density_frozen
    cooled = density * specific_heat_capacity * jnp.maximum(T1 - Tm, 0.0)
    freezes = frozen * (heat_of_fusion + specific_heat_capacity_frozen * (Tm - Tc))
    first, second = 0.5 * (jnp.maximum(T1, Tm) + Tm) - Ta, Tm - Ta
    steps = cooled / jnp.where(possible, first, 1.0) + freezes / jnp.where(possible, second, 1.0)
    biot = heat_transfer_coefficient * half_thickness / thermal_conductivity
    time = half_thickness / (E * heat_transfer_coefficient) * steps * (1.0 + 0.5 * biot)
    return jnp.where(possible, time, jnp.nan)
