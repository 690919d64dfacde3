"""Kinds, cards, registry, flags, errors, units at the edge, glossary and languages. Knows no engineering."""

from __future__ import annotations

from typing import Any

_HOME = {
    "formula": "formulas",
    "Formula": "formulas",
    "record_steps": "steps",
    "law": "declarations",
    "equipment": "declarations",
    "lab_test": "declarations",
    "chart": "procedures",
    "procedure": "procedures",
    "watch": "flags",
    "unconverged": "flags",
    "limit_active": "flags",
    "impossible": "flags",
    "Result": "results",
    "Card": "cards",
    "Parameter": "parameters",
}


def __getattr__(name: str) -> Any:
    from importlib import import_module

    if name in _HOME:
        return getattr(import_module(f"granum.core.{_HOME[name]}"), name)
    raise AttributeError(f"granum.core has no '{name}'")


def __dir__() -> list[str]:
    return sorted(_HOME)
