"""Every page in a real browser, in both languages, with the outside world cut off: it works, says nothing to the console, and axe is content."""

from __future__ import annotations

import shutil
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any
from urllib.parse import quote

import axe_selenium_python.axe
import pytest
from selenium import webdriver
from selenium.webdriver.chrome.options import Options
from selenium.webdriver.chrome.service import Service
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys
from selenium.webdriver.support.ui import Select, WebDriverWait

NEEDED = "these tests need Debian's packages chromium and chromium-driver: apt-get install chromium chromium-driver"
PATIENCE = 240.0  # seconds: a first calculation compiles, and continuous integration is slow
LANGUAGES = ("en", "fr")
CASE = "examples:grinding-circuit/circuit.toml"
SPHERE = "particle_diameter=85+um&particle_density=2630+kg%2Fm%5E3&fluid_density=1020+kg%2Fm%5E3&dynamic_viscosity=1.2+cP"


@pytest.fixture(scope="session")
def browser() -> Iterator[webdriver.Chrome]:
    chromium, driver = shutil.which("chromium"), shutil.which("chromedriver")
    assert chromium, NEEDED
    assert driver, NEEDED
    options = Options()
    options.binary_location = chromium
    for argument in (
        "--headless=new", "--no-sandbox", "--disable-gpu", "--no-first-run", "--disable-background-networking", "--disable-component-update",
        "--disable-sync", "--disable-dev-shm-usage", "--window-size=1400,900", "--host-resolver-rules=MAP * ~NOTFOUND , EXCLUDE 127.0.0.1",
    ):  # fmt: skip
        options.add_argument(argument)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL", "performance": "ALL"})
    found = webdriver.Chrome(options=options, service=Service(driver))
    found.set_page_load_timeout(PATIENCE)
    found.set_script_timeout(60)
    yield found
    found.quit()


class Page:
    """One page of the app in the browser."""

    def __init__(self, browser: webdriver.Chrome, address: str):
        self.browser, self.address = browser, address

    def open(self, place: str, language: str = "en", width: int = 1400, theme: str = "light") -> None:
        size = {"width": width, "height": 900, "deviceScaleFactor": 1, "mobile": False}
        self.browser.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", size)
        self.browser.get(f"{self.address}/style.css")
        self.browser.execute_script("localStorage.clear(); localStorage.setItem('granum-theme', arguments[0])", theme)
        self.browser.get_log("browser")
        self.browser.get(f"{self.address}/?lang={language}#/{place}")
        self.settle()

    def settle(self) -> None:
        ready = "return Boolean(document.querySelector('h1')) && !document.querySelector('[aria-busy=true]')"
        self.until(lambda: self.browser.execute_script(ready))
        drawn = "requestAnimationFrame(() => requestAnimationFrame(() => setTimeout(arguments[0], 30)))"
        self.browser.execute_async_script(drawn)  # what the answer sets off has begun by then
        self.until(lambda: self.browser.execute_script(ready))

    def until(self, condition: Callable[[], Any]) -> Any:
        return WebDriverWait(self.browser, PATIENCE, poll_frequency=0.1).until(lambda _browser: condition())

    def one(self, selector: str) -> Any:
        return self.until(lambda: next(iter(self.browser.find_elements(By.CSS_SELECTOR, selector)), None))

    def all(self, selector: str) -> list[Any]:
        return self.browser.find_elements(By.CSS_SELECTOR, selector)

    def button(self, text: str) -> Any:
        return self.until(lambda: next((b for b in self.all("button") if b.text == text), None))

    def write(self, selector: str, text: str) -> None:
        field = self.one(selector)
        field.send_keys(Keys.CONTROL, "a")
        field.send_keys(text)

    def check(self, refused: bool = False) -> None:
        """No word on the console (but for refusals where they are wanted), nothing wider than the page, no complaint of axe."""
        complaints = [e["message"] for e in self.browser.get_log("browser") if e["level"] in ("SEVERE", "WARNING")]
        if refused:
            complaints = [text for text in complaints if "status of 422" not in text]
        assert not complaints
        assert self.browser.execute_script("return document.documentElement.scrollWidth <= innerWidth"), "the page is wider than the window"
        self.browser.execute_script(Path(axe_selenium_python.axe._DEFAULT_SCRIPT).read_text(encoding="utf-8"))
        found = self.browser.execute_async_script("axe.run({rules: {region: {enabled: false}}}).then((r) => arguments[0](r.violations))")
        assert not found, [(v["id"], [n["html"][:160] for n in v["nodes"][:3]]) for v in found]


