"""Enantiomers: how they dissolve, whether they crystallize apart, and what seeding with one gives."""

from __future__ import annotations

from typing import Any

import jax
import numpy as np
import pytest
from scipy.integrate import solve_ivp
from tests.sharing.places import EXAMPLES

import granum as gr
from granum.cases.alone import alone
from granum.core.errors import CaseError, GranumError

c = gr.crystallization
ALONE, DENSITY, GROWTH, BIRTHS = 0.1, 1461.0, 3e-7, 2e7
NAME = "preferential_crystallizer"


def kept_at(T: float) -> dict[str, Any]:
    return {"law": "power_cooling", "temperature_start": T, "temperature_end": T, "duration": 3600.0}


def births(coefficient: float, magma: float = 1.0, order: float = 1.5) -> dict[str, Any]:
    return {
        "law": "secondary_nucleation",
        "nucleation_coefficient": coefficient,
        "nucleation_order": order,
        "magma_order": magma,
    }


def batch(**changes: Any) -> Any:
    fields: dict[str, Any] = {
        "solute_per_solvent": 0.12,
        "solute_per_solvent_other": 0.115,
        "solubility": {"law": "polynomial_solubility", "coefficients": [ALONE]},
        "growth": {"law": "power_law_growth", "growth_coefficient": GROWTH, "growth_order": 1.0},
        "nucleation": births(BIRTHS),
        "counter_nucleation": 0.05,
        "temperature_program": kept_at(306.15),
        "duration": "4 hour",
        "crystal_density": DENSITY,
        "seed_mass_per_solvent": 0.003,
        "seed_size": 2e-4,
    }
    return c.preferential_crystallization(**(fields | changes))


def balanced(out: Any) -> bool:
    """Each enantiomer, dissolved and in crystals, does not change."""
    first = np.asarray(out.solute_per_solvent + out.crystals_per_solvent)
    second = np.asarray(out.solute_per_solvent_other + out.crystals_other)
    return bool(max(np.ptp(first), np.ptp(second)) < 1e-14)


@pytest.mark.parametrize("alpha", [2.0, 1.6])
def test_against_scipy(alpha: float) -> None:
    """Moments of both enantiomers by LSODA; their solubilities depend on each other below a ratio of two."""
    salt = 2.0 / alpha * np.log(alpha / 2.0)
    first = 0.003 / (DENSITY * 8e-12) * np.array([1.0, 2e-4, 4e-8, 8e-12])
    scale = np.concatenate([first, first])

    def rates(_t: float, y: np.ndarray) -> np.ndarray:
        m = y * scale
        held = DENSITY * m[[3, 7]]
        ratios = np.array([0.123, 0.115]) - held
        saturated = ALONE * np.exp(salt * ratios[::-1] / ALONE)
        sigma = np.maximum(ratios / saturated - 1.0, 0.0)
        magma = held + 0.05 * held[::-1]
        born = BIRTHS * sigma**1.5 * magma
        G = GROWTH * sigma
        parts = [[born[i], *(k * G[i] * m[4 * i + k - 1] for k in (1, 2, 3))] for i in (0, 1)]
        return np.concatenate(parts) / scale

    start = np.array([1.0, 1.0, 1.0, 1.0, 0.0, 0.0, 0.0, 0.0])
    exact = solve_ivp(rates, (0.0, 14400.0), start, method="LSODA", rtol=1e-9, atol=1e-13).y[:, -1] * scale
    out = batch(racemate_solubility_ratio=alpha)
    assert balanced(out)
    assert out.crystals_per_solvent[-1] == pytest.approx(DENSITY * exact[3], rel=3e-3)
    assert out.crystals_other[-1] == pytest.approx(DENSITY * exact[7], rel=1e-2)
    assert out.step_error < 1e-3


def test_solubility_of_a_salt_beside_its_mirror_image() -> None:
    """A common ion: C₁ (C₁ + C₂) = C*², at the racemate C* / √2 each; and Meyerhoffer's rule without one."""
    racemic = ALONE / 2**0.5
    assert c.solubility_per_solvent_enantiomer(ALONE, racemic, 2**0.5) == pytest.approx(racemic, rel=1e-12)
    half = c.solubility_per_solvent_enantiomer(ALONE, 0.5 * racemic, 2**0.5)
    exact = (-0.5 * racemic + (0.25 * racemic**2 + 4 * ALONE**2) ** 0.5) / 2
    assert half == pytest.approx(exact, rel=5e-3)  # between, the logarithm is taken as straight
    assert c.solubility_per_solvent_enantiomer(ALONE, 0.3) == ALONE


