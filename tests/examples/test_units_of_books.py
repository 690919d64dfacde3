"""Worked examples that were opened, entered as a stranger enters them: one unit with its feed, by words."""

from __future__ import annotations

from typing import Any

import pytest

import granum as gr


def solved(key: str, **words: Any) -> Any:
    run = gr.alone(key, **words).solve()
    audit = run.as_json()["audit"]
    assert audit["mass_closure"] < 1e-9
    assert audit["energy_closure"] < 1e-9
    return run


@pytest.mark.parametrize(
    ("area", "velocity", "removed"),
    [
        ("5000 m2", "5 cm/s", 0.993),  # ajdesigner.com, electrostatic precipitator: 99.3 %
        ("200 m2", "0.1 m/s", 0.3297),  # crackgate.in, question on Deutsch's law: 1 - exp(-0.4)
    ],
)
def test_precipitators_with_a_drift_velocity_as_given(area: str, velocity: str, removed: float) -> None:
    """Both put 50 m³/s through the plates; dust of every size is collected alike."""
    run = solved(
        "dust.electrostatic_precipitator",
        area=area,
        section="50 m2",
        migration_velocity_effective=velocity,
        feed={"gas_flow": "50 m3/s"},
    )
    assert run.figure("electrostatic_precipitator.removal_efficiency") == pytest.approx(removed, rel=4e-4)
    assert run.units["electrostatic_precipitator"].values.size_slowest is None


def test_crusher_of_mccabe() -> None:
    """McCabe, Smith and Harriott, example 29.1 (opened as the Scilab companion): 100 t/h with a work index
    of 12.74, four fifths below 2 in, to four fifths below 1/8 in, takes 169.6 kW.
    """
    run = solved(
        "comminution.bond_mill",
        work_index="12.74 kWh/t",
        shaft_power="169.6 kW",
        feed={
            "solid_flow": "100 t/h",
            "liquid_flow": "0 t/h",
            "sizes": {"law": "rosin_rammler", "size_modulus": "40.04 mm", "distribution_exponent": 2},
        },
        **{"mixture.sizes.largest": "200 mm", "mixture.sizes.classes": 120},
    )
    assert run.figure("bond_mill.feed_size") == pytest.approx(50.8e-3, rel=0.005)
    assert run.figure("bond_mill.product_size") == pytest.approx(3.175e-3, rel=0.005)


def test_single_effect_of_geankoplis() -> None:
    """Geankoplis, example 8.4-1 (opened as the Python companion): 9072 kg/h of 1 % salt at 311 K to 1.5 % at
    1 atm with steam of 143.3 kPa: 149.3 m² boil off 3024 kg/h, without a boiling-point elevation.
    """
    run = solved(
        "evaporation.evaporator",
        area="149.3 m2",
        pressure="101.325 kPa",
        pressure_steam="143.3 kPa",
        heat_transfer_coefficient="1704 W/m2/K",
        elevation_linear=0,
        elevation_quadratic=0,
        feed={"liquid_flow": "9072 kg/h", "temperature": "311 K"},
        **{"feed.liquid.water": "99 %"},
    )
    assert run.figure("evaporator.evaporation_rate") * 3600 == pytest.approx(3024, rel=0.01)
    assert run.figure("evaporator.solute_mass_fraction") == pytest.approx(0.015, rel=0.01)


def test_single_effect_of_coulson_and_richardson() -> None:
    """Coulson and Richardson vol. 2, example 14.1 (opened): 7 kg/s of a tenth of solids at 294 K, 13.5 kPa,
    steam of 205 kPa, 3 kW/(m² K): 14 202 kW over 68.6 m² boil off 5.6 kg/s.
    """
    run = solved(
        "evaporation.evaporator",
        area="68.6 m2",
        pressure="13.5 kPa",
        pressure_steam="205 kPa",
        heat_transfer_coefficient="3 kW/m2/K",
        elevation_linear=0,
        elevation_quadratic=0,
        feed={"liquid_flow": "7 kg/s", "temperature": "294 K"},
        **{"feed.liquid.water": "90 %"},
    )
    assert run.figure("evaporator.heat_duty") == pytest.approx(14.202e6, rel=0.01)
    assert run.figure("evaporator.evaporation_rate") == pytest.approx(5.6, rel=0.01)
    assert run.figure("evaporator.steam_flow") == pytest.approx(6.46, rel=0.01)
