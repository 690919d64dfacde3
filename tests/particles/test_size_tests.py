"""Sieve, laser, counter and image analyses, and their charts."""

from __future__ import annotations

import io
import runpy

import numpy as np
import pytest
from tests.sharing.places import EXAMPLES

from granum.core.errors import ApplicabilityError, InputError
from granum.particles import charts_sizes
from granum.particles.formulas import means
from granum.particles.in_class import ArithmeticMidpoint
from granum.particles.lab_tests.instruments import ImageAnalysis, LaserDiffraction, ParticleCounter
from granum.particles.lab_tests.sieve_analysis import SieveAnalysis
from granum.particles.partition import LogisticPartition
from granum.particles.size_laws import LogNormal, RosinRammler

SIEVES = np.array([1000, 710, 500, 355, 250, 180, 125, 90, 63]) * 1e-6


def stack(law, mass: float = 0.2, **more) -> SieveAnalysis:
    below = np.asarray(law(SIEVES))
    return SieveAnalysis(
        SIEVES, -np.diff(np.concatenate([[1.0], below])) * mass, pan_mass=float(below[-1] * mass), **more
    )


def test_exact_rosin_rammler_masses_give_back_the_law_in_either_order_of_sieves() -> None:
    test = stack(RosinRammler(3e-4, 1.7), largest_size=2e-3, smallest_size=1e-6)
    fit = test.fit()
    assert fit["size_modulus"].value == pytest.approx(3e-4, rel=1e-9)
    assert fit["distribution_exponent"].value == pytest.approx(1.7, rel=1e-9)
    assert not fit.flags
    turned = SieveAnalysis(
        SIEVES[::-1],
        np.asarray(test.retained_mass)[::-1],
        pan_mass=test.pan_mass,
        largest_size=2e-3,
        smallest_size=1e-6,
    )
    np.testing.assert_allclose(turned.distribution().fractions, test.distribution().fractions)


@pytest.mark.parametrize(
    ("law", "name"),
    [(LogNormal(2.5e-4, 1.8), "log_normal"), (RosinRammler(3e-4, 1.7), "rosin_rammler")],
    ids=["log-normal", "Rosin-Rammler"],
)
def test_intervals_hold_the_truth_under_weighing_noise(law, name) -> None:
    rng = np.random.default_rng(3)
    clean = stack(law)
    noisy = SieveAnalysis(
        SIEVES,
        np.asarray(clean.retained_mass) * rng.normal(1.0, 0.02, SIEVES.size),
        pan_mass=clean.pan_mass,
        size_law=name,
    )
    fit = noisy.fit()
    for parameter, estimate in fit.parameters.items():
        truth = float(getattr(law, parameter))
        assert estimate.value == pytest.approx(truth, rel=0.05)
        assert estimate.standard_error > 0


def test_pan_top_class_and_losses_are_flagged() -> None:
    test = stack(RosinRammler(6e-4, 1.2), sample_mass=0.22)
    words = {(n["flag"], n["name"]) for n in test.fit().flags}
    assert words == {
        ("extrapolated", "pan_mass"),
        ("extrapolated", "largest_size"),
        ("limit active", "sample_mass"),
    }
    assert test.loss_fraction == pytest.approx(1.0 - 0.2 / 0.22, rel=1e-9)


def test_sieve_errors() -> None:
    with pytest.raises(InputError, match="each aperture once"):
        SieveAnalysis([1e-3, 5e-4, 7e-4], [0.1, 0.1, 0.1]).distribution()
    with pytest.raises(InputError, match="retained"):
        SieveAnalysis([1e-3, 5e-4, 2e-4], [0.1, -0.1, 0.1])
    with pytest.raises(InputError, match="below the finest"):
        SieveAnalysis([1e-3, 5e-4, 2e-4], [0.1, 0.1, 0.1], pan_mass=0.1, smallest_size=3e-4).distribution()
    with pytest.raises(InputError, match="above the coarsest"):
        SieveAnalysis([1e-3, 5e-4, 2e-4], [0.1, 0.1, 0.1], largest_size=1e-3).distribution()


def test_a_file_with_units_is_read() -> None:
    file = io.StringIO("aperture [um],retained_mass [g]\n500,0\n250,60\n125,30\n")
    test = SieveAnalysis.read(file, pan_mass="10 g", sample_mass="101 g")
    np.testing.assert_allclose(test.distribution().fractions, [0.1, 0.3, 0.6])
    assert test.loss_fraction == pytest.approx(1.0 / 101.0)


def test_wet_sieving_counts_what_was_washed_away_as_fines() -> None:
    wet = SieveAnalysis([5e-4, 2.5e-4, 1.25e-4], [0.0, 0.05, 0.03], sample_mass=0.1, washed=True)
    np.testing.assert_allclose(wet.distribution().fractions, [0.2, 0.3, 0.5])
    assert wet.loss_fraction == pytest.approx(0.0, abs=1e-12)
    with pytest.raises(InputError, match="dry mass"):
        SieveAnalysis([5e-4, 2.5e-4, 1.25e-4], [0.0, 0.05, 0.03], washed=True).distribution()


