"""TOML as users send it: read in bounded time and depth, or refused in one sentence."""

from __future__ import annotations

import re
import tomllib
from typing import Any

from granum.core.errors import InputError
from granum.core.i18n import _

DEEPEST = 50  # tables in tables; a case has five
_LONG_KEY = re.compile(rf"(?<![\w.\"'-])(?:[\w\"'-]+[ \t]*\.[ \t]*){{{DEEPEST}}}")


def read_toml(text: str) -> dict[str, Any]:
    """The tables of a TOML text.

    >>> read_toml("a.b = 1")
    {'a': {'b': 1}}
    """
    if _LONG_KEY.search(text):  # the parser takes the square of their length
        raise InputError(_("tables stand in tables deeper than {count}").format(count=DEEPEST))
    try:
        return tomllib.loads(text)
    except tomllib.TOMLDecodeError as problem:
        raise InputError(str(problem)) from None
    except RecursionError:
        raise InputError(_("tables stand in tables deeper than {count}").format(count=DEEPEST)) from None
    except ValueError:  # Python reads no whole number of more than 4300 digits
        raise InputError(_("a number has more digits than can be read")) from None