@pytest.fixture
def page(browser: webdriver.Chrome, address: str) -> Page:
    return Page(browser, address)


PLACES = {
    "calculate": "calculate",
    "calculate with values": f"calculate/particles.terminal_velocity_stokes?{SPHERE}",
    "calculate a table": "calculate/particles.size_summary",
    "lab": "lab/filtration.leaf_test",
    "lines": "lines",
    "charts": "charts/particles.drag_chart",
    "studies": f"studies/{quote('card:particles.terminal_velocity_stokes', safe='')}?{SPHERE}",
    "select": "select",
    "exercises": "exercises/buchner-to-filter",
    "questions": "exercises/quizzes",
}


@pytest.mark.parametrize("language", LANGUAGES)
@pytest.mark.parametrize("place", PLACES)
def test_a_page_is_clean_wide_and_narrow_light_and_dark(page: Page, place: str, language: str) -> None:
    for width, theme in ((1400, "light"), (420, "dark")):
        page.open(PLACES[place], language, width, theme)
        assert page.browser.execute_script("return document.documentElement.lang") == language
        assert page.all("header nav a")
        page.check()


@pytest.mark.parametrize(("language", "point"), [("en", "."), ("fr", ",")])
def test_a_result_follows_what_is_typed(page: Page, language: str, point: str) -> None:
    page.open(f"calculate/particles.terminal_velocity_stokes?{SPHERE}", language)
    shown = page.one("[data-output=terminal_velocity]")
    assert shown.text.startswith(f"5{point}28")  # Stokes by hand: 5.282 mm/s
    page.write("#field-particle_diameter", f"42{point}5")
    page.until(lambda: page.one("[data-output=terminal_velocity]").text.startswith(f"1{point}32"))  # a quarter of it
    assert "42.5" in page.browser.current_url
    page.write("#field-particle_diameter", "-3")
    page.until(lambda: page.all("[aria-invalid=true]"))
    assert page.one(".message.out").text
    for _ in range(3):
        page.button("Undo" if language == "en" else "Annuler").click()
    page.until(lambda: not page.all("[aria-invalid=true]"))
    page.settle()
    page.check(refused=True)


def test_choosing_another_unit_reads_the_same_number_in_it(page: Page) -> None:
    page.open(f"calculate/particles.terminal_velocity_stokes?{SPHERE}")
    Select(page.one("#field-particle_diameter ~ select")).select_by_visible_text("mm")
    page.until(
        lambda: page.one("[data-output=terminal_velocity]").text.startswith("5281 m/s")
    )  # a thousand times wider, a million times faster


def test_values_survive_reloading_and_changing_the_language(page: Page) -> None:
    page.open(f"calculate/particles.terminal_velocity_stokes?{SPHERE}")
    page.write("#field-particle_diameter", "60")
    page.until(lambda: "60" in page.browser.current_url)
    page.button("Français").click()
    page.settle()
    assert page.one("#field-particle_diameter").get_attribute("value") == "60"
    assert page.one("h1").text.startswith("Vitesse")
    page.browser.refresh()
    page.settle()
    assert page.one("#field-particle_diameter").get_attribute("value") == "60"


