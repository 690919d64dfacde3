"""Jacketed and vacuum batches, tubes, vessels over time and growth dispersion: against SciPy, closed forms
and each other.
"""

from __future__ import annotations

import dataclasses

import equinox as eqx
import jax.numpy as jnp
import numpy as np
import pytest
from scipy.integrate import solve_ivp
from tests.sharing.crystallization import (
    B_ORDER,
    DENSITY,
    DURATION,
    G_ORDER,
    GROWTH,
    KB,
    KG,
    NUCLEATION,
    SEEDED,
    SOLUBILITY,
    START,
    Constant,
    ConstantBirths,
    linear_cooling,
    mixture,
    model,
    seeds,
)

from granum.core.errors import ApplicabilityError, CaseError, InputError
from granum.core.flags import collect
from granum.crystallization.equipment.batch import (
    BatchCrystallizer,
    JacketedBatchCrystallizer,
    VacuumBatchCrystallizer,
)
from granum.crystallization.equipment.tubes import PlugFlowCrystallizer
from granum.crystallization.formulas.balances import crystallizer_balance
from granum.crystallization.formulas.encrustation import (
    temperature_difference_encrustation,
    wall_temperature_jacket,
)
from granum.crystallization.formulas.nucleation import NoNucleation
from granum.crystallization.formulas.programs import ConstantFlow, NaturalCooling, PowerCooling
from granum.crystallization.formulas.solubility_laws import LibrarySolubility, PolynomialSolubility
from granum.crystallization.lab_tests.next_batch import next_batch
from granum.crystallization.population.lagrangian import Model, SolventVolume, SuspensionVolume, march
from granum.crystallization.population.operations import Programmed
from granum.crystallization.population.packets import GrowthDispersion, Seeds
from granum.crystallization.vessels.batch import agglomerating_batch, batch
from granum.crystallization.vessels.crystals import Crystal
from granum.crystallization.vessels.driven import jacketed_batch, vacuum_batch
from granum.crystallization.vessels.dynamic import Inflow, SteadyFeed, march_cascade, msmpr_over_time
from granum.crystallization.vessels.msmpr import Feed, steady_msmpr
from granum.crystallization.vessels.precipitation import precipitation_batch
from granum.streams.audit import closure
from granum.streams.mixture import Mixture
from granum.streams.stream import empty

LAWS = {"solubility": SOLUBILITY, "growth": GROWTH, "nucleation": NUCLEATION}


def saturated(T):
    t = T - 273.15
    return 0.1286 + 5.88e-3 * t + 1.721e-4 * t * t


def test_jacketed_batch_against_scipy():
    """Moments, solute and temperature together by LSODA, written apart from the package: m cp dT = UA (Tj -
    T) dt + q dm.
    """
    m0 = np.asarray(seeds().moments())
    UA, cl, cc, q = 500.0 * 0.25 / 18.0, 3800.0, 920.0, 44.5e3

    def jacket(t):
        return 300.15 + 5.0 * np.exp(-t / 1800.0)

    def rates(t, y):
        m, T = y[:5] * m0, y[5]
        crystals = DENSITY * m[3]
        c = START + DENSITY * m0[3] - crystals
        S = max(c / saturated(T) - 1, 0.0)
        G, B = KG * S**G_ORDER, KB * S**B_ORDER * crystals
        volume = (1.0 + c) / 1000.0 + crystals / DENSITY
        dm = np.array([B * volume / volume, *(k * G * m[k - 1] for k in range(1, 5))])
        heat = UA * (jacket(t) - T) + q * DENSITY * dm[3]
        return [*(dm / m0), heat / ((1.0 + c) * cl + crystals * cc)]

    exact = solve_ivp(rates, (0, DURATION), [1.0] * 5 + [305.15], method="LSODA", rtol=1e-10, atol=1e-12).y[
        :, -1
    ]
    out = jacketed_batch(
        **SEEDED,
        jacket_program=NaturalCooling(305.15, 300.15, 1800.0),
        temperature_start=305.15,
        solvent_mass=18.0,
        area=0.25,
        heat_transfer_coefficient=500.0,
        specific_heat_capacity=cl,
        specific_heat_capacity_crystal=cc,
        heat_released_per_crystal=q,
    )
    assert out.temperature[-1] == pytest.approx(exact[5], abs=2e-3)
    assert out.mean_diameter == pytest.approx(exact[4] * m0[4] / (exact[3] * m0[3]), rel=2e-3)
    assert out.crystals_per_solvent[-1] == pytest.approx(DENSITY * exact[3] * m0[3], rel=5e-4)
    # The wall: half of the difference in the inner film (500 of 1000 W/m2K).
    np.testing.assert_allclose(
        out.wall_temperature, 0.5 * (out.temperature + out.jacket_temperature), rtol=1e-12
    )
    assert 0.0 < out.undercooling_wall_maximum < out.temperature_difference_maximum


