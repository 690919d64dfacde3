"""How answers travel: compressed where that saves anything, and not at all where the browser has them."""

from __future__ import annotations

import gzip
import hashlib
from functools import lru_cache

from fastapi import Request
from fastapi.responses import Response
from starlette.middleware.gzip import GZipMiddleware

import granum

LEVEL, SHORTEST = 5, 1_000  # of compression; bytes below which there is nothing to gain
VARY = "accept-encoding, x-language, x-units"


class Shorter(GZipMiddleware):
    """Answers compressed for whoever accepts that."""

    def __init__(self, app: object):
        super().__init__(app, minimum_size=SHORTEST, compresslevel=LEVEL)  # type: ignore[arg-type]


@lru_cache(maxsize=64)
def _packed(content: bytes) -> bytes:
    return gzip.compress(content, LEVEL, mtime=0)


@lru_cache(maxsize=4096)
def _mark(content: bytes) -> str:
    """A mark that changes with the content and the version."""
    return f'"{hashlib.sha256(granum.__version__.encode() + content).hexdigest()[:32]}"'


def kept(content: bytes, request: Request, media_type: str = "application/json") -> Response:
    """An answer that a browser keeps and asks about the next time: told unchanged, it need not be sent
    again.
    """
    headers = {"etag": _mark(content), "cache-control": "no-cache", "vary": VARY}
    if headers["etag"] in request.headers.get("if-none-match", ""):
        return Response(status_code=304, headers=headers)
    return _sent(content, request, media_type, headers)


def lasting(content: bytes, media_type: str, request: Request) -> Response:
    """An answer that a browser need not ask about for a day."""
    return _sent(content, request, media_type, {"cache-control": "max-age=86400", "vary": "accept-encoding"})


def _sent(content: bytes, request: Request, media_type: str, headers: dict[str, str]) -> Response:
    if len(content) >= SHORTEST and "gzip" in request.headers.get("accept-encoding", ""):
        content, headers = _packed(content), headers | {"content-encoding": "gzip"}
    return Response(content, media_type=media_type, headers=headers)
