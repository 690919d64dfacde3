"""One effect: a solution that boils at a pressure, heated through a wall by what condenses behind it.

Temperature is the one unknown. At each temperature the heat balance says how much boils off and how much
crystallizes, and the solution left has one boiling point at the pressure; it must be that temperature.
"""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from typing import Any, NamedTuple

import jax
import jax.numpy as jnp
import numpy as np

from granum.core import flags
from granum.core.errors import CaseError
from granum.core.i18n import _
from granum.crystallization.equipment.brines import Salts, salts_of
from granum.crystallization.equipment.roles import Roles, roles, with_crystals
from granum.materials.brines import DRIEST, Boiling
from granum.materials.fluids import Fluid
from granum.materials.saturated_heats import is_measured
from granum.materials.solutes import REFERENCE, Branch
from granum.numerics import find_root
from granum.numerics.smooth import safe_divide
from granum.particles.size_laws import LogNormal
from granum.streams.from_materials import activity_laws, solute_system
from granum.streams.mixture import Mixture
from granum.streams.stream import Stream, empty

TOLD = 0.02  # of a duty: heats of dilution beyond that are told
DILUTION = "The heat of dilution of this liquor is left out; it is more than 2 % of the duty here."
PASSES = 8  # of Newton's method, for what a liquor takes as it thickens
REPEATS = 14  # of the same by repeated substitution, where salts crystallize together
SPAN = 80.0  # K above the boiling point of the solvent within which a solution is sought that boils


class Effect(NamedTuple):
    """What happens in one effect; ``crystals`` are those that form, ``taken`` is the heat with which what
    leaves was made: the duty, unless that is more than boils off the solvent or less than warms the feed;
    ``found`` is whether a boiling solution was found, ``left`` the share that stays of the solvent that no
    crystal binds.
    """

    temperature: Any
    pure: Any
    pressure: Any
    evaporation: Any
    crystals: Any
    product: Stream
    vapor: Stream
    duty: Any
    taken: Any
    found: Any
    left: Any


class _Split(NamedTuple):
    """Evaporation and each crystal at a temperature, the liquid that is left, and how much could evaporate:
    not what a hydrate binds.
    """

    evaporation: Any
    crystals: list[Any]
    liquid: Any
    most: Any


class Forming(NamedTuple):
    """A crystal of the solute: who plays which part, its branch of the solubility, and the temperatures
    between which no other crystal of the solute forms, K.
    """

    roles: Roles
    branch: Branch
    low: float
    high: float