def test_wall_and_allowed_jacket_difference():
    """In series: U (T - Tj) = hi (T - Tw); a bulk at the metastable limit allows no difference at all."""
    T_w = wall_temperature_jacket(310.0, 290.0, 300.0, 900.0)
    assert pytest.approx(900.0 * (310.0 - T_w)) == 300.0 * 20.0
    allowed = temperature_difference_encrustation(6.0, 300.0, 900.0, 1.0)
    assert 310.0 - wall_temperature_jacket(310.0, 310.0 - allowed, 300.0, 900.0) == pytest.approx(5.0)
    assert temperature_difference_encrustation(6.0, 300.0, 900.0, 6.0) == 0.0


def test_vacuum_batch_pays_its_vapor_from_its_heat():
    program = PowerCooling(305.15, 301.15, DURATION)
    out = vacuum_batch(
        **SEEDED,
        temperature_program=program,
        specific_heat_capacity=3800.0,
        heat_released_per_crystal=44.5e3,
        heat_of_vaporization=2.43e6,
    )
    made = out.crystals_per_solvent[-1] - out.crystals_per_solvent[0]
    freed = 3800.0 * (START + 1.0) * 4.0 + 44.5e3 * made
    # the capacity falls as crystals form
    assert float(out.evaporated_fraction[-1]) == pytest.approx(float(freed) / 2.43e6, rel=0.03)
    assert np.all(np.diff(out.evaporated_fraction) >= 0)
    cooled = batch(**SEEDED, temperature_program=program)
    assert out.yield_fraction > cooled.yield_fraction


FEED = empty(mixture(), 333.15).replace(
    liquid=jnp.array([1.0, 1.0]), solid=jnp.zeros((1, 40)).at[0, 15].set(0.02)
)
UNITS = {
    "jacketed": lambda: JacketedBatchCrystallizer(
        jacket_program=NaturalCooling(333.15, 288.15, 5400.0),
        volume=5.0,
        area=12.0,
        heat_transfer_coefficient=600.0,
        duration=14400.0,
        seed_mass_per_solvent=0.01,
        **LAWS,
    ),
    "vacuum": lambda: VacuumBatchCrystallizer(
        temperature_program=PowerCooling(333.15, 293.15, 10800.0, 2.0), duration=10800.0, **LAWS
    ),
    "tube": lambda: PlugFlowCrystallizer(
        temperature_program=PowerCooling(333.15, 293.15, 7200.0, 2.0), volume=12.0, **LAWS
    ),
}


@pytest.mark.parametrize("kind", sorted(UNITS))
def test_equipment_closes_its_balances(kind):
    unit = UNITS[kind]()
    out = unit(feed=FEED)
    streams = [s for s in (out.product, getattr(out, "vapor", None)) if s is not None]
    found = closure([FEED], streams, out.heat_duty)
    assert float(found.mass) < 1e-12
    assert float(found.energy) < 1e-12
    made = unit.operate(feed=FEED)
    figures, checks = made.figures, {c.name: c for c in made.checks}
    if kind == "jacketed":
        # 17 K to the jacket with h/U = 5/3: the wall is 10 K colder than the suspension, too much for a zone
        # of 5 K.
        assert not checks["undercooling at the cooled wall"].ok
        assert float(figures.undercooling_wall_maximum) == pytest.approx(
            0.6 * float(figures.temperature_difference_maximum), abs=1.5
        )
    if kind == "vacuum":
        # Adiabatic: the duty is a small fraction of the heat that the vapor takes, which the flash balance
        # predicts.
        latent = 2.4e6 * float(figures.evaporation)
        assert abs(float(out.heat_duty)) < 1e-3 * latent
        assert 293.15 < float(out.vapor.temperature) < 333.15
        # its own vapor pressure
        antoine = 10.0 ** (8.07131 - 1730.63 / (233.426 + float(out.vapor.temperature) - 273.15)) * 133.322
        assert float(out.vapor.pressure) == pytest.approx(antoine, rel=0.01)
    if kind == "tube":
        assert float(figures.residence_time) == pytest.approx(12.0 / float(FEED.slurry_volume_flow))


