"""The registry: everything declared, by key. Declaring registers; looking up imports what is needed; nothing
is listed by hand.
"""

from __future__ import annotations

import importlib
import inspect
import pkgutil
import sys
from collections.abc import Callable, Iterable
from functools import cache
from importlib.util import find_spec
from typing import Any

from granum.core.cards import domain_of
from granum.core.errors import InputError, nearest, unknown_name
from granum.core.i18n import _
from granum.core.index import Entry, entries
from granum.core.search import search

DOMAINS = (
    "materials",
    "particles",
    "porous",
    "humid_gas",
    "streams",
    "comminution",
    "settling",
    "cyclones",
    "fluidization",
    "conveying",
    "filtration",
    "centrifuges",
    "crystallization",
    "drying",
    "dust",
    "evaporation",
    "studies",
    "costs",
)
MOST_FOUND, MOST_TOLD = 40, 3
_declared: dict[str, Any] = {}
_keys: dict[int, str] = {}
_families: dict[str, dict[str, Any]] = {}
_loaded: set[str] = set()
_offered: dict[str, tuple[str, ...]] = {}


def register(thing: Any, key: str, family: str) -> None:
    """Called by the declaring decorators with key and family; the card itself is built when first asked
    for.
    """
    known = _declared.get(key)
    if known is not None and known.__module__ != thing.__module__:
        raise ValueError(f"'{key}' is declared in {known.__module__} and again in {thing.__module__}")
    _declared[key] = thing
    if family:
        _families.setdefault(family, {})[key] = thing


def load(domain: str) -> None:
    """Import every module of a domain, so that all its declarations are known."""
    if domain in _loaded:
        return
    package = importlib.import_module(f"granum.{domain}")
    for module in pkgutil.walk_packages(package.__path__, package.__name__ + "."):
        importlib.import_module(module.name)
    _loaded.add(domain)


def everything(domains: Iterable[str] = DOMAINS) -> dict[str, Any]:
    """All declared things of some domains (by default all) by key."""
    for domain in domains:
        load(domain)
    return {key: thing for key, thing in sorted(_declared.items()) if key.split(".")[0] in domains}


def known(key: str) -> Any:
    """The declared thing of a key, None where there is none.

    Only the module that declares it is imported.
    """
    entry = entries().get(key)
    if entry is not None and key not in _declared:
        importlib.import_module(entry.module)
    if key not in _declared and key.partition(".")[0] in DOMAINS:  # not in the index yet
        load(key.partition(".")[0])
    return _declared.get(key)


def key_of(thing: Any) -> str | None:
    """The key under which something is declared."""
    if len(_keys) < len(_declared):
        _keys.update((id(declared), key) for key, declared in _declared.items())
    key = _keys.get(id(thing))
    return key if key is not None and _declared[key] is thing else None


def find(key: str) -> Any:
    """The declared thing of a key, or an error that suggests the nearest one.

    >>> find("particles.reynolds_number").card.domain
    'particles'
    """
    found = known(key)
    if found is not None:
        return found
    close = _meant(key)
    if not close:
        word = key.rpartition(".")[2] or key
        raise InputError(
            _("There is no card '{key}'. 'granum list {word}' shows those that speak of it.").format(
                key=key, word=word
            ),
            name=key,
        )
    raise unknown_name(_("Card"), key, {*entries(), *_declared}, meant=close[0], further=close[1:])


def _meant(key: str) -> list[str]:
    """Keys that an unknown one may mean, the likeliest first: one that differs by a slip, or else what the
    search finds for its words, those of its domain before others.
    """
    domain, _dot, own = key.rpartition(".")
    domain = nearest(domain, DOMAINS, strict=True) or "" if domain else ""
    names = {*entries(), *_declared}
    owns = {k.partition(".")[2]: k for k in sorted(names) if not domain or k.startswith(f"{domain}.")}
    slip = nearest(own, owns, strict=True)
    if slip:
        return [owns[slip]]
    words = set(own.split("_"))
    found = [entry.key for entry in search(own.replace("_", " "), MOST_FOUND)]
    near = [key for name, key in owns.items() if domain and words & set(name.split("_"))]
    inside = dict.fromkeys([*(k for k in found if domain and k.startswith(f"{domain}.")), *near])
    found = list(inside) or found
    likely = found or [k for k in [nearest(key, names)] if k]
    return likely[:MOST_TOLD]


