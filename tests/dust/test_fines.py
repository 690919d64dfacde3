"""Fines that a gas takes from a solid: rules of thumb of others, limits, every size class accounted for;
fines that come back; dust against its explosion limit.
"""

from __future__ import annotations

import jax.numpy as jnp
import numpy as np
import pytest

import granum as gr
from granum.core.errors import InputError
from granum.drying.equipment.atomizers import GivenDrops
from granum.drying.equipment.flash import FlashDryer
from granum.drying.equipment.rotary import RotaryDryer
from granum.drying.equipment.silo import SiloDryer
from granum.drying.equipment.spray import SprayDryer
from granum.drying.gas_solid.airborne import dried_on
from granum.drying.gas_solid.kinetics import SurfaceKinetics
from granum.drying.gas_solid.layer import misty
from granum.drying.isotherms.adsorption import Gab
from granum.dust.equipment.hood import ExtractionHood
from granum.materials.library import session
from granum.streams import fines
from granum.streams.atmosphere import explosible
from granum.streams.dusts import dust, dusts
from granum.streams.equilibrium import HumidMixture
from granum.streams.from_materials import mixture_of
from granum.streams.stream import Stream, empty, median_size

EDGES = list(np.geomspace(5e-6, 2e-3, 9))
MADE = mixture_of(["water"], ["starch", "calcite"], ["dry air", "water"], EDGES)
KINETICS = SurfaceKinetics(0.1)


def solid(mixture=MADE, flow: float = 1.0, moisture: float = 0.2) -> Stream:
    """Both solids over all classes."""
    each = np.full((len(mixture.solids), len(mixture.sizes)), 1.0)
    return empty(mixture, 320.0).replace(
        solid=jnp.asarray(each / each.sum() * flow), liquid=jnp.asarray([moisture * flow])
    )


def air(flow: float, temperature: float = 350.0, mixture=MADE, moist: float = 0.01) -> Stream:
    """Of a flow of dry gas, kg/s."""
    gas = [flow * moist if g.name == "water" else flow for g in mixture.gases]
    return empty(mixture, temperature).replace(gas=jnp.asarray(gas))


def balanced(unit, **inlets) -> tuple:
    """Outlets of a unit after a look at every species and size class."""
    made = unit.operate(**inlets)
    before = sum(np.asarray(s.solid) for s in inlets.values())
    after = np.asarray(made.outlets.product.solid) + np.asarray(made.outlets.exhaust.solid)
    np.testing.assert_allclose(after, before, rtol=1e-9, atol=1e-15)
    return made


def test_perrys_safe_gas_lifts_no_coarse_sand() -> None:
    """Perry, § 12 (recalled): 5000 kg/(h m²) of air can be used safely with 35-mesh solids, 0.42 mm; dust of
    0.1 mm flies at that speed.
    """
    one = mixture_of(
        ["water"], ["quartz"], ["dry air", "water"], [1e-4 * 0.99, 1e-4 * 1.01, 4.15e-4, 4.25e-4]
    )
    gas = air(5000.0 / 3600.0 / 1.01, 340.0, one)
    fine, _between, coarse = np.asarray(fines.lifted(fines.fall(solid(one), gas), gas, 1.0))[0]
    assert fine
    assert not coarse


def test_share_held_by_mixed_gas() -> None:
    """By hand: a floor on which as much would settle as flows keeps 1/e of it; showered evenly along that
    floor, 1 − 1/e goes.
    """
    gas = air(2.0)
    falling = jnp.full((1, 1), gas.gas_volume_flow / 10.0)
    assert float(fines.held(falling, gas, 10.0)[0, 0]) == pytest.approx(np.exp(-1.0))
    assert float(fines.showered(falling, gas, 10.0, 1.0)[0, 0]) == pytest.approx(1.0 - np.exp(-1.0))
    assert float(fines.showered(1e-12 * falling, gas, 10.0, 1.0)[0, 0]) == pytest.approx(1.0)
    assert float(fines.showered(falling, gas, 10.0, 10.1)[0, 0]) == 0.0


def test_the_finest_go_first() -> None:
    feed = solid(flow=8.0)  # one kilogram a second in each class
    share = np.asarray(fines.finest(feed, 0.3))
    np.testing.assert_allclose(share, [[1.0, 1.0, 0.4, 0.0, 0.0, 0.0, 0.0, 0.0]] * 2, atol=1e-12)
    rest, dust = fines.parted(feed, jnp.asarray(share))
    gas = air(1.0) + dust
    assert float(gas.solid_flow) == pytest.approx(2.4)
    assert float(gas.liquid_flow) == pytest.approx(0.3 * float(feed.liquid_flow))
    assert float(rest.moisture_dry_basis) == pytest.approx(float(feed.moisture_dry_basis))


