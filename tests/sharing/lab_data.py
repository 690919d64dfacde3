"""Ordinary data for every lab test: columns and conditions, SI, from the forward model of the test, without
scatter.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from scipy.stats import norm
from tests.sharing.places import ROOT

from granum.core import registry
from granum.drying.formulas.diffusion import plate
from granum.drying.isotherms.adsorption import Gab
from granum.drying.isotherms.grains import HendersonModified
from granum.drying.lab_tests.curve import moisture_model
from granum.filtration.formulas.deliquoring import saturation_after_deliquoring
from granum.filtration.formulas.expression import consolidation_ratio_terzaghi
from granum.filtration.formulas.washing import wash_effluent_concentration
from granum.settling.kynch import kynch_height
from granum.settling.velocities import Vesilind


class Data(NamedTuple):
    """Columns, conditions and the column that is read with an error; ``scatter`` is the relative error of a
    good reading.
    """

    columns: dict[str, np.ndarray]
    conditions: dict[str, Any]
    measured: str
    scatter: float = 0.01


def keys() -> list[str]:
    """Every lab test of the package."""
    return sorted(
        k
        for k, thing in registry.everything().items()
        if thing.card.sort == "lab test" and thing.__module__.startswith("granum.")
    )


FILTER = {"area": 0.05, "dynamic_viscosity": 1e-3, "dry_cake_per_filtrate": 20.0}
ALPHA, MEDIUM, DROP = 2e11, 1e11, 1e5


def _volumes(t: np.ndarray) -> np.ndarray:
    slope = 1e-3 * ALPHA * 20.0 / (2 * DROP * 0.05**2)
    level = 1e-3 * MEDIUM / (DROP * 0.05)
    return (-level + np.sqrt(level**2 + 4 * slope * t)) / (2 * slope)


def _grinding() -> Data:
    from granum.comminution.lab_tests.grinding_kinetics import GrindingKinetics

    sizes = 4e-3 * 2.0 ** np.arange(-8, 1)
    feed = (sizes / sizes[-1]) ** 1.2
    times = np.array([0.0, 60.0, 120.0, 240.0, 480.0])
    p = {
        "selection_rate": 0.004,
        "selection_exponent": 0.8,
        "fines_share": 0.5,
        "fines_exponent": 0.7,
        "coarse_exponent": 4.0,
    }
    rows = {"grinding_time": np.repeat(times, sizes.size), "particle_diameter": np.tile(sizes, times.size)}
    plain = GrindingKinetics(**rows, cumulative_fraction=np.tile(feed, times.size))
    below = np.vstack([feed, np.minimum(np.asarray(plain.model(p, times[1:], sizes, feed)), 1.0)])
    below[:, -1] = 1.0
    return Data({**rows, "cumulative_fraction": below.ravel()}, {}, "cumulative_fraction", 0.003)


def _batch() -> Data:
    rows = np.loadtxt(
        ROOT / "examples/seeded-crystallizer/batch_made.csv", delimiter=",", comments=["#", "time"]
    )
    law = {"law": "polynomial_solubility", "coefficients": [0.1286, 5.88e-3, 1.721e-4]}
    return Data(
        {
            "time": rows[:, 0] * 60,
            "temperature": rows[:, 1] + 273.15,
            "solute_per_solvent": rows[:, 2],
            "mean_diameter": rows[:, 3] * 1e-6,
        },
        {
            "crystal_density": 2110,
            "seed_mass_per_solvent": 0.0005,
            "seed_size": 100e-6,
            "seed_width": 20e-6,
            "solubility": law,
        },
        "solute_per_solvent",
        1e-4,
    )


def _product() -> Data:
    rows = np.loadtxt(ROOT / "tests/references/primary_drying_shivkumar2019.csv", delimiter=",", skiprows=1)[
        8:
    ]
    return Data(
        {
            "time": rows[:, 0] * 3600,
            "temperature_product": rows[:, 2] + 273.15,
            "temperature_shelf": rows[:, 3] + 273.15,
        },
        {
            "pressure_chamber": 19.998,
            "heat_transfer_coefficient": 12.0,
            "area_vial": 3.8e-4,
            "area_product": 3.14e-4,
            "volume_fill": 2e-6,
            "concentration": 50.0,
        },
        "temperature_product",
        2e-4,
    )


def _stepped(test: str) -> Data:
    p = np.repeat([0.5e5, 1e5, 2e5, 4e5], 6)
    n, t, V, rows = 0.4 if test == "stepped" else 0.0, 0.0, 0.0, []
    for i, pressure in enumerate(p):
        alpha = ALPHA * (pressure / 1e5) ** n
        a, b = 1e-3 * alpha * 20.0 / (2 * pressure * 0.05**2), 1e-3 * MEDIUM / (pressure * 0.05)
        step = 2e-4
        if i:
            t += a * ((V + step) ** 2 - V**2) + b * step
            V += step
        rows.append((t, V, pressure))
        if i + 1 < len(p) and p[i + 1] != pressure:
            rows.append((t + 1e-3, V, p[i + 1]))
    t, V, p = np.array(rows).T
    return Data({"time": t, "filtrate_volume": V, "pressure_drop": p}, dict(FILTER), "filtrate_volume", 3e-4)


def _pressure_curve() -> Data:
    U = np.linspace(0.02, 0.6, 24)
    x = U / 0.3
    return Data(
        {"superficial_velocity": U, "pressure_drop": 4000.0 * np.minimum(0.9 * x + 0.1 * x**2, 1.0)},
        {"height": 0.3, "particle_density": 2500.0, "fluid_density": 1.2},
        "pressure_drop",
    )


def _isotherms() -> Data:
    aw, T = np.tile(np.linspace(0.15, 0.85, 8), 3), np.repeat([288.15, 303.15, 318.15], 8)
    law = HendersonModified(
        isotherm_coefficient=8.65e-5, isotherm_exponent=1.8634, isotherm_temperature_offset=49.81
    )
    return Data(
        {"temperature": T, "water_activity": aw, "moisture_dry_basis": np.asarray(law.moisture(aw, T))},
        {},
        "moisture_dry_basis",
    )


def _sieves() -> Data:
    sizes = 4e-3 * 2.0 ** (-0.5 * np.arange(12))
    below = 1.0 - np.exp(-((sizes / 1.2e-3) ** 1.6))
    retained = np.diff(np.concatenate([[1.0], below])) * -1.0
    return Data(
        {"aperture": sizes, "retained_mass": 0.5 * np.maximum(retained, 0.0)},
        {"pan_mass": 0.5 * float(below[-1])},
        "retained_mass",
        0.03,
    )


def _counter() -> Data:
    from scipy.stats import norm

    edges = 2e-6 * 2.0 ** (0.5 * np.arange(13))
    below = norm.cdf(np.log(edges / 15e-6) / np.log(1.7))
    return Data(
        {"class_edges": edges, "class_numbers": np.concatenate([[0.0], 5000 * np.diff(below)])},
        {},
        "class_numbers",
        0.03,
    )


def _laser() -> Data:
    from scipy.stats import norm

    sizes = 1e-6 * 2.0 ** (0.5 * np.arange(16))
    below = norm.cdf(np.log(sizes / 15e-6) / np.log(1.7))
    below[0], below[-1] = 0.0, 1.0
    return Data({"particle_diameter": sizes, "cumulative_fraction": below}, {}, "cumulative_fraction", 0.003)


def _images() -> Data:
    from scipy.stats import norm

    z = norm.ppf((np.arange(60) + 0.5) / 60)
    return Data(
        {"particle_diameter": 20e-6 * 1.5 ** np.random.default_rng(5).permutation(z)},
        {},
        "particle_diameter",
        0.02,
    )


def _settling() -> Data:
    t = np.linspace(0.0, 5400.0, 25)
    law = Vesilind(vesilind_velocity=1.5e-3, vesilind_coefficient=0.4)
    return Data(
        {"time": t, "interface_height": np.asarray(kynch_height(t, law, 3.0, 0.4, 5.0, 200.0))},
        {"initial_concentration": 3.0},
        "interface_height",
        0.002,
    )


def _compression() -> Data:
    from granum.settling.lab_tests.compression_test import CompressionTest

    t = np.array([0, 300, 600, 900, 1200, 1800, 2400, 3600, 5400, 7200, 9000, 10800], dtype=float)
    conditions = {"initial_concentration": 3.5, "solid_density": 1050.0, "cells": 30}
    test = CompressionTest(time=t, interface_height=np.linspace(1, 0.3, t.size), **conditions)
    p = {
        "vesilind_velocity": 2e-3,
        "vesilind_coefficient": 0.5,
        "critical_concentration": 7.0,
        "stress_scale": 0.5,
    }
    h = np.concatenate([[1.0], np.asarray(test.model(p, t[1:], 1.0))])
    return Data({"time": t, "interface_height": h}, conditions, "interface_height", 0.002)


def _flocs() -> Data:
    from granum.settling.lab_tests.flocculent_column import removal_at

    t, z = np.repeat([600.0, 1200.0, 2400.0, 3600.0, 5400.0, 7200.0], 4), np.tile([0.5, 1.0, 1.5, 2.0], 6)
    p = {"floc_velocity": 4e-4, "floc_exponent": 1.3, "floc_sharpness": 1.2, "floc_time": 2000.0}
    return Data(
        {"time": t, "depth": z, "removal_efficiency": np.asarray(removal_at(p, t, z))},
        {},
        "removal_efficiency",
    )


def _coagulant_jars() -> Data:
    D = np.linspace(5e-3, 45e-3, 9)
    share = np.log(60.0 / 31.0) / np.log(30.0)  # of the collisions that last, at the half width of 8 mg/L
    lasting = share ** (((D - 15e-3) / 8e-3) ** 2)
    columns = {"coagulant_dose": D, "residual_turbidity": 60.0 * (2.0 / 60.0) ** lasting}
    return Data(columns, {"raw_turbidity": 60.0}, "residual_turbidity", 0.02)


def _compacted() -> Data:
    water = np.linspace(0.1, 0.56, 9)  # per volume of solid; voids 0.6 of it where 0.7 of them are full
    void = 0.6 - 0.25 * (water - 0.42) + 0.9 * (water - 0.42) ** 2
    w = water / 4.2
    columns = {"moisture_wet_basis": w / (1.0 + w), "bulk_density_wet": 4200.0 * (1.0 + w) / (1.0 + void)}
    return Data(columns, {"solid_density": 4200.0}, "bulk_density_wet", 0.004)


def _vials() -> Data:
    P = np.array([5.0, 10.0, 15.0, 20.0, 27.0, 35.0, 45.0, 60.0])
    K = 11.0 + 3.0 * P / (1 + 0.03 * P)
    n = np.ones_like(P)
    mass = K * 3.8e-4 * 3600.0 * 25.0 / 2.84e6
    return Data(
        {
            "pressure_chamber": P,
            "mass_sublimed": mass,
            "time": 3600.0 * n,
            "temperature_shelf": 268.15 * n,
            "temperature_product": 243.15 * n,
        },
        {"area_vial": 3.8e-4},
        "mass_sublimed",
    )


def data(key: str) -> Data:
    """Good data of one lab test."""
    name = key.split(".")[1]
    t = np.linspace(0.0, 3600.0, 13)
    T = np.linspace(278.15, 338.15, 10)
    S = np.array([1.3, 1.4, 1.5, 1.7, 1.9, 2.2, 2.6, 3.0])
    R = np.array([5.0, 8.0, 12.0, 20.0, 30.0, 45.0, 60.0]) / 3600.0
    crystal = {"crystal_density": 1500.0, "molar_mass": 0.1}
    p = np.array([0.3, 0.5, 0.8, 1.2, 2.0, 3.0, 4.5, 6.0]) * 1e5
    aw = np.linspace(0.1, 0.9, 11)
    x = np.exp(10.0 - 5000.0 / T)  # mole fraction
    ratio = x / (1 - x) * 0.1 / 0.0180153
    made = {
        "batch_grinding": lambda: Data(
            {"grinding_time": t / 6, "remaining_fraction": 0.98 * np.exp(-0.004 * t / 6)},
            {},
            "remaining_fraction",
        ),
        "grinding_kinetics": _grinding,
        "partition_test": _partition,
        "batch_kinetics": _batch,
        "induction_time": lambda: Data(
            {"supersaturation_ratio": S, "induction_time": 30.0 * np.exp(0.4 / np.log(S) ** 2)},
            {"temperature": 298.15, **crystal},
            "induction_time",
            0.05,
        ),
        "metastable_zone": lambda: Data(
            {"cooling_rate": R, "undercooling": (R / 1e-4) ** (1 / 2.5)}, {}, "undercooling", 0.02
        ),
        "metastable_zone_sangwal": lambda: Data(
            {"cooling_rate": R, "undercooling": 320.0 / np.sqrt(150.0 * (8.0 - np.log(R)))},
            {"temperature_saturation": 320.0, "enthalpy_of_dissolution": 25e3, **crystal},
            "undercooling",
            0.005,
        ),
        "msmpr_analysis": lambda: Data(
            {
                "crystal_size": np.linspace(1e-4, 1e-3, 10),
                "population_density": 1e14 * np.exp(-np.linspace(1e-4, 1e-3, 10) / 1.8e-4),
            },
            {"residence_time": 3600.0},
            "population_density",
            0.05,
        ),
        "solubility_antisolvent": lambda: Data(
            {"antisolvent_fraction": aw, "solute_per_solvent": 0.4 * np.exp(-3 * aw - aw**2)},
            {},
            "solute_per_solvent",
        ),
        "solubility_apelblat": lambda: Data(
            {"temperature": T, "solute_per_solvent": ratio}, {"molar_mass": 0.1}, "solute_per_solvent"
        ),
        "solubility_vant_hoff": lambda: Data(
            {"temperature": T, "solute_per_solvent": ratio}, {"molar_mass": 0.1}, "solute_per_solvent"
        ),
        "solubility_polynomial": lambda: Data(
            {"temperature": T, "solute_per_solvent": 0.1 + 2e-3 * (T - 273.15) + 3e-5 * (T - 273.15) ** 2},
            {},
            "solute_per_solvent",
        ),
        "curve": lambda: Data(
            {
                "time": 8 * t,
                "moisture_dry_basis": np.asarray(
                    moisture_model(
                        {
                            "initial_moisture": 2.0,
                            "rate_per_dry_mass": 1.5e-4,
                            "critical_moisture": 0.8,
                            "equilibrium_moisture": 0.05,
                        },
                        8 * t,
                    )
                ),
            },
            {},
            "moisture_dry_basis",
        ),
        "effective_diffusivity": lambda: Data(
            {"time": 5 * t, "moisture_ratio": np.asarray(plate(1e-10 * 5 * t / 1e-6))},
            {"half_thickness": 1e-3},
            "moisture_ratio",
        ),
        "isotherm": lambda: Data(
            {
                "water_activity": aw,
                "moisture_dry_basis": np.asarray(
                    Gab(monolayer_moisture=0.07, monolayer_constant=12.0, multilayer_constant=0.85).moisture(
                        aw, 298.15
                    )
                ),
            },
            {},
            "moisture_dry_basis",
        ),
        "isotherm_temperatures": _isotherms,
        "product_resistance_test": _product,
        "thin_layer_test": lambda: Data(
            {"time": t, "moisture_ratio": np.exp(-((t / 1000.0) ** 1.2))}, {}, "moisture_ratio"
        ),
        "vial_heat_test": _vials,
        "compressibility": lambda: Data(
            {"pressure_drop": p, "cake_resistance": 2e11 * (p / 1e5) ** 0.6}, {}, "cake_resistance", 0.03
        ),
        "compression_cell": lambda: Data(
            {
                "solids_pressure": p,
                "cake_resistance": 5e10 * (1 + p / 1e5) ** 0.6,
                "void_fraction": 1 - 0.35 * (1 + p / 1e5) ** 0.08,
            },
            {},
            "cake_resistance",
            0.02,
        ),
        "constant_rate_test": lambda: Data(
            {"time": t, "pressure_drop": 1e4 + 60.0 * t}, {**FILTER, "filtrate_flow": 1e-6}, "pressure_drop"
        ),
        "deliquoring_curve": lambda: Data(
            {
                "time": t[1:] / 10,
                "cake_saturation": np.asarray(
                    saturation_after_deliquoring(t[1:] / 10, 1e5, 1e-14, 1e-3, 0.45, 0.02, 0.2)
                ),
            },
            {"pressure_drop": 1e5, "dynamic_viscosity": 1e-3, "void_fraction": 0.45, "cake_thickness": 0.02},
            "cake_saturation",
        ),
        "adsorption_test": lambda: Data(
            {"concentration": t[1:] / 1e5, "adsorbate_loading": 0.03 * (t[1:] / 100.0) ** 0.4},
            {"isotherm_form": "freundlich"},
            "adsorbate_loading",
            0.01,
        ),
        "blocking_test": lambda: Data(
            {"time": t[1:], "filtrate_volume": 2e-7 * 600.0 * np.log1p(t[1:] / 600.0)},
            {"blocking_law": "intermediate"},
            "filtrate_volume",
            0.003,
        ),
        "cake_formation_test": lambda: Data(
            {
                "time": np.repeat([20.0, 60.0, 180.0, 420.0], 3),
                "cake_thickness": np.sqrt(1.5e-3**2 + 4e-7 * np.repeat([20.0, 60.0, 180.0, 420.0], 3))
                - 1.5e-3,
            },
            {},
            "cake_thickness",
            0.003,
        ),
        "capillary_suction_test": lambda: Data(
            {
                "suction_time": 8.0 + 2.4 * np.repeat([0.0, 5.0, 10.0, 20.0], 3),
                "solids_concentration": np.repeat([0.0, 5.0, 10.0, 20.0], 3),
            },
            {},
            "suction_time",
            0.03,
        ),
        "fouling_index_test": lambda: Data(
            {"time": t[1:], "filtrate_volume": _volumes(t[1:])},
            {"area": 0.05, "dynamic_viscosity": 1e-3, "pressure_drop": 2e5},
            "filtrate_volume",
            0.003,
        ),
        "proctor_fagerberg_test": _compacted,
        "expression_test": lambda: Data(
            {
                "time": t,
                "cake_thickness": 0.02 - 0.008 * np.asarray(consolidation_ratio_terzaghi(2e-8 * t / 5e-3**2)),
            },
            {"solid_volume_per_area": 5e-3},
            "cake_thickness",
            0.003,
        ),
        "leaf_test": lambda: Data(
            {"time": t[1:], "filtrate_volume": _volumes(t[1:])},
            {**FILTER, "pressure_drop": DROP},
            "filtrate_volume",
            0.003,
        ),
        "pump_curve": lambda: Data(
            {
                "volume_flow": np.linspace(0, 0.01, 9),
                "pressure_drop": 4e5 * (1 - (np.linspace(0, 0.01, 9) / 0.013) ** 2),
            },
            {},
            "pressure_drop",
        ),
        "slurry_jar": _jars,
        "stepped_pressure_test": lambda: _stepped("stepped"),
        "variable_pressure_test": lambda: _stepped("variable"),
        "washing_curve": lambda: Data(
            {
                "wash_ratio": np.linspace(0.2, 3, 12),
                "wash_effluent_concentration": np.asarray(
                    wash_effluent_concentration(np.linspace(0.2, 3, 12), 8.0)
                ),
            },
            {},
            "wash_effluent_concentration",
        ),
        "pressure_curve": _pressure_curve,
        "image_analysis": _images,
        "laser_diffraction": _laser,
        "particle_counter": _counter,
        "sieve_analysis": _sieves,
        "gas_adsorption": lambda: Data(
            {
                "relative_pressure": np.linspace(0.06, 0.29, 9),
                "adsorbed_volume": 1e-3
                * 100.0
                * np.linspace(0.06, 0.29, 9)
                / ((1.0 - np.linspace(0.06, 0.29, 9)) * (1.0 + 99.0 * np.linspace(0.06, 0.29, 9))),
            },
            {},
            "adsorbed_volume",
            0.005,
        ),
        "mercury_porosimetry": lambda: Data(
            {
                "intrusion_pressure": np.geomspace(1e6, 1e8, 12),
                "intruded_volume": 5e-4
                * norm.cdf(np.log(2e-7 * np.geomspace(1e6, 1e8, 12) / 1.4708) / np.log(1.8)),
            },
            {"solid_density": 2650.0},
            "intruded_volume",
            0.01,
        ),
        "permeametry": lambda: Data(
            {
                "superficial_velocity": np.linspace(0.01, 0.2, 10),
                "pressure_drop": 0.1
                * (1e-3 / 1e-9 * np.linspace(0.01, 0.2, 10) + 1e4 * 1000 * np.linspace(0.01, 0.2, 10) ** 2),
            },
            {"length": 0.1, "dynamic_viscosity": 1e-3, "fluid_density": 1000.0},
            "pressure_drop",
            0.02,
        ),
        "yield_locus": lambda: Data(
            {
                "stress_normal": np.linspace(1e3, 4e3, 9),
                "stress_shear": 600.0 + 0.7 * np.linspace(1e3, 4e3, 9),
            },
            {"preshear_normal": 5e3, "preshear_shear": 3.9e3},
            "stress_shear",
        ),
        "flow_curve_test": lambda: Data(
            {
                "shear_rate": np.geomspace(20.0, 600.0, 9),
                "shear_stress": 8.0 + 0.02 * np.geomspace(20.0, 600.0, 9),
            },
            {},
            "shear_stress",
        ),
        "flow_function": lambda: Data(
            {
                "consolidation_stress": np.linspace(2e3, 1.2e4, 9),
                "unconfined_strength": 400.0 + 0.25 * np.linspace(2e3, 1.2e4, 9),
            },
            {},
            "unconfined_strength",
        ),
        "batch_test": _settling,
        "coe_clevenger_series": lambda: Data(
            {
                "solids_concentration": np.linspace(2, 12, 9),
                "settling_velocity": 2e-3 * np.exp(-0.35 * np.linspace(2, 12, 9)),
            },
            {"underflow_concentration": 15.0},
            "settling_velocity",
            0.03,
        ),
        "compression_test": _compression,
        "flocculent_column": _flocs,
        "jar_test": _coagulant_jars,
        "sludge_index_test": lambda: Data(
            {
                "solids_concentration": np.linspace(0.4, 2.2, 7),
                "settled_fraction": 0.1 * np.linspace(0.4, 2.2, 7),
            },
            {},
            "settled_fraction",
            0.02,
        ),
    }
    return made[name]()


def _partition() -> Data:
    sizes = 20e-6 * 2.0 ** (0.5 * np.arange(12))
    total = np.array([2, 4, 6, 9, 12, 14, 13, 11, 9, 7, 4, 2], dtype=float)
    coarse = 1.0 / (1.0 + (150e-6 / sizes) ** 3.0)
    return Data(
        {"class_sizes": sizes, "coarse_mass": total * coarse, "fine_mass": total * (1 - coarse)},
        {},
        "coarse_mass",
        0.03,
    )


def _jars() -> Data:
    slurry = np.array([0.4, 0.5, 0.55, 0.6, 0.7, 0.8])
    dry = 0.12 * slurry
    volume = dry / 2630.0 / 0.55
    return Data(
        {
            "slurry_mass": slurry,
            "wet_cake_mass": dry + 0.45 * volume * 1000.0,
            "dry_cake_mass": dry,
            "cake_volume": volume,
        },
        {},
        "dry_cake_mass",
    )
