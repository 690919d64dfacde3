"""The registry: everything declared, by key. Declaring registers; looking up imports what is needed; nothing is listed by hand."""

from __future__ import annotations

import importlib
import pkgutil
import sys
from collections.abc import Callable, Iterable, Mapping
from typing import Any

from granum.core.cards import domain_of
from granum.core.errors import unknown_name
from granum.core.i18n import _

DOMAINS = ("materials", "particles", "porous", "humid_gas", "streams", "comminution", "settling", "cyclones",
           "fluidization", "filtration", "centrifuges", "crystallization", "drying", "studies")  # fmt: skip
_declared: dict[str, Any] = {}
_pending: list[Any] = []
_loaded: set[str] = set()


def register(thing: Any) -> None:
    """Called by the declaring decorators; the card itself is built when first asked for."""
    _pending.append(thing)


def _settle() -> None:
    while _pending:
        thing = _pending.pop()
        key = thing.card.key
        known = _declared.get(key)
        if known is not None and known.card.module != thing.card.module:
            raise ValueError(f"'{key}' is declared in {known.card.module} and again in {thing.card.module}")
        _declared[key] = thing


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
    _settle()
    return {key: thing for key, thing in sorted(_declared.items()) if key.split(".")[0] in domains}


def find(key: str) -> Any:
    """The declared thing of a key, or an error that suggests the nearest one.

    >>> find("particles.reynolds_number").card.domain
    'particles'
    """
    domain, _dot, _name = key.partition(".")
    if domain in DOMAINS:
        load(domain)
        _settle()
        if key in _declared:
            return _declared[key]
    raise unknown_name(_("Card"), key, everything())


def family(name: str) -> dict[str, Any]:
    """All laws of a family by key: what may be passed where ``Law(name)`` is expected."""
    return {key: thing for key, thing in everything().items() if thing.card.family == name}


def law(family_name: str, name: str, where: str = "", options: Mapping[str, Any] | None = None) -> Any:
    """A law of a family by key, by name or by the author's part of the name; modules are built with ``options``."""
    members = family(family_name)
    short: dict[str, Any] = {}
    for key, thing in members.items():
        own = thing.card.name
        short |= {key: thing, own: thing, own.removeprefix(family_name).strip("_"): thing}
    found = short.get(name)
    if found is None:
        names = {thing.card.name.removeprefix(family_name).strip("_") or thing.card.name for thing in members.values()}
        raise unknown_name(_("Law"), name, names, where)
    if isinstance(found, type):
        return found(**(options or {}))
    if options:
        raise unknown_name(_("Option"), next(iter(options)), [], where)
    return found


def domain_names(package: str) -> tuple[Callable[[str], Any], Callable[[], list[str]]]:
    """``__getattr__`` and ``__dir__`` of a domain package: its declared things and classes, imported on first use."""
    domain = domain_of(package)

    def names() -> dict[str, Any]:
        load(domain)
        found: dict[str, Any] = {}
        for module_name, module in list(sys.modules.items()):
            if module is not None and module_name.startswith(f"granum.{domain}."):
                found |= {n: v for n, v in vars(module).items() if not n.startswith("_") and getattr(v, "__module__", None) == module_name}
        return found

    def lookup(name: str) -> Any:
        if name.startswith("__"):
            raise AttributeError(name)
        found = names()
        if name not in found:
            from granum.core.errors import nearest

            close = nearest(name, found)
            hint = f"; did you mean '{close}'?" if close else ""
            raise AttributeError(f"granum.{domain} has no '{name}'{hint}")
        setattr(sys.modules[package], name, found[name])
        return found[name]

    return lookup, lambda: sorted(names())
