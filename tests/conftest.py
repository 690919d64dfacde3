"""Shared test settings: importing granum switches JAX to double precision before anything else does."""

from hypothesis import settings

import granum  # noqa: F401

settings.register_profile("granum", deadline=None, max_examples=40, derandomize=True)
settings.load_profile("granum")
