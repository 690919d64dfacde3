"""Fit any formula or law to measured columns: what the file and the given values do not hold is estimated.

>>> data = CardData.read(
...     "particles.terminal_velocity_stokes",
...     "speeds.csv",
...     estimate=["dynamic_viscosity"],
...     fixed={"particle_density": 2650.0, "fluid_density": 1000.0},
... )  # doctest: +SKIP
>>> data.fit()["dynamic_viscosity"].interval_95  # doctest: +SKIP
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Annotated, Any

import numpy as np
import scipy

from granum.core import registry
from granum.core.conversion import convert
from granum.core.errors import InputError, unknown_name
from granum.core.i18n import _, quoted
from granum.core.parameters import REQUIRED, Parameter, default_as_json
from granum.estimation.design import next_experiment
from granum.estimation.least_squares import fit
from granum.estimation.losses import Loss
from granum.estimation.results import Fit
from granum.estimation.tables import Source, held, read_table

if TYPE_CHECKING:
    import plotly.graph_objects as go

TRIALS = 128
"""Places where the model is tried before the search starts from the best of them."""


@dataclass(frozen=True)
class CardData:
    """A formula or law, measured columns, values that stay fixed and parameters to find.

    Parameters
    ----------
    columns: measured inputs by name, SI. measured: the result, SI.
    fixed: other inputs, SI. starts: first value and bounds of each parameter to find.
    """

    thing: Any
    output: Parameter
    columns: dict[str, np.ndarray]
    measured: np.ndarray
    fixed: dict[str, Any]
    starts: dict[str, tuple[float | None, Parameter]]

    @staticmethod
    def read(
        thing: Any,
        source: Source,
        *,
        estimate: Sequence[str] | Mapping[str, Any] = (),
        fixed: Mapping[str, Any] | None = None,
        output: str = "",
    ) -> CardData:
        """The data of a file (CSV, TSV, XLSX) with units in its header; columns are named like the inputs and
        the result.

        ``estimate`` names the parameters to find, as a list or with first values (any unit). Of a law, all
        parameters that are not given are found.
        """
        thing = registry.find(thing) if isinstance(thing, str) else thing
        if thing.card.sort not in ("formula", "law"):
            raise InputError(
                _("'{key}' ({sort}): formulas, laws and lab tests can be fitted.").format(
                    key=thing.card.key, sort=_(thing.card.sort)
                )
            )
        wanted = dict(estimate) if isinstance(estimate, Mapping) else dict.fromkeys(estimate)
        where = _("for {owner}").format(owner=thing.card.key)
        inputs, result = thing.card.inputs, _result(thing, output, where)
        for name in (*wanted, *(fixed or {})):
            if name not in inputs:
                raise unknown_name(_("Input"), name, inputs, where)
        known = {n: convert(v, inputs[n], " " + where) for n, v in (fixed or {}).items()}
        kept, found = held(source)
        free = [
            p for n, p in inputs.items() if n in found and _numeric(p) and n not in wanted and n not in known
        ]
        table = read_table(kept, [replace(p, series="points", default=REQUIRED) for p in (result, *free)])
        measured = table.pop(result.name)
        if thing.card.sort == "law":
            own = {p.name for p in thing.card.parameters}
            wanted |= {
                n: None
                for n, p in inputs.items()
                if n in own
                and _numeric(p)
                and p.required
                and n not in known
                and n not in table
                and n not in wanted
            }
        for name in wanted:
            if not _numeric(inputs[name]):
                raise InputError(
                    _("'{name}' cannot be estimated: it is no single number.").format(name=name), name=name
                )
        missing = [
            n
            for n, p in inputs.items()
            if p.required and n not in known and n not in table and n not in wanted
        ]
        if missing:
            raise InputError(
                _(
                    "{owner}: {names} are neither columns of the file ({columns}) nor given. Give them, "
                    "or estimate them (--estimate {first})."
                ).format(
                    owner=thing.card.key,
                    names=", ".join(quoted(n) for n in missing),
                    columns=", ".join(found),
                    first=missing[0],
                ),
                missing=missing,
            )
        if not wanted:
            raise InputError(
                _("There is nothing to estimate: name at least one parameter (--estimate NAME).")
            )
        starts = {
            n: (None if v is None else float(convert(v, inputs[n], " " + where)), inputs[n])
            for n, v in wanted.items()
        }
        return CardData(thing, result, table, measured, known, starts)

    def model(self, parameters: Mapping[str, Any], columns: Mapping[str, Any]) -> Any:
        """The result for given parameters and columns. Pure."""
        every = {**self.fixed, **columns, **parameters}
        made = self.thing.called(**every) if self.thing.card.sort == "law" else self.thing(**every)
        return getattr(made, self.output.name) if hasattr(made, "_fields") else made

    def fit(self, loss: Loss | None = None) -> Fit:
        """Estimate the parameters, from the best of many places within their ordinary ranges."""
        ranges = [_range(p) for _start, p in self.starts.values()]
        cube = np.vstack(
            [
                np.full((1, len(ranges)), 0.5),
                scipy.stats.qmc.LatinHypercube(len(ranges), rng=np.random.default_rng(0)).random(TRIALS),
            ]
        )
        places = [
            {
                n: given if given is not None else _at(r, u)
                for (n, (given, _p)), r, u in zip(self.starts.items(), ranges, row, strict=True)
            }
            for row in cube
        ]
        misses = [
            self._miss(place)
            for place in (places if any(g is None for g, _p in self.starts.values()) else places[:1])
        ]
        if not np.isfinite(min(misses)):
            raise InputError(
                _("The model has no finite value at the start values {start}.").format(start=places[0])
            )
        bounds = {n: (p.kind.lower, p.kind.upper) for n, (_g, p) in self.starts.items() if p.kind is not None}
        kinds = {n: Annotated[Any, p.kind] for n, (_g, p) in self.starts.items() if p.kind is not None}
        found = fit(
            self.model,
            places[int(np.argmin(misses))],
            self.columns,
            self.measured,
            bounds=bounds,
            kinds=kinds,
            loss=loss,
            card=self.thing.card.key,
        )
        return replace(
            found,
            defaults=self.defaults(),
            ranges={n: (float(v.min()), float(v.max())) for n, v in self.columns.items()},
        )

    def defaults(self) -> dict[str, Any]:
        """Inputs that were neither measured nor given nor estimated and stand at their defaults, as plain
        data.
        """
        known = {*self.fixed, *self.columns, *self.starts}
        left = {
            n: p.default
            for n, p in self.thing.card.inputs.items()
            if n not in known and not p.required and p.default is not None
        }
        return {n: default_as_json(value) for n, value in left.items()}

    def next_measurement(self, found: Fit, steps: int = 41) -> dict[str, Any]:
        """Where in the measured ranges one more measurement tells most, SI: ``{"at", "shrinkage",
        "standard_errors"}``.
        """
        per = max(2, round((steps**2) ** (1 / max(len(self.columns), 1)))) if len(self.columns) > 2 else steps
        spans = [np.linspace(v.min(), v.max(), per) for v in self.columns.values()]
        grid = dict(zip(self.columns, (g.ravel() for g in np.meshgrid(*spans, indexing="ij")), strict=True))
        told = next_experiment(found, grid)
        inputs = self.thing.card.inputs
        at = {
            n: {"value": float(g[told.best]), "unit": inputs[n].kind.unit if inputs[n].kind else ""}
            for n, g in grid.items()
        }  # type: ignore[union-attr]
        return {
            "at": at,
            "shrinkage": float(told.shrinkage[told.best]),
            "standard_errors": told.standard_errors,
        }

    def _miss(self, place: Mapping[str, float]) -> float:
        with np.errstate(all="ignore"):
            found = np.broadcast_to(
                np.asarray(self.model(place, self.columns), dtype=float), self.measured.shape
            )
            miss = float(np.sum((found - self.measured) ** 2))
        return miss if np.isfinite(miss) else np.inf

    def chart(self) -> go.Figure:
        """One measured column: data, model and 95 % band along it. Several: measured against computed."""
        from granum.core.charts import add_band, add_line, add_points, axis_title, figure
        from granum.core.units import best_unit, from_si

        found = self.fit()

        def scaled(p: Parameter, values: Any) -> tuple[np.ndarray, str]:
            assert p.kind is not None
            unit = best_unit(float(np.median(np.abs(values))), p.kind)
            return np.asarray(from_si(np.asarray(values), unit, p.kind)), axis_title(
                p.name, unit, symbol=p.own_symbol
            )

        y, upward = scaled(self.output, self.measured)
        if len(self.columns) == 1:
            ((name, values),) = self.columns.items()
            parameter = self.thing.card.inputs[name]
            grid = np.linspace(values.min(), values.max(), 200)
            band = found.predict({name: grid})
            x, across = scaled(parameter, values)
            drawing = figure(across, upward, title=self.thing.card.title)
            unit = best_unit(float(np.median(np.abs(self.measured))), self.output.kind)  # type: ignore[arg-type]
            low, high, middle = (
                np.asarray(from_si(v, unit, self.output.kind))  # type: ignore[arg-type]
                for v in (band.low, band.high, band.value)
            )
            along = np.linspace(x.min(), x.max(), 200)
            add_band(drawing, along, low, high, _("95 % band"))
            add_line(drawing, along, middle, _("model"))
            add_points(drawing, x, y, _("data"))
            return drawing
        computed, _title = scaled(self.output, self.measured - found.residuals)
        drawing = figure(f"{upward} ({_('computed')})", upward, title=self.thing.card.title)
        ends = [min(y.min(), computed.min()), max(y.max(), computed.max())]
        add_line(drawing, ends, ends, _("equal"))
        add_points(drawing, computed, y, _("data"))
        return drawing


def fit_together(sets: Sequence[CardData], loss: Loss | None = None) -> Fit:
    """One fit of the same parameters to several data sets, each with its own columns and fixed values.

    Each set is weighted by the scatter it shows when it is fitted alone, so that sets of different sizes and
    precision count as they deserve.
    """
    if not sets or len({tuple(s.starts) for s in sets}) != 1:
        raise InputError(_("Data sets are fitted together when all of them estimate the same parameters."))
    alone = [s.fit(loss) for s in sets]
    spreads = tuple(
        max(f.statistics["residual_standard_deviation"], 1e-12 * float(np.max(np.abs(s.measured))))
        for f, s in zip(alone, sets, strict=True)
    )
    start = {n: float(np.mean([f[n].value for f in alone])) for n in sets[0].starts}
    kinds = {n: Annotated[Any, p.kind] for n, (_g, p) in sets[0].starts.items() if p.kind is not None}
    bounds = {n: (p.kind.lower, p.kind.upper) for n, (_g, p) in sets[0].starts.items() if p.kind is not None}
    found = fit(
        lambda p, x: tuple(s.model(p, c) for s, c in zip(sets, x, strict=True)),
        start,
        tuple(s.columns for s in sets),
        tuple(s.measured for s in sets),
        sigma=spreads,
        bounds=bounds,
        kinds=kinds,
        loss=loss,
        card=sets[0].thing.card.key,
    )
    ends = [f.ranges for f in alone]
    ranges = {
        n: (min(e[n][0] for e in ends if n in e), max(e[n][1] for e in ends if n in e))
        for n in {n for e in ends for n in e}
    }
    return replace(found, defaults={n: v for f in alone for n, v in f.defaults.items()}, ranges=ranges)


def _result(thing: Any, output: str, where: str) -> Parameter:
    outputs = {p.name: p for p in thing.card.outputs if p.kind is not None and not p.series}
    if not outputs:
        raise InputError(
            _("'{key}' gives no single number that could be measured.").format(key=thing.card.key)
        )
    if output and output not in outputs:
        raise unknown_name(_("Result"), output, outputs, where)
    return outputs[output or next(iter(outputs))]


def _numeric(p: Parameter) -> bool:
    return p.kind is not None and not p.series and not p.law and p.sort is not int


def _range(p: Parameter) -> tuple[float, float]:
    low, high = p.ordinary()
    return (low, high) if low < high else (low, low + (abs(low) or 1.0))


def _at(span: tuple[float, float], u: float) -> float:
    low, high = span
    return float(low * (high / low) ** u) if low > 0 and high / low > 5 else float(low + (high - low) * u)
