"""Crystals of two sizes, length and width, that move with the integrals of two growth rates: no grid.

Where neither growth rate depends on size, crystals that were born together stay together. Bivariate moments
are then shifted exactly by a binomial in each direction, and the crystals lie on straight segments between
those born first and last, from which masses by size and aspect ratio follow exactly.
"""

from __future__ import annotations

from abc import abstractmethod
from math import comb
from typing import Any, ClassVar

import equinox as eqx
import jax.numpy as jnp
import numpy as np
from jax import lax

from granum.crystallization.population.packets import Seeds
from granum.numerics.smooth import safe_divide

HIGHEST = 3  # order of the moments carried, in each direction: aspect ratios by mass need the cube of length
OLDEST = 200.0  # residence times beyond which no crystal is looked for
ORDERS = np.arange(HIGHEST + 1)
CHOICES = np.array([[comb(j, a) for a in ORDERS] for j in ORDERS], dtype=float)
POWERS = np.maximum(ORDERS[:, None] - ORDERS, 0)
HALVINGS, NEWTON_STEPS = 40, 3


def width_over_diameter(aspect_ratio: Any, volume_shape_factor: Any) -> Any:
    """Width of a prism over the diameter of the sphere of its volume."""
    return (np.pi / (6.0 * volume_shape_factor * aspect_ratio)) ** (1.0 / 3.0)


def products(length: Any, width: Any) -> Any:
    """``L**j W**k`` for the orders 0 to 3 of both, in two last axes."""
    return (
        jnp.asarray(length)[..., None, None] ** ORDERS[:, None]
        * jnp.asarray(width)[..., None, None] ** ORDERS
    )


def shifted(moments: Any, longer: Any, wider: Any) -> Any:
    """Bivariate moments after all crystals grew by the same length and width."""

    def binomials(path: Any) -> Any:
        return CHOICES * jnp.asarray(path) ** POWERS

    return binomials(longer) @ moments @ binomials(wider).T


def volume_after(moments: Any, longer: Any, wider: Any) -> Any:
    """The moment ``L W²`` alone of ``shifted``."""
    lengths = moments[1] + longer * moments[0]
    return lengths[2] + wider * (2.0 * lengths[1] + wider * lengths[0])


