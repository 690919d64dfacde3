"""Sorption isotherms fitted to measured equilibria and ranked."""

from __future__ import annotations

from typing import Annotated, Any, ClassVar, Literal

import jax.numpy as jnp
import numpy as np

from granum.core import lab_test
from granum.core.errors import InputError
from granum.core.i18n import _
from granum.core.kinds import MoistureDryBasis, Number, PositiveNumber, Series, Temperature, WaterActivity
from granum.drying.isotherms import adsorption as a
from granum.drying.isotherms import empirical as m
from granum.drying.lab_tests.ranking import Ranked, rank
from granum.drying.lab_tests.thin_layer import best_sentence
from granum.estimation import Fit, LabTest
from granum.estimation.lines import polynomial, straight_line

INF = float("inf")
POSITIVE = (1e-9, INF)
MODELS: dict[str, type] = {
    "gab": a.Gab,
    "bet": a.Bet,
    "oswin": m.Oswin,
    "halsey": m.Halsey,
    "henderson": m.Henderson,
    "smith": m.Smith,
    "peleg": m.Peleg,
    "ferro_fontan": m.FerroFontan,
    "double_log": m.DoubleLog,
    "caurie": m.Caurie,
    "kuhn": m.Kuhn,
    "bradley": m.Bradley,
    "chen": m.Chen,
    "lewicki_two": m.LewickiTwo,
    "lewicki_three": m.LewickiThree,
    "iglesias_chirife": m.IglesiasChirife,
}
BET_LIMIT = 0.5


@lab_test("isotherm", source="vandenberg1981; burnham2002", title="Sorption isotherm", equation=r"X = X(a_w)")
class IsothermTest(LabTest):
    """Sorption isotherms fitted to equilibrium moistures over water activity and ranked by AICc; equal curves
    are known as one.

    ``model`` fits one by name; ``best``, the default, takes the best-ranked. BET uses the points up to a
    water activity of 0.5 only, so it is fitted on request but not ranked with the others.
    """

    water_activity: Annotated[WaterActivity, Series("points")]
    moisture_dry_basis: Annotated[MoistureDryBasis, Series("points")]
    temperature: Temperature = 298.15
    model: Literal[
        "best",
        "gab",
        "bet",
        "oswin",
        "halsey",
        "henderson",
        "smith",
        "peleg",
        "ferro_fontan",
        "double_log",
        "caurie",
        "kuhn",
        "bradley",
        "chen",
        "lewicki_two",
        "lewicki_three",
        "iglesias_chirife",
    ] = "best"
    estimates: ClassVar = {
        "monolayer_moisture": MoistureDryBasis,
        "monolayer_constant": PositiveNumber,
        "multilayer_constant": PositiveNumber,
        "isotherm_coefficient": Number,
        "isotherm_exponent": Number,
    }
    holds_for: ClassVar = ("water_activity", "temperature")
    axes: ClassVar = {"water_activity": WaterActivity, "moisture_dry_basis": MoistureDryBasis}
    least_points: ClassVar[int] = 4

    def _fit_one(self, cls: Any, *, judged: bool = False) -> Fit:
        aw, X = np.asarray(self.water_activity, dtype=float), np.asarray(self.moisture_dry_basis, dtype=float)
        if np.any((aw <= 0) | (aw >= 1)):
            raise InputError(
                _("Every water activity must lie strictly between 0 and 1."), name="water_activity"
            )
        keep = aw <= BET_LIMIT if cls is a.Bet else np.ones(aw.shape, bool)
        start, bounds = starts(cls, aw[keep], X[keep], float(self.temperature))
        fixed = {"moisture_half": float(np.interp(0.5, *_sorted(aw, X)))} if cls is m.IglesiasChirife else {}

        def model(p: dict[str, Any], aw: Any) -> Any:
            return cls(**p, **fixed).moisture(jnp.asarray(aw), self.temperature)

        return self.fitted(model, start, aw, X, keep=keep, bounds=bounds, judged=judged)

    def ranking(self) -> tuple[list[Ranked], dict[str, str]]:
        """All models over the whole range, best first, and those that could not be fitted with the reason."""
        return rank({name: cls for name, cls in MODELS.items() if cls is not a.Bet}, self._fit_one)

    def fit(self) -> Fit:
        """The chosen isotherm, or the best-ranked one, whose name and rivals stand in the flags."""
        if self.model != "best":
            return self._fit_one(MODELS[self.model], judged=True)
        ranked, _failed = self.ranking()
        found = self.judged(ranked[0].fit, len(ranked))
        found.flags.append(self.note("best model", best_sentence(ranked), ranked[0].name))
        return found

    def law(self, name: str = "") -> Any:
        """The fitted isotherm as a law, ready for a dryer."""
        found = self._fit_one(MODELS[name]) if name else self.fit()
        chosen = name or (self.model if self.model != "best" else found.flags[-1]["name"])
        aw, X = np.asarray(self.water_activity), np.asarray(self.moisture_dry_basis)
        extra = (
            {"moisture_half": float(np.interp(0.5, *_sorted(aw, X)))} if chosen == "iglesias_chirife" else {}
        )
        return MODELS[chosen](**found.values, **extra)


