"""Crystals of two sizes: against moments integrated by SciPy, closed forms, and crystals of one size."""

from __future__ import annotations

from dataclasses import replace
from math import factorial
from typing import Any

import jax.numpy as jnp
import numpy as np
import pytest
from scipy.integrate import solve_ivp
from tests.contracts.unit_search import Case, rows, shares, tried, wrong
from tests.sharing.places import EXAMPLES

import granum as gr
from granum.core.errors import GranumError
from granum.core.packing import compiled
from granum.crystallization.equipment.needles import NeedleBatchCrystallizer, NeedleCrystallizer
from granum.crystallization.formulas.growth import PowerLawGrowth
from granum.crystallization.formulas.nucleation import PowerLawNucleation
from granum.crystallization.formulas.programs import PowerCooling
from granum.crystallization.formulas.solubility_laws import PolynomialSolubility
from granum.crystallization.population.needles import Aged, Segments, shifted
from granum.flowsheet import Flowsheet
from granum.flowsheet.axes import gather_axes
from granum.streams.from_materials import mixture_of
from granum.streams.stream import empty

# potassium dihydrogen phosphate: Ma, Tafti and Braatz (2002), as a notebook quotes it (see the bibliography)
KDP: dict[str, Any] = {
    "solute_per_solvent": 0.308,
    "solubility": {"law": "polynomial_solubility", "coefficients": [0.2087, -9.7629e-5, 9.3027e-5]},
    "growth": {"law": "power_law_growth", "growth_coefficient": 100.75e-6, "growth_order": 1.74},
    "growth_width": {"law": "power_law_growth", "growth_coefficient": 12.21e-6, "growth_order": 1.48},
    "temperature_program": {
        "law": "power_cooling",
        "temperature_start": 305.15,
        "temperature_end": 301.15,
        "duration": 7200.0,
    },
    "duration": 7200.0,
    "crystal_density": 2338.0,
    "seed_mass_per_solvent": 0.001,
    "steps": 200,
}
BIRTHS = {"law": "secondary_nucleation", "nucleation_coefficient": 1e8, "nucleation_order": 2.04}


def needles(**changes: Any) -> Any:
    return gr.crystallization.needle_batch(**(KDP | changes))


def test_against_moments_integrated_by_scipy():
    """μ_jk' = j G_L μ_(j-1)k + k G_W μ_j(k-1), births at size zero; cubes of 3:1 seeds of one size."""
    out = needles(nucleation=BIRTHS)
    width = 1e-4 * (np.pi / 18.0) ** (1 / 3)
    powers = np.arange(4)
    seeds = 0.001 / (2338.0 * 3.0 * width**3)
    first = seeds * (3.0 * width) ** powers[:, None] * width ** powers[None, :]
    scale = first.copy()

    def rates(t, y):
        m = y[:16].reshape(4, 4) * scale
        T = 32.0 - 4.0 * t / 7200.0
        crystals = 2338.0 * m[1, 2]
        c = 0.309 - crystals
        s = max(c / (0.2087 - 9.7629e-5 * T + 9.3027e-5 * T**2) - 1.0, 0.0)
        lengthening, widening = 100.75e-6 * s**1.74, 12.21e-6 * s**1.48
        volume = (1.0 + c) / 1000.0 + crystals / 2338.0
        change = np.zeros((4, 4))
        change[0, 0] = 1e8 * s**2.04 * crystals  # per volume of suspension, times that volume over it
        assert volume > 0.0
        change[1:] += powers[1:, None] * lengthening * m[:-1]
        change[:, 1:] += powers[None, 1:] * widening * m[:, :-1]
        return (change / scale).ravel()

    m = solve_ivp(rates, (0, 7200.0), (first / scale).ravel(), method="LSODA", rtol=1e-9, atol=1e-12).y[:, -1]
    m = m.reshape(4, 4) * scale
    assert out.crystals_per_solvent[-1] == pytest.approx(2338.0 * m[1, 2], rel=1e-5)
    assert out.crystals_number[-1] == pytest.approx(m[0, 0], rel=1e-4)
    assert out.mean_length[-1] == pytest.approx(m[2, 2] / m[1, 2], rel=1e-4)
    assert out.mean_width[-1] == pytest.approx(m[1, 3] / m[1, 2], rel=1e-4)
    mean = m[2, 1] / m[1, 2]
    assert out.aspect_ratio[-1] == pytest.approx(mean, rel=1e-5)
    spread = np.sqrt(m[3, 0] / m[1, 2] - mean**2)
    assert out.aspect_ratio_deviation[-1] == pytest.approx(spread, rel=5e-3)
    whole = np.asarray(out.solute_per_solvent + out.crystals_per_solvent)
    assert np.ptp(whole) < 1e-14
    assert out.step_error < 1e-4


