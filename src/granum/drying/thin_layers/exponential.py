"""Thin-layer models that are exponentials or sums of them."""

from __future__ import annotations

from typing import Any, ClassVar

import jax.numpy as jnp

from granum.core import law
from granum.core.kinds import Number, PositiveNumber, Ratio, Time
from granum.drying.thin_layers.base import AbstractThinLayer, power

INF = float("inf")
POSITIVE = (0.0, INF)


class _Called(AbstractThinLayer):
    def __call__(self, time: Time) -> Ratio:
        return self.ratio(jnp.asarray(time, dtype=float))


@law(
    "thin_layer",
    name="thin_layer_lewis",
    source="lewis1921",
    title="Thin layer, Newton–Lewis",
    equation=r"MR = e^{-kt}",
)
class Lewis(_Called):
    """First-order drying: the rate is proportional to the moisture still to go.

    >>> round(float(Lewis(rate_constant=1e-3)(1000.0)), 4)
    0.3679
    """

    curve: ClassVar[str] = "lewis"
    bounds: ClassVar = {"rate_constant": POSITIVE}
    rate_constant: PositiveNumber

    def ratio(self, t: Any) -> Any:
        return jnp.exp(-self.rate_constant * t)

    @classmethod
    def first(cls, k: float) -> dict[str, float]:
        return {"rate_constant": k}


@law(
    "thin_layer",
    name="thin_layer_page",
    source="page1949",
    title="Thin layer, Page",
    equation=r"MR = e^{-k t^n}",
)
class Page(_Called):
    """Page's stretched exponential; k is per second to the power n.

    >>> round(float(Page(rate_constant=1e-3, time_exponent=1.0)(1000.0)), 4)
    0.3679
    """

    curve: ClassVar[str] = "page"
    bounds: ClassVar = {"rate_constant": POSITIVE, "time_exponent": (0.05, 10.0)}
    rate_constant: PositiveNumber
    time_exponent: PositiveNumber

    def ratio(self, t: Any) -> Any:
        return jnp.exp(-self.rate_constant * power(t, self.time_exponent))

    @classmethod
    def first(cls, k: float) -> dict[str, float]:
        return {"rate_constant": k, "time_exponent": 1.0}


@law(
    "thin_layer",
    name="thin_layer_page_modified",
    source="overhults1973",
    title="Thin layer, modified Page",
    equation=r"MR = e^{-(kt)^n}",
)
class PageModified(_Called):
    """Page's curve with a rate constant per second, which makes it comparable between products.

    >>> round(float(PageModified(rate_constant=1e-3, time_exponent=1.3)(1000.0)), 4)
    0.3679
    """

    curve: ClassVar[str] = "page"
    bounds: ClassVar = {"rate_constant": POSITIVE, "time_exponent": (0.05, 10.0)}
    rate_constant: PositiveNumber
    time_exponent: PositiveNumber

    def ratio(self, t: Any) -> Any:
        return jnp.exp(-power(self.rate_constant * t, self.time_exponent))

    @classmethod
    def first(cls, k: float) -> dict[str, float]:
        return {"rate_constant": k, "time_exponent": 1.0}


@law(
    "thin_layer",
    name="thin_layer_weibull",
    source="corzo2008",
    title="Thin layer, Weibull",
    equation=r"MR = e^{-(t/\beta)^\alpha}",
    symbols={"time_exponent": r"\alpha"},
)
class Weibull(_Called):
    """Page's curve with a time scale: after it, 63 % of the moisture has gone.

    >>> round(float(Weibull(time_scale=1000.0, time_exponent=1.3)(1000.0)), 4)
    0.3679
    """

    curve: ClassVar[str] = "page"
    bounds: ClassVar = {"time_scale": POSITIVE, "time_exponent": (0.05, 10.0)}
    time_scale: Time
    time_exponent: PositiveNumber

    def ratio(self, t: Any) -> Any:
        return jnp.exp(-power(t / self.time_scale, self.time_exponent))

    @classmethod
    def first(cls, k: float) -> dict[str, float]:
        return {"time_scale": 1.0 / k, "time_exponent": 1.0}


