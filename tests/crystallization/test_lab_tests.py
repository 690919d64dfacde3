"""Lab tests against printed analyses, and against data made with known parameters."""

from __future__ import annotations

import jax.numpy as jnp
import numpy as np
import pytest
from tests.sharing.crystallization import DENSITY, START, model
from tests.sharing.places import EXAMPLES

from granum.core.errors import InputError
from granum.crystallization.formulas.programs import TemperaturePoints
from granum.crystallization.formulas.solubility_laws import PolynomialSolubility
from granum.crystallization.lab_tests.batch_kinetics import BatchKinetics
from granum.crystallization.lab_tests.induction_time import InductionTime
from granum.crystallization.lab_tests.metastable_zone import MetastableZone, MetastableZoneSangwal
from granum.crystallization.lab_tests.msmpr_analysis import MsmprAnalysis, population_densities
from granum.crystallization.lab_tests.solubility import (
    SolubilityAntisolvent,
    SolubilityApelblat,
    SolubilityPolynomial,
    SolubilityVantHoff,
)
from granum.crystallization.population.lagrangian import SuspensionVolume, march
from granum.crystallization.population.operations import Programmed
from granum.crystallization.vessels.batch import narrow_seeds

# Urea of Bennett and Van Buren as worked in Perry's Handbook: Tyler meshes 14, 20, 28, 35, 48, 65, 100.
EDGES = np.array([1.168, 0.833, 0.589, 0.417, 0.295, 0.208, 0.147])[::-1] * 1e-3
SHARES = np.array([0.044, 0.144, 0.242, 0.316, 0.155, 0.074])[::-1]


def test_msmpr_analysis_of_urea_in_perry():
    """Printed: slope -9.127 1/mm and intercept 19.781 per mm and liter; G = 0.0324 mm/h, B0 = 12.6e6 1/(L h)
    at 3.38 h.
    """
    n = population_densities(
        class_edges=EDGES, class_fractions=SHARES, magma_density=450.0, crystal_density=1335.0
    )
    middle = 0.5 * (EDGES[1:] + EDGES[:-1])
    found = MsmprAnalysis(middle, n, 3.38 * 3600.0, crystal_density=1335.0).fit()
    assert found["growth_rate"].value * 1e3 * 3600 == pytest.approx(0.0324, rel=0.02)
    assert np.log(found["nuclei_population_density"].value / 1e6) == pytest.approx(19.781, abs=0.1)
    assert found["nucleation_rate"].value * 3600 / 1e3 == pytest.approx(12.6e6, rel=0.1)
    assert found["dominant_size"].value == pytest.approx(3 * found["growth_rate"].value * 3.38 * 3600)


def test_msmpr_analysis_refuses_what_is_no_steady_state():
    with pytest.raises(InputError, match="fall"):
        MsmprAnalysis([1e-4, 2e-4, 3e-4], [1e10, 2e10, 3e10], 3600.0).fit()


def test_nyvlt_line_and_kubota_order():
    rate = np.array([2.0, 5.0, 10.0, 20.0]) / 3600
    found = MetastableZone(rate, (rate / 1e-6) ** (1 / 3.5), detected_number_density=1e7).fit()
    assert found["nyvlt_order"].value == pytest.approx(3.5)
    assert found["kubota_order"].value == pytest.approx(2.5)
    # Kubota: N = integral of k (R t)^n dt up to dT gives k = N (n + 1) R / dT^(n+1).
    assert found["kubota_coefficient"].value == pytest.approx(1e7 * 3.5 * 1e-6)


def test_sangwal_gives_back_the_interfacial_energy():
    k, T, H, R, v = 1.380649e-23, 313.15, 25e3, 8.314462618, 1e-28
    B = 16 * np.pi / 3 * (4e-3 * v ** (2 / 3) / (k * T)) ** 3
    rate = np.array([2.0, 5.0, 10.0, 20.0]) / 3600
    width = T / np.sqrt((H / (R * T)) ** 2 / B * (12.0 - np.log(rate)))
    found = MetastableZoneSangwal(rate, width, T, H, 2000.0, 1e-28 * 2000 * 6.02214076e23).fit()
    assert found["interfacial_energy"].value == pytest.approx(4e-3, rel=1e-6)


def test_induction_time_gives_back_the_interfacial_energy():
    k, T, v, gamma = 1.380649e-23, 298.15, 1e-28, 8e-3
    S = np.array([1.5, 2.0, 3.0, 4.0])
    t = 30.0 * np.exp(16 * np.pi / 3 * gamma**3 * v**2 / (k * T) ** 3 / np.log(S) ** 2)
    found = InductionTime(S, t, T, 2000.0, v * 2000 * 6.02214076e23).fit()
    assert found["interfacial_energy"].value == pytest.approx(gamma, rel=1e-6)
    assert found["induction_time_limit"].value == pytest.approx(30.0, rel=1e-6)


