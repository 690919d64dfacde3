"""Cuts of a draft-tube crystallizer from its upflows, and its collisions, as a line asks for them."""

from __future__ import annotations

import numpy as np
import pytest

from granum.cases.alone import alone
from granum.core.errors import GranumError
from granum.crystallization.formulas.upflow import cut_size_upflow

NAME = "classified_crystallizer"


def figures(**said):
    run = alone(f"crystallization.{NAME}", **said).solve()
    assert run.audit["mass_closure"] < 1e-9
    assert run.audit["energy_closure"] < 1e-9
    return run.units[NAME].values


def test_cut_by_hand():
    """Stokes by hand: 50 µm, 1000 kg/m³ heavier than water of 1 mPa·s, 1.362 mm/s; neighbors by ε^4.65 in the
    viscous limit (Richardson and Zaki).
    """
    sphere = {
        "crystal_density": 2000.0,
        "liquid_density": 1000.0,
        "dynamic_viscosity": 1e-3,
        "volume_shape_factor": np.pi / 6,
    }
    free = 9.80665 * 1000.0 * 50e-6**2 / 18e-3
    alone = cut_size_upflow(superficial_velocity=free, void_fraction=0.9999, **sphere)
    assert alone == pytest.approx(50e-6, rel=0.015)
    crowded = cut_size_upflow(superficial_velocity=free * 0.9**4.65, void_fraction=0.9, **sphere)
    assert crowded == pytest.approx(50e-6, rel=0.015)
    faster = [cut_size_upflow(superficial_velocity=v, **sphere) for v in (1e-3, 3e-3, 1e-2, 3e-2)]
    assert faster == sorted(faster)


def test_computed_cuts_are_those_typed():
    leg = {"settling_area": 0.5, "elutriation_flow": "3 m3/h", "leg_diameter": "20 cm"}
    made = figures(**leg)
    typed = figures(fines_cut_size=made.cut_size_baffle, product_cut_size=made.cut_size_leg)
    assert typed.mass_median_size == pytest.approx(made.mass_median_size, rel=1e-9)
    # R - 1 times the flow of the feed, as volume
    assert made.upflow_velocity_baffle == pytest.approx(made.fines_flow / 0.5, rel=1e-12)
    assert made.upflow_velocity_leg == pytest.approx(3 / 3600 / (np.pi / 4 * 0.2**2), rel=1e-12)
    with pytest.raises(GranumError, match="cut of the fines must be below"):
        figures(settling_area=0.05, elutriation_flow="1 m3/h", leg_diameter="20 cm")