def test_mandelic_acid_has_its_eutectic_where_it_was_found() -> None:
    """Lorenz and Seidel-Morgenstern (2002), recalled: 24.5 kJ/mol at 404.75 K and 25.6 kJ/mol at 391.95 K; a
    eutectic near 69 % and 387 K.
    """
    found = c.eutectic_racemate(24500, 404.75, 25600, 391.95)
    assert found.mole_fraction_eutectic == pytest.approx(0.69, abs=0.03)
    assert found.temperature_eutectic == pytest.approx(387.0, abs=1.0)
    x = found.mole_fraction_eutectic
    both = (
        c.freezing_temperature_ideal(x, 404.75, 24500 / 0.15215, 0.15215),
        c.freezing_temperature_racemate(x, 25600, 391.95),
    )
    assert both == pytest.approx((found.temperature_eutectic,) * 2, rel=1e-9)
    assert c.gibbs_energy_racemate(24500, 404.75, 25600, 391.95, temperature=391.95) < 0.0


def test_a_compound_that_melts_too_low_is_a_conglomerate() -> None:
    """Then the racemate melts as Schröder and van Laar have it for one half."""
    low = c.eutectic_racemate(24500, 404.75, 25600, 365.0)
    assert low.mole_fraction_eutectic == 0.5
    conglomerate = c.freezing_temperature_ideal(0.5, 404.75, 24500 / 0.15215, 0.15215)
    assert low.temperature_eutectic == pytest.approx(conglomerate, rel=1e-12)
    assert c.gibbs_energy_racemate(24500, 404.75, 25600, 365.0, temperature=365.0) > 0.0
    # where both are equally stable, the compound melts with the conglomerate
    assert c.gibbs_energy_racemate(24500, 404.75, 25600, conglomerate, conglomerate) == pytest.approx(
        0.0, abs=1e-6
    )
    slope = jax.grad(lambda T: c.eutectic_racemate(24500, 404.75, 25600, T).mole_fraction_eutectic)(392.0)
    assert slope > 0.0


def test_crop_of_hydrobenzoin_is_about_twice_the_excess() -> None:
    """Collet, Brienne and Jacques (1980), recalled: with 0.37 g in excess in 85 g of ethanol, crops of
    0.87 g.
    """
    excess = 0.37 / 85
    crop = c.crop_alternating_seeds(0.1, 1.1, 1.1 - excess / 0.1)
    assert crop.excess_per_solvent == pytest.approx(excess)
    assert crop.crop_per_solvent * 85 == pytest.approx(0.87, rel=0.2)
    with pytest.raises(GranumError):
        c.crop_alternating_seeds.evaluate(0.1, 1.02, 1.1).raise_for_flags()


def test_only_the_seeded_one_crystallizes_until_the_other_is_born() -> None:
    never = batch(nucleation={"law": "no_nucleation"})
    assert never.enantiomer_fraction_end == 1.0
    assert never.time_pure == 14400.0
    assert never.solute_per_solvent_other[-1] == 0.115
    assert never.enantiomeric_excess[-1] < 0.0 < never.enantiomeric_excess[0]
    soon, late = (batch(counter_nucleation=a) for a in (0.2, 0.02))
    assert 0.0 < soon.time_pure < late.time_pure
    assert soon.crop_time_pure < late.crop_time_pure
    # more seed leaves the other less time: the crop comes before it is born (Jacques, Collet and Wilen)
    seeded = batch(seed_mass_per_solvent=0.01, counter_nucleation=0.0, nucleation=births(1e8, 0.0))
    thinly = batch(seed_mass_per_solvent=0.001, counter_nucleation=0.0, nucleation=births(1e8, 0.0))
    assert seeded.crop_time_pure > 1.5 * thinly.crop_time_pure


def test_random_batches_conserve_and_stay_possible() -> None:
    rng = np.random.default_rng(5)
    for _try in range(12):
        a, b, d, e, f, g = rng.random(6)
        alpha = 1.2 + 1.6 * a
        out = batch(
            solute_per_solvent=ALONE * (0.4 + 0.5 * alpha * b),
            solute_per_solvent_other=ALONE * (0.2 + 0.6 * alpha * d),
            racemate_solubility_ratio=alpha,
            nucleation=births(10 ** (3 + 6 * e), float(f > 0.5), 1.0 + g),
            counter_nucleation=f,
            growth={"law": "power_law_growth", "growth_coefficient": 10 ** (-9 + 4 * g), "growth_order": 1.0},
            dissolution={"law": "power_law_dissolution", "dissolution_coefficient": 10 ** (-8 + 4 * a)},
            seed_mass_per_solvent=0.02 * b,
            seed_size=1e-5 * 50**d,
            steps=400,
        )
        assert balanced(out)
        for field in ("crystals_per_solvent", "crystals_other", "solute_per_solvent"):
            values = np.asarray(getattr(out, field))
            assert np.isfinite(values).all()
            assert (values >= -1e-15).all()
        share = np.asarray(out.enantiomer_fraction)
        assert ((share >= 0.0) & (share <= 1.0)).all()
        assert 0.0 <= out.time_pure <= 14400.0
        # never below saturation by growth, never above by dissolving
        ended = (float(out.solute_per_solvent[-1]), float(out.solubility_per_solvent[-1]))
        if out.solute_per_solvent[0] > out.solubility_per_solvent[0] and alpha <= 2.0:
            assert ended[0] > 0.999 * min(ended[1], float(out.solubility_per_solvent.min()))


