"""Induction time against supersaturation: interfacial energy by classical nucleation theory."""

from __future__ import annotations

from typing import Annotated, Any, ClassVar

import jax.numpy as jnp
import numpy as np

from granum.core import lab_test
from granum.core.constants import AVOGADRO, BOLTZMANN
from granum.core.errors import InputError
from granum.core.i18n import _
from granum.core.kinds import (
    Density,
    Length,
    MolarMass,
    PositiveNumber,
    Series,
    SurfaceTension,
    Temperature,
    Time,
)
from granum.estimation import Fit, LabTest
from granum.estimation.lines import straight_line


@lab_test(
    "induction_time",
    source="mullin2001, ch. 5; volmer1939",
    title="Induction time by supersaturation",
    equation=r"\ln t_{ind} = \ln t_0 + \frac{16\pi\gamma^3 v_m^2}{3 (kT)^3 (\nu\ln\beta)^2}",
)
class InductionTime(LabTest):
    """Interfacial energy from the time to the first crystals at several supersaturations, one temperature.

    One straight line means one mechanism; homogeneous nucleation at high and heterogeneous nucleation at low
    supersaturation bend it, and should be fitted apart.
    """

    supersaturation_ratio: Annotated[PositiveNumber, Series("points")]
    induction_time: Annotated[Time, Series("points")]
    temperature: Temperature
    crystal_density: Density
    molar_mass: MolarMass
    ions_per_formula: PositiveNumber = 1.0

    estimates: ClassVar = {"interfacial_energy": SurfaceTension, "induction_time_limit": Time}
    holds_for: ClassVar = ("supersaturation_ratio", "temperature")
    axes: ClassVar = {"supersaturation_ratio": PositiveNumber, "induction_time": Time}

    def fit(self) -> Fit:
        """Interfacial energy and the limit of the induction time with 95 % intervals; critical radii from
        them.
        """
        self.above_zero("induction_time")
        S, t = np.asarray(self.supersaturation_ratio), np.asarray(self.induction_time)
        if np.any(S <= 1.0):
            raise InputError(
                _(
                    "A solution with a supersaturation ratio of 1 or less never crystallizes: leave "
                    "those points out."
                ),
                name="supersaturation_ratio",
            )
        T, nu, v = (
            self.temperature,
            self.ions_per_formula,
            self.molar_mass / (self.crystal_density * AVOGADRO),
        )
        slope, level = straight_line(1.0 / (nu * np.log(S)) ** 2, np.log(t))
        kT = BOLTZMANN * T
        unit = 16.0 * np.pi / 3.0 * v**2 / kT**3
        return self.fitted(
            lambda p, S: (
                jnp.log(p["induction_time_limit"])
                + unit * p["interfacial_energy"] ** 3 / (nu * jnp.log(S)) ** 2
            ),
            {
                "interfacial_energy": float((max(slope, 1e-9) / unit) ** (1 / 3)),
                "induction_time_limit": float(np.exp(level)),
            },
            S,
            np.log(t),
            bounds={"interfacial_energy": (0.0, np.inf), "induction_time_limit": (0.0, np.inf)},
            derived=lambda p: {
                "critical_radius": 2.0 * p["interfacial_energy"] * v / (nu * kT * float(np.log(S.mean())))
            },
            kinds={"critical_radius": Length},
        )

    def chart(self) -> Any:
        """Logarithm of the induction time against the inverse square of the logarithm of the
        supersaturation.
        """
        from granum.core.charts import add_line, add_points, axis_title, figure

        self.above_zero("induction_time")
        S, t = np.asarray(self.supersaturation_ratio), np.asarray(self.induction_time)
        grid = np.linspace(S.min(), S.max(), 100)
        drawing = figure(
            "1 / (ln <i>β</i>)²", axis_title("induction_time", "s"), title=type(self).card.title, y_log=True
        )
        add_line(drawing, 1 / np.log(grid) ** 2, np.exp(self.fit().predict(grid).value), _("model"))
        add_points(drawing, 1 / np.log(S) ** 2, t, _("data"))
        return drawing
