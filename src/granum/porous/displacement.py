"""Displacement of one liquid by another in a porous layer with axial dispersion: what leaves and what
stays.
"""

from __future__ import annotations

from typing import Any

import jax.numpy as jnp
from jax.scipy.special import erfc, log_ndtr

BEST_NUMBER = 16.2
"""Dispersion number at which one void volume displaces 86 %, the best that Choudhury and Dahlstrom (1957)
found on filters: cakes are never as even as the theory of dispersion between grains supposes. exp(D) erfc(√D)
= 0.14.
"""


def _terms(ratio: Any, number: Any) -> tuple[Any, Any]:
    """erfc((1−w)√D/2√w) and exp(D) erfc((1+w)√D/2√w), the second without overflow."""
    w = jnp.where(ratio > 0, ratio, 1.0)
    scale = 0.5 * jnp.sqrt(number / w)
    first = erfc((1.0 - w) * scale)
    second = 2.0 * jnp.exp(number + log_ndtr(-jnp.sqrt(2.0) * (1.0 + w) * scale))
    return first, second


def effluent_concentration(ratio: Any, number: Any) -> Any:
    """Share of the displaced liquid in what leaves after a number of void volumes, at a dispersion number
    (Sherman 1964).
    """
    first, second = _terms(ratio, number)
    return jnp.where(ratio > 0, 1.0 - 0.5 * (first + second), 1.0)


def remaining_fraction(ratio: Any, number: Any) -> Any:
    """Fraction of the displaced liquid that is still in the layer: the integral of the above in closed
    form.
    """
    first, second = _terms(ratio, number)
    left = 1.0 - ratio + 0.5 * ((ratio - 1.0) * first + (ratio + 1.0) * second)
    return jnp.where(ratio > 0, jnp.maximum(left, 0.0), 1.0)


def axial_dispersion(velocity: Any, diameter: Any, diffusivity: Any) -> Any:
    """Axial dispersion coefficient of a thin layer of grains at a pore velocity, m²/s (Wakeman and Tarleton
    2005).
    """
    return diffusivity / jnp.sqrt(2.0) + 1.75 * velocity * diameter


def practical_number(velocity: Any, thickness: Any, diameter: Any, diffusivity: Any) -> Any:
    """Dispersion number of a layer of grains at a pore velocity, not above the best found in practice."""
    return jnp.minimum(velocity * thickness / axial_dispersion(velocity, diameter, diffusivity), BEST_NUMBER)
