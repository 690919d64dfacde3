"""Examples in docstrings of modules without cards; those with cards run among the contracts."""

from __future__ import annotations

import doctest
import importlib
import pkgutil

import pytest

import granum

ROOMS = ("core", "numerics", "estimation", "streams", "flowsheet", "studies", "cases", "reports")
MODULES = sorted(
    m.name
    for room in ROOMS
    for m in pkgutil.walk_packages(importlib.import_module(f"granum.{room}").__path__, f"granum.{room}.")
)


@pytest.mark.parametrize("module", MODULES)
def test_examples(module: str) -> None:
    outcome = doctest.testmod(
        importlib.import_module(module),
        optionflags=doctest.ELLIPSIS | doctest.NORMALIZE_WHITESPACE,
        extraglobs={"jnp": importlib.import_module("jax.numpy"), "granum": granum},
    )
    assert outcome.failed == 0


def test_every_export_of_the_numerics_is_explained() -> None:
    numerics = importlib.import_module("granum.numerics")
    for name in dir(numerics):
        assert getattr(numerics, name).__doc__
