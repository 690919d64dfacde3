"""What the chapter on fluidization states, calculated."""

import numpy as np
from validation import fluidization_curve

import granum as gr
from granum.app.chapters import said
from granum.core.charts import ACCENT, DASHES, LINES, OUT, add_line, add_points, axis_title, figure

fl, p, m = gr.fluidization, gr.particles, gr.materials

# ---- sand
SAND = {
    "particle_diameter": "160 um",
    "particle_density": 2600,
    "fluid_density": 1.2,
    "dynamic_viscosity": "18 uPa s",
}
measured = 0.040
ergun = fl.minimum_fluidization_velocity_ergun(**SAND, void_fraction=0.55, sphericity=0.67)
spread = fl.minimum_fluidization_spread(**SAND, void_fraction=0.55, sphericity=0.67)
# ---- sand_more
tighter = fl.minimum_fluidization_velocity_ergun(**SAND, void_fraction=0.50, sphericity=0.67)
rounder = fl.minimum_fluidization_velocity_ergun(**SAND, void_fraction=0.55, sphericity=0.80)
guessed = fl.minimum_fluidization_velocity_wen_yu(**SAND)
velocities = sorted(float(v) for v in spread.minimum_fluidization_velocity)
inside = [
    float(v) for v, ok in zip(spread.minimum_fluidization_velocity, spread.in_range, strict=True) if ok == 1
]
lift = 0.50 * (2600 - 1.2) * 9.80665 * 1.0  # of a bed 1 m deep, void fraction 0.50 at rest
warm = m.gas_properties(fluid="dry air", temperature="400 degC")
umf_hot = fl.minimum_fluidization_velocity_ergun(
    "160 um", 2600, warm.gas_density, warm.dynamic_viscosity, 0.55, 0.67
)
less_gas = 1 - float(umf_hot) * float(warm.gas_density) / (float(ergun) * 1.2)

# ---- groups
groups = {
    name: fl.geldart_group(d, rho)
    for name, d, rho in (
        ("catalyst", "60 um", 1500),
        ("sand", "160 um", 2600),
        ("flour", "10 um", 1500),
        ("grain", "4 mm", 1300),
    )
}

# ---- bubbles
fast, umf = 0.4, float(ergun)
size = {z: float(fl.bubble_diameter_darton(fast, umf, z)) for z in (0.1, 0.5, 1.0)}
size_mori = {z: float(fl.bubble_diameter_mori_wen(fast, umf, z, 2.0, orifices_per_area=400)) for z in size}
rise = fl.bubble_rise_velocity_davidson_harrison(fast, umf, size[0.5])
as_bubbles = 1 - umf / fast
bed = {u: fl.two_phase_bed(u, umf, "1 m", 2e-5, void_fraction=0.55, diameter="2 m") for u in (0.1, 0.2, 0.4)}
# ---- reaction
missed = {
    u: float(fl.unconverted_fraction_davidson_harrison(b.bypass_fraction, 2.0, "1 m", u))
    for u, b in bed.items()
}
plug = {u: float(np.exp(-2.0 * 1.0 / u)) for u in bed}
mixed = {u: 1 / (1 + 2.0 * 1.0 / u) for u in bed}
slug = fl.minimum_slugging_velocity(umf, "0.3 m")

# ---- window
classes = {
    um: (
        float(fl.minimum_fluidization_velocity_ergun(f"{um} um", 2600, 1.2, "18 uPa s", 0.55, 0.67)),
        float(p.terminal_velocity(f"{um} um", 2600, 1.2, "18 uPa s")),
    )
    for um in (50, 160, 500)
}
# ---- distributor
plate = fl.distributor_design(lift, fast, 1.2, "2 mm", distributor_ratio=0.3)
plate_pressure = float(plate.distributor_pressure_drop)
fan = np.pi * fast * (lift + plate_pressure)  # of a bed 2 m wide
fan_real = fan / 0.6

