"""Heat of mixing of salts in water: against calorimetry, and as a state function."""

from __future__ import annotations

from typing import Any

import jax
import jax.numpy as jnp
import numpy as np
import pytest

from granum.core import flags
from granum.core.constants import GAS_CONSTANT
from granum.core.errors import GranumError
from granum.crystallization.formulas.balances import crystallizer_balance_library
from granum.materials.formulas.activity import TERMS, over_temperature, slope_over_temperature
from granum.materials.ions import ions_of
from granum.materials.library import session
from granum.materials.schema import read_materials
from granum.streams.from_materials import mixture_of

ROOM = 298.15
MIXED = (
    "sodium chloride",
    "potassium chloride",
    "magnesium chloride",
    "calcium chloride",
    "sodium sulfate",
    "magnesium sulfate",
)


def held(name: str, T: float, molality: float) -> float:
    """J per mole of salt."""
    system = session().solute(name)
    return float(system.mixing_law(T, molality * system.molar_mass, 1.0)) / molality


def calorimetric(molality: Any) -> Any:
    """Clegg's fit of heats of dilution of calcium chloride at 25 °C, J/mol, as its coefficients stand in the
    notebooks of pytzer (opened); Debye and Hückel's slope for enthalpies 1984 J/mol.
    """
    zero, one, c_zero, c_one = 0.607735e-4, 3.6999e-3, -0.434061e-4, 0.862546e-3
    x, y = 2.0 * jnp.sqrt(3.0 * molality), 2.5 * jnp.sqrt(3.0 * molality)
    pairs = zero + one * 2.0 * (1.0 - (1.0 + x) * jnp.exp(-x)) / x**2
    triples = c_zero + 4.0 * c_one * (6.0 - (6.0 + y * (6.0 + 3.0 * y + y * y)) * jnp.exp(-y)) / y**4
    far = 3.0 * 2.0 * 1984.0 / 2.4 * jnp.log(1.0 + 1.2 * jnp.sqrt(3.0 * molality))
    return far - 4.0 * GAS_CONSTANT * ROOM**2 * (molality * pairs + 2.0 * molality**2 * triples)


@pytest.mark.parametrize("molality", [0.1, 0.5, 1.0, 2.0, 4.0, 6.0, 8.0])
def test_calcium_chloride_as_calorimetry_has_it(molality: float) -> None:
    fitted = float(calorimetric(molality))
    assert held("calcium chloride", ROOM, molality) == pytest.approx(fitted, rel=0.05)


@pytest.mark.parametrize("share", [0.3, 0.35, 0.4, 0.45, 0.47])
def test_water_binds_to_calcium_chloride_as_calorimetry_has_it(share: float) -> None:
    """Also from 42 % on, where Conde's equation for the same heat lies ever lower: by 12 % at 45 and by 20 %
    at 47 %.
    """
    law = session().solute("calcium chloride").mixing_law
    mass = law.activity.molar_mass
    measured = jax.grad(lambda w: share / mass * calorimetric(share / mass / w))(1.0 - share)
    found = jax.grad(lambda w: law(ROOM, share, w))(1.0 - share)
    assert float(found) == pytest.approx(float(measured), rel=0.05)


def test_water_binds_to_calcium_chloride_as_conde_has_it() -> None:
    """Heat that a kilogram of water takes up as it leaves 30 and 35 % at 25 and 50 °C beyond that of
    vaporization, by Conde's equation (2004) as it stands in two public programs (opened): 45.33 kJ/kg of
    30 % at 50 °C.
    """
    for T, share in ((ROOM, 0.3), (323.15, 0.3), (ROOM, 0.35), (323.15, 0.35)):
        zeta = share / (0.8 - share)
        conde = (-955.69 + 3011.974 * T / 647.226) * (1.0 + (zeta / 0.855) ** -1.965) ** -2.265
        law = session().solute("calcium chloride").mixing_law
        water = jax.grad(lambda w, T=T, s=share, law=law: law(T, s, w))(1.0 - share)
        assert -float(water) / 1e3 == pytest.approx(conde, rel=0.12)


