"""What a walk through the whole page found: steps from one page to another that can be taken back, links,
what is copied, sheets of A4, studies looked at before their end.
"""

from __future__ import annotations

import re
from pathlib import Path
from urllib.parse import quote

import httpx
import pytest
from selenium.webdriver.common.action_chains import ActionChains
from tests.app.browsing import MOSTLY_FRENCH, Page, resize
from tests.app.test_builder import carried, case_of, solved, text_of
from tests.app.test_paper import on_paper, printed

from granum.cases import building, wiring

STOKES = "calculate/particles.terminal_velocity_stokes"
SPHERE = {
    "particle_diameter": "85 um",
    "particle_density": "2630 kg/m^3",
    "fluid_density": "1020 kg/m^3",
    "dynamic_viscosity": "1.2 cP",
}
WORDS = {
    "en": {"try": "Try with example data", "use": "Use in the line", "undo": "Undo", "redo": "Redo"},
    "fr": {
        "try": "Essayer avec des données d’exemple",
        "use": "Utiliser dans la ligne",
        "undo": "Annuler",
        "redo": "Rétablir",
    },
}
SHEET_PAGES = re.compile(rb"/Type\s*/Page\b")


def mud(title: str = "Mud") -> str:
    """A suspension on a Nutsche filter."""
    return building.add_unit(building.begin(title, "suspension"), "filtration.nutsche", origin="suspension")


@pytest.mark.parametrize("language", MOSTLY_FRENCH)
def test_what_a_lab_test_gave_is_one_step_that_undo_takes_back(page: Page, language: str) -> None:
    w = WORDS[language]
    page.open(carried(mud()), language)
    solved(page)
    page.visit("lab/filtration.leaf_test")
    page.button(w["try"]).click()
    page.one("[data-use] #use-unit")
    page.settle()
    page.button(w["use"]).click()
    page.one("[data-use] a").click()
    page.until(lambda: "data = '''" in text_of(page))
    solved(page)
    assert set(case_of(page)["fits"])
    page.button(w["undo"]).click()
    page.until(lambda: "fits" not in case_of(page))
    page.button(w["redo"]).click()
    page.until(lambda: "fits" in case_of(page))
    page.check()


def test_a_link_that_takes_the_place_of_another_line_gives_it_back(page: Page) -> None:
    """A colleague's line has the name of one's own: both are there."""
    page.open(carried(mud("Mine")), "en")
    solved(page)
    assert case_of(page)["title"] == "Mine"
    page.browser.get("about:blank")
    page.browser.get(f"{page.address}/?lang=en#/{carried(mud('Theirs'))}")
    page.until(lambda: page.all("#case") and case_of(page)["title"] == "Theirs")
    solved(page)
    page.until(lambda: "Undo brings it back" in " ".join(page.texts("[role=status]")))
    page.button("Undo").click()
    page.until(lambda: case_of(page)["title"] == "Mine")
    page.button("Redo").click()
    page.until(lambda: case_of(page)["title"] == "Theirs")


HEARD = """
    const marked = () => document.activeElement.value ?? String(getSelection());
    addEventListener('copy', () => { window.heard = marked(); });
    navigator.clipboard.writeText = arguments[0]
      ? (text) => { window.heard = text; return Promise.resolve(); }
      : () => Promise.reject(new Error('not here'));
"""


@pytest.mark.parametrize("given", [True, False], ids=["with clipboard", "without"])
def test_the_link_of_a_line_is_copied_and_opens_it_elsewhere(page: Page, given: bool) -> None:
    page.open(carried(mud("Chalk")), "en")
    solved(page)
    page.browser.execute_script(HEARD, given)
    page.button("Copy link").click()
    page.says("[data-copied]", "Copied.")
    heard = page.browser.execute_script("return window.heard")
    assert "case=" in heard
    page.browser.execute_script("localStorage.clear(); sessionStorage.clear()")
    page.browser.get("about:blank")
    page.browser.get(heard)  # as another person opens it
    page.until(lambda: page.all("#case") and case_of(page)["title"] == "Chalk")


