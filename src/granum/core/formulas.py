"""``@formula``: turns a pure ``jax.numpy`` function into a card that converts units, checks bounds and raises
flags.
"""

from __future__ import annotations

import functools
import inspect
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import replace
from typing import Any, Generic, ParamSpec, TypeVar, get_type_hints, overload

import jax
import jax.numpy as jnp
import numpy as np

from granum.core import bounds, flags, notebooks
from granum.core.cards import Card, Ranges, key_of, make_card
from granum.core.compiling import begun
from granum.core.conversion import Binder, convert, is_tracer
from granum.core.docstrings import CompletedDoc
from granum.core.errors import InputError
from granum.core.glossary import quantity_in
from granum.core.i18n import _, quoted
from granum.core.parameters import Parameter, outputs_of, parameters_of
from granum.core.registry import register
from granum.core.results import Result
from granum.core.steps import Step, floats, recorded

P = ParamSpec("P")
R = TypeVar("R")

KELVIN = "A temperature given here is below −123 °C: a number without a unit is read in kelvin."


class Formula(Generic[P, R]):
    """A declared formula. Call it for the bare value, ``evaluate`` it for value, flags and card.

    Accepts floats, arrays, tracers, text with units and Pint quantities. Single values outside the hard
    bounds raise, and so do single values that contradict one another; elements of arrays that do give NaN.
    """

    def __init__(
        self,
        function: Callable[P, R],
        *,
        source: str,
        equation: str,
        fitted: Ranges,
        typical: Ranges,
        title: str,
        output: str,
        family: str,
        symbols: Mapping[str, str],
    ):
        self.function: Callable[..., R] = function
        self.fitted = fitted
        self.source = source
        self._declared = {"equation": equation, "title": title, "family": family}
        self._typical = typical
        self._symbols = symbols
        self._compiled: dict[Any, Callable[..., Any]] = {}
        self._prepared: dict[tuple[str, ...], tuple[Any, ...]] = {}
        functools.update_wrapper(self, function)
        del self.__doc__  # which the class completes
        self.key = key_of(function, function.__name__)
        self._result_name = output or quantity_in(function.__name__) or function.__name__
        register(self, self.key, family or self._result_name)

    @functools.cached_property
    def card(self) -> Card:
        """The declaration as data, built on first use."""
        name, output = self.function.__name__, self._result_name
        hints = get_type_hints(self.function, include_extras=True)
        family = self._declared["family"] or output
        return make_card(
            self.function,
            name,
            "formula",
            parameters=parameters_of(self.function, self.fitted, self._typical),
            outputs=outputs_of(hints.get("return"), output, self.fitted),
            source=self.source,
            equation=self._declared["equation"],
            fitted=self.fitted,
            family=family,
            title=self._declared["title"],
            symbols=self._symbols,
        )

    @functools.cached_property
    def _binder(self) -> Binder:
        return Binder.of(self.card.key, self.card.parameters)

    @functools.cached_property
    def _static(self) -> tuple[bool, ...]:
        return tuple(p.kind is None or p.sort is int for p in self.card.parameters)

    @functools.cached_property
    def _signature(self) -> inspect.Signature:
        return inspect.signature(self.function)

    def _repr_html_(self) -> str:
        return notebooks.shown("granum.reports.terminal:print_card", self.card)

    def __repr__(self) -> str:
        return f"<formula {self.key}{self._signature}>"

    def _collect_values(
        self, args: tuple[Any, ...], kwargs: Mapping[str, Any]
    ) -> tuple[list[Any], bool, bool]:
        """Converted values in order, whether any is traced, whether any is an array."""
        values = self._binder.arrange(args, kwargs)
        traced = batched = False
        for i, (p, value) in enumerate(zip(self.card.parameters, values, strict=True)):
            if type(value) is float and p.kind is not None and not p.law and not p.series:
                if (
                    not p.kind.contains(value)
                    or value in (np.inf, -np.inf)
                    or (p.coldest is not None and value < p.coldest)
                ):
                    values[i] = convert(value, p, _(" for {owner}").format(owner=self.key))
                continue
            if is_tracer(value):
                traced = True
                continue
            values[i] = value = convert(
                value, p, "" if value is p.default else _(" for {owner}").format(owner=self.key), several=True
            )
            if is_tracer(value):  # a list with traced elements
                traced = True
                continue
            if p.kind is None and not isinstance(value, (Formula, str, bool, int, type(None))):
                traced = traced or any(map(is_tracer, jax.tree_util.tree_leaves(value)))
            batched = batched or (p.kind is not None and not p.series and getattr(value, "ndim", 0) > 0)
        self._binder.equally_long(values)
        if batched:
            self._check_shapes(values)
        return values, traced, batched

    def _check_shapes(self, values: list[Any]) -> None:
        """Arrays given for single values fit one another: equally long, or as NumPy broadcasts them."""
        rows = [
            (p.name, np.shape(v))
            for p, v in zip(self.card.parameters, values, strict=True)
            if p.kind and not p.series and np.ndim(v)
        ]
        try:
            np.broadcast_shapes(*(shape for _name, shape in rows))
        except ValueError:
            shown = ", ".join(f"{quoted(name)} ({' × '.join(map(str, shape))})" for name, shape in rows)
            raise InputError(
                _("Unequal numbers of values: {names}.").format(names=shown), name=rows[0][0]
            ) from None

    @contextmanager
    def _fitting(self, values: list[Any]) -> Iterator[None]:
        """Beside a series an array for a single value fits only some bodies: where it does not, the arrays
        are named.
        """
        try:
            yield
        except (TypeError, ValueError) as problem:
            rows = [
                (p.name, np.shape(v))
                for p, v in zip(self.card.parameters, values, strict=True)
                if p.kind and np.ndim(v)
            ]
            single = [name for name, _shape in rows if not self.card.parameter(name).series]
            if not single or len(single) == len(rows):
                raise
            shown = ", ".join(f"{quoted(name)} ({' × '.join(map(str, shape))})" for name, shape in rows)
            raise InputError(
                _("{owner} takes one value of {names} beside its series; given: {shown}.").format(
                    owner=self.key, names=", ".join(quoted(name) for name in single), shown=shown
                ),
                name=single[0],
            ) from problem

    def _split(self, values: list[Any]) -> tuple[tuple[Any, ...], list[Any]]:
        """Static part (hashable key) and dynamic part of the arguments."""
        key, dynamic = [], []
        for value, static in zip(values, self._static, strict=True):
            fixed = value is None or (static and isinstance(value, (Formula, str, bool, int)))
            key.append(value if fixed else _DYNAMIC)
            if not fixed:
                dynamic.append(value)
        return tuple(key), dynamic

    def _merged(self, key: tuple[Any, ...], dynamic: tuple[Any, ...]) -> list[Any]:
        rest = iter(dynamic)
        return [next(rest) if item is _DYNAMIC else item for item in key]

    def _compile(self, key: tuple[Any, ...], sort: str) -> Callable[..., Any]:
        found = self._compiled.get((key, sort))
        if found is None:
            body = {"bare": self._bare, "masked": self._masked, "checked": self._checked}[sort]
            found = self._compiled[(key, sort)] = begun(
                lambda *dynamic: body(self._merged(key, dynamic)),
                (self, sort, tuple("" if item is _DYNAMIC else (item,) for item in key)),
            )
        return found

    def _bare(self, values: list[Any]) -> Any:
        """The value, NaN where none exists."""
        with flags.collect(flags.OUTSIDE_DOMAIN) as records:
            out = self._body(values)
        return self._possible(out, records)

    def _masked(self, values: list[Any]) -> Any:
        """The value, NaN where none exists or an input lies outside the hard bounds; both branches stay
        finite.
        """
        with flags.collect(flags.OUTSIDE_DOMAIN) as records:
            out = self._body(self._guard(values))
        return self._possible(out, records)

    def _possible(self, out: Any, records: list[flags.Record]) -> Any:
        """Of the outermost call alone: the number of a formula inside another stays, as it may stand in a
        branch not taken.
        """
        return bounds.without_impossible(self.card.outputs, out, records, self._along)

    @functools.cached_property
    def _along(self) -> bool:
        """Whether some inputs are series, over which a check concerns the result as a whole."""
        return any(p.series for p in self.card.parameters)

    def _guard(self, values: list[Any]) -> list[Any]:
        """The values with ordinary ones in place of elements outside the hard bounds, which are recorded."""
        if self._along:
            return values
        guarded = list(values)
        for i, p in enumerate(self.card.parameters):
            if p.kind is None or values[i] is None or (p.kind.lower == -np.inf and p.kind.upper == np.inf):
                continue
            inside = p.kind.contains(values[i])
            flags.record(
                flags.OUTSIDE_DOMAIN,
                ~jnp.asarray(inside),
                values[i],
                p.name,
                self.key,
                p.kind.lower,
                p.kind.upper,
            )
            guarded[i] = jnp.where(inside, values[i], sum(p.ordinary()) / 2)
        return guarded

    def _checked(self, values: list[Any]) -> tuple[Any, list[flags.Record]]:
        with flags.collect() as records:
            out = self._body(self._guard(values))
            # where the body itself has said why there is no number, its outputs need not be reported one by
            # one
            told = [found for found in records if found.bit == flags.OUTSIDE_DOMAIN or found.without]
            for p, value in zip(self.card.outputs, out if isinstance(out, tuple) else (out,), strict=True):
                lost = ~jnp.isfinite(jnp.asarray(value, dtype=float))
                for mask in (found.mask for found in told if not found.without or p.name in found.without):
                    lost = lost & ~bounds.concerned(mask, lost, self._along)
                flags.record(flags.NOT_FINITE, lost, jnp.zeros(()), p.name, self.key)
        return self._possible(out, records), list(records)

    def _body(self, values: list[Any]) -> Any:
        """Run the function, recording inputs and outputs outside the declared ranges and outputs outside
        their own bounds.
        """
        start = len(flags.kept())
        for p, value in zip(self.card.parameters, values, strict=True):
            if p.kind is not None and value is not None:
                self._record_range(p, value, p.coldest)
        with flags.inside(self):
            out = self.function(*values)
        for p, value in bounds.figures(self.card.outputs, out):
            self._record_range(p, value, None)
        bounds.record_outside(self.card.outputs, out, self.key, self.source, start)
        return out

    def _record_range(self, p: Parameter, value: Any, coldest: float | None) -> None:
        if not flags.listening() or (p.fitted is None and coldest is None):
            return
        value = jnp.asarray(value)
        without_unit = value < (-np.inf if coldest is None else coldest)
        if coldest is not None:
            flags.record(flags.EXTRAPOLATED, without_unit, value, p.name, self.key, reason=KELVIN)
        if p.fitted is not None:
            low, high = p.fitted
            beyond = (value < low) & ~without_unit | (value > high)
            flags.record(flags.EXTRAPOLATED, beyond, value, p.name, self.key, low, high, self.source)

    def _prepare(self, names: tuple[str, ...]) -> tuple[Any, ...]:
        """For calls with these keywords as plain floats: bounds as strict limits, order of the arguments,
        compiled body.
        """
        given = dict.fromkeys(names, 1.0)
        values = self._binder.arrange((), given)
        for i, p in enumerate(self.card.parameters):
            if p.name not in given:
                values[i] = convert(values[i], p)
        if any(
            p.law or p.kind is None or p.series or p.sort is int
            for p in self.card.parameters
            if p.name in given
        ):
            return ()
        limits = [
            (
                self.card.parameter(n).coldest
                or (k.lower if k.open_lower else np.nextafter(k.lower, -np.inf)),
                k.upper if k.open_upper else np.nextafter(k.upper, np.inf),
            )
            for n in names
            if (k := self.card.parameter(n).kind) is not None
        ]
        key, _dynamic = self._split(values)
        order = [
            (names.index(p.name), None) if p.name in given else (-1, values[i])
            for i, p in enumerate(self.card.parameters)
            if key[i] is _DYNAMIC
        ]
        return [(float(a), float(b)) for a, b in limits], order, self._compile(key, "bare")

    def _quick(self, kwargs: dict[str, Any]) -> Any:
        """The common scalar call, all keywords plain floats inside their bounds; ``_DYNAMIC`` when it is not
        one.
        """
        names = tuple(kwargs)
        prepared = self._prepared.get(names)
        if prepared is None:
            prepared = self._prepared[names] = self._prepare(names)
        if not prepared:
            return _DYNAMIC
        limits, order, compiled = prepared
        values = list(kwargs.values())
        for value, (low, high) in zip(values, limits, strict=True):
            if type(value) is not float or not low < value < high:
                return _DYNAMIC
        return floats(compiled(*[values[i] if i >= 0 else fixed for i, fixed in order]))

    @overload
    def __call__(self, *args: P.args, **kwargs: P.kwargs) -> R: ...

    @overload
    def __call__(self, *args: Any, fluid: Any, **kwargs: Any) -> R: ...

    def __call__(self, *args: Any, **kwargs: Any) -> Any:
        if self._binder.stands_in(kwargs):
            kwargs = dict(self._binder.resolved(args, kwargs)[0])
        nested = flags.nested()
        heard = flags.listening()
        noted = not nested and recorded() is not None
        if not args and not nested and not heard and not noted:
            quick = self._quick(kwargs)
            if quick is not _DYNAMIC:
                return self._told(quick, kwargs)
        values, traced, batched = self._collect_values(args, kwargs)
        if noted:
            return floats(self._step(values).value)
        if traced or nested:
            return self._body(values)
        key, dynamic = self._split(values)
        if heard:
            with self._fitting(values):
                out, records = self._compile(key, "checked")(*dynamic)
            flags.hand_on(records)
            return out if batched else self._told(floats(out), kwargs, args)
        if batched:
            with self._fitting(values):
                return self._compile(key, "masked")(*dynamic)
        return self._told(floats(self._compile(key, "bare")(*dynamic)), kwargs, args)

    def _told(self, out: Any, kwargs: Mapping[str, Any], args: tuple[Any, ...] = ()) -> Any:
        """What single inputs gave, unless they contradict one another: that raises. No number in, as from a
        failed root, gives none out.
        """
        lost = any(
            not is_tracer(x) and (x != x if type(x) is float else bool(np.isnan(x).all()))
            for x in (out if isinstance(out, tuple) else (out,))
        )
        if lost and not any(
            hasattr(value, "at") and bool(jnp.isnan(value).any()) for value in (*args, *kwargs.values())
        ):
            self.evaluate(*args, **kwargs)
        return out

    def evaluate(self, *args: Any, **kwargs: Any) -> Result:
        """The value with its flags and card."""
        with flags.collect() as of_inputs:
            kwargs, origins = self._binder.resolved(args, kwargs)  # type: ignore[assignment]
        values, traced, batched = self._collect_values(args, kwargs)
        if traced:
            raise InputError(
                _("'evaluate' works on concrete values; inside jit or grad call {key} itself.").format(
                    key=self.key
                )
            )
        result = replace(
            self._step(values).result(), defaults=self._binder.left_out(args, kwargs), origins=origins
        ).told(of_inputs)
        return result if batched else result.possible()

    def _step(self, values: list[Any]) -> Step:
        """Evaluated, and kept where steps are recorded."""
        if flags.is_inner():
            out, records = self._checked(values)
        else:
            key, dynamic = self._split(values)
            with self._fitting(values):
                out, records = self._compile(key, "checked")(*dynamic)
        flags.hand_on(records)
        inputs = {p.name: value for p, value in zip(self.card.parameters, values, strict=True)}
        step = Step(self.key, inputs, out, records)
        steps = recorded()
        if steps is not None:
            steps.append(step)
        return step


