"""Whether a gas that holds the vapor of a solvent, or dust, may burn: by how little of it there is in air, or
by how little oxygen beside an inert gas.
"""

from __future__ import annotations

from typing import Any

import jax.numpy as jnp
import numpy as np

from granum.core.errors import InputError
from granum.core.limits import Limit
from granum.numerics import safe_divide
from granum.streams.dusts import COARSEST, dust
from granum.streams.equilibrium import HumidMixture
from granum.streams.mixture import AIR, Mixture
from granum.streams.stream import Stream
from granum.streams.units import Limits

MOST_OXYGEN = 0.6  # of the limiting oxygen, where it is not watched all the time
STARVED = 0.05  # mole fraction of oxygen, with some margin below what organic dusts burn in
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
    )
}


def inerted(mixture: Mixture) -> bool:
    """Whether a gas that does not burn and brings no oxygen carries the vapor, so that the lack of oxygen is
    what keeps it safe.
    """
    humid = HumidMixture(mixture)
    others = [gas.name for gas in mixture.gases if gas.name != humid.solvent and gas.name not in OXYGEN]
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
    known over that limit, added up as Le Chatelier does; nothing where no such solid is in the mixture.
    """
    m = gas.mixture
    limits = [_lower_limit(m, species.name) for species in m.solids]
    if all(limit is None for limit in limits):
        return {}
    fine = gas.by_size(jnp.asarray(m.sizes) <= COARSEST)
    flying = jnp.sum(gas.solid * fine, axis=tuple(range(1, gas.solid.ndim)))
    share = sum((flying[i] / limit for i, limit in enumerate(limits) if limit), jnp.zeros(()))
    over = safe_divide(share, gas.gas_volume_flow)
    return {"explosible": jnp.where(oxygen_of(gas) > STARVED, over, 0.0)}


def _lower_limit(mixture: Mixture, name: str) -> float | None:
    """Of the dust of a solid, kg/m³; None for what the library does not know as a dust that burns."""
    try:
        like = mixture.materials.solid(name).dust
    except InputError:
        return None
    return dust(like).explosible_concentration if like else None
