"""Figures computed from other figures: an arithmetic expression, or a formula whose inputs are figures.

``"dryer.heat_duty / crystals.solid_flow"`` is worked out in SI units. Text in quotes is a quantity
(``'0.1 USD/kWh'``) or a name that is no identifier (``'purged.liquid.potassium nitrate'``).
"""

from __future__ import annotations

import ast
import operator
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

import jax.numpy as jnp

from granum.core import registry, units
from granum.core.conversion import convert
from granum.core.errors import GranumError, InputError, unknown_name
from granum.core.i18n import _
from granum.core.kinds import KINDS
from granum.core.parameters import Parameter
from granum.core.written import read_number

Lookup = Callable[[str], Any]

_BINARY = {
    ast.Add: operator.add,
    ast.Sub: operator.sub,
    ast.Mult: operator.mul,
    ast.Div: operator.truediv,
    ast.Pow: operator.pow,
}
_FUNCTIONS: dict[str, Callable[..., Any]] = {
    "sqrt": jnp.sqrt,
    "exp": jnp.exp,
    "log": jnp.log,
    "abs": jnp.abs,
    "min": lambda *x: jnp.min(jnp.stack(x)),
    "max": lambda *x: jnp.max(jnp.stack(x)),
}
LONGEST = 2000


@dataclass(frozen=True)
class Expression:
    """An arithmetic expression over figures, read once."""

    text: str
    tree: ast.expr

    @staticmethod
    def read(text: str) -> Expression:
        """The expression of a text; only + - * / ** and sqrt, exp, log, abs, min, max."""
        if len(text) > LONGEST:
            raise InputError(_("The expression is too long."))
        try:
            tree = ast.parse(text.strip(), mode="eval").body
        except (SyntaxError, ValueError, RecursionError):
            raise InputError(
                _("'{text}' is not an expression such as 'dryer.heat_duty / crystals.solid_flow'.").format(
                    text=text
                )
            ) from None
        made = Expression(text, tree)
        made.names()  # complains about what is not allowed
        return made

    @property
    def is_name(self) -> bool:
        """Whether it is nothing but the name of a figure."""
        return isinstance(self.tree, (ast.Name, ast.Attribute, ast.Subscript))

    def names(self) -> tuple[str, ...]:
        """Figures the expression needs."""
        seen: dict[str, None] = {}

        def note(path: str) -> float:
            seen[path] = None
            return 1.0

        self._walk(self.tree, note, compute=False)
        return tuple(seen)

    def value(self, lookup: Lookup) -> Any:
        """Its value, figures being looked up by name."""
        return self._walk(self.tree, lookup, compute=True)

    def _walk(self, node: ast.expr, lookup: Lookup, compute: bool) -> Any:
        if (
            isinstance(node, ast.Constant)
            and isinstance(node.value, (int, float))
            and not isinstance(node.value, bool)
        ):
            return float(node.value)
        if isinstance(node, ast.Constant) and isinstance(node.value, str):
            return _quantity(node.value) if node.value[:1] in "0123456789.+-\u2212" else lookup(node.value)
        if isinstance(node, (ast.Name, ast.Attribute, ast.Subscript)):
            return lookup(_path(node, self.text))
        if isinstance(node, ast.UnaryOp) and isinstance(node.op, (ast.USub, ast.UAdd)):
            inner = self._walk(node.operand, lookup, compute)
            return -inner if isinstance(node.op, ast.USub) else inner
        if isinstance(node, ast.BinOp) and type(node.op) in _BINARY:
            left, right = self._walk(node.left, lookup, compute), self._walk(node.right, lookup, compute)
            return _BINARY[type(node.op)](left, right) if compute else 1.0
        if (
            isinstance(node, ast.Call)
            and isinstance(node.func, ast.Name)
            and node.func.id in _FUNCTIONS
            and node.args
            and not node.keywords
        ):
            inner = [jnp.asarray(self._walk(a, lookup, compute), dtype=float) for a in node.args]
            return _FUNCTIONS[node.func.id](*inner) if compute else 1.0
        raise InputError(
            _(
                "'{part}' in '{text}' cannot be used: an expression has figures, numbers, + - * / ** "
                "and sqrt, exp, log, abs, min, max."
            ).format(part=ast.unparse(node), text=self.text)
        )


def _path(node: ast.expr, text: str) -> str:
    if isinstance(node, ast.Name):
        return node.id
    if isinstance(node, ast.Attribute):
        return f"{_path(node.value, text)}.{node.attr}"
    if (
        isinstance(node, ast.Subscript)
        and isinstance(node.slice, ast.Constant)
        and isinstance(node.slice.value, int)
    ):
        return f"{_path(node.value, text)}[{node.slice.value}]"
    raise InputError(
        _("'{part}' in '{text}' is not the name of a figure.").format(part=ast.unparse(node), text=text)
    )


