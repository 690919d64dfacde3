"""Heats of dilution and of solution from Pitzer's equations: against calorimetry, and as a state function."""

from __future__ import annotations

import jax
import jax.numpy as jnp
import numpy as np
import pytest

from granum.core.constants import GAS_CONSTANT
from granum.core.errors import ApplicabilityError, InputError
from granum.crystallization.vessels.salt_heats import KNOWN, heat_of_dilution, heat_of_solution
from granum.materials.brines import brine
from granum.materials.formulas.activity import ROOM, debye_huckel_slope
from granum.materials.formulas.mixed_electrolytes import excess
from granum.materials.library import session

NACL, KCL, MGCL2 = "sodium chloride", "potassium chloride", "magnesium chloride"
# slopes with temperature of beta 0, 1, 2 and C_phi, and the largest molality: fitted to heats of dilution by
# Silvester and Pitzer (1978), tables 12 and 13 of Pitzer (1991) as transcribed in pytzer (opened); of salts
# with an ion of charge 2 the table has C, half of C_phi by the root of the charges
SLOPES = {
    NACL: (7.159e-4, 7.005e-4, 0.0, -10.54e-5, 6.0),
    KCL: (5.794e-4, 10.71e-4, 0.0, -5.095e-5, 4.5),
    MGCL2: (-0.194e-3, 2.78e-3, 0.0, -0.58e-4 * 8**0.5, 2.0),
    "sodium sulfate": (2.367e-3, 5.63e-3, 0.0, -1.725e-4 * 8**0.5, 2.0),
    "magnesium sulfate": (-0.69e-3, 1.53e-2, -0.253, 1.31e-4 * 4.0, 2.0),
}


def apparent(name, molality, temperature=ROOM):
    per_solvent = molality * brine((name,)).molar_masses[0]
    return float(heat_of_dilution(temperature, per_solvent, 0.0, first_salt=name).relative_molar_enthalpy)


@pytest.mark.parametrize("name", SLOPES)
def test_dilution_is_as_calorimetry_has_it(name):
    *slopes, c_phi, most = SLOPES[name]
    alone = brine((name,))
    given, each = alone.coefficients(ROOM), alone.ions_per_salt[0]
    betas = (given.beta_zero, given.beta_one, given.beta_two)

    def energy(T, m):
        zero, one, two = (b + s * (T - ROOM) for b, s in zip(betas, slopes, strict=True))
        there = given._replace(
            slope=debye_huckel_slope.function(T),
            beta_zero=zero,
            beta_one=one,
            beta_two=two,
            c_phi=given.c_phi + c_phi * (T - ROOM),
        )
        return excess(m * each, alone.charges, there)

    m = np.array([0.05, 0.1, 0.5, 1.0, 2.0] + [most] * (most > 2.0))
    slope = jax.jit(jax.vmap(jax.grad(energy), (None, 0)))(ROOM, jnp.asarray(m))
    published = -GAS_CONSTANT * ROOM**2 * slope / m
    found = [apparent(name, x) for x in m]
    several = name in (NACL, KCL)
    np.testing.assert_allclose(
        found, published, rtol=0.0 if several else 0.125, atol=210.0 if several else 60.0
    )


def test_salt_is_as_parker_tabulates_it():
    """Parker (1965), recalled: 348 J/mol at 0.1 mol/kg, about -2000 at 6."""
    assert apparent(NACL, 0.1) == pytest.approx(348.0, abs=25.0)
    assert apparent(NACL, 6.0) == pytest.approx(-2000.0, abs=80.0)


def test_the_most_dilute_follow_debye_and_huckel():
    """Slope over RT: 1.0806 at 50 °C in Silvester and Pitzer's treatment, opened in Cantera; 0.801 at 25 °C
    (Pitzer 1991, recalled).
    """
    for kelvin, slope in ((323.15, 1.0806), (ROOM, 0.801)):
        for name in (NACL, KCL):
            ratio = apparent(name, 1e-6, kelvin) / (GAS_CONSTANT * kelvin * 1e-3)
            assert ratio == pytest.approx(slope, rel=0.005)


def test_a_hundred_dilutions():
    """By two steps as by one, nothing back and forth, nothing without water; pairs between their salts."""
    rng = np.random.default_rng(8)
    pairs = [(NACL, ""), (KCL, NACL), (MGCL2, KCL), (NACL, "sodium sulfate"), ("magnesium sulfate", MGCL2)]
    for k in range(100):
        first, second = pairs[k % len(pairs)]
        T, beside = rng.uniform(289.0, 372.0), rng.uniform(0.0, 0.1)
        one, two, three = -np.sort(-rng.uniform(0.002, 0.25, 3))

        def heat(a, b, T=T, first=first, second=second, share=beside / one):
            out = heat_of_dilution(T, a, b, share * a if second else 0.0, first, second)
            assert all(np.isfinite(x) for x in out)
            return float(out.heat_of_dilution)

        assert heat(one, three) == pytest.approx(heat(one, two) + heat(two, three), abs=1e-6)
        assert heat(one, three) == pytest.approx(-heat(three, one), abs=1e-6)
        assert heat(two, two) == 0.0


