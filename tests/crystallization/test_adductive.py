"""The adductive crystallizer: by hand, its limits, balances of random settings, what it refuses."""

from __future__ import annotations

from math import exp

import jax.numpy as jnp
import numpy as np
import pytest

from granum.core.errors import CaseError, InputError
from granum.core.flags import collect
from granum.crystallization.equipment.adductive import AdductiveCrystallizer
from granum.streams.audit import closure
from granum.streams.from_materials import mixture_of
from granum.streams.stream import empty

OILS = mixture_of(["heptane", "toluene", "cyclohexane"], [], [], [1e-5, 1e-3])
M = np.array([0.1002, 0.09214, 0.08416])  # kg/mol
R_GAS = 8.314462618


def fed(*liquid, temperature=298.15):
    return empty(OILS, temperature).replace(liquid=jnp.array(liquid))


def unit(temperature=273.15, decomposition=318.15, heat=3e4, **more):
    return AdductiveCrystallizer(temperature, decomposition, heat, 6.0, **more)


def test_by_hand():
    """A lever rule in moles: adduct is all substance, the liquor left holds x_r of it."""
    feed = fed(0.4, 0.6, 0.0)
    made = unit(liquor_per_crystals=0.0).operate(feed=feed)
    left = exp(-3e4 / R_GAS * (1 / 273.15 - 1 / 318.15))
    n = np.array([0.4, 0.6, 0.0]) / M
    taken = (n[0] - left * n.sum()) / (1.0 - left)
    assert float(made.figures.mole_fraction_left) == pytest.approx(left, rel=1e-9)
    assert float(made.outlets.product.liquid[0]) == pytest.approx(taken * M[0], rel=2e-4)
    assert float(made.figures.mass_flow_agent) == pytest.approx(6.0 * 0.0600553 * taken, rel=2e-4)
    assert float(made.figures.heat_duty_adduct) == pytest.approx(3e4 * taken, rel=2e-4)
    assert float(made.figures.impurity_fraction_product) == 0.0
    rest = np.asarray(made.outlets.residue.liquid) / M
    assert rest[0] / rest.sum() == pytest.approx(left, rel=2e-4)


def test_what_adheres_dirties_the_product_and_cold_takes_more():
    feed = fed(0.4, 0.4, 0.2)
    dirt = [
        float(unit(liquor_per_crystals=r).operate(feed=feed).figures.impurity_fraction_product)
        for r in (0.0, 0.05, 0.1, 0.2)
    ]
    assert dirt == sorted(dirt)
    assert dirt[0] == 0.0 < dirt[1]
    taken = [
        float(unit(T, liquor_per_crystals=0.0).operate(feed=feed).figures.product_recovery)
        for T in (260.0, 270.0, 280.0, 290.0)
    ]
    assert taken == sorted(taken, reverse=True)
    assert taken[0] < 1.0


def test_nothing_forms_in_the_warm_and_that_is_told():
    made = unit(315.0).operate(feed=fed(0.1, 0.9, 0.0))
    assert float(made.outlets.product.liquid_flow) == 0.0
    assert [check.ok for check in made.checks] == [False]
    assert [check.ok for check in unit().operate(feed=fed(0.4, 0.6, 0.0)).checks] == [True]


def test_random_settings_close():
    rng = np.random.default_rng(4)
    for _trial in range(100):
        feed = fed(*rng.uniform(0.0, 2.0, 3), temperature=rng.uniform(270.0, 330.0))
        made = AdductiveCrystallizer(
            rng.uniform(255.0, 320.0),
            rng.uniform(300.0, 380.0),
            10 ** rng.uniform(4.0, 5.0),
            rng.uniform(1.0, 15.0),
            agent_activity=rng.uniform(0.5, 1.0),
            liquor_per_crystals=rng.uniform(0.0, 0.05),
        ).operate(feed=feed)
        product, residue = made.outlets.product, made.outlets.residue
        gap = closure([feed], [product, residue])
        assert float(gap.mass) < 1e-12
        assert float(jnp.max(jnp.abs(gap.by_component))) < 1e-12
        assert min(float(jnp.min(product.liquid)), float(jnp.min(residue.liquid))) >= -1e-15
        assert 0.0 <= float(made.figures.product_recovery) <= 1.0


def test_what_cannot_be_is_said():
    with pytest.raises(InputError, match="hexane"):
        unit(substance="hexane").operate(feed=fed(1.0, 1.0, 0.0))
    bare = empty(mixture_of([], ["silica sand"], ["dry air"], [1e-5, 1e-3]), 298.15)
    with pytest.raises(CaseError, match="no liquid"):
        unit().operate(feed=bare)
    with collect() as records:
        unit(liquor_per_crystals=5.0).operate(feed=fed(0.9, 0.1, 0.0))
    assert any("adhere" in str(record) for record in records)
    nothing = unit().operate(feed=fed(0.0, 0.0, 0.0))
    assert float(nothing.outlets.product.liquid_flow) == 0.0
    assert np.isfinite(float(nothing.figures.product_recovery))
