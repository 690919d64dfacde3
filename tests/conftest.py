"""Shared test settings: importing granum switches JAX to double precision before anything else does."""

import gc
from itertools import count

import pytest
from hypothesis import settings

import granum  # noqa: F401

settings.register_profile("granum", deadline=None, max_examples=40, derandomize=True)
settings.load_profile("granum")

_finished = count(1)


@pytest.fixture(autouse=True)
def _bounded_memory():
    """Thousands of compiled functions in one process would exhaust memory maps: forget them from time to time."""
    yield
    if next(_finished) % 250 == 0:
        import jax

        jax.clear_caches()
        gc.collect()
