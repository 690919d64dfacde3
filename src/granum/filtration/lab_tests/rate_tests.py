"""Tests at constant rate, and with a pressure that changes in any way (steps, ramps, a pump on its curve)."""

from __future__ import annotations

from typing import Annotated, Any, ClassVar

import numpy as np

from granum.core import lab_test
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
    VolumeFlow,
)
from granum.core.parameters import Parameter
from granum.core.units import format_number
from granum.estimation import Fit, LabTest
from granum.estimation.lines import straight_line
from granum.filtration.kinds import PressureTimePerVolume
from granum.filtration.lab_tests.starts import bad_start, bend

NOTICEABLE_BEND = 0.3
UNCERTAIN, LEAST_MEDIUM = (
    0.05,
    0.2,
    # of an estimate, by what readings leave open of the pressure; part of the line that a medium must be to count  # noqa: E501
)
READING = 0.03  # change of the pressure below which it may be the scatter of the gauge


@lab_test(
    "constant_rate_test",
    source="carman1938; tiller1955",
    title="Filtration test at constant rate",
    equation=r"\Delta p = \frac{\eta\,\alpha\,W\,q^2}{\Omega^2}t + \frac{\eta\,R_s\,q}{\Omega}",
)
class ConstantRateTest(LabTest):
    """Cake and medium resistance from the rise of pressure at constant filtrate flow.

    First points of a rigid cake that do not lie on its line are left out, and said so. With ``compressible``
    the mean resistance is a power of the pressure drop across the cake, and its exponent is fitted too.
    """

    time: Annotated[Time, Series("points")]
    pressure_drop: Annotated[PressureDrop, Series("points")]
    filtrate_flow: VolumeFlow
    area: Area
    dynamic_viscosity: DynamicViscosity
    dry_cake_per_filtrate: Concentration
    compressible: bool = False
    reference_pressure: PressureDrop = 1e5

    for_two_points: ClassVar = "filtration.resistances_two_pressures"
    estimates: ClassVar = {
        "cake_resistance": CakeResistance,
        "cake_resistance_reference": CakeResistance,
        "compressibility": Ratio,
        "medium_resistance": MediumResistance,
    }
    holds_for: ClassVar = ("pressure_drop",)
    axes: ClassVar = {"time": Time, "pressure_drop": PressureDrop}

    def fit(self) -> Fit:
        """Resistances with 95 % intervals."""
        self.increasing("time")
        t, dp = np.asarray(self.time), np.asarray(self.pressure_drop)
        u = self.filtrate_flow / self.area
        per_cake, per_medium = (
            self.dynamic_viscosity * self.dry_cake_per_filtrate * u**2,
            self.dynamic_viscosity * u,
        )
        if self.compressible:
            p0 = self.reference_pressure

            def soft(p: dict[str, Any], t: Any) -> Any:
                n = p["compressibility"]
                return (p["cake_resistance_reference"] * per_cake * t / p0**n) ** (1.0 / (1.0 - n)) + p[
                    "medium_resistance"
                ] * per_medium

            start = {
                "cake_resistance_reference": dp[-1] / (per_cake * t[-1]) * (p0 / dp[-1]) ** 0.3,
                "compressibility": 0.3,
                "medium_resistance": 0.3 * dp[0] / per_medium,
            }
            bounds = {
                "cake_resistance_reference": (0.0, np.inf),
                "compressibility": (0.0, 0.95),
                "medium_resistance": (0.0, np.inf),
            }
            return self.fitted(soft, start, np.maximum(t, 1e-9 * t[-1]), dp, bounds=bounds)
        skip = bad_start(t, dp)
        kept = np.arange(len(t)) >= skip
        flags = (
            [self.note("points excluded", _("First points left out: {count}.").format(count=skip), "time")]
            if skip
            else []
        )
        slope, intercept = straight_line(t[kept], dp[kept])
        if abs(bend(t[kept], dp[kept])) > NOTICEABLE_BEND:
            sentence = _(
                "The pressure does not rise along a straight line: the cake is compressible; fit it "
                "with compressible = yes."
            )
            flags.append(self.note("bent line", sentence, "pressure_drop"))
        start = {
            "cake_resistance": abs(slope) / per_cake,
            "medium_resistance": max(intercept, 0.01 * dp.mean()) / per_medium,
        }
        return self.fitted(
            lambda p, t: p["cake_resistance"] * per_cake * t + p["medium_resistance"] * per_medium,
            start,
            t,
            dp,
            keep=kept,
            flags=flags,
            bounds={"cake_resistance": (0.0, np.inf), "medium_resistance": (0.0, np.inf)},
        )