def test_surface_and_number_of_crushed_quartz_as_printed() -> None:
    # McCabe, Smith and Harriott, screen analysis of crushed quartz: 3.309 mm2/mg for the sieved part,
    # sphericity 0.571, 2650 kg/m3
    # and 4148 particles in the 0.9925 g of it that a gram holds, of volume 0.8 D³; masses of the classes in
    # grams
    sizes = "4.013 2.8445 2.0065 1.4095 1.0005 0.711 0.503 0.356 0.2515 0.1775 0.1255 0.089 mm"
    masses = "2.51 12.5 32.07 25.7 15.9 5.38 2.1 1.02 0.77 0.58 0.41 0.31 g"
    number = means.number_per_mass(sizes, masses, particle_density=2650, volume_shape_factor=0.8)
    assert 0.9925 * float(number) == pytest.approx(4148e3, rel=0.005)
    with pytest.raises(ApplicabilityError, match="amounts of all classes are zero"):
        means.mean_diameter_harmonic([1e-3, 2e-3], [0.0, 0.0])
    data = EXAMPLES / "size-analysis" / "crushed_quartz_mccabe2005.csv"
    test = SieveAnalysis.read(data, in_class=ArithmeticMidpoint(), sphericity=0.571, solid_density=2650)
    assert test.fit()["specific_surface_mass"].value == pytest.approx(3.309, abs=2e-3)


def test_laser_curve_and_its_errors() -> None:
    law = LogNormal(2e-5, 2.0)
    sizes = np.geomspace(5e-7, 5e-4, 25)
    curve = np.array(law(sizes))
    curve[-1] = 1.0
    fit = LaserDiffraction(sizes, curve, smallest_size=1e-7).fit()
    assert fit["median_diameter"].value == pytest.approx(2e-5, rel=1e-3)
    assert fit["percentile_50"].value == pytest.approx(2e-5, rel=0.02)
    with pytest.raises(InputError, match="ends at"):
        LaserDiffraction([1e-6, 2e-6, 3e-6], [0.0, 0.5, 0.9]).distribution()
    with pytest.raises(InputError, match="must increase"):
        LaserDiffraction([1e-6, 3e-6, 2e-6], [0.0, 0.5, 1.0]).distribution()


def test_counter_reads_the_table_of_the_course_notes() -> None:
    test = ParticleCounter("2, 4, 8, 16, 32, 64, 128 um", [0, 2.7, 20.3, 50.8, 23.3, 2.7, 0.2])
    assert float(test.summary().mean_diameter_number_length) * 1e6 == pytest.approx(14.475, rel=1e-9)
    assert 1.0e-5 < test.fit()["median_diameter"].value < 1.3e-5
    with pytest.raises(InputError, match="must be 0"):
        ParticleCounter("2, 4, 8 um", [1, 2.7, 20.3]).distribution()


def test_image_means_cover_the_truth_of_a_log_normal_sample() -> None:
    rng = np.random.default_rng(5)
    s = 0.4
    covered = 0
    for _ in range(4):
        fit = ImageAnalysis(rng.lognormal(np.log(1e-5), s, 300)).fit()
        low, high = fit["mean_diameter_surface_volume"].interval_95
        covered += low < 1e-5 * np.exp(2.5 * s**2) < high
    assert covered >= 3
    with pytest.raises(InputError, match="one size"):
        ImageAnalysis([1e-5, 1e-5, 1e-5]).distribution()


def test_charts_are_straight_where_they_should_be() -> None:
    sizes = np.geomspace(2e-5, 2e-4, 8)
    law, other = RosinRammler(1e-4, 1.5), LogNormal(1e-4, 1.6)
    for chart, model in (
        (charts_sizes.rosin_rammler_chart, law),
        (charts_sizes.log_probability_chart, other),
    ):
        points = chart(sizes, np.asarray(model(sizes)), model).data[0]
        assert np.ptp(np.diff(np.asarray(points.y)) / np.diff(np.log(np.asarray(points.x)))) < 1e-9
    figure = charts_sizes.size_distribution_chart(
        "0, 2, 4, 8 um", "10, 40, 50 %", wanted_basis="surface", in_class="midpoint"
    )
    assert len(figure.data) == 3
    drawn = charts_sizes.partition_chart(
        LogisticPartition(1e-4, 3.0), particle_diameter=[5e-5, 2e-4], partition_number=[0.1, 0.9]
    )
    assert len(drawn.data) == 2
    assert len(stack(law).chart().data) == 4


def test_the_example_folder_holds_its_printed_numbers() -> None:
    runpy.run_path(str(EXAMPLES / "size-analysis" / "size_analysis.py"))
