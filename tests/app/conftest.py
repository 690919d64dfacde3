"""A real server on a free port of the loopback address, and a browser to look at it, for the tests of the
app.
"""

from __future__ import annotations

import socket
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import pytest
import uvicorn
from tests.app.browsing import Page, chromium

from granum.app.server import create_app
from granum.app.serving import configured


@contextmanager
def running(app: Any, **changes: Any) -> Iterator[str]:
    """Serve an application from a thread; gives its address."""
    listener = socket.create_server(("127.0.0.1", 0))
    server = uvicorn.Server(
        configured(app, log_level="critical", lifespan="off", timeout_graceful_shutdown=1, **changes)
    )
    thread = threading.Thread(target=server.run, kwargs={"sockets": [listener]}, daemon=True)
    thread.start()
    while not server.started and thread.is_alive():
        time.sleep(0.02)
    try:
        yield f"http://127.0.0.1:{listener.getsockname()[1]}"
    finally:
        server.should_exit = True
        thread.join(timeout=10)
        listener.close()


@pytest.fixture(scope="session")
def address(tmp_path_factory: pytest.TempPathFactory) -> Iterator[str]:
    """Address of a server with an empty workspace."""
    with running(create_app(tmp_path_factory.mktemp("workspace"))) as found:
        yield found


@pytest.fixture(scope="session")
def serve() -> Any:
    """The context manager that runs an application."""
    return running


@pytest.fixture(scope="session")
def browser() -> Iterator[Any]:
    """The one browser of a test process."""
    with chromium() as found:
        yield found


@pytest.fixture
def page(browser: Any, address: str) -> Page:
    """A page in it."""
    return Page(browser, address)
