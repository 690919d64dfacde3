"""Real moist air after Herrmann, Kretzschmar and Gatley (ASHRAE RP-1485): virial equation of state and
enhancement factor.
"""

from __future__ import annotations

from typing import Any, ClassVar

import jax
import jax.numpy as jnp

import granum.humid_gas.virials as vi
from granum.core import law
from granum.humid_gas.pairs import (
    AIR_WATER,
    ICE_ENTHALPY,
    LEAST_PRESSURE,
    MOST_PRESSURE,
    TRIPLE_POINT,
    AbstractPair,
    AirWater,
    ice_vapor_pressure,
    polynomial,
)
from granum.materials.formulas.water import water_boiling_temperature, water_vapor_pressure
from granum.numerics.quick_roots import newton_root

R = 8.314472  # J/(mol K), the report's own
ICE_VOLUME = (1.96521e-5, 3.144e-9, 5.5e-12)  # m³/mol in °C, IAPWS-06 within 1e-5 from −60 °C
ICE_COMPRESSIBILITY = 1.18e-10  # 1/Pa at 0 °C, IAPWS-06
PASSES = 8
LIQUID_MOLAR_VOLUME = 1.85e-5  # m³/mol, water about 60 °C: enough for a start value


@law(
    "gas_vapor_pair",
    name="air_water_real",
    source="herrmann2009; harvey2007; nelson2002; wagner2002; lemmon2000",
    title="Air and water, real gas (RP-1485)",
    fitted={"temperature": (183.15, 623.15), "pressure": (LEAST_PRESSURE, MOST_PRESSURE)},
    equation=r"\frac{p\,\bar v}{RT} = 1 + \frac{B_m}{\bar v} + \frac{C_m}{\bar v^2},\qquad y_s = f\,p_s/p",
)
class AirWaterReal(AbstractPair):
    """Air and water as a real mixture: virial coefficients, enhancement of the vapor pressure by the gas,
    compressed liquid and ice.

    −90 to 350 °C and up to 100 bar, as long as the gas stays well below the density at which a virial series
    of three terms ends. The report states 0.02 % for specific volumes and enthalpies of humid air at
    atmospheric pressure.
    """

    gas_molar_mass: ClassVar[float] = 0.028966
    vapor_molar_mass: ClassVar[float] = 0.018015268
    freezing_temperature: ClassVar[float] = TRIPLE_POINT
    lowest_temperature: ClassVar[float] = 183.15
    highest_temperature: ClassVar[float] = 900.0

    def lewis_factor(self) -> Any:
        return None

    def simplified(self) -> AbstractPair | None:
        return AIR_WATER

    def nearby(self) -> AbstractPair | None:
        return _NEARLY_REAL

    def boiling_temperature(self, P: Any) -> Any:
        return water_boiling_temperature.function(P)

    def _density(self, T: Any, P: Any, B: Any, C: Any) -> Any:
        """mol/m³, by Newton from the ideal gas; the slope is kept positive where the short series would bend
        over.
        """
        ideal = P / (R * T)

        def excess(rho: Any) -> Any:
            return rho * (1.0 + rho * (B + rho * C)) - ideal

        z = jnp.clip(B * ideal, -0.2, 0.2)  # the series turned round, where it converges
        start = ideal * (1.0 - z * (1.0 - 2.0 * z) - jnp.clip(C * ideal * ideal, -0.1, 0.1))
        return newton_root(excess, start, PASSES, 0.05)

    def molar_volume(self, T: Any, P: Any, y: Any) -> Any:
        B, C = vi.mixture(vi.virials(T), y)
        return 1.0 / self._density(T, P, B, C)

    def molar_enthalpy(self, T: Any, P: Any, y: Any) -> Any:
        v = vi.virials(T)
        (B, C), (TdB, TdC) = vi.mixture(v, y), vi.mixture(vi.slopes(T, v), y)
        rho = self._density(T, P, B, C)
        departure = R * T * rho * ((B - TdB) + rho * (C - 0.5 * TdC))
        return (1.0 - y) * vi.AIR_ENTHALPY(T) + y * vi.VAPOR_ENTHALPY(T) + departure

    def vapor_partial_enthalpy(self, T: Any, P: Any, y: Any) -> Any:
        h, slope = jax.jvp(lambda y: self.molar_enthalpy(T, P, y), (y,), (jnp.ones_like(y),))
        return h + (1.0 - y) * slope

    def condensate_molar_enthalpy(self, T: Any, P: Any, frozen: Any) -> Any:
        warm = jnp.clip(T, TRIPLE_POINT, 590.0)
        excess = P - water_vapor_pressure.function(warm)
        v = vi.LIQUID_VOLUME(warm)
        liquid = vi.LIQUID_ENTHALPY(warm) + excess * (v - warm * vi.LIQUID_VOLUME.slope(warm))
        if frozen is False:
            return liquid
        ice = (
            self.vapor_molar_mass * polynomial(ICE_ENTHALPY, T - 273.15)
            + polynomial(ICE_VOLUME, T - 273.15) * P
        )
        return jnp.where(frozen, ice, liquid)

    def saturated_fraction(self, T: Any, P: Any, frozen: Any) -> Any:
        warm = jnp.clip(T, TRIPLE_POINT, 590.0)
        pure = water_vapor_pressure.function(T)
        v, k, beta = (
            vi.LIQUID_VOLUME(warm),
            jnp.exp(vi.LOG_COMPRESSIBILITY(warm)),
            jnp.exp(vi.LOG_HENRY(warm)),
        )
        if frozen is not False:
            pure = jnp.where(frozen, ice_vapor_pressure(T), pure)
            v, k, beta = (
                jnp.where(frozen, polynomial(ICE_VOLUME, T - 273.15), v),
                jnp.where(frozen, ICE_COMPRESSIBILITY, k),
                jnp.where(frozen, 0.0, beta),
            )
        below = pure < P
        p = jnp.where(below, pure, 0.5 * P)
        f = self._enhancement(T, P, p, v, k, beta)
        return jnp.where(below, f * p, pure) / P

    def _enhancement(self, T: Any, P: Any, p: Any, volume: Any, k: Any, beta: Any) -> Any:
        """Factor by which air and pressure raise the vapor pressure (RP-1485, eq. 3.25), by Newton on its
        logarithm.
        """
        a = vi.virials(T)
        rt = 1.0 / (R * T)
        poynting = ((1.0 + k * p) * (P - p) - 0.5 * k * (P * P - p * p)) * rt * volume
        reduced = P * rt
        r2 = reduced * reduced
        share = p / P

        def rest(x: Any) -> Any:
            y = share * jnp.exp(x)
            z = 1.0 - y
            z2 = z * z
            second = reduced * (z2 * (a.Baa - 2.0 * a.Baw) - (1.0 - share - z2) * a.Bww)
            third = z2 * z * a.Caaa + 1.5 * z2 * (1.0 - 2.0 * z) * a.Caaw - 3.0 * z2 * y * a.Caww
            third = third - 0.5 * ((3.0 - 2.0 * y) * y * y - share * share) * a.Cwww
            third = (
                third
                - z2 * (3.0 * y - 2.0) * y * a.Baa * a.Bww
                - 2.0 * z2 * z * (3.0 * y - 1.0) * a.Baa * a.Baw
            )
            third = third + 6.0 * z2 * y * y * a.Bww * a.Baw - 1.5 * z2 * z2 * a.Baa * a.Baa
            third = third - 2.0 * z2 * y * (3.0 * y - 2.0) * a.Baw * a.Baw
            third = third - 0.5 * (share * share - (4.0 - 3.0 * y) * y * y * y) * a.Bww * a.Bww
            return poynting + jnp.log1p(-beta * z * P) + second + r2 * third - x

        # a Newton step from zero with the slope of the second virial terms alone; the curvature grows with
        # pressure
        slope = 1.0 + 2.0 * reduced * share * (1.0 - share) * (a.Baa - 2.0 * a.Baw + a.Bww)
        start = rest(jnp.zeros_like(share)) / jnp.clip(slope, 0.2, 2.0)
        found = newton_root(rest, start, PASSES, within=1e-4 / (1.0 + P / 1e5))
        return jnp.exp(jnp.maximum(found, 0.0))


