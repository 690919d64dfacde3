"""Flocculent settling column: removal against depth and time, iso-removal lines, removal of a basin."""

from __future__ import annotations

from functools import cached_property
from typing import TYPE_CHECKING, Annotated, Any, ClassVar

import jax.numpy as jnp
import numpy as np

from granum.core import lab_test
from granum.core.errors import InputError
from granum.core.i18n import _
from granum.core.kinds import Distance, Fraction, Length, OpenFraction, PositiveNumber, Series, Speed, Time
from granum.estimation import Fit, LabTest
from granum.numerics import find_root, safe_power

if TYPE_CHECKING:
    import plotly.graph_objects as go

QUADRATURE = np.polynomial.legendre.leggauss(48)


def removal_at(p: Any, time: Any, depth: Any) -> Any:
    """Removal at a time and depth: one at the surface, and one half where the median floc has come to."""
    reach = p["floc_velocity"] * p["floc_time"] * safe_power(time / p["floc_time"], p["floc_exponent"])
    return 1.0 / (1.0 + safe_power(depth / reach, p["floc_sharpness"]))


def removal_over(p: Any, time: Any, height: Any) -> Any:
    """Removal over a whole depth: the mean of the removal at all depths, which the sum over iso-removal lines
    approximates.
    """
    nodes, weights = QUADRATURE
    share = (
        0.5 * (jnp.asarray(nodes) + 1.0)
    ) ** 3  # nodes crowd where removal rises steeply to one, at the surface
    jacobian = 3.0 * (0.5 * (jnp.asarray(nodes) + 1.0)) ** 2
    values = removal_at(p, jnp.asarray(time)[..., None], share * jnp.asarray(height)[..., None])
    return jnp.sum(0.5 * jnp.asarray(weights) * jacobian * values, axis=-1)


def time_for(p: Any, removal: Any, height: Any) -> Any:
    """Time in which a whole depth reaches a removal: the removal depends on depth over reach alone, which is
    found on a log scale.
    """
    height, removal = jnp.asarray(height, dtype=float), jnp.asarray(removal, dtype=float)

    def off(x: Any, wanted: Any) -> Any:
        return removal_over(p, p["floc_time"], jnp.exp(x) * p["floc_velocity"] * p["floc_time"]) - wanted

    share = jnp.exp(find_root(off, -60.0, 60.0, removal).value)
    return p["floc_time"] * (height / (share * p["floc_velocity"] * p["floc_time"])) ** (
        1.0 / p["floc_exponent"]
    )


