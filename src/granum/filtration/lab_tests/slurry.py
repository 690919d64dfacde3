"""What one measures before filtering: jars of slurry, and the curve of the pump."""

from __future__ import annotations

from dataclasses import replace
from typing import Annotated, Any, ClassVar

import numpy as np

from granum.core import lab_test
from granum.core.errors import InputError
from granum.core.i18n import _
from granum.core.kinds import (
    Concentration,
    Density,
    Fraction,
    Mass,
    MassFraction,
    PressureDrop,
    Ratio,
    Series,
    Volume,
    VolumeFlow,
)
from granum.estimation import Fit, LabTest
from granum.estimation.lines import straight_line
from granum.estimation.results import t_reach


@lab_test(
    "slurry_jar",
    source="ruth1935; wakeman2005",
    title="Jars of slurry, filtered and dried",
    equation=(
        r"M_s = s\,M_p,\quad m = \frac{\sum M_{wet}}{\sum M_s},\quad W = \frac{\rho_l s}{1 - m s},\quad "
        r"\varepsilon = 1 - \frac{\sum M_s}{\rho_s\sum V_g}"
    ),
)
class SlurryJar(LabTest):
    """Mass fraction of solids, wet to dry ratio, dry cake per filtrate and void fraction of the cake, each
    with the interval that the jars among one another give it.

    Each row is one jar: its slurry, the wet cake filtered from it, that cake dried, and the volume of the wet
    cake.
    """

    slurry_mass: Annotated[Mass, Series("points")]
    wet_cake_mass: Annotated[Mass, Series("points")]
    dry_cake_mass: Annotated[Mass, Series("points")]
    cake_volume: Annotated[Volume, Series("points")]
    liquid_density: Density = 1000.0
    solid_density: Density = 2630.0

    estimates: ClassVar = {"solids_mass_fraction": MassFraction}
    axes: ClassVar = {"slurry_mass": Mass, "dry_cake_mass": Mass}
    least_points: ClassVar = 2

    def fit(self) -> Fit:
        """Solids, with what the filtration equations need besides."""
        self.above_zero("cake_volume")
        slurry, wet, dry, volume = (
            np.asarray(x, dtype=float)
            for x in (self.slurry_mass, self.wet_cake_mass, self.dry_cake_mass, self.cake_volume)
        )
        if not (np.all(dry > 0) and np.all(wet >= dry) and np.all(slurry >= wet)):
            raise InputError(
                _("Each jar needs slurry, wet cake and dry cake of falling mass, none of them zero."),
                name="dry_cake_mass",
            )
        ratio, ratio_error = _of_sums(wet, dry)
        bulk, bulk_error = _of_sums(volume, dry)
        void = 1.0 - 1.0 / (self.solid_density * bulk)
        flags = []
        full = void * self.liquid_density * volume.sum()  # of liquid in a saturated cake
        if not 0.95 < (wet.sum() - dry.sum()) / full < 1.05:
            sentence = _(
                "The liquid in the wet cakes does not fill their voids to within 5 %: drained cakes, "
                "wrong volumes or a wrong density."
            )
            flags.append(self.note("saturation", sentence, "wet_cake_mass"))

        def derived(p: dict[str, Any]) -> dict[str, Any]:
            s = p["solids_mass_fraction"]
            return {
                "wet_to_dry_mass_ratio": ratio + 0.0 * s,
                "dry_cake_per_filtrate": self.liquid_density * s / (1.0 - ratio * s),
                "void_fraction": void + 0.0 * s,
            }

        found = self.fitted(
            lambda p, M: p["solids_mass_fraction"] * M,
            {"solids_mass_fraction": float(dry.sum() / slurry.sum())},
            slurry,
            dry,
            derived=derived,
            flags=flags,
            bounds={"solids_mass_fraction": (0.0, 1.0)},
            kinds={
                "wet_to_dry_mass_ratio": Ratio,
                "dry_cake_per_filtrate": Concentration,
                "void_fraction": Fraction,
            },
        )
        solids = found["solids_mass_fraction"]
        left = 1.0 - ratio * solids.value
        parts = np.square(
            [solids.standard_error / left**2, solids.value**2 * ratio_error / left**2]
        )  # each over the density of the liquid
        spare = found.degrees_of_freedom
        known = spare * parts.sum() ** 2 / np.sum(parts**2) if parts.sum() > 0.0 else spare
        errors = {
            "wet_to_dry_mass_ratio": (ratio_error, spare),
            "void_fraction": (bulk_error / (self.solid_density * bulk**2), spare),
            "dry_cake_per_filtrate": (float(self.liquid_density * np.sqrt(parts.sum())), float(known)),
        }
        beside = {n: e.within(errors[n][0], t_reach(0.95, errors[n][1])) for n, e in found.derived.items()}
        return replace(found, derived=beside)


def _of_sums(above: np.ndarray, below: np.ndarray) -> tuple[float, float]:
    """One sum over another with its standard error: a line through the origin with a variance in proportion
    to what stands below (Cochran 1977, § 6.3).
    """
    ratio = float(above.sum() / below.sum())
    squares = np.sum((above - ratio * below) ** 2 / below) / max(len(below) - 1, 1)
    return ratio, float(np.sqrt(squares / below.sum()))


@lab_test(
    "pump_curve",
    source="tiller1958",
    title="Curve of the pump of a filter",
    equation=r"\Delta p = p_m\left(1 - \frac{q^2}{q_m^2}\right)",
)
class PumpCurve(LabTest):
    """Pressure at no flow and flow at no pressure of a centrifugal pump, for ``filtration_time_pump``."""

    volume_flow: Annotated[VolumeFlow, Series("points")]
    pressure_drop: Annotated[PressureDrop, Series("points")]

    estimates: ClassVar = {"pressure_shutoff": PressureDrop, "volume_flow_largest": VolumeFlow}
    holds_for: ClassVar = ("volume_flow",)
    axes: ClassVar = {"volume_flow": VolumeFlow, "pressure_drop": PressureDrop}
    least_points: ClassVar = 3

    def fit(self) -> Fit:
        """Both ends of the curve with 95 % intervals."""
        q, dp = np.asarray(self.volume_flow, dtype=float), np.asarray(self.pressure_drop, dtype=float)
        slope, top = straight_line(q**2, dp)
        if slope >= 0 or top <= 0:
            raise InputError(
                _(
                    "The pressure of the pump does not fall with the flow: not a centrifugal pump, or "
                    "swapped columns."
                ),
                name="pressure_drop",
            )
        start = {"pressure_shutoff": float(top), "volume_flow_largest": float((-top / slope) ** 0.5)}
        return self.fitted(
            lambda p, q: p["pressure_shutoff"] * (1.0 - (q / p["volume_flow_largest"]) ** 2),
            start,
            q,
            dp,
            bounds={"pressure_shutoff": (0.0, np.inf), "volume_flow_largest": (0.0, np.inf)},
        )
