"""A page of the app in a real browser, with the outside world cut off, driven by real keys."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from importlib.resources import files
from typing import Any

import pytest
from docs import headless
from selenium import webdriver
from selenium.common.exceptions import JavascriptException, StaleElementReferenceException, TimeoutException
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys
from selenium.webdriver.support.ui import WebDriverWait

PATIENCE = 240.0  # seconds: a first calculation compiles, and continuous integration is slow
# what takes seconds in each language is tried in the one with accents and decimal commas, and in the other
# once a night
MOSTLY_FRENCH = [pytest.param("en", marks=pytest.mark.long), "fr"]
SCRIPT_PATIENCE = 60.0
AXE = files("axe_playwright_python") / "axe.min.js"
SETTLED = """
    const done = arguments[0];
    const ready = () => document.querySelector('h1') && !document.querySelector('[aria-busy=true]');
    const frames = (next) => requestAnimationFrame(() => requestAnimationFrame(next));
    const look = () => ready() ? frames(() => setTimeout(again, 30)) : setTimeout(look, 15);
    const again = () => (ready() ? done() : look()); // what an answer sets off has begun by then
    look();
"""


@contextmanager
def chromium() -> Iterator[webdriver.Chrome]:
    """A browser that sees nothing but this computer and keeps what it has to say."""
    quiet = (
        "--no-first-run",
        "--disable-background-networking",
        "--disable-component-update",
        "--disable-sync",
        "--window-size=1400,900",
        "--host-resolver-rules=MAP * ~NOTFOUND , EXCLUDE 127.0.0.1",
    )
    logs = {"goog:loggingPrefs": {"browser": "ALL", "performance": "ALL"}}
    with headless.chromium(SCRIPT_PATIENCE, *quiet, capabilities=logs) as found:
        found.set_page_load_timeout(PATIENCE)
        yield found


class Page:
    """One page of the app in the browser."""

    def __init__(self, browser: webdriver.Chrome, address: str):
        self.browser, self.address = browser, address
        self.typed = False  # key by key since the log of the browser was last read

    def open(self, place: str, language: str = "en", width: int = 1400, theme: str = "light") -> None:
        size = {"width": width, "height": 900, "deviceScaleFactor": 1, "mobile": False}
        self.browser.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", size)
        self.browser.get(f"{self.address}/style.css")
        self.browser.execute_script(
            (
                "localStorage.clear(); sessionStorage.clear(); indexedDB.deleteDatabase('granum'); "
                "localStorage.setItem('granum-theme', arguments[0])"
            ),
            theme,
        )
        self.browser.get_log("browser")
        self.typed = False
        self.browser.get(f"{self.address}/?lang={language}#/{place}")
        self.settle()

    def visit(self, place: str) -> None:
        """Another place of the same visit: what the browser has loaded and keeps is there."""
        self.browser.execute_script("location.hash = arguments[0]", f"#/{place}")
        self.settle()

    def turn(self, width: int, theme: str) -> None:
        """The same page in a window of another width, in light or dark."""
        resize(self, width)
        if self.browser.execute_script("return document.documentElement.dataset.theme") != theme:
            self.one("header .tools button:last-child").click()
        self.settle()

    def settle(self) -> None:
        """Wait until the page has its heading and nothing on it is busy, also after what that sets off."""
        start = time.monotonic()
        while time.monotonic() - start < PATIENCE:
            # a page that is left meanwhile, or a calculation longer than a script may take
            with suppress(JavascriptException, TimeoutException):
                self.browser.execute_async_script(SETTLED)
                return
        raise TimeoutException("the page does not come to rest")

    def until(self, condition: Callable[[], Any]) -> Any:
        """What a condition gives once it holds; a page drawn anew between two looks is looked at again."""
        return WebDriverWait(
            self.browser, PATIENCE, poll_frequency=0.03, ignored_exceptions=[StaleElementReferenceException]
        ).until(lambda _browser: condition())

    def one(self, selector: str) -> Any:
        return self.until(lambda: next(iter(self.browser.find_elements(By.CSS_SELECTOR, selector)), None))

    def all(self, selector: str) -> list[Any]:
        return self.browser.find_elements(By.CSS_SELECTOR, selector)

    def text(self, selector: str) -> str:
        """The text of an element, read again where it is drawn anew between the finding and the reading."""
        return self.until(lambda: (self.one(selector).text,))[0]

    def texts(self, selector: str) -> list[str]:
        """The texts of all such elements, of one drawing of the page."""
        return self.until(lambda: ([e.text for e in self.all(selector)],))[0]

    def says(self, selector: str, words: str) -> None:
        """Wait until an element has these words; where it never has, tell what it had instead."""
        self.shown(selector, words, lambda text: words in text)

    def reads(self, selector: str, words: str) -> None:
        """Wait until these words are all that an element has."""
        self.shown(selector, words, lambda text: text == words)

    def shown(self, selector: str, words: str, right: Callable[[str], bool]) -> None:
        self.one(selector)
        try:
            self.until(lambda: right(self.text(selector)))
        except TimeoutException:
            raise AssertionError(f"{selector}: {words!r} expected, {self.text(selector)!r} found") from None

    def button(self, text: str) -> Any:
        return self.until(lambda: next((b for b in self.all("button") if b.text == text), None))

    def write(self, selector: str, text: str) -> None:
        field = self.one(selector)
        self.typed = True
        field.send_keys(Keys.CONTROL, "a")
        field.send_keys(text)

    def paste(self, selector: str, text: str) -> None:
        """Text put into a field at once, as from the clipboard."""
        self.one(selector).click()
        self.browser.execute_cdp_cmd("Input.insertText", {"text": text})

    def type(self, selector: str, text: str, into: str = "") -> Any:
        """Type as people do: the field emptied, then key by key."""
        field = self.one(selector)
        self.browser.execute_script("arguments[0].closest('details')?.setAttribute('open', '')", field)
        field.send_keys(Keys.CONTROL, "a")
        field.send_keys(Keys.BACKSPACE)
        self.typed = True
        for key in text:
            field.send_keys(key)
        assert field.get_attribute("value") == (into or text), "the text of a field belongs to whoever types"
        return field

    def leave(self, field: Any) -> tuple[str, str]:
        """Number and unit of a field after it has been left."""
        field.send_keys(Keys.TAB)
        self.settle()
        menu = field.find_elements(By.XPATH, "following-sibling::select")
        return field.get_attribute("value"), menu[0].get_attribute("value") if menu else ""

    def fresh(self) -> bool:
        """Whether a result stands there as one of the present inputs."""
        return self.browser.execute_script(
            "return [...document.querySelectorAll('[data-output]')].some((e) => !e.closest('.stale'))"
        )

    def check(self, refused: bool = False) -> None:
        """No word on the console (but for refusals where they are wanted, or of what was typed half: a slow
        machine asks for "85 ±" between two keys), nothing wider than the page, no complaint of axe.
        """
        complaints = [
            e["message"] for e in self.browser.get_log("browser") if e["level"] in ("SEVERE", "WARNING")
        ]
        if refused or self.typed:
            complaints = [text for text in complaints if "status of 422" not in text]
        assert not complaints, complaints
        self.typed = False
        assert self.browser.execute_script("return document.documentElement.scrollWidth <= innerWidth"), (
            "the page is wider than the window"
        )
        self.browser.execute_script(AXE.read_text(encoding="utf-8"))
        found = self.browser.execute_async_script(
            # what is stale is inactive and may be pale
            "axe.configure({rules: [{id: 'color-contrast', selector: '*:not(.stale, .stale *)'}]});"
            # what passes is not collected: twice as quick, and the same is found
            "axe.run({rules: {region: {enabled: false}}, resultTypes: ['violations'], preload: false})"
            ".then((r) => arguments[0](r.violations))"
        )
        assert not found, [(v["id"], [n["html"][:160] for n in v["nodes"][:3]]) for v in found]


def resize(page: Page, width: int) -> None:
    size = {"width": width, "height": 900, "deviceScaleFactor": 1, "mobile": False}
    page.browser.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", size)
    page.browser.execute_async_script(
        "requestAnimationFrame(() => requestAnimationFrame(() => setTimeout(arguments[0], 60)))"
    )
