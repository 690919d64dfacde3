"""Series of batch tests after Coe and Clevenger: settling velocity at several concentrations, and the area
they ask for.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Annotated, Any, ClassVar

import jax.numpy as jnp
import numpy as np

from granum.core import lab_test
from granum.core.errors import InputError
from granum.core.i18n import _
from granum.core.kinds import Concentration, MassFlux, Series, Speed, VolumePerMass
from granum.estimation import Estimate, Fit, LabTest
from granum.estimation.lines import straight_line
from granum.settling.flux import limiting_flux_underflow
from granum.settling.formulas.thickening import unit_area_coe_clevenger
from granum.settling.velocities import Vesilind


@lab_test(
    "coe_clevenger_series", source="coe1916; vesilind1968", title="Series of settling tests (Coe–Clevenger)"
)
class CoeClevengerSeries(LabTest):
    """Hindered settling velocities at several concentrations between feed and underflow.

    Gives the greatest unit area over the tests, and a Vesilind law through them (relative errors of the
    velocities) with the limiting flux to the underflow that follows from it.
    """

    solids_concentration: Annotated[Concentration, Series("tests")]
    settling_velocity: Annotated[Speed, Series("tests")]
    underflow_concentration: Concentration

    estimates: ClassVar = {"vesilind_velocity": Speed, "vesilind_coefficient": VolumePerMass}
    holds_for: ClassVar = ("solids_concentration",)
    axes: ClassVar = {"solids_concentration": Concentration, "settling_velocity": Speed}
    least_points: ClassVar = 3

    def fit(self) -> Fit:
        """Vesilind constants, limiting flux and unit area."""
        C, v = (
            np.asarray(self.solids_concentration, dtype=float),
            np.asarray(self.settling_velocity, dtype=float),
        )
        if np.any(v <= 0):
            raise InputError(_("Every settling velocity must be greater than zero."))
        if C.min() >= self.underflow_concentration:
            raise InputError(
                _(
                    "No test is thinner than the underflow ({underflow} kg/m³): there is nothing to thicken."
                ).format(underflow=float(self.underflow_concentration))
            )
        slope, level = straight_line(C, np.log(v))
        start = {
            "vesilind_velocity": float(np.exp(level)),
            "vesilind_coefficient": max(float(-slope), 0.1 / float(C.max())),
        }
        feed, Cu = float(C.min()), float(self.underflow_concentration)

        def derived(p: Any) -> dict[str, Any]:
            law = Vesilind(p["vesilind_velocity"], p["vesilind_coefficient"])
            return {
                "limiting_flux": limiting_flux_underflow(
                    jnp.asarray(Cu), jnp.asarray(feed), law
                ).limiting_flux
            }

        found = self.fitted(
            lambda p, x: p["vesilind_velocity"] * jnp.exp(-p["vesilind_coefficient"] * x),
            start,
            C,
            v,
            sigma=v,
            bounds={"vesilind_velocity": (0.0, np.inf), "vesilind_coefficient": (0.0, np.inf)},
            derived=derived,
            kinds={"limiting_flux": MassFlux},
        )
        area = float(np.max(np.asarray(unit_area_coe_clevenger(C, v, Cu))))
        return replace(
            found, derived={**found.derived, "unit_area_coe_clevenger": Estimate(area, "m^2*s/kg")}
        )
