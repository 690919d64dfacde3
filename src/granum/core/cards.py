"""Cards: the public face of a formula, a lab test, a law or a piece of equipment, as data."""

from __future__ import annotations

import unicodedata
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from typing import Any

from granum.core.docstrings import written_doc
from granum.core.glossary import ending, quantity_in, term
from granum.core.i18n import _
from granum.core.limits import Limit
from granum.core.parameters import Parameter

Ranges = Mapping[str, tuple[float, float]]


@dataclass(frozen=True)
class Card:
    """What every front door knows about a declared thing.

    Parameters
    ----------
    key: ``domain.name``, as typed on the command line.
    sort: ``formula``, ``law``, ``lab test`` or ``equipment``.
    parameters, outputs: what goes in and what comes out.
    source: key in ``references`` with equation, table or page.
    equation: LaTeX.
    family: what it can be passed as, for laws (``drag_coefficient``).
    limits: practical limits, for equipment.
    arguments: what a law is called with, besides the parameters that it is made of.
    """

    key: str
    sort: str
    parameters: tuple[Parameter, ...]
    outputs: tuple[Parameter, ...]
    source: str
    equation: str
    fitted: Ranges
    family: str
    given_title: str
    doc: str
    module: str
    limits: tuple[Limit, ...] = ()
    arguments: tuple[Parameter, ...] = ()

    @property
    def domain(self) -> str:
        """First part of the key."""
        return self.key.split(".", 1)[0]

    @property
    def name(self) -> str:
        """Second part of the key."""
        return self.key.split(".", 1)[1]

    @property
    def title(self) -> str:
        """Title in the current language: as declared, else the glossary label with the author of the
        correlation.
        """
        if self.given_title:
            return _(self.given_title)
        word = quantity_in(self.name)
        if word is None:
            return self.name.replace("_", " ").capitalize()
        label = term(word).label
        rest = self.name[len(word) :].strip("_")
        label = label[0].upper() + label[1:]
        return f"{label} ({ending(rest)})" if rest else label

    @property
    def summary(self) -> str:
        """First sentence of the docstring, in the current language."""
        return _(self.english_summary)

    @property
    def english_summary(self) -> str:
        """First paragraph of the docstring."""
        return " ".join(self.doc.split("\n\n", 1)[0].split())

    @property
    def other_names(self) -> str:
        """Other names, in either language, of what it is about and what it gives."""
        words = dict.fromkeys(map(quantity_in, (self.name, self.family, *(p.name for p in self.outputs))))
        return ", ".join(dict.fromkeys(name for word in words if word for name in term(word).also))

    def answers(self, words: Iterable[str]) -> bool:
        """Whether all words stand in key, title, summary or other names; case and accents do not count."""
        text = plain(f"{self.key} {self.title} {self.summary} {self.other_names}")
        return all(plain(word) in text for word in words)

    @property
    def citation(self) -> str:
        """The source spelled out."""
        from granum.core.sources import cite

        return cite(self.source)

    @property
    def inputs(self) -> dict[str, Parameter]:
        """By name all that must be known for a value: of a law what it is called with and what it is made
        of.
        """
        return {p.name: p for p in (*self.arguments, *self.parameters)}

    def parameter(self, name: str) -> Parameter:
        """One input or output by name."""
        return next(p for p in (*self.inputs.values(), *self.outputs) if p.name == name)

    def as_json(self) -> dict[str, Any]:
        """The card as plain data in the current language."""
        return {
            "card": self.key,
            "sort": self.sort,
            "domain": self.domain,
            "title": self.title,
            "summary": self.summary,
            "parameters": [p.as_json() for p in self.parameters],
            "arguments": [p.as_json() for p in self.arguments],
            "outputs": [p.as_json() for p in self.outputs],
            "equation": self.equation,
            "source": self.source,
            "citation": self.citation,
            "fitted": {k: [float(a), float(b)] for k, (a, b) in self.fitted.items()},
            "family": self.family,
            "limits": [limit.as_json() for limit in self.limits],
            "doc": self.doc,
        }


def domain_of(module: str) -> str:
    """The domain of a module: ``granum.particles.formulas.drag`` → ``particles``."""
    parts = module.split(".")
    return parts[1] if parts[0] == "granum" and len(parts) > 1 else "user"


def key_of(thing: Any, name: str) -> str:
    """``domain.name`` of a function or class."""
    return f"{domain_of(thing.__module__)}.{name}"


def make_card(
    thing: Callable[..., Any],
    name: str,
    sort: str,
    *,
    parameters: tuple[Parameter, ...],
    outputs: tuple[Parameter, ...],
    source: str,
    equation: str = "",
    fitted: Ranges | None = None,
    family: str = "",
    title: str = "",
    limits: tuple[Limit, ...] = (),
    arguments: tuple[Parameter, ...] = (),
) -> Card:
    """The card of a declared function or class."""
    return Card(
        key=key_of(thing, name),
        sort=sort,
        parameters=parameters,
        outputs=outputs,
        source=source,
        equation=equation,
        fitted=fitted or {},
        family=family,
        given_title=title,
        doc=written_doc(thing),
        module=thing.__module__,
        limits=limits,
        arguments=arguments,
    )


def plain(text: str) -> str:
    """Small letters without accents, by which texts are compared in a search."""
    apart = unicodedata.normalize("NFD", text.lower())
    return "".join(letter for letter in apart if not unicodedata.combining(letter))
