"""Centrifuges as equipment: closed balances, cut sizes that mean what they say, a peeler's cycle by hand,
gradients.
"""

from __future__ import annotations

import jax
import jax.numpy as jnp
import numpy as np
import pytest

from granum.centrifuges.equipment.decanters import ScrollDecanter
from granum.centrifuges.equipment.filtering import Peeler, Pusher
from granum.centrifuges.equipment.screens import (
    ScrollScreen,
    SlidingCakeScreen,
    TumblingScreen,
    VibratingScreen,
)
from granum.centrifuges.equipment.settling import DiscStack, SolidBasket, TubularBowl
from granum.centrifuges.formulas import conveying
from granum.core.constants import ZERO_CELSIUS
from granum.streams.audit import closure
from granum.streams.mixture import Mixture, Species
from granum.streams.stream import Stream

EDGES = tuple(np.geomspace(1e-7, 1e-3, 41))
M = Mixture(
    solids=(Species("salt crystal", (("salt", 1.0),), (2100.0,), (900.0,)),),
    liquids=(
        Species("water", (("water", 1.0),), (1000.0,), (4186.0,)),
        Species("salt", (("salt", 1.0),), (1900.0,), (900.0,)),
    ),
    gases=(Species("air", (("air", 1.0),), heat_capacity=(1005.0,), molar_mass=0.029),),
    size_edges=EDGES,
    liquid_viscosity=lambda fractions, temperature: 1.2e-3,
)


def stream(solid=0.0, water=0.0, salt=0.0, median=2e-4, temperature=ZERO_CELSIUS + 30):
    shares = np.exp(-0.5 * (np.log(M.sizes / median) / 0.5) ** 2)
    return Stream(
        solid * jnp.asarray(shares / shares.sum())[None],
        jnp.array([water, salt]),
        jnp.zeros(1),
        jnp.asarray(temperature),
        jnp.asarray(1e5),
        M,
    )


SETTLING = {
    "tubular": TubularBowl(radius_inner=0.02, radius_outer=0.06, rotation_speed="15000 rpm", bowl_length=0.7),
    "discs": DiscStack(
        radius_inner=0.05,
        radius_outer=0.15,
        rotation_speed="7000 rpm",
        disc_number=80,
        disc_angle="40 degree",
    ),
    "decanter": ScrollDecanter(
        radius_inner=0.12, radius_outer=0.18, rotation_speed="3000 rpm", bowl_length=0.8, beach_length=0.2
    ),
    "basket": SolidBasket(radius_inner=0.45, radius_outer=0.6, rotation_speed="1200 rpm", bowl_length=0.6),
}
COMMON = {"cake_resistance": 3e8, "void_fraction": 0.42}
FILTERING = {
    "peeler": Peeler(
        radius_outer=0.6,
        cake_radius=0.5,
        radius_inner=0.47,
        rotation_speed="1000 rpm",
        basket_height=0.6,
        **COMMON,
    ),
    "scroll_screen": ScrollScreen(
        radius_outer=0.25,
        rotation_speed="1600 rpm",
        basket_length=0.4,
        scroll_pitch=0.08,
        differential_speed="25 rpm",
        **COMMON,
    ),
    "sliding_screen": SlidingCakeScreen(
        radius_outer=0.25,
        rotation_speed="1600 rpm",
        basket_length=0.4,
        cone_angle="30 degree",
        friction_angle="25 degree",
        stay_time=8.0,
        **COMMON,
    ),
    "pusher": Pusher(
        radius_outer=0.25, cake_radius=0.21, rotation_speed="1600 rpm", basket_length=0.4, **COMMON
    ),
}


@pytest.mark.parametrize("name", SETTLING)
def test_settling_balances_and_grade(name):
    unit, feed = SETTLING[name], stream(0.02, 0.9, 0.1, median=1.5e-6)
    out = unit(feed)
    found = closure([feed], out)
    assert float(found.mass) < 1e-14
    assert float(found.energy) < 1e-12
    grade = np.asarray(unit.grade(feed))[0]
    assert np.all(np.diff(grade) >= -1e-12)
    assert grade[-1] == 1.0
    figures = unit.operate(feed=feed).figures
    assert 0 < figures.solids_recovery <= 1
    # the cut size is the one caught by half (dilute feed: hindrance is a few percent of a percent)
    dilute = stream(1e-7, 0.9, 0.1, median=1.5e-6)
    half = np.interp(0.5, np.asarray(unit.grade(dilute))[0], np.log(M.sizes))
    cut = float(unit.operate(feed=dilute).figures.cut_size_centrifuge)
    assert np.exp(half) == pytest.approx(cut, rel=0.05)
    assert all(check.source for check in unit.operate(feed=feed).checks)
    # the sediment holds its own volume fraction of solid
    assert float(out.sediment.solids_volume_fraction) == pytest.approx(0.5, rel=1e-12)


