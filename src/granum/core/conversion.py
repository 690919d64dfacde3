"""Whatever a user passes for a parameter as what a body takes, or one clear error; and arguments matched to
parameters.
"""

from __future__ import annotations

import contextlib
import json
import sys
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from importlib import import_module
from typing import Any

import numpy as np

from granum.core import given, registry, units
from granum.core.constants import ZERO_CELSIUS
from granum.core.documents import read_toml
from granum.core.errors import InputError, unknown_name
from granum.core.i18n import _, quoted
from granum.core.parameters import REQUIRED, Parameter
from granum.core.stand_ins import StandIns


def is_tracer(value: Any) -> bool:
    """Whether a value is being traced by JAX (jit, grad, vmap)."""
    jax = sys.modules.get("jax")
    return jax is not None and isinstance(value, jax.core.Tracer)


def out_of_bounds(value: Any, parameter: Parameter, where: str) -> InputError:
    """The error for a value outside the hard bounds of its kind."""
    kind = parameter.kind
    assert kind is not None
    if np.isnan(value):
        return given.not_a_number(parameter.name, where)
    shown = units.show(float(value), kind) if np.isfinite(value) else str(float(value))
    if kind.lower > -np.inf and kind.upper < np.inf:
        at_end = (kind.open_lower and value == kind.lower) or (kind.open_upper and value == kind.upper)
        word = _("between {low} and {high}, which are not possible themselves") if at_end else ""
        allowed = (word or _("between {low} and {high}")).format(
            low=units.show(kind.lower, kind), high=units.show(kind.upper, kind)
        )
    elif kind.lower > -np.inf:
        word = _("greater than {low}") if kind.open_lower else _("at least {low}")
        beside = units.best_unit(float(value), kind) if kind.lower == 0.0 else None
        allowed = word.format(low=units.show(kind.lower, kind, beside))
    elif kind.upper < np.inf:
        allowed = _("at most {high}").format(high=units.show(kind.upper, kind))
    else:
        allowed = _("a finite number")
    message = _("{label} ('{name}') = {value} is not possible{where}: it must be {allowed}.").format(
        label=parameter.label, name=parameter.name, value=shown, where=where, allowed=allowed
    )
    if kind.upper == 1.0 and 2.0 <= value <= 100.0 and value >= 100.0 * kind.lower:
        message += " " + _("Did you mean {value} %?").format(value=units.format_number(float(value)))
    return InputError(message, name=parameter.name, value=float(value), allowed=allowed)


def _forgotten_unit(value: float, parameter: Parameter, where: str) -> InputError:
    """The error for a bare number colder than any temperature here: it was meant in degrees Celsius."""
    message = _(
        "{label} ('{name}') = {value} K is below any operation here{where}: a number without a unit is "
        "read in kelvin. Did you mean {value} °C?"
    ).format(label=parameter.label, name=parameter.name, value=units.format_number(value), where=where)
    return InputError(message, name=parameter.name, value=value)


_DENSE = {"particle_density", "solid_density", "liquid_density", "crystal_density"}
_LIGHTEST = 25.0  # kg/m³; what is typed without a unit below it was meant in g/cm³ or relative to water


def not_a_specific_gravity(given: Any, parameter: Parameter, where: str = "") -> None:
    """Refuses the density of a solid or liquid that was given without a unit and is that of a gas."""
    if parameter.name not in _DENSE:
        return
    if isinstance(given, str):
        doubtful = units.has_unit(given) or units.thousands_or_decimals(given)
        found = None if doubtful else units.read_number(given)
    else:
        plain = isinstance(given, (int, float)) and not isinstance(given, bool)
        found = (float(given), "") if plain else None
    if found is None or not 0.0 < found[0] < _LIGHTEST:
        return
    message = _(
        "{label} ('{name}') = {value} kg/m³ is that of no solid or liquid{where}: a number without a unit is "
        "read in kg/m³. Did you mean {value} g/cm³?"
    ).format(label=parameter.label, name=parameter.name, value=units.format_number(found[0]), where=where)
    raise InputError(message, name=parameter.name, value=found[0])


