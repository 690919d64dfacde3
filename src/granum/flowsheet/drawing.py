"""The flow diagram as SVG: units in columns along the flow, recycles in lanes below, streams colored by main
phase.
"""

from __future__ import annotations

from collections.abc import Mapping
from html import escape
from typing import Any

import networkx as nx

from granum.core.i18n import _
from granum.core.kinds import KINDS
from granum.core.units import show
from granum.flowsheet.plan import Link
from granum.flowsheet.sheet import Flowsheet
from granum.flowsheet.symbols import symbol_of
from granum.streams.stream import main_phase

ROW, BOX, LANE, MARGIN, LETTER, ASIDE = 130, 60, 22, 34, 6.0, 26
PHASE_COLORS = {"solid": "#b7791f", "liquid": "#2b6cb0", "gas": "#6b7f99", "": "#1c2430"}


def _columns(line: Flowsheet) -> dict[str, int]:
    torn = {name for block in line.blocks for name in block.tears}
    graph = nx.DiGraph()
    graph.add_nodes_from(line.order)
    graph.add_edges_from(
        (k.source_unit, k.target_unit) for k in line.links if k.origin and k.target and k.name not in torn
    )
    columns: dict[str, int] = {}
    for unit in nx.topological_sort(graph):
        columns[unit] = max((columns[p] + 1 for p in graph.predecessors(unit)), default=0)
    # pull sources such as an air heater next to what they serve
    for unit in reversed(list(nx.topological_sort(graph))):
        later = [columns[s] for s in graph.successors(unit)]
        if later and not list(graph.predecessors(unit)):
            columns[unit] = max(columns[unit], min(later) - 1)
    return columns


def _label(k: Link) -> str:
    """The name of a stream as the diagram prints it."""
    return k.name if len(k.name) <= 18 else k.name.partition(".")[2] or k.name


def _places(line: Flowsheet, columns: Mapping[str, int]) -> list[float]:
    """Left edge of each column of units: the gaps hold the names of what leaves on the left side and of the
    feeds on the right.
    """
    count = max(columns.values()) + 1
    leaving, feeding = [0.0] * (count + 1), [0.0] * (count + 1)
    for k in line.links:
        width = 8 + ASIDE + max(40.0, 14 + LETTER * len(_label(k)))
        if k.origin:
            leaving[columns[k.source_unit] + 1] = max(leaving[columns[k.source_unit] + 1], width)
        else:
            feeding[columns[k.target_unit]] = max(feeding[columns[k.target_unit]], width)
    places, x = [], 0.0
    for column in range(count):
        x += leaving[column] + max(feeding[column], 40.0) + 30 * (column > 0)
        places.append(x)
        x += BOX
    return [*places, x + leaving[count] + 20]


