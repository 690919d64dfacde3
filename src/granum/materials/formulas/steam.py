"""Steam and the heat of vaporization of water: IAPWS Industrial Formulation 1997, region 2."""

from __future__ import annotations

from typing import Any

import jax.numpy as jnp
import numpy as np

from granum.core import formula
from granum.core.constants import STANDARD_ATMOSPHERE
from granum.core.kinds import Density, HeatCapacity, Pressure, SpecificEnergy, Temperature
from granum.materials.formulas.water import R_WATER, water_enthalpy, water_vapor_pressure

# (J, n) of IF97 table 10, (I, J, n) of table 11
_IDEAL = np.array([
    (0, -0.96927686500217e1), (1, 0.10086655968018e2), (-5, -0.56087911283020e-2), (-4, 0.71452738081455e-1), (-3, -0.40710498223928),  # noqa: E501
    (-2, 0.14240819171444e1), (-1, -0.43839511319450e1), (2, -0.28408632460772), (3, 0.21268463753307e-1),
])  # fmt: skip
_RESIDUAL = np.array([
    (1, 0, -0.0017731742473213), (1, 1, -0.017834862292358), (1, 2, -0.045996013696365), (1, 3, -0.057581259083432),  # noqa: E501
    (1, 6, -0.05032527872793), (2, 1, -3.3032641670203e-05), (2, 2, -0.00018948987516315), (2, 4, -0.0039392777243355),  # noqa: E501
    (2, 7, -0.043797295650573), (2, 36, -2.6674547914087e-05), (3, 0, 2.0481737692309e-08), (3, 1, 4.3870667284435e-07),  # noqa: E501
    (3, 3, -3.227767723857e-05), (3, 6, -0.0015033924542148), (3, 35, -0.040668253562649), (4, 1, -7.8847309559367e-10),  # noqa: E501
    (4, 2, 1.2790717852285e-08), (4, 3, 4.8225372718507e-07), (5, 7, 2.2922076337661e-06), (6, 3, -1.6714766451061e-11),  # noqa: E501
    (6, 16, -0.0021171472321355), (6, 35, -23.895741934104), (7, 0, -5.905956432427e-18), (7, 11, -1.2621808899101e-06),  # noqa: E501
    (7, 25, -0.038946842435739), (8, 8, 1.1256211360459e-11), (8, 36, -8.2311340897998), (9, 13, 1.9809712802088e-08),  # noqa: E501
    (10, 4, 1.0406965210174e-19), (10, 10, -1.0234747095929e-13), (10, 14, -1.0018179379511e-09),
    (16, 29, -8.0882908646985e-11), (16, 50, 0.10693031879409), (18, 57, -0.33662250574171), (20, 20, 8.9185845355421e-25),  # noqa: E501
    (20, 35, 3.0629316876232e-13), (20, 48, -4.2002467698208e-06), (21, 21, -5.9056029685639e-26),
    (22, 53, 3.7826947613457e-06), (23, 39, -1.2768608934681e-15), (24, 26, 7.3087610595061e-29), (24, 40, 5.5414715350778e-17),  # noqa: E501
    (24, 58, -9.436970724121e-07),
])  # fmt: skip
_RANGE = {"temperature": (273.15, 1073.15), "pressure": (0.0, 100e6)}
_TYPICAL = {"temperature": (400.0, 700.0)}


def _reduced(T: Any, p: Any) -> tuple[Any, Any, Any, Any]:
    """Reduced pressure and temperature, and the powers of the residual part."""
    pi, tau = jnp.asarray(p / 1e6), jnp.asarray(540.0 / T)
    I, J, _n = _RESIDUAL.T
    b = jnp.maximum(tau - 0.5, 1e-6)[..., None]
    return pi, tau, pi[..., None] ** I, b**J / b**2  # the second carries J − 2, enough for every derivative


def _ideal_tau(tau: Any) -> Any:
    J, n = _IDEAL.T
    return jnp.sum(n * J * tau[..., None] ** (J - 1), -1)


def _ideal_tau_tau(tau: Any) -> Any:
    J, n = _IDEAL.T
    return jnp.sum(n * J * (J - 1) * tau[..., None] ** (J - 2), -1)


