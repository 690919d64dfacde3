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


@pytest.mark.parametrize(("air", "humidity"), [("20 degC", "40 %"), ("5 degC", "95 %"), ("30 degC", "85 %")])
def test_grain_that_takes_up_water_dilutes_its_liquor(air: str, humidity: str) -> None:
    """More water than came in with it held more salt than there was, and the bin was refused."""
    salt = "sodium chloride"
    run = gr.alone(
        "drying.grain_bin",
        mixture={"liquids": f"water,{salt}", "solids": f"maize,{salt}"},
        feed={"liquid": {"water": 0.75, salt: 0.25}, "solid": {"maize": 1.0, salt: 0.0}},
        gas={"temperature": air, "relative_humidity": humidity},
    ).solve()
    feed, product = run.streams["feed"], run.streams["grain_bin.product"]
    assert run.audit["mass_closure"] < 1e-9
    assert run.audit["energy_closure"] < 1e-9
    crystals = float(product.solid[1].sum())
    assert float(product.liquid[1]) + crystals == pytest.approx(float(feed.liquid[1]), rel=1e-9)
    assert crystals >= 0.0
    if product.liquid[0] > feed.liquid[0]:  # none is left, and the liquor is thinner than it came
        assert crystals == pytest.approx(0.0, abs=1e-12)
        assert product.liquid[1] / product.liquid[0] <= feed.liquid[1] / feed.liquid[0] + 1e-12
