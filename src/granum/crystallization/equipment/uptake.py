"""What growing crystals take up of their mother liquor: impurity in the lattice, liquor in inclusions."""

from __future__ import annotations

from typing import Any, NamedTuple

import equinox as eqx
import jax.numpy as jnp

from granum.core import equipment
from granum.core.errors import CaseError
from granum.core.flags import unsolved
from granum.core.i18n import _
from granum.core.kinds import MassFraction, PositiveNumber, Ratio
from granum.crystallization.equipment.roles import Roles, roles
from granum.crystallization.kinds import InclusionShare
from granum.numerics.smooth import safe_divide
from granum.streams.from_materials import taken_up_name
from granum.streams.stream import Stream
from granum.streams.units import Unit

TOO_FULL = (
    "The inclusions would hold more liquor than there is: give a smaller 'inclusion_fraction' or more liquor."
)


class TakenUp(NamedTuple):
    """Crystals with what they have taken up, in their liquor."""

    product: Stream


class UptakeFigures(NamedTuple):
    """Impurity of the crystals themselves and of their liquor, by mass."""

    impurity_lattice: MassFraction
    impurity_inclusions: MassFraction
    impurity_fraction_product: MassFraction
    impurity_fraction_liquor: MassFraction
    purification_factor: PositiveNumber


class Shared(NamedTuple):
    """Impurity in lattice and inclusions, each liquid species in the crystals and in the
    liquor (kg/s), and who is who.
    """

    lattice: Any
    shut_in: Any
    within: Any
    left: Any
    impurity: int
    homes: tuple[int | None, ...]
    found: Roles


@equipment(
    "impurity_uptake",
    source="iupac1997; nyvlt1995",
    title="Impurity that crystals take up from their mother liquor",
    equation=(
        r"\frac{\dot m_{i,c}}{\dot m_{s,c}} = D\,\frac{\dot m_{i,l}}{\dot m_{s,l}},\quad \dot V_{incl} = "
        r"\frac{\varphi}{1-\varphi}\,\frac{\dot m_c}{\rho_c}"
    ),
)
class ImpurityUptake(Unit):
    """Shares an impurity between crystals and mother liquor of a suspension, as they leave a mixed
    crystallizer: built into the lattice by a distribution coefficient, and shut in with whole liquor.

    Stands behind any crystallizer. What crystals hold is a solid species of its own, ``NAME in crystals``,
    which filter, wash and dryer carry along; only what adheres can be washed off. Lattice: the homogeneous
    distribution of a mixed vessel, impurity per solute in the crystal over that in the liquor. Inclusions
    hold all species of the liquor, so that the mixture needs each of them in crystals. Crystals that came
    with the feed count as grown here; a second one of the same figures changes nothing. The size of the
    crystals and their growth rate are not counted: give what was measured at those of the plant.
    What stays dissolved where a dryer dries the cake needs its plain name among the solids too. Nývlt and
    Ulrich (1995) were not opened; the homogeneous law is that of the Gold Book.
    """

    distribution_coefficient_solution: Ratio
    inclusion_fraction: InclusionShare | None = eqx.field(kw_only=True, default=None)
    impurity: str = eqx.field(kw_only=True, static=True, default="")
    solid: str = eqx.field(kw_only=True, static=True, default="")
    solvent: str = eqx.field(kw_only=True, static=True, default="")

    def _impurity(self, feed: Stream, found: Roles) -> int:
        mixture = feed.mixture
        if self.impurity:
            place = mixture.index("liquids", self.impurity)
            if place in (found.solute, found.solvent):
                raise CaseError(
                    _("'{name}' cannot be the impurity: it is the solute or the solvent.").format(
                        name=self.impurity
                    )
                )
            return place
        rest = [i for i in range(len(mixture.liquids)) if i not in (found.solute, found.solvent)]
        if len(rest) != 1:
            raise CaseError(
                _(
                    "Which liquid is the impurity? Beside solute and solvent the mixture has {liquids}: name "
                    "one as 'impurity'."
                ).format(liquids=", ".join(mixture.liquids[i].name for i in rest) or "—")
            )
        return rest[0]

    def _homes(self, feed: Stream, impurity: int) -> tuple[int | None, ...]:
        """Where each liquid species stands among the solids once it is in the crystals."""
        names = [s.name for s in feed.mixture.solids]
        wanted = [taken_up_name(s.name) for s in feed.mixture.liquids]
        needed = wanted if self.inclusion_fraction is not None else [wanted[impurity]]
        lacking = [name for name in needed if name not in names]
        if lacking:
            raise CaseError(
                _("What crystals take up needs its place: add {names} to the solids of the mixture.").format(
                    names=", ".join(f"'{name}'" for name in lacking)
                )
            )
        return tuple(names.index(name) if name in names else None for name in wanted)

    def inside(self, feed: Stream) -> Shared:
        mixture = feed.mixture
        found = roles(mixture, self.solid, self.solvent)
        impurity = self._impurity(feed, found)
        homes = self._homes(feed, impurity)
        solid = feed.solid_by_species
        had = jnp.stack([jnp.zeros(()) if home is None else solid[home] for home in homes])
        both = feed.liquid + had
        crystals = solid[found.solid]
        bound = self.distribution_coefficient_solution * found.solute_fraction * crystals
        lattice = both[impurity] * safe_divide(bound, both[found.solute] + bound, 0.0)
        liquor = both.at[impurity].add(-lattice)
        share = jnp.zeros(())
        if self.inclusion_fraction is not None:
            T, phi = feed.temperature, self.inclusion_fraction
            room = phi / (1.0 - phi) * crystals / mixture.densities("solids", T)[found.solid]
            share = safe_divide(room, jnp.sum(liquor / mixture.densities("liquids", T)), 0.0)
            unsolved(share <= 1.0, type(self).card, reason=TOO_FULL)
        within = (share * liquor).at[impurity].add(lattice)
        return Shared(lattice, share * liquor[impurity], within, both - within, impurity, homes, found)

    def outlets(self, inside: Shared, feed: Stream) -> TakenUp:
        crystal = feed.solid[inside.found.solid]
        spread = safe_divide(crystal, jnp.sum(crystal), 0.0)
        solid, liquid = feed.solid, feed.liquid
        for place, home in enumerate(inside.homes):
            if home is not None:
                solid = solid.at[home].set(inside.within[place] * spread)
                liquid = liquid.at[place].set(inside.left[place])
        return TakenUp(feed.replace(solid=solid, liquid=liquid))

    def figures(self, inside: Shared, outlets: TakenUp, feed: Stream) -> UptakeFigures:
        product, found, place = outlets.product, inside.found, inside.impurity
        crystals = product.solid_by_species[found.solid]
        whole = crystals + jnp.sum(inside.within)
        lattice, shut_in = (safe_divide(x, whole, 0.0) for x in (inside.lattice, inside.shut_in))
        solute = found.solute_fraction * crystals + inside.within[found.solute]
        # impurity per solute in the crystals over that in the liquor, without dividing by the impurity
        bound = self.distribution_coefficient_solution * found.solute_fraction * crystals
        kept = safe_divide(bound + inside.within[found.solute], solute, 1.0)
        return UptakeFigures(
            lattice,
            shut_in,
            lattice + shut_in,
            product.liquid_fractions[place],
            1.0 / jnp.maximum(kept, 1e-12),
        )
