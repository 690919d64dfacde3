"""Cyclones against printed constants and examples, hand calculation, limits; equipment conserves mass."""

from __future__ import annotations

import equinox as eqx
import jax.numpy as jnp
import numpy as np
import pytest
from tests.sharing.places import EXAMPLES

from granum.cases.reading import read_text
from granum.core import flags
from granum.core.errors import ApplicabilityError, InputError
from granum.cyclones.charts import gas_cyclone_chart
from granum.cyclones.equipment.gas import GasCyclone
from granum.cyclones.equipment.liquid import Hydrocyclone
from granum.cyclones.formulas import efficiency, hydrocyclones, pressure
from granum.cyclones.geometry import FreeCyclone, StandardCyclone
from granum.cyclones.sizing import cyclone_sizing, hydrocyclone_sizing
from granum.streams.audit import closure
from granum.streams.mixture import Mixture, Species
from granum.streams.stream import empty

AIR = (2000.0, 1.2, 1.8e-5)
STAIRMAND = StandardCyclone()(1.0)


def test_the_exercise_of_the_notes() -> None:
    # V = 14.5 cm/s, d_c = 0.7 m, 19 g/cm³, 0.018 mPa s: 28.6 µm as printed, from the short form ¾ (η d_c/(π V
    # ρ))^½
    found = efficiency.cut_size_turns(0.145, 0.7, 19000.0, 1.2, 1.8e-5)
    assert found == pytest.approx(28.6e-6, abs=0.05e-6)
    assert found == pytest.approx(0.75 * (1.8e-5 * 0.7 / (np.pi * 0.145 * 18998.8)) ** 0.5, rel=1e-9)


def test_leith_licht_configuration_numbers() -> None:
    # printed for the standard designs, in rounded steps of their own
    for name, printed in (
        ("stairmand_high_efficiency", 551.3),
        ("swift_high_efficiency", 699.2),
        ("lapple", 402.9),
        ("swift_general_purpose", 381.8),
    ):
        G = efficiency.configuration_number_leith_licht(*StandardCyclone(name)(2.0))
        assert pytest.approx(printed, rel=1e-3) == G, name
    # Alexander's exponent at 283 K is 0.67 D^0.14
    assert efficiency.vortex_exponent_alexander(0.5, 283.0) == pytest.approx(0.67 * 0.5**0.14)
    # by hand: n = 0.67 at D = 1 m and 283 K
    tau = 1998.8 * 1e-10 / (18 * 1.8e-5)
    by_hand = 1 - np.exp(-2 * (551.2 * tau * 1.5 * 1.67) ** (0.5 / 1.67))
    assert efficiency.cyclone_efficiency_leith_licht(1e-5, 1.5, *AIR, *STAIRMAND, 283.0) == pytest.approx(
        by_hand, rel=1e-4
    )


def test_lapple() -> None:
    # classic exercise: b = 15 cm, N = 8, 20 m/s, 1 g/cm³, air at 350 K (2.08e-5 Pa s): 5.3 µm
    assert efficiency.cut_size_lapple(20.0, 0.15, 1001.0, 1.0, 2.08e-5, 8.0) == pytest.approx(
        5.28e-6, rel=5e-3
    )
    assert efficiency.turn_number_lapple(0.5, 2.0, 4.0) == 6.0


