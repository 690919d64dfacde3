"""The server: routes over the declarations. Holds no physics and no state."""

from __future__ import annotations

import io
import json
import logging
from functools import cache
from importlib.resources import files
from pathlib import Path
from typing import Annotated, Any

from fastapi import Body, FastAPI, File, Form, Request, UploadFile
from fastapi.exceptions import RequestValidationError
from fastapi.responses import FileResponse, HTMLResponse, JSONResponse, Response
from fastapi.staticfiles import StaticFiles
from starlette.exceptions import HTTPException

import granum
from granum.app import exercises
from granum.app.forms import card_form
from granum.app.limits import LARGEST_BODY, Busy, Guard, Workers, problem
from granum.app.spread import spread
from granum.app.texts import described, label_of, plain_data
from granum.core import registry
from granum.core.errors import GranumError, InputError, unknown_name
from granum.core.i18n import _, current_language
from granum.core.units import pretty_unit

STATIC = Path(str(files("granum") / "app" / "static"))
Inputs = Annotated[dict[str, Any], Body()]


class Answer(JSONResponse):
    """JSON of whatever the package returns."""

    def render(self, content: Any) -> bytes:
        return json.dumps(plain_data(content), ensure_ascii=False, allow_nan=False, separators=(",", ":")).encode()


def create_app(workspace: Path | None = None, token: str = "") -> FastAPI:
    """The application.

    Parameters
    ----------
    workspace: folder whose case files may be opened and saved; none when not given.
    token: when set, every request must carry it (as ``?token=`` once, then as a cookie).
    """
    app = FastAPI(title="Granum", version=granum.__version__, docs_url=None, redoc_url=None)
    app.add_middleware(Guard, token=token)
    quick = Workers(count=2, waiting=400, longest=60.0)
    patient = Workers(count=2, waiting=24, longest=300.0)
    _refusals(app)
    _calculations(app, quick, patient)
    _files(app, workspace)
    app.mount("/", StaticFiles(directory=STATIC, html=True), name="static")
    return app


def _refusals(app: FastAPI) -> None:
    """Every error as ``{"error": {"type", "message"}}`` in the language of the request."""

    @app.exception_handler(GranumError)
    async def refused(_request: Request, fault: GranumError) -> JSONResponse:
        status = 429 if isinstance(fault, Busy) else (422 if fault.exit_code == 2 else 409)
        return Answer({"error": fault.as_json()}, status_code=status)

    @app.exception_handler(RequestValidationError)
    async def misread(_request: Request, fault: RequestValidationError) -> JSONResponse:
        places = ", ".join(".".join(map(str, e["loc"])) for e in fault.errors()[:3])
        return problem(422, _("The request is not understood; look at: {places}.").format(places=places))

    @app.exception_handler(HTTPException)
    async def absent(_request: Request, fault: HTTPException) -> JSONResponse:
        return problem(fault.status_code, _("There is nothing at this address.") if fault.status_code == 404 else str(fault.detail))

    @app.exception_handler(Exception)
    async def broken(request: Request, fault: Exception) -> JSONResponse:
        logging.getLogger("granum").error("%s %s", request.method, request.url.path, exc_info=fault)
        return problem(500, _("Granum has a fault here: {reason}. Please report it.").format(reason=type(fault).__name__))


