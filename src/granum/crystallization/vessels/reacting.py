"""A sparingly soluble salt in the steady mixed vessel: the concentration of what may still precipitate stands
for the solute, the activities of its ions for the driving force.
"""

from __future__ import annotations

from typing import Any

import equinox as eqx
import jax.numpy as jnp
from jax import lax

from granum.crystallization.vessels.crystals import crystals_at
from granum.crystallization.vessels.precipitation import Ions, SaltEquilibrium
from granum.numerics.roots import find_root
from granum.numerics.smooth import safe_divide

DEEPEST = 160.0  # natural logarithm by which what stays dissolved may lie below what is fed


class Reacting(eqx.Module):
    """What flows through the vessel: precipitate that the scarcer ion could form and solvent (kg/s), of both
    ions what they have in excess of that (kg/s of precipitate), and charges of the ions that stay dissolved
    (mol/s).
    """

    equilibrium: SaltEquilibrium
    temperature: Any
    solute: Any
    solvent: Any
    excess: tuple[Any, Any]
    spectators: Any
    solute_fraction: float

    def contents(self, ratio: Any) -> Ions:
        """Of the liquor that is left with a ratio of precipitable salt to solvent."""
        x = self.solute_fraction
        left = self.solvent - (1.0 - x) * crystals_at(self.solute, self.solvent, ratio, x)
        left = jnp.where(left > 0.0, left, 1.0)
        nothing = jnp.zeros_like(left)
        cation, anion = (ratio * left + more for more in self.excess)
        return Ions(self.temperature, cation, left, nothing, anion, self.spectators)

    def measures(self, ratio: Any) -> tuple[Any, Any]:
        """Root of the activity product and of the solubility product, kg/kg as laws of kinetics take them."""
        there = self.contents(ratio)
        return self.equilibrium.ratio(there, 0.0), self.equilibrium.saturated(there)

    def saturation(self, highest: Any) -> Any:
        """Ratio at which the liquor is saturated; the highest where it never is."""

        def over(depth: Any) -> Any:
            now, saturated = self.measures(highest * jnp.exp(-depth))
            return jnp.log(now) - jnp.log(saturated)

        some = (highest > 0.0) & (over(jnp.zeros_like(highest)) > 0.0)
        root = find_root(lambda y: jnp.where(some, over(y), y - 1.0), 0.0, lax.stop_gradient(DEEPEST))
        return jnp.where(some, highest * jnp.exp(-root.value), highest)


class Held(eqx.Module):
    """A saturation that was found, as a law of solubility."""

    ratio: Any

    def __call__(self, temperature: Any) -> Any:
        return self.ratio


class ByActivity(eqx.Module):
    """A law of growth or nucleation whose driving force is that of the ions."""

    law: Any
    reacting: Reacting

    def __call__(self, ratio: Any, saturated: Any, temperature: Any, *magma: Any) -> Any:
        return self.law(*self.reacting.measures(ratio), temperature, *magma)


class ReactedVolume(eqx.Module):
    """Volume flow of the liquor: by what the reagents take more room than the byproduct, per kg that has not
    precipitated; solvent; and what is there in any case (m³/s).
    """

    per_solute: Any
    solvent_density: Any
    others: Any

    def __call__(self, solute: Any, solvent: Any) -> Any:
        return solute * self.per_solute + solvent / self.solvent_density + self.others


def scarcer(cation: Any, anion: Any) -> tuple[Any, tuple[Any, Any]]:
    """What of both ions can precipitate, and what each has beyond it."""
    both = jnp.minimum(cation, anion)
    return both, (cation - both, anion - both)


def fed_ratio(reacting: Reacting, crystals: Any) -> Any:
    """Ratio of precipitable salt to solvent before anything more precipitates."""
    x = reacting.solute_fraction
    return safe_divide(reacting.solute - x * crystals, reacting.solvent - (1.0 - x) * crystals, 0.0)