def test_barth_and_muschelknautz() -> None:
    # Barth by hand for Stairmand's design of 1 m at 15 m/s: v_x = 7.639, α = 0.747, H_c = 3 m
    u = 1 / ((1 - 0.4 * 0.4**0.5) * 0.1 / (np.pi * 0.25 * 0.4) + 0.005 * 3 / 0.25)
    cut = (9 * 1.8e-5 * 1.5 / (np.pi * 3 * 1998.8 * (u * 1.5 / (np.pi / 16)) ** 2)) ** 0.5
    assert efficiency.cut_size_barth(1.5, *AIR, *STAIRMAND) == pytest.approx(cut, rel=1e-9)
    # Muschelknautz by hand for clean gas: ξ = 0.4, slot with its constriction, wall area A_R, f = 0.005
    inner = (1 - (1 - 0.16) * (0.8 - 0.16)) ** 0.5
    alpha = (1 - (1 + 4 * (0.04 - 0.2) * inner) ** 0.5) / 0.4
    wall = 15 * 0.4 / (alpha * 0.5)
    area = np.pi * (0.75 / 4 + 1.5 + 0.6875 * (2.5**2 + 0.3125**2) ** 0.5 + 0.25)
    core = wall * 2 / (1 + 0.005 * area * wall * 2**0.5 / 3.0)
    cut = (18 * 1.8e-5 * 0.9 * 1.5 / (2 * np.pi * 1998.8 * core**2 * 3.5)) ** 0.5
    assert efficiency.cut_size_muschelknautz(1.5, *AIR, *STAIRMAND) == pytest.approx(cut, rel=1e-9)
    # dust brakes the swirl: coarser cut, lower pressure drop
    loads = np.array([0.0, 0.01, 0.1, 0.5])
    cuts = efficiency.cut_size_muschelknautz(1.5, *AIR, *STAIRMAND, loads)
    drops = pressure.pressure_drop_muschelknautz(1.5, 2000.0, 1.2, *STAIRMAND, loads)
    assert np.all(np.diff(cuts) > 0)
    assert drops[1] < drops[0]
    # by hand: 0.025·0.1·(10·0.5)^0.15 and the other branch at 0.01: k = -0.11 + 0.4605
    limit = efficiency.limit_loading_muschelknautz(np.array([0.5, 0.01]), 2e-6, 2e-5)
    np.testing.assert_allclose(limit, [0.0025 * 5**0.15, 0.0025 * 0.1**0.350517], rtol=1e-6)


def test_pressure_drops() -> None:
    lapple = StandardCyclone("lapple")(0.6)
    # printed: Lapple's design loses 8 heads, Stairmand's 6.4 by Shepherd and Lapple; measured Eu = 320, that
    # is 320 (0.4/π)² = 5.19 heads
    assert pressure.inlet_heads_shepherd_lapple(*lapple) == pytest.approx(8.0)
    assert pressure.inlet_heads_shepherd_lapple(*STAIRMAND) == pytest.approx(6.4)
    assert pressure.inlet_heads_stairmand(*STAIRMAND) == pytest.approx(5.19, rel=0.01)
    # by hand: 20·0.4·(0.5/(4·1.5·0.375))^⅓
    assert pressure.inlet_heads_ramachandran(*STAIRMAND) == pytest.approx(8 * (0.5 / 2.25) ** (1 / 3))
    assert pressure.inlet_heads_casal_martinez(*STAIRMAND) == pytest.approx(11.3 * 0.16 + 3.33)
    # Barth by hand: u as above, body ½(1/(1/u - 0.06)² - u²), sharp finder 4.4 u^{4/3} + u²
    v_x = 1.5 / (np.pi / 16)
    u = 1 / ((1 - 0.4 * 0.4**0.5) * 0.1 / (np.pi * 0.1) + 0.06)
    heads = 0.5 * (1 / (1 / u - 0.06) ** 2 - u**2) + 4.4 * u ** (4 / 3) + u**2
    assert pressure.pressure_drop_barth(1.5, 1.2, *STAIRMAND) == pytest.approx(0.6 * v_x**2 * heads, rel=1e-9)
    # Kalen and Zenz in the original feet: 2.055 W K^0.4 D^0.067 v^⅔/(1-K)^⅓
    feet, W = 0.3048, (4 * 9.80665 * 1.8e-5 * 1998.8 / (3 * 1.44)) ** (1 / 3)
    v = 2.055 * W / feet * 0.2**0.4 * (1 / feet) ** 0.067 * (15 / feet) ** (2 / 3) / 0.8 ** (1 / 3) * feet
    assert pressure.saltation_velocity_kalen_zenz(15.0, 1.0, 0.2, *AIR) == pytest.approx(v, rel=2e-3)


