"""A page of the app in a real browser, with the outside world cut off, driven by real keys."""

from __future__ import annotations

import shutil
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import axe_selenium_python.axe
from selenium import webdriver
from selenium.webdriver.chrome.options import Options
from selenium.webdriver.chrome.service import Service
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys
from selenium.webdriver.support.ui import WebDriverWait

NEEDED = (
    "these tests need Debian's packages chromium and chromium-driver: apt-get install chromium "
    "chromium-driver"
)
PATIENCE = 240.0  # seconds: a first calculation compiles, and continuous integration is slow


@contextmanager
def chromium() -> Iterator[webdriver.Chrome]:
    """A browser without a window."""
    program, driver = shutil.which("chromium"), shutil.which("chromedriver")
    assert program, NEEDED
    assert driver, NEEDED
    options = Options()
    options.binary_location = program
    for argument in (
        "--headless=new",
        "--no-sandbox",
        "--disable-gpu",
        "--no-first-run",
        "--disable-background-networking",
        "--disable-component-update",
        "--disable-sync",
        "--disable-dev-shm-usage",
        "--window-size=1400,900",
        "--host-resolver-rules=MAP * ~NOTFOUND , EXCLUDE 127.0.0.1",
    ):
        options.add_argument(argument)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL", "performance": "ALL"})
    found = webdriver.Chrome(options=options, service=Service(driver))
    found.set_page_load_timeout(PATIENCE)
    found.set_script_timeout(60)
    try:
        yield found
    finally:
        found.quit()


class Page:
    """One page of the app in the browser."""

    def __init__(self, browser: webdriver.Chrome, address: str):
        self.browser, self.address = browser, address

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
        """No word on the console (but for refusals where they are wanted), nothing wider than the page, no
        complaint of axe.
        """
        complaints = [
            e["message"] for e in self.browser.get_log("browser") if e["level"] in ("SEVERE", "WARNING")
        ]
        if refused:
            complaints = [text for text in complaints if "status of 422" not in text]
        assert not complaints, complaints
        assert self.browser.execute_script("return document.documentElement.scrollWidth <= innerWidth"), (
            "the page is wider than the window"
        )
        self.browser.execute_script(Path(axe_selenium_python.axe._DEFAULT_SCRIPT).read_text(encoding="utf-8"))
        found = self.browser.execute_async_script(
            "axe.run({rules: {region: {enabled: false}}}).then((r) => arguments[0](r.violations))"
        )
        assert not found, [(v["id"], [n["html"][:160] for n in v["nodes"][:3]]) for v in found]
