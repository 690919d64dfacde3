"""Size × attribute × composition through every unit there is: nothing is lost, made, or moved to another
class of an axis nobody knows.

Two solids, a size and a porosity that go together with size and solid, a liquid of two components, humid air.
"""

from __future__ import annotations

from functools import cache
from typing import Any

import jax.numpy as jnp
import numpy as np
import pytest

from granum.cases.alone import ordinary
from granum.core import registry
from granum.core.packing import compiled
from granum.streams.from_materials import mixture_of
from granum.streams.stream import Stream, empty
from granum.streams.units import Unit

SURFACE = {"law": "kinetics_surface", "critical_moisture": 0.05}
FILTER = {"pressure_drop": "1 bar", "cake_resistance": 1e9, "void_fraction": 0.45, "medium_resistance": 1e9}
BASKET = {"radius_outer": 0.4, "rotation_speed": "1000 rpm", "cake_resistance": 1e8, "void_fraction": 0.45}
BOWL = {"radius_inner": 0.2, "radius_outer": 0.3, "rotation_speed": "3000 rpm"}
GROWTH: dict[str, Any] = {
    "solubility": {"law": "library_solubility", "solute": "potassium nitrate"},
    "growth": {"law": "power_law_growth", "growth_coefficient": 1.16e-4, "growth_order": 1.32},
    "nucleation": {"law": "secondary_nucleation", "nucleation_coefficient": 2.2e8, "nucleation_order": 1.78},
    "solid": "potassium nitrate",
}
COOLING = {
    "law": "power_cooling",
    "temperature_start": "60 degC",
    "temperature_end": "30 degC",
    "duration": "1 hour",
    "cooling_exponent": 1.0,
}
PARTITION = {"law": "rosin_rammler_partition", "cut_size": "300 um", "sharpness": 3.0}
BREAKAGE = {"law": "austin_breakage", "fines_share": 0.5, "fines_exponent": 0.8, "coarse_exponent": 4.0}

