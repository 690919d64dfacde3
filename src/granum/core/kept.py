"""What tracing made, kept in a folder for the next process that needs the same program.

A program is found again by everything its tracing looked at: the function and the fixed parts of its
arguments, shapes, every file of this package, the versions of what traces it, language and units. What cannot
be named that surely, such as a law somebody wrote, is not kept; what is found damaged is not used.
"""

from __future__ import annotations

import dataclasses
import functools
import io
import os
import pickle
import platform
import sys
import tempfile
from collections.abc import Callable
from functools import cache
from hashlib import sha256
from pathlib import Path
from typing import Any

from granum.core.errors import GranumError

MOST = 128_000_000
"""Bytes of kept programs; beyond, the oldest go."""
ENDING = ".trace"
TRACERS = ("jax", "jaxlib", "numpy", "equinox", "optimistix", "diffrax", "lineax")
TRUSTED = frozenset(("granum", "builtins", "collections", "functools", "pathlib", *TRACERS))
"""Packages whose code is the same whenever version and files are: all else may change unnoticed."""
HARMLESS = frozenset(
    ("complex", "slice", "frozenset", "set", "bytearray", "range", "bool", "int", "float", "str")
)
NO_DEFAULT = ("inspect", "_empty")
"""What stands on a card for a value that must be given."""

UNREADABLE = (AttributeError, ImportError, TypeError, ValueError, EOFError)
"""What a pickle that does not fit its readers raises."""

_folder: list[Path | None] = [None]
_pending: dict[Path, Callable[[], Any]] = {}


class Unkept(Exception):
    """Something that cannot be named for another process."""


class Slot:
    """Where an array stands in what is kept without its arrays."""


def is_slot(thing: Any) -> bool:
    """Whether something is a ``Slot``."""
    return isinstance(thing, Slot)


def keep_in(folder: Path | None) -> None:
    """Keep programs in a folder from now on, or none. For whole programs: what is changed in a running
    process is not noticed.
    """
    _folder[0] = folder
    _pending.clear()


def is_on() -> bool:
    """Whether programs are kept."""
    return _folder[0] is not None


def folder() -> Path | None:
    """Where programs are kept, if they are."""
    return _folder[0]


def look_around() -> None:
    """Note now what traces depend on: for a process that may outlive a change of the files it began with."""
    _surroundings()


class Named:
    """A program by what it is traced from, and whether it is kept.

    Parameters
    ----------
    identity: function, fixed arguments and whatever else tracing looks at; ``Slot`` for numbers.
    """

    def __init__(self, identity: Any):
        self._path, self._whole = None, []
        folder = _folder[0]
        if folder is not None:
            try:
                digest, self._whole = _digest(identity)
                self._path = folder / f"{digest}{ENDING}"
            except (Unkept, pickle.PicklingError, AttributeError, TypeError, ValueError, RecursionError):
                self._path = None

    @classmethod
    def by(cls, word: str) -> Named:
        """By a word: for what depends on nothing but the files of this package, and is read without JAX."""
        named = cls.__new__(cls)
        named._path, named._whole = None, []
        folder = _folder[0]
        if folder is not None:
            digest = sha256(_surroundings() + word.encode()).hexdigest()
            named._path = folder / f"{digest}{ENDING}"
        return named

    def found(self) -> Any:
        """What was kept under this name; None where there is nothing, or nothing whole."""
        if self._path is None:
            return None
        try:
            if not _is_ours(self._path.parent):
                return None
            content = self._path.read_bytes()
            if sha256(content[32:]).digest() != content[:32]:
                return None
            found = _Loader(content[32:], self._whole).load()
            os.utime(self._path)
        except OSError:
            return None
        except (pickle.UnpicklingError, GranumError, LookupError, *UNREADABLE):
            return None  # written by other code, which its name should have told
        return found

    def put(self, content: Callable[[], Any]) -> None:
        """Keep what ``content`` gives when the process ends; nothing, where that is None."""
        if self._path is not None:
            _pending[self._path] = functools.partial(_dumped, content, self._whole)


def card(key: str) -> Any:
    """The card of a key. Where programs are kept it is as an earlier process built it from the same files, so
    that what is only read about need not be imported.
    """
    named = Named.by(f"card {key}")
    found = named.found()
    if found is None:
        from granum.core import registry

        found = registry.find(key).card
        named.put(lambda: found)
    return found


def store() -> None:
    """Write what is to be kept, and let go of it: at the end of a process or while it rests, when the answer
    has been given.
    """
    written = False
    while _pending:
        path, dumped = _pending.popitem()
        written = True
        try:
            data = dumped()
            if data is not None:
                path.parent.mkdir(mode=0o700, parents=True, exist_ok=True)
                if _is_ours(path.parent):
                    _write(path, sha256(data).digest() + data)
        except (Unkept, pickle.PicklingError, AttributeError, TypeError, RecursionError, OSError):
            continue  # the next process traces anew
    if written and _folder[0] is not None:
        _make_room(_folder[0])


