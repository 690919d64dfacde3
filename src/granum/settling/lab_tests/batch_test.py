"""Batch settling test: one curve h(t) gives the settling velocity, the flux curve, a velocity law and the
compression point.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Annotated, Any, ClassVar, Literal, NamedTuple

import equinox as eqx
import jax.numpy as jnp
import numpy as np

from granum.core import lab_test
from granum.core.errors import ConvergenceError, InputError
from granum.core.i18n import _
from granum.core.kinds import (
    KINDS,
    Concentration,
    Distance,
    Length,
    MassFlux,
    PositiveNumber,
    Series,
    Speed,
    Time,
    VolumePerMass,
)
from granum.core.units import format_number, show
from granum.estimation import Estimate, Fit, LabTest
from granum.estimation.results import t_reach
from granum.settling.flux import limiting_flux_underflow
from granum.settling.kinds import UnitArea
from granum.settling.kynch import kynch_height
from granum.settling.lab_tests.curve import Curve, Tangents, convex_curve, read_curve
from granum.settling.velocities import Cole, RichardsonZakiConcentration, Takacs, Vesilind

RESAMPLES = 200
# scatter, in reading errors, of points left out beyond which a new fit with them need not be tried
FAR = 20.0
# scatter, in reading errors, up to which a velocity law alone accounts for points taken for compression
EXPLAINED = 2.0
LOWEST, NARROWEST = 0.3, 100.0  # m of a cylinder, and its diameter over that of a particle: the course


class FluxCurve(NamedTuple):
    """Settling velocity and flux against concentration by Kynch's tangents, with 95 % limits of the
    velocity.
    """

    solids_concentration: Annotated[Concentration, Series("points")]
    settling_velocity: Annotated[Speed, Series("points")]
    settling_velocity_lower: Annotated[Speed, Series("points")]
    settling_velocity_upper: Annotated[Speed, Series("points")]
    solids_flux: Annotated[MassFlux, Series("points")]


class _Function(NamedTuple):
    """How one velocity law is fitted: its form, first values, bounds, and where its flux turns convex."""

    build: Any
    start: Any
    bounds: Mapping[str, tuple[float, float]]
    inflection: Any
    densest: Any


def _line(x: np.ndarray, y: np.ndarray) -> tuple[float, float]:
    slope, level = np.polyfit(x, y, 1) if np.ptp(x) > 0 else (-1.0, float(y[0] + x[0]))
    return float(slope), float(level)


def _start_exponential(C: np.ndarray, v: np.ndarray, names: tuple[str, str]) -> dict[str, float]:
    slope, _level = _line(C, np.log(v))
    k = max(-slope, 0.3 / C[0])
    return {names[0]: float(np.exp(np.log(v[0]) + k * C[0])), names[1]: k}


def _start_power(C: np.ndarray, v: np.ndarray) -> dict[str, float]:
    n = max(-_line(np.log(C), np.log(v))[0], 1.2)
    return {"reference_velocity": float(v[0] * C[0] ** n), "settling_exponent": n}


def _start_packed(C: np.ndarray, v: np.ndarray) -> dict[str, float]:
    packed = 1.3 * float(C.max())
    n = min(max(_line(np.log(1 - C / packed), np.log(v))[0], 1.5), 12.0)
    return {
        "unhindered_velocity": float(v[0] / (1 - C[0] / packed) ** n),
        "settling_exponent": n,
        "packed_concentration": packed,
    }


_ABOVE = {"vesilind_velocity": (0.0, np.inf), "vesilind_coefficient": (0.0, np.inf)}
FUNCTIONS = {
    "vesilind": _Function(
        lambda p: Vesilind(**p),
        lambda C, v: _start_exponential(C, v, ("vesilind_velocity", "vesilind_coefficient")),
        _ABOVE,
        lambda p: 2.0 / p["vesilind_coefficient"],
        lambda p, C0: C0 + 80.0 / p["vesilind_coefficient"],
    ),
    # The flocculant term and the cap act below the concentrations of zone settling: they stay at the
    # benchmark's values.
    "takacs": _Function(
        lambda p: Takacs(**p, takacs_velocity_maximum=1.0),
        lambda C, v: _start_exponential(C, v, ("takacs_velocity", "takacs_hindered_coefficient")),
        {"takacs_velocity": (0.0, np.inf), "takacs_hindered_coefficient": (0.0, 2.8)},
        lambda p: 2.0 / p["takacs_hindered_coefficient"],
        lambda p, C0: C0 + 80.0 / p["takacs_hindered_coefficient"],
    ),
    "cole": _Function(
        lambda p: Cole(**p, settling_velocity_maximum=1e3),
        _start_power,
        {"reference_velocity": (0.0, np.inf), "settling_exponent": (1.0001, 20.0)},
        lambda p: 0.0,
        lambda p, C0: 1e6 * C0,
    ),
    "richardson_zaki": _Function(
        lambda p: RichardsonZakiConcentration(**p),
        _start_packed,
        {
            "unhindered_velocity": (0.0, np.inf),
            "settling_exponent": (1.0001, 30.0),
            "packed_concentration": (0.0, np.inf),
        },
        lambda p: 2.0 * p["packed_concentration"] / (p["settling_exponent"] + 1.0),
        lambda p, C0: p["packed_concentration"] * (1.0 - 1e-9),
    ),
}


VelocityFunction = Literal["vesilind", "richardson_zaki", "takacs", "cole"]


class _Height(eqx.Module):
    """The curve of a velocity law; a module with its numbers as arrays, so that it is compiled once for all
    tests of one length.
    """

    law: str = eqx.field(static=True)
    initial_concentration: Any
    initial_height: Any

    def __call__(self, p: Mapping[str, Any], t: Any) -> Any:
        function, C0 = FUNCTIONS[self.law], self.initial_concentration
        return kynch_height(
            t, function.build(p), C0, self.initial_height, function.inflection(p), function.densest(p, C0)
        )


class _UnitArea(eqx.Module):
    """Coe and Clevenger's unit area from a velocity law."""

    law: str = eqx.field(static=True)
    initial_concentration: Any
    underflow_concentration: Any

    def __call__(self, p: Mapping[str, Any]) -> dict[str, Any]:
        limit = limiting_flux_underflow(
            self.underflow_concentration, self.initial_concentration, FUNCTIONS[self.law].build(p)
        )
        return {"unit_area_coe_clevenger": 1.0 / limit.limiting_flux}


