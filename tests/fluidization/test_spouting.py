"""Spouted beds against a printed number, and the deepest bed against the laws it is made of."""

from __future__ import annotations

import numpy as np
import pytest

from granum import fluidization as fl

GRAIN = {"particle_diameter": 3e-3, "particle_density": 1300.0, "fluid_density": 1.2}
VESSEL = {"diameter": 0.15, "inlet_diameter": 0.02}


def test_glass_of_two_millimeters_spouts_where_others_found_it() -> None:
    """Beads of 2.18 mm and 2400 kg/m³ in air of 1.18 kg/m³, 0.1 m deep, a vessel eight times as wide as its
    jet: 0.906 m/s in the log of an open study of fuel coaters. The width is that of its grid, 32 cells of
    2.38 mm.
    """
    found = fl.minimum_spouting_velocity_mathur_gishler(
        2.18e-3, 2400.0, 1.18, diameter=0.076, inlet_diameter=0.0095, bed_depth=0.1
    )
    assert found == pytest.approx(0.906, abs=5e-4)


def test_the_deepest_bed_spouts_a_tenth_above_its_fluidization() -> None:
    depth = fl.spoutable_depth_mcnab_bridgwater(**GRAIN, **VESSEL, dynamic_viscosity=1.8e-5)
    spouting = fl.minimum_spouting_velocity_mathur_gishler(**GRAIN, **VESSEL, bed_depth=depth)
    fluid = fl.minimum_fluidization_velocity_wen_yu(**GRAIN, dynamic_viscosity=1.8e-5)
    assert spouting / fluid == pytest.approx(1.11, rel=1e-9)


def test_deeper_beds_and_wider_jets_ask_for_more_gas() -> None:
    depths = np.geomspace(0.02, 0.6, 9)
    found = fl.minimum_spouting_velocity_mathur_gishler(**GRAIN, **VESSEL, bed_depth=depths)
    np.testing.assert_allclose(found / found[0], np.sqrt(depths / depths[0]))
    narrow, wide = (
        fl.minimum_spouting_velocity_mathur_gishler(**GRAIN, diameter=0.15, inlet_diameter=x, bed_depth=0.3)
        for x in (0.02, 0.04)
    )
    assert wide > narrow


def test_a_bed_in_a_cone_is_as_deep_as_others_found_it() -> None:
    """54.5 g of zirconia of 6050 kg/m³ and 57 % of solid in a vessel of 50 mm with a jet of 4 mm and a cone
    of 60°: 32.2 mm in the log of an open study of fuel coaters.
    """
    found = fl.bed_depth_cone_cylinder(0.0545 / 6050.0 / 0.57, diameter=0.05, inlet_diameter=0.004)
    assert found == pytest.approx(0.0322, abs=5e-5)


def test_cone_and_cylinder_meet_and_hold_their_volume() -> None:
    """The volume by slices, below and above the edge of the cone."""
    width, jet, angle = 0.3, 0.04, 0.6
    depths = np.linspace(1e-4, 0.6, 60)
    for deep in (0.05, 0.19, 0.45):
        z = (np.arange(20000) + 0.5) * deep / 20000
        across = np.minimum(jet + 2.0 * z * np.tan(angle), width)
        volume = np.sum(0.25 * np.pi * across**2) * deep / 20000
        found = fl.bed_depth_cone_cylinder(volume, diameter=width, inlet_diameter=jet, cone_angle=angle)
        assert found == pytest.approx(deep, rel=1e-6)
    grown = fl.bed_depth_cone_cylinder(depths**3 / 10.0, diameter=width, inlet_diameter=jet)
    assert (np.diff(grown) > 0.0).all()


def test_an_open_spout_takes_the_gradients_of_a_quarter_sine() -> None:
    """The weight of the bed times the mean of the sine from the inlet to the surface; the start takes more
    than the weight, at most 3.8 times.
    """
    z = (np.arange(20000) + 0.5) / 20000
    weight = (1.0 - 0.42) * (1300.0 - 1.2) * 9.80665 * 0.3
    solid = {"particle_density": 1300.0, "fluid_density": 1.2, "void_fraction": 0.42}
    found = fl.spouting_pressure_drop_lefroy_davidson(bed_depth=0.3, **solid)
    assert found == pytest.approx(weight * np.mean(np.sin(0.5 * np.pi * z)), rel=1e-6)
    starts = fl.starting_pressure_drop_asenjo(
        bed_depth=0.3, diameter=np.array([0.05, 0.15, 0.6, 1e3]), **solid
    )
    assert (np.diff(starts) > 0.0).all()
    assert weight < starts[0]
    assert starts[-1] == pytest.approx(3.8 * weight, rel=1e-3)
