"""Hindrance and compression from one settling curve, by fitting the settling-compression column to it."""

from __future__ import annotations

from typing import Annotated, Any, ClassVar

import equinox as eqx
import jax.numpy as jnp
import numpy as np

from granum.core import lab_test
from granum.core.i18n import _
from granum.core.kinds import (
    Concentration,
    Density,
    Distance,
    Length,
    PressureDifference,
    Series,
    Speed,
    Time,
    VolumePerMass,
    Within,
)
from granum.estimation import Fit, LabTest
from granum.settling.column import Suspension, settle
from granum.settling.compression import LogarithmicStress
from granum.settling.lab_tests.batch_test import BatchTest
from granum.settling.velocities import Vesilind


class _Column(eqx.Module):
    """Height of the interface in a column; a module with its numbers as arrays, so that it is compiled once
    for all tests of one length.
    """

    start_height: Any
    initial_concentration: Any
    solid_density: Any
    liquid_density: Any
    stress_concentration: Any
    cells: int = eqx.field(static=True)

    def __call__(self, p: Any, time: Any) -> Any:
        stress = LogarithmicStress(p["critical_concentration"], p["stress_scale"], self.stress_concentration)
        law = Vesilind(p["vesilind_velocity"], p["vesilind_coefficient"])
        suspension = Suspension(law, stress, self.solid_density, self.liquid_density)
        times = jnp.concatenate([jnp.zeros(1), jnp.asarray(time)])
        course = settle(suspension, self.start_height, self.initial_concentration, times, cells=self.cells)
        return course.interface_height(0.5 * self.initial_concentration)[1:]


@lab_test(
    "compression_test", source="burger2011; declercq2008; diehl2015", title="Settling curve with compression"
)
class CompressionTest(LabTest):
    """Long settling curve into compression: the whole curve is fitted by the one-dimensional
    settling-compression model.

    Estimates Vesilind's constants, the critical concentration and the scale of the logarithmic effective
    stress; its concentration scale is given. First values come from Kynch's construction. The grid is that of
    ``cells``.
    """

    time: Annotated[Time, Series("points")]
    interface_height: Annotated[Distance, Series("points")]
    initial_concentration: Concentration
    solid_density: Density
    liquid_density: Density = 998.0
    initial_height: Length | None = None
    stress_concentration: Concentration = 4.0
    cells: Annotated[int, Within(5, 5000)] = 100

    estimates: ClassVar = {
        "vesilind_velocity": Speed,
        "vesilind_coefficient": VolumePerMass,
        "critical_concentration": Concentration,
        "stress_scale": PressureDifference,
    }
    axes: ClassVar = {"time": Time, "interface_height": Distance}
    least_points: ClassVar = 8

    def model(self, p: Any, time: Any, start_height: Any) -> Any:
        """Height of the interface at given times."""
        return self._column(start_height)(p, time)

    def _column(self, start_height: Any) -> _Column:
        numbers = (
            start_height,
            self.initial_concentration,
            self.solid_density,
            self.liquid_density,
            self.stress_concentration,
        )
        return _Column(*(jnp.asarray(value, dtype=float) for value in numbers), cells=self.cells)

    def fit(self) -> Fit:
        """Constants of hindrance and compression."""
        before = BatchTest(
            time=self.time,
            interface_height=self.interface_height,
            initial_concentration=self.initial_concentration,
            initial_height=self.initial_height,
        )
        c = before.curve()
        first = before.fit()
        final = float(self.initial_concentration) * c.initial_height / float(c.height[-1])
        found = first.derived.get("compression_concentration")
        critical = found.value if found else 0.7 * final
        buoyant = 9.80665 * (1.0 - float(self.liquid_density) / float(self.solid_density))
        weight = buoyant * float(self.initial_concentration) * c.initial_height
        start = {
            **first.values,
            "critical_concentration": min(critical, 0.9 * final),
            "stress_scale": max(weight, 1e-6),
        }
        later = c.time > 0
        flags = [self.note(word, sentence) for word, sentence in c.said]
        flags.append(
            self.note(
                "grid",
                _("Fitted on {cells} cells: finer grids shift the front by less than a cell.").format(
                    cells=self.cells
                ),
            )
        )
        low = 1.01 * float(self.initial_concentration)
        bounds = dict.fromkeys(start, (1e-09, np.inf)) | {"critical_concentration": (low, np.inf)}
        return self.fitted(
            self._column(c.initial_height), start, c.time[later], c.height[later], bounds=bounds, flags=flags
        )
