"""Makes the generated part of the documentation while mkdocs builds: a page of cards per domain in both
languages, and the plots and tables of the theory pages, which name them as ``[[validation NAME]]``,
``[[printed DOMAIN]]``, ``[[chart CARD name=value]]``, ``[[card CARD]]``, ``[[source MODULE NAME]]`` or
``[[include FILE]]``. Everything comes from the registry and from data of the repository; a name that does not
exist ends the build.
"""

from __future__ import annotations

import html
import importlib
import inspect
import json
import math
import os
import posixpath
import re
import tempfile
from importlib.resources import files
from pathlib import Path
from typing import Any

# Pages compile much and compute little: plain code is ready sooner, here and in what is started from here.
os.environ.setdefault("XLA_FLAGS", "--xla_cpu_use_fusion_emitters=false --xla_backend_optimization_level=0")
# as in tests/conftest.py
os.environ.setdefault("JAX_COMPILATION_CACHE_DIR", str(Path(tempfile.gettempdir()) / "granum-compiled"))
os.environ.setdefault("JAX_PERSISTENT_CACHE_MIN_COMPILE_TIME_SECS", "0")

import chapters
import notebooks
import stills
import validation
from mkdocs.exceptions import PluginError
from mkdocs.structure.files import File

from granum.app.forms import bounds_text, range_text
from granum.app.shipped import chapter_code
from granum.core import registry
from granum.core.cards import Card
from granum.core.i18n import _, current_language, language, typographic
from granum.core.parameters import Parameter, default_as_json
from granum.core.units import decimal, pretty_unit
from granum.reports.mathml import mathml
from granum.reports.quantities import limit_rows, value_text
from granum.reports.stated import in_french_print, with_equations, with_numbers
from granum.reports.utilities import utility_rows

ROOT = Path(__file__).parent.parent
WORDS = {
    "en": [
        "Cards",
        "input",
        "symbol",
        "units",
        "allowed",
        "default",
        "required",
        "result",
        "Source",
        "covers",
        "Kind",
        "formula",
        "cards",
        "The chapter of the handbook",
    ],
    "fr": [
        "Fiches",
        "donnée",
        "symbole",
        "unités",
        "permis",
        "par défaut",
        "obligatoire",
        "résultat",
        "Source",
        "couvre",
        "Sorte",
        "formule",
        "fiches",
        "Le chapitre du manuel",
    ],
}
LETTERS = "stix-two-math.woff2"
FOLDERS = {"en": "cards", "fr": "cards-fr"}
DOMAIN_TITLES = {
    "en": {
        "materials": "Materials",
        "particles": "Particles",
        "porous": "Porous media",
        "humid_gas": "Humid gas",
        "streams": "Streams",
        "comminution": "Comminution and screening",
        "settling": "Settling",
        "cyclones": "Cyclones",
        "fluidization": "Fluidization",
        "conveying": "Conveying and hoppers",
        "filtration": "Filtration",
        "centrifuges": "Centrifuges",
        "crystallization": "Crystallization",
        "drying": "Drying",
        "dust": "Dust collection",
        "evaporation": "Evaporation",
        "studies": "Studies",
        "costs": "Costs",
    },
    "fr": {
        "materials": "Matériaux",
        "particles": "Particules",
        "porous": "Milieux poreux",
        "humid_gas": "Gaz humide",
        "streams": "Courants",
        "comminution": "Broyage et criblage",
        "settling": "Décantation",
        "cyclones": "Cyclones",
        "fluidization": "Fluidisation",
        "conveying": "Transport et trémies",
        "filtration": "Filtration",
        "centrifuges": "Centrifugation",
        "crystallization": "Cristallisation",
        "drying": "Séchage",
        "dust": "Dépoussiérage",
        "evaporation": "Évaporation",
        "studies": "Études",
        "costs": "Coûts",
    },
}


def on_config(config: Any) -> Any:
    """Calculate what the chapters state, and list the pages of cards in the navigation."""
    chapters.prepare()
    places = {f"{FOLDERS[code]}/index.md": code for code in FOLDERS}

    def filled(entry: Any) -> Any:
        if isinstance(entry, dict):
            return {title: filled(item) for title, item in entry.items()}
        if isinstance(entry, list):
            return [filled(item) for item in entry]
        code = places.get(entry)
        return (
            [entry, *({DOMAIN_TITLES[code][d]: f"{FOLDERS[code]}/{d}.md"} for d in _domains())]
            if code
            else entry
        )

    config["nav"] = filled(config["nav"])
    return config


