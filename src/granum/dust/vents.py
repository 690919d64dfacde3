"""The explosion vent of a vessel that dusty gas flows through, as a law that every such machine takes."""

from __future__ import annotations

from typing import Annotated, Any

import equinox as eqx
import jax.numpy as jnp

from granum.core import law
from granum.core.errors import InputError
from granum.core.i18n import _
from granum.core.kinds import Area, AreaOrZero, PositiveNumber, PressureDrop, Volume, Within
from granum.core.units import format_number
from granum.dust.formulas.explosion import BAR, vent_area_en14491
from granum.dust.kinds import DeflagrationIndex


@law(
    "explosion_vent",
    name="explosion_vent",
    source="en14491_2012",
    title="Explosion vent",
    typical={
        "volume": (1.0, 100.0),
        "vent_area": (0.1, 2.0),
        "deflagration_index": (50.0 * BAR, 200.0 * BAR),
        "explosion_pressure": (7.0 * BAR, 10.0 * BAR),
        "reduced_pressure": (0.2 * BAR, 1.0 * BAR),
        "activation_pressure": (0.1 * BAR, 0.2 * BAR),
    },
)
class ExplosionVent(eqx.Module):
    """What a vessel bears and the vent that it has; called with what a dust does, the area that it needs.

    ``reduced_pressure`` is the strength of the vessel, gauge: the explosion may bring it so far. The area is
    that of ``vent_area_en14491``, without duct; none where the vessel bears the whole explosion.
    ``vent_area`` is what is installed, times the venting efficiency of its cover; the machine checks the area
    that it needs against it, so that a share above one says how much larger it must be. K_St and p_max of the
    sample itself go before those of the table of tested dusts.

    By hand: 10 m³, 100 bar m/s, 9 bar, 0.5 bar, 0.1 bar: 3.264e-5·900·0.5^−0.569·10^0.753.

    >>> round(float(ExplosionVent(10.0, "0.5 bar", 0.3)(100e5, 9e5)), 3)
    0.247
    """

    volume: Volume
    reduced_pressure: PressureDrop
    vent_area: Area
    activation_pressure: PressureDrop = 1e4
    length_to_diameter: Annotated[PositiveNumber, Within(1.0, 100.0)] = 1.0
    deflagration_index: DeflagrationIndex | None = None
    explosion_pressure: PressureDrop | None = None

    def __check_init__(self) -> None:
        pair = self.activation_pressure, self.reduced_pressure
        if all(isinstance(v, (int, float)) for v in pair) and pair[0] > pair[1]:
            raise InputError(
                _(
                    "The vent opens at {opens} bar, above the {bears} bar that the vessel may reach: let it "
                    "open ('activation_pressure') at {bears} bar at most, or take a stronger vessel "
                    "('reduced_pressure')."
                ).format(opens=format_number(pair[0] / BAR), bears=format_number(pair[1] / BAR))
            )

    def __call__(self, deflagration_index: DeflagrationIndex, explosion_pressure: PressureDrop) -> AreaOrZero:
        """Vent area that the vessel needs for a dust."""
        found = vent_area_en14491(
            self.volume,
            deflagration_index,
            explosion_pressure,
            self.reduced_pressure,
            self.activation_pressure,
            self.length_to_diameter,
        )
        return jnp.where(jnp.asarray(self.reduced_pressure) >= explosion_pressure, 0.0, found)

    def known(self, of_table: tuple[Any, Any] | None) -> tuple[Any, Any] | None:
        """K_St and p_max: those given, else those of the table; None where one of them is not known."""
        given = self.deflagration_index, self.explosion_pressure
        found = [
            own if own is not None else other
            for own, other in zip(given, of_table or (None, None), strict=True)
        ]
        return None if any(x is None for x in found) else (found[0], found[1])
