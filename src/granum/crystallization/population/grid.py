"""Crystals in size classes that move with the growth path: for batches in which they agglomerate or break.

Every class carries its moments 0 to 4. Growth shifts classes and moments exactly, as it does packets, so that
the grid adds no numerical diffusion; only agglomeration and breakage are discretized, by the cell average
technique of J. Kumar and others, which keeps number and volume of what is born. Crystals that are born open
new classes at the nucleus size.
"""

from __future__ import annotations

from math import comb
from typing import Any, NamedTuple

import equinox as eqx
import jax
import jax.numpy as jnp

from granum.core.errors import ApplicabilityError, InputError
from granum.core.i18n import _
from granum.crystallization.population.packets import HIGHEST, Packets, Population, Seeds, mean_power
from granum.numerics.smooth import safe_divide

SMALLEST = 1e-9  # m, size that stands for an empty class in kernels
ORDERS = range(HIGHEST + 1)


class Classes(Population):
    """Adjacent size classes, each with the moments 0 to 4 of its crystals; the first ``slots`` are for
    nuclei, youngest first.
    """

    low: Any
    high: Any
    values: Any
    slots: int = eqx.field(static=True)
    steps_per_slot: int = eqx.field(static=True)

    @property
    def cubes(self) -> Any:
        """Mean cube of the crystals of each class; of an evenly filled class where there are none."""
        mean = safe_divide(self.values[:, 3], self.values[:, 0], mean_power(self.low, self.high, 3))
        return jnp.clip(mean, self.low**3, self.high**3)

    def moments(self) -> Any:
        return jnp.sum(self.values, axis=0)

    def cubes_after(self, path: Any) -> Any:
        m, d = self.moments(), path
        return m[3] + d * (3.0 * m[2] + d * (3.0 * m[1] + d * m[0]))

    def grown(self, path: Any, born: Any, nucleus_size: Any, index: Any) -> Classes:
        """As for packets; ``index`` counts the steps after the classes of the seeds, as it does there."""
        step = jnp.asarray(index) - (self.low.shape[0] - self.slots)
        slot = self.slots - 1 - step // self.steps_per_slot
        position = jnp.arange(self.low.shape[0])
        low = jnp.where(position <= slot, nucleus_size, self.low + path)
        high = jnp.where(position < slot, nucleus_size, self.high + path)
        shifted = jnp.stack(
            [sum(comb(k, j) * path ** (k - j) * self.values[:, j] for j in range(k + 1)) for k in ORDERS],
            axis=1,
        )
        fresh = jnp.stack(
            [jnp.asarray(mean_power(nucleus_size, nucleus_size + path, k), dtype=float) for k in ORDERS]
        )
        return Classes(low, high, shifted.at[slot].add(born * fresh), self.slots, self.steps_per_slot)

    def kept(self, share: Any) -> Classes:
        return Classes(self.low, self.high, self.values * share, self.slots, self.steps_per_slot)

    def packets(self) -> Packets:
        """Evenly filled packets with the numbers of the classes."""
        return Packets(self.low, self.high, self.values[:, 0])