def test_hydrocyclones() -> None:
    # Plitt's own constant 50.5 with (ρs - ρ) in g/cm³, by hand in the units of the print
    args = (0.1 / 60, 0.1, 0.03, 0.035, 0.02, 0.4, 0.05, 2650.0, 1000.0, 1e-3)
    found = hydrocyclones.hydrocyclone_plitt(*args)
    cut = 50.5 * 10**0.46 * 3**0.6 * 3.5**1.21 * np.exp(0.315) / (2**0.71 * 40**0.38 * 100**0.45 * 1.65**0.5)
    assert 1e6 * found.cut_size == pytest.approx(cut, rel=1e-2)
    kPa = 1.88 * 100**1.78 * np.exp(0.0275) / (10**0.37 * 3**0.94 * 40**0.28 * 16.25**0.87)
    assert found.pressure_drop == pytest.approx(1e3 * kPa, rel=1e-9)
    assert found.sharpness == pytest.approx(1.94 * np.exp(-1.58 * found.underflow_share) * 40**0.15, rel=1e-9)
    # Castilho and Medronho by hand: v = 0.12732 m/s, Re = 12 732
    small = hydrocyclones.hydrocyclone_castilho_medronho(1e-3, 0.1, 0.015, 0.01, 2650.0, 1000.0, 1e-3)
    v = 4e-3 / (np.pi * 0.01)
    Eu = 371.5 * (v * 1e5) ** 0.116 * np.exp(-0.0212)
    water = 1218 * 0.15**4.75 * Eu**-0.3
    stokes = 0.0474 * np.log(1 / water) ** 0.742 * np.exp(0.0896) / Eu
    assert small.pressure_drop == pytest.approx(Eu * 1000 * v**2 / 2)
    assert small.underflow_share == pytest.approx(water)
    assert 1650 * v * small.cut_size**2 / (18e-3 * 0.1) == pytest.approx(stokes)
    assert hydrocyclones.hydrocyclone_efficiency(1e-5, 1e-5, 2.5, 0.2) == pytest.approx(0.6)


def test_bad_geometry_and_light_dust() -> None:
    with pytest.raises(InputError, match="inlet must fit"):
        FreeCyclone(0.5, 0.3, 0.5, 0.5, 1.5, 4.0, 0.375)
    with pytest.raises(InputError):
        StandardCyclone("no such")
    light = efficiency.cut_size_barth.evaluate(1.5, np.array([1.0, 2000.0]), 1.2, 1.8e-5, *STAIRMAND)
    assert np.isnan(light.value[0])
    assert light.flags[0] & flags.OUTSIDE_DOMAIN
    assert np.isfinite(light.value[1])


EDGES = tuple(np.geomspace(5e-7, 2e-4, 13))
GAS = Mixture(
    solids=(Species("dust", (("dust", 1.0),), (2000.0,), (800.0,)),),
    liquids=(),
    gases=(Species("air", (("air", 1.0),), (1.2,), (1005.0,), molar_mass=0.02896),),
    size_edges=EDGES,
    gas_viscosity=lambda _w, T: 1.8e-5,
)


def dusty(dust: float):
    return empty(GAS).replace(solid=jnp.full((1, 12), dust / 12), gas=jnp.array([1.8]))


def test_gas_cyclone_closes_and_overload_helps() -> None:
    feed = dusty(0.01)
    unit = GasCyclone(1.0)
    run = eqx.filter_jit(unit)
    out = run(feed)
    found = closure([feed], list(out))
    assert float(found.mass) < 1e-12
    np.testing.assert_allclose(np.asarray(out.gas.solid + out.dust.solid), np.asarray(feed.solid), rtol=1e-14)
    share = np.asarray(out.dust.solid / feed.solid)[0]
    assert np.all(np.diff(share) >= 0)
    assert float(out.gas.pressure) < float(feed.pressure)
    figures = unit.operate(feed=feed).figures
    assert all(np.isfinite(float(x)) for x in figures if x is not None)
    assert next(check.ok for check in unit.operate(feed=feed).checks)
    # a heavy load falls out at the inlet whatever its size: more of the finest class is collected
    assert float((run(dusty(1.0)).dust.solid / dusty(1.0).solid)[0, 0]) > share[0]


