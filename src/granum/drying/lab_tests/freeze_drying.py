"""Lab tests of freeze drying: heat transfer to vials by weighing, resistance of the cake from the product's
temperature.
"""

from __future__ import annotations

from typing import Annotated, Any, ClassVar

import jax.numpy as jnp
import numpy as np

from granum.core import lab_test
from granum.core.errors import InputError
from granum.core.i18n import _
from granum.core.kinds import (
    Area,
    Concentration,
    Density,
    Distance,
    HeatTransferCoefficient,
    Mass,
    Pressure,
    Series,
    Temperature,
    Time,
    Volume,
)
from granum.drying.formulas.vials import (
    ICE_CONDUCTIVITY,
    SUBLIMATION_HEAT,
    cake_vapor_resistance,
    vial_heat_transfer,
    vial_of,
)
from granum.drying.kinds import (
    HeatTransferPerPressure,
    PerLength,
    PerPressure,
    VaporResistance,
    VaporResistanceGradient,
)
from granum.estimation import Fit, LabTest
from granum.humid_gas.pairs import ice_vapor_pressure


@lab_test(
    "vial_heat_test",
    source="pikal1985",
    title="Heat transfer to vials, by weighing",
    equation=r"K_v = \frac{\Delta H_s\,m}{A_v\,t\,(T_{sh}-T_b)} = K_C + \frac{K_P P}{1 + K_D P}",
)
class VialHeatTest(LabTest):
    """Coefficients of the heat transfer to vials from the ice that sublimes in a time at several chamber
    pressures.

    ``temperature_product`` is that of the vial bottom, ``mass_sublimed`` the loss of one vial.
    """

    pressure_chamber: Annotated[Pressure, Series("points")]
    mass_sublimed: Annotated[Mass, Series("points")]
    time: Annotated[Time, Series("points")]
    temperature_shelf: Annotated[Temperature, Series("points")]
    temperature_product: Annotated[Temperature, Series("points")]
    area_vial: Area
    estimates: ClassVar = {
        "vial_coefficient_contact": HeatTransferCoefficient,
        "vial_coefficient_gas": HeatTransferPerPressure,
        "vial_coefficient_saturation": PerPressure,
    }
    holds_for: ClassVar = ("pressure_chamber",)
    axes: ClassVar = {"pressure_chamber": Pressure, "heat_transfer_coefficient": HeatTransferCoefficient}
    least_points: ClassVar[int] = 4

    def coefficients(self) -> np.ndarray:
        """Heat transfer coefficient of each point, on the area of the vial."""
        difference = np.asarray(self.temperature_shelf) - np.asarray(self.temperature_product)
        if (difference <= 0).any():
            raise InputError(
                _("The shelf must be warmer than the product at every point."), name="temperature_shelf"
            )
        return (
            SUBLIMATION_HEAT
            * np.asarray(self.mass_sublimed)
            / (self.area_vial * np.asarray(self.time) * difference)
        )

    def fit(self) -> Fit:
        """The three coefficients with 95 % intervals."""
        self.above_zero("pressure_chamber", "time")
        P, K = np.asarray(self.pressure_chamber, dtype=float), self.coefficients()
        slope = max((K.max() - K.min()) / max(P.max() - P.min(), 1e-9), 1e-6)
        start = {
            "vial_coefficient_contact": max(K.min() - 0.5 * slope * P.min(), 0.1 * K.min()),
            "vial_coefficient_gas": 1.5 * slope,
            "vial_coefficient_saturation": 0.3 / P.max(),
        }

        def model(p: dict[str, Any], P: Any) -> Any:
            return vial_heat_transfer.function(
                P, p["vial_coefficient_contact"], p["vial_coefficient_gas"], p["vial_coefficient_saturation"]
            )

        return self.fitted(model, start, P, K, bounds=dict.fromkeys(start, (0.0, np.inf)))


