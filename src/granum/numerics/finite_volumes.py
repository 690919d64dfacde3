"""Conservative transport in one dimension: limited reconstruction, SSP-RK3, fixed steps.

``du/dt + dF(u)/dx = source`` for the means ``u`` of cells between given edges. What leaves a cell
enters its neighbor, so the total changes by what crosses the two ends only, to rounding.
"""

import math
from collections.abc import Callable
from typing import Any, NamedTuple

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
from jax import lax

from granum.core.errors import InputError
from granum.numerics.boundaries import AbstractBoundary, Outflow
from granum.numerics.limiters import van_leer
from granum.numerics.roots import find_root

Rate = Callable[[Any, Any], Any]
Limiter = Callable[[jax.Array, jax.Array], jax.Array]


class Evolution(NamedTuple):
    """State at the end, and what was recorded after every step (leading axis: steps)."""

    state: Any
    record: Any


class Upwind(eqx.Module):
    """Flux ``velocity * u``, taken from the side it comes from.

    Parameters
    ----------
    velocity: scalar, or at the ``n + 1`` faces, or a function of time returning either.
    """

    velocity: Any

    def __call__(self, left: jax.Array, right: jax.Array, time: Any) -> jax.Array:
        """Flux through the faces, from the states on both sides, shapes ``(..., n + 1)``."""
        velocity: Any = self.velocity(time) if callable(self.velocity) else self.velocity
        return jnp.maximum(velocity, 0.0) * left + jnp.minimum(velocity, 0.0) * right


class Godunov(eqx.Module):
    """Exact flux between two states for any scalar flux ``function(u)``, humped or not.

    The least flux between the states where they rise, the greatest where they fall: shocks and
    fans of settling suspensions come out right without knowing which is which.

    Parameters
    ----------
    function: elementwise flux. It may close over arrays on the ``n + 1`` faces.
    stationary: every ``u`` where the flux has a minimum or maximum, shape ``(k,)`` or
        ``(k, n + 1)``; see `stationary_points`. Empty for a monotone flux.
    """

    function: Callable[[jax.Array], jax.Array]
    stationary: Any = ()

    def __call__(self, left: jax.Array, right: jax.Array, time: Any) -> jax.Array:
        """Flux through the faces, from the states on both sides, shapes ``(..., n + 1)``."""
        ends = self.function(left), self.function(right)
        least, greatest = jnp.minimum(*ends), jnp.maximum(*ends)
        for u in self.stationary:
            flux = self.function(jnp.asarray(u, dtype=left.dtype))
            between = (left - u) * (right - u) < 0
            least = jnp.where(between, jnp.minimum(least, flux), least)
            greatest = jnp.where(between, jnp.maximum(greatest, flux), greatest)
        return jnp.where(left <= right, least, greatest)


def uniform_edges(lower: Any, upper: Any, cells: int) -> jax.Array:
    """Edges of equal cells, shape ``(cells + 1,)``."""
    return jnp.linspace(lower, upper, cells + 1)


def geometric_edges(lower: Any, upper: Any, cells: int) -> jax.Array:
    """Edges in geometric progression between two positive ends, shape ``(cells + 1,)``."""
    return jnp.geomspace(lower, upper, cells + 1)


def transport_rate(
    cells: jax.Array,
    edges: jax.Array,
    flux: Callable[..., jax.Array],
    *,
    lower: AbstractBoundary = Outflow(),
    upper: AbstractBoundary = Outflow(),
    limiter: Limiter = van_leer,
    source: Callable[..., Any] | None = None,
    time: Any = 0.0,
) -> jax.Array:
    """Rate of change of the cell means.

    Parameters
    ----------
    cells: cell means, shape ``(..., n)``, at least two cells.
    edges: increasing, shape ``(n + 1,)``.
    flux: ``flux(left, right, time)`` at the faces, such as `Upwind` or `Godunov`.
    lower, upper: boundaries at the first and last edge.
    limiter: see `granum.numerics.limiters`.
    source: ``source(cells, centers, time)``, amount per volume and time, shape of the cells.
    time: handed to flux, boundaries and source.

    Returns
    -------
    ``d cells / dt``, shape ``(..., n)``.
    """
    h = jnp.diff(edges)
    gap = jnp.concatenate([h[:1], 0.5 * (h[1:] + h[:-1]), h[-1:]])
    first, last = cells[..., :1], cells[..., -1:]
    ghosted = jnp.concatenate(
        [lower.ghost(first, last, time), cells, upper.ghost(last, first, time)], axis=-1
    )
    rise = jnp.diff(ghosted)
    slope = rise / gap
    behind, ahead = slope[..., :-1], slope[..., 1:]
    # On unequal cells a limited slope could still overshoot the neighbor.
    most = jnp.minimum(abs(rise[..., :-1]), abs(rise[..., 1:]))
    to_upper = cells + jnp.clip(0.5 * h * limiter(behind, ahead), -most, most)
    to_lower = cells - jnp.clip(0.5 * h * limiter(ahead, behind), -most, most)
    below, above = to_lower[..., :1], to_upper[..., -1:]
    left = jnp.concatenate([lower.outside(below, above, time), to_upper], axis=-1)
    right = jnp.concatenate([to_lower, upper.outside(above, below, time)], axis=-1)
    through = flux(left, right, time)
    enters = lower.flux(through[..., :1], time)
    leaves = upper.flux(through[..., -1:], time)
    through = jnp.concatenate([enters, through[..., 1:-1], leaves], axis=-1)
    rate = -jnp.diff(through) / h
    if source is None:
        return rate
    return rate + source(cells, 0.5 * (edges[1:] + edges[:-1]), time)


