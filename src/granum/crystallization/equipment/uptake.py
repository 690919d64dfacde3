"""What growing crystals take up of their mother liquor: impurity in the lattice, liquor in inclusions."""

from __future__ import annotations

from typing import Annotated, Any, Literal, NamedTuple

import equinox as eqx
import jax.numpy as jnp

from granum.core import equipment
from granum.core.errors import CaseError
from granum.core.flags import unsolved
from granum.core.i18n import _, quoted
from granum.core.kinds import Distance, Law, MassFraction, PositiveNumber, Ratio
from granum.crystallization.equipment.roles import Roles, roles
from granum.crystallization.formulas.inclusions import LARGEST, inclusion_fraction_mean
from granum.crystallization.formulas.purity import impurity_share_crystallized
from granum.crystallization.kinds import InclusionShare
from granum.numerics.smooth import safe_divide
from granum.streams.from_materials import taken_up_name
from granum.streams.stream import Stream
from granum.streams.units import Unit

TOO_FULL = (
    "The inclusions would hold more liquor than there is: give a smaller 'inclusion_fraction' or more liquor."
)
RUN_DOWN = (
    "In this liquor the crystals no longer grow, so that it does not tell the rate at which they shut liquor "
    "in: give the size from which they do, by 'onset_size'."
)


class TakenUp(NamedTuple):
    """Crystals with what they have taken up, in their liquor."""

    product: Stream


class UptakeFigures(NamedTuple):
    """Impurity of the crystals themselves and of their liquor, by mass."""

    impurity_lattice: MassFraction
    impurity_inclusions: MassFraction
    inclusion_onset_size: Distance
    inclusion_fraction_mean: InclusionShare
    impurity_fraction_product: MassFraction
    impurity_fraction_liquor: MassFraction
    purification_factor: PositiveNumber


class Shared(NamedTuple):
    """Shares of the impurity in the lattice and of the remaining liquor in inclusions, impurity in both and
    each liquid species in the crystals and in the liquor (kg/s), how the inclusions are spread over the
    sizes, the size they begin at, their share of all crystals, and who is who.
    """

    lattice_share: Any
    liquor_share: Any
    lattice: Any
    shut_in: Any
    within: Any
    left: Any
    spread: Any
    onset: Any
    mean: Any
    impurity: int
    homes: tuple[int | None, ...]
    found: Roles


