"""What a study gives: cases, figures in few numbers, an xarray dataset, files, JSON and charts."""

from __future__ import annotations

import abc
import os
import tempfile
from collections.abc import Mapping
from dataclasses import dataclass, field
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np

from granum.core import notebooks
from granum.core.csv_form import csv_form
from granum.core.errors import InputError, reason_of
from granum.core.files import check_writable
from granum.core.i18n import _
from granum.studies.engine import Cases
from granum.studies.subjects import NOT_RUN, Variable

if TYPE_CHECKING:
    import pandas as pd
    import plotly.graph_objects as go
    import xarray as xr

FILES = (".nc", ".parquet", ".csv", ".xlsx")


def number(value: Any) -> float | None:
    """A float for JSON; None when it is not finite."""
    return float(value) if np.isfinite(value) else None


def variable_json(v: Variable) -> dict[str, Any]:
    """Path, label, symbol and units of an input or a figure."""
    return {
        "name": v.path,
        "label": v.label,
        "symbol": "" if v.named else v.parameter.symbol,
        "unit": v.unit,
        "units": list(v.parameter.units),
    }


def kind_in_words(kind: str) -> str:
    """A kind of study as people call it.

    >>> kind_in_words("pareto")
    'Pareto front'
    """
    return {
        "monte_carlo": _("Monte Carlo"),
        "sobol": _("Sobol indices"),
        "sweep": _("Sweep"),
        "map": _("Map"),
        "scenarios": _("Scenarios"),
        "optimize": _("Optimization"),
        "pareto": _("Pareto front"),
    }[kind]


@dataclass(frozen=True)
class Outcome(abc.ABC):
    """The outcome of a study.

    ``cases`` holds every case computed, the failed ones included with their reason; ``complete`` is False
    when the study was stopped.
    """

    title: str
    cases: Cases
    elapsed: float = field(default=0.0, kw_only=True)
    kind: ClassVar[str] = ""

    @property
    def complete(self) -> bool:
        """Whether every case was run."""
        return self.cases.complete

    @property
    def inputs(self) -> tuple[Variable, ...]:
        """The inputs that were varied."""
        return tuple(self.cases.subject.input(path) for path in self.cases.inputs)

    @property
    def outputs(self) -> tuple[Variable, ...]:
        """The figures that were computed."""
        return tuple(self.cases.subject.output(path) for path in self.cases.outputs)

    def column(self, path: str) -> np.ndarray:
        """All values of an input or a figure, SI; NaN where a case failed."""
        if path in self.cases.outputs:
            return self.cases.y[:, self.cases.outputs.index(path)]
        return self.cases.x[:, self.cases.inputs.index(path)]

    @abc.abstractmethod
    def findings(self) -> dict[str, Any]:
        """The numbers to read, as plain data."""

    @abc.abstractmethod
    def charts(self) -> dict[str, go.Figure]:
        """Charts by name."""

    def statistics(self) -> dict[str, dict[str, float | int | None]]:
        """Mean, spread and percentiles of each figure over the cases that gave a result; how many were run
        and failed stands beside them.
        """
        run = self.cases.codes != NOT_RUN
        return {path: statistics(self.column(path)[run]) for path in self.cases.outputs}

    def counts(self) -> dict[str, Any]:
        """How many cases ran, how many failed and why, and in how many some correlation was used outside its
        range.
        """
        run = int(np.sum(self.cases.codes != NOT_RUN))
        return {
            "cases": len(self.cases.codes),
            "run": run,
            "failed": run - int(self.cases.fine.sum()),
            "extrapolated": int(self.cases.extrapolated.sum()),
            "patient": int((self.cases.rungs > 0).sum()),
            "reasons": self.cases.reasons(),
        }

    @property
    def dataset(self) -> xr.Dataset:
        """Inputs, figures, ``code`` and ``reason`` along ``case``; attributes hold unit and label. SI
        units.
        """
        import xarray as xr

        columns: dict[str, Any] = {}
        for v, values, role in [
            *((v, self.cases.x[:, i], "input") for i, v in enumerate(self.inputs)),
            *((v, self.cases.y[:, i], "figure") for i, v in enumerate(self.outputs)),
        ]:
            name = v.path.replace("/", " per ")
            columns[name if name not in columns else f"{name} (figure)"] = (
                "case",
                values,
                {"units": v.unit, "long_name": v.label, "role": role},
            )
        codes = self.cases.codes
        columns["code"] = (
            "case",
            codes.astype("int32"),
            {"long_name": "0: fine, -1: some correlation outside its range, above: the code of the reason"},
        )
        columns["reason"] = ("case", np.array([self.cases.reason(i) for i in range(len(codes))], dtype=str))
        return xr.Dataset(
            columns,
            {"case": np.arange(len(codes))},
            {"title": self.title, "study": self.kind, "model": self.cases.subject.title},
        )

    def to_pandas(self) -> pd.DataFrame:
        """Every case a row: inputs and figures in SI, code and reason."""
        return self.dataset.to_dataframe()

    def _repr_html_(self) -> str:
        return notebooks.shown("granum.studies.report:print_study", self)

    def save(self, path: str | Path) -> None:
        """Write all cases to ``.nc`` (NetCDF), ``.parquet`` (needs pyarrow), ``.csv`` or ``.xlsx``, whole or
        not at all.
        """
        path = Path(path)
        check_file(path)
        data = self.dataset
        name = ""
        try:
            handle, name = tempfile.mkstemp(dir=path.parent, prefix=f".{path.name}.", suffix=path.suffix)
            os.close(handle)
            _write(data, name, path.suffix)
            os.chmod(name, 0o644)
            os.replace(name, path)
        except OSError as problem:
            raise InputError(
                _("'{path}' cannot be written: {reason}.").format(path=path, reason=reason_of(problem)),
                path=str(path),
            ) from None
        finally:
            if name:
                Path(name).unlink(missing_ok=True)

    def to_netcdf(self, path: str | Path) -> None:
        """Write all cases as NetCDF."""
        if Path(path).suffix != ".nc":
            raise InputError(
                _("'{path}': results are written as .nc, .parquet, .csv or .xlsx.").format(path=path),
                path=str(path),
            )
        self.save(path)

    def as_json(self, *, cases: int = 0) -> dict[str, Any]:
        """The stable ``study`` shape; with ``cases``, the first so many cases too (columns, SI)."""
        data: dict[str, Any] = {
            "study": self.kind,
            "title": self.title,
            "model": self.cases.subject.title,
            "complete": self.complete,
            "elapsed": self.elapsed,
            "inputs": [variable_json(v) for v in self.inputs],
            "outputs": [variable_json(v) for v in self.outputs],
            "counts": self.counts(),
            "notes": self.cases.notes,
            "findings": self.findings(),
        }
        if cases:
            paths = (*self.cases.inputs, *self.cases.outputs)
            data["cases"] = {p: [number(v) for v in self.column(p)[:cases]] for p in paths}
            data["cases_failed"] = [self.cases.reason(i) for i in range(min(cases, len(self.cases.codes)))]
        return data


