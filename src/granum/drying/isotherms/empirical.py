"""Empirical isotherms. Coefficients are those of the printed forms; moisture is a mass ratio, dry basis,
unless a form says percent.
"""

from __future__ import annotations

from typing import Any, ClassVar

import jax.numpy as jnp

from granum.core import law
from granum.core.constants import ZERO_CELSIUS
from granum.core.kinds import MoistureDryBasis, Number, PositiveNumber, Temperature, WaterActivity
from granum.drying.isotherms.base import (
    ROOM,
    SMALLEST,
    AbstractIsotherm,
    activity_by_search,
    before_bend,
    bounded,
    run_out,
)


class _Called(AbstractIsotherm):
    """Call form shared by the laws of this file."""

    def __call__(self, water_activity: WaterActivity, temperature: Temperature = ROOM) -> MoistureDryBasis:
        return self.moisture(water_activity, temperature)


@law(
    "isotherm",
    name="isotherm_oswin",
    source="oswin1946; asaed245",
    fitted={"water_activity": (0.2, 0.95)},
    title="Oswin isotherm",
    equation=r"X = (A + A_1 t)\left(\frac{a}{1-a}\right)^B",
    symbols={"water_activity": "a"},
)
class Oswin(_Called):
    """Oswin's power of a/(1 − a), with the coefficient linear in °C; starch, meat, vegetables.

    Its curve is that of ``isotherm_oswin_modified``: the data behind the standard lie between 0.2 and 0.95.

    >>> round(float(Oswin(isotherm_coefficient=0.1, isotherm_exponent=0.5)(0.8)), 3)
    0.2
    """

    curve: ClassVar[str] = "oswin"
    isotherm_coefficient: PositiveNumber
    isotherm_exponent: PositiveNumber
    isotherm_coefficient_per_celsius: Number = 0.0

    def _factor(self, T: Any) -> Any:
        return self.isotherm_coefficient + self.isotherm_coefficient_per_celsius * (
            jnp.asarray(T) - ZERO_CELSIUS
        )

    def moisture(self, a: Any, T: Any) -> Any:
        a = bounded(a)
        return self._factor(T) * (a / (1.0 - a)) ** self.isotherm_exponent

    def activity(self, X: Any, T: Any) -> Any:
        ratio = (jnp.maximum(X, 1e-30) / self._factor(T)) ** (1.0 / self.isotherm_exponent)
        return ratio / (1.0 + ratio)


@law(
    "isotherm",
    name="isotherm_lewicki_two",
    source="lewicki1998; asaed245",
    fitted={"water_activity": (0.2, 0.95)},
    title="Lewicki isotherm, two parameters",
    equation=r"X = A\left(\frac1a-1\right)^{B-1}",
    symbols={"water_activity": "a"},
)
class LewickiTwo(_Called):
    """Lewicki's two-parameter form: the curve of Oswin with exponent 1 − B.

    The range is that of ``isotherm_oswin_modified``.

    >>> round(float(LewickiTwo(isotherm_coefficient=0.1, isotherm_exponent=0.5)(0.8)), 3)
    0.2
    """

    curve: ClassVar[str] = "oswin"
    isotherm_coefficient: PositiveNumber
    isotherm_exponent: Number

    def moisture(self, a: Any, T: Any) -> Any:
        return self.isotherm_coefficient * (1.0 / bounded(a) - 1.0) ** (self.isotherm_exponent - 1.0)

    def activity(self, X: Any, T: Any) -> Any:
        return 1.0 / (
            1.0
            + (jnp.maximum(X, 1e-30) / self.isotherm_coefficient) ** (1.0 / (self.isotherm_exponent - 1.0))
        )


