"""The flow diagram as SVG: units in columns along the flow, so many side by side and the rest beneath,
recycles in lanes between, streams colored by main phase.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from html import escape
from typing import Any, NamedTuple, Protocol

import rustworkx as rx

from granum.core.i18n import _
from granum.core.kinds import KINDS
from granum.core.units import show
from granum.flowsheet.plan import Block, Link, returning
from granum.flowsheet.symbols import symbol_of
from granum.streams.names import port_label, pretty
from granum.streams.stream import main_phase

ROW, BOX, LANE, MARGIN, LETTER, BOLD, TRACK, PITCH = 124, 60, 22, 16, 6.6, 7.6, 9, 20
ACROSS = 5  # columns side by side
PHASE_COLORS = {"solid": "#b7791f", "liquid": "#2b6cb0", "gas": "#6b7f99", "": "#1c2430"}


class Drawable(Protocol):
    """What can be drawn: a flowsheet, or the outline of a line that is not finished."""

    @property
    def order(self) -> tuple[str, ...]: ...
    @property
    def links(self) -> tuple[Link, ...]: ...
    @property
    def blocks(self) -> tuple[Block, ...]: ...
    @property
    def units(self) -> dict[str, Any]: ...


class Loose(NamedTuple):
    """An inlet that nothing enters, drawn so that something can be led to it."""

    unit: str
    port: str
    needed: bool


def _columns(line: Drawable) -> dict[str, int]:
    torn = returning(line.blocks, line.links)
    place = {unit: i for i, unit in enumerate(line.order)}
    graph = rx.PyDiGraph()
    graph.add_nodes_from(line.order)
    graph.add_edges_from_no_data(
        [
            (place[k.source_unit], place[k.target_unit])
            for k in line.links
            if k.origin and k.target and k.name not in torn
        ]
    )
    onward = rx.topological_sort(graph)
    columns: dict[str, int] = {}
    for i in onward:
        columns[graph[i]] = max((columns[unit] + 1 for unit in graph.predecessors(i)), default=0)
    # pull sources such as an air heater next to what they serve
    for i in reversed(onward):
        unit, later = graph[i], [columns[unit] for unit in graph.successors(i)]
        if later and not graph.in_degree(i):
            columns[unit] = max(columns[unit], min(later) - 1)
    return columns


def _label(k: Link) -> str:
    """The name of a stream as the diagram prints it; an open end, being beside its unit, has its port."""
    _unit, _dot, port = k.name.partition(".")
    return port_label(port) if port and not k.target else pretty(k.name)


def _wide(text: str) -> float:
    return LETTER * len(text)


def _hanging(unit: str) -> float:
    """How far the name under a unit stands out on either side of it."""
    return max(0.0, (BOLD * len(pretty(unit)) - BOX) / 2)


def _port(i: int, count: int) -> float:
    """Height of one of so many ports on the side of a unit."""
    pitch = min(PITCH, BOX / max(count - 1, 1))
    return BOX / 2 + pitch * (i - (count - 1) / 2)


class _Sheet:
    """Where everything stands. Columns and the gaps between them have the same places in every band, so that
    verticals cross bands beside the units.
    """

    def __init__(self, line: Drawable, across: int, loose: Iterable[Loose], growing: bool):
        self.line, self.growing = line, growing
        columns = _columns(line)
        count = max(columns.values(), default=0) + 1
        bands = -(-count // max(across, 1))
        self.across = -(-count // bands)
        self.band = {u: c // self.across for u, c in columns.items()}
        self.column = {u: c % self.across for u, c in columns.items()}
        self.row: dict[str, int] = {}
        used: dict[tuple[int, int], int] = {}
        for unit in line.order:
            place = (self.band[unit], self.column[unit])
            self.row[unit] = used.get(place, 0)
            used[place] = self.row[unit] + 1
        self.inlets = {u: [k for k in line.links if k.target and k.target_unit == u] for u in line.order}
        self.outlets = {u: [k for k in line.links if k.origin and k.source_unit == u] for u in line.order}
        self.loose = {u: [one for one in loose if one.unit == u] for u in line.order}
        self.inner = [k for k in line.links if k.origin and k.target]
        self.above = [k.name for k in self.inner if self._same_band(k) and self._span(k) > 1]
        self.below = [k.name for k in self.inner if not self._same_band(k) or self._span(k) <= 0]
        self._vertical(bands, used)
        self._horizontal()
        self._lane_names()

    def _same_band(self, k: Link) -> bool:
        return self.band[k.source_unit] == self.band[k.target_unit]

    def _span(self, k: Link) -> int:
        return self.column[k.target_unit] - self.column[k.source_unit]

    def lanes(self, names: list[str], band: int) -> list[str]:
        """Streams that run in the lanes above or below a band: those that leave it."""
        return [k.name for k in self.inner if k.name in names and self.band[k.source_unit] == band]

    def _vertical(self, bands: int, used: Mapping[tuple[int, int], int]) -> None:
        self.top, self.bottom = [], []
        y = 0.0
        for band in range(bands):
            y += MARGIN + LANE * len(self.lanes(self.above, band))
            self.top.append(y)
            y += ROW * max((n for (b, _c), n in used.items() if b == band), default=1) - (ROW - BOX) + 30
            self.bottom.append(y)
            y += LANE * len(self.lanes(self.below, band)) + 10
        self.height = y + 4

    def _horizontal(self) -> None:
        """Widths of the gaps: verticals of what leaves, its names, verticals between neighbors, names of
        feeds, verticals of what enters.
        """
        n = self.across
        self.hanging = [
            max((_hanging(u) for u in self.column if self.column[u] == c), default=0.0) for c in range(n)
        ]
        out, names, middle, feeding, into = ([0.0] * (n + 1) for _i in range(5))
        self.track: dict[tuple[str, str], float] = {}
        self.named: dict[str, float] = {}  # width of the longest name beside what leaves a unit
        self.taken: dict[tuple[str, int, int], list[str]] = {}
        for unit in self.line.order:
            c = self.column[unit]
            detours = [k for k in self.outlets[unit] if k.name in (*self.above, *self.below)]
            for k in detours:
                out[c + 1] = max(out[c + 1], self._take(k.name, "out", (self.band[unit], c)))
            for k in self.inlets[unit]:
                if k.name in (*self.above, *self.below):
                    into[c] = max(into[c], self._take(k.name, "in", (0, c)))
            named = [k for k in self.outlets[unit] if k not in detours]
            if named:
                plus = 26.0 if self.growing and any(not k.target for k in named) else 0.0
                self.named[unit] = max(_wide(_label(k)) for k in named)
                names[c + 1] = max(names[c + 1], 22.0 + self.named[unit] + plus)
            for k in self.inlets[unit]:
                if not k.origin:
                    feeding[c] = max(feeding[c], 14.0 + _wide(_label(k)))
            for one in self.loose[unit]:
                feeding[c] = max(feeding[c], 26.0 + _wide(port_label(one.port)))
        between: dict[tuple[int, int], list[Link]] = {}
        for k in self.inner:
            if k.name not in self.above and k.name not in self.below:
                between.setdefault((self.band[k.source_unit], self.column[k.source_unit]), []).append(k)
        for (_band, c), links in between.items():
            middle[c + 1] = max(middle[c + 1], TRACK * len(links) + 6.0)
            for i, k in enumerate(links):
                self.track[k.name, "middle"] = TRACK * i
        self.out, self.into, self.x = out, into, []
        x = 0.0
        self.middle = [0.0]
        for c in range(n):
            x += out[c] + names[c]
            if c:
                self.middle.append(x + 4.0)
            x += (
                middle[c]
                + max(feeding[c], 12.0 if not c else 30.0, self.hanging[c] - into[c] + 6.0)
                + into[c]
            )
            self.x.append(x)
            x += BOX
        self.width = x + max(out[n] + names[n], 14.0, self.hanging[n - 1]) + 10.0

    def _take(self, name: str, side: str, beside: tuple[int, int]) -> float:
        """The next free vertical beside a column of units; gives the room that they then need."""
        taken = self.taken.setdefault((side, *beside), [])
        taken.append(name)
        clear = max(20.0 if side == "in" else 14.0, self.hanging[beside[1]] + 5.0)
        self.track[name, side] = clear + TRACK * (len(taken) - 1)
        return self.track[name, side] + TRACK

    def corner(self, unit: str) -> tuple[float, float]:
        """Upper left corner of a unit."""
        return self.x[self.column[unit]], self.top[self.band[unit]] + ROW * self.row[unit]

    def inlet(self, unit: str, what: Link | Loose) -> tuple[float, float]:
        """Where a stream enters a unit."""
        mates = [*self.inlets[unit], *self.loose[unit]]
        x, y = self.corner(unit)
        return x, y + _port(mates.index(what), len(mates))

    def outlet(self, k: Link) -> tuple[float, float]:
        """Where a stream leaves its unit."""
        mates = self.outlets[k.source_unit]
        x, y = self.corner(k.source_unit)
        return x + BOX, y + _port(mates.index(k), len(mates))

    def _lane(self, k: Link) -> list[tuple[float, float]]:
        """Corners of a stream that runs in a lane."""
        (x1, y1), (x2, y2) = self.outlet(k), self.inlet(k.target_unit, k)
        band = self.band[k.source_unit]
        upward = k.name in self.above
        mates = self.lanes(self.above if upward else self.below, band)
        edge = self.top[band] - LANE * len(mates) - 2 if upward else self.bottom[band]
        lane = edge + LANE * (mates.index(k.name) + (0.6 if upward else 0.8))
        left, right = x1 + self.track[k.name, "out"], x2 - self.track[k.name, "in"]
        return [(x1, y1), (left, y1), (left, lane), (right, lane), (right, y2), (x2 - 3.0, y2)]

    def _lane_names(self) -> None:
        """Where the name of a stream stands on its lane: in the middle, unless a vertical runs through it
        there; beside the lane where this is shorter than its name.
        """
        lanes = {k.name: self._lane(k) for k in self.inner if k.name in (*self.above, *self.below)}
        verticals = [
            (x, min(y, to), max(y, to))
            for corners in lanes.values()
            for (x, y), (_x, to) in ((corners[1], corners[2]), (corners[3], corners[4]))
        ]
        self.name_at: dict[str, float] = {}
        for k in self.inner:
            if k.name not in lanes:
                continue
            (start, lane), (end, _lane) = lanes[k.name][2:4]
            half, middle = _wide(_label(k)) / 2 + 3.0, (start + end) / 2

            def crossed(at: float, half: float = half, lane: float = lane) -> int:
                return sum(
                    abs(x - at) < half and low < lane - 3.0 and high > lane - 13.0
                    for x, low, high in verticals
                )

            room = abs(end - start) / 2 - half
            steps = [step * sign for step in range(0, max(int(room), 0), 6) for sign in (1, -1)]
            beside = [max(start, end) - middle + half, min(start, end) - middle - half]
            inside = [
                at for at in (middle + step for step in (*steps, *beside)) if half < at < self.width - half
            ]
            self.name_at[k.name] = min(inside or [middle], key=crossed)

    def course(self, k: Link) -> tuple[str, tuple[float, float, str], tuple[float, float]]:
        """Path of a stream, place of its name, and where it ends."""
        if not k.origin:
            if not k.target:
                return "", (0.0, 0.0, "start"), (0.0, 0.0)
            x, y = self.inlet(k.target_unit, k)
            start = x - self.into[self.column[k.target_unit]] - 10.0 - _wide(_label(k))
            return f"M{start:g} {y:g} H{x - 3:g}", (start, y - 5, "start"), (x, y)
        x1, y1 = self.outlet(k)
        c = self.column[k.source_unit]
        clear = self.out[c + 1]
        if not k.target:
            # what stands at open ends is in one line, beyond every name beside it
            end = x1 + clear + 20.0 + self.named[k.source_unit]
            return f"M{x1:g} {y1:g} H{end:g}", (x1 + clear + 6, y1 - 5, "start"), (end, y1)
        x2, y2 = self.inlet(k.target_unit, k)
        if (k.name, "middle") in self.track:
            middle = self.middle[c + 1] + self.track[k.name, "middle"]
            return (
                f"M{x1:g} {y1:g} H{middle:g} V{y2:g} H{x2 - 3:g}",
                (x1 + clear + 6, y1 - 5, "start"),
                (x2, y2),
            )
        _start, (left, _y1), (_left, lane), (right, _lane), _inlet, _end = self._lane(k)
        return (
            f"M{x1:g} {y1:g} H{left:g} V{lane:g} H{right:g} V{y2:g} H{x2 - 3:g}",
            (self.name_at[k.name], lane - 4, "middle"),
            (x2, y2),
        )


def draw(
    line: Drawable,
    streams: Mapping[str, Any] | None = None,
    across: int = ACROSS,
    loose: Iterable[Loose] = (),
    growing: bool = False,
) -> str:
    """SVG of the line. Groups carry ``data-unit`` and ``data-stream`` so that a page can make them clickable.

    Parameters
    ----------
    line: the flowsheet, or the outline of one.
    streams: solved streams; gives the color of the main phase and the flow in the tooltip.
    across: columns of units side by side; the others stand beneath.
    loose: inlets that nothing enters, drawn as open ends with ``data-inlet``.
    growing: whether each outlet that nothing takes ends in a plus with ``data-outlet``.
    """
    sheet = _Sheet(line, across, loose, growing)
    parts = []
    for k in line.links:
        if not k.origin and not k.target:
            continue
        if streams and not k.target and float(streams[k.name].mass_flow) <= 0.0:
            continue  # an outlet that carries nothing
        parts.append(_stream(sheet, k, streams.get(k.name) if streams else None))
    for ends in sheet.loose.values():
        parts += [_open_inlet(sheet, one) for one in ends]
    parts += [_unit(sheet, unit) for unit in line.order]
    if growing:
        parts += [_plus(sheet, k) for k in line.links if k.origin and not k.target]
    idle = [k for k in line.links if not k.origin and not k.target]
    parts += [_idle(sheet, k, i) for i, k in enumerate(idle)]
    height = sheet.height + 30 * len(idle)
    width = max([sheet.width, *(80.0 + _wide(_label(k)) for k in idle)])
    tips = "".join(
        f'<marker id="tip-{c[1:]}" viewBox="0 0 8 8" refX="7" refY="4" markerWidth="7" markerHeight="7" '
        f'orient="auto"><path d="M0 0 L8 4 L0 8 z" fill="{c}"/></marker>'
        for c in PHASE_COLORS.values()
    )
    name = escape(_("Flow diagram"))
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width:g} {height:g}" role="group" '
        f'aria-label="{name}" font-family="system-ui, sans-serif" '
        f'data-width="{width:g}" data-across="{sheet.across}" '
        f'style="width:100%;max-width:{width:g}px"><defs>{tips}</defs>{"".join(parts)}</svg>'
    )


def _stream(sheet: _Sheet, k: Link, stream: Any) -> str:
    path, at, _end = sheet.course(k)
    phase = main_phase(stream) if stream is not None else ""
    color = PHASE_COLORS[phase]
    tip = k.name
    if stream is not None:
        tip += (
            f": {show(float(stream.mass_flow), KINDS['MassFlow'])}, "
            f"{show(float(stream.temperature), KINDS['Temperature'])}"
        )
    return (
        f'<g class="stream" data-stream="{escape(k.name)}" tabindex="0" role="button">'
        f"<title>{escape(tip)}</title>"
        f'<path class="reach" d="{path}" fill="none" stroke="transparent" stroke-width="14"/>'
        f'<path d="{path}" fill="none" stroke="{color}" stroke-width="1.8" '
        f'marker-end="url(#tip-{color[1:]})"/>'
        f'<text x="{at[0]:g}" y="{at[1]:g}" text-anchor="{at[2]}" font-size="11" '
        f'fill="{color}">{escape(_label(k))}</text></g>'
    )


def _unit(sheet: _Sheet, unit: str) -> str:
    x, y = sheet.corner(unit)
    card = getattr(sheet.line.units[unit], "card", None)
    title, key = (card.title, card.key) if card is not None else (unit, "")
    return (
        f'<g class="unit" data-unit="{escape(unit)}" tabindex="0" role="button" '
        f'transform="translate({x:g} {y:g})"><title>{escape(title)}</title>'
        f'<rect class="reach" width="{BOX}" height="{BOX + 18}" fill="transparent" stroke="none"/>'
        f'<g class="symbol" fill="white" stroke="#1c2430" stroke-width="1.5" '
        f'stroke-linejoin="round">{symbol_of(key)}</g>'
        f'<text x="{BOX / 2:g}" y="{BOX + 14}" text-anchor="middle" font-size="12" font-weight="600" '
        f'fill="#1c2430">{escape(pretty(unit))}</text></g>'
    )


def _open_inlet(sheet: _Sheet, one: Loose) -> str:
    x, y = sheet.inlet(one.unit, one)
    start = x - sheet.into[sheet.column[one.unit]] - 16.0
    port = port_label(one.port)
    told = _("open inlet '{port}' of {unit}").format(port=port, unit=pretty(one.unit))
    return (
        f'<g class="inlet{"" if one.needed else " may"}" data-inlet="{escape(f"{one.unit}.{one.port}")}" '
        f'tabindex="0" role="button"><title>{escape(told)}</title>'
        f'<circle class="reach" cx="{start:g}" cy="{y:g}" r="10" fill="transparent"/>'
        f'<path d="M{start + 5:g} {y:g} H{x - 1:g}" fill="none" stroke="#9a4a06" stroke-width="1.5" '
        f'stroke-dasharray="3 2"/><circle cx="{start:g}" cy="{y:g}" r="5" fill="white" stroke="#9a4a06" '
        f'stroke-width="1.5"/><text x="{start - 9:g}" y="{y + 4:g}" text-anchor="end" font-size="11" '
        f'fill="#9a4a06">{escape(port)}</text></g>'
    )


def _plus(sheet: _Sheet, k: Link) -> str:
    _path, _at, (x, y) = sheet.course(k)
    told = _("put equipment at {outlet}").format(outlet=pretty(k.origin))
    return _plus_at(x + 12.0, y, k.origin, told)


def _plus_at(x: float, y: float, origin: str, told: str) -> str:
    return (
        f'<g class="outlet" data-outlet="{escape(origin)}" tabindex="0" role="button" '
        f'transform="translate({x:g} {y:g})"><title>{escape(told)}</title>'
        f'<circle class="reach" r="10" fill="transparent"/><circle class="sign" r="7.5" fill="white" '
        f'stroke="#0b6e6e" stroke-width="1.5"/>'
        f'<path d="M-4 0 H4 M0 -4 V4" stroke="#0b6e6e" stroke-width="1.5"/></g>'
    )


def _idle(sheet: _Sheet, k: Link, i: int) -> str:
    """A feed that goes nowhere yet, below the line."""
    y = (sheet.height if sheet.line.order else 12.0) + 18.0 + 30.0 * i
    end = 24.0 + _wide(_label(k))
    told = _("put equipment at {outlet}").format(outlet=_label(k))
    return (
        f'<g class="stream" data-stream="{escape(k.name)}" tabindex="0" role="button">'
        f"<title>{escape(k.name)}</title>"
        f'<path class="reach" d="M8 {y:g} H{end:g}" fill="none" stroke="transparent" stroke-width="14"/>'
        f'<path d="M8 {y:g} H{end:g}" fill="none" stroke="#1c2430" stroke-width="1.8"/>'
        f'<text x="10" y="{y - 5:g}" font-size="11" fill="#1c2430">{escape(_label(k))}</text></g>'
        + _plus_at(end + 12.0, y, k.name, told)
    )
