"""Effective diffusivity of moisture from drying curves, and its activation energy when they were taken at
several temperatures.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Any, ClassVar, Literal

import jax.numpy as jnp
import numpy as np

from granum.core import lab_test
from granum.core.constants import GAS_CONSTANT
from granum.core.errors import InputError
from granum.core.i18n import _
from granum.core.kinds import Diffusivity, Length, MolarEnergy, Ratio, Series, Temperature, Time
from granum.drying.formulas import diffusion
from granum.estimation import Fit, LabTest

if TYPE_CHECKING:
    import plotly.graph_objects as go

BODIES = {"plate": diffusion.plate, "cylinder": diffusion.cylinder, "sphere": diffusion.sphere}
LEAST_APART = 1.0
USUAL_ENERGY = 30e3


@lab_test(
    "effective_diffusivity",
    source="crank1975; erbay2010",
    title="Effective diffusivity of moisture",
    equation=(
        r"MR = f\!\left(\frac{D\,t}{L^2}\right),\quad D = "
        r"D_r\,e^{-\frac{E_a}{R}\left(\frac1T-\frac1{T_r}\right)}"
    ),
)
class EffectiveDiffusivity(LabTest):
    """Diffusivity in a plate, long cylinder or sphere from moisture ratios over time, by the whole series
    solution.

    The length is the half thickness of a plate dried from both sides (the thickness when from one) or the
    radius. With a column of temperatures the activation energy is estimated too, and the diffusivity is that
    of the mean temperature of the points; the laws of drying ask for the pre-exponential factor, which is
    given with it. The surface is taken at equilibrium from the start: where outer transfer matters the
    diffusivity comes out too small.
    """

    time: Annotated[Time, Series("points")]
    moisture_ratio: Annotated[Ratio, Series("points")]
    half_thickness: Length
    temperature: Annotated[Temperature, Series("points")] | None = None
    body: Literal["plate", "cylinder", "sphere"] = "plate"
    estimates: ClassVar = {"diffusivity": Diffusivity, "diffusion_activation_energy": MolarEnergy}
    holds_for: ClassVar = ("temperature",)
    axes: ClassVar = {"time": Time, "moisture_ratio": Ratio}
    least_points: ClassVar[int] = 4

    @property
    def reference_temperature(self) -> float | None:
        """Temperature to which the diffusivity belongs; None when none was given."""
        return None if self.temperature is None else float(1.0 / np.mean(1.0 / np.asarray(self.temperature)))

    def _several(self) -> bool:
        return self.temperature is not None and float(np.ptp(np.asarray(self.temperature))) >= LEAST_APART

    def _start(self) -> float:
        """Diffusivity from the time to half dried."""
        t, MR = np.asarray(self.time, dtype=float), np.asarray(self.moisture_ratio, dtype=float)
        grid = np.geomspace(1e-5, 5.0, 400)
        value = np.asarray(BODIES[self.body](jnp.asarray(grid)))
        usable = (t > 0) & (MR > 0.02) & (MR < 0.98)
        if not usable.any():
            raise InputError(
                _("No moisture ratio lies between 0.02 and 0.98: the points say nothing about diffusion."),
                name="moisture_ratio",
            )
        fourier = np.interp(-MR[usable], -value, grid)
        return float(np.median(fourier / t[usable]) * self.half_thickness**2)

    def fit(self) -> Fit:
        """Diffusivity, and activation energy where temperatures differ, by least squares on the moisture
        ratios.
        """
        t, MR = np.asarray(self.time, dtype=float), np.asarray(self.moisture_ratio, dtype=float)
        body, length = BODIES[self.body], self.half_thickness
        start = {"diffusivity": self._start()}
        bounds = {"diffusivity": (start["diffusivity"] * 1e-4, start["diffusivity"] * 1e4)}
        if not self._several():
            return self.fitted(
                lambda p, x: body(p["diffusivity"] * x / length**2), start, t, MR, bounds=bounds
            )
        inverse = (
            1.0 / np.asarray(self.temperature, dtype=float) - 1.0 / self.reference_temperature  # type: ignore[operator]
        ) / GAS_CONSTANT
        start["diffusion_activation_energy"] = USUAL_ENERGY
        bounds["diffusion_activation_energy"] = (-2e5, 5e5)

        def model(p: dict[str, Any], x: Any) -> Any:
            return body(
                p["diffusivity"] * jnp.exp(-p["diffusion_activation_energy"] * inverse) * x / length**2
            )

        mean = GAS_CONSTANT * self.reference_temperature  # type: ignore[operator]
        return self.fitted(
            model,
            start,
            t,
            MR,
            bounds=bounds,
            kinds={"diffusivity_preexponential": Diffusivity},
            derived=lambda p: {
                "diffusivity_preexponential": p["diffusivity"]
                * jnp.exp(p["diffusion_activation_energy"] / mean)
            },
        )

    def chart(self) -> go.Figure:
        """Measured and fitted moisture ratios, one color a temperature."""
        from granum.core.charts import LINES, add_line, add_points, axis_title, figure
        from granum.core.kinds import KINDS
        from granum.core.units import best_unit, from_si, show

        t, MR = np.asarray(self.time, dtype=float), np.asarray(self.moisture_ratio, dtype=float)
        values = self.fit().values
        unit = best_unit(float(np.median(t)), KINDS["Time"])
        drawing = figure(axis_title("time", unit), axis_title("moisture_ratio"), title=type(self).card.title)
        T = (
            np.zeros_like(t)
            if self.temperature is None
            else np.round(np.asarray(self.temperature, dtype=float), 1)
        )
        grid = np.linspace(0.0, 1.03 * t.max(), 200)
        for i, level in enumerate(np.unique(T)):
            factor = 1.0
            if self._several():
                factor = np.exp(
                    -values["diffusion_activation_energy"]
                    / GAS_CONSTANT
                    * (1.0 / level - 1.0 / self.reference_temperature)  # type: ignore[operator]
                )
            line = np.asarray(
                BODIES[self.body](jnp.asarray(values["diffusivity"] * factor * grid / self.half_thickness**2))
            )
            color = LINES[i % len(LINES)]
            name = _("model") if self.temperature is None else show(float(level), KINDS["Temperature"])
            add_line(drawing, from_si(grid, unit, KINDS["Time"]), line, name, color=color)
            here = level == T
            add_points(
                drawing,
                from_si(t[here], unit, KINDS["Time"]),
                MR[here],
                _("data"),
                color=color,
                showlegend=i == 0,
            )
        return drawing
