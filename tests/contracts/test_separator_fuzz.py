"""Settlers, fluidized beds and cyclones at random ordinary settings: balances close, streams hold nothing
negative, figures keep their bounds.
"""

from __future__ import annotations

import jax
import jax.numpy as jnp
import numpy as np
import pytest
from tests.contracts.separator_cases import UNITS, case_of, slurry
from tests.contracts.unit_search import rows, tried, wrong
from tests.sharing.samples import SAMPLES

from granum.core.errors import ApplicabilityError
from granum.cyclones.equipment.liquid import Hydrocyclone
from granum.settling.equipment.thickener import Thickener
from granum.settling.velocities import Vesilind

COUNT = 200


@pytest.mark.parametrize("name", UNITS)
def test_random_settings(name: str) -> None:
    found = tried(case_of(name), rows(max(COUNT, SAMPLES)))
    assert not wrong(found)
    assert found.refused.mean() <= 0.1  # a thickener whose feed is thicker than its underflow


def test_light_solids_in_a_hydrocyclone_go_with_the_liquid_and_are_told() -> None:
    feed = slurry(np.array([0.3, 0.5, 0.3, 1.0]), 0.5, 0.3)
    unit = Hydrocyclone(0.1, 0.015)
    out = unit(feed)
    share = out.underflow.solid / feed.solid
    # oil divides like the water
    np.testing.assert_allclose(share[1], float(out.underflow.liquid_flow / feed.liquid_flow), rtol=1e-12)
    alone = unit(feed.replace(solid=feed.solid.at[1].set(0.0)))
    assert float(jnp.max(alone.underflow.solid[0])) > 0.0
    check = {c.name: c.ok for c in unit.operate(feed=feed).checks}
    assert not check["share of the solids that is heavier than the liquid"]
    assert np.isfinite(float(unit.operate(feed=feed).figures.cut_size))


def test_a_feed_thicker_than_the_underflow_passes_and_is_told() -> None:
    feed = slurry(np.array([0.3, 1.0, 0.3, 0.0]), 0.5, 0.3)
    unit = Thickener(10.0, 20.0, Vesilind(1e-3, 0.01))

    @jax.jit
    def run(stream):
        made = unit.operate(feed=stream)
        return made.figures, made.checks[0].value

    figures, thinner = run(feed)
    assert all(np.isfinite(float(x)) for x in figures)
    assert float(thinner) > 1.0
    with pytest.raises(
        ApplicabilityError, match="underflow concentration = 20 g/L is outside what is possible"
    ):
        unit(feed)
