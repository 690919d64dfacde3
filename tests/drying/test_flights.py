"""Flights of a rotary drum: what they hold, and what a drum exchanges that is not full."""

from __future__ import annotations

import jax.numpy as jnp
import numpy as np
import pytest
from tests.sharing.streams import air, wet

import granum as gr
from granum.drying.equipment.rotary import RotaryDryer
from granum.drying.gas_solid.kinetics import SurfaceKinetics
from granum.streams.audit import closure
from granum.streams.from_materials import mixture_of

GRAINS = mixture_of(["water"], ["starch"], ["dry air", "water"], [1e-3, 2e-3])
SLOW = SurfaceKinetics(critical_moisture=0.01)


def drum(**more) -> RotaryDryer:
    return RotaryDryer(8.0, 1.5, SLOW, 0.03, 0.4, cells=15, **more)


def load(share: float):
    return wet(GRAINS, 0.6 * share, 0.15, 298.0), air(GRAINS, 2.0 * share, 0.01, 420.0)


def test_the_section_of_the_solid_is_that_of_its_corners() -> None:
    """Shell, root, edge and tip of the lip, and where the slope from the tip meets the shell; by the shoelace
    formula.
    """
    deep, lip, angle, wide = 0.2, 0.07, np.radians(42.0), 1.9
    x = np.array([0.0, deep, deep, 0.0])
    y = np.array([0.0, 0.0, lip, lip + deep * np.tan(angle)])
    section = 0.5 * abs(np.sum(x * np.roll(y, -1) - y * np.roll(x, -1)))
    found = gr.drying.flight_filling_design(wide, 15, deep, lip, angle)
    assert found == pytest.approx(8.0 * section / (np.pi * wide**2 / 4.0), rel=1e-12)


def test_the_slope_on_a_level_flight_balances_forces_on_a_grain() -> None:
    """A grain on the slope, drawn outward by the turning: along the slope its weight less the pull, against
    friction on what presses.
    """
    mu, wide, turns = 0.75, 3.0, 1.1
    angle = gr.drying.flight_repose_angle(mu, wide, turns)
    weight, pull = 9.80665, 0.5 * wide * turns**2
    along = weight * np.sin(angle) - pull * np.cos(angle)
    pressed = weight * np.cos(angle) + pull * np.sin(angle)
    assert along == pytest.approx(mu * pressed, rel=1e-9)


def test_flights_of_a_usual_make_are_full_at_usual_holdups() -> None:
    """Two and a half to three flights a foot, a twelfth to an eighth of the diameter deep (Perry), with lips
    a quarter as high: 7 to 8 % of the drum is usual (Walas), 3 to 15 % occur.
    """
    wide = np.array([1.2, 1.6, 2.0])
    for flights, depth in ((2.5, 1.0 / 12.0), (3.0, 1.0 / 8.0)):
        found = gr.drying.flight_filling_design(
            wide, flights * wide / 0.3048, depth * wide, 0.25 * depth * wide, 0.7
        )
        assert np.all((found > 0.03) & (found < 0.15))


@pytest.mark.parametrize("way", [pytest.param("co-current", marks=pytest.mark.long), "counter-current"])
def test_half_the_flows_leave_half_full_flights_as_they_are(way: str) -> None:
    """Half of solid and gas, the exchange per kg the same: without the gas in it (exponent zero), the product
    and the exhaust are those of the whole flows where flights are under-full, and drier where they were full.
    """
    wide = {"gas_direction": way, "transfer_exponent": 1e-9, "flight_count": 60.0, "flight_lip": 0.2}
    few = wide | {"flight_count": 4.0, "flight_lip": 0.0}
    dried = {}
    for name, more in (("many", wide), ("few", few)):
        for share in (1.0, 0.5):
            feed, gas = load(share)
            made = drum(**more).operate(feed=feed, gas=gas)
            dried[name, share] = float(made.figures.moisture_dry_basis)
            mass, energy = closure([feed, gas], made.outlets[:2], made.outlets.heat_duty)[:2]
            assert max(mass, energy) < 1e-9
    assert dried["many", 0.5] == pytest.approx(dried["many", 1.0], rel=1e-6)
    assert dried["few", 0.5] < 0.98 * dried["few", 1.0]


def test_an_empty_drum_dries_less_than_its_volume_would() -> None:
    """A drum so steep that it empties itself: the check on its load speaks, and it dries less than one of the
    same time of passage whose flights are small enough to be full.
    """
    feed, gas = load(1.0)
    steep = RotaryDryer(8.0, 1.5, SLOW, 0.08, 1.2, cells=15, flight_count=20.0, flight_lip=0.1)
    made = steep.operate(feed=feed, gas=gas)
    (loaded,) = [c for c in made.checks if "flights are designed" in c.name]
    assert not loaded.ok
    assert loaded.value < 0.2
    full = RotaryDryer(8.0, 1.5, SLOW, 0.08, 1.2, cells=15, flight_count=2.0, flight_depth=0.02)
    other = full.operate(feed=feed, gas=gas)
    assert made.figures.residence_time == pytest.approx(other.figures.residence_time)
    assert made.figures.moisture_dry_basis > 2.0 * other.figures.moisture_dry_basis
    assert jnp.isfinite(made.figures.moisture_dry_basis)


@pytest.mark.parametrize("passes", [2, 3])
@pytest.mark.parametrize("direction", ["co-current", "counter-current"])
def test_a_drum_of_several_passes_is_the_drum_unrolled(passes: int, direction) -> None:
    """Tubes of equal sections one in another: the same gas velocity and way, more steel to turn; water and
    heat close.
    """
    feed, gas = load(1.0)
    folded = RotaryDryer(3.0, 1.5, SLOW, 0.03, 0.4, direction, cells=15, passes=passes)
    straight = RotaryDryer(3.0 * passes, 1.5 / passes**0.5, SLOW, 0.03, 0.4, direction, cells=15)
    one, other = (unit.operate(feed=feed, gas=gas) for unit in (folded, straight))
    for name in ("moisture_dry_basis", "residence_time", "temperature_exhaust", "solid_holdup"):
        assert float(getattr(one.figures, name)) == pytest.approx(
            float(getattr(other.figures, name)), rel=1e-9
        )
    lost = closure([feed, gas], [one.outlets.product, one.outlets.exhaust], one.outlets.heat_duty)
    assert float(lost.mass) < 1e-12
    assert float(lost.energy) < 1e-9
    short = RotaryDryer(3.0, 1.5, SLOW, 0.03, 0.4, direction, cells=15).operate(feed=feed, gas=gas)
    assert float(one.figures.moisture_dry_basis) < float(short.figures.moisture_dry_basis)
    assert float(one.uses["electric_power_drive"]) > float(other.uses["electric_power_drive"])
