"""Two-phase theory against its differential balance, graded expansion by hand, the liquid bed against a
printed example.
"""

from __future__ import annotations

import jax.numpy as jnp
import numpy as np
import pytest
from tests.sharing.places import EXAMPLES

from granum.cases import read
from granum.core.errors import ApplicabilityError
from granum.fluidization.equipment.liquid import LiquidFluidizedBed
from granum.fluidization.formulas import bubbles, expansion, freeboard, two_phase
from granum.streams.mixture import Mixture, Species
from granum.streams.stream import empty

FOLDER = EXAMPLES / "fluidized-bed"


def test_two_phase_bed_by_hand_and_limits() -> None:
    # Darton, u_b = U - Umf + 0.711 (g d)^½, exchange of Kunii and Levenspiel, summed by trapezoids; catchment
    # area 1 cm²
    found = two_phase.two_phase_bed(0.5, 0.1, 0.3, 2.5e-5, 0.45, 1e-4)
    g, z = 9.80665, np.linspace(0.0, 0.3, 40001)
    d = 0.54 * 0.4**0.4 * (z + 0.04) ** 0.8 / g**0.2
    u = 0.4 + 0.711 * (g * d) ** 0.5
    K_bc = 4.5 * 0.1 / d + 5.85 * 2.5e-5**0.5 * g**0.25 / d**1.25
    K_ce = 6.77 * (0.45 * 2.5e-5 * 0.711 * (g * d) ** 0.5 / d**3) ** 0.5
    K, share = 1 / (1 / K_bc + 1 / K_ce), 0.4 / u
    X, H = np.trapezoid(K / u / (1 - share), z), np.trapezoid(1 / (1 - share), z)
    half = 20000
    np.testing.assert_allclose(
        found, [d[half], u[half], share[half], H, K[half], X, 0.8 * np.exp(-X)], rtol=1e-6
    )
    # deeper beds and faster diffusion bypass less; a narrow vessel cannot hold larger bubbles
    assert two_phase.two_phase_bed(0.5, 0.1, 0.6, 2.5e-5).transfer_units > found.transfer_units
    assert two_phase.two_phase_bed(0.5, 0.1, 0.3, 1e-4).bypass_fraction < found.bypass_fraction
    assert two_phase.two_phase_bed(0.5, 0.1, 2.0, 2.5e-5, diameter=0.1).bubble_diameter == pytest.approx(0.1)


def test_davidson_harrison_closes_the_balance() -> None:
    # bubbles: dc_b/dz = -X (c_b - c_p); emulsion: U_mf (1 - c_p) + gas exchanged = k H c_p, by midpoint sums
    U, first, X, k, H = 0.5, 0.2, 1.3, 2.0, 0.4
    B = (1 - first / U) * np.exp(-X)
    c = two_phase.unconverted_fraction_davidson_harrison(B, k, H, U)
    steps = 20000
    z = (np.arange(steps) + 0.5) / steps

    def residual(c_p):
        c_b = c_p + (1 - c_p) * np.exp(-X * z)
        exchanged = (U - first) * X * np.mean(c_b - c_p)
        return first * (1 - c_p) + exchanged - k * H * c_p

    low, high = 0.0, 1.0
    for _ in range(60):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if residual(middle) > 0 else (low, middle)
    leaving = (first * low + (U - first) * (low + (1 - low) * np.exp(-X))) / U
    assert c == pytest.approx(leaving, rel=1e-7)