def test_tube_does_to_its_feed_what_the_batch_does():
    tube = UNITS["tube"]()
    T = tube.operate(feed=FEED).figures.residence_time
    vessel = BatchCrystallizer(temperature_program=tube.temperature_program, duration=float(T), **LAWS)
    np.testing.assert_allclose(
        tube(feed=FEED).product.solid, vessel(feed=FEED).product.solid, rtol=1e-10, atol=1e-15
    )


def test_vacuum_needs_a_vapor():
    dry = Mixture(mixture().solids, mixture().liquids, (), mixture().size_edges)
    with pytest.raises(CaseError, match="vapor"):
        UNITS["vacuum"]()(feed=empty(dry, 333.15).replace(liquid=jnp.array([1.0, 1.0])))


class Liquor(eqx.Module):
    def __call__(self, solute, solvent):
        return (solute + solvent) / 1000.0


VESSELS = {
    "solute_per_solvent": 0.5,
    "solvent_flow": 1.0,
    "crystal_density": DENSITY,
    "seed_mass_per_solvent_start": 1e-3,
    **LAWS,
}


@pytest.mark.long
def test_start_up_ends_in_the_steady_state():
    rates = model()
    steady = steady_msmpr(
        Feed(0.5, 1.0, jnp.zeros(40)),
        293.15,
        5.0,
        rates.solubility,
        rates.growth,
        rates.nucleation,
        Crystal(DENSITY),
        Liquor(),
        jnp.linspace(0.0, 4e-3, 41),
    )
    out = msmpr_over_time(**VESSELS, volumes=[5.0], temperatures=[293.15], duration="20 hour", steps=1000)
    assert float(out.solute_per_solvent[-1]) == pytest.approx(float(steady.solute_per_solvent), rel=1e-5)
    assert float(out.magma_density[-1]) == pytest.approx(float(steady.magma_density), rel=1e-5)
    # D[4,3] of an exponential number density
    assert float(out.mean_diameter[-1]) == pytest.approx(4.0 * float(steady.length), rel=2e-4)
    assert out.step_error < 0.05


def test_start_up_against_scipy():
    """Moments and solute of one vessel of constant volume by LSODA, at 2.5 h, with the same start."""
    c0, V, L0 = float(saturated(293.15)), 5.0, 1e-4
    volume = (1 + c0) / 1000 + 1e-3 / DENSITY
    m = np.array([1e-3 / (DENSITY * L0**3) * L0**k for k in range(5)]) / volume * V
    unit = L0 ** np.arange(5) * 1e6

    def rates(t, y):
        m, s, w = y[:5] * unit, y[5], y[6]
        S, held = max(s / w / c0 - 1, 0.0), (s + w) / 1000 + m[3]
        G, B = KG * S**G_ORDER, KB * S**B_ORDER * DENSITY * m[3]
        dm = np.array([B, *(k * G * m[k - 1] for k in range(1, 5))])
        up = DENSITY * dm[3]
        out = (1.5 / 1000 - up / 1000 + dm[3]) / held
        return np.concatenate([(dm - m * out) / unit, [0.5 - up - s * out, 1.0 - w * out]])

    start = np.concatenate([m / unit, [c0 / volume * V, V / volume]])
    exact = solve_ivp(rates, (0, 9000.0), start, method="LSODA", rtol=1e-10, atol=1e-13).y[:, -1]
    out = msmpr_over_time(**VESSELS, volumes=[V], temperatures=[293.15], duration=9000.0, steps=1000)
    assert float(out.magma_density[-1]) == pytest.approx(DENSITY * exact[3] * unit[3] / V, rel=1e-3)
    assert float(out.mean_diameter[-1]) == pytest.approx(exact[4] / exact[3] * L0, rel=5e-3)


