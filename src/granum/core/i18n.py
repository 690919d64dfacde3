"""English and French. The English text is the key; French catalogs are the ``.po`` files of
``granum/locale/fr``.

>>> with language("fr"):
...     _("Did you mean '{close}'?")
'Vouliez-vous dire « {close} » ?'
"""

from __future__ import annotations

import os
import re
from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from functools import cache
from importlib.resources import files

LANGUAGES = ("en", "fr")


def _from_environment() -> str:
    wanted = os.environ.get("GRANUM_LANG") or os.environ.get("LANG", "")
    return "fr" if wanted.lower().startswith("fr") else "en"


_current: ContextVar[str | None] = ContextVar("granum_language", default=None)


def current_language() -> str:
    """The language of messages: ``en`` or ``fr`` (from ``set_language``, else GRANUM_LANG, else LANG)."""
    return _current.get() or _from_environment()


def set_language(code: str) -> None:
    """Choose the language of messages and labels for this context."""
    if code not in LANGUAGES:
        raise ValueError(f"language '{code}' is not available; choose one of {', '.join(LANGUAGES)}")
    _current.set(code)


@contextmanager
def language(code: str) -> Iterator[None]:
    """Use a language inside a ``with`` block."""
    token = _current.set(None)
    try:
        set_language(code)
        yield
    finally:
        _current.reset(token)


@cache
def catalog(code: str) -> dict[str, str]:
    """All translated messages of a language, English text → translation, with typographic apostrophes."""
    from babel.messages.pofile import read_po

    messages: dict[str, str] = {}
    for path in sorted((files("granum") / "locale" / code).iterdir(), key=lambda p: p.name):
        if path.name.endswith(".po"):
            with path.open("rb") as stream:
                for message in read_po(stream, locale=code):
                    if message.id and message.string and not message.fuzzy:
                        messages[str(message.id)] = typographic(str(message.string))
    return messages


def typographic(text: str) -> str:
    """A text with the apostrophe of print where a straight one stands between letters.

    >>> typographic("l'eau de '{name}'")
    "l’eau de '{name}'"
    """
    return re.sub(r"(?<=\w)'(?=[\w«])", "’", text)


def _(text: str) -> str:
    """The text in the current language; English when no translation exists (a test forbids that)."""
    code = current_language()
    return text if code == "en" else catalog(code).get(text, text)


def quoted(name: str) -> str:
    """A name within a sentence, in quotes of the current language."""
    return _("'{name}'").format(name=name)
