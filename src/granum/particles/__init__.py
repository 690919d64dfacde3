"""Particles: sizes, shapes, distributions, sieving; drag and the motion of single particles."""

from granum.core.registry import domain_names

__getattr__, __dir__ = domain_names(__name__)