class _NearlyReal(AirWater):
    """The real mixture with its second virial coefficients alone: wet bulbs within a millikelvin or so near
    1 bar.
    """

    def saturated_fraction(self, T: Any, P: Any, frozen: Any) -> Any:
        share = super().saturated_fraction(T, P, frozen)
        s = 1.0 / T
        z = 1.0 - jnp.minimum(share, 1.0)
        cross = vi.B_AIR(s) - 2.0 * vi.B_CROSS(s)
        steam = -jnp.exp(vi.LOG_B_WATER(s))
        x = P / (R * T) * (z * z * cross - (1.0 - share - z * z) * steam + z * LIQUID_MOLAR_VOLUME)
        return share * jnp.exp(jnp.clip(x, 0.0, 0.5))

    def molar_enthalpy(self, T: Any, P: Any, y: Any) -> Any:
        s = 1.0 / T
        steam = -jnp.exp(vi.LOG_B_WATER(s))
        z = 1.0 - y
        second = (
            z * z * (vi.B_AIR(s) + s * vi.B_AIR.slope(s))
            + 2.0 * z * y * (vi.B_CROSS(s) + s * vi.B_CROSS.slope(s))
            + y * y * steam * (1.0 + s * vi.LOG_B_WATER.slope(s))
        )
        return z * vi.AIR_ENTHALPY(T) + y * vi.VAPOR_ENTHALPY(T) + P * second


_NEARLY_REAL = _NearlyReal()
AIR_WATER_REAL = AirWaterReal()
