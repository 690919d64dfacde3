"""Bottles of liquid or gas at rest with carbon: which isotherm the loadings follow."""

from __future__ import annotations

from typing import Annotated, Any, ClassVar, Literal

import jax.numpy as jnp
import numpy as np

from granum.core import lab_test
from granum.core.errors import InputError
from granum.core.i18n import _
from granum.core.kinds import Concentration, MassRatio, Series
from granum.estimation import Fit, LabTest
from granum.estimation.lines import straight_line
from granum.filtration.adsorption import FreundlichIsotherm, LangmuirIsotherm
from granum.filtration.kinds import AdsorptionAffinity, AdsorptionExponent, LoadingScale

Form = Literal["langmuir", "freundlich"]
LAWS: dict[Form, Any] = {"langmuir": LangmuirIsotherm, "freundlich": FreundlichIsotherm}
NAMES = {"langmuir": "Langmuir", "freundlich": "Freundlich"}


@lab_test(
    "adsorption_test",
    source="langmuir1918; freundlich1906; dobbs1980",
    title="Adsorption isotherm of carbon",
    equation=r"q = q_m\,\frac{b\,c}{1 + b\,c},\quad q = q_1\left(\frac{c}{c_1}\right)^{1/n}",
)
class AdsorptionTest(LabTest):
    """Langmuir's or Freundlich's isotherm from loadings at rest over concentrations, the one that fits best
    or a named one.

    Freundlich's loading is that at 1 mg/L. Both have two parameters, so that the least scatter ranks them;
    the flags say how far the other is behind. One temperature holds for all points.
    """

    concentration: Annotated[Concentration, Series("points")]
    adsorbate_loading: Annotated[MassRatio, Series("points")]
    isotherm_form: Literal["best", "langmuir", "freundlich"] = "best"

    estimates: ClassVar = {
        "loading_highest": LoadingScale,
        "adsorption_affinity": AdsorptionAffinity,
        "loading_reference": LoadingScale,
        "adsorption_exponent": AdsorptionExponent,
    }
    axes: ClassVar = {"concentration": Concentration, "adsorbate_loading": MassRatio}
    least_points: ClassVar[int] = 4

    def _fit_one(self, form: Form, *, judged: bool) -> Fit:
        c, q = np.asarray(self.concentration, dtype=float), np.asarray(self.adsorbate_loading, dtype=float)
        if form == "langmuir":
            slope, at_zero = straight_line(c, c / q)
            top = 1.0 / slope if slope > 0.0 else 2.0 * float(q.max())
            start = {
                "loading_highest": top,
                "adsorption_affinity": slope / at_zero
                if slope > 0.0 < at_zero
                else 1.0 / float(np.median(c)),
            }
            bounds = {"loading_highest": (1e-9, 5.0), "adsorption_affinity": (1e-9, 1e12)}
        else:
            slope, at_one = straight_line(np.log(c / 1e-3), np.log(q))
            start = {
                "loading_reference": float(np.exp(at_one)),
                "adsorption_exponent": float(np.clip(slope, 0.05, 3.0)),
            }
            bounds = {"loading_reference": (1e-9, 5.0), "adsorption_exponent": (0.01, 5.0)}
        start = {name: float(np.clip(start[name], *bounds[name])) for name in start}

        def model(p: dict[str, Any], c: Any) -> Any:
            return LAWS[form](**p)(jnp.asarray(c))

        return self.fitted(model, start, c, q, bounds=bounds, judged=judged)

    def fit(self) -> Fit:
        """The parameters of the isotherm with 95 % intervals."""
        c, q = np.asarray(self.concentration, dtype=float), np.asarray(self.adsorbate_loading, dtype=float)
        for name, column in (("concentration", c), ("adsorbate_loading", q)):
            if not np.all(column > 0.0):
                raise InputError(
                    _("Leave out bottles without a concentration or a loading: an isotherm starts at zero."),
                    name=name,
                )
        if self.isotherm_form != "best":
            return self._fit_one(self.isotherm_form, judged=True)
        fits = {form: self._fit_one(form, judged=False) for form in LAWS}
        first, second = sorted(fits, key=lambda form: fits[form].statistics["rmse"])
        behind = fits[second].statistics["rmse"] / max(fits[first].statistics["rmse"], 1e-300)
        found = self.judged(fits[first], len(LAWS))
        text = _("{name}'s isotherm fits best; {second}'s has {ratio} times its scatter.")
        told = text.format(name=NAMES[first], second=NAMES[second], ratio=f"{min(behind, 1e6):.3g}")
        found.flags.append(self.note("best isotherm", told, first))
        return found
