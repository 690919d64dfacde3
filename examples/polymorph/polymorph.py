"""L-glutamic acid: the alpha form turns into the beta form in its solution. Run: python polymorph.py"""

import numpy as np

import granum as gr

TEMPERATURE = "45 degC"
ALPHA = {"law": "library_solubility", "solute": "L-glutamic acid alpha"}
BETA = {"law": "library_solubility", "solute": "L-glutamic acid"}


def transformed(seed_stable: str) -> "gr.crystallization.PolymorphCourse":
    """A slurry of alpha crystals in its own saturated solution, with a little beta or none."""
    return gr.crystallization.polymorph_batch(
        solute_per_solvent=0.0238,
        solubility=ALPHA,
        solubility_law_stable=BETA,
        growth={"law": "power_law_growth", "growth_coefficient": "0.2 um/s", "growth_order": 1.5},
        growth_stable={"law": "power_law_growth", "growth_coefficient": "0.02 um/s", "growth_order": 1.0},
        dissolution={"law": "power_law_dissolution", "dissolution_coefficient": "20 um/s"},
        nucleation_stable={
            "law": "secondary_nucleation",
            "nucleation_coefficient": "1e6 1/(m^3*s)",
            "nucleation_order": 1.0,
        },
        cross_nucleation=0.05,
        temperature_program={
            "law": "power_cooling",
            "temperature_start": TEMPERATURE,
            "temperature_end": TEMPERATURE,
            "duration": "1 hour",
        },
        duration="20 hour",
        crystal_density=1540,
        seed_mass_per_solvent="20 g/kg",
        seed_size="150 um",
        seed_mass_stable=seed_stable,
        volume_shape_factor_stable=0.1,
    )


for seed in ("0 g/kg", "0.2 g/kg"):
    out = transformed(seed)
    hours = np.asarray(out.time) / 3600.0
    half = hours[np.argmax(np.asarray(out.stable_fraction) > 0.5)]
    gone = hours[np.argmax(np.asarray(out.crystals_metastable) < 1e-6)]
    print(f"beta seed {seed}: half after {half:.1f} h, alpha gone after {gone:.1f} h")

alpha, beta = (float(x[0]) for x in (out.solubility_per_solvent, out.solubility_stable))
assert alpha > beta
assert out.stable_fraction_end > 0.99
plateau = np.asarray(out.solute_per_solvent)[np.asarray(out.crystals_metastable) > 2e-3]
assert np.abs(plateau[5:] / alpha - 1.0).max() < 0.02  # growth of beta controls
