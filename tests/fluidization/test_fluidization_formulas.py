"""Fluidization formulas against printed worked examples, hand calculation and limits."""

from __future__ import annotations

import numpy as np
import pytest

from granum.core import flags
from granum.core.errors import ApplicabilityError
from granum.fluidization import ranking
from granum.fluidization.formulas import (
    bubbles,
    expansion,
    freeboard,
    heat,
    minimum,
    minimum_beds,
    minimum_powers,
    regimes,
)

SAND = {
    "particle_diameter": 2e-4,
    "particle_density": 2600.0,
    "fluid_density": 1.2,
    "dynamic_viscosity": 1.8e-5,
}


def test_minimum_fluidization_of_printed_examples() -> None:
    # Kunii and Levenspiel, chapter 3: sharp irregular sand, measured and calculated 4.0 cm/s
    sharp = {**SAND, "particle_diameter": 1.6e-4}
    assert minimum_beds.minimum_fluidization_velocity_ergun(
        **sharp, void_fraction=0.55, sphericity=0.67
    ) == pytest.approx(0.040, abs=5e-4)
    # Coulson and Richardson, volume 2, example 6.1: 3 mm spheres of 4200 kg/m³ in a liquid: Re = 40.0,
    # 0.0364 m/s
    heavy = {
        "particle_diameter": 3e-3,
        "particle_density": 4200.0,
        "fluid_density": 1100.0,
        "dynamic_viscosity": 3e-3,
    }
    assert minimum_beds.minimum_fluidization_velocity_ergun(**heavy, void_fraction=0.4) == pytest.approx(
        0.0364, abs=1e-4
    )
    # example 6.2: catalyst in oil, mass flux 0.059 kg/m² s
    oil = {
        "particle_diameter": 1e-4,
        "particle_density": 2600.0,
        "fluid_density": 900.0,
        "dynamic_viscosity": 3e-3,
    }
    assert 900 * minimum_beds.minimum_fluidization_velocity_kozeny_carman(
        **oil, void_fraction=0.48
    ) == pytest.approx(0.059, abs=1e-3)


def test_two_constant_forms_by_hand() -> None:
    # Ar of 200 µm sand in air at 9.80665 m/s², by hand: 755.2; Re = sqrt(a² + b Ar) - a
    Ar = 1.2 * 2598.8 * 9.80665 * 8e-12 / 3.24e-10
    for name, a, b in (
        ("wen_yu", 33.7, 0.0408),
        ("grace", 27.2, 0.0408),
        ("chitester", 28.7, 0.0494),
        ("thonglimp", 31.6, 0.0425),
        ("thonglimp_fine", 19.9, 0.03196),
        ("richardson", 25.7, 0.0365),
        ("bourgeois_grenier", 25.46, 0.0382),
        ("saxena_vogel", 25.28, 0.0571),
        ("babu", 25.25, 0.0651),
    ):
        Re = (a**2 + b * Ar) ** 0.5 - a
        found = getattr(minimum, f"minimum_fluidization_velocity_{name}")(**SAND)
        assert found == pytest.approx(Re * 1.8e-5 / (1.2 * 2e-4), rel=1e-9), name
    # a fine powder keeps its digits: the slope b/(2a) of Stokes' limit
    fine = minimum.minimum_fluidization_velocity_wen_yu(**{**SAND, "particle_diameter": 1e-7})
    assert fine == pytest.approx(0.0408 / 67.4 * 2598.8 * 9.80665 * 1e-14 / 1.8e-5, rel=1e-6)


def test_leva_and_fine_powders() -> None:
    # the notes' general form at ε = 0.4, by hand: 0.005·0.064/0.6 = 5.333e-4 (the print says 0.006)
    U = minimum_beds.minimum_fluidization_velocity_leva(**{**SAND, "particle_diameter": 1e-4})
    assert pytest.approx(5.3333e-4 * 1e-8 * 9.80665 * 2598.8 / 1.8e-5, rel=1e-4) == U
    # the two forms of one author agree within the usual 30 % at ε = 0.4
    power = minimum_powers.minimum_fluidization_velocity_leva_power(**{**SAND, "particle_diameter": 1e-4})
    # converted by hand
    assert power == pytest.approx(9.30e-3 * 1e-4**1.82 * 2598.8**0.94 / (1.8e-5**0.88 * 1.2**0.06), rel=2e-3)
    # Baeyens and Geldart: 9e-4 [gΔρ]^0.934 d^1.8/(η^0.87 ρ^0.066), the constant rounded
    fine = minimum_powers.minimum_fluidization_velocity_baeyens_geldart(**{**SAND, "particle_diameter": 6e-5})
    assert fine == pytest.approx(
        9e-4 * (9.80665 * 2598.8) ** 0.934 * 6e-5**1.8 / (1.8e-5**0.87 * 1.2**0.066), rel=1e-3
    )
    # 60 µm is aeratable
    assert fine < minimum_powers.minimum_bubbling_velocity_abrahamsen_geldart(6e-5, 1.2, 1.8e-5)
    # Riba: 2 mm glass in water by hand, Ga = 78 453, Mv = 1.5
    riba = minimum_powers.minimum_fluidization_velocity_riba(2e-3, 2500.0, 1000.0, 1e-3)
    assert riba == pytest.approx(0.0154 * 78453.2**0.66 * 1.5**0.7 * 5e-4, rel=1e-6)


