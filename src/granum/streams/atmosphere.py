"""Whether a gas that holds the vapor of a solvent, or dust, may burn: by how little of it there is in air, or
by how little oxygen beside an inert gas.
"""

from __future__ import annotations

from typing import Any

import jax.numpy as jnp
import numpy as np

from granum.core.errors import InputError
from granum.core.i18n import _
from granum.core.limits import Limit
from granum.numerics import safe_divide
from granum.streams.dusts import COARSEST, DustData, dust
from granum.streams.equilibrium import HumidMixture
from granum.streams.mixture import AIR, Mixture
from granum.streams.stream import Stream
from granum.streams.units import Limits

MOST_OXYGEN = 0.6  # of the limiting oxygen, where it is not watched all the time
STARVED = 0.05  # mole fraction of oxygen, with some margin below what organic dusts burn in, where untested
OXYGEN = {AIR: 0.2095, "oxygen": 1.0}  # mole fraction

FLAMMABLE: Limits = {
    "lean": Limit(
        "flammable vapor in the exhaust over its lower explosive limit, zero without the oxygen to burn it",
        0.0,
        0.25,
        "dimensionless",
        "nfpa86",
    ),
    "inert": Limit(
        "oxygen in the exhaust over the limiting oxygen for its flammable vapor",
        0.0,
        MOST_OXYGEN,
        "dimensionless",
        "nfpa69",
    ),
}

EXPLOSIBLE: Limits = {
    "explosible": Limit(
        "dust in the gas over its lower explosion limit, zero without the oxygen to burn it",
        0.0,
        0.25,
        "dimensionless",
        "nfpa69_2019, § 8.3; nfpa68_2013",
        quiet=True,
    ),
    "starved": Limit(
        "oxygen in the gas over the limiting oxygen for its dust",
        0.0,
        MOST_OXYGEN,
        "dimensionless",
        "nfpa69_2019, § 7.7",
        quiet=True,
    ),
}

VENTED: Limits = {
    "vent": Limit(
        "vent area that the dust asks for over the vent area of the vessel",
        0.0,
        1.0,
        "dimensionless",
        "en14491_2012",
        quiet=True,
    )
}


def inerted(mixture: Mixture) -> bool:
    """Whether a gas that does not burn and brings no oxygen carries the vapor, so that the lack of oxygen is
    what keeps it safe.
    """
    vapor = mixture.liquids[0].name if mixture.liquids else ""
    others = [gas.name for gas in mixture.gases if gas.name not in (vapor, *OXYGEN)]
    return any(mixture.materials.fluid(name).combustion is None for name in others)


def flammable(gas: Stream) -> dict[str, Any]:
    """What is measured of a gas against ``FLAMMABLE``: the vapor in air, and the oxygen where an inert gas is
    there and its limit is known; nothing of a vapor that does not burn. Limits are those at ambient
    conditions; hot vapor burns a little leaner.
    """
    humid = HumidMixture(gas.mixture)
    burns = humid.fluid.flammability
    if burns is None:
        return {}
    vapor = humid.fraction(gas) / burns.lower_limit
    if not (inerted(gas.mixture) and np.isfinite(burns.limiting_oxygen)):
        return {"lean": vapor}
    oxygen = oxygen_of(gas) / burns.limiting_oxygen
    return {"lean": jnp.where(oxygen > MOST_OXYGEN, vapor, 0.0), "inert": oxygen}


def oxygen_of(gas: Stream) -> Any:
    """Mole fraction of oxygen."""
    moles = [gas.gas[i] / species.molar_mass for i, species in enumerate(gas.mixture.gases)]
    present = [n * OXYGEN.get(s.name, 0.0) for n, s in zip(moles, gas.mixture.gases, strict=True)]
    return safe_divide(sum(present, jnp.zeros(())), sum(moles, jnp.zeros(())))


def explosible(gas: Stream) -> dict[str, Any]:
    """What is measured of a gas against ``EXPLOSIBLE``: the dust of each solid whose lower explosion limit is
    known over that limit, added up as Le Chatelier does, and where an inert gas is there the oxygen over the
    limiting oxygen of the dust that burns with the least; nothing where no such solid is in the mixture.
    """
    m = gas.mixture
    dusts = [_dust(m, species.name) for species in m.solids]
    if all(found is None for found in dusts):
        return {}
    flying = _flying(gas)
    oxygen = oxygen_of(gas)
    share = sum(
        (
            jnp.where(oxygen > _starving(found), flying[i] / found.explosible_concentration, 0.0)
            for i, found in enumerate(dusts)
            if found
        ),
        jnp.zeros(()),
    )
    measured = {"explosible": safe_divide(share, gas.gas_volume_flow)}
    tested = [(i, d.limiting_oxygen) for i, d in enumerate(dusts) if d and np.isfinite(d.limiting_oxygen)]
    if tested and inerted(m):
        over = [jnp.where(flying[i] > 0.0, oxygen / limit, 0.0) for i, limit in tested]
        measured["starved"] = jnp.max(jnp.stack(over))
    return measured


def _starving(found: DustData | None) -> float:
    """Mole fraction of oxygen in which a dust certainly does not burn."""
    tested = found is not None and np.isfinite(found.limiting_oxygen)
    return MOST_OXYGEN * found.limiting_oxygen if found is not None and tested else STARVED


def _vent_needed(gas: Stream, vent: Any, coarse: bool) -> Any:
    """The vent area that a vessel needs for the dust that flies in a gas, the fiercest where several do; zero
    where nothing can explode.
    """
    m = gas.mixture
    dusts = [_dust(m, species.name) for species in m.solids]
    known = [vent.known(d and (d.deflagration_index, d.explosion_pressure)) for d in dusts]
    if all(pair is None for pair in known):
        raise InputError(
            _(
                "The explosion vent needs to know how the dust explodes, which the library does not say of "
                "{names}: give 'deflagration_index' and "
                "'explosion_pressure' of the vent."
            ).format(names=", ".join(species.name for species in m.solids))
        )
    oxygen, flying = oxygen_of(gas), _by_species(gas) if coarse else _flying(gas)
    areas = [
        jnp.where((flying[i] > 0.0) & (oxygen > _starving(dusts[i])), vent(*pair), 0.0)
        for i, pair in enumerate(known)
        if pair
    ]
    return jnp.max(jnp.stack(areas))


def vented(gas: Stream, vent: Any, coarse: bool = False) -> dict[str, Any]:
    """What is measured of a gas against ``VENTED``: the vent area that its dust asks for over that of the
    vessel's ``explosion_vent``; nothing without one. ``coarse``: of a solid whose dust the size classes need
    not know, such as grain.
    """
    return {} if vent is None else {"vent": _vent_needed(gas, vent, coarse) / vent.vent_area}


def _flying(gas: Stream) -> Any:
    """Of each solid what is fine enough to burn as dust, kg/s."""
    fine = gas.by_size(jnp.asarray(gas.mixture.sizes) <= COARSEST)
    return _by_species(gas.replace(solid=gas.solid * fine))


def _by_species(gas: Stream) -> Any:
    """Solid of each species, kg/s."""
    return jnp.sum(gas.solid, axis=tuple(range(1, gas.solid.ndim)))


def _dust(mixture: Mixture, name: str) -> DustData | None:
    """Of a solid; None for what the library does not know as a dust that burns."""
    try:
        like = mixture.materials.solid(name).dust
    except InputError:
        return None
    return dust(like) if like else None
