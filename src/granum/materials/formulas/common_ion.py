"""Two salts with a common ion in water: activities by Pitzer's equations for mixtures of 1–1 electrolytes."""

from __future__ import annotations

from typing import Any, NamedTuple

import jax.numpy as jnp

from granum.materials.formulas.activity import debye_huckel_slope

B, ALPHA = 1.2, 2.0


class Binary(NamedTuple):
    """Pitzer's coefficients of one salt."""

    beta_zero: Any
    beta_one: Any
    c_phi: Any


def _g(x: Any) -> Any:
    return 2.0 * (1.0 - (1.0 + x) * jnp.exp(-x)) / x**2


def _g_prime(x: Any) -> Any:
    return -2.0 * (1.0 - (1.0 + x + 0.5 * x**2) * jnp.exp(-x)) / x**2


def activity_products(
    first: Any, second: Any, one: Binary, other: Binary, theta: Any, psi: Any, temperature: Any
) -> tuple[Any, Any]:
    """Logarithm of the ion activity product of each salt at given molalities of both, mol/kg.

    The salts share their anion (or their cation); all ions have one charge, so that unsymmetrical mixing does
    not occur.
    """
    first, second = (jnp.maximum(jnp.asarray(m, dtype=float), 1e-12) for m in (first, second))
    I = first + second
    root = jnp.sqrt(I)
    x = ALPHA * root
    pairs = ((first, one), (second, other))
    debye = -debye_huckel_slope.function(temperature) * (
        root / (1.0 + B * root) + 2.0 / B * jnp.log1p(B * root)
    )
    F = debye + sum(m * p.beta_one * _g_prime(x) for m, p in pairs)
    third = sum(m * I * 0.5 * p.c_phi for m, p in pairs)
    common = F + third + first * second * psi
    second_order = [p.beta_zero + p.beta_one * _g(x) + I * 0.5 * p.c_phi for _m, p in pairs]
    common = common + 2.0 * (first * second_order[0] + second * second_order[1])
    own = [
        F + third + 2.0 * I * second_order[i] + mixed * (2.0 * theta + I * psi)
        for i, mixed in ((0, second), (1, first))
    ]
    return tuple(jnp.log(m) + jnp.log(I) + own[i] + common for i, m in ((0, first), (1, second)))  # type: ignore[return-value]


def osmotic_coefficient_mixed(
    first: Any, second: Any, one: Binary, other: Binary, theta: Any, psi: Any, temperature: Any
) -> Any:
    """Osmotic coefficient of the mixture."""
    I = first + second
    root = jnp.sqrt(jnp.maximum(I, 1e-24))
    A = debye_huckel_slope.function(temperature)
    pairs = sum(
        m * I * (p.beta_zero + p.beta_one * jnp.exp(-ALPHA * root) + I * p.c_phi)
        for m, p in ((first, one), (second, other))
    )
    mixing = first * second * (theta + I * psi)
    return 1.0 + (-A * root * I / (1.0 + B * root) + pairs + mixing) / jnp.maximum(I, 1e-24)