def test_heats_of_solution_are_those_of_the_solubility():
    """Calorimetry (25 °C) with heat capacities, against slopes of the solubility products of the tables,
    which are good to some percent.
    """
    for name, most in ((NACL, 450.0), (KCL, 1300.0)):
        alone = brine((name,))
        slope = jax.jit(jax.jacfwd(lambda t, alone=alone: alone._log_saturated(t)[0]))
        for kelvin in (ROOM, 323.15, 348.15):
            out = heat_of_solution(kelvin, 0.1, first_salt=name)
            met = GAS_CONSTANT * kelvin**2 * float(slope(kelvin))
            assert float(out.enthalpy_of_dissolution_dilute) == pytest.approx(met, abs=most)


def test_what_dissolves_better_when_warm_gives_off_heat_as_it_crystallizes():
    """Le Chatelier, also for the hexahydrate that heats much water; and the energy balances say the same."""
    for name in (NACL, KCL, MGCL2, "sodium sulfate"):
        law = session().solute(name)
        assert float(law.value(300.0) - law.value(290.0)) > 0.0
        # the one curve that is steep is met in its middle; below 25 °C balances keep the heat of dilution
        # that its solutions have there
        T, within = ("15 degC", 0.05) if name == "sodium sulfate" else (ROOM, 2e-3)
        found = heat_of_solution(T, 0.1, first_salt=name)
        assert float(found.heat_of_crystallization) > 0.0
        assert float(found.heat_of_crystallization_balance) == pytest.approx(
            float(found.heat_of_crystallization), rel=within
        )


def test_salts_dissolve_in_any_order():
    x, y = 0.15, 0.2
    moles = [x / brine((KCL,)).molar_masses[0], y / brine((NACL,)).molar_masses[0]]

    def integral(c, beside, first, second):
        return float(heat_of_solution("40 degC", c, beside, first, second).enthalpy_of_dissolution)

    one = moles[0] * integral(x, 0.0, KCL, NACL) + moles[1] * integral(y, x, NACL, KCL)
    other = moles[1] * integral(y, 0.0, NACL, KCL) + moles[0] * integral(x, y, KCL, NACL)
    assert one == pytest.approx(other, rel=1e-6)


def test_the_differential_heat_is_the_slope_of_the_integral_one():
    """Of a hydrate too, which brings its water, beside a kilogram of which there is one in all."""
    name, c, step = "sodium sulfate", 0.15, 1e-4
    M, water = brine((name,)).molar_masses[0], 10.0 * 0.01801528

    def out(c):
        return heat_of_solution(293.15, c, first_salt=name)

    # added to a fixed free water: per kg of all water, what there is rises by 1 + water m
    def added(c):
        m = c / M
        return float(out(c).enthalpy_of_dissolution) * m / (1.0 - water * m)

    def fed(c):
        return c / M / (1.0 - water * c / M)

    slope = (added(c + step) - added(c - step)) / (fed(c + step) - fed(c - step))
    assert float(out(c).enthalpy_of_dissolution_differential) == pytest.approx(slope, rel=1e-5)
    weak = out(1e-9)
    assert float(weak.enthalpy_of_dissolution) == pytest.approx(
        float(weak.enthalpy_of_dissolution_dilute), abs=2.0
    )


def test_what_is_not_known_is_refused_in_words():
    for name in ("potassium sulfate", "calcium chloride", "ammonium sulfate", "sucrose"):
        assert name not in KNOWN
        with pytest.raises(ApplicabilityError, match=f"heat of dilution of {name} is not known"):
            heat_of_dilution(ROOM, 0.1, 0.05, first_salt=name)
    with pytest.raises(ApplicabilityError, match="potassium sulfate is not known"):
        heat_of_dilution(ROOM, 0.1, 0.05, 0.1, KCL, "sodium sulfate")
    with pytest.raises(ApplicabilityError, match="known from 0 °C to 100 °C"):
        heat_of_dilution("120 degC", 0.1, 0.05)
    with pytest.raises(ApplicabilityError, match="from 10 °C to 100 °C, not at 2"):
        heat_of_solution("2 degC", 0.1, first_salt="sodium sulfate")
    with pytest.raises(ApplicabilityError, match="sodium sulfate anhydrous at infinite dilution"):
        heat_of_solution("40 degC", 0.1, first_salt="sodium sulfate")
    with pytest.raises(InputError, match="in proportion"):
        heat_of_dilution(ROOM, 0.0, 0.1, 0.1, KCL, NACL)
    with pytest.raises(InputError, match="same salt"):
        heat_of_solution(ROOM, 0.1, 0.1, KCL, "KCl")
    with pytest.raises(InputError, match="more water than that"):
        heat_of_solution(293.15, 0.9, first_salt="sodium sulfate")
