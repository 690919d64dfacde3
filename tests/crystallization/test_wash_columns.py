"""Wash columns: against the equation of dispersion, a bed's balance and what a maker of such columns sees."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import jax.numpy as jnp
import numpy as np
import pytest
from scipy.integrate import solve_ivp
from tests.sharing.places import EXAMPLES

import granum as gr
from granum.core.errors import CaseError
from granum.core.flags import collect
from granum.crystallization.equipment.suspension_melt import SuspensionMeltCrystallizer
from granum.crystallization.formulas.melt import freezing_temperature_ideal
from granum.crystallization.formulas.wash_columns import impurity_ratio_wash_column, wash_front
from granum.porous.displacement import axial_dispersion
from granum.streams.from_materials import mixture_of
from granum.streams.stream import empty

ACID = mixture_of(["acetic acid", "water"], [], [], [1e-5, 1e-4, 1e-3])
FEED = empty(ACID, 298.15).replace(liquid=jnp.array([0.97, 0.03]))


def column(**changes: Any) -> SuspensionMeltCrystallizer:
    fields: dict[str, Any] = {
        "melting_temperature": 289.75,
        "temperature_crystallizer": 277.15,
        "heat_of_fusion": 195e3,
    }
    fields |= {"frozen_fraction": 0.5, "dynamic_viscosity": 1.2e-3, "crystal_density": 1266.0}
    return SuspensionMeltCrystallizer(**(fields | changes))


@pytest.mark.parametrize(("reflux", "number"), [(0.05, 100.0), (-0.1, 30.0), (1e-12, 40.0), (0.5, 3.0)])
def test_the_washed_bed_is_that_of_the_dispersion_equation(reflux, number):
    """Net flux of impurity, from the product downwards: c' = −N (x + R c), with c = x in the melt above."""
    down = solve_ivp(lambda z, c: number * (1.0 + reflux * c), (0.0, 1.0), [1.0], rtol=1e-11, atol=1e-12)
    assert impurity_ratio_wash_column(reflux, number) == pytest.approx(1.0 / down.y[0, -1], rel=1e-8)


@pytest.mark.parametrize(("reflux", "number", "carried"), [(0.05, 60.0, 0.01), (-0.1, 30.0, 0.2)])
def test_what_crystals_carry_is_a_source_in_the_same_equation(reflux, number, carried):
    """c' = −N (x − s + R c): linear in the product's x, so that two runs give the one that fits the front."""

    def front(x):
        bed = solve_ivp(
            lambda z, c: number * (x - carried + reflux * c), (0.0, 1.0), [x], rtol=1e-10, atol=1e-13
        )
        return bed.y[0, -1]

    fits = (1.0 - front(0.0)) / (front(1.0) - front(0.0))
    assert impurity_ratio_wash_column(reflux, number, carried) == pytest.approx(fits, rel=1e-6)
    assert impurity_ratio_wash_column(0.05, 1e5, 0.01) == pytest.approx(0.01 / 1.05, rel=1e-9)


def test_more_wash_never_leaves_more_impurity():
    """Inclusions had gone into the product whole, however much of it returned as wash."""
    left = [
        float(column(wash_ratio=w, inclusion_fraction=0.01).operate(feed=FEED).figures.impurity_ratio_washed)
        for w in (0.9, 1.05, 1.5, 3.0)
    ]
    assert np.all(np.diff(left) <= 1e-12)
    assert left[0] < 0.01


def test_random_beds_let_less_through_with_more_wash_and_more_height():
    """Between nothing and all that comes, for beds from a grain to kilometers deep."""
    rng = np.random.default_rng(3)
    reflux, number = rng.uniform(-0.9, 3.0, 200), 10.0 ** rng.uniform(-2.0, 5.0, 200)
    carried = rng.uniform(0.0, 0.1, 200)
    left = np.asarray(impurity_ratio_wash_column(reflux, number, carried))
    assert np.all((left > 0.0) & (left <= 1.0))
    assert np.all(impurity_ratio_wash_column(reflux + 0.05, number, carried) <= left * (1 + 1e-12))
    assert np.all(impurity_ratio_wash_column(reflux, 1.5 * number, carried) <= left * (1 + 1e-12))


def test_without_enough_wash_mother_liquor_rises():
    assert impurity_ratio_wash_column(-0.2, 1e5) == pytest.approx(0.2, rel=1e-6)
    assert impurity_ratio_wash_column(5.0, 1e5) < 1e-200


def test_ice_ten_degrees_cold_freezes_a_sixteenth():
    """Ice has 2.1 kJ/(kg K) and 334 kJ/kg: 10 K are 6.3 % of its mass, by hand."""
    front = wash_front(10.0, 2100.0, 334e3, 0.4)
    assert front.recrystallized_share == pytest.approx(0.0629, abs=5e-5)
    assert 1.0 - front.void_fraction_washed == pytest.approx(0.6 * 1.0629, abs=5e-5)