def convert(value: Any, parameter: Parameter, where: str = "", several: bool = False) -> Any:
    """Whatever a user passes for a parameter as what the function body takes; raises one clear error
    otherwise.

    Text and Pint quantities become SI numbers; words become choices or laws; numbers are checked against the
    hard bounds when they are single values. Where ``several`` values may stand, arrays keep their
    out-of-range elements, which evaluation flags. Tracers pass.
    """
    if is_tracer(value):
        return value
    if value is None:
        if parameter.default is None or parameter.optional:
            return None
        raise InputError(
            _("'{name}' needs a value{where}.").format(name=parameter.name, where=where), name=parameter.name
        )
    if parameter.may_be_none and isinstance(value, str):
        if value.strip().lower() in ("none", _("none")):
            return None
        if not value.strip():
            raise InputError(
                _("'{name}' is empty{where}: 'none' goes without it; left out it is {default}.").format(
                    name=parameter.name,
                    where=where,
                    default=units.show(parameter.default, parameter.kind)
                    if parameter.kind
                    else parameter.default,
                ),
                name=parameter.name,
            )
    if parameter.law:
        return _law(value, parameter, where)
    if parameter.choices:
        return _choice(value, parameter, where)
    if parameter.kind is None:
        return _plain(value, parameter, where)
    kind, coldest = parameter.kind, parameter.coldest
    bare = not given.is_quantity(value) and not (isinstance(value, str) and units.has_unit(value))
    if isinstance(value, str):
        not_a_specific_gravity(value, parameter, where)
        read = (
            units.read_series if parameter.series else units.read_values if several else units.read_quantity
        )
        value = read(value, kind, parameter.name)
    elif given.is_quantity(value):
        value = units.quantity_to_si(value, kind, parameter.name)
    elif isinstance(value, (list, tuple)) or given.holds_objects(value):
        value = _items(value, parameter, where)
        if is_tracer(value):
            return value
    value = given.number_or_array(value, parameter.name, where, f"1.5 {parameter.units[0]}")
    if not given.is_array(value):
        if not hasattr(value, "at"):
            if bare and coldest is not None and -ZERO_CELSIUS < value < coldest:
                raise _forgotten_unit(value, parameter, where)
            if not kind.contains(value) or np.isinf(value):
                raise out_of_bounds(value, parameter, where)
            if parameter.series:
                value = np.asarray([value])
    elif parameter.series:
        array = np.asarray(value, dtype=float)
        if array.ndim > 1:
            raise InputError(
                _("'{name}' is one row of values{where}, not a table of {shape}.").format(
                    name=parameter.name, where=where, shape=" × ".join(map(str, array.shape))
                ),
                name=parameter.name,
            )
        bad = ~np.asarray(kind.contains(array))
        if bad.any():
            first = int(np.argmax(bad.ravel()))
            raise out_of_bounds(
                array.ravel()[first], parameter, where + _(" (item {index})").format(index=first + 1)
            )
    elif not several and not (hasattr(value, "at") and _inside_a_formula()):
        raise InputError(
            _(
                "'{name}' takes one value{where}; {count} were given. Call it once for each, or vary it "
                "with 'granum study'."
            ).format(name=parameter.name, where=where, count=np.size(value)),
            name=parameter.name,
        )
    return value


def _inside_a_formula() -> bool:
    """Whether a body is running: what it hands to a law is an array wherever its own inputs are."""
    from granum.core import flags

    return flags.nested()


def _items(values: Any, parameter: Parameter, where: str) -> Any:
    """A list as an array, each of its items converted; rows of unequal length are refused."""
    single, kind = replace(parameter, series=None, default=REQUIRED, optional=False), parameter.kind
    assert kind is not None
    if given.depth(values) > 3:
        raise InputError(
            _("'{name}' has lists in lists too deep{where}.").format(name=parameter.name, where=where),
            name=parameter.name,
        )
    items = [
        v
        if type(v) is float and kind.contains(v) and v not in (np.inf, -np.inf) and parameter.coldest is None
        else convert(v, single, where, several=True)
        for v in values
    ]
    if any(map(is_tracer, items)):
        import jax.numpy as jnp

        return jnp.asarray(items)
    if len(set(map(np.shape, items))) > 1:
        raise InputError(
            _("'{name}' has rows of unequal length{where}.").format(name=parameter.name, where=where),
            name=parameter.name,
        )
    return np.asarray(items, dtype=float)


def _choice(value: Any, parameter: Parameter, where: str) -> Any:
    if isinstance(value, str) and value not in parameter.choices:  # a number typed as text
        value = next((choice for choice in parameter.choices if str(choice) == value.strip()), value)
    if isinstance(value, int) and not isinstance(value, bool) and value not in parameter.choices:  # as text
        texts = [choice for choice in parameter.choices if isinstance(choice, str) and choice.isdecimal()]
        value = next((text for text in texts if int(text) == value), value)
    fits = isinstance(value, (str, int, float)) and any(
        value == choice and isinstance(value, bool) == isinstance(choice, bool)
        for choice in parameter.choices
    )
    if not fits:
        raise unknown_name(
            _("Choice for '{name}'").format(name=parameter.name),
            given.shown(value),
            map(str, parameter.choices),
            where,
        )
    return value


