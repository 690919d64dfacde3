"""What people state in place of an input."""

import numpy as np
import pytest

from granum.cases.alone import alone, tables
from granum.cases.worded import study_text
from granum.centrifuges import centrifugal_effect
from granum.conveying import deposition_velocity_durand, saltation_velocity_rizk
from granum.core.conversion import law_of
from granum.core.errors import InputError
from granum.cyclones import cyclone_efficiency_lapple
from granum.cyclones.geometry import StandardCyclone
from granum.porous import pressure_drop_packed_bed

BED = {"length": "2 m", "particle_diameter": "5 mm", "void_fraction": 0.4, "dynamic_viscosity": "0.018 cP"}
DUST = {
    "particle_density": 2000,
    "fluid_density": 1.2,
    "dynamic_viscosity": 1.8e-5,
    "particle_diameter": 1e-5,
}


def test_a_mass_flux_stands_for_a_velocity():
    right = pressure_drop_packed_bed(superficial_velocity=1.0, fluid_density=1.2, **BED)
    assert pressure_drop_packed_bed(mass_flux="1.2 kg/m2/s", fluid_density=1.2, **BED) == pytest.approx(right)
    found = pressure_drop_packed_bed.evaluate(mass_flux=1.2, fluid_density=1.2, **BED)
    assert "mass flux" in found.origins["superficial_velocity"]
    with pytest.raises(InputError, match="twice"):
        pressure_drop_packed_bed(superficial_velocity=1.0, mass_flux=1.2, fluid_density=1.2, **BED)
    with pytest.raises(InputError, match="fluid_density"):
        pressure_drop_packed_bed(mass_flux=1.2, **BED)


def test_a_diameter_stands_for_a_radius():
    assert centrifugal_effect(diameter="1 m", rotation_speed="1000 rpm") == centrifugal_effect(
        radius="50 cm", rotation_speed="1000 rpm"
    )
    found = tables("centrifuges.scroll_decanter", {"diameter_outer": "42 cm"})
    (unit,) = found["units"].values()
    assert "radius_outer" not in unit
    assert unit["diameter_outer"] == "42 cm"


def test_a_flow_and_a_pipe_stand_for_a_flux():
    given = {"particle_diameter": "1 mm", "fluid_density": 1.2, "diameter": "78 mm"}
    right = saltation_velocity_rizk(mass_flux=0.25 / (np.pi / 4.0 * 0.078**2), **given)
    assert saltation_velocity_rizk(mass_flow="900 kg/h", **given) == pytest.approx(right)


def test_a_flow_and_a_vessel_stand_for_a_velocity():
    # Geankoplis, example 3.1-4 (recalled): 0.358 kg/s of air through 2.44 m of spheres in 0.61 m, 0.0497 bar
    bed = {"length": "2.44 m", "particle_diameter": "12.7 mm", "void_fraction": 0.38}
    air = {"fluid_density": 1.221, "dynamic_viscosity": 1.9e-5}
    found = pressure_drop_packed_bed(mass_flow="0.358 kg/s", diameter="0.61 m", **bed, **air)
    assert found == pytest.approx(4970.0, rel=2e-3)
    same = pressure_drop_packed_bed(volume_flow=0.358 / 1.221, diameter=0.61, **bed, **air)
    assert same == pytest.approx(found)
    with pytest.raises(InputError, match="'diameter' needs 'volume_flow'"):
        pressure_drop_packed_bed(diameter="0.61 m", **bed, **air)
    with pytest.raises(InputError, match="twice"):
        pressure_drop_packed_bed(superficial_velocity=1.0, volume_flow=0.29, diameter=0.61, **bed, **air)


def test_a_standard_design_stands_for_its_lengths():
    shape = StandardCyclone("lapple")(1.0)._asdict()
    right = cyclone_efficiency_lapple(volume_flow="5000 m3/h", **DUST, **shape)
    found = cyclone_efficiency_lapple(volume_flow="5000 m3/h", **DUST, diameter="1 m", standard="lapple")
    assert found == pytest.approx(right)
    with pytest.raises(InputError, match="stairmand"):
        cyclone_efficiency_lapple(volume_flow=1.0, **DUST, diameter=1.0, standard="mine")


def test_a_specific_gravity_without_a_unit_is_refused():
    with pytest.raises(InputError, match=r"2\.65 g/cm³"):
        deposition_velocity_durand(diameter="12 in", particle_density="2.65", liquid_density="1 g/cm3")


def test_a_bare_number_of_a_case_file_is_refused_as_well():
    """In a file 2.65 is a number and no text."""
    with pytest.raises(InputError, match=r"2\.65 g/cm³"):
        alone("filtration.deep_bed_filter", particle_density=2.65)


def test_a_study_tells_what_it_varies_instead():
    for key, words in (
        ("settling.thickener", {"diameter": "15..20m"}),
        ("particles.terminal_velocity", {"kinematic_viscosity": "0.5..2cSt"}),
    ):
        with pytest.raises(InputError, match="stands in place of"):
            study_text(key, words)


def test_a_name_turned_around_is_the_same_input_and_not_half_of_it():
    """`moisture_critical` had been taken for a diameter, and halved."""
    kinetics = law_of("drying_kinetics", "kinetics_van_meel", "", {"moisture_critical": 0.1})
    assert kinetics.critical_moisture == 0.1
    with pytest.raises(InputError, match="given twice"):
        law_of("drying_kinetics", "kinetics_van_meel", "", {"moisture_critical": 0.1, "critical_moisture": 1})
