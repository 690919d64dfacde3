"""Forms of property correlations: how a handful of coefficients makes a property a function of
temperature.

Each form is a card, and a member of the family ``correlation``: the ``form`` of a property in a material's
TOML file is the part of its name after ``correlation_``. The unit of the value is whatever the coefficients
were fitted in.
"""

from __future__ import annotations

from typing import Annotated, Any

import jax.numpy as jnp

from granum.core import formula, impossible, watch
from granum.core.constants import ZERO_CELSIUS
from granum.core.kinds import KinematicViscosity, Number, Series, Temperature

TWO_TEMPERATURES = "The upper temperature has to lie above the lower one."
THINNER = "An oil is thinner at the upper temperature than at the lower one."

Coefficients = Annotated[Number, Series("coefficients")]


def _horner(coefficients: Any, x: Any) -> Any:
    """Polynomial, lowest power first."""
    total = 0.0 * x
    for i in reversed(range(coefficients.shape[0])):
        total = total * x + coefficients[i]
    return total


@formula(
    source="walther1931; astm341",
    equation=r"\frac{\lg\lg(\nu + 0.7) - \lg\lg(\nu_1 + 0.7)}{\lg\lg(\nu_2 + 0.7) - \lg\lg(\nu_1 + 0.7)}"
    r" = \frac{\lg(T/T_1)}{\lg(T_2/T_1)}\quad (\mathrm{mm^2/s})",
    title="Kinematic viscosity of an oil (Walther)",
    typical={
        "temperature_lower": (300.0, 320.0),
        "temperature_upper": (360.0, 380.0),
        "kinematic_viscosity_lower": (2e-5, 5e-4),
        "kinematic_viscosity_upper": (4e-6, 3e-5),
    },
    fitted={"kinematic_viscosity": (2e-6, 2e-2)},
)
def kinematic_viscosity_walther(
    temperature: Temperature,
    temperature_lower: Temperature,
    kinematic_viscosity_lower: KinematicViscosity,
    temperature_upper: Temperature,
    kinematic_viscosity_upper: KinematicViscosity,
) -> KinematicViscosity:
    """Kinematic viscosity of an oil from those at two temperatures, such as the 40 and 100 °C of its data
    sheet.

    >>> nu = kinematic_viscosity_walther("20 degC", "40 degC", "46 cSt", "100 degC", "6.82 cSt")
    >>> round(1e6 * nu, 1)
    133.5
    """
    first, second = temperature_lower, temperature_upper
    impossible(second <= first, second, "temperature_upper", first, jnp.inf, TWO_TEMPERATURES)
    thin, thick = kinematic_viscosity_upper, kinematic_viscosity_lower
    impossible(thin >= thick, thin, "kinematic_viscosity_upper", 0.0, thick, THINNER)
    apart = jnp.where(first == second, 1.0, jnp.log(second / first))
    one, other = _doubly(kinematic_viscosity_lower), _doubly(kinematic_viscosity_upper)
    inside = one + (other - one) * jnp.log(temperature / first) / apart
    return 1e-6 * (jnp.exp(jnp.exp(jnp.clip(inside, -30.0, 5.5))) - 0.7)


def _doubly(viscosity: Any) -> Any:
    """The doubly logarithmic scale of the chart; what is thinner than 0.31 mm²/s has no place on it."""
    return jnp.log(jnp.log(jnp.maximum(1e6 * viscosity, 0.31) + 0.7))


@formula(source="green2008, sec. 2", equation=r"y = \sum_i c_i T^i", title="Polynomial in kelvin")
def correlation_polynomial(temperature: Temperature, coefficients: Coefficients) -> Number:
    """Polynomial in the absolute temperature, lowest power first (DIPPR equation 100).

    >>> round(
    ...     correlation_polynomial(temperature=300.0, coefficients=[102640.0, -139.63, -0.030341, 0.0020386]),
    ...     0,
    ... )
    113063.0
    """
    return _horner(jnp.asarray(coefficients), temperature)


@formula(
    source="mullin2001, app. A.4",
    equation=r"y = \sum_i c_i (T - 273.15)^i",
    title="Polynomial in degrees Celsius",
)
def correlation_polynomial_celsius(temperature: Temperature, coefficients: Coefficients) -> Number:
    """Polynomial in the temperature in degrees Celsius, lowest power first.

    >>> correlation_polynomial_celsius(temperature="10 degC", coefficients=[1.0, 2.0])
    21.0
    """
    return _horner(jnp.asarray(coefficients), temperature - ZERO_CELSIUS)


