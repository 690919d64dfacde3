"""Phones, wide screens, paper and screen readers: nothing is cut, the result stays in sight, and what is
printed says where it comes from.
"""

from __future__ import annotations

import base64
import re
from pathlib import Path
from typing import Any
from urllib.parse import quote

import pytest
from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.keys import Keys
from tests.app.browsing import Page, resize

from granum.cases import read

SPHERE = "particle_diameter=85+um&particle_density=2630+kg%2Fm%5E3&fluid_density=1020+kg%2Fm%5E3&dynamic_viscosity=1.2+cP"  # noqa: E501
STOKES = f"calculate/particles.terminal_velocity_stokes?{SPHERE}"
WIDTHS = (390, 1100, 1440, 1920)
PAGES = (
    STOKES,
    "lab/filtration.leaf_test",
    f"lines/{quote('examples:grinding-circuit/circuit.toml', safe='')}",
    "charts/humid_gas.psychrometric_chart?temperature=20+60+35+degC&humidity_ratio=8+8+18+g%2Fkg",
    f"studies/{quote('card:particles.terminal_velocity_stokes', safe='')}?{SPHERE}",
    "select/filtration.separator_choice",
    "exercises/grain-dryer",
    "exercises/quizzes",
)
CARDS = (
    "particles.size_summary",
    "particles.terminal_velocity",
    "particles.drag_coefficient_haider_levenspiel",
    "porous.pressure_gradient_ergun",
    "comminution.screening_effectiveness",
    "settling.settling_velocity_kynch",
    "cyclones.cut_size_turns",
    "centrifuges.sigma_factor_disc",
    "filtration.filtrate_volume_constant_pressure",
    "fluidization.fluidization_regime",
    "fluidization.pressure_velocity",
    "crystallization.batch",
    "crystallization.crystallizer_balance",
    "humid_gas.state",
    "humid_gas.mixing",
    "drying.dryer_balance",
    "drying.drying_time",
    "drying.choose",
    "drying.heat_duty_radiation",
    "materials.liquid_properties",
)
CUT = """
    const seen = [];
    for (const section of document.querySelectorAll('main section')) {
      const edge = section.getBoundingClientRect().right + 1;
      for (const e of section.querySelectorAll('*')) {
        const box = e.getBoundingClientRect();
        if (!box.width || !box.height || box.right <= edge || e.closest('svg, math, .hidden')) continue;
        let inside = e.parentElement;
        while (inside !== section && getComputedStyle(inside).overflowX === 'visible')
          inside = inside.parentElement;
        if (inside === section) seen.push(`${e.tagName}.${e.className}: ${e.textContent.slice(0, 40)}`);
      }
    }
    const whole = document.documentElement;
    if (whole.scrollWidth > whole.clientWidth) seen.push('the page itself');
    return seen;
"""


@pytest.mark.parametrize("language", ["en", "fr"])
@pytest.mark.parametrize("place", PAGES, ids=lambda p: p.split("/")[0] + "/" + p.split("/")[1][:12])
def test_no_page_is_cut_at_any_width(page: Page, place: str, language: str) -> None:
    page.open(place, language)
    for width in WIDTHS:
        resize(page, width)
        assert not page.browser.execute_script(CUT), width


def test_no_card_is_cut_at_any_width(page: Page) -> None:
    page.open("home", "fr")
    for card in CARDS:
        page.visit(f"calculate/{card}")
        assert card in page.browser.current_url
        for width in WIDTHS:
            resize(page, width)
            assert not page.browser.execute_script(CUT), (card, width)