def test_a_line_too_long_for_a_link_says_so(page: Page) -> None:
    page.open("lines", "en")
    letters = "".join(chr(0x4E00 + (i * 7919) % 20_000) for i in range(9_000))  # nothing that packs well
    page.browser.execute_script(
        "localStorage.setItem('granum-drafts', JSON.stringify({'computer:long.toml': arguments[0]}))",
        f"# {letters}\n{mud('Long')}",
    )
    page.visit(f"lines/{quote('computer:long.toml', safe='')}")
    solved(page)
    page.button("Copy link").click()
    page.until(lambda: "too long for a link" in " ".join(page.texts("[role=status]")))
    assert not page.text("[data-copied]")


@pytest.mark.parametrize("given", [True, False], ids=["with clipboard", "without"])
def test_a_value_is_copied_with_all_its_digits(page: Page, given: bool) -> None:
    inputs = "&".join(f"{name}={quote(text)}" for name, text in SPHERE.items())
    page.open(f"{STOKES}?{inputs}", "fr")
    page.one("[data-output]")
    page.browser.execute_script(HEARD, given)
    page.one("button.copy").click()
    page.reads("button.copy", "✓")
    number, unit = page.browser.execute_script("return window.heard").split()
    # Stokes by hand
    wanted = 9.80665 * 85e-6**2 * (2630 - 1020) / (18 * 1.2e-3) * 1e3
    assert float(number.replace(",", ".")) == pytest.approx(wanted, rel=1e-9)
    assert unit == "mm/s"


def test_what_was_not_copied_is_not_said_to_be(page: Page) -> None:
    page.open(STOKES, "en")
    page.one("[data-output]")
    page.browser.execute_script(
        HEARD + "document.execCommand = () => { window.tried = true; return false; };"
    )
    page.one("button.copy").click()
    page.until(lambda: page.browser.execute_script("return window.tried"))
    page.settle()
    assert page.text("button.copy") != "✓"


@pytest.mark.parametrize("language", ["en", "fr"])
def test_a_calculation_sheet_is_one_sheet_of_a4_as_wide_as_the_paper(
    page: Page, language: str, tmp_path: Path
) -> None:
    card = "particles.terminal_velocity"
    link = f"{page.address}/?lang={language}#/calculate/{card}?" + "&".join(
        f"{name}={quote(text)}" for name, text in SPHERE.items()
    )
    answer = httpx.post(
        f"{page.address}/api/sheet/{card}",
        json={"inputs": SPHERE, "link": link},
        headers={"x-language": language},
        timeout=240,
    )
    sheet = tmp_path / "sheet.html"
    sheet.write_text(answer.text, encoding="utf-8")
    page.browser.get(sheet.as_uri())
    drawn = "return document.querySelectorAll('.plot-container .main-svg .ytitle').length"
    page.until(lambda: page.browser.execute_script(drawn))
    resize(page, 1400)
    wide = "const e = document.documentElement; return e.scrollWidth <= e.clientWidth"
    assert page.browser.execute_script(wide), "the address is broken where the page ends"
    within, cut = on_paper(
        page,
        f"""
        const wide = () => {{ {wide} }};
        const chart = document.querySelector('.main-svg').getBoundingClientRect();
        const title = document.querySelector('.ytitle').getBoundingClientRect();
        return [wide(), Math.max(chart.top - title.top, title.bottom - chart.bottom)];
        """,
    )
    assert within, "what is wider than the paper makes all of it smaller"
    assert cut <= 0.5, "the title of the axis is whole"
    assert len(SHEET_PAGES.findall(printed(page))) == 1
    assert re.search(r"\d{1,2}\s\w+ 20\d\d" if language == "fr" else r"\w+\s\d{1,2}, 20\d\d", answer.text)


def test_a_study_on_paper_has_units_beside_numbers(page: Page) -> None:
    page.open("studies", "en")
    page.one("[data-part] input")
    page.settle()
    gaps, asked = on_paper(
        page,
        """
        const visible = (e) => e.getBoundingClientRect().height > 0;
        const parts = [...document.querySelectorAll('.part .pairs')].filter(visible);
        return [
          parts.filter((p) => p.querySelector('select')).map((p) =>
            p.querySelector('select').getBoundingClientRect().left - p.querySelector('input').getBoundingClientRect().right),
          [...document.querySelectorAll('[data-cards]')].filter(visible).length,
        ];
        """,  # noqa: E501
    )
    assert gaps
    assert max(gaps) < 12.0
    assert asked == 0, "no field to choose something else"