def _write(path: Path, data: bytes) -> None:
    handle, name = tempfile.mkstemp(dir=path.parent, prefix=".")
    try:
        with os.fdopen(handle, "wb") as stream:
            stream.write(data)
        os.replace(name, path)
    except OSError:
        Path(name).unlink(missing_ok=True)
        raise


def _make_room(folder: Path) -> None:
    try:
        files = [(path.stat(), path) for path in folder.glob(f"*{ENDING}")]
        total = 0
        for status, path in sorted(files, key=lambda row: row[0].st_mtime, reverse=True):
            total += status.st_size
            if total > MOST:
                path.unlink(missing_ok=True)
    except OSError:
        return  # another process makes room


def _is_ours(folder: Path) -> bool:
    """Whether nobody else may write there: what is read from it is believed."""
    if not hasattr(os, "getuid"):
        return True
    status = folder.stat()
    return status.st_uid == os.getuid() and not status.st_mode & 0o022


@cache
def _surroundings() -> bytes:
    """All that a trace depends on and no argument says."""
    from importlib.metadata import version

    settings = sorted(row for row in os.environ.items() if row[0].startswith(("JAX_", "XLA_", "GRANUM_")))
    settings = [row for row in settings if "CACHE" not in row[0]]
    told = sha256(repr([sys.version, platform.machine(), *map(version, TRACERS), settings]).encode())
    package = Path(__file__).parents[1]
    for path in sorted(package.rglob("*")):
        if path.suffix in (".py", ".csv", ".toml", ".po") and "static" not in path.parts:
            told.update(str(path.relative_to(package)).encode() + b"\0")
            told.update(path.read_bytes())
    return told.digest()


def _digest(identity: Any) -> tuple[str, list[Any]]:
    """A name for something, and the values within it that are taken as a whole."""
    import jax

    from granum.core.i18n import current_language
    from granum.core.units import unit_system

    file = io.BytesIO()
    writer = _Namer(file)
    writer.dump((identity, current_language(), unit_system(), jax.default_backend()))
    return sha256(_surroundings() + file.getvalue()).hexdigest(), writer.whole


def _card(key: str) -> Any:
    """Something declared, as another process finds it."""
    from granum.core import registry

    return registry.find(key)


def _whole(place: int) -> Any:
    """What stands at a place of the name of a program: its reader knows it."""
    raise LookupError(place)


def _reference(thing: Any) -> tuple[Callable[[str], Any], tuple[str]] | None:
    """How something declared is written."""
    from granum.core import registry  # commands that keep nothing need not know it

    key = registry.key_of(thing)
    return None if key is None or _root(thing) not in TRUSTED else (_card, (key,))


def _root(thing: Any) -> str:
    return (getattr(thing, "__module__", None) or "builtins").partition(".")[0]


class _Namer(pickle.Pickler):
    """Writes what a program is traced from, always alike; refuses what may change without a trace."""

    def __init__(self, file: Any):
        super().__init__(file, protocol=5)
        # what is met twice is written twice: whether equal things are one or two differs between a process
        # that made them and one that read them
        self.fast = True
        self.whole: list[Any] = []

    def reducer_override(self, thing: Any) -> Any:
        reference = _reference(thing)
        if reference is not None:
            return reference
        if callable(thing) and _root(thing) not in TRUSTED:
            raise Unkept
        if dataclasses.is_dataclass(thing) and not isinstance(thing, type):
            if not _is_module(thing):
                self.whole.append(thing)
            return type(thing), tuple(
                getattr(thing, f.name, None) for f in dataclasses.fields(thing) if f.compare
            )
        return NotImplemented


def _is_module(thing: Any) -> bool:
    """Whether something has leaves, so that two that are equal in all that is fixed may differ."""
    import jax

    return not jax.tree_util.all_leaves([thing])


def _dumped(content: Callable[[], Any], whole: list[Any]) -> bytes | None:
    found = content()
    if found is None:
        return None
    file = io.BytesIO()
    _Writer(file, whole).dump(found)
    return file.getvalue()


class _Writer(pickle.Pickler):
    """Writes what is kept; what stands in the name of it already is only pointed at."""

    def __init__(self, file: Any, whole: list[Any]):
        super().__init__(file, protocol=5)
        self._places = {id(thing): i for i, thing in enumerate(whole)}

    def reducer_override(self, thing: Any) -> Any:
        place = self._places.get(id(thing))
        if place is not None:
            return _whole, (place,)
        return _reference(thing) or NotImplemented


class _Loader(pickle.Unpickler):
    """Reads what was kept: data, and names within the packages that wrote it."""

    def __init__(self, data: bytes, whole: list[Any]):
        super().__init__(io.BytesIO(data))
        self._whole = whole

    def find_class(self, module_name: str, name: str) -> Any:
        if (module_name, name) == (__name__, _whole.__name__):
            return self._whole.__getitem__
        root = module_name.partition(".")[0]
        if (module_name, name) == NO_DEFAULT:
            return super().find_class(module_name, name)
        if root not in TRUSTED or (root == "builtins" and name not in HARMLESS):
            raise pickle.UnpicklingError(name)
        return super().find_class(module_name, name)
