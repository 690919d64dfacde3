"""The drying curve of a product in constant air: rate, periods, critical moisture."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Any, ClassVar, NamedTuple

import jax.numpy as jnp
import numpy as np

from granum.core import lab_test
from granum.core.errors import InputError
from granum.core.i18n import _
from granum.core.kinds import Area, Frequency, Mass, MassFlux, MoistureDryBasis, PositiveNumber, Series, Time
from granum.estimation import Fit, LabTest
from granum.estimation.lines import straight_line

if TYPE_CHECKING:
    import plotly.graph_objects as go

NEIGHBORS = 0.2  # share of the points in one local parabola of the rate curve
LEAST_NEIGHBORS = 7
MOST_SHOWN = 400  # points of the rate curve that are drawn


class RateCurve(NamedTuple):
    """Drying rate over moisture from local parabolas, with the standard error of each rate."""

    time: np.ndarray
    moisture_dry_basis: np.ndarray
    rate: np.ndarray
    standard_error: np.ndarray


def falling(tau: Any, n: Any) -> Any:
    """Characteristic moisture after a reduced time: the solution of dΦ/dτ = −Φⁿ, an exponential for n = 1."""
    m = n - 1.0
    near = jnp.abs(m) < 1e-7
    m = jnp.where(near, 1.0, m)
    room = 1.0 + m * tau
    bent = jnp.log(jnp.maximum(room, 1e-12)) / m
    return jnp.exp(-jnp.where(near, tau, bent))


def moisture_model(p: dict[str, Any], t: Any) -> Any:
    """Moisture over time: straight to the critical moisture, then falling along f = Φⁿ towards
    equilibrium.
    """
    X0, k, Xc, Xe = (
        p["initial_moisture"],
        p["rate_per_dry_mass"],
        p["critical_moisture"],
        p["equilibrium_moisture"],
    )
    start = jnp.minimum(Xc, X0)
    span = jnp.maximum(Xc - Xe, 1e-9)
    n = p.get("characteristic_exponent", 1.0)
    # a product that starts below its critical moisture has used up part of the falling curve
    before = jnp.where(Xc > X0, _age(jnp.clip((X0 - Xe) / span, 1e-9, 1.0), n), 0.0)
    t_critical = (X0 - start) / k
    tau = before + k * jnp.maximum(t - t_critical, 0.0) / span
    return jnp.where(t < t_critical, X0 - k * t, Xe + span * falling(tau, n))


def _age(phi: Any, n: Any) -> Any:
    m = n - 1.0
    near = jnp.abs(m) < 1e-7
    m = jnp.where(near, 1.0, m)
    return jnp.where(near, -jnp.log(phi), (phi**-m - 1.0) / m)


@lab_test(
    "curve",
    source="krischer1978; vanmeel1958; treybal1980, ch. 12",
    title="Drying curve",
    equation=(
        r"-\frac{dX}{dt} = k\ (X>X_c),\qquad -\frac{dX}{dt} = "
        r"k\left(\frac{X-X_e}{X_c-X_e}\right)^{n}\ (X<X_c)"
    ),
)
class DryingCurve(LabTest):
    """Periods, constant rate and critical moisture from the mass or moisture of a product dried in constant
    air.

    The two periods are fitted to the moisture itself, so noise is not differentiated and the critical
    moisture has an honest interval. The rate curve of the chart comes from local parabolas over a fifth of
    the points, seven at least (tricube weights, uneven steps allowed), and is shown for the eye only. Points
    before ``warm_up_time`` are left out. Equilibrium moisture is fitted unless given; the exponent of the
    falling period is 1, a straight line, unless ``fit_exponent`` is set.
    """

    time: Annotated[Time, Series("points")]
    mass: Annotated[Mass, Series("points")] | None = None
    moisture_dry_basis: Annotated[MoistureDryBasis, Series("points")] | None = None
    dry_solid_mass: Mass | None = None
    area: Area | None = None
    equilibrium_moisture: MoistureDryBasis | None = None
    warm_up_time: Time = 0.0
    fit_exponent: bool = False
    estimates: ClassVar = {
        "initial_moisture": MoistureDryBasis,
        "rate_per_dry_mass": Frequency,
        "critical_moisture": MoistureDryBasis,
        "equilibrium_moisture": MoistureDryBasis,
        "characteristic_exponent": PositiveNumber,
    }
    axes: ClassVar = {"time": Time, "moisture_dry_basis": MoistureDryBasis}
    least_points: ClassVar[int] = 6

    def moisture(self) -> np.ndarray:
        """Moisture, dry basis, at every point."""
        if (self.mass is None) == (self.moisture_dry_basis is None):
            raise InputError(_("Give either a column 'mass' or a column 'moisture_dry_basis'."))
        if self.moisture_dry_basis is not None:
            return np.asarray(self.moisture_dry_basis, dtype=float)
        if not self.dry_solid_mass:
            raise InputError(
                _("A column 'mass' needs the mass of dry solid: give 'dry_solid_mass'."),
                name="dry_solid_mass",
            )
        X = np.asarray(self.mass, dtype=float) / self.dry_solid_mass - 1.0
        if X.min() < -1e-6:
            raise InputError(
                _(
                    "The sample weighs less ({mass} kg) than its dry solid ({dry} kg): check "
                    "'dry_solid_mass'."
                ).format(mass=f"{np.min(np.asarray(self.mass)):.4g}", dry=f"{self.dry_solid_mass:.4g}"),
                name="dry_solid_mass",
            )
        return X

    @property
    def _neighbors(self) -> int:
        """Points in one local parabola."""
        return min(len(self.time), max(LEAST_NEIGHBORS, int(np.ceil(NEIGHBORS * len(self.time)))))

    def rate_curve(self, points: slice = slice(None)) -> RateCurve:
        """−dX/dt at every point (or some of them) from a local parabola, with its standard error."""
        t, X = np.asarray(self.time, dtype=float), self.moisture()
        count = self._neighbors
        shown = t[points]
        smooth, rate, error = np.empty_like(shown), np.empty_like(shown), np.empty_like(shown)
        for i, now in enumerate(shown):
            near = np.argsort(np.abs(t - now), kind="stable")[:count]
            reach = max(np.abs(t[near] - now).max(), 1e-12) * 1.0001
            s = (t[near] - now) / reach
            weight = (1.0 - np.abs(s) ** 3) ** 3
            basis = np.stack([np.ones_like(s), s, s * s], axis=1)
            normal = basis.T @ (weight[:, None] * basis)
            inverse = np.linalg.pinv(normal)
            found = inverse @ (basis.T @ (weight * X[near]))
            left = X[near] - basis @ found
            variance = float(weight @ left**2) / max(weight.sum() - 3.0, 1.0)
            spread = inverse @ (basis.T @ (weight[:, None] ** 2 * basis)) @ inverse * variance
            smooth[i], rate[i], error[i] = (
                found[0],
                -found[1] / reach,
                np.sqrt(max(spread[1, 1], 0.0)) / reach,
            )
        return RateCurve(shown, smooth, rate, error)

    def fit(self) -> Fit:
        self.increasing("time")
        t, X = np.asarray(self.time, dtype=float), self.moisture()
        keep = t >= self.warm_up_time
        if keep.sum() < self.least_points:
            raise InputError(
                _("Fewer than {least} points remain after 'warm_up_time'.").format(least=self.least_points),
                name="warm_up_time",
            )
        if not np.ptp(X[keep]) > 0.0:
            raise InputError(
                _("The moisture is the same at every point: nothing dried."), name="moisture_dry_basis"
            )
        origin = t[keep][0]
        fixed = (
            {}
            if self.equilibrium_moisture is None
            else {"equilibrium_moisture": float(self.equilibrium_moisture)}
        )
        fixed |= {} if self.fit_exponent else {"characteristic_exponent": 1.0}
        if fixed.get("equilibrium_moisture", -1.0) >= X[keep].min() + 0.05 * np.ptp(X[keep]):
            raise InputError(
                _(
                    "The equilibrium moisture {given} lies above the lowest measured moisture {lowest}."
                ).format(given=f"{fixed['equilibrium_moisture']:.4g}", lowest=f"{X[keep].min():.4g}"),
                name="equilibrium_moisture",
            )

        def model(p: dict[str, Any], t: Any) -> Any:
            return moisture_model({**fixed, **p}, t - origin)

        start = self._start(t[keep] - origin, X[keep], fixed)
        bounds = {
            "initial_moisture": (0.0, np.inf),
            "rate_per_dry_mass": (0.0, np.inf),
            "critical_moisture": (0.0, 1.5 * X.max()),
            "equilibrium_moisture": (0.0, float(X[keep].min() + 0.05 * np.ptp(X[keep]))),
            "characteristic_exponent": (0.1, 6.0),
        }
        found = self.fitted(
            model,
            start,
            t,
            X,
            keep=keep,
            bounds={n: bounds[n] for n in start},
            derived=lambda p: self._derived({**fixed, **p}),
            kinds={"drying_rate_constant": MassFlux, "time_constant_rate": Time},
        )
        found.statistics["smoothing_points"] = self._neighbors
        found.flags.extend(self._notes(found, X[keep]))
        return found

    def _derived(self, p: dict[str, Any]) -> dict[str, Any]:
        found = {
            "time_constant_rate": jnp.maximum(p["initial_moisture"] - p["critical_moisture"], 0.0)
            / p["rate_per_dry_mass"]
        }
        if self.area is not None and self.dry_solid_mass is not None:
            found["drying_rate_constant"] = p["rate_per_dry_mass"] * self.dry_solid_mass / self.area
        return found

    def _start(self, t: np.ndarray, X: np.ndarray, fixed: dict[str, float]) -> dict[str, float]:
        """The best of a coarse scan of critical moistures, each with the rate its points suggest."""
        first = {
            "initial_moisture": float(X[0]),
            "equilibrium_moisture": float(max(X.min() - 0.03 * np.ptp(X), 1e-4 * X.max())),
        }
        first |= {"characteristic_exponent": 1.0}
        low = fixed.get("equilibrium_moisture", first["equilibrium_moisture"])
        best: tuple[float, dict[str, float]] = (np.inf, {})
        for share in np.linspace(0.1, 1.15, 16):
            Xc = low + share * (X[0] - low)
            early = min(Xc, X[0] - 0.15 * np.ptp(X)) <= X
            slope = -straight_line(t[early], X[early])[0] if early.sum() > 1 else 0.0
            for factor in (0.8, 1.0, 1.3):
                trial = first | {
                    "rate_per_dry_mass": max(factor * float(slope), 1e-12),
                    "critical_moisture": float(Xc),
                }
                left = np.asarray(moisture_model({**trial, **fixed}, t)) - X
                best = min(best, (float(left @ left), trial), key=lambda item: item[0])
        return {name: value for name, value in best[1].items() if name not in fixed}

    def _notes(self, found: Fit, X: np.ndarray) -> list[dict[str, Any]]:
        notes = []
        Xc, X0 = found["critical_moisture"].value, found["initial_moisture"].value
        if Xc >= X0:
            notes.append(
                self.note(
                    "no constant-rate period",
                    _(
                        "The rate falls from the start: the critical moisture lies at or above the "
                        "first point."
                    ),
                )
            )
        elif Xc <= X.min() + 0.02 * np.ptp(X):
            notes.append(
                self.note(
                    "no falling-rate period",
                    _("The rate is constant to the end: the critical moisture was not reached."),
                )
            )
        first = int(np.argmax(np.asarray(self.time) >= self.warm_up_time))
        early = self.rate_curve(slice(first, first + 3)).rate
        if Xc < X0 and early.max() < 0.7 * found["rate_per_dry_mass"].value:
            notes.append(
                self.note(
                    "warm-up",
                    _(
                        "The first points dry slower than the rest: warming up; leave them out with "
                        "'warm_up_time'."
                    ),
                )
            )
        return notes

    def chart(self) -> go.Figure:
        """Krischer's plot: rate over moisture, with the fitted periods and the critical moisture."""
        from granum.core.charts import (
            ACCENT,
            GRID,
            HEAT,
            add_band,
            add_label,
            add_line,
            add_points,
            axis_title,
            figure,
        )

        found, rates = self.fit(), self.rate_curve(slice(None, None, -(-len(self.time) // MOST_SHOWN)))
        p = {
            "equilibrium_moisture": self.equilibrium_moisture or 0.0,
            "characteristic_exponent": 1.0,
        } | found.values
        Xc, Xe, k = p["critical_moisture"], p["equilibrium_moisture"], p["rate_per_dry_mass"]
        top = float(max(self.moisture().max(), Xc))
        X = np.linspace(Xe, top, 300)
        model = k * np.clip((X - Xe) / max(Xc - Xe, 1e-12), 0.0, 1.0) ** p["characteristic_exponent"]
        drawing = figure(
            axis_title("moisture_dry_basis", "kg/kg"),
            axis_title("rate_per_dry_mass", "1/hour"),
            title=type(self).card.title,
        )
        low, high = found["critical_moisture"].interval_95
        if np.isfinite(low + high):
            add_band(
                drawing, [low, high], [0, 0], [3.6e3 * k * 1.12] * 2, _("critical moisture, 95 %"), color=HEAT
            )
        order = np.argsort(rates.moisture_dry_basis)
        reach = 2.0 * rates.standard_error
        add_band(
            drawing,
            rates.moisture_dry_basis[order],
            3.6e3 * (rates.rate - reach)[order],
            3.6e3 * (rates.rate + reach)[order],
            _("± 2 standard errors"),
            color="#6b7f99",
        )
        add_line(drawing, X, 3.6e3 * model, _("periods fitted"), color=ACCENT, width=3)
        add_points(drawing, rates.moisture_dry_basis, 3.6e3 * rates.rate, _("smoothed rate"))
        drawing.add_vline(x=Xc, line={"color": HEAT, "dash": "dot", "width": 1.5})
        add_label(drawing, Xc, 3.6e3 * k * 1.15, f"X<sub>c</sub> = {Xc:.3g}", color=HEAT)
        drawing.update_xaxes(rangemode="tozero", gridcolor=GRID)
        drawing.update_yaxes(rangemode="tozero")
        return drawing

    def time_chart(self) -> go.Figure:
        """Moisture over time with the fitted line and its band."""
        return super().chart()
