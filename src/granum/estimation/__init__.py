"""From laboratory data to parameters: ``fit`` a model, and ``LabTest``, the base of every lab test.

Fitting any model
-----------------
``fit(model, start, x, y)`` takes a function ``model(parameters, x)`` written in ``jax.numpy``, where
    ``parameters`` is a
dict of floats with the names of ``start``; ``x`` and ``y`` are arrays, or tuples of arrays for joint data
    sets. Derivatives
are exact. The result is a frozen ``Fit``: estimates with standard errors and 95 % t-intervals, covariance,
    correlation,
statistics, flags, ``predict`` with a band, ``profile``, ``bootstrap``, ``sample`` and ``as_json``.

>>> import numpy as np
>>> x = np.array([0.0, 1.0, 2.0, 3.0])
>>> found = fit(
...     lambda p, x: p["slope"] * x + p["start"],
...     {"slope": 1.0, "start": 0.0},
...     x,
...     np.array([1.1, 2.9, 5.1, 6.9]),
... )
>>> round(found["slope"].value, 3), round(found["slope"].standard_error, 4)
(1.96, 0.0632)

``CardData.read(card, file, estimate=[…], fixed={…}).fit()`` fits any formula or law to the columns of a file;
``next_experiment`` says where to measure next, ``optimal_design`` plans a set.

Writing a lab test
------------------
A lab test is a frozen class in ``<domain>/lab_tests/<name>.py``. Its ``Series`` fields are the columns of the
    data file, its
other fields the conditions of the test; ``estimates`` says what comes out; ``fit`` fits. Reading files in any
    unit, checks, JSON
and the command ``granum fit`` come from the declaration::

    @lab_test("settling_curve", source="kynch1952", title="Batch settling curve")
    class SettlingCurve(LabTest):
        \"\"\"Initial settling velocity from the height of the interface against time.\"\"\"

        time: Annotated[Time, Series("points")]
        interface_height: Annotated[Distance, Series("points")]
        solids_volume_fraction: VolumeFraction
        estimates: ClassVar = {"settling_velocity": Speed}
        axes: ClassVar = {"time": Time, "interface_height": Distance}      # x and y of the chart

        def fit(self) -> Fit: start = {"settling_velocity": 1e-4, ...} return self.fitted(model, start,
            self.time, self.interface_height, bounds={"settling_velocity": (0.0, inf)}, derived=lambda p:
            {"solids_flux": ...}, kinds={"solids_flux": MassFlux})

    SettlingCurve.read("run1.csv", solids_volume_fraction="2 %").fit()

``self.fitted`` is ``fit`` with the card and the kinds of the class filled in; ``self.note(...)`` makes one
flag with a sentence. A column that may be missing is ``Annotated[..., Series("points")] | None = None``. A
number that is no physical condition but a choice of the evaluation is a plain ``int`` or ``bool`` field with
a default.
"""

from __future__ import annotations

from granum.estimation.cards import CardData, fit_together
from granum.estimation.design import NextExperiment, next_experiment, optimal_design
from granum.estimation.lab_test import LabTest
from granum.estimation.least_squares import fit
from granum.estimation.losses import Huber, LeastSquares, Loss, SoftL1
from granum.estimation.results import Estimate, Fit
from granum.estimation.tables import read_table

__all__ = [
    "CardData",
    "Estimate",
    "Fit",
    "Huber",
    "LabTest",
    "LeastSquares",
    "Loss",
    "NextExperiment",
    "SoftL1",
    "fit",
    "fit_together",
    "next_experiment",
    "optimal_design",
    "read_table",
]