def _calculations(app: FastAPI, quick: Workers, patient: Workers) -> None:
    """Cards, calculations, fits and lines."""

    @app.get("/api/cards")
    async def cards(word: str = "", sort: str = "") -> Response:
        """All cards, short."""
        if not word and not sort:
            return Response(await quick.run(_cards_text), media_type="application/json")
        needle = word.lower()
        found = [c for c in await quick.run(_cards) if not sort or c["sort"] == sort]
        return Answer({"cards": [c for c in found if needle in f"{c['card']} {c['title']} {c['summary']}".lower()]})

    @app.get("/api/cards/{key}")
    async def card(key: str) -> Response:
        """One card with everything a form needs."""
        return Answer(await quick.run(lambda: card_form(key)))

    @app.post("/api/calc/{key}")
    async def calc(request: Request, key: str, inputs: Inputs) -> Response:
        """Evaluate a card."""
        return Answer(await quick.run(lambda: _calc(key, inputs), request))

    @app.post("/api/spread/{key}")
    async def others(request: Request, key: str, inputs: Inputs) -> Response:
        """The same inputs by the other laws that could be used."""
        return Answer({"rows": await patient.run(lambda: spread(_evaluable(key, ("formula",)), _given(inputs)), request)})

    @app.post("/api/chart/{key}")
    async def chart(request: Request, key: str, inputs: Inputs) -> Response:
        """Draw a chart: Plotly JSON."""
        return Response(await patient.run(lambda: _chart(key, inputs), request), media_type="application/json")

    @app.post("/api/fit/{key}")
    async def fit(request: Request, key: str, file: Annotated[UploadFile, File()], conditions: Annotated[str, Form()] = "{}") -> Response:
        """Fit a lab test to an uploaded table."""
        content = await file.read(LARGEST_BODY + 1)
        name = Path(file.filename or "data.csv").name
        return Answer(await patient.run(lambda: _fit(key, content, name, conditions), request))

    @app.post("/api/run")
    async def run(request: Request, case: Annotated[str, Body(embed=True)]) -> Response:
        """Solve the text of a case file."""
        return Answer(await patient.run(lambda: _run(case), request))

    @app.post("/api/report", response_class=HTMLResponse)
    async def report(request: Request, case: Annotated[str, Body(embed=True)]) -> HTMLResponse:
        """The report of a case file."""
        return HTMLResponse(await patient.run(lambda: _report(case), request))

    @app.get("/api/exercises")
    async def exercise_list() -> Response:
        """Worked examples and quizzes of the course notes."""
        return Answer(await quick.run(exercises.listing))


def _files(app: FastAPI, workspace: Path | None) -> None:
    """Case files: the workspace and the shipped examples; Plotly."""

    @app.get("/api/workspace")
    async def listing() -> Response:
        """Case files of the workspace."""
        if workspace is None:
            return Answer({"files": None})
        return Answer({"files": sorted(str(p.relative_to(workspace)) for p in workspace.rglob("*.toml") if p.is_file())})

    @app.get("/api/workspace/{path:path}")
    async def opened(path: str) -> Response:
        """The text of one case file."""
        place = _inside(workspace, path)
        try:
            return Answer({"path": path, "text": place.read_text(encoding="utf-8", errors="replace")})
        except OSError:
            raise InputError(_("There is no file '{path}' in the workspace.").format(path=path)) from None

    @app.put("/api/workspace/{path:path}")
    async def saved(path: str, text: Annotated[str, Body(embed=True)]) -> Response:
        """Save a case file atomically."""
        from granum.core.files import write_atomic

        place = _inside(workspace, path)
        try:
            place.parent.mkdir(parents=True, exist_ok=True)
            write_atomic(place, text)
        except (OSError, UnicodeError) as fault:
            raise InputError(_("'{path}' cannot be written: {reason}.").format(path=path, reason=fault)) from None
        return Answer({"path": path})

    @app.get("/api/examples")
    async def examples() -> Response:
        """Case files shipped with the package."""
        return Answer({"files": sorted(_examples())})

    @app.get("/api/examples/{name:path}")
    async def example(name: str) -> Response:
        """The text of a shipped case file."""
        if name not in _examples():
            raise unknown_name(_("Example"), name, _examples())
        return Answer({"path": name, "text": _examples()[name].read_text(encoding="utf-8")})

    @app.get("/favicon.ico")
    async def icon() -> FileResponse:
        """The icon, under the name browsers try by themselves."""
        return FileResponse(STATIC / "icon.svg", media_type="image/svg+xml")

    @app.get("/vendor/plotly.js")
    async def plotly() -> FileResponse:
        """Plotly, as the installed Python package ships it."""
        place = files("plotly") / "package_data" / "plotly.min.js"
        return FileResponse(str(place), media_type="text/javascript", headers={"cache-control": "max-age=86400"})