def _sorted(aw: np.ndarray, X: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    order = np.argsort(aw)
    return aw[order], X[order]


def _line(x: np.ndarray, y: np.ndarray) -> tuple[float, float]:
    slope, intercept = straight_line(x, y)
    return float(slope), float(intercept)


def starts(
    cls: Any, aw: np.ndarray, X: np.ndarray, T: float
) -> tuple[dict[str, float], dict[str, tuple[float, float]]]:
    """Start values from the straight-line form of each model, and bounds."""
    X = np.maximum(X, 1e-6)
    low = -np.log(aw)
    if cls in (a.Gab, a.Bet):
        m0 = float(np.interp(0.25, *_sorted(aw, X)))
        start = {"monolayer_moisture": m0, "monolayer_constant": 10.0}
        bounds = {"monolayer_moisture": POSITIVE, "monolayer_constant": (1e-3, 1e5)}
        if cls is a.Gab:
            start["multilayer_constant"], bounds["multilayer_constant"] = (
                0.85,
                (0.01, 0.999 / float(aw.max())),
            )
        return start, bounds
    if cls is m.Peleg:
        top = float(X.max())
        return (
            {
                "isotherm_coefficient": 0.5 * top,
                "isotherm_exponent": 0.6,
                "isotherm_coefficient_second": 0.6 * top,
                "isotherm_exponent_second": 6.0,
            },
            {
                "isotherm_coefficient": (0.0, INF),
                "isotherm_exponent": (0.01, 50.0),
                "isotherm_coefficient_second": (0.0, INF),
                "isotherm_exponent_second": (0.01, 100.0),
            },
        )
    if cls is m.DoubleLog:
        c = polynomial(np.log(low), X, 3)
        names = (
            "isotherm_coefficient",
            "isotherm_coefficient_second",
            "isotherm_coefficient_third",
            "isotherm_coefficient_fourth",
        )
        return dict(zip(names, c, strict=True)), {}
    if cls is m.LewickiThree:
        scale = float(np.interp(0.5, *_sorted(aw, X)))
        return {"isotherm_coefficient": scale, "isotherm_exponent": 0.4, "isotherm_exponent_second": 5.0}, {
            "isotherm_coefficient": POSITIVE,
            "isotherm_exponent": (1e-3, 5.0),
            "isotherm_exponent_second": (1e-3, 200.0),
        }
    if cls in (m.Oswin, m.LewickiTwo):
        slope, intercept = _line(np.log(aw / (1 - aw)), np.log(X))
        exponent = slope if cls is m.Oswin else 1.0 - slope
        bounds = {"isotherm_coefficient": POSITIVE}
        if cls is m.Oswin:
            bounds["isotherm_exponent"] = (1e-3, 10.0)
        return {"isotherm_coefficient": float(np.exp(intercept)), "isotherm_exponent": exponent}, bounds
    if cls in (m.Halsey, m.FerroFontan):
        slope, intercept = _line(np.log(X), np.log(low))
        start = {"isotherm_coefficient": float(np.exp(intercept)), "isotherm_exponent": max(-slope, 0.1)}
        bounds = {"isotherm_coefficient": (1e-30, INF), "isotherm_exponent": (0.05, 20.0)}
        if cls is m.FerroFontan:
            start["structure_factor"], bounds["structure_factor"] = 1.02, (float(aw.max()) * 1.0005, 3.0)
        return start, bounds
    if cls is m.Henderson:
        slope, intercept = _line(np.log(X), np.log(-np.log1p(-aw)))
        return {"isotherm_coefficient": float(np.exp(intercept) / T), "isotherm_exponent": max(slope, 0.1)}, {
            "isotherm_coefficient": (1e-30, INF),
            "isotherm_exponent": (0.05, 20.0),
        }
    if cls in (m.Smith, m.Kuhn):
        slope, intercept = _line(-np.log1p(-aw) if cls is m.Smith else 1.0 / low, X)
        names = ("isotherm_coefficient", "isotherm_coefficient_second")
        pair = (intercept, max(slope, 1e-6)) if cls is m.Smith else (max(slope, 1e-6), intercept)
        return dict(zip(names, pair, strict=True)), {names[1] if cls is m.Smith else names[0]: POSITIVE}
    if cls is m.Caurie:
        slope, intercept = _line(aw, np.log(X))
        return {"isotherm_coefficient": intercept, "isotherm_coefficient_second": max(slope, 0.1)}, {
            "isotherm_coefficient_second": POSITIVE
        }
    if cls is m.IglesiasChirife:
        half = float(np.interp(0.5, *_sorted(aw, X)))
        slope, intercept = _line(aw, np.log(X + np.sqrt(X**2 + half)))
        return {"isotherm_coefficient": slope, "isotherm_coefficient_second": intercept}, {}
    slope, intercept = _line(X, np.log(low))  # Bradley and Chen: ln(−ln a) falls with X
    if cls is m.Bradley:
        return {"isotherm_base": float(np.exp(slope)), "isotherm_coefficient": float(np.exp(intercept))}, {
            "isotherm_base": (1e-30, 0.9999),
            "isotherm_coefficient": POSITIVE,
        }
    return {
        "isotherm_coefficient": float(np.exp(intercept)),
        "isotherm_exponent": max(-slope, 0.1),
        "isotherm_offset": -1e-3,
    }, {
        "isotherm_coefficient": POSITIVE,
        "isotherm_exponent": (1e-3, INF),
        "isotherm_offset": (float(np.log(aw.max())), 1.0),
    }
