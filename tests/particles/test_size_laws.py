"""Size laws, shapes, means of discrete sizes, sieves and partition curves against outside numbers."""

from __future__ import annotations

import jax
import jax.numpy as jnp
import numpy as np
import pytest
from scipy import stats

from granum.core.errors import InputError
from granum.particles import partition, size_laws
from granum.particles.formulas import means, shapes, sizes
from granum.particles.sieves import aperture, sieve_series_apertures, sieve_table

X = np.array([5e-6, 30e-6, 90e-6, 250e-6])


@pytest.mark.parametrize(
    ("law", "peer"),
    [
        (size_laws.RosinRammler(1e-4, 1.4), stats.weibull_min(1.4, scale=1e-4)),
        (size_laws.LogNormal(8e-5, 1.9), stats.lognorm(np.log(1.9), scale=8e-5)),
        (size_laws.Normal(1e-4, 4e-5), stats.truncnorm(-2.5, np.inf, loc=1e-4, scale=4e-5)),
        (size_laws.GatesGaudinSchuhmann(3e-4, 0.8), stats.powerlaw(0.8, scale=3e-4)),
        (size_laws.GaudinMeloy(3e-4, 2.5), stats.beta(1.0, 2.5, scale=3e-4)),
    ],
)
def test_law_equals_the_known_distribution(law, peer) -> None:
    np.testing.assert_allclose(law(X), peer.cdf(X), rtol=1e-9)
    np.testing.assert_allclose(law.density(X), peer.pdf(X), rtol=1e-9)
    np.testing.assert_allclose(
        law.percentile(np.array([0.1, 0.5, 0.9])), peer.ppf([0.1, 0.5, 0.9]), rtol=1e-9
    )
    for k in (1, 2):
        assert float(law.moment(k)) == pytest.approx(peer.moment(k), rel=1e-5)


def test_moment_means_do_not_depend_on_the_basis_a_log_normal_is_written_in() -> None:
    s2 = np.log(2.0) ** 2
    by_volume = size_laws.LogNormal(1e-4, 2.0, "volume")
    by_number = size_laws.LogNormal(1e-4 * np.exp(-3 * s2), 2.0, "number")
    for p, q in ((1, 0), (3, 2), (4, 3)):
        assert float(by_volume.mean(p, q)) == pytest.approx(float(by_number.mean(p, q)), rel=1e-12)
        card = means.mean_diameter_hatch_choate(1e-4, 2.0, p, q)
        assert float(by_volume.mean(p, q)) == pytest.approx(card, rel=1e-12)
    assert means.median_diameter_hatch_choate(1e-4, 2.0, "volume", "number") == pytest.approx(
        1e-4 * np.exp(-3 * s2), rel=1e-12
    )


def test_moments_that_do_not_exist_are_infinite_not_numbers() -> None:
    assert float(size_laws.RosinRammler(1e-4, 0.9).moment(-1.0)) == np.inf
    assert float(size_laws.GatesGaudinSchuhmann(1e-4, 0.8).moment(-1.0)) == np.inf
    assert float(size_laws.GaudinMeloy(1e-4, 2.0).moment(-1.0)) == np.inf
    assert np.isnan(float(size_laws.GaudinMeloy(1e-4, 2.0).mean(3, 2)))


def test_classes_keep_the_tails_and_the_mean() -> None:
    law = size_laws.RosinRammler(1e-4, 1.4)
    d = law.classes(size_laws.geometric_edges(1e-7, 2e-3, 800))
    assert float(d.fractions.sum()) == pytest.approx(1.0, abs=1e-12)
    assert float(d.mean(4, 3)) == pytest.approx(float(law.mean(4, 3)), rel=1e-4)
    assert float(law.classes([1e-5, 5e-5, 6e-5]).fractions[0]) == pytest.approx(float(law(5e-5)), rel=1e-12)


