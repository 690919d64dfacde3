"""Thickening filter: a printed filtration, an independent integration under shear, limits and sizing."""

from __future__ import annotations

import jax.numpy as jnp
import numpy as np
import pytest
import scipy

import granum as gr
from granum.core.errors import ConvergenceError
from granum.filtration.equipment.thickening import ThickeningFilter
from granum.streams.mixture import Mixture, Species
from granum.streams.stream import empty

KEY = "filtration.thickening_filter"
CHALK = {"pressure_drop": 338e3, "cake_resistance": 1.863e11, "medium_resistance": 10.63e10}


def figures(**inputs):
    run = gr.alone(KEY, **inputs).solve()
    assert abs(run.audit["mass_closure"]) < 1e-9
    assert abs(run.audit["energy_closure"]) < 1e-9
    return run, run.solution.sheets["thickening_filter"].figures


def test_a_printed_filtration_between_two_pulses():
    """Geankoplis, example 14.2-2: 3.37 m³ on 17.46 m² in 269.7 s, of a slurry with 23.47 kg/m³ of filtrate;
    of the pulse a tenth is taken back.
    """
    per, packed = 23.47, 0.45
    filtered = 3.37 / 17.46
    water = {"solid_flow": "3000 kg/h", "liquid": {"water": 1.0}}
    densities = figures(feed=water | {"liquid_flow": "9 t/h"})[0].streams["feed"]
    around = per / (float(densities.solid_density) + per / packed)
    liquid = (1.0 - around) / around * float(densities.liquid_density / densities.solid_density)
    run, found = figures(
        **CHALK,
        filtration_time=269.7,
        dead_time=30.0,
        backwash_volume_per_area=0.1 * filtered,
        feed=water | {"liquid_flow": f"{3000.0 * liquid} kg/h"},
    )
    feed = run.streams["feed"]
    assert feed.solids_volume_fraction == pytest.approx(around, rel=1e-6)

    # time in proportion to viscosity: Geankoplis's 0.8937 mPa s
    def volume(eta):
        return scipy.optimize.brentq(
            lambda v: eta / 338e3 * (1.863e11 * per / 2.0 * v**2 + 10.63e10 * v) - 269.7, 0.0, 1.0
        )

    assert volume(8.937e-4) == pytest.approx(filtered, rel=2e-3)
    gross = found.filtrate_flux * (269.7 + 30.0) + 0.1 * filtered
    assert gross == pytest.approx(volume(float(feed.liquid_viscosity)), rel=2e-3)


def test_under_shear_the_cake_stops_where_its_flux_is_carried_away():
    """Against the cake grown step by step: dV/dt by Darcy, deposit only of what shear does not carry away."""
    carried = 2e-5
    run, found = figures(
        mass_transfer_coefficient=carried, filtration_time="4 hour", vessel_contents="thickened"
    )
    feed, packed, around = run.streams["feed"], 0.45, 0.15
    density, eta = float(feed.solid_density), float(feed.liquid_viscosity)
    per = around * density / (1.0 - around / packed)
    limit = carried * np.log(packed / around)

    def flux(loading):
        return 2e5 / (eta * (1.86e11 * loading + 1e10))

    def rate(_t, y):
        u = flux(y[1])
        return [u, per * u * (u > limit)]

    grown = scipy.integrate.solve_ivp(
        rate, (0.0, 14400.0), [0.0, 0.0], rtol=1e-9, atol=1e-12, max_step=20.0, method="LSODA"
    )
    assert found.filtrate_flux == pytest.approx((grown.y[0, -1] - 2e-3) / 14430.0, rel=2e-3)
    assert found.dry_cake_mass_per_area == pytest.approx(grown.y[1, -1], rel=2e-3)
    assert found.filtrate_flux_last == pytest.approx(limit, rel=1e-6)
    endless = figures(
        mass_transfer_coefficient=carried,
        filtration_time="4000 hour",
        vessel_contents="thickened",
        backwash_volume_per_area=0.0,
    )[1]
    assert endless.filtrate_flux == pytest.approx(limit, rel=1e-3)


