"""Critical nuclei, the ΔL law, the product-classifying crystallizer and balances by the name of the solute,
against textbooks.
"""

from __future__ import annotations

import numpy as np
import pytest

from granum.core.errors import ApplicabilityError
from granum.crystallization.formulas.balances import crystallizer_balance_library
from granum.crystallization.formulas.batch_balances import crystallizer_batch_balance
from granum.crystallization.formulas.classified import population_density_classified, production_classifying
from granum.crystallization.formulas.critical_nucleus import (
    critical_nucleus,
    critical_nucleus_melt,
    critical_radius,
)
from granum.crystallization.formulas.msmpr import (
    nucleation_rate_msmpr,
    nuclei_population_density,
    population_density,
)
from granum.crystallization.formulas.nucleation import (
    nucleation_barrier,
    nucleation_rate_classical,
    nucleation_rate_secondary,
    supersaturation_ratio_nucleation,
)
from granum.crystallization.formulas.seeding import grown_seed, product_size_from_seed


def test_gold_of_callister():
    """Callister, Materials Science and Engineering, example 10.1: 1.32 nm, 9.64e-19 J; 137 cells of 0.413 nm
    with four atoms each.
    """
    gold = critical_nucleus_melt(230.0, 0.132, 1.16e9 * 196.97e-3 / 19300, 1337.0, 19300.0, 196.97e-3)
    assert gold.critical_radius == pytest.approx(1.32e-9, rel=3e-3)
    assert gold.nucleation_energy == pytest.approx(9.64e-19, rel=5e-3)
    assert gold.molecules_in_nucleus == pytest.approx(137 * 4, rel=0.05)
    deeper = critical_nucleus_melt(460.0, 0.132, 1.16e9 * 196.97e-3 / 19300, 1337.0, 19300.0, 196.97e-3)
    assert deeper.nucleation_energy == pytest.approx(gold.nucleation_energy / 4)


def test_nucleus_in_solution_agrees_with_the_barrier_over_kt():
    found = critical_nucleus(4.0, 0.01, 2000.0, 0.120443, 298.15)
    assert found.critical_radius == pytest.approx(float(critical_radius(4.0, 0.01, 2000.0, 0.120443, 298.15)))
    assert found.nucleation_energy / (1.380649e-23 * 298.15) == pytest.approx(
        float(nucleation_barrier(4.0, 0.01, 2000.0, 0.120443))
    )
    with pytest.raises(ApplicabilityError):
        critical_nucleus(0.9, 0.01, 2000.0, 0.120443)


def test_supersaturation_for_a_rate():
    """Water vapor of Volmer and Flood by hand: at 275.2 K, 75.2 mN/m, 1e25 and 1 1/(cm³ s) ln β = 1.420; the
    rate gives the ratio back.
    """
    water = (0.0752, 1000.0, 18.015e-3, 1e31, 275.2)
    assert np.log(supersaturation_ratio_nucleation(1e6, *water)) == pytest.approx(1.420, rel=2e-3)
    salt = (0.01, 2000.0, 0.12, 1e32, 300.0, 2.0, 0.3)
    rates = np.array([1e2, 1e10, 1e25])
    assert nucleation_rate_classical(supersaturation_ratio_nucleation(rates, *salt), *salt) == pytest.approx(
        rates
    )
    with pytest.raises(ApplicabilityError):
        supersaturation_ratio_nucleation(1e33, *salt)


def test_delta_l_law():
    """One size gives the cube root of the masses; two sizes the real root of the cubic, by the roots of its
    polynomial.
    """
    one = grown_seed([100e-6], [1.0], 1.0, 125.0)
    assert one.size_increase + 100e-6 == pytest.approx(float(product_size_from_seed(100e-6, 1.0, 125.0)))
    sizes, share, ratio = np.array([0.2e-3, 0.5e-3, 0.8e-3]), np.array([0.3, 0.5, 0.2]), 9.0
    cubic = [np.sum(share / sizes**3), 3 * np.sum(share / sizes**2), 3 * np.sum(share / sizes), 1.0 - ratio]
    gain = next(r.real for r in np.roots(cubic) if abs(r.imag) < 1e-12 and r.real > 0)
    found = grown_seed(sizes, share, 2.0, 2.0 * ratio)
    assert found.size_increase == pytest.approx(gain, rel=1e-9)
    assert float(np.sum(found.class_fractions_product)) == pytest.approx(1.0)
    assert np.all(np.diff(found.class_sizes_product) == pytest.approx(np.diff(sizes)))
    with pytest.raises(ApplicabilityError, match="mass of product"):
        grown_seed(sizes, share, 2.0, 1.0)


