"""What is typed in a field, as the server reads it for the page."""

from __future__ import annotations

from collections.abc import Iterator

import httpx
import pytest

from granum.app.forms import read_entry
from granum.core import registry
from granum.core.errors import GranumError


@pytest.fixture(scope="module")
def client(address: str) -> Iterator[httpx.Client]:
    with httpx.Client(base_url=address, timeout=240.0, headers={"x-language": "en"}) as found:
        yield found


LENGTH = {
    "name": "particle_diameter",
    "kind": "length",
    "unit": "m",
    "lower": 0.0,
    "open_lower": True,
    "units": ["um", "mm", "m", "inch"],
}


@pytest.mark.parametrize(
    ("number", "unit", "shown", "kept"),
    [
        ("85", "um", "85 µm", "85 um"),
        ("85", "microns", "85 µm", "85 um"),
        ("0,5", "in", "0.5 in", "0.5 inch"),
        ("1e-3", "mm", "0.001 mm", "0.001 mm"),
        ("1/8", "in", "0.125 in", "0.125 inch"),
        ("85", "", "85 m", "85 m"),
    ],
)
def test_what_a_field_holds_is_read_and_said(
    client: httpx.Client, number: str, unit: str, shown: str, kept: str
) -> None:
    answer = client.post("/api/read", json=LENGTH | {"number": number, "unit_typed": unit}).json()
    assert (answer["shown"], f"{answer['number']} {answer['unit']}") == (shown, kept)
    french = client.post(
        "/api/read", json=LENGTH | {"number": number, "unit_typed": unit}, headers={"x-language": "fr"}
    ).json()
    assert french["shown"] == shown.replace(".", ",")


@pytest.mark.parametrize(
    ("name", "number", "unit", "found"),
    [
        ("liquid_flow", "1,5", "m3/h", "1.5 m³/h"),
        ("feed.mass_flow", "20", "gpm", "20 gal/min"),
        ("gas_flow", "1000", "Nm3/h", "1000 Nm³/h"),
        ("gas_flow", "-1", "m3/h", None),
        ("liquid_flow", "1000", "Nm3/h", None),
        ("liquid_flow", "20", "%", None),
    ],
)
def test_the_flow_of_a_feed_may_be_typed_as_a_volume(client, name, number, unit, found) -> None:
    asked = {"name": name, "kind": "mass flow", "unit": "kg/s", "units": ["kg/hour"], "or_kind": "VolumeFlow"}
    answer = client.post("/api/read", json=asked | {"number": number, "unit_typed": unit}).json()
    assert answer.get("shown") == found
    assert ("problem" in answer) == (found is None)


def test_every_quantity_of_every_card_is_understood() -> None:
    asked, refused = {}, {}
    for key, thing in registry.everything().items():
        for p in thing.card.parameters:
            row = p.as_json()
            if p.kind and not p.series:
                asked.setdefault(
                    (p.kind.name, p.kind.unit, p.kind.lower, p.kind.upper),
                    (key, row, min(max(sum(p.ordinary()) / 2.0, p.kind.lower), p.kind.upper)),
                )
    assert len(asked) > 80
    for key, row, value in asked.values():
        try:
            found = read_entry(
                row
                | {
                    "number": repr(value),
                    "unit_typed": row["unit"],
                    "units": [u["unit"] for u in row["units"]],
                }
            )
            assert found["shown"]
        except GranumError as fault:
            refused[f"{key} {row['name']}"] = fault.message
    assert not refused


def test_several_values_are_read_and_what_is_not_understood_is_said(client: httpx.Client) -> None:
    series = LENGTH | {"series": "classes"}
    assert (
        client.post("/api/read", json=series | {"number": "2 4,5 8", "unit_typed": "um"}).json()["number"]
        == "2 4.5 8"
    )
    mixed = client.post("/api/read", json=series | {"number": "2", "unit_typed": "mm, 850 um"}).json()
    assert "number" not in mixed, "values with units of their own stay as they were typed"
    assert mixed["shown"].endswith(("2 mm", "0.85 mm", "850 µm"))
    both = LENGTH | {"number": "10 20", "unit_typed": "um"}
    assert set(client.post("/api/read", json=both).json()) == {"problem"}
    assert client.post("/api/read", json=both | {"several": True}).json()["shown"] == "10 · 20 µm", (
        "as a formula takes them"
    )
    assert (
        client.post("/api/read", json=both | {"several": True, "number": "1 200"}).json()["shown"]
        == "1200 µm"
    )
    for number, unit in (
        ("eighty", ""),
        ("85", "kg"),
        ("-3", "um"),
        ("", "um"),
        ("85", "furlong per fortnight per"),
    ):
        told = client.post("/api/read", json=LENGTH | {"number": number, "unit_typed": unit}).json()
        assert set(told) == {"problem"}
        assert "particle_diameter" not in told["problem"]
    for odd in (
        {},
        {"kind": "length"},
        {"kind": 3, "number": []},
        LENGTH | {"lower": "x"},
        LENGTH | {"units": [3, None, "kg"], "number": "1"},
    ):
        assert client.post("/api/read", json=odd).status_code < 500
