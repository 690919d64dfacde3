"""Words that come from a list are chosen from it: laws, designs, names of the library."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from granum.app.alone_forms import alone_form
from granum.app.case_forms import line_form
from granum.app.closed_lists import word_label
from granum.app.forms import card_form, options, read_entry
from granum.app.wording import told
from granum.core import registry
from granum.core.conversion import convert
from granum.core.errors import InputError
from granum.core.i18n import language
from granum.core.parameters import Parameter

ROOT = Path(__file__).parents[2]
FAMILIES = sorted(
    {p.law for thing in registry.everything().values() for p in thing.card.inputs.values() if p.law}
)


@pytest.mark.parametrize("family", FAMILIES)
def test_every_law_can_be_chosen_and_made_of_what_it_starts_from(family: str) -> None:
    p = Parameter(family, law=family)
    offered = {option["value"]: option for option in options(p)}
    assert set(offered) == {thing.card.name for thing in registry.family(family).values()}
    for name, option in offered.items():
        assert convert(json.loads(option["table"]) if "table" in option else name, p) is not None


@pytest.mark.parametrize("tongue", ["en", "fr"])
def test_no_word_of_a_choice_is_one_of_code(tongue: str) -> None:
    with language(tongue):
        for thing in registry.everything().values():
            for p in thing.card.inputs.values():
                for word in p.choices:
                    assert "_" not in word_label(str(word))
        laws = {p["name"]: p for p in alone_form("cyclones.gas_cyclone", {})["parameters"]}
    designs = laws["cyclone_geometry"]["laws"]["standard_cyclone"]["parameters"]["standard"]["options"]
    shown = {"en": "Stairmand, high efficiency", "fr": "Stairmand, haute efficacité"}[tongue]
    assert {"value": "stairmand_high_efficiency", "label": shown} in designs
    assert len(designs) == 7


def test_names_of_the_library_are_chosen() -> None:
    with language("fr"):
        (system,) = (p for p in card_form("materials.solubility")["parameters"] if p["name"] == "system")
        machine = alone_form("crystallization.antisolvent_crystallizer", {})
        (dust,) = card_form("dust.dust_explosibility")["parameters"]
    assert {"value": "potassium nitrate", "label": "nitrate de potassium"} in system["options"]
    # of a machine only what it is fed with
    assert {o["value"] for p in machine["parameters"] if p["name"] == "solvent" for o in p["options"]} == {
        "sodium chloride",
        "water",
        "ethanol",
    }
    assert {"value": "wheat starch", "label": "amidon de blé"} in dust["options"]


def test_salts_of_a_pair_sieves_and_what_a_wash_dissolves_come_from_lists() -> None:
    pair = alone_form("crystallization.two_salt_crystallizer", {})["parameters"]
    salts = {
        f"{cation} {anion}"
        for cation in ("sodium", "potassium")
        for anion in ("chloride", "sulfate", "nitrate")
    } | {"magnesium chloride", "magnesium sulfate", "calcium chloride"}
    for p in (q for q in pair if q["name"].endswith("_salt")):
        assert {o["value"] for o in p["options"]} == salts
    drum = alone_form("filtration.rotary_vacuum_drum", {})["parameters"]
    (wash,) = (p for p in drum if p.get("law") == "wash_dissolution")
    law = wash["laws"]["saturating_wash"]["parameters"]
    assert [o["value"] for o in law["crystal"]["options"]] == ["calcite"]
    assert {o["value"] for o in law["solvent"]["options"]} == {"water", "sodium chloride"}
    (start,) = wash["options"]
    assert json.loads(start["table"])["crystal"] == "calcite"
    assert json.loads(start["table"])["solvent"] == "water"
    sieve = card_form("particles.aperture")["parameters"][0]
    assert {"value": "200", "label": "ASTM E11"} in sieve["suggested"]


def test_a_unit_of_a_line_chooses_among_the_substances_of_the_line() -> None:
    case = (ROOT / "examples" / "potassium-nitrate" / "line.toml").read_text(encoding="utf-8")
    units = line_form(case)["units"]
    (crystallizer,) = (u for u in units.values() if u["model"].startswith("crystallization."))
    offered = {p["name"]: [o["value"] for o in p["options"]] for p in crystallizer["parameters"]}
    assert offered["solid"] == ["potassium nitrate"]
    assert "water" in offered["solvent"]


def test_a_field_of_a_kind_that_one_card_declares_is_read_as_the_form_says_it() -> None:
    asked = {"number": "12", "unit_typed": "µm/s", "name": "growth_coefficient", "kind": "growth coefficient"}
    asked |= {"unit": "m/s", "lower": 0.0, "open_lower": True, "units": ["um/s", "m/s"]}
    assert read_entry(asked) == {"shown": "12 µm/s", "number": "12", "unit": "um/s"}
    with pytest.raises(InputError):
        read_entry(asked | {"number": "-3"})


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("5 à 10 %", "Porosité = « 5 à 10 % » est un intervalle ; il faut ici un seul nombre."),
        ("abc", "Porosité = « abc » n’est pas un nombre. Écrivez par exemple « 1,5 »."),
        ("40 °", "Porosité : l’unité « ° » ne convient pas. Donnez un nombre sans unité, ou en %."),
    ],
)
def test_what_is_no_share_is_told_in_words(text: str, said: str) -> None:
    from granum.core.kinds import KINDS

    with language("fr"), pytest.raises(InputError) as refused:
        convert(text, Parameter("void_fraction", KINDS["VoidFraction"]))
    with language("fr"):
        assert told(refused.value.as_json())["message"] == said


def test_the_dew_point_has_one_name_in_french() -> None:
    pages = [*ROOT.glob("docs/fr/**/*.md"), *ROOT.glob("src/granum/locale/fr/*.po")]
    assert len(pages) > 50
    assert not [page.name for page in pages if "température de rosée" in page.read_text(encoding="utf-8")]
