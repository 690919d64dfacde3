"""Streams and balances of a solved line as texts."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np

from granum.core.i18n import _
from granum.core.kinds import KINDS
from granum.core.parameters import Parameter
from granum.core.units import format_number, from_si, pretty_unit, show
from granum.streams.stream import summary


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
    for phase, species, flows in phases:
        for one, flow in zip(species, np.asarray(flows), strict=True):
            if flow > 0.0:
                figures.append((f"{_(phase)}: {one.name}", show(float(flow), KINDS["MassFlow"])))
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
    columns = [(label, flow, [float(getattr(s, name)) for s in told]) for label, name in phases.items()]
    columns.append(("T", degrees, [float(s.temperature) for s in told]))
    columns.append(("d50", length, [float(s.median_size) for s in told]))
    shared = Parameter("mass_flow", flow).display_unit(
        [x for _label, kind, column in columns if kind is flow for x in column]
    )
    heads, cells = [], []
    for label, kind, values in columns:
        unit = shared if kind is flow else Parameter("", kind).display_unit(values)
        if all(map(math.isnan, values)):
            continue  # no solid anywhere
        heads.append(f"{label} {pretty_unit(unit)}")
        cells.append(["" if math.isnan(x) else format_number(float(from_si(x, unit, kind))) for x in values])
    return StreamTable(tuple(heads), list(zip(streams, map(list, zip(*cells, strict=True)), strict=True)))


def audit_text(audit: Mapping[str, Any]) -> str:
    """To what the balances of a solved line close."""
    closures = {side: format_number(audit[f"{side}_closure"], 2) for side in ("mass", "energy")}
    return _("mass closes to {mass}, energy to {energy}").format(**closures)
