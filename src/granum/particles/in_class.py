"""How a size class is filled: the rule that turns class fractions into moments, bases and percentiles.

A rule answers three questions about the material of one class ``[lower, upper]``: the mean of a power of its
size, the part below a size, and the size at a part. A rule also knows what it becomes when the fractions are
put on another basis, so that converting to number and back gives the same distribution again.
"""

from __future__ import annotations

from abc import abstractmethod
from typing import Any

import equinox as eqx
import jax.numpy as jnp

from granum.core import law
from granum.core.kinds import Distance, Length, Number, PositiveNumber

_SMALL = 1e-9


class InClassRule(eqx.Module):
    """What every in-class rule can do."""

    @abstractmethod
    def __call__(self, smaller_size: Distance, larger_size: Length, moment_order: Number) -> PositiveNumber:
        """Mean of ``x**moment_order`` over the material of a class, m^moment_order."""

    @abstractmethod
    def part_below(self, lower: Any, upper: Any, size: Any) -> Any:
        """Part of the class below a size inside it, 0 to 1."""

    @abstractmethod
    def size_at(self, lower: Any, upper: Any, part: Any) -> Any:
        """Size below which a part of the class lies."""

    def on_basis(self, shift: int) -> InClassRule:
        """The rule after fractions have been multiplied by ``x**shift``."""
        return self


def _power_integral(order: Any, ratio: Any) -> Any:
    """Integral of ``t**(order - 1)`` from ``ratio`` to 1; infinite where it diverges at ratio 0."""
    positive = ratio > 0
    log_ratio = jnp.log(jnp.where(positive, ratio, 1.0))
    y = order * log_ratio
    near = abs(y) < _SMALL
    inner = jnp.where(
        near, -log_ratio * (1.0 + 0.5 * y), -jnp.expm1(y) / jnp.where(near | (order == 0), 1.0, order)
    )
    return jnp.where(positive, inner, jnp.where(order > 0, 1.0 / jnp.where(order > 0, order, 1.0), jnp.inf))


class PowerDensity(InClassRule):
    """Density proportional to a power of the size inside each class."""

    @property
    @abstractmethod
    def exponent(self) -> float:
        """The power: 0 for a constant density, -1 for a constant density over the logarithm."""

    def __call__(self, smaller_size: Distance, larger_size: Length, moment_order: Number) -> PositiveNumber:
        """Mean of a power; a class that starts at 0 and has no finite mean counts at its middle."""
        lower, upper = (jnp.asarray(a, dtype=float) for a in (smaller_size, larger_size))
        above = _power_integral(moment_order + self.exponent + 1.0, lower / upper)
        below = _power_integral(jnp.asarray(self.exponent + 1.0), lower / upper)
        finite = jnp.isfinite(above) & jnp.isfinite(below)
        ratio = jnp.where(finite, above, 1.0) / jnp.where(finite, below, 1.0)
        return jnp.where(finite, upper**moment_order * ratio, (0.5 * upper) ** moment_order)

    def part_below(self, lower: Any, upper: Any, size: Any) -> Any:
        """Part of the class below a size inside it."""
        whole = _power_integral(jnp.asarray(self.exponent + 1.0), lower / upper)
        finite = jnp.isfinite(whole)
        above = _power_integral(jnp.asarray(self.exponent + 1.0), jnp.where(finite, size / upper, 1.0))
        return jnp.where(
            finite, 1.0 - above / jnp.where(finite, whole, 1.0), jnp.where(size >= 0.5 * upper, 1.0, 0.0)
        )

    def size_at(self, lower: Any, upper: Any, part: Any) -> Any:
        """Size below which a part of the class lies."""
        order = self.exponent + 1.0
        ratio = lower / upper
        if order == 0.0:
            positive = ratio > 0
            return jnp.where(positive, upper * jnp.where(positive, ratio, 1.0) ** (1.0 - part), 0.5 * upper)
        usable = (ratio > 0) | (order > 0)
        base = jnp.where(ratio > 0, ratio, 0.0 if order > 0 else 1.0) ** order
        return jnp.where(usable, upper * (base + part * (1.0 - base)) ** (1.0 / order), 0.5 * upper)

    def on_basis(self, shift: int) -> InClassRule:
        """The density on the new basis is a power again."""
        return _named(self.exponent + shift)


