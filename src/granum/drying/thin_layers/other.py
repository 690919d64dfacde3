"""Thin-layer models with stretched times, polynomials and rational forms."""

from __future__ import annotations

from typing import Any, ClassVar

import jax.numpy as jnp

from granum.core import law
from granum.core.kinds import Length, Number, PositiveNumber, Ratio, Time
from granum.drying.thin_layers.base import AbstractThinLayer, power

INF = float("inf")
POSITIVE = (0.0, INF)
EXPONENT = (0.05, 10.0)


class _Called(AbstractThinLayer):
    def __call__(self, time: Time) -> Ratio:
        return self.ratio(jnp.asarray(time, dtype=float))


@law(
    "thin_layer",
    name="thin_layer_midilli",
    source="midilli2002; brooker1992",
    fitted={"thin_layer": (0.0, 1.0)},
    title="Thin layer, Midilli–Kucuk",
    equation=r"MR = a\,e^{-k t^n} + b\,t",
)
class Midilli(_Called):
    """Page with a free factor and a straight line.

    A moisture ratio lies between 0 and 1 (Brooker and others): a curve beyond has left what it describes.

    >>> round(float(Midilli(1.0, 1e-3, 1.0, 0.0)(1000.0)), 4)
    0.3679
    """

    curve: ClassVar[str] = "midilli"
    bounds: ClassVar = {"rate_constant": POSITIVE, "time_exponent": EXPONENT}
    model_factor: Number
    rate_constant: PositiveNumber
    time_exponent: PositiveNumber
    time_slope: Number

    def ratio(self, t: Any) -> Any:
        return (
            self.model_factor * jnp.exp(-self.rate_constant * power(t, self.time_exponent))
            + self.time_slope * t
        )

    @classmethod
    def first(cls, k: float) -> dict[str, float]:
        return {"model_factor": 1.0, "rate_constant": k, "time_exponent": 1.0, "time_slope": -1e-3 * k}


@law(
    "thin_layer",
    name="thin_layer_weibull_four",
    source="babalis2006; brooker1992",
    fitted={"thin_layer": (0.0, 1.0)},
    title="Thin layer, four-parameter Weibull",
    equation=r"MR = a - b\,e^{-k t^n}",
    typical={"model_factor": (-1.1, -0.9)},
    symbols={"model_offset": "a", "model_factor": "b"},
)
class WeibullFour(_Called):
    """Weibull's curve between two free levels; b is negative for drying.

    A moisture ratio lies between 0 and 1 (Brooker and others): a curve beyond has left what it describes.

    >>> round(float(WeibullFour(0.0, -1.0, 1e-3, 1.0)(1000.0)), 4)
    0.3679
    """

    curve: ClassVar[str] = "stretched_two_levels"
    bounds: ClassVar = {"rate_constant": POSITIVE, "time_exponent": EXPONENT}
    model_offset: Number
    model_factor: Number
    rate_constant: PositiveNumber
    time_exponent: PositiveNumber

    def ratio(self, t: Any) -> Any:
        return self.model_offset - self.model_factor * jnp.exp(
            -self.rate_constant * power(t, self.time_exponent)
        )

    @classmethod
    def first(cls, k: float) -> dict[str, float]:
        return {"model_offset": 0.01, "model_factor": -1.0, "rate_constant": k, "time_exponent": 1.0}


@law(
    "thin_layer",
    name="thin_layer_demir",
    source="demir2007; brooker1992",
    fitted={"thin_layer": (0.0, 1.0)},
    title="Thin layer, Demir",
    equation=r"MR = a\,e^{-(kt)^n} + b",
    symbols={"model_offset": "b"},
)
class Demir(_Called):
    """Modified Page between two free levels: the curve of the four-parameter Weibull.

    A moisture ratio lies between 0 and 1 (Brooker and others): a curve beyond has left what it describes.

    >>> round(float(Demir(1.0, 1e-3, 1.0, 0.0)(1000.0)), 4)
    0.3679
    """

    curve: ClassVar[str] = "stretched_two_levels"
    bounds: ClassVar = {"rate_constant": POSITIVE, "time_exponent": EXPONENT}
    model_factor: Number
    rate_constant: PositiveNumber
    time_exponent: PositiveNumber
    model_offset: Number

    def ratio(self, t: Any) -> Any:
        return (
            self.model_factor * jnp.exp(-power(self.rate_constant * t, self.time_exponent))
            + self.model_offset
        )

    @classmethod
    def first(cls, k: float) -> dict[str, float]:
        return {"model_factor": 1.0, "rate_constant": k, "time_exponent": 1.0, "model_offset": 0.01}


