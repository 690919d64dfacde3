"""Fines that a gas takes from a solid it meets: which share of each species and size class goes, and the gas
with them. Every dryer, mill or hood that gives off dust says only where its solid meets the gas.
"""

from __future__ import annotations

from typing import Any

import jax.numpy as jnp

from granum.numerics.smooth import safe_divide
from granum.particles.formulas.terminal import terminal_velocity
from granum.streams.stream import Stream

LEAST, THIN = 1e-12, 1e-3


def fall(solid: Stream, gas: Stream, density: Any = None) -> Any:
    """Terminal velocity in the gas of each species and size class of the solid, m/s; ``density`` where the
    particles have pores.
    """
    m = solid.mixture
    each = m.densities("solids", solid.temperature) if density is None else jnp.full(len(m.solids), density)
    heavy = each[:, None] + 0.0 * jnp.asarray(m.sizes)
    thin = jnp.where(gas.gas_volume_flow > 0.0, gas.gas_density, THIN)
    found = terminal_velocity(jnp.asarray(m.sizes) + 0.0 * heavy, heavy, thin, gas.gas_viscosity)
    return jnp.maximum(found, 0.0)


def held(falling: Any, gas: Stream, floor: Any) -> Any:
    """Share that gas kept evenly mixed by turbulence still holds when it has passed over a floor."""
    return jnp.exp(-_settled(falling, gas, floor))


def showered(falling: Any, gas: Stream, floor: Any, section: Any) -> Any:
    """Share that leaves with the gas where the solid is showered through it evenly along a floor; nothing of
    what falls faster than the gas flows in its section.
    """
    settled = _settled(falling, gas, floor)
    some = settled > 1e-6
    mean = jnp.where(some, -jnp.expm1(-settled) / jnp.where(some, settled, 1.0), 1.0)
    return jnp.where(lifted(falling, gas, section), mean, 0.0)


def lifted(falling: Any, gas: Stream, section: Any) -> Any:
    """Whether each species and size class falls slower than the gas flows in a section."""
    return falling * section < gas.gas_volume_flow


def finest(solid: Stream, share: Any) -> Any:
    """Share of each species and size class that goes where a share of all solid does, the finest first."""
    by_size = solid.solid_by_size
    gone, below = share * solid.solid_flow, jnp.cumsum(by_size) - by_size
    found = jnp.where(by_size > 0.0, jnp.clip(safe_divide(gone - below, by_size), 0.0, 1.0), 0.0)
    return jnp.broadcast_to(found, (len(solid.mixture.solids), found.shape[0]))


def parted(solid: Stream, share: Any, moisture: Any = None) -> tuple[Stream, Stream]:
    """The solid without its fines, and the fines; moisture goes with its solid, alike on all of it unless
    ``moisture`` says how much there is on each size class.
    """
    whole = share.reshape(share.shape + (1,) * len(solid.mixture.axes))
    moist = safe_divide(jnp.sum(solid.solid * whole), solid.solid_flow)
    if moisture is not None:
        moist = safe_divide(jnp.sum(by_size(solid, share) * moisture), jnp.sum(moisture), moist)
    dust = solid.part(solid=whole, liquid=moist)
    return solid.replace(solid=solid.solid - dust.solid, liquid=solid.liquid - dust.liquid), dust


def by_size(solid: Stream, share: Any) -> Any:
    """Share of each size class, all species and further axes together."""
    whole = share.reshape(share.shape + (1,) * len(solid.mixture.axes))
    axes = (0, *range(2, solid.solid.ndim))
    return safe_divide(jnp.sum(solid.solid * whole, axis=axes), solid.solid_by_size)


def _settled(falling: Any, gas: Stream, floor: Any) -> Any:
    return falling * floor / jnp.maximum(gas.gas_volume_flow, LEAST)