Formula.__doc__ = CompletedDoc(Formula.__doc__, of_instances=True)  # type: ignore[assignment]

_DYNAMIC = type("_Dynamic", (), {"__repr__": lambda self: "dynamic"})()


def formula(
    *,
    source: str,
    equation: str = "",
    fitted: Ranges | None = None,
    typical: Ranges | None = None,
    title: str = "",
    output: str = "",
    family: str = "",
    symbols: Mapping[str, str] | None = None,
) -> Callable[[Callable[P, R]], Formula[P, R]]:
    """Declare a formula.

    Parameters
    ----------
    source: bibliography key with equation and page: ``"ergun1952, eq. 3, p. 90"``; several are joined by
        ``;``.
    equation: LaTeX.
    fitted: ranges over which the source holds, by input, output or watched name, SI units.
    typical: ranges to draw ordinary values from, where the glossary's do not suit.
    title: English title; by default the glossary label with the author from the name.
    output: glossary name of the result; by default the glossary word the function name starts with.
    family: name under which it can be passed as a law; by default the output name.
    symbols: LaTeX symbols in this equation by name, where those of the glossary do not suit; ``=name`` for a
        result that bears the name of an input.
    """

    def declare(function: Callable[P, R]) -> Formula[P, R]:
        return Formula(
            function,
            source=source,
            equation=equation,
            fitted=fitted or {},
            typical=typical or {},
            title=title,
            output=output,
            family=family,
            symbols=symbols or {},
        )

    return declare
