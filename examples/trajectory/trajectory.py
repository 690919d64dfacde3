"""Where does a sand grain land that leaves a pipe with the water, and how wrong is Stokes' law?

A grain of 1 mm quartz leaves a pipe at 0.5 m/s into still water 0.5 m deep; then the course's settling basin,
L = U_x h/U_t.
"""

from __future__ import annotations

import granum as gr

water = {"fluid_density": 998.0, "dynamic_viscosity": "1.0 cP"}
grain = {"particle_diameter": "1 mm", "particle_density": 2650.0, **water}

landing = gr.particles.settling_distance(
    **grain, height=0.5, initial_horizontal_velocity=0.5, added_mass_coefficient=0.5
)
fall = gr.particles.terminal_velocity(**grain)
print(
    f"lands {1000 * landing.settling_distance:.1f} mm away after {landing.time:.2f} s; terminal "
    f"velocity {1000 * fall:.0f} mm/s"
)
# measured settling velocities of 1 mm quartz spheres in water at 20 °C lie at 0.15 to 0.17 m/s
assert 0.15 < fall < 0.17
assert 0.5 / fall < landing.time < 1.1 * 0.5 / fall
assert 0.005 < landing.settling_distance < 0.03

creeping = gr.particles.settling_distance_stokes(
    **grain, height=0.5, initial_horizontal_velocity=0.5, added_mass_coefficient=0.5
)
print(
    f"Stokes' law would say {1000 * creeping.settling_distance:.0f} mm and {creeping.time:.2f} s: wrong "
    f"at Re = {fall * 1e-3 * 998 / 1e-3:.0f}"
)
assert creeping.settling_distance > 4 * landing.settling_distance

# The basin: 50 µm silt, 2 m deep, 1 cm/s. Course V-1-3: t = h/U_t, L = U_x t with U_t = g Δρ d²/(18 η).
silt = {"particle_diameter": "50 um", "particle_density": 2650.0, **water}
basin = gr.particles.settling_distance(
    **silt, height=2.0, stream_velocity=0.01, initial_horizontal_velocity=0.01
)
by_hand = 0.01 * 2.0 * 18e-3 / (9.80665 * 1652 * 50e-6**2)
print(f"basin {basin.settling_distance:.2f} m long; by Stokes' law {by_hand:.2f} m")
assert 1.0 < basin.settling_distance / by_hand < 1.06  # inertia at Re = 0.11 costs some 3 %
