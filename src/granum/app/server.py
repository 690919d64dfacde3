"""The server: routes over the declarations. Holds no physics and no state."""

from __future__ import annotations

import json
import logging
import shlex
from collections import Counter
from functools import cache
from importlib.resources import files
from pathlib import Path
from typing import Annotated, Any, Literal

import tomli
from fastapi import Body, FastAPI, File, Form, Request, UploadFile
from fastapi.exceptions import RequestValidationError
from fastapi.responses import FileResponse, HTMLResponse, JSONResponse, Response
from starlette.exceptions import HTTPException

import granum
from granum.app import exercises
from granum.app.alone_forms import alone_form
from granum.app.building import built, palette, told_of
from granum.app.case_forms import edited, line_form
from granum.app.finding import SHOWN, found
from granum.app.forms import card_form, read_entry
from granum.app.jobs import Broken, GivenUp, Jobs, crew
from granum.app.limits import LARGEST_BODY, Busy, Familiar, Guard, Workers, problem
from granum.app.offered import substances
from granum.app.page_files import STATIC, serve_page
from granum.app.reading import as_html
from granum.app.sending import Shorter, kept, lasting
from granum.app.shipped import domain_of_line, examples, examples_folder, title_of
from granum.app.tasks import TASKS, calculate, packed
from granum.app.telling import Tell
from granum.app.wording import summary_words, told
from granum.core import registry
from granum.core.errors import GranumError, InputError, unknown_name
from granum.core.glossary import glossary, term
from granum.core.i18n import _, current_language
from granum.core.index import Entry, entries
from granum.core.search import search, usual
from granum.core.units import unit_system

Inputs = Annotated[dict[str, Any], Body()]
Case = Annotated[str, Body(embed=True)]
Place = Annotated[str, Body(embed=True)]

TABLES = {
    "csv": "text/csv",
    "xlsx": "application/vnd.openxmlformats-officedocument.spreadsheetml.sheet",
}


class Answer(JSONResponse):
    """JSON of whatever the package returns."""

    def render(self, content: Any) -> bytes:
        return packed(content)


def _json(content: bytes) -> Response:
    return Response(content, media_type="application/json")


def create_app(workspace: Path | None = None, token: str = "") -> FastAPI:
    """The application.

    Parameters
    ----------
    workspace: folder whose case files may be opened and saved; none when not given.
    token: when set, every request must carry it (as ``?token=`` once, then as a cookie).
    """
    app = FastAPI(title="Granum", version=granum.__version__, docs_url=None, redoc_url=None)
    app.add_middleware(Shorter)
    app.add_middleware(Guard, token=token)
    quick = Workers(count=2, waiting=400, longest=60.0)
    _refusals(app)
    _cards_and_formulas(app, quick)
    _long_work(app, workspace)
    _studies(app, workspace)
    _case_forms(app, quick, workspace)
    _files(app, quick, workspace)
    serve_page(app)
    return app


def _refusals(app: FastAPI) -> None:
    """Every error as ``{"error": {"type", "message"}}`` in the language of the request."""

    @app.exception_handler(GranumError)
    async def refused(_request: Request, fault: GranumError) -> JSONResponse:
        status = (
            429
            if isinstance(fault, Busy) and not isinstance(fault, GivenUp)
            else (422 if fault.exit_code == 2 else 409)
        )
        return Answer({"error": told(fault.as_json())}, status_code=status)

    @app.exception_handler(RequestValidationError)
    async def misread(_request: Request, fault: RequestValidationError) -> JSONResponse:
        places = ", ".join(".".join(map(str, e["loc"])) for e in fault.errors()[:3])
        return problem(422, _("The request is not understood; look at: {places}.").format(places=places))

    @app.exception_handler(HTTPException)
    async def absent(_request: Request, fault: HTTPException) -> JSONResponse:
        return problem(
            fault.status_code,
            _("There is nothing at this address.") if fault.status_code == 404 else str(fault.detail),
        )

    @app.exception_handler(Exception)
    async def broken(request: Request, fault: Exception) -> JSONResponse:
        logging.getLogger("granum").error("%s %s", request.method, request.url.path, exc_info=fault)
        return problem(
            500,
            _("Granum has a fault here: {reason}. Please report it.").format(
                reason=fault if isinstance(fault, Broken) else type(fault).__name__
            ),
        )


