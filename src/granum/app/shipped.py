"""What comes with the package besides the program: example lines and pages of the documentation."""

from __future__ import annotations

from functools import cache
from hashlib import sha256
from importlib.resources import files
from pathlib import Path

import tomli

import granum
from granum.core.i18n import _

_GUIDES = {  # the guides by what they are called in French; chapters have one name in both languages
    "adding-a-formula": "ajouter-une-formule",
    "adding-equipment": "ajouter-un-equipement",
    "first-hour": "premiere-heure",
    "fitting-honestly": "ajuster-honnetement",
    "in-a-class": "en-classe",
    "in-a-plant": "dans-une-usine",
    "in-a-spreadsheet": "dans-un-tableur",
    "in-the-notebook": "dans-un-carnet",
    "lab-to-plant": "du-laboratoire-a-l-usine",
    "laws-of-your-own": "lois-personnelles",
    "line-with-recycle": "ligne-a-recyclage",
    "reading-the-audit": "lire-l-audit",
    "studies": "etudes",
    "uncertainty-to-decision": "de-l-incertitude-a-la-decision",
}


def _folder(name: str) -> Path:
    root = Path(str(files("granum") / name))
    # installed, or in a source tree
    return root if root.is_dir() else Path(granum.__file__).parents[2] / name


def examples_folder() -> Path:
    """Where the examples stand."""
    return _folder("examples")


@cache
def examples() -> dict[str, Path]:
    """Case files of the examples that hold a line, by their place in the folder."""
    root = examples_folder()
    found = sorted(root.rglob("*.toml")) if root.is_dir() else []
    return {str(p.relative_to(root)): p for p in found if "[units." in p.read_text(encoding="utf-8")}


@cache
def _told(name: str) -> tuple[str, str]:
    raw = tomli.loads(examples()[name].read_text(encoding="utf-8"))
    return str(raw.get("title", "")), str(raw.get("description", ""))


def domain_of_line(name: str) -> str:
    """The domain of all machines of an example, mixers and splitters aside; empty where there are several."""
    units = tomli.loads(examples()[name].read_text(encoding="utf-8"))["units"].values()
    found = {str(unit.get("model", "")).partition(".")[0] for unit in units} - {"streams"}
    return found.pop() if len(found) == 1 else ""


def title_of(name: str) -> str:
    """The title of an example in the current language."""
    return _(_told(name)[0])


def description_of(name: str) -> str:
    """The description of an example in the current language."""
    return _(_told(name)[1])


@cache
def chapter_calculations() -> dict[str, Path]:
    """The calculations of the handbook by the domain of their chapter."""
    return {place.stem: place for place in sorted((_folder("docs") / "handbook").glob("*.py"))}


@cache
def written() -> str:
    """All that calculations of the handbook say and read as one word: another where a letter changes."""
    told = sha256()
    for place in (_folder("docs"), examples_folder()):
        for path in sorted(p for p in place.rglob("*") if p.suffix in (".py", ".csv", ".toml")):
            told.update(path.read_bytes())
    return told.hexdigest()


def chapter_code(domain: str, name: str) -> str:
    """The part of the calculations of a chapter between ``# ---- NAME`` and the next such line."""
    parts = chapter_calculations()[domain].read_text(encoding="utf-8").split("# ---- ")
    found = next(part for part in parts[1:] if part.startswith(f"{name}\n"))
    return found.split("\n", 1)[1].strip()


@cache
def pages() -> dict[str, Path]:
    """Guides, theory, handbook and errata by name, as ``guides/first-hour``."""
    root = _folder("docs")
    found = [
        *root.glob("guides/*.md"),
        *root.glob("theory/*.md"),
        *root.glob("handbook/*.md"),
        *root.glob("fr/*.md"),
        *root.glob("fr/manuel/*.md"),
        *root.glob("errata.md"),
    ]
    names = {place.relative_to(root).with_suffix("").as_posix(): place for place in sorted(found)}
    return {name: place for name, place in names.items() if not name.endswith("index")}


@cache
def translations() -> dict[str, str]:
    """Pages that stand in both languages, each with its name in the other."""
    guides = {f"guides/{own}": f"fr/{other}" for own, other in _GUIDES.items()} | {"errata": "fr/errata"}
    chapters = {name: f"fr/manuel/{name[9:]}" for name in pages() if name.startswith("handbook/")}
    both = {own: other for own, other in (guides | chapters).items() if {own, other} <= set(pages())}
    return both | {other: own for own, other in both.items()}