def test_search_finds_and_the_keyboard_suffices(page: Page) -> None:
    page.open("calculate")
    page.write(".find input", "ergun pressure")
    page.until(lambda: any("Ergun" in a.text for a in page.all(".find li a")))
    link = next(a for a in page.all(".find li a") if "Ergun" in a.text)
    link.send_keys(Keys.ENTER)
    page.until(lambda: "ergun" in page.browser.current_url)
    page.settle()
    assert page.one("[data-output]").text
    page.check()


def test_three_cases_are_compared(page: Page) -> None:
    page.open(f"calculate/particles.terminal_velocity_stokes?{SPHERE}")
    page.button("Keep to compare").click()
    page.write("#field-particle_diameter", "42.5")
    page.until(lambda: page.one("[data-output=terminal_velocity]").text.startswith("1.32"))
    page.settle()
    cells = [c.text for c in page.all("tbody strong")]
    assert any(c.startswith("5.28") for c in cells)
    assert any(c.startswith("1.32") for c in cells)
    page.check()


@pytest.mark.parametrize("language", LANGUAGES)
def test_a_pasted_table_is_fitted(page: Page, language: str) -> None:
    page.open(
        "lab/filtration.leaf_test?area=0.05+m%5E2&pressure_drop=1+bar&dynamic_viscosity=1+cP&dry_cake_per_filtrate=20+kg%2Fm%5E3", language
    )
    a, b = 4.0e6, 2000.0  # s/m⁶ and s/m³: α = 1e11 m/kg, R = 1e10 1/m
    rows = [
        f"{a * v * v + b * v + wiggle},{v}"
        for v, wiggle in ((0.0005, 0.01), (0.001, -0.01), (0.0015, 0.01), (0.002, -0.02), (0.0025, 0.01), (0.003, 0.0))
    ]
    page.one("#table").send_keys("t / s,Filtrat (m3)\n" + "\n".join(rows))  # named otherwise: the columns are told what they are
    for column, named in (("time", "t / s"), ("filtrate_volume", "Filtrat (m3)")):
        Select(page.one(f"#column-{column}")).select_by_visible_text(named)
    assert page.one("#table").get_attribute("value").startswith("time [s],filtrate_volume [m3]")
    row = page.one("[data-parameter=cake_resistance]")
    assert "10¹" in row.text or "× 10" in row.text
    assert len(page.until(lambda: len(found := page.all(".plot .main-svg")) >= 2 and found)) >= 2  # fit and residuals
    page.settle()
    page.check()


@pytest.mark.parametrize("language", LANGUAGES)
def test_a_line_is_solved_and_its_diagram_answers_clicks(page: Page, language: str) -> None:
    page.open(f"lines/{quote(CASE, safe='')}", language)
    page.one(".diagram svg")
    page.settle()
    page.check()
    page.browser.execute_script("document.querySelector('[data-stream]').dispatchEvent(new MouseEvent('click', {bubbles: true}))")
    page.one(".card .plot .main-svg")
    unit = page.one("[data-unit=mill]")
    page.browser.execute_script("arguments[0].focus()", unit)
    unit.send_keys(Keys.ENTER)
    page.one("[data-figure^='mill.']")
    page.browser.execute_script("document.querySelector('#case').closest('details').open = true")
    page.write("#case", "title = ")
    page.button("Solve" if language == "en" else "Résoudre").click()
    page.one("[role=alert]")
    page.settle()
    page.check(refused=True)