def test_mixture_percentile_and_basis_error() -> None:
    mix = size_laws.Mixture(size_laws.LogNormal(1e-5, 1.5), size_laws.RosinRammler(1e-4, 2.0), 0.3)
    for part in (0.01, 0.3, 0.6, 0.99):
        assert float(mix(mix.percentile(part))) == pytest.approx(part, abs=1e-9)
    with pytest.raises(InputError, match="different bases"):
        size_laws.Mixture(size_laws.LogNormal(1e-5, 1.5, "number"), size_laws.RosinRammler(1e-4, 2.0), 0.3)


def test_sphericities_of_regular_solids_as_tabulated() -> None:
    # Wadell's values as every handbook prints them
    printed = {
        "tetrahedron": 0.671,
        "cube": 0.806,
        "octahedron": 0.846,
        "dodecahedron": 0.910,
        "icosahedron": 0.939,
        "hemisphere": 0.840,
    }
    for shape, value in printed.items():
        assert shapes.sphericity_regular(shape) == pytest.approx(value, abs=6e-4)
    assert shapes.sphericity_regular("sphere") == pytest.approx(1.0, rel=1e-12)
    # handbooks: cylinder h = 2r 0.874, disk h = r/3 0.594 (exact: 0.5953)
    assert shapes.sphericity_cylinder(1.0) == pytest.approx(0.874, abs=5e-4)
    assert shapes.sphericity_cylinder(1.0 / 6.0) == pytest.approx(0.594, abs=2e-3)
    assert shapes.sphericity_spheroid(1.0) == pytest.approx(1.0, rel=1e-9)
    a = np.array([0.999, 0.9999, 1.0001, 1.001])
    assert np.all(np.abs(np.asarray(shapes.sphericity_spheroid(a)) - 1.0) < 1e-6)


def test_volume_and_surface_give_the_same_sphericity_as_the_two_diameters() -> None:
    v, s = 2.3e-12, 1.4e-7
    two = shapes.sphericity_diameters(
        sizes.equivalent_diameter_volume(v), sizes.equivalent_diameter_surface(s)
    )
    assert shapes.sphericity_volume_surface(v, s) == pytest.approx(two, rel=1e-12)
    assert sizes.equivalent_diameter_surface_volume(v, s) == pytest.approx(
        two * sizes.equivalent_diameter_volume(v), rel=1e-12
    )


def test_stokes_diameter_flags_a_fast_particle_and_takes_a_rising_one() -> None:
    inputs = {"particle_density": 2650.0, "fluid_density": 1000.0, "dynamic_viscosity": 1e-3}
    assert not sizes.equivalent_diameter_stokes.evaluate(terminal_velocity=1e-4, **inputs).notices
    assert sizes.equivalent_diameter_stokes.evaluate(terminal_velocity=0.1, **inputs).notices
    rising = sizes.equivalent_diameter_stokes(1e-4, 900.0, 1000.0, 1e-3)
    assert rising == pytest.approx((18e-3 * 1e-4 / (100.0 * 9.80665)) ** 0.5, rel=1e-12)


def test_discrete_means_agree_with_the_general_one_on_any_basis() -> None:
    x, n = np.array([3.0, 6.0, 12.0, 24.0]) * 1e-6, np.array([5.0, 3.0, 2.0, 1.0])
    for name, p, q in (
        ("number_length", 1, 0),
        ("number_surface", 2, 0),
        ("number_volume", 3, 0),
        ("surface_volume", 3, 2),
        ("length_surface", 2, 1),
        ("length_volume", 3, 1),
    ):
        special = getattr(means, f"mean_diameter_{name}")(x, n)
        assert special == pytest.approx(means.mean_diameter_moment_ratio(x, n, p, q), rel=1e-12)
        assert special == pytest.approx(
            means.mean_diameter_moment_ratio(x, n * x**3, p, q, "volume"), rel=1e-12
        )
    assert means.mean_diameter_harmonic(x, n * x**3) == pytest.approx(
        means.mean_diameter_surface_volume(x, n), rel=1e-12
    )
    assert means.mean_diameter_mass(x, n * x**3) == pytest.approx(
        means.mean_diameter_moment_ratio(x, n, 4, 3), rel=1e-12
    )
    assert means.mean_diameter_moment_ratio(x, n, 0, 0) == pytest.approx(
        np.exp(np.sum(n * np.log(x)) / n.sum()), rel=1e-12
    )


