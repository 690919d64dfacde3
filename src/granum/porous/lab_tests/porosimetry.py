"""Mercury porosimetry: pores of a solid from the mercury pressed into it."""

from __future__ import annotations

from typing import Annotated, Any, ClassVar

import jax.numpy as jnp
import numpy as np
from jax.scipy.special import ndtr

from granum.core import lab_test
from granum.core.errors import InputError
from granum.core.i18n import _
from granum.core.kinds import (
    Density,
    Length,
    PositiveNumber,
    Pressure,
    Series,
    SpecificVolume,
    SurfaceTension,
    VoidFraction,
    VolumePerMass,
)
from granum.estimation import Fit, LabTest
from granum.porous.formulas.porosimetry import MERCURY_ANGLE, MERCURY_TENSION, Wetting, pore_diameter_washburn


@lab_test(
    "mercury_porosimetry",
    source="washburn1921; iso15901",
    title="Mercury porosimetry",
    equation=r"v(p) = v_p\,\Phi\!\left(\frac{\ln(d_{50}/d_p)}{\ln\sigma_g}\right),\quad"
    r" d_p = -\frac{4\sigma\cos\theta}{p}",
)
class MercuryPorosimetry(LabTest):
    """Pore volume, median pore and spread of the pores of a solid from mercury pressed in at rising pressure.

    Pores by volume are log-normal over the diameter of their necks, which must be one family: give the points
    from above the pressure that fills the gaps between grains, and volumes from there. The density of the
    solid itself adds the porosity. Readings count equally.

    >>> test = MercuryPorosimetry(
    ...     intrusion_pressure="1 3 5 8 12 30 100 MPa",
    ...     intruded_volume="0.0015 0.075 0.18 0.308 0.40 0.487 0.5 mL/g",
    ... )
    >>> round(1e9 * test.fit()["pore_diameter"].value, -1)
    230.0
    """

    intrusion_pressure: Annotated[Pressure, Series("points")]
    intruded_volume: Annotated[VolumePerMass, Series("points")]
    surface_tension: SurfaceTension = MERCURY_TENSION
    wetting_angle: Wetting = MERCURY_ANGLE
    solid_density: Density | None = None

    estimates: ClassVar = {
        "pore_volume": SpecificVolume,
        "pore_diameter": Length,
        "geometric_standard_deviation": PositiveNumber,
    }
    holds_for: ClassVar = ("intrusion_pressure",)
    axes: ClassVar = {"intrusion_pressure": Pressure, "intruded_volume": VolumePerMass}

    def fit(self) -> Fit:
        """Pore volume, median pore, spread and porosity, with 95 % intervals."""
        p, v = np.asarray(self.intrusion_pressure, float), np.asarray(self.intruded_volume, float)
        self.above_zero("intrusion_pressure")
        greatest = v.max()
        if greatest <= 0.0:
            raise InputError(_("No mercury was taken up: there is nothing to fit."), name="intruded_volume")
        order = np.argsort(p)
        filled = np.maximum.accumulate(v[order])
        low, middle = (np.interp(share * greatest, filled, np.log(p[order])) for share in (0.16, 0.5))
        start = {
            "pore_volume": greatest,
            "pore_diameter": float(self._diameter(np.exp(middle))),
            "geometric_standard_deviation": float(np.exp(np.clip(middle - low, 0.05, 3.0))),
        }
        bounds = {"pore_volume": (0.0, np.inf), "pore_diameter": (0.0, np.inf)}
        bounds["geometric_standard_deviation"] = (1.001, 100.0)
        options: dict[str, Any] = {}
        if self.solid_density is not None:
            options = {"derived": self._porosity, "kinds": {"void_fraction": VoidFraction}}
        return self.fitted(self._model, start, p, v, bounds=bounds, **options)

    def _diameter(self, pressure: Any) -> Any:
        return pore_diameter_washburn(pressure, self.surface_tension, self.wetting_angle)

    def _model(self, p: dict[str, Any], pressure: Any) -> Any:
        spread = jnp.log(p["geometric_standard_deviation"])
        return p["pore_volume"] * ndtr(jnp.log(p["pore_diameter"] / self._diameter(pressure)) / spread)

    def _porosity(self, p: dict[str, Any]) -> dict[str, Any]:
        pores = p["pore_volume"] * self.solid_density
        return {"void_fraction": pores / (1.0 + pores)}
