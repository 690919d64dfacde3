"""What the chapter on filtration states, calculated."""

from math import log
from pathlib import Path

from validation import filtration_leaf, filtration_pressures

import granum as gr
from granum.app.shipped import examples_folder
from granum.filtration.equipment.continuous import RotaryVacuumDrum
from granum.streams.utilities import pumped

f = gr.filtration
TESTS = Path(examples_folder()) / "leaf-filter"

# ---- leaf
leaf = f.LeafTest.read(
    TESTS / "leaf_geankoplis.csv",
    area="0.0439 m2",
    pressure_drop="338 kPa",
    dynamic_viscosity="0.8937 cP",
    dry_cake_per_filtrate="23.47 g/L",
)
fit = leaf.fit()
alpha, medium = fit["cake_resistance"], fit["medium_resistance"]
# ---- cloth
# of cake that resists as the cloth does: solid of 2700 kg/m³, half of the cake void
thickness_equal = medium.value / alpha.value / 1.35e3

# ---- pressures
pressures = f.Compressibility.read(
    TESTS / "pressures_mccabe.csv",
    area="440 cm2",
    dynamic_viscosity="0.8937 cP",
    dry_cake_per_filtrate="23.5 g/L",
).fit()
n = pressures["compressibility"].value
# ---- gains
low_n, high_n = pressures["compressibility"].interval_95
gain_carbonate = 2 ** (1 - n)  # flux at twice the pressure
gain_sludge = 2 ** (1 - 0.85)

# ---- thinning
thin_gain = [
    gr.alone("filtration.chamber_press", pressure_drop=p, **law)
    .solve()
    .figure("chamber_press.formation_time")
    for law in ({}, {"consistency": "20 cP", "flow_index": 0.5})
    for p in ("3 bar", "6 bar")
]
gain_newton, gain_thinning = thin_gain[0] / thin_gain[1], thin_gain[2] / thin_gain[3]

# ---- course
voids = f.void_fraction_cake(dry_cake_mass="0.236 kg", cake_volume="145 cm3", solid_density=2630)
alpha_course = f.cake_resistance_kozeny_carman(
    particle_diameter="85 um", void_fraction=0.38, solid_density=2630
)
volume_course = f.filtrate_volume_constant_pressure(
    "5 min", "0.5 m2", "0.8 bar", "1.2 cP", alpha_course, 15.3
)
# ---- loose
alpha_loose = f.cake_resistance_kozeny_carman(
    particle_diameter="85 um", void_fraction=0.43, solid_density=2630
)

# ---- press
slurry = {
    "dynamic_viscosity": "0.8937 cP",
    "cake_resistance": alpha.value,
    "medium_resistance": medium.value,
    "dry_cake_per_filtrate": 23.47,
}
press = f.filtration_cycle(area="50 m2", pressure_drop="3.38 bar", dead_time="30 min", **slurry)
drum_flow = f.filtrate_flow_drum(
    area="50 m2", cycle_time="2 min", submergence=0.35, pressure_drop="0.6 bar", **slurry
)
# ---- compared
rate = press.dry_cake_mass / press.cycle_time
cake = float(press.dry_cake_mass) / 50 / (2710 * 0.5)
twice = 2 * float(press.filtration_time)
volume_twice = f.filtrate_volume_constant_pressure(
    twice, "50 m2", "3.38 bar", **{k: slurry[k] for k in slurry}
)
lost = 1 - (float(volume_twice) / (twice + 1800)) / float(press.mean_filtrate_flow)
drum_rate = float(drum_flow) * 23.47
drum_cake = drum_rate * 120 / 50 / (2710 * 0.5)
drum_drive = 50 * RotaryVacuumDrum.card.parameter("drive_power_per_area").default
press_pump = pumped(press.mean_filtrate_flow, 3.38e5)


def filling(**pump):
    """Time to fill the press of the example."""
    return gr.alone("filtration.chamber_press", **pump).solve().figure("chamber_press.formation_time")


filled, filled_slowly = filling(), filling(filtrate_flux_largest="300 L/m2/h")