def _quantity(text: str) -> float:
    found = read_number(text)
    if found is None:
        raise InputError(_("'{text}' is not a number with a unit.").format(text=text))
    number, unit = found
    given = units.registry().Quantity(number, units.parse_unit(unit))
    return float(given.to_base_units().magnitude)


def plain_quantity(value: Any, where: str) -> float:
    """A number, or text with a unit as SI, for a figure whose kind is not known."""
    if isinstance(value, str):
        return _quantity(value)
    if isinstance(value, bool) or not isinstance(value, (int, float)):
        raise InputError(_("{value!r} is not a number {where}.").format(value=value, where=where))
    return float(value)


@dataclass(frozen=True)
class Quantity:
    """A figure of a study made from others: an expression, or a formula card with its inputs."""

    name: str
    parameter: Parameter
    inputs: tuple[tuple[str, Expression], ...]
    fixed: tuple[tuple[str, Any], ...] = ()
    card: Any = None
    output: str = ""

    def names(self) -> tuple[str, ...]:
        """Figures it needs."""
        return tuple(dict.fromkeys(n for _input, e in self.inputs for n in e.names()))

    def value(self, lookup: Lookup) -> Any:
        """Its value, SI."""
        if self.card is None:
            return self.inputs[0][1].value(lookup)
        made = self.card(
            **dict(self.fixed), **{n: jnp.asarray(e.value(lookup), dtype=float) for n, e in self.inputs}
        )
        return getattr(made, self.output) if hasattr(made, "_fields") else made


def quantity(name: str, declared: Any) -> Quantity:
    """The quantity a case file declares: an expression, ``{expression, kind}``, or ``{card, inputs,
    output}``.
    """
    where = _("in [quantities] for '{name}'").format(name=name)
    if isinstance(declared, (str, int, float)) and not isinstance(declared, bool):
        declared = {"expression": str(declared)}
    if not isinstance(declared, Mapping):
        raise InputError(
            _("{where}: give an expression, or a table with 'expression' or 'card'.").format(where=where)
        )
    table = dict(declared)
    allowed = ("card", "inputs", "output") if "card" in table else ("expression", "kind")
    for key in table:
        if key not in allowed:
            raise unknown_name(_("Key"), key, allowed, where)
    try:
        return _from_card(name, table, where) if "card" in table else _from_expression(name, table, where)
    except GranumError as problem:
        if where in problem.message:
            raise
        raise InputError(f"{problem.message} ({where})", **problem.details) from None


def _from_expression(name: str, table: dict[str, Any], where: str) -> Quantity:
    if "expression" not in table:
        raise InputError(
            _("{where}: give an expression, or a table with 'expression' or 'card'.").format(where=where)
        )
    kind = None
    if "kind" in table:
        if table["kind"] not in KINDS:
            raise unknown_name(_("Kind"), str(table["kind"]), KINDS, where)
        kind = KINDS[table["kind"]]
    return Quantity(name, Parameter(name, kind), (("", Expression.read(str(table["expression"]))),))


def _from_card(name: str, table: dict[str, Any], where: str) -> Quantity:
    card = registry.find(str(table["card"]))
    if card.card.sort != "formula":
        raise InputError(
            _("{where}: '{key}' ({sort}) is not a formula.").format(
                where=where, key=card.card.key, sort=_(card.card.sort)
            )
        )
    outputs = {p.name: p for p in card.card.outputs}
    output = str(table.get("output") or next(iter(outputs)))
    if output not in outputs:
        raise unknown_name(_("Result"), output, outputs, where)
    known = {p.name: p for p in card.card.parameters}
    moving, fixed = [], []
    for key, value in dict(table.get("inputs") or {}).items():
        if key not in known:
            raise unknown_name(_("Input"), key, known, where)
        try:
            fixed.append((key, convert(value, known[key], " " + where)))
        except GranumError as problem:
            if not isinstance(value, str) or known[key].kind is None:
                raise
            try:
                moving.append((key, Expression.read(value)))
            except GranumError:
                raise problem from None
    missing = [n for n, p in known.items() if p.required and n not in dict(fixed) and n not in dict(moving)]
    if missing:
        raise InputError(
            _("{where}: {owner} needs {names}.").format(
                where=where, owner=card.card.key, names=", ".join(missing)
            )
        )
    parameter = outputs[output]
    return Quantity(name, Parameter(name, parameter.kind), tuple(moving), tuple(fixed), card, output)