def test_cascade_conserves_and_settles_to_its_steady_stages():
    edges = jnp.linspace(0.0, 4e-3, 1601)
    rates = dataclasses.replace(model(), volume=SuspensionVolume(1000.0))
    temperatures = (lambda t: 303.15 + 0.0 * t, lambda t: 293.15 + 0.0 * t)
    inflow = SteadyFeed(Inflow(0.5, 1.0, jnp.zeros(5)))
    start = (START / (1.5 / 1000), 1.0 / (1.5 / 1000), jnp.asarray(seeds().moments()) / (1.5 / 1000))
    first, second = march_cascade(
        rates, temperatures, (2.0, 3.0), inflow, start, np.linspace(0.0, 72000.0, 1001)
    )
    # Matter: what came in less what left is what is there.
    came = np.array([0.5, 1.0]) * 72.0
    for stage, arriving in ((first, np.tile(came[None, :], (1000, 1))), (second, np.asarray(first.outflow))):
        held = np.array([stage.solute[-1] - stage.solute[0], stage.solvent[-1] - stage.solvent[0]])
        np.testing.assert_allclose(
            arriving.sum(axis=0) - np.asarray(stage.outflow).sum(axis=0), held, atol=1e-7
        )
    a = steady_msmpr(
        Feed(0.5, 1.0, jnp.zeros(1600)),
        303.15,
        2.0,
        rates.solubility,
        rates.growth,
        rates.nucleation,
        Crystal(DENSITY),
        Liquor(),
        edges,
    )
    b = steady_msmpr(
        Feed(a.solute, a.solvent, a.crystals),
        293.15,
        3.0,
        rates.solubility,
        rates.growth,
        rates.nucleation,
        Crystal(DENSITY),
        Liquor(),
        edges,
    )
    assert float(first.crystals[-1] / first.volume[-1]) == pytest.approx(float(a.magma_density), rel=2e-4)
    assert float(second.crystals[-1] / second.volume[-1]) == pytest.approx(float(b.magma_density), rel=2e-4)


def test_growth_dispersion_of_seeds_and_nuclei():
    """Constant mean rate: seeds of one size spread with the standard deviation CV G t; nuclei likewise over
    their ages.

    E[L] = L0 + G t, Var[L] = (CV G t)^2 for the seeds; for nuclei born evenly E[L^2] = (1 + CV^2) (G t)^2 /
    3.
    """
    G, t, cv = 1e-8, 5000.0, 0.3
    rates = Model(
        PolynomialSolubility([1e-6]),
        Constant(G),
        NoNucleation(),
        Crystal(1000.0),
        SolventVolume(1000.0),
        dispersion=GrowthDispersion(cv),
    )
    found = march(
        rates,
        Programmed(lambda t: 300.0 + 0.0 * t),
        Seeds.of_one_size(1e-4, 1e-3, 1000.0),
        0.5,
        1000.0,
        jnp.linspace(0, t, 11),
    )
    m = np.asarray(found.moments[-1])
    assert m[1] / m[0] == pytest.approx(1e-4 + G * t, rel=1e-8)
    assert np.sqrt(m[2] / m[0] - (m[1] / m[0]) ** 2) == pytest.approx(cv * G * t, rel=1e-6)
    born = Model(
        PolynomialSolubility([1e-6]),
        Constant(G),
        ConstantBirths(1e6),
        Crystal(1000.0),
        SolventVolume(1000.0),
        dispersion=GrowthDispersion(cv),
    )
    found = march(
        born, Programmed(lambda t: 300.0 + 0.0 * t), Seeds.none(), 0.5, 1000.0, jnp.linspace(0, t, 11)
    )
    m = np.asarray(found.moments[-1])
    assert m[2] / m[0] == pytest.approx((1 + cv**2) * (G * t) ** 2 / 3, rel=1e-6)
    np.testing.assert_allclose(found.final.moments(), m, rtol=1e-9)
    with pytest.raises(ApplicabilityError, match="dispersion"):
        batch(
            **SEEDED,
            temperature_program=PowerCooling(305.15, 301.15, DURATION),
            growth_dispersion=0.2,
            dissolution={"law": "power_law_dissolution", "dissolution_coefficient": 1e-5},
        )


