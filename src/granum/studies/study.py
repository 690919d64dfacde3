"""``Study``: a study as a case file or a form declares it, checked, ready to run.

A study is a table with a ``kind``. Its figures are paths, expressions over them, and quantities, which
have a name::

    [quantities]
    heat_per_product = "dryer.heat_duty / crystals.solid_flow"

    [study.sizes]
    kind = "monte_carlo"  # or sobol, sweep, map, scenarios, optimize, pareto
    samples = 2000
    outputs = ["filter.moisture_dry_basis", "heat_per_product", "fines.solid_flow / crystals.solid_flow"]

``Study.of(name, table, subject, uncertain)`` checks the table; ``study.run(progress=…, cancel=…)`` computes
it and gives an ``Outcome`` with ``findings()``, ``as_json()``, ``charts()`` and ``save(path)``.
"""

from __future__ import annotations

import inspect
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

from granum.core.errors import GranumError, InputError, unknown_name
from granum.core.i18n import _
from granum.studies import ensembles, fronts, grids, optimizing
from granum.studies.engine import Cancel, Report
from granum.studies.outcome import Outcome, kind_in_words
from granum.studies.subjects import Subject


@dataclass(frozen=True)
class Kind:
    """A kind of study: the function that runs it, the keys of its table, and whether it takes uncertain
    inputs.
    """

    run: Callable[..., Outcome]
    uncertain: bool = False
    chunks: bool = True

    @property
    def keys(self) -> tuple[str, ...]:
        """Keys of its table, as the function declares them."""
        hidden = ("thing", "fixed", "how", "progress", "cancel", "uncertain")
        return tuple(name for name in inspect.signature(self.run).parameters if name not in hidden)

    @property
    def needed(self) -> tuple[str, ...]:
        """Keys that must be there."""
        found = inspect.signature(self.run).parameters
        return tuple(n for n in self.keys if found[n].default is inspect.Parameter.empty)


KINDS: dict[str, Kind] = {
    "monte_carlo": Kind(ensembles.monte_carlo, uncertain=True),
    "sobol": Kind(ensembles.sobol, uncertain=True),
    "sweep": Kind(grids.sweep),
    "map": Kind(grids.parameter_map),
    "scenarios": Kind(grids.scenarios),
    "optimize": Kind(optimizing.optimize, uncertain=True, chunks=False),
    "pareto": Kind(fronts.pareto, chunks=False),
}


@dataclass(frozen=True)
class Study:
    """A declared study. Frozen; ``with_options`` changes one."""

    name: str
    kind: str
    subject: Subject
    options: Mapping[str, Any]
    uncertain: Mapping[str, Any] = field(default_factory=dict)

    @staticmethod
    def of(
        name: str, table: Mapping[str, Any], subject: Subject, uncertain: Mapping[str, Any] | None = None
    ) -> Study:
        """The study a table declares. ``uncertain`` are the distributions shared by all studies of a file;
        the table's own come on top.
        """
        where = _("in [study.{name}]").format(name=name)
        options = dict(table)
        kind = options.pop("kind", name if name in KINDS else None)
        if kind not in KINDS:
            raise unknown_name(_("Kind of study"), str(kind or ""), KINDS, where)
        own = options.pop("uncertain", {})
        _check_form("uncertain", own, where)
        doubts = {**(uncertain or {}), **own}
        known = KINDS[kind]
        for key in options:
            if key not in known.keys:
                raise unknown_name(_("Key"), key, (*known.keys, "kind", "uncertain"), where)
            _check_form(key, options[key], where)
        for key in known.needed:
            if key not in options:
                raise InputError(
                    _("{where}: a {kind} study needs '{key}'.").format(where=where, kind=kind, key=key),
                    name=key,
                )
        return Study(name, kind, subject, options, doubts)

    @property
    def title(self) -> str:
        """Title, as declared, or the kind in words when its name tells no more."""
        own = kind_in_words(self.kind) if self.name == self.kind else self.name.replace("_", " ")
        return str(self.options.get("title") or own)

    @property
    def kept_in_parts(self) -> bool:
        """Whether it computes in chunks that can be kept on disk."""
        return KINDS[self.kind].chunks

    def takes(self, key: str) -> bool:
        """Whether a study of this kind has an option."""
        return key in KINDS[self.kind].keys

    def with_options(self, **changes: Any) -> Study:
        """The same study with other options; None leaves one as it is."""
        given = {k: v for k, v in changes.items() if v is not None}
        for key in given:
            if key not in KINDS[self.kind].keys:
                raise InputError(
                    _("A {kind} study has no '{key}'.").format(kind=self.kind, key=key), name=key
                )
        return replace(self, options={**self.options, **given})

    def run(
        self,
        *,
        progress: Report | None = None,
        cancel: Cancel | None = None,
        folder: str | Path | None = None,
        workers: Any = None,
    ) -> Outcome:
        """Compute the study.

        Parameters
        ----------
        progress: called now and then with ``Progress(done, total, failed, note)``.
        cancel: asked now and then; True stops, and the outcome holds what is done (``complete`` False).
        folder: where finished chunks are kept, so that the same call continues after a kill.
        workers: number of local Dask workers, or the address of a scheduler.
        """
        known = KINDS[self.kind]
        options = {"title": self.title, **self.options}
        if known.uncertain:
            options["uncertain"] = self.uncertain
        if workers is not None and not known.chunks:
            raise InputError(
                _("A {kind} study has no '{key}'.").format(kind=self.kind, key="workers"), name="workers"
            )
        if known.chunks:
            options |= {"folder": folder, "workers": workers}
        try:
            return known.run(self.subject, progress=progress, cancel=cancel, **options)
        except GranumError as problem:
            where = f"[study.{self.name}]"
            if where in problem.message:
                raise
            problem.message = f"{where} {problem.message}"
            raise


_FORMS: dict[str, tuple[Any, str]] = {
    "title": (str, "text"),
    "outputs": (list, "list of figures"),
    "over": (Mapping, "table"),
    "limits": (Mapping, "table"),
    "cases": (Mapping, "table"),
    "method": (str, "text"),
    "minimize": (str, "text"),
    "maximize": (str, "text"),
    "objectives": (list, "list of tables"),
    "probability": (float, "number"),
    "uncertain": (Mapping, "table"),
}


def _check_form(key: str, value: Any, where: str) -> None:
    """Complain when a key holds a value of the wrong sort; counts are checked where they are used."""
    wanted, word = _FORMS.get(key, (object, ""))
    inner = (
        key == "cases"
        and isinstance(value, Mapping)
        and not all(isinstance(v, Mapping) for v in value.values())
    )
    if not isinstance(value, wanted) or isinstance(value, bool) or inner:
        raise InputError(
            _("{where}: '{key}' must be a {form}.").format(where=where, key=key, form=_(word or "table")),
            name=key,
        )
