"""``@law``, ``@equipment`` and ``@lab_test``: cards for frozen modules (Equinox classes), whose fields are
the parameters.
"""

from __future__ import annotations

import dataclasses
import functools
import inspect
import json
from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import Any, TypeVar, get_type_hints

import jax
import numpy as np

from granum.core import bounds, flags
from granum.core.cards import Card, Ranges, key_of, make_card
from granum.core.conversion import Binder, convert, is_tracer, not_a_specific_gravity
from granum.core.docstrings import CompletedDoc
from granum.core.i18n import _
from granum.core.notices import describe
from granum.core.parameters import REQUIRED, Parameter, outputs_of, parameter_of, parameters_of
from granum.core.registry import register
from granum.core.results import Result
from granum.core.utilities import Use
from granum.core.utilities import parameter as used

T = TypeVar("T")


class _LazyCard:
    """Builds the card of a class when it is first asked for."""

    def __init__(self, build: Callable[[], Card]):
        self._build = build
        self._card: Card | None = None

    def __get__(self, instance: Any, owner: type | None = None) -> Card:
        if self._card is None:
            self._card = self._build()
        return self._card


def field_parameters(cls: type, fitted: Ranges, typical: Ranges) -> tuple[Parameter, ...]:
    """The fields of a frozen module as parameters, in the order of its signature: what may only be named
    comes last.
    """
    hints = get_type_hints(cls, include_extras=True)
    found = []
    for item in sorted(dataclasses.fields(cls), key=lambda field: field.kw_only is True):
        if not item.init:
            continue
        default = item.default if item.default is not dataclasses.MISSING else REQUIRED
        if item.default_factory is not dataclasses.MISSING:
            default = item.default_factory()
        found.append(
            parameter_of(
                item.name,
                hints[item.name],
                default,
                fitted=fitted.get(item.name),
                typical=typical.get(item.name),
            )
        )
    return tuple(found)


def _declare(
    cls: type[T],
    name: str,
    sort: str,
    source: str,
    equation: str,
    fitted: Ranges,
    typical: Ranges,
    family: str,
    title: str,
    results: Callable[..., Any] | None,
    symbols: Mapping[str, str] | None = None,
) -> type[T]:
    def build() -> Card:
        outputs: tuple[Parameter, ...] = ()
        if results is not None:
            returned = get_type_hints(results, include_extras=True).get("return")
            if isinstance(returned, type) and hasattr(returned, "_fields"):
                outputs = outputs_of(returned, name, fitted)
            elif sort == "law":
                outputs = outputs_of(returned, family, fitted)
        arguments: tuple[Parameter, ...] = ()
        if sort == "law":
            arguments = tuple(p for p in parameters_of(cls.__call__, fitted, typical) if p.name != "self")  # type: ignore[operator]
        return make_card(
            cls,
            name,
            sort,
            parameters=field_parameters(cls, fitted, typical),
            outputs=outputs,
            arguments=arguments,
            source=source,
            equation=equation,
            fitted=fitted,
            family=family,
            title=title,
            limits=tuple(getattr(cls, "limits", {}).values()),
            symbols=symbols,
            utilities=tuple(Use(used(n), u) for n, u in getattr(cls, "utilities", {}).items()),
        )

    original = cls.__init__
    binder: list[Binder] = []

    @functools.wraps(original)
    def __init__(self: Any, *args: Any, **kwargs: Any) -> None:
        if not binder:
            binder.append(Binder.of(cls.card.key, cls.card.parameters))  # type: ignore[attr-defined]
        with flags.collect() as of_inputs:
            given, origins = binder[0].resolved(args, kwargs)
        if sort != "law":  # a bare number of a case file was typed, as that of a command is
            owner = _(" for {owner}").format(owner=cls.card.key)  # type: ignore[attr-defined]
            for p in cls.card.parameters:  # type: ignore[attr-defined]
                not_a_specific_gravity(given.get(p.name), p, owner)
        bound = binder[0].bind(args, given)
        binder[0].equally_long(list(bound.values()))
        original(self, **bound)
        if origins and sort == "lab test":
            object.__setattr__(self, "origins", tuple(origins.items()))
            object.__setattr__(self, "of_fluid", tuple(json.dumps(row) for row in describe(of_inputs)))

    type.__setattr__(cls, "card", _LazyCard(build))
    type.__setattr__(cls, "__init__", __init__)
    type.__setattr__(cls, "__doc__", CompletedDoc(cls.__doc__))
    register(cls, key_of(cls, name), family)
    return cls


