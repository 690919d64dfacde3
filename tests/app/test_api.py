"""The web API: shapes, refusals with a sentence, nothing outside the workspace, never a fault of the
server.
"""

from __future__ import annotations

import ast
import json
import re
import time
from collections.abc import Iterator
from importlib.resources import files
from pathlib import Path
from typing import Any

import httpx
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from tests.sharing.falling import SPHERE

from granum.app.limits import LARGEST_BODY, Busy, Workers
from granum.app.server import create_app
from granum.app.serving import _loopback
from granum.core import registry
from granum.core.i18n import catalog

APP = Path(str(files("granum") / "app"))


@pytest.fixture(scope="module")
def workspace(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("app") / "workspace"
    folder.mkdir()
    (folder / "mine.toml").write_text('title = "mine"\n')
    (folder.parent / "secret.toml").write_text("secret = true\n")
    return folder


@pytest.fixture(scope="module")
def client(workspace: Path, serve: Any) -> Iterator[httpx.Client]:
    with serve(create_app(workspace)) as address, httpx.Client(base_url=address, timeout=300.0) as found:
        yield found


def message(answer: httpx.Response) -> str:
    """The sentence of a refusal; a refusal without one fails."""
    assert 400 <= answer.status_code < 500, f"{answer.status_code}: {answer.text[:300]}"
    return answer.json()["error"]["message"]


def test_cards_are_listed_in_both_languages(client: httpx.Client) -> None:
    english = client.get("/api/cards").json()["cards"]
    french = client.get("/api/cards", headers={"x-language": "fr"}).json()["cards"]
    assert len(english) >= 300
    assert [c["card"] for c in english] == [c["card"] for c in french]
    assert next(c for c in french if c["card"] == "particles.terminal_velocity")["title"].startswith(
        "Vitesse"
    )
    assert {c["sort"] for c in client.get("/api/cards?sort=chart").json()["cards"]} == {"chart"}


def test_every_card_makes_a_form(client: httpx.Client) -> None:
    broken = {}
    for row in client.get("/api/cards").json()["cards"]:
        answer = client.get(f"/api/cards/{row['card']}")
        if answer.status_code != 200:
            broken[row["card"]] = answer.text[:200]
    assert not broken


def test_a_form_offers_what_people_write(client: httpx.Client) -> None:
    card = client.get("/api/cards/particles.terminal_velocity").json()
    rows = {p["name"]: p for p in card["parameters"]}
    assert rows["particle_diameter"]["allowed"] == "", "that it is above zero goes without saying"
    assert rows["particle_diameter"]["units"][0]["label"] == "µm"
    assert rows["gravity"]["default_shown"]["unit"] == "m/s^2"
    assert {"Stokes", "Newton"} <= {o["label"] for o in rows["drag"]["options"]}
    values = {
        p["name"]: f"{p['example']['number']} {p['example']['unit']}".strip()
        for p in card["parameters"]
        if p["example"]
    }
    assert client.post("/api/calc/particles.terminal_velocity", json=values).status_code == 200


def test_calc_gives_the_shape_of_the_command_line_and_more(client: httpx.Client) -> None:
    data = client.post("/api/calc/particles.terminal_velocity_stokes", json=SPHERE).json()
    # Stokes by hand: (2630 - 1020) · 9.80665 · (85e-6)² / (18 · 1.2e-3)
    assert data["outputs"]["terminal_velocity"]["value"] == pytest.approx(
        1610 * 9.80665 * 85e-6**2 / 0.0216, rel=1e-9
    )
    assert data["outputs"]["terminal_velocity"]["unit"] == "m/s"
    assert data["shown"][0]["text"].endswith("mm/s")
    assert data["inputs"]["particle_diameter"] == {"value": pytest.approx(85e-6), "unit": "m"}
    assert "<math" in data["equation"]
    assert data["citation"]
    assert data["python"].startswith("import granum")
    assert data["command"].startswith("granum calc particles.terminal_velocity_stokes")


def test_a_value_may_come_as_value_and_unit(client: httpx.Client) -> None:
    given = SPHERE | {"particle_diameter": {"value": 85, "unit": "um"}}
    data = client.post("/api/calc/particles.terminal_velocity_stokes", json=given).json()
    assert data["inputs"]["particle_diameter"]["value"] == pytest.approx(85e-6)


@pytest.mark.parametrize(
    ("changed", "says"),
    [
        ({"particle_diameter": "-3 um"}, "must be greater than"),
        ({"particle_diameter": "85 kg"}, "does not fit"),
        ({"particle_diameter": "eighty"}, "is not a number with a unit"),
        ({"particle_diameter": ""}, "needs particle diameter (µm)"),
        ({"particle_diameter": {"a": 1}}, "is not a number"),
        ({"particle_diameter": True}, "is not a number"),
        ({"particle_diametre": "85 um"}, "Did you mean"),
        ({"particle_diameter": 1e400}, "must be"),
    ],
)
def test_bad_inputs_are_explained(client: httpx.Client, changed: dict[str, Any], says: str) -> None:
    body = json.dumps(SPHERE | changed)
    answer = client.post(
        "/api/calc/particles.terminal_velocity_stokes",
        content=body,
        headers={"content-type": "application/json"},
    )
    assert says in message(answer)


def test_a_page_speaks_of_labels_not_of_python_names(client: httpx.Client) -> None:
    names = re.compile(r"[a-z]+_[a-z_]+|particles\.")
    for language in ("en", "fr"):
        for changed in (
            {"particle_diameter": "-3 um"},
            {"particle_diameter": "85 kg"},
            {"particle_diameter": "eighty"},
            {"particle_diameter": ""},
        ):
            answer = client.post(
                "/api/calc/particles.terminal_velocity_stokes",
                json=SPHERE | changed,
                headers={"x-language": language},
            )
            assert not names.search(message(answer)), message(answer)
        flagged = client.post(
            "/api/calc/particles.terminal_velocity_stokes",
            json=SPHERE | {"particle_diameter": "5 mm"},
            headers={"x-language": language},
        )
        assert flagged.json()["flags"]
        assert not names.search(flagged.json()["flags"][0]["message"])


def test_errors_come_in_french_too(client: httpx.Client) -> None:
    given = SPHERE | {"particle_diameter": "-3 um"}
    answer = client.post(
        "/api/calc/particles.terminal_velocity_stokes", json=given, headers={"x-language": "fr"}
    )
    assert "n’est pas possible" in message(answer)


def test_an_unknown_card_is_422_with_a_suggestion(client: httpx.Client) -> None:
    answer = client.post("/api/calc/particles.terminal_velocitty", json={})
    assert answer.status_code == 422
    assert "Did you mean 'particles.terminal_velocity'" in message(answer)
    assert answer.json()["error"]["did_you_mean"] == "particles.terminal_velocity"


@pytest.mark.parametrize("content", [b"", b"{", b"[]", b"null", b"\xff\xfe", b'{"a":', b"3", b"NaN"])
@pytest.mark.parametrize(
    "path",
    ["/api/calc/particles.reynolds_number", "/api/chart/particles.drag_chart", "/api/run", "/api/report"],
)
def test_malformed_json_is_refused(client: httpx.Client, path: str, content: bytes) -> None:
    assert message(client.post(path, content=content, headers={"content-type": "application/json"}))


@pytest.mark.parametrize(
    "content",
    [
        b"",
        b"\x00\x01\x02",
        b"PK\x03\x04broken",
        b"time,volume\n1,2\n",
        b"time [s],filtrate_volume [m^3]\na,b\n",
        b"\xff" * 100,
    ],
)
@pytest.mark.parametrize("name", ["data.csv", "data.xlsx", "../../etc/passwd", "x" * 300])
def test_malformed_uploads_are_refused(client: httpx.Client, content: bytes, name: str) -> None:
    conditions = {
        "area": "0.05 m^2",
        "pressure_drop": "1 bar",
        "dynamic_viscosity": "1 cP",
        "dry_cake_per_filtrate": "20 kg/m^3",
    }
    answer = client.post(
        "/api/fit/filtration.leaf_test",
        files={"file": (name, content)},
        data={"conditions": json.dumps(conditions)},
    )
    assert message(answer)
    for odd in ("[", "[]", "3", '"text"'):
        assert message(
            client.post(
                "/api/fit/filtration.leaf_test", files={"file": (name, content)}, data={"conditions": odd}
            )
        )


def test_a_fit_of_exact_data_gives_the_resistances_back(client: httpx.Client) -> None:
    # t/V = a V + b with a = η α W / (2 A² Δp), b = η R / (A Δp): times made by hand from α = 1e11 m/kg, R =
    # 1e10 1/m.
    area, drop, viscosity, cake, alpha, medium = 0.05, 1e5, 1e-3, 20.0, 1e11, 1e10
    a, b = viscosity * alpha * cake / (2 * area**2 * drop), viscosity * medium / (area * drop)
    volumes = [0.0005 * (i + 1) for i in range(8)]
    table = "time [s],filtrate_volume [m^3]\n" + "".join(f"{a * v * v + b * v},{v}\n" for v in volumes)
    conditions = {
        "area": area,
        "pressure_drop": drop,
        "dynamic_viscosity": viscosity,
        "dry_cake_per_filtrate": cake,
    }
    answer = client.post(
        "/api/fit/filtration.leaf_test",
        files={"file": ("data.csv", table)},
        data={"conditions": json.dumps(conditions)},
    )
    assert answer.status_code == 200, answer.text[:400]
    data = answer.json()
    assert data["parameters"]["cake_resistance"]["value"] == pytest.approx(alpha, rel=1e-3)
    assert data["parameters"]["medium_resistance"]["value"] == pytest.approx(medium, rel=1e-2)
    low, high = data["parameters"]["cake_resistance"]["interval_95"]
    assert low <= data["parameters"]["cake_resistance"]["value"] <= high
    assert data["chart"]["data"]


def test_a_table_is_shown_as_text_whatever_it_was(client: httpx.Client) -> None:
    import io

    import openpyxl

    book = openpyxl.Workbook()
    for row in (("t / s", "V (L)"), (1.5, 2), (3, 4.25)):
        book.active.append(row)
    sheet = io.BytesIO()
    book.save(sheet)
    semicolons = "t / s;V (L)\n1,5;2\n3;4,25\n".encode("cp1252")
    for name, content in (("a.csv", semicolons), ("a.xlsx", sheet.getvalue())):
        answer = client.post("/api/table", files={"file": (name, content)})
        assert answer.json()["text"] == "t / s,V (L)\n1.5,2\n3,4.25\n"


def test_a_line_is_solved_and_reported(client: httpx.Client) -> None:
    case = client.get("/api/examples/grinding-circuit/circuit.toml").json()["text"]
    data = client.post("/api/run", json={"case": case}).json()
    product = dict(data["stream_table"]["rows"])["product"]
    head = data["stream_table"]["heads"][1]
    assert (head["label"], head["unit"], product[1]) == ("solid", "t/h", "20")  # what goes in comes out
    assert data["audit"]["mass_closure"] < 1e-9
    assert data["diagram"].lstrip().startswith("<svg")
    assert data["units"]["mill"]["title"]
    page = client.post("/api/report", json={"case": case})
    assert page.status_code == 200
    assert "<svg" in page.text


@pytest.mark.parametrize(
    "case",
    ["", "a = ", 'title = "x"', "[units.a]\nmodel = 'no.such'", "\x00", "[mixture]\nliquids = ['nothing']"],
)
def test_a_bad_case_is_explained(client: httpx.Client, case: str) -> None:
    assert message(client.post("/api/run", json={"case": case}))


def test_a_case_is_shown_as_forms_and_edited_without_losing_comments(client: httpx.Client) -> None:
    case = client.get("/api/examples/grinding-circuit/circuit.toml").json()["text"]
    form = client.post("/api/case/form", json={"case": case}, headers={"x-language": "fr"}).json()
    assert form["units"]["mill"]["values"]["holdup_mass"] == "1.6 tonne"
    assert form["feeds"]["fresh"]["values"]["solid_flow"] == "20 t/h"
    selection = next(p for p in form["units"]["mill"]["parameters"] if p["name"] == "selection")
    option = selection["laws"]["austin_selection"]["parameters"]["selection_exponent"]
    assert option["label"].startswith("exposant")
    assert option["kind"], "a quantity of a law is a quantity of the form"

    def edit(table: str, name: str, key: str, text: str) -> httpx.Response:
        return client.post(
            "/api/case/edit", json={"case": case, "table": table, "name": name, "key": key, "text": text}
        )

    changed = edit("units", "mill", "holdup_mass", "2 tonne").json()["case"]
    assert changed == case.replace('holdup_mass = "1.6 tonne"', 'holdup_mass = "2 tonne"')
    law = edit("units", "mill", "mixing", '{"law": "plug_flow"}').json()["case"]
    assert 'mixing = {law = "plug_flow"}' in law
    assert "shaft_power" not in edit("units", "mill", "shaft_power", "").json()["case"]
    for odd in (
        ("units", "none", "a", "1"),
        ("streams", "product", "a", "1"),
        ("units", "mill", "mixing", "{law"),
    ):
        assert message(edit(*odd))
    assert message(client.post("/api/case/form", json={"case": "a = "}))


def test_a_case_reaches_no_file_outside_the_workspace(client: httpx.Client, workspace: Path) -> None:
    case = client.get("/api/examples/grinding-circuit/circuit.toml").json()["text"]
    secret = str(workspace.parent / "secret.toml")
    for named in (secret, "../secret.toml", "mine/../../secret.toml", "/etc/passwd"):
        told = message(
            client.post(
                "/api/run", json={"case": case.replace("[mixture]", f'[mixture]\nmaterials = ["{named}"]')}
            )
        )
        assert "not in the workspace" in told
        fit = f'\n[fits.f]\ntest = "filtration.leaf_test"\ndata = "{named}"\ngives = {{}}\n'
        assert "not in the workspace" in message(client.post("/api/run", json={"case": case + fit}))
        assert "not in the workspace" in message(
            client.post("/api/studies/choices", json={"case": case + fit})
        )
    assert "cannot be read" in message(
        client.post(
            "/api/run", json={"case": case.replace("[mixture]", '[mixture]\nmaterials = ["no.toml"]')}
        )
    )


def test_charts_are_plotly_json(client: httpx.Client) -> None:
    figure = client.post("/api/chart/particles.drag_chart", json={}).json()
    assert figure["data"]
    assert figure["layout"]
    assert "cannot be used here" in message(client.post("/api/chart/particles.reynolds_number", json={}))


def test_every_selection_guide_answers_its_own_example(client: httpx.Client) -> None:
    guides = [
        c["card"]
        for c in client.get("/api/cards?sort=procedure").json()["cards"]
        if c["card"].split(".")[1].startswith("choose") or c["card"].endswith("_choice")
    ]
    assert guides
    for guide in guides:
        form = client.get(f"/api/cards/{guide}").json()
        values = {
            p["name"]: f"{p['example']['number']} {p['example']['unit']}".strip()
            for p in form["parameters"]
            if p["example"]
        }
        answer = client.post(f"/api/calc/{guide}", json=values)
        assert answer.status_code == 200, answer.text[:300]
        table = answer.json()["table"]
        assert table, "a choice is shown as a table"
        assert all(len(row) == len(table["columns"]) for row in table["rows"])
    assert "is no table" in message(client.post(f"/api/calc/{guides[0]}", json={"solubility": "{law"}))


def test_other_laws_answer_the_same_question(client: httpx.Client) -> None:
    found = client.post("/api/spread/particles.terminal_velocity_stokes", json=SPHERE).json()
    own = [row for row in found["rows"] if row["own"]]
    assert [row["card"] for row in own] == ["particles.terminal_velocity_stokes"]
    assert len(found["rows"]) >= 4
    assert all(row["text"] for row in found["rows"])
    values = [row["value"] for row in found["rows"]]
    assert values == sorted(values)
    assert f"of {len(values)} laws" in found["summary"]["sentence"]


def test_files_stay_inside_the_workspace(client: httpx.Client, workspace: Path) -> None:
    assert client.get("/api/workspace").json()["files"] == ["mine.toml"]
    assert client.get("/api/workspace/mine.toml").json()["text"] == 'title = "mine"\n'
    for path in (
        "..%2fsecret.toml",
        "%2e%2e/secret.toml",
        "/etc/passwd",
        "%2fetc%2fpasswd",
        "a/..%2f..%2fsecret.toml",
        "mine.txt",
        "%00.toml",
        "x" * 5000 + ".toml",
    ):
        read = client.get(f"/api/workspace/{path}")
        assert message(read)
        assert "secret = true" not in read.text
        assert message(client.put(f"/api/workspace/{path}", json={"text": "x"}))
    assert (workspace.parent / "secret.toml").read_text() == "secret = true\n"
    link = workspace / "link.toml"
    link.symlink_to(workspace.parent / "secret.toml")
    assert message(client.get("/api/workspace/link.toml"))
    link.unlink()
    assert client.put("/api/workspace/new/line.toml", json={"text": "title = 'é'"}).status_code == 200
    assert (workspace / "new" / "line.toml").read_text(encoding="utf-8") == "title = 'é'"
    assert message(client.put("/api/workspace/new.toml/../mine.toml/x.toml", json={"text": "x"}))
    for path in ("/..%2fserver.py", "/%2e%2e/server.py", "/vendor/..%2f..%2fserver.py"):
        assert client.get(path).status_code == 404


def test_another_file_is_overwritten_only_when_that_is_said(client: httpx.Client, workspace: Path) -> None:
    assert client.put("/api/workspace/kept.toml", json={"text": "a = 1"}).status_code == 200
    refused = client.put("/api/workspace/kept.toml", json={"text": "a = 2"})
    assert "exists already" in message(refused)
    assert refused.json()["error"]["exists"] is True
    assert (workspace / "kept.toml").read_text() == "a = 1"
    assert client.put("/api/workspace/kept.toml", json={"text": "a = 2", "replace": True}).status_code == 200
    assert (workspace / "kept.toml").read_text() == "a = 2"
    (workspace / "kept.toml").unlink()


def test_the_lab_to_plant_example_is_studied_from_its_place(client: httpx.Client) -> None:
    place = "examples:lab-to-plant/line.toml"
    case = (
        client.get("/api/examples/lab-to-plant/line.toml").json()["text"].replace("steps = 16", "steps = 2")
    )
    choices = client.post("/api/studies/choices", json={"case": case, "place": place}).json()
    assert [row["name"] for row in choices["declared"]] == ["sizes", "influence", "cheapest", "safe", "depth"]
    area = next(f for f in choices["figures"] if f["name"] == "press.area")
    assert area["quantity"]["units"][0]["unit"] == "m^2"
    started = client.post("/api/studies", json={"case": case, "place": place, "declared": "depth"}).json()[
        "id"
    ]
    for _wait in range(1200):
        found = client.get(f"/api/studies/{started}").json()
        if found["state"] == "done":
            break
        time.sleep(0.2)
    assert found["outcome"]["counts"] == {**found["outcome"]["counts"], "run": 4, "failed": 0}


def test_every_trial_of_a_lab_test_has_its_columns_and_conditions(client: httpx.Client) -> None:
    tried = 0
    for row in client.get("/api/cards?sort=lab test").json()["cards"]:
        form = client.get(f"/api/cards/{row['card']}").json()
        if not form["trial"]:
            continue
        tried += 1
        names = {p["name"] for p in form["parameters"]}
        heads = next(line for line in form["trial"]["table"].splitlines() if not line.startswith("#"))
        assert set(form["trial"]["values"]) <= names
        assert {re.sub(r" ?\[.*", "", head) for head in heads.split(",")} <= names
        given = set(form["trial"]["values"])
        assert not [
            p["name"]
            for p in form["parameters"]
            if p["required"] and not p.get("series") and p["name"] not in given
        ]
    assert tried >= 8


def test_no_chart_in_a_file_offers_to_be_sent_away(client: httpx.Client) -> None:
    case = client.get("/api/examples/grinding-circuit/circuit.toml").json()["text"]
    page = client.post("/api/report", json={"case": case}).text
    drawn = page.count("Plotly.newPlot(")
    assert drawn
    assert page.count('"showSendToCloud": false') == drawn
    others = [
        str(p)
        for p in APP.parent.rglob("*.py")
        if ".to_html(" in p.read_text(encoding="utf-8") and p.name != "charts.py"
    ]
    assert not others, "charts become HTML in core.charts.as_html only"


def test_without_a_workspace_nothing_is_saved(serve: Any) -> None:
    with serve(create_app()) as address, httpx.Client(base_url=address) as bare:
        assert bare.get("/api/workspace").json() == {"files": None}
        assert "--workspace" in message(bare.put("/api/workspace/a.toml", json={"text": ""}))


def test_large_requests_are_refused_announced_or_not(client: httpx.Client) -> None:
    large = b"x" * (LARGEST_BODY + 1)
    assert client.post("/api/run", content=large).status_code == 413

    def pieces() -> Iterator[bytes]:
        for start in range(0, len(large), 500_000):
            yield large[start : start + 500_000]

    answer = client.post("/api/run", content=pieces())
    assert answer.status_code == 413
    assert "MB" in message(answer)


def test_a_token_is_needed_once_then_kept_as_a_cookie(serve: Any) -> None:
    with serve(create_app(token="open-sesame")) as address, httpx.Client(base_url=address) as guarded:
        assert "token" in message(guarded.get("/"))
        assert guarded.get("/api/cards").status_code == 401
        assert guarded.get("/api/examples?token=wrong").status_code == 401
        first = guarded.get("/api/examples?token=open-sesame")
        assert first.status_code == 200
        assert "HttpOnly" in first.headers["set-cookie"]
        assert guarded.get("/api/examples").status_code == 200


def test_only_loopback_goes_without_a_token() -> None:
    assert all(map(_loopback, ("127.0.0.1", "::1", "localhost")))
    assert not any(map(_loopback, ("0.0.0.0", "::", "192.168.1.4", "example.org")))


def test_pages_carry_a_policy(client: httpx.Client) -> None:
    for path in ("/", "/app.js", "/api/examples", "/nothing"):
        answer = client.get(path)
        assert "default-src 'self'" in answer.headers["content-security-policy"]
        assert answer.headers["x-content-type-options"] == "nosniff"
    assert "There is nothing" in message(client.get("/api/nothing"))


def test_an_overloaded_server_says_so_and_slow_work_is_given_up() -> None:
    import asyncio
    import threading

    async def crowd() -> list[Any]:
        release = threading.Event()
        workers = Workers(count=1, waiting=2, longest=30.0)
        jobs = [asyncio.create_task(workers.run(release.wait)) for _ in range(3)]
        _done, _rest = await asyncio.wait(jobs, return_when=asyncio.FIRST_COMPLETED)
        release.set()
        return await asyncio.gather(*jobs, return_exceptions=True)

    outcomes = asyncio.run(crowd())
    assert [type(o) for o in outcomes].count(Busy) == 1
    assert outcomes.count(True) == 2

    async def slow() -> None:
        release = threading.Event()
        try:
            await Workers(count=1, waiting=2, longest=0.05).run(release.wait)
        finally:
            release.set()

    with pytest.raises(Busy, match="given up"):
        asyncio.run(slow())


NAMES = st.sampled_from(
    [
        "reynolds_number",
        "particle_diameter",
        "fluid_density",
        "superficial_velocity",
        "dynamic_viscosity",
        "x",
        "",
    ]
)
SCALARS = st.none() | st.booleans() | st.floats() | st.integers() | st.text(max_size=12)
VALUES = SCALARS | st.lists(SCALARS, max_size=3) | st.dictionaries(st.text(max_size=5), SCALARS, max_size=2)


@settings(max_examples=60, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(
    key=st.sampled_from(
        [
            "particles.reynolds_number",
            "particles.size_summary",
            "comminution.energy_law",
            "particles.drag_coefficient_stokes",
        ]
    ),
    inputs=st.dictionaries(NAMES, VALUES, max_size=5),
)
def test_strange_inputs_are_never_a_fault(client: httpx.Client, key: str, inputs: dict[str, Any]) -> None:
    answer = client.post(
        f"/api/calc/{key}", content=json.dumps(inputs), headers={"content-type": "application/json"}
    )
    assert answer.status_code < 500, answer.text[:300]


def test_exercises_and_quizzes_speak_both_languages(client: httpx.Client) -> None:
    english, french = (
        client.get("/api/exercises", headers={"x-language": code}).json() for code in ("en", "fr")
    )
    pairs = zip(english["domains"], french["domains"], strict=True)
    assert all(a["name"] == b["name"] and a["exercises"] != b["exercises"] for a, b in pairs)
    texts = [
        client.get("/api/exercises/falling-crystal", params={"seed": 7}, headers={"x-language": code}).json()
        for code in ("en", "fr")
    ]
    assert texts[0]["statement"] != texts[1]["statement"]
    assert [s["inputs"] for s in texts[0]["steps"]] == [s["inputs"] for s in texts[1]["steps"]]
    assert "falling-crystal" in message(client.get("/api/exercises/falling-cristal"))
    mark = client.post("/api/exercises/falling-crystal", json={"step": 9, "answer": "1"})
    assert "3 steps" in message(mark)
    for quiz in english["quizzes"]:
        assert (
            any(o["right"] for o in quiz["options"])
            if "options" in quiz
            else {i["group"] for i in quiz["items"]} == {0, 1}
        )


def test_every_text_of_the_page_scripts_has_its_french() -> None:
    table = (APP / "static" / "strings.fr.js").read_text(encoding="utf-8")
    missing = set()
    for script in (APP / "static").glob("*.js"):
        code = script.read_text(encoding="utf-8")
        for _quote, text in re.findall(r"\bt\(\s*(['\"])(.+?)\1\s*[,)]", code):
            if f"'{text}':" not in table:
                missing.add(f"{script.name}: {text}")
        for text in re.findall(r"^  \['\w+', '([^']+)',", code, re.MULTILINE):  # titles of the pages
            if f"'{text}':" not in table:
                missing.add(f"{script.name}: {text}")
    missing |= {f"domain {d}" for d in registry.DOMAINS if f"'{d}':" not in table}
    assert not missing


def test_every_message_of_the_server_has_its_french() -> None:
    missing = set()
    for path in APP.rglob("*.py"):
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if (
                isinstance(node, ast.Call)
                and isinstance(node.func, ast.Name)
                and node.func.id == "_"
                and isinstance(node.args[0], ast.Constant)
            ):
                text = node.args[0].value
                if text not in catalog("fr"):
                    missing.add(text)
    assert not missing


@pytest.mark.parametrize("key", ["drying.choose", "filtration.separator_choice", "crystallization.choose"])
def test_what_has_no_symbol_is_told_by_its_name_in_words(client: httpx.Client, key: str) -> None:
    form = client.get(f"/api/cards/{key}").json()
    values = {
        p["name"]: f"{p['example']['number']} {p['example']['unit']}".strip()
        for p in form["parameters"]
        if p["example"]
    }
    found = client.post(f"/api/calc/{key}?lang=fr", json=values).json()
    names = {row["name"] for row in found["inputs_shown"]}
    assert names
    assert not [row for row in found["inputs_shown"] if row["symbol"] in names]
    assert all(row["label"] for row in found["inputs_shown"])
