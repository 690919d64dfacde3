"""The Proctor–Fagerberg test: how moist a cake may be so that its heap does not flow in a ship's hold."""

from __future__ import annotations

from typing import Annotated, Any, ClassVar

import numpy as np

from granum.core import lab_test
from granum.core.errors import InputError
from granum.core.i18n import _
from granum.core.kinds import (
    Density,
    MoistureWetBasis,
    Number,
    PositiveNumber,
    Ratio,
    Series,
    VoidFraction,
    Within,
)
from granum.estimation import Fit, LabTest
from granum.filtration.formulas.flowability import transportable_moisture_limit_compacted


@lab_test(
    "proctor_fagerberg_test",
    source="imsbc2008, app. 2",
    title="Proctor–Fagerberg test of a cake",
    equation=(
        r"e = \frac{\rho_s}{\rho_b\,(1 - x)} - 1,\quad e_v = \frac{\rho_s}{\rho_l}\,\frac{x}{1 - x},\quad "
        r"e = e_k + b\,(e_v - S_k e_k) + c\,(e_v - S_k e_k)^2,\quad x_t = x(e_v = S_k e_k)"
    ),
)
class ProctorFagerbergTest(LabTest):
    """Transportable moisture limit of a cake from its density after compaction at five to ten moistures, from
    nearly dry to nearly full of water.

    Each row is one sample, dropped on in layers in the mold of a liter: its moisture and its wet bulk
    density. The void ratio is fitted as a parabola over the volume of water per volume of solid, with
    scatter of the density; the limit is where water fills the critical share of the voids, 0.7, or 0.8
    for iron ore fines. The method is for grains up to 5 mm and not for coal or other porous solids, which
    have their own. A sample that drains before that share is reached cannot liquefy by this measure.
    """

    moisture_wet_basis: Annotated[MoistureWetBasis, Series("points")]
    bulk_density_wet: Annotated[Density, Series("points")]
    solid_density: Density
    liquid_density: Density = 1000.0
    saturation_critical: Annotated[Ratio, Within(0.5, 0.95)] = 0.7

    least_points: ClassVar[int] = 5
    estimates: ClassVar = {
        "void_ratio_critical": PositiveNumber,
        "compaction_slope": Number,
        "compaction_bend": Number,
    }
    axes: ClassVar = {"water_ratio": Ratio, "void_ratio": Ratio}

    def fit(self) -> Fit:
        """Void ratio where the limit lies with its 95 % interval, and the limit beside it."""
        self.above_zero("bulk_density_wet")
        x = np.asarray(self.moisture_wet_basis, dtype=float)
        dry = np.asarray(self.bulk_density_wet, dtype=float) * (1.0 - x)
        if not np.all(dry < self.solid_density):
            sentence = _(
                "'{name}' in row {number} ({value} kg/m³) is more than the solid without any voids weighs."
            )
            raise self.bad_row("bulk_density_wet", dry >= self.solid_density, sentence)
        void = self.solid_density / dry - 1.0
        water = self.solid_density / self.liquid_density * x / (1.0 - x)
        share = self.saturation_critical
        if np.unique(water).size < 4:
            raise InputError(
                _("The test needs at least four different moistures."), name="moisture_wet_basis"
            )
        crossing = self._crossing(water, void)

        def model(p: dict[str, Any], water: Any) -> Any:
            off = water - share * p["void_ratio_critical"]
            return p["void_ratio_critical"] + p["compaction_slope"] * off + p["compaction_bend"] * off**2

        def derived(p: dict[str, Any]) -> dict[str, Any]:
            critical = p["void_ratio_critical"]
            return {
                "transportable_moisture_limit": transportable_moisture_limit_compacted.function(
                    critical / (1.0 + critical), self.liquid_density, self.solid_density, share
                ),
                "void_fraction": critical / (1.0 + critical),
            }

        bend, slope, _level = np.polyfit(water - share * crossing, void, 2)
        return self.fitted(
            model,
            {
                "void_ratio_critical": crossing,
                "compaction_slope": float(slope) or -0.01,
                "compaction_bend": float(bend) or 0.01,
            },
            water,
            void,
            sigma=1.0 + void,  # a scatter of the density in proportion to it
            scale={"void_ratio_critical": crossing, "compaction_slope": 0.1, "compaction_bend": 0.1},
            bounds={"void_ratio_critical": (0.0, np.inf)},
            derived=derived,
            flags=self._outside(water, share * crossing),
            kinds={"transportable_moisture_limit": MoistureWetBasis, "void_fraction": VoidFraction},
        )

    def _crossing(self, water: np.ndarray, void: np.ndarray) -> float:
        """Void ratio at which the parabola through the points meets the line of the critical saturation."""
        bend, slope, level = np.polyfit(water, void, 2)
        share = self.saturation_critical
        roots = np.roots([bend * share**2, slope * share - 1.0, level])
        real = np.real(roots[np.abs(np.imag(roots)) < 1e-9])
        real = real[real > 0.0]
        if not real.size or not np.max(water / void) > 0.8 * share:
            raise InputError(
                _(
                    "No sample comes near the critical share of water in its voids ({most} of {share}): such "
                    "a cake drains before it can liquefy, or moister samples are missing."
                ).format(most=f"{np.max(water / void):.2g}", share=f"{float(share):.2g}"),
                name="moisture_wet_basis",
            )
        middle = float(np.median(void))
        return float(real[np.argmin(np.abs(real - middle))])

    def _outside(self, water: np.ndarray, at: float) -> list[dict[str, Any]]:
        """Words where the limit is not between samples."""
        if water.min() <= at <= water.max():
            return []
        sentence = _("The limit lies outside the moistures tested: add samples on that side.")
        return [self.note("extrapolated", sentence, "moisture_wet_basis")]