SLURRY = {
    "centrifuges.disc_stack": BOWL | {"disc_number": 50},
    "centrifuges.scroll_decanter": BOWL | {"bowl_length": 1.0},
    "centrifuges.solid_basket": BOWL | {"bowl_length": 0.5},
    "centrifuges.tubular_bowl": BOWL | {"bowl_length": 0.7},
    "cyclones.hydrocyclone": {"diameter": "100 mm", "underflow_diameter": "20 mm"},
    "filtration.cartridge_filter": {
        "cartridge_lengths": 100,
        "particle_diameter_rated": "5 um",
        "dirt_capacity": 0.1,
        "pressure_drop_change": "3 bar",
    },
    "filtration.thickening_filter": FILTER | {"area": 50.0, "solids_volume_fraction_thickened": 0.3},
    "filtration.deep_bed_filter": {"area": 2.0, "bed_depth": 1.0, "collector_diameter": "0.8 mm"},
    "fluidization.liquid_fluidized_bed": {
        "area": 0.02,
        "mass": 20.0,
        "particle_diameter": "0.5 mm",
        "particle_density": 2650.0,
    },
    "settling.api_separator": {"length": 10.0, "width": 2.0, "height": 1.0},
    "settling.circular_clarifier": {"diameter": 5.0, "height": 3.0, "underflow_concentration": 300.0},
    "settling.clarifier": {"area": 10.0, "underflow_concentration": 300.0},
    "settling.clarifier_thickener": {
        "area": 20.0,
        "height": 3.0,
        "underflow_volume_flow": 3e-4,
        "settling": {"law": "vesilind", "vesilind_velocity": "5 m/hour", "vesilind_coefficient": 0.02},
        "settling_time": "1 day",
        "cells": 10,
    },
    "settling.secondary_settler": {"area": 20.0, "height": 3.0, "underflow_volume_flow": 3e-4},
    "settling.grit_chamber": {"length": 5.0, "width": 1.0, "height": 1.0},
    "settling.lamella": {
        "plate_number": 10,
        "plate_length": 2.0,
        "plate_width": 1.0,
        "plate_spacing": 0.05,
        "underflow_concentration": 300.0,
    },
    "settling.rectangular_clarifier": {
        "length": 10.0,
        "width": 2.0,
        "height": 2.0,
        "underflow_concentration": 300.0,
    },
    "settling.thickener": {
        "area": 20.0,
        "underflow_concentration": 300.0,
        "settling": {"law": "vesilind", "vesilind_velocity": "5 m/hour", "vesilind_coefficient": 0.02},
    },
    "streams.heater": {"temperature": "80 degC"},
    "streams.splitter": {"side_fraction": 0.3},
    "streams.stirred_tank": {"mass": 100.0},
}
WASHED = {
    "settling.countercurrent_decantation": {
        "stage_count": 3.0,
        "area": 20.0,
        "solids_mass_fraction_underflow": 0.3,
        "settling": {"law": "vesilind", "vesilind_velocity": "5 m/hour", "vesilind_coefficient": 0.02},
    },
    "centrifuges.peeler": BASKET
    | {"cake_radius": 0.32, "basket_height": 0.5, "radius_inner": 0.28, "basket_number": 4.0},
    "centrifuges.pusher": BASKET | {"cake_radius": 0.36, "basket_length": 0.5},
    "centrifuges.scroll_screen": BASKET
    | {"basket_length": 0.5, "scroll_pitch": 0.05, "differential_speed": "20 rpm"},
    "centrifuges.sliding_screen": BASKET | {"basket_length": 0.5, "cone_angle": 0.5, "friction_angle": 0.4},
    "centrifuges.tumbling_screen": BASKET
    | {"basket_length": 0.5, "cone_angle": 0.25, "friction_angle": 0.4, "tumbling_angle": 0.1},
    "centrifuges.vibrating_screen": BASKET
    | {"basket_length": 0.5, "cone_angle": 0.25, "friction_angle": 0.4, "vibration_acceleration": 30.0},
    "filtration.candle_filter": FILTER | {"area": 20.0, "full_cake_thickness": 0.02, "candle_radius": 0.03},
    "filtration.chamber_press": FILTER | {"area": 20.0, "chamber_depth": 0.03},
    "filtration.horizontal_belt_filter": FILTER | {"area": 2.0, "belt_length": 4.0, "belt_speed": 0.05},
    "filtration.gravity_filter": {
        "area": 20.0,
        "slurry_depth": 0.5,
        "cake_resistance": 1e9,
        "void_fraction": 0.45,
        "medium_resistance": 1e9,
    },
    "filtration.membrane_press": FILTER
    | {"area": 20.0, "chamber_depth": 0.03, "void_fraction_squeezed": 0.4},
    "filtration.nutsche": FILTER | {"area": 20.0, "full_cake_thickness": 0.2},
    "filtration.plate_and_frame_press": FILTER | {"area": 20.0, "chamber_depth": 0.03},
    "filtration.precoat_drum": FILTER
    | {
        "area": 10.0,
        "rotation_speed": "1 rpm",
        "precoat_thickness": 0.05,
        "precoat_permeability": 1e-13,
        "knife_advance": 1e-4,
    },
    "filtration.pressure_leaf_filter": FILTER | {"area": 20.0, "full_cake_thickness": 0.03},
    "filtration.rotary_disc_filter": FILTER | {"area": 20.0, "rotation_speed": "1 rpm"},
    "filtration.rotary_vacuum_drum": FILTER | {"area": 10.0, "rotation_speed": "1 rpm"},
    "filtration.tower_press": FILTER
    | {
        "area": 20.0,
        "full_cake_thickness": 0.03,
        "squeezing_pressure": 1.5e6,
        "compaction_exponent": 0.05,
    },
    "filtration.tube_press": FILTER
    | {
        "area": 20.0,
        "full_cake_thickness": 0.01,
        "candle_radius": 0.1,
        "squeezing_pressure": 1e7,
        "compaction_exponent": 0.05,
    },
}
POWDER = {
    "comminution.ball_mill": {
        "selection": {"law": "austin_selection", "selection_rate": 0.01, "selection_exponent": 0.9},
        "breakage": BREAKAGE,
        "holdup_mass": 100.0,
        "shaft_power": 1e3,
    },
    "comminution.bond_mill": {"shaft_power": 1e3, "work_index": "12 kWh/t"},
    "comminution.cone_crusher": {
        "always_passing_size": "100 um",
        "always_broken_size": "1 mm",
        "breakage": BREAKAGE,
    },
    "comminution.double_deck_screen": {
        "upper_deck": PARTITION,
        "lower_deck": PARTITION | {"cut_size": "100 um"},
    },
    "comminution.screen": {"separation": PARTITION, "liquid_split_oversize": 0.4},
    "comminution.triple_deck_screen": {
        "upper_deck": PARTITION | {"cut_size": "600 um"},
        "middle_deck": PARTITION,
        "lower_deck": PARTITION | {"cut_size": "100 um"},
    },
    "comminution.vibrating_screen": {"aperture": "300 um", "screen_area": 1.0},
    "streams.agglomerator": {
        "agglomeration_kernel": {"law": "constant_kernel", "agglomeration_coefficient": 1e-13},
        "holdup_mass": 50.0,
        "volume": 1.0,
    },
    "drying.closed_dryer": {
        "drying_circuit": {"law": "circuit_steam", "temperature_outlet": "105 degC"},
        "temperature_inlet": "150 degC",
        "moisture_outlet": 0.02,
    },
    "drying.drum_dryer": {
        "diameter": 1.0,
        "width": 2.0,
        "rotation_speed": "3 rpm",
        "pressure_steam": "5 bar",
    },
    "drying.paddle_dryer": {
        "wall_temperature": "130 degC",
        "moisture_outlet": 0.02,
        "pressure": "1 atm",
        "particle_diameter": "0.5 mm",
        "rotation_speed": "15 rpm",
        "diameter": 0.6,
    },
}
GAS = {
    "drying.belt_dryer": {
        "area": 10.0,
        "layer_depth": 0.05,
        "bulk_density_dry": 640.0,
        "kinetics": SURFACE,
        "layers": 8,
        "steps": 20,
    },
    "drying.convective_dryer": {"temperature_inlet": "120 degC", "moisture_outlet": 0.02},
    "drying.flash_dryer": {"length": 20.0, "diameter": 0.6, "kinetics": SURFACE},
    "drying.fluidized_bed_dryer": {"area": 2.0, "mass": 300.0, "kinetics": SURFACE},
    "drying.spouted_bed_dryer": {"diameter": 0.5, "inlet_diameter": 0.06, "mass": 60.0, "kinetics": SURFACE},
    "drying.vibrated_bed_dryer": {"length": 4.0, "width": 1.0, "kinetics": SURFACE, "cells": 3},
    "drying.rotary_dryer": {"length": 10.0, "diameter": 1.5, "kinetics": SURFACE, "cells": 10},
    "drying.silo_dryer": {
        "volume": 20.0,
        "layer_depth": 0.3,
        "bulk_density_dry": 640.0,
        "kinetics": SURFACE,
        "layers": 8,
        "steps": 20,
    },
    "drying.tray_dryer": {
        "temperature_inlet": "120 degC",
        "gas_velocity": 2.0,
        "dry_mass_per_area": 30.0,
        "moisture_outlet": 0.05,
        "critical_moisture": 0.1,
    },
    "drying.tunnel_dryer": {
        "residence_time": "2 hour",
        "surface_per_mass": 0.06,
        "free_area": 1.0,
        "volume": 10.0,
        "kinetics": SURFACE,
        "cells": 10,
    },
    "drying.well_mixed_dryer": {"residence_time": "15 min", "gas_velocity": 1.0},
}
LIQUOR = {
    "crystallization.baffled_tube_crystallizer": GROWTH
    | {
        "temperature_program": COOLING,
        "diameter": "80 mm",
        "length": 400.0,
        "oscillation_frequency": "1 Hz",
        "oscillation_amplitude": "50 mm",
        "baffle_spacing": "0.12 m",
        "seed_mass_per_solvent": 0.01,
    },
    "crystallization.slug_flow_crystallizer": GROWTH
    | {
        "temperature_program": COOLING,
        "diameter": "80 mm",
        "length": 400.0,
        "gas_volume_flow": "0.5 m3/h",
        "slug_length": "0.2 m",
        "seed_mass_per_solvent": 0.01,
    },
    "crystallization.batch_crystallizer": GROWTH
    | {"temperature_program": COOLING, "duration": "1 hour", "seed_mass_per_solvent": 0.01},
    "crystallization.classified_crystallizer": GROWTH | {"temperature": "30 degC", "volume": 2.0},
    "crystallization.controlled_batch_crystallizer": GROWTH
    | {
        "supersaturation_kept": "1 %",
        "temperature_end": "30 degC",
        "cooling_rate_maximum": "60 K/h",
        "duration": "1 hour",
        "seed_mass_per_solvent": 0.01,
    },
    "crystallization.jacketed_batch_crystallizer": GROWTH
    | {
        "jacket_program": COOLING,
        "duration": "1 hour",
        "volume": 4.0,
        "area": 10.0,
        "heat_transfer_coefficient": 800.0,
        "seed_mass_per_solvent": 0.01,
    },
    "crystallization.dissolver": {
        "temperature": "60 degC",
        "volume": 2.0,
        "solubility": GROWTH["solubility"],
    },
    "crystallization.msmpr": GROWTH | {"temperature": "30 degC", "volume": 2.0},
    "crystallization.needle_batch_crystallizer": GROWTH
    | {
        "growth_width": GROWTH["growth"] | {"growth_coefficient": 4e-5},
        "temperature_program": COOLING,
        "duration": "1 hour",
        "seed_mass_per_solvent": 0.01,
    },
    "crystallization.needle_crystallizer": GROWTH
    | {
        "growth_width": GROWTH["growth"] | {"growth_coefficient": 4e-5},
        "temperature": "30 degC",
        "volume": 2.0,
    },
    "crystallization.nucleation_controlled_crystallizer": GROWTH
    | {
        "crystal_number_lower": 1e8,
        "crystal_number_upper": 1e10,
        "temperature_end": "30 degC",
        "cooling_rate": "60 K/h",
        "cooling_rate_between": "60 K/h",
        "duration": "1 hour",
        "seed_mass_per_solvent": 0.01,
        "dissolution": {"law": "power_law_dissolution", "dissolution_coefficient": "1 mm/s"},
    },
    "crystallization.oslo_crystallizer": GROWTH
    | {"temperature": "30 degC", "area": 2.0, "height": 1.0, "superficial_velocity": "30 mm/s"},
    "crystallization.plug_flow_crystallizer": GROWTH
    | {"temperature_program": COOLING, "volume": 2.0, "seed_mass_per_solvent": 0.01},
    "crystallization.vacuum_batch_crystallizer": GROWTH
    | {"temperature_program": COOLING, "duration": "1 hour", "seed_mass_per_solvent": 0.01},
    "crystallization.vacuum_crystallizer": GROWTH | {"temperature": "30 degC", "volume": 2.0},
}
OTHERS = {
    "streams.mixer": {},
    "streams.humid_mixer": {},
    "streams.adiabatic_humidifier": {},
    "streams.condenser_cooler": {"temperature": "5 degC"},
    "streams.dehumidifying_coil": {"coil_temperature": "5 degC"},
    "cyclones.gas_cyclone": {"diameter": 0.5},
    "fluidization.fluidized_bed": {"area": 2.0, "mass": 300.0},
    "drying.spray_dryer": {
        "length": 8.0,
        "diameter": 4.0,
        "atomizer": {"law": "atomizer_pressure_nozzle", "pressure_difference": "20 MPa"},
        "kinetics": SURFACE,
        "cells": 20,
    },
    "conveying.pneumatic_conveyor": {"diameter": "250 mm", "length_horizontal": "30 m"},
    "drying.freeze_dryer": {
        "pressure_chamber": "150 mtorr",
        "temperature_shelf": "20 degC",
        "area_vial": "3.8 cm^2",
        "area_product": "3.14 cm^2",
        "volume_fill": "2 mL",
        "vial_coefficient_contact": "2.75e-4 cal/(s*K*cm^2)",
        "vial_coefficient_gas": "8.93e-4 cal/(s*K*cm^2*torr)",
        "vial_coefficient_saturation": "0.46 1/torr",
        "vapor_resistance": "1.4 cm^2*hour*torr/g",
        "vapor_resistance_slope": "16 cm*hour*torr/g",
    },
}
# small, for a feed of one kilogram of liquor a second
BOILING = {"elevation_linear": "5 K", "elevation_quadratic": "20 K"}
EVAPORATORS = {
    "evaporation.evaporator": BOILING
    | {
        "area": 2.0,
        "pressure": "0.5 bar",
        "pressure_steam": "1.5 bar",
        "heat_transfer_coefficient": 2000.0,
    },
    "evaporation.multiple_effect_evaporator": BOILING
    | {
        "area": 1.0,
        "pressure": "0.1 bar",
        "pressure_steam": "3 bar",
        "effect_count": 2,
        "heat_transfer_coefficient_first": 2500.0,
        "heat_transfer_coefficient_last": 1200.0,
    },
    "evaporation.steam_jet_evaporator": BOILING
    | {
        "area": 1.0,
        "pressure": "0.2 bar",
        "pressure_steam": "1.5 bar",
        "pressure_motive": "8 bar",
        "effect_count": 2,
    },
    "evaporation.recompression_evaporator": BOILING
    | {
        "area": 10.0,
        "pressure": "0.3 bar",
        "pressure_steam": "0.8 bar",
        "heat_transfer_coefficient": 2500.0,
    },
}
# of inlets or solutes that these feeds do not have; the random settings of the contracts balance them
ELSEWHERE = {
    "crystallization.antisolvent_batch_crystallizer",
    "crystallization.antisolvent_crystallizer",
    "crystallization.extractive_crystallizer",
    "crystallization.hydroxide_precipitator",
    "crystallization.impurity_uptake",  # needs species in crystals: test_uptake
    "crystallization.desublimer",  # need a solid among the gases: test_sublimation
    "crystallization.polymorph_crystallizer",  # needs two forms: test_polymorph_crystallizer
    "crystallization.precipitator",
    "crystallization.preferential_crystallizer",  # needs two enantiomers: test_enantiomers
    "crystallization.sublimer",
    "crystallization.two_salt_crystallizer",
    "drying.burner",  # needs a fuel among the gases: test_dryer_closed
    "dust.extraction_hood",
    "dust.packed_scrubber",
    "filtration.gas_carbon_bed",  # needs a vapor or an impurity: test_carbon_bed
    "filtration.liquid_carbon_bed",
    "dust.spray_tower",
}
AS_ALONE = (  # with the values with which they open by themselves
    "centrifuges.disc_purifier",
    "centrifuges.disc_separator",
    "centrifuges.nozzle_separator",
    "centrifuges.three_phase_decanter",
    "centrifuges.tubular_separator",
    "conveying.hopper",
    "conveying.slurry_pipeline",
    "conveying.thick_slurry_pipeline",
    "dust.air_filter",
    "dust.bag_filter",
    "dust.electrostatic_precipitator",
    "dust.settling_chamber",
    "dust.venturi_scrubber",
    "drying.grain_bin",
    "drying.impingement_dryer",
    "drying.paper_machine",
    "crystallization.adductive_crystallizer",
    "crystallization.layer_melt_crystallizer",
    "crystallization.suspension_melt_crystallizer",
    "dust.mesh_pad",
    "filtration.belt_press",
    "filtration.reverse_osmosis",
    "filtration.screw_press",
    "filtration.ultrafiltration",
    "settling.dissolved_air_flotation",
    "drying.radiant_dryer",
    "drying.solar_dryer",
    "drying.still_air_dryer",
    "drying.tray_freeze_dryer",
    "drying.vacuum_shelf_dryer",
    "drying.wood_kiln",
    "settling.flocculator",
    "streams.fan",
    "streams.pump",
)
ALL = (
    SLURRY | WASHED | POWDER | GAS | LIQUOR | EVAPORATORS | OTHERS | {key: ordinary(key) for key in AS_ALONE}
)


