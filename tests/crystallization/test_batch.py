"""The packet engine against closed forms, a moment solution by SciPy, and its own conservation laws."""

from __future__ import annotations

import jax
import jax.numpy as jnp
import numpy as np
import pytest
from scipy.integrate import solve_ivp
from tests.sharing.crystallization import (
    B_ORDER,
    DENSITY,
    DURATION,
    G_ORDER,
    KB,
    KG,
    START,
    Constant,
    ConstantBirths,
    by_scipy,
    linear_cooling,
    model,
    seeds,
)

from granum.crystallization.formulas.growth import PowerLawDissolution, PowerLawGrowth
from granum.crystallization.formulas.nucleation import NoNucleation, PowerLawNucleation
from granum.crystallization.formulas.solubility_laws import AntisolventSolubility, PolynomialSolubility
from granum.crystallization.population.lagrangian import Model, SolventVolume, march
from granum.crystallization.population.operations import Addition, Flashing, HeatData, Jacketed, Programmed
from granum.crystallization.population.packets import Seeds, SizeMap
from granum.crystallization.vessels.crystals import Crystal, ratio_left


def published(mass=0.5, steps=400, **more):
    times = jnp.linspace(0.0, DURATION, steps + 1)
    return march(model(**more), Programmed(linear_cooling), seeds(mass), START, 1.0, times)


def test_published_seeded_batch_agrees_with_the_moment_solution():
    exact, ratio = by_scipy()
    found = jax.jit(published)()
    np.testing.assert_allclose(found.moments[-1], exact, rtol=1e-4)
    assert float(found.solute_per_solvent[-1]) == pytest.approx(ratio, abs=1e-7)
    packets = found.final
    np.testing.assert_allclose(packets.moments(), found.moments[-1], rtol=1e-12)
    fourth = jnp.sum(packets.number * (packets.high**5 - packets.low**5) / (5 * (packets.high - packets.low)))
    assert float(fourth / packets.moments()[3]) == pytest.approx(exact[4] / exact[3], rel=1e-4)  # L43


# Crystallizer_Simulator_Batch of mingchunNTU on GitHub (commit 735fcfc), examples/KNO3: moments by SciPy's
# odeint, cubic cooling given each minute and
# straight between, 1 mg/L of seed. Minute: concentration g/L, crystals per um3, third moment (seed plus
# nuclei).
OTHER_PROGRAM = {
    70: (451.000685785, 4.71081156e-13 + 1.2005812912729573e-9, 8.135469267098824e-4 + 0.01908726548575129),
    75: (
        441.06714452488444,
        4.71081156e-13 + 1.4002963290693877e-9,
        8.703376416682174e-4 + 0.023738314230783472,
    ),
    80: (
        429.9160604891147,
        4.71081156e-13 + 1.6225426615783383e-9,
        9.255361397605218e-4 + 0.028967989683292943,
    ),
}


def test_published_batch_agrees_with_another_program():
    minutes = jnp.arange(81) * 60.0
    cooling = 305.15 - 4.0 * (minutes / DURATION) ** 3
    program = Programmed(lambda t: jnp.interp(t, minutes, cooling))
    found = jax.jit(
        lambda: march(model(), program, seeds(0.001), START, 1.0, jnp.linspace(0.0, DURATION, 801))
    )()
    for minute, (concentration, number, third) in OTHER_PROGRAM.items():
        m = found.moments[10 * minute]
        assert float(found.solute_per_solvent[10 * minute]) * 1e3 == pytest.approx(concentration, rel=1e-4)
        assert float(m[0]) * 1e-15 == pytest.approx(number, rel=1e-4)
        assert float(m[3]) * 1e3 == pytest.approx(third, rel=1e-4)


