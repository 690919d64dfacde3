"""Lab data in a case file: each test is read and fitted, and its estimates become inputs of the line with
their uncertainty.
"""

from __future__ import annotations

import io
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from granum.cases.schema import FitTable
from granum.core import registry
from granum.core.errors import CaseError, GranumError, InputError, unknown_name
from granum.core.i18n import _
from granum.estimation import Fit


def fits_of(tables: Mapping[str, FitTable], folder: Path | None) -> dict[str, tuple[Fit, str]]:
    """Fit and estimate by input of the line. The fit of one table is shared, so that correlations are
    kept.
    """
    found: dict[str, tuple[Fit, str]] = {}
    for name, table in tables.items():
        try:
            fit = _fitted(table, folder or Path())
            for path, estimate in table.gives.items():
                known = {**fit.parameters, **fit.derived}
                if estimate not in known:
                    raise unknown_name(_("Estimate"), estimate, known)
                if path in found:
                    raise InputError(_("'{name}' is given by two fits.").format(name=path), name=path)
                found[path] = (fit, estimate)
        except GranumError as problem:
            raise CaseError(f"[fits.{name}] {problem.message}", **problem.details) from None
    return found


def _fitted(table: FitTable, folder: Path) -> Fit:
    thing: Any = registry.find(table.test)
    if thing.card.sort != "lab test":
        raise InputError(
            _("'{key}' ({sort}) is not a lab test; 'granum list --sort \"lab test\"' shows those.").format(
                key=table.test, sort=_(thing.card.sort)
            )
        )
    return thing.read(_data_of(table, folder), **table.conditions).fit()


def _data_of(table: FitTable, folder: Path) -> Any:
    """The data file, or the table itself where the case holds it."""
    if not table.holds_data:
        return folder / table.data
    source = io.BytesIO(table.data.encode())
    source.name = "data.csv"
    return source


def fitted_values(fits: Mapping[str, tuple[Fit, str]]) -> dict[str, float]:
    """The estimates as values of inputs, SI."""
    return {path: fit[name].value for path, (fit, name) in fits.items()}
