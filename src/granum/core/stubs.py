"""What is written down of what is found at run time: type stubs of the domains and the index of all cards.
``python -m granum.core.stubs`` writes them, a test compares them.
"""

from __future__ import annotations

import csv
import io
import sys
from dataclasses import asdict, fields
from importlib import import_module
from pathlib import Path

from granum.core.index import Entry
from granum.core.registry import DOMAINS, everything

PACKAGES = ("core", *DOMAINS)
ROOT = Path(__file__).parents[1]


def stub_of(domain: str) -> str:
    """The text of ``granum/<domain>/__init__.pyi``: every public name from the module that declares it."""
    package = import_module(f"granum.{domain}")
    by_module: dict[str, list[str]] = {}
    for name in dir(package):
        module = getattr(getattr(package, name), "__module__", None)
        if module:
            by_module.setdefault(module, []).append(name)
    lines = [f'"""{(package.__doc__ or "").strip()}"""', ""]
    for module in sorted(by_module):
        lines.append(f"from {module} import (")
        lines += [f"    {name} as {name}," for name in sorted(by_module[module])]
        lines.append(")")
    return "\n".join(lines) + "\n"


def path_of(domain: str) -> Path:
    """Where the stub of a domain stands."""
    return ROOT / domain / "__init__.pyi"


def index() -> str:
    """The text of ``granum/core/index.csv``: a line for every card."""
    text = io.StringIO()
    table = csv.DictWriter(text, [f.name for f in fields(Entry)], lineterminator="\n")
    table.writeheader()
    table.writerows(asdict(thing.card.entry) for thing in everything().values())
    return text.getvalue()


def path_of_index() -> Path:
    """Where the index stands."""
    return ROOT / "core" / "index.csv"


if __name__ == "__main__":
    path_of_index().write_text(index(), encoding="utf-8")
    for one in PACKAGES:
        path_of(one).write_text(stub_of(one), encoding="utf-8")
        sys.stdout.write(f"{one}\n")
