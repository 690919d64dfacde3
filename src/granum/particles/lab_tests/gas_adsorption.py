"""Gas adsorption: surface of a powder from the gas that it takes up (BET)."""

from __future__ import annotations

from typing import Annotated, Any, ClassVar

import numpy as np

from granum.core import lab_test
from granum.core.errors import InputError
from granum.core.i18n import _
from granum.core.kinds import (
    Fraction,
    MolecularArea,
    PositiveNumber,
    Series,
    SpecificSurfaceMass,
    SpecificVolume,
    VolumePerMass,
)
from granum.estimation import Fit, LabTest
from granum.estimation.lines import straight_line
from granum.particles.formulas.gas_adsorption import NITROGEN, adsorbed_volume_bet, specific_surface_mass_bet

LOWEST, HIGHEST = 0.05, 0.30  # relative pressures between which layers grow as the theory has it


@lab_test(
    "gas_adsorption",
    source="brunauer1938; iso9277",
    title="Gas adsorption (BET)",
    equation=r"\frac{x}{v(1-x)} = \frac{1}{v_m C} + \frac{C-1}{v_m C}\,x,\quad x = p/p_0",
)
class GasAdsorption(LabTest):
    """Surface per mass of a powder from gas adsorbed at several relative pressures, by Brunauer, Emmett and
    Teller.

    Only points at relative pressures from 0.05 to 0.30 count unless ``every_point``, readings with equal
    relative weight, where the customary plot would weigh those at high pressure most. The surface is that of
    the monolayer; pores narrower than 2 nm fill before and make it look larger.

    >>> test = GasAdsorption(
    ...     relative_pressure=[0.05, 0.1, 0.2, 0.3],
    ...     adsorbed_volume="0.884564 1.019368 1.201923 1.396003 cm^3/g",
    ... )
    >>> round(1e3 * test.fit()["monolayer_volume"].value, 3)
    1.0
    """

    relative_pressure: Annotated[Fraction, Series("points")]
    adsorbed_volume: Annotated[VolumePerMass, Series("points")]
    molecule_area: MolecularArea = NITROGEN
    every_point: bool = False

    estimates: ClassVar = {"monolayer_volume": SpecificVolume, "monolayer_constant": PositiveNumber}
    holds_for: ClassVar = ("relative_pressure",)
    axes: ClassVar = {"relative_pressure": Fraction, "adsorbed_volume": VolumePerMass}

    def fit(self) -> Fit:
        """Monolayer, its constant and the surface, with 95 % intervals."""
        x, v = np.asarray(self.relative_pressure, float), np.asarray(self.adsorbed_volume, float)
        self.above_zero("adsorbed_volume")
        used = np.flatnonzero((x > 0.0) & (x < 1.0) & (self.every_point | (x >= LOWEST) & (x <= HIGHEST)))
        if np.unique(x[used]).size < 3:
            message = _(
                "{count} relative pressures lie between {low} and {high}, where layers grow by the theory; "
                "three are needed. Take readings there, or set 'every_point' to count all."
            )
            raise InputError(
                message.format(count=np.unique(x[used]).size, low=LOWEST, high=HIGHEST),
                name="relative_pressure",
            )
        x, v = x[used], v[used]
        slope, intercept = straight_line(x, x / (v * (1.0 - x)))
        if slope + intercept <= 0.0:
            raise InputError(
                _(
                    "These points have no monolayer: the gas adsorbed rises more steeply than layers on "
                    "layers."
                ),
                name="adsorbed_volume",
            )
        monolayer = 1.0 / (slope + intercept)
        constant = (slope + intercept) / intercept if intercept > 0.0 else 1000.0
        return self.fitted(
            self._model,
            {"monolayer_volume": monolayer, "monolayer_constant": float(np.clip(constant, 0.1, 1e4))},
            x,
            v,
            bounds={"monolayer_volume": (0.0, np.inf), "monolayer_constant": (0.0, 1e6)},
            sigma=v,
            index=used,
            derived=self._surface,
            kinds={"specific_surface_mass": SpecificSurfaceMass},
        )

    def _model(self, p: dict[str, Any], x: Any) -> Any:
        return adsorbed_volume_bet(x, p["monolayer_volume"], p["monolayer_constant"])

    def _surface(self, p: dict[str, Any]) -> dict[str, Any]:
        return {"specific_surface_mass": specific_surface_mass_bet(p["monolayer_volume"], self.molecule_area)}