class Lines(eqx.Module):
    """Crystals along straight lines in length and width, by number.

    Parameters
    ----------
    length, width: where each line begins, m. longer, wider: to where its parameter is one. number: crystals.
    """

    length: Any
    width: Any
    longer: Any
    wider: Any
    number: Any

    end: ClassVar[float]
    """Parameter at which a line ends."""

    @abstractmethod
    def nodes(self) -> tuple[np.ndarray, np.ndarray]:
        """Parameters and weights that integrate polynomials up to the seventh degree over the crystals."""

    @abstractmethod
    def beyond(self, parameter: Any) -> Any:
        """Integral of length times width squared over the crystals beyond a parameter of each line, per
        crystal; lines in the first axis.
        """

    def at(self, parameter: Any) -> tuple[Any, Any]:
        """Length and width at a parameter, lines in the first axis."""
        lines = (slice(None),) + (None,) * (jnp.ndim(parameter) - 1)
        return (
            self.length[lines] + parameter * self.longer[lines],
            self.width[lines] + parameter * self.wider[lines],
        )

    def moments(self) -> Any:
        """Bivariate moments of all crystals, length in the first axis."""
        nodes, weights = self.nodes()
        there = products(*self.at(jnp.asarray(nodes)[None, :]))
        return jnp.einsum("n,p,npjk->jk", self.number, weights, there)

    def in_classes(self, edges: Any, aspects: Any, volume_shape_factor: Any) -> Any:
        """Integral of length times width squared in classes of diameter of equal volume and of aspect ratio;
        what lies beyond joins the outer classes.
        """
        sizes, ratios = jnp.asarray(edges)[1:-1], jnp.asarray(aspects)[1:-1]
        start = self._larger(np.pi * sizes**3 / (6.0 * volume_shape_factor))  # lines × sizes
        slope = self.longer[:, None] - ratios * self.wider[:, None]
        behind = ratios * self.width[:, None] - self.length[:, None]
        there = jnp.clip(safe_divide(behind, slope, 0.0), 0.0, self.end)
        slender = behind <= 0.0  # the whole of a line that neither gains nor loses slenderness
        first = jnp.where(slope > 0.0, there, 0.0)
        last = jnp.where(
            slope < 0.0, there, jnp.where((slope > 0.0) | slender, self.end, 0.0)
        )  # lines × ratios
        lines = jnp.zeros_like(start[:, :1])
        start = jnp.concatenate([lines, start], axis=1)[:, :, None]
        first = jnp.concatenate([lines, first], axis=1)[:, None, :]
        last = jnp.concatenate([lines + self.end, last], axis=1)[:, None, :]
        begin = jnp.minimum(jnp.maximum(start, first), last)
        above = jnp.sum(self.number[:, None, None] * (self.beyond(begin) - self.beyond(last)), axis=0)
        above = jnp.pad(above, ((0, 1), (0, 1)))
        inside = above[:-1, :-1] - above[1:, :-1] - above[:-1, 1:] + above[1:, 1:]
        return jnp.maximum(inside, 0.0)

    def _larger(self, volumes: Any) -> Any:
        """Parameter from which each line is larger than given ``L W²``."""
        low = jnp.zeros((self.length.shape[0], volumes.shape[0]))
        high = low + self.end

        def excess(t: Any) -> Any:
            length, width = self.at(t)
            return length * width**2 - volumes

        def halve(_i: Any, ends: tuple[Any, Any]) -> tuple[Any, Any]:
            low, high = ends
            middle = 0.5 * (low + high)
            small = excess(middle) < 0.0
            return jnp.where(small, middle, low), jnp.where(small, high, middle)

        low, high = lax.stop_gradient(lax.fori_loop(0, HALVINGS, halve, (low, high)))
        t = 0.5 * (low + high)
        for _step in range(NEWTON_STEPS):
            length, width = self.at(t)
            slope = self.longer[:, None] * width**2 + 2.0 * length * width * self.wider[:, None]
            t = jnp.clip(t - safe_divide(excess(t), slope, 0.0), 0.0, self.end)
        # a line of one point is below or above as a whole
        still = (self.longer == 0.0) & (self.wider == 0.0)
        return jnp.where(still[:, None], jnp.where(excess(0.0 * t) < 0.0, self.end, 0.0), t)


class Segments(Lines):
    """Crystals spread evenly from the beginning of a line to where its parameter is one: born evenly in time,
    or a class of seeds of one aspect ratio.
    """

    end: ClassVar[float] = 1.0

    def nodes(self) -> tuple[np.ndarray, np.ndarray]:
        nodes, weights = np.polynomial.legendre.leggauss(4)
        return 0.5 * (nodes + 1.0), 0.5 * weights

    def beyond(self, parameter: Any) -> Any:
        rest = 1.0 - parameter
        nodes, weights = np.polynomial.legendre.leggauss(2)
        values = []
        for node in nodes:
            length, width = self.at(parameter + 0.5 * (node + 1.0) * rest)
            values.append(length * width**2)
        return rest * sum(0.5 * w * v for w, v in zip(weights, values, strict=True))


class Aged(Lines):
    """Crystals whose ages are distributed exponentially, as in a mixed vessel: the parameter is the age over
    the residence time.
    """

    end: ClassVar[float] = OLDEST

    def nodes(self) -> tuple[np.ndarray, np.ndarray]:
        return np.polynomial.laguerre.laggauss(4)

    def beyond(self, parameter: Any) -> Any:
        nodes, weights = np.polynomial.laguerre.laggauss(2)
        values = []
        for node in nodes:
            length, width = self.at(parameter + node)
            values.append(length * width**2)
        return jnp.exp(-parameter) * sum(w * v for w, v in zip(weights, values, strict=True))


def prisms(seeds: Seeds, aspect_ratio: Any, volume_shape_factor: Any) -> Segments:
    """Crystals of given aspect ratios whose sizes are diameters of the sphere of equal volume."""
    width = width_over_diameter(aspect_ratio, volume_shape_factor)
    span = seeds.high - seeds.low
    return Segments(
        width * aspect_ratio * seeds.low,
        width * seeds.low,
        width * aspect_ratio * span,
        width * span,
        seeds.number,
    )