def test_graded_bed() -> None:
    # one class is Richardson and Zaki's bed; mass is kept; a class that does not move keeps the settled void
    # fraction
    sand = {"particle_density": 2650.0, "fluid_density": 1000.0, "dynamic_viscosity": 1e-3}
    one = expansion.graded_bed_expansion(np.array([6e-4]), np.array([1.0]), 0.7, 0.01, **sand)
    assert one.height_expanded * (1 - one.bed_void_fraction[0]) == pytest.approx(0.7 * 0.58, rel=1e-9)
    # by hand: v_t = 0.095 m/s (Schiller and Naumann: 24·57·3.412 = 4668 against 4660); Ergun's U_mf at ε =
    # 0.42 from
    # 1.75/ε³ Re² + 150(1-ε)/ε³ Re = 3495: Re = 2.817, U = 4.695 mm/s; n = ln(0.095/0.004695)/ln(1/0.42) =
    # 3.467
    assert one.bed_void_fraction[0] == pytest.approx((0.01 / 0.095) ** (1 / 3.467), rel=0.005)
    # 36 m/h lift sand of 0.6 mm by a fifth to a third, the usual backwash
    assert 0.15 < one.bed_expansion < 0.35
    both = expansion.graded_bed_expansion(np.array([6e-4, 5e-3]), np.array([0.25, 0.75]), 0.7, 0.01, **sand)
    assert both.bed_void_fraction[1] == pytest.approx(0.42)
    assert both.bed_expansion == pytest.approx(0.25 * one.bed_expansion, rel=1e-9)
    with pytest.raises(ApplicabilityError, match="particle density = 900"):
        expansion.graded_bed_expansion(np.array([6e-4]), np.array([1.0]), 0.7, 0.01, 900.0, 1000.0, 1e-3)
    # between its two ends the law passes through both
    at = {"superficial_velocity": 0.004696, "height": 1.0, **sand}
    assert expansion.graded_bed_expansion(np.array([6e-4]), np.array([1.0]), **at).bed_void_fraction[
        0
    ] == pytest.approx(0.42, abs=1e-3)


SAND = {
    "height": 0.5,
    "particle_density": 2650.0,
    "fluid_density": 1000.0,
    "dynamic_viscosity": 1.307e-3,
    "void_fraction_settled": 0.45,
}
SAND_SIZES = np.array([2, 1.42, 1, 0.714, 0.505, 0.357, 0.252, 0.178, 0.126]) * 1e-3
SAND_PARTS = np.array([0.053, 0.171, 0.146, 0.204, 0.176, 0.119, 0.059, 0.031, 0.007])


def test_carried_class_leaves_the_sum_and_is_named() -> None:
    # Davis (2010), example 11-3: 10 mm/s expands 0.5 m of this sand to 0.696 m
    found = expansion.graded_bed_expansion.evaluate(
        SAND_SIZES, SAND_PARTS, superficial_velocity=0.010, **SAND
    )
    assert found.value.height_expanded == pytest.approx(0.696, rel=0.01)
    (notice,) = found.notices
    assert notice["message"].startswith("These sizes are carried off")
    assert notice["message"].endswith("(class sizes = 126 µm: 1 of 9 values)")
    # without the 0.7 % it is the same bed: their share of the settled height is all they take away
    kept = expansion.graded_bed_expansion(
        SAND_SIZES[:-1], SAND_PARTS[:-1], superficial_velocity=0.010, **SAND
    ).height_expanded
    assert found.value.height_expanded == pytest.approx(
        kept * SAND_PARTS[:-1].sum() / SAND_PARTS.sum(), rel=1e-12
    )
    heights = [
        expansion.graded_bed_expansion(SAND_SIZES, SAND_PARTS, superficial_velocity=u, **SAND).height_expanded
        for u in (9.2e-3, 9.3e-3, 9.4e-3, 9.5e-3, 9.6e-3)
    ]
    assert np.all(np.diff(heights) > 0)
    assert heights[-1] - heights[0] < 0.02
    with pytest.raises(ApplicabilityError, match="carries every class off"):
        expansion.graded_bed_expansion(SAND_SIZES, SAND_PARTS, superficial_velocity=1.0, **SAND)


def test_no_bubbles_below_minimum_fluidization() -> None:
    found = two_phase.two_phase_bed.evaluate(np.array([0.02, 0.05, 0.3]), 0.05, 0.3, 2.5e-5)
    bed = found.value
    np.testing.assert_array_equal(np.asarray(bed.bubble_diameter[:2]), 0.0)
    np.testing.assert_array_equal(np.asarray(bed.transfer_units[:2]), 0.0)
    np.testing.assert_array_equal(np.asarray(bed.height_expanded[:2]), 0.3)
    assert bed.bubble_diameter[2] > 0.01
    assert [n["message"] for n in found.notices] == [
        "At or below minimum fluidization no gas is left over for bubbles: there are none. (superficial "
        "velocity = 20 … 50 mm/s: 2 of 3 values)"
    ]


