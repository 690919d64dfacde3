"""Squeezing test in a piston cell or a membrane press: how fast a cake consolidates."""

from __future__ import annotations

from typing import Annotated, Any, ClassVar

import jax.numpy as jnp
import numpy as np

from granum.core import lab_test
from granum.core.errors import InputError
from granum.core.i18n import _
from granum.core.kinds import Diffusivity, Distance, Length, PositiveNumber, Series, Time
from granum.estimation import Fit, LabTest
from granum.filtration.formulas.expression import consolidation_ratio_terzaghi, consolidation_time


@lab_test(
    "expression_test",
    source="shirato1974; terzaghi1943",
    title="Squeezing test of a cake",
    equation=r"L = L_1 - (L_1 - L_\infty)\,U(T_c),\quad T_c = \frac{i^2 C_e t}{\omega_0^2}",
)
class ExpressionTest(LabTest):
    """Consolidation coefficient, first and final thickness of a cake squeezed at constant pressure, by
    Terzaghi's law.

    Time counts from the moment when the slurry is filtered off and the piston meets a uniform cake. Late
    points that go on sinking are creep: they are fitted as part of the final thickness, and the bend shows in
    the residuals.
    """

    time: Annotated[Time, Series("points")]
    cake_thickness: Annotated[Distance, Series("points")]
    solid_volume_per_area: Length
    drainage_faces: PositiveNumber = 1.0

    estimates: ClassVar = {
        "consolidation_coefficient": Diffusivity,
        "cake_thickness_initial": Length,
        "cake_thickness_final": Length,
    }
    axes: ClassVar = {"time": Time, "cake_thickness": Length}
    least_points: ClassVar = 5

    def fit(self) -> Fit:
        """Coefficient and thicknesses with 95 % intervals."""
        self.increasing("time")
        t, L = np.asarray(self.time, dtype=float), np.asarray(self.cake_thickness, dtype=float)
        if not L[0] > L[-1]:
            raise InputError(_("The cake does not get thinner: nothing to fit."), name="cake_thickness")
        if L.min() < self.solid_volume_per_area:
            raise InputError(
                _("The cake is thinner than its own solid: check 'solid_volume_per_area'."),
                name="solid_volume_per_area",
            )
        half = float(np.interp(0.5, (L[0] - np.minimum.accumulate(L)) / (L[0] - L.min()), t))
        scale = (self.drainage_faces / self.solid_volume_per_area) ** 2

        def model(p: dict[str, Any], t: Any) -> Any:
            U = consolidation_ratio_terzaghi(
                consolidation_time(
                    t, p["consolidation_coefficient"], self.solid_volume_per_area, self.drainage_faces
                )
            )
            return p["cake_thickness_initial"] - (
                p["cake_thickness_initial"] - p["cake_thickness_final"]
            ) * jnp.asarray(U)

        start = {
            "consolidation_coefficient": 0.197 / (scale * max(half, 1e-3 * t[-1])),
            "cake_thickness_initial": float(L[0]),
            "cake_thickness_final": float(L.min()),
        }
        return self.fitted(
            model,
            start,
            t,
            L,
            bounds={"consolidation_coefficient": (0.0, np.inf), "cake_thickness_final": (0.0, np.inf)},
        )
