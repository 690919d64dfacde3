"""Pneumatic and hydraulic conveying, hoppers and silos."""

from granum.core.registry import domain_names

__getattr__, __dir__ = domain_names(__name__)