def classes_of(seeds: Seeds, steps: int, nuclei_classes: int) -> Classes:
    """Classes from seeds that stand side by side, with room for the nuclei of a number of steps."""
    slots = min(nuclei_classes, steps)
    low, high = jnp.asarray(seeds.low, dtype=float), jnp.asarray(seeds.high, dtype=float)
    values = jnp.stack([seeds.number * mean_power(low, high, k) for k in ORDERS], axis=1)
    none = jnp.zeros(slots)
    return Classes(
        jnp.append(none, low),
        jnp.append(none, high),
        jnp.concatenate([jnp.zeros((slots, HIGHEST + 1)), values]),
        slots,
        -(-steps // slots),
    )


class Collisions(eqx.Module):
    """What crystals do to each other and to the impeller.

    Parameters
    ----------
    agglomeration: kernel, m³/s. breakage: law. Either may be None.
    nuclei_classes: most classes that the nuclei are sorted into.
    """

    agglomeration: Any = None
    breakage: Any = None
    nuclei_classes: int = eqx.field(static=True, default=80)

    def rates(self, classes: Classes, volume: Any, span: Any) -> tuple[Any, Any, Any]:
        """Births by class (1/s, at its mean cube), frequency (1/s) with which crystals of a class disappear,
        and its unlimited value.

        A class that would lose more than it holds in the span collides less often, with the same for its
        partners: nothing becomes negative and volume is kept whatever the step.
        """
        x, number = classes.cubes, classes.values[:, 0]
        size = jnp.maximum(x, SMALLEST**3) ** (1.0 / 3.0)
        none = jnp.zeros((x.shape[0],) * 2)
        kernel = (
            none if self.agglomeration is None else self.agglomeration(size[:, None], size[None, :]) / volume
        )
        rate = jnp.zeros_like(x) if self.breakage is None else self.breakage(size)
        free = kernel @ number + rate
        limit = jnp.minimum(1.0, safe_divide(1.0, free * span, 1.0))
        born, lost, active = jnp.zeros_like(x), limit * rate, limit * number
        if self.agglomeration is not None:
            born = born + births_by_pairs(active, kernel, x, classes.low, classes.high)
            lost = lost + limit * (kernel @ active)
        if self.breakage is not None:
            born = born + fragments(self.breakage, x, classes.low, classes.high) @ (rate * active)
        return born, lost, free

    def act(self, classes: Classes, volume: Any, span: Any) -> tuple[Classes, Any]:
        """The classes after a span of time (Heun's step), and the share of the crystals that would collide in
        it.
        """
        number = classes.values[:, 0]

        def euler(values: Any) -> tuple[Any, Any]:
            here = Classes(classes.low, classes.high, values, classes.slots, classes.steps_per_slot)
            born, lost, free = self.rates(here, volume, span)
            powers = jnp.stack([jnp.maximum(here.cubes, SMALLEST**3) ** (k / 3.0) for k in ORDERS], axis=1)
            return values * (1.0 - span * lost)[:, None] + span * born[:, None] * powers, free

        first, free = euler(classes.values)
        second, _free = euler(first)
        values = 0.5 * (classes.values + second)
        busy = span * safe_divide(jnp.sum(free * number), jnp.sum(number))
        return Classes(classes.low, classes.high, values, classes.slots, classes.steps_per_slot), busy


def births_by_pairs(numbers: Any, kernel: Any, x: Any, low: Any, high: Any) -> Any:
    """Births by class (1/s) by agglomeration (kernel per volume already), number and volume of the newborn
    kept; ``x`` mean cubes.
    """
    j, k = jnp.triu_indices(x.shape[0])
    rate = kernel[j, k] * numbers[j] * numbers[k] * jnp.where(j == k, 0.5, 1.0)
    volume = x[j] + x[k]
    # What would outgrow the grid stays in its last class with its volume.
    beyond = volume > x[-1]
    rate_kept, volume = jnp.where(beyond, rate * volume / x[-1], rate), jnp.minimum(volume, x[-1])
    born, held = sorted_into(rate_kept, volume, low)
    return _shared_out(born, safe_divide(held, born, x), x, high > low)


def sorted_into(numbers: Any, cubes: Any, low: Any) -> tuple[Any, Any]:
    """Numbers, and their cubes in all, by the class whose lower end is the next below; the last is open."""
    n = low.shape[0]
    cell = jnp.clip(jnp.searchsorted(low**3, cubes, side="right") - 1, 0, n - 1)
    return jax.ops.segment_sum(numbers, cell, n), jax.ops.segment_sum(numbers * cubes, cell, n)


class Events(NamedTuple):
    """Newborn per second at the lower end of each class: by agglomeration, its slopes with the number and the
    cubes of each class (columns; less what is lost more), and for these by breakage; and how often a crystal
    of a class disappears, 1/s.
    """

    joined: Any
    slopes: tuple[Any, Any]
    broken: tuple[Any, Any]
    lost: Any


def events(collisions: Collisions, numbers: Any, cubes: Any, low: Any, high: Any, volume: Any) -> Events:
    """What becomes of the crystals in classes from nothing to open, near a population.

    The crystals of a class stand at its two ends, as many at each as number and volume want, and so do the
    newborn at those of theirs. Number gives way to volume beyond the lower end of the last class.
    """
    n, p = low.shape[0], low**3
    q = jnp.append(p[1:], 27.0 * p[-1])
    size = jnp.append(jnp.append(0.5 * low[1], jnp.sqrt(low[1:-1] * low[2:])), 1.5 * low[-1])
    joined, lost, none = jnp.zeros(n), jnp.zeros(n), (jnp.zeros((n, n)), jnp.zeros((n, n)))
    slopes, broken = none, none
    if collisions.agglomeration is not None:
        near = safe_divide(numbers * q - cubes, q - p, numbers)
        far = safe_divide(cubes - numbers * p, q - p, 0.0)
        kernel = collisions.agglomeration(size[:, None], size[None, :]) / volume
        joins = _joins(kernel, near, far, p, q)
        joined = 0.5 * jnp.sum(joins * jnp.stack([near, far])[:, None, :], axis=(0, 2))
        lost = kernel @ numbers
        # a class that meets more loses it at its ends too: of the last, which is open, its volume counts
        more = near[:, None] * kernel
        more = more.at[1:].add((far[:, None] * kernel)[:-1]).at[-1].add(q[-1] / p[-1] * far[-1] * kernel[-1])
        by_number = safe_divide(joins[0] * q - joins[1] * p, q - p, joins[0])
        slopes = by_number - more, safe_divide(joins[1] - joins[0], q - p, 0.0)
    if collisions.breakage is not None:
        rate = collisions.breakage(size)

        def fragments_of(parent: Any) -> Any:
            count, share = collisions.breakage.daughters(p, high**3, jnp.maximum(parent, SMALLEST**3))
            held = share * parent
            up = safe_divide(held - count * p, q - p, 0.0).at[-1].set(0.0)
            return (count - up).at[-1].set(held[-1] / p[-1]).at[1:].add(up[:-1])

        first, second = (jax.vmap(fragments_of, out_axes=1)(end) for end in (p, q))
        by_cube = safe_divide(rate, q - p, 0.0) * (second - first)
        broken, lost = (rate * first - by_cube * p, by_cube), lost + rate
    return Events(joined, slopes, broken, lost)


def _joins(kernel: Any, near: Any, far: Any, p: Any, q: Any) -> Any:
    """Newborn by class (rows) of those that meet one crystal at the near or the far end of a class (columns),
    1/s.
    """
    n = p.shape[0]
    j, k = jnp.triu_indices(n)
    rate = kernel[j, k] * jnp.where(j == k, 0.5, 1.0)
    found = jnp.zeros(2 * n * n)
    for x, (a, u) in enumerate(((near, p), (far, q))):
        for y, (b, v) in enumerate(((near, p), (far, q))):
            made = u[j] + v[k]
            often = rate * jnp.maximum(made / p[-1], 1.0)
            made = jnp.minimum(made, p[-1])
            cell = jnp.clip(jnp.searchsorted(p, made, side="right") - 1, 0, n - 2)
            up = safe_divide(made - p[cell], p[cell + 1] - p[cell], 0.0)
            for end, column, partner in ((x, j, b[k]), (y, k, a[j])):
                place = (end * n + cell) * n + column
                found = found.at[place].add(often * partner * (1.0 - up))
                found = found.at[place + n].add(often * partner * up)
    return found.reshape(2, n, n)


def _shared_out(born: Any, mean: Any, x: Any, live: Any) -> Any:
    """Newborn of each cell given to its pivot and the neighbor on the side of their mean, keeping number and
    volume.
    """
    up = mean >= x
    right = jnp.append(x[1:], 2.0 * x[-1])
    left = jnp.concatenate([jnp.zeros(1), x[:-1]])
    below = jnp.concatenate([jnp.zeros(1, bool), live[:-1]])
    # Below the first pivot and above the last there is no neighbor: volume is kept and number gives way.
    share_up = jnp.where(up, safe_divide(mean - x, right - x), 0.0).at[-1].set(0.0)
    share_down = jnp.where(~up & below, safe_divide(x - mean, x - left), 0.0)
    alone = ~up & ~below
    born = jnp.where(alone, born * safe_divide(mean, x, 1.0), born)
    out = born * (1.0 - share_up - share_down)
    out = out.at[1:].add((born * share_up)[:-1])
    return out.at[:-1].add((born * share_down)[1:])


def fragments(breakage: Any, x: Any, low: Any, high: Any) -> Any:
    """Fragments by class (rows) of one breaking crystal of each class (columns), number and volume kept;
    ``x`` mean cubes.
    """

    def column(parent: Any) -> Any:
        count, share = breakage.daughters(low**3, high**3, jnp.maximum(parent, SMALLEST**3))
        return _shared_out(count, safe_divide(share * parent, count, x), x, high > low)

    found = jax.vmap(column, out_axes=1)(x)
    # Fragments below the grid keep their volume in the first classes: scale so that every parent's volume is
    # met exactly.
    return found * safe_divide(x, x @ found, 1.0)[None, :]


def side_by_side(seeds: Seeds, edges: Any) -> Seeds:
    """Seeds shared out over adjacent classes between given edges, each packet evenly over its own width; the
    edges must hold those of all packets.
    """
    edges = jnp.sort(jnp.asarray(edges, dtype=float))
    low, high = edges[:-1], edges[1:]
    shared = jnp.minimum(high, seeds.high[:, None]) - jnp.maximum(low, seeds.low[:, None])
    part = safe_divide(jnp.maximum(shared, 0.0), (seeds.high - seeds.low)[:, None], 0.0)
    return Seeds(low, high, seeds.number @ part)


def check_only_growing(model: Any) -> None:
    """Raise where crystals do more than grow, which the classes do not follow."""
    if model.dissolution is not None or model.size_map is not None:
        raise ApplicabilityError(
            _(
                "Crystals that agglomerate or break are followed only while they grow, at a rate that "
                "does not depend on size."
            )
        )


def check_classes(model: Any, seeds: Seeds) -> None:
    """Raise where the classes could not follow a batch."""
    check_only_growing(model)
    low, high = jax.device_get((seeds.low, seeds.high))
    if len(low) > 1 and abs(high[:-1] - low[1:]).max() > 1e-9 * high[-1]:
        raise InputError(
            _("The size classes of the seeds must stand side by side where crystals agglomerate or break.")
        )