@law(
    "isotherm",
    name="isotherm_lewicki_three",
    source="lewicki1998",
    title="Lewicki isotherm, three parameters",
    equation=r"X = \frac{F}{(1-a)^G} - \frac{F}{1+a^H}",
    symbols={
        "isotherm_coefficient": "F",
        "isotherm_exponent": "G",
        "isotherm_exponent_second": "H",
        "water_activity": "a",
    },
)
class LewickiThree(_Called):
    """Lewicki's three-parameter form for foods over the whole range.

    >>> round(
    ...     float(
    ...         LewickiThree(isotherm_coefficient=0.1, isotherm_exponent=0.5, isotherm_exponent_second=1.0)(
    ...             0.75
    ...         )
    ...     ),
    ...     4,
    ... )
    0.1429
    """

    curve: ClassVar[str] = "lewicki_three"
    isotherm_coefficient: PositiveNumber
    isotherm_exponent: PositiveNumber
    isotherm_exponent_second: PositiveNumber

    def moisture(self, a: Any, T: Any) -> Any:
        a, F = bounded(a), self.isotherm_coefficient
        return F / (1.0 - a) ** self.isotherm_exponent - F / (1.0 + a**self.isotherm_exponent_second)

    def activity(self, X: Any, T: Any) -> Any:
        return activity_by_search(self, X, T)


@law(
    "isotherm",
    name="isotherm_halsey",
    source="halsey1948; iglesias1976model",
    fitted={"water_activity": (0.1, 0.8)},
    title="Halsey isotherm",
    equation=r"a = \exp(-A\,X^{-B})",
    symbols={"water_activity": "a"},
)
class Halsey(_Called):
    """Halsey's condensation at a distance from the surface; starchy foods, 0.1 to 0.8.

    >>> round(float(Halsey(isotherm_coefficient=0.02, isotherm_exponent=1.5).activity(0.1, 298.15)), 4)
    0.5313
    """

    curve: ClassVar[str] = "halsey"
    isotherm_coefficient: PositiveNumber
    isotherm_exponent: PositiveNumber

    def moisture(self, a: Any, T: Any) -> Any:
        return (self.isotherm_coefficient / -jnp.log(bounded(a))) ** (1.0 / self.isotherm_exponent)

    def activity(self, X: Any, T: Any) -> Any:
        return jnp.exp(-self.isotherm_coefficient * jnp.maximum(X, 1e-12) ** -self.isotherm_exponent)


@law(
    "isotherm",
    name="isotherm_ferro_fontan",
    source="ferrofontan1982",
    fitted={"water_activity": (0.0, 0.95)},
    title="Ferro-Fontán isotherm",
    equation=r"\ln\frac{\gamma}{a} = b\,X^{-r}",
    symbols={"isotherm_coefficient": "b", "isotherm_exponent": "r", "water_activity": "a"},
)
class FerroFontan(_Called):
    """Ferro-Fontán and coworkers: Halsey with a structure factor γ near 1 that widens the range to 0.95.

    >>> round(
    ...     float(
    ...         FerroFontan(structure_factor=1.0, isotherm_coefficient=0.02, isotherm_exponent=1.5).activity(
    ...             0.1, 298.15
    ...         )
    ...     ),
    ...     4,
    ... )
    0.5313
    """

    curve: ClassVar[str] = "ferro_fontan"
    structure_factor: PositiveNumber
    isotherm_coefficient: PositiveNumber
    isotherm_exponent: PositiveNumber

    def moisture(self, a: Any, T: Any) -> Any:
        room = jnp.maximum(jnp.log(self.structure_factor / bounded(a)), SMALLEST)
        return (self.isotherm_coefficient / room) ** (1.0 / self.isotherm_exponent)

    def activity(self, X: Any, T: Any) -> Any:
        a = self.structure_factor * jnp.exp(
            -self.isotherm_coefficient * jnp.maximum(X, 1e-12) ** -self.isotherm_exponent
        )
        return jnp.minimum(a, 1.0)


