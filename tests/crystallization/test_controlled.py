"""Batches at constant supersaturation and with cycles of heating, against closed forms."""

from __future__ import annotations

import jax
import jax.numpy as jnp
import numpy as np
import pytest
from tests.sharing.crystallization import (
    DENSITY,
    DURATION,
    G_ORDER,
    KG,
    SEEDED,
    SOLUBILITY,
    START,
    ConstantBirths,
    model,
    seeds,
)

import granum as gr
from granum.core.errors import InputError
from granum.crystallization.formulas.growth import PowerLawDissolution, PowerLawGrowth
from granum.crystallization.formulas.programs import CycledCooling, PowerCooling
from granum.crystallization.formulas.solubility_laws import PolynomialSolubility
from granum.crystallization.population.lagrangian import Model, SolventVolume, march
from granum.crystallization.population.operations import Counted, Held, Programmed, Sensor
from granum.crystallization.vessels.crystals import Crystal

KEPT, HOT, COLD = 0.004, 305.15, 301.15
ENDS = {"temperature_start": HOT, "temperature_end": COLD, "supersaturation_kept": KEPT}
STRAIGHT = {"law": "polynomial_solubility", "coefficients": [0.12, 0.011]}
BARE = {key: value for key, value in SEEDED.items() if key not in ("nucleation", "seed_width", "solubility")}


def test_seeds_grow_at_a_constant_rate_and_the_temperature_falls_with_the_cube():
    """By hand: L = L0 + G t; with a straight solubility T falls as the crystal mass grows, the cube of L."""
    charged = (1 + KEPT) * (0.12 + 0.011 * 32)
    found = gr.crystallization.controlled_batch(
        **BARE | ENDS | {"solute_per_solvent": charged, "seed_mass_per_solvent": 0.004, "steps": 200},
        solubility=STRAIGHT,
    )
    rate = KG * KEPT**G_ORDER
    crop = (1 + KEPT) * 0.011 * (HOT - COLD)
    largest = 100e-6 * (1 + crop / 0.004) ** (1 / 3)
    ending = gr.crystallization.duration_for_growth("100 um", largest, rate)
    assert ending < 0.9 * DURATION
    under = found.time < ending
    size = 100e-6 + rate * found.time
    np.testing.assert_allclose(found.growth_rate[under], rate, rtol=1e-9)
    np.testing.assert_allclose(
        found.crystals_per_solvent[under], 0.004 * (size[under] / 1e-4) ** 3, rtol=1e-9
    )
    fall = ((size / 1e-4) ** 3 - 1) / ((largest / 1e-4) ** 3 - 1)
    np.testing.assert_allclose(found.temperature[under], HOT - (HOT - COLD) * fall[under], rtol=1e-9)
    np.testing.assert_allclose(found.temperature[~under][1:], COLD, rtol=1e-12)


def test_a_slow_vessel_cools_as_fast_as_it_can():
    found = gr.crystallization.controlled_batch(
        **SEEDED | ENDS | {"supersaturation_kept": 0.05, "steps": 100}, cooling_rate_maximum="4 K/h"
    )
    slow = found.time < 3500.0
    np.testing.assert_allclose(found.temperature[slow], HOT - 4.0 * found.time[slow] / 3600.0, rtol=1e-12)


FASTEST = 20.0 / 3600.0


def held(kept, error=0.0):
    made = model()
    operation = Held(made, kept, HOT, COLD, FASTEST, Sensor(error, 60.0))
    return march(made, operation, seeds(), START, 1.0, jnp.linspace(0.0, DURATION, 161))


def test_readings_that_err_cost_nuclei_and_never_mass():
    true, erring = held(0.006), held(0.006, 0.005)
    for found in (true, erring):
        total = found.solute_per_solvent + found.crystals
        assert float(jnp.max(jnp.abs(total - total[0]))) < 1e-14
        assert float(jnp.max(found.temperature)) <= HOT
        assert float(jnp.min(found.temperature)) >= COLD
        assert float(jnp.max(jnp.abs(jnp.diff(found.temperature)))) <= FASTEST * 30.0 + 1e-9
    assert float(erring.moments[-1, 0]) > 1.05 * float(true.moments[-1, 0])