def test_a_rising_duct_carries_its_powder_to_the_collectors() -> None:
    duct = FlashDryer(15.0, 0.5, KINETICS, entrainment=True, cells=20)
    made = balanced(duct, feed=solid(flow=0.3), gas=air(3.0, 420.0))
    assert float(made.outlets.product.solid_flow) == 0.0
    plain = FlashDryer(15.0, 0.5, KINETICS, cells=20).operate(feed=solid(flow=0.3), gas=air(3.0, 420.0))
    for name in ("moisture_dry_basis", "evaporation_rate"):
        assert float(getattr(made.figures, name)) == pytest.approx(float(getattr(plain.figures, name)))


def test_a_drum_loses_fines_and_a_measured_share() -> None:
    drum = RotaryDryer(10.0, 1.6, KINETICS, entrainment=True, cells=10)
    feed, gas = solid(flow=1.0), air(4.0, 420.0)
    gone = np.asarray(balanced(drum, feed=feed, gas=gas).outlets.exhaust.solid_by_size)
    assert (np.diff(gone) <= 1e-12).all()
    assert gone[0] > 0.9 * float(feed.solid_by_size[0])
    assert gone[-1] == 0.0
    measured = RotaryDryer(10.0, 1.6, KINETICS, entrainment=True, dusting_fraction=0.023, cells=10)
    lost = balanced(measured, feed=feed, gas=gas).outlets.exhaust.solid_flow
    assert float(lost) == pytest.approx(0.023)


def test_grain_dust_is_that_of_the_agency() -> None:
    """AP-42, table 9.9.1-1 (recalled): 0.22 lb of dust per short ton of grain dried in a column."""
    column = SiloDryer(10.0, 0.3, 650.0, KINETICS, entrainment=True, layers=5, steps=10)
    made = balanced(column, feed=solid(flow=1.0), gas=air(20.0, 350.0))
    assert float(made.outlets.exhaust.solid_flow) == pytest.approx(0.22 / 2000.0, rel=1e-9)


def test_returned_fines_make_larger_agglomerates() -> None:
    """As much fines as solid in the feed doubles the mass of particles: sizes grow by the root of two."""
    tower = SprayDryer(8.0, 3.0, GivenDrops(1e-4, 50.0), KINETICS, entrainment=True, cells=6)

    def sprayed(classes: int):
        kind = mixture_of(
            ["water"], ["starch"], ["dry air", "water"], list(np.geomspace(5e-6, 2e-3, classes))
        )
        return solid(kind, 0.1, 1.2), air(6.0, 450.0, kind), solid(kind, 0.1, 0.05)

    feed, gas, back = sprayed(61)
    alone, grown = (median_size(tower.atomized(feed, gas, more)) for more in (None, back))
    assert alone
    assert grown
    assert grown / alone == pytest.approx(2.0 ** (1.0 / 3.0), rel=0.01)
    feed, gas, back = sprayed(13)
    made = tower.operate(feed=feed, gas=gas, fines=back)
    out = np.asarray(made.outlets.product.solid_by_species + made.outlets.exhaust.solid_by_species)
    np.testing.assert_allclose(out, np.asarray(feed.solid_by_species + back.solid_by_species), rtol=1e-9)
    gone = sum(float(s.liquid_flow) for s in made.outlets[:2])
    drawn = float(feed.liquid_flow + back.liquid_flow) - gone
    assert float(made.figures.evaporation_rate) == pytest.approx(drawn)


def test_dust_against_its_explosion_limit() -> None:
    """By hand: 30 g/m³ of starch, whose limit is 30 g/m³, counts one, whatever calcite flies along; particles
    beyond half a millimeter do not burn as dust, nor any in nitrogen.
    """
    gas = air(1.0)
    each = np.zeros((2, 8))
    each[:, 2] = 0.03 * float(gas.gas_volume_flow)
    assert float(explosible(gas.replace(solid=jnp.asarray(each)))["explosible"]) == pytest.approx(1.0)
    assert float(explosible(gas.replace(solid=jnp.asarray(each[:, ::-1])))["explosible"]) == pytest.approx(
        1.0
    )
    coarse = np.roll(each, 5, axis=1)
    assert float(explosible(gas.replace(solid=jnp.asarray(coarse)))["explosible"]) == 0.0
    inert = mixture_of(["water"], ["starch", "calcite"], ["nitrogen", "water"], EDGES)
    safe = air(1.0, mixture=inert).replace(solid=jnp.asarray(each))
    assert float(explosible(safe)["explosible"]) == 0.0
    mineral = mixture_of(["water"], ["calcite"], ["dry air", "water"], EDGES)
    assert explosible(air(1.0, mixture=mineral)) == {}


def test_every_dust_of_the_library_stands_in_the_table() -> None:
    library = session()
    named = [library.solid(name).dust for name in library.names("solid") if library.solid(name).dust]
    assert len(named) >= 7
    for name in named:
        assert np.isfinite(dust(name).explosible_concentration)
    for row in dusts().values():
        assert 2e5 < row.explosion_pressure < 2e6
        assert 5e5 < row.deflagration_index < 6e7


