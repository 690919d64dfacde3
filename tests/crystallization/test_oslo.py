"""A fluidized-bed crystallizer from its upflow: equations integrated apart, McCabe's closed form, limits."""

from __future__ import annotations

import math

import jax
import numpy as np
import pytest
from scipy.integrate import quad
from scipy.optimize import brentq

from granum.cases.alone import alone
from granum.core.errors import GranumError
from granum.crystallization.formulas.classified import production_classifying
from granum.crystallization.formulas.growth import PowerLawGrowth
from granum.crystallization.formulas.nucleation import PowerLawNucleation
from granum.crystallization.formulas.solubility_laws import PolynomialSolubility
from granum.crystallization.formulas.upflow import Upflow
from granum.crystallization.vessels.classified_bed import steady_bed
from granum.crystallization.vessels.crystals import Crystal
from granum.crystallization.vessels.msmpr import Feed

SOLUBLE = 0.3
CRYSTAL = Crystal(2100.0, 0.6)
LIQUOR = Upflow(0.03, 1150.0, 1.1e-3)
VOIDS = 0.9, 0.55


def bed(area=3.0, height=0.8, growth=1e-5, order=1.0, solute=0.5, velocity=0.03, coefficient=1e8):
    return steady_bed(
        Feed(solute, 1.0, np.zeros(3)),
        300.0,
        area,
        height,
        Upflow(velocity, LIQUOR.density, LIQUOR.viscosity),
        VOIDS,
        PolynomialSolubility(np.array([SOLUBLE])),
        PowerLawGrowth(growth, order),
        PowerLawNucleation(coefficient, 1.5),
        CRYSTAL,
    )


def falls(size):
    """Terminal velocity by Clift and Gauvin's drag and Rowe's exponent, written anew."""
    d = size * (6.0 * 0.6 / math.pi) ** (1 / 3)

    def over(v):
        re = 1150.0 * v * d / 1.1e-3
        cd = 24 / re * (1 + 0.15 * re**0.687) + 0.42 / (1 + 42500 / re**1.16)
        return cd * 0.75 * 1150.0 * v * v / (950.0 * 9.80665 * d) - 1.0

    v = brentq(over, 1e-9, 10.0)
    w = 0.175 * (1150.0 * v * d / 1.1e-3) ** 0.75
    return v, 2.35 * (2 + w) / (1 + w)


def test_sizes_float_where_the_upflow_holds_them():
    out = bed()
    for size, e in ((out.smallest, 0.9), (out.largest, 0.55)):
        v, n = falls(float(size))
        assert v * e**n == pytest.approx(0.03, rel=0.03)  # the drag laws differ by up to 3 %


def test_the_bed_against_its_equations_integrated_apart():
    """Volume of the bed and crystals in it by adaptive quadrature over the sizes."""
    out = bed(growth=2e-5, order=1.3)
    low, high, c, N = (float(x) for x in (out.smallest, out.largest, out.solute_per_solvent, out.number))
    flow = 0.03 * 3.0 * 1150.0 / (1.0 + c)

    def growth(size):
        there = c + 2100.0 * 0.6 * N * (size**3 - low**3) / flow
        return 2e-5 * (there / SOLUBLE - 1.0) ** 1.3

    falling = jax.jit(lambda size: LIQUOR.falls(size, CRYSTAL))

    def void(size):
        v, n = (float(x) for x in falling(size))
        return (0.03 / v) ** (1.0 / n)

    volume = quad(lambda s: N * 0.6 * s**3 / growth(s) / (1.0 - void(s)), low, high, limit=200)[0]
    held = quad(lambda s: N * 1260.0 * s**3 / growth(s), low, high, limit=200)[0]
    assert volume == pytest.approx(2.4, rel=1e-5)
    assert float(out.held) == pytest.approx(held, rel=1e-5)
    assert float(out.product) == pytest.approx(0.5 - c * 1.0, rel=1e-12)
    inlet = c + 2100.0 * 0.6 * N * (high**3 - low**3) / flow
    assert float(out.supersaturation_inlet) == pytest.approx(inlet / SOLUBLE - 1.0, rel=1e-9)


def test_with_much_circulation_it_is_the_classifying_crystallizer_of_mccabe():
    """P = 4 G M_T / L_p, of which the crystals below the smallest of the bed take their fourth power."""
    out = bed(area=3e3, height=8e-4, growth=1e-7)
    G = (out.largest - out.smallest) / out.time
    ideal = production_classifying(G, out.largest, out.held / 2.4, 2100.0, 0.6).production_per_volume
    share = 1.0 - (out.smallest / out.largest) ** 4
    assert float(out.product) / 2.4 == pytest.approx(float(ideal / share), rel=2e-3)


@pytest.mark.long
def test_more_bed_leaves_less_in_the_liquor_and_more_upflow_grows_larger_crystals():
    small, large = bed(height=0.4), bed(height=1.2)
    assert small.relative_supersaturation > large.relative_supersaturation
    assert large.product > small.product
    assert bed(velocity=0.05).largest > bed(velocity=0.03).largest
    slope = jax.grad(lambda h: bed(height=h).product)(0.8)
    step = (bed(height=0.8 + 1e-5).product - bed(height=0.8 - 1e-5).product) / 2e-5
    assert float(slope) == pytest.approx(float(step), rel=1e-4)


def test_an_undersaturated_feed_gives_no_crystals():
    out = bed(solute=0.2)
    assert float(out.product) == 0.0 == float(out.held)
    assert float(out.solute_per_solvent) == pytest.approx(0.2)


def test_the_unit_closes_and_says_what_it_cannot():
    run = alone("crystallization.oslo_crystallizer").solve()
    assert max(run.audit["mass_closure"], run.audit["energy_closure"]) < 1e-9
    found = run.units["oslo_crystallizer"].values
    assert found.carrying_velocity > 0.03  # the smallest crystals of the bed are not carried off
    for words, said in (
        ({"superficial_velocity": "5 m/s"}, "slower upflow"),
        ({"void_fraction_bottom": 0.95}, "denser at its bottom"),
    ):
        with pytest.raises(GranumError, match=said):
            alone("crystallization.oslo_crystallizer", **words).solve()
    starved = alone(
        "crystallization.oslo_crystallizer",
        nucleation={"law": "secondary_nucleation", "nucleation_coefficient": 1e5, "nucleation_order": 1.78},
    ).solve()
    assert [c.name for c in starved.units["oslo_crystallizer"].checks if not c.ok] == [
        "nuclei born over those needed"
    ]
