"""Compressibility of a cake from tests at several pressures: fitted together, or from resistances already
known.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Any, ClassVar

import jax.numpy as jnp
import numpy as np

from granum.core import lab_test
from granum.core.errors import InputError
from granum.core.i18n import _, quoted
from granum.core.kinds import (
    Area,
    CakeResistance,
    Concentration,
    DynamicViscosity,
    MediumResistance,
    Number,
    PressureDrop,
    Series,
    Time,
    VoidFraction,
    Volume,
)
from granum.core.units import format_number
from granum.estimation import Fit, LabTest
from granum.estimation.lines import straight_line
from granum.filtration.kinds import OVER_COMPRESSIBLE
from granum.filtration.lab_tests.starts import bad_start

if TYPE_CHECKING:
    import plotly.graph_objects as go

SAME_PRESSURE = 1.005


@lab_test(
    "compressibility",
    source="mccabe2005, ch. 29; tiller1953",
    title="Compressibility of a cake from several pressures",
    equation=(
        r"\bar\alpha = \alpha_0\left(\frac{\Delta p}{p_0}\right)^n,\qquad 1 - \varepsilon = (1 - "
        r"\varepsilon_0)\left(\frac{\Delta p}{p_0}\right)^\beta"
    ),
)
class Compressibility(LabTest):
    """Compressibility exponent and reference resistance of a cake, with their joint confidence, from tests at
    several pressures.

    The file has either a column of specific resistances beside that of pressures, or the raw readings of all
    tests one under the other (``pressure_drop, time, filtrate_volume``), which are then fitted together, each
    test with its own medium resistance and its bad first points left out. A column ``void_fraction`` adds the
    compaction law. ``with_threshold`` keeps the resistance constant below a pressure that is fitted too.
    """

    pressure_drop: Annotated[PressureDrop, Series("points")]
    cake_resistance: Annotated[CakeResistance, Series("points")] | None = None
    time: Annotated[Time, Series("points")] | None = None
    filtrate_volume: Annotated[Volume, Series("points")] | None = None
    void_fraction: Annotated[VoidFraction, Series("points")] | None = None
    area: Area | None = None
    dynamic_viscosity: DynamicViscosity | None = None
    dry_cake_per_filtrate: Concentration | None = None
    reference_pressure: PressureDrop = 1e5
    with_threshold: bool = False

    estimates: ClassVar = {
        "cake_resistance_reference": CakeResistance,
        "compressibility": Number,
        "threshold_pressure": PressureDrop,
        "void_fraction_reference": VoidFraction,
        "compaction_exponent": Number,
    }
    for_two_points: ClassVar = "filtration.compressibility_two_resistances"
    holds_for: ClassVar = ("pressure_drop",)
    axes: ClassVar = {"pressure_drop": PressureDrop, "cake_resistance": CakeResistance}

    def fit(self) -> Fit:
        """Reference resistance and exponent with 95 % intervals; medium resistances where raw readings are
        given.
        """
        self.above_zero("pressure_drop", *(("cake_resistance",) if self.cake_resistance is not None else ()))
        if self.cake_resistance is not None:
            return self._from_resistances()
        if self.time is None or self.filtrate_volume is None:
            raise InputError(
                _("The file needs a column 'cake_resistance', or the columns 'time' and 'filtrate_volume'.")
            )
        missing = [
            n for n in ("area", "dynamic_viscosity", "dry_cake_per_filtrate") if getattr(self, n) is None
        ]
        if missing:
            raise InputError(
                _("Raw readings also need {names}.").format(names=", ".join(quoted(n) for n in missing)),
                missing=missing,
            )
        return self._from_readings()

    def _law(self, p: dict[str, Any], pressure: Any) -> Any:
        """ln of the mean specific resistance at a pressure."""
        if self.with_threshold:
            knee = p["threshold_pressure"]
            return jnp.log(p["cake_resistance_reference"]) + p["compressibility"] * jnp.log(
                jnp.maximum(pressure / knee, 1.0)
            )
        return jnp.log(p["cake_resistance_reference"]) + p["compressibility"] * jnp.log(
            pressure / self.reference_pressure
        )

    def _start(self, pressures: np.ndarray, resistances: np.ndarray) -> dict[str, float]:
        logs = np.log(pressures / self.reference_pressure)
        if np.ptp(logs) < 0.05:
            raise InputError(
                _("Compressibility needs tests at different pressures; these are all at {value} bar.").format(
                    value=format_number(float(pressures[0]) / 1e5)
                )
            )
        n, level = straight_line(logs, np.log(resistances))
        if not self.with_threshold:
            return {"cake_resistance_reference": float(np.exp(level)), "compressibility": float(n) or 0.1}
        order = np.argsort(pressures)
        return {
            "cake_resistance_reference": float(resistances[order][0]),
            "compressibility": max(float(n), 0.1),
            "threshold_pressure": float(np.sqrt(pressures[order][0] * pressures[order][-1])),
        }

    def _options(self, pressures: np.ndarray) -> dict[str, Any]:
        bounds = {"cake_resistance_reference": (0.0, np.inf), "medium_resistance": (0.0, np.inf)}
        if self.with_threshold:
            bounds["threshold_pressure"] = (float(pressures.min()), float(pressures.max()))

        def coefficient(p: dict[str, Any]) -> dict[str, Any]:
            base = p["threshold_pressure"] if self.with_threshold else self.reference_pressure
            return {
                "cake_resistance_unit_pressure": p["cake_resistance_reference"]
                * base ** -p["compressibility"]
            }

        return {
            "bounds": bounds,
            "derived": coefficient,
            "kinds": {"cake_resistance_unit_pressure": CakeResistance},
        }

    def _from_resistances(self) -> Fit:
        pressures, resistances = np.asarray(self.pressure_drop), np.asarray(self.cake_resistance)
        start, options = self._start(pressures, resistances), self._options(pressures)
        if self.void_fraction is None:
            found = self.fitted(
                lambda p, x: self._law(p, x), start, pressures, np.log(resistances), **options
            )
        else:
            solid = 1.0 - np.asarray(self.void_fraction)
            slope, level = straight_line(np.log(pressures / self.reference_pressure), np.log(solid))
            start |= {
                "void_fraction_reference": float(1.0 - np.exp(level)),
                "compaction_exponent": float(slope) or 0.01,
            }

            def both(p: dict[str, Any], x: Any) -> Any:
                level = jnp.log1p(-p["void_fraction_reference"])
                return self._law(p, x), level + p["compaction_exponent"] * jnp.log(
                    x / self.reference_pressure
                )

            found = self.fitted(
                both, start, pressures, (np.log(resistances), np.log(solid)), apart=True, **options
            )
        return self._judged(found)

    def _tests(self) -> list[tuple[float, np.ndarray, np.ndarray, np.ndarray]]:
        """Pressure, volumes, t/V and rows of each test, without the origin and bad first points."""
        pressure, t, V = (np.asarray(x) for x in (self.pressure_drop, self.time, self.filtrate_volume))
        assert self.area is not None
        tests, first = [], 0
        for i in range(1, len(pressure) + 1):
            if i < len(pressure) and max(pressure[i], pressure[first]) < SAME_PRESSURE * min(
                pressure[i], pressure[first]
            ):
                continue
            rows = slice(first, i)
            good = (t[rows] > 0) & (V[rows] > 0)
            u, v = V[rows][good], t[rows][good]
            if len(u) < 3 or np.any(np.diff(v) <= 0) or np.any(np.diff(u) < 0):
                raise InputError(
                    _(
                        "The test at {value} bar needs at least 3 readings with rising time and volume."
                    ).format(value=format_number(float(pressure[first]) / 1e5))
                )
            skip = bad_start(u, v / u)
            tests.append(
                (
                    float(np.mean(pressure[rows])),
                    u[skip:],
                    (v / u)[skip:],
                    first + np.flatnonzero(good)[skip:],
                )
            )
            first = i
        return tests

    def _singles(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Pressure, cake and medium resistance of each test by itself."""
        assert self.area is not None
        assert self.dynamic_viscosity is not None
        assert self.dry_cake_per_filtrate is not None
        rows = []
        for pressure, V, ratio, _rows in self._tests():
            slope, intercept = straight_line(V, ratio)
            cake = (
                slope * 2.0 * pressure * self.area**2 / (self.dynamic_viscosity * self.dry_cake_per_filtrate)
            )
            rows.append((pressure, cake, intercept * pressure * self.area / self.dynamic_viscosity))
        pressures, cakes, media = np.array(rows).T
        if np.any(cakes <= 0):
            raise InputError(_("In one of the tests t/V does not rise with V: it shows no cake resistance."))
        return pressures, cakes, media

    def _from_readings(self) -> Fit:
        pressures, cakes, media = self._singles()
        eta, W, A = (
            float(x) for x in (self.dynamic_viscosity, self.dry_cake_per_filtrate, self.area) if x is not None
        )
        tests, options = self._tests(), self._options(pressures)
        names = [f"medium_resistance_{i + 1}" for i in range(len(tests))]
        start = self._start(pressures, cakes) | {
            n: max(float(m), 1e-3 * float(np.max(np.abs(media)))) for n, m in zip(names, media, strict=True)
        }

        def model(p: dict[str, Any], volumes: Any) -> Any:
            return tuple(
                eta / (pressure * A) * (jnp.exp(self._law(p, pressure)) * W * V / (2.0 * A) + p[name])
                for (pressure, *_rest), V, name in zip(tests, volumes, names, strict=True)
            )

        # readings of slow and fast tests count alike: their scatter is taken proportional to the mean of t/V
        sigma = tuple(float(np.mean(ratio)) for _p, _V, ratio, _rows in tests)
        bounds = {**options.pop("bounds"), **dict.fromkeys(names, (0.0, np.inf))}
        kinds = {**options.pop("kinds"), **dict.fromkeys(names, MediumResistance)}
        given = sum((np.asarray(self.time) > 0) & (np.asarray(self.filtrate_volume) > 0))
        left_out = int(given) - sum(len(V) for _p, V, *_rest in tests)
        flags = (
            [
                self.note(
                    "points excluded",
                    _("First points left out: {count}.").format(count=left_out),
                    "filtrate_volume",
                )
            ]
            if left_out
            else []
        )
        volumes, ratios, rows = (tuple(test[i] for test in tests) for i in (1, 2, 3))
        found = self.fitted(
            model,
            start,
            volumes,
            ratios,
            index=np.concatenate(rows),
            sigma=sigma,
            bounds=bounds,
            kinds=kinds,
            flags=flags,
            **options,
        )
        return self._judged(found)

    def _judged(self, found: Fit) -> Fit:
        if found["compressibility"].value > 1.0:
            sentence = _(OVER_COMPRESSIBLE)
            found.flags.append(self.note("unusual value", sentence, "compressibility"))
        return found

    def chart(self) -> go.Figure:
        """Resistance against pressure on logarithmic axes, with the law and its 95 % band."""
        from granum.core.charts import add_band, add_line, add_points, axis_title, figure

        pressures, cakes = (
            (np.asarray(self.pressure_drop), np.asarray(self.cake_resistance))
            if self.cake_resistance is not None
            else self._singles()[:2]
        )
        found = self.fit()
        grid = np.geomspace(0.8 * pressures.min(), 1.25 * pressures.max(), 60)
        logs = found.derive(lambda p: {str(i): self._law(p, x) for i, x in enumerate(grid)})
        value, low, high = (
            np.exp([pick(logs[str(i)]) for i in range(len(grid))])
            for pick in (lambda e: e.value, lambda e: e.interval_95[0], lambda e: e.interval_95[1])
        )
        drawing = figure(
            axis_title("pressure_drop", "bar"),
            axis_title("cake_resistance", "m/kg"),
            title=type(self).card.title,
            x_log=True,
            y_log=True,
        )
        add_band(drawing, grid / 1e5, low, high, _("95 % band"))
        add_line(drawing, grid / 1e5, value, _("model"))
        add_points(drawing, pressures / 1e5, cakes, _("data"))
        return drawing
