"""A vessel in which particles stick together: drum, pan or fluidized bed with binder."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Annotated, Any, NamedTuple

import jax
import jax.numpy as jnp
import numpy as np

from granum.core import equipment
from granum.core.flags import unsolved
from granum.core.kinds import Law, Length, Mass, Time, Volume
from granum.numerics import settle
from granum.numerics.smooth import safe_divide
from granum.streams.equipment.basics import Single
from granum.streams.mixture import Mixture
from granum.streams.stream import Stream, median_of
from granum.streams.turnover import Turnover
from granum.streams.units import Dynamic, Unit

RANK = 6  # products of functions of one size that a kernel is tried as a sum of
_RUNAWAY = (
    "The steady sizes in the agglomerator were not found: the particles join faster than fresh ones come. "
    "Take a smaller holdup or a weaker kernel."
)
EVEN = 0.01  # of a class: how far its boundaries may be off for classes to count as equally wide in volume


class Grid(NamedTuple):
    """Size classes of a mixture as volumes, m³: the middle of each and, if all are equally wide, which
    classes meet in which.
    """

    pivots: Any
    cells: Any


def grid_of(mixture: Mixture) -> Grid:
    """Middle volumes, and the class that two classes make (None where classes are equally wide in volume and
    this is their number).
    """
    volumes = np.pi / 6.0 * mixture.edges**3
    pivots = 0.5 * (volumes[1:] + volumes[:-1])
    n = len(pivots)
    if np.all(np.abs(volumes / volumes[-1] * n - np.arange(n + 1)) < EVEN):
        return Grid((np.arange(n) + 0.5) * volumes[-1] / n, None)
    joined = pivots[:, None] + pivots[None, :]
    return Grid(pivots, np.clip(np.searchsorted(volumes, joined, side="right") - 1, 0, n - 1))


class Meetings(NamedTuple):
    """How often classes meet: the kernel over the volume, a sum of products that gives it, and whether that
    sum is exact.
    """

    kernel: Any
    left: Any
    right: Any
    exact: Any


def meetings_of(kernel: Any) -> Meetings:
    """The kernel by cross approximation; those in use are sums of at most four products of functions of one
    size each.
    """
    rest, scale, left, right = kernel, jnp.max(jnp.abs(kernel)), [], []
    for _ in range(RANK):
        at = jnp.argmax(jnp.abs(jax.lax.stop_gradient(rest)))
        row, column = at // len(kernel), at % len(kernel)
        pivot = rest[row, column]
        some = jnp.abs(pivot) > 1e-13 * scale
        left.append(jnp.where(some, rest[:, column] / jnp.where(some, pivot, 1.0), 0.0))
        right.append(jnp.where(some, rest[row], 0.0))
        rest = rest - left[-1][:, None] * right[-1][None, :]
    return Meetings(kernel, jnp.stack(left, 1), jnp.stack(right, 1), jnp.max(jnp.abs(rest)) <= 1e-12 * scale)


def _joined_evenly(meetings: Meetings, numbers: Any, solid: Any) -> Any:
    """Mass of pairs by the sum of the numbers of their classes, all being equally wide: a convolution for
    each product of the kernel.
    """
    n = len(numbers)

    def by_fourier() -> Any:
        one = jnp.fft.rfft(meetings.left * numbers[:, None], 2 * n, axis=0)
        other = jnp.fft.rfft(meetings.right[:, :, None] * solid[:, None, :], 2 * n, axis=0)
        return jnp.fft.irfft(jnp.sum(one[:, :, None] * other, axis=1), 2 * n, axis=0)[:-1]

    def by_pairs() -> Any:
        frequency = meetings.kernel * numbers[None, :]
        skewed = jnp.pad(frequency, ((0, 0), (0, n))).reshape(-1)[: n * (2 * n - 1)].reshape(n, 2 * n - 1)
        return skewed.T @ solid

    return jax.lax.cond(meetings.exact, by_fourier, by_pairs)


def _born_evenly(meetings: Meetings, numbers: Any, solid: Any) -> Any:
    """Newborn mass by class: two middles join on a boundary, half of the number goes to each side."""
    n = len(numbers)
    joined = _joined_evenly(meetings, numbers, solid)
    c = jnp.arange(n)[:, None]
    stays, moves = joined[:n] * (c + 0.5) / (2.0 * c + 2.0), joined[:n] * (c + 1.5) / (2.0 * c + 2.0)
    born = stays.at[1:].add(moves[:-1])
    return born.at[-1].add(moves[-1] + jnp.sum(joined[n:], axis=0))


def _born(kernel: Any, numbers: Any, solid: Any, density: Any, grid: Grid) -> Any:
    """Newborn mass by class: cell average, which keeps number and volume of what is born in each class."""
    n, x = len(numbers), jnp.asarray(grid.pivots)
    place = jnp.asarray(grid.cells * n + np.arange(n)[None, :]).reshape(-1)
    into = jax.ops.segment_sum((kernel * numbers[:, None]).reshape(-1), place, n * n).reshape(n, n)
    joined, count = into @ solid, 0.5 * into @ numbers
    mean = jnp.clip(safe_divide(joined @ (1.0 / density), count, x), 1e-6 * x, x[-1])  # a count may underflow
    up = mean >= x
    above, below = jnp.append(x[1:], 2.0 * x[-1]), jnp.append(0.0, x[:-1])
    rising = jnp.where(up, (mean - x) / (above - x) * above / mean, 0.0).at[-1].set(0.0)[:, None]
    falling = jnp.where(up, 0.0, (x - mean) / (x - below) * below / mean).at[0].set(0.0)[:, None]
    born = joined * (1.0 - rising - falling)
    return born.at[1:].add((joined * rising)[:-1]).at[:-1].add((joined * falling)[1:])


class AgglomeratorFigures(NamedTuple):
    """Figures of an agglomerator."""

    residence_time: Time
    mass_median_size_feed: Length
    mass_median_size: Length


@equipment(
    "agglomerator",
    source="kumar2008; smoluchowski1917",
    title="Mixed vessel with agglomeration",
    equation=r"\frac{dN_i}{dt} = B_i - D_i + \dot N_{i,in} - \frac{\dot m}{M} N_i",
)
class Agglomerator(Unit, Dynamic):
    """A well-mixed bed of fixed holdup whose particles stick together; what leaves has the composition
    inside.

    Two particles join at the rate of the kernel (m³/s) over the volume of the vessel; solids and further axes
    ride along with the mass. What would outgrow the size classes stays in the last one. Liquid and gas pass.
    A start-up begins with the finest class.
    """

    agglomeration_kernel: Annotated[Any, Law("agglomeration_kernel")]
    holdup_mass: Mass
    volume: Volume

    def _flat(self, solid: Any) -> Any:
        """Size class × (species and further axes)."""
        return jnp.moveaxis(solid, 1, 0).reshape(solid.shape[1], -1)

    def _unflat(self, flat: Any, shape: tuple[int, ...]) -> Any:
        return jnp.moveaxis(flat.reshape((shape[1], shape[0], *shape[2:])), 0, 1)

    def _density(self, mixture: Mixture) -> Any:
        """Of each column of the flat solid, kg/m³."""
        each = mixture.densities("solids", 298.15)
        return jnp.repeat(each, int(np.prod(mixture.solid_shape[2:], dtype=int)))

    def prepare(self, mixture: Mixture, step: Any) -> Any:
        size = (6.0 / np.pi * grid_of(mixture).pivots) ** (1.0 / 3.0)
        return meetings_of(
            self.agglomeration_kernel(jnp.asarray(size)[:, None], jnp.asarray(size)[None, :]) / self.volume
        )

    def _rates(self, flat: Any, meetings: Meetings, mixture: Mixture) -> tuple[Any, Any]:
        """Mass born by class, kg/s, and the frequency with which particles of a class meet others, 1/s."""
        grid, density = grid_of(mixture), self._density(mixture)
        numbers = flat @ (1.0 / density) / jnp.asarray(grid.pivots)
        born = (
            _born_evenly(meetings, numbers, flat)
            if grid.cells is None
            else _born(meetings.kernel, numbers, flat, density, grid)
        )
        return born, meetings.kernel @ numbers

    def inside(self, feed: Stream) -> Any:
        """The solid held in the steady state, kg."""
        meetings, turnover = (
            self.prepare(feed.mixture, 0.0),
            jnp.maximum(feed.solid_flow, 1e-12) / self.holdup_mass,
        )
        fresh = self._flat(feed.solid)

        def refilled(vector: Any) -> tuple[Any, None]:
            flat = vector.reshape(fresh.shape) * self.holdup_mass
            born, lost = self._rates(flat, meetings, feed.mixture)
            return ((fresh + born) / (turnover + lost)[:, None]).reshape(-1) / self.holdup_mass, None

        start = fresh.reshape(-1) / jnp.maximum(feed.solid_flow, 1e-12)
        found = settle(refilled, start, tolerance=1e-13, max_steps=400)
        unsolved(found.converged, type(self).card, reason=_RUNAWAY)
        return self._unflat(found.state.reshape(fresh.shape), feed.solid.shape) * self.holdup_mass

    def outlets(self, inside: Any, feed: Stream) -> Single:
        some = feed.solid_flow > 0
        return Single(
            feed.replace(solid=jnp.where(some, inside * feed.solid_flow / self.holdup_mass, feed.solid))
        )

    def figures(self, inside: Any, outlets: Single, feed: Stream) -> AgglomeratorFigures:
        time = self.holdup_mass / jnp.maximum(feed.solid_flow, 1e-12)
        return AgglomeratorFigures(
            time, *(median_of(s.size_fractions, s.mixture.edges) for s in (feed, outlets.product))
        )

    def initial_holdup(self, mixture: Mixture) -> Any:
        return jnp.zeros(mixture.solid_shape).at[(0,) * len(mixture.solid_shape)].set(1.0) * self.holdup_mass

    def steady_holdup(self, inlets: Mapping[str, Stream]) -> Any:
        return self.inside(inlets["feed"])

    def held_mass(self, state: Any) -> Any:
        return jnp.sum(state)

    def advance(
        self, state: Any, before: Mapping[str, Stream], after: Mapping[str, Stream], step: Any, prepared: Any
    ) -> tuple[Any, Single]:
        """Turnover exact for feeds that are linear over the step, agglomeration of second order (exponential
        Runge-Kutta).
        """
        then, now = before["feed"], after["feed"]
        mixture, held = now.mixture, self._flat(state)
        turnover = Turnover.of(0.5 * (then.solid_flow + now.solid_flow) / self.holdup_mass, step)

        def gain(flat: Any) -> Any:
            born, lost = self._rates(flat, prepared, mixture)
            return born - lost[:, None] * flat

        first = gain(held)
        flowed = turnover.through(held, self._flat(then.solid) + first, self._flat(now.solid) + first)
        flat = flowed + step * turnover.late * (gain(flowed) - first)
        state = self._unflat(flat, state.shape)
        state = state * (self.holdup_mass / jnp.sum(state))
        return state, Single(now.replace(solid=state * (now.solid_flow / self.holdup_mass)))
