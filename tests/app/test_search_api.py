"""The search and the list of cards over the network: kinds, ranking, languages, and as few bytes as
possible.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from importlib.resources import files
from typing import Any

import httpx
import pytest
import tomli

from granum.app.finding import found
from granum.app.reading import as_html
from granum.app.shipped import examples, pages, translations
from granum.core.i18n import LANGUAGES, language
from granum.core.index import entries
from granum.core.search import search, usual
from granum.core.words import tokens


@pytest.fixture(scope="module")
def client(address: str) -> Iterator[Any]:
    with httpx.Client(base_url=address, timeout=240.0) as found:
        yield found


@pytest.mark.parametrize(
    ("asked", "language", "sort", "key"),
    [
        ("vacuum drum", "en", "equipment", "filtration.rotary_vacuum_drum"),
        ("jar test", "en", "lab test", "settling.jar_test"),
        ("humidity chart", "en", "chart", "humid_gas.psychrometric_chart"),
        ("which dryer", "en", "procedure", "drying.choose"),
        ("potassium nitrate hot liquor", "en", "line", "potassium-nitrate/line.toml"),
        ("büchner test to a pressure filter", "en", "exercise", "buchner-to-filter"),
        ("first hour", "en", "page", "guides/first-hour"),
        ("première heure", "fr", "page", "fr/premiere-heure"),
        ("cyclones en série", "fr", "line", "cyclone/pair.toml"),
        ("essai sur büchner", "fr", "exercise", "buchner-to-filter"),
    ],
)
def test_every_kind_is_found(client: Any, asked: str, language: str, sort: str, key: str) -> None:
    hits = client.get("/api/search", params={"q": asked, "lang": language}).json()["hits"]
    assert {"sort": sort, "key": key}.items() <= hits[0].items() or any(
        hit["sort"] == sort and hit["key"] == key for hit in hits[:3]
    ), hits[:3]
    assert all(hit["title"] for hit in hits)


@pytest.mark.parametrize(
    ("code", "asked", "sort", "about"),
    [
        ("fr", "exercice cyclone", "exercise", "cyclone"),
        ("fr", "exercices fluidisation", "exercise", "lit"),
        ("fr", "chapitre filtration", "page", "Filtration"),
        ("fr", "diagramme cyclone", "chart", "yclone"),
        ("fr", "exemple de ligne cristallisation", "line", "ristallisation"),
        ("en", "dryer exercise", "exercise", "dryer"),
        ("en", "chapter drying", "page", "Drying"),
        ("en", "chart settling", "chart", "ettling"),
    ],
)
def test_a_sort_is_asked_for_by_its_name(code: str, asked: str, sort: str, about: str) -> None:
    with language(code):
        first = found(asked, 3)
    assert [hit for hit in first if hit["sort"] == sort and about in hit["title"]], first


def test_a_slip_in_a_name_is_forgiven_where_a_description_has_the_word() -> None:
    assert "porous.permeability_kozeny_carman" in [hit["key"] for hit in found("Karman", 5)]


def test_pages_are_shown_in_the_language_of_the_reader() -> None:
    """By words of both languages, where the page stands in both."""
    for code, asked, key in (
        ("fr", "first hour", "fr/premiere-heure"),
        ("fr", "in a spreadsheet", "fr/dans-un-tableur"),
        ("en", "première heure", "guides/first-hour"),
        ("en", "manuel séchoirs un par un", "handbook/dryers"),
    ):
        with language(code):
            shown = [hit["key"] for hit in found(asked, 40) if hit["sort"] == "page"]
        assert shown[0] == key, shown
        assert not [name for name in shown if translations().get(name) in shown]
    pairs = translations()
    assert all(pairs[pairs[name]] == name for name in pairs)
    assert {name for name in pages() if name.startswith("fr/")} <= set(pairs)
    assert {name for name in pages() if name.startswith(("guides/", "handbook/"))} <= set(pairs)


FRENCH = """
porosité: porous.void_fraction_from_mass · essorage: filtration.deliquoring_curve
u_mf: fluidization.minimum_fluidization_velocity_wen_yu · d32: particles.size_summary
P80: particles.percentile_diameter · SVI: settling.sludge_volume_index
TDH: fluidization.disengaging_height_amitin · Richardson-Zaki: particles.richardson_zaki
gâteau: filtration.cake_thickness · sechage: drying.choose · filtre-presse: filtration.plate_and_frame_press
hydrocyclone: cyclones.hydrocyclone · perte de charge: porous.pressure_gradient_ergun
resistance du gateau: filtration.leaf_test · membrane: filtration.ultrafiltration
vitesse terminale: particles.terminal_velocity · bulbe humide: humid_gas.wet_bulb_temperature
sédimentation: settling.batch_test · décantation: settling.batch_test · épaississeur: settling.thickener
granulométrie: particles.sieve_analysis · tamis: particles.sieve_analysis
floculation: settling.jar_test · essoreuse: centrifuges.peeler
point de rosée: humid_gas.dew_point_temperature
isotherme de sorption: drying.isotherm · eau liée: drying.kinds_of_water
électrofiltre: dust.electrostatic_precipitator · filtre à manches: dust.bag_filter
clairçage: filtration.washing_curve · clarifloculation: settling.jar_test · tartre: evaporation.evaporator
coulabilité: conveying.flow_function · triple effet: evaporation.multiple_effect_evaporator
débourbage: centrifuges.discharge_interval · lyophilisation: drying.freeze_dryer
égouttage: comminution.screen · crible d'égouttage: comminution.screen
taux d'humidité: humid_gas.relative_humidity · hygrométrie: humid_gas.relative_humidity
"""
ENGLISH = """
voidage: porous.void_fraction_from_mass · umf: fluidization.minimum_fluidization_velocity_wen_yu
drying: drying.choose · pressure drop: porous.pressure_gradient_ergun · cake resistance: filtration.leaf_test
membrane: filtration.ultrafiltration · sieve: particles.sieve_analysis · settling: settling.batch_test
flocculation: settling.jar_test · ESP: dust.electrostatic_precipitator
dead-end filtration: filtration.leaf_test
drag coefficient: particles.drag_coefficient_haider_levenspiel · work index: comminution.work_index
Ergun: porous.pressure_gradient_ergun · thickener: settling.thickener
dew point: humid_gas.dew_point_temperature · dewatering screen: comminution.screen
filter press: filtration.plate_and_frame_press · hopper: conveying.mass_flow_beverloo
Reynolds: particles.reynolds_number · MSMPR: crystallization.msmpr · bag filter: dust.bag_filter
baghouse: dust.bag_filter · RRSB: particles.rosin_rammler · u_t: particles.terminal_velocity
MVR: evaporation.recompression_evaporator · shear cell: conveying.yield_locus · Kst: dust.dust_explosibility
fluidisation: fluidization.minimum_fluidization_spread · triple effect: evaporation.multiple_effect_evaporator
"""


@pytest.mark.parametrize(
    ("code", "asked", "key"),
    [
        (code, *pair.strip().rsplit(": ", 1))
        for code, text in (("fr", FRENCH), ("en", ENGLISH))
        for pair in text.replace("\n", " · ").split(" · ")
        if pair.strip()
    ],
)
def test_a_word_of_the_field_finds_what_is_meant_among_the_first_three(
    code: str, asked: str, key: str
) -> None:
    """Words as students and engineers type them: with and without accents, symbols, short forms."""
    with language(code):
        first = [hit["key"] for hit in found(asked, 3)]
    assert key in first, first


def test_titles_are_in_the_language_of_the_page(client: Any) -> None:
    hits = client.get("/api/search?q=filter+press", headers={"x-language": "fr"}).json()["hits"]
    assert "Filtre-presse à plateaux et cadres" in [hit["title"] for hit in hits]


def test_groups_of_laws_have_french_names(client: Any) -> None:
    """A family whose own name is no word of the field has that of what its cards give."""
    cards = client.get("/api/cards?lang=fr").json()["cards"]
    called = {card["family"]: card["family_title"] for card in cards if card["family"]}
    assert called["nucleation_formula"] == "Vitesse de nucléation"
    assert called["hindrance"] != "Hindrance"


@pytest.mark.parametrize("asked", ["", " ", "%", "'; --", "\x00", "a" * 5000, "🦆", "-", "/api"])
def test_whatever_is_typed_is_answered(client: Any, asked: str) -> None:
    assert client.get("/api/search", params={"q": asked}).status_code == 200
    assert client.get("/api/cards", params={"word": asked}).status_code == 200


def test_the_list_is_small_and_not_sent_twice(client: Any) -> None:
    first = client.get("/api/cards", headers={"accept-encoding": "gzip"})
    assert first.headers["content-encoding"] == "gzip"
    assert int(first.headers["content-length"]) < 75 * len(entries())
    assert len(first.json()["cards"]) == len(entries())
    assert "x-language" in first.headers["vary"]
    again = client.get("/api/cards", headers={"if-none-match": first.headers["etag"]})
    assert again.status_code == 304
    assert again.content == b""
    french = client.get("/api/cards?lang=fr", headers={"if-none-match": first.headers["etag"]})
    assert french.status_code == 200
    assert french.headers["etag"] != first.headers["etag"]


def test_other_answers_are_compressed_for_those_who_accept_it(client: Any) -> None:
    place = "/api/cards/particles.terminal_velocity"
    plain = client.get(place, headers={"accept-encoding": "identity"})
    assert "content-encoding" not in plain.headers
    assert client.get(place, headers={"accept-encoding": "gzip"}).json() == plain.json()
    script = client.get("/strings.fr.js", headers={"accept-encoding": "gzip"})
    assert script.headers["content-encoding"] == "gzip"
    assert script.headers["cache-control"] == "no-cache"  # asked about anew: one of each version would not do
    address = re.search(r'src="(files/\w+/app\.js)"', client.get("/").text)
    assert address is not None
    assert "immutable" in client.get(f"/{address[1]}").headers["cache-control"]  # never of another version
    other = client.get("/files/before/app.js")
    assert (other.status_code, other.headers["cache-control"]) == (200, "no-cache")
    assert client.get("/files/before/../../server.py").status_code == 404
    assert client.get("/files/before/%2e%2e/server.py").status_code == 404
    known = client.get("/strings.fr.js", headers={"if-none-match": script.headers["etag"]})
    assert known.status_code == 304


def test_plotly_is_a_third_of_its_size(client: Any) -> None:
    answer = client.get("/vendor/plotly.js", headers={"accept-encoding": "gzip"})
    assert int(answer.headers["content-length"]) < 2_000_000
    assert "max-age" in answer.headers["cache-control"]


@pytest.mark.parametrize("name", pages())
def test_every_page_of_the_documentation_can_be_read(name: str) -> None:
    found = as_html(name)
    assert found["title"]
    assert "<h1>" in found["html"]
    assert "<script" not in found["html"]
    tables = re.findall(r'role="region" aria-label="([^"]+)"', found["html"])
    assert len(set(tables)) == found["html"].count("<table>"), "each may be wide, and is called differently"


def test_there_are_lines_and_pages_to_find() -> None:
    assert len(examples()) > 40
    assert {"guides/first-hour", "handbook/settling", "fr/premiere-heure", "errata"} <= set(pages())


def test_equipment_as_a_form_says_what_it_means_in_words(client: Any) -> None:
    asked = {"area": "12 m2", "feed.solid_flow": "400 kg/h"}
    found = client.post("/api/alone/filtration.rotary_vacuum_drum?lang=fr", json=asked).json()
    assert found["values"]["area"] == "12 m^2"  # as the menu of the field names it
    assert "chlorure de sodium, part" in [
        row["label"] for group in found["groups"] for row in group["parameters"]
    ]
    assert "'feed.solid_flow=400 kg/h'" in found["command"]
    assert "feed={'solid_flow': '400 kg/h'}" in found["python"]
    refused = client.post("/api/alone/filtration.rotary_vacuum_drum", json={"areaa": "1"})
    assert refused.status_code == 422
    assert "area" in refused.json()["error"]["message"]


def test_a_law_has_a_value_on_its_page(client: Any) -> None:
    found = client.post("/api/calc/drying.isotherm_wheat", json={"water_activity": "0.5"})
    assert found.status_code == 200, found.text
    assert 0.05 < found.json()["outputs"]["isotherm"]["value"] < 0.2


def test_everyday_words_mean_the_most_usual_equipment_first() -> None:
    for code, word, first in (
        ("fr", "sécher", "drying.rotary_dryer"),
        ("fr", "décanter", "settling.clarifier"),
        ("en", "decanter", "centrifuges.scroll_decanter"),
        ("en", "mills", "comminution.ball_mill"),
        ("en", "filtrer", "filtration.separator_choice"),  # a word of the other language
    ):
        with language(code):
            assert found(word)[0]["key"] == search(word)[0].key == first
    assert usual("wood kiln") == ()
    rows = tomli.loads((files("granum") / "core" / "usual.toml").read_text(encoding="utf-8"))["meant"]
    assert {key for row in rows for key in row["cards"]} <= set(entries())
    for code in LANGUAGES:
        words = [tokens(word) for row in rows for word in row[code]]
        assert len(words) == len(set(words)), "one meaning a word"