def _checked(call: Callable[..., Any]) -> Callable[..., Any]:
    """A law's call, which tells where it leaves the ranges of its card and whose value is judged where nobody
    else does: on concrete numbers, outside of a formula.
    """
    names = tuple(inspect.signature(call).parameters)[1:]

    @functools.wraps(call)
    def checked(self: Any, *args: Any, **kwargs: Any) -> Any:
        out, card = call(self, *args, **kwargs), self.card
        if card.fitted and flags.listening():
            own = {p.name: getattr(self, p.name) for p in card.parameters}
            values = (
                own
                | dict(zip(names, args, strict=False))
                | kwargs
                | {p.name: value for p, value in bounds.figures(card.outputs, out)}
            )
            flags.ranged(card, {n: values[n] for n in card.fitted if values.get(n) is not None})
        if flags.nested() or any(map(is_tracer, jax.tree.leaves(out))):
            return out
        return bounds.judged(card.outputs, out, card.key, card.source)

    return checked


def _called(cls: Any, /, **inputs: Any) -> Any:
    """The value of this law for its parameters and the arguments of its call, all by name. Pure."""
    arguments = {p.name for p in cls.card.arguments}
    made = cls(**{name: value for name, value in inputs.items() if name not in arguments})
    return made(**{name: value for name, value in inputs.items() if name in arguments})


def _evaluate(cls: Any, /, **inputs: Any) -> Result:
    """The value of this law, as of a formula, for its parameters and the arguments of its call in any unit,
    with its flags and card.

    What it is called with may be arrays.
    """
    card = replace(cls.card, parameters=tuple(cls.card.inputs.values()), arguments=())
    binder = Binder.of(card.key, card.parameters)
    with flags.collect() as of_inputs:
        given, origins = binder.resolved((), inputs)
    where = _(" for {owner}").format(owner=card.key)
    rows = zip(card.parameters, binder.arrange((), given), strict=True)
    values = {p.name: convert(value, p, where, several=p in cls.card.arguments) for p, value in rows}
    with flags.collect() as records:
        out = _called(cls, **values)
    arrays = [np.shape(x) for x in jax.tree.leaves(out)]
    shape = arrays[0] if isinstance(out, tuple) else np.broadcast_shapes(*arrays)
    told = {"flags": flags.bits(records, shape), "notices": describe(records)}
    result = Result(card, values, out, **told, defaults=binder.left_out((), given), origins=origins)
    return result.told(of_inputs)


def law(
    family: str,
    *,
    source: str,
    name: str,
    equation: str = "",
    fitted: Ranges | None = None,
    typical: Ranges | None = None,
    title: str = "",
    symbols: Mapping[str, str] | None = None,
) -> Callable[[type[T]], type[T]]:
    """Declare a parametrized law: a frozen module whose fields are its parameters and whose call is the
    law.

    ``family`` is what it can be passed as, ``name`` its key; formulas declared with ``@formula`` may share
    the family. ``fitted`` are ranges over which the source holds, by parameter, argument of the call or
    result (the family's name), SI units. ``symbols`` are those of this equation by name, where the glossary's
    do not suit.
    """

    def declare(cls: type[T]) -> type[T]:
        if any("__call__" in vars(base) for base in cls.__mro__):
            several = inspect.unwrap(cls.__call__).__code__.co_argcount > 1
            type.__setattr__(cls, "__call__", _checked(cls.__call__))
            if several:
                type.__setattr__(cls, "called", classmethod(_called))
                type.__setattr__(cls, "evaluate", classmethod(_evaluate))
        return _declare(
            cls,
            name,
            "law",
            source,
            equation,
            fitted or {},
            typical or {},
            family,
            title,
            cls.__call__,
            symbols,
        )

    return declare


def equipment(
    name: str,
    *,
    source: str,
    title: str,
    equation: str = "",
    fitted: Ranges | None = None,
    typical: Ranges | None = None,
) -> Callable[[type[T]], type[T]]:
    """Declare a piece of equipment: a frozen ``Unit`` whose fields are its parameters and whose ``figures``
    its outputs.
    """
    return lambda cls: _declare(
        cls,
        name,
        "equipment",
        source,
        equation,
        fitted or {},
        typical or {},
        "",
        title,
        cls.figures,  # type: ignore[attr-defined]
    )


def lab_test(
    name: str,
    *,
    source: str,
    title: str,
    equation: str = "",
    fitted: Ranges | None = None,
    typical: Ranges | None = None,
) -> Callable[[type[T]], type[T]]:
    """Declare a lab test: ``Series`` fields are the columns of the data file, the others its conditions;
    ``fit`` its outcome.
    """
    return lambda cls: _declare(
        cls, name, "lab test", source, equation, fitted or {}, typical or {}, "", title, None
    )
