"""What do leaf tests say about a slurry, and how large must the drum be that filters it?

Tests of calcium carbonate at constant pressure from three textbooks, their printed answers, and the exercise
of the course notes (U IV.8.4.b): 15 g of crystals per kilogram of slurry, 85 µm, a cake of 145 cm3 that dries
to 0.236 kg.
"""

from __future__ import annotations

from pathlib import Path

import granum as gr

HERE = Path(__file__).parent
filtration = gr.filtration

# Geankoplis, example 14.2-1: the first reading does not lie on the line and is left out. Printed α =
# 1.863e11 m/kg, R = 10.63e10 1/m.
test = filtration.LeafTest.read(
    HERE / "leaf_geankoplis.csv",
    area="0.0439 m2",
    pressure_drop="338 kPa",
    dynamic_viscosity="0.8937 cP",
    dry_cake_per_filtrate=23.47,
)
fit = test.fit()
for name in ("cake_resistance", "medium_resistance"):
    low, high = fit[name].interval_95
    print(f"{name}: {fit[name].value:.4g} {fit[name].unit} (95 %: {low:.4g} to {high:.4g})")
print(fit.flags[0]["message"])
assert abs(fit["cake_resistance"].value / 1.863e11 - 1) < 0.005
assert abs(fit["medium_resistance"].value / 10.63e10 - 1) < 0.005

# Holdich, chapter 4: printed α = 5.215e11 m/kg, R = 2.861e12 1/m.
dry_cake = filtration.dry_cake_per_filtrate(
    solids_mass_fraction=0.1, liquid_density=1000, wet_to_dry_mass_ratio=1280 / 635
)
other = filtration.LeafTest.read(
    HERE / "leaf_holdich.csv",
    area="2.72 m2",
    pressure_drop="3 bar",
    dynamic_viscosity="1 cP",
    dry_cake_per_filtrate=dry_cake,
).fit()
assert abs(other["cake_resistance"].value / 5.215e11 - 1) < 1e-3

# McCabe, example 29.1: five pressures. Printed compressibility 0.26.
pressures = filtration.Compressibility.read(
    HERE / "pressures_mccabe.csv",
    area="440 cm2",
    dynamic_viscosity="0.8937 cP",
    dry_cake_per_filtrate="23.5 g/L",
).fit()
low, high = pressures["compressibility"].interval_95
print(f"compressibility: {pressures['compressibility'].value:.3f} (95 %: {low:.3f} to {high:.3f})")
assert low < 0.26 < high

# Exercise of the notes: ε = 0.38, α = 1.07e8 m/kg, W = 15.3 kg/m3; 0.5 m2 at 0.8 bar give 2.4 m3 in 5 min and
# a cake of 4.5 cm.
voids = filtration.void_fraction_cake(dry_cake_mass=0.236, cake_volume="145 cm3", solid_density=2630)
alpha = filtration.cake_resistance_kozeny_carman(
    particle_diameter="85 um", void_fraction=0.38, solid_density=2630
)
W = filtration.dry_cake_per_filtrate(solids_mass_fraction=0.015, liquid_density=1020)
V = filtration.filtrate_volume_constant_pressure(300, 0.5, "0.8 bar", "1.2 cP", alpha, W)
print(
    f"void fraction {voids:.3f}, cake resistance {alpha:.3g} m/kg, filtrate {V:.2f} m3, dry cake "
    f"{W * V:.1f} kg"
)
assert abs(voids - 0.38) < 0.005
assert abs(alpha / 1.07e8 - 1) < 0.002
assert abs(V / 2.4 - 1) < 0.04  # the notes round 0.1427 √t down to 0.14 √t; the unrounded figure is 2.47 m3