def test_faces_that_grow_alike_are_a_batch_of_one_size():
    """Cubes: the width of one is (π/6)^(1/3) of the diameter of its sphere."""
    same = {"growth": KDP["growth"], "growth_width": KDP["growth"], "seed_aspect_ratio": 1.0}
    out = needles(**same, nucleation=BIRTHS)
    one = {k: v for k, v in KDP.items() if k != "growth_width"}
    one |= {"seed_size": 1e-4 * (np.pi / 6.0) ** (1 / 3), "nucleation": BIRTHS, "steps": 400}
    plain = gr.crystallization.batch(**one)
    assert out.solute_per_solvent[-1] == pytest.approx(float(plain.solute_per_solvent[-1]), rel=1e-5)
    assert out.nuclei_mass_fraction == pytest.approx(plain.nuclei_mass_fraction, rel=1e-3)
    np.testing.assert_allclose(out.aspect_ratio, 1.0, rtol=1e-9)
    assert np.max(out.aspect_ratio_deviation) < 1e-5


def test_undersaturated_needles_keep():
    out = needles(solute_per_solvent=0.2, nucleation=BIRTHS, steps=100)
    np.testing.assert_allclose(out.crystals_per_solvent, 0.001, rtol=1e-12)
    np.testing.assert_allclose(out.aspect_ratio, 3.0, rtol=1e-12)


def test_needles_dissolve_in_a_warm_vessel_until_it_is_saturated():
    """1 kg/s of water at 40 °C takes 0.3536 of 0.45 kg/s, by the solubility of the laws below."""
    mixture = replace(MIXTURE, axes=MIXTURE.axes[:1])
    joint = shares(0.5, 0.2, 8)[:, None] * shares(0.5, 0.3, 4)
    feed = empty(mixture, 313.15).replace(solid=0.15 * joint[None], liquid=jnp.array([1.0, 0.3]))
    unit = NeedleCrystallizer(313.15, 5.0, **laws(np.full(6, 0.5)))
    product = unit(feed).product
    saturated = 0.2087 - 9.7629e-5 * 40.0 + 9.3027e-5 * 40.0**2
    assert float(product.liquid[1] / product.liquid[0]) == pytest.approx(saturated, rel=1e-9)
    assert float(product.solid_flow + product.liquid[1]) == pytest.approx(0.45, rel=1e-12)
    np.testing.assert_allclose(product.solid[0].sum(axis=0) / product.solid_flow, joint.sum(axis=0), rtol=0.1)


def test_moments_of_a_mixed_vessel_are_factorials():
    """Crystals born at size zero: μ_jk = N (j + k)! (G_L τ)^j (G_W τ)^k."""
    born = Aged(*(jnp.asarray([v]) for v in (0.0, 0.0, 3e-4, 1e-4, 5.0)))
    exact = [[5.0 * factorial(j + k) * 3e-4**j * 1e-4**k for k in range(4)] for j in range(4)]
    np.testing.assert_allclose(born.moments(), exact, rtol=1e-12)
    magma = gr.crystallization.magma_density_needles(5e-3, 3e-7, 1e-7, 1000.0, 2000.0, 0.9)
    assert magma == pytest.approx(0.9 * 2000.0 * float(born.moments()[1, 2]), rel=1e-12)


def test_moments_move_as_their_crystals():
    rng = np.random.default_rng(1)
    length, width, longer, wider, number = (jnp.asarray(rng.random(20)) for _row in range(5))
    before = Segments(length, width, longer, wider, number)
    after = Segments(length + 0.3, width + 0.1, longer, wider, number)
    np.testing.assert_allclose(shifted(before.moments(), 0.3, 0.1), after.moments(), rtol=1e-12)


