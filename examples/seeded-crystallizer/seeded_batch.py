"""How should a seeded batch of potassium nitrate be cooled? The benchmark case of Miller and Rawlings, Chung,
Ma and Braatz.

Run it in this folder: ``python seeded_batch.py``. It draws the path of the batch on the solubility zones.
"""

import tempfile
from pathlib import Path

import numpy as np

import granum as gr

c = gr.crystallization
case = {
    "solute_per_solvent": 0.4929904,  # saturated at 32 °C: 492.9904 g/L as printed
    "solubility": {"law": "polynomial_solubility", "coefficients": [0.1286, 5.88e-3, 1.721e-4]},
    "growth": {"law": "power_law_growth", "growth_coefficient": 6967e-6 / 60, "growth_order": 1.32},
    "nucleation": {
        "law": "secondary_nucleation",
        "nucleation_coefficient": 2.78e-5 * 1e18 / 60 / 2110,
        "nucleation_order": 1.78,
    },
    "duration": "80 min",
    "crystal_density": 2110,
    "seed_mass_per_solvent": 0.0005,
    "seed_size": "100 um",
    "seed_width": "20 um",
}
runs = {}
for name, exponent in (("linear", 1.0), ("cubic", 3.0)):
    program = c.PowerCooling("32 degC", "28 degC", "80 min", exponent)
    runs[name] = c.batch(**case, temperature_program=program)
    out = runs[name]
    print(
        f"{name}: D[4,3] {out.mean_diameter * 1e6:.1f} um, from nuclei "
        f"{100 * out.nuclei_mass_fraction:.1f} % of the mass, "
        f"yield {100 * out.yield_fraction:.1f} %, error of the steps {out.step_error:.0e}"
    )
    total = np.asarray(out.solute_per_solvent + out.crystals_per_solvent)
    assert np.ptp(total) < 1e-14  # solute and solid conserved to rounding
    assert out.step_error < 1e-4
assert runs["cubic"].nuclei_mass_fraction < runs["linear"].nuclei_mass_fraction

best = c.optimal_cooling(**case, temperature_start="32 degC", temperature_end="28 degC", intervals=10)
print(
    f"optimal: from nuclei {100 * best.nuclei_mass_fraction:.1f} %, D[4,3] {best.mean_diameter * 1e6:.1f} um"
)
print("temperature program, °C:", ", ".join(f"{T - 273.15:.2f}" for T in best.temperature))
assert best.nuclei_mass_fraction < runs["linear"].nuclei_mass_fraction

out = runs["cubic"]
drawing = c.solubility_chart(
    case["solubility"],
    "26 degC",
    "34 degC",
    metastable_width=1.0,
    path_temperature=np.asarray(out.temperature),
    path_solute_per_solvent=np.asarray(out.solute_per_solvent),
)
saved = Path(tempfile.gettempdir()) / "seeded_batch.html"
drawing.write_html(saved)
print(f"chart saved to {saved}")
