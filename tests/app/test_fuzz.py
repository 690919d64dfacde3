"""Requests nobody would write, made from the server's own description, and broken uploads: refused with a
sentence, never a fault.
"""

from __future__ import annotations

import io
import zipfile
from collections.abc import Iterator
from typing import Any

import httpx
import pytest
import schemathesis
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from schemathesis.checks import not_a_server_error

from granum.app.server import create_app


@pytest.fixture(scope="module")
def fuzzed(tmp_path_factory: pytest.TempPathFactory, serve: Any) -> Iterator[str]:
    with serve(create_app(tmp_path_factory.mktemp("fuzzed"))) as address:
        yield address


@pytest.fixture(scope="module")
def client(fuzzed: str) -> Iterator[httpx.Client]:
    with httpx.Client(base_url=fuzzed, timeout=120.0) as found:
        yield found


def test_requests_made_from_the_description_are_never_a_fault(fuzzed: str) -> None:
    described = schemathesis.openapi.from_url(f"{fuzzed}/openapi.json")
    asked = 0
    for found in described.get_all_operations():
        operation = found.ok()

        @settings(max_examples=12, deadline=None, suppress_health_check=list(HealthCheck))
        @given(case=operation.as_strategy())
        def ask(case: schemathesis.Case) -> None:
            case.call_and_validate(checks=[not_a_server_error], timeout=120)

        ask()
        asked += 1
    assert asked > 20


KEYS = [
    "particles.terminal_velocity_stokes",
    "filtration.leaf_test",
    "humid_gas.psychrometric_chart",
    "particles.drag_ranking",
    "x",
    "a.b",
    "é",
]
ANYTHING = st.recursive(
    st.none() | st.booleans() | st.floats() | st.integers() | st.text(max_size=20),
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(st.text(max_size=8), inner, max_size=3),
    max_leaves=6,
)


@settings(max_examples=25, deadline=None, suppress_health_check=list(HealthCheck))
@given(
    key=st.sampled_from(KEYS),
    route=st.sampled_from(["calc", "chart", "spread"]),
    name=st.text(max_size=8),
    value=ANYTHING,
)
def test_any_json_is_answered(client: httpx.Client, key: str, route: str, name: str, value: Any) -> None:
    answer = client.post(
        f"/api/{route}/{key}", json={} if value != value else _without_nan({name: value, "pressure": value})
    )
    assert answer.status_code < 500, answer.text[:300]


def _without_nan(value: Any) -> Any:
    if isinstance(value, dict):
        return {k: _without_nan(v) for k, v in value.items()}
    if isinstance(value, list):
        return [_without_nan(v) for v in value]
    return None if isinstance(value, float) and (value != value or abs(value) == float("inf")) else value


def _workbook(parts: dict[str, bytes]) -> bytes:
    made = io.BytesIO()
    with zipfile.ZipFile(made, "w") as packed:
        for name, content in parts.items():
            packed.writestr(name, content)
    return made.getvalue()


UPLOADS = {
    "empty": ("data.csv", b""),
    "zero bytes": ("data.csv", b"\x00" * 64),
    "no encoding": ("data.csv", b"\xff\xfe\xff\xfe time"),
    "one cell": ("data.csv", b"time"),
    "only a header": ("data.csv", b"time [s],filtrate_volume [m^3]\n"),
    "words": ("data.csv", b"time [s],filtrate_volume [m^3]\na,b\n"),
    "ragged": ("data.csv", b"time [s],filtrate_volume [m^3]\n1\n2,3,4\n"),
    "odd unit": ("data.csv", b"time [furlong],filtrate_volume [m^3]\n1,2\n2,3\n3,4\n"),
    "nan": ("data.csv", b"time [s],filtrate_volume [m^3]\nnan,1\ninf,2\n1e400,3\n"),
    "twice": ("data.csv", b"time [s],time [s]\n1,2\n"),
    "negative": ("data.csv", b"time [s],filtrate_volume [m^3]\n-1,-1\n-2,-2\n-3,-3\n"),
    "equal": ("data.csv", b"time [s],filtrate_volume [m^3]\n" + b"1,1\n" * 9),
    "long line": ("data.csv", b"time [s]," + b"x" * 300_000),
    "many columns": ("data.csv", b",".join(b"c%d" % i for i in range(20_000))),
    "quotes": ("data.csv", b'"time [s],filtrate_volume\n"""\n'),
    "no workbook": ("data.xlsx", b"time"),
    "empty workbook": ("data.xlsx", _workbook({})),
    "broken workbook": ("data.xlsx", _workbook({"[Content_Types].xml": b"<", "xl/workbook.xml": b"<a"})),
    "other name": ("../../x.exe", b"MZ"),
    "no name": (".csv", b"1"),
    "no sheet": (
        "data.xlsx",
        _workbook({"xl/workbook.xml": b"<workbook/>", "[Content_Types].xml": b"<Types/>"}),
    ),
}


@pytest.mark.parametrize("upload", UPLOADS)
def test_malformed_uploads_are_explained(client: httpx.Client, upload: str) -> None:
    for conditions in (
        "{}",
        (
            '{"area": "0.05 m2", "pressure_drop": "1 bar", "dynamic_viscosity": "1 cP", '
            '"dry_cake_per_filtrate": "20 kg/m3"}'
        ),
    ):
        answer = client.post(
            "/api/fit/filtration.leaf_test", files={"file": UPLOADS[upload]}, data={"conditions": conditions}
        )
        assert answer.status_code in (409, 422), answer.text[:300]
        assert answer.json()["error"]["message"]


@pytest.mark.parametrize(
    "body",
    [
        b"",
        b"{",
        b"[" * 100_000,
        b'{"case": 1}',
        b'{"case": null}',
        b'{"case": "\\ud800"}',
        b"\xff\xfe",
        b'{"case": "a = 1e999999"}',
        b"null",
        b'"x"',
        b'{"case":' * 500 + b"1" + b"}" * 500,
        b'{"case": ' + b"7" * 5000 + b"}",
        b"{" + b",".join(b'"k%d":1' % i for i in range(200_000)) + b"}",
    ],
    ids=range(13),
)
def test_malformed_bodies_are_refused(client: httpx.Client, body: bytes) -> None:
    for place in (
        "/api/run",
        "/api/report",
        "/api/case/form",
        "/api/studies",
        "/api/studies/choices",
        "/api/calc/particles.reynolds_number",
    ):
        answer = client.post(place, content=body, headers={"content-type": "application/json"})
        assert answer.status_code < 500, (place, answer.text[:300])
