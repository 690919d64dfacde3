"""What a crystal is: density, shape and how much anhydrous solute it holds."""

from __future__ import annotations

from typing import Any

import equinox as eqx
import jax.numpy as jnp

from granum.numerics.smooth import safe_divide

DRY = 1e-12  # of the solvent, which no crystals bind


class Crystal(eqx.Module):
    """One crystalline substance.

    Parameters
    ----------
    density: kg/m³.
    volume_shape_factor: crystal volume over the cube of its size (1 for a cube by its edge, π/6 for a
        sphere).
    solute_fraction: anhydrous solute in the crystal, kg/kg; below 1 for a hydrate.
    heat_of_crystallization: heat given off per kg of crystal that forms, J/kg (positive when exothermic).
    heat_capacity: J/(kg K).
    """

    density: Any
    volume_shape_factor: Any = 1.0
    solute_fraction: Any = 1.0
    heat_of_crystallization: Any = 0.0
    heat_capacity: Any = 1000.0

    @property
    def mass_per_cube(self) -> Any:
        """Mass of a crystal over the cube of its size, kg/m³."""
        return self.density * self.volume_shape_factor


def crystals_at(
    solute: Any, solvent: Any, solute_per_solvent: Any, solute_fraction: Any, bound: Any = None
) -> Any:
    """Crystals that form when a liquor of given total solute and solvent is left with
    ``solute_per_solvent``.

    ``bound`` is the solvent lost to the liquor per kg of crystals: what a hydrate takes, unless more is said.
    Negative when the liquor would have to dissolve crystals.

    >>> round(crystals_at(solute=50.0, solvent=100.0, solute_per_solvent=0.2, solute_fraction=1.0), 6)
    30.0
    """
    c, x = solute_per_solvent, solute_fraction
    return (solute - solvent * c) / (x - (1.0 - x if bound is None else bound) * c)


def saturation(solubility: Any, temperature: Any, solvent: Any) -> Any:
    """Solubility by a law, which may depend on the free solvent (kg) that holds other solutes."""
    if getattr(solubility, "takes_solvent", False):
        return solubility(temperature, solvent)
    return solubility(temperature)


def born_share(seeded: Any, crystals: Any) -> Any:
    """Share of the crystals that was born, from what the seeds have become; none where there are no
    crystals.
    """
    return jnp.maximum(1.0 - safe_divide(seeded, crystals, 1.0), 0.0)


def ratio_left(solute: Any, solvent: Any, crystals: Any, solute_fraction: Any, bound: Any = None) -> Any:
    """Solute per solvent of the liquor once a mass of crystals has formed: the inverse of ``crystals_at``.

    It falls on with crystals that would bind more solvent than there is, where a quotient of two deficits
    would be a rich liquor again. Where there is no solvent to begin with, as where an empty feed is
    evaporated on the way to the solution of a line, or where a step of a batch has tried to boil off more
    than there was, what counts is the sign of the solute that is left.
    """
    bound = 1.0 - solute_fraction if bound is None else bound
    left = solvent - bound * crystals
    left = jnp.where(solvent > 0.0, jnp.maximum(left, DRY * solvent), jnp.abs(left))
    return safe_divide(solute - solute_fraction * crystals, left)
