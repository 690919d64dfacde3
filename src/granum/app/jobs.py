"""Long work in processes of its own: cancelled when its client leaves, stopped when it takes too long or too
much memory.

What a study has computed by then is kept: its chunks lie in a folder from which another process reads them.
"""

from __future__ import annotations

import asyncio
import atexit
import contextlib
import os
import pickle
import queue
import secrets
import subprocess
import sys
import tempfile
import threading
import time
from collections.abc import Callable
from concurrent.futures import Future, ThreadPoolExecutor
from functools import cache
from pathlib import Path
from typing import Any

from fastapi import Request

from granum.app.limits import Busy
from granum.app.wear import IDLE_MEMORY, resident, worn
from granum.core import kept
from granum.core.errors import GranumError, InputError
from granum.core.i18n import _, current_language, language
from granum.core.units import unit_system

LOOK = 8  # jobs after which the memory of a process is looked at
REST = 30.0  # seconds without a job after which a process that still holds much memory is replaced
GRACE = 1.5  # seconds in which a cancelled job may still finish and its process stay warm
# seconds after which a job is one that somebody may cancel: a process for the next one is made ready
LONG = 6.0
STUDY = 3600.0  # seconds after which a study is given up
PATIENCE = STUDY  # seconds without a question after which it is taken to be forgotten: a tab may be closed


class Refused(GranumError):
    """A refusal of a worker process, as it was."""

    def __init__(self, shown: dict[str, Any], exit_code: int):
        super().__init__(str(shown["message"]))
        self._shown, self.exit_code = shown, exit_code

    def as_json(self) -> dict[str, object]:
        """The shape of the original error."""
        return self._shown


class Broken(Exception):
    """A fault of the program in a worker process."""


class GivenUp(Busy):
    """Work that was stopped before its end: cancelled, or beyond its limits of time or memory."""


class Job:
    """One piece of work: how far it is, and how to stop it.

    Parameters
    ----------
    longest: seconds after which it is given up.
    patience: seconds without a question after which its client is taken to have left; None when somebody
        waits for it.
    """

    def __init__(self, task: str, payload: Any, longest: float, patience: float | None = None):
        self.task, self.payload, self.longest, self.patience = task, payload, longest, patience
        self.language, self.units = current_language(), unit_system()
        self.share, self.note = 0.0, ""
        self.asked = time.monotonic()
        self.started: float | None = None
        self.cancelled = threading.Event()
        self.future: Future[bytes] = Future()

    @property
    def wanted(self) -> bool:
        """Whether anybody still waits for it."""
        left = self.patience is not None and time.monotonic() - self.asked > self.patience
        return not (left or self.cancelled.is_set())

    def as_json(self) -> dict[str, Any]:
        """How far it is."""
        since = 0.0 if self.started is None else time.monotonic() - self.started
        waiting = _("waiting for a free process") if self.started is None else ""
        return {
            "state": "running",
            "share": self.share,
            "note": self.note or waiting,
            "seconds": round(since, 1),
        }


class _Process:
    """A worker process and what it has worked on."""

    def __init__(self, memory: int, cache_folder: str):
        environment = os.environ | {
            "JAX_COMPILATION_CACHE_DIR": os.environ.get("JAX_COMPILATION_CACHE_DIR", cache_folder),
        }
        environment.setdefault("JAX_PERSISTENT_CACHE_MIN_COMPILE_TIME_SECS", "0.3")
        command = [sys.executable, "-m", "granum.app.worker", str(memory), str(kept.folder() or "")]
        self._process = subprocess.Popen(
            command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, env=environment
        )
        self._answers: queue.SimpleQueue[Any] = queue.SimpleQueue()
        self.known: set[str] = set()
        self.jobs = 0
        self.resting: threading.Timer | None = None
        self._reader = threading.Thread(target=self._listen, daemon=True)
        self._reader.start()

    def _listen(self) -> None:
        assert self._process.stdout is not None
        while True:
            try:
                self._answers.put(pickle.load(self._process.stdout))
            except (EOFError, OSError, pickle.UnpicklingError):
                self._answers.put(None)
                return

    @property
    def id(self) -> int:
        """Its number in the system."""
        return self._process.pid

    @property
    def alive(self) -> bool:
        return self._process.poll() is None

    def send(self, message: Any) -> None:
        assert self._process.stdin is not None
        pickle.dump(message, self._process.stdin)
        self._process.stdin.flush()

    def receive(self, wait: float) -> Any:
        """The next message; ``()`` when none came in time, None when the process has ended."""
        try:
            return self._answers.get(timeout=wait)
        except queue.Empty:
            return ()

    def stop(self) -> None:
        """End the process and close both ends of its pipes."""
        self._process.kill()
        self._process.wait()
        self._reader.join(timeout=5.0)
        for pipe in (self._process.stdin, self._process.stdout):
            if pipe is not None:
                with contextlib.suppress(OSError):
                    pipe.close()