def test_light_particles_and_spread() -> None:
    found = minimum.minimum_fluidization_velocity_wen_yu.evaluate(
        1e-3, np.array([900.0, 2500.0]), 1000.0, 1e-3
    )
    assert found.flags[0] & flags.OUTSIDE_DOMAIN
    assert np.isnan(found.value[0])
    assert np.isfinite(found.value[1])
    with pytest.raises(ApplicabilityError, match="denser"):
        ranking.minimum_fluidization_spread(1e-3, 900.0, 1000.0, 1e-3)
    spread = ranking.minimum_fluidization_spread(2e-4, 2600.0, 1.2, 1.8e-5)
    assert len(spread.correlation) == 15
    assert np.all(np.diff(spread.minimum_fluidization_velocity) >= 0)
    assert "riba" not in [n for n, inside in zip(spread.correlation, spread.in_range, strict=True) if inside]
    assert 1.3 < spread.spread < 3.0


def test_expansion() -> None:
    water = {
        "particle_diameter": 2e-3,
        "particle_density": 2500.0,
        "fluid_density": 1000.0,
        "dynamic_viscosity": 1e-3,
    }
    e = [
        f(superficial_velocity=0.06, **water)
        for f in (expansion.bed_void_fraction_riba, expansion.bed_void_fraction_wen_yu)
    ]
    # by hand: Re = 120, Ga = 78453, Mv = 1.5; Ar = 117 680
    assert e[0] == pytest.approx(1.58 * 120**0.33 * 78453.2**-0.21 * 1.5**-0.22, rel=1e-6)
    assert e[0] == pytest.approx(e[1], rel=0.1)
    assert e[1] ** 4.7 * 117679.8 == pytest.approx(18 * 120 + 2.7 * 120**1.687, rel=1e-6)
    carried = expansion.bed_void_fraction_richardson_zaki.evaluate(0.2, 0.1, 2.4)
    assert carried.value == 1.0
    assert carried.flags & flags.LIMIT_ACTIVE
    # weight on the grid by both sides: 1 - m/(H A ρ) and Δp/(H g Δρ)
    dp = expansion.pressure_drop_fluidized_bed(50.0, 0.05, 2500.0, 1.2)
    assert dp == pytest.approx(1000.0 * 9.80665 * (2498.8 / 2500))
    assert expansion.bed_void_fraction_from_pressure_drop(dp, 0.8, 2500.0, 1.2) == pytest.approx(
        1 - 50 / (0.8 * 0.05 * 2500)
    )


def test_bubbles_and_slugs() -> None:
    # Mori and Wen in the print's centimeters: D = 50 cm, U - Umf = 20 cm/s, z = 40 cm, porous plate
    largest = 0.652 * (np.pi / 4 * 50**2 * 20) ** 0.4
    by_hand = largest - (largest - 0.00376 * 20**2) * np.exp(-0.3 * 40 / 50)
    assert 100 * bubbles.bubble_diameter_mori_wen(0.25, 0.05, 0.4, 0.5) == pytest.approx(by_hand, rel=1e-9)
    plate = 0.347 * (np.pi / 4 * 50**2 * 20 / 200) ** 0.4
    at_plate = bubbles.bubble_diameter_mori_wen(
        0.25, 0.05, 0.0, 0.5, orifices_per_area=200 / (np.pi / 4 * 0.25)
    )
    assert 100 * at_plate == pytest.approx(plate, rel=1e-9)
    # Werther in centimeters
    assert 100 * bubbles.bubble_diameter_werther(0.25, 0.05, 0.4) == pytest.approx(
        0.853 * (1 + 0.272 * 20) ** (1 / 3) * (1 + 0.0684 * 40) ** 1.21
    )
    # slugging in centimeters: H > 60 D^0.175, shallow bed adds 1.6e-3 (60 D^0.175 - H)² cm/s
    H = 60 * 10**0.175
    assert 100 * regimes.slugging_height(0.1) == pytest.approx(H, rel=3e-3)
    extra = regimes.minimum_slugging_velocity(0.05, 0.1, 0.3) - regimes.minimum_slugging_velocity(0.05, 0.1)
    assert 100 * extra == pytest.approx(1.6e-3 * (H - 30) ** 2, rel=1e-2)


