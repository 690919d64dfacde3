"""Coils of a fluidized-bed dryer: their area from steam, bed and coefficient, and the room for them."""

from __future__ import annotations

import jax
import jax.numpy as jnp
import pytest
from tests.sharing.streams import air, wet

from granum.drying.equipment.fluid_bed import FluidBedDryer
from granum.drying.gas_solid.kinetics import SurfaceKinetics
from granum.streams.from_materials import mixture_of

GRAINS = mixture_of(["water"], ["starch"], ["dry air", "water"], [4e-4, 6e-4])
FEED, GAS = wet(GRAINS, 0.3, 0.2, 298.0), air(GRAINS, 2.0, 0.01, 400.0)


def bed(duty: float, **more):
    kinetics = SurfaceKinetics(critical_moisture=0.05)
    unit = FluidBedDryer(3.0, 800.0, kinetics, coil_duty=jnp.asarray(duty), **more)
    return unit.operate(feed=FEED, gas=GAS)


def checked(made, words: str):
    (found,) = [c for c in made.checks if words in c.name]
    return found


@pytest.mark.parametrize("cells", [pytest.param(1, marks=pytest.mark.long), 3])
def test_coils_give_their_heat_at_the_difference_of_temperatures(cells: int) -> None:
    """Steam of 4 bar is at 143.6 °C (steam tables); Zabrodsky by hand; the area lies between those that the
    hottest and the coldest place ask for.
    """
    made = bed(5e4, cells=cells)
    size, density = 5e-4, FEED.solid_density
    by_hand = 0.7 * 35.8 * density**0.2 * GAS.gas_conductivity**0.6 * size**-0.36
    found = made.figures
    assert found.heat_transfer_coefficient_coil == pytest.approx(float(by_hand), rel=0.02)
    assert 150.0 < found.heat_transfer_coefficient_coil < 400.0  # of beds of coarse grains
    warmer = 416.75 - made.inside.profile.gas_temperature
    most, least = (5e4 / (found.heat_transfer_coefficient_coil * d) for d in (warmer.min(), warmer.max()))
    assert float(least) * 0.999 <= float(found.area_coil) <= float(most) * 1.001


@pytest.mark.long
def test_too_much_heat_finds_no_room_and_cold_steam_is_told() -> None:
    assert checked(bed(5e4), "area of the coils").ok
    assert checked(bed(5e4), "steam in the coils").ok
    assert not checked(bed(3e5, pressure_steam=1.1e5), "area of the coils").ok
    cold = bed(2e5, pressure_steam=2e4)
    assert not checked(cold, "steam in the coils").ok
    assert jnp.isfinite(cold.figures.area_coil)


def test_a_bed_without_coils_has_none() -> None:
    made = FluidBedDryer(3.0, 800.0, SurfaceKinetics(critical_moisture=0.05)).operate(feed=FEED, gas=GAS)
    assert made.figures.area_coil == 0.0
    assert not [c for c in made.checks if "coils" in c.name and c.told]


@pytest.mark.parametrize("cells", [pytest.param(1, marks=pytest.mark.long), 3])
def test_an_empty_feed_has_slopes(cells: int) -> None:
    """What a line starts with: nothing leaves, and as it begins to come, a bed without fines sends all of it
    on as product.
    """
    unit = FluidBedDryer(3.0, 800.0, SurfaceKinetics(critical_moisture=0.05), cells=cells, entrainment=True)

    def left(share):
        made = unit.operate(feed=FEED.part(solid=share, liquid=share), gas=GAS).outlets
        return (
            made.product.solid_flow,
            made.exhaust.gas_flow,
            made.exhaust.temperature,
            made.product.liquid_flow,
        )

    values, slopes = jax.jvp(left, (jnp.zeros(()),), (jnp.ones(()),))
    assert values[0] == 0.0
    assert jnp.all(jnp.isfinite(jnp.stack([*values, *slopes])))
    assert slopes[0] == pytest.approx(float(FEED.solid_flow), rel=1e-6)
