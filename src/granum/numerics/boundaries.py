"""What happens at the two ends of a one-dimensional grid."""

from abc import abstractmethod
from typing import Any

import equinox as eqx
import jax
import jax.numpy as jnp


class AbstractBoundary(eqx.Module):
    """One end of a grid. All arrays have a last axis of length one."""

    @abstractmethod
    def ghost(self, near: jax.Array, far: jax.Array, time: Any) -> jax.Array:
        """Mean of an imagined cell outside, from the end cell and that of the other end."""

    @abstractmethod
    def outside(self, near: jax.Array, far: jax.Array, time: Any) -> jax.Array:
        """State just outside the face, from that just inside and that at the other end."""

    @abstractmethod
    def flux(self, through: jax.Array, time: Any) -> jax.Array:
        """Flux through the face, from the one found with the states on both sides."""


class Outflow(AbstractBoundary):
    """Open end: the outside is like the last cell."""

    def ghost(self, near: jax.Array, far: jax.Array, time: Any) -> jax.Array:
        return near

    def outside(self, near: jax.Array, far: jax.Array, time: Any) -> jax.Array:
        return near

    def flux(self, through: jax.Array, time: Any) -> jax.Array:
        return through


class Inflow(AbstractBoundary):
    """End where a given state waits outside.

    Parameters
    ----------
    value: the state, or a function of time returning it.
    """

    value: Any

    def ghost(self, near: jax.Array, far: jax.Array, time: Any) -> jax.Array:
        return _at(self.value, time, near)

    def outside(self, near: jax.Array, far: jax.Array, time: Any) -> jax.Array:
        return _at(self.value, time, near)

    def flux(self, through: jax.Array, time: Any) -> jax.Array:
        return through


class FixedFlux(AbstractBoundary):
    """End crossed by a given flux, positive towards higher coordinates.

    Parameters
    ----------
    value: amount per area and time, or a function of time returning it.
    """

    value: Any

    def ghost(self, near: jax.Array, far: jax.Array, time: Any) -> jax.Array:
        return near

    def outside(self, near: jax.Array, far: jax.Array, time: Any) -> jax.Array:
        return near

    def flux(self, through: jax.Array, time: Any) -> jax.Array:
        return _at(self.value, time, through)


class Wall(AbstractBoundary):
    """Closed end: nothing crosses it."""

    def ghost(self, near: jax.Array, far: jax.Array, time: Any) -> jax.Array:
        return near

    def outside(self, near: jax.Array, far: jax.Array, time: Any) -> jax.Array:
        return near

    def flux(self, through: jax.Array, time: Any) -> jax.Array:
        return jnp.zeros_like(through)


class Periodic(AbstractBoundary):
    """What leaves here enters at the other end; use it at both."""

    def ghost(self, near: jax.Array, far: jax.Array, time: Any) -> jax.Array:
        return far

    def outside(self, near: jax.Array, far: jax.Array, time: Any) -> jax.Array:
        return far

    def flux(self, through: jax.Array, time: Any) -> jax.Array:
        return through


def _at(value: Any, time: Any, like: jax.Array) -> jax.Array:
    value = jnp.asarray(value(time) if callable(value) else value, dtype=like.dtype)
    return jnp.broadcast_to(value[..., None], like.shape)
