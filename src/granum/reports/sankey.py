"""Sankey diagrams of a solved line: what flows from unit to unit, as mass, as one conserved component, or as
energy.
"""

from __future__ import annotations

import json
from typing import Any, NamedTuple

import numpy as np

from granum.core import charts
from granum.core.errors import unknown_name
from granum.core.i18n import _
from granum.core.kinds import KINDS
from granum.core.parameters import Parameter
from granum.core.units import from_si, pretty_unit
from granum.materials.library import Library
from granum.streams.names import pretty
from granum.streams.stream import Stream, main_phase

MASS, ENERGY = "mass", "energy"
REFERENCE = 298.15  # K, at which components count no energy
LEAST = 1e-9  # of the largest flow, below which nothing is drawn
COLORS = {"solid": charts.SOLID, "liquid": charts.LIQUID, "gas": charts.GAS, "heat": charts.HEAT}
PHASES = {"solid": "solids", "liquid": "liquids", "gas": "gases"}
RISE, LOWEST, HIGHEST = 42, 320, 900  # px a unit, and of a diagram


class Flow(NamedTuple):
    """What one stream, or heat and work, brings from one node to another: kg/s or W, never negative.

    A unit is a node by its name. ``source`` and ``target`` that are no unit are what enters and leaves.
    """

    source: str
    target: str
    name: str
    phase: str
    value: float


def subjects(run: Any) -> tuple[str, ...]:
    """What a diagram of this line may show: mass, energy, and each component where there are several."""
    components = next(iter(run.streams.values())).mixture.components
    return (MASS, ENERGY, *(components if len(components) > 1 else ()))


def flows(run: Any, of: str = MASS) -> list[Flow]:
    """The flows of a diagram; at every unit as much goes in as comes out.

    Energy is that of the streams against their components at 25 °C, as liquid where the mixture has such a
    liquid, else as solid, else as gas, so that vapor carries its heat of vaporization. A stream below that
    brings cold: it is drawn the other way.
    """
    if of not in subjects(run):
        raise unknown_name(_("Subject of the diagram"), of, subjects(run))
    found = [flow for link in run.sheet.links for flow in _of_stream(link, run.streams[link.name], of)]
    if of == ENERGY:
        found += _powers(run)
    largest = max((flow.value for flow in found), default=0.0)
    return [flow for flow in found if flow.value > LEAST * largest]


def _of_stream(link: Any, stream: Stream, of: str) -> list[Flow]:
    source, target = link.source_unit or f"> {link.name}", link.target_unit or f"{link.name} >"
    if of == ENERGY:
        value, phase = _energy(stream), main_phase(stream)
        ends = (source, target) if value >= 0.0 else (target, source)
        return [Flow(*ends, link.name, phase, abs(value))]
    return [
        Flow(source, target, link.name, phase, value) for phase, value in _masses(stream, of).items() if value
    ]


def _masses(stream: Stream, of: str) -> dict[str, float]:
    """Mass flow by phase, of everything or of one component."""
    m = stream.mixture
    flowing = {"solid": stream.solid_by_species, "liquid": stream.liquid, "gas": stream.gas}
    found = {}
    for phase, species in PHASES.items():
        each = np.asarray(flowing[phase], dtype=float)
        share = np.ones(len(each))
        if of != MASS:
            share = m.composition_matrix(getattr(m, species))[:, m.components.index(of)]
        found[phase] = float(each @ share)
    return found


def _energy(stream: Stream) -> float:
    """Enthalpy flow against the components in their ordinary state at 25 °C, W."""
    m = stream.mixture
    ordinary: dict[int, float] = {}
    for phase in ("liquids", "solids", "gases"):
        species = getattr(m, phase)
        if not species:
            continue
        enthalpies = np.asarray(m.enthalpies(phase, REFERENCE), dtype=float)
        for row, h in zip(m.composition_matrix(species), enthalpies, strict=True):
            if np.count_nonzero(row) == 1 and row.max() == 1.0:
                ordinary.setdefault(int(row.argmax()), float(h))
    at_rest = np.array([ordinary.get(i, 0.0) for i in range(len(m.components))])
    return float(stream.enthalpy_flow) - float(np.asarray(stream.components, dtype=float) @ at_rest)


def _powers(run: Any) -> list[Flow]:
    """Heat and work that the units take up or give off."""
    found = []
    for unit, powers in run.solution.powers.items():
        for name, value in powers.items():
            watts, label = float(value), Parameter(name, KINDS["Power"]).label
            outside = (_("work") if name == "shaft_power" else _("heat supplied"), _("heat given off"))
            ends = (outside[0], unit) if watts >= 0.0 else (unit, outside[1])
            found.append(Flow(*ends, f"{unit} · {label}", "heat", abs(watts)))
    return found


def _library(run: Any) -> Library:
    """What the substances of a line are called by."""
    return next(iter(run.streams.values())).mixture.materials


def titled(run: Any, of: str) -> str:
    """Of a diagram."""
    titles = {MASS: _("Flow of mass"), ENERGY: _("Flow of energy")}
    return titles.get(of) or _("Flow of {component}").format(component=_library(run).label(of))


def diagrams(run: Any) -> list[dict[str, Any]]:
    """Every diagram of a line for the page."""
    words = {MASS: _("mass"), ENERGY: _("energy")}
    return [
        {
            "name": of,
            "label": words.get(of) or _library(run).label(of),
            "title": titled(run, of),
            "figure": json.loads(sankey(run, of).to_json()),
        }
        for of in subjects(run)
    ]


def sankey(run: Any, of: str = MASS) -> Any:
    """The diagram as a Plotly figure: widths in kg/h or kW, in the colors of the phases."""
    import plotly.graph_objects as go

    found = flows(run, of)
    name, kind = ("heat_duty", KINDS["Power"]) if of == ENERGY else ("mass_flow", KINDS["MassFlow"])
    values = np.array([flow.value for flow in found])
    unit = Parameter(name, kind).display_unit(values) if len(values) else kind.unit
    nodes = list(dict.fromkeys(end for flow in found for end in (flow.source, flow.target)))
    chart = go.Figure(
        go.Sankey(
            arrangement="snap",
            valueformat=".4~r",
            valuesuffix=" " + pretty_unit(unit),
            textfont={"color": charts.INK, "size": 12},
            node={
                "label": [pretty(node.strip("> ")) for node in nodes],
                "color": [charts.INK if node in run.sheet.units else charts.OUTSIDE for node in nodes],
                "line": {"width": 0},
                "pad": 22,
                "thickness": 12,
                "hovertemplate": "%{label}: %{value}<extra></extra>",
            },
            link={
                "source": [nodes.index(flow.source) for flow in found],
                "target": [nodes.index(flow.target) for flow in found],
                "value": from_si(values, unit, kind) if len(values) else [],
                "color": [charts.faded(COLORS[flow.phase]) for flow in found],
                "label": [pretty(flow.name) for flow in found],
                "hovertemplate": "%{label}: %{value}<extra></extra>",
            },
        )
    )
    chart.update_layout(
        template=charts.template(),
        title=titled(run, of),
        height=int(np.clip(160 + RISE * len(nodes), LOWEST, HIGHEST)),
        margin={"l": 12, "r": 12, "t": 45, "b": 16},
    )
    return chart
