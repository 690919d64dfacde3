"""Shared test settings: importing granum switches JAX to double precision before anything else does."""

import ctypes
import gc
import os
import tempfile
import time
from pathlib import Path

# Test processes and the pages of the documentation share what they compile, also after forgetting it: of
# thirty-six thousand programs in a run most are small, and met again. A folder already named in the
# environment is kept.
os.environ.setdefault("JAX_COMPILATION_CACHE_DIR", str(Path(tempfile.gettempdir()) / "granum-compiled"))
os.environ.setdefault("JAX_PERSISTENT_CACHE_MIN_COMPILE_TIME_SECS", "0")
# Tests compile much and compute little: these flags make the compiler quick and large arrays slow, and
# change nothing else.
os.environ["XLA_FLAGS"] = " ".join(
    [
        os.environ.get("XLA_FLAGS", ""),
        "--xla_cpu_use_fusion_emitters=false",
        "--xla_backend_optimization_level=0",
        # as many processes as cores are at it
        "--xla_cpu_parallel_codegen_split_count=1",
    ]
).strip()

import pytest
from hypothesis import settings

import granum  # noqa: F401
from granum.core.garbage import collect_seldom
from granum.core.operations import Step
from granum.core.traces import Operation

collect_seldom()

settings.register_profile("granum", deadline=None, max_examples=40, derandomize=True)
settings.load_profile("granum")

MAPS = Path("/proc/self/maps")
# of the 65 530 that Linux gives a process by default; every compiled function takes several
MANY_MAPS = 20_000
RESIDENT = Path("/proc/self/statm")
# bytes in use at which compiled functions are forgotten, and again when so much has been added since
MUCH, MORE = 1.7e9, 0.4e9
# what `pytest -m quick` runs: a minute of two cores
QUICK = (
    "cases/",
    "centrifuges/",
    "contracts/test_french.py",
    "contracts/test_inputs.py",
    "contracts/test_ranges.py",
    "core/",
    "costs/",
    "materials/",
    "porous/",
)
# between two looks, seconds: a list of twenty thousand maps takes some time to read
SELDOM = 2.0
_kept = _looked = 0.0


def pytest_ignore_collect(collection_path: Path, config: pytest.Config) -> bool | None:
    """What has no quick test need not be read to find that out."""
    if config.option.markexpr != "quick" or collection_path.suffix != ".py":
        return None
    return True if not _is_quick(collection_path) else None


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    for item in items:
        if _is_quick(item.path):
            item.add_marker(pytest.mark.quick)


def pytest_collection_finish() -> None:
    """Seventeen thousand tests, and all that was imported for them, stay to the end: whoever looks for
    garbage need not look there.
    """
    gc.collect()
    gc.freeze()


def _is_quick(path: Path) -> bool:
    return path.relative_to(Path(__file__).parent).as_posix().startswith(QUICK)


@pytest.fixture(autouse=True)
def _bounded_memory():
    """Thousands of compiled functions in one process would exhaust memory and its maps: forget them before
    that.
    """
    global _looked
    yield
    if time.monotonic() - _looked < SELDOM:
        return
    if _resident() > max(MUCH, _kept + MORE) or _maps() > MANY_MAPS:
        _forget()
    _looked = time.monotonic()


@pytest.fixture
def left_to_jax(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """Operations that NumPy does not do in programs read meanwhile: such a program is kept for no later
    process, and each traces it anew.
    """
    from granum.core import uncompiled

    names, by_jax = [], uncompiled.operation

    def noted(op: Operation) -> Step:
        names.append(op.name)
        return by_jax(op)

    monkeypatch.setattr(uncompiled, "operation", noted)
    return names


def _maps() -> int:
    return MAPS.read_bytes().count(b"\n") if MAPS.exists() else 0


def _resident() -> float:
    return int(RESIDENT.read_bytes().split()[1]) * os.sysconf("SC_PAGE_SIZE") if RESIDENT.exists() else 0.0


def _forget() -> None:
    global _kept
    from granum.core.compiling import forget

    forget()
    gc.collect()
    # what is freed stays with the process unless glibc is asked
    trim = getattr(ctypes.CDLL(None), "malloc_trim", None)
    if trim is not None:
        trim(0)
    _kept = _resident()