@lab_test(
    "variable_pressure_test",
    source="ruth1935",
    title="Filtration test with changing pressure",
    equation=(
        r"\frac1V\int_0^t \Delta p\,dt = \frac{\eta\,\alpha\,W}{2\,\Omega^2}V + " r"\frac{\eta\,R_s}{\Omega}"
    ),
)
class VariablePressureTest(LabTest):
    """Cake and medium resistance of a rigid cake from volume and pressure readings, whatever the course of
    the pressure.

    Darcy's law integrates exactly to a straight line of the pressure impulse per volume against volume; the
    impulse is taken by trapezoids between readings, so give one just before and one just after each step. A
    cake that resists more at higher pressure bends the line up, which is flagged.
    """

    time: Annotated[Time, Series("points")]
    filtrate_volume: Annotated[Volume, Series("points")]
    pressure_drop: Annotated[PressureDrop, Series("points")]
    area: Area
    dynamic_viscosity: DynamicViscosity
    dry_cake_per_filtrate: Concentration

    estimates: ClassVar = {"cake_resistance": CakeResistance, "medium_resistance": MediumResistance}
    holds_for: ClassVar = ("pressure_drop",)
    axes: ClassVar = {"filtrate_volume": Volume, "impulse_per_volume": PressureTimePerVolume}

    def fit(self) -> Fit:
        """Resistances with 95 % intervals."""
        self.increasing("time")
        self.increasing("filtrate_volume", strictly=False)
        t, V, dp = (np.asarray(x, dtype=float) for x in (self.time, self.filtrate_volume, self.pressure_drop))
        impulse = dp[0] * t[0] + np.concatenate([[0.0], np.cumsum(0.5 * np.diff(t) * (dp[1:] + dp[:-1]))])
        good = (V > 0) & (t > 0)
        V, ratio = V[good], impulse[good] / V[good]
        skip = bad_start(V, ratio)
        kept = np.arange(len(V)) >= skip
        flags = (
            [
                self.note(
                    "points excluded",
                    _("First points left out: {count}.").format(count=skip),
                    "filtrate_volume",
                )
            ]
            if skip
            else []
        )
        if bend(V[kept], ratio[kept]) > NOTICEABLE_BEND:
            sentence = _(
                "The line bends up: the cake resists more at higher pressure; test it at several "
                "constant pressures."
            )
            flags.append(self.note("bent line", sentence, "impulse_per_volume"))
        per_cake = self.dynamic_viscosity * self.dry_cake_per_filtrate / (2.0 * self.area**2)
        per_medium = self.dynamic_viscosity / self.area
        slope, intercept = straight_line(V[kept], ratio[kept])
        missed = _missed(t, dp)[:, good][:, kept] / V[kept]
        for name, size, weights in zip(
            ("cake_resistance", "medium_resistance"), (slope, intercept), _weights(V[kept]), strict=True
        ):
            doubt = float(np.linalg.norm(missed @ weights))
            if doubt > UNCERTAIN * max(
                abs(size), LEAST_MEDIUM * ratio.mean() if name == "medium_resistance" else 0.0
            ):
                sentence = _(
                    "The pressure changes between readings in a way that they do not show: this alone "
                    "leaves ± {share} % in {label}. "
                    "Take a reading just before and just after each change."
                ).format(
                    share=format_number(100.0 * doubt / max(abs(size), 1e-300), 2),
                    label=Parameter(name).label,
                )
                flags.append(self.note("coarse pressure", sentence, name))
        return self.fitted(
            lambda p, V: p["cake_resistance"] * per_cake * V + p["medium_resistance"] * per_medium,
            {
                "cake_resistance": abs(slope) / per_cake,
                "medium_resistance": max(intercept, 0.01 * ratio.mean()) / per_medium,
            },
            V,
            ratio,
            index=np.flatnonzero(good),
            keep=kept,
            flags=flags,
            bounds={"cake_resistance": (0.0, np.inf), "medium_resistance": (0.0, np.inf)},
        )


def _missed(t: np.ndarray, dp: np.ndarray) -> np.ndarray:
    """What trapezoids may miss of the impulse at each reading, one row an interval: nothing on a steady
    course or a ramp, all of a jump.
    """
    width, rise = np.diff(t), np.diff(dp)
    slope = np.pad(rise / width, 1)
    own = slope[1:-1]
    alike = [
        np.clip(
            np.divide(
                np.minimum(own * beside, own**2),
                np.maximum(own**2, beside**2),
                where=own != 0,
                out=np.zeros_like(own),
            ),
            0,
            1,
        )
        for beside in (slope[:-2], slope[2:])
    ]
    seen = np.abs(rise) > READING * 0.5 * (dp[1:] + dp[:-1])
    open_part = np.where(seen, 0.5 * width * np.abs(rise) * (1.0 - np.maximum(*alike)) ** 2, 0.0)
    return np.triu(np.repeat(open_part[:, None], len(t), axis=1), 1)


def _weights(x: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """What each value has to say in the slope and in the intercept of a straight line."""
    slope = (x - x.mean()) / float(np.sum((x - x.mean()) ** 2))
    return slope, 1.0 / x.size - x.mean() * slope
