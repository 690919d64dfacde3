"""Finished cases of a study on disk, so that a study that was stopped continues where it was and never with
cases that are not its own.
"""

from __future__ import annotations

import hashlib
import io
import json
import shutil
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from granum.core.errors import InputError, reason_of
from granum.core.files import check_writable, write_atomic
from granum.core.i18n import _

MANIFEST = "study.json"
SEAL = hashlib.sha256().digest_size


class Part(NamedTuple):
    """Figures, codes and texts of refusals of some consecutive cases, and which solver each took, from 0."""

    y: np.ndarray
    codes: np.ndarray
    texts: dict[int, str]
    rungs: np.ndarray


class Store:
    """Chunks on disk, each written whole or not at all and sealed with a digest of its content, its place and
    the study it belongs to.
    """

    def __init__(self, folder: Path):
        """Claim a folder, before anything is computed: it is empty or holds a study, and can be written."""
        self.folder = folder
        self._study = ""
        try:
            folder.mkdir(parents=True, exist_ok=True)
            strange = (
                any(not p.name.startswith(f".{MANIFEST}.") for p in folder.iterdir())
                and not (folder / MANIFEST).exists()
            )
        except OSError as problem:
            raise InputError(
                _("'{path}' cannot be written: {reason}.").format(path=folder, reason=reason_of(problem)),
                path=str(folder),
            ) from None
        if strange:
            raise InputError(
                _("'{folder}' is not empty and holds no study: choose another folder.").format(folder=folder),
                path=str(folder),
            )
        check_writable(folder / MANIFEST)

    def open(self, fingerprint: str, names: tuple[Any, ...], x: np.ndarray) -> int | None:
        """Whether the study is already here: the size of its chunks, None when the folder is new."""
        digest = hashlib.sha256(fingerprint.encode())
        digest.update(repr(names).encode() + np.ascontiguousarray(x).tobytes())
        self._study = digest.hexdigest()
        path = self.folder / MANIFEST
        if not path.exists():
            return None
        try:
            found = json.loads(path.read_bytes())
            sound = found == _manifest(str(found["study"]), int(found["chunk"]))
        except (OSError, ValueError, KeyError, TypeError, RecursionError):
            sound = False
        if not sound:
            raise InputError(
                _(
                    "'{path}' is damaged and no longer says which study its cases belong to: delete the "
                    "folder '{folder}' and start again."
                ).format(path=path, folder=self.folder),
                path=str(path),
            )
        if found["study"] != self._study:
            raise InputError(
                _("'{folder}' holds the cases of another study: choose another folder, or delete it.").format(
                    folder=self.folder
                ),
                path=str(self.folder),
            )
        return int(found["chunk"])

    def begin(self, chunk: int) -> None:
        """Say whose cases will be here, in chunks of which size."""
        write_atomic(self.folder / MANIFEST, json.dumps(_manifest(self._study, chunk)))

    def path(self, start: int) -> Path:
        """The file of the chunk that begins with a case."""
        return self.folder / f"cases-{start:09d}.npz"

    def load(self, start: int) -> Part | None:
        """A finished chunk, None when there is none; one that is damaged or of another study is a
        ``ValueError``.
        """
        path = self.path(start)
        if not path.exists():
            return None
        try:
            content = path.read_bytes()
        except OSError as problem:
            raise ValueError(reason_of(problem)) from None
        if content[-SEAL:] != self._seal(start, content[:-SEAL]):
            raise ValueError(path.name)
        with np.load(io.BytesIO(content), allow_pickle=False) as kept:
            return Part(
                kept["y"],
                kept["codes"],
                {int(k): v for k, v in json.loads(str(kept["texts"])).items()},
                kept["rungs"],
            )

    def save(self, start: int, part: Part) -> None:
        """Keep a finished chunk."""
        buffer = io.BytesIO()
        np.savez(buffer, y=part.y, codes=part.codes, texts=json.dumps(part.texts), rungs=part.rungs)
        write_atomic(self.path(start), buffer.getvalue() + self._seal(start, buffer.getvalue()))

    def _seal(self, start: int, content: bytes) -> bytes:
        return hashlib.sha256(f"{self._study} {start} ".encode() + content).digest()


def _manifest(study: str, chunk: int) -> dict[str, Any]:
    return {"study": study, "chunk": chunk, "check": hashlib.sha256(f"{study} {chunk}".encode()).hexdigest()}


def forget(folder: Path) -> None:
    """Delete kept chunks once the result is written elsewhere."""
    shutil.rmtree(folder, ignore_errors=True)