@dataclass(frozen=True)
class Liquor:
    """The solution of a mixture: its solvent, what its solutes do to the boiling point, its crystal."""

    mixture: Mixture
    elevation: tuple[Any, Any] | None
    """Linear and quadratic coefficient of the elevation over the mass fraction of dissolved matter, K."""

    def __post_init__(self) -> None:
        m = self.mixture
        if not m.liquids or m.liquids[0].name not in [g.name for g in m.gases]:
            raise CaseError(_("Evaporation needs a vapor of the solvent among the gases of the mixture."))
        if self.elevation is None and len(m.liquids) > 1 and not any(activity_laws(m)):
            raise CaseError(
                _(
                    "The library has no water activity of {solutes}: give 'elevation_linear' and "
                    "'elevation_quadratic', the boiling-point elevation over the mass fraction of what is "
                    "dissolved."
                ).format(solutes=", ".join(s.name for s in m.liquids[1:]))
            )

    @cached_property
    def salts(self) -> Salts | None:
        """Two or more salts whose ions are known beside each other: they crystallize together."""
        return salts_of(self.mixture)

    @property
    def solvent(self) -> Fluid:
        """The first liquid, pure."""
        return self.mixture.materials.fluid(self.mixture.liquids[0].name)

    def vapor_pressure(self, T: Any) -> Any:
        """Of the pure solvent, Pa."""
        return self.solvent.vapor_pressure.value(T)

    def pure_boiling(self, pressure: Any) -> Any:
        """Of the pure solvent, K."""
        return self.solvent.boiling_temperature(pressure)

    def latent(self, T: Any) -> Any:
        """Heat of vaporization of the pure solvent, J/kg."""
        return self.solvent.heat_of_vaporization.value(T)

    @property
    def vapor(self) -> int:
        """Position of the solvent's vapor among the gases."""
        return self.mixture.index("gases", self.mixture.liquids[0].name)

    @property
    def crystals(self) -> list[Forming]:
        """Crystals of the first solute that has any among the solids, the one stable in the cold first; none
        where several salts crystallize together.
        """
        m, found = self.mixture, []
        if self.salts is not None:
            return []
        dissolved = {s.name for s in m.liquids[1:]}
        for solid in m.solids:
            if dissolved & {name for name, _share in solid.composition}:
                role = roles(m, solid.name, "")
                system = solute_system(m.materials, m.liquids[role.solute].name, (self.solvent.name,))
                if system is None or (found and found[0].roles.solute != role.solute):
                    continue
                ends = [-jnp.inf, *(b.stable_from for b in system.branches[1:]), jnp.inf]
                for branch, (low, high) in zip(system.branches, pairwise(ends), strict=True):
                    if branch.crystal.name == solid.name:
                        found.append(Forming(role, branch, low, high))
        return sorted(found, key=lambda f: f.low)

    def stable(self, T: Any) -> list[Any]:
        """Which of the crystals forms at a temperature: of those there are, the one next to it."""
        starts = [-jnp.inf, *(f.low for f in self.crystals[1:]), jnp.inf]
        return [(low <= T) & (high > T) for low, high in pairwise(starts)][: len(self.crystals)]

    def among(self, T: Any) -> tuple[Any, Any]:
        """Temperatures between which the crystal that forms is the right one, K."""
        low, high = jnp.asarray(-jnp.inf), jnp.asarray(jnp.inf)
        for h, f in zip(self.stable(T), self.crystals, strict=True):
            low, high = jnp.where(h, f.low, low), jnp.where(h, f.high, high)
        return low, high

    def saturation(self, product: Stream, solutes: Collection[int] | None = None) -> Any:
        """The largest concentration over its solubility of the solutes of the library, or of some; of salts
        together that of the activities of their ions, also for crystals that the mixture has not.
        """
        if self.salts is not None:
            molalities = self.salts.ions(product.liquid) / jnp.maximum(product.liquid[0], 1e-300)
            return jnp.exp(jnp.max(self.salts.brine.saturation(product.temperature, molalities)))
        m, T, solvent = self.mixture, product.temperature, jnp.maximum(product.liquid[0], 1e-300)
        over = [jnp.zeros(())]
        for i, liquid in enumerate(m.liquids[1:], start=1):
            system = solute_system(m.materials, liquid.name, (self.solvent.name,))
            if system is not None and (solutes is None or i in solutes):
                over.append(product.liquid[i] / solvent / system.value(T))
        return jnp.max(jnp.stack(over))

    def dilution(self, before: Any, after: Any) -> Any:
        """What balances leave out between two liquids, W: an apparent enthalpy in proportion to the
        concentration, half of what the last of a solute takes up in its saturated solution over that in much
        water.
        """
        m, total = self.mixture, jnp.zeros(())
        mixed = () if m.mixing is None else m.mixing.solutes
        for i, liquid in enumerate(m.liquids[1:], start=1):
            system = solute_system(m.materials, liquid.name, (self.solvent.name,))
            if system is None or i in mixed or not is_measured(system):
                continue
            stable = system.branches[sum(b.stable_from <= REFERENCE for b in system.branches[1:])]
            last = stable.heat_of_crystallization - stable.heat_dilute
            if np.isfinite(last):
                strong = [
                    x[i] * jnp.minimum(safe_divide(x[i], x[0] * system.value(REFERENCE), 1.0), 1.0)
                    for x in (before, after)
                ]
                total = total + 0.5 * last * (strong[1] - strong[0])
        return total

    def excess(self, T: Any, pure: Any, liquid: Any) -> Any:
        """How far a solution lies above its boiling point: in kelvin with given coefficients, else as the
        logarithm of its vapor pressure over the pressure.
        """
        solvent = jnp.maximum(liquid[0], 1e-300)
        if self.elevation is not None:
            w = 1.0 - safe_divide(liquid[0], jnp.sum(liquid), 1.0)
            return T - pure - self.elevation[0] * w - self.elevation[1] * w**2
        raised = jnp.log(self.vapor_pressure(T)) - jnp.log(self.vapor_pressure(pure))
        if self.salts is not None:
            activity = self.salts.brine.water_activity(T, self.salts.ions(liquid) / solvent)
            return raised + jnp.log(activity)
        for i, law in enumerate(activity_laws(self.mixture), start=1):
            if law is not None:
                raised = raised + jnp.log(law(T, liquid[i] / solvent))
        return raised

    def split(self, feed: Stream, heat: Any, T: Any) -> _Split:
        """What boils off and crystallizes where feed and heat are brought to a temperature."""
        given = feed.enthalpy_flow + heat - feed.enthalpy_at(T)
        if self.mixture.mixing is None:
            return self._parted(feed, given, T)
        held = self.mixture.heat_of_mixing(feed.liquid, T)

        def unmixed(taken: Any) -> Any:  # by what the liquor takes as it thickens
            liquid = self._parted(feed, given - taken, T).liquid
            return taken + held - self.mixture.heat_of_mixing(liquid, T)

        def step(_pass: Any, taken: Any) -> Any:
            value, slope = jax.jvp(unmixed, (taken,), (jnp.ones_like(taken),))
            return taken - value / slope

        taken = jax.lax.fori_loop(0, PASSES, step, 0.0 * given)
        return self._parted(feed, given - taken, T)

    def _parted(self, feed: Stream, given: Any, T: Any) -> _Split:
        """The same by the heat there is once the feed is at the temperature, with enthalpies that add up."""
        forming = self.crystals
        if forming:
            each = [self._with(forming, k, feed, given, T) for k in range(len(forming))]
            here = self.stable(T)
            return jax.tree.map(
                lambda *x: sum(jnp.where(h, v, 0.0) for h, v in zip(here, x, strict=True)), *each
            )
        liquid, gas = (self.mixture.enthalpies(phase, T) for phase in ("liquids", "gases"))
        gone = jnp.clip(given / (gas[self.vapor] - liquid[0]), 0.0, DRIEST * feed.liquid[0])
        return _Split(gone, [], feed.liquid.at[0].add(-gone), feed.liquid[0])

    def _with(self, forming: list[Forming], k: int, feed: Stream, given: Any, T: Any) -> _Split:
        """The same where one of the crystals forms; others of the solute go into solution."""
        liquid, solid, gas = (self.mixture.enthalpies(phase, T) for phase in ("liquids", "solids", "gases"))
        latent = gas[self.vapor] - liquid[0]
        dissolved = feed.liquid
        for r in (f.roles for f in forming):
            before, x = jnp.sum(feed.solid[r.solid]), r.solute_fraction
            dissolved = dissolved.at[r.solute].add(x * before).at[0].add((1.0 - x) * before)
            given = given + before * (solid[r.solid] - x * liquid[r.solute] - (1.0 - x) * liquid[0])
        r, saturated = forming[k].roles, forming[k].branch.value(T)
        x = r.solute_fraction
        free = jnp.maximum(dissolved[0] - (1.0 - x) / x * dissolved[r.solute], 0.0)
        most = DRIEST * free
        lower = solid[r.solid] - x * liquid[r.solute] - (1.0 - x) * liquid[0]
        alone = given / latent
        room = jnp.maximum(x - saturated * (1.0 - x), 1e-6)
        over = (dissolved[r.solute] - saturated * dissolved[0]) / room
        with_crystals_ = (given - lower * over) / (latent + lower * saturated / room)
        full = over + saturated * jnp.clip(alone, 0.0, most) / room > 0.0
        gone = jnp.clip(jnp.where(full, with_crystals_, alone), 0.0, most)
        formed = jnp.where(full, over + saturated * gone / room, 0.0)
        formed = jnp.clip(formed, 0.0, dissolved[r.solute] / x)
        left = dissolved.at[r.solute].add(-x * formed).at[0].add(-gone - (1.0 - x) * formed)
        return _Split(gone, [formed if i == k else jnp.zeros(()) for i in range(len(forming))], left, free)