@pytest.mark.parametrize(("language", "typed", "wanted"), [("en", "42.5", "1.32"), ("fr", "42,5", "1,32")])
def test_the_result_stays_in_sight_on_a_phone(page: Page, language: str, typed: str, wanted: str) -> None:
    page.open(STOKES, language, width=390)
    low = {
        "width": 390,
        "height": 560,
        "deviceScaleFactor": 1,
        "mobile": False,
    }  # above a keyboard
    page.browser.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", low)
    field = page.one("#field-particle_diameter")
    page.browser.execute_script("arguments[0].scrollIntoView({block: 'center'})", field)
    page.until(lambda: page.one(".pinned").is_displayed())
    page.type("#field-particle_diameter", typed)
    told = "return document.querySelector('.pinned strong')?.textContent ?? ''"
    page.until(lambda: page.browser.execute_script(told).startswith(wanted))  # a quarter of 5.28 mm/s
    page.check()
    page.browser.execute_script("document.querySelector('[data-output]').scrollIntoView({block: 'center'})")
    page.until(lambda: not page.one(".pinned").is_displayed())


def test_a_changed_result_is_spoken(page: Page) -> None:
    import time

    page.open(STOKES)
    time.sleep(1.5)  # the result that the page opens with is read with it
    page.type("#field-particle_diameter", "42.5")
    page.until(
        lambda: (
            "1.32 mm/s" in page.browser.execute_script("return document.querySelector('#voice').textContent")
        )
    )


def test_the_skip_link_leads_to_the_form(page: Page) -> None:
    page.open(STOKES)
    page.browser.execute_script("arguments[0].focus()", page.one(".skip"))
    ActionChains(page.browser).send_keys(Keys.ENTER).perform()
    assert page.browser.switch_to.active_element.get_attribute("id") == "field-particle_diameter"


def printed(page: Page) -> bytes:
    asked = {"preferCSSPageSize": True, "printBackground": False}
    return base64.b64decode(page.browser.execute_cdp_cmd("Page.printToPDF", asked)["data"])


def on_paper(page: Page, script: str) -> Any:
    """What a script sees with the styles of paper on a sheet of A4."""
    page.browser.execute_cdp_cmd("Emulation.setEmulatedMedia", {"media": "print"})
    resize(page, 688)  # 210 mm less the margins
    page.browser.execute_script("dispatchEvent(new Event('beforeprint'))")
    try:
        return page.browser.execute_script(script)
    finally:
        page.browser.execute_script("dispatchEvent(new Event('afterprint'))")
        page.browser.execute_cdp_cmd("Emulation.setEmulatedMedia", {"media": ""})


@pytest.mark.parametrize(
    ("language", "again"), [("en", "The same page again"), ("fr", "La même page de nouveau")]
)
def test_paper_says_where_it_comes_from_and_shows_no_buttons(page: Page, language: str, again: str) -> None:
    page.open(PAGES[3], language, theme="dark")
    page.one(".plot .main-svg .scatterlayer .trace")
    page.settle()
    seen = on_paper(
        page,
        """
        const visible = (e) => e.getBoundingClientRect().height > 0;
        const plot = document.querySelector('.plot .main-svg');
        return {
          buttons: [...document.querySelectorAll('button, header, .find')].filter(visible)
            .filter((e) => !e.classList.contains('plain')).length,
          foot: document.querySelector('.printed').innerText,
          cut: [...document.querySelectorAll('.plot')].map((e) => e.scrollWidth - innerWidth),
          paper: getComputedStyle(document.body).backgroundColor,
          chart: plot.style.background,
          kept: getComputedStyle(document.querySelector('.drawn')).breakInside,
        };
        """,
    )
    assert seen["buttons"] == 0
    assert again in seen["foot"]
    assert "psychrometric_chart" in seen["foot"]
    assert re.search(r"Granum \d", seen["foot"])
    assert re.search(r"20\d\d", seen["foot"])
    assert max(seen["cut"]) <= 0
    assert seen["paper"] == "rgb(255, 255, 255)"
    assert "255, 255, 255" in seen["chart"] or "white" in seen["chart"]
    assert seen["kept"] == "avoid"
    assert printed(page).startswith(b"%PDF")
    resize(page, 1300)
    height = "return document.querySelector('.plot').clientHeight"
    page.until(lambda: page.browser.execute_script(height) > 300)  # afterwards the chart is there as before


