"""Crystals on a fixed grid of sizes: for batches in which they agglomerate or break.

Growth is a flux-limited finite volume scheme; agglomeration uses the cell average technique of J. Kumar and others, which
keeps number and volume of what is born; breakage is linear with a matrix that keeps both too. The solute follows from the
grid's own third moment, so that it is conserved to rounding.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import equinox as eqx
import jax
import jax.numpy as jnp
from jax import lax

from granum.core.errors import InputError
from granum.core.i18n import _
from granum.crystallization.population.compiled import compiled
from granum.crystallization.population.lagrangian import Model
from granum.crystallization.population.operations import Operation
from granum.crystallization.population.packets import mean_power
from granum.numerics.limiters import koren
from granum.numerics.smooth import safe_divide


class GridCourse(NamedTuple):
    """A batch on a grid, at the times of its steps; moments 0 to 4 in the vessel, final numbers by class."""

    time: Any
    temperature: Any
    solute_per_solvent: Any
    solubility_per_solvent: Any
    crystals: Any
    moments: Any
    numbers: Any
    courant: Any


class Grid(eqx.Module):
    """Size classes with their representative cubes (the mean of an evenly filled class)."""

    edges: Any

    @property
    def cubes(self) -> Any:
        """Mean cube of the size in each class."""
        return mean_power(self.edges[:-1], self.edges[1:], 3)

    @property
    def sizes(self) -> Any:
        """Size of the mean cube."""
        return self.cubes ** (1.0 / 3.0)


def births_by_pairs(numbers: Any, kernel: Any, grid: Grid) -> Any:
    """Rate of change of the numbers by agglomeration (kernel per volume already), number and volume of the newborn kept."""
    x, edges = grid.cubes, grid.edges**3
    n = x.shape[0]
    j, k = jnp.triu_indices(n)
    rate = kernel[j, k] * numbers[j] * numbers[k] * jnp.where(j == k, 0.5, 1.0)
    volume = x[j] + x[k]
    # What would outgrow the grid stays in its last class with its volume.
    beyond = volume > x[-1]
    rate_kept, volume = jnp.where(beyond, rate * volume / x[-1], rate), jnp.minimum(volume, x[-1])
    cell = jnp.clip(jnp.searchsorted(edges, volume, side="right") - 1, 0, n - 1)
    born = jax.ops.segment_sum(rate_kept, cell, n)
    held = jax.ops.segment_sum(rate_kept * volume, cell, n)
    mean = safe_divide(held, born, x)
    return _shared_out(born, mean, x) - numbers * (kernel @ numbers)


def _shared_out(born: Any, mean: Any, x: Any) -> Any:
    """Newborn of each cell given to its pivot and the neighbor on the side of their mean, keeping number and volume."""
    up = mean >= x
    right = jnp.append(x[1:], 2.0 * x[-1])
    left = jnp.concatenate([jnp.zeros(1), x[:-1]])
    share_up = jnp.where(up, (mean - x) / (right - x), 0.0)
    share_down = jnp.where(up, 0.0, (x - mean) / (x - left))
    # Below the first pivot and above the last there is no neighbor: volume is kept and number gives way.
    share_up = share_up.at[-1].set(0.0)
    out = born * (1.0 - share_up - share_down)
    out = out.at[1:].add((born * share_up)[:-1])
    return out.at[:-1].add((born * share_down)[1:])


def breakage_matrix(breakage: Any, grid: Grid) -> Any:
    """Matrix of the linear rate of change of the numbers by breakage: fragments on pivots, number and volume kept."""
    x, edges = grid.cubes, grid.edges**3
    rate = breakage(grid.sizes)

    def column(parent: Any) -> Any:
        count, share = breakage.daughters(edges[:-1], edges[1:], parent)
        mean = jnp.where(count > 0, safe_divide(share * parent, count, x), x)
        return _shared_out(count, mean, x)

    fragments = jax.vmap(column, out_axes=1)(x)
    # Fragments below the grid keep their volume in the first class: scale so that every parent's volume is met exactly.
    fragments = fragments * (x / (x @ fragments))[None, :]
    return fragments * rate[None, :] - jnp.diag(rate)


def growth_rate_of_change(numbers: Any, rate: Any, births: Any, edges: Any) -> Any:
    """Rate of change of the numbers by growth at one rate with nuclei entering the first class (Koren's limiter)."""
    width = jnp.diff(edges)
    density = numbers / width
    slopes = jnp.diff(density) * 2.0 / (width[1:] + width[:-1])
    ahead, behind = jnp.append(slopes, 0.0), jnp.concatenate([slopes[:1], slopes])
    face = density + 0.5 * width * koren(behind, ahead)
    flux = rate * jnp.maximum(face, 0.0)
    # Growth beyond the grid is kept in the last class; dissolution is left to the packet engine.
    flux = jnp.concatenate([jnp.asarray(births, dtype=float)[None], flux[:-1], jnp.zeros(1)])
    return -jnp.diff(flux)


@compiled
def march_grid(model: Model, operation: Operation, edges: Any, numbers: Any, solute: Any, solvent: Any, times: Any,
               agglomeration: Any = None, breakage: Any = None) -> GridCourse:  # fmt: skip
    """Follow a batch on a grid of sizes (SSP Runge–Kutta, second order); see ``march`` for the arguments.

    ``agglomeration`` is a kernel in m³/s, ``breakage`` a law; either may be None.
    """
    grid = Grid(jnp.asarray(edges, dtype=float))
    times = jnp.asarray(times, dtype=float)
    scale, x_c = model.crystal.mass_per_cube, model.crystal.solute_fraction
    sizes = grid.sizes
    kernel = None if agglomeration is None else agglomeration(sizes[:, None], sizes[None, :])
    matrix = None if breakage is None else breakage_matrix(breakage, grid)
    powers = jnp.stack([mean_power(grid.edges[:-1], grid.edges[1:], k) for k in range(5)])

    def rates(numbers: Any, contents: Any) -> tuple[Any, Any, Any, Any]:
        crystals = scale * jnp.sum(numbers * grid.cubes)
        ratio, saturated = model.ratio(contents, crystals), model.saturated(contents)
        G = model.growth(ratio, saturated, contents.temperature)
        change = growth_rate_of_change(numbers, G, model.births(ratio, saturated, contents, crystals), grid.edges)
        if kernel is not None:
            liquor = contents.solute + contents.solvent - crystals
            volume = model.volume(liquor, contents.solvent - (1.0 - x_c) * crystals, crystals, model.crystal)
            change = change + births_by_pairs(numbers, kernel / volume, grid)
        if matrix is not None:
            change = change + matrix @ numbers
        return change, ratio, saturated, G

    def advance(carry: tuple[Any, Any], given: tuple[Any, Any]) -> tuple[tuple[Any, Any], tuple[Any, ...]]:
        numbers, contents = carry
        start, end = given
        span = end - start
        before = scale * jnp.sum(numbers * grid.cubes)
        first, _ratio, _saturated, G = rates(numbers, contents)
        trial = numbers + span * first
        there = operation.step(contents, start, end, before, scale * jnp.sum(trial * grid.cubes))
        second, *_rest = rates(trial, there)
        new = numbers + 0.5 * span * (first + second)
        crystals = scale * jnp.sum(new * grid.cubes)
        contents = jax.tree.map(lambda v: jnp.asarray(v, dtype=float), operation.step(contents, start, end, before, crystals))
        courant = G * span / jnp.min(jnp.diff(grid.edges))
        out = (contents.temperature, model.ratio(contents, crystals), model.saturated(contents), crystals, powers @ new, courant)
        return (new, contents), out

    numbers = jnp.asarray(numbers, dtype=float)
    mass = scale * jnp.sum(numbers * grid.cubes)
    contents = jax.tree.map(lambda v: jnp.asarray(v, dtype=float), operation.start(solute + x_c * mass, solvent + (1.0 - x_c) * mass))
    begin = (contents.temperature, model.ratio(contents, mass), model.saturated(contents), mass, powers @ numbers)
    (last, _contents), rows = lax.scan(advance, (numbers, contents), (times[:-1], times[1:]))
    joined = [jnp.concatenate([jnp.asarray(a)[None], b]) for a, b in zip(begin, rows[:-1], strict=True)]
    temperature, ratio, saturated, crystals, all_moments = joined
    return GridCourse(times, temperature, ratio, saturated, crystals, all_moments, last, rows[-1])


def check_grid(edges: Any, numbers: Any) -> None:
    """Raise when seeds do not fit on the grid."""
    if len(edges) - 1 != len(numbers):
        raise InputError(_("{count} classes need {edges} boundaries; {given} were given.").format(
            count=len(numbers), edges=len(numbers) + 1, given=len(edges)))  # fmt: skip
