"""What the chapter on particles states, calculated."""

from pathlib import Path

import numpy as np
from validation import particles_sizes

import granum as gr
from granum.app.chapters import said
from granum.app.shipped import examples_folder
from granum.core import registry
from granum.core.charts import DASHES, LINES, add_line, axis_title, figure

p, f = gr.particles, gr.filtration
SIEVES = Path(examples_folder()) / "size-analysis" / "crushed_quartz_mccabe2005.csv"
WATER = {"fluid_density": 998.2, "dynamic_viscosity": "1.002 mPa s"}
AIR = {"fluid_density": 1.2, "dynamic_viscosity": "18.1 uPa s"}

# ---- flake
# mica, 200 µm by 200 µm by 10 µm
flake = {"particle_length": "200 um", "particle_width": "200 um", "particle_thickness": "10 um"}
sphericity = p.sphericity_box(**flake)
volume = 200e-6 * 200e-6 * 10e-6
surface = 2 * 200e-6 * 200e-6 + 4 * 200e-6 * 10e-6
by_volume = p.equivalent_diameter_volume(volume)
by_surface = p.equivalent_diameter_surface_volume(volume, surface)
by_picture = p.equivalent_diameter_projected_area(200e-6 * 200e-6)
# ---- flake_fall
fall_flake = p.terminal_velocity(
    float(by_volume), 2800, **WATER, drag="drag_coefficient_haider_levenspiel", sphericity=float(sphericity)
)
by_fall = p.equivalent_diameter_stokes(float(fall_flake), 2800, **WATER)

# ---- quartz
sieves = p.SieveAnalysis.read(SIEVES, pan_mass="0.75 g", sample_mass="100 g")
fit = sieves.fit()
d32, d43 = fit["mean_diameter_surface_volume"], fit["mean_diameter_mass"]
d10, d50, d90 = (fit[f"percentile_{k}"] for k in (10, 50, 90))
number_mean = fit["mean_diameter_number_length"]
modulus, exponent = fit["size_modulus"], fit["distribution_exponent"]
# ---- pan
without_pan = p.SieveAnalysis.read(SIEVES, sample_mass="99.25 g").fit()
surface_share = 1 - 0.9925 * float(without_pan["specific_surface"].value) / float(
    fit["specific_surface"].value
)
d32_without = without_pan["mean_diameter_surface_volume"]
change_median = without_pan["percentile_50"].value / d50.value - 1

# ---- cake
alpha = {
    name: float(
        f.cake_resistance_kozeny_carman(particle_diameter=x.value, void_fraction=0.45, solid_density=2650)
    )
    for name, x in (("d32", d32), ("d50", d50), ("d43", d43), ("number", number_mean))
}
too_low = alpha["d32"] / alpha["d50"]
too_high = alpha["number"] / alpha["d32"]

# ---- counting
hatch = p.mean_diameter_hatch_choate("10 um", 2.0, 3, 0, basis="number")
shift = float(p.median_diameter_hatch_choate("10 um", 2.0, "number", "volume"))
one_in = (shift / 10e-6, 1000 * np.pi / 6 * 2650 * 1e-9)


# ---- sample
def grains(mass, millimeter, share):
    """Number of grains of a size that a sample holds, quartz spheres."""
    return share * mass / (np.pi / 6 * 2650 * (millimeter * 1e-3) ** 3)


coarse = {gram: grains(gram * 1e-3, 3.3, 0.025) for gram in (10, 100, 1000)}
error = {gram: 1 / n**0.5 for gram, n in coarse.items()}

# ---- ore
LEAD = {
    "sampling_error": 0.01,
    "liberation_size": "150 um",
    "mineral_fraction": 0.05 / 0.866,
    "mineral_density": "7.5 g/cm3",
    "gangue_density": "2.65 g/cm3",
}
lead = {mm: p.sample_mass_gy(passing_size_95=f"{mm} mm", **LEAD) for mm in (25, 5, 1)}
mince = p.mixing_index_lacey(0.0068**0.5, component_fraction=0.15, particles_per_sample=50)
mince_best = p.composition_deviation_random(component_fraction=0.15, particles_per_sample=50)

# ---- drag
ranking = p.drag_ranking()
order = [str(name) for name in ranking.drag]
spread = {
    re: sorted(
        float(registry.find(f"particles.drag_coefficient_{name}")(re))
        for name in (
            "brown_lawler",
            "haider_levenspiel",
            "turton_levenspiel",
            "clift_gauvin",
            "khan_richardson",
        )
    )
    for re in (1, 100, 10000)
}
wide = {re: x[-1] / x[0] - 1 for re, x in spread.items()}

