"""A guide carried out as its reader would: a fresh folder, its files written, its commands given.

Its fenced parts: ``toml`` (or any other) with a title is a file, ``diff`` with a title a change to one,
``console`` holds commands after ``$ `` with what they print, ``python`` is code, and ``text`` after it what
that prints. In what is printed, ``...`` stands for anything.
"""

from __future__ import annotations

import contextlib
import io
import re
import shlex
import subprocess
from collections.abc import Iterator
from pathlib import Path
from typing import Any, NamedTuple

from tests.sharing.commands import granum

_BLOCK = re.compile(r'^```(\w*)(?: title="([^"]+)")?\n(.*?)^```$', re.MULTILINE | re.DOTALL)
_TOLD = re.compile(r"(?<![\w.,])\d+[.,]\d+(?![\w.,]*\d)")


class Block(NamedTuple):
    """A fenced part of a page: its language, its title, its text."""

    form: str
    title: str
    text: str


def blocks(page: str) -> list[Block]:
    """The fenced parts of a page, in order."""
    return [Block(*found.groups(default="")) for found in _BLOCK.finditer(page)]


def commands(text: str) -> Iterator[tuple[str, str]]:
    r"""Commands of a console with what each prints.

    >>> list(commands("$ granum list \\\n    drag\ndrag law\n$ echo $?\n0\n"))
    [('granum list drag', 'drag law'), ('echo $?', '0')]
    """
    for part in re.split(r"^\$ ", text.replace("\\\n", " "), flags=re.MULTILINE)[1:]:
        command, _end, printed = part.partition("\n")
        yield " ".join(command.split()), printed.strip()


def agrees(told: str, printed: str) -> bool:
    """Whether a printed text is the one told, spaces and blank lines apart.

    >>> agrees("mass closes to ..., energy to ...", "mass closes to 2e-13, energy\\nto 3e-13")
    True
    >>> agrees("area 2 m²", "area 3 m²")
    False
    """
    parts = [re.escape(" ".join(part.split())) for part in told.split("...")]
    flat = " ".join(printed.split())
    return bool(re.fullmatch(r"\s*.*?\s*".join(parts), flat, flags=re.DOTALL))


def told_but_not_shown(page: str) -> list[str]:
    """Numbers with decimals in the prose of a page that stand in none of its files, commands and prints."""
    shown = "\n".join(block.text for block in blocks(page)).replace(",", ".")
    prose = re.sub(r"`[^`]*`", "", _BLOCK.sub("", page))
    numbers = {found.replace(",", ".") for found in _TOLD.findall(prose)}
    return sorted(n for n in numbers if not re.search(rf"(?<![\d.]){re.escape(n)}(?!\d)", shown))


class Reader:
    """Someone at a terminal in a folder of his own, in one language."""

    def __init__(self, folder: Path, language: str) -> None:
        self.folder, self.language = folder, language
        self.status = 0
        self.names: dict[str, Any] = {}

    def follow(self, page: str) -> list[str]:
        """Do what a page says; what comes out otherwise than told."""
        wrong, printed = [], ""
        for form, title, text in blocks(page):
            if form == "diff":
                self._change(self.folder / title, text)
            elif title:
                (self.folder / title).write_text(text, encoding="utf-8")
            elif form == "console":
                for command, told in commands(text):
                    out = self._give(command)
                    if not agrees(told, out):
                        wrong.append(f"$ {command}\n{out}\n--- the guide says\n{told}")
            elif form == "python":
                printed = self._python(text)
            elif form == "text" and not agrees(text, printed):
                wrong.append(f"{printed}\n--- the guide says\n{text}")
        return wrong

    def _give(self, command: str) -> str:
        words = shlex.split(command)
        if command == "echo $?":
            return str(self.status)
        if words[0] == "granum":
            self.status, out, complaint = granum("--lang", self.language, *words[1:])
            return out + complaint
        done = subprocess.run(
            command, shell=True, cwd=self.folder, capture_output=True, text=True, check=False
        )
        self.status = done.returncode
        return done.stdout + done.stderr

    def _python(self, code: str) -> str:
        with contextlib.redirect_stdout(io.StringIO()) as printed:
            exec(compile(code, "guide", "exec"), self.names)
        return printed.getvalue()

    @staticmethod
    def _change(place: Path, text: str) -> None:
        lines = [line for line in text.splitlines() if line.strip()]
        old = "".join(f"{line[1:]}\n" for line in lines if line[0] != "+")
        new = "".join(f"{line[1:]}\n" for line in lines if line[0] != "-")
        before = place.read_text(encoding="utf-8")
        if not old:
            place.write_text(f"{before}\n{new}", encoding="utf-8")
            return
        assert before.count(old) == 1, f"{place.name} holds not once:\n{old}"
        place.write_text(before.replace(old, new), encoding="utf-8")
