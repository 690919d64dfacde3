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
