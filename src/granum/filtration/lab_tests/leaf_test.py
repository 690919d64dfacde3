"""Tests at constant pressure whose t/V is a straight line over V: the leaf filter test, and the fouling index
of a water.
"""

from __future__ import annotations

import abc
from typing import TYPE_CHECKING, Annotated, Any, ClassVar

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
from granum.filtration.formulas.constant_pressure import filtration_time_constant_pressure
from granum.filtration.formulas.fouling_index import (
    MFI_AREA,
    MFI_PRESSURE,
    MFI_VISCOSITY,
    SDI_PRESSURE,
    SDI_SAMPLE,
    SDI_TIME,
    TOO_DIRTY,
    modified_fouling_index,
    silt_density_index_cake,
)
from granum.filtration.kinds import (
    FoulingPotential,
    RuthConstant,
    SiltDensityIndex,
    TimePerVolume,
    TimePerVolumeSquared,
)
from granum.filtration.lab_tests.starts import bad_start, bend

NOTICEABLE_BEND = 0.3


Excluded = Annotated[int, Within(0, 10_000)]


class ConstantPressureTest(LabTest):
    """Abstract test at constant pressure: filtrate volume against time, on one area."""

    time: Annotated[Time, Series("points")]
    filtrate_volume: Annotated[Volume, Series("points")]
    area: Area
    pressure_drop: PressureDrop
    dynamic_viscosity: DynamicViscosity

    if TYPE_CHECKING:
        first_points_excluded: Any

    holds_for: ClassVar = ("pressure_drop",)
    axes: ClassVar = {"filtrate_volume": Volume, "time_per_filtrate_volume": TimePerVolume}

    @abc.abstractmethod
    def told(self, p: dict[str, Any], slope: Any, intercept: Any) -> dict[str, Any]:
        """Figures beside the estimates, from these and the line."""

    def lined(
        self,
        resistance: str,
        per_volume: float,
        flags: list[dict[str, Any]],
        kinds: dict[str, Any],
    ) -> Fit:
        """The straight line of t/V over V, told as the resistance of that name, of which each volume of
        filtrate brings ``per_volume``, and as that of the medium.
        """
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
        excluded, said = self._excluded(V, t / V)
        flags = [*flags, *said]
        kept = np.arange(len(V)) >= excluded
        eta, dp, A = self.dynamic_viscosity, self.pressure_drop, self.area
        per_slope, per_intercept = eta * per_volume / (2.0 * dp * A**2), eta / (dp * A)
        slope, intercept = straight_line(V[kept], (t / V)[kept])
        if slope <= 0:
            flags.append(
                self.note(
                    "no cake",
                    _("t/V does not rise with V: no cake resistance shows in these data."),
                    resistance,
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
            return p[resistance] * per_slope * V + p["medium_resistance"] * per_intercept

        def derived(p: dict[str, Any]) -> dict[str, Any]:
            return self.told(p, p[resistance] * per_slope, p["medium_resistance"] * per_intercept)

        scale = {
            resistance: abs(slope) / per_slope,
            "medium_resistance": np.mean(t / V) / per_intercept,
        }
        start = {
            resistance: scale[resistance],
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
            derived=derived,
            flags=flags,
            bounds={resistance: (0.0, np.inf), "medium_resistance": (0.0, np.inf)},
            kinds=kinds,
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


@lab_test(
    "leaf_test",
    source="ruth1935; geankoplis2003, § 14.2",
    title="Leaf filter test at constant pressure",
    equation=(
        r"\frac{t}{V} = \frac{\eta\,\alpha\,W}{2\,\Delta p\,\Omega^2}\,V + \frac{\eta\,R_s}{\Delta "
        r"p\,\Omega}"
    ),
)
class LeafTest(ConstantPressureTest):
    """Specific cake resistance and medium resistance from filtrate volume against time at constant
    pressure.

    The straight line of t/V against V is fitted with equal scatter of t/V, which is what a constant reading
    error of the volume gives. A first row at time zero is the origin, not a point. First points that do not
    belong to the line are found and left out, and said so in the flags; ``first_points_excluded`` sets their
    number instead. A bend that the line cannot follow is flagged.
    """

    dry_cake_per_filtrate: Concentration
    first_points_excluded: Excluded | None = None

    for_two_points: ClassVar = "filtration.resistances_two_volumes"
    estimates: ClassVar = {"cake_resistance": CakeResistance, "medium_resistance": MediumResistance}

    def fit(self) -> Fit:
        """Cake and medium resistance with 95 % intervals; Ruth's constants beside them."""
        if not self.dry_cake_per_filtrate > 0:
            raise InputError(
                _("'dry_cake_per_filtrate' must be greater than zero."), name="dry_cake_per_filtrate"
            )
        kinds = {
            "ruth_constant": RuthConstant,
            "ruth_volume": Volume,
            "ruth_time": Time,
            "line_slope": TimePerVolumeSquared,
            "line_intercept": TimePerVolume,
        }
        return self.lined("cake_resistance", self.dry_cake_per_filtrate, [], kinds)

    def told(self, p: dict[str, Any], slope: Any, intercept: Any) -> dict[str, Any]:
        a, V0 = 1.0 / slope, intercept / (2.0 * slope)
        return {
            "ruth_constant": a,
            "ruth_volume": V0,
            "ruth_time": V0**2 / a,
            "line_slope": slope,
            "line_intercept": intercept,
        }


@lab_test(
    "fouling_index_test",
    source="schippers1980; astm4189; alhadidi2011",
    title="Fouling index of a water",
    equation=(
        r"\frac{t}{V} = \frac{\eta\,I}{2\,\Delta p\,\Omega^2}\,V + \frac{\eta\,R_s}{\Delta p\,\Omega},"
        r"\qquad \mathrm{MFI} = \frac{\eta_{20}\,I}{2\,\Delta p_0\,\Omega_0^2}"
    ),
)
class FoulingIndexTest(ConstantPressureTest):
    """Fouling potential of a water from filtrate against time through a membrane at constant pressure, told
    as modified fouling index and as the silt density index that its cake makes.

    The evaluation is that of the leaf test without the mass of the cake, which such thin waters do not
    let one weigh: I stands for α W. First points while pores block are left out as there. The modified
    index is told at 2 bar, 20 °C and 13.8 cm². The silt density index is that of a cake at 30 psi on the
    membrane of the test; a measured one lies above it by what blocks pores. A cake that yields resists
    more at a higher pressure than the index tells.
    """

    first_points_excluded: Excluded | None = None

    estimates: ClassVar = {"fouling_potential": FoulingPotential, "medium_resistance": MediumResistance}

    def fit(self) -> Fit:
        """Fouling potential and resistance of the membrane with 95 % intervals; both indices beside them."""
        flags = []
        if not 0.8 < self.pressure_drop / MFI_PRESSURE < 1.25:
            sentence = _(
                "Measured at {pressure} bar: the index at 2 bar takes the cake for one that does not yield."
            ).format(pressure=f"{float(self.pressure_drop) / 1e5:.3g}")
            flags.append(self.note("pressure", sentence, "pressure_drop"))
        kinds = {
            "modified_fouling_index": TimePerVolumeSquared,
            "silt_density_index": SiltDensityIndex,
            "line_slope": TimePerVolumeSquared,
            "line_intercept": TimePerVolume,
        }
        found = self.lined("fouling_potential", 1.0, flags, kinds)
        potential, membrane = found.values["fouling_potential"], found.values["medium_resistance"]
        state = (MFI_AREA, SDI_PRESSURE, MFI_VISCOSITY, potential, 1.0, membrane)
        if filtration_time_constant_pressure.function(SDI_SAMPLE, *state) > SDI_TIME:
            found.flags.append(self.note("dirty", _(TOO_DIRTY), "silt_density_index"))
        return found

    def told(self, p: dict[str, Any], slope: Any, intercept: Any) -> dict[str, Any]:
        potential, membrane = p["fouling_potential"], p["medium_resistance"]
        return {
            "modified_fouling_index": modified_fouling_index.function(potential),
            "silt_density_index": silt_density_index_cake.function(potential, membrane),
            "line_slope": slope,
            "line_intercept": intercept,
        }
