"""Screw press: moment of the screw, limits of the squeezing, cakes and energy of plants."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.integrate import quad

import granum as gr
from granum.core.errors import GranumError


def press(**inputs: object):
    run = gr.alone("filtration.screw_press", **inputs).solve()
    assert run.audit["mass_closure"] < 1e-9
    assert run.audit["energy_closure"] < 1e-9
    return run


def said(run, name: str) -> float:
    return run.figure(f"screw_press.{name}")


def test_torque_is_the_moment_of_the_friction_along_the_barrel() -> None:
    run, D, L = press(), 0.5, 2.5
    moment, _error = quad(lambda z: 0.2 * 1e4 * 10.0 ** (z / L) * np.pi * D * D / 2.0, 0.0, L)
    assert said(run, "screw_torque") == pytest.approx(moment, rel=1e-8)
    assert said(run, "shaft_power") == pytest.approx(moment * 2.0 * np.pi / 60.0, rel=1e-8)


def test_cake_and_energy_of_usual_sludge() -> None:
    """Judd's table for sludgeprocessing.com: 15 to 28 % of solids, 8.5 to 17.5 g/kg of polymer; Huber's for
    belt and screw presses with all that belongs to them: less than 30 kWh a tonne of dry solids.
    """
    run = press()
    assert 0.15 < said(run, "solids_mass_fraction") < 0.28
    assert said(run, "shaft_power") / 1e3 / 0.15 < 30.0
    assert all(check.ok for check in run.units["screw_press"].checks)


def test_the_cake_fills_the_end_of_the_barrel() -> None:
    run = press()
    cake, section = run.streams["screw_press.cake"], np.pi / 4.0 * (0.5**2 - 0.36**2)
    velocity = float(cake.slurry_volume_flow) / section
    assert said(run, "conveying_velocity") == pytest.approx(velocity, rel=1e-8)
    assert said(run, "conveying_share") == pytest.approx(velocity / (0.3 / 60.0), rel=1e-8)


def test_much_time_leads_to_the_equilibrium_under_the_cone() -> None:
    run = press(consolidation_coefficient="1e-4 m2/s", cake_resistance="1e6 m/kg")
    assert float(run.streams["screw_press.cake"].solids_volume_fraction) == pytest.approx(0.2, rel=1e-6)


def test_length_pressure_and_less_sludge_dry_more() -> None:
    less = {"feed.solid_flow": "100 kg/h", "feed.liquid_flow": "2.4 t/h"}
    cases: tuple[dict[str, str], ...] = ({}, {"screw_length": "4 m"}, {"cone_pressure": "3 bar"}, less)
    usual, *drier = (said(press(**c), "solids_mass_fraction") for c in cases)
    assert min(drier) > usual


def test_what_the_press_cannot_do_is_told() -> None:
    """A screw that is too slow for its feed chokes, a feed that filters too slowly leaves as slurry."""

    def failed(**inputs: str) -> set[str]:
        return {check.name for check in press(**inputs).units["screw_press"].checks if not check.ok}

    assert "advance of the cake over the pitch in a turn" in failed(rotation_speed="0.3 rpm")
    assert "filtering time over the stay" in failed(cake_resistance="5e10 m/kg")
    for wrong in ({"shaft_diameter_last": "55 cm"}, {"cone_pressure": "5 kPa"}):
        with pytest.raises(GranumError, match="must be smaller"):
            press(**wrong)