def test_faster_or_slower_feed():
    unit = SETTLING["decanter"]
    slow, fast = (unit(stream(0.05 * k, 0.9 * k, 0.1 * k, median=4e-6)) for k in (1.0, 6.0))
    assert float(slow.sediment.solid_flow) > float(fast.sediment.solid_flow) / 6.0


@pytest.mark.parametrize("name", FILTERING)
@pytest.mark.parametrize("washed", [False, True])
def test_filtering_balances_close(name, washed):
    unit, feed = FILTERING[name], stream(0.5, 0.6, 0.2, temperature=320.0)
    inlets = {"feed": feed} | ({"wash": stream(water=0.1, temperature=295.0)} if washed else {})
    out = unit(**inlets)
    found = closure(inlets.values(), out)
    assert float(found.mass) < 1e-14
    assert float(found.energy) < 1e-10
    figures = unit.operate(**inlets).figures
    # a spun cake of 0.2 mm crystals holds a few percent of liquid
    assert 0.01 < figures.moisture_dry_basis < 0.12
    if washed:
        assert figures.solute_remaining < 0.6
    assert all(check.source for check in unit.operate(**inlets).checks)


def test_cycle_of_a_peeler_by_hand():
    feed, unit = stream(0.5, 0.6, 0.2), FILTERING["peeler"]
    w, ro, rc, ri, rho = 1000 * np.pi / 30, 0.6, 0.5, 0.47, float(feed.liquid_density)
    k = 1 / (3e8 * 0.58 * 2100)
    cake = 0.5 / 2100 / 0.58
    v = cake / (float(feed.liquid_volume_flow) - 0.42 * cake)
    built = (ro**2 - rc**2) + 2 * rc**2 * np.log(rc / ro)
    load = built * 1.2e-3 / (2 * v * k * rho * w**2 * (ro**2 - ri**2))
    fall = 1.2e-3 * np.log(ro / rc) / (k * rho * w**2) * np.log((ro**2 - ri**2) / (ro**2 - rc**2))
    spin = unit.spin(feed)
    assert float(spin.loading_time) == pytest.approx(load, rel=1e-10)
    assert float(spin.spin_off_time) == pytest.approx(fall, rel=1e-10)
    volume = np.pi * (ro**2 - rc**2) * 0.6
    assert float(spin.capacity_use) == pytest.approx(cake * (load + fall + 120) / volume, rel=1e-10)


def test_a_heel_blinds_and_a_siphon_helps():
    feed, plain = stream(0.5, 0.6, 0.2), FILTERING["peeler"]
    shape = {
        "radius_outer": 0.6,
        "cake_radius": 0.5,
        "radius_inner": 0.47,
        "rotation_speed": "1000 rpm",
        "basket_height": 0.6,
        **COMMON,
    }
    before = plain.operate(feed=feed).figures
    uses = [
        float(
            Peeler(**shape, heel_thickness=0.005, heel_blinding=0.2, heel_cycles=n)
            .operate(feed=feed)
            .figures.capacity_use
        )
        for n in (1.0, 20.0, 50.0)
    ]
    assert float(before.capacity_use) < uses[0] < uses[1] < uses[2]
    # a fresh heel is cake that stays: the loading of a bowl of cake from there, its liquid pressing on
    k = 1 / (3e8 * 0.58 * 2100)
    unit = Peeler(**shape, heel_thickness=0.005)
    assert float(unit.medium(feed)) == pytest.approx(0.005 / k, rel=1e-9)
    siphon = Peeler(**shape, siphon_radius=0.605).operate(feed=feed)
    assert float(siphon.figures.loading_time) == pytest.approx(
        float(before.loading_time) * (0.6**2 - 0.47**2) / (0.605**2 - 0.47**2), rel=1e-9
    )
    # ½ ρ ω² (r_s² − r_o²) is 0.3 bar and more here; three centimeters farther out no air pressure would hold
    suction = {c.name: c for c in siphon.checks}["suction of the siphon"]
    density = float(feed.liquid_density)
    by_hand = 0.5 * density * (1000 * np.pi / 30) ** 2 * (0.605**2 - 0.6**2) / 1e5
    assert float(suction.value) == pytest.approx(by_hand, rel=1e-9)
    assert suction.ok
    far = Peeler(**shape, siphon_radius=0.63).operate(feed=feed)
    assert not {c.name: c.ok for c in far.checks}["suction of the siphon"]