def test_a_hood_takes_what_the_air_holds() -> None:
    """By hand: of what falls as fast as the air rises, 1/e; every size class accounted for."""
    feed, drawn = solid(flow=2.0), air(1.2, 293.0)
    made = ExtractionHood(1.0, entrainment=True).operate(feed=feed, air=drawn)
    out = np.asarray(made.outlets.gas.solid + made.outlets.product.solid)
    np.testing.assert_allclose(out, np.asarray(feed.solid), rtol=1e-9)
    speed = float(made.figures.superficial_velocity)
    share = np.asarray(made.outlets.gas.solid / feed.solid)
    np.testing.assert_allclose(share, np.exp(-np.asarray(fines.fall(feed, drawn)) / speed), rtol=1e-6)
    assert (np.diff(share, axis=1) < 0.0).all()
    known = ExtractionHood(1.0, 1e-3).operate(feed=feed, air=drawn).figures
    assert float(known.entrained_share) == pytest.approx(1e-3)
    assert float(known.concentration_outlet) == pytest.approx(2e-3 / float(drawn.gas_volume_flow), rel=1e-3)


def test_dust_data_is_a_card() -> None:
    """Class St 1 ends at 200 bar m/s: starch and sugar are in it, aluminum (St 3) is beyond 300."""
    found = {name: gr.dust.dust_explosibility(name) for name in ("wheat starch", "Sugar", "aluminum")}
    assert [row.deflagration_index > 200e5 for row in found.values()] == [False, False, True]
    with pytest.raises(InputError, match="lactose"):
        gr.dust.dust_explosibility("lactos")


def dried(moisture: float, kinetics, moist: float = 0.01) -> tuple[Stream, Stream, Stream, Stream]:
    """Dust of 40 °C and air of 90 °C before and after they met."""
    dust, gas = solid(flow=0.05, moisture=moisture).replace(temperature=313.15), air(1.0, 363.15, moist=moist)
    return dust, gas, *dried_on(dust, gas, kinetics)


def test_wet_dust_dries_in_hot_gas() -> None:
    """All its water where nothing binds it; water evaporates from 0 °C at 2501 kJ/kg (steam tables), specific
    heats of 1.006 of air, 1.86 of vapor and 1.1 kJ/(kg K) of starch and calcite.
    """
    dust, gas, left, air_after = dried(0.2, KINETICS)
    assert float(left.liquid_flow) == pytest.approx(0.0, abs=1e-9)
    T = float(air_after.temperature) - 273.15
    # each against 0 °C: air and vapor, dust with 10 g/s of water
    given = (90.0 - T) * (1.006 + 0.01 * 1.86) + 0.05 * 1.1 * (40.0 - T)
    assert given == pytest.approx(0.01 * (2501.0 + 1.86 * T - 4.19 * 40.0), rel=0.005)
    before, after = (
        float(dust.enthalpy_flow + gas.enthalpy_flow),
        float(left.enthalpy_flow + air_after.enthalpy_flow),
    )
    assert after == pytest.approx(before, rel=1e-12)
    assert float(left.liquid_flow + air_after.gas[1]) == pytest.approx(
        float(dust.liquid_flow + gas.gas[1]), rel=1e-12
    )


def test_dust_ends_in_equilibrium_with_its_gas_and_never_drinks() -> None:
    isotherm = Gab(0.08, 10.0, 0.8)
    _dust, _gas, left, after = dried(0.2, SurfaceKinetics(0.1, isotherm=isotherm))
    humidity = gr.humid_gas.relative_humidity(
        temperature=float(after.temperature), humidity_ratio=float(after.gas[1] / after.gas[0])
    )
    expected = isotherm.moisture(humidity, float(after.temperature))
    assert float(left.moisture_dry_basis) == pytest.approx(float(expected), rel=1e-3)
    dust, _gas, left, after = dried(1e-4, SurfaceKinetics(0.1, isotherm=isotherm))
    assert float(left.liquid_flow) == pytest.approx(float(dust.liquid_flow), rel=1e-12)
    # nor does gas take more than it holds
    soaked, _gas, left, after = dried(3.0, KINETICS)
    assert 0.0 < float(left.liquid_flow) < float(soaked.liquid_flow)
    assert float(HumidMixture(MADE).relative_humidity(after)) == pytest.approx(0.999, rel=1e-6)


def test_fog_in_the_air_of_a_silo() -> None:
    """What condenses warms the air until it holds the rest: 2.43 MJ per kg against 1.01 kJ/(kg K)."""
    gas = air(1.0, 303.15, moist=1.2 * 0.0272)  # saturated at 30 °C: 27.2 g/kg
    after = misty(gas)
    mist, rise = float(after.liquid_flow), float(after.temperature) - 303.15
    assert rise * (1.006 + 0.03 * 1.86) == pytest.approx(mist * 2430.0, rel=0.03)
    assert float(HumidMixture(MADE).relative_humidity(after)) == pytest.approx(1.0, rel=1e-6)
    assert mist + float(after.gas[1]) == pytest.approx(float(gas.gas[1]), rel=1e-12)
    assert float(after.enthalpy_flow) == pytest.approx(float(gas.enthalpy_flow), rel=1e-12)
    assert float(misty(air(1.0, 303.15, moist=0.9 * 0.0272)).liquid_flow) == 0.0
