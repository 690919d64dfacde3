"""A first hour in French, by typed keys: a quantity, a line from nothing to its report, a lab test that goes
into it, a study left and found again.

Its pictures go to the folder that GRANUM_WALK names.
"""

from __future__ import annotations

import base64
import os
import re
from pathlib import Path

import pytest
from tests.app.browsing import Page
from tests.app.test_builder import TAKEN, build, case_of, press, solved
from tests.app.test_keeping import RUN, STOKES, closed_and_opened_again
from tests.app.test_lab import PLACE, table


class Album:
    """Pictures of whole pages, numbered as they were taken."""

    def __init__(self, page: Page, folder: Path | None):
        self.page, self.folder, self.count = page, folder, 0
        if folder is not None:
            folder.mkdir(parents=True, exist_ok=True)

    def take(self, name: str, refused: bool = False) -> None:
        """The page as it stands, sound and in French; its picture, where somebody wants them."""
        self.page.settle()
        self.page.check(refused)
        if self.folder is None:
            return
        size = self.page.browser.execute_script("return [innerWidth, document.documentElement.scrollHeight]")
        clip = {"x": 0, "y": 0, "width": size[0], "height": min(size[1], 4000), "scale": 1}
        picture = self.page.browser.execute_cdp_cmd(
            "Page.captureScreenshot", {"captureBeyondViewport": True, "clip": clip}
        )
        self.count += 1
        path = self.folder / f"{self.count:02d}-{name}.png"
        path.write_bytes(base64.b64decode(picture["data"]))


@pytest.fixture
def album(page: Page) -> Album:
    wanted = os.environ.get("GRANUM_WALK")
    return Album(page, Path(wanted) if wanted else None)


def go(page: Page, place: str) -> None:
    """Another place of the same visit: nothing that the browser holds is lost."""
    page.browser.get("about:blank")
    page.browser.get(f"{page.address}/?lang=fr#/{place}")
    page.settle()


def test_what_is_continuous_comes_before_what_only_contains_the_word(page: Page) -> None:
    page.open("lines", "fr")
    page.button("Nouvelle ligne").click()
    page.type("#new-title", "Essai")
    page.button("Créer la ligne").click()
    page.one("[data-palette]")
    page.type("[aria-label='Chercher un appareil']", "cristallisoir continu")
    titles = page.texts(".piece")
    found = [title for title in titles if title.startswith("Cristallisoir")]
    assert found[0].startswith("Cristallisoir continu")


def test_a_first_hour_in_french(page: Page, album: Album) -> None:
    page.open("home", "fr")
    album.take("accueil")
    page.browser.find_element("css selector", "body").send_keys("/")
    page.type("#seek", "vitesse de chute")
    page.until(lambda: page.all("#hits a"))
    album.take("recherche")
    go(page, "calculate/particles.terminal_velocity_stokes")
    for text, unit in (("0,085 mm", "mm"), ("85 microns", "µm"), ("8,5e-5 m", "m")):
        assert page.leave(page.type("#field-particle_diameter", text))[1] in (unit, "um")
        page.until(page.fresh)
    page.type("#field-particle_diameter", "85 furlongs de sable")
    page.until(lambda: page.all("[aria-invalid=true]"))
    page.settle()
    page.browser.get_log("browser")  # the refusal is no complaint
    album.take("refus")
    page.leave(page.type("#field-particle_diameter", "85 µm"))
    page.until(page.fresh)
    album.take("calcul", refused=True)  # half a unit was no unit

    build(page, "fr")
    album.take("ligne")
    page.browser.execute_script(TAKEN)
    page.button("Rapport").click()
    report = page.until(lambda: page.browser.execute_script("return window.taken"))
    assert 'lang="fr"' in report
    assert "Sel n° 1" in report
    case = case_of(page)
    assert "msmpr" in str(case["units"]["cristallisoir"])

    go(page, PLACE)
    page.paste("#table", table("Temps [s];Volume de filtrat [m3]", ";"))
    page.one("[data-parameter=cake_resistance]")
    page.one("[data-use] #use-unit")
    album.take("essai")
    press(page, "[data-use] .button")
    press(page, "[data-use] a")
    solved(page)
    assert case_of(page) != case
    assert "leaf_test" in str(case_of(page))
    album.take("ligne-avec-essai")

    go(page, STOKES)
    page.one("[data-kind=monte_carlo]").click()
    page.button(RUN["fr"]).click()
    page.one("[data-study=monte_carlo]")
    asked = page.text("[data-question] h2")
    album.take("étude")
    closed_and_opened_again(page)
    page.one("[data-study=monte_carlo]")
    page.reads("[data-question] h2", asked)
    assert re.search(r"\d,\d", page.text("td.n")), "a French number has its comma"
    album.take("étude-retrouvée")
