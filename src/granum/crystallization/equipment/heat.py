"""Heat balance of a batch with the enthalpies of a stream, so that a line closes."""

from __future__ import annotations

from typing import Any

import equinox as eqx
import jax
import jax.numpy as jnp

from granum.crystallization.equipment.roles import Roles
from granum.crystallization.population.operations import Contents, Heat
from granum.streams.mixture import Mixture
from granum.streams.stream import Stream


class StreamHeat(Heat):
    """Enthalpies of the species of a mixture; liquids and solids that do not crystallize come along (kg per
    second of feed).
    """

    mixture: Mixture = eqx.field(static=True)
    found: Roles = eqx.field(static=True)
    other_liquids: Any
    other_solids: Any

    @classmethod
    def of(cls, feed: Stream, found: Roles) -> StreamHeat:
        """From the feed of a crystallizer."""
        liquids = feed.liquid.at[found.solute].set(0.0).at[found.solvent].set(0.0)
        return cls(feed.mixture, found, liquids, jnp.asarray(feed.solid_by_species).at[found.solid].set(0.0))

    def _enthalpy(self, T: Any, contents: Contents, crystals: Any) -> Any:
        liquid, solid = (self.mixture.enthalpies(phase, T) for phase in ("liquids", "solids"))
        x = self.found.solute_fraction
        left = self.other_liquids.at[self.found.solute].add(contents.solute - x * crystals)
        left = left.at[self.found.solvent].add(contents.solvent - (1.0 - x) * crystals)
        flow = crystals * solid[self.found.solid] + jnp.sum(self.other_solids * solid)
        return flow + jnp.sum(left * liquid) + self.mixture.heat_of_mixing(left, T)

    def capacity(self, contents: Contents, crystals: Any) -> Any:
        T = jnp.asarray(contents.temperature, dtype=float)
        return jax.jvp(lambda T: self._enthalpy(T, contents, crystals), (T,), (jnp.ones_like(T),))[1]

    def freed(self, old: Contents, crystals_before: Any, temperature: Any, crystals: Any) -> Any:
        return self._enthalpy(old.temperature, old, crystals_before) - self._enthalpy(
            temperature, old, crystals
        )

    def latent(self, temperature: Any) -> Any:
        """Heat of vaporization of the solvent, J/kg."""
        assert self.found.vapor is not None
        vapor = self.mixture.enthalpies("gases", temperature)[self.found.vapor]
        return vapor - self.mixture.enthalpies("liquids", temperature)[self.found.solvent]