def _cards_and_formulas(app: FastAPI, quick: Workers) -> None:
    """What is answered in a moment, in this process."""

    @app.get("/api/cards")
    async def cards(request: Request, word: str = "", sort: str = "") -> Response:
        """All cards, short, or those that words mean, the best first."""
        if not word and not sort:
            return kept(await quick.run(_cards_text), request)
        listed = await quick.run(_cards)
        if word:
            by_key = {c["card"]: c for c in listed}
            listed = [by_key[card.key] for card in await quick.run(lambda: search(word[:200]))]
        shown = [c for c in listed if not sort or c["sort"] == sort]
        first = set(usual(word[:200]))
        return Answer({"cards": shown, "usual": [c["card"] for c in shown if c["card"] in first]})

    @app.get("/api/search")
    async def everything(q: str = "", limit: int = SHOWN) -> Response:
        """Cards, lines, exercises and pages that words mean, the best first."""
        return Answer({"hits": await quick.run(lambda: found(q, min(max(limit, 1), 200)))})

    @app.get("/api/pages/{name:path}")
    async def read_page(name: str) -> Response:
        """A page of the documentation."""
        return Answer(await quick.run(lambda: as_html(name)))

    @app.get("/api/cards/{key}")
    async def card(request: Request, key: str) -> Response:
        """One card with everything a form needs."""
        place = (key, current_language(), unit_system())
        form = _forms[place] if place in _forms else await quick.run(lambda: _form_text(*place))
        return kept(form, request)

    @app.post("/api/read")
    async def read(asked: Inputs) -> Response:
        """What is typed in a field means; text that is not understood is an answer too, not an error."""
        try:
            return Answer(read_entry(asked))
        except InputError as fault:
            return Answer({"problem": told(fault.as_json())["message"]})

    @app.post("/api/calc/{key}")
    async def calc(request: Request, key: str, inputs: Inputs) -> Response:
        """Evaluate a card."""
        payload = {"key": key, "inputs": inputs}
        if _familiar.knows(key, inputs):
            return _json(calculate(payload, Tell()))
        if await quick.run(lambda: registry.find(key).card.sort) == "procedure":  # may be long
            return _json(await crew().run("calculate", payload, key, request))
        return _json(
            await quick.run(lambda: _familiar.meet(key, inputs, lambda: calculate(payload, Tell())), request)
        )

    @app.post("/api/alone/{key}")
    async def by_itself(request: Request, key: str, inputs: Inputs) -> Response:
        """A piece of equipment alone: its form, and the case file of what stands in it."""
        return Answer(await quick.run(lambda: alone_form(key, inputs), request))

    async def nearby(request: Request, task: str, payload: dict[str, Any]) -> bytes:
        """What is asked about one formula in this process; what repeats a procedure, or many laws, may be
        long.
        """
        key = payload["key"]
        sort = await quick.run(lambda: registry.find(key).card.sort)
        if not payload.get("laws") and sort == "formula":
            return await quick.run(lambda: TASKS[task](payload, Tell()), request)
        # a machine is asked of the process that solved it
        case = _structure(str(payload.get("case", ""))) if sort == "equipment" else key
        return await crew().run(task, payload, case, request)

    @app.post("/api/sensitivity/{key}")
    async def sensitivity(request: Request, key: str, asked: Inputs) -> Response:
        """A result over one of its inputs: ``{"inputs", "against", "output", "unit", "laws"}``."""
        return _json(await nearby(request, "sensitivity", asked | {"key": key}))

    @app.post("/api/figures/{name}")
    async def figure(request: Request, name: str, asked: Inputs) -> Response:
        """A figure of the handbook where its sliders stand: ``{"values"}``, each in its slider's unit."""
        return _json(await crew().run("figure", asked | {"name": name}, name, request))

    @app.get("/api/chapters/{code}/{domain}/{name}")
    async def chapter_figure(request: Request, code: Literal["en", "fr"], domain: str, name: str) -> Response:
        """A figure of a chapter of the handbook in the language of the chapter: Plotly JSON."""
        asked = {"domain": domain, "name": name, "code": code}
        return _json(await crew().run("chapter_figure", asked, f"chapter {domain}", request))

    @app.post("/api/solve/{key}")
    async def solve(request: Request, key: str, asked: Inputs) -> Response:
        """The input for which a result is the wanted one: ``{"inputs", "find", "output", "wanted"}``."""
        return _json(await nearby(request, "solve", asked | {"key": key}))

    @app.post("/api/sheet/{key}", response_class=HTMLResponse)
    async def sheet(request: Request, key: str, asked: Inputs) -> HTMLResponse:
        """The calculation as a sheet to print: asked as the sensitivity, with the ``link`` of the page."""
        return HTMLResponse(await nearby(request, "calculation", asked | {"key": key}))

    @app.get("/api/version")
    async def version() -> Response:
        """The version of the program."""
        return Answer({"version": granum.__version__})

    @app.get("/api/exercises")
    async def exercise_list() -> Response:
        """Worked examples and quizzes of the course notes."""
        return Answer(await quick.run(exercises.listing))

    @app.get("/api/exercises/{name}")
    async def exercise(request: Request, name: str, seed: int | None = None) -> Response:
        """One exercise with its numbers: those of the course, or fresh ones."""
        return _json(await crew().run("exercise", {"name": name, "seed": seed}, name, request))

    @app.get("/api/exercises/{name}/answers")
    async def answers(request: Request, name: str, seed: int | None = None) -> Response:
        """What is right at every step of an exercise."""
        return _json(await crew().run("answers", {"name": name, "seed": seed}, name, request))

    @app.get("/api/exercises/{name}/sheet")
    async def answer_sheet(request: Request, name: str, first: int = 1, last: int = 30) -> Response:
        """The answers of many students, one row a seed, as CSV."""
        payload = {"name": name, "first": first, "last": last}
        text = await crew().run("answer_sheet", payload, name, request)
        return Response(text, media_type="text/csv; charset=utf-8")

    @app.post("/api/exercises/{name}")
    async def mark(
        request: Request,
        name: str,
        step: Annotated[int, Body()],
        answer: Annotated[str, Body()],
        seed: Annotated[int | None, Body()] = None,
    ) -> Response:
        """The verdict on an answer."""
        payload = {"name": name, "step": step, "seed": seed, "answer": answer}
        return _json(await crew().run("mark", payload, name, request))