class Crew:
    """Worker processes with a bounded queue.

    Parameters
    ----------
    count: processes at the same time, started when needed.
    waiting: jobs that may wait or run before newcomers are told to come back.
    memory: megabytes of memory a process may take.
    """

    def __init__(self, count: int = 2, waiting: int = 24, memory: int = 4000):
        self._count, self._waiting, self._memory = count, waiting, memory
        self._threads = ThreadPoolExecutor(count, thread_name_prefix="granum-crew")
        self._idle: list[_Process] = []
        self._lock = threading.Lock()
        self._now = 0
        self._coming = False
        self._closed = False
        self._asked_about: dict[str, Job] = {}
        self._folder = tempfile.TemporaryDirectory(prefix="granum-", ignore_cleanup_errors=True)

    def submit(
        self, task: str, payload: Any, key: str = "", longest: float = 300.0, patience: float | None = None
    ) -> Job:
        """Queue a job; ``key`` says which jobs share compiled code and solutions, whatever is asked of them.
        Refused when too many wait.
        """
        with self._lock:
            if self._now >= self._waiting:
                raise Busy(_("The server is busy. Try again in a moment."))
            self._now += 1
        job = Job(task, payload, longest, patience)
        self._threads.submit(self._work, job, key or task)
        return job

    async def run(
        self, task: str, payload: Any, key: str = "", request: Request | None = None, longest: float = 300.0
    ) -> bytes:
        """The answer of a job; the job is cancelled when the client of the request leaves.

        A client that names the job (header ``x-job``) can ask meanwhile how far it is.
        """
        job = self.submit(task, payload, key, longest)
        name = "" if request is None else request.headers.get("x-job", "")[:64]
        if name:
            self._asked_about[name] = job
        future = asyncio.wrap_future(job.future)
        future.add_done_callback(_heard)
        try:
            while True:
                done, _pending = await asyncio.wait([future], timeout=0.5)
                if done:
                    return future.result()
                if request is not None and await request.is_disconnected():
                    job.cancelled.set()
                    raise Busy(_("The calculation was canceled."))
        finally:
            if name and self._asked_about.get(name) is job:
                del self._asked_about[name]

    def progress(self, name: str) -> dict[str, Any]:
        """How far the job is that its client named so."""
        job = self._asked_about.get(name)
        return {"state": "none"} if job is None else job.as_json()

    @property
    def folder(self) -> Path:
        """Where jobs may keep files as long as the crew lives."""
        return Path(self._folder.name)

    def warm(self) -> None:
        """Have one process ready for the next job."""
        with self._lock:
            if self._closed or self._coming or any(p.alive for p in self._idle):
                return
            self._coming = True
        threading.Thread(target=self._make_ready, daemon=True).start()

    def _make_ready(self) -> None:
        try:
            self._give(_Process(self._memory, self._folder.name))
        finally:
            self._coming = False

    def close(self) -> None:
        """Stop every process: the idle ones now, a working one when it is given back."""
        self._closed = True
        self._threads.shutdown(wait=False, cancel_futures=True)
        with self._lock:
            idle, self._idle = self._idle, []
        for process in idle:
            process.stop()
        self._folder.cleanup()

    def _take(self, key: str) -> _Process:
        with self._lock:
            self._idle = [p for p in self._idle if p.alive]
            best = max(range(len(self._idle)), key=lambda i: key in self._idle[i].known, default=None)
            if best is not None:
                found = self._idle.pop(best)
                if found.resting is not None:
                    found.resting.cancel()
                return found
        return _Process(self._memory, self._folder.name)

    def _give(self, process: _Process) -> None:
        """Take a process back; of more than can be needed the one that has compiled least ends."""
        with self._lock:
            spare = [process] if self._closed else []
            if not self._closed:
                self._idle.append(process)
                process.resting = threading.Timer(REST, self._relieve, (process,))
                process.resting.daemon = True
                process.resting.start()
                if len(self._idle) > self._count:
                    spare = [min(self._idle, key=lambda p: len(p.known))]
                    self._idle.remove(spare[0])
        for one in spare:
            one.stop()

    def _relieve(self, process: _Process) -> None:
        """Replace a process that nobody needs now, if it holds much memory."""
        if resident(process.id) < IDLE_MEMORY:
            return
        with self._lock:
            if self._closed or process not in self._idle:
                return
            self._idle.remove(process)
        process.stop()
        self.warm()

    def _work(self, job: Job, key: str) -> None:
        """In a thread: find a process, hand over the job, watch it."""
        try:
            with language(job.language):
                job.future.set_result(self._worked(job, key))
        except BaseException as fault:
            job.future.set_exception(fault)
        finally:
            with self._lock:
                self._now -= 1

    def _worked(self, job: Job, key: str) -> bytes:
        if not job.wanted:
            raise Busy(_("The calculation was canceled."))
        process = self._take(key)
        try:
            return self._watch(job, process, key)
        finally:
            process.jobs += 1
            if process.alive and not (process.jobs % LOOK == 0 and worn(process.id)):
                process.known.add(key)
                self._give(process)
            else:
                process.stop()
                self.warm()

    def _watch(self, job: Job, process: _Process, key: str) -> bytes:
        job.started = started = time.monotonic()
        left = None
        process.send((job.task, job.payload, job.language, job.units, key not in process.known))
        while True:
            message = process.receive(0.2)
            now = time.monotonic()
            if now - started > LONG:
                self.warm()
            if message is None or (message and message[0] == "memory"):
                process.stop()
                raise GivenUp(
                    _("The calculation needed more memory than one calculation may have, and was given up.")
                )
            if message and message[0] == "progress":
                job.share, job.note = message[1:]
            elif message:
                return _outcome(*message)
            if left is None and not job.wanted:
                left = now
                self.warm()
                process.send(None)
            if left is not None and now - left > GRACE:
                process.stop()
                raise GivenUp(_("The calculation was canceled."))
            if now - started > job.longest:
                process.stop()
                raise GivenUp(
                    _("The calculation took longer than {seconds} s and was given up.").format(
                        seconds=int(job.longest)
                    )
                )


