"""Dryers in cells fed with crystals wet with their mother liquor, and with a solution: what was dissolved
stays as crystal.
"""

from __future__ import annotations

import jax.numpy as jnp
import pytest

from granum.core.errors import GranumError
from granum.core.flags import collect
from granum.core.notices import describe
from granum.drying.equipment.atomizers import GivenDrops
from granum.drying.equipment.belt import BeltDryer
from granum.drying.equipment.convective import ConvectiveDryer
from granum.drying.equipment.rotary import RotaryDryer
from granum.drying.equipment.spray import SprayDryer
from granum.drying.equipment.well_mixed import WellMixedDryer
from granum.drying.gas_solid.kinetics import SurfaceKinetics
from granum.drying.wet_surface import boiled, evaporated
from granum.streams.audit import closure
from granum.streams.from_materials import mixture_of
from granum.streams.stream import Stream, empty

SALT = mixture_of(
    ["water", "potassium nitrate"], ["quartz", "potassium nitrate"], ["dry air", "water"], [1e-4, 3e-4, 9e-4]
)
KINETICS = SurfaceKinetics(critical_moisture=0.02)
DISSOLVED = 0.37  # per kg of water, potassium nitrate at 25 °C
DRYERS = {
    "belt": (BeltDryer(0.2, 0.05, 1000.0, KINETICS, layers=5, steps=20), 0.5),
    "rotary": (RotaryDryer(8.0, 1.5, KINETICS, cells=6), 1.0),
}


def cake(crystals: float, water: float) -> Stream:
    solid = jnp.array([[0.0, 0.0], [0.4, 0.6]]) * crystals
    return empty(SALT, 298.15).replace(solid=solid, liquid=water * jnp.array([1.0, DISSOLVED]))


@pytest.mark.parametrize("name", ["belt", pytest.param("rotary", marks=pytest.mark.long)])
def test_what_was_dissolved_stays_on_the_crystals(name: str) -> None:
    dryer, flow = DRYERS[name]
    feed, gas = cake(0.3, 0.02), empty(SALT, 400.0).replace(gas=flow * jnp.array([1.0, 0.01]))
    with collect() as records:
        out = dryer(feed, gas)
    assert not describe(records)
    closed = closure([feed, gas], [out.product, out.exhaust], out.heat_duty)
    assert float(closed.mass) < 1e-12
    assert float(closed.energy) < 1e-12
    water, salt = out.product.liquid
    assert 0.0 < float(water) < 0.015
    # the liquor left is still the saturated one
    assert float(salt / water) == pytest.approx(DISSOLVED, rel=1e-12)
    assert float(jnp.sum(out.product.solid[1]) + salt) == pytest.approx(0.3 + 0.02 * DISSOLVED, rel=1e-12)


@pytest.mark.long
def test_a_solution_is_spray_dried_to_powder() -> None:
    """No solid enters; the drops' classes take the crystals."""
    dryer = SprayDryer(12.0, 2.0, GivenDrops("100 um"), KINETICS, dry_density=1500.0, cells=20)
    feed, gas = cake(0.0, 0.1), empty(SALT, 450.0).replace(gas=jnp.array([4.0, 0.04]))
    out = dryer(feed, gas)
    closed = closure([feed, gas], [out.product, out.exhaust], out.heat_duty)
    assert float(closed.mass) < 1e-12
    assert float(closed.energy) < 1e-12
    solid = float(jnp.sum(out.product.solid))
    assert 0.9 * 0.1 * DISSOLVED < solid <= 0.1 * DISSOLVED * (1.0 + 1e-12)


def test_a_solute_without_crystals_is_named() -> None:
    mixture = mixture_of(["water", "potassium nitrate"], ["quartz"], ["dry air", "water"], [1e-4, 1e-3])
    feed = empty(mixture).replace(solid=jnp.array([[1.0]]), liquid=jnp.array([0.1, 0.03]))
    with pytest.raises(GranumError, match="potassium nitrate"):
        DRYERS["rotary"][0](feed, empty(mixture, 400.0).replace(gas=jnp.array([1.0, 0.01])))


EPSOM = mixture_of(
    ["water", "magnesium sulfate"],
    ["quartz", "magnesium sulfate heptahydrate"],
    ["dry air", "water"],
    [1e-4, 3e-4, 9e-4],
)
SHARE = 120.366 / 246.474  # of the heptahydrate that is magnesium sulfate, by atomic masses