def draw(line: Flowsheet, streams: Mapping[str, Any] | None = None) -> str:
    """SVG of the line. Groups carry ``data-unit`` and ``data-stream`` so that a page can make them clickable.

    Parameters
    ----------
    line: the flowsheet.
    streams: solved streams; gives the color of the main phase and the flow in the tooltip.
    """
    columns = _columns(line)
    rows: dict[str, int] = {}
    used: dict[int, int] = {}
    for unit in line.order:
        rows[unit] = used.get(columns[unit], 0)
        used[columns[unit]] = rows[unit] + 1
    spans = {
        k.name: columns[k.target_unit] - columns[k.source_unit] for k in line.links if k.origin and k.target
    }
    above = [k.name for k in line.links if spans.get(k.name, 0) > 1]
    below = [k.name for k in line.links if k.name in spans and spans[k.name] <= 0]
    top = MARGIN + LANE * len(above)
    *places, width = _places(line, columns)
    corner = {u: (places[columns[u]], top + ROW * rows[u]) for u in line.order}
    bottom = top + ROW * max(used.values()) - (ROW - BOX) + 34
    height = bottom + LANE * len(below) + 12
    detours = {(k.source_unit, "out") for k in line.links if k.name in (*above, *below)}
    # verticals beside a unit: names keep clear of them
    detours |= {(k.target_unit, "in") for k in line.links if k.name in (*above, *below)}

    def port(k: Link, end: str) -> tuple[float, float]:
        unit = k.source_unit if end == "origin" else k.target_unit
        mates = [
            m
            for m in line.links
            if (m.source_unit if end == "origin" else m.target_unit) == unit and getattr(m, end)
        ]
        place = (mates.index(k) + 1) / (len(mates) + 1)
        x, y = corner[unit]
        return (x + BOX if end == "origin" else x), y + BOX * place

    parts = []
    gaps: dict[int, int] = {}  # verticals drawn so far in each gap between columns, to keep them apart
    for k in line.links:
        if streams and not k.target and float(streams[k.name].mass_flow) <= 0.0:
            continue  # an outlet that carries nothing
        if not k.origin:
            x, y = port(k, "target")
            long = max(40.0, 10 + LETTER * len(_label(k))) + ASIDE * ((k.target_unit, "in") in detours)
            path, at = f"M{x - long} {y} H{x - 3}", (x - long, y - 5, "start")
        elif not k.target:
            x, y = port(k, "origin")
            clear = ASIDE * ((k.source_unit, "out") in detours)
            path, at = (
                f"M{x} {y} H{x + clear + max(40.0, 14 + LETTER * len(_label(k)))}",
                (x + 6 + clear, y - 5, "start"),
            )
        else:
            (x1, y1), (x2, y2) = port(k, "origin"), port(k, "target")
            if k.name in above:
                lane = MARGIN // 2 + LANE * (above.index(k.name) + 1)
                path, at = (
                    f"M{x1} {y1} h16 V{lane} H{x2 - 22} V{y2} H{x2 - 3}",
                    ((x1 + x2) / 2, lane - 4, "middle"),
                )
            elif k.name in below:
                lane = bottom + LANE * (below.index(k.name) + 1)
                path, at = (
                    f"M{x1} {y1} h22 V{lane} H{x2 - 28} V{y2} H{x2 - 3}",
                    ((x1 + x2) / 2, lane - 4, "middle"),
                )
            else:
                gap = columns[k.source_unit]
                gaps[gap] = gaps.get(gap, 0) + 1
                beside = max(
                    len(_label(m)) for m in line.links if m.origin and m.source_unit == k.source_unit
                )
                clear = ASIDE * ((k.source_unit, "out") in detours)
                middle = x1 + clear + 14 + LETTER * beside + 9 * (gaps[gap] % 6)
                path, at = f"M{x1} {y1} H{middle} V{y2} H{x2 - 3}", (x1 + 6 + clear, y1 - 5, "start")
        stream = streams.get(k.name) if streams else None
        color = PHASE_COLORS[main_phase(stream) if stream is not None else ""]
        tip = (
            f"{k.name}: {show(float(stream.mass_flow), KINDS['MassFlow'])}, "
            f"{show(float(stream.temperature), KINDS['Temperature'])}"
            if stream is not None
            else k.name
        )
        parts.append(
            f'<g class="stream" data-stream="{escape(k.name)}" tabindex="0" '
            f'role="button"><title>{escape(tip)}</title>'
            f'<path d="{path}" fill="none" stroke="{color}" stroke-width="1.8" '
            f'marker-end="url(#tip-{color[1:]})"/>'
            f'<text x="{at[0]}" y="{at[1]}" text-anchor="{at[2]}" font-size="10.5" '
            f'fill="{color}">{escape(_label(k))}</text></g>'
        )
    for unit, (x, y) in corner.items():
        model = line.units[unit].card  # type: ignore[attr-defined]
        parts.append(
            f'<g class="unit" data-unit="{escape(unit)}" tabindex="0" role="button" '
            f'transform="translate({x} {y})"><title>{escape(model.title)}</title>'
            f'<g fill="white" stroke="#1c2430" stroke-width="1.5" '
            f'stroke-linejoin="round">{symbol_of(model.key)}</g>'
            f'<text x="{BOX / 2}" y="{BOX + 14}" text-anchor="middle" font-size="12" font-weight="600" '
            f'fill="#1c2430">{escape(unit)}</text></g>'
        )
    tips = "".join(
        f'<marker id="tip-{c[1:]}" viewBox="0 0 8 8" refX="7" refY="4" markerWidth="7" markerHeight="7" '
        f'orient="auto"><path d="M0 0 L8 4 L0 8 z" fill="{c}"/></marker>'
        for c in PHASE_COLORS.values()
    )
    name = escape(_("Flow diagram"))
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width:g} {height}" role="group" '
        f'aria-label="{name}" font-family="system-ui, sans-serif" '
        f'style="width:100%;max-width:{width:g}px"><defs>{tips}</defs>{"".join(parts)}</svg>'
    )
