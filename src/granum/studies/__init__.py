"""Studies: Monte Carlo, Sobol indices, sweeps, maps, scenarios, optimization and Pareto fronts of any line or
formula.

``monte_carlo(line, {"filter.cake_resistance": fit})`` and its neighbours take a line (``granum.read``), a
flowsheet, a formula or the key of a card; ``Study`` is a study declared in a table (case file or form). See
``granum.studies.study``.
"""

from __future__ import annotations

from typing import Any

_HOME = {
    "Study": "study",
    "KINDS": "study",
    "Outcome": "outcome",
    "Progress": "engine",
    "evaluate": "engine",
    "subject_of": "lines",
    "FormulaSubject": "subjects",
    "LineSubject": "lines",
    "monte_carlo": "ensembles",
    "sobol": "ensembles",
    "sweep": "grids",
    "parameter_map": "grids",
    "scenarios": "grids",
    "optimize": "optimizing",
    "pareto": "fronts",
}


def __getattr__(name: str) -> Any:
    from importlib import import_module

    if name in _HOME:
        return getattr(import_module(f"granum.studies.{_HOME[name]}"), name)
    raise AttributeError(f"granum.studies has no '{name}'")


def __dir__() -> list[str]:
    return sorted(_HOME)
