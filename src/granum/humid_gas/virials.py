"""Properties of air and water that real moist air needs, each a polynomial in temperature or its inverse.

The polynomials are least-squares fits at Chebyshev nodes to the reference equations named in RP-1485,
evaluated with CoolProp 8.0.0: second and third virial coefficients and ideal-gas enthalpies of air (Lemmon et
al. 2000) and water (IAPWS-95), 180 to 630 K (900 K for enthalpies); saturated liquid water (IAPWS-95) and
Henry's constant (IAPWS G7-04), 273.16 to 590 K. Largest deviations: virial coefficients 4e-11 m³/mol (air),
2e-6 relative (water), 4e-5 of B² (third of water); enthalpies 0.03 J/mol (gases), 0.05 J/mol (liquid); liquid
volume 4e-5, Henry's constant 5e-5, compressibility 1.4e-3, relative.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import jax.numpy as jnp


class Fit(NamedTuple):
    """Polynomial in x, scaled to −1 … 1 between low and high."""

    low: float
    high: float
    coefficients: tuple[float, ...]

    def __call__(self, x: Any) -> Any:
        s = (2.0 * x - (self.low + self.high)) * (1.0 / (self.high - self.low))
        total = self.coefficients[-1]
        for c in self.coefficients[-2::-1]:
            total = total * s + c
        return total

    def clipped(self, x: Any) -> Any:
        """The value with the argument kept inside the fitted range."""
        return self(jnp.clip(x, self.low, self.high))

    def slope(self, x: Any) -> Any:
        """Derivative with respect to x."""
        s = (2.0 * x - (self.low + self.high)) * (1.0 / (self.high - self.low))
        n = len(self.coefficients) - 1
        total = n * self.coefficients[-1]
        for i in range(n - 1, 0, -1):
            total = total * s + i * self.coefficients[i]
        return total * (2.0 / (self.high - self.low))


B_AIR = Fit(
    0.0015873015873015873,
    0.005555555555555556,
    (
        -1.19571493549e-05,
        -3.53951704092e-05,
        -3.60429744587e-06,
        2.46652209618e-07,
        -2.51591684878e-07,
        9.22602320289e-08,
        -3.99047911163e-08,
        1.23845915751e-08,
        -4.8543738071e-09,
        7.72304882234e-09,
        -4.0524329864e-09,
    ),
)
LOG_B_WATER = Fit(
    0.0015873015873015873,
    0.005555555555555556,
    (
        -6.34647119008,
        3.1897012823,
        0.310170958004,
        -0.259608143666,
        -0.116150298827,
        0.274282392011,
        -0.112338146873,
        -0.0978396424933,
        0.093237408562,
        0.0259707832843,
        -0.0471302563806,
        0.00300220857953,
        0.00635588381119,
    ),
)
C_OVER_B2_WATER = Fit(
    0.0015873015873015873,
    0.00392156862745098,
    (
        -2.34874000789,
        -2.30216105328,
        1.6529462702,
        1.97363157212,
        -0.728852040817,
        -1.0929939529,
        0.275310849952,
        0.421965544607,
        -0.0803725384565,
        -0.0865908187419,
        0.0134015767751,
    ),
)
C_AIR = Fit(
    0.0015873015873015873,
    0.005555555555555556,
    (
        1.87038611085e-09,
        4.99453592165e-10,
        8.32479798465e-11,
        -6.12532747981e-12,
        1.17579727224e-12,
        -3.95925030712e-13,
        1.34802149623e-13,
    ),
)
B_CROSS = Fit(
    0.0015873015873015873,
    0.005555555555555556,
    (
        -3.56991586894e-05,
        -5.21939933797e-05,
        -9.23656788633e-06,
        -9.77135365485e-07,
        -2.55085220188e-07,
        7.87981479479e-08,
        -3.05572689648e-08,
        2.97528838404e-08,
        -1.50759180927e-08,
    ),
)
LOG_HENRY = Fit(
    273.16,
    590.0,
    (
        -22.7662746471,
        1.17118563341,
        0.800332670816,
        -0.482730917774,
        0.299744596293,
        -0.0888449580149,
        0.0279031447104,
        -0.00240711272861,
        0.0247773794677,
    ),
)
LIQUID_VOLUME = Fit(
    273.16,
    590.0,
    (
        1.98195050439e-05,
        3.34936049951e-06,
        1.75370909562e-06,
        6.96723244366e-07,
        5.85067633775e-07,
        5.68756776976e-08,
        -6.62766166245e-08,
        2.35934998496e-07,
        2.66092939414e-07,
    ),
)
LOG_COMPRESSIBILITY = Fit(
    273.16,
    590.0,
    (
        -21.1503197168,
        0.990723862185,
        0.604677697895,
        0.0781228182351,
        0.0830727432859,
        0.0429258002918,
        0.175185370284,
    ),
)
LIQUID_ENTHALPY = Fit(
    273.16,
    590.0,
    (
        12046.0214465,
        12385.473107,
        699.660967604,
        484.643078387,
        171.085915486,
        103.955267792,
        69.220424602,
        -43.5924273024,
        -1.77631521262,
        67.275852702,
        13.5904119398,
    ),
)
VAPOR_ENTHALPY = Fit(
    180.0,
    900.0,
    (
        54244.6097749,
        12835.7797547,
        707.446569121,
        71.4900101093,
        -40.8770472671,
        45.1081335559,
        -34.9806144666,
        2.69925088193,
        25.2812318703,
        -17.3771873348,
        -4.64467366412,
        5.43662747517,
    ),
)
AIR_ENTHALPY = Fit(
    180.0,
    900.0,
    (
        7863.99673414,
        10818.6408544,
        398.561031156,
        94.8437476025,
        -67.3452068241,
        1.20518418454,
        16.8944746708,
        -8.49212628716,
        -0.693237633724,
        2.18409793195,
        -0.586215471476,
    ),
)


class Virials(NamedTuple):
    """Second and third virial coefficients of air (a) and water (w), m³/mol and m⁶/mol²."""

    Baa: Any
    Baw: Any
    Bww: Any
    Caaa: Any
    Caaw: Any
    Caww: Any
    Cwww: Any


def virials(T: Any) -> Virials:
    """All coefficients at a temperature: cross terms of Harvey and Huang (2007) and of Nelson and Sauer
    (2002) as in RP-1485.
    """
    x = 1.0 / T
    Bww = -jnp.exp(LOG_B_WATER(x))
    Caaw = 1e-12 * (0.482737e3 + x * (0.105678e6 + x * (-0.656394e8 + x * (0.294442e11 - x * 0.319317e13))))
    Caww = -1e-6 * jnp.exp(-0.1072887e2 + x * (0.347804e4 + x * (-0.383383e6 + x * 0.334060e8)))
    return Virials(B_AIR(x), B_CROSS(x), Bww, C_AIR(x), Caaw, Caww, C_OVER_B2_WATER.clipped(x) * Bww * Bww)


def slopes(T: Any, v: Virials) -> Virials:
    """Derivatives of the coefficients with respect to temperature, times temperature."""
    x = 1.0 / T
    bend = LOG_B_WATER.slope(x)
    ratio = C_OVER_B2_WATER.clipped(x)
    inside = (x >= C_OVER_B2_WATER.low) & (x <= C_OVER_B2_WATER.high)
    ratio_slope = jnp.where(inside, C_OVER_B2_WATER.slope(x), 0.0)
    Caaw = 1e-12 * (0.105678e6 + x * (-2.0 * 0.656394e8 + x * (3.0 * 0.294442e11 - x * 4.0 * 0.319317e13)))
    Caww = v.Caww * (0.347804e4 + x * (-2.0 * 0.383383e6 + x * 3.0 * 0.334060e8))
    Cwww = v.Bww * v.Bww * (ratio_slope + 2.0 * ratio * bend)
    return Virials(
        *(-x * c for c in (B_AIR.slope(x), B_CROSS.slope(x), v.Bww * bend, C_AIR.slope(x), Caaw, Caww, Cwww))
    )


def mixture(v: Virials, y: Any) -> tuple[Any, Any]:
    """Second and third virial coefficient of the mixture."""
    z = 1.0 - y
    B = z * z * v.Baa + 2.0 * z * y * v.Baw + y * y * v.Bww
    C = z * z * z * v.Caaa + 3.0 * z * z * y * v.Caaw + 3.0 * z * y * y * v.Caww + y * y * y * v.Cwww
    return B, C
