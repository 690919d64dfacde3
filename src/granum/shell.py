"""What the commands share: options that stand anywhere, pairs of name and value, one message and an exit
status for what fails.
"""

from __future__ import annotations

import functools
import json
import os
import sys
import threading
from collections.abc import Callable
from copy import copy
from typing import Any, NoReturn

import typer
from typer.core import TyperGroup

from granum import __version__
from granum.core import kept
from granum.core.errors import GranumError, InputError
from granum.core.i18n import _, set_language


def choose_language(lang: str) -> None:
    """The language of messages: ``en`` or ``fr``."""
    if lang:
        if lang not in ("en", "fr"):
            raise typer.BadParameter("choose en or fr", param_hint="--lang")
        set_language(lang)


def choose_units(units: str) -> None:
    """The units of what is shown: ``si`` or ``field``."""
    if units:
        if units not in ("si", "field"):
            raise typer.BadParameter("choose si or field", param_hint="--units")
        os.environ["GRANUM_UNITS"] = units


def tell_version(wanted: bool) -> None:
    """Print the version and end."""
    if wanted:
        print(f"granum {__version__}")
        raise typer.Exit


SHARED: dict[str, tuple[Callable[[str], None], str]] = {
    "--lang": (choose_language, "Language of messages: en or fr."),
    "--units": (choose_units, "Units of what is shown: si or field (customary of the United States)."),
}
"""Options of the program that stand before or after the command, with what they do and their help."""


def _heeded(act: Callable[[str], None], _context: Any, _option: Any, value: str) -> str:
    act(value)
    return value


class Commands(TyperGroup):
    """The commands, each of which takes the options of the program too: ``granum run case.toml --lang
    fr``.
    """

    def get_command(self, ctx: Any, cmd_name: str) -> Any:
        command = super().get_command(ctx, cmd_name)
        words = {word for option in command.params for word in option.opts} if command else set(SHARED)
        for option in self.params:
            heed = SHARED.get(option.opts[0])
            if command and heed and option.opts[0] not in words:
                own = copy(option)
                own.expose_value, own.envvar, own.callback = False, None, functools.partial(_heeded, heed[0])
                command.params.append(own)
        return command


class Unexpected(GranumError):
    """A fault of the program itself, not of its input."""

    exit_code = 1


def _fail(problem: GranumError, as_json: bool) -> NoReturn:
    if as_json:
        print(json.dumps({"error": problem.as_json()}, ensure_ascii=False))
    print(problem.message, file=sys.stderr)
    raise SystemExit(problem.exit_code)


def one_message(command: Callable[..., None]) -> Callable[..., None]:
    """Turns errors raised on purpose into one message and an exit status."""

    @functools.wraps(command)
    def run(*args: Any, **kwargs: Any) -> None:
        try:
            command(*args, **kwargs)
        except GranumError as problem:
            _fail(problem, bool(kwargs.get("as_json")))
        except KeyboardInterrupt:
            raise SystemExit(130) from None
        except BrokenPipeError:  # nobody reads on, as behind ``| head``
            os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
            raise SystemExit(141) from None
        except Exception as problem:
            if os.environ.get("GRANUM_TRACEBACK"):
                raise
            place = f"{type(problem).__name__}: {str(problem).splitlines()[0] if str(problem) else ''}"
            text = _(
                "Granum failed where it should not have ({place}). Please report it with the output of "
                "GRANUM_TRACEBACK=1."
            )
            _fail(Unexpected(text.format(place=place)), bool(kwargs.get("as_json")))

    return run


def pairs(words: list[str] | None) -> dict[str, str]:
    """``name=value`` words as a dictionary of texts."""
    values: dict[str, str] = {}
    for word in words or []:
        name, equals, value = word.partition("=")
        if not equals or not name:
            raise InputError(
                _("'{word}' is not of the form name=value, such as particle_diameter=85um.").format(word=word)
            )
        if name in values:
            raise InputError(_("'{name}' was given twice.").format(name=name), name=name)
        values[name] = value
    return values


def emit(data: dict[str, Any]) -> None:
    """Print JSON."""
    print(json.dumps(data, ensure_ascii=False, allow_nan=False, indent=1))


def keep_compiled_code() -> None:
    """The second run of a line traces nothing and skips the compiler: what JAX traces and compiles stays in
    the user's cache folder, oldest out beyond 128 and 512 MB.
    """
    from platformdirs import user_cache_path

    kept.keep_in(user_cache_path("granum") / "traced")
    if "JAX_COMPILATION_CACHE_DIR" in os.environ:
        return
    folder = user_cache_path("granum") / "compiled"
    for entry in folder.glob("*-cache"):
        if not entry.with_name(
            entry.name.removesuffix("-cache") + "-atime"
        ).exists():  # a run was killed while it wrote this one
            entry.unlink(missing_ok=True)
    os.environ["JAX_COMPILATION_CACHE_DIR"] = str(folder)
    os.environ.setdefault("JAX_COMPILATION_CACHE_MAX_SIZE", "512_000_000")
    os.environ.setdefault("JAX_PERSISTENT_CACHE_MIN_COMPILE_TIME_SECS", "0.05")


def to_the_end(program: Callable[[], Any]) -> NoReturn:
    """Run a program, keep what its tracing made, and end: at once where nothing else is left running, since
    to free what tracing made object by object takes as long as a fifth of a run.
    """
    status: Any = 0
    try:
        program()
    except SystemExit as ended:
        status = 0 if ended.code is None else ended.code
    kept.store()
    if threading.active_count() > 1 or "granum.app" in sys.modules or not isinstance(status, int):
        raise SystemExit(status)
    try:
        sys.stdout.flush()
        sys.stderr.flush()
    except OSError:  # nobody reads on: the interpreter says so in its own way
        raise SystemExit(status) from None
    os._exit(status)
