"""What is studied: a formula, a procedure or a process line, seen as numbers in and numbers out with a reason
for each failure.
"""

from __future__ import annotations

import abc
import functools
import hashlib
import re
from collections import OrderedDict
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from typing import Any, NamedTuple

import jax
import jax.numpy as jnp
import numpy as np

import granum
from granum.core import flags, registry
from granum.core.conversion import Binder, convert
from granum.core.errors import GranumError, InputError, unknown_name, without_value
from granum.core.i18n import _, quoted
from granum.core.parameters import Parameter
from granum.core.stand_ins import not_varied
from granum.streams.names import pretty
from granum.studies.expressions import Expression, Lookup, Quantity, quantity

EXTRAPOLATED, FINE, NOT_CONVERGED, UNMET, RAISED, NOT_RUN, NOT_CLOSED, NEGATIVE, OVERSATURATED, TOO_HOT = (
    range(-1, 9)
)
NOT_FINITE, OUTSIDE, IMPOSSIBLE, LOST = 1000, 2000, 3000, 4000
"""Codes of a case: up to 0 it has a result (-1: some correlation was used outside its range), above 0 why it
has none; from 1000 the result that is not finite, from 2000 the input at fault, from 3000 the result that is
not possible, from 4000 the unit that has no solution.
"""

_ADDRESS = re.compile(r"0x[0-9a-f]+")
_DECIMALS = re.compile(r"\d+\.\d{8,}(e[+-]?\d+)?")
_NAMED = re.compile(r"\s*(\w+)\s*=(?!=)")  # ``name = expression``
_INDEXED = re.compile(r"^(.*)\[(-?\d+)\]$")
MOST_KEPT = 8  # compiled functions of a subject
Traced = Callable[[Any, Any], tuple[Any, Any]]


@dataclass(frozen=True)
class Variable:
    """An input or a figure of a study: its path and its declaration; ``named`` when the author of the study
    named it.
    """

    path: str
    parameter: Parameter
    named: bool = False

    @property
    def label(self) -> str:
        """``unit: quantity`` in the current language."""
        if self.named:
            return self.path.replace("_", " ")
        owner, dot, _last = self.path.partition(".")
        own = self.parameter.label
        return _("{unit}: {quantity}").format(unit=pretty(owner), quantity=own) if dot else own

    @property
    def unit(self) -> str:
        """SI unit."""
        return self.parameter.kind.unit if self.parameter.kind else ""


class Computed(NamedTuple):
    """A function that looks up figures, the code of the outcome, and where a case like this one may begin."""

    lookup: Lookup
    code: Any
    left: Any = ()


