"""Crystals that meet and break in batches and tubes of a line: closed forms of their number, the vessel
without collisions, balances of what strangers ask.
"""

from __future__ import annotations

import jax
import jax.numpy as jnp
import numpy as np
import pytest
from tests.sharing.crystallization import GROWTH, NUCLEATION, mixture

from granum.core.errors import ApplicabilityError
from granum.core.flags import collect
from granum.crystallization.equipment.antisolvent import AntisolventBatchCrystallizer
from granum.crystallization.equipment.batch import BatchCrystallizer, VacuumBatchCrystallizer
from granum.crystallization.equipment.controlled import ControlledBatchCrystallizer
from granum.crystallization.equipment.tubes import PlugFlowCrystallizer
from granum.crystallization.formulas.agglomeration import (
    Attrition,
    ConstantKernel,
    PowerBreakage,
    TurbulentKernel,
)
from granum.crystallization.formulas.growth import PowerLawDissolution
from granum.crystallization.formulas.nucleation import NoNucleation
from granum.crystallization.formulas.programs import PowerCooling
from granum.crystallization.formulas.solubility_laws import PolynomialSolubility
from granum.streams.audit import closure
from granum.streams.stream import empty

SOLUBILITY = PolynomialSolubility([0.1286, 5.88e-3, 1.721e-4])
LAWS = {"solubility": SOLUBILITY, "growth": GROWTH, "nucleation": NUCLEATION}


def program(start=305.15, end=301.15, duration=4800.0):
    return PowerCooling(start, end, duration, 1.0)


def fed(ratio=0.493, crystals=0.0, water=1.0, temperature=305.15):
    there = mixture()
    solid = jnp.zeros(empty(there, temperature).solid.shape).at[0, 5].set(crystals)
    return empty(there, temperature).replace(liquid=jnp.array([water, ratio * water]), solid=solid)


def batch(cls=BatchCrystallizer, laws=LAWS, **more):
    given = {"temperature_program": program(), "duration": 4800.0, "seed_mass_per_solvent": 5e-3, **laws}
    return cls(**(given | more))


@pytest.mark.parametrize("meetings", [0.3, 3.0])
def test_number_of_a_constant_kernel(meetings: float):
    """Smoluchowski: N₀/N = 1 + β N₀ t/(2V) in a liquor that is saturated and stays so."""
    still = batch(
        laws=LAWS | {"nucleation": NoNucleation()},
        temperature_program=program(305.15, 305.15),
        seed_mass_per_solvent=0.05,
    )
    feed = fed(float(SOLUBILITY(305.15)))
    plain = still.operate(feed=feed).inside
    volume = feed.slurry_volume_flow + 0.05 / feed.mixture.densities("solids", 305.15)[0]
    kernel = ConstantKernel(2.0 * meetings * float(volume) / (float(plain.moments[0]) * 4800.0))
    met = batch(
        laws=LAWS | {"nucleation": NoNucleation()},
        temperature_program=program(305.15, 305.15),
        seed_mass_per_solvent=0.05,
        agglomeration_kernel=kernel,
    )
    inside = met.operate(feed=feed).inside
    assert float(plain.moments[0] / inside.moments[0]) == pytest.approx(1.0 + meetings, rel=5e-3)
    assert float(inside.moments[3]) == pytest.approx(float(plain.moments[3]), rel=1e-9)


def test_number_that_breakage_makes():
    """Two fragments with a frequency as the cube of size: N − N₀ = s m₃ t, whatever they become."""
    frequency, size = 1e-5, 5e-4
    laws = LAWS | {"nucleation": NoNucleation()}
    more = {"temperature_program": program(305.15, 305.15), "seed_mass_per_solvent": 0.05, "seed_size": 4e-4}
    feed = fed(float(SOLUBILITY(305.15)))
    plain = batch(laws=laws, **more).operate(feed=feed).inside
    broken = batch(laws=laws, breakage_law=PowerBreakage(frequency, size), **more).operate(feed=feed).inside
    expected = frequency / size**3 * plain.moments[3] * 4800.0
    assert float(broken.moments[0] - plain.moments[0]) == pytest.approx(float(expected), rel=0.01)
    assert float(broken.moments[3]) == pytest.approx(float(plain.moments[3]), rel=1e-6)


@pytest.mark.parametrize("crystals", [0.0, 0.01])
def test_batch_without_collisions_is_the_plain_one(crystals: float):
    feed = fed(crystals=crystals)
    plain = batch().operate(feed=feed)
    same = batch(agglomeration_kernel=ConstantKernel(0.0)).operate(feed=feed)
    made, other = plain.outlets.product, same.outlets.product
    assert float(other.solid_flow) == pytest.approx(float(made.solid_flow), rel=1e-9)
    np.testing.assert_allclose(other.solid, made.solid, rtol=1e-3, atol=2e-4 * float(made.solid_flow))
    assert float(same.figures.mean_diameter_mass) == pytest.approx(
        float(plain.figures.mean_diameter_mass), rel=1e-6
    )
    assert plain.figures.nuclei_mass_fraction > 0.0
    assert same.figures.nuclei_mass_fraction is None  # who was a nucleus is forgotten


