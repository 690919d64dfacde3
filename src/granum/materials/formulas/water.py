"""Liquid water and its saturation line: IAPWS Industrial Formulation 1997, regions 1 and 4."""

from __future__ import annotations

from typing import Any, NamedTuple

import jax.numpy as jnp
import numpy as np

from granum.core import formula
from granum.core.constants import STANDARD_ATMOSPHERE
from granum.core.kinds import Density, HeatCapacity, Pressure, SpecificEnergy, SurfaceTension, Temperature

R_WATER = 461.526  # J/(kg K), IF97's own
_N4 = (
    0.0,
    0.11670521452767e4,
    -0.72421316703206e6,
    -0.17073846940092e2,
    0.12020824702470e5,
    -0.32325550322333e7,
    0.14915108613530e2,
    -0.48232657361591e4,
    0.40511340542057e6,
    -0.23855557567849,
    0.65017534844798e3,
)
# (I, J, n) of IF97 table 2
_REGION_1 = np.array([
    (0, -2, 0.14632971213167), (0, -1, -0.84548187169114), (0, 0, -0.37563603672040e1), (0, 1, 0.33855169168385e1),  # noqa: E501
    (0, 2, -0.95791963387872), (0, 3, 0.15772038513228), (0, 4, -0.16616417199501e-1), (0, 5, 0.81214629983568e-3),  # noqa: E501
    (1, -9, 0.28319080123804e-3), (1, -7, -0.60706301565874e-3), (1, -1, -0.18990068218419e-1),
    (1, 0, -0.32529748770505e-1), (1, 1, -0.21841717175414e-1), (1, 3, -0.52838357969930e-4),
    (2, -3, -0.47184321073267e-3), (2, 0, -0.30001780793026e-3), (2, 1, 0.47661393906987e-4),
    (2, 3, -0.44141845330846e-5), (2, 17, -0.72694996297594e-15), (3, -4, -0.31679644845054e-4),
    (3, 0, -0.28270797985312e-5), (3, 6, -0.85205128120103e-9), (4, -5, -0.22425281908000e-5),
    (4, -2, -0.65171222895601e-6), (4, 10, -0.14341729937924e-12), (5, -8, -0.40516996860117e-6),
    (8, -11, -0.12734301741641e-8), (8, -6, -0.17424871230634e-9), (21, -29, -0.68762131295531e-18),
    (23, -31, 0.14478307828521e-19), (29, -38, 0.26335781662795e-22), (30, -39, -0.11947622640071e-22),
    (31, -40, 0.18228094581404e-23), (32, -41, -0.93537087292458e-25),
])  # fmt: skip


@formula(
    source="iapwsif97, eq. 30",
    equation=(
        r"p_v = \left[\frac{2C}{-B+(B^2-4AC)^{1/2}}\right]^4 \mathrm{MPa},\quad \vartheta = T + "
        r"\frac{n_9}{T-n_{10}}"
    ),
    fitted={"temperature": (273.15, 647.096)},
    output="vapor_pressure",
    title="Vapor pressure of water (IAPWS-IF97)",
)
def water_vapor_pressure(temperature: Temperature) -> Pressure:
    """Saturation pressure of water over the liquid.

    Within 0.025 % of the scientific formulation up to the critical point. Below 0 °C it continues over
    supercooled liquid; over ice use ``ice_vapor_pressure``.

    >>> round(water_vapor_pressure(temperature=300.0), 5)
    3536.58941
    """
    n = _N4
    # Outside 10 K … critical point the square root would turn imaginary; the value there is of no use but
    # must stay finite.
    T = jnp.clip(temperature, 150.0, 647.096)
    theta = T + n[9] / (T - n[10])
    A = theta**2 + n[1] * theta + n[2]
    B = n[3] * theta**2 + n[4] * theta + n[5]
    C = n[6] * theta**2 + n[7] * theta + n[8]
    return (2 * C / (-B + jnp.sqrt(B**2 - 4 * A * C))) ** 4 * 1e6


@formula(
    source="iapwsif97, eq. 31",
    equation=(
        r"T_b = \tfrac12\left[n_{10}+D-\left((n_{10}+D)^2-4(n_9+n_{10}D)\right)^{1/2}\right],\quad D = "
        r"D(p)"
    ),
    fitted={"pressure": (611.213, 22.064e6)},
    typical={"pressure": (1e3, 1e6)},
    output="boiling_temperature",
    title="Boiling temperature of water (IAPWS-IF97)",
)
def water_boiling_temperature(pressure: Pressure) -> Temperature:
    """Saturation temperature of water at a pressure; also the dew point of vapor at that partial pressure.

    >>> round(water_boiling_temperature(pressure="1 bar"), 3)
    372.756
    """
    n = _N4
    b = (jnp.clip(pressure, 1e-3, 22.064e6) / 1e6) ** 0.25
    E = b**2 + n[3] * b + n[6]
    F = n[1] * b**2 + n[4] * b + n[7]
    G = n[2] * b**2 + n[5] * b + n[8]
    D = 2 * G / (-F - jnp.sqrt(F**2 - 4 * E * G))
    return (n[10] + D - jnp.sqrt((n[10] + D) ** 2 - 4 * (n[9] + n[10] * D))) / 2


