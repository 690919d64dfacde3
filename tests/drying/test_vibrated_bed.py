"""Vibrated fluidized-bed dryer: transport by throw and weir, plug flow, balances, power and gas."""

from __future__ import annotations

import jax.numpy as jnp
import pytest
from tests.sharing.streams import air, wet

import granum as gr
from granum import drying
from granum.drying.equipment.vibrated_bed import VibratedBedDryer
from granum.drying.gas_solid.kinetics import SurfaceKinetics
from granum.streams.audit import closure
from granum.streams.from_materials import mixture_of

SALT = mixture_of(["water"], ["sodium chloride"], ["dry air", "water"], [5e-4, 9e-4])
FEED, GAS = wet(SALT, 2.0, 0.03, 298.0), air(SALT, 3.0, 0.008, 413.0)
KINETICS = SurfaceKinetics(critical_moisture=0.02)


def bed(weir: float = 0.1, frequency: float = 12.0, feed=FEED, gas=GAS):
    """As arrays, so that all share what is compiled."""
    unit = VibratedBedDryer(
        6.0, 1.2, KINETICS, jnp.asarray(3e-3), jnp.asarray(frequency), weir_height=jnp.asarray(weir), cells=3
    )
    return unit.operate(feed=feed, gas=gas)


def checked(made, words: str):
    (found,) = [c for c in made.checks if words in c.name]
    return found


@pytest.mark.long
def test_the_weir_keeps_the_solid_or_the_throw_carries_it() -> None:
    bulk = 0.55 * float(FEED.solid_density)
    kept = bed(0.1).figures
    assert float(kept.bed_depth) == pytest.approx(0.1)
    assert float(kept.residence_time) == pytest.approx(0.1 * 7.2 * bulk / 2.0)
    thrown = bed(1e-3).figures
    speed = 0.75 * float(drying.vibration_throw(3e-3, 12.0, "60 degree").throw_velocity)
    assert float(thrown.residence_time) == pytest.approx(6.0 / speed)
    assert float(thrown.bed_depth) == pytest.approx(2.0 / (bulk * 1.2 * speed))
    assert float(thrown.moisture_dry_basis) > float(kept.moisture_dry_basis)


def test_nothing_is_lost_and_tanks_dry_one_after_another() -> None:
    made = bed()
    out, found = made.outlets, made.figures
    lost = closure([FEED, GAS], [out.product, out.exhaust])
    assert max(float(lost.mass), float(lost.energy)) < 1e-9
    steps = made.inside.profile.moisture[:, 0]
    assert 0.03 > steps[0] > steps[1] > steps[2]
    assert float(found.moisture_dry_basis) == pytest.approx(float(steps[2]))


def test_gas_and_drive_by_hand() -> None:
    """The gas of the settled bed lifts no more than its weight; landings cost the power of the throw."""
    found = bed().figures
    weight = 0.1 * 0.55 * float(FEED.solid_density) * 9.80665
    assert float(found.superficial_velocity) > float(found.minimum_fluidization_velocity)
    assert float(found.pressure_drop) == pytest.approx(1.3 * weight, rel=1e-6)
    throw = drying.vibration_throw(3e-3, 12.0, "60 degree")
    moist = float(found.solid_holdup) * 1.03
    assert float(found.shaft_power) == pytest.approx(moist * float(throw.vibration_power))
    slow = bed(gas=GAS.part(gas=0.15)).figures
    assert float(slow.pressure_drop) < 0.7 * 1.3 * weight


def test_what_is_not_thrown_or_too_deep_is_told() -> None:
    assert all(c.ok for c in bed().checks), [c.name for c in bed().checks if not c.ok]
    assert not checked(bed(frequency=7.0), "throw number").ok
    assert not checked(bed(weir=0.5), "depth of the bed").ok
    still = bed(frequency=7.0, gas=GAS.part(gas=0.15))
    assert not checked(still, "minimum that mixes").ok


@pytest.mark.long
def test_sized_by_its_weir() -> None:
    unit = VibratedBedDryer.size(5e-4, FEED, GAS, 0.45, KINETICS, 1.0, cells=3)
    made = unit.operate(feed=FEED, gas=GAS)
    assert float(made.figures.moisture_dry_basis) == pytest.approx(5e-4, rel=1e-6)
    assert float(made.figures.superficial_velocity) == pytest.approx(0.45)
    assert float(made.figures.bed_depth) == pytest.approx(float(unit.weir_height))
    slow = VibratedBedDryer.size(0.005, FEED, GAS, 0.45, KINETICS, 6.0, cells=3)
    assert float(slow.weir_height) < 0.002
    assert float(slow(FEED, GAS).product.moisture_dry_basis) < 0.005


def test_salt_is_dried_and_cooled_for_its_bags() -> None:
    """The example: every check of both floors, the heat of the air that cools, closure of the line."""
    run = gr.read("examples/dryers/vibrated-bed.toml").solve()
    for unit in run.units.values():
        assert all(c.ok for c in unit.checks), [c.name for c in unit.checks if not c.ok]
    assert max(run.audit["mass_closure"], run.audit["energy_closure"]) < 1e-9
    product, dry, air, warm = (run.streams[n] for n in ("product", "dry_salt", "cold_air", "warmed_air"))
    assert float(dry.moisture_dry_basis) < 3e-3
    assert float(product.temperature) < 313.15
    lost = 12e3 * 0.87 * float(dry.temperature - product.temperature)  # kJ/h of the salt
    gained = 11e3 * 1.015 * float(warm.temperature - air.temperature)
    evaporated = 3600.0 * float(dry.liquid_flow) * 2440.0
    assert lost == pytest.approx(gained + evaporated, rel=0.08)
