"""The vacuum crystallizer between its pressure and its temperature."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import granum as gr
from granum.core.errors import CaseError, GranumError
from granum.materials.library import session

LINE = """
title = "salt under vacuum"
[mixture]
liquids = ["water", "{salt}"]
solids = ["{salt}"]
gases = ["water"]
sizes = {{ smallest = "10 um", largest = "4 mm", classes = 24 }}
[feeds.brine]
to = "flash.feed"
temperature = "{hot}"
pressure = "2 bar"
liquid_flow = "3600 kg/h"
liquid = {{ water = {water}, "{salt}" = {solute} }}
[units.flash]
model = "crystallization.vacuum_crystallizer"
{held}
volume = "4 m3"
solubility = {{ law = "library_solubility", solute = "{salt}" }}
growth = {{ law = "power_law_growth", growth_coefficient = 1.161e-4, growth_order = 1.32 }}
nucleation = {{ law = "secondary_nucleation", nucleation_coefficient = 2.196e8, nucleation_order = 1.78 }}
[streams]
suspension = ["flash.product"]
vapor = ["flash.vapor"]
"""


def vessel(tmp_path: Path, held: str, salt="sodium chloride", hot="105 degC", solute=0.27):
    text = LINE.format(held=held, salt=salt, hot=hot, water=1.0 - solute, solute=solute)
    (tmp_path / "line.toml").write_text(text, encoding="utf-8")
    return gr.read(tmp_path / "line.toml")


def figures(line):
    return line.solve().units["flash"].values


def test_saturated_brine_boils_where_tables_say(tmp_path: Path) -> None:
    """At 108.7 °C under one atmosphere (CRC Handbook; recalled, not opened)."""
    made = figures(vessel(tmp_path, 'pressure = "1 atm"\nheat_duty = "400 kW"', hot="100 degC"))
    assert float(made.boiling_temperature) - 273.15 == pytest.approx(108.7, abs=0.4)
    assert float(made.boiling_point_elevation) == pytest.approx(8.7, abs=0.4)


@pytest.mark.parametrize("pressure", [1.5e3, 8e3, 5e4])
def test_there_and_back(tmp_path: Path, pressure: float) -> None:
    """The temperature that a pressure holds asks for this pressure, and all else is the same."""
    there = figures(vessel(tmp_path, f"pressure = {pressure}"))
    T = float(there.boiling_temperature)
    back = figures(vessel(tmp_path, f"temperature = {T!r}"))
    for name in there._fields:
        np.testing.assert_allclose(
            float(getattr(back, name)), float(getattr(there, name)), rtol=1e-7, atol=1e-6, err_msg=name
        )
    assert float(there.pressure) == pytest.approx(pressure)
    # water over saturated brine: its activity is 0.753 at 25 °C (Robinson and Stokes), near that at all
    pure = float(session().fluid("water").vapor_pressure.value(T))
    assert pressure / pure == pytest.approx(0.753, abs=0.012)


def test_the_condenser_and_the_ejector(tmp_path: Path) -> None:
    """Heat of evaporation and some superheat; cooling water at 35 °C condenses 5.6 kPa and more (steam
    tables: 5.629 kPa).
    """
    made = figures(vessel(tmp_path, 'pressure = "1.5 kPa"'))
    latent = float(gr.materials.water_heat_of_vaporization(made.temperature_condensation))
    superheat = 1.88e3 * float(made.boiling_point_elevation)
    assert float(made.condenser_duty) == pytest.approx(
        float(made.evaporation) * (latent + superheat), rel=2e-3
    )
    assert float(made.ejector_pressure_ratio) == pytest.approx(5.629 / 1.5, rel=2e-3)
    assert float(figures(vessel(tmp_path, 'pressure = "8 kPa"')).ejector_pressure_ratio) == 1.0


def test_given_coefficients(tmp_path: Path) -> None:
    """Given coefficients go before the library's water activity of potassium nitrate, which is an estimate:
    about 5 K at 45 °C and 43 % by Raoult's law, less by Pitzer's.
    """
    alone = figures(vessel(tmp_path, 'pressure = "10 kPa"', "potassium nitrate", "85 degC", 0.5))
    assert 2.0 < float(alone.boiling_point_elevation) < 5.0
    held = 'pressure = "10 kPa"\nelevation_linear = "3 delta_degC"\nelevation_quadratic = "5 delta_degC"'
    made = figures(vessel(tmp_path, held, "potassium nitrate", "85 degC", 0.5))
    ratio = float(
        gr.materials.solubility(made.boiling_temperature, "potassium nitrate").solubility_per_solvent
    )
    w = ratio / (1.0 + ratio)
    assert float(made.boiling_point_elevation) == pytest.approx(3.0 * w + 5.0 * w**2, rel=1e-6)


def test_what_keeps_a_vessel_from_boiling_is_named(tmp_path: Path) -> None:
    """A liquor of 20 % at 85 °C dissolves its saltpeter; one of 40 °C is colder than its vessel."""
    crystals = (
        'sizes = {{ law = "log_normal", median_diameter = "300 um", geometric_standard_deviation = 1.4 }}'
    )
    flow = 'liquid_flow = "3600 kg/h"'
    text = LINE.replace(flow, f'{flow}\nsolid_flow = "1 t/h"\n{crystals}')
    for hot, vessel_at, solute, said in (
        ("85 degC", "84 degC", 0.2, "crystals of the feed dissolve"),
        ("40 degC", "45 degC", 0.3, "too cold to boil"),
    ):
        held, salt = f'temperature = "{vessel_at}"', "potassium nitrate"
        case = text.format(held=held, salt=salt, hot=hot, water=1.0 - solute, solute=solute)
        (tmp_path / "line.toml").write_text(case, encoding="utf-8")
        with pytest.raises(GranumError, match=said):
            gr.read(tmp_path / "line.toml").solve()


@pytest.mark.parametrize("held", ["", 'pressure = "10 kPa"\ntemperature = "50 degC"'])
def test_one_of_the_two(tmp_path: Path, held: str) -> None:
    with pytest.raises(CaseError, match="either 'temperature' or 'pressure'"):
        vessel(tmp_path, held).solve()


BESIDE = (
    LINE.replace('["water", "{salt}"]', '["water", "sodium chloride", "potassium chloride"]')
    .replace('"{salt}" = {solute}', '"sodium chloride" = {sodium}, "potassium chloride" = {potassium}')
    .replace('{{ law = "library_solubility", solute = "{salt}" }}', "{law}")
)
LIBRARY = '{ law = "library_solubility", solute = "sodium chloride" }'
EVAPORATOR = 'model = "evaporation.evaporator"\npressure = {}\npressure_steam = "5 bar"\narea = 1e-9\n'


def brine_line(tmp_path: Path, held: str, hot: str, sodium: float, potassium: float, law=LIBRARY, **unit):
    text = BESIDE.format(
        held=held,
        salt="sodium chloride",
        hot=hot,
        water=1.0 - sodium - potassium,
        sodium=sodium,
        potassium=potassium,
        law=law,
    )
    if "evaporator" in unit:
        head, rest = text.split("[units.flash]")
        text = f"{head}[units.flash]\n{unit['evaporator']}[streams]{rest.split('[streams]')[1]}"
    (tmp_path / "line.toml").write_text(text, encoding="utf-8")
    return gr.read(tmp_path / "line.toml")


@pytest.mark.parametrize(
    ("hot", "sodium", "potassium", "pressure"),
    [("105 degC", 0.22, 0.10, 1e4), ("108 degC", 0.20, 0.13, 5e4), ("40 degC", 0.05, 0.05, 3e3)],
)
def test_other_salts_raise_the_boiling_point_at_a_pressure(
    tmp_path: Path, hot: str, sodium: float, potassium: float, pressure: float
) -> None:
    """By as much as in an evaporator without any heating wall, which seeks salts, vapor and temperature
    together by another method.
    """
    made = figures(brine_line(tmp_path, f"pressure = {pressure}", hot, sodium, potassium))
    wall = EVAPORATOR.format(pressure)
    same = figures(brine_line(tmp_path, "", hot, sodium, potassium, evaporator=wall))
    assert float(made.boiling_temperature) == pytest.approx(float(same.boiling_temperature), abs=2e-5)
    alone = figures(brine_line(tmp_path, f"pressure = {pressure}", hot, sodium, 0.0))
    assert float(made.boiling_point_elevation) > float(alone.boiling_point_elevation) + 0.3
    back = figures(
        brine_line(tmp_path, f"temperature = {float(made.boiling_temperature)!r}", hot, sodium, potassium)
    )
    assert float(back.pressure) == pytest.approx(pressure, rel=1e-3)  # the supersaturation lowers it


def test_a_law_of_ones_own_beside_other_salts(tmp_path: Path) -> None:
    """The solubility that the library says there, given as a law, boils at the same temperature."""
    solved = brine_line(tmp_path, "pressure = 1e4", "105 degC", 0.22, 0.10).solve()
    made, product = solved.units["flash"].values, solved.streams["suspension"]
    ratio = float(product.liquid[1] / product.liquid[0]) / (1.0 + float(made.relative_supersaturation))
    law = f'{{ law = "polynomial_solubility", coefficients = [{ratio!r}] }}'
    own = figures(brine_line(tmp_path, "pressure = 1e4", "105 degC", 0.22, 0.10, law))
    assert float(own.boiling_temperature) == pytest.approx(float(made.boiling_temperature), abs=2e-3)


def test_in_time_it_settles_where_the_steady_one_boils(tmp_path: Path) -> None:
    line = brine_line(tmp_path, "pressure = 1e4", "105 degC", 0.22, 0.10)
    there = figures(line)
    text = (tmp_path / "line.toml").read_text(encoding="utf-8")
    moving = text + '[dynamic]\nduration = "20 min"\nstep = "2 min"\nstart = { flash = "steady" }\n'
    (tmp_path / "line.toml").write_text(moving, encoding="utf-8")
    course = gr.read(tmp_path / "line.toml").solve().course
    T = np.asarray(course.streams["suspension"].temperature)
    np.testing.assert_allclose(T, float(there.boiling_temperature), atol=1e-6)
    assert float(course.balance) < 1e-6
