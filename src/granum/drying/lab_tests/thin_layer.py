"""Thin-layer models fitted to a drying curve and ranked."""

from __future__ import annotations

from typing import Annotated, Any, ClassVar, Literal

import jax.numpy as jnp
import numpy as np

from granum.core import lab_test
from granum.core.errors import InputError
from granum.core.i18n import _
from granum.core.kinds import MoistureDryBasis, Number, Ratio, Series, Time
from granum.drying.lab_tests.ranking import Ranked, rank
from granum.drying.thin_layers import exponential as e
from granum.drying.thin_layers import other as o
from granum.estimation import Fit, LabTest

MODELS: dict[str, type] = {
    "lewis": e.Lewis,
    "page": e.Page,
    "page_modified": e.PageModified,
    "weibull": e.Weibull,
    "henderson_pabis": e.HendersonPabis,
    "logarithmic": e.Logarithmic,
    "two_term": e.TwoTerm,
    "two_term_exponential": e.TwoTermExponential,
    "verma": e.Verma,
    "diffusion_approach": e.DiffusionApproach,
    "henderson_pabis_modified": e.HendersonPabisModified,
    "midilli": o.Midilli,
    "weibull_four": o.WeibullFour,
    "demir": o.Demir,
    "hii": o.Hii,
    "wang_singh": o.WangSingh,
    "parabolic": o.Parabolic,
    "peleg": o.PelegRatio,
    "silva": o.Silva,
    "fick_simplified": o.FickSimplified,
    "thompson": o.Thompson,
    "aghbashlo": o.Aghbashlo,
}


@lab_test(
    "thin_layer_test",
    source="erbay2010; burnham2002",
    title="Thin-layer drying test",
    equation=r"MR = \frac{X - X_e}{X_0 - X_e}",
)
class ThinLayerTest(LabTest):
    """Thin-layer models fitted to moisture ratios and ranked by AICc; models that draw the same curve are
    known as one.

    Give the column ``moisture_ratio``, or ``moisture_dry_basis`` with the equilibrium moisture (the first
    point is taken as the initial moisture). ``model`` fits one model by name; ``best``, the default, the
    best-ranked of all.
    """

    time: Annotated[Time, Series("points")]
    moisture_ratio: Annotated[Ratio, Series("points")] | None = None
    moisture_dry_basis: Annotated[MoistureDryBasis, Series("points")] | None = None
    equilibrium_moisture: MoistureDryBasis = 0.0
    model: Literal[
        "best",
        "lewis",
        "page",
        "page_modified",
        "weibull",
        "henderson_pabis",
        "logarithmic",
        "two_term",
        "two_term_exponential",
        "verma",
        "diffusion_approach",
        "henderson_pabis_modified",
        "midilli",
        "weibull_four",
        "demir",
        "hii",
        "wang_singh",
        "parabolic",
        "peleg",
        "silva",
        "fick_simplified",
        "thompson",
        "aghbashlo",
    ] = "best"
    estimates: ClassVar = {"rate_constant": Number, "time_exponent": Number}
    axes: ClassVar = {"time": Time, "moisture_ratio": Ratio}
    least_points: ClassVar[int] = 4

    def ratios(self) -> np.ndarray:
        """Moisture ratios of the points."""
        if (self.moisture_ratio is None) == (self.moisture_dry_basis is None):
            raise InputError(_("Give either a column 'moisture_ratio' or a column 'moisture_dry_basis'."))
        if self.moisture_ratio is not None:
            return np.asarray(self.moisture_ratio, dtype=float)
        X = np.asarray(self.moisture_dry_basis, dtype=float)
        if self.equilibrium_moisture >= X[0]:
            raise InputError(
                _("The equilibrium moisture lies above the first moisture."), name="equilibrium_moisture"
            )
        return (X - self.equilibrium_moisture) / (X[0] - self.equilibrium_moisture)

    def _fit_one(self, cls: Any, *, judged: bool = False) -> Fit:
        t, MR = np.asarray(self.time, dtype=float), self.ratios()
        unit = self._unit(t, MR)
        first = cls.first(1.0)

        def model(p: dict[str, Any], t: Any) -> Any:
            return cls(**p).ratio(jnp.asarray(t))

        # start values belong to times in units of the time to 1/e, where every parameter is of order one
        start = self._restated(first, cls, unit)
        return self.fitted(model, start, t, MR, bounds=dict(cls.bounds), judged=judged)

    @staticmethod
    def _unit(t: np.ndarray, MR: np.ndarray) -> float:
        below = np.flatnonzero(np.exp(-1.0) >= MR)
        return float(max(t[below[0]] if below.size else t[-1] / max(-np.log(max(MR[-1], 1e-3)), 1e-2), 1e-12))

    @staticmethod
    def _restated(values: dict[str, float], cls: Any, unit: float) -> dict[str, float]:
        n = values.get("time_exponent", 1.0)
        stretched = cls.curve in ("midilli", "hii") or cls in (e.Page, o.WeibullFour)
        powers = {
            "rate_constant": -n if stretched else -1.0,
            "rate_constant_second": -n if stretched else -1.0,
            "rate_constant_third": -1.0,
            "time_scale": 1.0,
            "time_slope": -1.0,
            "time_curvature": -2.0,
            "root_rate": -0.5,
            "rate_area": -1.0,
            "thompson_linear": 1.0,
            "thompson_quadratic": 1.0,
        }
        return {name: value * unit ** powers.get(name, 0.0) for name, value in values.items()}

    def ranking(self) -> tuple[list[Ranked], dict[str, str]]:
        """All models, best first, and those that could not be fitted with the reason."""
        self.increasing("time")
        return rank(MODELS, self._fit_one)

    def fit(self) -> Fit:
        """The chosen model, or the best-ranked one, whose name and rivals stand in the flags."""
        self.increasing("time")
        if self.model != "best":
            return self._fit_one(MODELS[self.model], judged=True)
        ranked, _failed = self.ranking()
        found = self.judged(ranked[0].fit, len(ranked))
        found.flags.append(self.note("best model", best_sentence(ranked), ranked[0].name))
        return found


def best_sentence(ranked: list[Ranked]) -> str:
    """Which model leads, which draw the same curve, which are as good."""
    lead = ranked[0]
    same = [r.name for r in ranked[1:] if r.same_curve_as == lead.name]
    close = [r.name for r in ranked[1:] if r.same_curve_as is None and r.delta < 2.0]
    text = _("Best by AICc: {name}.").format(name=lead.name)
    if same:
        text += " " + _("Same curve: {names}.").format(names=", ".join(same))
    if close:
        text += " " + _("As good within 2: {names}.").format(names=", ".join(close))
    return text