def test_second_order_and_conservation():
    exact, _ratio = by_scipy()
    errors = [abs(float(published(steps=n).moments[-1, 0]) / exact[0] - 1) for n in (100, 200, 400)]
    assert errors[0] / errors[1] > 3.6
    assert errors[1] / errors[2] > 3.6
    found = published()
    total = found.solute_per_solvent + found.crystals
    assert float(jnp.max(jnp.abs(total - total[0]))) < 1e-14
    assert bool(jnp.all(found.final.number >= 0))


@pytest.mark.parametrize("steps", [100])
def test_heavy_seed_and_fast_growth_never_undershoot_saturation(steps):
    found = published(20.0, steps, kg=300 * KG)
    assert float(jnp.min(found.solute_per_solvent - found.solubility_per_solvent)) > -1e-15
    fine = published(20.0, 1600, kg=300 * KG)
    assert float(found.solute_per_solvent[-1] - fine.solute_per_solvent[-1]) == pytest.approx(0.0, abs=3e-8)
    assert float(found.moments[-1, 0] / fine.moments[-1, 0]) == pytest.approx(1.0, rel=1e-5)


def test_growth_and_nucleation_at_constant_rates():
    """mu0 = B t, mu3 = B G^3 t^4 / 4, from an unseeded start."""
    rates = Model(
        PolynomialSolubility([1e-6]),
        Constant(1e-8),
        ConstantBirths(1e6),
        Crystal(1000.0),
        SolventVolume(1000.0),
    )
    found = march(
        rates, Programmed(lambda t: 300.0 + 0.0 * t), Seeds.none(), 0.5, 1000.0, jnp.linspace(0, 1000.0, 51)
    )
    np.testing.assert_allclose(found.moments[-1, 0], 1e6 * 1000.0, rtol=1e-12)
    np.testing.assert_allclose(found.moments[-1, 3], 1e6 * 1e-24 * 1000.0**4 / 4, rtol=1e-11)


@pytest.mark.parametrize("kind", ["moments", "tracked"])
def test_unseeded_start_makes_crystals(kind):
    more = {} if kind == "moments" else {"dissolution": PowerLawDissolution(1e-5)}
    births = PowerLawNucleation(1e14, 3.0, magma_order=0.0)
    rates = Model(
        PolynomialSolubility([0.1286, 5.88e-3, 1.721e-4]),
        PowerLawGrowth(KG, 1.32),
        births,
        Crystal(DENSITY),
        SolventVolume(1000.0),
        **more,
    )
    found = march(rates, Programmed(linear_cooling), Seeds.none(), START, 1.0, jnp.linspace(0, DURATION, 401))
    assert float(found.crystals[-1]) > 0.05
    assert float(found.solute_per_solvent[-1] + found.crystals[-1]) == pytest.approx(START, abs=1e-14)


def test_tracked_packets_agree_with_shifted_moments():
    plain, tracked = published(), published(dissolution=PowerLawDissolution(1e-5))
    np.testing.assert_allclose(tracked.moments[-1], plain.moments[-1], rtol=1e-9)


def test_dissolution_of_an_exponential_distribution():
    """n = exp(-L/l) shifted down by 2 l keeps exp(-2) of each moment; naive moment equations give a negative
    mass.
    """
    size = 1e-4
    edges = jnp.linspace(0.0, 40 * size, 4001)
    number = jnp.exp(-edges[:-1] / size) - jnp.exp(-edges[1:] / size)
    start = Seeds(edges[:-1], edges[1:], number)
    rates = Model(
        PolynomialSolubility([0.5]),
        Constant(0.0),
        NoNucleation(),
        Crystal(1000.0),
        SolventVolume(1000.0),
        dissolution=Constant(1e-6),
    )
    found = march(
        rates, Programmed(lambda t: 300.0 + 0.0 * t), start, 0.1, 1000.0, jnp.linspace(0, 200.0, 101)
    )
    np.testing.assert_allclose(found.moments[-1], np.exp(-2.0) * np.asarray(found.moments[0]), rtol=3e-4)
    assert float(found.moments[-1, 3]) > 0