def check_file(path: Path) -> None:
    """Complain early about a file that cannot be written."""
    if path.suffix not in FILES:
        raise InputError(
            _("'{path}': results are written as .nc, .parquet, .csv or .xlsx.").format(path=path),
            path=str(path),
        )
    if not (path.parent or Path()).is_dir():
        raise InputError(
            _("'{path}' cannot be written: there is no folder '{folder}'.").format(
                path=path, folder=path.parent
            ),
            path=str(path),
        )
    check_writable(path)


def _write(data: Any, name: str, suffix: str) -> None:
    if suffix == ".nc":
        data.to_netcdf(name, engine="h5netcdf")
        return
    frame = data.to_dataframe().reset_index()
    if suffix in (".csv", ".xlsx"):
        units = {n: data[n].attrs.get("units", "") for n in data.data_vars}
        headed = frame.rename(columns={n: f"{n} [{u}]" for n, u in units.items() if u})
        if suffix == ".xlsx":
            headed.to_excel(name, index=False, freeze_panes=(1, 1))
            return
        form = csv_form()
        headed.to_csv(name, index=False, sep=form.separator, decimal=form.decimal, encoding=form.encoding)
        return
    if find_spec("pyarrow") is None:
        raise InputError(_("Parquet needs pyarrow: pip install pyarrow, or write .nc, .csv or .xlsx."))
    frame.to_parquet(name, engine="pyarrow")


def statistics(values: np.ndarray) -> dict[str, float | int | None]:
    """Mean, standard deviation and percentiles of the cases that gave a result; ``cases`` were run,
    ``failed`` gave none.
    """
    good = values[np.isfinite(values)]
    counts: dict[str, float | int | None] = {"cases": len(values), "failed": len(values) - len(good)}
    if not len(good):
        return counts | dict.fromkeys(
            ("mean", "standard_deviation", "p5", "p10", "p50", "p90", "p95", "least", "most")
        )
    p5, p10, p50, p90, p95 = np.percentile(good, [5, 10, 50, 90, 95])
    found = {
        "mean": good.mean(),
        "standard_deviation": good.std(ddof=1) if len(good) > 1 else np.nan,
        "p5": p5,
        "p10": p10,
        "p50": p50,
        "p90": p90,
        "p95": p95,
        "least": good.min(),
        "most": good.max(),
    }
    return counts | {name: number(v) for name, v in found.items()}


def wilson(met: int, of: int) -> tuple[float, float]:
    """95 % interval of a probability from ``met`` successes (Wilson's score interval)."""
    z = 1.959963984540054
    share = met / of
    middle, reach = share + z * z / (2 * of), z * np.sqrt(share * (1 - share) / of + (z / (2 * of)) ** 2)
    return (max(0.0, (middle - reach) / (1 + z * z / of)), min(1.0, (middle + reach) / (1 + z * z / of)))


Limits = Mapping[str, tuple[float | None, float | None]]
"""Lower and upper limit of figures by path, SI; None where there is none."""


def meets(values: np.ndarray, limit: tuple[float | None, float | None]) -> np.ndarray:
    """Which values keep a limit; those that failed do not."""
    low, high = limit
    with np.errstate(invalid="ignore"):
        return (values >= (-np.inf if low is None else low)) & (values <= (np.inf if high is None else high))
