"""Pages of the documentation, read in the app: Markdown as HTML, links between them kept."""

from __future__ import annotations

import html
import itertools
import re
from functools import cache
from typing import Any, NamedTuple
from urllib.parse import quote

from markdown_it import MarkdownIt

from granum.app.shipped import chapter_code, pages
from granum.core.errors import unknown_name
from granum.core.i18n import _, language
from granum.core.index import entries
from granum.reports.stated import in_french_print, with_equations, with_numbers

_HEADING = re.compile(r"^#+\s+(.+)$", re.MULTILINE)
_FENCE = re.compile(r"^```.*?^```", re.MULTILINE | re.DOTALL)
# figures that the app draws, and plots and tables that only the site makes
_MOVING = re.compile(r"^\[\[moving (\w+)\]\]$", re.MULTILINE)
_FIGURE = re.compile(r"^\[\[figure (\w+)\]\]$", re.MULTILINE)
_CODE = re.compile(r"^\[\[code (\w+)\]\]$", re.MULTILINE)
_MADE = re.compile(r"^\[\[\w+[^\]\n]*\]\]\s*$", re.MULTILINE)
_CARD = re.compile(r"\[\[card (\S+)\]\]")
# the name of the file that a fenced part shows or changes
_TITLED = re.compile(r'^```(\w+) title="([^"]+)"$', re.MULTILINE)
_LINK = re.compile(r"(?<!!)\[([^\]]+)\]\(([^)\s]+)\)")


_TO_CARD = re.compile(r"\]\(card:([\w.]+)\)")
CHAPTERS = ("handbook/", "fr/manuel/")


class Page(NamedTuple):
    """A page of the documentation."""

    name: str
    title: str
    language: str
    headings: tuple[str, ...]
    text: str


@cache
def page(name: str) -> Page:
    """A page by name."""
    if name not in pages():
        raise unknown_name(_("Page"), name, pages(), quantities=False)
    text = pages()[name].read_text(encoding="utf-8")
    headings = [found.replace("`", "") for found in _HEADING.findall(_FENCE.sub("", text))]
    code = "fr" if name.startswith("fr/") else "en"
    if name.startswith(CHAPTERS):
        with language(code):
            text = with_numbers(text)
    if code == "fr":
        text = in_french_print(text)
    return Page(name, headings[0] if headings else name, code, tuple(headings[1:]), text)


def _link_to(name: str, label: str, target: str) -> str:
    """A link of a page as one of the app; what the app does not hold stands as text."""
    if re.match(r"https?://", target):
        return f"[{label}]({target})"
    parts = [*name.split("/")[:-1], *target.partition("#")[0].removesuffix(".md").split("/")]
    while ".." in parts[1:]:
        at = parts.index("..", 1)
        del parts[at - 1 : at + 1]
    found = "/".join(parts)
    return f"[{label}](#/read/{quote(found, safe='')})" if found in pages() else label


def _as_code(text: str) -> str:
    return f'<pre><code class="language-python">{html.escape(text)}\n</code></pre>'


def _wide(head: str, number: int) -> str:
    """The beginning of a table that may be wider than the page, told apart from the others by its columns."""
    columns = ", ".join(re.sub("<[^>]*>", "", cell) for cell in re.findall("<th.*?>(.*?)</th>", head))
    label = _("table {number}: {columns}").format(number=number, columns=columns).replace('"', "&quot;")
    return f'<div class="wide" tabindex="0" role="region" aria-label="{label}"><table>'


def as_html(name: str) -> dict[str, Any]:
    """A page for reading: ``{"title", "language", "whole", "html"}``, whole where the site has no more."""
    found = page(name)
    known, domain = entries(), name.rpartition("/")[2]

    def of_card(match: re.Match[str]) -> str:
        card = known.get(match[1])
        with language(found.language):
            return f"[{card.title}](#/find/{quote(match[1], safe='')})" if card else ""

    made: list[str] = []

    def aside(equation: str) -> str:
        made.append(equation)
        return f"\ue000{len(made) - 1}\ue001"

    text = _MOVING.sub("\ue002\\1\ue003", found.text)
    if name.startswith(CHAPTERS):
        text = _CODE.sub("\ue005\\1\ue003", text)
        text = _FIGURE.sub("\ue004\\1\ue003", text)
    text = _CARD.sub(of_card, text)
    whole = not _MADE.search(text)
    text = _TITLED.sub(r"**`\2`**\n\n```\1", _MADE.sub("", text))
    text = _TO_CARD.sub(lambda m: f"](#/find/{quote(m[1], safe='')})", text)
    if name.startswith(CHAPTERS):
        text = with_equations(text, aside)
    text = _LINK.sub(lambda m: m[0] if m[2].startswith("#/") else _link_to(found.name, m[1], m[2]), text)
    shown = MarkdownIt("commonmark", {"html": False}).enable("table").render(text)
    shown = re.sub("\ue000(\\d+)\ue001", lambda m: made[int(m[1])], shown)
    shown = re.sub("<p>\ue002(\\w+)\ue003</p>", r'<div data-moving="\1"></div>', shown)
    shown = re.sub(
        "<p>\ue004(\\w+)\ue003</p>", rf'<div data-drawn="{found.language}/{domain}/\1"></div>', shown
    )
    shown = re.sub("<p>\ue005(\\w+)\ue003</p>", lambda m: _as_code(chapter_code(domain, m[1])), shown)
    count = itertools.count(1)
    shown = re.sub("<table>(?=(.*?)</tr>)", lambda m: _wide(m[1], next(count)), shown, flags=re.DOTALL)
    return {
        "title": html.unescape(found.title),
        "language": found.language,
        "whole": whole,
        "html": shown.replace("</table>", "</table></div>"),
    }
