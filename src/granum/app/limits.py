"""What a request may cost: who may ask, how large, how long and how many at once."""

from __future__ import annotations

import asyncio
import contextvars
import json
import re
import secrets
import threading
import time
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from http.cookies import CookieError, SimpleCookie
from typing import Any
from urllib.parse import parse_qs

from fastapi import Request
from fastapi.responses import JSONResponse
from starlette.datastructures import Headers, MutableHeaders
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from granum.app.wear import forget_when_worn
from granum.core.errors import GranumError
from granum.core.i18n import LANGUAGES, _, set_language
from granum.core.units import set_unit_system

LARGEST_BODY = 5_000_000  # bytes
SLOWEST_BODY = 60.0  # seconds in which a body must be here
# of JSON: nesting, values, keys of an object, digits of a number
DEEPEST, MOST_VALUES, MOST_KEYS, MOST_DIGITS = 32, 100_000, 1_000, 300
POLICY = (
    "default-src 'self'; style-src 'self' 'unsafe-inline'; img-src 'self' data: blob:; "
    "object-src 'none'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'"
)
HEADERS = {
    "content-security-policy": POLICY,
    "x-content-type-options": "nosniff",
    "referrer-policy": "no-referrer",
}
COOKIE = "granum_token"


class Busy(GranumError):
    """More requests than can be served, or one that takes too long."""


class Workers:
    """A pool for the computing part of requests, with a bounded queue and a time limit.

    Parameters
    ----------
    count: calculations at the same time.
    waiting: requests that may wait or run before newcomers are told to come back.
    longest: seconds after which a request is given up.
    """

    def __init__(self, count: int, waiting: int, longest: float):
        self._pool = ThreadPoolExecutor(count, thread_name_prefix="granum")
        self._waiting, self._longest = waiting, longest
        self._now = 0

    async def run(self, work: Callable[[], Any], request: Request | None = None) -> Any:
        """Run work in the pool; work still queued when its client leaves is dropped."""
        if self._now >= self._waiting:
            raise Busy(_("The server is busy. Try again in a moment."))
        self._now += 1
        job = self._pool.submit(contextvars.copy_context().run, work)
        job.add_done_callback(lambda _job, loop=asyncio.get_running_loop(): _quietly(loop, self._left))
        future = asyncio.wrap_future(job)
        deadline = asyncio.get_running_loop().time() + self._longest
        while True:
            done, _pending = await asyncio.wait([future], timeout=min(self._longest, 1.0))
            if done:
                return future.result()
            if asyncio.get_running_loop().time() > deadline:
                job.cancel()
                raise Busy(
                    _("The calculation took longer than {seconds} s and was given up.").format(
                        seconds=int(self._longest)
                    )
                )
            if request is not None and await request.is_disconnected():
                job.cancel()
                raise Busy(_("The calculation was canceled."))

    def _left(self) -> None:
        self._now -= 1


class Familiar:
    """Calculations of a form met before and quick then: their code is compiled, so they need not wait behind
    one that is not.
    """

    # seconds; forms remembered; new and known forms after which the memory is looked at
    quick, most, look, glance = 0.03, 20_000, 25, 400
    _number = re.compile(r"\s*[-+]?[\d.,]+(?:[eE][-+]?\d+)?\s*(?:[A-Za-zµμ°℃%Ω][^\s;,\[\]]{0,30})?\s*")

    def __init__(self) -> None:
        self._met: set[tuple[Any, ...]] = set()
        self._new = self._asked = 0

    def _form(self, key: str, inputs: dict[str, Any]) -> tuple[Any, ...] | None:
        """Card, names of the inputs and words chosen; None when an input is more than a number or a word."""
        parts: list[Any] = [key]
        for name, value in sorted(inputs.items()):
            if isinstance(value, (int, float)) and not isinstance(value, bool):
                parts.append((name, 0))
            elif isinstance(value, str) and len(value) <= 60:
                parts.append((name, 0 if self._number.fullmatch(value) else value))
            else:
                return None
        return tuple(parts)

    def knows(self, key: str, inputs: dict[str, Any]) -> bool:
        """Whether this form of calculation was quick before."""
        self._asked += 1
        if self._asked % self.glance == 0:  # what is asked often is compiled in the end
            threading.Thread(target=self._tidy, daemon=True).start()
        form = self._form(key, inputs)
        return form is not None and form in self._met

    def _tidy(self) -> None:
        if forget_when_worn():
            self._met.clear()

    def meet(self, key: str, inputs: dict[str, Any], work: Callable[[], Any]) -> Any:
        """Run work and remember its form when it was quick; an error is not remembered."""
        start = time.perf_counter()
        found = work()
        took = time.perf_counter() - start
        self._new += 1
        if self._new % self.look == 0:
            self._tidy()
        form = self._form(key, inputs)
        if form is not None and took < self.quick and len(self._met) < self.most:
            self._met.add(form)
        return found


