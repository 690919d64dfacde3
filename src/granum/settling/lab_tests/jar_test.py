"""Jar test: residual turbidity against coagulant dose, the best dose and where water turns turbid again."""

from __future__ import annotations

from typing import Annotated, Any, ClassVar, Literal

import jax.numpy as jnp
import numpy as np

from granum.core import lab_test
from granum.core.errors import InputError
from granum.core.i18n import _
from granum.core.kinds import Concentration, PositiveNumber, Series
from granum.estimation import Fit, LabTest
from granum.numerics import safe_sqrt
from granum.settling.formulas.coagulation import (
    Dose,
    Turbidity,
    charge_sharpness_jar,
    residual_turbidity_neutralization,
    residual_turbidity_parabola,
)

SHAPES = {
    "neutralization": residual_turbidity_neutralization.function,
    "parabola": residual_turbidity_parabola.function,
}


@lab_test("jar_test", source="davis2010, p. 6-18; reerink1954; stumm1968; box1951", title="Jar test")
class JarTest(LabTest):
    """Jars stirred and settled with rising doses of a coagulant: best dose with its interval, the residual
    turbidity there, and the dose beyond which half of the gain is lost again.

    ``neutralization`` fits the whole curve from no coagulant to too much; ``parabola``, the usual response
    surface, only the jars near the best one. With the turbidity wanted the fit also gives the lowest dose
    that reaches it. Use one pH in all jars: a dose found at one pH says nothing of another.
    """

    coagulant_dose: Annotated[Concentration, Series("jars")]
    residual_turbidity: Annotated[PositiveNumber, Series("jars")]
    raw_turbidity: Turbidity
    turbidity_wanted: Turbidity | None = None
    dose_response: Literal["neutralization", "parabola"] = "neutralization"

    estimates: ClassVar = {
        "dose_optimum": Dose,
        "residual_turbidity_least": Turbidity,
        "dose_half_width": Dose,
        "dose_restabilized": Concentration,
        "charge_sharpness": PositiveNumber,
        "dose_least": Concentration,
    }
    holds_for: ClassVar = ("coagulant_dose", "raw_turbidity")
    axes: ClassVar = {"coagulant_dose": Concentration, "residual_turbidity": PositiveNumber}
    least_points: ClassVar = 5

    def __check_init__(self) -> None:
        if self.turbidity_wanted is not None and float(self.turbidity_wanted) >= float(self.raw_turbidity):
            raise InputError(
                _("The turbidity wanted is not below that of the raw water: no coagulant is needed."),
                name="turbidity_wanted",
            )

    def fit(self) -> Fit:
        """Best dose, least turbidity and half width, with 95 % intervals."""
        dose = np.asarray(self.coagulant_dose, dtype=float)
        left = np.asarray(self.residual_turbidity, dtype=float)
        raw, best = float(self.raw_turbidity), int(np.argmin(left))
        if np.unique(dose).size < 4:
            raise InputError(
                _("A jar test needs at least four different doses, and these are {count}.").format(
                    count=np.unique(dose).size
                ),
                name="coagulant_dose",
            )
        if not left[best] < raw:
            raise InputError(
                _(
                    "No jar is clearer than the raw water ({raw} NTU; the clearest has {least} NTU): no dose "
                    "can be told best."
                ).format(raw=f"{raw:.3g}", least=f"{left[best]:.3g}"),
                name="raw_turbidity",
            )
        spread = float(np.ptp(dose))
        start = {
            "dose_optimum": max(float(dose[best]), 0.02 * spread),
            "residual_turbidity_least": min(max(float(left[best]), 1e-3 * raw), 0.9 * raw),
            "dose_half_width": self._half_width(dose, left, best),
        }
        bounds = {
            "dose_optimum": (1e-3 * spread, 5.0 * float(dose.max())),
            "residual_turbidity_least": (1e-6 * raw, raw * (1.0 - 1e-6)),
            "dose_half_width": (1e-2 * spread, 20.0 * spread),
        }
        shape = SHAPES[self.dose_response]

        def model(p: dict[str, Any], x: Any) -> Any:
            return shape(x, raw, p["residual_turbidity_least"], p["dose_optimum"], p["dose_half_width"])

        found = self.fitted(model, start, dose, left, bounds=bounds, derived=self._told)
        self._check_wanted(found)
        found.flags.extend(self._said(found, dose, left))
        return found

    def _half_width(self, dose: np.ndarray, left: np.ndarray, best: int) -> float:
        """Distance from the clearest jar to the nearest one of at least half the gain lost, to begin with."""
        middle = 0.5 * (float(self.raw_turbidity) + left[best])
        apart = np.abs(dose - dose[best])
        lost = (left >= middle) & (apart > 0)
        return float(apart[lost].min() if lost.any() else apart.max())

    def _told(self, p: Any) -> dict[str, Any]:
        """Figures of the curve: where half of its gain is lost, its sharpness, the dose that suffices."""
        raw, least, best = self.raw_turbidity, p["residual_turbidity_least"], p["dose_optimum"]
        width = p["dose_half_width"]
        found: dict[str, Any] = {"dose_restabilized": best + width}
        neutral = self.dose_response == "neutralization"
        if neutral:
            found["charge_sharpness"] = charge_sharpness_jar.function(raw, least, best, width)
        if self.turbidity_wanted is not None:
            wanted = jnp.asarray(self.turbidity_wanted)
            if neutral:
                over = jnp.log(raw / least)
                half = jnp.log(over / jnp.log(2.0 * raw / (raw + least)))
                squared = jnp.log(over / jnp.log(raw / wanted)) / half
            else:
                squared = 2.0 * (wanted - least) / (raw - least)
            found["dose_least"] = jnp.maximum(best - width * safe_sqrt(squared), 0.0)
        return found

    def _check_wanted(self, found: Fit) -> None:
        least = found.values["residual_turbidity_least"]
        if self.turbidity_wanted is not None and float(self.turbidity_wanted) <= least:
            raise InputError(
                _(
                    "No dose reaches {wanted} NTU: the curve has its least value, {least} NTU, at "
                    "{dose} mg/L."
                ).format(
                    wanted=f"{float(self.turbidity_wanted):.3g}",
                    least=f"{least:.3g}",
                    dose=f"{1e3 * found.values['dose_optimum']:.3g}",
                ),
                name="turbidity_wanted",
            )

    def _said(self, found: Fit, dose: np.ndarray, left: np.ndarray) -> list[dict[str, Any]]:
        """Words where the jars do not embrace the best dose or do not show the water turbid again."""
        best = found.values["dose_optimum"]
        again = best + found.values["dose_half_width"]
        if not dose.min() <= best < dose.max():
            sentence = _(
                "The best dose lies outside the doses tested ({low} to {high} mg/L): add jars on that side."
            )
        elif again > dose.max():
            sentence = _(
                "Half of the gain is not lost up to {high} mg/L: where the water turns turbid again is "
                "extrapolated."
            )
        else:
            return []
        text = sentence.format(low=f"{1e3 * dose.min():.3g}", high=f"{1e3 * dose.max():.3g}")
        return [self.note("extrapolated", text, "coagulant_dose")]