def _domains() -> list[str]:
    return [domain for domain in registry.DOMAINS if registry.everything((domain,))]


def on_files(files_: Any, config: Any) -> Any:
    """Add the generated pages, guides as notebooks, Plotly as its Python package ships it, and the letters of
    equations that the app has.
    """
    for code in ("en", "fr"):
        with language(code):
            pages = _card_pages(code)
        for name, text in pages.items():
            files_.append(File.generated(config, f"{FOLDERS[code]}/{name}.md", content=text))
    for name in notebooks.PAGES:
        found = notebooks.notebook((ROOT / "docs" / f"{name}.md").read_text(encoding="utf-8"))
        text = json.dumps(found, ensure_ascii=False, indent=1)
        files_.append(File.generated(config, f"{name}.ipynb", content=text))
    plotly = files("plotly") / "package_data" / "plotly.min.js"
    letters = files("granum") / "app" / "static" / "vendor" / LETTERS
    for place in (plotly, letters):
        files_.append(File.generated(config, f"assets/{place.name}", abs_src_path=str(place)))
    return files_


def on_post_page(output: str, page: Any, **_more: Any) -> str:
    """A page in French says so, to whoever reads it aloud."""
    french = page.file.src_uri.startswith(("fr/", FOLDERS["fr"]))
    return output.replace('<html lang="en"', '<html lang="fr"', 1) if french else output


def on_page_markdown(markdown: str, page: Any, **_more: Any) -> str:
    """Replace ``[[word name …]]`` on a line of its own; in a chapter of the handbook also what it states."""
    place = page.file.src_uri
    code = "fr" if place.startswith("fr/") else "en"
    domain = Path(place).stem
    if code == "fr":
        markdown = in_french_print(markdown)
    if place == chapters.PLACES[code].format(domain) and domain in chapters.domains():
        markdown = _chapter(markdown, domain, code)

    def to_card(found: re.Match[str]) -> str:
        card = registry.find(found[2]).card
        there = f"{FOLDERS[code]}/{card.domain}.md"
        return f"[{found[1]}]({posixpath.relpath(there, posixpath.dirname(place))}#{_anchor(card)})"

    markdown = re.sub(r"\[([^\]]+)\]\(card:([\w.]+)\)", to_card, markdown)

    def made(found: re.Match[str]) -> str:
        with language(code):
            return PARTS[found[1]](found[2])

    return re.sub(r"^\[\[(\w+) (.+?)\]\]$", made, markdown, flags=re.MULTILINE)


def _chapter(text: str, domain: str, code: str) -> str:
    """A chapter with its numbers, equations, figures and calculations; one that states what is no longer
    calculated ends the build.
    """
    if wrong := chapters.moved(domain, code):
        raise PluginError("\n".join(wrong))
    with language(code):
        text = with_equations(with_numbers(text))

    def drawn(found: re.Match[str]) -> str:
        data = chapters.figure(domain, found[1], code).replace("</", "<\\/")
        return _plot(data, found[2])

    text = chapters.FIGURE.sub(lambda m: drawn(m) + f"\n\n*{m[2]}*", text)
    return re.sub(
        r"^\[\[code (\w+)\]\]$",
        lambda m: f"```python\n{chapter_code(domain, m[1])}\n```",
        text,
        flags=re.M,
    )


# ---- parts of theory pages -------------------------------------------------------------------------
def _figure(figure: Any, label: str) -> str:
    return _plot(figure.to_json().replace("</", "<\\/"), label)


def _plot(data: str, label: str) -> str:
    return (
        f'<div class="plot" role="group" aria-label="{html.escape(label)}"><script '
        f'type="application/json">{data}</script>'
        f"<noscript>{html.escape(label)}</noscript></div>"
    )


def _moving(name: str) -> str:
    """A figure with its sliders, drawn beforehand where they stop."""
    drawn = chapters.frames(name.strip(), current_language()).replace("</", "<\\/")
    return (
        f'<div class="moving" data-figure="{html.escape(name)}"><div class="plot" role="group">'
        f'<script type="application/json">{drawn}</script>'
        f"<noscript>{stills.picture(json.loads(drawn))}</noscript></div></div>"
    )