@cache
def feeds(liquids: tuple[str, ...]) -> dict[str, Stream]:
    """What the units are fed with."""
    mixture = mixture_of(
        liquids,
        ("potassium nitrate", "quartz"),
        ("dry air", "water"),
        np.geomspace(1e-5, 2e-3, 13),
        axes=(("porosity", (0.0, 0.1, 0.3, 0.5)),),
    )
    x = np.linspace(-1.5, 1.5, 12)
    joint = np.stack(
        [
            np.exp(-((x[:, None] - 0.2 * np.arange(3) - s) ** 2)) * np.array([0.5, 0.3, 0.2])
            for s in (0.0, 0.3)
        ]
    )
    solid = jnp.asarray(joint / joint.sum() * 0.2)
    cold, warm, hot = empty(mixture, 298.15), empty(mixture, 330.0), empty(mixture, 400.0)
    saturated, liquor = jnp.array([1.0, 0.3][: len(liquids)]), jnp.array([0.5, 0.55][: len(liquids)])
    return {
        "slurry": cold.replace(solid=solid, liquid=1.5 * saturated),
        "wash": cold.replace(liquid=0.02 * saturated),
        "cake": cold.replace(solid=solid, liquid=0.03 * saturated),
        "air": hot.replace(gas=jnp.array([3.0, 0.03])),
        "liquor": warm.replace(solid=0.1 * solid, liquid=liquor),
        "wet air": warm.replace(gas=jnp.array([1.0, 0.08])),
        "dusty air": warm.replace(solid=0.1 * solid, gas=jnp.array([0.5, 0.01])),
        "water": cold.replace(liquid=0.1 * jnp.eye(len(liquids))[0]),
    }


