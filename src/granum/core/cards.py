"""Cards: the public face of a formula, a lab test, a law or a piece of equipment, as data."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

from granum.core.docstrings import written_doc
from granum.core.index import Entry, entries
from granum.core.limits import Limit
from granum.core.parameters import Parameter
from granum.core.utilities import Use

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
    limits: practical limits, utilities: what is taken from outside, for equipment.
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
    attribute: str
    limits: tuple[Limit, ...] = ()
    arguments: tuple[Parameter, ...] = ()
    utilities: tuple[Use, ...] = ()

    @cached_property
    def entry(self) -> Entry:
        """Its line of the index."""
        return Entry(
            key=self.key,
            sort=self.sort,
            family=self.family,
            given_title=self.given_title,
            english_summary=" ".join(self.doc.split("\n\n", 1)[0].split()),
            gives=" ".join(p.name for p in self.outputs),
            module=self.module,
            attribute=self.attribute,
            source=self.source,
        )

    @property
    def domain(self) -> str:
        """First part of the key."""
        return self.entry.domain

    @property
    def name(self) -> str:
        """Second part of the key."""
        return self.entry.name

    @property
    def title(self) -> str:
        """Title in the current language."""
        return entries().get(self.key, self.entry).title

    @property
    def summary(self) -> str:
        """First sentence of the docstring, in the current language."""
        return self.entry.summary

    @property
    def citation(self) -> str:
        """The source spelled out."""
        from granum.core.sources import cite

        return cite(self.source)

    @property
    def inputs(self) -> dict[str, Parameter]:
        """By name all that must be known for a value: of a law what it is called with and what it is made
        of. What is both is called with: the law alone has nobody else to ask.
        """
        called = {p.name: p for p in self.arguments}
        return called | {p.name: p for p in self.parameters if p.name not in called}

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
            "utilities": [use.as_json() for use in self.utilities],
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
    symbols: Mapping[str, str] | None = None,
    utilities: tuple[Use, ...] = (),
) -> Card:
    """The card of a declared function or class.

    ``symbols`` by name where those of the glossary do not suit; ``=name`` for a result that bears the name of
    an input.
    """
    own = symbols or {}
    parameters, arguments = (
        tuple(replace(p, own_symbol=own.get(p.name, "")) for p in group) for group in (parameters, arguments)
    )
    outputs = tuple(replace(p, own_symbol=own.get(f"={p.name}", own.get(p.name, ""))) for p in outputs)
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
        attribute=thing.__name__,
        limits=limits,
        arguments=arguments,
        utilities=utilities,
    )
