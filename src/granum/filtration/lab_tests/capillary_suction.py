"""Suction time of sludge on a dry filter paper: minutes on a bench instead of an hour with a leaf."""

from __future__ import annotations

from typing import Annotated, Any, ClassVar

import jax.numpy as jnp
import numpy as np

from granum.core import lab_test
from granum.core.errors import InputError
from granum.core.i18n import _
from granum.core.kinds import (
    CakeResistance,
    Concentration,
    DynamicViscosity,
    PositiveNumber,
    Series,
    Time,
    Within,
)
from granum.estimation import Fit, LabTest
from granum.estimation.lines import straight_line
from granum.filtration.formulas.suction import filterability_constant
from granum.filtration.kinds import FilterabilityConstant, SuctionConstant, TimePerConcentration

PAPER_LIMITED = 1.5  # times the time of the liquid: below it the paper is what is measured


@lab_test(
    "capillary_suction_test",
    source="baskerville1968; triton2018; scholz2005; peng2011; ormeci2000; vesilind1988",
    title="Capillary suction time",
    equation=r"t_{CST} = t_l + n\,C,\qquad \alpha = \frac{n}{K_{CST}\,\eta}",
)
class CapillarySuctionTest(LabTest):
    """Suction time of a sludge per concentration of its solids, from repeated readings at one or several
    concentrations and of the clear liquid.

    Each row is one reading; a concentration of zero is a reading of the filtrate, whose time belongs to
    the paper and is taken off. Without such readings and with one concentration only,
    ``suction_time_liquid`` must be given. The scatter is taken in proportion to the time, as repeated
    readings show it. One file holds one state of the sludge: one dose, one time of stirring. With the
    constant of the apparatus the resistance of the cake is told too: it ranks sludges and doses, while a
    leaf test sizes the filter. Mineral sludges do not keep to the proportion with solids (reported of
    coagulation and lime sludges); of strongly flocculated sludges the paper is measured, not the sludge,
    which is flagged.
    """

    suction_time: Annotated[Time, Series("points")]
    solids_concentration: Annotated[Concentration, Series("points")]
    dynamic_viscosity: DynamicViscosity = 1.0e-3
    suction_time_liquid: Annotated[Time, Within(1e-3)] | None = None
    suction_constant: SuctionConstant | None = None
    instrument_constant: PositiveNumber = 1.0

    estimates: ClassVar = {"suction_time_normalized": TimePerConcentration}
    holds_for: ClassVar = ("solids_concentration",)
    axes: ClassVar = {"solids_concentration": Concentration, "suction_time": Time}

    def fit(self) -> Fit:
        """Suction time per concentration, and of the liquid where it is not given, with 95 % intervals."""
        self.above_zero("suction_time")
        t, C = np.asarray(self.suction_time, dtype=float), np.asarray(self.solids_concentration, dtype=float)
        sludge = C > 0.0
        if not sludge.any():
            raise InputError(
                _("No reading has solids: nothing can be said of a sludge."), name="solids_concentration"
            )
        known = self.suction_time_liquid
        if known is None and np.unique(C).size < 2:
            raise InputError(
                _(
                    "All readings have one concentration: add readings of the filtrate (concentration 0) or "
                    "of a diluted sludge, or give 'suction_time_liquid'."
                ),
                name="suction_time_liquid",
            )
        middle = float(C[sludge].mean())
        if known is None:
            slope, liquid = straight_line(C, t)
            liquid = max(liquid, 0.1 * float(t.min()))
        else:
            liquid = float(known)
            slope = float(np.mean((t[sludge] - liquid) / C[sludge]))
        if not slope > 0.0:
            raise InputError(
                _(
                    "The suction time does not grow with the solids: the readings show the paper, or the "
                    "sludge settles in the funnel."
                ),
                name="suction_time",
            )

        def whole(p: dict[str, Any], C: Any) -> Any:
            return p.get("suction_time_liquid", known) + p["suction_time_normalized"] * C

        def derived(p: dict[str, Any]) -> dict[str, Any]:
            time = whole(p, middle)
            found = {
                "capillary_suction_time": time,
                "filterability_constant": filterability_constant.function(
                    time, middle, self.dynamic_viscosity, self.instrument_constant
                ),
            }
            if self.suction_constant is not None:
                found["cake_resistance"] = p["suction_time_normalized"] / (
                    self.suction_constant * self.dynamic_viscosity
                )
            return found

        start = {"suction_time_normalized": slope}
        bounds = {"suction_time_normalized": (0.0, np.inf)}
        if known is None:
            start["suction_time_liquid"] = liquid
            bounds["suction_time_liquid"] = (1e-3 * float(t.min()), np.inf)
        return self.fitted(
            lambda p, C: jnp.log(whole(p, C)),
            start,
            C,
            np.log(t),
            bounds=bounds,
            derived=derived,
            flags=self._paper(liquid, liquid + slope * middle),
            kinds={
                "suction_time_liquid": Time,
                "capillary_suction_time": Time,
                "filterability_constant": FilterabilityConstant,
                "cake_resistance": CakeResistance,
            },
        )

    def _paper(self, liquid: float, whole: float) -> list[dict[str, Any]]:
        """Words where the sludge takes little longer than its liquid."""
        if whole > PAPER_LIMITED * liquid:
            return []
        sentence = _(
            "The sludge takes hardly longer than its liquid: the paper sets the pace, and better sludges "
            "can no longer be told apart. Drain such a sludge first."
        )
        return [self.note("paper", sentence, "suction_time")]

    def chart(self) -> Any:
        """Suction time against solids, with the fitted line and its 95 % band."""
        from granum.core.charts import add_band, add_line, add_points, axis_title, figure

        found, C = self.fit(), np.asarray(self.solids_concentration, dtype=float)
        grid = np.linspace(0.0, 1.03 * C.max(), 120)
        band = found.predict(grid)
        drawing = figure(
            axis_title("solids_concentration", "g/L"),
            axis_title("suction_time", "s"),
            title=type(self).card.title,
        )
        add_band(drawing, grid, np.exp(band.low), np.exp(band.high), _("95 % band"))
        add_line(drawing, grid, np.exp(band.value), _("model"))
        add_points(drawing, C, np.asarray(self.suction_time), _("data"))
        return drawing