@law(
    "isotherm",
    name="isotherm_henderson",
    source="henderson1952; asaed245",
    fitted={"water_activity": (0.2, 0.95)},
    title="Henderson isotherm",
    equation=r"1 - a = \exp(-A\,T\,X^{B})",
    symbols={"water_activity": "a"},
)
class Henderson(_Called):
    """Henderson's form with the absolute temperature; X a mass ratio, T in kelvin.

    Its curve is that of ``isotherm_henderson_modified``: the data behind the standard lie between 0.2 and
    0.95.

    >>> round(float(Henderson(isotherm_coefficient=0.2, isotherm_exponent=2.0).activity(0.1, 300.0)), 4)
    0.4512
    """

    curve: ClassVar[str] = "henderson"
    isotherm_coefficient: PositiveNumber
    isotherm_exponent: PositiveNumber

    def moisture(self, a: Any, T: Any) -> Any:
        return (-jnp.log1p(-bounded(a)) / (self.isotherm_coefficient * jnp.asarray(T))) ** (
            1.0 / self.isotherm_exponent
        )

    def activity(self, X: Any, T: Any) -> Any:
        return -jnp.expm1(
            -self.isotherm_coefficient * jnp.asarray(T) * jnp.maximum(X, 1e-30) ** self.isotherm_exponent
        )


@law(
    "isotherm",
    name="isotherm_smith",
    source="smith1947",
    fitted={"water_activity": (0.3, 0.95)},
    title="Smith isotherm",
    equation=r"X = A - B\,\ln(1-a)",
    symbols={"isotherm_coefficient_second": "B", "water_activity": "a"},
)
class Smith(_Called):
    """Smith's logarithmic form for high polymers, from 0.3 to 0.9 or 0.95.

    >>> round(float(Smith(isotherm_coefficient=0.02, isotherm_coefficient_second=0.1)(0.8)), 4)
    0.1809
    """

    curve: ClassVar[str] = "smith"
    isotherm_coefficient: Number
    isotherm_coefficient_second: PositiveNumber

    def moisture(self, a: Any, T: Any) -> Any:
        return self.isotherm_coefficient - self.isotherm_coefficient_second * jnp.log1p(-bounded(a))

    def activity(self, X: Any, T: Any) -> Any:
        return jnp.clip(
            -jnp.expm1(-(X - self.isotherm_coefficient) / self.isotherm_coefficient_second), 0.0, 1.0
        )


@law(
    "isotherm",
    name="isotherm_peleg",
    source="peleg1993",
    title="Peleg isotherm",
    equation=r"X = k_1 a^{n_1} + k_2 a^{n_2}",
    symbols={
        "isotherm_coefficient": "k_1",
        "isotherm_exponent": "n_1",
        "isotherm_coefficient_second": "k_2",
        "isotherm_exponent_second": "n_2",
        "water_activity": "a",
    },
)
class Peleg(_Called):
    """Peleg's two powers, one below and one above 1: as good as GAB and finite at a = 1.

    >>> peleg = Peleg(
    ...     isotherm_coefficient=0.1,
    ...     isotherm_exponent=0.5,
    ...     isotherm_coefficient_second=0.3,
    ...     isotherm_exponent_second=6.0,
    ... )
    >>> round(float(peleg(0.81)), 4)
    0.1747
    """

    curve: ClassVar[str] = "peleg"
    isotherm_coefficient: PositiveNumber
    isotherm_exponent: PositiveNumber
    isotherm_coefficient_second: PositiveNumber
    isotherm_exponent_second: PositiveNumber

    def moisture(self, a: Any, T: Any) -> Any:
        a = bounded(a)
        first = self.isotherm_coefficient * a**self.isotherm_exponent
        return first + self.isotherm_coefficient_second * a**self.isotherm_exponent_second

    def activity(self, X: Any, T: Any) -> Any:
        return activity_by_search(self, X, T)