def test_a_line_on_paper_is_its_diagram_findings_and_streams_with_no_column_cut(page: Page) -> None:
    page.open(f"lines/{quote('examples:potassium-nitrate/line.toml', safe='')}", "fr")
    page.one(".findings")
    page.settle()
    seen = on_paper(
        page,
        """
        const visible = (e) => e.getBoundingClientRect().height > 0;
        const right = (name) => Math.max(0, ...[...document.querySelectorAll(name)]
          .filter(visible).map((e) => e.getBoundingClientRect().right));
        return {
          ends: ['.diagram svg', '.streams', '.findings'].map(right),
          folded: [...document.querySelectorAll('details:not([open])')].filter(visible).length,
          fields: [...document.querySelectorAll('input, select, textarea')].filter(visible).length,
        };
        """,
    )
    assert all(0 < end <= 689 for end in seen["ends"]), seen
    assert seen["folded"] == 0
    assert seen["fields"] == 0


def test_a_unit_stands_beside_its_number_on_paper(page: Page) -> None:
    page.open(STOKES, "fr")
    page.one("[data-output]")
    width, gap, cut = on_paper(
        page,
        """
        const field = document.querySelector('#field-particle_diameter');
        const [number, unit] = [field, field.parentElement.querySelector('select')];
        const [a, b] = [number, unit].map((e) => e.getBoundingClientRect());
        return [a.width, b.left - a.right, number.scrollWidth - number.clientWidth];
        """,
    )
    assert 8.0 < width < 60.0  # no wider than what stands in it
    assert 0.0 <= gap < 12.0
    assert cut <= 1.0


@pytest.mark.parametrize("language", ["en", "fr"])
def test_paper_has_no_empty_field_and_no_menu(page: Page, language: str) -> None:
    for place in (STOKES, "calculate/filtration.rotary_vacuum_drum"):
        page.open(place, language)
        page.one("[data-output], .answers td")
        page.settle()
        seen = on_paper(
            page,
            """
            const visible = (e) => e.getBoundingClientRect().height > 0;
            const shown = (s) => [...document.querySelectorAll(s)].filter(visible);
            return {
              blank: shown('.field :is(input, select)').filter((e) => !e.value && !e.placeholder).length,
              fields: shown('.field').length,
              menus: shown('.figure .units').length,
              limits: shown('.limits tr').map((e) => new Set([...e.cells].map((c) => c.offsetTop)).size),
            };
            """,
        )
        assert seen["blank"] == 0
        assert seen["menus"] == 0
        assert seen["fields"] > 3
        assert set(seen["limits"]) <= {1}, "a limit stands beside its name"
    assert not page.all(".field.blank"), "afterwards every field is there again"


def test_the_address_of_a_line_on_paper_is_one_that_can_be_typed(page: Page) -> None:
    page.open("lines", "fr")
    page.button("Nouvelle ligne").click()
    page.until(lambda: page.all("#new-solute"))
    page.button("Créer la ligne").click()
    page.until(lambda: "case=" in page.browser.current_url)
    told = on_paper(page, "return document.querySelector('.printed').textContent")
    assert "#/lines" in told
    assert "case=" not in told


def test_flows_of_a_report_are_all_there_on_paper(page: Page, tmp_path: Path) -> None:
    case = Path(__file__).parents[2] / "examples" / "cyclone" / "pair.toml"
    report = tmp_path / "report.html"
    read(case).solve().report(report)
    page.browser.get(report.as_uri())
    page.one(".sankey-link")
    flows = "return [...document.querySelectorAll('.sankey-link')].map((e) => e.getAttribute('d').length > 0)"
    before = page.browser.execute_script(flows)
    seen = on_paper(
        page,
        """
        const plots = [...document.querySelectorAll('.js-plotly-plot')];
        const flows = [...document.querySelectorAll('.sankey-link')];
        const seen = (e) => e.getAttribute('d') && getComputedStyle(e).opacity > 0.5;
        return [flows.map((e) => Boolean(seen(e))), plots.every((e) => e.getBoundingClientRect().right <= innerWidth + 1)];
        """,  # noqa: E501
    )
    assert all(before)
    assert seen == [before, True]
