"""Isotherms measured at several temperatures: one law for all of them, and the isosteric heat that
follows.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Any, ClassVar, Literal

import jax.numpy as jnp
import numpy as np

from granum.core import lab_test
from granum.core.constants import GAS_CONSTANT, ZERO_CELSIUS
from granum.core.errors import InputError
from granum.core.i18n import _
from granum.core.kinds import (
    MoistureDryBasis,
    MolarEnergy,
    Number,
    PositiveNumber,
    Series,
    SpecificEnergy,
    Temperature,
    WaterActivity,
)
from granum.drying.isotherms import grains as g
from granum.drying.isotherms.adsorption import Gab
from granum.drying.isotherms.base import WATER_MOLAR_MASS
from granum.drying.lab_tests.ranking import Ranked, rank
from granum.drying.lab_tests.thin_layer import best_sentence
from granum.estimation import Fit, LabTest
from granum.estimation.lines import straight_line

if TYPE_CHECKING:
    import plotly.graph_objects as go

INF = float("inf")
MODELS: dict[str, type] = {
    "gab": Gab,
    "henderson_modified": g.HendersonModified,
    "chung_pfost": g.ChungPfost,
    "halsey_modified": g.HalseyModified,
    "oswin_modified": g.OswinModified,
}
LEAST_APART = 1.0  # K between the coldest and the warmest isotherm
SAME = 0.5  # K, points of one isotherm


@lab_test(
    "isotherm_temperatures",
    source="iglesias1976; asaed245; vandenberg1981; keey1978",
    title="Sorption isotherms at several temperatures",
    equation=r"X = X(a_w, T),\quad q_n = -\frac{R}{M_w}\left[\frac{\partial\ln a_w}{\partial(1/T)}\right]_X",
)
class IsothermTemperatures(LabTest):
    """One isotherm law with temperature fitted to equilibrium moistures of all temperatures at once, with the
    net isosteric heat and its interval.

    Modified Henderson, Chung–Pfost, Halsey and Oswin as in the grain standard, or GAB with energies of
    monolayer and multilayer; ``best`` takes the best-ranked. The isosteric heat belongs to the reference
    moisture (by default the median of the data) at the mean temperature.
    """

    temperature: Annotated[Temperature, Series("points")]
    water_activity: Annotated[WaterActivity, Series("points")]
    moisture_dry_basis: Annotated[MoistureDryBasis, Series("points")]
    moisture_reference: MoistureDryBasis | None = None
    model: Literal[
        "best", "gab", "henderson_modified", "chung_pfost", "halsey_modified", "oswin_modified"
    ] = "best"
    estimates: ClassVar = {
        "monolayer_moisture": MoistureDryBasis,
        "monolayer_constant": PositiveNumber,
        "multilayer_constant": PositiveNumber,
        "monolayer_energy": MolarEnergy,
        "multilayer_energy": MolarEnergy,
        "isotherm_coefficient": Number,
        "isotherm_exponent": Number,
        "isotherm_temperature_offset": Number,
        "isotherm_coefficient_per_celsius": Number,
        "isosteric_heat_net": SpecificEnergy,
    }
    holds_for: ClassVar = ("water_activity", "temperature")
    axes: ClassVar = {"water_activity": WaterActivity, "moisture_dry_basis": MoistureDryBasis}
    least_points: ClassVar[int] = 6

    def columns(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Temperature, water activity and moisture, checked."""
        T, aw, X = (
            np.asarray(c, dtype=float)
            for c in (self.temperature, self.water_activity, self.moisture_dry_basis)
        )
        if np.any((aw <= 0) | (aw >= 1)):
            raise InputError(
                _("Every water activity must lie strictly between 0 and 1."), name="water_activity"
            )
        if np.ptp(T) < LEAST_APART:
            raise InputError(
                _(
                    "All points have nearly one temperature: give isotherms of at least two, or use "
                    "drying.isotherm."
                ),
                name="temperature",
            )
        return T, aw, np.maximum(X, 1e-6)

    @property
    def reference(self) -> tuple[float, float]:
        """Moisture and temperature to which the isosteric heat belongs."""
        moisture = (
            float(np.median(self.moisture_dry_basis))
            if self.moisture_reference is None
            else float(self.moisture_reference)
        )
        return moisture, float(np.mean(self.temperature))

    def law_of(self, cls: Any, values: dict[str, Any]) -> Any:
        """The law of some estimates; GAB's constants are estimated at the mean temperature, where they are
        well determined.
        """
        if cls is not Gab:
            return cls(**values)
        r = 1.0 / (GAS_CONSTANT * self.reference[1])
        values = dict(values)
        for constant, energy in (
            ("monolayer_constant", "monolayer_energy"),
            ("multilayer_constant", "multilayer_energy"),
        ):
            values[constant] = values[constant] * jnp.exp(-values[energy] * r)
        return cls(**values)

    def _fit_one(self, cls: Any, *, judged: bool = False) -> Fit:
        T, aw, X = self.columns()
        moisture, mean = self.reference
        start, bounds = starts(cls, T, aw, X)

        def model(p: dict[str, Any], aw: Any) -> Any:
            value = self.law_of(cls, p).moisture(jnp.asarray(aw), jnp.asarray(T))
            return jnp.where(jnp.isfinite(value), value, 1e3)

        def derived(p: dict[str, Any]) -> dict[str, Any]:
            return {"isosteric_heat_net": self.law_of(cls, p).net_isosteric_heat(moisture, mean)}

        return self.fitted(model, start, aw, X, bounds=bounds, derived=derived, judged=judged)

    def ranking(self) -> tuple[list[Ranked], dict[str, str]]:
        """All models, best first, and those that could not be fitted with the reason."""
        return rank(MODELS, self._fit_one)

    def fit(self) -> Fit:
        """The chosen law, or the best-ranked one, whose name and rivals stand in the flags."""
        self.columns()
        if self.model != "best":
            return self._fit_one(MODELS[self.model], judged=True)
        ranked, _failed = self.ranking()
        found = self.judged(ranked[0].fit, len(ranked))
        found.flags.append(self.note("best model", best_sentence(ranked), ranked[0].name))
        return found

    def law(self) -> Any:
        """The fitted isotherm as a law, ready for a dryer."""
        found = self.fit()
        name = self.model if self.model != "best" else found.flags[-1]["name"]
        return self.law_of(MODELS[name], found.values)

    def clausius_clapeyron(self, count: int = 9) -> tuple[np.ndarray, np.ndarray]:
        """Moistures that every isotherm reaches, and the net isosteric heat there from the data alone: the
        slope of ln a over 1/T.
        """
        T, aw, X = self.columns()
        sets = [np.abs(T - level) < SAME for level in _levels(T)]
        levels = np.array([T[s].mean() for s in sets])
        low, high = max(X[s].min() for s in sets), min(X[s].max() for s in sets)
        if high <= low:
            return np.array([]), np.array([])
        moistures = np.linspace(low, high, count)
        logs = []
        for s in sets:
            order = np.argsort(X[s])
            # the logarithm of −ln a is nearly straight over moisture
            logs.append(-np.exp(np.interp(moistures, X[s][order], np.log(-np.log(aw[s][order])))))
        slope = np.polyfit(1.0 / levels, np.array(logs), 1)[0]
        return moistures, -GAS_CONSTANT / WATER_MOLAR_MASS * slope

    def chart(self) -> go.Figure:
        """Measured equilibria and the fitted isotherm of each temperature."""
        from granum.core.charts import LINES, add_line, add_points, axis_title, figure
        from granum.core.kinds import KINDS
        from granum.core.units import show

        T, aw, X = self.columns()
        law = self.law()
        drawing = figure(
            axis_title("water_activity"),
            axis_title("moisture_dry_basis", "kg/kg"),
            title=type(self).card.title,
        )
        grid = np.linspace(max(0.5 * aw.min(), 1e-3), min(1.02 * aw.max(), 0.98), 150)
        for i, level in enumerate(_levels(T)):
            here = np.abs(T - level) < SAME
            color = LINES[i % len(LINES)]
            add_line(
                drawing,
                grid,
                np.asarray(law.moisture(jnp.asarray(grid), level)),
                show(level, KINDS["Temperature"]),
                color=color,
            )
            add_points(drawing, aw[here], X[here], _("data"), color=color, showlegend=i == 0)
        return drawing


