"""Exercises and tutorials that were opened on the web, entered as a stranger enters them: one machine with
its feed, by words. Where a page prints no answer it is worked here by hand from what it states.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from tests.examples.test_units_of_books import solved

FOOT, US_GALLON = 0.3048, 3.785412e-3


def only(size: float, spread: float = 0.01) -> dict[str, Any]:
    """One size class, µm."""
    return {"sizes": {"boundaries": [f"{(1 - spread) * size} um", f"{(1 + spread) * size} um"]}}


ALONE = {"sizes": {"fractions": [1.0]}}


def test_cloth_of_a_bag_house() -> None:
    """scribd.com 243199090, problem 2.4.1: 5 m³/s through bags of 0.1 m by 5 m at 2 m/min ask for 150 m²; 96
    bags.
    """
    run = solved("dust.bag_filter", area=f"{96 * math.pi * 0.1 * 5} m2", feed={"gas_flow": "5 m3/s"})
    assert run.figure("bag_filter.superficial_velocity") == pytest.approx(2 / 60, rel=0.006)


def test_precipitator_by_deutsch() -> None:
    """scribd.com 707777367, ESP 2: 6000 m², 10 000 m³/min, 0.105 m/s; by hand 1 - exp(-3.78)."""
    run = solved(
        "dust.electrostatic_precipitator",
        area="6000 m2",
        section="100 m2",
        migration_velocity_effective="0.105 m/s",
        feed={"gas_flow": "10000 m3/min"},
    )
    assert run.figure("electrostatic_precipitator.removal_efficiency") == pytest.approx(
        1 - math.exp(-3.78), abs=1e-5
    )


@pytest.mark.parametrize(("plates", "velocity"), [(4 / 3, 0.11), (1.0, 0.107), (1.0, 0.103)])
def test_precipitator_in_three_fields(plates: float, velocity: float) -> None:
    """scribd.com 707777367, ESP 1: 47.2 m³/s from 668 to 3.2 grains/m³ in three fields, the first a third
    larger: by hand 2356 m² in all. Each field alone leaves exp(-w A/Q); the three together what is allowed.
    """
    field = 47.2 * math.log(668 / 3.2) / (4 / 3 * 0.11 + 0.107 + 0.103)
    run = solved(
        "dust.electrostatic_precipitator",
        area=f"{plates * field} m2",
        section="40 m2",
        migration_velocity_effective=f"{velocity} m/s",
        feed={"gas_flow": "47.2 m3/s"},
    )
    left = 1 - run.figure("electrostatic_precipitator.removal_efficiency")
    assert left == pytest.approx((3.2 / 668) ** (plates * velocity * field / 47.2 / math.log(668 / 3.2)))
    assert 10 / 3 * field == pytest.approx(2356, rel=0.001)


def test_pressure_drop_of_a_venturi() -> None:
    """ajdesigner.com, venturi scrubber: 120 m/s and 1.3 L/m³ lose 187.2 cm of water by Calvert's rule with
    its factor rounded to 1e-6.
    """
    run = solved(
        "dust.venturi_scrubber",
        throat_area=f"{10 / 120} m2",
        feed={"gas_flow": "10 m3/s"},
        water={"liquid_flow": "46.8 m3/h"},
    )
    assert run.figure("venturi_scrubber.throat_velocity") == pytest.approx(120, rel=1e-4)
    assert run.figure("venturi_scrubber.pressure_drop") == pytest.approx(187.2 * 98.0665, rel=0.02)


def test_lapple_with_the_turns_of_an_exercise() -> None:
    """scribd.com 707777367, cyclone: cement dust in Lapple's design, inlet 0.25 m wide, 5 turns, 50 ft/s,
    0.02 cP, density 2.9: by hand a cut at 5.69 µm and 78 % of what has a size.
    """
    shares = np.array([3, 20, 15, 20, 16, 10, 6, 3]) / 93
    sizes = np.array([1, 5, 10, 20, 30, 40, 50, 60.0])
    cut = 1e6 * math.sqrt(9 * 2e-5 * 0.25 / (2 * math.pi * 5 * 15.24 * 2900))
    by_hand = float(np.sum(shares / (1 + (cut / sizes) ** 2)))
    edges = [edge for size in sizes for edge in (0.98 * size, 1.02 * size)]  # a class at each, none between
    classes = [share for pair in zip(shares, 0.0 * shares, strict=True) for share in pair][:-1]
    run = solved(
        "cyclones.gas_cyclone",
        diameter="1 m",
        parallel_number=1,
        cyclone_geometry={"law": "standard_cyclone", "standard": "lapple"},
        cyclone_efficiency={"law": "cyclone_efficiency_lapple", "turn_number": 5},
        mixture={"solids": "cement dust", "sizes": {"boundaries": [f"{e} um" for e in edges]}},
        feed={
            "gas_flow": f"{15.24 * 0.5 * 0.25} m3/s",
            "temperature": "56 degC",  # 0.02 cP
            "solid_flow": "1 g/h",
            "sizes": {"fractions": classes},
        },
        **{"solid.cement dust.density": "2900 kg/m3", "solid.cement dust.heat_capacity": "0.8 kJ/kg/K"},
    )
    assert run.figure("gas_cyclone.cut_size") == pytest.approx(1e-6 * cut, rel=0.01)
    assert run.figure("gas_cyclone.removal_efficiency") == pytest.approx(by_hand, abs=0.005)
    assert cut == pytest.approx(5.69, abs=0.01)


@pytest.mark.parametrize("loading", [1e-3, 1e-4, 1e-5, 1e-6])
def test_thin_dust_is_not_caught_by_its_thinness(loading: float) -> None:
    """Of ever thinner dust the swirl is left ever more, to all of it: nothing falls out at the inlet."""
    run = solved(
        "cyclones.gas_cyclone",
        parallel_number=1,
        feed={"gas_flow": "1 kg/s", "solid_flow": f"{loading} kg/s"},
    )
    carried = min(1.0, run.figure("gas_cyclone.limit_loading") / loading)
    thicker = solved(
        "cyclones.gas_cyclone",
        parallel_number=1,
        feed={"gas_flow": "1 kg/s", "solid_flow": f"{2 * loading} kg/s"},
    )
    assert carried >= min(1.0, thicker.figure("gas_cyclone.limit_loading") / (2 * loading)) - 1e-9


def test_flocculation_basin_of_a_waterworks() -> None:
    """tutorsglobe.com and tutorbin.com: 60 by 45 by 14 ft for 10 million gallons a day at 50 °F, 930 ft·lb/s
    at the paddles. By hand 40.7 min and, with 2.735e-5 lb·s/ft², 30 per second.
    """
    gradient = math.sqrt(930 / (2.735e-5 * 60 * 45 * 14))
    run = solved(
        "settling.flocculator",
        volume=f"{60 * 45 * 14 * FOOT**3} m3",
        shaft_power=f"{930 * 1.355818} W",
        feed={"liquid_flow": "10e6 gallon/day", "solid_flow": "1 kg/h", "temperature": "50 degF"},
    )
    assert gradient == pytest.approx(30.0, abs=0.05)
    assert run.figure("flocculator.residence_time") / 60 == pytest.approx(40.7, abs=0.1)
    stay = run.figure("flocculator.residence_time")
    assert run.figure("flocculator.camp_number") / stay == pytest.approx(gradient, rel=0.005)


@pytest.mark.parametrize("gradient", [80, 65, 50, 35])
def test_tapered_flocculation(gradient: float) -> None:
    """homeworklib.com 1705309: 12 ML/d, 30 min in four stages at 15 °C (1.139 mPa·s)."""
    run = solved(
        "settling.flocculator",
        volume="62.5 m3",
        velocity_gradient=f"{gradient} 1/s",
        feed={"liquid_flow": "12e6 L/day", "solid_flow": "1 kg/h", "temperature": "15 degC"},
    )
    assert run.figure("flocculator.residence_time") == pytest.approx(450, rel=1e-4)
    assert run.figure("flocculator.shaft_power") == pytest.approx(gradient**2 * 1.139e-3 * 62.5, rel=0.003)


def test_fine_sand_in_an_ideal_basin() -> None:
    """coursehero.com 8439833: of sand of 0.01 mm and density 2.65, 8.7 % stay in 900 m² at 80 000 m³/d."""
    run = solved(
        "settling.clarifier",
        area="900 m2",
        mixture={"solids": "quartz", **only(10)},
        feed={"liquid_flow": "80000 m3/day", "solid_flow": "1 kg/h", "temperature": "20 degC", **ALONE},
    )
    assert run.figure("clarifier.removal_efficiency") == pytest.approx(0.087, abs=0.001)


def test_inclined_tubes_of_the_agua_clara_book() -> None:
    """AguaClara textbook, tube settler (opened as its source): at 3 mm/s along channels of 2.54 cm at 60°, 72
    cm give a capture velocity of 0.2 mm/s.
    """
    run = solved(
        "settling.lamella",
        plate_number=10,
        plate_length="72 cm",
        plate_width="1 m",
        plate_spacing="2.54 cm",
        plate_angle="60 degree",
        feed={"liquid_flow": f"{3e-3 * 10 * 0.0254} m3/s", "solid_flow": "1 g/s"},
    )
    assert run.figure("lamella.overflow_rate") == pytest.approx(0.2e-3, rel=0.005)


def test_yeast_in_a_disc_stack() -> None:
    """assignmentexpert.com 127906: 500 L/h of broth of 1.36 mPa·s with cells of 5 µm, 63 kg/m³ denser, ask
    for a Sigma of 110.11 m² (half of the cells of the cut size are caught). Here the water of 8.8 °C.
    """
    discs = {"radius_inner": "4 cm", "radius_outer": "8 cm", "disc_angle": "40 degree", "sigma_efficiency": 1}
    sigma = 2 * math.pi * 10 * (2 * math.pi * 2800 / 60) ** 2 * (0.08**3 - 0.04**3)
    sigma /= 3 * 9.80665 * math.tan(math.radians(40))
    run = solved(
        "centrifuges.disc_stack",
        **discs,
        disc_number=10 * 110.11 / sigma,
        rotation_speed="2800 rpm",
        mixture={"solids": "yeast", **only(5)},
        feed={"liquid_flow": "500 L/h", "solid_flow": "0.1 kg/h", "temperature": "8.8 degC", **ALONE},
        **{"solid.yeast.density": "1062.8 kg/m3", "solid.yeast.heat_capacity": "3 kJ/kg/K"},
    )
    assert run.figure("disc_stack.sigma_factor") == pytest.approx(110.11, rel=1e-3)
    assert run.figure("disc_stack.cut_size_centrifuge") == pytest.approx(5e-6, rel=0.015)


def test_lime_in_a_pressure_filter() -> None:
    """Anna University, mechanical operations (kopykitab.com), 11 ii: 50 kg of cake per m³ of filtrate, 5 atm,
    30 °C, 6 m³ in an hour; resistances 6.38e10 m/kg and 8.5e10 1/m. By hand 5.13 m².
    """
    a, b = 0.8e-3 * 6.38e10 * 50 / 2, 0.8e-3 * 8.5e10
    per_area = (math.sqrt(b**2 + 4 * a * 3600 * 506625) - b) / (2 * a)
    solid, void = 2711.0, 0.45  # calcite
    in_cake = 300 / solid * void / (1 - void) * 995.65
    run = solved(
        "filtration.pressure_leaf_filter",
        area=f"{6 / per_area} m2",
        pressure_drop="5 atm",
        cake_resistance="6.38e10 m/kg",
        medium_resistance="8.5e10 1/m",
        void_fraction=void,
        full_cake_thickness=f"{50 * per_area / (solid * (1 - void))} m",
        dead_time="0 min",
        mixture={"solids": "calcite", "liquids": "water"},
        feed={
            "liquid_flow": f"{6 * 995.65 + in_cake} kg/h",
            "solid_flow": "300 kg/h",
            "temperature": "30 degC",
        },
    )
    assert 6 / per_area == pytest.approx(5.13, abs=0.01)
    assert run.figure("pressure_leaf_filter.formation_time") == pytest.approx(3600, rel=0.01)
    assert run.figure("pressure_leaf_filter.capacity_use") == pytest.approx(1.0, rel=0.01)


def test_air_of_a_dryer_tutorial() -> None:
    """rithmware.com, ProcesSimO example 2: 2000 kg/h of particles (1.26 kJ/(kg K)) from 3 to 0.2 % of
    moisture and 20 to 50 °C in air of 90 °C and 9 g/kg that leaves at 48 °C: how much air? By hand 4990 kg/h.
    """
    water, left = 60.0, 1940 * 0.002 / 0.998
    gone = water - left
    solids = 1940 * 1.26 * 30 + left * 4.19 * 50 - water * 4.19 * 20
    air = (gone * (2501 + 1.86 * 48) + solids) / ((1.006 + 1.86 * 0.009) * 42)
    assert air == pytest.approx(4990, abs=10)
    run = solved(
        "drying.convective_dryer",
        moisture_outlet=0.002 / 0.998,
        temperature_product="50 degC",
        temperature_inlet="90 degC",
        mixture={"solids": "particles"},
        feed={"solid_flow": "1940 kg/h", "liquid_flow": "60 kg/h", "temperature": "20 degC"},
        gas={
            "gas_flow": f"{air * 1.009} kg/h",
            "relative_humidity": "",
            "gas": {"dry air": 1 / 1.009, "water": 0.009 / 1.009},
            "pressure": "103.2 kPa",
        },
        **{"solid.particles.density": "1500 kg/m3", "solid.particles.heat_capacity": "1.26 kJ/kg/K"},
    )
    assert run.figure("convective_dryer.temperature_outlet") - 273.15 == pytest.approx(48, abs=0.3)
    assert run.figure("convective_dryer.humidity_ratio_outlet") == pytest.approx(
        0.009 + gone / air, rel=0.001
    )


def test_bed_of_grains_under_pressure() -> None:
    """trustedpaperwriters.com: 270 kg of grains of 0.18 mm, sphericity 0.91, 1090 kg/m³, on 0.34 m² at a void
    fraction of 0.51 in air of 2.374 kg/m³: by hand from Ergun's equation, and the weight of the bed.
    """
    d, gap, rho, viscosity = 0.18e-3, 0.51, 2.374, 1.85e-5
    a, b = 1.75 * rho / (gap**3 * 0.91 * d), 150 * (1 - gap) * viscosity / (gap**3 * 0.91**2 * d**2)
    c = (1090 - rho) * 9.80665
    begins = (math.sqrt(b**2 + 4 * a * c) - b) / (2 * a)
    run = solved(
        "fluidization.fluidized_bed",
        area="0.34 m2",
        mass="270 kg",
        void_fraction=gap,
        distributor_ratio=1e-6,
        minimum_fluidization={
            "law": "minimum_fluidization_velocity_ergun",
            "void_fraction": gap,
            "sphericity": 0.91,
        },
        mixture={"solids": "grains", **only(180)},
        feed={"temperature": "25 degC", "pressure": "2.0045 atm", "gas_flow": "300 kg/h", **ALONE},
        **{"solid.grains.density": "1090 kg/m3", "solid.grains.heat_capacity": "1 kJ/kg/K"},
    )
    weight = 270 * 9.80665 * (1 - rho / 1090) / 0.34
    assert run.figure("fluidized_bed.pressure_drop") == pytest.approx(weight, rel=0.005)
    assert run.figure("fluidized_bed.minimum_fluidization_velocity") == pytest.approx(begins, rel=0.02)


def test_column_of_grains_in_water() -> None:
    """expertsmind.com 30134390: 5 kg of 2000 kg/m³ in a tube of 0.1 m lifted by water lose their weight under
    water.
    """
    run = solved(
        "fluidization.liquid_fluidized_bed",
        area=f"{math.pi * 0.05**2} m2",
        mass="5 kg",
        particle_diameter="300 um",
        particle_density="2000 kg/m3",
        feed={"liquid_flow": "40 kg/h", "temperature": "20 degC"},
    )
    weight = 5 * 9.80665 * (1 - 998.2 / 2000) / (math.pi * 0.05**2)
    assert run.figure("liquid_fluidized_bed.pressure_drop") == pytest.approx(weight, rel=0.001)
