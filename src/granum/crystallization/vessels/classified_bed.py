"""Steady bed of crystals that its upflow keeps in suspension and sorts by size, as pure functions.

Each size floats where Richardson and Zaki's law puts it, small ones on top. Crystals enter the bed from above
once they are too large to be carried off, grow downwards and leave at the bottom, all of one size.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

import jax.numpy as jnp

from granum.crystallization.formulas.upflow import Upflow
from granum.crystallization.vessels.crystals import Crystal, crystals_at
from granum.crystallization.vessels.msmpr import Feed, saturated_liquor
from granum.numerics.quadrature import gauss_legendre
from granum.numerics.roots import find_root
from granum.numerics.smooth import safe_divide

ORDER = 32


class Bed(NamedTuple):
    """A steady classified bed.

    smallest, largest: sizes at its top and bottom, m. solute_per_solvent, relative_supersaturation: of the
    liquor that leaves at the top. supersaturation_inlet: of the liquor that enters at the bottom.
    product: crystals leaving, kg/s. solute, solvent: mother liquor leaving, kg/s. held: crystals in the bed,
    kg. time: to grow from top to bottom, s. number: crystals leaving, 1/s. births: in the bed, 1/s.
    found, converged: whether the upflow suspends crystals, and whether the balance was closed.
    """

    smallest: Any
    largest: Any
    solute_per_solvent: Any
    relative_supersaturation: Any
    supersaturation_inlet: Any
    product: Any
    solute: Any
    solvent: Any
    held: Any
    time: Any
    number: Any
    births: Any
    found: Any
    converged: Any


def steady_bed(
    feed: Feed,
    temperature: Any,
    area: Any,
    height: Any,
    upflow: Upflow,
    void_fractions: tuple[Any, Any],
    solubility: Callable[[Any], Any],
    growth: Callable[[Any, Any, Any], Any],
    nucleation: Callable[[Any, Any, Any, Any], Any],
    crystal: Crystal,
    evaporation: Any = 0.0,
) -> Bed:
    """Steady state of a bed between the void fractions at its top and at its bottom.

    As many crystals pass each size, so that what the liquor has still to give up on its way is a matter of
    size alone, and with it the growth rate there. The volume of the bed then decides the composition at which
    the liquor leaves. What comes with the feed is dissolved with the fines.
    """
    (low, some), (high, others) = (upflow.size_at(e, crystal) for e in void_fractions)
    found = some & others & (high > low)
    low, high = jnp.where(found, low, 0.5e-3), jnp.where(found, high, 1e-3)
    volume, cube = area * height, crystal.mass_per_cube
    total, x = jnp.sum(feed.crystals), crystal.solute_fraction
    solute, solvent = feed.solute + x * total, feed.solvent - evaporation + (1.0 - x) * total
    highest = safe_divide(solute, jnp.maximum(solvent, 0.0))
    saturated, at = saturated_liquor(solubility, temperature, solute, solvent, x)
    supersaturated = highest > saturated

    def soluble(c: Any) -> Any:
        """Solubility in the bed whose liquor leaves with c: on its way little of the solvent goes into
        crystals.
        """
        return at(solvent - (1.0 - x) * jnp.maximum(crystals_at(solute, solvent, c, x), 0.0))

    def number_at(c: Any) -> Any:
        return jnp.maximum(crystals_at(solute, solvent, c, x), 0.0) / (cube * high**3)

    def liquor(size: Any, c: Any, number: Any) -> Any:
        """Composition where crystals of a size float, the liquor leaving with c."""
        given = cube * number * (size**3 - low**3)
        flow = upflow.velocity * area * upflow.density / (1.0 + c)
        return (flow * c + x * given) / (flow + (1.0 - x) * given)

    def along(weight: Callable[[Any, Any], Any], c: Any, number: Any) -> Any:
        """Integral of a weight of size and composition over the time that crystals spend at each size."""
        limit = soluble(c)

        def share(size: Any) -> Any:
            there = liquor(size, c, number)
            return weight(size, there) / jnp.maximum(growth(there, limit, temperature), 1e-30)

        return gauss_legendre(share, low, high, order=ORDER)

    def room(size: Any, _there: Any) -> Any:
        """Volume of bed to a crystal."""
        e = jnp.clip(upflow.void_fraction(size, crystal), 0.0, 0.999)
        return crystal.volume_shape_factor * size**3 / (1.0 - e)

    def excess(c: Any) -> Any:
        number = number_at(c)
        return jnp.log(jnp.maximum(number * along(room, c, number), 1e-300)) - jnp.log(volume)

    small = supersaturated & (excess(jnp.where(supersaturated, saturated, 1.0)) > 0.0)
    ends = jnp.where(small, saturated, 0.0), jnp.where(small, highest, 1.0)
    root = find_root(lambda c: jnp.where(small, excess(c), c - 0.5), *ends)
    # a bed that is more than large enough lets the liquor go saturated
    c = jnp.where(small, root.value, jnp.where(supersaturated, saturated, highest))
    product = jnp.where(supersaturated, jnp.maximum(crystals_at(solute, solvent, c, x), 0.0), 0.0)
    number = product / (cube * high**3)
    held = number * along(lambda size, _there: cube * size**3, c, number)

    limit = soluble(c)

    def born(size: Any, there: Any) -> Any:
        return room(size, there) * nucleation(there, limit, temperature, held / volume)

    return Bed(
        low,
        high,
        c,
        c / limit - 1.0,
        liquor(high, c, number) / limit - 1.0,
        product,
        solute - x * product,
        solvent - (1.0 - x) * product,
        held,
        jnp.where(product > 0.0, along(lambda size, _there: 1.0 + 0.0 * size, c, number), 0.0),
        number,
        number * along(born, c, number),
        found,
        jnp.where(small, root.converged, True),
    )
