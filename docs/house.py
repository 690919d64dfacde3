"""The tree of the package as docs/architecture.md shows it: ``python docs/house.py`` writes it there, a test
compares it.
"""

from __future__ import annotations

import ast
import textwrap
import tomllib
from collections.abc import Iterator
from pathlib import Path

ROOT = Path(__file__).parent.parent
PAGE = ROOT / "docs" / "architecture.md"
OPENING, CLOSING = "<!-- tree: python docs/house.py -->\n```\n", "```\n<!-- end of tree -->\n"
WIDE, INDENT = 140, 20


def tree() -> str:
    """Packages from the bottom of the house to its top, with what their docstrings say, their rooms and the
    modules beside these.
    """
    settings = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
    layers = settings["tool"]["importlinter"]["contracts"][0]["layers"]
    home = ROOT / "src" / "granum"
    lines = []
    for layer in reversed(layers):
        for name in layer.split(" | "):
            lines += list(
                _package(home / name)
                if (home / name).is_dir()
                else [_row(f"{name}.py", _first(home / f"{name}.py"))]
            )
    return "\n".join(lines) + "\n"


def _package(folder: Path) -> Iterator[str]:
    yield _row(f"{folder.name}/", _first(folder / "__init__.py"))
    rooms = {
        p.name: _first(p / "__init__.py") for p in sorted(folder.iterdir()) if (p / "__init__.py").exists()
    }
    yield from (_row(f"  {name}/", text) for name, text in rooms.items() if text)
    usual = [f"{name}/" for name, text in rooms.items() if not text]
    if usual:
        yield "  " + " ".join(usual)
    beside = [p.stem for p in sorted(folder.glob("*.py")) if not p.stem.startswith("__")]
    if beside:
        yield _row("", " ".join(beside))


def _first(path: Path) -> str:
    """The first sentence of a docstring, on one line."""
    doc = " ".join(
        (ast.get_docstring(ast.parse(path.read_text(encoding="utf-8"))) or "").split("\n\n")[0].split()
    )
    return doc.removesuffix(".")


def _row(name: str, text: str) -> str:
    return textwrap.fill(
        text,
        WIDE,
        initial_indent=name.ljust(INDENT - 1) + " ",
        subsequent_indent=" " * INDENT,
        break_long_words=False,
    ).rstrip()


def written(page: str) -> str:
    """The page with the tree as it is now."""
    head, rest = page.split(OPENING)
    return head + OPENING + tree() + CLOSING + rest.split(CLOSING)[1]


if __name__ == "__main__":
    PAGE.write_text(written(PAGE.read_text(encoding="utf-8")), encoding="utf-8")
