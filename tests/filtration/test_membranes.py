"""Membranes: what they hold back, the flux that osmosis, polarization and gel leave, stages and blocking."""

from __future__ import annotations

import numpy as np
import pytest

import granum as gr
from granum.core.errors import ConvergenceError
from granum.filtration.formulas.blocking import LAWS, BlockingLaw
from granum.filtration.membranes import Osmosis
from granum.streams.from_materials import mixture_of

EXPONENTS = {"complete": 2.0, "standard": 1.5, "intermediate": 1.0, "cake": 0.0}


def osmotic(solute: str, molality: float, temperature: float) -> float:
    mixture = mixture_of(["water", solute], [], [], [1e-6, 1e-5])
    mass = mixture.liquids[1].molar_mass
    return float(Osmosis(mixture)(np.array([1.0, molality * mass]), temperature))


def test_osmotic_pressure_of_the_library() -> None:
    # osmotic coefficient of NaCl at 25 °C by Hamer and Wu: 0.9355 at 1 mol/kg, 0.9230 at 0.6 (from memory)
    for molality, coefficient in ((1.0, 0.9355), (0.6, 0.9230)):
        ideal = 2.0 * molality * 8.31446 * 298.15 * 997.05
        assert osmotic("sodium chloride", molality, 298.15) == pytest.approx(coefficient * ideal, rel=5e-3)
    # Morse and Frazer measured 26.64 atm of cane sugar, 1 mol/kg at 20 °C (from memory)
    assert osmotic("sucrose", 1.0, 293.15) == pytest.approx(26.64 * 101325.0, rel=0.03)


def test_sizes_of_molecules() -> None:
    """Erickson 2009, table 1 (from memory): least radii of proteins."""
    for mass, radius in ((10.0, 1.42), (20.0, 1.78), (100.0, 3.05), (500.0, 5.21)):
        assert gr.filtration.molecule_diameter(mass) == pytest.approx(2e-9 * radius, rel=1e-2)
    pore = gr.filtration.pore_diameter_cut_off(30.0)
    assert gr.filtration.rejection_ferry(gr.filtration.molecule_diameter(30.0), pore) == pytest.approx(0.9)


@pytest.mark.parametrize("law", LAWS)
def test_blocking_follows_hermia(law: BlockingLaw) -> None:
    """d²t/dV² = k (dt/dV)ⁿ, by differences of the volumes."""
    t = np.linspace(1.0, 1800.0, 20001)
    V = np.asarray(gr.filtration.filtrate_volume_blocking(t, 2e-7, 500.0, law))
    slope = np.gradient(t, V)
    inner = slice(100, -100)
    k = np.gradient(slope, V)[inner] / slope[inner] ** EXPONENTS[law]
    assert np.ptp(k) / np.mean(k) < 1e-3


def test_the_test_names_the_law_it_was_made_with() -> None:
    rng = np.random.default_rng(7)
    t = np.linspace(60.0, 3000.0, 20)
    for law in LAWS:
        V = np.asarray(gr.filtration.filtrate_volume_blocking(t, 2e-7, 500.0, law))
        found = gr.filtration.BlockingTest(t, V * (1.0 + 1e-3 * rng.standard_normal(20))).fit()
        assert found.flags[-1]["name"] == law
        low, high = found["blocking_time"].interval_95
        assert low < 520.0
        assert high > 480.0


def plant(name: str, **inputs: object):
    line = gr.alone(f"filtration.{name}", **inputs)
    run = line.solve()
    assert run.audit["mass_closure"] < 1e-9
    assert run.audit["energy_closure"] < 1e-9
    return run


def test_feed_and_bleed_concentrates_as_in_the_handbook() -> None:
    """Cheryan: what is held back by R stands at c₀ VCF/(1 + (VCF − 1)(1 − R)) in one mixed stage."""
    run = plant(
        "ultrafiltration", stage_count="1", area="120 m2", **{"feed.liquid": {"water": 1.0, "sucrose": 0.0}}
    )
    feed, left = run.streams["feed"], run.streams["ultrafiltration.retentate"]
    fresh = run.streams["solvent"]
    sizes = feed.mixture.sizes
    held = np.asarray(gr.filtration.rejection_ferry(sizes, 3.7e-9))
    entering = feed.liquid_volume_flow + fresh.liquid_volume_flow * (
        feed.mixture.densities("liquids", fresh.temperature)[0]
        / feed.mixture.densities("liquids", feed.temperature)[0]
    )
    vcf = float(entering / left.liquid_volume_flow)
    there = np.asarray(feed.solid)[0] > 0
    ratio = (
        np.asarray(left.solid)[0]
        / left.liquid_flow
        / (np.asarray(feed.solid)[0] / (feed.liquid_flow + fresh.liquid_flow))
    )
    assert ratio[there] == pytest.approx((vcf / (1.0 + (vcf - 1.0) * (1.0 - held)))[there], rel=2e-3)