def _long_work(app: FastAPI, workspace: Path | None) -> None:
    """What may take long or much memory, in processes of its own."""

    @app.post("/api/spread/{key}")
    async def others(request: Request, key: str, inputs: Inputs) -> Response:
        """The same inputs by the other laws that could be used."""
        return _json(await crew().run("others", {"key": key, "inputs": inputs}, key, request))

    @app.post("/api/chart/{key}")
    async def chart(request: Request, key: str, inputs: Inputs) -> Response:
        """Draw a chart: Plotly JSON."""
        return _json(await crew().run("chart", {"key": key, "inputs": inputs}, key, request))

    @app.post("/api/fit/{key}")
    async def fit(
        request: Request,
        key: str,
        file: Annotated[UploadFile, File()],
        conditions: Annotated[str, Form()] = "{}",
    ) -> Response:
        """Fit a lab test to an uploaded table."""
        content = await file.read(LARGEST_BODY + 1)
        name = Path(file.filename or "data.csv").name
        return _json(
            await crew().run(
                "fit", {"key": key, "content": content, "name": name, "conditions": conditions}, key, request
            )
        )

    @app.post("/api/table")
    async def table(
        request: Request, file: Annotated[UploadFile, File()], sheet: Annotated[str, Form()] = ""
    ) -> Response:
        """An uploaded table (CSV or Excel) as comma-separated text, of a workbook the first sheet or the one
        that is named, with the names of all.
        """
        name = Path(file.filename or "data.csv").name
        payload = {"content": await file.read(LARGEST_BODY + 1), "name": name, "sheet": sheet}
        return _json(await crew().run("table", payload, "", request))

    @app.post("/api/run")
    async def run(request: Request, case: Case, place: Place = "") -> Response:
        """Solve the text of a case file; ``place`` is where it was opened, for the files it names."""
        return _json(
            await crew().run("run", {"case": case} | _folder(workspace, place), _structure(case), request)
        )

    @app.post("/api/inside")
    async def inside(request: Request, case: Case, place: Place = "") -> Response:
        """Charts of a piece of equipment alone, as its case: sizes of its streams, what is inside."""
        return _json(
            await crew().run("inside", {"case": case} | _folder(workspace, place), _structure(case), request)
        )

    @app.post("/api/case/size")
    async def resize(
        request: Request,
        case: Case,
        unit: Case,
        wanted: Annotated[str, Body(embed=True)] = "",
        place: Place = "",
    ) -> Response:
        """The size of a piece of equipment of a case for what enters it: so that the figure of its duty is
        ``wanted``, or as in its example.
        """
        payload = {"case": case, "unit": unit, "wanted": wanted} | _folder(workspace, place)
        return _json(await crew().run("resize", payload, _structure(case), request))

    @app.post("/api/report", response_class=HTMLResponse)
    async def report(request: Request, case: Case, place: Place = "") -> HTMLResponse:
        """The report of a case file."""
        return HTMLResponse(
            await crew().run("report", {"case": case} | _folder(workspace, place), _structure(case), request)
        )

    @app.get("/api/progress/{name}")
    async def progress(name: str) -> Response:
        """How far a request is that was sent with the header ``x-job`` and this name."""
        return Answer(crew().progress(name))


