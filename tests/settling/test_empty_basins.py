"""A basin that nothing enters yet, as where Newton's method begins on a line: its derivatives are numbers."""

from __future__ import annotations

import jax
import jax.numpy as jnp
import numpy as np
import pytest
from tests.contracts import separator_cases
from tests.contracts.unit_search import FEED

from granum.settling.equipment.clarifiers import Clarifier


@pytest.mark.parametrize("tank_number", [None, 3.0])
def test_what_leaves_grows_with_the_first_of_the_feed(tank_number: float | None) -> None:
    case = separator_cases.case_of("circular")
    feed = case.feeds(case.mixture, jnp.full(FEED, 0.5))["feed"]
    unit = Clarifier(area=9.0, underflow_concentration=700.0, tank_number=tank_number)

    def parts(share: float) -> tuple[list[jax.Array], list[jax.Array]]:
        outlets = unit(feed.part(share, share, share))
        return [s.solid for s in outlets], [s.liquid for s in outlets]

    _, (solid, liquid) = jax.jit(lambda x: jax.jvp(parts, (x,), (1.0,)))(0.0)
    assert all(np.isfinite(x).all() for x in (*solid, *liquid))
    np.testing.assert_allclose(sum(solid), feed.solid, rtol=1e-9)
    np.testing.assert_allclose(sum(liquid), feed.liquid, rtol=1e-9)