@pytest.mark.parametrize(
    ("salt", "crystal", "much_water", "within"),
    [
        ("sodium chloride", "sodium chloride", 3.88, 0.1),
        ("potassium chloride", "potassium chloride", 17.22, 0.1),
        ("magnesium chloride", "magnesium chloride hexahydrate", -17.13, 0.1),
        ("calcium chloride", "calcium chloride tetrahydrate", -10.9, 2.0),
        ("calcium chloride", "calcium chloride dihydrate", -45.9, 4.0),
        ("sodium sulfate", "sodium sulfate decahydrate", 79.45, 3.5),
    ],
)
def test_what_a_crystal_takes_up_in_much_water(
    salt: str, crystal: str, much_water: float, within: float
) -> None:
    """kJ/mol by enthalpies of formation (Wagman, 1982, recalled). Those of the balances are of the saturated
    solution; of the last two chlorides by the slope of the solubility at 9 and 12 mol/kg, which knows nothing
    of calorimetry, so that the heat of dilution from there is met.
    """
    system = session().solute(salt)
    branch = system.branch(crystal)
    bound = branch.solvent_ratio * system.solvent.liquid_enthalpy(ROOM)
    crystal_held = branch.hydrate_ratio * system.crystal_enthalpy(ROOM, crystal)
    taken = float(system.solute_enthalpy(ROOM) + bound - crystal_held) * system.molar_mass
    assert taken / 1e3 == pytest.approx(much_water, abs=within)


def test_the_heat_of_crystallization_is_counted_once() -> None:
    """Crystals and the liquor that they leave hold what the liquor held, less the heat of crystallization."""
    for name in MIXED:
        system = session().solute(name)
        T, (branch, *_rest) = ROOM if name != "sodium sulfate" else 293.15, system.branches
        ratio, x, step = float(system.value(T)), 1.0 / float(branch.hydrate_ratio), 1e-6

        def liquor(s: float, w: float, T: float = T, system=system) -> float:
            apart = s * system.solute_enthalpy(T) + w * system.solvent.liquid_enthalpy(T)
            return float(apart + system.mixing_law(T, s, w))

        grown = step * float(system.crystal_enthalpy(T, branch.crystal.name))
        lost = liquor(ratio, 1.0) - liquor(ratio - x * step, 1.0 - (1.0 - x) * step) - grown
        assert lost / (x * step) == pytest.approx(
            float(system.heat_of_crystallization(T)), rel=1e-3, abs=50.0
        )


def test_a_card_cools_epsom_salt_as_its_chart_has_it() -> None:
    """McCabe, Smith and Harriott: 32.5 % from 120 to 70 °F gives off 45.4 Btu per pound of magma."""
    warm, cold = 120.0 / 1.8 + 255.372, 70.0 / 1.8 + 255.372
    made = crystallizer_balance_library(1.0, 0.325, cold, warm, "magnesium sulfate")
    assert float(made.heat_duty) == pytest.approx(-45.4 * 2326.0, rel=0.07)


def test_three_hundred_solutions() -> None:
    """All give a liquid that is warmer the more heat it holds, from none of the salt to none of the water;
    nothing is held without salt, and slopes are finite.
    """
    rng = np.random.default_rng(3)
    for name in MIXED:
        system = session().solute(name)
        law, c = system.mixing_law, float(system.solute_heat_capacity)
        T, s = rng.uniform(263.0, 423.0, 50), rng.uniform(0.0, 0.45, 50)
        s[:3] = 0.0, 1e-12, 1.0
        value, slopes = jax.vmap(jax.value_and_grad(law, argnums=(0, 1, 2)))(T, s, 1.0 - s)
        assert np.all(np.isfinite(value))
        assert np.all(np.isfinite(np.asarray(slopes)))
        assert value[0] == 0.0
        assert np.all((s * c + (1.0 - s) * 4180.0 + np.asarray(slopes[0]))[s < 0.5] > 1500.0)


SEA = ("sodium chloride", "magnesium chloride", "sodium sulfate", "magnesium sulfate")


def together(*salts: str, solids: tuple[str, ...] = ()) -> Any:
    return mixture_of(["water", *salts], list(solids), [], (1e-5, 1e-3))


