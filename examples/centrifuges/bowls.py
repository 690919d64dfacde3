"""What does a tubular bowl catch, and where do two liquids part in it?

Geankoplis, Transport Processes and Separation Process Principles, examples 14.4-1 and 14.4-2, with their
printed answers.
"""

from __future__ import annotations

import granum as gr

centrifuges = gr.centrifuges

# 14.4-1: viscous solution in a bowl of 22.25 mm turning at 23 000 rpm. Printed Σ = 196.3 m2, critical
# diameter 0.746 µm.
sigma = centrifuges.sigma_factor_tubular_half_thickness(
    bowl_length="0.1970 m", radius_inner="7.16 mm", radius_outer="22.25 mm", rotation_speed="23000 rpm"
)
cut = centrifuges.cut_size_centrifuge(
    volume_flow="0.002832 m3/hour",
    sigma_factor=sigma,
    particle_density=1461,
    fluid_density=801,
    dynamic_viscosity="100 cP",
    flow_multiple=2.0,
)
print(f"Sigma {sigma:.1f} m2 (printed 196.3), critical diameter {1e6 * cut:.3f} um (printed 0.746)")
assert abs(sigma / 196.3 - 1) < 0.002
assert abs(cut / 0.746e-6 - 1) < 0.002

# 14.4-2: vegetable oil and water phase. Printed interface at 13.75 mm; the printed data give 13.69 mm.
interface = centrifuges.radius_interface(
    radius_heavy="10.414 mm", radius_light="10.160 mm", density_heavy=980.3, density_light=919.5
)
print(f"interface at {1e3 * interface:.2f} mm (printed 13.75)")
assert abs(interface / 13.75e-3 - 1) < 0.006

# The customary constants: K = 1.118e-5 r N2 with r in centimeters, k = 2.53e5 ln(r2/r1)/(N/1000)2.
effect = centrifuges.centrifugal_effect(radius="10 cm", rotation_speed="3000 rpm")
assert abs(effect / (1.118e-5 * 10 * 3000**2) - 1) < 1e-3