def test_the_crystals_have_an_exact_slope_with_the_supersaturation_kept():
    number = jax.jit(lambda kept: jax.jvp(lambda k: held(k).moments[-1, 0], (kept,), (1.0,)))
    (_value, slope), (more, _), (less, _) = (number(0.006 + change) for change in (0.0, 1e-7, -1e-7))
    assert float(slope) == pytest.approx(float(more - less) / 2e-7, rel=1e-4)


def test_cycles_of_heating_reach_the_end_and_dissolve_what_was_born_last():
    cycles = CycledCooling(HOT, COLD, DURATION, 3, 2.0, 0.25)
    times = np.linspace(0.0, DURATION, 100001)
    T = np.asarray(cycles(times))
    assert T[0] == pytest.approx(HOT)
    assert T[-1] == pytest.approx(COLD)
    risen = np.diff(T)[np.diff(T) > 0]
    assert risen.sum() == pytest.approx(6.0, rel=1e-3)  # three times two kelvin
    assert len(risen) / len(times) == pytest.approx(0.25, rel=1e-3)
    made = Model(
        PolynomialSolubility(SOLUBILITY["coefficients"]),
        PowerLawGrowth(KG, G_ORDER),
        ConstantBirths(10.0),
        Crystal(DENSITY),
        SolventVolume(1.0),
        PowerLawDissolution(1e-3),
    )
    steps = jnp.linspace(0.0, DURATION, 161)
    cycled, straight = (
        march(made, Programmed(program), seeds(), START, 1.0, steps)
        for program in (cycles, PowerCooling(HOT, COLD, DURATION, 1.0))
    )
    started, born = float(straight.moments[0, 0]), 10.0 * DURATION
    assert float(straight.moments[-1, 0]) == pytest.approx(started + born, rel=1e-9)
    assert started <= float(cycled.moments[-1, 0]) < started + 0.75 * born  # none of the quarter that heats
    total = cycled.solute_per_solvent + cycled.crystals
    assert float(jnp.max(jnp.abs(total - total[0]))) < 1e-13


def test_half_a_cycle_is_refused():
    with pytest.raises(InputError, match="cycle_number"):
        gr.crystallization.CycledCooling("32 degC", "28 degC", "80 min", 2.5)


def test_what_cooling_cannot_do_is_refused():
    flat = {"law": "polynomial_solubility", "coefficients": [0.6, -0.003]}
    with pytest.raises(InputError, match="does not fall on cooling"):
        gr.crystallization.controlled_batch(**SEEDED | ENDS | {"solubility": flat})
    with pytest.raises(InputError, match="above its start"):
        gr.crystallization.controlled_batch(**SEEDED | ENDS | {"temperature_end": 310.0})


def test_unit_tells_when_it_is_cool_and_what_its_jacket_takes():
    run = gr.alone("crystallization.controlled_batch_crystallizer").solve()
    unit = run.units["controlled_batch_crystallizer"]
    figures = unit.values
    assert 0.5 * DURATION < float(figures.time_cooled) < DURATION
    mean = -float(figures.heat_duty) * 7200.0 / float(figures.time_cooled)
    assert mean < float(figures.heat_duty_maximum) < 6.0 * mean
    assert run.audit["energy_closure"] < 1e-9


def counting(lower, upper, births=10.0, **other):
    """A kilogram of water in which crystals are born at a constant rate, between 34 and 28 degC."""
    made = Model(
        PolynomialSolubility(SOLUBILITY["coefficients"]),
        PowerLawGrowth(KG, G_ORDER),
        ConstantBirths(births),
        Crystal(DENSITY),
        SolventVolume(1.0),
        PowerLawDissolution(1e-3),
    )
    rates = {"cooling": 6.0 / 3600.0, "between": 3.0 / 3600.0, "heating": 12.0 / 3600.0} | other
    operation = Counted(made, lower, upper, HOT, COLD, **rates)
    times = jnp.linspace(0.0, 2400.0, 201)
    return march(made, operation, seeds(), START, 1.0, times), float(seeds().moments()[0])