@pytest.mark.parametrize(
    ("celsius", "before", "after", "heat"),
    [
        (10.0, 70.0, 35.0, 695.7),
        (10.0, 120.0, 35.0, 2824.9),
        (20.0, 70.0, 35.0, 420.9),
        (20.0, 120.0, 5.0, 1930.7),
        (25.0, 70.0, 35.0, 310.8),
        (25.0, 100.0, 35.0, 848.4),
        (25.0, 120.0, 35.0, 1351.9),
        (30.0, 70.0, 35.0, 212.5),
        (30.0, 120.0, 35.0, 992.2),
    ],
)
def test_sea_water_is_diluted_as_its_equation_of_state_has_it(
    celsius: float, before: float, after: float, heat: float
) -> None:
    """J taken up by a kilogram of sea water of so many g/kg as water is added, at its temperature: TEOS-10
    (package gsw 3.6.23, opened), which rests on measured heats of dilution and heat capacities. Composition
    of Millero (2008), potassium counted as sodium, calcium as magnesium, other anions as chloride.
    """
    moles = 1000.0 / 31.4038218
    sodium, magnesium, sulfate = (x * moles for x in (0.427923, 0.0564311, 0.0252152))
    mixture = together(*SEA)
    parts = [ions.anhydrous_mass for n in SEA if (ions := ions_of(session().solute(n).formula))]
    kept = np.array([sodium, magnesium - sulfate, 0.0, sulfate]) * parts
    salts = before * 1e-3 * kept / kept.sum()

    def held(water: float) -> float:
        liquor = np.array([1.0 - before * 1e-3 + water, *salts])
        return float(mixture.heat_of_mixing(liquor, celsius + 273.15))

    assert held(before / after - 1.0) - held(0.0) == pytest.approx(heat, rel=0.15, abs=40.0)


@pytest.mark.parametrize(
    "pair", [("sodium chloride", "magnesium chloride"), ("calcium chloride", "sodium chloride")]
)
def test_of_two_salts_one_alone_is_as_without_the_other(pair: tuple[str, str]) -> None:
    both = together(*pair)
    for k, name in enumerate(pair):
        law = session().solute(name).mixing_law
        for T in (283.0, ROOM, 360.0):
            for share in (0.02, 0.2, 0.45, 0.8):
                liquor = np.zeros(3)
                liquor[0], liquor[1 + k] = 1.0 - share, share
                expected = float(law(T, share, 1.0 - share))
                assert float(both.heat_of_mixing(liquor, T)) == pytest.approx(expected, rel=3e-4, abs=1.0)


def test_brines_of_one_ionic_strength_and_one_common_ion_mix_without_heat() -> None:
    """Young's rule. Some 160 J per kilogram of water of two molal sodium and potassium chloride were measured
    (Wood and Anderson, recalled), which is what is left out.
    """
    both = together("sodium chloride", "potassium chloride")
    masses = [
        ions.anhydrous_mass for s in both.liquids[1:] if (ions := ions_of(session().solute(s.name).formula))
    ]

    def held(x: float) -> float:
        liquor = np.array([1.0, 2.0 * x * masses[0], 2.0 * (1.0 - x) * masses[1]])
        return float(both.heat_of_mixing(liquor, ROOM))

    assert held(0.3) == pytest.approx(0.3 * held(1.0) + 0.7 * held(0.0), abs=1e-6)


def test_it_does_not_matter_which_salts_a_brine_is_counted_as() -> None:
    """Sodium chloride and magnesium sulfate hold what sodium sulfate and magnesium chloride do."""
    mixture, rng = together(*SEA), np.random.default_rng(2)
    masses = [ions.anhydrous_mass for n in SEA if (ions := ions_of(session().solute(n).formula))]
    gain = np.array([0.0, *(np.array([2.0, -1.0, -1.0, 1.0]) * masses)])  # as two of salt are made
    for _ in range(20):
        T, liquor = rng.uniform(275.0, 400.0), np.array([1.0, *rng.uniform(0.05, 0.3, 4)])
        other = liquor + 0.2 * gain

        def whole(x: Any, T: float = T) -> float:
            return float(x @ mixture.enthalpies("liquids", T) + mixture.heat_of_mixing(x, T))

        assert whole(other) == pytest.approx(whole(liquor), rel=1e-11)


