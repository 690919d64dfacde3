"""Chromium without a window, for the book and for the tests of the app."""

from __future__ import annotations

import shutil
from collections.abc import Iterator
from contextlib import contextmanager

from selenium import webdriver
from selenium.webdriver.chrome.options import Options
from selenium.webdriver.chrome.service import Service

NEEDED = "this needs Debian's packages chromium and chromium-driver: apt-get install chromium chromium-driver"


@contextmanager
def chromium(
    patience: float, *arguments: str, capabilities: dict[str, object] | None = None
) -> Iterator[webdriver.Chrome]:
    """A browser that waits so many seconds for a script."""
    program, driver = shutil.which("chromium"), shutil.which("chromedriver")
    if program is None or driver is None:
        raise SystemExit(NEEDED)
    options = Options()
    options.binary_location = program
    for argument in (
        "--headless=new",
        "--no-sandbox",
        "--disable-gpu",
        "--disable-dev-shm-usage",
        *arguments,
    ):
        options.add_argument(argument)
    for name, value in (capabilities or {}).items():
        options.set_capability(name, value)
    found = webdriver.Chrome(options=options, service=Service(driver))
    found.set_script_timeout(patience)
    try:
        yield found
    finally:
        found.quit()