@formula(
    source="green2008, table 2-8",
    equation=r"y = \exp\left(c_1 + \frac{c_2}{T} + c_3\ln T + c_4 T^{c_5}\right)",
    title="Extended Antoine form (DIPPR 101)",
)
def correlation_dippr101(temperature: Temperature, coefficients: Coefficients) -> Number:
    """Exponential form used for vapor pressures and liquid viscosities.

    >>> ethanol = [73.304, -7122.3, -7.1424, 2.8853e-6, 2.0]
    >>> round(correlation_dippr101(temperature="78.29 degC", coefficients=ethanol) / 1e3, 0)
    101.0
    """
    c, T = jnp.asarray(coefficients), temperature
    return jnp.exp(c[0] + c[1] / T + c[2] * jnp.log(T) + c[3] * T ** c[4])


@formula(
    source="green2008, table 2-312",
    equation=r"y = \frac{c_1 T^{c_2}}{1 + c_3/T + c_4/T^2}",
    title="Sutherland form (DIPPR 102)",
)
def correlation_dippr102(temperature: Temperature, coefficients: Coefficients) -> Number:
    """Generalized Sutherland form used for the viscosity and conductivity of dilute gases.

    >>> round(correlation_dippr102(temperature=300.0, coefficients=[1.0613e-7, 0.8066, 52.7, 0.0]) * 1e6, 1)
    9.0
    """
    c, T = jnp.asarray(coefficients), temperature
    return c[0] * T ** c[1] / (1.0 + c[2] / T + c[3] / T**2)


@formula(
    source="green2008, table 2-32",
    equation=r"y = c_1\, c_2^{-\left[1 + (1 - T/c_3)^{c_4}\right]}",
    title="Rackett form (DIPPR 105)",
    fitted={"reduced_temperature": (0.0, 1.0)},
)
def correlation_rackett(temperature: Temperature, coefficients: Coefficients) -> Number:
    """Rackett form used for the density of saturated liquids; c3 is the critical temperature.

    Up to the critical temperature.

    >>> round(
    ...     correlation_rackett(temperature=298.15, coefficients=[1628.8, 0.27469, 514.0, 0.23178])
    ...     * 46.068
    ...     / 1e3,
    ...     -1,
    ... )
    790.0
    """
    c = jnp.asarray(coefficients)
    y = jnp.maximum(1.0 - temperature / c[2], 1e-9)
    watch(reduced_temperature=temperature / c[2])
    return c[0] / c[1] ** (1.0 + y ** c[3])


@formula(
    source="green2008, table 2-150",
    equation=r"y = c_2\,(1 - T_r)^{c_3 + c_4 T_r + c_5 T_r^2 + \dots},\quad T_r = T/c_1",
    title="Watson form (DIPPR 106)",
    fitted={"reduced_temperature": (0.0, 1.0)},
)
def correlation_watson(temperature: Temperature, coefficients: Coefficients) -> Number:
    """Watson form used for heats of vaporization and surface tensions; c1 is the critical temperature, where
    the value becomes zero.

    >>> round(
    ...     correlation_watson(temperature=298.15, coefficients=[514.0, 55789.0, 0.31245, 0.0, 0.0]) / 46.068,
    ...     -1,
    ... )
    920.0
    """
    c = jnp.asarray(coefficients)
    Tr = temperature / c[0]
    watch(reduced_temperature=Tr)
    return c[1] * jnp.maximum(1.0 - Tr, 1e-9) ** _horner(c[2:], Tr)


@formula(
    source="green2008, table 2-156",
    equation=r"y = c_1 + c_2\left[\frac{c_3/T}{\sinh(c_3/T)}\right]^2 + c_4\left[\frac{c_5/T}{\cosh(c_5/T)}\right]^2",  # noqa: E501
    title="Aly–Lee form (DIPPR 107)",
)
def correlation_aly_lee(temperature: Temperature, coefficients: Coefficients) -> Number:
    """Aly and Lee's form for the heat capacity of ideal gases.

    >>> nitrogen = [29105.0, 8614.9, 1701.6, 103.47, 909.79]
    >>> round(correlation_aly_lee(temperature=298.15, coefficients=nitrogen) / 28.0134, 0)
    1040.0
    """
    c = jnp.asarray(coefficients)
    a, b = c[2] / temperature, c[4] / temperature
    return c[0] + c[1] * (a / jnp.sinh(a)) ** 2 + c[3] * (b / jnp.cosh(b)) ** 2