def _scatter(found: Fit, points: np.ndarray) -> float:
    return float(np.sqrt(np.mean(found.residuals[points] ** 2)))


@lab_test("batch_test", source="kynch1952; talmage1955; roberts1949", title="Batch settling test")
class BatchTest(LabTest):
    """Settling curve: height of the interface against time, in a cylinder of uniform initial
    concentration.

    Zones are found without a hand: induction (left out), constant rate (AB), falling rate (BC) and
    compression (CD, Roberts' two exponentials, where the velocity law alone does not account for the later
    points too). The chosen velocity law is fitted to the curve itself, by Kynch's closed solution, up to the
    compression point. With an underflow the unit area comes both ways: from the law (Coe and Clevenger's
    greatest) and from the curve (Talmage and Fitch). ``flux_curve`` gives the tangent construction with a
    band. One curve knows its law only from the initial concentration to that at the compression point. A
    cylinder lower than 30 cm, or narrower than a hundred particles where both diameters are given, is told.
    """

    time: Annotated[Time, Series("points")]
    interface_height: Annotated[Distance, Series("points")]
    initial_concentration: Concentration
    initial_height: Length | None = None
    underflow_concentration: Concentration | None = None
    velocity_function: VelocityFunction = "vesilind"
    cylinder_diameter: Length | None = None
    particle_diameter: Length | None = None

    estimates: ClassVar = {
        "vesilind_velocity": Speed,
        "vesilind_coefficient": VolumePerMass,
        "takacs_velocity": Speed,
        "takacs_hindered_coefficient": VolumePerMass,
        "reference_velocity": Speed,
        "settling_exponent": PositiveNumber,
        "unhindered_velocity": Speed,
        "packed_concentration": Concentration,
        "unit_area_coe_clevenger": UnitArea,
    }
    axes: ClassVar = {"time": Time, "interface_height": Distance}
    least_points: ClassVar = 5

    def __check_init__(self) -> None:
        if not self.initial_concentration > 0:
            raise InputError(
                _(
                    "The initial concentration must be greater than zero: it turns heights into "
                    "concentrations."
                )
            )

    def curve(self) -> Curve:
        """The cleaned curve with its zones by shape alone; ``zones`` asks the velocity law whether there is
        compression.
        """
        return read_curve(self.time, self.interface_height, self.initial_height)

    def zones(self) -> Curve:
        """The cleaned curve with its zones; compression only where the velocity law does not account for the
        later points.
        """
        c = self.curve()
        return c if c.compression is None else self._zones_and_law()[0]

    def tangents(self, curve: Curve | None = None) -> tuple[np.ndarray, np.ndarray]:
        """Concentrations and settling velocities by Kynch's tangents, from the constant rate on."""
        c = curve or self.curve()
        found = c.convex.tangents
        late = found.time > c.constant_rate_end
        C = self.initial_concentration * c.initial_height / found.intercept_height[late]
        start = np.array([float(self.initial_concentration)]), np.array([c.constant_rate.velocity])
        denser = self.initial_concentration < C
        return np.concatenate([start[0], C[denser]]), np.concatenate(
            [start[1], found.settling_velocity[late][denser]]
        )

    def flux_curve(self, seed: int = 0) -> FluxCurve:
        """Kynch's flux curve with a 95 % band, from curves with their residuals drawn anew."""
        c = self.curve()
        C, v = self.tangents(c)
        drawn = []
        for found in self._redrawn(c, seed):
            at = self.initial_concentration * c.initial_height / found.intercept_height
            drawn.append(np.exp(np.interp(C, at, np.log(found.settling_velocity))))
        low, high = np.quantile(drawn, [0.025, 0.975], axis=0)
        return FluxCurve(C, v, np.minimum(low, v), np.maximum(high, v), C * v)

    @staticmethod
    def _redrawn(c: Curve, seed: int = 0) -> list[Tangents]:
        """Tangents of curves with their residuals drawn anew."""
        rng = np.random.default_rng(seed)
        residual = rng.choice([-1.0, 1.0], (RESAMPLES, c.time.size)) * np.maximum(
            np.abs(c.height - c.convex.height), 0.3 * c.noise
        )
        return [convex_curve(c.time, c.convex.height + shift).tangents for shift in residual]

    def fit(self) -> Fit:
        """Parameters of the velocity law; zones, compression point and unit areas as derived quantities."""
        c, found = self._zones_and_law()
        flags = [self.note(word, sentence) for word, sentence in c.said]
        if c.compression is None:
            flags.append(
                self.note(
                    "no compression point",
                    _("The curve shows no separate compression zone: all points were fitted."),
                )
            )
        else:
            flags.append(
                self.note(
                    "compression left out",
                    _("Points after the compression point are outside Kynch's theory: not fitted."),
                )
            )
        if (miss := found.statistics["rmse"]) > EXPLAINED * c.noise:
            flags.append(
                self.note(
                    "law misses the curve",
                    _(
                        "The velocity law misses the fitted points by {miss} mm (root mean square), "
                        "more than the reading error: its "
                        "zones and unit area are doubtful. Try another velocity_function."
                    ).format(miss=format_number(1e3 * miss)),
                )
            )
        flags += self._cylinder(float(c.initial_height))
        derived = {**found.derived, **self._derived(c)}
        return replace(found, derived=derived, flags=flags + found.flags + self._disagreement(derived))

    def _cylinder(self, height: float) -> list[dict[str, Any]]:
        """What is told of a cylinder that is too low, or too narrow for its particles."""
        told, wide, grain = [], self.cylinder_diameter, self.particle_diameter
        if height < LOWEST * (1.0 - 1e-6):
            told.append(
                self.note(
                    "low cylinder",
                    _(
                        "The cylinder stands {height} high: below some 30 cm sludge settles "
                        "otherwise than in a tank."
                    ).format(height=show(height, KINDS["Length"])),
                )
            )
        if wide is not None and grain is not None and wide < NARROWEST * grain:
            told.append(
                self.note(
                    "narrow cylinder",
                    _(
                        "The cylinder is {ratio} times as wide as its particles: below a hundred the wall "
                        "holds them up."
                    ).format(ratio=format_number(float(wide) / float(grain), 3)),
                )
            )
        return told

    def _zones_and_law(self) -> tuple[Curve, Fit]:
        """Two exponentials follow any falling-rate curve better than one: the law fitted to all points
        decides on compression.
        """
        c = self.curve()
        found = self._law(c)
        if c.compression is None or _scatter(found, ~found.kept) > FAR * c.noise:
            return c, found
        alone = replace(c, compression=None)
        try:
            whole = self._law(alone, found.values)
        except ConvergenceError:
            return c, found
        return (alone, whole) if _scatter(whole, ~found.kept) <= EXPLAINED * c.noise else (c, found)

    def _law(self, c: Curve, start: Mapping[str, float] | None = None) -> Fit:
        """The velocity law fitted to the curve up to its compression point."""
        function, under = FUNCTIONS[self.velocity_function], self.underflow_concentration
        C, v = self.tangents(c)
        last = c.time.size if c.compression is None else c.compression.index + 1
        usable = C[0] * 1.0001 >= C if last == c.constant_rate.points else self._densest(c) >= C
        C0 = float(self.initial_concentration)
        bounds = dict(function.bounds)
        if "packed_concentration" in bounds:
            bounds["packed_concentration"] = (1.02 * C0, np.inf)
        return self.fitted(
            _Height(self.velocity_function, jnp.asarray(C0), jnp.asarray(c.initial_height)),
            start or function.start(C[usable], v[usable]),
            c.time,
            c.height,
            keep=np.arange(c.time.size) < last,
            bounds=bounds,
            derived=_UnitArea(self.velocity_function, jnp.asarray(C0), jnp.asarray(float(under)))
            if under is not None
            else None,
        )

    def _disagreement(self, derived: Mapping[str, Estimate]) -> list[dict[str, Any]]:
        """A word where the two unit areas lie farther apart than their intervals reach."""
        if self.underflow_concentration is None:
            return []
        law, curve = derived["unit_area_coe_clevenger"], derived["unit_area_talmage_fitch"]
        apart = max(law.interval_95[0] - curve.interval_95[1], curve.interval_95[0] - law.interval_95[1])
        if apart <= 0:
            return []
        return [
            self.note(
                "unit areas disagree",
                _(
                    "The velocity law asks for {law} m²·s/kg, the tangent to the curve (Talmage and "
                    "Fitch) for {curve}: they differ by more "
                    "than their intervals. Size by the greater one, or test at a concentration nearer "
                    "to the underflow."
                ).format(law=format_number(law.value), curve=format_number(curve.value)),
                "unit_area_talmage_fitch",
            )
        ]

    def _densest(self, c: Curve) -> float:
        """Greatest concentration at the interface before compression."""
        if c.compression is None:
            return np.inf
        late = c.convex.tangents.time <= c.compression.time
        cut = c.convex.tangents.intercept_height[late]
        return (
            float(self.initial_concentration)
            * c.initial_height
            / (float(cut.min()) if cut.size else c.initial_height)
        )

    def _derived(self, c: Curve) -> dict[str, Estimate]:
        line, mass = c.constant_rate, float(self.initial_concentration) * c.initial_height
        reach = t_reach(0.95, max(line.points - 2, 1)) * line.standard_error
        found = {
            "settling_velocity": Estimate(
                line.velocity, "m/s", line.standard_error, (line.velocity - reach, line.velocity + reach)
            ),
            "induction_time": Estimate(c.induction_time, "s"),
            "constant_rate_time": Estimate(c.constant_rate_end + c.induction_time, "s"),
        }
        if c.compression is not None:
            at = c.compression
            found |= {
                "compression_time": Estimate(at.time + c.induction_time, "s"),
                "compression_height": Estimate(at.height, "m"),
                "compression_concentration": Estimate(self._densest(c), "kg/m^3"),
                "final_height": Estimate(at.final_height, "m"),
                "final_concentration": Estimate(
                    mass / at.final_height if at.final_height > 0 else np.inf, "kg/m^3"
                ),
            }
        if self.underflow_concentration is not None:
            found |= self._talmage_fitch(c, mass)
        return found

    def _talmage_fitch(self, c: Curve, mass: float) -> dict[str, Estimate]:
        """Time at which the tangent at the compression point (or the curve itself, when it is there first)
        meets the underflow height.
        """
        height = mass / float(self.underflow_concentration)  # type: ignore[arg-type]
        if height >= c.initial_height:
            raise InputError(
                _(
                    "The underflow ({underflow} kg/m³) must be denser than the suspension ({initial} kg/m³)."
                ).format(
                    underflow=float(self.underflow_concentration),  # type: ignore[arg-type]
                    initial=float(self.initial_concentration),  # type: ignore[arg-type]
                )
            )

        def meets(tangents: Tangents) -> float:
            middle, cut, velocity = tangents
            if c.compression is not None and height < c.compression.height:
                i = int(np.argmin(np.abs(middle - c.compression.time)))
            # the tangent that reaches the underflow height last, of all layers that are thinner than the
            # underflow
            else:
                i = int(np.argmax((cut - height) / velocity * (cut > height)))
            return float((cut[i] - height) / velocity[i])

        time, drawn = meets(c.convex.tangents), [meets(tangents) for tangents in self._redrawn(c)]
        low, high = np.quantile(drawn, [0.025, 0.975])
        estimate = Estimate(time, "s", float(np.std(drawn)), (min(float(low), time), max(float(high), time)))
        per_mass = [x / mass for x in (time, estimate.standard_error, *estimate.interval_95)]
        return {
            "underflow_time": estimate,
            "unit_area_talmage_fitch": Estimate(
                per_mass[0], "m^2*s/kg", per_mass[1], (per_mass[2], per_mass[3])
            ),
        }


class BatchSeries(eqx.Module):
    """Several settling curves of one material at different concentrations, taken together."""

    tests: tuple[BatchTest, ...]

    def velocities(self) -> tuple[np.ndarray, np.ndarray]:
        """Initial concentrations and hindered settling velocities: what Coe and Clevenger's method takes."""
        rows = sorted((float(t.initial_concentration), t.curve().constant_rate.velocity) for t in self.tests)
        return np.array([c for c, _v in rows]), np.array([v for _c, v in rows])