@pytest.mark.parametrize("lines", [Segments, Aged])
def test_classes_are_those_of_many_crystals_counted(lines):
    """Random lines against crystals drawn along them; nothing is lost."""
    rng = np.random.default_rng(2)
    count, drawn = 12, 20000
    given = [rng.random(count) * 1e-4 for _row in range(4)] + [rng.random(count)]
    given[2][:2] = given[3][:2] = 0.0  # lines of one point
    made = lines(*(jnp.asarray(row) for row in given))
    edges, ratios = np.geomspace(1e-5, 1e-3, 9), np.array([0.0, 0.5, 0.9, 1.4, 3.0, 1e9])
    found = np.asarray(made.in_classes(edges, ratios, 0.8))
    at = (np.arange(drawn) + 0.5) / drawn
    if lines is Aged:
        at = -np.log1p(-at)
    length, width = (np.asarray(part) for part in made.at(jnp.asarray(at)[None, :] * np.ones((count, 1))))
    volume = length * width**2
    size = np.clip((6.0 * 0.8 * volume / np.pi) ** (1 / 3), edges[0], edges[-1] * 0.999)
    counted = np.histogram2d(
        size.ravel(),
        (length / width).ravel(),
        bins=(edges, ratios),
        weights=(given[4][:, None] * volume / drawn).ravel(),
    )[0]
    np.testing.assert_allclose(found, counted, atol=3e-3 * counted.sum())
    assert found.sum() == pytest.approx(float(jnp.sum(made.moments()[1, 2])), rel=1e-12)
    assert (found >= 0.0).all()


def test_a_continuous_crystallizer_of_cubes_is_the_msmpr():
    """Magma density of the ideal crystallizer of one size, M = 6 k ρ (B/G) (G τ)⁴."""
    alike = "{law='power_law_growth', growth_coefficient='12.21 um/s', growth_order=1.48}"
    cubes = gr.alone("crystallization.needle_crystallizer", growth=alike, growth_width=alike).solve()
    found = cubes.units["needle_crystallizer"].values
    assert found.aspect_ratio == pytest.approx(1.0, rel=1e-9)
    tau, rate = found.residence_time, found.growth_rate
    assert found.mean_length == pytest.approx(4.0 * rate * tau, rel=1e-9)
    made = gr.crystallization.magma_density(
        nuclei_population_density=found.nucleation_rate / rate,
        growth_rate=rate,
        residence_time=tau,
        crystal_density=2338.0,
        volume_shape_factor=1.0,
    )
    assert found.magma_density == pytest.approx(made, rel=0.01)


def slender(mixture: Any, x: Any) -> dict[str, Any]:
    """Warm liquors with crystals of several sizes and aspect ratios, some of them undersaturated."""
    water, (_solids, classes, ratios) = 10.0 ** (-1.0 + 2.0 * x[0]), mixture.solid_shape
    joint = shares(x[4], x[5], classes)[:, None] * shares(x[6], x[7], ratios)
    liquid = water * jnp.stack([1.0, 0.15 + 0.4 * x[1]])
    solid = 0.2 * water * x[3] * (x[3] > 0.4) * joint[None]
    return {"feed": empty(mixture, 300.0 + 40.0 * x[2]).replace(solid=solid, liquid=liquid)}


MIXTURE = mixture_of(
    ("water", "potassium dihydrogen phosphate"),
    ("potassium dihydrogen phosphate",),
    ("water",),
    np.geomspace(5e-6, 3e-3, 9),
    axes=(("aspect_ratio", (0.5, 1.0, 2.0, 4.0, 8.0)), ("porosity", (0.0, 0.1, 0.3))),
)


def laws(u: Any) -> dict[str, Any]:
    return {
        "solubility": PolynomialSolubility([0.2087, -9.7629e-5, 9.3027e-5]),
        "growth": PowerLawGrowth(10.0 ** (-6.0 + 2.5 * u[2]), 1.0 + u[3]),
        "growth_width": PowerLawGrowth(10.0 ** (-6.5 + 2.5 * u[3]), 1.0 + u[2]),
        "nucleation": PowerLawNucleation(10.0 ** (5.0 + 4.0 * u[4]), 1.5 + u[5]),
        "seed_aspect_ratio": 0.6 + 7.0 * u[1],
        "volume_shape_factor": 0.5 + 0.5 * u[0],
    }


CASES = {
    "batch": lambda f, u: NeedleBatchCrystallizer(
        temperature_program=PowerCooling(
            f["feed"].temperature, f["feed"].temperature - 30.0 * u[0], 3600.0 * (1.0 + 9.0 * u[1])
        ),
        duration=3600.0 * (1.0 + 9.0 * u[1]),
        seed_mass_per_solvent=0.02 * u[4],
        seed_width=8e-5 * u[5],
        **laws(u),
    ),
    "continuous": lambda f, u: NeedleCrystallizer(
        285.0 + 30.0 * u[0],
        f["feed"].slurry_volume_flow * 10.0 ** (2.5 + 1.5 * u[1]),
        evaporation=0.2 * u[5] * f["feed"].liquid[0],
        **laws(u),
    ),
}


