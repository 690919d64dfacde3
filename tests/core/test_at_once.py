"""Methods that run as one program give what they give operation by operation: numbers, flags, refusals."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import jax
import jax.numpy as jnp
import numpy as np
import pytest

from granum.core import flags
from granum.core.at_once import at_once
from granum.core.errors import GranumError
from granum.core.steps import record_steps
from granum.materials import fluid, solid, solute
from granum.materials.brines import brine
from granum.numerics.interpolation import MonotoneCubic
from granum.particles import terminal_velocity
from granum.particles.distributions import SizeDistribution

TRIED = 12


def itself(method: Any) -> Callable[..., Any]:
    """A method as it is written, bound as it was."""
    return lambda *args, **kwargs: (
        type(method.__self__).__dict__[method.__name__].__wrapped__(method.__self__, *args, **kwargs)
    )


def sizes(rng: np.random.Generator) -> SizeDistribution:
    count = int(rng.choice([3, 8]))
    edges = np.concatenate([[0.0], np.cumsum(rng.uniform(1e-6, 4e-5, count))])
    amounts = rng.uniform(0.0, 1.0, count) * (rng.random(count) < 0.8) + 1e-3
    return SizeDistribution.from_amounts(edges, amounts, str(rng.choice(["number", "surface", "volume"])))


CASES: dict[str, Callable[[np.random.Generator], tuple[Any, tuple[Any, ...]]]] = {
    "boiling": lambda rng: (fluid("water").boiling_temperature, (rng.uniform(1e4, 1e6),)),
    "enthalpy": lambda rng: (fluid("ethanol").vapor_enthalpy, (rng.uniform(280.0, 340.0, 3),)),
    "solid": lambda rng: (solid("quartz").enthalpy, (rng.uniform(280.0, 340.0),)),
    "solubility": lambda rng: (solute("sodium sulfate").solubility, (rng.uniform(270.0, 380.0, 4),)),
    "saturation": lambda rng: (solute("potassium nitrate").saturation_temperature, (rng.uniform(0.2, 1.5),)),
    "heat": lambda rng: (solute("magnesium sulfate").heat_of_crystallization, (rng.uniform(280.0, 350.0),)),
    "elevation": lambda rng: (
        solute("sodium chloride").boiling_point_elevation,
        (rng.uniform(3e4, 2e5), rng.uniform(0.01, 0.3)),
    ),
    "brine": lambda rng: (
        brine(["sodium chloride", "potassium sulfate"]).saturation,
        (rng.uniform(280.0, 350.0), rng.uniform(0.1, 3.0, 4)),
    ),
    "beside": lambda rng: (
        brine(["sodium chloride", "potassium chloride"]).solubility,
        (rng.uniform(280.0, 350.0), np.array([1.0, 0.0, 1.0]) * rng.uniform(0.1, 4.0), 1),
    ),
    "percentile": lambda rng: (sizes(rng).percentile, (rng.random(3),)),
    "moment": lambda rng: (sizes(rng).moment, (int(rng.integers(-1, 4)), "volume")),
    "mean": lambda rng: (sizes(rng).mean, (int(rng.integers(1, 4)), 0)),
    "basis": lambda rng: (sizes(rng).to_basis, (str(rng.choice(["number", "mass"])),)),
    "table": lambda rng: (
        MonotoneCubic.through(np.arange(4.0), np.cumsum(rng.random(4))).inverse,
        (rng.uniform(0.0, 4.0, 5),),
    ),
}


@pytest.mark.parametrize("name", CASES)
def test_numbers_and_flags_are_those_of_the_operations_one_by_one(name: str) -> None:
    rng = np.random.default_rng(7)
    for _turn in range(TRIED):
        method, inputs = CASES[name](rng)
        with flags.collect() as heard:
            found = method(*inputs)
        with flags.collect() as expected:
            alone = itself(method)(*inputs)
        assert jax.tree.structure(found) == jax.tree.structure(alone)
        jax.tree.map(
            lambda a, b: np.testing.assert_allclose(a, b, rtol=1e-9, atol=1e-300, equal_nan=True),
            found,
            alone,
        )
        raised = [
            {(r.bit, r.name, r.card) for r in records if np.any(r.mask)} for records in (heard, expected)
        ]
        assert raised[0] == raised[1]


def test_text_with_a_unit_is_its_number_and_what_cannot_be_is_refused() -> None:
    salt = solute("potassium nitrate")
    assert salt.solubility("60 degC") == salt.solubility(333.15)
    assert salt.saturation_temperature("31 g/(100 g)") == salt.saturation_temperature(0.31)
    for wrong in (-5.0, "3 bar", "warm", float("nan")):
        with pytest.raises(GranumError):
            salt.solubility(wrong)
    with pytest.raises(GranumError, match="soda"):
        salt.solubility(300.0, "soda")


def test_slopes_go_through_and_a_trace_sees_the_operations() -> None:
    salt = solute("potassium nitrate")
    slope = jax.grad(lambda T: salt.solubility(T))(310.0)
    above, below = (float(salt.solubility(310.0 + d)) for d in (1e-3, -1e-3))
    assert float(slope) == pytest.approx((above - below) / 2e-3, rel=1e-6)
    inner = jax.make_jaxpr(salt.value)(310.0)
    alone = jax.make_jaxpr(itself(salt.value))(310.0)
    assert str(inner) == str(alone)


def test_where_a_number_is_missing_the_function_speaks_for_itself() -> None:
    turns: list[Any] = []

    @at_once()
    def root(x: Any) -> Any:
        turns.append(x)
        return jnp.sqrt(x)

    assert root(4.0) == 2.0
    assert root(9.0) == 3.0
    assert len(turns) == 1  # the second time nothing is traced
    assert np.isnan(root(-1.0))
    assert turns[-1] == -1.0


def test_steps_of_a_note_are_written_down_one_by_one() -> None:
    @at_once()
    def fall(diameter: Any) -> Any:
        return 2.0 * terminal_velocity(
            particle_diameter=diameter, particle_density=2650.0, fluid_density=1000.0, dynamic_viscosity=1e-3
        )

    with record_steps() as steps:
        found = fall(1e-4)
    assert [step.key for step in steps] == ["particles.terminal_velocity"]
    assert found == pytest.approx(2.0 * steps[0].value)
