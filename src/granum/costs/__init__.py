"""Costs: purchased and installed equipment, price index, energy, annual charges."""

from granum.core.registry import domain_names

__getattr__, __dir__ = domain_names(__name__)
