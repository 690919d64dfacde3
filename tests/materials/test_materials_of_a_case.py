"""Materials that a case names in its own files are its own: other cases, and the same case read again, are
not touched by them.
"""

from __future__ import annotations

from pathlib import Path

import pytest

import granum
from granum import materials
from granum.cases import alone, read_text
from granum.core.errors import InputError
from granum.materials.library import SHIPPED, session

CASE = """
title = "A tank"
[mixture]
liquids = ["brine"]
solids = ["zeolite"]
materials = ["own.toml"]
sizes = { smallest = "10 um", largest = "1 mm", classes = 2 }
[feeds.slurry]
to = "mixer.feed"
solid_flow = "2 kg/s"
liquid_flow = "3 kg/s"
sizes = { fractions = [0.5, 0.5] }
[units.mixer]
model = "streams.mixer"
"""
OWN = """
[solid.zeolite]
density = {{ value = {solid}, source = "own" }}
heat_capacity = {{ value = 900.0, source = "own" }}
molar_mass = 0.1
[fluid.brine]
molar_mass = 0.02
liquid_density = {{ value = {liquid}, source = "own" }}
liquid_heat_capacity = {{ value = 3500.0, source = "own" }}
liquid_viscosity = {{ value = {viscosity}, source = "own" }}
"""
LIGHT = {"solid": 1500.0, "liquid": 1000.0, "viscosity": 1e-3}
HEAVY = {"solid": 3000.0, "liquid": 1250.0, "viscosity": 4e-3}


def case(folder: Path, own: dict[str, float]) -> Path:
    folder.mkdir(exist_ok=True)
    (folder / "own.toml").write_text(OWN.format(**own), encoding="utf-8")
    (folder / "line.toml").write_text(CASE, encoding="utf-8")
    return folder / "line.toml"


def judged(line: granum.Line, own: dict[str, float]) -> None:
    """Volume and viscosity of what leaves, by hand."""
    product = line.solve().streams["mixer.product"]
    assert float(product.slurry_volume_flow) == pytest.approx(
        2.0 / own["solid"] + 3.0 / own["liquid"], rel=1e-12
    )
    assert float(product.liquid_viscosity) == pytest.approx(own["viscosity"], rel=1e-12)


@pytest.mark.parametrize("order", [(LIGHT, HEAVY), (HEAVY, LIGHT)])
def test_two_cases_with_one_name(tmp_path: Path, order: tuple[dict[str, float], ...]) -> None:
    lines = [granum.read(case(tmp_path / str(i), own)) for i, own in enumerate(order)]
    for line, own in zip(lines, order, strict=True):
        judged(line, own)
    assert "zeolite" not in materials.names("solid")


def test_a_file_edited_between_two_reads(tmp_path: Path) -> None:
    for own in (LIGHT, HEAVY):
        judged(granum.read(case(tmp_path, own)), own)


def test_the_name_of_a_shipped_material_is_taken(tmp_path: Path) -> None:
    path = tmp_path / "own.toml"
    path.write_text('[solid.quartz]\ndensity = { value = 1.0, source = "own" }\n', encoding="utf-8")
    with pytest.raises(InputError, match="already the name"):
        SHIPPED.with_own([path])


DESCRIBED = """
[solid.zeolite]
density = "1500 kg/m3"
heat_capacity = "0.9 kJ/(kg K)"
molar_mass = "100 g/mol"
[fluid.brine]
molar_mass = 0.02
liquid_density = "1 g/cm3"
liquid_heat_capacity = 3500
liquid_viscosity = "1 cP"
"""


def test_a_case_describes_its_own_materials() -> None:
    """Without a second file, as text with units or numbers in SI."""
    text = CASE.replace('materials = ["own.toml"]\n', "") + DESCRIBED
    line = read_text(text)
    judged(line, LIGHT)
    assert float(line.sheet.feeds["slurry"].mixture.solids[0].molar_mass) == pytest.approx(0.1)
    assert "zeolite" not in materials.names("solid")


def test_words_describe_the_material_of_a_machine() -> None:
    own = {
        "mixture.solids": "PVC",
        "solid.PVC.density": "1.4 g/cm3",
        "solid.PVC.heat_capacity": "0.9 kJ/(kg K)",
    }
    line = alone("drying.rotary_dryer", **own)
    (solid,) = line.sheet.feeds["feed"].mixture.solids
    assert (solid.name, float(solid.density[0])) == ("PVC", pytest.approx(1400.0))
    assert line.solve().audit["mass_closure"] < 1e-9


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (('"1500 kg/m3"', '"1.5"'), "zeolite: density = 1.5 kg/m³ is outside 10 kg/m³"),
        (('"1500 kg/m3"', '"dense"'), "write a constant as a number with its unit"),
        (('"1500 kg/m3"', '"1500 bar"'), "Unit 'bar' does not fit zeolite: density"),
        (
            ("density =", "densty ="),
            "Key 'densty' is not known in [solid.zeolite] (case). Did you mean 'density'",
        ),
        (('heat_capacity = "0.9 kJ/(kg K)"', ""), "no value for zeolite: heat capacity"),
        (("[solid.zeolite]", "[solid.quartz]"), "'quartz' is already the name of a solid"),
        (("[solid.zeolite]", "[solid.zeolith]"), "Did you mean 'zeolith'"),
        (("[solid.zeolite]", "[solid.PVC]"), 'by `[solid.zeolite]` with `density = "1400 kg/m3"`'),
    ],
)
def test_what_is_wrong_with_a_described_material_is_told(change: tuple[str, str], message: str) -> None:
    text = CASE.replace('materials = ["own.toml"]\n', "") + DESCRIBED.replace(*change, 1)
    with pytest.raises(InputError) as told:
        read_text(text)
    assert message in told.value.message


def test_a_further_name_of_the_library_may_be_ones_own() -> None:
    """Sand is another word for quartz until a case describes its own."""
    assert session().solid("sand").name == "quartz"
    tables = {"solid": {"sand": {"density": "2600 kg/m3", "heat_capacity": "0.8 kJ/(kg K)"}}}
    mine = session().with_own([tables])
    assert mine.solid("sand").name == "sand"
    assert float(mine.solid("sand").density(300.0)) == pytest.approx(2600.0)
    assert mine.solid("silica").name == "quartz"
    with pytest.raises(InputError, match="already the name"):
        session().with_own([{"solid": {"quartz": tables["solid"]["sand"]}}]).solid("quartz")