@dataclass(frozen=True)
class Subject(abc.ABC):
    """A model with inputs and figures by path. ``traced`` is pure: it may be compiled, batched and
    differentiated.
    """

    quantities: Mapping[str, Quantity] = field(default_factory=dict, kw_only=True)
    recipe: Any = field(default=None, kw_only=True, compare=False)
    """How another process can make the same subject: an object with ``build()``; None when it was made in
    Python.
    """
    _kept: OrderedDict[Any, Any] = field(default_factory=OrderedDict, init=False, repr=False, compare=False)

    @property
    @abc.abstractmethod
    def title(self) -> str:
        """What is studied, in words."""

    @property
    def batched(self) -> bool:
        """Whether many cases are best computed side by side (``vmap``) rather than one after the other in
        compiled code.
        """
        return True

    @property
    def harder(self) -> Subject | None:
        """The same with a solver that takes more pains, for the cases that this one leaves unsolved; None
        when there is none.
        """
        return None

    @abc.abstractmethod
    def input(self, path: str) -> Variable:
        """An input by path, or an error that suggests the nearest one."""

    @abc.abstractmethod
    def nominal(self, path: str) -> Any:
        """The value of an input when nothing changes it, SI; NaN when it has none."""

    @abc.abstractmethod
    def own_output(self, path: str) -> Variable:
        """A figure of the model by path."""

    @abc.abstractmethod
    def outputs(self) -> tuple[str, ...]:
        """Figures shown when none are asked for."""

    @abc.abstractmethod
    def arrays(self) -> Any:
        """The model as a pytree; its numbers are handed to ``traced``, so that compiled code is reused when
        they change.
        """

    def begin(self, among_many: bool = False) -> Any:
        """Where the search for a solution begins, numbers as a pytree; nothing for most. ``among_many``: that
        of one of many neighbors, solved one after the other.
        """
        return ()

    @abc.abstractmethod
    def compute(
        self, arrays: Any, values: Mapping[str, Any], wanted: tuple[str, ...], begin: Any
    ) -> Computed:
        """Solves for given inputs. Pure."""

    def kept(self, key: Any, build: Callable[[], Any]) -> Any:
        """What was compiled for this subject, made when it is first asked for; the last few are kept, as long
        as the subject is.
        """
        if key not in self._kept:
            self._kept[key] = build()
            while len(self._kept) > MOST_KEPT:
                self._kept.popitem(last=False)
        self._kept.move_to_end(key)
        return self._kept[key]

    def identity(self) -> str:
        """What tells the model from another one, apart from its numbers."""
        return self.title

    def fingerprint(self) -> str:
        """A digest of the model and the version, the same in every process, so that a stored study is never
        continued with another model.

        Numbers count with nine digits: what a material's constants are beyond that depends on how they were
        compiled.
        """
        leaves, tree = jax.tree.flatten(self.arrays())
        parts = [
            granum.__version__,
            self.identity(),
            str(tree),
            *(f"{q.name}{q.fixed}{[(n, e.text) for n, e in q.inputs]}" for q in self.quantities.values()),
        ]
        parts += [
            getattr(leaf, "key", None) or getattr(leaf, "__qualname__", None) or type(leaf).__name__
            for leaf in leaves
            if not _is_number(leaf)
        ]
        text = _ADDRESS.sub("", "\n".join(parts))
        digest = hashlib.sha256(_DECIMALS.sub(lambda m: f"{float(m[0]):.9g}", text).encode())
        for leaf in leaves:
            if _is_number(leaf):
                mantissa, exponent = np.frexp(np.asarray(leaf, dtype=float))
                digest.update(np.ldexp(np.round(mantissa, 9), exponent).tobytes())
        return digest.hexdigest()

    # -- common to all
    # -----------------------------------------------------------------------------------------
    def with_quantities(self, declared: Mapping[str, Any]) -> Subject:
        """The same subject with further figures, see ``granum.studies.expressions.quantity``."""
        made = dict(self.quantities)
        for name, table in declared.items():
            made[name] = table if isinstance(table, Quantity) else quantity(name, table)
        changed = replace(self, quantities=made)
        for name in declared:
            changed.output(name)  # complains about unknown names
        return changed

    def output(self, path: str, trail: tuple[str, ...] = ()) -> Variable:
        """A figure by path or by the name of a quantity."""
        if path not in self.quantities:
            return self.own_output(path)
        if path in trail:
            raise InputError(_("Quantity '{name}' is defined by itself.").format(name=path), name=path)
        for name in self.quantities[path].names():
            self.output(name, (*trail, path))
        return Variable(path, self.quantities[path].parameter, named=True)

    def figure(self, text: str) -> tuple[Subject, str]:
        """A figure given by path, by quantity or as an expression; the subject gains the expression as a
        quantity.
        """
        try:
            self.output(text)
            return self, text
        except GranumError as problem:
            if named := _NAMED.match(text):
                raise InputError(
                    _("'{text}' is a figure with a name: declare '{name}' under [quantities].").format(
                        text=text, name=named[1]
                    )
                ) from None
            try:
                expression = Expression.read(text)
            except GranumError:
                raise problem from None
            if expression.is_name:
                raise
            return self.with_quantities({text: Quantity(text, Parameter(text), (("", expression),))}), text

    def _needed(self, paths: tuple[str, ...]) -> tuple[str, ...]:
        """The model's own figures behind some figures."""
        own: dict[str, None] = {}
        for path in paths:
            inner = self.quantities[path].names() if path in self.quantities else ()
            own |= dict.fromkeys(self._needed(inner)) if path in self.quantities else {path: None}
        return tuple(own)

    def numbers(self, begin: Any = None, *, among_many: bool = False) -> list[Any]:
        """The numbers of the model and of where to begin, as ``traced`` takes them."""
        model = [leaf for leaf in jax.tree.leaves(self.arrays()) if _is_number(leaf)]
        start = jax.tree.leaves(self.begin(among_many) if begin is None else begin)
        return [jnp.asarray(leaf, dtype=float) for leaf in (*model, *start)]

    def traced(self, inputs: tuple[str, ...], outputs: tuple[str, ...], among_many: bool = False) -> Traced:
        """A pure function (numbers, vector of inputs) → (vector of figures, code), and for one ``among_many``
        where another one may begin.
        """

        leaves, tree = jax.tree.flatten(self.arrays())
        moving = [_is_number(leaf) for leaf in leaves]

        start = jax.tree.structure(self.begin(among_many))

        def run(numbers: Any, vector: Any) -> tuple[Any, ...]:
            given = iter(numbers)
            model = tree.unflatten(
                [next(given) if moves else leaf for leaf, moves in zip(leaves, moving, strict=True)]
            )
            begin = start.unflatten(list(given))
            values = {path: vector[i] for i, path in enumerate(inputs)}
            with flags.collect() as records:
                found = self.compute(model, values, self._needed(outputs), begin)
                own, code = found.lookup, found.code

                def lookup(path: str) -> Any:
                    if path in self.quantities:
                        return self.quantities[path].value(lookup)
                    value = own(path)
                    if value is None:
                        raise without_value(path)
                    return value

                figures = jnp.stack([jnp.asarray(lookup(path), dtype=float) for path in outputs])
            beyond = [jnp.any(record.mask) for record in records if record.bit == flags.EXTRAPOLATED]
            good = jnp.where(jnp.any(jnp.stack(beyond)), EXTRAPOLATED, FINE) if beyond else FINE
            lost = ~jnp.isfinite(figures)
            bad = jnp.where(jnp.any(lost), NOT_FINITE + jnp.argmax(lost), good)
            told = figures, jnp.where(code == FINE, bad, code).astype(jnp.int32)
            return (*told, jax.tree.leaves(found.left)) if among_many else told

        return run

    def reason(self, code: int, inputs: tuple[str, ...], outputs: tuple[str, ...]) -> str:
        """Why a case failed, in words."""
        if code >= IMPOSSIBLE:
            return _("result '{name}' outside what is possible").format(name=outputs[code - IMPOSSIBLE])
        if code >= OUTSIDE:
            return _("input '{name}' outside what is possible").format(name=inputs[code - OUTSIDE])
        if code >= NOT_FINITE:
            return _("result '{name}' is not a finite number").format(name=outputs[code - NOT_FINITE])
        return {
            NOT_CONVERGED: _("a loop did not converge"),
            UNMET: _("the design specifications cannot be met"),
            RAISED: _("the calculation refused the inputs"),
            NOT_RUN: _("not run: the study was stopped"),
            NOT_CLOSED: _("the balance of mass or energy does not close"),
            NEGATIVE: _("a flow is negative"),
            OVERSATURATED: _("a gas holds more vapor than saturates it"),
            TOO_HOT: _("a stream lies beyond all temperatures that properties are known for"),
        }[code]


