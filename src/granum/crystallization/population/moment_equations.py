"""Moments 0 to 4 as ordinary differential equations with an adaptive integrator: an independent check of the
packets.

Closed only where growth does not depend on size, nothing dissolves, agglomerates or breaks; elsewhere it is
refused.
"""

from __future__ import annotations

from typing import Any

import jax.numpy as jnp

from granum.core.errors import ApplicabilityError
from granum.core.i18n import _
from granum.crystallization.population.compiled import compiled
from granum.crystallization.population.lagrangian import Model
from granum.crystallization.population.operations import Programmed
from granum.crystallization.population.packets import HIGHEST, Seeds
from granum.numerics import integrate


def march_moments(
    model: Model, operation: Any, seeds: Seeds, solute: Any, solvent: Any, times: Any, tolerance: float = 1e-9
) -> Any:
    """Moments 0 to 4 of all crystals at given times, shape (times, 5).

    Raises
    ------
    ApplicabilityError: where moments are not closed, or the temperature is not a program.
    """
    if model.dissolution is not None or model.size_map is not None:
        raise ApplicabilityError(
            _(
                "Moment equations are closed only for growth that does not depend on size, without "
                "dissolution; use the packet engine."
            )
        )
    if not isinstance(operation, Programmed):
        raise ApplicabilityError(
            _("Moment equations take a temperature program; use the packet engine for a heat balance.")
        )
    return _solve(model, operation, seeds, solute, solvent, jnp.asarray(times, dtype=float), tolerance)


@compiled
def _solve(
    model: Model, operation: Programmed, seeds: Seeds, solute: Any, solvent: Any, times: Any, tolerance: float
) -> Any:
    start = seeds.moments()
    scale = jnp.where(start > 0, start, 1.0)
    k, x = model.crystal.mass_per_cube, model.crystal.solute_fraction
    first = operation.start(solute + x * k * start[3], solvent + (1.0 - x) * k * start[3])

    def rates(t: Any, y: Any, _args: Any) -> Any:
        m = y * scale
        contents = operation.step(first, 0.0, t, 0.0, 0.0)
        crystals = k * m[3]
        ratio, saturated = model.ratio(contents, crystals), model.saturated(contents, crystals)
        G = model.growth(ratio, saturated, contents.temperature)
        born = model.births(ratio, saturated, contents, crystals)
        fresh = [
            born * model.nucleus_size**order + (order * G * m[order - 1] if order else 0.0)
            for order in range(HIGHEST + 1)
        ]
        return jnp.stack(fresh) / scale

    return (
        integrate(rates, start / scale, times, rtol=tolerance, atol=tolerance * 1e-3, max_steps=65536).states
        * scale
    )
