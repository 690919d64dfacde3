"""Activated carbon: the equations of Bohart and Adams integrated, numbers of others, beds alone."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import granum as gr
from granum.core.errors import GranumError
from granum.filtration import (
    AdsorptionTest,
    FreundlichIsotherm,
    LangmuirIsotherm,
)

ga = gr.filtration
BED = {"concentration_inlet": 1e-3, "adsorbate_loading": 0.2, "bed_density": 450.0, "adsorption_rate": 10.0}


def test_curve_is_that_of_the_two_equations_along_the_bed() -> None:
    """∂c/∂τ = −k (1 − y) c with y the share of full loading, dy/dt = k c (1 − y)/(q ρ); marched in time."""
    contact, points = 1.0, 400
    k, full = BED["adsorption_rate"], BED["adsorbate_loading"] * BED["bed_density"]
    step = contact / points

    def along(y: np.ndarray) -> np.ndarray:
        falls = np.exp(-np.concatenate([[0.0], np.cumsum(k * (1.0 - y) * step)]))
        return BED["concentration_inlet"] * 0.5 * (falls[1:] + falls[:-1])

    def takes(_t: float, y: np.ndarray) -> np.ndarray:
        return k * along(y) * (1.0 - y) / full

    times = np.linspace(6e4, 1.2e5, 5)
    found = solve_ivp(takes, (0.0, times[-1]), np.zeros(points), t_eval=times, rtol=1e-8, atol=1e-10)
    behind = [np.exp(-np.sum(k * (1.0 - y) * step)) for y in found.y.T]
    ours = ga.breakthrough_fraction_bohart_adams(times, contact, **BED)
    assert np.asarray(ours) == pytest.approx(behind, abs=2e-4)


def test_time_and_curve_are_one() -> None:
    for share in (0.01, 0.05, 0.5):
        time = ga.breakthrough_time_wheeler_jonas(1.0, **BED, breakthrough_fraction=share)
        assert ga.breakthrough_fraction_bohart_adams(time, 1.0, **BED) == pytest.approx(share)
    assert ga.breakthrough_time_wheeler_jonas(0.2, **BED) == 0.0


def test_trichloroethene_as_in_a_textbook() -> None:
    """Crittenden's example as another program has it: ten minutes of contact, 803.4 kg/m³ grains at 44 %
    voids, 0.5 mg/L, 80 % through after 1.283·10⁷ s of its surface diffusion model; the capacity alone lasts
    1.13·10⁷ s.
    """
    loading = FreundlichIsotherm(1.062e-3, 0.48, 1e-6)(5e-4)
    middle = ga.breakthrough_time_wheeler_jonas(600.0, 5e-4, loading, 803.4 * 0.56, 0.01, 0.5)
    assert 0.85 * 1.283e7 < middle < 1.283e7


def test_isotherms_at_their_ends() -> None:
    langmuir, freundlich = LangmuirIsotherm(0.3, 100.0), FreundlichIsotherm(26.1e-3, 0.44)
    assert langmuir(1e-6) == pytest.approx(0.3 * 100.0 * 1e-6, rel=1e-3)
    assert langmuir(1e4) == pytest.approx(0.3, rel=1e-5)
    assert freundlich(1e-3) == pytest.approx(0.0261)
    assert float(freundlich(0.0)) == pytest.approx(0.0, abs=1e-6)


@pytest.mark.long
def test_intervals_of_the_test_hold_the_truth() -> None:
    """Two hundred laboratories with 3 % scatter; expected 95 %."""
    rng, law = np.random.default_rng(7), FreundlichIsotherm(0.026, 0.44)
    c = np.geomspace(1e-4, 0.1, 8)
    inside = np.zeros(2)
    for _one in range(200):
        q = np.asarray(law(c)) + 0.03 * 0.1 * rng.standard_normal(8)
        found = AdsorptionTest(c, np.maximum(q, 1e-4), isotherm_form="freundlich").fit()
        for i, (name, true) in enumerate((("loading_reference", 0.026), ("adsorption_exponent", 0.44))):
            low, high = found[name].interval_95
            inside[i] += low <= true <= high
    assert np.all(inside > 180)


def test_the_better_isotherm_is_named() -> None:
    c = np.geomspace(1e-4, 0.1, 8)
    for law, name in (
        (LangmuirIsotherm(0.2, 300.0), "langmuir"),
        (FreundlichIsotherm(0.03, 0.4), "freundlich"),
    ):
        found = AdsorptionTest(c, np.asarray(law(c)) * (1 + 0.002 * (-1.0) ** np.arange(8))).fit()
        assert found.flags[-1]["name"] == name
    assert found.values["adsorption_exponent"] == pytest.approx(0.4, rel=0.01)
    with pytest.raises(GranumError, match="bottles"):
        AdsorptionTest([0.0, *c[1:]], np.linspace(0.01, 0.1, 8)).fit()


def bed(key: str, **inputs: object):
    run = gr.alone(f"filtration.{key}", **inputs).solve()
    assert run.audit["mass_closure"] < 1e-9
    assert run.audit["energy_closure"] < 1e-9
    return run, lambda name: float(run.figure(f"{key}.{name}"))


def test_gas_bed_by_hand() -> None:
    run, of = bed("gas_carbon_bed")
    feed = run.streams["feed"]
    inlet = float(feed.gas[2] / feed.gas_volume_flow)
    assert of("adsorbate_loading") == pytest.approx(0.3 * (inlet / 1e-3) ** 0.11)
    contact = 8.0 * 0.6 / float(feed.gas_volume_flow)
    life = of("adsorbate_loading") * 450.0 / inlet * (contact - np.log(19.0) / 30.0)
    assert of("run_time") == pytest.approx(life)
    assert of("carbon_use") == pytest.approx(8.0 * 0.6 * 450.0 / life)
    caught = float(run.streams["gas_carbon_bed.adsorbed"].gas[2]) * life
    assert of("bed_use") == pytest.approx(caught / (of("carbon_mass") * of("adsorbate_loading")))
    # a sheet of the EPA for 4 by 10 mesh: 0.0368 v + 1.107e-4 v² inches of water per foot, feet a minute
    v = of("superficial_velocity") / 0.00508
    sheet = (0.0368 * v + 1.107e-4 * v**2) * 249.09 / 0.3048 * 0.6
    _run, finer = bed("gas_carbon_bed", particle_diameter="3 mm")
    assert finer("pressure_drop_bed") == pytest.approx(sheet, rel=0.3)


def test_what_makes_a_bed_last() -> None:
    _run, base = bed("liquid_carbon_bed")
    _run, deep = bed("liquid_carbon_bed", bed_depth="4 m")
    assert deep("run_time") > 2.0 * base("run_time")
    assert deep("carbon_use") < base("carbon_use")
    _run, late = bed("liquid_carbon_bed", breakthrough_fraction="30 %")
    assert late("run_time") > base("run_time")
    assert late("removal_efficiency") < base("removal_efficiency")


def test_what_cannot_be_is_told() -> None:
    with pytest.raises(GranumError, match="first moment"):
        bed("liquid_carbon_bed", bed_depth="10 cm")
    with pytest.raises(GranumError, match="nitrogen"):
        bed("gas_carbon_bed", adsorbate="nitrogen")
    run, _of = bed("gas_carbon_bed", **{"feed.temperature": "80 degC"})
    assert not {c.name: c.ok for c in run.units["gas_carbon_bed"].checks}[
        "temperature of the gas in a carbon bed"
    ]
