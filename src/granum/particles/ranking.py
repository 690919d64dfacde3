"""Drag laws against measured drag: the tables of measurements and the ranking of the laws."""

from __future__ import annotations

from typing import Annotated, Any, Literal, NamedTuple

import numpy as np

from granum.core import procedure
from granum.core.datasets import columns
from granum.core.errors import ApplicabilityError
from granum.core.i18n import _
from granum.core.kinds import Fraction, Number, PositiveNumber, Ratio, Series
from granum.core.units import format_number


def measured_drag(name: str) -> tuple[np.ndarray, np.ndarray]:
    """Reynolds numbers and drag coefficients of a data file."""
    found = columns("particles", f"drag_{name}")
    return found["reynolds"], found["drag_coefficient"]


def sphere_laws() -> dict[str, Any]:
    """The drag laws of a sphere by the author's part of their name; parametrized laws need a shape and stay
    out.
    """
    from granum.core.registry import everything

    return {
        law.card.name.removeprefix("drag_coefficient_"): law
        for law in everything(("particles",)).values()
        if law.card.family == "drag_coefficient" and law.card.sort == "formula"
    }


class DragRanking(NamedTuple):
    """Drag laws of spheres, best first; each judged on the measurements inside its own range."""

    drag: Annotated[str, Series("laws")]
    deviation_rms: Annotated[Ratio, Series("laws")]
    deviation_mean: Annotated[Number, Series("laws")]
    deviation_largest: Annotated[Ratio, Series("laws")]
    measurements_covered: Annotated[Fraction, Series("laws")]
    reynolds_lowest: Annotated[Ratio, Series("laws")]
    reynolds_highest: Annotated[PositiveNumber, Series("laws")]


@procedure(source="roos1971; morsi1972", title="Drag laws ranked by accuracy")
def drag_ranking(
    measurements: Literal["all", "morsi1972", "roos1971"] = "all",
    reynolds_lowest: Ratio = 0.1,
    reynolds_highest: PositiveNumber = 1.2e5,
) -> DragRanking:
    """Every drag law of a sphere against measured drag, ranked by the root-mean-square deviation inside its
    range.

    Two tables: Morsi and Alexander's means of the measurements known in 1972 (Re 0.1 to 50 000, smooth) and
    Roos and Willmarth's own measurements (Re 5 to 118 300), whose scatter of some 4 to 7 % is the floor of
    any law. A law is judged only where it claims to hold. Laws that cover every measurement between the two
    Reynolds numbers come first, then those that cover a part; within each group the smallest deviation leads.

    >>> "stokes" in drag_ranking(reynolds_lowest=1.0, reynolds_highest=1e5).drag[:10]
    False
    """
    names = ("morsi1972", "roos1971") if measurements == "all" else (measurements,)
    Re, measured = (np.concatenate(parts) for parts in zip(*(measured_drag(n) for n in names), strict=True))
    asked = (reynolds_lowest <= Re) & (reynolds_highest >= Re)
    Re, measured = Re[asked], measured[asked]
    if Re.size == 0:
        raise ApplicabilityError(
            _(
                "There is no measured drag between Re = {low} and {high}; the tables cover 0.1 to 118 300."
            ).format(low=format_number(reynolds_lowest), high=format_number(reynolds_highest))
        )
    rows = []
    for name, law in sphere_laws().items():
        low, high = law.card.fitted.get("reynolds", (0.0, np.inf))
        inside = (low <= Re) & (high >= Re)
        if not inside.any():
            continue
        deviation = np.asarray(law(Re[inside])) / measured[inside] - 1.0
        rows.append(
            (
                name,
                np.sqrt(np.mean(deviation**2)),
                deviation.mean(),
                abs(deviation).max(),
                inside.mean(),
                low,
                high,
            )
        )
    rows.sort(key=lambda row: (row[4] < 1.0, row[1]))
    columns = list(zip(*rows, strict=True))
    return DragRanking(columns[0], *(np.asarray(column, dtype=float) for column in columns[1:]))  # type: ignore[arg-type]
