"""A line with a recycle, built, solved and reported in Python: limestone is milled wet until it passes a
screen of 300 µm.
"""

from __future__ import annotations

import sys

import numpy as np

from granum.comminution import AustinBreakage, AustinSelection, BallMill, LargeAndTwoSmall, Screen
from granum.flowsheet import Flowsheet
from granum.particles import RosinRammlerPartition
from granum.streams import Mixer, feed, mixture_of

slurry = mixture_of(["water"], ["calcite"], [], np.geomspace(8e-6, 4.096e-3, 19))
fresh = feed(
    slurry,
    solid_flow="20 t/h",
    liquid_flow="10 t/h",
    temperature="20 degC",
    sizes={"law": "rosin_rammler", "size_modulus": "1.2 mm", "distribution_exponent": 2.0},
)
mill = BallMill(
    AustinSelection("0.6 1/min", 0.9),
    AustinBreakage(0.5, 0.8, 4.0),
    "1.6 tonne",
    LargeAndTwoSmall(0.7),
    shaft_power="150 kW",
    breakage_convention="root_two",
)
screen = Screen(RosinRammlerPartition("300 um", 4.0), liquid_split_oversize="10 %")
line = Flowsheet(
    {"sump": Mixer(), "mill": mill, "screen": screen},
    {"fresh": fresh},
    {
        "fresh": ("", "sump.fresh"),
        "mill_feed": ("sump", "mill"),
        "ground": ("mill", "screen"),
        "returned": ("screen.oversize", "sump.returned"),
        "product": ("screen.undersize", ""),
    },
)
run = line.solve(title="Ball mill in closed circuit")
for name, stream in run.streams.items():
    print(
        f"{name:10s} {3.6 * float(stream.solid_flow):6.2f} t/h of solid, finer than 256 µm: "
        f"{float(stream.size_fractions[:10].sum()):.0%}"
    )
print(f"mass closes to {run.audit['mass_closure']:.0e}")
assert run.audit["mass_closure"] < 1e-9
assert abs(float(run.streams["product"].solid_flow) * 3.6 - 20.0) < 1e-6
if __name__ == "__main__" and len(sys.argv) > 1:
    run.report(sys.argv[1])
