"""Crystals as packets that move with the growth path: no grid, no numerical diffusion.

A packet holds a number of crystals spread evenly between two sizes. Growth that does not depend on size
shifts every packet by the same distance, so for growth and nucleation alone the first five moments are
shifted exactly and the packets are rebuilt at the end (``ShiftedMoments``). Where crystals dissolve or growth
depends on size, the packets themselves are carried (``Packets``). Both answer the same questions.
"""

from __future__ import annotations

from abc import abstractmethod
from math import comb
from typing import Any

import equinox as eqx
import jax.numpy as jnp
import numpy as np
from jax import lax

from granum.numerics.quadrature import gauss_legendre
from granum.numerics.smooth import safe_divide

FACTORS = 9  # growth rates that stand for a distribution of them
HIGHEST = 4  # order of the highest moment carried: D[4,3] over time


def mean_power(low: Any, high: Any, order: int) -> Any:
    """Mean of ``L**order`` over crystals spread evenly between two sizes, without dividing by their
    difference.
    """
    return sum(low**k * high ** (order - k) for k in range(order + 1)) / (order + 1)


class Population(eqx.Module):
    """Crystals in the whole vessel."""

    @abstractmethod
    def moments(self) -> Any:
        """Numbers, lengths, squares and cubes: the moments 0 to 4, shape (5,)."""

    @abstractmethod
    def cubes_after(self, path: Any) -> Any:
        """Third moment after growth by a path (negative: dissolution)."""

    @abstractmethod
    def grown(self, path: Any, born: Any, nucleus_size: Any, index: Any) -> Population:
        """The population after growth by a path, during which a number was born evenly in time."""

    @abstractmethod
    def kept(self, share: Any) -> Population:
        """The population after a share of every packet was left in the vessel."""


class ShiftedMoments(Population):
    """The moments 0 to 4 of all crystals, shifted exactly by growth that does not depend on size."""

    values: Any

    def moments(self) -> Any:
        return self.values

    def cubes_after(self, path: Any) -> Any:
        m, d = self.values, path
        return m[3] + d * (3.0 * m[2] + d * (3.0 * m[1] + d * m[0]))

    def grown(self, path: Any, born: Any, nucleus_size: Any, index: Any) -> ShiftedMoments:
        shifted = [
            sum(comb(k, j) * path ** (k - j) * self.values[j] for j in range(k + 1))
            for k in range(HIGHEST + 1)
        ]
        fresh = [jnp.asarray(mean_power(nucleus_size, nucleus_size + path, k)) for k in range(HIGHEST + 1)]
        return ShiftedMoments(jnp.stack(shifted) + born * jnp.stack(fresh))

    def kept(self, share: Any) -> ShiftedMoments:
        return ShiftedMoments(self.values * share)


class GrowthDispersion(eqx.Module):
    """Crystals that grow at rates of their own, constant multiples of the mean rate: log-normal with a
    coefficient of variation.
    """

    variation: Any

    def factors(self) -> tuple[np.ndarray, Any]:
        """Shares of the crystals (Gauss–Hermite) and their multiples of the mean growth rate."""
        x, w = np.polynomial.hermite_e.hermegauss(FACTORS)
        square = jnp.log1p(jnp.asarray(self.variation, dtype=float) ** 2)
        return w / w.sum(), jnp.exp(jnp.sqrt(square) * x - 0.5 * square)


class DispersedMoments(Population):
    """Moments of crystals sorted by their own growth rate: one row of moments 0 to 4 for each multiple of the
    mean rate.
    """

    values: Any
    factors: Any
    shares: Any

    @classmethod
    def of(cls, moments: Any, dispersion: GrowthDispersion) -> DispersedMoments:
        """Seeds of every size share out alike between the rates."""
        shares, factors = dispersion.factors()
        return cls(shares[:, None] * moments[None, :], factors, jnp.asarray(shares))

    def moments(self) -> Any:
        return jnp.sum(self.values, axis=0)

    def cubes_after(self, path: Any) -> Any:
        m, d = self.values, path * self.factors
        return jnp.sum(m[:, 3] + d * (3.0 * m[:, 2] + d * (3.0 * m[:, 1] + d * m[:, 0])))

    def grown(self, path: Any, born: Any, nucleus_size: Any, index: Any) -> DispersedMoments:
        d = path * self.factors
        shifted = [
            sum(comb(k, j) * d ** (k - j) * self.values[:, j] for j in range(k + 1))
            for k in range(HIGHEST + 1)
        ]
        fresh = [self.shares * mean_power(nucleus_size, nucleus_size + d, k) for k in range(HIGHEST + 1)]
        return DispersedMoments(
            jnp.stack(shifted, axis=1) + born * jnp.stack(fresh, axis=1), self.factors, self.shares
        )

    def kept(self, share: Any) -> DispersedMoments:
        return DispersedMoments(self.values * share, self.factors, self.shares)


class SizeMap(eqx.Module):
    """Growth that depends on size as ``G(C, T) φ(L)`` with ``φ = (1 + γL)^b``: sizes as functions of the
    growth path.

    ``path_of(L) = ∫ dL/φ`` from zero, ``size_of`` its inverse. With γ = 0 growth does not depend on size.
    """

    size_parameter: Any
    size_exponent: Any

    def path_of(self, size: Any) -> Any:
        """Growth path of a nucleus of size zero that brings it to a size."""
        g, p = self.size_parameter, 1.0 - self.size_exponent
        return ((1.0 + g * size) ** p - 1.0) / (g * p)

    def size_of(self, path: Any) -> Any:
        """Size at the end of a growth path; zero for a negative one."""
        g, p = self.size_parameter, 1.0 - self.size_exponent
        return (jnp.maximum(1.0 + g * p * jnp.maximum(path, 0.0), 0.0) ** (1.0 / p) - 1.0) / g


