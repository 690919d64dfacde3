"""Humid gas: psychrometrics of any gas–vapor pair, processes and charts."""

from granum.core.registry import domain_names

__getattr__, __dir__ = domain_names(__name__, "state")
