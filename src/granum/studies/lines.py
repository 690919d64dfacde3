"""A process line as the subject of a study: any unit parameter or feed figure in, any result or stream figure
out.

Inputs: ``unit.parameter`` (also inside a law: ``crystallizer.growth.growth_order``, or one element of a list:
``crystallizer.profile[2]``), ``feed.temperature``, ``feed.liquid_flow``, ``feed.solid_flow``,
``feed.gas_flow``, ``feed.mass_flow`` (all phases in proportion) and ``feed.liquid.NAME`` (mass fraction in
its phase, the others keeping their proportions). Figures: ``unit.result``, ``unit.parameter``,
``stream.mass_flow``, ``stream.temperature``, ``stream.moisture_dry_basis``, ``stream.median_size``,
``stream.liquid.NAME`` and so on.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

import jax
import jax.numpy as jnp
import numpy as np

from granum.core import flags
from granum.core.errors import ApplicabilityError, InputError, unknown_name
from granum.core.i18n import _
from granum.core.kinds import KINDS
from granum.core.parameters import Parameter
from granum.flowsheet import Flowsheet
from granum.flowsheet.findings import CLOSURE, LEAST, SATURATED, findings, known_temperatures
from granum.flowsheet.ladder import RUNGS, at_rung, beginning
from granum.flowsheet.solving import no_stream
from granum.flowsheet.specifications import Designed, Target
from granum.flowsheet.stream_figures import (
    changed,
    feed_parameter,
    given_value,
    stream_figure,
    stream_parameter,
    told_of,
)
from granum.flowsheet.utilities import FIGURES, REMOVED, UTILITIES, WATER, totals
from granum.studies.subjects import (
    FINE,
    LOST,
    NEGATIVE,
    NOT_CLOSED,
    NOT_CONVERGED,
    OVERSATURATED,
    TOO_HOT,
    UNMET,
    Computed,
    FormulaSubject,
    Subject,
    Variable,
    split_index,
)


@dataclass(frozen=True)
class LineSubject(Subject):
    """A flowsheet with its design specifications."""

    sheet: Flowsheet
    targets: tuple[Target, ...]
    name: str
    rung: int = 0
    """Which solver of the ladder."""

    @property
    def harder(self) -> LineSubject | None:
        if self.rung == RUNGS - 1 or not any(block.tears for block in self.sheet.blocks):
            return None
        return self.kept("harder", lambda: replace(self, rung=self.rung + 1))

    @staticmethod
    def of(line: Any, recipe: Any = None) -> LineSubject:
        """A line as read from a case file, or a bare flowsheet."""
        sheet = getattr(line, "sheet", line)
        name = getattr(line, "title", "") or _("Process line")
        return LineSubject(sheet, tuple(getattr(line, "targets", ())), name, recipe=recipe)

    @property
    def title(self) -> str:
        return self.name

    def identity(self) -> str:
        return f"{self.name} {self.targets}"

    @property
    def batched(self) -> bool:
        return False

    def input(self, path: str) -> Variable:
        plain, index = split_index(path)
        head, *rest = plain.split(".")
        feed = self.sheet.feeds.get(head)
        if feed is not None and rest:
            return Variable(path, feed_parameter(feed, head, ".".join(rest)))
        keys = self.sheet.locate(plain)
        parameter = _declared(self.sheet.units[keys[0]], keys[1:])
        value = self.sheet.value(plain)
        if value is None:
            raise InputError(
                _("'{name}' has no value in the case: give it one to start from.").format(name=plain),
                name=plain,
            )
        if isinstance(value, (bool, int, str)) or not (
            np.issubdtype(np.asarray(value).dtype, np.floating) if _numeric(value) else False
        ):
            raise InputError(
                _(
                    "'{name}' is not a quantity that can vary continuously: it is a choice, a law or a "
                    "whole number."
                ).format(name=plain),
                name=plain,
            )
        if (index is None) != (np.ndim(value) == 0):
            raise InputError(
                _("'{name}' is a list: vary one element, as in '{name}[0]'.").format(name=plain)
                if index is None
                else _("'{name}' is a single value: leave out the index.").format(name=plain)
            )
        if index is not None and not -len(value) <= index < len(value):
            raise InputError(
                _("'{name}' has {count} elements: index {index} is none of them.").format(
                    name=plain, count=len(value), index=index
                )
            )
        if any(t.vary == plain for t in self.targets):
            raise InputError(
                _(
                    "'{name}' is found by a design specification of the case: it cannot be varied as well."
                ).format(name=plain)
            )
        return Variable(path, parameter if index is None else replace(parameter, series=None))

    def nominal(self, path: str) -> Any:
        plain, index = split_index(path)
        value = given_value(self.sheet, plain)
        return float(value if index is None else value[index])

    def own_output(self, path: str) -> Variable:
        plain, index = split_index(path)
        unit, _dot, name = plain.partition(".")
        if unit == UTILITIES and name in FIGURES and unit not in self.sheet.units:
            return Variable(path, FIGURES[name])
        if unit in self.sheet.units:
            card = type(self.sheet.units[unit]).card
            known = {p.name: p for p in (*card.parameters, *card.outputs) if p.kind is not None}
            known |= {use.parameter.name: use.parameter for use in card.utilities}
            known |= {
                n: Parameter(n, KINDS["Power"])
                for n in self.sheet.units[unit].power_names()
                if n not in known
            }
            if name in known:
                if known[name].series and index is None:
                    raise InputError(
                        _("'{name}' is a list: ask for one element, as in '{name}[0]'.").format(name=plain)
                    )
                return Variable(path, known[name])
        if (told := told_of(self.sheet.links, plain)) is not None:
            link, word = told
            mixture = next(iter(self.sheet.feeds.values())).mixture
            return Variable(path, stream_parameter(mixture, link.name, word))
        if unit in self.sheet.units and "." in plain:
            raise unknown_name(_("Result"), name, known, _("of unit '{unit}'").format(unit=unit))
        raise unknown_name(_("Figure"), plain, (*self.outputs(), *self.quantities))

    def outputs(self) -> tuple[str, ...]:
        own = [
            f"{unit}.{p.name}"
            for unit in self.sheet.order
            for p in type(self.sheet.units[unit]).card.outputs
            if p.kind is not None and not p.series
        ]
        unsaid = self.kept("unsaid", self._unsaid)
        own = [path for path in own if path not in unsaid]
        return tuple(dict.fromkeys((*(t.vary for t in self.targets), *own, *self.quantities)))

    def _unsaid(self) -> frozenset[str]:
        """Results that have no value with these settings, such as the use of a washing capacity where none is
        declared.
        """
        streams = dict.fromkeys((link.name for link in self.sheet.links), no_stream(self.sheet))
        found: set[str] = set()
        for name, unit in self.sheet.units.items():
            may = [p.name for p in type(unit).card.outputs if p.optional]
            if may:
                inlets = self.sheet.inlets_of(name, streams)
                with flags.collect():  # of what does not flow
                    told = jax.eval_shape(lambda given, unit=unit: unit.operate(**given).figures, inlets)
                found |= {f"{name}.{result}" for result in may if getattr(told, result) is None}
        return frozenset(found)

    def taken(self) -> tuple[str, ...]:
        """What the units and the whole line take of each utility, which is shown when it is asked for."""
        own = [f"{u}.{name}" for u in self.sheet.order for name in type(self.sheet.units[u]).utilities]
        dries = any(
            p.name in REMOVED for u in self.sheet.order for p in type(self.sheet.units[u]).card.outputs
        )
        whole = [f"{UTILITIES}.{name}" for name in FIGURES if dries or name not in WATER]
        return (*whole, *own)

    def arrays(self) -> Any:
        return self.sheet

    def begin(self, among_many: bool = False) -> Any:
        return beginning(self.sheet, self.targets, among_many=among_many and self.rung == 0)

    def compute(
        self, arrays: Any, values: Mapping[str, Any], wanted: tuple[str, ...], begin: Any
    ) -> Computed:
        found = at_rung(self._changed(arrays, values), self.targets, self.rung, begin)
        code = verdict(found)
        line, streams = found.line, found.solution.streams
        flags.hand_on([r for records in found.solution.records.values() for r in records])

        def lookup(path: str) -> Any:
            plain, index = split_index(path)
            unit, _dot, name = plain.partition(".")
            if unit in line.units:
                thing = line.units[unit]
                told_too = name in {p.name for p in type(thing).card.outputs}
                # what is not set may be a figure of the same name, such as a pressure
                is_open = told_too and getattr(thing, name, None) is None
                if name in {p.name for p in type(thing).card.parameters} and not is_open:
                    value = getattr(thing, name)
                    return value if index is None else value[index]
                if told_too:
                    value = getattr(found.solution.sheets[unit][0], name)
                    return value if index is None else value[index]
                if name in type(thing).utilities:
                    uses = found.solution.sheets[unit].uses
                    if name not in uses:
                        raise ApplicabilityError(
                            _(
                                "'{name}' is not known of this line: the library lacks a property that it "
                                "needs, such as the viscosity of the solution."
                            ).format(name=plain)
                        )
                    return uses[name]
                if name in thing.power_names():
                    return found.solution.powers[unit][name]
            if unit == UTILITIES and name in FIGURES:
                sheets = found.solution.sheets
                uses = {u: sheets[u].uses for u in line.order}
                figures = {u: sheets[u].figures for u in line.order}
                return getattr(totals(line, uses, figures, streams), name)
            told = told_of(line.links, plain)
            assert told is not None  # looked up in own_output
            return stream_figure(streams[told[0].name], told[1])

        among_many = self.rung == 0 and bool(begin.learned)
        return Computed(lookup, code, beginning(line, self.targets, found, among_many=among_many))

    def reason(self, code: int, inputs: tuple[str, ...], outputs: tuple[str, ...]) -> str:
        if code >= LOST:
            return _("unit '{unit}' has no solution").format(unit=self.sheet.order[code - LOST])
        return super().reason(code, inputs, outputs)

    def _changed(self, sheet: Flowsheet, values: Mapping[str, Any]) -> Flowsheet:
        """The sheet with other values; figures of feeds first shares, then flows."""
        plain: dict[str, Any] = {}
        for path, value in values.items():
            name, index = split_index(path)
            if index is None:
                plain[name] = value
            else:
                plain[name] = jnp.asarray(plain.get(name, sheet.value(name))).at[index].set(value)
        return changed(sheet, plain)


def verdict(found: Designed) -> Any:
    """Whether a solved line counts as a solution: ``FINE``, or the code of the reason why its figures are
    none.
    """
    met = jnp.all(jnp.stack([jnp.isfinite(v) for v in found.values.values()] or [jnp.asarray(True)]))
    measured = findings(found.line, found.solution)
    # false when not finite
    code = jnp.where(jnp.all((measured.mass <= CLOSURE) & (measured.energy <= CLOSURE)), FINE, NOT_CLOSED)
    code = jnp.where(jnp.all(measured.finite) & ~known_temperatures(measured), TOO_HOT, code)
    code = jnp.where(jnp.any(measured.saturation > SATURATED), OVERSATURATED, code)
    code = jnp.where(jnp.any(measured.lowest < LEAST), NEGATIVE, code)
    code = jnp.where(jnp.any(measured.lost), LOST + jnp.argmax(measured.lost), code)
    unsettled = jnp.where(
        jnp.any(measured.lost) & met, code, jnp.where(met & ~found.solution.converged, NOT_CONVERGED, UNMET)
    )
    return jnp.where(found.converged, code, unsettled)


def _numeric(value: Any) -> bool:
    return isinstance(value, float) or hasattr(value, "dtype")


def _declared(thing: Any, names: tuple[str, ...]) -> Parameter:
    """The declaration of a field, also inside a law."""
    for name in names[:-1]:
        thing = getattr(thing, name)
    card = getattr(type(thing), "card", None)
    found = {p.name: p for p in card.parameters} if card is not None else {}
    return found.get(names[-1], Parameter(names[-1]))


def subject_of(
    thing: Any, fixed: Mapping[str, Any] | None = None, quantities: Mapping[str, Any] | None = None
) -> Subject:
    """The subject of a study: a line (``granum.read``), a flowsheet, a formula or the key of a card."""
    if isinstance(thing, Subject):
        made: Subject = thing
    elif hasattr(thing, "sheet") or hasattr(thing, "links"):
        if fixed:
            raise InputError(_("A line holds its own inputs: change them with 'with_values'."))
        made = LineSubject.of(thing)
    else:
        made = FormulaSubject.of(thing, fixed or {})
    return made.with_quantities(quantities) if quantities else made