def _studies(app: FastAPI, workspace: Path | None) -> None:
    """Studies: started, asked about, stopped."""
    jobs = Jobs(crew)

    @app.post("/api/studies/choices")
    async def study_choices(request: Request, inputs: Inputs) -> Response:
        """What a study of a line (``case``) or a card (``card``, ``inputs``) may vary and watch."""
        return _json(
            await crew().run(
                "study_choices",
                inputs | _folder(workspace, inputs.get("place")),
                _structure(str(inputs.get("case", ""))),
                request,
            )
        )

    @app.post("/api/studies", status_code=202)
    async def start(inputs: Inputs) -> Response:
        """Start a study: ``{"case" or "card" and "inputs", "table"}``; gives its name."""
        return Answer(
            {
                "id": jobs.start(
                    inputs | _folder(workspace, inputs.get("place")), _structure(str(inputs.get("case", "")))
                )
            },
            status_code=202,
        )

    @app.get("/api/studies/{name}")
    async def state(name: str) -> Response:
        """How far a study is; its outcome when it is done."""
        job = jobs.find(name)
        if not job.future.done():
            return Answer(job.as_json() | {"part": jobs.so_far(name) is not None})
        return Response(
            b'{"state":"done","share":1,"outcome":' + job.future.result() + b"}",
            media_type="application/json",
        )

    @app.get("/api/studies/{name}/part")
    async def so_far(request: Request, name: str) -> Response:
        """The outcome of what a study has computed that still runs; null where that is nothing."""
        payload = jobs.so_far(name)
        return Answer(None) if payload is None else _json(await crew().run("study", payload, "", request))

    @app.delete("/api/studies/{name}")
    async def cancel(name: str) -> Response:
        """Stop a study; what it has computed can still be asked for."""
        jobs.find(name).cancelled.set()
        return Answer({"state": "cancelled"})


