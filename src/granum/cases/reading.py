"""From a TOML file to a ``Line`` that can be solved, with messages that name the table and key at fault."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Any, TypeVar

import jax
import numpy as np
from pydantic import BaseModel, ValidationError
from pydantic_core import ErrorDetails

from granum.cases.fitted import fits_of, fitted_values
from granum.cases.schema import OWN, Case, DynamicTable, FeedTable, MixtureTable, StreamTable
from granum.core import registry
from granum.core.conversion import convert
from granum.core.documents import read_toml, wrong_sort
from granum.core.errors import CaseError, GranumError, InputError, reason_of, together, unknown_name
from granum.core.i18n import _
from granum.core.kinds import KINDS
from granum.core.parameters import Parameter
from granum.flowsheet import Flowsheet
from granum.flowsheet.dynamics import Profile, check_profiles, check_start
from granum.flowsheet.run import Line, Movement
from granum.flowsheet.specifications import Target, looked_at, varied
from granum.flowsheet.utilities import priced
from granum.materials.library import Library, including, session
from granum.streams.feeding import feed
from granum.streams.from_materials import mixture_of
from granum.streams.mixture import Mixture
from granum.streams.stream import Stream

Shape = TypeVar("Shape", bound=BaseModel)
Part = TypeVar("Part")
MOST_TOLD = 4  # problems of a file at once
MOST_STEPS = 100_000  # of a run in time
LARGEST_FILE = 2_000_000  # bytes; a case is a page of text


def read(path: str | Path) -> Line:
    """Open a case file.

    >>> line = read("examples/potassium-nitrate/line.toml")  # doctest: +SKIP
    """
    path = Path(path)
    return read_text(text_of(path), folder=path.parent, name=path.name)


def text_of(path: Path) -> str:
    """The text of a case file."""
    try:
        if path.stat().st_size > LARGEST_FILE:
            raise CaseError(
                _("'{path}' is larger than a case file can be.").format(path=path), path=str(path)
            )
        return path.read_text(encoding="utf-8")
    except OSError as problem:
        raise CaseError(
            _("'{path}' cannot be read: {reason}.").format(path=path, reason=reason_of(problem)),
            path=str(path),
        ) from None
    except UnicodeDecodeError:
        raise CaseError(
            _("'{path}' is not a text file in UTF-8.").format(path=path), path=str(path)
        ) from None


def read_text(text: str, folder: Path | None = None, name: str = "case") -> Line:
    """A line from the text of a case file; ``folder`` is where material files are looked for."""
    return build(validated(Case, parsed(text, name), name), folder=folder, text=text)


def parsed(text: str, name: str) -> dict[str, Any]:
    """The tables of a TOML text."""
    try:
        return read_toml(text)
    except InputError as problem:
        raise CaseError(
            _("{name} is not valid TOML: {problem}.").format(name=name, problem=problem)
        ) from None


def validated(shape: type[Shape], raw: Mapping[str, Any], name: str) -> Shape:
    """Tables checked against the shape of a file, or one clear message."""
    try:
        return shape.model_validate(raw)
    except ValidationError as problem:
        raise CaseError(_complaint(shape, name, problem)) from None


def _complaint(shape: type[Shape], name: str, problem: ValidationError) -> str:
    """What is wrong with a file: the first problem, and keys beside it that are missing or not known."""
    errors = problem.errors()
    for error in errors:
        # a stream may be a table or a pair: which of them was read is nobody's name
        error["loc"] = tuple(x for x in error["loc"] if x not in (StreamTable.__name__, "list[str]"))
    entering = [e["loc"] for e in errors if e["loc"][0] == "streams" and e["loc"][-1] in _feed_keys()]
    if entering:
        return f"{name}: {_entering(entering)}"
    first, *others = errors
    further = [e for e in others if e["type"] in ("missing", "extra_forbidden")]
    told = dict.fromkeys(_said(shape, e, name) for e in (first, *further))
    return f"{name}: " + " ".join(list(told)[:MOST_TOLD])


def _feed_keys() -> set[str]:
    return set(FeedTable.model_fields) - {"to"}


def _entering(places: list[tuple[Any, ...]]) -> str:
    """What enters the line was written as a stream between its units."""
    stream = places[0][1]
    keys = [str(place[-1]) for place in places if place[1] == stream]
    return _(
        "[{table}] connects two units and has no {keys}: what enters the line is written as [{feed}], "
        "with 'to'."
    ).format(table=f"streams.{stream}", keys=", ".join(map(repr, keys)), feed=f"feeds.{stream}")


def _said(shape: type[Shape], error: ErrorDetails, name: str) -> str:
    place = ".".join(str(part) for part in error["loc"])
    if error["type"] == "extra_forbidden":
        owner = _fields_at(shape, error["loc"][:-1])
        if owner:
            return unknown_name(
                _("Key"),
                str(error["loc"][-1]),
                owner,
                _("in [{place}]").format(place=".".join(map(str, error["loc"][:-1])) or name),
                meant="liquids" if error["loc"] == ("mixture", "solutes") else None,
            ).message
    if error["type"] == "missing":
        return _("'{place}' is missing.").format(place=place)
    return wrong_sort(error)


def _fields_at(shape: type[Shape], location: tuple[Any, ...]) -> list[str]:
    tables = {(): shape, ("mixture",): MixtureTable, ("feeds", "*"): FeedTable, ("streams", "*"): StreamTable}
    key = (
        tuple(location[:1]) + ("*",) * (len(location) > 1)
        if location and location[0] in ("feeds", "streams")
        else tuple(location[:1])
    )
    model = tables.get(key)
    return [f.alias or n for n, f in model.model_fields.items()] if model else []


def quantity(value: Any, kind: str, name: str, where: str) -> float:
    """One value of a case file as SI float."""
    return float(convert(value, Parameter(name, KINDS[kind]), " " + where))


def build(case: Case, folder: Path | None = None, text: str = "") -> Line:
    """The line a validated case describes."""
    try:
        mixture = _mixture(case, folder)
    except GranumError as problem:
        raise CaseError(
            problem.message if "[mixture" in problem.message else f"[mixture] {problem.message}",
            **problem.details,
        ) from None
    problems: list[CaseError] = []
    feeds = _each(case.feeds, lambda name, table: _feed(name, table, mixture), problems)
    made = _each(case.units, lambda name, table: _unit(name, dict(table)), problems)
    if problems:
        raise together(problems)
    units = {name: _with_materials(unit, mixture.materials) for name, unit in made.items()}
    links: dict[str, tuple[str, str]] = {name: ("", table.to) for name, table in case.feeds.items()}
    for name, table in case.streams.items():
        if name in links:
            raise CaseError(_("[streams] '{name}': a feed has the same name.").format(name=name))
        if isinstance(table, list):
            if len(table) not in (1, 2):
                raise CaseError(
                    _('[streams] \'{name}\': write it as ["unit.outlet", "unit.inlet"].').format(name=name)
                )
            table = StreamTable.model_validate({"from": table[0], "to": table[1] if len(table) == 2 else ""})
        links[name] = (table.origin, table.target)
    sheet = Flowsheet(units, feeds, links)
    fits = fits_of(case.fits, folder)
    if fits:
        sheet = sheet.with_values(fitted_values(fits))
    targets = tuple(_target(name, spec, sheet) for name, spec in case.specifications.items())
    _require_independent(case, targets)
    try:
        prices = priced(sheet, case.prices, _("in [prices]"))
    except GranumError as problem:
        raise CaseError(f"[prices] {problem.message}", **problem.details) from None
    told = {
        "description": case.description,
        "project": case.report.project,
        "author": case.report.author,
        "date": case.report.date,
    }
    return Line(
        case.title,
        sheet,
        targets,
        None if case.dynamic is None else movement(case.dynamic, sheet),
        text,
        fits,
        told,
        prices,
    )


def _each(
    tables: Mapping[str, Any], make: Callable[[str, Any], Part], problems: list[CaseError]
) -> dict[str, Part]:
    """What is made of the tables by name; where one is at fault, the next are looked at all the same."""
    made: dict[str, Part] = {}
    for name, table in tables.items():
        try:
            made[name] = make(name, table)
        except CaseError as problem:
            problems.append(problem)
    return made


def own_materials(tables: Mapping[str, Any]) -> dict[str, Any]:
    """The tables of a case that describe materials, as a materials file has them."""
    return {sort: dict(tables[sort]) for sort in OWN if tables.get(sort)}


@contextmanager
def knowing_own(raw: Mapping[str, Any], folder: Path | None = None) -> Iterator[None]:
    """What a case describes itself, and the files it names, are known by name as the library is; where they
    cannot be read, the library alone.
    """
    mixture = raw.get("mixture")
    files = mixture.get("materials", []) if isinstance(mixture, dict) and folder else []
    own = [folder / str(file) for file in files] if folder and isinstance(files, list) else []
    try:
        library = session().with_own([*own, *filter(None, [own_materials(raw)])])
    except (GranumError, AttributeError, TypeError):
        library = session()
    with including(library):
        yield


def _mixture(case: Case, folder: Path | None) -> Mixture:
    table, s = case.mixture, case.mixture.sizes
    if s.boundaries is not None:
        edges = np.asarray(
            convert(
                s.boundaries,
                Parameter("boundaries", KINDS["Distance"], series="classes"),
                _(" in [mixture.sizes]"),
            )
        )
    else:
        if s.smallest is None or s.largest is None:
            raise CaseError(_("[mixture.sizes] needs 'smallest' and 'largest', or 'boundaries'."))
        low, high = (
            quantity(v, "Length", n, "in [mixture.sizes]")
            for n, v in (("smallest", s.smallest), ("largest", s.largest))
        )
        if low >= high:
            raise CaseError(_("[mixture.sizes] 'smallest' must be below 'largest'."))
        edges = np.geomspace(low, high, s.classes + 1)
    axes = tuple((name, tuple(axis.boundaries)) for name, axis in table.axes.items())
    own: list[Any] = [(folder or Path()) / file for file in table.materials]
    own += filter(None, [own_materials(dict(case))])
    return mixture_of(table.liquids, table.solids, table.gases, edges, axes=axes, own=own)


def _feed(name: str, table: FeedTable, mixture: Mixture) -> Stream:
    words = {n: value for n, value in table if n not in ("to", "sizes")}
    sizes = None if table.sizes is None else {n: value for n, value in table.sizes if value is not None}
    try:
        return feed(mixture, sizes=sizes, where=_("in [feeds.{name}]").format(name=name), **words)
    except GranumError as problem:
        place = f"feeds.{name}]"
        told = problem.message if place in problem.message else f"[{place} {problem.message}"
        raise CaseError(told, **{**problem.details, "unit": name}) from None


def _unit(name: str, table: dict[str, Any]) -> Any:
    model = table.pop("model", None)
    if not isinstance(model, str):
        raise CaseError(
            _("[units.{name}] needs 'model', such as model = \"streams.mixer\".").format(name=name), unit=name
        )
    try:
        thing = registry.find(model)
        if thing.card.sort != "equipment":
            raise InputError(
                _("'{model}' is a {sort}, not equipment.").format(model=model, sort=_(thing.card.sort))
            )
        return thing(**table)
    except GranumError as problem:
        raise CaseError(f"[units.{name}] {problem.message}", **{**problem.details, "unit": name}) from None


def _with_materials(unit: Any, materials: Library) -> Any:
    """The unit, its laws that look for a material by name finding those of the case."""

    def looks(part: Any) -> bool:
        return hasattr(type(part), "with_materials")

    return jax.tree.map(
        lambda part: part.with_materials(materials) if looks(part) else part, unit, is_leaf=looks
    )


def _target(name: str, spec: Any, sheet: Flowsheet) -> Target:
    where = _("in [specifications.{name}]").format(name=name)
    try:
        parameter, result = varied(sheet, spec.vary), looked_at(sheet, spec.so_that)
    except GranumError as problem:
        raise CaseError(f"[specifications.{name}] {problem.message}", specification=name) from None
    low, high = (float(convert(v, parameter, " " + where)) for v in (spec.lower, spec.upper))
    wanted = float(convert(spec.equals, result, " " + where))
    return Target(spec.vary, spec.so_that, wanted, low, high)


def _require_independent(case: Case, targets: tuple[Target, ...]) -> None:
    """As many parameters to find as results to meet, each once."""
    names = list(case.specifications)
    for place, reason in (
        (
            "vary",
            _(
                "both vary '{what}': one parameter cannot meet two conditions. Vary another parameter "
                "in one of them, or drop one."
            ),
        ),
        ("so_that", _("both fix '{what}': the line is over-specified. Drop one of them.")),
    ):
        seen: dict[str, str] = {}
        for name, target in zip(names, targets, strict=True):
            what = getattr(target, place)
            if what in seen:
                pair = _("Specifications '{first}' and '{second}'").format(first=seen[what], second=name)
                raise CaseError(f"{pair} {reason.format(what=what)}", specification=name)
            seen[what] = name
    for name, target in zip(names, targets, strict=True):
        if not target.lower < target.upper:
            raise CaseError(
                _("[specifications.{name}] 'lower' must be below 'upper'.").format(name=name),
                specification=name,
            )


def movement(table: DynamicTable, sheet: Flowsheet) -> Movement:
    """Times, disturbances and start of a run in time."""
    where = _("in [dynamic]")
    duration, step = (quantity(getattr(table, n), "Time", n, where) for n in ("duration", "step"))
    if not 0.0 < step <= duration:
        raise CaseError(_("[dynamic] 'step' must be above zero and not longer than 'duration'."))
    if duration / step > MOST_STEPS:
        raise CaseError(
            _("[dynamic] asks for {count} steps; at most {most} are run.").format(
                count=f"{duration / step:.3g}", most=MOST_STEPS
            )
        )
    try:
        check_start(sheet, table.start)
    except GranumError as problem:
        raise CaseError(f"[dynamic] {problem.message}", **problem.details) from None
    profiles = []
    for name, change in table.disturbances.items():
        place = _("in [dynamic.disturbances.{name}]").format(name=name)
        head, _dot, field = change.vary.partition(".")
        if head in sheet.feeds and field == "mass_flow":
            kind = KINDS["MassFlow"]
        else:
            sheet.locate(change.vary)
            kind = (
                type(sheet.units[head]).card.parameter(field).kind
                if head in sheet.units and "." not in field
                else KINDS["Number"]
            )
        values = convert(change.values, Parameter("values", kind, series="points"), " " + place)
        times = convert(change.times, Parameter("times", KINDS["Time"], series="points"), " " + place)
        profiles.append(Profile(change.vary, np.asarray(times, dtype=float), np.asarray(values, dtype=float)))
    check_profiles(sheet, tuple(profiles))
    return Movement(np.arange(0.0, duration + 0.5 * step, step), tuple(profiles), table.start)