def _heard(future: asyncio.Future[bytes]) -> None:
    """A job whose client has left may end as it likes."""
    if not future.cancelled():
        future.exception()


def _outcome(sort: str, *rest: Any) -> bytes:
    if sort == "done":
        return rest[0]
    if sort == "refused":
        raise Refused(*rest)
    if sort == "cancelled":
        raise GivenUp(_("The calculation was canceled."))
    raise Broken(rest[0])


@cache
def crew() -> Crew:
    """The crew of this process: every application in it shares the workers."""
    made = Crew()
    atexit.register(made.close)
    return made


class Jobs:
    """Studies by name, about which a page asks again and again; one that nobody asks about for long is
    cancelled.

    One that was stopped gives what it had computed: its finished chunks are collected by another process.
    """

    def __init__(self, workers: Callable[[], Crew], patience: float = PATIENCE, kept: int = 50):
        self._workers, self._patience, self._kept = workers, patience, kept
        self._jobs: dict[str, Job] = {}

    def start(self, payload: dict[str, Any], key: str, longest: float = STUDY, task: str = "study") -> str:
        """Queue a study; gives the name under which to ask about it."""
        finished = [name for name, job in self._jobs.items() if job.future.done()]
        for old in finished[: max(len(self._jobs) - self._kept, 0)]:
            del self._jobs[old]
        name = secrets.token_urlsafe(12)
        parts = self._workers().folder / f"study-{name}"
        own = {"parts": str(parts), "collect": False}
        self._jobs[name] = self._workers().submit(task, payload | own, key, longest, self._patience)
        return name

    def find(self, name: str) -> Job:
        """A study by name; asking keeps it alive."""
        if name not in self._jobs:
            raise InputError(_("There is no job '{name}' any more.").format(name=name))
        job = self._jobs[name]
        job.asked = time.monotonic()
        stopped = job.future.done() and isinstance(job.future.exception(), GivenUp)
        if stopped and not job.payload["collect"] and any(Path(job.payload["parts"]).glob("cases-*")):
            job = self._jobs[name] = self._workers().submit(
                "study", job.payload | {"collect": True}, longest=60.0
            )
            job.note = _("collecting what was computed")
        return job

    def so_far(self, name: str) -> dict[str, Any] | None:
        """What another process reads to tell what a study has computed that still runs; None where that is
        nothing yet.
        """
        job = self.find(name)
        kept = not job.future.done() and any(Path(job.payload["parts"]).glob("cases-*"))
        return job.payload | {"collect": True, "goes_on": True} if kept else None
