"""Evaporators: one effect or many, with vapor recompression, crystallizing or not."""

from granum.core.registry import domain_names

__getattr__, __dir__ = domain_names(__name__)