def _is_number(leaf: Any) -> bool:
    return isinstance(leaf, (float, np.floating)) or (
        isinstance(leaf, (np.ndarray, jax.Array)) and np.issubdtype(leaf.dtype, np.floating)
    )


def split_index(path: str) -> tuple[str, int | None]:
    """``"unit.profile[2]"`` → ``("unit.profile", 2)``."""
    found = _INDEXED.match(path)
    return (found.group(1), int(found.group(2))) if found else (path, None)


@dataclass(frozen=True)
class FormulaSubject(Subject):
    """A formula, a law, or a procedure (computed one by one, without derivatives), with the inputs that stay
    fixed.

    The inputs of a law are its parameters and the arguments of its call.
    """

    thing: Any
    fixed: Mapping[str, Any]
    of_fluid: tuple[flags.Record, ...] = field(default=(), repr=False, compare=False)
    """What is flagged of the fluid that gave some of the fixed inputs: it holds of every case."""

    @functools.cached_property
    def parameters(self) -> dict[str, Parameter]:
        """Inputs by name."""
        return self.thing.card.inputs

    @staticmethod
    def of(thing: Any, fixed: Mapping[str, Any], recipe: Any = None) -> FormulaSubject:
        """A formula card or its key with fixed inputs, in any unit."""
        thing = registry.find(thing) if isinstance(thing, str) else thing
        if thing.card.sort not in ("formula", "law", "procedure"):
            raise InputError(
                _(
                    "'{key}' ({sort}): a study takes a formula, a law, a procedure, or a case file "
                    "with the equipment in it."
                ).format(key=thing.card.key, sort=_(thing.card.sort))
            )
        known = thing.card.inputs
        where = _("for {owner}").format(owner=thing.card.key)
        with flags.collect() as of_fluid:
            fixed = Binder.of(thing.card.key, tuple(known.values())).resolved((), fixed)[0]
        for name in fixed:
            if name not in known:
                raise unknown_name(_("Input"), name, known, where)
        given = {n: convert(v, known[n], " " + where) for n, v in fixed.items()}
        return FormulaSubject(thing, given, tuple(of_fluid), recipe=recipe)

    @property
    def title(self) -> str:
        return self.thing.card.title

    def identity(self) -> str:
        words = {n: v for n, v in self.fixed.items() if not hasattr(v, "dtype")}
        return f"{self.thing.card.key} {sorted((n, str(v)) for n, v in words.items())}"

    @property
    def pure(self) -> bool:
        """Whether it can be compiled and differentiated."""
        return self.thing.card.sort != "procedure"

    def input(self, path: str) -> Variable:
        name, index = split_index(path)
        known = {n: p for n, p in self.parameters.items() if p.kind is not None and p.sort is not int}
        if name not in known:
            where = _("for {owner}").format(owner=self.thing.card.key)
            raise not_varied(name, known, f" {where}") or unknown_name(_("Input"), name, known, where)
        if (index is not None) != (known[name].series is not None):
            raise InputError(
                _("'{name}' is a list: vary one element, as in '{name}[0]'.").format(name=name)
                if index is None
                else _("'{name}' is a single value: leave out the index.").format(name=name)
            )
        return Variable(path, known[name])

    def nominal(self, path: str) -> Any:
        name, index = split_index(path)
        value = self.fixed.get(name, self.parameters[name].default)
        if value is None or (name not in self.fixed and self.parameters[name].required):
            return np.nan
        return float(value if index is None else np.asarray(value)[index])

    def own_output(self, path: str) -> Variable:
        name, index = split_index(path)
        known = {
            p.name: p for p in (*self.thing.card.outputs, *self.parameters.values()) if p.kind is not None
        }
        if name not in known:
            raise unknown_name(_("Result"), name, known, _("for {owner}").format(owner=self.thing.card.key))
        if known[name].series and index is None:
            raise InputError(
                _("'{name}' is a list: ask for one element, as in '{name}[0]'.").format(name=name)
            )
        return Variable(path, known[name])

    def outputs(self) -> tuple[str, ...]:
        return tuple(p.name for p in self.thing.card.outputs if not p.series and p.kind is not None) + tuple(
            self.quantities
        )

    def arrays(self) -> Any:
        numbers = {n for n, p in self.parameters.items() if p.kind is not None and p.sort is not int}
        return {
            n: np.asarray(v, dtype=float) for n, v in self.fixed.items() if n in numbers and v is not None
        }

    def complete(self, varied: tuple[str, ...]) -> None:
        """Raise one clear error when inputs are neither fixed nor varied."""
        varied = tuple(split_index(v)[0] for v in varied)
        missing = [
            p for n, p in self.parameters.items() if p.required and n not in self.fixed and n not in varied
        ]
        if missing:
            names = ", ".join(f"{quoted(p.name)} ({p.label})" for p in missing)
            raise InputError(
                _("{owner} needs {names}.").format(owner=self.thing.card.key, names=names),
                missing=[p.name for p in missing],
            )

    def compute(
        self, arrays: Any, values: Mapping[str, Any], wanted: tuple[str, ...], begin: Any
    ) -> Computed:
        given = {**self.fixed, **{n: jnp.asarray(v) for n, v in arrays.items()}}
        for path, value in values.items():
            name, index = split_index(path)
            given[name] = value if index is None else jnp.asarray(given[name]).at[index].set(value)
        flags.hand_on(list(self.of_fluid))
        made = self.thing.called(**given) if self.thing.card.sort == "law" else self.thing(**given)
        found = made._asdict() if hasattr(made, "_asdict") else {self.thing.card.outputs[0].name: made}
        defaults = {n: p.default for n, p in self.parameters.items() if not p.required}

        def lookup(path: str) -> Any:
            name, index = split_index(path)
            value = found[name] if name in found else given.get(name, defaults.get(name))
            return value if index is None else jnp.asarray(value)[index]

        return Computed(lookup, jnp.asarray(FINE))
