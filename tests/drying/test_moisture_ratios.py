"""Times by diffusion, slopes and thin-layer models evaluated: closed forms, Crank's numbers and the way
back.
"""

from __future__ import annotations

import numpy as np
import pytest

from granum.core.errors import ApplicabilityError
from granum.drying.formulas import diffusion
from granum.drying.formulas import moisture_ratios as m

PAGE = {"law": "thin_layer_page", "rate_constant": 0.0123, "time_exponent": 1.1}


def test_times_by_diffusion() -> None:
    # McCabe, example 24.2, by the first term of the series: 4·1.27²/(π²·8.3e-6)·ln(8·0.25/(π²·0.05)) s
    by_hand = 4 * 1.27**2 / (np.pi**2 * 8.3e-6) * np.log(8 * 0.25 / (np.pi**2 * 0.05))
    assert m.drying_time_diffusion(0.2, "1.27 cm", "8.3e-6 cm^2/s") == pytest.approx(by_hand, rel=1e-4)
    root = next(
        x.real
        for x in np.roots([1 / 9, 0, 0, 0, 0, 0, 0, 0, 1, -(np.pi**2) / 16])
        if abs(x.imag) < 1e-12 and x.real > 0
    )
    # two terms: x + x⁹/9 = π²/16
    assert m.drying_time_diffusion(0.5, 1.0, 1.0) == pytest.approx(-4 / np.pi**2 * np.log(root), rel=1e-6)
    ratios = np.array([1.0, 0.99, 0.6, 0.2, 1e-3, 1e-6])
    for shape in ("plate", "cylinder", "sphere"):
        times = np.array([m.drying_time_diffusion(ratio, 2e-3, 1e-10, shape) for ratio in ratios])
        assert getattr(diffusion, shape)(1e-10 * times / 4e-6) == pytest.approx(ratios, rel=1e-6)
    with pytest.raises(ApplicabilityError, match="without end"):
        m.drying_time_diffusion(0.0, 2e-3, 1e-10)


def test_slopes_are_those_of_the_series() -> None:
    for found, ratio, length in (
        (m.diffusivity_from_slope_plate, diffusion.moisture_ratio_plate, 2e-3),
        (m.diffusivity_from_slope_sphere, diffusion.moisture_ratio_sphere, 3e-3),
    ):
        late = np.array([1.0, 1.1]) * length**2 / 1e-10
        slope = np.diff(np.log(ratio(late, length, 1e-10)))[0] / (late[1] - late[0])
        assert found(-slope, length) == pytest.approx(1e-10, rel=1e-6)


def test_thin_layers_in_the_time_of_their_constants() -> None:
    assert m.moisture_ratio_thin_layer("60 min", PAGE, "1 min") == pytest.approx(np.exp(-0.0123 * 60**1.1))
    assert m.drying_time_thin_layer(0.1, PAGE, "1 min") == pytest.approx(
        60 * (np.log(10) / 0.0123) ** (1 / 1.1)
    )
    many = [m.drying_time_thin_layer(ratio, PAGE, 60.0) for ratio in (1.0, 0.5, 0.01)]
    assert many == pytest.approx(60 * (-np.log([1.0, 0.5, 0.01]) / 0.0123) ** (1 / 1.1), abs=1e-3)
    # the parabola of Wang and Singh turns before it reaches a hundredth: 1 − 0.1 t + 0.003 t² has its lowest
    # point at 1/6
    turning = {"law": "thin_layer_wang_singh", "time_slope": -0.1, "time_curvature": 0.003}
    assert m.drying_time_thin_layer(0.5, turning, "1 hour") == pytest.approx(
        3600 * (0.1 - np.sqrt(0.004)) / 0.006
    )
    with pytest.raises(ApplicabilityError, match="does not come down"):
        m.drying_time_thin_layer(0.01, turning, "1 hour")