@law(
    "isotherm",
    name="isotherm_double_log",
    source="condon2006",
    title="Double-log polynomial (DLP)",
    equation=r"X = b_0 + b_1\chi + b_2\chi^2 + b_3\chi^3,\quad \chi = \ln(-\ln a)",
    symbols={
        "isotherm_coefficient": "b_0",
        "isotherm_coefficient_second": "b_1",
        "isotherm_coefficient_third": "b_2",
        "isotherm_coefficient_fourth": "b_3",
        "water_activity": "a",
    },
)
class DoubleLog(_Called):
    """Cubic in ln(−ln a), for dense dynamic-vapor-sorption data; do not extrapolate it.

    >>> round(float(DoubleLog(0.1, -0.05, 0.01, 0.0)(0.5)), 4)
    0.1197
    """

    curve: ClassVar[str] = "double_log"
    isotherm_coefficient: Number
    isotherm_coefficient_second: Number
    isotherm_coefficient_third: Number
    isotherm_coefficient_fourth: Number

    def moisture(self, a: Any, T: Any) -> Any:
        z = jnp.log(-jnp.log(bounded(a)))
        b0, b1, b2, b3 = (
            self.isotherm_coefficient,
            self.isotherm_coefficient_second,
            self.isotherm_coefficient_third,
            self.isotherm_coefficient_fourth,
        )
        return b0 + z * (b1 + z * (b2 + z * b3))

    def activity(self, X: Any, T: Any) -> Any:
        return activity_by_search(self, X, T)


@law(
    "isotherm",
    name="isotherm_iglesias_chirife",
    source="iglesias1978",
    title="Iglesias–Chirife isotherm",
    equation=r"\ln\left[X+(X^2+X_{0.5})^{1/2}\right] = B_1 a + B_2",
    symbols={"isotherm_coefficient": "B_1", "isotherm_coefficient_second": "B_2", "water_activity": "a"},
)
class IglesiasChirife(_Called):
    """Iglesias and Chirife's form for sugar-rich fruit; needs the moisture at a water activity of 0.5, as
    printed.

    >>> fruit = IglesiasChirife(
    ...     isotherm_coefficient=2.0, isotherm_coefficient_second=-1.2, moisture_half=0.12
    ... )
    >>> round(float(fruit.activity(fruit(0.6), 298.15)), 9)
    0.6
    """

    curve: ClassVar[str] = "iglesias_chirife"
    isotherm_coefficient: Number
    isotherm_coefficient_second: Number
    moisture_half: MoistureDryBasis

    def moisture(self, a: Any, T: Any) -> Any:
        E = jnp.exp(self.isotherm_coefficient * a + self.isotherm_coefficient_second)
        return (E * E - self.moisture_half) / (2.0 * E)

    def activity(self, X: Any, T: Any) -> Any:
        a = (
            jnp.log(X + jnp.sqrt(X**2 + self.moisture_half)) - self.isotherm_coefficient_second
        ) / self.isotherm_coefficient
        return jnp.clip(a, 0.0, 1.0)


@law(
    "isotherm",
    name="isotherm_caurie",
    source="caurie1970",
    fitted={"water_activity": (0.0, 0.85)},
    title="Caurie isotherm",
    equation=r"\ln X = A + B\,a",
    symbols={"isotherm_coefficient_second": "B", "water_activity": "a"},
)
class Caurie(_Called):
    """Caurie's exponential, from no water to 0.85.

    >>> round(float(Caurie(isotherm_coefficient=-3.0, isotherm_coefficient_second=2.0)(0.5)), 4)
    0.1353
    """

    curve: ClassVar[str] = "caurie"
    isotherm_coefficient: Number
    isotherm_coefficient_second: PositiveNumber

    def moisture(self, a: Any, T: Any) -> Any:
        return jnp.exp(self.isotherm_coefficient + self.isotherm_coefficient_second * jnp.asarray(a))

    def activity(self, X: Any, T: Any) -> Any:
        return jnp.clip(
            (jnp.log(jnp.maximum(X, 1e-30)) - self.isotherm_coefficient) / self.isotherm_coefficient_second,
            0.0,
            1.0,
        )


