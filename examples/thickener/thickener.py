"""Will a secondary clarifier survive two days of rain, and how big must a thickener be?

The clarifier is simulated hour by hour with hindered settling and compression while the flow doubles for
eight hours; the steady state before the rain is that of flux theory.
"""

from __future__ import annotations

import numpy as np

from granum.settling.flux import state_point_clarifier, thickener_area_flux
from granum.settling.simulations import continuous_simulation

SLUDGE = {"law": "vesilind", "vesilind_velocity": "6 m/hour", "vesilind_coefficient": "0.4 L/g"}
STRESS = {
    "law": "logarithmic_stress",
    "critical_concentration": "7 g/L",
    "stress_scale": 2.0,
    "stress_concentration": "4 g/L",
}


def main() -> None:
    hours = np.arange(0, 97)
    flow = np.where((hours[:-1] >= 48) & (hours[:-1] < 56), 2200.0, 1100.0) / 3600
    course = continuous_simulation(
        hours * 3600.0,
        flow,
        "3 g/L",
        "450 m^3/hour",
        "1000 m^2",
        "4 m",
        SLUDGE,
        STRESS,
        cells=60,
        feed_depth_share=0.5,
    )
    dry = state_point_clarifier("1100 m^3/hour", "3 g/L", "450 m^3/hour", "1000 m^2", settling=SLUDGE)
    wet = state_point_clarifier("2200 m^3/hour", "3 g/L", "450 m^3/hour", "1000 m^2", settling=SLUDGE)
    print(f"loading {dry.loading_ratio:.2f} dry, {wet.loading_ratio:.2f} in the rain")
    print(
        f"underflow {course.underflow_concentration[47]:.2f} g/L before, at most "
        f"{course.underflow_concentration.max():.2f} in the rain"
    )
    print(
        f"blanket {course.blanket_height[47]:.2f} m before, {course.blanket_height[48:60].max():.2f} m "
        f"at the worst"
    )
    print(f"solids balance closes to {course.mass_error:.1e}")
    area = thickener_area_flux(
        "10 t/h",
        "100 g/L",
        "500 g/L",
        {"law": "vesilind", "vesilind_velocity": "1.203 m/hour", "vesilind_coefficient": "8.82 mL/g"},
    )
    print(f"thickener for 10 t/h of limestone: {area:.0f} m²")

    assert dry.loading_ratio < 1 < wet.loading_ratio
    assert (
        abs(course.underflow_concentration[47] - dry.underflow_concentration)
        < 0.02 * dry.underflow_concentration
    )
    assert course.blanket_height[48:60].max() > course.blanket_height[47] + 0.3
    assert course.mass_error < 1e-10


if __name__ == "__main__":
    main()