@formula(
    source="iapwsif97, eq. 15, table 12",
    equation=(
        r"\rho_g = \frac{p}{R T\,\pi(\gamma^0_\pi + \gamma^r_\pi)},\quad "
        r"\pi = \frac{p}{1\,\mathrm{MPa}}"
    ),
    fitted=_RANGE,
    typical=_TYPICAL,
    output="gas_density",
    title="Density of steam (IAPWS-IF97)",
)
def steam_density(temperature: Temperature, pressure: Pressure = STANDARD_ATMOSPHERE) -> Density:
    """Density of steam, from low pressure to the saturation line.

    >>> round(1 / steam_density(temperature=700.0, pressure="30 MPa"), 11)
    0.00542946619
    """
    _pi, tau, power, series = _reduced(temperature, pressure)
    I, _J, n = _RESIDUAL.T
    residual = jnp.sum(n * I * power * series, -1) * (tau - 0.5) ** 2
    return pressure / (R_WATER * temperature * (1.0 + residual))


@formula(
    source="iapwsif97, eq. 15, table 12",
    equation=r"h = R T\,\tau(\gamma^0_\tau + \gamma^r_\tau)",
    fitted=_RANGE,
    typical=_TYPICAL,
    output="specific_enthalpy",
    title="Enthalpy of steam (IAPWS-IF97)",
)
def steam_enthalpy(temperature: Temperature, pressure: Pressure = STANDARD_ATMOSPHERE) -> SpecificEnergy:
    """Specific enthalpy of steam on the scale of ``water_enthalpy``.

    >>> round(steam_enthalpy(temperature=700.0, pressure="0.0035 MPa") / 1e3, 5)
    3335.68375
    """
    _pi, tau, power, series = _reduced(temperature, pressure)
    _I, J, n = _RESIDUAL.T
    residual = jnp.sum(n * power * J * series, -1) * (tau - 0.5)
    return R_WATER * temperature * tau * (_ideal_tau(tau) + residual)


@formula(
    source="iapwsif97, eq. 15, table 12",
    equation=(
        r"c_p = -R\tau^2(\gamma^0_{\tau\tau} + \gamma^r_{\tau\tau}),\quad \tau = \frac{540\,\mathrm "
        r"K}{T}"
    ),
    fitted=_RANGE,
    typical=_TYPICAL,
    output="specific_heat_capacity",
    title="Heat capacity of steam (IAPWS-IF97)",
)
def steam_heat_capacity(temperature: Temperature, pressure: Pressure = STANDARD_ATMOSPHERE) -> HeatCapacity:
    """Isobaric heat capacity of steam.

    >>> round(steam_heat_capacity(temperature=300.0, pressure="0.0035 MPa"), 5)
    1913.00162
    """
    _pi, tau, power, series = _reduced(temperature, pressure)
    _I, J, n = _RESIDUAL.T
    residual = jnp.sum(n * power * J * (J - 1) * series, -1)
    return -R_WATER * tau**2 * (_ideal_tau_tau(tau) + residual)


@formula(
    source="iapwsif97, eq. 16",
    equation=r"c_p^0 = -R\tau^2\gamma^0_{\tau\tau},\quad \tau = \frac{540\,\mathrm K}{T}",
    fitted={"temperature": (273.15, 1073.15)},
    typical=_TYPICAL,
    output="specific_heat_capacity",
    title="Heat capacity of dilute steam (IAPWS-IF97)",
)
def steam_heat_capacity_ideal(temperature: Temperature) -> HeatCapacity:
    """Isobaric heat capacity of water vapor in the limit of zero pressure, as humid gas takes it.

    >>> round(steam_heat_capacity_ideal(temperature=300.0), 0)
    1865.0
    """
    tau = jnp.asarray(540.0 / temperature)
    return -R_WATER * tau**2 * _ideal_tau_tau(tau)


@formula(
    source="iapwsif97, eq. 7, 15 and 30",
    equation=r"L_v = h''(T) - h'(T)",
    fitted={"temperature": (273.15, 623.15)},
    output="heat_of_vaporization",
    title="Heat of vaporization of water (IAPWS-IF97)",
)
def water_heat_of_vaporization(temperature: Temperature) -> SpecificEnergy:
    """Heat of vaporization of water at saturation: enthalpy of the saturated vapor less that of the saturated
    liquid.

    >>> round(water_heat_of_vaporization(temperature="100 degC") / 1e3, 1)
    2256.5
    """
    p = water_vapor_pressure(temperature)
    return steam_enthalpy(temperature, p) - water_enthalpy(temperature, p)