@equipment(
    "impurity_uptake",
    source="iupac1997; doerner1925; denbigh1966; carlson1958",
    title="Impurity that crystals take up from their mother liquor",
    equation=(
        r"\frac{\dot m_{i,c}}{\dot m_{s,c}} = D\,\frac{\dot m_{i,l}}{\dot m_{s,l}},\quad \dot V_{incl} = "
        r"\sum_L\frac{\varphi(L)}{1-\varphi(L)}\,\frac{\dot m_c(L)}{\rho_c},\quad \varphi(L) = "
        r"\varphi\left(1 - \min(1, L_i/L)^3\right)"
    ),
)
class ImpurityUptake(Unit):
    """Shares an impurity between crystals and mother liquor of a suspension, as they leave a mixed
    crystallizer: built into the lattice by a distribution coefficient, and shut in with whole liquor.

    Stands behind any crystallizer. What crystals hold is a solid species of its own, ``NAME in crystals``,
    which filter, wash and dryer carry along; only what adheres can be washed off. Lattice: the homogeneous
    distribution of a mixed vessel, impurity per solute in the crystal over that in the liquor, or for a batch
    the logarithmic one, in which each layer keeps what the liquor had when it grew. Inclusions hold all
    species of the liquor, so that the mixture needs each of them in crystals. Their fraction is that of what
    grows once a crystal is larger than the onset, a measured size or the one that the growth rate in this
    liquor leaves clear; without an onset, of all that grew. Crystals that came with the feed count as grown
    here; a second one of the same figures changes nothing. What stays dissolved where a dryer dries the cake
    needs its plain name among the solids too. Carlson, Denbigh and White, Doerner and Hoskins were not
    opened; both laws of distribution are those of the Gold Book.
    """

    distribution_coefficient_solution: Ratio
    inclusion_fraction: InclusionShare | None = eqx.field(kw_only=True, default=None)
    inclusion_onset: Annotated[Any, Law("inclusion_onset")] | None = eqx.field(kw_only=True, default=None)
    distribution_law: Literal["homogeneous", "logarithmic"] = eqx.field(
        kw_only=True, static=True, default="homogeneous"
    )
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
                    names=", ".join(quoted(name) for name in lacking)
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
        crystals, T, sizes = solid[found.solid], feed.temperature, feed.solid[found.solid]
        bound = self._lattice_share(found.solute_fraction * crystals, both[found.solute])
        lattice = bound * both[impurity]
        liquor = both.at[impurity].add(-lattice)
        share, onset, mean = jnp.zeros(()), jnp.zeros(()), jnp.zeros(())
        spread = safe_divide(sizes, crystals, 0.0)
        if self.inclusion_fraction is not None:
            density = mixture.densities("solids", T)[found.solid]
            onset = self._onset(both, found, feed, density, crystals)
            length = jnp.asarray(mixture.sizes).reshape((-1,) + (1,) * (sizes.ndim - 1))
            phi = inclusion_fraction_mean.function(length, onset, self.inclusion_fraction)
            rooms = phi / (1.0 - phi) * sizes / density
            room = jnp.sum(rooms)
            share = safe_divide(room, jnp.sum(liquor / mixture.densities("liquids", T)), 0.0)
            unsolved(share <= 1.0, type(self).card, reason=TOO_FULL)
            spread = safe_divide(rooms, room, spread)
            mean = safe_divide(room, room + crystals / density, 0.0)
        within = (share * liquor).at[impurity].add(lattice)
        return Shared(
            bound,
            share,
            lattice,
            share * liquor[impurity],
            within,
            both - within,
            spread,
            onset,
            mean,
            impurity,
            homes,
            found,
        )

    def _lattice_share(self, crystallized: Any, dissolved: Any) -> Any:
        """Of all the impurity, that which the lattice of the crystals holds."""
        shares = impurity_share_crystallized.function(
            self.distribution_coefficient_solution,
            safe_divide(crystallized, crystallized + dissolved, 0.0),
        )
        even = self.distribution_law == "homogeneous"
        return shares.impurity_share_homogeneous if even else shares.impurity_share_logarithmic

    def _onset(self, liquor: Any, found: Roles, feed: Stream, crystal_density: Any, crystals: Any) -> Any:
        """Size up to which the crystals grew clear, m."""
        if self.inclusion_onset is None:
            return jnp.zeros(())
        onset = self.inclusion_onset(
            safe_divide(liquor[found.solute], liquor[found.solvent], 0.0),
            feed.temperature,
            feed.liquid_density,
            crystal_density,
        )
        unsolved((onset < LARGEST) | (crystals <= 0.0), type(self).card, reason=RUN_DOWN)
        return onset

    def outlets(self, inside: Shared, feed: Stream) -> TakenUp:
        crystal = feed.solid[inside.found.solid]
        even = safe_divide(crystal, jnp.sum(crystal), 0.0)
        solid, liquid = feed.solid, feed.liquid
        for place, home in enumerate(inside.homes):
            if home is not None:
                bound = inside.lattice if place == inside.impurity else 0.0
                solid = solid.at[home].set(bound * even + (inside.within[place] - bound) * inside.spread)
                liquid = liquid.at[place].set(inside.left[place])
        return TakenUp(feed.replace(solid=solid, liquid=liquid))

    def figures(self, inside: Shared, outlets: TakenUp, feed: Stream) -> UptakeFigures:
        product, found, place = outlets.product, inside.found, inside.impurity
        crystals = product.solid_by_species[found.solid]
        whole = crystals + jnp.sum(inside.within)
        lattice, shut_in = (safe_divide(x, whole, 0.0) for x in (inside.lattice, inside.shut_in))
        solute = found.solute_fraction * crystals + inside.within[found.solute]
        # impurity per solute in the crystals over that in the liquor, without dividing by the impurity
        f, taken = inside.lattice_share, inside.liquor_share
        over = safe_divide(f + taken * (1.0 - f), (1.0 - taken) * (1.0 - f), 1.0)
        kept = safe_divide(over * inside.left[found.solute], solute, 1.0)
        return UptakeFigures(
            lattice,
            shut_in,
            inside.onset,
            inside.mean,
            lattice + shut_in,
            product.liquid_fractions[place],
            1.0 / jnp.maximum(kept, 1e-12),
        )
