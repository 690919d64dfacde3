"""Sludge index from settling cylinders at several dilutions."""

from __future__ import annotations

from typing import Annotated, Any, ClassVar

import numpy as np

from granum.core import lab_test
from granum.core.errors import InputError
from granum.core.i18n import _
from granum.core.kinds import Concentration, Fraction, Series, VolumePerMass
from granum.estimation import Fit, LabTest

SETTLED_LIMIT = 0.25  # of the sample: above, the index depends on the concentration
STANDARD_CONCENTRATION = 3.5  # kg/m³, at which the stirred index is stated


@lab_test("sludge_index_test", source="apha2005; white1975; mohlman1934", title="Sludge index with dilution")
class SludgeIndexTest(LabTest):
    """Sludge volume index from the settled volume after 30 minutes at several dilutions.

    Unstirred: the slope of settled volume against concentration over the dilutions that settle to a quarter
    of the sample or less (diluted index); the others are left out. Stirred: the index at 3.5 kg/m³ on the
    line through all tests.
    """

    solids_concentration: Annotated[Concentration, Series("dilutions")]
    settled_fraction: Annotated[Fraction, Series("dilutions")]
    stirred: bool = False

    estimates: ClassVar = {"sludge_volume_index": VolumePerMass, "settled_fraction_offset": Fraction}
    holds_for: ClassVar = ("solids_concentration",)
    axes: ClassVar = {"solids_concentration": Concentration, "settled_fraction": Fraction}
    least_points: ClassVar = 2

    def fit(self) -> Fit:
        """The index with its interval and band."""
        self.above_zero("solids_concentration")
        X, share = (
            np.asarray(self.solids_concentration, dtype=float),
            np.asarray(self.settled_fraction, dtype=float),
        )
        if self.stirred:
            start = {"sludge_volume_index": float(np.mean(share / X)), "settled_fraction_offset": 0.01}
            return self.fitted(
                lambda p, x: (
                    p["sludge_volume_index"] * x
                    + p["settled_fraction_offset"] * (1.0 - x / STANDARD_CONCENTRATION)
                ),
                start,
                X,
                share,
                flags=[self._band(start["sludge_volume_index"])],
            )
        kept = share <= SETTLED_LIMIT
        if np.count_nonzero(kept) < 2:
            raise InputError(
                _(
                    "Fewer than two dilutions settle to {limit} % of the sample or less: dilute further "
                    "with clear effluent."
                ).format(limit=round(100 * SETTLED_LIMIT))
            )
        start = {"sludge_volume_index": float(np.mean(share[kept] / X[kept]))}
        flags = [self._band(start["sludge_volume_index"])]
        return self.fitted(lambda p, x: p["sludge_volume_index"] * x, start, X, share, keep=kept, flags=flags)

    def _band(self, index: float) -> dict[str, Any]:
        value = index * 1e3
        if self.stirred:
            sentence = (
                _("settles well")
                if value < 100
                else _("settles moderately")
                if value <= 120
                else _("settles badly")
            )
        elif value < 50:
            sentence = _("dense sludge, which may leave fine flocs in the overflow")
        elif value <= 150:
            sentence = _("settles well")
        else:
            sentence = _("bulking sludge (filamentous bacteria)")
        return self.note("band", f"{value:.0f} mL/g: {sentence}.", "sludge_volume_index")