@law(
    "thin_layer",
    name="thin_layer_hii",
    source="hii2009; brooker1992",
    fitted={"thin_layer": (0.0, 1.0)},
    title="Thin layer, Hii",
    equation=r"MR = a\,e^{-k t^n} + c\,e^{-g t^n}",
    symbols={"model_factor_second": "c", "rate_constant_second": "g"},
)
class Hii(_Called):
    """Two stretched exponentials of one exponent.

    A moisture ratio lies between 0 and 1 (Brooker and others): a curve beyond has left what it describes.

    >>> round(float(Hii(0.5, 1e-3, 1.0, 0.5, 1e-3)(1000.0)), 4)
    0.3679
    """

    curve: ClassVar[str] = "hii"
    bounds: ClassVar = {
        "rate_constant": POSITIVE,
        "rate_constant_second": POSITIVE,
        "time_exponent": EXPONENT,
    }
    model_factor: Number
    rate_constant: PositiveNumber
    time_exponent: PositiveNumber
    model_factor_second: Number
    rate_constant_second: PositiveNumber

    def ratio(self, t: Any) -> Any:
        s = power(t, self.time_exponent)
        return self.model_factor * jnp.exp(-self.rate_constant * s) + self.model_factor_second * jnp.exp(
            -self.rate_constant_second * s
        )

    @classmethod
    def first(cls, k: float) -> dict[str, float]:
        return {
            "model_factor": 0.6,
            "rate_constant": 0.7 * k,
            "time_exponent": 1.0,
            "model_factor_second": 0.4,
            "rate_constant_second": 2.5 * k,
        }


@law(
    "thin_layer",
    name="thin_layer_wang_singh",
    source="wang1978; brooker1992",
    fitted={"thin_layer": (0.0, 1.0)},
    title="Thin layer, Wang–Singh",
    equation=r"MR = 1 + a t + b t^2",
    symbols={"time_slope": "a", "time_curvature": "b"},
)
class WangSingh(_Called):
    """Parabola that starts at 1; holds only inside the data, and turns up after its lowest point.

    A moisture ratio lies between 0 and 1 (Brooker and others): a curve beyond has left what it describes.

    >>> float(WangSingh(-1e-3, 2.5e-7)(1000.0))
    0.25
    """

    curve: ClassVar[str] = "wang_singh"
    time_slope: Number
    time_curvature: Number

    def ratio(self, t: Any) -> Any:
        return 1.0 + self.time_slope * t + self.time_curvature * t**2

    @classmethod
    def first(cls, k: float) -> dict[str, float]:
        return {"time_slope": -0.7 * k, "time_curvature": 0.12 * k * k}


@law(
    "thin_layer",
    name="thin_layer_parabolic",
    source="sharma2004; brooker1992",
    fitted={"thin_layer": (0.0, 1.0)},
    title="Thin layer, parabolic",
    equation=r"MR = a + b t + c t^2",
    typical={"model_offset": (0.9, 1.1)},
    symbols={"model_offset": "a"},
)
class Parabolic(_Called):
    """Parabola with a free start.

    A moisture ratio lies between 0 and 1 (Brooker and others): a curve beyond has left what it describes.

    >>> float(Parabolic(1.0, -1e-3, 2.5e-7)(1000.0))
    0.25
    """

    curve: ClassVar[str] = "parabolic"
    model_offset: Number
    time_slope: Number
    time_curvature: Number

    def ratio(self, t: Any) -> Any:
        return self.model_offset + self.time_slope * t + self.time_curvature * t**2

    @classmethod
    def first(cls, k: float) -> dict[str, float]:
        return {"model_offset": 1.0, "time_slope": -0.7 * k, "time_curvature": 0.12 * k * k}


@law(
    "thin_layer",
    name="thin_layer_peleg",
    source="peleg1988; brooker1992",
    fitted={"thin_layer": (0.0, 1.0)},
    title="Thin layer, Peleg",
    equation=r"MR = 1 - \frac{t}{a + b t}",
    symbols={"time_scale": "a"},
)
class PelegRatio(_Called):
    """Peleg's hyperbola: a is the inverse of the first rate, 1/b the largest change.

    A moisture ratio lies between 0 and 1 (Brooker and others): a curve beyond has left what it describes.

    >>> float(PelegRatio(1000.0, 1.0)(1000.0))
    0.5
    """

    curve: ClassVar[str] = "peleg"
    bounds: ClassVar = {"time_scale": POSITIVE}
    time_scale: Time
    capacity_constant: PositiveNumber

    def ratio(self, t: Any) -> Any:
        return 1.0 - t / (self.time_scale + self.capacity_constant * t)

    @classmethod
    def first(cls, k: float) -> dict[str, float]:
        return {"time_scale": 0.7 / k, "capacity_constant": 0.9}


@law(
    "thin_layer",
    name="thin_layer_silva",
    source="silva2013; brooker1992",
    fitted={"thin_layer": (0.0, 1.0)},
    title="Thin layer, Silva",
    equation=r"MR = e^{-a t - b\sqrt t}",
    symbols={"rate_constant": "a"},
)
class Silva(_Called):
    """First order with a square-root start, as short-time diffusion has.

    A moisture ratio lies between 0 and 1 (Brooker and others): a curve beyond has left what it describes.

    >>> round(float(Silva(1e-3, 0.0)(1000.0)), 4)
    0.3679
    """

    curve: ClassVar[str] = "silva"
    rate_constant: Number
    root_rate: Number

    def ratio(self, t: Any) -> Any:
        return jnp.exp(-self.rate_constant * t - self.root_rate * power(t, 0.5))

    @classmethod
    def first(cls, k: float) -> dict[str, float]:
        return {"rate_constant": 0.8 * k, "root_rate": 0.2 * k**0.5}