@formula(
    source="green2008, table 2-153",
    equation=r"y = \frac{c_2^2}{\tau} + c_3 - 2c_2c_4\tau - c_2c_5\tau^2 - \frac{c_4^2\tau^3}{3} - \frac{c_4c_5\tau^4}{2} - \frac{c_5^2\tau^5}{5},"  # noqa: E501
    r"\quad \tau = 1 - T/c_1",
    title="Zábranský form (DIPPR 114)",
    fitted={"reduced_temperature": (0.0, 1.0)},
)
def correlation_dippr114(temperature: Temperature, coefficients: Coefficients) -> Number:
    """Form for the heat capacity of liquids up to the critical temperature c1.

    >>> heptane = [540.2, 61.26, 314410.0, 1824.6, -2547.9]
    >>> round(correlation_dippr114(temperature=298.15, coefficients=heptane) / 100.202, -1)
    2240.0
    """
    Tc, A, B, C, D = (jnp.asarray(coefficients)[i] for i in range(5))
    t = jnp.maximum(1.0 - temperature / Tc, 1e-9)
    watch(reduced_temperature=temperature / Tc)
    return A**2 / t + B - 2 * A * C * t - A * D * t**2 - C**2 * t**3 / 3 - C * D * t**4 / 2 - D**2 * t**5 / 5


@formula(
    source="vdi2010, sec. D3.1, table 3",
    equation=r"y = c_6\exp\frac{c_1\tau + c_2\tau^{1.5} + c_3\tau^{2.5} + c_4\tau^5}{1-\tau},\quad \tau = 1 - T/c_5",  # noqa: E501
    title="Wagner form",
    fitted={"reduced_temperature": (0.0, 1.0)},
)
def correlation_wagner(temperature: Temperature, coefficients: Coefficients) -> Number:
    """Wagner's form for the vapor pressure up to the critical point c5, c6.

    2-Propanol boils at 82.3 °C.

    >>> isopropanol = [-8.44737, 1.17402, -6.97876, 0.69248, 508.25, 4.762e6]
    >>> round(correlation_wagner(temperature="82.3 degC", coefficients=isopropanol) / 101325, 2)
    1.0
    """
    A, B, C, D, Tc, pc = (jnp.asarray(coefficients)[i] for i in range(6))
    t = jnp.clip(1.0 - temperature / Tc, 1e-12, 1.0 - 1e-3)
    watch(reduced_temperature=temperature / Tc)
    return pc * jnp.exp((A * t + B * t**1.5 + C * t**2.5 + D * t**5) / (1.0 - t))


@formula(source="poling2001, app. A", equation=r"y = 10^{\,c_1 - c_2/(T + c_3)}", title="Antoine form")
def correlation_antoine(temperature: Temperature, coefficients: Coefficients) -> Number:
    """Antoine's vapor pressure form, decimal logarithm and kelvin.

    >>> round(correlation_antoine(temperature=373.15, coefficients=[5.11564, 1687.537, -42.98]), 2)
    1.01
    """
    c = jnp.asarray(coefficients)
    return 10.0 ** (c[0] - c[1] / (temperature + c[2]))


@formula(
    source="poling2001, ch. 9", equation=r"y = \exp\left(c_1 + \frac{c_2}{T + c_3}\right)", title="Vogel form"
)
def correlation_vogel(temperature: Temperature, coefficients: Coefficients) -> Number:
    """Vogel's form for liquid viscosities; Andrade's with c3 = 0.

    >>> round(correlation_vogel(temperature=300.0, coefficients=[0.0, 300.0, 0.0]), 5)
    2.71828
    """
    c = jnp.asarray(coefficients)
    return jnp.exp(c[0] + c[1] / (temperature + c[2]))


@formula(
    source="apelblat1999, eq. 3",
    equation=r"y = \exp\left(c_1 + \frac{c_2}{T} + c_3\ln T\right)",
    title="Apelblat form",
)
def correlation_apelblat(temperature: Temperature, coefficients: Coefficients) -> Number:
    """Apelblat's form for solubilities: an enthalpy of solution that varies linearly with temperature.

    >>> round(correlation_apelblat(temperature=300.0, coefficients=[1.0, -300.0, 0.0]), 6)
    1.0
    """
    c, T = jnp.asarray(coefficients), temperature
    return jnp.exp(c[0] + c[1] / T + c[2] * jnp.log(T))