# ---- quick tests
BENCH = Path(examples_folder()) / "lab-tests"
suction = f.CapillarySuctionTest.read(
    BENCH / "capillary_suction_test_made.csv", suction_constant="5e-10 m^2/Pa"
).fit()
per_solids = suction["suction_time_normalized"]
sucked = suction["cake_resistance"].value
fouling = f.FoulingIndexTest.read(
    BENCH / "fouling_index_test_made.csv",
    area="13.8 cm2",
    pressure_drop="2 bar",
    dynamic_viscosity="1.002 cP",
).fit()
index_modified = fouling["modified_fouling_index"].value * 1e-6
modified_low, modified_high = (x * 1e-6 for x in fouling["modified_fouling_index"].interval_95)
carried, clean = fouling["fouling_potential"].value, fouling["medium_resistance"].value
silt = {times: 6000 * float(f.silt_density_index_cake(times * carried, clean)) for times in (1, 2, 10)}
silt_warm = 6000 * float(f.silt_density_index_cake(carried, clean, dynamic_viscosity="0.8 cP"))
sand_test = {"concentration_inlet": "10 mg/L", "superficial_velocity": "5 m/hour", "time": "20 min"}
number_little = float(f.filterability_number("0.2 m", "1 mg/L", **sand_test))
number_much = float(f.filterability_number("0.5 m", "0.3 mg/L", **sand_test))

dips = f.CakeFormationTest.read(BENCH / "cake_formation_test_made.csv").fit()
centimeter = dips["standard_cake_formation_time"]
like_medium = dips["cake_thickness_medium"].value
centimeter_leaf = f.standard_cake_formation_time(
    "1e10 m/kg", "100 kg/m3", void_fraction=0.5, solid_density=3000, dynamic_viscosity="1 cP"
)

# ---- cargo
compacted = f.ProctorFagerbergTest.read(
    BENCH / "proctor_fagerberg_test_made.csv", solid_density="4.2 g/cm3"
).fit()
shipped = compacted["transportable_moisture_limit"]
void_shipped = compacted["void_fraction"].value

# ---- own weight
thin_slurry = {
    "cake_resistance": "1e9 m/kg",
    "medium_resistance": "1e9 1/m",
    "dry_cake_per_filtrate": "30 kg/m3",
    "dynamic_viscosity": "1 cP",
    "liquid_density": 998,
}
sunk_half = f.filtration_time_falling_head("25 cm", "50 cm", **thin_slurry)
sunk = f.filtration_time_falling_head("49 cm", "50 cm", **thin_slurry)
sunk_deep = f.filtration_time_falling_head("98 cm", "100 cm", **thin_slurry)
sunk_settled = f.filtration_time_settling(
    "50 cm",
    "5 mm/s",
    solids_volume_fraction=0.0111,
    void_fraction=0.42,
    cake_resistance="1e9 m/kg",
    medium_resistance="1e9 1/m",
)

# ---- clay
CLAY = {"void_fraction": 0.54, "consolidation_coefficient": "1e-7 m2/s"}
tube = gr.alone("filtration.tube_press", **CLAY).solve()
wet_clay = tube.figure("tube_press.moisture_dry_basis")
clay = wet_clay / (1 + wet_clay)
unpressed = 0.54 * 998 / (0.54 * 998 + 0.46 * tube.streams["feed"].solid_density)
reached = [
    float(f.consolidation_ratio_terzaghi(f.consolidation_time("3 min", "1e-7 m2/s", 0.46 * z)))
    for z in (0.01, 0.02)
]

# ---- thickeners
pulsed = gr.alone("filtration.thickening_filter").solve()
pulsed_area = pulsed.figure("thickening_filter.area_required")
pulsed_thick = 1e3 * pulsed.figure("thickening_filter.cake_thickness")
hourly = gr.alone("filtration.thickening_filter", filtration_time="1 hour").solve()
hourly_area = hourly.figure("thickening_filter.area_required")
STIRRED = {
    "vessel_contents": "thickened",
    "mass_transfer_coefficient": "2e-4 m/s",
    "filtration_time": "1 day",
}
sheared_areas = [
    gr.alone("filtration.thickening_filter", **STIRRED, solids_volume_fraction_thickened=to)
    .solve()
    .figure("thickening_filter.area_required")
    for to in (0.15, 0.25)
]

# ---- cartridges
cartridges = gr.alone("filtration.cartridge_filter").solve()
lasting = cartridges.figure("cartridge_filter.run_time")
twice_as_many = gr.alone("filtration.cartridge_filter", cartridge_lengths=60).solve()
lasting_many = twice_as_many.figure("cartridge_filter.run_time") / lasting
dirtier = gr.alone("filtration.cartridge_filter", feed={"solid_flow": "1.5 kg/h"}).solve()
lasting_dirty = dirtier.figure("cartridge_filter.run_time")

# ---- wash
left_good = f.solute_remaining_dispersion(wash_ratio=1.5, dispersion_number=50)
left_poor = f.solute_remaining_dispersion(wash_ratio=1.5, dispersion_number=5)
left_dahlstrom = f.solute_remaining_dahlstrom(wash_ratio=1.5, displacement_efficiency=0.7)
badly_mixed = gr.settling.soluble_loss_countercurrent(3, 4, mixing_efficiency=0.9)
decanted = {n: gr.settling.soluble_loss_countercurrent(wash_ratio=3, wash_stages=n) for n in (3, 4, 5)}
stirred_up = f.solute_remaining_reslurry(reslurry_ratio=1, wash_stages=3)

