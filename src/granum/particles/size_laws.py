"""Size distributions as laws: cumulative curve, density, moments, percentiles, and their classes."""

from __future__ import annotations

from abc import abstractmethod
from typing import TYPE_CHECKING, Annotated, Any

import equinox as eqx
import jax.numpy as jnp
from jax.scipy.special import gammaln, ndtr, ndtri

from granum.core import law
from granum.core.conversion import is_tracer
from granum.core.errors import InputError
from granum.core.i18n import _
from granum.core.kinds import Fraction, Law, Length, PositiveNumber, Within
from granum.numerics.quadrature import gauss_legendre
from granum.numerics.roots import find_root
from granum.particles.distributions import Basis, SizeDistribution, order_of
from granum.particles.in_class import InClassRule

_NODES = 64


class SizeLaw(eqx.Module):
    """What every size law can do. Its own basis is the one its cumulative curve counts."""

    if TYPE_CHECKING:  # a field of every subclass, not declared here because a dataclass would put it first

        @property
        def basis(self) -> Any: ...

    @abstractmethod
    def __call__(self, particle_diameter: Length) -> Fraction:
        """Cumulative fraction below a size."""

    @abstractmethod
    def density(self, particle_diameter: Any) -> Any:
        """Derivative of the cumulative curve, 1/m."""

    @abstractmethod
    def percentile(self, part: Any) -> Any:
        """Size below which a part lies, m."""

    @abstractmethod
    def moment(self, power: Any) -> Any:
        """Mean of ``x**power`` on the law's own basis; infinite where it does not exist."""

    def mean(self, p: float, q: float) -> Any:
        """D[p,q] (``p != q``), m, whatever the basis of the law; not a number where a moment is infinite."""
        order = order_of(self.basis)
        high, low = self.moment(p - order), self.moment(q - order)
        exists = jnp.isfinite(high) & jnp.isfinite(low)
        return jnp.where(exists, jnp.where(exists, high, 1.0) / jnp.where(exists, low, 1.0), jnp.nan) ** (
            1.0 / (p - q)
        )

    def span(self) -> Any:
        """(d90 - d10) / d50."""
        return (self.percentile(0.9) - self.percentile(0.1)) / self.percentile(0.5)

    def classes(self, edges: Any, in_class: InClassRule | None = None) -> SizeDistribution:
        """The law cut into classes; the tails beyond the outer limits go into the outer classes, so nothing
        is lost.
        """
        edges = jnp.asarray(edges, dtype=float)
        below = jnp.concatenate([jnp.zeros(1), self(edges[1:-1]), jnp.ones(1)])
        return SizeDistribution(edges, jnp.diff(below), self.basis, in_class)


def _positive(x: Any) -> tuple[Any, Any]:
    x = jnp.asarray(x, dtype=float)
    return x > 0, jnp.where(x > 0, x, 1.0)


@law(
    "size_distribution",
    name="rosin_rammler",
    source="rosin1933; iso9276-3",
    title="Rosin–Rammler–Sperling–Bennett law",
    equation=r"Q(x) = 1 - \exp\!\left[-(x/x')^n\right]",
    symbols={"particle_diameter": "x"},
)
class RosinRammler(SizeLaw):
    """Weibull law of ground products, by the size with 63.2 % below it and the uniformity exponent.

    >>> round(float(RosinRammler(size_modulus="100 um", distribution_exponent=1.2)(100e-6)), 4)
    0.6321
    """

    size_modulus: Length
    distribution_exponent: PositiveNumber
    basis: Basis = eqx.field(static=True, default="volume")

    def __call__(self, particle_diameter: Length) -> Fraction:
        """Cumulative fraction below a size."""
        inside, x = _positive(particle_diameter)
        return jnp.where(inside, -jnp.expm1(-((x / self.size_modulus) ** self.distribution_exponent)), 0.0)

    def density(self, particle_diameter: Any) -> Any:
        """Derivative of the cumulative curve, 1/m."""
        inside, x = _positive(particle_diameter)
        n, t = self.distribution_exponent, (x / self.size_modulus) ** self.distribution_exponent
        return jnp.where(inside, n / x * t * jnp.exp(-t), 0.0)

    def percentile(self, part: Any) -> Any:
        """Size below which a part lies, m."""
        return self.size_modulus * (-jnp.log1p(-jnp.asarray(part))) ** (1.0 / self.distribution_exponent)

    def moment(self, power: Any) -> Any:
        """``x'^k Gamma(1 + k/n)``, for k > -n."""
        z = 1.0 + power / self.distribution_exponent
        exists = z > 0
        return jnp.where(
            exists, self.size_modulus**power * jnp.exp(gammaln(jnp.where(exists, z, 1.0))), jnp.inf
        )


