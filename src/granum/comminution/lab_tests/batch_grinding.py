"""Batch grinding test of a single size class."""

from __future__ import annotations

from math import inf, log
from typing import Annotated, ClassVar

import jax.numpy as jnp
import numpy as np

from granum.core import lab_test
from granum.core.errors import InputError
from granum.core.i18n import _
from granum.core.kinds import Fraction, Frequency, Series, Time
from granum.estimation import Fit, LabTest


@lab_test("batch_grinding", source="austin1984, ch. 4", title="Batch grinding of one size class")
class BatchGrinding(LabTest):
    """First-order breakage rate of a top size class from what is left of it after grinding times.

    This is the rate at which mass leaves the class: Austin's selection function of that class where it is a
    root-two class (the convention ``root_two`` of ``ball_mill``). Fragments that stay in the class are not
    counted as broken.

    >>> import numpy as np
    >>> test = BatchGrinding([0, 60, 120, 240], np.exp(-0.01 * np.array([0, 60, 120, 240])))
    >>> round(test.fit()["selection_function"].value, 6)
    0.01
    """

    grinding_time: Annotated[Time, Series("points")]
    remaining_fraction: Annotated[Fraction, Series("points")]
    estimates: ClassVar = {"selection_function": Frequency, "remaining_fraction_start": Fraction}
    axes: ClassVar = {"grinding_time": Time, "remaining_fraction": Fraction}

    def fit(self) -> Fit:
        """Rate of breakage and the fraction at time 0 (below 1 when the sieving was not perfect)."""
        t, w = np.asarray(self.grinding_time), np.asarray(self.remaining_fraction)
        usable = w > 0
        if np.ptp(t) <= 0 or usable.sum() < 2:
            raise InputError(
                _("The rate of breakage shows only between two grinding times with material left."),
                name="remaining_fraction",
            )
        slope = max(
            -log(max(w[usable][-1] / w[usable][0], 1e-12)) / max(t[usable][-1] - t[usable][0], 1e-12), 1e-9
        )
        return self.fitted(
            lambda p, x: p["remaining_fraction_start"] * jnp.exp(-p["selection_function"] * x),
            {"selection_function": slope, "remaining_fraction_start": float(w[0])},
            t,
            w,
            bounds={"selection_function": (0.0, inf), "remaining_fraction_start": (0.0, 1.1)},
        )