def test_classifying_crystallizer_of_mccabe():
    """McCabe, Smith and Harriott, ch. 27: copper sulfate pentahydrate of 1.4 mm at 0.2 µm/s; by hand n = B0/G
    is constant up to the product size.
    """
    out = production_classifying(0.2e-6, 1.4e-3, 0.35 * 2300.0, 2300.0, 0.2)
    assert out.production_per_volume * 3600 == pytest.approx(4 * 0.2e-6 * 3600 * 0.35 * 2300 / 1.4e-3)
    magma = 0.2 * 2300.0 * out.nucleation_rate / 0.2e-6 * 1.4e-3**4 / 4
    assert magma == pytest.approx(0.35 * 2300.0)


def test_balance_by_the_name_of_the_solute():
    """Coulson and Richardson vol. 2, ch. 15: 500 kg of Na2SO4 in 2500 kg of water, 333 to 283 K, 2 %
    evaporates: 722 kg of decahydrate and 596 MJ without the vessel, with 8.9 kg per 100 kg of water and a
    heat of solution of 78.5 MJ/kmol. Geankoplis: 6370 kg of soda with 21.5 kg per 100 kg.
    """
    salt = crystallizer_balance_library(3000.0, 500 / 3000, 283.0, 333.0, "sodium sulfate decahydrate", 50.0)
    assert salt.crystal_flow == pytest.approx(722, rel=0.015)
    assert salt.heat_duty / 1e6 == pytest.approx(-(540 + 722 * 78.5 / 322 - 50 * 2.395), rel=0.03)
    assert salt.crystal_per_solute == pytest.approx(322.2 / 142.04, rel=1e-3)
    soda = crystallizer_balance_library(10000.0, 0.30, 293.15, 293.15, system="Na2CO3·10H2O")
    assert soda.crystal_flow == pytest.approx(6370, rel=0.02)
    assert np.isnan(crystallizer_balance_library(1.0, 0.2, 283.15, 300.0, system="borax").heat_duty)


def test_charges_of_textbooks():
    """Coulson and Richardson: 1500 kg of potassium chloride saturated at 360 K (53.55 kg per 100 kg) and
    cooled to 290 K (34.5): 534 kg. McCabe, Smith and Harriott: 30 % magnesium sulfate cooled to 60 °F, 5 % of
    the water evaporating, liquor of 24.5 %: 0.261 kg per kg.
    """
    chloride = crystallizer_batch_balance("4301 kg", 53.55 / 153.55, "34.5 g/100 g water")
    assert chloride.crystal_mass == pytest.approx(534, rel=2e-3)
    epsom = crystallizer_batch_balance("1000 kg", 0.30, 0.245 / 0.755, 120.37 / 246.48, "35 kg")
    assert epsom.crystal_mass == pytest.approx(261, rel=2e-3)


def test_ammonium_alum_of_another_program():
    """Crystallizer_Simulator_RZ of mingchunNTU on GitHub (commit 014722a), examples/ammonium alum: 200 kg/m³,
    15 min and B = 9e16 G² M (g/m³) give G = 3.8944423 µm/min and B = 4.55000425e-9 per µm³ and minute.
    """
    growth, births = "3.8944423 um/min", 4.55000425e-9 * 1e18 / 60
    nuclei = nuclei_population_density("200 kg/m3", growth, "15 min", 2450.0, 1.0)
    assert nucleation_rate_msmpr(nuclei, growth) == pytest.approx(births, rel=1e-6)
    law = nucleation_rate_secondary(1.0, 9e16 * (3.8944423e-6 / 60) ** 2 * 1e3, 1.0, magma_density=200.0)
    assert law == pytest.approx(births, rel=1e-6)
    found = population_density_classified("100 um", nuclei, growth, "15 min", 1.0, "10 um", 1.0, "100 um")
    assert found == pytest.approx(float(population_density("100 um", nuclei, growth, "15 min")))
