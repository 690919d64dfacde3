"""Initial-value problems by Diffrax, with the status in the result."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any, NamedTuple, cast

import jax
import jax.numpy as jnp

if TYPE_CHECKING:
    import diffrax


class Trajectory(NamedTuple):
    """Outcome of `integrate`.

    states: pytree like the start, with a leading axis of times; from the stop on, the last state.
    end_time: last time for each element: the stop, or the last of the times.
    end_state: the state then.
    stopped: True where the stop condition ended it.
    converged: False if steps ran out or something was not finite.
    steps: number of steps tried.
    """

    states: Any
    end_time: jax.Array
    end_state: Any
    stopped: jax.Array
    converged: jax.Array
    steps: jax.Array


def integrate(
    vector_field: Callable[[Any, Any, Any], Any],
    start: Any,
    times: Any,
    args: Any = None,
    *,
    stiff: bool = False,
    until: Callable[[Any, Any, Any], Any] | None = None,
    rtol: float = 1e-8,
    atol: Any = 1e-10,
    max_steps: int = 4096,
    adjoint: diffrax.AbstractAdjoint | None = None,
) -> Trajectory:
    """Solve ``dy/dt = vector_field(t, y, args)`` from ``y(times[0]) = start``.

    Parameters
    ----------
    vector_field: returns a pytree like the state.
    start: pytree of real arrays.
    times: increasing, shape ``(n,)``, at least two; the first is the initial time.
    args: handed to the vector field and the stop condition.
    stiff: Kvaerno's implicit 5(4) pair, stepping to each of the times, instead of Tsitouras'
        explicit one, which interpolates.
    until: ``until(t, y, args)``, real; the integration stops where it changes sign.
    rtol, atol: tolerances on each step; ``atol`` may be a pytree like the state.
    max_steps: most steps.
    adjoint: how Diffrax differentiates. The default allows forward and reverse mode;
        `diffrax.RecursiveCheckpointAdjoint` makes reverse mode faster and excludes forward.

    Returns
    -------
    A `Trajectory`. Nothing raises.

    Example:
        >>> path = integrate(lambda t, y, k: -k * y, 1.0, jnp.array([0.0, 1.0]), 1.0)
        >>> path.end_state
        Array(0.36787944, dtype=float64)
    """
    import diffrax  # only here: loading it takes as long as the rest of numerics
    import optimistix as optx

    times = jnp.asarray(times, dtype=float)
    start = jax.tree.map(lambda leaf: jnp.asarray(leaf, dtype=float), start)
    event = None
    if until is not None:
        event = diffrax.Event(lambda t, y, args, **_: until(t, y, args), optx.Newton(rtol=1e-10, atol=1e-12))
    controller = diffrax.PIDController(rtol=rtol, atol=atol)
    if stiff:
        # The interpolant of the implicit pair is far less accurate than its steps.
        controller = diffrax.ClipStepSizeController(controller, step_ts=times)
    solution = diffrax.diffeqsolve(
        diffrax.ODETerm(vector_field),
        diffrax.Kvaerno5() if stiff else diffrax.Tsit5(),
        times[0],
        times[-1],
        None,
        start,
        args,
        saveat=diffrax.SaveAt(subs=[diffrax.SubSaveAt(ts=times), diffrax.SubSaveAt(t1=True)]),
        stepsize_controller=controller,
        adjoint=diffrax.DirectAdjoint() if adjoint is None else adjoint,
        event=event,
        max_steps=max_steps,
        throw=False,
    )
    (saved_times, (end_time,)), (saved, last) = cast(Any, solution.ts), cast(Any, solution.ys)
    end_state = jax.tree.map(lambda leaf: leaf[0], last)
    reached = jnp.isfinite(saved_times)

    def held(saved: jax.Array, last: jax.Array) -> jax.Array:
        mask = reached.reshape(reached.shape + (1,) * last.ndim)
        return jnp.where(mask, saved, last)

    stopped = solution.result == diffrax.RESULTS.event_occurred
    finite = [jnp.all(jnp.isfinite(leaf)) for leaf in jax.tree.leaves(end_state)]
    return Trajectory(
        states=jax.tree.map(held, saved, end_state),
        end_time=end_time,
        end_state=end_state,
        stopped=stopped,
        converged=diffrax.is_okay(solution.result) & jnp.all(jnp.stack(finite)),
        steps=solution.stats["num_steps"],
    )
