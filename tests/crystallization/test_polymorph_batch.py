"""Two crystal forms in one vessel: against SciPy, Cardew and Davey's two limits, and the balance."""

from __future__ import annotations

import runpy
from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from tests.sharing.places import EXAMPLES

import granum as gr
from granum.core.errors import InputError
from granum.crystallization.population.packets import Packets

ROOM = {"law": "power_cooling", "temperature_start": 298.15, "temperature_end": 298.15, "duration": 3600.0}
META, STABLE, DENSITY = 0.02, 0.015, 1540.0


def batch(growth: float = 2e-8, dissolution: float = 1e-5, **changes: Any) -> Any:
    fields: dict[str, Any] = {
        "solute_per_solvent": META,
        "solubility": {"law": "polynomial_solubility", "coefficients": [META]},
        "solubility_law_stable": {"law": "polynomial_solubility", "coefficients": [STABLE]},
        "growth": {"law": "power_law_growth", "growth_coefficient": 1e-7, "growth_order": 1.0},
        "growth_stable": {"law": "power_law_growth", "growth_coefficient": growth, "growth_order": 1.0},
        "dissolution": {"law": "power_law_dissolution", "dissolution_coefficient": dissolution},
        "temperature_program": ROOM,
        "duration": "10 hour",
        "crystal_density": DENSITY,
        "seed_mass_per_solvent": 0.01,
        "seed_mass_stable": 0.0005,
    }
    return gr.crystallization.polymorph_batch(**(fields | changes))


def test_against_scipy():
    """One size of the metastable form that shrinks, moments of the stable one with births on its magma."""
    births = {"law": "secondary_nucleation", "nucleation_coefficient": 2e5, "nucleation_order": 1.0}
    out = batch(dissolution=1e-6, nucleation_stable=births, duration="6 hour")
    number = 0.01 / (DENSITY * 1e-12)
    first = np.array([1.0, 5e-5, 2.5e-9, 1.25e-13]) * 0.0005 / (DENSITY * 1.25e-13)
    scale = first.copy()
    total = META + 0.0105

    def rates(_t, y):
        size, m = y[0], y[1:] * scale
        meta, stable = number * DENSITY * max(size, 0.0) ** 3, DENSITY * m[3]
        c = total - meta - stable
        s1, s2 = c / META - 1.0, c / STABLE - 1.0
        G1 = 1e-7 * max(s1, 0.0) - 1e-6 * max(-s1, 0.0)
        G2 = 2e-8 * max(s2, 0.0) - 1e-6 * max(-s2, 0.0)
        B = 2e5 * max(s2, 0.0) * stable
        return [G1 if size > 0 else 0.0, *(np.array([B, G2 * m[0], 2 * G2 * m[1], 3 * G2 * m[2]]) / scale)]

    exact = solve_ivp(rates, (0, 21600.0), [1e-4, 1, 1, 1, 1], method="LSODA", rtol=1e-9, atol=1e-14).y[:, -1]
    assert volume_free(out)
    assert out.crystals_stable[-1] == pytest.approx(DENSITY * exact[4] * scale[3], rel=2e-3)
    assert out.crystals_metastable[-1] == pytest.approx(number * DENSITY * exact[0] ** 3, rel=2e-3)
    assert out.step_error < 2e-3


def volume_free(out: Any) -> bool:
    """Solute and crystals together do not change."""
    whole = np.asarray(out.solute_per_solvent + out.crystals_metastable + out.crystals_stable)
    return bool(np.ptp(whole) < 1e-14)


def test_fast_dissolution_holds_the_solubility_of_the_metastable_form():
    """Cardew and Davey: growth controls; a plateau at the metastable form until it has gone."""
    out = batch(growth=5e-9, dissolution=1e-4, duration="60 hour")
    there = np.asarray(out.crystals_metastable) > 1e-5
    assert there[0]
    assert not there[-1]
    np.testing.assert_allclose(np.asarray(out.solute_per_solvent)[there], META, rtol=5e-3)
    assert out.stable_fraction_end == 1.0
    assert out.solute_per_solvent[-1] < 0.017


