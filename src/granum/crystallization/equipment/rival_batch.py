"""A batch vessel in which two crystals grow or dissolve side by side, in cycles: what enantiomers and
polymorphs share.
"""

from __future__ import annotations

from abc import abstractmethod
from typing import Any, ClassVar, NamedTuple

import equinox as eqx
import jax.numpy as jnp

from granum.core.errors import CaseError
from granum.core.flags import unsolved
from granum.core.i18n import _
from granum.core.kinds import Distance, Length, MassRatio, PositiveNumber, Time
from granum.crystallization.equipment.batch import STEPS, TRICKLE, BatchOutlets, BatchVessel, thermal
from granum.crystallization.equipment.roles import Roles, crystal_of, feed_of, roles, with_crystals
from granum.crystallization.equipment.stirring import SUSPENDED, Stirred
from granum.crystallization.kinds import Program
from granum.crystallization.population.packets import Seeds
from granum.crystallization.population.rivals import Rivals, Row, State, compete
from granum.crystallization.vessels.batch import narrow_seeds
from granum.crystallization.vessels.crystals import Crystal
from granum.numerics.smooth import safe_divide
from granum.streams.mixture import Mixture
from granum.streams.stream import Stream
from granum.streams.units import Limits, Unit, Utilities
from granum.streams.utilities import COOLED, HEATED, STIRRED

SLACK = 1e-9
SEED_GONE = (
    "More seed is held back for the next batch than crystals of its form are left at the end, as they "
    "dissolve: give less seed, a shorter batch or a colder one, or let the seed come with the feed."
)


class Cut(NamedTuple):
    """A sieve cut of seeds: size, width and mass per kg of solvent."""

    size: Any
    width: Any
    mass: Any


class Contested(NamedTuple):
    """The batch of one kg of solvent at its end and over time, the solvent (kg/s), which species play which
    part, and the seeds of both crystals that are held back per kg of solvent.
    """

    end: State
    course: Row
    times: Any
    solvent: Any
    found: tuple[Roles, Roles]
    held: Any

    @property
    def leaving(self) -> Any:
        """Crystals of both beside those held back, kg per kg of solvent, over time."""
        return jnp.maximum(self.course.masses - self.held, 0.0)


