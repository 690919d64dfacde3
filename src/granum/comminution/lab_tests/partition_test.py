"""Partition test: weighed size classes of the two products of a screen or classifier."""

from __future__ import annotations

from math import inf
from typing import TYPE_CHECKING, Annotated, Any, ClassVar, Literal

import numpy as np

from granum.core import lab_test
from granum.core.errors import InputError
from granum.core.i18n import _
from granum.core.kinds import Fraction, Length, Mass, PositiveNumber, Ratio, Series
from granum.estimation import Fit, LabTest
from granum.particles.partition import (
    BypassedPartition,
    LogisticPartition,
    MolerusHoffmannPartition,
    RosinRammlerPartition,
    WhitenPartition,
)

if TYPE_CHECKING:
    import plotly.graph_objects as go

_CURVES = {
    "logistic": LogisticPartition,
    "rosin_rammler": RosinRammlerPartition,
    "whiten": WhitenPartition,
    "molerus_hoffmann": MolerusHoffmannPartition,
}


@lab_test("partition_test", source="tromp1937; wills2016", title="Partition (Tromp) test")
class PartitionTest(LabTest):
    """Partition curve of a screen or classifier from the masses of each size class in its two products.

    Masses are flows or amounts on one common scale (coarse and fine product of the same time). The partition
    number of a class is its coarse mass over the sum; classes are weighted by the root of what they hold, and
    empty ones are left out. The curve is fitted at the class sizes.

    >>> test = PartitionTest([50e-6, 100e-6, 200e-6, 400e-6], [1.0, 5.0, 8.0, 9.9], [9.0, 5.0, 2.0, 0.1])
    >>> round(test.fit()["cut_size"].value * 1e6)
    105
    """

    class_sizes: Annotated[Length, Series("classes")]
    coarse_mass: Annotated[Mass, Series("classes")]
    fine_mass: Annotated[Mass, Series("classes")]
    curve_law: Literal["logistic", "rosin_rammler", "whiten", "molerus_hoffmann"] = "logistic"
    with_bypass: bool = False
    estimates: ClassVar = {
        "cut_size": Length,
        "sharpness": PositiveNumber,
        "bypass_fraction": Fraction,
        "percentile_25": Length,
        "percentile_75": Length,
        "sharpness_index": Ratio,
        "probable_error": Length,
        "imperfection": Ratio,
    }
    axes: ClassVar = {"particle_diameter": Length, "partition_number": Fraction}

    def partition_numbers(self) -> tuple[np.ndarray, np.ndarray]:
        """Coarse fraction and total mass of each class; NaN in empty classes."""
        coarse, fine = np.asarray(self.coarse_mass), np.asarray(self.fine_mass)
        total = coarse + fine
        return np.where(total > 0, coarse / np.where(total > 0, total, 1.0), np.nan), total

    def curve(self, values: dict[str, Any]) -> Any:
        """The partition curve of some estimates."""
        plain = _CURVES[self.curve_law](values["cut_size"], values["sharpness"])
        return BypassedPartition(plain, values["bypass_fraction"]) if "bypass_fraction" in values else plain

    def fit(self) -> Fit:
        """Cut size, sharpness and bypass; the 25 and 75 % sizes are those of the corrected curve."""
        self.above_zero("class_sizes")
        sizes = np.asarray(self.class_sizes)
        numbers, total = self.partition_numbers()
        filled = total > 0
        if not np.any(numbers[filled] > 0.5) or not np.any(numbers[filled] < 0.5):
            raise InputError(
                _("No class lies on the other side of 50 %: the cut size is outside the measured classes."),
                name="class_sizes",
            )
        start = {
            "cut_size": float(
                np.exp(np.interp(0.5, np.sort(numbers[filled]), np.sort(np.log(sizes[filled]))))
            ),
            "sharpness": 2.0,
        }
        if self.with_bypass:
            start["bypass_fraction"] = 0.1
        plain = _CURVES[self.curve_law]

        def derived(p: dict[str, Any]) -> dict[str, Any]:
            corrected = plain(p["cut_size"], p["sharpness"])
            d25, d75 = corrected.size_at(0.25), corrected.size_at(0.75)
            return {
                "percentile_25": d25,
                "percentile_75": d75,
                "sharpness_index": d25 / d75,
                "probable_error": 0.5 * (d75 - d25),
                "imperfection": 0.5 * (d75 - d25) / p["cut_size"],
            }

        return self.fitted(
            lambda p, x: self.curve(p)(x),
            start,
            sizes,
            np.where(filled, numbers, 0.5),
            keep=filled,
            derived=derived,
            sigma=1.0 / np.sqrt(np.where(filled, total / total.max(), 1.0)),
            bounds={
                "cut_size": (sizes.min() * 1e-2, sizes.max() * 1e2),
                "sharpness": (1e-3, inf),
                "bypass_fraction": (0.0, 0.99),
            },
        )

    def chart(self) -> go.Figure:
        """Measured partition numbers and the fitted curve over the logarithm of size."""
        from granum.particles.charts_sizes import partition_chart

        numbers, total = self.partition_numbers()
        filled = total > 0
        return partition_chart(
            separation=self.curve(self.fit().values),
            particle_diameter=np.asarray(self.class_sizes)[filled],
            partition_number=numbers[filled],
        )