def test_temperature_cycle_dissolves_fines_and_conserves():
    def cycle(t):
        return 303.15 - 3.0 * jnp.sin(2 * jnp.pi * t / 2400.0)

    found = march(
        model(dissolution=PowerLawDissolution(KG, 1.0)),
        Programmed(cycle),
        seeds(),
        START,
        1.0,
        jnp.linspace(0, DURATION, 401),
    )
    numbers = found.moments[:, 0]
    assert float(jnp.max(numbers)) > float(numbers[-1]) >= 0.0  # crystals disappear while it is warm
    total = found.solute_per_solvent + found.crystals
    assert float(jnp.max(jnp.abs(total - total[0]))) < 1e-13
    assert float(jnp.min(found.solute_per_solvent / found.solubility_per_solvent - 1)) < -1e-4


def test_size_dependent_growth_follows_its_path():
    """phi = 1 + gamma L with constant G0: L(t) = (L0 + 1/gamma) exp(gamma G0 t) - 1/gamma; b close to 1."""
    gamma, b = 1e4, 0.5
    growth_map = SizeMap(gamma, b)
    rates = Model(
        PolynomialSolubility([1e-6]),
        Constant(1e-8),
        NoNucleation(),
        Crystal(1000.0),
        SolventVolume(1000.0),
        size_map=growth_map,
    )
    found = march(
        rates,
        Programmed(lambda t: 300.0 + 0.0 * t),
        Seeds.of_one_size(1e-4, 1e-3, 1000.0),
        0.5,
        1000.0,
        jnp.linspace(0, 5000.0, 11),
    )
    exact = solve_ivp(
        lambda t, L: 1e-8 * (1 + gamma * L) ** b, (0, 5000.0), [1e-4], rtol=1e-10, atol=1e-16
    ).y[0, -1]
    assert float((found.moments[-1, 3] / found.moments[-1, 0]) ** (1 / 3)) == pytest.approx(exact, rel=1e-8)


@pytest.mark.long
def test_jacobian_of_six_parameters_is_exact():
    def run(q):
        return (
            published(q[4], 200, kg=q[0], growth_order=q[1], kb=q[2], nucleation_order=q[3]).moments[-1]
            * q[5]
        )

    run = jax.jit(run)
    q = jnp.array([KG, G_ORDER, KB, B_ORDER, 0.5, 1.0])
    jacobian = jax.jit(jax.jacfwd(run))(q)
    for i in range(6):
        h = 1e-5 * q[i]
        np.testing.assert_allclose(
            jacobian[:, i], (run(q.at[i].add(h)) - run(q.at[i].add(-h))) / (2 * h), rtol=1e-6
        )
    np.testing.assert_allclose(jax.jit(jax.jacrev(run))(q), jacobian, rtol=1e-9)


HEAT = HeatData(3800.0, 920.0, 44.5e3)


def test_jacket_closes_the_heat_balance():
    found = march(
        model(),
        Jacketed(305.15, lambda t: 300.0 + 0.0 * t, 2.0, HEAT),
        seeds(),
        START,
        1.0,
        jnp.linspace(0, DURATION, 801),
    )
    T, m = np.asarray(found.temperature), np.asarray(found.crystals)
    capacity = (START + 1.0 - m) * 3800.0 + m * 920.0
    gained = np.sum(0.5 * (capacity[1:] + capacity[:-1]) * np.diff(T))
    removed = np.sum(2.0 * (0.5 * (T[1:] + T[:-1]) - 300.0) * np.diff(np.asarray(found.time)))
    assert removed + gained == pytest.approx(44.5e3 * (m[-1] - m[0]), abs=1e-3 * removed)
    assert 300.0 < T[-1] < 305.15


