"""Parameters: one argument of a card, and the conversion of whatever a user passes for it."""

from __future__ import annotations

import inspect
import types
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Annotated, Any, Literal, Union, get_args, get_origin, get_type_hints

import numpy as np

from granum.core import units
from granum.core.glossary import Term, ending, glossary
from granum.core.kinds import Kind, Law, Series, Within, extra_of, kind_of

REQUIRED = inspect.Parameter.empty
COLDEST = 150.0  # K: colder than any operation here, warmer than any Celsius number that forgot its unit
_LARGEST_SHARE = 5.0  # usual value beyond which a plain number is offered no percent


@dataclass(frozen=True)
class Parameter:
    """One argument or one output of a card.

    Parameters
    ----------
    name: public name, a glossary word (or a glossary word with a suffix).
    kind: what quantity it is; None for choices, laws and plain values.
    default: its default, or ``REQUIRED``.
    series: what a vector argument runs over; None for a single value.
    law: family of the law expected; None for quantities.
    choices: allowed words of a choice.
    within: smallest and largest whole number.
    typical: range of ordinary values, SI.
    fitted: range over which the source holds, SI.
    own_symbol: LaTeX symbol on its card, where that of the glossary does not suit.
    """

    name: str
    kind: Kind | None = None
    default: Any = REQUIRED
    series: str | None = None
    law: str | None = None
    choices: tuple[Any, ...] = ()
    sort: type | None = None
    within: Within | None = None
    optional: bool = False
    typical: tuple[float, float] | None = None
    fitted: tuple[float, float] | None = None
    own_symbol: str = ""

    @property
    def required(self) -> bool:
        """Whether a value must be given."""
        return self.default is REQUIRED

    @property
    def may_be_none(self) -> bool:
        """Whether 'none' can be said of it though it has a value by default."""
        return self.optional and self.default is not None and not self.required

    @property
    def coldest(self) -> float | None:
        """The temperature below which a number has forgotten its unit; None for other kinds."""
        if self.kind is None or self.kind.name != "temperature":
            return None
        known = [
            COLDEST,
            *(self.fitted or ())[:1],
            *([self.default] if isinstance(self.default, float) else []),
        ]
        return min(known)

    @property
    def term(self) -> Term | None:
        """Its glossary entry."""
        from granum.core.glossary import quantity_in

        known = quantity_in(self.name)
        return glossary()[known] if known else None

    @property
    def label(self) -> str:
        """Its label in the current language."""
        found = self.term
        if found is None:
            return self.name.replace("_", " ")
        rest = self.name[len(found.name) :].strip("_")
        return f"{found.label} ({ending(rest)})" if rest else found.label

    @property
    def symbol(self) -> str:
        """Its symbol in LaTeX, as in the equation of its card; empty where it has none."""
        found = self.term
        return self.own_symbol or (found.symbol if found else "")

    @property
    def units(self) -> tuple[str, ...]:
        """Units to offer, the usual one first."""
        if self.kind is None:
            return ()
        found = self.term
        fits = (
            found is not None and found.unit is not None and units.same_dimension(found.unit, self.kind.unit)
        )
        usual = (found.unit,) if found and found.unit and fits else ()
        # a Reynolds number or a number of bends is no share, though it has no dimension
        shares = (
            self.kind.name != "ratio"
            or found is None
            or found.unit == "percent"
            or found.typical[1] <= _LARGEST_SHARE
        )
        offered = usual + tuple(u for u in self.kind.units if u not in usual and (shares or u != "percent"))
        printed: dict[str, str] = {}
        for u in offered:
            printed.setdefault(units.pretty_unit(u), u)
        return tuple(printed.values())  # none that reads as one before it

    def display_unit(self, values: Any) -> str:
        """The unit in which SI values of this quantity are shown; empty for what is no quantity."""
        return (
            units.display_unit(values, self.kind, self.term.unit if self.term else None) if self.kind else ""
        )

    def ordinary(self) -> tuple[float, float]:
        """The range tests and forms draw from: declared, else the glossary's, cut to the fitted range and the
        bounds.
        """
        low, high = self.typical or (self.term.typical if self.term else (0.1, 1.0))
        if self.fitted and not self.typical:
            low, high = max(low, self.fitted[0]), min(high, self.fitted[1])
            if low >= high:
                low, high = self.fitted
        return low, high

    def as_json(self) -> dict[str, Any]:
        """The declaration as plain data, for forms and documentation."""
        row: dict[str, Any] = {
            "name": self.name,
            "label": self.label,
            "symbol": self.symbol,
        }
        if self.kind:
            row |= {
                "kind": self.kind.name,
                "unit": self.kind.unit,
                "units": [{"unit": u, "label": units.pretty_unit(u)} for u in self.units],
                "lower": None if self.kind.lower == -np.inf else self.kind.lower,
                "upper": None if self.kind.upper == np.inf else self.kind.upper,
                "open_lower": self.kind.open_lower,
                "open_upper": self.kind.open_upper,
                "typical": list(self.ordinary()),
                "fitted": [None if abs(x) == np.inf else x for x in self.fitted] if self.fitted else None,
            }
        if self.series:
            row["series"] = self.series
        if self.law:
            row["law"] = self.law
        if self.choices:
            row["choices"] = list(self.choices)
        if self.sort:
            row["sort"] = self.sort.__name__
        if self.within:
            row |= {"lower": int(self.within.lower), "upper": int(self.within.upper)}
        row["required"] = self.required
        if not self.required:
            row["default"] = default_as_json(self.default)
        return row