FOLLOWED = """
    const real = window.fetch;
    const answer = (data) => Promise.resolve(new Response(JSON.stringify(data), {status: 200,
      headers: {'content-type': 'application/json'}}));
    window.ended = false;
    window.fetch = (url, ...more) => {
      const path = new URL(url, location).pathname;
      if (path.endsWith('/part')) return answer(arguments[0]);
      if (/^\\/api\\/studies\\/[^/]+$/.test(path) && !path.endsWith('choices') && !window.ended)
        return answer({state: 'running', share: 0.4, note: '', seconds: 3, part: true});
      return real(url, ...more);
    };
"""


def test_a_study_is_looked_at_while_it_runs(page: Page) -> None:
    """The server says that it is still running, and what it has so far, until the end is let through."""
    study = {
        "card": "particles.terminal_velocity_stokes",
        "inputs": SPHERE,
        "varied": ["particle_diameter"],
        "table": {
            "kind": "sweep",
            "over": {"particle_diameter": {"from": "76.5 um", "to": "93.5 um", "steps": 5}},
        },
    }
    with httpx.Client(base_url=page.address, timeout=240) as client:
        name = client.post("/api/studies", json=study).json()["id"]
        page.until(lambda: client.get(f"/api/studies/{name}").json()["state"] == "done")
        part = client.get(f"/api/studies/{name}").json()["outcome"]
    part |= {"complete": False, "goes_on": True}
    inputs = "&".join(f"{key}={quote(text)}" for key, text in SPHERE.items())
    page.open(f"studies/{quote('card:particles.terminal_velocity_stokes', safe='')}?{inputs}", "en")
    page.one("[data-kind=sweep]")
    page.browser.execute_script(FOLLOWED, part)
    page.button("Run the study").click()
    page.button("Show what there is so far").click()
    page.says("[data-so-far]", "5 cases, each with a result · so far")
    page.one("[data-so-far] .main-svg")
    page.button("Show what there is by now")
    for width, theme in ((1400, "light"), (390, "dark")):
        page.turn(width, theme)
        page.check()
    page.browser.execute_script("window.ended = true")
    page.until(lambda: not page.all("[data-so-far] .main-svg") and page.all("[data-study]"))
    page.says("[data-study]", "21 cases, each with a result")
    assert "so far" not in page.text("[data-study]")


def test_an_open_end_is_dragged_onto_a_machine(page: Page) -> None:
    """Let go over the machine itself, it goes to the inlet that is free."""
    text = building.add_unit(building.begin("Mud", "suspension"), "settling.thickener", origin="suspension")
    page.open(carried(building.add_unit(text, "filtration.nutsche")), "en")
    page.until(lambda: page.all("[data-inlet='filter.feed']"))
    page.settle()
    start = page.one("[data-outlet='thickener.underflow'] .sign")
    page.browser.execute_script("arguments[0].scrollIntoView({block: 'center'})", start)
    machine = page.one("[data-unit=filter] .symbol, [data-unit=filter]")
    ActionChains(page.browser).click_and_hold(start).move_to_element(machine).perform()
    page.until(lambda: page.all("[data-unit=filter].aimed"))
    ActionChains(page.browser).release().perform()
    page.until(lambda: ["thickener.underflow", "filter.feed"] in case_of(page).get("streams", {}).values())
    solved(page)


def test_a_diagram_has_as_few_machines_side_by_side_as_its_names_need(page: Page) -> None:
    """Names much longer than usual: the drawing still fits the frame, or has one machine a row."""
    text, before = building.begin("Long names", "suspension"), "suspension"
    for i in range(4):
        text = building.add_unit(text, "streams.heater", origin=before)
        named = f"heater_of_the_very_long_name_number_{i}_behind_the_others"
        text = wiring.rename(text, "heater", named)
        before = f"{named}.product"
    page.open(carried(text), "en")
    page.one(".diagram svg")
    for width in (1400, 1100, 700):
        resize(page, width)
        page.settle()
        page.until(
            lambda: page.browser.execute_script(
                "const box = document.querySelector('.diagram'), svg = box.querySelector('svg');"
                "return Number(svg.dataset.across) === 1 || Number(svg.dataset.width) <= box.clientWidth"
            )
        )
        across = page.browser.execute_script(
            "return Number(document.querySelector('.diagram svg').dataset.across)"
        )
        assert across < 4, "four such names stand side by side on no screen"


