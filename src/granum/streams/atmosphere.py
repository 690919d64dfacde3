"""Whether a gas that holds the vapor of a solvent may burn: by how little vapor there is in air, or by how
little oxygen beside an inert gas.
"""

from __future__ import annotations

from typing import Any

import jax.numpy as jnp
import numpy as np

from granum.core.limits import Limit
from granum.numerics import safe_divide
from granum.streams.equilibrium import HumidMixture
from granum.streams.mixture import AIR, Mixture
from granum.streams.stream import Stream
from granum.streams.units import Limits

MOST_OXYGEN = 0.6  # of the limiting oxygen, where it is not watched all the time
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
    moles = gas.gas / humid.molar_masses
    present = sum(moles[i] * OXYGEN.get(species.name, 0.0) for i, species in enumerate(gas.mixture.gases))
    oxygen = safe_divide(present, moles.sum()) / burns.limiting_oxygen
    return {"lean": jnp.where(oxygen > MOST_OXYGEN, vapor, 0.0), "inert": oxygen}