def default_as_json(value: Any) -> Any:
    """A default as plain data: numbers and words as they are, laws by name."""
    if value is None or isinstance(value, (bool, int, float, str)):
        return value
    if hasattr(value, "card"):
        return value.card.name
    if isinstance(value, np.ndarray):
        return value.tolist()
    if isinstance(value, (list, tuple)):
        return [default_as_json(item) for item in value]
    return str(value)


def parameter_of(name: str, annotation: Any, default: Any, **ranges: Any) -> Parameter:
    """The parameter that an annotation declares."""
    optional = False
    if get_origin(annotation) in (Union, types.UnionType):
        arms = [arm for arm in get_args(annotation) if arm is not type(None)]
        optional = len(arms) < len(get_args(annotation))
        annotation = arms[0] if len(arms) == 1 else annotation
    choices = get_args(annotation) if get_origin(annotation) is Literal else ()
    series, law = extra_of(annotation, Series), extra_of(annotation, Law)
    sort = annotation if annotation in (bool, int, str) else None
    if get_origin(annotation) is Annotated and get_args(annotation)[0] in (bool, int, str):
        sort = get_args(annotation)[0]
    return Parameter(
        name=name,
        kind=kind_of(annotation),
        default=default,
        series=series.along if series else None,
        law=law.family if law else None,
        choices=choices,
        sort=sort,
        within=extra_of(annotation, Within) if sort is int else None,
        optional=optional,
        **ranges,
    )


def parameters_of(
    function: Callable[..., Any],
    fitted: Mapping[str, tuple[float, float]],
    typical: Mapping[str, tuple[float, float]],
) -> tuple[Parameter, ...]:
    """The parameters of a function, from its annotations and defaults."""
    # The return annotation is left out: that of a chart names a Plotly type which only the type checker
    # imports.
    inputs = type(
        "Inputs",
        (),
        {"__annotations__": {k: v for k, v in function.__annotations__.items() if k != "return"}},
    )
    hints = get_type_hints(inputs, globalns=inspect.unwrap(function).__globals__, include_extras=True)
    return tuple(
        parameter_of(
            name, hints.get(name, Any), found.default, fitted=fitted.get(name), typical=typical.get(name)
        )
        for name, found in inspect.signature(function).parameters.items()
    )


def outputs_of(
    annotation: Any, name: str, fitted: Mapping[str, tuple[float, float]]
) -> tuple[Parameter, ...]:
    """The outputs a return annotation declares: one quantity, or the fields of a named tuple."""
    if isinstance(annotation, type) and issubclass(annotation, tuple) and hasattr(annotation, "_fields"):
        hints = get_type_hints(annotation, include_extras=True)
        return tuple(parameter_of(f, hints[f], REQUIRED, fitted=fitted.get(f)) for f in annotation._fields)
    return (parameter_of(name, annotation, REQUIRED, fitted=fitted.get(name)),)