# ---- shape
fall = {
    phi: float(
        p.terminal_velocity("1 mm", 2650, **WATER, drag="drag_coefficient_haider_levenspiel", sphericity=phi)
    )
    for phi in (1.0, 0.8, 0.6)
}
slower = {phi: 1 - v / fall[1.0] for phi, v in fall.items()}
fall_fine = {
    phi: float(
        p.terminal_velocity("50 um", 2650, **WATER, drag="drag_coefficient_haider_levenspiel", sphericity=phi)
    )
    for phi in (1.0, 0.6)
}
slower_fine = 1 - fall_fine[0.6] / fall_fine[1.0]
natural = p.terminal_velocity_ferguson_church("1 mm", 2650, **WATER)

# ---- corrections
thinning, thinning_small = (
    float(p.terminal_velocity_renaud(size, 2650, 1000, 1.0, 0.6)) for size in ("3 mm", "1 mm")
)
held = 1e-3 / float(p.yield_stress_beris("1 mm", 2650, 1000))
plastic = float(p.terminal_velocity_ansley_smith("10 mm", 2650, 1000, "50 mPa*s", 1.0))
walled = float(p.terminal_velocity_bounded(0.01, 0.1, 0.1)) / 0.01
mean_path = 66e-9
dust_fall = {
    um: float(p.terminal_velocity_slip(f"{um} um", 2650, **AIR, mean_free_path=mean_path))
    for um in (0.1, 1, 10)
}
dust_plain = {um: float(p.terminal_velocity_stokes(f"{um} um", 2650, **AIR)) for um in (0.1, 1, 10)}
slip = {um: dust_fall[um] / dust_plain[um] - 1 for um in dust_fall}
aerodynamic = p.equivalent_diameter_aerodynamic("10 um", 2650)
stop_air = p.stopping_distance("100 um", 2650, **AIR, initial_velocity="20 m/s")
stop_fine = p.stopping_distance("10 um", 2650, **AIR, initial_velocity="20 m/s")
relax = p.relaxation_time("100 um", 2650, **WATER)
wander = p.brownian_diameter("20 degC", 2650, **WATER, time="1 min")

# ---- minerals
GALENA, QUARTZ = 7500.0, 2650.0
ratio_coarse = p.settling_ratio(GALENA, QUARTZ, 1000.0, 1.0)
ratio_fine = p.settling_ratio(GALENA, QUARTZ, 1000.0, 0.5)
ratio_dense = p.settling_ratio(GALENA, QUARTZ, 1500.0, 1.0)
# ---- minerals_real
galena = {mm: float(p.terminal_velocity(f"{mm} mm", GALENA, **WATER)) for mm in (0.05, 0.2, 1.0)}
partner = {mm: float(p.terminal_diameter(v, QUARTZ, **WATER)) / (mm * 1e-3) for mm, v in galena.items()}


def figure_sizes():
    return particles_sizes().figure


def figure_means():
    drawing = figure(
        axis_title("geometric_standard_deviation"),
        said("mean diameter over median by mass", "diamètre moyen sur médiane en masse"),
        y_log=True,
    )
    deviation = np.linspace(1.01, 3.0, 80)
    for (upper, lower), color, dash in zip(((1, 0), (3, 2), (4, 3)), LINES, DASHES, strict=False):
        means = [
            float(p.mean_diameter_hatch_choate("1 mm", s, upper, lower, basis="volume")) / 1e-3
            for s in deviation
        ]
        add_line(drawing, deviation, means, f"D[{upper},{lower}]", color=color, dash=dash)
    return drawing


def figure_drag():
    return p.drag_chart()


def figure_deviation():
    return p.drag_deviation_chart(deviation_largest=0.25)


def figure_shape():
    drawing = figure(
        axis_title("particle_diameter", "um"), axis_title("terminal_velocity", "mm/s"), x_log=True, y_log=True
    )
    sizes = np.geomspace(10e-6, 5e-3, 60)
    for phi, color, dash in zip((1.0, 0.8, 0.6), LINES, DASHES, strict=False):
        velocity = p.terminal_velocity(
            sizes, 2650, **WATER, drag="drag_coefficient_haider_levenspiel", sphericity=phi
        )
        name = said("sphericity", "sphéricité") + f" {phi:g}".replace(".", said(".", ","))
        add_line(drawing, 1e6 * sizes, 1e3 * np.asarray(velocity), name, color=color, dash=dash)
    return drawing
