"""Growth and nucleation kinetics from seeded batches: concentration (and size) over time."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Annotated, Any, ClassVar

import jax.numpy as jnp
import numpy as np

from granum.core import lab_test
from granum.core.errors import InputError
from granum.core.i18n import _
from granum.core.kinds import (
    Density,
    Distance,
    Length,
    MassRatio,
    MolarEnergy,
    Number,
    PositiveNumber,
    Series,
    Temperature,
    Time,
)
from granum.crystallization.formulas.growth import PowerLawGrowth
from granum.crystallization.formulas.nucleation import PowerLawNucleation
from granum.crystallization.formulas.programs import TemperaturePoints
from granum.crystallization.kinds import Solubility
from granum.crystallization.population.lagrangian import Model, SuspensionVolume, march
from granum.crystallization.population.operations import Programmed
from granum.crystallization.vessels.batch import narrow_seeds
from granum.crystallization.vessels.crystals import Crystal
from granum.estimation import Fit, LabTest, fit
from granum.estimation.lines import straight_line
from granum.numerics.smooth import safe_divide

FINE_STEPS = 200  # time steps of a run, shared out between the samples
TRIED = np.log([1e5, 1e7, 1e9, 1e11])  # nucleation coefficients to start from, 1/(m³ s) per kg/m³


@lab_test(
    "batch_kinetics",
    source="miller1994; qiu1991",
    title="Kinetics from a seeded batch",
    equation=r"G = k_g S^g,\quad B_0 = k_b S^b M_T",
)
class BatchKinetics(LabTest):
    """Growth and secondary nucleation coefficients and orders from the concentration (and mean size) of a
    seeded batch over time.

    The whole batch is simulated for every trial, with exact derivatives. Coefficients are estimated by their
    logarithms, which are far less correlated with the orders. Concentration alone fixes the growth; the
    nucleation needs the mean size D[4,3] as well, or runs with little seed. Several runs are fitted together
    with ``fit_together``.
    """

    time: Annotated[Time, Series("points")]
    temperature: Annotated[Temperature, Series("points")]
    solute_per_solvent: Annotated[MassRatio, Series("points")]
    solubility: Solubility
    crystal_density: Density
    seed_mass_per_solvent: MassRatio
    seed_size: Length
    mean_diameter: Annotated[Length, Series("points")] | None = None
    seed_width: Distance = 0.0
    volume_shape_factor: PositiveNumber = 1.0
    solute_fraction_of_crystal: PositiveNumber = 1.0
    liquid_density: Density = 1000.0
    growth_activation_energy: MolarEnergy = 0.0
    magma_order: PositiveNumber = 1.0

    least_points: ClassVar[int] = 6
    estimates: ClassVar = {
        "log_growth_coefficient": Number,
        "growth_order": Number,
        "log_nucleation_coefficient": Number,
        "nucleation_order": Number,
    }
    holds_for: ClassVar = ("temperature",)
    axes: ClassVar = {"time": Time, "solute_per_solvent": MassRatio}

    def fit(self) -> Fit:
        """Coefficients and orders with 95 % intervals."""
        return fit_together([self])

    def chart(self) -> Any:
        """Measured and fitted concentration over time, and the mean size where it was measured."""
        from granum.core.charts import LIQUID, SOLID, add_line, add_points, add_right_axis, axis_title, figure

        minutes = np.asarray(self.time) / 60.0
        fitted = self.predicted({name: estimate.value for name, estimate in self.fit().parameters.items()})
        drawing = figure(
            axis_title("time", "min"), axis_title("solute_per_solvent", "kg/kg"), title=type(self).card.title
        )
        saturated = np.asarray(self.solubility(np.asarray(self.temperature)))
        add_line(drawing, minutes, saturated, _("solubility"), color=LIQUID, dash="dash")
        add_line(drawing, minutes, np.asarray(fitted[0]), _("model"))
        add_points(drawing, minutes, np.asarray(self.solute_per_solvent), _("data"))
        if self.mean_diameter is not None:
            add_line(drawing, minutes, 1e6 * np.asarray(fitted[1]), _("size, model"), color=SOLID, yaxis="y2")
            add_points(
                drawing,
                minutes,
                1e6 * np.asarray(self.mean_diameter),
                _("size, data"),
                color=SOLID,
                yaxis="y2",
            )
            add_right_axis(drawing, axis_title("mean_diameter_mass", "um"), tickmode="auto", nticks=6)
            drawing.update_layout(
                margin={"r": 70, "t": 80},
                legend={"orientation": "h", "y": 1.08},
            )
        return drawing

    def model(self, p: dict[str, Any]) -> Model:
        """The batch with trial kinetics."""
        crystal = Crystal(self.crystal_density, self.volume_shape_factor, self.solute_fraction_of_crystal)
        growth = PowerLawGrowth(
            jnp.exp(p["log_growth_coefficient"]), p["growth_order"], self.growth_activation_energy
        )
        nucleation = PowerLawNucleation(
            jnp.exp(p["log_nucleation_coefficient"]), p["nucleation_order"], self.magma_order
        )
        return Model(self.solubility, growth, nucleation, crystal, SuspensionVolume(self.liquid_density))

    def predicted(self, p: dict[str, Any]) -> Any:
        """Concentration, and D[4,3] where it was measured, at the sample times."""
        times, index = self._grid()
        mass_per_cube = self.crystal_density * self.volume_shape_factor
        seeds = narrow_seeds(self.seed_size, self.seed_width, self.seed_mass_per_solvent, mass_per_cube)
        operation = Programmed(TemperaturePoints(np.asarray(self.time), np.asarray(self.temperature)))
        course = march(
            self.model(p), operation, seeds, float(np.asarray(self.solute_per_solvent)[0]), 1.0, times
        )
        ratio = course.solute_per_solvent[index]
        if self.mean_diameter is None:
            return (ratio,)
        return ratio, safe_divide(course.moments[index, 4], course.moments[index, 3])

    def measured(self) -> tuple[np.ndarray, ...]:
        """What ``predicted`` is compared with."""
        ratio = np.asarray(self.solute_per_solvent)
        return (ratio,) if self.mean_diameter is None else (ratio, np.asarray(self.mean_diameter))

    def _grid(self) -> tuple[np.ndarray, np.ndarray]:
        """Time steps that meet every sample, and where the samples are among them."""
        t = np.asarray(self.time)
        counts = np.maximum(1, np.ceil(np.diff(t) / (t[-1] - t[0]) * FINE_STEPS)).astype(int)
        pieces = [np.linspace(a, b, n, endpoint=False) for a, b, n in zip(t[:-1], t[1:], counts, strict=True)]
        return np.concatenate([*pieces, t[-1:]]), np.concatenate([[0], np.cumsum(counts)])

    def growth_start(self) -> tuple[float, float]:
        """Logarithm of the growth coefficient and order as if the seeds alone grew: the start of the fit."""
        t, c, T = (np.asarray(v) for v in (self.time, self.solute_per_solvent, self.temperature))
        saturated = np.asarray(self.solubility(T))
        crystals = np.maximum(
            self.seed_mass_per_solvent + (c[0] - c) / self.solute_fraction_of_crystal,
            self.seed_mass_per_solvent,
        )
        size = self.seed_size * (crystals / self.seed_mass_per_solvent) ** (1 / 3)
        growth, S = np.gradient(size, t), c / saturated - 1.0
        good = (growth > 0) & (S > 0)
        if good.sum() < 3:
            raise InputError(
                _(
                    "The solution is hardly ever supersaturated while crystals grow: check that "
                    "concentration and solubility have the same basis."
                )
            )
        order, level = straight_line(np.log(S[good]), np.log(growth[good]))
        if not 0.7 <= order <= 3.0:
            order = 1.5
            level = float(np.median(np.log(growth[good]) - order * np.log(S[good])))
        return float(level), float(order)


def fit_together(tests: Sequence[BatchKinetics]) -> Fit:
    """One set of kinetics from several batches, each data set weighted by its own scatter (taken as 1 % of
    its range).
    """
    for test in tests:
        test.increasing("time")
    starts = np.array([test.growth_start() for test in tests])
    y = tuple(values for test in tests for values in test.measured())
    sigma = tuple(np.full(values.shape, 0.01 * max(float(np.ptp(values)), 1e-12)) for values in y)

    def model(p: dict[str, Any], _x: Any) -> Any:
        return tuple(values for test in tests for values in test.predicted(p))

    best = None
    for log_kb in TRIED:
        start = {
            "log_growth_coefficient": float(starts[:, 0].mean()),
            "growth_order": float(starts[:, 1].mean()),
            "log_nucleation_coefficient": float(log_kb),
            "nucleation_order": 2.0,
        }
        misfit = sum(
            float(jnp.sum(((a - b) / s) ** 2)) for a, b, s in zip(model(start, None), y, sigma, strict=True)
        )
        if best is None or misfit < best[0]:
            best = (misfit, start)
    assert best is not None
    alone = tests[0].rows(np.zeros(1), y) if len(tests) == 1 else None
    found = fit(
        model,
        best[1],
        np.zeros(1),
        y,
        sigma=sigma,
        rows=alone,
        card=BatchKinetics.card.key,
        kinds=BatchKinetics.estimates,
        scale={
            "log_growth_coefficient": 1.0,
            "growth_order": 0.5,
            "log_nucleation_coefficient": 2.0,
            "nucleation_order": 1.0,
        },
        bounds={
            "growth_order": (0.3, 6.0),
            "nucleation_order": (0.3, 12.0),
            "log_nucleation_coefficient": (0.0, 80.0),
        },
        derived=lambda p: {
            "growth_coefficient": jnp.exp(p["log_growth_coefficient"]),
            "nucleation_coefficient": jnp.exp(p["log_nucleation_coefficient"]),
        },
    )
    held = [test.ranges() for test in tests]
    ranges = {n: (min(r[n][0] for r in held), max(r[n][1] for r in held)) for n in held[0]}
    return replace(found, derived=_spread(found), defaults=tests[0].defaults(), ranges=ranges)


def _spread(found: Fit) -> dict[str, Any]:
    """The coefficients with the intervals of their logarithms, which keep them positive."""
    out = dict(found.derived)
    for name in out:
        low, high = found.parameters[f"log_{name}"].interval_95
        out[name] = replace(out[name], interval_95=(float(np.exp(low)), float(np.exp(high))))
    return out