def _grown(liquor: Liquor, feed: Stream, made: _Split, sizes: LogNormal) -> tuple[Any, Any]:
    """The solid with the crystals of one solute, and what has formed of them."""
    solid, grown = feed.solid, jnp.zeros(())
    passing = sizes(jnp.asarray(feed.mixture.edges)).at[0].set(0.0).at[-1].set(1.0)
    for forming, crystals in zip(liquor.crystals, made.crystals, strict=True):
        role = forming.roles
        fed = jnp.sum(feed.solid[role.solid], axis=tuple(range(1, feed.solid[0].ndim)))
        before = jnp.sum(fed)
        kept = fed * jnp.minimum(safe_divide(crystals, before, 0.0), 1.0)
        fresh = jnp.diff(passing) * jnp.maximum(crystals - before, 0.0)
        solid = with_crystals(feed.replace(solid=solid), role, kept + fresh)
        grown = grown + jnp.maximum(crystals - before, 0.0)
    return solid, grown


def _boil_together(liquor: Liquor, salts: Salts, feed: Stream, chest: Any, pure: Any, wall: Any) -> Any:
    """Boiling temperature, what happens there, and whether it was found, where all salts crystallize that are
    saturated beside each other.
    """
    mixture, masses = liquor.mixture, salts.crystal_masses
    solids = np.array([f.solid for f in salts.forming], dtype=int)
    before = jnp.sum(feed.solid[solids].reshape(len(solids), -1), axis=1) / masses
    dissolved = salts.all_dissolved(feed)
    places = np.array((*salts.liquids, 0))

    def gone(T: Any, n: Any) -> Any:
        liquid, solid, gas = (mixture.enthalpies(phase, T) for phase in ("liquids", "solids", "gases"))
        latent = gas[liquor.vapor] - liquid[0]
        lower = solid[solids] * masses - salts.made_of @ liquid[places]
        given = feed.enthalpy_flow + wall * (chest - T) - feed.enthalpy_at(T) + lower @ (before - n)
        if mixture.mixing is None:
            return given / latent
        held = mixture.heat_of_mixing(feed.liquid, T)
        staying = dissolved.at[places].add(-(n @ salts.made_of))
        limit = DRIEST * staying[0]

        def step(_pass: Any, evaporated: Any) -> Any:  # a liquor takes far less than the latent heat of water
            left = staying.at[0].add(-jnp.clip(evaporated, 0.0, limit))
            return (given + held - mixture.heat_of_mixing(left, T)) / latent

        return jax.lax.fori_loop(0, REPEATS, step, given / latent)

    def excess(T: Any, log_water: Any, fraction: Any) -> Any:
        if liquor.elevation is not None:
            return T - pure - liquor.elevation[0] * fraction - liquor.elevation[1] * fraction**2
        return jnp.log(liquor.vapor_pressure(T)) - jnp.log(liquor.vapor_pressure(pure)) + log_water

    boiling = Boiling(gone, excess, DRIEST)
    made = salts.brine.equilibrium(pure - 1e-3, dissolved[0], salts.ions(dissolved), salts.which, boiling)
    salts.heard(made.temperature, made.molalities)
    left = salts.left(dissolved, made.crystals)
    split = _Split(made.evaporated, list(made.crystals), left.at[0].add(-made.evaporated), left[0])
    return made.temperature, split, made.found


