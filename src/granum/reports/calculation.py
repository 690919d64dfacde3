"""The sheet of one calculation: one HTML file, an A4 page in print."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import granum
from granum.core import charts
from granum.core.i18n import _
from granum.core.results import Result
from granum.reports.dates import date_text
from granum.reports.html import note_step
from granum.reports.mathml import equation_wrapped, mathml
from granum.reports.numbers import numbered
from granum.reports.quantities import beside_rows
from granum.reports.sensitivity import Curve, chart, covered, curve, spoken
from granum.reports.templating import page


def calculation_sheet(
    thing: Any,
    result: Result,
    *,
    found: Curve | None = None,
    units: tuple[str, str] = ("", ""),
    within: Mapping[str, tuple[str, str]] | None = None,
    stated: Mapping[str, str] | None = None,
    link: str = "",
) -> str:
    """HTML of the sheet: title, result, inputs, equation with its numbers, flags, chart, source.

    Parameters
    ----------
    found: the curve to draw, in ``units``; the first that says something when none is given.
    within: results as intervals, by name: text, and how it was found.
    stated: inputs as they were typed, or as intervals, by name.
    link: where the calculation can be opened again.
    """
    step, card = note_step(result), result.card
    found = found or curve(thing, result)
    figure = chart(found, units) if found is not None else None
    names = [p.name for p in card.outputs]
    outputs = [
        row | {"name": name, "within": (within or {}).get(name)}
        for name, row in zip(names, step["outputs"], strict=True)
    ]
    used = [p.name for p in card.parameters if result.inputs[p.name] is not None]
    inputs = [
        row | {"text": (stated or {}).get(name, row["text"])}
        for name, row in zip(used, step["inputs"], strict=True)
    ]
    block = [
        (_("Identifier"), card.key),
        (_("Date"), date_text()),
        (_("Program"), f"Granum {granum.__version__}"),
    ]
    return page(
        "sheet.html.j2",
        title=card.title,
        summary=card.summary,
        title_block=block,
        outputs=outputs,
        inputs=inputs,
        beside=[row._asdict() | {"symbol": mathml(row.symbol)} for row in beside_rows(result)],
        notices=step["notices"],
        covers=bool(card.fitted),
        equation=step["equation"] if card.equation else "",
        numbers=equation_wrapped(numbered(result)),
        chart=charts.as_html(figure) if figure is not None else "",
        shaded=found is not None and any(True for _span in covered(found)),
        spoken=spoken(found, units) if found is not None else "",
        source=step["source"],
        link=link,
    )
