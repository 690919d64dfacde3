"""Messages, files, flags and recorded steps of the core."""

from __future__ import annotations

from pathlib import Path

import jax
import jax.numpy as jnp
import numpy as np
import pytest

from granum.conveying import unconfined_strength
from granum.core import record_steps
from granum.core.conversion import law_of
from granum.core.errors import ApplicabilityError, InputError, nearest
from granum.core.files import write_atomic
from granum.particles import drag_coefficient_stokes, reynolds_number, terminal_velocity

GOOD = {"particle_diameter": 1e-3, "velocity": 0.1, "fluid_density": 1000.0, "dynamic_viscosity": 1e-3}


def test_nearest_name() -> None:
    assert nearest("particle_diametre", ["particle_density", "particle_diameter"]) == "particle_diameter"
    assert nearest("zzz", ["particle_density"]) is None


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"particle_diameter": -1.0}, "must be greater than 0"),
        ({"particle_diameter": float("nan")}, "not a number"),
        ({"particle_diameter": float("inf")}, "not possible"),
        ({"particle_diameter": True}, "not a number"),
        ({"particle_diameter": object()}, "not a number"),
        ({"particle_diameter": None}, "needs a value"),
        ({"diameter_of_particle": 1.0}, "is not known"),
    ],
)
def test_bad_scalars_raise_one_message(change: dict, message: str) -> None:
    with pytest.raises(InputError, match=message):
        reynolds_number(**{**GOOD, **change})


def test_percent_is_proposed_only_where_it_would_do() -> None:
    powder = {"consolidation_stress": 3e3, "strength_intercept": 0.0, "strength_slope": 0.3}
    with pytest.raises(InputError, match=r"between 0\.05 and 1\.$"):
        unconfined_strength(**powder, strength_exponent=2.0)
    with pytest.raises(InputError, match=r"Did you mean 40 %\?$"):
        unconfined_strength(**powder, strength_exponent=40.0)


def test_missing_and_doubled_inputs() -> None:
    with pytest.raises(InputError, match=r"needs 'velocity'.*'dynamic_viscosity'"):
        reynolds_number(particle_diameter=1e-3, fluid_density=1000.0)
    with pytest.raises(InputError, match="given twice"):
        reynolds_number(1e-3, particle_diameter=1e-3)
    with pytest.raises(InputError, match="takes 4 values"):
        reynolds_number(1.0, 1.0, 1.0, 1.0, 1.0)


def test_arrays_keep_good_elements_and_flag_bad_ones() -> None:
    result = reynolds_number.evaluate(**{**GOOD, "particle_diameter": np.array([1e-3, -1.0, 2e-3])})
    np.testing.assert_allclose(result.value, [100.0, np.nan, 200.0])
    assert result.flags.tolist() == [0, 2, 0]
    assert result.notices[0]["count"] == 1
    with pytest.raises(ApplicabilityError, match="outside what is possible"):
        result.check()


def test_extrapolation_keeps_the_value_and_says_so() -> None:
    result = drag_coefficient_stokes.evaluate(reynolds=100.0)
    assert result.value == pytest.approx(0.24)
    assert result.notices[0]["flag"] == "extrapolated"
    assert result.check() == result.value


def test_flags_of_inner_laws_reach_the_caller() -> None:
    inputs = {
        "particle_diameter": "5 mm",
        "particle_density": 2650,
        "fluid_density": 998,
        "dynamic_viscosity": "1 mPa*s",
        "drag": "stokes",
    }
    cards = {n["card"] for n in terminal_velocity.evaluate(**inputs).notices}
    assert "particles.drag_coefficient_stokes" in cards


def test_formulas_work_inside_transformations_without_flags_leaking() -> None:
    def inner(x):
        return jax.vmap(lambda d: reynolds_number(d, 0.1, 1000.0, 1e-3))(x).sum()

    assert float(jax.jit(jax.grad(inner))(jnp.array([1e-3, 2e-3]))[0]) == pytest.approx(1e5)


def test_steps_are_recorded_for_the_note() -> None:
    with record_steps() as steps:
        reynolds_number(**GOOD)
    assert [s.key for s in steps] == ["particles.reynolds_number"]
    assert steps[0].result().outputs["reynolds_number"] == pytest.approx(100.0)


def test_atomic_write_replaces_or_leaves(tmp_path: Path) -> None:
    target = tmp_path / "case.toml"
    write_atomic(target, "old")
    write_atomic(target, "new")
    assert target.read_text() == "new"
    assert [p.name for p in tmp_path.iterdir()] == ["case.toml"]
    with pytest.raises(InputError, match="cannot be written"):
        write_atomic(tmp_path / "no" / "folder.toml", "x")


def test_law_with_options_as_text() -> None:
    found = law_of("partition_curve", "logistic", options={"cut_size": "100 um", "sharpness": 3.0})
    assert float(found(200e-6)) == pytest.approx(8 / 9)