def test_slow_dissolution_lets_the_solution_fall_to_the_stable_form():
    out = batch(growth=1e-6, dissolution=2e-8, duration="20 hour")
    half = np.asarray(out.time) > 7200.0
    there = np.asarray(out.crystals_metastable) > 1e-4
    assert (np.asarray(out.solute_per_solvent)[half & there] < 1.03 * STABLE).all()


def test_metastable_form_stays_where_nothing_of_the_other_is_born():
    out = batch(seed_mass_stable=0.0)
    assert out.stable_fraction_end == 0.0
    np.testing.assert_allclose(out.solute_per_solvent, META, rtol=1e-12)


def test_births_on_the_metastable_crystals_begin_it():
    births = {"law": "secondary_nucleation", "nucleation_coefficient": 1e6, "nucleation_order": 1.0}
    none = batch(seed_mass_stable=0.0, nucleation_stable=births)
    some = batch(seed_mass_stable=0.0, nucleation_stable=births, cross_nucleation=0.1)
    assert none.stable_fraction_end == 0.0
    assert some.stable_fraction_end > 0.01


def test_the_library_knows_which_glutamic_acid_is_stable():
    laws = [{"law": "library_solubility", "solute": s} for s in ("L-glutamic acid alpha", "L-glutamic acid")]
    program = ROOM | {"temperature_start": 318.15, "temperature_end": 318.15}
    given = {"solute_per_solvent": 0.02, "temperature_program": program, "duration": "10 hour"}
    out = batch(solubility=laws[0], solubility_law_stable=laws[1], **given)
    assert out.solubility_stable[0] < out.solubility_per_solvent[0]
    with pytest.raises(InputError, match="round"):
        batch(solubility=laws[1], solubility_law_stable=laws[0], **given)


@pytest.mark.parametrize("seed", range(3))
def test_random_batches_conserve_and_stay_possible(seed):
    rng = np.random.default_rng(seed)
    for _try in range(12):
        a, b, c, d, e = rng.random(5)
        births = {"law": "secondary_nucleation", "nucleation_coefficient": 10 ** (4 + 4 * a)}
        out = batch(
            10 ** (-9 + 3 * b),
            10 ** (-8 + 4 * c),
            nucleation_stable=births | {"nucleation_order": 1.0 + d},
            cross_nucleation=e,
            seed_mass_stable=0.001 * d,
            solute_per_solvent=0.012 + 0.02 * e,
        )
        assert volume_free(out)
        for name in ("crystals_metastable", "crystals_stable", "solute_per_solvent"):
            values = np.asarray(getattr(out, name))
            assert np.isfinite(values).all()
            assert (values >= 0.0).all()
        # no step overshoots the solubility of the stable form by dissolving or growing
        assert (np.asarray(out.solute_per_solvent)[1:] > 0.0119).all()
        assert (np.asarray(out.solute_per_solvent)[1:] < 0.0321).all()


def test_the_example_transforms() -> None:
    runpy.run_path(str(EXAMPLES / "polymorph" / "polymorph.py"))


def test_narrow_packets_lose_no_crystals_to_rounding():
    """Ends one rounding apart that meet after growth, as compilers round them: nothing dissolves."""
    low = np.full(1, 1e-4)
    high = np.nextafter(low, 1.0)
    packets = Packets(low, high, np.ones(1))
    for path in np.linspace(1e-7, 3e-5, 200):
        assert float(packets._shifted(path)[2][0]) == 1.0
    assert float(packets._shifted(-2e-4)[2][0]) == 0.0
    wide = Packets(np.zeros(1), np.full(1, 1e-4), np.ones(1))
    assert float(wide._shifted(-2.5e-5)[2][0]) == pytest.approx(0.75)
