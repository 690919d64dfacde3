"""Metastable zone width against cooling rate: Nývlt, Kubota and Sangwal."""

from __future__ import annotations

from typing import Annotated, Any, ClassVar

import jax.numpy as jnp
import numpy as np

from granum.core import formula, lab_test
from granum.core.constants import AVOGADRO, BOLTZMANN, GAS_CONSTANT
from granum.core.kinds import (
    Density,
    MolarEnergy,
    MolarMass,
    Number,
    NumberDensity,
    PositiveNumber,
    Series,
    SurfaceTension,
    Temperature,
    TemperatureDifference,
    TemperatureRate,
)
from granum.estimation import Fit, LabTest
from granum.estimation.lines import straight_line


@formula(
    source="nyvlt1968; kubota2008",
    title="Metastable undercooling",
    equation=r"\Delta T_{max} = (R/K)^{1/m}",
    output="undercooling",
    typical={"cooling_rate": (1e-4, 1e-2), "nyvlt_constant": (1e-6, 1e-4), "nyvlt_order": (2.0, 5.0)},
    symbols={"undercooling": r"\Delta T_{max}"},
)
def undercooling_metastable(
    cooling_rate: TemperatureRate, nyvlt_constant: TemperatureRate, nyvlt_order: PositiveNumber
) -> TemperatureDifference:
    """Metastable zone width at a cooling rate, by Nývlt's line; the constant is the rate that gives one
    kelvin.

    >>> round(undercooling_metastable(cooling_rate=8e-3, nyvlt_constant=1e-3, nyvlt_order=3.0), 6)
    2.0
    """
    return (cooling_rate / nyvlt_constant) ** (1.0 / nyvlt_order)


@lab_test(
    "metastable_zone",
    source="nyvlt1968; kubota2008",
    title="Metastable zone width by cooling rate (Nývlt, Kubota)",
    equation=r"\ln\Delta T_{max} = \frac{1}{m}\,(\ln R - \ln K)",
)
class MetastableZone(LabTest):
    """Apparent nucleation order and the rate for one kelvin of zone width, from the first crystals at several
    cooling rates.

    Kubota reads the same line differently: the crystals counted are all those born since saturation, N = ∫ k
    ΔT^n dt = k ΔT^(n+1) / ((n+1) R), so that his nucleation order is one less, n = m - 1, and with the number
    density N that the detector sees his rate constant is k = N m K, in 1/(m³ s K^n).
    """

    cooling_rate: Annotated[TemperatureRate, Series("points")]
    undercooling: Annotated[TemperatureDifference, Series("points")]
    detected_number_density: NumberDensity | None = None

    estimates: ClassVar = {"nyvlt_order": Number, "nyvlt_constant": TemperatureRate}
    holds_for: ClassVar = ("cooling_rate",)
    axes: ClassVar = {"cooling_rate": TemperatureRate, "undercooling": TemperatureDifference}

    def fit(self) -> Fit:
        """Order and constant with 95 % intervals."""
        self.above_zero("cooling_rate", "undercooling")
        R, dT = np.asarray(self.cooling_rate), np.asarray(self.undercooling)
        slope, level = straight_line(np.log(R), np.log(dT))
        m = float(1.0 / slope)

        def derived(p: dict[str, Any]) -> dict[str, Any]:
            out = {"kubota_order": p["nyvlt_order"] - 1.0}
            if self.detected_number_density is not None:
                out["kubota_coefficient"] = (
                    self.detected_number_density * p["nyvlt_order"] * p["nyvlt_constant"]
                )
            return out

        return self.fitted(
            lambda p, R: (jnp.log(R) - jnp.log(p["nyvlt_constant"])) / p["nyvlt_order"],
            {"nyvlt_order": m, "nyvlt_constant": float(np.exp(-level * m))},
            R,
            np.log(dT),
            bounds={"nyvlt_constant": (0.0, np.inf)},
            derived=derived,
        )

    def chart(self) -> Any:
        """Zone width against cooling rate, both logarithmic."""
        return _chart(self, np.asarray(self.cooling_rate), np.asarray(self.undercooling), np.exp)


@lab_test(
    "metastable_zone_sangwal",
    source="sangwal2009",
    title="Metastable zone width by classical nucleation (Sangwal)",
    equation=r"\left(\frac{T_0}{\Delta T_{max}}\right)^2 = F_1\,(X - \ln R)",
)
class MetastableZoneSangwal(LabTest):
    """Interfacial energy from the metastable zone width at several cooling rates, by Sangwal's use of
    classical nucleation theory.

    The slope is ``(ΔH/(R T))² / B`` with ``B = (16π/3)(γ v^(2/3)/(kT))³``, from which the interfacial energy
    follows.
    """

    cooling_rate: Annotated[TemperatureRate, Series("points")]
    undercooling: Annotated[TemperatureDifference, Series("points")]
    temperature_saturation: Temperature
    enthalpy_of_dissolution: MolarEnergy
    crystal_density: Density
    molar_mass: MolarMass

    estimates: ClassVar = {"sangwal_slope": PositiveNumber, "sangwal_constant": Number}
    holds_for: ClassVar = ("cooling_rate",)
    axes: ClassVar = {"cooling_rate": TemperatureRate, "undercooling": TemperatureDifference}

    def fit(self) -> Fit:
        """Slope and constant with 95 % intervals; the interfacial energy from the slope."""
        self.above_zero("cooling_rate", "undercooling")
        R, y = (
            np.asarray(self.cooling_rate),
            (self.temperature_saturation / np.asarray(self.undercooling)) ** 2,
        )
        slope, level = straight_line(np.log(R), y)
        T, v = self.temperature_saturation, self.molar_mass / (self.crystal_density * AVOGADRO)

        def derived(p: dict[str, Any]) -> dict[str, Any]:
            B = (self.enthalpy_of_dissolution / (GAS_CONSTANT * T)) ** 2 / p["sangwal_slope"]
            return {
                "interfacial_energy": BOLTZMANN
                * T
                / v ** (2.0 / 3.0)
                * (3.0 * B / (16.0 * jnp.pi)) ** (1.0 / 3.0)
            }

        return self.fitted(
            lambda p, R: p["sangwal_slope"] * (p["sangwal_constant"] - jnp.log(R)),
            {"sangwal_slope": float(max(-slope, 1e-6)), "sangwal_constant": float(level / max(-slope, 1e-6))},
            R,
            y,
            bounds={"sangwal_slope": (0.0, np.inf)},
            derived=derived,
            kinds={"interfacial_energy": SurfaceTension},
        )

    def chart(self) -> Any:
        """Zone width against cooling rate, both logarithmic."""
        T = float(self.temperature_saturation)
        return _chart(
            self, np.asarray(self.cooling_rate), np.asarray(self.undercooling), lambda y: T / np.sqrt(y)
        )


def _chart(test: LabTest, rate: np.ndarray, width: np.ndarray, back: Any) -> Any:
    from granum.core.charts import add_line, add_points, axis_title, figure
    from granum.core.i18n import _

    grid = np.geomspace(0.7 * rate.min(), 1.4 * rate.max(), 60)
    drawing = figure(
        axis_title("cooling_rate", "K/hour"),
        axis_title("undercooling", "K"),
        title=type(test).card.title,
        x_log=True,
        y_log=True,
    )
    add_line(drawing, grid * 3600, back(test.fit().predict(grid).value), _("model"))
    add_points(drawing, rate * 3600, width, _("data"))
    return drawing
