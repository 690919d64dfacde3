"""What does a size analysis say? A sieved quartz and the counted powder of the course notes, with every mean,
fit and chart.

Run it in this folder: ``python size_analysis.py [--charts]``.
"""

import sys
from pathlib import Path

import granum as gr

HERE = Path(__file__).parent

# Crushed quartz, sieved; the handbook puts each class at its arithmetic middle and leaves the pan out of its
# means
quartz = gr.particles.SieveAnalysis.read(
    HERE / "crushed_quartz_mccabe2005.csv", pan_mass="0.75 g", sample_mass="100 g", in_class="midpoint"
)
without_pan = gr.particles.SieveAnalysis.read(
    HERE / "crushed_quartz_mccabe2005.csv", in_class=gr.particles.ArithmeticMidpoint()
)
sieved = 1.0 - 0.0075
sauter, mass_mean = (
    float(d) * 1e3 for d in (without_pan.distribution().mean(3, 2), without_pan.distribution().mean(4, 3))
)
print(f"Sauter mean {sauter:.3f} mm, mass mean {mass_mean:.3f} mm (sieved part)")
assert abs(sauter / sieved - 1.207) < 2e-3  # printed: 1.207 mm, from sums over 99.25 % of the mass
assert abs(mass_mean * sieved - 1.677) < 1e-3  # printed: 1.677 mm

surface = 6.0 / (0.571 * 2650 * float(without_pan.distribution().mean(3, 2)))
print(f"specific surface {surface:.3f} m2/kg at sphericity 0.571")
assert abs(surface - 3.309) < 2e-3  # printed: 3.309 mm2/mg

fit = quartz.fit()
print(
    "Rosin–Rammler:", {name: f"{e.value:.4g} ± {e.standard_error:.1g}" for name, e in fit.parameters.items()}
)
for flag in fit.flags:
    print("note:", flag["message"])
assert 2.2 < fit["distribution_exponent"].value < 2.8

# The counted powder of the course notes: all six means, by class middles
counted = gr.particles.ParticleCounter.read(
    HERE / "course_notes_table.csv", in_class=gr.particles.ArithmeticMidpoint()
)
table = counted.summary()
names = ("X_NL", "X_NS", "X_NV", "X_SV", "X_LS", "X_LV")
print({name: f"{float(value) * 1e6:.2f} um" for name, value in zip(names, table[:6], strict=True)})
assert abs(float(table.mean_diameter_number_length) * 1e6 - 14.475) < 1e-9

# The same powder counted by volume: the median more than doubles
by_volume = counted.distribution().to_basis("volume")
print(
    f"median by number {float(table.percentile_50) * 1e6:.1f} um, by volume "
    f"{float(by_volume.percentile(0.5)) * 1e6:.1f} um"
)
assert by_volume.percentile(0.5) > 2.0 * table.percentile_50

if "--charts" in sys.argv:
    quartz.chart().write_html(HERE / "quartz.html")
    counted.chart().write_html(HERE / "counted.html")