def test_solubility_fits_of_potassium_nitrate():
    """CRC solubilities of KNO3, g per 100 g of water at 0 to 60 °C: 13.3, 20.9, 31.6, 45.8, 63.9, 85.5,
    110.
    """
    T = 273.15 + np.arange(0, 70, 10.0)
    c = np.array([13.3, 20.9, 31.6, 45.8, 63.9, 85.5, 110.0]) / 100
    for test in (SolubilityApelblat(T, c, 0.101103), SolubilityPolynomial(T, c)):
        np.testing.assert_allclose(test.law()(T), c, rtol=0.03)
        assert test.fit().statistics["r_squared"] > 0.999
    heat = SolubilityVantHoff(T, c, 0.101103).fit()["enthalpy_of_dissolution"]
    assert 24e3 < heat.value < 33e3
    assert SolubilityApelblat(T, c, 0.101103).fit()["enthalpy_of_dissolution"].value == pytest.approx(
        heat.value, rel=0.05
    )


def test_antisolvent_power_of_ethanol_on_sodium_formate():
    """Heubel and Vandorpe (1962): the fitted law gives the printed mass percentages back; by hand the first
    and last points bound the mean power.
    """
    test = SolubilityAntisolvent.read(EXAMPLES / "antisolvent" / "sodium_formate_heubel1962.csv")
    law = test.law()
    np.testing.assert_allclose(
        law(288.2, np.asarray(test.antisolvent_fraction)), np.asarray(test.solute_per_solvent), rtol=0.025
    )
    assert float(law(288.2)) == pytest.approx(42.1 / 57.9, rel=0.02)
    mean_power = np.log((42.1 / 57.9) / (22.8 / (33.8 + 43.4))) / (33.8 / (33.8 + 43.4))
    assert law.antisolvent_power < mean_power < law.antisolvent_power + 2 * 0.4378 * law.antisolvent_curvature
    assert isinstance(test.chart().data, tuple)


def test_kubota_counts_what_was_born_since_saturation():
    """Births of k ΔT^n per volume while cooling at R reach the detected number at the width of Nývlt's line:
    integrated numerically.
    """
    k, n, number = 2e3, 2.5, 1e8
    rates = np.array([5.0, 10.0, 20.0, 40.0]) / 3600
    widths = []
    for R in rates:
        t = np.linspace(0.0, 60.0 / R, 200001)
        born = np.concatenate(
            [[0.0], np.cumsum(0.5 * k * ((R * t[1:]) ** n + (R * t[:-1]) ** n) * np.diff(t))]
        )
        widths.append(R * np.interp(number, born, t))
    found = MetastableZone(rates, widths, detected_number_density=number).fit()
    assert found["kubota_order"].value == pytest.approx(n, rel=1e-4)
    assert found["kubota_coefficient"].value == pytest.approx(k, rel=2e-3)


@pytest.mark.long
def test_batch_kinetics_finds_the_parameters_that_made_the_data():
    times = np.linspace(0.0, 4800.0, 25)
    program = TemperaturePoints([0.0, 4800.0], [305.15, 301.15])
    fine = jnp.linspace(0.0, 4800.0, 2401)
    true = march(model(), Programmed(program), narrow_seeds(100e-6, 20e-6, 5e-4, DENSITY), START, 1.0, fine)
    at = np.arange(25) * 100
    ratio = np.asarray(true.solute_per_solvent)[at]
    size = np.asarray(true.moments[:, 4] / true.moments[:, 3])[at]
    noise = np.random.default_rng(1)
    test = BatchKinetics(
        times,
        305.15 - 4.0 * times / 4800,
        ratio + 2e-5 * noise.standard_normal(25),
        PolynomialSolubility([0.1286, 5.88e-3, 1.721e-4]),
        DENSITY,
        5e-4,
        100e-6,
        mean_diameter=size * (1 + 2e-3 * noise.standard_normal(25)),
        seed_width=20e-6,
    )
    found = test.fit()
    assert found["growth_order"].value == pytest.approx(1.32, abs=0.1)
    assert found["nucleation_order"].value == pytest.approx(1.78, abs=0.6)
    low, high = found["growth_coefficient"].interval_95
    assert low < 6967e-6 / 60 < high
    low, high = found["nucleation_coefficient"].interval_95
    assert 0.0 < low < np.exp(19.207) < high
    assert isinstance(test.model(found.values).volume, SuspensionVolume)


def test_as_many_class_limits_as_fractions_is_one_message() -> None:
    with pytest.raises(InputError, match="2 class limits and 2 fractions do not go together"):
        population_densities(
            class_edges="[0.833, 1.168] mm",
            class_fractions=[0.5, 0.5],
            magma_density=450,
            crystal_density=1335,
        )