@law(
    "thin_layer",
    name="thin_layer_henderson_pabis",
    source="henderson1961; crank1975, eq. 4.18",
    fitted={"thin_layer": (0.0, 0.6)},
    title="Thin layer, Henderson–Pabis",
    equation=r"MR = a\,e^{-kt}",
)
class HendersonPabis(_Called):
    """First term of the diffusion series with a free factor; it need not start at 1.

    As the first term of the series alone it holds below a moisture ratio of 0.6, where the second is less
    than a hundredth of it.

    >>> round(float(HendersonPabis(model_factor=1.0, rate_constant=1e-3)(1000.0)), 4)
    0.3679
    """

    curve: ClassVar[str] = "henderson_pabis"
    bounds: ClassVar = {"rate_constant": POSITIVE}
    model_factor: Number
    rate_constant: PositiveNumber

    def ratio(self, t: Any) -> Any:
        return self.model_factor * jnp.exp(-self.rate_constant * t)

    @classmethod
    def first(cls, k: float) -> dict[str, float]:
        return {"model_factor": 1.0, "rate_constant": k}


@law(
    "thin_layer",
    name="thin_layer_logarithmic",
    source="yagcioglu1999; brooker1992",
    fitted={"thin_layer": (0.0, 1.0)},
    title="Thin layer, logarithmic",
    equation=r"MR = a\,e^{-kt} + c",
)
class Logarithmic(_Called):
    """Henderson and Pabis with an offset, which often makes good for a wrong equilibrium moisture.

    A moisture ratio lies between 0 and 1 (Brooker and others): a curve beyond has left what it describes.

    >>> round(float(Logarithmic(model_factor=1.0, rate_constant=1e-3, model_offset=0.0)(1000.0)), 4)
    0.3679
    """

    curve: ClassVar[str] = "logarithmic"
    bounds: ClassVar = {"rate_constant": POSITIVE}
    model_factor: Number
    rate_constant: PositiveNumber
    model_offset: Number

    def ratio(self, t: Any) -> Any:
        return self.model_factor * jnp.exp(-self.rate_constant * t) + self.model_offset

    @classmethod
    def first(cls, k: float) -> dict[str, float]:
        return {"model_factor": 1.0, "rate_constant": k, "model_offset": 0.01}


@law(
    "thin_layer",
    name="thin_layer_two_term",
    source="henderson1974; brooker1992",
    fitted={"thin_layer": (0.0, 1.0)},
    title="Thin layer, two-term",
    equation=r"MR = a\,e^{-k_1 t} + b\,e^{-k_2 t}",
    symbols={"rate_constant": "k_1", "model_factor_second": "b", "rate_constant_second": "k_2"},
)
class TwoTerm(_Called):
    """Two exponentials with free factors.

    A moisture ratio lies between 0 and 1 (Brooker and others): a curve beyond has left what it describes.

    >>> round(float(TwoTerm(0.5, 1e-3, 0.5, 1e-3)(1000.0)), 4)
    0.3679
    """

    curve: ClassVar[str] = "two_term"
    bounds: ClassVar = {"rate_constant": POSITIVE, "rate_constant_second": POSITIVE}
    model_factor: Number
    rate_constant: PositiveNumber
    model_factor_second: Number
    rate_constant_second: PositiveNumber

    def ratio(self, t: Any) -> Any:
        first = self.model_factor * jnp.exp(-self.rate_constant * t)
        return first + self.model_factor_second * jnp.exp(-self.rate_constant_second * t)

    @classmethod
    def first(cls, k: float) -> dict[str, float]:
        return {
            "model_factor": 0.6,
            "rate_constant": 0.7 * k,
            "model_factor_second": 0.4,
            "rate_constant_second": 2.5 * k,
        }


@law(
    "thin_layer",
    name="thin_layer_two_term_exponential",
    source="sharafeldeen1980; brooker1992",
    fitted={"thin_layer": (0.0, 1.0)},
    title="Thin layer, two-term exponential",
    equation=r"MR = a\,e^{-kt} + (1-a)\,e^{-kat}",
)
class TwoTermExponential(_Called):
    """Two exponentials that share one factor and start at 1.

    A moisture ratio lies between 0 and 1 (Brooker and others): a curve beyond has left what it describes.

    >>> round(float(TwoTermExponential(1.0, 1e-3)(1000.0)), 4)
    0.3679
    """

    curve: ClassVar[str] = "two_term_exponential"
    bounds: ClassVar = {"model_factor": (1e-4, 1e4), "rate_constant": POSITIVE}
    model_factor: Number
    rate_constant: PositiveNumber

    def ratio(self, t: Any) -> Any:
        a, k = self.model_factor, self.rate_constant
        return a * jnp.exp(-k * t) + (1.0 - a) * jnp.exp(-k * a * t)

    @classmethod
    def first(cls, k: float) -> dict[str, float]:
        return {"model_factor": 1.6, "rate_constant": 1.2 * k}


