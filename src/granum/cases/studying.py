"""Studies in a file: of the line in the same case file, of a line in another one (``case = "line.toml"``), or
of a formula (``card = "domain.name"`` with ``[inputs]``). ``[uncertain]``, ``[quantities]`` and ``[fits]``
are shared by its ``[study.NAME]`` tables.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from granum.cases.fitted import fits_of, fitted_values
from granum.cases.reading import build, parsed, text_of, validated
from granum.cases.schema import Case, Studied, StudyFile
from granum.core.errors import CaseError, GranumError
from granum.core.i18n import _
from granum.studies.lines import LineSubject
from granum.studies.study import Study
from granum.studies.subjects import FormulaSubject, Subject


@dataclass(frozen=True)
class Recipe:
    """The text of a file and where it stands: enough for another process to build the same model."""

    text: str
    folder: str
    name: str

    def build(self) -> Subject:
        """The model the file describes, its quantities included."""
        return _model(self)[0]


def read_studies(path: str | Path) -> dict[str, Study]:
    """The studies of a file by name.

    >>> studies = read_studies("examples/studies/settling.toml")  # doctest: +SKIP
    >>> studies["spread"].run().findings()  # doctest: +SKIP
    """
    path = Path(path)
    return studies_of_text(text_of(path), folder=path.parent, name=path.name)


def studies_of_text(text: str, folder: Path | None = None, name: str = "case") -> dict[str, Study]:
    """The studies of the text of a file; ``folder`` is where the files it names are looked for."""
    subject, declared, doubts = _model(Recipe(text, str((folder or Path()).resolve()), name))
    if not declared.study:
        raise CaseError(
            _("{name} declares no study: add a table [study.NAME] with a 'kind'.").format(name=name)
        )
    return {key: Study.of(key, table, subject, doubts) for key, table in declared.study.items()}


def studies_of_line(
    line: Any, tables: Mapping[str, Any], uncertain: Mapping[str, Any] | None = None
) -> dict[str, Study]:
    """Studies of a line that is already there, as a form would declare them."""
    subject = LineSubject.of(line)
    return {key: Study.of(key, table, subject, uncertain) for key, table in tables.items()}


def _model(recipe: Recipe) -> tuple[Subject, Studied, dict[str, Any]]:
    """Model, declarations and shared uncertainties of a file."""
    raw = parsed(recipe.text, recipe.name)
    folder = Path(recipe.folder)
    if raw.keys() & {"mixture", "units", "feeds", "streams"}:
        case = validated(Case, raw, recipe.name)
        return _line(case, case, folder, recipe)
    declared = validated(StudyFile, raw, recipe.name)
    if (declared.case is None) == (declared.card is None):
        raise CaseError(
            _(
                '{name}: name the model as case = "line.toml" or card = "domain.name", or write the '
                "studies into a case file."
            ).format(name=recipe.name)
        )
    if declared.case is not None:
        if declared.inputs:
            raise CaseError(
                _("{name}: [inputs] belong to a card; a line has its own.").format(name=recipe.name)
            )
        path = folder / declared.case
        case = validated(Case, parsed(text_of(path), path.name), path.name)
        return _line(case, declared, folder, recipe, path.parent)
    subject: Subject = FormulaSubject.of(declared.card, declared.inputs, recipe=recipe)
    fits = fits_of(declared.fits, folder)
    if fits:
        subject = FormulaSubject.of(declared.card, {**fitted_values(fits), **declared.inputs}, recipe=recipe)
    return subject.with_quantities(declared.quantities), declared, {**fits, **declared.uncertain}


def _line(
    case: Case, declared: Studied, folder: Path, recipe: Recipe, home: Path | None = None
) -> tuple[Subject, Studied, dict[str, Any]]:
    """A line with the studies of ``declared``, which may stand in another file than the case."""
    line = build(case, folder=home or folder)
    fits = fits_of(case.fits, home or folder)
    if declared is not case:
        own = fits_of(declared.fits, folder)
        line = line.with_values(**fitted_values(own))
        fits |= own
    quantities = {**case.quantities, **declared.quantities}
    try:
        subject = LineSubject.of(line, recipe=recipe).with_quantities(quantities)
    except GranumError as problem:
        raise CaseError(problem.message, **problem.details) from None
    return subject, declared, {**fits, **case.uncertain, **declared.uncertain}
