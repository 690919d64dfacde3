"""What tested dusts do, as a card."""

from __future__ import annotations

from typing import NamedTuple

from granum.core import procedure
from granum.core.kinds import Concentration, Length, PressureDrop
from granum.dust.kinds import DeflagrationIndex
from granum.streams.dusts import dust


class Explosibility(NamedTuple):
    """A tested dust."""

    particle_diameter: Length
    explosible_concentration: Concentration
    explosion_pressure: PressureDrop
    deflagration_index: DeflagrationIndex


@procedure(source="nfpa68_2013", title="How a dust explodes (tested samples)")
def dust_explosibility(material: str) -> Explosibility:
    """Mass median size, lower explosion limit, greatest pressure (gauge) and K_St of a dust that was tested.

    A first idea: finer or drier dust burns harder, and a design needs the dust itself tested. The table is
    recalled, not opened.

    >>> round(dust_explosibility("wheat starch").deflagration_index / 1e5)
    115
    """
    found = dust(str(material))
    return Explosibility(
        found.median_size,
        found.explosible_concentration,
        found.explosion_pressure,
        found.deflagration_index,
    )
