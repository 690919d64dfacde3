"""Countercurrent decantation against a balance of each thickener and a book."""

import numpy as np
import pytest

from granum.core.errors import ApplicabilityError
from granum.filtration import solute_remaining_countercurrent


@pytest.mark.parametrize(
    ("wash", "stages", "feed"), [(0.5, 2, 1.0), (1.0, 4, 1.0), (2.5, 3, 3.0), (3.0, 6, 0.7)]
)
def test_each_thickener_in_balance(wash, stages, feed):
    A, b = np.zeros((stages, stages)), np.zeros(stages)
    for k in range(stages):  # underflows of one, overflows of the wash, the first with the feed's liquor too
        A[k, k] = (wash + feed) if k == 0 else wash + 1.0
        if k > 0:
            A[k, k - 1] = -1.0
        if k + 1 < stages:
            A[k, k + 1] = -wash
    b[0] = feed
    lost = np.linalg.solve(A, b)[-1] / feed
    assert solute_remaining_countercurrent(wash, stages, feed) == pytest.approx(lost, rel=1e-12)


def test_caustic_soda_by_the_book():
    # Coulson and Richardson, volume 2, chapter 10 (problem opened, its answer recalled): with four liquors
    # over each underflow 3.11 thickeners lose 1 % of the soda, so four are built
    assert solute_remaining_countercurrent(wash_ratio=4, wash_stages=3.11) == pytest.approx(0.01, rel=0.02)
    with pytest.raises(ApplicabilityError, match="at least the liquor"):
        solute_remaining_countercurrent(wash_ratio=0.2, wash_stages=2, feed_liquor_ratio=0.5)