def ssp_rk3(
    rate: Rate,
    state: Any,
    *,
    steps: int,
    dt: Any,
    start_time: Any = 0.0,
    record: Callable[[Any, Any], Any] | None = None,
) -> Evolution:
    """Third-order strong-stability-preserving Runge-Kutta (Shu and Osher 1988), fixed steps.

    Whatever one forward Euler step of length ``dt`` keeps (positivity, no new extrema), this keeps.

    Parameters
    ----------
    rate: ``rate(state, time)``, a pytree like the state.
    state: pytree of arrays, for instance cells together with a concentration.
    steps: number of steps, a Python integer; see `steps_for`.
    dt: length of a step; it may be traced.
    record: ``record(state, time)`` after every step, stacked in the result.

    Example:
        >>> ssp_rk3(lambda y, t: -y, jnp.array(1.0), steps=1000, dt=0.001).state
        Array(0.36787944, dtype=float64)
    """

    def combine(a: float, base: Any, stage: Any, time: Any) -> Any:
        change = rate(stage, time)
        return jax.tree.map(lambda y0, y, dy: (1.0 - a) * y0 + a * (y + dt * dy), base, stage, change)

    def step(y: Any, number: jax.Array) -> tuple[Any, Any]:
        time = start_time + number * dt
        stage = jax.tree.map(lambda y0, dy: y0 + dt * dy, y, rate(y, time))
        stage = combine(0.25, y, stage, time + dt)
        y = combine(2.0 / 3.0, y, stage, time + 0.5 * dt)
        return y, None if record is None else record(y, time + dt)

    state = jax.tree.map(lambda leaf: jnp.asarray(leaf, dtype=float), state)
    return Evolution(*lax.scan(step, state, jnp.arange(steps, dtype=float)))


def advance(
    cells: Any,
    edges: Any,
    flux: Callable[..., jax.Array],
    *,
    steps: int,
    dt: Any,
    lower: AbstractBoundary = Outflow(),
    upper: AbstractBoundary = Outflow(),
    limiter: Limiter = van_leer,
    source: Callable[..., Any] | None = None,
    start_time: Any = 0.0,
    record: Callable[[jax.Array, Any], Any] | None = None,
) -> Evolution:
    """Cell means after ``steps`` steps of length ``dt``; arguments as above.

    Second order in space where the solution is smooth. With a Courant number up to 0.5 (see
    `steps_for`) means stay between their neighbors, so non-negative ones stay so. Batch it with
    `jax.vmap`; derivatives work in both directions.

    Example:
        >>> edges = uniform_edges(0.0, 1.0, 100)
        >>> steps = steps_for(0.3, edges, speed=1.0)
        >>> pulse = jnp.where(edges[1:] <= 0.2, 1.0, 0.0)
        >>> moved = advance(pulse, edges, Upwind(1.0), steps=steps, dt=0.3 / steps).state
    """
    edges = jnp.asarray(edges, dtype=float)

    def rate(cells: jax.Array, time: Any) -> jax.Array:
        return transport_rate(
            cells,
            edges,
            flux,
            lower=lower,
            upper=upper,
            limiter=limiter,
            source=source,
            time=time,
        )

    return ssp_rk3(rate, cells, steps=steps, dt=dt, start_time=start_time, record=record)


def steps_for(duration: float, edges: Any, speed: Any, *, courant: float = 0.45, sink_rate: Any = 0.0) -> int:
    """Number of equal steps that keeps the Courant number; call it outside `jax.jit`.

    Parameters
    ----------
    duration: time to cover, s.
    edges: cell edges, shape ``(n + 1,)``.
    speed: largest speed of a wave (``|dF/du|``): scalar, in cells ``(n,)`` or at faces
        ``(n + 1,)``.
    courant: most of a cell crossed in one step; positivity is proved up to 0.5.
    sink_rate: fastest relative consumption by a source, 1/s.

    Raises
    ------
    InputError: if a value is traced, since the number of steps shapes the program.

    Example:
        >>> steps_for(1.0, uniform_edges(0.0, 1.0, 90), speed=1.0)
        200
    """
    try:
        edges, speed, sink = (np.asarray(a, dtype=float) for a in (edges, speed, sink_rate))
        duration = float(duration)
    except jax.errors.TracerArrayConversionError as error:
        raise InputError(
            "The number of steps was asked for inside a compiled function. "
            "Call steps_for before jit, with the largest speed that will occur."
        ) from error
    widths = np.diff(edges)
    speed = np.abs(speed)
    if speed.shape == edges.shape:
        speed = np.maximum(speed[1:], speed[:-1])
    fastest = np.max(speed / widths + sink)
    # Rounding must not add a step to an exact ratio.
    return max(1, math.ceil(duration * fastest / courant * (1.0 - 1e-12)))


def stationary_points(
    function: Callable[[jax.Array], jax.Array], lower: float, upper: float, samples: int = 513
) -> jax.Array:
    """Where a scalar flux has its extrema in ``[lower, upper]``, for `Godunov`; outside `jax.jit`.

    Found between ``samples`` points: of two extrema closer than that, none is seen.

    Example:
        >>> stationary_points(lambda u: u * (1.0 - u), 0.0, 1.0)
        Array([0.5], dtype=float64)
    """
    u = jnp.linspace(lower, upper, samples)

    def slope(u: jax.Array) -> jax.Array:
        return jax.jvp(function, (u,), (jnp.ones_like(u),))[1]

    sign = np.sign(slope(u))
    kept = np.flatnonzero(sign)
    turns = np.flatnonzero(sign[kept[1:]] != sign[kept[:-1]])
    return find_root(slope, u[kept[turns]], u[kept[turns + 1]]).value