def test_a_gel_makes_the_flux_indifferent_to_pressure() -> None:
    low, high = (
        plant("ultrafiltration", pressure_drop=p, mass_transfer_coefficient="1e-6 m/s").figure(
            "ultrafiltration.filtrate_flux"
        )
        for p in ("3 bar", "6 bar")
    )
    assert high == pytest.approx(low, rel=1e-6)


def test_more_stages_need_less_area() -> None:
    factors = [
        plant("ultrafiltration", stage_count=n).figure("ultrafiltration.volume_concentration_factor")
        for n in ("1", "3", "6")
    ]
    assert factors[0] < factors[1] < factors[2]


def recovery(load: float, ratio: float, count: int) -> float:
    """Recovery of mixed elements with an ideal membrane and an osmotic pressure that grows as the salt is
    left: Y = N (1 − s/(1 − Y)) in each.
    """
    left = 1.0
    for _element in range(count):
        n, s = load / count / left, ratio / left
        b = 1.0 + n
        left *= 1.0 - (b - np.sqrt(b**2 - 4.0 * n * (1.0 - s))) / 2.0
    return 1.0 - left


def test_reverse_osmosis_of_an_ideal_membrane() -> None:
    """Without polarization and leakage, against the balance of mixed elements and between one of them and
    plug flow, Y + s ln((1 − s)/(1 − s − Y)) = N (Banchik, Sharqawy and Lienhard 2014).
    """
    ideal = {
        "solute_permeability": "1e-12 m/s",
        "mass_transfer_coefficient": "1 m/s",
        "pressure_drop": "10 bar",
        "area": "500 m2",
        "feed.liquid": {"water": 0.9995, "sodium chloride": 0.0005},
    }
    run = plant("reverse_osmosis", element_count="8", **ideal)
    found = run.figure("reverse_osmosis.water_recovery")
    feed = run.streams["feed"]
    s = float(Osmosis(feed.mixture)(feed.liquid, feed.temperature)) / 1e6
    load = 500.0 * (1e-3 / 3600.0 / 1e5) * 1e6 / float(feed.liquid_volume_flow)
    assert found == pytest.approx(recovery(load, s, 8), rel=3e-3)
    low, high = 0.0, 1.0 - s
    for _halving in range(60):
        y = 0.5 * (low + high)
        low, high = (y, high) if y + s * np.log((1 - s) / (1 - s - y)) < load else (low, y)
    assert recovery(load, s, 1) < found < low


def test_more_pressure_rejects_more_salt() -> None:
    found = [
        plant("reverse_osmosis", pressure_drop=p).figure("reverse_osmosis.rejection")
        for p in ("40 bar", "60 bar")
    ]
    assert 0.9 < found[0] < found[1] < 1.0


def test_energy_of_seawater_with_recovery_of_pressure() -> None:
    """Plants with pressure exchangers take 2 to 4 kWh/m³ (Elimelech and Phillip 2011, from memory: 3 to 4
    with all pre-treatment); without, several times that of the membrane work.
    """
    with_it = plant("reverse_osmosis").figure("reverse_osmosis.energy_per_filtrate") / 3.6e6
    without = (
        plant("reverse_osmosis", energy_recovery_efficiency=0).figure("reverse_osmosis.energy_per_filtrate")
        / 3.6e6
    )
    assert 2.0 < with_it < 4.0
    assert 1.5 * with_it < without < 8.0


def test_what_a_membrane_cannot_do_is_said() -> None:
    with pytest.raises(ConvergenceError, match="Nothing permeates"):
        gr.alone("filtration.ultrafiltration", concentration_gel="5 g/L").solve()
    with pytest.raises(ConvergenceError, match="more liquid than there is"):
        gr.alone(
            "filtration.reverse_osmosis",
            area="100000 m2",
            **{"feed.liquid": {"water": 1.0, "sodium chloride": 0.0}},
        ).solve()
    # below the osmotic pressure only as much passes as leaks: the check of the flux fails
    weak = plant("reverse_osmosis", pressure_drop="20 bar")
    assert not all(check.ok for check in weak.units["reverse_osmosis"].checks)
    assert weak.figure("reverse_osmosis.rejection") < 0.8


def test_a_flux_by_two_points_is_the_line_of_the_gel() -> None:
    """u = k ln(c_g/c) through two of its points, nothing beyond the gel, level below the thinnest tested."""
    k, gel = 5e-6, 250.0
    law = gr.filtration.MeasuredFlux([100.0, 10.0], [k * np.log(gel / 100.0), k * np.log(gel / 10.0)])
    found = [float(law(c)) for c in (1.0, 10.0, 50.0, 200.0, gel, 400.0)]
    wanted = [k * np.log(gel / c) for c in (10.0, 10.0, 50.0, 200.0)]
    assert found == pytest.approx([*wanted, 0.0, 0.0], abs=1e-15)
