"""Solutions boil where others measured it, and water activity is what tables say."""

import jax
import jax.numpy as jnp
import numpy as np
import pytest

import granum as gr
from granum.core.constants import STANDARD_ATMOSPHERE
from granum.core.errors import ApplicabilityError

SOLUTES = (
    "sodium chloride",
    "potassium chloride",
    "potassium sulfate",
    "sodium sulfate",
    "ammonium sulfate",
    "sucrose",
)


def saturated(solute, pressure):
    """Elevation of the solution that is saturated where it boils, K."""
    system, T = gr.materials.solute(solute), 375.0
    for _ in range(30):
        T = float(system.boiling_temperature(pressure, system.solubility(T)))
    return T - float(system.solvent.boiling_temperature(pressure))


@pytest.mark.parametrize(("mercury", "elevation"), [(760.0, 8.5), (560.0, 8.0)])
def test_brine_over_salt_boils_where_buchanan_found_it(mercury, elevation):
    """Steam blown through salt, J. Y. Buchanan, On Steam and Brines (1899): abstract opened; "about"."""
    assert saturated("sodium chloride", mercury * 133.322) == pytest.approx(elevation, abs=0.3)


@pytest.mark.parametrize(
    ("solute", "molality", "osmotic"),
    [
        # Robinson and Stokes' tables at 25 °C, from memory, not opened
        ("sodium chloride", 1.0, 0.936),
        ("sodium chloride", 6.0, 1.271),
        ("potassium chloride", 4.8, 0.988),
        ("sodium sulfate", 1.0, 0.642),
        ("ammonium sulfate", 4.0, 0.660),
    ],
)
def test_osmotic_coefficients_at_room_temperature(solute, molality, osmotic):
    system = gr.materials.solute(solute)
    ions = sum(system.activity_law.counts)
    activity = system.solvent_activity(298.15, molality * system.molar_mass)
    found = -float(jnp.log(activity)) / (ions * molality * 0.01801528)
    assert found == pytest.approx(osmotic, rel=0.015)


@pytest.mark.parametrize("solute", SOLUTES)
def test_boiling_rises_with_concentration_far_beyond_the_data(solute):
    system = gr.materials.solute(solute)
    ratios = np.linspace(0.0, 5.0, 60)
    for pressure in (5e3, STANDARD_ATMOSPHERE):
        T = system.boiling_temperature(pressure, ratios)
        assert np.all(np.isfinite(T))
        assert np.all(np.diff(T) > 0.0)
    assert system.boiling_point_elevation(STANDARD_ATMOSPHERE, 0.0) == pytest.approx(0.0, abs=1e-9)


@pytest.mark.parametrize("solute", SOLUTES)
def test_little_solute_raises_the_boiling_point_by_its_ions(solute):
    """0.018015 kg/mol over d ln p/dT = 3.617 kPa/K / 101.325 kPa of the steam table."""
    system = gr.materials.solute(solute)
    m = 1e-5
    ions = sum(getattr(system.activity_law, "counts", (1.0,)))
    raised = jax.jvp(
        lambda c: system.boiling_temperature(STANDARD_ATMOSPHERE, c), (0.0,), (m * system.molar_mass,)
    )[1]
    if solute == "sucrose":
        assert raised / (m * ions) == pytest.approx(0.5046, rel=0.003)
    else:
        small = system.boiling_point_elevation(STANDARD_ATMOSPHERE, m * system.molar_mass)
        assert small / (m * ions) == pytest.approx(0.5046, rel=0.02)


def test_a_solute_without_water_activity_says_so():
    with pytest.raises(ApplicabilityError, match="water activity"):
        gr.materials.solute("potassium nitrate").boiling_temperature(STANDARD_ATMOSPHERE, 0.5)
