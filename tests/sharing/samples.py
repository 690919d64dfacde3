"""How much a run tries: a little, or as much as the environment asks for."""

import os

from granum.core import registry

SAMPLES = int(os.environ.get("GRANUM_RANDOM_SAMPLES", "0"))
"""Random settings of each thing in the long run; 0 in the short one."""

# GRANUM_DOMAINS=particles,porous limits a run to the rooms one is working in.
EVERYTHING = registry.everything(
    tuple(filter(None, os.environ.get("GRANUM_DOMAINS", "").split(","))) or registry.DOMAINS
)