def _case_forms(app: FastAPI, quick: Workers, workspace: Path | None) -> None:
    """Case files as forms."""

    @app.post("/api/case/form")
    async def form(
        request: Request,
        case: Case,
        across: Annotated[int, Body(embed=True, ge=1, le=40)] = 5,
        place: Place = "",
    ) -> Response:
        """A case file as forms, with what it still needs and its diagram, ``across`` units side by side."""
        files = _folder(workspace, place)
        return Answer(await quick.run(lambda: line_form(case, across, files), request))

    @app.post("/api/case/build")
    async def build(
        request: Request,
        operation: Case,
        arguments: Annotated[dict[str, Any], Body(embed=True)],
        case: Case = "",
    ) -> Response:
        """The case file after an operation of ``granum.cases.building``, and what is to be said about it."""

        def done() -> dict[str, str]:
            made = built(operation, case, arguments)
            return {"case": made, "told": told_of(operation, case, arguments)}

        return Answer(await quick.run(done, request))

    @app.get("/api/palette")
    async def equipment() -> Response:
        """Every piece of equipment, with its symbol."""
        return Answer({"equipment": await quick.run(palette)})

    @app.get("/api/substances")
    async def materials() -> Response:
        """What a line can be made of."""
        return Answer(await quick.run(substances))

    @app.post("/api/case/tables")
    async def tables(request: Request, case: Case, form: Case, place: Place = "") -> Response:
        """Streams and results of a case as a file, ``csv`` or ``xlsx``."""
        if form not in TABLES:
            raise unknown_name(_("Form"), form, TABLES)
        payload = {"case": case, "form": form} | _folder(workspace, place)
        return Response(
            await crew().run("tables", payload, _structure(case), request), media_type=TABLES[form]
        )

    @app.post("/api/case/edit")
    async def edit(request: Request, case: Case, table: Case, name: Case, key: Case, text: Case) -> Response:
        """The case file with one value changed."""
        return Answer({"case": await quick.run(lambda: edited(case, table, name, key, text), request)})


def _folder(workspace: Path | None, place: Any) -> dict[str, str]:
    """Folder and root for the files a case names: those of the workspace, or of the example it was opened
    from.
    """
    sort, _colon, name = str(place or "").partition(":")
    if sort == "examples" and name in examples():
        return {"folder": str(examples()[name].parent), "root": str(examples()[name].parent)}
    if workspace is None:
        return {"folder": "", "root": ""}
    folder = _inside(workspace, name).parent if sort == "workspace" and name else workspace.resolve()
    return {"folder": str(folder), "root": str(workspace.resolve())}


def _structure(case: str) -> str:
    """The title of a case: cases of the same title go to the process that has compiled it."""
    found = next((line for line in case.splitlines() if line.startswith("title")), "")
    return found.partition("=")[2].strip().strip("\"'")[:200]