class Packets(Population):
    """Every packet with its lower and upper end (as growth paths) and its number; vanished ones have number
    zero.
    """

    low: Any
    high: Any
    number: Any
    size_map: SizeMap | None = None

    def sizes(self) -> tuple[Any, Any]:
        """Lower and upper size of every packet, m."""
        return self._size(self.low), self._size(self.high)

    def _size(self, path: Any) -> Any:
        return jnp.maximum(path, 0.0) if self.size_map is None else self.size_map.size_of(path)

    def _shifted(self, path: Any) -> tuple[Any, Any, Any]:
        low, high = jnp.maximum(self.low + path, 0.0), jnp.maximum(self.high + path, 0.0)
        # only what is cut at zero is lost: the ends of a narrow packet may be rounded apart or together
        left = safe_divide(high, self.high - self.low, jnp.where(self.high + path > 0, 1.0, 0.0))
        share = jnp.where(self.low + path >= 0.0, 1.0, jnp.clip(left, 0.0, 1.0))
        return low, high, self.number * share

    def moments(self) -> Any:
        low, high = self.sizes()
        return jnp.stack([jnp.sum(self.number * mean_power(low, high, k)) for k in range(HIGHEST + 1)])

    def cubes_after(self, path: Any) -> Any:
        low, high, number = self._shifted(path)
        return jnp.sum(number * mean_power(self._size(low), self._size(high), 3))

    def grown(self, path: Any, born: Any, nucleus_size: Any, index: Any) -> Packets:
        low, high, number = self._shifted(path)
        start = (
            nucleus_size
            if self.size_map is None
            else self.size_map.path_of(jnp.asarray(nucleus_size, dtype=float))
        )
        slot = jnp.asarray(index)
        low = lax.dynamic_update_index_in_dim(low, jnp.asarray(start, dtype=float), slot, 0)
        high = lax.dynamic_update_index_in_dim(high, start + jnp.maximum(path, 0.0), slot, 0)
        return Packets(low, high, lax.dynamic_update_index_in_dim(number, born, slot, 0), self.size_map)

    def below(self, sizes: Any, order: int = 3) -> Any:
        """Moment of the crystals smaller than given sizes, exact for packets spread evenly."""
        low, high = self.sizes()
        top = jnp.clip(jnp.asarray(sizes, dtype=float)[..., None], low, high)
        share = safe_divide(top - low, high - low, jnp.where(jnp.asarray(sizes)[..., None] >= high, 1.0, 0.0))
        return jnp.sum(self.number * share * mean_power(low, top, order), axis=-1)

    def in_classes(self, edges: Any, order: int = 3) -> Any:
        """Moment of the crystals in each size class; what lies beyond the last boundary joins the last
        class.
        """
        low, high = self.sizes()
        total = jnp.sum(self.number * mean_power(low, high, order))
        return jnp.maximum(
            jnp.diff(jnp.append(self.below(jnp.asarray(edges)[:-1], order).at[0].set(0.0), total)), 0.0
        )

    def mean_size(self, upper: int, lower: int) -> Any:
        """Mean diameter D[p, q]; zero without crystals."""
        low, high = self.sizes()
        p, q = (jnp.sum(self.number * mean_power(low, high, k)) for k in (upper, lower))
        return safe_divide(p, q) ** (1.0 / (upper - lower))

    def kept(self, share: Any) -> Packets:
        return Packets(self.low, self.high, self.number * share, self.size_map)


class Seeds(eqx.Module):
    """Crystals at the start: numbers in the vessel, spread evenly between two sizes each.

    Parameters
    ----------
    low, high: ends of every packet, m, shape (n,). number: crystals in each.
    """

    low: Any
    high: Any
    number: Any

    @classmethod
    def of_mass(cls, mass: Any, edges: Any, mass_fractions: Any, mass_per_cube: Any) -> Seeds:
        """From a mass of seed and its mass fractions in size classes; the mass is met exactly."""
        edges = jnp.asarray(edges, dtype=float)
        low, high = edges[:-1], edges[1:]
        fractions = jnp.asarray(mass_fractions, dtype=float)
        return cls(
            low, high, mass * fractions / jnp.sum(fractions) / (mass_per_cube * mean_power(low, high, 3))
        )

    @classmethod
    def of_density(cls, density: Any, edges: Any, mass: Any, mass_per_cube: Any, order: int = 8) -> Seeds:
        """From a number density function of size, scaled to a mass of seed, which is met exactly."""
        edges = jnp.asarray(edges, dtype=float)
        low, high = edges[:-1], edges[1:]
        number = gauss_legendre(density, low, high, order=order)
        return cls(low, high, number * mass / (mass_per_cube * jnp.sum(number * mean_power(low, high, 3))))

    @classmethod
    def of_one_size(cls, size: Any, mass: Any, mass_per_cube: Any) -> Seeds:
        """All seeds of one size."""
        size = jnp.atleast_1d(jnp.asarray(size, dtype=float))
        return cls(size, size, jnp.atleast_1d(mass / mass_per_cube) / size**3)

    @classmethod
    def none(cls) -> Seeds:
        """An unseeded start."""
        return cls(jnp.zeros(1), jnp.zeros(1), jnp.zeros(1))

    def moments(self) -> Any:
        """Moments 0 to 4."""
        return jnp.stack(
            [jnp.sum(self.number * mean_power(self.low, self.high, k)) for k in range(HIGHEST + 1)]
        )
