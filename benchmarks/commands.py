"""What a command costs as a person types it: processor, wall time and peak memory of a process of its own."""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).parents[1]
GRANUM = [sys.executable, "-m", "granum"]


@dataclass(frozen=True)
class Cost:
    """Of one process: s, s, MB; exit status, and the last line of its complaints."""

    processor: float
    wall: float
    memory: float
    status: int
    complaint: str

    @property
    def figures(self) -> dict[str, float | str]:
        """What a row says besides the processor time."""
        ended = {"ended": f"exit status {self.status}: {self.complaint}"} if self.status else {}
        return {"wall, s": self.wall, "peak memory, MB": self.memory, **ended}


def cost(words: list[str], environment: dict[str, str] | None = None) -> Cost:
    """Run a command to its end."""
    with tempfile.TemporaryFile("w+", encoding="utf-8") as complaints:
        begun = time.perf_counter()
        child = subprocess.Popen(
            words, cwd=ROOT, env=environment, stdout=subprocess.DEVNULL, stderr=complaints
        )
        _pid, status, used = os.wait4(child.pid, 0)
        wall = time.perf_counter() - begun
        child.returncode = os.waitstatus_to_exitcode(status)
        complaints.seek(0)
        last = [line.strip() for line in complaints if line.strip()][-1:]
    memory = used.ru_maxrss * (1 if sys.platform == "darwin" else 1024) / 1e6
    return Cost(used.ru_utime + used.ru_stime, wall, memory, child.returncode, "".join(last))


@contextmanager
def empty_cache() -> Iterator[dict[str, str]]:
    """The environment of a person who has installed Granum and never run it: nothing traced or compiled is
    kept yet, but Python's own bytecode is.
    """
    with tempfile.TemporaryDirectory() as folder:
        own = ("JAX_", "PYTHONDONTWRITEBYTECODE")
        kept = {name: value for name, value in os.environ.items() if not name.startswith(own)}
        yield kept | {"XDG_CACHE_HOME": folder}