@law(
    "size_distribution",
    name="log_normal",
    source="iso9276-5; hatch1929",
    title="Log-normal law",
    equation=r"Q(x) = \Phi\!\left(\frac{\ln (x/d_{50})}{\ln\sigma_g}\right)",
    symbols={"particle_diameter": "x"},
)
class LogNormal(SizeLaw):
    """Normal law over the logarithm of size, by median and geometric standard deviation.

    >>> round(float(LogNormal(median_diameter="10 um", geometric_standard_deviation=2.0)(20e-6)), 4)
    0.8413
    """

    median_diameter: Length
    geometric_standard_deviation: Annotated[PositiveNumber, Within(1.0000001)]
    basis: Basis = eqx.field(static=True, default="volume")

    def __call__(self, particle_diameter: Length) -> Fraction:
        """Cumulative fraction below a size."""
        inside, x = _positive(particle_diameter)
        return jnp.where(
            inside, ndtr(jnp.log(x / self.median_diameter) / jnp.log(self.geometric_standard_deviation)), 0.0
        )

    def density(self, particle_diameter: Any) -> Any:
        """Derivative of the cumulative curve, 1/m."""
        inside, x = _positive(particle_diameter)
        s = jnp.log(self.geometric_standard_deviation)
        z = jnp.log(x / self.median_diameter) / s
        return jnp.where(inside, jnp.exp(-0.5 * z**2) / (x * s * jnp.sqrt(2.0 * jnp.pi)), 0.0)

    def percentile(self, part: Any) -> Any:
        """Size below which a part lies, m."""
        return self.median_diameter * jnp.exp(
            jnp.log(self.geometric_standard_deviation) * ndtri(jnp.asarray(part, dtype=float))
        )

    def moment(self, power: Any) -> Any:
        """``d50^k exp(k^2 s^2 / 2)``."""
        return self.median_diameter**power * jnp.exp(
            0.5 * (power * jnp.log(self.geometric_standard_deviation)) ** 2
        )


@law(
    "size_distribution",
    name="normal",
    source="iso9276-3",
    title="Normal law",
    equation=r"Q(x) = \Phi\!\left(\frac{x - d_{50}}{\sigma}\right)\ \text{cut at } x = 0",
    symbols={"mean_diameter": "d_{50}", "particle_diameter": "x"},
)
class Normal(SizeLaw):
    """Normal law over the size, cut off and renormalized at 0, for narrow products.

    Moments are taken between 0.1 % of the mean and eight standard deviations above it, so that negative ones
    are finite; with a standard deviation above a third of the mean the law puts material near 0 and negative
    moments depend on that limit.

    >>> round(float(Normal(mean_diameter="100 um", standard_deviation="10 um")(110e-6)), 4)
    0.8413
    """

    mean_diameter: Length
    standard_deviation: Length
    basis: Basis = eqx.field(static=True, default="volume")

    @property
    def _cut(self) -> Any:
        return ndtr(-self.mean_diameter / self.standard_deviation)

    def __call__(self, particle_diameter: Length) -> Fraction:
        """Cumulative fraction below a size."""
        inside, x = _positive(particle_diameter)
        z = (x - self.mean_diameter) / self.standard_deviation
        return jnp.where(inside, (ndtr(z) - self._cut) / (1.0 - self._cut), 0.0)

    def density(self, particle_diameter: Any) -> Any:
        """Derivative of the cumulative curve, 1/m."""
        x = jnp.asarray(particle_diameter, dtype=float)
        z = (x - self.mean_diameter) / self.standard_deviation
        bell = jnp.exp(-0.5 * z**2) / (self.standard_deviation * jnp.sqrt(2.0 * jnp.pi) * (1.0 - self._cut))
        return jnp.where(x > 0, bell, 0.0)

    def percentile(self, part: Any) -> Any:
        """Size below which a part lies, m."""
        u = self._cut + jnp.asarray(part, dtype=float) * (1.0 - self._cut)
        return self.mean_diameter + self.standard_deviation * ndtri(u)

    def moment(self, power: Any) -> Any:
        """Mean of a power, by quadrature."""
        m, s = self.mean_diameter, self.standard_deviation
        low, high = jnp.maximum(m - 8.0 * s, 1e-3 * m), m + 8.0 * s
        return gauss_legendre(lambda x: x**power * self.density(x), low, high, order=_NODES)


