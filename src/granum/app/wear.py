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
MUCH, MORE = 550_000_000, 100_000_000
# bytes beyond which a process that has nothing to do gives way to a new one
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


def forget_when_worn() -> bool:
    """Drop the compiled code of this process when it has piled up too much of it; says whether that was
    done.
    """
    global _kept
    if not _forgetting.acquire(blocking=False):
        return False
    try:
        if not worn() and resident() < max(MUCH, _kept + MORE):
            return False
        import jax

        jax.clear_caches()
        gc.collect()
        with contextlib.suppress(OSError, AttributeError):
            import ctypes

            ctypes.CDLL("libc.so.6").malloc_trim(0)  # freed memory goes back to the system
        _kept = resident()
        return True
    finally:
        _forgetting.release()
