"""Steady continuous crystallizer, mixed suspension and mixed product removal (MSMPR), as pure functions.

Every crystal that is born in the vessel or enters it stays for an exponentially distributed time and grows at
the same rate, so the product is a sum of shifted exponentials: one for the nuclei, one for each size class of
the feed. Class masses and moments are then exact, and the only unknown is the composition of the mother
liquor.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

import equinox as eqx
import jax
import jax.numpy as jnp
from jax import lax

from granum.crystallization.population.compiled import compiled
from granum.crystallization.population.grid import Collisions
from granum.crystallization.population.standing import (
    Classes,
    Outflow,
    Standing,
    classes_for,
    count_of,
    round_of,
)
from granum.crystallization.vessels.crowded import State, steady_crowd
from granum.crystallization.vessels.crystals import Crystal, crystals_at, ratio_left
from granum.numerics.roots import find_root
from granum.numerics.smooth import safe_divide

SCAN = 96  # trial compositions between saturation and feed among which the first solution is sought


class Feed(NamedTuple):
    """What enters: dissolved solute and free solvent (kg/s), and crystals already there by size class
    (kg/s).
    """

    solute: Any
    solvent: Any
    crystals: Any


class SteadyState(NamedTuple):
    """A steady continuous crystallizer.

    temperature: K.
    solute_per_solvent, solubility_per_solvent: composition of the mother liquor and at saturation, kg/kg.
    relative_supersaturation: of the mother liquor.
    crystals: product by size class, kg/s; the last class takes the tail beyond the grid.
    solute, solvent: mother liquor leaving, kg/s. evaporation: vapor leaving, kg/s.
    growth_rate: m/s. nucleation_rate: 1/(m³ s). residence_time: s. suspension_flow: m³/s.
    magma_density: crystals per suspension volume in the vessel, kg/m³. length: growth in one residence time,
        m.
    washed_out: no steady crystals: the solution leaves supersaturated as it came.
    converged: whether the mass balance was closed.
    """

    temperature: Any
    solute_per_solvent: Any
    solubility_per_solvent: Any
    relative_supersaturation: Any
    crystals: Any
    solute: Any
    solvent: Any
    evaporation: Any
    growth_rate: Any
    nucleation_rate: Any
    residence_time: Any
    suspension_flow: Any
    magma_density: Any
    length: Any
    washed_out: Any
    converged: Any


class AdditiveVolumes(eqx.Module):
    """Volume flow of a liquor whose parts add up: constant densities, and other liquids that come along
    (m³/s).
    """

    solute_density: Any
    solvent_density: Any
    others: Any = 0.0

    def __call__(self, solute: Any, solvent: Any) -> Any:
        return solute / self.solute_density + solvent / self.solvent_density + self.others


class Removal(eqx.Module):
    """Sizes that leave faster than the mother liquor (R–Z model), cuts being sharp.

    Parameters
    ----------
    fines_ratio, fines_cut: crystals below the cut are drawn R times as fast; what is drawn beyond the product
        is dissolved and comes back.
    product_ratio, product_cut: crystals above the cut leave as product z times as fast.
    """

    fines_ratio: Any = 1.0
    fines_cut: Any = 0.0
    product_ratio: Any = 1.0
    product_cut: Any = 1.0

    def path(self, size: Any) -> Any:
        """Growth weighted with the removal, m: what the logarithm of the survivors falls with."""
        between = jnp.clip(size - self.fines_cut, 0.0, self.product_cut - self.fines_cut)
        return (
            self.fines_ratio * jnp.minimum(size, self.fines_cut)
            + between
            + self.product_ratio * jnp.maximum(size - self.product_cut, 0.0)
        )

    @property
    def outflow(self) -> Outflow:
        """How fast each size leaves."""
        ratios = self.fines_ratio, 1.0, self.product_ratio
        return Outflow((self.fines_cut, self.product_cut), ratios, (1.0, 1.0, self.product_ratio))

    def beyond(self, level: Any, start: Any, length: Any, held: bool = False) -> Any:
        """Cube of the crystals of one start size that leave as product above a level; what the vessel holds
        of them with ``held``.
        """
        total = 0.0
        parts = (
            (0.0, self.fines_cut, self.fines_ratio, 1.0),
            (self.fines_cut, self.product_cut, 1.0, 1.0),
            (self.product_cut, None, self.product_ratio, self.product_ratio),
        )
        for low, high, rate, share in parts:
            begin = jnp.maximum(jnp.maximum(level, start), low)
            part = self._term(begin, start, length, rate)
            if high is not None:
                part = part - self._term(jnp.maximum(begin, high), start, length, rate)
            total = total + (1.0 if held else share) / rate * part
        return total

    def _term(self, size: Any, start: Any, length: Any, rate: Any) -> Any:
        return jnp.exp(-(self.path(size) - self.path(start)) / length) * _third(size, length / rate)


@compiled
def steady_msmpr(
    feed: Feed,
    temperature: Any,
    volume: Any,
    solubility: Callable[[Any], Any],
    growth: Callable[[Any, Any, Any], Any],
    nucleation: Callable[[Any, Any, Any, Any], Any],
    crystal: Crystal,
    liquor_volume: Callable[[Any, Any], Any],
    edges: Any,
    evaporation: Any = 0.0,
    evaporation_per_crystal: Any = 0.0,
    nucleus_size: Any = 0.0,
    removal: Removal | None = None,
    collisions: Collisions | None = None,
) -> SteadyState:
    """Steady state of one vessel.

    Parameters
    ----------
    temperature: K. volume: of suspension, m³.
    solubility: anhydrous solute per solvent from the temperature (and the free solvent, where the law takes
        it).
    growth: rate of size from (solute per solvent, solubility, temperature); nucleation: the same with the
        magma density.
    liquor_volume: m³/s of mother liquor from its solute and its solvent (kg/s).
    edges: size class boundaries of the crystals, m.
    evaporation: solvent taken off as vapor, kg/s, and what is added to it per kg of crystals that form: the
        heat of crystallization over that of vaporization in an adiabatic vessel, which keeps every balance
        linear.
    removal: fines dissolved and product classified; None where every size leaves with the liquor.
    collisions: by which crystals agglomerate or break; None where they only grow, which is then exact.

    Of several steady states the one with most crystals is taken; the one without any is taken when it is the
    only one. Crystals that enter with an undersaturated liquor dissolve until it is saturated or they are
    gone.
    """
    edges = jnp.asarray(edges, dtype=float)
    total = jnp.sum(feed.crystals)
    x = crystal.solute_fraction
    # A crystal takes its own water and, in an adiabatic vessel, evaporates some.
    bound = 1.0 - x + evaporation_per_crystal
    all_solute, all_solvent = feed.solute + x * total, feed.solvent - evaporation + bound * total
    # Composition if nothing new crystallized; between it and saturation lies every steady state.
    liquid = feed.solvent - evaporation
    highest = safe_divide(feed.solute, jnp.maximum(liquid, 0.0))  # nothing crystallizes from an empty stream
    start_numbers, start_sizes = packets_of(feed.crystals, edges, crystal)
    saturated, at = saturated_liquor(solubility, temperature, all_solute, all_solvent, x, bound)

    def state(c: Any) -> tuple[Any, ...]:
        product = crystals_at(all_solute, all_solvent, c, x, bound)
        left = all_solvent - bound * product
        flow = liquor_volume(left * c, left) + product / crystal.density
        flow = jnp.where(flow > 0, flow, 1.0)  # an empty stream
        soluble = at(left)
        G = growth(c, soluble, temperature)
        held = 1.0
        if (
            removal is not None and collisions is None
        ):  # the vessel holds another concentration than the product
            length = jnp.maximum(G * volume / flow, 1e-15)
            held = removal.beyond(0.0, nucleus_size, length, held=True) / removal.beyond(
                0.0, nucleus_size, length
            )
        return (
            product,
            flow,
            G,
            nucleation(c, soluble, temperature, held * product / flow),
            held * product / flow,
        )

    def cubes(start: Any, length: Any) -> Any:
        """Mean cube at which crystals of a start size leave."""
        return (
            _third(start, length)
            if removal is None
            else removal.beyond(0.0, start, jnp.maximum(length, 1e-15))
        )

    def grown(c: Any) -> Any:
        """Crystal mass that the kinetics make, kg/s."""
        _product, flow, G, B, _magma = state(c)
        length = G * volume / flow
        return crystal.mass_per_cube * (
            B * volume * cubes(nucleus_size, length)
            + _dot(start_numbers, cubes(start_sizes, length[..., None]))
        )

    dissolved_down = jnp.clip(crystals_at(all_solute, all_solvent, saturated, x, bound), 0.0, total)
    rest = jnp.where(highest > saturated, total, dissolved_down)
    alone = ratio_left(all_solute, all_solvent, rest, x, bound)
    if collisions is not None:
        outflow = None if removal is None else removal.outflow

        def held_over(grid: Classes, cubes: Any) -> Any:
            """Crystals in the vessel over those of a product that leaves with the liquor."""
            return safe_divide(jnp.sum(cubes), jnp.sum(grid.shares * cubes), 1.0)

        def next_to(c: Any, born: Any, before: State, cautious: Any = False) -> Standing:
            product, flow, G, _nuclei, _magma = state(c)
            grid = classes_for(G * volume / flow, flow / volume, 2.0 * edges[-1], outflow)
            magma = held_over(grid, before[1]) * product / flow
            B = nucleation(c, at(all_solvent - bound * product), temperature, magma)
            return round_of(
                collisions,
                grid,
                before,
                jnp.append(start_numbers, born * B * volume),
                jnp.append(start_sizes, nucleus_size),
                G,
                volume,
                cautious,
            )

        def cubes_wanted(c: Any) -> Any:
            """Cubes that a product of the right mass holds in the vessel where it leaves with the liquor."""
            product, flow, *_rest = state(c)
            return product / (crystal.mass_per_cube * flow) * volume

        def excess(c: Any, before: State) -> Any:
            _product, flow, G, *_rest = state(c)
            grid = classes_for(G * volume / flow, flow / volume, 2.0 * edges[-1], outflow)
            made = jnp.sum(grid.shares * before[1])
            return jnp.log(jnp.maximum(made, 1e-300)) - jnp.log(jnp.maximum(cubes_wanted(c), 1e-300))

        def typical(c: Any) -> State:
            _product, flow, _growth, B, _magma = state(c)
            number = (jnp.sum(start_numbers) + B * volume) * volume / flow
            cubes = jnp.maximum(grown(c) / crystal.mass_per_cube * volume / flow, cubes_wanted(c))
            return jnp.where(number > 0.0, number, 1.0), jnp.where(cubes > 0.0, cubes, 1.0)

        over = jnp.where(highest > saturated, highest - saturated, 1.0)

        def at_share(share: Any) -> Any:
            return saturated + share * over

        def following(share: Any, born: Any, before: State, cautious: Any) -> State:
            made = next_to(at_share(share), born, before, cautious)
            return made.numbers, made.cubes

        crowd = steady_crowd(
            following,
            lambda share, before: excess(at_share(share), before),
            lambda share: typical(at_share(share)),
            count_of(outflow),
            highest > saturated,
            (alone - saturated) / over,
        )
        some, converged = crowd.crystallizes, crowd.converged
        c = jnp.where(some, at_share(crowd.share), alone)
        population = next_to(c, jnp.where(some, 1.0, 0.0), crowd.state)
    else:
        found = steady_composition(grown, lambda c: state(c)[0], saturated, highest)
        some, converged = found.crystallizes, found.converged
        c = jnp.where(some, found.ratio, alone)
    product, flow, G, B, magma = state(c)
    product = jnp.where(some, product, rest)
    length = G * volume / flow
    if collisions is not None:
        magma = held_over(population.classes, population.cubes) * magma
        B = nucleation(c, at(all_solvent - bound * product), temperature, magma)
        tail = population.beyond(jnp.concatenate([jnp.zeros(1), edges[1:-1]]))
        classes = tail - jnp.append(tail[1:], 0.0)
    else:
        born = jnp.where(some, B * volume, 0.0)
        classes = _classes(
            jnp.append(start_numbers, born),
            jnp.append(start_sizes, nucleus_size),
            length,
            edges,
            crystal,
            removal,
        )
    # The closure fixes the total; the classes share it, so that mass is conserved to rounding.
    made = jnp.sum(classes)
    classes = classes * jnp.where(made > 0, product / jnp.where(made > 0, made, 1.0), 0.0)
    left = all_solvent - bound * product
    soluble = at(left)
    return SteadyState(
        temperature,
        c,
        soluble,
        c / soluble - 1.0,
        classes,
        left * c,
        left,
        evaporation + evaporation_per_crystal * (product - total),
        G,
        B,
        volume / flow,
        flow,
        jnp.where(some, magma, product / flow),
        length,
        ~some & (highest > saturated) & (total == 0),
        converged,
    )


def saturated_liquor(
    solubility: Any, temperature: Any, solute: Any, solvent: Any, solute_fraction: Any, bound: Any = None
) -> tuple[Any, Callable[[Any], Any]]:
    """Composition at which the liquor left of so much solute and solvent is saturated, and the solubility as
    a function of the free solvent: beside other solutes both change as solvent goes into crystals or vapor.
    """
    if not getattr(solubility, "takes_solvent", False):
        saturated = solubility(temperature)
        return saturated, lambda _solvent: saturated
    x = solute_fraction
    bound = 1.0 - x if bound is None else bound

    def at(left: Any) -> Any:
        return solubility(temperature, jnp.maximum(left, 0.0))

    def over(crystals: Any) -> Any:
        left = solvent - bound * crystals
        return solute - x * crystals - at(left) * left

    some = over(jnp.zeros(())) > 0.0
    most = jnp.minimum(
        solute / x, jnp.where(bound > 0.0, solvent / jnp.where(bound > 0.0, bound, 1.0), jnp.inf)
    )
    most = lax.stop_gradient(jnp.where(some, most, 1.0))
    root = find_root(lambda p: jnp.where(some, over(p), p - 0.5), jnp.zeros(()), most)
    return at(solvent - bound * jnp.where(some, root.value, 0.0)), at


class Composition(NamedTuple):
    """Solute per solvent of a steady mother liquor, whether crystals form, and whether it was found."""

    ratio: Any
    crystallizes: Any
    converged: Any


def steady_composition(
    grown: Callable[[Any], Any], product: Callable[[Any], Any], saturated: Any, highest: Any
) -> Composition:
    """The first composition above saturation at which the crystals that the kinetics make (kg/s) are those
    that the solute balance leaves: the steady state with most crystals.
    """

    def excess(c: Any) -> Any:
        return jnp.log(jnp.maximum(grown(c), 1e-300)) - jnp.log(jnp.maximum(product(c), 1e-300))

    supersaturated = highest > saturated
    low, high = lax.stop_gradient((saturated, highest))
    trials = low + (high - low) * _trial_points()
    values = jax.vmap(excess)(trials)
    rises = (values[:-1] < 0) & (values[1:] >= 0)
    first = jnp.argmax(rises)
    some = jnp.any(rises) & supersaturated
    below, above = jnp.where(some, trials[first], low), jnp.where(some, trials[first + 1], high)
    root = find_root(
        lambda c: jnp.where(some, excess(c), c - highest), below, jnp.where(some, above, high * (1 + 1e-9))
    )
    return Composition(root.value, some, jnp.where(some, root.converged, True))


def _trial_points() -> Any:
    """Trial shares of the supersaturation: fine near both ends, where steady states crowd."""
    near = jnp.geomspace(1e-9, 0.1, SCAN // 2)
    middle = jnp.linspace(0.1, 0.9, SCAN // 4 + 2)[1:-1]
    return jnp.concatenate([jnp.zeros(1), near, middle, 1.0 - near[::-2]])


def _third(size: Any, length: Any) -> Any:
    """Mean cube of ``size + X`` for X exponential with mean ``length``."""
    return size**3 + 3.0 * size**2 * length + 6.0 * size * length**2 + 6.0 * length**3


def _dot(a: Any, b: Any) -> Any:
    return jnp.sum(a * b, axis=-1)


def packets_of(crystals: Any, edges: Any, crystal: Crystal) -> tuple[Any, Any]:
    """Numbers per second and sizes that stand for the classes of the feed: the mean cube of a uniform
    class.
    """
    low, high = edges[:-1], edges[1:]
    size = (0.25 * (low + high) * (low**2 + high**2)) ** (1.0 / 3.0)
    return crystals / (crystal.mass_per_cube * size**3), size


def _classes(
    numbers: Any, sizes: Any, length: Any, edges: Any, crystal: Crystal, removal: Removal | None
) -> Any:
    """Crystal mass of the product in each class, kg/s; the last class is open upwards, the first takes what
    is below the grid.
    """
    safe = jnp.maximum(length, 1e-15)
    levels = jnp.concatenate([jnp.zeros(1), edges[1:-1]])[:, None]
    if removal is not None:
        beyond = removal.beyond(levels, sizes[None, :], safe)
    else:
        above = jnp.maximum(levels - sizes[None, :], 0.0)
        beyond = jnp.exp(-above / safe) * _third(sizes[None, :] + above, safe)
    tail = jnp.sum(numbers[None, :] * beyond, axis=1) * crystal.mass_per_cube
    return tail - jnp.append(tail[1:], 0.0)
