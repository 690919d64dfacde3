"""The built site as a book: one PDF with numbered chapters, sections, figures and equations, contents and an
index.

    mkdocs build && python docs/book.py site granum.pdf [--language fr]

Chromium prints it twice: the first time tells on which page everything stands, the second time has these
numbers in the contents and in the index.
"""

from __future__ import annotations

import argparse
import base64
import io
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from functools import partial
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer
from importlib.metadata import version
from pathlib import Path
from typing import Any

import yaml
from headless import chromium
from pypdf import PdfReader
from selenium import webdriver

from granum.core.glossary import glossary
from granum.core.i18n import LANGUAGES, language

HERE = Path(__file__).parent
FRENCH = "Français"
NO_CHAPTERS = ("index.md", "fr/index.md", "cards/index.md", "cards-fr/index.md")
NOT_IN_BOOK = ("benchmarks.md", "architecture.md")
WORDS = {
    "en": {"title": "Granum: the handbook", "contents": "Contents", "index": "Index", "figure": "Figure"},
    "fr": {
        "title": "Granum : le manuel",
        "contents": "Table des matières",
        "index": "Index",
        "figure": "Figure",
    },
}
SHORTEST = 8  # letters of a word of the index
PATIENCE = 600.0  # seconds for a browser to draw a hundred figures
PRINTS = 4  # until the numbers in the book no longer move what they tell of


def chapters(code: str) -> list[str]:
    """The pages of a language in the order of the site, as addresses within it."""
    nav = yaml.safe_load((HERE.parent / "mkdocs.yml").read_text(encoding="utf-8"))["nav"]
    french, english = [], []
    for entry in nav:
        (french if isinstance(entry, dict) and FRENCH in entry else english).extend(_pages(entry))
    pages = french if code == "fr" else english
    return [page.removesuffix(".md") + ".html" for page in pages if page not in (*NO_CHAPTERS, *NOT_IN_BOOK)]


def _pages(entry: Any) -> Iterator[str]:
    if isinstance(entry, str):
        yield entry
    for item in entry.values() if isinstance(entry, dict) else entry if isinstance(entry, list) else ():
        yield from _pages(item)


def terms(code: str) -> list[str]:
    """The words of the glossary that an index may have."""
    with language(code):
        return sorted({term.label for term in glossary().values() if len(term.label) >= SHORTEST})


class _Site(SimpleHTTPRequestHandler):
    """Files of a built site; the book is a page in their midst."""

    def do_GET(self) -> None:
        if self.path != "/book.html":
            return super().do_GET()
        style = (HERE / "book.css").read_text(encoding="utf-8")
        page = f'<!doctype html><html><meta charset="utf-8"><style>{style}</style><body></body></html>'
        data = page.encode()
        self.send_response(200)
        self.send_header("content-type", "text/html; charset=utf-8")
        self.send_header("content-length", str(len(data)))
        self.end_headers()
        self.wfile.write(data)

    def log_message(self, *_words: Any) -> None:
        """Silent."""


@contextmanager
def _served(site: Path) -> Iterator[str]:
    server = ThreadingHTTPServer(("127.0.0.1", 0), partial(_Site, directory=str(site)))
    threading.Thread(target=server.serve_forever, daemon=True).start()
    try:
        yield f"http://127.0.0.1:{server.server_address[1]}"
    finally:
        server.shutdown()
        server.server_close()


def _printed(browser: webdriver.Chrome) -> bytes:
    asked = {"preferCSSPageSize": True, "printBackground": True, "generateDocumentOutline": True}
    return base64.b64decode(browser.execute_cdp_cmd("Page.printToPDF", asked)["data"])


def places(printed: bytes) -> dict[str, int]:
    """On which page, counted from 1, each name that something leads to stands."""
    reader = PdfReader(io.BytesIO(printed))
    found = {}
    for name, destination in reader.named_destinations.items():
        number = reader.get_destination_page_number(destination)
        if number is not None:
            found[name.lstrip("/")] = number + 1
    return found


def book(site: Path, pages: list[str], words: list[str], code: str) -> bytes:
    """The PDF of some pages of a site, with an index of those of the words that they use."""
    told = WORDS[code] | {"version": version("granum"), "language": code}
    with _served(site) as address, chromium(PATIENCE) as browser:
        browser.get(f"{address}/book.html")
        script = (HERE / "book.js").read_text(encoding="utf-8")
        problem = browser.execute_async_script(script, pages, words, told)
        if problem:
            raise SystemExit(problem)
        found: dict[str, int] = {}
        for _turn in range(PRINTS):
            printed = _printed(browser)
            if places(printed) == found:
                return printed
            found = places(printed)
            browser.execute_script("window.paginate(arguments[0])", found)
    raise SystemExit("The pages of the book do not come to rest.")


def main() -> None:
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    options.add_argument("site", type=Path, help="folder of the built site")
    options.add_argument("out", type=Path, help="PDF to write")
    options.add_argument("--language", choices=LANGUAGES, default="en")
    given = options.parse_args()
    code = given.language
    given.out.write_bytes(book(given.site, chapters(code), terms(code), code))


if __name__ == "__main__":
    main()
