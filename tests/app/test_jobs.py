"""Long work: studies with progress and cancel, limits of time and memory, a bounded queue, clients that
leave.
"""

from __future__ import annotations

import json
import queue
import subprocess
import sys
import time
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

import httpx
import pytest
from tests.sharing.falling import SPHERE, STOKES

from granum.app import jobs, tasks, wear, worker
from granum.app import studies as app_studies
from granum.app.jobs import Crew, GivenUp, Job, Jobs, Refused
from granum.app.limits import Busy, Familiar
from granum.app.server import create_app
from granum.app.telling import Cancelled, Tell, progress_text
from granum.core.errors import InputError
from granum.core.i18n import language
from granum.studies import Study, chunks

STUDY = {"card": STOKES, "inputs": SPHERE, "varied": ["particle_diameter"]}


@pytest.fixture(scope="module")
def client(serve: Any) -> Iterator[httpx.Client]:
    with serve(create_app()) as address, httpx.Client(base_url=address, timeout=300.0) as found:
        yield found


@pytest.fixture(scope="module")
def crew() -> Iterator[Crew]:
    """One process at a time, shared by the tests below: each start of one takes seconds."""
    made = Crew(count=1, waiting=2, memory=2500)
    yield made
    made.close()


def finished(client: httpx.Client, study: dict[str, Any]) -> httpx.Response:
    started = client.post("/api/studies", json=study)
    assert started.status_code == 202, started.text
    until = time.monotonic() + 240
    while time.monotonic() < until:
        answer = client.get(f"/api/studies/{started.json()['id']}")
        if answer.status_code != 200 or answer.json()["state"] == "done":
            return answer
        time.sleep(0.1)
    raise AssertionError("the study did not end")


def test_a_sweep_follows_the_law(client: httpx.Client) -> None:
    table = {"kind": "sweep", "over": {"particle_diameter": {"from": "20 um", "to": "80 um", "steps": 4}}}
    outcome = finished(client, STUDY | {"table": table}).json()["outcome"]
    v = outcome["cases"]["terminal_velocity"]
    assert [x / v[0] for x in v] == pytest.approx([1.0, 4.0, 9.0, 16.0])  # Stokes: the square of the diameter
    assert outcome["charts"]
    assert len(outcome["tables"][0]["rows"]) == 4
    assert outcome["counts"]["failed"] == 0


def test_choices_of_a_card_and_of_a_line(client: httpx.Client) -> None:
    found = client.post("/api/studies/choices", json=STUDY).json()
    diameter = next(i for i in found["inputs"] if i["name"] == "particle_diameter")
    assert (diameter["value"], diameter["unit"]) == ("", "um")  # varied, so without a value of its own
    assert found["figures"][0]["name"] == "terminal_velocity"
    case = client.get("/api/examples/grinding-circuit/circuit.toml").json()["text"]
    line = client.post("/api/studies/choices", json={"case": case}, headers={"x-language": "fr"}).json()
    names = {i["name"] for i in line["inputs"]}
    assert {"mill.holdup_mass", "fresh.mass_flow"} <= names
    assert "product.median_size" in {f["name"] for f in line["figures"]}


@pytest.mark.parametrize(
    "study",
    [
        {},
        {"card": "no.card", "table": {"kind": "sweep"}},
        STUDY | {"table": "sweep"},
        STUDY | {"table": {"kind": "guess"}},
        STUDY | {"table": {"kind": "sweep", "over": {"nothing": {"from": 1, "to": 2}}}},
        STUDY
        | {
            "table": {
                "kind": "monte_carlo",
                "samples": 10**9,
                "uncertain": {"particle_diameter": {"distribution": "normal"}},
            }
        },
        STUDY
        | {"table": {"kind": "sweep", "over": {"particle_diameter": {"from": 1, "to": 2, "steps": 1e300}}}},
        {"case": "title = ", "table": {"kind": "sweep"}},
    ],
)
def test_a_study_that_cannot_be_is_explained(client: httpx.Client, study: dict[str, Any]) -> None:
    answer = finished(client, study)
    assert answer.status_code == 422
    assert answer.json()["error"]["message"]