def _files(app: FastAPI, quick: Workers, workspace: Path | None) -> None:
    """Case files: the workspace and the shipped examples; Plotly."""

    @app.get("/api/workspace")
    async def listing() -> Response:
        """Case files of the workspace."""
        if workspace is None:
            return Answer({"files": None})
        return Answer(
            {"files": sorted(str(p.relative_to(workspace)) for p in workspace.rglob("*.toml") if p.is_file())}
        )

    @app.get("/api/workspace/{path:path}")
    async def opened(path: str) -> Response:
        """The text of one case file."""
        place = _inside(workspace, path)
        try:
            return Answer({"path": path, "text": place.read_text(encoding="utf-8", errors="replace")})
        except OSError:
            raise InputError(_("There is no file '{path}' in the workspace.").format(path=path)) from None

    @app.put("/api/workspace/{path:path}")
    async def saved(
        path: str, text: Annotated[str, Body(embed=True)], replace: Annotated[bool, Body(embed=True)] = False
    ) -> Response:
        """Save a case file atomically; one that exists is replaced only when that is said."""
        from granum.core.files import write_atomic

        place = _inside(workspace, path)
        try:
            if place.exists() and not replace:
                raise InputError(_("'{path}' exists already.").format(path=path), exists=True)
            place.parent.mkdir(parents=True, exist_ok=True)
            write_atomic(place, text)
        except (OSError, UnicodeError) as fault:
            raise InputError(
                _("'{path}' cannot be written: {reason}.").format(path=path, reason=fault)
            ) from None
        return Answer({"path": path})

    @app.get("/api/examples")
    async def shipped() -> Response:
        """Case files shipped with the package."""
        return Answer(
            {
                "files": sorted(examples()),
                "titles": {name: title_of(name) for name in examples()},
                "domains": {name: domain_of_line(name) for name in examples()},
            }
        )

    @app.get("/api/examples/{name:path}")
    async def example(name: str) -> Response:
        """The text of a shipped case file."""
        if name not in examples():
            raise unknown_name(_("Example"), name, examples(), quantities=False)
        return Answer({"path": name, "text": examples()[name].read_text(encoding="utf-8")})

    @app.get("/favicon.ico")
    async def icon() -> FileResponse:
        """The icon, under the name browsers try by themselves."""
        return FileResponse(STATIC / "icon.svg", media_type="image/svg+xml")

    @app.get("/vendor/plotly.js")
    async def plotly(request: Request) -> Response:
        """Plotly, as the installed Python package ships it."""
        place = files("plotly") / "package_data" / "plotly.min.js"
        return await quick.run(lambda: lasting(place.read_bytes(), "text/javascript", request))


def _inside(workspace: Path | None, path: str) -> Path:
    """A path of the workspace; anything that points out of it is refused."""
    if workspace is None:
        raise InputError(_("No workspace: start the app with --workspace FOLDER to open and save files."))
    root = workspace.resolve()
    try:
        place = (root / path).resolve()
    except (OSError, ValueError):  # a name the file system cannot hold, such as one with a zero byte
        place = root
    if not place.is_relative_to(root) or place.suffix != ".toml":
        raise InputError(_("'{path}' is not a case file (.toml) of the workspace.").format(path=path))
    return place


def _family_title(card: Entry) -> str:
    """What a group of laws is called: its family where that is a word of the field, else what it gives."""
    word = card.family if card.family in glossary() else card.gives.split()[0]
    label = term(word).label
    return label[:1].upper() + label[1:]


@cache
def _cards_in(_language: str) -> tuple[list[dict[str, Any]], bytes]:
    size = Counter(c.family for c in entries().values())
    found = [
        {
            "card": c.key,
            "sort": c.sort,
            "domain": c.domain,
            "title": c.title,
            "summary": summary_words(c.summary),
            "family": c.family,
            "family_title": _family_title(c) if c.family and size[c.family] > 1 else "",
        }
        for c in entries().values()
    ]
    return found, bytes(Answer({"cards": found}).body)


def _cards() -> list[dict[str, Any]]:
    return _cards_in(current_language())[0]


def _cards_text() -> bytes:
    return _cards_in(current_language())[1]


_forms: dict[tuple[str, str, str], bytes] = {}


def _form_text(key: str, language: str, units: str) -> bytes:
    text = _forms[key, language, units] = packed(
        card_form(key) | {"trial": _trial(key) if registry.find(key).card.sort == "lab test" else None}
    )
    return text


def _trial(key: str) -> dict[str, Any] | None:
    """Data and conditions to try a lab test with: those of the first ``granum fit`` of it in a README of the
    examples.
    """
    for place in sorted(examples_folder().glob("*/README.md")):
        for line in place.read_text(encoding="utf-8").splitlines():
            if line.startswith(f"granum fit {key} "):
                data, *conditions = shlex.split(line)[3:]
                table = place.parent / Path(data).name
                values = dict(word.split("=", 1) for word in conditions)
                laws = {
                    name: json.dumps(tomli.loads(f"v = {text}")["v"])
                    for name, text in values.items()
                    if text.startswith("{")
                }
                return {
                    "name": f"{place.parent.name}/{table.name}",
                    "table": table.read_text(encoding="utf-8"),
                    "values": values | laws,
                }
    return None


_familiar = Familiar()
