"""A worker process of the app: takes one task after the other from its standard input, within a limit of
memory.

Started as ``python -m granum.app.worker MEGABYTES [FOLDER]``, with the folder of the programs that it keeps.
Messages are pickles between this process and the one that started it.
"""

from __future__ import annotations

import contextlib
import logging
import os
import pickle
import queue
import signal
import sys
import threading
from collections.abc import Callable, Iterator
from functools import partial
from pathlib import Path
from typing import Any, BinaryIO

from granum.app.wear import BURSTING, CROWDED, IDLE_MEMORY, MORE_CROWDED, forget_when_worn, give_back
from granum.core import kept
from granum.core.garbage import collect_seldom

DONE = object()
REST = 1.0  # seconds without a task after which programs are written and free memory is given back
LONG_REST = 15.0  # and after which compiled code is dropped, if there is much of it


def _limit(megabytes: int) -> None:
    """Cap the memory of this process where the system can do that."""
    with contextlib.suppress(ImportError, ValueError, OSError):
        import resource

        resource.setrlimit(resource.RLIMIT_DATA, (megabytes * 1_000_000, megabytes * 1_000_000))


def _next(
    tasks: queue.SimpleQueue[Any], preparing: Iterator[None], warm_up: Callable[[], object] | None
) -> Any:
    """The next task; while none is there, what every task may need is read, a process that has done its first
    warms up, since somebody uses the page, what tracing made is written, and what compiling took and does not
    need any more, several hundred megabytes at times, goes back to the system; in the end what was compiled
    goes, too, if it is much.
    """
    while tasks.empty():
        if next(preparing, DONE) is DONE:
            break
    try:
        return tasks.get(timeout=REST)
    except queue.Empty:
        if warm_up is not None:
            warm_up()
        kept.store()
        give_back()
    try:
        return tasks.get(timeout=LONG_REST)
    except queue.Empty:
        forget_when_worn(IDLE_MEMORY, MORE_CROWDED)
        return tasks.get()


def _prepared() -> Iterator[None]:
    """Step by step: all that is declared, and the units. A first task does not wait for it: it takes what it
    needs.
    """
    from granum.core import registry, unit_names

    unit_names.registry()
    yield
    for domain in registry.DOMAINS:
        registry.load(domain)
        yield


def _listen(source: BinaryIO, tasks: queue.SimpleQueue[Any], cancelled: threading.Event) -> None:
    """Sort what arrives: tasks into the queue, a wish to cancel into the event; the end of the input ends the
    process.
    """
    while True:
        try:
            message = pickle.load(source)
        except (EOFError, OSError):
            os._exit(0)
        if message is None:
            cancelled.set()
        else:
            tasks.put(message)


def main() -> None:
    """Serve tasks until the input ends."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl+C is for the server, which then closes our input
    answers = os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)  # whatever a library prints must not end up between the answers
    _limit(int(sys.argv[1]))
    collect_seldom()
    if len(sys.argv) > 2 and sys.argv[2]:
        kept.keep_in(Path(sys.argv[2]))
        kept.look_around()
    tasks: queue.SimpleQueue[Any] = queue.SimpleQueue()
    cancelled = threading.Event()
    threading.Thread(target=_listen, args=(sys.stdin.buffer, tasks, cancelled), daemon=True).start()

    def send(*message: Any) -> None:
        pickle.dump(message, answers)
        answers.flush()

    from numpy.linalg import LinAlgError

    from granum.app.tasks import TASKS
    from granum.app.telling import Cancelled, Tell
    from granum.core.errors import ApplicabilityError, GranumError
    from granum.core.i18n import _, set_language
    from granum.core.units import set_unit_system

    tell = Tell(lambda share, note: send("progress", float(share), note), cancelled.is_set)
    warm_up, done, preparing = partial(TASKS["warm_up"], {}, Tell()), 0, _prepared()
    while True:
        name, payload, code, units, new = _next(tasks, preparing, warm_up if done == 1 else None)
        done += 1
        forget_when_worn(CROWDED if new else BURSTING, MORE_CROWDED)
        cancelled.clear()
        set_language(code)
        set_unit_system(units)
        try:
            send("done", TASKS[name](payload, tell))
        except Cancelled:
            send("cancelled")
        except GranumError as fault:
            send("refused", fault.as_json(), fault.exit_code)
        except MemoryError:
            send("memory")
        except (ArithmeticError, LinAlgError) as fault:
            told = ApplicabilityError(
                _(
                    "The numbers got out of hand with these inputs ({reason}). Are they of the right size?"
                ).format(reason=fault)
            )
            send("refused", told.as_json(), told.exit_code)
        except Exception as fault:
            if "RESOURCE_EXHAUSTED" in str(fault) or "bad_alloc" in str(fault):
                send("memory")
            else:
                logging.getLogger("granum").error("%s", name, exc_info=fault)
                send("broken", type(fault).__name__)


if __name__ == "__main__":
    main()