@formula(
    source="mullin2001, ch. 3",
    equation=r"y = \exp\sum_i c_i (T - 273.15)^i",
    title="Exponential of a polynomial in degrees Celsius",
)
def correlation_exponential_celsius(temperature: Temperature, coefficients: Coefficients) -> Number:
    """Exponential of a polynomial in the temperature in degrees Celsius, lowest power first: always positive.

    >>> round(correlation_exponential_celsius(temperature="10 degC", coefficients=[0.0, 0.1]), 5)
    2.71828
    """
    return jnp.exp(_horner(jnp.asarray(coefficients), temperature - ZERO_CELSIUS))


@formula(
    source="mullin2001, ch. 3", equation=r"y = \exp\left(c_1 + \frac{c_2}{T}\right)", title="van 't Hoff form"
)
def correlation_vant_hoff(temperature: Temperature, coefficients: Coefficients) -> Number:
    """Van 't Hoff's form for solubilities: a constant enthalpy of solution.

    >>> round(correlation_vant_hoff(temperature=300.0, coefficients=[1.0, -300.0]), 6)
    1.0
    """
    c = jnp.asarray(coefficients)
    return jnp.exp(c[0] + c[1] / temperature)


@formula(
    source="mulero2012, eq. 2",
    equation=r"y = \sum_{i=2,4,\ldots} c_i\,(1 - T/c_1)^{c_{i+1}}",
    title="Surface tension form of Mulero and Cachadiña",
    fitted={"reduced_temperature": (0.0, 1.0)},
)
def correlation_mulero(temperature: Temperature, coefficients: Coefficients) -> Number:
    """Sum of powers for the surface tension of pure liquids; coefficients Tc, σ0, n0, σ1, n1 and so on.

    Up to the critical temperature.

    >>> round(correlation_mulero(temperature=298.15, coefficients=[513.9, 0.05, 0.952]) * 1e3, 0)
    22.0
    """
    c = jnp.asarray(coefficients)
    t = jnp.maximum(1.0 - temperature / c[0], 1e-9)
    watch(reduced_temperature=temperature / c[0])
    return sum(c[i] * t ** c[i + 1] for i in range(1, c.shape[0] - 1, 2))


@formula(
    source="green2008, table 2-151",
    equation=r"y = c_1 + c_2 T + c_3 T^{-2}",
    title="Heat capacity form of Maier and Kelley",
)
def correlation_maier_kelley(temperature: Temperature, coefficients: Coefficients) -> Number:
    """Maier and Kelley's form for the heat capacity of solids.

    >>> round(
    ...     correlation_maier_kelley(temperature=298.15, coefficients=[22.08, 0.008971, -522500.0])
    ...     * 4184
    ...     / 101.961,
    ...     0,
    ... )
    775.0
    """
    c, T = jnp.asarray(coefficients), temperature
    return c[0] + c[1] * T + c[2] / T**2


@formula(
    source="walther1931; astm341",
    equation=(
        r"y = \nu\,[c_5 + c_6 (T - 273.15)],\quad \lg\lg(\nu + 0.7) = A - B\lg T,"
        r"\quad \nu(c_1) = c_2,\ \nu(c_3) = c_4\ \mathrm{mm^2/s}"
    ),
    title="Walther form of the viscosity of an oil",
)
def correlation_walther(temperature: Temperature, coefficients: Coefficients) -> Number:
    """Dynamic viscosity of an oil, Pa s, from its kinematic viscosity at two temperatures, and a density that
    falls evenly.

    The coefficients are the first temperature, K, and mm²/s there, the second, density at 0 °C and its
    change per kelvin.

    >>> oil = [313.15, 46.0, 373.15, 6.82, 885.0, -0.65]
    >>> round(1e3 * correlation_walther(temperature="20 degC", coefficients=oil))
    116
    """
    c, T = jnp.asarray(coefficients), temperature
    nu = kinematic_viscosity_walther.function(T, c[0], 1e-6 * c[1], c[2], 1e-6 * c[3])
    return nu * (c[4] + c[5] * (T - ZERO_CELSIUS))
