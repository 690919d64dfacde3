"""Streams that carry solids, liquid and gas; abstract equipment; audits."""

from granum.core.registry import domain_names

__getattr__, __dir__ = domain_names(__name__, "feed", "mixture_of")
