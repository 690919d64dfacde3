"""A machine operated from Python: a program that says what its operations say one by one."""

import jax
import jax.numpy as jnp
import numpy as np
import pytest
from tests.contracts.separator_cases import slurry

from granum.core import record_steps
from granum.core.errors import ApplicabilityError
from granum.core.packing import compiled
from granum.settling.equipment.thickener import Thickener
from granum.settling.velocities import Vesilind
from granum.streams import units

FEED = slurry(jnp.array([0.3, 1.0, 0.3, 0.0]), 0.5, 0.3)


def test_a_program_says_what_its_operations_say() -> None:
    unit = Thickener(1000.0, 900.0, Vesilind(1e-3, 0.01))
    with record_steps() as steps:
        made = unit.operate(feed=FEED)
    with record_steps() as one_by_one:
        plain = units._passed(True, unit, {"feed": FEED})
    for found, expected in zip(jax.tree.leaves(made), jax.tree.leaves(plain), strict=True):
        np.testing.assert_allclose(np.asarray(found, float), np.asarray(expected, float), rtol=1e-9)
    assert [s.key for s in steps] == [s.key for s in one_by_one]
    assert steps
    for found, expected in zip(steps, one_by_one, strict=True):
        assert found.result().outputs == pytest.approx(expected.result().outputs, rel=1e-9, nan_ok=True)


def test_what_is_impossible_is_refused_in_words() -> None:
    with pytest.raises(ApplicabilityError, match="underflow concentration = 20 g/L is outside"):
        Thickener(10.0, 20.0, Vesilind(1e-3, 0.01)).operate(feed=FEED)


def test_arrays_of_another_length_are_another_program() -> None:
    double = compiled(_doubled)
    for count in (3, 5, 3):
        np.testing.assert_array_equal(double(np.arange(float(count))), 2.0 * np.arange(float(count)))


def _doubled(x):
    return 2.0 * x