def test_hydrocyclone_closes() -> None:
    water = Mixture(
        solids=(Species("sand", (("sand", 1.0),), (2650.0,), (800.0,)),),
        liquids=(Species("water", (("water", 1.0),), (1000.0,), (4180.0,)),),
        gases=(),
        size_edges=EDGES,
        liquid_viscosity=lambda w, T: 1e-3,
    )
    feed = empty(water).replace(
        solid=jnp.full((1, 12), 0.01), liquid=jnp.array([3.0]), pressure=jnp.asarray(4e5)
    )
    unit = Hydrocyclone(0.1, 0.02)
    out = eqx.filter_jit(unit)(feed)
    assert float(closure([feed], list(out)).mass) < 1e-12
    share = np.asarray(out.underflow.solid / feed.solid)[0]
    water_split = float(out.underflow.liquid[0] / feed.liquid[0])
    assert np.all(np.diff(share) >= 0)
    assert water_split < share[0] < water_split + 0.05
    assert share[-1] > 0.99
    assert all(np.isfinite(float(x)) for x in unit.operate(feed=feed).figures if x is not None)
    assert unit.operate(feed=feed).checks


def test_an_apex_lets_out_nothing_thicker_than_a_heap() -> None:
    water = Mixture(
        solids=(Species("sand", (("sand", 1.0),), (2650.0,), (800.0,)),),
        liquids=(Species("water", (("water", 1.0),), (1000.0,), (4180.0,)),),
        gases=(),
        size_edges=EDGES,
        liquid_viscosity=lambda w, T: 1e-3,
    )
    feed = empty(water).replace(
        solid=jnp.full((1, 12), 0.03), liquid=jnp.array([3.0]), pressure=jnp.asarray(4e5)
    )
    told = "solids by volume in the underflow"
    overs = []
    for opening in np.array([0.1, 0.15, 0.2, 0.25, 0.3]) * 0.1:
        unit = Hydrocyclone(0.1, opening)
        made = unit.operate(feed=feed)
        under, over = made.outlets.underflow, made.outlets.overflow
        assert float(closure([feed], [under, over]).mass) < 1e-12
        share = np.asarray(under.solid / feed.solid)[0]
        water_split = float(under.liquid[0] / feed.liquid[0])
        assert np.all(np.diff(share) >= 0)
        assert np.all(share >= water_split)
        thick = float(under.solids_volume_fraction)
        assert thick <= 0.6 + 1e-12
        assert {c.name: c.ok for c in made.checks}[told] == (thick <= 0.5)
        free = hydrocyclones.hydrocyclone_efficiency(
            np.asarray(water.sizes), made.figures.cut_size, 2.7, water_split
        )
        by_weight = 1.0 / (1.0 + 1000.0 / 2650.0 * 0.4 / 0.6)
        if float(jnp.sum(free * 0.03)) / by_weight > float(jnp.sum(free * 0.03)) + 3.0 * water_split:
            assert thick == pytest.approx(0.6, rel=1e-9)
        else:
            np.testing.assert_allclose(share, np.asarray(free), rtol=1e-9)
        overs.append(float(over.solid_flow))
    assert np.all(np.diff(overs) < 0.0)  # a wider apex lets more out below


# nearly all sand goes round through three choked apexes: (t/h of solid, of water, of dilution, size in um,
# spread), then body, apex (cm) and number of rougher, cleaner and scavenger
ROUND = {
    "50 times": ((3.396, 55.539, 36.0, 169.7, 0.85), (26.54, 4.313, 2), (5.24, 0.703, 64), (5.1, 1.392, 92)),
    "18 times": (
        (70.464, 757.682, 366.35, 42.1, 1.03),
        (6.74, 1.192, 400),
        (11.31, 1.381, 82),
        (11.26, 3.084, 227),
    ),
}


