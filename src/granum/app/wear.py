"""What a process has piled up: compiled code takes memory and memory maps, of which the system gives a
process only so many.
"""

from __future__ import annotations

import contextlib
import gc
import os
import threading
from pathlib import Path

# of the 65 530 that Linux gives a process by default; a compiled function takes about sixteen
MOST_MAPS = 20_000
MOST_MEMORY = 2_500_000_000  # bytes
# bytes beyond which the server drops compiled code, and again when so much has been added since
MUCH, MORE = 450_000_000, 40_000_000
# and a process with long work, before work of another sort: to make ready anew what is kept in files takes a
# second at most
CROWDED, MORE_CROWDED = 400_000_000, 40_000_000
BURSTING = 1_200_000_000  # bytes beyond which it does so even before work that it knows
# bytes beyond which a process that has nothing to do drops compiled code, and then gives way to a new one
IDLE_MEMORY = 400_000_000
_forgetting = threading.Lock()
_kept = 0.0


def resident(process: int | str = "self") -> float:
    """Bytes of memory that a process holds; 0 where the system does not tell."""
    try:
        pages = (Path("/proc") / str(process) / "statm").read_text().split()[1]
        return int(pages) * os.sysconf("SC_PAGE_SIZE")
    except (OSError, ValueError, IndexError):
        return 0.0


def worn(process: int | str = "self") -> bool:
    """Whether a process should make room; never where the system does not tell (then the limit of memory
    alone holds).
    """
    maps = Path("/proc") / str(process) / "maps"
    try:
        return resident(process) > MOST_MEMORY or maps.read_bytes().count(b"\n") > MOST_MAPS
    except OSError:
        return False


def give_back() -> None:
    """Hand memory that is free back to the system, where the C library can do that."""
    with contextlib.suppress(OSError, AttributeError):
        import ctypes

        ctypes.CDLL("libc.so.6").malloc_trim(0)


def forget_when_worn(much: float | None = None, more: float | None = None) -> bool:
    """Drop the compiled code of this process when it has piled up too much of it; says whether that was
    done.
    """
    global _kept
    if not _forgetting.acquire(blocking=False):
        return False
    try:
        much, more = MUCH if much is None else much, MORE if more is None else more
        if not worn() and resident() < max(much, _kept + more):
            return False
        from granum.core.compiling import forget

        forget()
        gc.collect()
        give_back()
        _kept = resident()
        return True
    finally:
        _forgetting.release()