@pytest.mark.parametrize("name", CASES)
def test_random_needles_over_two_further_axes(name):
    """Balances close, nothing is negative, figures keep to their kinds; the porosity of crystals stays."""

    def feeds(mixture: Any, x: Any) -> dict[str, Any]:
        feed = slender(replace(mixture, axes=mixture.axes[:1]), x)["feed"]
        solid = feed.solid[..., None] * jnp.array([0.3, 0.7])
        return {"feed": empty(mixture, feed.temperature).replace(solid=solid, liquid=feed.liquid)}

    found = tried(Case(MIXTURE, feeds, CASES[name]), rows(100))
    assert not wrong(found)
    into = found.feeds["feed"]
    saturated = laws(np.zeros(6))["solubility"](into.temperature)
    dissolve = (into.liquid[:, 1] < 0.99 * saturated * into.liquid[:, 0]) & (name == "batch")
    assert (found.refused & ~dissolve).mean() < 0.1
    fed, made = found.feeds["feed"].solid, found.products["product"].solid
    there = (fed.sum(axis=(1, 2, 3, 4)) > 0) & (made.sum(axis=(1, 2, 3, 4)) > 0) & ~found.refused
    shared = made[there].sum(axis=(1, 2, 3))
    np.testing.assert_allclose(shared[:, 0] / shared.sum(axis=1), 0.3, rtol=1e-9)


def test_needles_in_a_saturated_liquor_come_out_as_they_went_in():
    feed = slender(replace(MIXTURE, axes=MIXTURE.axes[:1]), np.array([0.5, 0.0, 0.5, 1, 0.5, 0.2, 0.4, 0.2]))
    feed = feed["feed"]
    for name, make in CASES.items():
        unit = make({"feed": feed}, np.full(6, 0.0))
        saturated = unit.solubility(feed.temperature if name == "batch" else unit.temperature)
        feed = feed.replace(liquid=feed.liquid.at[1].set(saturated * feed.liquid[0]))
        product = compiled(lambda unit, feed: unit(feed))(unit, feed).product
        np.testing.assert_allclose(product.solid, feed.solid, rtol=1e-9, atol=1e-15)


def test_a_line_keeps_the_axis_that_a_unit_knows():
    feed = slender(replace(MIXTURE, axes=MIXTURE.axes[:1]), np.full(8, 0.5))
    line = Flowsheet({"unit": CASES["continuous"](feed, np.full(6, 0.5))}, feed, {"feed": ("", "unit.feed")})
    assert gather_axes(line).line is line


def test_needles_keep_their_shape_in_a_line() -> None:
    """Filter and dryer lose mass of every shape alike; what is dry has gained what its liquor held."""
    run = gr.read(EXAMPLES / "needles" / "line.toml").solve()
    assert run.audit["mass_closure"] < 1e-12
    assert run.audit["energy_closure"] < 1e-12
    assert not [k.name for unit in run.units.values() for k in unit.checks if not k.ok]
    made, dried = (np.asarray(run.streams[name].solid)[0] for name in ("magma", "dry_needles"))
    assert (dried.sum(axis=0) / dried.sum()) == pytest.approx(made.sum(axis=0) / made.sum(), rel=1e-6)
    # at the highest supersaturation length grows 2.7 times as fast as width: seeds of three grow stouter
    values = run.units["crystallizer"].values
    fastest = 100.75 / 12.21 * float(values.relative_supersaturation_maximum) ** (1.74 - 1.48)
    assert 2.0 < float(values.aspect_ratio) < fastest < 3.0
    assert float(run.streams["dry_needles"].liquid_flow) < 1e-3 * dried.sum()


def test_a_continuous_vessel_of_needles_takes_no_kernel():
    """It follows crystals that only grow, and had taken one in silence."""
    kernel = {"law": "constant_kernel", "agglomeration_coefficient": 1e-11}
    with pytest.raises(GranumError, match="agglomeration_kernel"):
        gr.alone("crystallization.needle_crystallizer", agglomeration_kernel=kernel).solve()
