"""Files that are never half written."""

from __future__ import annotations

import errno
import os
import tempfile
from pathlib import Path

from granum.core.errors import InputError, reason_of
from granum.core.i18n import _


def write_atomic(path: str | Path, content: str | bytes) -> None:
    """Write a file so that, whatever happens, either the old or the complete new content is there."""
    target = Path(path)
    data = content.encode("utf-8") if isinstance(content, str) else content
    try:
        handle, name = tempfile.mkstemp(dir=target.parent or ".", prefix=f".{target.name}.")
    except OSError as problem:
        raise InputError(
            _("'{path}' cannot be written: {reason}.").format(path=path, reason=reason_of(problem)),
            path=str(path),
        ) from None
    try:
        with os.fdopen(handle, "wb") as stream:
            stream.write(data)
            stream.flush()
            os.fsync(stream.fileno())
        os.chmod(name, 0o644)
        os.replace(name, target)
    except OSError as problem:
        Path(name).unlink(missing_ok=True)
        raise InputError(
            _("'{path}' cannot be written: {reason}.").format(path=path, reason=reason_of(problem)),
            path=str(path),
        ) from None


def check_writable(path: str | Path) -> None:
    """Complain about a file that cannot be written before the work whose result it is to hold."""
    target = Path(path)
    try:
        if target.is_dir():
            raise IsADirectoryError(errno.EISDIR, os.strerror(errno.EISDIR))
        handle, name = tempfile.mkstemp(dir=target.parent, prefix=f".{target.name}.")
    except OSError as problem:
        raise InputError(
            _("'{path}' cannot be written: {reason}.").format(path=path, reason=reason_of(problem)),
            path=str(path),
        ) from None
    os.close(handle)
    Path(name).unlink()
