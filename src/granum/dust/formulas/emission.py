"""Emission of dust as permits state it."""

from __future__ import annotations

from typing import Annotated

import jax.numpy as jnp

from granum.core import formula, impossible
from granum.core.errors import InputError
from granum.core.i18n import _
from granum.core.kinds import Concentration, MassFlow, MoleFraction, VolumeFlow, Within

AIR_OXYGEN = 0.2095  # of dry air by volume
Oxygen = Annotated[MoleFraction, Within(0.0, AIR_OXYGEN)]
ONLY_AIR = "Gas with the oxygen of air has burnt nothing: it cannot be referred to less oxygen."


@formula(
    source="taluft2021, no. 2.5",
    equation=r"c = \frac{\dot m}{Q_n}\,\frac{0.2095 - x_{ref}}{0.2095 - x}",
    typical={
        "mass_flow": (1e-6, 1e-4),
        "volume_flow_normal": (0.5, 20.0),
        "oxygen_fraction": (0.05, 0.19),
        "oxygen_reference": (0.03, 0.17),
    },
    output="emission_concentration",
    title="Emission of dust, dry and at reference oxygen",
    symbols={
        "volume_flow_normal": r"Q_n",
    },
)
def emission_concentration(
    mass_flow: MassFlow,
    volume_flow_normal: VolumeFlow,
    oxygen_fraction: Oxygen | None = None,
    oxygen_reference: Oxygen | None = None,
) -> Concentration:
    """Dust per dry gas at 0 °C, 1 atm; of flue gas carried to a reference oxygen, which undoes dilution by
    air.

    Without a reference, as for the exhaust of a dryer heated by steam, nothing is corrected.

    By hand: 36 g/h in 1 m³/s are 10 mg/m³; at 16 % oxygen and a reference of 11 %, 20.1.

    >>> round(emission_concentration("36 g/hour", 1.0) * 1e6, 6)
    10.0
    >>> round(emission_concentration("36 g/hour", 1.0, 0.16, 0.11) * 1e6, 1)
    20.1
    """
    plain = mass_flow / jnp.where(volume_flow_normal > 0.0, volume_flow_normal, jnp.nan)
    if oxygen_fraction is None and oxygen_reference is None:
        return plain
    if oxygen_fraction is None or oxygen_reference is None:
        raise InputError(_("Oxygen and its reference go together: give both or neither."))
    burnt = AIR_OXYGEN - oxygen_fraction
    impossible(~(burnt > 0.0), oxygen_fraction, "oxygen_fraction", 0.0, AIR_OXYGEN, ONLY_AIR)
    return plain * (AIR_OXYGEN - oxygen_reference) / jnp.where(burnt > 0.0, burnt, jnp.nan)
