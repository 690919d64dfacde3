"""The equations of motion of a particle in a plane, stepped by exact solutions for a friction held over half
a step.

An adaptive solver would do, but compiles for seconds and must be stiff (relaxation in microseconds, settling
in hours). Here the steps grow geometrically, each is the exponential midpoint rule extrapolated once (third
order, exact at the terminal velocity), and between the knots a partial step gives any time. Against Diffrax
at 1e-11 it agrees within 3e-6.
"""

from __future__ import annotations

from typing import Any

import equinox as eqx
import jax.numpy as jnp
from jax import lax

from granum.numerics import find_root
from granum.particles.falling import LEAST, reynolds_from_size

KNOTS = 240
SHORTEST, LONGEST = 1e-5, 50.0  # first step and last knot, in relaxation times


class Motion(eqx.Module):
    """One particle: position in units of speed × relaxation time, velocity of the largest speed in play, time
    of relaxation.
    """

    drag: Any
    relaxation: Any
    speed: Any
    terminal: Any
    reynolds: Any  # of a relative velocity of one unit
    weight: Any
    stream: Any
    start: Any

    @staticmethod
    def of(
        d: Any,
        rho_p: Any,
        rho: Any,
        eta: Any,
        gravity: Any,
        added: Any,
        drag: Any,
        vx: Any,
        vy: Any,
        stream: Any,
    ) -> Motion:
        """The motion of a sphere released with a velocity in a stream."""
        inertia = rho_p + added * rho
        excess = jnp.asarray(rho_p - rho, dtype=float)
        X = jnp.maximum(4.0 / 3.0 * rho * abs(excess) * gravity * d**3 / eta**2, LEAST)
        terminal = reynolds_from_size(drag, X)[0] * eta / (rho * d)
        speed = lax.stop_gradient(jnp.maximum(terminal, abs(stream)) + jnp.hypot(abs(vx), abs(vy) + LEAST))
        relaxation = inertia * d**2 / (18.0 * eta)
        weight = gravity * excess / inertia * relaxation / speed
        start = jnp.stack([0.0 * speed, 0.0 * speed, vx / speed, vy / speed])
        return Motion(drag, relaxation, speed, terminal, rho * d * speed / eta, weight, stream / speed, start)

    def friction(self, state: Any) -> Any:
        """Drag over Stokes' drag."""
        Re = self.reynolds * jnp.sqrt((state[2] - self.stream) ** 2 + state[3] ** 2 + 1e-24)
        return self.drag(Re) * Re / 24.0

    def _held(self, state: Any, friction: Any, step: Any) -> Any:
        z = friction * step + 1e-30
        gone = -jnp.expm1(-z)
        q = step * gone / z  # ∫ e^−kt dt
        short = z < 1e-3
        long = jnp.where(short, 1.0, z)
        # ∫∫ e^−kt dt dt
        r = step**2 * jnp.where(short, 0.5 - z / 6.0 + z**2 / 24.0, (long + jnp.expm1(-long)) / long**2)
        x, y, vx, vy = state
        across = vx - self.stream
        left = 1.0 - gone
        return jnp.stack(
            [
                x + self.stream * step + across * q,
                y + vy * q + self.weight * r,
                self.stream + across * left,
                vy * left + self.weight * q,
            ]
        )

    def _midpoint(self, state: Any, step: Any) -> Any:
        middle = self._held(state, self.friction(state), 0.5 * step)
        return self._held(state, self.friction(middle), step)

    def after(self, state: Any, step: Any) -> Any:
        """State after a step."""
        whole = self._midpoint(state, step)
        halves = self._midpoint(self._midpoint(state, 0.5 * step), 0.5 * step)
        return halves + (halves - whole) / 3.0

    def knots(self) -> tuple[Any, Any]:
        """Times and states of the knots, the start first; after the last the motion is steady."""
        fastest = jnp.maximum(self.friction(self.start), 1e-6)
        steady = (
            self.drag(self.terminal * self.reynolds / self.speed)
            * self.terminal
            * self.reynolds
            / self.speed
            / 24.0
        )
        first = lax.stop_gradient(SHORTEST / jnp.maximum(fastest, steady))
        last = lax.stop_gradient(LONGEST / steady)
        times = jnp.concatenate([jnp.zeros(1), first * (last / first) ** jnp.linspace(0.0, 1.0, KNOTS)])

        def advance(state: Any, step: Any) -> tuple[Any, Any]:
            following = self.after(state, step)
            return following, following

        _, states = lax.scan(advance, self.start, jnp.diff(times))
        return times, jnp.concatenate([self.start[None], states])

    def at(self, time: Any) -> Any:
        """Position and velocity in SI at one time."""
        times, states = self.knots()
        t = time / self.relaxation
        i = jnp.clip(jnp.searchsorted(times, t, side="right") - 1, 0, KNOTS)
        return self.in_si(self.after(states[i], t - times[i]))

    def reaching(self, depth: Any) -> tuple[Any, Any]:
        """Position and velocity, and time, in SI when a height below (heavy) or above (light) the start is
        reached.
        """
        times, states = self.knots()
        side = jnp.sign(self.weight)
        target = depth / (self.speed * self.relaxation)
        deep = side * states[:, 1]
        i = jnp.clip(jnp.argmax(jnp.append(deep >= target, True)) - 1, 0, KNOTS)
        state, left = states[i], lax.stop_gradient(target - deep[i])
        last = i >= KNOTS
        longest = jnp.where(
            last, 2.0 * left * self.speed / self.terminal + 1.0, times[jnp.minimum(i + 1, KNOTS)] - times[i]
        )
        step = find_root(
            lambda h: side * self.after(state, h)[1] - target, 0.0, longest, tolerance=1e-14
        ).value
        return self.in_si(self.after(state, step)), (times[i] + step) * self.relaxation

    def in_si(self, state: Any) -> Any:
        """x, y, vx, vy in SI."""
        length = self.speed * self.relaxation
        return state * jnp.stack([length, length, self.speed, self.speed])
