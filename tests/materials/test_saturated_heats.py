"""Heats of crystallization from the saturated solution, as energy balances take them."""

from __future__ import annotations

import math

import pytest

from granum.materials import enthalpy_of_dissolution_williamson
from granum.materials.library import session
from granum.materials.saturated_heats import enthalpy_of_dissolution, is_measured
from granum.materials.solutes import REFERENCE

GAS = 8.314462618


def strong():
    """Crystals whose heat comes from the slope of their solubility, or stands beside it."""
    library = session()
    for name in library.names("solute"):
        system = library.solute(name)
        for branch in system.branches if is_measured(system) else ():
            if branch.heat_of_crystallization != branch.heat_dilute:
                yield system, branch


@pytest.mark.parametrize(
    ("name", "calorimetric"),
    # J/mol: what dissolves last, from the calorimetric slopes of Pitzer's parameters (silvester1978)
    [
        ("sodium chloride", 1943.0),
        ("potassium chloride", 13830.0),
        ("sodium sulfate", 72170.0),
        ("magnesium chloride", 17250.0),
    ],
)
def test_solubilities_tell_what_calorimeters_measure(name, calorimetric):
    """Two ways that share no number."""
    system = session().solute(name)
    heat, _strong = enthalpy_of_dissolution(system, system.branches[0], REFERENCE)
    assert float(heat) == pytest.approx(calorimetric, rel=0.1, abs=500.0)


def test_an_ideal_solution_has_van_t_hoffs_heat():
    found = enthalpy_of_dissolution_williamson(300.0, 0.01, 0.02, 1.0)
    assert float(found) == pytest.approx(GAS * 300.0**2 * 0.02)


def test_a_crystal_that_is_the_solution_has_no_heat_by_its_slope():
    """Where a hydrate melts in its own water the solubility rises without bound, and the factor is zero."""
    molality = 1.0 / (6.0 * 0.01801528)
    found = enthalpy_of_dissolution_williamson(303.0, molality, 0.5, 5.0, 6.0)
    assert abs(float(found)) < 1e-6 * GAS * 303.0**2


def test_le_chatelier():
    """What dissolves better when warm gives off heat as it crystallizes, whatever it does in much water."""
    seen = 0
    for system, branch in strong():
        T = branch.heat_temperature
        rising = float(branch.inside(T + 1.0) - branch.inside(T - 1.0))
        assert math.copysign(1.0, rising) == math.copysign(1.0, float(branch.heat_of_crystallization)), (
            system.name,
            branch.crystal.name,
        )
        seen += 1
    assert seen > 40


def test_epsom_salt_gives_off_what_its_enthalpy_chart_says():
    """McCabe, Smith and Harriott, example on cooling a solution of 32.5 % from 120 to 70 °F: from the chart
    45.4 Btu per pound of magma, 315,000 Btu per ton of crystals.
    """
    system = session().solute("magnesium sulfate")
    mixing = system.mixing_law
    branch = system.branch("magnesium sulfate heptahydrate")
    warm, cold = 120.0 / 1.8 + 255.372, 70.0 / 1.8 + 255.372
    ratio = float(system.solubility(cold))
    liquor, crystal = ratio / (1.0 + ratio), 1.0 / float(branch.hydrate_ratio)
    share = (0.325 - liquor) / (crystal - liquor)

    def solution(x, T):
        apart = x * float(system.solute_enthalpy(T)) + (1.0 - x) * float(system.solvent.liquid_enthalpy(T))
        return apart + float(mixing(T, x, 1.0 - x))

    magma = (1.0 - share) * solution(liquor, cold) + share * float(
        system.crystal_enthalpy(cold, "magnesium sulfate heptahydrate")
    )
    heat = solution(0.325, warm) - magma
    assert heat == pytest.approx(45.4 * 2326.0, rel=0.07)
    assert heat / share == pytest.approx(315e3 * 1055.06 / 907.185, rel=0.02)


def test_ammonium_sulfate_as_two_calorimeters_have_it():
    """Its heat of solution in much water by enthalpies of formation, 6.6 kJ/mol (Wagman, 1982, recalled), and
    what Clegg's coefficients say of the rest, 0.3: by the slope of the solubility, which knows of neither.
    """
    branch = session().solute("ammonium sulfate").branches[0]
    assert float(branch.heat_of_crystallization) * 0.13214 == pytest.approx(6.9e3, rel=0.08)


def test_calcium_chloride_hexahydrate_is_near_its_heat_of_melting():
    """It melts at 29.8 °C, a few kelvins above where its heat is given, with 190 kJ/kg (recalled)."""
    system = session().solute("calcium chloride")
    branch = system.branch("calcium chloride hexahydrate")
    per_crystal = float(branch.heat_of_crystallization) / float(branch.hydrate_ratio)
    assert per_crystal == pytest.approx(190e3, rel=0.1)


def test_crystals_of_a_solution_that_is_cooled_and_boiled():
    """Opened at holooly.com (McCabe, Smith and Harriott, example 27.1): 1000 kg with 30 % of magnesium
    sulfate are cooled to 60 °F while 5 % of the water boils off: 261 kg of Epsom salt.
    """
    system = session().solute("magnesium sulfate")
    T, salt, water = 60.0 / 1.8 + 255.372, 300.0, 700.0 * 0.95
    s, hydrate = float(system.solubility(T)), 246.48 / 120.37
    crystals = (salt - s * water) * hydrate / (1.0 - s * (hydrate - 1.0))
    assert crystals == pytest.approx(261.0, rel=0.1)  # his chart leaves 24.5 % dissolved, the table less
