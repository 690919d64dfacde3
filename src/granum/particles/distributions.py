"""Size distributions by class: what a sieve stack, a laser or a counter gives, on any basis, one or many at a
time.
"""

from __future__ import annotations

from typing import Any, Literal

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np

from granum.core.at_once import at_once
from granum.core.conversion import is_tracer
from granum.core.errors import InputError, unknown_name
from granum.core.i18n import _
from granum.particles.in_class import InClassRule, UniformDensity

Basis = Literal["number", "length", "surface", "volume", "mass"]
ORDER = {"number": 0, "length": 1, "surface": 2, "volume": 3, "mass": 3}
SUM_TOLERANCE = 5e-3
_ROUNDING = 1e-12


def order_of(basis: str) -> int:
    """The exponent of a basis: number 0, length 1, surface 2, volume (or mass, for one density) 3."""
    if basis not in ORDER:
        raise unknown_name(_("Basis"), str(basis), ORDER)
    return ORDER[basis]


class SizeDistribution(eqx.Module):
    """Fractions by size class on a stated basis, with a stated rule inside each class.

    Parameters
    ----------
    edges: limits of the classes, increasing, n + 1 values, m. The first may be 0: the smallest class then has
        no measured lower limit.
    fractions: part of the material in each class, summing to 1; shape ``(n,)`` or ``(many, n)``.
    basis: what the fractions count.
    in_class: rule inside a class, on that basis.

    Conversion between bases is exact under the rule: moments and percentiles do not depend on the basis in
    which the distribution is carried, and converting back restores the fractions.

    >>> d = SizeDistribution([0.0, 1e-4, 2e-4], [0.25, 0.75])
    >>> float((d.percentile(0.5) * 1e6).round(3))
    133.333
    """

    edges: Any
    fractions: Any
    basis: str = eqx.field(static=True)
    in_class: InClassRule

    def __init__(
        self, edges: Any, fractions: Any, basis: str = "volume", in_class: InClassRule | None = None
    ):
        order_of(basis)
        edges, fractions = _checked_classes(edges, fractions)
        total = fractions.sum(axis=-1, keepdims=True)
        if not is_tracer(total):
            worst = float(np.max(abs(np.asarray(total) - 1.0)))
            if worst > SUM_TOLERANCE:
                raise _wrong_sum(np.asarray(total))
        self.edges, self.fractions = edges, fractions / total
        self.basis = basis
        self.in_class = UniformDensity() if in_class is None else in_class

    @classmethod
    def from_amounts(
        cls, edges: Any, amounts: Any, basis: str = "volume", in_class: InClassRule | None = None
    ) -> SizeDistribution:
        """From masses, counts or percentages by class, whatever they add up to.

        >>> SizeDistribution.from_amounts([1e-6, 2e-6, 4e-6], [30, 10], basis="number").fractions
        Array([0.75, 0.25], dtype=float64)
        """
        edges, amounts = _checked_classes(edges, amounts)
        total = amounts.sum(axis=-1, keepdims=True)
        if not is_tracer(total) and np.any(np.asarray(total) <= 0.0):
            raise InputError(
                _("The classes are all empty: at least one needs material."), name="class_amounts"
            )
        return cls(edges, amounts / total, basis, in_class)

    @classmethod
    def from_cumulative(
        cls, edges: Any, below: Any, basis: str = "volume", in_class: InClassRule | None = None
    ) -> SizeDistribution:
        """From the cumulative fraction below each edge; it must start at 0 and end at 1.

        >>> SizeDistribution.from_cumulative([0, 1e-5, 2e-5], [0, 0.4, 1]).fractions
        Array([0.4, 0.6], dtype=float64)
        """
        below = jnp.asarray(below, dtype=float)
        if not is_tracer(below):
            ends = np.asarray(below)[..., [0, -1]]
            if np.any(abs(ends - np.array([0.0, 1.0])) > SUM_TOLERANCE):
                raise InputError(
                    _(
                        "The cumulative curve runs from {first} to {last}: it must run from 0 to 1. Add "
                        "the smallest and the largest size."
                    ).format(
                        first=f"{ends.reshape(-1, 2)[0, 0]:.4g}", last=f"{ends.reshape(-1, 2)[0, 1]:.4g}"
                    ),
                    name="cumulative_fraction",
                )
        return cls(edges, jnp.diff(below, axis=-1), basis, in_class)

    @property
    def order(self) -> int:
        """Exponent of the basis: 0, 1, 2 or 3."""
        return order_of(self.basis)

    @property
    def lower(self) -> Any:
        """Lower class limits, m."""
        return self.edges[:-1]

    @property
    def upper(self) -> Any:
        """Upper class limits, m."""
        return self.edges[1:]

    def _weights(self, power: Any) -> Any:
        return self.in_class(self.lower, self.upper, power)

    @at_once("power", "basis")
    def moment(self, power: Any, basis: str | None = None) -> Any:
        """Mean of ``x**power`` weighted by a basis (its own by default), m^power: M_{k,r} of ISO 9276-2.

        >>> d = SizeDistribution([1e-6, 3e-6], [1.0])
        >>> float(d.moment(1.0).round(12))
        2e-06
        """
        shift = 0 if basis is None else order_of(basis) - self.order
        above = self.fractions @ self._weights(power + shift)
        return above / (self.fractions @ self._weights(shift)) if shift else above

    @at_once("p", "q")
    def mean(self, p: float, q: float) -> Any:
        """D[p,q], the moment-ratio mean of ISO 9276-2: ``(M_p0 / M_q0) ** (1 / (p - q))``, m.

        D[1,0] arithmetic, D[2,0] and D[3,0] of surface and volume, D[3,2] Sauter, D[4,3] mass mean, D[0,0]
        geometric mean by number.

        >>> d = SizeDistribution([2e-6, 4e-6, 8e-6], [0.5, 0.5], basis="number")
        >>> float((d.mean(1, 0) * 1e6).round(6))
        4.5
        """
        if p == q:
            slope = jax.jvp(
                lambda s: jnp.log(self.fractions @ self._weights(p - self.order + s)), (0.0,), (1.0,)
            )[1]
            return jnp.exp(slope)
        high, low = (self.fractions @ self._weights(k - self.order) for k in (p, q))
        return (high / low) ** (1.0 / (p - q))

    @at_once("basis")
    def to_basis(self, basis: str) -> SizeDistribution:
        """The same distribution counted on another basis."""
        shift = order_of(basis) - self.order
        parts = self.fractions * self._weights(shift) if shift else self.fractions
        return SizeDistribution(
            self.edges, parts / parts.sum(axis=-1, keepdims=True), basis, self.in_class.on_basis(shift)
        )

    def cumulative_at_edges(self) -> Any:
        """Fraction below each edge: n + 1 values from 0 to 1."""
        start = jnp.zeros((*self.fractions.shape[:-1], 1))
        return jnp.concatenate([start, jnp.cumsum(self.fractions, axis=-1)], axis=-1)

    @at_once()
    def cumulative(self, size: Any) -> Any:
        """Fraction below a size; 0 below the smallest edge, 1 above the largest. A distribution stack gives
        ``(many, *size)``.

        >>> float(SizeDistribution([0, 1e-5, 2e-5], [0.4, 0.6]).cumulative(1.5e-5).round(6))
        0.7
        """
        size = jnp.asarray(size, dtype=float)
        inside = jnp.clip(size, self.edges[0], self.edges[-1])
        i = jnp.clip(jnp.searchsorted(self.edges, inside, side="right") - 1, 0, self.edges.shape[0] - 2)
        part = self.in_class.part_below(self.edges[i], self.edges[i + 1], inside)
        return self.cumulative_at_edges()[..., i] + self.fractions[..., i] * jnp.clip(part, 0.0, 1.0)

    def density(self) -> Any:
        """Fraction per size in each class: the height of the histogram, 1/m."""
        return self.fractions / (self.upper - self.lower)

    @at_once()
    def log_density(self) -> Any:
        """Fraction per natural logarithm of size in each class; 0 where a class starts at 0."""
        usable = self.lower > 0
        width = jnp.log(self.upper / jnp.where(usable, self.lower, self.upper / jnp.e))
        return jnp.where(usable, self.fractions / width, 0.0)

    @at_once()
    def percentile(self, part: Any) -> Any:
        """Size below which a part (0 to 1) of the material lies; always a size between the first and the last
        edge.

        One part gives the shape of the stack; several parts add a last axis. Inside empty classes the
        smallest size with that part below is taken. See ``is_measured`` for parts in a class without a
        measured lower limit.
        """
        part = jnp.asarray(part, dtype=float)
        wanted = jnp.atleast_1d(part)
        below = self.cumulative_at_edges()[..., 1:]
        short = below[..., None, :] < wanted[:, None] * below[..., None, -1:]
        i = jnp.minimum(jnp.sum(short, axis=-1), self.fractions.shape[-1] - 1)
        content, over = (jnp.take_along_axis(a, i, axis=-1) for a in (self.fractions, below))
        full = content > 0
        inner = 1.0 - (over - wanted * below[..., -1:]) / jnp.where(full, content, 1.0)
        found = self.in_class.size_at(
            self.edges[i], self.edges[i + 1], jnp.where(full, jnp.clip(inner, 0.0, 1.0), 0.0)
        )
        return found if part.ndim else found[..., 0]

    def is_measured(self, part: Any) -> Any:
        """Whether a percentile lies above the smallest measured limit: false only when the first edge is
        0 and it lies below the second.
        """
        part = jnp.asarray(part, dtype=float)
        first = self.fractions[..., 0]
        return (self.edges[0] > 0) | (part > (first[..., None] if part.ndim else first))

    def span(self) -> Any:
        """(d90 - d10) / d50."""
        d10, d50, d90 = (self.percentile(p) for p in (0.1, 0.5, 0.9))
        return (d90 - d10) / d50

    def specific_surface(self, sphericity: Any = 1.0) -> Any:
        """Surface per volume of solid, 6 / (sphericity D[3,2]), 1/m."""
        return 6.0 / (sphericity * self.mean(3, 2))

    def regrouped(self, edges: Any) -> SizeDistribution:
        """The same material in other classes that span at least the old ones, by the cumulative curve."""
        edges = jnp.asarray(edges, dtype=float)
        if not is_tracer(edges) and (
            float(edges[0]) > float(self.edges[0]) or float(edges[-1]) < float(self.edges[-1])
        ):
            raise InputError(
                _("The new classes do not span the old ones: material would be lost."), name="class_edges"
            )
        return SizeDistribution(edges, jnp.diff(self.cumulative(edges), axis=-1), self.basis, self.in_class)