def _validation(name: str) -> str:
    found = validation.FIGURES[name]()
    return f"{_figure(found.figure, found.caption)}\n\n*{found.caption}*\n\n{found.table}"


SAID_OF_PRINTED = {
    "en": (
        "{n} numbers that books and papers print are calculated again while this page is made: half of them "
        "agree within {half} %, all within {all} %.",
        "| worked example | printed | Granum | difference |",
    ),
    "fr": (
        "{n} nombres imprimés dans des livres et des articles sont recalculés quand cette page est faite : "
        "la moitié s’accordent à {half} % près, tous à {all} % près.",
        "| exemple traité | imprimé | Granum | écart |",
    ),
}


def _rounded_up(percent: float) -> float:
    """To two digits, not below a hundredth."""
    step = max(0.01, 10.0 ** (math.floor(math.log10(max(percent, 0.01))) - 1))
    return math.ceil(round(max(percent, 0.01) / step, 6)) * step


def _printed(domain: str) -> str:
    """How the printed results of a domain compare, and all of them to unfold."""
    found = sorted(validation.printed(domain), key=lambda row: row.what)
    apart = sorted(100 * abs(row.difference) for row in found)
    told, head = SAID_OF_PRINTED[current_language()]
    half, most = (decimal(f"{_rounded_up(x):g}") for x in (apart[len(apart) // 2], apart[-1]))
    rows = [head, "|---|--:|--:|--:|"]
    for row in found:
        difference = typographic(decimal(f"{100 * row.difference:+.2g}"))
        rows.append(f"| {_escape(row.what)} | {row.printed} | {row.found} | {difference} % |")
    summary = told.format(n=len(found), half=half, all=most)
    return f'<details markdown="1"><summary>{summary}</summary>\n\n' + "\n".join(rows) + "\n\n</details>"


def _chart(text: str) -> str:
    key, *pairs = text.split(" ")
    thing = registry.find(key)
    return (
        _figure(thing(**dict(pair.split("=", 1) for pair in pairs)), thing.card.title)
        + f"\n\n*{thing.card.title}.*"
    )


def _one_card(key: str) -> str:
    card = registry.find(key.strip()).card
    place = f"../cards/{card.domain}.md#{card.name.replace('_', '-')}"
    return f"{_equation(card)}\n\n[{card.title}]({place}): {_escape(card.citation)}\n"


def _include(name: str) -> str:
    """A file of the repository without its first heading."""
    return (ROOT / name).read_text(encoding="utf-8").split("\n", 1)[1]


def _source(text: str) -> str:
    """The source of a class or function of the package."""
    module, name = text.split()
    return (
        f"```python\n{inspect.getsource(inspect.unwrap(getattr(importlib.import_module(module), name)))}```"
    )


PARTS = {
    "include": _include,
    "moving": _moving,
    "source": _source,
    "validation": _validation,
    "printed": _printed,
    "chart": _chart,
    "card": _one_card,
}


# ---- pages of cards --------------------------------------------------------------------------------
def _card_pages(code: str) -> dict[str, str]:
    words, pages, total = WORDS[code], {}, 0
    lines = []
    for domain in _domains():
        cards = [thing.card for thing in registry.everything((domain,)).values()]
        total += len(cards)
        title = DOMAIN_TITLES[code][domain]
        chapter = (
            f"[{words[13]}](../{chapters.PLACES[code].format(domain)})\n\n"
            if domain in chapters.domains()
            else ""
        )
        pages[domain] = f"# {title}\n\n{chapter}" + "\n".join(
            part for name, found in _by_module(cards) for part in _room(name, found, words)
        )
        lines.append(f"* [{title}]({domain}.md): {len(cards)} {words[12]}")
    pages["index"] = f"# {words[0]}\n\n{total} {words[12]}.\n\n" + "\n".join(lines) + "\n"
    return pages


def _by_module(cards: list[Card]) -> list[tuple[str, list[Card]]]:
    rooms: dict[str, list[Card]] = {}
    for card in cards:
        rooms.setdefault(card.module, []).append(card)
    return sorted(rooms.items(), key=lambda room: ("formulas" not in room[0], "charts" in room[0], room[0]))


def _room(module: str, cards: list[Card], words: list[str]) -> list[str]:
    """One section per file of the package."""
    parts = module.split(".")[2:]
    title = parts[-1].replace("_", " ").capitalize()
    if len(parts) > 1:
        title += f" · {parts[0].replace('_', ' ')}"
    return [f"## {title}\n", *(_section(card, words) for card in cards)]


def _section(card: Card, words: list[str]) -> str:
    anchor = _anchor(card)
    parts = [
        f"### {_escape(card.title)} {{ #{anchor} }}\n",
        f"`{card.key}` · {_(card.sort)}\n",
        _escape(card.summary) + "\n",
    ]
    if card.equation:
        parts.append(_equation(card) + "\n")
    if card.parameters:
        parts.append(_inputs(card, words))
    if card.outputs:
        shown = "; ".join(f"{html.escape(p.label)} {_symbol(p)}{_unit(p)}" for p in card.outputs)
        parts.append(f"<p><strong>{words[7]}</strong>: {shown}</p>\n")
    if card.limits:
        rows = "".join(
            f"<tr><td>{html.escape(r.name)}</td><td>{html.escape(r.allowed)}</td><td>{html.escape(r.source)}</td></tr>"
            for r in limit_rows(card)
        )
        head = "".join(f"<th>{word}</th>" for word in (_("practical limit"), _("allowed"), _("source")))
        parts.append(f"<table class='limits'><thead><tr>{head}</tr></thead><tbody>{rows}</tbody></table>\n")
    if card.utilities:
        rows = "".join(
            f"<tr><td>{html.escape(label)}</td><td>{html.escape(source)}</td></tr>"
            for label, source in utility_rows(card)
        )
        head = "".join(f"<th>{word}</th>" for word in (_("utility"), _("source")))
        parts.append(f"<table class='limits'><thead><tr>{head}</tr></thead><tbody>{rows}</tbody></table>\n")
    for name, limits in card.fitted.items():
        p = next((p for p in (*card.parameters, *card.outputs) if p.name == name), None)
        text = range_text(p, limits) if p else " … ".join(f"{x:g}" for x in limits)
        parts.append(
            f"<p>{words[8]} {words[9]}: {html.escape(p.label if p else name.replace('_', ' '))} "
            f"{html.escape(text)}</p>\n"
        )
    parts.append(f"<p class='source'>{words[8]}: {html.escape(card.citation)}</p>\n")
    rest = card.doc.split("\n\n", 1)[1] if "\n\n" in card.doc else ""
    if rest:
        parts.append(
            f"<details><summary>{'Example and remarks' if words is WORDS['en'] else 'Exemple et remarques'}</summary><pre lang='en'><code>{html.escape(rest)}</code></pre></details>\n"  # noqa: E501
        )
    return "\n".join(parts)


def _anchor(card: Card) -> str:
    return card.name.replace("_", "-")


def _inputs(card: Card, words: list[str]) -> str:
    rows = []
    for p in card.parameters:
        allowed = ", ".join(map(str, p.choices)) if p.choices else bounds_text(p)
        if p.law:
            allowed = f"{_('law')}: {p.law.replace('_', ' ')}"
        if p.fitted:
            allowed += f" ({words[9]} {range_text(p, p.fitted)})"
        default = words[6] if p.required else ("—" if p.default is None else _default(p))
        units = ", ".join(pretty_unit(u) or "1" for u in p.units[:4])
        rows.append(
            f"<tr><td><code>{p.name}</code><br>{html.escape(p.label)}</td><td>{_symbol(p)}</td><td>{html.escape(units)}</td>"
            f"<td>{html.escape(allowed)}</td><td>{html.escape(default)}</td></tr>"
        )
    head = "".join(f"<th>{word}</th>" for word in words[1:6])
    return f"<table class='inputs'><thead><tr>{head}</tr></thead><tbody>{''.join(rows)}</tbody></table>\n"


def _default(p: Parameter) -> str:
    return value_text(p.default, p) if p.kind else str(default_as_json(p.default))


def _unit(p: Parameter) -> str:
    return f" / {pretty_unit(p.units[0])}" if p.units and pretty_unit(p.units[0]) else ""


def _symbol(p: Parameter) -> str:
    return mathml(p.term.symbol) if p.term and p.term.symbol else ""


def _equation(card: Card) -> str:
    return f'<div class="equation">{mathml(card.equation, display=True)}</div>' if card.equation else ""


def _escape(text: str) -> str:
    """Plain text in Markdown: characters with a meaning are escaped."""
    return re.sub(r"([\\`*_\[\]<>#|])", r"\\\1", text)