def test_two_hundred_brines() -> None:
    """What is held grows with the amount, nothing without salts, slopes are finite, and a brine is warmer the
    more heat it holds.
    """
    mixture, rng = together(*SEA), np.random.default_rng(4)
    T, liquors = rng.uniform(263.0, 423.0, 200), rng.uniform(0.0, 0.25, (200, 5))
    liquors[:, 0] = rng.uniform(0.0, 1.0, 200)
    liquors[:40, 1:] *= rng.integers(0, 2, (40, 4))
    liquors[0], liquors[1] = 0.0, [1.0, 0.0, 0.0, 0.0, 0.0]
    value, (slopes, warmer) = jax.jit(jax.vmap(jax.value_and_grad(mixture.heat_of_mixing, argnums=(0, 1))))(
        liquors, T
    )
    assert np.all(np.isfinite(value))
    assert np.all(np.isfinite(slopes))
    np.testing.assert_allclose(np.sum(liquors * slopes, axis=1), value, rtol=1e-8, atol=1e-8)
    np.testing.assert_allclose(value[:2], 0.0, atol=1e-9)
    capacities = 4180.0 * liquors[:, 0] + liquors[:, 1:] @ [
        float(s.heat_capacity[0]) for s in mixture.liquids[1:]
    ]
    assert np.all((capacities + warmer)[2:] > 0.0)


def test_series_of_temperatures_and_liquors_are_as_each() -> None:
    """Dryers ask for a liquor, as a list, at the temperatures of all cells and classes."""
    mixture = together("sodium chloride", "magnesium chloride")
    T, salt = np.linspace(280.0, 370.0, 6).reshape(3, 1, 2), np.linspace(0.0, 0.3, 2)
    found = np.asarray(mixture.heat_of_mixing([1.0, salt, 0.1], T))
    assert found.shape == (3, 1, 2)
    for i in np.ndindex(3, 1, 2):
        each = mixture.heat_of_mixing(np.array([1.0, salt[i[2]], 0.1]), T[i])
        assert found[i] == pytest.approx(float(each), rel=1e-12)


def test_salts_of_which_one_is_not_known_are_without_it() -> None:
    """And their crystals hold what they hold over solutions whose parts add up."""
    alone = together("magnesium chloride", solids=("magnesium chloride hexahydrate",))
    both = together(
        "magnesium chloride",
        "potassium nitrate",
        solids=("magnesium chloride hexahydrate", "potassium nitrate"),
    )
    assert alone.mixing is not None
    assert both.mixing is None
    assert alone.solids[0].reference_enthalpy != both.solids[0].reference_enthalpy


def test_what_lies_outside_is_told() -> None:
    law = session().solute("calcium chloride").mixing_law
    for T, molality, told in ((ROOM, 7.0, 0), (ROOM, 9.0, 1), (400.0, 7.0, 1)):
        with flags.collect() as records:
            law.heard(T, molality * law.activity.molar_mass, 1.0)
        assert sum(bool(np.any(np.asarray(record.mask))) for record in records) == told


def test_a_law_by_activities_needs_them() -> None:
    branch = {
        "crystal": "salt",
        "stable": [273.15, 373.15],
        "range": [273.15, 373.15],
        "basis": "kg anhydrous per kg solvent",
        "form": "table",
        "table": [[0, 10], [50, 20], [100, 30]],
        "source": "own",
    }
    entry = {"molar_mass": 0.05, "formula": "KCl", "mixing": "activity", "branches": [branch]}
    with pytest.raises(GranumError, match="water_activity"):
        read_materials({"solute": {"mine": entry}}, "own")


@pytest.mark.parametrize("term", range(TERMS))
def test_each_term_over_temperature_has_its_slope(term: int) -> None:
    alone = np.eye(TERMS)[term]
    for T in (273.15, 330.0, 480.0):
        slope = jax.grad(lambda t: over_temperature(t, alone))(T)
        assert float(slope_over_temperature(T, alone)) == pytest.approx(float(slope), rel=1e-12)
