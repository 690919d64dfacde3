"""Lab data in a case file: each test is read and fitted, and its estimates become inputs of the line with their uncertainty."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from granum.cases.schema import FitTable
from granum.core import registry
from granum.core.errors import CaseError, GranumError, InputError, unknown_name
from granum.core.i18n import _
from granum.estimation import Fit
from granum.estimation.verdicts import note
from granum.flowsheet import Flowsheet
from granum.reports.quantities import defaults_text, range_text, value_text

NEAR = 1e-3  # of a condition: what two settings of the same may differ by


def fits_of(tables: Mapping[str, FitTable], folder: Path | None) -> dict[str, tuple[Fit, str]]:
    """Fit and estimate by input of the line. The fit of one table is shared, so that correlations are kept."""
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
            _("'{key}' is a {sort}, not a lab test; 'granum list --sort \"lab test\"' shows those.").format(
                key=table.test, sort=_(thing.card.sort)
            )
        )
    return thing.read(folder / table.data, **table.conditions).fit()


def fit_notices(fits: Mapping[str, tuple[Fit, str]], sheet: Flowsheet) -> list[dict[str, Any]]:
    """What the fits of a line say about themselves, once for each unit that they give something to, and where it is used beyond what was measured."""
    rows: list[dict[str, Any]] = []
    seen: set[tuple[str, int]] = set()
    for path, (fit, _name) in fits.items():
        unit = path.partition(".")[0]
        if (unit, id(fit)) in seen:
            continue
        seen.add((unit, id(fit)))
        rows += [{"unit": unit, **flag} for flag in fit.flags]
        told = defaults_text(fit.as_json())
        rows += [{"unit": unit, **note("default", f"{registry.find(fit.card).card.title}: {told}", fit.card)}] if told else []
        model = sheet.units.get(unit)
        rows += [{"unit": unit, **flag} for flag in _beyond(fit, model)] if model is not None else []
    return rows


def _beyond(fit: Fit, model: Any) -> list[dict[str, Any]]:
    """Conditions of a unit outside those of the test."""
    found = []
    for p in model.card.parameters:
        value = getattr(model, p.name, None)
        if p.name not in fit.ranges or value is None or np.ndim(value) > 0:
            continue
        low, high = fit.ranges[p.name]
        if low * (1.0 - NEAR) <= float(value) <= high * (1.0 + NEAR):
            continue
        sentence = _("{label} is {value}, but the test ({test}) was made at {range}: its estimates are extrapolated.").format(
            label=p.label, value=value_text(value, p), test=registry.find(fit.card).card.title, range=range_text(low, high, p)
        )
        found.append(note("extrapolated", sentence, fit.card, p.name))
    return found


def fitted_values(fits: Mapping[str, tuple[Fit, str]]) -> dict[str, float]:
    """The estimates as values of inputs, SI."""
    return {path: fit[name].value for path, (fit, name) in fits.items()}
