"""What may stand as a law: a function, a formula with options of its own; all else is refused when it is
given.
"""

from __future__ import annotations

import functools
import math

import jax
import numpy as np
import pytest

import granum as gr
from granum.core.errors import InputError

FALL = {
    "particle_diameter": 50e-6,
    "particle_density": 2650.0,
    "fluid_density": 998.0,
    "dynamic_viscosity": 1e-3,
}
STOKES = 9.80665 * 50e-6**2 * (2650.0 - 998.0) / (18.0 * 1e-3)


@pytest.mark.parametrize(
    "law",
    [
        lambda re: 24.0 / re,
        functools.partial(lambda a, re: a / re, 24.0),
        jax.tree_util.Partial(lambda re: 24.0 / re),
    ],
)
def test_a_plain_function_is_a_law_of_a_formula(law: object) -> None:
    assert gr.particles.terminal_velocity(**FALL, drag=law) == pytest.approx(STOKES, rel=1e-9)


def test_a_plain_function_is_compiled_once() -> None:
    def drag(re):
        calls.append(1)
        return 24.0 / re

    calls: list[int] = []
    gr.particles.terminal_velocity(**FALL, drag=drag)
    first = len(calls)
    gr.particles.terminal_velocity(**{**FALL, "particle_diameter": 60e-6}, drag=drag)
    assert len(calls) == first > 0


@pytest.mark.parametrize(
    ("law", "message"),
    [
        (lambda re: 24.0 / np.sqrt(re), "written with jax.numpy"),
        (lambda re: 24.0 / re if re < 1 else 0.44, "written with jax.numpy"),
        (lambda re: "a", "is not a number"),
        (lambda: 3.0, "failed: TypeError"),
        (3.0, "is not a law"),
        (True, "is not a law"),
        ([], "is not a law"),
        (int, "is not a law"),
        (gr.porous.pressure_gradient_ergun, "family 'drag_coefficient'"),
        ({"law": "stokes", "reynolds": 1.0}, "cannot be an option"),
        ({"law": "stokes", "slip": 1.0}, "'slip' is not known"),
        ("{" * 5000, "not a table"),
        ('{law = "stokes", a = ' + "9" * 5000 + "}", "not a table"),
    ],
)
def test_what_is_no_law_is_one_message(law: object, message: str) -> None:
    with pytest.raises(InputError, match=message):
        gr.particles.terminal_velocity(**FALL, drag=law)


def test_a_law_of_a_family_with_methods_needs_them_when_it_is_given() -> None:
    with pytest.raises(InputError, match=r"\.over\(…\)"):
        gr.comminution.Screen(separation=lambda size: size)


def test_a_formula_as_a_law_takes_its_own_options() -> None:
    """Macdonald's smooth grains have 1.8, his rough ones 4.0 (Macdonald 1979, equation 18)."""
    bed = {
        "superficial_velocity": 0.1,
        "length": 1.0,
        "particle_diameter": 3e-3,
        "void_fraction": 0.4,
        "fluid_density": 998.0,
        "dynamic_viscosity": 1e-3,
    }

    def by_hand(inertial: float) -> float:
        return (
            180.0 * 1e-3 * 0.1 / 3e-3**2 * 0.6**2 / 0.4**3 + inertial * 998.0 * 0.1**2 / 3e-3 * 0.6 / 0.4**3
        )

    drop = gr.porous.pressure_drop_packed_bed
    for inertial in (1.8, 4.0):
        law = {"law": "macdonald", "inertial_constant": inertial}
        assert drop(**bed, pressure_gradient=law) == pytest.approx(by_hand(inertial), rel=1e-9)
    text = drop.evaluate(**bed, pressure_gradient='{law = "macdonald", inertial_constant = "4.0"}')
    assert text.value == pytest.approx(by_hand(4.0), rel=1e-9)
    back = gr.porous.superficial_velocity_packed_bed(
        pressure_drop=by_hand(4.0),
        **{k: v for k, v in bed.items() if k != "superficial_velocity"},
        pressure_gradient={"law": "macdonald", "inertial_constant": 4.0},
    )
    assert back == pytest.approx(0.1, rel=1e-6)
    with pytest.raises(InputError, match="Did you mean 'inertial_constant'"):
        drop(**bed, pressure_gradient={"law": "macdonald", "inertial_const": 4.0})
    slope = jax.grad(lambda c: drop(**bed, pressure_gradient={"law": "macdonald", "inertial_constant": c}))(
        4.0
    )
    assert slope == pytest.approx(by_hand(5.0) - by_hand(4.0), rel=1e-9)
    assert math.isfinite(slope)
