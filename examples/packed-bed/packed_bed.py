"""How much pressure does air lose through a bed of spheres, and what does a permeametry test tell about the
grains?

The bed is that of Geankoplis, Transport Processes and Separation Process Principles, example 3.1-4: 12.7 mm
spheres, 0.61 m wide, 2.44 m deep, void fraction 0.38, 0.358 kg/s of air at 311 K entering at 1.10 atm.
Printed answer: 0.0497e5 Pa.
"""

from __future__ import annotations

from math import pi
from pathlib import Path

import granum as gr

flux = 0.358 / (pi / 4 * 0.61**2)
bed = {"particle_diameter": "12.7 mm", "void_fraction": 0.38}
air = {"temperature": 311.0, "molar_mass": "28.97 g/mol", "dynamic_viscosity": 1.90e-5}
inlet = 1.10 * 101325.0
outlet = gr.porous.pressure_outlet_gas_bed(mass_flux=flux, pressure_inlet=inlet, length=2.44, **air, **bed)
drop = inlet - outlet
print(f"Ergun: {drop:.0f} Pa (printed 4970 Pa)")
assert abs(drop / 4970 - 1) < 0.01

for law in (
    gr.porous.pressure_gradient_carman,
    gr.porous.pressure_gradient_erdim,
    gr.porous.pressure_gradient_kta,
):
    other = inlet - gr.porous.pressure_outlet_gas_bed(
        mass_flux=flux, pressure_inlet=inlet, length=2.44, pressure_gradient=law, **air, **bed
    )
    print(f"{law.card.title}: {other:.0f} Pa")
    assert 0.5 < other / drop < 1.0  # Ergun is known to be high for smooth spheres at Re₁ = 1300

back = gr.porous.mass_flux_gas_bed(pressure_inlet=inlet, pressure_outlet=outlet, length=2.44, **air, **bed)
assert abs(back / flux - 1) < 1e-9

# A water test on a 20 cm layer of sand; the readings are those that Ergun's equation gives for 0.50 mm
# grains, rounded to 2 digits.
test = gr.porous.Permeametry.read(
    Path(__file__).with_name("water_test.csv"),
    length="20 cm",
    dynamic_viscosity="1.0 cP",
    fluid_density=998,
    void_fraction=0.40,
    kozeny_coefficient=150 / 36,
)
found = test.fit()
for name in ("permeability", "inertial_coefficient", "specific_surface", "particle_diameter"):
    low, high = found[name].interval_95
    print(f"{name}: {found[name].value:.4g} {found[name].unit} (95 %: {low:.4g} to {high:.4g})")
low, high = found["particle_diameter"].interval_95
assert low < 0.50e-3 < high
assert abs(found["particle_diameter"].value / 0.50e-3 - 1) < 0.02
