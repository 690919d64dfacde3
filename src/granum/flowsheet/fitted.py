"""What the fits that a line takes numbers from say about themselves, and where the line goes beyond what was
measured.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from granum.core import registry
from granum.core.i18n import _
from granum.estimation import Fit
from granum.estimation.results import by_fit
from granum.estimation.verdicts import note
from granum.flowsheet.sheet import Flowsheet
from granum.reports.quantities import defaults_text, range_text, value_text

NEAR = 1e-3  # of a condition: what two settings of the same may differ by


def fit_notices(fits: Mapping[str, tuple[Fit, str]], sheet: Flowsheet) -> list[dict[str, Any]]:
    """What the fits of a line say about themselves, once for each unit that they give something to, and where
    it is used beyond what was measured.
    """
    rows: list[dict[str, Any]] = []
    for fit, unit in (
        (fit, unit)
        for fit, given in by_fit(fits)
        for unit in dict.fromkeys(path.partition(".")[0] for path in given)
    ):
        rows += [{"unit": unit, **flag} for flag in fit.flags]
        told = defaults_text(fit.as_json())
        rows += (
            [{"unit": unit, **note("default", f"{registry.find(fit.card).card.title}: {told}", fit.card)}]
            if told
            else []
        )
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
        sentence = _(
            "{label} is {value}, but the test ({test}) was made at {range}: its estimates are extrapolated."
        ).format(
            label=p.label,
            value=value_text(value, p),
            test=registry.find(fit.card).card.title,
            range=range_text(low, high, p),
        )
        found.append(note("extrapolated", sentence, fit.card, p.name))
    return found