def test_a_tube_is_the_batch_of_its_time():
    feed, kernel = fed(), TurbulentKernel(200.0, 1e-5)
    tube = PlugFlowCrystallizer(
        temperature_program=program(),
        volume=4800.0 * float(feed.slurry_volume_flow),
        seed_mass_per_solvent=5e-3,
        agglomeration_kernel=kernel,
        **LAWS,
    )
    spread = PlugFlowCrystallizer(
        temperature_program=program(),
        volume=4800.0 * float(feed.slurry_volume_flow),
        seed_mass_per_solvent=5e-3,
        agglomeration_kernel=kernel,
        tank_number_tube=1e5,
        **LAWS,
    )
    same = batch(agglomeration_kernel=kernel).operate(feed=feed)
    for unit in (tube, spread):
        found = unit.operate(feed=feed)
        np.testing.assert_allclose(
            found.outlets.product.solid, same.outlets.product.solid, atol=1e-4 * float(same.figures[0])
        )
        assert float(found.figures.mean_diameter_mass) == pytest.approx(
            float(same.figures.mean_diameter_mass), rel=1e-3
        )


def test_larger_kernels_make_larger_crystals_and_breakage_smaller():
    feed = fed()

    def size(law, efficiency, frequency):
        kernel = TurbulentKernel(200.0, efficiency)
        moments = (
            batch(agglomeration_kernel=kernel, breakage_law=law(frequency, 5e-4))
            .operate(feed=feed)
            .inside.moments
        )
        return moments[4] / moments[3]

    for law in (PowerBreakage, Attrition):
        found = jax.jit(lambda e, s, law=law: size(law, e, s))
        joined = [float(found(e, 0.0)) for e in (0.0, 1e-6, 1e-5, 1e-4)]
        assert joined == sorted(joined)
        assert joined[-1] > 1.05 * joined[0]
        broken = [float(found(0.0, s)) for s in (0.0, 1e-5, 1e-4)]
        assert broken == sorted(broken, reverse=True)


@pytest.mark.parametrize("count", [5, pytest.param(100, marks=pytest.mark.long)])
def test_random_batches_close(count: int):
    rng = np.random.default_rng(23)

    @jax.jit
    def made_of(kernel, frequency, ratio, crystals, seeds, size, colder):
        unit = batch(
            temperature_program=program(305.15, 305.15 - colder),
            seed_mass_per_solvent=seeds,
            seed_size=size,
            agglomeration_kernel=ConstantKernel(kernel),
            breakage_law=PowerBreakage(frequency, 5e-4),
        )
        feed = fed(ratio, crystals)
        run = unit.operate(feed=feed)
        product = run.outlets.product
        mass = closure([feed], [product]).mass
        over = product.liquid[1] / product.liquid[0] / SOLUBILITY(305.15 - colder)
        return mass, over, product.solid, jnp.max(run.inside.course.collided)

    seen = 0
    for _trial in range(count):
        given = (
            10 ** rng.uniform(-16.0, -12.0),
            10 ** rng.uniform(-8.0, -4.0),
            rng.uniform(0.485, 0.5),
            rng.choice([0.0, 0.02]),
            10 ** rng.uniform(-4.0, -1.5),
            10 ** rng.uniform(-4.3, -3.5),
            rng.uniform(3.0, 12.0),
        )
        mass, over, solid, busy = made_of(*given)
        if busy > 0.5:
            continue
        seen += 1
        assert float(jnp.max(jnp.abs(mass))) < 1e-12
        assert float(over) > 1.0 - 1e-9  # growth stops at saturation
        assert float(jnp.min(solid)) >= 0.0
    assert seen > 0.6 * count


def test_what_is_refused():
    feed = fed()
    with pytest.raises(ApplicabilityError, match="only while they grow"):
        batch(agglomeration_kernel=ConstantKernel(1e-13), dissolution=PowerLawDissolution(1e-4, 1.0)).operate(
            feed=feed
        )
    with collect() as records:
        batch(agglomeration_kernel=ConstantKernel(1e-6)).operate(feed=feed)
    assert any("meet or break" in str(record) for record in records)


@pytest.mark.parametrize("cls", [VacuumBatchCrystallizer, ControlledBatchCrystallizer])
def test_the_other_batches_take_a_kernel(cls):
    more = {"temperature_end": 301.15} if cls is ControlledBatchCrystallizer else {}
    given = {"supersaturation_kept": 0.005} if more else {"temperature_program": program()}
    sizes = [
        float(
            cls(
                duration=4800.0,
                seed_mass_per_solvent=5e-3,
                agglomeration_kernel=kernel,
                **LAWS,
                **more,
                **given,
            )
            .operate(feed=fed())
            .figures.mean_diameter_mass
        )
        for kernel in (None, TurbulentKernel(200.0, 1e-5))
    ]
    assert sizes[1] > sizes[0]
    assert AntisolventBatchCrystallizer.collisions is not None
