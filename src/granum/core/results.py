"""The result of evaluating a card: values, flags and the card, with its plain-data form."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from granum.core import notebooks
from granum.core.cards import Card
from granum.core.errors import ApplicabilityError
from granum.core.flags import OUTSIDE_DOMAIN, WORDS, Record, bits
from granum.core.given import shown
from granum.core.i18n import _
from granum.core.notices import describe
from granum.core.parameters import Parameter, default_as_json
from granum.core.units import format_number, from_si, pretty_unit, show

if TYPE_CHECKING:
    import pandas as pd


def plain(value: Any) -> Any:
    """Arrays as nested lists, zero-dimensional ones as floats, NaN as None (JSON has no NaN)."""
    array = np.asarray(value, dtype=float)
    if array.ndim == 0:
        return float(array) if np.isfinite(array) else None
    return [plain(item) for item in array]


def quantity_json(value: Any, parameter: Parameter) -> Any:
    """One value in the ``{"value", "unit"}`` shape, SI base units; choices and laws by name."""
    if parameter.kind is None or value is None:
        return {"value": default_as_json(value), "unit": ""}
    unit = "K" if parameter.kind.unit == "delta_degC" else parameter.kind.unit
    return {"value": plain(value), "unit": unit}


def _shown(value: Any, parameter: Parameter) -> str:
    """A value with its unit in one line; of a column the first few."""
    if parameter.kind is None or value is None:
        return shown(str(default_as_json(value)))
    if np.ndim(value) == 0:
        return show(float(value), parameter.kind, parameter.display_unit(value))
    unit, items = parameter.display_unit(value), np.ravel(np.asarray(value, dtype=float))
    row = " ".join(format_number(float(x)) for x in np.ravel(from_si(items[:8], unit, parameter.kind)))
    more = " …" * (items.size > 8)
    return f"[{row}{more}] {pretty_unit(unit)}".strip()


@dataclass(frozen=True, repr=False)
class Result:
    """What a card gave for one set of inputs.

    Parameters
    ----------
    card: the card that was evaluated.
    inputs: SI values by name, defaults included.
    value: bare value, or a named tuple of values.
    flags: int32 bits in the shape of the result (see ``granum.core.flags``).
    notices: one record per raised flag: what, how many, worst value, range, sentence.
    defaults: names of the inputs that were not given and took their default.
    origins: of inputs that a stated fluid gave, which it was.
    beside: numbers that the calculation went through, such as a Reynolds number, with the range that a source
        states for each.
    """

    card: Card
    inputs: dict[str, Any]
    value: Any
    flags: np.ndarray
    notices: list[dict[str, Any]] = field(default_factory=list)
    defaults: frozenset[str] = frozenset()
    origins: dict[str, str] = field(default_factory=dict)
    beside: list[dict[str, Any]] = field(default_factory=list)

    @property
    def outputs(self) -> dict[str, Any]:
        """Values by output name."""
        if len(self.card.outputs) == 1 and not hasattr(self.value, "_fields"):
            return {self.card.outputs[0].name: self.value}
        return dict(zip((p.name for p in self.card.outputs), self.value, strict=True))

    def told(self, records: list[Record]) -> Result:
        """The same result with what was flagged of its inputs, such as a fluid outside its data."""
        raised = self.flags | bits(records, np.shape(self.flags))
        return replace(self, flags=raised, notices=[*describe(records), *self.notices])

    @property
    def ranking(self) -> tuple[list[Parameter], list[tuple[Any, ...]]] | None:
        """Outputs that run side by side, such as names, marks and reasons of a choice, as rows; None when
        there are none.
        """
        columns = {p: list(value) for p in self.card.outputs if np.ndim(value := self.outputs[p.name]) == 1}
        if (
            len(columns) < 2
            or len({len(found) for found in columns.values()}) > 1
            or not any(p.kind is None for p in columns)
        ):
            return None
        return list(columns), list(zip(*columns.values(), strict=True))

    def __str__(self) -> str:
        rows = [f"{p.label} = {_shown(self.outputs[p.name], p)}" for p in self.card.outputs]
        return "\n".join([self.card.key, *rows, *(f"! {notice['message']}" for notice in self.notices)])

    def __repr__(self) -> str:
        return f"<{'; '.join(str(self).splitlines())}>"

    def _repr_html_(self) -> str:
        return notebooks.shown("granum.reports.terminal:print_result", self)

    def to_pandas(self) -> pd.DataFrame:
        """Inputs and results, one a row: role, value in SI, unit, label."""
        import pandas as pd

        groups = (("input", self.card.parameters, self.inputs), ("result", self.card.outputs, self.outputs))
        rows = [
            {"name": p.name, "role": role, **quantity_json(values[p.name], p), "label": p.label}
            for role, group, values in groups
            for p in group
        ]
        return pd.DataFrame(rows).set_index("name")

    def possible(self) -> Result:
        """The result itself; raises, with the first cause alone, when no element of it has a value."""
        none = all(np.all(np.isnan(np.asarray(x, dtype=float))) for x in self.outputs.values())
        if none or np.all(self.flags & np.int32(OUTSIDE_DOMAIN)):
            ranked = sorted(self.notices, key=lambda n: n["flag"] != WORDS[OUTSIDE_DOMAIN])
            cause = (
                ranked[0]["message"]
                if ranked
                else _("{card} gave no finite value.").format(card=self.card.key)
            )
            given = ", ".join(self._given())
            raise ApplicabilityError(
                cause + (" " + _("Given: {given}. Change one of these.").format(given=given) if given else "")
            )
        return self

    def _given(self) -> Iterator[str]:
        """The single numbers that are not defaults, as a reader would write them."""
        for p in self.card.parameters:
            value = self.inputs[p.name]
            if p.kind is not None and np.ndim(value) == 0 and value is not None and value is not p.default:
                yield f"{p.label} = {show(float(value), p.kind)}"

    def check(self) -> Any:
        """The bare value; raises when any element is impossible, not finite or not converged."""
        if np.any(self.flags & ~np.int32(1 | 16)):
            raise ApplicabilityError(
                " ".join(
                    n["message"] for n in self.notices if n["flag"] not in ("extrapolated", "limit active")
                )
                or _("{card} gave no finite value.").format(card=self.card.key)
            )
        return self.value

    def as_json(self) -> dict[str, Any]:
        """The stable ``calc`` shape; the rows of a ranking also one by one."""
        ranked = self.ranking
        rows = (
            {}
            if ranked is None
            else {
                "rows": [
                    {p.name: quantity_json(x, p) for p, x in zip(ranked[0], row, strict=True)}
                    for row in ranked[1]
                ]
            }
        )
        return {
            "card": self.card.key,
            "inputs": {
                p.name: quantity_json(self.inputs[p.name], p)
                | ({"default": True} if p.name in self.defaults else {})
                | ({"from": self.origins[p.name]} if p.name in self.origins else {})
                for p in self.card.parameters
            },
            "outputs": {p.name: quantity_json(self.outputs[p.name], p) for p in self.card.outputs},
            "beside": self.beside,
            "flags": self.notices,
            "source": self.card.source,
        } | rows