SPECIAL = {
    "streams.mixer": {"one": "slurry", "two": "dusty air"},
    "streams.humid_mixer": {"one": "wet air", "two": "air"},
    "streams.fan": {"feed": "dusty air"},
    "conveying.pneumatic_conveyor": {"feed": "cake", "gas": "wet air"},
    "streams.pump": {"feed": "slurry"},
    "conveying.hopper": {"feed": "cake"},
    "conveying.slurry_pipeline": {"feed": "slurry"},
    "conveying.thick_slurry_pipeline": {"feed": "slurry"},
    "dust.air_filter": {"feed": "dusty air"},
    "dust.bag_filter": {"feed": "dusty air"},
    "dust.electrostatic_precipitator": {"feed": "dusty air"},
    "dust.settling_chamber": {"feed": "dusty air"},
    "dust.venturi_scrubber": {"feed": "dusty air", "water": "water"},
    "streams.adiabatic_humidifier": {"gas": "air", "water": "water"},
    "streams.condenser_cooler": {"gas": "wet air"},
    "streams.dehumidifying_coil": {"gas": "wet air"},
    "cyclones.gas_cyclone": {"feed": "dusty air"},
    "fluidization.fluidized_bed": {"feed": "dusty air"},
    "drying.spray_dryer": {"feed": "slurry", "gas": "air"},
    "drying.freeze_dryer": {"feed": "slurry"},
    "drying.grain_bin": {"feed": "cake", "gas": "wet air"},
    "drying.solar_dryer": {"feed": "cake", "gas": "wet air"},
    "drying.still_air_dryer": {"feed": "cake", "gas": "wet air"},
    "drying.tray_freeze_dryer": {"feed": "slurry"},
    "drying.vacuum_shelf_dryer": {"feed": "cake"},
    "drying.wood_kiln": {"feed": "cake", "gas": "wet air"},
    "drying.drum_dryer": {"feed": "slurry"},
}


