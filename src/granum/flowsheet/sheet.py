"""``Flowsheet``: named units and the streams between them, checked for open ports before anything is
computed.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, Any

import equinox as eqx

from granum.core.errors import CaseError, together, unknown_name
from granum.core.i18n import _
from granum.core.stand_ins import not_varied
from granum.flowsheet.plan import Block, Link, plan
from granum.streams.stream import Stream
from granum.streams.units import Unit

if TYPE_CHECKING:
    from granum.flowsheet.run import Run
    from granum.flowsheet.specifications import Target
    from granum.flowsheet.watching import Watch


class Flowsheet(eqx.Module):
    """Named units, named feeds and the links between ports. A frozen pytree: replace a parameter with
    ``with_values``.

    Parameters
    ----------
    units: name → unit.
    feeds: stream name → stream entering from outside.
    links: every stream of the line, feeds and products included.
    order: unit names as declared.
    """

    units: dict[str, Unit]
    feeds: dict[str, Stream]
    links: tuple[Link, ...] = eqx.field(static=True)
    order: tuple[str, ...] = eqx.field(static=True)

    def __init__(
        self, units: Mapping[str, Unit], feeds: Mapping[str, Stream], links: Mapping[str, tuple[str, str]]
    ):
        """``links`` maps a stream name to (origin, target), each ``unit.port``; a feed has origin ``""``.

        A unit with one inlet (or one outlet) may be named without its port. Outlets that nothing takes become
        products named ``unit.port``.
        """
        self.units, self.feeds = dict(units), dict(feeds)
        self.order = tuple(units)  # dictionaries come out of compiled code sorted by key
        named, problems = [], []
        for name, (origin, target) in links.items():
            try:
                named.append(Link(name, self._outlet(name, origin), self._inlet(name, target)))
            except CaseError as problem:
                problems.append(problem)
        if problems:
            raise together(problems)
        taken = {k.origin for k in named}
        for unit, thing in self.units.items():
            named += [
                Link(f"{unit}.{port}", f"{unit}.{port}", "")
                for port in thing.outlet_names()
                if f"{unit}.{port}" not in taken
            ]
        self.links = tuple(named)
        if problems := list(self._incomplete()):
            raise together(problems)

    def _unit(self, end: str, stream: str) -> tuple[str, str]:
        unit, _dot, port = end.partition(".")
        if unit not in self.units:
            raise CaseError(
                unknown_name(
                    _("Unit"), unit, self.units, _("in stream '{stream}'").format(stream=stream)
                ).message,
                stream=stream,
            )
        return unit, port

    def _outlet(self, stream: str, end: str) -> str:
        if not end:
            return ""
        unit, port = self._unit(end, stream)
        ports = self.units[unit].outlet_names()
        if not port and len(ports) == 1:
            return f"{unit}.{ports[0]}"
        if port not in ports:
            place = _("of unit '{unit}' in stream '{stream}'").format(unit=unit, stream=stream)
            raise CaseError(unknown_name(_("Outlet"), port, ports, place).message, stream=stream)
        return end

    def _inlet(self, stream: str, end: str) -> str:
        if not end:
            return ""
        unit, port = self._unit(end, stream)
        ports = self.units[unit].inlet_names()
        if ports is None:
            return end if port else f"{unit}.{stream}"
        if not port and len(ports) == 1:
            return f"{unit}.{ports[0]}"
        if port not in ports:
            place = _("of unit '{unit}' in stream '{stream}'").format(unit=unit, stream=stream)
            raise CaseError(unknown_name(_("Inlet"), port, ports, place).message, stream=stream)
        return end

    def _incomplete(self) -> Iterator[CaseError]:
        """What is connected twice, or not at all."""
        for end in ("origin", "target"):
            seen: dict[str, str] = {}
            for k in self.links:
                place = getattr(k, end)
                if place and place in seen:
                    yield CaseError(
                        _(
                            "Streams '{first}' and '{second}' are both connected to '{port}'; use a "
                            "mixer or a splitter."
                        ).format(first=seen[place], second=k.name, port=place)
                    )
                seen[place] = k.name
        names = [k.name for k in self.links]
        for k in self.links:
            if not k.origin and k.name not in self.feeds:
                yield CaseError(
                    _("Stream '{stream}' comes from nowhere: give it under [feeds] or an origin.").format(
                        stream=k.name
                    )
                )
        for name in self.feeds:
            if name not in names or not self.link(name).target:
                yield CaseError(_("Feed '{feed}' goes nowhere: name the unit it enters.").format(feed=name))
        entered = {k.target for k in self.links}
        for unit, thing in self.units.items():
            for port in thing.inlet_names() or ():
                if f"{unit}.{port}" not in entered and port not in thing.optional_inlets():
                    yield CaseError(
                        _(
                            "Inlet '{port}' of unit '{unit}' is open: connect a stream or a feed to it."
                        ).format(port=port, unit=unit),
                        unit=unit,
                        port=port,
                    )

    def solve(self, targets: tuple[Target, ...] = (), watch: Watch | None = None, title: str = "") -> Run:
        """Solve, check and audit: figures, checks, flags, closures, note and report. Raises for whatever is
        not a solution, see ``Line.solve``.

        ``targets`` are design specifications; ``watch`` is told of each pass through a loop, and may limit
        the time or stop. For a pure function of the parameters, to batch or to differentiate, see
        ``granum.flowsheet.solve``.
        """
        from granum.flowsheet.run import Line

        return Line(title, self, targets).solve(watch)

    @property
    def blocks(self) -> tuple[Block, ...]:
        """Units in order of calculation, loops with their torn streams."""
        return plan(self.order, self.links)

    @property
    def products(self) -> tuple[str, ...]:
        """Names of the streams that leave the line."""
        return tuple(k.name for k in self.links if not k.target)

    def link(self, name: str) -> Link:
        """A stream's link by name."""
        found = {k.name: k for k in self.links}
        if name not in found:
            raise unknown_name(_("Stream"), name, found)
        return found[name]

    def inlets_of(self, unit: str, streams: Mapping[str, Stream]) -> dict[str, Stream]:
        """The streams entering a unit, by port."""
        return {k.target.partition(".")[2]: streams[k.name] for k in self.links if k.target_unit == unit}

    def locate(self, path: str) -> tuple[str, ...]:
        """Splits ``unit.parameter[.field]`` or ``feed.field`` and checks that it exists."""
        head, *rest = path.split(".")
        if head in self.units and rest:
            thing: Any = self.units[head]
        elif head in self.feeds and rest:
            thing = self.feeds[head]
        else:
            raise unknown_name(_("Unit or feed"), head, (*self.units, *self.feeds))
        for name in rest:
            fields = getattr(thing, "__dataclass_fields__", {})
            if name not in fields:
                asked = [p.name for p in thing.card.parameters] if hasattr(thing, "card") else list(fields)
                if told := not_varied(name, asked, " " + _("of '{owner}'").format(owner=head)):
                    raise told
                raise unknown_name(_("Parameter"), name, asked, _("of '{owner}'").format(owner=head))
            thing = getattr(thing, name)
        return (head, *rest)

    def value(self, path: str) -> Any:
        """The value of ``unit.parameter`` or ``feed.field``."""
        head, *rest = self.locate(path)
        thing: Any = self.units.get(head, self.feeds.get(head))
        for name in rest:
            thing = getattr(thing, name)
        return thing

    def with_values(self, values: Mapping[str, Any]) -> Flowsheet:
        """The same line with other parameter values; keys are ``unit.parameter`` or ``feed.field``, values
        SI.
        """
        line = self
        for path, value in values.items():
            keys = self.locate(path)

            def where(sheet: Flowsheet, keys: tuple[str, ...] = keys) -> Any:
                thing: Any = sheet.units.get(keys[0], sheet.feeds.get(keys[0]))
                for name in keys[1:]:
                    thing = getattr(thing, name)
                return thing

            line = eqx.tree_at(where, line, value, is_leaf=lambda x: x is None)
        return line