def test_dispersion_of_zero_is_none():
    times = jnp.linspace(0.0, DURATION, 201)
    plain, same = (
        march(model(dispersion=d), Programmed(linear_cooling), seeds(), START, 1.0, times)
        for d in (None, GrowthDispersion(1e-9))
    )
    np.testing.assert_allclose(same.moments, plain.moments, rtol=1e-7)


@pytest.mark.long
def test_agglomerating_batch_asks_for_enough_steps():
    program = PowerCooling(305.15, 301.15, DURATION)
    kernel = {"law": "constant_kernel", "agglomeration_coefficient": 3e-9}
    with pytest.raises(InputError, match="at least"):
        agglomerating_batch(**SEEDED, temperature_program=program, agglomeration_kernel=kernel, steps=50)
    plain = batch(**SEEDED, temperature_program=program, steps=50)
    none = {**kernel, "agglomeration_coefficient": 0.0}
    same = agglomerating_batch(**SEEDED, temperature_program=program, agglomeration_kernel=none, steps=50)
    assert same.mean_diameter == pytest.approx(plain.mean_diameter, rel=1e-9)
    assert sum(same.class_fractions) == pytest.approx(1.0)


KINETICS = {
    "growth": {"law": "power_law_growth", "growth_coefficient": 4e-11, "growth_order": 2},
    "nucleation": {
        "law": "secondary_nucleation",
        "nucleation_coefficient": 1e7,
        "nucleation_order": 2,
        "magma_order": 0,
    },
}


def davies(z, strength):
    """Davies with Güntelberg's A = 0.509 at 25 °C, as printed in textbooks."""
    return 10 ** (-0.509 * z * z * (np.sqrt(strength) / (1 + np.sqrt(strength)) - 0.3 * strength))


def test_precipitation_starts_at_the_activity_product_and_ends_at_its_equilibrium():
    """Barium sulfate, Ksp 1.08e-10: half a mole of excess barium; what is left follows from the product of
    activities by bisection.
    """
    out = precipitation_batch(
        0.02,
        0.1,
        ConstantFlow(0.1 / 1200, 0.0, 1200.0),
        duration=36000.0,
        crystal_density=4500.0,
        molar_mass=0.2334,
        salt="barium sulfate",
        **KINETICS,
        seed_mass_per_solvent=1e-2,
    )
    S = np.asarray(out.supersaturation_ratio)
    assert S[-1] == pytest.approx(1.0, abs=0.02)
    # 0.02 mol Ba in 1.1 kg, 0.01 mol sulfate; counter-ions 0.04 and 0.02 mol of single charge
    barium = 0.01 / 1.1
    strength = 0.5 * (4 * barium + (0.04 + 0.02) / 1.1)
    sulfate = 1.08e-10 / (davies(2, strength) ** 2 * barium)
    assert float(out.anion_molality[-1]) == pytest.approx(sulfate, rel=0.06)
    assert float(out.cation_molality[-1]) == pytest.approx(barium, rel=1e-3)
    assert out.yield_fraction == pytest.approx(1.0, abs=1e-3)
    assert np.all(np.asarray(out.crystals_per_solvent) <= 0.01 * 0.2334 + 1e-2 + 1e-12)


def test_precipitation_is_second_order_and_conserves_both_ions():
    common = {
        "cation_molality": 0.01,
        "anion_molality": 0.1,
        "reagent_program": ConstantFlow(0.1 / 1200),
        "duration": 1200.0,
        "crystal_density": 4500.0,
        "molar_mass": 0.2334,
        "salt": "barium sulfate",
        **KINETICS,
    }
    coarse, fine, finest = (precipitation_batch(**common, steps=n) for n in (200, 400, 1600))
    errors = [abs(float(o.crystals_number[-1] / finest.crystals_number[-1]) - 1) for o in (coarse, fine)]
    assert errors[0] / errors[1] > 3.0
    assert fine.step_error < 5e-3
    # One mole of each ion in one mole of salt: equal amounts added, equal amounts left.
    assert float(fine.cation_molality[-1]) == pytest.approx(float(fine.anion_molality[-1]), rel=1e-9)
    left = float(fine.cation_molality[-1]) * 1.1 + float(fine.crystals_per_solvent[-1]) / 0.2334
    assert left == pytest.approx(0.01, rel=1e-9)