def test_the_unit_closes_on_each_species_and_agrees_with_the_batch() -> None:
    line = alone(f"crystallization.{NAME}", enantiomer_fraction_least=0.998)
    run = line.solve()
    unit, sheet = run.units[NAME], line.sheet.units[NAME]
    feed, product = (run.streams[n] for n in run.streams)
    for k in (1, 2):
        before, after = (float(s.liquid[k] + s.solid[k - 1].sum()) for s in (feed, product))
        assert after == pytest.approx(before, rel=1e-12)
    assert run.audit["energy_closure"] < 1e-12
    ratio = float(feed.liquid[1] / feed.liquid[0])
    out = c.preferential_crystallization(
        ratio,
        ratio,
        sheet.solubility,
        sheet.growth,
        sheet.temperature_program,
        sheet.duration,
        DENSITY,
        nucleation=sheet.nucleation,
        counter_nucleation=0.01,
        seed_mass_per_solvent=0.003,
        seed_size=250e-6,
        enantiomer_fraction_least=0.998,
        liquid_density=float(feed.liquid_density),
        steps=300,
    )
    values = unit.values
    # what leaves is without the seed held back, which is pure
    grown, born = float(out.crystals_per_solvent[-1]) - 0.003, float(out.crystals_other[-1])
    assert values.enantiomer_fraction_end == pytest.approx(grown / (grown + born), rel=1e-9)
    assert values.enantiomer_fraction_end == pytest.approx(
        float(product.solid[0].sum() / product.solid.sum()), rel=1e-9
    )
    assert values.crystal_flow_other / feed.liquid[0] == pytest.approx(
        float(out.crystals_other[-1]), rel=1e-9
    )
    assert values.time_pure < out.time_pure
    assert values.crop_time_pure < float(out.crop_time_pure)
    assert values.heat_duty < 0.0


@pytest.mark.long
def test_the_other_enantiomer_is_wanted_as_well() -> None:
    """Mirror images: with D seeds in place of L the same numbers."""
    one, other = (
        alone(f"crystallization.{NAME}", solid=name).solve().units[NAME].values
        for name in ("L-threonine", "D-threonine")
    )
    for a, b in zip(one, other, strict=True):
        assert float(a) == pytest.approx(float(b), rel=1e-9)


def test_what_cannot_be_parted_is_refused() -> None:
    with pytest.raises(CaseError, match="two crystals"):
        alone(f"crystallization.{NAME}", solid="L-threonine", other_solid="L-threonine").solve()
    impure = alone(f"crystallization.{NAME}", duration="12 hour", counter_nucleation=0.3).solve().units[NAME]
    assert [k.name for k in impure.checks if not k.ok] == ["wanted enantiomer in the crystals"]
    assert impure.values.time_pure < 12 * 3600.0


def test_crystals_dissolve_as_far_as_there_is_room() -> None:
    """97 g/kg at 25 °C (recalled), of each enantiomer."""
    ample = alone("crystallization.dissolver").solve().units["dissolver"].values
    assert float(ample.undissolved_flow) == 0.0
    assert float(ample.dissolved_flow) * 3600 == pytest.approx(20.0)
    assert ample.heat_duty > 0.0
    cold = alone("crystallization.dissolver", temperature="25 degC").solve()
    left = cold.units["dissolver"].values
    # 340 kg of water hold 33 kg of each; 30 came in dissolved, and 10 as crystals
    assert float(left.undissolved_flow) * 3600 == pytest.approx(2 * (40.0 - 340 * 0.097), rel=0.01)
    assert float(left.relative_saturation) == pytest.approx(1.0, rel=1e-9)
    assert cold.audit["mass_closure"] < 1e-12
    assert [k.ok for k in cold.units["dissolver"].checks] == [False, True]


@pytest.mark.long  # the unit's own test goes the same way
def test_threonine_is_parted_in_a_line() -> None:
    """Two crops beside each other, each of one enantiomer; what one leaves in excess is what the other
    finds.
    """
    run = gr.read(EXAMPLES / "chiral-resolution" / "line.toml").solve()
    assert run.audit["mass_closure"] < 1e-9
    assert run.audit["energy_closure"] < 1e-9
    assert not [k.name for unit in run.units.values() for k in unit.checks if not k.ok]
    left, right = (run.streams[f"{side}_cake"].solid_by_species for side in ("left", "right"))
    assert left[0] / left.sum() > 0.98
    assert right[1] / right.sum() > 0.98
    # of 16 kg/h of racemate only what is purged and what clings to the cakes is lost
    assert float(left.sum() + right.sum()) * 3600 == pytest.approx(16.0, rel=0.15)
    values = run.units["right_crystallizer"].values
    assert -0.05 < values.enantiomeric_excess < 0.0
