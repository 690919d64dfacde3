"""One mixed membrane stage: the flux at which permeate, polarization and osmotic pressure agree.

The flux is the one unknown. It says how much permeate leaves and how much of each solute with it; what is
left has an osmotic pressure at the wall, and against that the pressure must drive just this flux.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, NamedTuple

import jax.numpy as jnp

from granum.core.errors import CaseError
from granum.core.i18n import _
from granum.filtration.formulas.membrane_transport import (
    osmotic_pressure_activity,
    polarization_modulus,
)
from granum.numerics import find_root
from granum.numerics.smooth import safe_divide
from granum.streams.from_materials import activity_laws
from granum.streams.mixture import Mixture
from granum.streams.stream import Stream

MOST = 0.98  # of the solvent, which never permeates wholly
LEAST_ACTIVITY = 1e-6


class Membrane(NamedTuple):
    """What a stage asks of its membrane.

    Parameters
    ----------
    area: m². pressure: across the membrane, Pa. mass_transfer_coefficient: m/s.
    permeance: of (a stream like the permeate) → m/(s Pa).
    passage: of (flux, polarization modulus) → concentration in the permeate over that of the bulk, for each
        liquid; the first, the solvent, is not asked.
    through: share of each species and size class of solid that passes with the liquid it is in.
    gel: solids and held-back solute per volume of liquid at which a gel forms, kg/m³; None where none does.
    law: the flux over these, as measured, in place of all others.
    """

    area: Any
    pressure: Any
    mass_transfer_coefficient: Any
    permeance: Callable[[Stream], Any]
    passage: Callable[[Any, Any], Any]
    through: Any
    gel: Any = None
    law: Callable[[Any], Any] | None = None


class Staged(NamedTuple):
    """Retentate and permeate of a stage, its flux and polarization modulus, the osmotic pressure of its
    retentate, and what may be wrong: nothing permeates, or nothing is left.
    """

    retentate: Stream
    permeate: Stream
    flux: Any
    modulus: Any
    osmotic: Any
    driven: Any
    found: Any


@dataclass(frozen=True)
class Osmosis:
    """Osmotic pressure of the solutions of a mixture: each solute as in its own solution with all the
    solvent, by its activity in the library, else as an ideal one of its molar mass.
    """

    mixture: Mixture

    def __post_init__(self) -> None:
        if not self.mixture.liquids:
            raise CaseError(_("A membrane needs a liquid that passes: the mixture has none."))

    def __call__(self, liquid: Any, temperature: Any) -> Any:
        solvent, m = self.mixture.liquids[0], self.mixture
        lowered = jnp.zeros(())
        for i, law in enumerate(activity_laws(m), start=1):
            ratio = safe_divide(liquid[i], liquid[0])
            if law is not None:
                lowered = lowered - jnp.log(jnp.maximum(law(temperature, ratio), LEAST_ACTIVITY))
            else:
                lowered = lowered + ratio * solvent.molar_mass / m.liquids[i].molar_mass
        activity = jnp.maximum(jnp.exp(-lowered), LEAST_ACTIVITY)
        density = m.densities("liquids", temperature)[0]
        return osmotic_pressure_activity(activity, temperature, density, solvent.molar_mass)


def staged(feed: Stream, membrane: Membrane) -> Staged:
    """A stage whose retentate is mixed: the membrane sees what leaves it."""
    osmosis, T = Osmosis(feed.mixture), feed.temperature
    some = feed.liquid[0] > 0.0
    unit = jnp.zeros_like(feed.liquid).at[0].set(1.0)
    there = feed.replace(liquid=jnp.where(some, feed.liquid, unit))
    volumes = there.liquid / feed.mixture.densities("liquids", T)
    whole = jnp.sum(volumes)

    def parted(flux: Any) -> tuple[Stream, Stream, Any, Any]:
        modulus = polarization_modulus(flux, membrane.mass_transfer_coefficient)
        share = flux * membrane.area / whole
        passage = membrane.passage(flux, modulus)
        passes = share * passage / (1.0 - share + share * passage)
        with_solvent = flux * membrane.area - jnp.sum(passes[1:] * volumes[1:])
        passes = passes.at[0].set(with_solvent / volumes[0])
        solid = share * membrane.through / (1.0 - share + share * membrane.through)
        solid = solid.reshape(solid.shape + (1,) * len(feed.mixture.axes))
        permeate = there.part(solid=solid, liquid=passes)
        retentate = there.part(solid=1.0 - solid, liquid=1.0 - passes, gas=1.0)
        return retentate, permeate, passage.at[0].set(1.0), modulus

    def excess(flux: Any) -> Any:
        retentate, _permeate, passage, modulus = parted(flux)
        wall = retentate.liquid * (passage + (1.0 - passage) * modulus)
        beyond = retentate.replace(liquid=retentate.liquid * passage)
        driving = membrane.pressure - osmosis(wall, T) + osmosis(beyond.liquid, T)
        reached = membrane.permeance(beyond) * driving
        if membrane.gel is not None:
            held = matter(retentate, membrane)
            room = jnp.log(membrane.gel / jnp.maximum(held, 1e-12 * membrane.gel))
            reached = jnp.minimum(reached, membrane.mass_transfer_coefficient * room)
        if membrane.law is not None:
            reached = membrane.law(matter(retentate, membrane))
        return reached - flux

    most = MOST * volumes[0] / membrane.area
    driven = excess(0.0) > 0.0
    root = find_root(excess, 0.0, most, start=jnp.minimum(membrane.mass_transfer_coefficient, 0.5 * most))
    flux = jnp.where(driven & root.converged, root.value, 0.0)
    retentate, permeate, _passage, modulus = parted(flux)
    kept, gone = 1.0 * some, permeate.part(solid=1.0 * some, liquid=1.0 * some)
    solid_left = jnp.where(some, retentate.solid, feed.solid)
    left = retentate.replace(solid=solid_left, liquid=jnp.where(some, retentate.liquid, feed.liquid))
    osmotic = osmosis(jnp.where(some, retentate.liquid, unit), T)
    return Staged(left, gone, kept * flux, modulus, osmotic, driven | ~some, ~driven | root.converged | ~some)


def matter(retentate: Stream, membrane: Membrane) -> Any:
    """What a membrane holds back, per volume of liquid, each solute and solid by the share that it is held
    back, kg/m³.
    """
    passage = membrane.passage(0.0, 1.0)
    solid = jnp.sum(retentate.solid, axis=tuple(range(2, retentate.solid.ndim)))
    held = jnp.sum(solid * (1.0 - membrane.through))
    held = held + jnp.sum(((1.0 - passage) * retentate.liquid)[1:])
    return safe_divide(held, retentate.liquid_volume_flow)
