"""Batch grinding followed by size analyses: selection and breakage functions in one fit."""

from __future__ import annotations

from math import inf, log
from typing import TYPE_CHECKING, Annotated, Any, ClassVar

import jax
import jax.numpy as jnp
import numpy as np

from granum.comminution.breakage import AustinBreakage, AustinSelection
from granum.comminution.population import Convention, batch_operator, rate_matrix
from granum.core import lab_test
from granum.core.errors import InputError
from granum.core.i18n import _
from granum.core.kinds import Fraction, Frequency, Length, PositiveNumber, Ratio, Series, Time
from granum.estimation import Fit, LabTest

if TYPE_CHECKING:
    import plotly.graph_objects as go


@lab_test(
    "grinding_kinetics",
    source="austin1984, ch. 9; reid1965",
    title="Grinding kinetics (batch mill with size analyses)",
)
class GrindingKinetics(LabTest):
    """Austin's selection and breakage functions from cumulative curves at several grinding times, by the
    exact batch solution.

    One row for each time and sieve; the same sieves at every time. The curve at the earliest time is the
    feed. The coarsest sieve must pass everything. The exponent of the coarse fragments is often badly
    determined: look at its interval.

    The estimates are laws of single sizes and hold on any classes, unless the convention is ``root_two``:
    then the sieves must be root-two ones, and the estimates compare with Austin's published constants and
    hold in a mill of the same convention.
    """

    grinding_time: Annotated[Time, Series("points")]
    particle_diameter: Annotated[Length, Series("points")]
    cumulative_fraction: Annotated[Fraction, Series("points")]
    breakage_convention: Convention = "continuous"
    estimates: ClassVar = {
        "selection_rate": Frequency,
        "selection_exponent": Ratio,
        "fines_share": Fraction,
        "fines_exponent": PositiveNumber,
        "coarse_exponent": PositiveNumber,
    }
    axes: ClassVar = {"particle_diameter": Length, "cumulative_fraction": Fraction}
    least_points: ClassVar[int] = 8

    def table(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Times, sizes (increasing) and the cumulative fractions, time by size."""
        time, size, below = (
            np.asarray(a) for a in (self.grinding_time, self.particle_diameter, self.cumulative_fraction)
        )
        times, row = np.unique(time, return_inverse=True)
        sizes, column = np.unique(size, return_inverse=True)
        grid = np.full((times.size, sizes.size), np.nan)
        grid[row, column] = below
        if np.isnan(grid).any() or time.size != grid.size:
            raise InputError(
                _("Every grinding time needs the same sieves, each once."), name="particle_diameter"
            )
        if times.size < 2:
            raise InputError(_("Give the feed and at least one later time."), name="grinding_time")
        if np.any(grid[:, -1] < 1.0 - 1e-6):
            raise InputError(
                _("The coarsest sieve must pass everything at every time."), name="cumulative_fraction"
            )
        if np.any(np.diff(grid, axis=1) < -1e-12):
            raise InputError(
                _("A cumulative curve falls with the size: check the rows of that time."),
                name="cumulative_fraction",
            )
        return times, sizes, grid

    def _row_of(self) -> np.ndarray:
        """Row of the data of each cumulative fraction, time by size."""
        return np.lexsort((np.asarray(self.particle_diameter), np.asarray(self.grinding_time)))

    def model(self, values: dict[str, Any], times: Any, sizes: Any, feed: Any) -> Any:
        """Cumulative fractions at times after the feed, time by size."""
        edges = np.concatenate([np.zeros(1), sizes])
        selection = AustinSelection(values["selection_rate"], values["selection_exponent"])
        breakage = AustinBreakage(values["fines_share"], values["fines_exponent"], values["coarse_exponent"])
        matrix = rate_matrix(edges, selection, breakage, self.breakage_convention)
        mass = jnp.diff(feed, prepend=0.0)
        return jax.vmap(lambda t: jnp.cumsum(batch_operator(matrix, t) @ mass))(times)

    def fit(self) -> Fit:
        """The five parameters of Austin's functions by least squares on the cumulative curves after the
        feed.
        """
        times, sizes, grid = self.table()
        later, feed = times[1:] - times[0], grid[0]
        top = np.argmax(feed > 1e-9) if feed[-2] <= 1e-9 else sizes.size - 2
        left = [max(1.0 - grid[-1, top], 1e-6), max(1.0 - feed[top], 1e-6)]
        rate = max(log(left[1] / left[0]), 0.05) / later[-1] / (sizes[-1] / 1e-3)
        start = {
            "selection_rate": rate,
            "selection_exponent": 1.0,
            "fines_share": 0.5,
            "fines_exponent": 0.8,
            "coarse_exponent": 4.0,
        }
        return self.fitted(
            lambda p, x: self.model(p, x, sizes, feed)[:, :-1].ravel(),
            start,
            later,
            grid[1:, :-1].ravel(),
            index=self._row_of().reshape(grid.shape)[1:, :-1].ravel(),
            bounds={
                "selection_rate": (rate * 1e-4, inf),
                "selection_exponent": (0.0, 4.0),
                "fines_share": (0.0, 1.0),
                "fines_exponent": (0.05, 5.0),
                "coarse_exponent": (0.5, 20.0),
            },
        )

    def chart(self) -> go.Figure:
        """Measured cumulative curves and the fitted ones, one color a time."""
        from granum.core.charts import LINES, add_line, add_points, axis_title, figure
        from granum.core.kinds import KINDS
        from granum.core.units import best_unit, from_si, show

        times, sizes, grid = self.table()
        fitted = np.asarray(self.model(self.fit().values, times - times[0], sizes, jnp.asarray(grid[0])))
        unit = best_unit(float(np.median(sizes)), KINDS["Length"])
        x = from_si(sizes, unit, KINDS["Length"])
        drawing = figure(
            axis_title("particle_diameter", unit), axis_title("cumulative_fraction", "percent"), x_log=True
        )
        for k, time in enumerate(times):
            color = LINES[k % len(LINES)]
            add_line(drawing, x, 100.0 * fitted[k], show(float(time), KINDS["Time"]), color=color)
            add_points(drawing, x, 100.0 * grid[k], _("data"), color=color, showlegend=k == 0)
        return drawing