class ShiftedDensity(PowerDensity):
    """A power density seen on another basis."""

    power: float = eqx.field(static=True)

    @property
    def exponent(self) -> float:
        """The power on this basis."""
        return self.power


@law(
    "in_class_rule",
    name="uniform",
    source="iso9276-2; astm_e799",
    title="Uniform density in each class",
    equation=r"q(x) = \text{const. for } x_{i-1} < x \le x_i",
)
class UniformDensity(PowerDensity):
    """Density of the measured basis constant in each class: the cumulative curve is a polygon.

    A class that starts at 0 has no finite number or surface; it counts at its middle there.
    """

    @property
    def exponent(self) -> float:
        """The power."""
        return 0.0


@law(
    "in_class_rule",
    name="log_uniform",
    source="allen1997",
    title="Uniform density in the logarithm of size",
    equation=r"x\,q(x) = \text{const. for } x_{i-1} < x \le x_i",
)
class LogUniformDensity(PowerDensity):
    """Density over the logarithm of size constant in each class: a polygon on a logarithmic axis."""

    @property
    def exponent(self) -> float:
        """The power."""
        return -1.0


def _named(power: float) -> InClassRule:
    return (
        UniformDensity() if power == 0.0 else LogUniformDensity() if power == -1.0 else ShiftedDensity(power)
    )


class _Lumped(InClassRule):
    """All material of a class at one size; percentiles still follow the cumulative polygon."""

    @abstractmethod
    def middle(self, lower: Any, upper: Any) -> Any:
        """The representative size of a class."""

    def __call__(self, smaller_size: Distance, larger_size: Length, moment_order: Number) -> PositiveNumber:
        """The power of the representative size."""
        return (
            self.middle(jnp.asarray(smaller_size, dtype=float), jnp.asarray(larger_size, dtype=float))
            ** moment_order
        )


@law(
    "in_class_rule",
    name="midpoint",
    source="iso9276-2",
    title="All of a class at its arithmetic middle",
    equation=r"\bar x_i = \tfrac12 (x_{i-1} + x_i)",
)
class ArithmeticMidpoint(_Lumped):
    """All particles of a class have the size in its middle: the rule of most textbook tables."""

    def middle(self, lower: Any, upper: Any) -> Any:
        """Arithmetic mean of the limits."""
        return 0.5 * (lower + upper)

    def part_below(self, lower: Any, upper: Any, size: Any) -> Any:
        """Straight line through the class."""
        return (size - lower) / (upper - lower)

    def size_at(self, lower: Any, upper: Any, part: Any) -> Any:
        """Straight line through the class."""
        return lower + part * (upper - lower)


@law(
    "in_class_rule",
    name="geometric_midpoint",
    source="iso9276-2",
    title="All of a class at its geometric middle",
    equation=r"\bar x_i = \sqrt{x_{i-1} x_i}",
)
class GeometricMidpoint(_Lumped):
    """All particles of a class have the geometric mean of its limits; a class that starts at 0 counts at its
    middle.
    """

    def middle(self, lower: Any, upper: Any) -> Any:
        """Geometric mean of the limits."""
        positive = lower > 0
        return jnp.where(positive, jnp.sqrt(jnp.where(positive, lower, 1.0) * upper), 0.5 * upper)

    def part_below(self, lower: Any, upper: Any, size: Any) -> Any:
        """Straight line over the logarithm of size."""
        positive = (lower > 0) & (size > 0)
        low = jnp.where(positive, lower, 1.0)
        logs = jnp.log(jnp.where(positive, size, 1.0) / low) / jnp.where(positive, jnp.log(upper / low), 1.0)
        return jnp.where(positive, logs, (size - lower) / (upper - lower))

    def size_at(self, lower: Any, upper: Any, part: Any) -> Any:
        """Straight line over the logarithm of size."""
        positive = lower > 0
        low = jnp.where(positive, lower, 1.0)
        return jnp.where(positive, low * (upper / low) ** part, part * upper)