def test_vacuum_batch_evaporates_what_the_heat_balance_says():
    found = march(
        model(),
        Flashing(linear_cooling, lambda T: 2.43e6 + 0.0 * T, HEAT),
        seeds(),
        START,
        1.0,
        jnp.linspace(0, DURATION, 401),
    )
    m, gone = found.crystals, found.solvent[0] - found.solvent[-1]
    freed = 3800.0 * (START + 1.0) * 4.0 + 44.5e3 * (m[-1] - m[0])
    # the capacity falls as crystals form
    assert float(gone) == pytest.approx(float(freed) / 2.43e6, rel=3e-2)
    assert float(found.solute_per_solvent[-1] * found.solvent[-1] + m[-1]) == pytest.approx(
        START + 0.5e-3, abs=1e-13
    )


def test_evaporation_drives_crystallization():
    still = Programmed(lambda t: 305.15 + 0.0 * t, Addition(evaporated=lambda t: 0.2 * t / DURATION))
    found = march(model(), still, seeds(), START, 1.0, jnp.linspace(0, DURATION, 401))
    assert float(found.solvent[-1]) == pytest.approx(0.8)
    ideal = START - 0.8 * START  # all solute beyond saturation
    assert float(found.crystals[-1] - found.crystals[0]) == pytest.approx(ideal, rel=0.02)


def test_antisolvent_drives_crystallization():
    """All solute beyond the solubility of the final mixture crystallizes: C0 - (1 + a) C0 exp(-kappa a / (1 +
    a)).
    """
    law = AntisolventSolubility(PolynomialSolubility([0.3]), 4.0)
    added = Addition(antisolvent=lambda t: 0.5 * t / 7200.0)
    rates = Model(law, PowerLawGrowth(1e-5), NoNucleation(), Crystal(1300.0), SolventVolume(1000.0))
    start = Seeds.of_one_size(5e-5, 0.01, 1300.0)
    found = march(
        rates, Programmed(lambda t: 298.15 + 0.0 * t, added), start, 0.3, 1.0, jnp.linspace(0, 7200.0, 401)
    )
    ideal = 0.3 - 1.5 * 0.3 * np.exp(-4.0 * 0.5 / 1.5)
    assert float(found.crystals[-1] - 0.01) == pytest.approx(ideal, rel=0.02)
    assert float(found.solute_per_solvent[-1] * 1.5 + found.crystals[-1]) == pytest.approx(0.31, abs=1e-13)


def test_crystals_that_bind_solvent_never_bind_more_than_there_is():
    """A burst of a pentahydrate in a rich liquor: the crystals are those of the balance at saturation, and on
    the way past the end no liquor of two deficits is taken for a rich one.
    """
    x, T_end = 0.64, 287.15
    made = Model(
        PolynomialSolubility([0.14, 4e-3, 5e-5]),
        PowerLawGrowth(6.3e-4, 1.78),
        PowerLawNucleation(4.4e8, 1.73),
        Crystal(2284.0, solute_fraction=x),
        SolventVolume(1000.0),
    )
    times = jnp.linspace(0.0, 9000.0, 101)
    found = march(
        made, Programmed(lambda t: 318.95 - (318.95 - T_end) * t / 9000.0), seeds(2.4), 0.6, 1.0, times
    )
    assert float(jnp.max(found.residual)) < 1e-6
    c, held = 0.14 + 4e-3 * 14.0 + 5e-5 * 14.0**2, 2.4e-3
    everything, water = 0.6 + x * held, 1.0 + (1.0 - x) * held
    assert float(found.crystals[-1]) == pytest.approx(
        (everything - water * c) / (x - (1.0 - x) * c), rel=0.02
    )


def test_more_crystals_leave_a_poorer_liquor():
    crystals = np.linspace(0.0, 5.0, 101)
    assert np.all(np.diff(ratio_left(0.464, 1.0, crystals, 0.64)) < 0.0)


def test_a_vessel_that_is_filled_on_the_way_to_a_solution_sends_on_no_flood():
    """Evaporated before its feed has come: a deficit of solvent of a kilogram and traces of solute."""
    assert float(ratio_left(0.16, -0.01, 1.6, 1.0)) < 0.0  # more boiled off and more grown than there was
    assert abs(float(ratio_left(1e-12, -1.0, 0.0, 1.0))) < 1e-9
