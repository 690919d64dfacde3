"""Somebody who types whatever comes to mind, key by key, into whatever field; and what must hold after it."""

from __future__ import annotations

import math
import random
import re
from typing import Any
from urllib.parse import parse_qsl, urlsplit

import numpy as np

from granum.app.forms import card_form
from granum.core import registry
from granum.core.conversion import convert
from granum.core.errors import GranumError
from granum.core.parameters import Parameter
from granum.core.units import from_si, pretty_unit, to_si
from granum.core.written import interval
from granum.studies.intervals import spread_of

ODD = (
    "",
    "-",
    "e5",
    "1e",
    "--5",
    "1..2",
    "5 mm 3",
    "12 %",
    "-5",
    "0",
    "1e400",
    "1/2",
    "½",
    "1_000",
    "١٢",
    "５",
    "nan",
    "inf",
    "(5)",
    "[5]",
    "~5",
    "5±3",
    "5 ± 0.2 mm",
    "3-7",
    "10 20",
    "2;4",
    "0, 10, 20 °C",
    "= 5",
    "5 furlong",
    "5 kg",
    "439 cm2",
    "85 um",
    "20 °C",
    "-300 °C",
    "1 e3",
    "5.",
    "five",
    "1 1/2 in",
    "1\u202f200,5",
    "1,200",
    "5 %%",
    "5'",
    '5"',
    "{",
    "<b>5</b>",
    "5\u00a0m",
    "0 K",
    "5 mesh",
    "1e-400",
    "5 m m",
    "5 1",
)
RECORDED = """
    if (!window.answers) {
      window.answers = [];
      window.reads = 0;
      const sent = window.fetch;
      window.fetch = async (path, request) => {
        const read = String(path) === '/api/read';
        window.reads += read;
        const response = await sent(path, request).finally(() => { window.reads -= read; });
        if (read) window.reading = await response.clone().json();
        if (String(path).startsWith('/api/calc/') && response.ok) {
          const given = JSON.parse(request.body);
          const data = await response.clone().json();
          window.answers.push({ given, shown: data.shown.map((row) => [row.name, row.text]) });
        }
        return response;
      };
    }
"""
SEEN = """
    const fresh = (e) => !e.closest('.stale');
    return {
      outputs: [...document.querySelectorAll('[data-output]')].map((e) => [e.dataset.output, e.textContent, fresh(e)]),
      answers: window.answers, link: location.hash, busy: Boolean(document.querySelector('[aria-busy=true]')),
    };
"""  # noqa: E501


def ordinary(rng: random.Random, p: Parameter, language: str, menu: str) -> tuple[str, float]:
    """A text as somebody writes a value in the parameter's ordinary range, and the value it means beside a
    menu of units, SI.
    """
    assert p.kind is not None
    low, high = p.ordinary()
    unit = rng.choice(p.units)
    value = math.exp(rng.uniform(math.log(low), math.log(high))) if low > 0 else rng.uniform(low, high)
    number = float(f"{float(from_si(value, unit, p.kind)):.3g}")
    text = rng.choice((_plain, _scientific, _printed))(number)
    if rng.random() < (0.8 if language == "fr" else 0.2):
        text = text.replace(".", ",")
    if unit == "dimensionless":
        if rng.random() < 0.3 and p.kind.upper == 1.0:
            return f"{_plain(100 * number)}{rng.choice((' %', '%'))}".replace(".", rng.choice(".,")), float(
                _plain(100 * number)
            ) / 100
        return text, float(number) / (100.0 if menu in ("%", "percent") else 1.0)
    written = rng.choice((unit, pretty_unit(unit), pretty_unit(unit).replace("²", "2").replace("³", "3")))
    return f"{text}{' ' if written[0].isdigit() else rng.choice(('', ' '))}{written}", float(
        to_si(number, unit, p.kind)
    )


def _plain(number: float) -> str:
    text = f"{number:.12f}".rstrip("0").rstrip(".") if 1e-9 < abs(number) < 1e9 else f"{number:g}"
    return text if abs(number) > 1e-9 else f"{number:g}"


def _scientific(number: float) -> str:
    return f"{number:.3e}"


def _printed(number: float) -> str:
    text = _plain(number)
    return (
        text.replace("-", "\u2212")
        if abs(number) < 1000 or "." in text or "e" in text
        else f"{int(number):,}".replace(",", " ")
    )


