"""The stirrer of a crystallizer: what is asked of it, what it does and whether it keeps the crystals up."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import equinox as eqx

from granum.core.kinds import Length, RotationSpeed, SpecificPower, Velocity
from granum.core.limits import Limit
from granum.numerics.smooth import safe_divide
from granum.streams.formulas.stirring import Impeller
from granum.streams.stirrers import Agitation, agitation
from granum.streams.stream import Stream
from granum.streams.units import Limits
from granum.streams.utilities import driven


class Stirring(NamedTuple):
    """Figures of a stirrer."""

    rotation_speed_suspension: RotationSpeed
    tip_speed: Velocity
    specific_power_input: SpecificPower


SUSPENDED: Limits = {
    "suspended": Limit(
        "speed of the stirrer over that which just suspends the crystals",
        1.0,
        math.inf,
        "dimensionless",
        "zwietering1958",
    ),
    "stirrer": Limit(
        "diameter of the stirrer over that of the vessel", 0.2, 0.6, "dimensionless", "zwietering1958"
    ),
}


class Stirred(eqx.Module):
    """A vessel as high as wide with a stirrer. Without a speed it turns just fast enough to keep all crystals
    off the bottom; without a diameter it has a third of that of the vessel. Where the viscosity of the liquid
    is not known, that of water stands in the speed.
    """

    impeller: Impeller = eqx.field(kw_only=True, static=True, default="pitched_blades")
    impeller_diameter: Length | None = eqx.field(kw_only=True, default=None)
    rotation_speed: RotationSpeed | None = eqx.field(kw_only=True, default=None)

    def stirred(self, slurry: Stream, volume: Any) -> Agitation:
        """What the stirrer does to a slurry in one vessel of a volume."""
        return agitation(slurry, volume, self.impeller, self.impeller_diameter, self.rotation_speed)

    def stirrer_figures(self, slurry: Stream, volume: Any) -> Stirring:
        """Its lines of the data sheet."""
        made = self.stirred(slurry, volume)
        return Stirring(made.suspension, made.tip, made.specific)

    def stirrer_measured(self, slurry: Stream, volume: Any) -> dict[str, Any]:
        """What is checked of a stirrer whose speed or diameter is given."""
        made = self.stirred(slurry, volume)
        found = {}
        if self.rotation_speed is not None:
            found["suspended"] = safe_divide(made.speed, made.suspension, math.inf)
        if self.impeller_diameter is not None:
            found["stirrer"] = made.diameter / made.vessel
        return found

    def stirrer_power(self, slurry: Stream, volume: Any, count: Any = 1.0) -> dict[str, Any]:
        """Electric power of the stirrers of some vessels, W; ``None`` where it cannot be known."""
        made = self.stirred(slurry, volume)
        known = made.known or self.rotation_speed is not None
        return {"electric_power_agitator": count * driven(made.power) if known else None}
