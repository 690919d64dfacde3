"""Every example in a docstring of the package runs and prints what it says."""

import doctest
from importlib import import_module
from pkgutil import iter_modules

import jax.numpy as jnp
import pytest

import granum.numerics


@pytest.mark.parametrize("name", [module.name for module in iter_modules(granum.numerics.__path__)])
def test_examples(name: str) -> None:
    module = import_module(f"granum.numerics.{name}")
    assert doctest.testmod(module, extraglobs={"jnp": jnp}).failed == 0


def test_every_export_exists() -> None:
    for name in dir(granum.numerics):
        assert getattr(granum.numerics, name).__doc__
