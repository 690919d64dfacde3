"""What tested dusts do, as a card."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from granum.core import procedure
from granum.core.i18n import _
from granum.core.kinds import Concentration, Length, MoleFraction, PressureDrop
from granum.dust.kinds import DeflagrationIndex, IgnitionEnergy
from granum.streams.dusts import dust

NOT_TESTED = "not tested"
PRECAUTIONS = (  # up to an ignition energy, J
    (1e-3, "extremely sensitive: no cloud of it beside anything that can be charged; use nitrogen"),
    (0.01, "highly sensitive: earth plant and people, and keep out plastics and liners that hold charge"),
    (0.025, "sensitive, as most dusts that static has set off: earth plant and people, watch heaps in silos"),
    (0.1, "a spark from a person may do: earth plant and people"),
    (0.5, "a spark from an isolated part of the plant may do: earth the plant"),
)
INSENSITIVE = "static hardly ignites it; hot surfaces and friction do"


class Explosibility(NamedTuple):
    """A tested dust."""

    particle_diameter: Length
    explosible_concentration: Concentration
    explosion_pressure: PressureDrop
    deflagration_index: DeflagrationIndex
    limiting_oxygen: MoleFraction
    ignition_energy: IgnitionEnergy
    static_precautions: str


@procedure(
    source="nfpa68_2013; nfpa69_2019; mittal2013; jacobson1961; jacobson1964; iec60079_32_1_2013",
    title="How a dust explodes (tested samples)",
)
def dust_explosibility(material: str) -> Explosibility:
    """What a tested dust does: median size, lower explosion limit, greatest pressure (gauge), K_St, the
    oxygen and the spark that it needs.

    A first idea: finer or drier dust burns harder, and a design needs the dust itself tested. The tables are
    recalled, not opened, but for the oxygen of coal. Limiting oxygen (with nitrogen) and ignition energy are
    those of other samples of the same dust, unknown where no such sample is in the table; what follows from
    the energy are the steps of the guidance on static electricity.

    >>> round(dust_explosibility("wheat starch").deflagration_index / 1e5)
    115
    """
    found = dust(str(material))
    return Explosibility(
        found.median_size,
        found.explosible_concentration,
        found.explosion_pressure,
        found.deflagration_index,
        found.limiting_oxygen,
        found.ignition_energy,
        _(precautions(found.ignition_energy)),
    )


def precautions(ignition_energy: float) -> str:
    """What an ignition energy asks for against static electricity."""
    if np.isnan(ignition_energy):
        return NOT_TESTED
    return next((says for most, says in PRECAUTIONS if ignition_energy <= most), INSENSITIVE)