def _checked_classes(edges: Any, amounts: Any) -> tuple[jax.Array, jax.Array]:
    edges, amounts = (jnp.asarray(a, dtype=float) for a in (edges, amounts))
    if edges.ndim != 1 or amounts.ndim == 0 or edges.shape[0] != amounts.shape[-1] + 1:
        raise InputError(
            _(
                "{edges} class limits and {classes} fractions do not go together: n classes have n + "
                "1 limits."
            ).format(
                edges=edges.shape[-1] if edges.ndim else 1, classes=amounts.shape[-1] if amounts.ndim else 1
            ),
            name="class_edges",
        )
    if not is_tracer(edges):
        limits = np.asarray(edges)
        if not np.all(np.isfinite(limits)) or limits[0] < 0.0:
            raise InputError(
                _("Class limits must be finite and not negative; the first is {first} m.").format(
                    first=limits[0]
                ),
                name="class_edges",
            )
        down = np.flatnonzero(np.diff(limits) <= 0.0)
        if down.size:
            i = int(down[0])
            raise InputError(
                _(
                    "Class limits must increase: limit {place} is {first} m and the next {second} m. "
                    "Sort the table from fine to coarse."
                ).format(place=i + 1, first=f"{limits[i]:.4g}", second=f"{limits[i + 1]:.4g}"),
                name="class_edges",
            )
    if not is_tracer(amounts):
        found = np.asarray(amounts)
        if not np.all(np.isfinite(found)) or np.any(found < -_ROUNDING * abs(found).max()):
            bad = int(
                np.argmin(
                    np.where(np.isfinite(found), found, -np.inf).reshape(-1, found.shape[-1]).min(axis=0)
                )
            )
            raise InputError(
                _("Class {place} holds {value}: no class can hold less than nothing.").format(
                    place=bad + 1, value=f"{float(found.reshape(-1, found.shape[-1])[:, bad].min()):.4g}"
                ),
                name="class_fractions",
            )
    return edges, jnp.where(amounts < 0.0, 0.0, amounts)


def _wrong_sum(total: np.ndarray) -> InputError:
    off = float(total.ravel()[int(np.argmax(abs(total.ravel() - 1.0)))])
    message = _("The fractions add up to {total}: they must add up to 1 (100 %).").format(total=f"{off:.4g}")
    if abs(off - 100.0) < 100.0 * SUM_TOLERANCE * 2:
        message += " " + _("These look like percentages: divide by 100.")
    else:
        message += " " + _(
            "Add the missing material (pan, oversize, losses) or give amounts instead of fractions."
        )
    return InputError(message, name="class_fractions", value=off)