def _plain(value: Any, parameter: Parameter, where: str) -> Any:
    if parameter.sort is bool:
        word = given.truth(value)
        if word is None:
            raise InputError(
                _("'{name}' takes yes or no{where}.").format(name=parameter.name, where=where),
                name=parameter.name,
            )
        return word
    if parameter.sort is int:
        return _whole(value, parameter, where)
    if parameter.sort is str and not isinstance(value, str):
        raise InputError(
            _("'{name}' = {value} is not a text{where}.").format(
                name=parameter.name, value=given.shown(value), where=where
            ),
            name=parameter.name,
        )
    return value


def _whole(value: Any, parameter: Parameter, where: str) -> int:
    count = given.whole_number(value)
    if count is None:
        raise InputError(
            _("'{name}' = {value} must be a whole number{where}.").format(
                name=parameter.name, value=given.shown(value), where=where
            ),
            name=parameter.name,
        )
    limits = parameter.within
    if limits is not None and not limits.lower <= count <= limits.upper:
        raise InputError(
            _(
                "{label} ('{name}') = {value} is not possible{where}: it must be a whole number from "
                "{low} to {high}."
            ).format(
                label=parameter.label,
                name=parameter.name,
                value=given.shown(count),
                where=where,
                low=int(limits.lower),
                high=int(limits.upper),
            ),
            name=parameter.name,
        )
    return count


def _table(text: str, parameter: Parameter, where: str) -> Any:
    """A law with its options as typed on a command line, ``{law = "power_law", exponent = 2}``, or as JSON
    has it.
    """
    with contextlib.suppress(ValueError, RecursionError):
        return json.loads(text)
    try:
        return read_toml(f"value = {text}")["value"]
    except InputError:
        raise InputError(
            _("'{name}' is not a table such as {{law = \"…\", option = 1}}{where}.").format(
                name=parameter.name, where=where
            ),
            name=parameter.name,
        ) from None


def _law(value: Any, parameter: Parameter, where: str) -> Any:
    assert parameter.law is not None
    if not isinstance(value, (str, Mapping)):
        if value is parameter.default:
            return value
        from granum.core.laws import as_law

        return as_law(value, parameter.law, parameter.name, where)
    if isinstance(value, str) and value.lstrip().startswith("{"):
        value = _table(value, parameter, where)
    if isinstance(value, str):
        return law_of(parameter.law, value, where)
    options = dict(value)
    name = options.pop("law", None)
    if not isinstance(name, str):
        raise InputError(
            _("'{name}' is a table without 'law'{where}; name the law, as in {{law = \"…\", …}}.").format(
                name=parameter.name, where=where
            ),
            name=parameter.name,
        )
    return law_of(parameter.law, name, where, options)


def law_of(family: str, name: str, where: str = "", options: Mapping[str, Any] | None = None) -> Any:
    """A law of a family by name, with the options a user gave for it: a class is made of them; a formula
    keeps them, converted and checked as its inputs are.
    """
    found = registry.law(family, name, where)
    if isinstance(found, type):
        return found(**(options or {}))
    if not options:
        return found
    from granum.core.laws import FormulaWith

    known = {p.name: p for p in found.card.parameters}
    for name in options:
        if name not in known:
            raise unknown_name(_("Option"), name, known, _("for {owner}").format(owner=found.key))
    place = _(" for {owner}").format(owner=found.key) + where
    values = {name: convert(value, known[name], place) for name, value in options.items()}
    fixed = {n: v for n, v in values.items() if v is None or isinstance(v, (str, bool, int))}
    numbers = {n: v for n, v in values.items() if n not in fixed}
    return FormulaWith(found, tuple(fixed.items()), tuple(numbers), tuple(numbers.values()))


