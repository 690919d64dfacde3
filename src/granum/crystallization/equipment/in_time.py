"""Continuous crystallizers in a line that runs in time: crystals, liquor and what is dissolved in it, in a
vessel of constant volume.
"""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, NamedTuple

import equinox as eqx
import jax.numpy as jnp

from granum.crystallization.equipment.beside import solubility_beside
from granum.crystallization.equipment.roles import Roles, crystal_of, feed_of, given_off, roles, with_crystals
from granum.crystallization.population.lagrangian import Model, react
from granum.crystallization.population.operations import Contents
from granum.crystallization.vessels.crystals import Crystal
from granum.crystallization.vessels.dynamic import ConstantProgram, Exchanged, Surviving
from granum.crystallization.vessels.moving import Moving
from granum.crystallization.vessels.msmpr import SteadyState, packets_of
from granum.numerics.smooth import safe_divide
from granum.streams.stream import Stream
from granum.streams.units import Dynamic

# kg/m³ and m: seeds at a start-up, without which secondary nucleation would never begin
SOWN, SOWN_SIZE = 1.0, 100e-6
WEIR = 2.0  # relative outflow per relative surplus of volume


class Held(NamedTuple):
    """What a crystallizer holds: crystals by number, kg of every liquid (what it has in crystals included)
    and of other solids; volumes turned over per second and solvent evaporating (kg/s) at this instant.
    """

    crystals: Moving
    liquid: Any
    solid: Any
    turnover: Any
    evaporation: Any


class Crystallized(NamedTuple):
    """Suspension of crystals in mother liquor, solvent vapor, and the heat taken up."""

    product: Stream
    vapor: Stream
    heat_duty: Any


class _Suspension(eqx.Module):
    """Volume of a suspension whose parts add up."""

    solute_density: Any
    solvent_density: Any
    others: Any

    def __call__(self, liquor: Any, solvent: Any, crystals: Any, crystal: Crystal) -> Any:
        return (
            (liquor - solvent) / self.solute_density
            + solvent / self.solvent_density
            + self.others
            + crystals / crystal.density
        )


