"""Solutions boil where others measured it, and water activity is what tables say."""

import jax
import jax.numpy as jnp
import numpy as np
import pytest

import granum as gr
from granum.core.constants import STANDARD_ATMOSPHERE
from granum.core.errors import ApplicabilityError
from granum.core.flags import collect
from granum.materials.library import session

SOLUTES = (
    "sodium chloride",
    "potassium chloride",
    "potassium sulfate",
    "sodium sulfate",
    "ammonium sulfate",
    "sucrose",
)


OWN = {
    "solute": {
        "mine": {
            "formula": "KNO3",
            "molar_mass": 0.1,
            "branches": [
                {
                    "crystal": "potassium nitrate",
                    "stable": [273.15, 373.15],
                    "basis": "kg anhydrous per kg solvent",
                    "form": "table",
                    "range": [273.15, 333.15],
                    "source": "invented",
                    "table": [[0, 12.0], [30, 31.3], [60, 52.2]],
                }
            ],
        }
    }
}


def saturated(solute, pressure):
    """Elevation of the solution that is saturated where it boils, K."""
    system, T, before = gr.materials.solute(solute), 375.0, 0.0
    boils = jax.jit(lambda T: system.boiling_temperature(pressure, system.solubility(T)))
    while abs(T - before) > 1e-6:
        T, before = float(boils(T)), T
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


@pytest.mark.parametrize(
    ("solute", "zero", "one", "c_phi", "counts", "charges", "most"),
    [
        ("ammonium sulfate", 0.0545 * 0.75, 0.878 * 0.75, -0.00219 * 3 / 2**2.5, (2, 1), (1, 2), 5.5),
        ("sodium nitrate", 0.0068, 0.1783, -0.00072, (1, 1), (1, 1), 6.0),
        ("potassium nitrate", -0.0816, 0.0494, 0.0066, (1, 1), (1, 1), 3.8),
        ("ammonium nitrate", -0.0154, 0.112, -0.00003, (1, 1), (1, 1), 6.0),
    ],
)
def test_ammonium_sulfate_and_nitrates_as_pitzer_and_mayorga_have_them(
    solute, zero, one, c_phi, counts, charges, most
):
    """At 25 °C, by their table (1973) as it stands in pytzer (opened); the library has other sources."""
    system, (p, q), (zc, za) = gr.materials.solute(solute), counts, charges
    for m in np.linspace(0.1, most, 8):
        root = np.sqrt(0.5 * m * (p * zc**2 + q * za**2))
        pairs = m * 2 * p * q / (p + q) * (zero + one * np.exp(-2.0 * root))
        triples = m**2 * 2 * (p * q) ** 1.5 / (p + q) * c_phi
        printed = 1.0 - zc * za * 0.3915 * root / (1.0 + 1.2 * root) + pairs + triples
        activity = system.solvent_activity(298.15, m * system.molar_mass)
        found = -float(jnp.log(activity)) / ((p + q) * m * 0.01801528)
        assert found == pytest.approx(printed, rel=0.017)


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


@pytest.mark.parametrize(
    ("solute", "humidity", "within"),
    [
        # over saturated solutions at 25 °C: Greenspan, J. Res. Natl. Bur. Stand. 81A (1977), recalled
        ("potassium nitrate", 0.936, 0.015),
        ("strontium nitrate", 0.851, 0.01),
        ("potassium bromide", 0.809, 0.01),
        ("ammonium chloride", 0.786, 0.02),
        ("sodium nitrate", 0.743, 0.01),
        ("potassium iodide", 0.689, 0.01),
        ("sodium bromide", 0.576, 0.01),
        ("magnesium chloride", 0.328, 0.015),
        ("urea", 0.72, 0.03),  # deliquescence of urea, recalled: 0.72 to 0.74
    ],
)
def test_humidity_over_saturated_solutions(solute, humidity, within):
    system = gr.materials.solute(solute)
    assert system.solvent_activity(298.15, system.solubility(298.15)) == pytest.approx(humidity, abs=within)


@pytest.mark.parametrize(("solute", "elevation"), [("sodium nitrate", 20.0), ("potassium nitrate", 15.9)])
def test_nitrates_boil_near_where_handbooks_have_them(solute, elevation):
    """Saturated at 1 atm, recalled: 120 and 115.9 °C."""
    assert saturated(solute, STANDARD_ATMOSPHERE) == pytest.approx(elevation, rel=0.05)


def test_caustic_soda_boils_near_duhrings_line():
    """Geankoplis, example 8.4-1 (opened as quoted at justaaa.com): 30 % of NaOH at 25.6 kPa boils at 79.5 °C
    by his chart, 13.9 K above water.
    """
    system = gr.materials.solute("sodium hydroxide")
    elevation = float(system.boiling_point_elevation(25.6e3, 0.3 / 0.7))
    assert elevation == pytest.approx(13.9, abs=2.2)  # lines of the chart are a finger wide


def test_saturated_calcium_chloride_is_dry():
    """Osmotic coefficients at 25 °C of Robinson and Stokes, recalled: 1.046, 1.779 and 2.891 at 1, 3 and 6
    mol/kg; the best brine for drying holds a third of the water that Møller's coefficients let it.
    """
    system = gr.materials.solute("calcium chloride")
    m = np.array([1.0, 3.0, 6.0])
    activity = system.solvent_activity(298.15, m * system.molar_mass)
    assert -np.log(activity) / (3 * m * 0.01801528) == pytest.approx([1.046, 1.779, 2.891], rel=0.01)


def test_ions_that_pair():
    """Magnesium sulfate, 1 and 3 mol/kg at 25 °C: 0.525 and 0.919 of Robinson and Stokes, recalled."""
    system = gr.materials.solute("magnesium sulfate")
    m = np.array([1.0, 3.0])
    activity = system.solvent_activity(298.15, m * system.molar_mass)
    assert -np.log(activity) / (2 * m * 0.01801528) == pytest.approx([0.525, 0.919], rel=0.03)


def test_every_solute_of_the_library_boils_higher_than_its_solvent():
    """And says where that is an estimate: at 60 °C only sodium chloride and others with parameters over
    temperature are silent.
    """
    silent = []
    for name in session().names("solute"):
        system = gr.materials.solute(name)
        ratio = 0.5 * system.branches[0].value(333.15)
        with collect() as records:
            activity = system.solvent_activity(333.15, np.array([0.5, 1.0]) * ratio)
        assert 0.0 < activity[1] < activity[0] < 1.0, name
        if not any(np.any(np.asarray(r.mask)) for r in records):
            silent.append(name)
    assert {"sodium chloride", "potassium chloride", "magnesium sulfate"} <= set(silent)
    assert {"potassium nitrate", "sodium nitrate", "ammonium sulfate"} <= set(silent)
    assert not {"rubidium nitrate", "urea", "citric acid", "copper sulfate"} & set(silent)


def test_a_solute_without_water_activity_says_so():
    own = session().with_own([OWN]).solute("mine")
    with pytest.raises(ApplicabilityError, match="water activity"):
        own.boiling_temperature(STANDARD_ATMOSPHERE, 0.5)
