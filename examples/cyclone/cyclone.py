"""Which dust does a cyclone catch, and at what pressure drop? The course's exercise, and one geometry by four
authors.

The course (V-1-6): V = 14.5 cm/s, d_c = 0.7 m, 19 g/cm³, 0.018 mPa s give 28.6 µm.
"""

from __future__ import annotations

import granum as gr
from granum.cyclones.geometry import StandardCyclone

exercise = gr.cyclones.cut_size_turns(
    velocity="14.5 cm/s",
    diameter="0.7 m",
    particle_density="19 g/cm^3",
    fluid_density=1.2,
    dynamic_viscosity="0.018 mPa*s",
)
print(f"notes: {1e6 * exercise:.1f} µm")
assert round(1e6 * exercise, 1) == 28.6

air = {
    "volume_flow": 223 / 3600,
    "particle_density": 2000.0,
    "fluid_density": 1.2,
    "dynamic_viscosity": 1.8e-5,
}
stairmand = StandardCyclone()(0.203)._asdict()
barth = gr.cyclones.cut_size_barth(**air, **stairmand)
muschelknautz = gr.cyclones.cut_size_muschelknautz(**air, **stairmand)
heads = gr.cyclones.inlet_heads_stairmand(**stairmand)
print(
    f"Stairmand 203 mm, 223 m³/h: cut {1e6 * barth:.2f} µm (Barth), {1e6 * muschelknautz:.2f} µm "
    f"(Muschelknautz), {heads:.1f} inlet heads"
)
# the cut measured on Stairmand's design, Stk = 1.4e-4 (Rhodes 2008, ch. 9): Muschelknautz comes within 15 %,
# Barth within 30 %
measured = gr.cyclones.cut_size_similar(**air, diameter=0.203)
print(
    f"measured on the design: {1e6 * measured:.2f} µm; Euler number "
    f"{heads * (3.14159265 / 0.4) ** 2:.0f} against 320"
)
assert abs(muschelknautz / measured - 1) < 0.15
assert abs(barth / measured - 1) < 0.30
assert abs(heads * (3.14159265 / 0.4) ** 2 / 320 - 1) < 0.01
