"""The force balance of steady fall, solved for the Reynolds number under any drag law."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import jax.numpy as jnp

from granum.numerics.quick_roots import likely_root

EQUAL_DENSITIES = "Particle and fluid have the same density: the particle neither falls nor rises."
WRONG_WAY = "A particle denser than the fluid falls: its velocity, positive downwards, cannot be negative."
LEAST = 1e-30  # criteria below this are in the limit of infinitely slow fall


def shape_factors(sphericity: Any) -> tuple[Any, Any]:
    """Ganser's Stokes and Newton shape factors K₁ and K₂ of an isometric particle; one for a sphere."""
    stokes = 3.0 / (1.0 + 2.0 / jnp.sqrt(sphericity))
    lack = -jnp.log10(sphericity)
    angular = lack > 0.0
    power = jnp.where(angular, jnp.where(angular, lack, 1.0) ** 0.5743, 0.0)
    return stokes, 10.0 ** (1.8148 * power)


def drag_of_any_shape(Re: Any, sphericity: Any) -> Any:
    """Haider and Levenspiel's drag coefficient with the coefficients that depend on sphericity."""
    psi = sphericity
    A = jnp.exp(2.3288 - 6.4581 * psi + 2.4486 * psi**2)
    B = 0.0964 + 0.5565 * psi
    C = jnp.exp(4.905 - 13.8944 * psi + 18.4222 * psi**2 - 10.2599 * psi**3)
    D = jnp.exp(1.4681 + 12.2584 * psi - 20.7322 * psi**2 + 15.8855 * psi**3)
    return 24.0 / Re * (1.0 + A * Re**B) + C / (1.0 + D / Re)


def drag_of_shape(drag: Any, sphericity: Any) -> Callable[[Any], Any]:
    """The drag law of a shape as a function of the Reynolds number alone; no sphericity means a sphere.

    A law that knows the sphericity takes it. A law for spheres is multiplied by what Haider and Levenspiel
    find between the shape and a sphere, which vanishes in creeping flow; there Pettyjohn and Christiansen's
    factor, in Ganser's form, is added.
    """
    if sphericity is None:
        return drag
    card = getattr(drag, "card", None)
    if card is not None and any(p.name == "sphericity" for p in card.parameters):
        return drag if card.sort == "law" else lambda Re: drag(reynolds=Re, sphericity=sphericity)
    creeping = 24.0 * (1.0 / shape_factors(sphericity)[0] - 1.0)

    def shaped(Re: Any) -> Any:
        return drag(Re) * drag_of_any_shape(Re, sphericity) / drag_of_any_shape(Re, 1.0) + creeping / Re

    return shaped


def reynolds_from_size(drag: Callable[[Any], Any], criterion: Any) -> tuple[Any, Any]:
    """Reynolds number of terminal fall from X = C_D Re², and whether it was found."""
    # Stokes' law at small X, constant drag at large X: within 14 % of Brown and Lawler's root everywhere.
    start = jnp.log(criterion / 24.0) - jnp.log1p(0.0285 * jnp.sqrt(criterion))
    return _balance(lambda y: 2.0 * y + jnp.log(drag(jnp.exp(y))) - jnp.log(criterion), start)


def reynolds_from_velocity(drag: Callable[[Any], Any], criterion: Any) -> tuple[Any, Any]:
    """Reynolds number of terminal fall from Y = Re/C_D, and whether it was found."""
    start = jnp.log(jnp.sqrt(24.0 * criterion) + 0.5 * criterion**0.75 + 0.3 * criterion)
    return _balance(lambda y: y - jnp.log(drag(jnp.exp(y))) - jnp.log(criterion), start)


def _balance(equation: Callable[[Any], Any], start: Any) -> tuple[Any, Any]:
    """Root in ln Re."""
    value, found = likely_root(equation, start, near=3.0, far=60.0)
    return jnp.exp(value), found
