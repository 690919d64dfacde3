"""Charts of size analysis: histogram with cumulative curve, Rosin–Rammler paper, log-probability paper,
partition curve.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Any

import numpy as np

from granum.core import chart
from granum.core.charts import ACCENT, SOLID, add_line, add_points, add_right_axis, axis_title, figure
from granum.core.i18n import _
from granum.core.kinds import KINDS, Distance, Fraction, Law, Length, Series
from granum.core.units import best_unit, format_number, from_si
from granum.particles.class_means import Edges, Fractions, Rule
from granum.particles.distributions import Basis, SizeDistribution
from granum.particles.in_class import UniformDensity

if TYPE_CHECKING:
    import plotly.graph_objects as go

_TICKS = (0.001, 0.01, 0.05, 0.1, 0.2, 0.3, 0.5, 0.632, 0.8, 0.9, 0.95, 0.99, 0.999)
_UNIFORM = UniformDensity()
OptionalSizeLaw = Annotated[Any, Law("size_distribution")] | None
_Sizes = Annotated[Distance, Series("points")]


def _unit_of(sizes: Any) -> str:
    return best_unit(float(np.median(np.asarray(sizes))), KINDS["Length"])


def _shown(sizes: Any, unit: str) -> np.ndarray:
    return np.asarray(from_si(np.asarray(sizes, dtype=float), unit, KINDS["Length"]))


def _positive_range(distribution: SizeDistribution) -> np.ndarray:
    edges = np.asarray(distribution.edges)
    low = edges[0] if edges[0] > 0 else edges[1] / 10.0
    return np.geomspace(low, edges[-1], 300)


def distribution_figure(distribution: SizeDistribution, law: Any = None) -> go.Figure:
    """Histogram per logarithm of size on the left axis, cumulative curve on the right one."""
    import plotly.graph_objects as go

    edges, unit = np.asarray(distribution.edges), _unit_of(distribution.edges)
    x = _shown(edges, unit)
    height = np.asarray(distribution.log_density())
    drawing = figure(axis_title("particle_diameter", unit), _("fraction per ln(size)"), x_log=True)
    first = 1 if edges[0] == 0.0 else 0
    across = np.repeat(x[first:], 2)
    up = np.concatenate([[0.0], np.repeat(height[first:], 2), [0.0]])
    drawing.add_trace(
        go.Scatter(
            x=across,
            y=up,
            mode="lines",
            name=_("histogram"),
            fill="tozeroy",
            line={"color": SOLID, "width": 1},
        )
    )
    grid = _positive_range(distribution)
    add_line(
        drawing,
        _shown(grid, unit),
        100.0 * np.asarray(distribution.cumulative(grid)),
        _("cumulative"),
        yaxis="y2",
    )
    at = edges[edges > 0]
    add_points(
        drawing,
        _shown(at, unit),
        100.0 * np.asarray(distribution.cumulative(at)),
        _("class limits"),
        yaxis="y2",
    )
    if law is not None:
        add_line(
            drawing,
            _shown(grid, unit),
            100.0 * np.asarray(law(grid)),
            _("law"),
            color="#6b46c1",
            dash="dash",
            yaxis="y2",
        )
    add_right_axis(
        drawing,
        axis_title("cumulative_fraction", "percent"),
        range=[0, 100],
        tickmode="array",
        tickvals=list(range(0, 101, 20)),
        automargin=True,
    )
    drawing.update_layout(legend={"x": 0.02, "y": 0.98})
    return drawing


@chart(source="iso9276-1", title="Histogram and cumulative curve")
def size_distribution_chart(
    class_edges: Edges,
    class_fractions: Fractions,
    basis: Basis = "volume",
    wanted_basis: Basis | None = None,
    in_class: Rule = _UNIFORM,
    size_law: OptionalSizeLaw = None,
) -> Any:
    """Histogram per logarithm of size with the cumulative curve, on any basis, and a law to compare.

    >>> len(
    ...     size_distribution_chart(
    ...         class_edges="2 4 8 16 32 64 128 um",
    ...         class_fractions="2.7 20.3 50.8 23.3 2.7 0.2 %",
    ...         basis="number",
    ...     ).data
    ... )
    3
    """
    return distribution_figure(
        SizeDistribution(class_edges, class_fractions, basis, in_class).to_basis(wanted_basis or basis),
        size_law,
    )


def _paper(sizes: Any, below: Any, size_law: Any, transform: Any, title: str) -> go.Figure:
    sizes, below = np.asarray(sizes, dtype=float), np.asarray(below, dtype=float)
    usable = (below > 0.0) & (below < 1.0) & (sizes > 0.0)
    unit = _unit_of(sizes[sizes > 0])
    drawing = figure(
        axis_title("particle_diameter", unit),
        axis_title("cumulative_fraction", "percent"),
        x_log=True,
        title=title,
    )
    add_points(drawing, _shown(sizes[usable], unit), transform(below[usable]), _("data"))
    if size_law is not None:
        grid = np.geomspace(sizes[usable].min() / 1.5, sizes[usable].max() * 1.5, 200)
        value = np.asarray(size_law(grid))
        inside = (value > 5e-4) & (value < 0.9995)
        add_line(drawing, _shown(grid[inside], unit), transform(value[inside]), _("law"))
    drawing.update_yaxes(
        tickvals=[float(transform(np.array(t))) for t in _TICKS],
        ticktext=[format_number(100.0 * t) for t in _TICKS],
    )
    return drawing


@chart(source="rosin1933; iso9276-3", title="Rosin–Rammler paper")
def rosin_rammler_chart(
    particle_diameter: _Sizes,
    cumulative_fraction: Annotated[Fraction, Series("points")],
    size_law: OptionalSizeLaw = None,
) -> Any:
    """Cumulative fractions on axes where a Rosin–Rammler law is a straight line.

    >>> len(
    ...     rosin_rammler_chart(
    ...         particle_diameter="20 40 80 160 320 um", cumulative_fraction="9 22 47 77 96 %"
    ...     ).data
    ... )
    1
    """
    return _paper(particle_diameter, cumulative_fraction, size_law, lambda q: np.log(-np.log1p(-q)), "")


@chart(source="iso9276-1; iso9276-5", title="Log-probability paper")
def log_probability_chart(
    particle_diameter: _Sizes,
    cumulative_fraction: Annotated[Fraction, Series("points")],
    size_law: OptionalSizeLaw = None,
) -> Any:
    """Cumulative fractions on axes where a log-normal law is a straight line.

    >>> len(
    ...     log_probability_chart(
    ...         particle_diameter="20 40 80 160 320 um", cumulative_fraction="2.5 16 50 84 97.5 %"
    ...     ).data
    ... )
    1
    """
    from scipy.special import ndtri

    return _paper(particle_diameter, cumulative_fraction, size_law, ndtri, "")


@chart(source="tromp1937", title="Partition (Tromp) curve")
def partition_chart(
    separation: Annotated[Any, Law("partition_curve")],
    particle_diameter: _Sizes | None = None,
    partition_number: Annotated[Fraction, Series("points")] | None = None,
    smallest_size: Length | None = None,
    largest_size: Length | None = None,
) -> Any:
    """Part of each size that goes to the coarse product, with the cut size and measured points.

    >>> partition_chart(
    ...     separation={"law": "logistic", "cut_size": "100 um", "sharpness": 4.0}
    ... ).layout.yaxis.range
    (0, 102)
    """
    cut = float(separation.cut_size)
    unit = _unit_of([cut])
    grid = np.geomspace(smallest_size or cut / 10.0, largest_size or cut * 10.0, 300)
    drawing = figure(
        axis_title("particle_diameter", unit), axis_title("partition_number", "percent"), x_log=True
    )
    add_line(
        drawing, _shown(grid, unit), 100.0 * np.asarray(separation(grid)), _("partition curve"), color=ACCENT
    )
    if particle_diameter is not None and partition_number is not None:
        add_points(drawing, _shown(particle_diameter, unit), 100.0 * np.asarray(partition_number), _("data"))
    drawing.add_vline(x=float(_shown(cut, unit)), line={"color": SOLID, "dash": "dot", "width": 1})
    drawing.update_yaxes(range=[0, 102])
    return drawing
