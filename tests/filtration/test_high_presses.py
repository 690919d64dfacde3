"""Tower and tube presses against moisture by hand, Terzaghi's table and what china clay does."""

from __future__ import annotations

import pytest

import granum as gr
from granum.core.errors import GranumError, InputError


def pressed(key: str, **inputs: object):
    run = gr.alone(f"filtration.{key}", **inputs).solve()
    assert run.audit["mass_closure"] < 1e-9
    assert run.audit["energy_closure"] < 1e-9
    return run


def checks(run: object, key: str) -> dict:
    return {check.name: check for check in run.solution.sheets[key].checks}


def test_china_clay_leaves_the_tube_drier_than_any_low_pressure_filter() -> None:
    """The abstract of the AusIMM (1989) has 30 % of moisture as the best of low pressure; kaolinite of 0.45
    by volume is that, and (100 bar / 10 bar)^0.1 packs it to 0.5665.
    """
    density, water = 2600.0, 998.0
    inputs = {"consolidation_coefficient": "1 m2/s", "void_fraction": 0.54}
    run = pressed("tube_press", **inputs)
    before = run.streams["feed"].solid_density
    assert before == pytest.approx(density, rel=0.05)
    density = float(before)
    wet = 0.54 * water / (0.54 * water + 0.46 * density)
    assert wet == pytest.approx(0.30, abs=0.01)
    solids = 0.46 * 10.0**0.1
    dry_basis = (1.0 - solids) / solids * water / density
    assert run.figure("tube_press.moisture_dry_basis") == pytest.approx(dry_basis, rel=2e-3)
    harder = pressed("tube_press", squeezing_pressure="140 bar", **inputs)
    assert harder.figure("tube_press.moisture_dry_basis") < run.figure("tube_press.moisture_dry_basis")


def test_half_of_the_squeezing_in_terzaghi_s_time() -> None:
    """T = C t/ω₀² = 0.197 is half of the way in every textbook of soil mechanics."""
    solid = 0.010 * 0.45
    time = 0.197 * solid**2 / 1e-7
    half = checks(pressed("tube_press", squeezing_time=time), "tube_press")
    assert half["share of the possible squeezing reached"].value == pytest.approx(0.5, abs=1e-3)
    assert not half["share of the possible squeezing reached"].ok


@pytest.mark.parametrize("key", ["tower_press", "tube_press"])
def test_no_gain_without_more_pressure_or_without_give(key: str) -> None:
    ratio = "void fraction after squeezing over before"
    run = pressed(key, compaction_exponent=0.0)
    assert checks(run, key)[ratio].value == pytest.approx(1.0, rel=1e-12)
    weak = checks(pressed(key, squeezing_pressure="3 bar"), key)
    assert weak[ratio].value == pytest.approx(1.0, rel=1e-12)
    assert not weak["squeezing pressure over filtration pressure"].ok
    assert not weak["squeezing pressure"].ok


def test_each_press_has_its_own_pressures() -> None:
    """16 bar are the end of a tower, 100 or 140 those of the tubes (AusIMM 1989)."""
    for key, bar, ok in (
        ("tower_press", 16.0, True),
        ("tower_press", 20.0, False),
        ("tube_press", 140.0, True),
        ("tube_press", 20.0, False),
    ):
        found = checks(pressed(key, squeezing_pressure=f"{bar} bar"), key)["squeezing pressure"]
        assert bool(found.ok) == ok, (key, bar)
    with pytest.raises(InputError, match="compaction"):
        gr.alone("filtration.tower_press", compaction_exponent=2.0)


def test_an_exponent_without_a_pressure_to_yield_to_is_refused() -> None:
    """It had been ignored, all checks green."""
    with pytest.raises(GranumError, match="squeezing_pressure"):
        gr.alone("filtration.membrane_press", compaction_exponent=0.1)


def test_wash_and_turn_of_a_tower_by_hand() -> None:
    run = pressed("tower_press")
    sheet = run.solution.sheets["tower_press"].figures
    whole = sheet.formation_time + sheet.wash_time + sheet.deliquoring_time + 120.0 + 180.0
    assert sheet.cycle_time == pytest.approx(float(whole), rel=1e-12)
    solid = float(run.streams["feed"].solid_flow)
    assert sheet.area_required == pytest.approx(
        float(solid * sheet.cycle_time / sheet.dry_cake_mass_per_area), rel=1e-12
    )


def test_a_membrane_press_squeezes_harder_than_it_filters() -> None:
    """Solids by volume in proportion to the power of the pressure, by hand; none without, as before."""
    plain, pump = pressed("membrane_press"), 6e5
    wetness = []
    for times in (1.0, 2.0, 3.0):
        run = pressed("membrane_press", squeezing_pressure=times * pump, compaction_exponent=0.1)
        wetness.append(float(run.figure("membrane_press.moisture_dry_basis")))
    assert wetness[0] == pytest.approx(float(plain.figure("membrane_press.moisture_dry_basis")), rel=1e-9)
    # from 45 % of voids: 0.55 · 2^0.1 of solids by volume at twice the pressure
    assert wetness[1] / wetness[0] == pytest.approx((1.0 / (0.55 * 2.0**0.1) - 1.0) / (0.45 / 0.55), rel=1e-9)
    assert wetness[0] > wetness[1] > wetness[2]
    rigid = pressed("membrane_press", squeezing_pressure=3.0 * pump)
    assert float(rigid.figure("membrane_press.moisture_dry_basis")) == pytest.approx(wetness[0], rel=1e-9)


def test_a_membrane_loosens_nothing_and_needs_time_and_pressure() -> None:
    ratio, harder = "void fraction after squeezing over before", "squeezing pressure over filtration pressure"
    loose = pressed("membrane_press", void_fraction=0.5, void_fraction_squeezed=0.6)
    asked = checks(loose, "membrane_press")
    assert asked[ratio].value == pytest.approx(0.6 / 0.5)
    assert not asked[ratio].ok
    plain = pressed("membrane_press", void_fraction=0.5, void_fraction_squeezed=0.45, squeezing_time=0.0)
    moisture = "membrane_press.moisture_dry_basis"
    assert plain.figure(moisture) == pytest.approx(loose.figure(moisture), rel=1e-12)
    weak = pressed("membrane_press", pressure_drop="8 bar", squeezing_pressure="6 bar")
    assert not checks(weak, "membrane_press")[harder].ok
