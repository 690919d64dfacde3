"""The example that goes from a laboratory CSV to an optimized press."""

from __future__ import annotations

import numpy as np
import pytest
from tests.sharing.places import EXAMPLES

from granum.cases import read, read_studies

CASE = EXAMPLES / "lab-to-plant" / "line.toml"


@pytest.fixture(scope="module")
def found():
    return read_studies(CASE)["sizes"].with_options(samples=400).run()


def test_the_line_takes_what_the_test_gives() -> None:
    """Printed in Geankoplis, example 14.2-1: 1.863e11 m/kg and 10.63e10 1/m."""
    press = read(CASE).sheet.units["press"]
    assert press.cake_resistance == pytest.approx(1.863e11, rel=5e-3)
    assert press.medium_resistance == pytest.approx(10.63e10, rel=5e-3)


def test_sizes_follow_from_the_spread_by_hand(found) -> None:
    """Cakes of fixed thickness: the cycles needed go with the solids, the time of a cycle not, so the area
    goes with the solids.

    The spread of the solids alone, 5 %, gives P90/P10 = 1 + 2·1.2816·0.05 = 1.13; the void fraction does not
    halve it.
    """
    assert found.counts()["failed"] == 0
    row = found.findings()["statistics"]["press.area"]
    assert 1.08 < row["p90"] / row["p10"] < 1.20
    ranks = found.rank_correlations()["press.area"]
    assert max(ranks, key=lambda n: abs(ranks[n])) == "slurry.solid_flow"
    # half the chamber is one cake
    assert found.column("press.cake_thickness") == pytest.approx(np.full(400, 12.5e-3))


def test_cost_is_that_of_the_table(found) -> None:
    """Purchased 10**(4.2756 + 0.3520 log A + 0.0714 log² A) at index 397, installed 1.8 times as much,
    carried to 797.9.
    """
    logs = np.log10(found.column("press.area"))
    by_hand = 10 ** (4.2756 + 0.3520 * logs + 0.0714 * logs**2) * 1.8 * 797.9 / 397.0
    assert found.column("press_cost") == pytest.approx(by_hand, rel=1e-9)


def test_uncertainty_of_the_fit_arrives_whole(found) -> None:
    """Cake and medium resistance are drawn with the correlation of the test, which is strongly negative."""
    drawn = np.corrcoef(found.column("press.cake_resistance"), found.column("press.medium_resistance"))[0, 1]
    assert drawn < -0.7


def test_price_of_room_is_what_more_room_saves() -> None:
    """The price of the limit, from the multipliers, against the optimum with a little more room."""
    study = read_studies(CASE)["cheapest"].with_options(starts=1)
    tight, wide = (study.with_options(limits={"press.area": {"upper": area}}).run() for area in (12.0, 12.2))
    assert tight.feasible
    assert tight.figures["press.area"] == pytest.approx(12.0, rel=1e-6)
    slope = (wide.figures["yearly_cost"] - tight.figures["yearly_cost"]) / 0.2
    assert (tight.prices["press.area upper"] + wide.prices["press.area upper"]) / 2 == pytest.approx(
        slope, rel=1e-3
    )
    assert tight.figures["yearly_cost"] < tight.base["yearly_cost"]
