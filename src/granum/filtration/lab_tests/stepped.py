"""One test with steps of pressure: how the cake resistance depends on pressure, without changing the cake."""

from __future__ import annotations

from typing import Annotated, Any, ClassVar

import jax.numpy as jnp
import numpy as np

from granum.core import lab_test
from granum.core.errors import InputError
from granum.core.i18n import _
from granum.core.kinds import (
    Area,
    CakeResistance,
    Concentration,
    DynamicViscosity,
    MediumResistance,
    PressureDrop,
    Ratio,
    Series,
    Time,
    Volume,
)
from granum.estimation import Fit, LabTest
from granum.estimation.lines import straight_line
from granum.filtration.kinds import TimePerVolume
from granum.filtration.lab_tests.starts import bad_start

SAME_STEP, LEAST_RATIO, LEAST_INTERVALS = 1.05, 1.5, 6


@lab_test(
    "stepped_pressure_test",
    source="ruth1935; tiller1953; murase1989",
    title="Filtration test with steps of pressure",
    equation=(
        r"\frac{\Delta t}{\Delta V} = \frac{\eta}{\Omega\,\Delta p}\left[\alpha_0\left(\frac{\Delta "
        r"p}{p_0}\right)^n\frac{W\,V}{\Omega} + R_s\right]"
    ),
)
class SteppedPressureTest(LabTest):
    """Cake resistance at a reference pressure, compressibility and medium resistance from one test whose
    pressure goes up in steps.

    Each interval between readings gives a mean slowness, exact at constant pressure; the cake is taken to
    follow the pressure at once. Intervals in which the pressure changes by more than 5 % are left out, as are
    first intervals of the first step that do not lie on its line. Steps up to half again the first pressure
    at least are needed to see the compressibility.
    """

    time: Annotated[Time, Series("points")]
    filtrate_volume: Annotated[Volume, Series("points")]
    pressure_drop: Annotated[PressureDrop, Series("points")]
    area: Area
    dynamic_viscosity: DynamicViscosity
    dry_cake_per_filtrate: Concentration
    reference_pressure: PressureDrop = 1e5

    estimates: ClassVar = {
        "cake_resistance_reference": CakeResistance,
        "compressibility": Ratio,
        "medium_resistance": MediumResistance,
    }
    holds_for: ClassVar = ("pressure_drop",)
    axes: ClassVar = {"filtrate_volume": Volume, "time_per_filtrate_volume": TimePerVolume}

    def fit(self) -> Fit:
        """Resistance, compressibility and medium with 95 % intervals."""
        self.increasing("time", strictly=False)
        self.increasing("filtrate_volume", strictly=False)
        t, V, dp = (np.asarray(x, dtype=float) for x in (self.time, self.filtrate_volume, self.pressure_drop))
        grown = np.diff(V) > 0
        slow = np.diff(t)[grown] / np.diff(V)[grown]
        middle = (0.5 * (V[1:] + V[:-1]))[grown]
        low, high = (pick(dp[1:], dp[:-1])[grown] for pick in (np.minimum, np.maximum))
        p = 0.5 * (low + high)
        steady = high < SAME_STEP * low
        if steady.sum() < LEAST_INTERVALS:
            raise InputError(
                _("The test needs at least {least} intervals at steady pressure.").format(
                    least=LEAST_INTERVALS
                )
            )
        if p[steady].max() < LEAST_RATIO * p[steady].min():
            raise InputError(
                _("The pressure hardly changes: fit it as a leaf test at constant pressure."),
                name="pressure_drop",
            )
        first = np.cumprod(p < SAME_STEP * p[0]).astype(bool)
        skip = bad_start(middle[first], (slow * p)[first])
        keep = steady & (np.arange(len(p)) >= skip)
        flags = []
        if skip:
            flags.append(
                self.note(
                    "points excluded",
                    _("First points left out: {count}.").format(count=skip),
                    "filtrate_volume",
                )
            )
        per_cake, per_medium = (
            self.dynamic_viscosity * self.dry_cake_per_filtrate / self.area**2,
            self.dynamic_viscosity / self.area,
        )
        p0 = self.reference_pressure

        def model(q: dict[str, Any], volume: Any) -> Any:
            now = jnp.interp(volume, middle, p)
            cake = q["cake_resistance_reference"] * (now / p0) ** q["compressibility"] * per_cake * volume
            return (cake + q["medium_resistance"] * per_medium) / now

        slope, intercept = straight_line(middle[keep], (slow * p)[keep])
        start = {
            "cake_resistance_reference": abs(slope) / per_cake,
            "compressibility": 0.3,
            "medium_resistance": max(intercept, 0.01 * float(np.mean(slow * p))) / per_medium,
        }
        bounds = {
            "cake_resistance_reference": (0.0, np.inf),
            "compressibility": (0.0, 2.0),
            "medium_resistance": (0.0, np.inf),
        }
        return self.fitted(
            model, start, middle, slow, index=1 + np.flatnonzero(grown), keep=keep, flags=flags, bounds=bounds
        )