def test_next_batch_prefers_what_tells_most():
    """The same batch again divides every error by the square root of two; its information is additive."""
    common = {
        "growth_coefficient": KG,
        "growth_order": G_ORDER,
        "nucleation_coefficient": KB,
        "nucleation_order": B_ORDER,
        "solubility": SOLUBILITY,
        "temperature_start": 305.15,
        "temperature_end": 301.15,
        "crystal_density": DENSITY,
    }
    once = next_batch(**common, candidate_seed_masses=[5e-4], candidate_durations=[4800.0])
    twice = next_batch(
        **common,
        candidate_seed_masses=[5e-4],
        candidate_durations=[4800.0],
        done_seed_masses=[5e-4],
        done_durations=[4800.0],
    )
    for a, b in zip(once[2:], twice[2:], strict=True):
        assert a[0] / b[0] == pytest.approx(np.sqrt(2.0), rel=1e-6)
    ranked = next_batch(**common, candidate_seed_masses=[1e-2, 5e-4], candidate_durations=[4800.0, 4800.0])
    assert ranked.seed_mass_per_solvent[0] == 5e-4  # little seed: nuclei matter
    assert np.all(np.diff(ranked.joint_error) > 0)
    with pytest.raises(InputError, match="duration"):
        next_batch(**common, candidate_seed_masses=[1e-2, 5e-4], candidate_durations=[4800.0])


def test_pure_growth_moves_a_distribution_as_it_is():
    """Constant growth: every moment about the moving origin stays (square pulse of 100 to 200 um moved by
    60 um).
    """
    start = Seeds(jnp.linspace(1e-4, 1.9e-4, 10), jnp.linspace(1.1e-4, 2e-4, 10), jnp.full(10, 1e6))
    rates = Model(
        PolynomialSolubility([1e-6]), Constant(1e-8), NoNucleation(), Crystal(1000.0), SolventVolume(1000.0)
    )
    found = march(
        rates, Programmed(lambda t: 300.0 + 0.0 * t), start, 50.0, 1e5, jnp.linspace(0, 6000.0, 7)
    ).final
    np.testing.assert_allclose(found.low[:10], start.low + 6e-5, rtol=1e-9)
    np.testing.assert_allclose(found.number[:10], start.number, rtol=1e-14)


def test_bad_input_is_told():
    program = PowerCooling(305.15, 301.15, DURATION)
    with pytest.raises(InputError, match="fraction"):
        crystallizer_balance(mass_flow=1.0, solute_mass_fraction=1.2, solubility_per_solvent=0.2)
    with pytest.raises(InputError, match="per kg of solvent"):  # g per liter for kg per kg
        batch(**{**SEEDED, "solute_per_solvent": 493.0}, temperature_program=program)
    with pytest.raises(InputError, match="g per kg"):
        batch(
            **{
                **SEEDED,
                "solubility": {"law": "polynomial_solubility", "coefficients": [128.6, 5.88, 0.1721]},
            },
            temperature_program=program,
        )
    with pytest.raises(InputError, match="unit"):
        batch(**{**SEEDED, "seed_size": "100 m"}, temperature_program=program)
    with pytest.raises(ApplicabilityError, match="132"):
        batch(
            **{**SEEDED, "solubility": LibrarySolubility("KNO3")},
            temperature_program=PowerCooling(405.15, 301.15, DURATION),
        )
    with pytest.raises(InputError, match=r"must be|not possible|between|above"):
        batch(**{**SEEDED, "seed_mass_per_solvent": -1.0}, temperature_program=program)
    told = LibrarySolubility("potassium nitrate")
    with collect() as records:
        told(500.0)
    assert any(bool(r.mask) for r in records)  # outside the data: extrapolated
    # Seeds larger than the size classes of the line: told by a check, not hidden.
    small = Mixture(
        mixture().solids, mixture().liquids, mixture().gases, (0.0, *map(float, np.geomspace(2e-5, 5e-5, 40)))
    )
    feed = empty(small, 333.15).replace(liquid=jnp.array([1.0, 1.0]))
    unit = BatchCrystallizer(
        temperature_program=PowerCooling(333.15, 293.15, 10800.0, 2.0),
        duration=10800.0,
        seed_mass_per_solvent=0.01,
        **LAWS,
    )
    failed = [c.name for c in unit.operate(feed=feed).checks if not c.ok]
    assert any("largest size class" in name for name in failed)
