"""Dust in gas: bag filters, scrubbers, electrostatic precipitators, settling chambers, emissions."""

from granum.core.registry import domain_names

__getattr__, __dir__ = domain_names(__name__)
