"""Standard cake formation time: leaves dipped into a slurry, their cakes measured with a ruler."""

from __future__ import annotations

from typing import Annotated, Any, ClassVar

import jax.numpy as jnp
import numpy as np

from granum.core import lab_test
from granum.core.errors import InputError
from granum.core.i18n import _
from granum.core.kinds import Distance, PressureDrop, Ratio, Series, Speed, Time
from granum.estimation import Fit, LabTest
from granum.estimation.lines import straight_line
from granum.filtration.formulas.cake_growth import BAR, CENTIMETER

FAR = 3.0  # times the thickest cake, beyond which a centimeter is told on trust


@lab_test(
    "cake_formation_test",
    source="purchas1981; anlauf2019, § 6.3; ruth1935",
    title="Standard cake formation time",
    equation=(
        r"Z = \sqrt{Z_m^2 + \frac{t\,(Z_0^2 + 2 Z_0 Z_m)}{t_{SC}}} - Z_m,\qquad "
        r"t_{SC} \propto \frac{Z_0^2\,\Delta p^{n-1} + 2 Z_0 Z_m\,\Delta p^{-1}}{Z_0^2 + 2 Z_0 Z_m}"
    ),
)
class CakeFormationTest(LabTest):
    """Time of a cake of one centimeter, and the thickness of cake that resists like the medium, from cakes
    formed at constant pressure for several times.

    Each row is one dip of the leaf: how long it sucked, and how thick its cake is. No balance, area or
    viscosity is asked for: the test sorts slurries into rapid, medium and slow ones and tells whether a
    continuous filter comes into question (``filtering_class``). The scatter is that of the ruler, alike for
    thin and thick cakes. With cakes of one time only, ``cake_thickness_medium`` must be given (zero for an
    open cloth). A cake that yields is told at the ``reference_pressure`` by its ``compressibility``. Keep the
    slurry stirred: what settles onto the leaf makes it look quicker.
    """

    time: Annotated[Time, Series("points")]
    cake_thickness: Annotated[Distance, Series("points")]
    pressure_drop: PressureDrop = BAR
    compressibility: Ratio = 0.0
    reference_pressure: PressureDrop = BAR
    cake_thickness_medium: Distance | None = None

    estimates: ClassVar = {"standard_cake_formation_time": Time}
    holds_for: ClassVar = ("cake_thickness", "pressure_drop")
    axes: ClassVar = {"time": Time, "cake_thickness": Distance}

    def fit(self) -> Fit:
        """Standard time and thickness equivalent to the medium with 95 % intervals; the mean speed at which
        the centimeter grows beside them.
        """
        self.above_zero("time")
        self.above_zero("cake_thickness")
        t, Z = np.asarray(self.time, dtype=float), np.asarray(self.cake_thickness, dtype=float)
        known = self.cake_thickness_medium
        if known is None and np.unique(t).size < 2:
            raise InputError(
                _(
                    "All cakes were formed for one time: add cakes of another, or give "
                    "'cake_thickness_medium'."
                ),
                name="cake_thickness_medium",
            )
        # t = Z²/G + 2 Z_m Z/G at the pressure of the test: a line of t/Z over Z
        if known is None:
            slope, intercept = straight_line(Z, t / Z)
            if not slope > 0.0:
                raise InputError(
                    _(
                        "The cakes do not slow down as they grow: the solid settles onto the leaf, or the "
                        "medium alone resists. Stir, or form thicker cakes."
                    ),
                    name="cake_thickness",
                )
            medium = max(0.5 * intercept / slope, 0.01 * float(Z.mean()))
            growth = 1.0 / slope
        else:
            medium = float(known)
            growth = float(np.mean((Z**2 + 2.0 * medium * Z) / t))
        harder = self.pressure_drop / self.reference_pressure
        n = self.compressibility
        times = self._standard(medium, growth, harder)

        def whole(p: dict[str, Any], t: Any) -> Any:
            standard = p["standard_cake_formation_time"]
            thin: Any = p.get("cake_thickness_medium", known)
            G = (CENTIMETER**2 + 2.0 * CENTIMETER * thin) / standard * harder ** (1.0 - n)
            medium = thin * harder**-n
            # √(Z_m² + G t) − Z_m without cancellation
            return G * t / (jnp.sqrt(medium**2 + G * t) + medium)

        start, bounds = {"standard_cake_formation_time": times}, {}
        bounds["standard_cake_formation_time"] = (0.0, np.inf)
        if known is None:
            start["cake_thickness_medium"] = medium * harder**n
            bounds["cake_thickness_medium"] = (0.0, np.inf)
        return self.fitted(
            whole,
            start,
            t,
            Z,
            bounds=bounds,
            scale={"standard_cake_formation_time": times, "cake_thickness_medium": float(Z.mean())}
            if known is None
            else None,
            derived=lambda p: {"growth_rate_cake": CENTIMETER / p["standard_cake_formation_time"]},
            flags=self._thin(float(Z.max())),
            kinds={"cake_thickness_medium": Distance, "growth_rate_cake": Speed},
        )

    def _standard(self, medium: float, growth: float, harder: float) -> float:
        """Of the reference pressure, from thickness of the medium and growth at that of the test."""
        n = self.compressibility
        thin, slow = medium * harder**n, growth * harder ** (n - 1.0)
        return float((CENTIMETER**2 + 2.0 * CENTIMETER * thin) / slow)

    def _thin(self, thickest: float) -> list[dict[str, Any]]:
        """Words where the cakes are much thinner than the centimeter."""
        if FAR * thickest >= CENTIMETER:
            return []
        sentence = _(
            "The thickest cake is less than a third of the centimeter: the time is extended by the parabola."
        )
        return [self.note("thin cakes", sentence, "cake_thickness")]

    def chart(self) -> Any:
        """Thickness of the cake against time, with the fitted parabola and its 95 % band."""
        from granum.core.charts import add_band, add_line, add_points, axis_title, figure

        found, t = self.fit(), np.asarray(self.time, dtype=float)
        grid = np.linspace(1e-6, 1.03, 120) * t.max()
        band = found.predict(grid)
        drawing = figure(
            axis_title("time", "s"), axis_title("cake_thickness", "mm"), title=type(self).card.title
        )
        add_band(drawing, grid, 1e3 * band.low, 1e3 * band.high, _("95 % band"))
        add_line(drawing, grid, 1e3 * band.value, _("model"))
        add_points(drawing, t, 1e3 * np.asarray(self.cake_thickness), _("data"))
        return drawing
