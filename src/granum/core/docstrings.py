"""What ``help()`` shows of a card: the docstring as written, then what is declared, worked out when it is
asked for.
"""

from __future__ import annotations

import inspect
from typing import TYPE_CHECKING, Any

import numpy as np

from granum.core.i18n import _
from granum.core.symbols import text_symbol
from granum.core.units import format_number, pretty_unit, show

if TYPE_CHECKING:
    from granum.core.cards import Card
    from granum.core.kinds import Kind
    from granum.core.parameters import Parameter


class CompletedDoc:
    """The ``__doc__`` of a declared class, or of the instances of ``Formula`` and ``Procedure``."""

    def __init__(self, written: str | None, of_instances: bool = False):
        self.written, self._of_instances = written, of_instances

    def __get__(self, instance: Any, owner: type | None = None) -> str | None:
        if self._of_instances:
            return self.written if instance is None else completed(instance.card)
        return completed((owner if instance is None else type(instance)).card)  # type: ignore[union-attr]


def written_doc(thing: Any) -> str:
    """The docstring as it stands in the source."""
    own = vars(thing).get("__doc__") if isinstance(thing, type) else thing.__doc__
    return inspect.cleandoc((own.written if isinstance(own, CompletedDoc) else own) or "")


def completed(card: Card) -> str:
    """Docstring, inputs, outputs, equation, ranges, source and errors of a card."""
    parts = [card.doc]
    if card.parameters:
        parts.append(_section(_("Parameters"), [_input(p) for p in card.parameters]))
    if card.arguments:
        parts.append(_section(_("Called with"), [_input(p) for p in card.arguments]))
    if card.outputs:
        parts.append(_section(_("Returns"), [_output(p) for p in card.outputs]))
    rest = []
    if card.equation:
        rest.append(f"{_('Equation')}: {card.equation}")
    if card.fitted:
        ranges = "; ".join(f"{name} {_end(low)} … {_end(high)}" for name, (low, high) in card.fitted.items())
        rest.append(f"{_('Range')}: {ranges} {_('(SI; beyond it the value is flagged)')}")
    for limit in card.limits:
        allowed = f"{_end(limit.low)} … {_end(limit.high)} {pretty_unit(limit.unit)}".strip()
        rest.append(f"{_('Practical limit')}: {_(limit.name)}, {allowed} ({limit.source})")
    rest.append(f"{_('Source')}: {card.citation}")
    rest.append(_("Errors: InputError for a value outside of its bounds."))
    return "\n\n".join((*parts, "\n".join(rest)))


def _section(title: str, rows: list[str]) -> str:
    return "\n".join((title, "-" * len(title), *rows))


def _end(value: float | str) -> str:
    return (
        value
        if isinstance(value, str)
        else ("−∞" if value < 0 else "∞")
        if np.isinf(value)
        else format_number(value)
    )


def _named(p: Parameter) -> list[str]:
    symbol = text_symbol(p.symbol)
    return [p.label + (f" {symbol}" if symbol else ""), pretty_unit(p.kind.unit) if p.kind else ""]


def _input(p: Parameter) -> str:
    from granum.core.parameters import default_as_json

    words = _named(p)
    if p.choices:
        words.append(_("one of {names}").format(names=", ".join(map(str, p.choices))))
    elif p.law:
        words.append(_("a law of the family {name}").format(name=p.law))
    elif p.within:
        words.append(f"{p.within.lower:.0f} … {p.within.upper:.0f}")
    elif p.kind:
        words.append(_allowed(p.kind))
    if not p.required and p.default is not None:
        shown = (
            show(p.default, p.kind)
            if p.kind and isinstance(p.default, float | int)
            else str(default_as_json(p.default))
        )
        words.append(_("by default {value}").format(value=shown))
    return f"{p.name}: " + ", ".join(filter(None, words))


def _allowed(kind: Kind) -> str:
    low, high = (show(end, kind) if np.isfinite(end) else "" for end in (kind.lower, kind.upper))
    above = (_("above {value}") if kind.open_lower else _("from {value}")).format(value=low) if low else ""
    below = (_("below {value}") if kind.open_upper else _("up to {value}")).format(value=high) if high else ""
    return " ".join(filter(None, (above, below)))


def _output(p: Parameter) -> str:
    return f"{p.name}: " + ", ".join(filter(None, _named(p)))