def _levels(T: np.ndarray) -> np.ndarray:
    """The temperatures of the isotherms: the first of each group of nearly equal ones."""
    found: list[float] = []
    for value in np.sort(T):
        if not found or value - found[-1] >= SAME:
            found.append(float(value))
    return np.array(found)


def _line(x: np.ndarray, y: np.ndarray) -> tuple[float, float]:
    slope, intercept = straight_line(x, y)
    return float(slope), float(intercept)


def starts(
    cls: Any, T: np.ndarray, aw: np.ndarray, X: np.ndarray
) -> tuple[dict[str, float], dict[str, tuple[float, float]]]:
    """Start values from the straight-line form of each model without temperature, and bounds."""
    t = float(np.mean(T)) - ZERO_CELSIUS
    percent = 100.0 * X
    if cls is Gab:
        start = {
            "monolayer_moisture": float(np.interp(0.25, *_by_activity(aw, X))),
            "monolayer_constant": 10.0,
            "multilayer_constant": 0.8,
            "monolayer_energy": 5e3,
            "multilayer_energy": 0.0,
        }
        return start, {
            "monolayer_moisture": (1e-6, INF),
            "monolayer_constant": (1e-3, 1e5),
            "multilayer_constant": (0.01, 0.999 / float(aw.max())),
            "monolayer_energy": (-1e5, 1e5),
            "multilayer_energy": (-2e4, 2e4),
        }
    exponents = {"isotherm_exponent": (1e-2, 60.0)}
    if cls is g.HendersonModified:
        slope, intercept = _line(np.log(percent), np.log(-np.log1p(-aw)))
        return (
            {
                "isotherm_coefficient": float(np.exp(intercept)) / (t + 50.0),
                "isotherm_exponent": max(slope, 0.2),
                "isotherm_temperature_offset": 50.0,
            },
            {
                **exponents,
                "isotherm_coefficient": (1e-12, INF),
                "isotherm_temperature_offset": (1.0 - float(T.min()) + ZERO_CELSIUS, 5e3),
            },
        )
    if cls is g.ChungPfost:
        slope, intercept = _line(X, np.log(-np.log(aw)))
        return (
            {
                "isotherm_coefficient": float(np.exp(intercept)) * (t + 50.0),
                "isotherm_exponent": max(-slope, 0.5),
                "isotherm_temperature_offset": 50.0,
            },
            {
                "isotherm_exponent": (1e-2, 1e3),
                "isotherm_coefficient": (1e-6, INF),
                "isotherm_temperature_offset": (1.0 - float(T.min()) + ZERO_CELSIUS, 5e3),
            },
        )
    if cls is g.HalseyModified:
        slope, intercept = _line(np.log(percent), np.log(-np.log(aw)))
        return {
            "isotherm_coefficient": intercept,
            "isotherm_coefficient_per_celsius": -0.005,
            "isotherm_exponent": max(-slope, 0.2),
        }, exponents
    slope, intercept = _line(np.log(aw / (1.0 - aw)), np.log(percent))
    top = float(np.exp(intercept))
    return (
        {
            "isotherm_coefficient": 1.1 * top,
            "isotherm_coefficient_per_celsius": -0.1 * top / max(t, 5.0),
            "isotherm_exponent": 1.0 / max(slope, 0.05),
        },
        {**exponents, "isotherm_coefficient": (1e-6, INF)},
    )


def _by_activity(aw: np.ndarray, X: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    order = np.argsort(aw)
    return aw[order], X[order]
