"""Spouted-bed dryer: residence times, balances, the spout and what it asks of vessel, grains and fan."""

from __future__ import annotations

import jax.numpy as jnp
import numpy as np
import pytest
from tests.sharing.streams import air, wet

import granum as gr
from granum import fluidization as fl
from granum.core.errors import ConvergenceError, InputError
from granum.drying.equipment.spouted_bed import SpoutedBedDryer
from granum.drying.gas_solid.kinetics import DiffusionKinetics
from granum.streams.audit import closure
from granum.streams.from_materials import mixture_of

WHEAT = mixture_of(["water"], ["wheat"], ["dry air", "water"], [3e-3, 4.2e-3])
FEED, GAS = wet(WHEAT, 0.03, 0.25, 288.0), air(WHEAT, 0.11, 0.008, 423.0)
SLOW = DiffusionKinetics(7e-11, 1.75e-3)


def bed(mass: float = 45.0, inlet: float = 0.06, vessels: float = 1.0, gas=GAS):
    """As arrays, so that all share what is compiled."""
    sizes = (jnp.asarray(x) for x in (0.45, inlet, mass))
    return SpoutedBedDryer(*sizes, SLOW, parallel_number=jnp.asarray(vessels)).operate(feed=FEED, gas=gas)


def checked(made, words: str):
    (found,) = [c for c in made.checks if words in c.name]
    return found


@pytest.mark.long
def test_moisture_that_diffuses_leaves_as_from_a_well_mixed_vessel() -> None:
    """Of first order in the moisture, with the gas so dry and hot that the film does not count: one over one
    plus rate and time, the mean over exponential residence times (Becker and Sallans for their first term).
    """
    for mass in (10.0, 45.0, 200.0):
        found = bed(mass, gas=GAS.part(gas=10.0)).figures
        time = mass / 0.03
        assert float(found.residence_time) == pytest.approx(time)
        left = 0.25 / (1.0 + np.pi**2 * 7e-11 / 1.75e-3**2 * time)
        assert float(found.moisture_dry_basis) == pytest.approx(left, rel=0.01)
        assert float(found.moisture_dry_basis_highest) == pytest.approx(0.25, abs=1e-3)


def test_gas_and_grains_leave_almost_alike_and_nothing_is_lost() -> None:
    made = bed()
    out = made.outlets
    found = closure([FEED, GAS], [out.product, out.exhaust])
    assert max(float(found.mass), float(found.energy)) < 1e-9
    assert abs(float(out.product.temperature - out.exhaust.temperature)) < 2.0
    assert 288.0 < float(out.exhaust.temperature) < 423.0


def test_the_spout_is_that_of_its_own_laws() -> None:
    """Depth, gas and pressures of the moist grains, by hand from the cards."""
    made = bed()
    found, X = made.figures, float(made.figures.moisture_dry_basis)
    water = float(made.outlets.product.liquid_density)
    volume = 1.0 / 1310.0 + X / water
    grain = {"particle_density": (1.0 + X) / volume, "fluid_density": float(made.outlets.exhaust.gas_density)}
    depth = fl.bed_depth_cone_cylinder(45.0 * volume / 0.58, diameter=0.45, inlet_diameter=0.06)
    assert float(found.bed_depth) == pytest.approx(float(depth))
    size = float(np.asarray(WHEAT.sizes)[0])
    least = fl.minimum_spouting_velocity_mathur_gishler(
        size, **grain, diameter=0.45, inlet_diameter=0.06, bed_depth=depth
    )
    assert float(found.minimum_spouting_velocity) == pytest.approx(float(least))
    assert checked(made, "minimum spouting").value == pytest.approx(
        float(found.superficial_velocity / least), rel=1e-6
    )
    assert float(found.spouting_pressure_drop) < float(found.starting_pressure_drop)
    bound = 45.0 * (1.0 + X) * 9.80665 / (0.25 * np.pi * 0.45**2)  # the whole weight over the whole section
    assert 0.5 * bound < float(found.spouting_pressure_drop) < bound


def test_what_does_not_spout_is_told() -> None:
    ordinary = bed()
    assert all(c.ok for c in ordinary.checks), [c.name for c in ordinary.checks if not c.ok]
    assert not checked(bed(gas=GAS.part(gas=0.5)), "minimum spouting").ok
    assert not checked(bed(vessels=4.0), "minimum spouting").ok
    made = bed(inlet=0.16)
    assert not checked(made, "vessel over that of the inlet").ok
    assert not checked(made, "inlet over that of the grains").ok


def test_a_jet_wider_than_its_vessel_is_no_dryer() -> None:
    with pytest.raises(ConvergenceError, match="narrower than its vessel"):
        gr.alone("drying.spouted_bed_dryer", inlet_diameter="2 m").solve()


def test_in_time_it_is_refused() -> None:
    unit = SpoutedBedDryer(0.45, 0.06, 45.0, SLOW)
    with pytest.raises(InputError, match="ages of its particles"):
        unit.dynamic(FEED, GAS, 10.0, unit.inlet(FEED, GAS))


@pytest.mark.long
def test_sized_for_a_moisture_it_takes_as_many_vessels_as_its_gas_makes_spout() -> None:
    feed, gas = wet(WHEAT, 0.15, 0.25, 288.0), air(WHEAT, 0.55, 0.008, 423.0)
    unit = SpoutedBedDryer.size(0.19, feed, gas, 0.45, 0.06, SLOW)
    made = unit.operate(feed=feed, gas=gas)
    assert float(made.figures.moisture_dry_basis) == pytest.approx(0.19, rel=1e-6)
    assert float(unit.parallel_number) > 1.0
    assert checked(made, "minimum spouting").ok


def test_petersons_peas_dry_in_the_air_that_spouts_them() -> None:
    """Almost two short tons an hour through 8.8 % of moisture in two feet (abstract, read), the example; what
    the air loses is what the water takes and what warms the grains, by hand.
    """
    run = gr.read("examples/dryers/spouted-bed.toml").solve()
    unit, out = run.units["bed"], run.streams["dry_peas"]
    assert all(c.ok for c in unit.checks), [c.name for c in unit.checks if not c.ok]
    feed = run.streams["harvest"]
    wet = [float(s.liquid_flow / (s.solid_flow + s.liquid_flow)) for s in (feed, out)]
    assert wet[0] - wet[1] == pytest.approx(0.088, abs=0.003)
    assert 0.95 < 3600.0 * float(feed.mass_flow) / (4000.0 * 0.45359237) < 1.0
    T = float(out.temperature) - 273.15
    given = 0.99 * 2500.0 * 1.01 * (282.0 - T) + 0.01 * 2500.0 * 1.9 * (282.0 - T)  # kJ/h
    taken = float(unit.values.evaporation_rate) * 3600.0 * (2501.0 + 1.86 * T - 4.19 * 15.0)
    taken += (1340.0 * 1.6 + float(out.liquid_flow) * 3600.0 * 4.19) * (T - 15.0)
    assert given == pytest.approx(taken, rel=0.03)