@law(
    "size_distribution",
    name="gates_gaudin_schuhmann",
    source="schuhmann1940; iso9276-3",
    title="Gates–Gaudin–Schuhmann law",
    equation=r"Q(x) = (x/x_{\max})^n,\quad x \le x_{\max}",
    symbols={"particle_diameter": "x"},
)
class GatesGaudinSchuhmann(SizeLaw):
    """Power law up to the largest size: a straight line on log–log axes.

    >>> round(float(GatesGaudinSchuhmann(size_maximum="1 mm", distribution_exponent=0.5)(0.25e-3)), 6)
    0.5
    """

    size_maximum: Length
    distribution_exponent: PositiveNumber
    basis: Basis = eqx.field(static=True, default="volume")

    def __call__(self, particle_diameter: Length) -> Fraction:
        """Cumulative fraction below a size."""
        inside, x = _positive(particle_diameter)
        return jnp.where(inside, jnp.minimum(x / self.size_maximum, 1.0) ** self.distribution_exponent, 0.0)

    def density(self, particle_diameter: Any) -> Any:
        """Derivative of the cumulative curve, 1/m."""
        inside, x = _positive(particle_diameter)
        n = self.distribution_exponent
        return jnp.where(inside & (x <= self.size_maximum), n / x * (x / self.size_maximum) ** n, 0.0)

    def percentile(self, part: Any) -> Any:
        """Size below which a part lies, m."""
        return self.size_maximum * jnp.asarray(part, dtype=float) ** (1.0 / self.distribution_exponent)

    def moment(self, power: Any) -> Any:
        """``x_max^k n / (n + k)``, for k > -n."""
        n = self.distribution_exponent
        exists = n + power > 0
        return jnp.where(exists, self.size_maximum**power * n / jnp.where(exists, n + power, 1.0), jnp.inf)