def test_every_active_limit_says_why() -> None:
    at = {
        "particle_diameter": "60 um",
        "particle_density": 1500,
        "fluid_density": 1.2,
        "dynamic_viscosity": 1.8e-5,
    }
    for found, words in (
        (
            freeboard.elutriation_flux_wen_hashinger.evaluate(
                superficial_velocity=0.2, terminal_velocity=0.3, **at
            ),
            "the rate is zero",
        ),
        (bubbles.bubble_diameter_darton.evaluate(0.04, 0.05, 0.5), "no gas is left over for bubbles"),
        (expansion.bed_void_fraction_richardson_zaki.evaluate(0.2, 0.1, 2.4), "no bed remains"),
    ):
        (notice,) = found.notices
        assert notice["flag"] == "limit active"
        assert words in notice["message"]


def test_liquid_bed_of_coulson_and_richardson() -> None:
    # example 6.1: 3 mm glass-like spheres of 4200 kg/m³, liquid of 1100 kg/m³ and 3 mPa s: U_mf = 0.0364 m/s
    oil = Mixture(
        solids=(),
        liquids=(Species("liquid", (("liquid", 1.0),), (1100.0,), (2000.0,)),),
        gases=(),
        size_edges=(1e-5, 1e-3),
        liquid_viscosity=lambda w, T: 3e-3,
    )
    bed = LiquidFluidizedBed(
        area=0.01, mass=10.0, particle_diameter=3e-3, particle_density=4200.0, void_fraction=0.4
    )
    weight = 10 * 9.80665 * (1 - 1100 / 4200) / 0.01
    drops = []
    for U in (0.01, 0.0364, 0.1, 0.2):
        feed = empty(oil).replace(liquid=jnp.array([1100.0 * U * 0.01]), pressure=jnp.asarray(2e5))
        out = bed(feed)
        figures = bed.operate(feed=feed).figures
        assert figures.minimum_fluidization_velocity == pytest.approx(0.0364, abs=1e-4)
        assert figures.height_expanded * (1 - figures.bed_void_fraction) == pytest.approx(
            figures.height_settled * 0.6
        )
        assert float(feed.pressure - out.liquid.pressure) == pytest.approx(float(figures.pressure_drop))
        drops.append(float(figures.pressure_drop))
        assert [c.ok for c in bed.operate(feed=feed).checks] == [U > 0.0364, True]
    assert drops[0] < drops[1] == pytest.approx(weight, rel=2e-3)
    assert drops[2:] == pytest.approx([weight, weight])
    sized = LiquidFluidizedBed.size(1e-3, 0.7, 0.36, 2.4, 10.0, 3e-3, 4200.0)
    assert 1e-3 / sized.area == pytest.approx(0.36 * 0.7**2.4)


def test_backwash_case_runs() -> None:
    # filter sand of 0.8 mm at 40 m/h: Ergun's U_mf by hand 7.83 mm/s; expands by some 9 %
    run = read(FOLDER / "backwash.toml").solve()
    assert run.figure("sand.minimum_fluidization_velocity") == pytest.approx(7.83e-3, rel=5e-3)
    assert 0.08 < run.figure("sand.height_expanded") / run.figure("sand.height_settled") - 1 < 0.11
    assert run.figure("sand.pressure_drop") == pytest.approx(770 * 9.80665 * (1 - 998.2 / 2650), rel=1e-3)


def test_gas_bed_case_runs() -> None:
    # weight of 900 kg on 1.5 m² and 30 % more for the plate; Wen and Yu's U_mf of the mean size inside the
    # printed scatter of Ergun's
    found = read(FOLDER / "bed.toml").solve().as_json()
    assert found["audit"]["mass_closure"] < 1e-12
    results = {k: v["value"] for k, v in found["units"]["bed"]["results"].items()}
    assert results["pressure_drop"] == pytest.approx(1.3 * 900 * 9.80665 / 1.5, rel=1e-3)
    assert all(check["ok"] for check in found["units"]["bed"]["checks"])
    assert (
        0.0
        < results["bypass_fraction"]
        < 1 - results["minimum_fluidization_velocity"] / results["superficial_velocity"]
    )
