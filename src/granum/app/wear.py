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
_forgetting = threading.Lock()


def worn(process: int | str = "self") -> bool:
    """Whether a process should make room; never where the system does not tell (then the limit of memory
    alone holds).
    """
    place = Path("/proc") / str(process)
    try:
        pages = int((place / "statm").read_text().split()[1])
        return (
            pages * os.sysconf("SC_PAGE_SIZE") > MOST_MEMORY
            or (place / "maps").read_bytes().count(b"\n") > MOST_MAPS
        )
    except (OSError, ValueError, IndexError):
        return False


def forget_when_worn() -> bool:
    """Drop the compiled code of this process when it has piled up too much of it; says whether that was
    done.
    """
    if not _forgetting.acquire(blocking=False):
        return False
    try:
        if not worn():
            return False
        import jax

        jax.clear_caches()
        gc.collect()
        with contextlib.suppress(OSError, AttributeError):
            import ctypes

            ctypes.CDLL("libc.so.6").malloc_trim(0)  # freed memory goes back to the system
        return True
    finally:
        _forgetting.release()
