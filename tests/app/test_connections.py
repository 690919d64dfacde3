"""Connections that ask for nothing, or never end asking, are closed; bodies that are too much are one
message, at once.
"""

from __future__ import annotations

import json
import socket
import time
from collections.abc import Iterator
from typing import Any
from urllib.parse import urlsplit

import httpx
import pytest

from granum.app.connections import Connection
from granum.app.limits import DEEPEST, MOST_KEYS, MOST_VALUES, Guard, excess


class Hasty(Connection):
    """As served, in tenths of seconds."""

    patience = 0.2


async def slow_answer(scope: Any, receive: Any, send: Any) -> None:
    """Answers later than a connection may be silent."""
    import asyncio

    await receive()
    await asyncio.sleep(0.5)
    await send({"type": "http.response.start", "status": 200, "headers": [(b"content-length", b"2")]})
    await send({"type": "http.response.body", "body": b"ok"})


@pytest.fixture(scope="module")
def place(serve: Any) -> Iterator[tuple[str, int]]:
    with serve(Guard(slow_answer, slowest=0.3), http=Hasty) as address:
        found = urlsplit(address)
        yield str(found.hostname), int(found.port or 0)


ASK = b"GET / HTTP/1.1\r\nhost: x\r\n\r\n"


def what_comes(connection: socket.socket) -> bytes:
    """Everything until the server closes; fails when it does not."""
    connection.settimeout(5.0)
    found = b""
    while part := connection.recv(4096):
        found += part
    return found


def test_connections_without_a_whole_request_are_closed(place: tuple[str, int]) -> None:
    starts = [b"", b"GET /api/cards HTTP/1.1\r\nhost: x\r\n", b"GET"] * 10
    held = [socket.create_connection(place) for _ in starts]
    for connection, start in zip(held, starts, strict=True):
        connection.sendall(start)
    assert [what_comes(connection) for connection in held] == [b""] * len(held)
    for connection in held:
        connection.close()


def test_a_head_that_comes_byte_by_byte_is_not_waited_for(place: tuple[str, int]) -> None:
    with socket.create_connection(place) as connection:
        sent = 0
        try:
            while sent < 100:
                connection.sendall(b"a" if sent else b"GET / HTTP/1.1\r\nhost: ")
                sent += 1
                time.sleep(0.02)
        except OSError:
            pass
        assert sent < 60


def test_a_request_is_answered_however_long_it_takes_and_the_next_one_has_its_own_time(
    place: tuple[str, int],
) -> None:
    with socket.create_connection(place) as connection:
        for _turn in range(2):
            connection.sendall(ASK)
            connection.settimeout(5.0)
            assert connection.recv(4096).startswith(b"HTTP/1.1 200")
        connection.sendall(ASK[:20])
        assert what_comes(connection) in (b"", b"ok")


def test_a_body_that_does_not_come_is_refused(place: tuple[str, int]) -> None:
    with socket.create_connection(place) as connection:
        connection.sendall(b"POST / HTTP/1.1\r\nhost: x\r\ncontent-length: 100\r\n\r\nfew")
        found = what_comes(connection)
    assert found.startswith(b"HTTP/1.1 408")
    assert b"did not arrive within" in found


def nested(depth: int) -> bytes:
    return b'{"a":' * depth + b"1" + b"}" * depth


EXCESSIVE = {
    "deep": (nested(DEEPEST + 1), "nested"),
    "very deep": (b"[" * 200_000, "nested"),
    "deep lists": (b"[" * 900 + b"]" * 900, "nested"),
    "digits": (b'{"a": ' + b"7" * 5000 + b"}", "digits"),
    "negative digits": (b"[-" + b"7" * 5000 + b"]", "digits"),
    "keys": (json.dumps({f"k{i}": i for i in range(200_000)}).encode(), "keys"),
    "one key too many": (json.dumps(dict.fromkeys(map(str, range(MOST_KEYS + 1)))).encode(), "keys"),
    "values": (json.dumps([0] * (MOST_VALUES + 1)).encode(), "values"),
}


@pytest.mark.parametrize("name", EXCESSIVE)
def test_excessive_json_is_one_message(name: str) -> None:
    body, word = EXCESSIVE[name]
    assert word in excess(body)


def test_ordinary_json_passes() -> None:
    for body in (
        b"{}",
        nested(DEEPEST),
        b'{"a": [1, 2.5e300, "x"]}',
        json.dumps([0] * 5000).encode(),
        b"{",
        b"",
        b"\xff",
        b"NaN",
        b"1" * 300,
    ):
        assert excess(body) == ""


@pytest.mark.parametrize("kind", ["application/json", ""])
def test_the_server_refuses_them_at_the_door(place: tuple[str, int], kind: str) -> None:
    for body, word in EXCESSIVE.values():
        answer = httpx.post(
            f"http://{place[0]}:{place[1]}/", content=body, headers={"content-type": kind} if kind else {}
        )
        assert answer.status_code == 422
        assert word in answer.json()["error"]["message"]
