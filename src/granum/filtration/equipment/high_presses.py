"""Automatic presses that squeeze a thin cake on one face and far harder than it was filtered: towers of
horizontal plates, and tubes.
"""

from __future__ import annotations

from typing import Annotated, Any, ClassVar

import equinox as eqx

from granum.core import equipment
from granum.core.kinds import Length, PressureDrop, Ratio, Time, Within
from granum.core.limits import Limit
from granum.filtration.equipment.batch import HARDER, CandleFilter, FlatFilter, SqueezingFilter
from granum.filtration.equipment.cake_filter import Caked, CakeFigures
from granum.filtration.squeezing import void_ratio
from granum.streams.cakes import Filtered
from granum.streams.stream import Stream
from granum.streams.units import Limits

TUBE = "ausimm1989; metso2020"
EQUATION = (
    r"1-\varepsilon_e = (1-\varepsilon)\left(\frac{p_e}{\Delta p}\right)^{\beta},\qquad "
    r"U = U\!\left(\frac{C_e\,t_s}{\omega_0^2}\right)"
)
Exponent = Annotated[Ratio, Within(0.0, 0.5)]


class HighPress(SqueezingFilter):
    """Abstract press with a squeezing pressure of its own: solids by volume grow with its power
    ``compaction_exponent`` over the pressure at which the cake was formed.
    """

    squeezing_pressure: PressureDrop
    compaction_exponent: Exponent

    limits: ClassVar[Limits] = SqueezingFilter.limits | {"harder": HARDER}

    @property
    def void_fraction_packed(self) -> Any:
        packed = 1.0 - self.void_fraction
        ratio = void_ratio(
            self.squeezing_pressure, packed, self.pressure_drop, self.compaction_exponent, packed
        )
        return ratio / (1.0 + ratio)

    @property
    def pressure_end(self) -> Any:
        return self.squeezing_pressure

    def measured(
        self, inside: Caked, outlets: Filtered, figures: CakeFigures, feed: Stream, wash: Stream | None = None
    ) -> dict[str, Any]:
        return super().measured(inside, outlets, figures, feed, wash) | {
            "pressure": self.pressure_drop,
            "squeeze": self.squeezing_pressure,
            "harder": self.squeezing_pressure / self.pressure_drop,
            "cake": self.full_thickness,
            "cycle": inside.plan.cycle_time,
        }


@equipment("tower_press", source="wakeman2005; tiller1953", title="Tower filter press", equation=EQUATION)
class TowerPress(HighPress, FlatFilter):
    """Horizontal plates one above the other on one endless cloth: the cake forms on it, a membrane squeezes
    it from above, air blows it, and the cloth carries it out of all chambers at once.

    The area is that of the cloth under the chambers, the thickness that of the cake before squeezing. Ranges
    recalled, not opened.
    """

    full_cake_thickness: Length
    squeezing_time: Time = eqx.field(kw_only=True, default=120.0)
    dead_time: Time = eqx.field(kw_only=True, default=180.0)

    limits: ClassVar[Limits] = (
        FlatFilter.limits
        | HighPress.limits
        | {
            "pressure": Limit("pressure drop of a press", 1e5, 1.6e6, "Pa", "wakeman2005"),
            "squeeze": Limit("squeezing pressure", 4e5, 1.6e6, "Pa", "wakeman2005"),
            "cake": Limit("cake thickness in a tower press", 0.015, 0.075, "m", "wakeman2005"),
            "cycle": Limit("cycle time of an automatic press", 300.0, 1800.0, "s", "wakeman2005"),
        }
    )

    @property
    def full_thickness(self) -> Any:
        return self.full_cake_thickness


@equipment("tube_press", source=TUBE, title="Tube filter press", equation=EQUATION)
class TubePress(HighPress, CandleFilter):
    """Candle in a casing with a bladder between: slurry fills the annulus, and water behind the bladder first
    filters it and then squeezes the cake on the candle with a pressure no plate would bear.

    The area is that of the candles, the thickness that of the cake before squeezing, of which consolidation
    is reckoned as on a plane. Only the squeezing pressure is from the sources; ranges of cake and cycle
    recalled, not opened.
    """

    squeezing_time: Time = eqx.field(kw_only=True, default=180.0)
    dead_time: Time = eqx.field(kw_only=True, default=120.0)

    limits: ClassVar[Limits] = (
        CandleFilter.limits
        | HighPress.limits
        | {
            "pressure": Limit("pressure drop of a tube press", 1e5, 1.4e7, "Pa", TUBE),
            "squeeze": Limit("squeezing pressure", 4e6, 1.4e7, "Pa", TUBE),
            "cake": Limit("cake thickness in a tube press", 0.004, 0.025, "m", "wakeman2005"),
            "cycle": Limit("cycle time of an automatic press", 300.0, 1800.0, "s", "wakeman2005"),
        }
    )
