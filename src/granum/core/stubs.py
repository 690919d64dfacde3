"""Type stubs of the domains, whose names are found at run time: ``python -m granum.core.stubs`` writes them,
a test compares them.
"""

from __future__ import annotations

import sys
from importlib import import_module
from pathlib import Path

from granum.core.registry import DOMAINS

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


if __name__ == "__main__":
    for one in PACKAGES:
        path_of(one).write_text(stub_of(one), encoding="utf-8")
        sys.stdout.write(f"{one}\n")
