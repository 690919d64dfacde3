"""Energy laws, Rowland's factors, machines and screening against printed worked examples."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest
from scipy.integrate import quad

from granum.comminution.formulas import energy, machines, rowland, screening
from granum.comminution.work_indices import work_index, work_indices
from granum.core.errors import ApplicabilityError, InputError

KWH_T = 3600.0


def test_rittinger_and_kick_of_a_textbook_example() -> None:
    # Coulson & Richardson vol. 2, example 2.1: 13.0 kJ/kg from 50 to 10 mm; 75 to 25 mm needs 4.33
    # (Rittinger) and 8.88 kJ/kg (Kick)
    constant = 13.0e3 / (1 / 0.010 - 1 / 0.050)
    assert energy.specific_energy_rittinger(0.075, 0.025, constant) / 1e3 == pytest.approx(4.33, abs=0.005)
    assert energy.specific_energy_kick(0.075, 0.025, 13.0e3 / np.log(5.0)) / 1e3 == pytest.approx(
        8.88, abs=0.01
    )


def test_bond_of_a_rod_and_a_ball_mill() -> None:
    # Rowland and Kjos: 18 mm to 1.2 mm at 13.2 kWh/t needs 2.83 kWh/t; 1.2 mm to 175 um at 11.7 kWh/t needs
    # 5.46
    assert energy.specific_energy_bond(18e-3, 1.2e-3, 13.2 * KWH_T) / KWH_T == pytest.approx(2.83, abs=0.005)
    assert energy.specific_energy_bond(1.2e-3, 175e-6, 11.7 * KWH_T) / KWH_T == pytest.approx(5.46, abs=0.01)
    # definition: from a very large size to 100 um the energy is the work index
    assert energy.specific_energy_bond(1e9, 1e-4, 5e4) == pytest.approx(5e4, rel=1e-6)


def test_bond_in_the_units_of_another_program_gives_4_millimeters() -> None:
    # 10 kg/s, 50 kW, 21.7 mm, 15.51 kWh/t: by hand (0.0089548 + 0.0067885)^-2 um = 4.03 mm
    assert energy.product_size_bond(21.7e-3, 5e3, 15.51 * KWH_T) == pytest.approx(4.034e-3, rel=1e-3)
    e = energy.specific_energy_bond(
        21.7e-3, energy.product_size_bond(21.7e-3, 5e3, 15.51 * KWH_T), 15.51 * KWH_T
    )
    assert e == pytest.approx(5e3, rel=1e-12)


def test_morrell_worked_example() -> None:
    # Morrell 2009: Mia 19.4 to 750 um from 100 mm with factor 0.95: 9.6 kWh/t; Mib 18.8 from 750 to 106 um:
    # 8.4 kWh/t
    assert 0.95 * energy.specific_energy_morrell(0.1, 750e-6, 19.4 * KWH_T) / KWH_T == pytest.approx(
        9.6, abs=0.05
    )
    assert energy.specific_energy_morrell(750e-6, 106e-6, 18.8 * KWH_T) / KWH_T == pytest.approx(
        8.4, abs=0.05
    )


def test_walker_holds_the_three_laws() -> None:
    f, p, k, x0 = 4e-3, 2e-4, 3e3, 1e-3
    assert energy.specific_energy_walker(f, p, k, 1.0) == pytest.approx(k * np.log(f / p), rel=1e-9)
    assert energy.specific_energy_walker(f, p, k, 2.0) == pytest.approx(k * x0 * (1 / p - 1 / f), rel=1e-12)
    assert energy.specific_energy_walker(f, p, k, 1.5) == pytest.approx(
        2 * k * np.sqrt(x0) * (p**-0.5 - f**-0.5), rel=1e-12
    )
    near = [energy.specific_energy_walker(f, p, k, 1.0 + d) for d in (-1e-7, 0.0, 1e-7)]
    assert near[1] == pytest.approx(0.5 * (near[0] + near[2]), rel=1e-9)


def test_hukki_joins_the_laws_and_adds_up() -> None:
    wi = 5e4
    inside = energy.specific_energy_hukki(2e-2, 1e-4, wi)
    assert inside == pytest.approx(energy.specific_energy_bond(2e-2, 1e-4, wi), rel=1e-12)
    steps = [0.5, 0.1, 5e-2, 1e-2, 5e-5, 1e-5]
    parts = sum(energy.specific_energy_hukki(a, b, wi) for a, b in pairwise(steps))
    assert energy.specific_energy_hukki(0.5, 1e-5, wi) == pytest.approx(parts, rel=1e-12)
    h = 1e-9  # slope continuous at 50 um
    slopes = [
        (
            energy.specific_energy_hukki(1e-2, 5e-5 + s - h, wi)
            - energy.specific_energy_hukki(1e-2, 5e-5 + s + h, wi)
        )
        for s in (-2 * h, 2 * h)
    ]
    assert slopes[0] == pytest.approx(slopes[1], rel=1e-3)


@pytest.mark.parametrize(
    "name",
    ["specific_energy_rittinger", "specific_energy_kick", "specific_energy_bond", "specific_energy_hukki"],
)
def test_a_product_coarser_than_the_feed_has_no_value(name) -> None:
    law = getattr(energy, name)
    with pytest.raises(ApplicabilityError, match=r"product size = 2.* outside what is possible"):
        law(1e-3, 2e-3, 1e4)
    assert np.isfinite(law(1e-3, np.array([2e-3, 5e-4]), 1e4)).tolist() == [False, True]
    with pytest.raises(InputError, match="coarser"):
        energy.energy_law(1e-3, 2e-3)


def test_energy_law_by_size_and_flags_outside_it() -> None:
    assert energy.energy_law(5e-3, 2e-4).energy_law == "rittinger"
    assert energy.energy_law(0.2, 0.01).energy_law == "bond"
    assert energy.energy_law(0.5, 0.06).energy_law == "kick"
    assert energy.specific_energy_rittinger.evaluate(0.075, 0.025, 100.0).notices
    assert not energy.specific_energy_rittinger.evaluate(0.075, 0.5e-3, 100.0).notices


def test_work_index_table_and_units() -> None:
    assert work_index("cement clinker") == pytest.approx(13.49 * 3.6e6 / 907.18474, rel=1e-12)
    # metric, as reprinted elsewhere
    assert work_index("cement clinker") / KWH_T == pytest.approx(14.87, abs=0.005)
    assert work_index(" Quartz ") == work_indices()["quartz"]
    with pytest.raises(InputError, match="limestone"):
        work_index("lime stone")


def test_rowland_factors_as_printed() -> None:
    assert rowland.efficiency_factor_open_circuit(0.5) == pytest.approx(1.035)
    assert rowland.efficiency_factor_open_circuit(0.95) == pytest.approx(1.57)
    # table of EF3: 3.2 m 0.947, 5 m 0.914
    assert rowland.efficiency_factor_diameter(3.20) == pytest.approx(0.947, abs=1e-3)
    assert rowland.efficiency_factor_diameter(5.0) == pytest.approx(0.914, abs=1.5e-3)
    assert rowland.efficiency_factor_oversize(3e-3, 1e-4, 13 * energy.KWH_PER_SHORT_TON) == 1.0
    # by hand at 13 kWh/short ton: Fo 4 mm, Rr 10/0.175, (13 - 7)(10 - 4)/4 = 9
    assert rowland.efficiency_factor_oversize(1e-2, 175e-6, 13 * energy.KWH_PER_SHORT_TON) == pytest.approx(
        1 + 9 * 0.175 / 10, rel=1e-9
    )
    assert rowland.efficiency_factor_fineness(75e-6) == 1.0
    assert rowland.efficiency_factor_fineness(40e-6) == pytest.approx(50.3 / 45.8, rel=1e-9)
    with pytest.raises(ApplicabilityError, match="product size"):
        rowland.efficiency_factor_low_ratio(1e-4, 1e-4)
    assert rowland.efficiency_factor_low_ratio(1e-3, 1e-4) == 1.0
    # best ratio 8 + 5 * 1.5 = 15.5; 15 lies in the band
    assert rowland.efficiency_factor_rod_ratio(18e-3, 1.2e-3, 5.4, 3.6) == 1.0
    design = rowland.mill_power_bond(
        500 / 3.6, 1.2e-3, 175e-6, 11.7 * KWH_T, mill_diameter=5.0, single_stage=False
    )
    assert design.specific_energy_corrected == pytest.approx(design.specific_energy * 0.914, rel=2e-3)
    # EF4 by hand: 13.2 kWh/t are 11.975 per short ton, Fo 16671 um, 1 + 4.975 (18000 - 16671)/16671/15 =
    # 1.0264
    dry_rod_mill = rowland.mill_power_bond(1.0, 18e-3, 1.2e-3, 13.2 * KWH_T, mill="rod", grinding="dry")
    assert dry_rod_mill.efficiency_factor == pytest.approx(1.3 * 1.2 * 1.0264, rel=1e-4)


def test_rolls_and_critical_speed_of_textbook_examples() -> None:
    # Coulson & Richardson examples 2.2 and 2.3: particle radius 25 mm for 1 m rolls; 4.04 rad/s for a 1.2 m
    # mill
    assert machines.feed_size_rolls(1.0, 0.0125, np.radians(31.0)) / 2 == pytest.approx(0.025, abs=5e-4)
    assert machines.rotation_speed_critical(1.2, gravity=9.81) == pytest.approx(4.04, abs=0.005)
    # ring per turn: circumference x width x gap
    assert machines.volume_flow_rolls(1.0, 0.4, 0.0125, 2 * np.pi, 1.0) == pytest.approx(
        np.pi * 0.4 * 0.0125, rel=1e-12
    )


def test_rolls_are_found_from_feed_or_angle() -> None:
    d = machines.feed_size_rolls(0.8, 0.008, 0.5)
    assert machines.nip_angle_rolls(0.8, 0.008, d) == pytest.approx(0.5, rel=1e-9)
    assert machines.roll_diameter_rolls(d, 0.008, 0.5) == pytest.approx(0.8, rel=1e-9)
    assert machines.nip_angle_rolls(0.8, 0.008, 0.007) == 0.0
    with pytest.raises(ApplicabilityError):
        machines.roll_diameter_rolls(0.008, 0.008, 0.5)


def test_filling_of_a_mill_is_the_segment_below_the_surface() -> None:
    h = np.array([0.0, 0.75, 1.5, 2.25, 3.0])
    areas = [
        quad(lambda y: 2 * np.sqrt(1.5**2 - (y - 1.5) ** 2), 0, 3.0 - x)[0] / (np.pi * 1.5**2) for x in h
    ]
    assert np.asarray(machines.mill_filling(3.0, h)) == pytest.approx(areas, abs=1e-8)
    with pytest.raises(ApplicabilityError):
        machines.mill_filling(3.0, 3.1)


def test_screen_effectiveness_of_a_textbook_example() -> None:
    # McCabe, Smith and Harriott, screen of 10 mesh: x_F 0.47, x_D 0.85, x_B 0.195 -> D/F 0.42, effectiveness
    # 0.669
    x = (0.47, 0.85, 0.195)
    assert screening.product_yield(*x) == pytest.approx(0.42, abs=1e-3)
    assert screening.screening_effectiveness(*x) == pytest.approx(0.669, abs=1e-3)
    f, p = 100.0, 100.0 * screening.product_yield(*x)
    assert p * 0.85 + (f - p) * 0.195 == pytest.approx(f * 0.47, rel=1e-12)
    assert screening.screening_effectiveness(0.5, 1.0, 0.0) == pytest.approx(1.0)
    for law, x in (
        (screening.screening_effectiveness, (0.9, 0.85, 0.2)),
        (screening.product_yield, (0.5, 0.5, 0.5)),
    ):
        # richer than both products; no difference
        with pytest.raises(ApplicabilityError, match="desired fraction of the feed"):
            law(*x)
