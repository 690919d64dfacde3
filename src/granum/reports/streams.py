"""Streams and balances of a solved line as texts."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np

from granum.core.i18n import _
from granum.core.kinds import KINDS, Kind
from granum.core.parameters import Parameter
from granum.core.units import format_number, from_si, pretty_unit, show
from granum.streams.stream import main_phase, summary


def stream_figures(stream: Any) -> list[tuple[str, str]]:
    """Temperature, pressure and the flow of every species that a stream carries: labels and texts."""
    figures = [
        (_("temperature"), show(float(stream.temperature), KINDS["Temperature"])),
        (_("pressure"), show(float(stream.pressure), KINDS["Pressure"])),
    ]
    m = stream.mixture
    phases = (
        ("solid", m.solids, stream.solid_by_species),
        ("liquid", m.liquids, stream.liquid),
        ("gas", m.gases, stream.gas),
    )
    told = _("{material}: {what}")
    for phase, species, flows in phases:
        for one, flow in zip(species, np.asarray(flows), strict=True):
            if flow > 0.0:
                figures.append(
                    (
                        told.format(material=_(phase), what=m.materials.label(one.name)),
                        show(float(flow), KINDS["MassFlow"]),
                    )
                )
    return figures


class StreamTable(NamedTuple):
    """Streams, one a row: heads of the columns with their unit, then name and cells."""

    heads: tuple[str, ...]
    rows: list[tuple[str, list[str]]]


def stream_table(run: Any) -> StreamTable:
    """Flows of the phases, temperature and median size of every stream, a unit a column."""
    flow, length, degrees = (KINDS[name] for name in ("MassFlow", "Length", "Temperature"))
    streams = run.streams
    phases = {_("solid"): "solid_flow", _("liquid"): "liquid_flow", _("gas"): "gas_flow"}
    told = [summary(s) for s in streams.values()]
    columns = [(label, flow, _flows(streams, name)) for label, name in phases.items()]
    columns.append(("T", degrees, [float(s.temperature) for s in told]))
    columns.append(("d50", length, [float(s.median_size) for s in told]))
    shared = Parameter("mass_flow", flow).display_unit(
        [x for _label, kind, column in columns if kind is flow for x in column]
    )
    heads, cells = [], []
    for label, kind, values in columns:
        if all(map(math.isnan, values)):
            continue  # no solid anywhere
        unit, texts = _column(values, kind, shared if kind is flow else "")
        heads.append(f"{label} {unit}".strip())
        cells.append(texts)
    return StreamTable(tuple(heads), list(zip(streams, map(list, zip(*cells, strict=True)), strict=True)))


def _flows(streams: Mapping[str, Any], phase: str) -> list[float]:
    """Flow of a phase in each stream; what is lost in the rounding of the largest stream is none."""
    least = ROUNDING * max(float(s.mass_flow) for s in streams.values())
    return [x if x >= least else 0.0 for x in (float(getattr(s, phase)) for s in streams.values())]


def _column(values: list[float], kind: Kind, unit: str = "") -> tuple[str, list[str]]:
    """The unit of a column and its cells; each cell has a unit of its own, and the head none, where sizes of
    molecules and of crystals would stand in one unit as 10⁵ nm.
    """
    told = [x for x in values if not math.isnan(x)]
    unit = unit or Parameter("", kind).display_unit(told)
    numbers = [abs(float(from_si(x, unit, kind))) for x in told if x]
    if kind.name == "length" and any(not 1e-3 <= x < 1e5 for x in numbers):
        return "", ["" if math.isnan(x) else show(x, kind) for x in values]
    return pretty_unit(unit), [
        "" if math.isnan(x) else format_number(float(from_si(x, unit, kind))) for x in values
    ]


def stream_look(stream: Any) -> dict[str, Any]:
    """How a diagram shows a stream: its main phase, whether it carries anything, what is said beside it."""
    flow, degrees = float(stream.mass_flow), float(stream.temperature)
    return {
        "phase": main_phase(stream),
        "empty": flow <= 0.0,
        "tip": f"{show(flow, KINDS['MassFlow'])}, {show(degrees, KINDS['Temperature'])}",
    }


class Head(NamedTuple):
    """A column of the stream table: what stands in it, its unit, the phase it is of, and the columns it
    stands with.
    """

    label: str
    unit: str
    phase: str
    group: str


def stream_sheet(run: Any) -> dict[str, Any]:
    """The whole stream table: flows of all and of each phase, temperature, pressure, median size, and the
    mass fractions within each phase. A cell is empty where the stream has no such phase; below stand the sums
    over feeds and products.
    """
    streams = run.streams
    told = {name: summary(s) for name, s in streams.items()}
    mixture = next(iter(streams.values())).mixture
    phases = [(p, names) for p in PHASES if (names := getattr(mixture, f"{p}s" if p != "gas" else "gases"))]
    flow = KINDS["MassFlow"]
    flows = {"": {n: float(s.mass_flow) for n, s in streams.items()}}
    flows |= {p: dict(zip(streams, _flows(streams, f"{p}_flow"), strict=True)) for p, _names in phases}
    unit = Parameter("mass_flow", flow).display_unit(
        [x for column in flows.values() for x in column.values()]
    )
    heads = [Head(_(p) if p else _("total"), pretty_unit(unit), p, "flows") for p in flows]
    columns = [
        {
            n: format_number(float(from_si(x, unit, flow))) if x > 0.0 or not p else ""
            for n, x in column.items()
        }
        for p, column in flows.items()
    ]
    for label, kind, values in (
        ("T", "Temperature", {n: float(s.temperature) for n, s in streams.items()}),
        ("p", "Pressure", {n: float(s.pressure) for n, s in streams.items()}),
        ("d₅₀", "Length", {n: float(t.median_size) for n, t in told.items()}),
    ):
        if all(map(math.isnan, values.values())):
            continue  # no solid anywhere
        shown, texts = _column(list(values.values()), KINDS[kind])
        heads.append(Head(label, shown, "", "state"))
        columns.append(dict(zip(values, texts, strict=True)))
    for phase, species in phases:
        if len(species) < 2:
            continue
        for i, one in enumerate(species):
            heads.append(Head(f"w {mixture.materials.label(one.name)}", "%", phase, f"shares of {phase}"))
            columns.append({n: _share(s, phase, i, flows[phase][n]) for n, s in streams.items()})
    entering = [k.name for k in run.sheet.links if not k.origin]
    leaving = [k.name for k in run.sheet.links if not k.target]
    sums = [
        (
            label,
            [
                format_number(float(from_si(sum(column[n] for n in names), unit, flow)))
                for column in flows.values()
            ],
        )
        for label, names in ((_("all feeds"), entering), (_("all products"), leaving))
    ]
    largest = max(flows[""].values())
    return {
        "empty": [name for name, x in flows[""].items() if x <= LEAST * largest],
        "heads": heads,
        "rows": [(name, [column[name] for column in columns]) for name in streams],
        "sums": sums,
    }


PHASES = ("solid", "liquid", "gas")
LEAST = 1e-12  # of the largest stream, below which one carries nothing
ROUNDING = 1e-15  # of the largest stream


def _share(stream: Any, phase: str, i: int, flow: float) -> str:
    """The mass fraction of one species in a phase, in percent; nothing where there is no such phase."""
    if flow <= 0.0:
        return ""
    parts = np.asarray(stream.solid_by_species if phase == "solid" else getattr(stream, phase))
    return format_number(100.0 * float(parts[i]) / flow)


def audit_text(audit: Mapping[str, Any]) -> str:
    """To what the balances of a solved line close."""
    closures = {side: format_number(audit[f"{side}_closure"], 2) for side in ("mass", "energy")}
    return _("mass closes to {mass}, energy to {energy}").format(**closures)
