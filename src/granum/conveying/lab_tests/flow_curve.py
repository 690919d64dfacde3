"""Viscometer: the flow curve of a slurry, for the pipe that is to carry it."""

from __future__ import annotations

from typing import Annotated, Any, ClassVar, Literal

import numpy as np

from granum.core import lab_test
from granum.core.errors import InputError
from granum.core.i18n import _
from granum.core.kinds import DynamicViscosity, FlowIndex, Frequency, Series, ShearRate, Within, YieldStress
from granum.estimation import Fit, LabTest
from granum.estimation.lines import straight_line


@lab_test(
    "flow_curve_test",
    source="bingham1922; herschel1926; chhabra2008, ch. 1",
    title="Flow curve by viscometer",
    equation=r"\tau = \tau_y + \eta_1\,\dot\gamma_1\left(\dot\gamma/\dot\gamma_1\right)^n",
)
class FlowCurveTest(LabTest):
    """Yield stress, consistency and flow index of a slurry from shear stresses at several shear rates.

    The law is chosen: ``bingham`` has n = 1, and the consistency is its plastic viscosity; ``power_law`` has
    no yield stress. Stresses scatter evenly, as where the torque errs by a share of the full scale. A yield
    stress is extrapolated to rest: measure at shear rates as low as those of the pipe, 8 v/D.

    >>> test = FlowCurveTest([100.0, 200.0, 400.0], [14.0, 16.0, 20.0])
    >>> round(test.fit()["yield_stress"].value, 3)
    12.0
    """

    shear_rate: Annotated[Frequency, Within(1e-6, 1e6), Series("points")]
    shear_stress: Annotated[YieldStress, Series("points")]
    flow_curve: Literal["bingham", "power_law", "herschel_bulkley"] = "bingham"
    reference_shear_rate: ShearRate = 1.0

    estimates: ClassVar = {
        "consistency": DynamicViscosity,
        "flow_index": FlowIndex,
        "yield_stress": YieldStress,
    }
    holds_for: ClassVar = ("shear_rate",)
    axes: ClassVar = {"shear_rate": Frequency, "shear_stress": YieldStress}

    def fit(self) -> Fit:
        """The parameters of the law, with 95 % intervals."""
        rate, stress = (np.asarray(x, dtype=float) for x in (self.shear_rate, self.shear_stress))
        self.above_zero("shear_stress")
        needed = 4 if self.flow_curve == "herschel_bulkley" else 3
        if np.unique(rate).size < needed:
            raise InputError(
                _(
                    "A flow curve of this law needs at least {least} shear rates, and these are {count}."
                ).format(least=needed, count=np.unique(rate).size),
                name="shear_rate",
            )
        first = float(self.reference_shear_rate)

        def model(p: dict[str, Any], x: Any) -> Any:
            power = (x / first) ** p.get("flow_index", 1.0)
            return p.get("yield_stress", 0.0) + p["consistency"] * first * power

        bounds = {"consistency": (1e-12, np.inf), "flow_index": (0.1, 1.9), "yield_stress": (0.0, 1e6)}
        start = self._start(rate, stress)
        return self.fitted(model, start, rate, stress, bounds={name: bounds[name] for name in start})

    def _start(self, rate: np.ndarray, stress: np.ndarray) -> dict[str, float]:
        first = float(self.reference_shear_rate)
        if self.flow_curve == "bingham":
            slope, intercept = straight_line(rate, stress)
            steady = float(stress.max() / rate.max())
            return {
                "consistency": float(slope) if slope > 0 else 0.1 * steady,
                "yield_stress": max(float(intercept), 0.0),
            }
        yielding = 0.7 * float(stress.min()) if self.flow_curve == "herschel_bulkley" else 0.0
        slope, level = straight_line(np.log(rate / first), np.log(stress - yielding))
        found = {
            "consistency": float(np.exp(level)) / first,
            "flow_index": float(np.clip(slope, 0.15, 1.8)),
        }
        return found | ({"yield_stress": yielding} if self.flow_curve == "herschel_bulkley" else {})
