"""Random valid options and arguments into every law: a value within the bounds of its own kind, or none."""

from __future__ import annotations

import dataclasses
import inspect
from typing import Any

import jax
import numpy as np
import pytest
from tests.contracts.drawing import SETS, amiss, drawn, ordinary, random_inputs
from tests.sharing.samples import EVERYTHING

from granum.core import bounds
from granum.core.errors import ApplicabilityError, GranumError
from granum.core.flags import OUTSIDE_DOMAIN


def alone(law: Any) -> bool:
    """Whether numbers are all that a law needs: its options and what it is called with."""
    options, called = law.card.parameters, law.card.arguments
    return (
        bool(called)
        and all(p.kind for p in called)
        and {p.name for p in options if p.required} <= {p.name for p in drawn(options)}
    )


LAWS = {k: t for k, t in EVERYTHING.items() if inspect.isclass(t) and t.card.sort == "law" and alone(t)}
# sets of options that each law is built with; the rest of the sets are what it is called with
LAWS_OF_ONE = 5
VALUES = (
    1 / 3
    # at least so many of ordinary sets give one: options of a solubility law, drawn one by one, often leave no  # noqa: E501
    # solvent
)


@pytest.mark.parametrize("key", LAWS)
def test_a_law_gives_values_within_the_bounds_of_its_kind_or_none(key: str) -> None:
    law = LAWS[key]
    count = max(SETS // LAWS_OF_ONE, 1)
    for seed in range(LAWS_OF_ONE):
        options = {
            name: float(values[0]) for name, values in random_inputs(law.card.parameters, 1, seed).items()
        }
        given = random_inputs(law.card.arguments, count, seed)
        try:
            with jax.disable_jit():  # each law is another program
                answer = law(**options)(**given)
        except GranumError:
            continue
        assert not amiss(law.card, answer, np.asarray(OUTSIDE_DOMAIN), given), options


@pytest.mark.parametrize("key", LAWS)
def test_ordinary_options_give_a_law_that_has_values(key: str) -> None:
    law, rng, count = LAWS[key], np.random.default_rng(0), min(SETS, 200)
    # one value for a whole program
    static = {f.name for f in dataclasses.fields(law) if f.metadata.get("static")}
    free = [p for p in law.card.parameters if p.name not in static]
    options, given = (
        {p.name: ordinary(p, rng, count) for p in drawn(group)} for group in (free, law.card.arguments)
    )
    raw = jax.vmap(lambda o, g: law(**o)(**g))(options, given)
    for p, value in bounds.figures(law.card.outputs, raw):
        assert np.mean(bounds.kept_inside(p, value) & np.isfinite(value)) > VALUES, p.name


def test_one_value_outside_the_bounds_of_its_kind_is_refused_and_is_none_in_an_array() -> None:
    """Midilli's curve, a straight line in the end, falls below zero: there it says nothing about moisture."""
    law = EVERYTHING["drying.thin_layer_midilli"](
        model_factor=1.0, rate_constant=1e-3, time_exponent=1.0, time_slope=-1e-5
    )
    assert law(0.0) == 1.0
    with pytest.raises(ApplicabilityError, match=r"= −0\.2 is outside what is possible"):
        law(20_000.0)
    curve = law(np.array([0.0, 20_000.0]))
    assert curve[0] == 1.0
    assert np.isnan(curve[1])
    # inside a program its caller judges
    assert float(jax.jit(law)(20_000.0)) == pytest.approx(-0.2, abs=1e-8)


def test_an_infinite_value_of_a_law_is_none() -> None:
    breakage = EVERYTHING["crystallization.power_breakage"](
        breakage_frequency=1.0, reference_size=1e-9, breakage_exponent=400.0
    )
    assert np.isnan(breakage(1e-3))
