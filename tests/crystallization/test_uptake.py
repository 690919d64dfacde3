"""Impurity shared between crystals and mother liquor, against the definition and a formula of dry product."""

from __future__ import annotations

import jax.numpy as jnp
import numpy as np
import pytest
from tests.sharing.places import EXAMPLES

import granum as gr
from granum.cases import read_text
from granum.core.errors import CaseError, InputError
from granum.crystallization.equipment.uptake import ImpurityUptake
from granum.crystallization.formulas.purity import purity_of_crystals
from granum.streams.from_materials import mixture_of, taken_up_name
from granum.streams.stream import Stream, empty

LIQUIDS = ["water", "potassium nitrate", "sodium chloride"]


def magma(*solids: str) -> Stream:
    """2 kg of crystals in 10 kg of water with 3 kg of nitrate and 0.5 kg of salt."""
    mixture = mixture_of(LIQUIDS, ["potassium nitrate", *solids], [], np.geomspace(1e-5, 1e-3, 5))
    blank = empty(mixture, 300.0)
    return blank.replace(liquid=jnp.array([10.0, 3.0, 0.5]), solid=blank.solid.at[0].set(0.5))


def test_the_lattice_keeps_the_homogeneous_distribution_of_iupac() -> None:
    # K = b (a0 - a) / (a (b0 - b)), a of the micro-component and b of the main one left in solution
    product = ImpurityUptake(0.05)(feed=magma("sodium chloride in crystals")).product
    a0, a, b0, b = 0.5, float(product.liquid[2]), 3.0 + 2.0, float(product.liquid[1])
    assert b * (a0 - a) / (a * (b0 - b)) == pytest.approx(0.05, rel=1e-9)


def test_purity_is_that_of_dry_crystals_without_adhering_liquor_and_a_second_unit_changes_nothing() -> None:
    unit = ImpurityUptake(0.05, inclusion_fraction=0.01)
    feed = magma(*map(taken_up_name, LIQUIDS))
    found = unit.operate(feed=feed)
    product, T = found.outlets.product, feed.temperature
    assert float(product.mass_flow) == pytest.approx(float(feed.mass_flow), rel=1e-12)
    assert float(product.enthalpy_flow) == pytest.approx(float(feed.enthalpy_flow), rel=1e-9)
    shares = product.liquid_fractions
    density = 1.0 / jnp.sum(shares / feed.mixture.densities("liquids", T))
    dry = purity_of_crystals(
        shares[2],
        shares[1],
        0.05,
        0.01,
        0.0,
        0.0,
        feed.mixture.densities("solids", T)[0],
        density,
    )
    assert float(found.figures.impurity_fraction_product) == pytest.approx(
        float(dry.impurity_fraction_product), rel=1e-9
    )
    again = unit(feed=product).product
    np.testing.assert_allclose(again.liquid, product.liquid, rtol=1e-12)
    np.testing.assert_allclose(again.solid, product.solid, rtol=1e-12)


def test_a_mixture_without_a_place_for_inclusions_is_refused_in_words() -> None:
    with pytest.raises(CaseError, match="water in crystals"):
        ImpurityUptake(0.05, inclusion_fraction=0.01)(feed=magma("sodium chloride in crystals"))


LINE = """
title = "Cake with impurity"
[mixture]
liquids = ["water", "potassium nitrate", "sodium chloride"]
solids = ["potassium nitrate", "sodium chloride", "sodium chloride in crystals"]
gases = ["dry air", "water"]
sizes = { smallest = "20 um", largest = "3 mm", classes = 8 }
[feeds.magma]
to = "uptake.feed"
temperature = "28 degC"
liquid_flow = "3 t/h"
liquid = { water = "68 %", "potassium nitrate" = "27 %", "sodium chloride" = "5 %" }
solid_flow = "800 kg/h"
solid = { "potassium nitrate" = 1.0 }
sizes = { law = "log_normal", median_diameter = "400 um", geometric_standard_deviation = 1.6 }
[feeds.wash_water]
to = "filter.wash"
temperature = "20 degC"
liquid_flow = "400 kg/h"
liquid = { water = 1.0 }
[feeds.air]
to = "dryer.gas"
temperature = "110 degC"
gas_flow = "8 t/h"
gas = { "dry air" = 0.99, water = 0.01 }
[units.uptake]
model = "crystallization.impurity_uptake"
distribution_coefficient_solution = 0.02
solid = "potassium nitrate"
impurity = "sodium chloride"
[units.filter]
model = "filtration.horizontal_belt_filter"
area = "1 m2"
pressure_drop = "0.4 bar"
cake_resistance = 1e8
void_fraction = 0.45
medium_resistance = 1e9
belt_length = "3 m"
belt_speed = "2 m/min"
[units.dryer]
model = "drying.well_mixed_dryer"
residence_time = "15 min"
gas_velocity = "0.9 m/s"
[streams]
grown = ["uptake.product", "filter.feed"]
filtrate = ["filter.filtrate"]
washings = ["filter.washings"]
cake = ["filter.cake", "dryer.feed"]
crystals = ["dryer.product"]
exhaust = ["dryer.exhaust"]
"""


def test_a_wash_takes_what_adheres_and_leaves_what_the_lattice_holds() -> None:
    """Filter, wash and dryer carry the impurity of the crystals through, with all of it accounted for."""
    washed = read_text(LINE)
    dry = read_text(LINE.replace('"400 kg/h"', '"1e-6 kg/h"'))
    kept = []
    for line in (washed, dry):
        run = line.solve()
        assert max(run.audit["mass_closure"], run.audit["energy_closure"]) < 1e-9
        grown, crystals = (run.streams[n].solid_by_species for n in ("grown", "crystals"))
        assert float(crystals[2] / crystals[0]) == pytest.approx(float(grown[2] / grown[0]), rel=0.2)
        kept.append(float(crystals[1] + run.streams["crystals"].liquid[2]))
    assert kept[0] < 0.5 * kept[1]


def test_what_a_dryer_leaves_needs_a_place_that_is_named() -> None:
    line = read_text(
        LINE.replace('"sodium chloride", "sodium chloride in crystals"', '"sodium chloride in crystals"')
    )
    with pytest.raises(InputError, match="'sodium chloride' is dissolved in the moisture"):
        line.solve()


def test_bromide_of_a_growing_bed_is_what_purge_and_lattice_share() -> None:
    """20 kg/h of sodium bromide leave with 2.09 t/h of liquor, a quarter salt, and 2.0 t/h of crystals that
    take 0.037 of what the liquor has per salt, whatever share of the liquor is taken off.
    """
    run = gr.read(EXAMPLES / "salt-purge" / "line.toml").solve()
    assert max(run.audit["mass_closure"], run.audit["energy_closure"]) < 1e-9
    assert all(check.ok for unit in run.units.values() for check in unit.checks)
    made = run.figure("bed.crystal_flow") * 3600
    assert made == pytest.approx(10000 * 0.256 - 0.27 * (10100 - 6000 - 2000), rel=0.02)
    liquor = 20.0 / (10100 - 6000 - made + made * 0.037 / 0.265)
    assert run.figure("uptake.impurity_fraction_liquor") == pytest.approx(liquor, rel=0.04)