@pytest.mark.long
def test_a_hundred_ordinary_settings():
    rng = np.random.default_rng(7)
    refused = 0
    for _setting in range(100):
        inputs = {
            "pressure_drop": rng.uniform(5e4, 5e5),
            "cake_resistance": 10 ** rng.uniform(9, 12),
            "medium_resistance": 10 ** rng.uniform(9, 11),
            "void_fraction": rng.uniform(0.35, 0.7),
            "solids_volume_fraction_thickened": rng.uniform(0.05, 0.25),
            "filtration_time": 10 ** rng.uniform(1.5, 4),
            "backwash_volume_per_area": rng.uniform(0.0, 4e-3),
            "mass_transfer_coefficient": 10 ** rng.uniform(-6, -4) if rng.random() < 0.5 else None,
        }
        inputs = {name: value for name, value in inputs.items() if value is not None}
        try:
            run, found = figures(**inputs)
        except ConvergenceError:  # of the pulses, as below: more than the cake lets through
            refused += 1
            continue
        thick = run.streams["thickening_filter.thickened"]
        assert thick.solids_volume_fraction == pytest.approx(inputs["solids_volume_fraction_thickened"])
        assert 0.0 <= found.backwash_share < 1.0
        assert found.filtrate_flux < inputs["pressure_drop"] / (8e-4 * inputs["medium_resistance"])
        harder = figures(**inputs | {"medium_resistance": 2.0 * inputs["medium_resistance"]})[1]
        assert harder.area_required >= found.area_required
    assert refused < 15


def test_shear_thickening_and_the_feed_around():
    """Shear needs less area, thickened slurry around the elements more; a thicker product, more filtrate."""
    slow = {"filtration_time": "2 hour"}
    bare = figures(**slow)[1]
    sheared = figures(**slow, mass_transfer_coefficient=1e-4)[1]
    mixed = figures(**slow, vessel_contents="thickened")[1]
    assert sheared.area_required < bare.area_required < mixed.area_required
    thicker = figures(solids_volume_fraction_thickened=0.25)[1]
    assert thicker.filtrate_flow > figures(solids_volume_fraction_thickened=0.1)[1].filtrate_flow
    clear = gr.alone(KEY, feed={"solid_flow": 0.0}).solve()
    assert clear.streams["thickening_filter.thickened"].liquid_flow == pytest.approx(0.0, abs=1e-12)


def test_sized_for_a_share_of_its_capacity():
    area = figures()[1].area_required
    sized = gr.alone(KEY, area=float(area) / 0.8).solve()
    assert sized.figure("thickening_filter.capacity_use") == pytest.approx(0.8)


def test_pulses_that_take_everything_back():
    with pytest.raises(ConvergenceError, match="take back all the filtrate"):
        gr.alone(KEY, filtration_time=5.0, backwash_volume_per_area="200 L/m2").solve()


def test_what_is_thicker_than_a_packed_cake_is_no_slurry():
    with pytest.raises(ConvergenceError, match="thicker than a packed cake"):
        gr.alone(KEY, solids_volume_fraction_thickened="50 %").solve()


def test_clods_that_float_are_told_unless_the_vessel_is_stirred():
    told = "share of the solids that is heavier than the liquid"
    fat = Mixture(
        solids=(Species("fat", (("fat", 1.0),), (920.0,), (2000.0,)),),
        liquids=(Species("water", (("water", 1.0),), (1000.0,), (4180.0,)),),
        gases=(),
        size_edges=(1e-5, 1e-4),
        liquid_viscosity=lambda w, T: 1e-3,
    )
    feed = empty(fat).replace(solid=jnp.full((1, 1), 0.1), liquid=jnp.array([3.0]))
    for contents in ("feed", "thickened"):
        unit = ThickeningFilter(10.0, 2e5, 1e11, 0.5, 0.2, vessel_contents=contents)
        check = {c.name: c for c in unit.operate(feed=feed).checks}[told]
        assert check.ok == (contents == "thickened")


def test_solid_without_liquid_leaves_thickened_and_has_no_flux():
    unit = ThickeningFilter(10.0, 2e5, 1e13, 0.5, 0.2, backwash_volume_per_area=0.01)
    sand = Mixture(
        solids=(Species("sand", (("sand", 1.0),), (2650.0,), (800.0,)),),
        liquids=(Species("water", (("water", 1.0),), (1000.0,), (4180.0,)),),
        gases=(),
        size_edges=(1e-5, 1e-4),
        liquid_viscosity=lambda w, T: 1e-3,
    )
    made = unit.operate(feed=empty(sand).replace(solid=jnp.full((1, 1), 0.1)))
    assert float(made.figures.filtrate_flux) == 0.0
    assert float(made.outlets.thickened.solid_flow) == pytest.approx(0.1)