@dataclass(frozen=True)
class Binder:
    """Matches positional and named arguments to parameters, with near-miss suggestions for unknown names."""

    owner: str
    parameters: tuple[Parameter, ...]
    index: dict[str, int] = field(default_factory=dict)
    along: tuple[tuple[int, ...], ...] = ()
    """Places of parameters that run along one and the same axis."""

    @staticmethod
    def of(owner: str, parameters: tuple[Parameter, ...]) -> Binder:
        """A binder for the card named ``owner``."""
        axes: dict[str, list[int]] = {}
        for i, p in enumerate(parameters):
            if p.series:
                axes.setdefault(p.series, []).append(i)
        along = tuple(tuple(places) for places in axes.values() if len(places) > 1)
        return Binder(owner, parameters, {p.name: i for i, p in enumerate(parameters)}, along)

    def resolved(
        self, args: tuple[Any, ...], kwargs: Mapping[str, Any]
    ) -> tuple[Mapping[str, Any], dict[str, str]]:
        """The arguments with what stands for others in their place (the properties of a ``fluid``, a velocity
        for a mass flux), and what each of these says of its origin; explicit values win over a fluid's.
        """
        values, origins = dict(kwargs), dict[str, str]()
        if "fluid" in kwargs and "fluid" not in self.index:
            # the core knows no materials; whoever names one has them
            stated = import_module("granum.materials.stated")
            del values["fluid"]
            asked = self.parameters[len(args) :]
            found, origin = stated.properties(kwargs["fluid"], self.owner, asked, values)
            if "kinematic_viscosity" in values and "kinematic_viscosity" not in self.index:
                found.pop("dynamic_viscosity", None)
            values |= found
            origins = dict.fromkeys(found, str(origin))

        def value_of(name: str) -> Any:
            place = self.index[name]
            known = args[place] if place < len(args) else values.get(name, self.parameters[place].default)
            return (
                None
                if known is REQUIRED or known is None
                else convert(known, self.parameters[place], "", True)
            )

        standing = StandIns(self.owner, self.index, len(args), values, value_of, origins)
        standing.settle()
        return standing.values, standing.origins

    def stands_in(self, kwargs: Mapping[str, Any]) -> bool:
        """Whether something may stand for another: a name that no input has, or a viscosity with its unit."""
        return not kwargs.keys() <= self.index.keys() or isinstance(kwargs.get("dynamic_viscosity"), str)

    def left_out(self, args: tuple[Any, ...], kwargs: Mapping[str, Any]) -> frozenset[str]:
        """Names that were not given and have a default other than nothing."""
        rest = self.parameters[len(args) :]
        return frozenset(
            p.name for p in rest if p.name not in kwargs and not p.required and p.default is not None
        )

    def arrange(self, args: tuple[Any, ...], kwargs: Mapping[str, Any]) -> list[Any]:
        """Raw values in the order of the parameters, defaults filled in; nothing converted yet."""
        if len(args) > len(self.parameters):
            raise InputError(
                _("{owner} takes {count} values; {given} were given.").format(
                    owner=self.owner, count=len(self.parameters), given=len(args)
                )
            )
        values = list(args) + [p.default for p in self.parameters[len(args) :]]
        for name, value in kwargs.items():
            position = self.index.get(name)
            if position is None:
                raise unknown_name(_("Input"), name, self.index, _("for {owner}").format(owner=self.owner))
            if position < len(args):
                raise InputError(
                    _("'{name}' was given twice for {owner}.").format(name=name, owner=self.owner), name=name
                )
            values[position] = value
        missing = [p for p, value in zip(self.parameters, values, strict=True) if value is REQUIRED]
        if missing:
            raise InputError(
                _("{owner} needs {names}.").format(
                    owner=self.owner,
                    names=", ".join(
                        f"{quoted(p.name)} "
                        f"({p.label}{', ' + p.units[0] if p.units and p.units[0] != 'dimensionless' else ''})"
                        for p in missing
                    ),
                ),
                missing=[p.name for p in missing],
            )
        return values

    def bind(self, args: tuple[Any, ...], kwargs: Mapping[str, Any]) -> dict[str, Any]:
        """Converted values by name."""
        where = _(" for {owner}").format(owner=self.owner)
        given, _origins = self.resolved(args, kwargs)
        return {
            p.name: convert(value, p, where)
            for p, value in zip(self.parameters, self.arrange(args, given), strict=True)
        }

    def equally_long(self, values: Sequence[Any]) -> None:
        """Refuse series along one axis that are not equally long; an optional one may be a single value.
        Procedures, some of which repeat a single value, look for themselves.
        """
        for group in self.along:
            rows = [(self.parameters[i], np.shape(values[i])[-1]) for i in group if np.ndim(values[i])]
            if len({count for p, count in rows if p.required or count > 1}) > 1:
                shown = ", ".join(f"{quoted(p.name)} ({count})" for p, count in rows)
                raise InputError(
                    _("Unequal numbers of values: {names}.").format(names=shown), name=rows[0][0].name
                )
