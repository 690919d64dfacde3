"""Crystallization: equilibrium, kinetics, population balances, vessels."""

from granum.core.registry import domain_names

__getattr__, __dir__ = domain_names(__name__)