# ---- blow
threshold = f.threshold_pressure_cake(
    particle_diameter="20 um", void_fraction=0.45, surface_tension="0.072 N/m"
)
threshold_fine = f.threshold_pressure_cake(
    particle_diameter="2 um", void_fraction=0.45, surface_tension="0.072 N/m"
)
permeability = f.cake_permeability(cake_resistance="1e10 m/kg", void_fraction=0.45, solid_density=2710)
blown = [
    float(
        f.saturation_after_deliquoring(
            t, "2 bar", permeability, "1 cP", 0.45, "20 mm", irreducible_saturation="20 %"
        )
    )
    for t in ("30 s", "1 min", "5 min")
]
moisture = [
    float(f.moisture_dry_basis_cake(s, void_fraction=0.45, liquid_density=1000, solid_density=2710))
    for s in blown
]

# ---- sand
capture = {
    d: float(
        f.collector_efficiency_tufenkji(
            particle_diameter=f"{d} um",
            collector_diameter="0.6 mm",
            superficial_velocity="8 m/hour",
            void_fraction=0.42,
            particle_density=1050,
            fluid_density=998,
            dynamic_viscosity="1 cP",
        )
    )
    for d in (0.1, 1, 10)
}
coefficient = {
    d: float(f.filter_coefficient(x, "0.6 mm", 0.42, attachment_efficiency=0.5)) for d, x in capture.items()
}
passed = {d: float(f.concentration_iwasaki(1.0, k, "0.8 m")) for d, k in coefficient.items()}
head = f.head_loss_clean_bed("0.8 m", "0.6 mm", "8 m/hour", 0.42, "1 cP", 998)


def figure_leaf():
    return filtration_leaf().figure


def figure_pressures():
    return filtration_pressures().figure


def figure_cycle():
    return f.filtration_cycle_chart(area="50 m2", pressure_drop="3.38 bar", dead_time="30 min", **slurry)


def figure_washing():
    return f.washing_chart(dispersion_number=5.0)


# ---- membranes
def limit(protein):
    """Flux that polarization allows, gel at 250 g/L."""
    return f.filtrate_flux_limiting("5e-6 m/s", "250 g/L", f"{protein} g/L")


water_flux = f.filtrate_flux_membrane("3 bar", "0.6 cP", "6e12 1/m")
flux = {protein: limit(protein) for protein in (6, 25, 100)}


def osmotic(salt):
    """Osmotic pressure of sodium chloride by mass fraction, from its water activity at 25 °C."""
    ratio = salt / (1 - salt)
    return f.osmotic_pressure_activity(gr.materials.solute("sodium chloride").solvent_activity(298.15, ratio))


pressed = {salt: osmotic(salt) for salt in (0.01, 0.035, 0.07, 0.20)}
half_out = pressed[0.07] / 0.5
"""Pump work for a volume of permeate where half of sea water passes at the least pressure."""
evaporated = 930e3 * 1000
times = evaporated / half_out


def plant(**stages):
    """Whey protein from 0.5 g/L on 90 m² in two stages, as Coulson and Richardson set it."""
    run = gr.alone(
        "filtration.ultrafiltration",
        area="90 m2",
        stage_count="2",
        mass_transfer_coefficient="0.02 m/h",
        concentration_gel="30 g/L",
        medium_resistance="1e11 1/m",
        fouling_resistance=0,
        pore_diameter="1 nm",
        solvent="no",
        mixture={"liquids": "water", "solids": "whey protein"},
        feed={
            "liquid_flow": "2.5 m3/h",
            "solid_flow": "1.25 kg/h",
            "temperature": "20 degC",
            "liquid": {"water": 1.0},
        },
        **stages,
    ).solve()
    return run.figure("ultrafiltration.concentration_retentate")


halves, thirds = plant(), plant(area_shares=[60, 30])


# ---- carbon
def carbon_life(minutes):
    """Of a bed for the traces of toluene, 5 % through."""
    return f.breakthrough_time_wheeler_jonas(f"{minutes} min", traces, water_load, 450, "0.02 1/s")


traces, vapor = 0.01, 4.7e-3
water_load = f.FreundlichIsotherm("26.1 mg/g", 0.44)(traces)
air_load = f.FreundlichIsotherm("300 mg/g", 0.11, "1 g/m^3")(vapor)
front = log(19.0) / 0.02
life = {minutes: carbon_life(minutes) for minutes in (15, 7.5)}
