"""Pipette and sedimentation balance against the settling of a suspension of known sizes, integrated by
SciPy.
"""

import numpy as np
import pytest
from scipy import stats
from scipy.integrate import quad

from granum.core.errors import ApplicabilityError, InputError
from granum.particles.formulas.sedimentation import size_distribution_balance, size_distribution_pipette

CELL = {"depth": 0.2, "particle_density": 2650.0, "fluid_density": 1000.0, "dynamic_viscosity": 1e-3}
FALL = (2650.0 - 1000.0) * 9.80665 / 18e-3  # velocity over diameter squared


def finer(d):
    return stats.norm.cdf(np.log(d / 20e-6) / 0.6)


def deposited(t):
    """All that falls the whole depth in the time, and of what is finer the share that began low enough."""
    d = np.sqrt(CELL["depth"] / FALL / t)
    density = lambda x: stats.norm.pdf(np.log(x / 20e-6) / 0.6) / 0.6 / x  # noqa: E731
    return (
        1.0
        - finer(d)
        + quad(lambda x: density(x) * FALL * x**2 * t / CELL["depth"], 0.0, d, points=[d / 4, d / 2])[0]
    )


def test_both_give_back_the_sizes_of_the_suspension() -> None:
    t = np.geomspace(30.0, 2e4, 25)
    hanging = 12.0 * finer(np.sqrt(CELL["depth"] / FALL / t))
    d, below = size_distribution_pipette(t, hanging, 12.0, **CELL)
    assert np.asarray(below) == pytest.approx(finer(np.asarray(d)), rel=1e-12)
    d, below = size_distribution_balance(t, [deposited(x) for x in t], **CELL)
    # what the tangents of 25 readings leave
    assert np.asarray(below) == pytest.approx(finer(np.asarray(d)), abs=0.01)
    assert float(size_distribution_balance([60.0], [0.3], **CELL).cumulative_fraction[0]) == 1.0
    with pytest.raises(InputError, match=r"'time' \(2\), 'deposited_fraction' \(1\)"):
        size_distribution_balance("1 2 min", "30 %", **CELL)


@pytest.mark.parametrize(
    ("card", "change", "words"),
    [
        (size_distribution_pipette, {"particle_density": 700.0}, "particle density"),
        (size_distribution_pipette, {"solids_concentration": "16 12 11 g/L"}, "concentration"),
        (size_distribution_balance, {"time": "4 2 1 min"}, "do not rise"),
        (size_distribution_balance, {"deposited_fraction": "50 40 30 %"}, "cannot become less"),
    ],
)
def test_readings_that_cannot_be_are_refused(card, change, words) -> None:
    readings = {"solids_concentration": "6 4 2 g/L", "initial_concentration": "10 g/L"}
    if card is size_distribution_balance:
        readings = {"deposited_fraction": "20 40 70 %"}
    given = {
        "time": "1 2 4 min",
        "depth": 0.2,
        "particle_density": 2700.0,
        "fluid_density": 1000.0,
        "dynamic_viscosity": 1e-3,
    }
    with pytest.raises(ApplicabilityError, match=words):
        card(**{**given, **readings, **change})
