"""What the chapter on settling states, calculated."""

from math import pi, sqrt

import numpy as np
from validation import EXAMPLES, settling_curve

import granum as gr
from granum.core import registry
from granum.settling.lab_tests.jar_test import JarTest

s, p = gr.settling, gr.particles
QUARTZ = {"particle_density": 2650, "fluid_density": 998.2, "dynamic_viscosity": "1.002 mPa s"}

# ---- one
fall = {d: float(p.terminal_velocity(f"{d} um", **QUARTZ)) for d in (2, 10, 50, 100, 200, 500, 1000)}
creeping = {d: float(p.terminal_velocity_stokes(f"{d} um", **QUARTZ)) for d in fall}
reynolds = {d: v * d * 1e-6 * 998.2 / 1.002e-3 for d, v in fall.items()}
excess = {d: creeping[d] / fall[d] - 1 for d in fall}

# ---- cold
at_25 = float(p.terminal_velocity("20 um", 2650, 997.0, "0.890 mPa s"))
at_5 = float(p.terminal_velocity("20 um", 2650, 1000.0, "1.518 mPa s"))
slower = 1 - at_5 / at_25

# ---- hindered
SHARE = 0.2
ratio = {
    name: float(registry.find(f"particles.hindrance_{name}")(SHARE, 0.01))
    for name in ("richardson_zaki", "garside_al_dibouni", "barnea_mizrahi")
}
ratio_dilute = float(p.hindrance_richardson_zaki(0.01, 0.01))
ratio_dilute_cell = float(p.hindrance_barnea_mizrahi(0.01, 0.01))
# ---- two_sizes
coarse = float(p.hindered_velocity(fall[100], SHARE, reynolds[100]))
upflow = SHARE * coarse / (1 - SHARE)  # of the liquid that the coarse grains displace
fine_share = fall[10] / upflow

# ---- jar
test = s.BatchTest.read(
    EXAMPLES / "batch-settling" / "limestone.csv",
    initial_concentration="236 g/L",
    underflow_concentration="500 g/L",
)
fit = test.fit()
densities, velocities = test.tangents()
# ---- jar_more
rate = fit["settling_velocity"]
v_0, k = fit["vesilind_velocity"], fit["vesilind_coefficient"]
final_density = 236 * 0.36 / 0.088
height_underflow = float(s.interface_height_underflow(236, "36 cm", 500))

# ---- area
unit_tangent = fit["unit_area_talmage_fitch"]
unit_law = fit["unit_area_coe_clevenger"]
area_tangent = unit_tangent.value * 20e3 / 3600  # 20 t/h of solid
area_law = unit_law.value * 20e3 / 3600
# ---- area_more
by_layer = [float(s.unit_area_coe_clevenger(C, v, 500)) for C, v in zip(densities, velocities, strict=True)]
diameter = sqrt(4 * 1.5 * area_tangent / pi)
apart = area_tangent / area_law - 1
law = {"law": "vesilind", "vesilind_velocity": v_0.value, "vesilind_coefficient": k.value}
limit = s.limiting_flux_underflow(500, 236, law)
thin = s.limiting_flux_underflow(500, 60, law)
area_thin = 20e3 / 3600 / float(thin.limiting_flux)
denser = s.BatchTest.read(
    EXAMPLES / "batch-settling" / "limestone.csv",
    initial_concentration="236 g/L",
    underflow_concentration="550 g/L",
).fit()
area_denser = denser["unit_area_talmage_fitch"].value * 20e3 / 3600
area_denser_law = denser["unit_area_coe_clevenger"].value * 20e3 / 3600
rise = (20e3 / 236 - 20e3 / 500) / 3600 / area_tangent
closed = s.state_point_clarifier(20e3 / 3600 / 236, 236, 20e3 / 3600 / 500, 0.8 * area_tangent, settling=law)

# ---- compression
sludge = {
    "settling": {"law": "vesilind", "vesilind_velocity": "6 m/hour", "vesilind_coefficient": "0.4 L/g"},
    "compression": {
        "law": "logarithmic_stress",
        "critical_concentration": "7 g/L",
        "stress_scale": 2.0,
        "stress_concentration": "4 g/L",
    },
    "cells": 60,
}
low = s.batch_simulation("3 g/L", "0.5 m", "0 6 24 hour", **sludge)
high = s.batch_simulation("3 g/L", "4 m", "0 6 24 hour", **sludge)
# ---- compression_more
mean_low = 3 * 0.5 / low.interface_height[-1]
mean_high = 3 * 4 / high.interface_height[-1]

# ---- basin
surface = float(s.basin_area("500 m^3/hour", "1 m/hour"))
smallest = float(p.terminal_diameter("1 m/hour", **QUARTZ))
ideal = float(s.removal_efficiency_camp("0.5 m/hour", "1 m/hour"))
real = float(s.removal_efficiency_hazen("0.5 m/hour", "1 m/hour"))
real_full = float(s.removal_efficiency_hazen("1 m/hour", "1 m/hour"))


def kept(**liquid):
    """Share of quartz of 100 µm that a basin at 1 m/h keeps."""
    run = gr.alone(
        "settling.clarifier",
        area="100 m2",
        mixture={"solids": "quartz", "liquids": "water", "sizes": {"boundaries": ["99.5 um", "100.5 um"]}},
        feed={
            "solid_flow": "10 kg/h",
            "liquid_flow": "100 t/h",
            "liquid": {"water": 1.0},
            "sizes": {"fractions": [1.0]},
            "temperature": "20 degC",
        },
        **liquid,
    ).solve()
    return run.figure("clarifier.removal_efficiency")


kept_thinning = kept(consistency="50 mPa*s", flow_index=0.7)
holding = p.yield_stress_beris("100 um", 2650, 998.2)
# ---- layers
benchmark = {"feed_concentration": 3.269837, "area": 1500, "height": 4, "nonsettleable_share": 0.00228}
plant = s.settler_layers("36892 m^3/day", underflow_volume_flow="18831 m^3/day", **benchmark)
storm = s.settler_layers("73784 m^3/day", underflow_volume_flow="18831 m^3/day", **benchmark)
# ---- plates
between = float(s.critical_velocity_countercurrent("10 m/hour", "1.2 m", "5 cm", "60 degree"))
projected = float(s.lamella_area(plate_number=100, area="1.2 m^2", plate_angle="60 degree"))

# ---- flocs
gradient = float(s.velocity_gradient_stirred("160 W", "100 m^3", "1 mPa s"))
constant = float(s.aggregation_constant_shear(1e-4, 1.0))
grains = float(s.flocculation_ratio_tanks(40.0, "30 min", constant, 1e-7, 3))
grains_one = float(s.flocculation_ratio_tanks(40.0, "30 min", constant, 1e-7, 1))
growth = float(s.settling_growth_fractal(grains))
faster = growth**2
JARS = JarTest(  # Davis 2010, p. 6-19, at pH 6
    np.array([5.0, 7.0, 10.0, 12.0, 15.0, 20.0]) * 1e-3, [14.0, 9.5, 5.0, 4.5, 6.0, 13.0], 15.0, 6.0
)
jars = JARS.fit()
dose = jars["dose_optimum"].value
dose_low, dose_high = jars["dose_optimum"].interval_95
dose_least = jars["dose_least"].value
dose_again = jars["dose_restabilized"].value
sharpness = jars["charge_sharpness"].value
lasting = float(s.capture_efficiency_dose("8 mg/L", jars["dose_optimum"].value, sharpness))


def figure_jar():
    return settling_curve().figure
