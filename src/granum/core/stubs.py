"""What is written down of what is found at run time: type stubs of the domains, the index of all cards,
conversions of units.
``python -m granum.core.stubs`` writes them, a test compares them.
"""

from __future__ import annotations

import csv
import io
import re
import sys
from collections.abc import Iterator
from dataclasses import asdict, fields
from importlib import import_module
from pathlib import Path

from pint.errors import DimensionalityError

from granum.core.errors import UnitError
from granum.core.glossary import glossary
from granum.core.i18n import LANGUAGES, language
from granum.core.index import Entry
from granum.core.kinds import KINDS
from granum.core.registry import DOMAINS, everything
from granum.core.unit_names import in_base_units, same_by_pint
from granum.core.unit_table import BASE
from granum.core.units import FIELD, affine_by_pint, angles_by_pint, pretty_unit

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
    for thing in everything().values():
        entry = thing.card.entry
        with language("en"):
            written = {"english_title": entry.title}
        with language("fr"):
            written |= {"french_title": entry.title, "french_summary": entry.summary}
        table.writerow(asdict(entry) | written)
    return text.getvalue()


def path_of_index() -> Path:
    """Where the index stands."""
    return ROOT / "core" / "index.csv"


def ways_to_write(unit: str) -> Iterator[str]:
    """A unit as Pint, people and printers write it."""
    short = unit.replace("hour", "h").replace("tonne", "t").replace("inch", "in").replace("delta_deg", "deg")
    for text in (unit, short):
        yield from (text, text.replace("^", ""), text.replace("*", " "))
        yield text.replace("um", "µm").replace("degC", "°C")
        for code in LANGUAGES:
            with language(code):
                yield pretty_unit(text)


PER_AMOUNT = {
    "J/(mol*K)": ("J/(mol*K)", "J/(kmol*K)", "kJ/(kmol*K)", "cal/(mol*K)", "molar_gas_constant"),
    "J/mol": ("J/kmol", "kJ/kmol"),
    "mol/m^3": ("kmol/m^3",),
}
"""Units in which tables of materials give properties, beyond those of the kinds."""


def unit_table() -> str:
    """The text of ``granum/core/unit_table.csv``: every unit of a kind, a glossary entry, the customary
    system or a head of a table, by Pint.
    """
    usual = sorted({term.unit for term in glossary().values() if term.unit})
    text = io.StringIO()
    table = csv.writer(text, lineterminator="\n")
    for si in dict.fromkeys((*(kind.unit for kind in KINDS.values()), *PER_AMOUNT)):
        own = [unit for kind in KINDS.values() if kind.unit == si for unit in kind.units]
        written = (
            way
            for unit in (*own, *FIELD.get(si, ()), *PER_AMOUNT.get(si, ()), *usual)
            for way in ways_to_write(unit)
        )
        for unit in dict.fromkeys(written):
            try:
                known = bool(unit) and same_by_pint(unit, si) and affine_by_pint(unit, si)
            except (UnitError, DimensionalityError):  # a difference of temperatures has rules of its own
                continue
            if known:
                factor, offset = known
                table.writerow((unit, si, repr(factor), repr(offset), int(angles_by_pint(unit))))
    for unit in sorted(units_of_tables() - {BASE}):
        table.writerow((unit, BASE, *map(repr, in_base_units(unit)), int(angles_by_pint(unit))))
    return text.getvalue()


def units_of_tables() -> set[str]:
    """The units in the heads of the tables that come with the package."""
    heads = (file.read_text(encoding="utf-8").partition("\n")[0] for file in ROOT.glob("*/data/*.csv"))
    return {unit for head in heads for unit in re.findall(r"\[([^\]]+)\]", head)}


def path_of_unit_table() -> Path:
    """Where the table of units stands."""
    return ROOT / "core" / "unit_table.csv"


if __name__ == "__main__":
    path_of_unit_table().write_text(unit_table(), encoding="utf-8")
    path_of_index().write_text(index(), encoding="utf-8")
    for one in PACKAGES:
        path_of(one).write_text(stub_of(one), encoding="utf-8")
        sys.stdout.write(f"{one}\n")
