"""Grains wet with the solution of a salt that is no part of them: the crystals that stay change the solid
that gas sees, and every balance must see the same one.
"""

from __future__ import annotations

import numpy as np
import pytest

import granum as gr

SALT = "potassium nitrate"
DRYERS = [
    "drying.fluidized_bed_dryer",
    "drying.vibrated_bed_dryer",
    "drying.rotary_dryer",
    "drying.well_mixed_dryer",
    "drying.tray_dryer",
]


@pytest.mark.parametrize("key", DRYERS)
@pytest.mark.parametrize("seed", range(2))
def test_it_closes_and_keeps_the_salt(key: str, seed: int) -> None:
    rng = np.random.default_rng(seed)
    share, there = float(rng.uniform(0.05, 0.3)), float(rng.uniform(0.0, 0.5))
    run = gr.alone(
        key,
        mixture={"liquids": f"water,{SALT}", "solids": f"quartz,{SALT}"},
        feed={
            "liquid": {"water": 1.0 - share, SALT: share},
            "solid": {"quartz": 1.0 - there, SALT: there},
        },
    ).solve()
    assert run.audit["mass_closure"] < 1e-9
    assert run.audit["energy_closure"] < 1e-9
    feed, product = (
        run.streams["feed"],
        next(iter(s for n, s in run.streams.items() if n.endswith("product"))),
    )
    place = feed.mixture.components.index(SALT)
    assert float(product.components[place]) == pytest.approx(float(feed.components[place]), rel=1e-9)