def inlets(key: str, unit: Unit) -> dict[str, Stream]:
    """Streams for the ports of a unit."""
    have = feeds(("water",) if key.startswith("drying") else ("water", "potassium nitrate"))
    main = "slurry" if key in SLURRY or key in WASHED else "liquor" if key in LIQUOR | EVAPORATORS else "cake"
    ports = SPECIAL.get(key) or {"feed": main, "wash": "wash", "gas": "air"}
    return {name: have[ports[name]] for name in unit.inlet_names() or ports if name in ports}


@compiled
def through(unit: Unit, given: dict[str, Stream]) -> Any:
    """Outlets, and what goes in and comes out of mass, energy, and inert solid by axis class."""
    out = unit(**given)
    made = {name: getattr(out, name) for name in unit.outlet_names()}

    def totals(streams: dict[str, Stream]) -> tuple[Any, ...]:
        # quartz neither dissolves nor crystallizes: each class of porosity keeps what it has
        return (
            sum(s.components for s in streams.values()),
            sum(s.enthalpy_flow for s in streams.values()),
            sum(jnp.sum(s.solid[1], axis=0) for s in streams.values()),
            sum(jnp.abs(s.enthalpy_flow) for s in streams.values()),
        )

    powers = sum((getattr(out, name) for name in unit.power_names()), jnp.zeros(()))
    lowest = jnp.stack(
        [jnp.min(jnp.concatenate([jnp.ravel(s.solid), s.liquid, s.gas])) for s in made.values()]
    )
    return totals(given), totals(made), powers, lowest


def test_every_unit_is_here() -> None:
    cards = registry.everything().values()
    units = {c.card.key for c in cards if isinstance(c, type) and issubclass(c, Unit)}
    assert units - ELSEWHERE == set(ALL)


@pytest.mark.parametrize("key", ALL)
def test_nothing_is_lost(key: str) -> None:
    unit = registry.find(key)(**ALL[key])
    entering, leaving, powers, lowest = through(unit, inlets(key, unit))
    assert np.allclose(leaving[0], entering[0], rtol=1e-9, atol=1e-12)
    turnover = entering[3] + leaving[3] + abs(powers)
    assert abs(leaving[1] - entering[1] - powers) / turnover < 1e-9
    assert np.allclose(leaving[2], entering[2], rtol=1e-9, atol=1e-12)
    assert np.all(lowest >= -1e-15)