# ---- freeboard
height = fl.disengaging_height_spread(fast, umf, size[1.0])
heights = sorted(float(x) for x in height.disengaging_height)
flux = fl.elutriation_spread(fast, classes[50][1], "50 um", 2600, 1.2, "18 uPa s")
fluxes = sorted(float(x) for x in flux.elutriation_flux)
geldart_flux = float(fl.elutriation_flux_geldart(fast, classes[50][1], 1.2))
fines_lost = geldart_flux * 0.01 * np.pi  # 1 % of fines in the bed, 2 m wide
transfer = fl.heat_transfer_coefficient_zabrodsky("160 um", 2600, 0.026)
best_speed = fl.superficial_velocity_best_heat_transfer("160 um", 2600, 1.2, "18 uPa s")

# ---- backwash
GRAIN = {"particle_diameter": "0.8 mm", "particle_density": 2650}
SEASONS = {5: (1000.0, 1.518e-3), 20: (998.2, 1.002e-3)}
start, final = {}, {}
for celsius, (rho, eta) in SEASONS.items():
    start[celsius] = fl.minimum_fluidization_velocity_ergun(
        **GRAIN, fluid_density=rho, dynamic_viscosity=eta, void_fraction=0.42, sphericity=0.85
    )
    final[celsius] = p.terminal_velocity(
        **GRAIN,
        fluid_density=rho,
        dynamic_viscosity=eta,
        drag="drag_coefficient_haider_levenspiel",
        sphericity=0.85,
    )


def expanded(velocity, celsius):
    """Void fraction and height over that of the settled bed, in water of a season."""
    rho, eta = SEASONS[celsius]
    re = float(final[celsius]) * 0.8e-3 * rho / eta
    n = float(p.settling_exponent_richardson_zaki(re))
    void = float(fl.bed_void_fraction_richardson_zaki(velocity, final[celsius], n))
    return (1 - 0.42) / (1 - void)


RATE = 45 / 3600  # m/s
summer, winter = expanded(RATE, 20) - 1, expanded(RATE, 5) - 1
drawn_back = {}
for celsius in SEASONS:
    low, high = 0.0, float(final[celsius])
    for _ in range(60):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if expanded(middle, celsius) < 1 else (low, middle)
    drawn_back[celsius] = low


def figure_pressure():
    return fl.pressure_velocity_chart(
        "1 m", **SAND, void_fraction=0.55, void_fraction_settled=0.50, sphericity=0.67
    )


def figure_minimum():
    names = [name.replace("_", "–").title() for name in spread.correlation]
    found, valid = np.asarray(spread.minimum_fluidization_velocity), np.asarray(spread.in_range) == 1
    drawing = figure(axis_title("minimum_fluidization_velocity", "cm/s"), "", showlegend=True)
    add_line(
        drawing,
        [100 * measured] * 2,
        [names[0], names[-1]],
        said("measured", "mesuré"),
        color=OUT,
        dash="dash",
    )
    for is_valid, label in (
        (True, said("within its range", "dans son domaine")),
        (False, said("outside its range", "hors de son domaine")),
    ):
        chosen = np.flatnonzero(valid == is_valid)
        add_points(
            drawing, 100 * found[chosen], [names[i] for i in chosen], label, color=ACCENT, hollow=not is_valid
        )
    drawing.update_yaxes(type="category", categoryorder="array", categoryarray=names, automargin=True)
    return drawing


def figure_groups():
    return fl.geldart_chart("160 um", 2600)


def figure_bubbles():
    drawing = figure(axis_title("height", "m"), axis_title("bubble_diameter", "cm"))
    heights_ = np.linspace(0.02, 1.5, 60)
    for u, color, dash in zip((0.1, 0.2, 0.4), LINES, DASHES, strict=False):
        sizes = fl.bubble_diameter_darton(u, umf, heights_)
        add_line(
            drawing,
            heights_,
            100 * np.asarray(sizes),
            f"{u:g} m/s".replace(".", said(".", ",")),
            color=color,
            dash=dash,
        )
    return drawing


def figure_expansion():
    drawing = figure(
        axis_title("superficial_velocity", "m/hour"),
        said("bed height over settled height", "hauteur du lit sur hauteur au repos"),
    )
    for celsius, color, dash in zip((5, 20), LINES, DASHES, strict=False):
        rates = np.linspace(15, 60, 50)
        add_line(
            drawing,
            rates,
            [max(1.0, expanded(r / 3600, celsius)) for r in rates],
            f"{celsius} °C",
            color=color,
            dash=dash,
        )
    return drawing


def figure_curve():
    return fluidization_curve().figure
