"""Buoyant weight of particles in a fluid: Archimedes number, and the guard against particles that float."""

from __future__ import annotations

from typing import Any

import jax.numpy as jnp

from granum.core import impossible

TYPICAL = {
    "particle_diameter": (5e-5, 1e-3),
    "fluid_density": (0.4, 5.0),
    "dynamic_viscosity": (1.5e-5, 4e-5),
}
FINE = {**TYPICAL, "particle_diameter": (4e-5, 2e-4)}


def excess(rho_p: Any, rho: Any) -> Any:
    """Density above that of the fluid; NaN with a flag where there is none."""
    difference = jnp.asarray(rho_p - rho, dtype=float)
    impossible(difference <= 0.0, rho_p, "particle_density", rho, jnp.inf)
    return jnp.where(difference > 0.0, difference, jnp.nan)


def archimedes(d: Any, rho_p: Any, rho: Any, eta: Any, g: Any) -> Any:
    """Archimedes number of particles denser than the fluid."""
    return rho * excess(rho_p, rho) * g * d**3 / eta**2


def larger_root(half: Any, product: Any) -> Any:
    """Positive root of x² + 2 half x = product, without cancellation."""
    return product / (jnp.sqrt(half**2 + product) + half)