def test_a_study_can_be_cancelled(client: httpx.Client) -> None:
    table = {"kind": "monte_carlo", "samples": 20000, "uncertain": {"drag": {}}}
    name = client.post("/api/studies", json=STUDY | {"table": table}).json()["id"]
    assert client.delete(f"/api/studies/{name}").json() == {"state": "cancelled"}
    assert client.get("/api/studies/nobody").status_code == 422


def test_what_nobody_asks_about_is_cancelled(crew: Crew, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(jobs, "GRACE", 0.2)
    held = Jobs(lambda: crew, patience=0.3)
    name = held.start({"seconds": 60}, "", longest=100.0, task="rest")
    job = held._jobs[name]
    with pytest.raises(GivenUp, match="canceled"):
        job.future.result(timeout=60)
    assert jobs.PATIENCE >= 600  # a hidden page asks once a minute
    with pytest.raises(InputError, match="no job"):
        held.find("other")


SPREAD = STUDY | {
    "table": {
        "kind": "monte_carlo",
        "samples": 20_000,
        "uncertain": {
            "particle_diameter": {"distribution": "normal", "mean": "85 um", "standard_deviation": "1 um"}
        },
    }
}


def test_a_stopped_study_gives_what_it_has_computed() -> None:
    """Stopped after one of its two chunks: marked as partial, with figures from the cases that were run."""
    said = [""]
    found = tasks.TASKS["study"](
        SPREAD, Tell(lambda share, note: said.append(note), lambda: "left" in said[-1])
    )
    outcome = json.loads(found)
    run = outcome["counts"]["run"]
    assert not outcome["complete"]
    assert run in (16_384, 3_616)  # whichever was first
    assert f"The study was stopped: {run} of 20000 cases were run." in outcome["warnings"]
    assert outcome["tables"][0]["rows"]
    assert said[1:3] == ["preparing the model", "0 of 20\u202f000"]
    with pytest.raises(Cancelled):  # nothing computed yet: nothing to show
        tasks.TASKS["study"](
            SPREAD, Tell(lambda share, note: said.append(note), lambda: said[-1].startswith("0 of"))
        )


@pytest.mark.parametrize(
    "table",
    [
        {"kind": "sweep", "over": {"particle_diameter": {"from": "20 um", "to": "80 um", "steps": 40}}},
        {
            "kind": "map",
            "over": {
                name: {"from": "1e-3", "to": "2e-3", "steps": 8}
                for name in ("particle_diameter", "dynamic_viscosity")
            },
        },
        {"kind": "sobol", "samples": 16, "uncertain": SPREAD["table"]["uncertain"]},
    ],
    ids=lambda table: table["kind"],
)
def test_every_kind_of_study_shows_a_part_of_itself(
    table: dict[str, Any], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(chunks.CHUNKS, "batched", 4)
    said = [""]
    wanted = STUDY | {"varied": list(table.get("over") or table["uncertain"]), "table": table}
    found = tasks.TASKS["study"](
        wanted, Tell(lambda share, note: said.append(note), lambda: "left" in said[-1])
    )
    outcome = json.loads(found)
    assert not outcome["complete"]
    assert outcome["counts"]["run"] == 4
    assert outcome["charts"] or table["kind"] == "sobol"  # shares of the variance need every case


def test_what_a_killed_study_has_computed_is_collected(crew: Crew, tmp_path: Path) -> None:
    """Its process is gone; its chunks are read by another one."""
    held = Jobs(lambda: crew)
    killed = Job("study", SPREAD | {"parts": str(tmp_path / "parts"), "collect": False}, longest=1.0)
    killed.future.set_exception(GivenUp("killed"))
    held._jobs["mine"] = killed
    with pytest.raises(GivenUp, match="killed"):  # nothing was kept: there is nothing to collect
        held.find("mine").future.result(timeout=1)
    counted: list[int] = []
    study = Study.of("monte_carlo", SPREAD["table"], app_studies.subject(SPREAD))
    study.run(
        folder=tmp_path / "parts", progress=lambda p: counted.append(p.done), cancel=lambda: len(counted) > 1
    )
    outcome = json.loads(held.find("mine").future.result(timeout=100))
    assert (outcome["complete"], outcome["counts"]["run"]) == (False, counted[1])
    assert not (tmp_path / "parts").exists()
    assert json.loads(held.find("mine").future.result(timeout=1)) == outcome  # and can be asked for again


def test_a_study_that_runs_is_read_by_another_process(crew: Crew, tmp_path: Path) -> None:
    """What it has is told as a part, and stays where it is for the study that goes on."""
    held, parts = Jobs(lambda: crew), tmp_path / "parts"
    running = Job("study", SPREAD | {"parts": str(parts), "collect": False}, longest=100.0)
    held._jobs["mine"] = running
    assert held.so_far("mine") is None  # nothing yet
    counted: list[int] = []
    study = Study.of("monte_carlo", SPREAD["table"], app_studies.subject(SPREAD))
    study.run(folder=parts, progress=lambda p: counted.append(p.done), cancel=lambda: len(counted) > 1)
    payload = held.so_far("mine")
    assert payload is not None
    outcome = json.loads(crew.submit("study", payload).future.result(timeout=100))
    assert (outcome["complete"], outcome["goes_on"]) == (False, True)
    assert outcome["counts"]["run"] == counted[1]
    assert outcome["tables"][0]["rows"]
    assert outcome["charts"]
    assert [text for text in outcome["warnings"] if "the study goes on" in text]
    assert not [text for text in outcome["warnings"] if "stopped" in text]
    assert list(parts.glob("cases-*"))
    running.future.set_result(b"{}")
    assert held.so_far("mine") is None  # its own answer is there


def test_progress_in_words() -> None:
    assert progress_text(412, 3000, 0, 41.3) == "412 of 3\u202f000, about 40 s left"
    assert progress_text(412, 3000, 2, 340.0) == "412 of 3\u202f000, 2 failed, about 6 min left"
    assert progress_text(0, 3000, 0, None) == "0 of 3\u202f000"
    with language("fr"):
        assert progress_text(412, 3000, 0, 3.4) == "412 sur 3\u202f000, encore 3 s environ"


def test_a_request_can_be_asked_how_far_it_is(client: httpx.Client) -> None:
    assert client.get("/api/progress/mine").json() == {"state": "none"}
    case = client.get("/api/examples/humid-air/line.toml").json()["text"]
    seen: list[dict[str, Any]] = []
    with ThreadPoolExecutor(1) as pool:
        answer = pool.submit(
            lambda: client.post(
                "/api/run", json={"case": case}, headers={"x-job": "mine", "x-language": "fr"}
            )
        )
        while not answer.done():
            seen.append(client.get("/api/progress/mine").json())
            time.sleep(0.02)
    assert answer.result().status_code == 200
    notes = {row["note"] for row in seen if row["state"] == "running"}
    assert notes & {"lecture du cas", "compilation et résolution", "résolution"}, seen[:5]
    assert client.get("/api/progress/mine").json() == {"state": "none"}


def test_a_process_is_ready_when_a_long_job_is_cancelled(monkeypatch: pytest.MonkeyPatch) -> None:
    """The next job need not wait until a new process has started: one starts while the long job runs."""
    started: list[Any] = []

    class Stub:
        """A process that works for ever and says nothing."""

        def __init__(self, *_: Any):
            started.append(self)
            self.id, self.jobs, self.known, self.alive = len(started), 0, set(), True

        def send(self, message: Any) -> None:
            self.message = message

        def receive(self, wait: float) -> Any:
            time.sleep(0.01)
            return ("done", b"{}") if self.message and self.message[0] == "short" else ()

        def stop(self) -> None:
            self.alive = False

    monkeypatch.setattr(jobs, "_Process", Stub)
    monkeypatch.setattr(jobs, "GRACE", 0.05)
    monkeypatch.setattr(jobs, "LONG", 0.05)
    made = Crew(count=1)
    slow = made.submit("long", {})
    until = time.monotonic() + 10
    while len(started) < 2 and time.monotonic() < until:
        time.sleep(0.01)
    assert len(started) == 2
    slow.cancelled.set()
    assert made.submit("short", {}).future.result(timeout=10) == b"{}"
    assert [p.alive for p in started] == [False, True]
    assert started[1].jobs == 1
    made.close()


def test_time_and_queue_are_bounded(crew: Crew) -> None:
    slow = crew.submit("rest", {"seconds": 60}, longest=0.3)
    second = crew.submit("calculate", {"key": "particles.terminal_velocity_stokes", "inputs": SPHERE})
    with pytest.raises(Busy, match="busy"):
        crew.submit("rest", {"seconds": 0})
    with pytest.raises(Busy, match="given up"):
        slow.future.result(timeout=100)
    assert json.loads(second.future.result(timeout=100))["outputs"]["terminal_velocity"][
        "value"
    ] == pytest.approx(5.28e-3, rel=1e-2)
    with pytest.raises(Refused, match=r"no\.such"):
        crew.submit("chart", {"key": "no.such", "inputs": {}}).future.result(timeout=100)


def test_memory_is_bounded(crew: Crew) -> None:
    with pytest.raises(Busy, match="memory"):
        crew.submit("fill", {"bytes": 3_000_000_000}).future.result(timeout=100)
    # the next job finds a new process
    assert json.loads(crew.submit("rest", {"seconds": 0}).future.result(timeout=100)) == {}


def test_a_worn_process_is_replaced_and_nothing_is_lost(crew: Crew, monkeypatch: pytest.MonkeyPatch) -> None:
    ask = {"key": "particles.terminal_velocity_stokes", "inputs": SPHERE}
    monkeypatch.setattr(jobs, "LOOK", 1)
    monkeypatch.setattr(jobs, "worn", lambda process: seen.append(process) or len(seen) == 1)
    seen: list[int] = []
    answers = [crew.submit("calculate", ask).future.result(timeout=100) for _ in range(3)]
    assert len(set(answers)) == 1
    assert seen[0] != seen[1] == seen[2]


def test_an_idle_process_that_holds_much_memory_is_replaced(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(jobs, "REST", 0.2)
    made = Crew(count=1, waiting=2, memory=2500)
    try:
        made.submit("rest", {"seconds": 0}).future.result(timeout=100)
        light = made._idle[0]
        time.sleep(0.5)
        assert made._idle == [light]
        monkeypatch.setattr(jobs, "IDLE_MEMORY", 0.0)
        made.submit("rest", {"seconds": 0}).future.result(timeout=100)
        deadline = time.monotonic() + 60.0
        while not made._idle or made._idle == [light]:
            assert time.monotonic() < deadline
            time.sleep(0.05)
        assert not light.alive
        assert json.loads(made.submit("rest", {"seconds": 0}).future.result(timeout=100)) == {}
    finally:
        made.close()


def test_a_worker_at_rest_gives_back_what_it_does_not_need(monkeypatch: pytest.MonkeyPatch) -> None:
    waiting: queue.SimpleQueue[Any] = queue.SimpleQueue()
    given: list[str] = []

    def give_back() -> None:
        given.append("memory")
        waiting.put("the next")

    monkeypatch.setattr(worker, "REST", 0.01)
    monkeypatch.setattr(worker, "give_back", give_back)
    assert worker._next(waiting, iter(()), lambda: given.append("warm")) == "the next"
    waiting.put("at once")
    assert worker._next(waiting, iter(()), lambda: given.append("again")) == "at once"
    assert given == ["warm", "memory"]


def test_a_worker_that_rests_long_drops_what_it_has_compiled_if_it_is_much(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    waiting: queue.SimpleQueue[Any] = queue.SimpleQueue()
    asked: list[float] = []

    def forget(much: float, _more: float) -> None:
        asked.append(much)
        waiting.put("the next")

    monkeypatch.setattr(worker, "REST", 0.01)
    monkeypatch.setattr(worker, "LONG_REST", 0.01)
    monkeypatch.setattr(worker, "give_back", lambda: None)
    monkeypatch.setattr(worker, "forget_when_worn", forget)
    assert worker._next(waiting, iter(()), None) == "the next"
    assert asked == [wear.IDLE_MEMORY], "the server replaces what holds more than that"


def test_a_task_does_not_wait_until_a_new_worker_has_read_everything() -> None:
    waiting: queue.SimpleQueue[Any] = queue.SimpleQueue()
    read: list[int] = []

    def steps() -> Iterator[None]:
        for step in range(9):
            read.append(step)
            if step == 2:
                waiting.put("a task")
            yield

    preparing = steps()
    assert worker._next(waiting, preparing, None) == "a task"
    assert read == [0, 1, 2]
    waiting.put("another")
    assert worker._next(waiting, preparing, None) == "another"
    assert read == [0, 1, 2]


def test_compiled_code_is_forgotten_when_there_is_much_of_it(monkeypatch: pytest.MonkeyPatch) -> None:
    import jax

    monkeypatch.setattr(wear, "MOST_MEMORY", 2**50)  # a process that has run many tests may be worn indeed
    monkeypatch.setattr(wear, "MOST_MAPS", 2**30)
    monkeypatch.setattr(wear, "MUCH", 2**50)
    assert not wear.worn()
    assert not wear.worn(2**30)  # no such process
    monkeypatch.setattr(wear, "MOST_MAPS", 10)
    assert wear.worn()
    function = jax.jit(lambda x: x + 1.0)
    assert function(1.0) == 2.0
    familiar = Familiar()
    monkeypatch.setattr(familiar, "look", 2)
    for name in "ab":
        familiar.meet(name, {"x": 1}, lambda: None)
    assert not familiar.knows("a", {"x": 1})
    assert familiar.knows("b", {"x": 1})
    assert function(2.0) == 3.0


def test_familiar_calculations_are_those_of_one_number_each() -> None:
    familiar = Familiar()
    form = familiar._form
    assert form("k", {"a": "85 um", "b": 1.0}) == form("k", {"a": "1,2e-3 mm", "b": 7})
    assert form("k", {"a": "stokes"}) != form("k", {"a": "allen"})
    assert form("k", {"a": "1 2 3 um"}) != form("k", {"a": "1 2 3 4 um"})
    assert form("k", {"a": [1.0]}) is None
    assert form("k", {"a": "x" * 61}) is None
    assert not familiar.knows("k", {"a": 1})
    familiar.meet("k", {"a": 1}, lambda: None)
    assert familiar.knows("k", {"a": "2 mm"})
    with pytest.raises(InputError):
        familiar.meet("k", {"b": 1}, lambda: tasks.evaluable("no.card", ()))
    assert not familiar.knows("k", {"b": 1})


def test_a_process_at_rest_has_loaded_nothing_that_only_studies_and_fits_need() -> None:
    script = (
        "import sys; import granum.app.tasks; from granum.core import registry; registry.everything(); "
        "print([m for m in ('scipy.stats', 'scipy.optimize', 'pandas', 'openpyxl') if m in sys.modules])"
    )
    told = subprocess.run([sys.executable, "-c", script], check=True, capture_output=True, text=True)
    assert told.stdout.strip() == "[]"
