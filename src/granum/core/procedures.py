"""``@procedure`` and ``@chart``: cards for plain Python functions, such as a selection guide or a Plotly
figure.
"""

from __future__ import annotations

import functools
from collections.abc import Callable
from typing import Any, Generic, ParamSpec, TypeVar, get_type_hints, overload

import numpy as np

from granum.core import bounds, flags, notebooks
from granum.core.cards import Card, Ranges, key_of, make_card
from granum.core.conversion import Binder
from granum.core.docstrings import CompletedDoc
from granum.core.parameters import outputs_of, parameters_of
from granum.core.registry import register
from granum.core.results import Result

P = ParamSpec("P")
R = TypeVar("R")


class Procedure(Generic[P, R]):
    """A declared function that is not traced: arguments are converted and checked like those of a formula."""

    def __init__(self, function: Callable[P, R], sort: str, source: str, title: str, typical: Ranges):
        self.function: Callable[..., R] = function
        self._sort, self._title = sort, title
        self.source, self._typical = source, typical
        functools.update_wrapper(self, function)
        del self.__doc__  # which the class completes
        self.key = key_of(function, function.__name__)
        register(self, self.key, "")

    @functools.cached_property
    def card(self) -> Card:
        """The declaration as data."""
        name = self.function.__name__
        chart = self._sort == "chart"
        outputs = (
            ()
            if chart
            else outputs_of(get_type_hints(self.function, include_extras=True).get("return"), name, {})
        )
        return make_card(
            self.function,
            name,
            self._sort,
            parameters=parameters_of(self.function, {}, self._typical),
            outputs=outputs,
            source=self.source,
            title=self._title,
        )

    @functools.cached_property
    def _binder(self) -> Binder:
        return Binder.of(self.card.key, self.card.parameters)

    def _repr_html_(self) -> str:
        return notebooks.shown("granum.reports.terminal:print_card", self.card)

    def __repr__(self) -> str:
        return f"<{self._sort} {self.key}>"

    @overload
    def __call__(self, *args: P.args, **kwargs: P.kwargs) -> R: ...

    @overload
    def __call__(self, *args: Any, fluid: Any, **kwargs: Any) -> R: ...

    def __call__(self, *args: Any, **kwargs: Any) -> Any:
        return self._run(self._binder.bind(args, kwargs))

    def _run(self, inputs: dict[str, Any]) -> Any:
        """What the function gives; a figure outside the bounds of its own kind is none."""
        out = self.function(**inputs)
        bounds.refuse_outside(self.card.outputs, out, self.key)
        return out

    def evaluate(self, *args: Any, **kwargs: Any) -> Result:
        """The value with its card, and what was flagged on the way to it."""
        with flags.collect() as records:
            given, origins = self._binder.resolved(args, kwargs)
            inputs = self._binder.bind(args, given)
            out = self._run(inputs)
        left = self._binder.left_out(args, given)
        none = np.zeros((), np.int32)
        return Result(self.card, inputs, out, none, defaults=left, origins=origins).told(records)


Procedure.__doc__ = CompletedDoc(Procedure.__doc__, of_instances=True)  # type: ignore[assignment]


def procedure(
    *, source: str, title: str, typical: Ranges | None = None
) -> Callable[[Callable[P, R]], Procedure[P, R]]:
    """Declare a function on concrete values whose result is data: a ranking, a table, a design."""
    return lambda function: Procedure(function, "procedure", source, title, typical or {})


def chart(
    *, source: str, title: str, typical: Ranges | None = None
) -> Callable[[Callable[P, R]], Procedure[P, R]]:
    """Declare a function that returns a Plotly figure made with ``granum.core.charts``."""
    return lambda function: Procedure(function, "chart", source, title, typical or {})