@lab_test(
    "product_resistance_test",
    source="pikal1985; shivkumar2019",
    title="Resistance of a cake from the product temperature",
    equation=(
        r"R_p(L) = \frac{p_i(T_s) - P}{g},\quad g = \frac{K_v A_v (T_{sh}-T_b)}{\Delta H_s A_p},\quad T_s = "
        r"T_b - \frac{\Delta H_s g (L_0-L)}{k_i}"
    ),
)
class ProductResistanceTest(LabTest):
    """Resistance of the dry cake over its depth from the temperature at the vial bottom during primary
    drying.

    The heat transfer coefficient is that of ``vial_heat_test`` at the pressure of the run. Give the readings
    while ice is still under the thermocouple. With ``linear`` the resistance is taken to rise in proportion
    to the depth.
    """

    time: Annotated[Time, Series("points")]
    temperature_product: Annotated[Temperature, Series("points")]
    temperature_shelf: Annotated[Temperature, Series("points")]
    pressure_chamber: Pressure
    heat_transfer_coefficient: HeatTransferCoefficient
    area_vial: Area
    area_product: Area
    volume_fill: Volume
    concentration: Concentration
    solid_density: Density = 1500.0
    linear: bool = False
    estimates: ClassVar = {
        "vapor_resistance": VaporResistance,
        "vapor_resistance_slope": VaporResistanceGradient,
        "vapor_resistance_saturation": PerLength,
    }
    holds_for: ClassVar = ("pressure_chamber",)
    axes: ClassVar = {"dry_layer_thickness": Distance, "vapor_resistance": VaporResistance}
    least_points: ClassVar[int] = 4

    def points(self) -> tuple[np.ndarray, np.ndarray]:
        """Dry depth and resistance of each reading."""
        vial = vial_of(
            self.area_vial,
            self.area_product,
            self.volume_fill,
            self.concentration,
            self.solid_density,
            self.heat_transfer_coefficient,
            0.0,
            0.0,
            1.0,
            0.0,
            0.0,
            self.pressure_chamber,
        )
        t, bottom = np.asarray(self.time, dtype=float), np.asarray(self.temperature_product, dtype=float)
        heat = self.heat_transfer_coefficient * self.area_vial * (np.asarray(self.temperature_shelf) - bottom)
        flux = heat / (SUBLIMATION_HEAT * self.area_product)
        if (flux <= 0).any():
            raise InputError(
                _("The shelf must be warmer than the product at every point."), name="temperature_shelf"
            )
        grown = np.concatenate([[flux[0] * t[0]], 0.5 * (flux[1:] + flux[:-1]) * np.diff(t)])
        height = float(vial.height)
        depth = np.cumsum(grown) / float(vial.ice_per_height)
        if depth[-1] > 1.02 * height:
            at = int(np.argmax(depth > 1.02 * height)) + 1
            raise InputError(
                _(
                    "By reading {number} more ice would have sublimed than the vial held: check the "
                    "heat transfer coefficient and the fill."
                ).format(number=at)
            )
        front = bottom - SUBLIMATION_HEAT * flux * np.maximum(height - depth, 0.0) / ICE_CONDUCTIVITY
        return depth, (np.asarray(ice_vapor_pressure(jnp.asarray(front))) - self.pressure_chamber) / flux

    def fit(self) -> Fit:
        """Resistance at the top, its slope and its leveling off, with 95 % intervals."""
        self.increasing("time")
        depth, R = self.points()
        slope = max((R[-1] - R[0]) / max(depth[-1] - depth[0], 1e-9), 1.0)
        start = {"vapor_resistance": max(R[0], 1e-3 * R.max()), "vapor_resistance_slope": slope}
        if not self.linear:
            start |= {"vapor_resistance_saturation": 0.1 / depth[-1]}

        def model(p: dict[str, Any], L: Any) -> Any:
            return cake_vapor_resistance.function(
                L,
                p["vapor_resistance"],
                p["vapor_resistance_slope"],
                p.get("vapor_resistance_saturation", 0.0),
            )

        return self.fitted(model, start, depth, R, bounds=dict.fromkeys(start, (0.0, np.inf)))
