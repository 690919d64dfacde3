"""Slope limiters: how steep a cell may be, from the slopes behind and ahead of it.

A limiter is any function ``limiter(behind, ahead)`` of two arrays of slopes, seen in the direction
of the face to be reached. It returns zero where they differ in sign and at most twice the smaller.
"""

import jax
import jax.numpy as jnp


def minmod(behind: jax.Array, ahead: jax.Array) -> jax.Array:
    """The smaller slope: most diffusive, never steepens."""
    return jnp.where(behind * ahead > 0, jnp.where(abs(behind) < abs(ahead), behind, ahead), 0.0)


def van_leer(behind: jax.Array, ahead: jax.Array) -> jax.Array:
    """Harmonic mean: smooth, second order, the default."""
    product = behind * ahead
    same = product > 0
    return jnp.where(same, 2.0 * product / jnp.where(same, behind + ahead, 1.0), 0.0)


def koren(behind: jax.Array, ahead: jax.Array) -> jax.Array:
    """Koren (1993): third order on smooth parts of a uniform grid."""
    third = (abs(behind) + 2.0 * abs(ahead)) / 3.0
    size = jnp.minimum(jnp.minimum(2.0 * abs(behind), 2.0 * abs(ahead)), third)
    return jnp.where(behind * ahead > 0, jnp.sign(ahead) * size, 0.0)


def superbee(behind: jax.Array, ahead: jax.Array) -> jax.Array:
    """Roe's superbee: keeps fronts sharpest, and sharpens smooth waves too."""
    small, large = jnp.minimum(abs(behind), abs(ahead)), jnp.maximum(abs(behind), abs(ahead))
    size = jnp.minimum(2.0 * small, large)
    return jnp.where(behind * ahead > 0, jnp.sign(ahead) * size, 0.0)


def first_order(behind: jax.Array, ahead: jax.Array) -> jax.Array:
    """No slope at all: plain upwind."""
    return jnp.zeros_like(behind + ahead)