@law(
    "thin_layer",
    name="thin_layer_fick_simplified",
    source="diamente1991; crank1975, eq. 4.18",
    fitted={"thin_layer": (0.0, 0.6)},
    title="Thin layer, simplified Fick",
    equation=r"MR = a\,e^{-c\,t/L^2}",
)
class FickSimplified(_Called):
    """First term of the diffusion series on a thickness: the curve of Henderson and Pabis.

    As the first term of the series alone it holds below a moisture ratio of 0.6, where the second is less
    than a hundredth of it.

    >>> round(float(FickSimplified(1.0, 1e-9, 1e-3)(1000.0)), 4)
    0.3679
    """

    curve: ClassVar[str] = "henderson_pabis"
    bounds: ClassVar = {"rate_area": POSITIVE}
    model_factor: Number
    rate_area: PositiveNumber
    thickness: Length = 1.0

    def ratio(self, t: Any) -> Any:
        return self.model_factor * jnp.exp(-self.rate_area * t / self.thickness**2)

    @classmethod
    def first(cls, k: float) -> dict[str, float]:
        return {"model_factor": 1.0, "rate_area": k}


@law(
    "thin_layer",
    name="thin_layer_thompson",
    source="thompson1968",
    title="Thin layer, Thompson",
    equation=r"t = a\,\ln MR + b\,(\ln MR)^2",
)
class Thompson(_Called):
    """Thompson's time over moisture ratio, turned round: both constants as printed, a negative and b positive
    in seconds.

    >>> round(float(Thompson(-1000.0, 0.0)(1000.0)), 4)
    0.3679
    """

    curve: ClassVar[str] = "thompson"
    bounds: ClassVar = {"thompson_linear": (-INF, -1e-9), "thompson_quadratic": (0.0, INF)}
    thompson_linear: Number
    thompson_quadratic: Number

    def ratio(self, t: Any) -> Any:
        a, b = self.thompson_linear, self.thompson_quadratic
        # the branch with ln MR ≤ 0, written without cancellation: ln MR = 2t/(a − √(a² + 4bt))
        return jnp.exp(2.0 * t / (a - jnp.sqrt(a * a + 4.0 * b * t)))

    @classmethod
    def first(cls, k: float) -> dict[str, float]:
        return {"thompson_linear": -0.9 / k, "thompson_quadratic": 0.1 / k}


@law(
    "thin_layer",
    name="thin_layer_geometric",
    source="chandra1995; brooker1992",
    fitted={"thin_layer": (0.0, 1.0)},
    title="Thin layer, geometric",
    equation=r"MR = a\,t^{-n}",
)
class Geometric(_Called):
    """Power of time; infinite at the start, for late times only.

    A moisture ratio lies between 0 and 1 (Brooker and others): a curve beyond has left what it describes.

    >>> float(Geometric(10.0, 0.5)(100.0))
    1.0
    """

    curve: ClassVar[str] = "geometric"
    bounds: ClassVar = {"time_exponent": EXPONENT}
    model_factor: PositiveNumber
    time_exponent: PositiveNumber

    def ratio(self, t: Any) -> Any:
        return self.model_factor * jnp.maximum(t, 1e-9) ** -self.time_exponent

    @classmethod
    def first(cls, k: float) -> dict[str, float]:
        return {"model_factor": 0.4 * k**-0.5, "time_exponent": 0.5}


@law(
    "thin_layer",
    name="thin_layer_aghbashlo",
    source="aghbashlo2009; brooker1992",
    fitted={"thin_layer": (0.0, 1.0)},
    title="Thin layer, Aghbashlo",
    equation=r"MR = e^{-k_1 t/(1+k_2 t)}",
    symbols={"rate_constant": "k_1", "rate_constant_second": "k_2"},
)
class Aghbashlo(_Called):
    """First order with a rate that changes in time.

    A moisture ratio lies between 0 and 1 (Brooker and others): a curve beyond has left what it describes.

    >>> round(float(Aghbashlo(1e-3, 0.0)(1000.0)), 4)
    0.3679
    """

    curve: ClassVar[str] = "aghbashlo"
    bounds: ClassVar = {"rate_constant": POSITIVE}
    rate_constant: PositiveNumber
    rate_constant_second: Number

    def ratio(self, t: Any) -> Any:
        bottom = 1.0 + self.rate_constant_second * t
        return jnp.exp(-self.rate_constant * t / jnp.where(jnp.abs(bottom) > 1e-6, bottom, 1e-6))

    @classmethod
    def first(cls, k: float) -> dict[str, float]:
        return {"rate_constant": k, "rate_constant_second": -0.01 * k}
