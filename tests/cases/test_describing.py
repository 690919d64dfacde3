"""Substances that somebody describes by their constants while a line is built."""

from __future__ import annotations

import random
import tomllib

import pytest

from granum.app.case_forms import line_form
from granum.cases import building as b
from granum.cases import read_text
from granum.cases.describing import describe_substance, described, forget_substance
from granum.core.errors import GranumError, InputError
from granum.core.i18n import language

PVC = {"density": "1.4 g/cm3", "heat_capacity": "0.9 kJ/(kg K)"}
# numbers as of an amino acid in water, rounded: nothing here depends on which
SALT = {
    "molar_mass": "75.07 g/mol",
    "temperature": "0; 25; 50; 75 °C",
    "solubility": "12.4; 20.0; 28.1; 35.2 %",
    "heat_of_solution": "14.2 kJ/mol",
    "crystal_density": "1161 kg/m3",
    "crystal_heat_capacity": "1.32 kJ/(kg K)",
    "like": "sucrose",
}


def pvc_line() -> str:
    own = describe_substance("", "solid", "PVC", PVC, "solids")
    text = b.begin("PVC", "moist_solid", solid="PVC", own=own)
    return b.add_unit(text, "drying.well_mixed_dryer", origin="moist_solid")


def test_a_solid_of_ones_own_is_dried() -> None:
    run = read_text(pvc_line()).solve()
    fed = run.streams["moist_solid"]
    (solid,) = fed.mixture.solids
    assert solid.density[0] == pytest.approx(1400.0)
    assert solid.heat_capacity[0] == pytest.approx(900.0)
    assert run.audit["mass_closure"] < 1e-9


def test_a_solute_of_ones_own_crystallizes_to_its_solubility() -> None:
    own = describe_substance("", "solute", "my salt", SALT, "liquids")
    text = b.begin("Salt", solute="my salt", own=own)
    text = b.add_unit(text, "crystallization.msmpr", origin="solution")
    text = b.add_unit(text, "filtration.horizontal_belt_filter", origin="crystallizer.product")
    run = read_text(text).solve()
    fed, product = run.streams["solution"], run.streams["crystallizer_product"]
    # nearly saturated at 75 °C, where what is stated ends
    assert 0.3 < float(fed.liquid[1] / fed.liquid.sum()) < 0.352
    assert float(product.liquid[1] / product.liquid[0]) > 0.2 / 0.8  # a little above saturation at 25 °C
    assert run.audit["energy_closure"] < 1e-9


def test_what_a_case_describes_is_shown_and_changed() -> None:
    text = pvc_line().replace('density = "1.4 g/cm3"', 'density = { value = 1400.0, source = "pycnometer" }')
    found = {(one["sort"], one["name"]): one["values"] for one in described(tomllib.loads(text))}
    assert found == {("solid", "PVC"): {"density": "1400.0", "heat_capacity": "0.9 kJ/(kg K)"}}
    changed = describe_substance(text, "solid", "PVC", {**PVC, "density": "1350 kg/m3", "sphericity": "0,8"})
    table = tomllib.loads(changed)["solid"]["PVC"]
    assert table["density"] == {"value": 1350.0, "unit": "kg/m3", "source": "pycnometer"}
    assert table["sphericity"] == 0.8
    assert read_text(changed).solve().audit["mass_closure"] < 1e-9
    without = describe_substance(changed, "solid", "PVC", {**PVC, "density": "1350 kg/m3"})
    assert "sphericity" not in tomllib.loads(without)["solid"]["PVC"]


def test_a_description_goes_only_when_nothing_uses_it() -> None:
    text = pvc_line()
    with pytest.raises(InputError, match="take it out"):
        forget_substance(text, "solid", "PVC")
    other = b.choose_substances(text, ["water"], ["quartz"], ["dry air", "water"])
    assert "PVC" not in forget_substance(other, "solid", "PVC").replace('title = "PVC"', "")


def test_forms_call_a_substance_by_the_french_name_of_its_case() -> None:
    text = pvc_line().replace("[solid.PVC]", '[solid.PVC]\nfr = "poudre de PVC"')
    with language("fr"):
        form = line_form(text)
    assert form["labels"]["PVC"] == "poudre de PVC"
    assert [row["label"] for row in form["own"][0]["rows"]][:2] == [
        "masse volumique",
        "capacité thermique massique",
    ]


@pytest.mark.parametrize(
    ("sort", "name", "values", "part", "says"),
    [
        ("solid", " ", PVC, "solids", "name"),
        ("solid", "PVC", {"density": "1.4 g/cm3"}, "solids", "specific heat capacity is missing"),
        ("solid", "PVC", {**PVC, "density": "1.4 m"}, "solids", "does not fit"),
        ("solid", "PVC", {**PVC, "density": "1400 g/cm3"}, "solids", "unit that is meant"),
        ("solid", "quartz", PVC, "solids", "already the name"),
        ("gas", "PVC", PVC, "gases", "no sort of material|Sort of material"),
        ("fluid", "oil", {"molar_mass": "300 g/mol"}, "liquids", "is missing"),
        ("solute", "salt", {**SALT, "temperature": "0; 25 °C"}, "liquids", "three temperatures"),
        ("solute", "salt", {**SALT, "solubility": "12; 20; 28 %"}, "liquids", "three temperatures"),
        ("solute", "salt", {**SALT, "like": "gold"}, "liquids", "gold"),
    ],
)
def test_what_cannot_be_is_refused(
    sort: str, name: str, values: dict[str, str], part: str, says: str
) -> None:
    with pytest.raises(GranumError, match=says) as told:
        describe_substance("", sort, name, values, part)
    assert told.value.message.count("\n") == 0


def test_ordinary_constants_reach_the_line_as_they_were_typed() -> None:
    rng = random.Random(4)
    text = pvc_line()
    for _n in range(100):
        density, heat = rng.uniform(500, 8000), 10 ** rng.uniform(-0.7, 0.6)
        values = {"density": f"{density:.0f} kg/m3", "heat_capacity": f"{heat:.3g} kJ/kg/K".replace(".", ",")}
        line = read_text(describe_substance(text, "solid", "PVC", values))
        (solid,) = next(iter(line.sheet.feeds.values())).mixture.solids
        assert solid.density[0] == pytest.approx(density, abs=0.5)
        assert solid.heat_capacity[0] == pytest.approx(1000.0 * heat, rel=5e-3)