@pytest.mark.parametrize("name", ["rotary", pytest.param("belt", marks=pytest.mark.long)])
def test_a_hydrate_keeps_its_water_of_crystallization(name: str) -> None:
    """Of 20 g of water with 36 % of salt on it, 7.6 g go into crystals and cannot leave."""
    dryer, flow = DRYERS[name]
    solid = jnp.array([[0.0, 0.0], [0.4, 0.6]]) * 0.3
    feed = empty(EPSOM, 298.15).replace(solid=solid, liquid=0.02 * jnp.array([1.0, 0.36]))
    gas = empty(EPSOM, 320.0).replace(gas=flow * jnp.array([1.0, 0.008]))
    made = dryer.operate(feed=feed, gas=gas)
    product, exhaust, heat_duty = made.outlets
    closed = closure([feed, gas], [product, exhaust], heat_duty)
    assert float(closed.mass) < 1e-12
    assert float(closed.energy) < 1e-12
    water, salt = map(float, product.liquid)
    # the liquor left is still the saturated one, and what it lost is hydrate
    assert salt / water == pytest.approx(0.36, rel=1e-9)
    grown = float(jnp.sum(product.solid[1])) - 0.3
    assert grown == pytest.approx((0.02 * 0.36 - salt) / SHARE, rel=1e-4)
    evaporated, fog = float(exhaust.gas[1] - gas.gas[1]), float(exhaust.liquid[0])
    assert evaporated + fog == pytest.approx(0.02 - water - grown * (1.0 - SHARE), rel=1e-4)
    assert fog < 0.01 * evaporated
    assert float(made.figures.evaporation_rate) == pytest.approx(evaporated + fog, rel=1e-9)
    assert 0.0 < evaporated < 0.02 - 0.02 * 0.36 * (1.0 - SHARE) / SHARE


def test_liquor_of_a_hydrate_dries_in_a_mixed_bed_and_by_balance() -> None:
    """All 20 g of water but the 7.6 g that 7.2 g of salt bind leave; with a heat loss, dry crystals too."""
    feed = empty(EPSOM, 298.15).replace(
        solid=jnp.array([[0.0, 0.0], [0.4, 0.6]]) * 0.3, liquid=0.02 * jnp.array([1.0, 0.36])
    )
    gas = empty(EPSOM, 330.0).replace(gas=3.0 * jnp.array([1.0, 0.008]))
    bound = 0.02 * 0.36 * (1.0 - SHARE) / SHARE
    for dryer in (
        WellMixedDryer(600.0, 0.5, 500.0),
        ConvectiveDryer(moisture_outlet=0.0, temperature_inlet=330.0),
    ):
        made = dryer.operate(feed=feed, gas=gas)
        product, exhaust = made.outlets[:2]
        powers = sum(x for x in made.outlets if not isinstance(x, Stream))
        closed = closure([feed, gas], [x for x in made.outlets if isinstance(x, Stream)], powers)
        assert float(closed.mass) < 1e-12
        assert float(closed.energy) < 1e-9
        left = float(product.liquid[0]) / 0.02
        gone = (1.0 - left) * (0.02 - bound)
        assert float(exhaust.gas[1] - gas.gas[1]) == pytest.approx(gone, rel=1e-4)
        assert float(made.figures.evaporation_rate) == pytest.approx(gone, rel=1e-4)
        grown = float(jnp.sum(product.solid[1])) - 0.3
        assert grown == pytest.approx((1.0 - left) * 0.02 * 0.36 / SHARE, rel=1e-4)
    dry = feed.replace(liquid=0.0 * feed.liquid)
    out = WellMixedDryer(600.0, 0.5, 500.0)(dry, gas)
    assert float(closure([dry, gas], [out.product, out.exhaust], out.heat_duty).energy) < 1e-9


@pytest.mark.parametrize("moisture", [0.0, 0.01])
def test_boiled_liquor_leaves_its_hydrate(moisture: float) -> None:
    """Contact dryers part a cake so; what little water 0.3 g of it leaves cannot be bound twice."""
    for water in (0.02, 0.002):
        feed = empty(EPSOM, 298.15).replace(
            solid=jnp.array([[0.0, 0.0], [0.4, 0.6]]) * 0.3, liquid=jnp.array([water, 0.0072])
        )
        product, vapor = boiled(feed, moisture, 350.0, 373.0, 1e5)
        parts = product.components + vapor.components - feed.components
        assert float(jnp.max(jnp.abs(parts))) < 1e-15
        assert float(product.liquid[0]) == pytest.approx(min(moisture * 0.3, water), abs=1e-15)
        assert float(evaporated(feed, product)) == pytest.approx(float(vapor.gas[1]), abs=1e-15)
        assert (float(vapor.gas[1]) > 0.0) == (water == 0.02)
