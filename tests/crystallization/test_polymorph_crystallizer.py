"""Two crystal forms in a vessel of a line: against the procedure, closed forms, limits and the balance."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from tests.sharing.places import EXAMPLES

import granum as gr
from granum.cases.alone import alone
from granum.cases.reading import read_text
from granum.core.errors import GranumError
from granum.streams.from_materials import mixture_of

NAME, KEY = "polymorph_crystallizer", "crystallization.polymorph_crystallizer"
ALPHA, BETA = "L-glutamic acid alpha", "L-glutamic acid"
MELTED = 147.1293e-3  # kg/mol
NONE = {"law": "no_nucleation"}


def constant(ratio: float) -> dict[str, Any]:
    return {"law": "polynomial_solubility", "coefficients": [ratio]}


def solved(**changes: Any) -> Any:
    """The vessel alone; the substance and the energy close."""
    run = alone(KEY, **changes).solve()
    feed, product = (run.streams[n] for n in run.streams)
    kept = [float(s.liquid[1] + s.solid.sum()) for s in (feed, product)]
    assert kept[1] == pytest.approx(kept[0], rel=1e-12)
    assert run.audit["mass_closure"] < 1e-12
    assert run.audit["energy_closure"] < 1e-12
    return run, feed, product


def values(**changes: Any) -> Any:
    return solved(**changes)[0].units[NAME].values


def test_seeds_held_back_alone_are_the_batch_of_the_procedure() -> None:
    """From a clear liquor with seeds of both forms, to rounding."""
    line = alone(KEY, seed_mass_per_solvent=0.01, duration="3 hour")
    sheet, fed = line.sheet.units[NAME], line.solve().streams["feed"]
    clear = fed.replace(solid=0.0 * fed.solid)
    course = sheet.operate(feed=clear).inside.course
    out = gr.crystallization.polymorph_batch(
        float(fed.liquid[1] / fed.liquid[0]),
        sheet.solubility,
        sheet.solubility_law_stable,
        sheet.growth,
        sheet.growth_stable,
        sheet.dissolution,
        sheet.temperature_program,
        sheet.duration,
        float(fed.mixture.densities("solids", fed.temperature)[0]),
        nucleation_stable=sheet.nucleation_stable,
        cross_nucleation=sheet.cross_nucleation,
        seed_mass_per_solvent=0.01,
        seed_mass_stable=sheet.seed_mass_stable,
        volume_shape_factor_stable=0.1,
        liquid_density=float(clear.liquid_density),
        steps=300,
    )
    np.testing.assert_allclose(course.masses[:, 1], out.crystals_stable, rtol=1e-9)
    np.testing.assert_allclose(course.ratios[:, 0], out.solute_per_solvent, rtol=1e-9)


def test_growth_rules_where_dissolving_is_fast_as_in_closed_form() -> None:
    """Cardew and Davey: the liquor stays at the solubility of alpha, so that seeds of beta grow at one rate:
    their mass is that of the seed times (1 + G t / L)³, until alpha has gone.
    """
    high, low, rate, size = 0.0235, 0.018, 2e-8, 5e-5
    water, acid, alpha = 0.977, 0.0235 * 0.977, 0.02
    out = values(
        solubility=constant(high),
        solubility_law_stable=constant(low),
        growth_stable={"law": "power_law_growth", "growth_coefficient": rate, "growth_order": 1.0},
        dissolution={"law": "power_law_dissolution", "dissolution_coefficient": "2000 um/s"},
        nucleation_stable=NONE,
        seed_mass_stable=0.001,
        seed_size_stable=size,
        duration="12 hour",
        feed={
            "liquid": {"water": water / (water + acid), ALPHA.removesuffix(" alpha"): acid / (water + acid)},
            "liquid_flow": f"{water + acid} kg/h",
            "solid_flow": f"{alpha * water} kg/h",
        },
    )
    growth = rate * (high / low - 1.0)
    for least, found in ((0.5, out.time_transformation_half), (0.99, out.time_transformation_end)):
        grown = least * alpha / 0.001
        assert float(found) == pytest.approx(size * ((1.0 + grown) ** (1 / 3) - 1.0) / growth, rel=5e-3)
    assert float(out.plateau_position) == pytest.approx(1.0, abs=5e-3)
    assert float(out.form_fraction_end) == 1.0


def test_dissolution_rules_where_growing_is_fast() -> None:
    """Then the liquor lies at the solubility of beta, and alpha goes in the time of its own dissolution."""
    slow = {"law": "power_law_dissolution", "dissolution_coefficient": "0.1 um/s"}
    fast = {"law": "power_law_growth", "growth_coefficient": "10 um/s", "growth_order": 1.0}
    many = {"seed_mass_stable": 0.02, "seed_size_stable": "20 um", "nucleation_stable": NONE}
    out = values(growth_stable=fast, dissolution=slow, **many)
    twice = values(growth_stable=fast, dissolution=slow | {"dissolution_coefficient": "0.2 um/s"}, **many)
    assert float(out.plateau_position) < 0.1
    ratio = float(out.time_transformation_half / twice.time_transformation_half)
    assert ratio == pytest.approx(2.0, rel=0.1)


def test_what_rules_in_glutamic_acid_is_what_was_measured() -> None:
    """Garti and Zour (1997), abstract opened: the rate depends on the growth of beta, not on how fast alpha
    dissolves.
    """
    dissolution = {"law": "power_law_dissolution", "dissolution_coefficient": "40 um/s"}
    growth = {"law": "power_law_growth", "growth_coefficient": "0.04 um/s", "growth_order": 1.0}
    as_is, dissolving, growing = (
        float(values(**c).time_transformation_half)
        for c in ({}, {"dissolution": dissolution}, {"growth_stable": growth})
    )
    assert dissolving == pytest.approx(as_is, rel=5e-3)
    assert growing < 0.7 * as_is


def test_equally_soluble_forms_stay_as_they_are() -> None:
    ratio = 2.3 / 97.7
    run, feed, product = solved(
        solubility=constant(ratio), solubility_law_stable=constant(ratio), wanted_form="metastable"
    )
    np.testing.assert_allclose(product.solid, feed.solid, atol=1e-9 * float(feed.solid.sum()))
    assert all(k.ok for k in run.units[NAME].checks)


def test_without_seeds_or_births_nothing_changes() -> None:
    run, _feed, product = solved(nucleation_stable=NONE, seed_mass_stable=0.0)
    assert float(product.solid[1].sum()) == 0.0
    # 2.3 % dissolved is a little below what alpha dissolves to at 45 °C, 23.7 g/kg
    assert float(product.liquid[1] / product.liquid[0]) == pytest.approx(0.0237, abs=2e-4)
    assert [k.name for k in run.units[NAME].checks if not k.ok] == ["wanted form in the crystals"]


def test_heat_is_that_of_both_crystals() -> None:
    """Heats of solution of 26.9 and 27.5 kJ/mol: what changes gives off 0.6, what crystallizes 27.5."""
    run, feed, product = solved()
    moved = [float((product.solid[i] - feed.solid[i]).sum()) / MELTED for i in (0, 1)]
    assert float(run.units[NAME].values.heat_duty) == pytest.approx(
        -(26.9e3 * moved[0] + 27.5e3 * moved[1]), rel=1e-3
    )
    assert float(product.solid[0].sum()) == 0.0


def test_the_metastable_form_may_be_wanted() -> None:
    """Then a short batch is the right one, and a long one is told."""
    short, long = (
        solved(wanted_form="metastable", form_fraction_least=0.9, duration=d)[0].units[NAME]
        for d in ("20 min", "10 hour")
    )
    assert all(k.ok for k in short.checks)
    assert [k.name for k in long.checks if not k.ok] == ["wanted form in the crystals"]


def test_more_time_changes_more() -> None:
    shares = [float(values(duration=d).form_fraction_end) for d in ("1 hour", "3 hour", "6 hour")]
    assert 0.0 < shares[0] < shares[1] < shares[2]


@pytest.mark.parametrize(
    ("changes", "says"),
    [
        ({"solid": ALPHA, "solid_stable": ALPHA}, "name two crystals"),
        ({"solid": BETA, "solid_stable": ALPHA}, "another form"),
        (
            {"solubility": {"law": "library_solubility", "solute": "L-glutamic acid"}},
            "not of the crystal 'L-glutamic acid alpha'",
        ),
        ({"solubility": constant(0.02), "solubility_law_stable": constant(0.03)}, "round"),
        ({"seed_mass_per_solvent": 0.002, "duration": "20 hour"}, "give less seed"),
    ],
)
def test_what_cannot_be_is_refused(changes: dict[str, Any], says: str) -> None:
    with pytest.raises(GranumError, match=says):
        alone(KEY, **changes).solve()


def test_one_crystal_is_not_enough() -> None:
    text = (EXAMPLES / "polymorph" / "line.toml").read_text()
    text = text.replace(
        'solids = ["L-glutamic acid alpha", "L-glutamic acid"]', 'solids = ["L-glutamic acid alpha"]'
    )
    with pytest.raises(GranumError, match="Two crystals of one substance"):
        read_text(text).solve()


def test_the_order_of_the_crystals_says_nothing() -> None:
    text = (EXAMPLES / "polymorph" / "line.toml").read_text()
    turned = text.replace(
        '["L-glutamic acid alpha", "L-glutamic acid"]', '["L-glutamic acid", "L-glutamic acid alpha"]'
    )
    assert turned != text
    one, two = (read_text(t).solve().units["transformer"].values for t in (text, turned))
    np.testing.assert_allclose([float(x) for x in one], [float(x) for x in two], rtol=1e-9, atol=1e-15)


def test_a_library_knows_a_form_of_one_s_own() -> None:
    """Its crystals dissolve to the solute that it is a form of, and lie higher by the heat between them."""
    own = {
        "solid": {
            "glycine gamma": {
                "density": "1600 kg/m3",
                "heat_capacity": "1300 J/(kg*K)",
                "molar_mass": "75.07 g/mol",
            }
        },
        "solute": {
            "glycine gamma": {
                "molar_mass": "75.07 g/mol",
                "form_of": "glycine",
                "branches": [
                    {
                        "crystal": "glycine gamma",
                        "stable": [273.15, 373.15],
                        "basis": "kg anhydrous per kg solvent",
                        "form": "apelblat",
                        "coefficients": [-1.5, 0.0, 0.0],
                        "range": [273.15, 373.15],
                        "source": "own",
                        "heat_of_solution": 15200.0,
                    }
                ],
            }
        },
    }
    mixture = mixture_of(["water", "glycine"], ["glycine gamma", "glycine"], [], [1e-5, 1e-3], own=[own])
    gamma, alpha = mixture.solids
    assert gamma.composition == alpha.composition == (("glycine", 1.0),)
    heat = gr.materials.solute("glycine").branches[0].heat_of_crystallization * 0.07507
    apart = (float(gamma.enthalpy(298.15)) - float(alpha.enthalpy(298.15))) * 0.07507
    assert apart == pytest.approx(float(heat) - 15200.0, rel=2e-3)


@pytest.mark.long
def test_alpha_becomes_beta_in_a_line() -> None:
    text = (EXAMPLES / "polymorph" / "line.toml").read_text()
    shares = []
    for duration in ("1 hour", "3 hour", "9 hour"):
        run = read_text(text.replace('duration = "9 hour"', f'duration = "{duration}"')).solve()
        assert run.audit["mass_closure"] < 1e-9
        assert run.audit["energy_closure"] < 1e-9
        dry = run.streams["dry_product"].solid_by_species
        shares.append(float(dry[1] / dry.sum()))
    assert 0.0 < shares[0] < shares[1] < shares[2] == 1.0
    assert not [k.name for unit in run.units.values() for k in unit.checks if not k.ok]