def family(name: str) -> dict[str, Any]:
    """All laws of a family by key: what may be passed where ``Law(name)`` is expected."""
    for entry in entries().values():
        if entry.family == name:
            known(entry.key)
    return dict(sorted(_families.get(name, {}).items()))


def _short_names(family_name: str, keys: Iterable[str]) -> dict[str, str]:
    """Keys of a family by key, by name and by the author's part of the name."""
    short: dict[str, str] = {}
    for key in keys:
        own = key.split(".", 1)[1]
        short |= {key: key, own: key, own.removeprefix(family_name).strip("_"): key}
    return short


def law(family_name: str, name: str, where: str = "") -> Any:
    """The declared law of a family, class or formula, by key, by name or by the author's part of the name."""
    listed = [entry.key for entry in entries().values() if entry.family == family_name]
    key = _short_names(family_name, [*listed, *_families.get(family_name, {})]).get(name)
    if key is None:
        everything()  # declared, but not in the index yet
        key = _short_names(family_name, _families.get(family_name, {})).get(name)
    if key is not None:
        return known(key)
    names = {
        own.removeprefix(family_name).strip("_") or own
        for own in (k.split(".", 1)[1] for k in _families.get(family_name, {}))
    }
    raise unknown_name(_("Law"), name, names, where)


@cache
def abilities(family_name: str) -> tuple[str, ...]:
    """Methods besides the call that every declared law of a family has: what a law of one's own needs in
    order to stand in for them.

    What ``@law`` adds itself does not count.
    """
    members = family(family_name).values()
    shared = [
        {n for n, thing in inspect.getmembers(m, callable) if not n.startswith("_")}
        if isinstance(m, type)
        else set()
        for m in members
    ]
    return tuple(sorted(set.intersection(*shared) - {"called", "evaluate"})) if shared else ()


@cache
def _attributes(domain: str) -> dict[str, Entry]:
    """The cards of a domain by the name that they have in Python."""
    return {entry.attribute: entry for entry in entries().values() if entry.domain == domain}


def public_names(domain: str) -> dict[str, Any]:
    """What users see of a domain: what is declared there, its classes, and the functions it offers. Helpers
    are found in their modules.
    """
    load(domain)
    offered = _offered.get(domain, ())
    found: dict[str, Any] = {}
    for module_name, module in list(sys.modules.items()):
        if module is not None and module_name.startswith(f"granum.{domain}."):
            found |= {
                n: v
                for n, v in vars(module).items()
                if not n.startswith("_")
                and getattr(v, "__module__", None) == module_name
                and (isinstance(v, type) or getattr(v, "key", None) in _declared or n in offered)
            }
    return found


def domain_names(package: str, *offered: str) -> tuple[Callable[[str], Any], Callable[[], list[str]]]:
    """``__getattr__`` and ``__dir__`` of a domain package: its declared things, classes and the functions it
    ``offered``, imported on first use.
    """
    domain = domain_of(package)
    _offered[domain] = offered

    def lookup(name: str) -> Any:
        if name.startswith("__"):
            raise AttributeError(name)
        entry = _attributes(domain).get(name)
        if entry is None and name not in offered and find_spec(f"{package}.{name}") is not None:
            return importlib.import_module(f"{package}.{name}")  # a module needs none of the others
        found = public_names(domain) if entry is None else vars(importlib.import_module(entry.module))
        if name not in found:
            close = nearest(name, found)
            hint = f"; did you mean '{close}'?" if close else ""
            raise AttributeError(f"granum.{domain} has no '{name}'{hint}")
        setattr(sys.modules[package], name, found[name])
        return found[name]

    return lookup, lambda: sorted(public_names(domain))
