"""The leaf filter test at constant pressure: filtrate volume against time gives cake and medium
resistance.
"""

from __future__ import annotations

from typing import Annotated, Any, ClassVar

import numpy as np

from granum.core import lab_test
from granum.core.errors import InputError
from granum.core.i18n import _
from granum.core.kinds import (
    Area,
    CakeResistance,
    Concentration,
    DynamicViscosity,
    MediumResistance,
    PressureDrop,
    Series,
    Time,
    Volume,
    Within,
)
from granum.core.units import format_number
from granum.estimation import Fit, LabTest
from granum.estimation.lines import straight_line
from granum.filtration.kinds import RuthConstant, TimePerVolume, TimePerVolumeSquared
from granum.filtration.lab_tests.starts import bad_start, bend

NOTICEABLE_BEND = 0.3


@lab_test(
    "leaf_test",
    source="ruth1935; geankoplis2003, § 14.2",
    title="Leaf filter test at constant pressure",
    equation=(
        r"\frac{t}{V} = \frac{\eta\,\alpha\,W}{2\,\Delta p\,\Omega^2}\,V + \frac{\eta\,R_s}{\Delta "
        r"p\,\Omega}"
    ),
)
class LeafTest(LabTest):
    """Specific cake resistance and medium resistance from filtrate volume against time at constant
    pressure.

    The straight line of t/V against V is fitted with equal scatter of t/V, which is what a constant reading
    error of the volume gives. A first row at time zero is the origin, not a point. First points that do not
    belong to the line are found and left out, and said so in the flags; ``first_points_excluded`` sets their
    number instead. A bend that the line cannot follow is flagged.
    """

    time: Annotated[Time, Series("points")]
    filtrate_volume: Annotated[Volume, Series("points")]
    area: Area
    pressure_drop: PressureDrop
    dynamic_viscosity: DynamicViscosity
    dry_cake_per_filtrate: Concentration
    first_points_excluded: Annotated[int, Within(0, 10_000)] | None = None

    estimates: ClassVar = {"cake_resistance": CakeResistance, "medium_resistance": MediumResistance}
    holds_for: ClassVar = ("pressure_drop",)
    axes: ClassVar = {"filtrate_volume": Volume, "time_per_filtrate_volume": TimePerVolume}

    def fit(self) -> Fit:
        """Cake and medium resistance with 95 % intervals; Ruth's constants beside them."""
        self.increasing("time")
        self.increasing("filtrate_volume", strictly=False)
        counted = (np.asarray(self.time) > 0) & (np.asarray(self.filtrate_volume) > 0)
        t, V = np.asarray(self.time)[counted], np.asarray(self.filtrate_volume)[counted]
        if len(V) < 3 or V[-1] == V[0]:
            raise InputError(
                _(
                    "The test needs at least 3 points with filtrate at different volumes; {given} were given."
                ).format(given=len(V))
            )
        excluded, flags = self._excluded(V, t / V)
        kept = np.arange(len(V)) >= excluded
        eta, W, dp, A = self.dynamic_viscosity, self.dry_cake_per_filtrate, self.pressure_drop, self.area
        if not W > 0:
            raise InputError(
                _("'dry_cake_per_filtrate' must be greater than zero."), name="dry_cake_per_filtrate"
            )
        per_slope, per_intercept = eta * W / (2.0 * dp * A**2), eta / (dp * A)
        slope, intercept = straight_line(V[kept], (t / V)[kept])
        if slope <= 0:
            flags.append(
                self.note(
                    "no cake",
                    _("t/V does not rise with V: no cake resistance shows in these data."),
                    "cake_resistance",
                )
            )
        if intercept < 0:
            flags.append(
                self.note(
                    "negative intercept",
                    _(
                        "The line meets V = 0 below zero (medium resistance {value} 1/m): it is held at "
                        "zero. Check the start of the clock."
                    ).format(value=format_number(intercept / per_intercept)),
                    "medium_resistance",
                )
            )

        def model(p: dict[str, Any], V: Any) -> Any:
            return p["cake_resistance"] * per_slope * V + p["medium_resistance"] * per_intercept

        def constants(p: dict[str, Any]) -> dict[str, Any]:
            a, V0 = (
                1.0 / (p["cake_resistance"] * per_slope),
                p["medium_resistance"] * per_intercept / (2.0 * p["cake_resistance"] * per_slope),
            )
            return {
                "ruth_constant": a,
                "ruth_volume": V0,
                "ruth_time": V0**2 / a,
                "line_slope": p["cake_resistance"] * per_slope,
                "line_intercept": p["medium_resistance"] * per_intercept,
            }

        scale = {
            "cake_resistance": abs(slope) / per_slope,
            "medium_resistance": np.mean(t / V) / per_intercept,
        }
        start = {
            "cake_resistance": scale["cake_resistance"],
            "medium_resistance": max(intercept, 0.01 * np.mean(t / V)) / per_intercept,
        }
        return self.fitted(
            model,
            start,
            V,
            t / V,
            index=np.flatnonzero(counted),
            keep=kept,
            scale=scale,
            derived=constants,
            flags=flags,
            bounds={"cake_resistance": (0.0, np.inf), "medium_resistance": (0.0, np.inf)},
            kinds={
                "ruth_constant": RuthConstant,
                "ruth_volume": Volume,
                "ruth_time": Time,
                "line_slope": TimePerVolumeSquared,
                "line_intercept": TimePerVolume,
            },
        )

    def _excluded(self, V: np.ndarray, ratio: np.ndarray) -> tuple[int, list[dict[str, Any]]]:
        """Number of first points to leave out, with what to say about the start and the bend."""
        flags = []
        count = bad_start(V, ratio) if self.first_points_excluded is None else self.first_points_excluded
        if not 0 <= count <= len(V) - 3:
            raise InputError(
                _("'first_points_excluded' = {count} leaves too few of the {given} points.").format(
                    count=count, given=len(V)
                ),
                name="first_points_excluded",
            )
        if count:
            sentence = _("First points left out: {count}.").format(count=count)
            if self.first_points_excluded is None:
                sentence += " " + _(
                    "The line of the others misses them: pressure not yet steady, late clock, or a "
                    "first layer unlike the rest."
                )
            flags.append(self.note("points excluded", sentence, "filtrate_volume"))
        change = bend(V[count:], ratio[count:])
        if change < -NOTICEABLE_BEND:
            sentence = _(
                "t/V against V bends down: solid settles instead of forming cake, or the cake cracks. "
                "The resistances are averages."
            )
            flags.append(self.note("bent line", sentence, "time_per_filtrate_volume"))
        elif change > NOTICEABLE_BEND:
            sentence = _(
                "t/V against V bends up: the medium or the cake blinds, or the chamber is full. The "
                "resistances are averages."
            )
            flags.append(self.note("bent line", sentence, "time_per_filtrate_volume"))
        return count, flags