@pytest.mark.parametrize("name", ROUND)
def test_a_network_whose_apexes_are_choked_is_solved_and_told(name: str) -> None:
    (solid, liquid, dilution, size, spread), *stages = ROUND[name]
    text = (EXAMPLES / "hydrocyclone-network" / "line.toml").read_text()
    text = text[: text.index("[specifications")]
    for old, new in (
        ('smallest = "0.25 um", largest = "1.024 mm"', 'smallest = "0.02 um", largest = "2 mm"'),
        ('"10 t/h"', f'"{solid} t/h"'),
        ('"90 t/h"', f'"{liquid} t/h"'),
        ('"60 t/h"', f'"{dilution} t/h"'),
        ('"80 um", distribution_exponent = 0.9', f'"{size} um", distribution_exponent = {spread}'),
    ):
        assert text.count(old) == 1
        text = text.replace(old, new)
    settings = {}
    for unit, (body, apex, number) in zip(("rougher", "cleaner", "scavenger"), stages, strict=True):
        settings |= {
            f"{unit}.diameter": 0.01 * body,
            f"{unit}.underflow_diameter": 0.01 * apex,
            f"{unit}.parallel_number": float(number),
        }
    run = read_text(text).with_values(**settings).solve()
    assert run.audit["mass_closure"] < 1e-9
    told = {c.name: c for c in run.solution.sheets["cleaner"].checks}["solids by volume in the underflow"]
    assert not told.ok
    assert told.value == pytest.approx(0.6, rel=1e-9)


def test_chart() -> None:
    drawing = gas_cyclone_chart(1.5, 2000.0, 1.0)
    assert len(drawing.data) == 5
    assert all(np.all(np.diff(trace.y) >= 0) for trace in drawing.data)


def test_sizing_meets_what_it_was_asked() -> None:
    found = cyclone_sizing(4.0, 3e-6, 900.0, 2000.0)
    shape = StandardCyclone()(found.diameter)
    each = 4.0 / found.parallel_number
    assert efficiency.cut_size_muschelknautz(each, *AIR, *shape) == pytest.approx(3e-6, rel=1e-6)
    assert pressure.inlet_heads_stairmand(*shape) * 0.6 * found.inlet_velocity**2 == pytest.approx(900.0)
    with pytest.raises(ApplicabilityError, match="No cyclone"):
        cyclone_sizing(4.0, 1e-7, 100.0, 2000.0)


def test_hydrocyclone_sizing_meets_its_own_rating() -> None:
    plant = hydrocyclone_sizing(50 / 3600, 1e-5, 2e5, 0.1, 2650.0)
    assert plant.parallel_number == int(plant.parallel_number)
    rated = hydrocyclones.hydrocyclone_castilho_medronho(
        50 / 3600 / plant.parallel_number, plant.diameter, plant.underflow_diameter, 0.01, 2650.0, 998.0, 1e-3
    )
    assert rated.underflow_share == pytest.approx(0.1, rel=1e-9)
    assert rated.cut_size == pytest.approx(plant.cut_size)
    assert plant.pressure_drop <= 2e5
    # one fewer would cost more than allowed, at the same size
    fewer = hydrocyclones.hydrocyclone_castilho_medronho(
        50 / 3600 / (plant.parallel_number - 1),
        plant.diameter,
        plant.underflow_diameter,
        0.01,
        2650.0,
        998.0,
        1e-3,
    )
    assert fewer.pressure_drop > 2e5
    assert fewer.cut_size <= 1e-5 <= plant.cut_size * (1 + 1e-9)
    with pytest.raises(ApplicabilityError, match="No hydrocyclone"):
        hydrocyclone_sizing(50 / 3600, 1e-7, 1e4, 0.1, 2650.0)


@pytest.mark.parametrize(("dust", "air"), [(0.0, 1.8), (0.01, 0.0), (0.0, 0.0), (0.01, 1e-4)])
def test_empty_streams_give_numbers_and_failed_checks(dust: float, air: float) -> None:
    feed = dusty(dust).replace(gas=jnp.array([air]))
    unit = GasCyclone(1.0)
    out = unit(feed)
    assert all(np.all(np.isfinite(np.asarray(s.solid))) for s in out)
    assert all(np.isfinite(float(x)) for x in unit.operate(feed=feed).figures if x is not None)
    assert air > 1.0 or not all(check.ok for check in unit.operate(feed=feed).checks)