class RivalBatch(Stirred, Unit):
    """What the vessels with two crystals share; each says which two they are and what they do."""

    temperature_program: Program
    duration: Time = eqx.field(kw_only=True)
    dead_time: Time = eqx.field(kw_only=True, default=3600.0)
    seed_mass_per_solvent: MassRatio = eqx.field(kw_only=True, default=0.0)
    seed_size: Length = eqx.field(kw_only=True, default=100e-6)
    seed_width: Distance = eqx.field(kw_only=True, default=0.0)
    volume_shape_factor: PositiveNumber = eqx.field(kw_only=True, default=1.0)
    solid: str = eqx.field(kw_only=True, static=True, default="")
    solvent: str = eqx.field(kw_only=True, static=True, default="")

    limits: ClassVar[Limits] = {
        "crowded": BatchVessel.limits["crowded"],
        "largest": BatchVessel.limits["largest"],
        "present": BatchVessel.limits["present"],
    } | SUSPENDED
    utilities: ClassVar[Utilities] = STIRRED | HEATED | COOLED

    @property
    def cycle(self) -> Any:
        """Time from charge to charge, s."""
        return self.duration + self.dead_time

    @abstractmethod
    def _names(self, mixture: Mixture) -> tuple[str, str]:
        """Both crystals, by their names among the solids."""

    @abstractmethod
    def _rivals(self, feed: Stream, crystals: tuple[Crystal, Crystal]) -> Rivals:
        """What both do."""

    def _cuts(self) -> tuple[Cut, Cut]:
        """The seeds of both that are held back."""
        return Cut(self.seed_size, self.seed_width, self.seed_mass_per_solvent), Cut(self.seed_size, 0.0, 0.0)

    def _shapes(self) -> tuple[Any, Any]:
        """Volume shape factors of both."""
        return self.volume_shape_factor, self.volume_shape_factor

    def _roles(self, mixture: Mixture) -> tuple[Roles, Roles]:
        """Species of both crystals."""
        names = self._names(mixture)
        found = (roles(mixture, names[0], self.solvent), roles(mixture, names[1], self.solvent))
        for name, role in zip(names, found, strict=True):
            if role.solute_fraction < 1.0:
                raise CaseError(
                    _("'{name}' binds solvent, which this crystallizer does not follow.").format(name=name)
                )
        return found

    def _heard(self, course: Row, feed: Stream, found: tuple[Roles, Roles]) -> None:
        """Record what a reader must know of the batch; nothing, where nothing is asked."""

    def inside(self, feed: Stream) -> Contested:
        found, edges = self._roles(feed.mixture), jnp.asarray(feed.mixture.edges)
        one, other = (
            crystal_of(feed.mixture, role, feed.temperature, shape)
            for role, shape in zip(found, self._shapes(), strict=True)
        )
        rivals = self._rivals(feed, (one, other))
        given = feed.liquid[found[0].solvent]
        W = jnp.where(given > 0.0, given, TRICKLE)
        low, high = edges[:-1], edges[1:]

        def seeding(role: Roles, crystal: Crystal, added: Cut) -> Seeds:
            cut = narrow_seeds(added.size, added.width, added.mass, crystal.mass_per_cube)
            cubes = crystal.mass_per_cube * 0.25 * (low + high) * (low**2 + high**2)
            # without a liquor they stay what they are
            fed = jnp.where(given > 0.0, feed_of(feed, role).crystals / (W * cubes), 0.0)
            return Seeds(jnp.append(cut.low, low), jnp.append(cut.high, high), jnp.append(cut.number, fed))

        cuts = self._cuts()
        held = jnp.stack([jnp.asarray(cut.mass, dtype=float) for cut in cuts])
        solutes = [found[rivals.solutes.index(i)].solute for i in sorted(set(rivals.solutes))]
        times = jnp.linspace(0.0, self.duration, STEPS + 1)
        end, course = compete(
            rivals,
            (seeding(found[0], one, cuts[0]), seeding(found[1], other, cuts[1])),
            self.temperature_program,
            jnp.stack([jnp.where(given > 0.0, feed.liquid[place] / W, 0.0) for place in solutes]),
            times,
        )
        for law in {id(form.solubility): form.solubility for form in rivals.forms}.values():
            law(course.temperature)  # once more where its flags are heard
        self._heard(course, feed, found)
        kept = jnp.all(course.masses[-1] >= (1.0 - SLACK) * held)
        unsolved(kept | (given <= 0.0), type(self).card, reason=SEED_GONE)
        return Contested(end, course, times, W, found, held)

    def outlets(self, inside: Contested, feed: Stream) -> BatchOutlets:
        solid, liquid = feed.solid, feed.liquid
        for role, packets, left in zip(inside.found, inside.end.crystals, inside.leaving[-1], strict=True):
            classes = packets.in_classes(feed.mixture.edges)
            classes = classes * safe_divide(left * inside.solvent, jnp.sum(classes), 0.0)
            classes = jnp.where(inside.solvent > TRICKLE, classes, feed_of(feed, role).crystals)
            solid = with_crystals(feed.replace(solid=solid), role, classes)
            gained = jnp.sum(feed.solid[role.solid]) - jnp.sum(solid[role.solid])
            liquid = liquid.at[role.solute].add(gained)
        T = jnp.asarray(inside.course.temperature[-1], dtype=float)
        product = feed.replace(solid=solid, liquid=liquid, temperature=T)
        return BatchOutlets(product, product.enthalpy_flow - feed.enthalpy_flow)

    def _seed(self, inside: Contested) -> Any:
        """Mass of seed held back in each cycle of the whole flow, kg."""
        return jnp.sum(inside.held) * inside.solvent * self.cycle

    def _common(self, inside: Contested, outlets: BatchOutlets, volume: Any) -> dict[str, Any]:
        """What is checked of either vessel, beside what makes crystals ``present``."""
        product = outlets.product
        return {
            "crowded": product.solids_volume_fraction,
            "largest": product.size_fractions[-1],
        } | self.stirrer_measured(product, volume)

    def drawn(self, inside: Contested, outlets: BatchOutlets, figures: Any, feed: Stream) -> dict[str, Any]:
        stirrer = self.stirrer_power(outlets.product, figures.volume)
        return thermal(outlets.heat_duty, feed, outlets.product) | stirrer