def test_the_count_turns_cooling_down_and_then_into_heating():
    """By hand: 10 crystals/s from the seeds' number on; straight lines of the three rates in between."""
    found, seeded = counting(*(float(seeds().moments()[0]) + n for n in (6005.0, 12005.0)))
    T, t = np.asarray(found.temperature), np.asarray(found.time)
    assert float(found.moments[100, 0]) == pytest.approx(seeded + 12000.0, rel=1e-9)
    np.testing.assert_allclose(T[:52], HOT - 6.0 * t[:52] / 3600.0, rtol=1e-12)
    np.testing.assert_allclose(T[51:102], T[51] - 3.0 * (t[51:102] - t[51]) / 3600.0, rtol=1e-12)
    np.testing.assert_allclose(T[102:105] - T[101], 12.0 * (t[102:105] - t[101]) / 3600.0, rtol=1e-9)
    assert float(found.moments[150, 0]) < seeded + 12200.0  # what was born last is dissolved again
    total = found.solute_per_solvent + found.crystals
    assert float(jnp.max(jnp.abs(total - total[0]))) < 1e-13


def test_a_bound_that_no_count_reaches_leaves_a_straight_line():
    found, _seeded = counting(1e8, 1e9)
    np.testing.assert_allclose(
        found.temperature, np.maximum(HOT - 6.0 * found.time / 3600.0, COLD), rtol=1e-12
    )


UNSEEDED = {k: v for k, v in BARE.items() if not k.startswith("seed")} | {
    "solubility": SOLUBILITY,
    "dissolution": {"law": "power_law_dissolution", "dissolution_coefficient": "1 mm/s"},
    "temperature_start": "34 degC",
    "temperature_end": "28 degC",
}


def test_bounds_that_cannot_be_kept_are_refused():
    batch = gr.crystallization.nucleation_controlled_batch
    with pytest.raises(InputError, match="not below the upper one"):
        batch(**UNSEEDED, crystal_number_lower="30 1/cm^3", crystal_number_upper="20 1/cm^3")
    with pytest.raises(InputError, match="would stay warm"):
        batch(
            **UNSEEDED | {"temperature_start": "32 degC", "solute_per_solvent": 0.495},
            seed_mass_per_solvent=0.01,
            crystal_number_lower="10 1/cm^3",
            crystal_number_upper="20 1/cm^3",
        )


def test_a_batch_in_which_nothing_is_ever_born_says_so():
    with pytest.raises(InputError, match="wait for ever"):
        gr.crystallization.nucleation_controlled_batch(
            **UNSEEDED, crystal_number_lower=1e7, crystal_number_upper=1e8, steps=50
        )


@pytest.mark.long
@pytest.mark.parametrize(("order", "there"), [(1, 0.0), (0, 1.0)])
def test_a_unit_tells_that_nothing_is_ever_born(order, there):
    law = "law='secondary_nucleation', nucleation_coefficient=1e10, nucleation_order=2"
    births = f"{{{law}, magma_order={order}}}"
    unit = "nucleation_controlled_crystallizer"
    run = (
        gr.alone(f"crystallization.{unit}", nucleation=births, seed_mass_per_solvent=0.0).solve().units[unit]
    )
    assert next(c.value for c in run.checks if c.name.startswith("crystals, or")) == there
    assert float(run.values.nuclei_mass_fraction) == pytest.approx(there, abs=1e-12)


def test_unit_that_counts_ends_cool_within_its_bounds():
    run = gr.alone("crystallization.nucleation_controlled_crystallizer").solve()
    unit = run.units["nucleation_controlled_crystallizer"]
    figures = unit.values
    assert 5e7 <= float(figures.crystal_number_end) <= 1e8
    assert float(figures.heating_number) >= 1.0
    assert float(figures.time_cooled) < 5.0 * 3600.0
    assert run.audit["energy_closure"] < 1e-9
    assert all(check.low <= check.value <= check.high for check in unit.checks)
