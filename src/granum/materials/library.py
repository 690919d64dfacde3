"""The library: ``fluid``, ``solid``, ``solute``, ``salt`` by name, ``names`` to list them, ``load`` to add
one's own from a TOML file.

A materials file has tables ``[fluid.NAME]``, ``[solid.NAME]`` and ``[solute.NAME]``; the files of
``granum/materials/data`` are examples, ``granum.materials.schema`` is the full description. The smallest
useful solid::

    [solid.zeolite]
    density = { value = 2150.0, source = "measured by helium pycnometry, 2024" }
    heat_capacity = "0.9 kJ/(kg K)"
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import contextmanager, suppress
from contextvars import ContextVar
from dataclasses import dataclass, field
from functools import cache, cached_property
from hashlib import sha256
from importlib.resources import files
from pathlib import Path
from typing import Any

import tomli
import tomlkit

from granum.core.documents import read_toml
from granum.core.errors import InputError, reason_of, unknown_name
from granum.core.i18n import _, current_language
from granum.materials.building import fluid_of, salt_of, solid_of, solute_of
from granum.materials.fluids import Fluid
from granum.materials.salts import Salt
from granum.materials.schema import read_materials
from granum.materials.solids import Solid
from granum.materials.solutes import SoluteSystem

Entries = dict[str, dict[str, Any]]
_SORTS = {"fluid": "Fluid", "solid": "Solid", "solute": "Solute", "salt": "Salt"}
OWN = ("solid", "fluid", "solute")  # what a case may state
_SPELLINGS = {
    "sulph": "sulf",
    "Sulph": "Sulf",
    "aluminium": "aluminum",
    "caesium": "cesium",
    "·": ".",
    "•": ".",
}


@dataclass(frozen=True)
class _Own:
    """The text of tables of materials, and where they stand, for messages."""

    text: str
    place: str = field(compare=False)

    @classmethod
    def of(cls, given: str | Path | Mapping[str, Any]) -> _Own:
        """A file, or the tables of a case."""
        if isinstance(given, Mapping):
            return cls(tomlkit.dumps(given), _("case"))
        place = _("Materials file {file}").format(file=given)
        try:
            return cls(Path(given).read_text(encoding="utf-8"), place)
        except OSError as problem:
            raise InputError(
                _("{place} cannot be read: {reason}.").format(place=place, reason=reason_of(problem))
            ) from problem
        except UnicodeDecodeError as problem:
            raise InputError(
                _("{place} is not valid TOML: {reason}.").format(place=place, reason=problem)
            ) from problem

    def content(self) -> dict[str, Any]:
        try:
            return read_toml(self.text)
        except InputError as problem:
            raise InputError(
                _("{place} is not valid TOML: {reason}.").format(place=self.place, reason=problem)
            ) from problem


def stated(sort: str, name: str) -> str:
    """How a person states a material that the library lacks."""
    if sort not in OWN:
        return ""
    if sort == "solid":
        return _(
            "One of your own is described in the case by `[solid.{name}]` with "
            '`density = "1400 kg/m3"` and `heat_capacity = "1 kJ/(kg K)"`.'
        ).format(name=name if re.fullmatch(r"[A-Za-z0-9_-]+", name) else f'"{name}"')
    return _('State the properties of one that the library lacks in a table [{sort}."{name}"].').format(
        sort=sort, name=name
    )


@dataclass(frozen=True, repr=False)
class Library:
    """The materials that come with Granum and those of some files of one's own: a value, equal to another
    with the same texts.

    What a case names in its files is in the library of its mixture alone, so that other cases may use the
    same names for other materials.
    """

    own: tuple[_Own, ...] = ()

    def __repr__(self) -> str:
        return f"Library({sha256(repr([o.text for o in self.own]).encode()).hexdigest() if self.own else ''})"

    def with_own(self, further: Iterable[str | Path | Mapping[str, Any]]) -> Library:
        """The library with the materials of further files or tables, all of which have been made once."""
        given = dict.fromkeys((*self.own, *map(_Own.of, further)))
        library = Library(tuple(given)) if len(given) > len(self.own) else self
        for sort in _SORTS:
            before = self._entries[sort]
            for word, item in library._entries[sort].items():
                if item is not before.get(word):
                    getattr(library, sort)(word)
        return library

    @cached_property
    def _entries(self) -> Entries:
        if not self.own:
            return _shipped()
        known = {sort: dict(found) for sort, found in _shipped().items()}
        for own in self.own:
            _merge(known, own.content(), own.place, own=True)
        return known

    @cached_property
    def _made(self) -> dict[tuple[str, str], Any]:
        return {}

    def _find(self, sort: str, name: str, build: Callable[[str, Any], Any]) -> Any:
        key, entry = self.entry(sort, name)
        if (sort, key) not in self._made:
            shipped = self is not SHIPPED and _shipped()[sort].get(key, (key, None))[1] is entry
            self._made[sort, key] = getattr(SHIPPED, sort)(key) if shipped else build(key, entry)
        return self._made[sort, key]

    def entry(self, sort: str, name: str) -> tuple[str, Any]:
        """The name in the library and the entry of what a person calls a material."""
        known = self._entries[sort]
        for word in dict.fromkeys((name, name.strip(), _respelled(name.strip()))):
            found = (
                known.get(word)
                or known.get(word.lower())
                or _by_formula(known, word)
                or (self._by_crystal(known, word) if sort == "solute" else None)
            )
            if found is not None:
                return found
        raise unknown_name(_(_SORTS[sort]), name, known, strict=True, otherwise=stated(sort, name))

    def called(self, name: str, *sorts: str) -> str | None:
        """What the library calls a material, by the first of the ``sorts`` that knows it; None where none
        does.
        """
        for sort in sorts:
            with suppress(InputError):
                return self.entry(sort, name)[0]
        return None

    def _by_crystal(self, known: dict[str, Any], word: str) -> Any:
        """The system that a crystal, such as a hydrate, comes from."""
        solids = self._entries["solid"]
        crystal = solids.get(word) or solids.get(word.lower()) or _by_formula(solids, word)
        return crystal and next(
            (item for item in known.values() if any(b.crystal == crystal[0] for b in item[1].branches)), None
        )

    def names(self, sort: str = "") -> list[str]:
        """Names of the materials of a sort, or of all."""
        if sort and sort not in _SORTS:
            raise unknown_name(_("Sort of material"), sort, _SORTS)
        return sorted(
            {key for s in ([sort] if sort else _SORTS) for key, _entry in self._entries[s].values()}
        )

    def entries(self, sort: str) -> dict[str, Any]:
        """The materials of a sort as their files declare them, by name: nothing is calculated."""
        return dict(self._entries[sort].values())

    def label(self, name: str) -> str:
        """The name of a material in the current language, as far as its file tells."""
        if current_language() == "en":
            return name
        found = (self._entries[sort].get(name) for sort in _SORTS)
        return next((entry.fr for _key, entry in filter(None, found) if getattr(entry, "fr", "")), name)

    def fluid(self, name: str) -> Fluid:
        """A pure fluid by name, chemical formula or French name."""
        return self._find("fluid", name, fluid_of)

    def solid(self, name: str) -> Solid:
        """A solid by name, chemical formula or French name."""
        return self._find("solid", name, solid_of)

    def salt(self, name: str) -> Salt:
        """A sparingly soluble salt by name, chemical formula or French name."""
        return self._find("salt", name, salt_of)

    def solute(self, name: str) -> SoluteSystem:
        """A solute–solvent system by the name of the solute or of one of its crystals, with ``in SOLVENT``
        where the solvent is not water.
        """

        def build(key: str, entry: Any) -> SoluteSystem:
            return solute_of(
                key,
                entry,
                self.fluid(entry.solvent),
                tuple(self.solid(branch.crystal) for branch in entry.branches),
            )

        return self._find("solute", name, build)


@cache
def _shipped() -> Entries:
    found: Entries = {sort: {} for sort in _SORTS}
    for path in sorted((files("granum") / "materials" / "data").iterdir(), key=lambda p: p.name):
        if path.name.endswith(".toml"):
            _merge(found, tomli.loads(path.read_text(encoding="utf-8")), path.name)
    return found


def _merge(into: Entries, content: dict[str, Any], where: str, own: bool = False) -> None:
    """Add a file's checked entries, and their aliases as references to them. One of one's ``own`` may take
    what is only a further name of one that came with Granum.
    """
    parsed = read_materials(content, where)
    for sort in into:
        for name, entry in getattr(parsed, sort).items():
            for word in dict.fromkeys((name, *entry.aliases)):
                known = into[sort].get(word)
                lent = own and known is not None and known[0] != word and known[0] in _shipped()[sort]
                if known is not None and not lent:
                    raise InputError(
                        _("{place}: '{name}' is already the name of a {sort}; choose another.").format(
                            place=where, name=word, sort=sort
                        ),
                        name=word,
                    )
                into[sort][word] = (name, entry)


def _respelled(name: str) -> str:
    """The spelling of the library for a name in British spelling or a formula with a raised dot."""
    for other, ours in _SPELLINGS.items():
        name = name.replace(other, ours)
    return name


def _by_formula(known: dict[str, Any], word: str) -> Any:
    if not word:  # an entry without a formula or a French name is not called by nothing
        return None
    return next(
        (item for item in known.values() if word.lower() == item[1].fr.lower() or word == item[1].formula),
        None,
    )


SHIPPED = Library()
_session = [SHIPPED]
_around: ContextVar[Library | None] = ContextVar("materials", default=None)


def session() -> Library:
    """What is asked for by name alone: the materials that come with Granum and those added with ``load``, and
    within ``including`` those of a case.
    """
    return _around.get() or _session[0]


@contextmanager
def including(library: Library) -> Iterator[None]:
    """A library in place of the session's, for what is asked by name alone in the meantime."""
    token = _around.set(library)
    try:
        yield
    finally:
        _around.reset(token)