def test_sieves_by_designation_agree_with_a_peer() -> None:
    import fluids.particle_size_distribution as peer

    iso = {s.designation: s.opening for s in peer.ISO_3310_1_sieves.values()}
    table = sieve_table()
    ours = {**table["iso565_r20"], **table["iso565_r40_3"], **table["iso565_r10"]}
    assert set(ours) == set(iso)
    for designation, opening in iso.items():
        assert ours[designation] == pytest.approx(opening, rel=1e-9)
    for sieve in peer.ASTM_E11_sieves.values():
        assert aperture(sieve.old_designation.replace("1.00 in", "1 in")) == pytest.approx(
            sieve.opening, rel=1e-9
        )
    assert aperture("65 mesh", "tyler") == pytest.approx(208e-6)
    np.testing.assert_allclose(
        sieve_series_apertures("iso565_r20_3", 45e-6, 90e-6).aperture, [45e-6, 63e-6, 90e-6]
    )
    with pytest.raises(InputError, match="'201'"):
        aperture("No. 201")
    with pytest.raises(InputError, match="No sieve"):
        sieve_series_apertures("tyler", "1 um", "2 um")


CURVES = [
    partition.LogisticPartition(1e-4, 3.0),
    partition.RosinRammlerPartition(1e-4, 2.0),
    partition.WhitenPartition(1e-4, 4.0),
    partition.MolerusHoffmannPartition(1e-4, 0.8),
]


@pytest.mark.parametrize("curve", CURVES)
def test_partition_curves_rise_from_0_to_1_through_one_half(curve) -> None:
    x = jnp.geomspace(1e-7, 1e-2, 200)
    g = curve(x)
    assert float(curve(1e-4)) == pytest.approx(0.5, abs=1e-9)
    assert bool(jnp.all(jnp.diff(g) >= -1e-15))
    assert float(g[0]) < 2e-3
    assert float(g[-1]) > 0.999
    assert float(curve(curve.size_at(0.8))) == pytest.approx(0.8, rel=1e-8)
    assert bool(jnp.all(jnp.isfinite(jax.vmap(jax.grad(curve))(jnp.concatenate([jnp.zeros(1), x])))))
    bypassed = partition.BypassedPartition(curve, 0.25)
    assert float(bypassed(1e-9)) == pytest.approx(0.25, abs=1e-3)
    assert float(bypassed(1e-4)) == pytest.approx(0.625, abs=1e-9)
    sizes = np.array([2e-5, 1e-4, 3e-4])
    np.testing.assert_allclose(
        partition.partition_number_reduced(bypassed(sizes), 0.25), curve(sizes), rtol=1e-9
    )


def test_sharpness_of_the_logistic_curve_is_nine_to_the_minus_one_over_n() -> None:
    curve = partition.LogisticPartition(1e-4, 3.0)
    index = partition.sharpness_index(float(curve.size_at(0.25)), float(curve.size_at(0.75)))
    assert index == pytest.approx(9.0 ** (-1.0 / 3.0), rel=1e-9)
    assert float(partition.LogisticPartition.from_sharpness_index(1e-4, index).sharpness) == pytest.approx(
        3.0, rel=1e-9
    )


def test_whiten_fish_hook_keeps_the_cut_size_and_dips() -> None:
    curve = partition.WhitenPartition(1e-4, 4.0, fishhook_parameter=0.5, bypass_fraction=0.4)
    # at the corrected cut size half of what is classified goes coarse: 0.4 + 0.6 / 2
    assert float(curve(1e-4)) == pytest.approx(0.7, abs=1e-9)
    assert float(curve(1e-9)) == pytest.approx(0.4, abs=1e-3)
    assert float(curve(3e-5)) < 0.4