def _boil_alone(liquor: Liquor, feed: Stream, chest: Any, pure: Any, wall: Any) -> Any:
    """Boiling temperature, what happens there, and whether it was found, where one solute crystallizes or
    none.
    """
    hottest = jnp.maximum(jnp.maximum(chest, feed.temperature), pure) + SPAN

    def excess(T: Any) -> Any:
        return liquor.excess(T, pure, liquor.split(feed, wall * (chest - T), T).liquid)

    root = find_root(excess, pure - 1.0, hottest, start=pure + 2.0)  # pure solvent boils at its end
    made = liquor.split(feed, wall * (chest - root.value), root.value)
    # once more where its flags are heard; no solution boils where one crystal gives way to another
    boils = jnp.abs(liquor.excess(root.value, pure, made.liquid)) < 1e-6
    if liquor.salts is not None:
        molalities = liquor.salts.ions(made.liquid) / jnp.maximum(made.liquid[0], 1e-300)
        liquor.salts.heard(root.value, molalities)
    return root.value, made, root.converged & boils


def boil(liquor: Liquor, feed: Stream, chest: Any, pure: Any, conductance: Any, sizes: LogNormal) -> Effect:
    """An effect whose solvent would boil at ``pure`` (K), heated from a chest temperature through a wall of
    a conductance (W/K).
    """
    mixture = liquor.mixture
    if liquor.salts is not None and liquor.salts.forming:
        T, made, found = _boil_together(liquor, liquor.salts, feed, chest, pure, conductance)
        solid = liquor.salts.crystallized(feed, jnp.stack(made.crystals), sizes)
        grown = jnp.sum(jnp.maximum(jnp.sum(solid - feed.solid, axis=tuple(range(1, solid.ndim))), 0.0))
    else:
        T, made, found = _boil_alone(liquor, feed, chest, pure, conductance)
        solid, grown = _grown(liquor, feed, made, sizes)
    duty = conductance * (chest - T)
    pressure = liquor.vapor_pressure(pure)
    product = feed.replace(solid=solid, liquid=made.liquid, temperature=T, pressure=pressure)
    steam = empty(mixture, T).replace(pressure=pressure)
    vapor = steam.replace(gas=steam.gas.at[liquor.vapor].set(made.evaporation))
    left = 1.0 - safe_divide(made.evaporation, made.most, 0.0)
    dilution = safe_divide(jnp.abs(liquor.dilution(feed.liquid, made.liquid)), jnp.abs(duty), 0.0)
    flags.record(
        flags.EXTRAPOLATED, dilution > TOLD, dilution, "heat_duty", "evaporation.evaporator", reason=DILUTION
    )
    taken = product.enthalpy_flow + vapor.enthalpy_flow - feed.enthalpy_flow
    return Effect(T, pure, pressure, made.evaporation, grown, product, vapor, duty, taken, found, left)


def entrained(made: Effect, carried: Any) -> tuple[Stream, Stream]:
    """Product and vapor with drops of the solution in the vapor, kg of drops per kg of vapor."""
    share = jnp.clip(safe_divide(carried * made.evaporation, made.product.liquid_flow, 0.0), 0.0, 1.0)
    drops = made.product.liquid * share
    return made.product.replace(liquid=made.product.liquid - drops), made.vapor.replace(liquid=drops)


def condensed(liquor: Liquor, vapor: Stream, temperature: Any) -> Stream:
    """A vapor and its drops as liquid at a temperature."""
    flow = vapor.gas[liquor.vapor]
    return vapor.replace(
        gas=vapor.gas.at[liquor.vapor].set(0.0),
        liquid=vapor.liquid.at[0].add(flow),
        temperature=temperature,
    )