@lab_test(
    "flocculent_column",
    source="eckenfelder1961; davis2010, eq. 10-22",
    title="Flocculent settling column (iso-removal)",
)
class FlocculentColumn(LabTest):
    """Settling column of a flocculating suspension: share removed at several depths and times.

    A surface with four constants is fitted to all readings in place of lines drawn by hand: the depth of half
    removal grows as ``v τ (t/τ)ᵇ`` (b above one: flocs grow while they fall; one: discrete particles), and
    removal across it is ``1/(1 + (z/z½)^c)``. ``iso_removal`` gives the lines, ``removal`` that of a basin,
    ``duration`` and ``overflow_rate`` what a wanted removal asks for. With the depth of a basin and its
    residence time, or the removal wanted, the fit gives these figures too.
    """

    time: Annotated[Time, Series("readings")]
    depth: Annotated[Distance, Series("readings")]
    removal_efficiency: Annotated[Fraction, Series("readings")]
    basin_depth: Length | None = None
    residence_time: Time | None = None
    removal_efficiency_wanted: OpenFraction | None = None

    estimates: ClassVar = {
        "floc_velocity": Speed,
        "floc_exponent": PositiveNumber,
        "floc_sharpness": PositiveNumber,
        "removal_efficiency_basin": Fraction,
        "residence_time_wanted": Time,
        "overflow_rate_wanted": Speed,
    }
    axes: ClassVar = {"time": Time, "removal_efficiency": Fraction}
    least_points: ClassVar = 6

    def __check_init__(self) -> None:
        asked = (self.residence_time, self.removal_efficiency_wanted)
        if (self.basin_depth is None) != all(value is None for value in asked):
            raise InputError(
                _(
                    "A basin needs both its depth ('basin_depth') and its 'residence_time' or the "
                    "'removal_efficiency_wanted'."
                ),
                name="basin_depth",
            )

    @cached_property
    def _scale(self) -> Any:
        """Time at the middle of the readings, to which the constants refer."""
        return jnp.exp(jnp.mean(jnp.log(jnp.maximum(jnp.asarray(self.time, dtype=float), 1e-9))))

    @cached_property
    def _fitted(self) -> Fit:
        t, z = jnp.asarray(self.time, dtype=float), jnp.asarray(self.depth, dtype=float)
        scale = float(self._scale)
        start = {
            "floc_velocity": float(np.mean(np.asarray(z))) / scale,
            "floc_exponent": 1.2,
            "floc_sharpness": 1.0,
        }

        def model(p: Any, times: Any) -> Any:
            return removal_at({**p, "floc_time": scale}, times, z)

        bounds = {
            "floc_velocity": (0.0, np.inf),
            "floc_exponent": (0.05, 5.0),
            "floc_sharpness": (0.05, 10.0),
        }
        flags = self._beyond_the_readings()
        derived = self._basin if self.basin_depth is not None else None
        return self.fitted(
            model, start, t, self.removal_efficiency, bounds=bounds, derived=derived, flags=flags
        )

    def fit(self) -> Fit:
        """Constants of the removal surface, and what it says of a basin; fitted once."""
        return self._fitted

    def _basin(self, values: Any) -> dict[str, Any]:
        """Figures of the basin asked for, from the fitted constants."""
        p, depth, found = {**values, "floc_time": self._scale}, self.basin_depth, {}
        if self.residence_time is not None:
            found["removal_efficiency_basin"] = removal_over(p, self.residence_time, depth)
        if self.removal_efficiency_wanted is not None:
            time = time_for(p, self.removal_efficiency_wanted, depth)
            found |= {"residence_time_wanted": time, "overflow_rate_wanted": depth / time}
        return found

    def _beyond_the_readings(self) -> list[dict[str, Any]]:
        """A word where the basin is deeper or slower than what was measured."""
        deepest, longest = float(np.max(np.asarray(self.depth))), float(np.max(np.asarray(self.time)))
        deep = self.basin_depth is not None and float(self.basin_depth) > deepest
        slow = self.residence_time is not None and float(self.residence_time) > longest
        if not (deep or slow):
            return []
        words = _(
            "The basin is deeper or its time longer than the readings reach ({depth} m, {time} min): "
            "the surface is extrapolated."
        )
        return [
            self.note(
                "extrapolated",
                words.format(depth=f"{deepest:.3g}", time=f"{longest / 60.0:.3g}"),
                "basin_depth",
            )
        ]

    def constants(self, found: Fit | None = None) -> dict[str, float]:
        """Fitted constants with the time scale they refer to."""
        return {**(found or self.fit()).values, "floc_time": float(self._scale)}

    def removal(self, time: Any, height: Any) -> Any:
        """Removal of a basin of a depth after a residence time."""
        return removal_over(
            self.constants(), jnp.asarray(time, dtype=float), jnp.asarray(height, dtype=float)
        )

    def duration(self, removal_efficiency: Any, height: Any) -> Any:
        """Residence time in which a basin of a depth reaches a removal."""
        return time_for(self.constants(), removal_efficiency, height)

    def overflow_rate(self, removal_efficiency: Any, height: Any) -> Any:
        """Overflow rate at which a basin of a depth reaches a removal: its depth over that time."""
        return jnp.asarray(height, dtype=float) / self.duration(removal_efficiency, height)

    def iso_removal(self, removal_efficiency: Any, time: Any) -> Any:
        """Depth at which a share has been removed at given times: one iso-removal line."""
        p, R = self.constants(), jnp.asarray(removal_efficiency)
        reach = (
            p["floc_velocity"]
            * p["floc_time"]
            * safe_power(jnp.asarray(time) / p["floc_time"], p["floc_exponent"])
        )
        return reach * ((1.0 - R) / R) ** (1.0 / p["floc_sharpness"])

    def chart(self) -> go.Figure:
        """Iso-removal lines over depth and time, with the readings and their shares."""
        from granum.core.charts import LINES, add_line, axis_title, figure

        t, z, R = (np.asarray(x, dtype=float) for x in (self.time, self.depth, self.removal_efficiency))
        drawing = figure(axis_title("time", "min"), axis_title("depth", "m"), title=type(self).card.title)
        grid = np.linspace(0.02, 1.05, 150) * t.max()
        for share, color in zip((0.3, 0.4, 0.5, 0.6, 0.7, 0.8), LINES, strict=False):
            depth = np.asarray(self.iso_removal(share, grid))
            inside = depth <= 1.2 * z.max()
            if np.count_nonzero(inside) > 1:
                add_line(drawing, grid[inside] / 60.0, depth[inside], f"{100 * share:.0f} %", color=color)
        text = [f"{100 * r:.0f}" for r in R]
        drawing.add_scatter(
            x=t / 60.0,
            y=z,
            mode="markers+text",
            text=text,
            textposition="top center",
            name=_("data"),
            marker={"size": 6},
        )
        drawing.update_yaxes(autorange="reversed")
        return drawing