def load(path: str | Path) -> list[str]:
    """Add the materials of a TOML file to the library for this session; returns their names. A case file
    names its own files instead.
    """
    _session[0] = _session[0].with_own([path])
    content = _Own.of(path).content()
    return sorted({name for sort in _SORTS for name in content.get(sort, {})})


def names(sort: str = "") -> list[str]:
    """Names of the materials of a sort, ``"fluid"``, ``"solid"``, ``"solute"`` or ``"salt"``; of all sorts by
    default.

    >>> "ethanol" in names("fluid"), "quartz" in names("solid"), "potassium nitrate" in names("solute")
    (True, True, True)
    """
    return session().names(sort)


def fluid(name: str) -> Fluid:
    """A pure fluid by name, chemical formula or French name.

    >>> round(fluid("ethanol").liquid_density("20 degC"), 0)
    790.0
    """
    return session().fluid(name)


def solid(name: str) -> Solid:
    """A solid by name, chemical formula or French name.

    >>> solid("quartz").density("20 degC")
    2650.0
    """
    return session().solid(name)


def solute(name: str) -> SoluteSystem:
    """A solute–solvent system by the name of the solute or of one of its crystals, with ``in SOLVENT`` where
    the solvent is not water.

    >>> round(float(solute("potassium nitrate").solubility("20 degC")), 2)
    0.32
    >>> solute("sodium sulphate decahydrate").name, solute("CuSO4·5H2O").name
    ('sodium sulfate', 'copper sulfate')
    """
    return session().solute(name)


def salt(name: str) -> Salt:
    """A sparingly soluble salt by name, chemical formula or French name.

    >>> salt("BaSO4").solubility_product
    1.08e-10
    """
    return session().salt(name)