class _Gibbs(NamedTuple):
    pi: Any  # derivatives of the dimensionless Gibbs energy with respect to reduced pressure …
    tau: Any  # … and reciprocal reduced temperature
    tau_tau: Any


def _region_1(T: Any, p: Any) -> tuple[Any, Any, _Gibbs]:
    pi, tau = jnp.asarray(p / 16.53e6), jnp.asarray(1386.0 / T)
    I, J, n = _REGION_1.T
    a, b = (7.1 - pi)[..., None], (tau - 1.222)[..., None]
    power, series = a**I, b**J
    g_pi = -jnp.sum(n * I * a ** (I - 1) * series, -1)
    g_tau = jnp.sum(n * power * J * b ** (J - 1), -1)
    g_tau_tau = jnp.sum(n * power * J * (J - 1) * b ** (J - 2), -1)
    return pi, tau, _Gibbs(g_pi, g_tau, g_tau_tau)


_RANGE_1 = {"temperature": (273.15, 623.15), "pressure": (0.0, 100e6)}


@formula(
    source="iapwsif97, eq. 7, table 3",
    equation=r"\rho_l = \frac{p}{R T\,\pi\gamma_\pi},\quad \pi = \frac{p}{16.53\,\mathrm{MPa}}",
    fitted=_RANGE_1,
    output="liquid_density",
    title="Density of liquid water (IAPWS-IF97)",
)
def water_density(temperature: Temperature, pressure: Pressure = STANDARD_ATMOSPHERE) -> Density:
    """Density of liquid water.

    Within 0.003 % of the scientific formulation. Valid up to the saturation line; a little beyond
    (superheated liquid) it stays smooth.

    >>> round(1 / water_density(temperature=300.0, pressure="3 MPa"), 11)
    0.00100215168
    """
    _pi, _tau, g = _region_1(temperature, pressure)
    return 16.53e6 / (R_WATER * temperature * g.pi)


@formula(
    source="iapwsif97, eq. 7, table 3",
    equation=r"h = R T\,\tau\gamma_\tau",
    fitted=_RANGE_1,
    output="specific_enthalpy",
    title="Enthalpy of liquid water (IAPWS-IF97)",
)
def water_enthalpy(temperature: Temperature, pressure: Pressure = STANDARD_ATMOSPHERE) -> SpecificEnergy:
    """Specific enthalpy of liquid water; internal energy and entropy are zero for the liquid at the triple
    point.

    >>> round(water_enthalpy(temperature=300.0, pressure="3 MPa") / 1e3, 6)
    115.331273
    """
    _pi, tau, g = _region_1(temperature, pressure)
    return R_WATER * temperature * tau * g.tau


@formula(
    source="iapwsif97, eq. 7, table 3",
    equation=r"c_p = -R\,\tau^2\gamma_{\tau\tau},\quad \tau = \frac{1386\,\mathrm K}{T}",
    fitted=_RANGE_1,
    output="specific_heat_capacity",
    title="Heat capacity of liquid water (IAPWS-IF97)",
)
def water_heat_capacity(temperature: Temperature, pressure: Pressure = STANDARD_ATMOSPHERE) -> HeatCapacity:
    """Isobaric heat capacity of liquid water.

    >>> round(water_heat_capacity(temperature=300.0, pressure="3 MPa"), 5)
    4173.01218
    """
    _pi, tau, g = _region_1(temperature, pressure)
    return -R_WATER * tau**2 * g.tau_tau


@formula(
    source="iapwsr176, eq. 1",
    equation=r"\sigma = 235.8\left(1-\tfrac{T}{T_c}\right)^{1.256}\left[1-0.625\left(1-\tfrac{T}{T_c}\right)\right]\ \mathrm{mN/m}",  # noqa: E501
    fitted={"temperature": (248.15, 647.096)},
    output="surface_tension",
    title="Surface tension of water (IAPWS)",
)
def water_surface_tension(temperature: Temperature) -> SurfaceTension:
    """Surface tension of water against its vapor.

    Within 0.5 % around room temperature; extrapolates reasonably into the supercooled liquid.

    >>> round(water_surface_tension(temperature="20 degC") * 1e3, 2)
    72.74
    """
    tau = 1.0 - jnp.clip(temperature, 1.0, 647.0959) / 647.096
    return 235.8e-3 * tau**1.256 * (1.0 - 0.625 * tau)
