"""Hausner ratio and compressibility index."""

from __future__ import annotations

import pytest

from granum.conveying import hausner_ratio
from granum.core.errors import ApplicabilityError


@pytest.mark.parametrize(("index", "ratio"), [(10, 1.11), (15, 1.18), (20, 1.25), (25, 1.34), (31, 1.45)])
def test_the_steps_of_the_pharmacopoeia(index: float, ratio: float) -> None:
    # USP 1174, table 2, as remembered; it rounds the ratios
    found = hausner_ratio(1.0 - index / 100, 1.0)
    assert float(found.hausner_ratio) == pytest.approx(ratio, abs=0.01)
    assert float(found.compressibility_index) == pytest.approx(index / 100)


def test_tapping_makes_no_powder_looser() -> None:
    with pytest.raises(ApplicabilityError, match="no looser"):
        hausner_ratio(600.0, 500.0)