class InTime(Dynamic):
    """A continuous crystallizer with a holdup. Matter is conserved by the trapezoidal rule in every
    component; growth and nucleation are those of the steady model, which a run in time settles to. A start-up
    begins with saturated liquor and 1 kg/m³ of seeds of 100 µm. Crystals do not dissolve while the liquor is
    undersaturated.
    """

    if TYPE_CHECKING:  # fields of every crystallizer
        volume: Any
        solubility: Any
        growth: Any
        nucleation: Any
        volume_shape_factor: Any
        nucleus_size: Any
        solid: str
        solvent: str

    @abstractmethod
    def inside(self, feed: Stream) -> tuple[SteadyState, Roles]: ...

    @abstractmethod
    def held_at(self, mixture: Any, feed: Stream | None = None) -> Any:
        """Temperature inside with a feed, K; without one, with nothing but solute and solvent."""

    @abstractmethod
    def _vapor(self, vapor: Stream, product: Stream, found: Roles) -> Stream: ...

    @abstractmethod
    def _evaporation(self, feed: Stream, found: Roles, temperature: Any) -> tuple[Any, Any]: ...

    @abstractmethod
    def steady_only(self) -> None:
        """Refuse what is known of the steady state alone."""

    def initial_holdup(self, mixture: Any) -> Held:
        self.steady_only()
        found = roles(mixture, self.solid, self.solvent)
        x, T = found.solute_fraction, self.held_at(mixture)
        crystal = crystal_of(mixture, found, T, self.volume_shape_factor)
        ratio, density = self.solubility(T), mixture.densities("liquids", T)
        seeds = SOWN * self.volume
        solvent = (self.volume - seeds / crystal.density) / (
            1.0 / density[found.solvent] + ratio / density[found.solute]
        )
        liquid = jnp.zeros(len(mixture.liquids)).at[found.solvent].set(solvent + (1.0 - x) * seeds)
        liquid = liquid.at[found.solute].set(ratio * solvent + x * seeds)
        blank = Moving.empty(mixture.edges[-1]).turned_over(
            0.0, (seeds / (crystal.mass_per_cube * SOWN_SIZE**3))[None], jnp.array([SOWN_SIZE])
        )
        return self._held(
            mixture,
            blank.grown(0.0, 0.0, self.nucleus_size, 0),
            liquid,
            jnp.zeros(mixture.solid_shape),
            0.0,
            0.0,
        )

    def _held(
        self, mixture: Any, crystals: Moving, liquid: Any, solid: Any, turnover: Any, evaporation: Any
    ) -> Held:
        """Of one shape always: sources of crystals are the classes of the feed."""
        none = jnp.zeros(len(mixture.sizes))
        return Held(
            crystals.turned_over(jnp.zeros(()), none, none),
            liquid,
            solid,
            jnp.asarray(turnover, dtype=float),
            jnp.asarray(evaporation, dtype=float),
        )

    def steady_holdup(self, inlets: Mapping[str, Stream]) -> Held:
        self.steady_only()
        feed = inlets["feed"]
        state, found = self.inside(feed)
        crystal = crystal_of(feed.mixture, found, state.temperature, self.volume_shape_factor)
        x = found.solute_fraction
        numbers, sizes = packets_of(feed_of(feed, found).crystals, jnp.asarray(feed.mixture.edges), crystal)
        time, made = state.residence_time, jnp.sum(state.crystals)
        born = state.nucleation_rate * self.volume
        standing = Moving.standing(
            feed.mixture.edges[-1],
            jnp.append(numbers, born),
            jnp.append(sizes, self.nucleus_size),
            jnp.maximum(state.length, 1e-12),
            time,
        )
        mass = crystal.mass_per_cube * standing.moments()[3]
        standing = standing.kept(safe_divide(made * time, mass))  # none where they are washed out
        liquid = (
            feed.liquid.at[found.solute]
            .set(state.solute + x * made)
            .at[found.solvent]
            .set(state.solvent + (1.0 - x) * made)
        )
        solid = feed.solid.at[found.solid].set(0.0)
        return self._held(feed.mixture, standing, liquid * time, solid * time, 1.0 / time, state.evaporation)

    def held_mass(self, state: Held) -> Any:
        return jnp.sum(state.liquid) + jnp.sum(state.solid)

    def advance(
        self, state: Held, before: Mapping[str, Stream], after: Mapping[str, Stream], step: Any, prepared: Any
    ) -> tuple[Held, Crystallized]:
        """The liquor and what is dissolved by the trapezoidal rule, whatever crystallizes; then growth along
        its path.
        """
        then, now = before["feed"], after["feed"]
        mixture, found = now.mixture, roles(now.mixture, self.solid, self.solvent)
        T = jnp.asarray(self.held_at(mixture, now), dtype=float)
        crystal, x = crystal_of(mixture, found, T, self.volume_shape_factor), found.solute_fraction
        cube = crystal.mass_per_cube
        densities, solids = mixture.densities("liquids", T), mixture.densities("solids", T)

        def volume(liquid: Any, solid: Any) -> Any:
            return jnp.sum(liquid / densities) + jnp.sum(
                jnp.sum(solid, axis=tuple(range(1, solid.ndim))) / solids
            )

        def entered(stream: Stream) -> Any:
            grown = jnp.sum(feed_of(stream, found).crystals)
            return stream.liquid.at[found.solute].add(x * grown).at[found.solvent].add((1.0 - x) * grown)

        early = jnp.where(state.turnover > 0, state.turnover, volume(then.liquid, then.solid) / self.volume)
        late = early * safe_divide(now.slurry_volume_flow, then.slurry_volume_flow, 1.0)
        lead = 1.0 - 0.5 * step * early
        # a step longer than two residence times is refused
        lead, lag = jnp.where(lead > 0, lead, jnp.nan), 1.0 + 0.5 * step * late
        here = Contents(T, state.liquid[found.solute], state.liquid[found.solvent], jnp.zeros(()))
        grains = cube * state.crystals.moments()[3]
        numbers, sizes = packets_of(
            0.5 * (feed_of(now, found).crystals + feed_of(then, found).crystals),
            jnp.asarray(mixture.edges),
            crystal,
        )
        crystals = state.crystals.turned_over(0.5 * step * (early + late), step * numbers, sizes)
        pair = jnp.array([found.solute, found.solvent])
        other = _Suspension(
            densities[found.solute],
            densities[found.solvent],
            volume(state.liquid.at[pair].set(0.0), state.solid),
        )

        def model_in(liquid: Any, nucleation: Any) -> Model:
            """The vessel whose liquor has what else there is of a liquid."""
            soluble = solubility_beside(self.solubility, mixture, found, liquid, T)
            return Model(soluble, self.growth, nucleation, crystal, other, nucleus_size=self.nucleus_size)

        survived = Surviving(self.nucleation, crystals.survival)

        def forming(there: Contents, liquid: Any, crystals: Moving) -> Any:
            """Crystals that form, kg/s."""
            moments = crystals.moments()
            model = model_in(liquid, self.nucleation)
            _ratio, _saturated, rate, births = model.conditions(there, cube * moments[3])
            return cube * (3.0 * rate * moments[2] + births * self.nucleus_size**3)

        first, per_crystal = self._evaporation(now, found, T)
        evaporation = first + per_crystal * forming(here, state.liquid, state.crystals)
        gained = (entered(then) + entered(now)).at[found.solvent].add(-state.evaporation - evaporation)
        liquid = (state.liquid * lead + 0.5 * step * gained) / lag
        solid = (state.solid * lead + 0.5 * step * (then.solid + now.solid).at[found.solid].set(0.0)) / lag
        closed = Exchanged(ConstantProgram(T), liquid[found.solute], liquid[found.solvent])
        rates = model_in(state.liquid, survived).conditions(here, grains)[2:]
        made, *_rest = react(
            model_in(liquid, survived),
            closed,
            crystals,
            here,
            grains,
            rates,
            (jnp.zeros(()), jnp.asarray(step, dtype=float)),
            0,
        )

        assert isinstance(made, Moving)
        grains = cube * made.moments()[3]
        bound = (
            jnp.zeros_like(liquid).at[found.solute].set(x * grains).at[found.solvent].add((1.0 - x) * grains)
        )
        full = (volume(liquid - bound, solid) + grains / crystal.density) / self.volume
        # What leaves follows the volume that enters, less what crystals take up in forming; a weir brings the
        # level back.
        shrinkage = x / densities[found.solute] + (1.0 - x) / densities[found.solvent] - 1.0 / crystal.density
        there = Contents(T, liquid[found.solute], liquid[found.solvent], jnp.zeros(()))
        balance = (
            volume(now.liquid, now.solid)
            - evaporation / densities[found.solvent]
            - shrinkage * forming(there, liquid, made)
        )
        balance = jnp.maximum(balance, 0.0) / self.volume
        turnover = late
        for _round in range(4):
            level = lag / (1.0 + 0.5 * step * turnover)
            miss = turnover - balance * (1.0 + WEIR * (full * level - 1.0))
            turnover = turnover - miss / (
                1.0 + balance * WEIR * full * level * 0.5 * step / (1.0 + 0.5 * step * turnover)
            )
        level = lag / (1.0 + 0.5 * step * turnover)
        state = self._held(mixture, made.kept(level), liquid * level, solid * level, turnover, evaporation)
        return state, self._outlets(state, now, found, T, cube, bound * level)

    def _outlets(self, state: Held, now: Stream, found: Roles, T: Any, cube: Any, bound: Any) -> Crystallized:
        grown = with_crystals(now, found, cube * state.crystals.cubes_in(now.mixture.edges))
        solid = state.solid.at[found.solid].set(grown[found.solid])
        product = now.replace(
            solid=solid * state.turnover,
            liquid=(state.liquid - bound) * state.turnover,
            gas=0.0 * now.gas,
            temperature=T,
        )
        vapor = self._vapor(given_off(now, found, state.evaporation, T), product, found)
        return Crystallized(product, vapor, jnp.zeros(()))