def _quietly(loop: asyncio.AbstractEventLoop, call: Callable[[], None]) -> None:
    """Call in the loop; at shutdown there is none left to tell."""
    if not loop.is_closed():
        loop.call_soon_threadsafe(call)


def problem(status: int, message: str, **headers: str) -> JSONResponse:
    """A refusal in the shape of every error."""
    return JSONResponse(
        {"error": {"type": "RequestError", "message": message}}, status_code=status, headers=HEADERS | headers
    )


def excess(body: bytes) -> str:
    """What is too much in a JSON body, in words; empty when nothing is. A body that is no JSON is told where
    it is read.
    """

    def whole(digits: str) -> int:
        if len(digits) > MOST_DIGITS:
            raise OverflowError
        return int(digits)

    try:
        level: list[Any] = [json.loads(body, parse_int=whole)]
    except OverflowError:
        return _("A number of the request has more than {most} digits.").format(most=MOST_DIGITS)
    except RecursionError:
        return _("The request is nested more than {most} levels deep.").format(most=DEEPEST)
    except ValueError:
        return ""
    count = 0
    for _depth in range(DEEPEST + 1):
        count += len(level)
        inner = [value for value in level if isinstance(value, (dict, list))]
        if count > MOST_VALUES or any(isinstance(value, dict) and len(value) > MOST_KEYS for value in inner):
            return _(
                "The request has more than {values} values, or an object with more than {keys} keys."
            ).format(values=MOST_VALUES, keys=MOST_KEYS)
        level = [part for value in inner for part in (value.values() if isinstance(value, dict) else value)]
        if not level:
            return ""
    return _("The request is nested more than {most} levels deep.").format(most=DEEPEST)


class Guard:
    """Outermost layer: language of the request, token, size of the body (announced or not), headers of the
    answer.
    """

    def __init__(self, app: ASGIApp, token: str = "", slowest: float = SLOWEST_BODY):
        self._app, self._token, self._slowest = app, token, slowest

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        if scope["type"] != "http":
            await self._app(scope, receive, send)
            return
        headers, query = Headers(scope=scope), parse_qs(scope["query_string"].decode("latin-1"))
        asked = query.get("lang", [headers.get("x-language") or headers.get("accept-language", "")[:2]])[-1]
        set_language(asked if asked in LANGUAGES else "en")
        set_unit_system("field" if headers.get("x-units") == "field" else "si")
        given = query.get("token", [""])[-1]
        if self._token and not self._known(given or _cookie(headers.get("cookie", ""))):
            await problem(401, _("This server needs the token that was printed when it started."))(
                scope, receive, send
            )
            return
        announced = headers.get("content-length", "0")
        try:
            large = announced.isdecimal() and int(announced[:20]) > LARGEST_BODY
            body = None if large else await asyncio.wait_for(_read(receive), self._slowest)
        except TimeoutError:
            message = _("The request did not arrive within {seconds} s.").format(seconds=int(self._slowest))
            await problem(408, message, connection="close")(scope, receive, send)
            return
        if body is None:
            message = _("The request is larger than {limit} MB.").format(limit=LARGEST_BODY // 1_000_000)
            await problem(413, message)(scope, receive, send)
            return
        if "json" in headers.get("content-type", "json") and (message := excess(body)):
            await problem(422, message)(scope, receive, send)
            return

        async def answer(message: Message) -> None:
            if message["type"] == "http.response.start":
                out = MutableHeaders(scope=message)
                out.update(HEADERS)
                # a script of the version before, kept without asking, would not fit the others
                out.setdefault("cache-control", "no-cache")
                if self._token and given:
                    out.append("set-cookie", f"{COOKIE}={given}; HttpOnly; SameSite=Strict; Path=/")
            await send(message)

        await self._app(scope, _replay(body, receive), answer)

    def _known(self, given: str) -> bool:
        return secrets.compare_digest(given.encode(), self._token.encode())


def _cookie(text: str) -> str:
    try:
        found = SimpleCookie(text).get(COOKIE)
    except CookieError:
        return ""
    return found.value if found else ""


async def _read(receive: Receive) -> bytes | None:
    """The whole body, or None as soon as it is larger than allowed."""
    body = bytearray()
    while True:
        message = await receive()
        if message["type"] != "http.request":
            return bytes(body)
        body += message.get("body", b"")
        if len(body) > LARGEST_BODY:
            return None
        if not message.get("more_body", False):
            return bytes(body)


def _replay(body: bytes, receive: Receive) -> Receive:
    """The body again for the application, then what the client does next (it leaves)."""
    sent = False

    async def again() -> Message:
        nonlocal sent
        if not sent:
            sent = True
            return {"type": "http.request", "body": body, "more_body": False}
        return await receive()

    return again
