"""``granum`` on the command line: calc, fit, run, study, chart, list, show, app. Holds no physics."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from granum.core.errors import ConvergenceError, InputError
from granum.core.garbage import collect_seldom
from granum.core.i18n import _
from granum.core.written import interval
from granum.shell import (
    SHARED,
    Commands,
    choose_language,
    choose_units,
    emit,
    keep_compiled_code,
    one_message,
    pairs,
    tell_version,
    to_the_end,
)

if TYPE_CHECKING:
    from granum.core.index import Entry

app = typer.Typer(
    name="granum",
    cls=Commands,
    help="Fluid–solid unit operations: calculate, fit lab data, run process lines.",
    no_args_is_help=True,
    add_completion=False,
    pretty_exceptions_enable=False,
    rich_markup_mode=None,
)

Pairs = Annotated[
    list[str] | None,
    typer.Argument(help="Inputs as name=value, with units: particle_diameter=85um.", show_default=False),
]
Json = Annotated[bool, typer.Option("--json", help="Print JSON alone.")]
Key = Annotated[str, typer.Argument(help="Card, as domain.name; see 'granum list'.")]
CaseFile = Annotated[Path, typer.Argument(help="Case file (TOML).")]


@app.callback()
def _options(
    lang: Annotated[str, typer.Option("--lang", help=SHARED["--lang"][1], envvar="GRANUM_LANG")] = "",
    units: Annotated[str, typer.Option("--units", help=SHARED["--units"][1], envvar="GRANUM_UNITS")] = "",
    version: Annotated[
        bool,
        typer.Option("--version", help="Show the version and end.", callback=tell_version, is_eager=True),
    ] = False,
) -> None:
    choose_units(units)
    choose_language(lang)


@app.command()
@one_message
def calc(
    key: Key,
    inputs: Pairs = None,
    as_json: Json = False,
    solve: Annotated[
        str,
        typer.Option(
            help="An input to find: the wanted result stands among the inputs. Of equipment, 'size' is what "
            "it is sized by."
        ),
    ] = "",
    report: Annotated[Path | None, typer.Option(help="Write a calculation sheet (HTML).")] = None,
) -> None:
    """Evaluate a formula, a law or a procedure; solve a piece of equipment alone.

    Equipment begins with an ordinary feed; what enters is said by port: feed.solid_flow=400kg/h,
    mixture.solids=quartz.
    """
    from granum.core import registry

    thing = registry.find(key)
    if thing.card.sort == "equipment":
        _operate(key, pairs(inputs), as_json, solve)
        return
    if not hasattr(thing, "evaluate"):
        hint = {"lab test": "granum fit {key} data.csv …"}.get(thing.card.sort, "granum show {key}")
        raise InputError(
            _("'{key}' is a {sort}, which 'calc' cannot evaluate; use: {hint}").format(
                key=key, sort=_(thing.card.sort), hint=hint.format(key=key)
            )
        )
    given, within = pairs(inputs), {}
    if solve:
        from granum.studies.inverse import find_input

        result = find_input(thing, solve, **given).result
    elif thing.card.sort != "law" and any(map(interval, given.values())):
        from granum.studies.intervals import with_intervals

        result, within = with_intervals(thing, **given)
    else:
        result = thing.evaluate(**given)
    if report is not None:
        from granum.core.files import write_atomic
        from granum.reports.calculation import calculation_sheet
        from granum.studies.intervals import stated

        told = {name: (i.text, i.how) for name, i in within.items()}
        typed = stated(thing.card, given) if within else {}
        write_atomic(report, calculation_sheet(thing, result, within=told, stated=typed))
    if as_json:
        emit(
            result.as_json() | ({"intervals": {n: i._asdict() for n, i in within.items()}} if within else {})
        )
    else:
        from granum.reports.terminal import print_result

        print_result(result, {name: f"{i.text} ({i.how})" for name, i in within.items()})
        if report is not None:
            print(_("saved to {path}").format(path=report))


def _operate(key: str, inputs: Mapping[str, str], as_json: bool, solve: str) -> None:
    """A piece of equipment in a line of its own; sized where something is to be found."""
    from granum.cases.alone import as_words, assumed, case_text
    from granum.cases.reading import read_text
    from granum.reports.terminal_run import print_run

    if solve:
        from granum.cases.sizing import doubts, sought

        found = sought(key, inputs, "" if solve == "size" else solve)
        outcome = read_text(found.text, name=key).solve()
        rest = assumed(key, found.words | {found.path.partition(".")[2]: outcome.found[found.path]})
        against = doubts(outcome)
    else:
        outcome = read_text(case_text(key, as_words(key, inputs)), name=key).solve()
        rest, against = assumed(key, inputs), ""
    if as_json:
        told = {"assumed": rest} | ({"doubts": against} if against else {})
        emit(outcome.as_json() | told | _advice(outcome))
    else:
        print_run(outcome)
        if against:
            print(against)
        _print_advice(outcome)
        _print_assumed(rest)


def _advice(outcome: Any) -> dict[str, Any]:
    """Which machines suit better than those that fail their checks, as plain data."""
    from granum.cases.choosing import advice

    found = {name: one.as_json() for name, one in advice(outcome).items()}
    return {"advice": found} if found else {}


def _print_advice(outcome: Any) -> None:
    for name, one in _advice(outcome).get("advice", {}).items():
        print(f"{name}: {one['told']}\n  {one['command']}")


def _print_assumed(rest: Mapping[str, str]) -> None:
    told = ", ".join(f"{word}={value}" for word, value in rest.items())
    print(_("Not said, hence as in the example: {words}").format(words=told or "—"))


@app.command()
@one_message
def fit(
    key: Key,
    data: Annotated[Path, typer.Argument(help="CSV or XLSX with units in the header.")],
    conditions: Pairs = None,
    as_json: Json = False,
    chart: Annotated[Path | None, typer.Option(help="Save the chart of the fit as HTML.")] = None,
    estimate: Annotated[
        list[str] | None,
        typer.Option(help="Of a formula or law: a parameter to find, as NAME or NAME=first value."),
    ] = None,
    output: Annotated[str, typer.Option(help="Of a formula with several results: the measured one.")] = "",
    robust: Annotated[
        bool, typer.Option("--robust", help="Of a formula or law: stray points lose their pull (Huber).")
    ] = False,
    next_point: Annotated[
        bool, typer.Option("--next", help="Where the next measurement tells most.")
    ] = False,
) -> None:
    """Fit a lab test, a formula or a law to a data file: parameters with 95 % intervals."""
    from granum.core import registry

    thing = registry.find(key)
    if thing.card.sort == "lab test":
        if estimate or output or robust:
            raise InputError(
                _("A lab test knows what it estimates: leave out --estimate, --output and --robust.")
            )
        test = thing.read(data, **pairs(conditions))
        found = test.fit()
    else:
        from granum.estimation import CardData, Huber

        wanted = {
            name: value or None for name, _equals, value in (word.partition("=") for word in estimate or ())
        }
        test = CardData.read(thing, data, estimate=wanted, fixed=pairs(conditions), output=output)
        found = test.fit(Huber() if robust else None)
    told = test.next_measurement(found) if next_point else None
    if chart is not None:
        from granum.core.charts import as_html
        from granum.core.files import write_atomic

        write_atomic(chart, as_html(test.chart(), page=True))
    if as_json:
        emit(found.as_json() | ({"next": told} if told is not None else {}))
    else:
        from granum.reports.terminal import print_fit, print_next

        print_fit(found, saved=chart)
        if told is not None:
            print_next(told, found)


def _unsolved(problem: ConvergenceError, as_json: bool, partial: bool) -> None:
    """The last iterate of a line without solution, for those who ask for it; it is said to be no result."""
    if not partial or problem.last is None:
        return
    if as_json:
        problem.details["partial"] = problem.last.as_json()  # type: ignore[attr-defined]
        return
    from granum.reports.terminal_run import print_run

    print_run(problem.last, partial=True)


@app.command()
@one_message
def run(
    case: CaseFile,
    as_json: Json = False,
    report: Annotated[Path | None, typer.Option(help="Write an HTML report.")] = None,
    tables: Annotated[
        Path | None, typer.Option(help="Write streams, sizes, results and checks as .csv or .xlsx.")
    ] = None,
    minutes: Annotated[float, typer.Option(min=0.01, help="The most time to spend on solving.")] = 15.0,
    partial: Annotated[
        bool,
        typer.Option(
            "--partial",
            help="Of a line without solution: print the last iterate all the same, marked as such.",
        ),
    ] = False,
) -> None:
    """Solve a case file: streams, sizes, duties, checks, audit."""
    from granum.cases import read
    from granum.flowsheet.watching import Watch
    from granum.reports.progress import watching, working

    with working(_("Reading {file}").format(file=case.name), quiet=as_json):
        line = read(case)
    with watching(_("Solving {title}").format(title=line.title), quiet=as_json) as tell:
        watch = Watch(tell, 60.0 * minutes)
        try:
            outcome = line.solve(watch)
        except ConvergenceError as problem:
            _unsolved(problem, as_json, partial or watch.stopped)
            raise
    if report is not None:
        with working(_("Writing the report"), quiet=as_json):
            outcome.report(report, {n: one["told"] for n, one in _advice(outcome).get("advice", {}).items()})
    if tables is not None:
        outcome.tables(tables)
    if as_json:
        emit(outcome.as_json() | _advice(outcome))
    else:
        from granum.reports.terminal_run import print_run

        print_run(outcome, saved=[p for p in (report, tables) if p is not None])
        _print_advice(outcome)


@app.command()
@one_message
def study(
    model: Annotated[
        str,
        typer.Argument(
            metavar="CASE|CARD", help="Case or study file (TOML), or a formula, law or piece of equipment."
        ),
    ],
    names: Annotated[
        list[str] | None,
        typer.Argument(
            metavar="[STUDY|name=value]...",
            help=(
                "Of a file: the studies to run, all when none is named. Of a card: its inputs; 0.3..0.8bar "
                "is a range, 1e7+-30% a spread."
            ),
            show_default=False,
        ),
    ] = None,
    as_json: Json = False,
    samples: Annotated[
        int | None, typer.Option(help="Number of samples, instead of what the file says.")
    ] = None,
    seed: Annotated[
        int | None, typer.Option(help="Seed of the samples, instead of what the file says.")
    ] = None,
    sobol: Annotated[
        bool, typer.Option("--sobol", help="Of a card: what moves the results (Sobol indices).")
    ] = False,
    minimize: Annotated[str, typer.Option(help="Of a card: the result to make least over the ranges.")] = "",
    maximize: Annotated[
        str, typer.Option(help="Of a card: the result to make greatest over the ranges.")
    ] = "",
    limit: Annotated[
        list[str] | None, typer.Option(help="Of a card: a result to keep, as NAME<=VALUE or NAME>=VALUE.")
    ] = None,
    output: Annotated[
        list[str] | None,
        typer.Option(help="Of a card: a result to show; of equipment the first six when none is named."),
    ] = None,
    steps: Annotated[int | None, typer.Option(min=2, help="Of a card: points along each range.")] = None,
    out: Annotated[
        Path | None,
        typer.Option(
            "--out",
            "-o",
            help="Write all cases as .nc, .parquet, .csv or .xlsx; a killed study continues from FILE.parts.",
        ),
    ] = None,
    report: Annotated[Path | None, typer.Option(help="Write an HTML report with charts.")] = None,
    workers: Annotated[
        str | None, typer.Option(help="Number of local Dask workers, or address of a Dask scheduler.")
    ] = None,
) -> None:
    """Run the studies of a file, or of one card: Monte Carlo, Sobol indices, sweeps, maps, scenarios,
    optimization, Pareto fronts.
    """
    from granum.cases.reading import text_of
    from granum.cases.studying import studies_of_text
    from granum.core.errors import unknown_name
    from granum.core.files import check_writable
    from granum.reports.progress import advancing, working
    from granum.studies.report import stoppable

    case, rest = Path(model), None
    of_card = {
        "minimize": minimize,
        "maximize": maximize,
        "sobol": sobol,
        "limit": limit or [],
        "output": output or [],
        "steps": steps,
    }
    with working(_("Reading {file}").format(file=case.name), quiet=as_json):
        if case.suffix == ".toml" or case.exists():
            for option, given in of_card.items():
                if given:
                    raise InputError(
                        _("--{option} is of a card: the file says it in its [study] tables.").format(
                            option=option
                        )
                    )
            text, wanted = text_of(case), names or []
            known = studies_of_text(text, folder=case.parent, name=case.name)
        else:
            from granum.cases.worded import study_text
            from granum.core import registry

            if registry.find(model).card.sort == "equipment":
                from granum.cases.alone import assumed

                rest = assumed(model, pairs(names))
            text, wanted = study_text(model, pairs(names), samples=samples, **of_card), []
            known = studies_of_text(text, name=model)
    for name in wanted:
        if name not in known:
            raise unknown_name(_("Study"), name, known, _("in {file}").format(file=case.name))
    picked = [known[name] for name in wanted or known]
    if out is not None:
        from granum.studies.outcome import check_file

        check_file(out)
    if report is not None:
        check_writable(report)
    outcomes, saved = [], []
    for one in picked:
        one = one.with_options(
            **{k: v for k, v in (("samples", samples), ("seed", seed)) if one.takes(k) or len(picked) == 1}
        )
        target = out if out is None or len(picked) == 1 else out.with_stem(f"{out.stem}-{one.name}")
        parts = None if target is None or not one.kept_in_parts else target.with_name(target.name + ".parts")
        with stoppable(parts), advancing(one.title, quiet=as_json) as progress:
            outcome = one.run(
                progress=progress,
                folder=parts,
                workers=workers if one.kept_in_parts or len(picked) == 1 else None,
            )
        if target is not None:
            outcome.save(target)
            saved.append(target)
            if parts is not None:
                from granum.studies.store import forget

                forget(parts)
        outcomes.append(outcome)
    if report is not None:
        from granum.core.files import write_atomic
        from granum.studies.report import study_report

        with working(_("Writing the report"), quiet=as_json):
            write_atomic(report, study_report(outcomes, text, known[picked[0].name].subject.title))
        saved.append(report)
    if as_json:
        emit(
            {"studies": {one.name: outcome.as_json() for one, outcome in zip(picked, outcomes, strict=True)}}
            | ({} if rest is None else {"assumed": rest})
        )
    else:
        from granum.studies.report import print_study

        for outcome in outcomes:
            print_study(outcome, saved=saved if outcome is outcomes[-1] else ())
        if rest is not None:
            _print_assumed(rest)


@app.command()
@one_message
def chart(
    key: Key,
    inputs: Pairs = None,
    out: Annotated[Path, typer.Option("--out", "-o", help="HTML file to write.")] = Path("chart.html"),
) -> None:
    """Draw a chart and save it as HTML."""
    from granum.core import registry
    from granum.core.charts import as_html
    from granum.core.files import write_atomic

    thing = registry.find(key)
    if thing.card.sort != "chart":
        raise InputError(
            _("'{key}' ({sort}) is not a chart; 'granum list --sort chart' shows those.").format(
                key=key, sort=_(thing.card.sort)
            )
        )
    write_atomic(out, as_html(thing(**pairs(inputs)), page=True))
    print(_("saved to {path}").format(path=out))


@app.command("list")
@one_message
def list_cards(
    words: Annotated[
        list[str] | None,
        typer.Argument(
            help="Show only cards that these words mean, in either language, the best first.",
            show_default=False,
        ),
    ] = None,
    as_json: Json = False,
    sort: Annotated[str, typer.Option(help="formula, law, procedure, chart, lab test or equipment.")] = "",
) -> None:
    """List the cards."""
    from granum.core.index import entries

    wanted = " ".join(words or ())
    cards = list(entries().values())
    if wanted.strip():
        from granum.core.search import search

        cards = search(wanted) or _described(cards, wanted.lower().split())
    found = [c for c in cards if not sort or c.sort == sort]
    if as_json:
        emit(
            {
                "cards": [
                    {"card": c.key, "sort": c.sort, "title": c.title, "summary": c.summary} for c in found
                ]
            }
        )
    else:
        from granum.reports.listing import print_list

        print_list(found)


def _described(cards: Sequence[Entry], needles: Sequence[str]) -> list[Entry]:
    """What no name says may stand in a description."""
    from granum.core import registry

    things = registry.everything()
    return [c for c in cards if all(n in things[c.key].card.doc.lower() for n in needles)]


@app.command()
@one_message
def show(key: Key, as_json: Json = False) -> None:
    """Show a card: inputs with units and limits, outputs, equation, source."""
    from granum.core import kept

    card = kept.card(key)
    if as_json:
        emit(card.as_json())
    else:
        from granum.reports.terminal import print_card

        print_card(card)


@app.command("exercises")
@one_message
def course(
    name: Annotated[
        str, typer.Argument(help="One of the exercises; without it all are listed.", show_default=False)
    ] = "",
    seed: Annotated[int | None, typer.Option(min=0, help="Fresh numbers, drawn from this seed.")] = None,
    answers: Annotated[bool, typer.Option("--answers", help="Tell what is right at every step.")] = False,
    seeds: Annotated[
        str, typer.Option(help="The sheet of a class as CSV, one row a seed: 1-30.", show_default=False)
    ] = "",
    out: Annotated[Path | None, typer.Option(help="Write the sheet there instead of printing it.")] = None,
    as_json: Json = False,
) -> None:
    """Exercises of the course, with their answers for the teacher."""
    from granum.app.exercises import listing, printing

    if seeds and not name:
        raise InputError(_("Which exercise? Its name stands in 'granum exercises'."), name="name")
    if seeds:
        printing.give_sheet(name, seeds, out)
    elif as_json:
        emit(printing.told(name, seed, answers) if name else listing())
    elif name:
        printing.print_exercise(name, seed, answers)
    else:
        printing.print_listing()


@app.command("app")
@one_message
def serve(
    port: Annotated[int, typer.Option(min=0, max=65535, help="Port; 0 takes a free one.")] = 8765,
    host: Annotated[str, typer.Option(help="Address; another than loopback demands a token.")] = "127.0.0.1",
    browser: Annotated[bool, typer.Option(help="Open the browser.")] = True,
    workspace: Annotated[
        Path | None, typer.Option(help="Folder whose case files may be opened and saved.")
    ] = None,
) -> None:
    """Open the web app."""
    from granum.app.serving import serve as start

    start(host, port, browser, workspace)


def main() -> None:
    """Entry point of the ``granum`` command."""
    collect_seldom()
    keep_compiled_code()
    to_the_end(app)


if __name__ == "__main__":
    main()