def test_the_front_is_a_few_centimeters_deep():
    """GEA Messo PT see it in "a bed depth of just a few centimeters"; here down to a hundredth.

    Crystals of 0.3 mm; ice 2 K cold, washed with a twentieth more than its voids.
    """
    front = wash_front(2.0, 2100.0, 334e3, 0.4)
    r, e = float(front.recrystallized_share), float(front.void_fraction_washed)
    held = (1.0 + r) * e / (1.0 - e) * 1000.0 / 917.0
    bed = 1e-3
    dispersion = axial_dispersion((r + 1.05 * held) * bed / held, 3e-4, 1e-9)
    down = (r + 0.05 * held) * bed / held
    assert 0.01 < np.log(100.0) * dispersion / down < 0.08


def test_balance_of_the_column():
    unit = column()
    made = unit.operate(feed=FEED)
    f = made.figures
    assert float(f.product_mass_flow) == pytest.approx(0.5, rel=1e-12)
    water = f.product_mass_flow * f.impurity_fraction_product + 0.5 * f.impurity_fraction_residue
    assert float(water) == pytest.approx(0.03, rel=1e-12)
    assert float(f.impurity_fraction_product / f.impurity_fraction_residue) == pytest.approx(
        float(f.impurity_ratio_washed), rel=1e-9
    )
    voids = float(f.void_fraction_washed)
    up = float(f.crystal_flow) * (1.0 + float(f.recrystallized_share))
    liquor = up * voids / (1.0 - voids) * float(FEED.liquid_density) / 1266.0
    assert up + liquor - float(f.wash_flow) == pytest.approx(0.5, rel=1e-9)


def test_more_wash_costs_crystals_and_coarse_crystals_let_through():
    ratio, crystals = (
        [float(getattr(column(wash_ratio=w).operate(feed=FEED).figures, name)) for w in (0.0, 0.5, 0.7, 1.0)]
        for name in ("impurity_ratio_washed", "crystal_flow")
    )
    assert ratio == sorted(ratio, reverse=True)
    assert crystals == sorted(crystals)
    fine, coarse = (column(crystal_size=L).operate(feed=FEED).figures for L in (1e-4, 1e-3))
    assert fine.pressure_drop == pytest.approx(100.0 * coarse.pressure_drop, rel=1e-9)
    assert fine.impurity_ratio_washed <= coarse.impurity_ratio_washed


def test_xylenes_freeze_together_where_a_maker_of_wash_columns_says():
    """GEA Messo PT: the eutectic of the xylenes has about 13 % of the para isomer.

    Here with the meta isomer alone: fusion at 286.4 K with 17.1 kJ/mol (para, NIST and CRC) and at 225.3 K
    with 11.6 kJ/mol (meta, recalled).
    """
    M = 0.106165
    x = np.linspace(0.05, 0.3, 2501)
    para = np.asarray(freezing_temperature_ideal(x, 286.4, 17.1e3 / M, M))
    meta = np.asarray(freezing_temperature_ideal(1.0 - x, 225.3, 11.6e3 / M, M))
    eutectic = x[np.argmin(np.abs(para - meta))]
    assert eutectic == pytest.approx(0.13, abs=0.015)


def test_the_crystallizer_is_at_the_freezing_point_of_what_it_leaves():
    unit = column(temperature_crystallizer=None, wash_ratio=0.6)
    made = unit.operate(feed=FEED)
    residue = made.outlets.residue
    moles = np.asarray(residue.liquid) / [s.molar_mass for s in ACID.liquids]
    T = freezing_temperature_ideal(moles[0] / moles.sum(), 289.75, 195e3, ACID.liquids[0].molar_mass)
    assert float(residue.temperature) == pytest.approx(float(T), abs=1e-6)
    given = column(temperature_crystallizer=float(residue.temperature), wash_ratio=0.6).operate(feed=FEED)
    assert float(given.figures.impurity_ratio_washed) == pytest.approx(
        float(made.figures.impurity_ratio_washed), rel=1e-6
    )
    pure = empty(ACID, 298.15).replace(liquid=jnp.array([1.0, 0.0]))
    assert float(unit.operate(feed=pure).outlets.residue.temperature) == pytest.approx(289.75, abs=1e-5)


def test_the_line_makes_para_xylene_to_specification():
    """Para-xylene of commerce has 99.7 % at least (recalled)."""
    run = gr.read(EXAMPLES / "wash-column" / "line.toml").solve()
    assert max(run.audit["mass_closure"], run.audit["energy_closure"]) < 1e-9
    assert all(check.ok for unit in run.units.values() for check in unit.checks)
    assert run.units["crystallizer"].values.impurity_fraction_product < 0.003


def test_a_melt_of_unknown_molar_mass_asks_for_a_temperature():
    bare = replace(ACID, liquids=tuple(replace(s, molar_mass=float("nan")) for s in ACID.liquids))
    with pytest.raises(CaseError, match="molar mass of 'acetic acid', 'water'"):
        column(temperature_crystallizer=None)(empty(bare, 298.15).replace(liquid=FEED.liquid))


@pytest.mark.parametrize(
    ("changes", "word"),
    [
        ({"temperature_crystallizer": 290.0}, "not colder"),
        ({"void_fraction": 0.05}, "shuts the bed"),
        ({"frozen_fraction": 0.98}, "purer feed"),
    ],
)
def test_what_cannot_be_is_said(changes, word):
    with collect() as records:
        column(**changes)(FEED)
    assert any(record.reason and word in record.reason for record in records)
