"""The files of the page. They stand under an address that changes whenever one of them does: what a browser
has, it need not ask about again, and never meets a file of another version.
"""

from __future__ import annotations

import hashlib
import re
from importlib.resources import files
from pathlib import Path

from fastapi import FastAPI, Request
from fastapi.responses import HTMLResponse, Response
from fastapi.staticfiles import StaticFiles

import granum

STATIC = Path(str(files("granum") / "app" / "static"))
_LINKED = re.compile(r'((?:href|src)=")(?=[\w./-]+\.(?:css|js|svg)")')


def stamp() -> str:
    """What changes with the version and with every file of the page."""
    told = hashlib.sha256(granum.__version__.encode())
    for path in sorted(STATIC.rglob("*")):
        status = path.stat()
        told.update(f"{path.name} {status.st_size} {status.st_mtime_ns}".encode())
    return told.hexdigest()[:16]


def serve_page(app: FastAPI) -> None:
    """Serve the page and its files, after every other address."""
    plain = StaticFiles(directory=STATIC, html=True)

    @app.get("/", response_class=HTMLResponse)
    async def page() -> HTMLResponse:
        """The page, whose files are those of now."""
        text = (STATIC / "index.html").read_text(encoding="utf-8")
        return HTMLResponse(_LINKED.sub(rf"\1files/{stamp()}/", text))

    @app.get("/files/{version}/{path:path}")
    async def file(version: str, path: str, request: Request) -> Response:
        """A file of the page: kept for good under the address of its version."""
        found = await plain.get_response(path, request.scope)
        if version == stamp():
            found.headers["cache-control"] = "max-age=31536000, immutable"
        return found

    app.mount("/", plain, name="static")
