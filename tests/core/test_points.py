"""Points of a law as people type them by mistake: one too few, two alike, rising where nothing rises."""

from __future__ import annotations

import pytest

import granum as gr
from granum.core.errors import InputError

FLUX = gr.filtration.MeasuredFlux
SETTLING = gr.settling.MeasuredSettling
PROGRAM = gr.crystallization.TemperaturePoints


@pytest.mark.parametrize(
    ("law", "points", "says"),
    [
        (FLUX, ("10 g/L, 100 g/L", "60 L/m2/h"), "Unequal numbers"),
        (FLUX, ("10 g/L, 10 g/L", "60 L/m2/h, 20 L/m2/h"), "the same 'concentration_points'"),
        (FLUX, ("100 g/L, 10 g/L", "60 L/m2/h, 20 L/m2/h"), "between points 2 and 1"),
        (SETTLING, ("20 g/L, 50 g/L, 100 g/L", "2 m/h, 0.5 m/h, 0.6 m/h"), "between points 2 and 3"),
        (SETTLING, ("20 g/L", "2 m/h, 0.5 m/h"), "Unequal numbers"),
        (PROGRAM, ("0 min, 60 min", "60 degC, 40 degC, 20 degC"), "Unequal numbers"),
        (PROGRAM, ("0 min, 60 min, 30 min", "60 degC, 40 degC, 20 degC"), "at number 3"),
    ],
)
def test_points_that_cannot_be_meant_are_refused_in_words(
    law: type, points: tuple[str, str], says: str
) -> None:
    with pytest.raises(InputError, match=says):
        law(*points)


def test_the_order_of_measured_points_is_free_and_a_step_in_time_is_none_of_them() -> None:
    assert FLUX("100 g/L, 10 g/L", "20 L/m2/h, 60 L/m2/h")(31.622776601683793) == pytest.approx(40 / 3.6e6)
    assert float(PROGRAM("0 min, 60 min, 60 min", "60 degC, 40 degC, 30 degC")(7200.0)) == pytest.approx(
        303.15
    )
