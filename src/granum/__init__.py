"""Granum: fluid–solid unit operations from lab data to process line.

``granum.particles``, ``granum.filtration`` … load when first used; ``granum.read`` opens a case file;
``granum.alone`` is a piece of equipment with an ordinary feed, ``granum.size`` the same sized for a duty,
``granum.search`` finds a card by what people call it.
"""

from __future__ import annotations

import os
import sys
from typing import Any

__version__ = "0.1.0"

# Double precision everywhere; before JAX is imported an environment variable suffices and costs nothing.
if "jax" in sys.modules:
    sys.modules["jax"].config.update("jax_enable_x64", True)
else:
    os.environ["JAX_ENABLE_X64"] = "1"

_SUBPACKAGES = (
    "core",
    "numerics",
    "estimation",
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
    "flowsheet",
    "studies",
    "costs",
    "reports",
    "cases",
    "app",
)


def __getattr__(name: str) -> Any:
    from importlib import import_module

    if name in _SUBPACKAGES:
        return import_module(f"granum.{name}")
    if name == "read":
        return import_module("granum.cases").read
    if name in ("alone", "size"):
        return getattr(import_module("granum.cases"), name)
    if name == "search":
        return import_module("granum.core.search").search
    raise AttributeError(f"granum has no '{name}'")


def __dir__() -> list[str]:
    return sorted((*_SUBPACKAGES, "alone", "read", "search", "size", "__version__"))