def test_freeboard() -> None:
    # Zenz and Weil's two branches meet at 3e-4 to three digits
    d = 2.0**2 / (9.80665 * 3e-4 * 1500**2)
    low, high = freeboard.elutriation_flux_zenz_weil(np.array([1.9999, 2.0001]), d, 1500.0, 1.2)
    assert high / low == pytest.approx(1.0, rel=3e-3)
    # by hand at X = 1e-4: 1.2·2·1.26e7·1e-4^1.88
    assert freeboard.elutriation_flux_zenz_weil(2.0, 3 * d, 1500.0, 1.2) == pytest.approx(
        2.4 * 1.26e7 * 10**-7.52, rel=1e-9
    )
    # Wen and Hashinger by hand: slip 0.8, Re_t = 0.8, g d = 5.88e-4
    flux = freeboard.elutriation_flux_wen_hashinger(1.0, 0.2, 6e-5, 1501.2, 1.2, 1.8e-5)
    assert flux == pytest.approx(
        1.52e-5 * 1.2 * 0.8 * (0.64 / 5.88399e-4) ** 0.5 * 0.8**0.725 * 1250**1.15, rel=1e-6
    )
    spread = ranking.elutriation_spread(1.0, 0.2, 6e-5, 1500.0, 1.2, 1.8e-5)
    assert len(spread.correlation) == 6
    assert np.all(np.diff(spread.elutriation_flux) >= 0)
    assert len(ranking.disengaging_height_spread(0.5, 0.05, 0.1).correlation) == 6


def test_groups_and_regimes() -> None:
    # Geldart's own examples: cracking catalyst A, 0.1–0.5 mm sand B, peas D; flour-like 5 µm C
    groups = [
        ranking.geldart_group(*p).geldart_group
        for p in ((6e-5, 1400.0), (3e-4, 2600.0), (5e-3, 1300.0), (5e-6, 1500.0))
    ]
    assert groups == ["A", "B", "D", "C"]
    # A–B line of 225 g/cm³ µm: 90 µm at 2.5 g/cm³
    assert ranking.geldart_group(1e-4, 2501.2).border_size[1] == pytest.approx(90e-6, rel=1e-6)
    rising = [
        ranking.fluidization_regime(u, 2e-4, 2600.0, 1.2, 1.8e-5, 0.1).regime
        for u in (0.01, 0.06, 0.3, 2.2, 5.0)
    ]
    assert rising == [
        "fixed bed",
        "bubbling bed",
        "slugging bed",
        "turbulent bed",
        "fast fluidization or transport",
    ]
    # Bi and Grace by hand at Ar = 100: Re_c = 9.850, Re_se = 15.3
    d = (100 * 3.24e-10 / (1.2 * 2598.8 * 9.80665)) ** (1 / 3)
    back = 1.2 * d / 1.8e-5
    assert regimes.turbulent_onset_velocity_bi_grace(d, 2600.0, 1.2, 1.8e-5) * back == pytest.approx(
        9.850, rel=1e-3
    )
    assert regimes.entrainment_onset_velocity_bi_grace(d, 2600.0, 1.2, 1.8e-5) * back == pytest.approx(
        15.3, rel=1e-6
    )


def test_heat_and_distributor() -> None:
    # Gunn at ε = 1: the sphere, 2(1 + 0.7 Re^0.2 Pr^⅓) + 0.13 Re^0.7 Pr^⅓
    e1 = heat.nusselt_number_gunn(100.0, 1.0, 0.999999999)
    assert e1 == pytest.approx(2 * (1 + 0.7 * 100**0.2) + 0.13 * 100**0.7, rel=1e-6)
    # Zabrodsky by hand: 35.8·2600^0.2·0.03^0.6·(3e-4)^-0.36
    assert heat.heat_transfer_coefficient_zabrodsky(3e-4, 2600.0, 0.03) == pytest.approx(
        35.8 * 4.8195 * 0.12198 * 18.546, rel=2e-3
    )
    plate = heat.distributor_design(1e4, 0.4, 1.2, 2e-3)
    assert plate.open_area_fraction * plate.orifice_velocity == pytest.approx(0.4)
    assert plate.orifices_per_area * np.pi / 4 * 4e-6 * plate.orifice_velocity == pytest.approx(0.4)
    assert 0.5 * 1.2 * (plate.orifice_velocity / 0.6) ** 2 == pytest.approx(plate.distributor_pressure_drop)


def test_bubbles_over_a_porous_plate_without_catchment_area() -> None:
    # by hand: 0.54 × 0.25^0.4 × 1^0.8 / 9.80665^0.2 = 0.1965 m at 1 m; Darton's 4√A₀ = 3 cm adds 3 %
    bare = bubbles.bubble_diameter_darton(
        superficial_velocity=0.3, minimum_fluidization_velocity=0.05, height=1.0, catchment_area=0.0
    )
    assert bare == pytest.approx(0.19646, rel=1e-4)
    plate = bubbles.bubble_diameter_darton(
        superficial_velocity=0.3, minimum_fluidization_velocity=0.05, height=1.0, catchment_area="0.5625 cm2"
    )
    assert plate / bare == pytest.approx(1.03**0.8, rel=1e-9)