@law(
    "isotherm",
    name="isotherm_kuhn",
    source="kuhn1964",
    fitted={"water_activity": (0.0, 0.5)},
    title="Kuhn isotherm",
    equation=r"X = \frac{A}{-\ln a} + B",
    symbols={"isotherm_coefficient_second": "B", "water_activity": "a"},
)
class Kuhn(_Called):
    """Kuhn's potential form, below 0.5. Written with −ln a so that A is positive.

    >>> round(float(Kuhn(isotherm_coefficient=0.02, isotherm_coefficient_second=0.03)(0.5)), 4)
    0.0589
    """

    curve: ClassVar[str] = "kuhn"
    isotherm_coefficient: PositiveNumber
    isotherm_coefficient_second: Number

    def moisture(self, a: Any, T: Any) -> Any:
        return self.isotherm_coefficient / -jnp.log(bounded(a)) + self.isotherm_coefficient_second

    def activity(self, X: Any, T: Any) -> Any:
        return jnp.exp(-self.isotherm_coefficient / jnp.maximum(X - self.isotherm_coefficient_second, 1e-12))


@law(
    "isotherm",
    name="isotherm_bradley",
    source="bradley1936; asaed245",
    fitted={"water_activity": (0.2, 0.95)},
    title="Bradley isotherm",
    equation=r"-\ln a = K_2 K_1^{X}",
    symbols={"isotherm_coefficient": "K_2", "water_activity": "a"},
)
class Bradley(_Called):
    """Bradley's polarized layers: at one temperature the curve of Chung and Pfost.

    The range is that of ``isotherm_chung_pfost``.

    Differs from the print: where the equation falls below no moisture, it bends to none within 0.001 kg/kg.

    >>> round(float(Bradley(isotherm_base=1e-5, isotherm_coefficient=3.0).activity(0.1, 298.15)), 4)
    0.3873
    """

    curve: ClassVar[str] = "chung_pfost"
    isotherm_base: PositiveNumber
    isotherm_coefficient: PositiveNumber

    def moisture(self, a: Any, T: Any) -> Any:
        return run_out(
            jnp.log(-jnp.log(bounded(a)) / self.isotherm_coefficient) / jnp.log(self.isotherm_base)
        )

    def activity(self, X: Any, T: Any) -> Any:
        return jnp.exp(-self.isotherm_coefficient * self.isotherm_base ** before_bend(X))


@law(
    "isotherm",
    name="isotherm_chen",
    source="chen1971; asaed245",
    fitted={"water_activity": (0.2, 0.95)},
    title="Chen isotherm",
    equation=r"\ln a = K - A\,e^{-B X}",
    symbols={"water_activity": "a"},
)
class Chen(_Called):
    """Chen's form; with K = 0, for products with little bound water, it is the curve of Chung and Pfost.

    The range is that of ``isotherm_chung_pfost``.

    Differs from the print: where the equation falls below no moisture, it bends to none within 0.001 kg/kg.

    >>> round(float(Chen(isotherm_coefficient=3.0, isotherm_exponent=11.5129).activity(0.1, 298.15)), 3)
    0.387
    """

    curve: ClassVar[str] = "chen"
    isotherm_coefficient: PositiveNumber
    isotherm_exponent: PositiveNumber
    isotherm_offset: Number = 0.0

    def moisture(self, a: Any, T: Any) -> Any:
        reach = jnp.maximum(self.isotherm_offset - jnp.log(bounded(a)), SMALLEST)
        return run_out(-jnp.log(reach / self.isotherm_coefficient) / self.isotherm_exponent)

    def activity(self, X: Any, T: Any) -> Any:
        return jnp.minimum(
            jnp.exp(
                self.isotherm_offset
                - self.isotherm_coefficient * jnp.exp(-self.isotherm_exponent * before_bend(X))
            ),
            1.0,
        )
