"""Textbook problems of cake filtration: a drum and a press that replaces it, a press run by its pump, the
best cake of a press.

Coulson and Richardson, Chemical Engineering, volume 2, chapter 7; the working is repeated below in the units
of the program.
"""

from __future__ import annotations

import numpy as np

import granum as gr

f = gr.filtration

# 1. A drum of 0.6 m by 0.6 m turns once in 360 s, a fifth in a slurry of 0.2 kg of solid (3000 kg/m³) per kg
# of water; void fraction 0.5,
#    65 kN/m², 0.125 kg/s of filtrate. Printed: the cake is 5.7 mm thick.
m = f.wet_to_dry_mass_ratio(void_fraction=0.5, liquid_density=1000, solid_density=3000)
W = f.dry_cake_per_filtrate(solids_mass_fraction=0.2 / 1.2, liquid_density=1000, wet_to_dry_mass_ratio=m)
area, volume = np.pi * 0.6 * 0.6, 0.125e-3 * 360
thickness = W * volume / area / (3000 * 0.5)
print(f"drum: {1e3 * thickness:.2f} mm of cake")
assert round(1e3 * thickness, 1) == 5.7

# The drum fails; a press with frames of 0.3 m at 275 kN/m², 240 s to open and close and 120 s a frame, must
# keep up. How many frames?
alpha = 2 * 65e3 * 72 * area**2 / (1e-3 * W * volume**2)  # no medium resistance
t = np.linspace(60, 3000, 3000)
per_frame = np.asarray(f.filtrate_volume_constant_pressure(t, 2 * 0.3**2, 275e3, 1e-3, alpha, W))
spare = per_frame - 0.125e-3 * 120  # what a frame gives beyond its own handling
frames = 0.125e-3 * (t + 240)[spare > 0] / spare[spare > 0]
print(f"press: {frames.min():.2f} frames")
assert int(np.ceil(frames.min())) == 4

# 2. A press runs 900 s at constant rate until 400 kN/m², and gets a third of its filtrate in that time; the
# rest comes at that pressure.
#    Printed: 4500 s in all. Any resistance will do, for it cancels.
case = {
    "area": 1.0,
    "pressure_drop": 4e5,
    "dynamic_viscosity": 1e-3,
    "cake_resistance": 1e11,
    "dry_cake_per_filtrate": 20.0,
}
third = (4e5 * 900 / (1e-3 * 1e11 * 20.0)) ** 0.5  # p = η α W V²/(t A²) at the end of the constant rate
total = f.filtration_time_rate_then_pressure(filtrate_volume=3 * third, filtrate_flow=third / 900, **case)
print(f"rate, then pressure: {total:.0f} s")
assert abs(total / 4500 - 1) < 1e-9

#    Cleaning takes 1200 s. The best cycle filters for 2100 s, 3300 s in all.
V = np.linspace(third, 4 * third, 30001)
time = np.asarray(f.filtration_time_rate_then_pressure(filtrate_volume=V, filtrate_flow=third / 900, **case))
best = time[np.argmax(V / (time + 1200))]
print(f"best filtration time: {best:.0f} s")
assert abs(best - 2100) < 1

# 3. Whiting, 100 kg per m³ of water, void fraction 0.4; 165 kN/m² push 0.02 cm³/s of water through a cube of
# cake of 1 cm. At 1000 kN/m² and
# 900 s to clean: r = 8.25e13 1/m², so that each of the two cakes of a frame is best at √(2 · 900 · 1e6 ·
# v/(1e-3 r)) = 35.2 mm.
r = 165e3 / (1e-3 * (0.02e-6 / 1e-4) * 0.01)
W = 100 / (1 - 0.4 / 0.6 * 100 / 3000)
cycle = f.filtration_cycle(
    area=1.0,
    pressure_drop=1e6,
    dynamic_viscosity=1e-3,
    cake_resistance=r / (0.6 * 3000),
    dry_cake_per_filtrate=W,
    dead_time=900,
)
cake = cycle.dry_cake_mass / (0.6 * 3000)
print(f"best cake: {1e3 * cake:.1f} mm, filtered in {cycle.filtration_time:.0f} s")
assert abs(r / 8.25e13 - 1) < 1e-9
assert abs(cake - (2 * 900 * 1e6 * (W / 1800) / (1e-3 * r)) ** 0.5) < 1e-9
assert round(1e3 * cake, 1) == 35.2
