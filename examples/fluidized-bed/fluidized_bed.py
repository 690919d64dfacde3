"""When does a bed of sand fluidize? Every correlation, a worked example, and the laboratory curve.

Kunii and Levenspiel, chapter 3: sharp sand of 160 µm, sphericity 0.67, void fraction 0.55, measured 4.0 cm/s.
The curve is made data (4.0 cm/s, void fraction 0.43) with a rising branch that sticks.
"""

from __future__ import annotations

from pathlib import Path

import granum as gr

sand = {
    "particle_diameter": "160 um",
    "particle_density": 2600.0,
    "fluid_density": 1.2,
    "dynamic_viscosity": 1.8e-5,
}
printed = gr.fluidization.minimum_fluidization_velocity_ergun(**sand, void_fraction=0.55, sphericity=0.67)
print(f"Ergun with shape and void fraction: {100 * printed:.2f} cm/s")
assert round(100 * printed, 1) == 4.0

spread = gr.fluidization.minimum_fluidization_spread(**sand, void_fraction=0.55, sphericity=0.67)
for name, velocity in zip(spread.correlation, spread.minimum_fluidization_velocity, strict=True):
    print(f"  {name:20s} {100 * velocity:6.2f} cm/s")
print(f"median {100 * spread.median_velocity:.1f} cm/s, highest over lowest {spread.spread:.1f}")

curve = gr.fluidization.PressureCurve.read(
    Path(__file__).with_name("pressure_curve_made.csv"),
    height="30 cm",
    particle_density=2500.0,
    fluid_density=1.2,
)
found = curve.fit()
low, high = found["minimum_fluidization_velocity"].interval_95
print(
    f"curve: {100 * low:.2f} to {100 * high:.2f} cm/s, void fraction {found['bed_void_fraction'].value:.3f}"
)
assert low < 0.0405
assert high > 0.0395
assert abs(found["bed_void_fraction"].value - 0.43) < 0.01