@cache
def _examples() -> dict[str, Path]:
    root = Path(str(files("granum") / "examples"))
    root = root if root.is_dir() else Path(granum.__file__).parents[2] / "examples"  # installed, or in a source tree
    return {str(p.relative_to(root)): p for p in sorted(root.rglob("*.toml"))} if root.is_dir() else {}


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


@cache
def _cards_in(_language: str) -> tuple[list[dict[str, Any]], bytes]:
    found = [
        {"card": c.key, "sort": c.sort, "domain": c.domain, "title": c.title, "summary": c.summary}
        for c in (t.card for t in registry.everything().values())
    ]
    return found, bytes(Answer({"cards": found}).body)


def _cards() -> list[dict[str, Any]]:
    return _cards_in(current_language())[0]


def _cards_text() -> bytes:
    return _cards_in(current_language())[1]


def _evaluable(key: str, sorts: tuple[str, ...]) -> Any:
    thing = registry.find(key)
    if thing.card.sort not in sorts:
        raise InputError(_("'{key}' is a {sort}; it cannot be used here.").format(key=key, sort=_(thing.card.sort)))
    return thing


def _given(inputs: dict[str, Any]) -> dict[str, Any]:
    """Inputs as text, numbers or ``{"value", "unit"}``; empty ones are left out."""
    values: dict[str, Any] = {}
    for name, value in inputs.items():
        if isinstance(value, dict) and set(value) <= {"value", "unit"}:
            value = f"{value.get('value', '')} {value.get('unit', '')}".strip()
        if isinstance(value, str) and value.lstrip().startswith("{"):
            value = _law(name, value)
        if value not in ("", None):
            values[name] = value
    return values


def _law(name: str, text: str) -> Any:
    """A law with its parameters, written as JSON in a form or a link."""
    try:
        return json.loads(text)
    except (json.JSONDecodeError, RecursionError):
        raise InputError(_("'{name}' is not valid JSON.").format(name=name), name=name) from None


def _calc(key: str, inputs: dict[str, Any]) -> dict[str, Any]:
    given = _given(inputs)
    return described(_evaluable(key, ("formula", "procedure")).evaluate(**given), given)


def _chart(key: str, inputs: dict[str, Any]) -> str:
    return _evaluable(key, ("chart",))(**_given(inputs)).to_json()


def _fit(key: str, content: bytes, name: str, conditions: str) -> dict[str, Any]:
    test_type = _evaluable(key, ("lab test",))
    try:
        given = json.loads(conditions)
    except (json.JSONDecodeError, RecursionError):
        raise InputError(_("'{name}' is not valid JSON.").format(name="conditions")) from None
    if not isinstance(given, dict):
        raise InputError(_("'{name}' is not valid JSON.").format(name="conditions"))
    source = io.BytesIO(content)
    source.name = name
    test = test_type.read(source, **_given(given))
    data = test.fit().as_json()
    for name, row in (*data["parameters"].items(), *data["derived"].items()):
        row["label"], row["unit_shown"] = label_of(name), pretty_unit(row["unit"])
    return data | {"chart": json.loads(test.chart().to_json())}


def _run(case: str) -> dict[str, Any]:
    from granum.cases import read_text
    from granum.flowsheet.drawing import draw
    from granum.reports.terminal import value_text

    outcome = read_text(case).solve()
    data = outcome.as_json()
    for name, report in outcome.units.items():
        data["units"][name]["title"] = report.model.card.title
        for p, value in report.figures():
            data["units"][name]["results"][p.name] |= {"label": p.label, "text": value_text(value, p)}
    return data | {"diagram": draw(outcome.sheet, outcome.streams), "stream_rows": outcome.stream_rows()}


def _report(case: str) -> str:
    from granum.cases import read_text
    from granum.reports.html import line_report

    return line_report(read_text(case).solve())
