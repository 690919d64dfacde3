"""The salts of a stream as a brine: what is there of their ions, and the stream once crystals have formed."""

from __future__ import annotations

from typing import Any, NamedTuple

import jax.numpy as jnp
import numpy as np

from granum.core import flags
from granum.core.errors import CaseError
from granum.core.i18n import _
from granum.crystallization.equipment.roles import Roles, with_crystals
from granum.materials.brines import SOLVENT, Brine, find_brine
from granum.materials.correlation import Owner
from granum.materials.formulas.activity import WATER
from granum.numerics.smooth import safe_divide
from granum.particles.size_laws import LogNormal
from granum.streams.mixture import Mixture
from granum.streams.stream import Stream

SLACK = 1e-6
DOUBLE = (
    "This double salt would crystallize too: give it among the solids of the mixture, and it does; or add "
    "water, or keep out one of its salts."
)


class Crystallizing(NamedTuple):
    """A crystal of the mixture: its place among the solids and among the crystals of the brine."""

    solid: int
    crystal: int


class Salts(NamedTuple):
    """Salts of a mixture: the brine, the place of each of its salts among the liquids, the crystals."""

    brine: Brine
    liquids: tuple[int, ...]
    forming: tuple[Crystallizing, ...]

    @property
    def which(self) -> tuple[int, ...]:
        """Those of the brine's crystals that the mixture has."""
        return tuple(f.crystal for f in self.forming)

    @property
    def crystal_masses(self) -> np.ndarray:
        """Of each crystal of the mixture, kg/mol."""
        forms = [self.brine.crystals[k] for k in self.which]
        dry = [f.salts @ self.brine.molar_masses for f in forms]
        wet = [WATER * f.water if f.branch is None else 0.0 for f in forms]
        ratios = [1.0 if f.branch is None else float(f.branch.hydrate_ratio) for f in forms]
        return np.array(dry) * np.array(ratios) + np.array(wet)

    @property
    def made_of(self) -> np.ndarray:
        """kg of each liquid of the brine's salts, and of water as the last, in a mole of each crystal."""
        table = np.zeros((len(self.forming), len(self.brine.salts) + 1))
        for row, k in enumerate(self.which):
            table[row, :-1] = self.brine.crystals[k].salts * self.brine.molar_masses
            table[row, -1] = self.crystal_masses[row] - np.sum(table[row, :-1])
        return table

    def dissolved(self, liquid: Any) -> Any:
        """Mol of each salt of the brine in a liquid."""
        there = jnp.asarray(self.liquids)
        return liquid[there] / jnp.asarray(self.brine.molar_masses[: len(self.liquids)])

    def all_dissolved(self, feed: Stream) -> Any:
        """The liquid of a stream once its crystals of these salts have dissolved, kg/s."""
        liquid, there = feed.liquid, jnp.asarray(self.liquids)
        for f, made, mass in zip(self.forming, self.made_of, self.crystal_masses, strict=True):
            share = jnp.sum(feed.solid[f.solid]) / mass
            liquid = liquid.at[there].add(share * made[: len(self.liquids)]).at[0].add(share * made[-1])
        return liquid

    def ions(self, liquid: Any) -> Any:
        """Mol of each ion in a liquid."""
        return self.dissolved(liquid) @ jnp.asarray(self.brine.ions_per_salt[: len(self.liquids)])

    def left(self, liquid: Any, crystals: Any) -> Any:
        """A liquid after crystals (mol/s) have left it; where one salt is used up, others give its ions."""
        moles = self.dissolved(liquid)
        for k, n in zip(self.which, crystals, strict=True):
            moles = moles - n * jnp.asarray(self.brine.crystals[k].salts[: len(self.liquids)])
        if len(self.liquids) == 4:
            moles = moles + _exchanged(self.brine, moles)
        masses = jnp.asarray(self.brine.molar_masses[: len(self.liquids)])
        water = jnp.sum(crystals * jnp.asarray(self.made_of[:, -1]))
        return liquid.at[jnp.asarray(self.liquids)].set(moles * masses).at[0].add(-water)

    def heard(self, T: Any, molalities: Any) -> None:
        """Record where a liquor lies outside what is known, and double salts that would crystallize from it
        but are not among the solids of the mixture.
        """
        self.brine.heard(T, molalities)
        ratios = jnp.exp(self.brine.saturation(T, molalities))
        for k, form in enumerate(self.brine.crystals):
            if form.double is not None and k not in self.which:
                owner = Owner.of_property(form.name, "solubility", form.solid.french)
                about = ratios[k] > 1.0 + SLACK, ratios[k], "saturation_ratio", owner, 0.0, 1.0
                flags.record(flags.EXTRAPOLATED, *about, reason=DOUBLE)

    def crystallized(self, feed: Stream, crystals: Any, sizes: LogNormal) -> Any:
        """The solid of a stream with so much of each crystal (mol/s): what is more has the given sizes, what
        is less leaves in all classes alike.
        """
        passing = sizes(jnp.asarray(feed.mixture.edges)).at[0].set(0.0).at[-1].set(1.0)
        fresh, solid = jnp.diff(passing), feed.solid
        for f, n, mass in zip(self.forming, crystals, self.crystal_masses, strict=True):
            fed = jnp.sum(feed.solid[f.solid], axis=tuple(range(1, feed.solid[0].ndim)))
            before, made = jnp.sum(fed), n * mass
            classes = fed * jnp.minimum(safe_divide(made, before, 0.0), 1.0)
            classes = classes + fresh * jnp.maximum(made - before, 0.0)
            place = Roles(f.solid, 0, 0, None, 1.0)
            solid = with_crystals(feed.replace(solid=solid), place, classes)
        return solid


def _exchanged(brine: Brine, moles: Any) -> Any:
    """The least exchange of ions after which there is nothing negative of four salts of two cations and two
    anions.
    """
    table = brine.ions_per_salt
    # one and its opposite gain what the two others lose: what leaves all ions as they are
    gain = np.linalg.svd(table.T)[2][-1]
    gain = jnp.asarray(gain / gain[0])
    low = jnp.max(jnp.where(gain > 0.0, -moles / gain, -jnp.inf))
    high = jnp.min(jnp.where(gain < 0.0, -moles / gain, jnp.inf))
    return gain * jnp.clip(0.0, low, jnp.maximum(high, low))


def salts_of(mixture: Mixture) -> Salts | None:
    """The salts of a mixture where it has two or more, all of them known beside each other in water; None
    where it has not.
    """
    names = [s.name for s in mixture.liquids]
    if len(names) < 3 or names[0] != SOLVENT:
        return None
    found = find_brine(names[1:], mixture.materials)
    if found is None:
        return None
    forming = tuple(
        Crystallizing(i, k)
        for i, solid in enumerate(mixture.solids)
        for k, crystal in enumerate(found.crystals)
        if crystal.name == solid.name
    )
    missing = [s.name for s in found.salts[len(names) - 1 :]]
    if missing and forming:
        raise CaseError(
            _(
                "The ions of the dissolved salts also make {salts}: add these to the liquids of the mixture, "
                "and to the solids what may crystallize of them."
            ).format(salts=", ".join(missing))
        )
    return Salts(found, tuple(range(1, len(names))), forming)
