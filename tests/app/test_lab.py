"""Lab data on the page: headings in words, points left out, residuals under the data, nothing lost."""

from __future__ import annotations

import pytest
from tests.app.browsing import Page, resize

PLACE = (
    "lab/filtration.leaf_test?area=0.05+m%5E2&pressure_drop=1+bar&dynamic_viscosity=1+cP&"
    "dry_cake_per_filtrate=20+kg%2Fm%5E3"
)
A, B = 4.0e6, 2000.0  # s/m⁶ and s/m³: α = 2 A Ω² Δp/(η W) = 1e11 m/kg
HIDDEN = "return [...document.querySelectorAll('.wide')].some((e) => e.scrollWidth > e.clientWidth)"
VOLUMES = (0.0005, 0.001, 0.0015, 0.002, 0.0025, 0.003)
WIGGLE = (0.01, -0.01, 0.01, -0.02, 0.01, 0.0)


def table(heads: str, mark: str, stray: float = 0.0) -> str:
    rows = [
        f"{A * v * v + B * v + w + (stray if i == 3 else 0.0):.5f}{mark}{v}"
        for i, (v, w) in enumerate(zip(VOLUMES, WIGGLE, strict=True))
    ]
    text = "\n".join([heads, *rows])
    return text.replace(".", ",") if mark == ";" else text


def value(page: Page) -> float:
    """The cake resistance as the table says it, 10¹¹ m/kg."""
    text = page.text("[data-parameter=cake_resistance] strong").replace(",", ".")
    number, power = text.strip("(").split(" ")[0], text.split("× 10")[-1]
    return float(number) * {"¹⁰": 0.1, "¹¹": 1.0, "¹²": 10.0}[power]


def test_french_headings_are_known_from_the_glossary(page: Page) -> None:
    page.open(PLACE, "fr")
    page.paste("#table", table("Temps [s];Volume de filtrat [m3]", ";"))
    page.one("[data-parameter=cake_resistance]")
    page.settle()
    assert value(page) == pytest.approx(1.0, abs=0.02)
    chosen = [
        page.browser.execute_script(
            "return arguments[0].selectedOptions[0].text", page.one(f"#column-{name}")
        )
        for name in ("time", "filtrate_volume")
    ]
    assert chosen == ["Temps [s]", "Volume de filtrat [m3]"]
    titles = page.texts("[data-parameter=cake_resistance] td")
    assert "±" in titles[1]
    assert "…" in titles[2]
    assert page.one("[data-statistics] tr:first-child td").get_attribute("textContent")
    # one axis for both: the residuals stand under the data
    shared = "return document.querySelector('.plot')?._fullLayout?.yaxis2?.anchor"
    page.until(lambda: page.browser.execute_script(shared) == "x")
    for width in (1400, 1100, 390):
        resize(page, width)
        assert not page.browser.execute_script(HIDDEN), "a parameter is seen with its interval"
    page.check()


def test_a_point_is_left_out_by_its_tick_and_by_a_click(page: Page) -> None:
    page.open(PLACE)
    page.paste("#table", table("time [s],filtrate_volume [m3]", ",", stray=2.0))
    page.one("[data-parameter=cake_resistance]")
    page.settle()
    bent = value(page)
    page.one("[data-rows] summary").click()
    page.all("[data-rows] input")[3].click()
    page.until(lambda: page.all("[data-left-out]"))
    page.settle()
    assert value(page) == pytest.approx(1.0, abs=0.02)
    assert value(page) != bent
    assert page.one("#table").get_attribute("value").count("\n# ") == 1
    page.all("[data-rows] input")[3].click()
    page.until(lambda: not page.all("[data-left-out]"))
    page.settle()
    page.browser.execute_script(
        "const plot = document.querySelector('.plot');"
        "const at = plot.data.findIndex((d) => d.mode === 'markers' && d.yaxis !== 'y2');"
        "const points = [{data: plot.data[at], pointIndex: 3}];"
        "plot.emit('plotly_click', {event: {clientX: 0, clientY: 0}, points})"
    )
    page.until(lambda: page.all("[data-left-out]"))
    page.reads("[data-left-out]", "1 left out by you")
    page.settle()
    page.check()


def test_table_and_conditions_outlive_a_closed_tab(page: Page) -> None:
    page.open(PLACE)
    page.paste("#table", table("time [s],filtrate_volume [m3]", ","))
    page.one("[data-parameter=cake_resistance]")
    page.browser.execute_script("sessionStorage.clear()")
    page.browser.get("about:blank")
    page.browser.get(
        f"{page.address}/?lang=fr#/lab/filtration.leaf_test"
    )  # a bare address: the link says nothing
    page.one("[data-parameter=cake_resistance]")
    page.settle()
    assert page.one("#field-area").get_attribute("value") == "0,05"
    assert value(page) == pytest.approx(1.0, abs=0.02)
    page.check()


def test_what_the_browser_cannot_keep_is_said(page: Page) -> None:
    page.open("lab/filtration.leaf_test")
    page.browser.execute_script(
        "Storage.prototype.setItem = () => { throw new DOMException('full', 'QuotaExceededError'); }"
    )
    page.paste("#table", "time [s],filtrate_volume [m3]\n1,2")
    page.until(lambda: [e for e in page.all(".message.caution") if "too large" in e.text])