@law(
    "thin_layer",
    name="thin_layer_verma",
    source="verma1985; brooker1992",
    fitted={"thin_layer": (0.0, 1.0)},
    title="Thin layer, Verma",
    equation=r"MR = a\,e^{-kt} + (1-a)\,e^{-gt}",
    symbols={"rate_constant_second": "g"},
)
class Verma(_Called):
    """Two exponentials that start at 1.

    A moisture ratio lies between 0 and 1 (Brooker and others): a curve beyond has left what it describes.

    >>> round(float(Verma(0.5, 1e-3, 1e-3)(1000.0)), 4)
    0.3679
    """

    curve: ClassVar[str] = "verma"
    bounds: ClassVar = {"rate_constant": POSITIVE, "rate_constant_second": POSITIVE}
    model_factor: Number
    rate_constant: PositiveNumber
    rate_constant_second: PositiveNumber

    def ratio(self, t: Any) -> Any:
        a = self.model_factor
        return a * jnp.exp(-self.rate_constant * t) + (1.0 - a) * jnp.exp(-self.rate_constant_second * t)

    @classmethod
    def first(cls, k: float) -> dict[str, float]:
        return {"model_factor": 0.6, "rate_constant": 0.7 * k, "rate_constant_second": 2.5 * k}


@law(
    "thin_layer",
    name="thin_layer_diffusion_approach",
    source="yaldiz2001; brooker1992",
    fitted={"thin_layer": (0.0, 1.0)},
    title="Thin layer, diffusion approach",
    equation=r"MR = a\,e^{-kt} + (1-a)\,e^{-kbt}",
)
class DiffusionApproach(_Called):
    """Verma's curve with g written as k b.

    A moisture ratio lies between 0 and 1 (Brooker and others): a curve beyond has left what it describes.

    >>> round(float(DiffusionApproach(0.5, 1e-3, 1.0)(1000.0)), 4)
    0.3679
    """

    curve: ClassVar[str] = "verma"
    bounds: ClassVar = {"rate_constant": POSITIVE, "rate_ratio": POSITIVE}
    model_factor: Number
    rate_constant: PositiveNumber
    rate_ratio: PositiveNumber

    def ratio(self, t: Any) -> Any:
        a, k = self.model_factor, self.rate_constant
        return a * jnp.exp(-k * t) + (1.0 - a) * jnp.exp(-k * self.rate_ratio * t)

    @classmethod
    def first(cls, k: float) -> dict[str, float]:
        return {"model_factor": 0.6, "rate_constant": 0.7 * k, "rate_ratio": 3.5}


@law(
    "thin_layer",
    name="thin_layer_henderson_pabis_modified",
    source="karathanos1999; brooker1992",
    fitted={"thin_layer": (0.0, 1.0)},
    title="Thin layer, modified Henderson–Pabis",
    equation=r"MR = a\,e^{-kt} + b\,e^{-gt} + c\,e^{-ht}",
    symbols={
        "model_factor_second": "b",
        "rate_constant_second": "g",
        "model_factor_third": "c",
        "rate_constant_third": "h",
    },
)
class HendersonPabisModified(_Called):
    """Three exponentials; six parameters that few data can tell apart.

    A moisture ratio lies between 0 and 1 (Brooker and others): a curve beyond has left what it describes.

    >>> round(float(HendersonPabisModified(0.4, 1e-3, 0.3, 1e-3, 0.3, 1e-3)(1000.0)), 4)
    0.3679
    """

    curve: ClassVar[str] = "three_term"
    bounds: ClassVar = {
        "rate_constant": POSITIVE,
        "rate_constant_second": POSITIVE,
        "rate_constant_third": POSITIVE,
    }
    model_factor: Number
    rate_constant: PositiveNumber
    model_factor_second: Number
    rate_constant_second: PositiveNumber
    model_factor_third: Number
    rate_constant_third: PositiveNumber

    def ratio(self, t: Any) -> Any:
        first = self.model_factor * jnp.exp(-self.rate_constant * t)
        second = self.model_factor_second * jnp.exp(-self.rate_constant_second * t)
        return first + second + self.model_factor_third * jnp.exp(-self.rate_constant_third * t)

    @classmethod
    def first(cls, k: float) -> dict[str, float]:
        return {
            "model_factor": 0.5,
            "rate_constant": 0.7 * k,
            "model_factor_second": 0.3,
            "rate_constant_second": 2.0 * k,
            "model_factor_third": 0.2,
            "rate_constant_third": 6.0 * k,
        }