def test_squares_and_cubes_are_printed_as_such(page: Page) -> None:
    """Units as the file has them, those that no menu offers too."""
    text = mud().replace('area = "', 'area = "80 dm2" # "', 1)
    assert "80 dm2" in text
    page.open(carried(text), "fr")
    solved(page)
    page.one("[data-unit=filtre], [data-unit=filter]").click()
    menu = page.one("[data-panel] [id$='-area'] ~ select")
    chosen = "return arguments[0].selectedOptions[0].textContent"
    assert page.browser.execute_script(chosen, menu) == "dm²"
    labels = page.browser.execute_script("return [...arguments[0].options].map((o) => o.textContent)", menu)
    assert "m²" in labels
    assert not [label for label in labels if re.search(r"m\^?[23]", label)]
    told = page.browser.execute_script("return document.querySelector('main').innerText")
    assert not re.search(r"\b[dcmk]?m\^?[23]\b", told)


@pytest.mark.parametrize("language", ["en", "fr"])
def test_the_open_page_is_seen_in_the_row_of_a_phone(page: Page, language: str) -> None:
    """Also where a page comes into the row after it was drawn."""
    page.open("exercises", language, width=390)
    page.until(lambda: page.all("header nav a[href*=select]"))
    page.until(
        lambda: page.browser.execute_script(
            "const box = document.querySelector('header nav [aria-current]').getBoundingClientRect();"
            "return box.left >= 0 && box.right <= innerWidth"
        )
    )
    page.check()


def test_what_a_domain_holds_stands_in_the_order_of_its_titles(page: Page) -> None:
    page.open("home/filtration", "fr")
    page.one("main ul.several li")
    page.settle()
    lists = page.browser.execute_script(
        "return [...document.querySelectorAll('main ul.several')].map((u) => "
        "[...u.querySelectorAll(':scope > li > a')].map((a) => a.textContent))"
    )
    sorted_ones = page.browser.execute_script(
        "return arguments[0].map((l) => [...l].sort((a, b) => a.localeCompare(b, 'fr')))", lists
    )
    assert len(lists) > 3
    assert lists == sorted_ones


@pytest.mark.parametrize("place", ["calculate", "lab", "charts"])
@pytest.mark.parametrize("language", ["en", "fr"])
def test_a_link_to_no_card_says_so_and_leads_to_what_may_be_meant(
    page: Page, place: str, language: str
) -> None:
    page.open(f"{place}/filtration.leaf_tset", language)
    page.says("main [role=alert]", "leaf_tset")
    page.one("main section a[href*='leaf_test']").click()
    page.until(lambda: "lab/filtration.leaf_test" in page.browser.current_url)
    page.one("#table")
    page.check(refused=True)


def test_a_file_of_the_same_name_is_left_alone_until_told_otherwise(page: Page) -> None:
    for title in ("Saved once", "Saved twice"):
        page.open(carried(mud(title)), "en")
        solved(page)
        page.type("[aria-label='File name']", "kept.toml")
        page.button("Save").click()
        if title == "Saved once":
            page.until(lambda: "Saved." in page.texts("[role=status]"))
    page.until(lambda: "another file of this name" in page.text("[role=alert]"))
    at = f"{page.address}/api/workspace/kept.toml"
    assert "Saved once" in httpx.get(at, timeout=60).json()["text"]
    page.button("Overwrite it").click()
    page.until(lambda: not page.all("[role=alert]"))
    page.until(lambda: "Saved twice" in httpx.get(at, timeout=60).json()["text"])


def test_a_search_that_takes_its_time_says_that_it_searches(page: Page) -> None:
    page.open("home", "en")
    page.browser.execute_script(
        """
        const real = window.fetch;
        const held = new Promise((go) => { window.letGo = go; });
        window.asked = [];
        window.fetch = async (url, ...more) => {
          if (String(url).includes('/api/search')) { window.asked.push(String(url)); await held; }
          return real(url, ...more);
        };
        """
    )
    page.one("#seek").click()
    page.until(lambda: page.browser.execute_script("return window.asked.some((url) => url.endsWith('q='))"))
    page.type("#seek", "exercise dryer")
    page.says(".seek .none", "Searching…")
    page.browser.execute_script("window.letGo()")
    page.until(lambda: page.all("#hits [role=option]"))
    assert "Searching" not in page.text(".seek .none")