class Typist:
    """Types into the fields of a card and looks at what the page makes of it."""

    def __init__(self, page: Any, seed: int):
        self.page, self.rng = page, random.Random(seed)
        self.log: list[str] = []

    def card(self, key: str, language: str) -> None:
        """Open a card in a language."""
        self.key, self.language = key, language
        self.page.open(f"calculate/{key}", language)
        self.page.browser.execute_script(RECORDED)
        self.page.browser.execute_script(
            "document.querySelectorAll('details.more').forEach((d) => (d.open = true))"
        )
        thing = registry.find(key).card
        shown = {
            row["name"] for row in card_form(key)["parameters"] if row.get("kind") and not row["options"]
        }
        self.fields = [
            p for p in thing.parameters if p.name in shown and self.page.all(f"input#field-{p.name}")
        ]

    def turn(self) -> None:
        """One text into one field, and all that must hold while and after it is typed."""
        p = self.rng.choice(self.fields)
        menu = self.page.browser.execute_script(
            "return document.querySelector(arguments[0])?.value ?? ''", f"input#field-{p.name} ~ select"
        )
        text, value = (
            ordinary(self.rng, p, self.language, menu)
            if self.rng.random() < 0.6
            else (self.rng.choice(ODD), None)
        )
        self.log.append(f"{self.key} {self.language} {p.name} {text!r}")
        self.page.browser.execute_script("window.answers.length = 0; window.reading = {}")
        field = self.page.type(f"input#field-{p.name}", text)
        self.read()
        read = self.page.browser.execute_script("return window.reading")
        refused = "problem" in read
        told = field.get_attribute("aria-invalid") == "true"
        echo = [e.text for e in field.find_elements("xpath", "ancestor::*[@class='quantity']//*[@data-echo]")]
        assert told or not refused, "what is refused is said"
        assert echo == ([f"= {read['shown']}"] if read.get("shown") and not told else []), (
            f"{text!r} is echoed {echo}, understood was {read}"
        )
        self.consistent(told)
        before = None if refused or not text.strip() else self.understood(p)
        if value is not None and before is not None:
            assert _close(before, (value,)), f"{text!r} became {before}, meant was {value}"
        menu = self.page.leave(field)[1]
        assert not re.match(r"(?!1/)[\d.,-]", menu), f"a menu offers {menu!r}"
        if refused:
            assert field.get_attribute("value") == text, "what is not understood stays as it was typed"
        elif before is not None:
            assert _close(self.understood(p), before), (
                f"{text!r} was {before}, after the field was left {self.understood(p)}"
            )
        self.consistent(told)
        if told and self.rng.random() < 0.7:
            self.page.button("Undo" if self.language == "en" else "Annuler").click()
            self.page.settle()

    def read(self) -> None:
        """Wait until the server has said what it makes of the text, and of the inputs."""
        waited = "setTimeout(arguments[0], 90)"  # a page asks a moment after the last key
        self.page.browser.execute_async_script(waited)
        self.page.until(lambda: self.page.browser.execute_script("return window.reads === 0"))
        self.page.settle()

    def understood(self, p: Parameter) -> tuple[float, ...]:
        """The values that the link carries for a field, SI."""
        values = dict(parse_qsl(urlsplit(self.page.browser.current_url).fragment.partition("?")[2]))
        within = interval(values[p.name])
        if within is not None:
            spread = spread_of(p, *within)
            return spread.low, spread.high
        found = convert(values[p.name], p, several=True)
        return tuple(float(x) for x in np.atleast_1d(found))

    def consistent(self, refused: bool) -> None:
        """What stands there as a result is the answer to what stands in the fields."""
        seen = self.page.browser.execute_script(SEEN)
        fresh = [(name, text) for name, text, current in seen["outputs"] if current]
        assert not (refused and fresh), f"{fresh} beside a field that is refused"
        if not fresh or not seen["answers"]:
            return
        values = dict(parse_qsl(urlsplit(seen["link"]).fragment.partition("?")[2]))
        last = seen["answers"][-1]
        given = {name: text for name, text in last["given"].items() if text}
        assert _same(given, values, registry.find(self.key).card.parameters), (
            f"result of {given}, on the screen is {values}"
        )
        texts = {name: text.replace("\u00a0", " ") for name, text in last["shown"]}
        assert all(text.replace("\u00a0", " ") == texts[name] for name, text in fresh if name in texts)


def _close(one: tuple[float, ...], other: tuple[float, ...]) -> bool:
    return len(one) == len(other) and bool(np.allclose(one, other, rtol=1e-9, atol=0.0))


def _same(one: dict[str, str], other: dict[str, str], parameters: tuple[Parameter, ...]) -> bool:
    """Whether two sets of inputs mean the same."""
    if set(one) != set(other):
        return False
    for p in parameters:
        if p.name in one and one[p.name] != other[p.name]:
            try:
                if not np.array_equal(
                    convert(one[p.name], p, several=True), convert(other[p.name], p, several=True)
                ):
                    return False
            except (GranumError, ValueError):
                return False
    return True


def complaints(browser: Any) -> list[str]:
    """What the browser has to say but refusals."""
    found = [e["message"] for e in browser.get_log("browser") if e["level"] in ("SEVERE", "WARNING")]
    return [text for text in found if "status of 422" not in text and "status of 409" not in text]
