"""The server: routes over the declarations. Holds no physics and no state."""

from __future__ import annotations

import io
import json
import secrets
from collections.abc import Awaitable, Callable
from functools import cache
from importlib.resources import files
from pathlib import Path
from typing import Annotated, Any

from fastapi import Body, FastAPI, File, Form, Request, UploadFile
from fastapi.responses import FileResponse, HTMLResponse, JSONResponse, Response
from fastapi.staticfiles import StaticFiles

import granum
from granum.app.limits import LARGEST_BODY, Busy, Workers
from granum.app.texts import bounds_text, described
from granum.core import registry
from granum.core.errors import GranumError, InputError, unknown_name
from granum.core.i18n import LANGUAGES, _, set_language

STATIC = Path(str(files("granum") / "app" / "static"))
POLICY = "default-src 'self'; style-src 'self' 'unsafe-inline'; img-src 'self' data: blob:; frame-ancestors 'none'"


def create_app(workspace: Path | None = None, token: str = "") -> FastAPI:
    """The application.

    Parameters
    ----------
    workspace: folder whose case files may be opened and saved; none when not given.
    token: when set, every request must carry it (as ``?token=`` once, then as a cookie).
    """
    app = FastAPI(title="Granum", version=granum.__version__, docs_url=None, redoc_url=None)
    workers = Workers()

    @app.middleware("http")
    async def guard(request: Request, call: Callable[[Request], Awaitable[Response]]) -> Response:
        asked = request.query_params.get("lang") or request.headers.get("x-language") or request.headers.get("accept-language", "")[:2]
        set_language(asked if asked in LANGUAGES else "en")
        if token:
            given = request.query_params.get("token") or request.cookies.get("granum_token", "")
            if not secrets.compare_digest(given.encode(), token.encode()):
                return _problem(401, _("This server needs the token that was printed when it started."))
        if int(request.headers.get("content-length") or 0) > LARGEST_BODY:
            return _problem(413, _("The request is larger than {limit} MB.").format(limit=LARGEST_BODY // 1_000_000))
        response = await call(request)
        response.headers["content-security-policy"] = POLICY
        response.headers["x-content-type-options"] = "nosniff"
        response.headers["referrer-policy"] = "no-referrer"
        if token and request.query_params.get("token"):
            response.set_cookie("granum_token", token, httponly=True, samesite="strict")
        return response

    @app.exception_handler(GranumError)
    async def refused(_request: Request, problem: GranumError) -> JSONResponse:
        status = 429 if isinstance(problem, Busy) else (422 if problem.exit_code == 2 else 409)
        return JSONResponse({"error": problem.as_json()}, status_code=status)

    @app.get("/api/cards")
    async def cards(word: str = "", sort: str = "") -> dict[str, Any]:
        """All cards, short."""
        found = await workers.run(_cards)
        needle = word.lower()
        return {
            "cards": [
                c for c in found if (not sort or c["sort"] == sort) and needle in f"{c['card']} {c['title']} {c['summary']}".lower()
            ]
        }

    @app.get("/api/cards/{key}")
    async def card(key: str) -> dict[str, Any]:
        """One card with everything a form needs."""
        return await workers.run(lambda: _card(key))

    @app.post("/api/calc/{key}")
    async def calc(key: str, inputs: Annotated[dict[str, Any], Body()]) -> dict[str, Any]:
        """Evaluate a card."""
        return await workers.run(lambda: _calc(key, inputs))

    @app.post("/api/chart/{key}")
    async def chart(key: str, inputs: Annotated[dict[str, Any], Body()]) -> Response:
        """Draw a chart: Plotly JSON."""
        text = await workers.run(lambda: _chart(key, inputs))
        return Response(text, media_type="application/json")

    @app.post("/api/fit/{key}")
    async def fit(key: str, file: Annotated[UploadFile, File()], conditions: Annotated[str, Form()] = "{}") -> dict[str, Any]:
        """Fit a lab test to an uploaded table."""
        content = await file.read(LARGEST_BODY + 1)
        name = Path(file.filename or "data.csv").name
        return await workers.run(lambda: _fit(key, content, name, conditions))

    @app.post("/api/run")
    async def run(case: Annotated[str, Body(embed=True)]) -> dict[str, Any]:
        """Solve the text of a case file."""
        return await workers.run(lambda: _run(case))

    @app.post("/api/report", response_class=HTMLResponse)
    async def report(case: Annotated[str, Body(embed=True)]) -> HTMLResponse:
        """The report of a case file."""
        return HTMLResponse(await workers.run(lambda: _report(case)))

    @app.get("/api/workspace")
    async def listing() -> dict[str, Any]:
        """Case files of the workspace."""
        if workspace is None:
            return {"files": None}
        return {"files": sorted(str(p.relative_to(workspace)) for p in workspace.rglob("*.toml") if p.is_file())}

    @app.get("/api/workspace/{path:path}")
    async def opened(path: str) -> dict[str, Any]:
        """The text of one case file."""
        place = _inside(workspace, path)
        if not place.is_file():
            raise InputError(_("There is no file '{path}' in the workspace.").format(path=path))
        return {"path": path, "text": place.read_text(encoding="utf-8")}

    @app.put("/api/workspace/{path:path}")
    async def saved(path: str, text: Annotated[str, Body(embed=True)]) -> dict[str, Any]:
        """Save a case file atomically."""
        from granum.core.files import write_atomic

        place = _inside(workspace, path)
        place.parent.mkdir(parents=True, exist_ok=True)
        write_atomic(place, text)
        return {"path": path}

    @app.get("/api/examples")
    async def examples() -> dict[str, Any]:
        """Case files shipped with the package."""
        return {"files": sorted(_examples())}

    @app.get("/api/examples/{name:path}")
    async def example(name: str) -> dict[str, Any]:
        """The text of a shipped case file."""
        if name not in _examples():
            raise unknown_name(_("Example"), name, _examples())
        return {"path": name, "text": _examples()[name].read_text(encoding="utf-8")}

    @app.get("/vendor/plotly.js")
    async def plotly() -> FileResponse:
        """Plotly, as the installed Python package ships it."""
        return FileResponse(str(files("plotly") / "package_data" / "plotly.min.js"), media_type="text/javascript")

    app.mount("/", StaticFiles(directory=STATIC, html=True), name="static")
    return app


def _problem(status: int, message: str) -> JSONResponse:
    return JSONResponse({"error": {"type": "RequestError", "message": message}}, status_code=status)


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
    place = (root / path).resolve()
    if not place.is_relative_to(root) or place.suffix != ".toml":
        raise InputError(_("'{path}' is not a case file (.toml) of the workspace.").format(path=path))
    return place


def _cards() -> list[dict[str, Any]]:
    from granum.core.i18n import current_language

    return _cards_in(current_language())


@cache
def _cards_in(_language: str) -> list[dict[str, Any]]:
    things = registry.everything().values()
    return [{"card": c.key, "sort": c.sort, "domain": c.domain, "title": c.title, "summary": c.summary} for c in (t.card for t in things)]


def _card(key: str) -> dict[str, Any]:
    from granum.reports.mathml import mathml

    found = registry.find(key).card
    data = found.as_json() | {"equation_shown": mathml(found.equation, display=True)}
    for row, p in zip(data["parameters"], found.parameters, strict=True):
        row["allowed"] = bounds_text(p)
        row["symbol_shown"] = mathml(p.term.symbol) if p.term else ""
        if p.law:
            row["choices"] = sorted(
                thing.card.name for thing in registry.family(p.law).values() if not any(q.required for q in thing.card.parameters) or thing.card.sort != "law"
            )
    return data


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
        if value not in ("", None):
            values[name] = value
    return values


def _calc(key: str, inputs: dict[str, Any]) -> dict[str, Any]:
    given = _given(inputs)
    return described(_evaluable(key, ("formula", "procedure")).evaluate(**given), given)


def _chart(key: str, inputs: dict[str, Any]) -> str:
    return _evaluable(key, ("chart",))(**_given(inputs)).to_json()


def _fit(key: str, content: bytes, name: str, conditions: str) -> dict[str, Any]:
    test_type = _evaluable(key, ("lab test",))
    try:
        given = json.loads(conditions)
    except json.JSONDecodeError:
        raise InputError(_("'conditions' is not valid JSON.")) from None
    if not isinstance(given, dict):
        raise InputError(_("'conditions' is not valid JSON."))
    source = io.BytesIO(content)
    source.name = name
    test = test_type.read(source, **_given(given))
    found = test.fit()
    return found.as_json() | {"chart": json.loads(test.chart(found).to_json())}


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


