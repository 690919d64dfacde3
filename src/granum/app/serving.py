"""Starting the server: loopback by default, a token elsewhere, the browser when wanted."""

from __future__ import annotations

import ipaddress
import secrets
import socket
import threading
import webbrowser
from pathlib import Path
from typing import Any

import uvicorn

from granum.app.connections import Connection
from granum.app.jobs import crew
from granum.app.server import create_app
from granum.core.errors import InputError, reason_of
from granum.core.i18n import _


def _loopback(host: str) -> bool:
    if host == "localhost":
        return True
    try:
        return ipaddress.ip_address(host).is_loopback
    except ValueError:
        return False


def configured(app: Any, http: type[Connection] = Connection, **changes: Any) -> uvicorn.Config:
    """How the app is served: no connection is kept that asks for nothing."""
    how: dict[str, Any] = {"log_level": "warning", "backlog": 2048, "timeout_keep_alive": 75, "ws": "none"}
    return uvicorn.Config(app, http=http, **how | changes)


def serve(host: str, port: int, browser: bool, workspace: Path | None) -> None:
    """Serve the app until interrupted."""
    if workspace is not None and not workspace.is_dir():
        raise InputError(_("'{path}' is not a folder.").format(path=workspace), path=str(workspace))
    try:
        listener = socket.create_server(
            (host, port), family=socket.AF_INET6 if ":" in host else socket.AF_INET
        )
    except OSError as problem:
        raise InputError(
            _("Address {host}, port {port} cannot be used: {reason}. Choose another with --port.").format(
                host=host, port=port, reason=reason_of(problem)
            )
        ) from None
    token = "" if _loopback(host) else secrets.token_urlsafe(24)
    shown = f"[{host}]" if ":" in host else host
    address = f"http://{shown}:{listener.getsockname()[1]}/" + (f"?token={token}" if token else "")
    print(_("Granum runs at {address} (Ctrl+C stops it)").format(address=address), flush=True)
    crew().warm()
    if browser:
        threading.Timer(0.5, webbrowser.open, [address]).start()
    try:
        uvicorn.Server(configured(create_app(workspace, token))).run(sockets=[listener])
    finally:
        crew().close()
