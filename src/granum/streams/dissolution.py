"""Crystals that dissolve in the wash liquor of their own cake: what washing costs in yield."""

from __future__ import annotations

from typing import Any

import equinox as eqx
import jax.numpy as jnp
import numpy as np

from granum.core import law
from granum.core.errors import InputError
from granum.core.i18n import _
from granum.core.kinds import Fraction, MassFlow, MassRatio
from granum.streams.cakes import Filtered
from granum.streams.mixture import Mixture
from granum.streams.stream import Stream

MOST = 0.999  # of the crystals: a cake remains


def dissolved_share(feed: Stream, recovery: Any, cake: Stream) -> Any:
    """Share of the solid caught that the wash has dissolved."""
    caught = recovery * feed.solid_flow
    return jnp.clip(1.0 - cake.solid_flow / jnp.where(caught > 0, caught, 1.0), 0.0, 1.0) * (caught > 0)


@law("wash_dissolution", name="saturating_wash", source="wakeman2005", title="Crystals dissolved by the wash")
class SaturatingWash(eqx.Module):
    """Wash liquor takes up crystal on its way until it is saturated, or a share of what it lacks.

    The solubility is that of the solute at the temperature of washing, in mass per mass of solvent; a wash
    that is itself saturated dissolves nothing. Every size loses the same share. Short contact of coarse
    crystals needs an approach below 1; without a test, 1 is the safe assumption. Solid and solute are the
    species of one name; a hydrate gives its water back too.

    >>> float(
    ...     SaturatingWash(crystal="potassium nitrate", solvent="water", solubility="320 g/kg")(
    ...         solvent_flow=1.0, solute_flow=0.1
    ...     )
    ... )
    0.22
    """

    crystal: str
    solvent: str
    solubility: MassRatio
    approach: Fraction = 1.0

    def __call__(
        self, solvent_flow: MassFlow, solute_flow: MassFlow, solute_fraction: Fraction = 1.0
    ) -> MassFlow:
        """Crystal that a liquor dissolves per time; infinite where a hydrate would melt in its own water."""
        # solute beyond saturation per crystal dissolved
        gain = solute_fraction - self.solubility * (1.0 - solute_fraction)
        need = jnp.maximum(self.solubility * solvent_flow - solute_flow, 0.0)
        return self.approach * jnp.where(gain > 0, need / jnp.where(gain > 0, gain, 1.0), jnp.inf)

    def out_of(self, parted: Filtered) -> Filtered:
        """The same cake and washings after dissolution, at the temperature that the heat of solution
        leaves.
        """
        m = parted.cake.mixture
        row, solvent = m.index("solids", self.crystal), m.index("liquids", self.solvent)
        take, solute = self._taken(m, row, solvent)
        crystals = jnp.sum(parted.cake.solid[row])
        wanted = jnp.stack(
            [self(x.liquid[solvent], x.liquid[solute], take[solute]) for x in (parted.cake, parted.washings)]
        )
        total = jnp.minimum(jnp.sum(wanted), MOST * crystals)
        part = jnp.where(jnp.isfinite(wanted), wanted, 1.0)
        part = total * part / jnp.where(jnp.sum(part) > 0, jnp.sum(part), 1.0)
        left = 1.0 - total / jnp.where(crystals > 0, crystals, 1.0)
        heat = parted.cake.enthalpy_flow + parted.washings.enthalpy_flow
        cake = parted.cake.replace(
            solid=parted.cake.solid.at[row].multiply(left), liquid=parted.cake.liquid + part[0] * take
        )
        washings = parted.washings.replace(liquid=parted.washings.liquid + part[1] * take)
        both = (cake + washings).at_enthalpy(heat)
        return Filtered(
            cake.replace(temperature=both.temperature),
            parted.filtrate,
            washings.replace(temperature=both.temperature),
        )

    def _taken(self, m: Mixture, row: int, solvent: int) -> tuple[np.ndarray, int]:
        """Liquid species made per crystal dissolved, and which of them is the solute."""
        shares = dict(m.solids[row].composition)
        homes = {
            name: next((i for i, s in enumerate(m.liquids) if s.composition == ((name, 1.0),)), None)
            for name in shares
        }
        solutes = [i for i in homes.values() if i is not None and i != solvent]
        if None in homes.values() or len(solutes) != 1:
            raise InputError(
                _(
                    "The crystal '{crystal}' must be made of one dissolved species and, as a hydrate, "
                    "of its solvent '{solvent}'."
                ).format(crystal=self.crystal, solvent=self.solvent),
                name="crystal",
            )
        take = np.zeros(len(m.liquids))
        for name, i in homes.items():
            take[i] += shares[name]
        return take, solutes[0]