def test_gradient_of_moisture_with_speed():
    def moisture(speed):
        unit = Pusher(radius_outer=0.25, cake_radius=0.21, rotation_speed=speed, basket_length=0.4, **COMMON)
        return unit(stream(0.5, 0.6, 0.2)).cake.moisture_dry_basis

    slope = float(jax.grad(moisture)(160.0))
    assert slope == pytest.approx(float((moisture(160.01) - moisture(159.99)) / 0.02), rel=1e-5)
    assert slope < 0


def test_thin_cake_of_a_scroll_screen_by_hand():
    # 0.4 m in pitches of 8 cm at 25 turns a minute: 12 s; the cake held is the feed of 12 s, the wall 2 π r L
    feed, unit = stream(0.5, 0.6, 0.2), FILTERING["scroll_screen"]
    held = 0.5 / 2100 / 0.58 * 12.0
    assert float(unit.spin(feed).cycle_time) == pytest.approx(12.0)
    inner = float(unit.inner_radius(feed))
    assert np.pi * (0.25**2 - inner**2) * 0.4 == pytest.approx(held, rel=1e-9)
    # twice the feed, twice the cake; a faster basket leaves it drier
    double = stream(1.0, 1.2, 0.4)
    assert 0.25**2 - float(unit.inner_radius(double)) ** 2 == pytest.approx(
        2 * (0.25**2 - inner**2), rel=1e-9
    )
    fast = ScrollScreen(
        radius_outer=0.25,
        rotation_speed="2400 rpm",
        basket_length=0.4,
        scroll_pitch=0.08,
        differential_speed="25 rpm",
        **COMMON,
    )
    assert float(fast(feed).cake.moisture_dry_basis) < float(unit(feed).cake.moisture_dry_basis)


def test_what_moves_a_cake_over_a_cone():
    # resultant of ω²r and the shake at the edge of the friction cone, by components along and across a wall
    # of 13°
    g, f, w, r = np.radians(13.0), np.radians(25.0), 300 * np.pi / 30, 0.5
    a = conveying.vibration_acceleration_least(w, r, g, f)
    along, across = w**2 * r * np.sin(g) + a * np.cos(g), w**2 * r * np.cos(g) - a * np.sin(g)
    assert along / across == pytest.approx(np.tan(f), rel=1e-12)
    assert conveying.vibration_acceleration_least(w, r, f, g) == 0.0
    coal = stream(5.0, 1.5, 0.0, median=3e-3)
    cone = {
        "radius_outer": r,
        "rotation_speed": w,
        "basket_length": 0.6,
        "cone_angle": g,
        "friction_angle": f,
        **COMMON,
    }
    shaken = VibratingScreen(vibration_acceleration=1.2 * a, **cone)
    weak = VibratingScreen(vibration_acceleration=0.8 * a, **cone)
    tumbled = TumblingScreen(tumbling_angle="13 degree", **cone)
    for unit, moves in ((shaken, True), (weak, False), (tumbled, True)):
        assert unit.operate(feed=coal).checks[-1].ok is moves


def test_without_solid_there_is_no_cake_to_wait_for():
    """A pusher had told a cycle of 10²⁹² days."""
    clear = stream(0.0, 1.5, 0.0)
    pusher = Pusher(radius_outer=0.4, rotation_speed=150.0, cake_radius=0.36, basket_length=0.5, **COMMON)
    peeler = Peeler(
        radius_outer=0.4,
        rotation_speed=150.0,
        cake_radius=0.36,
        basket_height=0.5,
        radius_inner=0.3,
        **COMMON,
    )
    for unit in (pusher, peeler):
        figures = unit.operate(feed=clear).figures
        assert 0.0 <= float(figures.cycle_time) < 600.0
        assert float(figures.loading_time) == 0.0
