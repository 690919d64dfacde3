"""Crystals of a flow vessel in time: equally wide cells that move with the growth path, so that growth
spreads nothing.

Every cell carries its moments 0 to 4, which growth shifts exactly. What enters or is born over a step joins
at the size and with the survival that its age gives it, so that a vessel at rest holds the crystals of the
steady model whatever the step.
"""

from __future__ import annotations

from math import comb, factorial
from typing import Any

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np

from granum.crystallization.population.packets import HIGHEST, Population
from granum.numerics.smooth import safe_divide

CELLS = 256
ORDERS = range(HIGHEST + 1)
_POINTS, _WEIGHTS = (0.5 * v for v in np.polynomial.legendre.leggauss(6))
AGES, SHARES = _POINTS + 0.5, _WEIGHTS  # of what entered over a step: age over the step, share of the numbers


class Moving(Population):
    """Crystals of a vessel that is turned over.

    Parameters
    ----------
    values: moments 0 to 4 of each cell, of what stays over the step. The first cell reaches from zero to
        ``offset``, the last takes all larger ones.
    numbers, sizes: crystals that enter over the step, and their size on entering. turnovers: volumes of the
        vessel that leave over the step.
    """

    values: Any
    offset: Any
    width: Any
    numbers: Any
    sizes: Any
    turnovers: Any

    @classmethod
    def empty(cls, largest: Any) -> Moving:
        """No crystals, and cells up to a largest size."""
        width = jnp.asarray(largest, dtype=float) / CELLS
        return cls(jnp.zeros((CELLS, HIGHEST + 1)), width, width, jnp.zeros(1), jnp.zeros(1), jnp.zeros(()))

    @classmethod
    def standing(cls, largest: Any, rates: Any, sizes: Any, length: Any, time: Any) -> Moving:
        """What a vessel at rest holds: sources (1/s) at their sizes, growth in a residence time, residence
        time.
        """
        blank = cls.empty(largest)
        levels = blank.width * jnp.arange(CELLS)
        t = jnp.maximum(levels[:, None] - sizes, 0.0) / length
        tails = [jnp.exp(-t) * factorial(p) * sum(t**j / factorial(j) for j in range(p + 1)) for p in ORDERS]
        above = jnp.stack(
            [
                sum(
                    comb(k, p) * jnp.sum(tails[p] * rates * sizes ** (k - p), axis=1) * length**p
                    for p in range(k + 1)
                )
                for k in ORDERS
            ],
            axis=1,
        )
        return eqx.tree_at(lambda m: m.values, blank, time * (above - jnp.pad(above[1:], ((0, 1), (0, 0)))))

    @property
    def survival(self) -> Any:
        """Mean share of what enters over a step that is still there at its end."""
        return jnp.sum(SHARES * jnp.exp(-self.turnovers * AGES))

    def turned_over(self, turnovers: Any, numbers: Any, sizes: Any) -> Moving:
        """The same vessel before a step over which so many volumes leave and so many crystals enter."""
        return Moving(self.values * jnp.exp(-turnovers), self.offset, self.width, numbers, sizes, turnovers)

    def moments(self) -> Any:
        return jnp.sum(self.values, axis=0)

    def cubes_after(self, path: Any) -> Any:
        m, d = self.moments(), path
        young = SHARES * jnp.exp(-self.turnovers * AGES)
        entered = [jnp.sum(self.numbers * self.sizes**k) * jnp.sum(young * AGES ** (3 - k)) for k in range(4)]
        return sum(comb(3, k) * d ** (3 - k) * (m[k] + entered[k]) for k in range(4))

    def grown(self, path: Any, born: Any, nucleus_size: Any, index: Any) -> Moving:
        """``born`` are those nuclei of the step that survive it."""
        shifted = jnp.stack(
            [sum(comb(k, j) * path ** (k - j) * self.values[:, j] for j in range(k + 1)) for k in ORDERS],
            axis=1,
        )
        offset = self.offset + path
        cells = jnp.floor(jax.lax.stop_gradient(offset / self.width))
        offset = offset - cells * self.width
        place = jnp.minimum(jnp.arange(CELLS) + cells.astype(int), CELLS - 1)
        moved = jax.ops.segment_sum(shifted, place, CELLS)
        numbers = (
            jnp.append(self.numbers, safe_divide(born, self.survival))[:, None]
            * SHARES
            * jnp.exp(-self.turnovers * AGES)
        )
        size = jnp.append(self.sizes, nucleus_size)[:, None] + path * AGES
        into = jnp.clip(jnp.ceil(jax.lax.stop_gradient((size - offset) / self.width)), 0, CELLS - 1).astype(
            int
        )
        fresh = jnp.stack([numbers * size**k for k in ORDERS], axis=-1)
        moved = moved + jax.ops.segment_sum(fresh.reshape(-1, HIGHEST + 1), into.reshape(-1), CELLS)
        return Moving(
            moved,
            offset,
            self.width,
            jnp.zeros_like(self.numbers),
            self.sizes,
            jnp.zeros_like(self.turnovers),
        )

    def kept(self, share: Any) -> Moving:
        return eqx.tree_at(lambda m: m.values, self, self.values * share)

    def cubes_in(self, edges: Any) -> Any:
        """Third moment in size classes, the first and the last open; inside a cell it is spread on a straight
        line that keeps its mean size.
        """
        low = jnp.maximum(self.offset + self.width * (jnp.arange(CELLS) - 1.0), 0.0)
        high = self.offset + self.width * jnp.arange(CELLS)
        half = 0.5 * jnp.maximum(high - low, 1e-12)
        mean = safe_divide(self.values[:, 4], self.values[:, 3], 0.5 * (low + high))
        slope = jnp.clip(3.0 * (mean - 0.5 * (low + high)) / half, -1.0, 1.0)
        at = jnp.clip((jnp.asarray(edges)[1:-1, None] - 0.5 * (low + high)) / half, -1.0, 1.0)
        below = (0.5 * (1.0 + at) + 0.25 * slope * (at**2 - 1.0)) @ self.values[:, 3]
        return jnp.diff(jnp.concatenate([jnp.zeros(1), below, jnp.sum(self.values[:, 3])[None]]))