def test_a_line_is_edited_by_forms_compared_undone_and_saved(page: Page) -> None:
    page.open(f"lines/{quote(CASE, safe='')}")
    page.one(".diagram svg")
    page.settle()
    before = page.one("[data-figure='mill.residence_time']").text
    page.button("Keep to compare").click()
    page.browser.execute_script("document.querySelector('[data-unit=mill]').dispatchEvent(new MouseEvent('click', {bubbles: true}))")
    page.write("[data-panel=mill] input[id$=holdup_mass]", "2.4")
    page.one("table[data-comparison]")
    page.settle()
    page.until(lambda: before in page.one("table[data-comparison]").text)
    assert "2.4 tonne" in page.one("table[data-comparison]").text
    page.check()
    page.write("[aria-label='File name']", "mine/mill.toml")
    page.button("Save").click()
    page.until(lambda: "mill.toml" in page.browser.current_url)
    saved = page.browser.execute_async_script(
        "fetch('/api/workspace/mine/mill.toml').then((r) => r.json()).then((d) => arguments[0](d.text))"
    )
    assert 'holdup_mass = "2.4 tonne"' in saved
    assert "# root-two classes" in saved  # comments survive
    page.button("Undo").click()
    page.until(lambda: page.one("[data-panel=mill] input[id$=holdup_mass]").get_attribute("value") == "1.6")


def test_unsaved_changes_are_there_on_coming_back(page: Page) -> None:
    page.open(f"lines/{quote(CASE, safe='')}")
    page.one(".diagram svg")
    page.browser.execute_script("document.querySelector('[data-form=mill]').open = true")
    page.write("[data-form=mill] input[id$=holdup_mass]", "2.4")
    page.until(lambda: "2.4 tonne" in page.one("#case").get_attribute("value"))
    page.browser.refresh()
    page.until(lambda: "2.4 tonne" in page.one("#case").get_attribute("value"))
    page.button("Undo").click()
    page.until(lambda: "1.6 tonne" in page.one("#case").get_attribute("value"))


@pytest.mark.parametrize(("language", "run"), [("en", "Run the study"), ("fr", "Lancer l'étude")])
def test_a_study_runs_with_progress(page: Page, language: str, run: str) -> None:
    page.open(PLACES["studies"], language)
    page.button(run).click()
    page.one("[data-study=sweep]")
    page.one(".plot .main-svg .scatterlayer .trace")
    page.settle()
    page.check()
    page.browser.execute_script("document.querySelectorAll('input[type=radio]')[2].click()")
    page.button(run).click()
    page.one("[data-study=monte_carlo]")
    page.check()


@pytest.mark.parametrize("language", LANGUAGES)
def test_charts_are_drawn(page: Page, language: str) -> None:
    page.open("charts/particles.drag_chart", language)
    page.one(".plot .main-svg .scatterlayer .trace")
    page.check()


def test_the_answer_of_an_exercise_shows_on_request(page: Page) -> None:
    page.open("exercises/buchner-to-filter")
    assert not page.all("[data-answer]")
    page.button("Show the answer").click()
    assert "0.38" in page.one("[data-answer]").text
    page.button("Show the calculation").click()
    assert page.one("[data-output=void_fraction]").text.replace(" ", "").endswith(("0.3811", "38.11%"))
    page.settle()
    page.check()


def test_a_question_is_marked(page: Page) -> None:
    page.open("exercises/quizzes")
    quiz = page.one("[data-quiz=dew-point]")
    quiz.find_elements(By.CSS_SELECTOR, "input")[0].click()
    quiz.find_element(By.CSS_SELECTOR, "button").click()
    page.until(lambda: "3 of 3 right" in quiz.text)
    page.check()


def test_the_first_page_is_there_within_a_second_and_a_half(page: Page) -> None:
    page.open("calculate")  # everything is imported and compiled now: what counts is the way to the browser
    page.open("calculate")
    painted = page.browser.execute_script("return performance.getEntriesByName('first-contentful-paint')[0]?.startTime ?? 0")
    assert 0 < painted < 1500


def test_nothing_is_asked_of_another_host(page: Page) -> None:
    import json

    page.browser.get_log("performance")
    for place in PLACES.values():
        page.open(place)
    asked = set()
    for entry in page.browser.get_log("performance"):
        message = json.loads(entry["message"])["message"]
        if message["method"] == "Network.requestWillBeSent":
            asked.add(message["params"]["request"]["url"])
    assert asked
    assert not [url for url in asked if not url.startswith((page.address, "data:", "blob:", "about:"))]