@law(
    "size_distribution",
    name="gaudin_meloy",
    source="gaudin1962",
    title="Gaudin–Meloy law",
    equation=r"Q(x) = 1 - (1 - x/x_{\max})^n,\quad x \le x_{\max}",
    symbols={"particle_diameter": "x"},
)
class GaudinMeloy(SizeLaw):
    """Law of single fracture: linear at small sizes, with a largest size.

    >>> round(float(GaudinMeloy(size_maximum="1 mm", distribution_exponent=2.0)(0.5e-3)), 6)
    0.75
    """

    size_maximum: Length
    distribution_exponent: PositiveNumber
    basis: Basis = eqx.field(static=True, default="volume")

    def __call__(self, particle_diameter: Length) -> Fraction:
        """Cumulative fraction below a size."""
        t = jnp.clip(1.0 - jnp.asarray(particle_diameter) / self.size_maximum, 0.0, 1.0)
        inside, t_safe = _positive(t)
        return jnp.where(inside, 1.0 - t_safe**self.distribution_exponent, 1.0)

    def density(self, particle_diameter: Any) -> Any:
        """Derivative of the cumulative curve, 1/m."""
        x = jnp.asarray(particle_diameter, dtype=float)
        n, t = self.distribution_exponent, 1.0 - x / self.size_maximum
        inside = (x > 0) & (t > 0)
        return jnp.where(inside, n / self.size_maximum * jnp.where(inside, t, 1.0) ** (n - 1.0), 0.0)

    def percentile(self, part: Any) -> Any:
        """Size below which a part lies, m."""
        return self.size_maximum * (
            1.0 - (1.0 - jnp.asarray(part, dtype=float)) ** (1.0 / self.distribution_exponent)
        )

    def moment(self, power: Any) -> Any:
        """``x_max^k n B(k + 1, n)``, for k > -1."""
        n, exists = self.distribution_exponent, power > -1
        k = jnp.where(exists, power, 0.0)
        beta = jnp.exp(gammaln(k + 1.0) + gammaln(n) - gammaln(k + 1.0 + n))
        return jnp.where(exists, self.size_maximum**power * n * beta, jnp.inf)


@law(
    "size_distribution",
    name="mixture",
    source="iso9276-3",
    title="Mixture of two laws",
    equation=r"Q(x) = w\,Q_1(x) + (1 - w)\,Q_2(x)",
    symbols={"particle_diameter": "x"},
)
class Mixture(SizeLaw):
    """Two populations on one basis, such as product and fines.

    >>> fine, coarse = LogNormal("10 um", 1.5), LogNormal("100 um", 1.5)
    >>> round(float(Mixture(fine, coarse, first_share=0.3)(31.6e-6)), 2)
    0.3
    """

    first_law: Annotated[Any, Law("size_distribution")]
    second_law: Annotated[Any, Law("size_distribution")]
    first_share: Fraction

    def __check_init__(self) -> None:
        if self.first_law.basis != self.second_law.basis:
            raise InputError(
                _(
                    "The two laws count on different bases, {first} and {second}: give both on one basis."
                ).format(first=self.first_law.basis, second=self.second_law.basis),
                name="second_law",
            )

    @property
    def basis(self) -> str:  # type: ignore[override]
        """The basis of both laws."""
        return self.first_law.basis

    def _blend(self, first: Any, second: Any) -> Any:
        return self.first_share * first + (1.0 - self.first_share) * second

    def __call__(self, particle_diameter: Length) -> Fraction:
        """Cumulative fraction below a size."""
        return self._blend(self.first_law(particle_diameter), self.second_law(particle_diameter))

    def density(self, particle_diameter: Any) -> Any:
        """Derivative of the cumulative curve, 1/m."""
        return self._blend(
            self.first_law.density(particle_diameter), self.second_law.density(particle_diameter)
        )

    def percentile(self, part: Any) -> Any:
        """Size below which a part lies, m: between those of the two laws."""
        ends = self.first_law.percentile(part), self.second_law.percentile(part)
        part = jnp.asarray(part, dtype=float)
        return find_root(
            lambda x: self(x) - part, jnp.minimum(*ends) * (1 - 1e-12), jnp.maximum(*ends) * (1 + 1e-12)
        ).value

    def moment(self, power: Any) -> Any:
        """Mean of a power."""
        return self._blend(self.first_law.moment(power), self.second_law.moment(power))


def geometric_edges(smallest: float, largest: float, classes: int) -> Any:
    """Class limits in geometric progression.

    >>> [round(float(e), 3) for e in geometric_edges(1.0, 8.0, 3)]
    [1.0, 2.0, 4.0, 8.0]
    """
    if not is_tracer(smallest) and not 0.0 < smallest < largest:
        raise InputError(_("Class limits need 0 < smallest < largest."), name="class_edges")
    return jnp.exp(jnp.linspace(jnp.log(smallest), jnp.log(largest), classes + 1))
